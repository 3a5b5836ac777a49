/* A small scene made by hand, for tests of the filling of bodies. */
#ifndef CLEAVE_TESTS_SETTING
#define CLEAVE_TESTS_SETTING

#include <stdio.h>

#include "engine/engine.h"

enum { EVERYTHING = WITH_EVERYTHING, SOLIDS = 3, BODIES = 2, INITIALS = 3 };

/* A scene together with the arrays to which it refers: two materials, two bodies with up to three solids each, and
 * three initial conditions. */
struct setting {
    struct scene scene;
    struct material material[2];
    struct scene_body body[BODIES];
    struct solid solid[BODIES][SOLIDS];
    struct scene_initial initial[INITIALS];
};

/* Makes a scene of the material point method at spacing 0.5 m with two materials and one body `plate`, the box from 0
 * to edge[dim] [m], in *s. A second body `layer`, whose solid is not yet set, and three initial conditions for all
 * bodies are prepared but not counted: increase scene.bodies and scene.initials to use them. */
static inline void setting_make(struct setting *s, enum space space, const real *edge)
{
    static const char *const name[BODIES] = {"plate", "layer"};
    *s = (struct setting){0};
    struct scene *c = &s->scene;
    c->path = "folder/test.yaml";
    c->space = space, c->dim = space_dim(space);
    c->thickness = c->section = 1, c->spacing = 0.5, c->method = METHOD_MPM;
    c->materials = 2, c->material = s->material;
    c->bodies = 1, c->body = s->body;
    c->initial = s->initial;
    for (int m = 0; m < 2; m++) {
        s->material[m] = (struct material){.young = 1e9 * (m + 1), .poisson = 0.25, .density = 1000 * (m + 1)};
        material_compute_derived_constants(&s->material[m], space);
    }
    for (int b = 0; b < BODIES; b++) {
        s->body[b].shape = (struct region){.n = 1, .solid = s->solid[b]};
        s->body[b].joined = b;
        snprintf(s->body[b].name, sizeof s->body[b].name, "%s", name[b]);
    }
    s->solid[0][0].kind = SOLID_BOX;
    for (int d = 0; d < c->dim; d++) s->solid[0][0].to[d] = edge[d];
    for (int k = 0; k < INITIALS; k++) s->initial[k].body = -1;
}

#endif
