/* Room `loads` (folder of include/ and src/): boundary conditions on particles, grids and meshes, and their impulse and
 * work. It uses `data`, `bonds` and `kernels`, but neither input files nor the time step; mesh, solver and engine call
 * it. */
#ifndef CLEAVE_LOADS
#define CLEAVE_LOADS

#include "base/archive.h"
#include "bonds/bonds.h"
#include "data/grid.h"
#include "kernels/kernels.h"
#include "data/particles.h"
#include "absorbing.h"
#include "boundary.h"

/* A boundary condition applied to `n` particles, with a factor for each particle by which its value is multiplied, such
 * as an area or a mass (`share`). Arrays are owned, except factors that several loads have in common. */
struct load {
    const struct boundary *boundary; /* borrowed from the scene */
    int64_t n;                       /* number of particles on which it acts */
    int32_t *particle;               /* [n] indices of these particles, ascending */
    /* [n] VELOCITY, MIRROR that is clamped: bit d: the load prescribes component d of the particle; components that a
     * later load prescribes as well are left out */
    uint8_t *prescribes;
    real *share[DIM_MAX]; /* [n] by component. TRACTION: area [m^2], for tangential components 3/2 of it on the first
                             particle of a column and -1/2 on the next; BODY_FORCE: volume times profile [m^3], or mass
                             [kg]. Equal shares of several components or loads are one array */
    /* [n] ABSORBING: area on the first particle of each column; for grid nodes 3/2 of it there and -1/2 on the next
     * particle, because first particles transfer part of it behind the face [m^2] */
    real *outer, *edge;
    /* the shares change in time and are not shared; `base`: shares without function of time and formula */
    bool moving;
    real *base[DIM_MAX];
    struct surface *surface; /* surface of a pressure that follows the deformation; NULL: none */
    /* TRACTION, BODY_FORCE: first load on an equal list of particles, which has the arrays of both; -1: not combined */
    int leader;
    /* [n] components with a value, only if the load leads its list: positions at the start of this step [m] */
    real *before[DIM_MAX];
    real reaction[DIM_MAX]; /* VELOCITY: force of the support on the body in the last step, without the inertia of the
                               driven particles; load steps: forces too [N] */
    real displacement[DIM_MAX]; /* mean displacement of the driven particles; for velocities accumulated [m] */
    real held_work;             /* static, prescribed by position: sum of support forces times displacements [J] */
    int outside;                /* MIRROR: side of the plane without body: -1 lower, +1 upper coordinates */
};

/* A velocity component of a grid node that a boundary condition prescribes. node: index of the node, valid until the
 * box of nodes changes; component: 0 to dim - 1; load: number of the boundary condition. */
struct held {
    int32_t node;
    uint8_t component, load;
    bool overruled; /* a later load constrains the component, so that this entry has no effect */
};

/* Velocity components of grid nodes that boundary conditions prescribe. They are determined again when the box of the
 * grid moves. */
struct constrained_set {
    int64_t n, lasting; /* length of `held`; the first `lasting` do not depend on nodal masses */
    struct held *held;
    int64_t first[DIM_MAX], count[DIM_MAX]; /* box of nodes for which they were found */
};

