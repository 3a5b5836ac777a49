/* Room `bonds` (folder of include/ and src/): neighbourhoods of particles and the bonds between them. It uses
 * particles, cells, materials and regions, but neither loads nor the time step; kernels, coupling, fracture, solver and
 * engine call it. family.h defines which bonds exist, bond_storage.h how they are stored; this header makes and reads
 * them. */
#ifndef CLEAVE_BONDS
#define CLEAVE_BONDS

#include "base/archive.h"
#include "bonds/bond_storage.h"

#define BYTES_PER_BOND 24.0 /* memory of a stored bond with padding [bytes]; measured on blocks of 10^6 particles */

/* Sums over the springs (bonds) of one particle, of stiffness K and direction n: block = sum K n n, total = sum K. From
 * both follows an upper bound of the largest eigenvalue of the stiffness matrix (block-Gershgorin): row-sum norm of
 * `block` + `total`. */
struct gershgorin_bound {
    real block[DIM_MAX][DIM_MAX], total; /* sum K n n and sum K over springs of stiffness K, direction n [N/m] */
};

/* Adds a spring to the sums of `bound`: K n n (a dyad) to bound->block and K to bound->total. stiffness: stiffness K of
 * the spring [N/m]; direction: its unit vector n, dim components. */
static inline void gershgorin_bound_add_spring(struct gershgorin_bound *bound, real stiffness, const real *direction,
                                               int dim)
{
    for (int a = 0; a < dim; a++)
        for (int c = 0; c < dim; c++) bound->block[a][c] += stiffness * direction[a] * direction[c];
    bound->total += stiffness;
}

/* Returns an upper bound [N/m] of the largest eigenvalue of the stiffness matrix of the springs added to `bound` in dim
 * dimensions, by block-Gershgorin: the maximum row sum of the magnitudes in bound->block, which is the sum of K n n
 * over springs of stiffness K and direction n, plus bound->total, the sum of all K. */
static inline real gershgorin_bound_largest_eigenvalue(const struct gershgorin_bound *bound, int dim)
{
    real norm = 0;
    for (int a = 0; a < dim; a++) {
        real sum = 0;
        for (int c = 0; c < dim; c++) sum += fabs(bound->block[a][c]);
        norm = real_max(norm, sum);
    }
    return norm + bound->total;
}

/* Returns true if one of the `precrack_count` pre-cracks in the array `precrack` cuts the segment between the reference
 * positions of the particles `particle` and `other_particle` of p. */
bool precracks_cut_bond_between(const struct crack *precrack, int precrack_count, const struct particles *p,
                                int64_t particle, int64_t other_particle);

/* Returns an upper bound of the number of neighbours of any particle within the cutoff, by which callers choose the
 * length of arrays of neighbours: source->room if it is > 0, else a bound from the numbers of particles in the search
 * cells. source: inputs of the bonds (horizon, materials, cracks, mirrors). */
int bonds_neighbour_count_upper_bound(const struct bond_source *source);

/* Computes the neighbour volume V_i^H = sum V_j beta of every particle i of p, as if no pre-crack cut its bonds. V_j is
 * the volume of neighbour j, and beta the fraction of this volume within the horizon. volume[p->n_all]: receives the
 * results [m^3]; source: inputs of the bonds (horizon, materials, cracks, mirrors). */
void bonds_compute_family_volumes(real *volume, const struct particles *p, const struct bond_source *source);

/* Creates b, the bonds of all peridynamic particles and bonded material points of p, from `source` (horizon, materials,
 * cracks, mirrors). previous_bonds: NULL, or the previous bonds, whose broken bonds stay broken and whose counts and
 * energies are copied; parts of its storage move to b, so that afterwards only bonds_free may be called with
 * `previous_bonds`. Bonds cut by a pre-crack get the weight w = 0 (factor on the stiffness) and count as damage. Sets
 * the damage of all peridynamic particles. Release with bonds_free. */
void bonds_make(struct bonds *b, struct bonds *previous_bonds, struct particles *p, const struct bond_source *source);

/* Sets the kind (material point or peridynamic) of every mirror image (copy beyond a plane of symmetry) in p to the
 * kind of its source particle. source: inputs of the bonds, of which only the list of mirror images is used. */
