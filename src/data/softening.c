/* Computes the curves by which bonds soften, the energy that they dissipate, and the strength of a uniformly strained
 * body of softening bonds. */
#include "data/softening_states.h"

#define DECAY 5.0 /* exponent of exponential softening at its end */

/* ---- curves ------------------------------------------------------------------------------------------------------ */

/* Stores in *c the convex softening curve through the points (x[k], y[k]), k = 0 .. pieces: its straight lines, and the
 * area below them. x ascends from 0 to 1, y descends to 0. */
static void curve_through(struct softening_curve *c, int pieces, const real *x, const real *y)
{
    *c = (struct softening_curve){.pieces = pieces};
    for (int k = 0; k < pieces; k++) {
        c->slope[k] = (y[k] - y[k + 1]) / (x[k + 1] - x[k]);
        c->level[k] = y[k] + c->slope[k] * x[k];
        c->from[k] = x[k];
        c->area += 0.5 * (y[k] + y[k + 1]) * (x[k + 1] - x[k]);
    }
    c->from[pieces] = 1;
}

/* Computes the points (x[k], y[k]), k = 0 .. SOFTENING_PIECES, of a curve of straight lines that replaces the
 * exponential softening curve y = (exp(-DECAY x) - exp(-DECAY))/(1 - exp(-DECAY)), from (0, 1) to (1, 0). y: force of a
 * bond divided by the force at the onset of softening; x: (s - s_0)/(s_f - s_0) with the stretch s of the bond, the
 * onset s_0 and the breaking stretch s_f. The points are denser where the curve is more curved, as the square root of
 * its curvature, so that all lines deviate from the curve equally. */
static void exponential_points(real *x, real *y)
{
    const real last = exp(-DECAY), whole = 1 - exp(-0.5 * DECAY);
    for (int k = 0; k <= SOFTENING_PIECES; k++) {
        x[k] = -2 / DECAY * log1p(-whole * k / SOFTENING_PIECES);
        y[k] = (exp(-DECAY * x[k]) - last) / (1 - last);
    }
    x[SOFTENING_PIECES] = 1, y[SOFTENING_PIECES] = 0;
}

/* Returns the softening curve of `law`: the force of a bond, divided by the force at the onset, as a function of x = (s
 * - s_0)/(s_f - s_0) from 0 to 1, with the stretch s, its onset s_0 and its end s_f. The bilinear curve of concrete has
 * its kink at x = 2/9 and 1/3 of the force (Petersson 1981). */
struct softening_curve softening_curve_of_law(enum softening law)
{
    struct softening_curve c;
    real x[SOFTENING_PIECES + 1], y[SOFTENING_PIECES + 1];
    if (law == SOFTENING_LINEAR)
        curve_through(&c, 1, (const real[]){0, 1}, (const real[]){1, 0});
    else if (law == SOFTENING_BILINEAR)
        curve_through(&c, 2, (const real[]){0, 2.0 / 9, 1}, (const real[]){1, 1.0 / 3, 0});
    else
        exponential_points(x, y), curve_through(&c, SOFTENING_PIECES, x, y);
    return c;
}

/* Returns the area below the softening curve c from 0 to x [1], 0 <= x <= 1. */
static real area_to(const struct softening_curve *c, real x)
{
    real area = 0;
    for (int k = 0; k < c->pieces && c->from[k] < x; k++) {
        const real from = c->from[k], to = real_min(x, c->from[k + 1]);
        area += (to - from) * (c->level[k] - 0.5 * c->slope[k] * (from + to));
    }
    return area;
}

real softening_normalised_dissipated_energy(const struct softening_curve *c, real onset_stretch, real breaking_stretch,
                                            real largest_stretch)
{
    const real x = real_min(1, (largest_stretch - onset_stretch) / (breaking_stretch - onset_stretch));
    if (!(x > 0)) return 0;
    const real force = onset_stretch * softening_curve_normalised_force(c, x);
    return 0.5 * square(onset_stretch) + onset_stretch * (breaking_stretch - onset_stretch) * area_to(c, x) -
           0.5 * force * real_min(largest_stretch, breaking_stretch);
}

/* ---- uniform strain ---------------------------------------------------------------------------------------------- */

enum { DIRECTIONS = 128, BISECTIONS = 40 }; /* directions of a quadrature over bonds; steps of a bisection */
/* Numbers of directions of an octant: heights above a plane, and directions round its normal. */
enum { HEIGHTS = 48, TURNS = 48 };
enum { ITERATIONS = 100 }; /* largest number of secant iterations for the strains of shear in space */
#define STRAIN_ERROR 1e-7  /* difference of two such strains that counts as 0, in units of s_0 */
#define GROWTH 1.01        /* factor between two strains of the search for a peak */

