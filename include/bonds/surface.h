/* Weights of bonds near faces, chosen such that bodies of bonds bend, twist and stretch like the continuum.
 *
 * In a field of linear strain eps the stretch of a bond is n.eps.n at its middle. With the weight w, the
 * length r and the direction n of a bond, the force on particle i is then (sum w nnn):eps_i + (sum w r
 * nnnn)::grad eps/2. A field in equilibrium stays in equilibrium if
 *
 *     sum w nnn = -M A_i/2             A_i: outward area of the cell of particle i [spacing^(dim - 1)]
 *     sum w r nnnn = (1 + tau_i) M     M: sum over a complete neighbourhood of the lattice
 *
 * for the strains that a free face can have, i.e. those whose stress has no traction on it. Behind a plane
 * face tau_i is alpha and -alpha in the first two layers of particles (2 alpha, -3 alpha and alpha in three
 * layers in models with particle rotations), else 0. The energy of membranes is exact, since tau sums to
 * zero. The energy of bending requires alpha = 1/24 + <d^2>/8, d being the distance [spacings], normal to the
 * face, between the two particles of a bond: the terms of the cell's second moment of area, and of the strain
 * that varies along a bond (with particle rotations alpha is empirical). The factors on w nearest to 1,
 * within bounds, that satisfy both equations in the mean square are computed once, when bonds are first made
 * (surface_fit.c). They are positive, and so is the energy. Particles with equal surroundings have equal
 * factors. */
#ifndef CLEAVE_SURFACE
#define CLEAVE_SURFACE

#include "bonds/family.h"

/* Factors by which the weights (factors on the stiffness) of bonds near faces are corrected. They are tabulated by
 * class of the particle (particles with equal surroundings) and by offset (lattice vector from the particle to its
 * neighbour). */
struct surface_correction {
    real spacing;   /* lattice spacing [m] */
    real residual;  /* residual of the least-squares problem divided by that with all factors 1; large if the solver did
                       not converge [1] */
    int reach, dim; /* largest component of a bond vector [spacings]; dimension */
    int offsets, *offset_at; /* neighbours of a particle inside a body; index of an offset by its position in a box */
    int32_t classes, *class_of; /* [n] class of equal surroundings of a particle; 0: no face nearby */
    uint8_t *mirrors; /* [n] axes (bit d for axis d) that must be reversed to map the surroundings of the particle to
                         those of its class */
    real *factor;     /* [classes offsets] factor on the weight of a bond [1] */
    real *weighted;   /* [classes] sum w r^2 of the neighbourhood, of reference particles [m^2] */
    int64_t apart[2]; /* if REFUSED: a particle, and its first neighbour or mirror image that is not a whole number of
                         spacings away */
};

/* Computes the factors on the weights (stiffnesses relative to a full bond) of bonds near faces, for particles p on a
 * lattice, by least squares with bounds. source: inputs of the bonds (horizon, materials, cracks, mirrors);
 * with_rotations: true for the modified state-based model, in which particles rotate; its factors differ because
 * relative rotations of neighbours store energy there. Returns REFUSED, with a message, if the particles are not on a
 * lattice; weights->apart then holds two particles whose distance is not a whole number of spacings (-1 if none was
 * found). Release with surface_correction_free. */
status surface_correction_fit_bond_weight_factors(struct surface_correction *weights, const struct particles *p,
                                                  const struct bond_source *source, bool with_rotations);

/* Releases the arrays of `correction`, the factors on the weights of bonds near faces. */
void surface_correction_free(struct surface_correction *correction);

/* Returns the integer nearest to `value`, halves rounded away from 0. It is quicker than nearbyint. */
static inline int nearest_integer(real value) { return (int)(value + (value < 0 ? -0.5 : 0.5)); }

/* Returns the factor, stored in `weights`, that corrects the weight of a bond of particle i near the surface of the
 * body; 1 if the particle is far from it or `bond_vector` is longer than any bond. bond_vector: reference vector from
 * particle i to its neighbour, dim components [m]; i must not be a mirror image (copy beyond a plane of symmetry). Both
 * particles of a bond obtain bitwise equal factors. */
static inline real surface_correction_bond_weight_factor(const struct surface_correction *weights, int64_t particle,
                                                         const real *bond_vector)
{
    int at = 0;
    if (weights->class_of[particle] == 0) return 1;
    for (int d = weights->dim - 1; d >= 0; d--) {
        const real place = bond_vector[d] / weights->spacing;
        if (!(fabs(place) < weights->reach + 0.5)) return 1;
        const int step = nearest_integer(place);
        at = at * (2 * weights->reach + 1) + weights->reach + (weights->mirrors[particle] >> d & 1 ? -step : step);
    }
    return weights->offset_at[at] < 0
               ? 1
               : weights->factor[(int64_t)weights->class_of[particle] * weights->offsets + weights->offset_at[at]];
}

#endif
