#!/bin/sh
# Output of `cleave check`: memory, unresolved and unnecessary features of a scene, probable mistakes; and no output without a cause. Run
# times are not tested, because they depend on the load of the machine.
# Takes 40 s: 150 scenes are set up, some of them with 1e5 particles, because small scenes have no coarse cells.
test_name=test_check
. tests/support/summary.sh
. tests/support/scenes.sh

# checked SCENE [ARGUMENT...]: writes the output of check to the file `said`. trial: the option --no-trial, which omits run time and
# memory, whose trial steps take a second or two; `costs` clears it.
trial=--no-trial
checked()
{
    scene=$1; shift
    [ -f "$scene" ] || scene=inputs/$scene.yaml
    "$cleave" check "$scene" $trial "$@" >"$work/said" 2>&1 || fail "check $scene $*: $(cat "$work/said")"
}

# says, silent, costs WHAT PATTERN SCENE [ARGUMENT...]: check that the output of check for the scene contains the pattern; that it does
# not; that it does, with trial steps.
costs() { trial=; says "$@"; trial=--no-trial; }
says() { what=$1 pattern=$2; shift 2; checked "$@"; holds "$what" grep -q "$pattern" "$work/said"; }
silent() { what=$1 pattern=$2; shift 2; checked "$@"; holds "$what" sh -c "! grep -q '$pattern' '$work/said'"; }

# ---- cost of a run -----------------------------------------------------------------------------------------------------

# Within 10 % of the system's high-water mark. Nothing converts in the first five steps.
for setting in "method=pd" "method=mpm" "method=mpm -s mpm.frame=current" "method=adaptive" "method=pd -s model=mospd"; do
    arguments="-s $setting -s particles.spacing=0.25mm -s time.step=0.02us -s duration=0.1us -s output.frames=1"
    "$cleave" run inputs/plate_crack.yaml -q -o "$work/ran" $arguments >/dev/null 2>&1
    costs "memory: $setting" '^memory' plate_crack $arguments
    took=$(awk '/^memory/ { print 1e6 * $3 }' "$work/said")
    between "memory: $setting" "$took" "$(compute "0.9 * $(figure "$work/ran" memory_peak_bytes)")" \
        "$(compute "1.1 * $(figure "$work/ran" memory_peak_bytes)")"
    rm -rf "$work/ran"
done
costs "all of it peridynamic" 'run time.* if all of it were peridynamic' plate_crack
costs "it is" '^run time' plate_crack -s method=pd
holds "it is: no other time" sh -c "! grep -q 'were peridynamic' '$work/said'"
says "no trial" '^time step' plate_crack
holds "no trial: neither run time nor memory" sh -c "! grep -qE '^(run time|memory)' '$work/said'"
# A plate turned by a right angle has the same step.
cat >"$work/turned.yaml" <<'END'
space: plane stress
thickness: 1 mm
duration: 40 us
method: pd
material: {young: 72 GPa, density: 2440, energy_release_rate: 20}
body: {box: {from: [0, 0], to: [40 mm, 10 mm]}}
particles: {spacing: 0.5 mm}
initial: [{velocity_gradient: [[1, 0], [0, 1]]}]
END
step_of() { "$cleave" check --no-trial "$work/turned.yaml" -s "body.box.to=$1" 2>&1 | grep '^time step'; }
is "a plate turned by a right angle: time step" "$(step_of '[40 mm, 10 mm]')" "$(step_of '[10 mm, 40 mm]')"
# Short runs are tried completely. 1e7 steps are not tried, and the prediction assumes that all are like the first; a step above the
# critical one fails in the trial.
costs "tried" 'run time  *about .* the first steps take .* ns per particle; [0-9.e-]* s if all' bar_spall -t 1
costs "too long to try" 'run time  *at least .* as long as the first ones, and steps take longer as particles convert' plate_crack -s duration=1s
costs "too long, but nothing converts" 'run time  *about .* as long as the first ones$' plate_crack -s duration=1s -s method=mpm
costs "fails" 'run time  *at least' plate_crack -s time.step=0.3us -s output.samples=500
[ -e results/plate_crack/history.csv ] && before=$(ls -l results/plate_crack/history.csv) || before=
costs "check writes nothing: tried" "^run time" plate_crack
[ -e results/plate_crack/history.csv ] && after=$(ls -l results/plate_crack/history.csv) || after=
is "check writes nothing" "$after" "$before"

# ---- coarse cells ------------------------------------------------------------------------------------------------------

# A plate 200 spacings wide with 133,400 particles; waves travel 38.4 spacings per microsecond. Levels and their savings; why there are that
# many, or none; and too many levels in the scene. Limits: 2.5 cells in a rise, 10 in a pulse, 50 across a suddenly loaded body (a warning
# from 25 on). A disc of radius 20 has 400 pi squares; its box does not count.
cat >"$work/disc.yaml" <<'END'
space: plane stress
thickness: 1
duration: 1 ms
method: mpm
material: {young: 1 GPa, density: 1000}
body: {disc: {centre: [0, 0], radius: 20}}
particles: {spacing: 1}
END
says "filled" '^filled  *body body: its particles fill 1300 m^3, 3.45 % more than its shape' "$work/disc.yaml" -s particles.spacing=5
silent "filled: less than anyone acts on" '^filled' "$work/disc.yaml"
silent "filled: boxes" '^filled' "$work/disc.yaml" -s 'body={box: {from: [0, 0], to: [20, 20]}}'
# Loads: 20 x 10 m^2 under 3 Pa at half of a pulse, linear in x towards the end, the weight of 400 m^2; areas of faces that the spacing does
# not divide; a circle of radius 20, on which steps are closer than a tenth of a spacing.
checked "$work/disc.yaml" -s 'body={box: {from: [0, 0], to: [20, 20]}}' -s 'gravity=[0, -10 m/s^2]' -s 'boundary=[
    {traction: [0, 3 Pa], face: y+, region: {box: {from: [10, 0], to: [20, 20]}}, time: {pulse: {until: 1 ms}}, name: a},
    {traction: ["2 Pa*x/(1 m)*t/(1 ms)", 0], face: x+, name: b}, {fixed: [y], region: {box: {from: [0, 0], to: [20, 1]}}, name: c},
    {displacement: [2 mm, free], face: x-, time: {ramp: {until: 1 ms}}, name: d}]'
