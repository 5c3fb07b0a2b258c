#!/usr/bin/env bash
# `penumbra bench` and the traces of it and of `penumbra render`, as scripts and other tools meet them.
source "$(dirname "${BASH_SOURCE[0]}")/harness.sh"
folder=$source_dir/tests/cli

write_quads quad.obj
cat >shot.json <<'JSON'
{
    "film": { "size": [320, 192] },
    "camera": { "eye": [0, 2, 3], "target": [0, 0, 0], "vfov": 40 },
    "models": [ { "name": "quads", "file": "quad.obj" } ],
    "lights": [ { "name": "key", "type": "rect", "center": [0, 2, 0], "u": [0.5, 0, 0], "v": [0, 0, 0.5],
                  "radiance": [10, 9, 8] } ],
    "animation": { "fps": 24, "frames": [1, 3] }
}
JSON
sed 's/"lights": \[.*/"lights": [ ],/; /"radiance"/d' shot.json >dark.json

bench() { "$penumbra" bench "$@" --repetitions 2 --warmup 1 --patience 0 >stdout 2>stderr; }
holds() { local file=$1 text; shift; for text in "$@"; do grep -qF -- "$text" "$file" || { echo "  not in $file: $text"; return 1; }; done; }

# ---- the table and its files
check "a bench of a scene and a model" bench shot.json quad.obj --size 96x64 --threads 2,1,2 --json b.json --csv b.csv --trace t.json
check "prints a table" holds stdout "shot, frame 1: 96 x 64" "quad, frame 1: 96 x 64" "1 thread " "2 threads" "of limit" \
    "Mpixel/s" "Mray/s" "GB/s" "rasterize" "visibility" "primary rays" "peak memory" "hardware counters: " "speed-up"
check "says nothing on stderr" test ! -s stderr
check "the CSV has a line per scene, threads and pass" test "$(wc -l <b.csv)" -eq $((1 + 2 * 2 * 15))
same_width() { awk -F, 'NR == 1 { n = NF } NF != n { bad = 1; print "  " $0 } END { exit bad }' b.csv; }
check "with as many cells each as names" same_width
check "without a scene it takes the built-in one" bench --size 64x64 --threads 1
check "and says so" holds stdout "built-in, frame 1"
check "a scene without lights has no rays" bench dark.json --size 64x64 --threads 2
check "and still its other passes" holds stdout "0 lights, 0.00 Mray" "filter"
check "another frame" bench shot.json --size 64x64 --threads 1 --frame 3 --spp 4
check "is measured" holds stdout "frame 3"

# ---- Google Benchmark's format
json_structure() {
    python3 - b.json <<'PYTHON'
import json, sys
report = json.load(open(sys.argv[1]))
context, entries = report["context"], report["benchmarks"]
for key in ("date", "host_name", "executable", "num_cpus", "mhz_per_cpu", "cpu_scaling_enabled", "caches",
            "load_avg", "library_build_type"):
    assert key in context, key
assert [s["name"] for s in context["scenes"]] == ["shot", "quad"]
families = {}
for e in entries:
    for key in ("name", "family_index", "per_family_instance_index", "run_name", "run_type", "repetitions",
                "threads", "iterations", "real_time", "cpu_time", "time_unit"):
        assert key in e, (key, e)
    assert e["time_unit"] == "ms" and e["repetitions"] == 2
    families.setdefault(e["run_name"], []).append(e)
assert len(families) == 2 * 2 * 15, len(families)
for name, members in families.items():
    runs = [e for e in members if e["run_type"] == "iteration"]
    assert [e["repetition_index"] for e in runs] == [0, 1] and all(e["name"] == name for e in runs)
    aggregates = {e["aggregate_name"]: e for e in members if e["run_type"] == "aggregate"}
    assert set(aggregates) == {"mean", "median", "stddev", "cv"}
    mean = sum(e["real_time"] for e in runs) / 2
    assert abs(aggregates["mean"]["real_time"] - mean) <= 1e-9 * mean
    for e in runs:
        if "limit" in e:
            assert abs(e["fraction_of_limit"] * e["real_time"] - e["limit_ms"]) <= 1e-9 * e["limit_ms"]
            assert 0 < e["limit_floor_ms"] <= e["limit_ms"] * (1 + 1e-6)
        assert e["core_share"] > 0 and e.get("floor_ms", 1) > 0
assert families["shot/threads:2/trace"][0]["rays_per_second"] > 0
assert "limit" not in families["shot/threads:1/evaluate"][0]
PYTHON
}
compare_tool=/usr/share/benchmark/compare.py
if command -v python3 >/dev/null; then
    check "the JSON has what Google Benchmark's has" json_structure
    if [ -e "$compare_tool" ] && /usr/bin/python3 -c 'import scipy' 2>/dev/null; then
        check "its compare.py reads it" bash -c \
            "/usr/bin/python3 $compare_tool benchmarks b.json b.json | grep 'quad/threads:2/filter_pvalue' >/dev/null"
    else
        skip "compare.py of libbenchmark-tools is not installed"
    fi
