/* The list of cells with own stiffness of the mesh, the stiffness matrices of all of them (cell_stiffness.c), groups of
 * equal ones, and the shares of their points in PD-MPM bonds. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "cell_stiffness.h"
#include "kernels/mesh/mesh_point.h"

/* ---- points of PD-MPM bonds -------------------------------------------------------------------------------------- */

/* Frees the lists of points with PD-MPM bonds (between peridynamic particles and material points) in the cells of the
 * mesh that have a stiffness matrix of their own. */
static void ends_free(struct mesh *mesh)
{
    memory_free(mesh->ends);
    memory_free(mesh->end);
    memory_free(mesh->end_share);
    mesh->ends = NULL, mesh->end = NULL, mesh->end_share = NULL;
}

/* Computes share[modes]: how much a unit amplitude of each deformation mode of a cell changes the mean strain of the
 * neighbourhood (the neighbours by bonds) of one of its points. c: numbers of modes and components; local: derivative
 * of this mean strain by the strain of the cell at the point (struct partial_stress); place: number of the point in the
 * cell, 0 .. 2^dim - 1; B: strains of the points by the modes, from cell_compute_averaged_strains, or NULL if each
 * point has its own dilatation. */
static void end_share(const struct cell_maker *c, const real *local, int place, point_strains B, real *share)
{
    for (int k = 0; k < c->modes; k++) {
        share[k] = 0;
        for (int s = 0; s < c->columns && B; s++) share[k] += local[s] * B[place][s][k];
        if (B) continue;
        for (int t = 0; t < c->in[k].n; t++) {
            const struct mode_term *term = &c->in[k].at[t];
            const int below = __builtin_popcount((unsigned)(term->set & ~place)); /* coordinates -1/4 */
            share[k] += (below % 2 ? -1 : 1) * term->factor * local[term->row];
        }
    }
}

/* Returns the entry of point i in struct partial_stress if the point has state-based bonds to peridynamic particles,
 * else -1. c: has the partial stresses; i: particle number, or -1 for no point. */
static int64_t end_entry(const struct cell_maker *c, int32_t i)
{
    return i >= 0 && point_has_own_state_based_bonds(c->source->partial, i, c->dim) ? c->source->partial->index[i] : -1;
}

/* Appends the points with state-based PD-MPM bonds in cell with own stiffness number k (a cell with a stiffness matrix
 * of its own) to mesh->end, from index *n on. Stores for each point how much the deformation modes of the cell change
 * the mean strain of its family. Advances *n by the number of these points. c: mesh and bonds. */
static void ends_of_cell(struct mesh *mesh, const struct cell_maker *c, int64_t k, int32_t *n)
{
    const struct partial_stress *partial = c->source->partial;
    point_strains B;
    const bool averaged = cell_compute_averaged_strains(c, mesh->own_stiffness_cell[k], B);
    for (int q = 0; q < 1 << c->dim; q++) {
        const int32_t i = mesh->point[((int64_t)mesh->own_stiffness_cell[k] << c->dim) + q];
        const int64_t entry = end_entry(c, i);
        if (entry < 0) continue;
        mesh->end[*n] = (struct mesh_end){i, (int32_t)(k % LANES)};
        end_share(c, partial->local + entry * c->columns, q, averaged ? B : NULL,
                  mesh->end_share + (int64_t)(*n)++ * c->modes);
    }
}

/* Lists the points with state-based PD-MPM bonds in all cells with own stiffness of the mesh (cells with a stiffness
 * matrix of their own), group by group of LANES such cells. c: has the partial stresses of the points. */
