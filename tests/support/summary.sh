#!/bin/sh
# Functions for all test scripts: figures from summary.json and history.csv by awk alone, and counted checks. Sourced from the root of the
# project after `test_name` is set. Sets $cleave (the program), $root (the root of the project) and $work, a temporary folder that is
# removed at the end.
set -u
root=$(pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 1' INT TERM HUP
cleave=$work/cleave                      # a copy: a concurrent build must not mix two programs in one test
cp "${BUILD:-build}/cleave" "$cleave" || exit 1
look_through=$(cd "${BUILD:-build}" && pwd)/tests/robustness/test_numbers       # built by `make test`
[ -x "$look_through" ] || look_through=true
checks=0 failures=0

fail() { echo "$test_name: $1" >&2; failures=$((failures + 1)); }
pass() { checks=$((checks + 1)); }

# numbers FOLDER: checks that all numbers in frames and histories below the folder are finite. Columns may be nan that have no value:
# without a crack tip or front, with fewer than two contours, without stress-intensity factors or yielded points.
numbers()
{
    none=$(find "$1" \( -path '*/frames/*.hdf' -o -name 'particles_*.h5' \) -exec "$look_through" {} + -o -name history.csv -exec awk -F, '
        FNR == 1 { for (k = 1; k <= NF; k++) name[k] = $k; next }
        { for (k = 1; k <= NF; k++)
            if ($k ~ /inf/ || $k ~ /nan/ && name[k] !~ /^tip_[xyz]|\.[xyz] |\.(front|plateau)|\.contour_spread|\.K_eq|\.strain_(elastic|plastic)|^release_rate|^K_I|^path_[xyz]|\.K_I|\.J /)
                none[FILENAME ": " name[k] ": " $k]++ }
        END { for (what in none) print what }' {} +) || fail "$1: $none"
    is "$1: numbers" "$none" ""
}

# finish: performs the noted comparisons, prints the number of checks, and exits with status 0 if none has failed.
finish()
{
    numbers "$work"
    [ ! -f "$work/.noted" ] || compare_noted
    echo "$test_name: $checks checks held, $failures failed"
    [ $failures -eq 0 ]
    exit
}

# note KIND WHAT NUMBER...: notes a comparison of numbers, which `finish` performs. One start of awk for all saves time: one for each took
# longer than many of the runs that are tested.
note() { printf '%s\034%s\034%s\034%s\034%s\035' "$1" "$2" "$3" "$4" "$5" >>"$work/.noted"; }

# compare_noted: performs the noted comparisons and counts those that hold and those that fail.
compare_noted()
{
    set -- $(awk -v test="$test_name" '
        BEGIN { FS = "\034"; RS = "\035"; number = "^[-+]?[0-9.]+([eE][-+]?[0-9]+)?$" }
        function differ_by(a, b, most, unit) {
            if (unit < 0) unit = -unit
            return a ~ number && b ~ number && most ~ number && a - b <= most * unit && b - a <= most * unit
        }
        { shown = $3 == "" ? "missing" : $3; other = $4 == "" ? "missing" : $4 }
        $1 == "between" { held = $3 ~ number && $3 + 0 >= $4 + 0 && $3 + 0 <= $5 + 0; text = shown ", not within " $4 " and " $5 }
        $1 == "apart" { held = differ_by($3, $4, $5, 1); text = shown " and " other " are more than " $5 " apart" }
        $1 == "near" { held = differ_by($3, $4, $5, $4); text = shown " and " other " are more than " $5 " of the second apart" }
        held { right++; next }
        { wrong++; print test ": " $2 ": " text >"/dev/stderr" }
        END { print right + 0, wrong + 0 }' "$work/.noted")
    checks=$((checks + $1)) failures=$((failures + $2))
}

# figure DIR PATH: prints the entry of DIR/summary.json with this path, as in crack.tips.0.x; nothing if there is none. With several paths
# it prints a line for each, in the order of the file.
figure()
{
    [ -f "$1/summary.json" ] || return 0
    summary=$1/summary.json; shift
    awk -v paths="$*" '
        BEGIN { left = split(paths, path_of, " "); for (k in path_of) wanted[path_of[k]] = 1 }
        { text = text $0 "\n" }
        function place(key) { path[depth + 1] = depth > 1 ? path[depth] "." key : key }
        END {
            while (length(text) > 0) {
                if (match(text, /^[ \t\n,:]+/)) { text = substr(text, RLENGTH + 1); continue }
                letter = substr(text, 1, 1)
                if (letter == "}" || letter == "]") { depth--; text = substr(text, 2); continue }
                if (list[depth]) { place(count[depth]++); named = 1 }
                if (letter == "{" || letter == "[") {
                    depth++; list[depth] = letter == "["; count[depth] = 0; named = 0
                    text = substr(text, 2); continue
                }
                if (letter == "\"") { match(text, /^"([^"\\]|\\.)*"/); word = substr(text, 2, RLENGTH - 2) }
                else { match(text, /^[^ \t\n,}\]]+/); word = substr(text, 1, RLENGTH) }
                text = substr(text, RLENGTH + 1)
                if (letter == "\"" && !named) { place(word); named = 1; continue }
                named = 0
                if (path[depth + 1] in wanted) { print word; if (--left == 0) exit }
            }
        }' "$summary"
}

# column DIR NAME TIME: prints a column of DIR/history.csv (its name without the unit) at the last sample not after TIME [s].
column()
{
    awk -F, -v name="$2" -v time="$3" '
        NR == 1 { for (k = 1; k <= NF; k++) { sub(/ \[.*/, "", $k); if ($k == name) at = k } next }
        at && $1 + 0 <= time * (1 + 1e-9) { value = $at }
        END { print value }' "$1/history.csv"
}

# passes DIR NAME VALUE: prints the time [s] of the first sample at which a column of DIR/history.csv is at least VALUE.
passes()
{
    awk -F, -v name="$2" -v value="$3" '
        NR == 1 { for (k = 1; k <= NF; k++) { sub(/ \[.*/, "", $k); if ($k == name) at = k } next }
        at && $at + 0 >= value + 0 { print $1; exit }' "$1/history.csv"
}

# compute FORMULA: prints the value of a formula, evaluated by awk.
compute() { awk "BEGIN { printf \"%.9g\", $1 }" </dev/null; }

# record WHAT VALUE TEXT: appends a measured value to the file $FIGURES if that is set; long_claims.sh compares it with documents.
record() { [ -z "${FIGURES:-}" ] || echo "$1 is ${2:-missing} $3" >>"$FIGURES"; }

# between WHAT VALUE LOW HIGH: checks that VALUE is a number with LOW <= VALUE <= HIGH.
between() { record "$1" "$2" "within $3 $4"; note between "$1" "$2" "$3" "$4"; }

# apart WHAT A B MOST: checks that two numbers differ by at most MOST.
apart() { record "$1" "$2" "beside $3"; note apart "$1" "$2" "$3" "$4"; }

# near WHAT VALUE WANTED TOLERANCE: checks that the difference of two numbers is at most TOLERANCE times the second.
near()
{
    [ -z "${FIGURES:-}" ] || record "$1 over $3" "$(compute "(${2:-nan}) / ($3)")" ""
    record "$1" "$2" "beside $3"
    note near "$1" "$2" "$3" "$4"
}

# absent WHAT VALUE: checks that VALUE, a figure of a run, is empty.
absent() { if [ -z "$2" ]; then pass; else fail "$1: $2, where there should be none"; fi; }

# is WHAT VALUE WANTED: checks that two words are equal.
is() { if [ "$2" = "$3" ]; then pass; else fail "$1: '$2', not '$3'"; fi; }

# holds WHAT COMMAND...: checks that the command succeeds.
holds()
{
    claim=$1; shift
    if "$@"; then pass; else fail "$claim"; fi
}
