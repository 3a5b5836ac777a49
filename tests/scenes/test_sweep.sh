#!/bin/sh
# `cleave sweep`: runs and tables of a sweep; finished runs are skipped, failed ones are counted, a second sweep in the same folder is
# refused; kills during runs.
# Takes 20 s: sixty short runs, and a picture for each key.
test_name=sweep
. tests/support/summary.sh
cd "$work" || exit 1

cat >bar.yaml <<'END'
space: plane stress
accept: [stress, steps]
thickness: 1 mm
duration: 8 us
method: pd
material: {young: 72 GPa, density: 2440, toughness: 1e8}
body: {box: {from: [0, 0], to: [20 mm, 10 mm]}}
particles: {spacing: 1 mm}
boundary:
  - {traction: [10 MPa, 0], face: x+}
output: {frames: 0, samples: 10}
END

# ---- two keys --------------------------------------------------------------------------------------------------------

"$cleave" sweep bar.yaml -s particles.spacing=1mm,0.5mm -s boundary.0.traction='[5 MPa, 0],[10 MPa, 0],[20 MPa, 0]' -o two >out 2>err
is "status" $? 0
is "rows" "$(wc -l <two/sweep.csv | tr -d ' ')" 7
is "folders" "$(find two -name summary.json | wc -l | tr -d ' ')" 6
is "no logs of runs that said nothing" "$(ls two/logs 2>/dev/null)" ""
head -n 1 two/sweep.csv | grep -q '^run,state,particles.spacing,boundary.0.traction,steps,' && pass || fail "columns: $(head -n 1 two/sweep.csv | cut -c 1-90)"
is "cells with commas are in quotes" "$(sed -n 2p two/sweep.csv | cut -d, -f1-6)" '"spacing=1mm,traction=5MPa,0",done,1mm,"[5 MPa'
is "maps and lines" "$(ls two/pictures | paste -s -d ' ' -)" "boundary.0.traction.png map.png particles.spacing.png"
grep -q '^6 runs: 6 done; table: two/sweep.csv$' out && pass || fail "what is printed: $(cat out)"
# The table agrees with the runs; twice the load does four times the work (linear body; 1e-3 for rounding and large displacements).
one=$(figure two/spacing=1mm,traction=5MPa,0 energy.external_work) two=$(figure two/spacing=1mm,traction=10MPa,0 energy.external_work)
near "work over load squared" "$two" "$(compute "4 * $one")" 1e-3
grep -q "$(printf '%.12g' "$one" | cut -c 1-10)" two/sweep.csv && pass || fail "the work of the first run, $one, is not in the table"

# ---- finished runs are kept ------------------------------------------------------------------------------------------

cp two/sweep.csv before.csv
stamp=$(find two -name history.csv -exec ls -l --time-style=full-iso {} + | sort)
"$cleave" sweep bar.yaml -s particles.spacing=1mm,0.5mm -s boundary.0.traction='[5 MPa, 0],[10 MPa, 0],[20 MPa, 0]' -o two >out 2>err
is "again" $? 0
grep -q '^6 runs: 6 done (6 of them by an earlier sweep)' out && pass || fail "nothing to do: $(cat out)"
is "untouched" "$(find two -name history.csv -exec ls -l --time-style=full-iso {} + | sort)" "$stamp"
holds "the same table" cmp -s two/sweep.csv before.csv

# ---- the list as interface of schedulers -----------------------------------------------------------------------------

keys="-s particles.spacing=1mm,0.5mm -s boundary.0.traction=[5MPa,0],[10MPa,0],[20MPa,0]"
"$cleave" sweep bar.yaml $keys -o listed --list -t 1 >list
is "lines" "$(wc -l <list | tr -d ' ')" 6
holds "nothing runs" test ! -e listed
for task in 1 2; do sh -c "$(sed -n "${task}p" list)" >/dev/null 2>&1; done     # as a task of a Slurm array does
if command -v parallel >/dev/null 2>&1; then parallel -j 2 <list >/dev/null 2>&1
else xargs -d "\n" -P 2 -I % sh -c % <list >/dev/null 2>&1; fi
"$cleave" sweep bar.yaml $keys -o listed --collect >out
is "collected" $? 0
grep -q '^6 runs: 6 done' out && pass || fail "collected: $(cat out)"
sed 's/,threads.*//' listed/sweep.csv | awk -F, 'NR > 1 { print $NF }' >a
is "rows of the list" "$(wc -l <listed/sweep.csv | tr -d ' ')" 7
same=0
for run in two/spacing*; do cmp -s "$run/history.csv" "listed/$(basename "$run")/history.csv" && same=$((same + 1)); done
is "the same histories" $same 6

