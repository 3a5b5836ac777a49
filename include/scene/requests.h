/* Defines the settings that an input file passes to the parts of a run: contact, coupling, conversion, growing cracks
 * and probes. They are defined here since files of src/scene may not include the headers of these parts. */
#ifndef CLEAVE_REQUESTS
#define CLEAVE_REQUESTS

#include <math.h>

#include "base/base.h"
#include "data/region.h"

/* ---- unlikely values that are intended --------------------------------------------------------------------------- */

/* Words that the key `accept` of a scene may contain to silence warnings, in the order of enum accept. */
#define ACCEPT_WORDS                                                                                                   \
    "waves|stretch|stress|strain|steps|reach|particles|density|yield|passages|thickness|energy|heat|growth|mass|"      \
    "brittleness|times|contact|coupling|cell|speed|shock|rayleigh"

/* Warnings that a scene can silence by the key `accept`, one bit each. Those up to ACCEPT_TIMES concern results that
 * suggest a mistake of units (src/engine/warn_units.c). */
enum accept {
    ACCEPT_WAVES,
    ACCEPT_STRETCH,
    ACCEPT_STRESS,
    ACCEPT_STRAIN,
    ACCEPT_STEPS,
    ACCEPT_REACH,
    ACCEPT_PARTICLES,
    ACCEPT_DENSITY,
    ACCEPT_YIELD,
    ACCEPT_PASSAGES,
    ACCEPT_THICKNESS,
    ACCEPT_ENERGY,
    ACCEPT_HEAT,
    ACCEPT_GROWTH,
    ACCEPT_MASS,
    ACCEPT_BRITTLENESS,
    ACCEPT_TIMES,
    ACCEPT_CONTACT,  /* bodies or faces of cracks pass through each other */
    ACCEPT_COUPLING, /* a coupling that has no potential energy */
    ACCEPT_CELL,     /* one material point in a cell */
    ACCEPT_SPEED,    /* a boundary that breaks the bonds beside it by its speed */
    ACCEPT_SHOCK,    /* bonds that break behind the oscillating front of a collision */
    ACCEPT_RAYLEIGH  /* a crack tip faster than Rayleigh waves */
};

/* ---- contact ----------------------------------------------------------------------------------------------------- */

/* Particles between which contact forces act: none, those of different bodies, all near a face of a body, fragment or
 * crack. */
enum contact_between { CONTACT_NONE, CONTACT_BODIES, CONTACT_ALL };

/* Form of the contact law: between smooth faces, or between pairs of particles. */
enum contact_form { CONTACT_SURFACE, CONTACT_PAIR };

/* Contact distance of particle pairs. SPACING: one spacing, with the stiffness of contact/contact.h. LAMMPS: the rule
 * of the LAMMPS style peri/pmb, for comparison: the smaller of 0.9 times the reference distance and 1.35 spacings, also
 * for bonded pairs, with the stiffness 15 c V_i V_j/delta, where delta is the horizon of the scene. */
enum contact_distance { DISTANCE_SPACING, DISTANCE_LAMMPS };

/* ---- coupling and conversion ------------------------------------------------------------------------------------- */

/* Couplings of peridynamic particles and material points. */
enum coupling {
    COUPLING_PARTIAL_STRESS, /* material points leave a share of their stress to the bonds that cross their cell */
    COUPLING_HANDSHAKE,      /* Zeng et al. 2022 */
    COUPLING_PM,             /* Zeng et al. 2021: as HANDSHAKE, and the grid, with linear shape functions, moves the
                                particles in the cells at the interface */
    COUPLING_PG,             /* as PM with GIMP shape functions */
    COUPLING_PMG,            /* as PM on one grid that moves all particles */
    COUPLING_PGG             /* as PG on one grid that moves all particles */
};

/* Returns true if, with the coupling method c, the background grid moves peridynamic particles, at least those near the
 * interface to material points. */
static inline bool coupling_moves_pd_particles_by_grid(enum coupling c) { return c >= COUPLING_PM; }

/* Returns true if, with the coupling method c, one grid moves all particles, peridynamic ones and material points. */
static inline bool coupling_moves_all_particles_by_one_grid(enum coupling c)
{
    return c == COUPLING_PMG || c == COUPLING_PGG;
}

