/* Scenes in which methods fail, with thresholds and remedies. The table is used by the bench that draws it and by the
 * tests that check it. */
#ifndef CLEAVE_BENCH_LIMITS
#define CLEAVE_BENCH_LIMITS

#include "bench/common/bench.h"

enum { FAILING_FIGURES = 3, FAILING_SET = 11 };

/* A quantity that is measured in a failing scene: a correct method stays at or below the threshold. */
struct limits_figure {
    const char *quantity;
    double threshold;
};

/* A method in a scene. known: expected ranges of the quantities, from a closed form, the literature or a measurement.
 * The method fails if one is above its threshold; then `remedy` states the advice, else it is NULL. */
struct limits_row {
    const char *method, *remedy;
    const char *set[FAILING_SET]; /* keys of the scene and their values in turn, terminated by NULL */
    double given;                 /* parameter of the scene */
    struct {
        double low, high;
    } known[FAILING_FIGURES];
};

/* A scene in which some numerical methods fail, with the quantities that show it and a row for each method. */
struct limits_scene {
    const char *name, *given;                     /* given: printf format of the parameter; NULL: the method states
                                                   * it */
    struct limits_figure figure[FAILING_FIGURES]; /* quantity NULL: end of the list */
    const struct limits_row *row;
    int rows;
    status (*measure)(const struct limits_row *r, double *to); /* Measures a row. */
};

enum { FAILING_SCENES = 18 };
extern const struct limits_scene *const limits_scene[FAILING_SCENES];

/* Runs the scene s with the method of row r, on one thread since bodies are small, and stores the measured quantities
 * in measured[]; NAN if the run fails. Returns REFUSED if the scene is invalid. */
status limits_measure(const struct limits_scene *s, const struct limits_row *r, double measured[FAILING_FIGURES]);

/* Writes the label of row r of the scene s, its method and parameter, to text[capacity]. */
void limits_label(const struct limits_scene *s, const struct limits_row *r, char *text, size_t capacity);

/* Returns the number of quantities that are measured in the scene s, the length of the list s->figure. */
int limits_quantity_count(const struct limits_scene *s);

/* Returns true if all quantities measured[] of the scene s are at or below their thresholds, as those of a correct
 * method are. */
bool limits_quantities_are_below_thresholds(const struct limits_scene *s, const double *measured);

/* Creates the run of a scene with the scene keys of row r as overrides, and stores the scene in *s. text: the scene,
 * a format of printf followed by its arguments. Returns REFUSED or FAILED if the scene is invalid. Release with
 * bench_engine_free. */
status limits_make_run_of_scene(struct run *run, struct scene *s, const struct limits_row *r, const char *text, ...)
    __attribute__((format(printf, 4, 5)));

#endif