void mirror_images_copy_particle_kinds(struct particles *p, const struct bond_source *source);

/* Rebuilds the particle lists of p and the bonds b after particles have changed their kind (material point or
 * peridynamic). source: inputs of the bonds (horizon, materials, cracks, mirrors). Sets the force p->f of particles
 * that have no bonds to 0. */
void bonds_rebuild_after_particle_kind_change(struct bonds *b, struct particles *p, const struct bond_source *source);

/* Returns an upper bound [N/m] of the largest eigenvalue of the stiffness matrix of the bonds of row number `row` of b,
 * i.e. of all bonds of one particle of p, by block-Gershgorin. For the critical time step. */
real bonds_row_stiffness_eigenvalue_upper_bound(const struct bonds *b, const struct particles *p, int64_t row);

/* Releases all arrays of the bonds b, not b itself. */
void bonds_free(struct bonds *b);

/* Returns a lower bound [s] of the critical time step 2/omega_max of the particles p in the state in which all of them
 * are peridynamic and no bond is broken. The largest angular frequency omega_max is bounded by block-Gershgorin.
 * source: inputs of the bonds, from which bonds are computed for this purpose; no stored bonds are needed. Returns
 * INFINITY if no particle has a bond. */
real bonds_critical_time_step_if_all_peridynamic(const struct particles *p, const struct bond_source *source);

/* Returns a lower bound [s] of the critical time step 2/omega_max of the existing bonds b of the particles p. Valid
 * only while all particles are peridynamic and no bond is broken. INFINITY if there are no bonds. */
real bonds_critical_time_step_of_existing_bonds(const struct bonds *b, const struct particles *p);

/* Copies what load has done to bonds from the bonds `old_bonds` of the particles `old_particles` to the bonds b of p,
 * another set of particles: which bonds are broken or have softened, counts and energies of rows, and damage.
 * new_index: index in p of each particle of `old_particles`, mirror images (copies beyond planes of symmetry) included;
 * -1: the particle is not in p. limit: critical stretches and softening by pair of materials. In both sets peridynamic
 * particles must have all their neighbours. */
void bonds_copy_damage_to_new_particles(struct bonds *b, struct particles *p, const struct bond_limit *limit,
                                        const struct bonds *old_bonds, const struct particles *old_particles,
                                        const int32_t *new_index);

/* Saves which of the bonds b are broken or have softened, their plastic state and the damage p->damage to the archive
 * `a` if a->saving, else restores them from it. Neighbours and weights (factors on the stiffness) are not stored, since
 * bonds_make rebuilds them. If a->scope is not ARCHIVE_ALL (the state for a restart), only the plastic stretches of
 * bonds are saved or restored. Returns FAILED if an entry is missing or its size differs. */
status bonds_save_or_load(struct bonds *b, struct particles *p, struct archive *a);

/* Returns the weighted volume Q = sum w r^2 [m^2] over the intact bonds of row `row` of b, i.e. of one particle, with
 * the weights w (factors on the stiffness) and reference lengths r of the bonds. The sum is computed anew, because
 * subtracting broken bonds from a stored sum would leave round-off when few bonds remain. */
real state_based_weighted_volume_of_intact_bonds(const struct bonds *b, int64_t row);

/* Recomputes the weighted volume Q = sum w r^2 [m^2] of every particle of p with bonds, and stores it in b. The sum is
 * over the intact bonds, with weights w (factors on the stiffness) and reference lengths r. Only for state-based
 * models. source: inputs of the bonds (horizon, materials, cracks, mirrors). */
void state_based_update_weighted_volumes(struct bonds *b, const struct particles *p, const struct bond_source *source);

/* Checks the stored bonds b against the invariants listed in bond_storage.h. Returns a text that describes the first
 * violated one, or NULL if all hold. */
const char *bonds_describe_first_inconsistency(const struct bonds *b);

/* Returns the energy [J] that the intact bonds of b have dissipated by softening so far. */
real bonds_dissipated_softening_energy(const struct bonds *b);

/* Returns the fracture energy [J] of row `row` of b (all bonds of one particle): the energy released by its broken
 * bonds since the start, plus half of the energy that its intact bonds have dissipated by softening. The sum over all
 * rows is bonds_fracture_energy. */
