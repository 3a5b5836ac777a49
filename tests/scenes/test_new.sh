#!/bin/sh
# Scenes written by `cleave new`: each kind must be valid, cause no advice, and run; existing files are not overwritten.
test_name=new
. tests/support/summary.sh

"$cleave" new >"$work/kinds" || fail "cleave new lists no kinds"
kinds=$(sed -n 's/^  \([a-z]*\) .*/\1/p' "$work/kinds")
is "kinds are the files of inputs/new" "$(echo "$kinds" | sort | tr '\n' ' ')" "$(ls inputs/new/*.yaml | sed 's|.*/||; s/.yaml//' | sort | tr '\n' ' ')"

cd "$work" || exit 1
for kind in $kinds; do
    holds "$kind: written" "$cleave" new "a_$kind.yaml" "$kind" >/dev/null
    holds "$kind: sound" "$cleave" check --no-trial "a_$kind.yaml" >"$work/check"
    is "$kind: advice" "$(grep -E '^(accuracy|hints)|check the units of' "$work/check" | grep -v 'bodies collide')" ""
    coarse=$([ $kind = stl ] && echo "-s particles.spacing=3mm")           # half of its time is the fit of surface weights
    holds "$kind: runs" "$cleave" run "a_$kind.yaml" -q $coarse -s duration=1us -o "$work/results_$kind" 2>/dev/null
done

# The kind of load steps, coarser: the plate between its grips parts, with the energy release rate of its material (300 J/m^2; bonds of this
# horizon within 2 %), and its load has a peak before it falls to nothing.
holds "slow: runs to the end" "$cleave" run a_slow.yaml -q -s variables.h=W/40 -o "$work/slow" 2>/dev/null
near "slow: energy release rate" "$(figure "$work/slow" load_steps.release_rate)" 300 5e-2
is "slow: load over displacement" "$(awk -F, 'NR == 1 { for (k = 1; k <= NF; k++) if ($k ~ /^reaction.force_y/) at = k; next }
    { last = $at; if (last > most) most = last } END { print (most > 100) (last < 1e-3 * most) }' "$work/slow/history.csv")" 11

holds "a kind is a name, too" "$cleave" new bar >/dev/null
is "of a scene of that kind" "$(grep -c '^space: line' bar.yaml)" 1

# refused WHAT MESSAGE WORDS...: checks that `cleave new WORDS...` ends with status 2 and one line that contains MESSAGE, and creates no
# file.
refused()
{
    what=$1 message=$2; shift 2
    files=$(ls | wc -l)
    "$cleave" new "$@" 2>"$work/.message"
    is "$what: status" $? 2
    is "$what" "$(cat "$work/.message")" "$message"
    is "$what: files" "$(ls | wc -l)" "$files"
}
refused "a scene that is there" "the file bar.yaml exists and is not replaced; choose another name" bar
touch c.stl
refused "a part that is there" "the file c.stl exists and is not replaced; choose another name" c stl
refused "an unknown kind" "there is no kind impct; did you mean impact? \`cleave new\` lists all kinds" b impct
refused "a name with a blank" "b c is not a valid name of a scene; use letters, digits, _ and -" "b c"
refused "a name that is none" ".yaml is not a valid name of a scene; use letters, digits, _ and -" .yaml
refused "a folder that is not there" "no/b.yaml: No such file or directory; choose a folder that can be written" no/b
refused "three words" "usage: cleave new NAME [KIND]" a bar b
finish
