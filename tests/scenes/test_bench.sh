#!/bin/sh
# `cleave bench`: refusals, and the columns and values of the tables of every bench, on the smallest bodies for which results are known.
# BUILD: folder of the program. Takes 100 s: every bench is run once.
set -eu
build=$(cd "${BUILD:-build}" && pwd)
cleave=$build/cleave
inputs=$(pwd)/inputs
measured=$(pwd)/bench/accuracy/cost_accuracy.csv
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
fail() { echo "test_bench: $1" >&2; exit 1; }

# Refused in one line with exit status 2, nothing written.
for words in nonsense accuracy=nonsense accuracy=auto stability=nonsense "--slow" "kernels nonsense" coupling factors sif efficiency scatter sensitivity slow; do
    set +e
    "$cleave" bench $words >out 2>err
    ended=$?
    set -e
    [ $ended -eq 2 ] || fail "bench $words: exit status $ended, not 2"
    [ "$(wc -l <err)" -eq 1 ] || fail "bench $words: $(wc -l <err) lines on standard error"
    [ ! -e results ] || fail "bench $words left files behind"
done
"$cleave" bench >out 2>err || fail "bench without a name: exit status $?"
grep -q "^  kernels  *time of every kernel" out && grep -q "^  all  " out || fail "bench without a name lists no names: $(cat out)"
[ ! -e results ] || fail "bench without a name left files behind"
"$cleave" bench scatter >out 2>err && fail "bench scatter"
grep -q "inputs" err || fail "scatter does not say what it misses"

# One scene with a quarter of the particles: the files exist and have the columns of the contract.
command -v gnuplot >/dev/null || { echo "gnuplot is missing: files not tested"; exit 77; }
mkdir inputs
sed 's/spacing: 0.5 mm/spacing: 1 mm/' "$inputs/plate_crack.yaml" >inputs/plate_crack.yaml
OMP_NUM_THREADS=1 "$cleave" bench efficiency --quick >out || fail "efficiency failed"
cd results/bench
[ "$(head -1 efficiency.csv)" = \
    scene,model,t_adaptive,t_pd,t_r,tip_distance,angle_difference_deg,start_difference,levers ] ||
    fail "columns of efficiency.csv"
[ "$(wc -l <efficiency.csv)" -eq 8 ] || fail "one scene gives a line for each lever, of bonds where time is short"
awk -F, 'NR > 1 { exit $2 != "bond" }' efficiency.csv || fail "the model"
[ "$(awk -F, 'NR > 1 { printf "%s ", $9 }' efficiency.csv)" = "none frame slits levels active_set reversion all " ] || fail "the levers"
[ "$(head -1 efficiency_runs.csv)" = \
    scene,model,levers,particles,steps,time_step,paper_t_r,start_pd,start_adaptive,angle_pd_deg,angle_adaptive_deg,t_r_stepping,t_r_bound,rest_share,aim,bonds,points,conversion,samples ] ||
    fail "columns of efficiency_runs.csv"
# t_r agrees with the two times before it, to the nine digits written.
awk -F, 'NR > 1 { d = $5 - (1 - $3 / $4); if (!($3 > 0 && $4 > 0 && d < 1e-6 && d > -1e-6)) bad = 1 } END { exit bad }' efficiency.csv || fail "t_r"
# Conversion takes some of the time, but not all.
paste -d, efficiency.csv efficiency_runs.csv | awk -F, 'NR > 1 && !($22 > $5 && $22 < 1) { bad = 1 } END { exit bad }' ||
    fail "the bound of t_r"
for file in efficiency.json efficiency.png efficiency.svg efficiency_share.csv; do [ -s $file ] || fail "$file is missing"; done
[ "$(wc -l <efficiency_share.csv)" -eq 708 ] || fail "the share is noted at 100 samples and at the start"
cd ../..

