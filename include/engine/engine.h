/* Room `engine`: the run: set-up, step loop, samples, stability checks, checkpoints. It knows every room below it;
 * commands and benches call it.
 *
 * The engine owns everything of a run, by value. */
#ifndef CLEAVE_ENGINE
#define CLEAVE_ENGINE

#include <signal.h>

#include "bonds/bonds.h"
#include "bonds/surface.h"
#include "contact/contact.h"
#include "grid/contact_grid.h"
#include "grid/grid_coupled.h"
#include "data/cells.h"
#include "coupling/approach.h"
#include "coupling/conversion.h"
#include "coupling/notch.h"
#include "critical_step.h"
#include "scene/fill.h"
#include "data/grid.h"
#include "kernels/kernels.h"
#include "loads/loads.h"
#include "mesh/levels.h"
#include "mesh/mesh_make.h"
#include "output/output.h"
#include "data/particles.h"
#include "data/turning.h"
#include "probes/probes.h"
#include "grid/active_points.h"
#include "coupling/interface_zone.h"
#include "base/rise.h"
#include "scene/scene.h"
#include "solver/solver.h"
#include "engine/statics.h"
#include "base/team.h"
#include "fracture/tips.h"
#include "base/warnings.h"
#include "probes/diagnostics.h"

/* Where a run is in time. */
struct run_clock {
    real t, dt, dt_critical;             /* [s] */
    int64_t step, steps;                 /* done; of the whole run */
    int stride;                          /* steps after which all levels of cells are at one time: samples, frames */
};

/* Constants by material, and the arrays that `source` of the bonds points to. */
struct material_tables {
    struct elastic *elastic;             /* [materials] */
    struct state_modulus *modulus;       /* [materials] of state-based models, else NULL */
    real *pair_stretch;                  /* [materials^2] critical stretch of a pair of materials */
    real *pair_yield, *pair_hardening;   /* [materials^2] of bonds between two materials; NULL: elastic */
    int *mirror_axis;                    /* [boundaries] -1: clamped */
    struct mirror_plane *mirror;         /* planes of symmetry */
    struct crack_list cracks;            /* pre-cracks with their images in these */
    struct voids voids;                  /* of bodies that are not convex */
    struct mirror_plane *void_mirror;    /* planes beyond which bodies have images, clamped ones among them */
    real *neighbour_volume;              /* [n_all] V^H of every particle, volume method only */
    struct surface_weights surface;      /* of bonds near faces, pd.surface moments only */
    struct impedance *impedance;         /* [movers][materials] of absorbing faces; NULL: there are none */
    real wave_speed;                     /* fastest of the materials [m/s] */
};

/* A grid and its material points: all of them, or where bodies meet on the grid those of one body, whose velocities it
 * has. */
struct grid_field {
    struct grid grid;
    struct transfer_order order;
    struct constrained_set held;         /* its nodes in driven regions and on mirrors */
    int64_t n;
    int32_t *list;                       /* [n] its points, ascending; NULL: all */
};

/* Material points on the grid of the current frame. */
struct grid_method {
    int fields;                          /* 1, or one a body */
    struct grid_field *field;
    struct grid_contact contact;         /* between fields */
    struct active_points active;         /* which of them the transfers leave out */
    struct turning_groups turning;       /* groups of them that turn together (FLIP) */
    struct transfer_data transfer;
    bool sort_needed;                    /* points moved to other cells or converted */
    real smallest_mass;                  /* of a node that moves [kg] */
};

/* Frame of a body, and why where the scene does not say current. */
struct frame_choice { bool reference; const char *reason; };

/* Bodies in the reference frame: a mesh of cells fixed to the material. */
struct reference_frame {
    struct frame_choice *choice;         /* [bodies] */
    struct mesh mesh;
    struct mesh_source source;
    struct elastic *elastic;             /* [materials] constants of its cells */
    struct mesh_levels levels;           /* coarse cells */
    uint8_t *room;                       /* [mesh.grid.n] level that the body is thick enough for; NULL: not asked */
    int room_most;                       /* the largest of these */
    struct hollow hollow;                /* cells whose particles are not made */
    bool lacks;                          /* particles that the start needs are not made: it must be made again */
    struct elastic *coarse;              /* [materials] of coarse cells, which split at less than the trigger */
    real speed;                          /* largest component of a nodal velocity [m/s] */
};

