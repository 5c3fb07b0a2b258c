#!/usr/bin/env bash
# `penumbra bench` in several launches, and reports that are compared: as scripts meet it. Whether changes are found is
# tried elsewhere, with numbers that are not measured (tests/bench/comparison_test.cpp).
source "$(dirname "${BASH_SOURCE[0]}")/harness.sh"

bench() { "$penumbra" bench "$@" >stdout 2>stderr; }
small() { bench --size 64x64 --threads 1 --repetitions 2 --warmup 1 --patience 0 "$@"; }
holds() { local file=$1 text; shift; for text in "$@"; do grep -qF -- "$text" "$file" || { echo "  not in $file: $text"; return 1; }; done; }
exits_with() { local code=0 expected=$1; shift; "$@" || code=$?; [ "$code" -eq "$expected" ] || { echo "  exit code $code"; return 1; }; }

check "five launches" small --launches 5 --json five.json --trace t.json
launches() { python3 -c "import json; print(sorted({e['launch'] for e in json.load(open('$1'))['benchmarks'] if 'launch' in e}))"; }
check "are in the report" test "$(launches five.json)" = "[0, 1, 2, 3, 4]"
check "the trace is the last one's" grep -q traceEvents t.json
check "a report is read" bench --from five.json --json again.json --html page.html
check "and written as it was" cmp five.json again.json
check "the page is one" holds page.html "<!DOCTYPE html>" "<svg" "</html>"
calls() { python3 -c "import json; print(sorted({(e['pass'], e.get('limit_call', '')) for e in json.load(open('$1'))['benchmarks']}))"; }
check "the same launches compared" bench --from five.json --compare five.json --fail-slower 0 --json compared.json
check "have not changed" holds stdout "0 slower, 0 faster" "p of all"
check "the JSON says so, too" grep -q '"comparison"' compared.json
check "as many launches as the old report has" small --compare five.json
check "are compared" holds stdout "comparison of 5 launches then and 5 now"
check "their limits' calls are the old ones" small --launches 2 --calls-of five.json --json two.json
check "all of them" test "$(calls two.json)" = "$(calls five.json)"

check "too few launches are refused" exits_with 2 bench --from two.json --compare five.json
check "with what is needed" holds stderr "expected at least 5 launches of the program, got 2" "--launches"
check "before anything is measured" exits_with 2 small --compare two.json
check "another size" exits_with 2 bench --size 96x64 --threads 1 --repetitions 1 --patience 0 --compare five.json --json kept.json
check "is told" holds stderr "size 64 x 64 then, 96 x 64 now"
check "after the first launch: nothing is kept" test ! -e kept.json
check "too few launches asked for are refused" exits_with 2 small --launches 4 --compare five.json
check "before anything is measured" holds stderr "--launches: expected at least 5 with --compare, got 4"
check "--from with what is measured" exits_with 2 bench --from five.json --threads 1
check "is refused by name" holds stderr "--threads: --from measures nothing"
check "--fail-slower alone" exits_with 2 small --fail-slower 3
check "--from with a scene" exits_with 2 bench shot.json --from five.json
check "a report that is none" exits_with 2 bench --from page.html
check "outputs never overwrite the old report" exits_with 2 bench --from five.json --compare two.json --json two.json
check "an error of a launch is told once" exits_with 2 small --launches 3 nowhere.json
check "as that of the program" test "$(grep -c '^error: ' stderr)" -eq 1
finish
