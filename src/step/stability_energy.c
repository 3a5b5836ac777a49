/* Finds runs that are unstable although no particle is faster than waves, by their energy; warns of large strains. */
#include <math.h>
#include <stdio.h>

#include "kernels/mpm/stress.h"
#include "probes/diagnostics.h"
#include "run/say.h"
#include "step/checks.h"
#include "step/report.h"
#include "step/stability.h"

#define ENERGY_STEPS 50 /* steps before the energy check begins */
/* Smallest ratio of the energy gained without a source to the largest energy at which a run fails [1]. Empirical: the
 * first steps after a jump in velocity show 0.1, unstable runs that break all bonds 0.9. */
#define ENERGY_FROM_NOWHERE 0.5
/* Smallest ratio of the energy that breaking bonds release beyond what they had stored to the largest energy at which a
 * run fails [1]. Empirical: scenes in inputs/ show none with any model; ospd under pressure shows 0.4. */
#define RELEASED_FROM_NOWHERE 0.25
/* Ratio of kinetic energy 1/2 m v- . v+ to strain energy below which velocities change sign in every step [1]; v-, v+:
 * velocities before and after a velocity update. Time steps below the critical step have at least
 * -(dt/dt_critical)^2. */
#define KINETIC_LEAST -0.9

/* Returns the index of the particle with the largest speed. p: all particles. */
static int64_t fastest_particle(const struct particles *p)
{
    int64_t fastest = 0;
    real most = -1;
    for (int64_t i = 0; i < p->n; i++) {
        real speed2 = 0;
        for (int d = 0; d < p->dim; d++) speed2 += square(p->v[d][i]);
        if (speed2 > most) most = speed2, fastest = i;
    }
    return fastest;
}

/* Returns true if the bodies have gained more energy than a stable run can: the error of the energy balance w of the
 * run exceeds ENERGY_FROM_NOWHERE, or breaking bonds released more than RELEASED_FROM_NOWHERE of the largest energy
 * beyond what they had stored. The error is not tested in the first ENERGY_STEPS steps, in which half a step of a load
 * is a large share of the energy, unless the time step of `clock` is above the critical one. */
static bool gains(const struct run_clock *clock, const struct diagnostics *diagnostics)
{
    const bool counts = clock->step >= ENERGY_STEPS || clock->dt > clock->dt_critical;
    return (counts && diagnostics->now.balance_error > ENERGY_FROM_NOWHERE) ||
           diagnostics_excess_energy_released_by_bonds(diagnostics) > RELEASED_FROM_NOWHERE * diagnostics->energy_scale;
}

/* Returns true if the time step of `clock` is above the critical one and velocities change sign in every step: kinetic
 * `energy` < KINETIC_LEAST times strain energy. */
static bool swings(const struct run_clock *clock, const struct energy *energy)
{
    return clock->dt > clock->dt_critical && energy->kinetic < KINETIC_LEAST * energy->strain;
}

/* Returns FAILED, with the message that the run is unstable, step and time of `clock`, and the position of the fastest
 * particle of p. what: text after "the fastest one of a body", such as "whose velocities change sign in every step";
 * remedy: advice at the end of the message. */
static status unstable(const struct particles *p, const struct run_clock *clock, const char *what, const char *remedy)
{
    const int64_t i = fastest_particle(p);
    return status_set(
        FAILED, "unstable at step %lld, t = %.3g s: particle %d at (%s) m is the fastest particle of a body %s; %s",
        (long long)clock->step, clock->t, (int)p->id[i], particle_position_text(p, i, 6).text, what, remedy);
}

/* Elastic strain [1] of points on the grid above which a warning is printed. A strip under tension tears or gains
 * energy at strains above 0.09 with every shape function and transfer (tests/scenes/test_frame.sh). */
#define STRETCH_MOST 0.08

/* Warns that a point on the grid has a strain beyond STRETCH_MOST, with a remedy that the scene s allows. strain:
 * strain of the point [1]; t: time [s]; x: position of the point [m], as text; to: list of warnings. */
