/* Builds the meshes of coarse cells from the coarsening level of each finest cell: cells and nodal masses, nodes at
 * interfaces between levels (ghosts and hanging nodes), and the cells with a blended mass matrix. */
#include <string.h>

#include "base/memory.h"
#include "levels_parts.h"

/* ---- cells ------------------------------------------------------------------------------------------------------- */

/* Makes the coarse cells of l from l->level, the coarsening level of each cell of level 0 (the finest): kind and
 * material of the cells, their number, and the masses of their nodes from the particles p. Transfers no mass between
 * levels; mesh_levels_add_dependent_node_masses_to_masters does that. */
void mesh_levels_rebuild_coarse_cells_and_node_masses(struct mesh_levels *l, const struct particles *p)
{
    const struct mesh *fine = l->fine;
    const int corners = 1 << fine->grid.dim;
    int64_t k[DIM_MAX] = {0};
    for (int level = 1; level <= l->n; level++) {
        struct mesh *mesh = &l->at[level].mesh;
        array_fill_bytes(mesh->kind, CELL_EMPTY, mesh->grid.n, 1);
        array_fill_bytes(mesh->grid.mass, 0, mesh->grid.n, sizeof(real));
        l->at[level].cells = 0;
    }
    for (int64_t I = 0; I < fine->grid.n; I++, grid_advance_to_next_node_indices(&fine->grid, k)) {
        const int level = l->level[I];
        if (level == 0 || !mesh_levels_fine_cell_is_lowest_in_coarse_cell(l, level, k)) continue;
        struct mesh *mesh = &l->at[level].mesh;
        const int64_t J = mesh_levels_coarse_cell_of_fine_cell(l, level, k, NULL);
        mesh->kind[J] = CELL_WHOLE;
        mesh->material[J] = mesh_material_of_filled_cell(fine, p, I);
        for (int c = 0; c < corners; c++)
            mesh->grid.mass[J + mesh->corner[c]] += mesh->cell_mass[mesh->material[J]] / corners;
        l->at[level].cells++;
    }
    for (int level = 1; level <= l->n; level++) l->at[level].mesh.points = l->at[level].cells * corners;
}

/* ---- interfaces of levels ---------------------------------------------------------------------------------------- */

/* Returns true if a cell around node I of the mesh computes forces, i.e. has points and is not replaced by a coarse
 * cell. */
static bool node_acts(const struct mesh *mesh, int64_t I)
{
    bool acts = false;
    for (int c = 0; c < 1 << mesh->grid.dim && !acts; c++) {
        const int64_t cell = I - mesh->corner[c];
        acts = cell >= 0 && mesh_cell_contributes_forces_to_nodes(mesh, cell);
    }
    return acts;
}

/* Returns true if a cell of `level` (cells with the edge of 2^level finest cells) of l computes forces and has the
 * given node of the next finer level inside or on its boundary. at[dim]: indices of this node along the axes, counted
 * from the lower corner of the body in cells of the finer level. */
static bool coarse_beside(const struct mesh_levels *l, int level, const int64_t *at)
{
    const struct mesh *mesh = &l->at[level].mesh;
    const int dim = mesh->grid.dim;
    for (int c = 0; c < 1 << dim; c++) {
        int64_t J = 0;
        bool twice = false; /* the cells below and above an odd position are identical */
        for (int d = 0; d < dim; d++) {
            const bool below = c >> d & 1, odd = at[d] & 1;
            twice = twice || (below && odd);
            J += ((at[d] >> 1) - (below && !odd) + l->offset[level][d]) * mesh->grid.stride[d];
        }
        if (!twice && J >= 0 && J < mesh->grid.n && mesh_cell_contributes_forces_to_nodes(mesh, J)) return true;
    }
    return false;
}

/* Appends a ghost to the list of the coarse level m. A ghost is a node of the coarse mesh, `coarse`, whose displacement
 * is that of the node `fine` of the finer mesh at the same position. */
static void ghost_add(struct mesh_level *m, int64_t coarse, int64_t fine)
{
    GROW("levels.ghost", m->ghost, m->ghosts + 1);
    m->ghost[m->ghosts++] = (struct mesh_ghost){(int32_t)coarse, (int32_t)fine};
}

/* Appends node I of `mesh`, the next finer mesh, to the list of hanging nodes of the coarse level m. A hanging node is
 * in the middle of an edge or face of a coarser cell, and its motion is the mean of that of the nodes at the ends or
 * corners, its masters. odd: axes along which the edge or face extends, as bits (bit d: axis d). */
static void hanging_add(struct mesh_level *m, const struct mesh *mesh, int64_t I, unsigned odd)
{
    struct mesh_hanging h = {.node = (int32_t)I};
    GROW("levels.hanging", m->hanging, m->hangings + 1);
    for (unsigned c = 0; c < 1u << mesh->grid.dim; c++) {
        int64_t J = I;
        if (c & ~odd) continue;
        for (int d = 0; d < mesh->grid.dim; d++)
            if (odd >> d & 1) J += c >> d & 1 ? mesh->grid.stride[d] : -mesh->grid.stride[d];
        h.master[h.masters++] = (int32_t)J;
    }
    m->hanging[m->hangings++] = h;
}

/* Finds the nodes at the interface between the cells of `level` of l (cells with the edge of 2^level finest cells) and
 * finer cells: ghosts, which are nodes of the coarse mesh with a finer node at their position, and hanging nodes of the
 * finer mesh, in the middle of coarse edges or faces. */
