/* Weights of bonds near faces, such that bodies of bonds and families bend, twist and stretch as the continuum does.
 *
 * In a field of linear strain the stretch of a bond is n.eps.n at its middle. With w the weight, r the length and n
 * the direction of a bond, the force on particle i is then (sum w nnn):eps_i + (sum w r nnnn)::grad eps/2. Such a
 * field, if it is one of equilibrium, stays so where
 *
 *     sum w nnn = -M A_i/2        A_i: outward area of the cell of i [spacing^(dim - 1)]
 *     sum w r nnnn = (1 + tau_i) M     M: of a full family of the lattice
 *
 * for the strains that a free face can bear: those whose stress leaves no traction on it. The energy of membranes is
 * exact if tau adds up to nothing; that of bending needs, for every face, tau of moment alpha = 1/24 + <d^2>/8, d being
 * the distance between the middle of a bond and its particle, normal to the face: what the cell's own inertia of area
 * and the bonds' lengths take from the strain that varies across them. The factors nearest to 1 within bounds
 * that meet both in the mean square are found once, when bonds are first made (surface_fit.c). They are positive: so is
 * the energy. Particles with alike surroundings have alike factors. */
#ifndef CLEAVE_SURFACE
#define CLEAVE_SURFACE

#include "bonds/family.h"

struct surface_weights {
    real spacing;               /* of the lattice [m] */
    int reach, dim;             /* of bonds, in spacings; axes */
    int offsets, *offset_at;    /* neighbours of a full family; number of one, by its place in a box of them */
    int32_t classes, *class_of; /* [n] of a particle: alike surroundings; 0: no face nearby */
    uint8_t *mirrors;           /* [n] in which it looks like its class: a bit for each axis */
    real *factor;               /* [classes offsets] on the weight of a bond [1] */
    real *weighted;             /* [classes] sum w r^2 of the family, of reference particles [m^2] */
    int64_t apart[2];           /* where REFUSED: a particle, and the first neighbour or image of one that is
                                   not whole spacings away */
};

/* Finds them for particles of a lattice (REFUSED: they are on none, as to->apart shows). Models with rotations
 * (`rotates`) have another alpha: their neighbours' rotations differ where strain is not uniform, and that takes energy
 * of its own. */
status surface_make(struct surface_weights *to, const struct particles *p, const struct bond_source *s, bool rotates);
void surface_free(struct surface_weights *w);

/* Factor on the weight of the bond of particle i < n with the components xi [m], 1 if that is out of reach; the same
 * bits from both ends. */
static inline real surface_factor(const struct surface_weights *w, int64_t i, const real *xi)
{
    int at = 0;
    if (w->class_of[i] == 0) return 1;
    for (int d = w->dim - 1; d >= 0; d--) {
        const real step = nearbyint(xi[d] / w->spacing);
        if (!(fabs(step) <= w->reach)) return 1;
        at = at * (2 * w->reach + 1) + w->reach + (w->mirrors[i] >> d & 1 ? -(int)step : (int)step);
    }
    return w->offset_at[at] < 0 ? 1 : w->factor[(int64_t)w->class_of[i] * w->offsets + w->offset_at[at]];
}

#endif
