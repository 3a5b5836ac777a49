/* Coarse cells of the reference frame: levels of cells of 4, 8, 16, 32 spacings, each with its own time step.
 *
 * Level 0 is the mesh of cells of two spacings (data/mesh.h), with the points of the body. A cell of level L > 0
 * replaces 2^L cells of level 0 along each axis; it has no points, and its nodes belong to the mesh of its level. Cells
 * begin at multiples of their size from the lower corner of the body. The levels of cells with a common edge or corner
 * differ by at most one (2:1 balance).
 *
 * Where levels L and L - 1 meet, the finer mesh has the unknowns:
 *
 *     ghost    node of the coarser mesh at the position of a node of the finer mesh: receives its motion and transfers
 * its own mass and forces to it hanging  node of the finer mesh in the middle of an edge or a face of a coarser cell:
 * moves with the mean of the 2 or 4 nodes (masters) at the corners and transfers its mass and forces to them
 *
 * so that momentum is exact and the operator symmetric. Forces of level L act every 2^L steps, as impulses 2^L times as
 * large (Verlet-I/r-RESPA: Grubmueller et al. 1991; Tuckerman, Berne & Martyna 1992); nodes that are no ghosts then
 * move 2^L steps at once. Every impulse is a sum of pairs of internal forces and every map is symplectic: momentum is
 * exact, and the energy is bounded below the resonance of the levels (LEVELS_STEP_MOST). */
#ifndef CLEAVE_LEVELS
#define CLEAVE_LEVELS

#include "loads/loads.h"
#include "mesh/mesh_make.h"

enum { LEVELS_MAX = 4, MASTERS_MAX = 4 };

/* Largest time step with coarse cells over the critical step. In a bar with three levels the amplitude grows from 1.48
 * spacings over wave speed on (by eigenvalues), against 2.00 without levels: impulses then have half the period of the
 * finest cells. */
#define LEVELS_STEP_MOST 0.7

struct mesh_ghost {
    int32_t coarse, fine;
};
struct mesh_hanging {
    int32_t node, masters, master[MASTERS_MAX];
};

/* Level L > 0, and its interface with level L - 1. */
struct mesh_level {
    struct mesh mesh;
    struct constrained_set held; /* its nodes on mirrors and in driven regions */
    int64_t ghosts;
    struct mesh_ghost *ghost;
    int64_t hangings;
    struct mesh_hanging *hanging; /* [hangings] nodes of level L - 1 */
    int64_t cells;
};

struct mesh_levels {
    int n;                                   /* number of coarse levels, at[1] .. at[n]; 0: none */
    struct mesh *fine;                       /* level 0; kept by reference */
    int64_t offset[LEVELS_MAX + 1][DIM_MAX]; /* index of the node of each level at the lower corner of the body */
    uint8_t *level;                          /* [fine->grid.n] level of the cell that each cell of level 0 is part of */
    uint8_t *calm;   /* [fine->grid.n] number of consecutive checks in which a cell could have been coarser */
    uint8_t *wanted; /* [fine->grid.n] enum levels_wanted: why cells around must be of level 0 at the next change */
    uint8_t *safe;   /* [fine->grid.n] enum levels_distance of cells of level 0 */
    bool any_wanted;
    bool returned;   /* points whose conversion was postponed are marked again in this step */
    real wave_speed; /* [m/s] */
    /* distances of converting points from coarse cells, in cells of level 0 (levels_distances) */
    int safe_cells, roomy_cells;
    int64_t changes; /* changes of levels since the start */
    struct mesh_level at[LEVELS_MAX + 1];
};

/* Why finer cells are required: not at all; a point may convert; a point has lost a bond and its conversion is
 * postponed. */
enum levels_wanted { WANTED_NOT, WANTED_STRESS, WANTED_LOST_BOND };

/* Distance of a cell from coarse cells: less than safe_cells, less than roomy_cells, or more. */
enum levels_distance { DISTANCE_UNSAFE, DISTANCE_SAFE, DISTANCE_ROOMY };

/* Returns the number of cells of a level; of level 0, of cells that hold points and are in no coarse cell. */
int64_t levels_cells(const struct mesh_levels *l, int level);

/* Returns the mesh of a level. */
static inline struct mesh *level_mesh(struct mesh_levels *l, int level)
{
    return level > 0 ? &l->at[level].mesh : l->fine;
}

/* Returns the mesh of a level, read-only. */
static inline const struct mesh *level_mesh_of(const struct mesh_levels *l, int level)
{
    return level > 0 ? &l->at[level].mesh : l->fine;
}

/* Returns the number of steps after which all levels are at the same time. */
static inline int levels_stride(const struct mesh_levels *l) { return 1 << l->n; }

/* Makes n coarse levels over the mesh `fine`; all cells are of level 0 at first. fine: kept by reference; density:
 * [materials, kg/m^3]. FAILED or REFUSED if nodes of a level cannot be made. */
status levels_make(struct mesh_levels *l, int n, struct mesh *fine, const struct particles *p,
                   const struct mesh_source *source, const real *density);

