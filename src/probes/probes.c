/* Updates probes in every step, and computes the values that they add to a sample of history.csv. */
#include "probes/probes.h"

#include <math.h>

#include "base/memory.h"
#include "probes/diagnostics.h"
#include "probes_parts.h"

/* ---- every step -------------------------------------------------------------------------------------------------- */

/* Counts the separate groups of bonds of the run o that break in this step in the region of the probe of kind BREAK
 * (first bond break). If there are any, also stores time, load step and position as those of the first break; must not
 * be called after the first break. Bonds of particles with prescribed motion do not count. */
static void step_break(struct probe *probe, const struct observed_run *o)
{
    probe->memory.ends = diagnostics_count_clusters_of_new_bond_breaks(o->part, probe->list, probe->n, o->horizon,
                                                                       probe->memory.position);
    if (probe->memory.ends == 0) return; /* bonds of driven particles do not count */
    probe->memory.first_time = o->t;
    probe->memory.first_step = o->load_step;
}

/* Updates the memory of the probe of kind REACTION (force on a support) from the run o: the largest reaction force,
 * with its step and displacement, and the sum of squared forces over all steps. */
static void step_reaction(struct probe *probe, const struct observed_run *o)
{
    const int dim = o->part->dim;
    real force[DIM_MAX], displacement[DIM_MAX], square_sum;
    probe_compute_reaction_of_supports(probe, o->loads, dim, force, displacement);
    square_sum = dot(force, force, dim);
    if (sqrt(square_sum) > probe->memory.force_max)
        probe->memory.force_max = sqrt(square_sum), probe->memory.force_max_step = o->load_step,
        probe->memory.force_max_displacement = sqrt(dot(displacement, displacement, dim));
    probe->memory.force_square += square_sum;
    probe->memory.steps++;
}

/* Returns true if any particle of p has lost a bond in this step. */
static bool any_cut(const struct particles *p)
{
    uint8_t any = 0;
    for (int64_t i = 0; i < p->n; i++) any |= p->flag[i];
    return any & FLAG_LOST_BOND;
}

void probes_update_break_and_spall_probes(struct probes *probes, const struct observed_run *o)
{
    bool waits_for_break = false;
    for (int k = 0; k < probes->n; k++) {
        struct probe *probe = &probes->probe[k];
        if (probe->request.kind == PROBE_BREAK || probe->request.kind == PROBE_SPALL)
            waits_for_break = waits_for_break || isnan(probe->memory.first_time);
    }
    if (!waits_for_break || !any_cut(o->part)) return;
    for (int k = 0; k < probes->n; k++) {
        struct probe *probe = &probes->probe[k];
        if (!isnan(probe->memory.first_time)) continue;
        if (probe->request.kind == PROBE_BREAK) step_break(probe, o);
        if (probe->request.kind == PROBE_SPALL) spall_probe_detect_separation(probe, o);
    }
}

void probes_update_break_spall_and_reaction_probes(struct probes *probes, const struct observed_run *o)
{
    for (int k = 0; k < probes->n; k++)
        if (probes->probe[k].request.kind == PROBE_REACTION && !probes->probe[k].of_history)
            step_reaction(&probes->probe[k], o);
    probes_update_break_and_spall_probes(probes, o);
}

/* ---- every sample ------------------------------------------------------------------------------------------------ */

/* Stores in value[0 .. dim - 1] the position of the crack tip of the run o that the probe (kind TIP) follows [m], and
 * in value[dim] how far the crack has grown there [m]. Without a tip the position is NAN and the growth 0. */
static void sample_tip(const struct probe *probe, const struct observed_run *o, real *value)
{
    const struct crack_tip *tip = probe_find_followed_crack_tip(probe, o->tips);
    int dim = o->part->dim;
    for (int d = 0; d < dim; d++) value[d] = tip ? tip->place[d] : NAN;
    value[dim] = tip ? tip->growth : 0;
}

void probes_sample_energies(struct probes *probes, const struct observed_run *o)
{
    for (int k = 0; k < probes->n; k++) {
        const struct probe *probe = &probes->probe[k];
        real *value = probes->value + probe->first;
        if (probe->request.kind != PROBE_ENERGY) continue;
        const struct energies e = probe_compute_energies_of_particles(probe, o);
        value[0] = e.kinetic, value[1] = e.strain, value[2] = e.fracture;
    }
}

