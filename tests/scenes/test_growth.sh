#!/bin/sh
# Cracks with prescribed growth: stress-intensity factors, released energy and oscillations against the closed form (Freund 1990), with
# and without transition bonds (Imachi et al. 2019). Also bitwise equality on any number of threads and after a stop during the release of
# bonds, in peridynamics and among material points; refusals.
test_name=test_growth
. tests/support/summary.sh
. tests/support/scenes.sh
. tests/support/trust.sh
moving=inputs/semi_infinite_crack.yaml
fast="-s output.samples=92 -s time.step=40ns"

# crack REST: prints the key `growth` of that scene with further keys.
crack() { echo "growth=[{at: [30 mm, 0], direction: [1, 0], speed: 1000 m/s, start: 4.4 us$1}]"; }

# ---- results -------------------------------------------------------------------------------------------------------

# On 1 thread each.
# narrow SPACING: writes the scene with this spacing [mm] in a plate of about 48 mm instead of 60 mm. The wave emitted by the tip at 3.16
# us, when the load arrives, returns from the lateral mirrors to the ring of 8 mm around the moved tip at 9.1 us, after the last sample.
narrow()
{
    low=$(compute "30 - $1 * int(23.5 / $1 + 0.01)") high=$(compute "30 + $1 * int(25 / $1 + 0.01)")
    sed "s/from: \[0, -20 mm\], to: \[60 mm/from: [$low mm, -20 mm], to: [$high mm/; s/at: 0}/at: $low mm}/; s/at: 60 mm}/at: $high mm}/
         s/from: \[-1 mm, 0\]/from: [5 mm, 0]/; s/spacing: 0.25 mm/spacing: $1 mm/" "$moving" >"$work/narrow_$1.yaml"
}
narrow 0.4
narrow 0.5
start moving "$work/narrow_0.4.yaml" $fast
start rest "$work/narrow_0.4.yaml" -s growth= $fast
wait
start sudden "$work/narrow_0.5.yaml" -s "$(crack ', damping: 0')" $fast
start coarse "$work/narrow_0.5.yaml" $fast
wait

