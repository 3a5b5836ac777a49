/* Marks the material points and cells of a mesh whose stress requires conversion to peridynamic particles. Upper bounds
 * of the stress, computed for eight cells at a time, select the cells whose points are then examined one by one. Point
 * number q of a cell is the point next to corner q. */
#include "mesh_own_stiffness.h"
#include "mesh_point.h"
#include "mesh_run.h"

/* Sets FLAG_STRESSED in p for those points of cell I whose stress, by Hooke's law, exceeds that of conversion to
 * peridynamic particles (stress_requires_conversion_to_pd). m: elastic constants; finite: true for finite strain. */
static ALWAYS_INLINE void cell_points_mark(const struct mesh *mesh, struct particles *p, const struct elastic *m,
                                           int64_t I, const int dim, bool finite)
{
    real R[9], e[CORNERS_MAX][DIM_MAX * DIM_MAX], s[SYM_MAX];
    mesh_compute_strains_at_points(mesh, I, R, e, dim, finite);
    mesh_replace_dilatation_in_strains_by_cell_mean(mesh, p, m, I, e, dim);
    for (int q = 0; q < 1 << dim; q++) {
        const int32_t i = mesh->point[(I << dim) + q];
        if (i < 0) continue;
        const struct elastic *own = &m[p->material[i]];
        point_hooke_stress(own, e[q], s, dim);
        if (stress_requires_conversion_to_pd(own, p, i, s, dim)) p->flag[i] |= FLAG_STRESSED;
    }
}

#define CELL_MARK(D)                                                                                                   \
    static NEVER_INLINE void cell_mark_##D(const struct mesh *mesh, struct particles *p, const struct elastic *m,      \
                                           int64_t I, bool finite)                                                     \
    {                                                                                                                  \
        cell_points_mark(mesh, p, m, I, D, finite);                                                                    \
    }
DIMENSIONS(CELL_MARK)

/* Sets FLAG_STRESSED in p for points of cell I whose stress exceeds that of conversion to peridynamic particles: calls
 * the version of cell_points_mark for `dim` dimensions, which is not inlined. m: elastic constants; finite: true for
 * finite strain. */
static ALWAYS_INLINE void cell_mark(const struct mesh *mesh, struct particles *p, const struct elastic *m, int64_t I,
                                    const int dim, bool finite)
{
    if (dim == 1)
        cell_mark_1(mesh, p, m, I, finite);
    else if (dim == 2)
        cell_mark_2(mesh, p, m, I, finite);
    else
        cell_mark_3(mesh, p, m, I, finite);
}

/* Returns upper bounds of the principal stresses at the points of eight cells [Pa], closer than those of mesh_force:
 * the largest row sum of absolute stresses or, with a strength surface, cell_drucker_prager_stress_upper_bound. m:
 * elastic constants; cell: strain of the cells; there[q]: mask of the cells that have point number q; NULL: all points.
 */
static ALWAYS_INLINE lanes places_tension(const struct elastic *m, const struct mesh_cell *cell,
                                          const lanes_mask *there, const int dim)
{
    lanes most = lanes_broadcast(-INFINITY), e[3][3], P[3][3];
    SETS for (int q = 0; q < 1 << dim; q++)
    {
        cells_compute_strain_at_point(cell, q, e, dim);
        if (!there) cells_replace_dilatation_by_cell_mean(m, cell, e, dim);
        hooke_stress(m, e, P, dim);
        lanes bound = P[0][0];
        for (int a = 1; a < dim; a++) bound = lanes_max(bound, P[a][a]);
        for (int a = 0; a < dim; a++)
            for (int b = 0; b < a; b++) bound += lanes_max(P[a][b], -P[a][b]);
        if (dim > 1 && m->surface.g0 > 0)
            bound = lanes_max(bound, cell_drucker_prager_stress_upper_bound(m, P, lanes_broadcast(0), dim));
        most = lanes_max(most, there ? lanes_choose(there[q], bound, most) : bound);
    }
    return most;
}

