/* State-based peridynamics: sums over families, and the force of a bond that follows from them.
 *
 * With w = omega beta V_i V_j / V0^2, Y the bond now and xi before, r = |xi|, e = |Y| - r, n = Y/|Y|:
 *
 *     Q_i = sum_j w r^2  (or that of a full family: normalisation bulk)
 *     S_i = sum_j w r e / Q_i  (uniform strain: its mean)
 *     P_i = A S_i V_i/Q_i,  g_i = B V_i/Q_i  (both over Q of a full family, where faces are corrected by weights),
 *     R_i the rotation that makes sum_j w |Y - R_i xi|^2 least
 *
 *     ordinary (Silling et al. 2007; Le, Chan & Schwartz 2014, one form for plane stress, plane strain and 3D)
 *         f_i = sum_j w [r (P_i + P_j) + e (g_i + g_j)] n,          A = D^2 (lambda' - G),  B = D (D + 2) G
 *     with effective displacements Y - R xi (modified model of 2026, here for finite rotation; shear exact on lattices)
 *         f_i = sum_j w {r (P_i + P_j) n + [g_i (Y - R_i xi) + g_j (Y - R_j xi)]},   A = D^2 lambda',  B = 2 D G
 *
 * Since R_i makes its own energy least, the force is the energy's exact gradient in cut families too: energy and
 * angular momentum are kept. A material point at the end of bonds has a family, too, of which its bonds see a part:
 * its cell adds the rest of S (particles.end_strain) and gives R (end_rotation), and receives the conjugate
 * reactions: P Q (end_pull), and the moment of the springs about it (end_moment; src/coupling/partial_stress.c). */
#ifndef CLEAVE_KERNELS_STATE_LAWS
#define CLEAVE_KERNELS_STATE_LAWS

#include <math.h>

#include "bond_column.h"
#include "kernels/kernels.h"
#include "kernels/simd/lanes.h"
#include "rotation.h"

#define STATE_TINY 1e-300 /* keeps roots of a padding lane finite */

/* The bonds of a column, as both sweeps see them. */
struct state_bond {
    lanes y[DIM_MAX], xi[DIM_MAX]; /* now and before [m]; xi only where rotations matter */
    lanes distance2;               /* |Y|^2 [m^2] */
    lanes inverse_length;          /* 1/|xi|; of broken bonds maybe the negative [1/m] */
};

static ALWAYS_INLINE bool state_rotates(const enum pd_model model) { return model == PD_MOSPD; }

static ALWAYS_INLINE void state_bond_make(struct state_bond *s, const struct particles *p, const struct column column,
                                          const lanes *x, const lanes *X, const int dim, const enum pd_model model)
{
    s->distance2 = lanes_of(STATE_TINY);
    for (int d = 0; d < dim; d++) {
        s->y[d] = column_at(column, p->x[d]) - x[d];
        s->distance2 += s->y[d] * s->y[d];
        if (state_rotates(model)) s->xi[d] = column_reference(column, p, d, X[d]);
    }
    s->inverse_length = column_inverse_length(column);
}

/* w |xi| or w |xi|^2: factors, of a lattice without the round-off of positions, which no difference magnifies [m],
 * [m^2]. */
static ALWAYS_INLINE lanes state_weight(const struct column s, lanes w, lanes inverse_length, const bool square)
{
    if (s.kind >= COLUMN_WHOLE) return lanes_of(square ? s.stencil->squared : s.stencil->weighted);
    const struct bond_length *known = &s.b->shell_length[s.stencil ? s.stencil->shell : s.b->common[s.number].shell];
    if (s.kind) return w * (square ? known->square : known->length);
    const lanes r = lanes_inverse_root(inverse_length * inverse_length + STATE_TINY);
    return lanes_choose(w > 0.0, square ? w * (r * r) : w * r, lanes_of(0));
}

/* |xi| as what is stored says, so that |xi|/|Y| is 1 but for round-off where nothing has moved; of broken bonds
 * maybe the negative [m]. */
static ALWAYS_INLINE lanes state_length(const struct column s, lanes inverse_length)
{
    if (s.stencil) return lanes_of(s.stencil->length);
    return 1.0 / (s.kind ? inverse_length : lanes_choose(inverse_length != 0.0, inverse_length, lanes_of(1)));
}

/* e/|Y| = 1 - |xi|/|Y|, rounded as a stretch is (bond_column.h). */
#define SHARE_OF(LENGTH, INVERSE) (9.0 - ((LENGTH) * (INVERSE) + 8.0))

#endif
