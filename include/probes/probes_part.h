/* Probes as a part of a run. */
#ifndef CLEAVE_PROBES_PART
#define CLEAVE_PROBES_PART

#include "output/output.h"
#include "probes/probes.h"
#include "run/run.h"

/* The probes of a run and reference values with which they are compared. */
struct probing {
    struct probes probes;
    struct wave_pulse *pulse; /* [pulses] pulses of the initial states */
    int pulses;
    struct baseline baseline; /* for PULSE probes, made at the end of the run */
    bool has_baseline;
    real residual_step0; /* for PATCH probes: largest nodal force of the first step [N] */
    real strain_stress;  /* for PATCH probes: largest component of the initial stress [Pa] */
};

/* Returns the largest |component| of the stress of particles [Pa]. */
real largest_stress(const struct particles *p);

/* Lists the pulses of the initial states of a scene. */
void make_pulses(const struct scene *s, struct probing *probing);

/* Extends the growing cracks by one step; cracks controlled by a SIF probe follow its factors. Returns the number of
 * directed bonds cut. */
int64_t cracks_grow(struct run *e);

/* Stores the largest force component on nodes of grids and on peridynamic particles in the regions of PATCH probes.
 * Call it in the first step, between forces and motion. */
void residual_keep(struct probing *q, const struct scene *s, const struct particles *p, const struct grid_method *grid);

/* Stores the largest force component on nodes of a mesh of the reference frame in the regions of PATCH probes. Call it
 * in the first step, between forces and motion. */
void residual_keep_mesh(struct probing *q, const struct scene *s, const struct mesh *mesh);

/* Writes the profiles of LINE and EXACT probes as files named after the frame that `out` has just written. Returns
 * FAILED if a file cannot be written. */
status profiles_write(const struct probes *s, const struct output *out, const struct observed *o);

/* Warns of profiles of a resumed run that are missing. */
void profiles_check(const struct probes *s, const struct output *out, struct warnings *to);

/* Removes the profiles of a previous run in the folder, before a new run. */
void profiles_remove(const struct probes *s, const struct output *out);

#endif
