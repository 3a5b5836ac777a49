/* Runs of scenes given as text with overrides, and the displacements of their particles. */
#ifndef CLEAVE_TESTS_SOLUTION
#define CLEAVE_TESTS_SOLUTION

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "engine/engine.h"
#include "step/report.h"
#include "scene/scene_read.h"
#include "tests/support/scene_with.h"

/* A scene, its run, and the status of both. */
struct solution {
    struct scene s;
    struct run e;
    status made, ran;
};

/* Creates a run of a scene with the overrides `key=value` of the list, which ends with NULL. */
static inline void solution_make_list(struct solution *a, const char *text, va_list list)
{
    memset(a, 0, sizeof *a);
    a->made = scene_with(&a->s, text, list);
    if (a->made == OK) a->made = engine_make(&a->e, &a->s, NULL);
    if (a->e.report) a->e.report->quiet = true;
    a->ran = a->made;
}

/* Creates a run of a scene with the overrides `key=value`, which end with NULL. */
static inline void solution_make(struct solution *a, const char *text, ...)
{
    va_list list;
    va_start(list, text);
    solution_make_list(a, text, list);
    va_end(list);
}

/* Creates a run as solution_make does, and runs it to its end. */
static inline void solution_run(struct solution *a, const char *text, ...)
{
    va_list list;
    va_start(list, text);
    solution_make_list(a, text, list);
    va_end(list);
    if (a->made == OK) a->ran = engine_run(&a->e);
}

/* Fails with the message unless the run reached its end. */
static inline void solution_done(const struct solution *a)
{
    if (a->ran != OK) fail_msg("%s", status_message());
}

static inline void solution_free(struct solution *a)
{
    engine_free(&a->e);
    scene_free(&a->s);
}

/* Fails with the name of a quantity unless its relative error is within `tolerance`. */
static inline void near_to(const char *what, real value, real expected, real tolerance)
{
    if (!(fabs(value - expected) <= tolerance * fabs(expected)))
        fail_msg("%s: %.9g where %.9g +- %.2g is expected", what, value, expected, tolerance * fabs(expected));
}

/* Returns the particle nearest to a position. */
static inline int64_t solution_at(const struct solution *a, real x, real y, real z)
{
    return particles_nearest(&a->e.part, (const real[DIM_MAX]){x, y, z});
}

/* Returns component d of the displacement of the particle nearest to a position [m]. */
static inline real solution_moved(const struct solution *a, int d, real x, real y, real z)
{
    const int64_t i = solution_at(a, x, y, z);
    return a->e.part.x[d][i] - a->e.part.X[d][i];
}

/* Returns the largest difference of two solutions over the largest displacement, at the particles of the second. */
static inline real solution_difference(const struct solution *a, const struct solution *b)
{
    const struct particles *p = &b->e.part;
    real most = 0, largest = 0;
    for (int64_t i = 0; i < p->n; i++) {
        const int64_t j = a->e.part.n == p->n
                              ? i
                              : solution_at(a, p->X[0][i], p->dim > 1 ? p->X[1][i] : 0, p->dim > 2 ? p->X[2][i] : 0);
        for (int d = 0; d < p->dim; d++) {
            const real u = p->x[d][i] - p->X[d][i];
            most = real_max(most, fabs(u - (a->e.part.x[d][j] - a->e.part.X[d][j])));
            largest = real_max(largest, fabs(u));
        }
    }
    return most / largest;
}

#endif
