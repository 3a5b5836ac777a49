/* Applies forces to particles (tractions and body forces) and sums their impulse and work. The force of a load on a
 * particle is a function of time times a constant factor of the particle (its area, volume or mass), its share. Loads
 * on equal lists of particles are applied in one loop over the list; the first of these loads is called the leader.
 * Loads with equal shares are added up before. */
#include <math.h>
#include <string.h>

#include "loads/loads.h"
#include "base/memory.h"
#include "base/team.h"

/* ---- set-up ------------------------------------------------------------------------------------------------------ */

/* Returns true if loads a and b can be applied together: they act on equal lists of particles, and their shares (area,
 * volume or mass of each particle, by which the value of a load is multiplied) are constant in time. */
static bool same_particles(const struct load *a, const struct load *b)
{
    return !a->moving && !b->moving && a->n == b->n &&
           arrays_equal(a->particle, b->particle, a->n, sizeof *a->particle);
}

/* Saves memory: frees the array of shares of component d of load number b if an earlier component of the load, or an
 * earlier load of l on the same particles, has an equal array, and refers to that array instead. (A share is the area,
 * volume or mass of a particle, by which the value of the load is multiplied.) dim: number of components. */
static void share_join(struct loads *l, int b, int d, int dim)
{
    struct load *load = &l->load[b];
    for (int c = load->leader; c < b; c++)
        for (int a = 0; a < dim && l->load[c].leader == load->leader; a++) {
            real *other = l->load[c].share[a];
            if (other == load->share[d] || !arrays_equal(other, load->share[d], load->n, sizeof(real))) continue;
            memory_free(load->share[d]);
            load->share[d] = other;
            return;
        }
}

/* Finds the leader of load number b of l: the first load on an equal list of particles, or b itself. Loads with one
 * leader are applied together. Equal arrays of shares (areas, volumes or masses of the particles) are stored once.
 * Allocates in the leader the arrays of previous positions, from which the work of the loads is computed. dim: number
 * of components. */
static void load_join(struct loads *l, int b, int dim)
{
    struct load *load = &l->load[b];
    const bool alike = load->share[dim - 1] == load->share[0];
    load->leader = b;
    for (int c = 0; c < b && load->leader == b; c++)
        if (l->load[c].leader == c && same_particles(&l->load[c], load)) load->leader = c;
    share_join(l, b, 0, dim);
    for (int d = 1; d < dim; d++)
        if (alike)
            load->share[d] = load->share[0];
        else
            share_join(l, b, d, dim);
    for (int d = 0; d < dim; d++)
        if (load->boundary->value[d] != 0 && !l->load[load->leader].before[d])
            l->load[load->leader].before[d] = NEW("loads.before", load->n, real);
}

void loads_merge_equal_particle_lists(struct loads *l, int dim)
{
    for (int b = 0; b < l->n; b++) {
        l->load[b].leader = -1;
        if (boundary_applies_force(l->load[b].boundary) && l->load[b].n > 0) load_join(l, b, dim);
    }
}

/* Returns true if component d of load number b of l refers to an array of shares (areas, volumes or masses of the
 * particles) that belongs to an earlier load or component. The array must then not be freed for load b. */
static bool is_borrowed(const struct loads *l, int b, int d)
{
    for (int c = 0; c <= b; c++)
        for (int a = 0; a < (c < b ? DIM_MAX : d); a++)
            if (l->load[c].share[a] == l->load[b].share[d]) return true;
    return false;
}

void loads_particle_load_factors_free(struct loads *l)
{
    for (int b = l->n; b-- > 0;)
        for (int d = DIM_MAX; d-- > 0;) {
            if (!is_borrowed(l, b, d)) memory_free(l->load[b].share[d]);
            memory_free(l->load[b].before[d]);
        }
}

/* ---- one component of all loads of a leader ---------------------------------------------------------------------- */

/* One component of the forces of all loads with one leader, i.e. on one list particle[n]. The force on entry k of the
 * list is the sum over the terms b of value[b] share[b][k]. f, x: forces [N] and present coordinates [m] of all
 * particles; before[n]: coordinates of the listed particles when the forces were last applied [m]. Refers to arrays of
 * the loads and particles; local to a step. */
struct push {
    const int32_t *particle;
    int terms;
    const real *share[BOUNDARIES_MAX], *x;
    real value[BOUNDARIES_MAX], *f, *before;
};

