/* Warns of loads that cannot open the pre-cracks: their waves do not arrive within the run, or they press them shut. */
#include <math.h>
#include <stdio.h>

#include "engine_internal.h"
#include "fracture/tips.h"

/* Largest extent of a crack along an axis, divided by its largest extent along any axis, with which the crack counts as
 * lying across this axis [1]. */
#define ACROSS 0.15

/* Returns true if only the boundaries of scene s set its bodies in motion: there are no initial states, rigid bodies or
 * cracks that grow by a rule, the particles p are at rest, and all of them are created (p->n == p->n_body). */
static bool only_boundaries_load(const struct scene *s, const struct particles *p)
{
    bool only = s->initials == 0 && s->rigids == 0 && s->growths == 0 && p->n == p->n_body;
    for (int d = 0; d < s->dim; d++)
        for (int64_t i = 0; i < p->n && only; i++) only = p->v[d][i] == 0;
    return only;
}

/* ---- waves ------------------------------------------------------------------------------------------------------- */

/* Returns the distance of the nearest particle (of p) on which load l acts from the position where the crack of `tip`
 * starts, in 3D from sample points of its front [m]. */
static real load_distance(const struct load *l, const struct particles *p, const struct crack_tip *tip)
{
    enum { POINTS = 4 }; /* along each half of the front */
    real least2 = INFINITY;
    for (int m = p->dim == 3 ? -POINTS : 0; m <= (p->dim == 3 ? POINTS : 0); m++)
        for (int64_t k = 0; k < l->n; k++) {
            real r2 = 0;
            for (int d = 0; d < p->dim; d++)
                r2 += square(p->X[d][l->particle[k]] - tip->origin[d] - tip->edge[d] * m / POINTS);
            least2 = real_min(least2, r2);
        }
    return sqrt(least2);
}

void run_warn_if_waves_do_not_reach_crack_tips(const struct scene *s, const struct particles *p,
                                               const struct loads *loads, const struct crack_tips *tips,
                                               real wave_speed, struct warnings *warnings)
{
    real distance = INFINITY;
    const real reach = wave_speed * s->duration;
    if (!scene_is_dynamic(s) || scene_silences_warning(s, ACCEPT_REACH) || !only_boundaries_load(s, p)) return;
    for (int b = 0; b < loads->n; b++) {
        const struct boundary *a = loads->load[b].boundary;
        const bool moves = a->kind == BOUNDARY_VELOCITY && !boundary_is_support_at_rest(a, s->dim);
        for (int k = 0; k < tips->n && (moves || boundary_applies_force(a)); k++)
            if (tips->tip[k].from_crack)
                distance = real_min(distance, load_distance(&loads->load[b], p, &tips->tip[k]));
    }
    if (!isfinite(distance) || distance <= reach + s->horizon * s->spacing) return;
    warnings_add_if_new(
        warnings,
        "duration: in %.3g s waves travel %.3g m, but the nearest end of a crack is %.3g m from the loads, so no crack "
        "can grow; use a duration of more than %.2g s; if this is intended, add accept: [reach]",
        s->duration, reach, distance, distance / wave_speed);
}

/* ---- signs ------------------------------------------------------------------------------------------------------- */

/* Returns true if boundary b is a traction on a whole face, given by numbers, that presses on it without shear until
 * the end of the run. With a region it may act on the wall of a hole, where it opens cracks. */
static bool presses(const struct boundary *b, int dim)
{
    bool normal = b->region.n == 0;
    if (b->kind != BOUNDARY_TRACTION || (b->time.kind != TIME_CONSTANT && b->time.kind != TIME_RAMP)) return false;
    for (int d = 0; d < dim; d++) normal = normal && b->formula[d].n == 0 && (d == b->face || b->value[d] == 0);
    return normal && b->value[b->face] * b->side < 0;
}

/* Returns true if crack c lies across axis number `axis`: its extent along this axis is at most ACROSS (0.15) times its
 * largest extent along any axis. */
static bool lies_across(const struct crack *c, int dim, int axis)
{
    real extent[DIM_MAX] = {0}, largest = 0;
    for (int d = 0; d < dim; d++) {
        real low = INFINITY, high = -INFINITY;
        for (int k = 0; k < c->n; k++) low = real_min(low, c->corner[k][d]), high = real_max(high, c->corner[k][d]);
        extent[d] = high - low, largest = real_max(largest, extent[d]);
    }
    return extent[axis] <= ACROSS * largest;
}

void run_warn_of_precracks_pressed_shut_by_loads(const struct scene *s, const struct particles *p,
                                                 struct warnings *warnings)
{
    const struct boundary *load = NULL;
    bool all = s->cracks_given > 0 && s->dim > 1 && scene_bonds_can_break(s) && only_boundaries_load(s, p);
    for (int k = 0; k < s->boundaries && all; k++) {
        const struct boundary *b = &s->boundary[k];
        if (boundary_is_support_at_rest(b, s->dim) || b->kind == BOUNDARY_MIRROR || b->kind == BOUNDARY_ABSORBING)
            continue;
        all = presses(b, s->dim) && (!load || b->face == load->face);
        load = b;
    }
    for (int k = 0; k < s->cracks_given && all && load; k++) all = lies_across(&s->crack[k], s->dim, load->face);
    if (!all || !load || scene_silences_warning(s, ACCEPT_GROWTH)) return;
    warnings_add_if_new(
        warnings,
        "boundary %s: its traction of %.3g Pa on %c%c closes crack 1, as all loads do, so the crack cannot grow; give "
        "an outward traction, %.3g Pa, to open it; if this is intended, add accept: [growth]",
        load->name, load->value[load->face], "xyz"[load->face], load -> side > 0 ? '+' : '-', -load->value[load->face]);
}
