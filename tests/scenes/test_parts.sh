#!/bin/sh
# Bodies whose regions have different materials: waves at an interface, laminates in series and parallel, order of conversion, a list of
# two materials.
test_name=test_parts
. tests/support/summary.sh
. tests/support/scenes.sh
. tests/support/trust.sh

# A pulse from steel into a material with a quarter of its impedance: 2 Z1/(Z1 + Z2) = 1.6 is transmitted, 0.6 reflected. The interface
# divides a cell.
cat >"$work/layers.yaml" <<'END'
space: line
section: 1 mm^2
duration: 14 us
materials:
  - {name: steel, young: 200 GPa, density: 8000}
  - {name: soft, young: 50 GPa, density: 2000}
body: {box: {from: [-100 mm], to: [100 mm]}}
parts: [{region: {box: {from: [0.25 mm], to: [100 mm]}}, material: soft}]
particles: {spacing: 0.25 mm}
initial: [{pulse: {at: [-30 mm], direction: [1], width: 40 mm, velocity: 1}}]
probes: [{point: {name: a, at: [-20.1 mm]}}, {point: {name: b, at: [20.1 mm]}}]
output: {frames: 1, samples: 400}
END
# A stack under tension, in series; a laminate loaded along its layers, in parallel.
cat >"$work/series.yaml" <<'END'
space: line
duration: 1 ms
method: pd
solver: cg
materials:
  - {name: hard, young: 100 GPa, density: 7800}
  - {name: soft, young: 25 GPa, density: 1200}
body: {box: {from: [0], to: [80 mm]}}
parts:
  - {region: {box: {from: [20 mm], to: [40 mm]}}, material: soft}
  - {region: {box: {from: [60 mm], to: [80 mm]}}, material: soft}
particles: {spacing: 1 mm}
boundary: [{mirror: {axis: x, at: 0}}, {traction: 1 MPa, face: x+}]
probes: [{point: {name: a, at: [4.5 mm]}}, {point: {name: b, at: [74.5 mm]}}]
output: {frames: 1, samples: 1}
END
cat >"$work/parallel.yaml" <<'END'
space: plane stress
thickness: 1 mm
duration: 1 ms
method: pd
solver: cg
materials:
  - {name: hard, young: 100 GPa, density: 7800}
  - {name: soft, young: 25 GPa, density: 1200}
body: {box: {from: [0, 0], to: [20 mm, 20 mm]}}
parts: [{region: {box: {from: [0, 10 mm], to: [20 mm, 20 mm]}}, material: soft}]
particles: {spacing: 1 mm}
boundary:
  - {mirror: {axis: x, at: 0}}
  - {mirror: {axis: y, at: 0}}
  - {region: {box: {from: [18 mm, -inf], to: [inf, inf]}}, velocity: [20 mm/s, free]}
output: {frames: 1, samples: 1}
END
# Two halves of equal modulus, of which the left one is ten times as strong: the right one becomes peridynamic and breaks.
cat >"$work/weak.yaml" <<'END'
space: line
section: 1 mm^2
duration: 40 us
materials:
  - {name: strong, young: 100 GPa, density: 1000, critical_stretch: 1e-2}
  - {name: weak, young: 100 GPa, density: 1000, critical_stretch: 1e-3}
bodies:
  - name: bar
    material: strong
    shape: {box: {from: [-100 mm], to: [100 mm]}}
    parts: [{region: {box: {from: [0], to: [100 mm]}}, material: weak}]
particles: {spacing: 1 mm}
boundary: [{traction: 130 MPa, face: x+, time: {ramp: {until: 20 us}}}, {traction: -130 MPa, face: x-, time: {ramp: {until: 20 us}}}]
probes: [break]
output: {frames: 2, samples: 10}
END
for method in pd mpm adaptive; do start $method "$work/layers.yaml" -s method=$method; [ $method = mpm ] && wait; done
start both "$work/layers.yaml" -s method=adaptive -s 'pd.region={box: {from: [-10 mm], to: [10 mm]}}'; wait
start series "$work/series.yaml"
start series_all "$work/series.yaml" -s 'parts=[{region: {all: true}, material: soft}]'; wait
for model in bond ospd; do
    start parallel_$model "$work/parallel.yaml" -s model=$model
    start parallel_all_$model "$work/parallel.yaml" -s model=$model -s 'parts=[{region: {all: true}, material: soft}]'; wait