void probes_sample_position_dependent_values(struct probes *probes, const struct observed_run *o)
{
    const int dim = o->part->dim;
    real no_displacement[DIM_MAX];
    probes->sampled = o->t;
    for (int k = 0; k < probes->n; k++) {
        struct probe *probe = &probes->probe[k];
        real *value = probes->value + probe->first;
        switch (probe->request.kind) {
        case PROBE_TIP:
            sample_tip(probe, o, value);
            break;
        case PROBE_REACTION:
            probe_compute_reaction_of_supports(probe, o->loads, dim, value,
                                               probe->rests ? no_displacement : value + dim);
            break;
        case PROBE_POINT:
            particle_compute_probe_values(o, probe->list[0], value);
            break;
        case PROBE_MOMENTUM:
            probe_compute_momentum_of_particles(probe, o->part, value);
            break;
        case PROBE_EXACT:
            bar_probe_compute_values(probe->bar, o, value);
            break;
        case PROBE_GROWTH:
            growing_crack_compute_probe_values(&o->growth[probe->growth], value);
            break;
        case PROBE_RIGID:
            rigid_probe_compute_rotation_angle_and_stresses(probe, o, value);
            break;
        default:
            break;
        }
    }
}

/* Returns true if the values of the probe (a requested measurement) depend on velocities. Leap-frog provides velocities
 * half a step before and after a sample only, so that the sample interpolates them. */
static bool has_motion(const struct probe *probe)
{
    const enum probe_kind kind = probe->request.kind;
    return kind == PROBE_POINT || kind == PROBE_ENERGY || kind == PROBE_MOMENTUM || kind == PROBE_RIGID;
}

void probes_store_motion_before_step(struct probes *probes, const struct observed_run *o)
{
    for (int k = 0; k < probes->n; k++) {
        if (probes->probe[k].request.kind == PROBE_SIF) sif_probe_store_motion_before_step(&probes->probe[k], o);
        if (has_motion(&probes->probe[k])) probe_motion_store_before_step(&probes->probe[k], o);
    }
}

/* Computes K_I and K_II [Pa m^0.5], J [J/m^2] and the relative difference of J between contours for the probe of
 * kind SIF (stress-intensity factors) of the run o, and stores them in value[SIF_FIGURES] in this order; NAN for those
 * that are not meaningful. t_velocity: time of the current velocities [s]. */
static void sample_sif(struct probe *probe, const struct observed_run *o, real t_velocity, real *value)
{
    sif_probe_compute_intensity_factors(probe, o, t_velocity);
    for (int f = 0; f < SIF_FIGURES; f++) value[f] = sif_probe_last_sample_value_or_nan(probe, f);
}

/* Stores in value[dim] the reaction force [N] of the boundary of the probe of kind REACTION (force on a support), as
 * computed in the last step of the run o. */
static void sample_force(const struct probe *probe, const struct observed_run *o, real *value)
{
    real displacement[DIM_MAX];
    probe_compute_reaction_of_supports(probe, o->loads, o->part->dim, value, displacement);
}

/* Stores in value[dim .. 2 dim - 1] the velocity [m/s] of the particle of the probe of kind POINT (one particle) at the
 * time of the sample. p: all particles. */
static void sample_velocity(const struct probe *probe, const struct particles *p, real *value)
{
    for (int d = 0; d < p->dim; d++) value[p->dim + d] = probe_particle_velocity_component(probe, p, d, 0);
}

void probes_sample_velocity_dependent_values(struct probes *probes, const struct observed_run *o,
                                             const struct velocity_time *now)
{
    for (int k = 0; k < probes->n; k++) {
        struct probe *probe = &probes->probe[k];
        real *value = probes->value + probe->first;
        if (has_motion(probe)) probe_motion_interpolate_to_sample_time(probe, o, now);
        switch (probe->request.kind) {
        case PROBE_SIF:
            sample_sif(probe, o, now->t, value);
            break;
        case PROBE_REACTION:
            sample_force(probe, o, value);
            break;
        case PROBE_POINT:
            sample_velocity(probe, o->part, value);
            break;
        case PROBE_ENERGY:
            value[0] = probe_kinetic_energy(probe, o->part);
            break;
        case PROBE_MOMENTUM:
            probe_compute_momentum_of_particles(probe, o->part, value);
            break;
        case PROBE_RIGID:
            rigid_probe_compute_conservation_errors(probe, o->part, value);
            break;
        default:
            break;
        }
        probe_motion_discard_interpolation(probe);
    }
}

/* ---- restart ----------------------------------------------------------------------------------------------------- */

/* Saves the state of all probes (their memories and the values of the last sample) to the archive a if a->saving,
 * else restores it. Returns FAILED or REFUSED, with a message, if reading or writing the archive does. */
status probes_save_or_load(struct probes *probes, struct archive *a)
{
    if (probes->n == 0) return OK;
    struct probe_memory *memory = NEW("probes.memory", probes->n, struct probe_memory);
    for (int k = 0; k < probes->n; k++) memory[k] = probes->probe[k].memory;
    status fault = a->exchange(a, "probes/memory", memory, (size_t)probes->n * sizeof *memory);
    for (int k = 0; fault == OK && k < probes->n; k++) probes->probe[k].memory = memory[k];
    memory_free(memory);
    TRY(fault);
    if (probes->columns > 0)
        TRY(a->exchange(a, "probes/value", probes->value, (size_t)probes->columns * sizeof *probes->value));
    ARCHIVE_VALUE(a, "probes/sampled", probes->sampled);
    return OK;
}
