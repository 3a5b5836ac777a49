/* Motion of bodies in the reference frame in a run: by a mesh of cells fixed to the material, and coarse cells. */
#ifndef CLEAVE_MESH_PART
#define CLEAVE_MESH_PART

#include "data/hollow.h"
#include "mesh/levels.h"
#include "mesh/mesh_make.h"
#include "run/run.h"

/* Frame in which the material points of a body move: reference frame (a mesh fixed to the material) if `reference` is
 * true, else current frame (background grid). reason: why, in words; NULL if the scene chooses the current frame. */
struct frame_choice {
    bool reference;
    const char *reason;
};

/* A disc in which cells are kept at the finest level: the domain of a probe of stress-intensity factors. place: centre
 * of the disc [m]; radius: of the disc [m]. */
struct finest_cells_disc {
    real place[2], radius;
};

/* Material points of coarse cells in which no particles were created. They are interpolated from the nodes for one
 * output frame (state at one time) only. Arrays are owned. */
struct coarse_cell_points {
    struct particles part;             /* the points */
    real *spacing;                     /* spacing of the points [m] */
    real *gradient[DIM_MAX * DIM_MAX]; /* gradient of the displacement, if a frame contains strains [1] */
};

/* The part of a run that moves bodies in the reference frame: a mesh of cells fixed to the material, and coarse cells.
 * Arrays are owned. */
struct lagrangian_mesh {
    int bodies;
    struct frame_choice *choice; /* [bodies] frame of each body, and why it was chosen */
    real spacing;                /* of particles [m] */
    bool finite;                 /* true: finite strains; false: small strains */
    bool converts;               /* points with a large stress become peridynamic (method adaptive) */
    bool active_set;             /* nodes still at rest are skipped */
    bool room_limits;            /* the scene gives no coarsening levels; `room` (by thickness) limits them */
    struct mesh mesh;            /* the finest cells, which have the material points */
    struct mesh_source source;   /* data from which `mesh` is made */
    struct elastic *elastic;     /* [materials] elastic constants of the cells */
    struct mesh_levels levels;   /* coarse cells */
    /* [mesh.grid.n] largest coarsening level that the thickness of the body allows; NULL: not computed */
    uint8_t *room;
    int room_most;                         /* largest value of `room` */
    struct cells_without_particles hollow; /* cells whose particles are not created */
    bool lacks; /* true: particles that are needed at the start were not created, and the run must be set up again */
    struct elastic *coarse; /* [materials] elastic constants of coarse cells, with a smaller conversion stress */
    int rings;
    /* [rings of scene->probes] discs around crack tips in which cells are the finest at present */
    struct finest_cells_disc *ring;
    struct coarse_cell_points shown; /* material points in coarse cells, computed for frames */
    real speed;                      /* largest component of a nodal velocity [m/s] */
};

/* Adds a warning to *warning_list for each plane of symmetry of the run that is neither on nodes of the grid or mesh
 * nor midway between nodes. Adds a warning, too, for each plane that the bodies in the reference frame (on the mesh) do
 * not reach. */
void mirror_planes_warn_if_not_fitting_grid_or_mesh(const struct run *run, struct warnings *warning_list);

/* Decides for each body of scene s (the input file) whether its material points move with a mesh fixed to the material
 * (reference frame) or by the background grid (current frame). Stores the choice with its reason in reference->choice,
 * sets FLAG_MESHED of the particles of p in the reference frame, and makes the background grids `mpm` for this choice.
 * Returns REFUSED, with a message, if the scene requires the reference frame for a body that cannot use it. */
status bodies_choose_lagrangian_mesh_or_background_grid(struct lagrangian_mesh *reference, struct grid_method *mpm,
                                                        struct particles *p, const struct scene *s);

/* Returns true if the material points of at least one body move with a mesh (the reference frame). */
bool lagrangian_mesh_is_used_by_any_body(const struct lagrangian_mesh *reference);

/* Returns true if the bodies of scene s can move with a mesh (be in the reference frame): the particles p form one
 * connected mesh on a lattice that fits the cells of the background grid of mpm. */
bool lagrangian_mesh_can_be_made_for_scene(const struct lagrangian_mesh *reference, const struct particles *p,
                                           const struct scene *s, const struct grid_method *mpm);

