/* Room `engine`: the run: set-up, step loop, samples, stability checks, checkpoints. It knows every room below it;
 * commands and benches call it. */
#ifndef CLEAVE_ENGINE
#define CLEAVE_ENGINE

#include "engine/critical_step.h"
#include "base/rise.h"
#include "data/hollow.h"
#include "output/column.h"
#include "output/output.h"
#include "run/run.h"

/* Everything up to step 0: particles, cells, loads, bonds, grid, time step. `out` may be NULL. */
status engine_make(struct run *e, const struct scene *s, struct output *out);
/* How many frames of the body follow the one of t = 0, and the step of frame k (engine_report.c). */
int64_t engine_frames_number(const struct run *e);
int64_t engine_frame_step(const struct run *e, int64_t k);
/* A run whose place another takes that has other particles. */
struct predecessor {
    struct run *run;
    int32_t *now;                        /* [its particles and images] their numbers in the other, -1: not there */
};
/* The same, with these cells hollow. `before` not NULL: with its particles, bonds and time; the rest that its steps
 * have changed, and levels of cells, are left to the caller. */
status engine_make_again(struct run *e, const struct scene *s, struct output *out, struct hollow hollow,
                         struct predecessor *before);
/* Makes a run again with the cells hollow that it has now, and goes on where it was (engine_replace.c); what of its
 * predecessor it takes while it is made: particles, once it has images; what load has broken. */
status engine_replace(struct run *e);
void engine_take_particles(struct run *e, struct predecessor *before);
void engine_take_bonds(struct run *e, const struct predecessor *before);
/* Particles only where they are needed (engine_hollow.c): the plan of the start; after the levels of the next step are
 * known, those that lack particles are given them, and others lose theirs; their cells in checkpoints. `obstacle`: why
 * all particles are made, NULL: some need not be. */
const char *engine_hollow_obstacle(const struct scene *s);
status engine_hollow_plan(struct run *e);
/* Triggers of materials whose strength scatters, once their particles are made (engine_strength.c). */
void engine_strength_found(struct run *e);
bool engine_hollow_start(struct run *e, const uint8_t *level);
status engine_hollow_follow(struct run *e, const uint8_t *level);
status engine_hollow_archive(struct run *e, struct archive *a);
/* Points of hollow coarse cells for a frame, into e->report (engine_hollow_points.c), with the gradient of their
 * displacement if wanted; false: there are none. */
bool engine_hollow_points(struct run *e, bool gradients);
void engine_hollow_points_free(struct run *e);
/* What a run of its lattice bodies takes at the most, about, before anything of it is made but materials and family
 * [byte]. */
real engine_memory(const struct run *e);
/* The same for all particles of the body, as peridynamic ones. */
real engine_memory_peridynamic(const struct run *e);
/* Runs to the end of the scene. INTERRUPTED after a checkpoint when a signal came. */
status engine_run(struct run *e);
/* The same with a solver that is not explicit (engine_solve.c), and what that needs. */
status engine_solve(struct run *e);
/* The same in load steps (engine_steps.c), and conversion between them, after so many directed bonds have broken: true
 * if particles have. */
bool engine_convert(struct run *e, int64_t broken);
status engine_steps(struct run *e);
/* The first equilibrium, for an estimate of cost: the engine has then taken no load step, and cannot. Size of what
 * loads and supports prescribe at a load time, which scales as they do. */
status engine_equilibrium_try(struct run *e, real t);
/* After that equilibrium at load time `first`: how near the most stretched bond comes to its limit if none breaks, its
 * stretch over the limit, *overload, at the load time *at [s] at which loads are worst. Loads in proportion are
 * scaled; where they turn back or others join them, the equilibria are sought: FAILED where there is none. */
