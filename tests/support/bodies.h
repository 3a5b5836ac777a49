/* Small bodies with positions set by hand, a notched plate, and archives in memory, for tests of crack tips and other
 * observers. */
#ifndef CLEAVE_TESTS_BODIES
#define CLEAVE_TESTS_BODIES

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "data/material.h"
#include "base/memory.h"
#include "near.h"
#include "fracture/tips.h"

/* Tolerance of sums of a few hundred terms of order one: their round-off is below a hundred times 2^-53. */
#define ROUND_OFF 1e-13
#define BODY_MASS 1.7 /* mass of a particle [kg] */

/* ---- a lattice of spacing 1 m, particles at half-integers -------------------------------------------------------- */

/* A body of particles on a lattice, and the cells by which neighbours are found. */
struct body {
    struct particles p;
    struct cells c;
};

/* Creates a body of count[0] x count[1] x count[2] particles (dim factors) on a lattice of spacing 1 m, from 0.5 m in
 * each direction, with volume 1, mass BODY_MASS and their index as id; its cells serve to find neighbours within 3.1 m.
 * Release it with body_free. */
static inline void body_make(struct body *b, int dim, const int *count)
{
    int64_t n = 1;
    for (int d = 0; d < dim; d++) n *= count[d];
    particles_make(&b->p, dim, n, 0);
    for (int64_t i = 0; i < n; i++) {
        int64_t rest = i;
        for (int d = 0; d < dim; d++, rest /= count[d - 1]) b->p.X[d][i] = b->p.x[d][i] = 0.5 + (real)(rest % count[d]);
        b->p.volume0[i] = b->p.volume[i] = 1, b->p.mass[i] = BODY_MASS;
        b->p.id[i] = (int32_t)i;
    }
    cells_make_for_neighbour_search(&b->c, &b->p, 3.1);
}

/* Frees the particles and cells of the body b. */
static inline void body_free(struct body *b)
{
    cells_free(&b->c);
    particles_free(&b->p);
}

/* Returns the index of the particle whose reference position is (x, y, z) [m]; the test fails if there is none. */
static inline int64_t particle_at(const struct body *b, real x, real y, real z)
{
    const real X[DIM_MAX] = {x, y, z};
    for (int64_t i = 0; i < b->p.n; i++) {
        bool same = true;
        for (int d = 0; d < b->p.dim; d++) same = same && fabs(b->p.X[d][i] - X[d]) < 1e-9;
        if (same) return i;
    }
    fail_msg("no particle at %g %g %g", x, y, z);
    return -1;
}

/* Sets damage 0.5 for the particle whose reference position is (x, y, z) [m], and makes it peridynamic, since only
 * peridynamic particles lose bonds. The test fails if there is no such particle. */
static inline void hurt(struct body *b, real x, real y, real z)
{
    const int64_t i = particle_at(b, x, y, z);
    b->p.damage[i] = 0.5, b->p.kind[i] = KIND_PD;
    particles_rebuild_lists_by_kind(&b->p);
}

/* ---- archives in memory ------------------------------------------------------------------------------------------ */

enum { ENTRIES = 64 };

/* An archive in memory, in place of a restart file: n entries, each a name with a copy of its data. Use it as `file` of
 * a struct archive with the function store_exchange; release it with store_free. */
struct store {
    int n;
    struct {
        char name[64];
        size_t size;
        char *data;
    } entry[ENTRIES];
};

/* Saves the entry called `name`, `size` bytes at `data`, in the store a->file if a->saving is true, else restores these
 * bytes from it: the exchange function of a struct archive whose file is a store. The test fails if a name is saved
 * twice, is restored without having been saved, or has another size. Returns OK. */
static inline status store_exchange(struct archive *a, const char *name, void *data, size_t size)
{
    struct store *s = a->file;
    for (int k = 0; k < s->n; k++) {
        if (strcmp(s->entry[k].name, name) != 0) continue;
        assert_false(a->saving); /* names are unique */
        assert_int_equal(s->entry[k].size, size);
        memcpy(data, s->entry[k].data, size);
        return OK;
    }
    assert_true(a->saving && s->n < ENTRIES);
    snprintf(s->entry[s->n].name, sizeof s->entry[s->n].name, "%s", name);
    s->entry[s->n].size = size;
    s->entry[s->n].data = malloc(size);
    memcpy(s->entry[s->n++].data, data, size);
    return OK;
}

/* Frees the data of all entries of the store s. */
static inline void store_free(struct store *s)
{
    for (int k = 0; k < s->n; k++) free(s->entry[k].data);
}

/* Creates a plate b of 40 x 20 particles with a pre-crack along a row of particles, from the left edge to the point
 * (10, 10.5) [m], in which the particles of this row and of the next row below are damaged up to x = 8.5 m, and finds
 * its crack tips t. window: time over which the crack speed is averaged [s]. Release both with notched_free. */
static inline void notched_make(struct body *b, struct crack_tips *t, real window)
{
    body_make(b, 2, (const int[]){40, 20});
    for (real x = 0.5; x < 9; x++) hurt(b, x, 10.5, 0), hurt(b, x, 9.5, 0);
    real corner[2][DIM_MAX] = {{-1, 10.5, 0}, {10, 10.5, 0}};
    struct crack crack = {.n = 2, .corner = corner};
    tips_make_at_precrack_ends(t, &b->p, &b->c, &crack, 1, 1, window);
}

/* Frees the plate b and the crack tips t of notched_make. */
static inline void notched_free(struct body *b, struct crack_tips *t)
{
    tips_free(t);
    body_free(b);
}

/* Returns a brittle material with Young's modulus 200 Pa, Poisson's ratio 0.25, density 1 kg/m^3 and critical stretch
 * 1, with the constants derived for the space `space`. */
static inline struct material steel(enum space space)
{
    struct material m = {.young = 200, .poisson = 0.25, .density = 1, .critical_stretch = 1};
    material_compute_derived_constants(&m, space);
    return m;
}

#endif
