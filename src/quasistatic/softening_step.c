/* Finds equilibria of bodies whose bonds soften, one for each load step. An equilibrium is a stationary point
 * of the sum over all bonds of phi(s), a function of the stretch s. With the largest stretch k_0 of the bond
 * at the last equilibrium, its stored energy psi and its dissipated energy D (data/softening.h),
 *
 *     phi(s) = psi(s, k_0) for s <= k_0,   psi(s, s) + D(s) - D(k_0) beyond
 *
 * The iteration uses secant stiffnesses: with a fixed largest stretch k, each bond is a spring, and the
 * solver of all load steps finds the only equilibrium of the springs. Under energy control the displacements
 * are then scaled such that bonds stretched in proportion dissipate the given energy; this determines new k,
 * and the loads are scaled by the same factor. Loads may decrease while the dissipation grows, so that the
 * path is followed through snap-back (Gutierrez 2004). Under load control the factor is the ratio of the
 * loads. The iteration ends when the forces with k = max(k_0, s) are balanced.
 *
 * Where a strength surface starts the softening, the factor is limited to the value at which the stress of
 * the next particle reaches its strength surface. The bonds of this particle then begin to soften from their
 * stretches at this equilibrium. */
#include "softening_step.h"

#include <math.h>

#include "account.h"
#include "balance.h"
#include "crack_increment.h"
#include "load_size.h"
#include "softening.h"
#include "springs.h"
#include "stretch_ratio.h"
#include "toughness.h"
#include "trial.h"
#include "unknowns.h"

#include "base/memory.h"
#include "bonds/closing.h"
#include "bonds/strength_surfaces.h"
#include "loads/mirrors.h"

#define FACTOR_ERROR 1e-5  /* largest difference of the last factor from 1 */
#define RESIDUAL_MOST 1e-5 /* residual of an equilibrium, unless solver_tolerance is larger [1] */
#define SOLVED_TO 0.1      /* residual of a solution with fixed k divided by that of the previous state [1] */
#define SOLVED_LEAST 1e-3  /* largest residual of such a solution [1] */
#define THROUGH 1e-2       /* share of the largest load size at which the body counts as severed */
#define STEP_SPACINGS 0.25 /* crack growth of a load step by default [spacings] */
#define FIRST_SHARE 1e-3   /* share of the energy of a load step that the first one dissipates */
#define AT_SURFACE 1.002   /* ratio of stress to strength at which an equilibrium ends [1] */

/* ITERATIONS_MOST: largest number of secant iterations in which the residual of an equilibrium does not halve.
 * TRIES_MOST: largest number of attempts at a load step, each with half the energy of the previous one. GROWTHS_MOST:
 * largest number of increases of the factor on the displacements. */
enum { ITERATIONS_MOST = 400, TRIES_MOST = 5, GROWTHS_MOST = 200 };

/* Largest growth of the stretch of a bond in a part of the path between two equilibria, in units of the stretch over
 * which it softens [1]: steps under control by energy have one part. Largest number of parts. */
enum { PART_GROWTH = 2, PATH_PARTS_MOST = 1000 };

/* State of the iteration for the equilibrium that ends one load step with softening bonds. It lives for one attempt.
 * The solver, bonds, particles and bond source are borrowed; the list of softening bonds is owned. */
struct search {
    struct newton_solver *q;
    struct bonds *bonds;
    struct particles *part;
    const struct bond_source *source;
    struct softening_bond_list list;
    real spent;    /* energy to be dissipated, INFINITY: loads are given [J] */
    real end;      /* largest pseudo-time [s] */
    bool at_end;   /* the loads of the pseudo-time `end` are reached */
    real residual; /* of the last state, with k = max(k_0, s) [1] */
};

/* Sets the displacements of the body in the search f to `factor` [1] times those of the last solution, f->q->u. Calls
 * the force function of the solver for this, which moves the particles; the forces are not used. */
static void body_scale(const struct search *f, real factor)
{
    struct newton_solver *newton = f->q;
    for (int d = 0; d < newton->dim; d++)
        for (int64_t k = 0; k < newton->n; k++) newton->at.of[d][k] = factor * newton->u.of[d][k];
    newton->force(newton->context, &newton->at, &newton->z);
}

/* Returns the factor on the present displacements [1] at which the next particle of the search f reaches its strength
 * surface, since stresses grow in proportion to the displacements; INFINITY without such a particle. */
