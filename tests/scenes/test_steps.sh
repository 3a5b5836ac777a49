#!/bin/sh
# Load steps in whole runs: output files, pictures, bitwise equality on any number of threads and after stops between any two load steps,
# `cleave check`, refusals, and a run without equilibrium.
# Takes 25 s: each shipped scene in load steps is run without a stop and in parts.
test_name=test_steps
. tests/support/summary.sh
. tests/support/trust.sh
seed=5
export OMP_WAIT_POLICY=passive

# A notched plate between grips, with 400 particles.
cat >"$work/pulled.yaml" <<'END'
space: plane stress
thickness: 1 mm
duration: 1 s
method: pd
solver: static
steps: {number: 6, control: energy}
material: {young: 200 GPa, poisson: 1/3, density: 7850 kg/m^3, energy_release_rate: 100 J/m^2}
body: {box: {from: [0, 0], to: [20 mm, 20 mm]}}
particles: {spacing: 1 mm, horizon: 3.015}
cracks: [{from: [-1 mm, 10 mm], to: [8 mm, 10 mm]}]
boundary:
  - {name: top, displacement: [0, 0.05 mm], time: {ramp: {until: 1 s}}, region: {box: {from: [0, 17 mm], to: [20 mm, 21 mm]}}}
  - {name: bottom, fixed: [x, y], region: {box: {from: [0, -1 mm], to: [20 mm, 3 mm]}}}
probes: [{reaction: {boundary: top}}, {reaction: {name: below, boundary: bottom}}, tip, break, {point: {name: gauge, at: [10 mm, 15 mm]}}]
output: {frames: 3}
END
pulled=$work/pulled.yaml

# The plate in 3D, 4 particles thick, with a crack plane oblique to the sides.
sed -e 's/^space: .*/space: solid/; /^thickness/d; s/\(\[[^],]*, [^],]*\)\], to: \(\[[^],]*, [^],]*\)\]/\1, -1 mm], to: \2, 5 mm]/g' \
    -e 's/^body: .*/body: {box: {from: [0, 0, 0], to: [20 mm, 20 mm, 4 mm]}}/; s/poisson: 1.3/poisson: 1\/4/' \
    -e 's/displacement: \[0, 0.05 mm\]/displacement: [0, 0.05 mm, 0]/; s/\[x, y\]/[x, y, z]/; s/at: \[10 mm, 15 mm\]/at: [10 mm, 15 mm, 2 mm]/' \
    -e 's/^cracks: .*/cracks: [{polygon: [[-1 mm, 9 mm, -1 mm], [8 mm, 9 mm, -1 mm], [8 mm, 11 mm, 5 mm], [-1 mm, 11 mm, 5 mm]]}]/' "$work/pulled.yaml" >"$work/space.yaml"
grips='boundary=[{name: top, traction: [0, 100 MPa], face: y+, time: {ramp: {until: 1 s}}},'
last() { column "$1" "$2" 9; }

# Crack area in 3D: bonds that are broken in a trial, to determine the cost of an increment, do not count.
calm "$work/area" tests/robustness/scenes/steps_solid.yaml
is "records of an area before a bond has broken" "$(awk -F, 'NR == 1 { for (k = 1; k <= NF; k++) { if ($k ~ /^crack_area/) a = k
    if ($k ~ /^bonds_broken/) b = k }; next } { broken += $b > 0 } $b == 0 && $a != 0 { n++ } END { print n + 0, (broken > 0) }' "$work/area/history.csv")" "0 1"

# ---- output files --------------------------------------------------------------------------------------------------