# Three runs of each method with other steps: means and scatter agree with the runs, to the nine digits written. --readme also writes
# the output and the tables to bench/results, with head lines that state their origin.
"$cleave" bench sensitivity --readme >out 2>err && fail "--readme outside a source tree"
grep -q "top of the source tree" err || fail "--readme outside a source tree: $(cat err)"
mkdir bench
"$cleave" bench sensitivity --quick --readme >out 2>err || fail "scatter failed"
[ "$(sed -n 's/^# \([a-z]*\): .*/\1/p' bench/results/sensitivity.txt | tr '\n' ' ')" = "command date commit processor compiler " ] ||
    fail "--readme: head of the results: $(head -6 bench/results/sensitivity.txt)"
[ "$(head -1 bench/results/sensitivity.txt)" = "# command: cleave bench sensitivity --quick" ] || fail "--readme: command"
grep -q "^# date: 20[0-9-]*$" bench/results/sensitivity.txt || fail "--readme: date"
grep -v "^#" bench/results/sensitivity.txt | cmp -s - out || fail "--readme: the text is not what was printed"
grep -v "^#" bench/results/sensitivity.csv | cmp -s - results/bench/sensitivity.csv || fail "--readme: the table is another"
cd results/bench
[ "$(head -1 sensitivity.csv)" = \
    scene,model,method,runs,start,start_scatter,angle_deg,angle_scatter_deg,x,y,z,place_scatter,spacing ] || fail "columns of sensitivity.csv"
[ "$(wc -l <sensitivity.csv)" -eq 3 ] && [ "$(wc -l <sensitivity_runs.csv)" -eq 7 ] || fail "two methods, three runs each"
awk -F, 'FNR == 1 { next }
    FILENAME == "sensitivity_runs.csv" { n[$3]++; start[$3] += $5; square[$3] += $5 * $5; x[$3] += $7; step[$4] = 1; next }
    { mean = start[$3] / n[$3]; scatter = sqrt(square[$3] / n[$3] - mean * mean); d = ($9 - x[$3] / n[$3]) / $13
      if (!(n[$3] == $4 && $5 / mean < 1 + 1e-6 && $5 / mean > 1 - 1e-6 && d < 1e-6 && d > -1e-6)) bad = 1
      if (!($6 > 0 && $6 / scatter < 1 + 1e-3 && $6 / scatter > 1 - 1e-3)) bad = 1 }
    END { for (k in step) steps++; exit bad || steps != 3 }' sensitivity_runs.csv sensitivity.csv || fail "figures of sensitivity.csv"
for file in sensitivity.json sensitivity.png sensitivity.svg; do [ -s $file ] || fail "$file is missing"; done
cd ../..

# Scaling over threads and sizes: files, columns, and derived values.
OMP_NUM_THREADS=2 "$cleave" bench threads scale peers --quick >out || fail "threads, scale or peers failed"
cd results/bench
[ "$(head -1 threads.csv)" = method,scaling,threads,particles,step_seconds,ns_per_particle_step,efficiency ] ||
    fail "columns of threads.csv"
[ "$(wc -l <threads.csv)" -eq 21 ] || fail "five methods, two scalings, two teams give 20 lines"
awk -F, 'NR > 1 { if ($3 == 1) one = $6; d = $7 * $3 * $6 / one - 1; if (d > 1e-6 || d < -1e-6) bad = 1 }
    END { exit bad }' threads.csv || fail "the efficiency of threads.csv"
[ "$(wc -l <scale.csv)" -eq 16 ] || fail "five methods, in the plane at two sizes, in space at one, give 15 lines"
awk -F, 'NR > 1 && !($3 > 2000 && $5 > 0 && $6 > 0 && $8 > 0 && $9 > 0) { bad = 1 } END { exit bad }' scale.csv ||
    fail "figures of scale.csv"
