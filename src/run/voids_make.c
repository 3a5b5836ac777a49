/* Finds the voids of the bodies of a run (slots, slits or gaps), which bonds do not cross and which cut the mesh. */
#include <math.h>
#include <stdio.h>

#include "base/memory.h"
#include "run/make.h"

/* Largest distance along one axis between two material points in the mesh cells around one node, plus a margin
 * [cells]. */
#define CELLS_REACH 1.515

real scene_interaction_distance_across_voids(const struct scene *s, real cutoff)
{
    const real cells = s->method == METHOD_PD ? 0 : CELLS_REACH * s->cell * s->spacing;
    return real_max(s->method == METHOD_MPM ? 0 : cutoff, cells);
}

/* Returns true if body number b of the scene s has a shape and is joined to another body or may have voids. v: planes
 * of symmetry. */
static bool body_may_have_voids(const struct scene *s, int b, const struct voids *v)
{
    const struct scene_body *body = &s->body[b];
    return !body->file && (body->joined != b || region_may_have_voids(&body->shape, v));
}

bool joined_bodies_are_all_defined_by_solids(const struct scene *s, int first_body)
{
    bool known = true;
    for (int b = 0; b < s->bodies; b++)
        if (s->body[b].joined == first_body)
            known = known && !s->body[b].file && !region_has_voxel_image(&s->body[b].shape);
    return known;
}

/* Lists in v the shapes of those bodies of the scene s that may have voids (slots, slits or gaps, across which no
 * bonds are made) and whose surface is known, and the shapes of all bodies joined to them. */
static void list_shapes(const struct scene *s, struct voids *v)
{
    uint8_t *wanted = NEW("voids.wanted", s->bodies, uint8_t);
    for (int b = 0; b < s->bodies; b++)
        if (body_may_have_voids(s, b, v))
            wanted[s->body[b].joined] = joined_bodies_are_all_defined_by_solids(s, s->body[b].joined);
    v->shape = NEW("voids.shape", s->bodies, const struct region *);
    v->body = NEW("voids.body", s->bodies, int);
    for (int b = 0; b < s->bodies; b++)
        if (wanted[s->body[b].joined])
            v->shape[v->shapes] = &s->body[b].shape, v->body[v->shapes++] = s->body[b].joined;
    memory_free(wanted);
}

bool material_tables_list_bodies_with_possible_voids(struct material_tables *tables, const struct scene *s,
                                                     const struct loads *loads)
{
    struct voids *v = &tables->voids;
    bool any = false;
    *v = (struct voids){.dim = s->dim, .spacing = s->spacing};
    tables->void_mirror = NEW("voids.mirror", s->boundaries, struct mirror_plane);
    for (int b = 0; b < s->boundaries; b++)
        if (s->boundary[b].kind == BOUNDARY_MIRROR)
            tables->void_mirror[v->mirrors++] =
                (struct mirror_plane){s->boundary[b].axis, loads->load[b].outside, s->boundary[b].at};
    v->mirror = tables->void_mirror;
    for (int b = 0; b < s->bodies; b++) any |= body_may_have_voids(s, b, v);
    if (any) list_shapes(s, v);
    return v->shapes > 0;
}
