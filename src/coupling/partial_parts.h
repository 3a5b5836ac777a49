/* Geometry of bonds that cross the cell of a particle, shared by partial stress and return. */
#ifndef CLEAVE_PARTIAL_PARTS
#define CLEAVE_PARTIAL_PARTS

#include "bonds/bonds.h"

/* Share of the segment a-b inside the cube of half edge `half` round X. */
real segment_share(const real *a, const real *b, const real *X, real half, int dim);

/* Position of the mirror chain's image of a point: X'_d = sign_d X_d + offset_d. */
struct reflection { real sign[DIM_MAX], offset[DIM_MAX]; int64_t root; };
struct reflection reflection_of(const struct bond_source *s, const struct particles *p, int64_t i);

/* How the force F of a bond of direction e answers to a uniform strain, times the bond's length [N m]:
 *     F = central (e . eps e) e + pressure (tr eps) e + vector (eps e). */
struct response { real central, pressure, vector; };
struct response response_of(const struct particles *p, const struct bonds *b, const struct bond_source *s, int32_t i,
                            const struct bond *bond);
/* Adds the part of one bond, from p (a material point) to m, in the cell round X: T_abcd = l e_b dF_a/deps_cd,
 * symmetric in cd. */
void tensor_add(real *T, const real *xp, const real *xm, const real *X, real half, struct response k, int dim);

/* Of a point under state-based bonds: T [J] becomes the symmetric T' of partial_stress.c, L [symmetric] what its own
 * bonds do not see of its mean strain, 0 where it has none; returns whether it has (partial_positive.c). */
bool partial_positive(real *T, real *L, const struct particles *p, const struct bonds *b, const struct bond_source *s,
                      int64_t i);

/* The same under bonds: T stays below the point's own stiffness V C. On lattices it is; where particles stand
 * irregularly, or bonds are stiffer than their material, a cell would push what it should pull, and gains energy at
 * any step. */
void partial_positive_bonds(real *T, const struct particles *p, const struct bond_source *s, int64_t i);

/* Half the edge of a particle's cell [m]. */
real half_edge(const struct particles *p, const struct bond_source *s, int64_t i);

/* The sums on a lattice (partial_table.c); `size`: numbers of a tensor. Empty where particles do not stand on
 * lattices. */
struct partial_table;
struct partial_table *partial_table_make(const struct particles *p, const struct bond_source *s, int size);
void partial_table_free(struct partial_table *t);
bool partial_table_serves(const struct partial_table *t);
bool partial_table_serves_all(const struct partial_table *t);
/* Is the cell of this particle one of the lattice? */
bool partial_table_has(const struct particles *p, const struct bond_source *s, int64_t i);
/* Computes the bond responses of the rows of the listed particles anew (NULL: of all material points); other
 * particles keep theirs. */
void partial_table_ask(struct partial_table *t, const struct particles *p, const struct bonds *b,
                       const struct bond_source *s, const int32_t *list, int64_t n);
/* T of point i from the answers of the rows round it. */
void partial_table_sum(const struct partial_table *t, const struct particles *p, const struct bonds *b,
                       const struct bond_source *s, int64_t i, struct near *near, real *T);

#endif
