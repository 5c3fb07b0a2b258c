#!/usr/bin/env bash
# Each bad input gives one clear error that names the file and the place, and the right exit code.
source "$(dirname "${BASH_SOURCE[0]}")/harness.sh"

cat >ok.obj <<'OBJ'
v 0 0 0
v 1 0 0
v 0 1 0
f 1 2 3
OBJ

# scene_with KEY=JSON...: a small valid scene with some of its top-level values replaced.
scene_with() {
    local film='"size": [16, 16]' camera='"eye": [0, 0, 3], "target": [0, 0, 0]' extra=''
    local models='{ "name": "m", "file": "ok.obj" }'
    local lights='{ "name": "l", "type": "rect", "center": [0, 3, 0], "u": [1, 0, 0], "v": [0, 0, 1], "radiance": [1, 1, 1] }'
    local assignment
    for assignment in "$@"; do local "${assignment%%=*}"="${assignment#*=}"; done
    echo "{ \"film\": { $film }, \"camera\": { $camera }, \"models\": [ $models ], \"lights\": [ $lights ] $extra }" >scene.json
}
# bad_scene "what" TEXT KEY=JSON...
bad_scene() {
    local name=$1 text=$2
    shift 2
    scene_with "$@"
    check "$name" refuses 2 "$text" "$penumbra" render scene.json -o x.exr
}
# bad_obj "what" TEXT CONTENT
bad_obj() {
    printf '%b' "$3" >bad.obj
    check "$1" refuses 2 "$2" "$penumbra" render bad.obj -o x.exr --size 16x16
}
# bad_option "what" TEXT OPTION...
bad_option() {
    local name=$1 text=$2
    shift 2
    scene_with
    check "$name" refuses 2 "$text" "$penumbra" render scene.json -o x.exr "$@"
}

scene_with
check "the scene that the others spoil is good" "$penumbra" render scene.json -o x.exr --progress none

