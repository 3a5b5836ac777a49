/* Room `probes`: quantities measured in a run besides frames: time series, profiles, figures for scripts, the
 * balance of energy. Probes read particles, bonds, loads and tips and change none of them; the step and its reports
 * call them. */
#ifndef CLEAVE_PROBES
#define CLEAVE_PROBES

#include "base/archive.h"
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

/* Figures of EXACT. All but the last three are computed from the stress by bond flux (probes_parts.h); figures with
 * `_strain` compare E x strain with E x exact strain, with strain by central differences over neighbours in the bar:
 *   L1, L2                  mean |error| and root mean square of the error over the particles [Pa]
 *   front, front_plastic    where the stress passes the middle of the jump of the closed form's (plastic) front [m]
 *   plateau                 mean stress behind the last front, away from fronts and ends (exact_plateau) [Pa]
 *   strain_elastic, strain_plastic     mean strain ahead of and behind the plastic front [1]
 *   end_displacement        of the outermost particle at the loaded end, half a spacing from the end [m]
 *   L1_velocity, L2_velocity, L2_displacement     as L1 and L2, at the time of the velocities */

/* Final state of the run on material points alone with which PULSE probes are compared (engine_baseline). */
struct baseline {
    real *v[DIM_MAX];   /* [n] velocities [m/s] */
    real energy_change; /* relative energy change since the start [1] */
};

/* Read-only view of a run that probes measure (run_observed); all pointers are borrowed. */
struct observed {
    const struct particles *part;
    const struct cells *cells; /* search over reference positions */
    const struct bonds *bonds;
    const struct loads *loads;
    const struct grid *grid;
    const struct tips *tips;
    const struct material *material;
    const struct partial_stress *partial;
    real spacing;                /* of particles [m] */
    real thickness;              /* section of a bar [m^2], thickness in the plane [m], 1 in space */
    real strain_stress;          /* for PATCH: largest |component| of the initial stress [Pa] */
    real residual_step0;         /* for PATCH: largest force on a node or peridynamic particle in the first step [N] */
    real t;                      /* time of positions [s] */
    bool in_steps;               /* the run makes load steps, whose applied forces are known with their reactions */
    int64_t load_step;           /* load steps done, including the current one; 0 without load steps */
    real energy_change;          /* (E - E_0 - work)/E_0 at the last sample; NAN if E_0 is 0 [1] */
    const struct growth *growth; /* [growths] cracks with prescribed or SIF-controlled growth */
    int growths;
    const struct baseline *baseline; /* for PULSE; NULL if there is none */
    real t_velocity;                 /* time of velocities: half a step before t [s] */
    const struct wave_pulse *pulse;  /* [pulses] for EXACT: initial pulses */
    int pulses;
    enum space space;          /* for SIF */
    real horizon;              /* for SIF [m] */
    const struct crack *crack; /* for SIF: [cracks] pre-cracks */
    int cracks;
};

struct probe; /* probes_parts.h */
struct probes {
    int n;
    struct probe *probe;
    int columns; /* of all probes */
    struct column *column;
    real *value;  /* [columns] at the last sample */
    real sampled; /* time of the last sample; NAN if none [s] */
};

/* Time of the velocities at the end of a sample. */
struct velocity_time {
    real t;     /* of the present velocities [s] */
    real scale; /* factor of velocities of the sample that undoes half a step of bulk damping [1] */
};

/* Binds requests to particles of a run. Returns REFUSED for a point outside the body, an unknown boundary, or a bar
 * that the closed form does not describe. */
status probes_make(struct probes *s, const struct probe_request *request, int n, const struct observed *o);

/* Frees probes and what they own. */
void probes_free(struct probes *s);

/* Computes the values of a sample that depend on positions only, at o->t. */
void probes_sample(struct probes *s, const struct observed *o);

/* Stores positions of o->t and velocities of o->t_velocity, before a step. */
void probes_keep(struct probes *s, const struct observed *o);

/* Completes the values of a sample after the step, at the time of probes_keep: velocities are interpolated, and
 * reactions are those of the forces of the step. now: time of the present velocities. Without probes_keep before, the
 * body is taken to be in equilibrium. */
void probes_sample_end(struct probes *s, const struct observed *o, const struct velocity_time *now);

/* Updates the probes that observe every step: BREAK and SPALL search for bonds that just broke (FLAG_LOST_BOND),
 * REACTION updates its largest and root-mean-square force. Call it before the flags of the step are cleared. */
void probes_step(struct probes *s, const struct observed *o);

/* Updates BREAK and SPALL probes only, in load steps. */
void probes_breaks(struct probes *s, const struct observed *o);

/* Calls emit for every figure of every probe that is not NAN; value is in SI units, context is passed on. */
void probes_figures(const struct probes *s, const struct observed *o,
                    void (*emit)(void *context, const char *probe, const char *quantity, real value), void *context);

/* Writes a file `name` with a text of `length` bytes; context: as handed to probes_profiles. */
typedef status probe_file_fn(void *context, const char *name, const char *text, size_t length);

/* Prints the profile of every LINE and EXACT probe as CSV, and hands each to put as the file `<probe>_<frame>.csv`.
 * Returns FAILED if put does. */
status probes_profiles(const struct probes *s, const struct observed *o, probe_file_fn *put, void *context, int frame);

/* Returns the number of profiles of a frame. */
int64_t probes_profiled(const struct probes *s);

/* Longest name of a profile, with its terminator. */
enum { PROFILE_NAME = NAME_MAX_LENGTH + 16 };

/* Writes the file name of profile k of a frame to name [PROFILE_NAME]; returns false if there is no profile k. */
bool probes_profile_name(const struct probes *s, int k, int frame, char *name);

/* Finds the stress-intensity factors of the named SIF probe at the last sample, and the direction of its tip.
 * Returns false if there is none yet. */
bool probes_sif_control(const struct probes *s, const char *name, struct control *found);

/* Finds the present tip [m] and the outer radius [m] of probe k. Returns false if it is no SIF probe. */
bool probes_sif_ring(const struct probes *s, int k, const struct observed *o, real position[2], real *radius);

/* Saves or restores the state of probes; FAILED if a restored state does not fit the probes. */
status probes_archive(struct probes *s, struct archive *a);

#endif
