/* Scenes whose results are known in closed form. The texts leave out method and spacing. */
#include "uncertainty.h"

/* A bar of 20 mm (E = 200 GPa, rho = 8000, c = 5000 m/s) under a sudden traction of 100 MPa on its end for 3 us, in
 * which the front travels 15 mm. d'Alembert: work sigma^2 A c t/E, half of it kinetic, half strain energy. */
static const char bar_step[] = "space: line\nduration: 3 us\nmaterial: {young: 200 GPa, density: 8000}\n"
                               "body: {box: {from: [0], to: [20 mm]}}\n"
                               "boundary: [{traction: [100 MPa], face: x+}]\n";

/* A layer in plane strain, nu = 1/4, between two mirrors under the same traction, with rho c_p^2 = 240 GPa in place of
 * E. */
static const char layer_step[] =
    "space: plane strain\nthickness: 1 mm\nduration: 3 us\nmaterial: {young: 200 GPa, poisson: 1/4, density: 8000}\n"
    "body: {box: {from: [0, 0], to: [20 mm, 4 mm]}}\n"
    "boundary: [{traction: [100 MPa, 0], face: x+}, {mirror: {axis: y, at: 0}}, {mirror: {axis: y, at: 4 mm}}]\n";

/* A smooth pulse v = V exp(-(4 xi/w)^2) that travels along a bar: its kinetic and its strain energy are constant, rho A
 * V^2 (w/4) sqrt(pi/2)/2 each. V = 1 m/s, w = 10 mm. */
static const char bar_pulse[] = "space: line\nduration: 6 us\nmaterial: {young: 200 GPa, density: 8000}\n"
                                "body: {box: {from: [0], to: [80 mm]}}\n"
                                "initial: [{pulse: {at: [20 mm], direction: [1], width: 10 mm, velocity: 1 m/s}}]\n";

/* The bar of `cleave bench accuracy`: a flyer of 0.2 m hits a bar of 1 m; the tail of its pulse meets the reflected
 * head at 0.2 m after 1.2 transit times, 12 ms. */
static const char spall[] =
    "space: line\nduration: 14 ms\nmaterial: {young: 1e4, density: 1, critical_stretch: 7.9e-6}\n"
    "body: {box: {from: [0], to: [1.2]}}\n"
    "initial: [{velocity: [-2e-3], region: {box: {from: [1], to: [1.2]}}}]\nprobes: [spall]\n";

/* Manufactured solution, sin^2 in time and sine in space: the norm of the displacement error converges to 0. */
static const char manufactured[] =
    "space: line\nduration: 2.8 ms\nmaterial: {young: 1e4, density: 1, critical_stretch: inf}\n"
    "body: {box: {from: [0], to: [1]}}\nboundary:\n  - {mirror: {axis: x, at: 0}}\n  - {mirror: {axis: x, at: 1}}\n"
    "  - {body_force: [0.0402840995963], profile: {sine: {wavelength: 1}}}\n"
    "  - {body_force: [-0.0410897815882], profile: {sine: {wavelength: 1}}, time: {pulse: {until: 7 ms}}}\n"
    "probes: [exact: {form: manufactured, amplitude: 1e-7, period: 7 ms, wavelength: 1, origin: 0}]\n";

/* A plate under tension of 1 MPa at both ends: strain energy sigma^2 V/(2 E). */
static const char plate[] =
    "space: plane stress\nthickness: 1 mm\nduration: 1 s\nsolver: cg\n"
    "material: {young: 200 GPa, poisson: 1/3, density: 7850}\nbody: {box: {from: [0, 0], to: [20 mm, 10 mm]}}\n"
    "boundary: [{traction: [1 MPa, 0], face: x+}, {traction: [-1 MPa, 0], face: x-}]\n";

/* Edge crack of inputs/edge_crack_k1.yaml, a/W = 1/2, H = W: K_I = 3.009 sigma sqrt(pi a) (boundary collocation). */
static const char edge_crack[] =
    "space: plane stress\nthickness: 1 mm\nduration: 1 s\nsolver: cg\n"
    "material: {young: 200 GPa, poisson: 1/3, density: 7850}\nbody: {box: {from: [0, 0], to: [10 mm, 10 mm]}}\n"
    "cracks: [{from: [-1 mm, 5 mm], to: [5 mm, 5 mm]}]\nprobes: [sif: {contours: [2 mm]}]\n"
    "boundary: [{traction: [0, 1 MPa], face: y+}, {traction: [0, -1 MPa], face: y-}]\n";

/* Crack of inputs/inclined_crack.yaml, 45 degrees, 2 a = 6 mm: K_I and K_II over sigma sqrt(pi a) are 0.6612 and
 * 0.5674. */
static const char inclined_crack[] =
    "space: plane stress\nthickness: 1 mm\nduration: 1 s\nsolver: cg\n"
    "material: {young: 200 GPa, poisson: 1/3, density: 7850}\nbody: {box: {from: [0, 0], to: [20 mm, 10 mm]}}\n"
    "cracks: [{from: [7.878680 mm, 2.878680 mm], to: [12.121320 mm, 7.121320 mm]}]\n"
    "probes: [sif: {at: [12.121320 mm, 7.121320 mm], contours: [2 mm]}]\n"
    "boundary: [{traction: [1 MPa, 0], face: x+}, {traction: [-1 MPa, 0], face: x-}]\n";

