#!/bin/sh
# Load steps of yielding material points against closed forms: the bilinear curve of a bar with permanent strain and reversed flow, the
# moment of a beam, a thick-walled cylinder. Their energies for any number of steps, bitwise equality on any number of threads and after
# stops between any two load steps, refusals.
test_name=test_steps_yield
. tests/support/summary.sh
. tests/support/trust.sh
export OMP_WAIT_POLICY=passive

# A bar of 20 by 8 mm under uniform extension to a strain of 0.006, three times the yield strain, followed by compression.
cat >"$work/bar.yaml" <<'END'
space: plane stress
thickness: 1 mm
duration: 1 s
method: mpm
solver: static
steps: {number: 12}
material: {young: 200 GPa, poisson: 0.3, density: 7850 kg/m^3, yield_stress: 400 MPa, yield_tangent: 20 GPa}
body: {box: {from: [0, 0], to: [20 mm, 8 mm]}}
particles: {spacing: 1 mm}
boundary:
  - {name: right, displacement: ["0.006*x", free], face: x+, time: {table: [[0 s, 0], [0.5 s, 1], [1 s, -1]]}}
  - {name: left, mirror: {axis: x, at: 0}}
  - {name: below, mirror: {axis: y, at: 0}}
probes: [{reaction: {boundary: right}}]
output: {frames: 2}
END
bar=$work/bar.yaml
sed -e 's/^space: .*/space: solid/; /^thickness/d; s/poisson: 0.3/poisson: 1\/4/; s/free\]/free, free]/; s/from: \[0, 0\], to: \[20 mm, 8 mm\]/from: [0, 0, 0], to: [20 mm, 8 mm, 6 mm]/' \
    -e 's/^  - {name: below.*/&\n  - {name: back, mirror: {axis: z, at: 0}}/' "$bar" >"$work/solid.yaml"
sed -e 's/^space: .*/space: line/; /^thickness/d; s/poisson: 0.3, //; s/, free\]/]/; s/\[0, 0\]/[0]/; s/, 8 mm\]/]/; /below/d' "$bar" >"$work/line.yaml"

# ---- the bilinear curve ----------------------------------------------------------------------------------------------

