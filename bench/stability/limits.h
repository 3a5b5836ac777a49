/* Scenes in which methods fail, each with its threshold and the remedy: one table for the bench that
 * draws it and the tests that hold it (design sheet of the material point method, 1.2, 1.3, 2, 4g). */
#ifndef CLEAVE_BENCH_LIMITS
#define CLEAVE_BENCH_LIMITS

#include "bench/common/bench.h"

enum { FAILING_FIGURES = 3, FAILING_SET = 11 };

/* What is measured in a scene: a sound method stays at or below the threshold. */
struct limits_figure {
    const char *quantity;
    double threshold;
};

/* A method in a scene. `known`: where its figures lie, from the sheet, a closed form or as measured. It fails where
 * one is above its threshold: then `remedy` says what to do, and is NULL otherwise. */
struct limits_row {
    const char *method, *remedy;
    const char *set[FAILING_SET]; /* keys of the scene and their values, NULL at the end */
    double given;                 /* what else the scene hangs on */
    struct {
        double low, high;
    } known[FAILING_FIGURES];
};

struct limits_scene {
    const char *name, *given;                     /* how to print what a row gives; NULL: the method says it */
    struct limits_figure figure[FAILING_FIGURES]; /* quantity NULL: no more */
    const struct limits_row *row;
    int rows;
    status (*measure)(const struct limits_row *r, double *to);
};

enum { FAILING_SCENES = 18 };
extern const struct limits_scene *const limits_scene[FAILING_SCENES];
/* The figures of a row, on one thread: bodies are small; NAN where it fails. */
status limits_measure(const struct limits_scene *s, const struct limits_row *r, double figure[FAILING_FIGURES]);
/* Method and what is given. */
void limits_label(const struct limits_scene *s, const struct limits_row *r, char *text, size_t size);
int limits_figures(const struct limits_scene *s);
bool limits_holds(const struct limits_scene *s, const double *figure);

/* The engine of a scene with what the row sets; `text` as printf writes it. Free with bench_engine_free. */
status limits_make(struct run *e, struct scene *s, const struct limits_row *r, const char *text, ...)
    __attribute__((format(printf, 4, 5)));

#endif
