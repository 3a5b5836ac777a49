/* Makes the mesh of the undeformed body: positions of material points in cells, nodal masses, runs of whole cells and
 * cells with own stiffness. Updates it when points are converted to peridynamic particles. */
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "mesh_parts.h"
#include "base/team.h"

#define PLACE_TOLERANCE 1e-6  /* tolerance of the positions of points in a cell [cells] */
#define VOLUME_TOLERANCE 1e-9 /* relative tolerance of the volumes of points [1] */
/* Exponent of the rounding of nodal displacements to multiples of 2^-60 cell edges. This is far below the last bit of a
 * position, but rounds the tiny precursor of a wave to 0, so that nodes ahead of the wave stay at rest. */
#define DISPLACEMENT_BITS 60

/* ---- positions of points ----------------------------------------------------------------------------------------- */

/* Returns REFUSED with the message that a body cannot be on a mesh because of particle i of p. what: text that follows
 * "the particle at (x, y, z) m", such as "shares its position in the grid cell with another particle". */
static status meshed_body(const struct particles *p, int64_t i, const char *what)
{
    return status_set(
        REFUSED, "mpm.frame: reference is impossible: the particle at (%.6g, %.6g, %.6g) m %s; set mpm.frame: current",
        p->X[0][i], p->dim > 1 ? p->X[1][i] : 0.0, p->dim > 2 ? p->X[2][i] : 0.0, what);
}

int64_t mesh_find_quadrature_point_index_of_particle(const struct mesh *mesh, const struct particles *p,
                                                     int64_t particle)
{
    const struct grid *g = &mesh->grid;
    int64_t cell = 0;
    int q = 0;
    for (int d = 0; d < p->dim; d++) {
        const real at = (p->X[d][particle] - g->anchor[d]) / g->h - (real)g->first[d];
        const int64_t k = (int64_t)floor(at);
        const bool upper = at - (real)k > 0.5;
        if (fabs(at - (real)k - (upper ? 0.75 : 0.25)) > PLACE_TOLERANCE) return -1;
        cell += k * g->stride[d];
        q |= upper << d;
    }
    const struct mesh_slits *s = &mesh->slits;
    if (s->cut && s->cut[cell] >= 0) cell = s->home[((int64_t)s->cut[cell] << p->dim) + q];
    return (cell << p->dim) + q;
}

/* Finds the cell and the integration point of every particle of p with FLAG_MESHED, and stores them in mesh->place and
 * mesh->point. A cell has 2^dim integration points, with at most one particle each. Returns REFUSED, with a message, if
 * a particle is not at an integration point, two particles share an integration point, or their volumes differ. */
static status points_place(struct mesh *mesh, const struct particles *p)
{
    for (int64_t i = 0; i < p->n; i++) {
        mesh->place[i] = -1;
        if (!(p->flag[i] & FLAG_MESHED)) continue;
        const int64_t place = mesh_find_quadrature_point_index_of_particle(mesh, p, i);
        if (place < 0)
            return meshed_body(p, i,
                               "is not at its place in a grid cell of two particles in each direction, which needs a "
                               "regular lattice, mpm.cell: 2 and an mpm.origin midway between particles");
        if (mesh->point[place] >= 0)
            return meshed_body(p, i, "shares its position in the grid cell with another particle");
        if (mesh->points == 0) mesh->volume = p->volume0[i];
        if (fabs(p->volume0[i] - mesh->volume) > VOLUME_TOLERANCE * mesh->volume)
            return meshed_body(p, i, "has a volume that differs from that of other particles");
        mesh->place[i] = (int32_t)place;
        mesh->point[place] = (int32_t)i;
        mesh->points++;
    }
    return OK;
}

/* Returns the mass of node I of the mesh [kg] from the points of p in the cells around it, with linear shape functions,
 * summed in a fixed order. */
static real node_mass(const struct mesh *mesh, const struct particles *p, int64_t I)
{
    const int dim = p->dim;
    real mass = 0;
    for (int c = (1 << dim) - 1; c >= 0; c--)
        for (int64_t cell = mesh_cell_with_corner_at_node(mesh, I, c); cell >= 0;
             cell = mesh_next_subcell_of_cell_divided_by_slits(mesh, cell))
            for (int q = 0; q < 1 << dim && mesh_cell_corner_node(mesh, cell, c) == I &&
                            !mesh_cell_is_part_of_coarse_cell(mesh, cell);
                 q++) {
                const int32_t i = mesh->point[(cell << dim) + q];
                if (i >= 0) mass += p->mass[i] * mesh_shape_function_value(dim, c, q);
            }
    return mass;
}

