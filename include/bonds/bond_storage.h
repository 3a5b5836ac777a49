/* Storage of bonds. Only src/bonds and kernels/pd use the members of these structures (tests/house.sh); all
 * other files read bonds through the iterator of bonds.h.
 *
 * A bond row contains the bonds of one particle. Rows exist only for peridynamic particles (bonds to all
 * neighbours) and for material points with bonds (bonds to peridynamic neighbours), in ascending order of the
 * particles. Memory and time thus depend on the size of the peridynamic zone, not of the body. Eight
 * consecutive rows form a block (SELL-C layout with C = 8, Kreutzer et al. 2014), which stores its bonds
 * column by column: a column has eight bonds, lane l of it being a bond of row l of the block; shorter rows
 * are padded. Kinds of columns (enum column_kind of kernels/pd/bond_column.h), and the data that the loops
 * over bonds read of each:
 *
 *   block     kind     the eight bonds                                           nbr 1/r w  common stencil
 *   stores    FREE     any neighbours, or consecutive ones from first on         x   x   x  first
 *   stores    SHELL    consecutive, lengths of shell k up to round-off                   x  x
 *   stores    ALIKE    as SHELL, intact ones of one weight: four bytes per bond             x
 *   implicit  STENCIL  as in other blocks, each lane with its own weight                           x
 *   implicit  WHOLE    as STENCIL, all lanes present, one weight                                   x
 *   implicit  UNIT     as WHOLE, with weight 1                                                     x
 *
 * In blocks of eight rows that store columns, the arrays `nbr`, `inverse_length` and `w` are complete, and
 * `common` is derived from them by bond_column_update_common_bond_properties. All kinds give bitwise equal
 * forces. Where the eight particles of a block have neighbours at equal index distances (on a lattice), a
 * column has one distance, and its eight neighbours are consecutive.
 *
 * Most blocks of a lattice have equal bonds at equal index distances. They follow one stencil (struct
 * stencil), which stays in the nearest cache, and are implicit: they store no columns of their own until one
 * of their bonds is written. Address space is reserved for all columns, but only written columns take memory.
 *
 * When rows are rebuilt, unchanged blocks of eight rows keep their columns; others are written to free
 * columns of removed blocks, or behind all stored columns.
 *
 * Invariants (bonds_describe_first_inconsistency, called by builds with -DCLEAVE_ASSERT whenever rows are
 * made):
 *     rows ascend by particle, and row_of is the inverse of `particle`;
 *     an implicit block of eight rows follows a stencil, has as many columns as this, and no broken bond;
 *     a bond with w != 0 has inverse_length > 0;
 *     the neighbour of a bond with w != 0, if it has a row, is within `reach` blocks of eight rows;
 *     a lane without a bond (inverse_length 0) has w = 0;
 *     first >= 0 means that the neighbours of the lanes with a bond are first + lane;
 *     common has the intact lanes, and first, of the stored columns. */
#ifndef CLEAVE_BOND_STORAGE
#define CLEAVE_BOND_STORAGE

#include "bonds/family.h"
#include "data/active_set.h"

/* Largest ratio of the stiffness of the repulsive core of a bond, which acts when the bond is strongly compressed
 * (kernels/pd/bond_core.h), to the stiffness of the bond. */
#define CORE_STIFFNESS 3.0

/* Plastic state of a bond: `stretch` at which its force is 0, and `path`, the accumulated plastic stretch [1]. */
struct bond_plasticity {
    real stretch, path;
};

/* Value of the members `onset` and `most` of struct softened for a bond that may not soften yet, or is brittle. The
 * member `end` of this bond is then the stretch above which the bond is examined. */
#define SOFTENING_NEVER 1e30f

/* Tells whether bonds of a block of eight rows (the bonds of eight particles) must be examined for the onset of
 * softening before the forces of bonds are computed next. */