static void interface_find(struct mesh_levels *l, int level)
{
    struct mesh_level *m = &l->at[level];
    const struct mesh *below = mesh_levels_mesh_of_level_read_only(l, level - 1);
    int64_t k[DIM_MAX] = {0}, at[DIM_MAX];
    m->ghosts = m->hangings = 0;
    for (int64_t I = 0; I < below->grid.n; I++, grid_advance_to_next_node_indices(&below->grid, k)) {
        unsigned odd = 0;
        int64_t J = 0;
        if (!node_acts(below, I)) continue;
        for (int d = 0; d < below->grid.dim; d++) {
            at[d] = k[d] - l->offset[level - 1][d];
            odd |= (unsigned)(at[d] & 1) << d;
            J += ((at[d] >> 1) + l->offset[level][d]) * m->mesh.grid.stride[d];
        }
        if (!coarse_beside(l, level, at)) continue;
        if (odd)
            hanging_add(m, below, I, odd);
        else
            ghost_add(m, J, I);
    }
}

/* Sets bit c of mesh->matched[I] if node I is corner c of a cell with a mass matrix blended of lumped and consistent
 * mass (kernels/mesh/mesh_inertia.h). These are whole cells (with all points, of one material) of which all neighbours
 * are whole cells of this material, too. */
static void matched_find(struct mesh *mesh)
{
    const struct grid *g = &mesh->grid;
    const int dim = g->dim, around = dim == 1 ? 3 : dim == 2 ? 9 : 27;
    array_fill_bytes(mesh->matched, 0, g->n, 1);
    for (int64_t I = 0; I < g->n; I++) {
        bool alike = mesh->kind[I] == CELL_WHOLE;
        for (int q = 0; q < around && alike; q++) {
            int64_t J = I;
            for (int d = 0, left = q; d < dim; d++, left /= 3) J += (left % 3 - 1) * g->stride[d];
            alike = mesh->kind[J] == CELL_WHOLE && mesh->material[J] == mesh->material[I];
        }
        for (int c = 0; c < 1 << dim && alike; c++) mesh->matched[I + mesh->corner[c]] |= (uint8_t)(1u << c);
    }
}

void mesh_levels_find_ghost_and_hanging_nodes(struct mesh_levels *l)
{
    for (int level = 1; level <= l->n; level++) {
        interface_find(l, level);
        matched_find(&l->at[level].mesh);
    }
}

/* Adds `share` times the value of node i of one mesh to the value of node k of another: to[k] += share * from[i]. */
static inline void give(const real *from, int64_t i, real *to, int64_t k, real share) { to[k] += share * from[i]; }

/* Transfers the momentum of hanging node h of g along axis d to its masters. A hanging node is in the middle of an edge
 * or face of a coarser cell, and its masters are the nodes at the ends or corners. Each master receives an equal share
 * of the mass of h, with its own velocity plus the difference between the velocity of h and the mean of the masters.
 * This difference is 0 if velocities are linear along the edge. */
static void hanging_give(struct grid *g, const struct mesh_hanging *h, int d)
{
    const real *velocity = g->velocity[d], share = g->mass[h->node] / h->masters;
    real rest = velocity[h->node];
    for (int q = 0; q < h->masters; q++) rest -= velocity[h->master[q]] / h->masters;
    for (int q = 0; q < h->masters; q++) g->momentum[d][h->master[q]] += share * (velocity[h->master[q]] + rest);
    g->momentum[d][h->node] = 0;
}

void mesh_levels_add_dependent_node_masses_to_masters(struct mesh_levels *l, bool transfer_momenta)
{
    for (int level = 1; level <= l->n; level++) {
        struct mesh_level *m = &l->at[level];
        struct grid *coarse = &m->mesh.grid, *fine = &mesh_levels_mesh_of_level(l, level - 1)->grid;
        for (int64_t k = 0; k < m->ghosts; k++) {
            const struct mesh_ghost s = m->ghost[k];
            give(coarse->mass, s.coarse, fine->mass, s.fine, 1);
            coarse->mass[s.coarse] = 0;
            for (int d = 0; d < fine->dim && transfer_momenta; d++) {
                give(coarse->momentum[d], s.coarse, fine->momentum[d], s.fine, 1);
                coarse->momentum[d][s.coarse] = 0;
            }
        }
        for (int64_t k = 0; k < m->hangings; k++) {
            const struct mesh_hanging *h = &m->hanging[k];
            for (int d = 0; d < fine->dim && transfer_momenta; d++) hanging_give(fine, h, d);
            for (int q = 0; q < h->masters; q++) give(fine->mass, h->node, fine->mass, h->master[q], 1.0 / h->masters);
            fine->mass[h->node] = 0;
        }
    }
    for (int level = 0; level <= l->n; level++) {
        struct mesh *mesh = mesh_levels_mesh_of_level(l, level);
        for (int64_t I = 0; I < mesh->grid.n; I++)
            mesh->inverse_mass[I] = mesh->grid.mass[I] > 0 ? 1 / mesh->grid.mass[I] : 0;
    }
}

void mesh_levels_list_cell_runs_and_nodes_with_mass(struct mesh_levels *l)
{
    for (int level = 1; level <= l->n; level++) mesh_list_cell_runs_and_nodes_with_mass(&l->at[level].mesh);
    mesh_find_span_of_nodes_with_mass_per_row(l->fine);
    mesh_activate_only_node_blocks_next_to_cells(l->fine);
}

void mesh_levels_match_wave_dispersion_of_bonds(struct mesh_levels *l, real edge, real wave_speed, real dt)
{
    l->wave_speed = wave_speed;
    for (int level = 1; level <= l->n; level++) {
        struct mesh *mesh = &l->at[level].mesh;
        const real longer = (real)(1 << level);
        const real share =
            0.5 * (1 - (square(edge) + (square(longer) - 1) * square(wave_speed * dt)) / square(mesh->grid.h));
        mesh->match = real_max(0, share);
    }
}
