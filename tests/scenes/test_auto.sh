#!/bin/sh
# `method: auto` as users meet it: real scenes reach the accuracy that they ask for, say what was chosen, run again without
# auto to the same bits; what it cannot do is refused with one line that says what is nearest.
test_name=test_auto
. tests/support/summary.sh
. tests/support/trust.sh

# ---- scenes that reach what they ask for -----------------------------------------------------------------------------

# A pulse in steel 0.1 m wide that goes 0.3 m, three widths. Root mean square of v exp(-(x/r)^2), r = 25 mm, over 1.2 m: 0.16159 v;
# of the stress rho c v too, rho c = 39623000 Pa s/m.
cat >"$work/pulse.yaml" <<'END'
space: line
duration: 0.05943 ms
method: auto
accuracy: 1 %
material: {young: 200 GPa, density: 7850 kg/m^3, critical_stretch: inf}
body: {box: {from: [0], to: [1.2]}}
initial: [{pulse: {at: [0.4], direction: [1], width: 0.1, velocity: 1 mm/s}}]
output: {frames: 2, samples: 4}
probes: [exact: pulse]
END
for percent in 5 1 0.3; do
    calm "$work/pulse$percent" "$work/pulse.yaml" -s "accuracy=$percent %"
    stress=$(figure "$work/pulse$percent" probes.exact.L2) velocity=$(figure "$work/pulse$percent" probes.exact.L2_velocity)
    error=$(compute "sqrt(0.5*(($stress/(0.16159*39623))^2 + ($velocity/0.16159e-3)^2))")
    between "pulse at $percent %" "$error" 0 "$(compute "$percent/100")"
    between "pulse at $percent %: not far better than asked" "$error" "$(compute "$percent/500")" 1
    between "pulse at $percent %: expected" "$(figure "$work/pulse$percent" auto.expected_error)" 0 "$(compute "$percent/100*1.000001")"
done

# An edge crack of 8 mm in 16 mm of aluminium, a/W = 0.5, H = W: K_I = 3.009 sigma sqrt(pi a) by boundary collocation.
cat >"$work/crack.yaml" <<'END'
space: plane stress
thickness: 1 mm
duration: 1 s
method: auto
solver: static
material: {young: 70 GPa, poisson: 0.3, density: 2700 kg/m^3}
body: {box: {from: [0, 0], to: [16 mm, 16 mm]}}
cracks: [{from: [-1 mm, 8 mm], to: [8 mm, 8 mm]}]
boundary: [{traction: [0, 1 MPa], face: y+}, {traction: [0, -1 MPa], face: y-}]
output: {frames: 1}
probes: [sif: {contours: [3.2 mm]}]
END
calm "$work/crack" "$work/crack.yaml"
near "edge crack at 1 %" "$(figure "$work/crack" probes.sif.K_I)" "$(compute "3.009e6*sqrt(3.14159265*8e-3)")" 0.01
calm "$work/ring" "$work/crack.yaml" -s 'probes=[sif]'
near "edge crack, rings of auto" "$(figure "$work/ring" probes.sif.K_I)" "$(compute "3.009e6*sqrt(3.14159265*8e-3)")" 0.01
is "edge crack: static" "$(figure "$work/crack" solver.name)" cg

# 0.1 m of aluminium strike 0.9 m: the break is at 0.1 m from the free end when the waves have gone 1 m.
cat >"$work/spall.yaml" <<'END'
space: line
duration: 0.23 ms
method: auto
accuracy: 2 %
material: {young: 70 GPa, density: 2700 kg/m^3, critical_stretch: 1.5515e-3}
body: {box: {from: [0], to: [1]}}
initial: [{velocity: [-20], region: {box: {from: [0.9], to: [1]}}}]
output: {frames: 2, samples: 10}
probes: [spall]
END
calm "$work/spall" "$work/spall.yaml"
near "spall at 2 %: time" "$(figure "$work/spall" probes.spall.time)" "$(compute "1/sqrt(70e9/2700)")" 0.03
near "spall at 2 %: place" "$(figure "$work/spall" probes.spall.position)" 0.1 0.03

# ---- the scene as run ------------------------------------------------------------------------------------------------

