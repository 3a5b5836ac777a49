/* floor 2: nodal updates between the maps. One division a node; few bytes beside the points'. */
#include <string.h>

#include "kernels.h"

void grid_clear(struct grid *g)
{
#pragma omp parallel for schedule(static)
    for (int64_t I = 0; I < g->n; I++) {
        g->mass[I] = 0;
        for (int d = 0; d < g->dim; d++) g->momentum[d][I] = g->force[d][I] = 0;
    }
}

/* What a held component does to its node: the reaction replaces the force, and with APIC the momentum too. */
static void wall_move(struct grid *g, struct wall *w, enum transfer transfer, real smallest_mass,
                      real impulse[DIM_MAX], real *work)
{
    const int d = w->component;
    const int64_t I = w->node;
    w->reaction = 0;
    if (g->mass[I] < smallest_mass) return;
    /* FLIP: points take the change only. APIC: they take the velocity, and with it what replaces P/m = velocity - dv. */
    const real before = transfer == TRANSFER_APIC ? g->velocity[d][I] - g->force[d][I] : w->velocity - w->change;
    const real given = g->mass[I] * (w->velocity - before - g->force[d][I]);
    w->reaction = given - g->mass[I] * w->change;
    impulse[d] += given;
    *work += given * 0.5 * (before + w->velocity);
    g->force[d][I] = w->change;
    g->velocity[d][I] = w->velocity;
}

void grid_move(struct grid *g, enum transfer transfer, real dt_velocity, real smallest_mass, real impulse[DIM_MAX],
               real *work)
{
#pragma omp parallel for schedule(static)
    for (int64_t I = 0; I < g->n; I++) {
        const bool moves = g->mass[I] >= smallest_mass;
        const real inverse = moves ? 1 / g->mass[I] : 0;
        for (int d = 0; d < g->dim; d++) {
            g->force[d][I] *= dt_velocity * inverse;
            g->velocity[d][I] = g->momentum[d][I] * inverse + g->force[d][I];
            g->momentum[d][I] = 0;
        }
    }
    for (int64_t k = 0; k < g->walls; k++)     /* few, and their sums must not depend on threads */
        wall_move(g, &g->wall[k], transfer, smallest_mass, impulse, work);
}

void grid_remapped(struct grid *g, real smallest_mass)
{
#pragma omp parallel for schedule(static)
    for (int64_t I = 0; I < g->n; I++) {
        const real inverse = g->mass[I] >= smallest_mass ? 1 / g->mass[I] : 0;
        for (int d = 0; d < g->dim; d++) g->momentum[d][I] *= inverse;
    }
    for (int64_t k = 0; k < g->walls; k++) g->momentum[g->wall[k].component][g->wall[k].node] = g->wall[k].velocity;
}
