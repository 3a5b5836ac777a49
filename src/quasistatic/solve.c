/* Finds the static equilibrium of the bodies of an input file (scene): iterates the solvers (solver/solver.h) until
 * they converge, and adds warnings about their result. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "relaxation.h"
#include "kernels/pd/bond_laws.h"
#include "solver/solver.h"
#include "step/report.h"
#include "run/say.h"
#include "run/energies.h"
#include "step/sample.h"
#include "loads/mirrors.h"

/* Returns what the solvers of a static equilibrium need of the run: pointers to its particles, bonds and loads,
 * which the solvers change, and its force function, materials, spacing and tolerance. */
static struct static_body static_body_of(struct run *run)
{
    return (struct static_body){&run->part,
                                &run->bonds,
                                &run->loads,
                                run->kernels.bond_force,
                                run->scene->material,
                                run->scene->spacing,
                                run->scene->solver_tolerance,
                                run->scene->bodies};
}

status run_make_single_equilibrium_solver(struct run *run)
{
    const struct scene *s = run->scene;
    const struct static_body body = static_body_of(run);
    const real ramp_time =
        s->method == METHOD_PD
            ? 1
            : grid_relaxation_load_ramp_time(particles_bounding_box_longest_edge(&run->part) + s->spacing,
                                             run->tables.wave_speed, run->clock.dt);
    static_boundaries_make_from_dynamic(run->boundary, s->boundary, s->boundaries, s->duration, ramp_time);
    TRY(static_solver_make(run->solver, &body, ramp_time));
    if (s->method == METHOD_PD)
        static_solver_make_iteration_vectors(run->solver, &body, s->solver == SOLVER_CG);
    else
        for (int b = 0; b < run->loads.n; b++) /* the time steps on the grid add it up */
            memset(run->loads.load[b].displacement, 0, sizeof run->loads.load[b].displacement);
    return OK;
}

/* Returns the number of intact bonds of b whose stretch exceeds the critical stretch, each bond once. p: particles;
 * limit: critical stretches of an explicit run; in a static solution no bond breaks. */
static int64_t bonds_past_limit(const struct bonds *b, const struct particles *p, const struct bond_limit *limit)
{
    int64_t past = 0;
    for (int64_t r = 0; r < b->rows; r++)
        for (struct bond_iterator it = bond_iterator_of_row(b, r); bond_iterator_advance(&it);) {
            const int32_t i = b->particle[r], j = it.bond.nbr;
            const real most = limit->critical_stretch[p->material[i] * limit->materials + p->material[j]] *
                              bond_strength_factor(p, i, j);
            past += it.bond.w != 0 && j > i && bond_elastic_stretch_at_present_positions(b, p, &it.bond, i) > most;
        }
    return past;
}

/* Adds a warning to *to that `past` bonds exceed their critical stretch in the equilibrium of a solver that breaks no
 * bonds (a single equilibrium, not load steps). Does nothing if past = 0. */
static void warn_past_limit(struct warnings *to, int64_t past)
{
    char text[200];
    snprintf(text, sizeof text,
             "in this equilibrium %lld bonds exceed their critical stretch, but this solver breaks no bonds; use "
             "smaller loads, load steps (solver: static) or solver: explicit",
             (long long)past);
    if (past > 0) warnings_add_and_print(to, text);
}

#define TURN_STRAIN_MOST 0.05 /* share of the largest stretch that rotations may falsify: as the energy balance */

/* Adds a warning to *to if rotations falsify the stresses of the conjugate-gradient solution of b and p. The linear
 * equations lengthen a bond that rotates by the angle a by a^2/2 of its length: compares the largest such difference
 * between the stretch in the solution and the linear stretch with the largest linear stretch. */
static void warn_large_rotation(struct warnings *to, const struct bonds *b, const struct particles *p)
{
    real falsified = 0, largest = 0;
    char text[320];
    for (int64_t r = 0; r < b->rows; r++)
        for (struct bond_iterator it = bond_iterator_of_row(b, r); bond_iterator_advance(&it);) {
            const int32_t i = b->particle[r], j = it.bond.nbr;
            real length2 = 0, along = 0, moved2 = 0;
            for (int d = 0; d < p->dim && it.bond.w != 0; d++) {
                const real xi = p->X[d][j] - p->X[d][i], eta = p->x[d][j] - p->x[d][i] - xi;
                length2 += square(xi), along += xi * eta, moved2 += square(eta);
            }
            if (!(length2 > 0)) continue;
            const real stretch = along / length2;
            falsified = real_max(falsified, 0.5 * (moved2 / length2 - square(stretch)));
            largest = real_max(largest, fabs(stretch));
        }
    snprintf(
        text, sizeof text,
        "bonds rotate by up to %.2g degrees, so stretches are wrong by up to %.2g %% of the largest one: solver: cg "
        "is for small displacements only; use smaller loads, or solver: static or relaxation",
        sqrt(2 * falsified) * 180 / acos(-1), 100 * falsified / largest);
    if (falsified > TURN_STRAIN_MOST * largest) warnings_add_and_print(to, text);
}

