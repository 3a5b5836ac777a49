/* Coarse cells of the reference frame: levels of cells of 4, 8, 16, 32 spacings, each with its own time step.
 *
 * Level 0 is the mesh of cells of two spacings (data/mesh.h), with the points of the body. A cell of level L > 0
 * replaces 2^L cells of level 0 along each axis; it has no points, and its nodes belong to the mesh of its level. Cells
 * begin at multiples of their size from the lower corner of the body. The levels of cells with a common edge or corner
 * differ by at most one (2:1 balance).
 *
 * Where levels L and L - 1 meet, the finer mesh has the unknowns:
 *
 *     ghost    node of the coarser mesh at the position of a node of the finer mesh: receives the motion of the finer
 *              node and transfers its own mass and forces to it
 *     hanging  node of the finer mesh in the middle of an edge or a face of a coarser cell: moves with the mean of the
 *              2 or 4 nodes (masters) at the corners and transfers its mass and forces to them
 *
 * so that momentum is exact and the operator symmetric. Forces of level L act every 2^L steps, as impulses 2^L times as
 * large (Verlet-I/r-RESPA: Grubmueller et al. 1991; Tuckerman, Berne & Martyna 1992); nodes that are no ghosts then
 * move 2^L steps at once. Every impulse is a sum of pairs of internal forces and every map is symplectic: momentum is
 * exact, and the energy is bounded below the resonance of the levels (LEVELS_STEP_MOST). */
#ifndef CLEAVE_LEVELS
#define CLEAVE_LEVELS

#include "loads/loads.h"
#include "mesh/mesh_make.h"

/* LEVELS_MAX: largest number of levels of coarse cells; MASTERS_MAX: of nodes that determine a hanging node. */
enum { LEVELS_MAX = 4, MASTERS_MAX = 4 };

/* Largest ratio of the time step to the critical time step in a mesh with coarse cells [1]. The eigenvalues of a bar
 * with three levels show instability from a time step of 1.48 (spacing / wave speed) on, against 2.00 without coarse
 * cells. The period of the impulses of coarser levels is then half that of the vibration of the finest cells, so that
 * both resonate. */
#define LEVELS_STEP_MOST 0.7

/* A ghost, a node of the mesh of a coarse level at the position of a node of the next finer level, with which it moves.
 * coarse, fine: indices of the ghost and of the finer node in their meshes. */
struct mesh_ghost {
    int32_t coarse, fine;
};
/* A hanging node: node `node` of a mesh in the middle of an edge or a face of a cell of the next coarser level. It
 * moves with the mean of the nodes master[0 .. masters - 1] of the coarser mesh, 2 or 4 in number, at the ends of the
 * edge or corners of the face. */
struct mesh_hanging {
    int32_t node, masters, master[MASTERS_MAX];
};

/* Mesh of coarsening level L > 0 (coarse cells without material points; level 0 is the finest), and its interface with
 * the next finer level L - 1. Ghosts are nodes of level L at positions of nodes of level L - 1, which determine their
 * motion. Hanging nodes are nodes of level L - 1 in the middle of an edge or a face of a coarse cell, which determines
 * their motion. */
struct mesh_level {
    struct mesh mesh;            /* cells and nodes of this level */
    struct constrained_set held; /* nodes on mirrors and with prescribed motion */
    int64_t ghosts;
    struct mesh_ghost *ghost; /* [ghosts] nodes of this level */
    int64_t hangings;
    struct mesh_hanging *hanging; /* [hangings] nodes of level L - 1 */
    int64_t cells;
};

/* All coarsening levels of a mesh: level 0, the finest, has the material points; the cells of level L replace 2^L cells
 * of level 0 along each axis. Arrays are owned, and have an entry for each cell of level 0 unless noted. */
