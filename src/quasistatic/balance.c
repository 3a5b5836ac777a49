/* Finds the equilibrium at the next pseudo-time of a run in load steps, and computes the balance of energy over a load
 * increment. */
#include <float.h>
#include <math.h>

#include "balance.h"
#include "account.h"
#include "stretch_ratio.h"
#include "unconstrained.h"
#include "springs.h"
#include "system.h"
#include "contact_set.h"
#include "trial.h"
#include "unknowns.h"

#include "base/memory.h"
#include "mesh/mesh_part.h"
#include "step/report.h"
#include "step/step.h"
#include "loads/mirrors.h"

#define GAIN_MOST 0.01 /* largest energy gain of a solution, as a share of the uncertainty of the work of loads */

/* TRIES_MOST: largest number of attempts to find an equilibrium; SUBSTEPS_FACTOR: factor by which the number of
 * substeps increases from one attempt to the next. */
enum { TRIES_MOST = 4, SUBSTEPS_FACTOR = 4 };

/* ---- predictor --------------------------------------------------------------------------------------------------- */

/* Returns the relative growth of the loads from the last equilibrium to pseudo-time t [s]: their value at t divided by
 * the present value, less 1 [1]. It is used to predict displacements. Compares prescribed displacements if there are
 * any, else applied forces, by the scalar product with the present values divided by their square. s: unknowns and
 * their prescribed increment; part: particles; before[dim][particles]: applied forces of the last equilibrium [N].
 * Returns 0 if the present values are 0. */
static real load_growth(const struct statics *s, const struct particles *part, real t, real *const *before)
{
    real now = 0, initial = 0;
    for (int64_t k = 0; k < s->balance.n; k++)
        for (int d = 0; d < part->dim; d++) {
            const real u = s->balance.u.of[d][k];
            if (s->load[k * DIM_MAX + d] >= 0) now += u * (u + s->increment.of[d][k]), initial += u * u;
        }
    for (int d = 0; d < part->dim && initial == 0; d++)
        for (int64_t i = 0; i < part->n; i++) now += s->applied[d][i] * before[d][i], initial += square(before[d][i]);
    return initial > 0 && t != s->t ? now / initial - 1 : 0;
}

/* Predicts the displacement increment to pseudo-time t [s] and stores it in s->increment: for supports the increment
 * that `loads` prescribe, for all other components the present displacements times the relative growth of the loads.
 * p, mesh: particles and nodes to which the unknowns belong; before[dim][particles]: applied forces of the last
 * equilibrium [N]. */
static void increment_predict(struct statics *s, const struct particles *p, const struct mesh *mesh,
                              const struct loads *loads, real t, real *const *before)
{
    struct prescribed_displacement by[BOUNDARIES_MAX];
    for (int b = 0; b < loads->n; b++)
        by[b] = boundary_prescribed_displacement_at_time(loads->load[b].boundary, p->dim, t);
    for (int64_t k = 0; k < s->balance.n; k++) {
        real X[DIM_MAX] = {0};
        if (s->balance.held[k]) unknown_compute_reference_position(s, p, mesh, k, X);
        for (int d = 0; d < p->dim; d++) {
            const int load = s->load[k * DIM_MAX + d];
            const real u = s->balance.u.of[d][k];
            if (s->balance.held[k] >> d & 1)
                s->increment.of[d][k] =
                    (load < 0 ? 0 : prescribed_displacement_component_at_position(&by[load], X, d)) - u;
        }
    }
    const real growth = load_growth(s, p, t, before);
    for (int d = 0; d < p->dim; d++)
        for (int64_t k = 0; k < s->balance.n; k++)
            if (!(s->balance.held[k] >> d & 1)) s->increment.of[d][k] = growth * s->balance.u.of[d][k];
    field_remove_free_rigid_motion(s, &s->increment);
}

/* Returns the norm of the forces below which residuals have no meaning [N]: ten times the norm of the bond forces that
 * result from round-off of the positions. bonds, part: all bonds and their particles. */
static real round_off_force(const struct bonds *bonds, const struct particles *part)
{
    real sum = 0;
    for (int64_t r = 0; r < bonds->rows; r++) {
        const int32_t i = bonds->particle[r];
        const real spring = 0.25 * bonds_row_stiffness_eigenvalue_upper_bound(bonds, part, r);
        for (int d = 0; d < part->dim; d++) sum += square(spring * part->X[d][i] * DBL_EPSILON);
    }
    return 10 * sqrt(sum);
}

/* ---- losses ------------------------------------------------------------------------------------------------------ */