real bonds_row_dissipated_energy(const struct bonds *b, int64_t row);

/* Returns true if an intact bond of row `row` of b (all bonds of one particle) has begun to soften, because of its
 * stretch or of the strength surface of the material; false if there is none, or if row is -1. */
bool bonds_row_has_begun_softening(const struct bonds *b, int64_t row);

/* Starts the softening of bonds of b where the stress of particles p has reached the strength surface of the material,
 * a failure criterion in stress (bonds_strength.c). Computes, at the present positions and for particles with large
 * bond stretches, the ratio U of the stress of the particle to the stress on the strength surface. The limit of U is 1,
 * or the random strength factor of the particle, if it has one. Where U reaches its limit, those bonds of the particle
 * that have not begun to soften do so from their present stretch on. Material points at such bonds are marked for
 * conversion to peridynamic particles. Does nothing if no material has a surface. source: inputs of the bonds (horizon,
 * materials, cracks, mirrors). */
void bonds_start_softening_at_strength_surface(struct bonds *b, struct particles *p, const struct bond_source *source);

/* Computes into stress_ratio[p->n] [1] the ratio of the stress of each particle of p to the stress on the strength
 * surface of its material (a failure criterion in stress): 1 on the surface, 0 if the material has no surface. The
 * stress of a material point is its own, that of a peridynamic particle follows from the strain averaged over its bonds
 * in b. source: inputs of the bonds (horizon, materials, cracks, mirrors). */
void bonds_compute_stress_to_strength_ratios(const struct bonds *b, const struct particles *p,
                                             const struct bond_source *source, real *stress_ratio);

/* Returns the damage (0 to 1) of the particle of row `row` of b by the softening of its intact bonds: sum d_j V_j over
 * these bonds, divided by the volume of all neighbours. d_j: softening (0 to 1) of the bond to neighbour j; V_j: volume
 * of neighbour j in p. Returns 0 if row is -1. */
real bonds_row_softening_damage(const struct bonds *b, const struct particles *p, int64_t row);

/* Returns the energy [J] released by all bonds of b broken since the start plus that dissipated by intact bonds which
 * soften. */
real bonds_fracture_energy(const struct bonds *b);

/* Returns eight bits: bit l is set if particle l (0 to 7) of the eight particles whose bonds block `row_block` of eight
 * rows of b stores has an intact bond. */
static inline unsigned bond_row_block_intact_bond_lane_mask(const struct bonds *b, int64_t row_block)
{
    const struct stencil *stencil = b->stencil[row_block];
    unsigned bits = 0;
    for (int k = 0; stencil && k < stencil->columns; k++) bits |= stencil->column[k].intact;
    if (stencil) return bits;
    for (int64_t column = b->column[row_block]; column < b->column[row_block] + b->column_count[row_block]; column++)
        bits |= b->common[column].intact;
    return bits;
}

/* Returns true if particle i has at least one intact bond. (A particle may have a row of b and yet no bond, because
 * storage is made for eight particles at once.) */
static inline bool particle_has_intact_bond(const struct bonds *b, int64_t i)
{
    const int64_t row = b->row_of[i];
    return row >= 0 && bond_row_block_intact_bond_lane_mask(b, row / LANES) >> row % LANES & 1;
}

/* Clears the bits of all particles and mirror images (copies beyond planes of symmetry) to which the particle of row
 * `row` of b has intact bonds. particle_bits: the bits, for particle or image i bit i % 64 of particle_bits[i / 64].
 * Does nothing if row is -1 (a particle without bonds). */
void bonds_row_clear_bitmap_at_intact_neighbours(const struct bonds *b, int64_t row, uint64_t *particle_bits);

/* Returns the number of bonds of the eight particles of block `row_block` of eight rows of b together, broken bonds
 * included. A bond between two of these particles counts twice. */
static inline int32_t bond_row_block_bond_count(const struct bonds *b, int64_t row_block) { return b->made[row_block]; }

/* Returns the number of columns of block `row_block` of eight rows of b, which stores the bonds of eight particles.
 * Column k holds at most one bond of each of these particles, so that none has more bonds than there are columns. */
