/* The table of keys of a scene: what each sets, its unit, range and default. Reading, echo and help use this table. */
#include "scene_internal.h"

#include <math.h>
#include <string.h>

#define NOWHERE .place = 0
#define AT(s, member) .place = 1 + offsetof(struct s, member), .size = sizeof(((struct s *)0)->member)
#define FLAG(s, member) 1 + offsetof(struct s, member)
#define ANY {0, 0, false, false}
#define ABOVE(a) {a, INFINITY, true, true}
#define FROM(a) {a, INFINITY, false, true}
#define BETWEEN(a, b) {a, b, false, true}
#define INSIDE(a, b) {a, b, true, true}      /* a itself is outside */
#define REQUIRED "required"
#define NONE "-"
#define KEY(path_, type_, unit_, place_, range_, fallback_, help_, ...)                                                \
    {.path = path_, .type = type_, .unit = unit_, place_, .range = range_, .fallback = fallback_, .help = help_,       \
     __VA_ARGS__}

/* path, type, unit, place in its group's struct, range, default, help; then fields that only some keys have. */
const struct key keys[] = {
    KEY("name", KEY_NAME, UNIT_NONE, AT(scene, name), ANY, "(the file's name)", "names the run and its results folder"),
    KEY("space", KEY_CHOICE, UNIT_NONE, AT(scene, space), ANY, REQUIRED, "dimension and plane state",
        .words = "line|plane stress|plane strain|solid"),
    KEY("thickness", KEY_REAL, UNIT_LENGTH, AT(scene, thickness), ABOVE(0), "(required in plane spaces)",
        "out of the plane; plane stress and plane strain only"),
    KEY("section", KEY_REAL, UNIT_AREA, AT(scene, section), ABOVE(0), "1 m^2", "cross-section of a bar; line only"),
    KEY("duration", KEY_REAL, UNIT_TIME, AT(scene, duration), ABOVE(0), REQUIRED, "simulated time"),
    KEY("method", KEY_CHOICE, UNIT_NONE, AT(scene, method), ANY, "adaptive",
        "peridynamics, material points, or material points that become peridynamic where the material breaks; auto: "
        "these and spacing, horizon, shape, coupling and step from the cost-accuracy table, by accuracy",
        .words = "pd|mpm|adaptive|auto"),
    KEY("model", KEY_CHOICE, UNIT_NONE, AT(scene, model), ANY, "bond",
        "peridynamic law: bond-based; ordinary state-based; state-based with rotations (both: any Poisson's ratio)",
        .words = "bond|ospd|mospd"),
    KEY("solver", KEY_CHOICE, UNIT_NONE, AT(scene, solver), ANY, "explicit",
        "explicit: steps in time; relaxation, cg: the static equilibrium under the loads at the end of the duration, "
        "with supports where they have then moved to, by adaptive dynamic relaxation or (method pd, small strains) "
        "conjugate gradients; bonds do not break in it; static (method auto): one of these, whichever is cheapest",
        .words = "explicit|relaxation|cg|static"),
    KEY("solver_tolerance", KEY_REAL, UNIT_NONE, AT(scene, solver_tolerance), BETWEEN(1e-12, 0.1), "1e-5",
        "largest residual force over the applied force or the reactions (relaxation, cg)"),
    KEY("solver_steps", KEY_INT, UNIT_NONE, AT(scene, solver_steps), BETWEEN(1, 1000000000), "200000",
        "most steps (relaxation, cg); a run that needs more fails"),
    KEY("accuracy", KEY_REAL, UNIT_NONE, AT(scene, accuracy), INSIDE(0, 0.5), "(1 % with method auto)",
        "method auto: largest error that the cost-accuracy table may expect, as measured for the problem that the "
        "scene is like",
        .has = FLAG(scene, has_accuracy)),
    KEY("accuracy_table", KEY_HAND, UNIT_NONE, NOWHERE, ANY, "(that of the program)",
        "method auto: a cost-accuracy table measured elsewhere, as `cleave bench accuracy` writes it "
        "(results/bench/cost_accuracy.csv); "
        "sought in the scene's folder, then in the current one",
        .words = "file name, .csv"),

    KEY("material", KEY_PART, UNIT_NONE, NOWHERE, ANY, "(required, or materials)", "the one material; its keys follow"),
    KEY("materials", KEY_LIST, UNIT_NONE, NOWHERE, BETWEEN(1, 255), "(required, or material)",
        "several materials, each with the keys of material and a name"),
    KEY("material.name", KEY_NAME, UNIT_NONE, AT(material, name), ANY, "(material; required in materials)",
        "what bodies call it"),
    KEY("material.young", KEY_REAL, UNIT_PRESSURE, AT(material, young), ABOVE(0), REQUIRED, "Young's modulus"),
    KEY("material.poisson", KEY_REAL, UNIT_NONE, AT(material, poisson), INSIDE(-1, 0.4999),
        "(1/3 in plane stress, 1/4 in plane strain and solid, 0 in line)",
        "Poisson's ratio; pd and adaptive with model bond can only do the default"),
    KEY("material.density", KEY_REAL, UNIT_DENSITY, AT(material, density), ABOVE(0), REQUIRED, "mass density"),
    KEY("material.energy_release_rate", KEY_REAL, UNIT_SURFACE_ENERGY, AT(material, energy_release_rate), ABOVE(0),
        NONE,
        "G_c, from which the critical stretch follows; give at most one of these three, without any bonds never break"),
    KEY("material.critical_stretch", KEY_REAL, UNIT_NONE, AT(material, critical_stretch), ABOVE(0), NONE,
        "stretch at which a bond breaks; inf: never", .infinite = true),
    KEY("material.toughness", KEY_HAND, UNIT_TOUGHNESS, NOWHERE, ABOVE(0), NONE,
        "K_Ic; gives G_c = K^2/E (line, plane stress) or K^2 (1 - nu^2)/E", .words = "number"),
    KEY("material.yield_stress", KEY_REAL, UNIT_PRESSURE, AT(material, yield_stress), ABOVE(0), "inf",
        "stress at which it yields (von Mises; a bond alone); inf: elastic", .infinite = true),
    KEY("material.yield_tangent", KEY_REAL, UNIT_PRESSURE, AT(material, yield_tangent), FROM(0), "0 Pa",
        "E_t, slope of the uniaxial stress-strain curve once it yields; below young"),
    KEY("material.yield_hardening", KEY_HAND, UNIT_PRESSURE, NOWHERE, FROM(0), NONE,
        "H, yield stress over plastic strain; says the same as yield_tangent = E H/(E + H)", .words = "number"),

    KEY("body", KEY_HAND, UNIT_NONE, NOWHERE, ANY, "(required, or bodies)",
        "shape of the one body, which is then called body", .words = "solid or list of solids"),
    KEY("bodies", KEY_LIST, UNIT_NONE, NOWHERE, BETWEEN(1, 255), "(required, or body)",
        "several bodies; each has the keys below"),
    KEY("bodies.name", KEY_NAME, UNIT_NONE, AT(scene_body, name), ANY, "(body0, body1, ..)",
        "what boundary and initial call it"),
    KEY("bodies.material", KEY_MATERIAL, UNIT_NONE, AT(scene_body, material), ANY, "(the only one)",
        "name of its material"),
    KEY("bodies.shape", KEY_REGION, UNIT_NONE, AT(scene_body, shape), ANY, "(required, or particles)",
        "solids, filled with a lattice of particles"),
    KEY("bodies.particles", KEY_HAND, UNIT_NONE, NOWHERE, ANY, "(required, or shape)",
        "particle list (positions, volumes, material, body); sought in the scene's folder, then in the current one",
        .words = "file name, .csv or .h5"),
    KEY("bodies.frame", KEY_CHOICE, UNIT_NONE, AT(scene_body, frame), ANY, "(mpm.frame)", "its own mpm.frame",
        .words = "current|reference|auto"),
    KEY("bodies.velocity", KEY_POINT, UNIT_SPEED, AT(scene_body, velocity), ANY, "(0)", "initial velocity"),

    KEY("solid", KEY_GROUP, UNIT_NONE, NOWHERE, ANY, NONE,
        "what bodies and regions are made of: one of the following, or a list of them, built in order"),
    KEY("solid.box", KEY_PART, UNIT_NONE, NOWHERE, ANY, NONE, "axis-parallel box"),
    KEY("solid.box.from", KEY_POINT, UNIT_LENGTH, AT(solid, from), ANY, REQUIRED, "lower corner; -inf only in a region",
        .infinite = true),
    KEY("solid.box.to", KEY_POINT, UNIT_LENGTH, AT(solid, to), ANY, REQUIRED, "upper corner; inf only in a region",
        .infinite = true),
    KEY("solid.disc", KEY_PART, UNIT_NONE, NOWHERE, ANY, NONE, "disc; plane spaces only"),
    KEY("solid.disc.centre", KEY_POINT, UNIT_LENGTH, AT(solid, centre), ANY, REQUIRED, "centre"),
    KEY("solid.disc.radius", KEY_REAL, UNIT_LENGTH, AT(solid, radius), ABOVE(0), REQUIRED, "radius"),
    KEY("solid.ball", KEY_PART, UNIT_NONE, NOWHERE, ANY, NONE, "ball; in the plane a disc, in line an interval"),
    KEY("solid.ball.centre", KEY_POINT, UNIT_LENGTH, AT(solid, centre), ANY, REQUIRED, "centre"),
    KEY("solid.ball.radius", KEY_REAL, UNIT_LENGTH, AT(solid, radius), ABOVE(0), REQUIRED, "radius"),
    KEY("solid.cylinder", KEY_PART, UNIT_NONE, NOWHERE, ANY, NONE, "round cylinder; space solid only"),
    KEY("solid.cylinder.from", KEY_POINT, UNIT_LENGTH, AT(solid, from), ANY, REQUIRED, "one end of its axis"),
    KEY("solid.cylinder.to", KEY_POINT, UNIT_LENGTH, AT(solid, to), ANY, REQUIRED, "the other end"),
    KEY("solid.cylinder.radius", KEY_REAL, UNIT_LENGTH, AT(solid, radius), ABOVE(0), REQUIRED, "radius"),
    KEY("solid.half-space", KEY_PART, UNIT_NONE, NOWHERE, ANY, NONE,
        "all on the side of a plane that its normal leaves"),
    KEY("solid.half-space.point", KEY_POINT, UNIT_LENGTH, AT(solid, point), ANY, REQUIRED, "a point of the plane"),
    KEY("solid.half-space.normal", KEY_POINT, UNIT_NONE, AT(solid, normal), ANY, REQUIRED,
        "points outwards, any length"),
    KEY("solid.all", KEY_HAND, UNIT_NONE, NOWHERE, ANY, NONE, "everywhere", .words = "true"),
    KEY("solid.add", KEY_HAND, UNIT_NONE, NOWHERE, ANY, NONE, "a solid to add; a solid by itself is added, too",
        .words = "solid"),
    KEY("solid.subtract", KEY_HAND, UNIT_NONE, NOWHERE, ANY, NONE, "a solid to take away from what the list has built",
        .words = "solid"),

    KEY("particles", KEY_MAP, UNIT_NONE, NOWHERE, ANY, REQUIRED, "discretisation"),
    KEY("particles.spacing", KEY_REAL, UNIT_LENGTH, AT(scene, spacing), ABOVE(0), REQUIRED, "distance of the lattice"),
    KEY("particles.horizon", KEY_REAL, UNIT_NONE, AT(scene, horizon), BETWEEN(1, 10.5), "3.015",
        "reach of bonds, in spacings", .low = "is smaller than one spacing; 3.015 is usual"),
    KEY("particles.irregularity", KEY_REAL, UNIT_NONE, AT(scene, irregularity), BETWEEN(0, 1), "0",
        "each component is shifted by spacing x this x a random number in [-1/2, 1/2]"),
    KEY("particles.seed", KEY_SEED, UNIT_NONE, AT(scene, seed), ANY, "1", "of the random numbers"),

    KEY("pd", KEY_MAP, UNIT_NONE, NOWHERE, ANY, NONE, "peridynamics"),
    KEY("pd.volume", KEY_CHOICE, UNIT_NONE, AT(scene, volume), ANY, "whole",
        "share of a neighbour at the horizon's edge", .words = "whole|ramp|cut-ramp"),
    KEY("pd.calibration", KEY_CHOICE, UNIT_NONE, AT(scene, calibration), ANY, "lattice",
        "fixes stiffness: a full family, the continuum integral, or vmpd", .words = "lattice|continuum|vmpd"),
    KEY("pd.surface", KEY_CHOICE, UNIT_NONE, AT(scene, surface), ANY, "(moments with method pd)",
        "weights of bonds near faces: from moments of families, so that thin bodies bend, twist and stretch as they "
        "should (a lattice; else volume or none), or from neighbours' volume", .words = "none|volume|moments"),
    KEY("pd.weights", KEY_CHOICE, UNIT_NONE, AT(scene, shells), ANY, "(isotropic; calibration not lattice: uniform)",
        "isotropic: two shell weights take the lattice's anisotropy away", .words = "uniform|isotropic"),
    KEY("pd.influence", KEY_CHOICE, UNIT_NONE, AT(scene, influence), ANY, "(inverse with ospd and mospd, else one)",
        "weight of a bond by its length: 1, exp(-(r/delta)^2), delta/r, (delta/r)^2, 1 - r/(delta + spacing)",
        .words = "one|gaussian|inverse|inverse square|linear"),
    KEY("pd.normalisation", KEY_CHOICE, UNIT_NONE, AT(scene, bulk), ANY,
        "(bulk with mospd and irregularity 0, and with pd.surface moments, else local)",
        "ospd and mospd: constants from the family a particle has, or from a full one", .words = "local|bulk"),
    KEY("pd.last_force", KEY_CHOICE, UNIT_NONE, AT(scene, last_force), ANY, "moment",
        "of a bond that breaks: it acts until the moment, within a step, at which its stretch is critical; or with "
        "half, all (as in other programs) or none of itself in the first step beyond",
        .words = "moment|half|whole|none"),
    KEY("pd.region", KEY_REGION, UNIT_NONE, AT(scene, pd_region), ANY, NONE,
        "peridynamic from the start (method adaptive)", .has = FLAG(scene, has_pd_region)),

    KEY("mpm", KEY_MAP, UNIT_NONE, NOWHERE, ANY, NONE, "material point method"),
    KEY("mpm.cell", KEY_REAL, UNIT_NONE, AT(scene, cell), BETWEEN(1, 8), "2", "node distance of the grid, in spacings"),
    KEY("mpm.shape", KEY_CHOICE, UNIT_NONE, AT(scene, shape), ANY, "(gimp; linear with coupling pm and pmg)",
        "shape functions; a scene that says them wants the current frame",
        .words = "linear|gimp|cpgimp|quadratic|cubic", .has = FLAG(scene, has_shape)),
    KEY("mpm.transfer", KEY_CHOICE, UNIT_NONE, AT(scene, transfer), ANY, "(flip; apic with solver relaxation)",
        "grid to particle; apic not with linear; a scene that says it wants the current frame", .words = "flip|apic",
        .has = FLAG(scene, has_transfer)),
    KEY("mpm.frame", KEY_CHOICE, UNIT_NONE, AT(scene, frame), ANY, "auto",
        "configuration the grid lives in; reference: linear cells with their state on the nodes and material points as "
        "their quadrature, for bodies on a lattice that keep their neighbours and do not meet others, a tenth to a "
        "thirtieth of "
        "the cost; auto: reference where the body is one piece on a regular lattice, elastic, the only one and not at "
        "rest by a solver, "
        "with mpm.cell 2 and coupling partial stress or handshake, and the scene says nothing of shape, transfer and "
        "interface_damping, "
        "which have no meaning then; else current (`cleave check` says why)",
        .words = "current|reference|auto"),
    KEY("mpm.strain", KEY_CHOICE, UNIT_NONE, AT(scene, small_strain), ANY, "finite",
        "frame reference: finite, in axes that turn with each cell; small does not know rotations",
        .words = "finite|small"),
    KEY("mpm.constants", KEY_CHOICE, UNIT_NONE, AT(scene, lattice_constants), ANY, "isotropic",
        "frame reference: elastic constants of the material, or of its bonds on the lattice (model bond), which are "
        "not "
        "quite isotropic",
        .words = "isotropic|lattice"),
    KEY("mpm.origin", KEY_POINT, UNIT_LENGTH, AT(scene, grid_origin), ANY,
        "(on the first mirror across each axis, else at the first body's lower corner)", "a node of the grid",
        .has = FLAG(scene, has_grid_origin)),

    KEY("coupling", KEY_CHOICE, UNIT_NONE, AT(scene, coupling), ANY, "partial stress",
        "of material points and bonds where both meet", .words = "partial stress|handshake|pm|pg|pmg|pgg"),

    KEY("interface_damping", KEY_REAL, UNIT_NONE, AT(scene, interface_damping), FROM(0), "0.25",
        "coupling partial stress with transfer flip: damping of motion beside peridynamic particles that the grid "
        "cannot see, in wave speed over cell; 0: none; a scene that says it wants the current frame",
        .has = FLAG(scene, has_interface_damping)),

    KEY("conversion", KEY_MAP, UNIT_NONE, NOWHERE, ANY, NONE,
        "material point to peridynamic particle (method adaptive)"),
    KEY("conversion.stress", KEY_REAL, UNIT_PRESSURE, AT(scene, conversion.stress), ABOVE(0), "auto",
        "largest principal stress sigma_max; auto: young x critical stretch", .words = "auto", .word_value = NAN),
    KEY("conversion.alpha", KEY_REAL, UNIT_NONE, AT(scene, conversion.alpha), INSIDE(0, 1), "0.95",
        "share of it that converts"),
    KEY("conversion.block", KEY_FLAG, UNIT_NONE, AT(scene, conversion.block), ANY, "true",
        "a particle takes its horizon neighbours along"),
    KEY("conversion.criteria", KEY_SET, UNIT_NONE, AT(scene, conversion.criteria), ANY, "([bond, stress])",
        "what converts: a broken bond, the stress; a list, or none", .words = "bond|stress"),
    KEY("conversion.tips", KEY_REAL, UNIT_NONE, AT(scene, conversion.tips), BETWEEN(0, 1000), "0",
        "peridynamic from the start this many horizons round the ends of pre-cracks; 2 starts cracks when peridynamics "
        "does"),
    KEY("conversion.reversion", KEY_FLAG, UNIT_NONE, AT(scene, conversion.reverts), ANY, "false",
        "peridynamic particles become material points again where no bond within two horizons was ever broken and the "
        "stress "
        "stays low (coupling partial stress or handshake, elastic materials)"),
    KEY("conversion.hold_time", KEY_REAL, UNIT_NONE, AT(scene, conversion.hold_time), BETWEEN(1, 1e6), "5",
        "reversion: how long the stress must have been low, in horizon over wave speed; longer: fewer reversions"),
    KEY("conversion.low_stress", KEY_REAL, UNIT_NONE, AT(scene, conversion.low_stress), INSIDE(0, 0.9), "0.5",
        "reversion: what low stress is, as a share of the one that converts; lower: fewer reversions"),

    KEY("cracks", KEY_LIST, UNIT_NONE, NOWHERE, BETWEEN(0, 10000), NONE, "cracks there at the start"),
    KEY("cracks.from", KEY_POINT, UNIT_LENGTH, NOWHERE, ANY, NONE, "one end of a segment (plane)"),
    KEY("cracks.to", KEY_POINT, UNIT_LENGTH, NOWHERE, ANY, NONE, "the other end"),
    KEY("cracks.at", KEY_POINT, UNIT_LENGTH, NOWHERE, ANY, NONE, "place of a cut (line)"),
    KEY("cracks.polygon", KEY_HAND, UNIT_LENGTH, NOWHERE, BETWEEN(3, 1000), NONE, "plane convex polygon (solid)",
        .words = "list of points"),
    KEY("growth", KEY_LIST, UNIT_NONE, NOWHERE, BETWEEN(0, 64), NONE,
        "cracks that grow at a given speed, by themselves or while a sif probe asks for it (plane, model with bonds)"),
    KEY("growth.name", KEY_NAME, UNIT_NONE, AT(growth_rule, name), ANY, "(growth0, growth1, ..)",
        "what probes call it"),
    KEY("growth.at", KEY_POINT, UNIT_LENGTH, AT(growth_rule, at), ANY, REQUIRED, "where the tip starts"),
    KEY("growth.direction", KEY_POINT, UNIT_NONE, AT(growth_rule, direction), ANY, REQUIRED, "of growth, any length"),
    KEY("growth.speed", KEY_REAL, UNIT_SPEED, AT(growth_rule, speed), ABOVE(0), REQUIRED,
        "of the tip; follow: such that K_eq of its probe stays at toughness", .words = "follow", .word_value = NAN),
    KEY("growth.fastest", KEY_REAL, UNIT_SPEED, AT(growth_rule, fastest), ABOVE(0), "auto",
        "bound of a speed that follows; auto: 0.9 of the Rayleigh speed, which is the largest", .words = "auto",
        .word_value = NAN),
    KEY("growth.start", KEY_REAL, UNIT_TIME, AT(growth_rule, start), FROM(0), "0 s", "it rests before"),
    KEY("growth.length", KEY_REAL, UNIT_LENGTH, AT(growth_rule, length), ABOVE(0), "inf", "it stops there",
        .infinite = true),
    KEY("growth.damping", KEY_REAL, UNIT_LENGTH, AT(growth_rule, damping), FROM(0), "half",
        "a crossed bond fades while the crack grows by this; half: a horizon's half; 0: at once", .words = "half",
        .word_value = NAN),
    KEY("growth.exponent", KEY_REAL, UNIT_NONE, AT(growth_rule, exponent), ABOVE(0), "4",
        "fades as (1 - growth/damping)^exponent"),
    KEY("growth.probe", KEY_NAME, UNIT_NONE, AT(growth_rule, probe), ANY, "(none)",
        "name of the sif probe that controls it: grows while K_eq is at least toughness, towards the largest hoop "
        "stress"),
    KEY("growth.toughness", KEY_REAL, UNIT_TOUGHNESS, AT(growth_rule, toughness), FROM(0), "0 Pa m^0.5",
        "K_Ic (with probe)"),
    KEY("growth.smoothing", KEY_REAL, UNIT_LENGTH, AT(growth_rule, smoothing), FROM(0), "quarter",
        "its direction is the mean over this growth (with probe); quarter: of a horizon", .words = "quarter",
        .word_value = NAN),
    KEY("crack", KEY_MAP, UNIT_NONE, NOWHERE, ANY, NONE, "how crack tips are followed"),
    KEY("crack.speed_window", KEY_REAL, UNIT_TIME, AT(scene, speed_window), ABOVE(0), "(duration/10)",
        "window of the regression for a tip's speed"),

    KEY("initial", KEY_LIST, UNIT_NONE, NOWHERE, BETWEEN(0, 10000), NONE, "initial states; later entries overwrite"),
    KEY("initial.region", KEY_REGION, UNIT_NONE, AT(scene_initial, region), ANY, "(everywhere)", "where"),
    KEY("initial.body", KEY_BODY, UNIT_NONE, AT(scene_initial, body), ANY, "(any)", "name of the body it holds for"),
    KEY("initial.velocity", KEY_POINT, UNIT_SPEED, AT(scene_initial, velocity), ANY, "(0)", "velocity at the centre",
        .has = FLAG(scene_initial, sets_velocity)),
    KEY("initial.velocity_gradient", KEY_MATRIX, UNIT_RATE, AT(scene_initial, velocity_gradient), ANY, "(0)",
        "G: v += G (X - centre)", .has = FLAG(scene_initial, sets_velocity)),
    KEY("initial.displacement_gradient", KEY_MATRIX, UNIT_NONE, AT(scene_initial, displacement_gradient), ANY, "(0)",
        "H: x = X + H (X - centre), stressed accordingly", .has = FLAG(scene_initial, sets_strain)),
    KEY("initial.pulse", KEY_PART, UNIT_NONE, NOWHERE, ANY, NONE,
        "plane wave v exp(-(4 xi/width)^2) into material at rest; added to what is there"),
    KEY("initial.pulse.at", KEY_POINT, UNIT_LENGTH, AT(scene_initial, pulse.at), ANY, REQUIRED, "its centre"),
    KEY("initial.pulse.direction", KEY_POINT, UNIT_NONE, AT(scene_initial, pulse.direction), ANY, REQUIRED,
        "where it goes, any length"),
    KEY("initial.pulse.width", KEY_REAL, UNIT_LENGTH, AT(scene_initial, pulse.width), ABOVE(0), REQUIRED,
        "four Gaussian radii"),
    KEY("initial.pulse.velocity", KEY_REAL, UNIT_SPEED, AT(scene_initial, pulse.velocity), ANY, REQUIRED,
        "largest velocity of particles, along polarisation"),
    KEY("initial.pulse.polarisation", KEY_POINT, UNIT_NONE, AT(scene_initial, pulse.polarisation), ANY, "(direction)",
        "how particles move: along direction, a longitudinal wave, or across it, a transverse one; any length"),
    KEY("initial.centre", KEY_POINT, UNIT_LENGTH, AT(scene_initial, centre), ANY, "(0)", "of both gradients"),

    KEY("boundary", KEY_LIST, UNIT_NONE, NOWHERE, BETWEEN(0, 255), NONE,
        "boundary conditions; each has one of the five kinds"),
    KEY("boundary.name", KEY_NAME, UNIT_NONE, AT(boundary, name), ANY, "(boundary0, boundary1, ..)",
        "what probes call it"),
    KEY("boundary.region", KEY_REGION, UNIT_NONE, AT(boundary, region), ANY, "(everywhere)",
        "where, by reference position"),
    KEY("boundary.body", KEY_BODY, UNIT_NONE, AT(boundary, body), ANY, "(any)", "name of the body it acts on"),
    KEY("boundary.fixed", KEY_HAND, UNIT_NONE, NOWHERE, ANY, NONE, "components held at rest",
        .words = "all or list of x|y|z"),
    KEY("boundary.velocity", KEY_HAND, UNIT_SPEED, NOWHERE, ANY, NONE, "components driven; free ones are left alone",
        .words = "list of number or free"),
    KEY("boundary.traction", KEY_HAND, UNIT_PRESSURE, NOWHERE, ANY, NONE,
        "force per area across the face, on the first particle of each column: steps and curves too, walls of holes "
        "only "
        "where region leaves out what hides them",
        .words = "list of number"),
    KEY("boundary.face", KEY_HAND, UNIT_NONE, NOWHERE, ANY, NONE,
        "outward normal of the face (with traction); what region and body show to who looks from there",
        .words = "x+|x-|y+|y-|z+|z-"),
    KEY("boundary.body_force", KEY_HAND, UNIT_BODY_FORCE, NOWHERE, ANY, NONE, "force per volume",
        .words = "list of number"),
    KEY("boundary.profile", KEY_HAND, UNIT_NONE, NOWHERE, ANY, "uniform",
        "factor on body_force over the reference position", .words = "uniform or mapping"),
    KEY("boundary.profile.sine", KEY_PART, UNIT_NONE, NOWHERE, ANY, NONE,
        "sin(2 pi (X - origin) . direction/wavelength)"),
    KEY("boundary.profile.sine.wavelength", KEY_REAL, UNIT_LENGTH, AT(profile, wavelength), ABOVE(0), REQUIRED,
        "from crest to crest"),
    KEY("boundary.profile.sine.origin", KEY_POINT, UNIT_LENGTH, AT(profile, origin), ANY, "(0)",
        "where it is 0 and rises"),
    KEY("boundary.profile.sine.direction", KEY_POINT, UNIT_NONE, AT(profile, direction), ANY, "(along x)",
        "in which it varies, any length"),
    KEY("boundary.mirror", KEY_PART, UNIT_NONE, NOWHERE, ANY, NONE, "plane of symmetry"),
    KEY("boundary.mirror.axis", KEY_CHOICE, UNIT_NONE, AT(boundary, axis), ANY, REQUIRED, "normal of the plane",
        .words = "x|y|z"),
    KEY("boundary.mirror.at", KEY_REAL, UNIT_LENGTH, AT(boundary, at), ANY, REQUIRED, "where it is"),
    KEY("boundary.mirror.tangential", KEY_CHOICE, UNIT_NONE, AT(boundary, hold_tangential), ANY, "free",
        "held: no motion along the plane either (a clamped end)", .words = "free|held"),
    KEY("boundary.time", KEY_HAND, UNIT_NONE, NOWHERE, ANY, "constant", "factor on the value, one of the following",
        .words = "constant or mapping"),
    KEY("boundary.time.step", KEY_PART, UNIT_NONE, NOWHERE, ANY, NONE, "1 for from <= t < until, else 0"),
    KEY("boundary.time.step.from", KEY_REAL, UNIT_TIME, AT(time_function, from), ANY, "0", "begins"),
    KEY("boundary.time.step.until", KEY_REAL, UNIT_TIME, AT(time_function, until), ANY, REQUIRED, "ends"),
    KEY("boundary.time.pulse", KEY_PART, UNIT_NONE, NOWHERE, ANY, NONE, "sin^2 between from and until, 0 outside"),
    KEY("boundary.time.pulse.from", KEY_REAL, UNIT_TIME, AT(time_function, from), ANY, "0", "begins"),
    KEY("boundary.time.pulse.until", KEY_REAL, UNIT_TIME, AT(time_function, until), ANY, REQUIRED, "ends"),
    KEY("boundary.time.ramp", KEY_PART, UNIT_NONE, NOWHERE, ANY, NONE, "0 before from, linear, 1 after until"),
    KEY("boundary.time.ramp.from", KEY_REAL, UNIT_TIME, AT(time_function, from), ANY, "0", "begins"),
    KEY("boundary.time.ramp.until", KEY_REAL, UNIT_TIME, AT(time_function, until), ANY, REQUIRED, "ends"),
    KEY("boundary.time.table", KEY_HAND, UNIT_TIME, NOWHERE, BETWEEN(2, 50000), NONE,
        "linear between points, held outside; times ascend", .words = "list of [time, factor]"),

    KEY("time", KEY_MAP, UNIT_NONE, NOWHERE, ANY, NONE, "time step"),
    KEY("time.step", KEY_REAL, UNIT_TIME, AT(scene, time_step), ABOVE(0), "auto",
        "step; auto: safety x the critical one", .words = "auto", .word_value = 0),
    KEY("time.wall", KEY_REAL, UNIT_TIME, AT(scene, wall), ABOVE(0), "none",
        "wall clock, as 2 h or 90 min, after which the run ends with a checkpoint (exit status 130); scene.yaml leaves "
        "it out",
        .words = "none", .word_value = INFINITY, .of_process = true),
    KEY("time.active_set", KEY_FLAG, UNIT_NONE, AT(scene, active_set), ANY, "true",
        "what no wave has reached is not computed; the results are the same to the last bit, false is slower"),
    KEY("time.safety", KEY_REAL, UNIT_NONE, AT(scene, safety), INSIDE(0, 2), "(0.8, or 0.5 where bonds may break)",
        "share of the critical step; above 1 shows instability"),

    KEY("output", KEY_MAP, UNIT_NONE, NOWHERE, ANY, NONE, "what is written, and how often"),
    KEY("output.frames", KEY_INT, UNIT_NONE, AT(scene, frames), BETWEEN(0, 100000), "20",
        "frames after the one at t = 0, evenly spread", .has = FLAG(scene, has_frames)),
    KEY("output.times", KEY_SERIES, UNIT_TIME, AT(scene, times), ABOVE(0), "(evenly spread)",
        "when frames are written, besides the one at t = 0; ascending, those beyond the duration are left out; "
        "instead of output.frames"),
    KEY("output.samples", KEY_INT, UNIT_NONE, AT(scene, samples), BETWEEN(1, 10000000), "200",
        "lines of history.csv after the one at t = 0"),
    KEY("output.checkpoint", KEY_REAL, UNIT_TIME, AT(scene, checkpoint_interval), FROM(0), "60 s",
        "wall clock between checkpoints; 0: after every step"),
    KEY("output.compress", KEY_FLAG, UNIT_NONE, AT(scene, compress), ANY, "false", "gzip the frames (slow)"),

    KEY("probes", KEY_LIST, UNIT_NONE, NOWHERE, BETWEEN(0, 1000), NONE,
        "what is measured: kinds, or mappings kind: {keys}"),
    KEY("probes.tip", KEY_PART, UNIT_NONE, NOWHERE, ANY, NONE, "a crack tip: the longest, or the one nearest to at"),
    KEY("probes.tip.name", KEY_NAME, UNIT_NONE, AT(probe_request, name), ANY, "(tip)", "name in the results"),
    KEY("probes.tip.at", KEY_POINT, UNIT_LENGTH, AT(probe_request, at), ANY, "(the longest)", "near where it starts",
        .has = FLAG(probe_request, has_at)),
    KEY("probes.break", KEY_PART, UNIT_NONE, NOWHERE, ANY, NONE, "first cut bond"),
    KEY("probes.break.name", KEY_NAME, UNIT_NONE, AT(probe_request, name), ANY, "(break)", "name in the results"),
    KEY("probes.break.region", KEY_REGION, UNIT_NONE, AT(probe_request, region), ANY, "(everywhere)", "where"),
    KEY("probes.reaction", KEY_PART, UNIT_NONE, NOWHERE, ANY, NONE, "force at driven or held particles"),
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
    KEY("probes.sif.at", KEY_POINT, UNIT_LENGTH, AT(probe_request, at), ANY, "(the first pre-crack's end in the body)",
        "the tip; followed where it is the end of a pre-crack", .has = FLAG(probe_request, has_at)),
    KEY("probes.sif.direction", KEY_POINT, UNIT_NONE, AT(probe_request, direction), ANY, "(along the crack)",
        "ahead of the tip, any length; required with a tip that is no end of a pre-crack, such as the end of a gap in "
        "material points, which must be wider than two cells: across less they touch",
        .has = FLAG(probe_request, has_direction)),
    KEY("probes.sif.inner", KEY_REAL, UNIT_LENGTH, AT(probe_request, inner), ABOVE(0), "(half of outer)",
        "radius within which the weight is 1"),
    KEY("probes.sif.outer", KEY_REAL, UNIT_LENGTH, AT(probe_request, outer), ABOVE(0),
        "(the largest of contours, or 20 spacings)", "radius at which the weight reaches 0"),
    KEY("probes.sif.contours", KEY_SERIES, UNIT_LENGTH, AT(probe_request, contours), ABOVE(0),
        "(0.6, 0.8 and 1 times outer)", "outer radii compared for contour_spread, inner in proportion; ascending"),
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
        "radius that the inertial sum leaves out while the tip moves (its share grows from 0 to 1 between a "
        "third and five thirds of it)"),
    KEY("probes.sif.speed", KEY_REAL, UNIT_SPEED, AT(probe_request, speed), ABOVE(0), "auto",
        "of the tip once it moves; auto: of its growth over crack.speed_window", .words = "auto", .word_value = NAN),
    KEY("probes.growth", KEY_PART, UNIT_NONE, NOWHERE, ANY, NONE,
        "a crack that grows as it is told: place and length of its tip, angle of its path"),
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

