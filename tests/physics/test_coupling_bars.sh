#!/bin/sh
# Couplings of peridynamics and material points in bars: pulses through an interface (inputs/bar_pulse.yaml), a loaded bar
# (bar_coupled.yaml), spallation after an impact (bar_spall.yaml). Reference values in the tables are from an independent code; the scenes
# are those of Zeng et al. 2021, sections 5.1 and 5.4.
# Takes 25 s: each coupling and width of pulse is a separate bar, long enough to separate reflected and transmitted pulse.
test_name=test_coupling_bars
. tests/support/summary.sh
. tests/support/scenes.sh
. tests/support/physics.sh
. tests/support/trust.sh

# bar FOLDER SCENE ARGUMENT...: starts a run in the background, at most two at a time; `landed` waits for all that are still running.
bar()
{
    start "$@"
    going=$((going + 1))
    if [ $going -eq 2 ]; then landed; fi
}
all="handshake pm pg pmg pgg partial"

# coupling NAME: prints the value of the key `coupling` for a name of this script, such as partial32.
coupling() { case $1 in partial*) echo "partial stress" ;; *) echo "$1" ;; esac; }

# quiet FOLDER: checks that the run is done and that its relative error of momentum is at most 1e-12; the largest one of these runs is
# 5e-14.
quiet()
{
    is "$1 status" "$(f "$1" status)" done
    between "$1 momentum" "$(f "$1" momentum_error)" 0 1e-12
}

# ---- a pulse through an interface ----------------------------------------------------------------------------------

# pulse FOLDER WIDTH ARGUMENT...: starts the run of a pulse of this width [spacings].
pulse()
{
    folder=$1 width=$2; shift 2
    case $width in 16) step=2us ;; *) step=4us ;; esac         # short pulses depend on the step: 16 spacings, undamped, reflect 7.45 % with 4 us
    bar "$folder" bar_pulse -s time.step=$step -s output.frames=1 -s initial[0].pulse.width=${width}mm "$@"
}
reflected() { compute "100 * $(f "$1" probes.pulse.reflected)"; }

# pm and pg, and pmg and pgg, reflect equal parts of long pulses; a node at 0.5 mm reflects less than those at 1 and 1.5 mm.
for width in 16 32 64 128; do
    case $width in 16 | 32) these=$all ;; *) these="handshake pg pgg partial" ;; esac
    for c in $these; do pulse "pulse_$c$width" $width -s "coupling=$(coupling $c)"; done
    pulse "pulse_undamped$width" $width -s interface_damping=0
done
for width in 16 32 64; do
    for origin in 1 1.5; do pulse "pulse_at$origin-$width" $width -s "mpm.origin=[${origin}mm]"; done
done
for width in 32 64; do pulse "pulse_apic$width" $width -s mpm.transfer=apic; done
for c in handshake partial; do
    pulse "pulse_stiff_$c" 128 -s "coupling=$(coupling $c)" -s pd.calibration=continuum
done
landed

# Reflected velocity [%] at 16, 32, 64, 128 spacings: within 15 % or 0.15 points of the reference. The independent code moves points on the
# grid with the first velocity, as published: pm and pg then lose 1.1 % of the energy at the interface, pmg and pgg 2.4 % (and grow in time,
# by 1e-3 per step: test_current_frame). With the second velocity no energy is lost and is reflected instead: 12.65 and 5.73 (pm, pg)
# instead of 9.6 and 4.4, 7.66 (pmg, pgg) instead of 6.4; references for longer pulses are those of that code.
while read -r c references; do
    width=16
    for reference in $references; do
        margin=$(compute "0.15 * ($reference > 1 ? $reference : 1)")
        apart "$c: reflected of $width spacings" "$(reflected "pulse_$c$width")" "$reference" "$margin"
        quiet "pulse_$c$width"
        width=$((2 * width))
    done
