/* Checks that bodies that the input file joins by interfaces are near enough to each other for bonds. */
#include "base/memory.h"
#include "run/make.h"

/* Returns true if a particle inside the shape `one` has a neighbour within `cutoff` [m] inside the shape `other`, so
 * that a bond joins both bodies. cells: search cells of p; tolerance: distance outside a shape that counts as inside
 * [m]. */
static bool are_near(const struct particles *p, const struct cells *cells, real cutoff, const struct region *one,
                     const struct region *other, real tolerance)
{
    struct neighbour_list near = {0};
    bool found = false;
    for (int64_t i = 0; i < p->n && !found; i++) {
        const real X[DIM_MAX] = {p->X[0][i], p->dim > 1 ? p->X[1][i] : 0, p->dim > 2 ? p->X[2][i] : 0};
        if (!region_contains(one, X, p->dim, tolerance)) continue;
        particles_list_neighbours_within_radius(&near, cells, p, i, cutoff, false);
        for (int k = 0; k < near.n && !found; k++) {
            const int32_t j = near.at[k];
            const real Y[DIM_MAX] = {p->X[0][j], p->dim > 1 ? p->X[1][j] : 0, p->dim > 2 ? p->X[2][j] : 0};
            found = j < p->n && region_contains(other, Y, p->dim, tolerance);
        }
    }
    memory_free(near.at);
    return found;
}

status joined_bodies_check_within_bond_reach(const struct scene *s, const struct particles *p,
                                             const struct cells *cells, real cutoff)
{
    const real tolerance = ON_SURFACE * s->spacing;
    for (int k = 0; k < s->interfaces; k++) {
        const struct scene_interface *face = &s->interface[k];
        const struct scene_body *one = &s->body[face->body[0]], *other = &s->body[face->body[1]];
        if (!face->joined || one->file || other->file ||
            are_near(p, cells, cutoff, &one->shape, &other->shape, tolerance))
            continue;
        return status_set(REFUSED,
                          "interfaces[%d]: %s and %s are farther apart than the horizon, so no bond joins them; let "
                          "them touch, or remove the interface",
                          k, one->name, other->name);
    }
    return OK;
}
