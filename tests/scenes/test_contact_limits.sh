#!/bin/sh
# Contact in extreme cases: light and heavy rigid bodies, gravity, interfaces, bodies in two pieces, compressed bonds; refusals, warnings,
# stops.
test_name=test_contact_limits
. tests/support/summary.sh
. tests/support/scenes.sh
. tests/support/trust.sh
. tests/support/claims.sh

cat >"$work/plate.yaml" <<'E'
space: plane stress
thickness: 1 mm
duration: 60 us
method: pd
material: {name: steel, young: 200 GPa, poisson: 1/3, density: 8000 kg/m^3}
particles: {spacing: 1 mm}
bodies:
  - {name: a, shape: {box: {from: [0, 0], to: [20 mm, 10 mm]}}, velocity: [0, 10 m/s]}
  - {name: p, rigid: true, mass: 0.1 g, shape: {box: {from: [-5 mm, 10.5 mm], to: [25 mm, 12 mm]}}}
output: {frames: 2, samples: 100}
E
bodies() { echo "bodies=[{name: a, shape: {box: {from: [0, 0], to: [20 mm, 10 mm]}}}, $1]"; }
alone="bodies=[{name: a, shape: {box: {from: [0, 0], to: [20 mm, 10 mm]}}}]"

# ---- rigid bodies ------------------------------------------------------------------------------------------------------

# A lighter body oscillates faster in contact: its mass counts in the time step. Otherwise 0.02 g would gain 10 % of energy, 1 mg 78 %; the
# gain at the ends of contact is below 0.4 %.
for mass in 0.1 0.02 0.001; do
    calm "$work/light" "$work/plate.yaml" --overwrite -s bodies.1.mass="$mass g"
    most=$(awk -F, 'NR > 1 && $8 > most { most = $8 } END { print most + 0 }' "$work/light/history.csv")
    between "a body of $mass g: no energy from nowhere" "$most" 0 4e-3
    between "a body of $mass g: momentum" "$(figure "$work/light" momentum_error)" 0 1e-12
done

# A weight falls by F t^2/(2 m), exactly in the leap-frog scheme; 1/2 m v- . v+ is smaller than 1/2 m v^2 by a fraction dt^2/(4 t^2),
# 1.3e-6.
calm "$work/fall" "$work/plate.yaml" \
    -s "$(bodies '{name: p, rigid: true, mass: 2 g, force: [0, 400 N], shape: {box: {from: [0, 30 mm], to: [9 mm, 40 mm]}}}')"
between "a weight falls" "$(compute "($(last fall p_y) - 0.035) / (0.5 * 400 / 2e-3 * 60e-6 * 60e-6)")" 0.999999 1.000001
between "a weight: energy" "$(figure "$work/fall" energy.balance_error)" -2e-6 2e-6
# A weight rests on a fixed block: the mean contact force over some periods is the weight.
calm "$work/rest" "$work/plate.yaml" -s duration=600us \
    -s "boundary=[{fixed: all, region: {box: {from: [0, 0], to: [20 mm, 3 mm]}}}]" \
    -s "$(bodies '{name: p, rigid: true, mass: 0.1 g, force: [0, -400 N], shape: {box: {from: [-5 mm, 10 mm], to: [25 mm, 12 mm]}}}')"
