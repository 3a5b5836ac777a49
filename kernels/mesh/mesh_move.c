/* Moves the nodes of the mesh: velocities and displacements, prescribed velocities ("walls"), dashpots, and mirror
 * nodes beyond planes of symmetry. */
#include <math.h>

#define ROWS_IN_PARTS /* vectors of WIDE nodes */
#include "kernels/dashpot.h"
#include "kernels/kernels.h"
#include "kernels/simd/lanes.h"

/* Replaces the force on all nodal components with prescribed velocity ("walls") by mass times the change of this
 * velocity per time. dt_velocity: time over which forces change the velocities [s]. Stores in each wall its reaction
 * [N s], the impulse that balances the other forces on the node. Adds the impulse of all walls to impulse[axis] [N s]
 * and their work to *work [J]. Walls of one axis are consecutive in the list; their sums are added at the end of the
 * axis. mesh: mesh of the undeformed body. */
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
            w->reaction = -dt_velocity * force[w->node];
            sum += given;
            all += given * 0.5 * ((1 + g->damped.velocities) * before + w->velocity);
            force[w->node] = needed * inverse;
        }
        impulse[d] += sum;
        *work += all * (1 + g->damped.increments);
    }
}

/* Adds the forces of dashpots to the nodal forces of the mesh, and sets grid.absorbed to the energy and impulse that
 * they absorb in this step. dt_velocity: time over which forces change the velocities [s]. A dashpot at a mirror node
 * (a node beyond a plane of symmetry) is listed at the node that it mirrors. */
static void dashpots_force(struct mesh *mesh, real dt_velocity)
{
    struct grid *g = &mesh->grid;
    g->absorbed = (struct dashpot_effect){0};
    for (int64_t k = 0; k < g->dashpots; k++) {
        const int64_t I = g->dashpot[k].node;
        for (int d = 0; d < g->dim && g->mass[I] > 0; d++) {
            const real change = dt_velocity * g->force[d][I] / g->mass[I];
            g->force[d][I] += dashpot_compute_and_add_impulse(&g->absorbed, d, dt_velocity * g->dashpot[k].rate[d],
                                                              g->mass[I], g->velocity[d][I], change) /
                              dt_velocity;
        }
    }
}

#define OFF_PLACE 1e-6 /* largest deviation from a prescribed position that counts as round-off [cells]; empirical */

/* Sets the nodal components with prescribed velocity ("walls") exactly to this velocity, without the round-off of the
 * step. Sets their displacement likewise, if it is within OFF_PLACE cell edges of its prescribed value. A displacement
 * that differs by more, for example of a node that started from another displacement, follows the velocity alone. dt:
 * time step [s]. mesh: mesh of the undeformed body. */
static void walls_move(struct mesh *mesh, real dt)
{
    const struct grid *g = &mesh->grid;
    for (int64_t k = 0; k < g->walls; k++) {
        const struct wall *w = &g->wall[k];
        real *velocity = &g->velocity[w->component][w->node], *u = &mesh->displacement[w->component][w->node];
        *u += dt * (w->velocity - *velocity);
        if (fabs(*u - w->place) <= OFF_PLACE * g->h) *u = w->place; /* false if `place` is NAN */
        *velocity = w->velocity;
        if (mesh->matched) g->momentum[w->component][w->node] = w->velocity; /* no matched cell has held nodes */
    }
}

/* Sets one component of the force on the nodes of one row of the mesh to 0, except in blocks of nodes that are at rest.
 * row: number of the row, a line of nodes along x, from 0; force: this component at all nodes of the mesh [N]. */
static void row_clear(const struct mesh *mesh, int64_t row, real *force)
{
    const struct mesh_row_blocks blocks = mesh_block_range_with_mass_in_node_row(mesh, row);
    const uint8_t *levels = mesh_activity_levels_of_node_blocks_in_row(mesh, row);
    for (int64_t b = blocks.first; (b = mesh_next_active_block(levels, b, blocks.end)) < blocks.end; b++)
        for (int part = 0; part < LANES; part += WIDE)
            lanes_store(force + row * mesh->grid.count[0] + b * LANES + part, lanes_broadcast(0));
}

void mesh_clear(struct mesh *mesh)
{
#pragma omp parallel for schedule(static)
    for (int64_t r = 0; r < mesh->rows; r++)
        for (int d = 0; d < mesh->grid.dim; d++) row_clear(mesh, r, mesh->grid.force[d]);
}

/* Advances velocity and displacement of the nodes of one row of the mesh by a leap-frog step, WIDE nodes (one per
 * vector lane) at a time, except in blocks of nodes that are at rest. row: number of the row of nodes along x, from 0;
 * dt: time over which velocities move the nodes [s]; dt_velocity: time over which forces change the velocities [s].
 * Entries beyond the last node have neither force nor mass and stay at rest. Returns the square of the largest velocity
 * component [m^2/s^2], or INFINITY if any component is not finite; because maxima ignore NaN, the sum of all components
 * is tested for this. */
