/* Declarations for partial stress (partial_stress.c) and reversion: the stress that bonds carry through the cell of a
 * material point. A point has a square or cubic cell with the point in its middle. */
#ifndef CLEAVE_PARTIAL_PARTS
#define CLEAVE_PARTIAL_PARTS

#include "bonds/bonds.h"
#include "bonds/sites.h"
#include "data/cells.h"

/* Lists the particles and mirror images (copies beyond planes of symmetry) of p within the cutoff of bonds around
 * `particle`, without `particle` itself, in near->at, and stores their number in near->n. source: inputs of the bonds
 * (horizon, materials, cracks, mirrors); map: map of the lattice sites of the bonds, which makes this faster; NULL: a
 * search is done. */
void particle_find_family_members(struct neighbour_list *near, const struct bond_source *source,
                                  const struct lattice_site_map *map, const struct particles *p, int64_t particle);

/* Returns the share (0 to 1) of the length of the segment from `segment_start` to `segment_end` that is inside a square
 * or cube with edges along the axes. cube_centre: middle of the cube; half_edge: half of an edge of the cube [m].
 * Positions have dim components [m]. */
real segment_fraction_in_cube(const real *segment_start, const real *segment_end, const real *cube_centre,
                              real half_edge, int dim);

/* Reflection at one or several planes of symmetry that maps a particle at X to one of its mirror images at X': X'_d =
 * sign_d X_d + offset_d, sign_d = 1 or -1, offset [m]. root: index of the particle. */
struct reflection {
    real sign[DIM_MAX], offset[DIM_MAX];
    int64_t root;
};

/* Returns the reflection, by one or several mirrors, that maps a particle of the body to its mirror image `image`, an
 * entry of the particle arrays of p. The reflection is the identity if `image` itself is a particle of the body. s:
 * inputs of the bonds (horizon, materials, cracks, mirrors). */
struct reflection mirror_image_reflection_from_source_particle(const struct bond_source *s, const struct particles *p,
                                                               int64_t image);

/* Strain response of a bond: derivative of the force F of the bond by a uniform strain eps, times the length of the
 * bond [N m], as the factors of three terms. With the unit vector e along the bond,
 *     F = central (e . eps e) e + pressure (tr eps) e + vector (eps e). */
struct bond_strain_response {
    real central, pressure, vector;
};

/* Returns the derivative of the force of `bond` by a uniform strain, times the length of the bond [N m], as the three
 * factors of struct bond_strain_response (central, pressure and vector part of the force). i: particle of p to whose
 * bonds in b `bond` belongs; source: inputs of the bonds (horizon, materials, cracks, mirrors). */
struct bond_strain_response bond_force_derivative_by_strain(const struct particles *p, const struct bonds *b,
                                                            const struct bond_source *source, int32_t i,
                                                            const struct bond *bond);

/* Adds the contribution of a bond to the tensor T = `tensor` [J] (row-major matrix over symmetric components) of a
 * cell, by which bonds reduce the stiffness of the cell: T_abcd += l e_b dF_a/deps_cd, symmetric in ab and in cd. l:
 * length of the bond inside the cell; e: unit vector along the bond; F: its force. point_position, other_position:
 * positions of the material point and of the other particle of the bond, dim components each [m]; centre, half_edge:
 * centre of the cell and half of an edge [m]; response: r dF/deps, with the length r of the bond. */
void cell_stiffness_reduction_add_bond_contribution(real *tensor, const real *point_position,
                                                    const real *other_position, const real *centre, real half_edge,
                                                    struct bond_strain_response response, int dim);

/* Reduces the tensor `tensor` [J] (row-major matrix over symmetric components) of the material point `point` of p, by
 * which its state-based bonds b reduce the stiffness of its cell, as far as needed for a positive elastic energy of the
 * point (partial_positive.c). mean_strain_derivative: receives the derivative of the point's mean strain by the strain
 * of its cell, in symmetric components [1]; 0 if the point has no bonds. source: inputs of the bonds (horizon,
 * materials, cracks, mirrors). Returns true if the point has bonds. */
