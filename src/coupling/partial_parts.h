/* Geometry and response of bonds that cross the cell of a particle, shared by partial stress and reversion. */
#ifndef CLEAVE_PARTIAL_PARTS
#define CLEAVE_PARTIAL_PARTS

#include "bonds/bonds.h"

/* Share of the segment a-b inside the cube of half edge `half` round X. */
real segment_share(const real *a, const real *b, const real *X, real half, int dim);

/* Reflection by a chain of mirrors: the image of a point X of the body has X'_d = sign_d X_d + offset_d; `root` is the
 * source of image i, or i itself. */
struct reflection {
    real sign[DIM_MAX], offset[DIM_MAX];
    int64_t root;
};
struct reflection reflection_of(const struct bond_source *s, const struct particles *p, int64_t i);

/* Response of the force F of a bond of direction e to a uniform strain eps, times the bond's length [N m]:
 *     F = central (e . eps e) e + pressure (tr eps) e + vector (eps e). */
struct response {
    real central, pressure, vector;
};
struct response response_of(const struct particles *p, const struct bonds *b, const struct bond_source *s, int32_t i,
                            const struct bond *bond);
/* Adds to T [J] the part of one bond, from xp (a material point) to xm, inside the cell around X: T_abcd = l e_b
 * dF_a/deps_cd, symmetric in cd. */
void tensor_add(real *T, const real *xp, const real *xm, const real *X, real half, struct response k, int dim);

/* Point i under state-based bonds: T [J] becomes the symmetric T' of partial_stress.c; L [symmetric] is the part of its
 * mean strain that its own bonds do not measure, 0 where it has none. Returns whether it has bonds
 * (partial_positive.c). */
bool partial_positive(real *T, real *L, const struct particles *p, const struct bonds *b, const struct bond_source *s,
                      int64_t i);

/* Point i under bonds of a bond-based model: T is kept below the stiffness V C of the point. On lattices it is below;
 * where particles stand irregularly, or bonds are stiffer than their material, the rest V C - T would be negative in
 * some direction, and the cell would gain energy at any step. */
void partial_positive_bonds(real *T, const struct particles *p, const struct bond_source *s, int64_t i);

/* Half the edge of a particle's cell [m]. */
real half_edge(const struct particles *p, const struct bond_source *s, int64_t i);

/* Table of the sums on a lattice (partial_table.c); `size`: numbers of a tensor. Empty where particles do not stand on
 * lattices. */
struct partial_table;
struct partial_table *partial_table_make(const struct particles *p, const struct bond_source *s, int size);
void partial_table_free(struct partial_table *t);
/* Is the table not empty? Does it serve all cells? */
bool partial_table_serves(const struct partial_table *t);
bool partial_table_serves_all(const struct partial_table *t);
/* Has particle i the volume of a lattice cell? */
bool partial_table_has(const struct particles *p, const struct bond_source *s, int64_t i);
/* Computes the bond responses of the rows of the listed particles anew (NULL: of all material points); other
 * particles keep theirs. */
void partial_table_update(struct partial_table *t, const struct particles *p, const struct bonds *b,
                          const struct bond_source *s, const int32_t *list, int64_t n);
/* T of point i [J] from the bond responses of the rows around it. */
void partial_table_sum(const struct partial_table *t, const struct particles *p, const struct bonds *b,
                       const struct bond_source *s, int64_t i, struct near *near, real *T);

#endif
