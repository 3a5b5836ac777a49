/* The spacings of a study of convergence: those near the wanted ones at which the lattice meets faces and cracks of the
 * scene as its own spacing does. A body that ends between two lattice points, or a crack that moves from beside a row
 * of particles onto it, would be another scene. */
#include <math.h>

#include "base/memory.h"
#include "study/convergence_study.h"

#define MEETS 0.02       /* a place this close to a lattice plane, or half-way, is met [spacings] */
#define NEAR_WANTED 0.12 /* spacings are looked for so far from the wanted one [1] */
#define FAR_WANTED 0.16  /* ... or, if none there fits, so far: levels keep apart [1] */
#define NEAR_CHOSEN 0.07 /* others beside the chosen one [1] */

/* Distances of faces and cracks from the lower corner of their body, each a multiple of the scene's own spacing, or
 * half-way between two. */
struct places {
    int n;
    struct {
        double at;
        bool half;
    } * place;
};

/* ---- places ------------------------------------------------------------------------------------------------------ */

static void place_add(struct places *p, double distance, double spacing)
{
    const double at = fabs(distance) / spacing, off = fabs(at - round(at));
    if (!isfinite(at) || at < 1 || (off > MEETS && off < 0.5 - MEETS)) return;
    for (int k = 0; k < p->n; k++)
        if (fabs(p->place[k].at - fabs(distance)) < 1e-9 * spacing) return;
    GROW("study.places", p->place, p->n + 1);
    p->place[p->n].at = fabs(distance);
    p->place[p->n++].half = off > 0.5 - MEETS;
}

static void places_find(struct places *p, const struct scene *s)
{
    real low[DIM_MAX], high[DIM_MAX];
    bool first = true;
    for (int b = 0; b < s->bodies; b++) {
        const struct region *shape = &s->body[b].shape;
        if (s->body[b].file || !region_bounds(shape, s->dim, low, high)) continue;
        for (int d = 0; d < s->dim; d++) {
            place_add(p, high[d] - low[d], s->spacing);
            for (int k = 0; k < shape->n; k++) {
                if (!solid_is(&shape->solid[k], SOLID_BOX)) continue;
                place_add(p, shape->solid[k].from[d] - low[d], s->spacing);
                place_add(p, shape->solid[k].to[d] - low[d], s->spacing);
            }
            for (int c = 0; c < s->cracks && first; c++)
                for (int k = 0; k < s->crack[c].n; k++) place_add(p, s->crack[c].corner[k][d] - low[d], s->spacing);
        }
        first = false;
    }
}

/* Largest distance of a place from where the lattice of a spacing should meet it [spacings]. */
static double misfit(const struct places *p, double spacing)
{
    double worst = 0;
    for (int k = 0; k < p->n; k++) {
        const double at = p->place[k].at / spacing - (p->place[k].half ? 0.5 : 0);
        worst = fmax(worst, fabs(at - round(at)));
    }
    return worst;
}

/* ---- spacings ---------------------------------------------------------------------------------------------------- */

/* The spacing that fits best within `reach` of `wanted`, of several that fit the nearest; none of `taken`. 0: none. */
static double spacing_near(const struct places *p, double wanted, double reach, const double *taken, int n)
{
    double longest = 0, best = 0, least = INFINITY;
    bool half = false;
    for (int k = 0; k < p->n; k++)
        if (p->place[k].at > longest) longest = p->place[k].at, half = p->place[k].half;
    if (longest == 0) return n == 0 ? wanted : 0;
    for (double cells = floor(longest / wanted / (1 + reach)); cells <= longest / wanted * (1 + reach) + 1; cells++) {
        const double spacing = longest / (cells + (half ? 0.5 : 0)), off = fabs(spacing / wanted - 1);
        bool is_taken = false;
        for (int k = 0; k < n; k++) is_taken |= fabs(spacing / taken[k] - 1) < 1e-6;
        if (!(spacing > 0) || !isfinite(spacing) || off > reach || is_taken) continue;
        const double wrong = misfit(p, spacing), price = (wrong > MEETS ? 1 + wrong : 0) + off;
        if (price < least) least = price, best = spacing;
    }
    return best;
}

void spacings_plan(struct spacings *to, const struct scene *s, int levels, double finest)
{
    struct places p = {0};
    places_find(&p, s);
    *to = (struct spacings){.levels = levels};
    for (int k = 0; k < levels; k++) {
        double *at = to->at[k];
        const double wanted = finest * pow(2, 0.5 * k);
        at[0] = fabs(wanted / s->spacing - 1) < 1e-9 ? s->spacing : spacing_near(&p, wanted, NEAR_WANTED, NULL, 0);
        if (misfit(&p, at[0]) > MEETS) at[0] = spacing_near(&p, wanted, FAR_WANTED, NULL, 0);
        if (at[0] == 0) at[0] = wanted;
        to->misfit[k] = misfit(&p, at[0]);
        to->n[k] = 1;
        for (int other = 1; other < SPACINGS_MOST; other++) {
            const double spacing = spacing_near(&p, at[0], NEAR_CHOSEN, at, to->n[k]);
            if (spacing > 0 && misfit(&p, spacing) <= MEETS) at[to->n[k]++] = spacing;
        }
    }
    memory_free(p.place);
}
