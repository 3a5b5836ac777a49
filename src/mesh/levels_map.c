/* Computes admissible coarsening levels of cells from flags on the cells of level 0 (the finest), such that levels of
 * adjacent cells differ by at most one. */
#include <string.h>

#include "base/memory.h"
#include "levels_parts.h"

/* Data of all cells of one coarsening level (edge of 2^level finest cells) while admissible levels are computed. Each
 * array has one entry per node of the grid of the level, by the lowest node of a cell. */
struct level_map {
    uint8_t *ok;               /* a cell of this level, or a part of a coarser one, is admissible */
    uint8_t *some;             /* contains a cell of level 0 with points */
    uint8_t *limit, *material; /* of its parts: smallest limit; material */
};

static struct level_map level_map_make(int64_t n)
{
    uint8_t *base = NEW("levels.map", 4 * n, uint8_t);
    return (struct level_map){base, base + n, base + 2 * n, base + 3 * n};
}

/* Initialises *to, the data of the cells of level 0 (the finest) of l: which cells may become parts of coarser cells,
 * and up to which level. Only cells with all of their points (particles of p, of one material) may. demand[cell]: not 0
 * for cells that must remain at level 0; limit[cell]: highest level of each cell, NULL: no limit. */
static void base_map(struct level_map *to, const struct mesh_levels *l, const struct particles *p,
                     const uint8_t *demand, const uint8_t *limit)
{
    const struct mesh *fine = l->fine;
    for (int64_t I = 0; I < fine->grid.n; I++) {
        const bool whole = fine->kind[I] == CELL_WHOLE || fine->kind[I] == CELL_COARSE;
        to->some[I] = fine->kind[I] != CELL_EMPTY;
        to->ok[I] = whole && !demand[I];
        to->limit[I] = limit ? limit[I] : (uint8_t)l->n;
        to->material[I] = whole ? mesh_material_of_filled_cell(fine, p, I) : 0;
    }
}

/* Sets the entries of map[level] for cell I of `level` of l (cells with the edge of 2^level finest cells) from those of
 * the 2^dim cells of the next finer level in it. The cell is admissible if all of these are, have one material, and may
 * have this level. k[dim]: indices of the cell along the axes. */
static void gather_parts(struct level_map *map, const struct mesh_levels *l, int level, int64_t I, const int64_t *k)
{
    const struct grid *below = &mesh_levels_mesh_of_level_read_only(l, level - 1)->grid;
    const struct level_map *from = &map[level - 1];
    struct level_map *to = &map[level];
    to->ok[I] = 1, to->some[I] = 0, to->limit[I] = UINT8_MAX;
    for (int c = 0; c < 1 << below->dim; c++) {
        int64_t J = 0;
        for (int d = 0; d < below->dim; d++)
            J += (2 * (k[d] - l->offset[level][d]) + (c >> d & 1) + l->offset[level - 1][d]) * below->stride[d];
        if (c == 0) to->material[I] = from->material[J];
        to->ok[I] &= from->ok[J] && from->material[J] == to->material[I];
        to->some[I] |= from->some[J];
        if (from->limit[J] < to->limit[I]) to->limit[I] = from->limit[J];
    }
    to->ok[I] &= to->limit[I] >= level;
}

/* Returns true if the cells of level 0 (the finest) that touch a block of 2^dim cells from outside, on one side, edge
 * or corner of it, all contain points, or if none does. Otherwise a node at the end of an edge of the coarse cell would
 * have no finer node. map: which cells have points; first: indices of the lower corner of the block in g, the grid of
 * level 0; beside: direction of this side, edge or corner, -1, 0 or 1 along each axis. */
static bool touching_alike(const struct level_map *map, const struct grid *g, const int64_t *first, const int *beside)
{
    int some = 0, all = 0;
    for (int c = 0; c < 1 << g->dim; c++) {
        int64_t J = 0;
        bool touches = true;
        for (int d = 0; d < g->dim; d++) {
            const int upper = c >> d & 1;
            touches = touches && (beside[d] == 0 || upper == (beside[d] < 0));
            J += (first[d] + 2 * beside[d] + upper) * g->stride[d];
        }
        if (touches) all++, some += map[0].some[J];
    }
    return some == 0 || some == all;
}

/* Returns true if a cell of level 1 of l, with the indices k[dim], may exist beside its neighbours: in each direction,
 * the cells of level 0 (the finest) that touch it all contain points, or none does. map: maps of all levels. */
