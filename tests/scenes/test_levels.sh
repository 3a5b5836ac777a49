#!/bin/sh
# Coarse cells (mpm.levels): results against cells of two spacings everywhere, on any number of threads, after interruptions, with long
# waves and with mirrors; refusals.
test_name=test_levels
. tests/support/summary.sh
. tests/support/trust.sh
. tests/support/scenes.sh
. tests/support/physics.sh

ratio() { awk -v a="$1" -v b="$2" 'BEGIN { print a / b }'; }
close() { between "$1" "$(awk -v a="$2" -v b="$3" 'BEGIN { print a - b }')" "-$4" "$4"; }

# ---- cracks ------------------------------------------------------------------------------------------------------------

# Kalthoff's plate: with one level, means over nine time steps of the start differ by less than 0.1 %, of the angle by 0.9 degrees; single
# runs scatter by 0.2 % and 1.3 degrees (1 mm).
start fine kalthoff_winkler -s mpm.levels=0 -s output.frames=0
start coarse kalthoff_winkler -s mpm.levels=1 -s output.frames=0
wait
sound coarse 0.005
between "coarse cells at the end" "$(f coarse levels.cells.1)" 300 800
close "first break" "$(f coarse crack.start_time)" "$(f fine crack.start_time)" 2.4e-7
close "length" "$(f coarse crack.length_end)" "$(f fine crack.length_end)" 1e-3
close "angle" "$(f coarse crack.angle_deg)" "$(f fine crack.angle_deg)" 4

# ---- bitwise equality --------------------------------------------------------------------------------------------------

plate="inputs/kalthoff_winkler.yaml -s mpm.levels=2 -s output.frames=4 -s output.samples=100 -s duration=35us"
calm "$work/levels1" $plate -t 1
twice_interrupted "$work/stopped" 9 80 $plate
calm "$work/stopped" -t 2 --resume $plate
same "on 2 threads, interrupted after 9 and 80 lines" "$work/levels1" "$work/stopped"

# ---- waves -------------------------------------------------------------------------------------------------------------

# A plate that vibrates for 1300 steps at 0.7 of the critical one: its balance closes to the square of the step of its largest cells (0.2 %
# at the end, a quarter of it at half the step; 0.8 % with a third level); half of it behind a mirror vibrates as the whole does, except for
# cells beside the mirror, whose inertia is not matched.
cat >"$work/ring.yaml" <<EOF
space: plane stress
thickness: 1 mm
duration: 280 us
method: mpm
material: {young: 72 GPa, poisson: 1/3, density: 2440 kg/m^3}
body: [{box: {from: [-64 mm, 0], to: [64 mm, 96 mm]}}]
particles: {spacing: 1 mm}
mpm: {levels: 2, origin: [0, 0]}
boundary: [{traction: [0, 1 MPa], face: y+, time: {pulse: {until: 40 us}}}, {traction: [0, -1 MPa], face: y-, time: {pulse: {until: 40 us}}}]
output: {frames: 1, samples: 100}
EOF
sed 's/from: \[-64 mm, 0\]/from: [0, 0]/; s/^boundary: \[/boundary: [{mirror: {axis: x, at: 0, tangential: free}}, /' "$work/ring.yaml" >"$work/half.yaml"
start ring "$work/ring.yaml"
start half "$work/half.yaml"
start even "$work/ring.yaml" -s mpm.levels=0
wait
sound ring 5e-3
sound half 5e-3
between "cells of 8 spacings" "$(f ring levels.cells.2)" 100 200
between "external work, beside cells of two spacings" "$(ratio "$(f ring energy.external_work)" "$(f even energy.external_work)")" 0.99 1.01
between "half a plate" "$(ratio "$(f half energy.external_work)" "$(f ring energy.external_work)")" 0.4995 0.5005

# ---- conversion of many points at once -----------------------------------------------------------------------------------

# A plate compressed until all of it exceeds its limit: points near coarse cells wait until these are refined, and momentum is exact. Short
# waves of the breaking plate dissipate 1.2 % of the energy without coarse cells, 1.7 % with them. Bitwise equality after an interruption.
cat >"$work/crush.yaml" <<EOF
space: plane stress
thickness: 1 mm
duration: 20 us
method: adaptive
material: {young: 72 GPa, poisson: 1/3, density: 2440, energy_release_rate: 20}
body: {box: {from: [0, 0], to: [55 mm, 24 mm]}}
particles: {spacing: 1 mm}
boundary:
  - {traction: [-192 MPa, 0], face: x+, time: {ramp: {until: 20 us}}}
  - {absorbing: true, face: x-}
time: {step: 0.06 us}
contact: {between: none}
output: {frames: 1, samples: 100}
EOF
for levels in 2 3 4; do
    calm "$work/crush$levels" "$work/crush.yaml" -s mpm.levels=$levels
    sound crush$levels 0.03
done
finer="$work/crush.yaml -s mpm.levels=3 -s particles.spacing=0.5mm -s time.step=0.03us"
calm "$work/whole" $finer
interrupted "$work/crushed" 20 $finer
calm "$work/crushed" --resume $finer
same "crushed, interrupted after 20 lines" "$work/whole" "$work/crushed"