/* Where peridynamic particles and material points meet, and how one becomes the other. */
struct coupling_state {
    bool approaches;                     /* bodies meet: material points near others become peridynamic */
    enum coupling kind;                  /* of the scene; hand-shake where nothing meets */
    struct grid_coupled grid_coupled;    /* peridynamic particles that the grid moves (coupling pm .. pgg) */
    struct partial_stress partial;
    bool uses_partial;                   /* partial stresses and ends of state-based bonds are made */
    uint8_t *bonded;                     /* [n] 1: bonds meet this point of the grid (FLIP); NULL: they meet none */
    struct interface_zone zone;          /* damped beside peridynamic particles (FLIP, partial stress) */
    real damping_share;                  /* of the zone in a step; 0: not at all */
    real damped;                         /* energy that this damping, and conversion of moving cells, took [J] */
    struct conversion conversion;
    struct notches notches;              /* what stands for pre-cracks */
    struct region start_region;          /* peridynamic from the start; no solid: none */
};

/* Cracks: where their tips are, and those whose growth is prescribed or SIF-controlled. */
struct fracture_state {
    struct tips tips;
    struct growth *growth;               /* [scene->growths] */
};

/* What stability checks compare (engine_stability.c). */
struct stability {
    struct rise speed, excess;           /* of the largest speed^2 [m^2/s^2]; of energy from nowhere [J] */
    real start_speed;                    /* largest at t = 0 [m/s] */
    real mass;                           /* of the body [kg] */
    bool diverged;                       /* a peridynamic particle moves faster than waves */
    bool lost;                           /* an energy of the last sample is no finite number */
    bool stretched;                      /* the run has said that points are stretched past the reach of the law */
};

/* Probes and what they compare with. */
struct probing {
    struct probes probes;
    struct wave_pulse *pulse;            /* [pulses] of the initial states */
    int pulses;
    struct baseline baseline;            /* for pulse probes, made at the end */
    bool has_baseline;
    real residual_step0;                 /* largest nodal force of the first step, for patch probes [N] */
    real strain_stress;                  /* largest component of the initial stress [Pa] */
};

/* A sample that is being taken: it describes t_n, and its parts are taken between the phases of the step from t_n
 * (engine_report.h). */
struct sampling {
    bool due;
    real kinetic, work, constraint_work, absorbed; /* [J] before the step */
    real *before[DIM_MAX];               /* velocities at its begin, where something is on the grid [m/s] */
    struct energy energy;                /* of the positions of t_n; kinetic comes last */
    real rigid, rigid_work;              /* of rigid bodies: kinetic at the begin; work up to t_n [J] */
    int64_t pd, bonds;                   /* peridynamic particles and directed bonds at t_n */
    real t_velocity, momentum[DIM_MAX];  /* time of the velocities before the step [s]; momentum then [kg m/s] */
    real *motion;                        /* [scene->rigids, 2 DIM_MAX] centres [m] and velocities [m/s] at t_n */
};

/* Half-width of the 95 % interval of a figure of the summary, from a study of convergence (study/uncertainty.h). */
struct error_bar { char figure[NAME_MAX_LENGTH]; double half_width; };
enum { ERROR_BARS_MOST = 128 };

/* What a run leaves and says, and when. */
struct run_report {
    struct output *out;                  /* borrowed; NULL: a run without files (tests, benches) */
    struct sampling sampling;
    real *record;                        /* one line of history.csv */
    status history_status;               /* of the last line written */
    struct laps laps;
    int64_t particle_steps[KINDS];       /* updates done, by kind */
    int64_t bond_visits;
    real inactive;                       /* inactive share of the body, summed over the steps ... */
    struct { real inactive; int64_t step; } sampled; /* ... and over those before the last sample */
    double loop_seconds, loop_before;    /* in the loop, without output; by processes before a restart [s] */
    double began, started, last_progress, last_checkpoint; /* wall clock: made, first step of this process, ... [s] */
    double checkpoint_seconds;           /* of the longest checkpoint so far */
    int64_t step_started;                /* first step of this process */
    struct warnings warnings;            /* what engine_warn and the run found */
    bool yield_said;                     /* bonds have yielded, and it was said how they do */
    bool trial;                          /* steps are taken on trial: warnings are stored, not printed */
    struct particles more;               /* points of coarse cells in the last frame, and their spacings [m] */
    real *more_spacing;
    real *more_gradient[DIM_MAX * DIM_MAX]; /* of their displacement, where frames are asked for strain [1] */
    bool excerpt;                        /* the first steps of a run, for the export: no word on its balance */
    bool quiet;
    const struct error_bar *bar;         /* borrowed, for the summary; NULL: no study is at hand */
    int bars;
    const volatile sig_atomic_t *stop;   /* set by a signal: checkpoint and leave; NULL: never */
};

