/* Implements the return mapping of flow laws (law_update.h), one code for all spaces. xi = s - g X is the
 * trial relative stress, with the trial stress s and the back stress X; q is the equivalent relative stress,
 * da the increment of equivalent plastic strain, t = da/q. Some components of xi shrink by 1/(1 + A t),
 * others by 1/(1 + B t), and
 *     q^2 = even + odd,   even: of xi_xx + xi_yy in plane stress, of xi in 1D;   odd: of other components
 *     A = E/(2 (1 - nu)) + C f in plane stress, E + C f in 1D;   B = 3 G + C f
 *     g = exp(-gamma da),   f = (1 - g)/(gamma da)
 * with elastic constants E, nu, G, and modulus C and recall gamma of kinematic hardening
 * (Armstrong-Frederick). The law of the back stress is integrated along a constant direction of flow, so that
 * steps of any size are exact where the direction does not change. In plane stress xi_xx + xi_yy stands for
 * s_xx + s_yy - 3 (X_xx + X_yy), for which q^2 = (xi_xx + xi_yy)^2/4 + 3 (xi_xx - xi_yy)^2/4 + 3 xi_xy^2. */
#define ROWS_IN_PARTS /* vectors of WIDE points */
#include <string.h>

#include "law_update.h"

#include "flows.h"

/* Number of iterations ("passes") of the return mapping in a load step, without and with recall of the back stress.
 * Each pass linearises the flow law at the plastic strain of the pass before. The flow law is concave, so that the
 * plastic strains of the passes increase to the solution, quadratically; one pass is enough for linear hardening. The
 * recall of the back stress follows from the plastic strain of the last pass; its error falls to about C/3G of it in
 * each pass (C: kinematic modulus, G: shear modulus). */
enum { PASSES = 10, PASSES_RECALL = 48 };
/* Number of Newton steps for t (increment of plastic strain, divided by the equivalent stress q) in plane stress, from
 * t = 0, for the equation 1 - slope t - bound/q(t) = 0. Its left side is decreasing and convex (1/q is a power mean of
 * two linear functions, which is concave), so that the steps increase to the root. For trial stresses from 1e-4 to 1e5
 * yield stresses beyond the yield surface two to four steps reach round-off, up to eight at a Poisson's ratio of -0.9.
 * In other spaces one step is exact. */
enum { STEPS_PLANE_STRESS = 8 };
/* Least ratio of the yield stress to Young's modulus [1]. Keeps quotients by the yield stress finite at molten points,
 * whose strength is 0. */
#define LEAST_YIELD 1e-10

/* State of WIDE material points (one per vector lane) during the return mapping, a part of the eight points of struct
 * law_points, whose members it repeats. */
struct part_points {
    lanes s[SYM_MAX], before[SYM_MAX], volume_before, volume;
    lanes a, back[SYM_MAX], temperature, work;
    lanes_mask active;
    real duration;
    bool thins;
};

/* Returns the number of components of the relative stress (stress less back stress) that relative_stress computes in
 * `space`: 6 in 3D, 4 in plane strain, 3 in plane stress, 1 in 1D. */
static ALWAYS_INLINE int components(const enum space space)
{
    return space == SPACE_SOLID ? 6 : space == SPACE_PLANE_STRAIN ? 4 : space == SPACE_PLANE_STRESS ? 3 : 1;
}

/* Returns how many of the first components xx yy zz xy yz zx of a symmetric tensor can differ from 0 in `space`: 1 in
 * 1D (xx), 4 in plane stress and plane strain (zz, normal to the plane, included), 6 in 3D. */
static ALWAYS_INLINE int tensor_components(const enum space space)
{
    return space == SPACE_LINE ? 1 : space == SPACE_SOLID ? 6 : 4;
}

