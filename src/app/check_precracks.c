/* Writes remarks of `cleave check` on pre-cracks: on short ones, on ends that lie exactly on bonds, and, if bonds
 * soften, on the length of the shortest pre-crack divided by the horizon. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "check_parts.h"
#include "fracture/fracture_part.h"
#include "fracture/tips.h"

/* Length of a pre-crack below which its critical load depends on the horizon [horizons]; measured. */
#define HORIZONS_LEAST 3

/* Returns the share of the straight crack between the points from[dim] and to[dim] [m] that is inside bodies of scene s
 * (the input file) [1], estimated from 1000 points of the crack. */
static real crack_share_within(const struct scene *s, const real *from, const real *to)
{
    enum { PLACES = 1000 };
    int within = 0;
    for (int m = 0; m < PLACES; m++) {
        real X[DIM_MAX] = {0};
        bool found = false;
        for (int d = 0; d < s->dim; d++) X[d] = from[d] + (m + 0.5) / PLACES * (to[d] - from[d]);
        for (int b = 0; b < s->bodies && !found; b++) found = region_contains(&s->body[b].shape, X, s->dim, 0);
        within += found;
    }
    return (real)within / PLACES;
}

void print_advice_on_close_crack_tips(const struct scene *s, const struct fracture_state *fracture, FILE *out)
{
    for (int k = 0; k < s->cracks && s->method != METHOD_MPM && s->dim == 2; k++) {
        const real *from = s->crack[k].corner[0], *to = s->crack[k].corner[1];
        const bool tip[2] = {tips_any_started_at_precrack_end(&fracture->tips, from),
                             tips_any_started_at_precrack_end(&fracture->tips, to)};
        const real share = tip[0] && tip[1] ? 1 : crack_share_within(s, from, to);
        const real length = share * hypot(to[0] - from[0], to[1] - from[1]);
        if (tip[0] != tip[1] && length < 0.5 * s->spacing) {
            fprintf(out,
                    "accuracy       crack %d is in the body over a length of %.3g m, less than half a spacing; check "
                    "its coordinates and their unit (m if none is written)\n",
                    k + 1, length);
            continue;
        }
        if (tip[0] && tip[1] && length < FEATURE * (s->horizon * s->spacing))
            fprintf(out,
                    "accuracy       crack %d is %.4g m long, %.2g horizons, so its two tips affect each other; use a "
                    "smaller particles.spacing\n",
                    k + 1, length, length / (s->horizon * s->spacing));
        else if (tip[0] != tip[1] && 2 * length < FEATURE * (s->horizon * s->spacing))
            fprintf(out,
                    "accuracy       crack %d is %.3g m deep, %.2g horizons, so the face affects its tip; use a smaller "
                    "particles.spacing\n",
                    k + 1, length, length / (s->horizon * s->spacing));
    }
}

/* Returns the index of the body of `scene` to which particle i of `part` belongs; for joined bodies the index of the
 * first of them. */
static int body_of(const struct scene *scene, const struct particles *part, int32_t i)
{
    return scene->body[part->body[i]].joined;
}

/* Returns the number of bonds of the run whose cut depends on the exact length of crack c at its corner `end` (0 or 1).
 * Crack c cuts these bonds if it is longer by 1e-7 of its length, but not if it is shorter by as much. Bonds are pairs
 * of particles of one body within the horizon. found[capacity]: work array for the indices of particles near the
 * end. */
static int64_t tied_bonds(const struct run *run, const struct crack *c, int end, int32_t *found, int capacity)
{
    const struct particles *p = &run->part;
    real corner[2][2][DIM_MAX], hair[DIM_MAX];
    struct crack longer = {.n = 2, .corner = corner[0]}, shorter = {.n = 2, .corner = corner[1]};
    memcpy(corner[0], c->corner, sizeof corner[0]);
    memcpy(corner[1], c->corner, sizeof corner[1]);
    for (int d = 0; d < p->dim; d++) hair[d] = 1e-7 * (c->corner[end][d] - c->corner[!end][d]);
    for (int d = 0; d < p->dim; d++) corner[0][end][d] += hair[d], corner[1][end][d] -= hair[d];
    int64_t tied = 0;
    const int n =
        cells_list_particles_near_point(&run->cells, p, c->corner[end], run->source.family.cutoff, -1, found, capacity);
    for (int k = 0; k < n; k++)
        for (int m = 0; m < k; m++) {
            real a[DIM_MAX], b[DIM_MAX], r2 = 0;
            particle_reference_position(p, found[k], a);
            particle_reference_position(p, found[m], b);
            for (int d = 0; d < p->dim; d++) r2 += square(a[d] - b[d]);
            if (body_of(run->scene, &run->part, found[k]) != body_of(run->scene, &run->part, found[m])) continue;
            if (r2 > square(run->source.family.cutoff)) continue;
            tied += crack_cuts_bond(&longer, a, b, p->dim) != crack_cuts_bond(&shorter, a, b, p->dim);
        }
    return tied;
}

void hint_precrack_ends_exactly_on_bonds(const struct run *run, struct warnings *warning_list)
{
    enum { ROOM = 1024 };
    int32_t found[ROOM];
    for (int k = 0; k < run->scene->cracks && run->part.dim == 2 && run->scene->method != METHOD_MPM; k++) {
        int64_t tied[2];
        if (cells_neighbour_count_upper_bound(&run->cells, run->source.family.cutoff) > ROOM) return;
        for (int end = 0; end < 2; end++) tied[end] = tied_bonds(run, &run->scene->crack[k], end, found, ROOM);
        const bool both = tied[0] > 0 && tied[1] > 0;
        if (tied[0] > 0 || tied[1] > 0)
            warnings_add_if_new(warning_list,
                                "crack %d: %s exactly on %lld bonds%s, and these are cut; move %s by 0.1 spacings to "
                                "choose which bonds are cut",
                                k + 1, both ? "its ends lie" : "an end lies",
                                (long long)(tied[0] > 0 ? tied[0] : tied[1]), both ? " each" : "",
                                both ? "the ends" : "the end");
    }
}

void print_smallest_resolvable_precrack_length(const struct run *run)
{
    const struct scene *s = run->scene;
    real least = INFINITY;
    for (int k = 0; k < s->cracks && run->bonds.soft.curve && s->dim == 2; k++) {
        real length = 0;
        for (int c = 0; c + 1 < s->crack[k].n; c++) {
            const real *from = s->crack[k].corner[c], *to = s->crack[k].corner[c + 1];
            length += crack_share_within(s, from, to) * hypot(to[0] - from[0], to[1] - from[1]);
        }
        least = real_min(least, length);
    }
    if (!isfinite(least)) return;
    printf("pre-cracks     the shortest is %.3g m long, which is %.2g horizons%s\n", least,
           least / run->source.family.horizon,
           least < HORIZONS_LEAST * run->source.family.horizon
               ? "; below 3 horizons its critical load depends on the horizon"
               : "");
}