/* Velocities before a step moves them, of particles and of nodes, where damping acts; from step to step it has no
 * state. */
struct damping_state { real *before[2][DIM_MAX]; };

struct engine {
    const struct scene *scene;           /* borrowed */
    struct kernels kernels;
    struct run_clock clock;
    struct particles part;
    int optional;                        /* WITH_* arrays of the particles */
    struct cells cells;                  /* search over reference positions */
    struct material_tables tables;
    struct bond_source source;
    struct bonds bonds;
    struct grid_method mpm;
    struct reference_frame reference;
    struct coupling_state coupling;
    const struct region **shape;         /* [scene->bodies] of bodies that are not lists, for contact */
    struct rigid_body *rigid;            /* [scene->rigids] */
    bool rigid_met;                      /* a warning of two that are inside each other has been given */
    struct contact contact;
    struct loads loads;
    struct boundary *boundary;           /* of a static problem, in its pseudo-time (loads_static.c) */
    struct damping_state damping;
    struct solver solver;
    struct statics statics;              /* of load steps (engine_steps.c) */
    struct fracture_state fracture;
    struct diagnostics diagnostics;
    struct probing probing;
    struct stability stability;
    struct run_report report;
};

/* Everything up to step 0: particles, cells, loads, bonds, grid, time step. `out` may be NULL. */
status engine_make(struct engine *e, const struct scene *s, struct output *out);
/* How many frames of the body follow the one of t = 0, and the step of frame k (engine_report.c). */
int64_t engine_frames_number(const struct engine *e);
int64_t engine_frame_step(const struct engine *e, int64_t k);
/* A run whose place another takes that has other particles. */
struct predecessor {
    struct engine *run;
    int32_t *now;                        /* [its particles and images] their numbers in the other, -1: not there */
};
/* The same, with these cells hollow. `before` not NULL: with its particles, bonds and time; the rest that its steps
 * have changed, and levels of cells, are left to the caller. */
status engine_make_again(struct engine *e, const struct scene *s, struct output *out, struct hollow hollow,
                         struct predecessor *before);
/* Makes a run again with the cells hollow that it has now, and goes on where it was (engine_replace.c); what of its
 * predecessor it takes while it is made: particles, once it has images; what load has broken. */
status engine_replace(struct engine *e);
void engine_take_particles(struct engine *e, struct predecessor *before);
void engine_take_bonds(struct engine *e, const struct predecessor *before);
/* Particles only where they are needed (engine_hollow.c): the plan of the start; after the levels of the next step are
 * known, those that lack particles are given them, and others lose theirs; their cells in checkpoints. `obstacle`: why
 * all particles are made, NULL: some need not be. */
const char *engine_hollow_obstacle(const struct scene *s);
status engine_hollow_plan(struct engine *e);
/* Triggers of materials whose strength scatters, once their particles are made (engine_strength.c). */
void engine_strength_found(struct engine *e);
bool engine_hollow_start(struct engine *e, const uint8_t *level);
status engine_hollow_follow(struct engine *e, const uint8_t *level);
status engine_hollow_archive(struct engine *e, struct archive *a);
/* Points of hollow coarse cells for a frame, into e->report (engine_hollow_points.c), with the gradient of their
 * displacement if wanted; false: there are none. */
bool engine_hollow_points(struct engine *e, bool gradients);
void engine_hollow_points_free(struct engine *e);
/* What a run of its lattice bodies takes at the most, about, before anything of it is made but materials and family
 * [byte]. */