struct mesh_levels {
    int n;                                   /* number of coarse levels, at[1] .. at[n]; 0: none */
    struct mesh *fine;                       /* level 0; kept by reference */
    int64_t offset[LEVELS_MAX + 1][DIM_MAX]; /* index of the node of each level at the lower corner of the body */
    uint8_t *level;                          /* [fine->grid.n] level of the cell that contains each cell of level 0 */
    uint8_t *calm;   /* [fine->grid.n] number of consecutive checks in which a coarser cell was admissible */
    uint8_t *wanted; /* [fine->grid.n] enum levels_wanted: why cells around must be of level 0 at the next change */
    uint8_t *safe;   /* [fine->grid.n] enum levels_distance of cells of level 0 */
    bool any_wanted; /* an entry of `wanted` is set */
    bool returned; /* true: points whose conversion was postponed have been marked for conversion again in this step */
    real wave_speed; /* largest longitudinal wave speed of the materials [m/s] */
    /* distances of converting points from coarse cells, in cells of level 0
     * (mesh_levels_set_conversion_and_refine_distances) */
    int safe_cells, roomy_cells;
    int64_t changes;                      /* number of changes of the levels since the start */
    struct mesh_level at[LEVELS_MAX + 1]; /* meshes of the coarse levels: at[1] .. at[n] */
};

/* Reason for which the cells around a cell must become cells of level 0 (the finest) at the next change of levels.
 * WANTED_NOT: none; WANTED_STRESS: a material point of the cell may soon convert to a peridynamic particle;
 * WANTED_LOST_BOND: a point of the cell has lost a bond, and its conversion is postponed until that change. */
enum levels_wanted { WANTED_NOT, WANTED_STRESS, WANTED_LOST_BOND };

/* Class of the distance of a cell of the finest level from coarse cells: less than safe_cells, less than roomy_cells,
 * or more (members of struct mesh_levels, in cells of the finest level). */
enum levels_distance { DISTANCE_UNSAFE, DISTANCE_SAFE, DISTANCE_ROOMY };

/* Returns the number of cells of coarsening level `level` of l (0: finest) that compute forces. On level 0 these are
 * the cells that contain material points and belong to no coarse cell. */
int64_t mesh_levels_count_cells_of_level(const struct mesh_levels *l, int level);

/* Returns the mesh of coarsening level `level`: for 0 the finest mesh, with the material points, for higher levels a
 * mesh of coarse cells. The mesh belongs to l. */
static inline struct mesh *mesh_levels_mesh_of_level(struct mesh_levels *l, int level)
{
    return level > 0 ? &l->at[level].mesh : l->fine;
}

/* Returns the mesh of coarsening level `level` for reading only: for 0 the finest mesh, with the material points, for
 * higher levels a mesh of coarse cells. The mesh belongs to l. */
static inline const struct mesh *mesh_levels_mesh_of_level_read_only(const struct mesh_levels *l, int level)
{
    return level > 0 ? &l->at[level].mesh : l->fine;
}

/* Returns after how many time steps all coarsening levels of l have again reached the same time: 2^n for n coarse
 * levels, as level L (0: finest) advances by 2^L steps at once. */
static inline int mesh_levels_time_steps_per_cycle(const struct mesh_levels *l) { return 1 << l->n; }

/* Makes in l the levels 1 to `coarse_level_count` of coarse cells over the mesh `finest_mesh`, which is level 0; at
 * first they have no cells. finest_mesh: finest mesh, with material points of p, kept by reference; source: material
 * constants, slits (pre-cracks as free surfaces) and voids; density: mass density of each material [kg/m^3].
 * `coarse_level_count` = 0 makes no levels. Returns FAILED, with a message, if a level would have too many nodes.
 * Release with mesh_levels_free. */
status mesh_levels_make_over_finest_mesh(struct mesh_levels *l, int coarse_level_count, struct mesh *finest_mesh,
                                         const struct particles *p, const struct mesh_source *source,
                                         const real *density);

/* Frees the coarse levels in l, which mesh_levels_make_over_finest_mesh has made; the finest mesh stays with the
 * caller. */
void mesh_levels_free(struct mesh_levels *l);

/* Sets in l two distances between a coarse cell and a material point that is to become peridynamic, both in cells of
 * level 0 (the finest). conversion_delay_distance: if the point is closer, its conversion is postponed, since its bonds
 * would reach the coarse cell. refine_distance: if it is closer, the coarse cell shall be split, since points near
 * breaking bonds convert next. */
void mesh_levels_set_conversion_and_refine_distances(struct mesh_levels *l, int conversion_delay_distance,
                                                     int refine_distance);

/* Sets the inertia of coarse cells of l, between lumped and consistent mass (kernels/mesh/mesh_inertia.h), such that
 * waves in the cells have the dispersion of waves in a lattice with bonds. edge: edge of cells with lumped mass that
 * would have this dispersion [m]; wave_speed: speed of longitudinal waves [m/s]; dt: time step [s]. */
