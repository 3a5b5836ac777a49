/* Bonds in compressed rows, eight rows to a vector.
 *
 * Rows exist only for peridynamic particles (whole family) and hand-shake material points (their peridynamic
 * neighbours), in ascending particle order: memory and time follow the crack, not the body. Eight consecutive rows
 * form a row block; a row block stores its bonds column by column, lane l of a column being a bond of row l:
 *
 *     row block g        row 8g   row 8g+1  ...  row 8g+7
 *     column[g]        nbr      nbr            nbr          one vector load each of nbr, w, inverse_length
 *     column[g]+1      ...
 *
 * Rows shorter than their row block are padded with w = 0. Where the rows of a row block see neighbours at the same
 * index distances (a lattice), a column holds one distance, its eight neighbours are consecutive in memory from
 * `first` on, and one load replaces the gather; the hot loop then does not even read nbr. Where the bonds of such a
 * column also weigh the same, the loop reads what they have in common and two bytes a bond instead of twelve.
 *
 * Most row blocks of a lattice have, index distance by index distance, the bonds that others have. They follow one
 * stencil, read from the nearest cache, and store nothing of their own (they are implicit) until one of their bonds
 * is read by index or breaks. Room for all columns is kept, but only what is written takes memory.
 *
 * Rows made anew leave row blocks that have not changed where they are stored, and put others behind all that is:
 * between them lie columns of row blocks that are no more, until there is no room and all move together. */
#ifndef CLEAVE_BONDS
#define CLEAVE_BONDS

#include "base/archive.h"
#include "data/cells.h"
#include "data/material.h"
#include "data/region.h"
#include "data/active_set.h"

#define BYTES_PER_BOND 24.0              /* stored, with padding; measured on blocks of 10^6 particles */

enum volume_rule { VOLUME_WHOLE, VOLUME_RAMP, VOLUME_CUT_RAMP };
enum calibration { CALIBRATION_LATTICE, CALIBRATION_CONTINUUM, CALIBRATION_VMPD };
enum surface_rule { SURFACE_NONE, SURFACE_VOLUME };
enum shell_rule { SHELLS_UNIFORM, SHELLS_ISOTROPIC };
/* Influence function omega(r): 1, exp(-r^2/delta^2), delta/r, (delta/r)^2, 1 - r/(delta + spacing). */
enum influence { INFLUENCE_ONE, INFLUENCE_GAUSSIAN, INFLUENCE_INVERSE, INFLUENCE_INVERSE_SQUARE, INFLUENCE_LINEAR };

/* How a family is made and weighed. */
struct family {
    enum space space;
    enum volume_rule volume;
    enum calibration calibration;
    enum surface_rule surface;
    enum shell_rule shells;
    enum influence influence;
    real spacing;                        /* [m]                                                      */
    real horizon;                        /* delta [m]                                                */
    real cutoff;                         /* farthest neighbour, with its relative tolerance [m]      */
    real section;                        /* A (1D) [m^2], thickness (2D) [m], 1 (3D)                 */
    real cell_volume;                    /* of a lattice particle: spacing^dim section [m^3]         */
    real full;                           /* sum V_j beta of a full family [m^3]                      */
    real weighted;                       /* sum omega beta r^2 of a full family, weights as stored [m^2] */
    real shell_weight[2];                /* along the axes; along the diagonals (shells: isotropic)  */
};

/* When bonds break: critical stretch by pair of materials, [materials^2]; INFINITY: never. */
struct bond_limit {
    const real *critical_stretch;
    int materials;
    bool whole_force;                    /* in the step in which a bond breaks; else half of it                */
};

/* No bond breaks: one row of stretches for all pairs of materials. */
extern const struct bond_limit bond_limit_never;

/* When bonds yield, by pair of materials: stretch s_y and hardening modulus over the bond's own, H_b/k_e [materials^2].
 * stretch NULL: no bond ever does. */
struct bond_yield {
    const real *stretch, *hardening;
    int materials;
};

/* What yielding has done to a bond: stretch without force, and the way it was yielded back and forth. */
struct bond_plasticity { real stretch, path; };

/* Block-Gershgorin bound of the eigenvalues of springs round one particle: the largest row sum of sum K n n plus sum
 * K. */
struct spring_bound { real block[DIM_MAX][DIM_MAX], total; };     /* [N/m] */

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

/* State-based materials: A and B of kernels/pd/state_laws.h [Pa]. */
struct state_modulus { real A, B; };
static inline struct state_modulus state_modulus_of(const struct material *m, enum space space, bool rotates)
{
    const real D = space_dim(space);
    return (struct state_modulus){D * D * (rotates ? m->c12 : m->c12 - m->shear), (rotates ? 2 : D + 2) * D * m->shear};
}