/* Computes the relative stress s - g X of WIDE points [Pa], with the trial stress s (p->s) and the back stress X
 * (p->back). xi: receives components(space) entries: in 3D and plane strain the deviator of s - g X in the order xx yy
 * zz xy yz zx; in plane stress the components xx + yy, xx - yy and xy, in 1D the component xx, in both after X_zz has
 * been subtracted from the normal components of X, which is deviatoric. g: factor on the back stress [1]. */
static ALWAYS_INLINE void relative_stress(const struct part_points *p, lanes g, lanes *xi, const enum space space)
{
    if (space == SPACE_LINE) {
        xi[0] = p->s[0] - 1.5 * g * p->back[0];
        return;
    }
    if (space == SPACE_PLANE_STRESS) {
        xi[0] = p->s[0] + p->s[1] - 3.0 * g * (p->back[0] + p->back[1]);
        xi[1] = p->s[0] - p->s[1] - g * (p->back[0] - p->back[1]);
        xi[2] = p->s[3] - g * p->back[3];
        return;
    }
    const lanes mean = (p->s[0] + p->s[1] + p->s[2]) / 3.0;
    for (int c = 0; c < components(space); c++) xi[c] = p->s[c] - (c < 3 ? mean : lanes_broadcast(0)) - g * p->back[c];
}

/* Computes the product 3/2 x:y [Pa^2] of two relative stresses (stress less back stress) of WIDE points, as the sum of
 * two parts that plastic flow reduces at different rates. x, y: components(space) entries in the order of
 * relative_stress [Pa]. *even: receives the part of the component xx + yy in plane stress, the whole product in 1D,
 * otherwise 0; *odd: receives the part of all other components. */
static ALWAYS_INLINE void relative_product(const lanes *x, const lanes *y, lanes *even, lanes *odd,
                                           const enum space space)
{
    *even = *odd = lanes_broadcast(0);
    if (space == SPACE_LINE)
        *even = x[0] * y[0];
    else if (space == SPACE_PLANE_STRESS)
        *even = 0.25 * x[0] * y[0], *odd = 0.75 * x[1] * y[1] + 3.0 * x[2] * y[2];
    else
        for (int c = 0; c < components(space); c++) *odd += (c < 3 ? 1.5 : 3.0) * x[c] * y[c];
}

/* The equation from which plastic flow of WIDE points (one per vector lane) follows, for the unknown t = da/q [1/Pa]:
 * da is the increment of equivalent plastic strain, q the equivalent relative stress (stress less back stress). q(t)^2
 * = even/(1 + A t)^2 + odd/(1 + B t)^2. even, odd: the two parts of the squared trial value of q [Pa^2]; A, B:
 * stiffnesses by which they fall [Pa]; q: equivalent relative stress at t = 0 [Pa]. */
struct flow_equation {
    lanes even, odd, A, B, q;
};

/* Returns the yield equation of WIDE points, one per vector lane (struct flow_equation): how the equivalent relative
 * stress q falls with t = da/q, da being the increment of plastic strain. law: flow law of the points; p: their trial
 * stress and back stress. g: factor on the back stress X [1]; stiffness: kinematic hardening modulus that acts over the
 * step [Pa]. xi: receives the relative stress s - g X [Pa] (relative_stress). space: compile-time constant, as in all
 * functions of this file. */
static ALWAYS_INLINE struct flow_equation equation_at(const struct law *law, const struct part_points *p, lanes g,
                                                      lanes stiffness, lanes *xi, const enum space space)
{
    struct flow_equation e;
    relative_stress(p, g, xi, space);
    relative_product(xi, xi, &e.even, &e.odd, space);
    e.q = lanes_square_root(lanes_max(e.even + e.odd, lanes_broadcast(1e-200)));
    const real uniaxial = space == SPACE_LINE ? law->young : 0.5 * law->young / (1 - law->poisson);
    e.A = uniaxial + stiffness, e.B = 3 * law->shear + stiffness;
    return e;
}