mean=$(awk -F, 'NR == 1 { for (k = 1; k <= NF; k++) { sub(/ .*/, "", $k); if ($k == "p_force_y") at = k } }
    NR > 1 { sum += $at; n++ } END { print sum / n }' "$work/rest/history.csv")
between "a weight rests" "$mean" 380 420

warned "rigid bodies do not meet" "$work/through" "push particles but not each other" "$work/plate.yaml" \
    -s "$(bodies '{name: p, rigid: true, mass: 1 g, velocity: [100 m/s, 0], shape: {box: {from: [30 mm, 0], to: [35 mm, 9 mm]}}}, {name: q, rigid: true, shape: {box: {from: [36 mm, 0], to: [40 mm, 9 mm]}}}')"
stopped "a blade that outruns contact" "$work/blade" "spacings per step" "$work/plate.yaml" \
    -s "$(bodies '{name: p, rigid: true, velocity: [0, -3e4 m/s], shape: {box: {from: [0, 11 mm], to: [20 mm, 11.6 mm]}}}')"
refused "a rigid body inside another" "$work/no" "overlaps body a" "$work/plate.yaml" \
    -s "$(bodies '{name: p, rigid: true, shape: {box: {from: [15 mm, 0], to: [25 mm, 5 mm]}}}')"
refused "a mirror and a body that flies" "$work/no" "mirrors do not act on such bodies" "$work/plate.yaml" -s "boundary=[{mirror: {axis: y, at: 0}}]" \
    -s "$(bodies '{name: p, rigid: true, mass: 1 g, shape: {ball: {centre: [30 mm, 0], radius: 5 mm}}}')"
refused "a ramp of a body that flies" "$work/no" "is for a rigid body with a prescribed velocity" "$work/plate.yaml" -s bodies.1.ramp=1us
refused "a force without a mass" "$work/no" "has no effect on a rigid body without a mass" "$work/plate.yaml" \
    -s "$(bodies '{name: p, rigid: true, force: [0, 1 N], shape: {box: {from: [30 mm, 0], to: [35 mm, 9 mm]}}}')"
refused "a load of a rigid body" "$work/no" "p is rigid" "$work/plate.yaml" -s "boundary=[{body_force: [0, -1e9], body: p}]"
refused "friction of nothing" "$work/no" "so friction has no effect" "$work/plate.yaml" -s "$alone" -s contact.between=none -s contact.friction=0.3
refused "contact without time" "$work/no" "has no contact" "$work/plate.yaml" -s "$alone" -s contact.between=all -s solver=cg
says=$("$cleave" check "$work/plate.yaml" -t 1 2>&1)
case $says in *"a with itself"*"rigid p;"*"near a face"*) pass ;; *) fail "check does not say who meets: $says" ;; esac

# ---- scenes of inputs/ -------------------------------------------------------------------------------------------------

start slide slope
start bounce hertz_3d
start squeezed hertz_2d
wait
claimed slide "cleave run inputs/slope.yaml"
claimed bounce "cleave run inputs/hertz_3d.yaml"
claimed squeezed "cleave run inputs/hertz_2d.yaml"
between "slope: momentum, over m g (sin - mu cos) t" "$(compute "$(f slide probes.block.x) / 0.03932")" 0.95 1.05
between "slope: what the floor bears" "$(awk -F, 'NR == 1 { for (k = 1; k <= NF; k++) { sub(/ .*/, "", $k); if ($k == "floor_force_y") at = k } }
    $1 > 3e-4 { sum -= $at; n++ } END { print sum / n }' "$work/slide/history.csv")" 181 213
# Half of the contact patch minus sqrt(4 F R/(pi t E)), over the spacing.
force=$(last squeezed lower_force_y)
between "a disc between planes: half width" "$(awk -v f="$force" -v w="$(f squeezed rigid.0.patch)" 'BEGIN { f = f < 0 ? -f : f
    print (w / 2 - sqrt(4 * f * 20e-3 / (3.14159265 * 1e-3 * 200e9))) / 0.5e-3 }')" -1 1
between "a disc between planes: the force" "$(compute "-($force) / 1000")" 40 100
between "a ball on a plane: contact" "$(compute "$(f bounce contact.ended) - $(f bounce contact.began)")" 24e-6 28e-6
between "a ball on a plane: force" "$(f bounce rigid.0.force_max)" 2.2e5 2.7e5
between "a ball on a plane: it leaves" "$(f bounce probes.ball.z)" 1.59 1.70
for run in slide bounce squeezed; do between "$run: momentum" "$(f $run momentum_error)" 0 1e-12; done

# ---- interfaces --------------------------------------------------------------------------------------------------------