enum softening_due {
    DUE_NOT,       /* no bond of the block of eight rows may begin to soften */
    DUE_NEW,       /* a bond may begin to soften and is to be examined */
    DUE_AGAIN,     /* a bond was examined and may not soften yet; it is examined again if bond_limit.retries */
    DUE_DENIED = 4 /* bit that is set while blocks of eight rows are examined; becomes DUE_AGAIN afterwards */
};
/* State of the softening of all bonds (data/softening.h). Of a bond, k is the largest stretch so far, and d (0 to 1) is
 * the lost fraction of its stiffness; it begins to soften at the stretch s_0 and breaks at s_f. Arrays [columns 8] have
 * eight entries for each column, one per bond. They are valid in a block of eight rows (the bonds of eight particles)
 * once one of its bonds has begun to soften. */
struct softened {
    const struct softening_curve *curve; /* NULL: no bond softens */
    float *most, *onset, *end;           /* [columns 8] largest stretch k, s_0, s_f of each bond [1] */
    /* [columns 8] weight that a bond which softens had before [1]; only in state-based models, where the weight in
     * bonds.w is this times 1 - d (kernels/pd/state_soften.c). NULL: bond-based model */
    float *whole;
    /* [columns 8] in load steps (static equilibria): k of the last one, 0 for a bond that did not soften then [1];
     * forces follow from this k at any stretch, so that bonds are springs of their secant stiffness. NULL: explicit
     * time steps */
    float *settled;
    uint8_t *begun;   /* [row_blocks] 1: the arrays are valid */
    uint8_t *due;     /* [row_blocks] enum softening_due */
    bool any_due;     /* an entry of `due` is not DUE_NOT */
    bool at_points;   /* true: bonds that end at material points have begun to soften */
    uint8_t *needed;  /* [row_blocks 8] working memory: 1: the dilatation of the row is needed */
    real *dilatation; /* [row_blocks 8] working memory: trace of the strain of the neighbourhood [1] */
    /* [row_blocks 8] mean strain rate of the bonds of a particle while their stretch grows from half the onset to the
     * onset, 0 or less: outside this range [1/s]; time since half the onset was exceeded [s]. NULL: no strength depends
     * on the rate */
    real *rate, *beyond;
    bool rates_kept;           /* true: rates are to be measured in the next step */
    const struct image *image; /* [images] origins of the mirror images, borrowed from the loads */
    real least_ratio;          /* s_f of a bond is at least the trigger of its row times this [1] */
    uint8_t *near; /* [row_blocks] 1: the stretch of a bond has exceeded `gate` since the strength surfaces were
                      evaluated last (bonds_strength.c); NULL: no material has a strength surface */
    real gate;     /* stretch from which on the strength surface may be near [1] */
};

/* Origin of a mirror image, a copy of a particle beyond a plane of symmetry. source: index of that particle; axis: axis
 * normal to the plane, -1 if the plane is clamped instead. */
struct state_image {
    int32_t source;
    int axis;
};

/* One reaction force that a particle receives from a bond to its image in a clamped plane (a plane at which all motion
 * is prevented). bond: index of the bond in the arrays of struct clamped, from 0; sign: factor +1 or -1 on each
 * component of the reaction. */
struct clamp_end {
    int32_t bond;
    int8_t sign[DIM_MAX];
};

/* Bonds from particles to their mirror images in clamped planes (planes at which all motion is prevented), images of
 * images included. The displacement of such an image is that of its source with reversed signs, while its reference
 * position is reflected. The force on the image therefore does not follow from symmetry, and its reaction is added to
 * the source particle (kernels/pd/clamp_force.c). */