/* Axial and lateral stress of a neighbourhood of bonds, divided by E' s_0: modulus times stretch at which bonds begin
 * to soften [1]. */
struct stress_pair {
    real axial, lateral;
};

/* A neighbourhood of bonds of all directions, with its softening curve. reach: (s_f - s_0)/s_0, with the stretches s_0
 * at which softening begins and s_f at which it ends [1]. */
struct directions {
    const struct softening_curve *curve;
    enum space space;
    real reach;
    const struct softening_model *model;
};

/* Returns the force of a softening bond at the stretch s, divided by its stiffness, its weight and s_0 [1]. s is in
 * units of s_0, the stretch at which softening begins. The force equals s up to s = 1, then follows the softening curve
 * of a, and is 0 where the curve has ended. */
static real bond_tension(const struct directions *a, real s)
{
    if (s <= 1) return s;
    return a->reach > 0 ? softening_curve_normalised_force(a->curve, (s - 1) / a->reach) : 0;
}

/* Returns the secant stiffness of a softening bond at the stretch s, divided by its initial stiffness [1]. s is in
 * units of s_0, the stretch at which softening begins. a: softening curve. */
static real bond_share(const struct directions *a, real s) { return s <= 1 ? 1 : bond_tension(a, s) / s; }

/* Returns cos^2 of the angle between the axis of tension and direction number k, 0 to DIRECTIONS - 1, of the quadrature
 * over all directions of bonds in the space of a [1]. */
static real direction_along(const struct directions *a, int k)
{
    const real at = (k + 0.5) / DIRECTIONS;
    return a->space == SPACE_SOLID ? square(at) : square(cos(0.5 * M_PI * at));
}

/* Returns the axial and lateral stress of a neighbourhood of state-based bonds, divided by E' s_0 [1]. axial, lateral:
 * strains, in units of s_0, the stretch at which softening begins. The stresses are the derivatives, by the strains, of
 * the energy W = [A <q s>^2 + B <q |e|^2>]/2, with the constants A and B of the model. < > is the mean over all
 * directions n, q the share of its stiffness that a softened bond keeps, and s its stretch. e is the stretch s too, or
 * in models with rotations the vector eps . n. */
static struct stress_pair state_family_stress(const struct directions *a, real axial, real lateral)
{
    const struct softening_model *m = a->model;
    const real across_axes = space_dim(a->space) - 1;
    struct stress_pair pull = {0, 0}, sum = {0, 0};
    real mean = 0;
    for (int k = 0; k < DIRECTIONS; k++) {
        const real along = direction_along(a, k), across = (1 - along) / across_axes;
        const real s = axial * along + lateral * (1 - along), share = bond_share(a, s) / DIRECTIONS;
        mean += share * s;
        pull.axial += share * along, pull.lateral += share * across;
        sum.axial += share * along * (m->rotates ? axial : s),
            sum.lateral += share * across * (m->rotates ? lateral : s);
    }
    return (struct stress_pair){m->A * mean * pull.axial + m->B * sum.axial,
                                m->A * mean * pull.lateral + m->B * sum.lateral};
}

/* Returns the axial and lateral stress of a neighbourhood of bonds in all directions, divided by E' s_0 [1]. axial,
 * lateral: strains along one axis and in all directions normal to it, in units of s_0, the stretch at which softening
 * begins. Bond-based models have Poisson's ratio 1/3 in the plane and 1/4 in 3D; in plane strain E' and nu/(1 - nu)
 * replace E and nu. */
static struct stress_pair family_stress(const struct directions *a, real axial, real lateral)
{
    struct stress_pair sum = {0, 0};
    if (a->space == SPACE_LINE) return (struct stress_pair){bond_tension(a, axial), 0};
    if (a->model->B > 0) return state_family_stress(a, axial, lateral);
    for (int k = 0; k < DIRECTIONS; k++) {
        const real along = direction_along(a, k), across = 1 - along;
        const real force = bond_tension(a, axial * along + lateral * across);
        sum.axial += force * along, sum.lateral += force * across;
    }
    const real axial_factor = a->space == SPACE_SOLID ? 6 : 3, lateral_factor = 3;
    return (struct stress_pair){sum.axial * axial_factor / DIRECTIONS, sum.lateral * lateral_factor / DIRECTIONS};
}

/* Returns the strain x, in units of s_0, at which the function stress(a, x, given) is 0, by bisection. The function
 * must grow with x and have its root between `low` and 0. a: neighbourhood of bonds; given: the other strain of the
 * function. s_0: stretch at which softening begins. */