/* How a mesh in the reference configuration represents pre-cracks (notch.h). SLIT: as a free surface of the mesh, with
 * cut bonds near the crack tips only; BONDS: as cut bonds along the whole crack; AUTO: the program chooses one of
 * both. */
enum notch_rule { NOTCH_AUTO, NOTCH_SLIT, NOTCH_BONDS };

/* Radius of the zone around the end of a slit (a pre-crack as a free surface of the mesh) in which bonds are cut
 * [spacings]. NOTCH_ZONE applies if conversion.tips gives no radius, NOTCH_ZONE_LEAST bounds the given radius from
 * below. Both are empirical: the first bond of the example kalthoff_winkler then breaks within 0.6 % of the time that
 * it takes with bonds cut along the whole pre-crack. */
#define NOTCH_ZONE_LEAST 6.0
#define NOTCH_ZONE 8.0

/* Criteria by which a material point converts to a peridynamic particle, as bits. CONVERT_ON_BREAK: one of its bonds
 * has broken; CONVERT_ON_STRESS: its stress is too large. */
enum { CONVERT_ON_BREAK = 1, CONVERT_ON_STRESS = 2 };

/* Criteria by which material points of a run convert to peridynamic particles, and by which these revert to material
 * points. */
struct conversion_rule {
    unsigned criteria;     /* sum of CONVERT_ON_* */
    real stress;           /* sigma_max, stress at which bonds break [Pa]; NAN: E times critical stretch */
    real alpha;            /* material points convert at the principal stress alpha sigma_max [1] */
    bool block;            /* the neighbours within the horizon of the triggering particle convert, too */
    real tips;             /* radius around ends of pre-cracks that is peridynamic from the start [horizons] */
    enum notch_rule notch; /* how pre-cracks are represented in a mesh */
    bool reverts;          /* particles revert to material points (reversion.h) */
    real hold_time;        /* time for which the stress must be low before a particle reverts [horizon/wave speed] */
    real low_stress;       /* upper bound of a low stress, as a share of the stress that converts [1] */
};

/* ---- cracks that grow -------------------------------------------------------------------------------------------- */

/* Settings of a crack whose tip moves at a given speed, or at a speed controlled by its stress-intensity factors. */
struct growth_rule {
    char name[NAME_MAX_LENGTH];
    real at[DIM_MAX];        /* initial position of the crack tip [m] */
    real direction[DIM_MAX]; /* initial growth direction, unit vector */
    real speed;              /* crack-tip speed [m/s]; NAN: controlled so that K_eq stays at the toughness */
    real fastest;            /* upper bound of the controlled speed [m/s]; NAN: 0.9 of the Rayleigh speed */
    real start;              /* time at which growth begins [s] */
    real length;             /* length at which growth ends [m]; INFINITY: never */
    real damping, exponent;  /* the weight of a bond decreases as (1 - growth/damping)^exponent with the growth of the
                                crack since it crossed the bond [m] [1]; damping NAN: half a horizon */
    real smoothing;          /* with a probe: length of growth over which the direction is averaged [m]; NAN: a
                                quarter of a horizon */
    char probe[NAME_MAX_LENGTH]; /* sif probe that controls growth; "": none */
    real toughness;              /* K_Ic: the crack grows while K_eq is at least K_Ic [Pa m^(1/2)] */
};

/* Returns true if the speed of the crack tip in `rule` is not given but controlled, such that the equivalent
 * stress-intensity factor stays at the toughness. */
static inline bool growth_rule_controls_speed_by_toughness(const struct growth_rule *rule)
{
    return isnan(rule->speed);
}

/* ---- probes ------------------------------------------------------------------------------------------------------ */

/* Kinds of probes: what a probe measures. */
enum probe_kind {
    PROBE_TIP,      /* one crack tip (the longest, or the one nearest to `at`)                    */
    PROBE_BREAK,    /* first broken bond in a region                                              */
    PROBE_REACTION, /* force of the support at a named boundary                                   */
    PROBE_PATCH,    /* largest nodal force residual divided by stress x h, under uniform strain */
    PROBE_SPALL,    /* separated end of a bar                                                     */
    PROBE_POINT,    /* displacement, velocity, stress, damage of the particle nearest to `at`     */
    PROBE_LINE,     /* profile from `from` to `to` in `points` stations, at the end and per frame */
    PROBE_ENERGY,   /* energies of the particles of a region                                      */
    PROBE_MOMENTUM, /* momentum of the particles of a region                                      */
    PROBE_PULSE,    /* wave packet at an interface: its reflected and its transmitted part        */
    PROBE_EXACT,    /* difference from the closed-form solution of a bar                          */
    PROBE_SIF,      /* stress-intensity factors of a crack tip                                    */
    PROBE_GROWTH,   /* a crack with prescribed or SIF-controlled growth: its tip, its path        */
    PROBE_RIGID,    /* rotation of a body as a whole (plane)                                      */
    PROBES
};

