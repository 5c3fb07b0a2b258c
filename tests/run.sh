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
    printf '  %-28s %s\n' "$name" "$([ "$status" -eq 0 ] && echo ok || echo FAILED)"
}

# run_suite PRESET: every test that CTest knows in that build.
run_suite() {
    local preset=$1 name status
    cmake --preset "$preset" -DPENUMBRA_WERROR=ON -DPENUMBRA_TESTS=ON -DPENUMBRA_BENCHMARKS=ON \
        -DCMAKE_EXPORT_COMPILE_COMMANDS=ON >"$logs/configure" 2>&1 ||
        { cat "$logs/configure"; exit 1; }
    cmake --build --preset "$preset" || { echo "0 passed, 1 failed, 0 skipped"; exit 1; }
    echo "Tests of the $preset build:"
    for name in $(ctest --test-dir "build/$preset" -N | sed -nE 's/.*Test +#[0-9]+: +(.*)/\1/p'); do
        status=0
        ctest --test-dir "build/$preset" -R "^$name\$" -V >"$logs/raw" 2>&1 || status=$?
        sed -E 's/^[0-9]+: //' "$logs/raw" >"$logs/log"
        [ "$status" -eq 0 ] || cat "$logs/log"
        count "$logs/log" "$status" "$name"
    done
}

# run_tidy: clang-tidy over everything but the kernels, which it does not know the intrinsics of.
run_tidy() {
    local status=0
    git ls-files 'core/*.cpp' 'raster/*.cpp' 'shadow/*.cpp' 'denoise/*.cpp' 'apps/*.cpp' | grep -v '_kernel\.cpp$' |
        xargs -P "$(nproc)" -n 4 clang-tidy -p build/release --quiet >"$logs/log" 2>/dev/null || status=1
    if [ "$status" -eq 0 ]; then
        passed=$((passed + 1))
        echo "clang-tidy: ok"
    else
        failed=$((failed + 1))
        grep -A 3 'error:' "$logs/log" | head -n 60
        echo "clang-tidy: FAILED"
    fi
}

echo "Formatting:"
status=0
git ls-files '*.h' '*.cpp' | xargs clang-format --dry-run -Werror >"$logs/log" 2>&1 || status=1
[ "$status" -eq 0 ] && passed=$((passed + 1)) || { tail -n 40 "$logs/log"; failed=$((failed + 1)); }

run_suite release
if ! $quick; then
    run_tidy
    run_suite asan
fi

echo
echo "$passed passed, $failed failed, $skipped skipped"
[ "$failed" -eq 0 ]