/* Makes the mesh of those bodies of the run that move with a mesh (reference frame), and finds exposed points (material
 * points with bonds, loads or mirror images) and loaded nodes. source: partial stresses (carried by bonds) and slits
 * (pre-cracks) of this mesh, its other members are ignored; caller_sets_motion: true if the caller sets displacement
 * and velocity of the nodes afterwards. Returns REFUSED or FAILED, with a message, as mesh_make does. Released by
 * run_free_memory. */
status lagrangian_mesh_make_for_run(struct run *run, const struct mesh_source *source, bool caller_sets_motion);

/* Returns the critical time step of the cells of the mesh of `reference` [s], INFINITY without a mesh. If material
 * points may become peridynamic (adaptive method), cells that would have lost any of their points are included, unless
 * `coupling` is COUPLING_PARTIAL_STRESS (bonds carry part of the stress of the points). */
real lagrangian_mesh_critical_time_step(const struct lagrangian_mesh *reference, const struct scene *s,
                                        enum coupling coupling);

/* Lists anew the exposed points of the mesh (points of p with bonds, loads or mirror images) and the nodes on which the
 * boundary conditions `loads` act. To be called after points or coarsening levels of the mesh have changed. */
void lagrangian_mesh_list_bonded_or_loaded_points(struct lagrangian_mesh *reference, const struct particles *p,
                                                  const struct bonds *bonds, struct loads *loads);

/* Updates the exposed points of the mesh, i.e. the material points of p with bonds, loads or mirror images: their
 * positions and velocities from the nodes and, if they have state-based bonds to peridynamic particles, their
 * strains. */
void lagrangian_mesh_move_bonded_or_loaded_points(struct lagrangian_mesh *reference, struct particles *p);

/* Computes the nodal forces of the mesh in step number `step`: the forces of bonds on its points, taken from p->f and
 * distributed to the nodes, plus the forces of all cells whose coarsening level acts in this step. Level L, 0 for the
 * finest cells, acts every 2^L steps. */
void lagrangian_mesh_compute_nodal_forces(struct lagrangian_mesh *reference, struct particles *p, int64_t step);

/* Integrates the motion of the nodes under the forces of lagrangian_mesh_compute_nodal_forces, then updates the points
 * (of p) of the mesh that have bonds, loads or mirror images. loads: prescribed velocities, to whose sums of work and
 * reactions those of this step are added; clock: step number and time step; t_middle: time in the middle of the step
 * [s]; dt_velocity: interval over which velocities are advanced [s]. */
void lagrangian_mesh_move_nodes(struct lagrangian_mesh *reference, struct particles *p, struct loads *loads,
                                const struct run_clock *clock, real t_middle, real dt_velocity);

/* Updates positions, velocities and stresses of all material points (of p) of the mesh from the nodes, then those of
 * the mirror images of particles, which `loads` lists. */
void lagrangian_mesh_update_point_motion_and_stress(struct lagrangian_mesh *reference, struct particles *p,
                                                    const struct loads *loads);

/* Updates positions and velocities of all material points (of p) of the mesh from the nodes, then those of the mirror
 * images of particles, which `loads` lists. */
void lagrangian_mesh_update_point_motion(struct lagrangian_mesh *reference, struct particles *p,
                                         const struct loads *loads);

/* Updates positions and velocities of the material points of p in point_list[point_count] (indices) from the nodes of
 * the mesh of `reference`, except points in coarse cells. Then updates the mirror images of particles, which `loads`
 * lists. */
void lagrangian_mesh_update_motion_of_listed_points(struct lagrangian_mesh *reference, struct particles *p,
                                                    const struct loads *loads, const int32_t *point_list,
                                                    int64_t point_count);

/* Updates the mesh after `converted_count` particles of p (0: none) have become peridynamic and the partial stresses
 * (shares of stress that bonds carry) of the points listed in partial->touched have changed. The kinetic energy that
 * the nodes lose by this is added to *energy_lost [J]. Returns true if points may have left the mesh; the caller must
 * then call lagrangian_mesh_list_bonded_or_loaded_points. Returns false if only the stiffness of cells has changed. */
bool lagrangian_mesh_update_after_point_conversion(struct lagrangian_mesh *reference, struct particles *p,
                                                   int64_t converted_count, const struct partial_stress *partial,
                                                   real *energy_lost);

/* Adds the particles of p in inserted_points[inserted_count] (indices), which have become material points again, to the
 * mesh r. Momentum is conserved; the kinetic energy that is lost is added to *energy_lost [J]. */
