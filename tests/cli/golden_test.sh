#!/usr/bin/env bash
# The project's own golden images, at threshold 0: the same for each vector width and number of threads. After a
# change that is meant to be seen: penumbra check data/goldens --update. Usage: golden_test.sh PENUMBRA
source "$(dirname "${BASH_SOURCE[0]}")/harness.sh"
cd "$source_dir" || exit 1

# goldens_pass OPTION...: every check passes; what fails is said.
goldens_pass() {
    "$penumbra" check data/goldens "$@" >"$work/out" 2>&1 || {
        grep -v '^passed' "$work/out"
        return 1
    }
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

check "the goldens are what is rendered, on any processor" goldens_pass --reproducible
if grep -q GenuineIntel /proc/cpuinfo; then
    check "and without --reproducible" goldens_pass
    check "with 8 lanes and one thread" goldens_pass --isa avx2 --threads 1
    check "with more threads than tiles want" goldens_pass --threads 7 --jobs 1
    if grep -qw avx512bw /proc/cpuinfo && grep -qw avx512vl /proc/cpuinfo; then
        check "with 16 lanes" goldens_pass --isa avx512 --threads 2
    else
        skip "goldens with 16 lanes: this processor has no AVX-512"
    fi
else
    # Embree's approximate reciprocals are the processor maker's (docs/reproducibility.md).
    skip "goldens without --reproducible: they were made on a processor of Intel's"
    check "with 8 lanes and one thread" goldens_pass --reproducible --isa avx2 --threads 1
fi
check "every scene of data/scenes has a golden" has_checks_for_all_scenes
finish