/* Largest stress divided by Young's modulus up to which a solution of linear elasticity is accepted without a warning
 * [1]; chosen by judgement. */
#define STRAIN_LARGE 0.1

/* Adds a warning to *to if a stress of particles p exceeds STRAIN_LARGE times Young's modulus of its material, beyond
 * the strength of any solid: a linear elastic body has an equilibrium under any load. material: materials of the
 * scene. */
static void warn_large_strain(struct warnings *to, const struct particles *p, const struct material *material)
{
    real most = 0;
    char text[200];
    for (int64_t i = 0; i < p->n; i++)
        for (int k = 0; k < symmetric_tensor_component_count(p->dim); k++)
            most = real_max(most, fabs(p->stress[k][i]) / material[p->material[i]].young);
    snprintf(text, sizeof text,
             "stresses of the solution reach %.3g times Young's modulus, more than any solid can carry and too much "
             "for small strains; check the loads and their units",
             most);
    if (!(most <= STRAIN_LARGE)) warnings_add_and_print(to, text);
}

/* Ratio of the closing of a crack (struct closing) to the largest strain of the body, above which the crack faces are
 * reported to pass through each other [1]. Without such contact the ratio is up to 2.6 at corners. */
#define CLOSED 3
#define NEXT 1.2 /* largest reference distance of neighbours across a crack face [spacings] */

/* How far crack faces have closed in a static equilibrium. most: largest shortening of the distance of two
 * neighbours on opposite faces, less the width of the crack, divided by their reference distance [1]; place:
 * point midway between them [m]; strain: largest |change| of the distance of neighbours without a crack
 * between them, likewise divided [1]. */
struct closing {
    real most, place[DIM_MAX], strain;
};

/* Returns the first of the pre-cracks of bond source s that lies between particles i and j of p, or NULL if there is
 * none. */
static const struct crack *crack_between(const struct bond_source *s, const struct particles *p, int64_t i, int64_t j)
{
    real from[DIM_MAX], to[DIM_MAX];
    particle_reference_position(p, i, from);
    particle_reference_position(p, j, to);
    for (int c = 0; c < s->cracks; c++)
        if (crack_cuts_bond(&s->crack[c], from, to, p->dim)) return &s->crack[c];
    return NULL;
}

/* Updates *closing by the pair of particles i and j of p, neighbours on the lattice: if a crack of s is between them,
 * the largest shortening of such a pair beyond the width of the crack, divided by the reference distance [1], and its
 * position [m]; else the largest |strain| of a pair [1]. s: bond source, with the cracks. */
static void closing_update(struct closing *closing, const struct bond_source *s, const struct particles *p, int64_t i,
                           int64_t j)
{
    real now = 0, before = 0;
    for (int d = 0; d < p->dim; d++) now += square(p->x[d][j] - p->x[d][i]), before += square(p->X[d][j] - p->X[d][i]);
    const struct crack *crack = crack_between(s, p, i, j);
    const real change = sqrt(now / before) - 1;
    if (!crack) {
        closing->strain = real_max(closing->strain, fabs(change));
        return;
    }
    const real closed = -change - crack->width / sqrt(before);
    if (closed <= closing->most) return;
    closing->most = closed;
    for (int d = 0; d < p->dim; d++) closing->place[d] = 0.5 * (p->x[d][i] + p->x[d][j]);
}

/* Adds and prints a warning (*to) if faces of a crack of scene s have closed in a static equilibrium, where they pass
 * through each other: their particles have approached by more than the strain of the body explains. Does nothing
 * without pre-cracks, without bonds (method mpm), or if the input file accepts this warning. source: bond source with
 * the cracks and the search cells of the particles p. */
static void warn_of_closed_faces(const struct scene *s, const struct particles *p, const struct bond_source *source,
                                 struct warnings *to)
{
    struct closing closing = {0};
    struct neighbour_list near = {0};
    char text[400];
    if (s->cracks == 0 || s->method == METHOD_MPM || scene_silences_warning(s, ACCEPT_CONTACT)) return;
    for (int64_t i = 0; i < p->n; i++) {
        particles_list_neighbours_within_radius(&near, source->cells, p, i, NEXT * s->spacing, false);
        for (int k = 0; k < near.n; k++)
            if (near.at[k] > i) closing_update(&closing, source, p, i, near.at[k]);
    }
    memory_free(near.at);
    if (closing.most <= CLOSED * closing.strain) return;
    snprintf(text, sizeof text,
             "faces of a crack close at (%s) m, by %.3g of the distance of their particles, and pass through each "
             "other in this equilibrium, "
             "which has no contact: use solver: static, whose load steps have it; if this is intended, add accept: "
             "[contact]",
             position_text(closing.place, p->dim, 4).text, closing.most);
    warnings_add_and_print(to, text);
}