/* Where a mirror image comes from, and the axis that its mirror turns round (-1: none, a clamped plane). */
struct state_image { int32_t source; int axis; };

/* Bonds from rows to images in clamped planes (of an image, too). The displacement of such an image is that of its
 * source turned round, P u, while its place is reflected: no symmetry gives the force on the image, so it is brought
 * back to the source (kernels/pd/clamp_force.c). */
struct clamp_end { int32_t bond; int8_t sign[DIM_MAX]; }; /* what a bond's reaction gives to a particle, by component */
struct clamped {
    int64_t n;                           /* arrays have room for LANES more, which weigh nothing          */
    int64_t *entry;                      /* [n] of what bonds store                                       */
    int32_t *from, *to;                  /* [n] particle of the row, image                                */
    real *inverse_length, *w;            /* [n] as stored; before the last sweep                 [1/m], [1] */
    bool stale;                          /* weights have changed since then                               */
    real *reaction[DIM_MAX];             /* [n] on the image, of the energy that the row counts       [N] */
    int64_t held;                        /* particles at the ends of such bonds, and of those that pull at each: */
    int32_t *particle;                   /* [held] ascending                                              */
    int64_t *first;                      /* [held + 1]                                                    */
    struct clamp_end *end;
};

enum { ROTATION_NUMBERS = ROTATION };                /* numbers that hold a rotation */

/* What particles know of their families; only state-based models have it. Material points with rows then have
 * particles.end_*. */
struct state {
    const struct state_modulus *modulus; /* [materials]; NULL: bonds know nothing but themselves             */
    bool local;                          /* Q of what a family still has, not of a full one                   */
    real *weighted;                      /* [row blocks 8] Q                                               [m^2] */
    uint8_t *past;                       /* [row blocks] the last sweep saw a bond that may have passed its limit  */
    real *pressure, *spring;             /* [n_all] P and g                                          [N/m^2], [N/m] */
    /* [n_all] rotation R and g (kernels/pd/rotation.h); only models with rotations: g (R - 1), row major, in the
     * plane [N/m]; sqrt(2 g) times the quaternion of R, its scalar last, in space [(N/m)^1/2] */
    real *rotation[ROTATION_NUMBERS];
    struct state_image *image;           /* [n_all - n]                                                       */
};

/* Lengths of a lattice: spacing sqrt(k). */
enum { BOND_LATTICE = 256 };
struct bond_length { real inverse, length, square; };  /* [1/m], [m], [m^2] */

/* What the eight bonds of a column have in common; a copy of what first, w and inverse_length say, made by
 * bonds_share: all that the hot loops read of a column on a lattice, four bytes a bond. */
struct bond_column {
    int16_t excess[LANES];               /* |inverse_length| over the lattice's, in units of the last place: positions
                                            are rounded; the sum is exact                                 */
    real w;                              /* of its intact bonds, where they are alike [1]                 */
    int32_t first;                       /* as below                                                      */
    uint8_t intact;                      /* bit l: the bond of lane l is intact                           */
    uint8_t lattice;                     /* k: consecutive neighbours, lengths those of lattice[k] up to the
                                            round-off of positions; 0: not so                             */
    uint8_t alike;                       /* so, and the intact bonds weigh the same                       */
    uint8_t unused;                      /* two of them in a cache line                                   */
};

/* A column in every row block of a stencil. */
struct stencil_column {
    int32_t offset;                      /* from the particles of the rows to their neighbours, by number */
    uint8_t intact, lattice;             /* as above                                       */
    uint16_t unused;                     /* stencils are compared byte by byte             */
    real inverse_length, w;              /* [1/m]; of a bond [1]                           */
    real length;                         /* 1/inverse_length [m]                           */
    real weighted, squared;              /* w |xi| and w |xi|^2 of the lattice's |xi| [m], [m^2] */
    real xi[DIM_MAX], w_xi[DIM_MAX];     /* X_j - X_i, and w times that [m]                */
};

/* Row blocks of eight particles in a row that have the same neighbours at the same distances with the same weights,
 * nothing broken: most of a lattice. They read one list of columns, which stays in the nearest cache, and bonds cost
 * their arithmetic. Their own columns are written only when a bond is read by index (row_block_expand). */
struct stencil {
    int columns;
    bool whole;                          /* all lanes have all bonds, of one weight        */
    bool unit;                           /* which is 1                                     */
    int32_t next;                        /* with the same hash, -1: none                   */
    struct stencil_column *column;           /* [columns]                                        */
    real (*w)[LANES];                    /* [columns] of the lanes, 0: no bond [1]           */
};
struct stencils;                         /* all of them (bonds_stencils.c)                 */
struct lattice;                          /* the map of its sites (bonds_site_map.c)         */

