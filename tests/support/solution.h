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

/* A scene `s` and its run `e`. made: status of reading the scene and creating the run; ran: status of the run to its
 * end, if it was asked for, else the same as `made`. Release with solution_free. */
struct solution {
    struct scene s;
    struct run e;
    status made, ran;
};

/* Reads a scene from `text`, with the overrides of its keys in `list` (at most 16 strings `key=value`, then NULL), and
 * creates its run in *a. Stores the status in a->made. */
static inline void solution_make_list(struct solution *a, const char *text, va_list list)
{
    memset(a, 0, sizeof *a);
    a->made = scene_with(&a->s, text, list);
    if (a->made == OK) a->made = run_set_up_from_scene(&a->e, &a->s, NULL);
    if (a->e.report) a->e.report->quiet = true;
    a->ran = a->made;
}

/* Reads a scene from `text`, with overrides of its keys as further arguments (at most 16 strings `key=value`, then
 * NULL), and creates its run in *a. Stores the status in a->made. */
static inline void solution_make(struct solution *a, const char *text, ...)
{
    va_list list;
    va_start(list, text);
    solution_make_list(a, text, list);
    va_end(list);
}

/* Creates a run in *a as solution_make does and, if this succeeds, runs it to its end. Stores the status in a->ran. */
static inline void solution_run(struct solution *a, const char *text, ...)
{
    va_list list;
    va_start(list, text);
    solution_make_list(a, text, list);
    va_end(list);
    if (a->made == OK) a->ran = run_advance_to_end_time(&a->e);
}

/* Fails the test with the message of the last error unless a->ran is OK. */
static inline void solution_done(const struct solution *a)
{
    if (a->ran != OK) fail_msg("%s", status_message());
}

/* Frees the run and the scene of *a, if they were created. */
static inline void solution_free(struct solution *a)
{
    run_free_memory(&a->e);
    scene_free(&a->s);
}

/* Fails the test unless |value - expected| <= tolerance |expected|. what: name of the quantity for the message. */
static inline void near_to(const char *what, real value, real expected, real tolerance)
{
    if (!(fabs(value - expected) <= tolerance * fabs(expected)))
        fail_msg("%s: %.9g where %.9g +- %.2g is expected", what, value, expected, tolerance * fabs(expected));
}

/* Returns the index of the particle whose reference position is nearest to (x, y, z) [m]. */
static inline int64_t solution_at(const struct solution *a, real x, real y, real z)
{
    return particles_index_nearest_to_position(&a->e.part, (const real[DIM_MAX]){x, y, z});
}

/* Returns component d of the displacement [m] of the particle nearest to the reference position (x, y, z) [m]. */
static inline real solution_moved(const struct solution *a, int d, real x, real y, real z)
{
    const int64_t i = solution_at(a, x, y, z);
    return a->e.part.x[d][i] - a->e.part.X[d][i];
}

/* Returns the largest difference between displacement components of the solutions a and b at the particles of b,
 * divided by the largest component of b. If a and b have unequal numbers of particles, each particle of b is compared
 * with the nearest particle of a. */
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