const char *key_leaf(const struct key *k)
{
    const char *dot = strrchr(k->path, '.');
    return dot ? dot + 1 : k->path;
}

bool key_in(const struct key *k, const char *group)
{
    size_t length = strlen(group);
    if (k->type == KEY_GROUP) return false;
    if (length == 0) return !strchr(k->path, '.');
    return strncmp(k->path, group, length) == 0 && k->path[length] == '.' && !strchr(k->path + length + 1, '.');
}

const struct key *key_find(const char *group, const char *leaf)
{
    for (int k = 0; k < keys_count; k++)
        if (key_in(&keys[k], group) && strcmp(key_leaf(&keys[k]), leaf) == 0) return &keys[k];
    return NULL;
}

/* Number of letters to add, drop, change or swap with their neighbour (optimal string alignment) between a and b. */
int edit_distance(const char *a, const char *b)
{
    enum { LONGEST = 48 };
    int row[3][LONGEST + 1], n = (int)strnlen(a, LONGEST), m = (int)strnlen(b, LONGEST);
    int *older = row[0], *old = row[1], *now = row[2];
    for (int j = 0; j <= m; j++) old[j] = j;
    for (int i = 1; i <= n; i++) {
        now[0] = i;
        for (int j = 1; j <= m; j++) {
            int best = old[j - 1] + (a[i - 1] != b[j - 1]);
            if (old[j] + 1 < best) best = old[j] + 1;
            if (now[j - 1] + 1 < best) best = now[j - 1] + 1;
            bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (swapped && older[j - 2] + 1 < best) best = older[j - 2] + 1;
            now[j] = best;
        }
        int *spare = older;
        older = old, old = now, now = spare;
    }
    return old[m];
}

const struct key *key_nearest(const char *group, const char *leaf)
{
    const struct key *nearest = NULL;
    int least = 1000;
    for (int k = 0; k < keys_count; k++) {
        if (!key_in(&keys[k], group)) continue;
        int distance = edit_distance(key_leaf(&keys[k]), leaf);
        if (distance < least) nearest = &keys[k], least = distance;
    }
    return nearest;
}
