#!/usr/bin/env bash
# Sets up, builds and renders the built-in animated scene. Usage: apps/demo.sh [options of `penumbra render`]
set -euo pipefail
cd "$(dirname "$0")/.."
source cmake/packages.sh

install_packages "${PENUMBRA_BUILD_PACKAGES[@]}"
cmake --preset release -DPENUMBRA_TESTS=OFF >/dev/null
cmake --build --preset release --target penumbra_cli

mkdir -p out/demo
build/release/bin/penumbra render \
    --output 'out/demo/turntable.####.exr' --preview 'out/demo/turntable.####.png' --resume "$@"
echo
echo "Frames:   $PWD/out/demo/turntable.####.exr"
echo "Previews: $PWD/out/demo/turntable.####.png"
