/* Fragments: sets of particles connected by unbroken bonds. */
#ifndef CLEAVE_FRAGMENTS
#define CLEAVE_FRAGMENTS

#include "bonds/bonds.h"

/* A fragment: a set of particles that unbroken bonds connect. body: number of the body to which the particles belong;
 * particles: number of particles. */
struct fragment {
    int body;
    int64_t particles;
    int32_t first;                     /* lowest particle index in the fragment */
    real mass, x[DIM_MAX], v[DIM_MAX]; /* mass [kg]; centre of mass [m], velocity of the centre [m/s] */
};

/* All fragments (sets of particles that unbroken bonds connect) of the bodies of a run, fragment[n], and the particles
 * without a bond. Both arrays are owned. */
struct fragments {
    int64_t n; /* fragments of two particles or more, the heaviest first */
    struct fragment *fragment;
    int32_t *of;       /* [particles of the body] index of the fragment of a particle; -1: none */
    int64_t singles;   /* number of particles without a bond, which are no fragments */
    real mass_singles; /* total mass of particles without a bond [kg] */
};

/* Finds the fragments: sets of peridynamic particles of p that unbroken bonds of b connect. Initialises f and stores
 * the fragments there by decreasing mass; particles without a bond are only counted. Release with fragments_free. */
void fragments_find_by_intact_bonds(struct fragments *f, const struct bonds *b, const struct particles *p);

/* Frees the arrays of f, the fragments. */
void fragments_free(struct fragments *f);

#endif
