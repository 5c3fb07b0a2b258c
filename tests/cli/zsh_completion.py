"""Types command lines into a real zsh and looks at what the Tab key makes of them.

Usage: zsh_completion.py FOLDER   (which holds _penumbra and the files of completion_test.sh)
"""

import os
import pty
import select
import signal
import subprocess
import sys
import time

# What is typed before the Tab key, and the line that it should become. An ambiguous word stays, so
# it is asked for by a unique beginning. (zsh takes a list's last comma away when a blank follows.)
CASES = [
    ("penumbra rend", "penumbra render "),
    ("penumbra render --filter-r", "penumbra render --filter-radius="),
    ("penumbra render --method sto", "penumbra render --method stochastic "),
    ("penumbra render --method=sto", "penumbra render --method=stochastic "),
    ("penumbra render --aov beauty,mot", "penumbra render --aov beauty,motion,"),
    ("penumbra render scenes/a", "penumbra render scenes/a.json "),
    ("penumbra render scenes/b", "penumbra render scenes/b.OBJ "),
    ("penumbra render -o scenes/d", "penumbra render -o scenes/d.exr "),
    ("penumbra diff --fail-above hdr", "penumbra diff --fail-above hdr-flip="),
    ("penumbra diff scenes/c", "penumbra diff scenes/c.png "),
    ("penumbra completion z", "penumbra completion zsh "),
]
TIME_LIMIT = 20.0

# The completed line goes to standard output between two marks, instead of being run.
SETUP = r"""
PS1= PS2= RPS1= KEYTIMEOUT=1
fpath=($PWD $fpath)
autoload -U compinit && compinit -u -D
unsetopt menu_complete auto_menu
show() { print -r -- "<line>$BUFFER</line>"; BUFFER=; zle accept-line }
zle -N show
bindkey '^X' show
bindkey '^I' complete-word
print -r -- '<rea''dy>'
"""


class Shell:
    def __init__(self, folder):
        self.master, slave = pty.openpty()
        environment = {"PATH": os.environ["PATH"], "TERM": "dumb", "HOME": folder}
        self.process = subprocess.Popen(["zsh", "-f", "-i"], stdin=slave, stdout=slave, stderr=slave,
                                        cwd=folder, env=environment, start_new_session=True)
        os.close(slave)
        self.seen = ""
        self.end = time.monotonic() + TIME_LIMIT

    def type(self, text):
        os.write(self.master, text.encode())

    def wait_for(self, mark):
        """Returns what came before the mark, and forgets both."""
        while mark not in self.seen:
            left = self.end - time.monotonic()
            if left <= 0 or not select.select([self.master], [], [], left)[0]:
                raise TimeoutError(f"no {mark!r} after {TIME_LIMIT} s in: {self.seen[-500:]!r}")
            self.seen += os.read(self.master, 65536).decode(errors="replace")
        before, self.seen = self.seen.split(mark, 1)
        return before

    def stop(self):
        os.killpg(self.process.pid, signal.SIGKILL)
        self.process.wait()


def main():
    shell = Shell(sys.argv[1])
    failed = 0
    try:
        for line in SETUP.strip().splitlines():
            shell.type(line + "\n")
        shell.wait_for("<ready>")
        for typed, expected in CASES:
            shell.type(typed + "\t\x18")
            shell.wait_for("<line>")
            got = shell.wait_for("</line>")
            if got != expected:
                failed += 1
                print(f"  {typed!r}: expected {expected!r}, got {got!r}")
    except TimeoutError as error:
        failed += 1
        print(f"  {error}")
    finally:
        shell.stop()
    sys.exit(1 if failed else 0)


main()
