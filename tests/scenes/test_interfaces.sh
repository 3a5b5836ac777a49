#!/bin/sh
# Joined bodies: a wave through two materials against its closed form, joined halves against the whole, a weak joint, the energy of broken
# joints, refusals.
test_name=test_interfaces
. tests/support/summary.sh
. tests/support/scenes.sh
. tests/support/trust.sh

# A pulse from steel into a material with a quarter of its impedance: 2 Z1/(Z1 + Z2) = 1.6 is transmitted, 0.6 reflected.
cat >"$work/layers.yaml" <<'END'
space: line
section: 1 mm^2
method: pd
duration: 14 us
materials:
  - {name: steel, young: 200 GPa, density: 8000}
  - {name: soft, young: 50 GPa, density: 2000}
bodies:
  - {name: left, material: steel, shape: {box: {from: [-100 mm], to: [0]}}}
  - {name: right, material: soft, shape: {box: {from: [0], to: [100 mm]}}}
interfaces: [{bodies: [left, right]}]
particles: {spacing: 0.25 mm}
initial: [{pulse: {at: [-30 mm], direction: [1], width: 40 mm, velocity: 1}}]
probes: [{point: {name: a, at: [-20.1 mm]}}, {point: {name: b, at: [20.1 mm]}}]
output: {frames: 1, samples: 400}
END
# A notched plate, intact, of two halves, and of two weakly joined halves, which separate at half the load.
cat >"$work/whole.yaml" <<'END'
space: plane stress
thickness: 1 mm
method: pd
duration: 40 us
material: {young: 72 GPa, density: 2440, energy_release_rate: 20}
body: {box: {from: [0, 0], to: [60 mm, 20 mm]}}
cracks: [{from: [-1 mm, 10 mm], to: [10 mm, 10 mm]}]
boundary:
  - {traction: [0, 8 MPa], face: y+}
  - {traction: [0, -8 MPa], face: y-}
particles: {spacing: 1 mm}
output: {frames: 1, samples: 40}
END
sed 's/^body:.*/bodies:\
  - {name: low, shape: {box: {from: [0, 0], to: [60 mm, 10 mm]}}}\
  - {name: high, shape: {box: {from: [0, 10 mm], to: [60 mm, 20 mm]}}}\
interfaces: [{bodies: [low, high]}]/' "$work/whole.yaml" >"$work/halves.yaml"
sed 's/^interfaces:.*/interfaces: [{bodies: [low, high], energy_release_rate: 2}]/; s/8 MPa/4 MPa/' "$work/halves.yaml" >"$work/glued.yaml"
sed 's/8 MPa/4 MPa/' "$work/whole.yaml" >"$work/strong.yaml"
# Two strips of unlike moduli that fly apart: their joint releases its own energy, or that of the weaker one, 8 J/m^2 of 6 mm by 2 mm.
cat >"$work/apart.yaml" <<'END'
space: plane stress
thickness: 2 mm
duration: 5 us
method: pd
materials: [{name: A, young: 70 GPa, density: 2500, energy_release_rate: 12}, {name: B, young: 7 GPa, density: 2500, energy_release_rate: 8}]
bodies:
  - {name: a, material: A, shape: {box: {from: [-3 mm, 0], to: [3 mm, 2 mm]}}, velocity: [0, 5 m/s]}
  - {name: b, material: B, shape: {box: {from: [-3 mm, -2 mm], to: [3 mm, 0]}}, velocity: [0, -5 m/s]}
interfaces: [{bodies: [a, b]}]
particles: {spacing: 0.25 mm}
contact: {between: none}
END
for model in bond ospd; do
    start apart_$model "$work/apart.yaml" -s model=$model
    start own_$model "$work/apart.yaml" -s model=$model -s materials.0.energy_release_rate= -s materials.1.energy_release_rate= \
        -s interfaces.0.energy_release_rate=8