/* Returns the stiffness r [Pa] with which plastic flow reduces the relative stress xi (stress less back stress) of WIDE
 * points (one per vector lane): xi becomes xi/(1 + r t). t = da/q [1/Pa] is the increment da of plastic strain divided
 * by the equivalent relative stress q. r is Young's modulus in 1D (e->A), three times the shear modulus in 3D and plane
 * strain (e->B), each plus the kinematic hardening modulus. Not for plane stress, where two parts of xi fall at
 * different rates. e: yield equation of the points; space: compile-time constant. */
static ALWAYS_INLINE lanes single_rate(const struct flow_equation *e, const enum space space)
{
    return space == SPACE_LINE ? e->A : e->B;
}

/* Returns for WIDE points the equivalent relative stress q [Pa] (of stress less back stress) that remains after
 * plastic flow. e: yield equation; t: increment of plastic strain, divided by q [1/Pa]. *fall: in plane stress receives
 * -q dq/dt [Pa^3], else is not set. space: compile-time constant. */
static ALWAYS_INLINE lanes equation_stress(const struct flow_equation *e, lanes t, lanes *fall, const enum space space)
{
    if (space != SPACE_PLANE_STRESS) return e->q / (1.0 + single_rate(e, space) * t);
    const lanes u = 1.0 / (1.0 + e->A * t), v = 1.0 / (1.0 + e->B * t);
    *fall = e->even * e->A * u * u * u + e->odd * e->B * v * v * v;
    return lanes_square_root(
        lanes_max(e->even * u * u + e->odd * v * v, lanes_broadcast(1e-200))); /* points without stress */
}

/* Solves 1 - slope t - bound/q(t) = 0 for WIDE points and returns t [1/Pa], or 0 for a point with q(0) below `bound`
 * (no flow). With t = da/q, the increment da of plastic strain divided by the equivalent relative stress q, the
 * equation means q = bound + slope da. e: yield equation q(t); bound: yield stress at the start [Pa]; slope: its
 * derivative by the plastic strain [Pa]. In plane stress t follows from Newton's method, started at t = 0, else from a
 * closed form. space: compile-time constant. */
static ALWAYS_INLINE lanes equation_solve(const struct flow_equation *e, lanes bound, lanes slope,
                                          const enum space space)
{
    lanes t = lanes_broadcast(0), fall;
    if (space != SPACE_PLANE_STRESS)
        return lanes_max((e->q - bound) / (slope * e->q + bound * single_rate(e, space)), lanes_broadcast(0));
    for (int k = 0; k < STEPS_PLANE_STRESS; k++) {
        const lanes inverse = 1.0 / equation_stress(e, t, &fall, space);
        const lanes rest = 1.0 - slope * t - bound * inverse;
        t = lanes_max(t + rest / (slope + bound * fall * inverse * inverse * inverse), lanes_broadcast(0));
    }
    return t;
}

/* Returns for WIDE points (one per vector lane) the kinematic hardening modulus [Pa] that acts over a small step: C -
 * gamma (3/2) xi:X/q. C and gamma are modulus and recall constant of the Armstrong-Frederick law (law->kinematic); the
 * recall of the back stress X (p->back) moves the yield surface back. xi: trial relative stress [Pa], in the order of
 * relative_stress; q: its equivalent stress [Pa]. space: compile-time constant. */
static ALWAYS_INLINE lanes effective_modulus(const struct law *law, const struct part_points *p, const lanes *xi,
                                             lanes q, const enum space space)
{
    struct part_points back = {.s = {lanes_broadcast(0)}};
    lanes x[SYM_MAX], even, odd;
    if (!(law->kinematic.recall > 0)) return lanes_broadcast(law->kinematic.modulus);
    for (int c = 0; c < SYM_MAX; c++) back.s[c] = lanes_broadcast(0), back.back[c] = -p->back[c];
    relative_stress(&back, lanes_broadcast(1), x, space);
    relative_product(xi, x, &even, &odd, space);
    return law->kinematic.modulus - law->kinematic.recall * (even + odd) / q;
}

