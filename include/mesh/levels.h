/* Coarse cells of the reference frame: levels of cells of 4, 8, 16, 32 spacings, each with a time step of its own.
 *
 * Level 0 is the mesh of cells of two spacings (data/mesh.h), with the points of the body. A cell of level L > 0 has
 * the place of 2^L cells of level 0 along each axis; it has no points, and its nodes are those of a mesh of its own.
 * Cells begin at multiples of their size from the lower corner of the body. Cells whose edges or corners touch differ
 * by one level at the most (2:1 balance).
 *
 * Where level L meets level L - 1 the finer mesh has the unknowns:
 *
 *     ghost    node of the coarser mesh at the place of a node of the finer one, whose motion it takes and which takes
 *              its mass and its forces
 *     hanging  node of the finer mesh in the middle of an edge or a face of a coarser cell: it moves as the mean of the
 *              2 or 4 nodes at the ends, which take its mass and its forces
 *
 * so that momentum is exact and the operator symmetric. Forces of level L act every 2^L steps, as impulses 2^L times
 * as large (Verlet-I/r-RESPA: Grubmueller et al. 1991; Tuckerman, Berne & Martyna 1992); nodes that are no ghosts then
 * move 2^L steps at once. Every impulse is a sum of pairs of internal forces, every map is symplectic: momentum is
 * exact and the energy bounded below the resonance of the levels (LEVELS_STEP_MOST). */
#ifndef CLEAVE_LEVELS
#define CLEAVE_LEVELS

#include "loads/loads.h"
#include "mesh/mesh_make.h"

enum { LEVELS_MAX = 4, MASTERS_MAX = 4 };

/* Share of the critical step that levels leave. A bar has its first step with growth at 1.48 of 2.00 spacings over wave
 * speed with three levels (eigenvalues): impulses then come once in half a period of the finest cells. */
#define LEVELS_STEP_MOST 0.7

struct mesh_ghost {
    int32_t coarse, fine;
};
struct mesh_hanging {
    int32_t node, masters, master[MASTERS_MAX];
};

/* Level L > 0, and where it meets level L - 1. */
struct mesh_level {
    struct mesh mesh;
    struct constrained_set held; /* its nodes on mirrors and in driven regions */
    int64_t ghosts;
    struct mesh_ghost *ghost;
    int64_t hangings;
    struct mesh_hanging *hanging; /* nodes of level L - 1 */
    int64_t cells;
};

struct mesh_levels {
    int n;                                   /* coarse levels: at[1] .. at[n]; 0: none */
    struct mesh *fine;                       /* level 0; borrowed */
    int64_t offset[LEVELS_MAX + 1][DIM_MAX]; /* of a level: index of the node at the lower corner of the body */
    uint8_t *level;  /* [fine->grid.n] of the cells of level 0: that of the cell they are part of */
    uint8_t *calm;   /* [fine->grid.n] looks in a row in which a cell could have been coarser */
    uint8_t *wanted; /* [fine->grid.n] enum levels_wanted: cells around must be of level 0 next */
    uint8_t *safe;   /* [fine->grid.n] enum levels_distance of cells of level 0 */
    bool any_wanted;
    bool returned;               /* points that waited are marked again in this step */
    real wave_speed;             /* [m/s] */
    int safe_cells, roomy_cells; /* of level 0 between a point that converts and a coarse cell */
    int64_t changes;             /* of levels, since the start */
    struct mesh_level at[LEVELS_MAX + 1];
};

/* Because a point may convert, or has lost a bond and waits for it. */
enum levels_wanted { WANTED_NOT, WANTED_STRESS, WANTED_LOST_BOND };
enum levels_distance { DISTANCE_UNSAFE, DISTANCE_SAFE, DISTANCE_ROOMY };

/* Cells of a level; of level 0 those that hold any point and are in no coarse cell. */
int64_t levels_cells(const struct mesh_levels *l, int level);

/* The mesh of level L. */
static inline struct mesh *level_mesh(struct mesh_levels *l, int level)
{
    return level > 0 ? &l->at[level].mesh : l->fine;
}
static inline const struct mesh *level_mesh_of(const struct mesh_levels *l, int level)
{
    return level > 0 ? &l->at[level].mesh : l->fine;
}

/* Steps after which all levels are at the same time. */
static inline int levels_stride(const struct mesh_levels *l) { return 1 << l->n; }

/* n coarse levels over the mesh `fine`, all of whose cells are of level 0 at first. density [materials] [kg/m^3]. */
status levels_make(struct mesh_levels *l, int n, struct mesh *fine, const struct particles *p,
                   const struct mesh_source *source, const real *density);
