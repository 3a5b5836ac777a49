#!/bin/sh
# Advice of `cleave check` where a scene may differ from its author's intention: numbers in another unit, collisions, supports, bonds
# that yield. Each case has a control without advice.
# Takes 20 s: 80 scenes are set up, a few run.
test_name=test_meant
. tests/support/summary.sh
. tests/support/scenes.sh
. tests/support/advice.sh

# ---- units -------------------------------------------------------------------------------------------------------------

# The glass of the README: with lengths in mm, the modulus in MPa, the density in g/cm^3, a stretch in percent.
cat >"$work/glass.yaml" <<'END'
variables: {a: 1 mm, E: 72 GPa, rho: 2440, limit: 0.1 %}
space: plane stress
thickness: 1 mm
duration: 40 us
method: pd
material: {young: E, density: rho, critical_stretch: limit}
body: {box: {from: [0, -20*a], to: [50*a, 20*a]}}
particles: {spacing: a}
cracks: [{from: [0, 0], to: [24.9*a, 0]}]
boundary: [{traction: [0, 12 MPa], face: y+}, {traction: [0, -12 MPa], face: y-}]
END
glass=$work/glass.yaml units='check the units of'
silent "glass" "$units" "$glass"
says "lengths in mm" '^warning: time: in the duration waves travel 0.23[0-9]* spacings, below 1: check the units of duration, lengths (m)' "$glass" \
    -s 'variables.a=1 m'
says "a modulus in MPa" '^warning: boundary boundary0: its load over Young.s modulus is 167 ' "$glass" -s 'variables.E=72000 Pa'
says "a modulus in MPa: slow waves" '^warning: material material: the speed of its waves is 5.7[0-9]* m/s, below 10: ' "$glass" -s 'variables.E=72000 Pa'
says "a stretch in percent" '^warning: material material: its bonds break at a stretch of 0.1, at 7.2e+09 Pa, above 0.05: ' "$glass" -s variables.limit=0.1
says "a stretch in percent: the load is small beside it" '^warning: loads: the largest stress .* is 0.00167 (1.2e+07 Pa; E s_c is 7.2e+09 Pa), below 0.01' \
    "$glass" -s variables.limit=0.1
says "a stretch of nothing" 'at a stretch of 1e-07, at 7.2e+03 Pa, below 1e-06: ' "$glass" -s variables.limit=1e-7
says "a load of nothing beside it" '^warning: loads: the largest stress .* is 1.67e+03 (1.2e+07 Pa; E s_c is 7.2e+03 Pa), above 1e+03' \
    "$glass" -s variables.limit=1e-7
says "a density in g/cm^3" '^warning: material material: the speed of its waves is 1.82e+05 m/s, above 2e+04: ' "$glass" -s 'variables.rho=2.44 kg/m^3'
soft="$glass -s method=mpm -s cracks=[] -s material.critical_stretch=inf"
says "a Poisson's ratio near 1/2" "^warning: material material: its Poisson's ratio of 0.4999 makes waves as fast as 2.22e+05 m/s, 27.9 times as fast as at 0.4; check this value; " \
    $soft -s 'space=plane strain' -s material.poisson=0.4999
silent "a Poisson's ratio of 0.45" "$units\|Poisson.s ratio of" $soft -s 'space=plane strain' -s material.poisson=0.45
says "a few steps" '^warning: time: the number of time steps is 18 of .* s, below 20: check the units of duration' "$glass" -s duration=2.5us
silent "some steps" "$units" "$glass" -s duration=3us
says "very many steps" '^warning: time: the number of time steps is [0-9.]*e+08 of .* s, above 1e+08: ' "$glass" -s duration=100s
says "a spacing of 1 cm" '^warning: body body: it has a crack, and its least number of particles across is 4, along y, below 8: ' "$glass" -s particles.spacing=1cm
says "a density in g/m^3" '^warning: material material: its density is 2.44e+06 kg/m^3, above 3e+04: check the units of density' "$glass" -s variables.rho=2.44e6
hot="material={young: 72 GPa, density: 2780, johnson_cook: {A: 265 MPa, B: 426 MPa, n: 0.34, C: 0.015, T_melt: 775 K}, specific_heat:"
says "a specific heat in kJ/(kg K)" '^warning: material material: its specific heat is 0.875 J/(kg K), below 50: .* accept: .heat.' "$glass" -s method=mpm -s cracks=[] \
    -s "$hot 0.875}"