static real factor_at_surface(const struct search *f)
{
    const real ratio = bonds_largest_stress_to_strength_ratio(f->bonds, f->part, f->source);
    return ratio > 0 ? AT_SURFACE / ratio : INFINITY;
}

/* Chooses the factor on the displacements of the last solution [1] at which bonds have dissipated the energy f->spent
 * of the load step, and returns it. The factor is at most `most`, and at most the one at which the next particle
 * reaches its strength surface. With given loads (f->spent INFINITY) the factor is `most`; a strength surface reduces
 * it at most to `least`. most, least: loads at the end of the step, and at the last equilibrium, divided by the present
 * loads [1]. Stores the largest stretches of the bonds at this factor, and sets f->at_end to whether it is `most`. */
static real secants_choose(struct search *f, real most, real least)
{
    const bool given = !isfinite(f->spent);
    const real end = most;
    real high = given ? most : real_min(1, most), growth = 1.01;
    for (int k = 0;; k++) {
        body_scale(f, high);
        bonds_open_beyond_onset(f->bonds, f->part, &f->source->limit);
        softening_bond_list_collect(&f->list, f->bonds, f->part, high);
        most = real_min(most, real_max(high * factor_at_surface(f), given ? least : 0));
        high = real_min(high, most);
        if (given || high >= most || k == GROWTHS_MOST ||
            softening_bond_list_dissipated_energy(&f->list, high) >= f->spent)
            break;
        high = real_min(most, growth * high);
        growth = real_min(2, square(growth));
    }
    const bool enough = !given && softening_bond_list_dissipated_energy(&f->list, high) >= f->spent;
    const real factor = enough ? softening_bond_list_stretch_factor_at_energy(&f->list, f->spent, high) : high;
    f->at_end = !enough && high >= end;
    softening_bond_list_store_largest_stretches(&f->list, f->bonds, factor);
    return factor;
}

/* Returns the relative residual of solver newton: the norm of the unbalanced forces at the displacements newton->u of
 * the last solution, divided by newton->scale, the force scale of the solver; 0 if the forces are round-off. Stores the
 * forces in newton->f. Components that boundaries prescribe are left out. */
static real residual_now(struct newton_solver *newton)
{
    real sum = 0;
    newton->force(newton->context, &newton->u, &newton->f);
    for (int d = 0; d < newton->dim; d++)
        for (int64_t k = 0; k < newton->n; k++) sum += newton->held[k] >> d & 1 ? 0 : square(newton->f.of[d][k]);
    return sqrt(sum) > newton->noise ? sqrt(sum) / newton->scale : 0;
}

/* Sets the displacements of solver to 0, those of bonds that soften, or press at a closed crack, without loads. They
 * need no iteration, in which all bonds would change between tension and compression at once. */
static void body_unload(struct newton_solver *newton)
{
    for (int d = 0; d < newton->dim; d++)
        for (int64_t k = 0; k < newton->n; k++) newton->u.of[d][k] = 0;
}

/* Updates which ended bonds of the search f press at the present positions (bonds/closing.h), and discards what the
 * load steps s keep of the former bonds. */
static void cracks_close_and_open(struct statics *s, const struct search *f)
{
    if (bonds_update_contact_springs_of_broken_bonds(f->bonds, f->part, f->source) == 0) return;
    statics_preconditioner_free(s);
    s->fragments_stale = true;
}

/* Finds the equilibrium that ends a load step of the run with softening bonds, by the search f. Repeats two parts: a
 * solution with fixed largest stretches of the bonds, which fix their stiffnesses, and a new choice of these stretches
 * from the solution (secants_choose). The tolerance of the solutions is reduced as the stretches converge. Returns
 * FAILED, with a message, if no equilibrium is found. */