/* Bars with closed-form solutions, with which a probe compares results (probes/exact.h): elastic bar and
 * elastic-plastic bar under a step load, wave packet, manufactured solution. EXACT_FORMS: number of solutions. */
enum exact_form { EXACT_STEP_BAR, EXACT_PLASTIC_BAR, EXACT_PULSE, EXACT_MANUFACTURED, EXACT_FORMS };

/* Method for displacement gradients. MLS: moving least squares with a complete quadratic polynomial, exact for
 * quadratic fields; linear if fewer than six particles are visible or all of them are on one line. PDDO: the
 * first-order peridynamic differential operator with weight delta/r, exact for linear fields. */
enum gradient_method { GRADIENT_MLS, GRADIENT_PDDO };

/* Weight q of an interaction integral (fracture/sif.h) as a function of z = (r - inner)/(outer - inner).
 * QUINTIC: 1 - 10 z^3 + 15 z^4 - 6 z^5. CUBIC: 1 - 3 z^2 + 2 z^3. LINEAR: 1 - z. The sum over particles is the more
 * accurate the smoother q is: its measured error with exact gradients and outer = 10 spacings is 0.07 %, 0.6 % and some
 * per cent. */
enum sif_weight { SIF_QUINTIC, SIF_CUBIC, SIF_LINEAR };

/* Stress in an interaction integral. HOOKE: by Hooke's law from the displacement gradient; PARTICLE: the stress that is
 * stored with the particles. */
enum sif_stress { SIF_HOOKE, SIF_PARTICLE };

/* Settings of a probe. Members whose comment begins with kinds of probes are used by these kinds alone. */
struct probe_request {
    char name[NAME_MAX_LENGTH]; /* default: the word of its kind */
    char place[PLACE_LENGTH];   /* location in the scene file, for messages */
    enum probe_kind kind;
    struct region region;            /* BREAK, PATCH, ENERGY, MOMENTUM, RIGID: particles; empty: all */
    bool has_at;                     /* the scene gives `at` */
    real at[DIM_MAX];                /* TIP, POINT, SIF: position; PULSE: a point of the interface [m] */
    bool has_direction;              /* SIF: the scene gives `direction` */
    real direction[DIM_MAX];         /* PULSE: normal of the interface, in the direction of the incident packet;
                                        SIF: direction ahead of the tip */
    real from[DIM_MAX], to[DIM_MAX]; /* LINE: both ends of the line [m] */
    int points;                      /* LINE: number of stations (positions at equal distances) */
    char boundary[NAME_MAX_LENGTH];  /* REACTION: name of the boundary condition */
    char of[NAME_MAX_LENGTH];        /* GROWTH: name of the crack; "": the first */
    real experiment;                 /* GROWTH: measured crack angle, drawn in plots [degree]; NAN: none */
    enum exact_form form;            /* EXACT: closed-form solution */
    real amplitude, period, wavelength, origin; /* EXACT: of a manufactured solution [m] [s] [m] [m] */
    struct number_list contours; /* SIF: outer radii whose results are compared [m]; empty: 0.6, 0.8, 1 times `outer` */
    /* SIF: radii between which the weight falls from 1 to 0; radius that the inertial sum of a moving tip leaves out
     * [m]; NAN or 0: outer/2, 20 spacings, 1.5 horizons */
    real inner, outer, core;
    real reach;                    /* SIF: radius of the neighbourhood of a gradient, rho_m [spacings]; 0: 1.5 */
    real speed;                    /* SIF: speed of a moving tip [m/s]; NAN: measured */
    int diffraction;               /* SIF: exponent of the distance factor for points behind the crack (sif.h) */
    enum sif_weight weight;        /* SIF: weight function of the integral */
    enum gradient_method gradient; /* SIF: method for displacement gradients */
    enum sif_stress stress;        /* SIF: source of the stress */
};

#endif