/* Change of the back stress X with recall (Armstrong-Frederick law) in a step along a constant direction N of plastic
 * flow, d eps_p = N da, for WIDE points (one per vector lane): X = left X_n + (2/3) C added N da, with X_n at the start
 * of the step and the kinematic modulus C. left, added: factors [1]. */
struct flow_recall {
    lanes left, added;
};

/* Returns for WIDE points (one per vector lane) the factors of the change of the back stress over an increment `more`
 * of plastic strain [1] by the Armstrong-Frederick law: left = exp(-x), the factor on the previous back stress, and
 * added = (1 - exp(-x))/x, the factor on the new part, with x = recall more. Below x = 1e-4 `added` is computed by its
 * series. recall: constant gamma of the law, > 0 [1]. */
static ALWAYS_INLINE struct flow_recall recall_after(real recall, lanes more)
{
    const lanes x = recall * more, left = lanes_exp(-x), least = lanes_max(x, lanes_broadcast(1e-4));
    const lanes series = 1.0 - x * (0.5 - x * (1.0 / 6 - x * (1.0 / 24)));
    const lanes_mask small = lanes_less(x, lanes_broadcast(1e-4));
    return (struct flow_recall){left, lanes_choose(small, series, (1.0 - left) / least)};
}

/* Returns for WIDE points (one per vector lane) the solution w > 0 of w + log w = z, for the rate term of the flow law.
 * Three Newton steps start from w = z if z is above 0.3, else from w = exp z. The relative error is at most 2.1e-5
 * (near z = 0.3), and 2e-10 above z = 3 and below -2. The caller linearises once more about w, which squares this
 * error. */
static ALWAYS_INLINE lanes omega(lanes z)
{
    const lanes middle = lanes_broadcast(0.3);
    lanes w = lanes_choose(lanes_less(middle, z), z, lanes_exp(lanes_min(z, middle)));
    for (int k = 0; k < 3; k++) w *= (1.0 + z - lanes_log(w)) / (1.0 + w);
    return w;
}

/* Accounts for the strain-rate dependence of the flow law of WIDE points (one per vector lane) in a small
 * step. *bound [Pa] and *slope [Pa]: on entry the yield stress of slow flow at the start of the step and its
 * derivative by the plastic strain; on return the tangent of the yield stress at the plastic strain rate of
 * the step. With the increment da of plastic strain over the duration dt (p->duration) the yield stress is
 *   (bound + slope da)(1 + C log(da/(eps0 dt)))   where da > eps0 dt, else bound + slope da.
 * The tangent is taken at the da at which this stress equals the equivalent stress, which falls linearly with
 * da; `omega` gives a first estimate of da. The rate is that of the plastic strain, not of the total strain,
 * because the latter falls to 0 where loads reverse, and the plastic strain would then depend on the size of
 * the step. trial: yield equation at the start of the step. space: compile-time constant. */
static ALWAYS_INLINE void linearise_rate(const struct law *law, const struct part_points *p,
                                         const struct flow_equation *trial, lanes *bound, lanes *slope,
                                         const enum space space)
{
    const real C = law->rate_sensitivity, slow = law->reference_rate * p->duration;
    lanes fall = lanes_broadcast(0), stiffness = *slope;
    equation_stress(trial, lanes_broadcast(0), &fall, space);
    stiffness += space == SPACE_PLANE_STRESS ? fall / (trial->q * trial->q) : single_rate(trial, space);
    const lanes drag = C * *bound; /* increase of the yield stress per logarithm of the rate [Pa] */
    const lanes z = (trial->q - *bound) / drag + lanes_log(stiffness * slow / drag);
    const lanes more = lanes_max(omega(z) * drag / stiffness, lanes_broadcast(slow));
    const lanes factor = 1.0 + C * lanes_log(more * (1 / slow)), stress = *bound + *slope * more;
    const lanes rise = *slope * factor + C * stress / more;
    const lanes_mask fast = lanes_less(lanes_broadcast(slow), more);
    *bound = lanes_choose(fast, stress * factor - rise * more, *bound);
    *slope = lanes_choose(fast, rise, *slope);
}

