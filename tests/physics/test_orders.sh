#!/bin/sh
# Observed orders of convergence on four grids, whose spacing and step are halved together, within 0.15 of theory, for the manufactured
# solution of inputs/bar_converge.yaml and the smooth pulse of inputs/bar_smooth.yaml.
test_name=test_orders
. tests/support/summary.sh
. tests/support/scenes.sh

grids="100 200 400 800"                  # particles per metre

# at N: prints the arguments for N particles per metre; a wave crosses a quarter of a spacing per step.
at() { echo "-s particles.spacing=1/$1 -s time.step=1/$((400 * $1))"; }

# pace: limits the number of runs to two at a time.
going=0
pace() { going=$((going + 1)); if [ $going -eq 2 ]; then wait; going=0; fi; }

# refine NAME SCENE [ARGUMENT...]: starts the runs NAME.1 .. NAME.4 on the four grids, coarse to fine.
refine()
{
    name=$1 scene=$2 k=0; shift 2
    for n in $grids; do k=$((k + 1)); start $name.$k $scene $(at $n) "$@"; pace; done
}

# orders NAME U V STRESS STRAIN: checks the orders of convergence of the root-mean-square errors between successive grids: of displacement,
# velocity, stress, and Young's modulus times the strain from displacements. - : an order that is not checked.
orders()
{
    name=$1; shift
    for quantity in L2_displacement L2_velocity L2 L2_strain; do
        wanted=$1; shift
        if [ "$wanted" = - ]; then continue; fi
        found=$(observed "$name" $quantity) low=$(compute "$wanted - 0.15") high=$(compute "$wanted + 0.15")
        is "$name $quantity: orders" "$(echo $found | wc -w)" 3
        for order in $found; do
            between "$name $quantity: order" "$order" "$low" "$high"
        done
    done
}

# observed NAME QUANTITY: prints the three orders of convergence of an error between the runs NAME.1 .. NAME.4, one a line.
observed()
{
    awk -v wanted="\"$2\":" '
        $1 == "\"particles\":" { n = $2 + 0 }
        $1 == wanted { if (coarse) printf "%.4f\n", log(error / $2) / log(n / coarse); coarse = n; error = $2 + 0 }' \
        "$work/$1.1/summary.json" "$work/$1.2/summary.json" "$work/$1.3/summary.json" "$work/$1.4/summary.json"
}

# relative NAME QUANTITY RMS: prints an error of the run NAME divided by RMS, the root mean square of the exact field (a formula).
relative() { compute "$(f "$1" probes.exact.$2) / ($3)"; }

# Every shape with each of its transfers is in at least one of the two problems.

# ---- manufactured solution -------------------------------------------------------------------------------------------

for shape in linear gimp cpgimp quadratic cubic; do refine made_$shape bar_converge -s mpm.shape=$shape; done
for shape in gimp quadratic; do refine made_apic_$shape bar_converge -s mpm.shape=$shape -s mpm.transfer=apic; done
refine made_pd bar_converge -s method=pd
wait
# First-degree shapes have one strain per cell, which is second-order accurate in its middle: the stress of the points beside it is first
# order, but their displacements are second order, and so is the difference of displacements.
for shape in linear gimp cpgimp; do orders made_$shape 2 2 1 2; done
for shape in quadratic cubic; do orders made_$shape 2 2 2 2; done
# The damping of APIC and the dispersion of B-splines have opposite signs in the velocity error, which passes through zero here.
orders made_apic_gimp 2 2 1 2
orders made_apic_quadratic 2 - 2 2
# Three neighbours on each side at every spacing: convergence to the local bar. In E x strain two second-order errors cancel except at the
# ends.
orders made_pd 2 2 2 -
# FLIP noise is not visible down to the finest of these grids, 7e-5 of the displacement; the round-off of positions limits E x strain at
# 1e-5, with 3200 particles.
root_mean_square="0.9045e-7 / sqrt(2)"
between "made_linear.4: error" "$(relative made_linear.4 L2_displacement "$root_mean_square")" 6e-5 8e-5

# ---- more neighbours in one horizon of 0.1 m -----------------------------------------------------------------------