struct bonds {
    int64_t rows, row_blocks, columns;
    int64_t used, room;                  /* columns of which something is or was stored; that there is room for */
    int64_t n;                           /* directed bonds in the rows, broken ones included              */
    int32_t reach;                       /* row blocks: no bond leads to a row farther on                     */
    int32_t *particle;                   /* [row blocks 8] particle of a row; padding rows repeat the last    */
    int32_t *row_of;                     /* [n_all] row of a particle, -1 without                         */
    int64_t *column;                       /* [row blocks] first column of a row block                                */
    int32_t *column_count;                 /* [row blocks] its columns                                            */
    uint8_t *whole;                     /* [row blocks 8] the row holds the whole family: its particle is peridynamic */
    int32_t *made;                       /* [row blocks] directed bonds of the row block, broken ones included    */
    uint8_t *aligned;                    /* [row blocks] the eight particles are consecutive                  */
    int32_t *first;                      /* [columns] neighbour of lane 0 where the eight are consecutive, else -1 */
    int32_t *nbr;                        /* [columns 8] neighbour                                           */
    real *inverse_length;                /* [columns 8] 1/|X_j - X_i|; negative: broken, so that its stretch is below
                                            -1 and never looks like breaking; 0: padding        [1/m]     */
    real *w;                             /* [columns 8] symmetric weight: beta x surface x V_i V_j c_ij over
                                            stiffness; 0: broken, cut or padding                [1]       */
    struct bond_column *common;            /* [columns]                                                       */
    struct bond_length *lattice;         /* [BOND_LATTICE]                                                */
    const struct stencil **stencil;      /* [row blocks] what a row block follows, NULL: nothing                  */
    uint8_t *implicit;                     /* [row blocks] its columns are not written                            */
    uint8_t *changed;                 /* [row blocks] weights are not those that it was made with: it follows nothing */
    struct stencils *stencils;
    struct lattice *site_map;               /* kept where there are material points; else NULL                     */
    real *plastic_stretch, *plastic_path;   /* [columns 8] s_p and alpha of a bond; NULL where none yields   [1]  */
    int32_t *pair;                       /* [columns 8] entry of `yield`; NULL where none yields               */
    struct bond_yield yield;
    real *trigger;                       /* [row blocks 8] no bond of the row breaks below this stretch       */
    float *family_volume;                /* [row blocks 8] sum V_j of the whole initial family      [m^3]     */
    float *broken_volume;                /* [row blocks 8] of its broken bonds                      [m^3]     */
    real *fracture_energy;               /* [row blocks 8] half of each broken bond's energy        [J]       */
    real *plastic_work;                  /* [row blocks 8] half of what its broken bonds had dissipated    [J] */
    int32_t *broken;                     /* [row blocks 8] bonds broken by load since the start               */
    struct state state;
    struct clamped clamped;
    struct active_set active;                    /* of blocks of rows                                             */
    real stiffness;                      /* c V V of a bond between reference particles: force = stiffness w s [N] */
};

/* Everything that bonds_make needs besides particles. */
struct bond_source {
    struct family family;
    const struct cells *cells;           /* reference search, edge >= cutoff                          */
    const struct material *material;
    int materials;
    struct bond_limit limit;
    struct bond_yield yield;
    const struct state_modulus *modulus; /* of state-based models, else NULL                          */
    bool local, rotates;                   /* normalisation by what a family has; model with rotations  */
    const int *mirror_axis;              /* [loads] axis of a plane of symmetry, -1: clamped          */
    const struct crack *crack;
    int cracks;
    const struct image *image;           /* of loads                                                  */
    int room;                            /* most neighbours of a particle (bonds_room); 0: counted when needed */
    const real *neighbour_volume;        /* [n_all] V_i^H = sum V_j beta, for the surface correction; NULL without */
};

/* Horizon and cutoff, shell weights, and the sum over a full family on the lattice. The rules (volume, calibration,
 * surface, shells) must be set before. */
void family_make(struct family *f, enum space space, real spacing, real horizon_in_spacings, real section);
/* c of a material in this family [N/m^6]. */
real family_micro_modulus(const struct family *f, const struct material *m);
/* Elastic constants of a full family on the lattice under uniform strain [Pa]: C_abcd = 1/(2V) sum c V V w r e_a e_b
 * e_c e_d, cubic, with the shear modulus equal to C12; shell weights and partial volumes as they are. */
void family_constants(const struct family *f, const struct material *m, real *c11, real *c12);
/* Work that separates a lattice of the model with rotations normal to a plane, over the square of the stretch at
 * which its bonds break [N/m] (separation.c). */
