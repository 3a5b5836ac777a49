/* floor 2: nodes of the mesh move. */
#include <math.h>

#include "kernels.h"

/* What a held component does to its node: the force becomes what the prescribed motion needs. */
static void wall_force(struct mesh *mesh, struct wall *w, real dt_velocity, real impulse[DIM_MAX], real *work)
{
    struct grid *g = &mesh->grid;
    const int d = w->component;
    const real before = g->velocity[d][w->node], mass = g->mass[w->node];
    const real needed = mass * (w->velocity - before), given = needed - dt_velocity * g->force[d][w->node];
    w->reaction = given - mass * w->change;
    impulse[d] += given;
    *work += given * 0.5 * (before + w->velocity);
    g->force[d][w->node] = needed / dt_velocity;
}

void mesh_clear(struct mesh *mesh)
{
    const int dim = mesh->grid.dim;
#pragma omp parallel for schedule(static)
    for (int64_t r = 0; r < mesh->rows; r++)
        for (int d = 0; d < dim; d++)
            for (int32_t I = mesh->span[2 * r]; I < mesh->span[2 * r + 1]; I++) mesh->grid.force[d][I] = 0;
}

/* Nodes of a row move; returns the largest component of a velocity, squared. Maxima drop what is no number: a sum keeps it. */
static real row_move(struct mesh *mesh, int64_t first, int64_t end, real dt, real dt_velocity)
{
    real most = 0, sum = 0;
    for (int d = 0; d < mesh->grid.dim; d++) {
        real *v = mesh->grid.velocity[d], *u = mesh->displacement[d];
        const real *f = mesh->grid.force[d], *inverse = mesh->inverse_mass;
#pragma omp simd reduction(max : most) reduction(+ : sum)
        for (int64_t I = first; I < end; I++) {
            v[I] += dt_velocity * inverse[I] * f[I];
            u[I] += dt * v[I];
            most = real_max(most, v[I] * v[I]);
            sum += v[I];
        }
    }
    return isfinite(sum) ? most : INFINITY;
}

real mesh_move(struct mesh *mesh, real dt, real dt_velocity, real impulse[DIM_MAX], real *work)
{
    struct grid *g = &mesh->grid;
    real most = 0;
    for (int64_t k = 0; k < g->walls; k++) wall_force(mesh, &g->wall[k], dt_velocity, impulse, work);
#pragma omp parallel for schedule(static) reduction(max : most)
    for (int64_t r = 0; r < mesh->rows; r++)
        most = real_max(most, row_move(mesh, mesh->span[2 * r], mesh->span[2 * r + 1], dt, dt_velocity));
    for (int64_t k = 0; k < g->walls; k++) {     /* what round-off left */
        const int d = g->wall[k].component;
        mesh->displacement[d][g->wall[k].node] += dt * (g->wall[k].velocity - g->velocity[d][g->wall[k].node]);
        g->velocity[d][g->wall[k].node] = g->wall[k].velocity;
    }
    return sqrt(most);
}
