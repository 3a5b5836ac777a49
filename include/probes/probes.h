/* Room `probes` (folder of include/ and src/): quantities measured in a run besides frames (states at one time): time
 * series, profiles, results for scripts, the energy balance. Probes read particles, bonds, loads and crack tips and
 * change none of them; the time step and its reports call them. */
#ifndef CLEAVE_PROBES
#define CLEAVE_PROBES

#include "base/archive.h"
#include "base/warnings.h"
#include "bonds/bonds.h"
#include "fracture/growth.h"
#include "output/column.h"
#include "scene/requests.h"
#include "data/cells.h"
#include "exact.h"
#include "loads/loads.h"
#include "data/particles.h"
#include "data/region.h"
#include "fracture/sif.h"
#include "fracture/tips.h"

/* Results of a probe of kind EXACT, which compares a bar with a closed-form solution. Stress is the stress by
 * bond flux (probes_parts.h); results with the suffix `_strain` use E x strain instead, with strain by
 * central differences over neighbours in the bar.
 *
 *   L1, L2                    mean |error| and root mean square of the error over the particles [Pa]
 *   front, front_plastic      position where the stress passes the middle of the jump of the front [m]
 *   plateau                   mean stress in the range EXACT_PLATEAU (probes/exact.h) [Pa]
 *   strain_elastic            mean strain between the elastic precursor and the plastic front [1]
 *   strain_plastic            mean strain behind the plastic front [1]
 *   end_displacement          of the outermost particle at the loaded end, half a spacing from the end [m]
 *   L1_velocity, L2_velocity  as L1 and L2, for velocities at their time [m/s]
 *   L2_displacement           as L2, for displacements [m] */

/* Final state of the run on material points alone with which PULSE probes are compared
 * (run_repeat_with_mpm_only_for_pulse_probe). */
struct baseline {
    real *v[DIM_MAX];   /* [n] velocities [m/s] */
    real energy_change; /* relative energy change since the start [1] */
};

/* Read-only view of a run that probes measure (observed_run_make_read_only_view); all pointers are borrowed. */
struct observed_run {
    const struct particles *part;         /* particles of all bodies */
    const struct cells *cells;            /* search over reference positions */
    const struct bonds *bonds;            /* all bonds */
    const struct kernels *kernels;        /* for ENERGY: loops over bonds */
    const struct loads *loads;            /* boundary conditions, with reactions */
    const struct grid *grid;              /* background grid of the current frame */
    const struct crack_tips *tips;        /* for TIP: tracked crack tips */
    const struct material *material;      /* materials of the scene, indexed by particles.material */
    const struct partial_stress *partial; /* share of their stress that material points leave to bonds */
    real spacing;                         /* distance of lattice particles [m] */
    real thickness;                       /* cross-section in 1D [m^2], thickness in 2D [m], 1 in 3D */
    real strain_stress;                   /* for PATCH: largest |component| of the initial stress [Pa] */
    real residual_step0; /* for PATCH: largest force on a node or peridynamic particle in the first step [N] */
    real t;              /* time of positions [s] */
    bool in_steps;       /* the run makes load steps, whose applied forces are known with their reactions */
    int64_t load_step;   /* load steps done, including the current one; 0 without load steps */
    real energy_change;  /* (E - E_0 - work)/E_0 at the last sample; NAN if E_0 is 0 [1] */
    const struct growing_crack *growth; /* [growths] cracks with prescribed or SIF-controlled growth */
    int growths;
    const struct baseline *baseline; /* for PULSE; NULL if there is none */
    real t_velocity;                 /* time of velocities: half a step before t [s] */
    const struct wave_pulse *pulse;  /* [pulses] for EXACT: initial pulses */
    int pulses;
    enum space space;          /* for SIF: dimension and plane state */
    real horizon;              /* for SIF: reach of bonds [m] */
    const struct crack *crack; /* for SIF: [cracks] pre-cracks */
    int cracks;
};

struct probe; /* probes_parts.h */

/* The probes of a run, and the values of the columns of history.csv that they add. */
struct probes {
    int n;
    struct probe *probe;   /* [n] */
    int columns;           /* number of columns of all probes */
    struct column *column; /* [columns] names and units */
    real *value;           /* [columns] at the last sample */
    real sampled;          /* time of the last sample; NAN if none [s] */
};

/* Time of the velocities after a time step, and a factor on velocities that a sample (line of history.csv) interpolates
 * to its own time (probes_sample_velocity_dependent_values). */
struct velocity_time {
    real t;     /* of the present velocities [s] */
    real scale; /* factor of velocities of the sample that undoes half a step of bulk damping [1] */
};

/* Initialises the probes *probes for the requests requests[request_count] of the scene: finds the particles that each
 * probe observes, and lists the columns that the probes add to history.csv. o: view of the run at the start. Returns
 * REFUSED, with nothing left to free, if a request does not suit the run. Cases: a point outside the bodies; a region
 * without particles; a named boundary that does not exist or has no reaction; a bar that differs from what its
 * closed-form solution describes; a SIF probe without crack tip or with unsuitable contours. */
status probes_make(struct probes *probes, const struct probe_request *requests, int request_count,
                   const struct observed_run *o);

/* Frees all probes that probes_make has made, and sets *probes to zero. Does nothing if *probes is zero. */
void probes_free(struct probes *probes);

/* Computes the values of a sample (a line of history.csv) at the current positions, time o->t, and stores them in
 * probes->value. Values that depend on velocities at the time of the sample or on the forces of the time step are
 * replaced later by probes_sample_velocity_dependent_values. */