amounts() { holds "$1" grep -qxF "$1" "$work/said"; }
amounts 'load           a: traction on y+, 10 particles, 10 m^2; force (0, 30) N, moment about the origin 450 N m when it is largest, at 0.0005 s'
amounts 'load           b: traction on x+, 20 particles, 20 m^2; force (780, 0) N, moment about the origin -7800 N m at the end'
amounts 'support        c: y held, 20 particles'
amounts 'support        d: x driven on x-, 20 particles; by (0.002, 0) m at the end, at most 2 m/s'
amounts 'load           gravity: weight, 400 particles; force (0, -4e+06) N, moment about the origin -4e+07 N m at all times'
says "area" '20 m^2 (2.56 % more than the face of its box)' "$work/disc.yaml" -s 'body={box: {from: [0, 0], to: [19.5, 19.5]}}' \
    -s 'boundary=[{traction: [0, 3 Pa], face: y+}]'
says "round" 'pressure, [0-9]* particles, 12[56][0-9.]* m^2 0.0[0-9]* spacings [a-z]* the surface of its shape on average; force (0, 0)' \
    "$work/disc.yaml" -s 'boundary=[{pressure: 1 Pa}]'
# The worst time is not the end: a table that decreases, formulas of t for displacements and forces; a formula without a value.
checked "$work/disc.yaml" -s 'body={box: {from: [0, 0], to: [20, 20]}}' -s 'boundary=[
    {traction: ["2 Pa*sin(2*pi*t/(1 ms))", 0], face: x+, name: b},
    {displacement: ["-2 mm*sin(0.75*pi*t/(1 ms))", free], face: x-, depth: 1, region: {box: {from: [0, 10], to: [20, 20]}}, name: f},
    {displacement: [2 mm, free], face: x-, depth: 1, region: {box: {from: [0, 0], to: [20, 10]}}, name: d,
        time: {table: [[0, 0], [0.3 ms, -1], [1 ms, 0.5]]}}]'
amounts 'load           b: traction on x+, 20 particles, 20 m^2; force (40, 0) N, moment about the origin -400 N m when it is largest, at 0.00025 s'
amounts 'support        d: x driven on x-, 10 particles; by (-0.002, 0) m when it is largest, at 0.0003 s, by (0.001, 0) m at the end, at most 6.67 m/s'
holds "formula" grep -q '^support  *f: .*; by (-0.002, 0) m when it is largest, at 0.000665 s, by (-0.001414, 0) m at the end' "$work/said"
says "formula without value" 'boundary b: its formula has no finite value at ([^)]*) m and t = 0.00051 s; .*; the run will stop at that time' "$work/disc.yaml" \
    -s 'body={box: {from: [0, 0], to: [20, 20]}}' -s 'boundary=[{traction: ["2 Pa*sqrt(1-t/(0.5 ms))", 0], face: x+, name: b}]'
holds "formula without value at the end: the largest force" grep -q '; force (40, 0) N, .* when it is largest, at 0 s$' "$work/said"
holds "no figure that is none" sh -c "! grep -qE '(nan|inf)[,) ]' '$work/said'"
# Points of the current frame share no nodes beyond twice their distance: a body of 20 that is extended by 40, and back.
says "pulled apart on the way" 'stretched to 3[.0-9]* times its length' "$work/disc.yaml" -s 'body={box: {from: [0, 0], to: [20, 20]}}' \
    -s mpm.frame=current -s duration=1s -s 'boundary=[{displacement: ["40 m*sin(pi*t/(1 s))", free], face: x+, depth: 1}, {fixed: [x], face: x-, depth: 1}]'

# Load steps: 19 bonds of one spacing between driven ends are stretched by u/19 mm, above the limit of 1 %. Worst times: at a maximum of the
# table; at the end, after compression; where sin is 1; where one end moves by 0.05 and the other by 0.025 mm.
cat >"$work/back.yaml" <<'END'
space: line
section: 0.37 cm^2
duration: 2 s
solver: static
steps: {number: 20}
method: pd
material: {young: 1 GPa, density: 2000, critical_stretch: 1 %}
pd: {surface: none}
body: {box: {from: [0], to: [20 mm]}}
particles: {spacing: 1 mm, horizon: 1.015}
boundary:
  - {name: foot, fixed: [x], face: x-, depth: 1 mm}
  - {name: top, displacement: [0.1 mm], face: x+, depth: 1 mm, time: {table: [[0, 0], [1 s, 1], [2 s, -0.1]]}}
