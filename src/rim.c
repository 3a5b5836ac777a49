/* floor 3: the rim of the material points and its damping. Few particles; owner computes throughout. */
#include "rim.h"

#include <math.h>
#include <string.h>

#include "memory.h"

#define NEIGHBOUR_SPACINGS 1.5           /* nearest along axes and face diagonals */

enum { OUTSIDE = -1 };

/* ---- who stands near whom ----------------------------------------------------------------------------- */

struct search {
    const struct particles *p;
    const struct bond_source *source;
    struct near near;
};

/* Free particles of the body of particle i within `radius` of it, ascending, images left out; into s->near. */
static void search_near(struct search *s, int32_t i, real radius)
{
    const struct particles *p = s->p;
    int kept = 0;
    near_find(&s->near, s->source->cells, p, i, radius, false);
    for (int k = 0; k < s->near.n; k++) {
        const int32_t j = s->near.at[k];
        if (j < p->n && p->body[j] == p->body[i] && !(p->flag[j] & (FLAG_DRIVEN | FLAG_MESHED))) s->near.at[kept++] = j;
    }
    s->near.n = kept;
}

/* ---- making ------------------------------------------------------------------------------------------- */

static void member_add(struct rim *r, int32_t *place, int32_t i)
{
    if (place[i] != OUTSIDE) return;
    place[i] = (int32_t)r->n;
    r->particle[r->n++] = i;
}

/* The points of the rim first, then their other neighbours. */
static void members_make(struct rim *r, struct search *s, int32_t *place)
{
    const struct particles *p = s->p;
    const struct family *f = &s->source->family;
    for (int64_t k = 0; k < p->n_of[KIND_PD]; k++) {
        search_near(s, p->list[KIND_PD][k], f->cutoff + f->spacing * (1 + 1e-9));
        for (int q = 0; q < s->near.n; q++)
            if (p->kind[s->near.at[q]] == KIND_MPM) member_add(r, place, s->near.at[q]);
    }
    r->points = r->n;
    for (int64_t k = 0; k < r->points; k++) {
        search_near(s, r->particle[k], NEIGHBOUR_SPACINGS * f->spacing);
        for (int q = 0; q < s->near.n; q++) member_add(r, place, s->near.at[q]);
    }
}

/* Pairs of members of which one at least is a point of the rim. */
static void pairs_make(struct rim *r, struct search *s, const int32_t *place)
{
    int64_t pairs = 0, room = 0;
    int most = 1;
    for (int64_t k = 0; k < r->n; k++) {
        const struct near *near = &s->near;
        search_near(s, r->particle[k], NEIGHBOUR_SPACINGS * s->source->family.spacing);
        if (pairs + near->n > room) {
            int64_t larger = 2 * (pairs + near->n);
            r->neighbour = memory_resize("rim.neighbour", r->neighbour, room, larger, sizeof *r->neighbour);
            room = larger;
        }
        r->start[k] = pairs;
        for (int q = 0; q < near->n; q++) {
            const int32_t m = place[near->at[q]];
            if (m == OUTSIDE || (k >= r->points && m >= r->points)) continue;
            if (cracks_part(s->source->crack, s->source->cracks, s->p, r->particle[k], near->at[q])) continue;
            r->neighbour[pairs++] = m;
        }
        if (pairs - r->start[k] > most) most = (int)(pairs - r->start[k]);
    }
    r->start[r->n] = pairs;
    r->scale = 4 / (most * (1 + 1.0 / s->p->dim));       /* the sum of e e of n neighbours has a norm of about n/dim */
}