[ "$(awk -F, 'NR > 1 && $12 > 0' scale.csv | wc -l)" -eq 5 ] || fail "output is measured for five methods"
# Number of bonds of a square: sum over the 28 neighbours of (n - |a|)(n - |b|), n = 50.
awk -F, '$1 == "pd" && $2 == 2 && $3 == 2500 { n = $4 } END { exit n != 66436 }' scale.csv || fail "bonds of a square of 50"
for file in threads.json threads.png threads.svg threads_memory.csv scale.json scale.png; do
    [ -s $file ] || fail "$file is missing"
done
[ -z "$(ls -d run-* 2>/dev/null)" ] || fail "scaling leaves runs behind"
[ ! -e scale_growth.csv ] || fail "growth has figures of scenes that are not here"
# Far field: cells of 8 spacings and a part between absorbing faces have K within 2 % of both direct runs, cells of 32 do not.
[ "$(head -1 scale_field.csv)" = run,levels,part,made,particles,bytes,seconds,steps_seconds,K_peak,off_bonds,off_cells ] ||
    fail "columns of scale_field.csv"
[ "$(wc -l <scale_field.csv)" -eq 9 ] || fail "eight runs of a far field"
awk -F, 'NR > 1 { near = $10 < 0.02 && $11 < 0.02 }
    $1 == "bonds everywhere" { next }
    ($2 < 3 && NR > 1 && !near) || ($2 == 4 && near) || ($2 > 0 && $3 == 0 && $4 > 0.1 * $5) || ($9 < 1.2e5 && NR > 1) { bad = 1 }
    END { exit bad }' scale_field.csv || fail "figures of scale_field.csv"
[ "$(head -1 peers_bar.csv)" = bar,particles,steps,ns_per_particle_step ] && awk -F, 'NR > 1 && !($2 > 2000 && $4 > 0) { bad = 1 }
    END { exit bad || NR != 3 }' peers_bar.csv || fail "figures of peers_bar.csv"
cd ../..
# Beside LAMMPS, particle by particle, where it is installed.
if command -v lmp >/dev/null; then
    awk -F, 'NR > 1 && !($12 < 1e-9) { bad = 1 } END { exit bad || NR != 13 }' results/bench/peers.csv || fail "beside LAMMPS: $(cat results/bench/peers.csv)"
fi

# Growth over the spacing for the plate in 3D: the exponents of two rows are those of their ratios.
cp "$inputs/kalthoff_3d_fine.yaml" inputs
"$cleave" bench scale=growth --quick >out || fail "growth failed"
cd results/bench
[ "$(wc -l <scale_growth.csv)" -eq 5 ] && [ "$(wc -l <scale_growth_fit.csv)" -eq 3 ] || fail "two methods at two spacings"
awk -F, 'FNR == 1 { next }
    FILENAME == "scale_growth.csv" { if ($3 > 1.5e-3) for (k = 4; k <= 8; k++) one[$1, k] = $k; else for (k = 4; k <= 8; k++) two[$1, k] = $k; next }
    { made = log(two[$1, 4] / one[$1, 4]) / log(2) - $3; bytes = log(two[$1, 7] / one[$1, 7]) / log(2) - $4
      time = log(two[$1, 8] / one[$1, 8]) / log(2) - $5
      if (made^2 + bytes^2 + time^2 > 1e-10 || $3 < 2.9 || $3 > 3.1) bad = 1 }
    END { exit bad }' scale_growth.csv scale_growth_fit.csv || fail "exponents of growth"
[ -s scale_growth.png ] || fail "scale_growth.png is missing"
cd ../..