else
    skip "no python3"
fi

# ---- traces
trace_of_render() {
    "$penumbra" render shot.json -f 1-3 -o x.####.exr --threads 2 --trace r.json --stats s.json >stdout 2>stderr || return 1
    local milliseconds
    milliseconds=$(python3 -c 'import json; print(1e3 * sum(f["render_seconds"] for f in json.load(open("s.json"))["frames"]))')
    python3 "$folder/check_trace.py" r.json --wall-ms "$milliseconds" --slice frame
}
threads_of() { python3 -c 'import json, sys; print(len({e["tid"] for e in json.load(open(sys.argv[1]))["traceEvents"]}))' "$1"; }
tiles_with_places() {
    python3 - r.json <<'PYTHON'
import json, sys
slices = [e for e in json.load(open(sys.argv[1]))["traceEvents"] if e["ph"] == "X"]
places = {(e["args"]["x"], e["args"]["y"]) for e in slices if e["name"] == "rasterize" and e["cat"] == "pass"}
assert places == {(x, y) for x in range(0, 320, 64) for y in range(0, 192, 64)}, places
for name in ("resolve", "shade", "trace", "deposit"):
    assert sum(e["name"] == name and e["cat"] == "pass" for e in slices) == 3 * 15, name
stats = json.load(open("s.json"))
traced = sum(e["args"]["rays"] for e in slices if e["name"] == "trace" and e["cat"] == "pass")
assert traced == sum(f["shadow_rays"] for f in stats["frames"]), traced
for name in ("evaluate", "setup", "tiles", "noise", "filter"):
    assert sum(e["name"] == name and e["cat"] == "phase" for e in slices) == 3, name
PYTHON
}
# The passes stand in the report before what lies between them.
same_passes() {
    python3 - <<'PYTHON'
import json
names = list(dict.fromkeys(e["run_name"].split("/")[-1] for e in json.load(open("b.json"))["benchmarks"]))
passes = names[:names.index("other")]
frame = json.load(open("s.json"))["frames"][0]["passes"]
assert list(frame) == passes, (list(frame), passes)
slices = {(e["name"], e["cat"]) for e in json.load(open("r.json"))["traceEvents"] if e["ph"] == "X"}
for name in passes:
    kind = "phase" if frame[name]["clock"] == "wall" else "pass"
    assert frame[name]["seconds"] > 0 and (name, kind) in slices, name
PYTHON
}
if command -v python3 >/dev/null; then
    check "the trace of a bench is whole and nests" python3 "$folder/check_trace.py" t.json
    check "the trace of a render is, and agrees with the clock" trace_of_render
    check "with a track per thread" test "$(threads_of r.json)" -eq 2
    check "with every pass of every tile at its place" tiles_with_places
    check "a bench, the statistics and a trace name the same passes" same_passes
else
    skip "no python3"
fi
"$penumbra" render shot.json -f 1-3 -o y.####.exr --threads 2 --progress none
check "a trace changes no pixel" cmp x.0002.exr y.0002.exr

# ---- what is wrong
check "a scene that is not there" refuses 2 "nope.json" "$penumbra" bench nope.json
check "no threads" refuses 2 "--threads" "$penumbra" bench --threads 0
check "words for threads" refuses 2 "--threads" "$penumbra" bench --threads 1,two
check "an empty list" refuses 2 "--threads" "$penumbra" bench --threads ""
check "no repetitions" refuses 2 "--repetitions" "$penumbra" bench --repetitions 0
check "less patience than none" refuses 2 "--patience" "$penumbra" bench --patience -1
check "a size that is none" refuses 2 "--size" "$penumbra" bench --size 96
check "a size with more behind it" refuses 2 "--size" "$penumbra" bench --size 96x64x3
check "one file for two reports" refuses 2 "--csv" "$penumbra" bench --json b.txt --csv b.txt
check "a report on a model" refuses 2 ".csv" "$penumbra" bench shot.json --csv model.obj
check "a report on the scene" refuses 2 "--json" "$penumbra" bench shot.json --json shot.json
check "a folder that cannot be written" refuses 3 "/proc/b.json" "$penumbra" bench shot.json --size 64x64 --threads 1 \
    --repetitions 1 --patience 0 --json /proc/b.json
interrupted() {
    local status=0
    "$penumbra" bench shot.json --repetitions 100000 --json i.json >stdout 2>stderr &
    sleep 1
    kill -INT $!
    wait $! || status=$?
    [ "$status" -eq 130 ] && [ ! -e i.json ]
}
check "Ctrl-C ends with 130 and writes nothing" interrupted
check "--help explains every option" bash -c \
    "for o in --threads --warmup --repetitions --patience --frame --size --spp --isa --trace-isa --json --csv --trace; do
        '$penumbra' bench --help | grep -q -- \"\$o\" || { echo \"  \$o\"; exit 1; }
     done"

finish