void mesh_node_update_mass(struct mesh *mesh, const struct particles *p, int64_t I)
{
    mesh->grid.mass[I] = node_mass(mesh, p, I);
    mesh->inverse_mass[I] = mesh->grid.mass[I] > 0 ? 1 / mesh->grid.mass[I] : 0;
}

/* Returns OK if no two bodies of p share a node of the mesh; they would move as one body there. Returns REFUSED, with a
 * message, if two bodies do. */
static status bodies_apart(const struct mesh *mesh, const struct particles *p)
{
    uint8_t *body = NEW("mesh.body", mesh->grid.n, uint8_t); /* 1 + body of the points around the node */
    status s = OK;
    for (int64_t i = 0; i < p->n && s == OK; i++)
        for (int c = 0; c < 1 << p->dim && mesh->place[i] >= 0; c++) {
            uint8_t *owner = &body[mesh_cell_corner_node(mesh, mesh->place[i] >> p->dim, c)];
            if (*owner != 0 && *owner != p->body[i] + 1)
                s = meshed_body(p, i, "shares a node with another body, so both would move together");
            *owner = (uint8_t)(p->body[i] + 1);
        }
    memory_free(body);
    return s;
}

/* ---- cells ------------------------------------------------------------------------------------------------------- */

/* Returns the kind of cell I of the mesh. A whole cell has all its points, of one material and without partial stresses
 * (the share of stress left to bonds), and all its corners are nodes of the grid. A cell with own stiffness has points,
 * but lacks one of these properties; an empty cell has no points. p: particles; s: partial stresses. */
static enum cell_kind cell_kind(const struct mesh *mesh, const struct particles *p, const struct mesh_source *s,
                                int64_t I)
{
    const int dim = p->dim;
    int there = 0;
    bool alike = !mesh_cell_corner_nodes_if_at_slit(mesh, I);
    if (mesh_cell_is_part_of_coarse_cell(mesh, I)) return CELL_COARSE;
    const int32_t *point = &mesh->point[I << dim];
    for (int q = 0; q < 1 << dim; q++) {
        if (point[q] < 0) continue;
        there++;
        alike = alike && (point[0] >= 0 && p->material[point[q]] == p->material[point[0]]) &&
                !(s->partial && s->partial->index && s->partial->index[point[q]] >= 0);
    }
    return there == 0 ? CELL_EMPTY : there == 1 << dim && alike ? CELL_WHOLE : CELL_PARTIAL;
}

/* Appends cell I to the last run of the present band of the mesh, or begins a new run with it. A run is a row of
 * consecutive whole cells (with all points, of one material, number `material`); a band is a set of layers of cells
 * that one thread processes. */
static void run_add(struct mesh *mesh, int64_t I, uint8_t material)
{
    struct mesh_cell_run *last = mesh->runs > mesh->band[mesh->bands] ? &mesh->run[mesh->runs - 1] : NULL;
    if (last && last->cell + last->cells == I && last->material == material) {
        last->cells++;
        return;
    }
    GROW("mesh.run", mesh->run, mesh->runs + 1);
    mesh->run[mesh->runs++] = (struct mesh_cell_run){(int32_t)I, 1, material, false};
}

/* Returns the number of layers of cells, along the last of dim axes, in a band: a set of cells that one thread
 * processes. Bands that are not adjacent share no node. */
static int64_t band_layers(int dim) { return dim == 1 ? INT64_MAX : dim == 2 ? 4 : 2; }

/* Stores in mesh->span for each row of nodes along x the range from the first node with mass to one past the last. The
 * range may contain nodes without mass. */
void mesh_find_span_of_nodes_with_mass_per_row(struct mesh *mesh)
{
    const struct grid *g = &mesh->grid;
#pragma omp parallel for schedule(static)
    for (int64_t r = 0; r < mesh->rows; r++) {
        int64_t first = r * g->count[0], end = first + g->count[0];
        while (first < end && g->mass[first] == 0) first++;
        while (end > first && g->mass[end - 1] == 0) end--;
        mesh->span[2 * r] = (int32_t)first, mesh->span[2 * r + 1] = (int32_t)end;
    }
}

/* Returns the material of whole cell I, a cell with all points, of one material. p: particles of the mesh; NULL for a
 * mesh without points, such as that of coarse cells. */