pair() { echo "bodies=[{name: a, velocity: [20 m/s, 0], shape: {box: {from: [0, 0], to: [10 mm, 10 mm]}}}, {name: b, shape: {box: {from: [$1 mm, 0], to: [20 mm, 10 mm]}}}]"; }
calm "$work/apart" "$work/plate.yaml" -s "$(pair 10)"
calm "$work/said" "$work/plate.yaml" -s "$(pair 10)" -s "interfaces=[{bodies: [a, b], joined: false}]"
if cmp "$work/apart/history.csv" "$work/said/history.csv"; then pass; else fail "joined: false is not contact alone"; fi
between "they meet" "$(figure "$work/said" contact.pairs_max)" 5 1000
refused "joined bodies that are apart" "$work/no" "farther apart than the horizon" "$work/plate.yaml" -s "$(pair 14)" \
    -s "interfaces=[{bodies: [a, b]}]"
refused "two interfaces of two bodies" "$work/no" "have an interface already" "$work/plate.yaml" -s "$(pair 10)" \
    -s "interfaces=[{bodies: [a, b]}, {bodies: [b, a], joined: false}]"
refused "a rigid body that is joined" "$work/no" "is rigid" "$work/plate.yaml" -s "interfaces=[{bodies: [a, p]}]"
# Joined bodies have contact faces too: one arm hits the other, beyond the horizon.
calm "$work/arms" "$work/plate.yaml" -s duration=100us -s "boundary=[{fixed: all, region: {box: {from: [0, 0], to: [24 mm, 4 mm]}}}]" \
    -s "interfaces=[{bodies: [a, b]}, {bodies: [b, c]}]" \
    -s "bodies=[{name: a, shape: {box: {from: [0, 0], to: [20 mm, 4 mm]}}}, {name: b, shape: {box: {from: [20 mm, 0], to: [24 mm, 10 mm]}}}, {name: c, velocity: [0, -200 m/s], shape: {box: {from: [0, 8 mm], to: [20 mm, 10 mm]}}}]"
between "arms of a joined body meet" "$(figure "$work/arms" contact.pairs_max)" 1 1000

# ---- one body in two pieces --------------------------------------------------------------------------------------------

# Pieces of one body have no contact by default and fly through each other; the run says so once they have, check at the start. With
# contact of all particles they exchange momentum.
two="body=[{box: {from: [0, 0], to: [8 mm, 10 mm]}}, {box: {from: [12 mm, 0], to: [20 mm, 10 mm]}}]"
fly="initial=[{region: {box: {from: [0, 0], to: [8 mm, 10 mm]}}, velocity: [40 m/s, 0]}]"
warned "pieces of one body" "$work/pieces_pd" "parts of body body pass through each other: .* set contact.between: all" "$work/plate.yaml" \
    -s bodies= -s "$two" -s "$fly" -s duration=150us
for key in contact.between=all 'accept=[contact]' duration=20us; do
    calm "$work/pieces" "$work/plate.yaml" --overwrite -s bodies= -s "$two" -s "$fly" -s duration=150us -s "$key"
    if grep -q 'pass through' "$work/err"; then fail "pieces with $key pass"; else pass; fi
done
says=$("$cleave" check "$work/plate.yaml" -s bodies= -s "$two" -s "$fly" 2>&1)
case $says in *"parts that touch pass through each other; set contact.between: all"*) pass ;; *) fail "check does not say that pieces pass: $says" ;; esac

# ---- compressed bonds --------------------------------------------------------------------------------------------------

# A bar without breaking bonds is compressed to half its length at 0.8 of the critical step: the repulsion within bonds is stable.
cat >"$work/press.yaml" <<'E'
space: line
section: 1 mm^2
duration: 500 us
method: pd
material: {young: 200 GPa, density: 8000}
particles: {spacing: 1 mm}
body: {box: {from: [0], to: [30 mm]}}
boundary:
  - {fixed: all, region: {box: {from: [0], to: [3 mm]}}}
  - {velocity: [-30 m/s], region: {box: {from: [27 mm], to: [30 mm]}}, time: {ramp: {until: 50 us}}}
E
calm "$work/press" "$work/press.yaml"
between "a bar at half its length" "$(figure "$work/press" energy.balance_error)" -1e-3 1e-3
stopped "a bar at nothing" "$work/nothing" "bonds are compressed" "$work/press.yaml" -s duration=1ms

finish
