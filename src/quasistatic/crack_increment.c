/* Determines the crack increments of load steps: which bonds break together, and under which load.
 *
 * If single bonds broke, the load at which the next bond reaches its critical stretch would oscillate by 30 % while the
 * tip grows by one spacing, on any lattice (lattice trapping: Thomson, Hsieh & Rana 1971). With a horizon of 3
 * spacings, the mean and the envelope of these loads correspond to energy release rates 18 % and 50 % above G_c. A
 * crack therefore grows by increments of two spacings: bonds break in the order of their ratios of stretch to critical
 * stretch until the crack area that they represent is that long. The area of a bond is its energy at the critical
 * stretch divided by the crack energy per area of its material. An increment is made at the load at which the body
 * releases as much energy as it costs: Griffith's criterion for finite increments (as in Leguillon 2002, with a stress
 * near the strength as second condition). The path follows from the bonds.
 *
 * The energy release of an increment belongs to its middle; the load of the state between two increments follows from
 * the sum of both. At the tip of a pre-crack the previous increment is fictitious, extrapolated from the first two. The
 * load of a state is thus exact for its crack length to second order in the increment. The increment itself is made at
 * the load at which it alone is in balance, so that no energy is left over; if loads can only grow, at the larger one
 * of both loads. */
#include <math.h>

#include "crack_increment.h"
#include "balance.h"
#include "sif_cracks.h"
#include "load_size.h"
#include "stretch_ratio.h"
#include "unconstrained.h"
#include "system.h"
#include "trial.h"

#include "fracture/fracture_part.h"

#define STRESSED 0.85        /* ratio of stretch to critical stretch below which no first increment is computed [1] */
#define STRESSED_FURTHER 0.5 /* such a ratio for later increments: bonds relax between increments [1] */
#define LEFT 0.3             /* stretch ratio below which no further bond of an increment breaks, whatever its cost */
#define REMNANT 0.3    /* share of the largest stretch ratio within which bonds break at the end of SIF-driven fronts */
#define DUE_ERROR 2e-3 /* relative error of the load size of an increment */

/* INCREMENT_SPACINGS: length of a crack increment [spacings]; SECANTS_MOST: largest number of secant steps in the
 * search for the load size of an increment. */
enum { INCREMENT_SPACINGS = 2, SECANTS_MOST = 6 };
/* Number of spacings of crack growth for which the section of a bar (space: line) counts, since it breaks as a whole.
 * With the default load steps, this value gives the largest load of a bar with an error of 1 %. */
#define SPACINGS_OF_BAR 25

/* ---- area of a crack increment ----------------------------------------------------------------------------------- */

/* Returns the fraction of a crack area whose energy belongs to the modelled body: 1/2 if all cracks `tips` lie on
 * planes of symmetry of bond_source, else 1. plane_axis: only planes perpendicular to this axis count; -1: all. */
real crack_area_fraction_inside_modelled_body(const struct crack_tips *tips, const struct bond_source *bond_source,
                                              int plane_axis)
{
    bool on = tips->n > 0;
    for (int k = 0; k < tips->n && on; k++) {
        bool any = false;
        for (int m = 0; m < bond_source->mirrors; m++)
            any |= (plane_axis < 0 || bond_source->mirror[m].axis == plane_axis) &&
                   tip_grows_on_mirror_plane(tips, &tips->tip[k], &bond_source->mirror[m], 1);
        on = any;
    }
    return on ? 0.5 : 1;
}

/* Returns the length of the crack front in 3D [m]: the sum of the edges of the pre-cracks in t, at least one spacing
 * and at most the shortest side of the body p. That side counts twice if one of the planes of symmetry of `source`
 * lies along the crack and halves the body. Returns 1 for a plane body, whose thickness the scene gives separately. */
static real front_length(const struct crack_tips *t, const struct bond_source *source, const struct particles *p)
{
    const real h = source->family.spacing;
    real length = INFINITY, edges = 0, low, high;
    if (p->dim < 3) return 1;
    for (int d = 0; d < 3; d++) {
        particles_coordinate_range(p, p->n, d, &low, &high);
        length = real_min(length, (high - low + h) / crack_area_fraction_inside_modelled_body(t, source, d));
    }
    for (int k = 0; k < t->n; k++)
        if (t->tip[k].from_crack) edges += 2 * sqrt(dot(t->tip[k].edge, t->tip[k].edge, 3));
    return edges > 0 ? real_min(length, real_max(edges, h)) : length;
}

/* Returns the area of a crack increment of INCREMENT_SPACINGS spacings [m^2]: length times thickness (or section) of
 * the scene s times `front`, the length of the crack front in 3D [m], 1 for a plane body. Half of that for cracks t on
 * a plane of symmetry (a mirror of `source`). */
