#!/bin/sh
# Scattered strength in whole runs: other seeds must break at other positions; equal seeds must be bitwise equal on any number of threads,
# after a checkpoint and from the scene as written out, and agree at another spacing; refusals.
test_name=test_scatter
. tests/support/summary.sh
. tests/support/scenes.sh
. tests/support/trust.sh

# An expanding ring.
cat >"$work/ring.yaml" <<'END'
space: plane stress
thickness: 1 mm
duration: 8 us
method: pd
material:
  {young: 70 GPa, density: 2700, critical_stretch: 1e-2, scatter: {modulus: 8, length: 4 mm}}
body: [{disc: {centre: [0, 0], radius: 22 mm}}, {subtract: {disc: {centre: [0, 0], radius: 19 mm}}}]
particles: {spacing: 1 mm}
initial: [{velocity_gradient: [[2e3, 0], [0, 2e3]]}]
probes: [break]
output: {frames: 2, samples: 10, checkpoint: 0}
END
# A uniformly stretched bar breaks at its weakest position.
cat >"$work/bar.yaml" <<'END'
space: line
duration: 20 us
method: pd
material: {young: 70 GPa, density: 2700, critical_stretch: 1e-3, scatter: {modulus: 8, length: 4 mm}}
body: {box: {from: [0], to: [100 mm]}}
particles: {spacing: 1 mm}
boundary: [{velocity: 0, region: {box: {from: [0], to: [0.5 mm]}}}, {velocity: 10, region: {box: {from: [99.5 mm], to: [100 mm]}}}]
initial: [{velocity_gradient: 100}]
probes: [break]
output: {frames: 2, samples: 10}
END
start one "$work/ring.yaml"
{ "$cleave" run "$work/ring.yaml" -o "$work/two" -t 2 -q 2>"$work/two.err" || fail "two: $(cat "$work/two.err")"; } &
wait
start coarse "$work/bar.yaml"
start fine "$work/bar.yaml" -s particles.spacing=0.5mm; wait
start none "$work/bar.yaml" -s material.scatter=; wait
start echo "$work/one/scene.yaml"
start adaptive "$work/ring.yaml" -s method=adaptive -s 'boundary=[{mirror: {axis: x, at: 0}}]' \
    -s 'body=[{disc: {centre: [0, 0], radius: 22 mm}}, {subtract: {disc: {centre: [0, 0], radius: 19 mm}}}, {subtract: {half-space: {point: [0, 0], normal: [1, 0]}}}]'
wait
same() { if cmp "$work/$1/history.csv" "$work/$2/history.csv" && cmp "$work/$1/frames/000002.hdf" "$work/$2/frames/000002.hdf"
    then pass; else fail "$1 and $2 differ"; fi; }
same one two
same one echo
"$cleave" run "$work/ring.yaml" -o "$work/cut" -t 2 -q -s time.wall=0.01 2>/dev/null
"$cleave" run "$work/ring.yaml" -o "$work/cut" -t 1 -q --resume 2>"$work/cut.err" || fail "cut: $(cat "$work/cut.err")"
same one cut
sound one 0.005
is "adaptive: status" "$(f adaptive status)" done
between "adaptive: momentum" "$(f adaptive momentum_error)" 0 1e-12

# The field depends on the position: the bar breaks at its weakest position for any spacing, at the time given by its strength: earlier than
# for the mean.
apart "the weakest place" "$(f fine probes.break.x)" "$(f coarse probes.break.x)" 2e-3
between "first break" "$(compute "$(f coarse probes.break.first_time) / 10e-6")" 0.4 0.9
between "first break, finer" "$(compute "$(f fine probes.break.first_time) / $(f coarse probes.break.first_time)")" 0.95 1.03
between "first break without scatter" "$(compute "$(f none probes.break.first_time) / 10e-6")" 0.98 1.02

"$cleave" sweep "$work/ring.yaml" -o "$work/seeds" -q -s material.scatter.seed=1:4:1 >"$work/seeds.out" 2>&1 || fail "sweep: $(cat "$work/seeds.out")"
is "seeds: places of the first break" \
    "$(for k in "$work"/seeds/*/summary.json; do echo "$(figure "${k%/*}" probes.break.x) $(figure "${k%/*}" probes.break.y)"; done | sort -u | wc -l)" 4
holds "seeds: a mean" grep -q '^crack.start_time: mean .* µs (95 % interval), standard deviation .* µs, 4 runs$' "$work/seeds.out"

bad() { refused "$1" "$work/no" "$2" "$work/ring.yaml" -s "$3"; }
bad "a modulus" "modulus: missing" 'material.scatter={length: 1 mm}'
bad "a variation with weibull" "belongs to another distribution" 'material.scatter={modulus: 8, variation: 0.1}'
bad "lognormal" "variation: missing" 'material.scatter={distribution: lognormal}'
bad "below 1" "1 to 1000" material.scatter.modulus=0.5
bad "nothing that breaks" "bonds of this material never break" material.critical_stretch=inf
bad "a length of time" "length" 'material.scatter.length=2 us'
refused "yield" "$work/no" "scatter and yield_stress cannot be combined with material points" "$work/ring.yaml" -s method=adaptive -s material.yield_stress=100MPa
# Material points do not break, and their yield stress does not scatter: with the position of the key.
refused "yielding points" "$work/no" "ring.yaml:6:58: scatter: scatter varies the strength of bonds, but method: mpm has no bonds" "$work/ring.yaml" -s method=mpm -s material.yield_stress=100MPa
refused "points with a flow law" "$work/no" "and yield stresses do not scatter" "$work/ring.yaml" -s method=mpm \
    -s material.hardening='{table: [[0, 100 MPa], [0.1, 200 MPa]]}'
finish
