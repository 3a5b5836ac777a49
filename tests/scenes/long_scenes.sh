#!/bin/sh
# Scenes of inputs/ at finer spacings and other time steps: they must yield the results that test_scenes.sh accepts, too.
test_name=long_scenes
. tests/support/summary.sh
. tests/support/scenes.sh

# Kalthoff's plate at half the spacing.
for method in pd adaptive; do
    start kalthoff_$method kalthoff_winkler -s method=$method -s particles.spacing=0.5mm -s time.step=0.04us
done
wait
sound kalthoff_pd $pd_balance
sound kalthoff_adaptive $adaptive_balance
for method in pd adaptive; do
    run=kalthoff_$method
    between "$run: start" "$(f $run crack.start_time)" 19.5e-6 24e-6     # pd: 19.96 us, decreasing with the spacing
    between "$run: tip moves" "$(f $run crack.tip_start_time)" 23.5e-6 28.5e-6
    between "$run: angle" "$(f $run crack.angle_deg)" 62 74
    apart "$run: a pair, x" "$(f $run crack.tips.0.x)" "$(f $run crack.tips.1.x)" 0.501e-3
    apart "$run: a pair, y" "$(f $run crack.tips.0.y)" "$(compute "-($(f $run crack.tips.1.y))")" 0.501e-3
    between "$run: speed below 0.75 of 2779 m/s" "$(f $run crack.tip_speed_max)" 800 2084
done
apart "kalthoff: pd and adaptive" "$(f kalthoff_pd crack.angle_deg)" "$(f kalthoff_adaptive crack.angle_deg)" 3

# Its adaptive angle for different time steps: affine transfer keeps it close to that of peridynamics, 68.4 degrees.
start step_0.03 kalthoff_winkler -s time.step=0.03us
start step_0.1 kalthoff_winkler -s time.step=0.1us
wait
start step_0.15 kalthoff_winkler -s time.step=0.15us
start step_pd kalthoff_winkler -s method=pd
wait
for step in 0.03 0.1 0.15; do
    sound step_$step $adaptive_balance
    apart "kalthoff at $step us" "$(f step_$step crack.angle_deg)" "$(f step_pd crack.angle_deg)" 3
done

# The plate with a crack at a spacing of 0.25 mm.
for method in pd adaptive; do
    start crack_$method plate_crack -s method=$method -s particles.spacing=0.25mm -s time.step=0.03us
done
wait
sound crack_pd $pd_balance
sound crack_adaptive $adaptive_balance
for method in pd adaptive; do
    between "crack_$method: start" "$(f crack_$method crack.start_time)" 5.7e-6 6.4e-6
    between "crack_$method: arrest" "$(f crack_$method crack.arrest_time)" 10e-6 11.5e-6
    between "crack_$method: length" "$(compute "$(f crack_$method crack.length_end) + 5e-3")" 8.2e-3 9.8e-3
done
apart "plate_crack: pd and adaptive within a spacing" "$(f crack_pd crack.length_end)" "$(f crack_adaptive crack.length_end)" 0.2501e-3

# The bar in 3D at half the spacing: the delay of the peridynamic spall decreases from 7 to 5.5 %, within the required 6 %.
for method in pd adaptive; do
    start impact_$method plate_impact_3d -s method=$method -s particles.spacing=0.5mm -s time.step=1us
done
wait
sound impact_pd $pd_balance
sound impact_adaptive $adaptive_balance
for method in pd adaptive; do
    between "impact_$method: spall" "$(f impact_$method probes.spall.position)" 0.038 0.042
    between "impact_$method: time" "$(f impact_$method crack.start_time)" "$(compute 0.913e-3*0.94)" "$(compute 0.913e-3*1.06)"
done

finish