done <<'END'
handshake 1.7 2.4 1.9 0.87
pm 12.65 5.73
pg 12.65 5.73 1.8 0.90
pmg 7.66 2.7
pgg 7.66 2.7 2.1 0.96
undamped 6.4 1.1 0.42 0.13
END
# Energy change [%] at 32 spacings: zero for every linear coupling, up to the effect of changing weights.
while read -r c reference; do
    apart "$c: energy change" "$(compute "100 * $(f "pulse_${c}32" probes.pulse.energy_change)")" "$reference" 0.01
done <<'END'
handshake 0
pm 0
pg 0
pmg 0
pgg 0
undamped 0
END

# Partial stress: goals of 1.5 % at 32 and 0.6 % at 64 spacings. Interface damping reduces the reflection at every width, at the cost of the
# energy of short waves only.
between "partial: reflected of 32 spacings" "$(reflected pulse_partial32)" 0 1.5
between "partial: reflected of 64 spacings" "$(reflected pulse_partial64)" 0 0.6
for width in 16 32 64 128; do
    between "partial: damped against undamped, $width" \
        "$(reflected pulse_partial$width)" 0 "$(reflected pulse_undamped$width)"
    quiet pulse_partial$width
done
between "partial: energy change at 32" "$(f pulse_partial32 probes.pulse.energy_change)" -0.012 0
between "partial: energy change at 128" "$(f pulse_partial128 probes.pulse.energy_change)" -0.001 0
# At every position of the interface in its cell: at most 4.4, 0.84, 0.44 %.
for origin in 1 1.5; do
    between "node at $origin mm: reflected of 16" "$(reflected pulse_at$origin-16)" 0 6
    between "node at $origin mm: reflected of 32" "$(reflected pulse_at$origin-32)" 0 1.2
    between "node at $origin mm: reflected of 64" "$(reflected pulse_at$origin-64)" 0 0.7
    for width in 16 32 64; do quiet pulse_at$origin-$width; done
done
between "apic: reflected of 32" "$(reflected pulse_apic32)" 0 2
between "apic: reflected of 64" "$(reflected pulse_apic64)" 0 1.6

# Reflection between two wave speeds: (sqrt(4/3) - 1)/(sqrt(4/3) + 1) = 7.18 %; tolerance 0.5 for dispersion of the lattice and the
# coupling.
for c in handshake partial; do
    apart "stiff, $c: reflected of 128" "$(reflected pulse_stiff_$c)" 7.18 0.5
done

# ---- a loaded bar --------------------------------------------------------------------------------------------------

for c in $all; do bar "coupled_$c" bar_coupled -s "coupling=$(coupling $c)"; done
bar coupled_undamped bar_coupled -s interface_damping=0
# whole: the bar and its image beyond the fixed end.
line='probes=[line: {name: bar, from: [0.0025], to: [0.9975], points: 200}]'
both='boundary=[{traction: 1, face: x+}, {traction: -1, face: x-}]'
while read -r c cell; do
    at="-s mpm.shape=gimp -s mpm.origin=[${cell}mm] -s output.times=[12.5ms]"
    bar "half_$c$cell" bar_coupled -s "coupling=$c" $at -s "$line"
    bar "whole_$c$cell" bar_coupled -s "coupling=$c" $at -s "$line" -s "$both" -s 'body={box: {from: [-1], to: [1]}}' \
        -s 'pd.region={box: {from: -0.5, to: 0.5}}'
done <<'END'
pg 0
pgg 0
pgg 2.5
END
landed

# Error at 1.25 transit times at most 1.1 times the reference; displacement of the end within 0.2 %.
while read -r c error end; do
    between "$c: L1" "$(f "coupled_$c" probes.exact.L1)" 0 "$(compute "1.1 * $error")"
    apart "$c: end" "$(f "coupled_$c" probes.exact.end_displacement)" "$end" "$(compute "0.002 * $end")"
    quiet "coupled_$c"