/* All boundary conditions of a run, with the sums of their impulse and work. */
struct loads {
    int n;             /* number of boundary conditions */
    struct load *load; /* [n] in the order of the scene */
    uint8_t *loaded;   /* [particles + LANES] sum of LOADED, MOVES_LATER, TOUCHES; NULL: all 0 */
    int64_t listed;
    int32_t *list;         /* [listed] indices of the particles for which `loaded` is not 0, ascending */
    int64_t images;        /* number of mirror images of particles */
    struct image *image;   /* [images] origin of each mirror image */
    real impulse[DIM_MAX]; /* impulse of loads and supports since the start [N s] */
    real work;             /* work of applied forces, up to the present positions [J] */
    real constraint_work;  /* work of supports, up to the velocities, half a step behind [J] */
    struct undamped_velocity_excess damped; /* effect of damping on the velocities in this step */
    real spacing, reach;                    /* lattice spacing; length of the longest bond [m] */
    real centre[2], turn;     /* static, free in 2D: centre of mass [m]; angular acceleration by the moment of the loads
                                 [1/s^2], 0: none */
    real place_step[DIM_MAX]; /* positions across mirrors are rounded to multiples of this, 0: not rounded [m] */
    struct absorbing absorbing;              /* faces that absorb waves */
    bool ended;                              /* forces are computed that no step follows */
    real *share;                             /* working memory: driven mass of the grid's nodes [kg] */
    real *mesh_share;                        /* working memory: driven mass of the mesh's nodes [kg] */
    uint8_t *mesh_mark;                      /* working memory: marks of these nodes, 0 between calls */
    struct constrained_set constrained_mesh; /* mesh nodes in driven regions, on mirrors, with mostly driven points */
};

/* Bits of the array loads.loaded, which has an entry for each particle. LOADED: forces other than those of bonds and
 * grid may act on the particle; MOVES_LATER: bonds across a clamped plane act on it, after all other bond forces;
 * TOUCHES: contact may act on it. */
enum { LOADED = 1, MOVES_LATER = 2, TOUCHES = 4 };

/* Returns true if loads or contact of l may act on particle i. */
static inline bool particle_is_loaded(const struct loads *l, int64_t i)
{
    return l->loaded && l->loaded[i] & (LOADED | TOUCHES);
}

/* Finds the particles of p on which boundary b acts: those in its region, for a clamped mirror those in its plane.
 * Stores them in l, ascending, with the area, volume or mass of each, by which the load is multiplied. Sets FLAG_DRIVEN
 * on particles with prescribed motion. spacing: lattice spacing [m]. Returns REFUSED, with a message, for a force on a
 * region without particles or a traction on particles without a free face. */
status load_find_particles_of_boundary(struct load *l, const struct boundary *b, struct particles *p, real spacing);

/* Sets the particle list of load l to the particles i with selected[i] > 0 ([p->n]), ascending. If the load prescribes
 * motion, sets FLAG_DRIVEN on them; if it applies forces, allocates l->share (areas, volumes or masses). */
void load_set_particle_list_from_selected_flags(struct load *l, const uint8_t *selected, struct particles *p);

/* Finds the particles of p with a free face on which the pressure boundary[boundary_number] acts, and stores them in l
 * with the areas of these faces. boundary[boundaries]: all boundaries of the scene, since mirrors may cover a face.
 * spacing: lattice spacing [m]. Returns REFUSED, with a message, if the region has no particles or no free face. */
status load_find_free_faces_under_pressure(struct load *l, const struct boundary *boundary, int boundaries,
                                           int boundary_number, struct particles *p, real spacing);

/* Function that pressure_boundary_visit_free_faces calls for each free face of a particle (index `particle`). axis,
 * side: axis of the outward normal, and -1 or 1 for its direction; area: area of the face [m^2]; context: caller's
 * data. */
typedef void pressure_face_fn(void *context, int32_t particle, int axis, int side, real area);

/* Calls visit(context, particle, axis, side, area) for every free face of a selected particle on which the pressure
 * boundary[number] acts. boundary: all `boundaries` of the scene; spacing: lattice spacing [m]; selected: [p->n]. */
void pressure_boundary_visit_free_faces(const struct boundary *boundary, int boundaries, int number,
                                        const struct particles *p, real spacing, const uint8_t *selected,
                                        pressure_face_fn *visit, void *context);

/* Prepares load l if it has a formula or is a pressure that follows the deformation: multiplies its shares (areas,
 * volumes or masses of particles of p) by formulas that do not depend on time, and allocates arrays for shares that
 * depend on time. Returns REFUSED, with a message, if a formula has no finite value at a particle. */
status load_prepare_particle_load_factors(struct load *l, const struct particles *p);

/* Checks that the formulas of all loads and supports in l have finite values at their particles in p at time t [s].
 * Returns FAILED, with a message that contains boundary, position and time, if a value is not finite. */
