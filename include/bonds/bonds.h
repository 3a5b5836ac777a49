/* Room `bonds`: families of particles and the bonds between them. It uses particles, cells, materials and regions, but
 * neither loads nor the step; kernels, coupling, fracture, solver and engine call it. family.h defines which bonds
 * exist, bond_storage.h how they are stored; this header makes and reads them. */
#ifndef CLEAVE_BONDS
#define CLEAVE_BONDS

#include "base/archive.h"
#include "bonds/bond_storage.h"

#define BYTES_PER_BOND 24.0 /* stored, with padding; measured on blocks of 10^6 particles */

/* Block-Gershgorin bound of the largest eigenvalue of springs around one particle: norm of `block` plus
 * `total`. */
struct spring_bound {
    real block[DIM_MAX][DIM_MAX], total; /* sum K n n; sum K [N/m] */
};

/* Adds a spring of stiffness K [N/m] and direction n [dim]. */
static inline void spring_bound_add(struct spring_bound *s, real K, const real *n, int dim)
{
    for (int a = 0; a < dim; a++)
        for (int c = 0; c < dim; c++) s->block[a][c] += K * n[a] * n[c];
    s->total += K;
}

/* Returns the bound [N/m]. */
static inline real spring_bound_of(const struct spring_bound *s, int dim)
{
    real norm = 0;
    for (int a = 0; a < dim; a++) {
        real sum = 0;
        for (int c = 0; c < dim; c++) sum += fabs(s->block[a][c]);
        norm = real_max(norm, sum);
    }
    return norm + s->total;
}

/* Returns true if one of the cracks cuts the segment between particles i and j (reference positions). */
bool cracks_part(const struct crack *crack, int cracks, const struct particles *p, int64_t i, int64_t j);

/* Returns an upper bound of the number of neighbours of a particle (cells_most). Computed once: reference positions do
 * not move. */
int bonds_room(const struct bond_source *s);

/* Computes V_i^H = sum V_j beta of every particle, without cracks [m^3]. volume: [n_all]. */
void bonds_neighbour_volume(real *volume, const struct particles *p, const struct bond_source *s);

/* Makes the rows of all peridynamic particles and bonded material points. old: NULL, or the previous rows, whose broken
 * bonds stay broken and whose counts are carried over; its columns are invalid afterwards. Bonds cut by a crack have w
 * = 0 and count as damage. Sets the damage of all peridynamic particles. Release with bonds_free. */
void bonds_make(struct bonds *b, struct bonds *old, struct particles *p, const struct bond_source *s);

/* Gives images the kind of their sources. */
void bonds_images_follow(struct particles *p, const struct bond_source *s);

/* Rebuilds particle lists and rows after particles changed their kind. Sets the bond force of particles without a row
 * to 0. */
void bonds_renew(struct bonds *b, struct particles *p, const struct bond_source *s);

/* Returns an upper bound of the largest eigenvalue of the stiffness of the springs of a row [N/m] (spring_bound_of). */
real bonds_row_bound(const struct bonds *b, const struct particles *p, int64_t row);

/* Releases all arrays. */
void bonds_free(struct bonds *b);

/* Returns the critical time step of intact bonds [s]: 2 / omega_max with the block-Gershgorin bound of omega. The
 * maximum is over all particles of the body, material points included, each with the bonds that it would have if all
 * particles were peridynamic. No stored rows are needed. */
real bonds_critical_step(const struct particles *p, const struct bond_source *s);

/* Returns the critical time step of the intact bonds from the stored rows [s]. Valid only while all particles are
 * peridynamic and no bond is broken. */
real bonds_critical_step_made(const struct bonds *b, const struct particles *p);

/* Copies broken bonds, counts and damage from the rows `old` of particles `was` to b. now: index in p of each particle
 * of `was`, images included, -1: not in p. Both sets have all neighbours of peridynamic particles. */
void bonds_take(struct bonds *b, struct particles *p, const struct bonds *old, const struct particles *was,
                const int32_t *now);

/* Saves or restores broken bonds and plastic state; rows are rebuilt, not stored. Trial archives contain only the
 * plastic state of the bonds, without the work of broken ones. */
status bonds_archive(struct bonds *b, struct particles *p, struct archive *a);

/* Returns Q of the remaining bonds of a row [m^2], summed anew: a difference would leave round-off at the last
 * bonds. */
real state_weight_left(const struct bonds *b, int64_t row);

/* Recomputes Q of every row from its present bonds; state-based models only. */
void state_weigh(struct bonds *b, const struct particles *p, const struct bond_source *s);

