#!/bin/sh
# Refusals: exit status 2, one line on standard error with position and reason, and no files left.
# Takes 20 s: a start of the program for each scene that is refused.
test_name=test_refusals
. tests/support/summary.sh
cd "$work" || exit 1

cat >good.yaml <<'END'
name: plate
space: plane stress
thickness: 10 mm
duration: 1 us
method: adaptive
material: {young: 190 GPa, density: 7800 kg/m^3, energy_release_rate: 69 kJ/m^2}
body:
  - box: {from: [0, 0], to: [20 mm, 10 mm]}
  - subtract: {disc: {centre: [5 mm, 5 mm], radius: 2 mm}}
particles: {spacing: 1 mm, horizon: 3.015}
mpm: {shape: gimp, transfer: flip}
cracks:
  - {from: [10 mm, 5 mm], to: [20 mm, 5 mm]}
boundary:
  - name: pull
    velocity: [free, 1 m/s]
    region: {box: {from: [0, 9 mm], to: [20 mm, 10 mm]}}
    time: {step: {until: 5 us}}
output: {frames: 2, samples: 2}
probes: [tip, {point: {at: [1 mm, 1 mm]}}, {reaction: {boundary: pull}}]
END

# Hundreds of cases: what follows starts no programs but Cleave.

# nothing_left WHAT: checks that a refused command has left no files in the working folder.
nothing_left()
{
    left=
    for name in * .[!.]*; do
        case $name in cleave | good.yaml | bad.yaml | out | err | kept* | '.[!.]*') ;; *) left="$left $name" ;; esac
    done
    is "$1: left behind" "$left" ""
}

# replace LINE TEXT: writes bad.yaml, the valid scene good.yaml with line number LINE replaced by TEXT, in which ^ is a line break.
replace()
{
    at=0
    while IFS= read -r old; do
        at=$((at + 1)) rest=$2
        [ $at -eq "$1" ] || rest=$old
        while [ $at -eq "$1" ] && [ "$rest" != "${rest#*^}" ]; do
            printf '%s\n' "${rest%%^*}"
            rest=${rest#*^}
        done
        printf '%s\n' "$rest"
    done <good.yaml >bad.yaml
}

# ended WHAT STATUS START WORDS: checks that the last command ended with STATUS = 2, printed nothing but one line on standard error, which
# begins with START and contains WORDS, and left no files.
ended()
{
    is "$1: exit status" "$2" 2
    said= more=
    if IFS= read -r said && ! IFS= read -r more && [ -z "$more" ]; then pass; else fail "$1: not one line on standard error: $(cat err)"; fi <err
    if [ -s out ]; then fail "$1: standard output: $(cat out)"; else pass; fi
    case $said in
        "$3"*"$4"*) pass ;;
        *) fail "$1: says '$said', not '$3 .. $4'" ;;
    esac
    nothing_left "$1"
}

# The valid scene runs: refusals below are caused by their one change.
"$cleave" check good.yaml >out 2>err || fail "the good scene: $(cat err)"
"$cleave" run good.yaml -q -o kept >out 2>err || fail "the good scene: $(cat err)"
nothing_left "the good scene"

# ---- scenes ----------------------------------------------------------------------------------------------------------

# Line of the valid scene | its replacement, ^ for a line break | line:column of the message | words in it. `run` must refuse it, and
# `check` with the same message.
while IFS='|' read -r line text place words; do
    replace "$line" "$text"
    "$cleave" run bad.yaml >out 2>err
    ended "$text" $? "bad.yaml:$place: " "$words"
    refused=$said
    "$cleave" check bad.yaml >out 2>err
    ended "check: $text" $? "$refused" ""
