/* The neighbourhood of a peridynamic particle: members, weights, and the sums over a full neighbourhood on the lattice
 * that calibrate the micro-modulus (Silling & Askari 2005; partial volumes: Seleson 2014). */
#include <math.h>
#include <string.h>

#include "bonds/bonds.h"
#include "base/memory.h"

#define DISTANCE_TOLERANCE 1e-7 /* relative: lattice points at exactly the horizon belong to the neighbourhood */

/* Returns the share of the volume of a neighbour at distance r [m] that counts [1]. It falls linearly from 1 to 0 over
 * one spacing about the horizon of the neighbourhood f of a particle. It is rounded to 1e-9: lattice distances that are
 * equal except for round-off then have equal weights. */
static real ramp(const struct family *f, real r)
{
    /* rounded, so that distances equal on paper have equal weights */
    real share = (f->horizon + 0.5 * f->spacing - r) / f->spacing;
    share = nearbyint(share * 1e9) * 1e-9;
    return share > 1 ? 1 : share < 0 ? 0 : share;
}

/* Returns the share beta of the volume of a neighbour at distance r [m] that counts [1] (Seleson 2014); 1 if the
 * neighbourhood f of a particle uses whole volumes. */
static real family_beta(const struct family *f, real r) { return f->volume == VOLUME_WHOLE ? 1 : ramp(f, r); }

/* Returns the influence function omega [1] of the neighbourhood f of a particle for a neighbour at distance r [m]. */
static real influence(const struct family *f, real r)
{
    switch (f->influence) {
    case INFLUENCE_GAUSSIAN:
        return exp(-square(r / f->horizon));
    case INFLUENCE_INVERSE:
        return f->horizon / r;
    case INFLUENCE_INVERSE_SQUARE:
        return square(f->horizon / r);
    case INFLUENCE_LINEAR:
        return 1 - r / (f->horizon + f->spacing);
    default:
        return 1;
    }
}

/* Returns the factor with which a bond of length r [m] contributes to the elastic constants of a lattice, up to a
 * constant. With the influence function omega of the neighbourhood f it is omega r if the energy of a bond is quadratic
 * in its stretch, and omega r^2 if it is quadratic in its elongation. If it is quadratic in the relative displacement
 * vector, the lattice is isotropic for any factors by direction; the factor is then r, as without influence
 * function. */
static real stiffness_weight(const struct family *f, real r)
{
    switch (f->energy) {
    case ENERGY_OF_STRETCH:
        return influence(f, r) * r;
    case ENERGY_OF_ELONGATION:
        return f->influence == INFLUENCE_INVERSE ? r : influence(f, r) * r * (r / f->horizon);
    default:
        return r;
    }
}

/* Returns the distance r [m] with the round-off of positions removed: the lattice distance spacing sqrt(k) nearest to
 * r, with a whole number k, if r is one up to round-off, else r. Bonds of equal length then have weights that are equal
 * to the last bit. f: has the spacing. */
static real true_length(const struct family *f, real r)
{
    const real squares = square(r / f->spacing), whole = floor(squares + 0.5);
    return fabs(squares - whole) < 1e-9 * whole ? f->spacing * sqrt(whole) : r;
}

real family_bond_weight(const struct family *f, const real *bond_vector, real bond_length)
{
    int dim = space_dim(f->space);
    real fourth = 0;
    if (family_bonds_have_equal_weights(f)) return f->shell_weight[0];
    bond_length = true_length(f, bond_length);
    for (int d = 0; d < dim; d++) fourth += square(square(bond_vector[d] / bond_length));
    /* mean of n1^4 + n2^4 + n3^4 over all directions: 1, 3/4, 3/5 */
    bool axial = fourth > 3.0 / (dim + 2) + 1e-9;
    return family_beta(f, bond_length) * influence(f, bond_length) * f->shell_weight[axial ? 0 : 1];
}

/* Sums over all neighbours of a particle inside a lattice. r: distance [m]; V: volume of a lattice cell; beta: share
 * of V that counts; n: unit vector of the bond. Class 0 are bonds nearer the axes, class 1 bonds nearer the
 * diagonals. */
struct lattice_sums {
    real volume;             /* sum of V beta [m^3] */
    real sigma;              /* sum of r V beta times the shell weight [m^4] */
    real weighted;           /* sum of r^2 times the weights that bonds store [m^2] */
    real axial[2], mixed[2]; /* sums of n1^4 and of n1^2 n2^2 times V beta stiffness_weight, by class of direction */
};

/* Adds the lattice point at xi[dim] [m] relative to a particle to the sums *s over its neighbourhood f. Does nothing if
 * the point is outside the cutoff or is the particle itself. */
static void sum_point(const struct family *f, const real *xi, int dim, struct lattice_sums *s)
{
    real r = sqrt(dot(xi, xi, dim)), V = f->cell_volume;
    if (r == 0 || r > f->cutoff) return;
    real beta = family_beta(f, r), fourth = 0;
    for (int d = 0; d < dim; d++) fourth += square(square(xi[d] / r));
    int class = fourth > 3.0 / (dim + 2) + 1e-9 ? 0 : 1;
    s->volume += V * beta;
    s->sigma += r * V * family_bond_weight(f, xi, r);
    s->weighted += r * r * family_bond_weight(f, xi, r);
    const real weight = stiffness_weight(f, r) * V * beta;
    s->axial[class] += weight * fourth / dim;
    s->mixed[class] += dim > 1 ? weight * (1 - fourth) / (dim * (dim - 1)) : 0;
}

