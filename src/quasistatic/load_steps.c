/* Controls the loads through a sequence of equilibrium states (load steps), with crack increments (crack_increment.c)
 * between these states. */
#include <math.h>
#include <stdio.h>

#include "crack_increment.h"
#include "balance.h"
#include "flow_turn.h"
#include "sif_cracks.h"
#include "load_size.h"
#include "opening.h"
#include "unconstrained.h"
#include "softening_step.h"
#include "springs.h"
#include "steps_record.h"
#include "system.h"
#include "contact_set.h"
#include "trial.h"

#include "contact/contact.h"
#include "fracture/sif_fields.h"
#include "mesh/mesh_part.h"
#include "probes/diagnostics.h"
#include "quasistatic/load_steps.h"
#include "run/say.h"
#include "step/report.h"
#include "step/sample.h"
#include "step/step.h"

#define FAR_BEYOND 1.2  /* stretch ratio above which an equilibrium is discarded for one at smaller loads */
#define NEAR_LIMIT 0.95 /* stretch ratio of the equilibrium that replaces it */
#define NEAR_LEAST 0.85 /* stretch ratio above which the loads are close enough to the next increment */
#define ROUND_OFF 1e-6  /* relative difference of equal loads */
#define SLID_LEAST 0.01 /* see warn_of_sliding: a judgement; faces of particles that touch at their edges may part */
#define THROUGH 1e-2    /* share of the largest load size at which the body counts as severed */
enum { APPROACHES_MOST = 12 }; /* largest number of loads that are tried before a crack increment */

/* ---- control ----------------------------------------------------------------------------------------------------- */

/* Returns the load size (norm of prescribed displacements [m] or of applied forces [N]) at which the next crack
 * increment is made if loads can only grow. For the first increment (no bond of diagnostics->bonds_broken yet) it is
 * s->due, the load size at which the pre-crack is in balance with the loads. For a later one it is the larger of
 * s->due and the load size at which the body releases the energy that this increment alone costs; loads then oscillate
 * about those of a crack that grows continuously. */
static real increment_load(const struct statics *s, const struct diagnostics *diagnostics)
{
    return diagnostics->bonds_broken > 0 ? real_max(s->due, crack_increment_load_size_at_energy_balance(&s->ahead))
                                         : s->due;
}

/* Updates the probes and the largest forces on rigid bodies of the run for the present equilibrium. Call for states
 * that the loads have reached, not for trials. */
static void state_sample(struct run *run)
{
    run_update_break_and_reaction_probes(run);
    rigid_bodies_update_largest_contact_forces(run->rigid, run->scene->rigids);
}

/* Finds the equilibrium of the run at the load size `size` (norm of prescribed displacements [m] or of applied forces
 * [N]). The corresponding pseudo-time is limited to the range least .. most [s]. Returns FAILED, with a message, if
 * there is no equilibrium. */
static status go_to_size(struct run *run, real size, real least, real most)
{
    return equilibrium_find_at_time(run,
                                    real_min(real_max(statics_find_pseudo_time_at_load_size(run, size), least), most));
}

/* Finds the equilibrium of the run at pseudo-time t [s], then determines the next crack increment. If the largest
 * stretch ratio (stretch divided by critical stretch) at t exceeds FAR_BEYOND, uses an earlier pseudo-time at which it
 * is about NEAR_LIMIT, because the body would have broken before t: at t, bonds would yield that otherwise do not, and
 * large energies would hide the energy that an increment releases. Returns FAILED, with a message, if an equilibrium is
 * not found. */