# curve WHAT SCENE AREA VOLUME: checks the stress of a bar loaded to 480 MPa, unloaded and loaded in the opposite direction, where it
# yields at -480 MPa with the same slope up to -624 MPa; and its energies. AREA: section [m^2]; VOLUME [m^3].
curve()
{
    to=$work/$1
    calm "$to" "$2" -t 1
    for point in 0.0833333334,200e6 0.25,420e6 0.333333334,440e6 0.5,480e6 0.583333334,80e6 0.66666667,-320e6 0.75,-504e6 1,-624e6; do
        near "$1: stress at ${point%,*}" "$(column "$to" reaction.force_x "${point%,*}")" "$(compute "${point#*,}*$3")" 1e-5
    done
    # Plastic work sigma_y a + H a^2/2 with H = E E_t/(E - E_t); a = 0.0036 at 480 MPa, 0.01008 at 624 MPa.
    near "$1: strain energy" "$(column "$to" strain 0.5)" "$(compute "480e6^2/400e9*$4")" 1e-5
    near "$1: plastic work" "$(column "$to" plastic 0.5)" "$(compute "(400e6*0.0036 + 20e9/1.8*0.0036^2)*$4")" 1e-5
    near "$1: plastic work at the end" "$(column "$to" plastic 1)" "$(compute "(400e6*0.01008 + 20e9/1.8*0.01008^2)*$4")" 1e-5
    near "$1: work" "$(column "$to" external_work 0.5)" "$(compute "(480e6^2/400e9 + 400e6*0.0036 + 20e9/1.8*0.0036^2)*$4")" 1e-3
    apart "$1: nothing is lost" "$(figure "$to" energy.damped)" 0 "$(compute "1e-3*$4*400e6*0.01")"
    apart "$1: balance" "$(figure "$to" energy.balance_error)" 0 1e-3
}
curve plane "$bar" 8e-6 160e-9
curve solid "$work/solid.yaml" 48e-6 960e-9
curve line "$work/line.yaml" 1 0.02

# Equal states for any number of steps; with 2 and 4 of them the first one ends beyond yielding. A bar that is reversed does not turn its flow.
for steps in 2 4 60; do
    calm "$work/bar$steps" "$bar" -t 1 -s steps.number=$steps
    near "$steps steps: stress" "$(column "$work/bar$steps" reaction.force_x 0.5)" 3840 1e-5
    near "$steps steps: at the end" "$(column "$work/bar$steps" reaction.force_x 1)" -4992 1e-5
    near "$steps steps: plastic work" "$(column "$work/bar$steps" plastic 1)" "$(column "$work/plane" plastic 1)" 1e-5
    apart "$steps steps: balance" "$(figure "$work/bar$steps" energy.balance_error)" 0 1e-3
done

# Two materials in series, of which one yields: one end moves by 9.5 mm times 0.0115, the other by 10 mm times that and 7.5 mm times 0.004.
sed -e 's/^material: .*/materials:\n  - {name: soft, young: 200 GPa, density: 7850, yield_stress: 300 MPa, yield_tangent: 10 GPa}\n  - {name: hard, young: 100 GPa, density: 7850}/' \
    -e 's/^body: .*/bodies: [{name: bar, material: soft, shape: {box: {from: [0], to: [20 mm]}}, parts: [{region: {box: {from: [10 mm], to: [30 mm]}}, material: hard}]}]/' \
    -e 's/displacement: .*/traction: [400 MPa], face: x+, time: {ramp: {until: 1 s}}}/; s/^probes.*/probes: [{point: {name: middle, at: [9.5 mm]}}, {point: {name: end, at: [17.5 mm]}}]/; s/number: 12/number: 5/' "$work/line.yaml" >"$work/series.yaml"
calm "$work/series" "$work/series.yaml" -t 1
near "series: elastic" "$(column "$work/series" end.displacement_x 0.6)" 3e-5 1e-5
near "series: the soft half" "$(column "$work/series" middle.displacement_x 1)" 1.0925e-4 1e-5
near "series: the whole" "$(column "$work/series" end.displacement_x 1)" 1.45e-4 1e-5

# The table of the bar has a peak at half of the duration: an odd number of steps skips it.
"$cleave" check "$bar" -s steps.number=7 >"$work/peak" 2>&1
holds "a peak between steps" grep -q 'accuracy  *the loads peak at t = 0.5 s, between two of the 7 load steps, so no load step reaches the peak; set steps.number: 8, ' "$work/peak"
"$cleave" check "$bar" >"$work/peak" 2>&1
holds "a peak at the end of a step" sh -c "! grep -q 'loads peak' '$work/peak'"

# Permanent set: zero stress at a strain of 0.006 - 480 MPa/E.
calm "$work/set" "$bar" -t 1 -s steps.number=20
apart "permanent set" "$(column "$work/set" reaction.force_x 0.6)" 0 1e-2

# Control by an opening: the stress at a strain of 0.01 is 400 MPa + 2 GPa (0.01 - 0.002), a hundredth as stiff as before it yields. The
# opening is met to 1e-4; equilibria to 1e-5 of 416 MPa leave 2e-6 of strain, 2e-4 of it. Loads that end at 410 MPa open less.
sed -e 's/displacement: .*/traction: [450 MPa], face: x+, time: {ramp: {until: 1 s}}}/; s/yield_tangent: 20 GPa/yield_tangent: 2 GPa/' \
    -e 's/^steps: .*/steps: {number: 8, control: opening, from: [0.5 mm], to: [10.5 mm], opening: 0.1 mm}/' \
    -e 's/^probes: .*/probes: [{point: {name: a, at: [0.5 mm]}}, {point: {name: b, at: [10.5 mm]}}]/' "$work/line.yaml" >"$work/open.yaml"
calm "$work/open" "$work/open.yaml" -t 1
near "opening: load time" "$(column "$work/open" load_time 1)" "$(compute 416/450)" 1e-5
near "opening: met" "$(compute "$(column "$work/open" b.displacement_x 1) - ($(column "$work/open" a.displacement_x 1))")" 1e-4 2e-4
near "opening: the step in which it yields" "$(column "$work/open" load_time 0.25)" "$(compute 401/450)" 1e-5
stopped "an opening that no load reaches" "$work/far" 'no load opens the gauge' "$work/open.yaml" -s 'boundary.0.traction=[410 MPa]'

# ---- a beam and a cylinder ---------------------------------------------------------------------------------------------

# Half of a beam, 16 mm high, bent without hardening to four times the curvature 1/4 m at which its edges yield: M/M_y = 3/2 - (1/4)^2/2.
sed -e 's/, yield_tangent: 20 GPa//; s/to: \[20 mm, 8 mm\]/to: [40 mm, 8 mm]/; s/from: \[0, 0\]/from: [0, -8 mm]/; s/number: 12/number: 40/' \
    -e 's/displacement: .*/displacement: ["-x*y\/(1 m)", free], face: x+, time: {ramp: {until: 1 s}}}/; s/^  - {name: below.*/  - {name: pin, fixed: [y], region: {box: {from: [0, -0.9 mm], to: [1 mm, 0.9 mm]}}}/' "$bar" >"$work/beam.yaml"
calm "$work/beam" "$work/beam.yaml" -t 1
# Moment: work over the angle, for the curvature in the middle of the step.
moment() { compute "($(column "$work/beam" external_work "$2") - $(column "$work/beam" external_work "$1"))/(0.04*($2 - $1))/(400e6*1e-3*0.016^2/6)"; }
near "beam: elastic moment" "$(moment 0.1 0.125)" 0.45 5e-3
near "beam: moment" "$(moment 0.475 0.5)" "$(compute "1.5 - 0.5/1.95^2")" 1e-2
near "beam: towards the plastic moment" "$(moment 0.975 1)" "$(compute "1.5 - 0.5/3.95^2")" 1.2e-2
apart "beam: balance" "$(figure "$work/beam" energy.balance_error)" 0 1e-3

# A quarter of a cylinder with radii of 20 and 40 mm under pressure, plane strain: elastic up to 173.2 MPa; at 240 and 300 MPa yielded up to
# the radii c = 26.03 and 33.71 mm with p = s/2 (1 - c^2/b^2 + 2 ln(c/a)), s = 2 sigma_y/3^(1/2), u(b) = (1 - nu^2) s c^2/(E b) (Hill 1950).
# Steps of the lattice reduce its wall by 4 % at 1 mm, 2 % at 0.5 mm.
cat >"$work/cylinder.yaml" <<'END'
space: plane strain
thickness: 1 mm
duration: 1 s
method: mpm
solver: static
steps: {number: 10}
material: {young: 200 GPa, poisson: 0.3, density: 7850 kg/m^3, yield_stress: 400 MPa}
body: [{ring: {centre: [0, 0], radius: 40 mm, inner: 20 mm}}, {intersect: {box: {from: [0, 0], to: [50 mm, 50 mm]}}}]
particles: {spacing: 0.5 mm}
boundary:
  - {name: inner, pressure: 300 MPa, region: {disc: {centre: [0, 0], radius: 30 mm}}, time: {ramp: {until: 1 s}}}
  - {name: left, mirror: {axis: x, at: 0}}
  - {name: below, mirror: {axis: y, at: 0}}
probes: [{point: {name: outer, at: [39.75 mm, 0.25 mm]}}]
output: {frames: 2}
END
calm "$work/cylinder" "$work/cylinder.yaml" -t 1
near "cylinder: elastic" "$(column "$work/cylinder" outer.displacement_x 0.5)" 1.82e-5 3e-2
near "cylinder: half through" "$(column "$work/cylinder" outer.displacement_x 0.8)" 3.197e-5 4e-2
near "cylinder: nearly through" "$(column "$work/cylinder" outer.displacement_x 1)" 5.366e-5 6e-2
apart "cylinder: balance" "$(figure "$work/cylinder" energy.balance_error)" 0 1e-3

# Its limit load is s ln 2 = 320 MPa. Beyond, there is no equilibrium. Close to it a coarse lattice is too soft: its staircase has 3 % more load.
sed -e 's/pressure: 300/pressure: 330/; s/number: 10/number: 11/; s/spacing: 0.5/spacing: 1/' "$work/cylinder.yaml" >"$work/limit.yaml"
"$cleave" run "$work/limit.yaml" -q -o "$work/limit" -t 1 2>"$work/err"
is "beyond the limit load" "$? $(grep -c '^load step 11, .*: no equilibrium' "$work/err")" "1 1"
between "cylinder: 300 MPa" "$(column "$work/limit" outer.displacement_x 0.91)" 5.3e-5 6.6e-5

# ---- bitwise equality --------------------------------------------------------------------------------------------------

# bits WHAT SCENE ARGUMENTS: checks bitwise equality of a run on 1 and 2 threads, and after stops at every load step.
bits()
{
    what=$1; shift
    for threads in 1 2; do "$cleave" run -q -o "$work/$what$threads" "$@" -t $threads 2>"$work/err" || fail "$what: $(cat "$work/err")"; done
    same "$what: 1 and 2 threads" "$work/${what}1" "$work/${what}2"
    piecewise "$work/${what}_parts" "$@"
    between "$what: stops" $parts 7 13
    same "$what: in pieces" "$work/${what}1" "$work/${what}_parts"
}
bits bits_plane "$bar"
bits bits_solid "$work/solid.yaml" -s steps.number=8
bits bits_cylinder "$work/cylinder.yaml" -s 'particles.spacing=1 mm'

# ---- refusals ----------------------------------------------------------------------------------------------

refused "conversion" "$work/no" 'its material has a yield_stress, which load steps allow with method: mpm or pd' "$bar" -s method=adaptive -s material.poisson=1/3
refused "constants of a lattice" "$work/no" 'mpm.constants: isotropic' "$bar" -s mpm.constants=lattice -s material.poisson=1/3

finish
