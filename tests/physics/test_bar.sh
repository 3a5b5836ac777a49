#!/bin/sh
# Bars compared with d'Alembert's solution (inputs/bar_step.yaml): errors, fronts and plateaus of every method; frames at given times. L1
# errors are at most 1.1 times reference values from an independent code; Zeng et al. 2021 show the same curves.
test_name=test_bar
. tests/support/summary.sh
. tests/support/scenes.sh
. tests/support/trust.sh

# bar FOLDER ARGUMENT...: starts a run in the background, at most two at a time.
going=0
bar()
{
    folder=$1; shift
    start "$folder" bar_step "$@"
    going=$((going + 1))
    if [ $going -eq 2 ]; then wait; going=0; fi
}
half="-s duration=5ms" late="-s duration=12.5ms"
plain="-s pd.calibration=continuum"

for n in 1 2 3 4 5 10; do
    bar "vmpd$n" $half -s particles.horizon=$n
    bar "pd$n" $half $plain -s particles.horizon=$n
done
for shape in linear gimp; do
    bar "$shape" $half -s method=mpm -s mpm.shape=$shape
    bar "late_$shape" $late -s method=mpm -s mpm.shape=$shape
done
bar late_vmpd3 $late
bar late_pd3 $late $plain
# Volume-modified peridynamics below x = 0.5 m, material points above.
for coupling in 'partial stress' handshake; do
    bar "late_${coupling% *}" $late -s method=adaptive -s 'pd.region={box: {from: -inf, to: 0.5}}' \
        -s conversion.criteria=none -s "coupling=$coupling" -s mpm.shape=gimp
done
# The reversed bar, and a bar with a free far end, where the reflected front unloads the bar.
bar turned $half -s 'boundary=[{mirror: {axis: x, at: 1 m}}, {traction: -1, face: x-}]'
bar free  -s boundary[0]=
# A pulse reflected at a fixed and at a free end, at two spacings, with steps of a tenth of a spacing.
for d in 1 2; do
    for end in fixed free; do
        walls='[]'
        if [ $end = fixed ]; then walls='[{mirror: {axis: x, at: 1.024}}]'; fi
        start "$end$d" bar_pulse -s 'probes=[exact: pulse]' -s method=pd -s duration=12ms -s particles.spacing=${d}mm \
            -s initial[0].pulse.width=100mm -s time.step=${d}us -s "boundary=$walls"
    done
    wait
done
wait

# ---- errors --------------------------------------------------------------------------------------------------------

# error FOLDER QUANTITY REFERENCE: checks that the error of a quantity is at most 1.1 times the reference value.
error() { between "$1 $2" "$(f "$1" "probes.exact.$2")" 0 "$(compute "1.1 * $3")"; }

while read -r run l1; do error "$run" L1 "$l1"; done <<'END'
vmpd1 0.046
vmpd2 0.044
vmpd3 0.056
vmpd4 0.069
vmpd5 0.082
vmpd10 0.134
pd1 0.213
pd2 0.132
pd3 0.114
pd4 0.105
pd5 0.103
pd10 0.133
linear 0.043
gimp 0.042
late_linear 0.059
late_gimp 0.059
late_pd3 0.221
late_vmpd3 0.069
late_partial 0.068
late_handshake 0.068
END
error pd3 L1_strain 0.193
error vmpd3 L1_strain 0.078
error late_pd3 L1_strain 0.358
error late_vmpd3 L1_strain 0.097

# ---- plateaus and fronts -------------------------------------------------------------------------------------------

for run in linear gimp vmpd3 pd3; do            # equilibrium at any stiffness
    between "$run plateau" "$(f $run probes.exact.plateau)" 0.99 1.01
    is "$run status" "$(f $run status)" done
done
for run in linear gimp; do
    between "$run plateau by strain" "$(f $run probes.exact.plateau_strain)" 0.99 1.01