END
pulled() { echo "boundary=[{name: foot, $1, face: x-, depth: 1 mm}, {name: top, $2, face: x+, depth: 1 mm}]"; }
trial=
reach() { says "worst load time" "stretched bond reaches only $1 of its limit, at a pseudo-time of $2 s, and nothing" "$work/back.yaml" -s "$3"; }
reach 0.53 1 name=back
reach 0.26 2 "$(pulled 'fixed: [x]' 'displacement: [0.1 mm], time: {table: [[0, 0], [1 s, -1], [2 s, 0.5]]}')"
reach 0.53 1 "$(pulled 'fixed: [x]' 'displacement: ["0.1 mm*sin(pi*t/(2 s))"]')"
reach 0.39 1 "$(pulled 'displacement: [-0.05 mm], time: {table: [[0, 0], [1 s, 1], [2 s, -1]]}' 'displacement: [0.05 mm], time: {ramp: {until: 2 s}}')"
silent "what breaks on the way" 'nothing breaks' "$work/back.yaml" \
    -s "$(pulled 'fixed: [x]' 'displacement: [0.2 mm], time: {table: [[0, 0], [1 s, 1], [2 s, 0.1]]}')"
trial=--no-trial

cat >"$work/far.yaml" <<'END'
space: plane stress
thickness: 1 mm
duration: 5 us
method: mpm
material: {young: 72 GPa, poisson: 1/3, density: 2440 kg/m^3}
body: {box: {from: [0, 0], to: [100 mm, 30 mm]}}
particles: {spacing: 0.15 mm, horizon: 3.015}
boundary:
  - {name: pull, traction: [0, 12 MPa], face: y+}
output: {frames: 0, samples: 5}
END
pulls() { echo "boundary=[{name: pull, traction: [0, 12 MPa], face: y+, time: {$1}}]"; }
far=$work/far.yaml ramp=$(pulls 'ramp: {until: 0.6 us}') quick=$(pulls 'ramp: {until: 0.1 us}') pulse=$(pulls 'pulse: {until: 2 us}')
needs='^levels  *coarse cells of up to' largest='the largest that resolve the waves'
says "levels by the size" "$needs 4 spacings, $largest (boundary pull is sudden) or of which at least 50 fit into the thickness of the body, 200 spacings" "$far"
says "levels by a ramp" "$needs 8 spacings, $largest (boundary pull rises within 6e-07 s, in which a wave travels 23 spacings)" "$far" -s "$ramp"
says "levels and a quick ramp" "$needs 4 spacings, $largest (boundary pull rises .* travels 3.84 spacings) or of which at least 50 fit into the thickness of the body" "$far" -s "$quick"
late=$(pulls 'ramp: {from: 5 us, until: 5.1 us}')
says "a quick ramp, whenever it begins" 'boundary pull changes within the time in which a wave travels 3.84 spacings; waves' "$far" -s "$late"
says "levels by a pulse" "$needs 4 spacings, $largest (boundary pull makes a wave 76.8 spacings long)" "$far" -s "$pulse"
says "levels by nothing" "$needs 32 spacings, $largest (nothing loads the body)" "$far" -s boundary=[]
says "levels: cells" '^levels  *[0-9]* cells with edges of 2 spacings, [0-9]* cells with edges of 4 spacings, [0-9]* cells with edges of 8' "$far" -s "$ramp"
costs "levels: what they save" '^levels  *[0-9]* of 133400 particles are in [0-9]* coarse cells; memory [0-9]* MB; about' "$far"
says "levels: none, too small" '^levels  *no coarse cells: the body has only [0-9]* particles, and coarse cells save time only with 100000 or more' "$far" -s "body={box: {from: [0, 0], to: [100 mm, 12 mm]}}"
says "levels: none, a long step" '^levels  *no coarse cells: time.step is 0.7[0-9] of the critical time step, but coarse cells are stable only up to 0.70' "$far" -s time.step=0.03us
narrow="body={box: {from: [0, 0], to: [200 mm, 15 mm]}}"
says "levels: none, too sudden" 'no coarse cells: boundary pull is sudden, but cells of 4 spacings require loads that rise so slowly that a wave meanwhile travels at least 10 spacings, or a body at least 200 .*(this one: 100)$' "$far" -s "$narrow"
says "levels given" '^levels  *coarse cells of up to 16 spacings, set by mpm.levels; auto would choose: coarse cells of up to 4' "$far" -s mpm.levels=3
says "levels: none, too thin" 'no coarse cells: they need parts at least 24 spacings thick (6 cells of 4 spacings), and the body has none$' "$far" -s boundary=[] \
    -s "body={box: {from: [0, 0], to: [1200 mm, 3 mm]}}"
says "levels given to a thin body" 'accuracy  *mpm.levels: 1 makes coarse cells of 4 spacings in thin parts, such as at .* (100 % of all coarse cells)' "$far" -s mpm.levels=1 \
    -s "body={box: {from: [0, 0], to: [200 mm, 2 mm]}}"
silent "levels of what has no cells" '^levels' plate_crack -s method=pd
costs "few particles made" '^levels  *321536 particles would fill the body; coarse cells reduce them to 44736 at the start; memory \([6-9][0-9]\|10[0-9]\) MB instead of 221 MB; \(at least\|about\) .* if all of it' \
    kalthoff_3d_fine -s mpm.levels=1 -s particles.spacing=0.5mm -s time.step=auto -s probes=[] -s "body[0].box.to=[100 mm, 100 mm, 4 mm]" \
    -s "body[1].add.box.to=[0, 24 mm, 4 mm]" -s "boundary[0].region.box.to=[0, 24 mm, 4 mm]"

