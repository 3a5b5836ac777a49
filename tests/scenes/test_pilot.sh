#!/bin/sh
# `method: auto` outside the cost-accuracy table: pilot runs choose, within their budget, what reaches the accuracy that is asked for; the choice
# is kept; what cannot be done is said.
test_name=test_pilot
. tests/support/summary.sh
case $cleave in /*) ;; *) cleave=$(pwd)/$cleave ;; esac
cd "$work" || exit 1

# ---- scenes with known answers ---------------------------------------------------------------------------------------

# Two bars of 20 mm meet at 10 m/s: until the waves come back, at 8 us, strain energy grows by rho A v^2 c per second, v = 5 m/s: at 4 us
# half of what was kinetic, 4000 J, and what is left moves: 3000 J and 1000 J, as waves have gone through 20 of the 20 mm.
cat >collide.yaml <<'END'
space: line
duration: 4 us
method: auto
accuracy: {of: energy.kinetic, within: 5 %, budget: 40 s}
material: {young: 200 GPa, density: 8000}
bodies:
  - {name: left, shape: {box: {from: [-20 mm], to: [0]}}, velocity: [5 m/s]}
  - {name: right, shape: {box: {from: [0.01 mm], to: [20.01 mm]}}, velocity: [-5 m/s]}
contact: {between: bodies}
output: {frames: 0, samples: 10}
END
begun=$(date +%s)
"$cleave" run collide.yaml -o collide 2>err >out
is "bars that meet" $? 0
between "budget" $(($(date +%s) - begun)) 0 60
near "kinetic energy" "$(figure collide energy.kinetic)" 1000 0.05
holds "says why: $(cat err)" grep -q "^pilot  .*accuracy names a figure, energy.kinetic" err
holds "says what each method needs" grep -q "^pilot  .*bonds: energy.kinetic +-" err
holds "says what is chosen" grep -q "^pilot .*, spacing .* mm: energy.kinetic within .* %" err
holds "error bar: $(grep -A2 uncertainty collide/summary.json)" grep -q '"energy.kinetic"' collide/summary.json
is "no request is left in the scene" "$(grep -c '^accuracy\|^method: auto' collide/scene.yaml)" 0

# the same question has the same answer, at once; another one is asked anew
cp collide/scene.yaml before.yaml
"$cleave" run collide.yaml -o collide --resume 2>err >out
is "again" $? 0
holds "as chosen before: $(cat err)" grep -q "as chosen before" err
holds "the same scene" cmp -s before.yaml collide/scene.yaml
"$cleave" check collide.yaml >out 2>&1
is "check" $? 0
holds "check says so: $(cat out)" grep -q "cleave run takes pilot runs of at most 40 s, for energy.kinetic within 5 %" out

# A plate of Poisson's ratio 0.2 pulled at both ends: sigma^2 V/(2 E), by state-based peridynamics or points, whichever is cheaper; without a
# name the larger energy is judged.
cat >plate.yaml <<'END'
space: plane stress
thickness: 1 mm
duration: 1 s
method: auto
solver: static
accuracy: {within: 2 %, budget: 40 s}
material: {young: 200 GPa, poisson: 0.2, density: 7850}
body: {box: {from: [0, 0], to: [20 mm, 10 mm]}}
boundary: [{traction: [1 MPa, 0], face: x+}, {traction: [-1 MPa, 0], face: x-}]
output: {frames: 0}
END
"$cleave" run plate.yaml 2>err >out
is "pulled plate" $? 0
near "its energy" "$(figure results/plate energy.strain)" 5e-7 0.02
holds "figure chosen: $(cat err)" grep -q "energy.strain within" err
holds "a static solver" grep -q '^solver: \(cg\|relaxation\)' results/plate/scene.yaml

# a spacing of the user stays
"$cleave" run plate.yaml -s particles.spacing=0.2mm -o own 2>err >out
is "own spacing" $? 0
holds "it stays" grep -q '^  spacing: 0.0002 ' own/scene.yaml

# ---- what cannot be done ---------------------------------------------------------------------------------------------

# refused WORDS ARGUMENTS: exit status 2, a line with these words, no run.
refused()
{
    words=$1; shift
    "$cleave" run -q -o refused "$@" >out 2>err
    is "refused: $words" $? 2
    is "$words: lines" "$(wc -l <err)" 1
    holds "$words: $(cat err)" grep -q -- "$words" err
    holds "$words: left behind" test ! -e refused
    rm -rf refused_pilot
}
refused "summary.json has no such figure" collide.yaml -s accuracy.of=energy.nonsense
refused "found no method that is accurate to 1e-07 %" collide.yaml -s accuracy.within=1e-9 -s accuracy.budget=3s
refused "no method that is accurate to 0.1 % at its spacing" plate.yaml -s particles.spacing=1mm -s accuracy.within=0.1%
refused "no time is left for it" collide.yaml -s accuracy.budget=1ms
"$cleave" converge collide.yaml -o converge >out 2>err
is "converge of such a scene" $? 2
holds "says who chooses: $(cat err)" grep -q "cleave run chooses by pilot runs" err
finish
