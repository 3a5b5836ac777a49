/* Tests invalid scenes. Each is the valid scene below with one piece replaced; the message must be exact, including
 * line and column. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <cmocka.h>

#include "scene/scene.h"
#include "scene/scene_read.h"

static const char good[] = "name: plate\n"
                           "space: plane stress\n"
                           "thickness: 10 mm\n"
                           "duration: 50 us\n"
                           "method: adaptive\n"
                           "material:\n"
                           "  young: 190 GPa\n"
                           "  poisson: 1/3\n"
                           "  density: 7800 kg/m^3\n"
                           "  energy_release_rate: 69 kJ/m^2\n"
                           "bodies:\n"
                           "  - name: plate\n"
                           "    shape: {box: {from: [0, -100 mm], to: [100 mm, 100 mm]}}\n"
                           "particles:\n"
                           "  spacing: 1 mm\n"
                           "  horizon: 3.015\n"
                           "  seed: 7\n"
                           "pd:\n"
                           "  surface: none\n"
                           "mpm: {transfer: flip, shape: gimp}\n"
                           "conversion:\n"
                           "  block: true\n"
                           "cracks:\n"
                           "  - {from: [0, 25 mm], to: [50 mm, 25 mm]}\n"
                           "boundary:\n"
                           "  - name: impact\n"
                           "    region: {box: {from: [-inf, -25 mm], to: [3 mm, 25 mm]}}\n"
                           "    velocity: [22 m/s, free]\n"
                           "    time: {step: {until: 5 us}}\n"
                           "  - {name: pull, traction: [1 MPa, 0], face: x+}\n"
                           "time: {step: auto}\n"
                           "output: {frames: 20}\n"
                           "probes:\n"
                           "  - tip\n"
                           "  - point: {name: a, at: [1 mm, 1 mm]}\n"
                           "  - reaction: {boundary: impact}\n";

/* A piece of the valid scene, its replacement, and the message after the name of the file. */
static const struct {
    const char *piece, *instead, *message;
} cases[] = {
    {"particles:\n", "parts: [{region: {all: true}, material: material}]\nparticles:\n",
     "14:1: parts: belongs to the key body; with the key bodies, give parts in each body"},
    {"  - name: plate\n", "  - name: plate\n    parts: [{region: {all: true}}]\n",
     "13:13: material: missing in bodies.parts; give the name of a material"},
    {"  - name: plate\n", "  - name: plate\n    parts: [{region: {all: true}, material: glass}]\n",
     "13:35: material: there is no material glass; did you mean material?"},
    {"  - name: plate\n", "  - name: plate\n    parts: {region: {all: true}}\n",
     "13:5: parts: a mapping is not allowed here; give a list such as [{region: {box: {from: [..], to: [..]}}}]"},
    {"  - name: plate\n",
     "  - {rigid: true, shape: {box: {from: [0, 0], to: [1, 1]}}, parts: [{region: {all: true}, "
     "material: material}]}\n  - name: plate\n",
     "12:61: parts: has no meaning for a rigid body; remove it, and give a shape, and a mass if the body moves freely"},
    {"duration: 50 us", "duraton: 50 us", "4:1: duraton: unknown key; did you mean duration?"},
    {"  young: 190 GPa\n", "", "6:1: young: missing in material; give a stress, such as 190 GPa"},
    {"duration: 50 us\n", "", "1:1: duration: missing; give a time, such as 20 us"},
    {"space: plane stress\n", "", "1:1: space: missing; give line, plane stress, plane strain or solid"},
    {"thickness: 10 mm\n", "", "1:1: thickness: missing; give a length, such as 0.5 mm"},
    {"  spacing: 1 mm\n", "", "14:1: spacing: missing in particles; give a length, such as 0.5 mm"},
    {"190 GPa", "190 mm", "7:3: young: 190 mm is a length; give a stress, such as 190 GPa"},
    {"190 GPa", "190 gpa", "7:3: young: 190 gpa has an unknown unit (GPa?); give a stress, such as 190 GPa"},
    {"190 GPa", "190_000",
     "7:3: young: 190_000 is not a number here: digits cannot be grouped by _; write 1000 or 1e3"},
    {"190 GPa", "1,9", "7:3: young: 1,9 is not a number here: the decimal sign is a point; write 1.9"},
    {"190 GPa", "0x1F",
     "7:3: young: 0x1F is not a number here: hexadecimal, octal and binary numbers are not read; "
     "write a decimal number"},
    {"190 GPa", "1:30",
     "7:3: young: 1:30 is not a number here: numbers with colons (base 60) are not read; write a decimal number"},
    {"190 GPa", "0777",
     "7:3: young: 0777 is not a number here: a leading 0 means octal elsewhere; write the decimal "
     "number without it"},
    {"190 GPa", "inf", "7:3: young: inf is not finite; give a stress, such as 190 GPa"},
    {"190 GPa", ".nan", "7:3: young: .nan is not a number; give a stress, such as 190 GPa"},
    {"190 GPa", "1e999", "7:3: young: 1e999 is not finite; give a stress, such as 190 GPa"},
    {"190 GPa", "1/0", "7:3: young: 1/0 divides by 0; give a stress, such as 190 GPa"},
    {"190 GPa", "-190 GPa", "7:3: young: -190 GPa is out of range; give a stress above 0, such as 190 GPa"},
    {"190 GPa", "~", "7:3: young: ~ is not a number; give a stress, such as 190 GPa"},
    {"190 GPa", "", "7:3: young: no value is not a number; give a stress, such as 190 GPa"},
    {"190 GPa", "[1]", "7:3: young: a list is not a number; give a stress, such as 190 GPa"},
    {"190 GPa", "many GPa", "7:3: young: many GPa is not a number; give a stress, such as 190 GPa"},
    {"190 GPa", "1e-400", "7:3: young: 1e-400 is out of range; give a stress above 0, such as 190 GPa"},
    {"poisson: 1/3", "poisson: 0.3",
     "8:3: poisson: a Poisson's ratio of 0.3 is impossible with bonds, which have 1/3 in space plane stress; use "
     "`model: ospd` for any ratio, or remove this key"},
    {"poisson: 1/3", "poisson: 0.3\n  yield_stress: 1 GPa",
     "8:3: poisson: a Poisson's ratio of 0.3 is impossible with bonds, which have 1/3 in space plane stress; use "
     "`method: mpm` for any ratio, or remove this key"},
    {"kJ/m^2\n", "kJ/m^2\n  yield_stress: 1 GPa\nmodel: ospd\n",
     "11:3: yield_stress: the model ospd cannot yield; set `model: bond`"},
    {"poisson: 1/3", "poisson: 0.5", "8:3: poisson: 0.5 is out of range; give a plain number above -1 up to 0.4999"},
    {"poisson: 1/3", "critical_stretch: 0.01",
     "8:3: critical_stretch: is given together with energy_release_rate, but each determines the other; remove one of "
     "the two"},
    {"poisson: 1/3", "toughness: 60 MPa",
     "8:3: toughness: is given together with energy_release_rate, but each determines the other; remove one of the "
     "two"},
    {"poisson: 1/3", "yield_hardening: -1 GPa",
     "8:3: yield_hardening: -1 GPa is out of range; give a stress from 0 on, such as 190 GPa"},
    {"poisson: 1/3", "young: 2 GPa", "8:3: young: is given twice, first in line 7; remove one of the two"},
    {"method: adaptive", "method: fem", "5:1: method: fem is unknown; give pd, mpm, adaptive or auto"},
    {"method: adaptive", "model: lps",
     "5:1: model: lps is unknown; give bond, ospd or mospd; the ordinary state-based model (peri/lps of LAMMPS) is "
     "ospd"},
    {"method: adaptive", "solver: newton",
     "5:1: solver: newton is unknown; give explicit, relaxation, cg or static; Cleave has no implicit dynamics; "
     "static, with load steps, follows equilibria"},
    {"method: adaptive", "solver: cg",
     "5:1: solver: the solver cg works with method: pd only; with material points set solver: relaxation"},
    {"method: adaptive", "solver_tolerance: 0",
     "5:1: solver_tolerance: 0 is out of range; give a plain number from 1e-12 to 0.1"},
    {"method: adaptive", "accuracy: 1e-3", "5:1: accuracy: has no effect without method: auto; remove it"},
    {"method: adaptive", "interface_damping: 0.25\nrim_damping: 0.5",
     "6:1: rim_damping: is given together with interface_damping; remove one of the two"},
    {"method: adaptive", "accuracy_table: cost_accuracy.csv",
     "5:1: accuracy_table: is no longer a key; remove it (`method: auto` always chooses by pilot runs)"},
    {"method: adaptive", "method: auto",
     "5:1: method: the method auto works in `cleave run` only, which makes pilot runs; give a method and "
     "particles.spacing, or use the scene.yaml that such a run writes"},
    {"method: adaptive", "steps: {number: 50}",
     "5:1: steps: the keys of steps need solver: static; set it, or remove them"},
    {"method: adaptive", "solver: static\nsteps: {control: opening}",
     "6:1: steps: the control opening needs two positions, steps.from and steps.to, and the increase of their "
     "distance, steps.opening; give all three"},
    {"method: adaptive", "coupling: glue",
     "5:1: coupling: glue is unknown; give partial stress, handshake, pm, pg, pmg or pgg"},
    {"method: adaptive", "horizon: 3", "5:1: horizon: this key does not belong here; use the key particles.horizon"},
    {"surface: none", "model: bond", "19:3: model: this key does not belong here; put model at the left margin"},
    {"method: adaptive", "section: 1", "5:1: section: space plane stress has no section; remove this key"},
    {"method: adaptive", "body: {ball: {centre: [0, 0], radius: 1}}",
     "11:1: bodies: is given together with body; remove one of the two"},
    {"plane stress", "plain stress",
     "2:1: space: plain stress is unknown; give line, plane stress, plane strain or solid"},
    {"name: plate\nspace", "name: my plate\nspace",
     "1:1: name: my plate is not a name; use letters, digits, _ and -, and do not begin with -"},
    {"name: plate\nspace", "name: xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx\nspace",
     "1:1: name: xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx... is too long; give at most 63 characters"},
    {"horizon: 3.015", "horizon: 0.8", "16:3: horizon: 0.8 is smaller than one spacing; 3.015 is usual"},
    {"horizon: 3.015", "horizon: 12", "16:3: horizon: 12 is out of range; give a plain number from 1 to 10.5"},
    {"horizon: 3.015", "horizon: yes", "16:3: horizon: yes is not a number; give a plain number, such as 0.25"},
    {"spacing: 1 mm", "spacing: 1 nm",
     "15:3: spacing: a spacing of 1 nm makes about 2.0e+16 particles in bodies up to 0.2 m long, more than the limit "
     "of 2e9; use a larger spacing"},
    {"seed: 7", "seed: -1", "17:3: seed: -1 is not a seed; give a whole number from 0 to 18446744073709551615"},
    {"seed: 7", "irregularity: 1.5", "17:3: irregularity: 1.5 is out of range; give a plain number from 0 to 1"},
    {"block: true", "block: yes", "22:3: block: yes is neither true nor false; write true or false"},
    {"block: true", "criteria: [bond, damage]", "22:20: criteria[1]: damage is unknown; give bond or stress"},
    {"block: true", "alpha: 0", "22:3: alpha: 0 is out of range; give a plain number above 0 up to 1"},
    {"transfer: flip, shape: gimp", "transfer: apic, shape: linear",
     "20:7: transfer: apic is unstable with mpm.shape: linear; set mpm.transfer: flip, or mpm.shape: gimp"},
    {"transfer: flip", "frame: sideways", "20:7: frame: sideways is unknown; give current, reference or auto"},
    {"transfer: flip", "cell: 0.5", "20:7: cell: 0.5 is out of range; give a plain number from 1 to 8"},
    {"[0, -100 mm]", "[0, -100 mm, 0]", "13:19: from: has 3 components; give 2 in space plane stress"},
    {"[0, -100 mm]", "0", "13:19: from: 0 is not a list; give 2 components in space plane stress, such as [0.5 mm, 0]"},
    {"[0, -100 mm]", "[0, -inf]", "13:29: from[1]: -inf is not finite; give a length, such as 0.5 mm"},
    {"from: [0, -100 mm]", "from: [0, 100 mm]",
     "13:13: box: from is not below to along y; give the smaller coordinates by from, the larger ones by to"},
    {"box: {from: [0, -100 mm], to: [100 mm, 100 mm]}", "cylinder: {radius: 1}",
     "13:13: cylinder: cannot be used in space plane stress; use disc, polygon, ellipse, ring or box"},
    {"box: {from: [0, -100 mm], to: [100 mm, 100 mm]}", "disc: {centre: [0, 0], radius: 0}",
     "13:36: radius: 0 is out of range; give a length above 0, such as 0.5 mm"},
    {"box: {from: [0, -100 mm], to: [100 mm, 100 mm]}", "half-space: {point: [0, 0], normal: [1, 0]}",
     "13:13: half-space: a body cannot be infinite; use a finite solid, such as box, ball or cylinder"},
    {"box: {from: [0, -100 mm], to: [100 mm, 100 mm]}", "subtract: {ball: {centre: [0, 0], radius: 1}}",
     "13:5: shape: has no solid before it from which to subtract; add one first (in a region perhaps all: true)"},
    {"box: {from: [0, -100 mm], to: [100 mm, 100 mm]}", "add: {add: {all: true}}",
     "13:19: add: cannot be inside add, subtract or intersect; give a solid such as box there"},
    {"box: {from: [0, -100 mm], to: [100 mm, 100 mm]}", "sphere: {radius: 1}",
     "13:13: sphere: unknown key; here it is `ball`"},
    {"shape: {box: {from: [0, -100 mm], to: [100 mm, 100 mm]}}", "shape: []",
     "13:5: shape: is an empty list; give at least one solid, such as box"},
    {"shape: {box: {from: [0, -100 mm], to: [100 mm, 100 mm]}}", "material: iron",
     "13:5: material: there is no material iron; did you mean material?"},
    {"shape: {box: {from: [0, -100 mm], to: [100 mm, 100 mm]}}", "velocity: [0, 0]",
     "12:5: shape: missing in bodies; give a solid or a list of solids, such as {box: {from: [..], to: [..]}}"},
    {"shape: {box: {from: [0, -100 mm], to: [100 mm, 100 mm]}}", "particles: grains.xyz",
     "13:5: particles: grains.xyz is not a particle list; give the name of a file that ends in .csv, .h5 or .exo"},
    {"cracks:\n", "cracks:\n  - {at: 1}\n",
     "24:6: at: cannot be used in space plane stress; give the crack by from and to"},
    {"from: [0, 25 mm], to", "from: [50 mm, 25 mm], to",
     "24:5: cracks[0]: has the length 0; give two different ends, from and to"},
    {"to: [50 mm, 25 mm]", "too: [50 mm, 25 mm]", "24:24: too: unknown key; did you mean to?"},
    {"[22 m/s, free]", "[free, free]", "28:5: velocity: every component is free; give at least one velocity"},
    {"[22 m/s, free]", "[22 m/s, fre]", "28:24: velocity[1]: fre is not a number; give a velocity, such as 22 m/s"},
    {"[22 m/s, free]", "[22 m, free]", "28:16: velocity[0]: 22 m is a length; give a velocity, such as 22 m/s"},
    {"[22 m/s, free]", "22 m/s",
     "28:5: velocity: 22 m/s does not have the number of components of space plane stress; give a list of 2, for "
     "example [22 m/s, free]"},
    {"velocity: [22 m/s, free]", "fixed: [x, z]",
     "28:16: fixed[1]: z is not an axis of space plane stress; give x or y"},
    {"velocity: [22 m/s, free]", "fixed: [x, x]", "28:16: fixed[1]: x is given twice; name each axis once"},
    {"velocity: [22 m/s, free]\n", "velocity: [22 m/s, free]\n    fixed: all\n",
     "29:5: fixed: is given together with velocity in one item of the list; write each boundary condition as an item "
     "of its own"},
    {"    velocity: [22 m/s, free]\n", "",
     "26:5: boundary[0]: has no load or support; give one of fixed, velocity, displacement, rotation, traction, "
     "pressure, body_force, mirror or absorbing"},
    {"velocity: [22 m/s, free]", "mirror: {axis: z, at: 0}",
     "27:5: region: has no effect with mirror, which acts on every body; remove it"},
    {"until: 5 us", "from: 9 us, until: 5 us",
     "29:12: step: from is not earlier than until; exchange or correct the two times"},
    {"{step: {until: 5 us}}", "sometimes",
     "29:5: time: sometimes is not a function of time; give constant, step, pulse, ramp, table or file"},
    {"{step: {until: 5 us}}", "{table: [[1 us, 0], [0, 1]]}",
     "29:32: table[1][0]: time 0 is not later than the previous one; give times in ascending order"},
    {"{step: {until: 5 us}}", "{table: [[1 us, 0]]}", "29:12: table: has 1 items; give 2 to 50000"},
    {"{step: {until: 5 us}}", "{table: [[1 us, 0], 3]}",
     "29:31: table[1]: 3 is not a pair of time and factor; give one such as [5 us, 1]"},
    {"pull, traction: [1 MPa, 0], face: x+", "pull, traction: [1 MPa, 0], face: x+, profile: uniform",
     "30:50: profile: has no effect without body_force; remove it"},
    {"traction: [1 MPa, 0], face: x+", "mirror: {axis: x, at: 0}, profile: {sine: {wavelength: 1}}",
     "30:44: profile: has no effect without body_force; remove it"},
    {"traction: [1 MPa, 0], face: x+", "body_force: [1, 0], profile: wave",
     "30:38: profile: wave is not a profile; give uniform or a mapping such as {sine: {wavelength: 1 m}}"},
    {"traction: [1 MPa, 0], face: x+", "body_force: [1, 0], profile: {}",
     "30:38: profile: has 0 keys; give one, such as {sine: {wavelength: 1 m}}"},
    {"traction: [1 MPa, 0], face: x+", "body_force: [1, 0], profile: {sine: {}}",
     "30:48: wavelength: missing in boundary.profile.sine; give a length, such as 0.5 mm"},
    {"traction: [1 MPa, 0], face: x+", "body_force: [1, 0], profile: {sine: {wavelength: 0}}",
     "30:55: wavelength: 0 is out of range; give a length above 0, such as 0.5 mm"},
    {"traction: [1 MPa, 0], face: x+", "body_force: [1, 0], profile: {sine: {wavelength: 1, direction: [0, 0]}}",
     "30:70: direction: has a length of 0 or infinity; give the direction in which the force varies, such as [1, 0]"},
    {", face: x+", "", "30:5: face: missing in boundary; give x+, x-, y+, y-, z+ or z-"},
    {"face: x+", "face: z+", "30:40: face: z+ is not the name of a face in space plane stress; give x+, x-, y+ or y-"},
    {"name: pull", "name: impact",
     "30:5: boundary[1]: impact is already the name of another boundary; give each boundary its own name"},
    {"name: impact\n", "name: impact\n    body: plat\n", "27:5: body: there is no body plat; did you mean plate?"},
    {"boundary: impact", "boundary: impct",
     "36:16: boundary: there is no boundary named impct; give the name of one of the 2 in the scene (most similar: "
     "impact)"},
    {"  - tip\n", "  - {name: a, point: [0, 0]}\n",
     "34:6: name: this key belongs inside point; write point: {name: ..}"},
    {"  - tip\n", "  - tip\n  - tip\n", "35:5: probes[1]: tip is already the name of another probe; give each its own"},
    {"  - tip\n", "  - sif: {inner: 20 mm, contours: [10 mm, 15 mm]}\n",
     "34:11: inner: the inner radius 20 mm is not smaller than the outer radius, 0.015 m; use about half the outer "
     "radius"},
    {"  - tip\n", "  - sif: {direction: [0, 0]}\n",
     "34:11: direction: has the length 0; give the direction ahead of the crack tip, such as [1, 0]"},
    {"  - tip\n", "  - sif: {contours: [2 mm, 1 mm]}\n",
     "34:28: contours[1]: 1 mm is not larger than the previous value; give values in ascending order"},
    {"probes:\n",
     "initial: [{pulse: {at: [0, 0], direction: [1, 0], width: 1, velocity: 1, polarisation: [1, 1]}}]\nprobes:\n",
     "33:74: polarisation: is neither parallel nor perpendicular to direction, as the motion in a plane wave must be; "
     "change it"},
    {"probes:\n",
     "initial: [{pulse: {at: [0, 0], direction: [1, 0], width: 1, velocity: 1, polarisation: [0, 0]}}]\nprobes:\n",
     "33:74: polarisation: has the length 0 and thus no direction; give `direction`, or move one of the two ends"},
    {"probes:\n", "initial: [{velocity: [x/s, 1 m/s*t/s]}]\nprobes:\n",
     "33:28: velocity[1]: 1 m/s*t/s contains t, on which this key cannot depend; remove it"},
    {"  - tip\n", "  - exact: step bar\n",
     "34:5: exact: compares with the solution of a bar in one dimension; set space: line, or remove this probe"},
    {"  - tip\n", "  - exact\n",
     "34:5: form: missing in probes.exact; give step bar, plastic bar, pulse or manufactured"},
    {"  - tip\n", "  - exact: rod\n", "34:5: form: rod is unknown; give step bar, plastic bar, pulse or manufactured"},
    {"frames: 20", "frames: 20, times: [1 us]", "32:22: times: is given together with frames; remove one of the two"},
    {"frames: 20", "times: []", "32:10: times: has 0 items; give 1 to 100000"},
    {"frames: 20", "times: 5 us", "32:10: times: 5 us is not allowed here; give a list such as [20 us]"},
    {"frames: 20", "times: [2 us, 2 us]",
     "32:24: times[1]: 2 us is not larger than the previous value; give values in ascending order"},
    {"frames: 20", "times: [0, 2 us]", "32:18: times[0]: 0 is out of range; give a time above 0, such as 20 us"},
    {"  - tip\n", "  - tips\n", "34:5: tips: unknown key; did you mean tip?"},
    {", at: [1 mm, 1 mm]", "", "35:5: at: missing in probes.point; give a list of numbers, such as [0.5 mm, 0]"},
    {"step: auto", "step: 0", "31:8: step: 0 is out of range; give a time above 0, such as 20 us"},
    {"step: auto", "step: 1e-30",
     "31:8: step: 1e-30 makes 5.0e+25 time steps, more than the limit of 1e12; use a larger step"},
    {"step: auto", "step: always", "31:8: step: always is not a number; give a time, such as 20 us"},
    {"step: auto", "safety: 2.5", "31:8: safety: 2.5 is out of range; give a plain number above 0 up to 2"},
    {"frames: 20", "frames: 1.5", "32:10: frames: 1.5 is not a whole number; write digits only, such as 20"},
    {"frames: 20", "frames: 100001", "32:10: frames: 100001 is out of range; give a whole number from 0 to 100000"},
    {"frames: 20", "frames: 99999999999999999999",
     "32:10: frames: 99999999999999999999 is out of range; give a whole number from 0 to 100000"},
    {"frames: 20", "compress: on", "32:10: compress: on is neither true nor false; write true or false"},
    {"output: {frames: 20}", "output: 20", "32:1: output: 20 is not allowed here; give a mapping such as {frames: 20}"},
    {"name: plate\nspace", "name: &p plate\nspace",
     "1:7: an anchor (&) is not allowed in a scene; write the value out where it is used"},
    {"name: plate\nspace", "name: *p\nspace", "1:7: an alias (*) is not allowed in a scene; write the value out"},
    {"name: plate\nspace", "name: !!str plate\nspace",
     "1:7: a tag (!) is not allowed in a scene, whose keys determine the types of values; remove it"},
    {"name: plate\nspace", "<<: {a: 1}\nspace", "1:1: merge keys (<<) are not allowed in a scene; write the keys out"},
    {"name: plate\nspace", "? [a]\n: 1\nspace", "1:3: has a list or mapping as a key; write a single word"},
    {"name: plate\nspace", "name: \"a\\0b\"\nspace", "1:7: contains a NUL character; remove it"},
    {"name: plate\nspace", "name: \"a\\nb\"\nspace",
     "1:1: name: a?b is not a name; use letters, digits, _ and -, and do not begin with -"},
    {"  young", "\tyoung",
     "7:1: not YAML: found character that cannot start any token; indent by spaces (not tabs), write `: ` after each "
     "key, and close all brackets"},
    {"to: [50 mm, 25 mm]}", "to: [50 mm, 25 mm}",
     "24:41: not YAML: did not find expected ',' or ']'; indent by spaces (not tabs), write `: ` after each key, and "
     "close all brackets"},
    {"name: plate\nspace", "name: [[[[[[[[[[[[[[[[[]]]]]]]]]]]]]]]]]\nspace",
     "1:22: is nested deeper than 16 levels, more than any key of a scene; remove some levels"},
    {"  - reaction: {boundary: impact}\n", "---\nname: b\n",
     "36:1: a second document (---) begins; put each scene into a file of its own"},
    {"name: plate\nspace",
     "name: pla\377"
     "te\nspace",
     "1:10: not YAML: invalid leading UTF-8 octet; indent by spaces (not tabs), write `: ` after each key, and close "
     "all brackets"},
};