calm "$work/led" $pulled -t 1
led=$work/led
is "lines of history" "$(wc -l <"$led/history.csv")" 8
is "frames, one at the start" "$(ls "$led/frames" | grep -c 'hdf$')" 4
is "steps" "$(figure "$led" load_steps.steps)" 6
is "control" "$(figure "$led" load_steps.control)" energy
is "the first break" "$(figure "$led" crack.start_step)" 2
is "the tip grows" "$(figure "$led" crack.tip_start_step)" 2
is "a break probe sees it" "$(figure "$led" probes.break.first_step)" 2
absent "no time of a break" "$(figure "$led" crack.start_time)"
absent "no speed of a tip" "$(figure "$led" crack.tip_speed_max)"
absent "nor of a probe's" "$(figure "$led" probes.tip.speed_mean)"
is "the peak is at the first" "$(figure "$led" probes.reaction.force_max_step)" 1
near "its displacement is that of the grip" "$(figure "$led" probes.reaction.force_max_displacement)" "$(column "$led" reaction.displacement_y 0.17)" 1e-8
near "both grips bear the same" "$(last "$led" reaction.force_y)" "$(compute "-($(last "$led" below.force_y))")" 1e-5
is "five advances of two spacings" "$(last "$led" crack_area)" 1e-05
is "in the summary, too" "$(compute "$(figure "$led" load_steps.crack_area)")" 1e-05
# 18 bonds cross each spacing of a lattice line: 5 to the next row, 5 to the second, which two spacings share, 1 to the third.
is "bonds that broke" "$(figure "$led" load_steps.bonds_broken)" 180
# Bonds across a lattice line have 0.987 G_c; the last increment, near the edge, deviates by 1 %.
between "release rate" "$(figure "$led" load_steps.release_rate)" 97 101
between "release rate of the fourth" "$(column "$led" release_rate 0.7)" 98 99.5
near "released is what bonds held and what was lost" "$(last "$led" released)" "$(compute "$(last "$led" fracture) + $(last "$led" damped)")" 1e-6
# Work of supports by the mean of two equilibria: second order in strains of 1e-3.
between "balance" "$(figure "$led" energy.balance_error)" -3e-4 3e-4
is "nothing moves" "$(last "$led" gauge.velocity_y)$(last "$led" kinetic)" 00
between "equilibria of a step" "$(last "$led" equilibria)" 2 10
between "directions of a step" "$(last "$led" search_directions)" 5 200

# The J-integral around the moved tip, an independent measure, equals the released energy; 4 % for bonds with a horizon of 3.
calm "$work/sif" $pulled -t 1 -s particles.spacing=0.5mm -s steps.number=5 -s 'probes=[{sif: {outer: 5 mm, contours: [4 mm, 5 mm]}}]'
between "J of the grown crack" "$(last "$work/sif" sif.J)" 94 103
near "K_I fits it" "$(last "$work/sif" sif.K_I)" "$(compute "sqrt(200e9 * $(last "$work/sif" sif.J))")" 0.05

# ---- forces of supports that no probe measures ---------------------------------------------------------------------

# A bar: E A eps of the strain between two points away from its grips; the wall bears the same force, has no displacement, and the figures of
# the summary are those of the probes of the scene alone. The strain there is uniform to the decay of the grips' layers.
cat >"$work/bar.yaml" <<'END'
space: line
section: 3 mm^2
duration: 2 s
method: pd
solver: static
steps: {number: 4}
material: {young: 70 GPa, density: 2700 kg/m^3}
body: {box: {from: [0], to: [40 mm]}}
particles: {spacing: 0.5 mm, horizon: 3}
boundary:
  - {name: wall, fixed: [x], face: x-}
  - {name: grip, displacement: [0.02 mm], time: {ramp: {until: 2 s}}, face: x+}
probes: [{point: {name: a, at: [10.25 mm]}}, {point: {name: b, at: [30.25 mm]}}]
output: {frames: 1}
END
bar=$work/bar
"$cleave" run "$bar.yaml" -q -o "$bar" >"$work/out" 2>"$work/err"
is "bar: $(cat "$work/err")" $? 0
strain=$(compute "($(last "$bar" b.displacement_x) - $(last "$bar" a.displacement_x))/0.02")
near "E A eps" "$(last "$bar" grip.force_x)" "$(compute "70e9 * 3e-6 * $strain")" 1e-5
near "the wall bears it" "$(last "$bar" wall.force_x)" "$(compute "-($(last "$bar" grip.force_x))")" 1e-7
near "way of the grip" "$(last "$bar" grip.displacement_x)" 2e-5 1e-12
holds "a wall at rest has no displacement" sh -c "! grep -q 'wall.displacement' '$bar/history.csv'"
is "figures are those of probes alone" "$(grep -c '"wall"\|"grip"' "$bar/summary.json")" 0