static status approach_loads(struct run *run, real t)
{
    struct statics *s = run->statics;
    const real from = s->t, low = statics_norm_of_prescribed_loads(run, from), at_low = s->stretch_ratio;
    bool far = true;
    for (int k = 0; k < APPROACHES_MOST && far; k++) {
        struct memory_archive saved;
        trial_equilibrium_begin(run, &saved);
        const status gone = equilibrium_find_at_time(run, t);
        far = gone == OK && s->stretch_ratio > FAR_BEYOND && at_low < NEAR_LEAST;
        if (far) {
            const real share = (NEAR_LIMIT - at_low) / (s->stretch_ratio - at_low);
            t = real_max(from, statics_find_pseudo_time_at_load_size(
                                   run, low + share * (statics_norm_of_prescribed_loads(run, t) - low)));
        }
        trial_equilibrium_end(run, &saved, !far, NULL);
        TRY(gone);
    }
    if (far) TRY(equilibrium_find_at_time(run, t));
    TRY(equilibrium_convert_points_to_pd_and_solve_again(run, 0));
    return crack_increment_find_by_trial_equilibria(run);
}

/* Makes the next crack increment of the run while loads can only grow, and determines the increment after it. The load
 * size (norm of prescribed displacements [m] or of applied forces [N]) of the increment is the larger of
 * increment_load and *size, the load size of the previous increment; *size receives it. Updates the probes and the
 * largest forces on the rigid bodies there. from, t: range of the pseudo-time [s]. Returns FAILED, with a message, if
 * an equilibrium is not found. */
static status increment_under_loads(struct run *run, real *size, real from, real t)
{
    struct statics *s = run->statics;
    const bool follows = increment_load(run->statics, run->diagnostics) <= *size;
    *size = real_max(*size, increment_load(run->statics, run->diagnostics));
    const real loads = statics_norm_of_prescribed_loads(run, t);
    const bool pays = crack_increment_load_size_at_energy_balance(&s->ahead) <= *size, within = *size < loads;
    if (within)
        TRY(go_to_size(run, *size, from, t));
    else if (s->t < t && loads >= *size * (1 - ROUND_OFF))
        TRY(equilibrium_find_at_time(run, t));
    state_sample(run);
    if (follows && run->scene->steps.then == THEN_EXPLICIT)
        TRY(crack_increment_apply_by_dynamic_release(run));
    else
        TRY(pays ? crack_increment_find_new_equilibrium(run, crack_increment_break_bonds_and_move_tips(run))
                 : crack_increment_apply_at_energy_balance(run));
    if (!pays) TRY(within ? go_to_size(run, *size, from, t) : equilibrium_find_at_time(run, t));
    return crack_increment_find_by_trial_equilibria(run);
}

/* Makes a load step of the run under load control: increases the loads to those of pseudo-time t [s], and makes all
 * crack increments whose load sizes are smaller. The pseudo-time never decreases. Returns FAILED, with a message, if
 * an equilibrium is not found. */
static status step_by_load(struct run *run, real t)
{
    struct statics *s = run->statics;
    const real from = s->t, loads = statics_norm_of_prescribed_loads(run, t);
    real size = statics_norm_of_prescribed_loads(run, from);
    for (;;) {
        const bool due = s->next.n > 0 && increment_load(run->statics, run->diagnostics) <=
                                              real_max(loads, s->t >= t ? 0 : size) * (1 + 1e-9);
        if (due)
            TRY(increment_under_loads(run, &size, from, t));
        else if (s->t < t)
            TRY(approach_loads(run, t));
        else
            return OK;
    }
}

/* Makes a load step of the run under energy control, where loads may fall: makes one crack increment, then finds the
 * equilibrium at the pseudo-time at which the loads suffice for the next increment. If this is more than `most` [s]
 * from now, the step ends after `most`, without a further increment. Returns FAILED, with a message, if an equilibrium
 * is not found. */