void rim_make(struct rim *r, const struct particles *p, const struct bond_source *source)
{
    struct search s = {.p = p, .source = source};
    rim_free(r);
    int32_t *place = NEW("rim.place", p->n, int32_t);
    for (int64_t i = 0; i < p->n; i++) place[i] = OUTSIDE;
    r->particle = NEW("rim.particle", p->n, int32_t);
    members_make(r, &s, place);
    r->particle = memory_resize("rim.particle", r->particle, p->n, r->n, sizeof *r->particle);
    r->start = NEW("rim.start", r->n + 1, int64_t);
    pairs_make(r, &s, place);
    r->difference = NEW("rim.difference", r->n * p->dim, real);
    r->change = NEW("rim.change", r->n * p->dim, real);
    memory_free(s.near.at);
    memory_free(place);
}

void rim_free(struct rim *r)
{
    memory_free(r->particle);
    memory_free(r->start);
    memory_free(r->neighbour);
    memory_free(r->difference);
    memory_free(r->change);
    memset(r, 0, sizeof *r);
}

/* ---- a step ------------------------------------------------------------------------------------------- */

/* Adds factor ((b - a) . e) e, e along the line between particles i and j. */
static void add_along(const struct particles *p, int32_t i, int32_t j, const real *a, const real *b, real factor,
                      real *sum)
{
    real y[DIM_MAX], length2 = 0, along = 0;
    for (int d = 0; d < p->dim; d++) {
        y[d] = p->x[d][j] - p->x[d][i];
        length2 += square(y[d]);
        along += (b[d] - a[d]) * y[d];
    }
    for (int d = 0; d < p->dim; d++) sum[d] += factor * along / length2 * y[d];
}

static void velocity_of(const struct particles *p, int32_t i, real *v)
{
    for (int d = 0; d < p->dim; d++) v[d] = p->v[d][i];
}

/* m d of a point: how much its velocity differs from its neighbours', along the lines to them. */
static void difference_make(struct rim *r, const struct particles *p, int64_t k)
{
    const int32_t i = r->particle[k];
    real own[DIM_MAX], other[DIM_MAX], sum[DIM_MAX] = {0};
    velocity_of(p, i, own);
    for (int64_t q = r->start[k]; q < r->start[k + 1]; q++) {
        const int32_t j = r->particle[r->neighbour[q]];
        velocity_of(p, j, other);
        add_along(p, i, j, own, other, r->scale, sum);
    }
    for (int d = 0; d < p->dim; d++) r->difference[k * p->dim + d] = p->mass[i] * sum[d];
}

/* What a member gives to each neighbour it takes: the pair's terms are each other's negative to the last bit. */
static void change_make(struct rim *r, const struct particles *p, int64_t k, real share)
{
    real *sum = r->change + k * p->dim;
    for (int d = 0; d < p->dim; d++) sum[d] = 0;
    for (int64_t q = r->start[k]; q < r->start[k + 1]; q++) {
        const int32_t m = r->neighbour[q];
        add_along(p, r->particle[k], r->particle[m], r->difference + k * p->dim, r->difference + m * p->dim,
                  -share * r->scale, sum);
    }
}

/* Adds the change to the velocity of a member; returns the kinetic energy that it loses. */
static real change_apply(const struct rim *r, struct particles *p, int64_t k)
{
    const int32_t i = r->particle[k];
    real lost = 0;
    for (int d = 0; d < p->dim; d++) {
        const real before = p->v[d][i];
        p->v[d][i] += r->change[k * p->dim + d] / p->mass[i];
        lost += 0.5 * p->mass[i] * (before - p->v[d][i]) * (before + p->v[d][i]);
    }
    return lost;
}

real rim_damp(struct rim *r, struct particles *p, real share)
{
    real lost = 0;
#pragma omp parallel
    {
#pragma omp for schedule(static)
        for (int64_t k = 0; k < r->points; k++) difference_make(r, p, k);    /* 0 for the members outside the rim */
#pragma omp for schedule(static)
        for (int64_t k = 0; k < r->n; k++) change_make(r, p, k, share);
    }
    for (int64_t k = 0; k < r->n; k++) lost += change_apply(r, p, k);    /* few; the sum must not depend on threads */
    return lost;
}