# factors FOLDER PROBE FROM: prints, for FROM us to 9 us, the smallest and largest K/K_rest, the root mean square deviation of K from a
# quadratic fit divided by its mean, and the number of samples. K_rest = 2 s sqrt(c (t - H/c)(1 - 2 nu)/pi)/(1 - nu) with s = 2 MPa, twice
# the traction of each edge.
factors()
{
    awk -F, -v name="$2.K_I" -v from="$3" '
        NR == 1 { for (k = 1; k <= NF; k++) { sub(/ \[.*/, "", $k); if ($k == name) at = k } next }
        $1 >= from * 0.999999e-6 && $1 <= 9.000001e-6 {
            c = sqrt(75.629e9 * (1 - 0.286) / (1.286 * (1 - 2 * 0.286)) / 2456)
            K = 4e6 * sqrt(c * ($1 - 0.02 / c) * (1 - 2 * 0.286) / 3.14159265358979) / (1 - 0.286)
            q = $at / K
            if (n == 0 || q < low) low = q
            if (n == 0 || q > high) high = q
            x[n + 0] = ($1 - 7e-6) / 2e-6; y[n + 0] = $at; mean += $at; n++
        }
        END {
            mean /= n
            for (k = 0; k < n; k++) {
                z = x[k] * x[k]
                s1 += x[k]; s2 += z; s3 += z * x[k]; s4 += z * z
                b0 += y[k]; b1 += y[k] * x[k]; b2 += y[k] * z
            }
            # Cramer on [n s1 s2; s1 s2 s3; s2 s3 s4]
            D = n * (s2 * s4 - s3 * s3) - s1 * (s1 * s4 - s3 * s2) + s2 * (s1 * s3 - s2 * s2)
            p0 = (b0 * (s2 * s4 - s3 * s3) - s1 * (b1 * s4 - s3 * b2) + s2 * (b1 * s3 - s2 * b2)) / D
            p1 = (n * (b1 * s4 - s3 * b2) - b0 * (s1 * s4 - s3 * s2) + s2 * (s1 * b2 - b1 * s2)) / D
            p2 = (n * (s2 * b2 - b1 * s3) - s1 * (s1 * b2 - b1 * s2) + b0 * (s1 * s3 - s2 * s2)) / D
            for (k = 0; k < n; k++) e += (y[k] - p0 - p1 * x[k] - p2 * x[k] * x[k]) ^ 2
            printf "%.6f %.6f %.6f %d\n", low, high, sqrt(e / n) / mean, n
        }' "$work/$1/history.csv"
}
part() { echo "$1" | cut -d ' ' -f "$2"; }

# Measured at rest 0.972 .. 1.009, required 3 %. The exact factor of speed at 1000 m/s is 0.8022; measured 0.796 .. 0.832, required 5 %,
# which excludes the printed approximation, 0.7495, in the mean.
found=$(factors rest sif 5)
between "at rest: least" "$(part "$found" 1)" 0.97 1.03
between "at rest: largest" "$(part "$found" 2)" 0.97 1.03
between "at rest: samples" "$(part "$found" 4)" 38 42
found=$(factors moving sif 5.5)
between "moving: least" "$(part "$found" 1)" "$(compute 0.95*0.8022)" "$(compute 1.05*0.8022)"
between "moving: largest" "$(part "$found" 2)" "$(compute 0.95*0.8022)" "$(compute 1.05*0.8022)"
between "moving: samples" "$(part "$found" 4)" 33 37

# Full disc, as printed in the paper; measured 0.30 of it.
with=$(part "$(factors coarse disc 5)" 3) without=$(part "$(factors sudden disc 5)" 3)
between "oscillation, transition bonds over sudden release" "$(compute "$with / $without")" 0.01 "$(compute 1/3)"

# Energy released per area from 5.5 to 9 us over A_I k^2 K_rest^2 (1 - nu^2)/E, with the mean of K_rest^2: measured 0.980. Immediate release
# leaves a sixth of it in waves of the lattice.
area_energy()
{
    compute "($(column "$work/$1" fracture 9e-6) - $(column "$work/$1" fracture 5.5e-6)) / 3.5e-6 / (1.06758 * 0.8022^2 * \
        16e12 * 6320.3 * (7.25e-6 - 3.16441e-6) * 0.428 / 3.14159265 / 0.714^2 * (1 - 0.286^2) / 75.629e9)"
}
between "energy released" "$(area_energy moving)" 0.95 1.05
between "energy released suddenly" "$(area_energy sudden)" 0.75 0.9
# The dissipation of gradual release is recorded to second order in the step: errors of 1e-4 and 3e-4 measured; 3e-3 to first order.
for folder in moving rest sudden coarse; do sound $folder 0.001; done
between "K_II" "$(compute "$(f moving probes.sif.K_II) / $(f moving probes.sif.K_I)")" -1e-3 1e-3

# ---- load and displacement -----------------------------------------------------------------------------------------

# At twice the spacing and step of the scene.
double="-s particles.spacing=0.8mm -s time.step=0.1us"
start pull load_displacement $double
start pull_sudden load_displacement $double \
    -s "growth=[{at: [12 mm, 0], direction: [1, 0], speed: 34.6 m/s, start: 20 us, damping: 0}]"
wait

# shaking FOLDER: prints the root mean square deviation of the reaction from its own parabola over 25 samples, 22 to 78 us, divided by the
# last reaction.
shaking()
{
    awk -F, '
        NR == 1 { for (i = 1; i <= NF; i++) if ($i ~ /^reaction.force_y/) column = i }
        NR > 1 { t[NR - 1] = $1; force[NR - 1] = $column; n = NR - 1 }
        END {
            for (j = -12; j <= 12; j++) { s0++; s2 += j * j; s4 += j ^ 4 }
            for (i = 13; i <= n - 12; i++) {
                if (t[i] < 22e-6 || t[i] > 78e-6) continue
                b0 = b2 = 0
                for (j = -12; j <= 12; j++) { b0 += force[i + j]; b2 += force[i + j] * j * j }
                sum += (force[i] - (b0 * s4 - b2 * s2) / (s0 * s4 - s2 * s2)) ^ 2
                m++
            }
            print (m > 250 ? sqrt(sum / m) / force[n] : "too few")
        }' "$work/$1/history.csv"
}
# Measured: 0.015 % and 0.61 %.
between "reaction, transition bonds" "$(shaking pull)" 0 0.0005
between "reaction, sudden release" "$(shaking pull_sudden)" 0.003 0.02
sound pull 0.001

# ---- threads, restarts, material points ----------------------------------------------------------------------------

small="$moving -s particles.spacing=0.8mm -s time.step=50ns -s output.frames=4 -s output.samples=92"
for method in pd adaptive; do
    calm "$work/$method" -t 1 $small -s method=$method
    between "$method momentum" "$(f $method momentum_error)" 0 1e-12
    between "$method energy" "$(f $method energy.balance_error)" -0.002 0.002
done
# pd alone: test_running_crack.sh.
calm "$work/again" -t 2 $small -s method=adaptive
same "adaptive: threads" "$work/adaptive" "$work/again"
# Stopped at 6 us or later, during the release of bonds.
interrupted "$work/stop" 62 $small -s method=adaptive
calm "$work/stop" -t 1 --resume $small -s method=adaptive
same "adaptive: in the middle of fading" "$work/adaptive" "$work/stop"
# Particles convert only ahead of the tip.
early=$(column "$work/adaptive" particles_pd 4.3e-6) late=$(column "$work/adaptive" particles_pd 9e-6)
between "converted ahead of the tip" "$(compute "$late - $early")" 30 400
between "adaptive: K_I" "$(compute "$(column "$work/adaptive" sif.K_I 8.5e-6) / $(column "$work/pd" sif.K_I 8.5e-6)")" 0.97 1.03
between "adaptive: released" "$(compute "$(column "$work/adaptive" fracture 9e-6) / $(column "$work/pd" fracture 9e-6)")" \
    0.97 1.03

# ---- refusals ------------------------------------------------------------------------------------------------------

# refuse KEYS WORDS [ARGUMENT...]: checks that a scene whose growth has these keys is refused in one line with position and reason.
refuse()
{
    keys=$1 words=$2; shift 2
    sed "s|^  - {at: \[30 mm, 0\].*|  - {$keys}|" "$moving" >"$work/bad.yaml"
    "$cleave" check "$work/bad.yaml" "$@" >"$work/out" 2>"$work/err"
    is "$keys: exit status" $? 2
    is "$keys: lines" "$(wc -l <"$work/err")" 1
    holds "$keys: says '$(cat "$work/err")', not '$words'" grep -q "bad.yaml:[0-9]*:[0-9]*: .*$words" "$work/err"
}
good="at: [30 mm, 0], direction: [1, 0], speed: 1000 m/s"
refuse "direction: [1, 0], speed: 1000 m/s" "at"
refuse "at: [30 mm, 0], speed: 1000 m/s" "direction"
refuse "at: [30 mm, 0], direction: [1, 0]" "speed"
refuse "at: [30 mm, 0], direction: [0, 0], speed: 1000 m/s" "has the length 0"
refuse "at: [30 mm, 0, 0], direction: [1, 0], speed: 1000 m/s" "at"
refuse "at: [30 mm, 0], direction: [1, 0], speed: 0 m/s" "speed"
refuse "at: [30 mm, 0], direction: [1, 0], speed: 3 mm" "speed"
refuse "$good, damping: -1 mm" "damping"
refuse "$good, exponent: 0" "exponent"
refuse "$good, length: 0 mm" "length"
refuse "$good, start: -1 us" "start"
refuse "$good, probe: none" "the scene has no sif probe none"
refuse "$good, toughness: 1 MPa m^0.5" "without the key probe"
follow="at: [30 mm, 0], direction: [1, 0], speed: follow"
refuse "$follow" "needs a sif probe (key probe) and toughness"
refuse "$follow, probe: sif" "needs a sif probe (key probe) and toughness"
refuse "$follow, toughness: 1 MPa m^0.5" "without the key probe"
refuse "$follow, probe: sif, toughness: 1 MPa m^0.5, fastest: 0 m/s" "fastest"
refuse "$good, fastest: 900 m/s" "has no effect with a given speed"
refuse "$good, colour: red" "colour"
refuse "$good" "method: mpm has no bonds" -s method=mpm
# Bonds that have yielded and fade behind the tip: their plastic work stays on the account. Without it 4.6 % of the energy would be missing.
cat >"$work/yields.yaml" <<'END'
space: plane strain
thickness: 2 mm
duration: 20 us
method: pd
material: {young: 72 GPa, density: 2440 kg/m^3, yield_stress: 15 MPa, yield_hardening: 10 GPa}
body: {box: {from: [0, -10 mm], to: [40 mm, 10 mm]}}
particles: {spacing: 1 mm}
cracks: [{from: [0, 0.3 mm], to: [15 mm, 0.3 mm]}]
growth: [{at: [15 mm, 0.3 mm], direction: [1, 0], start: 4 us, speed: 900 m/s}]
boundary:
  - {traction: [0, 12 MPa], face: y+, time: {ramp: {until: 3 us}}}
  - {fixed: all, face: y-}
output: {frames: 0}
END
holds "run" "$cleave" run "$work/yields.yaml" -t 1 -q -o "$work/yields" >"$work/out" 2>&1
between "energy of bonds that yield" "$(f yields energy.balance_error)" -3e-4 3e-4
between "their plastic work over the work of the load" "$(compute "$(f yields energy.plastic) / $(f yields energy.external_work)")" 0.1 0.2

# A SIF-driven crack requires the probe of its own tip.
sed 's/at: \[50 mm, 25 mm\]/at: [50 mm, 30 mm]/' inputs/kalthoff_sif.yaml >"$work/bad.yaml"
"$cleave" check "$work/bad.yaml" >"$work/out" 2>"$work/err"
is "a tip of another crack: exit status" $? 2
holds "a tip of another crack: says '$(cat "$work/err")'" grep -q 'probe "sif" controls the growth rule growth0, but measures.*(0.05, 0.025)' "$work/err"
finish
