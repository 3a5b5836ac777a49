/* Reports of a run: frames (states written to files), checkpoints, history.csv, warnings and the progress line, and the
 * steps after which each is written. */
#ifndef CLEAVE_REPORT
#define CLEAVE_REPORT

#include <signal.h>

#include "output/output.h"
#include "run/run.h"

/* A sample (line of history.csv) in progress. It describes the body at t_n; its quantities are computed between the
 * phases of the step that begins at t_n (sample.h). */
struct sampling {
    bool due;                                      /* a sample is taken in this step */
    real kinetic, work, constraint_work, absorbed; /* at the start of the step [J] */
    real *before[DIM_MAX]; /* [n] velocities at the start of the step; only stored if points are on the grid [m/s] */
    struct energy energy;  /* at the positions of t_n; the kinetic energy is set last */
    real rigid;            /* kinetic energy of rigid bodies at the start of the step [J] */
    real rigid_work;       /* work of rigid bodies up to t_n [J] */
    /* numbers at t_n of peridynamic particles, and of bonds, each counted once for each of its particles */
    int64_t pd, bonds;
    real t_velocity;        /* time of the velocities at the start of the step [s] */
    real momentum[DIM_MAX]; /* momentum of all particles at the start of the step [kg m/s] */
};

/* The 95 % interval of one result (number in summary.json), from a convergence study (study/uncertainty.h). figure:
 * name of the result; half_width: half the width of the interval, in the unit of the result. */
struct error_bar {
    char figure[NAME_MAX_LENGTH];
    double half_width;
};
enum { ERROR_BARS_MOST = 128 };

/* Wall-clock times of a run [s]; the rest, wall - setup - loop, is the writing of files. */
struct run_seconds {
    double wall;  /* of all, from the scene as read */
    double setup; /* before the first step, without files */
    double loop;  /* of the steps, without files */
};

/* State of the reports of a run: samples, progress lines, checkpoints and the times that the summary states. */
struct run_report {
    struct output *out;            /* kept by reference; NULL for a run without files (tests, benches) */
    struct sampling sampling;      /* the sample in progress */
    real *record;                  /* values of one line of history.csv, in the order of the columns */
    status history_status;         /* result of writing the last line of history.csv */
    int64_t particle_steps[KINDS]; /* particle updates so far, by kind */
    /* number of bonds (each counted once for each of its particles) summed over all steps so far */
    int64_t bond_visits;
    real inactive; /* fraction of the body at rest, summed over all steps [1] */
    struct {
        real inactive;
        int64_t step;
    } sampled;                 /* values of `inactive` and of the step number at the last sample */
    struct run_seconds before; /* times that earlier processes of a continued run spent, up to their checkpoint [s] */
    double setup_seconds;      /* wall-clock time before the first step in this process, without files [s] */
    double began, started;     /* wall-clock times at which the scene was read, and of the first step [s] */
    double last_progress, last_checkpoint; /* wall-clock times of the last progress line and checkpoint [s] */
    double checkpoint_seconds;             /* longest time that a checkpoint took, waiting for a frame included [s] */
    double checkpoints_spent;              /* time of the checkpoints after that of step 0, in this process [s] */
    int64_t step_started;                  /* number of the first step of this process */
    bool yield_said;                       /* the warning that bonds yield has been printed */
    bool excerpt;                /* only the first steps run, for the export: no warning about the energy balance */
    bool quiet;                  /* no progress line */
    char note[96];               /* text for the progress line of load steps */
    const struct error_bar *bar; /* [bars] half-widths of the error bars of results in the summary, kept by reference;
                                    NULL: no study */
    int bars;
    const volatile sig_atomic_t *stop; /* set by a signal handler to stop after a checkpoint; may be NULL */
};

/* Returns the number of frames (output states at one time) of the whole body that the run of scene s writes in addition
 * to the frame at t = 0. clock: time step and number of steps of the run. */
int64_t report_frame_count_of_run(const struct scene *s, const struct run_clock *clock);

/* Returns the number of the time step after which frame (output state) number `frame` of the whole body in scene s is
 * written; frame 0 is written at t = 0. clock: time step and number of steps of the run. */
int64_t report_step_number_of_frame(const struct scene *s, const struct run_clock *clock, int64_t frame);