static void mesh_cells_with_own_stiffness_compute_ends(struct mesh *mesh, const struct cell_maker *c)
{
    const struct partial_stress *partial = c->source->partial;
    int32_t n = 0;
    if (!partial || !partial->index || !partial->local) return;
    mesh->ends = NEW("mesh.ends", mesh_count_groups_of_eight_cells_with_own_stiffness(mesh) + 1, int32_t);
    for (int64_t k = 0; k < mesh->own_stiffness_cells; k++)
        for (int q = 0; q < 1 << c->dim; q++)
            n += end_entry(c, mesh->point[((int64_t)mesh->own_stiffness_cell[k] << c->dim) + q]) >= 0;
    mesh->end = NEW("mesh.end", n, struct mesh_end);
    mesh->end_share = NEW("mesh.end_share", (int64_t)n * c->modes, real);
    n = 0;
    for (int64_t k = 0; k < mesh->own_stiffness_cells; k++) {
        ends_of_cell(mesh, c, k, &n);
        mesh->ends[k / LANES + 1] = n;
    }
}

/* ---- all cells with own stiffness -------------------------------------------------------------------------------- */

/* Appends cell I to the list of cells with own stiffness of the mesh: cells with missing points, partial stresses (left
 * to bonds), several materials or doubled nodes. Their stiffness is computed later
 * (mesh_cells_with_own_stiffness_compute).
 */
void mesh_cells_with_own_stiffness_add(struct mesh *mesh, int64_t I)
{
    GROW("mesh.own_stiffness_cell", mesh->own_stiffness_cell, mesh->own_stiffness_cells + 1);
    mesh->own_stiffness_cell[mesh->own_stiffness_cells++] = (int32_t)I;
}

struct mesh_cells_with_own_stiffness mesh_cells_with_own_stiffness_detach(struct mesh *mesh)
{
    const struct mesh_cells_with_own_stiffness old = {mesh->own_stiffness_cells, mesh->own_stiffness_cell,
                                                      mesh->stiffness};
    mesh->own_stiffness_cell = NULL, mesh->stiffness = NULL;
    mesh->own_stiffness_cells = 0;
    mesh_cells_with_own_stiffness_free(mesh);
    return old;
}

void mesh_cells_with_own_stiffness_free(struct mesh *mesh)
{
    memory_free(mesh->own_stiffness_cell);
    memory_free(mesh->stiffness);
    ends_free(mesh);
    memory_free(mesh->alike);
    memory_free(mesh->own_stiffness_force);
    memory_free(mesh->own_stiffness_stressed);
    memory_free(mesh->own_stiffness_material);
    mesh->own_stiffness_cell = NULL, mesh->own_stiffness_force = NULL, mesh->own_stiffness_stressed = NULL,
    mesh->own_stiffness_material = NULL, mesh->alike = NULL;
    mesh->stiffness = NULL;
}

/* Returns the number of the material with the lowest conversion stress among the materials of the points (of p) of cell
 * I of the mesh. s: elastic constants, with these stresses. */
static uint8_t own_stiffness_material(const struct mesh *mesh, const struct particles *p, const struct mesh_source *s,
                                      int64_t I)
{
    int least = -1;
    for (int q = 0; q < 1 << p->dim; q++) {
        const int32_t i = mesh->point[(I << p->dim) + q];
        if (i < 0) continue;
        if (least < 0 || s->elastic[p->material[i]].trigger < s->elastic[least].trigger) least = p->material[i];
    }
    return (uint8_t)least;
}

/* Returns the address of the first number of cell with own stiffness `cell` (with missing or unequal points) in the
 * array `from`. The array has `each` numbers for every cell with own stiffness, such as stiffnesses; those of LANES
 * cells are interleaved. Returns NULL if `from` is NULL. */
static real *lane_of(real *from, int64_t cell, int each)
{
    return from ? from + (cell / LANES * each) * LANES + cell % LANES : NULL;
}

/* Copies the numbers of cells with own stiffness (such as stiffnesses) from the array `old` to group number `group` of
 * LANES cells of the array `to`: those of cell from[l] to lane l. A lane with from[l] < 0 keeps its values. each:
 * numbers per cell; those of LANES cells are interleaved in both arrays, which are read and written in order. */
static void group_copy(real *to, real *old, const int64_t *from, int64_t group, int each)
{
    real *own = to + group * each * LANES;
    const real *source[LANES];
    for (int l = 0; l < LANES; l++) source[l] = from[l] >= 0 ? lane_of(old, from[l], each) : own + l;
    for (int k = 0; k < each * LANES; k += LANES)
        for (int l = 0; l < LANES; l++) own[k + l] = source[l][k];
}

