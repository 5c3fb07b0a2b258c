#!/usr/bin/env bash
# Usage: kernel_symbols.sh OBJECT...
# The joined object of an instruction set's kernels exports the functions of that instruction set's
# namespace and nothing else: otherwise the linker could take its copy of an inline function for
# everybody, and the program would crash where the instruction set is missing.
set -euo pipefail

passed=0
failed=0
for object in "$@"; do
    isa=$(sed -E 's/.*_(avx[0-9]+)\.o$/\1/' <<<"$object")
    prefix="_ZN8penumbra${#isa}${isa}"
    exported=$(nm --extern-only --defined-only --format=posix "$object" | cut -d' ' -f1)
    strangers=$(grep -v "^$prefix" <<<"$exported" || true)
    if [ -n "$exported" ] && [ -z "$strangers" ]; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "$object: expected only symbols that begin with $prefix, found:"
        head -n 5 <<<"${strangers:-none at all}" | c++filt
    fi
done
[ $# -gt 0 ] || { echo "no kernel objects given"; failed=1; }
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