real engine_memory(const struct engine *e);
/* The same for all particles of the body, as peridynamic ones. */
real engine_memory_peridynamic(const struct engine *e);
/* Runs to the end of the scene. INTERRUPTED after a checkpoint when a signal came. */
status engine_run(struct engine *e);
/* The same with a solver that is not explicit (engine_solve.c), and what that needs. */
status engine_solve(struct engine *e);
/* The same in load steps (engine_steps.c), and conversion between them, after so many directed bonds have broken: true
 * if particles have. */
bool engine_convert(struct engine *e, int64_t broken);
status engine_steps(struct engine *e);
/* The first equilibrium, for an estimate of cost: the engine has then taken no load step, and cannot. Size of what
 * loads and supports prescribe at a load time, which scales as they do. */
status engine_equilibrium_try(struct engine *e, real t);
/* After that equilibrium at load time `first`: how near the most stretched bond comes to its limit if none breaks, its
 * stretch over the limit, *overload, at the load time *at [s] at which loads are worst. Loads in proportion are
 * scaled; where they turn back or others join them, the equilibria are sought: FAILED where there is none. */
status engine_overload_worst(struct engine *e, real first, real *at, real *overload);
real engine_load_size(const struct engine *e, real t);
/* Why the tips of pre-cracks are not led in load steps (steps.path); NULL: they are, if there are any. */
const char *engine_led_fault(const struct engine *e);
void statics_free(struct engine *e);
/* REFUSED for bodies that load steps do not know. */
status statics_check(const struct engine *e);
status engine_solver_make(struct engine *e);
/* One step in time. */
status engine_step(struct engine *e);
/* Before the first step of this process: history file, frame 0, first checkpoint; a restart has the last two
 * already. After every step: frame, checkpoint and progress line if due; INTERRUPTED after a checkpoint if a signal
 * came. After the last step. */
status engine_report_start(struct engine *e);
status engine_report(struct engine *e);
status engine_report_end(struct engine *e);
/* Stress of peridynamic particles, which steps do not compute: for samples, frames and reversion. */
void engine_stress(struct engine *e);
/* Positions, velocities and stresses of all particles, up to date for a frame. */
void engine_sync(struct engine *e);
void engine_free(struct engine *e);
/* Partial stresses for the present bonds, and the interface zone beside them. */
void engine_partial_make(struct engine *e);
/* The time step and the number of steps (engine_time.c). */
status engine_time_make(struct engine *e);
/* Internal forces at the present positions, of the nodes of a mesh first of all: of bonds into part.f, of bonds and
 * cells into the mesh's nodes (engine_mesh.c). Points of the mesh to which bonds reach, and images, are brought up to
 * date. The same parts as in a step, without any motion; bonds beyond their limit break. */
void engine_forces(struct engine *e);
/* Of those the part of the mesh: forces of bonds, already in part.f, and of cells on its nodes. */
void engine_nodes_force(struct engine *e);
/* Updates material points at the end of state-based bonds from their cells, or from their stress. */
void engine_ends_update(struct engine *e);
/* Sum of v . f over points on the grid where they are now, without any motion [W]; accounts of loads change.
 * `middle`: half a step later [s]. */
real engine_grid_power(struct engine *e, real middle);
/* REFUSED for what is driven by place on a grid that knows no reference places, and for displacements that jump or, at
 * the `start` of a run, are not from where particles are (engine_driving.c). */
status engine_driving_check(const struct engine *e, bool start);

/* Bulk damping (engine_damping.c): keeps velocities before a step moves them; its loss since the step before, once it
 * has [J]; slows all for the next step. The loss of the last kick, which nothing follows, by the kinetic energies
 * before it and across it [J]. */
/* Of a kick that is left at its end, exp(-c dt/2); 1 without damping [1]. */
real engine_damping_share(const struct engine *e);
void engine_damping_begin(struct engine *e);
real engine_damping_loss(struct engine *e);
void engine_damping_end(struct engine *e);
real engine_damping_last(const struct engine *e, real kinetic_before, real kinetic);
void engine_damping_free(struct engine *e);

/* Dashpots of absorbing faces, by the constants of what moves their particles (engine_absorbing.c). */
void engine_absorbing_make(struct engine *e);
/* Bodies in the reference frame (engine_mesh.c): marks their particles, with reasons; makes their mesh; its critical
 * step [s]; its part of a step; positions, velocities and stresses of all its points, or only the motion of some;
 * after conversion. */
