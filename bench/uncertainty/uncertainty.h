/* Scenes with results whose exact values are known, for `cleave bench uncertainty` and `cleave bench pilot`. */
#ifndef CLEAVE_UNCERTAINTY_BENCH
#define CLEAVE_UNCERTAINTY_BENCH

#include "bench/common/bench.h"

enum { KNOWN_FIGURES_MOST = 3, KNOWN_VARIANTS_MOST = 6, KNOWN_SPACINGS_MOST = 3 };

/* A result of summary.json and its exact value, from the closed form stated at the scene. */
struct known_figure {
    const char *name;
    double exact;
};

/* A scene with known results: its text, numerical variants and spacings with units. */
struct known_scene {
    const char *name, *text;
    struct known_figure figure[KNOWN_FIGURES_MOST];
    const char *variant[KNOWN_VARIANTS_MOST][2]; /* name, and scene keys as lines */
    const char *spacing[KNOWN_SPACINGS_MOST];
    bool quick;
};

/* A scene for pilot runs (pilot_scenes.c), with a result and its exact value. */
struct pilot_scene {
    const char *name, *text, *figure;
    double exact;
};
extern const struct pilot_scene pilot_scenes[];
extern const int pilot_scenes_n;

extern const struct known_scene known_scenes[];
extern const int known_scenes_n;

#endif
