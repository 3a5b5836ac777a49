/* Warnings of particles that nothing joins to others: they feel no force and fly away, or leave an equilibrium
 * without a solution. */
#include <stdio.h>

#include "base/memory.h"
#include "engine/engine.h"

enum { MASS_POINTS = 7 }; /* bodies of so few particles are mass points that were placed one by one */

/* Particles of a body without a neighbour. */
struct lone {
    int64_t all, n, first; /* of the body; without neighbour; the first of these */
};

static void lone_add(struct lone *l, int64_t i)
{
    if (l->n++ == 0) l->first = i;
}

/* Does a row of bonds hold none? */
static bool row_empty(const struct bonds *b, int64_t row)
{
    struct bond_iterator it = bonds_of_row(b, row);
    return !bond_next(&it);
}

/* Is a body filled from a list or a file, so that places of its lattice need no neighbours? */
static bool from_file(const struct scene *s, int body)
{
    bool any = s->body[body].file != NULL;
    for (int k = 0; k < s->body[body].shape.n; k++) {
        const enum solid_kind kind = s->body[body].shape.solid[k].kind;
        any |= kind == SOLID_HULL || kind == SOLID_VOXELS;
    }
    return any;
}

/* Counts peridynamic particles by their rows of bonds, and material points of bodies from files by what lies within a
 * cell of theirs. */
static void lone_count(const struct engine *e, struct lone *lone)
{
    const struct particles *p = &e->part;
    const struct scene *s = e->scene;
    struct near near = {0};
    for (int64_t i = 0; i < p->n; i++) lone[p->body[i]].all++;
    for (int64_t row = 0; row < e->bonds.rows; row++) {
        const int64_t i = e->bonds.particle[row];
        if (i >= 0 && i < p->n && p->kind[i] == KIND_PD && row_empty(&e->bonds, row)) lone_add(&lone[p->body[i]], i);
    }
    for (int64_t i = 0; i < p->n && s->method != METHOD_PD; i++) {
        if (p->kind[i] == KIND_PD || !from_file(s, p->body[i])) continue;
        near_find(&near, &e->cells, p, i, real_max(1.5, s->cell) * s->spacing, false);
        if (near.n == 0) lone_add(&lone[p->body[i]], i);
    }
    memory_free(near.at);
}

void engine_warn_of_lone(const struct engine *e, struct warnings *to)
{
    const struct scene *s = e->scene;
    struct lone *lone = NEW("warn.lone", s->bodies, struct lone);
    lone_count(e, lone);
    for (int b = 0; b < s->bodies; b++) {
        real X[DIM_MAX] = {0};
        char place[96] = "";
        if (lone[b].n == 0 || lone[b].all <= MASS_POINTS) continue;
        particle_place(&e->part, lone[b].first, X);
        for (int d = 0, used = 0; d < s->dim; d++)
            used += snprintf(place + used, sizeof place - (size_t)used, "%s%.6g", d ? ", " : "", X[d]);
        warnings_add(to, "body %s: %lld of its particles ha%s no neighbour, the first at (%s) m: nothing holds %s%s",
                     s->body[b].name, (long long)lone[b].n, lone[b].n == 1 ? "s" : "ve", place,
                     lone[b].n == 1 ? "it" : "them",
                     scene_at_rest(s) ? ", and there is no equilibrium; remove what lies alone" : "");
    }
    memory_free(lone);
}
