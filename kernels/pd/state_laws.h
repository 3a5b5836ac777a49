/* State-based peridynamics: the sums over neighbourhoods, and the bond force that follows from them.
 *
 * With w = omega beta V_i V_j / V0^2 (influence function omega, fraction beta of the neighbour's volume V_j
 * within the horizon, volume V0 of a lattice cell), Y the deformed and xi the reference bond vector, r =
 * |xi|, e = |Y| - r, n = Y/|Y|:
 *
 *     Q_i = sum_j w r^2            weighted volume (normalisation bulk: of a full neighbourhood)
 *     S_i = sum_j w r e / Q_i      mean stretch (of uniform dilatation: the strain)
 *     P_i = A S_i V_i/Q_i,  g_i = B V_i/Q_i    pressure and spring (surface weights: Q of a full neighbourhood),
 *     R_i the rotation that minimises sum_j w |Y - R_i xi|^2
 *
 *     ordinary (Silling et al. 2007; Le, Chan & Schwartz 2014; one form for plane stress, plane strain and 3D)
 *         f_i = sum_j w [r (P_i + P_j) + e (g_i + g_j)] n,          A = D^2 (lambda' - G),  B = D (D + 2) G
 *     modified, with effective displacements Y - R xi (doi 10.1007/s11804-026-00791-z, here for finite rotation; exact
 *     for shear on lattices)
 *         f_i = sum_j w {r (P_i + P_j) n + [g_i (Y - R_i xi) + g_j (Y - R_j xi)]},   A = D^2 lambda',  B = 2 D G
 *
 * with the dimension D, the shear modulus G and lambda' = C12. Since R_i minimises the energy of its
 * neighbourhood, the force is the exact gradient of the energy in cut neighbourhoods too: energy and angular
 * momentum are conserved. A material point with state-based bonds has a neighbourhood of which its bonds are
 * only one part. Its cell adds the rest of S (particles.end_strain), gives R (end_rotation), and receives the
 * conjugate reactions: P Q (end_pull) and the moment of the springs about the point (end_moment;
 * src/coupling/partial_stress.c). */
#ifndef CLEAVE_KERNELS_STATE_LAWS
#define CLEAVE_KERNELS_STATE_LAWS

#include <math.h>

#include "bond_column.h"
#include "kernels/kernels.h"
#include "kernels/simd/lanes.h"
#include "rotation.h"

#define STATE_TINY 1e-300 /* keeps roots of a padding lane finite */

/* Vectors and lengths of the eight bonds of a column (one bond of each particle of a block of eight rows), for both
 * loops of a state-based force. */
struct state_bond_vectors {
    lanes y[DIM_MAX], xi[DIM_MAX]; /* deformed and reference vector [m]; xi only in models with rotations */
    lanes distance2;               /* |Y|^2 [m^2] */
    lanes inverse_length;          /* 1/|xi|; may be negative for broken bonds [1/m] */
};

/* Returns true if the peridynamic model `model` has rotations of the particles: PD_MOSPD, the modified state-based
 * model. */
static ALWAYS_INLINE bool state_model_has_rotations(const enum pd_model model) { return model == PD_MOSPD; }

/* Computes vectors and lengths of the eight bonds of `column` (one bond of each of eight particles of p) into *s.
 * model: peridynamic model; x, X: [dim] present and reference positions of these eight particles [m]; X is read only in
 * models with rotations of the particles. */
static ALWAYS_INLINE void state_bonds_compute_vectors_and_lengths(struct state_bond_vectors *s,
                                                                  const struct particles *p,
                                                                  const struct bond_column_view column, const lanes *x,
                                                                  const lanes *X, const int dim,
                                                                  const enum pd_model model)
{
    s->distance2 = lanes_broadcast(STATE_TINY);
    for (int d = 0; d < dim; d++) {
        s->y[d] = bond_column_gather_neighbour_values(column, p->x[d]) - x[d];
        s->distance2 += s->y[d] * s->y[d];
        if (state_model_has_rotations(model)) s->xi[d] = bond_column_reference_vector_component(column, p, d, X[d]);
    }
    s->inverse_length = bond_column_inverse_lengths(column);
}

/* Returns weight (factor on the force) times reference length, w |xi| [m], of the eight bonds of `column` (one bond of
 * each of eight particles), or w |xi|^2 [m^2] if `square` is true. On a lattice |xi| is the exact length of the lattice
 * shell, without the round-off of positions. w, inverse_length: weights [1] and inverse lengths [1/m] of the bonds. */
static ALWAYS_INLINE lanes state_bonds_weight_times_reference_length(const struct bond_column_view column, lanes w,
                                                                     lanes inverse_length, const bool square)
{
    if (column.kind >= COLUMN_WHOLE)
        return lanes_broadcast(square ? column.stencil->squared : column.stencil->weighted);
    const struct bond_length *known =
        &column.b->shell_length[column.stencil ? column.stencil->shell : column.b->common[column.number].shell];
    if (column.kind) return w * (square ? known->square : known->length);
    const lanes r = lanes_inverse_square_root(inverse_length * inverse_length + STATE_TINY);
    return lanes_choose(w > 0.0, square ? w * (r * r) : w * r, lanes_broadcast(0));
}

/* Returns the reference lengths |xi| [m] of the eight bonds of `column` (one bond of each of eight particles): the
 * tabulated one if the bonds have a stencil in common, else 1/inverse_length (inverse_length: [1/m]). Then |xi| divided
 * by the present length is 1 up to round-off where nothing has moved. Broken bonds, whose inverse length is negative,
 * get a negative length; empty entries, whose inverse length is 0, get 1. */
static ALWAYS_INLINE lanes state_bonds_reference_length(const struct bond_column_view column, lanes inverse_length)
{
    if (column.stencil) return lanes_broadcast(column.stencil->length);
    return 1.0 /
           (column.kind ? inverse_length : lanes_choose(inverse_length != 0.0, inverse_length, lanes_broadcast(1)));
}

/* Computes the extension of a bond divided by its present length, e/|Y| = 1 - |xi|/|Y|, rounded as in STRETCH_OF
 * (bond_column.h), so that it is exactly 0 where nothing has moved. LENGTH: reference length |xi| [m]; INVERSE: inverse
 * of the present length, 1/|Y| [1/m]. */
#define SHARE_OF(LENGTH, INVERSE) (9.0 - ((LENGTH) * (INVERSE) + 8.0))

#endif
