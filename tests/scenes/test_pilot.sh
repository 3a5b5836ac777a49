#!/bin/sh
# `method: auto`: pilot runs must choose, within their budget, a method and a spacing that reach the requested accuracy, against known
# answers. The choice is stored, and the scene as written out contains it in place of auto. Impossible requests must be reported.
# Takes 25 s: each choice is made by runs of a scene with several methods and spacings.
test_name=test_pilot
. tests/support/summary.sh
case $cleave in /*) ;; *) cleave=$(pwd)/$cleave ;; esac
cd "$work" || exit 1

# ---- scenes with known answers ---------------------------------------------------------------------------------------

# Two bars of 20 mm collide at 10 m/s: until the waves return, at 8 us, the strain energy increases by rho A v^2 c per second, v = 5 m/s: at
# 4 us half of the kinetic energy of 4000 J, plus the part that stopped: 3000 J and 1000 J, as waves have crossed 20 of the 20 mm.
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
holds "says what they choose: $(cat err)" grep -q "^pilot  .*choose the method and the spacing for an error of energy.kinetic within 5 %" err
holds "says what each method needs" grep -q "^pilot  .*bonds: energy.kinetic +-" err
holds "says what is chosen" grep -q "^pilot  *chosen: method .*, spacing .* mm; the error of energy.kinetic is within .* %" err
holds "error bar: $(grep -A2 uncertainty collide/summary.json)" grep -q '"energy.kinetic"' collide/summary.json
is "no request is left in the scene" "$(grep -c '^accuracy\|^method: auto' collide/scene.yaml)" 0

# The scene as run states the same without auto.
"$cleave" run -q collide/scene.yaml -o whole 2>err >out
is "the scene as run" $? 0
holds "the same samples" cmp -s collide/history.csv whole/history.csv

# A repeated request has the same answer at once; a changed one is computed.
cp collide/scene.yaml before.yaml
"$cleave" run collide.yaml -o collide --resume 2>err >out
is "again" $? 0
holds "as chosen before: $(cat err)" grep -q "as chosen before" err
holds "the same scene" cmp -s before.yaml collide/scene.yaml
"$cleave" check collide.yaml >out 2>&1
is "check" $? 0
for words in "pilot runs estimate the error of energy.kinetic; 5 % is allowed$" "pilot runs vary the method (points, bonds), the spacing (it starts at 0.2 mm; coarser and finer ones are run as well) and the time step" \
    "pilot runs take at most 40 s (accuracy.budget), of which 24 s .*; the run that is chosen takes at most 800 s"; do
    holds "check says $words: $(cat out)" grep -q "^auto  .*$words" out
done

# Bonds that soften: whatever the accuracy, the spacing is below that of kappa 2, C l phi^2/(2 3.015), C = 4 pi/9, l = E G_c/strength^2 =
# 0.4375 mm, phi 1.035, above which the lattice holds cracks back. A strength surface starts bonds before they soften by themselves below 0.139 mm.
sed 's/^method: pd/method: auto/; /^particles:/d; s/^duration: .*/duration: 1 us/' "$root/inputs/strength_strip.yaml" >strip.yaml
"$cleave" check strip.yaml >out 2>&1
holds "auto with a strength: $(cat out)" grep -q "it starts at 0.1 mm; .*, at most 0.108[0-9]* mm is chosen, by tensile_strength)" out
"$cleave" check strip.yaml -s materials.0.compressive_strength=1GPa >out 2>&1
holds "auto with a surface: $(cat out)" grep -q "at most 0.046[0-9]* mm is chosen" out
"$cleave" check strip.yaml -s particles.spacing=0.3mm >out 2>&1
is "auto, a given spacing" $? 2
"$cleave" run strip.yaml -o strip -q -s 'accuracy={of: energy.strain, within: 50 %, budget: 80 s}' >out 2>&1
is "auto with a strength, a run: $(cat out)" $? 0
between "its spacing" "$(awk '$1 == "spacing:" { print $2; exit }' strip/scene.yaml)" 1e-6 0.1084e-3

# A plate with Poisson's ratio 0.2 under tension: sigma^2 V/(2 E), with state-based peridynamics or points, whichever is cheaper; without a
# name the larger energy is evaluated.
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
holds "figure chosen: $(cat err)" grep -q "error of energy.strain is within" err
holds "a static solver" grep -q '^solver: \(cg\|relaxation\)' results/plate/scene.yaml

# A spacing set by the user is kept.
"$cleave" run plate.yaml -s particles.spacing=0.2mm -o own 2>err >out
is "own spacing" $? 0
holds "it stays" grep -q '^  spacing: 0.0002 ' own/scene.yaml