/* Returns the plastic flow t = da/q [1/Pa] of WIDE points (one per vector lane) in a small step, by one linearised
 * evaluation (da: increment of plastic strain, q: equivalent relative stress). law: flow law; p: state of the points;
 * trial, xi: yield equation and relative stress [Pa] of the trial state; bound: yield stress at the start of the step
 * [Pa]; slope: its derivative by the plastic strain [Pa], used only up to law->steepest. *back: receives the factors by
 * which the back stress changes in the step (recall_after). space: compile-time constant. */
static ALWAYS_INLINE lanes solve_explicit(const struct law *law, const struct part_points *p,
                                          const struct flow_equation *trial, const lanes *xi, lanes bound, lanes slope,
                                          struct flow_recall *back, const enum space space)
{
    lanes least = lanes_min(slope, lanes_broadcast(law->steepest)), fall;
    if (law->rate_sensitivity > 0 && p->duration > 0) linearise_rate(law, p, trial, &bound, &least, space);
    back->left = back->added = lanes_broadcast(1);
    if (!(law->kinematic.recall > 0)) return equation_solve(trial, bound, least, space);
    struct flow_equation e = *trial;
    const lanes C = effective_modulus(law, p, xi, e.q, space);
    e.A += C - law->kinematic.modulus, e.B += C - law->kinematic.modulus;
    const lanes t = equation_solve(&e, bound, least, space);
    *back = recall_after(law->kinematic.recall, t * equation_stress(&e, t, &fall, space));
    return t;
}

/* Returns the temperatures [K] of WIDE points (one per vector lane) after an increment `more` of plastic strain [1] in
 * a load step, without conduction of heat. law: flow law; p: state of the points at the start of the step. */
static ALWAYS_INLINE lanes temperature_after(const struct law *law, const struct part_points *p, lanes more)
{
    if (!(law->heating > 0)) return p->temperature;
    return johnson_cook_adiabatic_temperature(law, p->a, p->a + more, p->temperature);
}

/* Returns the plastic flow t = da/q [1/Pa] of WIDE points (one per vector lane) in a step of any size, by iteration to
 * round-off (da: increment of plastic strain, q: equivalent relative stress). law: flow law; p: trial state of the
 * points; bound: yield stress at the start of the step [Pa]. *back: receives the factors by which the back stress
 * changes in the step (recall_after). space: compile-time constant. */
static ALWAYS_INLINE lanes solve_load_step(const struct law *law, const struct part_points *p, lanes bound,
                                           struct flow_recall *back, const enum space space)
{
    const real C = law->kinematic.modulus, recall = law->kinematic.recall;
    lanes xi[SYM_MAX], fall, slope, t = lanes_broadcast(0);
    struct flow_equation e = equation_at(law, p, lanes_broadcast(1), lanes_broadcast(0), xi, space);
    lanes more = law_plastic_strain_bound_at_yield_stress(law, e.q, p->temperature) - p->a;
    more = lanes_min((e.q - bound) / single_rate(&e, space), more);
    more = lanes_max(more, lanes_broadcast(0));
    back->left = back->added = lanes_broadcast(1);
    const int passes = recall > 0 ? PASSES_RECALL : law->flow == FLOW_LINEAR ? 1 : PASSES;
    for (int k = 0; k < passes; k++) {
        const lanes stress = law_flow_stress(law, p->a + more, temperature_after(law, p, more), &slope);
        const lanes least = lanes_max(stress, lanes_broadcast(LEAST_YIELD * law->young));
        if (recall > 0) *back = recall_after(recall, more);
        e = equation_at(law, p, back->left, C * back->added, xi, space);
        t = equation_solve(&e, least - slope * more, slope, space);
        more = t * equation_stress(&e, t, &fall, space);
    }
    return t;
}