/* Fills up the last group of LANES cells with own stiffness of the mesh (cells with a stiffness matrix of their own) by
 * copies of its first cell. The copies have no stiffness and are not counted. */
static void groups_fill(struct mesh *mesh)
{
    const int64_t whole = mesh_count_groups_of_eight_cells_with_own_stiffness(mesh) * LANES,
                  own_stiffness_cells = mesh->own_stiffness_cells;
    while (mesh->own_stiffness_cells < whole)
        mesh_cells_with_own_stiffness_add(mesh, mesh->own_stiffness_cell[whole - LANES]);
    mesh->own_stiffness_cells = own_stiffness_cells;
}

/* Returns a list with an entry for each cell with own stiffness of the mesh (a cell with a stiffness matrix of its
 * own): the index of the same cell in `old`, the list before a change of cells, from which its stiffness is copied. The
 * entry is -1 if the stiffness must be computed, because the cell is new or marked in `dirty` (NULL: all cells are),
 * and for the lanes that fill the last group of LANES cells. Release the list with memory_free. */
static int64_t *origins(const struct mesh *mesh, const struct mesh_cells_with_own_stiffness *old, const uint8_t *dirty)
{
    int64_t *from = BARE("mesh.from", mesh_count_groups_of_eight_cells_with_own_stiffness(mesh) * LANES, int64_t);
    for (int64_t k = mesh->own_stiffness_cells; k < mesh_count_groups_of_eight_cells_with_own_stiffness(mesh) * LANES;
         k++)
        from[k] = -1;
    for (int64_t k = 0, q = 0; k < mesh->own_stiffness_cells; k++) {
        while (q < old->own_stiffness_cells && old->own_stiffness_cell[q] < mesh->own_stiffness_cell[k]) q++;
        from[k] = dirty && q < old->own_stiffness_cells && old->own_stiffness_cell[q] == mesh->own_stiffness_cell[k] &&
                          !dirty[mesh->own_stiffness_cell[k]]
                      ? q
                      : -1;
    }
    return from;
}

/* Returns an array of `each` numbers for every cell with own stiffness of `mesh` (a cell with a stiffness matrix of its
 * own), interleaved in groups of LANES cells. The numbers of the last group are 0, others are uninitialised. label:
 * name of the array. Release it with memory_free. */
static real *numbers_make(const char *label, const struct mesh *mesh, int64_t each)
{
    const int64_t groups = mesh_count_groups_of_eight_cells_with_own_stiffness(mesh), size = each * LANES;
    real *numbers = memory_new_uninitialised(label, groups * size, sizeof *numbers);
    if (groups > 0) array_fill_bytes(numbers + (groups - 1) * size, 0, size, sizeof *numbers);
    return numbers;
}

/* Returns true if two groups g and h of LANES cells with own stiffness (cells with a stiffness matrix of their own)
 * have bitwise equal numbers in the array `of`, such as stiffnesses. each: numbers per cell. */
static bool numbers_alike(const real *of, int64_t g, int64_t h, int each)
{
    const int64_t size = (int64_t)each * LANES;
    return arrays_equal(of + g * size, of + h * size, size, sizeof *of);
}

/* Finds groups of LANES cells with own stiffness (cells with a stiffness matrix of their own) that can share one
 * stiffness. mesh->alike[g] receives the first of the groups directly before group g with bitwise equal stiffness, or g
 * itself if there is none. Such groups are frequent, as cells that an edge of the body cuts in the same way are
 * consecutive. modes: number of deformation modes of a cell. */
static void alike_find(struct mesh *mesh, int modes)
{
    const int64_t groups = mesh_count_groups_of_eight_cells_with_own_stiffness(mesh);
    const int half = modes * (modes + 1) / 2;
    mesh->alike = NEW("mesh.alike", groups, int32_t);
    for (int64_t g = 0; g < groups; g++) {
        const int32_t before = g > 0 ? mesh->alike[g - 1] : 0;
        mesh->alike[g] = numbers_alike(mesh->stiffness, before, g, half) ? before : (int32_t)g;
    }
}

