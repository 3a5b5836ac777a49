/* Tests whether a scene is its own mirror image, on its particles: matter, cracks, initial velocities and loads. */
#include <math.h>
#include <string.h>

#include "check_parts.h"
#include "base/memory.h"

#define NEAR_ENOUGH 1e-6                 /* [spacings], and share of a largest component */

/* Index of the particle of the body at X [m], [dim]; -1: none. */
static int64_t particle_at(const struct engine *e, const real *X)
{
    int32_t found[4];
    const int n = cells_near(&e->cells, &e->part, X, NEAR_ENOUGH * e->scene->spacing, -1, found, COUNT_OF(found));
    return n == 1 && found[0] < e->part.n ? found[0] : -1;
}

static real largest(const real *a, int64_t n)
{
    real most = 0;
    for (int64_t i = 0; i < n; i++) most = real_max(most, fabs(a[i]));
    return most;
}

/* True if values a, [n], at mirror twins are equal, or with `odd` opposite. twin: [n] index of the mirror image. */
static bool agree(const real *a, const int32_t *twin, int64_t n, bool odd)
{
    const real most = NEAR_ENOUGH * largest(a, n);
    for (int64_t i = 0; i < n; i++)
        if (fabs(a[i] - (odd ? -a[twin[i]] : a[twin[i]])) > most) return false;
    return true;
}

/* True if material, body, kind, volume and damage by cracks are equal at twins. */
static bool matter_agrees(const struct engine *e, const int32_t *twin)
{
    const struct particles *p = &e->part;
    for (int64_t i = 0; i < p->n; i++)
        if (p->material[i] != p->material[twin[i]] || p->body[i] != p->body[twin[i]] || p->kind[i] != p->kind[twin[i]])
            return false;
    return agree(p->damage, twin, p->n, false) && agree(p->volume0, twin, p->n, false);
}

/* A number for the kind and time function of a load, such that loads that differ in either do not cancel in sums. */
static real load_mark(const struct boundary *b)
{
    const struct time_function *t = &b->time;
    real mark = 1 + b->kind + 10.0 * t->kind;
    if (t->kind != TIME_CONSTANT && t->kind != TIME_TABLE)
        mark += 0.1234 * t->from / (t->from + t->until + 1e-300) + 1e6 * t->until;
    for (int k = 0; k < t->n; k++) mark += (k + 1.618) * (t->t[k] * 1e6 + t->value[k]);
    return mark;
}

/* Sums, per particle, of the marked loads on component d into `ask`, [n], and of the marks of driving loads into
 * `held`, [n]. */
static void loads_ask(const struct engine *e, int d, real *ask, real *held)
{
    memset(ask, 0, (size_t)e->part.n * sizeof *ask);
    memset(held, 0, (size_t)e->part.n * sizeof *held);
    for (int b = 0; b < e->loads.n; b++) {
        const struct load *l = &e->loads.load[b];
        const struct boundary *a = l->boundary;
        const bool drives = a->kind == BOUNDARY_VELOCITY;
        for (int64_t k = 0; k < l->n; k++) {
            if (drives && !(a->components & 1 << d)) continue;
            if (a->kind == BOUNDARY_ABSORBING) {
                held[l->particle[k]] += load_mark(a) * l->outer[k] * (d == a->face ? 2 : 1);
                continue;
            }
            ask[l->particle[k]] += load_mark(a) * a->value[d] * (drives ? 1 : l->share[d][k]);
            if (drives) held[l->particle[k]] += load_mark(a);
        }
    }
}

/* True if loads, constraints and initial velocities are mirror images across `axis`. */
static bool loads_agree(const struct engine *e, int axis, const int32_t *twin)
{
    const struct particles *p = &e->part;
    real *ask = NEW("check.ask", p->n, real), *held = NEW("check.held", p->n, real);
    bool same = true;
    for (int d = 0; d < p->dim && same; d++) {
        loads_ask(e, d, ask, held);
        same = agree(ask, twin, p->n, d == axis) && agree(held, twin, p->n, false) &&
               agree(p->v[d], twin, p->n, d == axis);
    }
    memory_free(ask);
    memory_free(held);
    return same;
}

/* Finds the mirror image of every particle in the plane at `at` [m], twin[n]; false if a particle has none. */
static bool mirror_twins_find(const struct engine *e, int axis, real at, int32_t *twin)
{
    const struct particles *p = &e->part;
    for (int64_t i = 0; i < p->n; i++) {
        real X[DIM_MAX];
        particle_place(p, i, X);
        X[axis] = 2 * at - X[axis];
        const int64_t j = particle_at(e, X);
        if (j < 0) return false;
        twin[i] = (int32_t)j;
    }
    return true;
}

bool scene_is_mirrored(const struct engine *e, int axis, real *at)
{
    const struct particles *p = &e->part;
    real low, high;
    for (int b = 0; b < e->loads.n; b++)
        if (e->loads.load[b].boundary->kind == BOUNDARY_MIRROR && e->loads.load[b].boundary->axis == axis) return false;
    particles_extent(p, p->n, axis, &low, &high);
    *at = 0.5 * (low + high);
    if (high - low < e->scene->spacing) return false;
    int32_t *twin = NEW("check.twin", p->n, int32_t);
    const bool same = mirror_twins_find(e, axis, *at, twin) && matter_agrees(e, twin) && loads_agree(e, axis, twin);
    memory_free(twin);
    return same;
}
