/* What a scene asks of the parts of a run: contact of its bodies, coupling, conversion, cracks that grow, probes. The
 * parts themselves, which lie above the scene, read these. */
#ifndef CLEAVE_REQUESTS
#define CLEAVE_REQUESTS

#include <math.h>

#include "base/base.h"
#include "data/region.h"

/* ---- figures that a scene means, however unlikely -----------------------------------------------------------------
 */

/* Words of the key `accept`, a bit each: rules of src/engine/warn_units.c that the scene breaks on purpose. */
#define ACCEPT_WORDS "waves|stretch|stress|strain|steps|reach|particles"

/* ---- contact ----------------------------------------------------------------------------------------------------- */

enum contact_between { CONTACT_NONE, CONTACT_BODIES, CONTACT_ALL };
enum contact_form { CONTACT_SURFACE, CONTACT_PAIR };
/* Of pairs: one spacing and the stiffness of contact/contact.h; or the rule of LAMMPS' peri/pmb, for comparison: the
 * least of 0.9 of the distance in the reference state and 1.35 spacings, also between particles that a bond joins, with
 * the stiffness 15 c V_i V_j/delta of the scene's own horizon. */
enum contact_distance { DISTANCE_SPACING, DISTANCE_LAMMPS };

/* ---- coupling and conversion ------------------------------------------------------------------------------------- */

enum coupling {
    COUPLING_PARTIAL_STRESS,
    COUPLING_HANDSHAKE, /* Zeng et al. 2022                                                     */
    COUPLING_PM,
    COUPLING_PG, /* Zeng et al. 2021: hand-shake, and the grid moves what lies in the cells at
                    the interface; with linear and with GIMP shapes                     */
    COUPLING_PMG,
    COUPLING_PGG /* the same on one unified grid, which moves everything                 */
};
/* Does the grid move peridynamic particles with this coupling, and all of them? */
static inline bool coupling_moves_by_grid(enum coupling c) { return c >= COUPLING_PM; }
static inline bool coupling_unified(enum coupling c) { return c == COUPLING_PMG || c == COUPLING_PGG; }

/* What stands for pre-cracks in the reference frame (notch.h). */
enum notch_rule { NOTCH_AUTO, NOTCH_SLIT, NOTCH_BONDS };
/* Radius of the zone round the end of a slit where bonds are cut: that of conversion.tips, but no less; where it names
 * none [spacings]. The first bond of kalthoff_winkler then breaks when it does with bonds cut all along, to 0.6 %. */
#define NOTCH_ZONE_LEAST 6.0
#define NOTCH_ZONE 8.0
enum { CONVERT_ON_BREAK = 1, CONVERT_ON_STRESS = 2 };

struct conversion_rule {
    unsigned criteria; /* sum of CONVERT_ON_* */
    real stress;       /* sigma_max [Pa]; NAN: E s_c */
    real alpha;        /* share of it that triggers */
    bool block;        /* the triggered particle takes its horizon neighbours along */
    real tips;         /* peridynamic from the start round ends of pre-cracks [horizons] */
    enum notch_rule notch;
    bool reverts;    /* particles revert to material points (reversion.h) */
    real hold_time;  /* after a stress that was low for so long [horizon/c] */
    real low_stress; /* low: share of the stress that converts */
};

/* ---- cracks that grow -------------------------------------------------------------------------------------------- */

struct growth_rule {
    char name[NAME_MAX_LENGTH];
    real at[DIM_MAX];            /* where the tip starts [m] */
    real direction[DIM_MAX];     /* unit vector */
    real speed;                  /* of the tip; NAN: such that K_eq stays at the toughness [m/s] */
    real fastest;                /* bound of that; NAN: 0.9 of the Rayleigh speed [m/s] */
    real start;                  /* it does not move before [s] */
    real length;                 /* it stops there; INFINITY: never [m] */
    real damping, exponent;      /* damping NAN: half a horizon [m] [1] */
    real smoothing;              /* with a probe, NAN: a quarter of a horizon [m] */
    char probe[NAME_MAX_LENGTH]; /* sif probe that controls it; "": none */
    real toughness;              /* K_Ic: it grows while K_eq is at least this [Pa m^(1/2)] */
};

