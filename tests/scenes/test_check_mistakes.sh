#!/bin/sh
# Gross mistakes in scenes, each made on purpose: `cleave check` must refuse the scene or warn, with a number and a remedy, and print
# nothing about the scene without the mistake.
# Takes 20 s: 80 scenes are set up.
test_name=test_check_mistakes
. tests/support/summary.sh

# checked SCENE [ARGUMENT...]: stores the output of check. says, silent, refuses WHAT PATTERN SCENE [ARGUMENT...]: check that the output
# contains the pattern; that it does not and the scene is accepted; that the scene is refused with this text.
checked() { "$cleave" check "$@" --no-trial -t 1 >"$work/said" 2>&1; }
says() { what=$1 pattern=$2; shift 2; checked "$@"; holds "$what: $(cat "$work/said")" grep -q "$pattern" "$work/said"; }
silent() { what=$1 pattern=$2; shift 2; checked "$@"; holds "$what: $(cat "$work/said")" sh -c "grep -q 'is sound$\|can be run[;,]' '$work/said' && ! grep -q '$pattern' '$work/said'"; }
refuses() { what=$1 pattern=$2; shift 2; checked "$@"; is "$what: refused" $? 2; holds "$what: $(cat "$work/said")" grep -qF "$pattern" "$work/said"; }

# A plate of glass under tension, 50 x 40 mm, with a crack from its left side.
cat >"$work/glass.yaml" <<'END'
space: plane stress
thickness: 1 mm
duration: 40 us
method: pd
material: {young: 72 GPa, density: 2440, energy_release_rate: 8 J/m^2}
body: {box: {from: [0, -20 mm], to: [50 mm, 20 mm]}}
particles: {spacing: 1 mm}
cracks: [{from: [0, 0], to: [24.9 mm, 0]}]
boundary: [{name: up, traction: [0, 12 MPa], face: y+}, {name: down, traction: [0, -12 MPa], face: y-}]
END
glass=$work/glass.yaml
silent "glass" '^warning\|^accuracy' "$glass"

# ---- masses of rigid bodies --------------------------------------------------------------------------------------------

# A disc of radius 5 mm and 1 mm thick: 7.854e-8 m^3; steel 0.613 g.
ball() { echo "bodies=[{name: plate, shape: {box: {from: [0, -20 mm], to: [50 mm, 20 mm]}}}, {name: ball, rigid: true, mass: $1, velocity: [-10, 0],
    shape: {disc: {centre: [56 mm, 0], radius: 5 mm}}}]"; }
dense='body ball: its mass over its volume is'
silent "a ball of steel" "$dense" "$glass" -s body= -s "$(ball '0.613 g')"
says "a mass in kg for g" "^warning: $dense 7.8[0-9]*e+06 kg/m^3 (0.613 kg over 7.8[0-9]*e-08 m^3), above 2.5e+04: check the units of mass (kg)" "$glass" -s body= \
    -s "$(ball '0.613 kg')"
says "a mass in mg" "$dense 7.8[0-9]* kg/m^3 .*, below 50: " "$glass" -s body= -s "$(ball '0.613 mg')"
silent "a mass that is meant" "$dense" "$glass" -s body= -s "$(ball '0.613 kg')" -s 'accept=[mass]'
# In other units the density of the plate is 1: a ball of 7.8 times that fits, one of 7800 does not.
model="-s body= -s material.density=1 -s material.young=1e4 -s accept=[waves,stress,stretch,strain,energy,growth,reach,steps]"
silent "a ball in other units" "$dense" "$glass" $model -s "$(ball '0.613 mg')"
says "a heavy ball in other units" "$dense 7.8[0-9]*e+03 kg/m^3 .*, above 30: " "$glass" $model -s "$(ball '0.613 g')"

# ---- energy beside strength --------------------------------------------------------------------------------------------

# E G_c/strength^2 of 8 J/m^2 and 10 MPa: 5.76 mm, of 100 kJ/m^2 72 m. Of 60 MPa: 0.16 mm, whose bonds need a smaller horizon.
soft="-s material.tensile_strength=10MPa"
silent "glass that softens" 'E G_c/tensile_strength' "$glass" $soft
says "an energy of steel" '^warning: material material: its length E G_c/tensile_strength^2 over the longest edge of the bodies is 1.44e+03 (72 m over 0.05 m), above 30: check' \
    "$glass" $soft -s material.energy_release_rate=100kJ/m^2
