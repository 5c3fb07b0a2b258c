"""How often `penumbra bench --compare` finds a pass that got slower by 5 %, and how often it reports
anything where nothing changed: in real runs, on this machine, as noisy as it is.

    compare_trials.py PENUMBRA SLOWED_BENCH [--trials 20] [--pass shade] [--launches 10] ...

Each trial measures an old report, an unchanged one and one of a program whose pass does real work
more, one after the other as a user would, and compares both with the old one.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile

SCENE = os.path.join(os.path.dirname(__file__), "../../data/scenes/teapot/teapot.json")


def launch(o, work, calls, out):
    subprocess.run([o.slowed_bench, o.scene, str(o.width), str(o.height), str(o.repetitions),
                    str(o.patience), o.slowed, str(work),
                    calls, out], check=True)
    with open(out) as file:
        return json.load(file)


def measure(o, work, calls, folder):
    """As `--launches` puts launches together: each pass's repetitions follow each other."""
    launches = [launch(o, work, calls, os.path.join(folder, "launch.json")) for _ in range(o.launches)]
    report = launches[0]
    families = {}
    for index, each in enumerate(launches):
        for entry in each["benchmarks"]:
            if entry["run_type"] == "iteration":
                families.setdefault(entry["name"], []).append({**entry, "launch": index})
    report["benchmarks"] = [entry for family in families.values() for entry in family]
    report["context"]["launches"] = o.launches
    return report


def lowest(report, name):
    return min(e["real_time"] for e in report["benchmarks"] if e["pass"] == name)


def work_for(o, calls, folder):
    """How many multiply-adds make the pass slower by that much: by trying very many."""
    many = 400000
    plain, slow = (lowest(measure(o, work, calls, folder), o.slowed) for work in (0, many))
    return round(many * plain * o.percent / 100 / (slow - plain))


def compare(o, old, new, folder):
    files = [os.path.join(folder, name) for name in ("old.json", "new.json", "comparison.json")]
    for file, report in zip(files, (old, new)):
        with open(file, "w") as out:
            json.dump(report, out)
    subprocess.run([o.penumbra, "bench", "--from", files[1], "--compare", files[0], "--json", files[2]],
                   check=True, stdout=subprocess.DEVNULL)
    with open(files[2]) as file:
        return json.load(file)["comparison"]["passes"]


def shown(passes):
    return ", ".join(f"{p['pass']} {100 * p['change']:+.1f} % ({p['verdict']})" for p in passes if p["verdict"]) or "-"


def options():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("penumbra")
    parser.add_argument("slowed_bench")
    parser.add_argument("--scene", default=SCENE)
    parser.add_argument("--trials", type=int, default=20)
    parser.add_argument("--launches", type=int, default=10)
    parser.add_argument("--repetitions", type=int, default=11)
    parser.add_argument("--patience", type=float, default=5, help="seconds per launch")
    parser.add_argument("--width", type=int, default=640)
    parser.add_argument("--height", type=int, default=360)
    parser.add_argument("--pass", dest="slowed", default="shade")
    parser.add_argument("--percent", type=float, default=5)
    parser.add_argument("--keep", help="a folder for the reports of all trials")
    return parser.parse_args()


def main():
    o = options()
    found = clean = 0
    with tempfile.TemporaryDirectory() as folder:
        calls = os.path.join(folder, "calls.json")
        launch(o, 0, "-", calls)
        work = work_for(o, calls, folder)
        print(f"{work} multiply-adds at the end of {o.slowed} are {o.percent} % of it", flush=True)
        for trial in range(o.trials):
            old, same, slow = (measure(o, w, calls, folder) for w in (0, 0, work))
            unchanged, slowed = compare(o, old, same, folder), compare(o, old, slow, folder)
            hit = [p for p in slowed if p["pass"] == o.slowed]
            found += hit[0]["verdict"] == "SLOWER"
            clean += all(p["verdict"] == "" for p in unchanged)
            print(f"trial {trial + 1}: unchanged: {shown(unchanged)}; slowed: {shown(slowed)} "
                  f"[{o.slowed} {100 * hit[0]['change']:+.1f} %, strength {hit[0]['strength']:.1f}]; "
                  f"found {found}, clean {clean}", flush=True)
            for name, report in (("old", old), ("same", same), ("slow", slow)) if o.keep else ():
                with open(os.path.join(o.keep, f"{name}{trial}.json"), "w") as out:
                    json.dump(report, out)
    print(f"found {found} of {o.trials}; nothing reported in {clean} of {o.trials} unchanged ones")
    return 0 if found >= 0.9 * o.trials and clean >= 0.95 * o.trials else 1


if __name__ == "__main__":
    sys.exit(main())
