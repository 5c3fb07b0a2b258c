#!/usr/bin/env bash
# How many instructions a frame takes with a profile and without, as callgrind counts them: no clock is
# involved, so that a busy machine changes nothing. Usage: profile_instructions.sh PENUMBRA [SCENE]
set -euo pipefail
penumbra=$(realpath "$1")
scene=()
[ $# -lt 2 ] || scene=("$(realpath "$2")")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

# render FRAMES OPTION...: counts the instructions of rendering frames 1 to FRAMES; sets `all`, and `text`
# to those that turn the profile into the trace's text. Valgrind knows no AVX-512.
render() {
    local frames=$1
    shift
    valgrind --tool=callgrind --callgrind-out-file=callgrind.out "$penumbra" render "${scene[@]}" \
        --size 640x360 -f "1-$frames" -o 'x.####.exr' --compression none --isa avx2 --trace-isa avx2 \
        --threads 1 --progress none "$@" >log 2>&1 || { cat log >&2; exit 1; }
    all=$(sed -nE 's/.*Collected : ([0-9]+).*/\1/p' log)
    text=$(callgrind_annotate --inclusive=yes --threshold=100 callgrind.out |
        sed -nE 's/^ *([0-9,]+) .*penumbra::profile::chrome_trace.*/\1/p' | head -n 1 | tr -d ,)
    text=${text:-0}
}

# The difference of two runs is a frame: what precedes and follows the frames cancels out.
render 1
one=$all
render 2
without=$((all - one))
render 1 --trace trace.json
one=$((all - text))
render 2 --trace trace.json
with=$((all - text - one))
echo "a frame without a profile: $without instructions, with one: $with"
awk "BEGIN { printf \"%.3f %% more\\n\", 100 * ($with - $without) / $without }"
