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
/* What was chosen and why, in a few lines; nothing where the scene says itself (auto.c). */
void scene_choice_print(const struct scene *s, FILE *out);

#endif