struct clamped {
    int64_t n;                /* number of bonds; arrays have LANES more entries, of weight 0 */
    int64_t *entry;           /* [n] entry of the bond in the bond arrays */
    int32_t *from, *to;       /* [n] particle of the row; mirror image */
    real *inverse_length, *w; /* [n] as stored, before the last sweep [1/m], [1] */
    bool stale;               /* weights have changed since they were copied */
    real *reaction[DIM_MAX];  /* [n] force on the mirror image, from the energy of the row alone [N] */
    int64_t held;             /* particles that receive reactions */
    int32_t *particle;        /* [held] these particles, ascending */
    int64_t *first;           /* [held + 1] range of `end` for each of them */
    /* [first[held]] reactions on the particles, particle by particle */
    struct clamp_end *end;
};

/* State of the neighbourhood of each particle (all its neighbours) in state-based models, from which bond forces follow
 * (kernels/pd/state_laws.h): weighted volume Q, pressure P (part of the force that follows from the dilatation), spring
 * stiffness g (force per extension) and, in models with particle rotations, rotation R. V is the volume of the
 * particle. Material points with bonds have the members end_* of struct particles instead of P, g and R. Blocks of
 * eight rows hold the bonds of eight particles. */
enum { STATE_NUMBERS = 2 + ROTATION }; /* P, g and the entries of R */
struct state {
    const struct state_modulus *modulus; /* [materials] elastic moduli, borrowed; NULL: bond-based model */
    bool local;                          /* Q is summed over the present neighbourhood, not over a full one */
    real *weighted;                      /* [row_blocks 8] weighted volume Q [m^2] */
    real share;    /* V/Q of a full neighbourhood, where moduli refer to it; 0: V/Q of each neighbourhood [m] */
    uint8_t *past; /* [row_blocks] 1: a bond may have exceeded its breaking stretch in the last computation of forces */
    uint8_t *pressed; /* [row_blocks] 1: a bond is so short that its repulsive core acts (kernels/pd/bond_core.h) */
    real *pressure, *spring; /* [n_all] pressure P [N/m^2] and spring g [N/m] */
    /* [n_all] rotation R with spring g (kernels/pd/rotation.h), only in models with rotations. 2D: g (R - 1), row major
     * [N/m]; 3D: sqrt(2 g) times the quaternion of R, its scalar last [(N/m)^1/2] */
    real *rotation[ROTATION];
    real *before[STATE_NUMBERS]; /* [n_all] P, g and R before bonds broke, in blocks of eight rows that are `past` */
    struct state_image *image;   /* [n_all - n] origins of the mirror images */
};

/* Number of bond lengths of a lattice that are tabulated. */
enum { BOND_SHELLS = 256 };

/* Entry k < BOND_SHELLS of the table of bond lengths of a lattice: bonds of the length r = spacing sqrt(k). */
struct bond_length {
    real inverse, length, square; /* 1/r [1/m], r [m], r^2 [m^2] */
};

/* Properties that the eight bonds of one column (one bond of each particle of a block of eight rows) have in common,
 * derived from the arrays first, w and inverse_length by bond_column_update_common_bond_properties. On a lattice the
 * loops over bonds read only this structure, four bytes per bond. */
struct bond_column {
    int16_t excess[LANES]; /* |inverse_length| less that of the shell, in units of the last place: positions are
                              rounded; the sum is exact */
    real w;                /* weight of the intact bonds, if `alike` [1] */
    int32_t first;         /* copy of bonds.first */
    uint8_t intact;        /* bit l: the bond of lane l is intact */
    uint8_t shell; /* k: consecutive neighbours, with the lengths of shell_length[k] up to the round-off of positions;
                      0: other lengths, or not consecutive */
    uint8_t alike; /* true: shell > 0, and intact bonds have one weight */
    uint8_t begun; /* bit l: the bond of lane l has begun to soften; valid if the block of eight rows has
                      (softened.begun) */
};

/* One column of a stencil (struct stencil): a bond of each of eight consecutive particles, all to the neighbour at the
 * same index distance, as many blocks of eight rows (the bonds of eight particles) have it. */