"$cleave" check plate.yaml -s particles.spacing=1mm >out 2>&1
is "check of an own spacing" $? 0
holds "it is the finest: $(cat out)" grep -q "the method (states), the spacing (1 mm as given, and coarser)$" out
holds "an energy is judged: $(cat out)" grep -q "pilot runs estimate the error of the largest of its energies; 2 % is allowed" out

# An edge crack of 8 mm in 16 mm of aluminium, a/W = 0.5, H = W: K_I = 3.009 sigma sqrt(pi a) by boundary collocation. Without a name the
# first probe is evaluated.
cat >crack.yaml <<'END'
space: plane stress
thickness: 1 mm
duration: 1 s
method: auto
solver: static
accuracy: {within: 3 %, budget: 60 s}
material: {young: 70 GPa, poisson: 0.3, density: 2700 kg/m^3}
body: {box: {from: [0, 0], to: [16 mm, 16 mm]}}
cracks: [{from: [-1 mm, 8 mm], to: [8 mm, 8 mm]}]
boundary: [{traction: [0, 1 MPa], face: y+}, {traction: [0, -1 MPa], face: y-}]
output: {frames: 0}
probes: [sif: {contours: [3.2 mm]}]
END
"$cleave" run crack.yaml 2>err >out
is "edge crack" $? 0
near "edge crack" "$(figure results/crack probes.sif.K_I)" "$(compute "3.009e6*sqrt(3.14159265*8e-3)")" 0.03
holds "its first probe is judged: $(cat err)" grep -q "for an error of the first result of its probes that is not zero within 3 %" err

# A pulse in steel 0.1 m wide, exp(-(x/r)^2), travels 0.3 m: its crest is at 0.7 m.
cat >pulse.yaml <<'END'
space: line
duration: 0.05943 ms
method: auto
accuracy: {of: probes.crest.velocity_x, within: 1 %, budget: 40 s}
material: {young: 200 GPa, density: 7850 kg/m^3, critical_stretch: inf}
body: {box: {from: [0], to: [1.2]}}
initial: [{pulse: {at: [0.4], direction: [1], width: 0.1, velocity: 1 mm/s}}]
output: {frames: 0, samples: 4}
probes: [point: {name: crest, at: [0.7]}]
END
"$cleave" run pulse.yaml 2>err >out
is "pulse" $? 0
near "crest of the pulse" "$(figure results/pulse probes.crest.velocity_x)" 1e-3 0.01

# ---- the scene before the choice -------------------------------------------------------------------------------------

if command -v gnuplot >/dev/null; then
    "$cleave" plot --scene crack.yaml -o crack.png >out 2>&1
    is "picture" $? 0
    holds "says at which spacing: $(cat out)" grep -q "crack.yaml: with method: auto .* so it is drawn at 0.0002[0-9]* m" out
    holds "picture" test -s crack.png
fi

# ---- impossible requests ---------------------------------------------------------------------------------------------

# refused WORDS ARGUMENTS: checks that a run ends with status 2 and a line that contains WORDS, without results.
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
refused "nothing moves or loads the bodies" plate.yaml -s boundary=[]
refused "no time is left for it" collide.yaml -s accuracy.budget=1ms
refused "accuracy_table: is no longer a key; remove it (.method: auto. always chooses by pilot runs)" plate.yaml -s accuracy_table=mine.csv
refused "auto cannot be combined with load steps" plate.yaml -s steps.number=3
refused "accuracy: 0 is out of range" plate.yaml -s accuracy=0
refused "is not a figure of summary.json" plate.yaml -s "accuracy={of: [1]}"
refused "no method of the pilot runs can be combined with the model, solver and pd.region" plate.yaml -s "pd.region={box: {from: [0, 0], to: [1mm, 1mm]}}"
printf 'x, y\n0, 0\n0.001, 0\n0, 0.001\n0.001, 0.001\n' >list.csv
refused "comes from a particle list" plate.yaml -s body= -s "bodies=[{name: a, particles: list.csv}]"

# Other commands refuse a scene without a method at its line.
for command in "converge" "sweep -s time.safety=0.5,0.8" "export lammps"; do
    "$cleave" ${command%% -s*} collide.yaml $(echo "$command" | grep -o -- '-s.*') -o none >out 2>err
    is "$command" $? 2
    is "$command: lines" "$(wc -l <err)" 1
    holds "$command: $(cat err)" grep -q "collide.yaml:3:1: method: the method auto works in .cleave run. only, which makes pilot runs; give a method" err
    holds "$command: left behind" test ! -e none
done
finish