/* Corrects newton->lost [J], the energy that the solver has lost in all solutions so far, after one more solution.
 * `lost` [J] is its value before that solution. If points yield or faces come into contact, forces do not change
 * linearly over the increment, and the work of loads is known only up to +-`range` [J]. A loss within this range is
 * taken for an error of the work and subtracted from loads->work. in_contact: true if anything is in contact at the
 * start or the end of the increment; yields: true if points or bonds may yield; round_off: energy that round-off of the
 * forces may create [J]. Returns true if faces have passed through each other: if, in contact, the solution has gained
 * more energy than GAIN_MOST times `range` plus `round_off`. */
static bool losses_store(struct newton_solver *newton, struct loads *loads, real lost, real range, real round_off,
                         bool in_contact, bool yields)
{
    real uneven = yields || in_contact ? real_min(newton->lost - lost, range) : 0;
    if (in_contact && !yields) uneven = real_max(uneven, -range);
    loads->work -= uneven, newton->lost -= uneven;
    return in_contact && !yields && lost - newton->lost > GAIN_MOST * range + round_off;
}

/* ---- equilibrium ------------------------------------------------------------------------------------------------- */

/* Returns the remedy against a missing equilibrium of a body that yields, as a part of a sentence: no heating if
 * plastic work heats one of the materials of the scene, else more hardening. */
static const char *remedy_of_materials(const struct scene *scene)
{
    for (int m = 0; m < scene->materials; m++)
        if (flow_law_plastic_work_heats_material(&scene->material[m].law))
            return "no specific_heat (plastic work then does not soften the metal), solver: explicit, ";
    return "a slope of hardening of a thousandth of young (yield_tangent, or the law in hardening), ";
}

/* Sets the error that no equilibrium was found: the message names the position of the largest residual of s and
 * possible remedies. scene: its materials; p, mesh: particles and nodes of the unknowns; step: number of the load step,
 * for the message; bonded: true if there are bonds. Always returns FAILED. */
static status equilibrium_failed(const struct statics *s, const struct scene *scene, const struct particles *p,
                                 const struct mesh *mesh, int64_t step, bool bonded)
{
    real X[DIM_MAX] = {0};
    if (s->balance.n > 0) unknown_compute_reference_position(s, p, mesh, s->balance.worst, X);
    return status_set(
        FAILED,
        "load step %lld, t = %.6g s: no equilibrium: the out-of-balance force stays at %.3g of the load (allowed: "
        "%.3g), most of it near x = %.6g, y = %.6g, z = %.6g m. Check that every part is held and that the body can "
        "carry the loads, or use %s%smore load steps (steps.number) or a larger solver_tolerance",
        (long long)step, s->t, s->balance.residual, s->balance.tolerance, X[0], X[1], X[2],
        p->plastic_correction[0] ? remedy_of_materials(scene) : "", bonded ? "steps.control: energy, " : "");
}

/* Returns INTERRUPTED, with a message that names the load step of `clock`, if the user has asked for a stop
 * (*report->stop), else OK. */
static status check_stop(const struct run_report *report, const struct run_clock *clock)
{
    if (!report->stop || !*report->stop) return OK;
    return status_set(INTERRUPTED, "interrupted in load step %lld of %lld; continue with --resume",
                      (long long)clock->step + 1, (long long)clock->steps);
}

status equilibrium_solve_without_updating_work(struct run *run, real pseudo_time, real *const *present_applied_forces)
{
    struct statics *s = run->statics;
    TRY(check_stop(run->report, &run->clock));
    TRY(loads_check_formula_values_are_finite(&run->loads, &run->part, pseudo_time));
    applied_forces_compute(s, &run->part, &run->loads, pseudo_time);
    if (s->fragments_stale) unconstrained_fragments_find(run);
    increment_predict(s, &run->part, &run->frame->mesh, &run->loads, pseudo_time, present_applied_forces);
    s->balance.applied = applied_forces_norm(s, &run->part, &run->loads, run->contact);
    if (!s->precondition) s->balance.noise = round_off_force(&run->bonds, &run->part);
    const status found = newton_solver_find_equilibrium(&s->balance, &s->increment, pseudo_time != s->t);
    s->t = pseudo_time;
    return found == OK ? OK
                       : equilibrium_failed(s, run->scene, &run->part, &run->frame->mesh, run->clock.step + 1,
                                            run->bonds.rows > 0);
}

/* Finds the equilibrium of the run at pseudo-time t [s] in a single solution, and updates work and energies of loads,
 * supports and solver. *crossed: set to true if faces have passed through each other, else to false. Returns FAILED,
 * with a message, if no equilibrium is found or a formula of a load is not finite. */
