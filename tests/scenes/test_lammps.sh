#!/bin/sh
# Compares `cleave export lammps` with LAMMPS itself, particle by particle: after 200 steps positions may differ by at most 1e-9 of the
# largest displacement, and the same bonds must be broken. Bond-based and state-based models in plane stress, plane strain and 3D; cracks
# in any direction; driven and displaced regions, tractions, body forces and their functions of time; initial velocities and
# displacements; two MPI ranks. Skipped if LAMMPS is missing.
test_name=lammps
. tests/support/summary.sh
command -v lmp >/dev/null || { echo "test_lammps: lmp (LAMMPS with its package PERI) is missing"; exit 77; }
lmp -h | grep -q "peri/pmb" || { echo "test_lammps: this lmp was built without its package PERI"; exit 77; }
cd "$work"

# plate NAME MODEL-AND-MATERIAL PD CONTACT: writes a plate with an inclined crack and all kinds of loads.
plate()
{
    cat >$1.yaml <<END
space: $2
thickness: 1 mm
duration: 9 us
method: adaptive
$3
body: {box: {from: [-5 mm, -5 mm], to: [5 mm, 5 mm]}}
particles: {spacing: 0.5 mm, horizon: 3.015}
$4
time: {step: 4e-8}
cracks: [{from: [-2.1 mm, -1.3 mm], to: [2.7 mm, 1.6 mm]}]
initial:
  - velocity_gradient: [[-20, 10], [5, 40]]
  - {displacement_gradient: [[1e-4, 0], [2e-5, 1e-4]], region: {box: {from: [-5 mm, 0], to: [5 mm, 5 mm]}}}
boundary:
  - {velocity: [free, 30 m/s], region: {box: {from: [-5 mm, 4 mm], to: [5 mm, 5 mm]}}, time: {ramp: {from: 0, until: 2.03 us}}}
  - {fixed: [x, y], region: {box: {from: [-5 mm, -5 mm], to: [5 mm, -4 mm]}}}
  - {traction: [3 MPa, 20 MPa], face: x+, time: {pulse: {from: 0.5 us, until: 4 us}}}
  - {body_force: [1e9, 2e9], time: {table: [[0, 0], [1 us, 1], [3 us, -0.5]]}}
output: {frames: 3, samples: 1}
END
}
# agrees NAME RANKS [OPTION...]: exports NAME.yaml with the options, runs LAMMPS on RANKS ranks and compares the results.
agrees()
{
    name=$1 ranks=$2; shift 2
    rm -rf there
    "$cleave" export lammps "$name.yaml" -o there "$@" >log 2>&1 || { fail "$name: $(cat log)"; return; }
    if [ "$ranks" = 1 ]; then (cd there && lmp -in in.lammps -log none -screen none >/dev/null 2>&1) || fail "$name: lmp failed"
    else (cd there && mpirun --allow-run-as-root --oversubscribe -np "$ranks" lmp -in in.lammps -log none -screen none >log 2>&1) ||
        fail "$name: lmp failed on $ranks ranks"; fi
    "$cleave" compare there there >compared 2>&1 || fail "$name: $(cat compared)"
    apart=$(sed -n 's/^ *max |u - u_LAMMPS.*|u| *\([0-9.e+-]*\).*/\1/p' compared | head -n 1)
    between "$name, $ranks: displacements apart" "$apart" 0 1e-9
    is "$name, $ranks: particles whose broken bonds differ" "$(sed -n 's/^ *particles whose broken bonds differ \([0-9]*\) of.*/\1/p' compared | head -n 1)" 0
    tested=$(cd there && sed -n 's/^# awk/awk/p' in.lammps | sh)
    between "$name: the test in the script" "${tested% *}" 0 1e-9
}
broken() { awk -F, '{ sum += $8 } END { printf "%g", sum }' there/check.csv; }

bonds="material: {young: 192 GPa, density: 8000, critical_stretch: 0.004}"
exact="pd: {volume: cut-ramp, surface: none, weights: uniform, last_force: whole}
contact: {law: pair, distance: lammps}"
families="model: ospd
material: {young: 192 GPa, poisson: 0.4, density: 8000, critical_stretch: inf}"
local="pd: {volume: whole, surface: none, weights: uniform, normalisation: local}
contact: {between: none}"