struct stencil_column {
    int32_t offset;                  /* index of the neighbours less index of the particles of the rows */
    uint8_t intact, shell;           /* as in struct bond_column */
    uint16_t unused;                 /* always 0, since stencils are compared byte by byte */
    real inverse_length, w;          /* 1/r [1/m]; weight of one intact bond [1] */
    real length;                     /* 1/inverse_length [m] */
    real weighted, squared;          /* w |xi| [m] and w |xi|^2 [m^2] with |xi| of the lattice */
    real xi[DIM_MAX], w_xi[DIM_MAX]; /* X_j - X_i, and w times X_j - X_i [m] */
};

/* Pattern of bonds that many blocks of eight rows (the bonds of eight consecutive particles) have in common: neighbours
 * at equal index distances and equal reference vectors, equal weights (factors on the stiffness), no broken bond. Most
 * blocks of a lattice follow one of few stencils, whose columns stay in the nearest cache. Such a block writes columns
 * of its own only when a bond is accessed by index (bond_row_block_copy_bonds_from_stencil). */
struct stencil {
    int columns;                   /* number of columns, i.e. of bonds of a row */
    bool whole;                    /* all lanes have all bonds, with one weight */
    bool unit;                     /* all weights are 1 */
    int32_t next;                  /* next stencil with equal hash, -1: none */
    struct stencil_column *column; /* [columns] */
    real (*w)[LANES];              /* [columns] weights of the lanes, 0: no bond [1] */
};
struct stencil_table;    /* all stencils (bonds_stencils.c) */
struct lattice_site_map; /* particle at each site of a lattice (bonds_site_map.c) */

/* Range of free columns (eight bonds each) that a removed block of eight rows (the bonds of eight particles) has left:
 * `columns` columns from column number `column` on. Rebuilt rows are stored there. */
struct bond_hole {
    int64_t column;
    int32_t columns;
};

/* List of the ranges of free columns in the bond arrays, hole[n], which removed blocks of eight rows (the bonds of
 * eight particles) have left. */
struct bond_holes {
    int64_t n;
    struct bond_hole *hole;
};

/* The bonds of all particles, in arrays that this structure owns. A row has the bonds of one particle; a block has
 * eight rows, which are stored together; a column of a block has eight bonds, one of each row. Lengths of arrays:
 * [columns 8] one entry for each bond, [row_blocks 8] for each row, [row_blocks] for each block, [n_all] for each
 * particle or mirror image (copy beyond a plane of symmetry). */