#define TENSION(D)                                                                                                     \
    static NEVER_INLINE lanes cells_tension_##D(const struct elastic *m, const struct mesh_cell *s,                    \
                                                const lanes_mask *there)                                               \
    {                                                                                                                  \
        return places_tension(m, s, there, D);                                                                         \
    }
DIMENSIONS(TENSION)

/* Returns the upper bounds of places_tension for the principal stresses in eight cells [Pa]: calls its version for
 * `dim` dimensions, which is not inlined. m: elastic constants; cell: strain of the cells; there[q]: mask of the cells
 * that have point number q, NULL if all have it. */
static ALWAYS_INLINE lanes cells_tension(const struct elastic *m, const struct mesh_cell *cell, const lanes_mask *there,
                                         const int dim)
{
    return dim == 1   ? cells_tension_1(m, cell, there)
           : dim == 2 ? cells_tension_2(m, cell, there)
                      : cells_tension_3(m, cell, there);
}

/* Returns true if cell I has a point whose material is not number `material`; p: the particles. */
static ALWAYS_INLINE bool cell_mixed(const struct mesh *mesh, const struct particles *p, int64_t I, uint8_t material,
                                     const int dim)
{
    for (int q = 0; q < 1 << dim; q++) {
        const int32_t i = mesh->point[(I << dim) + q];
        if (i >= 0 && p->material[i] != material) return true;
    }
    return false;
}

/* Returns for the cells k to k + 7 of the row of cells `run` an upper bound of the principal stresses at their points
 * [Pa] (places_tension). m: elastic constants of their material; finite: true for finite strain. */
static ALWAYS_INLINE lanes run_tension(const struct mesh *mesh, const struct elastic *m,
                                       const struct mesh_cell_run *run, int64_t k, const int dim, const bool finite)
{
    struct mesh_cell s;
    lanes u[CORNERS_MAX][3];
    mesh_cell_run_load_corner_displacements(mesh, run, k, u, dim);
    cell_compute_rotation_strain_and_modes(&s, mesh->grid.h, u, dim, finite && dim > 1);
    return cells_tension(m, &s, NULL, dim);
}

/* Sets FLAG_STRESSED in p for points in `run`, a row of consecutive cells, whose principal stress exceeds the stress
 * of conversion to peridynamics; skips cells where its upper bound does not. m: constants of all materials. */
static ALWAYS_INLINE void run_mark(const struct mesh *mesh, struct particles *p, const struct elastic *m,
                                   const struct mesh_cell_run *run, const int dim, const bool finite)
{
    const struct elastic *own = &m[run->material];
    for (int64_t k = 0; k < run->cells; k += LANES) {
        const lanes tension = run_tension(mesh, own, run, k, dim, finite);
        for (int64_t l = 0; l < LANES && l < run->cells - k; l++)
            if (tension[l] > own->trigger) cell_mark(mesh, p, m, run->cell + k + l, dim, finite);
    }
}

/* Sets mark[cell] = 1 for the cells of `run`, a row of consecutive cells, in which the principal stress at a point may
 * exceed `share` [1] times the stress of conversion to peridynamics. m: elastic constants; finite: true for finite
 * strain. */
static ALWAYS_INLINE void run_mark_cells(const struct mesh *mesh, const struct elastic *m,
                                         const struct mesh_cell_run *run, real share, uint8_t *mark, const int dim,
                                         const bool finite)
{
    const struct elastic *own = &m[run->material];
    for (int64_t k = 0; k < run->cells; k += LANES) {
        const lanes tension = run_tension(mesh, own, run, k, dim, finite);
        for (int64_t l = 0; l < LANES && l < run->cells - k; l++)
            if (tension[l] > share * own->trigger) mark[run->cell + k + l] = 1;
    }
}

/* Sets FLAG_STRESSED in p for points in eight cells with own stiffness (with missing points or several materials) above
 * the stress of conversion to peridynamics. Skips cells where the upper bound places_tension, valid for one material
 * without mean dilatation, is below. group: number of the eight cells, from 0; m: constants of all materials. */
