/* Warns of pre-cracks that have no effect or cannot grow, and of probes of cracks where nothing can break. */
#include <math.h>

#include "base/memory.h"
#include "engine_internal.h"
#include "fracture/fracture_part.h"

#define FAR_OUTSIDE 0.1 /* distance of an end of a crack from all particles that is reported [longest edges] */
enum { ALONG = 32 };    /* positions along a segment, or along each of two sides of a triangle, of a crack */

/* Returns true if at least one of the bonds b is broken. Called at the start of a run, when only pre-cracks have broken
 * bonds. */
static bool bonds_are_cut(const struct bonds *b)
{
    for (int64_t row = 0; row < b->rows; row++)
        for (struct bond_iterator it = bond_iterator_of_row(b, row); bond_iterator_advance(&it);)
            if (it.bond.inverse_length < 0) return true;
    return false;
}

/* Returns true if crack c passes within `reach` [m] of the reference position of a particle of p, so that it may cut a
 * bond. reach: length of the longest bonds. */
static bool crack_meets_particles(const struct crack *c, const struct particles *p, real reach)
{
    bool meets = false;
    for (int64_t i = 0; i < p->n && !meets; i++) {
        real X[DIM_MAX];
        particle_reference_position(p, i, X);
        meets = crack_may_cut_bonds_near(c, X, reach, p->dim);
    }
    return meets;
}

/* Returns the distance of the position X[dim] [m] from the nearest particle of p [m]; INFINITY without particles. */
static real particle_distance(const struct particles *p, const real *X)
{
    real least2 = INFINITY;
#pragma omp parallel for schedule(static) reduction(min : least2)
    for (int64_t i = 0; i < p->n; i++) {
        real r2 = 0;
        for (int d = 0; d < p->dim; d++) r2 += square(p->X[d][i] - X[d]);
        least2 = real_min(least2, r2);
    }
    return sqrt(least2);
}

/* Returns the least distance of crack c from a particle of p [m]. It is computed from sample positions on the segments
 * of a line or, for a polygon in 3D, on the triangles between its first corner and its sides. */
static real crack_distance(const struct crack *c, const struct particles *p)
{
    real least = INFINITY;
    const bool polygon = p->dim > 2 && c->n > 2;
    for (int k = polygon ? 2 : 1; k < c->n; k++) {
        const real *from = c->corner[polygon ? 0 : k - 1], *one = c->corner[polygon ? k - 1 : k], *two = c->corner[k];
        for (int a = 0; a <= ALONG; a++)
            for (int b = 0; b <= (polygon ? ALONG - a : 0); b++) {
                real X[DIM_MAX];
                for (int d = 0; d < p->dim; d++)
                    X[d] = from[d] + (a * (one[d] - from[d]) + b * (two[d] - from[d])) / ALONG;
                least = real_min(least, particle_distance(p, X));
            }
    }
    return least;
}

/* Adds warnings to *to about the first pre-cracks of scene s that are farther from all particles p than `reach` [m],
 * the length of the longest bonds. At most NAMED cracks are reported. If the scene has more than SEARCHED cracks, only
 * their bounding boxes are compared with that of the particles. Returns true if a crack is that far away; false in
 * 1D. */
static bool warn_of_far_cracks(const struct scene *s, const struct particles *p, real reach, struct warnings *to)
{
    enum { SEARCHED = 16, NAMED = 3 };
    real low[DIM_MAX] = {0}, high[DIM_MAX] = {0};
    int far = 0;
    for (int d = 0; d < s->dim && s->cracks > SEARCHED; d++) particles_coordinate_range(p, p->n, d, &low[d], &high[d]);
    for (int k = 0; k < s->cracks && s->dim > 1 && far < NAMED; k++) {
        const struct crack *c = &s->crack[k];
        if (s->cracks > SEARCHED ? crack_overlaps_box(c, low, high, s->dim, reach) : crack_meets_particles(c, p, reach))
            continue;
        far++;
        warnings_add_if_new(to,
                            "crack %d is outside all bodies, %.3g m from the nearest particle, and has no effect; "
                            "check its coordinates and their unit (m if none is written)",
                            k + 1, crack_distance(c, p));
    }
    return far > 0;
}

