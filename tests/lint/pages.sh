#!/usr/bin/env bash
# Usage: pages.sh SOURCE_DIRECTORY
# What the pages for readers of the code name is there: every `path` in code spans that begins with a folder of ours, and
# every link to a file. Spans with wildcards are left out.
set -euo pipefail
cd "$1"

passed=0
failed=0

check_path() {
    if [ -e "$2" ]; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "$1 names $2, which does not exist"
    fi
}

folders='(core|raster|shadow|denoise|apps|tests|cmake|data|docs|\.ci|\.github)'
for page in README.md CONTRIBUTING.md docs/architecture.md; do
    while read -r path; do check_path "$page" "$path"; done \
        < <(grep -v '^    ' "$page" | grep -oE "\`$folders/[A-Za-z0-9_./-]*\`" | tr -d '`' | sort -u)
    while read -r link; do check_path "$page" "$(dirname "$page")/$link"; done \
        < <(grep -oE '\]\([^):]+\)' "$page" | sed -E 's/^\]\(//; s/[#)].*//' | sort -u)
done

echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
