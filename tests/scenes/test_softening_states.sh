#!/bin/sh
# Softening bonds of ospd and mospd in whole runs: strength of a strip, energy balance, bitwise equality on any number of threads and
# after a checkpoint, energy dissipated by a crack, compression, adaptive runs, load steps, output of check, refusals.
# Takes 35 s: a strip runs until it breaks in each of these cases.
test_name=test_softening_states
. tests/support/summary.sh
. tests/support/scenes.sh
. tests/support/trust.sh

# The shipped strip with the glass's own Poisson's ratio.
sed 's/young: 70 GPa/young: 70 GPa, poisson: 0.22/; s|nu: 1/3|nu: 0.22|; s/^method: pd/&\nmodel: ospd/' inputs/strength_strip.yaml >"$work/strip.yaml"
start ospd "$work/strip.yaml"
start mospd "$work/strip.yaml" -s model=mospd; wait
start half "$work/strip.yaml" -s time.safety=0.25
start near "$work/strip.yaml" -s time.safety=0.9; wait
start pressed "$work/strip.yaml" -s variables.start='-1*strain' -s variables.rate='-4*strain/40 us' -s duration=40us; wait

# The largest mean stress across the grips is the strength, within 5 % (4.3 % low; bonds: 3.8 %).
strength() { awk -F, 'NR == 1 { for (k = 1; k <= NF; k++) if ($k ~ /reaction.force_y/) at = k } $at + 0 > most { most = $at }
    END { print most / 5e-6 / 40e6 }' "$work/$1/history.csv"; }
for run in ospd mospd; do between "$run: strength" "$(strength $run)" 0.95 1.04; done

# Energy closes to 3e-4 at half the critical step and with the square of the step; near it to 3e-3.
error() { figure "$work/$1" energy.balance_error; }
for run in ospd mospd; do
    echo "# $run: $(strength $run) $(error $run)" >&2
    between "$run: energy" "$(error $run)" -3e-4 3e-4
done
between "energy at half the step" "$(error half)" -7.5e-5 7.5e-5
between "energy near the critical step" "$(error near)" -3e-3 3e-3
between "it breaks" "$(last ospd fracture)" 1e-4 1

# Nothing softens under five times the strength in compression.
is "compression: dissipated" "$(last pressed fracture)" 0

# A crack that runs 9 mm through a strip between grips, which store about G_c: what it dissipates over its length, within 10 %.
cat >"$work/drive.yaml" <<'END'
name: drive
space: plane stress
thickness: 1.5 mm
duration: 15 us
method: pd
model: ospd
variables: {eps: 2.6e-4}
materials:
  - {name: glass, young: 70 GPa, poisson: 0.22, density: 2440 kg/m^3, energy_release_rate: 10 J/m^2, tensile_strength: 40 MPa}
  - {name: grip, young: 70 GPa, poisson: 0.22, density: 2440 kg/m^3}
body: {box: {from: [0, -2.4 mm], to: [12 mm, 2.4 mm]}}
parts:
  - {region: {box: {from: [0, 2 mm], to: [12 mm, 2.4 mm]}}, material: grip}
  - {region: {box: {from: [0, -2.4 mm], to: [12 mm, -2 mm]}}, material: grip}
cracks: [{from: [-1 mm, 0], to: [3.02 mm, 0]}]
particles: {spacing: 0.1 mm}
initial: [{displacement_gradient: [[0, 0], [0, eps]], centre: [0, 0]}]
boundary:
  - {name: top, velocity: [0, 0], region: {box: {from: [0, 2 mm], to: [12 mm, 2.4 mm]}}}
  - {name: bottom, velocity: [0, 0], region: {box: {from: [0, -2.4 mm], to: [12 mm, -2 mm]}}}
contact: {between: none}
output: {frames: 2, samples: 70}
END
start drive "$work/drive.yaml"
start drive_mospd "$work/drive.yaml" -s model=mospd -s variables.eps=2.7e-4; wait
for run in drive drive_mospd; do
    between "$run: it crosses the strip" "$(last $run crack_length)" 8.5e-3 9.1e-3
    between "$run: G/G_c" "$(compute "$(last $run fracture) / (10 * 1.5e-3 * $(last $run crack_length))")" 0.97 1.12
    echo "# $run: $(compute "$(last $run fracture) / (10 * 1.5e-3 * $(last $run crack_length))")" >&2
done

# Equal bits.
same() { if cmp "$work/$1/history.csv" "$work/$2/history.csv"; then pass; else fail "$1 and $2 differ"; fi; }
"$cleave" run "$work/drive.yaml" -o "$work/two" -t 2 -q 2>"$work/two.err" || fail "two: $(cat "$work/two.err")"
same drive two
part=$(compute "0.1 * $(figure "$work/two" wall_seconds)")
"$cleave" run "$work/drive.yaml" -o "$work/cut" -t 2 -q -s time.wall="$part" 2>/dev/null
is "cut" $? 130
"$cleave" run "$work/drive.yaml" -o "$work/cut" -t 1 -q --resume 2>"$work/cut.err" || fail "cut: $(cat "$work/cut.err")"
same drive cut

# Adaptive runs: the strength is that of the strip above within 5 % (bonds: 0.91 of the strength). Converting most of the body at once
# changes its energy, which later stays balanced as well as that of peridynamic runs.
start adaptive "$work/strip.yaml" -s method=adaptive
start adaptive_mospd "$work/strip.yaml" -s method=adaptive -s model=mospd; wait
for run in adaptive adaptive_mospd; do
    between "$run: strength" "$(strength $run)" 0.90 1.04
    between "$run: particles" "$(last $run particles_pd)" 100 5999
    between "$run: it breaks" "$(last $run fracture)" 1e-4 1
done
drift() { awk -F, 'NR == 1 { for (k = 1; k <= NF; k++) if ($k ~ /^balance_error/) at = k } NR > 1 && $1 > 1.7e-6 && !from { from = $at } END { print $at - from }' "$work/$1/history.csv"; }
between "adaptive: energy after the conversion" "$(drift adaptive)" -5e-3 5e-3

# Load steps of the notched strip, 1 mm long, in which bonds carry 9.66 MPa and a separate program of them has 9.85 MPa; within 5 %. The
# balance closes as that of bonds does: a family loses energy at the positions midway between two equilibria.
cp inputs/strength_notch.yaml "$work/notch.yaml"
glass="-s materials.0.poisson=0.22 -s materials.1.poisson=0.22 -s steps.number=9"
start steps_ospd "$work/notch.yaml" $glass -s model=ospd
start steps_mospd "$work/notch.yaml" $glass -s model=mospd; wait
load() { awk -F, 'NR == 1 { for (k = 1; k <= NF; k++) if ($k ~ /^load_time/) at = k } $at + 0 > most { most = $at } END { print 40 * most }' "$work/$1/history.csv"; }
for run in steps_ospd steps_mospd; do
    between "$run: load" "$(load $run)" 9.36 10.34
    between "$run: energy" "$(figure "$work/$run" energy.balance_error)" -2e-3 2e-3
    between "$run: dissipated energy over that of eight steps" "$(compute "$(last $run fracture) / 6e-7")" 0.97 1.01
done

"$cleave" check "$work/strip.yaml" --no-trial >"$work/said" 2>&1
holds "check: strength" grep -q 'strength  *glass: 4e+07 Pa in tension, .*(kappa 2.15, phi 1.05)' "$work/said"

bad() { what=$1 words=$2; shift 2; refused "$what" "$work/no" "$words" "$work/strip.yaml" "$@"; }
bad "a large horizon" "particles.spacing below 0.00019" -s particles.spacing=0.2mm
bad "points" 'needs bonds that can soften' -s method=mpm
bad "a surface" "a strength that depends on the stress state) needs model: bond" -s materials.0.compressive_strength=1GPa
bad "brittle beside softening" "breaks without softening" -s materials.1.energy_release_rate=10
finish