void mesh_levels_match_wave_dispersion_of_bonds(struct mesh_levels *l, real edge, real wave_speed, real dt);

/* Computes the highest (coarsest) admissible level of each cell of l with particles p. A coarse cell must be completely
 * filled with one material and contain no cell of level 0 (the finest) marked in `finest_required`; levels of adjacent
 * cells differ by at most one. finest_required: a byte for each cell of level 0 (fine->grid.n bytes), not 0 where level
 * 0 is required; highest_level: largest level allowed for each cell, NULL for no such limit; admissible: receives the
 * level of the cell to which each cell of level 0 shall belong. */
void mesh_levels_compute_coarsest_admissible_levels(const struct mesh_levels *l, const struct particles *p,
                                                    const uint8_t *finest_required, const uint8_t *highest_level,
                                                    uint8_t *admissible);

/* Forbids coarsening where the present motion would be lost. For each cell of l that `intended_cell_level` would make
 * coarser than at present, the motion of the nodes inside is compared with the interpolation from its corners. If the
 * energy of the difference (kinetic, and of its strain) exceeds `max_energy` [J/kg], `highest_level` becomes one less
 * than `intended_cell_level` in this cell. intended_cell_level, highest_level: a byte for each cell of level 0, the
 * finest. The motion of the nodes of level 0 must be up to date (mesh_levels_prolong_motion_to_all_finest_nodes).
 * Returns true if an entry of `highest_level` was lowered. */
bool mesh_levels_limit_coarsening_by_energy_loss(const struct mesh_levels *l, const uint8_t *intended_cell_level,
                                                 real max_energy, uint8_t *highest_level);

/* Extends marks to complete coarse cells of l: if one cell of level 0 (the finest) in a coarse cell is marked, all
 * cells of level 0 in it are marked. cell_level: level of the cell to which each cell of level 0 belongs;
 * cell_is_marked: a byte for each cell of level 0. */
void mesh_levels_extend_marks_to_whole_coarse_cells(const struct mesh_levels *l, const uint8_t *cell_level,
                                                    uint8_t *cell_is_marked);

/* Marks all cells of l of level 0 (the finest) within `reach_in_cells` cells of a marked one, in all directions
 * including diagonals. cell_is_marked: a byte for each cell of level 0, not 0 if marked. */
void mesh_levels_mark_cells_near_marked_cells(const struct mesh_levels *l, uint8_t *cell_is_marked, int reach_in_cells);

/* Changes the coarsening levels of cells. new_cell_level: for each of the l->fine->grid.n cells of level 0 (the finest)
 * the level of the cell to which it shall belong. Where cells are split, displacement and velocity are interpolated;
 * where cells are merged, the coarse nodes receive those of the nodes at their positions, and the remaining momentum is
 * distributed among the corners, so that momentum is conserved. All levels must be at the same time. Nodal forces
 * become 0. p: particles; source: material constants. */
void mesh_levels_change_refinement(struct mesh_levels *l, const struct particles *p, const struct mesh_source *source,
                                   const uint8_t *new_cell_level);

/* Changes the velocities of all nodes of l by the nodal forces of half a time step. Between steps, the velocities of
 * level L (0: finest) are half a time step of this level, 2^L dt/2, behind the displacements: dt > 0 brings both to the
 * same time, dt < 0 reverts this. p: particles; elastic: array of the elastic constants of all materials;
 * finite_strain: true if strains are finite, false if small; |dt|: time step of level 0 [s]. */
void mesh_levels_shift_velocities_half_step(struct mesh_levels *l, const struct particles *p,
                                            const struct elastic *elastic, bool finite_strain, real dt);

/* Copies displacement and velocity to all ghosts of l, from the coarsening level 1 upwards. A ghost is a node of the
 * mesh of a coarser level at the position of a node of the next finer level; the motion of the finer node is copied to
 * it. */
void mesh_levels_copy_motion_to_ghost_nodes(struct mesh_levels *l);

/* Interpolates displacement and velocity of the nodes of coarse cells of l to all nodes of level 0 (the finest mesh)
 * inside these cells, so that these have the motion of the coarse cells. */
void mesh_levels_prolong_motion_to_all_finest_nodes(struct mesh_levels *l);

/* Interpolates displacement and velocity of the nodes of coarse cells of l to those nodes of level 0 (the finest mesh)
 * inside these cells that have particles in an adjacent cell. */