status engine_overload_worst(struct run *e, real first, real *at, real *overload);
real engine_load_size(const struct run *e, real t);
/* Why the tips of pre-cracks are not led in load steps (steps.path); NULL: they are, if there are any. */
const char *engine_led_fault(const struct run *e);
void statics_free(struct run *e);
/* REFUSED for bodies that load steps do not know. */
status statics_check(const struct run *e);
status engine_solver_make(struct run *e);
/* One step in time. */
status engine_step(struct run *e);
/* Before the first step of this process: history file, frame 0, first checkpoint; a restart has the last two
 * already. After every step: frame, checkpoint and progress line if due; INTERRUPTED after a checkpoint if a signal
 * came. After the last step. */
status engine_report_start(struct run *e);
status engine_report(struct run *e);
status engine_report_end(struct run *e);
/* Stress of peridynamic particles, which steps do not compute: for samples, frames and reversion. */
void engine_stress(struct run *e);
/* Positions, velocities and stresses of all particles, up to date for a frame. */
void engine_sync(struct run *e);
void engine_free(struct run *e);
/* Partial stresses for the present bonds, and the interface zone beside them. */
void engine_partial_make(struct run *e);
/* The time step and the number of steps (engine_time.c). */
status engine_time_make(struct run *e);
/* Internal forces at the present positions, of the nodes of a mesh first of all: of bonds into part.f, of bonds and
 * cells into the mesh's nodes (engine_mesh.c). Points of the mesh to which bonds reach, and images, are brought up to
 * date. The same parts as in a step, without any motion; bonds beyond their limit break. */
void engine_forces(struct run *e);
/* Of those the part of the mesh: forces of bonds, already in part.f, and of cells on its nodes. */
void engine_nodes_force(struct run *e);
/* Updates material points at the end of state-based bonds from their cells, or from their stress. */
void engine_ends_update(struct run *e);
/* Sum of v . f over points on the grid where they are now, without any motion [W]; accounts of loads change.
 * `middle`: half a step later [s]. */
real engine_grid_power(struct run *e, real middle);
/* REFUSED for what is driven by place on a grid that knows no reference places, and for displacements that jump or, at
 * the `start` of a run, are not from where particles are (engine_driving.c). */
status engine_driving_check(const struct run *e, bool start);

/* Bulk damping (engine_damping.c): keeps velocities before a step moves them; its loss since the step before, once it
 * has [J]; slows all for the next step. The loss of the last kick, which nothing follows, by the kinetic energies
 * before it and across it [J]. */
/* Of a kick that is left at its end, exp(-c dt/2); 1 without damping [1]. */
real engine_damping_share(const struct run *e);
void engine_damping_begin(struct run *e);
real engine_damping_loss(struct run *e);
void engine_damping_end(struct run *e);
real engine_damping_last(const struct run *e, real kinetic_before, real kinetic);

/* Dashpots of absorbing faces, by the constants of what moves their particles (engine_absorbing.c). */
void engine_absorbing_make(struct run *e);
/* Bodies in the reference frame (engine_mesh.c): marks their particles, with reasons; makes their mesh; its critical
 * step [s]; its part of a step; positions, velocities and stresses of all its points, or only the motion of some;
 * after conversion. */
status engine_frames(struct run *e);
bool engine_has_mesh(const struct run *e);
/* True if `auto` would put this body into the reference frame, did the scene not require the current one. */
bool engine_frame_allowed(const struct run *e, int body);
/* Sets origin and node distance of the grid, by the frames. */
void engine_grid_make(struct run *e);
/* Groups of points that turn together, where bodies may turn (engine_turning.c). */
void engine_turning_make(struct run *e);
/* Places of a node [m] where the body begins at `from`, in a mesh midway between particles of a lattice with a place at
 * `site`. */
void engine_grid_anchor(const struct scene *s, const real *from, const real *site, bool meshed, real *anchor);
/* Number of the body that comes k-th, those that are joined counted as one; -1: there is none. */
int engine_body_apart(const struct scene *s, int k);
status engine_mesh_make(struct run *e, bool still);   /* still: the caller sets the motion of its nodes */
/* Pre-cracks as slits of the mesh (engine_notch.c): the choice, REFUSED where the scene wants what cannot be, and the
 * peridynamic particles of the start; before the first sample of tips; in a step, faces that meet; what stands for a
 * pre-crack, in words. */