/* Returns the valid scene with the only occurrence of `piece` replaced by instead[instead_length], which may contain
 * NUL bytes. *length: receives its length. To be freed with test_free. */
static char *replaced(const char *piece, const char *instead, size_t instead_length, size_t *length)
{
    const char *at = strstr(good, piece);
    if (!at || strstr(at + 1, piece)) fail_msg("not exactly once in the scene: %s", piece);
    size_t before = (size_t)(at - good), rest = strlen(at + strlen(piece));
    char *text = test_malloc(before + instead_length + rest + 1);
    memcpy(text, good, before);
    memcpy(text + before, instead, instead_length);
    memcpy(text + before + instead_length, at + strlen(piece), rest + 1);
    *length = before + instead_length + rest;
    return text;
}

static void check_refused(const char *text, size_t length, const char *message)
{
    struct scene s;
    char expected[1024];
    snprintf(expected, sizeof expected, "bad.yaml:%s", message);
    if (scene_read_text(&s, text, length, "bad.yaml", NULL, 0) != REFUSED) fail_msg("not refused: %s", message);
    assert_string_equal(status_message(), expected);
}

static void test_good(void **state)
{
    (void)state;
    struct scene s;
    if (scene_read_text(&s, good, strlen(good), "good.yaml", NULL, 0) != OK) fail_msg("%s", status_message());
    scene_free(&s);
}