# A job starts in another folder: the lines have absolute paths of program, scene and folder, and the option of --overwrite.
mkdir -p elsewhere/there
"$cleave" sweep bar.yaml -s method=pd,mpm -o jobs --list >list
(cd elsewhere/there && SLURM_ARRAY_TASK_ID=2 && sh -c "$(sed -n "${SLURM_ARRAY_TASK_ID}p" ../../list)" 2>/dev/null)
is "a job of a list, elsewhere" $? 0
holds "and where it was asked for" test "$(figure jobs/method=mpm status)" = done
mkdir bin && cp "$cleave" bin/cleave
bin/cleave sweep bar.yaml -s method=pd,mpm -o jobs --list --overwrite >list
is "a list that overwrites" "$(grep -c ' --overwrite ' list) $(grep -c resume list)" "2 0"
(cd elsewhere/there && sh -c "$(sed -n 2p ../../list)")
is "with the whole name of the program" $? 0

# ---- equal runs ------------------------------------------------------------------------------------------------------

# Keys in another order: the same runs, none added.
"$cleave" sweep bar.yaml -s boundary.0.traction='[10 MPa, 0],[5 MPa, 0]' -s particles.spacing=0.5mm,1mm -o two >out 2>err
is "keys in another order" $? 0
grep -q '^4 runs: 4 done (4 of them by an earlier sweep)' out && pass || fail "keys in another order: $(cat out err)"
# A value in other units: one run, a row for each.
"$cleave" sweep bar.yaml -s particles.spacing=1mm,0.001,2mm -s material.density=2440,2500 -o units >out 2>err
is "values in other units" $? 0
grep -q '^4 runs: 4 done; ' out && pass || fail "values in other units: $(cat out)"
grep -q '^warning: 2 of 6 combinations are the same scene as another one (for instance' err && pass || fail "said in a line: $(cat err)"
is "rows" "$(grep -c '^"*density=2440,spacing=1mm' units/sweep.csv) $(wc -l <units/sweep.csv | tr -d ' ')" "2 7"
is "lines of the list" "$("$cleave" sweep bar.yaml -s particles.spacing=1mm,0.001,2mm -o units2 --list 2>err | wc -l | tr -d ' ')" 2
# The folder of a study is named after its scene's own name.
{ echo 'name: rod'; sed 's/10 MPa, 0/15 MPa, 0/' bar.yaml; } >other.yaml
cp two/sweep.csv before.csv
refused()
{
    wanted=$1; shift
    "$cleave" sweep "$@" >out 2>err
    is "status of $*" $? 2
    grep -qF "$wanted" err && pass || fail "$*: $(cat err)"
}
for how in "" --list --collect; do refused "two contains a study of another scene" other.yaml -s particles.spacing=1mm,2mm -o two $how; done
refused "contains a study of another scene" bar.yaml -s method=mpm -s particles.spacing=1mm,2mm -o two
holds "its table stays" cmp -s two/sweep.csv before.csv
"$cleave" sweep other.yaml -s particles.spacing=1mm,2mm -o units --overwrite -q >out 2>err
is "replaced" "$? $(wc -l <units/sweep.csv | tr -d ' ')" "0 3"
"$cleave" sweep other.yaml -s particles.spacing=1mm,2mm -q >out 2>err
holds "by the scene's name" test -f results/rod_sweep/sweep.csv
# A scene that is incomplete without the varied keys.
sed '/^particles/d' bar.yaml >part.yaml
"$cleave" sweep part.yaml -s particles.spacing=1mm,2mm -o part -q >out 2>err
is "a scene in part" $? 0
"$cleave" sweep part.yaml -s particles.spacing=4mm,2mm -o part -q >out 2>err
grep -q '^2 runs: 2 done (1 of them by an earlier sweep)' out && pass || fail "more values: $(cat out err)"

# ---- pictures --------------------------------------------------------------------------------------------------------