silent "a specific heat with its unit" 'its specific heat is' "$glass" -s method=mpm -s cracks=[] -s "$hot 0.875 kJ/(kg K)}"
silent "a specific heat that is meant" 'its specific heat is' "$glass" -s method=mpm -s cracks=[] -s "$hot 0.875}" -s 'accept=[heat]'
says "a start in degrees Celsius" '^warning: material material: its T_room is 20 K, below 150 K: .* (775 K)' "$glass" -s method=mpm -s cracks=[] \
    -s "$hot 875}" -s material.johnson_cook.T_room=20
silent "a start in kelvin" 'T_room' "$glass" -s method=mpm -s cracks=[] -s "$hot 875}"
two="materials=[{name: a, $(echo "$hot 875}" | sed 's/.*={//'), {name: b, young: 200 GPa, density: 7800, yield_stress: 300 MPa}, {name: c, $(echo "$hot 875}" | sed 's/.*={//; s/T_melt/T_room: 400 K, T_melt/')]"
sed 's/^body:.*/&\nparts: [{region: {disc: {centre: [0, 0], radius: 5 mm}}, material: b}, {region: {disc: {centre: [30 mm, 0], radius: 5 mm}}, material: c}]/; /^material:/d' "$glass" >"$work/two.yaml"
says "two temperatures at the start" '^warning: materials a and c start at 293.15 K and 400 K, their T_room' "$work/two.yaml" -s method=mpm -s cracks=[] -s "$two"
says "a metal that is not heated" '^warning: material b yields but is not heated, so its temperature stays at 293.15 K' "$work/two.yaml" -s method=mpm -s cracks=[] -s "$two"
says "a yield stress in MPa" '^warning: material material: its yield stress over Young.s modulus is 4.17e-09 (300 Pa over 7.2e+10 Pa), below 2e-05' "$glass" \
    -s material.yield_stress=300
says "a yield stress in GPa" "its yield stress over Young.s modulus is 4.17 .*, above 0.3" "$glass" -s material.yield_stress=300GPa
silent "a yield stress in Pa" "$units" "$glass" -s material.yield_stress=300MPa
says "hardening in MPa" '^warning: material copper: its linear hardening of 100 Pa is below a millionth' inputs/taylor_bar.yaml \
    -s material.hardening.linear.modulus=100
silent "hardening that is meant" 'is below a millionth' inputs/taylor_bar.yaml -s material.hardening.linear.modulus=100 -s 'accept=[yield]'
# 49 mm between the outermost particles, 5.76 mm/us: 0.04 s are 4700 passages and 286,000 steps.
says "a duration in ms" '^warning: time: the number of times that waves cross the bodies in the duration is 4.7[0-9]*e+03 (0.04 s, 0.049 m at' "$glass" -s duration=40ms
silent "a duration in ms that is meant" "$units" "$glass" -s duration=40ms -s 'accept=[passages]'
# rho c v of 1 mm/s is 1.4e4 Pa, E u/L of the 20 nm that it goes over 50 mm 2.88e4 Pa, 0.0004 of the strength of 72 MPa; 1 um makes 1.44 MPa,
# 0.02 of it, 1 m 20,000 times the strength.
says "a modulus in MPa for GPa under 6 MPa" '^warning: boundary boundary0: its load over Young.s modulus is 0.0857 .*, above 0.05' "$glass" -s 'variables.E=70 MPa' \
    -s boundary.0.traction='[0, 6 MPa]' -s boundary.1.traction='[0, -6 MPa]'
says "a traction in GPa" '^warning: boundary boundary0: its load over Young.s modulus is 0.139 ' "$glass" -s boundary.0.traction='[0, 10 GPa]'
says "a duration of 20 ms" '^warning: time: the number of times that waves cross .* is 2.35e+03 .*, above 2e+03' "$glass" -s duration=20ms
says "a thickness in m" '^warning: space: in plane stress its thickness over the longest edge of its bodies is 40 (2 m over 0.05 m), above 2: ' "$glass" -s 'thickness=2 m'
silent "a thickness in m that is meant" "$units" "$glass" -s 'thickness=2 m' -s 'accept=[thickness]'
silent "a thickness in plane strain" "$units" "$glass" -s 'thickness=2 m' -s 'space=plane strain'
says "an energy of nothing" '^warning: material material: its energy release rate is 0.01 J/m^2, below 0.03: ' "$glass" -s material.critical_stretch= \
    -s material.energy_release_rate=0.01
