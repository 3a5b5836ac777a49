/* Bonds that cross the cell of a particle: geometry and response, shared by partial stress and reversion. */
#ifndef CLEAVE_PARTIAL_PARTS
#define CLEAVE_PARTIAL_PARTS

#include "bonds/bonds.h"

/* Returns the share of the segment a-b inside the cube of half edge `half` round X [1]. */
real segment_share_in_cube(const real *a, const real *b, const real *X, real half, int dim);

/* Reflection by a chain of mirrors: the image of a point X of the body is X'_d = sign_d X_d + offset_d. root: source of
 * image i, or i itself. */
struct reflection {
    real sign[DIM_MAX], offset[DIM_MAX];
    int64_t root;
};

/* Returns the reflection of particle or image i. */
struct reflection mirror_reflection_of(const struct bond_source *s, const struct particles *p, int64_t i);

/* Response of the force F of a bond of direction e to a uniform strain eps, times the length of the bond [N m]:
 *     F = central (e . eps e) e + pressure (tr eps) e + vector (eps e). */
struct response {
    real central, pressure, vector;
};

/* Returns the response of bond i-j. */
struct response bond_response_of(const struct particles *p, const struct bonds *b, const struct bond_source *s,
                                 int32_t i, const struct bond *bond);

/* Adds to T [J] the contribution of the bond from xp (a material point) to xm inside the cell round X: T_abcd = l e_b
 * dF_a/deps_cd, symmetric in cd. */
void partial_tensor_add_bond(real *T, const real *xp, const real *xm, const real *X, real half, struct response k,
                             int dim);

/* Limits T of point i under state-based bonds [J] to the symmetric T' of partial_stress.c (partial_positive.c). L: set
 * to the part of the mean strain that the bonds of the point do not measure, in symmetric components; 0 without bonds.
 * Returns true if the point has bonds. */
bool partial_tensor_limit_state(real *T, real *L, const struct particles *p, const struct bonds *b,
                                const struct bond_source *s, int64_t i);

/* Limits T of point i under bond-based PD-MPM bonds [J] to the stiffness V C of the point. On lattices T is smaller;
 * for irregular particles, or bonds stiffer than their material, V C - T would otherwise have negative eigenvalues and
 * the cell would gain energy at any time step. */
void partial_tensor_limit_bonds(real *T, const struct particles *p, const struct bond_source *s, int64_t i);

/* Returns half the edge of the cell of a particle [m]. */
real particle_half_edge(const struct particles *p, const struct bond_source *s, int64_t i);

/* Table of the sums on a lattice (partial_table.c). Empty if particles are not on lattices. */
struct partial_table;

/* Makes the table. size: values of a tensor. Release with partial_table_free. */
struct partial_table *partial_table_make(const struct particles *p, const struct bond_source *s, int size);

/* Releases the table. */
void partial_table_free(struct partial_table *t);

/* Returns true if the table is not empty. */
bool partial_table_exists(const struct partial_table *t);

/* Returns true if the table applies to all cells. */
bool partial_table_covers_all(const struct partial_table *t);

/* Returns true if particle i has the volume of a lattice cell. */
bool partial_table_applies_to(const struct particles *p, const struct bond_source *s, int64_t i);

/* Recomputes the bond responses of the rows of n listed particles (NULL: of all material points); the responses of
 * other particles are kept. */
void partial_table_update(struct partial_table *t, const struct particles *p, const struct bonds *b,
                          const struct bond_source *s, const int32_t *list, int64_t n);

/* Computes T of point i [J] from the bond responses of the rows around it. near: workspace. */
void partial_table_sum(const struct partial_table *t, const struct particles *p, const struct bonds *b,
                       const struct bond_source *s, int64_t i, struct near *near, real *T);

#endif