static void test_cases(void **state)
{
    (void)state;
    for (size_t k = 0; k < COUNT_OF(cases); k++) {
        size_t length;
        char *text = replaced(cases[k].piece, cases[k].instead, strlen(cases[k].instead), &length);
        check_refused(text, length, cases[k].message);
        test_free(text);
    }
}

static void test_bytes(void **state)
{
    (void)state;
    size_t length;
    char *text = replaced("name: plate\nspace", "name: pla\0te\nspace", 18, &length);
    check_refused(text, length, "1:10: contains a NUL byte, but a scene is UTF-8 text; remove it");
    test_free(text);
    check_refused("", 0, "1:1: the scene is empty; begin with keys such as space and duration");
    check_refused("# nothing\n", 10, "1:1: the scene is empty; begin with keys such as space and duration");
    check_refused("- a\n", 4, "1:1: a list is not allowed here; give a scene, which is a mapping of keys to values");
    char *many = test_malloc(4000000); /* five events precede the first item */
    memcpy(many, "a: [", 4);
    for (int k = 0; k < 1000000; k++) memcpy(many + 4 + 2 * k, "1,", 2);
    check_refused(many, 2000004,
                  "1:1999995: the scene has more than 1000000 YAML items; put long data into a particle list");
    test_free(many);
}

