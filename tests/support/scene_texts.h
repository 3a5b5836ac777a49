/* Scenes that together contain every key, for tests of the scene reader. */
#ifndef CLEAVE_TESTS_SCENE_TEXTS
#define CLEAVE_TESTS_SCENE_TEXTS

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>
#include <cmocka.h>

#include "scene/scene.h"
#include "scene/scene_read.h"

static const char plate[] =
    "name: plate-1\n"
    "space: plane stress\n"
    "thickness: 10 mm\n"
    "duration: 50 us\n"
    "method: mpm\n"
    "model: bond\n"
    "solver: explicit\n"
    "coupling: handshake\n"
    "materials:\n"
    "  - {name: steel, young: 190 GPa, poisson: 0.3, density: 7.8 g/cm^3, energy_release_rate: 69 kJ/m^2}\n"
    "  - {name: glass, young: 72e9, poisson: 1/4, density: 2440 kg/m3, critical_stretch: 0.1 %}\n"
    "  - {name: tough, young: 200 GPa, density: 8000, toughness: 60 MPa sqrt(m)}\n"
    "  - {name: hard, young: 1 MPa, density: 1, critical_stretch: inf}\n"
    "bodies:\n"
    "  - {name: bar, material: glass, velocity: [3 mm/us, -1 km/s], shape: {box: {from: [0, 0], to: [0.1, 20 cm]}},\n"
    "     parts: [{region: {disc: {centre: [5 cm, 0], radius: 1 cm}}, material: steel},\n"
    "       {region: {all: true}, material: hard}]}\n"
    "  - name: plate\n"
    "    material: steel\n"
    "    shape:\n"
    "      - box: {from: [0.2, 0], to: [0.3, 0.2]}\n"
    "      - subtract: {disc: {centre: [0.25, 0.1], radius: 5 mm}}\n"
    "      - add: {ball: {centre: [0.25, 0.1], radius: 2500 um}}\n"
    "      - subtract: {half-space: {point: [0, 0.01], normal: [0, 2]}}\n"
    "  - {material: tough, particles: grains.csv}\n"
    "particles: {spacing: 1 mm, horizon: 4.015, irregularity: 0.25, seed: 18446744073709551615}\n"
    "pd:\n"
    "  volume: cut-ramp\n"
    "  calibration: vmpd\n"
    "  surface: volume\n"
    "  weights: isotropic\n"
    "  region: [{all: true}, {subtract: {box: {from: [-inf, 0], to: [0.1, inf]}}}]\n"
    "mpm: {cell: 1.5, shape: cubic, transfer: apic, frame: current, origin: [0.5 mm, 0]}\n"
    "conversion: {stress: 3.8 GPa, alpha: 0.9, block: false, criteria: [stress]}\n"
    "cracks:\n"
    "  - {from: [0, 25 mm], to: [50 mm, 25 mm]}\n"
    "  - {from: [0, -25 mm], to: [50 mm, -25 mm]}\n"
    "crack: {speed_window: 2 us}\n"
    "initial:\n"
    "  - {body: bar, velocity: [1, 2], velocity_gradient: [0, 100 1/s, -100 Hz, 0], centre: [1 nm, 0]}\n"
    "  - {region: {all: true}, displacement_gradient: [[1e-3, 0], [0, 2 %]]}\n"
    "boundary:\n"
    "  - {name: impact, region: {box: {from: [0, 0], to: [3 mm, 1]}}, velocity: [22 m/s, free],\n"
    "     time: {step: {until: 5 us}}}\n"
    "  - {body: bar, fixed: [y], time: {pulse: {from: 1 us, until: 2 us}}}\n"
    "  - {fixed: all, time: {ramp: {until: 1 ms}}}\n"
    "  - {traction: [1 MPa, 0], face: y-, time: {table: [[0, 0], [1 us, 1], [2 us, 50 %]]}}\n"
    "  - {body_force: [0, 1e5 N/m^3], time: constant}\n"
    "  - {body_force: [0, 2], profile: {sine: {wavelength: 20 cm, origin: [1 mm, 0], direction: [1, 3]}}}\n"
    "  - {body_force: [1, 0], profile: {sine: {wavelength: 1/3}}}\n"
    "  - {mirror: {axis: y, at: 1 mm, tangential: held}}\n"
    "time: {step: 20 ns, safety: 1.5}\n"
    "output: {frames: 0, samples: 10, checkpoint: 5 s, compress: true}\n"
    "probes:\n"
    "  - tip\n"
    "  - tip: {name: second, at: [1, 2]}\n"
    "  - break: {region: {disc: {centre: [0, 0], radius: 1}}}\n"
    "  - reaction: {boundary: impact}\n"
    "  - patch:\n"
    "  - spall\n"
    "  - point: {name: p, at: [1, 1]}\n"
    "  - line: {from: [0, 0], to: [1, 1], points: 11}\n"
    "  - energy: {region: {all: true}}\n"
    "  - momentum: {}\n"
    "  - sif: {at: [1 mm, 2 mm], contours: [30 mm, 50 mm], stress: particle, weight: cubic, speed: 1 km/s, reach: 2}\n"
    "  - rigid: {region: {all: true}}\n";

