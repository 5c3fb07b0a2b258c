"""The page that `penumbra check --html` writes, in a headless Chromium: every control of its own is
used; the viewers are those of `penumbra diff` (diff_page_test.py). Usage: check_page_test.py PENUMBRA
"""

import json
import os
import subprocess

import page_test
from page_test import check

QUADS = """v -1 0 -1
v 1 0 -1
v 1 0 1
v -1 0 1
v -0.3 0.3 -0.3
v 0.3 0.3 -0.3
v 0.3 0.3 0.3
v -0.3 0.3 0.3
f 4 3 2 1
f 8 7 6 5
"""


def write_scene(name, radiance):
    with open("quads.obj", "w", encoding="utf-8") as file:
        file.write(QUADS)
    scene = {"film": {"size": [96, 64]},
             "camera": {"eye": [0, 2, 3], "target": [0, 0, 0], "vfov": 40},
             "models": [{"file": "quads.obj"}],
             "lights": [{"name": "key", "type": "rect", "center": [0, 2, 0], "u": [0.5, 0, 0],
                         "v": [0, 0, 0.5], "radiance": radiance}]}
    for path, content in ((f"{name}.json", scene), (f"{name}.check.json", {})):
        with open(path, "w", encoding="utf-8") as file:
            json.dump(content, file)


def run_check(penumbra, *options):
    return subprocess.run([penumbra, "check", ".", *options], stdout=subprocess.PIPE,
                          stderr=subprocess.DEVNULL, timeout=60, check=False, text=True)


def make_report(penumbra):
    """equal passes, changed and 'it's changed' fail, broken is an error, fresh has no golden."""
    for name in ("equal", "changed", "it's changed"):
        write_scene(name, [0.1 * len(name), 0.4, 0.2])
    check("goldens are made", run_check(penumbra, "--bless-missing").returncode == 0)
    write_scene("changed", [0.7, 0.9, 0.2])
    write_scene("it's changed", [1.2, 0.4, 0.9])
    write_scene("fresh", [1, 1, 5])
    write_scene("broken", [1])
    report = run_check(penumbra, "--html", "report.html")
    check("the gravest verdict wins", report.returncode == 2)
    return report.stdout.rstrip().split("\n")[-1].strip()


def texts(browser, selector):
    return browser.run("return [...document.querySelectorAll(arguments[0])]"
                       ".filter(e => e.offsetParent !== null).map(e => e.textContent)", selector)


def check_sections(browser):
    check("what failed comes first", texts(browser, ".check h2") == [
        "error broken", "failed changed", "failed it's changed", "missing fresh", "passed equal"])
    check("the error says why", "lights[0].radiance" in texts(browser, ".check p")[0])
    pictures = browser.run("return [...document.querySelectorAll('figure.render img')]"
                           ".map(e => e.naturalWidth)")
    check("what passed and what has no golden is seen", pictures == [96, 96])


def check_glance(browser):
    names = texts(browser, ".check:nth-of-type(2) .glance figcaption")
    check("golden, new and difference at a glance", names == ["golden", "new", "difference"])
    widths = browser.run("return [...document.querySelectorAll('.glance img')]"
                         ".map(e => [e.complete, e.naturalWidth])")
    check("for each that failed", widths == 6 * [[True, 96]])
    browser.run("document.querySelector('.check:nth-of-type(2) .glance').scrollIntoView()")
    colours = []
    for figure in (1, 2, 3):
        left, top, width, height = browser.box(
            f".check:nth-of-type(2) .glance figure:nth-child({figure}) img")
        colours.append(browser.pixel(left + width / 2, top + height * 0.4))
    check("the new picture is another one", colours[0] != colours[1])
    check("the difference shows it", sum(colours[2]) > 60)
    browser.click(".check:nth-of-type(2) .glance figure:nth-child(3)")
    tags = ".check:nth-of-type(2) .stage .tag"
    browser.wait_until("return document.querySelector(arguments[0])?.textContent === 'difference'",
                       tags)
    check("a click opens the difference", texts(browser, tags) == ["difference"])
    browser.click(".check:nth-of-type(2) .glance figure:nth-child(1)")
    browser.wait_until("return document.querySelectorAll(arguments[0]).length === 2", tags)
    check("or golden and new side by side", texts(browser, tags) == ["golden", "new"])


def check_filters(browser):
    def toggle(verdict):
        browser.click(f".filter button[data-verdict={verdict}]")

    check("a button per verdict", texts(browser, ".filter button") == [
        "1 error", "2 failed", "1 missing", "1 passed"])
    toggle("passed")
    toggle("error")
    check("buttons hide verdicts", texts(browser, ".check h2") == [
        "failed changed", "failed it's changed", "missing fresh"])
    browser.click(".filter input")
    browser.press("i", "t")
    check("the field finds names", texts(browser, ".check h2") == ["failed it's changed"])
    browser.run("const e = document.querySelector('.filter input'); e.value = '';"
                "e.dispatchEvent(new Event('input'))")
    toggle("passed")
    toggle("error")
    check("all come back", len(texts(browser, ".check h2")) == 5)


def check_commands(browser, penumbra, printed):
    commands = texts(browser, ".command code")
    check("the first command is the one on the console", commands[0] == printed)
    check("each that can be accepted has its own", len(commands) == 4)
    browser.run("scrollTo(0, 0)")
    browser.click(".command .copy")
    browser.wait_until("return document.querySelector('.copy').textContent !== 'Copy'")
    check("the button copies", texts(browser, ".copy")[0] == "Copied")
    browser.click(".filter input")
    browser.press_with("Control", "v")
    pasted = browser.run("return document.querySelector('.filter input').value")
    check("what is pasted is the command", pasted == printed)
    own = [command for command in commands[1:] if "it's" in command.replace("'\\''", "'")]
    check("names are quoted", len(own) == 1)
    os.remove("broken.json")
    os.remove("broken.check.json")
    subprocess.run(own[0], shell=True, stdout=subprocess.DEVNULL, timeout=60, check=False)
    listing = run_check(penumbra).stdout
    check("a check's own command accepts it alone", "1 failed" in listing and "1 missing" in listing)
    done = subprocess.run(printed, shell=True, stdout=subprocess.DEVNULL, timeout=60, check=False)
    check("the first one accepts all", done.returncode == 0)
    check("then all pass", run_check(penumbra).returncode == 0)


def check_privacy(browser):
    requests = browser.requests()
    check("the page asks for nothing but itself",
          sum(url.startswith("file:") for url in requests) == 1
          and all(url.startswith(("file:", "data:")) for url in requests))


def check_page(browser, penumbra, printed):
    browser.open("report.html")
    browser.wait_until("return document.querySelector('.stage img')?.complete")
    check_sections(browser)
    check_glance(browser)
    check_filters(browser)
    check_commands(browser, penumbra, printed)
    check_privacy(browser)
    check("the console has no errors", browser.complaints() == [])


page_test.run("penumbra check", make_report, check_page)