# ---- JSON
light() { echo "{ \"name\": \"l\", \"type\": \"rect\", \"center\": [0, 3, 0], \"u\": [1, 0, 0], \"v\": [0, 0, 1], \"radiance\": [1, 1, 1] $1 }"; }
check "a missing scene" refuses 2 "missing.json" "$penumbra" render missing.json
check "a folder as a scene" refuses 2 "." "$penumbra" render .
: >empty.json
check "an empty scene" refuses 2 "empty.json" "$penumbra" render empty.json
printf '{ "film": { "size": [16,' >cut.json
check "truncated JSON" refuses 2 "cut.json" "$penumbra" render cut.json
printf '\x00\xff\xfe garbage' >garbage.json
check "garbage instead of JSON" refuses 2 "garbage.json" "$penumbra" render garbage.json
head -c 200000 /dev/zero | tr '\0' '[' >deep.json
check "deeply nested JSON" refuses 2 "deep.json" "$penumbra" render deep.json
bad_scene "an unknown key, with a suggestion" '"camera"' 'extra=, "camra": 1'
bad_scene "a duplicate key" "size" 'film="size": [16, 16], "size": [8, 8]'
bad_scene "a number that overflows" "1e999" 'camera="eye": [0,0,3], "target": [0,0,0], "vfov": 1e999'
bad_scene "a field of view of 180 degrees" "vfov" 'camera="eye": [0,0,3], "target": [0,0,0], "vfov": 180'
bad_scene "an eye at its target" "camera" 'camera="eye": [0,0,0], "target": [0,0,0]'
bad_scene "an up along the view" "up" 'camera="eye": [0,0,3], "target": [0,0,0], "up": [0,0,1]'
bad_scene "a size of zero" "film.size" 'film="size": [0, 16]'
bad_scene "a size that is no number" "film.size" 'film="size": ["a", 16]'
bad_scene "a huge size" "film.size" 'film="size": [1000000000, 1000000000]'
bad_scene "a missing model file" "nowhere.obj" 'models={ "name": "m", "file": "nowhere.obj" }'
bad_scene "a scale of zero" "scale" 'models={ "name": "m", "file": "ok.obj", "scale": 0 }'
bad_scene "two models of one name" "models[1].name" 'models={ "name": "m", "file": "ok.obj" }, { "name": "m", "file": "ok.obj" }'
bad_scene "rotation keys 180 degrees apart" "models[0]: the rotations at 0 s and 1 s" 'models={ "name": "m", "file": "ok.obj", "keys": [ { "time": 0, "rotate": [0,0,0] }, { "time": 1, "rotate": [0,180,0] } ] }'
bad_scene "keys out of order" "time" 'models={ "name": "m", "file": "ok.obj", "keys": [ { "time": 1, "translate": [0,0,0] }, { "time": 0, "translate": [1,0,0] } ] }'
bad_scene "a radiance that is a word" 'lights[0].radiance: expected 3 numbers, got "white"' 'lights={ "name": "l", "type": "rect", "center": [0,3,0], "u": [1,0,0], "v": [0,0,1], "radiance": "white" }'
bad_scene "a negative radiance" "lights[0].radiance" 'lights={ "name": "l", "type": "rect", "center": [0,3,0], "u": [1,0,0], "v": [0,0,1], "radiance": [-1,0,0] }'
bad_scene "a light without area" "lights[0]" 'lights={ "name": "l", "type": "rect", "center": [0,3,0], "u": [1,0,0], "v": [2,0,0], "radiance": [1,1,1] }'
bad_scene "an unknown light type" "lights[0].type" 'lights={ "name": "l", "type": "lamp", "radiance": [1,1,1] }'
bad_scene "a polygon that is not convex" "lights[0]: the polygon is not convex" 'lights={ "name": "l", "type": "polygon", "vertices": [[0,3,0],[1,3,0],[0.1,3,0.1],[0,3,1]], "radiance": [1,1,1] }'
bad_scene "a polygon that is not planar" "lights[0]: vertex 1 is off the plane" 'lights={ "name": "l", "type": "polygon", "vertices": [[0,3,0],[1,3,0],[1,4,1],[0,3,1]], "radiance": [1,1,1] }'
bad_scene "a polygon of 9 vertices" "lights[0].vertices" 'lights={ "name": "l", "type": "polygon", "vertices": [[0,3,0],[1,3,0],[2,3,1],[3,3,2],[3,3,3],[2,3,4],[1,3,4],[0,3,3],[-1,3,1]], "radiance": [1,1,1] }'
bad_scene "a roughness beyond 1" "roughness" 'extra=, "materials": { "default": { "roughness": 2 } }'
bad_scene "a missing texture" "none.png" 'extra=, "materials": { "default": { "base_color_map": "none.png" } }'
bad_scene "frames that run backwards" "animation.frames" 'extra=, "animation": { "fps": 24, "frames": [9, 1] }'
bad_scene "no frames per second" "animation.fps" 'extra=, "animation": { "fps": 0, "frames": [1, 9] }'
bad_scene "too many rays" "render.spp" 'extra=, "render": { "spp": 65 }'

# ---- OBJ and MTL
bad_obj "a vertex that does not exist" "9" 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n'
bad_obj "a negative index beyond the first vertex" "bad.obj" 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -7\n'
bad_obj "an index of zero" "bad.obj" 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n'
bad_obj "a vertex that is not a number" "bad.obj" 'v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n'
bad_obj "an infinite vertex" "bad.obj" 'v 0 0 inf\nv 1 0 0\nv 0 1 0\nf 1 2 3\n'
bad_obj "a model without faces" "bad.obj" 'v 0 0 0\nv 1 0 0\n'
bad_obj "an empty model" "bad.obj" ''
bad_obj "binary garbage" "bad.obj" '\x00\x01\x02\xff\xfe\x00'
bad_obj "degenerate faces alone" "bad.obj" 'v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n'
printf 'mtllib t.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl t\nf 1/1 2/1 3/1\n' >textured.obj
bad_texture() {
    printf 'newmtl t\nmap_Kd %s\n' "$2" >t.mtl
    check "$1" refuses 2 "$2" "$penumbra" render textured.obj -o x.exr --size 16x16
}
bad_texture "a texture that does not exist" none.png
printf '\x89PNG\r\n\x1a\n' >cut.png
bad_texture "a truncated PNG" cut.png
printf '\x89PNG\r\n\x1a\n\0\0\0\rIHDR\xff\xff\xff\xff\xff\xff\xff\xff\x08\x02\0\0\0' >vast.png
bad_texture "a PNG of 2^32 pixels a side" vast.png
printf '\0\0\2\0\0\0\0\0\0\0\0\0\xff\xff\xff\xff\x20\0' >bomb.tga
bad_texture "an 18-byte TGA that asks for gigabytes" bomb.tga
printf '\xff\xd8\xff\xe0\0\x10JFIF' >cut.jpg
bad_texture "a truncated JPEG" cut.jpg
printf '#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 64 +X 64\n\2\2\0\100' >cut.hdr
bad_texture "a truncated run-length HDR" cut.hdr
printf '\x76\x2f\x31\x01\2\0\0\0channels\0chlist\0' >cut.exr
bad_texture "a truncated EXR" cut.exr