/* Applies plastic flow to WIDE points: computes their increments of plastic strain, strain = 3/2 t xi [1] (components
 * xx yy zz xy yz zx), and changes their stress p->s and back stress p->back accordingly. xi: relative stress (stress
 * minus back stress) at the end of the step [Pa], as relative_stress stores it: in 3D and plane strain the deviator in
 * the same order, in plane stress xx + yy, xx - yy and xy, in 1D the uniaxial stress; t: increment of equivalent
 * plastic strain, divided by the equivalent relative stress [1/Pa]; back: the back stress becomes back->left times
 * itself plus back->added times its linear increment. law: elastic and kinematic constants; space: compile-time
 * constant. */
static ALWAYS_INLINE void flow_apply(const struct law *law, struct part_points *p, const lanes *xi, lanes t,
                                     const struct flow_recall *back, lanes *strain, const enum space space)
{
    const real C = 2.0 / 3 * law->kinematic.modulus, twice = 2 * law->shear;
    if (space == SPACE_LINE) {
        strain[0] = t * xi[0];
        p->s[0] -= law->young * strain[0];
    } else if (space == SPACE_PLANE_STRESS) {
        const lanes sum = 0.5 * t * xi[0], difference = 1.5 * t * xi[1];
        strain[0] = 0.5 * (sum + difference), strain[1] = 0.5 * (sum - difference), strain[2] = -sum;
        strain[3] = 1.5 * t * xi[2];
        const lanes even = 0.5 * law->young / (1 - law->poisson) * sum, odd = law->shear * difference;
        p->s[0] -= even + odd, p->s[1] -= even - odd, p->s[3] -= twice * strain[3];
    } else
        for (int c = 0; c < components(space); c++) strain[c] = 1.5 * t * xi[c], p->s[c] -= twice * strain[c];
    const int last = tensor_components(space);
    for (int c = 0; c < last && law->kinematic.modulus > 0; c++)
        p->back[c] = back->left * p->back[c] + back->added * (C * strain[c]);
}

/* Returns for WIDE points (one per vector lane) the plastic work of a small step per reference volume [J/m^3], by the
 * trapezoidal rule: strain : (s_0 v_0 + s_1 v_1)/2, with the stresses s_0, s_1 and the relative volumes v_0, v_1 at the
 * start and at the end of the step (in p). strain: increments of plastic strain [1], xx yy zz xy yz zx. space:
 * compile-time constant. */
static ALWAYS_INLINE lanes trapezoid(const struct part_points *p, const lanes *strain, const enum space space)
{
    lanes work = lanes_broadcast(0);
    const int last = tensor_components(space);
    for (int c = 0; c < last; c++)
        work += (c < 3 ? 0.5 : 1.0) * (p->volume_before * p->before[c] + p->volume * p->s[c]) * strain[c];
    return work;
}

/* Returns for WIDE points (one per vector lane) the integral of the yield stress over the plastic strain in a load step
 * [J/m^3], in which the plastic strain grows by `more` [1]. law: flow law; p: state at the end of the step, but with
 * the temperature at its start. */
static ALWAYS_INLINE lanes isotropic_work(const struct law *law, const struct part_points *p, lanes more)
{
    if (law->heating > 0)
        return (johnson_cook_adiabatic_temperature(law, p->a - more, p->a, p->temperature) - p->temperature) /
               law->heating;
    return law_flow_stress_integral(law, p->a, p->temperature) -
           law_flow_stress_integral(law, p->a - more, p->temperature);
}

/* Returns for WIDE points (one per vector lane) the plastic work of a load step per reference volume [J/m^3]: the
 * integrals of yield stress and back stress along the path on which the trial stress grows in proportion, at a constant
 * direction of flow. The integral of the back stress over the increment a of plastic strain is X:N b + (C/gamma) (a -
 * b), b = (1 - exp(-gamma a))/gamma; without recall (gamma = 0) X:N a + C a^2/2. law: flow law; p: state at the end of
 * the step; back: back stress X at its start [Pa]; more: increment a [1]; strain: increments of the components of
 * plastic strain [1], xx yy zz xy yz zx. space: compile-time constant. */