static status step_by_energy(struct run *run, real most)
{
    struct statics *s = run->statics;
    const real t = real_min(s->t + most, run->scene->duration);
    if (s->increment_due) TRY(crack_increment_apply_at_energy_balance(run));
    TRY(crack_increment_find_by_trial_equilibria(run));
    if (s->severs) return OK;
    if (s->next.n == 0) TRY(approach_loads(run, t));
    if (s->severs) return OK;
    s->increment_due = s->next.n > 0 && statics_norm_of_prescribed_loads(run, t) >= s->due;
    if (s->next.n > 0)
        TRY(equilibrium_find_at_time(run, s->increment_due ? statics_find_pseudo_time_at_load_size(run, s->due) : t));
    s->record.load_most = real_max(s->record.load_most, statics_norm_of_prescribed_loads(run, s->t));
    s->severs = s->increment_due && s->due < THROUGH * s->record.load_most;
    return OK;
}

/* Returns true if the load size (norm of prescribed displacements [m] or of applied forces [N]) of the next crack
 * increment is reached before the opening, the change of distance between two gauge particles of p, reaches `wanted`
 * [m]. Assumes that the opening grows in proportion to the loads. s: state of the load steps; size: present load size;
 * due: load size of the increment. */
static bool increment_before_opening(const struct particles *p, const struct statics *s, real size, real due,
                                     real wanted)
{
    const real now = crack_gauge_opening(p, s);
    return s->next.n > 0 && now > 0 && now / size * due < wanted;
}

/* Returns the pseudo-time [s] at which the opening between the gauge particles of p equals `wanted` [m] if it grows in
 * proportion to the pseudo-time from the present state s. Returns `otherwise` [s] while the gauge has not opened. */
static real time_of_opening(const struct particles *p, const struct statics *s, real wanted, real otherwise)
{
    const real now = crack_gauge_opening(p, s);
    return now > 0 ? s->t * wanted / now : otherwise;
}

/* Makes a load step of the run under control of the opening: increases the opening (change of distance between two
 * gauge particles) by one step, and makes all crack increments for which the loads suffice until then. Returns FAILED,
 * with a message, if an equilibrium is not found. */
static status step_by_opening(struct run *run)
{
    const struct scene_steps *s = &run->scene->steps;
    const real wanted = s->opening * (real)(run->clock.step + 1) / (real)s->number;
    const real first = run->statics->t + run->scene->duration / (real)s->number;
    real t = time_of_opening(&run->part, run->statics, wanted, first);
    if (run->statics->next.n == 0 && particles_or_bonds_may_yield(&run->part, &run->bonds)) {
        struct memory_archive saved;
        trial_equilibrium_begin(run, &saved);
        const status found = equilibrium_find_at_crack_opening(run, wanted, t);
        t = run->statics->t;
        trial_equilibrium_end(run, &saved, found != OK, NULL);
        TRY(found);
    }
    if (run->statics->next.n == 0) TRY(approach_loads(run, t));
    for (bool open = false;;) {
        const bool before =
            increment_before_opening(&run->part, run->statics, statics_norm_of_prescribed_loads(run, run->statics->t),
                                     increment_load(run->statics, run->diagnostics), wanted);
        if (open && !before) return OK;
        open = !before;
        if (open) {
            TRY(equilibrium_find_at_crack_opening(run, wanted,
                                                  time_of_opening(&run->part, run->statics, wanted, first)));
            TRY(equilibrium_convert_points_to_pd_and_solve_again(run, 0));
        } else {
            TRY(go_to_size(run, increment_load(run->statics, run->diagnostics), 0, INFINITY));
            state_sample(run);
            TRY(crack_increment_apply_at_energy_balance(run));
        }
        TRY(crack_increment_find_by_trial_equilibria(run));
    }
}

/* ---- the loop ---------------------------------------------------------------------------------------------------- */

/* Prepares a load step of the run, such that its results depend only on data of the checkpoint and a resumed run is
 * bitwise equal. Recomputes the free rigid motions of the unconstrained fragments from their present positions.
 * Discards a preconditioner that a resumed run could not rebuild: one made before bonds broke, or one with the
 * stiffness of contact, which depends on the positions at that time.
 *
 * Then converts to peridynamic particles the material points that rigid bodies come near until pseudo-time t [s], since
 * rigid bodies act on particles only and would pass through points without work. If points were converted, finds the
 * equilibrium at the present pseudo-time again, and the next crack increment if there was one. Returns FAILED, with a
 * message, if an equilibrium is not found. */