# ---- the command line
check "no command" refuses 2 "expected a command: render, info" "$penumbra"
check "an unknown command" refuses 2 'got "paint"' "$penumbra" paint
check "a misspelt command" refuses 2 'did you mean "render"?' "$penumbra" rendr
check "an option before the command" refuses 2 "--spp: penumbra has no such option" "$penumbra" --spp 4
check "an option without its value" refuses 2 "--aov: expected LIST, got nothing" "$penumbra" render --aov
check "an argument too many" refuses 2 'got "c" as well' "$penumbra" diff a b c
check "an argument too few" refuses 2 "TEST: is missing, expected penumbra diff" "$penumbra" diff a
bad_option "an unknown option" "--wobble: penumbra render has no such option" --wobble
bad_option "a misspelt option" 'did you mean "--method"?' --methods=ratio
check "a misspelt option before a missing argument" refuses 2 'did you mean "--mask"?' "$penumbra" diff --masks x.png
bad_option "a word that is none" 'expected one of ratio, stochastic' --method magic
bad_option "an option of a feature that does not exist" "temporal" --temporal taa
bad_option "an unknown method" "--method" --method magic
bad_option "frames that are no list" "--frames" -f 1-x
bad_option "frames that run backwards" "--frames" -f 9-1
bad_option "a step of zero" "--frames" -f 1-9x0
bad_option "frames without a number in the pattern" "####" -f 1-2
bad_option "a size that is none" "--size" --size 10
bad_option "a crop outside of the picture" "--crop" --crop 0,0,17,16
bad_option "an empty crop" "--crop" --crop 4,4,4,8
bad_option "an unknown AOV" "--aov" --aov depth
bad_option "too many rays" "--spp" --spp 65
bad_option "half a ray" "--spp: expected a whole number, 1 to 64, got \"4.5\"" --spp 4.5
bad_option "a word for a number" "--seed: expected a number, 0 to 4294967295, got \"x\"" --seed x
bad_option "a seed that is too large" "--seed: expected a number, 0 to 4294967295" --seed 4294967296
bad_option "an option twice" "--spp: expected one value, got 2" --spp 1 --spp 2
bad_option "no threads" "--threads" --threads 0
bad_option "an unknown compression" "--compression" --compression lzma
bad_option "a lossy compression of positions" "--compression" --compression dwaa --aov P
bad_option "an unknown instruction set" "--isa" --isa neon
bad_option "an unknown instruction set of the tracer" "--trace-isa" --trace-isa bogus
bad_option "an exposure that is no number" "--exposure" --exposure nan
bad_option "a filter constant that is no number" "--filter-gain" --filter-gain nan
bad_option "an empty frame list" "--frames" -f ""
bad_option "an empty file of statistics" "--stats" --stats ""
check "an empty scene name" refuses 2 "SCENE" "$penumbra" render ""
bad_option "a frame on its scene" "--output" -o scene.json
bad_option "a frame on its model" "--output" -o ./ok.obj
bad_option "statistics on a frame" "--stats" --stats ./x.exr
bad_option "frames on each other" "--output" -f 1 -o x.png --preview x.png
bad_option "a preview that is no PNG" "ends in .png" -f 1 --preview x.jpg
printf '\x76\x2f\x31\x01' >stub.exr
check "info on a truncated EXR" refuses 2 "stub.exr" "$penumbra" info stub.exr
check "info on nothing" refuses 2 "nothing.exr" "$penumbra" info nothing.exr
check "nothing was written" test ! -e .part

finish
