/* How much of each cell of a body's lattice its shape covers (check_cover.c). */
#ifndef CLEAVE_CHECK_COVER
#define CLEAVE_CHECK_COVER

#include "scene/scene.h"

/* Cells round the places of a lattice, x fastest. */
struct cover {
    int dim;
    int64_t n[DIM_MAX], cells;
    real first[DIM_MAX], spacing; /* place of cell 0 [m] */
    float *share;                 /* [cells] that lies in the shape [1] */
    uint8_t *filled;              /* [cells] does a particle stand there? */
};

/* False, with nothing to free: a body in a line, from a list, without an end, or of too many cells to be quick. */
bool cover_make(struct cover *c, const struct scene *s, int body);
void cover_place(const struct cover *c, int64_t cell, int64_t *at);
void cover_free(struct cover *c);

#endif