for scene in pulse1 crack spall; do
    calm "$work/again" "$work/$scene/scene.yaml"
    sed '/^  "auto": {/,/^  },/d; /"threads"/,$d; /"name"/d' "$work/$scene/summary.json" >"$work/figures_a"
    sed '/"threads"/,$d; /"name"/d' "$work/again/summary.json" >"$work/figures_b"
    holds "$scene: the same figures" cmp "$work/figures_a" "$work/figures_b"
    holds "$scene: the same samples" cmp "$work/$scene/history.csv" "$work/again/history.csv"
    holds "$scene: the same frames" diff -r -q "$work/$scene/frames" "$work/again/frames"
    rm -r "$work/again"
done
for threads in 2 3; do
    calm "$work/crack$threads" "$work/crack.yaml" -t $threads
    same "auto on $threads threads" "$work/crack" "$work/crack$threads"
done

# ---- what it says ----------------------------------------------------------------------------------------------------

"$cleave" check "$work/pulse.yaml" >"$work/out" 2>"$work/err" || fail "check: $(cat "$work/err")"
for words in "like a pulse in a bar" "0.1 m" "is asked" "next best"; do
    holds "check says $words" grep -q "^auto .*$words" "$work/out"
done

# ---- what it refuses -------------------------------------------------------------------------------------------------

# refused WHAT WORDS ARGUMENTS: exit status 2 and one line with these words.
refused()
{
    what=$1 words=$2; shift 2
    "$cleave" run -q -o "$work/refused" "$@" >"$work/out" 2>"$work/err"
    is "$what: exit status" $? 2
    is "$what: lines" "$(wc -l <"$work/err")" 1
    holds "$what: says '$(cat "$work/err")'" grep -q -- "$words" "$work/err"
    holds "$what: left behind" test ! -e "$work/refused"
}
# outside WHAT WORDS ARGUMENTS: the table does not answer, for a reason with these words; pilot runs would.
outside()
{
    what=$1 words=$2; shift 2
    "$cleave" check "$@" >"$work/out" 2>"$work/err"
    is "$what: exit status" $? 0
    holds "$what: says '$(cat "$work/out" "$work/err")'" grep -q -- "^auto  .*$words" "$work/out"
    holds "$what: pilot runs" grep -q "cleave run takes pilot runs" "$work/out"
}
cat >"$work/thin.yaml" <<'END'
space: plane stress
thickness: 1 mm
duration: 2 us
method: auto
material: {young: 200 GPa, poisson: 1/3, density: 8000}
body: {box: {from: [0, 0], to: [40 mm, 4 mm]}}
boundary: [{body_force: [0, 1e6], profile: {sine: {wavelength: 40 mm}}}]
END
outside "too accurate" "is not reached by the table of a pulse in a bar; .* % is, by " "$work/pulse.yaml" -s accuracy=1e-6
refused "no accuracy" "accuracy: 0 is out of range" "$work/pulse.yaml" -s accuracy=0
outside "no pulse" "a bar without initial pulse and without traction" "$work/pulse.yaml" -s initial=
outside "a pulse and a moving end" "a load that its nearest problem does not have" "$work/pulse.yaml" \
    -s "boundary=[{velocity: [1], region: {box: {from: 1.1, to: 1.2}}}]"
outside "a strained bar" "an initial velocity or strain" "$work/pulse.yaml" \
    -s "initial=[{pulse: {at: [0.4], direction: [1], width: 0.1, velocity: 1e-3}}, {displacement_gradient: [1e-6]}]"
outside "several bodies" "several bodies" inputs/hopkinson_bar.yaml -s method=auto -s material.critical_stretch=inf
outside "yields" "a material that yields" "$work/pulse.yaml" -s material.yield_stress=1MPa
outside "shaken" "a shaken lattice" "$work/crack.yaml" -s particles.irregularity=0.3
outside "at rest, no crack" "plates with a round hole or a crack" "$work/crack.yaml" -s cracks=
outside "a hole in time" "nearest is one at rest (solver: static)" inputs/plate_hole.yaml -s method=auto -s material.critical_stretch=inf -s particles.spacing=
outside "large strains" "the table's problems are linear" "$work/pulse.yaml" -s "initial[0].pulse.velocity=500"
outside "large strains of a spall" "the table.s problems are linear" inputs/hopkinson_bar.yaml -s method=auto -s particles= -s time= -s accuracy=5%
outside "a spacing too wide" "fits the keys of pd, mpm, model and spacing that it fixes" "$work/pulse.yaml" -s particles.spacing=0.1
outside "what no method is" "no method of the cost-accuracy table for" "$work/pulse.yaml" -s particles.horizon=7.3 -s method=auto -s mpm.frame=current -s mpm.transfer=flip -s mpm.cell=3 -s accuracy=5%
refused "no chart" "no such file" "$work/pulse.yaml" -s accuracy_table=nowhere.csv
printf 'problem\nbar\n' >"$work/bad.csv"
refused "a bad chart" "bad.csv:1:1: no cost-accuracy table" "$work/pulse.yaml" -s "accuracy_table=$work/bad.csv"

