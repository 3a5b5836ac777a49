/* Named rows of the long map: scenes in which an earlier version gained energy or diverged. */
#include "energy_drift.h"

/* Text of a scene: a strip with a column of bonds, loaded by a body force across its axis, a sine along the axis, for
 * 60 us. space, law, frame, coupling, nu: values of the keys space, model, mpm.frame, coupling and poisson; more:
 * further keys; end: body, particles and load. */
#define STRIP_PULLED(space, more, law, frame, coupling, nu, end)                                                       \
    "space: " space "\n" more "duration: 2 ms\nmethod: adaptive\nmodel: " law "\ncoupling: " coupling "\n"             \
    "mpm: {frame: " frame "}\nmaterial: {young: 200 GPa, poisson: " nu ", density: 7850}\n" end                        \
    "conversion: {criteria: none}\noutput: {frames: 0, samples: 1}\n"
#define PLATE_END                                                                                                      \
    "body: {box: {from: [0, 0], to: [60 mm, 10 mm]}}\nparticles: {spacing: 1 mm, horizon: 3.015}\n"                    \
    "pd: {region: {box: {from: [15 mm, -inf], to: [25 mm, inf]}}}\nboundary:\n  - body_force: [0, 1e6]\n"              \
    "    profile: {sine: {wavelength: 60 mm, origin: [-15 mm, 0], direction: [1, 0]}}\n    time: {pulse: {from: 0, "   \
    "until: 60 us}}\n"
#define SOLID_END                                                                                                      \
    "body: {box: {from: [0, 0, 0], to: [40 mm, 6 mm, 6 mm]}}\nparticles: {spacing: 1 mm, horizon: 2.015}\n"            \
    "pd: {region: {box: {from: [10 mm, -inf, -inf], to: [16 mm, inf, inf]}}}\nboundary:\n  - body_force: [0, 1e6, "    \
    "0]\n"                                                                                                             \
    "    profile: {sine: {wavelength: 40 mm, origin: [-10 mm, 0, 0], direction: [1, 0, 0]}}\n    time: {pulse: "       \
    "{from: 0, until: 60 us}}\n"
#define PLATE(law, frame, coupling, nu)                                                                                \
    STRIP_PULLED("plane stress", "thickness: 1 mm\n", law, frame, coupling, nu, PLATE_END)
#define STRAINED(law, frame, coupling, nu)                                                                             \
    STRIP_PULLED("plane strain", "thickness: 1 mm\n", law, frame, coupling, nu, PLATE_END)
#define SOLID(law, frame, coupling, nu) STRIP_PULLED("solid", "", law, frame, coupling, nu, SOLID_END)

/* Text of a scene: a plate with a square of bonds in its middle, initially stretched and rotating. The arguments are
 * values of keys; more: further keys. */
#define SQUARE_TURNED(transfer, shape, coupling, more)                                                                 \
    "space: plane stress\nthickness: 1 mm\nduration: 5 ms\nmethod: adaptive\ncoupling: " coupling "\n"                 \
    "mpm: {frame: current, transfer: " transfer ", shape: " shape "}\n"                                                \
    "material: {young: 200 GPa, poisson: 1/3, density: 7850}\nbody: {box: {from: [0, 0], to: [20 mm, 20 mm]}}\n"       \
    "particles: {spacing: 1 mm}\npd: {region: {box: {from: [5 mm, 5 mm], to: [15 mm, 15 mm]}}}\n"                      \
    "initial: [{velocity_gradient: [[10, 3], [0, -7]], centre: [10 mm, 10 mm]}]\nconversion: {criteria: none}\n"       \
    "output: {frames: 0, samples: 1}\n" more

