/* Laws by which material points yield: flow law (yield stress as a function of plastic strain, its rate and
 * temperature), kinematic hardening, and adiabatic heating. Declares the constants that the input file gives and those
 * derived from them; kernels/laws has the functions of the laws. */
#ifndef CLEAVE_LAW
#define CLEAVE_LAW

#include "base/base.h"

/* clang-format off */
/* The flow laws, one row for each law. Columns:
 *   1  name in `enum flow`
 *   2  name in its functions, which a header of its own in kernels/laws defines (flow_linear.h describes them)
 *   3  key below `material.hardening`; NULL: the law has a key of its own
 *   4  true: its constants contain the first yield stress, and the key `yield_stress` is refused; law->yield is then
 *      computed by flow_law_compute_derived_constants
 *   5  true: its slope at plastic strain 0 is infinite, or has no bound over the constants that a scene may give;
 *      explicit steps then use a slope of at most 3 G */
#define FLOWS(X)                                     \
    X(LINEAR, linear, "linear", false, false)        \
    X(VOCE, voce, "voce", false, false)              \
    X(POWER, power, "power", false, true)            \
    X(TABLE, table, "table", true, false)            \
    X(JOHNSON_COOK, johnson_cook, NULL, true, true)
/* clang-format on */
#define FLOW_NAME(upper, ...) FLOW_##upper,
/* Flow laws (yield stress as a function of plastic strain, rate and temperature): an enumerator for each row of the
 * table FLOWS, in its order. FLOW_LAWS is their number. */
enum flow { FLOWS(FLOW_NAME) FLOW_LAWS };

/* Properties of a flow law (yield stress as a function of plastic strain). flow_properties is indexed by enum flow.
 * word: its key below `material.hardening`, NULL if it has a key of its own; own_yield: its constants contain the first
 * yield stress; steep: its slope at plastic strain 0 is infinite or unbounded. */
struct flow_properties {
    const char *word;
    bool own_yield, steep;
};
extern const struct flow_properties flow_properties[FLOW_LAWS];

/* How the nonlinear equation for the plastic strain of a step is solved. LAW_EXPLICIT: one evaluation, linearised at
 * the start of the step, for small strain increments. Errors do not add up, because the next step computes the yield
 * stress exactly. LAW_LOAD_STEP: to round-off, for increments of any size. */
enum law_mode { LAW_EXPLICIT, LAW_LOAD_STEP };

/* Largest number of points of a hardening curve (struct flow_curve). */
enum { FLOW_POINTS = 16 };

/* A concave hardening curve through `points` points of plastic strain, strain[k] [1], and yield stress, stress[k] [Pa];
 * constant beyond the last point. Segment k is the line start[k] + slope[k] a [Pa] in the plastic strain a; the last
 * segment is constant. */
struct flow_curve {
    int points;
    real strain[FLOW_POINTS], stress[FLOW_POINTS];
    real start[FLOW_POINTS], slope[FLOW_POINTS]; /* derived by flow_law_compute_derived_constants */
};

/* The law by which the material points of one material yield: flow law, kinematic hardening and heating by plastic
 * work. Of the constants of flow laws (`hardening` to `johnson_cook`) only those of the law `flow` are used. a:
 * equivalent plastic strain. */
struct law {
    bool given;     /* false: elastic, or a material of bonds alone; the other members have no meaning */
    enum flow flow; /* flow law: yield stress sigma as a function of a */
    real hardening; /* linear: modulus H [Pa] of sigma_y + H a */
    struct {
        real saturation, rate; /* Q [Pa], b [1]: sigma_y + Q (1 - exp(-b a)) */
    } voce;
    struct {
        real coefficient, exponent; /* B [Pa], n [1]: sigma_y + B a^n */
    } power;
    struct flow_curve table; /* table: points (plastic strain, yield stress) */
    struct {
        /* (A + B a^n)(1 + C log(rate/eps0))(1 - T*^m), T* = (T - T_room)/(T_melt - T_room); in order [Pa] [Pa] [1] [1]
         * [1] [1/s] [K] [K] */
        real A, B, n, C, m, eps0, T_room, T_melt;
    } johnson_cook;
    struct {
        real modulus, recall; /* C [Pa], 0: no kinematic hardening; gamma [1]: dX = 2/3 C de_p - gamma X da */
    } kinematic;
    /* c [J/(kg K)], 0: no heating; beta, share of the plastic work that heats the material [1] */
    real specific_heat, taylor_quinney;
    /* values derived by flow_law_compute_derived_constants */
    real yield;                 /* yield stress at no plastic strain, at the reference rate and room temperature [Pa] */
    real young, poisson, shear; /* elastic constants [Pa] [1] [Pa]; shear is 0 in 1D */
    real heating;               /* increase of temperature per plastic work, beta/(rho c) [K m^3/J]; 0: no heating */
    real steepest;              /* largest slope of the flow law that explicit steps use [Pa] */
    /* C and eps0 of the factor 1 + C log max(r/eps0, 1) on the yield stress at the plastic strain rate r, in explicit
     * steps; C is 0 if the rate has no effect [1] [1/s] */
    real rate_sensitivity, reference_rate;
};

/* Computes the derived members of `law` from constants of the material. yield_stress: initial yield stress [Pa],
 * ignored if the constants of the flow law contain it; young, shear: moduli [Pa], shear 0 in 1D; poisson [1]; density
 * [kg/m^3]. Does nothing if law->given is false. */
void flow_law_compute_derived_constants(struct law *law, real yield_stress, real young, real poisson, real shear,
                                        real density);

/* Returns true if plastic work heats the material with this law: the law is given and has a specific heat. */
static inline bool flow_law_plastic_work_heats_material(const struct law *law)
{
    return law->given && law->specific_heat > 0;
}

/* Returns true if the flow law `law` has a room temperature, at which its material starts. */
static inline bool flow_law_has_room_temperature(const struct law *law)
{
    return law->given && law->flow == FLOW_JOHNSON_COOK;
}

#endif