static status load_step_begin(struct run *run, real t)
{
    struct statics *s = run->statics;
    const int64_t solutions = s->solutions;
    const bool increment = s->next.n > 0;
    unconstrained_fragments_find(run);
    if (s->precondition_stale || s->has_contact)
        statics_preconditioner_free(s);
    else if (s->kept && !s->precondition)
        statics_preconditioner_make(run);
    s->kept = false;
    s->directions = 0;
    if (!load_step_flag_points_near_contact_to_convert(run, s->t, t)) return OK;
    TRY(equilibrium_convert_points_to_pd_and_solve_again(run, 0));
    return increment && s->solutions > solutions ? crack_increment_find_by_trial_equilibria(run) : OK;
}

/* Makes the next load step of the run: if bonds soften, by load_step_solve_with_softening_bonds, else under the
 * control (load, energy or opening) of the scene. Returns FAILED, with a message, if an equilibrium is not found. */
static status load_step(struct run *run)
{
    const struct scene *s = run->scene;
    const real most = s->duration / (real)s->steps.number;
    TRY(load_step_begin(run, run->statics->t + most));
    if (run->bonds.soft.curve) return load_step_solve_with_softening_bonds(run, most * (real)(run->clock.step + 1));
    switch (s->steps.control) {
    case CONTROL_LOAD:
        return step_by_load(run, most * (real)(run->clock.step + 1));
    case CONTROL_ENERGY:
        return step_by_energy(run, most);
    case CONTROL_OPENING:
        return step_by_opening(run);
    }
    return OK;
}

/* Returns REFUSED, with a message, if the control of the load steps of scene s is energy or opening, which scale the
 * loads by the pseudo-time, but loads and supports are constant; else OK. quarter, half, whole: load sizes at a
 * quarter, at half and at the end of the duration, [m] or [N]. */
static status check_loads_grow(const struct scene *s, real quarter, real half, real whole)
{
    if (s->steps.control == CONTROL_LOAD || half != whole || quarter != whole) return OK;
    return status_set(
        REFUSED,
        "steps.control: energy or opening needs loads or displacements that grow with pseudo-time, but all in this "
        "scene are constant; add time: {ramp: {until: %.3g s}} to the boundary that loads the body",
        s->duration);
}

/* Returns the remedy, as text for a message, for load steps of a scene s with material points that cannot use the mesh
 * of the undeformed body (reference frame): method pd if bonds can have the materials, else one body or explicit
 * steps. */
static const char *remedy_without_reference_frame(const struct scene *s)
{
    bool bonds = true;
    for (int m = 0; m < s->materials; m++) {
        const struct material *a = &s->material[m];
        const real ratio = s->dim > 1 ? bond_based_poisson_ratio(s->space) : a->poisson;
        const bool linear = !a->law.given || (a->law.flow == FLOW_LINEAR && !(a->law.kinematic.modulus > 0));
        bonds &= linear && !(material_yields(a) && fabs(a->poisson - ratio) > 1e-6);
    }
    if (bonds) return "set method: pd, or solver: explicit";
    return s->bodies > 1 ? "join the bodies to one with parts, or set solver: explicit" : "set solver: explicit";
}

status load_steps_check_scene_is_supported(const struct run *run)
{
    const struct scene *s = run->scene;
    if (!scene_has_load_steps(s)) return OK;
    if (s->steps.control == CONTROL_OPENING) TRY(crack_gauge_check_positions(run->scene, &run->part));
    TRY(check_loads_grow(s, statics_norm_of_prescribed_loads(run, 0.25 * s->duration),
                         statics_norm_of_prescribed_loads(run, 0.5 * s->duration),
                         statics_norm_of_prescribed_loads(run, s->duration)));
    for (int b = 0; b < s->bodies && s->method != METHOD_PD; b++)
        if (!run->frame->choice[b].reference)
            return status_set(REFUSED,
                              "solver: load steps need material points in the reference frame, but body %s is in the "
                              "current frame%s%s; %s",
                              s->body[b].name, run->frame->choice[b].reason ? ": " : "",
                              run->frame->choice[b].reason ? run->frame->choice[b].reason : "",
                              remedy_without_reference_frame(s));
    return OK;
}

