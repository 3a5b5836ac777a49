/* Computes the balances of energy and momentum, records where bonds break first, and checks for diverged particles. */
#include "probes/diagnostics.h"

#include <math.h>
#include <stdio.h>

#include "kernels/kernels.h"
#include "base/memory.h"
#include "fracture/places.h"
#include "kernels/mpm/stress.h"
#include "base/team.h"

void diagnostics_initialise(struct diagnostics *w)
{
    *w = (struct diagnostics){
        .break_time = NAN, .break_position = {NAN, NAN, NAN}, .driven_time = NAN, .now.spin_error = NAN};
}

/* ---- the energy balance ------------------------------------------------------------------------------------------ */

/* Computes w->now.momentum, the momentum of all particles p and of the nodes of the grids nodes[grid_count], and raises
 * w->now.momentum_error to |momentum - initial momentum - impulse| divided by the largest momentum so far.
 * impulse[dim]: impulse of loads and supports since the start [N s]. */
void diagnostics_update_momentum(struct diagnostics *w, const struct particles *p, const struct grid *const *nodes,
                                 int grid_count, const real *impulse)
{
    real size, missing2 = 0;
    particles_linear_momentum(p, nodes, grid_count, w->now.momentum, &size);
    for (int d = 0; d < p->dim; d++) {
        if (!w->started) w->momentum_start[d] = w->now.momentum[d] - impulse[d];
        missing2 += square(w->now.momentum[d] - w->momentum_start[d] - impulse[d]);
    }
    w->momentum_scale = real_max(w->momentum_scale, size);
    if (w->momentum_scale > 0)
        w->now.momentum_error = real_max(w->now.momentum_error, sqrt(missing2) / w->momentum_scale);
}

real diagnostics_relative_energy_balance_error(const struct diagnostics *w)
{
    if (!(w->energy_start > 0)) return NAN;
    return (energy_sum(&w->now.energy) - w->now.energy.damped - w->now.external_work) / w->energy_start - 1;
}

/* Computes the relative error of the energy balance: w->now.balance_error = (energy - initial energy - external
 * work)/(largest energy or work so far); 0 if the denominator is 0. Also updates the largest internal energy so far. */
static void balance_of(struct diagnostics *w)
{
    const real *momentum = w->now.momentum;
    struct energy_balance *l = &w->now;
    real energy = energy_sum(&l->energy);
    if (!w->started) w->energy_start = energy - l->external_work;
    const real size = energy_sum_of_magnitudes(&l->energy);
    const real flight = w->mass > 0 ? 0.5 * dot(momentum, momentum, DIM_MAX) / w->mass : 0;
    w->energy_scale = real_max(w->energy_scale, real_max(size, fabs(l->external_work)));
    w->internal_scale = real_max(w->internal_scale, size - flight);
    l->balance_error = w->energy_scale > 0 ? (energy - w->energy_start - l->external_work) / w->energy_scale : 0;
}

void diagnostics_update_energy_balance(struct diagnostics *w, real t, const struct energy *energy, real work)
{
    w->now.time = t;
    w->now.energy = *energy;
    w->now.external_work = work;
    balance_of(w);
    w->started = true;
}

/* ---- the first break --------------------------------------------------------------------------------------------- */

/* Counts the separate groups of bonds that break in this step: clusters of particles with FLAG_CRACKED, linked over
 * distances up to `horizon` [m]. searched_particles[particle_count]: particles to examine; NULL: particles 0 ..
 * particle_count - 1. Stores the middle of one group in cluster_centre[dim] [m]. Returns the number of groups, 0 if no
 * bond breaks. p: all particles. */
int64_t diagnostics_count_clusters_of_new_bond_breaks(const struct particles *p, const int32_t *searched_particles,
                                                      int64_t particle_count, real horizon, real *cluster_centre)
{
    const real along[DIM_MAX] = {0};
    int64_t cut = 0;
    for (int64_t k = 0; k < particle_count; k++)
        cut += (p->flag[searched_particles ? searched_particles[k] : k] & FLAG_CRACKED) != 0;
    if (cut == 0) return 0;
    struct place *place = NEW("diagnostics.cut", cut, struct place);
    cut = 0;
    for (int64_t k = 0; k < particle_count; k++) {
        const int64_t i = searched_particles ? searched_particles[k] : k;
        if (p->flag[i] & FLAG_CRACKED) particle_reference_position(p, i, place[cut++].X);
    }
    const int64_t ends = position_clusters_count_and_find_foremost_centre(place, cut, p->dim, horizon * (1 + 1e-6),
                                                                          along, cluster_centre);
    memory_free(place);
    return ends;
}

/* Returns true if a particle of p with prescribed motion has just lost a bond. Examines all particles without an early
 * exit, so that the loop is compiled to vector instructions. */
static bool driven_breaks(const struct particles *p)
{
    const uint8_t both = FLAG_DRIVEN | FLAG_LOST_BOND;
    uint8_t any = 0;
    for (int64_t i = 0; i < p->n; i++) any |= (p->flag[i] & both) == both;
    return any != 0;
}

