/* Internal forces of the mesh on its nodes. Whole cells (all points, one material) are computed in rows of consecutive
 * cells (struct mesh_cell_run), eight at a time; cells with own stiffness have stiffnesses of their own.
 *
 * Rows of cells that add to common nodes must not be computed at the same time: layers of cells are grouped in bands,
 * and bands of equal parity share no node. First even, then odd bands are computed in parallel, which gives equal bits
 * on any number of threads. */
#include <string.h>

#include "mesh_flow.h"
#include "mesh_own_stiffness.h"
#include "mesh_run.h"

/* ---- whole cells ------------------------------------------------------------------------------------------------- */

/* Defines cells_flow_1, _2 and _3, which call cells_compute_stress_by_return_mapping for dimension D. The functions are
 * not inlined, because return mapping point by point (mesh_flow.h) would use registers that the code for elastic cells
 * needs. */
#define FLOW(D)                                                                                                        \
    static NEVER_INLINE void cells_flow_##D(const struct mesh *mesh, const struct particles *p,                        \
                                            const struct elastic *m, const int32_t *cell, struct mesh_cell *s)         \
    {                                                                                                                  \
        cells_compute_stress_by_return_mapping(mesh, p, m, cell, s, D);                                                \
    }
FLOW(1)
FLOW(2)
FLOW(3)

/* Computes by return mapping the stress of eight cells of the mesh whose points yield, and updates the plastic state
 * of the points in p. cell: eight cell indices, -1 for a lane without cell; m: elastic constants of all materials. s:
 * on entry the strain of the cells (s->e, s->mode); receives the stress of the mean strain (s->P) and the forces on
 * the bending modes (s->force). */
static ALWAYS_INLINE void cells_flow_of(const struct mesh *mesh, const struct particles *p, const struct elastic *m,
                                        const int32_t *cell, struct mesh_cell *s, const int dim)
{
    (dim == 1 ? cells_flow_1 : dim == 2 ? cells_flow_2 : cells_flow_3)(mesh, p, m, cell, s);
}

/* Arguments of run_flow_cells: elastic constants of all materials, and whether strains are finite. */
struct run_flow {
    const struct mesh *mesh;
    const struct particles *p;
    const struct elastic *elastic;
    bool finite;
};

/* Computes the forces of eight cells whose points yield [N], and updates the plastic state of the points in p. The
 * cells are number k to k + 7 in `run`, a row of consecutive cells along x. u[c][i]: displacement of corner c along
 * axis i [m]; f[c][i]: receives the force on corner c along axis i. */
static ALWAYS_INLINE void run_flow_cells(const struct run_flow *a, const struct mesh_cell_run *run, int64_t k,
                                         lanes u[CORNERS_MAX][3], lanes f[CORNERS_MAX][3], const int dim)
{
    const bool rotates = a->finite && dim > 1;
    const struct mesh *mesh = a->mesh;
    struct mesh_cell s;
    int32_t cell[LANES];
    cell_compute_rotation_strain_and_modes(&s, mesh->grid.h, u, dim, rotates);
    mesh_cell_run_get_indices_of_eight_cells(run, k, cell);
    cells_flow_of(mesh, a->p, a->elastic, cell, &s, dim);
    if (rotates) cell_add_skew_stress_balancing_moment_finite_strain(&s, (lanes[3]){{0}}, dim);
    cell_compute_corner_forces(&s, mesh->grid.h, mesh->volume * (1 << dim), f, dim, rotates);
}

/* Defines functions that add nodal forces of cells, for dimension D and strain measure FINITE (true: finite strain): of
 * one row of cells that yield, of all rows of one band (a group of layers of cells), and of all bands. Rows that yield
 * have a function of their own, since their code would use vector registers that elastic rows need. The parallel region
 * is inside, so that D and FINITE are compile-time constants in it. */
