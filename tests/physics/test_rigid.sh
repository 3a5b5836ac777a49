#!/bin/sh
# A plate that rotates by 0.1257 rad, with each bond model, with material points and coupled: its angle, quantities that must remain zero,
# and the state of the probe after kills.
test_name=test_rigid
. tests/support/summary.sh
. tests/support/scenes.sh
. tests/support/trust.sh
seed=6

turning="-s particles.spacing=50mm -s output.samples=20"
half="-s material.poisson=1/3"
start mospd rigid_rotation $turning
start ospd rigid_rotation $turning -s model=ospd
wait
start bond rigid_rotation $turning -s model=bond $half
start apic rigid_rotation $turning -s method=mpm -s mpm.transfer=apic
wait
start both rigid_rotation $turning -s model=bond $half -s method=adaptive -s mpm.transfer=apic \
    -s 'pd.region={box: {from: [-0.2, -0.2], to: [0.2, 0.2]}}'
wait

# off FOLDER: prints the largest |angle/(omega t) - 1| over the samples, with the angular velocity omega = pi/2 per second; words if there
# are fewer than 15 samples.
off()
{
    awk -F, '
        NR == 1 { for (k = 1; k <= NF; k++) { sub(/ \[.*/, "", $k); if ($k == "rigid.angle") at = k } next }
        $1 > 0 { d = $at / (1.5707963267948966 * $1) - 1; if (d < 0) d = -d; if (d > most) most = d; n++ }
        END { print n < 15 ? "too few samples" : most + 0 }' "$work/$1/history.csv"
}

# The centrifugal stress of the rotating plate: 2 rho (omega r)^2/2 = 1.5 to 3 kPa = 1.5e-8 E. mospd with rotations that lag by one step
# would have 3e5 Pa, with linearised rotations 1e9 Pa.
for run in mospd ospd bond apic; do
    between "$run: angle" "$(f $run probes.rigid.angle)" 0.12566 0.12567
    between "$run: stress" "$(f $run probes.rigid.stress_max)" 500 3090
    between "$run: shear" "$(f $run probes.rigid.shear_max)" 100 3090
    between "$run: angle on the way" "$(off $run)" 0 1e-6
done
# 2e-12 for mospd: round-off of 9000 steps, and (omega dt)^2/2 = 1e-10 in the last line, whose velocities are extrapolated; the grid of
# material points has 1e-7.
for run in mospd ospd bond; do
    between "$run: angular momentum" "$(f $run probes.rigid.angular_momentum_error)" 0 2e-10
    between "$run: kinetic energy" "$(f $run probes.rigid.kinetic_energy_error)" 0 1e-7
    between "$run: balance of energies" "$(f $run energy.balance_error)" -1e-7 1e-7
done
between "apic: angular momentum" "$(f apic probes.rigid.angular_momentum_error)" 0 1e-6
between "apic: kinetic energy" "$(f apic probes.rigid.kinetic_energy_error)" 0 1e-5

shown="inputs/rigid_rotation.yaml $turning -s duration=0.01 -s output.checkpoint=0.01"
calm "$work/whole" -t 1 $shown
kills 2 "$work/whole" $shown
finish