/* Prepares *a to apply component d of all loads of l with the leader `leader` (the first of the loads on equal lists of
 * particles) to particles p. Loads with the same array of shares (areas, volumes or masses of the particles) are added
 * up to one term of *a: a value times this array. factor[l->n]: present value of the time function of each load,
 * dimensionless. Returns false if none of these loads has a value for component d. */
static bool push_make(struct push *a, const struct loads *l, int leader, struct particles *p, int d, const real *factor)
{
    const struct load *first = &l->load[leader];
    a->particle = first->particle, a->before = first->before[d], a->x = p->x[d], a->f = p->f[d];
    a->terms = 0;
    for (int b = leader; b < l->n; b++) {
        const real value = l->load[b].boundary->value[d];
        int k = 0;
        if (l->load[b].leader != leader || value == 0) continue;
        while (k < a->terms && a->share[k] != l->load[b].share[d]) k++;
        if (k == a->terms) a->share[a->terms] = l->load[b].share[d], a->value[a->terms++] = 0;
        a->value[k] += factor[b] * value;
    }
    return a->terms > 0;
}

/* Computes force[end - first] [N], one component of the applied force on the particles with the numbers first .. end -
 * 1 in the list of a. It is the sum over the terms of a, each a value times an array of shares (areas, volumes or
 * masses). */
static void loads_applied_forces(const struct push *a, int64_t first, int64_t end, real *restrict force)
{
    for (int b = 0; b < a->terms; b++) {
        const real *restrict share = a->share[b] + first, value = a->value[b];
        for (int64_t k = 0; k < end - first; k++) force[k] = b > 0 ? force[k] + value * share[k] : value * share[k];
    }
}

/* Adds `force` [N] to the force on particle i, and returns `force`. Stores the present coordinate of the particle in
 * a->before[k], from which work_one computes the displacement later. k: position of the particle in the list of a. */
static ALWAYS_INLINE real push_one(const struct push *a, int64_t k, int64_t i, real force)
{
    a->before[k] = a->x[i];
    a->f[i] += force;
    return force;
}

/* Returns the work of `force` [N] over the displacement of particle i since push_one stored its coordinate in
 * a->before[k] [J]. k: position of the particle in the list of a. */
static ALWAYS_INLINE real work_one(const struct push *a, int64_t k, int64_t i, real force)
{
    return force * (a->x[i] - a->before[k]);
}

/* Returns true if the entries first .. end - 1 of the ascending list `particle` are consecutive indices. */
static bool follow_each_other(const int32_t *particle, int64_t first, int64_t end)
{
    return particle[end - 1] - particle[first] == end - 1 - first;
}

/* Returns the sum of one(a, k, i, force[k - first]) over k = first .. end - 1, with i = a->particle[k], in LANES
 * partial sums. k: number in the list of particles; force[end - first] [N]; dense: true if the indices of these
 * particles are consecutive, known at compile time. */
static ALWAYS_INLINE real block_sum(real one(const struct push *, int64_t, int64_t, real), const struct push *a,
                                    int64_t first, int64_t end, const real *force, const bool dense)
{
    const int64_t shift = a->particle[first] - first;
    real part[LANES] = {0}, sum = 0;
    int64_t k = first;
    for (; k + LANES <= end; k += LANES)
#pragma omp simd
        for (int l = 0; l < LANES; l++)
            part[l] += one(a, k + l, dense ? k + l + shift : a->particle[k + l], force[k + l - first]);
    for (; k < end; k++) part[0] += one(a, k, a->particle[k], force[k - first]);
    for (int l = 0; l < LANES; l++) sum += part[l];
    return sum;
}

/* Adds the applied forces to the particles with the numbers first .. end - 1 in a list, and the sum of these forces to
 * *sum [N]. context: a struct push, with one component of the loads on this list. Called by reproducible_sums for each
 * block of numbers. */
static void push_block(const void *context, int64_t first, int64_t end, real *sum)
{
    const struct push *a = context;
    real force[SUM_BLOCK];
    loads_applied_forces(a, first, end, force);
    *sum += follow_each_other(a->particle, first, end) ? block_sum(push_one, a, first, end, force, true)
                                                       : block_sum(push_one, a, first, end, force, false);
}

/* Adds the work of the applied forces on the particles with the numbers first .. end - 1 in a list to *sum [J].
 * context: a struct push, with one component of the loads on this list. Called by reproducible_sums for each block of
 * numbers. */