# too_coarse WHAT PATTERN ARGUMENT...: checks that check reports the pattern, and that the run reports it once.
too_coarse()
{
    load=$1 words=$2; shift 2
    says "$load" "^accuracy  *mpm.levels: $words" "$far" "$@"
    rm -rf "$work/ran"
    "$cleave" run "$far" -q -o "$work/ran" -s duration=0.1us "$@" >/dev/null 2>"$work/err"
    is "$load: warned once" "$(grep -c "^warning: mpm.levels: $words" "$work/err")" 1
}
initial_pulse() { echo "initial=[{pulse: {at: [50 mm, 0], direction: [1, 0], width: $1, velocity: 1}}]"; }
too_coarse "a pulse of 77 spacings" '4 makes .* a wave 76.8 spacings long: cells of this size require waves at least 320 spacings long; set mpm.levels: 1 or auto' -s "$pulse" -s mpm.levels=4
too_coarse "a pulse of 60 spacings" '4 makes coarse cells of 32 spacings, but initial pulse 1 makes a wave 60 ' -s boundary=[] -s "$(initial_pulse "9 mm")" -s mpm.levels=4
too_coarse "a sudden load" '2 makes .* is sudden: cells of this size require loads that rise so slowly that a wave meanwhile travels at least 20 spacings.*or a body at least 200 .*(this one: 100); set mpm.levels: 1 or auto' -s "$narrow" -s mpm.levels=2
too_coarse "a ramp of 23 spacings" '3 makes .* require loads that rise so slowly that a wave meanwhile travels at least 40 spacings.*or a body at least 400 .*(this one: 200); set mpm.levels: 2 or auto' -s "$ramp" -s mpm.levels=3
silent "a ramp of 23 spacings and cells of 8" 'accuracy  *mpm.levels' "$far" -s "$ramp" -s mpm.levels=2
silent "a pulse of 220 spacings and cells of 16" 'accuracy  *mpm.levels' "$far" -s boundary=[] -s "$(initial_pulse "33 mm")" -s mpm.levels=3
silent "a rotation at rate 0" ' is sudden' "$far" -s boundary=[] -s "initial=[{rotation: {centre: [0, 0], rate: 0}}]" -s mpm.levels=2
silent "a sudden load and cells of 4" 'accuracy  *mpm.levels' "$far" -s "$narrow" -s mpm.levels=1
# Keys without effect.
cells="-s mpm.levels=2 -s mpm.fill=needed -s conversion.notch=slit"
says "levels without cells" 'warning: mpm.levels: 2 has no effect, because method pd has no cells' plate_crack -s method=pd $cells
says "fill without cells" 'warning: mpm.fill: needed has no effect (all particles are made), because method pd' plate_crack -s method=pd $cells
says "slit of bonds" 'warning: conversion.notch: slit has no effect with method: pd' plate_crack -s method=pd $cells
says "slit of points" 'warning: conversion.notch: slit has no effect with method: mpm' plate_crack -s method=mpm $cells
says "levels of the current frame" 'warning: mpm.levels: 2 has no effect, because no material points are in the reference' plate_crack \
    -s mpm.frame=current -s mpm.levels=2
says "levels at rest" 'warning: mpm.levels: 2 has no effect, because a static solver' plate_crack -s method=mpm -s solver=relaxation \
    -s mpm.transfer=apic -s mpm.levels=2
says "fill without levels" 'warning: mpm.fill: needed has no effect .*, because there are no coarse cells' plate_crack -s mpm.fill=needed
silent "keys that have none and say so" 'has no effect' plate_crack -s method=pd -s mpm.levels=0 -s conversion.notch=bonds
silent "keys that have" 'has no effect' "$far" -s mpm.levels=1 -s mpm.fill=needed

# ---- not resolved ------------------------------------------------------------------------------------------------------

says "thin plate" 'accuracy  *body body: a part is 0.01 m thick, which is 1.66 horizons (5 spacings)' kalthoff_winkler_3d
silent "thick plate" 'accuracy  *body' kalthoff_winkler
# Between rollers families are complete; beside one, the body counts twice.
rollers() { sed "/name: $1/d" inputs/plate_pulse.yaml >"$work/rollers.yaml"; }
silent "thin between mirrors" 'accuracy  *body' plate_impact_3d
rollers high
says "thin beside a mirror" 'accuracy  *body body: a part is 0.008 m thick, which is 2.65 horizons (8 spacings)' "$work/rollers.yaml"
holds "a spacing is advised in the unit of the scene" grep -q 'lack neighbours beyond a face; use a spacing of [0-9.]* mm' "$work/said"
silent "thick beside a mirror" 'accuracy  *body' "$work/rollers.yaml" -s "body={box: {from: [0, 0], to: [1024 mm, 8 mm]}}"
silent "narrow hole" 'accuracy  *body' plate_hole -s particles.spacing=2mm
silent "wide hole" 'accuracy  *body' plate_hole
says "a probe at a curved face" 'accuracy  *probe rim: it is at a curved or slanted face of body .* the lattice turns into steps' plate_hole \
    -s 'probes=[{point: {name: rim, at: [0, 5 mm]}}]'
