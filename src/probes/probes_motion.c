/* Computes the motion of the particles of a probe (a requested measurement) at the time of a sample. Leap-frog
 * integration provides velocities only half a step before and after that time, between which they are interpolated. */
#include "base/memory.h"
#include "probes_parts.h"

/* Copies the values of the vector field from[dim][particles] at the particles of probe q (a requested measurement) to
 * to[dim][q->n]. Arrays to[d] that are NULL are allocated. */
static void copy_listed(const struct probe *q, real *const *from, real **to, int dim)
{
    for (int d = 0; d < dim; d++) {
        if (!to[d]) to[d] = BARE("probes.motion", q->n, real);
        for (int64_t k = 0; k < q->n; k++) to[d][k] = from[d][q->list[k]];
    }
}

void probe_motion_store_before_step(struct probe *q, const struct observed_run *o)
{
    struct sampled_motion *m = &q->motion;
    m->kept = true, m->t = o->t, m->t_velocity = o->t_velocity;
    copy_listed(q, o->part->x, m->x, o->part->dim);
    copy_listed(q, o->part->v, m->v, o->part->dim);
}

void probe_motion_interpolate_to_sample_time(struct probe *q, const struct observed_run *o,
                                             const struct velocity_time *present_velocity_time)
{
    struct sampled_motion *m = &q->motion;
    const struct particles *p = o->part;
    if (!m->kept || !(present_velocity_time->t > m->t_velocity)) return;
    const real share = (o->t - m->t_velocity) / (present_velocity_time->t - m->t_velocity);
    if (o->t > m->t) copy_listed(q, p->x, m->x, p->dim);
    for (int d = 0; d < p->dim; d++)
        for (int64_t k = 0; k < q->n; k++)
            m->v[d][k] = present_velocity_time->scale * ((1 - share) * m->v[d][k] + share * p->v[d][q->list[k]]);
    m->t_velocity = o->t; /* no step follows the last sample: extrapolate from the previous motion */
    m->complete = true;
}

void probe_motion_discard_interpolation(struct probe *q) { q->motion.complete = false; }

void probe_motion_free(struct probe *q)
{
    for (int d = 0; d < DIM_MAX; d++) memory_free(q->motion.x[d]), memory_free(q->motion.v[d]);
}
