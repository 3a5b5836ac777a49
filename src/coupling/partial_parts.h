/* Declarations for partial stress (partial_stress.c) and reversion: the stress that bonds carry through the cell of a
 * material point. A point has a square or cubic cell with the point in its middle. */
#ifndef CLEAVE_PARTIAL_PARTS
#define CLEAVE_PARTIAL_PARTS

#include "bonds/bonds.h"
#include "bonds/sites.h"
#include "data/cells.h"

/* Lists the particles and mirror images within the cutoff of bonds around `particle`, without `particle` itself, in
 * near->at and their number in near->n. map: map of the lattice sites of the bonds, which makes this faster; NULL: a
 * search is done. */
void particle_find_family_members(struct neighbour_list *near, const struct bond_source *source,
                                  const struct site_map *map, const struct particles *p, int64_t particle);

/* Returns the share of the length of the segment from a to b (dim components [m]) that is inside a square or cube [1].
 * cube_centre: middle of the cube; half_edge: half of its edge [m]. */
real segment_fraction_in_cube(const real *segment_start, const real *segment_end, const real *cube_centre,
                              real half_edge, int dim);

/* Reflection that maps the particle `root` of the body, at X, to one of its mirror images, at X', by one or several
 * mirrors: X'_d = sign_d X_d + offset_d. */
struct reflection {
    real sign[DIM_MAX], offset[DIM_MAX];
    int64_t root;
};

/* Returns the reflection, by one or several mirrors, that maps a particle of the body to its mirror image `image`, an
 * entry of the particle arrays. It is the identity if `image` itself is a particle of the body. */
struct reflection mirror_image_reflection(const struct bond_source *s, const struct particles *p, int64_t image);

/* Derivative of the force F of a bond by a uniform strain eps, times the length of the bond [N m]. With the unit vector
 * e along the bond,
 *     F = central (e . eps e) e + pressure (tr eps) e + vector (eps e). */
struct response {
    real central, pressure, vector;
};

/* Returns the derivative of the force of `bond` by a uniform strain, times the length of the bond. i: particle in whose
 * row the bond is. */
struct response bond_force_derivative_by_strain(const struct particles *p, const struct bonds *b,
                                                const struct bond_source *source, int32_t i, const struct bond *bond);

/* Adds the contribution of a bond to the tensor T = `tensor` of a cell [J], by which bonds reduce the stiffness of the
 * cell: T_abcd += l e_b dF_a/deps_cd, symmetric in ab and in cd. l: length of the bond inside the cell; e: unit vector
 * along the bond; F: its force. point, other_position: positions of its material point and of its other particle, dim
 * components each [m]; centre, half_edge: centre and half edge of the cell [m]; response: r dF/deps, with the length r
 * of the bond. */
void partial_tensor_add_bond_contribution(real *tensor, const real *point_position, const real *other_position,
                                          const real *centre, real half_edge, struct response response, int dim);

/* Reduces the tensor `tensor` of the material point `point` [J], by which state-based bonds reduce the stiffness of its
 * cell, as far as needed for a positive elastic energy of the point (partial_positive.c). mean_strain_derivative:
 * receives the derivative of the point's mean strain by the strain of its cell, in symmetric components [1]; 0 if the
 * point has no bonds. Returns true if it has bonds. */
bool partial_tensor_limit_for_state_based_bonds(real *tensor, real *mean_strain_derivative, const struct particles *p,
                                                const struct bonds *b, const struct bond_source *source, int64_t point);

/* Reduces the tensor `tensor` of the material point `point` [J], by which bond-based PD-MPM bonds reduce the stiffness
 * of its cell, as far as needed for V C - `tensor` without negative eigenvalues. V, C: volume and elastic tensor of the
 * point. A cell with a negative eigenvalue would be unstable with any time step. This has an effect only if particles
 * are not on a lattice or bonds are stiffer than the material. */
void partial_tensor_limit_for_bond_based_model(real *tensor, const struct particles *p,
                                               const struct bond_source *source, int64_t point);

/* Returns half the edge of the square or cubic cell of particle i, from its volume [m]. */
real particle_cell_half_edge(const struct particles *p, const struct bond_source *source, int64_t i);

/* Table for particles on a lattice (partial_table.c): the share of every bond vector inside every cell that it crosses.
 * From it the tensor T follows quickly, by which bonds reduce the stiffness of the cell of a material point. Empty if
 * particles are not on lattices. */
struct partial_table;

/* Creates the table of the shares of bonds inside cells for the particles p. It is empty if they are not on lattices or
 * have too many bond vectors. tensor_size: number of values of the tensor T, by which bonds reduce the stiffness of a
 * cell. Release with partial_table_free. */
struct partial_table *partial_table_make_of_bond_shares_in_cells(const struct particles *p,
                                                                 const struct bond_source *source, int tensor_size);

/* Releases the table t. */
void partial_table_free(struct partial_table *t);

/* Returns true if the table t is not empty, i.e. if particles are on lattices and have few enough bond vectors. */
bool partial_table_is_filled(const struct partial_table *t);

/* Returns true if the table t can be used for every particle, because all have the volume of a lattice cell. */
bool partial_table_covers_all_particles(const struct partial_table *t);

/* Returns true if `particle` has the volume of a lattice cell, so that the table can be used for it. */
bool partial_table_applies_to_particle(const struct particles *p, const struct bond_source *source, int64_t particle);

/* Recomputes the stored strain responses (struct response) of the bonds of the material points point_list[point_count],
 * or of all material points if `point_list` is NULL. Responses of other points are kept. */
void partial_table_update_strain_responses(struct partial_table *t, const struct particles *p, const struct bonds *b,
                                           const struct bond_source *source, const int32_t *point_list,
                                           int64_t point_count);

/* Computes the tensor `tensor` of the material point `point` [J], by which bonds reduce the stiffness of its cell, from
 * the table and the stored strain responses of the bonds of the material points around it. near: working memory. */
void partial_table_sum_stiffness_tensor(const struct partial_table *t, const struct particles *p, const struct bonds *b,
                                        const struct bond_source *source, int64_t point, struct neighbour_list *near,
                                        real *tensor);

#endif