silent "a probe at a flat face" 'accuracy  *probe' plate_hole -s 'probes=[{point: {name: side, at: [25 mm, 5 mm]}}]'
says "short crack" 'accuracy  *crack 1 is 0.01 m long, 3.3 horizons' plate_crack -s particles.spacing=1mm
silent "long crack" 'accuracy  *crack' plate_crack
# A crack from a face has one tip: its length in the body is that of half a crack. Four horizons are 30.7 mm here.
notched() { sed "s/19 mm\], width/$1 mm], width/" inputs/three_point_bend.yaml >"$work/notched.yaml"; }
silent "crack from a face" 'accuracy  *crack' three_point_bend
notched 14
says "short crack from a face" 'accuracy  *crack 1 is 0.014 m deep, 1.8 horizons, so the face affects its tip' "$work/notched.yaml"
notched 90
silent "crack through the body" 'accuracy  *crack' "$work/notched.yaml"
says "narrow pulse" 'accuracy  *an initial pulse is .* spacings wide' bar_pulse -s particles.spacing=40mm
silent "wide pulse" 'initial pulse' bar_pulse

# The ends of the plate's crack are midway between four particles, on their diagonals and longer bonds: six. A tenth of a spacing away they
# are on none.
says "ends on bonds" 'crack 1: its ends lie exactly on 6 bonds each, and these are cut' plate_crack
sed 's/-5 mm, 0\], to: \[5 mm/-5.05 mm, 0], to: [5.05 mm/' inputs/plate_crack.yaml >"$work/apart.yaml"
silent "ends between bonds" 'exactly on' "$work/apart.yaml"
# None at the contact of plate and projectile.
checked kalthoff_projectile
is "ends between bodies" "$(grep -c 'exactly on' "$work/said") $(grep -c 'crack [12]: an end lies exactly on 6 bonds, and these' "$work/said")" "2 2"

# pulled FILE RATE TIME: writes the scene FILE.yaml of a plate loaded at its right end, with RATE and TIME of the load.
pulled() { sed "s/RATE/$2/; s/TIME/$3/" "$work/plate.yaml" >"$work/$1.yaml"; }
cat >"$work/plate.yaml" <<'END'
space: plane stress
thickness: 1 mm
duration: 1 ms
method: mpm
material: {young: 1 MPa, poisson: 1/3, density: 1000}
body: {box: {from: [0, 0], to: [20 mm, 10 mm]}}
particles: {spacing: 1 mm}
mpm: {frame: current}
boundary:
  - {name: left, fixed: all, region: {box: {from: [0, 0], to: [1 mm, 10 mm]}}}
  - {name: right, velocity: [RATE, free], region: {box: {from: [19 mm, 0], to: [20 mm, 10 mm]}}, time: {ramp: {from: 0, until: TIME}}}
output: {frames: 0, samples: 1}
END
# A ramp to 60 m/s in 1 ms: 30 mm over 19 mm between the outermost particles, a stretch of 2.58; two points per cell. Waves travel at 33
# m/s: 34 spacings during the ramp, 3.4 in a tenth of the time.
pulled fast '60 m\/s' '1 ms'
pulled slow '25 m\/s' '1 ms'
pulled sudden '25 m\/s' '0.1 ms'
says "pulled apart" 'stretched to 2.58 times' "$work/fast.yaml"
silent "held together" 'no longer share nodes' "$work/slow.yaml"
silent "in time" 'no longer share nodes' "$work/fast.yaml" -s mpm.cell=3
says "sudden load" 'boundary right changes within the time in which a wave travels 3.3. spacings' "$work/sudden.yaml"
silent "slow load" 'changes while' "$work/slow.yaml"

# ---- not needed --------------------------------------------------------------------------------------------------------

# Directed bonds take 0.44 and 0.55 ns in 2D and 3D, ospd 0.75 ns in 2D, mospd 2.2 ns in 3D.
says "bonds would do" "model: bond also has .*, 0.3333, and takes only 59 % of the time of ospd" plate_crack -s model=ospd
says "bonds would do in 3D" "model: bond also has .*, 0.25, and takes only 25 % of the time of mospd" kalthoff_winkler_3d -s method=pd -s model=mospd -s pd.surface=none
silent "bonds would not" 'model: bond also has' plate_crack -s model=ospd -s material.poisson=0.25
# Edges move at 36 m/s in steel of 192 GPa, 8000 kg/m^3, with waves at 5196 m/s: strain 4 rho c v/E = 0.0312, until the waves have crossed
# the plate's 0.1 m four times, after 77 us.
says "reference frame would do" 'body body touches no other body, .* strain it by at most 0.031: set mpm.frame: auto in place of current' plate_crack -s mpm.frame=current
says "who knows how far" 'body body touches no other body: set mpm.frame: ' plate_crack -s mpm.frame=current -s duration=80us
says "it would but for a key" 'body body touches no other body.*: set mpm.frame: reference in place of current' plate_crack -s mpm.transfer=apic
silent "it does" 'in place of current' plate_crack
silent "bodies meet" 'in place of current' hopkinson_bar
says "nothing breaks" 'no bond can break: .*; method: mpm is enough and faster; set it in place of pd' bar_step
silent "bonds meet rigid bodies" 'method: mpm is enough' slope
# 4 rho c v = 4 x 1000 kg/m^3 x 33.54 m/s x 25 m/s; the waves have crossed the plate's 20 mm four times after 2.4 ms.
says "too slow to break" 'stress in waves is at most 3.35e+06 Pa, but bonds break at 6e+07 Pa: method: mpm is enough and faster; set it in place of adaptive' "$work/slow.yaml" -s method=adaptive -s material.critical_stretch=60
silent "waves pile up" 'method: mpm is enough' "$work/slow.yaml" -s method=adaptive -s material.critical_stretch=60 -s duration=3ms
silent "fast enough" 'method: mpm is enough' "$work/slow.yaml" -s method=adaptive -s material.critical_stretch=0.1