static inline int64_t bond_row_block_bond_slots_per_particle(const struct bonds *b, int64_t row_block)
{
    return b->column_count[row_block];
}

/* Returns the index of the first neighbour in column number `column` of block `row_block` of eight rows of b (bond
 * number `column` of each of eight particles), if the eight neighbours are consecutive particles; else -1. */
static inline int64_t bond_column_first_neighbour_if_consecutive(const struct bonds *b, int64_t row_block,
                                                                 int64_t column)
{
    const struct stencil *stencil = b->stencil[row_block];
    return stencil ? b->particle[row_block * LANES] + stencil->column[column].offset
                   : b->first[b->column[row_block] + column];
}

/* The eight bonds of one column of a block of eight rows (the bonds of eight particles), one bond of each particle.
 * first: neighbour of lane 0 if the eight neighbours are consecutive, else -1; nbr: neighbours; inverse_length: 1/r
 * [1/m]; w: weights [1]. */
struct column_copy {
    int32_t first, nbr[LANES];
    real inverse_length[LANES], w[LANES];
};

/* Reads neighbours, inverse lengths and weights of column number `column` of block `row_block` of eight rows (bond
 * number `column` of each of eight particles) into *copy. If the block stores no columns of its own, the data come from
 * its stencil, a pattern of bonds that many blocks share. Does not change b. */
void bond_column_read_eight_bonds(struct column_copy *copy, const struct bonds *b, int64_t row_block, int64_t column);

/* A bond of a particle as stored. nbr: particle or mirror image to which the bond leads; inverse_length: 1/r [1/m],
 * negative if load has broken the bond; w: weight [1], 0 if the bond is broken or cut by a pre-crack; entry: index of
 * the bond in the bond arrays, for example plastic_stretch. */
struct bond {
    int64_t entry;
    int32_t nbr;
    real inverse_length, w;
};

/* Returns bond number `bond_number` (from 0) of the particle in lane `lane` (0 to 7) of block `row_block` of eight rows
 * (the bonds of eight particles) of b. If this particle has no such bond, the member inverse_length of the result is 0.
 * Does not change b. */
static inline struct bond bond_read(const struct bonds *b, int64_t row_block, int64_t bond_number, int lane)
{
    const int64_t q = (b->column[row_block] + bond_number) * LANES + lane;
    if (!__atomic_load_n(&b->implicit[row_block], __ATOMIC_ACQUIRE))
        return (struct bond){q, b->nbr[q], b->inverse_length[q], b->w[q]};
    const struct stencil_column *of = &b->stencil[row_block]->column[bond_number];
    const real w = b->stencil[row_block]->w[bond_number][lane];
    return (struct bond){q, b->particle[row_block * LANES] + of->offset + lane, w == 0 ? 0 : of->inverse_length, w};
}

/* Iterator over the bonds of one row, i.e. of one particle, including bonds that are broken or cut by pre-cracks. It
 * changes no bond. bond: present bond; row_block, lane: position of the row; k: number of the next bond, of `columns`.
 * Usage:
 *
 *     for (struct bond_iterator it = bond_iterator_of_row(b, row); bond_iterator_advance(&it);) ... it.bond ... */
struct bond_iterator {
    struct bond bond;
    const struct bonds *b;
    int64_t row_block, k, columns;
    int lane;
};

/* Returns an iterator over all bonds of row number `row` of b, i.e. of one particle, to be advanced by
 * bond_iterator_advance. row < 0: an iterator without bonds. */
static inline struct bond_iterator bond_iterator_of_row(const struct bonds *b, int64_t row)
{
    if (row < 0) return (struct bond_iterator){.b = b};
    return (struct bond_iterator){{0}, b, row / LANES, 0, b->column_count[row / LANES], (int)(row % LANES)};
}

/* Advances the iterator `it` to the next bond, which is then in it->bond. Returns true, or false if there are no more
 * bonds. */
static inline bool bond_iterator_advance(struct bond_iterator *it)
{
    while (it->k < it->columns) {
        it->bond = bond_read(it->b, it->row_block, it->k++, it->lane);
        if (it->bond.inverse_length != 0) return true;
    }
    return false;
}

#endif