static real increment_area(const struct scene *s, const struct crack_tips *t, const struct bond_source *source,
                           real front)
{
    const real ahead = INCREMENT_SPACINGS * (s->dim > 1 ? s->spacing : 1);
    return crack_area_fraction_inside_modelled_body(t, source, -1) * ahead * scene_cross_section_or_thickness(s) *
           front;
}

real crack_area_of_growth_by_one_spacing(const struct run *run)
{
    const struct crack_tips *t = &run->fracture->tips;
    if (run->part.dim == 1) return scene_cross_section_or_thickness(run->scene) / SPACINGS_OF_BAR;
    return increment_area(run->scene, t, &run->source, front_length(t, &run->source, &run->part)) / INCREMENT_SPACINGS;
}

/* Returns how many pairs of bonds may break before the next equilibrium is found: the key `steps.breaks` of scene s for
 * each spacing of the crack front. front: length of the crack front [m], used in 3D only. */
static int64_t breaks_most(const struct scene *s, real front)
{
    const real along = s->dim < 3 ? 1 : front / s->spacing;
    return (int64_t)(s->steps.breaks * real_max(1, along));
}

/* ---- increments -------------------------------------------------------------------------------------------------- */

/* Makes one crack increment of the run (a short growth of the crack) as a trial at the present pseudo-time: breaks the
 * bonds with the largest stretch ratios in batches, finds the equilibrium after each batch, and appends the bonds to
 * run->statics->next. a->cost: receives the energy that the bonds cost [J]; a->release: the energy that the body
 * releases, divided by the square of the load size (norm of prescribed displacements or forces). In 3D, bonds that the
 * fronts of SIF-driven cracks (directed by stress-intensity factors) have not reached break in larger batches, because
 * no load depends on the path there. Returns FAILED, with a message, if an equilibrium is not found. */
static status increment_break_try(struct run *run, struct crack_increment *a)
{
    struct statics *s = run->statics;
    const struct crack_tips *t = &run->fracture->tips;
    const real before = statics_energy_released_since_start(s, &run->bonds), given = run->scene->steps.energy;
    const real cost = given > 0 ? given * (1 - 1e-3) : INFINITY, front = front_length(t, &run->source, &run->part);
    const real wide = increment_area(run->scene, t, &run->source, front) * (1 - 1e-3);
    const int64_t most = breaks_most(run->scene, front);
    const bool remnant = run->part.dim == 3 && s->sif.segments > 0;
    const real within = remnant ? real_max(REMNANT, run->scene->steps.within) : run->scene->steps.within;
    real area = 0;
    *a = (struct crack_increment){0};
    while ((given > 0 ? a->cost < cost : area < wide) && s->stretch_ratio > LEFT) {
        if (bonds_break_overstretched(run, within, most, &a->cost, &area) == 0) break;
        if (run->scene->steps.control == CONTROL_ENERGY) {
            unconstrained_fragments_find(run);
            s->severs = unconstrained_fragments_check_force_balance(s, &run->part, false, run->clock.step + 1) != OK;
            if (s->severs) break;
        }
        TRY(equilibrium_find_at_time(run, s->t));
    }
    a->release = (statics_energy_released_since_start(s, &run->bonds) - before) /
                 square(statics_norm_of_prescribed_loads(run, s->t));
    return OK;
}

/* Returns true if one of the tips t belongs to a pre-crack and no crack increment has been made (statics->behind, the
 * previous increment, is empty). */
static bool pre_crack_unbroken(const struct crack_tips *t, const struct statics *statics)
{
    bool any = false;
    for (int k = 0; k < t->n; k++) any |= t->tip[k].from_crack;
    return any && statics->behind.cost == 0;
}

/* Determines the next crack increment of the run under the present loads. SIF-driven tips (growth direction from
 * stress-intensity factors) determine it, if there are any. Otherwise, or if bonds elsewhere exceed their critical
 * stretch, it is found by a trial in which bonds break and which is undone. stressed: smallest stretch ratio (stretch
 * divided by critical stretch) for which the trial is made. Returns FAILED, with a message, if a trial equilibrium is
 * not found. */