static bool ring_of_first(const struct level_map *map, const struct mesh_levels *l, const int64_t *k)
{
    const struct grid *g = &l->fine->grid;
    const int around = g->dim == 1 ? 3 : g->dim == 2 ? 9 : 27;
    int64_t first[DIM_MAX];
    bool allows = true;
    for (int d = 0; d < g->dim; d++) first[d] = 2 * (k[d] - l->offset[1][d]) + l->offset[0][d];
    for (int q = 0; q < around && allows; q++) {
        int beside[DIM_MAX];
        for (int d = 0, left = q; d < DIM_MAX; d++, left /= 3) beside[d] = d < g->dim ? left % 3 - 1 : 0;
        allows = touching_alike(map, g, first, beside);
    }
    return allows;
}

/* Returns true if a cell of `level` >= 2 of l (cells with the edge of 2^level finest cells), with the indices k[dim],
 * may exist beside its neighbours: all cells of the next finer level in it and around it that contain points must be
 * admissible. Adjacent cells then differ by one level at most. map: maps of all levels. */
static bool ring_allows(const struct level_map *map, const struct mesh_levels *l, int level, const int64_t *k)
{
    const int on = level - 1;
    const struct grid *g = &mesh_levels_mesh_of_level_read_only(l, on)->grid;
    const int around = g->dim == 1 ? 4 : g->dim == 2 ? 16 : 64;
    for (int q = 0; q < around; q++) {
        int64_t J = 0;
        for (int d = 0; d < g->dim; d++)
            J += (2 * (k[d] - l->offset[level][d]) + l->offset[on][d] + (q >> 2 * d & 3) - 1) * g->stride[d];
        if (map[on].some[J] && !map[on].ok[J]) return false;
    }
    return true;
}

/* Determines for each cell of `level` of l (cells with the edge of 2^level finest cells) whether it is admissible, in
 * map[level], from map[level - 1]. */
static void level_map_find(struct level_map *map, const struct mesh_levels *l, int level)
{
    const struct grid *g = &mesh_levels_mesh_of_level_read_only(l, level)->grid;
    int64_t k[DIM_MAX] = {0}, q[DIM_MAX] = {0};
    uint8_t *good = NEW("levels.good", g->n, uint8_t);
    bool *inside = NEW("levels.inside", g->n, bool);
    for (int64_t I = 0; I < l->fine->grid.n; I++, grid_advance_to_next_node_indices(&l->fine->grid, k))
        if (l->fine->kind[I] != CELL_EMPTY) inside[mesh_levels_coarse_cell_of_fine_cell(l, level, k, NULL)] = true;
    for (int64_t I = 0; I < g->n; I++, grid_advance_to_next_node_indices(g, q))
        if (inside[I]) gather_parts(map, l, level, I, q);
    for (int64_t I = 0; I < g->n; I++, grid_advance_to_next_node_indices(g, q))
        good[I] = map[level].ok[I] && (level > 1 ? ring_allows(map, l, level, q) : ring_of_first(map, l, q));
    array_copy(map[level].ok, good, g->n, 1);
    memory_free(good);
    memory_free(inside);
}

void mesh_levels_compute_coarsest_admissible_levels(const struct mesh_levels *l, const struct particles *p,
                                                    const uint8_t *finest_required, const uint8_t *highest_level,
                                                    uint8_t *admissible)
{
    struct level_map map[LEVELS_MAX + 1];
    int64_t k[DIM_MAX] = {0};
    for (int level = 0; level <= l->n; level++)
        map[level] = level_map_make(mesh_levels_mesh_of_level_read_only(l, level)->grid.n);
    base_map(&map[0], l, p, finest_required, highest_level);
    for (int level = 1; level <= l->n; level++) level_map_find(map, l, level);
    for (int64_t I = 0; I < l->fine->grid.n; I++, grid_advance_to_next_node_indices(&l->fine->grid, k)) {
        admissible[I] = 0;
        while (map[0].ok[I] && admissible[I] < l->n &&
               map[admissible[I] + 1].ok[mesh_levels_coarse_cell_of_fine_cell(l, admissible[I] + 1, k, NULL)])
            admissible[I]++;
    }
    for (int level = 0; level <= l->n; level++) memory_free(map[level].ok);
}