/* Overrides that are refused, with the message. */
static const struct {
    struct scene_override o;
    const char *message;
} wrong[] = {
    {{"material.yuong", "70e9"}, "-s material.yuong=70e9: yuong: unknown key; did you mean young?"},
    {{"material.young", "70 kg"}, "-s material.young=70 kg: young: 70 kg is a mass; give a stress, such as 190 GPa"},
    {{"material.young", "[1]"}, "-s material.young=[1]: young: a list is not a number; give a stress, such as 190 GPa"},
    {{"materials[0].young", "70e9"},
     "-s materials[0].young=70e9: materials: is not a list in this scene, so [0] cannot be used; remove it"},
    {{"body", "{}"}, "-s body={}: body: is given together with bodies; remove one of the two"},
    {{"materiel.young", "1"}, "-s materiel.young=1: materiel: unknown key; did you mean material?"},
    {{"material", "steel"},
     "-s material=steel: material: steel is not allowed here; give a mapping such as {young: 190 GPa}"},
    {{"boundary.velocity", "[1, 0]"},
     "-s boundary.velocity=[1, 0]: boundary: has 2 items, and velocity is not the name of one; name an item by its "
     "number (from 0) or by name (impact, pull)"},
    {{"boundary.2.velocity", "[1, 0]"},
     "-s boundary.2.velocity=[1, 0]: boundary: has 2 items, and 2 is beyond the last; name an item by its number (from "
     "0) or by name (impact, pull)"},
    {{"boundary.0.velocity.2", "1"},
     "-s boundary.0.velocity.2=1: velocity: has 2 items, and 2 is beyond the last; name an item by its number (from "
     "0)"},
    {{"boundary.0.velocity", "[0, 20 kg]"},
     "-s boundary.0.velocity=[0, 20 kg]: velocity[1]: 20 kg is a mass; give a velocity, such as 22 m/s"},
    {{"material.0.young", "1"},
     "-s material.0.young=1: material: is not a list in this scene, so 0 cannot be used; remove it"},
    {{"growth.0.speed", "1"},
     "-s growth.0.speed=1: growth: is not a list in this scene, so 0 cannot be used; remove it"},
    {{"probes.a.att", "[0, 0]"}, "-s probes.a.att=[0, 0]: att: unknown key; did you mean at?"},
    {{"boundary[2].velocity", "[1, 0]"},
     "-s boundary[2].velocity=[1, 0]: boundary: has 2 items, so [2] is beyond the last one; use a smaller number (the "
     "first is [0])"},
    {{"boundary[0].velocity", "[0, 20 kg]"},
     "-s boundary[0].velocity=[0, 20 kg]: velocity[1]: 20 kg is a mass; give a velocity, such as 22 m/s"},
    {{"boundary[0].velocity[1]", "fre"},
     "-s boundary[0].velocity[1]=fre: velocity[1]: fre is not a number; give a velocity, such as "
     "22 m/s"},
    {{"duration.x", "1"},
     "-s duration.x=1: x: duration has the value 50 us and no keys below it; `cleave help` shows the path of every "
     "key"},
    {{"duration[0]", "1"}, "-s duration[0]=1: duration: is not a list in this scene, so [0] cannot be used; remove it"},
    {{"material..young", "1"},
     "-s material..young=1: material..young: is not a path of keys; give one such as material.young or "
     "boundary.0.velocity"},
    {{"", "1"}, "-s =1: has no key; write for example material.young=70e9"},
    {{"boundary[0][0].velocity", "2"},
     "-s boundary[0][0].velocity=2: boundary[0]: is not a list in this scene, so [0] cannot be used; remove it"},
    {{"[0]", "1"}, "-s [0]=1: is not a list in this scene, so [0] cannot be used; remove it"},
    {{"particles.irregularity", ""},
     "-s particles.irregularity=: irregularity: is not in the scene, so it cannot be removed (an empty value removes a "
     "key); check its spelling"},
    {{"particles.horizon", "0.8"},
     "-s particles.horizon=0.8: horizon: 0.8 is smaller than one spacing; 3.015 is usual"},
    {{"boundary", "{left: {fixed: all, face: x-}}"},
     "-s boundary={left: {fixed: all, face: x-}}: left: unknown key; names of entries stand inside a list: boundary: "
     "[{name: left, ..}]"},
    {{"probes[1].point.att", "[0, 0]"}, "-s probes[1].point.att=[0, 0]: att: unknown key; did you mean at?"},
    {{"method", "[pd"},
     "-s method=[pd: not YAML: did not find expected ',' or ']'; indent by spaces (not tabs), write `: ` after each "
     "key, and close all brackets"},
    {{"method", "a: b: c"},
     "-s method=a: b: c: not YAML: mapping values are not allowed in this context; indent by spaces (not tabs), write "
     "`: ` after each key, and close all brackets"},
    {{"method", "*a"}, "-s method=*a: an alias (*) is not allowed in a scene; write the value out"},
    {{"material.poisson", "0.3"},
     "-s material.poisson=0.3: poisson: a Poisson's ratio of 0.3 is impossible with bonds, which have 1/3 in space "
     "plane stress; use `model: ospd` for any ratio, or remove this key"},
    {{"duration", ""}, "x:1:1: duration: missing; give a time, such as 20 us"},
};