status loads_check_formula_values_are_finite(const struct loads *l, const struct particles *p, real t);

/* Recomputes l->share for loads whose formula or surface changes in time: the factor of each particle of p by which the
 * value of the load is multiplied, its area, volume or mass times a formula. The factors are means over the velocity
 * update of duration dt_velocity [s] that ends at time t [s]. Part of loads_add_applied_forces. */
void loads_update_time_mean_load_factors_for_forces(struct loads *l, const struct particles *p, real t,
                                                    real dt_velocity);

/* Recomputes l->share for loads whose formula or surface changes in time: the factor of each particle of p by which the
 * value of the load is multiplied, its area, volume or mass times a formula. The factors are means over the two
 * velocity updates before and after the last position update, from t - dt/2 to t + dt/2 [s]. Part of
 * loads_add_work_of_applied_forces. */
void loads_update_time_mean_load_factors_for_work(struct loads *l, const struct particles *p, real t, real dt);

/* Releases the arrays that load_prepare_particle_load_factors has allocated for load l. */
void load_time_varying_load_factors_free(struct load *l);

/* Computes the force of load l on its particle number `index_in_load` at time t [s], from the reference position of the
 * particle in p. force: dim components [N]. In static problems the force is that at full load. */
void load_force_on_particle(const struct load *l, const struct particles *p, int64_t index_in_load, real t,
                            real *force);

/* Computes the total force of load l on its particles in p at time t [s] into l->reaction [N], and the mean
 * displacement of its particles into l->displacement [m]. The mean is weighted by force, so that total force times mean
 * displacement is the work; it is not weighted if the forces sum to zero. */
void load_compute_total_force_and_mean_displacement(struct load *l, const struct particles *p, real t);

/* Computes the value that the boundary of load l prescribes at its particle number `index_in_load` (of p) at time t
 * [s]: boundary.value times its function of time and its formula. value: receives dim components in the unit of
 * boundary.value, for example a traction [Pa]; it is not multiplied by the area, volume or mass of the particle, nor by
 * the spatial profile of a body force. Not defined for prescribed rotations. */
void load_prescribed_value_at_particle(const struct load *l, const struct particles *p, int64_t index_in_load, real t,
                                       real *value);

/* Creates the loads l of boundary[boundaries]: finds the particles of each, sets FLAG_DRIVEN on particles with
 * prescribed motion, and appends to p mirror images (copies beyond the plane) of the particles within `mirror_reach`
 * [m] of mirror planes. Must be called before the bonds are made. boundary: kept by reference; spacing: lattice spacing
 * [m]; optional_arrays: optional arrays of p, sum of WITH_*. Returns REFUSED, with a message, if a boundary has no
 * particles or no free face, or a mirror is misplaced. Release with loads_free. */
status loads_make_from_boundaries(struct loads *l, const struct boundary *boundary, int boundaries, struct particles *p,
                                  real spacing, real mirror_reach, int optional_arrays);

/* Frees all arrays of *l and of its loads; the boundaries, which belong to the scene, remain. */
void loads_free(struct loads *l);

/* Sets in l the list of particles of p on which contact forces may act, in place of the previous one: n indices in
 * ascending order, which are copied. The forces of these particles are cleared before each step, and they are moved
 * after all forces are complete, not already while bond forces are computed. */
void loads_store_list_of_possible_contact_particles(struct loads *l, const struct particles *p,
                                                    const int32_t *particle_list, int64_t n);

/* ---- applied forces (loads_applied.c) ---------------------------------------------------------------------------- */

/* Combines loads of l with equal particle lists, to traverse each list once. dim: of the space. Part of
 * loads_make_from_boundaries. */
void loads_merge_equal_particle_lists(struct loads *l, int dim);

/* Releases the arrays load.share (area, volume or mass of each loaded particle) of all loads in l, also arrays that
 * several loads have in common. */
void loads_particle_load_factors_free(struct loads *l);