/* The suddenly loaded stationary crack of `cleave bench accuracy`, at 9 us. Waves with a total stress of 2 MPa travel
 * 20 mm at c_p = 6078.9 m/s; t = 5.710 us later K_I = 2 sigma/(1 - nu) sqrt(c_p t (1 - 2 nu)/pi) = 0.3964 MPa m^0.5
 * (Freund 1990). */
static const char sudden[] =
    "space: plane strain\nthickness: 1 mm\nduration: 9 us\n"
    "material: {young: 75.629 GPa, poisson: 1/4, density: 2456 kg/m^3}\n"
    "body: {box: {from: [0, -20 mm], to: [60 mm, 20 mm]}}\ncracks: [{from: [-1 mm, 0], to: [30 mm, 0]}]\n"
    "boundary: [{mirror: {axis: x, at: 0}}, {mirror: {axis: x, at: 60 mm}}, {traction: [0, 1 MPa], face: y+}, "
    "{traction: [0, -1 MPa], face: y-}]\nprobes: [sif: {contours: [8 mm]}]\n";

/* A cube under tension at two faces: energy sigma^2 V/(2 E). */
static const char cube[] =
    "space: solid\nduration: 1 s\nsolver: cg\nmaterial: {young: 200 GPa, poisson: 1/4, density: 7850}\n"
    "body: {box: {from: [0, 0, 0], to: [10 mm, 10 mm, 10 mm]}}\n"
    "boundary: [{traction: [1 MPa, 0, 0], face: x+}, {traction: [-1 MPa, 0, 0], face: x-}]\n";

#define PD                                                                                                             \
    {                                                                                                                  \
        "pd", "method: pd\n"                                                                                           \
    }
#define PD_SHORT                                                                                                       \
    {                                                                                                                  \
        "pd, horizon 2.015", "method: pd\n@2.015"                                                                      \
    }
#define PD_PLAIN                                                                                                       \
    {                                                                                                                  \
        "pd, surface none", "method: pd\npd: {surface: none}\n"                                                        \
    }
#define OSPD                                                                                                           \
    {                                                                                                                  \
        "ospd", "method: pd\nmodel: ospd\n"                                                                            \
    }
#define MOSPD                                                                                                          \
    {                                                                                                                  \
        "mospd", "method: pd\nmodel: mospd\n"                                                                          \
    }
#define MESH                                                                                                           \
    {                                                                                                                  \
        "mpm reference", "method: mpm\nmpm: {frame: reference}\n"                                                      \
    }
#define GIMP                                                                                                           \
    {                                                                                                                  \
        "mpm gimp flip", "method: mpm\nmpm: {frame: current, transfer: flip}\n"                                        \
    }
#define ADAPTIVE                                                                                                       \
    {                                                                                                                  \
        "adaptive", "method: adaptive\n"                                                                               \
    }

const struct known_scene known_scenes[] = {
    {"bar, step",
     bar_step,
     {{"energy.external_work", 750}, {"energy.kinetic", 375}, {"energy.strain", 375}},
     {PD, PD_SHORT, MESH, GIMP},
     {"0.4 mm", "0.1 mm"},
     true},
    {"layer, step",
     layer_step,
     {{"energy.external_work", 0.0025 * 1.0954451150103321},
      {"energy.kinetic", 0.00125 * 1.0954451150103321},
      {"energy.strain", 0.00125 * 1.0954451150103321}},
     {PD, OSPD, MESH},
     {"0.25 mm"},
     false},
    {"bar, pulse",
     bar_pulse,
     {{"energy.kinetic", 12.533141373155}, {"energy.strain", 12.533141373155}},
     {PD, PD_SHORT, MESH, GIMP},
     {"0.4 mm", "0.1 mm"},
     true},
    {"bar, spall",
     spall,
     {{"probes.spall.time", 12e-3}, {"probes.spall.position", 0.2}},
     {PD, PD_SHORT, {"adaptive, alpha 0.5", "method: adaptive\nconversion: {alpha: 0.5}\n"}},
     {"5 mm", "1.25 mm"},
     true},
    {"bar, manufactured",
     manufactured,
     {{"probes.exact.L2_displacement", 0}},
     {PD, MESH, GIMP},
     {"10 mm", "5 mm"},
     true},
    {"plate, pulled", plate, {{"energy.strain", 5e-7}}, {PD, PD_PLAIN, OSPD, MOSPD}, {"0.5 mm", "0.25 mm"}, true},
    {"cube, pulled", cube, {{"energy.strain", 2.5e-6}}, {PD_PLAIN}, {"0.5 mm"}, false},
    {"edge crack", edge_crack, {{"probes.sif.K_I", 377130}}, {PD, OSPD, MOSPD}, {"0.1 mm"}, false},
    {"inclined crack",
     inclined_crack,
     {{"probes.sif.K_I", 64190}, {"probes.sif.K_II", -55084}},
     {PD, OSPD, MOSPD},
     {"0.1 mm"},
     false},
    {"sudden crack", sudden, {{"probes.sif.K_I", 396403}}, {PD, OSPD, ADAPTIVE}, {"0.5 mm"}, false},
};
const int known_scenes_n = COUNT_OF(known_scenes);