static real row_move(struct mesh *mesh, int64_t row, real dt, real dt_velocity)
{
    const int64_t start = row * mesh->grid.count[0];
    const struct mesh_row_blocks blocks = mesh_block_range_with_mass_in_node_row(mesh, row);
    const uint8_t *levels = mesh_activity_levels_of_node_blocks_in_row(mesh, row);
    lanes most = lanes_broadcast(0), sum = lanes_broadcast(0);
    for (int d = 0; d < mesh->grid.dim; d++) {
        real *velocity = mesh->grid.velocity[d], *displacement = mesh->displacement[d];
        const real *force = mesh->grid.force[d], *inverse = mesh->inverse_mass;
        for (int64_t b = blocks.first; (b = mesh_next_active_block(levels, b, blocks.end)) < blocks.end; b++)
            for (int64_t I = start + b * LANES; I < start + (b + 1) * LANES; I += WIDE) {
                const lanes change = dt_velocity * lanes_load(inverse + I) * lanes_load(force + I);
                const lanes v = lanes_load(velocity + I) + change, u = lanes_load(displacement + I) + dt * v;
                lanes_store(velocity + I, v);
                lanes_store(displacement + I, (u + mesh->rounding) - mesh->rounding);
                most = lanes_max(most, v * v);
                sum += v;
            }
    }
    real largest = 0, all = 0;
    for (int l = 0; l < WIDE; l++) largest = real_max(largest, most[l]), all += sum[l];
    return isfinite(all) ? largest : INFINITY;
}

/* Adds mass and force of each mirror node, a node beyond a plane of symmetry that is midway between two nodes, to its
 * image node, so that the image moves with the mass and force of both (grid_move.c). dt_velocity: time over which
 * forces change the velocities [s]. Stores the own mass of the image and the impulse on the mirror node for
 * mesh_mirror_nodes_spread. Several mirror nodes may have one image; they are few and are processed in order by one
 * thread. mesh: mesh of the undeformed body. */
static void mesh_mirror_nodes_gather(struct mesh *mesh, real dt_velocity)
{
    struct grid *g = &mesh->grid;
    for (int64_t k = 0; k < g->mirror_nodes; k++) {
        struct mirror_node *f = &g->mirror_node[k];
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

/* Undoes mesh_mirror_nodes_gather after the step: restores the masses, and divides the force between each mirror node
 * (a node beyond a plane of symmetry) and its image by their masses. Sets velocity and displacement of the mirror node
 * to the reflected ones of its image. Adds the reaction of the plane to impulse[axis] [N s]: a component that changes
 * sign by the reflection counts twice, for the node and for its image. mesh: mesh of the undeformed body. */
static void mesh_mirror_nodes_spread(struct mesh *mesh, real impulse[DIM_MAX])
{
    struct grid *g = &mesh->grid;
    for (int64_t k = g->mirror_nodes - 1; k >= 0; k--) { /* reverse order restores masses to the bit */
        struct mirror_node *f = &g->mirror_node[k];
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

/* Changes the velocities of the nodes of a mesh of coarse cells by the forces on them, over the time dt_velocity [s].
 * The mass matrix of these cells is not diagonal: the forces change grid.momentum [m/s], the momentum divided by the
 * lumped mass, from which mesh_velocity then computes the velocities. */
static void momentum_move(struct mesh *mesh, real dt_velocity)
{
#pragma omp parallel for schedule(static)
    for (int64_t r = 0; r < mesh->rows; r++)
        for (int d = 0; d < mesh->grid.dim; d++) {
            real *momentum = mesh->grid.momentum[d];
            const real *force = mesh->grid.force[d], *inverse = mesh->inverse_mass;
            for (int64_t I = mesh->span[2 * r]; I < mesh->span[2 * r + 1]; I += WIDE)
                lanes_store(momentum + I,
                            lanes_load(momentum + I) + dt_velocity * lanes_load(inverse + I) * lanes_load(force + I));
        }
    mesh_velocity(mesh, mesh->grid.momentum, mesh->grid.velocity);
}

real mesh_move(struct mesh *mesh, real dt, real dt_velocity, real impulse[DIM_MAX], real *work)
{
    real most = 0;
    mesh_mirror_nodes_gather(mesh, dt_velocity);
    dashpots_force(mesh, dt_velocity);
    walls_force(mesh, dt_velocity, impulse, work);
    if (mesh->matched) momentum_move(mesh, dt_velocity), dt_velocity = 0; /* velocities follow from the momentum */
#pragma omp parallel for schedule(static) reduction(max : most)
    for (int64_t r = 0; r < mesh->rows; r++) most = real_max(most, row_move(mesh, r, dt, dt_velocity));
    walls_move(mesh, dt);
    mesh_mirror_nodes_spread(mesh, impulse);
    return sqrt(most);
}
