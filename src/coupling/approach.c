/* Flags particles near other bodies for conversion. Particles outside the bounding boxes of all other bodies are
 * excluded first; the distances of the others are tested by a cell search. */
#include "coupling/approach.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "data/cells.h"

/* Bounding box of the particles of a body [m]. */
struct body_box {
    real from[DIM_MAX], to[DIM_MAX];
};

/* Returns an array [bodies] with the bounding box of the present positions of the particles p of each body [m]. The box
 * of a body without particles is empty (from > to). The caller frees the array with memory_free. */
static struct body_box *body_boxes(const struct particles *p, int bodies)
{
    struct body_box *all = NEW("approach.boxes", bodies, struct body_box);
    for (int b = 0; b < bodies; b++)
        for (int d = 0; d < DIM_MAX; d++) all[b].from[d] = INFINITY, all[b].to[d] = -INFINITY;
#pragma omp parallel
    {
        struct body_box *own = BARE("approach.boxes", bodies, struct body_box);
#pragma omp critical
        array_copy(own, all, bodies, sizeof *own);
#pragma omp for schedule(static)
        for (int64_t i = 0; i < p->n; i++)
            for (int d = 0; d < p->dim; d++) {
                struct body_box *b = &own[p->body[i]];
                b->from[d] = real_min(b->from[d], p->x[d][i]), b->to[d] = real_max(b->to[d], p->x[d][i]);
            }
#pragma omp critical
        for (int b = 0; b < bodies; b++)
            for (int d = 0; d < p->dim; d++) {
                all[b].from[d] = real_min(all[b].from[d], own[b].from[d]);
                all[b].to[d] = real_max(all[b].to[d], own[b].to[d]);
            }
        memory_free(own);
    }
    return all;
}

/* Returns true if the present position of particle i of p is inside the bounding box of another body, enlarged by
 * `reach` [m] on all sides. box: bounding boxes of the bodies, [bodies]. */
static bool in_foreign_box(const struct particles *p, const struct body_box *box, int bodies, int64_t i, real reach)
{
    for (int b = 0; b < bodies; b++) {
        bool inside = b != p->body[i];
        for (int d = 0; d < p->dim && inside; d++)
            inside = p->x[d][i] >= box[b].from[d] - reach && p->x[d][i] <= box[b].to[d] + reach;
        if (inside) return true;
    }
    return false;
}

/* Returns true if the present position of particle i of p is closer than `reach` [m] to the surface of one of the rigid
 * bodies rigid[0 .. rigids - 1], or inside one. */
static bool near_rigid(const struct particles *p, const struct rigid_body *rigid, int rigids, int64_t i, real reach)
{
    real x[DIM_MAX] = {0}, normal[DIM_MAX];
    for (int d = 0; d < p->dim; d++) x[d] = p->x[d][i];
    for (int k = 0; k < rigids; k++)
        if (rigid_may_be_within_distance_of_position(&rigid[k], x, reach) &&
            rigid_signed_distance(&rigid[k], x, normal) < reach)
            return true;
    return false;
}

/* Records that particle i of p is near another body. If it is a material point, flags it for conversion to a
 * peridynamic particle (FLAG_NEAR). If it is peridynamic, restarts the time that must pass before it may become a
 * material point again. */
static void mark(struct particles *p, int64_t i)
{
    if (p->kind[i] == KIND_MPM)
        p->flag[i] |= FLAG_NEAR;
    else if (p->low_since)
        p->low_since[i] = INFINITY;
}

/* Marks (by mark) those of n particles of p whose present position is within `reach` [m] of another of these particles
 * that belongs to another body. list[n]: indices of the particles. */
static void mark_listed(struct particles *p, const int32_t *list, int64_t n, real reach)
{
    struct particles places = {.n = n, .n_all = n, .dim = p->dim};
    struct cells cells;
    for (int d = 0; d < p->dim; d++) {
        places.X[d] = BARE("approach.place", n, real);
        for (int64_t k = 0; k < n; k++) places.X[d][k] = p->x[d][list[k]];
    }
    cells_make_for_neighbour_search(&cells, &places, reach);
#pragma omp parallel
    {
        struct neighbour_list near = {0};
#pragma omp for schedule(static)
        for (int64_t k = 0; k < n; k++) {
            bool foreign = false;
            particles_list_neighbours_within_radius(&near, &cells, &places, k, reach, false);
            for (int q = 0; q < near.n && !foreign; q++) foreign = p->body[list[near.at[q]]] != p->body[list[k]];
            if (foreign) mark(p, list[k]);
        }
        memory_free(near.at);
    }
    cells_free(&cells);
    for (int d = 0; d < p->dim; d++) memory_free(places.X[d]);
}

void flag_points_near_other_bodies_for_conversion(struct particles *p, int body_count, const struct rigid_body *rigid,
                                                  int rigid_body_count, real max_distance)
{
    struct body_box *box = body_count > 1 ? body_boxes(p, body_count) : NULL;
    uint8_t *close = NEW("approach.close", p->n, uint8_t);
    int64_t n = 0;
#pragma omp parallel for schedule(static) reduction(+ : n)
    for (int64_t i = 0; i < p->n; i++) {
        if (rigid_body_count > 0 && near_rigid(p, rigid, rigid_body_count, i, max_distance)) mark(p, i);
        close[i] = box && in_foreign_box(p, box, body_count, i, max_distance);
        n += close[i];
    }
    if (n > 0) {
        int32_t *list = BARE("approach.list", n, int32_t);
        int64_t k = 0;
        for (int64_t i = 0; i < p->n; i++)
            if (close[i]) list[k++] = (int32_t)i;
        mark_listed(p, list, n, max_distance);
        memory_free(list);
    }
    memory_free(close);
    memory_free(box);
}