/* Returns the sums of volume, bond length, weight and direction (struct lattice_sums) over all lattice points within
 * the cutoff of a particle inside a body. The constants of the neighbourhood f follow from these sums: volume f->full,
 * weighted volume f->weighted and the factors f->shell_weight. f: spacing, cutoff and influence function. */
static struct lattice_sums lattice_sums(const struct family *f)
{
    struct lattice_sums s = {0};
    int dim = space_dim(f->space), reach = (int)ceil(f->cutoff / f->spacing);
    int low[DIM_MAX] = {0}, high[DIM_MAX] = {0};
    for (int d = 0; d < dim; d++) low[d] = -reach, high[d] = reach;
    for (int c = low[2]; c <= high[2]; c++)
        for (int b = low[1]; b <= high[1]; b++)
            for (int a = low[0]; a <= high[0]; a++) {
                real xi[DIM_MAX] = {a * f->spacing, b * f->spacing, c * f->spacing};
                sum_point(f, xi, dim, &s);
            }
    return s;
}

/* Computes the two factors f->shell_weight, of bonds nearer the axes and of bonds nearer the diagonals, such that the
 * neighbourhood f is isotropic: sum k n1^4 = 3 sum k n1^2 n2^2 with k of stiffness_weight, i.e. C11 = C12 + 2 C44 with
 * C12 = C44. They are scaled so that sum r omega V does not change. If there is no solution, or in 1D, the factors
 * remain as they are. */
static void shells_isotropic(struct family *f)
{
    if (space_dim(f->space) == 1) return;
    struct lattice_sums s = lattice_sums(f);
    real ratio = -(s.axial[1] - 3 * s.mixed[1]) /
                 (s.axial[0] - 3 * s.mixed[0]);  /* weight near the axes over weight near the diagonals */
    if (!(ratio > 0 && isfinite(ratio))) return; /* horizon of one spacing: there are no diagonal bonds */
    f->shell_weight[0] = ratio, f->shell_weight[1] = 1;
    real scale = s.sigma / lattice_sums(f).sigma;
    f->shell_weight[0] *= scale, f->shell_weight[1] *= scale;
}

void family_make_on_lattice(struct family *f, enum space space, real spacing, real horizon_in_spacings,
                            real cross_section)
{
    f->space = space;
    f->spacing = spacing;
    f->section = cross_section;
    f->cell_volume = lattice_particle_volume(cross_section, spacing, space_dim(space));
    f->horizon = horizon_in_spacings * spacing;
    f->shell_weight[0] = f->shell_weight[1] = 1;
    if (f->calibration == CALIBRATION_VMPD) /* whole neighbours cover (m + 1/2) spacings exactly (Zeng et al. 2021) */
        f->horizon = (floor(horizon_in_spacings * (1 + DISTANCE_TOLERANCE)) + 0.5) * spacing;
    f->cutoff = f->volume == VOLUME_RAMP ? f->horizon + 0.5 * spacing : f->horizon;
    f->cutoff *= 1 + DISTANCE_TOLERANCE;
    if (f->shells == SHELLS_ISOTROPIC) shells_isotropic(f);
    f->full = lattice_sums(f).volume;
    f->weighted = lattice_sums(f).weighted;
}

/* Returns the mean of the influence function omega over the horizon d of the neighbourhood f, weighted with the energy
 * of bonds under uniform dilatation [1]: (n + 1)/d^(n + 1) times the integral of r^n omega(r) from 0 to d, in n
 * dimensions. It is infinite for omega = (d/r)^2 in 1D. */
static real influence_mean(const struct family *f)
{
    const int n = space_dim(f->space);
    const real power = n + 1, e = exp(-1);
    /* integral of x^n exp(-x^2) from 0 to 1, with pi = 4 atan(1) */
    const real gaussian[DIM_MAX + 1] = {[1] = (1 - e) / 2, [2] = sqrt(4 * atan(1)) / 4 * erf(1) - e / 2, [3] = 0.5 - e};
    switch (f->influence) {
    case INFLUENCE_GAUSSIAN:
        return power * gaussian[n];
    case INFLUENCE_INVERSE:
        return power / n;
    case INFLUENCE_INVERSE_SQUARE:
        return power / (n - 1);
    case INFLUENCE_LINEAR:
        return 1 - power / (n + 2) * f->horizon / (f->horizon + f->spacing);
    default:
        return 1;
    }
}

real family_micro_modulus(const struct family *f, const struct material *m)
{
    if (f->calibration == CALIBRATION_LATTICE)
        return material_micro_modulus_of_discrete_family(m, f->space, lattice_sums(f).sigma);
    return material_micro_modulus_of_continuum(m, f->space, f->horizon, f->section) / influence_mean(f);
}

void family_compute_cubic_elastic_constants(const struct family *f, const struct material *m, real *c11, real *c12)
{
    const int reach = (int)ceil(f->cutoff / f->spacing), dim = space_dim(f->space);
    const real scale = 0.5 * family_micro_modulus(f, m) * f->cell_volume;
    *c11 = *c12 = 0;
    for (int z = dim > 2 ? -reach : 0; z <= (dim > 2 ? reach : 0); z++)
        for (int y = dim > 1 ? -reach : 0; y <= (dim > 1 ? reach : 0); y++)
            for (int x = -reach; x <= reach; x++) {
                const real xi[DIM_MAX] = {x * f->spacing, y * f->spacing, z * f->spacing}, r = sqrt(dot(xi, xi, dim));
                if (r == 0 || r > f->cutoff) continue;
                const real k = scale * family_bond_weight(f, xi, r) / (r * r * r);
                *c11 += k * square(square(xi[0])), *c12 += k * square(xi[0] * xi[1]);
            }
}