silent "an energy of steel that is meant" 'E G_c/tensile_strength' "$glass" $soft -s material.energy_release_rate=100kJ/m^2 -s 'accept=[brittleness]'
refuses "a strength in GPa" 'm; check the units of energy_release_rate (J/m^2), tensile_strength (Pa) and spacing (m)' "$glass" \
    -s material.tensile_strength=2GPa
checked "$glass" -s material.tensile_strength=60MPa
holds "a strength that needs smaller particles" sh -c "grep -q 'particles.spacing below [^;]* m$' '$work/said'"

# ---- times of loads ----------------------------------------------------------------------------------------------------

factor() { echo "boundary.up.time={$1}"; }
late='^warning: boundary up: the largest load within the duration, over the largest at any time, is' early='^warning: boundary up: its time function ends at'
silent "a ramp" "$late\|$early" "$glass" -s "$(factor 'ramp: {until: 40 us}')"
silent "a ramp of ten times the run" "$late" "$glass" -s "$(factor 'ramp: {until: 399 us}')"
says "a ramp in ms" "$late 0.001, below 0.1: check the units of its times (s) and duration; if this is intended, add accept: \[times\]" "$glass" \
    -s "$(factor 'ramp: {until: 40 ms}')"
silent "a ramp in ms that is meant" "$late" "$glass" -s "$(factor 'ramp: {until: 40 ms}')" -s 'accept=[times]'
says "a pulse in ms" "$late" "$glass" -s "$(factor 'pulse: {until: 40 ms}')"
silent "a pulse" "$late" "$glass" -s "$(factor 'pulse: {until: 40 us}')"
says "a step after the end" "$late 0, below 0.1" "$glass" -s "$(factor 'step: {from: 1 ms, until: 1 s}')"
silent "a step that lasts" "$late" "$glass" -s "$(factor 'step: {until: 1 s}')"
says "a table in ms" "$late 0.04, below 0.1" "$glass" -s "$(factor 'table: [[0, 0], [1 ms, 1], [2 ms, 0]]')"
silent "a table whose peak is before the end" "$late" "$glass" -s "$(factor 'table: [[0, 0], [20 us, 1], [1 s, 0]]')"
says "a ramp in ps" "$early 4e-11 s, long before the end of the first time step, 1.43e-07 s, so the load acts in full at once: check" "$glass" \
    -s "$(factor 'ramp: {until: 0.04 ns}')"
says "a pulse in ps" "$early 4e-11 s, .*, so it never acts: check" "$glass" -s "$(factor 'pulse: {until: 0.04 ns}')"
says "a table in ps" "$early 4e-11 s, .*, so the load has its last value at once: check" "$glass" -s "$(factor 'table: [[0, 0], [0.04 ns, 1]]')"
rigid() { echo "bodies=[{name: plate, shape: {box: {from: [0, -20 mm], to: [50 mm, 20 mm]}}}, {name: jaw, rigid: true, velocity: [-1, 0], ramp: $1,
    shape: {box: {from: [50 mm, -20 mm], to: [60 mm, 20 mm]}}}]"; }
says "a ramp of a rigid body in ms" '^warning: body jaw: .* is 0.001 (by its ramp), below 0.1' "$glass" -s body= -s "$(rigid '40 ms')"
silent "a ramp of a rigid body" 'by its ramp' "$glass" -s body= -s "$(rigid '40 us')"

# ---- keys that do nothing ----------------------------------------------------------------------------------------------

idle='keys without effect in this scene (remove them): '
silent "no idle keys" "$idle" "$glass"
says "keys of points" "^hints .*${idle}mpm.cell, mpm.frame (method pd has no material points)$" "$glass" -s boundary.up.traction='[0, 11 MPa]' -s mpm.cell=2 -s mpm.frame=current
says "keys of bonds" "${idle}particles.horizon, model (method mpm has no bonds); contact.law (no particles with bonds have contact)$" "$glass" -s method=mpm -s cracks=[] \
    -s particles.horizon=3 -s model=bond -s contact.law=surface
says "bonds that do not break" 'material material: energy_release_rate, toughness or critical_stretch has no effect: method mpm has no bonds' "$glass" \
    -s method=mpm -s cracks=[]
says "keys of conversion and solvers" "${idle}conversion.alpha, pd.region (only points of .*); solver_tolerance (solver: explicit does not iterate); time.safety (time.step is given); particles.seed (" \
    "$glass" -s conversion.alpha=0.9 -s solver_tolerance=1e-3 -s time.step=0.1us -s time.safety=0.4 -s particles.seed=3 \
    -s 'pd.region={box: {from: [0, 0], to: [1 mm, 1 mm]}}'