silent "an energy of glass" "$units" "$glass" -s material.critical_stretch= -s material.energy_release_rate=4
# Griffith: pi (12 MPa 50/40)^2 0.05 m/72 GPa = 491 J/m^2.
says "an energy in kJ/m^2" "^warning: loads: no crack can grow: the energy that one as long as the body could release, over the energy release rate, is 0.0491 (491 J/m^2 over 1e+04 J/m^2), below 0.1" \
    "$glass" -s material.critical_stretch= -s material.energy_release_rate=10kJ/m^2
silent "an energy of less than half that" "no crack can grow" "$glass" -s material.critical_stretch= -s material.energy_release_rate=4.5kJ/m^2
silent "a tough plate that is meant" "$units" "$glass" -s material.critical_stretch= -s material.energy_release_rate=10kJ/m^2 -s 'accept=[growth]'
boundary() { echo "boundary=[{fixed: all, face: x-, depth: 1 mm}, {$1, face: x+, depth: 1 mm, time: {ramp: {until: 40 us}}}]"; }
says "a velocity in mm/s" '^warning: loads: the largest stress .* is 0.0004 ' "$glass" -s cracks=[] -s "$(boundary 'velocity: [1 mm/s, free]')"
silent "a velocity in m/s" "$units" "$glass" -s cracks=[] -s "$(boundary 'velocity: [1 m/s, free]')"
silent "a small displacement" "$units" "$glass" -s cracks=[] -s "$(boundary 'displacement: [1 um, free]')"
says "a displacement in m" '^warning: loads: .*above 1e+03' "$glass" -s cracks=[] -s solver=cg -s "$(boundary 'displacement: [1 m, free]')"
silent "figures that are meant" "$units" "$glass" -s variables.limit=0.1 -s 'accept=[stretch, stress]'
"$cleave" run "$glass" -q -o "$work/glass" -s variables.limit=0.1 -s output.frames=0 -s duration=4us >/dev/null 2>"$work/said"
is "run says it, too: $(cat "$work/said")" "$(grep -c "$units" "$work/said")" 2

# ---- crack tips faster than Rayleigh waves ------------------------------------------------------------------------------

# Under 30 MPa the loaded edges tear off at once.
sed 's/critical_stretch: limit/energy_release_rate: 4/; s/12 MPa/30 MPa/g; s/duration: .*/duration: 12 us/' "$glass" >"$work/torn.yaml"
echo 'crack: {speed_window: 2 us}
output: {frames: 0, samples: 60}' >>"$work/torn.yaml"
torn="from (0.00[01]5, -0.0195) to (0.0495, -0.0195) m, moves at up to [0-9.e+]* m/s within 2e-06 s (crack.speed_window), faster than Rayleigh waves, 3058 m/s"
run_says() { "$cleave" run "$@" -q -t 1 -o "$work/swift" --overwrite 2>"$work/said" >/dev/null; }
run_says "$work/torn.yaml" -s 'accept=[speed]'
holds "a tip faster than waves: $(cat "$work/said")" grep -q "$torn" "$work/said"
run_says "$work/torn.yaml" -s 'accept=[rayleigh]'
is "a tip faster than waves that is meant" "$(cat "$work/said")" ""
run_says "$work/torn.yaml" -s boundary.0.traction='[0, 5 MPa]' -s boundary.1.traction='[0, -5 MPa]' -s duration=40us
is "a slower tip" "$(cat "$work/said")" ""
between "a slower tip [m/s]" "$(figure "$work/swift" crack.tip_speed_max)" 500 3058

# ---- cracks, horizon, time step ----------------------------------------------------------------------------------------

far='warning: crack 1 is outside all bodies, 0.1[78][0-9]* m from the nearest particle, and has no effect'
says "a crack outside" "$far" "$glass" -s 'cracks=[{from: [0, 0.2], to: [25 mm, 0.2]}]'
silent "a crack inside" 'outside all bodies' "$glass"
says "a crack that only touches the body" '^accuracy  *crack 1 is in the body over .* m, less than half a spacing' "$glass" -s 'cracks=[{from: [-20 mm, 0], to: [0.2 mm, 0]}]'
says "a crack outside in space" 'crack 1 is outside all bodies, 0.016 m from' "$glass" -s space=solid -s thickness= -s boundary=[] -s particles.spacing=2mm \
    -s 'body={box: {from: [0, 0, 0], to: [20 mm, 20 mm, 20 mm]}}' -s 'cracks=[{polygon: [[0, 0, 35 mm], [20 mm, 0, 35 mm], [20 mm, 20 mm, 35 mm], [0, 20 mm, 35 mm]]}]'
