/* Advances cracks that grow at a prescribed speed or are controlled by stress-intensity factors (SIF), and gradually
 * reduces the weights of the bonds behind their tips. */
#include "fracture/growth.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "kernels/kernels.h"
#include "base/memory.h"

#define FASTEST 0.9 /* largest tip speed divided by the Rayleigh speed [1] */
/* Tip speed divided by the Rayleigh speed below which the fields of a crack at rest are used: factors differ by
 * 1e-4. */
#define SLOWEST 0.01
#define SMOOTHING 0.3 /* averaging time of the speed divided by the settling time T (growth.h) [1] */

void growing_crack_make(struct growing_crack *g, const struct growth_rule *rule)
{
    *g = (struct growing_crack){.rule = rule, .start_time = NAN, .intensity = NAN};
    for (int d = 0; d < 2; d++) g->place[d] = rule->at[d], g->along[d] = g->heading[d] = rule->direction[d];
}

void growing_crack_free(struct growing_crack *g)
{
    memory_free(g->fading);
    memset(g, 0, sizeof *g);
}

/* ---- target speed of a crack that follows its toughness ---------------------------------------------------------- */

/* Updates g->target_speed, the speed that the tip of crack g should have. It is the solution v of the crack-tip
 * equation of motion K = k(v) K_c; this function makes one secant step towards v and smooths the result in time. K:
 * measured stress-intensity factor g->intensity; k(v): factor by which a speed v reduces the stress-intensity factor of
 * a crack at rest; K_c: toughness. control: elastic constants and time of the new stress-intensity factors; settling:
 * time constant of the smoothing [s]. */
static void target_speed_find(struct growing_crack *g, const struct growth_control *control, real settling)
{
    const struct crack_medium *m = &control->medium;
    const real bound = FASTEST * m->rayleigh,
               most = isnan(g->rule->fastest) ? bound : real_min(g->rule->fastest, bound);
    real wanted = 0;
    if (g->intensity > 0) {
        const real filtered_speed = crack_moving_to_resting_sif_ratio(m, SPEED_EXACT, g->filtered_speed);
        wanted = crack_speed_from_sif_ratio(m, filtered_speed * g->rule->toughness / g->intensity, most);
    }
    g->target_speed += (wanted - g->target_speed) * -expm1(-(control->time - g->control_time) / (SMOOTHING * settling));
    if (wanted == 0 && g->target_speed < SLOWEST * m->rayleigh) g->target_speed = 0;
}

/* Updates the speeds of crack g if its toughness controls its speed; does nothing otherwise. g->filtered_speed follows
 * g->speed, the tip speed in the last step of length dt [s], with a delay of the order of the time in which a Rayleigh
 * wave travels one horizon. g->target_speed follows from new stress-intensity factors after the start of growth.
 * control: these factors; NULL: not known, the target speed becomes 0; horizon: of the bonds [m]; t: present time [s].
 * Call it before g->speed is overwritten. */
static void target_speed_update(struct growing_crack *g, const struct growth_control *control, real horizon, real t,
                                real dt)
{
    if (!growth_rule_controls_speed_by_toughness(g->rule)) return;
    if (!control) {
        g->target_speed = 0;
        return;
    }
    const real settling = horizon / control->medium.rayleigh;
    g->filtered_speed += (g->speed - g->filtered_speed) * -expm1(-dt / settling);
    if (t >= g->rule->start && control->time > g->control_time) target_speed_find(g, control, settling);
    g->control_time = control->time;
}

/* ---- growth and direction ---------------------------------------------------------------------------------------- */

/* Returns true if crack g grows at time t [s]: its start time has passed and it is shorter than its final length. If
 * stress-intensity factors control the crack, its target speed must also be positive or, at a prescribed speed, its
 * stress-intensity factor must reach the toughness. */
static bool grows(const struct growing_crack *g, real t)
{
    const struct growth_rule *r = g->rule;
    if (t < r->start || g->grown >= r->length) return false;
    if (!r->probe[0]) return true;
    if (growth_rule_controls_speed_by_toughness(r)) return g->target_speed > 0;
    return g->intensity >= r->toughness;
}

