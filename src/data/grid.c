/* Allocates the background grid and extends its box of nodes as material points move. */
#include "data/grid.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"

/* Number of nodes of the grid beyond the outermost material point: as many as the widest shape function reaches, and
 * one for the motion of the point. */
enum { MARGIN = 3 };
#define NODE_FARTHEST 1e15 /* cells; farther away an index is no longer exact in a double */

static void grid_arrays_free(struct grid *g)
{
    memory_free(g->mass);
    memory_free(g->follower);
    memory_free(g->held);
    for (int d = 0; d < g->dim; d++) {
        memory_free(g->momentum[d]);
        memory_free(g->force[d]);
        memory_free(g->velocity[d]);
    }
}

static void grid_arrays_make(struct grid *g)
{
    g->n = 1;
    for (int d = 0; d < g->dim; d++) {
        g->stride[d] = g->n;
        g->n *= g->count[d];
    }
    g->mass = NEW("grid.mass", g->n, real);
    g->follower = g->light_mass > 0 ? BARE("grid.follower", g->n, struct follower) : NULL;
    g->held = g->light_mass > 0 || g->body > 0 ? NEW("grid.held", g->n, uint8_t) : NULL;
    g->followers = 0;
    for (int d = 0; d < g->dim; d++) {
        g->momentum[d] = NEW("grid.momentum", g->n, real);
        g->force[d] = NEW("grid.force", g->n, real);
        g->velocity[d] = NEW("grid.velocity", g->n, real);
    }
}

/* Step by which boxes of nodes grow [nodes]. */
enum { BOX_STEP = 4 };
/* Returns the largest multiple of BOX_STEP [cells] that is not above the cell index k, which may be negative. */
static int64_t box_floor(int64_t k)
{
    return k >= 0 ? k / BOX_STEP * BOX_STEP : -((-k + BOX_STEP - 1) / BOX_STEP) * BOX_STEP;
}

bool grid_box_covers(const struct grid *g, const real *lower, const real *upper)
{
    bool covers = g->n > 0;
    for (int d = 0; d < g->dim && covers; d++) {
        const real low = (lower[d] - g->anchor[d]) / g->h, high = (upper[d] - g->anchor[d]) / g->h;
        covers = low >= (real)(g->first[d] + MARGIN) && high < (real)(g->first[d] + g->count[d] - MARGIN);
    }
    return covers;
}

status grid_extend_box(struct grid *g, const real *lower, const real *upper, int64_t max_nodes, bool *changed)
{
    int64_t first[DIM_MAX], end[DIM_MAX];
    real nodes = 1, low[DIM_MAX], high[DIM_MAX];
    *changed = g->n == 0;
    for (int d = 0; d < g->dim; d++) {
        low[d] = floor((lower[d] - g->anchor[d]) / g->h), high[d] = floor((upper[d] - g->anchor[d]) / g->h);
        if (!(fabs(low[d]) < NODE_FARTHEST && fabs(high[d]) < NODE_FARTHEST))
            return status_set(FAILED,
                              "a material point is at %.3g m, %.3g cells from the beginning of the grid: the run may "
                              "be unstable; use a smaller time.safety",
                              fabs(low[d]) < NODE_FARTHEST ? upper[d] : lower[d],
                              real_max(fabs(low[d]), fabs(high[d])));
    }
    for (int d = 0; d < g->dim; d++) {
        first[d] = box_floor((int64_t)low[d] - MARGIN);
        end[d] = box_floor((int64_t)high[d] + MARGIN + BOX_STEP);
        if (g->n > 0 && first[d] >= g->first[d])
            first[d] = g->first[d];
        else
            *changed = true;
        if (g->n > 0 && end[d] <= g->first[d] + g->count[d])
            end[d] = g->first[d] + g->count[d];
        else
            *changed = true;
        nodes *= (real)(end[d] - first[d]);
    }
    if (!(nodes <= (real)max_nodes))
        return status_set(FAILED,
                          "the material points have spread so far that their grid would need %.3g nodes: the run may "
                          "be unstable (use a smaller time.safety), or a fragment flies away (use a shorter duration)",
                          nodes);
    if (!*changed) return OK;
    if (g->n > 0) grid_arrays_free(g);
    for (int d = 0; d < g->dim; d++) {
        g->first[d] = first[d];
        g->count[d] = end[d] - first[d];
    }
    grid_arrays_make(g);
    return OK;
}

bool grid_set_box_if_not_too_large(struct grid *g, const real *lower, const real *upper, int64_t max_nodes)
{
    real n = 1;
    g->n = 1;
    for (int d = 0; d < g->dim; d++) {
        g->first[d] = (int64_t)floor((lower[d] - g->anchor[d]) / g->h);
        g->count[d] = (int64_t)floor((upper[d] - g->anchor[d]) / g->h) - g->first[d] + 2;
        n *= (real)g->count[d];
        if (n > (real)max_nodes) return false;
        g->stride[d] = g->n;
        g->n *= g->count[d];
    }
    return true;
}

void grid_add_prescribed_velocity(struct grid *g, const struct wall *prescribed_velocity)
{
    GROW("grid.wall", g->wall, g->walls + 1);
    g->wall[g->walls++] = *prescribed_velocity;
}

void grid_add_mirror_node(struct grid *g, const struct mirror_node *mirror_node)
{
    GROW("grid.mirror_node", g->mirror_node, g->mirror_nodes + 1);
    g->mirror_node[g->mirror_nodes++] = *mirror_node;
}

void grid_add_dashpot(struct grid *g, const struct dashpot *dashpot)
{
    GROW("grid.dashpot", g->dashpot, g->dashpots + 1);
    g->dashpot[g->dashpots++] = *dashpot;
}

void grid_clear_constraints(struct grid *g)
{
    g->walls = g->dashpots = 0;
    g->absorbed = (struct dashpot_effect){0};
    for (int64_t k = 0; k < g->mirror_nodes; k++)
        memset(g->mirror_node[k].reaction, 0, sizeof g->mirror_node[k].reaction);
}

void grid_free(struct grid *g)
{
    if (g->n > 0) grid_arrays_free(g);
    memory_free(g->mirror_node);
    memory_free(g->dashpot);
    memory_free(g->wall);
    memset(g, 0, sizeof *g);
}