# A bar that breaks has a crack of its section at each cut: one where its middle is weak, two where both grips let go.
sed -e 's/section: .*/section: 1 mm^2/; s/0.02 mm/0.15 mm/; s/0.5 mm/1 mm/; s/number: 4/number: 10/' -e 's/^body.*/bodies: [{name: b, material: whole, shape: {box: {from: [0], to: [100 mm]}}, parts: [{region: {box: {from: [48 mm], to: [52 mm]}}, material: weak}]}]/' \
    -e 's/^material.*/materials: [{name: whole, young: 70 GPa, density: 2700, critical_stretch: 0.4 %}, {name: weak, young: 70 GPa, density: 2700, critical_stretch: 0.1 %}]/' "$bar.yaml" >"$work/weak.yaml"
sed -e 's/section: .*/section: 1 mm^2/; s/0.02 mm/0.12 mm/; s/40 mm/100 mm/; s/0.5 mm/1 mm/; s/number: 4/number: 10/; s/density: 2700/critical_stretch: 0.1 %, density: 2700/' "$bar.yaml" >"$work/grips.yaml"
for name in weak grips; do "$cleave" run "$work/$name.yaml" -q -o "$work/$name" >"$work/out" 2>&1; done
is "a bar in two pieces" "$(column "$work/weak" crack_area 2)" 1e-06
is "a bar that leaves both grips" "$(column "$work/grips" crack_area 2)" 2e-06

# Loads on lists of particles that overlap: the wall bears their sum, that of points that two of them load counted once each.
for method in pd mpm; do
    calm "$bar$method" "$bar.yaml" -s method=$method -s 'gravity=[100 km/s^2]' \
        -s 'boundary=[{name: wall, fixed: [x], face: x-}, {name: end, traction: [10 MPa], face: x+}, {name: all, body_force: [1 GN/m^3]}]'
    near "$method: sum of the loads" "$(last "$bar$method" wall.force_x)" "$(compute "-(10e6 * 3e-6 + (1e9 + 2700 * 1e5) * 3e-6 * 0.04)")" 1e-6
    apart "$method: balance of these loads" "$(figure "$bar$method" energy.balance_error)" 0 1e-6
done

# A beam on two rollers, pressed by a third that bears a probe's name; on any number of threads.
cat >"$work/bend.yaml" <<'END'
space: plane stress
thickness: 4 mm
duration: 1 s
method: pd
solver: static
steps: {number: 2}
material: {young: 20 GPa, poisson: 1/3, density: 2300 kg/m^3}
body: {box: {from: [0, 0], to: [60 mm, 10 mm]}}
particles: {spacing: 1 mm, horizon: 3.015}
boundary:
  - {name: left, fixed: [x, y], region: {box: {from: [4 mm, 0], to: [6 mm, 1 mm]}}}
  - {name: right, velocity: [free, 0], region: {box: {from: [54 mm, 0], to: [56 mm, 1 mm]}}}
  - {name: roller, displacement: [free, -0.02 mm], time: {ramp: {until: 1 s}}, region: {box: {from: [29 mm, 9 mm], to: [31 mm, 10 mm]}}}
probes: [{point: {name: roller, at: [30 mm, 2 mm]}}]
output: {frames: 1}
END
for threads in 1 2; do
    "$cleave" run "$work/bend.yaml" -q -t $threads -o "$work/bend$threads" >"$work/out" 2>"$work/err"
    is "bend, $threads threads: $(cat "$work/err")" $? 0
done
load=$(last "$work/bend1" reaction_roller.force_y)
near "two supports bear the load" "$(compute "$(last "$work/bend1" left.force_y) + $(last "$work/bend1" right.force_y)")" "$(compute "-($load)")" 1e-6
near "each a half" "$(last "$work/bend1" left.force_y)" "$(compute "-($load)/2")" 1e-5
holds "the same bits on two threads" cmp -s "$work/bend1/history.csv" "$work/bend2/history.csv"

# ---- pictures ------------------------------------------------------------------------------------------------------

