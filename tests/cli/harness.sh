# Sourced by the command-line tests. Usage of a test: NAME.sh PATH_OF_PENUMBRA
# A test is a function that returns 0 if it holds; `finish` prints the counts in the form tests/run.sh reads.

set -u
penumbra=$(realpath "$1")
source_dir=$(realpath "$(dirname "${BASH_SOURCE[0]}")/../..")
work=$(mktemp -d)
trap 'chmod -R u+w "$work" 2>/dev/null; rm -rf "$work"' EXIT
cd "$work"
passed=0
failed=0
skipped=0

# check "what must hold" COMMAND...
check() {
    local name=$1
    shift
    if "$@"; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAILED: $name"
    fi
}

skip() {
    skipped=$((skipped + 1))
    passed=$((passed + 1)) # run.sh takes skipped ones off the passed
    echo "[skipped] $1"
}

# refuses EXIT_CODE TEXT COMMAND...: the command ends with that code, prints one line on stderr that
# begins with "error: " and contains TEXT, and does not crash.
refuses() {
    local code=$1 text=$2 status=0
    shift 2
    "$@" >"$work/stdout" 2>"$work/stderr" </dev/null || status=$?
    grep -v '^warning: ' "$work/stderr" >"$work/errors"
    if [ "$status" -ne "$code" ] || [ "$(wc -l <"$work/errors")" -ne 1 ] ||
        ! grep -q '^error: ' "$work/errors" || ! grep -qF -- "$text" "$work/errors"; then
        echo "  expected exit code $code and one line with: $text"
        echo "  got exit code $status and:"
        head -n 20 "$work/stderr" | sed 's/^/    /'
        return 1
    fi
}

# write_quads FILE.obj: a floor of 2 x 2 m and a smaller sheet 0.3 m above it.
write_quads() {
    cat >"$1" <<'OBJ'
v -1 0 -1
v 1 0 -1
v 1 0 1
v -1 0 1
v -0.3 0.3 -0.3
v 0.3 0.3 -0.3
v 0.3 0.3 0.3
v -0.3 0.3 0.3
f 4 3 2 1
f 8 7 6 5
OBJ
}

finish() {
    echo "$passed passed, $failed failed, $skipped skipped"
    [ "$failed" -eq 0 ]
}
