/* Scenes in which methods fail, each with its threshold and what cures it: one table for the bench that
 * draws it and the tests that hold it (design sheet of the material point method, 1.2, 1.3, 2, 4g). */
#ifndef CLEAVE_BENCH_LIMITS
#define CLEAVE_BENCH_LIMITS

#include "bench/common/bench.h"

enum { FAILING_FIGURES = 3, FAILING_SET = 11 };

/* What is measured in a scene: a sound method stays at or below the threshold. */
struct failing_figure { const char *quantity; double threshold; };

/* A method in a scene. `known`: where its figures lie, from the sheet, a closed form or as measured. It fails where
 * one is above its threshold: then `cure` says what to do, and is NULL otherwise. */
struct failing_row {
    const char *method, *remedy;
    const char *set[FAILING_SET];        /* keys of the scene and their values, NULL at the end      */
    double given;                        /* what else the scene hangs on                             */
    struct { double low, high; } known[FAILING_FIGURES];
};

struct failing_scene {
    const char *name, *given;            /* how to print what a row gives; NULL: the method says it  */
    struct failing_figure figure[FAILING_FIGURES];  /* quantity NULL: no more                        */
    const struct failing_row *row;
    int rows;
    status (*measure)(const struct failing_row *r, double *to);
};

enum { FAILING_SCENES = 18 };
extern const struct failing_scene *const failing_scene[FAILING_SCENES];
/* The figures of a row, on one thread: bodies are small; NAN where it fails. */
status failing_measure(const struct failing_scene *s, const struct failing_row *r, double figure[FAILING_FIGURES]);
/* Method and what is given. */
void failing_label(const struct failing_scene *s, const struct failing_row *r, char *text, size_t size);
int failing_figures(const struct failing_scene *s);
bool failing_holds(const struct failing_scene *s, const double *figure);

/* The engine of a scene with what the row sets; `text` as printf writes it. Free with bench_engine_free. */
status failing_make(struct engine *e, struct scene *s, const struct failing_row *r, const char *text, ...)
    __attribute__((format(printf, 4, 5)));
/* Velocities [m/s] of particles and of the nodes of a mesh by place. */
typedef void failing_field(const void *context, const real *X, real *v);
void failing_start(struct engine *e, failing_field *field, const void *context);

#endif