/* Adds the applied forces at time t [s] to the particle forces p->f, and their impulse over dt_velocity, the duration
 * of the velocity update [s], to l->impulse. Part of loads_apply_forces_and_motion_constraints. */
void loads_add_applied_forces(struct loads *l, struct particles *p, real t, real dt_velocity);

/* Adds the work of applied forces from t - dt/2 to t + dt/2 [s] to l->work [J], after the particles have moved. */
void loads_add_work_of_applied_forces(struct loads *l, struct particles *p, real t, real dt);

/* ---- absorbing faces (loads_absorbing.c) ------------------------------------------------------------------------- */

/* Checks the absorbing boundaries of l, whose dashpots act on particles of p. Returns REFUSED, with a message, if two
 * of them act on the same part of a face, or if one lies in a mirror plane. */
status absorbing_boundaries_check_for_overlap(const struct loads *l, const struct particles *p);

/* Creates the dashpots on the particles of p at all absorbing faces in l. Must be called after
 * loads_make_from_boundaries. impedance[m][material]: wave impedances of the materials for particles that are moved by
 * m (enum moved_by: bonds, grid or mesh), kept by reference. Release with absorbing_dashpots_free. */
void absorbing_dashpots_make(struct loads *l, const struct particles *p, const struct impedance *const *impedance);

/* Frees the dashpots of all absorbing faces in l, which absorbing_dashpots_make has made. */
void absorbing_dashpots_free(struct loads *l);

/* Adds the forces of the absorbing dashpots in l to p->f, for particles that are moved by bond forces (not by grid or
 * mesh). dt_velocity: duration of the velocity update [s]. Part of loads_apply_forces_and_motion_constraints. */
void loads_add_dashpot_forces(struct loads *l, struct particles *p, real dt_velocity);

/* Appends the absorbing dashpots of the loads l to the list of dashpots of grid g; part of
 * loads_prescribe_grid_velocities, after the prescribed velocities of nodes are set. The kernel kernels->spread
 * distributes the coefficients of the dashpots on particles of p to the nodes. half_width:
 * transfer_data.half_width [m]. */
void loads_append_dashpots_to_grid(struct loads *l, struct grid *g, const struct particles *p,
                                   const struct kernels *kernels, real half_width);

/* Appends the absorbing dashpots of mesh nodes to mesh->grid, from the particles of p at absorbing faces in l; part of
 * loads_find_driven_mesh_nodes. */
void loads_append_dashpots_to_mesh(struct loads *l, struct mesh *mesh, const struct particles *p);

/* Adds energy and impulse that all dashpots of a grid or mesh have absorbed in a step, `absorbed`, to the sums in l. */
void loads_add_absorbed_energy_and_impulse(struct loads *l, const struct dashpot_effect *absorbed);

/* Computes the displacement that load l prescribes at time t [s] for its particle number `index_in_load`, i.e. particle
 * l->particle[entry] of p. displacement: receives dim components [m], 0 where none is prescribed. */
void load_prescribed_displacement_of_particle(const struct load *l, const struct particles *p, int64_t index_in_load,
                                              real t, real *displacement);

/* Returns the motion that boundary number `boundary_number` of l prescribes in the step from t - dt/2 to t + dt/2 [s],
 * as boundary_prescribed_motion_in_step. After the last step of a run (l->ended), a prescribed displacement has the
 * velocity of the step before, since no step follows in which a change of velocity would do work. */
struct prescribed_motion loads_prescribed_motion_of_boundary_in_step(const struct loads *l, int boundary_number,
                                                                     int dim, real t, real dt);

/* Returns the largest speed [m/s] of the displacement that load l prescribes between the times 0 and `t_end` [s],
 * INFINITY if the displacement jumps. Formulas are sampled at some times and at some particles of p. */
real load_largest_speed_of_prescribed_displacement(const struct load *l, const struct particles *p, real t_end);

