/* Transfers the motion of nodes when the coarsening levels of cells change. New nodes get the displacement and velocity
 * interpolated at their positions. The momentum that a merged cell lacks by this (0 for linear velocities) is
 * distributed equally to its corners. Splitting a cell loses kinetic energy, since velocities inside a coarse cell are
 * interpolated linearly along each axis. Merging cells changes it, within the limit set in levels_rough.c. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "levels_parts.h"

/* ---- from coarse cells to nodes of level 0 ----------------------------------------------------------------------- */

/* Coarse cell that contains a node of level 0 (the finest), and the position t of the node in this cell, 0 to 1 along
 * each axis. level: coarsening level of the cell; 0: the node is in no coarse cell, or is a corner of a cell of level
 * 0, and the other members are not set. */
struct cell_around {
    int level;
    int64_t cell;
    real t[DIM_MAX];
};

/* Returns the coarse cell of l around node I of level 0 (the finest), and the position of the node in it. k[dim]:
 * indices of the node along the axes. The member `level` of the result is 0 if the node is a corner of a cell of level
 * 0, or of no cell at all. */
static struct cell_around coarse_around(const struct mesh_levels *l, int64_t I, const int64_t *k)
{
    const struct mesh *fine = l->fine;
    const int dim = fine->grid.dim;
    struct cell_around a = {0};
    int64_t own[DIM_MAX], q[DIM_MAX];
    int corner = -1;
    for (int c = (1 << dim) - 1; c >= 0; c--) { /* the last cell is the one of which the node is the lowest */
        const int64_t J = I - fine->corner[c];
        if (J < 0 || fine->kind[J] == CELL_EMPTY) continue;
        if (fine->kind[J] != CELL_COARSE) return (struct cell_around){0};
        corner = c;
    }
    if (corner < 0) return a;
    a.level = l->level[I - fine->corner[corner]];
    for (int d = 0; d < dim; d++) own[d] = k[d] - (corner >> d & 1);
    a.cell = mesh_levels_coarse_cell_of_fine_cell(l, a.level, own, q);
    for (int d = 0; d < dim; d++)
        a.t[d] = (real)(k[d] - l->offset[0][d] - ((q[d] - l->offset[a.level][d]) << a.level)) / (real)(1 << a.level);
    return a;
}

/* Computes weight[2^dim], the weights of the corners of the coarse cell a by which a nodal value is interpolated
 * linearly to the position a->t in the cell [1]. */
static void coarse_corner_weights(const struct cell_around *a, int dim, real *weight)
{
    for (int c = 0; c < 1 << dim; c++) {
        weight[c] = 1;
        for (int d = 0; d < dim; d++) weight[c] *= c >> d & 1 ? a->t[d] : 1 - a->t[d];
    }
}

/* Returns the value of the nodal field `field` of a coarse mesh at a position in cell `cell`. weight[2^dim]: weights of
 * the corners of the cell at this position (coarse_corner_weights). */
static real field_at(const struct mesh *mesh, int64_t cell, const real *weight, const real *field)
{
    real value = 0;
    for (int c = 0; c < 1 << mesh->grid.dim; c++)
        if (weight[c] > 0) value += weight[c] * field[cell + mesh->corner[c]];
    return value;
}

/* Sets displacement and velocity of node I of level 0 (the finest) of l by interpolation in the coarse cell around it.
 * k[dim]: indices of the node along the axes. Does nothing if no coarse cell contains the node, or if a cell of level 0
 * does. */
static void node_interpolate(struct mesh_levels *l, int64_t I, const int64_t *k)
{
    struct mesh *fine = l->fine;
    const struct cell_around a = coarse_around(l, I, k);
    if (a.level == 0) return;
    const struct mesh *mesh = &l->at[a.level].mesh;
    real weight[CORNERS_MAX];
    coarse_corner_weights(&a, fine->grid.dim, weight);
    for (int d = 0; d < fine->grid.dim; d++) {
        fine->displacement[d][I] = field_at(mesh, a.cell, weight, mesh->displacement[d]);
        fine->grid.velocity[d][I] = field_at(mesh, a.cell, weight, mesh->grid.velocity[d]);
    }
}