# State-based plates torn apart, 80 to 100 % of which convert, beside a mirror across which bonds break: momentum along it is exact.
for model in ospd mospd; do
    cat >"$work/tear.yaml" <<EOF
space: plane strain
thickness: 1 mm
duration: 20 us
method: adaptive
model: $model
material: {young: 72 GPa, poisson: 0.2, density: 2440, energy_release_rate: 135}
body: {box: {from: [0, 0], to: [42 mm, 51 mm]}}
particles: {spacing: 1 mm}
boundary:
  - {traction: [0, 135.85 MPa], face: y+, time: {ramp: {until: 20 us}}}
  - {mirror: {axis: y, at: 0}}
mpm: {levels: 2}
time: {step: 0.06 us}
output: {frames: 1, samples: 100}
EOF
    calm "$work/tear_$model" "$work/tear.yaml"
    sound tear_$model 0.001
done

# A sif ring in material points around a gap that is hit by sudden waves: its cells stay at two spacings, because coarse ones have no
# acceleration in most steps. K_I within 3 % of that with cells of two spacings everywhere: the front of the waves is a step, in which
# coarse cells cause another oscillation (2.6 % at 5.5 us); with the ring in coarse cells the error would be 30 to 90 %.
cat >"$work/gap.yaml" <<EOF
space: plane strain
thickness: 1 mm
duration: 9 us
method: mpm
material: {young: 75.629 GPa, poisson: 1/4, density: 2456 kg/m^3}
particles: {spacing: 0.5 mm}
body: [{box: {from: [0, -20 mm], to: [60 mm, 20 mm]}}, {subtract: {box: {from: [-1 mm, -0.5 mm], to: [30 mm, 0.5 mm]}}}]
mpm: {origin: [0, -0.5 mm], frame: reference}
time: {step: 0.08 us}
boundary:
  - {mirror: {axis: x, at: 0}}
  - {mirror: {axis: x, at: 60 mm}}
  - {traction: [0, 1 MPa], face: y+}
  - {traction: [0, -1 MPa], face: y-}
output: {frames: 0, samples: 9}
probes: [sif: {at: [30 mm, 0], direction: [1, 0], contours: [8 mm]}]
EOF
for levels in 0 1 2; do calm "$work/gap$levels" "$work/gap.yaml" -s mpm.levels=$levels; done
for levels in 1 2; do
    for row in 7 8 9 10; do
        near "K_I in a ring, levels $levels, sample $row" "$(awk -F, "NR == 1 { for (k = 1; k <= NF; k++) if (\$k ~ /K_I /) at = k } NR == $row { print \$at }" "$work/gap$levels/history.csv")" \
            "$(awk -F, "NR == 1 { for (k = 1; k <= NF; k++) if (\$k ~ /K_I /) at = k } NR == $row { print \$at }" "$work/gap0/history.csv")" 0.03
    done
done

# A running crack with levels, interrupted during the run.
running="inputs/semi_infinite_crack.yaml -s method=adaptive -s model=bond -s material.poisson=1/4 -s particles.horizon=3.015 -s mpm.levels=2"
running="$running -s particles.spacing=0.4mm -s time.step=0.04us"
calm "$work/runs" $running
interrupted "$work/ran" 45 $running
calm "$work/ran" --resume $running
same "a ring that runs, interrupted after 45 lines" "$work/runs" "$work/ran"

# ---- two slits with contact --------------------------------------------------------------------------------------------

# Without the refinement near slits, half of the energy would be gained with coarse cells a few spacings away.
cat >"$work/slits.yaml" <<EOF
space: plane stress
thickness: 1 mm
duration: 45 us
material: {young: 72 GPa, density: 2440 kg/m^3, energy_release_rate: 135 J/m^2}
body: {box: {from: [0, 0], to: [64 mm, 32 mm]}}
particles: {spacing: 0.4 mm}
mpm: {levels: 1}
cracks:
  - {from: [-6 mm, 15 mm], to: [25.32 mm, 15 mm]}
  - {from: [-1 mm, 7.5 mm], to: [25.32 mm, 13.5 mm]}
boundary: [{traction: [0, 5 MPa], face: y+, time: {pulse: {until: 8 us}}}]
output: {frames: 0}
EOF
for levels in 1 2; do
    calm "$work/slits$levels" "$work/slits.yaml" -s mpm.levels=$levels
    between "two slits, levels $levels: balance" "$(figure "$work/slits$levels" energy.balance_error)" -0.01 0.001
done

# ---- refusals ----------------------------------------------------------------------------------------------------------

refused "five levels" "$work/not" "levels: 5 is unknown; give 0, 1, 2, 3, 4 or auto" "$work/ring.yaml" -s mpm.levels=5
refused "a step too long" "$work/not" "too large for coarse cells (mpm.levels above 0)" "$work/ring.yaml" -s time.step=0.32us

finish
