/* Scenes with one result in closed form each. The texts leave out method, accuracy, spacing and output. */
#include "uncertainty.h"

#define STEEL_LINE "material: {young: 200 GPa, density: 8000}\n" /* c = 5000 m/s */
#define BARS                                                                                                           \
    "bodies:\n  - {name: left, shape: {box: {from: [-20 mm], to: [0]}}, velocity: [5 m/s]}\n"                          \
    "  - {name: right, shape: {box: {from: [0.01 mm], to: [20.01 mm]}}, velocity: [-5 m/s]}\n"                         \
    "contact: {between: bodies}\n"
#define PULLED "boundary: [{traction: [1 MPa, 0], face: x+}, {traction: [-1 MPa, 0], face: x-}]\n"

const struct pilot_scene pilot_scenes[] = {
    /* Two bars of 20 mm (1 m^2) collide with 5 m/s each, 4000 J in all, after 1 us. At 4 us the waves have travelled 15
     * mm in each bar; behind them nothing moves: a quarter of the energy is kinetic. */
    {"bars that meet", "space: line\nduration: 4 us\n" STEEL_LINE BARS, "energy.kinetic", 1000},
    {"bars that meet", "space: line\nduration: 4 us\n" STEEL_LINE BARS, "energy.strain", 3000},

    /* A rigid mass m hits a bar of impedance Z = rho c A = 4e7 kg/s: v = V exp(-Z t/m); 80 kg, 5 m/s, 3 us. */
    {"mass strikes a bar",
     "space: line\nduration: 3 us\n" STEEL_LINE "bodies:\n  - {name: bar, shape: {box: {from: [0], to: [20 mm]}}}\n"
     "  - {name: mass, rigid: true, mass: 80 kg, velocity: [5 m/s], shape: {box: {from: [-5 mm], to: [0]}}}\n"
     "contact: {between: bodies}\nprobes: [momentum: {name: bar}]\n",
     "probes.bar.x", 80 * 5 * 0.77686983985157},

    /* A bar beyond its yield stress (inputs/bar_plastic.yaml): behind the elastic precursor v = 0.5/(rho c), behind the
     * plastic front larger by 0.5/(rho c_p); the work of the traction of 1 Pa is A sigma v t. */
    {"yielding bar",
     "space: line\nduration: 7.5 ms\nmaterial: {young: 1e4, density: 1, yield_stress: 0.5, yield_tangent: 5000}\n"
     "body: {box: {from: [0], to: [1]}}\nboundary: [{traction: [-1], face: x+}]\n",
     "energy.external_work", 7.5e-3 * (0.5e-2 + 0.5 / 70.710678118654752)},

    /* Steel on aluminium (70 GPa, 2700 kg/m^3), a step of 100 MPa on the steel. At 3 us the transmitted and the
     * reflected wave have travelled for 1 us: v = 2.5 m/s in 5 mm of steel, 3.72109 m/s (stress 2 Z_2/(Z_1 + Z_2) of
     * the step) in 5 mm of steel and 5.0918 mm of aluminium. */
    {"two materials",
     "space: line\nduration: 3 us\nmaterials:\n  - {name: steel, young: 200 GPa, density: 8000}\n"
     "  - {name: light, young: 70 GPa, density: 2700}\nbodies:\n"
     "  - {name: left, material: steel, shape: {box: {from: [0], to: [10 mm]}}}\n"
     "  - {name: right, material: light, shape: {box: {from: [10 mm], to: [20 mm]}}}\n"
     "interfaces: [{bodies: [left, right]}]\nboundary: [{traction: [100 MPa], face: x-}]\n",
     "energy.kinetic", 497.108759},

    /* A layer under its weight b = 1e9 N/m^3, supported by a mirror at its top: energy b^2 L^3 A/(6 M), M = 269.23 GPa
     * at nu = 0.3. */
    {"hanging layer",
     "space: plane strain\nthickness: 1 mm\nduration: 1 s\nsolver: static\n"
     "material: {young: 200 GPa, poisson: 0.3, density: 8000}\nbody: {box: {from: [0, 0], to: [20 mm, 4 mm]}}\n"
     "boundary: [{mirror: {axis: x, at: 0}}, {mirror: {axis: y, at: 0}}, {mirror: {axis: y, at: 4 mm}}, "
     "{body_force: [1e9, 0]}]\n",
     "energy.strain", 1e18 * 8e-6 * 4e-6 / (6 * 269.230769230769e9)},

    /* Plates in static tension, energy sigma^2 V/(2 E): on a lattice, and with irregular particles. */
    {"pulled plate",
     "space: plane stress\nthickness: 1 mm\nduration: 1 s\nsolver: static\n"
     "material: {young: 200 GPa, poisson: 0.2, density: 7850}\nbody: {box: {from: [0, 0], to: [20 mm, 10 "
     "mm]}}\n" PULLED,
     "energy.strain", 5e-7},
    {"shaken plate",
     "space: plane stress\nthickness: 1 mm\nduration: 1 s\nsolver: static\nparticles: {irregularity: 0.2}\n"
     "material: {young: 200 GPa, poisson: 1/3, density: 7850}\nbody: {box: {from: [0, 0], to: [20 mm, 10 "
     "mm]}}\n" PULLED,
     "energy.strain", 5e-7},

    /* A centre crack in a strip, a/W = 1/2: K = sigma sqrt(pi a) (1 - 0.025 q^2 + 0.06 q^4) sqrt(sec(pi q/2)) (Tada),
     * accurate to 0.1 %. */
    {"centre crack",
     "space: plane stress\nthickness: 1 mm\nduration: 1 s\nsolver: static\n"
     "material: {young: 200 GPa, poisson: 1/4, density: 7850}\nbody: {box: {from: [0, -15 mm], to: [5 mm, 15 mm]}}\n"
     "cracks: [{from: [-1 mm, 0], to: [2.5 mm, 0]}]\nprobes: [sif: {at: [2.5 mm, 0], direction: [1, 0], contours: [1.8 "
     "mm]}]\n"
     "boundary: [{mirror: {axis: x, at: 0}}, {traction: [0, 1 MPa], face: y+}, {traction: [0, -1 MPa], face: y-}]\n",
     "probes.sif.K_I", 105127.26},

    /* An edge crack in a square, a/W = 1/2, H = W: K = 3.009 sigma sqrt(pi a) (boundary collocation). */
    {"edge crack",
     "space: plane stress\nthickness: 1 mm\nduration: 1 s\nsolver: static\n"
     "material: {young: 70 GPa, poisson: 0.3, density: 2700}\nbody: {box: {from: [0, 0], to: [16 mm, 16 mm]}}\n"
     "cracks: [{from: [-1 mm, 8 mm], to: [8 mm, 8 mm]}]\nprobes: [sif: {contours: [3.2 mm]}]\n"
     "boundary: [{traction: [0, 1 MPa], face: y+}, {traction: [0, -1 MPa], face: y-}]\n",
     "probes.sif.K_I", 477026.07},

    /* A pulse v exp(-(x/r)^2) of 0.1 m in steel travels 0.3 m: its crest is at 0.7 m. */
    {"pulse in a bar",
     "space: line\nduration: 60 us\nmaterial: {young: 200 GPa, density: 8000, critical_stretch: inf}\n"
     "body: {box: {from: [0], to: [1.2]}}\nprobes: [point: {name: crest, at: [0.7]}]\n"
     "initial: [{pulse: {at: [0.4], direction: [1], width: 0.1, velocity: 1 mm/s}}]\n",
     "probes.crest.velocity_x", 1e-3},

    /* A flyer of 0.1 m hits a bar of 0.9 m: fracture at 0.1 m from the free end when the waves have travelled 1 m. */
    {"bar that spalls",
     "space: line\nduration: 0.23 ms\nmaterial: {young: 200 GPa, density: 8000, critical_stretch: 1.5515e-3}\n"
     "body: {box: {from: [0], to: [1]}}\nprobes: [spall]\n"
     "initial: [{velocity: [-20], region: {box: {from: [0.9], to: [1]}}}]\n",
     "probes.spall.time", 2e-4},

    /* A square of 10 mm rotates at 1000 rad/s: energy rho h a^4/12 omega^2. */
    {"turning square",
     "space: plane stress\nthickness: 1 mm\nduration: 20 us\nmaterial: {young: 200 GPa, poisson: 0.25, density: 8000}\n"
     "body: {box: {from: [-5 mm, -5 mm], to: [5 mm, 5 mm]}}\ninitial: [{velocity_gradient: [0, -1000, 1000, 0]}]\n",
     "energy.kinetic", 8000 * 1e-3 * 1e-8 / 12 * 1e6},

    /* A disc expands with v = 10 r/s from its centre: at 2.5 us 5.27931e-6 J are kinetic, from linear finite elements
     * along the radius (200 and 400, extrapolated). */
    {"swelling disc",
     "space: plane stress\nthickness: 1 mm\nduration: 2.5 us\nmaterial: {young: 200 GPa, poisson: 1/3, density: 8000}\n"
     "body: {disc: {centre: [0, 0], radius: 10 mm}}\ninitial: [{velocity_gradient: [10, 0, 0, 10]}]\n",
     "energy.kinetic", 5.27931290266699e-06},

    /* A cube under tension at two faces: energy sigma^2 V/(2 E). */
    {"pulled cube",
     "space: solid\nduration: 1 s\nsolver: static\nmaterial: {young: 200 GPa, poisson: 0.3, density: 7850}\n"
     "body: {box: {from: [0, 0, 0], to: [10 mm, 10 mm, 10 mm]}}\n"
     "boundary: [{traction: [1 MPa, 0, 0], face: x+}, {traction: [-1 MPa, 0, 0], face: x-}]\n",
     "energy.strain", 2.5e-6},

    /* A step of shear traction on a layer that is supported across: work tau^2 A t/(rho c_s). */
    {"sheared layer",
     "space: plane strain\nthickness: 1 mm\nduration: 3 us\nmaterial: {young: 200 GPa, poisson: 1/4, density: 8000}\n"
     "body: {box: {from: [0, 0], to: [20 mm, 4 mm]}}\nboundary: [{traction: [0, 10 MPa], face: x+}, {fixed: [x]}]\n",
     "energy.external_work", 1e14 * 4e-6 * 3e-6 / (8000 * 3162.2776601683795)},
};
const int pilot_scenes_n = COUNT_OF(pilot_scenes);