/* Text of a scene: a clamped beam under a body force for the first 1.2 ms. more: its particles and further keys. */
#define BEAM(method, model, nu, more)                                                                                  \
    "space: plane stress\nthickness: 1 mm\nduration: 10 ms\nmethod: " method "\nmodel: " model "\n"                    \
    "material: {young: 200 GPa, poisson: " nu ", density: 7850}\n"                                                     \
    "body: {box: {from: [0, -5 mm], to: [100 mm, 5 mm]}}\n" more                                                       \
    "boundary:\n  - {mirror: {axis: x, at: 0, tangential: held}}\n"                                                    \
    "  - {body_force: [0, 1e4], time: {step: {until: 1.2 ms}}}\noutput: {frames: 0, samples: 1}\n"

/* Text of a scene: a disc with a bore and a slot from its rim that makes one revolution. */
#define DISC_TURNED(frame, model)                                                                                      \
    "space: plane stress\nthickness: 1 mm\nduration: 2.5133 ms\nmethod: adaptive\nmodel: " model "\n"                  \
    "mpm: {frame: " frame                                                                                              \
    "}\nmaterial: {young: 70 GPa, poisson: 1/3, density: 2700, energy_release_rate: 10 kJ/m^2}\n"                      \
    "body:\n  - disc: {centre: [0, 0], radius: 20 mm}\n  - subtract: {disc: {centre: [0, 0], radius: 4 mm}}\n"         \
    "particles: {spacing: 0.5 mm}\ncracks:\n  - {from: [20.5 mm, 0], to: [12 mm, 0]}\n"                                \
    "initial: [{velocity_gradient: [[0, -2500], [2500, 0]]}]\noutput: {frames: 0, samples: 1}\n"

/* Text of a scene: a disc with a core of bonds that makes four revolutions at 5000 rad/s. */
#define CORE_TURNED(transfer, model, coupling)                                                                         \
    "space: plane stress\nthickness: 1 mm\nduration: 5.02655 ms\nmethod: adaptive\nmodel: " model                      \
    "\ncoupling: " coupling "\n"                                                                                       \
    "mpm: {frame: current, transfer: " transfer "}\nmaterial: {young: 72 GPa, poisson: 1/3, density: 7850}\n"          \
    "body: {disc: {centre: [0, 0], radius: 10 mm}}\nparticles: {spacing: 1 mm}\npd: {region: {disc: {centre: [0, 0], " \
    "radius: 4 mm}}}\n"                                                                                                \
    "conversion: {criteria: none}\ninitial: [{velocity_gradient: [[0, -5000], [5000, 0]]}]\noutput: {frames: 0, "      \
    "samples: 1}\n"

/* Text of a scene: a strip of material points only, with nodes on its border, loaded by a body force across its
 * axis, a sine along the axis, for 60 us. */
#define STRIP_OF_POINTS(transfer)                                                                                      \
    "space: plane stress\nthickness: 1 mm\nduration: 2 ms\nmethod: mpm\n"                                              \
    "mpm: {frame: current, transfer: " transfer ", shape: gimp}\n"                                                     \
    "material: {young: 200 GPa, poisson: 1/4, density: 7850}\nbody: {box: {from: [0, 0], to: [60 mm, 10 mm]}}\n"       \
    "particles: {spacing: 1 mm}\nboundary:\n  - body_force: [0, 1e6]\n"                                                \
    "    profile: {sine: {wavelength: 60 mm, origin: [-15 mm, 0], direction: [1, 0]}}\n"                               \
    "    time: {pulse: {from: 0, until: 60 us}}\n"                                                                     \
    "output: {frames: 0, samples: 1}\n"

#define NAMED(label, scene, ...)                                                                                       \
    {                                                                                                                  \
        .group = LASTING_NAMED, .name = label, .c = {.text = scene}, .moves = true, __VA_ARGS__                        \
    }
#define SHAKEN(label, ...)                                                                                             \
    {                                                                                                                  \
        .group = LASTING_NAMED, .name = label, .c = { __VA_ARGS__ }                                                    \
    }