/* Returns true if pre-crack c can grow: a tip of `tips` starts at one of its ends, in 3D at the front of any pre-crack.
 * Also true if the list of tips is full. */
static bool can_grow(const struct crack_tips *tips, const struct crack *c)
{
    bool can = tips->n == TIPS_MAX;
    for (int k = 0; k < tips->n && tips->dim == 3; k++) can |= tips->tip[k].from_crack;
    return can || (tips->dim == 2 && (tips_any_started_at_precrack_end(tips, c->corner[0]) ||
                                      tips_any_started_at_precrack_end(tips, c->corner[c->n - 1])));
}

/* Returns the number of particles within `reach` [m] of the position X[dim] [m], and adds to *loose the number of those
 * whose motion the supports do not prescribe in all components. prescribed[p->n]: bit d is set if component d of a
 * particle is prescribed. */
static int64_t particles_near(const struct particles *p, const real *X, real reach, const uint8_t *prescribed,
                              int64_t *loose)
{
    int64_t near = 0;
    for (int64_t i = 0; i < p->n; i++) {
        real r2 = 0;
        for (int d = 0; d < p->dim; d++) r2 += square(p->X[d][i] - X[d]);
        if (r2 > square(reach)) continue;
        near++, *loose += (prescribed[i] & ((1u << p->dim) - 1)) != (1u << p->dim) - 1;
    }
    return near;
}

/* Adds a warning to *to about pre-crack number k, from 0, of scene s, which cannot grow, for one of two reasons:
 * supports prescribe the motion of all particles within `reach` [m] of its ends, or an end is outside of all bodies by
 * more than `reach` and FAR_OUTSIDE * longest. longest: longest edge of the box around all particles [m];
 * prescribed[p->n]: bit d is set if component d of a particle is prescribed. */
static void warn_of_fixed_crack(const struct scene *s, const struct particles *p, int k, real reach, real longest,
                                const uint8_t *prescribed, struct warnings *to)
{
    const struct crack *c = &s->crack[k];
    int64_t near = 0, loose = 0;
    for (int end = 0; end < c->n; end++) {
        const real outside = particle_distance(p, c->corner[end]);
        near += particles_near(p, c->corner[end], reach, prescribed, &loose);
        if (outside > real_max(reach, FAR_OUTSIDE * longest)) {
            warnings_add_if_new(to,
                                "crack %d has no end inside a body, so it cannot grow and may cut the body in two; its "
                                "end at (%s) m is %.3g m from the nearest particle: check its coordinates and their "
                                "unit (m if none is written); if this is intended, add accept: [growth]",
                                k + 1, position_text(c->corner[end], p->dim, 6).text, outside);
            return;
        }
    }
    if (near > 0 && loose == 0)
        warnings_add_if_new(
            to,
            "crack %d cannot grow: supports prescribe the motion of all %lld particles within a horizon of its ends; "
            "use a smaller depth or region for these supports; if this is intended, add accept: [growth]",
            k + 1, (long long)near);
}

/* Adds warnings to *to about the first pre-cracks of scene s that cannot grow because supports prescribe the motion of
 * the particles p around them, or that end far outside of all bodies. Does nothing if some particles of the bodies are
 * not created (p->n < p->n_body), or in 1D. loads: with the supports; tips: crack tips at the start; reach: length of
 * the longest bonds [m]. */
static void warn_of_fixed_cracks(const struct scene *s, const struct particles *p, const struct loads *loads,
                                 const struct crack_tips *tips, real reach, struct warnings *to)
{
    enum { CRACKS_MOST = 16 };
    if (p->dim == 1 || scene_silences_warning(s, ACCEPT_GROWTH)) return;
    uint8_t *prescribed = loads_find_prescribed_motion_components(loads, p);
    const real longest = particles_bounding_box_longest_edge(p);
    for (int k = 0; k < s->cracks_given && k < CRACKS_MOST && p->n == p->n_body; k++)
        if (!can_grow(tips, &s->crack[k])) warn_of_fixed_crack(s, p, k, reach, longest, prescribed, to);
    memory_free(prescribed);
}