says "a horizon of one spacing" 'warning: particles.horizon: 1 gives each particle bonds along the axes of the lattice only (4)' "$glass" -s particles.horizon=1
silent "a horizon of eight neighbours" 'particles.horizon:' "$glass" -s particles.horizon=1.5
says "a step above the critical one" 'warning: .* time.step is 1e-06 s, 3.[0-9]* times the critical .* set it to at most' "$glass" -s time.step=1us
says "a tip that nothing moves" 'warning: probe tip will have no result, because no bond can break: no material has an energy_release_rate.* (-s probes=.tip.)$' "$glass" -s 'probes=[tip]' -s material.critical_stretch=
silent "a tip that moves" 'no bond can break' "$glass" -s 'probes=[tip]'
silent "a tip that is grown" 'no bond can break' inputs/kalthoff_sif.yaml

# ---- bodies of a few rows, and bodies that yield --------------------------------------------------------------------------

# A strip in tension: 3 rows bear 1.40 times the force of 10 rows, 2 rows 1.76 times, 1 row 1.43 times; 4 rows 1.01 times.
cat >"$work/strip.yaml" <<'END'
space: plane stress
thickness: 1 mm
duration: 1 us
method: pd
solver: cg
material: {young: 70 GPa, density: 2700}
body: {box: {from: [0, 0], to: [60 mm, 6 mm]}}
particles: {spacing: 2 mm}
boundary: [{displacement: [0, 0], face: x-, depth: 1 mm}, {displacement: [60 um, free], face: x+, depth: 1 mm}]
output: {frames: 0, samples: 1}
END
thin='^warning: body body has 3 rows of particles along y, so with pd.surface: moments it carries up to 1.8 times the force .* particles.spacing: 0.0012 m'
"$cleave" run "$work/strip.yaml" -q -o "$work/strip" 2>"$work/said" >/dev/null
holds "a strip of three rows, in a run: $(cat "$work/said")" grep -q "$thin" "$work/said"
says "a strip of three rows" "$thin" "$work/strip.yaml"
silent "a strip of three rows that is meant" "^warning" "$work/strip.yaml" -s 'accept=[particles]'
silent "a strip of three rows and their images" "^warning" "$work/strip.yaml" \
    -s 'boundary=[{displacement: [0, 0], face: x-, depth: 1 mm}, {displacement: [60 um, free], face: x+, depth: 1 mm}, {mirror: {axis: y, at: 0}}]'
silent "a strip of four rows" "^warning" "$work/strip.yaml" -s particles.spacing=1.5mm
silent "a strip without moments" "^warning" "$work/strip.yaml" -s pd.surface=volume

# A quarter of a copper bar, four points across: 0.1 % of the energy, by the law and by yield_tangent of equal slope.
copper="inputs/taylor_bar.yaml -s particles.spacing=0.8mm -s output.frames=0 -q -t 1 --overwrite"
for slope in "-s output.samples=100" "-s material.hardening= -s material.yield_tangent=99.9MPa"; do
    "$cleave" run $copper -o "$work/copper" $slope >/dev/null 2>"$work/said"
    is "a bar that yields, $slope" "$(cat "$work/said")" ""
done

# ---- the verdict -------------------------------------------------------------------------------------------------------

silent "sound: no line before it" "^warning\|^accuracy" "$glass"
is "sound: the last line" "$(tail -n 1 "$work/said")" "$glass is sound"
checked "$glass" -s particles.horizon=1
is "a warning: the last line" "$(tail -n 1 "$work/said")" "$glass can be run, but read first the warning above (1 in all)"
checked "$glass" -s cracks=[] -s 'body={box: {from: [0, -4*a], to: [50*a, 4*a]}}'
is "a remark: the last line" "$(tail -n 1 "$work/said")" "$glass can be run; read first the remark on accuracy above (1 in all)"
"$cleave" check "$glass" --no-trial -s particles.horizon=1 2>/dev/null >"$work/said"
holds "warnings go to standard error" sh -c "! grep -q ^warning '$work/said'"

# ---- bonds that yield ----------------------------------------------------------------------------------------------------

