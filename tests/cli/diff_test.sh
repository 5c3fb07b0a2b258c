#!/usr/bin/env bash
# `penumbra diff` on pairs that are easily misjudged. Usage: diff_test.sh PENUMBRA DIFF_CORPUS
corpus=$(realpath "$2")
source "$(dirname "${BASH_SOURCE[0]}")/harness.sh"
"$corpus"

# verdict EXIT_CODE KIND REF TEST OPTION...: ends with that code; KIND ("-": none) is the kind of the
# first failure in the JSON.
verdict() {
    local code=$1 kind=$2 status=0 found
    shift 2
    rm -f report.json
    "$penumbra" diff "$@" --json report.json >stdout 2>stderr || status=$?
    found=$(sed -nE 's/^ *"kind": "(.*)",?$/\1/p' report.json 2>/dev/null | head -n 1)
    if [ "$status" -ne "$code" ] || [ "${found:--}" != "$kind" ]; then
        echo "  expected exit code $code and $kind, got $status and ${found:--}"
        head -n 8 stdout stderr | sed 's/^/    /'
        return 1
    fi
}
# prints TEXT COMMAND...: the command's standard output holds TEXT.
prints() {
    local text=$1
    shift
    "$@" 2>&1 | grep -qF -- "$text"
}

# ---- nasty pairs
check "a file is the same as itself" verdict 0 - ref.exr ref.exr
check "equal pixels" verdict 0 - ref.exr same.exr
check "equal pixels behind another codec" verdict 0 - ref.exr other_codec.exr
check "a NaN" verdict 1 non-finite ref.exr nan.exr
check "a NaN in the reference" verdict 1 non-finite nan.exr ref.exr
check "the same NaN on both sides" verdict 1 non-finite nan.exr nan.exr
check "a NaN passes no threshold" verdict 1 non-finite ref.exr nan.exr --fail-above max=1e30
check "an infinity" verdict 1 non-finite ref.exr inf.exr
check "a NaN in alpha" verdict 1 non-finite ref.exr alpha_nan.exr --fail-above flip=1
check "one pixel" verdict 1 differs ref.exr one_pixel.exr
check "one unit in the last place" verdict 1 differs ref.exr one_ulp.exr
check "a denormal number instead of zero" verdict 1 differs zero.exr denormal.exr
check "zeros of either sign are the same" verdict 0 - zero.exr negative_zero.exr
check "values near the end of float" verdict 1 threshold ref.exr huge_values.exr --fail-above rmse=1
check "another size" verdict 1 size ref.exr wider.exr
check "another place" verdict 1 window ref.exr moved.exr
check "a crop instead of the frame" verdict 1 window ref.exr crop.exr
check "another data window of the same size" verdict 1 window crop.exr crop_moved.exr
check "equal crops" verdict 0 - crop.exr crop.exr
check "one pixel of a crop" verdict 1 differs crop.exr crop_pixel.exr
check "a renamed channel" verdict 1 channels ref.exr renamed.exr
check "a channel less" verdict 1 channels ref.exr no_alpha.exr
check "a channel more" verdict 1 channels no_alpha.exr ref.exr
check "half instead of float" verdict 1 type ref.exr half.exr
check "ids instead of float" verdict 1 type ref.exr uint.exr
check "other types pass no threshold" verdict 1 type ref.exr half.exr --fail-above max=100
check "a part less" verdict 1 parts parts.exr single.exr
check "another name of a part" verdict 1 parts parts.exr parts_renamed.exr
check "a pixel of the second part" verdict 1 differs parts.exr parts_pixel.exr
check "parts that are the same" verdict 0 - parts.exr parts.exr
check "1 x 1 pixel, the same" verdict 0 - single.exr single.exr
check "1 x 1 pixel, another" verdict 1 differs single.exr single_other.exr
head -c $(($(stat -c %s ref.exr) - 20)) ref.exr >cut.exr
check "an incomplete EXR" verdict 1 incomplete ref.exr cut.exr
check "an incomplete EXR on both sides" verdict 1 incomplete cut.exr cut.exr
head -c 100 ref.exr >stub.exr
check "an EXR cut off in its header" verdict 1 damaged ref.exr stub.exr
head -c $(($(stat -c %s rgb.png) / 2)) rgb.png >cut.png
check "an incomplete PNG" verdict 1 damaged rgb.png cut.png
: >empty.exr
check "an empty file" verdict 2 not-an-image ref.exr empty.exr
echo "no image" >text.exr
check "a text" verdict 2 not-an-image ref.exr text.exr
check "a missing file" verdict 2 missing ref.exr nowhere.exr
check "one line says so" refuses 2 "nowhere.exr" "$penumbra" diff ref.exr nowhere.exr
check "an EXR and a PNG" verdict 1 format ref.exr rgb.png
check "a PNG and itself" verdict 0 - rgb.png rgb.png
check "a step of 1/255 in a PNG" verdict 1 differs rgb.png rgb_pixel.png
check "RGB and RGBA" verdict 1 channels rgb.png rgba.png
check "a step within the limit" verdict 0 - rgb.png rgb_pixel.png --fail-above max=0.004
check "tiles and scan lines with equal pixels" verdict 0 - scanlines.exr tiles.exr
check "a pixel of the last tile" verdict 1 differs tiles.exr tiles_pixel.exr
check "mip-maps: the full size counts" verdict 0 - mipmap.exr tiles.exr
check "mip-maps: smaller levels do not" verdict 0 - mipmap.exr mipmap_level.exr
check "mip-maps: a pixel of the full size" verdict 1 differs mipmap.exr mipmap_pixel.exr
check "a deep EXR" verdict 2 unsupported ref.exr deep.exr
check "one line says so" refuses 2 "deep" "$penumbra" diff ref.exr deep.exr
head -c $(($(stat -c %s tiles.exr) - 30)) tiles.exr >cut_tiles.exr
check "an incomplete tiled EXR" verdict 1 incomplete tiles.exr cut_tiles.exr
check "parts with windows of their own" verdict 0 - windows.exr windows.exr
check "a pixel of the second window" verdict 1 differs windows.exr windows_pixel.exr
check "other windows of parts" verdict 1 size windows.exr parts.exr
check "a JPEG and its copy" verdict 0 - picture.jpg same.jpg
check "a JPEG of another quality" verdict 1 differs picture.jpg other_quality.jpg
check "a JPEG of which a pixel differs" verdict 1 differs picture.jpg pixel.jpg
check "that passes a wide limit" verdict 0 - picture.jpg pixel.jpg --fail-above flip=0.05
head -c $(($(stat -c %s picture.jpg) / 2)) picture.jpg >cut.jpg
check "an incomplete JPEG" verdict 1 damaged picture.jpg cut.jpg
check "a JPEG and an HDR" verdict 1 format picture.jpg picture.hdr
check "an HDR and its copy" verdict 0 - picture.hdr same.hdr
check "a pixel of an HDR" verdict 1 differs picture.hdr pixel.hdr
check "that HDR-FLIP sees" verdict 1 threshold picture.hdr pixel.hdr --fail-above hdr-flip=0
check "a pixel of an HDR without runs" verdict 1 differs narrow.hdr narrow_pixel.hdr
check "another size of an HDR" verdict 1 size picture.hdr narrow.hdr
head -c $(($(stat -c %s picture.hdr) - 10)) picture.hdr >cut.hdr
check "an incomplete HDR" verdict 1 damaged picture.hdr cut.hdr
check "16k images that are the same" verdict 0 - 16k.exr 16k_same.exr
check "16k images of which a pixel differs" verdict 1 differs 16k_same.exr 16k_pixel.exr --metrics max,pixels

