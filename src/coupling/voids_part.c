/* Treats voids (gaps in a body) that are too narrow for a grid: makes particles beside them peridynamic, or warns that
 * grid nodes couple their two sides. */
#include <math.h>
#include <stdio.h>

#include "base/memory.h"
#include "grid/grid_part.h"
#include "run/make.h"

#define ALONG 0.999 /* least cosine between an axis and a direction that counts as along the axis */

bool mesh_cannot_have_free_surfaces_at_voids(const struct grid *g, const struct scene *s)
{
    return s->dim == 1 || grid_has_mirror_plane_between_nodes(g, s);
}

void convert_particles_beside_voids_to_peridynamic(struct particles *p, const struct voids *v,
                                                   bool include_mesh_particles)
{
    for (int64_t i = 0; i < p->n && v; i++)
        if (v->near[i] & VOID_ACROSS && (include_mesh_particles || !(p->flag[i] & FLAG_MESHED))) p->kind[i] = KIND_PD;
}

/* Particles beside voids that are too narrow for the grid, which joins the two sides of such a void. n: their number;
 * first: index of the first of them. */
struct closed {
    int64_t n, first;
};

/* Counts particle i in *to: the particles beside those voids (gaps in a body) that are so narrow that grid nodes couple
 * their two sides. Stores i in to->first if it is the first one counted. */
static void closed_add(struct closed *to, int64_t i)
{
    if (to->n++ == 0) to->first = i;
}

/* Returns true if a void of v (gap in a body) is between particle i of p and one of its neighbours `near` that belongs
 * to the same body, so that the sides of the void face each other. Mirror images do not count: the gap between a body
 * and a plane of symmetry is no void of the body. */
static bool void_is_within_body(const struct voids *v, const struct particles *p, int64_t i,
                                const struct neighbour_list *near)
{
    real a[DIM_MAX] = {0};
    bool within = false;
    particle_reference_position(p, i, a);
    for (int k = 0; k < near->n && !within; k++) {
        const int32_t j = near->at[k];
        real b[DIM_MAX] = {0};
        bool across = false;
        if (j >= p->n || p->body[j] != p->body[i]) continue;
        particle_reference_position(p, j, b);
        within = void_separates_points(v, p->body[i], a, b, &across) && across;
    }
    return within;
}

/* Counts the material points of p beside gaps that are too narrow for the grid to separate their sides. *inside:
 * receives number and first index of the points beside voids within a body; *at_plane: of the points beside gaps
 * between a body and a plane of symmetry. v: particles beside voids of bodies whose surface is known; NULL: nothing is
 * counted; cells: cells of the neighbour search; reach: largest width of a gap [m]; uncut: true to count also points of
 * the mesh of the reference frame (a mesh of the undeformed body), if voids do not divide it. */
static void closed_on_grid(const struct particles *p, const struct voids *v, const struct cells *cells, real reach,
                           bool uncut, struct closed *inside, struct closed *at_plane)
{
    struct neighbour_list near = {0};
    for (int64_t i = 0; i < p->n && v; i++) {
        if (!(v->near[i] & VOID_ACROSS) || p->kind[i] != KIND_MPM || (!uncut && p->flag[i] & FLAG_MESHED)) continue;
        particles_list_neighbours_within_radius(&near, cells, p, i, reach, false);
        closed_add(void_is_within_body(v, p, i, &near) ? inside : at_plane, i);
    }
    memory_free(near.at);
}

/* Computes next[2 dim], the distances from particle i of p to the nearest neighbours of its body in the negative and
 * then the positive direction of each axis [m]; INFINITY if there is none. A neighbour counts if the line to it is
 * nearly parallel to the axis (cosine above ALONG). near: neighbours of particle i. */
static void next_along(const struct particles *p, int64_t i, const struct neighbour_list *near, real *next)
{
    for (int a = 0; a < 2 * p->dim; a++) next[a] = INFINITY;
    for (int k = 0; k < near->n; k++) {
        const int32_t j = near->at[k];
        real apart[DIM_MAX], r2 = 0;
        for (int d = 0; d < p->dim; d++) apart[d] = p->X[d][j] - p->X[d][i], r2 += square(apart[d]);
        for (int d = 0; d < p->dim && p->body[j] == p->body[i]; d++) {
            real *to = &next[2 * d + (apart[d] > 0)];
            if (square(apart[d]) > square(ALONG) * r2) *to = real_min(*to, sqrt(r2));
        }
    }
}

