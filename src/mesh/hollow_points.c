/* Makes material points for output in coarse cells without particles, one for each integration point, so that output
 * frames show these cells, too. */
#include <string.h>

#include "base/memory.h"
#include "mesh/mesh_part.h"

/* Sets positions, volumes, masses and materials of the points of cell `cell` of the mesh, one for each of its 2^dim
 * integration points (at a quarter or three quarters of its edge along each axis). m: materials of the scene; first:
 * index of the first of these points in p; point[2^dim]: receives their indices. */
static void cell_points(struct particles *p, const struct mesh *mesh, const struct material *m, int64_t cell,
                        int64_t first, int32_t *point)
{
    const struct grid *g = &mesh->grid;
    for (int c = 0; c < 1 << g->dim; c++) {
        const int64_t i = first + c;
        point[c] = (int32_t)i;
        for (int d = 0; d < g->dim; d++) p->X[d][i] = grid_cell_quadrature_point_coordinate(g, cell, c, d);
        p->volume0[i] = p->volume[i] = mesh->volume;
        p->material[i] = mesh->material[cell];
        p->mass[i] = m[p->material[i]].density * mesh->volume;
        p->id[i] = (int32_t)i;
    }
}

/* Makes points, only for output, in cells whose particles were not created: one for each integration point of the cells
 * cell[cells] of `level`, which have the edge of 2^level finest cells. The points are stored in reference->shown.part
 * from index `first` on, and move with the nodes of these cells. body: the particles of the run; m: materials of the
 * scene. */
static void level_points(struct lagrangian_mesh *reference, const struct particles *body, const struct material *m,
                         int level, const int64_t *cell, int64_t cells, int64_t first)
{
    struct particles *p = &reference->shown.part;
    struct mesh mesh = reference->levels.at[level].mesh;
    const int dim = p->dim;
    mesh.point = BARE("report.point", mesh.grid.n << dim, int32_t);
    for (int64_t k = 0; k < mesh.grid.n << dim; k++) mesh.point[k] = -1;
    for (int64_t k = 0; k < cells; k++)
        cell_points(p, &mesh, m, cell[k], first + (k << dim), mesh.point + (cell[k] << dim));
    mesh_points_move(&mesh, p);
    mesh_points_stress(&mesh, p, reference->elastic, reference->finite);
    if (reference->shown.gradient[0]) mesh_points_gradient(&mesh, reference->shown.gradient);
    for (int64_t i = first; i < first + (cells << dim); i++) {
        reference->shown.spacing[i] = 0.5 * mesh.grid.h;
        p->id[i] += (int32_t)body->n_body;
    }
    memory_free(mesh.point);
}

void coarse_cell_points_free(struct coarse_cell_points *coarse)
{
    particles_free(&coarse->part);
    memory_free(coarse->spacing);
    coarse->spacing = NULL;
    for (int k = 0; k < DIM_MAX * DIM_MAX; k++) {
        memory_free(coarse->gradient[k]);
        coarse->gradient[k] = NULL;
    }
}

bool coarse_cell_points_interpolate_for_output(struct lagrangian_mesh *reference, const struct particles *body,
                                               const struct material *m, bool with_gradients)
{
    struct mesh_levels *l = &reference->levels;
    const int dim = body->dim;
    int64_t cells[LEVELS_MAX + 1] = {0}, points = 0;
    coarse_cell_points_free(&reference->shown);
    if (!reference->hollow.absent) return false;
    for (int level = 1; level <= l->n; level++)
        points += (cells[level] = mesh_levels_list_cells_without_particles(l, level, NULL)) << dim;
    particles_make(&reference->shown.part, dim, points, 0);
    reference->shown.part.plane_strain = body->plane_strain;
    reference->shown.spacing = NEW("report.spacing", points, real);
    for (int k = 0; k < dim * dim && with_gradients; k++)
        reference->shown.gradient[k] = NEW("report.gradient", points, real);
    for (int level = 1, first = 0; level <= l->n; first += (int)cells[level] << dim, level++) {
        int64_t *cell = BARE("report.cell", cells[level], int64_t);
        mesh_levels_list_cells_without_particles(l, level, cell);
        level_points(reference, body, m, level, cell, cells[level], first);
        memory_free(cell);
    }
    return true;
}