status engine_notch_convert(struct run *e);
/* Does a mirror lie between two nodes of the mesh? Nodes beyond it follow others one by one, extra nodes do not. */
bool engine_mirror_between(const struct run *e);
/* Finds the voids of bodies that have shapes (e->tables.voids); e->source.voids stays NULL where none can be. */
void engine_voids_make(struct run *e);
/* Marks as peridynamic the particles on both sides of narrow voids that cut no mesh: a grid would close them. */
void engine_voids_convert(struct run *e);
/* Warns of voids that the run closes: narrow ones on the grid of the current frame, and in lists and images. */
void engine_voids_warn(const struct run *e, struct warnings *to);
void engine_notch_tips(struct run *e);
bool engine_notch_approach(struct run *e);          /* has it looked, and may have marked points? */
void engine_notch_text(const struct run *e, int crack, char *text, size_t room);
real engine_mesh_critical_step(const struct run *e);
void engine_mesh_move(struct run *e, real middle, real dt_velocity);
void engine_mesh_sync(struct run *e);
void engine_mesh_sync_points(void *engine, const int32_t *list, int64_t n);
void engine_mesh_follow(struct run *e, int64_t converted);
void engine_mesh_insert(struct run *e, const int32_t *list, int64_t n);
/* The load of a scene that asks for the smallest cells, by how long it takes to rise. */
enum rise_kind { RISE_NONE, RISE_BOUNDARY, RISE_INITIAL, RISE_BODY };
struct load_rise {
    enum rise_kind kind;
    int number;                          /* of it in the scene */
    bool pulse;                          /* comes and goes: rises in a quarter of its length */
    real seconds, waves;                 /* [s], in spacings of wave */
};

/* Finds which levels of coarse cells the thickness of the body allows, where the scene may have any. */
void engine_levels_room(struct run *e);
/* How many levels of coarse cells there are, and why `mpm.levels: auto` takes as many as it does. */
enum levels_why { LEVELS_BY_LOADS, LEVELS_AT_REST, LEVELS_NO_MESH, LEVELS_FEW, LEVELS_DAMPED, LEVELS_LONG_STEP,
                  LEVELS_THIN };
struct levels_choice {
    int levels, automatic;               /* in this run; of auto */
    bool given;                          /* by the scene */
    enum levels_why why;
    real across;                         /* the body [spacings] */
    struct load_rise rise;
};

/* The choice (engine_levels_choice.c), once the critical step is known; in words; and whether the levels that the
 * scene gives are too coarse for its loads, in words. */
struct levels_choice engine_levels_choice(const struct run *e);
void engine_levels_text(const struct run *e, char *text, size_t room);
/* What `method: auto` has chosen, levels with it; nothing without it. */
void engine_choice_print(const struct run *e, FILE *out);
bool engine_levels_coarse(const struct run *e, char *text, size_t room);
/* Coarse cells (engine_levels.c): their number of levels; made once the time step is known, with the levels of the
 * start unless `restored`; before a step they follow cracks and stress; before conversion, points near coarse cells
 * wait. Energy of all nodes of the mesh [J]. */
int engine_levels_number(const struct run *e);
status engine_levels_make(struct run *e, bool restored);
status engine_levels_follow(struct run *e);
void engine_levels_guard(struct run *e);
/* Walls of coarse cells, exposed points and loads, after levels or points have changed. */
void engine_levels_found(struct run *e);
void engine_mesh_follow_points(struct run *e);
real engine_mesh_kinetic(const struct reference_frame *reference);
real engine_mesh_strain(struct run *e);
/* Reversion to material points (engine_reversion.c): refuses scenes that do not allow it; reverts what is due before a
 * step; remakes the interface zone and the list of material points that have bonds. */
status engine_reversion_check(const struct scene *s);
void engine_revert(struct run *e);
void engine_interface_make(struct run *e);
/* After the run: the same scene on material points alone, if a pulse probe compares with it. */
status engine_baseline(struct run *e);
/* Share of the body at rest now (active_set.h). */
real engine_inactive_share(const struct run *e);
/* Saves or restores the state between two steps (engine_archive.c); says on standard error where a checkpoint was
 * written with other kernels. */
