/* Small scenes for runs that are disturbed on purpose. Together they contain every kind of probe, every method and
 * model, conversion, reversion, contact and crack growth. Most of them sample every step; scenes whose runs are killed
 * also write a checkpoint after each sample. */
#ifndef CLEAVE_TESTS_FAULT_SCENES
#define CLEAVE_TESTS_FAULT_SCENES

#define EVERY_STEP "output: {frames: 3, samples: 1000000}\n"
#define EVERY_STEP_KEPT "output: {frames: 3, samples: 1000000, checkpoint: 0}\n"

struct fault_scene {
    const char *name, *text;
};

/* The smallest scene with all kinds of output, for faults at every call. */
static const struct fault_scene small_scene = {
    "small", "space: plane stress\nthickness: 1 mm\nduration: 1 us\n"
             "material: {young: 190 GPa, density: 7800, energy_release_rate: 100}\n"
             "body: {box: {from: [0, 0], to: [8 mm, 6 mm]}}\nparticles: {spacing: 1 mm}\ntime: {step: 0.2 us}\n"
             "cracks: [{from: [0, 3 mm], to: [4 mm, 3 mm]}]\n"
             "boundary: [{name: pull, velocity: [free, 10], region: {box: {from: [0, 5 mm], to: [8 mm, 6 mm]}}}]\n"
             "output: {frames: 1, samples: 2, checkpoint: 0}\n"
             "probes: [tip, line: {from: [0, 1 mm], to: [8 mm, 1 mm], points: 3}]\n"};

/* A plate with a crack in which material points convert in most steps. */
static const struct fault_scene converting_scene = {
    "converting",
    "space: plane stress\nthickness: 1 mm\nduration: 8 us\n"
    "material: {young: 190 GPa, density: 7800, energy_release_rate: 2000}\n"
    "body: {box: {from: [0, 0], to: [30 mm, 24 mm]}}\nparticles: {spacing: 1 mm}\ntime: {step: 0.1 us}\n"
    "conversion: {stress: 150 MPa}\n"
    "cracks: [{from: [-1 mm, 12 mm], to: [10 mm, 12 mm]}]\n"
    "boundary:\n"
    "  - {name: top, velocity: [free, 30], region: {box: {from: [0, 23 mm], to: [30 mm, 24 mm]}}}\n"
    "  - {name: bottom, velocity: [free, -30], region: {box: {from: [0, 0], to: [30 mm, 1 mm]}}}\n" EVERY_STEP_KEPT
    "probes: [tip, break, energy, momentum, reaction: {boundary: top}, point: {at: [20 mm, 12 mm]},\n"
    "         line: {from: [1 mm, 5 mm], to: [29 mm, 5 mm], points: 9}]\n"};

/* A pulse in a bar, whose front converts material points to peridynamic particles; they revert to points behind it. */
#define PASSING                                                                                                        \
    {                                                                                                                  \
        "passing",                                                                                                     \
            "space: line\nduration: 5 ms\nmaterial: {young: 1e4, density: 1}\nbody: {box: {from: [0], to: [1.024]}}\n" \
            "particles: {spacing: 8 mm, horizon: 3}\nconversion: {stress: 50, alpha: 1, reversion: true}\n"            \
            "initial: [{pulse: {at: [0.256], direction: [1], width: 80 mm, velocity: -1}}]\ntime: {step: 40 "          \
            "us}\n" EVERY_STEP_KEPT "probes: [pulse: {at: [0.512], direction: [1]}, energy]\n"                         \
    }
static const struct fault_scene passing_scene = PASSING;

/* Load steps of a body without supports, with a growing crack. */
#define IN_STEPS                                                                                                       \
    {                                                                                                                  \
        "steps",                                                                                                       \
            "space: plane stress\nthickness: 1 mm\nduration: 1 s\nmethod: pd\nsolver: static\nsteps: {number: 6, "     \
            "control: energy}\nmaterial: {young: 72 GPa, density: 2440, energy_release_rate: 135}\n"                   \
            "body: {box: {from: [0, 0], to: [16 mm, 16 mm]}}\nparticles: {spacing: 1 mm}\n"                            \
            "cracks: [{from: [-1 mm, 8 mm], to: [5.1 mm, 8 mm]}]\nboundary:\n"                                         \
            "  - {name: up, traction: [0, 40 MPa], face: y+, time: {ramp: {until: 1 s}}}\n"                            \
            "  - {traction: [0, -40 MPa], face: y-, time: {ramp: {until: 1 s}}}\noutput: {frames: 2}\n"                \
            "probes: [tip, break, reaction: {boundary: up}, point: {at: [2 mm, 12 mm]}]\n"                             \
    }