static void work_block(const void *context, int64_t first, int64_t end, real *sum)
{
    const struct push *a = context;
    real force[SUM_BLOCK];
    loads_applied_forces(a, first, end, force);
    *sum += follow_each_other(a->particle, first, end) ? block_sum(work_one, a, first, end, force, true)
                                                       : block_sum(work_one, a, first, end, force, false);
}

/* ---- a step ------------------------------------------------------------------------------------------------------ */

/* Returns the dimensionless factor of a load for the velocity update from t - dt_velocity to t [s]: the mean of its
 * time function f over this interval by the trapezoidal rule. The trapezoidal rule is accurate to second order, f(t)
 * alone only to first order. It also gives the exact impulse of a load that is switched on or off at a whole step. */
static real kick_factor(const struct time_function *f, real t, real dt_velocity)
{
    return 0.5 * (time_function_value(f, t - dt_velocity) + time_function_value(f, t));
}

/* Adds the applied forces of l at time t [s] to p->f, and their impulses over the velocity update of duration
 * dt_velocity [s] to l->impulse. The impulse of a step is summed before it is added to that of all steps, so that
 * round-off grows with the number of steps alone. */
void loads_add_applied_forces(struct loads *l, struct particles *p, real t, real dt_velocity)
{
    real factor[BOUNDARIES_MAX], given;
    struct push a;
    loads_update_time_mean_load_factors_for_forces(l, p, t, dt_velocity);
    for (int b = 0; b < l->n; b++) {
        const struct load *load = &l->load[b];
        factor[b] = load->moving ? 1 : kick_factor(&load->boundary->time, t, dt_velocity);
    }
    for (int b = 0; b < l->n; b++)
        for (int d = 0; d < p->dim && l->load[b].leader == b; d++) {
            if (!push_make(&a, l, b, p, d, factor)) continue;
            reproducible_sums(l->load[b].n, 1, push_block, &a, &given);
            l->impulse[d] += given * dt_velocity;
        }
}

/* Returns the dimensionless factor of a load for its work in the position update about time t [s]: f(t)/2 + (f(t - dt)
 * + f(t + dt))/4. The work must equal the change of the energy m v- . v+/2, with the velocities v- and v+ half a step
 * before and after t. It is the displacement times the mean force of the velocity updates before and after, each of
 * which uses the mean of the time function f at both ends of its interval. dt: time step [s]. */
static real drift_factor(const struct time_function *f, real t, real dt)
{
    return 0.5 * time_function_value(f, t) +
           0.25 * (time_function_value(f, real_max(0, t - dt)) + time_function_value(f, t + dt));
}

void loads_add_work_of_applied_forces(struct loads *l, struct particles *p, real t, real dt)
{
    real factor[BOUNDARIES_MAX], done;
    struct push a;
    loads_update_time_mean_load_factors_for_work(l, p, t, dt);
    for (int b = 0; b < l->n; b++) {
        const struct load *load = &l->load[b];
        factor[b] = load->moving ? 1 : drift_factor(&load->boundary->time, t, dt);
    }
    for (int b = 0; b < l->n; b++)
        for (int d = 0; d < p->dim && l->load[b].leader == b; d++) {
            if (!push_make(&a, l, b, p, d, factor)) continue;
            reproducible_sums(l->load[b].n, 1, work_block, &a, &done);
            l->work += done;
        }
}

/* Sets all components of the forces p->f to 0 for the particles number first .. end - 1 in the list of a load. */
static void clear_run(const struct load *load, struct particles *p, int64_t first, int64_t end)
{
    const bool dense = follow_each_other(load->particle, first, end);
    for (int d = 0; d < p->dim; d++)
        if (dense)
            array_fill_bytes(p->f[d] + load->particle[first], 0, end - first, sizeof(real));
        else
            for (int64_t k = first; k < end; k++) p->f[d][load->particle[k]] = 0;
}

void loads_clear_forces_of_loaded_particles(struct loads *l, struct particles *p)
{
    for (int b = 0; b < l->n; b++) {
        const struct load *load = &l->load[b];
        const int64_t n = load->n;
        if (boundary_applies_force(load->boundary) && load->leader != b) continue;
        TEAM_LOOP(n > SUM_BLOCK, for (int64_t first = 0; first < n; first += SUM_BLOCK)
                                     clear_run(load, p, first, first + SUM_BLOCK < n ? first + SUM_BLOCK : n););
    }
}
