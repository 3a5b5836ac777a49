/* Chooses the spacings of a convergence study: near the wanted ones, and such that the lattice fits faces and cracks as
 * at the spacing of the input file (scene). A body that ends between two lattice planes, or a crack that moves from
 * between rows of particles onto a row, would change the problem. */
#include <math.h>

#include "base/memory.h"
#include "study/convergence_study.h"

#define MEETS 0.02       /* tolerance for a position on a lattice plane or midway between two [spacings] */
#define NEAR_WANTED 0.12 /* range around the wanted spacing that is searched [1] */
#define FAR_WANTED 0.16  /* range if none there fits; levels remain apart [1] */
#define NEAR_CHOSEN 0.07 /* range around the chosen spacing for further ones of the level [1] */

/* List of n distances of faces and cracks from the lower corner of their body, those that fit the lattice at the
 * spacing of the scene. at: distance [m]; half: true if it is a whole number of spacings plus one half, false if it is
 * a whole number. */
struct places {
    int n;
    struct {
        double at;
        bool half;
    } * place;
};

/* ---- positions --------------------------------------------------------------------------------------------------- */

/* Appends |distance|, the distance of a face or crack from the corner of its body [m], to the list *p if it fits the
 * lattice of the scene: if it is n or n + 1/2 spacings, with a whole number n. Ignores other distances, distances
 * below one spacing and duplicates. spacing: particle spacing that the input file (scene) gives [m]. */
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

/* Appends to *p the distances from the lower corner of each body of the scene s to its upper corner and to the faces of
 * its axis-parallel boxes, and from that of the first body also to the corners of all cracks, if they fit the lattice
 * of the scene: n or n + 1/2 spacings, with a whole number n. Other spacings of a study should fit these distances as
 * well. */
static void places_find(struct places *p, const struct scene *s)
{
    real low[DIM_MAX], high[DIM_MAX];
    bool first = true;
    for (int b = 0; b < s->bodies; b++) {
        const struct region *shape = &s->body[b].shape;
        if (s->body[b].file || !region_compute_bounding_box_if_finite(shape, s->dim, low, high)) continue;
        for (int d = 0; d < s->dim; d++) {
            place_add(p, high[d] - low[d], s->spacing);
            for (int k = 0; k < shape->n; k++) {
                if (!solid_is_untransformed_and_of_kind(&shape->solid[k], SOLID_BOX)) continue;
                place_add(p, shape->solid[k].from[d] - low[d], s->spacing);
                place_add(p, shape->solid[k].to[d] - low[d], s->spacing);
            }
            for (int c = 0; c < s->cracks && first; c++)
                for (int k = 0; k < s->crack[c].n; k++) place_add(p, s->crack[c].corner[k][d] - low[d], s->spacing);
        }
        first = false;
    }
}

/* Returns by how much faces and cracks miss the lattice if the spacing is `spacing` [m]: the largest deviation of the
 * distances in p from a whole number of spacings [spacings]. Distances that are a whole number plus one half at the
 * spacing that the input file (scene) gives are compared with such numbers. */
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

/* Returns the spacing [m] between wanted (1 - reach) and wanted (1 + reach) at which the distances p of faces and
 * cracks fit the lattice best; of equally good spacings the nearest to `wanted` [m]. reach: relative half-width of the
 * search; taken[n]: spacings that are excluded [m]. Returns 0 if there is none. */
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

void spacings_choose_for_convergence_study(struct spacings *spacings, const struct scene *s, int level_count,
                                           double finest_spacing)
{
    struct places p = {0};
    places_find(&p, s);
    *spacings = (struct spacings){.levels = level_count};
    for (int k = 0; k < level_count; k++) {
        double *at = spacings->at[k];
        const double wanted = finest_spacing * pow(2, 0.5 * k);
        at[0] = fabs(wanted / s->spacing - 1) < 1e-9 ? s->spacing : spacing_near(&p, wanted, NEAR_WANTED, NULL, 0);
        if (misfit(&p, at[0]) > MEETS) at[0] = spacing_near(&p, wanted, FAR_WANTED, NULL, 0);
        if (at[0] == 0) at[0] = wanted;
        spacings->misfit[k] = misfit(&p, at[0]);
        spacings->n[k] = 1;
        for (int other = 1; other < SPACINGS_MOST; other++) {
            const double spacing = spacing_near(&p, at[0], NEAR_CHOSEN, at, spacings->n[k]);
            if (spacing > 0 && misfit(&p, spacing) <= MEETS) at[spacings->n[k]++] = spacing;
        }
    }
    memory_free(p.place);
}
