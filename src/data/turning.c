/* Divides material points into groups of neighbours that rotate together, which conserves angular momentum
 * (turning.h). */
#include "data/turning.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"

/* ---- making ------------------------------------------------------------------------------------------------------ */

/* A particle with its reference position [m], and the integer position `place` of the group of points, rotating
 * together, to which it belongs. */
struct member {
    real X[DIM_MAX];
    int64_t place[DIM_MAX];
    int32_t body, particle, off;
};

/* Compares two groups of points, which are boxes of neighbouring lattice sites that rotate together. a, b: integer
 * positions of the groups along the axes; body_a, body_b: bodies of the groups, compared first. Returns -1, 0 or 1. */
static int order_of_places(const int64_t *a, int body_a, const int64_t *b, int body_b)
{
    if (body_a != body_b) return body_a < body_b ? -1 : 1;
    for (int d = DIM_MAX; d-- > 0;)
        if (a[d] != b[d]) return a[d] < b[d] ? -1 : 1;
    return 0;
}

/* Compares two particles a and b (struct member) for array_sort: first by the group of points with which they rotate,
 * then by position, then by number. Returns -1, 0 or 1. */
static int by_member(const void *a, const void *b)
{
    const struct member *p = a, *q = b;
    const int order = order_of_places(p->place, p->body, q->place, q->body);
    for (int d = DIM_MAX; d-- > 0 && !order;)
        if (p->X[d] != q->X[d]) return p->X[d] < q->X[d] ? -1 : 1;
    return order ? order : (p->particle > q->particle) - (p->particle < q->particle);
}

/* Compares a and b, two groups of points that rotate together (struct turning_group), for array_sort and bsearch: by
 * body, then by position. Returns -1, 0 or 1. */
static int by_group(const void *a, const void *b)
{
    const struct turning_group *p = a, *q = b;
    return order_of_places(p->place, p->body, q->place, q->body);
}

/* Returns the integer position, along one axis, of the group of points at the coordinate u. Groups are TURNING_EDGE
 * spacings wide. u: distance from the middle of the body [spacings]. odd: true if the middle of the body is in the
 * middle of group 0, false if it is at the boundary between the groups -1 and 0. */
static int64_t group_place(real u, bool odd)
{
    const real far = floor((fabs(u) + (odd ? (TURNING_EDGE - 1) / 2.0 : TURNING_EDGE)) / TURNING_EDGE);
    return (int64_t)(u < 0 ? -far : far - !odd);
}

/* Extent and middle of joined bodies. Their groups of points are counted from the middle. */
struct division {
    real low[DIM_MAX], high[DIM_MAX];      /* range of the reference positions [m] */
    real middle[DIM_MAX];                  /* middle of this range [m] */
    bool odd[DIM_MAX];                     /* a row of particles is on the middle, across each axis */
    int64_t first[DIM_MAX], last[DIM_MAX]; /* least and largest position of a group along each axis */
};

/* Returns the position, along one axis, of the outermost group of points on one side of the middle of a body of `dim`
 * dimensions. A layer of so few rows that groups at corners would have fewer than TURNING_FEW points belongs to the
 * groups of the layer inside it: a box across a corner of another one would give it angular momentum under pure strain
 * (a cube of 16^3 points lost 4 % of its strain). u: distance of the outermost row from the middle of the body
 * [spacings], negative on the lower side; odd: as in group_place. */
static int64_t outermost_place(real u, bool odd, int dim)
{
    const int64_t outer = group_place(u, odd);
    for (int rows = 1; pow(rows, dim) < TURNING_FEW && fabs(u) - rows >= 0; rows++) {
        const int64_t inner = group_place(u < 0 ? u + rows : u - rows, odd);
        if (inner != outer) return inner;
    }
    return outer;
}

/* Returns an array [bodies] with extent and middle of the bodies that are joined to each body. Joined bodies are
 * represented by the first of them, one[b] for body b, whose entry alone is filled. The caller frees the array with
 * memory_free. p: particles; spacing: lattice spacing [m]; mirror[dim]: positions of planes of symmetry [m], NAN:
 * none. */
static struct division *divisions_make(const struct particles *p, real spacing, const real *mirror, const int *one,
                                       int bodies)
{
    struct division *all = NEW("turning.division", bodies, struct division);
    for (int b = 0; b < bodies; b++)
        for (int d = 0; d < p->dim; d++) all[b].low[d] = INFINITY, all[b].high[d] = -INFINITY;
    for (int64_t i = 0; i < p->n; i++) {
        struct division *own = &all[one[p->body[i]]];
        for (int d = 0; d < p->dim; d++)
            own->low[d] = real_min(own->low[d], p->X[d][i]), own->high[d] = real_max(own->high[d], p->X[d][i]);
    }
    for (int b = 0; b < bodies; b++)
        for (int d = 0; d < p->dim && all[b].low[d] <= all[b].high[d]; d++) {
            struct division *own = &all[b];
            const bool cut = mirror[d] > own->low[d] - spacing && mirror[d] < own->high[d] + spacing;
            own->middle[d] = cut ? mirror[d] : 0.5 * (own->low[d] + own->high[d]);
            const real rows = (own->low[d] - own->middle[d]) / spacing;
            own->odd[d] = fabs(rows - nearbyint(rows)) < 0.25;
            own->first[d] = outermost_place(rows, own->odd[d], p->dim);
            own->last[d] = outermost_place((own->high[d] - own->middle[d]) / spacing, own->odd[d], p->dim);
        }
    return all;
}

