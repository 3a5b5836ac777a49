/* Reads scenes from files and from memory. */
#ifndef CLEAVE_SCENE_READ
#define CLEAVE_SCENE_READ

#include "scene/scene.h"

/* Reads the scene (input file) `path` into *s, with the values of keys that override[overrides] replaces (option -s),
 * and checks it. Returns REFUSED for an invalid scene, with a message `file:line:column: fault; expected value`. Also
 * returns REFUSED for `method: auto`, which pilot runs have to resolve first (study/pilot.h). Nothing has to be
 * released then. Otherwise release s with scene_free. */
status scene_read(struct scene *s, const char *path, const struct scene_override *override, int overrides);

/* Reads a scene (text of an input file) from text[length] into *s, with the values of keys that override[overrides]
 * replaces (option -s), and checks it. Opens no file, not even to see whether particle lists exist. name: file name for
 * messages. Returns REFUSED, with a message, for an invalid scene and for `method: auto`; nothing has to be released
 * then. Otherwise release s with scene_free. */
status scene_read_text(struct scene *s, const char *text, size_t length, const char *name,
                       const struct scene_override *override, int overrides);

/* Requirements of a scene with `method: auto` on the pilot runs that choose its method and spacing (study/pilot.h). */
struct pilot_requirements {
    bool wanted;           /* the scene has `method: auto` */
    char figure[128];      /* result of summary.json whose error is bounded; "": not given */
    double within, budget; /* largest relative error of this result [1]; time for the runs [s] */
    double spacing;        /* given by the scene [m]; 0: not given */
    double spacing_most;   /* largest one that suits the strengths of bonds that soften [m]; INFINITY: any */
    char model[16];        /* given by the scene; "": not given */
    bool at_rest;          /* the solver is not explicit */
    bool has_accuracy;     /* the scene has the key `accuracy` */
    /* The scene with a provisional method (adaptive or pd) and, where none is given, the spacing of
     * spacing_that_resolves_all_lengths (1 m if there is none); release it with scene_free. */
    struct scene provisional;
};

/* Reads the scene (input file) `path`, with the values of keys that override[overrides] replaces (option -s). If it has
 * `method: auto`, sets requirements->wanted to true, stores in *requirements what it requires of the pilot runs, and
 * leaves *s empty. Otherwise sets requirements->wanted to false and stores the scene in *s, which the caller releases
 * with scene_free. Returns REFUSED, with a message, for an invalid scene. */
status scene_read_unless_pilot_runs_are_needed(struct scene *s, struct pilot_requirements *requirements,
                                               const char *path, const struct scene_override *override, int overrides);

#endif