/* Adds warnings to *to about probes of crack tips and first breaks in scene s if no bond can break, as with method mpm,
 * and no crack is grown by a rule. */
static void warn_of_unbreakable(const struct scene *s, struct warnings *to)
{
    const bool breaks = s->method != METHOD_MPM && (scene_bonds_can_break(s) || s->growths > 0);
    for (int k = 0; k < s->probes && !breaks; k++)
        if (s->probe[k].kind == PROBE_TIP || s->probe[k].kind == PROBE_BREAK)
            warnings_add_if_new(
                to, "probe %s will have no result, because no bond can break: %s", s->probe[k].name,
                s->method == METHOD_MPM
                    ? "method: mpm has no bonds; set method: pd or adaptive"
                    : "no material has an energy_release_rate, toughness or critical_stretch; give one of them");
}

/* Adds warnings to *to about cracks with prescribed growth in scene s that begin farther than a horizon from all
 * particles p or after the end of the run, grow by less than a spacing, or grow faster than the fastest Rayleigh waves
 * of all materials. The position is not checked if some particles of the bodies are not created (p->n < p->n_body). */
static void warn_of_growths(const struct scene *s, const struct particles *p, struct warnings *to)
{
    real rayleigh = 0;
    for (int m = 0; m < s->materials; m++) rayleigh = real_max(rayleigh, s->material[m].rayleigh_speed);
    for (int k = 0; k < s->growths; k++) {
        const struct growth_rule *g = &s->growth[k];
        const real outside = particle_distance(p, g->at), growth = g->speed * (s->duration - g->start);
        if (outside > s->horizon * s->spacing && p->n == p->n_body)
            warnings_add_if_new(to,
                                "growth %s: its tip starts %.3g m from the nearest particle, outside all bodies; check "
                                "`at` and its unit (m if none is written)",
                                g->name, outside);
        if (g->start >= s->duration)
            warnings_add_if_new(to,
                                "growth %s: starts at %.3g s, after the duration of %.3g s, so it has no effect; check "
                                "the unit of start (s if none is written)",
                                g->name, g->start, s->duration);
        else if (growth < s->spacing)
            warnings_add_if_new(to,
                                "growth %s: at %.3g m/s the crack grows by %.3g m in the run, less than a spacing of "
                                "%.3g m; check the units of speed (m/s) and duration",
                                g->name, g->speed, growth, s->spacing);
        if (g->speed > rayleigh && rayleigh > 0 && !scene_silences_warning(s, ACCEPT_RAYLEIGH))
            warnings_add_if_new(
                to,
                "growth %s: %.3g m/s is %.3g times the speed of Rayleigh waves, %.4g m/s, the limit for an opening "
                "crack; check the unit of speed (m/s); if this is intended, add accept: [rayleigh]",
                g->name, g->speed, g->speed / rayleigh, rayleigh);
    }
}

void run_warn_of_ineffective_precracks(const struct scene *s, const struct particles *p, const struct cells *cells,
                                       const struct bonds *b, const struct loads *loads, real longest_bond,
                                       real wave_speed, struct warnings *warnings)
{
    struct crack_tips tips;
    warn_of_unbreakable(s, warnings);
    warn_of_growths(s, p, warnings);
    if (s->method == METHOD_MPM || s->cracks == 0 || warn_of_far_cracks(s, p, longest_bond, warnings)) return;
    tips_make_at_precrack_ends(&tips, p, cells, s->crack, s->cracks, s->spacing, 0);
    if (!bonds_are_cut(b))
        warnings_add_if_new(warnings, "the pre-cracks cut no bond and have no effect; check that they are inside the "
                                      "body, and their unit (m if none is written)");
    else
        warn_of_fixed_cracks(s, p, loads, &tips, longest_bond, warnings);
    run_warn_if_waves_do_not_reach_crack_tips(s, p, loads, &tips, wave_speed, warnings);
    run_warn_of_precracks_pressed_shut_by_loads(s, p, warnings);
    tips_free(&tips);
}