#define BANDS(D, FINITE)                                                                                               \
    static void run_flow_cells_##D##_##FINITE(void *context, const struct mesh_cell_run *run, int64_t k,               \
                                              lanes u[CORNERS_MAX][3], lanes f[CORNERS_MAX][3])                        \
    {                                                                                                                  \
        run_flow_cells(context, run, k, u, f, D);                                                                      \
    }                                                                                                                  \
    static NEVER_INLINE void run_flow_##D##_##FINITE(const struct mesh *mesh, const struct particles *p,               \
                                                     struct mesh_cell_run *run, const struct elastic *m)               \
    {                                                                                                                  \
        struct run_flow a = {mesh, p, m, FINITE};                                                                      \
        mesh_cell_run_add_forces(mesh, run, run_flow_cells_##D##_##FINITE, &a, D);                                     \
        run->stressed = false;                                                                                         \
    }                                                                                                                  \
    static NEVER_INLINE void band_force_##D##_##FINITE(const struct mesh *mesh, const struct particles *p,             \
                                                       int64_t band, const struct elastic *m)                          \
    {                                                                                                                  \
        for (int64_t r = mesh->band[band]; r < mesh->band[band + 1]; r++)                                              \
            if (mesh_points_can_yield(p) && m[mesh->run[r].material].law)                                              \
                run_flow_##D##_##FINITE(mesh, p, &mesh->run[r], m);                                                    \
            else                                                                                                       \
                mesh_elastic_run_force(mesh, &mesh->run[r], &m[mesh->run[r].material], FINITE);                        \
    }                                                                                                                  \
    static void bands_force_##D##_##FINITE(struct mesh *mesh, const struct particles *p, const struct elastic *m)      \
    {                                                                                                                  \
        _Pragma("omp parallel")                                                                                        \
        {                                                                                                              \
            _Pragma("omp for schedule(static)") for (int64_t b = 0; b < mesh->bands; b += 2)                           \
                band_force_##D##_##FINITE(mesh, p, b, m);                                                              \
            _Pragma("omp for schedule(static) nowait") for (int64_t b = 1; b < mesh->bands; b += 2)                    \
                band_force_##D##_##FINITE(mesh, p, b, m);                                                              \
        }                                                                                                              \
    }

/* ---- cells with own stiffness
 * ----------------------------------------------------------------------------------------------- */

/* Returns true if all cells of a group of eight cells with own stiffness are at rest, so that they need no forces. A
 * cell with own stiffness has missing points, partial stresses, several materials or doubled nodes. group: number of
 * the group in the mesh, from 0. */
static ALWAYS_INLINE bool partial_inactive(const struct mesh *mesh, int64_t group)
{
    uint8_t level = 0;
    for (int l = 0; l < LANES; l++)
        level |= mesh->active.level[mesh_block_of_node(mesh, mesh->own_stiffness_cell[group * LANES + l])];
    return level == 0;
}

/* Marks in mesh->own_stiffness_stressed those of a group of eight cells with own stiffness in which the principal
 * stress at a point may exceed the conversion stress of the material, at which points become peridynamic particles. A
 * cell with own stiffness has missing points, partial stresses, several materials or doubled nodes. m: elastic
 * constants of all materials; group: number of the group, from 0; cell: strain of the eight cells. */
static ALWAYS_INLINE void partial_mark(struct mesh *mesh, const struct elastic *m, int64_t group,
                                       const struct mesh_cell *cell, const int dim)
{
    const uint8_t *material = mesh->own_stiffness_material + group * LANES;
    lanes tension = lanes_broadcast(0), P[3][3];
    for (int l = 0; l < LANES; l++) {
        if (l == 0 || material[l] != material[l - 1]) {
            hooke_stress(&m[material[l]], cell->e, P, dim);
            tension = cell_largest_principal_stress_upper_bound(&m[material[l]], cell, P, dim);
        }
        mesh->own_stiffness_stressed[group * LANES + l] = tension[l] > m[material[l]].trigger;
    }
}

/* Computes the forces on the corners of a group of eight cells with own stiffness [N] into mesh->own_stiffness_force,
 * and marks in mesh->own_stiffness_stressed the cells in which a stress may exceed the conversion stress, at which
 * points become peridynamic particles. A cell with own stiffness has missing points, partial stresses, several
 * materials or doubled nodes. The plastic state of points in p that yield is updated. m: elastic constants of all
 * materials; group: number of the group, from 0; finite: true for finite strain. */
