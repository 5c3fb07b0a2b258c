"""The page that `penumbra diff --html` writes, in a headless Chromium: every control is used, and
what the screen shows is compared with what it should show. Usage: diff_page_test.py PENUMBRA
"""

import os
import subprocess

import page_test
from page_test import check
from pictures import write_exr, write_png

WIDTH, HEIGHT = 320, 160
RED, GREEN, BLACK = (255, 0, 0), (0, 255, 0), (0, 0, 0)
SPOT = (200, 72)  # the pixel in the middle of what differs: 16 x 16 around it


def in_spot(x, y):
    return abs(x - SPOT[0]) <= 8 and abs(y - SPOT[1]) <= 8


def write_images():
    """a.exr: red, with a green spot in the test, and a depth that differs elsewhere. b.png: equal.
    c.png: of other sizes. d.exr is like a.exr."""
    for folder in ("ref", "test"):
        os.mkdir(folder)
    for name in ("a.exr", "d.exr"):
        for folder in ("ref", "test"):
            def green(x, y, has_spot=folder == "test"):
                return 1.0 if has_spot and in_spot(x, y) else 0.0
            write_exr(f"{folder}/{name}", WIDTH, HEIGHT, {
                "R": lambda x, y: 1.0 - green(x, y), "G": green, "B": lambda x, y: 0.0,
                "Z": lambda x, y: 5.0 if folder == "test" and y < 4 else 1.0})
    for folder, size in (("ref", 16), ("test", 17)):
        write_png(f"{folder}/b.png", 32, 32, lambda x, y: (7 * x, 7 * y, 99))
        write_png(f"{folder}/c.png", size, 16, lambda x, y: (x, y, 0))


class Page:
    """The report, seen through its first viewer that is not hidden."""

    VIEWER = "section:first-of-type .viewer:not([hidden])"

    def __init__(self, browser):
        self.browser = browser

    def click(self, button):
        self.browser.click(f"{self.VIEWER} {button}")

    def stage(self):
        return self.browser.box(f"{self.VIEWER} .stage")

    def scale(self):
        """Screen pixels per pixel of the picture."""
        box = self.browser.box(f"{self.VIEWER} .stage img")
        return box[2] / WIDTH

    def place_of(self, pixel, picture="img"):
        """Where the middle of a picture's pixel is on the screen."""
        left, top, width, height = self.browser.box(f"{self.VIEWER} .stage {picture}")
        return left + (pixel[0] + 0.5) * width / WIDTH, top + (pixel[1] + 0.5) * height / HEIGHT

    def colour_at(self, pixel, picture="img"):
        return self.browser.pixel(*self.place_of(pixel, picture))

    def tags(self):
        return self.browser.run("return [...document.querySelectorAll(arguments[0])]"
                                ".map(e => e.textContent)", f"{self.VIEWER} .stage .tag")

    def pressed(self):
        return self.browser.run("return [...document.querySelectorAll(arguments[0])]"
                                ".map(e => e.textContent)",
                                f"{self.VIEWER} button[aria-pressed=true]")

    def focus(self):
        self.browser.run("document.querySelector(arguments[0]).focus()", f"{self.VIEWER} .stage")


def near(a, b, tolerance=1.0):
    return abs(a - b) <= tolerance


def check_sections(browser):
    titles = browser.run("return [...document.querySelectorAll('section h2')].map(e => e.textContent)")
    check("failed pairs come first", titles == ["failed a.exr", "failed c.png", "failed d.exr",
                                                "passed b.png"])
    summary = browser.run("return document.querySelector('p').textContent")
    check("the summary counts them", "3 failed" in summary and "1 passed" in summary)
    check("a pair of other sizes says so", browser.run(
        "return document.querySelectorAll('section')[1].querySelector('li').textContent")
        .startswith("size "))
    cells = browser.run("return [...document.querySelectorAll('section:first-of-type th')]"
                        ".map(e => e.textContent)")
    check("the table names the metrics", cells[:3] == ["layer", "max", "mae"])


def check_flip(page):
    check("it begins with the reference", page.tags() == ["reference"] and page.pressed() == ["Flip"])
    check("which is seen", page.colour_at(SPOT) == RED)
    page.click(".swap")
    check("Swap shows the test", page.tags() == ["test"] and page.colour_at(SPOT) == GREEN)
    check("and nothing else has changed", page.colour_at((20, 100)) == RED)
    page.browser.click_at(*page.place_of((20, 100)))
    check("a click on the picture swaps back", page.tags() == ["reference"])
    page.focus()
    page.browser.press(" ")
    check("the space bar swaps", page.tags() == ["test"])
    page.click(".auto")
    check("Blink is on", page.pressed() == ["Flip", "Blink"])
    for name in ("reference", "test"):
        page.browser.wait_for(lambda: page.tags() == [name], f"blinking to the {name}")
    page.click(".auto")
    check("Blink is off", page.pressed() == ["Flip"])


def check_slider(page):
    page.click("[data-mode=slider]")
    left, top, width, height = page.stage()
    check("the slider has both", page.tags() == ["reference", "test"])
    spot_x = page.place_of(SPOT)[0]
    divider = page.browser.box(f"{page.VIEWER} .divider")
    middle = divider[0] + divider[2] / 2
    check("it begins in the middle", near(middle, left + width / 2, 2))
    page.browser.drag((middle, top + 200), (spot_x - 60, top + 200))
    check("right of the divider is the test", page.colour_at(SPOT) == GREEN)
    page.browser.drag((spot_x - 60, top + 200), (spot_x + 60, top + 200))
    check("left of it is the reference", page.colour_at(SPOT) == RED)
    page.browser.drag((spot_x + 60, top + 200), (1, top + 200))
    divider = page.browser.box(f"{page.VIEWER} .divider")
    check("it stays within the stage", near(divider[0] + divider[2] / 2, left, 2))