static uint8_t material_of(const struct mesh *mesh, const struct particles *p, int64_t I)
{
    return p ? p->material[mesh->point[I << mesh->grid.dim]] : mesh->material[I];
}

/* Lists the runs and the cells with own stiffness of the mesh. A run is a row of consecutive whole cells of one
 * material. Partial cells lack points, or have several materials, partial stresses or doubled nodes. Runs are listed
 * band by band (layers of cells that one thread processes). p: particles; NULL for a mesh without points. */
static void cells_list(struct mesh *mesh, const struct particles *p)
{
    const struct grid *g = &mesh->grid;
    const int last = g->dim - 1;
    const int64_t layers = g->dim == 1 ? 1 : g->count[last], each = band_layers(g->dim);
    mesh->runs = mesh->bands = mesh->own_stiffness_cells = 0;
    for (int64_t layer = 0; layer < layers; layer += each < layers ? each : layers) {
        const int64_t end = layer + each < layers && each < layers ? layer + each : layers;
        const int64_t from = g->dim == 1 ? 0 : layer * g->stride[last], to = g->dim == 1 ? g->n : end * g->stride[last];
        mesh->band[mesh->bands] = mesh->runs;
        for (int64_t I = from; I < to; I++) {
            if (mesh->kind[I] == CELL_WHOLE) run_add(mesh, I, material_of(mesh, p, I));
            if (mesh->kind[I] == CELL_PARTIAL) mesh_cells_with_own_stiffness_add(mesh, I);
        }
        mesh->bands++;
    }
    mesh->band[mesh->bands] = mesh->runs;
}

/* Determines the kind of each cell of the mesh from its points. Then rebuilds the list of runs (rows of whole cells,
 * which have all points, of one material) and the list of cells with own stiffness (other cells with points) with their
 * stiffness. p: particles; s: elastic constants and partial stresses; dirty[grid.n]: not 0 for the cells whose kind may
 * have changed; NULL: all cells. */
static void cells_sort_out(struct mesh *mesh, const struct particles *p, const struct mesh_source *s,
                           const uint8_t *dirty)
{
    struct mesh_cells_with_own_stiffness old = mesh_cells_with_own_stiffness_detach(mesh);
    if (!dirty) {
#pragma omp parallel for schedule(static)
        for (int64_t I = 0; I < mesh->grid.n; I++) mesh->kind[I] = (uint8_t)cell_kind(mesh, p, s, I);
    } else
        for (int64_t I = next_marked_index(dirty, 0, mesh->grid.n); I < mesh->grid.n;
             I = next_marked_index(dirty, I + 1, mesh->grid.n))
            mesh->kind[I] = (uint8_t)cell_kind(mesh, p, s, I);
    mesh_find_span_of_nodes_with_mass_per_row(mesh);
    cells_list(mesh, p);
    mesh_cells_with_own_stiffness_compute(mesh, p, s, dirty, &old);
}

void mesh_activate_only_node_blocks_next_to_cells(struct mesh *mesh)
{
    struct active_set *set = &mesh->active;
    array_fill_bytes(set->level, 0, set->blocks, 1);
    for (int64_t I = 0; I < mesh->grid.n; I++)
        for (int c = 0; c < 1 << mesh->grid.dim && (mesh->kind[I] == CELL_WHOLE || mesh->kind[I] == CELL_PARTIAL); c++)
            set->level[mesh_block_of_node(mesh, mesh_cell_corner_node(mesh, I, c))] = 1;
    active_set_rebuild_active_block_list(set);
    set->empty = set->blocks - set->active;
}

void mesh_list_cell_runs_and_nodes_with_mass(struct mesh *mesh)
{
    mesh_find_span_of_nodes_with_mass_per_row(mesh);
    cells_list(mesh, NULL);
    mesh_activate_only_node_blocks_next_to_cells(mesh);
}

/* Recomputes the masses of the nodes of the mesh at the corners of coarse cells and of the cells I with dirty[I] (array
 * [grid.n]), from the points of p. The masses of other nodes have not changed, and include no part of a coarse cell. */