done <<'END'
handshake 0.068 1.2467e-4
pm 0.077 1.2461e-4
pg 0.077 1.2461e-4
pmg 0.082 1.2467e-4
pgg 0.080 1.2467e-4
partial 0.068 1.2491e-4
undamped 0.068 1.2491e-4
END

# column_rms FOLDER COLUMN FROM TO: prints a root mean square at 7.5 ms over the particles between two positions [m]. For `velocity`: of
# (v_k-1 - 2 v_k + v_k+1)/4, the motion that alternates from particle k to its neighbours; for other columns: of the difference from the
# exact value.
column_rms()
{
    awk -F, -v name="$2" -v from="$3" -v to="$4" '
        FNR == 1 {
            for (k = 1; k <= NF; k++) {
                sub(/ \[.*/, "", $k); if ($k == name) at = k; if ($k == "exact_" name) exact = k; if ($k == "x") x = k }
            next
        }
        { place[++n] = $x; value[n] = $at; error[n] = $at - $exact }
        END {
            for (k = 2; k < n; k++) {
                if (place[k] < from + 0 || place[k] > to + 0) continue
                zigzag = (value[k - 1] - 2 * value[k] + value[k + 1]) / 4
                sum += name == "velocity" ? zigzag * zigzag : error[k] * error[k]; count++
            }
            if (count) printf "%.9g", sqrt(sum / count) }' "$work/$1/exact_000002.csv"
}

# Noise at the interface after the front has passed, in units of the wave's velocity (0.01 m/s): 4.2 % with a unified grid, 0.9 to 1.05 %
# without. The limit is 40 % away from both.
for c in $all; do
    zigzag=$(compute "100 * $(column_rms "coupled_$c" velocity 0.4 0.5)")
    case $c in
        pmg | pgg) between "$c: zig-zag of velocity behind the front [% x 0.01 m/s]" "$zigzag" 0.03 0.06 ;;
        *) between "$c: zig-zag of velocity behind the front [% x 0.01 m/s]" "$zigzag" 0.001 0.015 ;;
    esac
done
# The stress of material points that also carry bonds deviates by 16 to 18 %; with partial stress by 6.4 %.
for c in handshake pm pg pmg pgg; do
    between "$c: stress at the interface [Pa]" "$(column_rms "coupled_$c" stress 0.45 0.55)" 0.12 0.22
done
between "partial: stress at the interface [Pa]" "$(column_rms coupled_partial stress 0.45 0.55)" 0 0.09

