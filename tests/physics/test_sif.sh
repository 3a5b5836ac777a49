#!/bin/sh
# Stress-intensity factors compared with closed forms. A plate whose crack is hit by plane waves from both sides is a semi-infinite crack
# that is suddenly loaded, until the first reflection arrives; with bonds, and with material points and a gap as crack. Further: a slowly
# loaded plate with an edge crack, and a crack under a body force.
test_name=test_sif
. tests/support/summary.sh
. tests/support/scenes.sh

# wave FILE METHOD BODY: writes the common part of both scenes; the rest is on standard input.
wave()
{
    cat - >"$work/rest" && cat >"$work/$1.yaml" <<END
space: plane strain
thickness: 1 mm
duration: 9.2 us
method: $2
material: {young: 75.629 GPa, poisson: 0.25, density: 2456 kg/m^3}
body: $3
particles: {spacing: 0.5 mm}
boundary:
  - {mirror: {axis: x, at: 0}}
  - {mirror: {axis: x, at: 40 mm}}
  - {name: up, region: {box: {from: [-inf, 19 mm], to: [inf, inf]}}, traction: [0, 1 MPa], face: y+}
  - {name: down, region: {box: {from: [-inf, -inf], to: [inf, -19 mm]}}, traction: [0, -1 MPa], face: y-}
output: {frames: 0, samples: 47}
$(cat "$work/rest")
END
}
wave bonds pd '{box: {from: [0, -20 mm], to: [40 mm, 20 mm]}}' <<'END'
pd: {surface: volume}
cracks: [{from: [-20 mm, 0], to: [20 mm, 0]}]
probes:
  - sif
  - sif: {name: stress, stress: particle}
  - sif: {name: pddo, gradient: pddo, weight: cubic}
END
wave points mpm '[{box: {from: [0, -20.25 mm], to: [40 mm, 20.25 mm]}},
       {subtract: {box: {from: [-20 mm, -1.25 mm], to: [20 mm, 1.25 mm]}}}]' <<'END'
probes:
  - sif: {at: [20 mm, 0], direction: [1, 0], outer: 14 mm}
END
cat >"$work/edge.yaml" <<'END'
space: plane stress
thickness: 1 mm
duration: 200 us
method: pd
material: {young: 70 GPa, density: 2450 kg/m^3}
body: {box: {from: [0, -5 mm], to: [10 mm, 5 mm]}}
particles: {spacing: 0.2 mm}
cracks: [{from: [-1 mm, 0], to: [5 mm, 0]}]
boundary:
  - {region: {box: {from: [-inf, 4.5 mm], to: [inf, inf]}}, traction: [0, 1 MPa], face: y+,
     time: {ramp: {until: 150 us}}}
  - {region: {box: {from: [-inf, -inf], to: [inf, -4.5 mm]}}, traction: [0, -1 MPa], face: y-,
     time: {ramp: {until: 150 us}}}
output: {frames: 0, samples: 400}
probes: [sif: {outer: 4 mm}]
END
start bonds "$work/bonds.yaml"
start points "$work/points.yaml"
wait
start edge "$work/edge.yaml"
start again "$work/bonds.yaml" -t 2
wait