# Bonds of all directions that yield one by one under tension: those within the angle a are stretched, the others shortened, such that the
# sides are free; each carries 3/pi of the yield stress per angle in 2D, 6 times the mean over a half sphere in 3D. Integrated here by sums.
limit()
{
    awk -v solid="$1" 'BEGIN { n = 20000; low = 0; high = pi = atan2(0, -1); high = pi / 2
        for (k = 0; k < 40; k++) { a = (low + high) / 2; side = 0; pull = 0
            for (i = 0; i < n; i++) { t = (i + 0.5) * pi / 2 / n; w = solid ? 6 * sin(t) : 3 / pi * 2; s = (t < a ? 1 : -1) * w * pi / 2 / n
                pull += s * cos(t) ^ 2; side += s * sin(t) ^ 2 }
            if (side < 0) low = a; else high = a }
        printf "%.3f %.3f\n", pull, 1 / (sin(a) / cos(a)) ^ 2 }'
}
cat >"$work/yield.yaml" <<'END'
space: plane stress
thickness: 1 mm
duration: 1 s
method: pd
solver: static
steps: {number: 6}
material: {young: 200 GPa, density: 7850, yield_stress: 300 MPa, yield_tangent: 2 GPa}
body: {box: {from: [0, 0], to: [30 mm, 12 mm]}}
particles: {spacing: 1 mm}
boundary:
  - {name: g, displacement: [0.24 mm, free], face: x+, time: {ramp: {until: 1 s}}}
  - {mirror: {axis: x, at: 0}}
  - {fixed: [y], region: {ball: {centre: [0, 6 mm], radius: 0.9 mm}}}
probes: [reaction: {boundary: g}]
output: {frames: 0}
END
yield=$work/yield.yaml
set -- $(limit 0)
says "plates of bonds that yield" "warning: material material: its bonds yield one by one, so this plasticity is approximate: a plate .* $(printf %.2f "$1") times .* lateral plastic strain is $(printf %.2f "$2") of" "$yield"
# At 0.8 % of strain: hardening adds up to 2 GPa times 0.65 %, 4 %; a horizon of three spacings is not a circle, 3 %.
"$cleave" run "$yield" -q -o "$work/yield" >/dev/null 2>&1
near "a plate of bonds that yield" "$(awk -F, 'NR == 1 { for (k = 1; k <= NF; k++) if ($k ~ /^reaction.force_x/) c = k; next }
    { f = $c < 0 ? -$c : $c } END { print f / 12e-6 / 300e6 }' "$work/yield/history.csv")" "$(compute "$1 + 0.04 / 2")" 0.04
holds "the run says it" grep -q 'bonds yield one by one' "$work/yield/summary.json"
"$cleave" run "$yield" -q -o "$work/elastic" -s 'boundary.0.displacement=[0.002 mm, free]' >/dev/null 2>&1
holds "a run in which no bond yields does not" grep -q '"warnings": \[\]' "$work/elastic/summary.json"
says "points that convert to bonds that yield" 'bonds, to which points convert, yield one by one' "$yield" -s method=adaptive -s steps= \
    -s solver=explicit -s duration=1us -s 'boundary.0.time={ramp: {until: 1 us}}' -s material.critical_stretch=0.2
set -- $(limit 1)
says "solids of bonds that yield" "a solid yields at about $(printf %.2f "$1") times .* lateral plastic strain is $(printf %.2f "$2") of" "$yield" -s space=solid -s thickness= -s solver=explicit \
    -s steps= -s duration=1us -s 'body={box: {from: [0, 0, 0], to: [30 mm, 5 mm, 5 mm]}}' -s 'boundary=[{traction: [1 MPa, 0, 0], face: x+}]' -s probes=[]
silent "points that yield" 'one by one' "$yield" -s method=mpm
silent "a bar of bonds that yield" "one by one" inputs/bar_plastic.yaml -s method=pd

# ---- speeds ------------------------------------------------------------------------------------------------------------

# Bonds break at 5.4 m/s; a wave crosses the body in 2.1 us. A free body follows a velocity that increases to 20 m/s in 1 ms, but not one
# that does so in 1 us; a fixed one does not follow.
cat >"$work/free.yaml" <<'END'
space: plane stress
thickness: 1 mm
duration: 1 ms
method: pd
material: {young: 70 GPa, density: 2700, critical_stretch: 0.1 %}
body: {box: {from: [0, 0], to: [10 mm, 5 mm]}}
particles: {spacing: 0.5 mm}
boundary:
  - {name: pull, velocity: [20, free], face: x+, time: {ramp: {until: 1 ms}}}
  - {name: other, traction: [0, 0], face: x-}
