/* floor 2: nodes of the mesh move. */
#include <math.h>

#include "kernels/kernels.h"
#include "kernels/simd/lanes.h"

/* What held components do to their nodes: the force becomes what the prescribed motion needs. Walls of one component follow
 * each other; their sums join the totals at the end. */
static void walls_force(struct mesh *mesh, real dt_velocity, real impulse[DIM_MAX], real *work)
{
    struct grid *g = &mesh->grid;
    const real inverse = 1 / dt_velocity;
    for (int64_t k = 0; k < g->walls;) {
        const int d = g->wall[k].component;
        const real *velocity = g->velocity[d], *mass = g->mass;
        real *force = g->force[d], sum = 0, all = 0;
        for (; k < g->walls && g->wall[k].component == d; k++) {
            struct wall *w = &g->wall[k];
            const real before = velocity[w->node], needed = mass[w->node] * (w->velocity - before);
            const real given = needed - dt_velocity * force[w->node];
            w->reaction = given - mass[w->node] * w->change;
            sum += given;
            all += given * 0.5 * (before + w->velocity);
            force[w->node] = needed * inverse;
        }
        impulse[d] += sum;
        *work += all;
    }
}

/* What round-off left. */
static void walls_move(struct mesh *mesh, real dt)
{
    const struct grid *g = &mesh->grid;
    for (int64_t k = 0; k < g->walls; k++) {
        const struct wall *w = &g->wall[k];
        real *velocity = &g->velocity[w->component][w->node];
        mesh->displacement[w->component][w->node] += dt * (w->velocity - *velocity);
        *velocity = w->velocity;
    }
}

void mesh_clear(struct mesh *mesh)
{
    const int dim = mesh->grid.dim;
#pragma omp parallel for schedule(static)
    for (int64_t r = 0; r < mesh->rows; r++)
        for (int64_t I = mesh->span[2 * r]; I < mesh->span[2 * r + 1]; I += LANES)
            for (int d = 0; d < dim && !mesh_asleep(mesh_levels(mesh, r), I - r * mesh->grid.count[0]); d++)
                lanes_store(mesh->grid.force[d] + I, lanes_of(0));
}

/* Nodes of a row move, in whole vectors: what lies behind them has neither force nor mass and stays at rest. Returns the
 * largest component of a velocity, squared. Maxima drop what is no number: a sum keeps it. */
static real row_move(struct mesh *mesh, int64_t row, real dt, real dt_velocity)
{
    const int64_t start = row * mesh->grid.count[0], first = mesh->span[2 * row], end = mesh->span[2 * row + 1];
    const uint8_t *levels = mesh_levels(mesh, row);
    lanes most = lanes_of(0), sum = lanes_of(0);
    for (int d = 0; d < mesh->grid.dim; d++) {
        real *velocity = mesh->grid.velocity[d], *displacement = mesh->displacement[d];
        const real *force = mesh->grid.force[d], *inverse = mesh->inverse_mass;
        for (int64_t I = first; I < end; I += LANES) {
            if (mesh_asleep(levels, I - start)) continue;
            const lanes v = lanes_load(velocity + I) + dt_velocity * lanes_load(inverse + I) * lanes_load(force + I);
            lanes_store(velocity + I, v);
            lanes_store(displacement + I, ((lanes_load(displacement + I) + dt * v) + mesh->rounding) - mesh->rounding);
            most = lanes_max(most, v * v);
            sum += v;
        }
    }
    real largest = 0, all = 0;
    for (int l = 0; l < LANES; l++) largest = real_max(largest, most[l]), all += sum[l];
    return isfinite(all) ? largest : INFINITY;
}

/* A node beyond a mirror half-way between two moves as its image (grid_move.c): for the step the image has the mass and the
 * force of both. Few, in order, on one thread: several may share an image. */
static void folds_in(struct mesh *mesh, real dt_velocity)
{
    struct grid *g = &mesh->grid;
    for (int64_t k = 0; k < g->folds; k++) {
        struct fold *f = &g->fold[k];
        f->mass = g->mass[f->node];
        if (f->mass <= 0) continue;
        f->image_mass = g->mass[f->image], f->image_inverse = mesh->inverse_mass[f->image];
        g->mass[f->image] += f->mass;
        mesh->inverse_mass[f->image] = 1 / g->mass[f->image];
        for (int d = 0; d < g->dim; d++) {
            f->taken[d] = dt_velocity * g->force[d][f->node] + f->mass * g->velocity[d][f->node];
            g->force[d][f->image] += f->sign[d] * g->force[d][f->node];
            g->force[d][f->node] = 0;
        }
    }
}

/* The masses as they were, of the force to each its own share, and what the mirror gave: to a component that turns round as much at
 * the node as at its image. */
static void folds_out(struct mesh *mesh, real impulse[DIM_MAX])
{
    struct grid *g = &mesh->grid;
    for (int64_t k = g->folds - 1; k >= 0; k--) {        /* the other way round: to the same bits */
        struct fold *f = &g->fold[k];
        const real both = g->mass[f->image];
        if (f->mass > 0) g->mass[f->image] = f->image_mass, mesh->inverse_mass[f->image] = f->image_inverse;
        for (int d = 0; d < g->dim; d++) {
            f->reaction[d] = 0;
            if (f->mass <= 0) continue;
            g->force[d][f->node] = f->sign[d] * f->mass / both * g->force[d][f->image];
            g->force[d][f->image] *= f->image_mass / both;
            g->velocity[d][f->node] = f->sign[d] * g->velocity[d][f->image];
            mesh->displacement[d][f->node] = f->sign[d] * mesh->displacement[d][f->image];
            if (f->sign[d] > 0) continue;
            f->reaction[d] = 2 * (f->mass * g->velocity[d][f->node] - f->taken[d]);
            impulse[d] += f->reaction[d];
        }
    }
}

real mesh_move(struct mesh *mesh, real dt, real dt_velocity, real impulse[DIM_MAX], real *work)
{
    real most = 0;
    folds_in(mesh, dt_velocity);
    walls_force(mesh, dt_velocity, impulse, work);
#pragma omp parallel for schedule(static) reduction(max : most)
    for (int64_t r = 0; r < mesh->rows; r++)
        most = real_max(most, row_move(mesh, r, dt, dt_velocity));
    walls_move(mesh, dt);
    folds_out(mesh, impulse);
    return sqrt(most);
}