/* Completes the static solution of the run: sets velocities to 0 and the time to the end of the duration, and
 * updates work, stresses, probes and warnings. */
static void solver_finish(struct run *run)
{
    struct particles *p = &run->part;
    const struct bond_limit limit = {.critical_stretch = run->tables.pair_stretch, .materials = run->scene->materials};
    for (int d = 0; d < p->dim; d++) array_fill_bytes(p->v[d], 0, p->n_all, sizeof(real));
    for (int k = 0; k < p->dim * p->dim && (run->optional & WITH_GRADIENT); k++)
        array_fill_bytes(p->gradient[k], 0, p->n_all, sizeof(real));
    loads_update_mirror_images_of_particles(&run->loads, p);
    loads_compute_work_in_static_equilibrium(&run->loads, p);
    memset(run->loads.impulse, 0, sizeof run->loads.impulse);
    run->clock.t = run->scene->duration;
    run->clock.steps = run->clock.step;
    run->report->sampling.due = false;
    run->report->sampling.kinetic = 0, run->report->sampling.constraint_work = run->loads.constraint_work;
    run_update_break_and_reaction_probes(run);
    run->solver->past_limit = bonds_past_limit(&run->bonds, p, &limit);
    warn_past_limit(&run->warnings, run->solver->past_limit);
    bonds_compute_particle_stress(&run->bonds, &run->part, &run->source, &run->kernels);
    warn_large_strain(&run->warnings, p, run->scene->material);
    warn_of_closed_faces(run->scene, p, &run->source, &run->warnings);
    if (run->scene->solver == SOLVER_CG) warn_large_rotation(&run->warnings, &run->bonds, p);
}

/* Sets the error that the solver s found no equilibrium, with a message that contains the reason. tolerance: required
 * relative residual; step: number of the last iteration. Always returns FAILED. */
static status not_converged(const struct static_solver *s, real tolerance, int64_t step)
{
    if (!(s->residual < INFINITY))
        return status_set(FAILED,
                          "the solver diverged at step %lld; use smaller loads, or set solver: relaxation (in place of "
                          "cg) or explicit",
                          (long long)step);
    if (s->residual * s->scale <= s->noise)
        return status_set(FAILED,
                          "the out-of-balance force stays at %.3g of the load, but %.3g is required, because strains "
                          "are so small that round-off of positions dominates; use a larger solver_tolerance",
                          s->residual, tolerance);
    return status_set(
        FAILED,
        "no equilibrium after %lld steps: the out-of-balance force is %.3g of the load, but %.3g is required; raise "
        "solver_steps, or check that every part of the body is held or has balanced loads",
        (long long)step, s->residual, tolerance);
}

/* Makes one iteration of the solver of the run for bonds, or one damped time step on the grid. *done: set to true at
 * equilibrium. Returns FAILED, with a message, if the step fails. */
static status solve_step(struct run *run, bool *done)
{
    const struct static_body body = static_body_of(run);
    if (run->scene->method != METHOD_PD) return grid_relaxation_step(run, done);
    TRY((run->scene->solver == SOLVER_CG ? cg_step : relaxation_step)(run->solver, &body, run->clock.step, done));
    timer_add_elapsed_to_section(&run->timers, TIMER_BONDS);
    run->clock.step++;
    return OK;
}

/* Stores the forces on the particles p before the first iteration in s->before, from which dynamic relaxation computes
 * differences. */
static void solve_start(struct static_solver *s, const struct particles *p)
{
    for (int d = 0; d < p->dim; d++) array_copy(s->before.of[d], p->f[d], p->n, sizeof(real));
}

status run_solve_single_equilibrium(struct run *run)
{
    TRY(report_open_history_and_write_first_frame(run));
    timers_start(&run->timers);
    if (run->scene->method == METHOD_PD && run->clock.step == 0) history_sample_write_in_equilibrium(run);
    if (run->scene->method == METHOD_PD) solve_start(run->solver, &run->part);
    while (run->clock.step < run->clock.steps) {
        bool done = false;
        TRY(solve_step(run, &done));
        if (done)
            solver_finish(run);
        else if (run->clock.step >= run->clock.steps || isnan(run->solver->residual))
            return not_converged(run->solver, run->scene->solver_tolerance, run->clock.step);
        TRY(report_write_outputs_due_after_step(run));
    }
    return report_write_last_checkpoint_and_finish(run);
}
