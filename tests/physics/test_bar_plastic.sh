#!/bin/sh
# A bar loaded beyond its yield stress (inputs/bar_plastic.yaml), compared with the bilinear wave at 0.75 transit times, with the same
# material in every method (Zeng et al. 2021, section 5.1).
test_name=test_bar_plastic
. tests/support/summary.sh
. tests/support/scenes.sh
. tests/support/trust.sh

# Names of the runs; setting() has the arguments of each.
rows="mpm mpm_apic mpm_linear pd pd_lattice adaptive adaptive_lattice adaptive_handshake"

# setting RUN: prints the relative stiffness of the bonds at the elastic precursor and at the full load (0.9796 for volume modification with
# three neighbours), the upper limit of the plastic work divided by the exact one, and the arguments of the run. The sudden load makes the
# stress overshoot (by a third in peridynamics), which hardens the material: the plastic work is larger than the exact one, never smaller.
setting()
{
    case $1 in
        mpm)                echo 1      1      1.15 -s method=mpm ;;
        mpm_apic)           echo 1      1      1.15 -s method=mpm -s mpm.transfer=apic ;;
        mpm_linear)         echo 1      1      1.15 -s method=mpm -s mpm.shape=linear ;;
        pd)                 echo 0.9796 0.9796 1.35 -s method=pd ;;
        pd_lattice)         echo 1      1      1.35 -s method=pd -s pd.calibration=lattice ;;
        adaptive)           echo 0.9796 1      1.15 -s method=adaptive ;;
        adaptive_lattice)   echo 1      1      1.15 -s method=adaptive -s pd.calibration=lattice ;;
        adaptive_handshake) echo 1      1      1.15 -s method=adaptive -s pd.calibration=lattice -s coupling=handshake ;;
    esac
}

going=0
pace() { going=$((going + 1)); if [ $going -eq 2 ]; then wait; going=0; fi; }
for row in $rows; do
    set -- $(setting $row)
    shift 3
    start $row bar_plastic "$@"; pace
done
start fine bar_plastic -s particles.spacing=1.25mm -s time.step=1.25us; pace
start below bar_plastic -s boundary[1].traction=[-0.3]; pace
wait

# within RUN QUANTITY EXACT TOLERANCE: checks a quantity of the comparison with the exact solution; the tolerance is relative.
within()
{
    found=$(f $1 probes.exact.$2)
    between "$1 $2" "$found" "$(compute "$3 - $4 * ($3 < 0 ? -($3) : $3)")" "$(compute "$3 + $4 * ($3 < 0 ? -($3) : $3)")"
}

for row in $rows; do
    set -- $(setting $row)
    sound $row 0.005
    between "$row: elastic front" "$(f $row probes.exact.front)" 0.23 0.27
    between "$row: plastic front" "$(f $row probes.exact.front_plastic)" 0.45 0.49             # 1 - 0.75/sqrt(2) = 0.470
    within $row strain_elastic "-5e-5 / $1" 0.06
    within $row strain_plastic "-1.5e-4 / $2" 0.06
    within $row plateau -1 0.01
    # 3.75e-5 J/m behind the plastic front.
    work_exact=$(compute "3.75e-5 * 0.75 / sqrt(2)")
    between "$row: plastic work" "$(f $row energy.plastic)" "$work_exact" "$(compute "$3 * $work_exact")"
done
# The overshoot becomes narrower with the spacing.
sound fine 0.005
within fine strain_elastic -5e-5 0.03
within fine strain_plastic -1.5e-4 0.02
between "fine: plastic front" "$(f fine probes.exact.front_plastic)" 0.46 0.48
ratio=$(compute "$(f fine probes.exact.L1) / $(f mpm probes.exact.L1)")
between "fine: error over that of four times the spacing" "$ratio" 0.3 0.5
# A load whose overshoot stays below yield: an elastic bar.
absent "below: plastic front" "$(f below probes.exact.front_plastic)"
is "below: plastic work" "$(f below energy.plastic)" 0

# ---- profiles and picture --------------------------------------------------------------------------------------------

is "profiles" "$(ls "$work/mpm" | grep -c '^exact_00000[0-3].csv$')" 4
if command -v gnuplot >/dev/null 2>&1; then
    "$cleave" plot "$work/mpm" --size 90mmx70mm >"$work/out" 2>&1
    is "plot: exit status" $? 0
    holds "profiles.png" test -s "$work/mpm/pictures/profiles.png"
fi
finish
