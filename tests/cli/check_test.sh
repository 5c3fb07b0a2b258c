#!/usr/bin/env bash
# `penumbra check` as a user and a CI job meet it. Usage: check_test.sh PENUMBRA
source "$(dirname "${BASH_SOURCE[0]}")/harness.sh"

# scene NAME RADIANCE: two quads under a light, a moving camera.
scene() {
    mkdir -p "$(dirname "$1")"
    write_quads "$(dirname "$1")/quads.obj"
    cat >"$1.json" <<JSON
{
    "film": { "size": [96, 64] },
    "camera": { "eye": [0, 2, 3], "target": [0, 0, 0], "vfov": 40,
                "keys": [ { "time": 0, "eye": [0, 2, 3] }, { "time": 1, "eye": [1, 2, 3] } ] },
    "models": [ { "name": "quads", "file": "quads.obj" } ],
    "lights": [ { "name": "key", "type": "rect", "center": [0, 2, 0], "u": [0.5, 0, 0], "v": [0, 0, 0.5],
                  "radiance": [$2] } ]
}
JSON
}
run() { "$penumbra" check "$@" >stdout 2>stderr; }
exits_with() {
    local code=$1 status=0
    shift
    "$@" >stdout 2>stderr || status=$?
    [ "$status" -eq "$code" ] || { echo "  exit code $status:"; head -n 20 stdout stderr; return 1; }
}
checks_with() { exits_with "$1" "$penumbra" check "${@:2}"; }
says() { grep -qF -- "$1" stdout || { echo "  stdout lacks: $1"; cat stdout; return 1; }; }
complains() { grep -qF -- "$1" stderr || { echo "  stderr lacks: $1"; cat stderr; return 1; }; }
is_silent() { [ ! -s stderr ] || { cat stderr; return 1; }; }
# The command that the last run printed, run by a shell in the same folder.
paste_command() { sed -n 's/^  \(.* check .*\)/\1/p' stdout | tail -n 1 >command.sh; bash command.sh >stdout 2>stderr; }
stamps() { stat -c '%n %Y.%s %i' "$@"; sha256sum "$@"; }
has() { local f; for f in "$@"; do [ -s "$f" ] || { echo "  missing: $f"; return 1; }; done; }
renderer() { printf '#!/bin/bash\n%s\n' "$2" >"$1"; chmod +x "$1"; }

# ---- from nothing to a golden, by what the program itself says
scene a/shot "10, 9, 8"
scene a/dim "1, 0.9, 0.7"
echo '{ "name": "no scene of ours", "version": [1, 2] }' >a/package.json
echo 'not even JSON' >a/notes.json
echo 'no scene' >a/notes.txt
check "a folder without checks is refused" refuses 2 "has nothing to check" "$penumbra" check a
check "a folder that is not there is refused" refuses 2 "no such file" "$penumbra" check nowhere
check "a file that is no scene is refused" refuses 2 "expected a scene" "$penumbra" check a/notes.txt
check "no path at all is refused" refuses 2 "PATHS" "$penumbra" check
check "an empty path is refused" refuses 2 "empty" "$penumbra" check ""
check "a scene without a golden fails" checks_with 1 a/shot.json
check "and is called missing" says "there is no golden a/shot.golden.exr"
check "and no golden appears by itself" test ! -e a/shot.golden.exr
check "the command it prints makes the golden" paste_command
check "which is there" has a/shot.golden.exr
check "and passes" checks_with 0 a/shot.json
check "without a word on stderr" is_silent
check "from now on the folder is enough" checks_with 0 a
check "and only what has a golden is checked" says "1 check: 1 passed"

