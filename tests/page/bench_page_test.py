"""The page that `penumbra bench --html` writes, in a headless Chromium. Usage: bench_page_test.py PENUMBRA"""

import json
import os
import subprocess

import page_test
from page_test import check


def entry(scene, threads, name, launch, milliseconds):
    frame = name == "frame"
    return {"name": f"{scene}/threads:{threads}/{name}", "run_type": "iteration", "threads": threads,
            "real_time": milliseconds, "cpu_time": threads * milliseconds, "time_unit": "ms", "scene": scene,
            "pass": name, "clock": "wall", "limit": "sum" if frame else "primary rays", "launch": launch,
            "limit_ms": milliseconds / 2 * (1 + 0.001 * launch)}


def write_report(file, slower):
    """Two scenes on 1 and 2 threads; `resolve` takes that many times as long."""
    scenes = ["room", "<b>attic</b>"]
    context = {"date": "2026-01-02", "host_name": "farm", "num_cpus": 2, "mhz_per_cpu": 2600,
               "cpu_scaling_enabled": False, "caches": [], "load_avg": [0.1], "software": "penumbra 0.1.0",
               "processor": "AMD EPYC", "kernel_isa": "avx2", "trace_isa": "avx2", "hardware_counters": "none",
               "warmups": 1, "repetitions": 1, "launches": 8,
               "scenes": [{"name": s, "path": s + ".json", "frame": 1, "width": 64, "height": 32,
                           "samples_per_pixel": 1, "triangles": 9, "lights": 1, "shadow_rays": 5,
                           "covered_pixels": 1024, "peak_memory_bytes": 1 << 20} for s in scenes]}
    entries = []
    for scene in scenes:
        for threads in (1, 2):
            for name, time in (("rasterize", 8), ("resolve", 4), ("frame", 20)):
                for launch in range(8):
                    e = entry(scene, threads, name, launch, time / threads * (1 + 0.002 * (launch * 5 % 8)))
                    e["real_time"] *= slower if name == "resolve" else 1
                    entries.append(e)
    with open(file, "w") as out:
        json.dump({"context": context, "benchmarks": entries}, out)


def visible(browser, selector):
    return browser.run("return [...document.querySelectorAll(arguments[0])]"
                       ".filter(e => e.offsetParent !== null).length", selector)


def texts(browser, selector):
    return browser.run("return [...document.querySelectorAll(arguments[0])].map(e => e.textContent)", selector)


def check_scenes(browser):
    check("names are text, not markup", texts(browser, "main h2") == ["room", "<b>attic</b>"])
    check("one scene is seen", visible(browser, "main > section") == 1)
    browser.click("label[for=choose1]")
    check("the other one after a click", browser.run(
        "return document.querySelector('#scene1').offsetParent !== null && "
        "document.querySelector('#scene0').offsetParent === null"))
    browser.click("label[for=choose0]")


def check_charts(browser):
    labels = texts(browser, "#scene0 svg[aria-label=speed-up] text")
    check("the curves have names", all(n in labels for n in ("ideal", "rasterize", "resolve", "frame", "threads")))
    check("speed-up and efficiency", texts(browser, "#scene0 svg .title") == ["speed-up", "efficiency"])
    bars = browser.run("return [...document.querySelectorAll(\"#scene0 details[open] svg[aria-label$=': passes'] "
                       "rect\")].map(e => e.getBoundingClientRect().width)")
    check("a bar per pass, as long as its time", len(bars) == 2 and abs(bars[0] / bars[1] - 8 / 4.8) < 0.05)
    limit = browser.run("return document.querySelector('#scene0 details[open] line.limit')"
                        ".getBoundingClientRect().left")
    bar = browser.run("const b = document.querySelector('#scene0 details[open] rect.bar').getBoundingClientRect();"
                      "return [b.left, b.right]")
    check("the limit's mark is at half of its bar", abs((limit - bar[0]) / (bar[1] - bar[0]) - 0.5) < 0.03)
    check("the fewer threads are folded", browser.run(
        "return [...document.querySelectorAll('#scene0 details')].map(e => e.open)") == [False, True])


def check_comparison(browser):
    found = texts(browser, "li.failed")
    check("what got slower is said, for both scenes and numbers of threads",
          len(found) == 4 and all("resolve: slower by 20" in text for text in found))
    check("and drawn", browser.run("return document.querySelectorAll('#scene0 circle.slower').length") == 2)


def check_privacy(browser):
    check("nothing is asked for but the page",
          [url for url in browser.requests() if not url.startswith("file:")] == [])
    check("there is no script", browser.run("return document.scripts.length") == 0)
    check("the console has no errors", browser.complaints() == [])
    wide = browser.run("return document.documentElement.scrollWidth <= document.documentElement.clientWidth")
    check("nothing is wider than the window", wide)


def make_report(penumbra):
    write_report("old.json", 1)
    write_report("new.json", 1.2)
    result = subprocess.run([penumbra, "bench", "--from", "new.json", "--compare", "old.json", "--fail-slower",
                             "10", "--html", "page.html"], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    check("beyond what is allowed it exits with 1", result.returncode == 1)
    check("and says which pass", b"room/threads:1/resolve: 20" in result.stderr)


def check_page(browser, *_):
    browser.open(os.path.abspath("page.html"))
    check_scenes(browser)
    check_charts(browser)
    check_comparison(browser)
    check_privacy(browser)


page_test.run("penumbra bench", make_report, check_page)