/* Returns the largest difference [m/s] between the velocity that load l prescribes at times from 0 to `t_end` [s] and
 * the initial velocity p->v of its particles. Only some times and some particles are examined. For rotations, speeds
 * are compared; 0 for prescribed displacements. */
real load_largest_prescribed_minus_initial_velocity(const struct load *l, const struct particles *p, real t_end);

/* Returns the largest speed [m/s] that load l prescribes for its particles in p between the times 0 and `t_end` [s]:
 * load_largest_speed_of_prescribed_displacement for a prescribed displacement, else
 * load_largest_prescribed_minus_initial_velocity. */
real load_largest_prescribed_speed(const struct load *l, const struct particles *p, real t_end);

/* Returns the largest change [m/s], within any time span of length `time_span` [s], of the velocity that load l
 * (velocity or displacement) prescribes between the times 0 and `t_end` [s]. Before time 0 the particles of the load
 * have the velocity in p. Sampled at a fixed number of times and at some particles; a span shorter than the sampling
 * interval is extended to that interval. */
real load_largest_prescribed_velocity_change(const struct load *l, const struct particles *p, real t_end,
                                             real time_span);

/* Returns the largest difference [m/s] between the velocities that `load` and `other_load` prescribe between the times
 * 0 and `t_end` [s], in components that both prescribe; from each velocity the initial velocity of its particles in p
 * is subtracted. 0 if no component is prescribed by both; INFINITY if one load rotates or depends on position. */
real loads_largest_prescribed_velocity_difference(const struct load *load, const struct load *other_load,
                                                  const struct particles *p, real t_end);

/* ---- forces and velocities of a step ----------------------------------------------------------------------------- */

/* Sets p->f = 0 for all particles of loads and supports in l, before bond forces set p->f of particles with bonds. */
void loads_clear_forces_of_loaded_particles(struct loads *l, struct particles *p);

/* Completes the particle forces p->f after the bond forces: adds applied forces and dashpots, then replaces f of
 * peridynamic particles with prescribed motion by the force that produces the prescribed velocity (material points get
 * it from their nodes). Adds to l->impulse the impulse of these forces and of mirror images (copies beyond a plane of
 * symmetry). t: middle of the step of size dt, end of the velocity update of duration dt_velocity [s]. */
void loads_apply_forces_and_motion_constraints(struct loads *l, struct particles *p, real t, real dt, real dt_velocity);

/* Stores in g->wall the velocities that l prescribes for nodes of grid g in the step from t - dt/2 to t + dt/2 [s].
 * These are nodes in the region of a prescribed motion, nodes on a mirror plane, and nodes at least half of whose mass
 * belongs to points of p with prescribed motion. Nodes beyond a mirror plane move as mirror images if the plane is on a
 * node or midway between two, else they are constrained like nodes on the plane. driven_nodes: constrained nodes of
 * this grid, kept between calls, zeroed at first. kernels: maps between points and nodes; half_width:
 * transfer_data.half_width [m]. Must be called after the first particle-to-grid map. */
void loads_prescribe_grid_velocities(struct loads *l, struct constrained_set *driven_nodes, struct grid *g,
                                     const struct particles *p, const struct kernels *kernels, real half_width, real t,
                                     real dt);

/* Finds the nodes of the mesh (of points of p) whose motion boundaries or mirrors of l prescribe, and the absorbing
 * dashpots of its nodes. Call once at set-up, and again after points of the mesh have become peridynamic. */
void loads_find_driven_mesh_nodes(struct loads *l, struct mesh *mesh, const struct particles *p);

/* Stores in mesh->grid.wall the velocities that l prescribes for the nodes found by loads_find_driven_mesh_nodes, for
 * the step from t - dt/2 to t + dt/2 [s]. */
void loads_prescribe_mesh_velocities(const struct loads *l, struct mesh *mesh, real t, real dt);

/* Finds the nodes of g, the grid of a mesh of coarse cells, whose motion l prescribes, by their positions: nodes in
 * regions with prescribed motion and on mirror planes. Stores them in `driven_nodes`. */