status engine_frames(struct engine *e);
bool engine_has_mesh(const struct engine *e);
/* True if `auto` would put this body into the reference frame, did the scene not require the current one. */
bool engine_frame_allowed(const struct engine *e, int body);
/* Sets origin and node distance of the grid, by the frames. */
void engine_grid_make(struct engine *e);
/* Groups of points that turn together, where bodies may turn (engine_turning.c). */
void engine_turning_make(struct engine *e);
/* Places of a node [m] where the body begins at `from`, in a mesh midway between particles of a lattice with a place at
 * `site`. */
void engine_grid_anchor(const struct scene *s, const real *from, const real *site, bool meshed, real *anchor);
/* Number of the body that comes k-th, those that are joined counted as one; -1: there is none. */
int engine_body_apart(const struct scene *s, int k);
status engine_mesh_make(struct engine *e, bool still);   /* still: the caller sets the motion of its nodes */
/* Pre-cracks as slits of the mesh (engine_notch.c): the choice, REFUSED where the scene wants what cannot be, and the
 * peridynamic particles of the start; before the first sample of tips; in a step, faces that meet; what stands for a
 * pre-crack, in words. */
status engine_notch_convert(struct engine *e);
/* Does a mirror lie between two nodes of the mesh? Nodes beyond it follow others one by one, extra nodes do not. */
bool engine_mirror_between(const struct engine *e);
/* Finds the voids of bodies that have shapes (e->tables.voids); e->source.voids stays NULL where none can be. */
void engine_voids_make(struct engine *e);
/* Marks as peridynamic the particles on both sides of narrow voids that cut no mesh: a grid would close them. */
void engine_voids_convert(struct engine *e);
/* Warns of voids that the run closes: narrow ones on the grid of the current frame, and in lists and images. */
void engine_voids_warn(const struct engine *e, struct warnings *to);
void engine_voids_free(struct engine *e);
void engine_notch_tips(struct engine *e);
bool engine_notch_approach(struct engine *e);          /* has it looked, and may have marked points? */
void engine_notch_text(const struct engine *e, int crack, char *text, size_t room);
real engine_mesh_critical_step(const struct engine *e);
void engine_mesh_move(struct engine *e, real middle, real dt_velocity);
void engine_mesh_sync(struct engine *e);
void engine_mesh_sync_points(void *engine, const int32_t *list, int64_t n);
void engine_mesh_follow(struct engine *e, int64_t converted);
void engine_mesh_insert(struct engine *e, const int32_t *list, int64_t n);
/* The load of a scene that asks for the smallest cells, by how long it takes to rise. */
enum rise_kind { RISE_NONE, RISE_BOUNDARY, RISE_INITIAL, RISE_BODY };
struct load_rise {
    enum rise_kind kind;
    int number;                          /* of it in the scene */
    bool pulse;                          /* comes and goes: rises in a quarter of its length */
    real seconds, waves;                 /* [s], in spacings of wave */
};

/* Finds which levels of coarse cells the thickness of the body allows, where the scene may have any. */
void engine_levels_room(struct engine *e);
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
struct levels_choice engine_levels_choice(const struct engine *e);
void engine_levels_text(const struct engine *e, char *text, size_t room);
/* What `method: auto` has chosen, levels with it; nothing without it. */
void engine_choice_print(const struct engine *e, FILE *out);
bool engine_levels_coarse(const struct engine *e, char *text, size_t room);
/* Coarse cells (engine_levels.c): their number of levels; made once the time step is known, with the levels of the
 * start unless `restored`; before a step they follow cracks and stress; before conversion, points near coarse cells
 * wait. Energy of all nodes of the mesh [J]. */
int engine_levels_number(const struct engine *e);
status engine_levels_make(struct engine *e, bool restored);
status engine_levels_follow(struct engine *e);
void engine_levels_guard(struct engine *e);
/* Walls of coarse cells, exposed points and loads, after levels or points have changed. */
void engine_levels_found(struct engine *e);
void engine_mesh_follow_points(struct engine *e);
real engine_mesh_kinetic(const struct reference_frame *reference);
real engine_mesh_strain(struct engine *e);
/* Reversion to material points (engine_reversion.c): refuses scenes that do not allow it; reverts what is due before a
 * step; remakes the interface zone and the list of material points that have bonds. */