void mesh_levels_prolong_motion_near_particles_only(struct mesh_levels *l);

/* Returns the highest coarsening level (0: finest) whose forces act in step number `step`: the largest L <= l->n for
 * which `step` is a multiple of 2^L, because the forces of level L act every 2^L steps. */
int mesh_levels_coarsest_level_integrated_in_step(const struct mesh_levels *l, int64_t step);

/* Computes the forces of coarse cells of l of levels 1 to `highest_level` on their nodes and on nodes of finer levels
 * at the interfaces. The forces of level 0 (the finest) must be complete before. p: particles; elastic: array of the
 * elastic constants of all materials; finite_strain: true if strains are finite, false if small. */
void mesh_levels_compute_forces_of_coarse_cells(struct mesh_levels *l, const struct particles *p,
                                                const struct elastic *elastic, bool finite_strain, int highest_level);

/* Integrates the motion of the nodes of l on levels 0 (the finest) to `highest_level`, level L over 2^L steps. dt: time
 * step of level 0 [s]; dt_velocity: interval over which velocities of level 0 are advanced [s]. The velocities of nodes
 * with prescribed velocity must be set before; the impulse [N s] and the work [J] at these nodes are added to `impulse`
 * and *work. Returns the largest component of a nodal velocity [m/s]. */
real mesh_levels_move_nodes_return_largest_velocity(struct mesh_levels *l, real dt, real dt_velocity, int highest_level,
                                                    real impulse[DIM_MAX], real *work);

/* Returns the kinetic energy of the nodes of all coarse levels of l [J], without those of level 0 (the finest). */
real mesh_levels_kinetic_energy_of_coarse_levels(const struct mesh_levels *l);

/* Returns the strain energy of all coarse cells of l [J]; level 0 (the finest) is not included. p: particles; elastic:
 * array of the elastic constants of all materials; finite_strain: true if strains are finite, false if small. */
real mesh_levels_strain_energy_of_coarse_cells(struct mesh_levels *l, const struct particles *p,
                                               const struct elastic *elastic, bool finite_strain);

/* Returns the kinetic energy of the nodes of all coarse levels of l, as mean of its values before and after the last
 * velocity update, less the kinetic energy that leap-frog conserves [J]. Samples of the energy subtract it. It is the
 * sum of m (v_old^2 + v_new^2)/4 - m v_old . v_new/2 over the nodes, of mass m, with their velocities v_old and v_new
 * before and after the last update. dt: time step of level 0, the finest [s]. */
real mesh_levels_leapfrog_kinetic_energy_correction(const struct mesh_levels *l, real dt);

/* Returns the power of the forces on the nodes of all coarse levels of l [W]: the sum of 2^L v . f, with the level L of
 * the node, its velocity v and its force f. Forces of level L act for 2^L steps at once. */
real mesh_levels_power_of_coarse_nodal_forces(const struct mesh_levels *l);

/* Lists the coarse cells of l of level `level` (> 0) in which particles were never made, since coarse cells do not need
 * them. cell_index: receives the indices of these coarse cells in ascending order, NULL to count only. Returns their
 * number. */
int64_t mesh_levels_list_cells_without_particles(const struct mesh_levels *l, int level, int64_t *cell_index);

/* Returns true if the deformation has turned a coarse cell of l inside out: the determinant of the deformation gradient
 * is 0 or negative at a point a quarter of the edge from its faces. X then receives the reference position of the first
 * such point of the cell, dim components [m]. */
bool mesh_levels_find_inverted_coarse_cell(const struct mesh_levels *l, real *X);

/* Connects the coarse levels to the finest mesh (l->fine) after it has been rebuilt with other particles p. Coarse
 * cells, their motion and their levels are kept. source: material constants. */
void mesh_levels_reconnect_coarse_to_finest_mesh(struct mesh_levels *l, const struct particles *p,
                                                 const struct mesh_source *source);

/* Saves the state of the coarse cells of l to the archive `a` (checkpoint file or memory) if a->saving, else restores
 * it: the coarsening level of each cell, the motion of the nodes, and the data for the next change of levels. The
 * finest mesh must be restored before. p: particles; source: material constants. Returns FAILED, with a message, if the
 * archive cannot be read or written or if the restored levels are inconsistent. */
status mesh_levels_save_or_load(struct mesh_levels *l, const struct particles *p, const struct mesh_source *source,
                                struct archive *a);

#endif