status engine_archive(void *engine, struct archive *a);
/* Everything about the scene that is allowed but probably not meant, into e->warnings. Call once, before the
 * first step. */
void engine_warn(struct run *e);
/* Warns of particles that have no neighbour (engine_warn_lone.c). */
void engine_warn_of_lone(const struct run *e, struct warnings *to);
/* Warnings of loads whose speed breaks bonds beside what they drive (engine_warn_speed.c). */
void engine_warn_of_speed(const struct run *e, struct warnings *to);
/* Warns how bonds of materials that yield differ from von Mises' law. */
void engine_warn_of_yielding(const struct scene *s, struct warnings *to);
/* The same warning of a running run, once bonds have yielded. */
void engine_say_yielding(struct run *e);
/* A warning of a running run: into e->warnings and, the first time, unless on trial, on standard error. */
void engine_say(struct run *e, const char *text);
/* Rigid bodies (engine_rigid.c): made at the start; their forces booked after those of contact; their motion; kinetic
 * energy before a step and, of the step that has been made, as leap-frog keeps it; work of what drives them [J]. */
status engine_rigid_make(struct run *e);
void engine_rigid_book(struct run *e, real dt_velocity);
void engine_rigid_move(struct run *e, real middle, real dt_velocity);
struct rigid_energy { real before, step, last, work; };
struct rigid_energy engine_rigid_energy(const struct run *e);
int engine_rigid_columns(const struct run *e, struct column *column);   /* column NULL: only their number */
/* Where rigid bodies are at the time of a sample, and how fast, in `sampling.motion`. `keep`: centres and velocities
 * now; `mean`, after the step: velocities half-way to the present ones; `kick`, where no step follows: present
 * velocities and half a kick of the present forces. Velocities of driven bodies are those of their own time. */
void engine_rigid_keep(struct run *e);
void engine_rigid_mean(struct run *e);
void engine_rigid_kick(struct run *e);
/* Makes the weights of bonds near faces. REFUSED where particles are on no lattice (engine_surface.c). */
status engine_surface_make(struct run *e);
/* REFUSED where bodies that the scene joins are apart (engine_joined.c). */
status engine_joined_check(const struct run *e);
/* What they cannot do (engine_rigid_check.c): REFUSED before the start; FAILED where one moves too far in a step; said
 * once where two of them are inside each other. */
status engine_rigid_check(const struct run *e);
status engine_rigid_speed_check(const struct run *e);
void engine_rigid_meet(struct run *e);
void engine_rigid_record(const struct run *e, real *record);
/* Stability checks (engine_stability.c). `make`: the state at the start. `check`, after every step: FAILED with
 * place, step, cause and remedy where something moves faster than waves; the divergence check alone takes
 * peridynamic particles and points of a mesh only if their flags are set. `remedy`: what to change, from how `value`
 * has grown and what the loads have done. */
enum { ENGINE_REMEDY = 640 };
void engine_stability_check_make(struct run *e);
status engine_stability_check(struct run *e);
/* After a sample: FAILED if energy appears from nowhere. At the end: a warning if the energy balance is off by more
 * than results should be trusted with. */
status engine_energy_check(struct run *e);
void engine_say_balance(struct run *e);
/* Energy that bonds released as they broke and had not held [J]. */
real engine_released(const struct diagnostics *w);
/* Is all energy so far below what round-off makes? */
bool engine_is_round_off(const struct run *e);
status engine_divergence_check(const struct run *e, bool peridynamic, bool meshed);
void engine_remedy(const struct run *e, const struct rise *rise, real value, char *text, size_t room);
/* Read-only inputs of probes. */
struct observed engine_observed(const struct run *e);

/* summary.json of the run so far; s is its status, `threads` and `wall_seconds` as measured by the caller. */
status summary_write(const struct run *e, status s, int threads, double wall_seconds);

#endif