real family_separation(const struct family *f, const struct state_modulus *m, bool local);
/* Most scenes: all bonds weigh shell_weight[0], nothing to work out. */
static inline bool family_plain(const struct family *f)
{
    return f->volume == VOLUME_WHOLE && f->influence == INFLUENCE_ONE && f->shell_weight[0] == f->shell_weight[1];
}
/* beta x omega x shell weight of a reference bond of components xi and length r [1]. */
real family_weight(const struct family *f, const real *xi, real r);

/* Does one of the cracks cut the line between two particles (reference positions)? */
bool cracks_part(const struct crack *crack, int cracks, const struct particles *p, int64_t i, int64_t j);

/* No particle has more within the cutoff (cells_most); reference positions do not move, so once is enough. */
int bonds_room(const struct bond_source *s);

/* V_i^H = sum V_j beta of every particle, uncracked [m^3], n_all entries. */
void bonds_neighbour_volume(real *volume, const struct particles *p, const struct bond_source *s);

/* Makes the rows of all peridynamic and hand-shake particles. With `old` (rows made before, whose columns are
 * invalid afterwards) broken bonds stay broken and counts are carried over. Bonds cut by a crack have w = 0 and
 * count as damage. Sets the damage of all peridynamic particles. */
void bonds_make(struct bonds *b, struct bonds *old, struct particles *p, const struct bond_source *s);
/* Images become what they are images of. */
void bonds_images_follow(struct particles *p, const struct bond_source *s);
/* Makes lists of particles and rows after particles changed their kind. Particles that have lost their row have no
 * bond force. */
void bonds_renew(struct bonds *b, struct particles *p, const struct bond_source *s);
/* What the springs of a row hold together with [N/m]: a bound of the largest eigenvalue of its stiffness
 * (spring_bound_of). */
real bonds_row_bound(const struct bonds *b, const struct particles *p, int64_t row);
void bonds_free(struct bonds *b);
/* Updates what the bonds of a column share, from their weights and lengths. To be called after a change of w or of
 * the sign of inverse_length, mostly through bonds_changed. Shared and unshared columns give the same bits. */
void bonds_share(const struct bonds *b, int64_t column);
/* The weight of bond q of a row has changed: its row block follows no stencil any more. */
void bonds_changed(struct bonds *b, int64_t row, int64_t q);
/* What a column stores, for readers of whole bodies: nothing is unfolded. */
struct column_copy { int32_t first, nbr[LANES]; real inverse_length[LANES], w[LANES]; };
/* Slot k of a row block. */
void column_read(struct column_copy *to, const struct bonds *b, int64_t row_block, int64_t k);

/* Critical time step of the peridynamic side [s]: 2 / omega_max with the block-Gershgorin bound over
 * all particles of the body as if all were peridynamic. */
real bonds_critical_step(const struct particles *p, const struct bond_source *s);
/* The same where all are peridynamic and no bond has been broken, from the rows that there are. */
real bonds_critical_step_made(const struct bonds *b, const struct particles *p);

/* The state that rows made anew do not know: what load has broken. */
status bonds_archive(struct bonds *b, struct particles *p, struct archive *a);

/* Q of what a row has left, bond by bond: a difference would leave round-off for the last of them [m^2]. */
real state_weight_left(const struct bonds *b, int64_t row);
/* Q of every row anew, for what is broken now. Nothing without state-based models. */
void state_weigh(struct bonds *b, const struct particles *p, const struct family *f);

/* Bond energy released by breaking so far [J]. */
real bonds_fracture_energy(const struct bonds *b);

/* Are all eight rows of a row block there and peridynamic? */
static inline bool row_block_whole(const struct bonds *b, int64_t row_block)
{
    return eight_bytes(b->whole + row_block * LANES) == EIGHT_TIMES(1);
}

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

/* A bond of a row as stored: 1/r negative where load has broken it [1/m], w = 0 where it is broken or cut [1]; `entry`
 * is its place in plastic_stretch, plastic_path and pair. */
struct bond { int64_t entry; int32_t nbr; real inverse_length, w; };

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
struct bond_iterator { struct bond bond; const struct bonds *b; int64_t row_block, k, columns; int lane; };

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

/* Writes the columns of an implicit row block from its stencil; thread-safe. */
void row_block_expand(struct bonds *b, int64_t row_block);

/* Place of bond k of a row block, lane l, in the arrays of bonds, for writers: the row block is expanded first. After a
 * change of w or of the sign of inverse_length follows bonds_changed. */
static inline int64_t bond_to_write(struct bonds *b, int64_t row_block, int64_t k, int lane)
{
    if (__atomic_load_n(&b->implicit[row_block], __ATOMIC_ACQUIRE)) row_block_expand(b, row_block);
    return (b->column[row_block] + k) * LANES + lane;
}

#endif