static void nodes_weigh(struct mesh *mesh, const struct particles *p, const uint8_t *dirty)
{
    uint8_t *changed = NEW("mesh.changed", mesh->grid.n, uint8_t);
    for (int64_t I = 0; I < mesh->grid.n; I++)
        for (int c = 0; c < 1 << p->dim && (dirty[I] || mesh_cell_is_part_of_coarse_cell(mesh, I)); c++)
            changed[mesh_cell_corner_node(mesh, I, c)] = 1;
#pragma omp parallel for schedule(static)
    for (int64_t I = 0; I < mesh->grid.n; I++)
        if (changed[I]) mesh_node_update_mass(mesh, p, I);
    memory_free(changed);
}

void mesh_rebuild_cells_after_level_change(struct mesh *mesh, const struct particles *p, const struct mesh_source *s,
                                           const uint8_t *level_has_changed)
{
    nodes_weigh(mesh, p, level_has_changed);
    cells_sort_out(mesh, p, s, level_has_changed);
}

/* ---- set-up ------------------------------------------------------------------------------------------------------ */

/* Allocates all arrays of a mesh that covers the box `lower_corner` .. `upper_corner` [m], without points or cells.
 * node_grid: dimension, edge and origin of the nodes; p: particles whose slits divide cells and nodes, NULL if there
 * are no slits; source: slits and voids. Returns FAILED, with a message, if the mesh has too many nodes. */
status mesh_allocate_arrays_for_box(struct mesh *mesh, const struct grid *node_grid, const real *lower_corner,
                                    const real *upper_corner, const struct particles *p,
                                    const struct mesh_source *source)
{
    struct grid *g = &mesh->grid;
    const int dim = node_grid->dim;
    real high[DIM_MAX] = {0};
    bool changed;
    g->dim = dim, g->h = node_grid->h;
    for (int d = 0; d < dim; d++) g->anchor[d] = node_grid->anchor[d], high[d] = upper_corner[d];
    high[0] += LANES * g->h; /* whole vectors are read and written beyond the last cell of a row */
    TRY(grid_extend_box(g, lower_corner, high, INT32_MAX >> dim, &changed));
    for (int c = 0; c < 1 << dim; c++)
        for (int d = 0; d < dim; d++) mesh->corner[c] += (int32_t)((c >> d & 1) * g->stride[d]);
    if (p) TRY(mesh_slits_duplicate_nodes(mesh, p, source, lower_corner, high));
    for (int d = 0; d < dim; d++) mesh->displacement[d] = NEW("mesh.displacement", g->n, real);
    mesh->inverse_mass = NEW("mesh.inverse_mass", g->n, real);
    mesh->kind = NEW("mesh.kind", g->n, uint8_t);
    mesh->rows = g->n / g->count[0];
    mesh->span = NEW("mesh.span", 2 * mesh->rows, int32_t);
    mesh->segments = (g->count[0] + LANES - 2) / LANES + 1;
    active_set_make_with_all_blocks_active(&mesh->active, mesh->rows * mesh->segments);
    mesh_slits_link_node_blocks_to_duplicates(mesh);
    mesh->rounding = scalbn(1.5, ilogb(g->h) - DISPLACEMENT_BITS + DBL_MANT_DIG - 1);
    mesh->band = NEW("mesh.band", g->count[dim - 1] + 2, int64_t);
    return OK;
}

/* Returns true if a cell around node I of the mesh has particles. */
static bool node_filled(const struct mesh *mesh, int64_t I)
{
    bool filled = false;
    for (int c = 0; c < 1 << mesh->grid.dim && !filled; c++)
        filled = I >= mesh->corner[c] && !mesh->absent[I - mesh->corner[c]];
    return filled;
}

/* Marks in mesh->absent the cells of the mesh whose particles were not created (hollow->absent). Lists all other cells
 * in mesh->filled_cell and the nodes of these in mesh->filled_node. */
static void mesh_absent_make(struct mesh *mesh, const struct cells_without_particles *hollow)
{
    mesh->absent = NEW("mesh.absent", mesh->grid.n, uint8_t);
    for (int64_t I = 0; I < hollow->box.n; I++)
        if (hollow->absent[I]) mesh->absent[grid_cell_index_in_other_grid(&hollow->box, I, &mesh->grid)] = 1;
    for (int64_t I = 0; I < mesh->grid.n; I++)
        mesh->filled_cells += !mesh->absent[I], mesh->filled_nodes += node_filled(mesh, I);
    mesh->filled_cell = NEW("mesh.filled_cell", mesh->filled_cells, int32_t);
    mesh->filled_node = NEW("mesh.filled_node", mesh->filled_nodes, int32_t);
    int64_t cells = 0, nodes = 0;
    for (int64_t I = 0; I < mesh->grid.n; I++) {
        if (!mesh->absent[I]) mesh->filled_cell[cells++] = (int32_t)I;
        if (node_filled(mesh, I)) mesh->filled_node[nodes++] = (int32_t)I;
    }
}