says "halves" 'the scene is symmetric about y = 0 m (all 20150 particles, .*): half of the body with a boundary .mirror. there' kalthoff_winkler
silent "no halves across the impact" 'symmetric about[^(]*x =' kalthoff_winkler
silent "a half is none" 'symmetric about' kalthoff_sif
checked plate_crack
is "quarters" "$(grep -c 'symmetric about x = 0 m and y = 0 m .*: a quarter of the body' "$work/said")" 1
silent "turned crack" 'symmetric about' inclined_crack
says "rigid bodies, too" 'symmetric about[^(]*y =' hertz_2d
silent "one jaw faster" 'symmetric about[^(]*y =' hertz_2d -s bodies.upper.velocity=[0,-6]
says "one jaw faster, even sides" 'symmetric about[^(]*x =' hertz_2d -s bodies.upper.velocity=[0,-6]
silent "one jaw wider" 'symmetric about[^(]*y =' hertz_2d -s bodies.upper.shape.box.from=[-20mm,20.1mm]
silent "no mirror for what flies" 'symmetric about' sphere_on_plate_3d -s particles.spacing=2mm
silent "five layers" 'symmetric about' kalthoff_winkler_3d
silent "half a ring of factors" 'symmetric about' edge_crack_k1
says "no such ring" 'symmetric about[^(]*y = 0.005' edge_crack_k1 -s probes=[]
growing() { echo "growth=[{at: [12 mm, 0], direction: $1, speed: 34.6 m/s, start: 20 us}]"; }
says "a crack grows along the mirror" 'symmetric about[^(]*y =' load_displacement
silent "a crack grows away" 'symmetric about' load_displacement -s "$(growing '[1, 1]')"
sed 's/-18 m\/s/-17 m\/s/' inputs/plate_crack.yaml >"$work/uneven.yaml"
silent "uneven loads" 'symmetric about[^(]*y =' "$work/uneven.yaml"
says "uneven loads, even sides" 'symmetric about[^(]*x =' "$work/uneven.yaml"
sed 's/to: \[5 mm, 0\]/to: [6 mm, 0]/' inputs/plate_crack.yaml >"$work/uneven.yaml"
silent "crack to one side" 'symmetric about[^(]*x =' "$work/uneven.yaml"

# ---- probable mistakes ---------------------------------------------------------------------------------------------------

# warned WHAT PATTERN SCENE [ARGUMENT...]: checks that check prints the warning, and that a run with -q prints it on standard error and
# writes it to the summary.
warned()
{
    says "$@"
    what=$1 pattern=$2 scene=$3; shift 3
    "$cleave" run "$scene" -q -o "$work/warned" "$@" >"$work/out" 2>"$work/err" || fail "$what: run: $(cat "$work/err")"
    holds "$what: -q says so: $(cat "$work/err")" grep -q "^warning: .*$pattern" "$work/err"
    is "$what: standard output" "$(cat "$work/out")" ""
    is "$what: in the summary" "$(grep -c "^    \".*$pattern" "$work/warned/summary.json")" 1
    is "$what: as many as said" "$(sed -n '/"warnings": \[/,/^  \]/p' "$work/warned/summary.json" | grep -c '^    "')" \
        "$(grep -c '^warning: ' "$work/err")"
    rm -rf "$work/warned"
}
cat >"$work/two.yaml" <<'END'
space: plane stress
thickness: 1 mm
duration: 1 us
accept: [steps]
method: mpm
mpm: {frame: current}
materials:
  - {name: steel, young: 200 GPa, poisson: 1/3, density: 7850}
  - {name: glass, young: 72 GPa, poisson: 1/3, density: 2440}
bodies:
  - {name: left, material: steel, shape: {box: {from: [0, 0], to: [6 mm, 6 mm]}}}
  - {name: right, material: glass, shape: {box: {from: [6 mm, 0], to: [12 mm, 6 mm]}}}
particles: {spacing: 1 mm}
output: {frames: 0, samples: 1}
END
two=$work/two.yaml apart="-s bodies.right.shape.box.from=[10mm,0]"
through="left and right are in the reference frame (mpm.frame), in which material points have no contact and pass through"
says "bodies meet on the grid" '^contact .*left, right with each other, on a grid for each' "$two" $apart
says "on one grid they stick" '^contact .*stick' "$two" $apart -s contact.between=none
silent "the grid lets bodies meet" '^warning' "$two" $apart
warned "reference frame" "$through" "$two" $apart -s mpm.frame=reference
silent "reference frame: none meets" '^contact' "$two" $apart -s mpm.frame=reference
says "one of two in the reference frame" 'left is in the reference frame (mpm.frame), in which material points have no contact' "$two" $apart -s bodies.left.frame=reference
warned "bonds" 'contact.between is none, so peridynamic bodies pass through each other' "$two" $apart -s method=pd -s contact.between=none
says "bodies of bonds meet" '^contact .*left, right with each other and with itself' "$two" $apart -s method=pd
silent "bonds that meet" 'pass through' "$two" $apart -s method=pd -s contact.between=bodies
warned "adaptive" 'pass through the material points of other bodies, because contact.convert is false' "$two" $apart -s method=adaptive -s contact.convert=false
silent "adaptive, which converts what comes near" 'pass through' "$two" $apart -s method=adaptive
warned "side by side" 'touch at the start (left with right), but no bond joins them, so they separate freely; to join them, use the key interfaces' "$two" -s method=pd
says "side by side on the grid" '(left with right), but no bond joins them' "$two"
says "side by side on one grid" '(left with right), but no bond joins them, .* they stick together only until' "$two" -s contact.between=none
silent "side by side, about to hit" 'touch at the start' "$two" -s bodies.left.velocity=[1,0]
silent "two spacings apart" 'touch at the start' "$two" -s bodies.right.shape.box.from=[7mm,0]
warned "a published coupling" 'coupling: pgg, as published, has forces that do not derive from an energy' inputs/plate_crack.yaml -s coupling=pgg -s duration=1us
silent "one that is not used" 'do not derive from an energy' plate_crack -s coupling=pgg -s method=pd
"$cleave" run "$two" -q -o "$work/warned" $apart
is "nothing to warn of: an empty list" "$(grep -c '"warnings": \[\]' "$work/warned/summary.json")" 1
# Weights of bonds near faces require a single lattice, also beyond mirrors and interfaces: a refusal states where it ends.
# refused WHAT PATTERN SCENE [ARGUMENT...]: checks that check refuses the scene with a line that contains the pattern.
refused() { what=$1 pattern=$2; shift 2; "$cleave" check "$@" --no-trial >/dev/null 2>"$work/err"; holds "$what: $(cat "$work/err")" grep -qF "$pattern" "$work/err"; }
cat >"$work/rows.yaml" <<'END'
space: plane stress
thickness: 1 mm
duration: 1 us
method: pd
material: {young: 70 GPa, density: 2700}
bodies:
  - {name: ring, shape: {ring: {centre: [0, 0], radius: 15 mm, inner: 7.3 mm}}}
  - {name: core, shape: {disc: {centre: [0, 0], radius: 7.3 mm}}}