static const struct fault_scene steps_scene = IN_STEPS;

static const struct fault_scene fault_scenes[] = {
    IN_STEPS,
    {"bar", "space: line\nduration: 4 ms\nmethod: pd\nmaterial: {young: 1e4, density: 1, critical_stretch: 1e-3}\n"
            "body: {box: {from: [0], to: [1]}}\nparticles: {spacing: 20 mm, horizon: 3}\npd: {surface: none}\ntime: "
            "{step: 40 us}\n"
            "boundary: [{name: wall, mirror: {axis: x, at: 0}}, {name: pull, traction: [20 Pa], face: x+}]\n" EVERY_STEP
            "probes: [exact: step bar, spall, break, tip, point: {at: [0.5]}, momentum]\n"},
    PASSING,
    {"growing",
     "space: plane strain\nthickness: 1 mm\nduration: 2 us\nmethod: pd\nmodel: ospd\n"
     "material: {young: 75 GPa, poisson: 0.286, density: 2456}\nbody: {box: {from: [0, -10 mm], to: [24 mm, 10 mm]}}\n"
     "particles: {spacing: 1 mm, horizon: 3}\ntime: {step: 40 ns}\ncracks: [{from: [-1 mm, 0], to: [12 mm, 0]}]\n"
     "growth: [{at: [12 mm, 0], direction: [1, 0], speed: 2000 m/s, start: 0.5 us}]\n"
     "boundary: [{name: top, traction: [0, 1 MPa], face: y+}, {name: bottom, traction: [0, -1 MPa], face: "
     "y-}]\n" EVERY_STEP "probes: [sif: {outer: 8 mm, contours: [6 mm, 8 mm]}, growth]\n"},
    {"contact",
     "space: plane stress\nthickness: 1 mm\nduration: 20 us\nmaterials:\n"
     "  - {name: steel, young: 200 GPa, density: 7800, yield_stress: 400 MPa, yield_tangent: 2 GPa}\n"
     "  - {name: glass, young: 72 GPa, density: 2440, energy_release_rate: 10}\nbodies:\n"
     "  - {name: ball, material: steel, shape: {disc: {centre: [0, 14 mm], radius: 4 mm}}, velocity: [0, -100]}\n"
     "  - {name: plate, material: glass, shape: {box: {from: [-10 mm, 0], to: [10 mm, 10 mm]}}}\n"
     "particles: {spacing: 1 mm, irregularity: 0.2, seed: 7}\nmpm: {transfer: apic}\ntime: {step: 0.2 us}\n"
     "boundary: [{name: floor, fixed: [y], region: {box: {from: [-20 mm, 0], to: [20 mm, 1 mm]}}}]\n" EVERY_STEP
     "probes: [tip, break, energy, momentum, reaction: {boundary: floor}, point: {at: [0, 5 mm]}]\n"},
    {"turning",
     "space: plane stress\nthickness: 1 mm\nduration: 10 us\nmethod: pd\nmodel: mospd\n"
     "material: {young: 206 GPa, poisson: 0.3, density: 2400}\nbody: {box: {from: [-8 mm, -8 mm], to: [8 mm, 8 mm]}}\n"
     "particles: {spacing: 1 mm}\ntime: {step: 0.1 us}\ninitial: [{velocity_gradient: [0, -1000, 1000, "
     "0]}]\n" EVERY_STEP "probes: [rigid, patch, energy]\n"},
    {"solid",
     "space: solid\nduration: 6 us\nmaterial: {young: 190 GPa, density: 7800, energy_release_rate: 500}\n"
     "body: {box: {from: [0, 0, 0], to: [12 mm, 10 mm, 4 mm]}}\nparticles: {spacing: 1 mm}\ntime: {step: 0.1 us}\n"
     "mpm: {frame: reference}\nconversion: {stress: 100 MPa}\n"
     "cracks: [{polygon: [[-1 mm, 5 mm, -1 mm], [4 mm, 5 mm, -1 mm], [4 mm, 5 mm, 5 mm], [-1 mm, 5 mm, 5 mm]]}]\n"
     "boundary:\n  - {name: top, velocity: [free, 20, free], region: {box: {from: [0, 9 mm, 0], to: [12 mm, 10 mm, 4 "
     "mm]}}}\n"
     "  - {mirror: {axis: y, at: 0}}\n" EVERY_STEP "probes: [tip, break, reaction: {boundary: top}, line: {from: [1 "
     "mm, 5 mm, 2 mm], to: [11 mm, 5 mm, 2 mm], points: 5}]\n"},
};

#endif
