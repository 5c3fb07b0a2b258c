#!/usr/bin/env python3
"""Validates a trace against the trace event format and what penumbra promises of it.

check_trace.py TRACE.json [--wall-ms MS --slice NAME]

Every event has the keys its phase demands; times are finite and not negative; slices of a thread
nest; each thread has a name; its outermost slices, idle ones included, add up to the whole trace
within 2 %; no slice is left of those that were dropped. With --wall-ms, the slices called NAME add
up to that within 2 %. Prints one line per broken promise and ends with 1 if there is any.
"""

import argparse
import json
import math
import sys

TOLERANCE = 0.02
ROUNDING = 1e-3 + 1e-9  # microseconds: one digit of the file


def number(value):
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


def check_event(event):
    """What is wrong with one event, if anything."""
    for key in ("name", "ph", "pid", "tid"):
        if key not in event:
            return f"no {key}: {event}"
    if not isinstance(event["name"], str) or not event["name"]:
        return f"no name: {event}"
    if event["ph"] == "M":
        if event["name"] not in ("process_name", "thread_name", "thread_sort_index"):
            return f"unknown metadata: {event}"
        return None if isinstance(event.get("args"), dict) else f"metadata without args: {event}"
    if event["ph"] != "X":
        return f"unknown phase: {event}"
    for key in ("ts", "dur"):
        if not number(event.get(key)) or event[key] < 0:
            return f"{key} is no time: {event}"
    if event.get("cat") not in ("phase", "loop", "task", "pass", "idle"):
        return f"unknown category: {event}"
    if not isinstance(event.get("args", {}), dict):
        return f"args are no object: {event}"
    return None


def check_nesting(slices):
    """Slices in the file's order; yields what breaks nesting or order, and returns the outermost."""
    problems, outermost, stack, last = [], [], [], -1.0
    for event in slices:
        begin, end = event["ts"], event["ts"] + event["dur"]
        if begin < last - ROUNDING:
            problems.append(f"begins before the one before it: {event}")
        last = begin
        while stack and stack[-1] <= begin + ROUNDING:
            stack.pop()
        if stack and end > stack[-1] + 2 * ROUNDING:
            problems.append(f"ends after the slice that holds it: {event}")
        if not stack:
            outermost.append(event)
        if event["dur"] > 0:
            stack.append(end)
    return problems, outermost


def check_threads(events):
    problems = []
    slices = [e for e in events if e["ph"] == "X"]
    if not slices:
        return ["no slices"]
    begin = min(e["ts"] for e in slices)
    whole = max(e["ts"] + e["dur"] for e in slices) - begin
    named = {e["tid"] for e in events if e["ph"] == "M" and e["name"] == "thread_name"}
    for thread in sorted({e["tid"] for e in slices} | named):
        own = [e for e in slices if e["tid"] == thread]
        if thread not in named:
            problems.append(f"thread {thread} has no name")
        broken, outermost = check_nesting(own)
        problems += broken
        total = sum(e["dur"] for e in outermost)
        if abs(total - whole) > TOLERANCE * whole:
            problems.append(f"thread {thread}: slices of {total} of {whole} microseconds")
    return problems


def check(trace, wall_ms=None, name="frame"):
    if not isinstance(trace, dict) or not isinstance(trace.get("traceEvents"), list):
        return ["no traceEvents"]
    events = trace["traceEvents"]
    problems = [p for p in map(check_event, events) if p]
    if problems:
        return problems
    problems = check_threads(events)
    if trace.get("otherData", {}).get("dropped_slices") != 0:
        problems.append("slices were dropped")
    if wall_ms is not None:
        total = 1e-3 * sum(e["dur"] for e in events if e["ph"] == "X" and e["name"] == name)
        if abs(total - wall_ms) > TOLERANCE * wall_ms:
            problems.append(f"{name}: {total} ms in the trace, {wall_ms} ms on the clock")
    return problems


def self_test():
    """Each kind of damage must be found."""
    def trace(*slices, **changes):
        events = [{"name": "thread_name", "ph": "M", "pid": 1, "tid": 0, "args": {"name": "worker 0"}}]
        for begin, end in slices:
            events.append({"name": "s", "cat": "pass", "ph": "X", "ts": begin, "dur": end - begin,
                           "pid": 1, "tid": 0} | changes)
        return {"traceEvents": events, "otherData": {"dropped_slices": 0}}

    assert not check(trace((0, 10), (2, 5), (5, 9), (10, 12)))
    assert check(trace((0, 10), (2, 11)))
    assert check(trace((5, 10), (0, 5)))
    assert check(trace((0, 10), (11, 20)))
    assert check(trace((0, 10), ph="B"))
    assert check(trace((0, 10), ts=float("nan")))
    assert check(trace((0, 10), dur=-1))
    assert check(trace((0, 10), cat="other"))
    assert check(trace((0, 10), tid=1))
    assert check(trace())
    assert check({})
    assert not check(trace((0, 1000)), wall_ms=1, name="s")
    assert check(trace((0, 1000)), wall_ms=1.1, name="s")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("trace")
    parser.add_argument("--wall-ms", type=float)
    parser.add_argument("--slice", default="frame")
    options = parser.parse_args()
    self_test()
    with open(options.trace, encoding="utf-8") as file:
        problems = check(json.load(file), options.wall_ms, options.slice)
    for problem in problems[:20]:
        print(problem)
    sys.exit(1 if problems else 0)


if __name__ == "__main__":
    main()