/* Releases all arrays. */
void levels_free(struct mesh_levels *l);

/* Sets the minimum numbers of cells of level 0 between a point that converts and a coarse cell: `safe`, the range of
 * its forces; `roomy`, at which finer cells are requested, since points near breaking bonds convert next. */
void levels_distances(struct mesh_levels *l, int safe, int roomy);

/* Sets the inertia of coarse cells (kernels/mesh/mesh_inertia.h) such that their dispersion of waves equals that of
 * bonds with the dispersion of lumped cells of edge `edge` [m], for time steps dt [s] and this wave speed [m/s]. */
void levels_match(struct mesh_levels *l, real edge, real wave_speed, real dt);

/* Computes the coarsest admissible levels: to[fine->grid.n] is the level of the largest cell that is whole, of one
 * material, balanced, and contains no cell of level 0 marked in `demand`. limit: [fine->grid.n] upper bounds, NULL: the
 * number of levels. */
void levels_map(const struct mesh_levels *l, const struct particles *p, const uint8_t *demand, const uint8_t *limit,
                uint8_t *to);

/* Lowers `limit` by one in cells of `level` that would be coarser than at present and in which the motion of the nodes
 * of level 0 differs from the motion of the corners by an energy of more than `most` [J/kg]. Returns true if there are
 * any. The motion of level 0 must be up to date (levels_prolong). */
bool levels_limit_rough(const struct mesh_levels *l, const uint8_t *level, real most, uint8_t *limit);

/* Marks all cells of level 0 in coarse cells that contain a marked one, for the levels level[fine->grid.n]. */
void levels_mark_cells(const struct mesh_levels *l, const uint8_t *level, uint8_t *mark);

/* Marks all cells within `reach` cells of a marked one. */
void levels_dilate(const struct mesh_levels *l, uint8_t *mark, int reach);

/* Changes the levels to level[fine->grid.n]. Splitting interpolates; merging samples displacements and velocities and
 * distributes the remaining momentum of a cell among its nodes: momentum is exact. All levels must be at the same time.
 * Sets forces of nodes to 0. */
void levels_change(struct mesh_levels *l, const struct particles *p, const struct mesh_source *source,
                   const uint8_t *level);

/* Applies half an impulse of the cells of every level, forward (dt > 0) or backward (dt < 0): velocities of level L are
 * half a step of 2^L dt behind, while a change of levels requires all at the same time. m: [materials]; finite: strains
 * are finite. */
void levels_half_kick(struct mesh_levels *l, const struct particles *p, const struct elastic *m, bool finite, real dt);

/* Sets the motion of all ghosts to that of the nodes at their positions; in steps, only ghosts of due levels are
 * set. */
void levels_sync(struct mesh_levels *l);

/* Interpolates displacements and velocities of coarse cells to all nodes of level 0 inside them. */
void levels_prolong(struct mesh_levels *l);

/* Interpolates as levels_prolong to the nodes of level 0 around which there are particles. */
void levels_prolong_points(struct mesh_levels *l);

/* Returns the highest level that acts in step number `step`. */
int levels_due(const struct mesh_levels *l, int64_t step);

/* Computes the forces of coarse cells up to level `due`, with their parts on nodes of the finer levels; forces of level
 * 0 must be complete before. */
void levels_force(struct mesh_levels *l, const struct particles *p, const struct elastic *m, bool finite, int due);

/* Moves all levels up to `due`, whose walls must be set. Adds the impulse [N s] and work [J] of walls to impulse and
 * *work. Returns the largest component of a velocity [m/s]. */
real levels_move(struct mesh_levels *l, real dt, real dt_velocity, int due, real impulse[DIM_MAX], real *work);

/* Returns the kinetic energy of the coarse levels [J]. */
real levels_kinetic(const struct mesh_levels *l);

/* Returns the strain energy of the coarse cells [J]. */
real levels_strain(struct mesh_levels *l, const struct particles *p, const struct elastic *m, bool finite);

/* Returns the excess energy of a leap-frog kick dt of the coarse levels [J] (diagnostics_kick). */
real levels_kick(const struct mesh_levels *l, real dt);

/* Returns the sum of v . f over the nodes of the coarse levels, times the 2^L steps over which forces of level L act
 * [W]. */
real levels_power(const struct mesh_levels *l);

/* Finds the coarse cells of `level` whose particles are not made. cell: NULL, or set to their indices. Returns their
 * number. */
int64_t levels_hollow(const struct mesh_levels *l, int level, int64_t *cell);

/* Returns true if a coarse cell is inverted, and sets X [dim] to the position of its first point [m]. */
bool levels_inverted(const struct mesh_levels *l, real *X);

/* Adapts the levels to a mesh of level 0 that was rebuilt with other particles; coarse cells are unchanged. */
void levels_follow_fine(struct mesh_levels *l, const struct particles *p, const struct mesh_source *source);

/* Saves or restores levels, motion of nodes and the data for the next change; level 0 must be restored before. */
status levels_archive(struct mesh_levels *l, const struct particles *p, const struct mesh_source *source,
                      struct archive *a);

#endif
