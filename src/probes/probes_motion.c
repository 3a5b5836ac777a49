/* Computes the motion of the particles of a probe (a requested measurement) at the time of a sample. Leap-frog
 * integration provides velocities only half a step before and after that time, between which they are interpolated. */
#include "base/memory.h"
#include "probes_parts.h"

/* Copies the values of the vector field from[dim][particles] at the particles of the probe (a requested measurement) to
 * to[dim][probe->n]. Arrays to[d] that are NULL are allocated. */
static void copy_listed(const struct probe *probe, real *const *from, real **to, int dim)
{
    for (int d = 0; d < dim; d++) {
        if (!to[d]) to[d] = BARE("probes.motion", probe->n, real);
        for (int64_t k = 0; k < probe->n; k++) to[d][k] = from[d][probe->list[k]];
    }
}

void probe_motion_store_before_step(struct probe *probe, const struct observed_run *o)
{
    struct sampled_motion *m = &probe->motion;
    m->kept = true, m->t = o->t, m->t_velocity = o->t_velocity;
    copy_listed(probe, o->part->x, m->x, o->part->dim);
    copy_listed(probe, o->part->v, m->v, o->part->dim);
}

void probe_motion_interpolate_to_sample_time(struct probe *probe, const struct observed_run *o,
                                             const struct velocity_time *present_velocity_time)
{
    struct sampled_motion *m = &probe->motion;
    const struct particles *p = o->part;
    if (!m->kept || !(present_velocity_time->t > m->t_velocity)) return;
    const real share = (o->t - m->t_velocity) / (present_velocity_time->t - m->t_velocity);
    if (o->t > m->t) copy_listed(probe, p->x, m->x, p->dim);
    for (int d = 0; d < p->dim; d++)
        for (int64_t k = 0; k < probe->n; k++)
            m->v[d][k] = present_velocity_time->scale * ((1 - share) * m->v[d][k] + share * p->v[d][probe->list[k]]);
    m->t_velocity = o->t; /* no step follows the last sample: extrapolate from the previous motion */
    m->complete = true;
}

void probe_motion_discard_interpolation(struct probe *probe) { probe->motion.complete = false; }

void probe_motion_free(struct probe *probe)
{
    for (int d = 0; d < DIM_MAX; d++) memory_free(probe->motion.x[d]), memory_free(probe->motion.v[d]);
}