# With a fixed horizon the law of bonds does not change, and the body force is that of its operator, (4 E/delta^2) int_0^delta (1 - cos k
# r)/r dr instead of E k^2. Whole neighbours exceed the horizon's ends by half a spacing: first order. A ramp weights them by one half, and
# VMPD places the ends between two neighbours: second order.
nonlocal="-s method=pd -s boundary[3].body_force=[-0.0417335084233727]" continuum="-s pd.calibration=continuum"
k=0
for m in 3 5 7 9; do
    k=$((k + 1)) bonds="$nonlocal -s particles.horizon=$m"
    start whole.$k bar_converge $(at ${m}0) $bonds $continuum; pace
    start lattice.$k bar_converge $(at ${m}0) $bonds; pace
    start ramp.$k bar_converge $(at ${m}0) $bonds $continuum -s pd.volume=ramp; pace
    start vmpd.$k bar_converge $(at ${m}5) $bonds -s pd.calibration=vmpd; pace
done
wait
orders whole 1 1 - 1
orders lattice 1 1 - -                       # the same operator, with exact long waves: errors 60 times smaller
orders ramp 2 2 - -
orders vmpd 2 2 - -
# The stress that balances this force is softer than E x strain by the ratio of the operators, 1.64 %, for any number of neighbours.
between "ramp: stress of the nonlocal bar" "$(relative ramp.4 L2 "6.2832e4 * $root_mean_square")" 0.0164 0.0170

# ---- a smooth pulse --------------------------------------------------------------------------------------------------

for shape in linear gimp quadratic; do refine pulse_$shape bar_smooth -s mpm.shape=$shape; done
for shape in cpgimp cubic; do refine pulse_apic_$shape bar_smooth -s mpm.shape=$shape -s mpm.transfer=apic; done
refine pulse_pd bar_smooth -s method=pd
wait
# On coarse grids the second-order error (dispersion) exceeds the first-order error of the stress.
for shape in linear gimp; do
    orders pulse_$shape 2 2 - 2
    between "pulse_$shape: order of the stress, finest grids" "$(observed pulse_$shape L2 | tail -n 1)" 0.85 1.15
done
orders pulse_apic_cpgimp 2 2 1 2
for shape in quadratic apic_cubic pd; do orders pulse_$shape 2 2 2 2; done

# Cell crossing: at strains of 5e-3 the finest points cross half a cell, and linear shapes lose the wave. The others end at an error of
# about the strain, the limit of linear elasticity.
strong="-s initial[0].pulse.velocity=0.5"
start crossing_linear bar_smooth $(at 800) $strong -s mpm.shape=linear; pace
start crossing_gimp bar_smooth $(at 800) $strong; pace
peak="0.5 * sqrt(0.1 * sqrt(2 * atan2(0, -1)) / 2 / 1.6)"
between "crossing, linear: error of the velocity" "$(relative crossing_linear L2_velocity "$peak")" 0.1 1
between "crossing, gimp: error of the velocity" "$(relative crossing_gimp L2_velocity "$peak")" 0 0.01

# ---- position of the nodes -------------------------------------------------------------------------------------------

# A mirror midway between two nodes is equivalent to one on a node; at other positions the program warns.
start half bar_converge $(at 100) -s mpm.shape=quadratic -s mpm.origin=[1/100]; pace
start node bar_converge $(at 100) -s mpm.shape=quadratic; pace
apart "mirrors between nodes" "$(f half probes.exact.L2_displacement)" "$(f node probes.exact.L2_displacement)" 1e-14
while read -r setting warnings; do
    "$cleave" check --no-trial inputs/bar_converge.yaml -s "$setting" >"$work/said" 2>&1
    is "$setting: warnings" "$(grep -c '^warning: .*the mirror plane is neither' "$work/said")" $warnings
done <<'END'
mpm.origin=[0]      0
mpm.origin=[0.02]   0
mpm.origin=[0.012]  2
mpm.cell=1.7        1
mpm.cell=2          0
END
# Nodes start at a mirror, not at the bar's other end: a reflected front.
turned="boundary=[{mirror: {axis: x, at: 1 m}}, {traction: -1, face: x-}]"
set -- bar_step $(at 400) -s method=mpm -s mpm.shape=gimp -s mpm.cell=3 -s "$turned"
start on_mirror "$@"; pace
start on_corner "$@" -s mpm.origin=[0]; pace
between "node on the mirror" "$(f on_mirror probes.exact.L2_displacement)" 0 3e-7       # relative to 1e-4; 1.9e-7 measured
between "node elsewhere" "$(f on_corner probes.exact.L2_displacement)" 2e-6 4e-6

finish