/* Sets g->heading, the direction in which the tip of crack g moves, to that of the largest hoop stress. control:
 * stress-intensity factors K_I and K_II, and the direction of the crack to which they refer. */
static void growth_turn(struct growing_crack *g, const struct growth_control *control)
{
    const real angle = crack_kink_angle_from_sif(control->factors.K), c = cos(angle), s = sin(angle);
    const real x = control->along[0], y = control->along[1];
    g->heading[0] = c * x - s * y, g->heading[1] = s * x + c * y;
}

/* Moves the tip of crack g by `increment` [m] along g->heading. The direction g->along, to which stress-intensity
 * factors refer, turns towards the heading by the share increment/smoothing of the difference, at most fully, where
 * `smoothing` is the length g->rule->smoothing or, if that is not given, a quarter of `horizon` [m]. */
static void growth_advance(struct growing_crack *g, real increment, real horizon)
{
    const real smoothing = isnan(g->rule->smoothing) ? 0.25 * horizon : g->rule->smoothing;
    const real share = increment < smoothing ? increment / smoothing : 1;
    real along[2];
    for (int d = 0; d < 2; d++) {
        g->place[d] += increment * g->heading[d];
        along[d] = g->along[d] + share * (g->heading[d] - g->along[d]);
    }
    const real length = hypot(along[0], along[1]);
    for (int d = 0; d < 2 && length > 0; d++) g->along[d] = along[d] / length;
    g->grown += increment;
}

/* ---- bonds that the tip crosses ---------------------------------------------------------------------------------- */

/* Returns true if the bond from particle i to particle j is in g->fading, the list of bonds behind the tip whose
 * weights decrease as crack g grows. The bond from j to i is a separate entry. */
static bool fades(const struct growing_crack *g, int32_t i, int32_t j)
{
    for (int64_t k = g->n - 1; k >= 0; k--)
        if (g->fading[k].i == i && g->fading[k].j == j) return true;
    return false;
}

/* Appends the bond from particle i to particle j to g->fading, the bonds behind the tip whose weights decrease as crack
 * g grows. w: present weight of the bond [1]; length: growth of the crack when its tip crosses the bond [m]. */
static void fading_add(struct growing_crack *g, int32_t i, int32_t j, real w, real length)
{
    GROW("growth.fading", g->fading, g->n + 1);
    g->fading[g->n++] = (struct fading){i, j, w, w, w, length};
}

/* Appends to g->fading, the bonds behind the tip whose weights decrease as crack g grows, the intact bonds (in b) of
 * particle i of p that cross `path`, the last increment of the tip. Skips bonds that are already in the list. */
static void cross_row(struct growing_crack *g, const struct bonds *b, const struct particles *p,
                      const struct crack *path, int32_t i)
{
    real X[DIM_MAX], Y[DIM_MAX];
    particle_reference_position(p, i, X);
    for (struct bond_iterator it = bond_iterator_of_row(b, b->row_of[i]); bond_iterator_advance(&it);) {
        const int32_t j = it.bond.nbr;
        if (it.bond.w == 0) continue;
        particle_reference_position(p, j, Y);
        if (crack_cuts_bond(path, X, Y, 2) && !fades(g, i, j)) fading_add(g, i, j, it.bond.w, g->grown);
    }
}

/* Finds the particles of p that may have bonds across the segment from from[2] to to[2] [m]: those whose distance from
 * `from` is at most the length of the segment plus the length of the longest bond. s: cells of the neighbour search.
 * *found: receives a list of their indices, which the caller frees with memory_free. Returns the number of these
 * particles. */
static int near_path(const real from[2], const real to[2], struct particles *p, const struct bond_source *s,
                     int32_t **found)
{
    real X[DIM_MAX] = {from[0], from[1]};
    const real radius = s->family.cutoff + hypot(to[0] - from[0], to[1] - from[1]);
    const int room = cells_list_particles_near_point(s->cells, p, X, radius, -1, NULL, 0);
    *found = NEW("growth.found", room, int32_t);
    return cells_list_particles_near_point(s->cells, p, X, radius, -1, *found, room);
}