void levels_free(struct mesh_levels *l);

/* Cells of level 0 that must be between a point that converts and a coarse cell, as forces then reach so far; and those
 * at which finer cells are wanted, as points near bonds that break convert next. */
void levels_distances(struct mesh_levels *l, int safe, int roomy);

/* Inertia of coarse cells (kernels/mesh/mesh_inertia.h) such that they disperse waves as bonds do whose dispersion is
 * that of lumped cells of edge `edge` [m], in steps dt [s] at this wave speed [m/s]. */
void levels_match(struct mesh_levels *l, real edge, real wave_speed, real dt);

/* The levels that cells may have: `to` [fine->grid.n] becomes the level of the largest cell that is whole, of one
 * material, balanced, and without any cell of level 0 marked in `demand`; limit [fine->grid.n] bounds it, NULL: the
 * number of levels does. */
void levels_map(const struct mesh_levels *l, const struct particles *p, const uint8_t *demand, const uint8_t *limit,
                uint8_t *to);
/* Lowers `limit` by one in the cells of `level` that would be coarser than now and whose nodes of level 0 then depart
 * from the motion of its corners by an energy of more than `most` [J/kg]. Returns whether there are any. The motion of
 * level 0 must be there (levels_prolong). */
bool levels_limit_rough(const struct mesh_levels *l, const uint8_t *level, real most, uint8_t *limit);
/* Marks all of the coarse cells of which a part is marked, with these levels [fine->grid.n]. */
void levels_mark_cells(const struct mesh_levels *l, const uint8_t *level, uint8_t *mark);
/* Marks all cells within `reach` cells of a marked one. */
void levels_dilate(const struct mesh_levels *l, uint8_t *mark, int reach);

/* Changes levels to those of `level` [fine->grid.n]. Splitting interpolates, merging samples displacements and
 * velocities and divides what is left of the momentum of a cell among its nodes: momentum is exact. All levels must be
 * at one time. Forces of nodes become 0. */
void levels_change(struct mesh_levels *l, const struct particles *p, const struct mesh_source *source,
                   const uint8_t *level);

/* Half an impulse of the cells of every level, forward (dt > 0) or back (dt < 0): velocities of level L are half a
 * step of 2^L dt behind; a change of levels wants all of them at one time. */
void levels_half_kick(struct mesh_levels *l, const struct particles *p, const struct elastic *m, bool finite, real dt);
/* Ghosts of all levels take the motion of the nodes at their places; in steps those do that are due. */
void levels_sync(struct mesh_levels *l);
/* Displacements and velocities of coarse cells to the nodes of level 0 inside them; for points: where there are any. */
void levels_prolong(struct mesh_levels *l);
void levels_prolong_points(struct mesh_levels *l);

/* Levels that act in a step: 0 .. levels_due. */
int levels_due(const struct mesh_levels *l, int64_t step);
/* Forces of coarse cells up to level `due`, and their part of those on nodes that a finer level has, of which those of
 * level 0 must be there already. */
void levels_force(struct mesh_levels *l, const struct particles *p, const struct elastic *m, bool finite, int due);
/* Moves all levels up to `due`, of which walls must be known. Returns the largest component of a velocity [m/s]. */
real levels_move(struct mesh_levels *l, real dt, real dt_velocity, int due, real impulse[DIM_MAX], real *work);

/* Sums over coarse levels: kinetic and elastic energy, the kick of a step [J] (kernels.h), v . f dt [J]. */
real levels_kinetic(const struct mesh_levels *l);
real levels_strain(struct mesh_levels *l, const struct particles *p, const struct elastic *m, bool finite);
real levels_kick(const struct mesh_levels *l, real dt);
real levels_power(const struct mesh_levels *l);

/* Coarse cells of `level` whose particles are not made; with `cell` [their number] which. */
int64_t levels_hollow(const struct mesh_levels *l, int level, int64_t *cell);
/* Is a coarse cell squeezed through itself? The place of its first point [m]. */
bool levels_inverted(const struct mesh_levels *l, real *X);

/* The mesh of level 0 has been made anew with other particles: coarse cells stay as they are. */
void levels_follow_fine(struct mesh_levels *l, const struct particles *p, const struct mesh_source *source);

/* Levels, nodes and what the next change depends on; restored, level 0 must be there. */
status levels_archive(struct mesh_levels *l, const struct particles *p, const struct mesh_source *source,
                      struct archive *a);

#endif