done
# Relative stiffness 0.9796 (vmpd) and 4/3 (pd).
between "vmpd plateau by strain" "$(f vmpd3 probes.exact.plateau_strain)" 1.011 1.031
between "pd plateau by strain" "$(f pd3 probes.exact.plateau_strain)" 0.74 0.76
for run in linear gimp vmpd3; do between "$run front" "$(f $run probes.exact.front)" 0.485 0.515; done
between "pd front" "$(f pd3 probes.exact.front)" 0.415 0.445        # 1 - sqrt(4/3)/2 = 0.423, with dispersion
for n in 2 3 4 5; do
    for m in 2 3 4 5; do
        apart "vmpd fronts of horizons $n and $m" "$(f vmpd$n probes.exact.front)" "$(f vmpd$m probes.exact.front)" 0.003
    done
done
for run in late_linear late_gimp; do between "$run plateau" "$(f $run probes.exact.plateau)" 1.98 2.02; done
# Exact at the end's particle: (ct - D/2) F/E = 1.2475e-4.
between "late partial: end" "$(f late_partial probes.exact.end_displacement)" 1.2466e-4 1.2516e-4
between "late handshake: end" "$(f late_handshake probes.exact.end_displacement)" 1.2442e-4 1.2492e-4

# Mirrored results.
between "turned front" "$(f turned probes.exact.front)" 0.485 0.515
apart "turned L1" "$(f turned probes.exact.L1)" "$(f vmpd3 probes.exact.L1)" 1e-9
apart "turned front mirrored" "$(f turned probes.exact.front)" "$(compute "1 - $(f vmpd3 probes.exact.front)")" 1e-9
between "free: stress taken away" "$(f free probes.exact.plateau)" -0.02 0.02
between "free: front on its way back" "$(f free probes.exact.front)" 0.46 0.54

# Second order in the spacing: dispersion of the lattice.
for end in fixed free; do
    for figure in L1 L2_velocity L2_displacement; do
        ratio=$(compute "$(f ${end}2 probes.exact.$figure) / $(f ${end}1 probes.exact.$figure)")
        between "pulse, $end end: $figure over a halved spacing" "$ratio" 3.4 4.4
    done
    between "pulse, $end end: L1" "$(f ${end}1 probes.exact.L1)" 0 5e-4      # relative to 0.1 Pa; 3.5e-4 measured
done

# ---- frames at given times -----------------------------------------------------------------------------------------

slow="-s time.step=1us -s output.times=[1ms,5ms,5.0004ms,15ms]"
calm "$work/times" inputs/bar_step.yaml -t 1 $slow
times=$(awk -F'"time":' 'NF > 1 { sub(/}.*/, "", $2); printf "%s%.9g", n++ ? " " : "", $2 }' \
    "$work/times/frames.hdf.series")
# The third time is in a later step: the frame is at the step nearest to it.
is "times of frames" "$times" "0 0.001 0.005 0.005001 0.015"
is "profiles" "$(ls "$work/times" | grep -c '^exact_00000[0-4].csv$')" 5
interrupted "$work/again" 100 inputs/bar_step.yaml $slow
calm "$work/again" --resume inputs/bar_step.yaml -t 2 $slow
same "interrupted between frames" "$work/times" "$work/again"
for k in 0 1 2 3 4; do
    holds "profile $k after an interruption" cmp -s "$work/times/exact_00000$k.csv" "$work/again/exact_00000$k.csv"
done

# ---- adaptive bars -------------------------------------------------------------------------------------------------