if command -v gnuplot >/dev/null; then
    "$cleave" plot "$led" --size 90mmx70mm >"$work/out" 2>"$work/err"
    is "plot: status" $? 0
    for picture in load_displacement r_curve crack energy damage; do
        holds "$picture.png is made" test -s "$led/pictures/$picture.png"
    done
    "$cleave" run -q -o "$work/blind" $pulled -s 'probes=[]' -s steps.number=1 2>"$work/err"
    "$cleave" plot "$work/blind" --size 90mmx70mm >"$work/out" 2>&1
    holds "the curve of supports without probes" test -s "$work/blind/pictures/load_displacement.png"
    holds "without growth no R-curve" grep -q 'r_curve.png is not drawn: no crack has grown' "$work/out"
fi

# ---- bitwise equality ----------------------------------------------------------------------------------------------

# bits WHAT ARGUMENTS: checks bitwise equality of a run on 1 and 2 threads, and after stops at every load step.
bits()
{
    what=$1; shift
    "$cleave" run -q -o "$work/$what" "$pulled" -t 1 "$@" 2>"$work/err" || fail "$what: $(cat "$work/err")"
    "$cleave" run -q -o "$work/${what}_2" "$pulled" -t 2 "$@" 2>"$work/err"
    same "$what: 1 and 2 threads" "$work/$what" "$work/${what}_2"
    piecewise "$work/${what}_parts" "$pulled" "$@"
    between "$what: stops" $parts 4 9
    same "$what: in pieces" "$work/$what" "$work/${what}_parts"
}

bits hoop
bits bonds -s steps.path=bonds -s steps.number=4
bits opened -s steps.control=opening -s 'steps.from=[0, 9 mm]' -s 'steps.to=[0, 11 mm]' -s steps.opening=6um -s steps.number=5
bits adaptive -s method=adaptive -s mpm.frame=reference -s steps.number=4
bits states -s model=ospd -s steps.number=4

plane=$pulled pulled=$work/space.yaml
bits space
pulled=$plane
# Five increments of two spacings, width along the front 4 mm (1 + (2/6)^2)^1/2; bonds across a plane have 0.98 G_c.
near "space: area" "$(last "$work/space" crack_area)" "$(compute "5*2e-3*4e-3*sqrt(10)/3")" 1e-6
between "space: release rate" "$(figure "$work/space" load_steps.release_rate)" 97 101
# Grips load one end more than the other when the crack is oblique.
near "space: the front stays in its plane" "$(last "$work/space" path_y)" 0.01 2e-2
near "space: and goes on" "$(last "$work/space" path_x)" 0.018 2e-3

# A free body; scatter of strength.
bits free -s "$grips {name: bottom, traction: [0, -100 MPa], face: y-, time: {ramp: {until: 1 s}}}]"
bits scattered -s steps.path=bonds -s 'material.scatter={modulus: 6, length: 2 mm}' -s steps.number=4

