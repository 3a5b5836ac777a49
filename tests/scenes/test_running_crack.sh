#!/bin/sh
# Cracks whose speed follows from their toughness. A semi-infinite crack loaded by plane waves is compared with the crack-tip equation of
# motion k(v) K_still(t) = K_Ic (Freund 1990). Two tips at once are each controlled by their own factors. Released energy, for prescribed
# and computed speed, is compared with A_I(v) K^2 (1 - nu^2)/E. Also threads and restarts.
test_name=test_running_crack
. tests/support/summary.sh
. tests/support/scenes.sh
. tests/support/trust.sh

# ---- the closed form ----------------------------------------------------------------------------------------------

# motion FOLDER SPEED TOUGHNESS FROM: compares a crack in glass under 2 MPa with its exact motion. Prints mean and root mean square of v -
# v_exact from 1 us after the start to 9 us, over the mean of v_exact; the length over the exact one at 9 us; the mean of K_eq/K_Ic from 6
# to 9 us; the energy released from FROM us to 9 us over that of A_I K^2. K = K_Ic, or k K_still for a prescribed SPEED > 0.
motion()
{
    awk -F, -v speed="$2" -v toughness="$3" -v from="$4" '
        function rayleigh_function(v, d, s) {
            d = sqrt(1 - v * v / cd / cd); s = sqrt(1 - v * v / cs / cs)
            return 4 * d * s - (1 + s * s) ^ 2
        }
        function universal(v, d, s) {
            if (v < 0.01 * cs) return 1
            d = sqrt(1 - v * v / cd / cd); s = sqrt(1 - v * v / cs / cs)
            return d * (1 - s * s) / (1 - nu) / rayleigh_function(v)
        }
        function factor(v, i, z, z2, sum) {          # Freund 1990, eq. 6.4.26, by the midpoint rule
            for (i = 0; i < 48; i++) {
                z = 0.5 * (1 / cd + 1 / cs) - 0.5 * (1 / cs - 1 / cd) * cos((i + 0.5) * pi / 48); z2 = z * z
                sum += atan2(4 * z2 * sqrt((z2 - 1 / cd / cd) * (1 / cs / cs - z2)), (1 / cs / cs - 2 * z2) ^ 2) * v / \
                    (1 - v * z) * 0.5 * (1 / cs - 1 / cd) * sin((i + 0.5) * pi / 48) / 48
            }
            return (1 - v / cR) / sqrt(1 - v / cd) * exp(sum)
        }
        function still(t) { return t > arrival ? 4e6 * sqrt(cd * (t - arrival) * (1 - 2 * nu) / pi) / (1 - nu) : 0 }
        function running(t, low, high, i) {
            if (still(t) <= toughness) return 0
            for (high = cR; i < 24; i++) {
                if (factor(0.5 * (low + high)) > toughness / still(t)) low = 0.5 * (low + high); else high = 0.5 * (low + high)
            }
            return 0.5 * (low + high)
        }
        BEGIN {
            pi = 3.14159265358979; E = 75.629e9; nu = 0.286; rho = 2456
            cd = sqrt(E * (1 - nu) / ((1 + nu) * (1 - 2 * nu)) / rho); cs = sqrt(E / 2 / (1 + nu) / rho)
            for (high = 0.9999 * cs; i < 60; i++) {
                if (rayleigh_function(0.5 * (cR + high)) > 0) cR = 0.5 * (cR + high); else high = 0.5 * (cR + high)
            }
            arrival = 0.02 / cd
            start = arrival + (toughness * (1 - nu) / 4e6) ^ 2 * pi / (cd * (1 - 2 * nu))
        }
        NR == 1 { for (k = 1; k <= NF; k++) { sub(/ \[.*/, "", $k); at[$k] = k } next }
        {
            t = $1 + 0; v = $at["growth.speed"] + 0; length_now = $at["growth.length"] + 0; fracture = $at["fracture"] + 0
            exact = speed > 0 ? speed : running(t)
            if (t <= 9.001e-6) { covered += 0.5 * (exact + exact_before) * (t - t_before); grown = length_now }
            if (t >= start + 1e-6 && t <= 9.001e-6) { n++; off += v - exact; off2 += (v - exact) ^ 2; mean += exact }
            if (t >= 6e-6 && t <= 9.001e-6) { m++; K += $at["sif.K_I"] / toughness }
            G = universal(v) * (speed > 0 ? factor(speed) * still(t) : toughness) ^ 2 * (1 - nu * nu) / E
            if (t_before >= from * 0.99999e-6 && t <= 9.001e-6) {
                energy += 0.5 * (G + G_before) * (length_now - length_before); released += fracture - fracture_before
            }
            t_before = t; exact_before = exact; G_before = G; length_before = length_now; fracture_before = fracture
        }
        END { printf "%.5f %.5f %.5f %.5f %.5f\n", off / mean, sqrt(off2 / n) / (mean / n), grown / covered, K / m,
            released / 1e-3 / energy }' "$work/$1/history.csv"
}
part() { echo "$1" | cut -d ' ' -f "$2"; }

# narrow SPACING STEP: writes the scene with this spacing [mm] and step [ns] in a plate of about 48 mm instead of 60 mm. The wave emitted by
# the tip at 3.16 us, when the load arrives, returns from the lateral mirrors to the ring of 8 mm around the moved tip at 9.1 us, after the
# last sample.
narrow()
{
    low=$(compute "30 - $1 * int(23.5 / $1 + 0.01)") high=$(compute "30 + $1 * int(25 / $1 + 0.01)")
    sed "s/from: \[0, -20 mm\], to: \[60 mm/from: [$low mm, -20 mm], to: [$high mm/; s/at: 0}/at: $low mm}/; s/at: 60 mm}/at: $high mm}/
         s/from: \[-1 mm, 0\]/from: [5 mm, 0]/; s/spacing: 0.25 mm/spacing: $1 mm/; s/step: 20 ns/step: $2 ns/" \
        inputs/running_crack.yaml >"$work/narrow_$1.yaml"
}
narrow 0.4 40
narrow 0.5 50
start follow "$work/narrow_0.4.yaml" -s growth[0].damping=1.6mm
start mospd "$work/narrow_0.5.yaml" -s growth[0].damping=2mm -s model=mospd
wait
# The released energy at a prescribed speed of 1000 m/s is in test_growth.sh.
start fast "$work/narrow_0.5.yaml" -s "growth=[{at: [30 mm, 0], direction: [1, 0], speed: 1500 m/s, start: 4.4 us, damping: 2 mm}]"
wait
# Measured at 0.4 mm, and with mospd at 0.5 mm (horizons of 1.6 and 2 mm): mean speed 4 and 5 % too large, 7 % root mean square for both,
# length 1.01 and 1.02, energy 0.97 and 1.00 (ospd at 0.5 mm: 0.94). K is measured with the delay of a process zone and increases all the
# time: 10 and 13 % above K_Ic, 6 % at 0.25 mm, 2 % at 0.125 mm. A law that associates the current speed with the measured factors
# oscillates by 25 % root mean square.
for run in follow mospd; do
    found=$(motion $run 0 0.25e6 7)
    between "$run: mean speed" "$(part "$found" 1)" -0.08 0.08
    between "$run: speed, rms" "$(part "$found" 2)" 0.001 0.12
    between "$run: length" "$(part "$found" 3)" 0.95 1.05
    between "$run: K_eq over K_Ic" "$(part "$found" 4)" 1 1.13
    between "$run: energy released" "$(part "$found" 5)" 0.95 1.05
    between "$run: first growth" "$(f $run probes.growth.start_time)" 5.3e-6 5.8e-6      # exact: 5.478 us
    sound $run 0.005
done
# Bonds that are released over a horizon; over half of one the faster crack radiates a seventh of its energy as waves.
between "released at 1500 m/s" "$(part "$(motion fast 1500 0.25e6 6)" 5)" 0.95 1.05

# ---- threads, restarts ------------------------------------------------------------------------------------------------

small="inputs/running_crack.yaml -s particles.spacing=0.8mm -s time.step=50ns -s output.samples=92 -s output.frames=4
    -s growth[0].damping=3.2mm"
calm "$work/once" -t 1 $small
calm "$work/threads" -t 2 $small
same "follows: threads" "$work/once" "$work/threads"
# Stopped at 7.5 us or later, during growth.
interrupted "$work/stop" 76 $small
calm "$work/stop" -t 1 --resume $small
same "follows: in the middle of its way" "$work/once" "$work/stop"
between "it moves there" "$(column "$work/once" growth.speed 7.5e-6)" 200 2000

# ---- two tips at once ------------------------------------------------------------------------------------------------

# The automatic step, 0.37 us, would move a tip of 2000 m/s by a third of the length over which bonds are released: an energy error of 2 %,
# 0.15 % with these steps. Spacings of 5/3 mm place the notches between rows; rings of 5 to 10 mm are three spacings wide.
short="-s duration=50us -s time.step=0.25us -s output.samples=200 -s output.frames=3 -s particles.spacing=5/3mm -s particles.horizon=3"
short="$short -s probes[0].sif.outer=10mm -s probes[0].sif.contours=[10mm]"
whole="inputs/kalthoff_sif_whole.yaml $short -s probes[1].sif.outer=10mm -s probes[1].sif.contours=[10mm]"
follow="-s growth[0].speed=follow -s growth[1].speed=follow"
start half kalthoff_sif $short
start pair_given $whole
wait
calm "$work/pair" -t 2 $whole $follow
interrupted "$work/pair_stop" 128 $whole $follow
calm "$work/pair_stop" -t 1 --resume $whole $follow
same "two tips" "$work/pair" "$work/pair_stop"

# mirrored FOLDER: prints the largest deviation of the two tips, and of their lengths, from mirror symmetry at any time [m].
mirrored()
{
    awk -F, '
        NR == 1 { for (k = 1; k <= NF; k++) { sub(/ \[.*/, "", $k); at[$k] = k } next }
        {
            d = $at["upper_growth.x"] - $at["lower_growth.x"]; if (d < 0) d = -d; if (d > most) most = d
            d = $at["upper_growth.y"] + $at["lower_growth.y"]; if (d < 0) d = -d; if (d > most) most = d
            if ($at["upper_growth.length"] > 5e-3) n++
        }
        END { if (n > 20) print most + 0 }' "$work/$1/history.csv"
}
# history.csv has ten digits.
for run in pair_given pair; do
    between "$run: symmetry" "$(mirrored $run)" 0 1e-9
    between "$run: sides" "$(compute "$(f $run probes.upper_growth.y) + $(f $run probes.lower_growth.y)")" -1e-9 1e-9
    sound $run 0.01
done
# The plate cut along its line of symmetry, with a layer of images as the other half.
for axis in x y; do
    apart "beside half a plate, $axis" "$(f pair_given probes.upper_growth.$axis)" "$(f half probes.growth.$axis)" 5e-4
done
followed=$(f pair probes.upper_growth.length_end) given=$(f pair_given probes.upper_growth.length_end)
between "faster where K asks for it" "$(compute "$followed / $given")" 1.5 2.5
finish