says "time steps of an equilibrium" "${idle}time.safety (the solver makes no time steps); crack.speed_window (no crack grows in time)$" "$glass" -s solver=cg -s time.safety=0.4 \
    -s crack.speed_window=1us
silent "keys of an equilibrium" "$idle" "$glass" -s solver=cg -s solver_tolerance=1e-3 -s solver_steps=100
says "a material of no body" 'material other: no body consists of this material; remove it, or name it in a body$' "$glass" -s material= -s body= \
    -s 'materials=[{name: glass, young: 72 GPa, density: 2440}, {name: other, young: 72 GPa, density: 2440}]' \
    -s 'bodies=[{name: a, material: glass, shape: {box: {from: [0, -20 mm], to: [50 mm, 20 mm]}}}]'
"$cleave" run "$glass" -q -o "$work/ran" -s output.frames=0 -s duration=3us >/dev/null 2>&1
silent "the scene of a run, which gives all keys" "$idle" "$work/ran/scene.yaml"

# ---- places and signs --------------------------------------------------------------------------------------------------

between='(the particles are between (0.0005, -0.0195) and (0.0495, 0.0195) m); check'
box() { echo "box: {from: [$1], to: [$2]}"; }
refuses "a probe outside" "the point (10, 5) m is outside the bodies $between its coordinates and their unit (m if none is written)" "$glass" -s 'probes=[{point: {name: p, at: [10, 5]}}]'
refuses "a line outside" "the whole line is outside the bodies $between its ends" "$glass" -s 'probes=[{line: {name: p, from: [10, 5], to: [20, 5], points: 3}}]'
refuses "a load outside" "boundary up: no particle is in its region $between the region and its unit (m if none is written)" "$glass" -s "boundary.up.region={$(box '100, 0' '200, 50')}"
refuses "a pressure outside" "boundary p: no particle is in its region $between the region" "$glass" -s "boundary=[{name: p, pressure: 1 MPa, region: {$(box '100, 0' '200, 50')}}]"
says "a support outside" "^warning: boundary f contains no particle $between its region and the unit (m if none is written) (" "$glass" \
    -s "boundary=[{name: up, traction: [0, 12 MPa], face: y+}, {name: f, fixed: all, region: {$(box '100, 0' '200, 50')}}]"
says "a velocity outside" "^warning: initial\[0\]: no particle is in its region, so it has no effect $between the region" "$glass" -s "initial=[{velocity: [1, 0], region: {$(box '100, 0' '200, 50')}}]"
says "peridynamics outside" "^warning: pd.region contains no particle, so it has no effect $between the region" "$glass" -s "pd.region={$(box '100, 0' '200, 50')}"
says "a part outside" '^warning: body body: its part 1, of material material, holds no particle, because it is outside' "$glass" -s "parts=[{region: {$(box '100, 0' '200, 50')}, material: material}]"
silent "a velocity inside" 'initial' "$glass" -s "initial=[{velocity: [0.1, 0], region: {$(box '0, 0' '1 mm, 1 mm')}}]"
says "a plane of symmetry beside the body" "^warning: boundary m: its plane of symmetry y = -0.03 m is 0.0105 m from the nearest particle, but should be half a spacing (0.0005 m) away, so it has no effect ${between%; check}" "$glass" \
    -s 'boundary.down={name: m, mirror: {axis: y, at: -30 mm}}' -s cracks=[] -s contact.between=none
# Bonds of 3.015 mm cross gaps of 1 mm at most; cells of 2 mm, the second of which begins 1 mm beside the body.
beside() { echo "boundary m: its plane of symmetry y = -0.02$1 m is 0.00$2 m from the nearest particle, but should be half a spacing (0.0005 m) away, so it $3 ("; }
for method in pd mpm; do
    says "a plane half a spacing off, $method" "$(beside 05 1 'holds the body too softly')" "$glass" -s cracks=[] -s method=$method \
        -s 'boundary.down={name: m, mirror: {axis: y, at: -20.5 mm}}'
    says "a plane of symmetry far off, $method" "$(beside 3 35 'has no effect')" "$glass" -s cracks=[] -s contact.between=none -s method=$method -s 'boundary.down={name: m, mirror: {axis: y, at: -23 mm}}'
