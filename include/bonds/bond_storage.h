/* How bonds are stored. Only src/bonds and kernels/pd use the members of these structures (tests/house.sh); all other
 * files read bonds through the iterator of bonds.h.
 *
 * Rows exist only for peridynamic particles (whole family) and bonded material points (their peridynamic
 * neighbours), in ascending particle order: memory and time follow the crack, not the body. Eight consecutive rows
 * form a row block; a row block stores its bonds column by column, lane l of a column being a bond of row l. Shorter
 * rows are padded. Kinds of columns (enum column_kind of kernels/pd/bond_column.h), and what a hot loop reads of each:
 *
 *     row block   kind      the eight bonds                                          nbr  1/r  w   common  stencil
 *     stores      FREE      any neighbours, or consecutive ones from first on         x    x   x    first
 *     stores      SHELL     consecutive, lengths of shell k but for round-off                  x     x
 *     stores      ALIKE     so, and intact ones of one weight: four bytes a bond                     x
 *     implicit    STENCIL   as in other row blocks, each lane its own weight                                  x
 *     implicit    WHOLE     so, all lanes there, one weight                                                   x
 *     implicit    UNIT      so, and that weight is 1                                                          x
 *
 * Where a row block stores, `nbr`, `inverse_length` and `w` are whole, and `common` is made from them by bonds_share.
 * All kinds give the same bits. Where the rows of a row block see neighbours at the same index distances (a lattice), a
 * column holds one distance, and its eight neighbours are consecutive.
 *
 * Most row blocks of a lattice have, index distance by index distance, the bonds that others have. They follow one
 * stencil, read from the nearest cache, and store nothing of their own (they are implicit) until one of their bonds
 * is written. Room for all columns is kept, but only what is written takes memory.
 *
 * Rows made anew leave row blocks that have not changed where they are stored, and put others into the holes that row
 * blocks have left which are no more, or behind all that is stored.
 *
 * Invariants (bonds_fault, which builds with -DCLEAVE_ASSERT call whenever rows are made):
 *     rows ascend by particle, and row_of is the inverse of `particle`;
 *     an implicit row block follows a stencil, has as many columns as it, and no broken bond;
 *     a bond with w != 0 has inverse_length > 0, and its neighbour, if it has a row, is within `reach` row blocks;
 *     a lane without a bond (inverse_length 0) has w = 0;
 *     first >= 0 means that the neighbours of the lanes with a bond are first + lane;
 *     common has the intact lanes, and first, of what is stored. */
#ifndef CLEAVE_BOND_STORAGE
#define CLEAVE_BOND_STORAGE

#include "bonds/family.h"
#include "data/active_set.h"

#define CORE_STIFFNESS 3.0 /* largest of cores (kernels/pd/bond_core.h), in those of bonds */

/* What yielding has done to a bond: stretch without force, and the way it was yielded back and forth. */
struct bond_plasticity {
    real stretch, path;
};

/* Where a mirror image comes from, and the axis that its mirror turns round (-1: none, a clamped plane). */
struct state_image {
    int32_t source;
    int axis;
};

/* Bonds from rows to images in clamped planes (of an image, too). The displacement of such an image is that of its
 * source turned round, P u, while its place is reflected: no symmetry gives the force on the image, so it is brought
 * back to the source (kernels/pd/clamp_force.c). */
struct clamp_end {
    int32_t bond;
    int8_t sign[DIM_MAX];
}; /* what a bond's reaction gives to a particle, by component */
struct clamped {
    int64_t n;                /* arrays have room for LANES more, which weigh nothing */
    int64_t *entry;           /* [n] of what bonds store */
    int32_t *from, *to;       /* [n] particle of the row, image */
    real *inverse_length, *w; /* [n] as stored; before the last sweep [1/m], [1] */
    bool stale;               /* weights have changed since then */
    real *reaction[DIM_MAX];  /* [n] on the image, of the energy that the row counts [N] */
    int64_t held;             /* particles at the ends of such bonds, and for each the ends that pull at it: */
    int32_t *particle;        /* [held] ascending */
    int64_t *first;           /* [held + 1] */
    struct clamp_end *end;
};