# ---- a change, seen and accepted
echo '{ "render": { "size": "64x48", "aov": ["beauty", "Z"] } }' >a/dim.check.json
check "a scene marked by its settings is found" checks_with 1 a
check "missing goldens are made where that is asked for" checks_with 0 a --bless-missing
check "rendered as its settings say" bash -c "'$penumbra' info a/dim.golden.exr | grep -q '64 x 48' && '$penumbra' info a/dim.golden.exr | grep -q 'Z float'"
stamps a/*.golden.exr >before
scene a/shot "10, 9, 7"
check "a difference fails" checks_with 1 a --bless-missing
check "with its numbers" says "differs: beauty: B: up to"
check "and the worst tile" says "worst tile at"
check "the other one passes" says "passed"
check "nothing was written" bash -c "diff before <(stat -c '%n %Y.%s %i' a/*.golden.exr; sha256sum a/*.golden.exr)"
check "the printed command accepts it" paste_command
check "and says what it wrote" says "updated: a/shot.golden.exr"
check "the other golden keeps its bytes and times" bash -c "stat -c '%n %Y.%s %i' a/dim.golden.exr | diff - <(grep '^a/dim.golden.exr ' before)"
check "then all pass" checks_with 0 a
stamps a/*.golden.exr >before
check "accepting where nothing changed" checks_with 0 a --update --bless-missing
check "writes nothing" bash -c "diff before <(stat -c '%n %Y.%s %i' a/*.golden.exr; sha256sum a/*.golden.exr)"
head -c 300 a/shot.golden.exr >cut && cp cut a/shot.golden.exr
check "a damaged golden fails" checks_with 1 a
check "and can be replaced" checks_with 0 a --update
check "without partial files" bash -c '[ -z "$(find . -name "*.part")" ]'

# ---- how much may differ
scene a/shot "10, 9, 7.001"
check "the smallest change fails" checks_with 1 a/shot.json
echo '{ "diff": { "fail-above": "max=0.1" } }' >a/shot.check.json
check "a limit without a reason is refused" checks_with 2 a
check "and says so" complains '"reason" is missing'
check "the other scenes are checked all the same" says "passed"
echo '{ "diff": { "fail-above": "max=0.1" }, "reason": "the lamp is still being chosen" }' >a/shot.check.json
check "a limit with a reason lets it pass" checks_with 0 a
cp a/shot.golden.exr golden
check "a picture within its limit" checks_with 0 a --update
check "is not taken as the golden" cmp golden a/shot.golden.exr
echo '{ "diff": { "fail-above": "max=1e-9" }, "reason": "none" }' >a/shot.check.json
check "a limit that is broken fails" checks_with 1 a
check "with the metric and the limit" says "threshold: beauty: max is"
echo '{ "diff": { "ignore-layers": "beuty" }, "reason": "none" }' >a/shot.check.json
check "a layer that does not exist is refused" checks_with 2 a
echo '{ "rendr": {} }' >a/shot.check.json
check "an unknown key is refused" checks_with 2 a
check "with the nearest one" complains 'did you mean "render"?'
echo '{ "render": { "spp": 100000 } }' >a/shot.check.json
check "so is an option's value" checks_with 2 a
check "with its place" complains "a/shot.check.json: render.spp: expected a number, 1 to 64, got \"100000\""
rm a/shot.check.json
check "--update restores the peace" checks_with 0 a --update

# ---- several frames
mkdir -p f && scene f/walk "10, 9, 8"
echo '{ "render": { "frames": [1, 13, 25], "size": "48x32" } }' >f/walk.check.json
check "frames have a golden each" checks_with 0 f --bless-missing
check "by their numbers" has f/walk.golden.0001.exr f/walk.golden.0013.exr f/walk.golden.0025.exr
rm f/walk.golden.0013.exr
check "one of them is missing" checks_with 1 f
check "which is said" says "frame 0013: there is no golden"
check "and mended" checks_with 0 f --bless-missing
echo '{ "render": { "frames": "1,13", "size": "48x32" } }' >f/walk.check.json
check "a golden too many is no failure" checks_with 0 f
check "but a warning" complains "f/walk.golden.0025.exr: no frame is compared with it"
echo '{ "render": { "frames": "1,1", "size": "48x32" } }' >f/walk.check.json
check "a single frame has no number" checks_with 1 f

# ---- goldens that prove nothing
mkdir -p u && scene u/black "0, 0, 0" && scene u/one "10, 9, 8" && cp u/one.json u/two.json
echo '{ "render": { "crop": "0,0,4,4", "method": "unshadowed" } }' >u/corner.check.json
cp u/one.json u/corner.json
sed -i 's/"lights"/"environment": { "radiance": [1, 1, 1] }, "lights"/' u/corner.json
for name in black one two; do echo '{}' >u/$name.check.json; done
check "black, one colour and twins" checks_with 1 u --bless-missing
check "black is refused" says "unfit golden: u/black: the new render is black"
check "one colour is refused" says "unfit golden: u/corner: the new render has one colour everywhere"
check "twins are refused" says "unfit golden: u/two: the new render has the same pixels as u/one.golden.exr"
check "none of them is written" bash -c '[ -z "$(ls u/*.golden.exr 2>/dev/null)" ]'
check "no command offers to take them" bash -c "! grep -q 'check.*u/black' stdout"
"$penumbra" render u/black.json -o u/black.golden.exr --progress none
"$penumbra" render u/one.json -o u/one.golden.exr --progress none
cp u/one.golden.exr u/two.golden.exr
check "goldens that lie there are judged too" checks_with 1 u
check "black" says "u/black.golden.exr is black"
check "equal" says "u/two.golden.exr has the same pixels as u/one.golden.exr"
rm u/two.* u/black.* u/corner.*
check "what is left is fit" checks_with 0 u
scene u/one "0, 0, 0"
check "a scene that has become black" checks_with 1 u --update
check "does not become the golden" says "the new render is black: it is not taken"

# ---- errors of one scene are that scene's alone
mkdir -p e && scene e/bad "10, 9" && scene e/good "10, 9, 8"
for name in bad good; do echo '{}' >e/$name.check.json; done
run e --bless-missing
check "a scene that is wrong is an error of its own" checks_with 2 e --junit e.xml --json e.json --html e.html
check "it is named" complains "error: e/bad: e/bad.json: lights[0].radiance"
check "the others pass" says "passed"
check "JUnit has it as an error" grep -q '<error type="scene" message="scene: e/bad.json: lights\[0\].radiance' e.xml
check "JSON too" grep -q '"kind": "scene"' e.json
check "the page too" grep -q 'data-verdict="error"' e.html
scene e/bad "10, 9, 7"
run e --bless-missing
renderer crash 'case "$2" in *bad*) kill -SEGV $$ ;; *) exec "'"$penumbra"'" "$@" ;; esac'
check "a crash is an error of its own" checks_with 3 e --renderer ./crash --junit e.xml
check "with its signal" complains "crashed (signal 11"
check "and the others pass" says "passed"
check "JUnit tells it from failures" grep -q '<error type="crash"' e.xml
renderer hang 'case "$2" in *bad*) sleep 60 & wait ;; *) exec "'"$penumbra"'" "$@" ;; esac'
check "a render that hangs is ended" checks_with 3 e --renderer ./hang --timeout 2
check "which is said" complains "took longer than 2 s"
renderer stray 'echo "error: out of pencils" >&2; exit 3'
check "a render that fails" checks_with 3 e --renderer ./stray
check "says why" complains "e/good: out of pencils"
renderer silent 'exit 0'
check "a renderer that writes nothing" checks_with 3 e --renderer ./silent
check "is caught" complains "wrote no picture"
renderer odd 'exit 42'
check "an unknown exit code" checks_with 3 e --renderer ./odd
renderer swap 'for a in "$@"; do case "$a" in --output=*) o=${a#--output=} ;; esac; done
'"'$penumbra'"' "$@" && cp '"'$work'"'/e/good.golden.exr "${o/\#\#\#\#/0001}"'
check "a renderer that draws something else is caught" checks_with 1 e --renderer ./swap
check "a renderer that is not there is refused" refuses 2 "--renderer" "$penumbra" check e --renderer ./none
chmod a-w e
if [ ! -w e ]; then
    scene_before=$(sha256sum e/good.golden.exr)
    check "a golden that cannot be written is an error" checks_with 3 e --renderer ./swap --update
else
    skip "goldens that cannot be written: this user may write anywhere"
fi
chmod u+w e

# ---- options are handed on
renderer log 'echo "$@" >>'"'$work'"'/calls; exec '"'$penumbra'"' "$@"'
check "with other threads and lanes" checks_with 0 e --renderer ./log --threads 3 --isa avx2 --trace-isa avx2 --jobs 2
check "each render has them" test "$(grep -c -- '--threads=3.*--isa=avx2' calls)" -eq 2
check "an unknown instruction set is refused" refuses 2 "--isa" "$penumbra" check e --isa sse
sort_lines() { sed -E 's/[0-9.]+ s//' "$1"; }
run e --jobs 1 && sort_lines stdout >serial
run e --jobs 4 && sort_lines stdout >parallel
check "the number of jobs changes no line" cmp serial parallel

# ---- choosing
check "a list" checks_with 0 e a --list
check "names all" test "$(wc -l <stdout)" -eq 4
check "with what is there" says "$(printf 'e/good\te/good.check.json\t1 golden')"
check "a filter" checks_with 0 e a --filter 'go?d' --list
check "leaves those" test "$(wc -l <stdout)" -eq 1
check "a filter that fits nothing is refused" refuses 2 "--filter" "$penumbra" check e --filter sphere
mkdir -p "odd 'name'" && scene "odd 'name'/it's # 1" "3, 2, 1"
check "a name that shells do not like" checks_with 1 "odd 'name'/it's # 1.json"
check "is quoted in the command" paste_command
check "so that it works" checks_with 0 "odd 'name'"

# ---- reports
scene e/good "10, 9, 6"
check "reports of a failure" checks_with 1 e --html report/ --junit r.xml --json r.json --output new
check "the page" has report/index.html
check "needs nothing but itself" bash -c "! grep -Eq '(src|href)=\"(https?:|/|[a-z])' <(sed 's/src=\"data:/src=\"#/g' report/index.html)"
check "has the pictures" grep -q 'data-reference="data:image/png;base64,.*data-test="data:image/png' report/index.html
check "the command" grep -q '<code>.* check --update e/good.check.json</code>' report/index.html
check "and what passed" grep -q 'data-verdict="passed"' report/index.html
check "the new pictures are kept" has new/good.0001.exr new/bad.0001.exr
check "with what the renderer said" test -e new/good.log
check "JUnit counts" grep -q 'tests="2" failures="1" errors="0"' r.xml
check "the JSON has the numbers" grep -q '"max": 0' r.json
check "and the command" grep -q '"accept": ".*check --update e/good.check.json"' r.json
if command -v python3 >/dev/null; then
    scene "e/a<b&\"c\"" "4, 5, 6"
    run "e/a<b&\"c\".json" e --junit odd.xml
    check "JUnit is XML" python3 -c "
import xml.etree.ElementTree as tree
for file in ('e.xml', 'r.xml', 'odd.xml'):
    root = tree.parse(file).getroot()
    suites = root.findall('testsuite')
    assert root.tag == 'testsuites' and len(suites) == 1
    cases = suites[0].findall('testcase')
    assert len(cases) == int(suites[0].get('tests'))
    assert sum(c.find('failure') is not None for c in cases) == int(suites[0].get('failures'))
    assert sum(c.find('error') is not None for c in cases) == int(suites[0].get('errors'))
    assert all(c.get('name') and c.get('classname') and float(c.get('time')) >= 0 for c in cases)
names = [c.get('name') for c in tree.parse('odd.xml').iter('testcase')]
assert 'a<b&\"c\"' in names, names
"
    check "the JSON is JSON" python3 -c "import json; assert json.load(open('r.json'))['exit_code'] == 1"
    rm e/a*
else
    skip "reading the reports: no python3"
fi
check "a report that cannot be written" refuses 3 "nope" "$penumbra" check a --junit /proc/nope/r.xml
check "a report in place of a scene is refused" refuses 2 "--json" "$penumbra" check a --json a/shot.json
check "or of a golden" refuses 2 "own" "$penumbra" check a --json a/shot.golden.exr
check "or of a model, whose name is no report's" refuses 2 ".html" "$penumbra" check a --html model.obj
a_failing_report_does_not_keep_others() {
    "$penumbra" check a --html /proc/nope/r.html --junit still.xml --json still.json >stdout 2>stderr
    [ -s still.xml ] && [ -s still.json ] && grep -q "nope" stderr
}
check "one that cannot be written does not keep the others from it" a_failing_report_does_not_keep_others
a_scene_may_begin_with_a_dash() {
    mkdir dash && cp -r a/. dash/ && cd dash && mv shot.json ./-shot.json && mv shot.golden.exr ./-shot.golden.exr &&
        rm -f ./*.check.json && "$penumbra" check ./-shot.json >../stdout 2>../stderr
    local status=$?
    cd ..
    ! grep -q "no such option" stderr && [ "$status" -le 1 ]
}
check "a scene's name may begin with a dash" a_scene_may_begin_with_a_dash
check "two reports in one file are refused" refuses 2 "--junit" "$penumbra" check a --json r --junit r
check "an empty name is refused" refuses 2 "--html" "$penumbra" check a --html ""

# ---- interrupted
renderer slow 'echo $$ >'"'$work'"'/slow.pid; sleep 60 & wait'
mkdir tmp
TMPDIR=$work/tmp "$penumbra" check e --renderer ./slow --update >stdout 2>stderr &
pid=$!
for _ in $(seq 200); do [ -s slow.pid ] && break; sleep 0.05; done
kill -TERM $pid
status=0
wait $pid || status=$?
check "an interrupt ends it" test "$status" -eq 143
check "and its renders" bash -c '! kill -0 "$(cat slow.pid)" 2>/dev/null'
check "no folder is left behind" bash -c '[ -z "$(ls tmp)" ]'

finish