void probes_sample_position_dependent_values(struct probes *probes, const struct observed_run *o);

/* Computes the kinetic, strain and fracture energy of the particles of the ENERGY probes of `probes` and stores them in
 * probes->value [J]. Must be called when the forces at the time of the sample are known and before anything moves, as
 * the energies of the whole run are computed. The kinetic energy is replaced later by
 * probes_sample_velocity_dependent_values. o: view of the run. */
void probes_sample_energies(struct probes *probes, const struct observed_run *o);

/* Copies the positions (at time o->t) and velocities (at time o->t_velocity) of the observed particles into the probes
 * *s. Must be called before the time step; probes_sample_velocity_dependent_values interpolates between these
 * velocities and those after the step. */
void probes_store_motion_before_step(struct probes *probes, const struct observed_run *o);

/* Computes the values of a sample (line of history.csv) that depend on velocities or on the forces of the time step,
 * after that step, and stores them in probes->value. The values are those at the time of the preceding call of
 * probes_store_motion_before_step: velocities are interpolated to that time, and reactions are those of the forces in
 * the step. now: time of the present velocities. If probes_store_motion_before_step was not called before, the body is
 * assumed to be in equilibrium. o: view of the run. */
void probes_sample_velocity_dependent_values(struct probes *probes, const struct observed_run *o,
                                             const struct velocity_time *now);

/* Appends to *warning_list and prints, once for each SIF probe (stress-intensity factors), a warning that K_I, K_II and
 * J have no value at the last sample (line of history.csv): the integration ring round a tip that has grown leaves the
 * body, or the results of its contours differ by more than 20 %. single_equilibrium: also for tips at rest, where no
 * wave can be the cause. t: time of the sample [s]. */
void probes_warn_of_meaningless_sif(struct probes *probes, bool single_equilibrium, real t,
                                    struct warnings *warning_list);

/* Updates the probes of `probes` that observe every time step of the run o. BREAK probes (first broken bond of a
 * region) and SPALL probes (separated end of a bar) search for bonds that broke in the step (particles whose flag
 * FLAG_LOST_BOND is set); REACTION probes (force of a support) update the largest force and the sum of squared forces.
 * Must be called before these flags are cleared. */
void probes_update_break_spall_and_reaction_probes(struct probes *probes, const struct observed_run *o);

/* Updates those probes of `probes` in the run o that search for bonds that just broke, and no others: BREAK probes
 * (first broken bond of a region) and SPALL probes (separated end of a bar). Load steps (sequences of static
 * equilibria) call this function each time bonds have broken. */
void probes_update_break_and_spall_probes(struct probes *probes, const struct observed_run *o);

/* Calls emit(context, probe name, quantity name, value) for every result of every probe of `probes` that summary.json
 * reports, in SI units. o: view of the run at the end. Values that are NAN are skipped. */
void probes_visit_results(const struct probes *probes, const struct observed_run *o,
                          void (*emit)(void *context, const char *probe, const char *quantity, real value),
                          void *context);

/* Type of a function that writes the `length` bytes of `text` to a file called `name`. context: argument that
 * probes_write_profiles passes on. Returns the status of the write. */
typedef status probe_file_fn(void *context, const char *name, const char *text, size_t length);

/* Prints the profile (table of values along a line) of each LINE and EXACT probe of `probes` as CSV text, and calls
 * write_file(context, `<probe>_<frame>.csv`, text, length) for each. frame_number: number of the frame (output state)
 * in these names; o: view of the present state of the run. Returns FAILED if memory is exhausted, or the status of
 * `write_file` if it is not OK. */
status probes_write_profiles(const struct probes *probes, const struct observed_run *o, probe_file_fn *write_file,
                             void *context, int frame_number);

/* Returns the number of profiles (tables of values along a line, one for each LINE and EXACT probe) that the probes
 * write with each frame. */
int64_t probes_count_profiles(const struct probes *probes);

/* Capacity of the name of a profile that a probe writes, with its terminator [byte]. */
enum { PROFILE_NAME = NAME_MAX_LENGTH + 16 };

/* Writes the file name of the profile of the probes with number `profile` >= 0 of frame number `frame_number` to
 * file_name[PROFILE_NAME]. Returns false, without a name, if there are at most `profile` profiles. */
bool probes_compose_profile_file_name(const struct probes *probes, int profile, int frame_number, char *file_name);

/* Copies the stress-intensity factors at the last sample of the probe of `probes` (kind SIF) called `probe_name`, and
 * the direction of the crack tip, to *control, by which a growing crack is controlled. Returns false if the probe has
 * no values yet. */
bool probes_copy_sif_to_growth_control(const struct probes *probes, const char *probe_name,
                                       struct growth_control *control);

/* Computes where the SIF probe (stress-intensity factors) number `probe` of `probes` integrates: stores the current
 * position of its crack tip in tip_position[2] [m], and the outer radius of its contours in *outer_radius [m]. o: view
 * of the run. Returns false, and stores nothing, if the probe is not a SIF probe. */
bool probes_locate_sif_contour(const struct probes *probes, int probe, const struct observed_run *o,
                               real tip_position[2], real *outer_radius);

/* Saves the state of the probes, such as times and positions of first breaks and largest forces so far, to the
 * archive a (checkpoint file or memory) if a->saving is set, else restores it from a. Returns FAILED if an entry is
 * missing or its size does not fit the probes. */
status probes_save_or_load(struct probes *probes, struct archive *a);

#endif
