/* Room `bonds`: families of particles and the bonds between them. It knows particles, cells, materials and regions, but
 * neither loads nor the step; kernels, coupling, fracture, solver and engine call it. family.h says which bonds there
 * are, bond_storage.h how they are stored; this header makes and reads them. */
#ifndef CLEAVE_BONDS
#define CLEAVE_BONDS

#include "base/archive.h"
#include "bonds/bond_storage.h"

#define BYTES_PER_BOND 24.0 /* stored, with padding; measured on blocks of 10^6 particles */

/* Block-Gershgorin bound of the eigenvalues of springs round one particle: the largest row sum of sum K n n plus sum
 * K. */
struct spring_bound {
    real block[DIM_MAX][DIM_MAX], total;
}; /* [N/m] */

static inline void spring_bound_add(struct spring_bound *s, real K, const real *n, int dim)
{
    for (int a = 0; a < dim; a++)
        for (int c = 0; c < dim; c++) s->block[a][c] += K * n[a] * n[c];
    s->total += K;
}

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

/* Does one of the cracks cut the line between two particles (reference positions)? */
bool cracks_part(const struct crack *crack, int cracks, const struct particles *p, int64_t i, int64_t j);

/* Upper bound of the neighbours of a particle (cells_most). Reference positions do not move: computed once. */
int bonds_room(const struct bond_source *s);

/* V_i^H = sum V_j beta of every particle, uncracked [m^3], n_all entries. */
void bonds_neighbour_volume(real *volume, const struct particles *p, const struct bond_source *s);

/* Makes the rows of all peridynamic particles and bonded material points. With `old` (rows made before, whose columns
 * are invalid afterwards) broken bonds stay broken and counts are carried over. Bonds cut by a crack have w = 0 and
 * count as damage. Sets the damage of all peridynamic particles. */
void bonds_make(struct bonds *b, struct bonds *old, struct particles *p, const struct bond_source *s);
/* Images take the kind of their sources. */
void bonds_images_follow(struct particles *p, const struct bond_source *s);
/* Makes lists of particles and rows after particles changed their kind. Particles that have lost their row have no
 * bond force. */
void bonds_renew(struct bonds *b, struct particles *p, const struct bond_source *s);
/* What the springs of a row hold together with [N/m]: a bound of the largest eigenvalue of its stiffness
 * (spring_bound_of). */
real bonds_row_bound(const struct bonds *b, const struct particles *p, int64_t row);
void bonds_free(struct bonds *b);
/* Critical time step of the peridynamic side [s]: 2 / omega_max with the block-Gershgorin bound over
 * all particles of the body as if all were peridynamic. */
real bonds_critical_step(const struct particles *p, const struct bond_source *s);
/* The same where all are peridynamic and no bond has been broken, from the rows that there are. */
real bonds_critical_step_made(const struct bonds *b, const struct particles *p);

/* Takes what load has broken from rows `old` of a set of particles whose numbers are `now` [all of it, images included]
 * in this one, -1: not in it. Both sets have all neighbours of peridynamic particles. */
void bonds_take(struct bonds *b, struct particles *p, const struct bonds *old, const struct particles *was,
                const int32_t *now);
/* Saves or restores what load has broken and the plastic state; all else is made anew. In a trial: the plastic state
 * of the bonds, without the work of those that are broken. */
status bonds_archive(struct bonds *b, struct particles *p, struct archive *a);

/* Q of what a row has left, bond by bond: a difference would leave round-off for the last of them [m^2]. */
real state_weight_left(const struct bonds *b, int64_t row);
/* Q of every row anew, for what is broken now. Nothing without state-based models. */
void state_weigh(struct bonds *b, const struct particles *p, const struct bond_source *s);

/* The first invariant of bond_storage.h that these bonds break, NULL: none. */
const char *bonds_fault(const struct bonds *b);

/* Bond energy released by breaking so far [J]. */
real bonds_fracture_energy(const struct bonds *b);

/* Rows of a row block that have an intact bond: a bit each. */
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

/* Has the row of a particle an intact bond? Rows come in eights: some have none. */
static inline bool bonds_has(const struct bonds *b, int64_t i)
{
    const int64_t row = b->row_of[i];
    return row >= 0 && bonds_intact(b, row / LANES) >> row % LANES & 1;
}

/* Clears the bits of the particles and images to which a row has intact bonds; row -1: none. */
void bonds_unmark(const struct bonds *b, int64_t row, uint64_t *marks);

/* Directed bonds of a row block, broken ones included. */
static inline int32_t row_block_bonds(const struct bonds *b, int64_t row_block) { return b->made[row_block]; }

/* Columns of a row block: no row of it has more bonds. */
static inline int64_t bonds_columns(const struct bonds *b, int64_t row_block) { return b->column_count[row_block]; }

/* Neighbour of lane 0 of column k where the eight are consecutive, else -1. */
static inline int64_t column_first(const struct bonds *b, int64_t row_block, int64_t k)
{
    const struct stencil *stencil = b->stencil[row_block];
    return stencil ? b->particle[row_block * LANES] + stencil->column[k].offset : b->first[b->column[row_block] + k];
}

/* A column as it is stored, or would be: for readers of whole columns. Nothing is written. */
struct column_copy {
    int32_t first, nbr[LANES];
    real inverse_length[LANES], w[LANES];
};
void column_read(struct column_copy *to, const struct bonds *b, int64_t row_block, int64_t k);

/* A bond of a row as stored: 1/r negative where load has broken it [1/m], w = 0 where it is broken or cut [1]; `entry`
 * is its place in plastic_stretch, plastic_path and pair. */
struct bond {
    int64_t entry;
    int32_t nbr;
    real inverse_length, w;
};

/* Bond k of a row block, lane l, padding included (inverse_length 0). Nothing is written. */
static inline struct bond bond_read(const struct bonds *b, int64_t row_block, int64_t k, int lane)
{
    const int64_t q = (b->column[row_block] + k) * LANES + lane;
    if (!__atomic_load_n(&b->implicit[row_block], __ATOMIC_ACQUIRE))
        return (struct bond){q, b->nbr[q], b->inverse_length[q], b->w[q]};
    const struct stencil_column *of = &b->stencil[row_block]->column[k];
    const real w = b->stencil[row_block]->w[k][lane];
    return (struct bond){q, b->particle[row_block * LANES] + of->offset + lane, w == 0 ? 0 : of->inverse_length, w};
}

/* The bonds of a row in order of their columns, broken ones and those cut by pre-cracks included. Nothing is written:
 *
 *     for (struct bond_iterator it = bonds_of_row(b, row); bond_next(&it);) ... it.bond ... */
struct bond_iterator {
    struct bond bond;
    const struct bonds *b;
    int64_t row_block, k, columns;
    int lane;
};

/* `row` < 0: no bonds. */
static inline struct bond_iterator bonds_of_row(const struct bonds *b, int64_t row)
{
    if (row < 0) return (struct bond_iterator){.b = b};
    return (struct bond_iterator){{0}, b, row / LANES, 0, b->column_count[row / LANES], (int)(row % LANES)};
}

static inline bool bond_next(struct bond_iterator *it)
{
    while (it->k < it->columns) {
        it->bond = bond_read(it->b, it->row_block, it->k++, it->lane);
        if (it->bond.inverse_length != 0) return true;
    }
    return false;
}

#endif