/* Adds to `to`, and prints, the warning that crack faces overlap, if K_I is negative and contact c does not act between
 * particles. K_I: mode I stress-intensity factor of the tip with the largest growth [Pa m^(1/2)]. */
static void warn_closed_faces(struct warnings *to, real K_I, const struct contact *c)
{
    if (K_I < 0 && c->law.between == CONTACT_NONE)
        warnings_add_and_print(to, "K_I of a crack is negative: its faces are pressed together and pass through each "
                                   "other; set contact.between: all");
}

#define FLOW_LARGE 0.05 /* largest plastic strain of a small-strain analysis [1]; a limit by judgement */

/* Adds to `to`, and prints, a warning of plastic strains of p above FLOW_LARGE, too large for additive small strains.
 * Without hardening they are a sign of loads beyond the limit load. */
static void warn_large_flow(struct warnings *to, const struct particles *p)
{
    real most = 0;
    char text[200];
    for (int64_t i = 0; i < p->n && p->plastic_correction[0]; i++) most = real_max(most, p->plastic_strain[i]);
    snprintf(text, sizeof text,
             "the plastic strain has reached %.2g; load steps assume small strains, of a few percent; check that the "
             "body can carry its loads, or use smaller loads or solver: explicit",
             most);
    if (most > FLOW_LARGE) warnings_add_and_print(to, text);
}

/* Adds to `to`, and prints, a warning if points of a bar (space: line) flow without hardening. The plastic strain of
 * such a bar in load steps is not unique: all of it occurs in one cell. m: materials of the scene, one for each index
 * in p->material. */
static void warn_of_flow_in_one_cell(struct warnings *to, const struct particles *p, const struct material *m)
{
    if (p->dim > 1 || !p->plastic_correction[0]) return;
    for (int64_t i = 0; i < p->n; i++) {
        const struct law *law = &m[p->material[i]].law;
        if (!(p->plastic_strain[i] > 0) || law->flow != FLOW_LINEAR) continue;
        if (law->hardening > 0 || law->kinematic.modulus > 0) continue;
        warnings_add_and_print(to, "a bar that yields without hardening has no unique plastic strain: all of it is in "
                                   "one cell, although forces are right; set yield_tangent to a thousandth of young");
        return;
    }
}

/* Adds to `to`, and prints, a warning of bodies that have slid by more than SLID_LEAST spacings on others. slid:
 * distance of sliding along each axis, statics.slid [m]; spacing: spacing of the particles [m]. */
static void warn_of_sliding(struct warnings *to, const real *slid, real spacing)
{
    for (int a = 0; a < DIM_MAX; a++) {
        char text[240];
        snprintf(text, sizeof text,
                 "a body moved by %.3g m along %c, where only contact holds it: load steps have no friction, so "
                 "contact forces change with its position; add a boundary with fixed: [%c] on a few of its particles",
                 slid[a], 'x' + a, 'x' + a);
        if (slid[a] > SLID_LEAST * spacing) warnings_add_and_print(to, text);
    }
}

/* Adds to run->warnings, and prints, the warnings about the final state of the run: closed crack faces, plastic
 * flow, sliding, and rigid bodies without contact. */
