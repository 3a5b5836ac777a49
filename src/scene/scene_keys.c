/* Defines the table of keys of a scene: meaning, unit, range and default of each. Reading, echo and help use this
 * table. */
#include "scene_internal.h"
#include "scene_shapes.h"

#include <math.h>

#include "output/output.h"

/* Macros for the rows of the table of keys. AT: the value is stored in `member` of the structure s; NOWHERE: it is not
 * stored; FLAG: member that becomes true if the key is given. Ranges of the value v: ANY; ABOVE: v > a; FROM: v >= a;
 * BETWEEN: a <= v <= b; INSIDE: a < v <= b. REQUIRED, NONE: the key must be given; it has no default. KEY: one row. */
#define NOWHERE .place = 0
#define AT(s, member) .place = 1 + offsetof(struct s, member), .size = sizeof(((struct s *)0)->member)
#define FLAG(s, member) 1 + offsetof(struct s, member)
#define ANY                                                                                                            \
    {                                                                                                                  \
        0, 0, false, false                                                                                             \
    }
#define ABOVE(a)                                                                                                       \
    {                                                                                                                  \
        a, INFINITY, true, true                                                                                        \
    }
#define FROM(a)                                                                                                        \
    {                                                                                                                  \
        a, INFINITY, false, true                                                                                       \
    }
#define BETWEEN(a, b)                                                                                                  \
    {                                                                                                                  \
        a, b, false, true                                                                                              \
    }
#define INSIDE(a, b)                                                                                                   \
    {                                                                                                                  \
        a, b, true, true                                                                                               \
    } /* a itself is excluded */
#define REQUIRED "required"
#define NONE "-"
#define KEY(path_, type_, unit_, place_, range_, fallback_, help_, ...)                                                \
    {                                                                                                                  \
        .path = path_, .type = type_, .unit = unit_, place_, .range = range_, .fallback = fallback_, .help = help_,    \
        __VA_ARGS__                                                                                                    \
    }

/* Table of all keys of scenes: path, type, unit, position of the value in the structure of its group, range, default,
 * help; then fields that only some keys have. */