plate bonds "plane stress" "$bonds" "$exact"
agrees bonds 1
between "bonds: damage by then" "$(broken)" 10 1000

# To the end, over frames: fragments move and collide. Frames are in single precision.
"$cleave" run there/scene.yaml -o here -q || fail "the exported scene does not run"
"$cleave" compare here there >compared || fail "compare: $(cat compared)"
between "displacement at the end [m]" "$(sed -n 's/^  displacement \[m\] *\([0-9.e+-]*\).*/\1/p' compared)" 0 1e-9
is "frames at the same steps" "$(sed -n 's/^last common frame.*step \([0-9]*\), \([0-9]*\);.*/\1 \2/p' compared)" "225 225"
holds "velocities are half a step apart" grep -q "^velocities of A are taken half a step before" compared
is "particle by particle" "$(tail -n 1 compared)" "comparable particle by particle: yes"

if command -v mpirun >/dev/null; then agrees bonds 2; fi
plate families "plane strain" "$families" "$local"
agrees families 1

cat >block.yaml <<END
space: solid
duration: 4 us
method: pd
material: {young: 72 GPa, density: 2440, critical_stretch: 0.003}
body: {box: {from: [-2.5 mm, -2.5 mm, -2 mm], to: [2.5 mm, 2.5 mm, 2 mm]}}
particles: {spacing: 0.5 mm, horizon: 3.015}
$exact
time: {step: 2e-8}
cracks: [{polygon: [[-4 mm, 0.03 mm, -4 mm], [0.1 mm, 0.03 mm, -4 mm], [0.3 mm, 0.03 mm, 4 mm], [-4 mm, 0.03 mm, 4 mm]]}]
boundary:
  - {velocity: [free, 15 m/s, 0], region: {box: {from: [-4 mm, 1.6 mm, -4 mm], to: [4 mm, 4 mm, 4 mm]}}}
  - {displacement: [0, -60 um, free], region: {box: {from: [-4 mm, -4 mm, -4 mm], to: [4 mm, -1.6 mm, 4 mm]}}, time: {ramp: {until: 4 us}}}
  - {traction: [3 MPa, 0, -2 MPa], face: x+}
END
agrees block 1
between "block: damage by then" "$(broken)" 10 1000
sed "s/critical_stretch: 0.003/poisson: 0.3, critical_stretch: inf/; s/^method: pd/method: pd\nmodel: ospd/
    s/^pd: .*/pd: {volume: whole, surface: none, weights: uniform, normalisation: local}/; s/^contact: .*/contact: {between: none}/" block.yaml >block-families.yaml
agrees block-families 1

# Irregular particles, two joined materials, rules that differ from LAMMPS': replaced with --allow-different, then equal.
cat >joined.yaml <<END
space: plane stress
thickness: 1 mm
duration: 8 us
method: pd
materials:
  - {name: steel, young: 192 GPa, density: 8000, critical_stretch: 0.004}
  - {name: glass, young: 72 GPa, density: 2440, critical_stretch: 0.004}
bodies:
  - {name: a, material: steel, shape: {box: {from: [-5 mm, -5 mm], to: [0, 5 mm]}}}
  - {name: b, material: glass, shape: {box: {from: [0, -5 mm], to: [5 mm, 5 mm]}}}
interfaces: [{bodies: [a, b]}]
particles: {spacing: 0.5 mm, horizon: 3.015, irregularity: 0.2}
time: {step: 4e-8}
cracks: [{from: [-2.1 mm, -1.3 mm], to: [2.7 mm, 1.6 mm]}]
initial: [{velocity_gradient: [[300, 100], [200, 900]]}]
END
agrees joined 1 --allow-different
holds "what differs is said" grep -q "^pd.last_force: whole" there/README.txt

# A folder that holds an export is not overwritten.
"$cleave" export lammps bonds.yaml -o there 2>log; is "an older export: status" $? 2
cd "$root"
finish