static status increment_find_now(struct run *run, real stressed)
{
    struct statics *s = run->statics;
    struct memory_archive saved;
    struct crack_increment second;
    if (sif_cracks_find_tips_and_test_if_any_can_grow(run)) {
        TRY(sif_cracks_find_increment_by_trial_equilibria(run));
        if (s->next.n > 0 || s->stretch_ratio <= 1) return OK; /* else bonds break away from the tips */
    }
    if (s->next.n > 0 || s->stretch_ratio < stressed) return OK;
    trial_equilibrium_begin(run, &saved);
    s->next.n = 0;
    status tried = increment_break_try(run, &s->ahead);
    const int64_t bonds = s->next.n;
    if (tried == OK && bonds > 0 && pre_crack_unbroken(&run->fracture->tips, s)) {
        tried = increment_break_try(run, &second);
        if (second.cost > 0) s->behind = crack_increment_extrapolate_predecessor_of_first(&s->ahead, &second);
    }
    trial_equilibrium_end(run, &saved, false, &s->next);
    s->next.n = bonds;
    s->due = two_crack_increments_load_size_at_energy_balance(&s->ahead, &s->behind);
    return tried;
}

/* Returns the smallest stretch ratio (stretch of a bond divided by its critical stretch) at which the next crack
 * increment is searched for under the present loads: STRESSED_FURTHER, the lower limit, once an increment has been
 * made (s->behind), else STRESSED. */
static real stretch_ratio_of_trial(const struct statics *s) { return s->behind.cost > 0 ? STRESSED_FURTHER : STRESSED; }

/* Determines the next crack increment of the run at the load size (norm of prescribed displacements or forces) at which
 * it will be made, by the secant method. Needed where the strain is not proportional to the load size, as supports or
 * rigid bodies move before anything is in contact: the energy release grows with the square of the strain. The bonds
 * may be stretched less at that load size than a trial under the present loads requires. Afterwards restores the
 * present equilibrium or, if material points have been converted, finds the equilibrium of the initial pseudo-time
 * again. If the load size is so small that no bond would break, the increment is that of the present loads. Returns
 * FAILED, with a message, if an equilibrium is not found. */
static status increment_find_at_due(struct run *run)
{
    struct statics *s = run->statics;
    struct memory_archive saved;
    const real from = s->t;
    const int64_t particles = s->particles;
    trial_equilibrium_begin(run, &saved);
    status found = OK;
    real previous = 0, previous_share = NAN;
    for (int k = 0; k < SECANTS_MOST && found == OK && s->next.n > 0; k++) {
        const real size = statics_norm_of_prescribed_loads(run, s->t), share = size / s->due;
        if (fabs(share - 1) <= DUE_ERROR || !isfinite(s->due)) break;
        const real secant = size + (1 - share) * (size - previous) / (share - previous_share);
        found = equilibrium_find_at_time(run, statics_find_pseudo_time_at_load_size(run, secant > 0 ? secant : s->due));
        previous = size, previous_share = share;
        s->next.n = 0;
        if (found == OK) found = increment_find_now(run, 0);
    }
    const bool converted = s->particles != particles; /* points that converted cannot be restored */
    trial_equilibrium_end(run, &saved, converted, NULL);
    if (converted && found == OK) found = equilibrium_find_at_time(run, from);
    return found == OK && s->next.n == 0 ? increment_find_now(run, stretch_ratio_of_trial(s)) : found;
}

/* Finds the bonds of the next crack increment of the run (run->statics->next) and the load size (norm of prescribed
 * displacements or forces) at which it is made. If anything is in contact, evaluates the increment again at that load
 * size, because the energy release is then not proportional to the square of the load size. Returns FAILED, with a
 * message, if a trial equilibrium is not found. */
status crack_increment_find_by_trial_equilibria(struct run *run)
{
    TRY(increment_find_now(run, stretch_ratio_of_trial(run->statics)));
    return run->statics->in_contact && run->statics->next.n > 0 ? increment_find_at_due(run) : OK;
}

status crack_increment_apply_at_energy_balance(struct run *run)
{
    const real size = crack_increment_load_size_at_energy_balance(&run->statics->ahead);
    if (isfinite(size)) TRY(equilibrium_find_at_time(run, statics_find_pseudo_time_at_load_size(run, size)));
    return crack_increment_find_new_equilibrium(run, crack_increment_break_bonds_and_move_tips(run));
}

int64_t crack_increment_break_bonds_and_move_tips(struct run *run)
{
    struct statics *s = run->statics;
    const int64_t broken = s->next.n;
    bonds_break_listed(run, &s->next);
    sif_tips_move_those_in_crack_increment(&s->sif, &run->part);
    s->behind = s->ahead, s->ahead = (struct crack_increment){0};
    s->next.n = 0;
    return broken;
}

status crack_increment_find_new_equilibrium(struct run *run, int64_t broken_bonds)
{
    TRY(equilibrium_find_at_time(run, run->statics->t));
    plastic_state_save(&run->statics->plastic, &run->bonds, &run->part, run->optional);
    return equilibrium_convert_points_to_pd_and_solve_again(run, broken_bonds);
}