def check_side_and_heat(page):
    page.click("[data-mode=side]")
    halves = ".half:nth-child(1) img", ".half:nth-child(2) img"
    check("side by side", [page.colour_at(SPOT, half) for half in halves] == [RED, GREEN])
    left, _, width, _ = page.stage()
    check("each in its half", page.place_of(SPOT, halves[0])[0] < left + width / 2 <
          page.place_of(SPOT, halves[1])[0])
    page.click("[data-mode=heat]")
    check("the error map is black where nothing differs", page.colour_at((20, 100)) == BLACK)
    check("and bright where something does", sum(page.colour_at(SPOT)) > 300)
    page.click("[data-mode=flip]")


def check_zoom(page):
    left, top, width, height = page.stage()
    page.click(".fit")
    fitting = page.scale()
    check("Fit shows all of it", near(fitting, min(width / WIDTH, height / HEIGHT), 0.02))
    page.click(".one")
    check("1:1 is one to one", near(page.scale(), 1, 0.001))
    page.click(".in")
    check("Zoom in doubles", near(page.scale(), 2, 0.001))
    page.click(".out")
    check("Zoom out halves", near(page.scale(), 1, 0.001))
    check("the number says so", page.browser.run(
        "return document.querySelector(arguments[0]).textContent",
        f"{page.VIEWER} .percent") == "100 %")
    page.focus()
    page.browser.press("+", "+", "-", "+")
    check("+ and - zoom", near(page.scale(), 4, 0.001))
    check("large pixels have edges", page.browser.run(
        "return getComputedStyle(document.querySelector(arguments[0])).imageRendering",
        f"{page.VIEWER} .stage img") == "pixelated")
    page.browser.press("0")
    check("0 fits", near(page.scale(), fitting, 0.001))
    below = page.place_of(SPOT)
    page.browser.scroll(*below, -400)
    page.browser.wait_for(lambda: page.scale() > 2 * fitting, "the wheel's zoom")
    after = page.place_of(SPOT)
    check("the wheel zooms by e in 400", near(page.scale() / fitting, 2.71828, 0.01))
    check("about the pixel below it", near(after[0], below[0], 2) and near(after[1], below[1], 2))
    page.browser.drag((left + 300, top + 200), (left + 250, top + 230))
    moved = page.place_of(SPOT)
    check("dragging moves the picture", near(moved[0], after[0] - 50, 2) and
          near(moved[1], after[1] + 30, 2))
    page.click(".fit")


def check_worst_tiles(page):
    figure = f"{page.VIEWER} .worst figure"
    caption = page.browser.run("return document.querySelector(arguments[0]).textContent",
                               f"{figure} figcaption")
    check("the worst tile is where the spot is", caption.startswith("(192, 64)"))
    small = page.browser.box(f"{figure} img")[2]
    page.click(".worst img")
    check("a click enlarges it", page.browser.box(f"{figure} img")[2] > 2 * small)
    page.click(".worst img")
    check("another one shrinks it", near(page.browser.box(f"{figure} img")[2], small))
    page.click(".worst .go")
    left, top, width, height = page.stage()
    x, y = page.place_of((224, 96))
    check("'Go there' brings its middle to the stage's", near(x, left + width / 2, 9) and
          near(y, top + height / 2, 9))
    check("eight times enlarged", near(page.scale(), 8, 0.001))
    page.click(".fit")


def check_layers(page):
    layer = "section:first-of-type select.layers"
    names = page.browser.run("return [...document.querySelector(arguments[0]).options]"
                             ".map(e => e.text)", layer)
    check("both layers can be chosen", names == ["beauty", "Z"])
    page.browser.click(layer)
    page.browser.press("Z", "Enter")
    page.browser.wait_until("return document.querySelector(arguments[0])?.complete",
                            f"{page.VIEWER} .stage img")
    check("one viewer is seen", page.browser.run(
        "return document.querySelectorAll(arguments[0]).length", page.VIEWER) == 1)
    page.click("[data-mode=heat]")
    check("it is the other layer's", sum(page.colour_at((100, 2))) > 300 and
          page.colour_at(SPOT) == BLACK)


def check_privacy(browser):
    requests = browser.requests()
    check("the page itself was asked for", any(url.startswith("file:") for url in requests))
    check("and nothing else but its own pictures",
          all(url.startswith(("file:", "data:")) for url in requests)
          and sum(url.startswith("file:") for url in requests) == 1)
    check("the page forbids requests", browser.run(
        "return fetch('http://127.0.0.1:9/').then(() => 'came', e => 'refused')") == "refused"
        and any("Content Security Policy" in text for text in browser.complaints()))


def check_page(browser, file):
    browser.open(file)
    page = Page(browser)
    browser.wait_until("return document.querySelector(arguments[0])?.complete",
                       f"{page.VIEWER} .stage img")
    check("pictures are not decoded before they are seen", browser.run(
        "return document.querySelectorAll('section:nth-of-type(3) .stage img').length") == 0)
    check_sections(browser)
    check_flip(page)
    check_slider(page)
    check_side_and_heat(page)
    check_zoom(page)
    check_worst_tiles(page)
    check_layers(page)
    check("the console has no errors", browser.complaints() == [])
    check_privacy(browser)


def make_report(penumbra):
    write_images()
    code = subprocess.run([penumbra, "diff", "ref", "test", "--html", "report.html"],
                          stdout=subprocess.DEVNULL, timeout=60).returncode
    check("the images differ", code == 1)


page_test.run("penumbra diff", make_report, lambda browser, *_: check_page(browser, "report.html"))
