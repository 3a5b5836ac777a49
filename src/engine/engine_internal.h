/* Declarations shared by the files of src/engine. */
#ifndef CLEAVE_ENGINE_INTERNAL
#define CLEAVE_ENGINE_INTERNAL

#include "data/hollow.h"
#include "engine/engine.h"

/* Creates all parts of a run in an empty state. */
void run_parts_make(struct run *e);

/* Releases all parts of a run and what they own; parts that were not created are skipped. */
void run_parts_free(struct run *e);

/* A run that is replaced by one with other particles. */
struct predecessor {
    struct run *run;
    int32_t *now; /* [particles and images of `run`] their indices in the new run; -1: not in the new run */
};

/* Creates a run as engine_make does, with given hollow cells. before: if not NULL, particles, bonds and time are taken
 * from this run; other state that its steps have changed, and the levels of cells, are set by the caller. */
status engine_make_again(struct run *e, const struct scene *s, struct output *out, struct hollow hollow,
                         struct predecessor *before);

/* Recreates a run with the particles that the given levels of cells need, and continues from its current state. level:
 * refinement level of each cell. */
status engine_refill(struct run *e, const uint8_t *level);

/* Transfers the particles of the predecessor to a run that is being created; call when its images exist. */
void engine_take_particles(struct run *e, struct predecessor *before);

/* Transfers the broken bonds of the predecessor to a run that is being created. */
void engine_take_bonds(struct run *e, const struct predecessor *before);

/* Saves or restores the state of loads and of all parts, as far as a->scope includes it. */
status parts_archive(struct run *e, struct archive *a);

/* Warns about particles without neighbours. */
void engine_warn_of_lone(const struct scene *s, const struct cells *cells, const struct bonds *b,
                         const struct particles *p, struct warnings *to);

/* Warns about figures that look like mistakes of units (`accept` of the scene excepted). clock: time step and number of
 * steps; wave_speed: fastest of the materials [m/s]. */
void engine_warn_of_units(const struct scene *s, const struct particles *p, const struct loads *l,
                          const struct run_clock *clock, real wave_speed, struct warnings *to);

/* Warns about loads whose speed breaks the bonds next to the particles that they drive. */
void engine_warn_of_speed(const struct scene *s, const struct loads *l, const struct particles *p, struct warnings *to);

#endif