bool diagnostics_count_broken_bonds_and_record_first(struct diagnostics *w, const struct particles *p, real horizon,
                                                     int64_t broken_bond_count, real t)
{
    w->bonds_broken += broken_bond_count;
    if (broken_bond_count == 0) return false;
    if (isnan(w->break_time)) {
        w->break_ends = diagnostics_count_clusters_of_new_bond_breaks(p, NULL, p->n, horizon, w->break_position);
        if (w->break_ends > 0) w->break_time = t;
    }
    const bool tears = isnan(w->driven_time) && driven_breaks(p);
    if (tears) w->driven_time = t;
    return tears;
}

/* ---- stability check --------------------------------------------------------------------------------------------- */

/* Returns true if particle i of p has diverged: its position or velocity is not finite, or its speed exceeds `limit`
 * [m/s]. */
static bool diagnostics_particle_diverged(const struct particles *p, int64_t i, real limit)
{
    const int32_t alone[1] = {(int32_t)i};
    return particles_diverged(p, alone, 1, limit);
}

/* Returns FAILED with a message that contains particle i of p, its position, the step, the time t [s] and the cause: a
 * speed above `limit` [m/s], or a value that is not finite. */
static status divergence_report(const struct particles *p, int64_t i, real limit, int64_t step, real t)
{
    real speed2 = 0;
    for (int d = 0; d < p->dim; d++) speed2 += square(p->v[d][i]);
    char what[128];
    if (isfinite(speed2) && speed2 > limit * limit)
        snprintf(what, sizeof what, "moves at %.3g m/s, faster than the wave speed %.4g m/s", sqrt(speed2), limit);
    else
        snprintf(what, sizeof what, "has a position or velocity that is not a finite number (nan or inf)");
    return status_set(FAILED, "unstable at step %lld, t = %.3g s: particle %d at (%s) m %s", (long long)step, t,
                      (int)p->id[i], particle_position_text(p, i, 6).text, what);
}

/* Returns the first of the particles list[n] (indices in p) that has diverged, or p->n_all if none has. limit: largest
 * speed that a stable particle can have [m/s]. */
static int64_t first_diverged(const struct particles *p, const int32_t *list, int64_t n, real limit)
{
    if (!particles_diverged(p, list, n, limit)) return p->n_all;
    int64_t k = 0;
    while (!diagnostics_particle_diverged(p, list[k], limit)) k++;
    return list[k];
}

status diagnostics_check_particles_for_divergence(const struct particles *p, bool check_peridynamic,
                                                  bool check_mesh_points, real max_speed, int64_t step, real t)
{
    INVARIANT(max_speed > 0);
    int64_t first = check_peridynamic ? first_diverged(p, p->list[KIND_PD], p->n_of[KIND_PD], max_speed) : p->n_all;
    const int64_t free = check_mesh_points ? first_diverged(p, p->list[KIND_MPM], p->n_of[KIND_MPM], max_speed)
                                           : first_diverged(p, p->list_free, p->n_free, max_speed);
    if (free < first) first = free;
    return first < p->n ? divergence_report(p, first, max_speed, step, t) : OK;
}

status diagnostics_save_or_load(struct diagnostics *w, struct archive *a)
{
    ARCHIVE_VALUE(a, "diagnostics/now", w->now);
    ARCHIVE_VALUE(a, "diagnostics/energy_start", w->energy_start);
    ARCHIVE_VALUE(a, "diagnostics/energy_scale", w->energy_scale);
    ARCHIVE_VALUE(a, "diagnostics/internal_scale", w->internal_scale);
    ARCHIVE_VALUE(a, "diagnostics/momentum_start", w->momentum_start);
    ARCHIVE_VALUE(a, "diagnostics/momentum_scale", w->momentum_scale);
    ARCHIVE_VALUE(a, "diagnostics/spin_start", w->spin_start);
    ARCHIVE_VALUE(a, "diagnostics/spin_scale", w->spin_scale);
    ARCHIVE_VALUE(a, "diagnostics/turns", w->turns);
    ARCHIVE_VALUE(a, "diagnostics/started", w->started);
    ARCHIVE_VALUE(a, "diagnostics/break_time", w->break_time);
    ARCHIVE_VALUE(a, "diagnostics/break_place", w->break_position);
    ARCHIVE_VALUE(a, "diagnostics/break_ends", w->break_ends);
    ARCHIVE_VALUE(a, "diagnostics/driven_time", w->driven_time);
    ARCHIVE_VALUE(a, "diagnostics/bonds_broken", w->bonds_broken);
    return OK;
}

/* Kinetic energy below which all energies are round-off, divided by the kinetic energy of the body moving at the wave
 * speed [1]. */
#define ENERGY_OF_ROUND_OFF 1e-24

bool diagnostics_energy_is_round_off(const struct diagnostics *w, real mass, real wave_speed)
{
    return w->energy_scale < ENERGY_OF_ROUND_OFF * 0.5 * mass * square(wave_speed);
}

real diagnostics_excess_energy_released_by_bonds(const struct diagnostics *w)
{
    return real_max(0, -w->now.energy.fracture);
}