void lagrangian_mesh_insert_points(struct lagrangian_mesh *reference, struct particles *p,
                                   const int32_t *inserted_points, int64_t inserted_count, real *energy_lost);

/* Returns the kinetic energy [J] of all nodes of the mesh that moves bodies (a mesh fixed to the material), those of
 * the finest cells and those of coarse cells. reference: the mesh with its coarse cells. */
real lagrangian_mesh_kinetic_energy(const struct lagrangian_mesh *reference);

/* Returns the strain energy [J] of all cells of the mesh of `reference` (a mesh fixed to the material), the finest ones
 * and the coarse ones. reference: mesh with its coarse cells; motion is first copied to those nodes of coarse cells
 * that follow nodes of finer cells. p: particles, the material points of the finest cells. */
real lagrangian_mesh_strain_energy(struct lagrangian_mesh *reference, const struct particles *p);

/* Kind of the load with the shortest rise time, which requires the smallest cells. RISE_NONE: there is no load;
 * RISE_BOUNDARY: a boundary condition; RISE_INITIAL: initial values of particles; RISE_BODY: a moving or rigid body. */
enum rise_kind { RISE_NONE, RISE_BOUNDARY, RISE_INITIAL, RISE_BODY };

/* A load and its rise time, the time within which it grows from 0 to its largest value. */
struct load_rise {
    enum rise_kind kind; /* what loads the body */
    int number;          /* its number in the scene */
    bool pulse;          /* a pulse; its rise time is a quarter of its length */
    real seconds, waves; /* rise time [s]; distance that waves travel in this time [spacings] */
};

/* Reason for the number of levels of coarse cells that `mpm.levels: auto` chooses: rise time of the loads and size of
 * the body, static solver, no points in the reference frame, too few particles, bulk damping, time step too close to
 * the critical one, body too thin. */
enum levels_why {
    LEVELS_BY_LOADS,
    LEVELS_AT_REST,
    LEVELS_NO_MESH,
    LEVELS_FEW,
    LEVELS_DAMPED,
    LEVELS_LONG_STEP,
    LEVELS_THIN
};

/* Number of levels of coarse cells that a run uses, and why. */
struct levels_choice {
    int levels, automatic; /* number for this run; number that `mpm.levels: auto` chooses */
    bool given;            /* the scene gives the levels */
    enum levels_why why;
    real across;           /* thickness of the body [spacings] */
    int64_t particles;     /* particles of the body, made or not */
    real step_share;       /* time step of the scene divided by the critical time step [1] */
    struct load_rise rise; /* load that limits the levels */
};

/* Computes reference->room, the highest coarsening level (0: finest) that the thickness of the body allows in each
 * cell, if scene s may have coarse cells; otherwise reference->room stays NULL. particle_count: number of particles of
 * the body, including those that are not made because they are inside coarse cells. */
void mesh_levels_store_coarsest_levels_for_thickness(struct lagrangian_mesh *reference, const struct scene *s,
                                                     int64_t particle_count);

/* Returns the number of levels of coarse cells for scene s, and the reason. The number is given by the scene or chosen
 * from its loads and the thickness of the body. dt_critical: critical time step of the run [s]. reference: the mesh; p:
 * particles. */
struct levels_choice mesh_levels_choose_level_count(const struct lagrangian_mesh *reference, const struct particles *p,
                                                    const struct scene *s, real dt_critical);

/* Writes the number of levels of coarse cells and the reason for it in words to `text` (`capacity` bytes; a longer text
 * is cut). c: number and reason, from mesh_levels_choose_level_count; s: scene. */
void mesh_levels_describe_level_count(const struct levels_choice *c, const struct scene *s, char *text,
                                      size_t capacity);

/* Returns true if the scene s gives more levels of coarse cells than its loads or the thickness of the body allow, and
 * writes why to `reason` (`capacity` bytes; a longer text is cut). Returns false otherwise. c: number of levels with
 * its reason, from mesh_levels_choose_level_count; reference: the mesh, with the limits by thickness. */
bool mesh_levels_given_by_scene_are_too_many(const struct levels_choice *c, const struct lagrangian_mesh *reference,
                                             const struct scene *s, char *reason, size_t capacity);

/* Makes the coarse cells of the run, whose time step must be known, with initial coarsening levels;
 * levels_from_checkpoint: true if the levels follow from a checkpoint instead. Returns FAILED, with a message, if a
 * level would have too many nodes. Released by run_free_memory. */
