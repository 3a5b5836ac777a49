#!/bin/sh
# `cleave converge`: error bars must contain known answers; budget of run time, repeated studies, refusals.
# Takes 30 s: studies of many small runs.
test_name=converge
. tests/support/summary.sh
inputs=$root/inputs
cd "$work" || exit 1

# value FIGURE COLUMN: prints an entry of converge.csv in $folder.
value()
{
    awk -F, -v figure="$1" -v column="$2" '
        NR == 1 { for (k = 1; k <= NF; k++) if ($k == column) at = k; next }
        $1 == figure { print $at }' "$folder/converge.csv"
}

# ---- a bar under traction, with known energy ---------------------------------------------------------------------------

# Energy of a bar in plane stress under a step of traction sigma on its end: the work is sigma^2 A c t/E with c = sqrt(E/rho) for Poisson's
# ratio 0; at 4 us the wave in 20 mm of steel has not reached the other end.
cat >bar.yaml <<'END'
space: line
accept: [steps]
duration: 3 us
method: pd
material: {young: 200 GPa, density: 8000}
body: {box: {from: [0], to: [20 mm]}}
particles: {spacing: 0.2 mm}
boundary:
  - {traction: [100 MPa], face: x+}
output: {frames: 0, samples: 20}
END
folder=bar
"$cleave" converge bar.yaml -o bar >out 2>err
is "status" $? 0
exact=$(compute "100e6 ^ 2 / 200e9 * 5000 * 3e-6")
low=$(compute "$(value energy.external_work value) - $(value energy.external_work uncertainty)")
high=$(compute "$(value energy.external_work value) + $(value energy.external_work uncertainty)")
between "work of a step, its interval from below" "$low" 0 "$exact"
between "and from above" "$high" "$exact" 1e9
between "and not wide" "$(value energy.external_work uncertainty)" 0 "$(compute "0.2 * $exact")"
is "levels" "$(head -n 1 bar/converge.csv | tr , '\n' | grep -c '^spacing_')" 4    # three levels, and spacing_moves
grep -q '^energy.external_work \[J\]$' out && pass || fail "what is printed: $(cat out)"
holds "a picture" test -s bar/pictures/convergence.png
is "runs" "$(ls bar | grep -c '^spacing')" 16       # five at each spacing, one with a longer horizon
is "what the user gave stays" "$(grep -c '^method: pd' bar/spacing*/scene.yaml | grep -c ':1$')" 16

# Repeated: nothing runs, and the table is equal.
cp bar/converge.csv before.csv
"$cleave" converge bar.yaml -o bar >again 2>err
is "again" $? 0
holds "the same table" cmp -s bar/converge.csv before.csv

# A larger budget is used for finer spacings; the scene's own spacing keeps its interval, which contains the answer.
"$cleave" converge bar.yaml -o finer --budget 60 -q >out
folder=finer
grep -q "at the scene's own 0.1996 mm" out && pass || fail "the scene's own: $(cat out)"
between "its interval" "$(compute "($(value energy.external_work mean_2) - $exact) / $(value energy.external_work uncertainty_2)")" -1 1
between "that of the finest" "$(compute "($(value energy.external_work mean_0) - $exact) / $(value energy.external_work uncertainty_0)")" -1 1
between "which is smaller" "$(compute "$(value energy.external_work uncertainty_0) / $(value energy.external_work uncertainty_2)")" 0.1 0.8
folder=bar

"$cleave" converge bar.yaml -o of --of energy.strain --runs 1 --levels 4 -q >out 2>err
is "one figure" "$(wc -l <of/converge.csv | tr -d ' ')" 2
is "nothing on standard error" "$(cat err)" ""

# ---- frames at given times, equal runs, coarse levels without a figure ------------------------------------------------

sed 's/frames: 0/times: [1 us, 2 us]/' bar.yaml >times.yaml
"$cleave" converge times.yaml -o times --runs 1 -q >out 2>err
is "frames at given times" $? 0
grep -q "scatter unknown (one run" out && pass || fail "one run: $(cat out)"
"$cleave" converge bar.yaml -o limit -s time.safety=1 -q >out
is "no two runs are equal" "$(cat limit/spacing*/scene.yaml | grep -c '^time')" "$(for run in limit/spacing*; do cksum <"$run/scene.yaml"; done | sort -u | wc -l | tr -d ' ')"

# ---- a run uses a study beside it ------------------------------------------------------------------------------------