bool cell_limit_state_based_stiffness_reduction(real *tensor, real *mean_strain_derivative, const struct particles *p,
                                                const struct bonds *b, const struct bond_source *source, int64_t point);

/* Reduces the tensor `tensor` [J] (row-major matrix over symmetric components) of the material point `point` of p, by
 * which bond-based bonds to peridynamic particles reduce the stiffness of its cell. Reduces it only so far that V C -
 * `tensor`, with the volume V and elastic tensor C of the point, has no negative eigenvalue, with which the cell would
 * be unstable at any time step. This has an effect only if particles are not on a lattice or bonds are stiffer than the
 * material. source: inputs of the bonds (horizon, materials, cracks, mirrors). */
void cell_limit_bond_based_stiffness_reduction(real *tensor, const struct particles *p,
                                               const struct bond_source *source, int64_t point);

/* Returns half the edge [m] of the square or cubic cell of particle i of p, from the volume of the particle. source:
 * inputs of the bonds (horizon, materials, cracks, mirrors). */
real particle_cell_half_edge(const struct particles *p, const struct bond_source *source, int64_t i);

/* Table for particles on a lattice (partial_table.c): for every possible bond and every cell that it crosses, the
 * fraction of the length of the bond inside the cell. With it, the tensor T by which bonds reduce the stiffness of the
 * cell of a material point is computed quickly. Empty if particles are not on lattices. */
struct bond_fraction_table;

/* Creates the table that contains, for every possible bond between particles p on a lattice, the fraction of the length
 * of the bond inside each cell that the bond crosses. The table is empty if the particles are not on lattices or have
 * too many bond vectors. source: inputs of the bonds (horizon, materials, cracks, mirrors); tensor_size: number of
 * values of the tensor T, by which bonds reduce the stiffness of a cell. Release with bond_fraction_table_free. */
struct bond_fraction_table *bond_fraction_table_make_for_lattice_cells(const struct particles *p,
                                                                       const struct bond_source *source,
                                                                       int tensor_size);

/* Releases the table t. */
void bond_fraction_table_free(struct bond_fraction_table *t);

/* Returns true if the table t of bond lengths inside cells could be made, because particles are on lattices with few
 * enough different bonds; false if the table is empty. */
bool bond_fraction_table_is_not_empty(const struct bond_fraction_table *t);

/* Returns true if all particles for which the table t of bond lengths inside cells was made have the volume of a
 * lattice cell. The table can then be used for every particle; its numbers are those of square or cubic cells of this
 * size only. */
bool bond_fraction_table_is_valid_for_all_particles(const struct bond_fraction_table *t);

/* Returns true if the table of bond lengths inside cells (struct bond_fraction_table) can be used for particle number
 * `particle` of p, because the particle has the volume of a lattice cell. source: inputs of the bonds (horizon,
 * materials, cracks, mirrors). */
bool particle_has_volume_of_lattice_cell(const struct particles *p, const struct bond_source *source, int64_t particle);

/* Recomputes the strain responses that the table t stores for each bond in b of a material point of p: the derivative
 * of the force of the bond by a uniform strain, times the length of the bond (struct bond_strain_response).
 * point_list[point_count]: indices of the points whose bonds have changed, NULL for all material points; the responses
 * of other points are kept. source: inputs of the bonds b. Call before
 * bond_fraction_table_sum_cell_stiffness_reduction. */
void bond_fraction_table_update_strain_responses(struct bond_fraction_table *t, const struct particles *p,
                                                 const struct bonds *b, const struct bond_source *source,
                                                 const int32_t *point_list, int64_t point_count);

/* Computes the tensor `tensor` [J] (row-major matrix over symmetric components) of the material point `point` of p, by
 * which the bonds b reduce the stiffness of its cell, from the table t and the strain responses that it stores for the
 * bonds of the material points around `point`. The responses must be up to date
 * (bond_fraction_table_update_strain_responses). source: inputs of the bonds (horizon, materials, cracks, mirrors);
 * near: working memory. */
void bond_fraction_table_sum_cell_stiffness_reduction(const struct bond_fraction_table *t, const struct particles *p,
                                                      const struct bonds *b, const struct bond_source *source,
                                                      int64_t point, struct neighbour_list *near, real *tensor);

#endif