/* Sets displacement and velocity of those nodes of a row of level 0 (the finest) of l that are inside coarse cells, by
 * interpolation in these cells. row: number of the row of nodes along x. */
static void row_interpolate(struct mesh_levels *l, int64_t row)
{
    const struct grid *g = &l->fine->grid;
    const int64_t first = row * g->count[0];
    int64_t k[DIM_MAX];
    grid_indices_of_node(g, first, k);
    for (int64_t I = first; I < first + g->count[0]; I++, k[0]++) node_interpolate(l, I, k);
}

void mesh_levels_interpolate_motion_into_coarse_cells(struct mesh_levels *l, bool all_nodes)
{
    struct mesh *fine = l->fine;
    if (all_nodes || !fine->absent) {
#pragma omp parallel for schedule(static)
        for (int64_t row = 0; row < fine->rows; row++) row_interpolate(l, row);
        return;
    }
#pragma omp parallel for schedule(static)
    for (int64_t n = 0; n < fine->filled_nodes; n++) {
        int64_t k[DIM_MAX];
        grid_indices_of_node(&fine->grid, fine->filled_node[n], k);
        node_interpolate(l, fine->filled_node[n], k);
    }
}

/* ---- motion of the nodes of new cells ---------------------------------------------------------------------------- */

/* Samples the motion of the nodes of changed cells of l before masses are moved between levels. For every node of level
 * 0 (the finest), stores mass times velocity in grid.momentum. For coarse nodes, stores displacement and velocity of
 * the node of level 0 at the same position, and mass times velocity. */
static void nodes_sample(struct mesh_levels *l)
{
    struct mesh *fine = l->fine;
    for (int d = 0; d < fine->grid.dim; d++)
        for (int64_t I = 0; I < fine->grid.n; I++)
            fine->grid.momentum[d][I] = fine->grid.mass[I] * fine->grid.velocity[d][I];
    for (int level = 1; level <= l->n; level++) {
        struct mesh *mesh = &l->at[level].mesh;
        int64_t k[DIM_MAX] = {0};
        for (int64_t J = 0; J < mesh->grid.n; J++, grid_advance_to_next_node_indices(&mesh->grid, k)) {
            const real mass = mesh->grid.mass[J];
            const int64_t I = mass > 0 ? mesh_levels_fine_node_of_coarse_node(l, level, k) : 0;
            for (int d = 0; d < fine->grid.dim; d++) {
                mesh->displacement[d][J] = mass > 0 ? fine->displacement[d][I] : 0;
                mesh->grid.velocity[d][J] = mass > 0 ? fine->grid.velocity[d][I] : 0;
                mesh->grid.momentum[d][J] = mass * mesh->grid.velocity[d][J];
                mesh->grid.force[d][J] = 0;
            }
        }
    }
}

/* Returns the mean of a nodal field of level 0 (the finest) of l over the corners of all cells of level 0 inside a cell
 * of `level` (cells with the edge of 2^level finest cells). first: index of the lowest of these cells of level 0;
 * field: a value for each node of level 0. */
static real cell_mean(const struct mesh_levels *l, int level, int64_t first, const real *field)
{
    const int dim = l->fine->grid.dim, parts = mesh_levels_fine_cells_per_coarse_cell(l, level);
    real sum = 0;
    for (int part = 0; part < parts; part++)
        for (int c = 0; c < 1 << dim; c++)
            sum += field[mesh_levels_nth_fine_cell_in_coarse_cell(l, level, first, part) + l->fine->corner[c]];
    return sum / (real)(parts << dim);
}

