/* Computes the forces on the nodes of coarse cells and advances these nodes in a step; cells of coarser levels have
 * longer steps. */
#include <math.h>

#include "levels_parts.h"

int mesh_levels_coarsest_level_integrated_in_step(const struct mesh_levels *l, int64_t step)
{
    int due = 0;
    while (due < l->n && step % ((int64_t)2 << due) == 0) due++;
    return due;
}

/* Sets the displacements of the ghosts of level `level` of l (cells with the edge of 2^level finest cells) to those of
 * the nodes of the next finer level at the same positions. A ghost is a node of the coarser mesh at which the finer
 * mesh has a node, too, and moves with that node. Cells beside finer ones need the ghosts to compute forces. */
static void ghosts_displace(struct mesh_levels *l, int level)
{
    const struct mesh_level *m = &l->at[level];
    const struct mesh *fine = mesh_levels_mesh_of_level(l, level - 1);
    for (int d = 0; d < fine->grid.dim; d++)
        for (int64_t k = 0; k < m->ghosts; k++)
            m->mesh.displacement[d][m->ghost[k].coarse] = fine->displacement[d][m->ghost[k].fine];
}

void mesh_levels_copy_motion_to_ghosts_of_one_level(struct mesh_levels *l, int level)
{
    const struct mesh_level *m = &l->at[level];
    const struct mesh *fine = mesh_levels_mesh_of_level(l, level - 1);
    ghosts_displace(l, level);
    for (int d = 0; d < fine->grid.dim; d++)
        for (int64_t k = 0; k < m->ghosts; k++)
            m->mesh.grid.velocity[d][m->ghost[k].coarse] = fine->grid.velocity[d][m->ghost[k].fine];
}

/* Returns the mean of the nodal field `field` over the masters of hanging node h. A hanging node is in the middle of an
 * edge or face of a coarser cell, and its masters are the nodes at the ends or corners of this edge or face. */
static real mean_of(const struct mesh_hanging *h, const real *field)
{
    real sum = 0;
    for (int q = 0; q < h->masters; q++) sum += field[h->master[q]];
    return sum / h->masters;
}

void mesh_levels_interpolate_motion_of_hanging_nodes(struct mesh_levels *l, int level)
{
    const struct mesh_level *m = &l->at[level];
    struct mesh *fine = mesh_levels_mesh_of_level(l, level - 1);
    for (int d = 0; d < fine->grid.dim; d++)
        for (int64_t k = 0; k < m->hangings; k++) {
            const struct mesh_hanging *h = &m->hanging[k];
            fine->displacement[d][h->node] = mean_of(h, fine->displacement[d]);
            fine->grid.velocity[d][h->node] = mean_of(h, fine->grid.velocity[d]);
        }
}

/* Adds the forces on the hanging nodes between level `level` of l and the next finer level to their masters, in equal
 * parts. A hanging node is in the middle of an edge or face of a coarser cell, and its masters are the nodes at the
 * ends or corners of this edge or face. */
static void hanging_fold(struct mesh_levels *l, int level)
{
    const struct mesh_level *m = &l->at[level];
    struct grid *fine = &mesh_levels_mesh_of_level(l, level - 1)->grid;
    for (int d = 0; d < fine->dim; d++)
        for (int64_t k = 0; k < m->hangings; k++) {
            const struct mesh_hanging *h = &m->hanging[k];
            for (int q = 0; q < h->masters; q++)
                fine->force[d][h->master[q]] += fine->force[d][h->node] * (1.0 / h->masters);
            fine->force[d][h->node] = 0;
        }
}

/* Adds the forces that cells of level `level` of l exert on their ghosts to the nodes of the next finer level at the
 * same positions, and sets the forces on the ghosts to 0. A ghost is a node of the coarser mesh at which the finer mesh
 * has a node, too, and moves with that node. The forces are added twice, because the steps of the finer level are half
 * as long. */
static void ghosts_fold(struct mesh_levels *l, int level)
{
    const struct mesh_level *m = &l->at[level];
    struct grid *coarse = &l->at[level].mesh.grid, *fine = &mesh_levels_mesh_of_level(l, level - 1)->grid;
    for (int d = 0; d < fine->dim; d++)
        for (int64_t k = 0; k < m->ghosts; k++) {
            fine->force[d][m->ghost[k].fine] += 2 * coarse->force[d][m->ghost[k].coarse];
            coarse->force[d][m->ghost[k].coarse] = 0;
        }
}

void mesh_levels_compute_forces_of_coarse_cells(struct mesh_levels *l, const struct particles *p,
                                                const struct elastic *m, bool finite_strain, int highest_level)
{
    for (int level = 1; level <= highest_level; level++) {
        struct mesh *mesh = &l->at[level].mesh;
        if (mesh->points == 0) continue;
        ghosts_displace(l, level);
        mesh_clear(mesh);
        mesh_force(mesh, p, m, finite_strain);
    }
    for (int level = 1; level <= highest_level + 1 && level <= l->n; level++) hanging_fold(l, level);
    for (int level = 1; level <= highest_level; level++) ghosts_fold(l, level);
}

real mesh_levels_move_nodes_return_largest_velocity(struct mesh_levels *l, real dt, real dt_velocity, int highest_level,
                                                    real impulse[DIM_MAX], real *work)
{
    real most = 0;
    for (int level = 0; level <= highest_level; level++) {
        struct mesh *mesh = mesh_levels_mesh_of_level(l, level);
        const real longer = (real)(1 << level);
        if (mesh->points == 0) continue;
        most = real_max(most, mesh_move(mesh, longer * dt, longer * dt_velocity, impulse, work));
        if (level < l->n) mesh_levels_interpolate_motion_of_hanging_nodes(l, level + 1);
    }
    return most;
}
