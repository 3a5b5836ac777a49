/* Fragments: sets of particles connected by unbroken bonds. */
#ifndef CLEAVE_FRAGMENTS
#define CLEAVE_FRAGMENTS

#include "bonds/bonds.h"

struct fragment {
    int body;
    int64_t particles;
    int32_t first;                     /* its particle with the lowest index */
    real mass, x[DIM_MAX], v[DIM_MAX]; /* mass [kg]; centre of mass [m], velocity of the centre [m/s] */
};

struct fragments {
    int64_t n; /* fragments of two particles or more, the heaviest first */
    struct fragment *fragment;
    int32_t *of;       /* [particles of the body] index of the fragment of a particle; -1: none */
    int64_t singles;   /* number of particles without a bond ... */
    real mass_singles; /* ... and their mass [kg] */
};

/* Finds the fragments of a body: sets of peridynamic particles that unbroken bonds of b connect. Writes them to f,
 * which is initialised here, sorted by decreasing mass; particles without a bond are only counted. Release with
 * fragments_free. */
void fragments_find_by_intact_bonds(struct fragments *f, const struct bonds *b, const struct particles *p);

/* Frees the arrays of f. */
void fragments_free(struct fragments *f);

#endif