"$cleave" converge bar.yaml -o runs/bar_converge --runs 1 -q >out
"$cleave" run bar.yaml -o runs/bar -q
folder=runs/bar_converge
near "in its summary" "$(figure runs/bar 'uncertainty.energy.external_work')" "$(value energy.external_work uncertainty_0)" 5e-3    # three digits
"$cleave" run bar.yaml -o runs/other -q -s particles.horizon=2.015
absent "not in that of another scene" "$(figure runs/other 'uncertainty.energy.external_work')"

# A scene whose name differs from its file's: study and run are in folders of the scene's name, where they find each other.
{ echo 'name: rod'; cat bar.yaml; } >named.yaml
"$cleave" converge named.yaml --runs 1 -q >out
folder=results/rod_converge
"$cleave" run named.yaml -q
near "by the scene's name" "$(figure results/rod 'uncertainty.energy.external_work')" "$(value energy.external_work uncertainty_0)" 5e-3
# Its folder refuses another scene, unless that scene replaces it.
"$cleave" converge bar.yaml -o results/rod_converge -s duration=2us --runs 1 -q >out 2>err
is "status of another scene" $? 2
grep -q "results/rod_converge contains a study of another scene" err && pass || fail "another scene: $(cat err)"
before=$(value energy.external_work value)
"$cleave" converge bar.yaml -o results/rod_converge -s duration=2us --runs 1 -q --overwrite >out 2>err
is "replaced" $? 0
near "work of a shorter time" "$(value energy.external_work value)" "$(compute "$before * 2 / 3")" 0.02
is "its unit" "$(value energy.external_work unit)" J

# ---- warnings of runs ------------------------------------------------------------------------------------------------

"$cleave" converge bar.yaml -o warned -s method=mpm -s mpm.cell=1 --runs 1 -q >out 2>err
is "warnings in a line" "$(grep -c '^warning: in 3 of 3 runs.*: mpm.cell: 1 puts one point into a cell' err) $(wc -l <err | tr -d ' ')" "1 1"

# ---- paths of tips ---------------------------------------------------------------------------------------------------

# The longest tip of a centre crack alternates between its ends, 10 mm apart: each has a line of its own. gnuplot's input is recorded.
mkdir bin
printf '#!/bin/sh\nexec tee -a "%s/drawn" | "%s" "$@"\n' "$work" "$(command -v gnuplot)" >bin/gnuplot
chmod +x bin/gnuplot
PATH=$work/bin:$PATH "$cleave" converge "$inputs/plate_crack.yaml" -o tips --runs 1 -q >out
is "both ends are drawn, no line between them" "$(awk '/^\$w/ { last = "" } /^(EOD)?$/ { last = ""; next }
    NF == 2 && $1 ~ /^-?[0-9.e-]+$/ && path { side = $1 < 0; if (last != "" && side != last) jumps++; last = side; seen[side] = 1 }
    /<< EOD/ { path = /^\$w/ } END { print jumps + 0, seen[0] + seen[1] }' drawn)" "0 2"

# Means of single runs are the runs; spacings are in millimetres.
points() { awk -v set="\$$1" '$1 == set { at = 1; next } $1 == "EOD" { at = 0 } at { print $1, $2 }' drawn | sort -g; }
is "means of single runs" "$(points m0)" "$(points r0)"
# Bars are those of pages: uncertainty_K of converge.csv, by scatter and spacing, over the mean; as much below it, also below 0.
is "bars that converge.csv does not have, of" "$(awk -F'[ ,]' '$1 == "$m0" { at = 1; next } $1 == "EOD" { at = 0 } at && NF == 4 { x[++n] = $1; bar[n] = $4 / $2 - 1; uneven += ($2 - $3) / ($4 - $2) < 0.999999 || ($2 - $3) / ($4 - $2) > 1.000001 }
    FNR == 1 && FILENAME != "drawn" { gsub(/ \[m\]/, ""); for (k = 1; k <= NF; k++) name[k] = $k; next }
    FILENAME != "drawn" { for (k = 1; k <= NF; k++) if (name[k] ~ /^spacing_[0-9]/) for (j = 1; j <= n; j++)
        if ((d = 1e3 * $k / x[j] - 1) * d < 1e-10 && (d = $(k + 3) / $(k + 1) - bar[j]) * d < 1e-14 && bar[j] > 0) seen[j] = 1 }
    END { for (j = 1; j <= n; j++) missing += !seen[j]; print missing + 0, (n > 1), uneven + 0 }' drawn tips/converge.csv)" "0 1 0"