output: {frames: 0, samples: 20}
END
free=$work/free.yaml changes='boundary pull: its velocity changes by up to 20 m/s within 2.07e-06 s, the time' held='boundary pull: its velocity differs by up to 20 m/s from that of its particles at t = 0'
alike='boundary.other={name: other, velocity: [20, free], face: x-, time: {ramp: {until: 1 ms}}}'
silent "a slow ramp on a free body" 'beside it break' "$free"
says "a fast ramp on a free body" "$changes" "$free" -s 'boundary.pull.time={ramp: {until: 1 us}}'
says "a step on a free body" "$changes" "$free" -s 'boundary.pull.time={step: {from: 1 us, until: 1 s}}'
says "a constant velocity of a free body" "$changes" "$free" -s 'boundary.pull.time={table: [[0, 1], [1 s, 1]]}'
says "a slow ramp, then a spike" "$changes" "$free" -s 'boundary.pull.time={table: [[0, 0], [0.5 ms, 1], [0.501 ms, 0], [1 ms, 0]]}'
says "a slow ramp on a held body" "$held" "$free" -s 'boundary.other={name: other, fixed: [x], face: x-}'
says "a slow ramp on a body against a mirror" "$held" "$free" -s 'boundary.other={mirror: {axis: x, at: 0}}'
silent "a slow ramp along a mirror" 'beside it break' "$free" -s 'boundary.other={mirror: {axis: y, at: 0}}'
silent "a slow ramp on a body held across it" 'beside it break' "$free" -s 'boundary.other={name: other, fixed: [y], face: x-}'
silent "slow ramps alike at both ends" 'beside it break' "$free" -s "$alike"
says "opposite slow ramps" "$held" "$free" -s "$alike" -s 'boundary.other.velocity=[-20, free]'
silent "a displacement that grows slowly faster" 'beside it break' "$free" -s \
    "boundary.pull={name: pull, displacement: ['10 mm*(t/(1 ms))^2', free], face: x+}"
says "a displacement that begins with a jump of its velocity" 'changes by up to 10 m/s within' "$free" -s \
    "boundary.pull={name: pull, displacement: ['10 mm*t/(1 ms)', free], face: x+}"

# ---- collisions --------------------------------------------------------------------------------------------------------

# Two plates; the first has its speed by `initial`. What each scene can do differs.
cat >"$work/plates.yaml" <<'END'
space: plane stress
thickness: 1 mm
duration: 20 us
method: pd
material: {young: 72 GPa, density: 2440, energy_release_rate: 10 J/m^2}
bodies:
  - {name: a, shape: {box: {from: [0, 0], to: [20 mm, 10 mm]}}}
  - {name: b, shape: {box: {from: [21 mm, 0], to: [41 mm, 10 mm]}}}
particles: {spacing: 0.5 mm}
initial: [{body: a, velocity: [200, 0]}]
END
plates=$work/plates.yaml hits='^accuracy  *bodies collide at 200 m/s, .* bonds may break too early: '
says "a collision in plane stress" "${hits}compare with a run that has space: plane strain and material.viscosity" "$plates"
says "a collision in plane strain" "${hits}use material.viscosity: {}, which spreads the front" "$plates" -s 'space=plane strain'
says "a collision of ospd" "${hits}compare with a run that has model: bond and material.viscosity" "$plates" -s 'space=plane strain' -s model=ospd
silent "a collision with viscosity" 'bodies collide' "$plates" -s 'space=plane strain' -s 'material.viscosity={}'
silent "bodies that part" 'bodies collide' "$plates" -s 'initial.0.velocity=[-200, 0]'
silent "a speed elsewhere" 'bodies collide' "$plates" -s 'initial=[{velocity: [200, 0], region: {box: {from: [50 mm, 0], to: [60 mm, 10 mm]}}}]'
says "without contact" '^warning: contact.between is none, so peridynamic bodies pass through each other; set contact.between: bodies or all;' \
    "$plates" -s contact.between=none
silent "without contact: no collision" 'bodies collide' "$plates" -s contact.between=none
says "without contact, adaptive" 'warning: particles that become peridynamic pass .*, because contact.between is none' "$plates" -s contact.between=none -s method=adaptive

# ---- supports, shapes, encounters, frames ------------------------------------------------------------------------------