/* Does the speed of this crack follow the toughness? */
static inline bool growth_follows(const struct growth_rule *rule) { return isnan(rule->speed); }

/* ---- probes ------------------------------------------------------------------------------------------------------ */

enum probe_kind {
    PROBE_TIP,      /* one crack tip (the longest, or the one nearest to `at`)                    */
    PROBE_BREAK,    /* first cut bond in a region                                                 */
    PROBE_REACTION, /* force of the support at a named boundary                                   */
    PROBE_PATCH,    /* largest nodal force residual over stress x h under uniform strain          */
    PROBE_SPALL,    /* separated end of a bar                                                     */
    PROBE_POINT,    /* displacement, velocity, stress, damage of the particle nearest to `at`     */
    PROBE_LINE,     /* profile from `from` to `to` in `points` stations, at the end and per frame */
    PROBE_ENERGY,   /* energies of the particles of a region                                      */
    PROBE_MOMENTUM, /* momentum of the particles of a region                                      */
    PROBE_PULSE,    /* wave packet at an interface: what came back, what went on                  */
    PROBE_EXACT,    /* a bar against a closed form                                                */
    PROBE_SIF,      /* stress-intensity factors of a crack tip                                    */
    PROBE_GROWTH,   /* a crack with prescribed or SIF-controlled growth: its tip, its path        */
    PROBE_RIGID,    /* a body that turns as a whole (plane)                                       */
    PROBES
};

enum exact_form { EXACT_STEP_BAR, EXACT_PLASTIC_BAR, EXACT_PULSE, EXACT_MANUFACTURED, EXACT_FORMS };

/* MLS: moving least squares with a complete quadratic, exact for it; where fewer than six particles are visible, or on
 * a line, linear. PDDO: the first-order peridynamic differential operator, weight delta/r, exact for linear fields. */
enum gradient_method { GRADIENT_MLS, GRADIENT_PDDO };

/* Weight q of an interaction integral (fracture/sif.h) between its contours,
 * q over z = (r - inner)/(outer - inner): 1 - 10 z^3 + 15 z^4 - 6 z^5; 1 - 3 z^2 + 2 z^3; 1 - z. The smoother, the more
 * accurate is the sum over particles: with exact gradients and outer = 10 spacings 0.07 %, 0.6 % and some per cent. */
enum sif_weight { SIF_QUINTIC, SIF_CUBIC, SIF_LINEAR };
enum sif_stress { SIF_HOOKE, SIF_PARTICLE };

struct probe_request {
    char name[NAME_MAX_LENGTH]; /* default: its kind */
    char place[PLACE_LENGTH];   /* in the scene */
    enum probe_kind kind;
    struct region region; /* BREAK, PATCH, ENERGY, MOMENTUM, RIGID; empty: everywhere */
    bool has_at;
    real at[DIM_MAX];                /* TIP, POINT, SIF; PULSE: a point of the interface [m] */
    bool has_direction;              /* SIF */
    real direction[DIM_MAX];         /* PULSE: its normal, along which the packet comes; SIF: ahead of the tip */
    real from[DIM_MAX], to[DIM_MAX]; /* LINE [m] */
    int points;                      /* LINE */
    char boundary[NAME_MAX_LENGTH];  /* REACTION: name of the boundary condition */
    char of[NAME_MAX_LENGTH];        /* GROWTH: name of the crack; "": the first */
    real experiment;                 /* GROWTH: angle in an experiment, for pictures; NAN: none [degree] */
    enum exact_form form;            /* EXACT; and for a manufactured solution [m] [s] [m] [m]: */
    real amplitude, period, wavelength, origin;
    struct number_list contours; /* SIF: outer radii to compare; none: 0.6, 0.8 and 1 times `outer` [m] */
    real inner, outer, core;     /* SIF; NAN or 0: half of outer; 20 spacings; 1.5 horizons [m] */
    real reach;                  /* SIF: rho_m in spacings; 0: 1.5 [1] */
    real speed;                  /* SIF: of a moving tip; NAN: measured [m/s] */
    int diffraction;             /* SIF */
    enum sif_weight weight;
    enum gradient_method gradient;
    enum sif_stress stress;
};

#endif