struct bonds {
    int64_t rows, row_blocks, columns; /* numbers of rows, of blocks and of columns that all blocks need */
    int64_t used, room;                /* number of columns that are or were in use in the arrays; their capacity */
    int64_t n;         /* number of bonds, broken ones included (a bond between two particles with rows counts twice) */
    int32_t reach;     /* largest difference between the blocks of eight rows of both particles of a bond */
    int32_t *particle; /* [row_blocks 8] index of the particle of a row; padding rows repeat the last particle */
    int32_t *row_of;   /* [n_all] row of a particle, -1: none */
    int32_t *no_rows;  /* [n_all] all -1: spare array for the next row_of; NULL: none */
    int64_t *column;   /* [row_blocks] index of the first column of a block of eight rows */
    int32_t *column_count; /* [row_blocks] number of columns */
    uint8_t *whole;        /* [row_blocks 8] 1: row of a peridynamic particle, with the whole neighbourhood */
    int32_t *made;    /* [row_blocks] number of bonds in the rows of the block of eight rows, broken ones included */
    uint8_t *aligned; /* [row_blocks] 1: the eight particles have consecutive indices */
    int32_t *first;   /* [columns] neighbour of the first row if the eight neighbours are consecutive, else -1 */
    int32_t *nbr;     /* [columns 8] index of the neighbour j */
    real *inverse_length; /* [columns 8] 1/|X_j - X_i| [1/m]; negative: broken, so that the stretch is below -1 and
                             exceeds  no limit; 0: no bond (padding) */
    real *w; /* [columns 8] symmetric weight [1]: volume factor beta x surface factor x V_i V_j c_ij/stiffness; 0:
                broken, cut or no bond */
    struct bond_column *common;       /* [columns] */
    struct bond_length *shell_length; /* [BOND_SHELLS] */
    const struct stencil **stencil;   /* [row_blocks] stencil that a block of eight rows follows, NULL: none */
    uint8_t *implicit;                /* [row_blocks] 1: the columns are not written */
    uint8_t *changed; /* [row_blocks] 1: weights have changed since the block of eight rows was made; it follows no
                         stencil */
    struct bond_holes holes;              /* free columns of removed blocks of eight rows */
    struct stencil_table *stencils;       /* all stencils that blocks of eight rows may follow */
    struct lattice_site_map *site_map;    /* particle at each lattice site; NULL: there are no material points */
    real *plastic_stretch, *plastic_path; /* [columns 8] s_p and alpha of a bond; NULL if no bond yields [1] */
    int32_t *pair;                        /* [columns 8] pair of materials, index in `yield`; NULL: no bond yields */
    struct bond_yield yield;              /* yield stretches and hardening by pair of materials */
    real *trigger;            /* [row_blocks 8] lower bound of the stretches at which bonds of the row break [1] */
    float *family_volume;     /* [row_blocks 8] sum of V_j over all initial neighbours of the particle [m^3] */
    float *broken_volume;     /* [row_blocks 8] sum of V_j over the broken bonds [m^3] */
    real *fracture_energy;    /* [row_blocks 8] half of the energy of each broken bond [J] */
    real *plastic_work;       /* [row_blocks 8] half of the plastic work of the broken bonds [J] */
    int32_t *broken;          /* [row_blocks 8] number of bonds broken by load since the start */
    struct state state;       /* state-based models */
    struct clamped clamped;   /* bonds to images in clamped planes */
    struct softened soft;     /* softening */
    struct active_set active; /* blocks of eight rows that a wave has reached, which are computed */
    real core;      /* stiffness of the repulsive cores (kernels/pd/bond_core.h) divided by that of the bonds [1] */
    real stiffness; /* c V V of a bond between reference particles: force = stiffness w s [N] */
};

/* Returns true if block `row_block` of b (a group of rows, each with the bonds of one particle) has eight rows, all of
 * peridynamic particles. Each row then contains the bonds to all neighbours of its particle. */
static inline bool bond_row_block_has_eight_pd_particles(const struct bonds *b, int64_t row_block)
{
    return eight_bytes_as_word(b->whole + row_block * LANES) == EIGHT_TIMES(1);
}

/* Softening state of one bond, all members dimensionless. most: largest stretch so far; onset, end: stretches at which
 * softening begins and the bond breaks; whole: weight before softening, 0 for bond-based models, which do not store
 * it. */
struct bond_softening_state {
    float most, onset, end, whole;
};

/* Returns the softening state (struct bond_softening_state) to be stored for a bond that is brittle or has not begun to
 * soften. range: stretches at which softening begins (onset) and the bond breaks (end) [1], both the critical stretch
 * if the bond is brittle. The member `end` of the result is just below range.onset: once the stretch of the bond
 * exceeds it, the next sweep over the bonds checks whether the bond begins to soften. */
static inline struct bond_softening_state bond_softening_state_before_onset(struct softening_range range)
{
    return (struct bond_softening_state){SOFTENING_NEVER, SOFTENING_NEVER, (float)(range.onset * (1 - SOFTENING_LEAST)),
                                         0};
}

/* Returns the softening state (struct bond_softening_state) that `softened` stores for the bond with index `bond`. */
static inline struct bond_softening_state bond_softening_state_read(const struct softened *softened, int64_t bond)
{
    return (struct bond_softening_state){softened->most[bond], softened->onset[bond], softened->end[bond],
                                         softened->whole ? softened->whole[bond] : 0};
}

