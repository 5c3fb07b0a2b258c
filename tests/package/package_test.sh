#!/usr/bin/env bash
# The installed library serves a project of its own. Usage: package_test.sh BUILD_DIR
set -eu
build=$(realpath "$1")
source_dir=$(realpath "$(dirname "$0")")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cmake --install "$build" --prefix "$work/prefix" >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
for file in bash-completion/completions/penumbra zsh/site-functions/_penumbra man/man1/penumbra.1; do
    [ -s "$work/prefix/share/$file" ] || { echo "share/$file is missing"; echo "0 passed, 1 failed, 0 skipped"; exit 1; }
done
# What an installed header includes of ours is installed.
missing=$(cd "$work/prefix/include/penumbra" &&
          grep -rhoE '^#include "[^"]+"' . | sort -u | sed -E 's/.*"(.*)"/\1/' |
          while read -r header; do [ -f "$header" ] || echo "$header"; done)
[ -z "$missing" ] || { echo "not installed: $missing"; echo "0 passed, 1 failed, 0 skipped"; exit 1; }
if cmake -S "$source_dir" -B "$work/build" -G Ninja -DCMAKE_BUILD_TYPE=Release \
       -DCMAKE_PREFIX_PATH="$work/prefix" >"$work/log" 2>&1 &&
   cmake --build "$work/build" >"$work/log" 2>&1 && "$work/build/consumer" >"$work/log" 2>&1; then
    echo "1 passed, 0 failed, 0 skipped"
else
    tail -n 40 "$work/log"
    echo "0 passed, 1 failed, 0 skipped"
    exit 1
fi