const struct key keys[] = {
    KEY("name", KEY_NAME, UNIT_NONE, AT(scene, name), ANY, "(the file's name)", "names the run and its results folder"),
    KEY("include", KEY_HAND, UNIT_NONE, NOWHERE, BETWEEN(1, 64), NONE,
        "scenes that this one changes: its mappings of keys are merged into theirs, its other values replace theirs, "
        "and an empty value removes a key; their names are not used; files are searched in the folder of the scene "
        "that names them",
        .words = "file name or list of them"),
    KEY("variables", KEY_HAND, UNIT_NONE, NOWHERE, BETWEEN(0, 1000), NONE,
        "quantities that every number of the scene may contain: {a: 3 mm, b: 2*a + 1 mm}", .words = "mapping of names"),
    KEY("space", KEY_CHOICE, UNIT_NONE, AT(scene, space), ANY, REQUIRED, "dimension and plane state",
        .words = "line|plane stress|plane strain|solid"),
    KEY("thickness", KEY_REAL, UNIT_LENGTH, AT(scene, thickness), ABOVE(0), "(required in plane spaces)",
        "out of the plane; plane stress and plane strain only"),
    KEY("section", KEY_REAL, UNIT_AREA, AT(scene, section), ABOVE(0), "1 m^2", "cross-section of a bar; line only"),
    KEY("duration", KEY_REAL, UNIT_TIME, AT(scene, duration), ABOVE(0), REQUIRED, "simulated time"),
    KEY("gravity", KEY_POINT, UNIT_ACCELERATION, AT(scene, gravity), ANY, "(0)",
        "acceleration of every particle and of rigid bodies that fly"),
    KEY("damping", KEY_REAL, UNIT_RATE, AT(scene, damping), FROM(0), "0 1/s",
        "c of the force -c m v on every particle (alpha of Rayleigh's damping): vibrations die out as exp(-c t/2)"),
    KEY("method", KEY_CHOICE, UNIT_NONE, AT(scene, method), ANY, "adaptive",
        "peridynamics, material points, or material points that become peridynamic where the material breaks; auto: "
        "pilot runs choose one of these, the model and the spacing, by accuracy",
        .words = "pd|mpm|adaptive|auto"),
    KEY("model", KEY_CHOICE, UNIT_NONE, AT(scene, model), ANY, "bond",
        "peridynamic law: bond-based; ordinary state-based; state-based with rotations (both: any Poisson's ratio)",
        .words = "bond|ospd|mospd"),
    KEY("solver", KEY_CHOICE, UNIT_NONE, AT(scene, solver), ANY, "explicit",
        "explicit: steps in time; relaxation, cg: the static equilibrium under the loads and supports at the end of "
        "the duration, by adaptive dynamic relaxation or (method pd, small strains) conjugate gradients; bonds do not "
        "break in it; static: load steps of the duration (steps), in which bonds break and equilibrium is found again; "
        "with method auto: relaxation or cg, whichever is cheaper",
        .words = "explicit|relaxation|cg|static"),
    KEY("solver_tolerance", KEY_REAL, UNIT_NONE, AT(scene, solver_tolerance), BETWEEN(1e-12, 0.1), "1e-5",
        "largest residual force over the applied force or the reactions (relaxation, cg, static)"),
    KEY("solver_steps", KEY_INT, UNIT_NONE, AT(scene, solver_steps), BETWEEN(1, 1000000000), "200000",
        "largest number of iterations (relaxation, cg); a run that needs more fails"),
    KEY("steps", KEY_MAP, UNIT_NONE, NOWHERE, ANY, NONE,
        "load steps of solver static: loads and supports are functions of a pseudo-time from 0 to duration"),
    KEY("steps.number", KEY_INT, UNIT_NONE, AT(scene, steps.number), BETWEEN(1, 1000000), "100",
        "number of load steps in the duration; with control energy or opening: the largest number of steps"),
    KEY("steps.control", KEY_CHOICE, UNIT_NONE, AT(scene, steps.control), ANY, "load",
        "quantity that controls a load step: load: pseudo-time; energy: pseudo-time grows until a bond reaches its "
        "limit, and decreases where the body releases more than steps.energy, so that snap-back is followed; with "
        "bonds that soften each step dissipates steps.energy; opening: the distance between two points grows evenly, "
        "and pseudo-time follows from it",
        .words = "load|energy|opening"),
    KEY("steps.path", KEY_CHOICE, UNIT_NONE, AT(scene, steps.path), ANY, "auto",
        "criterion of the crack path: bonds: the bonds with the largest ratio of stretch to critical stretch break; "
        "hoop: the tip, in space the straight front through the body, advances by two spacings in the direction of the "
        "largest hoop stress, from its stress-intensity factors, and cuts the bonds there; where no tip is left, "
        "bonds; auto: hoop where a body of one material has pre-cracks that end in it, in space with such fronts",
        .words = "auto|bonds|hoop"),
    KEY("steps.energy", KEY_REAL, UNIT_ENERGY, AT(scene, steps.energy), ABOVE(0), "auto",
        "energy of the bonds of one crack increment; auto: that of an increment of two spacings through the material "
        "or interface that it cuts; with bonds that soften: energy that a load step dissipates; auto: that of a "
        "quarter spacing of crack, in space times the shortest side of the body, in a line of a hundredth of its "
        "section",
        .words = "auto", .word_value = 0),
    KEY("steps.from", KEY_POINT, UNIT_LENGTH, AT(scene, steps.from), ANY, "(required with control opening)",
        "first of the two points between which the opening is measured: the particle nearest to it",
        .has = FLAG(scene, steps.has_from)),
    KEY("steps.to", KEY_POINT, UNIT_LENGTH, AT(scene, steps.to), ANY, "(required with control opening)",
        "the other one", .has = FLAG(scene, steps.has_to)),
    KEY("steps.opening", KEY_REAL, UNIT_LENGTH, AT(scene, steps.opening), ABOVE(0), "(required with control opening)",
        "increase of the distance between the two points in all steps together", .words = "none", .word_value = 0),
    KEY("steps.then", KEY_CHOICE, UNIT_NONE, AT(scene, steps.then), ANY, "equilibrium",
        "control load: what follows a crack increment after which the crack grows further under the same loads: the "
        "next equilibrium; explicit: the body moves in time until it is at rest, then load steps continue",
        .words = "equilibrium|explicit"),
    KEY("steps.breaks", KEY_INT, UNIT_NONE, AT(scene, steps.breaks), BETWEEN(1, 1000000), "8",
        "path bonds: largest number of bonds that break before the next equilibrium, in space for each spacing of the "
        "front, in descending order of stretch over critical stretch; bonds of equal ratio break together"),
    KEY("steps.within", KEY_REAL, UNIT_NONE, AT(scene, steps.within), BETWEEN(0, 1), "2 %",
        "of these bonds only those whose ratio of stretch to critical stretch is within this share of the largest"),
    KEY("accept", KEY_SET, UNIT_NONE, AT(scene, accept), ANY, "none",
        "list of warnings to silence, because the scene intends what they report; figures that look like mistakes of "
        "units: speed of waves, critical stretch, stress of loads over strength, load over Young's modulus, number of "
        "time steps, spacings that waves travel, particles across a body with a crack, density, yield stress over "
        "Young's modulus, number of times that waves cross the body, thickness over width in plane stress, energy "
        "release rate, specific heat, cracks that cannot grow, density of a rigid body, E G_c/strength^2 over the "
        "body, times of loads beside the duration; and warnings of a run: bodies that pass through each other, a "
        "coupling without energy, one point in a cell, a face driven so fast that bonds beside it break, bonds that "
        "break behind the front of a collision, a crack faster than Rayleigh waves",
        .words = ACCEPT_WORDS, .has = FLAG(scene, has_accept)),
    KEY("accuracy", KEY_HAND, UNIT_NONE, NOWHERE, ANY, "(1 % with method auto)",
        "method auto: largest error of a figure, which pilot runs estimate",
        .words = "a share, as 2 %, or {of: figure, within: share, budget: time}"),
    KEY("accuracy.of", KEY_HAND, UNIT_NONE, NOWHERE, ANY, "(first probe, start of cracks or an energy)",
        "figure of summary.json, its names joined by points", .words = "name, as crack.start_time"),
    KEY("accuracy.within", KEY_REAL, UNIT_NONE, NOWHERE, INSIDE(0, 0.5), "1 %", "largest error of the figure (95 %)"),
    KEY("accuracy.budget", KEY_REAL, UNIT_TIME, NOWHERE, ABOVE(0), "5 min", "time for pilot runs"),

#include "scene_keys_materials.h"

    KEY("regions", KEY_HAND, UNIT_NONE, NOWHERE, ANY, NONE,
        "named solids, used by name wherever solids are read, as region: grip", .words = "mapping of names to solids"),
    KEY("sections", KEY_HAND, UNIT_NONE, NOWHERE, ANY, NONE,
        "shapes of the plane, called by name as the shape of extrude; space solid only",
        .words = "mapping of names to solids of the plane"),
    KEY("body", KEY_HAND, UNIT_NONE, NOWHERE, ANY, "(required, or bodies)",
        "shape of the one body, which is then called body", .words = "solid or list of solids"),
    KEY("parts", KEY_LIST, UNIT_NONE, NOWHERE, BETWEEN(1, 10000), NONE,
        "regions of the one body that are of another material than the first, as bodies.parts"),
#include "scene_keys_bodies.h"
    KEY("interfaces", KEY_LIST, UNIT_NONE, NOWHERE, BETWEEN(0, 1000), NONE,
        "interfaces between two bodies, method pd or mpm; bodies without an interface interact by contact"),
    KEY("interfaces.bodies", KEY_HAND, UNIT_NONE, NOWHERE, ANY, REQUIRED, "which two", .words = "list of two names"),
    KEY("interfaces.joined", KEY_FLAG, UNIT_NONE, AT(scene_interface, joined), ANY, "true",
        "bonds go from one to the other where they touch: one body of two materials, the first one's number in frames"),
    KEY("interfaces.energy_release_rate", KEY_REAL, UNIT_SURFACE_ENERGY, AT(scene_interface, energy_release_rate),
        ABOVE(0), "(that of the weaker material)", "critical energy release rate of the interface"),

#include "scene_keys_solids.h"

    KEY("particles", KEY_MAP, UNIT_NONE, NOWHERE, ANY, REQUIRED, "discretisation"),
    KEY("particles.spacing", KEY_REAL, UNIT_LENGTH, AT(scene, spacing), ABOVE(0), REQUIRED, "distance of the lattice"),
    KEY("particles.horizon", KEY_REAL, UNIT_NONE, AT(scene, horizon), BETWEEN(1, 10.5), "3.015",
        "reach of bonds, in spacings", .low = "is smaller than one spacing; 3.015 is usual"),
    KEY("particles.irregularity", KEY_REAL, UNIT_NONE, AT(scene, irregularity), BETWEEN(0, 1), "0",
        "each component is shifted by spacing x this x a random number in [-1/2, 1/2]"),
    KEY("particles.seed", KEY_SEED, UNIT_NONE, AT(scene, seed), ANY, "1", "of the random numbers"),

    KEY("pd", KEY_MAP, UNIT_NONE, NOWHERE, ANY, NONE, "peridynamics"),
    KEY("pd.volume", KEY_CHOICE, UNIT_NONE, AT(scene, volume), ANY, "whole",
        "volume share of neighbours at the edge of the horizon", .words = "whole|ramp|cut-ramp"),
    KEY("pd.calibration", KEY_CHOICE, UNIT_NONE, AT(scene, calibration), ANY, "lattice",
        "what determines the stiffness of bonds: a full neighbourhood on the lattice (exact), the continuum integral "
        "or vmpd "
        "(not exact, least of all with influence inverse square)",
        .words = "lattice|continuum|vmpd"),
    KEY("pd.surface", KEY_CHOICE, UNIT_NONE, AT(scene, surface), ANY,
        "(moments with method pd; volume in load steps of bonds that break)",
        "weights of bonds near faces: moments: from moments of neighbourhoods, with which thin bodies bend, twist and "
        "stretch correctly (lattices only); volume: from the volume of neighbours",
        .words = "none|volume|moments"),
    KEY("pd.weights", KEY_CHOICE, UNIT_NONE, AT(scene, shells), ANY, "(isotropic; calibration not lattice: uniform)",
        "isotropic: two weights of shells of neighbours remove the anisotropy of the lattice",
        .words = "uniform|isotropic"),
    KEY("pd.influence", KEY_CHOICE, UNIT_NONE, AT(scene, influence), ANY, "(inverse with ospd and mospd, else one)",
        "weight of a bond by its length: 1, exp(-(r/delta)^2), delta/r, (delta/r)^2, 1 - r/(delta + spacing)",
        .words = "one|gaussian|inverse|inverse square|linear"),
    KEY("pd.normalisation", KEY_CHOICE, UNIT_NONE, AT(scene, bulk), ANY,
        "(bulk with mospd and irregularity 0, and with pd.surface moments, else local)",
        "ospd and mospd: constants from the neighbourhood that a particle has (local), or from a full neighbourhood "
        "(bulk)",
        .words = "local|bulk"),
    KEY("pd.last_force", KEY_CHOICE, UNIT_NONE, AT(scene, last_force), ANY, "moment",
        "last force of a bond that breaks: it acts until the moment, within a step, at which its stretch is critical; "
        "or half of it, the whole of it (as in other programs) or none acts in the first step after that",
        .words = "moment|half|whole|none"),
    KEY("pd.region", KEY_REGION, UNIT_NONE, AT(scene, pd_region), ANY, NONE,
        "peridynamic from the start (method adaptive)", .has = FLAG(scene, has_pd_region)),

    KEY("contact", KEY_MAP, UNIT_NONE, NOWHERE, ANY, NONE, "forces between particles that no bond joins"),
    KEY("contact.between", KEY_CHOICE, UNIT_NONE, AT(scene, contact_between), ANY,
        "(all where bonds may break, with cracks, several bodies or rigid ones; else none)",
        "peridynamic particles between which contact forces act: none, those of two bodies, or all near a face "
        "(bodies, fragments, faces of cracks)",
        .words = "none|bodies|all"),
    KEY("contact.law", KEY_CHOICE, UNIT_NONE, AT(scene, contact_form), ANY, "surface",
        "contact of smooth faces, or of pairs of particles, as in other programs, whose faces interlock like gears",
        .words = "surface|pair"),
    KEY("contact.distance", KEY_CHOICE, UNIT_NONE, AT(scene, contact_distance), ANY, "spacing",
        "contact.law: pair: a spacing, no more than in the reference state; or the rule of LAMMPS' peri/pmb, for "
        "comparison: the least of 0.9 of that and 1.35 spacings, also between particles that a bond joins",
        .words = "spacing|lammps"),
    KEY("contact.convert", KEY_FLAG, UNIT_NONE, AT(scene, contact_convert), ANY, "true",
        "method: adaptive: material points within three spacings of another body become peridynamic, so that they have "
        "contact"),
    KEY("contact.friction", KEY_REAL, UNIT_NONE, AT(scene, contact_friction), BETWEEN(0, 100), "0",
        "coefficient of Coulomb's friction of all contact (contact.law: surface)"),
    KEY("contact.stiffness", KEY_REAL, UNIT_NONE, AT(scene, contact_stiffness), INSIDE(0, 4.001), "1",
        "stiffness of contact, relative to that of a cell of the material (15 c V^2/delta at 3.015 spacings); above 1 "
        "it may need a smaller time step"),

    KEY("mpm", KEY_MAP, UNIT_NONE, NOWHERE, ANY, NONE, "material point method"),
    KEY("mpm.cell", KEY_REAL, UNIT_NONE, AT(scene, cell), BETWEEN(1, 8), "2", "node distance of the grid, in spacings"),
    KEY("mpm.shape", KEY_CHOICE, UNIT_NONE, AT(scene, shape), ANY, "(gimp; linear with coupling pm and pmg)",
        "shape functions; a scene with this key gets the current frame", .words = "linear|gimp|cpgimp|quadratic|cubic",
        .has = FLAG(scene, has_shape)),
    KEY("mpm.transfer", KEY_CHOICE, UNIT_NONE, AT(scene, transfer), ANY, "(flip; apic with solver relaxation)",
        "transfer of velocities from grid to particles; apic not with linear; a scene with this key gets the current "
        "frame",
        .words = "flip|apic", .has = FLAG(scene, has_transfer)),
    KEY("mpm.frame", KEY_CHOICE, UNIT_NONE, AT(scene, frame), ANY, "auto",
        "configuration in which the grid is defined; reference: linear cells with their state on the nodes and "
        "material points as their quadrature, for bodies on a lattice that keep their neighbours and have no contact "
        "with others, a tenth to a thirtieth of the cost; auto: reference where the body is one piece on a regular "
        "lattice, elastic, the only one and not at rest by a solver, with mpm.cell 2 and coupling partial stress or "
        "handshake, and the scene does not give shape, transfer or interface_damping, which have no meaning then; else "
        "current (`cleave check` says why)",
        .words = "current|reference|auto"),
    KEY("mpm.strain", KEY_CHOICE, UNIT_NONE, AT(scene, small_strain), ANY, "finite",
        "frame reference: measure of strain: finite, in axes that turn with each cell; small, for small rotations only",
        .words = "finite|small"),
    KEY("mpm.constants", KEY_CHOICE, UNIT_NONE, AT(scene, lattice_constants), ANY, "isotropic",
        "frame reference: elastic constants of the material, or of its bonds on the lattice (model bond), which are "
        "not quite isotropic",
        .words = "isotropic|lattice"),
    KEY("mpm.levels", KEY_CHOICE, UNIT_NONE, AT(scene, levels), ANY, "auto",
        "frame reference: levels of coarse cells, of 4, 8, 16, 32 spacings, away from bonds, loads and high stress, "
        "each with twice the time step of the one before; 0: cells of 2 spacings everywhere; auto: as many as the size "
        "of the body and the rise of the loads allow",
        .words = "0|1|2|3|4|auto"),
    KEY("mpm.fill", KEY_CHOICE, UNIT_NONE, AT(scene, fill), ANY, "auto",
        "frame reference: particles that are created; needed: none inside coarse cells; auto: needed if coarse cells "
        "contain many particles",
        .words = "auto|all|needed"),
    KEY("mpm.origin", KEY_POINT, UNIT_LENGTH, AT(scene, grid_origin), ANY,
        "(on the first mirror across each axis, else at the first body's lower corner)", "a node of the grid",
        .has = FLAG(scene, has_grid_origin)),

    KEY("coupling", KEY_CHOICE, UNIT_NONE, AT(scene, coupling), ANY, "partial stress",
        "coupling of material points and bonds at their interfaces", .words = "partial stress|handshake|pm|pg|pmg|pgg"),

    KEY("interface_damping", KEY_REAL, UNIT_NONE, AT(scene, interface_damping), FROM(0), "0.25",
        "coupling partial stress with transfer flip: damping of motion beside peridynamic particles that the grid does "
        "not resolve, in wave speed over cell; 0: none; a scene with this key gets the current frame",
        .has = FLAG(scene, has_interface_damping)),

    KEY("conversion", KEY_MAP, UNIT_NONE, NOWHERE, ANY, NONE,
        "material point to peridynamic particle (method adaptive)"),
    KEY("conversion.stress", KEY_REAL, UNIT_PRESSURE, AT(scene, conversion.stress), ABOVE(0), "auto",
        "largest principal stress sigma_max; auto: young x critical stretch", .words = "auto", .word_value = NAN),
    KEY("conversion.alpha", KEY_REAL, UNIT_NONE, AT(scene, conversion.alpha), INSIDE(0, 1), "0.95",
        "share of this stress at which a material point converts"),
    KEY("conversion.block", KEY_FLAG, UNIT_NONE, AT(scene, conversion.block), ANY, "true",
        "neighbours of a particle within its horizon convert with it"),
    KEY("conversion.criteria", KEY_SET, UNIT_NONE, AT(scene, conversion.criteria), ANY, "([bond, stress])",
        "criteria of conversion: a broken bond, the stress; a list, or none", .words = "bond|stress"),
    KEY("conversion.tips", KEY_REAL, UNIT_NONE, AT(scene, conversion.tips), BETWEEN(0, 1000), "0",
        "radius round the ends of pre-cracks that is peridynamic from the start, in horizons; with 2 cracks start at "
        "the time of method pd"),
    KEY("conversion.notch", KEY_CHOICE, UNIT_NONE, AT(scene, conversion.notch), ANY, "auto",
        "pre-cracks in the reference frame: free surfaces of the mesh, with cut bonds within eight spacings of their "
        "ends (or within tips, if given), or cut bonds all along; auto: slit where possible (`cleave check` reports "
        "it)",
        .words = "auto|slit|bonds"),
    KEY("conversion.reversion", KEY_FLAG, UNIT_NONE, AT(scene, conversion.reverts), ANY, "false",
        "peridynamic particles become material points again where no bond within two horizons was ever broken and the "
        "stress stays low (coupling partial stress or handshake, elastic materials)"),
    KEY("conversion.hold_time", KEY_REAL, UNIT_NONE, AT(scene, conversion.hold_time), BETWEEN(1, 1e6), "5",
        "reversion: how long the stress must have been low, in horizon over wave speed; longer: fewer reversions"),
    KEY("conversion.low_stress", KEY_REAL, UNIT_NONE, AT(scene, conversion.low_stress), INSIDE(0, 0.9), "0.5",
        "reversion: limit of low stress, as a share of the stress at which points convert; lower: fewer reversions"),

    KEY("cracks", KEY_LIST, UNIT_NONE, NOWHERE, BETWEEN(0, 10000), NONE, "cracks at the start (pre-cracks)"),
    KEY("cracks.from", KEY_POINT, UNIT_LENGTH, NOWHERE, ANY, NONE, "one end of a segment (plane)"),
    KEY("cracks.to", KEY_POINT, UNIT_LENGTH, NOWHERE, ANY, NONE, "the other end"),
    KEY("cracks.at", KEY_POINT, UNIT_LENGTH, NOWHERE, ANY, NONE, "position of a cut (line)"),
    KEY("cracks.polygon", KEY_HAND, UNIT_LENGTH, NOWHERE, BETWEEN(3, 1000), NONE, "plane convex polygon (solid)",
        .words = "list of points"),
    KEY("cracks.width", KEY_REAL, UNIT_LENGTH, AT(crack, width), FROM(0), "0",
        "width of a notch: with contact.between: all its faces have contact once their distance has decreased by this "
        "width"),
    KEY("growth", KEY_LIST, UNIT_NONE, NOWHERE, BETWEEN(0, 64), NONE,
        "cracks that grow at a given speed, from the start or while the stress-intensity factors of a sif probe are "
        "large enough (plane, model with bonds)"),
    KEY("growth.name", KEY_NAME, UNIT_NONE, AT(growth_rule, name), ANY, "(growth0, growth1, ..)",
        "what probes call it"),
    KEY("growth.at", KEY_POINT, UNIT_LENGTH, AT(growth_rule, at), ANY, REQUIRED, "where the tip starts"),
    KEY("growth.direction", KEY_POINT, UNIT_NONE, AT(growth_rule, direction), ANY, REQUIRED, "of growth, any length"),
    KEY("growth.speed", KEY_REAL, UNIT_SPEED, AT(growth_rule, speed), ABOVE(0), REQUIRED,
        "speed of the tip; follow: the speed at which K_eq of its probe stays equal to toughness", .words = "follow",
        .word_value = NAN),
    KEY("growth.fastest", KEY_REAL, UNIT_SPEED, AT(growth_rule, fastest), ABOVE(0), "auto",
        "largest speed with speed: follow; auto: 0.9 of the Rayleigh speed, the upper limit", .words = "auto",
        .word_value = NAN),
    KEY("growth.start", KEY_REAL, UNIT_TIME, AT(growth_rule, start), FROM(0), "0 s", "it rests before"),
    KEY("growth.length", KEY_REAL, UNIT_LENGTH, AT(growth_rule, length), ABOVE(0), "inf", "it stops there",
        .infinite = true),
    KEY("growth.damping", KEY_REAL, UNIT_LENGTH, AT(growth_rule, damping), FROM(0), "half",
        "crack growth during which a crossed bond fades; half: half a horizon; 0: at once", .words = "half",
        .word_value = NAN),
    KEY("growth.exponent", KEY_REAL, UNIT_NONE, AT(growth_rule, exponent), ABOVE(0), "4",
        "fades as (1 - growth/damping)^exponent"),
    KEY("growth.probe", KEY_NAME, UNIT_NONE, AT(growth_rule, probe), ANY, "(none)",
        "name of the sif probe that controls it: grows while K_eq is at least toughness, towards the largest hoop "
        "stress"),
    KEY("growth.toughness", KEY_REAL, UNIT_TOUGHNESS, AT(growth_rule, toughness), FROM(0), "0 Pa m^0.5",
        "K_Ic (with probe)"),
    KEY("growth.smoothing", KEY_REAL, UNIT_LENGTH, AT(growth_rule, smoothing), FROM(0), "quarter",
        "length of growth over which the direction is averaged (with probe); quarter: of a horizon", .words = "quarter",
        .word_value = NAN),
    KEY("crack", KEY_MAP, UNIT_NONE, NOWHERE, ANY, NONE, "how crack tips are followed"),
    KEY("crack.speed_window", KEY_REAL, UNIT_TIME, AT(scene, speed_window), ABOVE(0), "(duration/10)",
        "window of the regression for a tip's speed"),

    KEY("initial", KEY_LIST, UNIT_NONE, NOWHERE, BETWEEN(0, 10000), NONE, "initial states; later entries overwrite"),
    KEY("initial.region", KEY_REGION, UNIT_NONE, AT(scene_initial, region), ANY, "(everywhere)", "where"),
    KEY("initial.body", KEY_BODY, UNIT_NONE, AT(scene_initial, body), ANY, "(any)",
        "name of the body to which it applies"),
    KEY("initial.velocity", KEY_HAND, UNIT_SPEED, NOWHERE, ANY, "(0)",
        "velocity at the centre; a formula of x, y, z: at every position", .words = "list of number or formula"),
    KEY("initial.velocity_gradient", KEY_MATRIX, UNIT_RATE, AT(scene_initial, velocity_gradient), ANY, "(0)",
        "G: v += G (X - centre)", .has = FLAG(scene_initial, sets_velocity)),
    KEY("initial.displacement_gradient", KEY_MATRIX, UNIT_NONE, AT(scene_initial, displacement_gradient), ANY, "(0)",
        "H: x = X + H (X - centre), stressed accordingly", .has = FLAG(scene_initial, sets_strain)),
    KEY("initial.pulse", KEY_PART, UNIT_NONE, NOWHERE, ANY, NONE,
        "plane wave v exp(-(4 xi/width)^2) into material at rest; added to earlier initial states"),
    KEY("initial.pulse.at", KEY_POINT, UNIT_LENGTH, AT(scene_initial, pulse.at), ANY, REQUIRED, "its centre"),
    KEY("initial.pulse.direction", KEY_POINT, UNIT_NONE, AT(scene_initial, pulse.direction), ANY, REQUIRED,
        "direction of travel, a vector of any length"),
    KEY("initial.pulse.width", KEY_REAL, UNIT_LENGTH, AT(scene_initial, pulse.width), ABOVE(0), REQUIRED,
        "four Gaussian radii"),
    KEY("initial.pulse.velocity", KEY_REAL, UNIT_SPEED, AT(scene_initial, pulse.velocity), ANY, REQUIRED,
        "largest velocity of particles, along polarisation"),
    KEY("initial.pulse.polarisation", KEY_POINT, UNIT_NONE, AT(scene_initial, pulse.polarisation), ANY, "(direction)",
        "how particles move: along direction, a longitudinal wave, or across it, a transverse one; any length"),
    KEY("initial.rotation", KEY_PART, UNIT_NONE, NOWHERE, ANY, NONE,
        "velocities of a rigid rotation, instead of velocity_gradient and centre; added to velocity"),
    KEY("initial.rotation.centre", KEY_POINT, UNIT_LENGTH, AT(scene_initial, centre), ANY, REQUIRED, "on the axis"),
    KEY("initial.rotation.axis", KEY_HAND, UNIT_NONE, NOWHERE, ANY, "(z in the plane; required in space)",
        "of any length, right-handed", .words = "list of three numbers"),
    KEY("initial.rotation.rate", KEY_HAND, UNIT_RATE, NOWHERE, ANY, REQUIRED, "angle over time [rad/s]",
        .words = "number"),
    KEY("initial.centre", KEY_POINT, UNIT_LENGTH, AT(scene_initial, centre), ANY, "(0)", "of both gradients"),

#include "scene_keys_boundary.h"

    KEY("time", KEY_MAP, UNIT_NONE, NOWHERE, ANY, NONE, "time step"),
    KEY("time.step", KEY_REAL, UNIT_TIME, AT(scene, time_step), ABOVE(0), "auto",
        "time step; auto: safety x the critical time step", .words = "auto", .word_value = 0),
    KEY("time.wall", KEY_REAL, UNIT_TIME, AT(scene, wall), ABOVE(0), "none",
        "wall clock, as 2 h or 90 min, after which the run ends with a checkpoint (exit status 130); scene.yaml leaves "
        "it out",
        .words = "none", .word_value = INFINITY, .of_process = true),
    KEY("time.active_set", KEY_FLAG, UNIT_NONE, AT(scene, active_set), ANY, "true",
        "regions still at rest are not computed; the results are the same to the last bit, false is slower"),
    KEY("time.safety", KEY_REAL, UNIT_NONE, AT(scene, safety), INSIDE(0, 2), "(0.8, or 0.5 where bonds may break)",
        "share of the critical step; above 1 shows instability"),

    KEY("output", KEY_MAP, UNIT_NONE, NOWHERE, ANY, NONE, "what is written, and how often"),
    KEY("output.frames", KEY_INT, UNIT_NONE, AT(scene, frames), BETWEEN(0, FRAMES_MOST), "20",
        "frames after the one at t = 0, evenly spread", .has = FLAG(scene, has_frames)),
    KEY("output.times", KEY_SERIES, UNIT_TIME, AT(scene, times), ABOVE(0), "(evenly spread)",
        "when frames are written, besides the one at t = 0; ascending, those beyond the duration are left out; "
        "instead of output.frames"),
    KEY("output.every", KEY_REAL, UNIT_TIME, AT(scene, every), ABOVE(0), "none",
        "time from frame to frame, instead of output.frames and output.times", .words = "none", .word_value = 0),
    KEY("output.fields", KEY_SET, UNIT_NONE, AT(scene, fields), ANY, "none",
        "what frames hold besides the standard fields (inputs/results.md): a list, all or none",
        .words = FRAME_FIELD_WORDS),
    KEY("output.regions", KEY_LIST, UNIT_NONE, NOWHERE, BETWEEN(1, SERIES_MOST), NONE,
        "regions whose particles are written more often, to frames_NAME with NAME.hdf.series"),
    KEY("output.regions.name", KEY_NAME, UNIT_NONE, AT(scene_series, name), ANY, REQUIRED, "of its files"),
    KEY("output.regions.region", KEY_REGION, UNIT_NONE, AT(scene_series, region), ANY, REQUIRED,
        "where, by reference position"),
    KEY("output.regions.every", KEY_REAL, UNIT_TIME, AT(scene_series, every), ABOVE(0), REQUIRED,
        "time from frame to frame"),
    KEY("output.regions.fields", KEY_SET, UNIT_NONE, AT(scene_series, fields), ANY, "none",
        "besides the standard fields; none: those of output.fields", .words = FRAME_FIELD_WORDS),
    KEY("output.samples", KEY_INT, UNIT_NONE, AT(scene, samples), BETWEEN(1, 10000000), "200",
        "lines of history.csv after the one at t = 0"),
    KEY("output.checkpoint", KEY_REAL, UNIT_TIME, AT(scene, checkpoint_interval), FROM(0), "auto",
        "wall clock between checkpoints; 0: after every step; auto: 60 s, longer if checkpoints would take more than 3 "
        "% of the time of the run",
        .words = "auto", .word_value = NAN),
    KEY("output.compress", KEY_FLAG, UNIT_NONE, AT(scene, compress), ANY, "false", "gzip the frames (slow)"),

    KEY("probes", KEY_LIST, UNIT_NONE, NOWHERE, BETWEEN(0, 1000), NONE,
        "quantities to measure: kinds of probes, or mappings kind: {keys}"),
    KEY("probes.tip", KEY_PART, UNIT_NONE, NOWHERE, ANY, NONE, "a crack tip: the longest, or the one nearest to at"),
    KEY("probes.tip.name", KEY_NAME, UNIT_NONE, AT(probe_request, name), ANY, "(tip)", "name in the results"),
    KEY("probes.tip.at", KEY_POINT, UNIT_LENGTH, AT(probe_request, at), ANY, "(the longest)", "near where it starts",
        .has = FLAG(probe_request, has_at)),
    KEY("probes.break", KEY_PART, UNIT_NONE, NOWHERE, ANY, NONE, "first cut bond"),
    KEY("probes.break.name", KEY_NAME, UNIT_NONE, AT(probe_request, name), ANY, "(break)", "name in the results"),
    KEY("probes.break.region", KEY_REGION, UNIT_NONE, AT(probe_request, region), ANY, "(everywhere)", "where"),
    KEY("probes.reaction", KEY_PART, UNIT_NONE, NOWHERE, ANY, NONE,
        "largest force of a support, in load steps of a load; its force over time is in history.csv without a probe"),
    KEY("probes.reaction.name", KEY_NAME, UNIT_NONE, AT(probe_request, name), ANY, "(reaction)", "name in the results"),
    KEY("probes.reaction.boundary", KEY_NAME, UNIT_NONE, AT(probe_request, boundary), ANY, REQUIRED,
        "name of a boundary condition"),
    KEY("probes.patch", KEY_PART, UNIT_NONE, NOWHERE, ANY, NONE, "nodal force residual over S h under uniform strain"),
    KEY("probes.patch.name", KEY_NAME, UNIT_NONE, AT(probe_request, name), ANY, "(patch)", "name in the results"),
    KEY("probes.patch.region", KEY_REGION, UNIT_NONE, AT(probe_request, region), ANY, "(everywhere)", "where"),
    KEY("probes.spall", KEY_PART, UNIT_NONE, NOWHERE, ANY, NONE, "separated end of a bar"),
    KEY("probes.spall.name", KEY_NAME, UNIT_NONE, AT(probe_request, name), ANY, "(spall)", "name in the results"),
    KEY("probes.point", KEY_PART, UNIT_NONE, NOWHERE, ANY, NONE, "time series of the particle nearest to a point"),
    KEY("probes.point.name", KEY_NAME, UNIT_NONE, AT(probe_request, name), ANY, "(point)", "name in the results"),
    KEY("probes.point.at", KEY_POINT, UNIT_LENGTH, AT(probe_request, at), ANY, REQUIRED, "the point",
        .has = FLAG(probe_request, has_at)),
    KEY("probes.line", KEY_PART, UNIT_NONE, NOWHERE, ANY, NONE, "profile along a line, with every frame"),
    KEY("probes.line.name", KEY_NAME, UNIT_NONE, AT(probe_request, name), ANY, "(line)", "name in the results"),
    KEY("probes.line.from", KEY_POINT, UNIT_LENGTH, AT(probe_request, from), ANY, REQUIRED, "first station"),
    KEY("probes.line.to", KEY_POINT, UNIT_LENGTH, AT(probe_request, to), ANY, REQUIRED, "last station"),
    KEY("probes.line.points", KEY_INT, UNIT_NONE, AT(probe_request, points), BETWEEN(2, 1000000), "101", "stations"),
    KEY("probes.energy", KEY_PART, UNIT_NONE, NOWHERE, ANY, NONE, "energies of the particles of a region"),
    KEY("probes.energy.name", KEY_NAME, UNIT_NONE, AT(probe_request, name), ANY, "(energy)", "name in the results"),
    KEY("probes.energy.region", KEY_REGION, UNIT_NONE, AT(probe_request, region), ANY, "(everywhere)", "where"),
    KEY("probes.momentum", KEY_PART, UNIT_NONE, NOWHERE, ANY, NONE, "momentum of the particles of a region"),
    KEY("probes.momentum.name", KEY_NAME, UNIT_NONE, AT(probe_request, name), ANY, "(momentum)", "name in the results"),
    KEY("probes.momentum.region", KEY_REGION, UNIT_NONE, AT(probe_request, region), ANY, "(everywhere)", "where"),
    KEY("probes.exact", KEY_PART, UNIT_NONE, NOWHERE, ANY, NONE,
        "a bar against a closed form (line); its profile with every frame; `exact: step bar` is enough"),
    KEY("probes.exact.name", KEY_NAME, UNIT_NONE, AT(probe_request, name), ANY, "(exact)", "name in the results"),
    KEY("probes.exact.form", KEY_CHOICE, UNIT_NONE, AT(probe_request, form), ANY, REQUIRED,
        "a traction at one end, elastic or beyond yield; initial pulses; U sin^2(pi t/T) sin(2 pi (x - origin)/lambda)",
        .words = "step bar|plastic bar|pulse|manufactured"),
    KEY("probes.exact.amplitude", KEY_REAL, UNIT_LENGTH, AT(probe_request, amplitude), ANY, NONE, "U (manufactured)"),
    KEY("probes.exact.period", KEY_REAL, UNIT_TIME, AT(probe_request, period), ABOVE(0), NONE, "T (manufactured)"),
    KEY("probes.exact.wavelength", KEY_REAL, UNIT_LENGTH, AT(probe_request, wavelength), ABOVE(0), NONE,
        "lambda (manufactured)"),
    KEY("probes.exact.origin", KEY_REAL, UNIT_LENGTH, AT(probe_request, origin), ANY, NONE,
        "where the sine is 0 (manufactured)"),
    KEY("probes.sif", KEY_PART, UNIT_NONE, NOWHERE, ANY, NONE,
        "stress-intensity factors of a crack tip by the interaction integral (plane spaces)"),
    KEY("probes.sif.name", KEY_NAME, UNIT_NONE, AT(probe_request, name), ANY, "(sif)", "name in the results"),
    KEY("probes.sif.at", KEY_POINT, UNIT_LENGTH, AT(probe_request, at), ANY,
        "(the end of the first pre-crack inside the body)", "the tip; followed where it is the end of a pre-crack",
        .has = FLAG(probe_request, has_at)),
    KEY("probes.sif.direction", KEY_POINT, UNIT_NONE, AT(probe_request, direction), ANY, "(along the crack)",
        "direction ahead of the tip, a vector of any length; required with a tip that is not the end of a pre-crack, "
        "such as the end of a gap in material points, which must be wider than two cells: across less they touch",
        .has = FLAG(probe_request, has_direction)),
    KEY("probes.sif.inner", KEY_REAL, UNIT_LENGTH, AT(probe_request, inner), ABOVE(0), "(half of outer)",
        "radius within which the weight is 1"),
    KEY("probes.sif.outer", KEY_REAL, UNIT_LENGTH, AT(probe_request, outer), ABOVE(0),
        "(the largest of contours, or 20 spacings)",
        "radius at which the weight reaches 0; the default is at least 10 spacings where the body or another tip's "
        "distance leaves no more"),
    KEY("probes.sif.contours", KEY_SERIES, UNIT_LENGTH, AT(probe_request, contours), ABOVE(0),
        "(0.6, 0.8 and 1 times outer)",
        "outer radii compared for contour_spread, the largest difference of K_I or K_II over |K| or of J over its "
        "mean: "
        "K_I, K_II and J have no value where it is above 0.2, as before waves arrive or where a crack branches within "
        "them; inner in proportion; ascending"),
    KEY("probes.sif.weight", KEY_CHOICE, UNIT_NONE, AT(probe_request, weight), ANY, "quintic",
        "from 1 to 0 between the radii: 1 - 10 z^3 + 15 z^4 - 6 z^5, 1 - 3 z^2 + 2 z^3, or 1 - z",
        .words = "quintic|cubic|linear"),
    KEY("probes.sif.gradient", KEY_CHOICE, UNIT_NONE, AT(probe_request, gradient), ANY, "mls",
        "by moving least squares or the peridynamic differential operator", .words = "mls|pddo"),
    KEY("probes.sif.reach", KEY_REAL, UNIT_NONE, AT(probe_request, reach), BETWEEN(1, 5), "1.5",
        "rho_m of the gradients, half their support, in spacings; at most half the horizon where cracks grow"),
    KEY("probes.sif.diffraction", KEY_INT, UNIT_NONE, AT(probe_request, diffraction), BETWEEN(0, 2), "0",
        "particles behind the crack count as farther away, with this exponent; 0: not at all"),
    KEY("probes.sif.stress", KEY_CHOICE, UNIT_NONE, AT(probe_request, stress), ANY, "hooke",
        "Hooke's law of the gradient, or the particles' stress", .words = "hooke|particle"),
    KEY("probes.sif.core", KEY_REAL, UNIT_LENGTH, AT(probe_request, core), FROM(0), "(1.5 horizons)",
        "radius that the inertial sum excludes while the tip moves (its weight grows from 0 to 1 between a third and "
        "five thirds of it)"),
    KEY("probes.sif.speed", KEY_REAL, UNIT_SPEED, AT(probe_request, speed), ABOVE(0), "auto",
        "direction of the tip once it moves; auto: from its growth over crack.speed_window", .words = "auto",
        .word_value = NAN),
    KEY("probes.growth", KEY_PART, UNIT_NONE, NOWHERE, ANY, NONE,
        "a crack with prescribed or SIF-controlled growth: position and length of its tip, angle of its path"),
    KEY("probes.growth.name", KEY_NAME, UNIT_NONE, AT(probe_request, name), ANY, "(growth)", "name in the results"),
    KEY("probes.growth.of", KEY_NAME, UNIT_NONE, AT(probe_request, of), ANY, "(the first)", "name of the growth"),
    KEY("probes.growth.experiment", KEY_REAL, UNIT_NONE, AT(probe_request, experiment), BETWEEN(0, 180), NONE,
        "angle of the path in an experiment [degree], drawn beside it in pictures"),
    KEY("probes.pulse", KEY_PART, UNIT_NONE, NOWHERE, ANY, NONE,
        "wave packet at an interface, beside a run of the same scene with method mpm at the end"),
    KEY("probes.pulse.name", KEY_NAME, UNIT_NONE, AT(probe_request, name), ANY, "(pulse)", "name in the results"),
    KEY("probes.pulse.at", KEY_POINT, UNIT_LENGTH, AT(probe_request, at), ANY, REQUIRED, "a point of the interface",
        .has = FLAG(probe_request, has_at)),
    KEY("probes.pulse.direction", KEY_POINT, UNIT_NONE, AT(probe_request, direction), ANY, "(x)",
        "normal of the interface, away from where the packet comes from"),
    KEY("probes.rigid", KEY_PART, UNIT_NONE, NOWHERE, ANY, NONE,
        "a body that turns as a whole: angle, stresses, angular momentum and kinetic energy (plane spaces)"),
    KEY("probes.rigid.name", KEY_NAME, UNIT_NONE, AT(probe_request, name), ANY, "(rigid)", "name in the results"),
    KEY("probes.rigid.region", KEY_REGION, UNIT_NONE, AT(probe_request, region), ANY, "(everywhere)", "where"),
};
const int keys_count = COUNT_OF(keys);