/* Makes the nodes of the mesh around all particles of p, aligned with the nodes of the grid `like`, and arrays for the
 * positions of its points. source: slits and voids that divide cells. Returns FAILED, with a message, if there are too
 * many nodes. */
static status nodes_make(struct mesh *mesh, const struct particles *p, const struct grid *like,
                         const struct mesh_source *source)
{
    real from[DIM_MAX], to[DIM_MAX];
    struct grid own = *like;
    own.dim = p->dim;
    for (int d = 0; d < p->dim; d++) particles_coordinate_range(p, p->n, d, &from[d], &to[d]);
    TRY(mesh_allocate_arrays_for_box(mesh, &own, from, to, p, source));
    mesh->point = NEW("mesh.point", mesh->grid.n << p->dim, int32_t);
    for (int64_t k = 0; k < mesh->grid.n << p->dim; k++) mesh->point[k] = -1;
    mesh->place = NEW("mesh.place", p->n, int32_t);
    if (source->hollow && source->hollow->absent) mesh_absent_make(mesh, source->hollow);
    return OK;
}

/* Projects displacement and velocity of the points of p to the nodes of the mesh at the start of a run
 * (mesh_fit_nodal_values_to_point_values). */
static void mesh_nodes_start(struct mesh *mesh, const struct particles *p)
{
    real *u[DIM_MAX];
    for (int d = 0; d < p->dim; d++) {
        u[d] = NEW("mesh.u", p->n, real);
        for (int64_t i = 0; i < p->n; i++) u[d][i] = p->x[d][i] - p->X[d][i];
    }
    mesh_fit_nodal_values_to_point_values(mesh, p, u, mesh->displacement);
    mesh_fit_nodal_values_to_point_values(mesh, p, p->v, mesh->grid.velocity);
    for (int d = 0; d < p->dim; d++) memory_free(u[d]);
}

status mesh_make(struct mesh *mesh, struct particles *p, const struct grid *node_grid, const struct mesh_source *source)
{
    memset(mesh, 0, sizeof *mesh);
    int64_t meshed = 0;
    for (int64_t i = 0; i < p->n; i++) {
        if (p->flag[i] & FLAG_MESHED && p->kind[i] != KIND_MPM) p->flag[i] &= (uint8_t)~FLAG_MESHED;
        meshed += (p->flag[i] & FLAG_MESHED) != 0;
    }
    particles_rebuild_lists_by_kind(p);
    if (meshed == 0) return OK;
    TRY(nodes_make(mesh, p, node_grid, source));
    TRY(points_place(mesh, p));
    TRY(bodies_apart(mesh, p));
#pragma omp parallel for schedule(static)
    for (int64_t I = 0; I < mesh->grid.n; I++) mesh_node_update_mass(mesh, p, I);
    cells_sort_out(mesh, p, source, NULL);
    if (!source->still) mesh_nodes_start(mesh, p);
    return OK;
}

void mesh_free(struct mesh *mesh)
{
    grid_free(&mesh->grid);
    for (int d = 0; d < DIM_MAX; d++) memory_free(mesh->displacement[d]);
    memory_free(mesh->inverse_mass);
    memory_free(mesh->point);
    memory_free(mesh->kind);
    memory_free(mesh->place);
    memory_free(mesh->absent), memory_free(mesh->filled_cell), memory_free(mesh->filled_node);
    memory_free(mesh->band);
    memory_free(mesh->run);
    mesh_cells_with_own_stiffness_free(mesh);
    memory_free(mesh->exposed_list);
    memory_free(mesh->span);
    mesh_slits_free(&mesh->slits);
    memory_free(mesh->material);
    memory_free(mesh->cell_mass);
    memory_free(mesh->matched);
    active_set_free(&mesh->active);
    memset(mesh, 0, sizeof *mesh);
}

/* ---- conversion -------------------------------------------------------------------------------------------------- */

/* Removes particle i of p from the mesh. Returns the kinetic energy of its mass with the velocities of the nodes around
 * it, minus that with the velocity of the particle [J]. */