/* Marks the material points of p within the cutoff (largest bond length) of the tip of crack g for conversion to
 * peridynamic particles, because cracks grow through bonds only. Returns the number of marked points. s: cells of the
 * neighbour search. */
static int claim(const struct growing_crack *g, struct particles *p, const struct bond_source *s)
{
    int32_t *found;
    const int n = near_path(g->place, g->place, p, s, &found);
    int claimed = 0;
    for (int k = 0; k < n; k++) {
        if (found[k] >= p->n || p->kind[found[k]] != KIND_MPM) continue;
        p->flag[found[k]] |= FLAG_LOST_BOND;
        claimed++;
    }
    memory_free(found);
    return claimed;
}

/* Appends bonds of b to g->fading, the list of bonds whose weights decrease as crack g grows: those between particles
 * of p that the tip has crossed on the straight path from from[2] [m] to its present position. Both directed bonds of a
 * pair of particles are appended, and also bonds across the images of the path in planes of symmetry (s->mirror). */
static void cross(struct growing_crack *g, const struct bonds *b, struct particles *p, const struct bond_source *s,
                  const real from[2])
{
    real corner[2][DIM_MAX] = {{from[0], from[1]}, {g->place[0], g->place[1]}};
    const struct crack straight = {.n = 2, .corner = corner};
    struct crack_list paths;
    cracks_make_mirror_images(&paths, &straight, 1, s->mirror, s->mirrors, s->family.cutoff,
                              ON_SURFACE * s->family.spacing);
    for (int w = 0; w < paths.n; w++) { /* the path and its images in mirrors nearby */
        const struct crack *path = &paths.crack[w];
        int32_t *found;
        const int n = near_path(path->corner[0], path->corner[1], p, s, &found);
        for (int k = 0; k < n; k++)
            if (found[k] < p->n) cross_row(g, b, p, path, found[k]);
        memory_free(found);
    }
    crack_list_free(&paths);
}

/* ---- fading ------------------------------------------------------------------------------------------------------ */

/* Returns the index of the directed bond from particle i to particle j in the arrays of b, where it may be written
 * (shared arrays are copied first if necessary); -1 if the bond is no longer stored. *row: receives the row of particle
 * i, its list of bonds. */
static int64_t growth_entry_of(struct bonds *b, int32_t i, int32_t j, int64_t *row)
{
    *row = b->row_of[i];
    for (struct bond_iterator it = bond_iterator_of_row(b, *row); bond_iterator_advance(&it);)
        if (it.bond.nbr == j) return bond_copy_on_write_and_return_array_index(b, it.row_block, it.k - 1, it.lane);
    return -1;
}

/* Resets the weights of the bonds of b in g->fading (bonds behind the tip whose weights decrease gradually) to those of
 * the previous step. `fade` then reduces them again and adds up the lost energy. Bonds that load has broken since then
 * are removed from the list. */
static void step_back(struct growing_crack *g, struct bonds *b)
{
    int64_t kept = 0, row;
    for (int64_t k = 0; k < g->n; k++) {
        struct fading *bond = &g->fading[k];
        const int64_t q = growth_entry_of(b, bond->i, bond->j, &row);
        if (q < 0 || (b->w[q] == 0 && bond->now > 0)) continue;
        b->w[q] = bond->before;
        bond_update_cached_data_after_modification(b, row, q);
        g->fading[kept++] = *bond;
    }
    g->n = kept;
}

/* Reduces the weights of the bonds of b in g->fading, which the tip has crossed, to w0 (1 - grown/damping)^exponent,
 * and removes bonds without weight from the list. grown: growth of the crack since its tip crossed the bond [m]; w0:
 * weight of the bond at that time; damping: length g->rule->damping, by default half the horizon of f. Computes the
 * lost energy at the present positions of p: half of the loss of the previous step and half of that of this step. Bonds
 * change one after the other, so that the losses add up to the whole energy. Returns the number of directed bonds whose
 * weight becomes 0. */