static ALWAYS_INLINE lanes path_work(const struct law *law, const struct part_points *p, const lanes *back, lanes more,
                                     const lanes *strain, const enum space space)
{
    const real C = law->kinematic.modulus, recall = law->kinematic.recall;
    const lanes work = isotropic_work(law, p, more);
    lanes along = lanes_broadcast(0);
    if (!(C > 0)) return work;
    for (int c = 0; c < tensor_components(space); c++) along += (c < 3 ? 1.0 : 2.0) * back[c] * strain[c];
    if (space == SPACE_LINE) along *= 1.5; /* the components across */
    if (!(recall > 0)) return work + along + 0.5 * C * more * more;
    const lanes added = recall_after(recall, more).added;
    return work + along * added + C / recall * more * (1.0 - added);
}

/* Maps the trial stresses of WIDE points (one per vector lane) back to the yield surface, and updates their plastic
 * state: stress, back stress, plastic strain, work, temperature. law: flow law; p: trial state of the points, of which
 * only those in the mask p->active may yield. space, mode: compile-time constants, mode LAW_EXPLICIT for small steps or
 * LAW_LOAD_STEP for steps of any size. Returns a mask with bit l set if point l yields; the other points are not
 * changed. */
static ALWAYS_INLINE unsigned points_return(const struct law *law, struct part_points *p, const enum space space,
                                            const enum law_mode mode)
{
    lanes xi[SYM_MAX], strain[SYM_MAX], back[SYM_MAX], slope, fall;
    struct flow_recall recall;
    struct flow_equation e =
        equation_at(law, p, lanes_broadcast(1), lanes_broadcast(law->kinematic.modulus), xi, space);
    const lanes stress = law_flow_stress(law, p->a, p->temperature, &slope);
    const lanes bound = lanes_max(stress, lanes_broadcast(LEAST_YIELD * law->young));
    const lanes_mask yields = p->active & lanes_less(bound, e.q);
    if (!lanes_mask_any(yields)) return 0;
    lanes t = mode == LAW_EXPLICIT ? solve_explicit(law, p, &e, xi, bound, slope, &recall, space)
                                   : solve_load_step(law, p, bound, &recall, space);
    t = lanes_choose(yields, t, lanes_broadcast(0));
    if (law->kinematic.recall > 0) {
        recall.left = lanes_choose(yields, recall.left, lanes_broadcast(1));
        recall.added = lanes_choose(yields, recall.added, lanes_broadcast(1));
        e = equation_at(law, p, recall.left, law->kinematic.modulus * recall.added, xi, space);
    }
    const bool first_differs = space == SPACE_PLANE_STRESS || space == SPACE_LINE;
    const lanes u = first_differs ? 1.0 / (1.0 + e.A * t) : lanes_broadcast(1), v = 1.0 / (1.0 + e.B * t);
    for (int c = 0; c < components(space); c++) xi[c] *= c == 0 && first_differs ? u : v;
    const lanes more = t * equation_stress(&e, t, &fall, space);
    p->a += more;
    for (int c = 0; c < SYM_MAX; c++) back[c] = p->back[c];
    flow_apply(law, p, xi, t, &recall, strain, space);
    if (first_differs && p->thins) p->volume *= 1.0 + (space == SPACE_LINE ? -strain[0] : strain[2]);
    const lanes work =
        mode == LAW_EXPLICIT ? trapezoid(p, strain, space) : path_work(law, p, back, more, strain, space);
    p->work += work;
    /* Strength falls to 0 at T_melt, where heating ends; a large step would pass it with the strength of its start. */
    if (law->heating > 0)
        p->temperature = lanes_min(p->temperature + law->heating * work, lanes_broadcast(law->johnson_cook.T_melt));
    return lanes_mask_bits(yields);
}

