#!/usr/bin/env bash
# Unpacks the model of country-kitchen.json (97 MB) from the assets beside the source folder to where
# the scene looks for it: build/assets, which no other scene and no test needs.
set -euo pipefail
cd "$(dirname "$0")/../.."
packed=$(realpath ../shared/assets/country-kitchen)
mkdir -p build/assets/country-kitchen
cd build/assets/country-kitchen
ln -sfn "$packed"/{country-kitchen.mtl,textures} .
xz -dc "$packed/country-kitchen.obj.xz" >country-kitchen.obj.part
mv country-kitchen.obj.part country-kitchen.obj