spacing=$(sed -n 's/^ *spacing: \([0-9.e-]*\).*/\1/p' "$(ls -d tips/spacing*/ | head -n 1)scene.yaml")
holds "a spacing in mm: $spacing m" grep -q "^$(compute "1e3 * $spacing" | cut -c 1-5)" drawn

# ---- known answers ---------------------------------------------------------------------------------------------------

# 33 figures of bars and plates; single runs at a spacing do not differ here, so that there is no random error: at least 29 intervals
# contain the answer.
"$cleave" bench uncertainty --quick >out
held=$(awk -F, 'NR == 1 { for (k = 1; k <= NF; k++) at[$k] = k; next }
    { d = $at["value"] - $at["exact"]; if (d < 0) d = -d; n++; held += d <= $at["uncertainty"] } END { print held / n }' results/bench/uncertainty.csv)
between "share of known answers held" "$held" 0.87 1

# ---- budget ----------------------------------------------------------------------------------------------------------

# At 0.0005 mm a run takes a second: three seconds suffice only for coarser spacings, which is reported.
"$cleave" converge bar.yaml -o dear -s particles.spacing=0.0005mm --budget 3 >out 2>err
case $? in                               # a busy machine may have time for none
    0) grep -q "would take longer than the budget" err && pass || fail "coarser: $(cat err)" ;;
    *) grep -q -e "is too small" -e "none has a value at every spacing" err && pass || fail "too dear: $(cat err)" ;;
esac
"$cleave" converge bar.yaml -o dearer -s particles.spacing=0.0001mm --budget 0.3 >out 2>err
is "too dear" $? 2
grep -q "is too small: one run at [0-9.]* µm" err && pass || fail "too dear, in the unit of its spacing: $(cat err)"

# ---- refusals --------------------------------------------------------------------------------------------------------

refused()
{
    wanted=$1; shift
    "$cleave" converge "$@" >out 2>err
    is "status of $*" $? 2
    grep -qF -e "$wanted" err && pass || fail "$*: $(cat err)"
}
refused "no scene is given" -o none
refused "is too small" bar.yaml --budget 1us -o tiny
refused "more than 10.5" bar.yaml --horizon --levels 6 -o none
refused "give a time, such as" bar.yaml --budget 10mm -o none
refused "a number from 3 to 6" bar.yaml --levels 2 -o none
refused "to vary a key use cleave sweep" bar.yaml -s method=pd,mpm -o none
refused "unknown option" bar.yaml --list -o none
refused "unknown key" bar.yaml -s nonsense=1 -o none
holds "nothing is left behind" test ! -e none
# A wrong figure is refused before anything runs; the most similar name is stated.
refused "summary.json has no such figure" bar.yaml --of nonsense -o none
refused "did you mean crack.angle_deg?" bar.yaml --of crack.angel_deg -o none
refused "no such figure" bar.yaml --of probes.tip.x -o none
holds "nothing has run" test ! -e none
# The known names are those with which summaries are written.
grep -ho 'json_\(real\|count\|number\)(j, "[a-z_]*"' "$root/src/engine/summary.c" | sed 's/.*"\(.*\)"/\1/' >written
grep -ho 'probes_figures_put(e, "[a-z_]*"' "$root/src/probes/probes_figures.c" | sed 's/.*"\(.*\)"/\1/' >>written
cat "$root"/src/probes/*.c | tr '\n' ' ' | grep -o 'struct column \(sif\|rigid\)_figure\[[^;]*;' | grep -o '{"[A-Za-z_0-9]*"' | tr -d '{"' >>written
grep -o '\] = {"[A-Za-z_0-9]*"' "$root/src/probes/probes_bar.c" | sed 's/.*"\(.*\)"/\1/' >>written
is "names that figure_names.c lacks" "$(sort -u written | awk 'NR == FNR { text = text $0 "\n"; next }
    text !~ "[\" ]" $0 "[\" ]" { print }' "$root/src/study/figure_names.c" -)" ""
awk 'BEGIN { print "x,volume"; for (i = 0; i < 20; i++) printf "%.4f,1e-3\n", 0.0005 + i * 0.001 }' >points.csv
sed 's/^body:.*/bodies: [{name: bar, particles: points.csv}]/; s/0.2 mm/1 mm/' bar.yaml >list.yaml
refused "whose spacing cannot be refined" list.yaml -o none

finish