# Accuracy over time for its bar: files, values known from inputs/bar_smooth.yaml, and nothing runs twice.
"$cleave" bench accuracy=bar --quick >out || fail "accuracy failed"
cp results/bench/accuracy.csv before.csv
head -n $(($(wc -l <before.csv) - 6)) before.csv >results/bench/accuracy.csv
printf 'bar,pulse,pd bo' >>results/bench/accuracy.csv      # an incomplete line
"$cleave" bench accuracy=bar --quick >out || fail "accuracy does not go on"
grep -q ', 6 of them to be run' out || fail "accuracy runs again what it knows: $(grep 'to be run' out)"
cut -d, -f1-9 before.csv >one
cut -d, -f1-9 results/bench/accuracy.csv | cmp -s - one || fail "accuracy differs once it was broken off"
cd results/bench
[ "$(head -1 accuracy.csv)" = problem,case,method,resolution,horizon,step,error,part_1,part_2,part_3,loop_1_thread,loop_2_threads,\
particles,steps,stable,version,settings ] || fail "columns of accuracy.csv"
for file in accuracy.json accuracy.md accuracy.png accuracy.svg accuracy_bar.png accuracy_bar.svg cost_accuracy.csv; do
    [ -s $file ] || fail "$file is missing"
done
grep -q 'Which is cheapest: peridynamics, material points, or both together?' accuracy.svg || fail "the picture has no question"
grep -q 'At 5 % error: pd on [01] of 1 problems, mpm [01], adaptive [01]' accuracy.svg || fail "the picture does not answer its question"
rm accuracy.svg
cd ../..

# Without results the charts are drawn from the stored table, and no table is written.
mkdir -p drawn/bench/accuracy
cp "$measured" drawn/bench/accuracy
(cd drawn && "$cleave" bench accuracy=chart >out) || fail "accuracy=chart of the stored table failed"
grep -q 'At 5 % error: pd on [0-9]* of 11 problems' drawn/results/bench/accuracy.svg || fail "accuracy=chart of the stored table"
[ ! -e drawn/results/bench/cost_accuracy.csv ] || fail "accuracy=chart writes a table without results"

# The stored table has the form of bench/accuracy/cost_accuracy.csv, and is rewritten from known results without a run.
[ "$(head -1 results/bench/cost_accuracy.csv)" = "$(head -1 "$measured")" ] || fail "columns of cost_accuracy.csv"
cp results/bench/cost_accuracy.csv kept
rm results/bench/cost_accuracy.csv
"$cleave" bench accuracy=chart >out || fail "accuracy=chart failed"
[ -s results/bench/accuracy.svg ] || fail "accuracy=chart draws no picture"
cmp -s kept results/bench/cost_accuracy.csv || fail "accuracy=chart writes another table"

# Couplings: columns, and values known from the literature and from an independent prototype.
cp "$inputs/bar_pulse.yaml" "$inputs/plate_pulse.yaml" inputs
"$cleave" bench coupling --quick >out || fail "coupling failed"
cd results/bench
[ "$(head -1 coupling.csv)" = coupling,width_spacings,reflected,transmitted,energy_change ] ||
    fail "columns of coupling.csv"
[ "$(wc -l <coupling.csv)" -eq 15 ] || fail "seven couplings at two widths give 14 lines"
for file in coupling_places.csv coupling_variants.csv coupling_patch.csv coupling_plane.csv coupling_pulse.csv \
    coupling.json coupling.png coupling.svg coupling_pulse.png coupling_pulse.svg; do
    [ -s $file ] || fail "$file is missing"