# ---- thresholds
check "an error at its limit passes" verdict 0 - single.exr single_other.exr --fail-above max=1
check "an error above it fails" verdict 1 threshold single.exr single_other.exr --fail-above max=0.99
check "a similarity below its limit fails" verdict 1 threshold single.exr single_other.exr --fail-below psnr=1
check "the other layers have to be equal" verdict 1 differs layers.exr layers_z.exr --fail-above flip=1
check "FLIP does not cover alpha" verdict 1 differs ref.exr alpha.exr --fail-above flip=1
check "several thresholds" verdict 1 threshold ref.exr one_pixel.exr --fail-above max=1 --fail-above pixels=0
check "a number of pixels" verdict 0 - ref.exr one_pixel.exr --fail-above pixels=1
check "a share of pixels" verdict 0 - layers.exr layers_id.exr --fail-above share=0.001
check "pixels beyond a threshold of their own" verdict 0 - ref.exr one_pixel.exr --fail-above pixels=0 --pixel-threshold 0.9
check "an ignored layer" verdict 0 - layers.exr layers_z.exr --ignore-layers Z
check "an ignored layer that one file lacks" verdict 0 - layers.exr layers_extra.exr --ignore-layers noise
check "a masked pixel may differ" verdict 0 - ref.exr one_pixel.exr --mask mask.png
check "and be no number" verdict 0 - ref.exr nan.exr --mask mask.png
check "a masked pixel leaks into no neighbour" verdict 0 - ref.exr one_pixel.exr --mask mask.png --fail-above flip=0 --fail-above hdr-flip=0 --fail-below ssim=1
check "other pixels count under a mask" verdict 1 differs ref.exr one_ulp.exr --mask mask.png
check "a report on an image" refuses 2 "own" "$penumbra" diff ref.exr same.exr --json ./ref.exr
check "a map on an image" refuses 2 "--heatmap" "$penumbra" diff ref.exr same.exr --heatmap same.exr
check "a report with another's name" refuses 2 ".html" "$penumbra" diff ref.exr same.exr --html report.txt
check "no layer of that name" refuses 2 "--ignore-layers" "$penumbra" diff ref.exr same.exr --ignore-layers depht
check "max below" refuses 2 "use --fail-above" "$penumbra" diff ref.exr same.exr --fail-below max=1
check "ssim above" refuses 2 "use --fail-below" "$penumbra" diff ref.exr same.exr --fail-above ssim=1
check "an unknown metric" refuses 2 "hdr-flip" "$penumbra" diff ref.exr same.exr --fail-above fame=1
check "a limit that is no number" refuses 2 "--fail-above" "$penumbra" diff ref.exr same.exr --fail-above max=low
check "a limit of NaN" refuses 2 "--fail-above" "$penumbra" diff ref.exr same.exr --fail-above max=nan
check "a mask of another size" refuses 2 "--mask" "$penumbra" diff ref.exr same.exr --mask rgb.png
check "a black mask" refuses 2 "no pixel" "$penumbra" diff single.exr single.exr --mask single.exr
check "nothing left to compare" refuses 2 "--ignore-layers" "$penumbra" diff ref.exr same.exr --ignore-layers beauty
check "that has a kind" verdict 2 nothing-left ref.exr same.exr --ignore-layers beauty
check "so has a mask of another size" verdict 2 mask ref.exr same.exr --mask rgb.png
check "an unknown layer is refused before anything is compared" bash -c \
    "! '$penumbra' diff ref.exr one_pixel.exr --ignore-layers depht --json no.json >stdout 2>&1 && test ! -e no.json && ! grep -q FAILED stdout"