/* Stores `state` as the softening state of the bond with index `bond` in the arrays of b. Also updates the bit of this
 * bond in the properties of its column (eight bonds, one of each of eight particles) that is set if the bond has begun
 * to soften. */
static inline void bond_softening_state_write(struct bonds *b, int64_t bond, struct bond_softening_state state)
{
    struct bond_column *column = &b->common[bond / LANES];
    const unsigned lane = 1U << bond % LANES;
    b->soft.most[bond] = state.most, b->soft.onset[bond] = state.onset, b->soft.end[bond] = state.end;
    if (b->soft.whole) b->soft.whole[bond] = state.whole;
    column->begun = (uint8_t)(state.onset < SOFTENING_NEVER ? column->begun | lane : column->begun & ~lane);
}

/* Softening state of an entry of the bond arrays that contains no bond, because the particle has fewer bonds than
 * others of its block of eight rows (the bonds of eight particles): never softens. */
static const struct bond_softening_state bond_softness_none = {SOFTENING_NEVER, SOFTENING_NEVER, 2, 0};

/* Returns true if at least one bond of block `row_block` of eight rows of b (the bonds of eight particles) has begun to
 * soften. */
static inline bool bond_row_block_has_begun_softening(const struct bonds *b, int64_t row_block)
{
    return b->soft.curve && b->soft.begun[row_block];
}

/* Returns true if the bond with index `bond` in the arrays of b has begun to soften, or will begin to as soon as its
 * stretch exceeds the onset stored for it. row_block: block of eight rows (the bonds of eight particles) that contains
 * the bond. */
static inline bool bond_is_softening(const struct bonds *b, int64_t row_block, int64_t bond)
{
    return bond_row_block_has_begun_softening(b, row_block) && b->soft.onset[bond] < SOFTENING_NEVER;
}

/* Returns the weight (factor on its stiffness, [1]) that the bond with index `bond` in the arrays of b had before it
 * softened. row_block: block of eight rows (the bonds of eight particles) that contains the bond; present_weight:
 * present weight of the bond [1]. Only for state-based models. */
static inline real bond_weight_before_softening(const struct bonds *b, int64_t row_block, int64_t bond,
                                                real present_weight)
{
    return bond_is_softening(b, row_block, bond) ? b->soft.whole[bond] : present_weight;
}

/* Requests a check of the bonds of block `row_block` of eight rows of b (the bonds of eight particles), one of which
 * may begin to soften. The check takes place before forces are computed next (kernels/pd/bond_begin.c). May be called
 * by several threads at once. */
static inline void bond_row_block_request_softening_check(struct bonds *b, int64_t row_block)
{
    if (b->soft.due[row_block] == DUE_NOT) b->soft.due[row_block] = DUE_NEW;
    __atomic_store_n(&b->soft.any_due, true, __ATOMIC_RELAXED); /* several threads may set it */
}

/* Returns the fraction 1 - d [1] of the initial stiffness of the bond with index `bond` in the arrays of b that remains
 * at the stretch `stretch` [1]; d (0 to 1) is the softening. row_block: block of eight rows (the bonds of eight
 * particles) that contains the bond. Returns 1 in state-based models, whose bond weights already contain this
 * factor. */
static inline real bond_remaining_stiffness_fraction(const struct bonds *b, int64_t row_block, int64_t bond,
                                                     real stretch)
{
    if (b->soft.whole || stretch <= 0 || !bond_is_softening(b, row_block, bond)) return 1;
    const real most = b->soft.settled ? b->soft.most[bond] : real_max(b->soft.most[bond], stretch);
    return softening_remaining_stiffness_fraction(b->soft.curve, b->soft.onset[bond], b->soft.end[bond], most);
}