done
# line FILE PATTERN COLUMN FROM TO: checks the range of a column in the only line that begins with the pattern.
line()
{
    awk -F, -v pattern="^$2" -v at="$3" -v from="$4" -v to="$5" '
        $0 ~ pattern { n++; if ($at < from + 0 || $at > to + 0 || $at == "") bad = 1 }
        END { exit n != 1 || bad }' "$1" || fail "$1: $2: column $3 is not within $4 to $5: $(grep "^$2" "$1")"
}
# A pulse 32 spacings wide: handshake reflects 2.4 %, PMG 2.7 %; partial stress at most 1.5 %, and 0.6 % at 64. PM as published, where the
# grid moves points at the interface with its first velocity: 4.4 %; with the second velocity, which conserves energy: 5.7 %.
line coupling.csv handshake,32, 3 0.0207 0.0267
line coupling.csv pm,32, 3 0.040 0.062
line coupling.csv pmg,32, 3 0.024 0.030
line coupling.csv 'partial stress,32,' 3 0.001 0.015
line coupling.csv 'partial stress,64,' 3 0.0005 0.006
line coupling.csv 'partial stress undamped,32,' 3 0.0090 0.0125
# At every position of the interface in its cell; without damping some position has a larger reflection.
line coupling_places.csv 'partial stress,32,2,0.25' 6 0.001 0.015
line coupling_places.csv 'partial stress,32,2,0.5' 6 0.001 0.015
line coupling_places.csv 'partial stress,32,2,0.75' 6 0.001 0.015
line coupling_places.csv 'partial stress undamped,32,2,0.5' 6 0.05 0.2
# Uniform strain: handshake exactly 13/24 and 3/4 in a bar, partial stress zero if a flat interface is on nodes.
line coupling_patch.csv bar,axial,1,handshake, 6 0.7499 0.7501
line coupling_patch.csv bar,axial,2,handshake, 6 0.54157 0.54177
line coupling_patch.csv 'bar,axial,2,partial stress,' 6 0 1e-5
line coupling_patch.csv 'flat,axial,2,partial stress,isotropic,' 6 0 1e-5
line coupling_patch.csv '45 degrees,axial,2,partial stress,isotropic,' 6 0.001 0.06
line coupling_patch.csv 'square,axial,2,partial stress,isotropic,' 6 0.001 0.06
# Second order of bonds, first order of the stress of linear cells (inputs/bar_smooth.yaml has 200 and 400).
line accuracy.csv 'bar,pulse,pd bond,200,' 7 0.004 0.008
line accuracy.csv 'bar,pulse,pd bond,400,' 7 0.001 0.002
line accuracy.csv 'bar,pulse,mpm reference,400,' 7 0.007 0.011
line accuracy.csv 'bar,step,mpm reference,400,' 7 0.02 0.03
# An oblique interface reflects less of a wave with partial stress.
line coupling_plane.csv '45 degrees,16,flip,handshake,isotropic,' 7 0.018 0.030
line coupling_plane.csv '45 degrees,16,flip,partial stress,isotropic,' 7 0.006 0.017

# Stress-intensity factors with coarser waves: required values for an edge crack on 100 x 100 particles, and for the others the accuracy of
# their resolution.
cd ../..
cp "$inputs/edge_crack_k1.yaml" "$inputs/inclined_crack.yaml" "$inputs/load_displacement.yaml" "$inputs/kalthoff_sif.yaml" \
    inputs
sed 's/spacing: 0.25 mm/spacing: 0.5 mm/; s/step: 20 ns/step: 40 ns/' "$inputs/semi_infinite_crack.yaml" \
    >inputs/semi_infinite_crack.yaml
"$cleave" bench sif --quick >out || fail "factors failed"
cd results/bench
for file in sif.csv sif.json sif.png edge_crack_convergence.csv edge_crack_convergence.png \
    edge_crack_convergence_paper_rings.csv inclined_crack.csv inclined_crack.svg moving_crack.csv moving_crack_curves.csv; do
    [ -s $file ] || fail "$file is missing"
done
line edge_crack_convergence.csv 'mospd bulk,cg,100,' 6 -0.003 0.003
line edge_crack_convergence.csv 'mospd bulk,relaxation,100,' 6 -0.003 0.003
line edge_crack_convergence.csv 'ospd local,cg,100,' 6 -0.01 0.01
line edge_crack_convergence.csv 'mospd local,cg,50,' 6 -0.06 -0.03
line edge_crack_convergence_paper_rings.csv 'mospd,200,70,' 5 0.0003 0.0005
line inclined_crack.csv '45,local 1.5,' 7 -0.02 0.02
line inclined_crack.csv '45,local 1.5,' 8 -0.02 0.02
line moving_crack.csv 'at rest,' 4 0.97 1.03
line moving_crack.csv 'moving: as it stands,' 4 0.95 1.05
[ -z "$(ls -d run-* 2>/dev/null)" ] || fail "factors leaves runs behind"
cd ../..
for scene in compact_tension edge_crack_grips cantilevers cantilevers_3d bend_offset_notch mixed_mode; do cp "$inputs/$scene.yaml" inputs; done
"$cleave" bench slow --quick >out 2>err || fail "slow failed: $(cat err)"
cd results/bench
for file in slow.csv slow.png slow_specimens.csv slow_specimens.png slow_paths.csv slow_speed.csv; do
    [ -s $file ] || fail "$file is missing"
