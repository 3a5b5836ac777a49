#!/bin/sh
# Yielding bodies of material points: waves compared with closed forms, energy balance, threads and restart.
test_name=test_plastic
. tests/support/summary.sh
. tests/support/scenes.sh
. tests/support/physics.sh
. tests/support/trust.sh

# ---- a bar loaded beyond its yield stress --------------------------------------------------------------------------

# A pressure of 1 Pa from t = 0: the elastic precursor has sigma_y = 0.5 Pa and travels at c = sqrt(E/rho) = 100 m/s, the plastic front at
# sqrt(E_t/rho) = 70.7 m/s. After 0.75 L/c they are at x = 0.25 and 1 - 0.75/sqrt(2) = 0.470; strains 0.5/E and 0.5/E + 0.5/E_t (Zeng et
# al., CPM 2021, section 5.1).
scene bar <<'END_OF_SCENE'
space: line
section: 1 m^2
duration: 7.5 ms
method: mpm
material: {young: 1e4, density: 1, yield_stress: 0.5, yield_tangent: 5000}
body: {box: {from: [0], to: [1]}}
particles: {spacing: 5 mm}
boundary:
  - {name: clamp, mirror: {axis: x, at: 0}}
  - {name: push, traction: [-1], face: x+}
time: {step: 5 us}
output: {frames: 1, samples: 100}
probes: [{line: {name: bar, from: [2.5 mm], to: [997.5 mm], points: 200}}]
END_OF_SCENE
go bar_flip bar
go bar_apic bar -s mpm.transfer=apic
go bar_linear bar -s mpm.shape=linear
go bar_whole bar -s duration=30ms
sed 's/face: x+/&, time: {ramp: {from: 0, until: 1 ms}}/' "$work/bar.yaml" >"$work/ramp.yaml"
go bar_ramp ramp -s particles.spacing=1.25mm
landed
for run in bar_flip bar_apic bar_linear; do
    sound $run 0.005
    near "$run: strain of the precursor" "$(strain $run 0.32 0.42)" -5e-5 0.06
    near "$run: strain behind the plastic front" "$(strain $run 0.55 0.9)" -1.5e-4 0.06
    # The step overshoots at its front and hardens the material: 3 % of the yield stress.
    near "$run: stress of the precursor" "$(along $run stress_xx 0.32 0.42)" -0.5 0.04
    near "$run: stress behind the plastic front" "$(along $run stress_xx 0.55 0.9)" -1 0.01
    # With increasing x strains decrease: fronts of -u.
    awk -F, -v OFS=, 'NR > 1 { for (k = 1; k <= NF; k++) if (k == at) $k = -$k }
        NR == 1 { for (k = 1; k <= NF; k++) if ($k ~ /^displacement_x/) at = k } { print }' \
        "$work/$run/bar_000001.csv" >"$work/$run/bar" && mv "$work/$run/bar" "$work/$run/bar_000001.csv"
    between "$run: elastic front" "$(front $run 2.5e-5)" 0.23 0.27
    between "$run: plastic front" "$(front $run 1e-4)" 0.45 0.49
done
# No overshoot for a pressure that increases over 1 ms: with H = E E_t/(E - E_t) = 1e4 a stress s leaves plastic work (s^2 - 0.25)/(2 H):
# 3.75e-5 at the full pressure, (7/12 - 1/4)/(2 H) in the mean over its increase.
sound bar_ramp 0.005
near "bar_ramp: plastic work" "$(f bar_ramp energy.plastic)" \
    "$(compute "sqrt(5000) * (6.5e-3 * 3.75e-5 + 0.5e-3 * (7 / 12 - 1 / 4) / 2e4)")" 0.01
# Unloading, reverse flow and reflections: the energy balance closes, and plastic work never decreases.
sound bar_whole 0.005
awk -F, 'NR > 1 { if ($5 < before) exit 1; before = $5 }' "$work/bar_whole/history.csv"
is "bar_whole: plastic work never falls" $? 0

# ---- yielding below the conversion stress --------------------------------------------------------------------------

