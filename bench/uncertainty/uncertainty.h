/* What the files of `cleave bench uncertainty` share: scenes with figures whose true values are known. */
#ifndef CLEAVE_UNCERTAINTY_BENCH
#define CLEAVE_UNCERTAINTY_BENCH

#include "bench/common/bench.h"

enum { KNOWN_FIGURES_MOST = 3, KNOWN_VARIANTS_MOST = 6, KNOWN_SPACINGS_MOST = 3 };

/* A figure of summary.json and its true value, from the closed form that the scene's comment names. */
struct known_figure {
    const char *name;
    double exact;
};

/* A scene of known answers: its text, the ways in which it is computed (lines of keys), spacings as numbers with
 * units. */
struct known_scene {
    const char *name, *text;
    struct known_figure figure[KNOWN_FIGURES_MOST];
    const char *variant[KNOWN_VARIANTS_MOST][2]; /* name, lines */
    const char *spacing[KNOWN_SPACINGS_MOST];
    bool quick;
};

/* A scene for pilot runs (pilot_scenes.c). */
struct pilot_scene {
    const char *name, *text, *figure;
    double exact;
};
extern const struct pilot_scene pilot_scenes[];
extern const int pilot_scenes_n;

extern const struct known_scene known_scenes[];
extern const int known_scenes_n;

#endif