void mesh_cells_with_own_stiffness_compute(struct mesh *mesh, const struct particles *p, const struct mesh_source *s,
                                           const uint8_t *cell_needs_update,
                                           struct mesh_cells_with_own_stiffness *previous_cells)
{
    struct cell_maker c = cell_maker_make(mesh, p, s);
    const int half = c.modes * (c.modes + 1) / 2, unknowns = (1 << c.dim) * c.dim;
    const int64_t groups = mesh_count_groups_of_eight_cells_with_own_stiffness(mesh);
    groups_fill(mesh);
    mesh->stiffness = numbers_make("mesh.stiffness", mesh, half);
    mesh->own_stiffness_force = BARE("mesh.own_stiffness_force", groups * unknowns * LANES, real);
    mesh->own_stiffness_stressed = NEW("mesh.own_stiffness_stressed", groups * LANES, bool);
    mesh->own_stiffness_material = NEW("mesh.own_stiffness_material", groups * LANES, uint8_t);
    for (int64_t k = 0; k < groups * LANES; k++)
        mesh->own_stiffness_material[k] = own_stiffness_material(mesh, p, s, mesh->own_stiffness_cell[k]);
    int64_t *from = origins(mesh, previous_cells, cell_needs_update);
#pragma omp parallel for schedule(dynamic, 2)
    for (int64_t g = 0; g < groups; g++) {
        group_copy(mesh->stiffness, previous_cells->stiffness, from + g * LANES, g, half);
        for (int64_t k = g * LANES; k < (g + 1) * LANES && k < mesh->own_stiffness_cells; k++)
            if (from[k] < 0)
                cell_compute_own_stiffness(&c, mesh->own_stiffness_cell[k], lane_of(mesh->stiffness, k, half));
    }
    alike_find(mesh, c.modes);
    mesh_slits_store_corner_nodes_of_adjacent_cells(mesh);
    mesh_cells_with_own_stiffness_compute_ends(mesh, &c);
    memory_free(from);
    memory_free(c.whole);
    memory_free(previous_cells->own_stiffness_cell);
    memory_free(previous_cells->stiffness);
}

/* Ends the sharing of stiffness by groups of LANES cells with own stiffness (missing or unequal points) of which one
 * has changed. Sets mesh->alike[g] = g for each group g with changed[g], and for each group that uses the stiffness of
 * such a group. changed: [groups]. */
static void alike_part(struct mesh *mesh, const uint8_t *changed)
{
    for (int64_t g = mesh_count_groups_of_eight_cells_with_own_stiffness(mesh) - 1; g >= 0; g--)
        if (changed[g] || changed[mesh->alike[g]]) mesh->alike[g] = (int32_t)g;
}

void mesh_cells_with_own_stiffness_recompute_marked(struct mesh *mesh, const struct particles *p,
                                                    const struct mesh_source *s, const uint8_t *cell_is_marked)
{
    struct cell_maker c = cell_maker_make(mesh, p, s);
    const int half = c.modes * (c.modes + 1) / 2;
    uint8_t *changed = NEW("mesh.changed", mesh_count_groups_of_eight_cells_with_own_stiffness(mesh), uint8_t);
    for (int64_t k = 0; k < mesh->own_stiffness_cells; k++)
        changed[k / LANES] |= cell_is_marked[mesh->own_stiffness_cell[k]];
    alike_part(mesh, changed);
    memory_free(changed);
#pragma omp parallel for schedule(dynamic, 16)
    for (int64_t k = 0; k < mesh->own_stiffness_cells; k++)
        if (cell_is_marked[mesh->own_stiffness_cell[k]])
            cell_compute_own_stiffness(&c, mesh->own_stiffness_cell[k], lane_of(mesh->stiffness, k, half));
    ends_free(mesh);
    mesh_cells_with_own_stiffness_compute_ends(mesh, &c);
    memory_free(c.whole);
}
