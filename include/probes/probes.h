/* Room `probes`: what is measured in a run: time series, profiles, figures, the balance of energy. It reads particles,
 * bonds, loads and tips and changes none of them; output of the engine calls it.
 *
 * What a run measures besides its frames: time series, profiles, and the figures scripts rely on. */
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

/* Figures of EXACT; all but the last three by the stress of bond flux (probes_parts.h), those with `_strain` the
 * same of E x strain against E x exact strain; strain by central differences over the neighbours in the bar:
 *   L1, L2                  mean |error| and root mean square of the error over the particles [Pa]
 *   front, front_plastic    where the stress passes the middle of the jump of the closed form's (plastic) front [m]
 *   plateau                 mean stress behind the last front, off fronts and ends (exact_plateau) [Pa]
 *   strain_elastic, strain_plastic     mean strain ahead of and behind the plastic front [1]
 *   end_displacement        of the outermost particle at the loaded end, half a spacing inside [m]
 *   L1_velocity, L2_velocity, L2_displacement     as L1 and L2, with velocities when they are known */

/* The same run on material points alone (engine_baseline), at its end. */
struct baseline {
    real *v[DIM_MAX];   /* [n] velocities [m/s] */
    real energy_change; /* of all energy since the start [1] */
};

/* What probes may look at; borrowed, read only. */
struct observed {
    const struct particles *part;
    const struct cells *cells; /* reference search */
    const struct bonds *bonds;
    const struct loads *loads;
    const struct grid *grid;
    const struct tips *tips;
    const struct material *material;
    const struct partial_stress *partial;
    real spacing;                /* [m] */
    real thickness;              /* section, thickness or 1 */
    real strain_stress;          /* largest |component| of the initial stress [Pa], for PATCH */
    real residual_step0;         /* largest nodal |force| of the first step (grid and PD), for PATCH [N] */
    real t;                      /* [s] */
    bool in_steps;               /* load steps, in which applied forces are known as reactions are */
    int64_t load_step;           /* so many done, that at hand included; 0: the run has none */
    real energy_change;          /* (E - E_0 - work)/E_0 at the last sample; NAN without E_0 [1] */
    const struct growth *growth; /* cracks with prescribed or SIF-controlled growth */
    int growths;
    const struct baseline *baseline; /* NULL: none */
    real t_velocity;                 /* when velocities are known, half a step before t [s] */
    const struct wave_pulse *pulse;  /* initial pulses, for EXACT */
    int pulses;
    enum space space; /* ... and what SIF needs: horizon [m], pre-cracks */
    real horizon;
    const struct crack *crack;
    int cracks;
};

struct probe; /* probes.c */
struct probes {
    int n;
    struct probe *probe;
    int columns; /* of all probes together */
    struct column *column;
    real *value;  /* at the last sample, by column */
    real sampled; /* time of the last sample; NAN: none [s] */
};

/* Velocities at the end of a sample. */
struct velocity_time {
    real t;     /* that they are of [s] */
    real scale; /* of velocities of the sample over what lies between: bulk damping [1] */
};

/* Binds requests to particles. Refuses a point outside the body, an unknown boundary name, or a bar that is not that of
 * the closed form. */
status probes_make(struct probes *s, const struct probe_request *request, int n, const struct observed *o);
void probes_free(struct probes *s);
/* Fills value[], as far as positions tell. */
void probes_sample(struct probes *s, const struct observed *o);
/* Velocities are known half a step before and after the time of a sample, reactions with the forces of the step.
 * `keep`, before the step: keeps positions and velocities of o->t and o->t_velocity. `sample_end`, after it: fills the
 * rest of value[] for the time kept; `now`: of present velocities. Without a `keep` before, the body is in
 * equilibrium. */
void probes_keep(struct probes *s, const struct observed *o);
void probes_sample_end(struct probes *s, const struct observed *o, const struct velocity_time *now);
/* Called every step, before the flags of the step are cleared: BREAK and SPALL look where FLAG_LOST_BOND marks that
 * bonds broke, REACTION adds up its largest and rms force. */
void probes_step(struct probes *s, const struct observed *o);
/* The part of it that looks for broken bonds. */
void probes_breaks(struct probes *s, const struct observed *o);
/* Calls `emit` for every figure of every probe: probe name, quantity, value (SI). Figures a run does not have
 * (NAN) are left out. */
void probes_figures(const struct probes *s, const struct observed *o,
                    void (*emit)(void *context, const char *probe, const char *quantity, real value), void *context);
/* The profiles of LINE and EXACT probes as csv, each handed to `put` as the file <name>_<frame>.csv; and how many
 * they are. */
typedef status probe_file_fn(void *context, const char *name, const char *text, size_t length);
status probes_profiles(const struct probes *s, const struct observed *o, probe_file_fn *put, void *context, int frame);
int64_t probes_profiled(const struct probes *s);
/* Name of the file of a frame of the k-th of them, into `name` [PROFILE_NAME]; false: there is none. */
enum { PROFILE_NAME = NAME_MAX_LENGTH + 16 };
bool probes_profile_name(const struct probes *s, int k, int frame, char *name);
/* Factors of the named SIF probe at the last sample, and the direction of its tip then; false: none yet. */
bool probes_sif_control(const struct probes *s, const char *name, struct control *found);
/* Tip, as tips and growths are now, and radius [m] of the k-th probe, if it is a SIF probe; else false. */
bool probes_sif_ring(const struct probes *s, int k, const struct observed *o, real place[2], real *radius);
status probes_archive(struct probes *s, struct archive *a);

#endif