static status search_run(struct run *run, struct search *f)
{
    struct statics *s = run->statics;
    const real lost = s->balance.lost, tolerance = s->balance.tolerance, enough = real_max(RESIDUAL_MOST, tolerance),
               before = statics_norm_of_prescribed_loads(run, s->t);
    real halved = 1;
    status found = OK;
    for (int k = 0, idle = 0; idle < ITERATIONS_MOST && found == OK; k++, idle++) {
        const real size = statics_norm_of_prescribed_loads(run, s->t),
                   last = statics_norm_of_prescribed_loads(run, f->end);
        real *applied[DIM_MAX] = {0}, t = isfinite(f->spent) ? f->end / (real)run->clock.steps : f->end;
        while (t < f->end && statics_norm_of_prescribed_loads(run, t) == 0)
            t = real_min(f->end, 2 * t); /* a small part of the loads, from which displacements can be scaled */
        f->residual = 1;
        if ((size > 0 && last > 0) || k > 0) {
            if (k > 0) body_scale(f, 1), cracks_close_and_open(s, f);
            const real factor = secants_choose(f, size > 0 ? last / size : 1, size > 0 ? before / size : 1);
            f->residual = k > 0 ? residual_now(f->q) : 1;
            if (f->residual < 0.5 * halved) halved = f->residual, idle = 0;
            if (f->residual <= enough && fabs(factor - 1) <= FACTOR_ERROR) return OK;
            t = f->at_end ? f->end : statics_find_pseudo_time_at_load_size(run, factor * size);
        }
        if (last == 0 && t == f->end) body_unload(f->q);
        applied_forces_allocate_and_copy(applied, s, &run->part);
        s->balance.tolerance = real_max(tolerance, real_min(SOLVED_LEAST, SOLVED_TO * f->residual));
        found = equilibrium_solve_without_updating_work(run, t, applied);
        s->balance.tolerance = tolerance, s->balance.lost = lost;
        for (int d = 0; d < run->part.dim; d++) memory_free(applied[d]);
    }
    TRY(found);
    return status_set(FAILED,
                      "load step %lld, t = %.6g s: no equilibrium found while bonds soften (the out-of-balance force "
                      "stays at %.3g of the load); use %s",
                      (long long)run->clock.step + 1, s->t, f->residual,
                      isfinite(f->spent) ? "a smaller steps.energy"
                                         : "steps.control: energy, which can follow a falling load");
}

/* Sets the particles q to the positions between those in before[dim] (share 0) and those of p (share 1), and updates
 * their mirror images. q->x[dim] are arrays of their own; loads: list of mirror images. */
static void particles_place_between(struct particles *q, const struct particles *p, const struct loads *loads,
                                    real *const *before, real share)
{
    for (int d = 0; d < p->dim; d++)
        for (int64_t i = 0; i < p->n; i++) q->x[d][i] = before[d][i] + share * (p->x[d][i] - before[d][i]);
    loads_update_mirror_images_of_particles(loads, q);
}

/* Adds to the fracture energy the energy that neighbourhoods of state-based models have lost by softening since the
 * last equilibrium. What a bond loses depends on the path, which is taken as straight and divided such that no bond
 * is stretched by more than PART_GROWTH times its softening in a part. loads: list of mirror images; before[dim]:
 * positions of the particles p at the last equilibrium [m]. Does nothing in bond-based models. b: all bonds. */
static void family_losses_add(struct bonds *b, const struct particles *p, const struct loads *loads,
                              real *const *before)
{
    struct particles midway = *p, end = *p;
    if (!b->soft.whole) return;
    for (int d = 0; d < p->dim; d++) {
        midway.x[d] = BARE("softening.midway", p->n_all, real);
        end.x[d] = BARE("softening.end", p->n_all, real);
    }
    particles_place_between(&midway, p, loads, before, 0);
    const real growth = bonds_largest_stretch_growth_per_softening_range(b, &midway, p);
    const int parts = (int)real_min(PATH_PARTS_MOST, ceil(real_max(1, growth / PART_GROWTH)));
    for (int k = 0; k < parts; k++) {
        particles_place_between(&midway, p, loads, before, (k + 0.5) / parts);
        particles_place_between(&end, p, loads, before, (k + 1.0) / parts);
        bonds_add_softening_losses_to_fracture_energy(b, &midway, &end, k == parts - 1);
    }
    for (int d = 0; d < p->dim; d++) memory_free(midway.x[d]), memory_free(end.x[d]);
}

/* Searches for the equilibrium that ends a load step of the run. spent: energy that bonds shall dissipate in the step
 * [J]; INFINITY if the loads are those of pseudo-time t [s]. With given loads, work that exceeds the growth of
 * energies counts as lost in motion, which is not resolved. If the search fails, restores the state before it and
 * returns the status of the search: FAILED, with a message, if there is no equilibrium. */
