#!/bin/sh
# Columns of history.csv and figures of summary.json hold what their names say: in runs each of which has one kind of energy
# and not the others, with sums over the bodies worked out here.
test_name=test_history
. tests/support/summary.sh

# most FOLDER COLUMN, least FOLDER COLUMN: of all samples.
most() { awk -F, -v name="$2" 'NR == 1 { for (k = 1; k <= NF; k++) { sub(/ \[.*/, "", $k); if ($k == name) at = k } next }
    NR == 2 || $at + 0 > m { m = $at + 0 } END { print m }' "$1/history.csv"; }
least() { awk -F, -v name="$2" 'NR == 1 { for (k = 1; k <= NF; k++) { sub(/ \[.*/, "", $k); if ($k == name) at = k } next }
    NR == 2 || $at + 0 < m { m = $at + 0 } END { print m }' "$1/history.csv"; }
# none FOLDER COLUMN...: these are 0 throughout.
none() { folder=$1; shift; for name in "$@"; do is "$folder: $name" "$(least "$folder" "$name") $(most "$folder" "$name")" "0 0"; done; }

# Two blocks that meet and rub: 10 x 4 particles of 1180 kg/m^3 x 0.37 m x 1 mm^2 at (5, -2) m/s on a block at rest.
cat >"$work/rub.yaml" <<'END'
space: plane strain
thickness: 0.37 m
duration: 30 us
method: pd
material: {young: 3 GPa, poisson: 1/4, density: 1180}
bodies:
  - {name: low, shape: {box: {from: [0, 0], to: [20 mm, 5 mm]}}}
  - {name: high, velocity: [5 m/s, -2 m/s], shape: {box: {from: [4 mm, 5.01 mm], to: [14 mm, 9.01 mm]}}}
particles: {spacing: 1 mm}
contact: {between: bodies, friction: 0.3}
output: {samples: 30, frames: 0}
END
holds "run" "$cleave" run "$work/rub.yaml" -t 1 -o "$work/rub" >"$work/said" 2>&1
mass=$(compute "40 * 1180 * 0.37e-6")
near "momentum along x" "$(column "$work/rub" momentum_x 0)" "$(compute "$mass * 5")" 1e-6
near "momentum along y" "$(column "$work/rub" momentum_y 0)" "$(compute "$mass * -2")" 1e-6
near "kinetic energy" "$(column "$work/rub" kinetic 0)" "$(compute "0.5 * $mass * 29")" 1e-6
between "energy of contact" "$(most "$work/rub" contact)" "$(compute "0.001 * $mass * 2")" "$(compute "0.5 * $mass * 4")"
between "energy of friction" "$(most "$work/rub" damped)" "$(compute "0.001 * $mass * 29")" "$(compute "0.5 * $mass * 29")"
near "friction's work" "$(figure "$work/rub" contact.friction_work)" "$(column "$work/rub" damped 1)" 1e-6
between "overlap [spacings]" "$(figure "$work/rub" contact.overlap_max)" 1e-3 0.5
none "$work/rub" absorbed plastic fracture external_work mpm_share
is "all particles are peridynamic" "$(least "$work/rub" particles_pd) $(least "$work/rub" pd_share)" "140 1"
between "balance" "$(column "$work/rub" balance_error 1)" -0.01 0.01

# A bar of points that flies against an absorbing face, which takes rho c (v/2)^2 A t: half of the energy in a transit.
cat >"$work/ring.yaml" <<'END'
space: line
section: 0.37 m^2
duration: 4 ms
method: mpm
material: {young: 2.3e4, density: 2.3}
body: {box: {from: [0], to: [0.4]}}
particles: {spacing: 10 mm}
initial: [{velocity: [1 mm/s]}]
boundary: [{absorbing: true, face: x+}]
output: {samples: 20, frames: 0}
END
holds "run" "$cleave" run "$work/ring.yaml" -t 1 -o "$work/ring" >"$work/said" 2>&1
energy=$(compute "0.5 * 0.4 * 0.37 * 2.3 * 1e-6")
near "energy at the start" "$(column "$work/ring" kinetic 0)" "$energy" 1e-6
between "absorbed energy" "$(column "$work/ring" absorbed 1)" "$(compute "0.48 * $energy")" "$(compute "0.52 * $energy")"
none "$work/ring" contact damped plastic fracture external_work particles_pd pd_share bonds
is "share of points" "$(least "$work/ring" mpm_share)" 1

# A quarter of a plate is peridynamic; bulk damping takes exp(-2 c t) of its energy.
cat >"$work/part.yaml" <<'END'
space: plane stress
thickness: 0.37 m
duration: 1 ms
method: adaptive
damping: 300 1/s
material: {young: 3 GPa, poisson: 1/3, density: 1180}
body: {box: {from: [0, 0], to: [24 mm, 16 mm]}}
particles: {spacing: 1 mm}
pd: {region: {box: {from: [0, 0], to: [6 mm, inf]}}}
initial: [{velocity: [3 m/s, 1 m/s]}]
output: {samples: 10, frames: 0}
END
holds "run" "$cleave" run "$work/part.yaml" -t 1 -o "$work/part" >"$work/said" 2>&1
energy=$(compute "0.5 * 384 * 1180 * 0.37e-6 * 10")
near "damped energy" "$(column "$work/part" damped 1)" "$(compute "$energy * (1 - exp(-0.6))")" 1e-3
is "peridynamic particles" "$(most "$work/part" particles_pd)" 96
near "their share" "$(most "$work/part" pd_share)" 0.25 1e-9
near "that of points" "$(least "$work/part" mpm_share)" 0.75 1e-9
none "$work/part" contact absorbed plastic fracture external_work
finish