bool mesh_levels_coarse_cells_are_consistent_and_filled(const struct mesh_levels *l)
{
    const struct grid *g = &l->fine->grid;
    int64_t k[DIM_MAX] = {0}, covered = 0, coarse = 0;
    bool sound = true;
    for (int64_t I = 0; I < g->n && sound; I++, grid_advance_to_next_node_indices(g, k)) {
        const int level = l->level[I];
        coarse += level > 0;
        sound = level <= l->n && (level > 0 || !l->fine->absent || !l->fine->absent[I]);
        if (level == 0 || !sound || !mesh_levels_fine_cell_is_lowest_in_coarse_cell(l, level, k)) continue;
        for (int part = 0; part < mesh_levels_fine_cells_per_coarse_cell(l, level) && sound; part++, covered++) {
            const int64_t J = mesh_levels_nth_fine_cell_in_coarse_cell(l, level, I, part);
            sound = J < g->n && l->level[J] == level &&
                    (l->fine->kind[J] == CELL_WHOLE || (l->fine->absent && l->fine->absent[J]));
        }
    }
    return sound && covered == coarse;
}

/* Sets bit 1 of `mark` for the cells within `reach` cells of a cell that has bit 0 set. The cells are n cells on one
 * line, and their entries in `mark` are `stride` apart. */
static void line_dilate(uint8_t *mark, int64_t n, int64_t stride, int reach)
{
    int64_t last = -reach - 1;
    for (int64_t k = 0; k < n; k++) { /* bit 1: reached from below */
        if (mark[k * stride] & 1) last = k;
        if (k - last <= reach) mark[k * stride] |= 2;
    }
    last = n + reach + 1;
    for (int64_t k = n - 1; k >= 0; k--) {
        if (mark[k * stride] & 1) last = k;
        mark[k * stride] = last - k <= reach || mark[k * stride] & 2;
    }
}

void grid_mark_cells_near_marked_cells(const struct grid *g, uint8_t *cell_is_marked, int reach_in_cells)
{
    for (int d = 0; d < g->dim; d++) { /* lines start in blocks of one stride, separated by the length of a line */
        const int64_t stride = g->stride[d], lines = g->n / g->count[d];
#pragma omp parallel for schedule(static)
        for (int64_t k = 0; k < lines; k++)
            line_dilate(cell_is_marked + k / stride * stride * g->count[d] + k % stride, g->count[d], stride,
                        reach_in_cells);
    }
}

void mesh_levels_mark_cells_near_marked_cells(const struct mesh_levels *l, uint8_t *cell_is_marked, int reach_in_cells)
{
    grid_mark_cells_near_marked_cells(&l->fine->grid, cell_is_marked, reach_in_cells);
}

void mesh_levels_extend_marks_to_whole_coarse_cells(const struct mesh_levels *l, const uint8_t *cell_level,
                                                    uint8_t *cell_is_marked)
{
    const struct grid *g = &l->fine->grid;
    int64_t k[DIM_MAX] = {0};
    for (int64_t I = 0; I < g->n; I++, grid_advance_to_next_node_indices(g, k)) {
        const int parts = cell_level[I] > 0 && mesh_levels_fine_cell_is_lowest_in_coarse_cell(l, cell_level[I], k)
                              ? mesh_levels_fine_cells_per_coarse_cell(l, cell_level[I])
                              : 0;
        bool any = false;
        for (int part = 0; part < parts && !any; part++)
            any = cell_is_marked[mesh_levels_nth_fine_cell_in_coarse_cell(l, cell_level[I], I, part)] != 0;
        for (int part = 0; part < parts && any; part++)
            cell_is_marked[mesh_levels_nth_fine_cell_in_coarse_cell(l, cell_level[I], I, part)] = 1;
    }
}

void mesh_levels_set_conversion_and_refine_distances(struct mesh_levels *l, int conversion_delay_distance,
                                                     int refine_distance)
{
    l->safe_cells = conversion_delay_distance, l->roomy_cells = refine_distance;
    mesh_levels_classify_cells_by_distance_to_coarse(l);
}

void mesh_levels_classify_cells_by_distance_to_coarse(struct mesh_levels *l)
{
    const int64_t n = l->fine->grid.n;
    uint8_t *near = NEW("levels.near", n, uint8_t);
    for (int64_t I = 0; I < n; I++) l->safe[I] = near[I] = l->level[I] > 0;
    mesh_levels_mark_cells_near_marked_cells(l, l->safe, l->safe_cells);
    mesh_levels_mark_cells_near_marked_cells(l, near, l->roomy_cells);
    for (int64_t I = 0; I < n; I++)
        l->safe[I] = l->safe[I] ? DISTANCE_UNSAFE : near[I] ? DISTANCE_SAFE : DISTANCE_ROOMY;
    memory_free(near);
}