done
says "a plane in contact" "$(beside 3 35 'acts on the body only by contact with the mirror image')" "$glass" -s cracks=[] -s method=pd -s contact.between=all \
    -s 'boundary.down={name: m, mirror: {axis: y, at: -23 mm}}'
silent "a plane of symmetry at the body" 'away, so it ' "$glass" -s 'boundary.down={name: m, mirror: {axis: y, at: -20 mm}}' -s cracks=[]
# Rows of the second body are 0.4 spacings beside those of the first, from 10 mm inside it on.
two() { echo "bodies=[{name: a, shape: {$(box '0, -20 mm' '50 mm, 20 mm')}}, {name: b, shape: {$(box "$1, -19.6 mm" '90 mm, 20 mm')}}]"; }
says "bodies that overlap" '^warning: bodies b and a overlap: 400 particles of b are inside a, the deepest by 0.0093 m at (0.0407, -0.0103) m; move one body, or subtract' "$glass" \
    -s body= -s "$(two '40.4 mm')"
silent "bodies that overlap on purpose" 'overlap' "$glass" -s body= -s "$(two '40.4 mm')" -s 'accept=[contact]'
silent "bodies that touch" 'overlap' "$glass" -s body= -s "$(two '50 mm')"
grown() { echo "growth=[{at: [$1, 0], direction: [1, 0], speed: $2, start: $3}]"; }
says "growth outside" '^warning: growth growth0: its tip starts 24.9 m from the nearest particle' "$glass" -s "$(grown 24.9 '500 m/s' 0)"
says "growth after the end" '^warning: growth growth0: starts at 0.01 s, after the duration of 4e-05 s' "$glass" -s "$(grown '24.9 mm' '500 m/s' '10 ms')"
says "growth by nothing" '^warning: growth growth0: at 0.5 m/s the crack grows by 2e-05 m in the run, less than a spacing of 0.001 m' "$glass" -s "$(grown '24.9 mm' '0.5 m/s' 0)"
says "growth in mm/us" '^warning: growth growth0: 5e+05 m/s is 163 times the speed of Rayleigh waves, 3058 m/s' "$glass" -s "$(grown '24.9 mm' '500 mm/us' 0)"
silent "growth" 'growth' "$glass" -s "$(grown '24.9 mm' '500 m/s' 0)"
pressed() { echo "boundary=[{name: p, pressure: $1, region: {$(box '-inf, 19 mm' 'inf, inf')}}]"; }
says "a pressure that pulls" 'hints .*boundary p: a pressure of -1.2e+07 Pa is negative and pulls the faces outwards' "$glass" -s "$(pressed '-12 MPa')"
silent "a pressure" 'pulls' "$glass" -s "$(pressed '12 MPa')"
says "tractions of one direction" 'boundaries up and down: tractions of 1.2e+07 and 1.2e+07 Pa along y on opposite faces push the body in one direction; to' "$glass" \
    -s boundary.down.traction='[0, 12 MPa]'
slot() { echo "body=[{$(box '0, -20 mm' '50 mm, 20 mm')}, {subtract: {$1}}]"; }
thin='accuracy  *body body: solid 2 of its shape, which is subtracted, is only'
says "a slot narrower than a spacing" "$thin 0.0004 m thin (spacing 0.001 m), so it acts as a slit .*; use a spacing of 0.1 mm to resolve it$" "$glass" -s cracks=[] \
    -s "$(slot "$(box '0, -0.2 mm' '25 mm, 0.2 mm')")"
holds "a slot of half the width is not symmetric about the middle" sh -c "! grep -q 'symmetric about x' '$work/said'"
says "a hole smaller than a spacing" "$thin 0.0006 m thin" "$glass" -s cracks=[] -s "$(slot 'disc: {centre: [25 mm, 0], radius: 0.3 mm}')"
silent "a slot of four spacings" "$thin" "$glass" -s cracks=[] -s "$(slot "$(box '0, -2 mm' '25 mm, 2 mm')")"

# ---- cracks that cannot grow -------------------------------------------------------------------------------------------