interfaces: [{bodies: [ring, core]}]
particles: {spacing: 1 mm}
output: {frames: 0, samples: 1}
END
rows=$work/rows.yaml
refused "two lattices at an interface" 'bodies ring and core are joined, but not on one lattice: their particles at (' "$rows"
refused "two lattices: how far off" ') m are (1.5, 2.5) spacings apart; give sizes and positions of both in whole spacings, or set pd.surface: volume' "$rows"
says "one lattice at an interface" 'is sound\|can be run' "$rows" -s bodies.ring.shape.ring.inner=8mm -s bodies.core.shape.disc.radius=8mm
says "two lattices, which surface volume takes" 'is sound\|can be run' "$rows" -s pd.surface=volume
refused "rows beside a mirror" 'body body: the mirror of boundary half at y = 0 m does not continue the lattice of particles, whose first row is 0.25 spacings from the plane, not 0.5; make the size of the body along y' \
    "$rows" -s bodies= -s interfaces= -s 'boundary=[{name: half, mirror: {axis: y, at: 0}}]' -s 'body={box: {from: [0, 0], to: [40 mm, 3.5 mm]}}'
says "rows that fit a mirror" 'is sound\|can be run' \
    "$rows" -s bodies= -s interfaces= -s 'boundary=[{name: half, mirror: {axis: y, at: 0}}]' -s 'body={box: {from: [0, 0], to: [40 mm, 3 mm]}}'
# A grip that tears off in the trial steps, some of which are repeated, causes one warning.
cat >"$work/grip.yaml" <<'END'
space: plane stress
thickness: 1 mm
duration: 0.4 ms
method: pd
material: {young: 1 GPa, density: 2000, critical_stretch: 1 %}
body: {box: {from: [0, 0], to: [10 mm, 10 mm]}}
particles: {spacing: 1 mm}
boundary:
  - {name: top, displacement: [free, 0.4 mm], face: y+, depth: 1 mm, time: {ramp: {until: 1 ms}}}
  - {name: foot, fixed: [x, y], face: y-, depth: 1 mm}
output: {frames: 2, samples: 40}
END
costs "a grip tears off on trial" '^warning: boundary foot: bonds of the particles that it drives break' "$work/grip.yaml"
is "a grip tears off on trial: said once" "$(cat "$work/said" "$work/err" | grep -c 'bonds of the particles that it drives')" 1

# ---- shocks ----------------------------------------------------------------------------------------------------------

# Steel on alumina, whose bonds break at a stretch of 4.8e-4, in fronts of 5.12 m/s at c = sqrt(1.2 E/rho) (Poisson's ratio 1/4). Of the 10 m/s
# alumina takes the share Z_steel/(Z_steel + Z_alumina) = 0.5105, Z = rho c; of alumina on alumina a half, beside a rigid body all.
cat >"$work/strike.yaml" <<'END'
space: plane strain
thickness: 3 mm
duration: 1 us
method: pd
contact: {between: bodies}
materials:
  - {name: steel, young: 200 GPa, density: 7850, energy_release_rate: 20 kJ/m^2}
  - {name: alumina, young: 370 GPa, density: 3900, critical_stretch: 4.8e-4}
bodies:
  - {name: flyer, material: steel, velocity: [10 m/s, 0], shape: {box: {from: [-3 mm, 0], to: [0, 4 mm]}}}
  - {name: target, material: alumina, shape: {box: {from: [0, 0], to: [8 mm, 4 mm]}}}
particles: {spacing: 0.4 mm}
END
says "bodies that collide faster than their bonds bear" '^accuracy  *bodies collide at 10 m/s, 0.997 times the speed at which the stress of the wave front' "$work/strike.yaml"
says "alike bodies: a half" 'collide at 10 m/s, 0.976 times' "$work/strike.yaml" -s bodies.flyer.material=alumina
says "a rigid one: all" 'collide at 10 m/s, 1.95 times' "$work/strike.yaml" \
    -s "bodies.flyer={name: flyer, rigid: true, velocity: [10 m/s, 0], shape: {box: {from: [-3 mm, 0], to: [0, 4 mm]}}}"