/* State of families; only state-based models have it. Material points with rows then have
 * particles.end_*. */
enum { STATE_NUMBERS = 2 + ROTATION }; /* P, g, R */
struct state {
    const struct state_modulus *modulus; /* [materials]; NULL: bond-based */
    bool local;                          /* Q of what a family still has, not of a full one */
    real *weighted;                      /* [row blocks 8] Q [m^2] */
    real share;                          /* V/Q of a full family, where moduli are of that; 0: of each family [m] */
    uint8_t *past;                       /* [row blocks] 1: a bond may have passed its limit in the last sweep */
    uint8_t *pressed;                    /* [row blocks] 1: a bond is within its core (kernels/pd/bond_core.h) */
    real *pressure, *spring;             /* [n_all] P and g [N/m^2], [N/m] */
    /* [n_all] rotation R and g (kernels/pd/rotation.h); only models with rotations: g (R - 1), row major, in the
     * plane [N/m]; sqrt(2 g) times the quaternion of R, its scalar last, in space [(N/m)^1/2] */
    real *rotation[ROTATION];
    real *before[STATE_NUMBERS]; /* [n_all] the same three in row blocks that are past: before bonds end */
    struct state_image *image;   /* [n_all - n] */
};

/* Lengths of a lattice: those of shell k are spacing sqrt(k). */
enum { BOND_SHELLS = 256 };
struct bond_length {
    real inverse, length, square;
}; /* [1/m], [m], [m^2] */

/* What the eight bonds of a column have in common; a copy of what first, w and inverse_length say, made by
 * bonds_share: all that the hot loops read of a column on a lattice, four bytes a bond. */
struct bond_column {
    int16_t excess[LANES]; /* |inverse_length| over the shell's, in units of the last place: positions
                              are rounded; the sum is exact */
    real w;                /* of its intact bonds if alike [1] */
    int32_t first;         /* as below */
    uint8_t intact;        /* bit l: the bond of lane l is intact */
    uint8_t shell;         /* k: consecutive neighbours, lengths those of shell_length[k] up to the
                              round-off of positions; 0: other lengths, or not consecutive */
    uint8_t alike;         /* 1: shell > 0, and intact bonds have one weight */
    uint8_t unused;        /* two of them in a cache line */
};

/* A column in every row block of a stencil. */
struct stencil_column {
    int32_t offset;                  /* from the particles of the rows to their neighbours, by number */
    uint8_t intact, shell;           /* as above */
    uint16_t unused;                 /* stencils are compared byte by byte */
    real inverse_length, w;          /* [1/m]; of a bond [1] */
    real length;                     /* 1/inverse_length [m] */
    real weighted, squared;          /* w |xi| and w |xi|^2 of the lattice's |xi| [m], [m^2] */
    real xi[DIM_MAX], w_xi[DIM_MAX]; /* X_j - X_i, and w times that [m] */
};

/* Row blocks of eight particles in a row that have the same neighbours at the same distances with the same weights,
 * nothing broken: most of a lattice. They read one list of columns, which stays in the nearest cache, and bonds cost
 * their arithmetic. Their own columns are written only when a bond is read by index (row_block_expand). */
struct stencil {
    int columns;
    bool whole;                    /* all lanes have all bonds, of one weight */
    bool unit;                     /* which is 1 */
    int32_t next;                  /* with the same hash, -1: none */
    struct stencil_column *column; /* [columns] */
    real (*w)[LANES];              /* [columns] of the lanes, 0: no bond [1] */
};
struct stencils; /* all of them (bonds_stencils.c) */
struct site_map; /* particle at each site of a lattice (bonds_site_map.c) */

