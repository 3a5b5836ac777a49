/* What the files of the engine share. */
#ifndef CLEAVE_ENGINE_INTERNAL
#define CLEAVE_ENGINE_INTERNAL

#include "data/hollow.h"
#include "engine/engine.h"

/* Makes all parts of a run, empty; frees them and what they own: nothing where they have not been made. */
void run_parts_make(struct run *e);
void run_parts_free(struct run *e);

/* A run whose place another takes that has other particles. */
struct predecessor {
    struct run *run;
    int32_t *now; /* [its particles and images] their numbers in the other, -1: not there */
};
/* engine_make with these cells hollow. `before` not NULL: with its particles, bonds and time; the rest that its steps
 * have changed, and levels of cells, are left to the caller. */
status engine_make_again(struct run *e, const struct scene *s, struct output *out, struct hollow hollow,
                         struct predecessor *before);
/* Makes a run again with the particles that these levels of cells need, and goes on where it was. */
status engine_refill(struct run *e, const uint8_t *level);
/* What a run takes of its predecessor while it is made: particles, once it has images; what load has broken. */
void engine_take_particles(struct run *e, struct predecessor *before);
void engine_take_bonds(struct run *e, const struct predecessor *before);
/* Saves or restores the state of loads and of all parts, as archive->scope says. */
status parts_archive(struct run *e, struct archive *a);

/* Warns of particles that have no neighbour. */
void engine_warn_of_lone(const struct scene *s, const struct cells *cells, const struct bonds *b,
                         const struct particles *p, struct warnings *to);
/* Warns of loads whose speed breaks bonds beside what they drive. */
void engine_warn_of_speed(const struct scene *s, const struct loads *l, const struct particles *p, struct warnings *to);

#endif