static int64_t fade(struct growing_crack *g, struct bonds *b, struct particles *p, const struct family *f)
{
    const struct growth_rule *r = g->rule;
    const real damping = isnan(r->damping) ? 0.5 * f->horizon : r->damping;
    int64_t kept = 0, released = 0, row;
    step_back(g, b);
    for (int64_t k = 0; k < g->n; k++) {
        struct fading bond = g->fading[k];
        const real grown = g->grown - bond.length;
        const real share = grown < damping ? pow(1 - grown / damping, r->exponent) : 0;
        const real next = bond.whole * share;
        const int64_t q = growth_entry_of(b, bond.i, bond.j, &row);
        if (next != bond.before) bond_fade(b, p, row, q, next);
        released += bond.now > 0 && next == 0;
        bond.before = bond.now, bond.now = next;
        if (bond.before > 0) g->fading[kept++] = bond;
    }
    g->n = kept;
    return released;
}

/* ---- a step ------------------------------------------------------------------------------------------------------ */

/* Advances growing crack g by one time step dt [s] at time t [s]: moves the tip by its speed times dt, appends the
 * bonds of b that the tip crosses to the list of fading bonds, and reduces the weights of all bonds in this list.
 * Material points of p around the tip are marked for conversion. source: data of bonds, with the cells of the neighbour
 * search; control: present stress-intensity factors, NULL if not known. Returns the number of directed bonds whose
 * weight has become 0. */
int64_t growing_crack_advance_and_count_cut_bonds(struct growing_crack *g, struct bonds *b, struct particles *p,
                                                  const struct bond_source *source,
                                                  const struct growth_control *control, real t, real dt)
{
    const real from[2] = {g->place[0], g->place[1]};
    g->intensity = control ? crack_equivalent_sif(control->factors.K) : NAN;
    target_speed_update(g, control, source->family.horizon, t, dt);
    g->speed = 0;
    /* a crack that starts among material points waits one step for the bonds that it will cross */
    if (grows(g, t) && (claim(g, p, source) == 0 || g->grown > 0)) {
        if (g->rule->probe[0]) growth_turn(g, control);
        g->speed = growth_rule_controls_speed_by_toughness(g->rule) ? g->target_speed : g->rule->speed;
        if (isnan(g->start_time)) g->start_time = t;
        growth_advance(g, real_min(g->speed * dt, g->rule->length - g->grown), source->family.horizon);
        cross(g, b, p, source, from);
        claim(g, p, source);
    }
    return fade(g, b, p, &source->family);
}

real growing_crack_deflection_angle(const struct growing_crack *g)
{
    const real *e = g->rule->direction, chord[2] = {g->place[0] - g->rule->at[0], g->place[1] - g->rule->at[1]};
    if (!(g->grown > 0)) return NAN;
    return fabs(atan2(e[0] * chord[1] - e[1] * chord[0], dot(e, chord, 2))) * 180 / 3.14159265358979323846;
}

status growing_crack_save_or_load(struct growing_crack *g, int crack_number, struct archive *a)
{
    char name[64];
    struct {
        real place[2], along[2], heading[2], speed, grown, start_time, intensity, target_speed, filtered_speed,
            control_time;
        int64_t n;
    } s = {{g->place[0], g->place[1]},
           {g->along[0], g->along[1]},
           {g->heading[0], g->heading[1]},
           g->speed,
           g->grown,
           g->start_time,
           g->intensity,
           g->target_speed,
           g->filtered_speed,
           g->control_time,
           g->n};
    snprintf(name, sizeof name, "growth/%d", crack_number);
    ARCHIVE_VALUE(a, name, s);
    for (int d = 0; d < 2; d++) g->place[d] = s.place[d], g->along[d] = s.along[d], g->heading[d] = s.heading[d];
    g->speed = s.speed, g->grown = s.grown, g->start_time = s.start_time;
    g->intensity = s.intensity, g->target_speed = s.target_speed, g->filtered_speed = s.filtered_speed,
    g->control_time = s.control_time;
    if (!a->saving) {
        memory_free(g->fading);
        g->n = s.n;
        g->fading = NEW("growth.fading", g->n, struct fading);
    }
    snprintf(name, sizeof name, "growth/fading%d", crack_number);
    return a->exchange(a, name, g->fading, (size_t)g->n * sizeof *g->fading);
}