# Waves travel at 5763 m/s, 20 mm take 3.5 us; (72 GPa 34 mJ/m^2)^(1/2) is 0.0495 MPa m^0.5.
pressing='^warning: boundary down: its traction of 1.2e+07 Pa on y- closes crack 1, as all loads do' fixed='^warning: crack 1 cannot grow: supports prescribe'
ends='^warning: crack 1 has no end inside a body' short='^warning: duration: in 2e-06 s waves travel 0.0115 m'
turned() { echo "boundary=[{name: up, traction: [0, -12 MPa], face: y+}, {name: down, $1, face: y-}]"; }
held() { echo "boundary=[{name: up, traction: [0, 12 MPa], face: y+}, {name: down, fixed: $1, face: y-, depth: 24 mm}]"; }
says "loads that press a crack" "$pressing, .* give an outward traction, -1.2e+07 Pa, .* accept: \[growth\]" "$glass" -s "$(turned 'traction: [0, 12 MPa]')"
silent "loads that press a crack and are meant" "$pressing" "$glass" -s "$(turned 'traction: [0, 12 MPa]')" -s accept=[growth]
silent "loads that press beside shear" "$pressing" "$glass" -s "$(turned 'traction: [1 MPa, 12 MPa]')"
silent "loads that press along a crack" "$pressing" "$glass" -s "$(turned 'traction: [0, 12 MPa]')" -s 'cracks=[{from: [20.1 mm, -5 mm], to: [20.1 mm, 5.1 mm]}]'
says "a support that holds a crack" "$fixed the motion of all 48 particles within a horizon of its ends; use a smaller depth" "$glass" -s "$(held all)"
silent "a support that holds a crack along it" "$fixed" "$glass" -s "$(held '[y]')"
says "a crack that ends far away" "$ends, so it cannot grow and may cut the body in two; its end at (24.9, 0) m is 24.9 m from" "$glass" -s 'cracks=[{from: [0, 0], to: [24.9, 0]}]'
silent "a crack that begins far away" "$ends" "$glass" -s 'cracks=[{from: [-10, 0], to: [24.9 mm, 0]}]'
silent "a cut from side to side" "$ends" "$glass" -s 'cracks=[{from: [-1 mm, 0], to: [51 mm, 0]}]'
says "a run that is too short for its crack" "$short, but the nearest end of a crack is 0.019[0-9]* m from the loads, .*; use a duration of more than 3.4e-06 s" "$glass" -s duration=2us
silent "a run long enough" '^warning: duration' "$glass" -s duration=5us
silent "a short run in which all of the body moves" "$short" "$glass" -s duration=2us -s 'initial=[{velocity: [0, 0.1 m/s], region: {box: {from: [0, 0], to: [50 mm, 20 mm]}}}]'
tough='^warning: material material: its toughness of'
says "an energy release rate in kJ" "$tough 0.0495 MPa m^0.5 (0.034 J/m^2, 7.2e+10 Pa) is below 0.161 (glass: 0.75)" "$glass" -s material.energy_release_rate=0.034
says "an energy release rate in kJ, of tougher glass" "$tough 0.0986 MPa m^0.5 .* is below 0.161" "$glass" -s material.energy_release_rate=0.135
silent "an energy release rate in kJ that is meant" "$tough" "$glass" -s material.energy_release_rate=0.034 -s accept=[energy]

says "two loads too large for a modulus without a unit" '^warning: boundary up: its load over Young.s modulus is 1.67e+05 (1.2e+07 Pa over 72 Pa; also of 1 other boundary)' \
    "$glass" -s material.young=72
silent "a modulus in GPa" 'also of' "$glass"
says "friction in percent" 'contact.friction: 30 is above 3; dry solids have 0.1 to 1.5' "$glass" -s contact.friction=30
says "gravity in mm/s^2 by 10" 'gravity: 9.81e+04 m/s^2 is 1e+04 times that of the Earth' "$glass" -s 'gravity=[0, -98100]'
says "a crack wider than the body" 'crack 1: its width of 5 m is larger than the bodies, 0.05 m' "$glass" -s 'cracks=[{from: [0, 0], to: [24.9 mm, 0], width: 5}]'
says "damping that stops all" 'damping: at 1e+09 1/s motion dies out within 2 time steps' "$glass" -s damping=1e9
says "frames that fill a disk" 'output.frames: 1[0-9]* frames of 50000 particles take about [345][0-9] GB of disk' "$glass" -s particles.spacing=0.2mm -s duration=400us \
    -s output.frames=100000
silent "some frames" 'GB of disk' "$glass" -s output.frames=1000
silent "friction, gravity and damping of use" 'is above 3\|of the Earth\|dies out' "$glass" -s contact.friction=0.5 -s 'gravity=[0, -9.81]' -s damping=1e3

finish