static status step_try(struct run *run, real t, real spent)
{
    struct statics *s = run->statics;
    struct memory_archive saved;
    struct work_account account;
    struct search f = {&s->balance, &run->bonds, &run->part, &run->source, .spent = spent, .end = t};
    trial_equilibrium_begin(run, &saved);
    work_account_store_initial_equilibrium(&account, s, &run->part);
    const real worked = run->loads.work + run->loads.constraint_work,
               stored = run->kernels.bond_energy(&run->bonds, &run->part, NULL) + bonds_fracture_energy(&run->bonds);
    const status found = search_run(run, &f);
    memory_free(f.list.bond);
    if (found != OK) {
        work_account_free(&account);
        bonds_restore_max_stretches_at_last_equilibrium(&run->bonds);
        trial_equilibrium_end(run, &saved, false, NULL);
        cracks_close_and_open(s, &f);
        return found;
    }
    trial_equilibrium_end(run, &saved, true, NULL);
    family_losses_add(&run->bonds, &run->part, &run->loads, account.x);
    work_account_add_work_and_estimate_error(&account, s, &run->part, &run->loads, 0);
    const real lost = run->loads.work + run->loads.constraint_work - worked + stored -
                      run->kernels.bond_energy(&run->bonds, &run->part, NULL) - bonds_fracture_energy(&run->bonds);
    if (!isfinite(spent)) s->balance.lost += real_max(0, lost), run->damped += real_max(0, lost);
    bonds_store_max_stretches_at_last_equilibrium(&run->bonds, &run->part, &run->source.limit);
    return OK;
}

real softening_materials_least_toughness(const struct scene *s, const struct bond_source *bond_source)
{
    real least = INFINITY;
    for (int m = 0; m < s->materials; m++)
        if (material_has_softening_bonds(&s->material[m]))
            least = real_min(least, toughness_of_material(&bond_source->family, s->model, &s->material[m]));
    return least;
}

/* Makes one load step of the run, whose bonds soften. Under energy control the bonds dissipate a given energy in each
 * step; if no equilibrium is found, the step is repeated with a half, a quarter .. of it, in at most TRIES_MOST
 * attempts. The first step dissipates only the fraction FIRST_SHARE, since on a coarse lattice the loads may be largest
 * where bonds begin to soften. pseudo_time: end of the step under other controls [s]. Returns FAILED, with a message,
 * if no equilibrium is found. */
status load_step_solve_with_softening_bonds(struct run *run, real pseudo_time)
{
    struct statics *s = run->statics;
    const real toughness = softening_materials_least_toughness(run->scene, &run->source),
               given = run->scene->steps.energy;
    const real before = bonds_fracture_energy(&run->bonds);
    const bool by_energy = run->scene->steps.control == CONTROL_ENERGY;
    int64_t ended = 0;
    if (by_energy) pseudo_time = run->scene->duration;
    real spent = !by_energy  ? INFINITY
                 : given > 0 ? given
                             : STEP_SPACINGS * toughness * crack_area_of_growth_by_one_spacing(run);
    if (before == 0) spent *= FIRST_SHARE;
    do {
        bonds_start_softening_at_strength_surface(&run->bonds, &run->part, &run->source);
        bonds_store_max_stretches_at_last_equilibrium(&run->bonds, &run->part, &run->source.limit);
        status tried = step_try(run, pseudo_time, spent);
        for (int k = 1; k < TRIES_MOST && tried == FAILED && by_energy; k++, spent *= 0.5)
            tried = step_try(run, pseudo_time, 0.5 * spent);
        TRY(tried);
        ended += bonds_end_softened(&run->bonds, &run->part);
        s->precondition_stale = true, s->fragments_stale |= ended > 0;
        reactions_compute_and_store(s, &run->part, &run->loads);
        s->solutions++;
    } while (!by_energy && s->t < pseudo_time);
    s->record.broken += (bonds_fracture_energy(&run->bonds) - before) / toughness;
    s->stretch_ratio = bonds_largest_stretch_ratio(&run->bonds, &run->part, &run->source.limit);
    const real size = statics_norm_of_prescribed_loads(run, s->t);
    s->record.load_most = real_max(s->record.load_most, size);
    s->severs = by_energy && size < THROUGH * s->record.load_most;
    return equilibrium_convert_points_to_pd_and_solve_again(run, ended);
}
