/* Estimates the energy that would be lost if cells became parts of coarser cells, and limits their coarsening level by
 * it. */
#include <math.h>

#include "levels_parts.h"

/* Returns the energy per mass [J/kg] that would be lost if the nodes of level 0 (the finest) of l inside a cell of
 * `level` (cells with the edge of 2^level finest cells) moved by interpolation between its corners. q[dim]: indices of
 * the cell. It is the larger of two estimates. One is the mean energy of the differences of velocity and displacement
 * from the interpolated values (displacements as a strain over half the cell). The other is the change of kinetic
 * energy by lumping the mass at the corners, which matters where velocities vary much between the corners. */
static real departure(const struct mesh_levels *l, int level, const int64_t *q)
{
    const struct mesh *fine = l->fine;
    const int dim = fine->grid.dim, edge = 1 << level, side = edge + 1, corners = 1 << dim;
    const int nodes = dim == 1 ? side : dim == 2 ? side * side : side * side * side;
    const int64_t first = mesh_levels_fine_node_of_coarse_node(l, level, q);
    const real stiff = l->wave_speed / (0.5 * mesh_levels_mesh_of_level_read_only(l, level)->grid.h);
    real sum = 0, squares = 0;
    for (int node = 0; node < nodes; node++) {
        int64_t I = first;
        real share[CORNERS_MAX], lump = 1;
        for (int c = 0; c < corners; c++) share[c] = 1;
        for (int d = 0, left = node; d < dim; d++, left /= side) {
            const real t = (real)(left % side) / edge;
            I += left % side * fine->grid.stride[d];
            lump *= t > 0 && t < 1 ? 1.0 / edge : 0.5 / edge;
            for (int c = 0; c < corners; c++) share[c] *= c >> d & 1 ? t : 1 - t;
        }
        for (int d = 0; d < dim; d++) {
            real u = fine->displacement[d][I], v = fine->grid.velocity[d][I], v2 = lump * square(v);
            for (int c = 0; c < corners; c++) {
                int64_t J = first;
                for (int b = 0; b < dim; b++) J += (c >> b & 1) * edge * fine->grid.stride[b];
                u -= share[c] * fine->displacement[d][J], v -= share[c] * fine->grid.velocity[d][J];
                if (node == 0) squares -= square(fine->grid.velocity[d][J]) / corners;
            }
            squares += v2;
            sum += 0.5 * (square(v) + square(stiff * u));
        }
    }
    return real_max(sum / nodes, 0.5 * fabs(squares));
}

bool mesh_levels_limit_coarsening_by_energy_loss(const struct mesh_levels *l, const uint8_t *intended_cell_level,
                                                 real max_energy, uint8_t *highest_level)
{
    const struct grid *g = &l->fine->grid;
    int64_t k[DIM_MAX] = {0}, q[DIM_MAX];
    bool any = false;
    for (int64_t I = 0; I < g->n; I++, grid_advance_to_next_node_indices(g, k)) {
        if (intended_cell_level[I] == 0 ||
            !mesh_levels_fine_cell_is_lowest_in_coarse_cell(l, intended_cell_level[I], k) ||
            !mesh_levels_coarse_cell_contains_finer_cells(l, intended_cell_level[I], I, l->level))
            continue;
        mesh_levels_coarse_cell_of_fine_cell(l, intended_cell_level[I], k, q);
        if (!(departure(l, intended_cell_level[I], q) > max_energy)) continue;
        any = true;
        for (int part = 0; part < mesh_levels_fine_cells_per_coarse_cell(l, intended_cell_level[I]); part++)
            highest_level[mesh_levels_nth_fine_cell_in_coarse_cell(l, intended_cell_level[I], I, part)] =
                intended_cell_level[I] - 1;
    }
    return any;
}