# The input of gnuplot is recorded. Keys of the body have separate lines; bars represent random variation only, which is stated.
printf '#!/bin/sh\nexec tee -a "%s/drawn" | "%s" "$@"\n' "$work" "$(command -v gnuplot)" >bin/gnuplot
chmod +x bin/gnuplot
three="-s material.density=2000,3000 -s material.young=60GPa,72GPa"
PATH=$work/bin:$PATH "$cleave" sweep bar.yaml $three -s boundary.0.traction='[5.0000001 MPa, 0],[10.000001 MPa, 0],[20.000001 MPa, 0]' -o chance -q >out
is "no bars over a load" "$(grep -c yerrorbars drawn)" 0
is "a line for each pair of the others" "$(grep -c "title '60, 20.000001'" drawn)" 1
grep -q "set label 'traction on [^ ]* \[MPa\]' at" drawn && pass || fail "a load that differs in one component is no axis of numbers"
rm drawn
PATH=$work/bin:$PATH "$cleave" sweep bar.yaml -s material.density=2000,3000 -s particles.irregularity=0.3 -s particles.seed=1,2 -o seeds -q >out
is "bars of chance say so" "$(grep -c 'mean and standard deviation over seed of particles' drawn)" 1
grep -q yerrorbars drawn && pass || fail "no bars"
grep -q "set title 'energy: kinetic \[µJ\]'" drawn && pass || fail "energies of this size are not drawn in µJ"
mean=$(compute "1e6 * ($(figure seeds/density=2000,seed=1 energy.kinetic) + $(figure seeds/density=2000,seed=2 energy.kinetic)) / 2")
near "a point is the mean of its runs" "$(awk '/^\$p0_0/ { at = 1; next } at { print $2; exit }' drawn)" "$mean" 1e-6
apart=$(compute "1e6 * ($(figure seeds/density=2000,seed=1 energy.kinetic) - $(figure seeds/density=2000,seed=2 energy.kinetic)) / sqrt(2)")
near "its bar is the standard deviation of two" "$(awk '/^\$p0_0/ { at = 1; next } at { print $3; exit }' drawn)" "${apart#-}" 1e-3
# Axes: values over decades have a logarithmic axis, from the values that are drawn alone; close values have distinct numbers.
rm drawn
PATH=$work/bin:$PATH "$cleave" sweep bar.yaml -s material.density=2e3,4e4,1e6 --of energy.kinetic -o decades -q >out
is "decades" "$(grep -c '^set logscale [xy]$' drawn) $(grep -c '^set xtics norotate 10000,10$' drawn)" "1 1"
rm drawn
PATH=$work/bin:$PATH "$cleave" sweep bar.yaml -s time.safety=0.7,0.8,2 -s material.toughness=1e9 --of energy.kinetic -o axis -q >out 2>err
is "an axis for the runs that are done" "$(grep -c logscale drawn) $(grep '^set xtics' drawn)" "2 set xtics norotate 0.05"
is "a gap where a run failed" "$(grep -c '^2 NaN NaN$' drawn)" 1
is "which the axis leaves out" "$(sed -n 's/^set xrange //p' drawn | head -n 1)" "[0.694:0.806]"
# Two decades of a key are a logarithmic axis, also where its last value has no result.
rm drawn
PATH=$work/bin:$PATH "$cleave" sweep bar.yaml -s time.safety=0.01,0.1,2 -s material.toughness=1e9 --of energy.kinetic -o missing -q >out 2>err
is "decades with a gap" "$(grep -c '^set logscale x$' drawn) $(grep '^set xtics' drawn)" "1 set xtics norotate 0.01,10"
rm drawn
PATH=$work/bin:$PATH "$cleave" sweep bar.yaml -s method=pd,mpm --of energy.kinetic -o words -q >out
is "points alone over words" "$(grep -c 'with lines' drawn) $(grep -c 'with points' drawn)" "0 1"
rm drawn
PATH=$work/bin:$PATH "$cleave" sweep bar.yaml -s material.density=2000,2000.001,2000.002 --of energy.kinetic -o close -q >out
is "digits of close values" "$(sed -n "s/^set format x //p" drawn)" "'%.7g'"