# The doubled stress behind the reflected front converts the particles that it passes.
growing="-s method=adaptive -s mpm.cell=2 -s mpm.shape=gimp -s conversion.stress=1.6 -s conversion.alpha=1"
for coupling in partial handshake; do
    words="$coupling"; if [ $coupling = partial ]; then words="partial stress"; fi
    calm "$work/$coupling" inputs/bar_step.yaml -t 1 $growing -s "coupling=$words"
    # Up to the front, half of the bar, and one block of three of 200 particles more: the energy of handshake conversions moves with the
    # front.
    between "$coupling: converted" "$(f $coupling conversion.pd_share_end)" 0.4 0.515
    for figure in L1 L2 front plateau end_displacement L1_strain L2_strain front_strain plateau_strain L1_velocity \
        L2_velocity L2_displacement; do
        between "$coupling: $figure" "$(f $coupling probes.exact.$figure)" 1e-12 3       # a finite number
    done
    between "$coupling: plateau" "$(f $coupling probes.exact.plateau)" 1.96 2.04
    between "$coupling: front" "$(f $coupling probes.exact.front)" 0.46 0.54
    between "$coupling: end" "$(f $coupling probes.exact.end_displacement)" 1.4925e-4 1.5025e-4         # exact: 1.4975e-4
done
slow="$growing -s time.step=2us"
calm "$work/growing" inputs/bar_step.yaml -t 1 $slow
interrupted "$work/grown" 250 inputs/bar_step.yaml $slow
calm "$work/grown" --resume inputs/bar_step.yaml -t 2 $slow
same "interrupted while it converts" "$work/growing" "$work/grown"
for k in 0 1 2 3 4; do
    holds "profile $k of a bar that converts" cmp -s "$work/growing/exact_00000$k.csv" "$work/grown/exact_00000$k.csv"
done

# ---- picture -------------------------------------------------------------------------------------------------------

if command -v gnuplot >/dev/null 2>&1; then
    for run in times partial; do
        "$cleave" plot "$work/$run" --size 90mmx70mm >"$work/out" 2>&1
        is "plot $run: exit status" $? 0
        holds "profiles.png of $run" test -s "$work/$run/pictures/profiles.png"
    done
fi

# ---- spall strength from a free surface --------------------------------------------------------------------------------

# E s_c = 300 MPa is put in. rho c du/2 of the first dip of the free surface (contact.md, c = sqrt(E/rho)): behind a pulse that falls within
# 1.5 us it is 271 MPa at 20 um, and 285 at 5 um; behind one that falls within 20 ns bonds end the tension at once, and the dip is a
# spike of 177 MPa.
cat >"$work/spall.yaml" <<'END'
space: line
duration: 2.2 us
method: pd
material: {young: 107 GPa, density: 2700 kg/m^3, critical_stretch: 0.28 %, viscosity: {}}
body: {box: {from: 0, to: 6 mm}}
particles: {spacing: 0.02 mm}
boundary: [{name: blow, traction: [850 MPa], face: x-, time: {table: [[0, 0], [0.2 us, 1], [1.7 us, 0], [9 us, 0]]}}]
probes: [break, {point: {name: free, at: 5.99 mm}}]
output: {frames: 1, samples: 2000}
END
dip()
{
    "$cleave" run -q -o "$work/$1" "$work/spall.yaml" -s "boundary.blow.time={table: $2}" 2>/dev/null
    awk -F, 'NR == 1 { for (k = 1; k <= NF; k++) if ($k ~ /^free.velocity_x/) at = k; next }
        $at > top && !(low < top - 5 && $at > low + 3) { top = low = $at }
        $at < low { low = $at }
        low < top - 5 && $at > low + 3 { exit }
        END { print 2700 * sqrt(107e9 / 2700) * (top - low) / 2 * 1e-6 }' "$work/$1/history.csv"
}
slow=$(dip slow "[[0, 0], [0.2 us, 1], [1.7 us, 0], [9 us, 0]]") sudden=$(dip sudden "[[0, 0], [20 ns, 1], [0.635 us, 1], [0.655 us, 0], [9 us, 0]]")
between "spall strength behind a slow pulse" "$slow" 270 273 # 0.6 MPa: a step of the history
between "spall strength behind a sudden one" "$sudden" 174 180
finish
