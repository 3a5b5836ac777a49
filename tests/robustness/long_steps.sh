#!/bin/sh
# Load steps in detail: every shipped scene at twice its spacing, with each kind of crack growth and each method, and a plate without
# supports: stopped after every load step, and stopped and killed at random moments; also static solvers. Results are always bitwise equal
# to those of an undisturbed run. SCENES: a pattern of scenes to select.
test_name=long_steps
. tests/support/summary.sh
. tests/support/trust.sh
seed=${SEED:-$(date +%s)}
echo "seed $seed"
export OMP_WAIT_POLICY=passive

# disturbed WHAT ARGUMENTS: checks that a run which is stopped 5 times, and one which is killed 5 times, at random moments, have the results
# of an undisturbed run, bitwise.
disturbed()
{
    what=$1; shift
    echo "$what"
    rm -rf "$work/whole"
    calm "$work/whole" -t 1 "$@"
    stops 5 "$work/whole" "$@"
    kills 5 "$work/whole" "$@"
}

# in_steps WHAT ARGUMENTS: checks as disturbed(), and also a run that is stopped after every load step.
in_steps()
{
    disturbed "$@"; shift
    rm -rf "$work/pieces"
    piecewise "$work/pieces" "$@"
    between "$what: pieces" "$parts" 2 10
    same "$what: in pieces" "$work/whole" "$work/pieces"
}

for scene in $(grep -l '^solver: static' inputs/*.yaml inputs/new/*.yaml | grep "${SCENES:-.}"); do
    few="$scene $(coarser "$scene" 2) -s probes=[] -s steps.number=10 -s output.frames=3"
    in_steps "$scene" $few
    in_steps "$scene, bonds whose strength scatters" $few -s steps.path=bonds -s 'material.scatter={modulus: 10, length: 5 mm}'
    in_steps "$scene, points" $few -s method=adaptive
    in_steps "$scene, states" $few -s model=ospd
done

cat >"$work/free.yaml" <<'END'
space: plane stress
thickness: 1 mm
duration: 1 s
method: pd
solver: static
steps: {number: 10, control: energy}
material: {young: 72 GPa, density: 2440, energy_release_rate: 135 J/m^2}
body: {box: {from: [0, 0], to: [20 mm, 20 mm]}}
particles: {spacing: 0.5 mm}
cracks: [{from: [-1 mm, 10 mm], to: [8.1 mm, 10 mm]}]
boundary:
  - {traction: [0, 12 MPa], face: y+, time: {ramp: {until: 1 s}}}
  - {traction: [0, -12 MPa], face: y-, time: {ramp: {until: 1 s}}}
output: {frames: 2}
END
in_steps "a free plate" "$work/free.yaml"
in_steps "a free plate, by bonds" "$work/free.yaml" -s steps.path=bonds
in_steps "a free plate of points" "$work/free.yaml" -s method=adaptive

crack="inputs/edge_crack_k1.yaml -s particles.spacing=0.2mm -s model=bond -s material.poisson=1/3 -s probes=[] -s output.checkpoint=0"
disturbed "conjugate gradients" $crack
disturbed "relaxation" $crack -s solver=relaxation
disturbed "relaxation of points" $crack -s solver=relaxation -s method=adaptive

finish