const struct drift_case drift_named[] = {
    NAMED("strip, mospd nu 1/4, reference", PLATE("mospd", "reference", "partial stress", "1/4")),
    NAMED("strip, mospd nu 0.45, reference", PLATE("mospd", "reference", "partial stress", "0.45")),
    NAMED("strip, mospd nu 1/4, reference, hand-shake", PLATE("mospd", "reference", "handshake", "1/4")),
    NAMED("strip, ospd nu 1/4, reference", PLATE("ospd", "reference", "partial stress", "1/4")),
    NAMED("strip, ospd nu 0.35, reference, plane strain", STRAINED("ospd", "reference", "partial stress", "0.35")),
    NAMED("strip, mospd nu 1/4, reference, plane strain", STRAINED("mospd", "reference", "partial stress", "1/4")),
    NAMED("strip, mospd nu 1/4, reference, solid", SOLID("mospd", "reference", "partial stress", "1/4")),
    NAMED("strip, bonds, reference", PLATE("bond", "reference", "partial stress", "1/3")),
    NAMED("strip, mospd nu 1/4, current", PLATE("mospd", "current", "partial stress", "1/4")),
    NAMED("square, bonds, current flip", SQUARE_TURNED("flip", "gimp", "partial stress", "")),
    NAMED("square, bonds, current flip, hand-shake", SQUARE_TURNED("flip", "gimp", "handshake", "")),
    NAMED("square, bonds, current flip, no interface damping",
          SQUARE_TURNED("flip", "gimp", "partial stress\ninterface_damping: 0", "")),
    NAMED("square, bonds, current apic", SQUARE_TURNED("apic", "gimp", "partial stress", "")),
    NAMED("clamped beam, bonds", BEAM("pd", "bond", "1/3", "particles: {spacing: 0.5 mm}\n")),
    NAMED("clamped beam, bonds, isotropic, horizon 2.015",
          BEAM("pd", "bond", "1/3", "particles: {spacing: 0.5 mm, horizon: 2.015}\npd: {weights: isotropic}\n")),
    NAMED("clamped beam, ospd nu 0.3", BEAM("pd", "ospd", "0.3", "particles: {spacing: 0.5 mm}\n")),
    NAMED("clamped beam, mospd nu 0.3", BEAM("pd", "mospd", "0.3", "particles: {spacing: 0.5 mm}\n")),
    SHAKEN("solid, apic, nu 0.49", .dim = 3, .method = "mpm", .frame = "current", .transfer = "apic", .shape = "gimp",
           .poisson = 0.49),
    SHAKEN("solid, apic, nu 0.4999", .dim = 3, .method = "mpm", .frame = "current", .transfer = "apic", .shape = "gimp",
           .poisson = 0.4999),
    SHAKEN("solid, apic, nu 0.45", .dim = 3, .method = "mpm", .frame = "current", .transfer = "apic", .shape = "gimp",
           .poisson = 0.45),
    NAMED("disc with a core of bonds, current apic", CORE_TURNED("apic", "bond", "partial stress")),
    NAMED("disc with a core of mospd, current apic", CORE_TURNED("apic", "mospd", "partial stress")),
    NAMED("disc with a core of bonds, current apic, hand-shake", CORE_TURNED("apic", "bond", "handshake")),
    NAMED("disc with a core of bonds, current flip", CORE_TURNED("flip", "bond", "partial stress")),
    NAMED("disc with a core of bonds, current flip, hand-shake", CORE_TURNED("flip", "bond", "handshake")),
    NAMED("strip of points, apic", STRIP_OF_POINTS("apic")),
    NAMED("strip of points, flip", STRIP_OF_POINTS("flip")),
    NAMED("slotted disc, bonds, current flip", DISC_TURNED("current", "bond"), .converts = true),
    NAMED("slotted disc, bonds, reference", DISC_TURNED("reference", "bond"), .converts = true),
    NAMED("slotted disc, mospd, reference", DISC_TURNED("reference", "mospd"), .converts = true),
};
const int drift_named_count = COUNT_OF(drift_named);
