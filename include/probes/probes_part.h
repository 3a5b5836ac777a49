/* Probes, as a part of a run. */
#ifndef CLEAVE_PROBES_PART
#define CLEAVE_PROBES_PART

#include "output/output.h"
#include "probes/probes.h"
#include "run/run.h"

/* Probes and what they compare with. */
struct probing {
    struct probes probes;
    struct wave_pulse *pulse; /* [pulses] of the initial states */
    int pulses;
    struct baseline baseline; /* for pulse probes, made at the end */
    bool has_baseline;
    real residual_step0; /* largest nodal force of the first step, for patch probes [N] */
    real strain_stress;  /* largest component of the initial stress [Pa] */
};

/* Largest component of the stress of particles, at the start [Pa]. */
real largest_stress(const struct particles *p);
/* The pulses of the initial states of a scene. */
void make_pulses(const struct scene *s, struct probing *probing);
/* Advances the growing cracks by one step, those that a sif probe controls by its factors; returns the number of
 * directed bonds released. */
int64_t cracks_grow(struct run *e);
/* Keeps the largest force on nodes of grids and on peridynamic particles in the regions of patch probes. In the first
 * step, between forces and motion. */
void residual_keep(struct probing *q, const struct scene *s, const struct particles *p, const struct grid_method *grid);

/* Keeps the largest force on nodes of a mesh in the regions of patch probes, likewise. */
void residual_keep_mesh(struct probing *q, const struct scene *s, const struct mesh *mesh);

/* Writes the profiles of LINE and EXACT probes, with the number of the frame that `out` has just written. FAILED if a
 * file cannot be written. */
status profiles_write(const struct probes *s, const struct output *out, const struct observed *o);

/* Warns of profiles that a resumed run had written and that are missing. */
void profiles_check(const struct probes *s, const struct output *out, struct warnings *to);

/* Removes the profiles of an older run, before a run that replaces it. */
void profiles_remove(const struct probes *s, const struct output *out);

#endif