/* Returns WIDE consecutive entries of the eight-lane vector *a, from entry number `part` (0, or WIDE) on. */
static ALWAYS_INLINE lanes vector_load_part(const eight_lanes *a, int part)
{
    return lanes_load((const real *)a + part);
}

/* Returns the state of WIDE of the eight material points *p, those from number `part` on. */
static ALWAYS_INLINE struct part_points points_load_part(const struct law_points *p, int part)
{
    struct part_points q = {.duration = p->duration, .thins = p->thins};
    for (int c = 0; c < SYM_MAX; c++) {
        q.s[c] = vector_load_part(&p->s[c], part), q.before[c] = vector_load_part(&p->before[c], part);
        q.back[c] = vector_load_part(&p->back[c], part);
    }
    q.volume_before = vector_load_part(&p->volume_before, part), q.volume = vector_load_part(&p->volume, part);
    q.a = vector_load_part(&p->a, part), q.temperature = vector_load_part(&p->temperature, part),
    q.work = vector_load_part(&p->work, part);
    memcpy(&q.active, (const int64_t *)&p->active + part, sizeof q.active);
    return q;
}

/* Stores the members of *q that points_return changes in *p, the state of eight material points. q: state of WIDE of
 * these points, those from number `part` on. */
static ALWAYS_INLINE void points_store_part(struct law_points *p, const struct part_points *q, int part)
{
    for (int c = 0; c < SYM_MAX; c++)
        lanes_store((real *)&p->s[c] + part, q->s[c]), lanes_store((real *)&p->back[c] + part, q->back[c]);
    lanes_store((real *)&p->volume + part, q->volume), lanes_store((real *)&p->a + part, q->a);
    lanes_store((real *)&p->temperature + part, q->temperature), lanes_store((real *)&p->work + part, q->work);
}

/* Defines the function `name`, which maps the stresses of the eight material points *p back to the yield surface
 * (points_return), WIDE of them at a time. The function returns a mask with a bit for each point that yields. space: of
 * the points; mode: LAW_EXPLICIT or LAW_LOAD_STEP. */
#define UPDATE(name, space, mode)                                                                                      \
    static unsigned name(const struct law *law, struct law_points *p)                                                  \
    {                                                                                                                  \
        unsigned yields = 0;                                                                                           \
        for (int part = 0; part < LANES; part += WIDE) {                                                               \
            struct part_points q = points_load_part(p, part);                                                          \
            const unsigned bits = points_return(law, &q, space, mode);                                                 \
            if (bits) points_store_part(p, &q, part);                                                                  \
            yields |= bits << part;                                                                                    \
        }                                                                                                              \
        return yields;                                                                                                 \
    }
UPDATE(update_line, SPACE_LINE, LAW_EXPLICIT)
UPDATE(update_plane_stress, SPACE_PLANE_STRESS, LAW_EXPLICIT)
UPDATE(update_plane_strain, SPACE_PLANE_STRAIN, LAW_EXPLICIT)
UPDATE(update_solid, SPACE_SOLID, LAW_EXPLICIT)
UPDATE(load_step_line, SPACE_LINE, LAW_LOAD_STEP)
UPDATE(load_step_plane_stress, SPACE_PLANE_STRESS, LAW_LOAD_STEP)
UPDATE(load_step_plane_strain, SPACE_PLANE_STRAIN, LAW_LOAD_STEP)
UPDATE(load_step_solid, SPACE_SOLID, LAW_LOAD_STEP)

unsigned law_update(const struct law *law, struct law_points *p, enum space space, enum law_mode mode)
{
    static unsigned (*const of[][2])(const struct law *, struct law_points *) = {
        [SPACE_LINE] = {update_line, load_step_line},
        [SPACE_PLANE_STRESS] = {update_plane_stress, load_step_plane_stress},
        [SPACE_PLANE_STRAIN] = {update_plane_strain, load_step_plane_strain},
        [SPACE_SOLID] = {update_solid, load_step_solid}};
    return of[space][mode](law, p);
}