/* Returns the wall-clock times of the run so far [s]: total, set-up and time steps, each summed over this process and
 * the processes before a restart. r: times of the earlier processes, of the start and of the set-up; timers: times of
 * the sections of a step in this process. */
struct run_seconds report_wall_clock_times(const struct run_report *r, const struct timers *timers);

/* Returns the set of frame series (sequences of output states of the whole body or of a region) that must be written
 * after `step` time steps or load steps, one bit per series: bit 0 is the whole body, bit k >= 1 is region k of the
 * scene s. clock: time step and number of steps of the run. Returns 0 if out is NULL (a run without files). A run that
 * finds a single equilibrium (`solver: cg, relaxation`) writes frames at its start and its end only. */
unsigned report_frame_series_due_after_step_as_bitmask(const struct output *out, const struct scene *s,
                                                       const struct run_clock *clock, int64_t step);

/* Returns true if a sample (a line of history.csv) is taken in the next time step. s: scene; clock: present step and
 * number of steps of the run. Samples are spread evenly over the run. For a scene without time steps, returns true
 * before the first step only; its equilibria are sampled by history_sample_write_in_equilibrium. */
bool report_history_sample_is_due(const struct scene *s, const struct run_clock *clock);

/* Starts the reports of the run before the first time step of this process: opens history.csv and, unless the run is
 * resumed, writes frame 0 and the first checkpoint. Warns of missing frames of a resumed run. Returns FAILED if a file
 * cannot be written or an index of frames cannot be read. */
status report_open_history_and_write_first_frame(struct run *run);

/* Reports a finished time step or load step of the run: takes the last sample after the last step, checks the
 * energies (run_check_last_sample_for_energy_divergence), and writes frames (states for output), checkpoint and
 * progress line if this step requires them. Returns FAILED if a file cannot be written, a particle has values that are
 * not finite, or run_check_last_sample_for_energy_divergence fails; INTERRUPTED, after a checkpoint, if a signal or the
 * wall-clock limit time.wall stops the run. */
status report_write_outputs_due_after_step(struct run *run);

/* Ends the reports of the run after its last step: prints the last progress line, waits for the thread that writes
 * frames, and writes the last checkpoint. Returns FAILED if a file cannot be written. */
status report_write_last_checkpoint_and_finish(struct run *run);

/* Returns the share of all particles p that are still at rest, which time steps skip (data/active_set.h) [1]:
 * peridynamic particles by the bonds b, material points by the mesh. */
real particles_at_rest_fraction(const struct bonds *b, const struct mesh *mesh, const struct particles *p);

/* Warns at the end of the run of three faults: energy or angular momentum is not conserved; interface damping, near
 * interfaces of material points and peridynamic particles, dissipated much energy; bonds broke in a collision that is
 * too fast for the particle spacing. */
void run_warn_of_unconserved_energy_and_momentum(struct run *run);

struct crack_tips;

/* Warns of the fastest crack tip of t whose largest speed is above the Rayleigh speed of every material of the scene s:
 * the energy release rate of an opening crack is 0 there (Freund 1990, section 5.3). Call it at the end of the run. The
 * warning is added to *warning_list and printed. */
void warn_of_tips_above_rayleigh_speed(const struct crack_tips *t, const struct scene *s,
                                       struct warnings *warning_list);

/* Warns once, at the first call after a bond of b has yielded, how the yielding of bonds differs from von Mises' law in
 * scene s. The warning is added to *warning_list and printed; *r records it, so that later calls do nothing. */
void warn_when_bonds_first_yield(struct run_report *r, const struct bonds *b, const struct scene *s,
                                 struct warnings *warning_list);

/* Computes the fields that the particles of the run do not store (strain, density, plastic work, level of the coarse
 * cell) and stores pointers to them in *extra, from which the frame is written. requested_field_bits: set of these
 * fields, as bits ASK_... (output/output.h). Before the call, the positions and stresses of all particles must be up to
 * date (run_update_particle_motion_and_stress), and extra->more, the material points of coarse cells, must be set. Call
 * frame_fields_free once the frame has been copied by output_begin_writing_frame_in_thread. */
void frame_fields_compute_requested(struct run *run, unsigned requested_field_bits, struct frame_extra *extra);

/* Frees the fields in *extra that frame_fields_compute_requested has allocated for a frame. */
void frame_fields_free(struct frame_extra *extra);

#endif
