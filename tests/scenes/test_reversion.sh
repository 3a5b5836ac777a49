#!/bin/sh
# Reversion to material points (conversion.reversion) in whole runs: the share of peridynamics must decrease behind a wave without
# oscillation, momentum must not change, and energy little. Bitwise equality on any number of threads and after any interruption;
# refusals.
test_name=test_reversion
. tests/support/summary.sh
. tests/support/trust.sh
. tests/support/scenes.sh
. tests/support/physics.sh

# ---- a pulse through a bar -------------------------------------------------------------------------------------------

# A pulse 80 spacings long; converted over half of its peak and a horizon on either side, reverted after the time of five horizons: about 60
# particles. The smoothing of bonds costs 0.09 % for a whole pulse, and reversion is at low stress; the fit of the mesh's nodes costs as
# little. Balance: 0.7 % without reversion, from conversion in the first step; APIC dissipates 1.7 %.
start current bar_return -s mpm.frame=current
start reference bar_return
wait
start apic bar_return -s mpm.transfer=apic
start never bar_return -s mpm.frame=current -s conversion.reversion=false
wait
for run in current reference apic; do
    sound $run $([ $run = apic ] && echo $adaptive_balance || echo 0.01)
    between "$run: most at any time" "$(f $run conversion.pd_share_max)" 0.05 0.07
    between "$run: at the end" "$(f $run conversion.pd_share_end)" 0.04 0.07
    between "$run: converted" "$(f $run conversion.converted)" 500 600
    between "$run: returned" "$(f $run conversion.reverted)" 440 520
    is "$run: once at the most" "$(f $run conversion.reversions_most)" 1
    energy=$(compute "$(f $run energy.kinetic) + $(f $run energy.strain)")
    between "$run: energy of return" "$(compute "$(f $run conversion.reversion_energy) / $energy")" -1e-3 1e-3
done
between "never: at the end" "$(f never conversion.pd_share_end)" 0.5 0.6
absent "never: returned" "$(f never conversion.reverted)"

# ---- a plate ---------------------------------------------------------------------------------------------------------

# A pulse in a plate with free edges: the wave is reflected as pressure, and again as tension; nothing is peridynamic in between. Momentum
# 0.
scene plate <<'END'
space: plane stress
thickness: 1 mm
duration: 40 us
material: {young: 200 GPa, density: 8000}
body: {box: {from: [0, 0], to: [160 mm, 20 mm]}}
particles: {spacing: 1 mm}
conversion: {stress: 200 MPa, alpha: 1, reversion: true}
initial: [{pulse: {at: [40 mm, 0], width: 32 mm, velocity: -10 m/s, direction: [1, 0]}}]
output: {frames: 4, samples: 100}
END
for frame in current reference; do
    arguments="$work/plate.yaml -s mpm.frame=$frame"
    calm "$work/${frame}1" $arguments -t 1
    twice_interrupted "$work/stopped" 30 70 $arguments
    calm "$work/stopped" -t 3 --resume $arguments
    same "$frame on 2 and 3 threads, interrupted after 30 and 70 lines" "$work/${frame}1" "$work/stopped"
    # Points in the current frame lose 4.2 to 6.5 % by conversion to bonds and back, depending on shape and step.
    sound ${frame}1 $([ $frame = current ] && echo 0.07 || echo 0.05)
    between "$frame: share half-way" "$(column "$work/${frame}1" pd_share 16e-6)" 0.3 0.45
    between "$frame: most at any time" "$(f ${frame}1 conversion.pd_share_max)" "$(column "$work/${frame}1" pd_share 16e-6)" 0.6
    between "$frame: share once it has passed" "$(column "$work/${frame}1" pd_share 32e-6)" 0 0.001
    between "$frame: returned" "$(f ${frame}1 conversion.reverted)" 2400 3000
    between "$frame: a few times at the most" "$(f ${frame}1 conversion.reversions_most)" 1 3
done

# ---- no reversion beside cracks --------------------------------------------------------------------------------------

# The plate with a hole: all converted points are within two horizons of breaking bonds. The result equals that without reversion.
start hole plate_hole -s conversion.stress=3000MPa -s duration=20us -s conversion.reversion=true
start hole_never plate_hole -s conversion.stress=3000MPa -s duration=20us
wait
is "hole: returned" "$(f hole conversion.reverted)" 0
holds "hole: the same history" cmp "$work/hole/history.csv" "$work/hole_never/history.csv"

# ---- peridynamic from the start at the ends of notches -----------------------------------------------------------------

# Two horizons of 3.015 mm around each, equivalent to a region; ends outside the body do not count. The first bond breaks 1.4 % later than
# in the corresponding peridynamics (no surface correction), without the zones 11 % later for any criterion. These particles never revert.
kalthoff="kalthoff_winkler -s time.step=0.1us -s duration=24us -s output.frames=1 -s conversion.notch=bonds"
tip() { echo "{ball: {centre: [50 mm, $1 mm], radius: 6.03 mm}}"; }
start pd $kalthoff -s method=pd -s pd.surface=none
start tips $kalthoff -s conversion.tips=2 -s conversion.reversion=true
wait
start region $kalthoff -s conversion.reversion=true -s "pd.region=[$(tip -25), $(tip 25)]"
start bare_notch $kalthoff
wait
holds "tips: the region" cmp "$work/tips/history.csv" "$work/region/history.csv"
between "tips: first bond, beside peridynamics" "$(compute "$(f tips crack.start_time) / $(f pd crack.start_time)")" 0.98 1.02
between "the same without" "$(compute "$(f bare_notch crack.start_time) / $(f pd crack.start_time)")" 1.04 1.1
between "tips: share at the start" "$(f tips conversion.pd_share_start)" 0.035 0.04

# ---- refused ---------------------------------------------------------------------------------------------------------

# refused WHAT PART ARGUMENT...: checks for status 2 and one line that contains PART.
refused()
{
    what=$1 part=$2; shift 2
    "$cleave" check --no-trial "$work/plate.yaml" "$@" >"$work/out" 2>"$work/err"
    is "$what: status" $? 2
    is "$what: lines" "$(wc -l <"$work/err")" 1
    holds "$what: $(cat "$work/err")" grep -q "$part" "$work/err"
}
refused tips "out of range" -s conversion.tips=-1
refused dwell "out of range" -s conversion.hold_time=0.5
refused share "out of range" -s conversion.low_stress=0.95
refused criteria "conversion.criteria must contain stress" -s "conversion.criteria=[bond]"
refused coupling "partial stress or handshake" -s coupling=pm
refused yields "a material of the scene yields" -s material.yield_stress=300MPa
finish