static const char bar[] =
    "space: line\n"
    "duration: 1 ms\n"
    "material: {young: 1e4, density: 1, critical_stretch: 0.14}\n"
    "bodies:\n"
    "  - {name: impactor, velocity: 30, shape: {box: {from: -30 mm, to: 0}}}\n"
    "  - {name: bar, shape: [{box: {from: [0], to: [70 mm]}}, {subtract: {ball: {centre: 0.03, radius: 1 mm}}}]}\n"
    "particles: {spacing: 1 mm}\n"
    "cracks: [{at: 20 mm}, {at: [0.05]}]\n"
    "boundary: [{velocity: 3, body: bar}, {mirror: {axis: x, at: 0}}, {traction: 1 kPa, face: x+}]\n"
    "initial: [{velocity_gradient: 3}]\n";

static const char rod[] =
    "space: line\n"
    "duration: 10 ms\n"
    "material: {young: 1e4, density: 1}\n"
    "body: {box: {from: [0], to: [1]}}\n"
    "particles: {spacing: 5 mm}\n"
    "boundary: [{traction: 1, face: x+}]\n"
    "output: {times: [1 ms, 5 ms, 0.01]}\n"
    "probes:\n"
    "  - exact: step bar\n"
    "  - exact: {form: plastic bar, name: yields}\n"
    "  - exact: {form: pulse, name: packet}\n"
    "  - exact: {form: manufactured, name: made, amplitude: 1 mm, period: 2 ms, wavelength: 50 cm, origin: -1 mm}\n";

static const char block[] =
    "space: solid\n"
    "duration: 1e-5\n"
    "method: pd\n"
    "material: {young: 70 GPa, density: 2700, energy_release_rate: 10}\n"
    "body:\n"
    "  - cylinder: {from: [0, 0, 0], to: [0, 0, 1 cm], radius: 1 cm}\n"
    "  - ball: {centre: [0, 0, 0], radius: 0.01}\n"
    "particles: {spacing: 1 mm}\n"
    "cracks: [{polygon: [[0, 0, 0], [5 mm, 0, 0], [5 mm, 5 mm, 0], [0, 5 mm, 0]]}]\n"
    "initial: [{velocity_gradient: [0, 1, 2, 3, 4, 5, 6, 7, 8]}]\n"
    "boundary: [{velocity: [free, free, 2], region: {half-space: {point: [0, 0, 0], normal: [0, 0, 1]}}}]\n";

static const char grown[] =
    "space: plane stress\n"
    "thickness: 1 mm\n"
    "duration: 1 us\n"
    "method: pd\n"
    "material: {young: 70 GPa, density: 2700}\n"
    "body: {box: {from: [0, 0], to: [40 mm, 40 mm]}}\n"
    "particles: {spacing: 1 mm}\n"
    "cracks: [{from: [-1 mm, 20 mm], to: [20 mm, 20 mm]}]\n"
    "growth:\n"
    "  - {name: told, at: [20 mm, 20 mm], direction: [3, 4], speed: 1 km/s, damping: 0, exponent: 1, length: 5 mm}\n"
    "  - {at: [20 mm, 20 mm], direction: [1, 0], speed: 750 m/s, probe: sif, toughness: 68 MPa m^0.5, smoothing: 2 "
    "mm}\n"
    "probes:\n"
    "  - sif: {outer: 10 mm}\n"
    "  - growth\n"
    "  - growth: {name: ruled, of: growth1, experiment: 70}\n";

/* Reads a scene from `text` with the overrides o[n] of its keys and returns it; the test fails if the scene is not
 * valid. Release it with scene_free. */
static struct scene read_ok(const char *text, const struct scene_override *o, int n)
{
    struct scene s;
    if (scene_read_text(&s, text, strlen(text), "dir/given.yaml", o, n) != OK) fail_msg("%s", status_message());
    return s;
}

#endif
