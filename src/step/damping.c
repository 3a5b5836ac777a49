/* Bulk damping: the force -c m v on every particle and node, mass-proportional as the first part of Rayleigh's damping.
 *
 * Between two steps all velocities shrink by D = exp(-c dt), half of it before the kick of the forces and half behind
 * it, so that motion is of second order in c dt: v+ = D v + s dt f/m, s = exp(-c dt/2), v the velocity of the step
 * before. Under a constant force it tends to f/(c m) (c dt/2)/sinh(c dt/2). However large c dt is, that only takes
 * energy: the product of the two roots of the difference equation of an oscillator is D, so that its amplitude shrinks
 * by s a step to the last digit.
 *
 * In the code kicks have the length s dt, and velocities are slowed by D behind a step, by s before the first. The loss
 * follows from the energy that leap-frog keeps, E = 1/2 m v- . v+/s + U, v- and v+ before and after a kick. With the v+
 * of one step, the v- = D v+ of the next and its w+, the same forces that do the work give E' - E = -1/2 m (1 - D)/s v+
 * . (v+ + w+). */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "base/team.h"
#include "mesh/mesh_part.h"
#include "step/damping.h"
#include "step/report.h"

#define EXPONENT_MOST 50.0 /* of what is then no more */

/* What has mass and velocity; flag NULL: nodes. */
struct damped {
    int dim;
    real factor; /* D */
    const real *mass;
    real *const *v, *const *before; /* before: v- of this step */
    const uint8_t *flag;
};

static bool moves_itself(const struct damped *a, int64_t i) { return !(a->flag && a->flag[i] & FLAG_MESHED); }

/* The loss of those from first to end - 1 since the step before [J]. */
static void loss_block(const void *context, int64_t first, int64_t end, real *sum)
{
    const struct damped *a = context;
    const real grown = 1 / a->factor;
    for (int d = 0; d < a->dim; d++)
        for (int64_t i = first; i < end; i++) {
            const real before = a->before[d][i];
            if (moves_itself(a, i)) sum[0] += 0.5 * (grown - 1) * a->mass[i] * before * (grown * before + a->v[d][i]);
        }
}

/* Slows them; sums are the momentum by component that they lose [N s], and their kinetic energy before [J]. */
static void slow_block(const void *context, int64_t first, int64_t end, real *sum)
{
    const struct damped *a = context;
    for (int d = 0; d < a->dim; d++)
        for (int64_t i = first; i < end; i++) {
            if (moves_itself(a, i)) {
                sum[d] += (1 - a->factor) * a->mass[i] * a->v[d][i];
                sum[DIM_MAX] += 0.5 * a->mass[i] * square(a->v[d][i]);
            }
            a->v[d][i] *= a->factor;
        }
}

static real damping_exponent(const struct scene *scene, const struct run_clock *clock)
{
    return real_min(scene->damping * clock->dt, EXPONENT_MOST);
}

real damping_share(const struct run *e) { return exp(-0.5 * damping_exponent(e->scene, &e->clock)); }

/* Particles and nodes; returns how many of the two there are. */
static int damped_find(struct run *e, struct damped *all, int64_t *n)
{
    struct particles *p = &e->part;
    struct grid *nodes = &e->frame->mesh.grid;
    const real factor = exp(-damping_exponent(e->scene, &e->clock));
    n[0] = p->n, n[1] = nodes->n;
    all[0] = (struct damped){p->dim, factor, p->mass, p->v, e->damping->before[0], p->flag};
    all[1] = (struct damped){p->dim, factor, nodes->mass, nodes->velocity, e->damping->before[1], NULL};
    return e->frame->mesh.points > 0 ? 2 : 1;
}

/* Multiplies all velocities by the factor; returns the kinetic energy before it [J]. */
static real slow_all(struct run *e, real factor)
{
    struct damped all[2];
    int64_t n[2];
    real kinetic = 0;
    const int kinds = damped_find(e, all, n);
    for (int k = 0; k < kinds; k++) {
        real sum[DIM_MAX + 1];
        all[k].factor = factor;
        team_sums(n[k], DIM_MAX + 1, slow_block, &all[k], sum);
        for (int d = 0; d < e->part.dim; d++) e->loads.impulse[d] -= sum[d];
        kinetic += sum[DIM_MAX];
    }
    for (int c = 0; c < square(e->part.dim) && e->part.gradient[c]; c++) /* what APIC carries beside velocities */
        for (int64_t i = 0; i < e->part.n; i++) e->part.gradient[c][i] *= factor;
    loads_mirror(&e->loads, &e->part);
    return kinetic;
}

/* The half of a decay before the first kick, which samples of the start do not see. */
static void damping_start(struct run *e)
{
    const real share = damping_share(e);
    e->damped += (1 - share) * slow_all(e, share);
    for (int d = 0; d < e->part.dim && e->report->sampling.before[d]; d++)
        for (int64_t i = 0; i < e->part.n; i++) e->report->sampling.before[d][i] *= share;
}

void damping_begin(struct run *e)
{
    struct damped all[2];
    int64_t n[2];
    if (!(e->scene->damping > 0)) return;
    if (e->clock.step == 0) damping_start(e);
    const int kinds = damped_find(e, all, n);
    for (int k = 0; k < kinds; k++)
        for (int d = 0; d < e->part.dim; d++) {
            if (!e->damping->before[k][d]) e->damping->before[k][d] = NEW("engine.damping", n[k], real);
            array_copy(e->damping->before[k][d], all[k].v[d], n[k], sizeof(real));
        }
}

real damping_loss(struct run *e)
{
    struct damped all[2];
    int64_t n[2];
    real loss = 0, sum;
    if (!(e->scene->damping > 0) || e->clock.step == 0) return 0; /* nothing is damped before the first step */
    const int kinds = damped_find(e, all, n);
    for (int k = 0; k < kinds; k++) team_sums(n[k], 1, loss_block, &all[k], &sum), loss += sum;
    return loss / damping_share(e);
}

real damping_last(const struct run *e, real kinetic_before, real kinetic)
{
    const real grown = exp(damping_exponent(e->scene, &e->clock));
    return e->clock.step > 0 ? (grown - 1) * (grown * kinetic_before + kinetic) / damping_share(e) : 0;
}

void damping_end(struct run *e)
{
    if (e->scene->damping > 0) slow_all(e, exp(-damping_exponent(e->scene, &e->clock)));
}