/* Returns half the energy [J] that the softening of the bond with index `bond` in the arrays of b has dissipated so
 * far; the other particle of the bond has the other half. row_block: block of eight rows (the bonds of eight particles)
 * that contains the bond. Returns 0 if the bond is broken, and in state-based models, which add this energy to the
 * fracture energy at once. */
static inline real bond_softening_dissipation_per_particle(const struct bonds *b, int64_t row_block, int64_t bond)
{
    if (b->soft.whole || !bond_is_softening(b, row_block, bond) || b->w[bond] == 0) return 0;
    return 0.5 * b->stiffness * b->w[bond] *
           softening_normalised_dissipated_energy(b->soft.curve, b->soft.onset[bond], b->soft.end[bond],
                                                  b->soft.most[bond]) /
           fabs(b->inverse_length[bond]);
}

/* Marks particle i of p, one of whose bonds in b begins to soften, if it is a material point. It is then converted to a
 * peridynamic particle, since the stress of a material point does not include the softening of bonds. May be called by
 * several threads at once for different particles. */
static inline void softening_flag_material_point_for_conversion(struct bonds *b, struct particles *p, int32_t particle)
{
    if (p->kind[particle] != KIND_MPM) return;
    p->flag[particle] |= FLAG_NEAR;
    __atomic_store_n(&b->soft.at_points, true, __ATOMIC_RELAXED);
}

/* Recomputes b->common[column_number], the common properties of the eight bonds of a column (one bond of each particle
 * of a block of eight rows), from their stored weights (factors on the stiffness) and lengths. Required after a change
 * of the weight of a bond or of the sign of its inverse length; usually called through
 * bond_update_cached_data_after_modification. */
void bond_column_update_common_bond_properties(const struct bonds *b, int64_t column_number);

/* Updates all data of b that depend on a bond, after its weight (factor on its stiffness) or the sign of its inverse
 * length has changed. Recomputes the common properties of its column (bond_column_update_common_bond_properties).
 * Marks its block of eight rows (the bonds of eight particles) as changed and as following no stencil (pattern of bonds
 * shared by many blocks). Marks the copies of weights in b->clamped as out of date. row_number: number of the row of
 * the bond; bond: index of the bond, from bond_copy_on_write_and_return_array_index. */
void bond_update_cached_data_after_modification(struct bonds *b, int64_t row_number, int64_t bond);

/* Initialises the stored softening state of all bonds of block `row_block` of eight rows of b (the bonds of eight
 * particles of p), none of which has begun to soften. limit: critical stretches and softening by pair of materials. */
void bond_row_block_initialise_softening(struct bonds *b, const struct particles *p, const struct bond_limit *limit,
                                         int64_t row_block);

/* Writes the columns of block `row_block` of eight rows of b (the bonds of eight particles), so that its bonds can be
 * changed. The block has stored none so far, because it followed a stencil (pattern of bonds shared by many blocks of a
 * lattice). Does nothing if the columns are already written. May be called by several threads at once. */
void bond_row_block_copy_bonds_from_stencil(struct bonds *b, int64_t row_block);

/* Returns the index of a bond in the bond arrays of b (nbr, inverse_length, w and others), so that the caller may write
 * to this entry. The bond is number `bond_number` (from 0) of the particle in lane `lane` (0 to 7) of block `row_block`
 * of eight rows (the bonds of eight particles). If the block has no entries yet, because it follows a stencil (pattern
 * of bonds shared by many blocks), its bonds are first copied from the stencil to the arrays. After a change of w or of
 * the sign of inverse_length the caller must call bond_update_cached_data_after_modification. */
static inline int64_t bond_copy_on_write_and_return_array_index(struct bonds *b, int64_t row_block, int64_t bond_number,
                                                                int lane)
{
    if (__atomic_load_n(&b->implicit[row_block], __ATOMIC_ACQUIRE))
        bond_row_block_copy_bonds_from_stencil(b, row_block);
    return (b->column[row_block] + bond_number) * LANES + lane;
}

#endif