static real mesh_release(struct mesh *mesh, struct particles *p, int64_t i)
{
    const int64_t place = mesh->place[i];
    real energy = 0;
    for (int d = 0; d < p->dim; d++) {
        for (int c = 0; c < 1 << p->dim; c++)
            energy += 0.5 * p->mass[i] * mesh_shape_function_value(p->dim, c, place & ((1 << p->dim) - 1)) *
                      square(mesh->grid.velocity[d][mesh_cell_corner_node(mesh, place >> p->dim, c)]);
        energy -= 0.5 * p->mass[i] * square(p->v[d][i]);
    }
    mesh->place[i] = -1;
    mesh->point[place] = -1;
    mesh->points--;
    p->flag[i] &= (uint8_t)~FLAG_MESHED;
    return energy;
}

/* Recomputes the masses of the nodes of those cells I of the mesh that particles of p have left, and sets velocity and
 * displacement of nodes without any mass to 0. left[grid.n]: not 0 for these cells. */
static void nodes_lighten(struct mesh *mesh, const struct particles *p, const uint8_t *left)
{
    uint8_t *done = NEW("mesh.done", mesh->grid.n, uint8_t);
    for (int64_t cell = next_marked_index(left, 0, mesh->grid.n); cell < mesh->grid.n;
         cell = next_marked_index(left, cell + 1, mesh->grid.n))
        for (int c = 0; c < 1 << p->dim; c++) {
            const int64_t I = mesh_cell_corner_node(mesh, cell, c);
            if (done[I]) continue;
            done[I] = 1;
            mesh_node_update_mass(mesh, p, I);
            for (int d = 0; d < p->dim && mesh->grid.mass[I] == 0; d++)
                mesh->grid.velocity[d][I] = mesh->displacement[d][I] = 0;
        }
    memory_free(done);
}

real mesh_remove_points_and_return_lost_energy(struct mesh *mesh, struct particles *p, const struct mesh_source *source,
                                               const int32_t *changed_points, int64_t changed_count)
{
    real energy = 0;
    if (!mesh->place) return 0;
    uint8_t *left = mesh_allocate_byte_for_each_cell("mesh.left", mesh),
            *dirty = changed_points ? mesh_allocate_byte_for_each_cell("mesh.dirty", mesh) : NULL;
    for (int64_t k = 0; k < changed_count && changed_points; k++)
        if (mesh->place[changed_points[k]] >= 0) dirty[mesh->place[changed_points[k]] >> p->dim] = 1;
    particles_rebuild_lists_by_kind(p);
    for (int64_t k = 0; k < p->n_of[KIND_PD]; k++) {
        const int32_t i = p->list[KIND_PD][k];
        if (mesh->place[i] < 0) continue;
        left[mesh->place[i] >> p->dim] = 1;
        if (dirty) dirty[mesh->place[i] >> p->dim] = 1;
        energy += mesh_release(mesh, p, i);
    }
    nodes_lighten(mesh, p, left);
    cells_sort_out(mesh, p, source, dirty);
    memory_free(left);
    memory_free(dirty);
    return energy;
}

bool mesh_try_update_stiffness_for_partial_stress(struct mesh *mesh, const struct particles *p,
                                                  const struct mesh_source *source, const int32_t *changed_points,
                                                  int64_t changed_count)
{
    uint8_t *dirty = NEW("mesh.dirty", mesh->grid.n, uint8_t);
    bool same = true;
    for (int64_t k = 0; k < changed_count && same; k++) {
        const int64_t cell = mesh->place[changed_points[k]] >> p->dim;
        if (mesh->place[changed_points[k]] < 0 || dirty[cell]) continue;
        dirty[cell] = 1;
        same = mesh->kind[cell] == CELL_PARTIAL && cell_kind(mesh, p, source, cell) == CELL_PARTIAL;
    }
    if (same) mesh_cells_with_own_stiffness_recompute_marked(mesh, p, source, dirty);
    memory_free(dirty);
    return same;
}

status mesh_save_or_load_node_motion(struct mesh *mesh, struct archive *a)
{
    if (mesh->grid.n == 0) return OK;
    for (int d = 0; d < mesh->grid.dim; d++) {
        char name[48];
        snprintf(name, sizeof name, "mesh/displacement%d", d);
        TRY(a->exchange(a, name, mesh->displacement[d], (size_t)mesh->grid.n * sizeof(real)));
        snprintf(name, sizeof name, "mesh/velocity%d", d);
        TRY(a->exchange(a, name, mesh->grid.velocity[d], (size_t)mesh->grid.n * sizeof(real)));
    }
    return OK;
}
