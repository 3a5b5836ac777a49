/* Fragments: parts of bodies that bonds still hold together. */
#ifndef CLEAVE_FRAGMENTS
#define CLEAVE_FRAGMENTS

#include "bonds/bonds.h"

struct fragment {
    int body;
    int64_t particles;
    int32_t first;                     /* its particle of the lowest number */
    real mass, x[DIM_MAX], v[DIM_MAX]; /* [kg]; centre of mass [m], its velocity [m/s] */
};

struct fragments {
    int64_t n; /* of two particles or more, the heaviest first */
    struct fragment *fragment;
    int32_t *of;       /* [n of the body] number of a particle's fragment; -1: none */
    int64_t singles;   /* particles without any bond ... */
    real mass_singles; /* ... and their mass [kg] */
};

/* Of all peridynamic particles by the bonds that are left. */
void fragments_find(struct fragments *f, const struct bonds *b, const struct particles *p);
void fragments_free(struct fragments *f);

#endif
