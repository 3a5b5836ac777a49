/* Picks the cheapest point of the cost-accuracy table that is accurate enough. A line is all runs of a method at one
 * horizon and step, over the resolution; where several cases may apply to a scene, the worst counts.
 *
 *   envelope   error at a resolution counts as the largest there and at all finer ones: smaller errors that finer runs
 *              do not keep are coincidences of the lattice (41 of 101 lines of holes and cracks have such a dip, 9 of
 *              135 of smooth problems)
 *   alone      a line of a single run is not used unless errors are smooth: no finer run confirms it
 *   between    where the problem is smooth errors are powers of the spacing, and a resolution between two runs is taken
 *              such that their line through both logarithms meets MARGIN of the accuracy
 *   MARGIN     a power through the neighbours of a run, at half and twice its resolution, misses the run's error by 6 %
 *              or less in 95 of 100 cases (268 in bar, wave, square and cube) and by 13 % at the most; between
 *              neighbours, where it is used, it is drawn over half that distance */
#include <math.h>
#include <string.h>

#include "auto.h"

#define MARGIN 0.9

enum { LINE_MOST = 16 };
struct line { int n; struct auto_point at[LINE_MOST]; };

/* ---- lines ------------------------------------------------------------------------------------------------------- */

static bool auto_pick_same_line(const struct cost_point *a, const struct cost_point *b)
{
    return a->horizon == b->horizon && a->step == b->step && strcmp(a->method, b->method) == 0;
}

static bool in_case(const struct cost_point *p, const struct auto_match *m, int k)
{
    return strcmp(p->problem, m->kind->problem) == 0 && strcmp(p->at, m->at[k]) == 0;
}

/* Error and time of the worst case at the resolution of p; false: a case was not run there. */
static bool worst_case(const struct cost_accuracy *c, const struct auto_match *m, const struct cost_point *p,
                       struct auto_point *worst)
{
    *worst = (struct auto_point){p, p->resolution, fmax(p->error, m->kind->known), p->seconds, p->particles, p->steps};
    for (int k = 1; k < m->cases; k++) {
        const struct cost_point *found = NULL;
        for (int j = 0; j < c->n && !found; j++) {
            const struct cost_point *q = &c->point[j];
            if (in_case(q, m, k) && auto_pick_same_line(p, q) && q->resolution == p->resolution) found = q;
        }
        if (!found) return false;
        worst->error = fmax(worst->error, found->error), worst->seconds = fmax(worst->seconds, found->seconds);
    }
    return true;
}

/* Makes the line of the run `first`, by ascending resolution, with the errors of the envelope. */
static void make_line(struct line *l, const struct cost_accuracy *c, const struct auto_match *m,
                      const struct cost_point *first)
{
    struct auto_point next;
    l->n = 0;
    for (int k = 0; k < c->n && l->n < LINE_MOST; k++) {
        const struct cost_point *p = &c->point[k];
        if (!in_case(p, m, 0) || !auto_pick_same_line(p, first) || !worst_case(c, m, p, &next)) continue;
        int at = l->n++;
        for (; at > 0 && l->at[at - 1].resolution > next.resolution; at--) l->at[at] = l->at[at - 1];
        l->at[at] = next;
    }
    for (int k = l->n - 2; k >= 0; k--) l->at[k].error = fmax(l->at[k].error, l->at[k + 1].error);
}

/* ---- points of a line -------------------------------------------------------------------------------------------- */

static real auto_pick_between(real a, real b, real share) { return exp(log(a) + share * (log(b) - log(a))); }

/* Interpolates two points in their logarithms, at a share of the way from a to b; the error includes MARGIN. */
static struct auto_point point_between(const struct auto_point *a, const struct auto_point *b, real share)
{
    struct auto_point p = *a;
    p.resolution = auto_pick_between(a->resolution, b->resolution, share);
    p.error = auto_pick_between(a->error, b->error, share) / MARGIN;
    p.seconds = auto_pick_between(a->seconds, b->seconds, share);
    p.particles = auto_pick_between(a->particles, b->particles, share);
    p.steps = a->steps > 0 && b->steps > 0 ? auto_pick_between(a->steps, b->steps, share) : 0;
    return p;
}

/* Point at the user's resolution. The error is that of the next coarser run where the problem is not smooth; false if
 * the resolution is coarser than all runs. */
static bool point_at(const struct line *l, const struct auto_wish *w, struct auto_point *p)
{
    int k = l->n - 1;
    while (k >= 0 && l->at[k].resolution > w->resolution * (1 + 1e-9)) k--;
    if (k < 0) return false;
    const bool last = k == l->n - 1;
    const struct auto_point *a = &l->at[last && k > 0 ? k - 1 : k], *b = &l->at[last ? k : k + 1];
    const real exact = w->resolution / l->at[k].resolution;
    *p = l->at[k];
    if (exact < 1 + 1e-9 || a == b) return true;
    *p = point_between(a, b, log(w->resolution / a->resolution) / log(b->resolution / a->resolution));
    if (last || !w->match->kind->smooth) p->error = l->at[k].error;
    return true;
}

/* The cheapest point of the line that is accurate enough; false: none. */
static bool point_for(const struct line *l, const struct auto_wish *w, struct auto_point *p)
{
    int k = 0;
    while (k < l->n && l->at[k].error > w->accuracy) k++;
    if (k == l->n) return false;
    *p = l->at[k];
    if (k == 0 || !w->match->kind->smooth || l->at[k].error > MARGIN * w->accuracy) return true;
    const struct auto_point *a = &l->at[k - 1], *b = &l->at[k];
    *p = point_between(a, b, log(a->error / (MARGIN * w->accuracy)) / log(a->error / b->error));
    return true;
}

/* ---- all lines --------------------------------------------------------------------------------------------------- */

/* Keeps p if it is the cheapest point, or the cheapest of another method than the best. */
static void auto_pick_take(struct auto_found *f, const struct auto_point *p)
{
    const bool other = !f->best.of || strcmp(p->of->method, f->best.of->method) != 0;
    if (!f->best.of || p->seconds < f->best.seconds) {
        if (other) f->second = f->best;
        f->best = *p;
    } else if (other && (!f->second.of || p->seconds < f->second.seconds)) {
        f->second = *p;
    }
}

static bool is_first_of_line(const struct cost_accuracy *c, const struct auto_match *m, int k)
{
    for (int j = 0; j < k; j++)
        if (in_case(&c->point[j], m, 0) && auto_pick_same_line(&c->point[j], &c->point[k])) return false;
    return in_case(&c->point[k], m, 0);
}

void auto_pick(struct auto_found *f, const struct cost_accuracy *c, const struct auto_wish *w)
{
    struct line l;
    struct auto_point p;
    *f = (struct auto_found){0};
    for (int k = 0; k < c->n; k++) {
        if (!is_first_of_line(c, w->match, k) || !w->allows(&c->point[k], w->context)) continue;
        make_line(&l, c, w->match, &c->point[k]);
        if (l.n < (w->match->kind->smooth ? 1 : 2)) continue;
        const bool there = w->resolution > 0 ? point_at(&l, w, &p) : point_for(&l, w, &p);
        if (there && p.error <= w->accuracy * (1 + 1e-9)) auto_pick_take(f, &p);
        if (w->resolution == 0) p = l.at[l.n - 1];
        if ((there || w->resolution == 0) && (!f->finest.of || p.error < f->finest.error)) f->finest = p;
    }
}