static real strain_without_stress(const struct directions *a, real low, real given,
                                  real (*stress)(const struct directions *, real x, real given))
{
    real high = 0;
    for (int k = 0; k < BISECTIONS; k++) {
        const real middle = 0.5 * (low + high);
        if (stress(a, middle, given) > 0)
            high = middle;
        else
            low = middle;
    }
    return 0.5 * (low + high);
}

/* Returns the lateral stress of the neighbourhood of bonds a, divided by E' s_0 [1], as a function of the lateral
 * strain, whose zero strain_without_stress finds; axial: axial strain. Strains are in units of s_0, the stretch at
 * which softening begins. */
static real lateral_stress(const struct directions *a, real lateral, real axial)
{
    return family_stress(a, axial, lateral).lateral;
}

/* Returns the axial stress of the neighbourhood of bonds a, divided by E' s_0 [1], as a function of the axial strain,
 * whose zero strain_without_stress finds; lateral: lateral strain. Strains are in units of s_0, the stretch at which
 * softening begins. */
static real axial_stress(const struct directions *a, real axial, real lateral)
{
    return family_stress(a, axial, lateral).axial;
}

/* Returns the sum of axial and lateral stress of the neighbourhood of bonds a, divided by E' s_0 [1], whose zero
 * strain_without_stress finds: the state is then one of shear. lateral, axial: strains in units of s_0, the stretch at
 * which softening begins. */
static real stress_sum(const struct directions *a, real lateral, real axial)
{
    const struct stress_pair stress = family_stress(a, axial, lateral);
    return stress.axial + stress.lateral;
}

/* Returns the axial stress of the neighbourhood of bonds a in uniaxial tension, divided by E' s_0 [1]. strain: axial
 * strain in units of s_0, the stretch at which softening begins; the lateral stress is 0 (in 1D the lateral strain). */
static real tension_at(const struct directions *a, real strain)
{
    const real lateral = a->space == SPACE_LINE ? 0 : strain_without_stress(a, -strain, strain, lateral_stress);
    return family_stress(a, strain, lateral).axial;
}

/* Returns the stress of the neighbourhood of bonds a in equal biaxial tension without stress along the third axis,
 * divided by E' s_0 [1]. strain: strain along the two axes in units of s_0, the stretch at which softening begins.
 * Returns NAN in 1D. */
static real biaxial_at(const struct directions *a, real strain)
{
    if (a->space == SPACE_LINE) return NAN;
    if (a->space != SPACE_SOLID) return family_stress(a, strain, strain).axial;
    return family_stress(a, strain_without_stress(a, -2 * strain, strain, axial_stress), strain).lateral;
}

/* Computes the secant stiffness C of the neighbourhood of bonds a in space, divided by E': its principal stresses at
 * the principal strains strain[3] are E' times the sum over j of C[i][j] strain[j]. strain: in units of s_0, the
 * stretch at which softening begins. The mean over all directions is that over one octant. */
static void solid_secant_stiffness(const struct directions *a, const real strain[3], real C[3][3])
{
    const struct softening_model *m = a->model;
    const bool bonds = !(m->B > 0);
    real mean[3] = {0}, product[3][3] = {{0}}, cos2[TURNS], sin2[TURNS];
    for (int k = 0; k < TURNS; k++) {
        const real angle = 0.5 * M_PI * (k + 0.5) / TURNS;
        cos2[k] = square(cos(angle)), sin2[k] = square(sin(angle));
    }
    for (int k = 0; k < HEIGHTS * TURNS; k++) {
        const real height = (k / TURNS + 0.5) / HEIGHTS, flat = 1 - square(height);
        const real n2[3] = {flat * cos2[k % TURNS], flat * sin2[k % TURNS], square(height)};
        const real share = bond_share(a, dot(n2, strain, 3)) / (HEIGHTS * TURNS);
        for (int i = 0; i < 3; i++) {
            mean[i] += share * n2[i];
            for (int j = 0; j < 3; j++) product[i][j] += share * n2[i] * n2[j];
        }
    }
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const real own = m->rotates ? (i == j ? mean[i] : 0) : product[i][j];
            C[i][j] = bonds ? 6 * product[i][j] : m->A * mean[i] * mean[j] + m->B * own;
        }
}

/* Returns the shear stress of the neighbourhood of bonds a in space, divided by E' s_0 [1], in a state with equal
 * tension and compression along two axes and no stress along the third. strain: strain along the axis of tension, in
 * units of s_0, the stretch at which softening begins. The other two strains are found by iteration on secants. */