static void test_overrides(void **state)
{
    (void)state;
    for (size_t k = 0; k < COUNT_OF(wrong); k++) {
        struct scene s;
        if (scene_read_text(&s, good, strlen(good), "x", &wrong[k].o, 1) != REFUSED)
            fail_msg("not refused: %s", wrong[k].message);
        assert_string_equal(status_message(), wrong[k].message);
    }
}

static void test_files(void **state)
{
    (void)state;
    struct scene s;
    assert_int_equal(scene_read(&s, "no/such.yaml", NULL, 0), REFUSED);
    assert_string_equal(status_message(), "no/such.yaml: No such file or directory; give a scene file");
    assert_int_equal(scene_read(&s, "/", NULL, 0), REFUSED);
    assert_string_equal(status_message(), "/: is a folder; give a scene file");
    char folder[] = "/tmp/scene_XXXXXX", path[64], list[64];
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/a.yaml", folder);
    snprintf(list, sizeof list, "%s/grains.csv", folder);
    FILE *out = fopen(path, "w");
    assert_non_null(out);
    fputs(good, out);
    fclose(out);
    static const struct scene_override o[] = {{"bodies[0].shape", ""}, {"bodies[0].particles", "grains.csv"}};
    assert_int_equal(scene_read(&s, path, o, 2), REFUSED);
    assert_string_equal(status_message(),
                        "-s bodies[0].particles=grains.csv: particles: grains.csv cannot be read; put a particle list "
                        "of this name into the folder of the scene, or correct the name");
    out = fopen(list, "w");
    assert_non_null(out);
    fputs("x,y,volume\n", out);
    fclose(out);
    assert_int_equal(scene_read(&s, path, o, 2), OK);
    assert_string_equal(s.body->file, list);
    scene_free(&s);
    unlink(list), unlink(path), rmdir(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_good),      cmocka_unit_test(test_cases), cmocka_unit_test(test_bytes),
        cmocka_unit_test(test_overrides), cmocka_unit_test(test_files),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
