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
    /* distances of converting points from coarse cells, in cells of level 0 (levels_set_conversion_distances) */
    int safe_cells, roomy_cells;
    int64_t changes; /* changes of levels since the start */
    struct mesh_level at[LEVELS_MAX + 1];
};

/* Why finer cells are required: not at all; a point may convert; a point has lost a bond and its conversion is
 * postponed. */
enum levels_wanted { WANTED_NOT, WANTED_STRESS, WANTED_LOST_BOND };

/* Distance of a cell from coarse cells: less than safe_cells, less than roomy_cells, or more. */
enum levels_distance { DISTANCE_UNSAFE, DISTANCE_SAFE, DISTANCE_ROOMY };

/* Returns the number of cells of a refinement level that compute forces. Level 0, the finest: cells that hold material
 * points and belong to no coarse cell. */
int64_t levels_count_cells(const struct mesh_levels *l, int level);

/* Returns the mesh of a refinement level: level 0 the mesh with material points, higher levels coarse cells. The mesh
 * belongs to l. */
static inline struct mesh *level_mesh(struct mesh_levels *l, int level)
{
    return level > 0 ? &l->at[level].mesh : l->fine;
}

/* Returns the mesh of a refinement level for reading only: level 0 the mesh with material points, higher levels coarse
 * cells. The mesh belongs to l. */
static inline const struct mesh *level_mesh_read_only(const struct mesh_levels *l, int level)
{
    return level > 0 ? &l->at[level].mesh : l->fine;
}

/* Returns the number of steps between instants at which all refinement levels have reached the same time, 2^n for n
 * coarse levels. */
static inline int levels_steps_per_cycle(const struct mesh_levels *l) { return 1 << l->n; }

/* Makes `coarse_levels` coarse refinement levels over the mesh `fine`; at first they have no cells. fine: finest mesh
 * with material points, kept by reference; source: material constants, slits and voids; density: mass density of each
 * material [kg/m^3]. `coarse_levels` = 0 makes no levels. Returns FAILED, with a message, if a level would have too
 * many nodes. Release with levels_free. */
status levels_make(struct mesh_levels *l, int coarse_levels, struct mesh *fine, const struct particles *p,
                   const struct mesh_source *source, const real *density);

/* Frees the arrays of l; the finest mesh stays with the caller. */
void levels_free(struct mesh_levels *l);

/* Sets two distances between a material point that converts and a coarse cell, in cells of level 0 (the finest):
 * `postpone_distance`, below which conversion is postponed, as forces of the point would reach the coarse cell;
 * `refine_distance`, below which finer cells are requested, as points near breaking bonds convert next. */
void levels_set_conversion_distances(struct mesh_levels *l, int postpone_distance, int refine_distance);

/* Sets the inertia of coarse cells, between lumped and consistent mass (kernels/mesh/mesh_inertia.h), such that waves
 * in them have the dispersion of waves in a lattice with bonds. edge: edge of cells with lumped mass that would have
 * this dispersion [m]; wave_speed: longitudinal [m/s]; dt: time step [s]. */
void levels_match_dispersion(struct mesh_levels *l, real edge, real wave_speed, real dt);

/* Computes the coarsest admissible refinement level of each cell. A coarse cell must be completely filled with one
 * material and contain no cell of level 0 (the finest) marked in `finest_required`; levels of adjacent cells differ by
 * at most one. finest_required: a byte for each cell of level 0 (fine->grid.n bytes), not 0 where level 0 is required;
 * highest_level: highest level of each cell, NULL for all levels; admissible: receives the level of the cell to which
 * each cell of level 0 shall belong. */
void levels_compute_coarsest_admissible(const struct mesh_levels *l, const struct particles *p,
                                        const uint8_t *finest_required, const uint8_t *highest_level,
                                        uint8_t *admissible);

/* Forbids coarsening where the present motion would be lost. For each cell that `level` would make coarser than at
 * present, the motion of the nodes inside is compared with the interpolation from its corners; if the energy of the
 * difference exceeds `max_energy` [J/kg], `highest_level` is set to one level less there. level, highest_level: a byte
 * for each cell of level 0, the finest. The motion of the nodes of level 0 must be up to date
 * (levels_prolong_motion_to_fine_nodes). Returns true if a limit was lowered. */
bool levels_forbid_lossy_coarsening(const struct mesh_levels *l, const uint8_t *level, real max_energy,
                                    uint8_t *highest_level);

/* Extends marks to complete coarse cells: if one cell of level 0 (the finest) in a coarse cell is marked, all cells of
 * level 0 in it become marked. level: level of the cell to which each cell of level 0 belongs; mark: a byte for each
 * cell of level 0. */
void levels_extend_marks_to_coarse_cells(const struct mesh_levels *l, const uint8_t *level, uint8_t *mark);

/* Marks all cells of level 0 (the finest) within `reach` cells of a marked one, in all directions including diagonals.
 * mark: a byte for each cell of level 0, not 0 if marked. */
void levels_dilate_marks(const struct mesh_levels *l, uint8_t *mark, int reach);