status mesh_levels_make_coarse_cells(struct run *run, bool levels_from_checkpoint);

/* Returns true if the coarsening levels of l may change before step number `step`: if there are coarse levels, step >
 * 0, and all levels have reached the same time. */
bool mesh_levels_may_change_before_step(const struct mesh_levels *l, int64_t step);

/* Computes the coarsening levels of cells of `reference` (0: finest) for the next steps from stress, cracks and present
 * motion. p: particles; loads: boundary conditions; step: number of the next step; mass: of the body [kg]. Returns an
 * array that the caller releases with memory_free, with the level of the cell to which each cell of level 0 (the
 * finest) shall belong, or NULL if no level changes. */
uint8_t *mesh_levels_choose_level_of_each_cell(struct lagrangian_mesh *reference, const struct particles *p,
                                               const struct loads *loads, int64_t step, real mass);

/* Changes the coarsening levels of the run. new_cell_level: for each cell of level 0 (the finest) the level of the cell
 * to which it shall belong, as mesh_levels_choose_level_of_each_cell returns it. Cells that become level 0 must have
 * particles (mesh_any_new_finest_cell_lacks_particles). The energy that the change removes is added to run->damped.
 */
void mesh_levels_change_cell_levels(struct run *run, const uint8_t *new_cell_level);

/* Postpones the conversion to peridynamics of those material points of p that are too close to coarse cells of l:
 * clears the flags by which they would become peridynamic, and requests finer cells there. To be called before points
 * convert. */
void coarse_cells_delay_conversion_of_nearby_points(struct mesh_levels *l, struct particles *p);

/* Updates three lists after coarsening levels of the mesh have changed: the nodes of coarse cells on which boundary
 * conditions act, the points (of p) with bonds, loads or mirror images, and the nodes on which loads act. */
void mesh_levels_update_lists_of_loaded_nodes(struct lagrangian_mesh *reference, const struct particles *p,
                                              const struct bonds *bonds, struct loads *loads);

/* Returns the reason in words why all particles of scene s must be made, or NULL if particles inside coarse cells may
 * be left out. */
const char *scene_reason_all_particles_must_be_created(const struct scene *s);

/* Decides, before the particles of scene s are made, which cells need none because they will be inside coarse cells
 * away from pre-cracks, loads and probes. hollow: receives these cells in hollow->absent; it stays NULL if all
 * particles must be made or too few can be left out. source: horizon of the bonds. Returns REFUSED, with a message, if
 * the body has too many cells. */
status cells_without_particles_predict_from_scene(struct cells_without_particles *hollow, const struct scene *s,
                                                  const struct bond_source *source);

/* Returns true if all cells that have level 0 (the finest) at the start have particles. cell_level: level of the cell
 * to which each cell of level 0 belongs, NULL if there are no coarse cells. Returns false if particles are missing or
 * if the levels come from a checkpoint. The run must then be set up again, with the cells without particles that
 * reference->hollow now has. */
bool mesh_check_all_initially_finest_cells_are_filled(struct lagrangian_mesh *reference, const uint8_t *cell_level);

/* Returns true if a cell of `mesh` that shall have level 0 (the finest) has no particles, so that the run must be set
 * up again with more particles. new_cell_level: for each cell of level 0 the level of the cell to which it shall
 * belong. */
bool mesh_any_new_finest_cell_lacks_particles(const struct mesh *mesh, const uint8_t *new_cell_level);

/* Chooses the cells without particles for the given coarsening levels and stores them in reference->hollow. Particles
 * change only when the run is set up again. cell_level: for each cell of level 0 (the finest) the level of the cell to
 * which it shall belong. */
void cells_without_particles_update_from_levels(struct lagrangian_mesh *reference, const uint8_t *cell_level);

/* Creates in reference->shown, for output only, the material points of those coarse cells that have no particles, with
 * values interpolated from the nodes. body: particles of the run; m: array of the materials; with_gradients: true to
 * compute displacement gradients, too. Returns false if no cell is without particles. Release reference->shown with
 * coarse_cell_points_free. */
bool coarse_cell_points_interpolate_for_output(struct lagrangian_mesh *reference, const struct particles *body,
                                               const struct material *m, bool with_gradients);

/* Frees the material points and their arrays in *coarse, which coarse_cell_points_interpolate_for_output has made. */
void coarse_cell_points_free(struct coarse_cell_points *coarse);

#endif
