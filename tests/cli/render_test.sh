#!/usr/bin/env bash
# `penumbra render` as a user and a script meet it.
source "$(dirname "${BASH_SOURCE[0]}")/harness.sh"

write_quads quad.obj
cat >shot.json <<'JSON'
{
    "film": { "size": [160, 96] },
    "camera": { "eye": [0, 2, 3], "target": [0, 0, 0], "vfov": 40,
                "keys": [ { "time": 0, "eye": [0, 2, 3] }, { "time": 1, "eye": [1, 2, 3] } ] },
    "models": [ { "name": "quads", "file": "quad.obj" } ],
    "lights": [ { "name": "key", "type": "rect", "center": [0, 2, 0], "u": [0.5, 0, 0], "v": [0, 0, 0.5],
                  "radiance": [10, 9, 8] } ],
    "animation": { "fps": 24, "frames": [1, 12] }
}
JSON

has_files() { local f; for f in "$@"; do [ -s "$f" ] || { echo "  missing: $f"; return 1; }; done; }
no_partial_files() { [ -z "$(find . -name '*.part')" ]; }
sums() { (cd "$1" && sha256sum ./*.exr); }
same_frames() { diff <(sums "$1") <(sums "$2") >/dev/null; }
exits_with() { local code=$1 status=0; shift; "$@" >stdout 2>stderr || status=$?; [ "$status" -eq "$code" ]; }
render() { "$penumbra" render shot.json "$@" >stdout 2>stderr; }

# ---- frames, patterns, previews
check "a range renders to numbered files" render -f 1-3 -o a/x.####.exr
check "its files are there" has_files a/x.0001.exr a/x.0002.exr a/x.0003.exr
check "no partial file is left" no_partial_files
check "there is a line per frame when the output is no terminal" test "$(grep -c '^frame ' stdout)" -eq 3
check "steps and lists" render -f 1-5x2,9 -o b/x.####.exr
check "gives those frames" has_files b/x.0001.exr b/x.0003.exr b/x.0005.exr b/x.0009.exr
check "previews are written" render -f 2 -o c/x.exr --preview c/x.png
check "as PNG" bash -c "head -c 4 c/x.png | grep -q PNG"
check "frames equal those of another run and thread count" render -f 1-3 -o d/x.####.exr --threads 3
check "bit for bit" same_frames a d
check "the vector width changes no bit" render -f 1-3 -o e/x.####.exr --isa avx2
check "of any file" same_frames a e
check "every AOV, precision and compression" render -f 1 -o f/all.exr --aov all --precision float --compression piz
check "info tells what is in it" bash -c "'$penumbra' info f/all.exr | grep -q 'id.triangle uint'"
check "info tells what is in a scene" bash -c "'$penumbra' info shot.json | grep -q 'key: rect'"
check "a model alone renders" "$penumbra" render quad.obj --size 64x48 -o g.exr --progress none
check "a dry run names the files and renders nothing" bash -c \
    "'$penumbra' render shot.json -f 7,8 -o h/y.####.exr --dry-run | grep -q 'h/y.0008.exr' && [ ! -e h ]"
check "progress as JSON" bash -c "'$penumbra' render shot.json -f 1 -o i.exr --progress json | grep -q '\"done\":1'"
check "progress for Open Job Description" bash -c \
    "'$penumbra' render shot.json -f 1 -o i.exr --progress openjd | grep -q 'openjd_progress: 100'"
check "one file under two spellings is one file" refuses 2 "--stats" "$penumbra" render -f 1 -o ./two.exr --stats two.exr
check "statistics are written" render -f 1 -o i.exr --stats stats.json
check "with rays" grep -q '"shadow_rays": [1-9]' stats.json

# ---- resume
check "resuming skips what is complete" bash -c \
    "'$penumbra' render shot.json -f 1-3 -o a/x.####.exr --resume | grep -c skipped | grep -qx 3"
head -c 2000 d/x.0002.exr >truncated && mv truncated d/x.0002.exr
check "a truncated frame is rendered anew" bash -c \
    "'$penumbra' render shot.json -f 1-3 -o d/x.####.exr --resume | grep -c skipped | grep -qx 2"
check "and equals the first" same_frames a d
check "other settings render anew" bash -c \
    "'$penumbra' render shot.json -f 1-3 -o d/x.####.exr --spp 2 --resume | grep -c skipped | grep -qx 0"
check "a changed scene renders anew" bash -c \
    "sed 's/10, 9, 8/10, 9, 9/' shot.json >other.json; mkdir -p other; cp a/*.exr other/;
     '$penumbra' render other.json -f 1-3 -o other/x.####.exr --resume | grep -c skipped | grep -qx 0"

# ---- killed and resumed
killed_and_resumed() {
    mkdir -p reference killed
    "$penumbra" render shot.json --size 480x270 -o 'reference/x.####.exr' --progress none || return 1
    local attempt
    for attempt in 1 2 3 4 5 6 7 8; do
        "$penumbra" render shot.json --size 480x270 -o 'killed/x.####.exr' --resume --progress none &
        sleep "0.$((attempt * 37 % 90 + 10))"
        kill -9 $! 2>/dev/null
        wait $! 2>/dev/null
    done
    "$penumbra" render shot.json --size 480x270 -o 'killed/x.####.exr' --resume --progress none || return 1
    same_frames reference killed
}
check "a sequence killed at any moment and resumed is the whole one" killed_and_resumed

interrupted() {
    local signal=$1 code=$2 status=0
    "$penumbra" render shot.json --size 1600x1200 --spp 16 -o 'interrupted/x.####.exr' --progress none 2>stderr &
    sleep 0.7
    kill "-$signal" $!
    wait $! || status=$?
    [ "$status" -eq "$code" ] && no_partial_files
}
check "Ctrl-C ends with 130 and leaves whole files" interrupted INT 130
check "SIGTERM ends with 143 and leaves whole files" interrupted TERM 143

# ---- disks
check "folders are created" render -f 1 -o new/er/folder/x.exr
if [ "$(id -u)" -ne 0 ]; then
    mkdir locked && chmod a-w locked
    check "a folder without permission" refuses 3 "locked" "$penumbra" render shot.json -f 1 -o locked/x.exr
else
    check "a folder that cannot be written" refuses 3 "/proc/x.exr" "$penumbra" render shot.json -f 1 -o /proc/x.exr
fi
full_disk() { (trap '' XFSZ; ulimit -f 8; refuses 3 "$1" "$penumbra" render shot.json -f 1 -o full/x.exr --precision float --aov all --compression none); }
check "a full disk is one error" full_disk "full/x.exr"
check "and leaves nothing behind" test -z "$(ls full 2>/dev/null)"
check "a target that is a folder" bash -c "mkdir -p folder/x.exr; '$penumbra' render shot.json -f 1 -o folder/x.exr 2>/dev/null; [ \$? -eq 3 ]"
some_fail() {
    mkdir -p some/x.0002.exr
    exits_with 3 "$penumbra" render shot.json -f 1-3 -o some/x.####.exr && has_files some/x.0001.exr some/x.0003.exr &&
        grep -q '^error: frame 2: ' stderr
}
check "a frame that fails is listed and the others are rendered" some_fail

a_bad_frame() {
    cat >through.json <<'JSON'
{ "film": { "size": [16, 16] }, "models": [ { "name": "quads", "file": "quad.obj" } ],
  "camera": { "eye": [0, 0, 3], "target": [0, 0, 0],
              "keys": [ { "time": 0, "eye": [0, 0, 3] }, { "time": 6, "eye": [0, 0, -3] } ] },
  "animation": { "fps": 1, "frames": [1, 1] } }
JSON
    exits_with 3 "$penumbra" render through.json -f 3-5 -o through/x.####.exr &&
        has_files through/x.0003.exr through/x.0005.exr && grep -q '^error: frame 4: ' stderr
}
check "a frame whose camera is wrong is listed and the others are rendered" a_bad_frame

# ---- streams
check "an error that cannot be printed is still its exit code" bash -c "'$penumbra' render nope.json 2>/dev/full; [ \$? -eq 2 ]"
check "what cannot be printed is an error" bash -c "'$penumbra' info shot.json >/dev/full 2>/dev/null; [ \$? -eq 3 ]"
mkfifo pipe.exr
check "a pipe is no image" refuses 2 "pipe.exr" timeout 10 "$penumbra" info pipe.exr
check "SIGHUP ends with 129 and leaves whole files" interrupted HUP 129
file_size_limit() { (ulimit -f 8; refuses 3 "limit/x.exr" "$penumbra" render shot.json -f 1 -o limit/x.exr --precision float --aov all --compression none); }
check "a limit of file sizes is one error" file_size_limit
check "a changed exposure renders previews anew" bash -c \
    "'$penumbra' render shot.json -f 2 -o c/x.exr --preview c/x.png --resume | grep -c skipped | grep -qx 1 &&
     '$penumbra' render shot.json -f 2 -o c/x.exr --preview c/x.png --exposure 1 --resume | grep -c skipped | grep -qx 0"

check "--resume keeps frames with and without --reproducible apart, Embree's instruction set not" bash -c \
    "'$penumbra' render shot.json -f 2 -o exact/x.exr >/dev/null &&
     '$penumbra' render shot.json -f 2 -o exact/x.exr --reproducible --resume | grep -c skipped | grep -qx 0 &&
     '$penumbra' render shot.json -f 2 -o exact/x.exr --reproducible --trace-isa auto --resume | grep -c skipped | grep -qx 1"

resumed_with_another_noise_radius() {
    local base=(render shot.json -f 1 -o noise/x.exr --denoise none --aov beauty,E)
    "$penumbra" "${base[@]}" --noise-radius 10 >/dev/null || return 1
    cp noise/x.exr noise/before.exr
    "$penumbra" "${base[@]}" --noise-radius 3 --resume | grep -c skipped | grep -qx 0 || return 1
    ! cmp -s noise/before.exr noise/x.exr &&
        "$penumbra" "${base[@]}" --noise-radius 3 --resume | grep -c skipped | grep -qx 1
}
check "without a filter the noise estimate's settings still count, as they show in E" resumed_with_another_noise_radius

# ---- settings in files
check "statistics name the settings" bash -c "'$penumbra' render shot.json -f 1 -o set.exr --spp 2 --reproducible --stats set.json >/dev/null &&
    grep -q '\"size\": \"160x96\"' set.json && grep -q '\"spp\": 2' set.json && grep -q '\"reproducible\": true' set.json &&
    grep -q '\"noise-full\": 1.5' set.json"
check "so does the header" bash -c "'$penumbra' info set.exr | grep -q '^penumbraSettings size 160x96, .* spp 2, .* reproducible true'"

# ---- methods
default_filters() {
    local method=$1 own=$2 other=$3
    "$penumbra" render shot.json -f 2 -o "$method/own/x.exr" --method "$method" --progress none &&
        "$penumbra" render shot.json -f 2 -o "$method/same/x.exr" --method "$method" --denoise "$own" --progress none &&
        "$penumbra" render shot.json -f 2 -o "$method/other/x.exr" --method "$method" --denoise "$other" --progress none &&
        same_frames "$method/own" "$method/same" && exits_with 1 "$penumbra" diff "$method/own/x.exr" "$method/other/x.exr"
}
check "the ratio is filtered unless told otherwise" default_filters ratio noise-driven none
check "the stochastic estimate is filtered if told so" default_filters stochastic none noise-driven

# ---- help
check "--help explains every option" bash -c \
    "for o in --output --frames --size --crop --method --spp --aa --denoise --aov --compression --precision --resume \
        --preview --exposure --threads --isa --trace-isa --reproducible --seed --stats --progress --dry-run; do
        '$penumbra' render --help | grep -q -- \"\$o\" || { echo \"  \$o\"; exit 1; }
     done"

finish