done
start weak "$work/weak.yaml"; wait
start weak_again "$work/weak/scene.yaml"; wait

# most FOLDER COLUMN FROM: prints the largest value of a column from the time FROM on [s].
most() { awk -F, -v name="$2" -v from="$3" 'NR == 1 { for (k = 1; k <= NF; k++) { sub(/ .*/, "", $k); if ($k == name) at = k } }
    NR > 1 && $1 >= from + 0 && $at > most { most = $at } END { print most + 0 }' "$work/$1/history.csv"; }
for run in pd mpm adaptive both; do      # 0.5 %: dispersion over 160 spacings
    between "$run: goes on" "$(most $run b.velocity_x 0)" 1.592 1.608
    between "$run: comes back" "$(most $run a.velocity_x 8e-6)" 0.597 0.603
done

# Reuss: the end moves by the sum of t_k sigma/E_k; for one material by L sigma/E. At each of three interfaces bonds are springs in series
# with equal parts, instead of the parts in each layer: 0.6 % too stiff with 20 spacings per layer.
end() { compute "$(last $1 b.displacement_x) - $(last $1 a.displacement_x)"; }
between "series" "$(compute "$(end series) / (1e6 * (0.0155/1e11 + 0.02/25e9 + 0.02/1e11 + 0.0145/25e9))")" 0.99 1.0001
between "series: one material" "$(compute "$(end series_all) / (1e6 * 0.07 / 25e9)")" 0.9999 1.0001

# Voigt: half of each modulus; materials with equal Poisson's ratios contract equally. Bonds across the interface, in series, are softer
# than both materials in parallel, 1.1 % with ten spacings per layer; families of ospd are not.
voigt() { compute "$(f parallel_$1 energy.strain) / (2.5 * $(f parallel_all_$1 energy.strain))"; }
between "parallel: bonds" "$(voigt bond)" 0.98 1
between "parallel: families" "$(voigt ospd)" 0.998 1.002

between "weak: where it parts" "$(f weak probes.break.x)" 0 0.1
between "weak: peridynamic" "$(f weak conversion.x)" 0 0.1
sound weak 0.05
if cmp "$work/weak/history.csv" "$work/weak_again/history.csv"; then pass; else fail "weak: scene.yaml is another scene"; fi

# A list of two materials by name, as written by another program: the body's material is not required, ignored columns are reported, and a
# checkpoint continues to the same result.
awk 'BEGIN { print "id; x [mm]; y [mm]; z; vx [m/s]; weight [g]; material"
    for (j = 0; j < 8; j++) for (i = 0; i < 20; i++) printf "%d; %g; %g; 0; %g; 2.5e-3; %s\n", 20 * j + i, i, j, i < 10 ? 1 : -1, i < 10 ? "left" : "right" }' \
    >"$work/grains.csv"
cat >"$work/list.yaml" <<'END'
space: plane stress
thickness: 1 mm
duration: 20 us
method: pd
materials:
  - {name: right, young: 70 GPa, density: 2700}
  - {name: left, young: 140 GPa, density: 2700}
bodies: [{name: grains, particles: grains.csv}]
particles: {spacing: 1 mm}
output: {frames: 1, samples: 10, checkpoint: 0}
END
"$cleave" run "$work/list.yaml" -o "$work/list" -t 1 -q 2>"$work/list.err" || fail "list: $(cat "$work/list.err")"
is "list: lines" "$(grep -c "id, z not read; no volumes" "$work/list.err")" 1
between "list: kinetic energy" "$(awk -F, 'NR == 2 { print $3 }' "$work/list/history.csv")" 1.99999e-4 2.00001e-4    # 160 x 2.5 mg x 1/2
start list_again "$work/list/scene.yaml"; wait
if cmp "$work/list/history.csv" "$work/list_again/history.csv"; then pass; else fail "list: scene.yaml is another scene"; fi
sound list 0.005

refused "two materials, no parts" "$work/no" "use parts, or the key bodies" "$work/layers.yaml" -s parts=
refused "an unknown material" "$work/no" "there is no material wood" "$work/layers.yaml" -s parts.0.material=wood
refused "a part of nowhere" "$work/no" "region: missing" "$work/layers.yaml" -s parts.0.region=
finish