static ALWAYS_INLINE void group_mark(const struct mesh *mesh, struct particles *p, const struct elastic *m,
                                     int64_t group, const int dim, const bool finite)
{
    const int64_t first = group * LANES;
    struct mesh_cell s;
    lanes u[CORNERS_MAX][3], tension = lanes_broadcast(0);
    lanes_mask there[CORNERS_MAX] = {{0}};
    for (int q = 0; q < 1 << dim; q++)
        for (int l = 0; l < LANES; l++)
            there[q][l] = -(int64_t)(mesh->point[((int64_t)mesh->own_stiffness_cell[first + l] << dim) + q] >= 0);
    mesh_cells_with_own_stiffness_gather_displacements(mesh, group, u, dim);
    cell_compute_rotation_strain_and_modes(&s, mesh->grid.h, u, dim, finite && dim > 1);
    for (int64_t k = first; k < first + LANES && k < mesh->own_stiffness_cells; k++) {
        const uint8_t material = mesh->own_stiffness_material[k];
        if (k == first || material != mesh->own_stiffness_material[k - 1])
            tension = cells_tension(&m[material], &s, there, dim);
        if (mesh->own_stiffness_stressed[k] &&
            (tension[k - first] > m[material].trigger || m[material].mean_dilatation ||
             cell_mixed(mesh, p, mesh->own_stiffness_cell[k], material, dim)))
            cell_mark(mesh, p, m, mesh->own_stiffness_cell[k], dim, finite);
    }
}

/* Returns true if mesh_force has marked one of eight cells with own stiffness (with missing points, partial stresses or
 * several materials) as one in which a stress may exceed the conversion stress. group: number of the eight cells, from
 * 0. */
static inline bool group_stressed(const struct mesh *mesh, int64_t group)
{
    bool any = false;
    for (int l = 0; l < LANES; l++) any |= mesh->own_stiffness_stressed[group * LANES + l];
    return any;
}

#define MARK(D, FINITE)                                                                                                \
    static void cells_mark_##D##_##FINITE(const struct mesh *mesh, struct particles *p, const struct elastic *m)       \
    {                                                                                                                  \
        for (int64_t k = 0; k < mesh_count_groups_of_eight_cells_with_own_stiffness(mesh); k++)                        \
            if (group_stressed(mesh, k)) group_mark(mesh, p, m, k, D, FINITE);                                         \
        for (int64_t r = 0; r < mesh->runs; r++)                                                                       \
            if (mesh->run[r].stressed) run_mark(mesh, p, m, &mesh->run[r], D, FINITE);                                 \
    }                                                                                                                  \
    static void cells_mark_only_##D##_##FINITE(const struct mesh *mesh, const struct elastic *m, real share, bool all, \
                                               uint8_t *mark)                                                          \
    {                                                                                                                  \
        for (int64_t r = 0; r < mesh->runs; r++)                                                                       \
            if (all || mesh->run[r].stressed) run_mark_cells(mesh, m, &mesh->run[r], share, mark, D, FINITE);          \
    }
MARK(1, false)
MARK(2, false)
MARK(2, true)
MARK(3, false)
MARK(3, true)

void mesh_points_mark(const struct mesh *mesh, struct particles *p, const struct elastic *m, bool finite)
{
    if (p->dim == 1)
        cells_mark_1_false(mesh, p, m);
    else if (p->dim == 2)
        (finite ? cells_mark_2_true : cells_mark_2_false)(mesh, p, m);
    else
        (finite ? cells_mark_3_true : cells_mark_3_false)(mesh, p, m);
}

void mesh_cells_mark(const struct mesh *mesh, const struct elastic *m, real share, bool all, uint8_t *mark, bool finite)
{
    if (mesh->grid.dim == 1)
        cells_mark_only_1_false(mesh, m, share, all, mark);
    else if (mesh->grid.dim == 2)
        (finite ? cells_mark_only_2_true : cells_mark_only_2_false)(mesh, m, share, all, mark);
    else
        (finite ? cells_mark_only_3_true : cells_mark_only_3_false)(mesh, m, share, all, mark);
}