/* Columns of row blocks that are no more: room for others when rows are made anew. */
struct bond_hole {
    int64_t column;
    int32_t columns;
};
struct bond_holes {
    int64_t n;
    struct bond_hole *hole;
};

struct bonds {
    int64_t rows, row_blocks, columns;
    int64_t used, room;               /* columns of which something is or was stored; that there is room for */
    int64_t n;                        /* directed bonds in the rows, broken ones included */
    int32_t reach;                    /* row blocks: no bond leads to a row farther on */
    int32_t *particle;                /* [row blocks 8] particle of a row; padding rows repeat the last */
    int32_t *row_of;                  /* [n_all] row of a particle, -1 without */
    int32_t *no_rows;                 /* [n_all] -1: what row_of begins as when rows are made anew; or NULL */
    int64_t *column;                  /* [row blocks] first column of a row block */
    int32_t *column_count;            /* [row blocks] its columns */
    uint8_t *whole;                   /* [row blocks 8] the row of a peridynamic particle: the whole family */
    int32_t *made;                    /* [row blocks] directed bonds of the row block, broken ones included */
    uint8_t *aligned;                 /* [row blocks] the eight particles are consecutive */
    int32_t *first;                   /* [columns] neighbour of lane 0 where the eight are consecutive, else -1 */
    int32_t *nbr;                     /* [columns 8] neighbour */
    real *inverse_length;             /* [columns 8] 1/|X_j - X_i|; negative: broken, so that its stretch is below
                                         -1 and never exceeds a limit; 0: padding [1/m] */
    real *w;                          /* [columns 8] symmetric weight: beta x surface x V_i V_j c_ij over
                                         stiffness; 0: broken, cut or padding [1] */
    struct bond_column *common;       /* [columns] */
    struct bond_length *shell_length; /* [BOND_SHELLS] */
    const struct stencil **stencil;   /* [row blocks] what a row block follows, NULL: nothing */
    uint8_t *implicit;                /* [row blocks] its columns are not written */
    uint8_t *changed;                 /* [row blocks] weights are not those it was made with: no stencil */
    struct bond_holes holes;
    struct stencils *stencils;
    struct site_map *site_map;            /* kept where there are material points; else NULL */
    real *plastic_stretch, *plastic_path; /* [columns 8] s_p and alpha of a bond; NULL where none yields [1] */
    int32_t *pair;                        /* [columns 8] entry of `yield`; NULL where none yields */
    struct bond_yield yield;
    real *trigger;         /* [row blocks 8] no bond of the row breaks below this stretch */
    float *family_volume;  /* [row blocks 8] sum V_j of the whole initial family [m^3] */
    float *broken_volume;  /* [row blocks 8] of its broken bonds [m^3] */
    real *fracture_energy; /* [row blocks 8] half of each broken bond's energy [J] */
    real *plastic_work;    /* [row blocks 8] half of what its broken bonds had dissipated [J] */
    int32_t *broken;       /* [row blocks 8] bonds broken by load since the start */
    struct state state;
    struct clamped clamped;
    struct active_set active; /* of blocks of rows */
    real core;                /* stiffness of cores (kernels/pd/bond_core.h), in those of bonds */
    real stiffness;           /* c V V of a bond between reference particles: force = stiffness w s [N] */
};

/* Are all eight rows of a row block there and peridynamic? */
static inline bool row_block_whole(const struct bonds *b, int64_t row_block)
{
    return eight_bytes(b->whole + row_block * LANES) == EIGHT_TIMES(1);
}

/* Updates what the bonds of a column share, from their weights and lengths. To be called after a change of w or of
 * the sign of inverse_length, mostly through bonds_changed. Shared and unshared columns give the same bits. */
void bonds_share(const struct bonds *b, int64_t column);
/* The weight of bond q of a row has changed: its row block follows no stencil any more. */
void bonds_changed(struct bonds *b, int64_t row, int64_t q);
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
