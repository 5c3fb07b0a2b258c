#!/usr/bin/env bash
# Builds and runs every test: warnings as errors, first optimised, then under AddressSanitizer and
# UndefinedBehaviorSanitizer. Usage: tests/run.sh [--quick]   (--quick leaves the sanitizers out)
set -euo pipefail
cd "$(dirname "$0")/.."
source cmake/packages.sh

quick=false
case "${1:-}" in
    "") ;;
    --quick) quick=true ;;
    *) echo "usage: tests/run.sh [--quick]" >&2; exit 2 ;;
esac

install_packages "${PENUMBRA_BUILD_PACKAGES[@]}" "${PENUMBRA_TEST_PACKAGES[@]}"

passed=0
failed=0
skipped=0
logs=$(mktemp -d)
trap 'rm -rf "$logs"' EXIT

# count LOG STATUS NAME: adds a test program's own counts; a program that died without any counts as one failure.
count() {
    local log=$1 status=$2 name=$3 p f
    p=$(sed -nE 's/.*test cases: +[0-9]+ \| +([0-9]+) passed.*/\1/p; s/^([0-9]+) passed, [0-9]+ failed.*/\1/p' "$log" | tail -n 1)
    f=$(sed -nE 's/.*test cases:.*\| +([0-9]+) failed.*/\1/p; s/^[0-9]+ passed, ([0-9]+) failed.*/\1/p' "$log" | tail -n 1)
    if [ "$status" -ne 0 ] && [ "${f:-0}" -eq 0 ]; then f=1; fi
    local s
    s=$(grep -c '^\[skipped\]' "$log" || true)
    grep '^\[skipped\]' "$log" || true
    passed=$((passed + ${p:-0} - s))
    failed=$((failed + ${f:-0}))
    skipped=$((skipped + s))
    [ "$status" -eq 0 ] || echo "  FAILED: $name"
}

# run_suite PRESET [OPTION...]: every test that CTest knows in that build, several at a time. CTest writes the number
# of the test before each line that a test prints, and says last how each has ended.
ended_test='^ *[0-9]+/[0-9]+ Test +#[0-9]+: '
run_suite() {
    local preset=$1 number name status ended
    shift
    cmake --preset "$preset" -DPENUMBRA_WERROR=ON -DPENUMBRA_TESTS=ON -DCMAKE_EXPORT_COMPILE_COMMANDS=ON "$@" \
        >"$logs/configure" 2>&1 || { cat "$logs/configure"; exit 1; }
    cmake --build --preset "$preset" || { echo "0 passed, 1 failed, 0 skipped"; exit 1; }
    echo "Tests of the $preset build:"
    ctest --test-dir "build/$preset" -V -j "$(nproc)" 2>&1 | tee "$logs/raw" | grep --line-buffered -E "$ended_test" || true
    while read -r number name; do
        sed -nE "s/^$number: //p" "$logs/raw" >"$logs/log"
        status=0
        ended=$(grep -E "$ended_test" "$logs/raw" | grep -E "#$number: ") || true
        [[ "$ended" =~ \.\ +Passed ]] || { status=1; cat "$logs/log"; }
        count "$logs/log" "$status" "$name"
    done < <(ctest --test-dir "build/$preset" -N | sed -nE 's/.*Test +#([0-9]+): +(.*)/\1 \2/p')
}

# run_each NAME FOLDER CHECKS: clang-tidy with every source of the rooms as the build in FOLDER compiles it, but for the
# kernels, whose intrinsics it does not know.
run_each() {
    local name=$1 folder=$2 checks=$3 status=0
    sed -nE 's/^ *"file": "(.*)",?$/\1/p' "$folder/compile_commands.json" | sort -u |
        grep -E "^$PWD/($folder/)?(core|raster|shadow|denoise|apps)/" | grep -v '_kernel\.cpp$' |
        xargs -P "$(nproc)" -n 1 clang-tidy -p "$folder" --quiet --checks="$checks" \
            --extra-arg=-Wno-unknown-warning-option >"$logs/log" 2>/dev/null || status=1
    if [ "$status" -eq 0 ]; then
        passed=$((passed + 1))
        echo "$name: ok"
    else
        failed=$((failed + 1))
        grep -A 3 'error:' "$logs/log" | head -n 60
        echo "$name: FAILED"
    fi
}

# run_tidy: all checks on sources that are compiled several at once, in a fifth of the time that they take one by one;
# and that each source compiles by itself, too.
run_tidy() {
    run_each clang-tidy build/release -bugprone-suspicious-include
    cmake --preset dev -DCMAKE_EXPORT_COMPILE_COMMANDS=ON >"$logs/configure" 2>&1 || { cat "$logs/configure"; exit 1; }
    run_each "each source by itself" build/dev '-*,clang-diagnostic-*,readability-duplicate-include'
}

echo "Formatting:"
status=0
git ls-files '*.h' '*.cpp' | xargs clang-format --dry-run -Werror >"$logs/log" 2>&1 || status=1
[ "$status" -eq 0 ] && passed=$((passed + 1)) || { tail -n 40 "$logs/log"; failed=$((failed + 1)); }

run_suite release -DPENUMBRA_BENCHMARKS=ON
if ! $quick; then
    run_tidy
    run_suite asan
fi

echo
echo "$passed passed, $failed failed, $skipped skipped"
[ "$failed" -eq 0 ]
