#!/usr/bin/env bash
# Completions and the manual page: that they hold all that --help says, and that shells make of them
# what they should. Usage: completion_test.sh PATH_OF_PENUMBRA
source "$(dirname "${BASH_SOURCE[0]}")/harness.sh"
"$penumbra" completion bash >penumbra.bash
"$penumbra" completion zsh >_penumbra
"$penumbra" manual >penumbra.1

# commands: those that --help lists.
commands() { "$penumbra" --help | sed -n '/^Commands:/,/^$/s/^  \([a-z-]*\) .*/\1/p'; }
# options COMMAND: the names in its --help.
options() { "$penumbra" "$1" --help | grep -oE '^  -[^ ].*' | grep -oE '^  (-[a-z], )?--[a-z-]+' | tr -d ', ' | sed -E 's/^(-[a-z])(--)/\1\n\2/'; }

# ---- everything is there
holds_all_options() {
    local command option
    for command in $(commands); do
        for option in $(options "$command"); do
            grep -E "^        '$command'\) _penumbra_words" penumbra.bash | grep -qE -- "[ ']$option[ ']" ||
                { echo "  bash: $command $option"; return 1; }
            sed -n "/^_penumbra_$command()/,/^}/p" _penumbra | grep -qE -- "\)$option[+=]?\[|\*$option=\[" ||
                { echo "  zsh: $command $option"; return 1; }
            sed -n "/^\.SS penumbra $command\$/,/^\.SS/p" penumbra.1 |
                grep -qF -- "\\fB${option//-/\\-}\\fR" || { echo "  man: $command $option"; return 1; }
        done
    done
}
check "--help lists commands" test "$(commands | wc -l)" -ge 5
check "and their options" test "$(options diff | grep -c .)" -ge 10
check "every option of every command is in the completions and the manual page" holds_all_options
check "what was written before is the same" cmp penumbra.1 <("$penumbra" manual)
check "an unknown shell" refuses 2 "bash" "$penumbra" completion fish

# ---- bash
# completes LINE WORD...: at the end of the line bash offers exactly these words.
completes() {
    local line=$1 got
    shift
    got=$(bash --norc -c '
        source ./penumbra.bash
        compopt() { :; }
        read -ra COMP_WORDS <<<"${1//=/ = }"
        [[ $1 == *" " || $1 == *= ]] && COMP_WORDS+=("")
        [[ $1 == *= ]] && unset "COMP_WORDS[-1]"
        COMP_CWORD=$((${#COMP_WORDS[@]} - 1)) COMP_LINE=$1 COMP_POINT=${#1}
        _penumbra
        printf "%s\n" "${COMPREPLY[@]}" | sort | paste -s -d " "' bash "$line")
    local expected
    expected=$(printf '%s\n' "$@" | sort | paste -s -d ' ')
    [ "$got" = "$expected" ] || { echo "  \"$line\": expected \"$expected\", got \"$got\""; return 1; }
}
mkdir -p scenes/inner
touch scenes/a.json scenes/b.OBJ scenes/c.png scenes/d.exr "scenes/e f.json"
check "bash reads the script" bash -n penumbra.bash
check "bash: commands" completes "penumbra " $(commands)
check "bash: a command that was begun" completes "penumbra re" render
check "bash: options of the program" completes "penumbra --v" --version
check "bash: options of a command" completes "penumbra render --filter-r" --filter-radius
check "bash: words" completes "penumbra render --method s" stochastic
check "bash: words after =" completes "penumbra render --method=s" stochastic
check "bash: all words after =" completes "penumbra render --precision=" half float
check "bash: the first of a list" completes "penumbra render --aov be" beauty
check "bash: the last of a list" completes "penumbra render --aov beauty,mot" beauty,motion
check "bash: the name of an assignment" completes "penumbra diff --fail-above hdr" hdr-flip=
check "bash: nothing for numbers" completes "penumbra render --spp "
check "bash: scenes" completes "penumbra render scenes/" scenes/a.json scenes/b.OBJ "scenes/e f.json" scenes/inner
check "bash: after an option and its value" completes "penumbra render --spp 4 -o d.exr scenes/" \
    scenes/a.json scenes/b.OBJ "scenes/e f.json" scenes/inner
check "bash: files of an option's format" completes "penumbra render -o scenes/" scenes/d.exr scenes/inner
check "bash: pictures, at both places" completes "penumbra diff scenes/d.exr scenes/" scenes/c.png scenes/d.exr scenes/inner
check "bash: no third picture" completes "penumbra diff a.exr b.exr scenes/"
check "bash: shells" completes "penumbra completion " bash zsh
check "bash: names of commands are no commands later on" completes "penumbra completion bash ren"

# ---- zsh
if command -v zsh >/dev/null; then
    check "zsh reads the script" zsh -n _penumbra
    # Types into a real zsh: completion widgets run nowhere else.
    check "zsh completes" python3 "$source_dir/tests/cli/zsh_completion.py" "$PWD"
else
    skip "zsh completion: zsh is not installed"
fi

# ---- man
if command -v groff >/dev/null; then
    without_warnings() { [ -z "$(groff -ww -man -Tutf8 -z penumbra.1 2>&1)" ]; }
    check "groff has nothing to say against the manual page" without_warnings
else
    skip "the manual page: groff is not installed"
fi
finish