static void warn_at_end(struct run *run)
{
    real K[MODES];
    sif_leading_tip_compute_intensity_factors(&run->statics->sif, &run->part, crack_faces_are_in_contact(run->contact),
                                              K);
    warn_closed_faces(&run->warnings, K[MODE_I], run->contact);
    warn_large_flow(&run->warnings, &run->part);
    warn_of_flow_in_one_cell(&run->warnings, &run->part, run->scene->material);
    warn_of_sliding(&run->warnings, run->statics->slid, run->scene->spacing);
    plastic_flow_warn_of_inexact_stress(&run->statics->turn, run->part.dim, &run->warnings);
    plastic_flow_warn_of_thermal_softening(&run->statics->softening, run->part.dim, &run->warnings);
    rigid_bodies_warn_of_no_contact(&run->warnings, run->rigid, run->scene->rigids,
                                    ROUND_OFF * run->statics->balance.largest);
}

/* Checks the loads on fragments of the run that nothing constrains. Returns FAILED, with a message, if they are not in
 * balance. Under energy control, once bonds have broken, such a fragment means that the crack has severed the body:
 * then sets *apart to true, prints a warning, and returns OK. */
static status check_constrained(struct run *run, bool *apart)
{
    const bool parts = run->scene->steps.control == CONTROL_ENERGY && run->diagnostics->bonds_broken > 0;
    const status held =
        unconstrained_fragments_check_force_balance(run->statics, &run->part, true, run->clock.step + 1);
    *apart = parts && (held != OK || run->statics->severs);
    if (*apart)
        warnings_add_and_print(
            &run->warnings,
            "the crack cuts the body in two: after its next increment a fragment would carry loads almost without "
            "support, so the run ends before that increment; to continue, hold the fragment by a boundary");
    return parts ? OK : held;
}

status run_solve_load_steps(struct run *run)
{
    TRY(report_open_history_and_write_first_frame(run));
    timers_start(&run->timers);
    if (!run->statics->node) statics_equation_system_make(run); /* a resumed run has them */
    statics_contact_search_before_first_solution(run);
    run->statics->gauge[0] = particles_index_nearest_to_position(&run->part, run->scene->steps.from);
    run->statics->gauge[1] = particles_index_nearest_to_position(&run->part, run->scene->steps.to);
    sif_cracks_find_tips_and_test_if_any_can_grow(run); /* for the plane of the tips, which a resumed run lacks */
    if (run->clock.step == 0) history_sample_write_in_equilibrium(run);
    plastic_flow_measure_direction_change(run->statics, &run->part, run->tables.elastic, 0);
    while (run->clock.step < run->clock.steps) {
        run->clock.load_step = run->statics->record.step = run->clock.step + 1;
        bool apart;
        const status solved = load_step(run);
        timer_add_elapsed_to_section(&run->timers, TIMER_BONDS);
        if (solved == INTERRUPTED) return solved;
        plastic_flow_measure_direction_change(run->statics, &run->part, run->tables.elastic, run->clock.load_step);
        if (solved == FAILED) /* a metal that heat softens may have no equilibrium */
            plastic_flow_warn_of_thermal_softening(&run->statics->softening, run->part.dim, &run->warnings);
        TRY(solved);
        TRY(check_constrained(run, &apart));
        plastic_state_save(&run->statics->plastic, &run->bonds, &run->part, run->optional);
        run->clock.step++;
        if (apart) run->clock.steps = run->clock.step;
        run->clock.t = run->clock.dt * (real)run->clock.step;
        state_sample(run);
        history_sample_write_in_equilibrium(run);
        statics_reset_solver_counts_for_history(run->statics);
        if (run->statics->t >= run->scene->duration * (1 - 1e-12)) run->clock.steps = run->clock.step;
        timer_add_elapsed_to_section(&run->timers, TIMER_BONDS);
        if (run->clock.step == run->clock.steps) warn_at_end(run);
        snprintf(run->report->note, sizeof run->report->note, "load time %.4g s  %lld equilibria", run->statics->t,
                 (long long)run->statics->solutions);
        TRY(report_write_outputs_due_after_step(run));
    }
    statics_free(run->statics);
    return report_write_last_checkpoint_and_finish(run);
}
