/* Room `auto`: scenes that leave the choice of the method to the program. It knows the room `scene`; commands, engine
 * and benches read scenes through it.
 *
 * Reads scenes. `method: auto` is resolved on the way: the cheapest method of the cost-accuracy table that is
 * accurate enough stands in the scene as if its user had written it. */
#ifndef CLEAVE_SCENE_READ
#define CLEAVE_SCENE_READ

#include "scene/scene.h"

/* Reads and checks a file. On REFUSED the message is `file:line:column: what; what would be right`; nothing is
 * left to free. */
status scene_read(struct scene *s, const char *path, const struct scene_override *override, int overrides);
/* The same from memory; no file is touched, not even to see whether particle lists exist. `name` stands in messages. */
status scene_read_text(struct scene *s, const char *text, size_t length, const char *name,
                       const struct scene_override *override, int overrides);
/* Where no problem of the table is like a scene with method auto, or its `accuracy` names a figure, runs at coarse
 * spacings are to choose (study/pilot.h). */
struct pilot_wish {
    bool wanted;
    char why[480];                       /* the table does not answer */
    char figure[128];                    /* that is to be accurate; "": not named */
    double within, budget;               /* its largest error [1]; time for the runs [s] */
    double spacing;                      /* that the scene fixes [m]; 0: none */
    char model[16];                      /* the same; "": none */
    bool at_rest;                        /* it has a static solver */
    bool has_accuracy, has_table;        /* keys that the scene gives */
    struct scene first;                  /* with stand-ins for what is to be chosen; scene_free */
};
/* Reads a scene as scene_read does, unless it wants that: w->wanted with OK, and no scene. */
status scene_read_or_wish(struct scene *s, struct pilot_wish *w, const char *path,
                          const struct scene_override *override, int overrides);

/* Largest spacing <= h [m] that divides the edges of the first solid, and those of gaps and cracks along the axes, into
 * whole numbers (`even`: of pairs); h if there is none near it. */
real auto_spacing_fit(const struct scene *s, real h, bool even);

/* What was chosen and why, in a few lines; nothing where the scene says itself (auto.c). */
void scene_choice_print(const struct scene *s, FILE *out);

#endif
