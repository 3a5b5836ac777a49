/* Applies bulk damping: the force -c m v on every particle and node, the mass-proportional part of Rayleigh damping.
 *
 * From one step to the next all velocities are multiplied by D = exp(-c dt): by s = exp(-c dt/2) before the velocity
 * update by the forces f, and by s after it. This is second-order accurate in c dt: v+ = D v + s dt f/m, with v the
 * velocity before the step. Under a constant force v tends to f/(c m) (c dt/2)/sinh(c dt/2). The scheme dissipates
 * energy for any c dt: the product of the two roots of an oscillator's difference equation is D, so that the amplitude
 * decreases by the factor s in each step, up to round-off.
 *
 * In the code the velocity update by forces has the duration s dt, and velocities are multiplied by D at the end of a
 * step, by s before the first update. The loss follows from the energy that leap-frog conserves, E = 1/2 m v- . v+/s +
 * U, with v- and v+ before and after an update. With v+ of one step, v- = D v+ and w+ of the next, the forces that do
 * the work give E' - E = -1/2 m (1 - D)/s v+ . (v+ + w+). In addition, a support that exerts the force R in the update
 * does the work 1/2 dt R . (v-/D + v+): its impulse s dt R, divided by s, times the mean of the velocities without
 * damping. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "base/team.h"
#include "step/damping.h"
#include "loads/mirrors.h"

#define EXPONENT_MOST 50.0 /* largest c dt: beyond it, exp(-c dt) is round-off */

/* Particles, or nodes of a mesh (flag is NULL), whose velocities bulk damping reduces. n: their number; dim: dimensions
 * of space. */
struct damped {
    int64_t n;
    int dim;
    real factor;                    /* factor on the velocities [1] */
    const real *mass;               /* [n] masses [kg] */
    real *const *v, *const *before; /* [dim] velocities [m/s]; velocities before the update of this step [m/s] */
    const uint8_t *flag;            /* [n] flags of the particles (enum particle_flag) */
};

/* Returns true if bulk damping acts on entry i of a (a particle or a mesh node) itself. Returns false for a material
 * point of a mesh, since the nodes carry its mass. */
static bool moves_itself(const struct damped *a, int64_t i) { return !(a->flag && a->flag[i] & FLAG_MESHED); }

/* Adds to sum[0] the energy [J] that bulk damping has dissipated since the previous step in the particles or mesh nodes
 * with the numbers first .. end - 1. context: a struct damped with the present velocities v, and with `before`, the
 * velocities at the previous damping. Called by reproducible_sums for each block of numbers. */
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

/* Multiplies the velocities of the particles or mesh nodes with the numbers first .. end - 1 by the damping factor.
 * Adds the momentum that they lose to sum[0 .. dim - 1] [N s], and their kinetic energy before the change to
 * sum[DIM_MAX] [J]. context: a struct damped with the velocities. Called by reproducible_sums for each block of
 * numbers. */
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

/* Returns `decay`, the product of the rate of bulk damping and the time step, limited to EXPONENT_MOST [1]. */
static real capped(real decay) { return real_min(decay, EXPONENT_MOST); }

real damping_velocity_increment_factor(real rate_times_dt) { return exp(-0.5 * capped(rate_times_dt)); }

struct undamped_velocity_excess damping_relative_excess_of_undamped_velocities(real rate_times_dt, bool first_step)
{
    const real half = expm1(0.5 * capped(rate_times_dt));
    return (struct undamped_velocity_excess){first_step ? half : expm1(capped(rate_times_dt)), half};
}

/* Stores what bulk damping acts on in all[2]: in all[0] the particles, in all[1] the nodes of the mesh. factor: factor
 * on their velocities [1]. Returns the number of entries: 2, or 1 if the mesh has no points. p: all particles. */
static int damped_find(const struct particles *p, const struct mesh *mesh, real factor, struct damped all[2])
{
    all[0] = (struct damped){.n = p->n, p->dim, factor, p->mass, p->v, .flag = p->flag};
    all[1] = (struct damped){.n = mesh->grid.n, p->dim, factor, mesh->grid.mass, mesh->grid.velocity};
    return mesh->points > 0 ? 2 : 1;
}

/* Multiplies the velocities of particles and mesh nodes, the APIC velocity gradients and the velocities of mirror
 * images by `factor` [1], and subtracts the lost momentum from the impulse of the loads l. Returns the kinetic energy
 * before that [J]. p: all particles. */
static real slow_all(struct particles *p, const struct mesh *mesh, struct loads *l, real factor)
{
    struct damped all[2];
    real kinetic = 0;
    const int kinds = damped_find(p, mesh, factor, all);
    for (int k = 0; k < kinds; k++) {
        real sum[DIM_MAX + 1];
        reproducible_sums(all[k].n, DIM_MAX + 1, slow_block, &all[k], sum);
        for (int d = 0; d < p->dim; d++) l->impulse[d] -= sum[d];
        kinetic += sum[DIM_MAX];
    }
    for (int c = 0; c < square(p->dim) && p->gradient[c]; c++) /* velocity gradients of APIC */
        for (int64_t i = 0; i < p->n; i++) p->gradient[c][i] *= factor;
    loads_update_mirror_images_of_particles(l, p);
    return kinetic;
}

real damping_apply_first_half_step_and_sum_loss(struct particles *p, const struct mesh *mesh, struct loads *l,
                                                real rate_times_dt)
{
    const real share = damping_velocity_increment_factor(rate_times_dt);
    return (1 - share) * slow_all(p, mesh, l, share);
}

void damping_store_velocities(struct damping_state *s, const struct particles *p, const struct mesh *mesh)
{
    struct damped all[2];
    const int kinds = damped_find(p, mesh, 1, all);
    for (int k = 0; k < kinds; k++)
        for (int d = 0; d < p->dim; d++) {
            if (!s->before[k][d]) s->before[k][d] = NEW("engine.damping", all[k].n, real);
            array_copy(s->before[k][d], all[k].v[d], all[k].n, sizeof(real));
        }
}

real damping_energy_loss_since_previous_step(const struct damping_state *s, const struct particles *p,
                                             const struct mesh *mesh, real rate_times_dt)
{
    struct damped all[2];
    real loss = 0, sum;
    const int kinds = damped_find(p, mesh, exp(-capped(rate_times_dt)), all);
    for (int k = 0; k < kinds; k++) {
        all[k].before = s->before[k];
        reproducible_sums(all[k].n, 1, loss_block, &all[k], &sum), loss += sum;
    }
    return loss / damping_velocity_increment_factor(rate_times_dt);
}

real damping_energy_loss_in_last_velocity_update(real rate_times_dt, real kinetic_energy_before,
                                                 real leapfrog_kinetic_energy)
{
    const real grown = exp(capped(rate_times_dt));
    return (grown - 1) * (grown * kinetic_energy_before + leapfrog_kinetic_energy) /
           damping_velocity_increment_factor(rate_times_dt);
}

void damping_apply_full_step(struct particles *p, const struct mesh *mesh, struct loads *l, real rate_times_dt)
{
    slow_all(p, mesh, l, exp(-capped(rate_times_dt)));
}