# farthest FOLDER PROBE: prints the largest |K_I/K - 1| over the samples from 5 to 9 us, with the closed form K = 2 s sqrt(c t (1 - 2
# nu)/pi)/(1 - nu) (Freund 1990), s = 2 MPa, and t the time since the waves have travelled 20 mm; words if there are fewer than 15 samples.
farthest()
{
    awk -F, -v name="$2.K_I" '
        NR == 1 { for (k = 1; k <= NF; k++) { sub(/ \[.*/, "", $k); if ($k == name) at = k } next }
        $1 >= 5e-6 && $1 <= 9e-6 {
            c = sqrt(75.629e9 * 0.75 / (1.25 * 0.5) / 2456)
            K = 4e6 * sqrt(c * ($1 - 0.02 / c) * 0.5 / 3.14159265358979) / 0.75
            off = $at / K - 1; if (off < 0) off = -off
            if (off > most) most = off
            n++
        }
        END { print n < 15 ? "too few samples" : most + 0 }' "$work/$1/history.csv"
}

# Measured: 2.5 % at 0.5 mm and 1.2 % at 0.25 mm, with material points 2 %; the tolerance is 3 %.
for probe in sif stress pddo; do
    between "bonds: K_I by $probe" "$(farthest bonds $probe)" 0 0.03
done
between "points: K_I" "$(farthest points sif)" 0 0.03
# With an error in the inertia term rings would differ by 20 %.
for folder in bonds points; do
    between "$folder: contours" "$(column "$work/$folder" sif.contour_spread 8.5e-6)" 0 0.005
done
between "bonds: K_II" "$(f bonds probes.sif.K_II)" -1 1
between "bonds: J" "$(compute "$(f bonds probes.sif.J) * 75.629e9/(1 - 0.0625)/$(f bonds probes.sif.K_I)^2")" 0.97 1.03
cmp -s "$work/bonds/history.csv" "$work/again/history.csv" && pass || fail "threads change stress-intensity factors"

# An edge crack half through a square: 3.009 sigma sqrt(pi a) by boundary collocation; means over the vibrations under full load. 50
# particles across: 3.5 % too large (100: 1.6 %), because bonds are soft at surfaces and crack faces.
mean=$(awk -F, 'NR == 1 { for (k = 1; k <= NF; k++) if ($k ~ /^sif.K_I /) at = k; next }
    $1 > 150e-6 { sum += $at; n++ } END { print sum / n }' "$work/edge/history.csv")
between "edge crack: K_I" "$(compute "$mean/(3.009 * 1e6 * sqrt(3.14159265 * 5e-3))")" 1.02 1.05
between "edge crack: contours" "$(column "$work/edge" sif.contour_spread 2e-4)" 0 0.004

# A crack in the middle of a square with a body force along the crack balanced by sigma_xx only, which does not change K_I: 1.1232 sigma
# sqrt(pi a) by boundary collocation, for every ring; tolerance 2 % with 30 particles across the crack. Without the term of the body force:
# 1.17 with the wide ring. Half of the force is gravity, half of that varies in time.
cat >"$work/body.yaml" <<'END'
space: plane stress
thickness: 0.7 mm
duration: 1 s
method: pd
model: mospd
pd: {normalisation: local}
solver: cg
gravity: [12738.853503, 0]
material: {young: 200 GPa, poisson: 0.3, density: 7850}
body: {box: {from: [0, 0], to: [20 mm, 20 mm]}}
particles: {spacing: 0.2 mm, horizon: 1.5}
cracks: [{from: [7 mm, 10 mm], to: [13 mm, 10 mm]}]
boundary:
  - {traction: [0, 1 MPa], face: y+}
  - {traction: [0, -1 MPa], face: y-}
  - {body_force: [2e8, 0], time: {ramp: {until: 2 s}}}
  - {traction: [-4 MPa, 0], face: x-}
output: {frames: 0}
probes: [sif: {name: wide, at: [13 mm, 10 mm], outer: 3 mm}, sif: {name: near, at: [13 mm, 10 mm], outer: 2.2 mm}]
END
"$cleave" run "$work/body.yaml" -o "$work/body" -q 2>/dev/null || fail "body force: it fails"
for ring in wide near; do
    between "body force: K_I, $ring ring" "$(compute "$(f body probes.$ring.K_I)/(1e6 * sqrt(3.14159265 * 3e-3))")" 1.10 1.146
    between "body force: J, $ring ring" "$(compute "$(f body probes.$ring.J) * 200e9/$(f body probes.$ring.K_I)^2")" 0.98 1.02
done
finish