# The images at a fixed end act as the other half of the bar, also for particles on the grid, with a node or the middle of a cell on the
# plane: displacements agree to the last digit written, 1e-13 of 1e-4 m.
for run in pg0 pgg0 pgg2.5; do
    quiet half_$run
    holds "$run: a whole bar was compared" test "$(f whole_$run particles)" = 400
    last=$(paste -d, "$work/half_$run/bar_000001.csv" "$work/whole_$run/bar_000001.csv" | awk -F, '
        NR > 1 { d = $3 - $(NF / 2 + 3); if (d < 0) d = -d; if (d > most) most = d; n++ }
        END { if (n == 200) printf "%.3g", most }')
    between "$run: half a bar against the whole" "$last" 0 1e-12
done

# ---- spallation ----------------------------------------------------------------------------------------------------

# struck FOLDER SPEED ARGUMENT...: starts a run in which the flyer hits the bar at this speed [m/s].
struck() { folder=$1 speed=$2; shift 2; bar "$folder" bar_spall -s "bodies[1].velocity=[-$speed]" "$@"; }

for c in pg handshake partial; do
    for v in 1.02 1.05; do struck "spall_$c$v" $v -s "coupling=$(coupling $c)"; done
done
for v in 0.9 1.0 1.1 1.3 1.7 2.0; do struck spall_pg$v $v; done
for v in 1.02 1.05; do
    struck spall_spline$v $v -s mpm.shape=quadratic
    struck spall_vmpd$v $v -s pd.calibration=vmpd
    struck spall_fine$v $v -s time.step=2us
done
struck spall_wide1.05 1.05 -s mpm.cell=2
struck spall_spline_vmpd1.05 1.05 -s mpm.shape=quadratic -s pd.calibration=vmpd
landed

for run in pg handshake partial spline vmpd fine wide spline_vmpd; do
    sound spall_${run}1.05 0.005             # FLIP damps the short waves of the steep fronts: 0.1 %
    # Tension starts at 0.2 m after 12 ms; the break follows when the overshoot behind the fronts arrives.
    between "$run: first break" "$(f spall_${run}1.05 probes.spall.first_time)" 12.2e-3 13.0e-3
    between "$run: place of it" "$(f spall_${run}1.05 probes.spall.x)" 0.185 0.215
    # No earlier break elsewhere.
    apart "$run: nothing before" "$(f spall_${run}1.05 probes.break.first_time)" \
        "$(f spall_${run}1.05 probes.spall.first_time)" 0
    between "$run: bonds" "$(f spall_${run}1.05 probes.spall.bonds)" 6 12
done
for run in pg handshake partial spline vmpd fine; do
    is "$run at 1.02: status" "$(f spall_${run}1.02 status)" done
    absent "$run at 1.02: break" "$(f spall_${run}1.02 probes.break.first_time)"
done
for v in 0.9 1.0; do absent "break at $v" "$(f spall_pg$v probes.break.first_time)"; done

# Faster flyers break the bar earlier: first break [transit times] within 0.01 of the reference, position within three particles.
while read -r v time x; do
    apart "$v m/s: first break" "$(f spall_pg$v probes.spall.first_time)" "$(compute "0.01 * $time")" 1e-4
    apart "$v m/s: place of it" "$(f spall_pg$v probes.spall.x)" "$x" 0.0125
done <<'END'
1.05 1.2655 0.2075
1.1 1.2515 0.195
1.3 1.2415 0.200
1.7 1.234 0.208
2.0 1.230 0.214
END

# Compression after 0.9 transit times, between its half-heights: exact 0.1 .. 0.5 m; tolerance 0.015 for dispersion of a front (as in
# test_bar.sh): 0.107 .. 0.4985 m.
half=$(compute "-0.25 * 100 * 1.05")
ends()
{
    awk -F, -v name=stress_xx -v half="$half" "$read_csv"'
        n++ && (stress - half) * ($at - half) < 0 {
            printf "%.6g ", place + ($x - place) * (half - stress) / ($at - stress) }
        { place = $x; stress = $at }' "$work/$1/bar_000001.csv"
}
for run in pg handshake partial spline vmpd; do
    set -- $(ends spall_${run}1.05)
    is "$run: ends of the compression" $# 2
    between "$run: head of the compression" "${1-}" 0.085 0.115
    between "$run: tail of the compression" "${2-}" 0.485 0.515
    between "$run: compression" "$(along spall_${run}1.05 stress_xx 0.15 0.45)" -54 -51       # 52.5 Pa, 3 %: oscillations
done

# ---- bitwise equality ----------------------------------------------------------------------------------------------

for c in pm partial; do
    calm "$work/threads_$c" inputs/bar_pulse.yaml -t 2 -s time.step=4us -s "coupling=$(coupling $c)"
    calm "$work/thread_$c" inputs/bar_pulse.yaml -t 1 -s time.step=4us -s "coupling=$(coupling $c)"
    same "$c on 2 threads" "$work/thread_$c" "$work/threads_$c"
done
# A bar whose particles enter and leave the grid, and break, stopped during the run.
slow="inputs/bar_spall.yaml -s mpm.cell=2 -s time.step=1us -s bodies[1].velocity=[-2]"
calm "$work/once" $slow -t 1
interrupted "$work/again" 120 $slow
calm "$work/again" --resume $slow -t 2
same "interrupted on its way" "$work/once" "$work/again"
holds "nothing broke, so nothing was tested" test -n "$(figure "$work/once" probes.break.first_time)"
finish
