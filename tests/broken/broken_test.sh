#!/usr/bin/env bash
# `penumbra check` notices a renderer that is broken, in the goldens and at their thresholds, and what fails is a
# difference. Usage: broken_test.sh PENUMBRA BROKEN_PENUMBRA...
source "$(dirname "${BASH_SOURCE[0]}")/../cli/harness.sh"
broken=()
for program in "${@:2}"; do broken+=("$(cd "$OLDPWD" && realpath "$program")"); done
cd "$source_dir" || exit 1

# is_caught PROGRAM: the check fails because pictures differ, not because rendering failed.
is_caught() {
    local status=0
    "$penumbra" check data/goldens --reproducible --renderer "$1" >"$work/out" 2>&1 || status=$?
    if [ "$status" -ne 1 ] || ! grep -q '^failed ' "$work/out" ||
        grep -qE '^(error|missing|unfit)' "$work/out"; then
        echo "  $(basename "$1"): exit code $status"
        tail -n 5 "$work/out"
        return 1
    fi
    echo "  $(basename "$1"): $(grep -c '^failed ' "$work/out") of $(grep -c ' s  data' "$work/out") checks differ"
}

for program in "${broken[@]}"; do
    check "$(basename "$program") is caught" is_caught "$program"
done
check "there were broken renderers" [ "${#broken[@]}" -ge 4 ]
finish