static real solid_shear_at(const struct directions *a, real strain)
{
    real e[3] = {strain, -strain, 0}, C[3][3] = {{0}}, moved = INFINITY;
    for (int k = 0; k < ITERATIONS && moved > STRAIN_ERROR; k++) {
        solid_secant_stiffness(a, e, C);
        const real across = C[0][1] + C[1][1], along = C[0][0] + C[1][0], out = C[0][2] + C[1][2];
        const real two = (C[2][0] * out - along * C[2][2]) / (across * C[2][2] - C[2][1] * out) * strain;
        const real three = -(C[2][0] * strain + C[2][1] * two) / C[2][2];
        moved = real_max(fabs(two - e[1]), fabs(three - e[2]));
        e[1] = two, e[2] = three;
    }
    return dot(C[0], e, 3);
}

/* Returns the shear stress of the neighbourhood of bonds a, divided by E' s_0 [1], in a state with equal tension and
 * compression along two axes and, in space, no stress along the third. strain: strain along the axis of tension, in
 * units of s_0, the stretch at which softening begins. Returns NAN in 1D. */
static real shear_at(const struct directions *a, real strain)
{
    if (a->space == SPACE_LINE) return NAN;
    if (a->space == SPACE_SOLID) return solid_shear_at(a, strain);
    return family_stress(a, strain, strain_without_stress(a, -10 * strain, strain, stress_sum)).axial;
}

/* Returns the largest value of the function stress(a, strain) as the strain grows, divided by E' s_0, which is the
 * strength of the material. a: neighbourhood of bonds. The search begins at the strain at which softening begins. It
 * ends when the stress has fallen to 0.8 of the maximum, or when all bonds have failed. Returns NAN if the stress is
 * not defined in this space. */
static real peak(const struct directions *a, real (*stress)(const struct directions *, real))
{
    real most = 0;
    for (real strain = 1; strain < 2 * (1 + a->reach); strain *= GROWTH) {
        const real now = stress(a, strain);
        if (isnan(now)) return NAN;
        if (now < 0.8 * most) break;
        most = real_max(most, now);
    }
    return most;
}

static const struct softening_model bond_based = {0, 0, false};

struct softening_strength softening_model_normalised_peak_stresses(const struct softening_curve *c, enum space space,
                                                                   real squared_stretch_ratio,
                                                                   const struct softening_model *model)
{
    const struct directions a = {c, space, (squared_stretch_ratio - 1) / (2 * c->area), model};
    return (struct softening_strength){peak(&a, tension_at), peak(&a, biaxial_at), peak(&a, shear_at)};
}

struct softening_strength softening_curve_normalised_peak_stresses(const struct softening_curve *c, enum space space,
                                                                   real squared_stretch_ratio)
{
    return softening_model_normalised_peak_stresses(c, space, squared_stretch_ratio, &bond_based);
}

real softening_model_onset_stretch_from_strength(const struct material *m, enum space space,
                                                 const struct softening_model *model)
{
    const struct softening_curve c = softening_curve_of_law(m->softening);
    const real strain = m->tensile_strength / material_uniaxial_tension_modulus(m, space);
    real onset = strain;
    for (int k = 0; k < 20; k++) {
        const real kappa = square(m->critical_stretch / onset);
        if (!(kappa > 1)) break;
        const struct directions a = {&c, space, (kappa - 1) / (2 * c.area), model};
        const real next = strain / peak(&a, tension_at);
        if (fabs(next - onset) < 1e-9 * onset) break;
        onset = next;
    }
    return onset;
}

real softening_onset_stretch_from_strength(const struct material *m, enum space space)
{
    return softening_model_onset_stretch_from_strength(m, space, &bond_based);
}

/* ---- rates ------------------------------------------------------------------------------------------------------- */

/* Interpolates a quantity that is table_values[k] at the strain rate r->rate[k] to the strain rate `strain_rate`
 * [1/s] and returns it: linear in the logarithm of the rate, constant beyond the table. */
real strength_rate_table_interpolate_in_log_rate(const struct strength_rate *r, const real *table_values,
                                                 real strain_rate)
{
    int k = 0;
    while (k < r->points && r->rate[k] < strain_rate) k++;
    if (k == 0 || k == r->points) return table_values[k == 0 ? 0 : k - 1];
    const real part = log(strain_rate / r->rate[k - 1]) / log(r->rate[k] / r->rate[k - 1]);
    return table_values[k - 1] + part * (table_values[k] - table_values[k - 1]);
}

real strength_rate_compute_softening_onset_factors(struct material *m, enum space space,
                                                   const struct softening_model *model)
{
    real least = INFINITY;
    for (int k = 0; k < m->rate.points; k++) {
        struct material stronger = *m;
        stronger.tensile_strength *= m->rate.factor[k];
        const real onset = softening_model_onset_stretch_from_strength(&stronger, space, model);
        m->rate.onset[k] = onset / m->onset_stretch;
        least = real_min(least, square(m->critical_stretch / onset));
    }
    return least;
}
