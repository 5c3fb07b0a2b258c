#!/usr/bin/env bash
# Usage: sources.sh SOURCE_DIRECTORY
# What the compiler cannot see: which rooms include each other, which libraries stand behind which door,
# and which mathematics kernels may use. Comments and strings do not count.
set -euo pipefail
cd "$1"
shopt -s globstar nullglob

passed=0
failed=0

# code FILE...: the lines of the files without comments and strings, as "file:line:text".
code() {
    awk '{
        line = $0
        if (line !~ /^[ \t]*#[ \t]*include/) gsub(/"([^"\\]|\\.)*"/, "\"\"", line)
        sub(/\/\/.*/, "", line)
        print FILENAME ":" FNR ":" line
    }' "$@" /dev/null
}

# forbid RULE PATTERN FILE...: no line of code of these files matches the extended expression.
forbid() {
    local rule=$1 pattern=$2 found
    shift 2
    found=$([ $# -eq 0 ] || code "$@" | grep -E "^[^:]+:[0-9]+:.*($pattern)" || true)
    if [ -z "$found" ]; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        printf 'Broken rule: %s\n%s\n' "$rule" "$found"
    fi
}

# reachable FILE...: these files and all of ours that they include, directly or not.
reachable() {
    local -A seen=()
    local queue=("$@") file include
    while [ ${#queue[@]} -gt 0 ]; do
        file=${queue[0]}
        queue=("${queue[@]:1}")
        [ -z "${seen[$file]:-}" ] && [ -f "$file" ] || continue
        seen[$file]=1
        while read -r include; do queue+=("$include"); done \
            < <(sed -nE 's/^[ \t]*#[ \t]*include[ \t]*"([^"]+)".*/\1/p' "$file")
    done
    printf '%s\n' "${!seen[@]}"
}

# without PATTERN FILE...: the files whose names do not match.
without() {
    local pattern=$1
    shift
    printf '%s\n' "$@" | grep -Ev "$pattern" || true
}

room_files() { printf '%s\n' "$1"/**/*.h "$1"/**/*.cpp; }
mapfile -t core < <(room_files core)
mapfile -t raster < <(room_files raster)
mapfile -t shadow < <(room_files shadow)
mapfile -t denoise < <(room_files denoise)
mapfile -t apps < <(room_files apps)
everything=("${core[@]}" "${raster[@]}" "${shadow[@]}" "${denoise[@]}" "${apps[@]}")

include='#[ \t]*include[ \t]*[<"]'
forbid "core includes no other room" "$include(raster|shadow|denoise|apps|tests)/" "${core[@]}"
forbid "raster includes core alone" "$include(shadow|denoise|apps|tests)/" "${raster[@]}"
forbid "shadow includes core alone" "$include(raster|denoise|apps|tests)/" "${shadow[@]}"
forbid "denoise includes core alone" "$include(raster|shadow|apps|tests)/" "${denoise[@]}"
forbid "apps include no tests" "${include}tests/" "${apps[@]}"

# The folders of core from the ground up: each includes those before it alone.
order=(simd math profile bsdf image json frame parallel light sampling scene compare)
join() { local IFS='|'; echo "$*"; }
mapfile -t ground < <(printf '%s\n' core/*.h core/*.cpp)
forbid "what lies in core itself includes none of its folders" "${include}core/[^/\"]+/" "${ground[@]}"
mapfile -t elsewhere < <(without "^core/([^/]+|($(join "${order[@]}"))/.*)\$" "${core[@]}")
forbid "each folder of core has its place in their order" "" "${elsewhere[@]}"
for i in "${!order[@]}"; do
    above=("${order[@]:i+1}")
    [ ${#above[@]} -eq 0 ] && break
    mapfile -t files < <(room_files "core/${order[i]}")
    forbid "core/${order[i]} includes no folder of core above it" "${include}core/($(join "${above[@]}"))/" "${files[@]}"
done

# door NAME INCLUDE FOLDER: a library's headers are included in that folder only.
door() {
    local files
    mapfile -t files < <(without "^$3" "${everything[@]}")
    forbid "$1 stands behind $3" "$include$2" "${files[@]}"
}
door Embree 'embree' shadow/
mapfile -t not_the_door < <(without '^shadow/embree\.h$' "${everything[@]}" tests/**/*.h tests/**/*.cpp)
forbid "what differs between Embree's versions stands in shadow/embree.h" \
    "RTC_VERSION|${include}embree|rtc(Occluded|Intersect)[0-9]" "${not_the_door[@]}"
door oneTBB '(tbb|oneapi)/' core/parallel/
door OpenEXR '(OpenEXR/|Imath/|Imf|Iex)' core/image/
door tinyobjloader 'tiny_obj_loader' core/scene/
door "the JSON library" 'nlohmann' '(core/json/|apps/cli/|apps/bench/report_writer\.cpp$)'
door libdeflate 'libdeflate' core/image/
door stb '(stb/)?stb_image' core/
door CLI11 'CLI/' apps/cli/

mapfile -t headers < <(printf '%s\n' "${everything[@]}" | grep -E '\.h$' | grep -v '^shadow/')
forbid "no header shows a library's type" \
    "$include(embree|tbb/|oneapi/|OpenEXR|Imath|Imf|tiny_obj|nlohmann|stb)" "${headers[@]}"

functions='a?(sin|cos|tan)h?|atan2|exp2?|expm1|log(2|10|1p|b)?|pow|sqrt|cbrt|hypot|fma|fabs|abs|floor|ceil|round|nearbyint|l?l?rint|trunc|fmod|remainder|copysign|fmin|fmax|ldexp|frexp|erf'
mapfile -t kernels < <(printf '%s\n' "${everything[@]}" tests/**/*_kernel.cpp | grep -E '_kernel\.cpp$' || true)
mapfile -t formulas < <(reachable "${kernels[@]}" | grep -Ev '^core/simd/|^core/math/elementary\.h$')
mapfile -t outside_simd < <(without '^core/simd/' "${everything[@]}")

forbid "kernels and their formulas use simd:: and core/math/elementary.h for mathematics" \
    "std::($functions)f?[^a-zA-Z0-9_]" "${formulas[@]}"
forbid "kernels and their formulas call no function of the C library's mathematics" \
    "(^|[^a-zA-Z0-9_:.>])(::|__builtin_)?($functions)f\(" "${formulas[@]}"
forbid "xsimd is named in core/simd alone" "xsimd" "${outside_simd[@]}"
forbid "no hardware approximations of reciprocals and roots" \
    "rsqrt|_rcp[0-9_]*_|rcp(14|28|ps|ss)" "${everything[@]}"
forbid "kernels use no standard containers and no allocation" \
    "std::(vector|basic_string|string|map|set|unordered_|deque|list|function|unique_ptr|shared_ptr|make_|optional|variant)|[^a-zA-Z0-9_]new [^(]|malloc" \
    "${kernels[@]}"

build=(CMakeLists.txt **/CMakeLists.txt cmake/* CMakePresets*.json)
forbid "no flag lets the compiler change results or tie the program to one machine" \
    "-ffast-math|-Ofast|-funsafe|-march=native|-mtune=native|-ffp-contract=(fast|on)" "${build[@]}"

echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