status engine_reversion_check(const struct scene *s);
void engine_revert(struct engine *e);
void engine_interface_make(struct engine *e);
/* After the run: the same scene on material points alone, if a pulse probe compares with it. */
status engine_baseline(struct engine *e);
/* Share of the body at rest now (active_set.h). */
real engine_inactive_share(const struct engine *e);
/* Saves or restores the state between two steps (engine_archive.c); says on standard error where a checkpoint was
 * written with other kernels. */
status engine_archive(void *engine, struct archive *a);
/* Everything about the scene that is allowed but probably not meant, into e->report.warnings. Call once, before the
 * first step. */
void engine_warn(struct engine *e);
/* Warns of particles that have no neighbour (engine_warn_lone.c). */
void engine_warn_of_lone(const struct engine *e, struct warnings *to);
/* Warnings of loads whose speed breaks bonds beside what they drive (engine_warn_speed.c). */
void engine_warn_of_speed(const struct engine *e, struct warnings *to);
/* Warns how bonds of materials that yield differ from von Mises' law. */
void engine_warn_of_yielding(const struct scene *s, struct warnings *to);
/* The same warning of a running run, once bonds have yielded. */
void engine_say_yielding(struct engine *e);
/* A warning of a running run: into e->report.warnings and, the first time, unless on trial, on standard error. */
void engine_say(struct engine *e, const char *text);
/* Rigid bodies (engine_rigid.c): made at the start; their forces booked after those of contact; their motion; kinetic
 * energy before a step and, of the step that has been made, as leap-frog keeps it; work of what drives them [J]. */
status engine_rigid_make(struct engine *e);
void engine_rigid_book(struct engine *e, real dt_velocity);
void engine_rigid_move(struct engine *e, real middle, real dt_velocity);
struct rigid_energy { real before, step, last, work; };
struct rigid_energy engine_rigid_energy(const struct engine *e);
int engine_rigid_columns(const struct engine *e, struct column *column);   /* column NULL: only their number */
/* Where rigid bodies are at the time of a sample, and how fast, in `sampling.motion`. `keep`: centres and velocities
 * now; `mean`, after the step: velocities half-way to the present ones; `kick`, where no step follows: present
 * velocities and half a kick of the present forces. Velocities of driven bodies are those of their own time. */
void engine_rigid_keep(struct engine *e);
void engine_rigid_mean(struct engine *e);
void engine_rigid_kick(struct engine *e);
/* Makes the weights of bonds near faces. REFUSED where particles are on no lattice (engine_surface.c). */
status engine_surface_make(struct engine *e);
/* REFUSED where bodies that the scene joins are apart (engine_joined.c). */
status engine_joined_check(const struct engine *e);
/* What they cannot do (engine_rigid_check.c): REFUSED before the start; FAILED where one moves too far in a step; said
 * once where two of them are inside each other. */
status engine_rigid_check(const struct engine *e);
status engine_rigid_speed_check(const struct engine *e);
void engine_rigid_meet(struct engine *e);
void engine_rigid_record(const struct engine *e, real *record);
/* Stability checks (engine_stability.c). `make`: the state at the start. `check`, after every step: FAILED with
 * place, step, cause and remedy where something moves faster than waves; the divergence check alone takes
 * peridynamic particles and points of a mesh only if their flags are set. `remedy`: what to change, from how `value`
 * has grown and what the loads have done. */
enum { ENGINE_REMEDY = 640 };
void engine_stability_check_make(struct engine *e);
status engine_stability_check(struct engine *e);
/* After a sample: FAILED if energy appears from nowhere. At the end: a warning if the energy balance is off by more
 * than results should be trusted with. */
status engine_energy_check(struct engine *e);
void engine_say_balance(struct engine *e);
/* Energy that bonds released as they broke and had not held [J]. */
real engine_released(const struct diagnostics *w);
/* Is all energy so far below what round-off makes? */
bool engine_is_round_off(const struct engine *e);
status engine_divergence_check(const struct engine *e, bool peridynamic, bool meshed);
void engine_remedy(const struct engine *e, const struct rise *rise, real value, char *text, size_t room);
/* Read-only inputs of probes. */
struct observed engine_observed(const struct engine *e);

/* summary.json of the run so far; s is its status, `threads` and `wall_seconds` as measured by the caller. */
status summary_write(const struct engine *e, status s, int threads, double wall_seconds);

#endif