/* Corrects the momentum of cell J of `level` of l (cells with the edge of 2^level finest cells), which has been merged
 * from finer cells. Its corners have the velocities of the finest nodes at their positions. The difference between the
 * momentum of the finest cells and that of cell J with these velocities is added to the corners in equal parts. q[dim]:
 * indices of the cell along the axes. */
static void merged_correct(struct mesh_levels *l, int level, int64_t J, const int64_t *q)
{
    struct mesh *mesh = &l->at[level].mesh;
    const int dim = mesh->grid.dim, corners = 1 << dim;
    const real mass = mesh->cell_mass[mesh->material[J]];
    for (int d = 0; d < dim; d++) {
        const real *velocity = l->fine->grid.velocity[d];
        real mean = 0;
        for (int c = 0; c < corners; c++) {
            int64_t at[DIM_MAX];
            for (int b = 0; b < DIM_MAX; b++) at[b] = b < dim ? q[b] + (c >> b & 1) : 0;
            mean += velocity[mesh_levels_fine_node_of_coarse_node(l, level, at)] / corners;
        }
        const real missing =
            mass / corners * (cell_mean(l, level, mesh_levels_fine_node_of_coarse_node(l, level, q), velocity) - mean);
        for (int c = 0; c < corners; c++) mesh->grid.momentum[d][J + mesh->corner[c]] += missing;
    }
}

/* Corrects the nodal momenta of all coarse cells of l that have just been merged from finer cells. The nodes of such a
 * cell have the velocities of the finest nodes at their positions (nodes_sample), which changes the momentum of the
 * region; the difference is added to its corners (merged_correct), so that the cell has the momentum of the finest
 * cells that it replaces. before: coarsening level that each cell of level 0 (the finest) had before the change of
 * levels. */
static void merged_cells_correct(struct mesh_levels *l, const uint8_t *before)
{
    for (int level = 1; level <= l->n; level++) {
        const struct mesh *mesh = &l->at[level].mesh;
        int64_t q[DIM_MAX] = {0};
        for (int64_t J = 0; J < mesh->grid.n; J++, grid_advance_to_next_node_indices(&mesh->grid, q)) {
            if (mesh->kind[J] != CELL_WHOLE) continue;
            if (mesh_levels_coarse_cell_contains_finer_cells(l, level,
                                                             mesh_levels_fine_node_of_coarse_node(l, level, q), before))
                merged_correct(l, level, J, q);
        }
    }
}

/* Computes the velocities of the nodes of all levels of l from their momenta. Then sets all forces and the momenta of
 * level 0 (the finest) to 0, and the momenta of coarse nodes to those that belong to their velocities by the blended
 * mass matrix (kernels/mesh/mesh_inertia.h). */
static void velocities_make(struct mesh_levels *l)
{
    for (int level = 0; level <= l->n; level++) {
        struct mesh *mesh = mesh_levels_mesh_of_level(l, level);
        for (int d = 0; d < mesh->grid.dim; d++)
            for (int64_t I = 0; I < mesh->grid.n; I++) {
                mesh->grid.velocity[d][I] = mesh->grid.momentum[d][I] * mesh->inverse_mass[I];
                mesh->grid.momentum[d][I] = mesh->grid.force[d][I] = 0;
            }
    }
    mesh_levels_compute_momenta_from_velocities(l);
}

/* Number of iterations w <- w + v - B w that solve B w = v to round-off, with the inverse mass matrix B of
 * kernels/mesh/mesh_inertia.h. The eigenvalues of B - 1 are below 0.48, since mesh->match is at most 1/2 and the
 * eigenvalues of consistent over lumped mass are at least 1/27; for long waves they are far smaller. */
enum { MOMENTA_ROUNDS = 52 };
#define MOMENTA_TOLERANCE 3e-16 /* tolerance of the residual [largest velocity] */