void loads_find_driven_nodes_of_coarse_cells(const struct loads *l, struct constrained_set *driven_nodes,
                                             struct grid *g, const struct particles *p);

/* Stores in g->wall the velocities that l prescribes for nodes of grid g of a mesh of coarse cells, for the step from t
 * - dt/2 to t + dt/2 [s]. driven_nodes: these nodes, found by loads_find_driven_nodes_of_coarse_cells. */
void loads_prescribe_coarse_node_velocities(const struct loads *l, const struct constrained_set *driven_nodes,
                                            struct grid *g, real t, real dt);

/* Imposes the motion that l prescribes in the step from t - dt/2 to t + dt/2 [s] on particles p, after the
 * grid-to-particle transfer: sets velocities of material points on a background grid, and positions of these and of
 * peridynamic particles with prescribed displacement. Adds impulse and work of supports to l->impulse and
 * l->constraint_work, the work of applied forces to l->work. Returns true if a material point was moved. */
bool loads_impose_prescribed_motion_on_particles(struct loads *l, struct particles *p, real t, real dt);

/* Adds the reactions of the prescribed nodes, mirror nodes and dashpots of grid g (or of the grid of a mesh) to the
 * reactions of their loads in l. dt_velocity: duration of the velocity update [s]. */
void loads_add_reactions_at_grid_nodes(struct loads *l, const struct grid *g, real dt_velocity);

/* ---- static equilibrium (loads_static.c) ------------------------------------------------------------------------- */

/* Converts boundary[boundaries] to boundary conditions of a static problem in pseudo-time and stores these in
 * static_boundary[boundaries]. Forces have their value at time `duration` [s], prescribed motion its displacement until
 * then. Both grow linearly from 0 at pseudo-time 0 to full size at `ramp_time` [s] and then remain constant. */
void static_boundaries_make_from_dynamic(struct boundary *static_boundary, const struct boundary *boundary,
                                         int boundaries, real duration, real ramp_time);

/* Computes the prescribed displacement of particles for every prescribed component at full load l (pseudo-time
 * `ramp_time` [s]). displacement: [dim][p->n] [m]; driven_components: [p->n], bit d: component d is prescribed. Of
 * overlapping loads the later one in the scene is used, as in dynamic runs. */
void loads_compute_prescribed_static_displacements(struct loads *l, const struct particles *p, real ramp_time,
                                                   real *const *displacement, uint8_t *driven_components);

/* Adds the inertia forces of a rigid rotation (inertia relief) to the applied forces l of a free body of particles p in
 * 2D. Loads with a moment, for example loads on particles of an irregular lattice, then have an equilibrium. Returns
 * the moment of the loads divided by the largest moment that forces of this size could have [1]. */
real loads_add_inertia_relief_and_return_moment_ratio(struct loads *l, const struct particles *p);

/* Adds the applied forces l of a static problem at full load, with those of
 * loads_add_inertia_relief_and_return_moment_ratio, to p->f [N]. */
void loads_add_static_forces(const struct loads *l, struct particles *p);

/* Sets the reaction of each support in l to minus the sum of the forces p->f on those components whose motion it
 * prescribes, then sets these components of p->f to 0. Reactions of other loads become 0. */
void loads_extract_static_reactions_from_forces(struct loads *l, struct particles *p);

/* Computes the work of the loads l on the body of particles p, whose response is linear and whose loads grow in
 * proportion. Stores half the sum of applied forces times displacements in l->work, and half the sum of reactions times
 * prescribed displacements in l->constraint_work [J]. */
void loads_compute_work_in_static_equilibrium(struct loads *l, const struct particles *p);

/* Saves impulse and work so far, displacement and reaction of each load in l to the archive `a` (checkpoint file or
 * memory) if a->saving, else restores them. Returns FAILED if an entry is missing or its size differs. */
status loads_save_or_load(struct loads *l, struct archive *a);

/* Largest number of boundary conditions, since indices are stored as bytes (struct held, struct image). */
enum { BOUNDARIES_MAX = 255 };

#endif
