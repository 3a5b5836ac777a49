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

/* ---- planes of symmetry ----------------------------------------------------------------------------------
 *
 * The motion of a node g beyond a plane is that of its image I turned round, v_g = s v_I. With this constraint the lumped
 * equations of both are (m_I + m_g) dv_I = dt (f_I + s f_g): as if the mirrored body were there, for every shape. Few, in
 * order, on one thread: several may share an image. */

static void folds_in(struct grid *g, enum transfer transfer, real dt_velocity)
{
    for (int64_t k = 0; k < g->folds; k++) {
        struct fold *f = &g->fold[k];
        const int64_t from = f->node, to = f->image;
        f->mass = g->mass[from];
        if (f->mass <= 0) continue;
        g->mass[to] += f->mass, g->mass[from] = 0;
        for (int d = 0; d < g->dim; d++) {
            f->taken[d] = dt_velocity * g->force[d][from] + (transfer == TRANSFER_APIC ? g->momentum[d][from] : 0);
            g->force[d][to] += f->sign[d] * g->force[d][from];
            g->momentum[d][to] += f->sign[d] * g->momentum[d][from];
            g->force[d][from] = g->momentum[d][from] = 0;
        }
    }
}

/* A component that turns round needs an impulse at the node, m_g dv_g - dt f_g, and the same at its image: together they
 * do no work, for the two move against each other. */
static void folds_out(struct grid *g, enum transfer transfer, real impulse[DIM_MAX])
{
    for (int64_t k = 0; k < g->folds; k++) {
        struct fold *f = &g->fold[k];
        for (int d = 0; d < g->dim; d++) {
            f->reaction[d] = 0;
            if (f->mass <= 0) continue;
            g->velocity[d][f->node] = f->sign[d] * g->velocity[d][f->image];
            g->force[d][f->node] = f->sign[d] * g->force[d][f->image];
            if (f->sign[d] > 0) continue;
            const real gained = transfer == TRANSFER_APIC ? g->velocity[d][f->node] : g->force[d][f->node];
            f->reaction[d] = 2 * (f->mass * gained - f->taken[d]);
            impulse[d] += f->reaction[d];
        }
    }
}

void grid_move(struct grid *g, enum transfer transfer, real dt_velocity, real smallest_mass, real impulse[DIM_MAX],
               real *work)
{
    folds_in(g, transfer, dt_velocity);
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
    folds_out(g, transfer, impulse);
}

void grid_remapped(struct grid *g, real smallest_mass)
{
    for (int64_t k = 0; k < g->folds; k++)
        for (int d = 0; d < g->dim; d++)
            g->momentum[d][g->fold[k].image] += g->fold[k].sign[d] * g->momentum[d][g->fold[k].node];
#pragma omp parallel for schedule(static)
    for (int64_t I = 0; I < g->n; I++) {
        const real inverse = g->mass[I] >= smallest_mass ? 1 / g->mass[I] : 0;
        for (int d = 0; d < g->dim; d++) g->momentum[d][I] *= inverse;
    }
    for (int64_t k = 0; k < g->walls; k++) g->momentum[g->wall[k].component][g->wall[k].node] = g->wall[k].velocity;
    for (int64_t k = 0; k < g->folds; k++)
        for (int d = 0; d < g->dim; d++)
            g->momentum[d][g->fold[k].node] = g->fold[k].sign[d] * g->momentum[d][g->fold[k].image];
}