# A seed alone: mean, standard deviation and 95 % interval of the mean, Student's t of two degrees of freedom over the root of three runs.
rm drawn
PATH=$work/bin:$PATH "$cleave" sweep bar.yaml -s particles.irregularity=0.3 -s particles.seed=1:3:1 --of energy.kinetic -o alone -q >out
said=$(grep '^energy.kinetic: mean ' out)
set -- $(for k in 1 2 3; do figure alone/seed=$k energy.kinetic; done)
mean=$(compute "1e6 * ($1 + $2 + $3) / 3")
spread=$(compute "sqrt(((1e6 * $1 - $mean)^2 + (1e6 * $2 - $mean)^2 + (1e6 * $3 - $mean)^2) / 2)")
near "mean over seeds: $said" "$(echo "$said" | awk '{ print $3 }')" "$mean" 1e-3
near "standard deviation over seeds" "$(echo "$said" | sed 's/.*deviation \([^ ]*\) .*/\1/')" "$spread" 0.06
near "interval of the mean over seeds" "$(echo "$said" | awk '{ print $5 }')" "$(compute "4.303 * $spread / sqrt(3)")" 0.06
is "lines at the mean and beside it" "$(grep -c 'with lines lw 1.2 dt' drawn)" 1
is "which the picture explains" "$(grep -c 'full line: mean; dashed lines: mean plus and minus the standard deviation' drawn)" 1

# ---- failures are counted, errors are refused before anything runs ------------------------------------------------------

"$cleave" sweep bar.yaml -s time.safety=0.5,2 -s material.toughness=1e9 -o fails >out 2>err
is "status of a failure" $? 1
grep -q '^2 runs: 1 done, 1 failed: see fails/logs' out && pass || fail "one fails: $(cat out)"
grep -q '^\[.*\] safety=2: exit status 1: ' err && pass || fail "and says why: $(cat err)"
awk -F, '$1 == "safety=2" { print $2 }' fails/sweep.csv >state
is "in the table" "$(cat state)" failed
"$cleave" report fails -q 2>err
holds "and the page says why: $(cat err)" grep -q '^ *"safety=2": "unstable at step' fails/report.html
"$cleave" sweep bar.yaml -s time.safety=0.5,2 -s material.toughness=1e9 -o fails --collect >out 2>err
is "status of a failure, collected" $? 1
refused "so all runs would be the same" bar.yaml -o none
refused "given twice" bar.yaml -s method=pd,mpm -s method=pd -o none
refused "given twice" bar.yaml -s boundary.0.traction=[1,0] -s boundary[0].traction=[2,0] -o none
refused "unknown key" bar.yaml -s particles.spacin=1mm,2mm -o none
refused "particles.spacing" bar.yaml -s particles.spacing=1mm,-1mm -o none
refused "one of the two" bar.yaml -s method=pd,mpm --list --collect -o none
refused "contains no study" bar.yaml -s method=pd,mpm --collect -o none
refused "contains a run, not a study" bar.yaml -s method=pd,mpm -o two/spacing=1mm,traction=5MPa,0
refused "more than the limit of 100000" bar.yaml -s time.safety=0.1:0.9:0.0001 -s particles.seed=1:100:1 -o none
holds "nothing is left behind" test ! -e none

# ---- one at a time, and kills ----------------------------------------------------------------------------------------

"$cleave" sweep bar.yaml -s duration=8us,4ms,5ms,6ms -s particles.spacing=0.5mm -o long -j 1 >out 2>err &
first=$!
tries=0
while [ ! -f long/duration=8us/summary.json ] && [ $tries -lt 400 ]; do sleep 0.05; tries=$((tries + 1)); done
refused "this folder is in use by a run" bar.yaml -s duration=8us,4ms -s particles.spacing=0.5mm -o long
kill -TERM $first
wait $first
is "interrupted" $? 130
grep -q 'the same command continues' err && pass || fail "interrupted: $(cat err)"
holds "the first stays done" test "$(figure long/duration=8us status)" = done
"$cleave" sweep bar.yaml -s duration=8us,4ms,5ms,6ms -s particles.spacing=0.5mm -o long -j 1 >out 2>err &
first=$!
sleep 0.5
kill -KILL $first                        # its runs are also killed
wait $first 2>/dev/null
sleep 0.5
"$cleave" sweep bar.yaml -s duration=8us,20us -s particles.spacing=0.5mm -o long >out 2>err
is "after a kill" $? 0
grep -q '^2 runs: 2 done (1 of them by an earlier sweep)' out && pass || fail "after a kill: $(cat out err)"

finish