cp nowhere.exr "two
lines.exr" 2>/dev/null || cp text.exr "two
lines.exr"
check "a name of two lines is said in one" refuses 2 'two\nlines.exr' "$penumbra" diff ref.exr "two
lines.exr"

# ---- several files
mkdir -p a/sub b/sub
for frame in 0001 0002 0003; do cp ref.exr a/x.$frame.exr && cp same.exr b/y.$frame.exr; done
check "a sequence" verdict 0 - a/x.####.exr b/y.####.exr
cp one_pixel.exr b/y.0002.exr
check "a frame of a sequence" verdict 1 differs a/x.####.exr b/y.####.exr --heatmap heat.####.png
check "its heat map" test -s heat.0002.png
rm b/y.0003.exr
check "a missing frame" verdict 2 differs a/x.####.exr b/y.####.exr
check "patterns without files" refuses 2 "nothing" "$penumbra" diff nothing.####.exr b/y.####.exr
check "a heat map for several files" refuses 2 "--heatmap" "$penumbra" diff a/x.####.exr b/y.####.exr --heatmap heat.png
rm -r a/* b/*
mkdir a/sub b/sub
cp ref.exr a/one.exr && cp same.exr b/one.exr && cp rgb.png a/sub/two.png && cp rgb.png b/sub/two.png
check "folders" verdict 0 - a b
cp rgb_pixel.png b/sub/two.png
check "a difference in a sub-folder" verdict 1 differs a b
rm b/sub/two.png
check "a file that only one folder has" verdict 2 missing a b
mkdir -p masked/a masked/b
for side in a b; do cp ref.exr masked/$side/1.exr && cp wider.exr masked/$side/2.exr && cp ref.exr masked/$side/3.exr; done
cp one_ulp.exr masked/b/3.exr
check "a mask that fits some pairs" verdict 2 mask masked/a masked/b --mask mask.png --html masked.html
check "the others are compared all the same" test "$(grep -cE '"kind": "(mask|differs)"' report.json)" -eq 2
check "and stand in the page" test "$(grep -o '<section>' masked.html | wc -l)" -eq 3
check "a folder and a file" refuses 2 "two folders" "$penumbra" diff a ref.exr

# ---- reports
check "all reports" verdict 1 differs ref.exr one_pixel.exr --heatmap h.png --html report.html
check "a PNG" test "$(head -c 4 h.png | tail -c 3)" = PNG
black() { "$penumbra" diff "$1" "$1" --heatmap black.png >stdout && verdict 1 differs black.png "$2" --metrics pixels; }
"$penumbra" diff parts.exr parts_pixel.exr --heatmap h2.png >stdout
check "the heat map shows the second part" black parts.exr h2.png
"$penumbra" diff windows.exr windows_pixel.exr --heatmap h3.png >stdout
check "where its window is" black windows.exr h3.png
check "in a map of all windows" grep -qF '"pixels": 648,' report.json
check "the page holds its pictures" grep -qF 'data:image/png;base64,' report.html
check "the page loads nothing" test "$(grep -cE '(src|href)="?https?:|url\(|@import' report.html)" -eq 0
check "the JSON tells the conventions" grep -qF '(test - reference)^2 / (reference^2 + 0.01)' report.json
check "the result does not depend on threads" cmp <("$penumbra" diff ref.exr one_pixel.exr --threads 1) <("$penumbra" diff ref.exr one_pixel.exr --threads 5)
check "an unwritable report" refuses 3 "nofolder" "$penumbra" diff ref.exr same.exr --json /proc/nofolder/x.json

finish