static ALWAYS_INLINE void own_stiffness_force(struct mesh *mesh, const struct particles *p, const struct elastic *m,
                                              int64_t group, const int dim, const bool finite)
{
    const bool rotates = finite && dim > 1;
    struct mesh_cell s;
    lanes u[CORNERS_MAX][3], f[CORNERS_MAX][3], moment[3] = {{0}};
    mesh_cells_with_own_stiffness_gather_displacements(mesh, group, u, dim);
    cell_compute_rotation_strain_and_modes(&s, mesh->grid.h, u, dim, rotates);
    partial_mark(mesh, m, group, &s, dim);
    if (mesh_points_can_yield(p)) {
        int32_t cell[LANES];
        mesh_cells_with_own_stiffness_get_indices(mesh, group, cell);
        cells_flow_of(mesh, p, m, cell, &s, dim);
    } else
        mesh_cells_with_own_stiffness_compute_stress(mesh, p, group, &s, dim);
    if (mesh->ends && p->end_rotation[0]) mesh_cells_with_own_stiffness_add_bond_moments(mesh, p, group, moment, dim);
    if (rotates)
        cell_add_skew_stress_balancing_moment_finite_strain(&s, moment, dim);
    else if (dim > 1 && mesh->ends && p->end_rotation[0])
        cell_add_skew_stress_balancing_moment_small_strain(&s, moment, dim);
    cell_compute_corner_forces(&s, mesh->grid.h, mesh->volume * (1 << dim), f, dim, rotates);
    lanes *out = (lanes *)mesh->own_stiffness_force + group * (1 << dim) * dim;
    for (int c = 0; c < 1 << dim; c++)
        for (int i = 0; i < dim; i++) out[c * dim + i] = f[c][i];
}

/* Adds the forces in mesh->own_stiffness_force of all cells with own stiffness that are not at rest to the nodes. A
 * cell with own stiffness has missing points, partial stresses, several materials or doubled nodes. Several cells share
 * a node, so the forces are added by one thread and in order. */
static ALWAYS_INLINE void cuts_add(struct mesh *mesh, const int dim)
{
    for (int64_t group = 0; group < mesh_count_groups_of_eight_cells_with_own_stiffness(mesh); group++) {
        const int32_t *cell = mesh->own_stiffness_cell + group * LANES;
        const int64_t left = mesh->own_stiffness_cells - group * LANES;
        const lanes *f = (const lanes *)mesh->own_stiffness_force + group * (1 << dim) * dim;
        if (partial_inactive(mesh, group)) continue;
        const int32_t *own = mesh_cells_with_own_stiffness_corner_nodes_if_at_slit(mesh, group, dim);
        const bool in_line = !own && list_is_consecutive(cell);
        for (int c = 0; c < 1 << dim; c++)
            for (int i = 0; i < dim; i++) {
                real *to = mesh->grid.force[i] + (own ? 0 : mesh->corner[c]);
                const int32_t *at = own ? own + c * LANES : cell;
                if (in_line)
                    lanes_store(to + cell[0], lanes_load(to + cell[0]) + f[c * dim + i]);
                else
                    for (int l = 0; l < LANES && l < left; l++) to[at[l]] += f[c * dim + i][l];
            }
    }
}

enum { FEW = 16 }; /* number of groups that one thread computes in less time than a thread team; empirical */

#define CUTS(D, FINITE)                                                                                                \
    static NEVER_INLINE void cut_force_##D##_##FINITE(struct mesh *mesh, const struct particles *p,                    \
                                                      const struct elastic *m, int64_t k)                              \
    {                                                                                                                  \
        if (!partial_inactive(mesh, k)) own_stiffness_force(mesh, p, m, k, D, FINITE);                                 \
    }                                                                                                                  \
    static void cuts_force_##D##_##FINITE(struct mesh *mesh, const struct particles *p, const struct elastic *m)       \
    {                                                                                                                  \
        TEAM_LOOP(mesh_count_groups_of_eight_cells_with_own_stiffness(mesh) > FEW,                                     \
                  for (int64_t k = 0; k < mesh_count_groups_of_eight_cells_with_own_stiffness(mesh); k++)              \
                      cut_force_##D##_##FINITE(mesh, p, m, k););                                                       \
        cuts_add(mesh, D);                                                                                             \
    }

/* ---- entry point ------------------------------------------------------------------------------------------------- */

MESH_FORCES(BANDS)
MESH_FORCES(CUTS)

void mesh_force(struct mesh *mesh, const struct particles *p, const struct elastic *m, bool finite)
{
#define CASE(D, FINITE)                                                                                                \
    if (mesh->grid.dim == D && (D == 1 || finite == FINITE)) {                                                         \
        bands_force_##D##_##FINITE(mesh, p, m);                                                                        \
        cuts_force_##D##_##FINITE(mesh, p, m);                                                                         \
    }
    MESH_FORCES(CASE)
#undef CASE
}