done <<'END'
1|nme: plate|1:1|nme: unknown key; did you mean name?
1|name: ../plate|1:1|is not a name
1|name: plate^name: plate|2:1|given twice
1|name: &anchor plate|1:7|anchor
1|name: *anchor|1:7|alias
1|name: !!python/object plate|1:7|tag
1|name: plate^<<: {a: 1}|2:1|merge
1|name: [[[[[[[[[[[[[[[[[[[[[[[[]]]]]]]]]]]]]]]]]]]]]]]]|1:22|deeper than 16
1|{|3:10|not YAML
1|"name|21:1|unexpected end of stream
2|spaces: plane|2:1|did you mean space?
2|space: plane stress^temperature: 300|3:1|heat does not flow and does not expand a body; plastic work heats metals with
2|space: plane stress^dt: 1 us|3:1|here it is `time.step`
2|space: plane stress^periodic: x|3:1|has no periodic boundaries; nearest: planes of symmetry, boundary: {mirror
6|material: {E: 190 GPa, density: 7800}|6:12|E: unknown key; here it is `young`
6|material: {young: 190 GPa, nu: 0.3, density: 7800}|6:28|here it is `poisson`
6|material: {young: 190 GPa, rho: 7800}|6:28|here it is `density`
6|material: {young: 190 GPa, density: 7800, G_c: 100}|6:43|here it is `energy_release_rate`
6|material: {young: 190 GPa, density: 7800, strength: 100 MPa}|6:43|with `tensile_strength` bonds soften
6|material: {young: 190 GPa, density: 7800, f_c: 100 MPa}|6:43|has no crushing
6|material: {young: 190 GPa, density: 7800, friction_angle: 30}|6:43|has no yielding that depends on pressure
6|material: {young: 190 GPa, density: 7800, thermal-expansion: 1}|6:43|has no thermal expansion
6|material: {young: 190 GPa, density: 7800, conductivity: 1}|6:43|has no thermal expansion or flow of heat
6|material: {young: 190 GPa, density: 7800, strain_rate: 1}|6:43|by `johnson_cook`
6|material: {young: 190 GPa, density: 7800, orthotropic: {}}|6:43|has no anisotropic materials
6|material: {young: 190 GPa, density: 7800, fatigue: {}}|6:43|has no fatigue
6|material: {young: 190 GPa, density: 7800, yield: 1 GPa}|6:43|here it is `yield_stress`
8|  - sphere: {radius: 1}|8:5|here it is `ball`
4|duration: 1 usec|4:1|has an unknown unit (us?)
6|material: {young: 190 psi, density: 7800}|6:12|(1 psi is 6.895e3 Pa)
10|particles: {spacing: 1,5 mm}|10:24|the decimal sign is a point
3|thickness: 0,25 mm|3:1|the decimal sign is a point; write 0.25 mm
6|material: {young: 190 GPa, density: 7800, hardness: 1 GPa}|6:43|has no hardness; nearest: `yield_stress`
6|material: {young: 190 GPa, density: 7800, jh2: {}}|6:43|nearest: bonds that begin to soften at a strength surface
6|material: {young: 190 GPa, density: 7800, Johnson-Holmquist: {}}|6:43|has no Johnson-Holmquist
6|material: {young: 190 GPa, density: 7800, melting_temperature: 1356}|6:43|temperatures are keys of `johnson_cook`
6|material: {young: 190 GPa, density: 7800, KI: 30}|6:43|here it is `toughness`
6|material: {young: 190 GPa, density: 7800, tensile_strength: inf}|6:43|leave the key out for bonds that break without softening
8|  - box: {min: [0, 0]}|8:11|min: unknown key; a box is given by its lower and its upper corner, as {from: [0, 0], to: [20 mm, 10 mm]}
2|space: 2D|2:1|give line, plane stress, plane strain or solid; a thin plate is plane stress, a cross-section of a thick body plane
2|space: 3D|2:1|three dimensions are solid
2|space: axisymmetric|2:1|has no axial symmetry; nearest: solid
5|method: adaptive^model: pmb|6:1|give bond, ospd or mospd; the bond-based model (peri/pmb of LAMMPS) is bond
5|method: adaptive^model: lps|6:1|the ordinary state-based model (peri/lps of LAMMPS) is ospd
5|method: adaptive^steps: 100|6:1|is not allowed here; give a mapping such as {number: 100}; 100 load steps are steps: {number: 100}; the number of time steps follows
16|    traction: -12 MPa|16:5|give 2 components in space plane stress, such as [-12 MPa, 0]; a load along the normal is `pressure`
1|*HEADING|1:1|this is an input file of Abaqus or LS-DYNA, not a scene
1|# peri^^units si^atom_style peri|3:1|this is an input script of LAMMPS, not a scene
1|$MeshFormat|1:1|this is a mesh of Gmsh, not a scene
1|solid part|1:1|this is an STL file, not a scene
8|  - circle: {radius: 1}|8:5|here it is `disc`
5|method: adaptive^contact: {mu: 0.3}|6:11|here it is `friction`
11|mpm: {kernel: gimp}|11:7|here it is `shape`
5|method: adaptive^model: correspondence|6:1|has no correspondence or other laws
5|method: adaptive^contact: {stiffness: 1e9}|6:11|it is a factor of the stiffness of the bonds
5|method: adaptive^time: 10 us|6:1|the simulated time is the key `duration`
5|method: adaptive^crack: [{at: 1}]|6:1|pre-cracks are the key `cracks`
10|particles: {spacing: 1 mm, horizon: 3 mm}|10:28|give it in spacings, here horizon: 3
2|space: plane stress^crack: {from: [0, 0]}|3:9|from: unknown key; pre-cracks are a list of their own: cracks: [{from:
13|  - {from: [10 mm, 5 mm], length: 5 mm}|13:27|length: unknown key; a crack is given by its ends
16|    pressure: 1 MPa^    face: y+|17:5|pressure acts on every free face of the particles in `region`
16|    force: [0, 1 N]|16:5|a force on a face is a traction [Pa]
16|    encastre: true|16:5|encastre: unknown key; a support is {fixed: all, face: x-}
8|  - mesh: {file: a.inp, size: 1 mm}|8:25|particles.spacing sets the distance of particles
2|space: plane stress^mesh: {size: 1 mm}|3:1|a file is a shape, as body: {mesh: {file: part.inp, unit: mm}}
2|space: plane stress^run: 1000|3:1|here it is `duration`
2|space: plane stress^time: {end: 1 us}|3:8|the simulated time is the key `duration`
6|material: {young: 190 Gpa, density: 7800}|6:12|190 Gpa has an unknown unit (GPa?)
6|material: {young: 190 GPa, density: 7800, gc: 100}|6:43|here it is `energy_release_rate`
6|material: {bulk: 190 GPa, density: 7800}|6:12|here it is `young`
19|output: {length: 2}|19:10|`cleave help length` lists the 2 keys of that name
20|probes: [{reaction: {boundary: bottom}}]|20:22|there is no boundary named bottom; give the name of one of the 1 in the scene (most similar: pull)
2|space: plane|2:1|plane stress
2|space: solid|3:1|thickness
2||1:1|space: missing
3||1:1|thickness: missing
3|thickness: 10 kg|3:1|give a length
4|duration: 1e10 s|4:1|duration: 1e+10 s needs
11|mpm: {frame: reference, cell: 1}|11:7|mpm.frame: body body cannot be in the reference frame: the reference frame needs mpm.cell: 2
3|thickness: 0|3:1|out of range
3|thickness: -1e-3|3:1|out of range
3|thickness: 1e-400|3:1|out of range
4|duration: .inf|4:1|not a number
4|duration: nan|4:1|not a number
4|duration: 1e999 s|4:1|not finite
4|duration: 1 us us|4:1|is not a time
4|duration: 1:30|4:1|base 60
4|duration: yes|4:1|not a number
4|duration: 0x10 us|4:1|hexadecimal
4|duration: 1/0 us|4:1|divides by 0
4|duration: [1 us]|4:1|a list is not a number
5|method: magic|5:1|pd, mpm, adaptive or auto
5|method: auto^accuracy: 0.7|6:1|out of range
5|method: auto^accuracy: {of: tip, withn: 2 %}|6:21|did you mean within?
5|method: auto^solver: static^steps: {number: 3}|5:1|set method: pd or adaptive
5|method: adaptive^accuracy: 1 %|6:1|no effect without method: auto
5|model: lps|5:1|bond, ospd or mospd
5|solver: cg|5:1|cg works with method: pd only
5|coupling: glue|5:1|partial stress, handshake, pm, pg, pmg or pgg
6|material: {young: -1, density: 7800}|6:12|out of range
6|material: {density: 7800}|6:1|young: missing
6|material: {young: 190 GPa, density: 7800, poisson: 0.3}|6:43|which have 1/3 in space plane stress; use `model: ospd` for any ratio
6|material: {young: 190 GPa, density: 7800, critical_stretch: 0.01, toughness: 1e6}|6:67|given together with critical_stretch
6|material: {young: 190 GPa, density: 7800, yield_stress: 1 GPa, yield_tangent: 200 GPa}|6:64|not below Young's modulus
6|material: {young: 190 GPa, density: 7800, yield_stress: 1 GPa, hardening: {}}|6:64|has no law; give linear, voce
6|material: {young: 190 GPa, density: 7800, yield_stress: 1 GPa, hardening: {voce: {saturation: 1 GPa}}}|6:76|rate: missing
6|material: {young: 190 GPa, density: 7800, yield_stress: 1 GPa, hardening: {voce: {saturation: 1 GPa, rate: 9}, power: {coefficient: 1 GPa, exponent: 1}}}|6:112|remove one of the two
6|material: {young: 190 GPa, density: 7800, yield_stress: 1 GPa, yield_hardening: 1 GPa, hardening: {linear: {modulus: 1 GPa}}}|6:88|remove one of the two
6|material: {young: 190 GPa, density: 7800, yield_hardening: 1 GPa}|6:43|yield_hardening: has no effect without yield_stress
6|material: {young: 190 GPa, density: 7800, yield_stress: 1 GPa, hardening: {swift: {a: 1}}}|6:76|linear
6|material: {young: 190 GPa, density: 7800, hardening: {linear: {modulus: 1 GPa}}}|6:43|add yield_stress
6|material: {young: 190 GPa, density: 7800, yield_stress: 1 GPa, hardening: {power: {coefficient: 1 GPa, exponent: 1.2}}}|6:104|out of range
6|material: {young: 190 GPa, density: 7800, hardening: {table: [[0, 1 GPa]]}}|6:55|give 2 to 16
6|material: {young: 190 GPa, density: 7800, hardening: {table: [[0, 1 GPa], [0.1]]}}|6:75|is not a point of a curve
6|material: {young: 190 GPa, density: 7800, hardening: {table: [[0.1, 1 GPa], [0.2, 2 GPa]]}}|6:63|give the yield stress at strain 0 as the first point
6|material: {young: 190 GPa, density: 7800, hardening: {table: [[0, 1 GPa], [0, 2 GPa]]}}|6:75|strains in ascending order
6|material: {young: 190 GPa, density: 7800, hardening: {table: [[0, 1 GPa], [1 mm, 2 GPa]]}}|6:76|give a plain number
6|material: {young: 190 GPa, density: 7800, hardening: {table: [[1 GPa, 0], [2 GPa, 0.1]]}}|6:64|give a plain number
6|material: {young: 190 GPa, density: 7800, hardening: {table: [[0, 1 GPa], [0.1, 0.9 GPa]]}}|6:75|the yield stress falls
6|material: {young: 190 GPa, density: 7800, hardening: {table: [[0, 1 GPa], [0.1, 1.1 GPa], [0.2, 1.3 GPa]]}}|6:91|the slope of the curve increases
6|material: {young: 190 GPa, density: 7800, yield_stress: 1 GPa, hardening: {table: [[0, 1 GPa], [0.1, 2 GPa]]}}|6:64|remove one of the two
6|material: {young: 190 GPa, density: 7800, yield_stress: 1 GPa, hardening: {linear: {modulus: 1 GPa}}}|6:64|works for material points only; use `method: mpm`
6|material: {young: 190 GPa, density: 7800, kinematic: {modulus: 1 GPa}}|6:43|add yield_stress
6|material: {young: 190 GPa, density: 7800, yield_stress: 1 GPa, kinematic: {recall: 3}}|6:64|modulus: missing
6|material: {young: 190 GPa, density: 7800, yield_stress: 1 GPa, johnson_cook: {A: 90 MPa, B: 292 MPa, n: 0.3, C: 0.025, T_melt: 1356}}|6:64|remove one of the two
6|material: {young: 190 GPa, density: 7800, johnson_cook: {A: 90 MPa, B: 292 MPa, n: 1.3, C: 0.025, T_melt: 1356}}|6:81|out of range
6|material: {young: 190 GPa, density: 7800, johnson_cook: {A: 90 MPa, B: 292 MPa, n: 0.3, C: 0.025, T_melt: 200 K}}|6:99|is not above T_room
6|material: {young: 190 GPa, density: 7800, johnson_cook: {A: 90 MPa, B: 292 MPa, n: 0.3, C: 0.025, T_melt: 1356 m}}|6:99|give a temperature in kelvin
6|material: {young: 190 GPa, density: 7800, specific_heat: 383}|6:43|no effect without johnson_cook
6|material: {young: 190 GPa, density: 7800, johnson_cook: {A: 90 MPa, B: 292 MPa, n: 0.3, C: 0.025, Tm: 1356}}|6:99|Tm: unknown key; here it is `T_melt`
6|material: {young: 190 GPa, density: 7800, johnson_cook: {A: 90 MPa, B: 292 MPa, N: 0.3, C: 0.025, T_melt: 1356}}|6:81|N: unknown key; here it is `n`
6|material: {young: 190 GPa, density: 7800, johnson_cook: {A: 90 MPa, B: 292 MPa, n: 0.3, C: 0.025, D1: 0.1}}|6:99|does not have Johnson and Cook's failure law
6|material: {young: 190 GPa, density: 7800, johnson_cook: {A: 90 MPa, B: 292 MPa, n: 0.3, C: 0.025, T_melt: 1356}, specific_heat: 0.4 kJ/m}|6:114|give a specific heat
6|material: {young: 190 GPa, density: 7800, specific_heat: 383 J}|6:43|give a specific heat
6|material: {young: 190 GPa, density: 7800, taylor_quinney: 0.9}|6:43|no effect without specific_heat
6|material: steel|6:1|not allowed here; give a mapping
8|  - box: {from: [0, 0], to: [20 mm, 10 mm, 1]}|8:25|3 components
8|  - box: {from: [0, 0], to: [-20 mm, 10 mm]}|8:5|from is not below to
8|  - box: {from: [0, 0], to: [inf, 10 mm]}|8:30|not finite
8|  - ball: {centre: [0, 0], radius: 1e30}|10:13|m long, more than the limit of 2e9
8|  - cylinder: {radius: 1}|8:5|cannot be used in space plane stress
8|  - half-space: {point: [0, 0], normal: [1, 0]}|8:5|infinite
8|  - pyramid: {radius: 1}|8:5|unknown key
10|particles: {spacing: 1 mm, horizon: 0.8}|10:28|smaller than one spacing; 3.015 is usual
10|particles: {spacing: 1 mm, horizon: 100}|10:28|out of range
10|particles: {spacing: 1 nm}|10:13|more than the limit of 2e9
10|particles: {spacing: 1 mm, irregularity: 2}|10:28|out of range
10|particles: {spacing: 1 mm, seed: 1.5}|10:28|whole number
10|particles: {}|10:1|spacing: missing
11|mpm: {shape: linear, transfer: apic}|11:22|unstable
11|mpm: {shape: septic}|11:7|shape
11|mpm: {cell: 0}|11:7|out of range
11|conversion: {alpha: 2}|11:14|out of range
11|conversion: {criteria: [bond, luck]}|11:31|bond or stress
13|  - {from: [10 mm, 5 mm], to: [10 mm, 5 mm]}|13:5|the length 0
13|  - {from: [10 mm, 5 mm]}|13:5|to
13|  - {polygon: [[0, 0, 0]]}|13:6|cannot be used in space plane stress
16|    velocity: [free, free]|16:5|every component is free
16|    velocity: [free, 1 m]|16:22|give a velocity
16|    fixed: [z]|16:13|not an axis
16|    traction: [1 MPa, 0]|15:5|face
16||15:5|has no load or support
16|    absorbing: true^    face: x-|19:5|cannot be given with absorbing
16|    absorbing: true^    velocity: [free, 1 m/s]|17:5|given together with absorbing
14|boundary:^  - {absorbing: false, face: x+}|15:6|can only be true
14|boundary:^  - {absorbing: true}|15:5|face
14|boundary:^  - {absorbing: true, face: z+}|15:23|is not the name of a face in space
14|solver: relaxation^initial: [{displacement_gradient: [1e-3, 0, 0, 0]}]^boundary:|15:12|depends on their initial strain
14|solver: relaxation^boundary:^  - {absorbing: true, face: x+}|16:6|has no waves
17|    body: disk|17:5|there is no body
18|    time: {step: {from: 6 us, until: 5 us}}|18:12|from is not earlier than until
18|    time: {table: [[1 us, 0], [0, 1]]}|18:32|times in ascending order
18|    time: whenever|18:5|not a function of time
19|time: {step: 0}|19:8|out of range
19|time: {step: 1e-30}|19:8|more than the limit of 1e12
19|time: {safety: 3}|19:8|out of range
19|output: {frames: -1}|19:10|frames
19|output: {frames: 1e9}|19:10|frames
19|output: {samples: 0}|19:10|out of range
19|output: {compress: maybe}|19:10|true or false
20|probes: [crack]|20:10|does not belong here
20|probes: [sif: {inner: 21 mm}]|20:16|is not smaller than the outer radius
20|probes: [growth]|20:10|add the key growth
20|probes: [growth: {of: a}]^growth: [{name: b, at: [10 mm, 5 mm], direction: [-1, 0], speed: 1 m/s}]|20:19|no growth named a
20|growth: [{at: [0, 0], direction: [1, 0], speed: 1 m/s, smoothing: 1 mm}]|20:56|without the key probe
20|probes: [growth: {experiment: 200}]|20:19|out of range
20|probes: [rigid: {region: here}]|20:18|region
20|probes: [tip, tip]|20:15|name of another probe
20|probes: [exact: step bar]|20:10|set space: line
19|output: {frames: 2, times: [1 us]}|19:21|remove one of the two
19|output: {times: [2 us, 1 us]}|19:24|values in ascending order
19|output: {frames: 2, every: 1 us}|19:21|remove one of the two
19|output: {regions: [{name: a, every: 1 us}]}|19:20|region: missing
19|output: {regions: [{name: frames, region: {all: true}, every: 1 us}]}|19:21|the name of the frames of all bodies
19|output: {regions: []}|19:10|regions
19|output: {every: 1e-13}|19:10|at least
19|output: {every: 0}|19:10|every
19|output: {fields: [von_mise]}|19:19|the most similar is von_mises
19|output: {fields: heat}|19:10|none, all or a list
20|probes: [{reaction: {boundary: push}}]|20:22|no boundary named push
20|probes: [{line: {from: [0, 0], to: [1, 1], points: 1}}]|20:44|out of range
20|probes: {tip}|20:1|list
20|probes: tip|20:1|tip is not allowed here; give a list such as [{tip: {at: [0.5 mm, 0]}}]
20|initial: {velocity: [1, 0]}|20:1|a mapping is not allowed here; give a list such as [{velocity: [22 m/s, 0]}]
20|growth: {at: [1 mm, 0]}|20:1|a mapping is not allowed here; give a list such as [{at: [0.5 mm, 0]}]
10|particles: 1 mm|10:1|1 mm is not allowed here; give a mapping such as {spacing: 0.5 mm}
20|gravity: 9.81|20:1|is not a list; give 2 components in space plane stress, such as [-9.81 m/s^2, 0]
20|---^name: second|20:1|second document
END

# Unknown keys are reported together, each in one line, at most ten.
sed -e 's/young/yuong/; s/radius/raduis/; s/samples/smaples/' good.yaml >bad.yaml
"$cleave" run bad.yaml >out 2>err
is "three unknown keys: exit status" $? 2
is "three unknown keys" "$(cat err)" "bad.yaml:6:12: yuong: unknown key; did you mean young?
bad.yaml:9:45: raduis: unknown key; did you mean radius?
bad.yaml:19:21: smaples: unknown key; did you mean samples?"
for k in a b c d e f g h i j k l; do echo "q$k: 1"; done | cat good.yaml - >bad.yaml
"$cleave" run bad.yaml >out 2>err
is "twelve unknown keys: lines" "$(wc -l <err | tr -d ' ')" 11
is "twelve unknown keys: the last line" "$(tail -n 1 err)" "bad.yaml: and 2 more unknown keys"
nothing_left "unknown keys"

# Errors found only with the particles: position of the cause, one sentence, and no folder created.
while IFS='|' read -r line text start words; do
    replace "$line" "$text"
    "$cleave" run bad.yaml >out 2>err
    ended "$text" $? "$start" "$words"
done <<'END'
16|    traction: [1, 0]^    face: x-|bad.yaml:21:44: probes[2]: probe|has no reaction
20|probes: [{point: {at: [1, 1]}}]|bad.yaml:20:10: probes[0]: probe|outside the bodies
20|probes: [{energy: {region: {box: {from: [1, 1], to: [2, 2]}}}}]|bad.yaml:20:10: probes[0]: probe|no particle
20|probes: [sif]|bad.yaml:20:10: probes[0]: probe|leaves the body
14|boundary:^  - {name: push, body_force: [0, 1], region: {box: {from: [1, 1], to: [2, 2]}}}|bad.yaml:15:5: boundary[0]: boundary push|no particle
14|boundary:^  - {mirror: {axis: x, at: 5 mm}}|bad.yaml:15:5: boundary[0]: boundary boundary0|cuts the body
14|boundary:^  - {mirror: {axis: x, at: 0}}^  - {mirror: {axis: x, at: 0}}|bad.yaml:16:5: boundary[1]: boundary boundary1|remove one of the two
14|boundary:^  - {absorbing: true, face: x+, region: {box: {from: [1, 1], to: [2, 2]}}}|bad.yaml:15:5: boundary[0]: boundary boundary0|no particle
14|boundary:^  - {absorbing: true, face: x+, region: {box: {from: [10 mm, 0], to: [12 mm, 10 mm]}}}|bad.yaml:15:5: boundary[0]: boundary boundary0|are in front of every particle
14|boundary:^  - {absorbing: true, face: x+}^  - {absorbing: true, face: y+}^  - {absorbing: true, face: x+, region: {box: {from: [15 mm, 4 mm], to: [20 mm, 6 mm]}}}|bad.yaml:17:5: boundary[2]: boundary boundary2|boundary0 already absorbs at this face
14|initial: [{displacement_gradient: [-2, 0, 0, 0]}]^boundary:|bad.yaml:14:11: initial[0]: |inside out
8|  - box: {from: [0, 0], to: [1e-9, 1e-9]}|bad.yaml:7:1: body: body body|contains no particle
END

# ---- files that are not scenes ---------------------------------------------------------------------------------------

mkdir kept/folder
: >kept/empty.yaml
printf 'name: plate\nspace: plane\0stress\n' >kept/nul.yaml
printf 'name: pl\377te\n' >kept/utf8.yaml
head -c 100000 "$cleave" >kept/binary.yaml
awk 'BEGIN { for (k = 0; k < 1700000; k++) print "# a comment" }' >kept/long.yaml
awk 'BEGIN { printf "name: "; for (k = 0; k < 100000; k++) printf "["; print "" }' >kept/deep.yaml
cut -c 1-20 good.yaml >kept/cut.yaml
for file in missing.yaml folder empty.yaml nul.yaml utf8.yaml binary.yaml long.yaml deep.yaml cut.yaml good.yaml/below; do
    "$cleave" run kept/$file >out 2>err
    ended "$file" $? "kept/$file:" ""
done
rm kept/long.yaml
if [ "$(id -u)" -ne 0 ]; then
    cp good.yaml kept/secret.yaml
    chmod 000 kept/secret.yaml
    "$cleave" run kept/secret.yaml >out 2>err
    ended "an unreadable scene" $? "kept/secret.yaml:" "Permission denied"
fi
"$cleave" run '' >out 2>err
ended "a scene without a name" $? "" ""

# ---- particle lists ----------------------------------------------------------------------------------------------------

# list WHAT PLACE WORDS: checks that the particle list on standard input is refused as a body, with a line that begins with PLACE and
# contains WORDS.
list()
{
    cat >kept/grains.csv
    sed -e '7,9d' -e '6a\
bodies: [{name: grains, particles: kept/grains.csv}]' good.yaml >bad.yaml
    "$cleave" run bad.yaml >out 2>err
    ended "list: $1" $? "$2" "$3"
}
list "no header" "kept/grains.csv:1:" "" <<'END'
1,2,3
END
list "a column too few" "kept/grains.csv:2:" "" <<'END'
x,y,volume
0.5e-3,0.5e-3
END
list "a word" "kept/grains.csv:3:" "not a number" <<'END'
x,y,volume
0.5e-3,0.5e-3,1e-8
0.5e-3,many,1e-8
END
list "a volume below 0" "kept/grains.csv:2:" "volume" <<'END'
x,y,volume
0.5e-3,0.5e-3,-1e-8
END
# Millimetres written as metres, and the other way round with a spacing without unit: `check` refuses it as well.
grid() { awk -v apart="$1" 'BEGIN { print "x,y,volume"; for (k = 0; k < 200; k++) print k % 20 * apart "," int(k / 20) * apart ",1e-8" }'; }
grid 1 >kept/millimetres.csv
grid 1e-3 >kept/metres.csv
for method in pd mpm adaptive; do
    sed -e "s/^method: .*/method: $method/" -e '7,9d' -e '6a\
bodies: [{name: grains, particles: kept/millimetres.csv}]' good.yaml >bad.yaml
    sed -e 's/millimetres/metres/' -e 's/spacing: 1 mm/spacing: 1/' bad.yaml >kept/other.yaml
    for command in check run; do
        "$cleave" $command bad.yaml >out 2>err
        ended "$command, $method: a list in mm" $? "bad.yaml:7:25: particles: " "(is it in mm?)"
    done
    mv kept/other.yaml bad.yaml
    for command in check run; do
        "$cleave" $command bad.yaml >out 2>err
        ended "$command, $method: a spacing in mm" $? "bad.yaml:7:25: particles: " "set particles.spacing to about 0.001 m"
    done
    sed -e 's/spacing: 1,/spacing: 1 mm,/' -e '/^cracks/,/^  - /d' bad.yaml >kept/list.yaml
    holds "$method: a list in metres" "$cleave" run kept/list.yaml -q -o kept/list_$method -s duration=0.1us -s probes=[]
done
list "nan" "kept/grains.csv:2:" "" <<'END'
x,y,volume
nan,0.5e-3,1e-8
END
list "two in one place" "bad.yaml:7:25: particles: " "has two particles at (" <<'END'
x,y,volume
0.5e-3,0.5e-3,1e-8
0.5e-3,0.5e-3,1e-8
END
list "no particle" "bad.yaml:7:25: particles: " "has no particle in its list" <<'END'
x,y,volume
END
list "a pipe" "kept/grains.csv:1:1: " "column x is missing" <<'END'
x|y|volume
END
list "decimal commas" "kept/grains.csv:2:7: " "a decimal point, not a comma" <<'END'
x,y,volume
0,5,1,5,1
END

# ---- the command line ----------------------------------------------------------------------------------------------------

# Words of the command line | beginning of the message | contents.
while IFS='|' read -r words start middle; do
    "$cleave" $words >out 2>err
    ended "$words" $? "$start" "$middle"
done <<'END'
frobnicate|unknown command frobnicate|
run|no scene is given|usage
run good.yaml --fast|unknown option --fast|usage
run good.yaml -x|unknown option -x|usage
run good.yaml good.yaml|two scenes are given|
run good.yaml method=pd|method=pd: |write the option -s before a key and its value: -s method=pd
run good.yaml -o|-o needs a value|
run good.yaml -s|-s needs a value|
run good.yaml -s duration|-s duration|particles.spacing=0.5mm
run good.yaml -s =3|-s =3|
run good.yaml -s duraton=1us|-s duraton=1us|did you mean duration?
run good.yaml -s duration=fast|-s duration=fast|give a time
run good.yaml -s duration=-1|-s duration=-1|out of range
run good.yaml -s material.E=1|-s material.E=1: E|here it is `young`
run good.yaml -s material.youn=1|-s material.youn=1|young
run good.yaml -s material.young=1mm|-s material.young=1mm|give a stress
run good.yaml -s particles.horizon=0.5|-s particles.horizon=0.5|smaller than one spacing
run good.yaml -s method=[pd]|-s method=[pd]|
run good.yaml -s space=line|good.yaml|
run good.yaml -t 0|-t 0|from 1 to 4096
run good.yaml -t two|-t two|from 1 to 4096
run good.yaml -t 1e3|-t 1e3|from 1 to 4096
run good.yaml -t 99999999999999999999|-t|from 1 to 4096
run good.yaml -t|-t needs a value|
check|no scene is given|usage
check missing.yaml|missing.yaml|
plot|plot:|usage
plot kept kept|plot:|
plot kept --loud|plot: unknown option|
compare|compare:|usage
compare kept|compare:|usage
compare kept kept kept|compare:|usage
help nonsense|nonsense|
help a b|a_b|
info now|info:|
bench nonsense|unknown bench|
END
"$cleave" check good.yaml -s method=mpm -s body= -s 'bodies=[{name: a, shape: {box: {from: [0, 0], to: [20 mm, 10 mm]}}}, {name: b, rigid: true,
    shape: {half-space: {point: [0, 0], normal: [0, 1]}}}]' >out 2>err
ended "material points and a rigid body" $? "-s bodies=" "a smooth wall at rest can be a boundary \`mirror\`"
"$cleave" run good.yaml -o '' >out 2>err
ended "-o ''" $? "-o" ""
"$cleave" run good.yaml -o "$(awk 'BEGIN { for (k = 0; k < 5000; k++) printf "x" }')" >out 2>err
ended "-o with a name of 5000 letters" $? "-o" "too long"
"$cleave" >out 2>err
is "no command: exit status" $? 2

# ---- words of other programs ---------------------------------------------------------------------------------------------

# `cleave help WORD` prints the page of the key that has the meaning here.
while IFS='|' read -r word page; do
    "$cleave" help $word >out 2>err || fail "help $word: $(cat err)"
    holds "help $word: $(head -n 4 out)" grep -q "^$page " out
done <<'END'
yield|material.yield_stress
plasticity|material.yield_hardening
G_c|material.energy_release_rate
strength|material.scatter.of
E|material.young
damage|output.fields
toughness|material.toughness
fracture energy|material.energy_release_rate
friction|contact.friction
gravity|gravity
velocity|initial.velocity
velocity|boundary.velocity
nu|material.poisson
Young-modulus|material.young
Johnson-Cook|material.johnson_cook
psi|psi: not a unit of scenes (1 psi is 6.895e3 Pa);
MPa|MPa: a unit, written behind a number;
gmsh|gmsh: inputs/files.md: meshes of Gmsh and Abaqus as shapes of bodies,
abaqus|abaqus: inputs/files.md: meshes of Gmsh and Abaqus as shapes of bodies,
END
"$cleave" run good.yaml -o kept --resume >out 2>err
is "--resume of a finished run" "$? $(grep -c '^the run in kept is finished: no step is left' err)" "0 1"

# The first word of each row of the table has a page whose keys there are.
sed -n 's/^    {"\([^|"]*\).*/\1/p' "$root/src/scene/scene_foreign.c" >kept/words
between "rows of the table" "$(wc -l <kept/words)" 50 200
while read -r word; do
    "$cleave" help "$word" >out 2>err || fail "help $word: $(cat err)"
    holds "help $word: $(cat out)" grep -q '[a-z]' out
done <kept/words

cd "$root" || exit 1
finish