says "a start faster than waves" '^warning: particles start with 3e+04 m/s, [0-9.]* times the wave speed' "$work/strike.yaml" -s "bodies.flyer.velocity=[30 km/s, 0]"
silent "a start slower than waves" '^warning: particles start' "$work/strike.yaml"
silent "slowly" '^accuracy  *bodies collide' "$work/strike.yaml" -s "bodies.flyer.velocity=[0.4 m/s, 0]"
silent "with viscosity" '^accuracy  *bodies collide' "$work/strike.yaml" -s "materials.alumina.viscosity={}" -s "materials.steel.viscosity={}"
"$cleave" run -q -o "$work/struck" "$work/strike.yaml" -s "bodies.flyer.velocity=[100 m/s, 0]" 2>"$work/err"
holds "bonds that break in it: the run says so" grep -q '^warning: the first bond broke at .* in a collision at 100 m/s, 9.97 times' "$work/err"
"$cleave" run -q -o "$work/spread" "$work/strike.yaml" -s "bodies.flyer.velocity=[100 m/s, 0]" -s "materials.alumina.viscosity={}" \
    -s "materials.steel.viscosity={}" -s accept=[rayleigh] 2>"$work/err"
is "with viscosity: bonds that break" "$(cat "$work/err")" ""
says "with viscosity of one of them" '^accuracy  *bodies collide' "$work/strike.yaml" -s "materials.alumina.viscosity={}"
silent "apart" '^accuracy  *bodies collide' "$work/strike.yaml" -s "bodies.flyer.velocity=[-10 m/s, 0]"
silent "along each other" '^accuracy  *bodies collide' "$work/strike.yaml" -s "bodies.flyer.velocity=[0, 10 m/s]"
says "where there is none" '^accuracy  *bodies collide at .*: compare with a run that has space: plane strain' "$work/strike.yaml" -s "space=plane stress"

# ---- loads of a free body, bonds that yield --------------------------------------------------------------------------

# 4 Pa above, where 4 MPa were meant, and 4 MPa below: -4 MPa 80 mm 3 mm = -960 N on 1190 kg/m^3 80 mm 40 mm 3 mm = 11.424 g, thus 84,000 m/s^2; in
# 120 us 10.1 m/s and 0.605 mm. Balanced loads, one that is held, and weight are silent.
cat >"$work/pulled.yaml" <<'END'
space: plane stress
thickness: 3 mm
duration: 120 us
method: pd
material: {young: 3.24 GPa, density: 1190, energy_release_rate: 300 J/m^2, yield_stress: 60 MPa}
body: {box: {from: [0, -20 mm], to: [80 mm, 20 mm]}}
particles: {spacing: 2 mm}
boundary:
  - {name: up, traction: [0, 4], face: y+}
  - {name: down, traction: [0, -4 MPa], face: y-}
END
unbalanced='the loads do not balance, and nothing holds the body along'
says "loads that do not balance" \
    "^accuracy  *$unbalanced y: net force up to (0, -960) N, .* 8.4e+04 m/s^2; .* by 10.1 m/s and it has drifted 0.000605 m: hold a face along y" "$work/pulled.yaml"
says "a pulse on a free body" "^balance  *$unbalanced y: net force" "$work/pulled.yaml" -s 'boundary.down.time={pulse: {until: 20 us}}'
says "loads on a body that is held across them" "^accuracy  *$unbalanced y: net" "$work/pulled.yaml" -s 'boundary.2={name: left, fixed: [x], face: x-}'
silent "loads that balance" "$unbalanced" "$work/pulled.yaml" -s 'boundary.up.traction=[0, 4 MPa]'
silent "a third load that holds, appended to the list" "$unbalanced" "$work/pulled.yaml" -s 'boundary.2={name: left, fixed: all, face: x-}'
holds "a third load, appended" grep -q '^support  *left: x, y held' "$work/said"
silent "weight" "$unbalanced" "$work/pulled.yaml" -s 'boundary=' -s 'gravity=[0, -9.81 m/s^2]'

# Bonds whose yield strain of 60 MPa/3.24 GPa = 0.0185 is above the critical stretch do not yield before they break; material points have no bonds.
slow() { test=$1 what=$2; shift 2; "$test" "$what" 'yield before they break' "$work/pulled.yaml" -s solver=static -s 'steps={number: 5}' -s 'duration=1 s' \
    -s 'boundary.0={name: foot, fixed: all, face: y-}' -s 'boundary.1={traction: [0, 4 MPa], face: y+}' "$@"; }
slow says "bonds that yield before they break" -s material.yield_stress=5MPa
slow silent "bonds that break before they yield"
slow silent "no bonds" -s material.yield_stress=5MPa -s method=mpm
# A rigid body that moves loads a body in load steps, where no boundary does.
silent "a roller that moves" 'nothing loads the body' "$work/pulled.yaml" -s solver=static -s 'steps={number: 5}' -s 'duration=1 s' -s body= \
    -s 'boundary=[{name: foot, fixed: all, face: y-}]' -s "bodies=[{name: plate, shape: {box: {from: [0, -20 mm], to: [80 mm, 20 mm]}}},
    {name: roller, rigid: true, velocity: [0, -1 mm/s], shape: {disc: {centre: [40 mm, 25 mm], radius: 5 mm}}}]"

finish