/* Returns an array of all particles of p, sorted by the group with which they rotate and by position, so that their
 * order does not depend on their numbers. The caller frees it with memory_free. spacing: lattice spacing [m]; one[b]:
 * first of the bodies that are joined to body b; division: extent of the bodies, from divisions_make. */
static struct member *members_sorted(const struct particles *p, real spacing, const struct division *division,
                                     const int *one)
{
    struct member *all = NEW("turning.sorted", p->n, struct member);
    for (int64_t i = 0; i < p->n; i++) {
        const struct division *own = &division[one[p->body[i]]];
        all[i].body = one[p->body[i]], all[i].particle = (int32_t)i;
        for (int d = 0; d < p->dim; d++) {
            all[i].X[d] = p->X[d][i];
            const int64_t place = group_place((p->X[d][i] - own->middle[d]) / spacing, own->odd[d]);
            all[i].place[d] = place < own->first[d] ? own->first[d] : place > own->last[d] ? own->last[d] : place;
            all[i].off += (int32_t)llabs(2 * all[i].place[d] + !own->odd[d]);
        }
    }
    array_sort(all, p->n, sizeof *all, by_member);
    return all;
}

/* Finds the 26 neighbours of group g of `groups`, a box of points that rotate together. Stores their indices in the
 * array `near` of the group, or -1 where the body has no group. Neighbours displaced along one axis come first, then
 * those displaced along two axes, then along three. */
static void groups_near(struct corotating_groups *groups, int32_t g)
{
    struct turning_group *own = &groups->group[g];
    for (int k = 0, n = 0; k < 81; k++) {
        const int step[DIM_MAX] = {k % 3 - 1, k / 3 % 3 - 1, k / 9 % 3 - 1};
        if (abs(step[0]) + abs(step[1]) + abs(step[2]) != 1 + k / 27) continue;
        struct turning_group like = {.body = own->body};
        for (int d = 0; d < DIM_MAX; d++) like.place[d] = own->place[d] + step[d];
        const struct turning_group *at = bsearch(&like, groups->group, (size_t)groups->groups, sizeof like, by_group);
        own->near[n++] = at ? (int32_t)(at - groups->group) : -1;
    }
}

/* Returns true if the particles a and b, neighbours in the list of particles sorted by group, belong to different
 * groups of points that rotate together. */
static bool groups_differ(const struct member *a, const struct member *b)
{
    return order_of_places(a->place, a->body, b->place, b->body) != 0;
}

/* Lists in groups->run the particles of each group of `groups` (points that rotate together) as runs: at most LANES
 * particles that have consecutive numbers and belong to one group. all[n]: particles sorted by group, then by
 * position. */
static void runs_make(struct corotating_groups *groups, const struct member *all, int64_t n)
{
    struct turning_group *g = groups->group;
    int64_t runs = 0;
    groups->run = NEW("turning.run", n, struct turning_run);
    for (int64_t k = 0; k < n; k++) {
        if (k > 0 && groups_differ(&all[k], &all[k - 1])) g++, g->first = runs;
        struct turning_run *last = runs > g->first ? &groups->run[runs - 1] : NULL;
        if (last && last->n < LANES && last->first + last->n == all[k].particle)
            last->n++;
        else
            groups->run[runs++] = (struct turning_run){all[k].particle, 1};
        g->end = runs;
    }
}

void corotating_groups_make(struct corotating_groups *groups, const struct particles *p, real spacing,
                            const real *symmetry_plane, const int *first_joined_body, const bool *body_is_supported,
                            int body_count)
{
    struct division *division = divisions_make(p, spacing, symmetry_plane, first_joined_body, body_count);
    struct member *all = members_sorted(p, spacing, division, first_joined_body);
    memory_free(division);
    corotating_groups_free(groups);
    for (int64_t k = 0; k < p->n; k++) groups->groups += k == 0 || groups_differ(&all[k], &all[k - 1]);
    groups->group = NEW("turning.group", groups->groups, struct turning_group);
    for (int c = p->dim == 2 ? 2 : 0; c < 3; c++) groups->turn[c] = NEW("turning.turn", p->n + LANES, real);
    struct turning_group *g = groups->group;
    for (int64_t k = 0; k < p->n; k++) {
        if (k > 0 && !groups_differ(&all[k], &all[k - 1])) continue;
        *g = (struct turning_group){.body = all[k].body, .off = all[k].off, .held = body_is_supported[all[k].body]};
        memcpy(g->place, all[k].place, sizeof g->place);
        g++;
    }
    runs_make(groups, all, p->n);
#pragma omp parallel for schedule(static)
    for (int32_t k = 0; k < groups->groups; k++) groups_near(groups, k);
    memory_free(all);
}

void corotating_groups_free(struct corotating_groups *groups)
{
    memory_free(groups->group), memory_free(groups->run);
    for (int c = 0; c < 3; c++) memory_free(groups->turn[c]);
    *groups = (struct corotating_groups){0};
}