# A plate of 20 x 20 particles; with lengths in m in place of mm a region holds all of it and a hole lies beside it.
cat >"$work/plate.yaml" <<'END'
space: plane stress
thickness: 1 mm
duration: 10 us
method: pd
material: {young: 70 GPa, density: 2700, energy_release_rate: 10}
body: {box: {from: [0, 0], to: [20 mm, 20 mm]}}
particles: {spacing: 1 mm}
boundary: [{name: a, fixed: all, face: y-}, {name: b, velocity: [0, 0.5 m/s], face: y+}]
END
plate=$work/plate.yaml
says "a region in m" '^warning: boundary a fixes all 400 particles, so nothing can move; check the units of its region (m if none is written) (' "$plate" \
    -s 'boundary=[{name: a, fixed: all, region: {box: {from: [0, 0], to: [20, 1]}}}]'
silent "a region in mm" '^warning: boundar' "$plate" -s 'boundary.a={name: a, fixed: all, region: {box: {from: [0, 0], to: [20 mm, 1 mm]}}}'
# The layer behind a face is three particles deep.
says "two supports of a face" '^warning: boundaries a and b prescribe different motions along y of the same 60 particles: the later one, b, moves them; ' "$plate" \
    -s 'boundary.a={name: a, fixed: all, face: y+}'
# Where two faces meet, the order of the supports decides which of them moves the edge.
says "two supports that share an edge" '^warning: boundaries a and b prescribe different motions along y of the same 9 particles: the later one, b, moves them; ' \
    "$plate" -s 'boundary.a={name: a, fixed: all, face: x-}'
silent "two supports of different components" '^warning: boundar' "$plate" -s 'boundary.a={name: a, fixed: [x], face: y+}' \
    -s 'boundary.b={name: b, velocity: [free, 0.5 m/s], face: y+}'
# A traction on a face of 400 mm^2 does nothing where a support holds it; on the face x+ 3 of its 20 rows are held.
idle='% of its force along'
loaded() { echo "boundary=[{name: a, fixed: $1, face: y-}, {name: load, traction: [0, 1 MPa], face: $2}]"; }
says "a traction on a face that is held" "^warning: boundary load: 100 $idle y acts on particles whose motion along y a support prescribes, and has no effect there" \
    "$plate" -s "$(loaded all y-)"
silent "a traction on a face that is held across" "$idle" "$plate" -s "$(loaded '[x]' y-)"
silent "a traction beside a face that is held" "$idle" "$plate" -s "$(loaded all x+)"
# A layer of three of 20 rows, which shortens the plate by 2.25 mm: 20/17.75 = 1.127, its cube 1.43.
rests() { test=$1 what=$2; shift 2; "$test" "$what" 'the layer behind its face' "$plate" -s solver=cg -s 'boundary.b={name: b, traction: [0, 1 MPa], face: y+}' "$@"; }
rests says "a layer of a short body"
holds "its stiffness: $(cat "$work/said")" grep -q 'boundary a: .* of 0.02 m acts as if it were 0.00225 m shorter along y. .* +13 % in tension, +43 % in bending; set depth: 1 mm' "$work/said"
rests silent "a layer of one row" -s 'boundary.a={name: a, fixed: all, face: y-, depth: 1 mm}'
# From the corner at 20 mm to 8 m: sqrt(2) 7.98 m.
solids() { echo "body=[{box: {from: [0, 0], to: [20 mm, 20 mm]}}, {$1}]"; }
says "a hole in m" '^warning: body body: solid 2 of its shape removes nothing: it is 11.3 m from the body; check its units (m if none is written) (' "$plate" \
    -s "$(solids 'subtract: {disc: {centre: [10, 10], radius: 2}}')"
says "a hole beside a corner" 'solid 2 of its shape removes nothing, because it is outside' "$plate" \
    -s "$(solids 'subtract: {disc: {centre: [21.5 mm, 21.5 mm], radius: 2 mm}}')"
says "a disc that is not subtracted" '^warning: body body: solid 2 of its shape adds nothing, because the solids before it contain it' "$plate" \
    -s "$(solids 'disc: {centre: [10 mm, 10 mm], radius: 2 mm}')"