/* Counts the particles (of p) of body b that are beside gaps, rows of empty lattice sites narrower than `reach` [m],
 * for bodies whose surface is not known. s: scene, with the spacing; cells: cells of the neighbour search. Returns
 * their number with the index of the first one. The number is 0 if most particles lack a neighbour one spacing away
 * along some axis: they are not on a lattice. */
static struct closed closed_in_lattice(const struct scene *s, const struct particles *p, const struct cells *cells,
                                       int b, real reach)
{
    const real spacing = s->spacing;
    struct closed found = {0};
    struct neighbour_list near = {0};
    int64_t all = 0, regular = 0;
    for (int64_t i = 0; i < p->n; i++) {
        real next[2 * DIM_MAX];
        int beside = 0, across = 0;
        if (s->body[p->body[i]].joined != b) continue;
        particles_list_neighbours_within_radius(&near, cells, p, i, reach, false);
        next_along(p, i, &near, next);
        for (int d = 0; d < p->dim; d++) beside += real_min(next[2 * d], next[2 * d + 1]) < 1.01 * spacing;
        for (int a = 0; a < 2 * p->dim; a++) across += next[a] > 1.5 * spacing && next[a] <= reach;
        all++, regular += beside >= p->dim;
        if (across > 0) closed_add(&found, i);
    }
    memory_free(near.at);
    return 2 * regular > all ? found : (struct closed){0};
}

void warn_of_voids_treated_as_closed(const struct run *run, bool total_lagrangian_possible,
                                     struct warnings *warning_list)
{
    const struct scene *s = run->scene;
    const bool uncut = mesh_cannot_have_free_surfaces_at_voids(&run->grid->field[0].grid, s);
    struct closed grid = {0}, plane = {0};
    const real reach = scene_interaction_distance_across_voids(s, run->source.family.cutoff);
    closed_on_grid(&run->part, run->source.voids, &run->cells, reach, uncut, &grid, &plane);
    if (grid.n > 0)
        warnings_add_if_new(warning_list,
                            "body %s has a void too narrow for its grid at (%s) m, where %lld material points share "
                            "grid nodes with points on the other side, so the void has no effect; use %smethod: pd, "
                            "method: adaptive or a smaller particles.spacing",
                            s->body[run->part.body[grid.first]].name,
                            particle_position_text(&run->part, grid.first, 4).text, (long long)grid.n,
                            total_lagrangian_possible && !uncut ? "mpm.frame: reference, " : "");
    if (plane.n > 0)
        warnings_add_if_new(warning_list,
                            "body %s: the gap between this body and a plane of symmetry is too narrow for the grid at "
                            "(%s) m, where the plane acts on %lld material points that do not touch it; use method: "
                            "pd, method: adaptive or a smaller particles.spacing",
                            s->body[run->part.body[plane.first]].name,
                            particle_position_text(&run->part, plane.first, 4).text, (long long)plane.n);
    for (int b = 0; b < s->bodies && s->dim > 1; b++) {
        if (s->body[b].joined != b || joined_bodies_are_all_defined_by_solids(s, b)) continue;
        const struct closed gap = closed_in_lattice(s, &run->part, &run->cells, b, reach);
        if (gap.n == 0) continue;
        warnings_add_if_new(warning_list,
                            "body %s has a void one or two particles wide, for instance at (%s) m (%lld particles are "
                            "beside such voids). A particle list or image defines no surfaces, so %s join both sides "
                            "of the void; define its surfaces by the key cracks, or use a smaller particles.spacing",
                            s->body[b].name, particle_position_text(&run->part, gap.first, 4).text, (long long)gap.n,
                            s->method == METHOD_MPM  ? "cells"
                            : s->method == METHOD_PD ? "bonds"
                                                     : "bonds and cells");
    }
}