static void warn_of_stretched(const struct scene *s, real strain, real t, const char *x, struct warnings *to)
{
    char text[560], remedy[200] = "use mpm.frame: reference";
    const char *why = scene_reason_not_to_advise_total_lagrangian_mpm(s);
    if (why)
        snprintf(remedy, sizeof remedy,
                 "use method: pd, or smaller loads and speeds (mpm.frame: reference is no remedy: %s)", why);
    snprintf(text, sizeof text,
             "points in mpm.frame: current are stretched by %.0f %% at t = %.3g s, near (%s) m: beyond about 10 %% "
             "they separate (mpm.transfer: apic) or gain energy (flip), with any mpm.shape; %s; if this is intended, "
             "add accept: [strain]",
             100 * strain, t, x, remedy);
    warnings_add_and_print(to, text);
}

/* Warns of the first elastic point of p on the grid with a strain (largest principal stress divided by Young's modulus)
 * above STRETCH_MOST, unless the scene s silences this warning. t: present time [s]; to: list of warnings. Returns true
 * if there is such a point. */
static bool say_stretched(const struct particles *p, const struct scene *s, real t, struct warnings *to)
{
    const int n = symmetric_tensor_component_count(p->dim);
    for (int64_t i = 0; i < p->n && p->n_free > 0 && !scene_silences_warning(s, ACCEPT_STRAIN); i++) {
        const struct material *m = &s->material[p->material[i]];
        real stress[SYM_MAX], x[DIM_MAX], sum = 0;
        if (p->kind[i] != KIND_MPM || p->flag[i] & FLAG_MESHED || material_yields(m)) continue;
        for (int c = 0; c < n; c++) stress[c] = p->stress[c][i], sum += square(stress[c]);
        /* cheap bound: the sum is at least half the squared principal stress */
        if (2 * sum < square(STRETCH_MOST * m->young)) continue;
        const real strain = stress_largest_principal(stress, p->dim) / m->young;
        if (!(strain > STRETCH_MOST)) continue;
        for (int d = 0; d < p->dim; d++) x[d] = p->x[d][i];
        warn_of_stretched(s, strain, t, position_text(x, p->dim, 4).text, to);
        return true;
    }
    return false;
}

/* Equivalent plastic strain of points of a mesh above which a warning is printed [1]. Elastic and plastic strains add
 * up to the strain of the rotated cell (stretch less 1), which differs from the logarithm of the stretch by about half
 * its square. */
#define FLOW_MOST 0.05

/* Warns of the first point of p in a mesh with a plastic strain above FLOW_MOST. t: present time [s]; to: list of
 * warnings. Returns true if there is such a point. */
static bool say_flowed(const struct particles *p, real t, struct warnings *to)
{
    char text[300];
    for (int64_t i = 0; i < p->n && p->mesh_stress[0]; i++) {
        if (!(p->plastic_strain[i] > FLOW_MOST) || !(p->flag[i] & FLAG_MESHED)) continue;
        snprintf(text, sizeof text,
                 "points in mpm.frame: reference have a plastic strain of %.2g at t = %.3g s, near (%s) m: this "
                 "frame adds strains up, so shear beyond 0.04 causes a false tension; use mpm.frame: current",
                 p->plastic_strain[i], t, particle_position_text(p, i, 4).text);
        warnings_add_and_print(to, text);
        return true;
    }
    return false;
}

/* Equivalent plastic strain of points on the grid with a back stress above which a warning is printed [1]. It belongs
 * to a shear g of 0.9, at which the back stress of Prager's law by Jaumann's rate, (C/3) sin g, is 12 % below C g/3
 * (Nagtegaal & de Jong 1981; C: kinematic modulus). */
#define TURNED_MOST 0.5

/* Warns, in 2D and 3D, of the first point of p on the grid whose back stress may oscillate: one with kinematic
 * hardening and a plastic strain above TURNED_MOST. t: present time [s]; to: list of warnings. Returns true if there is
 * such a point. */