silent "a hole" 'of its shape' "$plate" -s "$(solids 'subtract: {disc: {centre: [10 mm, 10 mm], radius: 2 mm}}')"
silent "a disc across an edge" 'of its shape' "$plate" -s "$(solids 'disc: {centre: [20 mm, 10 mm], radius: 2 mm}')"
# From 20 mm to the lower end of a disc at 8.997 m, less a spacing, at 50 m/s: 0.1795 s.
fly() { echo "bodies=[{name: plate, shape: {box: {from: [0, 0], to: [20 mm, 20 mm]}}}, {name: ball, shape: {disc: {centre: [10 mm, $1], radius: 3 mm}}, velocity: [$2]}]"; }
says "a ball too far away" '^warning: body ball would reach plate after 0.18 s, but the duration is 1e-05 s' "$plate" -s body= -s boundary=[] -s "$(fly '9 m' '0, -50')"
says "a ball that flies away" '^warning: body ball never reaches another body, because its velocity leads past plate or away' "$plate" -s body= -s boundary=[] -s "$(fly '25 mm' '0, 50')"
says "a ball that flies away from where it touches" '^warning: body ball never reaches another body' "$plate" -s body= -s boundary=[] -s "$(fly '23 mm' '0, 50')"
says "a ball that flies away from less than a spacing" '^warning: body ball never reaches another body' "$plate" -s body= -s boundary=[] -s "$(fly '23.6 mm' '0, 50')"
silent "a ball that leans on the plate" '^warning: body ball' "$plate" -s body= -s boundary=[] -s "$(fly '23 mm' '0, -50')"
says "a ball that flies past" '^warning: body ball never reaches another body' "$plate" -s body= -s boundary=[] -s "$(fly '25 mm' '50, 0')"
silent "a ball that hits" '^warning: body ball' "$plate" -s body= -s boundary=[] -s "$(fly '24.1 mm' '0, -50')"
says "frames every 1 s" '^warning: output.every: 1 s is longer than the duration of 1e-05 s, so' "$plate" -s output.every=1
says "frames after the end" '^warning: output.times: 1 of 2 are after the duration of 1e-05 s (the last at 0.001 s)' "$plate" -s 'output.times=[1 us, 1 ms]'
silent "frames within the run" '^warning: output' "$plate" -s 'output.times=[1 us, 10 us]'
# 12 spacings are 3.98 horizons of 3.015 spacings; 11 are 3.65, and 11 mm/12.06 = 0.912 mm.
silent "a part of nearly four horizons" '^accuracy  *body body: a part' "$plate" -s 'body={box: {from: [0, 0], to: [20 mm, 12 mm]}}'
says "a part of less than four horizons" 'a part is 0.011 m thick, which is 3.65 horizons (11 spacings); .* use a spacing of 0.91 mm' "$plate" -s 'body={box: {from: [0, 0], to: [20 mm, 11 mm]}}'
"$cleave" check "$plate" -s solver=cg -s 'boundary.b={name: b, displacement: [0, 1 um], face: y+}' >"$work/said" 2>&1
holds "an equilibrium: run time with a range: $(cat "$work/said")" \
    grep -q '^run time  *about .* s for 1000 steps ([0-9.e-]* to [0-9.e-]* s), up to [0-9.e+]* s for the largest number of steps, 200000,' "$work/said"
# The plate tears along the face that is pulled at 5 m/s, not at its pre-crack.
"$cleave" run "$plate" -o "$work/torn" -s duration=30us -s boundary.b.velocity='[0, 5 m/s]' -s 'cracks=[{from: [-1 mm, 10.1 mm], to: [8 mm, 10.1 mm]}]' \
    >"$work/said" 2>/dev/null
holds "place of the longest crack: $(cat "$work/said")" \
    grep -q 'longest crack grew 19 mm at 0 degrees, from (0.0005, 0.0165) to (0.0195, 0.0165) m, not from a pre-crack\(, [0-9]* % of it by joining others, which has no speed\)\{0,1\}$' "$work/said"
"$cleave" run inputs/bar_spall.yaml -o "$work/bar" >"$work/said" 2>/dev/null
holds "bonds that break in a bar are no crack: $(cat "$work/said")" \
    grep -q 'longest zone of broken bonds grew 5 mm, from (0.2075) m$' "$work/said"
free='boundary=[{traction: [0, 1 MPa], face: y+, time: {step: {from: 1 ms, until: 1 s}}}]'
says "a load after the end" '^warning: nothing loads the body: no load, speed or displacement differs from 0 up to 1e-05 s;' "$plate" -s "$free"
silent "a load after the end that is meant" 'nothing loads' "$plate" -s "$free" -s 'accept=[stress]'
says "no load" '^warning: nothing loads the body' "$plate" -s boundary=[]
says "a spacing larger than the body" 'body body: contains no particle: its shape is at most 0.02 x 0.02 m, the spacing 0.05 m' "$plate" -s particles.spacing=50mm

finish
