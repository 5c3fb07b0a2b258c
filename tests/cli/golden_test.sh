#!/usr/bin/env bash
# The project's own golden images. With --reproducible they are matched to the last bit by every processor, vector
# width and number of threads. Without it Embree's occluded bit may differ for one ray in a million from maker to maker
# (docs/reproducibility.md): such a ray may be seen, anything more not. After a change that is meant to be seen:
# penumbra check data/goldens --reproducible --update. Usage: golden_test.sh PENUMBRA [all|widths]   (widths: only
# once with each vector width)
source "$(dirname "${BASH_SOURCE[0]}")/harness.sh"
cd "$source_dir" || exit 1

# goldens_pass OPTION...: every check passes; what fails is said.
goldens_pass() {
    "$penumbra" check data/goldens "$@" >"$work/out" 2>&1 || {
        grep -v '^passed' "$work/out"
        return 1
    }
}
# rendered FOLDER OPTION...: the new pictures are in the folder, whatever they look like.
rendered() {
    local folder=$1 status=0
    shift
    "$penumbra" check data/goldens --output "$folder" "$@" >"$work/out" 2>&1 || status=$?
    [ "$status" -le 1 ]
}
same_pictures() { "$penumbra" diff "$1" "$2" >"$work/out" || { grep -v '^same' "$work/out"; return 1; }; }
differ_by_single_rays() {
    local golden name render all=0
    for golden in data/goldens/*.exr; do
        name=$(basename "$golden")
        render=$1/${name/.golden/}
        [ -e "$render" ] || render=$(ls "${render%.exr}".*.exr)
        "$penumbra" diff "$golden" "$render" --fail-above rmse=0.01 --fail-above share=0.05 >"$work/out" || {
            cat "$work/out"
            all=1
        }
    done
    return $all
}
has_checks_for_all_scenes() {
    local scene missing=0
    for scene in data/scenes/*/*.json; do
        grep -qF "../scenes/${scene#data/scenes/}" data/goldens/*.check.json || {
            echo "  no check renders $scene"
            missing=1
        }
    done
    return $missing
}

check "the goldens are what is rendered" goldens_pass --reproducible
check "with 8 lanes and one thread" goldens_pass --reproducible --isa avx2 --threads 1
if [ "${2:-all}" = widths ]; then
    finish
    exit
fi
if grep -qw avx512bw /proc/cpuinfo && grep -qw avx512vl /proc/cpuinfo; then
    check "with 16 lanes and seven threads" goldens_pass --reproducible --isa avx512 --threads 7 --jobs 1
else
    skip "goldens with 16 lanes: this processor has no AVX-512"
fi
check "without --reproducible they render" rendered "$work/one"
check "and differ by single rays at most" differ_by_single_rays "$work/one"
check "with other lanes and threads" rendered "$work/other" --isa avx2 --threads 3 --jobs 1
check "to the same bits" same_pictures "$work/one" "$work/other"
check "every scene of data/scenes has a golden" has_checks_for_all_scenes
finish