# An end driven at 0.02 m/s sends 2 Pa through an elastic bar; a bar that yields at 0.5 Pa never exceeds 0.505, although the elastic trial
# stress of many steps does: nothing may convert.
scene driven <<'END_OF_SCENE'
space: line
section: 1 m^2
duration: 1 ms
method: adaptive
conversion: {stress: 0.505 Pa, alpha: 1}
material: {young: 1e4, density: 1, yield_stress: 0.5}
body: {box: {from: [0], to: [1]}}
particles: {spacing: 5 mm}
boundary:
  - {name: clamp, mirror: {axis: x, at: 0}}
  - {name: pull, velocity: [0.02 m/s], region: {box: {from: [0.9], to: [1]}}}
output: {frames: 1, samples: 100}
END_OF_SCENE
go driven driven
go driven_elastic driven -s material.yield_stress=inf
landed
absent "driven: conversion" "$(f driven conversion.first_time)"
between "driven: plastic work" "$(f driven energy.plastic)" 1e-6 1e-4
holds "driven_elastic: converts" test -n "$(f driven_elastic conversion.first_time)"

# ---- plane waves ---------------------------------------------------------------------------------------------------

# plane SPACE YIELDING: prints the scene of a strip between rollers under pressure. Without hardening q = |sigma_xx - sigma_yy| = sigma_y
# behind both fronts, in spaces without transverse strain. The precursor has sigma_y (1 - nu)/(1 - 2 nu) = 60 MPa and travels at
# sqrt(C11/rho), the plastic front at sqrt(K/rho).
plane() { strip "$1" "poisson: 1/4, $2" | sed 's/^duration/method: mpm\n&/'; }
plane "plane stress" "yield_stress: 60 MPa, yield_tangent: 50 GPa" | scene stress
plane "plane strain" "yield_stress: 40 MPa" | scene strain
plane solid "yield_stress: 40 MPa" | scene solid
for space in stress strain solid; do
    go wave_$space $space
    go wave_${space}_apic $space -s mpm.transfer=apic
done
go elastic strain -s material.poisson=0.45 -s mpm.frame=current -s material.yield_stress=inf
go never strain -s material.poisson=0.45 -s material.yield_stress=1e30
landed
for space in strain solid; do
    for run in wave_$space wave_${space}_apic; do
        sound $run 0.01
        near "$run: stress along" "$(f $run probes.near.stress_xx)" -100e6 0.02
        near "$run: stress across" "$(f $run probes.near.stress_yy)" -60e6 0.03
        near "$run: velocity" "$(f $run probes.near.velocity_x)" \
            "$(compute "60e6 / sqrt(7800 * 1.2 * 190e9) + 40e6 / sqrt(7800 * 190e9 / 1.5)")" 0.02
        between "$run: plastic work" "$(f $run energy.plastic)" 1e-9 1e3
    done
done
# The transverse stress, nu p before yielding, approaches p/2, where the transverse flow stops.
for run in wave_stress wave_stress_apic; do
    sound $run 0.01
    near "$run: stress along" "$(f $run probes.near.stress_xx)" -1e8 0.02
    between "$run: stress across" "$(f $run probes.near.stress_yy)" -50e6 -28e6
    between "$run: plastic work" "$(f $run energy.plastic)" 1e-9 1e3
done

# A material that never yields is elastic to the last digit (above Poisson's ratio 0.4 both have one dilatation in a cell).
awk -F, 'NR == 1 { for (k = 1; k <= NF; k++) strain[k] = $k ~ /plastic_strain/ }
    { line = ""; for (k = 1; k <= NF; k++) if (!strain[k]) line = line (k > 1 ? "," : "") $k; else if (NR > 1 && $k != 0) exit 1; print line }' \
    "$work/never/history.csv" >"$work/never.csv"
holds "never: yields nowhere" cmp "$work/elastic/history.csv" "$work/never.csv"
is "never: plastic work" "$(f never energy.plastic)" 0

# ---- threads and restart -------------------------------------------------------------------------------------------

long="$work/strain.yaml -s particles.spacing=0.5mm -s duration=100us -s output.samples=100"
for threads in 1 2 3; do calm "$work/long$threads" $long -t $threads; done
same "2 threads" "$work/long1" "$work/long2"
same "3 threads" "$work/long1" "$work/long3"
interrupted "$work/stopped" 40 $long
calm "$work/stopped" -t 3 --resume $long
same "after an interruption" "$work/long1" "$work/stopped"

finish