void mesh_levels_compute_momenta_from_velocities(struct mesh_levels *l)
{
    for (int level = 1; level <= l->n; level++) {
        struct grid *g = &l->at[level].mesh.grid;
        real *now[DIM_MAX]; /* B w; momenta of level 0 and forces are not in use now */
        for (int d = 0; d < g->dim; d++) {
            array_copy(g->momentum[d], g->velocity[d], g->n, sizeof(real));
            now[d] = g->force[d];
        }
        real left = INFINITY, most = 0;
        for (int d = 0; d < g->dim; d++)
            for (int64_t J = 0; J < g->n; J++) most = real_max(most, fabs(g->velocity[d][J]));
        for (int round = 0; round < MOMENTA_ROUNDS && left > MOMENTA_TOLERANCE * most; round++) {
            mesh_velocity(&l->at[level].mesh, g->momentum, now);
            left = 0;
            for (int d = 0; d < g->dim; d++)
                for (int64_t J = 0; J < g->n; J++) {
                    const real missing = g->mass[J] > 0 ? g->velocity[d][J] - now[d][J] : 0;
                    g->momentum[d][J] += missing;
                    left = real_max(left, fabs(missing));
                }
        }
        mesh_velocity(&l->at[level].mesh, g->momentum, g->velocity);
        for (int d = 0; d < g->dim; d++) array_fill_bytes(now[d], 0, g->n, sizeof(real));
    }
}

void mesh_levels_shift_velocities_half_step(struct mesh_levels *l, const struct particles *p, const struct elastic *m,
                                            bool finite_strain, real dt)
{
    mesh_clear(l->fine);
    mesh_force(l->fine, p, m, finite_strain);
    mesh_levels_compute_forces_of_coarse_cells(l, p, m, finite_strain, l->n);
    for (int level = 0; level <= l->n; level++) {
        struct mesh *mesh = mesh_levels_mesh_of_level(l, level);
        const real half = 0.5 * dt * (real)(1 << level);
        for (int d = 0; d < mesh->grid.dim; d++) {
            real *moved = level > 0 ? mesh->grid.momentum[d] : mesh->grid.velocity[d];
            for (int64_t I = 0; I < mesh->grid.n; I++)
                moved[I] += half * mesh->inverse_mass[I] * mesh->grid.force[d][I];
        }
        if (level > 0) mesh_velocity(mesh, mesh->grid.momentum, mesh->grid.velocity);
    }
    for (int level = 1; level <= l->n; level++) mesh_levels_interpolate_motion_of_hanging_nodes(l, level);
    mesh_levels_copy_motion_to_ghost_nodes(l);
}

void mesh_levels_change_refinement(struct mesh_levels *l, const struct particles *p, const struct mesh_source *source,
                                   const uint8_t *new_cell_level)
{
    const int64_t cells = l->fine->grid.n;
    uint8_t *before = NEW("levels.before", 2 * cells + LANES, uint8_t), *dirty = before + cells;
    mesh_levels_copy_motion_to_ghost_nodes(l);
    mesh_levels_interpolate_motion_into_coarse_cells(l, true);
    array_copy(before, l->level, cells, 1);
    for (int64_t I = 0; I < cells; I++) dirty[I] = before[I] != new_cell_level[I];
    array_copy(l->level, new_cell_level, cells, 1);
    mesh_rebuild_cells_after_level_change(l->fine, p, source, dirty);
    mesh_levels_rebuild_coarse_cells_and_node_masses(l, p);
    mesh_levels_find_ghost_and_hanging_nodes(l);
    nodes_sample(l);
    merged_cells_correct(l, before);
    mesh_levels_add_dependent_node_masses_to_masters(l, true);
    mesh_levels_list_cell_runs_and_nodes_with_mass(l);
    velocities_make(l);
    for (int k = 1; k <= l->n; k++) mesh_levels_interpolate_motion_of_hanging_nodes(l, k);
    mesh_levels_copy_motion_to_ghost_nodes(l);
    mesh_levels_classify_cells_by_distance_to_coarse(l);
    l->changes++;
    memory_free(before);
}
