/* Computes the balances of energy and momentum, records where bonds break first, and checks for diverged particles. */
#include "probes/diagnostics.h"

#include <math.h>
#include <stdio.h>

#include "kernels/kernels.h"
#include "base/memory.h"
#include "fracture/places.h"
#include "kernels/mpm/stress.h"
#include "base/team.h"

void diagnostics_initialise(struct diagnostics *diagnostics)
{
    *diagnostics = (struct diagnostics){
        .break_time = NAN, .break_position = {NAN, NAN, NAN}, .driven_time = NAN, .now.spin_error = NAN};
}

/* ---- the energy balance ------------------------------------------------------------------------------------------ */

/* Computes diagnostics->now.momentum, the momentum of all particles p and of the nodes of the grids nodes[grid_count],
 * and raises diagnostics->now.momentum_error to |momentum - initial momentum - impulse| divided by the largest momentum
 * so far. impulse[dim]: impulse of loads and supports since the start [N s]. */
void diagnostics_update_momentum(struct diagnostics *diagnostics, const struct particles *p,
                                 const struct grid *const *nodes, int grid_count, const real *impulse)
{
    real size, missing2 = 0;
    particles_linear_momentum(p, nodes, grid_count, diagnostics->now.momentum, &size);
    for (int d = 0; d < p->dim; d++) {
        if (!diagnostics->started) diagnostics->momentum_start[d] = diagnostics->now.momentum[d] - impulse[d];
        missing2 += square(diagnostics->now.momentum[d] - diagnostics->momentum_start[d] - impulse[d]);
    }
    diagnostics->momentum_scale = real_max(diagnostics->momentum_scale, size);
    if (diagnostics->momentum_scale > 0)
        diagnostics->now.momentum_error =
            real_max(diagnostics->now.momentum_error, sqrt(missing2) / diagnostics->momentum_scale);
}

real diagnostics_relative_energy_balance_error(const struct diagnostics *diagnostics)
{
    if (!(diagnostics->energy_start > 0)) return NAN;
    return (energy_sum(&diagnostics->now.energy) - diagnostics->now.energy.damped - diagnostics->now.external_work) /
               diagnostics->energy_start -
           1;
}

/* Computes the relative error of the energy balance: diagnostics->now.balance_error = (energy - initial energy -
 * external work)/(largest energy or work so far); 0 if the denominator is 0. Also updates the largest internal energy
 * so far. */
static void balance_of(struct diagnostics *diagnostics)
{
    const real *momentum = diagnostics->now.momentum;
    struct energy_balance *l = &diagnostics->now;
    real energy = energy_sum(&l->energy);
    if (!diagnostics->started) diagnostics->energy_start = energy - l->external_work;
    const real size = energy_sum_of_magnitudes(&l->energy);
    const real flight = diagnostics->mass > 0 ? 0.5 * dot(momentum, momentum, DIM_MAX) / diagnostics->mass : 0;
    diagnostics->energy_scale = real_max(diagnostics->energy_scale, real_max(size, fabs(l->external_work)));
    diagnostics->internal_scale = real_max(diagnostics->internal_scale, size - flight);
    l->balance_error = diagnostics->energy_scale > 0
                           ? (energy - diagnostics->energy_start - l->external_work) / diagnostics->energy_scale
                           : 0;
}

void diagnostics_update_energy_balance(struct diagnostics *diagnostics, real t, const struct energy *energy, real work)
{
    diagnostics->now.time = t;
    diagnostics->now.energy = *energy;
    diagnostics->now.external_work = work;
    balance_of(diagnostics);
    diagnostics->started = true;
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
    const int64_t ends = position_clusters_count_and_centre_at_largest_x(place, cut, p->dim, horizon * (1 + 1e-6),
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

bool diagnostics_count_broken_bonds_and_record_first(struct diagnostics *diagnostics, const struct particles *p,
                                                     real horizon, int64_t broken_bond_count, real t)
{
    diagnostics->bonds_broken += broken_bond_count;
    if (broken_bond_count == 0) return false;
    if (isnan(diagnostics->break_time)) {
        diagnostics->break_ends =
            diagnostics_count_clusters_of_new_bond_breaks(p, NULL, p->n, horizon, diagnostics->break_position);
        if (diagnostics->break_ends > 0) diagnostics->break_time = t;
    }
    const bool tears = isnan(diagnostics->driven_time) && driven_breaks(p);
    if (tears) diagnostics->driven_time = t;
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

status diagnostics_save_or_load(struct diagnostics *diagnostics, struct archive *a)
{
    ARCHIVE_VALUE(a, "diagnostics/now", diagnostics->now);
    ARCHIVE_VALUE(a, "diagnostics/energy_start", diagnostics->energy_start);
    ARCHIVE_VALUE(a, "diagnostics/energy_scale", diagnostics->energy_scale);
    ARCHIVE_VALUE(a, "diagnostics/internal_scale", diagnostics->internal_scale);
    ARCHIVE_VALUE(a, "diagnostics/momentum_start", diagnostics->momentum_start);
    ARCHIVE_VALUE(a, "diagnostics/momentum_scale", diagnostics->momentum_scale);
    ARCHIVE_VALUE(a, "diagnostics/spin_start", diagnostics->spin_start);
    ARCHIVE_VALUE(a, "diagnostics/spin_scale", diagnostics->spin_scale);
    ARCHIVE_VALUE(a, "diagnostics/turns", diagnostics->turns);
    ARCHIVE_VALUE(a, "diagnostics/started", diagnostics->started);
    ARCHIVE_VALUE(a, "diagnostics/break_time", diagnostics->break_time);
    ARCHIVE_VALUE(a, "diagnostics/break_place", diagnostics->break_position);
    ARCHIVE_VALUE(a, "diagnostics/break_ends", diagnostics->break_ends);
    ARCHIVE_VALUE(a, "diagnostics/driven_time", diagnostics->driven_time);
    ARCHIVE_VALUE(a, "diagnostics/bonds_broken", diagnostics->bonds_broken);
    return OK;
}

/* Kinetic energy below which all energies are round-off, divided by the kinetic energy of the body moving at the wave
 * speed [1]. */
#define ENERGY_OF_ROUND_OFF 1e-24

bool diagnostics_energies_are_only_round_off(const struct diagnostics *diagnostics, real mass, real wave_speed)
{
    return diagnostics->energy_scale < ENERGY_OF_ROUND_OFF * 0.5 * mass * square(wave_speed);
}

real diagnostics_bond_energy_release_beyond_stored(const struct diagnostics *diagnostics)
{
    return real_max(0, -diagnostics->now.energy.fracture);
}