done
wait
for scene in layers whole; do start $scene "$work/$scene.yaml"; done
wait
for scene in halves glued; do start $scene "$work/$scene.yaml"; done
wait
start strong "$work/strong.yaml"
start glued_again "$work/glued/scene.yaml"; start halves_again "$work/halves/scene.yaml"
wait

# most FOLDER COLUMN FROM: prints the largest value of a column from the time FROM on [s].
most() { awk -F, -v name="$2" -v from="$3" 'NR == 1 { for (k = 1; k <= NF; k++) { sub(/ .*/, "", $k); if ($k == name) at = k } }
    NR > 1 && $1 >= from + 0 && $at > most { most = $at } END { print most + 0 }' "$work/$1/history.csv"; }
between "layers: goes on" "$(most layers b.velocity_x 0)" 1.592 1.608
between "layers: comes back" "$(most layers a.velocity_x 8e-6)" 0.597 0.603
for figure in energy.strain energy.fracture crack.length_end; do        # up to round-off
    between "halves: $figure" "$(compute "$(f halves $figure) / $(f whole $figure)")" 0.999999 1.000001
done
between "glued: parts" "$(f glued fragments.count)" 2 2
is "glued: along the joint" "$(sed -n 2p "$work/glued/fragments.csv" | cut -d, -f2)" 600
between "strong: one part" "$(f strong fragments.count)" 1 1
for run in halves glued; do
    if cmp "$work/$run/history.csv" "$work/${run}_again/history.csv"; then pass; else fail "$run: scene.yaml is another scene"; fi
done

# Bonds near both ends of the joint are fewer: 3 % less than in an infinite plane.
for model in bond ospd; do
    between "unlike, $model: the weaker one's energy" "$(compute "$(f apart_$model energy.fracture) / (8 * 6e-3 * 2e-3)")" 0.93 1.02
    between "unlike, $model: the joint's own energy" "$(compute "$(f own_$model energy.fracture) / (8 * 6e-3 * 2e-3)")" 0.93 1.02
done

refused "no such body" "$work/no" "is not the name of a body with particles; check its spelling" "$work/halves.yaml" -s "interfaces=[{bodies: [low, middle]}]"
refused "a toughness of what is apart" "$work/no" "bodies that are not joined; remove it, or set joined: true" "$work/halves.yaml" \
    -s "interfaces=[{bodies: [low, high], joined: false, energy_release_rate: 1}]"
refused "a boundary of a joined body" "$work/no" "is joined to body low" "$work/halves.yaml" -s "boundary=[{fixed: all, body: high}]"
# Joined bodies that touch do not overlap, and each has the initial state of its own name; their bonds break at the interface.
cat >"$work/touching.yaml" <<'END'
space: plane stress
thickness: 2 mm
duration: 1 us
method: pd
material: {young: 70 GPa, density: 2500}
bodies:
  - {name: high, shape: {box: {from: [0, 0], to: [20 mm, 8 mm]}}}
  - {name: low, shape: {box: {from: [0, -8 mm], to: [20 mm, 0]}}}
interfaces: [{bodies: [high, low], energy_release_rate: 8 J/m^2}]
initial: [{body: low, velocity: [0, -0.1 m/s]}]
particles: {spacing: 1 mm}
END
"$cleave" check "$work/touching.yaml" --no-trial >"$work/said" 2>&1
holds "no overlap, no state without particles" sh -c "! grep -q 'overlap\|in its region\|never break' '$work/said'"
holds "what breaks" grep -q '^interface  *high and low: bonds break at a stretch of .* (energy release rate 8 J/m^2)$' "$work/said"
"$cleave" check "$work/touching.yaml" --no-trial -s 'initial.0.region={box: {from: [30 mm, 0], to: [40 mm, 1 mm]}}' >"$work/said" 2>&1
holds "a region beside a joined body" grep -q 'initial.0.: no particle is in its region' "$work/said"
finish