# Every shipped scene in load steps, eight times as coarse, in 3D and with a strength twice, as a whole and stopped after every load step;
# one also on 2 threads.
for scene in $(grep -l '^solver: static' inputs/*.yaml inputs/new/*.yaml); do
    name=$(basename "$scene" .yaml) factor=8
    ! grep -q '^space: solid\|tensile_strength' "$scene" || factor=2 # a strength bounds the horizon
    small="$scene $(coarser "$scene" $factor) -s probes=[] -s output.frames=1 -s steps.number=4"
    threads=1; [ "$name" != compact_tension ] || threads=2
    "$cleave" run -q -o "$work/$name" -t $threads $small 2>"$work/err" || fail "$name: $(cat "$work/err")"
    piecewise "$work/${name}_parts" $small
    between "$name: pieces" $parts 2 4
    same "$name: in pieces" "$work/$name" "$work/${name}_parts"
done

# Killed at any stage.
kills 3 "$led" $pulled

# ---- an interface ------------------------------------------------------------------------------------------------------

# A double cantilever whose arms are joined along its middle: its failure load is proportional to the root of the toughness of the
# interface, and depends on nothing else: 3.33 N measured with increments of the energy of two spacings of the interface (steps.energy).
cat >"$work/arms.yaml" <<'END'
space: plane stress
thickness: 1 mm
duration: 1 s
method: pd
solver: static
steps: {number: 12, control: energy}
materials:
  - {name: m1, young: 3 GPa, density: 1180, energy_release_rate: 10000}
  - {name: m2, young: 3 GPa, density: 1180, energy_release_rate: 10000}
bodies:
  - {name: up, material: m1, shape: {box: {from: [0, 0], to: [100 mm, 10 mm]}}}
  - {name: down, material: m2, shape: {box: {from: [0, -10 mm], to: [100 mm, 0]}}}
interfaces: [{bodies: [up, down], energy_release_rate: 75}]
particles: {spacing: 1 mm}
cracks: [{from: [-1 mm, 0], to: [40 mm, 0]}]
boundary:
  - {name: u, displacement: [free, 5 mm], region: {box: {from: [0, 8.5 mm], to: [2 mm, 10 mm]}}, time: {ramp: {until: 1 s}}}
  - {name: d, displacement: [free, -5 mm], region: {box: {from: [0, -10 mm], to: [2 mm, -8.5 mm]}}, time: {ramp: {until: 1 s}}}
  - {fixed: [x], region: {box: {from: [98.5 mm, -1 mm], to: [inf, 1 mm]}}}
output: {frames: 0}
probes: [reaction: {boundary: u}]
END
"$cleave" run "$work/arms.yaml" -q -o "$work/tough" 2>/dev/null
"$cleave" run "$work/arms.yaml" -q -o "$work/brittle" -s materials.0.energy_release_rate=300 -s materials.1.energy_release_rate=400 2>/dev/null
"$cleave" run "$work/arms.yaml" -q -o "$work/frail" -s interfaces.0.energy_release_rate=30 2>/dev/null
peak() { figure "$work/$1" probes.reaction.force_max; }
between "interface: load" "$(peak tough)" 3.30 3.36
between "interface: whatever the arms" "$(awk -v a="$(peak brittle)" -v b="$(peak tough)" 'BEGIN { print a / b }')" 0.999 1.001
between "interface: root of its toughness" "$(awk -v a="$(peak tough)" -v b="$(peak frail)" 'BEGIN { print a / b / sqrt(75 / 30) }')" 0.998 1.002

# ---- a crack in 3D without a tracked front -----------------------------------------------------------------------------

# A penny crack in a block, an eighth by mirrors: it grows bond by bond through the remaining section, at 0.98 G_c per area throughout
# (bonds across a plane have 0.98), and the run ends before the section is separated: area of the section minus that of the polygon, within
# one increment, 0.17 of it: the last one breaks bonds that still connect the faces. Half of the energy is in the body.
cat >"$work/penny.yaml" <<'END'
variables: {a: 6 mm, L: 16 mm, pull: 40 MPa}
space: solid
duration: 1 s
method: pd
solver: static
steps: {number: 30, control: energy}
material: {young: 70 GPa, density: 2500, energy_release_rate: 20 J/m^2}
body: {box: {from: [0, 0, 0], to: [L, L, L]}}
particles: {spacing: 2 mm}
cracks:
  - polygon: [[a, 0, 0], [a*cos(pi/6), a*sin(pi/6), 0], [a*cos(pi/3), a*sin(pi/3), 0], [0, a, 0], [-a, 0, 0], [0, -a, 0]]
boundary:
  - {mirror: {axis: x, at: 0}}
  - {mirror: {axis: y, at: 0}}
  - {mirror: {axis: z, at: 0}}
  - {name: top, traction: [0, 0, pull], face: z+, time: {ramp: {until: 1 s}}}
output: {frames: 0}
END
"$cleave" run "$work/penny.yaml" -q -o "$work/penny" 2>"$work/err"
holds "penny: it says that the crack goes through" grep -q 'the crack cuts the body' "$work/err"
between "penny: balance" "$(figure "$work/penny" energy.balance_error)" -1e-3 1e-3
between "penny: release rate" "$(figure "$work/penny" load_steps.release_rate)" 19 21
between "penny: the last release rate" "$(last "$work/penny" release_rate)" 19 21
between "penny: area" "$(compute "$(figure "$work/penny" load_steps.crack_area)/(256e-6 - 27e-6)")" 0.83 1.17

# ---- check -----------------------------------------------------------------------------------------------------------

"$cleave" check $pulled >"$work/out" 2>&1
is "check: status" $? 0
holds "check: solver" grep -q '^solver  *static: 6 load steps at most, by energy' "$work/out"
holds "check: what leads the crack" grep -q '^cracks  *1 crack tip is extended in the direction of the largest hoop stress' "$work/out"
"$cleave" check "$work/space.yaml" >"$work/solid" 2>&1
holds "check: what leads it in space" grep -q '^cracks  *1 crack front is extended in the direction of the largest hoop stress .* straight through the body' "$work/solid"
ends='cracks=[{polygon: [[-1 mm, 10 mm, -1 mm], [8 mm, 10 mm, -1 mm], [8 mm, 10 mm, 2 mm], [-1 mm, 10 mm, 2 mm]]}]'
"$cleave" check "$work/space.yaml" -s "$ends" >"$work/solid" 2>&1
holds "check: why it is not led" grep -q '^cracks  *grow where bonds exceed their critical stretch.* not extended by the hoop stress, because the crack fronts are not parallel' "$work/solid"
holds "check: spacings" grep -q 'accuracy  *crack tip at (0.008, 0.01) m: there are only 8 spacings of crack behind it' "$work/out"
holds "check: cost" grep -q '^run time  *[0-9.e-]* to [0-9.e+]* s .* equilibria' "$work/out"
holds "check: no word of time steps and waves" sh -c "! grep -q 'time step\|wave' '$work/out'"
"$cleave" check $pulled -s 'probes=[]' -s 'boundary=[{traction: [0, "1 MPa*cos(t/s)"], face: y+}, {fixed: [x, y], face: y-}]' >"$work/out" 2>&1
holds "check: loads that are there at once" grep -q 'accuracy  *100 % of the largest loads act before' "$work/out"
holds "check: loads that fall" grep -q 'accuracy  *loads fall before' "$work/out"
"$cleave" check $pulled -s "$grips]" -s 'probes=[]' >"$work/out" 2>"$work/err"
is "check: nothing holds it: status" $? 1
holds "check: nothing holds it" grep -q 'nothing holds the body' "$work/err"

# ---- refusals and failures -----------------------------------------------------------------------------------------

no() { what=$1 text=$2; shift 2; refused "$what" "$work/no" "$text" $pulled "$@"; holds "$what: no folder" test ! -e "$work/no"; }
no "a control that is none" 'control' -s steps.control=crack
no "opening of nothing" 'steps.from and steps.to' -s steps.control=opening
refused "a front within the body" "$work/no" 'hoop (crack growth by the hoop stress) needs straight.*set steps.path: bonds or auto' "$work/space.yaml" -s "$ends" -s steps.path=hoop
no "friction" 'friction' -s contact.friction=0.3
no "a release in time under energy" 'only with steps.control: load' -s steps.then=explicit
no "no load" 'nothing loads the body' -s 'boundary=[{name: top, fixed: [x], face: y+}, {name: bottom, fixed: [x, y], face: y-}]'
no "waves" 'initial' -s 'initial=[{velocity: [1, 0]}]'
no "no load step" 'number' -s steps.number=0

stopped "nothing holds it" "$work/loose" 'load step 1, .*nothing holds the body .*, around x = 0.01, y = 0.01, z = 0 m.* hold it there' $pulled -s "$grips]" -s 'probes=[]'
# Loads on material points act on nodes of the mesh: the same pulled body by both methods that have such points.
for method in adaptive mpm; do
    stopped "nothing holds its points, $method" "$work/loose_$method" 'load step 1, .*nothing holds the body' $pulled -s "$grips]" -s 'probes=[]' \
        -s method=$method
done
is "nothing holds it: summary" "$(figure "$work/loose" status)" failed
holds "nothing holds it: a checkpoint" test -s "$work/loose/checkpoint.h5"

finish