done
line slow_specimens.csv 'three-point bend,bond,40,' 6 -0.03 0.03
line slow_specimens.csv 'double cantilever,bond,10,' 9 -0.03 0.03
line slow_paths.csv 'inclined crack,0.001,45,' 6 0 3
line slow_paths.csv 'notch beside middle,' 6 0 3
[ "$(wc -l <slow_specimens.csv) $(wc -l <slow_paths.csv)" = "3 3" ] || fail "two specimens and two paths"
[ -z "$(ls -d run-* 2>/dev/null)" ] || fail "slow leaves runs behind"
cd ../..
"$cleave" bench laws --quick >out 2>err || fail "laws failed: $(cat err)"
[ "$(grep -c ' holds$' out)" -ge 30 ] && ! grep -q MISSED out || fail "laws: $(cat out)"
# The circles at their coarsest spacings: the strengths that hold say so, and a notch on a lattice that traps its crack carries what a separate
# program finds; of shear at this horizon, and of a crack that the lattice traps, nothing is asked. A part of them runs alone.
cp "$inputs/strength_notch.yaml" inputs
"$cleave" bench circles --quick >out 2>err || fail "circles failed: $(cat err)"
cd results/bench
verdict() { awk -F, -v figure="$1" -v lattice="$2" '$1 "," $2 == figure && $7 == lattice { print $11 }' circles.csv; }
[ "$(verdict '2 biaxial,strength; surface' 0)" = holds ] || fail "circles: biaxial strength: $(cat circles.csv)"
[ "$(verdict '3 torsion,shear; surface' 0)" = - ] || fail "circles: shear: $(cat circles.csv)"
[ "$(verdict '5 notch 1.5,load; softening' 0 | tr '\n' ' ')" = "holds holds " ] || fail "circles: a notch at kappa 2, 1: $(cat circles.csv)"
[ "$(verdict '4 pure shear,opening; softening' 0)" = - ] || fail "circles: a crack at kappa 1: $(cat circles.csv)"
[ "$(verdict '1 tension,strength; softening' 20 | sort -u)" = holds ] || fail "circles: strips on a turned lattice: $(cat circles.csv)"
grep -q '20 deg     35.9 .* holds: 40 is asked, but a step of a face begins at 35.9' ../../out || fail "circles: reasons: $(cat ../../out)"
[ "$(verdict '5 notch 0.5,load; surface' 0)" = - ] || fail "circles: a notch shorter than three horizons: $(cat circles.csv)"
[ "$(grep -c ' not run: ' ../../out)" -eq 4 ] || fail "circles: four have no run: $(cat ../../out)"
[ -z "$(ls -d circles-* 2>/dev/null)" ] || fail "circles leaves files behind"
cd ../..
mv results/bench/circles.csv kept.csv
"$cleave" bench circles=biaxial --quick >out 2>err || fail "circles=biaxial failed: $(cat err)"
[ "$(grep -c ' holds$' out)" -eq 2 ] && [ ! -e results/bench/circles.csv ] || fail "circles=biaxial: $(cat out)"
"$cleave" bench circles=none >out 2>err && fail "circles=none runs"
grep -q 'no circle of the name none has runs' err || fail "circles=none: $(cat err)"
echo "test_bench: ok"