/* Changes the refinement level of cells to level[fine->grid.n], for each cell of level 0 (the finest) the level of the
 * cell to which it shall belong. Where cells are split, displacement and velocity are interpolated; where cells are
 * merged, the coarse nodes receive those of the nodes at their positions, and the remaining momentum is distributed
 * among the corners, so that momentum is conserved. All levels must be at the same time. Nodal forces become 0. source:
 * material constants. */
void levels_change_refinement(struct mesh_levels *l, const struct particles *p, const struct mesh_source *source,
                              const uint8_t *level);

/* Changes the velocities of all nodes by the forces of half a step, to bring velocities and displacements of all levels
 * to the same time (dt > 0) or back again (dt < 0): velocities of level L are half a step of 2^L dt behind. elastic:
 * array of the elastic constants of all materials; finite: true if strains are finite, false if small; dt: time step of
 * level 0 [s]. */
void levels_shift_velocities_half_step(struct mesh_levels *l, const struct particles *p, const struct elastic *elastic,
                                       bool finite, real dt);

/* Copies displacement and velocity of finer nodes to all ghosts, the nodes of a coarser mesh at their positions. (A
 * time step does so only for the levels that it moves.) */
void levels_copy_motion_to_ghosts(struct mesh_levels *l);

/* Interpolates displacement and velocity of coarse cells to all nodes of level 0 (the finest) inside them. */
void levels_prolong_motion_to_fine_nodes(struct mesh_levels *l);

/* Interpolates displacement and velocity of coarse cells to the nodes of level 0 (the finest) inside them that have
 * particles in an adjacent cell. */
void levels_prolong_motion_near_points(struct mesh_levels *l);

/* Returns the highest refinement level whose forces act in step number `step`; level L acts every 2^L steps. */
int levels_highest_due_in_step(const struct mesh_levels *l, int64_t step);

/* Computes the forces of coarse cells of levels 1 to `highest_level` on their nodes and on nodes of finer levels at the
 * interfaces. The forces of level 0 (the finest) must be complete before. elastic: array of the elastic constants of
 * all materials; finite: true if strains are finite, false if small. */
void levels_compute_forces(struct mesh_levels *l, const struct particles *p, const struct elastic *elastic, bool finite,
                           int highest_level);

/* Integrates the motion of the nodes of levels 0 (the finest) to `highest_level`, level L over 2^L steps. dt: time step
 * of level 0 [s]; dt_velocity: interval over which velocities of level 0 are advanced [s]; impulse, work: impulse [N s]
 * and work [J] of nodes with prescribed velocity, whose velocities must be set before, are added to these. Returns the
 * largest component of a nodal velocity [m/s]. */
real levels_move_nodes(struct mesh_levels *l, real dt, real dt_velocity, int highest_level, real impulse[DIM_MAX],
                       real *work);

/* Returns the kinetic energy of the nodes of all coarse levels [J]; level 0 (the finest) is not included. */
real levels_kinetic_energy(const struct mesh_levels *l);

/* Returns the strain energy of all coarse cells [J]; level 0 (the finest) is not included. elastic: array of the
 * elastic constants of all materials; finite: true if strains are finite, false if small. */
real levels_strain_energy(struct mesh_levels *l, const struct particles *p, const struct elastic *elastic, bool finite);

/* Returns the difference between two kinetic energies of the nodes of all coarse levels in a leap-frog velocity update
 * [J]: the mean of 1/2 m v^2 before and after it, minus 1/2 m v_old . v_new, which leap-frog conserves. dt: time step
 * of level 0 [s]. */
real levels_leapfrog_energy_gap(const struct mesh_levels *l, real dt);

/* Returns the power of the forces on the nodes of all coarse levels, the sum of v . f times 2^L, the number of steps
 * for which forces of level L act [W]. */
real levels_power_of_forces(const struct mesh_levels *l);

/* Lists the coarse cells of a level that contain cells without particles (particles that were never made, as they are
 * not needed). cell: receives the indices of the cells, NULL to count only. Returns their number. */
int64_t levels_list_cells_without_particles(const struct mesh_levels *l, int level, int64_t *cell);

/* Returns true if the deformation has turned a coarse cell inside out; X then receives the reference position of its
 * first quarter point, dim components [m]. */
bool levels_find_inverted_cell(const struct mesh_levels *l, real *X);

/* Connects the levels to a finest mesh that has been rebuilt with other particles; coarse cells, their motion and
 * their levels are kept. source: material constants. */
void levels_reconnect_finest_mesh(struct mesh_levels *l, const struct particles *p, const struct mesh_source *source);

/* Saves the refinement levels, the motion of their nodes and the data for the next change of levels to the archive if
 * a->saving, else restores them. The finest mesh must be restored before. source: material constants. Returns FAILED,
 * with a message, if the archive cannot be read or written or if the restored levels are inconsistent. */
status levels_save_or_load(struct mesh_levels *l, const struct particles *p, const struct mesh_source *source,
                           struct archive *a);

#endif