static status solve_at(struct run *run, real t, bool *crossed)
{
    struct statics *s = run->statics;
    struct work_account account;
    const int64_t asked = s->balance.directions;
    const real lost = s->balance.lost;
    TRY(loads_check_formula_values_are_finite(&run->loads, &run->part, t));
    statics_move_rigid_bodies_and_search_contacts(run, t);
    work_account_store_initial_equilibrium(&account, s, &run->part);
    const status found = equilibrium_solve_without_updating_work(run, t, account.applied);
    run_move_to_solution_and_update_plastic_state(run);
    lagrangian_mesh_update_point_motion_and_stress(run->frame, &run->part, &run->loads);
    loads_update_mirror_images_of_particles(&run->loads, &run->part);
    const bool touched = statics_contact_existed_before_or_exists_now(s, run->contact);
    const real worked = run->loads.work + run->loads.constraint_work,
               range = work_account_add_work_and_estimate_error(&account, s, &run->part, &run->loads,
                                                                touched ? 0 : s->balance.bent);
    const real rigids =
        rigid_body_work_add_and_estimate_error(run, run->loads.work + run->loads.constraint_work - worked, lost);
    *crossed = losses_store(&s->balance, &run->loads, lost, range + rigids, s->balance.noise * run->scene->spacing,
                            touched || s->in_contact, run->part.plastic_correction[0] != NULL);
    run->damped += s->balance.lost - lost;
    reactions_compute_and_store(s, &run->part, &run->loads);
    s->solutions++;
    statics_preconditioner_free_if_inefficient(s, s->balance.directions - asked);
    return found;
}

/* Finds the equilibria of the run after each of `substeps` equal increments up to pseudo-time t [s]. Stops, and sets
 * *crossed to true, as soon as faces have passed through each other; else sets *crossed to false. Returns FAILED, with
 * a message, if an equilibrium is not found. */
static status solve_substeps(struct run *run, real t, int substeps, bool *crossed)
{
    const real from = run->statics->t;
    *crossed = false;
    for (int k = 1; k <= substeps && !*crossed; k++)
        TRY(solve_at(run, k == substeps ? t : from + (t - from) * k / substeps, crossed));
    return OK;
}

/* Finds the equilibrium of the run at pseudo-time t [s]. If faces pass through each other, restores the initial state
 * and tries again with SUBSTEPS_FACTOR times as many substeps of the increment, at most TRIES_MOST attempts in all.
 * Makes only one attempt without contact, and for bodies that yield, because yielding cannot be undone. Returns FAILED,
 * with a message, if faces pass through each other in the last attempt, or if an equilibrium is not found. */
static status solve_whole(struct run *run, real t)
{
    const real from = run->statics->t;
    int substeps = statics_rigid_motion_substep_count(run->scene, run->rigid, t);
    bool crossed = false;
    if (!run->statics->has_contact || run->part.plastic_correction[0] || run->bonds.plastic_stretch)
        return solve_substeps(run, t, substeps, &crossed);
    for (int k = 0; k < TRIES_MOST; k++, substeps *= SUBSTEPS_FACTOR) {
        struct memory_archive saved;
        trial_equilibrium_begin(run, &saved);
        const status solved = solve_substeps(run, t, substeps, &crossed);
        if (solved != OK || !crossed || t == from) {
            memory_archive_free(&saved);
            return solved;
        }
        trial_equilibrium_end(run, &saved, false, NULL);
    }
    return status_set(FAILED,
                      "load step %lld, t = %.6g s: crack faces pass through each other before equilibrium is reached; "
                      "use more load steps (steps.number) or a larger particles.spacing",
                      (long long)run->clock.step + 1, t);
}

/* Finds the equilibrium of the run at `pseudo_time` [s] and stores the largest stretch ratio (stretch of a bond divided
 * by its critical stretch) in run->statics. Returns FAILED, with a message, if there is no equilibrium; INTERRUPTED,
 * before the solution, if the user has stopped the run, so that the checkpoint of the previous load step stays
 * valid. */
status equilibrium_find_at_time(struct run *run, real pseudo_time)
{
    TRY(check_stop(run->report, &run->clock));
    TRY(solve_whole(run, pseudo_time));
    run->statics->stretch_ratio = bonds_largest_stretch_ratio(&run->bonds, &run->part, &run->source.limit);
    return OK;
}

status equilibrium_convert_points_to_pd_and_solve_again(struct run *run, int64_t broken_bonds)
{
    while (load_step_convert_points_near_breaks_to_pd(run, broken_bonds)) {
        broken_bonds = 0;
        statics_preconditioner_free(run->statics);
        statics_equation_system_free(run->statics);
        statics_equation_system_make(run);
        run->statics->next.n = 0;
        TRY(equilibrium_find_at_time(run, run->statics->t));
    }
    return OK;
}