/* Returns the first violated invariant of bond_storage.h as text, or NULL. */
const char *bonds_fault(const struct bonds *b);

/* Returns the bond energy released by breaking so far [J]. */
real bonds_fracture_energy(const struct bonds *b);

/* Returns the rows of a row block that have an intact bond, one bit each. */
static inline unsigned bonds_intact(const struct bonds *b, int64_t row_block)
{
    const struct stencil *stencil = b->stencil[row_block];
    unsigned bits = 0;
    for (int k = 0; stencil && k < stencil->columns; k++) bits |= stencil->column[k].intact;
    if (stencil) return bits;
    for (int64_t column = b->column[row_block]; column < b->column[row_block] + b->column_count[row_block]; column++)
        bits |= b->common[column].intact;
    return bits;
}

/* Returns true if particle i has a row with an intact bond. (Rows are made for eight particles at once, so a row may be
 * empty.) */
static inline bool bonds_has(const struct bonds *b, int64_t i)
{
    const int64_t row = b->row_of[i];
    return row >= 0 && bonds_intact(b, row / LANES) >> row % LANES & 1;
}

/* Clears the bits in `marks` [n_all bits] of the particles and images to which a row has intact bonds; row -1: does
 * nothing. */
void bonds_unmark(const struct bonds *b, int64_t row, uint64_t *marks);

/* Returns the number of directed bonds of a row block, broken ones included. */
static inline int32_t row_block_bonds(const struct bonds *b, int64_t row_block) { return b->made[row_block]; }

/* Returns the number of columns of a row block, the largest possible number of bonds of its rows. */
static inline int64_t bonds_columns(const struct bonds *b, int64_t row_block) { return b->column_count[row_block]; }

/* Returns the neighbour of lane 0 of column k if the eight are consecutive, else -1. */
static inline int64_t column_first(const struct bonds *b, int64_t row_block, int64_t k)
{
    const struct stencil *stencil = b->stencil[row_block];
    return stencil ? b->particle[row_block * LANES] + stencil->column[k].offset : b->first[b->column[row_block] + k];
}

/* A column as it is stored, or would be if the row block were not implicit. */
struct column_copy {
    int32_t first, nbr[LANES];
    real inverse_length[LANES], w[LANES];
};

/* Reads column k of a row block into *to; writes nothing to b. */
void column_read(struct column_copy *to, const struct bonds *b, int64_t row_block, int64_t k);

/* A bond of a row as stored: 1/r, negative if load has broken it [1/m]; w = 0 if broken or cut [1]; `entry`: index in
 * plastic_stretch, plastic_path and pair. */
struct bond {
    int64_t entry;
    int32_t nbr;
    real inverse_length, w;
};

/* Returns bond k of a row block, lane l, padding included (inverse_length 0). Writes nothing. */
static inline struct bond bond_read(const struct bonds *b, int64_t row_block, int64_t k, int lane)
{
    const int64_t q = (b->column[row_block] + k) * LANES + lane;
    if (!__atomic_load_n(&b->implicit[row_block], __ATOMIC_ACQUIRE))
        return (struct bond){q, b->nbr[q], b->inverse_length[q], b->w[q]};
    const struct stencil_column *of = &b->stencil[row_block]->column[k];
    const real w = b->stencil[row_block]->w[k][lane];
    return (struct bond){q, b->particle[row_block * LANES] + of->offset + lane, w == 0 ? 0 : of->inverse_length, w};
}

/* Iterator over the bonds of a row in the order of their columns, including bonds that are broken or cut by pre-cracks.
 * Writes nothing:
 *
 *     for (struct bond_iterator it = bonds_of_row(b, row); bond_next(&it);) ... it.bond ... */
struct bond_iterator {
    struct bond bond;
    const struct bonds *b;
    int64_t row_block, k, columns;
    int lane;
};

/* Returns the iterator of a row; row < 0: no bonds. */
static inline struct bond_iterator bonds_of_row(const struct bonds *b, int64_t row)
{
    if (row < 0) return (struct bond_iterator){.b = b};
    return (struct bond_iterator){{0}, b, row / LANES, 0, b->column_count[row / LANES], (int)(row % LANES)};
}

/* Advances to the next bond, it->bond. Returns false at the end. */
static inline bool bond_next(struct bond_iterator *it)
{
    while (it->k < it->columns) {
        it->bond = bond_read(it->b, it->row_block, it->k++, it->lane);
        if (it->bond.inverse_length != 0) return true;
    }
    return false;
}

#endif
