/* floor 2: nodes of the mesh move, and their energies. */
#include <math.h>

#include "mesh_cut.h"
#include "team.h"

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

/* ---- energies --------------------------------------------------------------------------------------------- */

static real kinetic_term(const void *context, int64_t I)
{
    const struct grid *g = context;
    real speed2 = 0;
    for (int d = 0; d < g->dim; d++) speed2 += square(g->velocity[d][I]);
    return 0.5 * g->mass[I] * speed2;
}

real mesh_kinetic(const struct mesh *mesh)
{
    return mesh->points > 0 ? team_sum(mesh->grid.n, kinetic_term, &mesh->grid) : 0;
}

static real kick_term(const void *context, int64_t I)
{
    const struct mesh *mesh = context;
    real force2 = 0;
    for (int d = 0; d < mesh->grid.dim; d++) force2 += square(mesh->grid.force[d][I]);
    return 0.25 * force2 * mesh->inverse_mass[I];
}

real mesh_kick(const struct mesh *mesh, real dt)
{
    return mesh->points > 0 ? dt * dt * team_sum(mesh->grid.n, kick_term, mesh) : 0;
}

/* 1/2 u K u of a cell, u in axes that turn with it. */
static real cell_energy(const struct mesh *mesh, int64_t I, const real *K, bool finite)
{
    const int dim = mesh->grid.dim, n = (1 << dim) * dim;
    real u[CELL_UNKNOWNS_MAX], energy = 0;
    mesh_cell_local(mesh, I, u, NULL, NULL, dim, finite && dim > 1);
    for (int b = 0; b < n; b++)
        for (int a = 0; a < n; a++) energy += 0.5 * u[a] * K[b * n + a] * u[b];
    return energy;
}

struct strain_sum { const struct mesh *mesh; bool finite; };

static real cut_term(const void *context, int64_t k)
{
    const struct strain_sum *s = context;
    const int n = (1 << s->mesh->grid.dim) * s->mesh->grid.dim;
    return cell_energy(s->mesh, s->mesh->cut[k], s->mesh->stiffness + k * n * n, s->finite);
}

static real run_term(const void *context, int64_t r)
{
    const struct strain_sum *s = context;
    const struct mesh_run *run = &s->mesh->run[r];
    const int n = (1 << s->mesh->grid.dim) * s->mesh->grid.dim;
    real sum = 0;
    for (int64_t k = 0; k < run->cells; k++)
        sum += cell_energy(s->mesh, run->cell + k, s->mesh->whole + (int64_t)run->material * n * n, s->finite);
    return sum;
}

real mesh_strain(const struct mesh *mesh, bool finite)
{
    struct strain_sum s = {mesh, finite};
    return mesh->points > 0 ? team_sum(mesh->cuts, cut_term, &s) + team_sum(mesh->runs, run_term, &s) : 0;
}
