/* Inserts particles that become material points of the mesh again: recomputes mass, momentum and displacement of the
 * nodes around them. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "mesh_parts.h"

/* Indices of the nodes at the corners of the cells with inserted points, in ascending order without duplicates. */
struct nodes {
    int64_t n;
    int32_t *at;
};

/* Finds the nodes at the corners of the cells of `mesh` that contain the n particles list[k] of p, and lists each node
 * once in *t, ascending. The caller releases t->at with memory_free. */
static void nodes_find(struct nodes *t, const struct mesh *mesh, const struct particles *p, const int32_t *list,
                       int64_t n)
{
    uint8_t *mark = NEW("mesh_insert.mark", mesh->grid.n, uint8_t);
    for (int64_t k = 0; k < n; k++)
        for (int c = 0; c < 1 << p->dim; c++)
            mark[mesh_cell_corner_node(mesh, mesh_find_quadrature_point_index_of_particle(mesh, p, list[k]) >> p->dim,
                                       c)] = 1;
    for (int64_t I = 0; I < mesh->grid.n; I++) t->n += mark[I];
    t->at = NEW("mesh_insert.node", t->n, int32_t);
    t->n = 0;
    for (int64_t I = 0; I < mesh->grid.n; I++)
        if (mark[I]) t->at[t->n++] = (int32_t)I;
    memory_free(mark);
}

/* Returns the kinetic energy of the nodes t of the mesh, with lumped masses [J]. */
static real kinetic_of(const struct mesh *mesh, const struct nodes *t)
{
    real sum = 0;
    for (int64_t k = 0; k < t->n; k++)
        for (int d = 0; d < mesh->grid.dim; d++)
            sum += 0.5 * mesh->grid.mass[t->at[k]] * square(mesh->grid.velocity[d][t->at[k]]);
    return sum;
}

/* Makes the n particles list[k] of p points of the mesh. Recomputes mass and velocity of the nodes t around them such
 * that momentum is conserved. Overwrites grid.momentum of these nodes. */
static void points_enter(struct mesh *mesh, struct particles *p, const struct nodes *t, const int32_t *list, int64_t n)
{
    const int dim = p->dim;
    for (int64_t k = 0; k < t->n; k++) {
        const int32_t I = t->at[k];
        for (int d = 0; d < dim; d++) mesh->grid.momentum[d][I] = mesh->grid.mass[I] * mesh->grid.velocity[d][I];
    }
    for (int64_t k = 0; k < n; k++) {
        const int32_t i = list[k];
        const int64_t place = mesh_find_quadrature_point_index_of_particle(mesh, p, i);
        mesh->place[i] = (int32_t)place;
        mesh->point[place] = i;
        mesh->points++;
        p->flag[i] |= FLAG_MESHED;
        for (int c = 0; c < 1 << dim; c++)
            for (int d = 0; d < dim; d++)
                mesh->grid.momentum[d][mesh_cell_corner_node(mesh, place >> dim, c)] +=
                    p->mass[i] * mesh_shape_function_value(dim, c, (int)(place & ((1 << dim) - 1))) * p->v[d][i];
    }
    for (int64_t k = 0; k < t->n; k++) {
        const int32_t I = t->at[k];
        mesh_node_update_mass(mesh, p, I);
        for (int d = 0; d < dim; d++) mesh->grid.velocity[d][I] = mesh->grid.momentum[d][I] * mesh->inverse_mass[I];
    }
}

/* Sets the displacement of those nodes I of the mesh that had no mass before, light[I], to the mean displacement of the
 * inserted points around the node, weighted by mass times shape function. list[n]: indices of the inserted points in p.
 */
static void mesh_insert_nodes_start(struct mesh *mesh, const struct particles *p, const uint8_t *light,
                                    const int32_t *list, int64_t n)
{
    const int dim = p->dim;
    for (int64_t k = 0; k < n; k++) {
        const int32_t i = list[k];
        const int64_t cell = mesh->place[i] >> dim;
        for (int c = 0; c < 1 << dim; c++) {
            const int64_t I = mesh_cell_corner_node(mesh, cell, c);
            const real share = p->mass[i] * mesh_shape_function_value(dim, c, mesh->place[i] & ((1 << dim) - 1)) *
                               mesh->inverse_mass[I];
            for (int d = 0; d < dim && light[I]; d++) mesh->displacement[d][I] += share * (p->x[d][i] - p->X[d][i]);
        }
    }
}

real mesh_insert_points_and_return_lost_energy(struct mesh *mesh, struct particles *p, const int32_t *inserted_points,
                                               int64_t inserted_count)
{
    struct nodes t = {0};
    real *u[DIM_MAX], energy = 0;
    nodes_find(&t, mesh, p, inserted_points, inserted_count);
    mesh_points_move(mesh, p); /* displacements are fitted to these points, too */
    for (int64_t k = 0; k < inserted_count; k++)
        for (int d = 0; d < p->dim; d++)
            energy += 0.5 * p->mass[inserted_points[k]] * square(p->v[d][inserted_points[k]]);
    energy += kinetic_of(mesh, &t);
    uint8_t *light = NEW("mesh_insert.light", mesh->grid.n, uint8_t);
    for (int64_t k = 0; k < t.n; k++) light[t.at[k]] = mesh->grid.mass[t.at[k]] == 0;
    points_enter(mesh, p, &t, inserted_points, inserted_count);
    energy -= kinetic_of(mesh, &t);
    for (int d = 0; d < p->dim; d++) {
        u[d] = NEW("mesh_insert.u", p->n, real);
        for (int64_t i = 0; i < p->n; i++) u[d][i] = p->x[d][i] - p->X[d][i];
    }
    mesh_insert_nodes_start(mesh, p, light, inserted_points, inserted_count);
    mesh_fit_listed_nodal_values_to_point_values(mesh, p, u, mesh->displacement, t.at, t.n);
    for (int d = 0; d < p->dim; d++) memory_free(u[d]);
    memory_free(light);
    memory_free(t.at);
    return energy;
}