static bool say_turned(const struct particles *p, const struct scene *s, real t, struct warnings *to)
{
    char text[360];
    for (int64_t i = 0; i < p->n && p->back_stress[0] && p->dim > 1; i++) {
        if (!(p->plastic_strain[i] > TURNED_MOST) || p->flag[i] & FLAG_MESHED) continue;
        if (!(s->material[p->material[i]].law.kinematic.modulus > 0)) continue;
        snprintf(text, sizeof text,
                 "points with kinematic hardening have a plastic strain of %.2g at t = %.3g s, near (%s) m: beyond a "
                 "shear of about 1 their back stress oscillates (Jaumann's rate), and they carry too little; use "
                 "isotropic hardening, which does not oscillate",
                 p->plastic_strain[i], t, particle_position_text(p, i, 4).text);
        warnings_add_and_print(to, text);
        return true;
    }
    return false;
}

/* Returns FAILED, with a message and a remedy, if the energy shows that the run is unstable although no particle is
 * faster than waves: a body that gains energy, e.g. by breaking all its bonds, or whose velocities change sign in every
 * step; also if an energy is not finite. Warns of large strains, of parted material points and of large motions. Tested
 * at samples and at the end. Bodies whose energy is round-off are not tested. */
status run_check_last_sample_for_energy_divergence(struct run *run)
{
    if (run->stability->lost)
        return status_set(FAILED,
                          "step %lld, t = %.4g s: an energy is not finite, but all positions are: check material, "
                          "supports and initial state (`cleave check`)",
                          (long long)run->clock.step, run->clock.t);
    const struct diagnostics *diagnostics = run->diagnostics;
    const real excess = diagnostics->now.balance_error * diagnostics->energy_scale +
                        diagnostics_excess_energy_released_by_bonds(diagnostics);
    const bool last = run->clock.step == run->clock.steps && !scene_is_single_equilibrium(run->scene);
    char what[96], remedy[REMEDY_LENGTH];
    if (!run->report->sampling.due && !last) return OK;
    quantity_samples_add_value(&run->stability->excess, run->clock.step, excess);
    if (!run->stability->stretched)
        run->stability->stretched =
            say_stretched(&run->part, run->scene, run->clock.t, &run->warnings) ||
            (scene_is_dynamic(run->scene) && say_flowed(&run->part, run->clock.t, &run->warnings)) ||
            say_turned(&run->part, run->scene, run->clock.t, &run->warnings);
    if (!run->stability->parted)
        run->stability->parted = material_points_warn_of_numerical_fracture(
            &run->stability->pairs, &run->part, &run->cells, run->grid, run->scene, run->clock.t, &run->warnings);
    large_motion_warn_of_self_penetration(&run->stability->motion, &run->part, run->scene, run->source.family.horizon,
                                          run->clock.t, &run->warnings);
    if (scene_is_dynamic(run->scene))
        large_motion_warn_of_non_follower_pressure(&run->stability->motion, &run->part, &run->loads, run->clock.t,
                                                   &run->warnings);
    if (diagnostics_energy_is_round_off(diagnostics, run->mass, run->tables.wave_speed)) return OK;
    if (!run->stability->released)
        run->stability->released = fracture_energy_warn_if_negative(run->scene, diagnostics, &run->warnings);
    if (swings(&run->clock, &diagnostics->now.energy)) {
        run_describe_smaller_time_step(run->scene, &run->clock, remedy, sizeof remedy);
        return unstable(&run->part, &run->clock, "whose velocities change sign in every step", remedy);
    }
    if (!gains(&run->clock, diagnostics)) return OK;
    snprintf(what, sizeof what, "with %.0f %% of its energy gained without work of loads",
             100 * excess / diagnostics->energy_scale);
    run_describe_remedy_for_divergence(run, &run->stability->excess, excess, remedy, sizeof remedy);
    return unstable(&run->part, &run->clock, what, remedy);
}