outside "a thin plate" "thinner than half the wavelength" "$work/thin.yaml"
outside "a short ligament" "longer than what is left before it" "$work/crack.yaml" -s "cracks=[{from: [-1 mm, 8 mm], to: [11 mm, 8 mm]}]"
outside "a figure" "accuracy names a figure, probes.sif.K_I" "$work/crack.yaml" -s "accuracy={of: probes.sif.K_I}"
refused "no budget" "accuracy.budget: 0 is out of range\|budget: 0" "$work/crack.yaml" -s "accuracy={budget: 0}"
refused "no figure" "no figure of summary.json" "$work/crack.yaml" -s "accuracy={of: [1]}"
refused "an unknown key" "acuracy\|bydget" "$work/crack.yaml" -s "accuracy={bydget: 3 s}"

# A table of one's own: with peridynamics alone, it is peridynamics.
{ head -n 1 bench/accuracy/cost_accuracy.csv; grep '^bar,pulse,pd bond,' src/auto/cost_accuracy.csv; } >"$work/own.csv"
calm "$work/own" "$work/pulse.yaml" -s "accuracy_table=own.csv" -s accuracy=5%
is "a table of one's own" "$(figure "$work/own" auto.picked)" "pd bond"

# A table in which cells of eight spacings take half of the time: they are chosen, written into the scene and said why; a scene that says
# that it wants none has none.
cat >"$work/struck.yaml" <<'END'
space: plane stress
thickness: 10 mm
duration: 10 us
method: auto
accuracy: 15 %
accuracy_table: levels.csv
material: {young: 190 GPa, poisson: 1/3, density: 7800 kg/m^3, energy_release_rate: 69 kJ/m^2}
body: [{box: {from: [0, -100 mm], to: [100 mm, 100 mm]}}, {add: {box: {from: [-3 mm, -25 mm], to: [0, 25 mm]}}}]
cracks: [{from: [-4 mm, -25 mm], to: [50 mm, -25 mm]}, {from: [-4 mm, 25 mm], to: [50 mm, 25 mm]}]
boundary: [{velocity: [2.2 m/s, free], region: {box: {from: [-3 mm, -25 mm], to: [0, 25 mm]}}}]
output: {frames: 0, samples: 4}
END
{
    head -n 1 bench/accuracy/cost_accuracy.csv
    grep '^fracture,Kalthoff,adaptive reference,' bench/accuracy/cost_accuracy.csv
    grep '^fracture,Kalthoff,adaptive reference,' bench/accuracy/cost_accuracy.csv | awk -F, -v OFS=, '
        { $3 = "adaptive levels 2"; $8 *= 0.5; sub(/mpm.levels=0/, "mpm.levels=2", $11); print }'
} >"$work/levels.csv"
calm "$work/levels" "$work/struck.yaml"
is "levels" "$(figure "$work/levels" auto.picked)" "adaptive levels 2, far cells of 8 spacings in 0.50 of the time"
is "levels: in the scene" "$(grep -c "levels: 2" "$work/levels/scene.yaml")" 1
is "levels: the next best" "$(figure "$work/levels" auto.next_best)" "adaptive reference"
calm "$work/without" "$work/struck.yaml" -s mpm.levels=0
is "levels: 0" "$(figure "$work/without" auto.picked)" "adaptive reference"
calm "$work/own_levels" "$work/struck.yaml" -s mpm.levels=auto
is "levels: auto" "$(figure "$work/own_levels" auto.picked)" "$(figure "$work/levels" auto.picked)"
finish
