/* Computes the forces of rows of elastic whole cells on the nodes of the mesh. A whole cell has all of its material
 * points, and all of one material. */
#define ROWS_IN_PARTS /* vectors of WIDE cells */
#include "mesh_run.h"

/* Arguments of run_elastic_cells. */
struct elastic_run {
    lanes tension;           /* upper bound of the largest principal stress at the points so far [Pa] */
    const struct elastic *m; /* elastic constants */
    real h, volume;          /* edge of a cell [m]; volume of a cell [m^3] */
    bool balanced;           /* result of elastic_is_isotropic_in_2d */
};

/* Defines two functions for dimension D and strain measure FINITE (true: finite strain). One computes the forces of
 * WIDE cells, one per vector lane (run_cells_force_fn). The other adds the forces of a row of cells to the nodes
 * (mesh_elastic_run_force). */
#define RUN(D, FINITE)                                                                                                 \
    static ALWAYS_INLINE void run_elastic_cells_##D##_##FINITE(                                                        \
        void *context, const struct mesh_cell_run *run, int64_t k, lanes u[CORNERS_MAX][3], lanes f[CORNERS_MAX][3])   \
    {                                                                                                                  \
        struct elastic_run *a = context;                                                                               \
        (void)run, (void)k;                                                                                            \
        full_cells_of_one_material_compute_corner_forces(a->m, a->h, a->volume, u, f, &a->tension, D, FINITE,          \
                                                         a->balanced);                                                 \
    }                                                                                                                  \
    static void run_force_##D##_##FINITE(const struct mesh *mesh, struct mesh_cell_run *run, const struct elastic *m)  \
    {                                                                                                                  \
        struct elastic_run a = {.m = m, .h = mesh->grid.h, .volume = mesh->volume * (1 << D)};                         \
        a.tension = lanes_broadcast(-INFINITY), a.balanced = elastic_is_isotropic_in_2d(m, D);                         \
        mesh_cell_run_add_forces(mesh, run, run_elastic_cells_##D##_##FINITE, &a, D);                                  \
        run->stressed = false;                                                                                         \
        for (int l = 0; l < WIDE; l++) run->stressed |= a.tension[l] > m->trigger;                                     \
    }

MESH_FORCES(RUN)

void mesh_elastic_run_force(const struct mesh *mesh, struct mesh_cell_run *run, const struct elastic *m, bool finite)
{
#define CASE(D, FINITE)                                                                                                \
    if (mesh->grid.dim == D && (D == 1 || finite == FINITE)) run_force_##D##_##FINITE(mesh, run, m);
    MESH_FORCES(CASE)
#undef CASE
}
