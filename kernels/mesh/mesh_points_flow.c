/* Updates the plastic state of the material points of the mesh at the end of each explicit step (mesh_flow.h), so that
 * forces, samples and output frames need no return mapping. */
#include "mesh_flow.h"
#include "mesh_own_stiffness.h"
#include "mesh_run.h"

/* Arguments of mesh_points_flow: mesh, particles, elastic constants of all materials, and time step dt [s]. With dt = 0
 * the stresses are stored without plastic flow. */
struct flow_step {
    const struct mesh *mesh;
    const struct particles *p;
    const struct elastic *elastic;
    real dt;
};

/* Updates the plastic state of the points of eight cells at the end of an explicit step, or only stores their stresses
 * if f->dt is 0. f: arguments of the loop over cells (mesh, particles, materials, time step); cell: eight cell indices,
 * -1 for a lane without cell; u[c][i]: displacement of corner c from the undeformed state, along axis i (0 .. dim - 1)
 * [m]; finite: true for finite strain. */
static ALWAYS_INLINE void cells_step(const struct flow_step *f, const int32_t *cell, lanes u[CORNERS_MAX][3],
                                     const int dim, const bool finite)
{
    struct mesh_cell s;
    lanes change[CORNERS_MAX];
    cell_compute_rotation_strain_and_modes(&s, f->mesh->grid.h, u, dim, finite && dim > 1);
    const bool averaged = cells_compute_mean_dilatation_correction(f->mesh, f->p, f->elastic, cell, &s, change, dim);
    for (int q = 0; q < 1 << dim; q++) {
        lanes stress[SYM_MAX];
        int32_t point[LANES];
        unsigned with_law = 0;
        cells_compute_point_stress(f->mesh, f->p, f->elastic, cell, &s, averaged ? &change[q] : NULL, q, stress, dim,
                                   false);
        for (int l = 0; l < LANES; l++) {
            point[l] = mesh_cell_get_particle_index_of_point(f->mesh, cell[l], q, dim);
            if (point[l] < 0) continue;
            const struct elastic *m = &f->elastic[f->p->material[point[l]]];
            with_law |= (unsigned)(m->law && m->mode == LAW_EXPLICIT) << l;
        }
        if (f->dt == 0)
            mesh_points_store_stress_of_selected_lanes(f->p, point, with_law, stress, dim);
        else if (with_law)
            cells_apply_flow_laws(f->mesh, f->p, f->elastic, cell, q, with_law, f->dt, stress, dim);
    }
}

#define FLOW_STEP(D, FINITE)                                                                                           \
    static NEVER_INLINE void cells_step_##D##_##FINITE(const struct flow_step *f, const int32_t *cell,                 \
                                                       lanes u[CORNERS_MAX][3])                                        \
    {                                                                                                                  \
        cells_step(f, cell, u, D, FINITE);                                                                             \
    }                                                                                                                  \
    static void run_step_##D##_##FINITE(const struct flow_step *f, const struct mesh_cell_run *run)                    \
    {                                                                                                                  \
        int32_t cell[LANES];                                                                                           \
        lanes u[CORNERS_MAX][3];                                                                                       \
        if (!f->elastic[run->material].law) return;                                                                    \
        for (int64_t k = 0; k < run->cells; k += LANES) {                                                              \
            mesh_cell_run_get_indices_of_eight_cells(run, k, cell);                                                    \
            mesh_cell_run_load_corner_displacements(f->mesh, run, k, u, D);                                            \
            cells_step_##D##_##FINITE(f, cell, u);                                                                     \
        }                                                                                                              \
    }                                                                                                                  \
    static void group_step_##D##_##FINITE(const struct flow_step *f, int64_t group)                                    \
    {                                                                                                                  \
        int32_t cell[LANES];                                                                                           \
        lanes u[CORNERS_MAX][3];                                                                                       \
        mesh_cells_with_own_stiffness_get_indices(f->mesh, group, cell);                                               \
        mesh_cells_with_own_stiffness_gather_displacements(f->mesh, group, u, D);                                      \
        cells_step_##D##_##FINITE(f, cell, u);                                                                         \
    }                                                                                                                  \
    static void all_step_##D##_##FINITE(const struct flow_step *f)                                                     \
    {                                                                                                                  \
        const int64_t groups = mesh_count_groups_of_eight_cells_with_own_stiffness(f->mesh);                           \
        _Pragma("omp parallel for schedule(static)") for (int64_t k = 0; k < groups + f->mesh->runs; k++)              \
        {                                                                                                              \
            if (k < groups)                                                                                            \
                group_step_##D##_##FINITE(f, k);                                                                       \
            else                                                                                                       \
                run_step_##D##_##FINITE(f, &f->mesh->run[k - groups]);                                                 \
        }                                                                                                              \
    }
FLOW_STEP(1, 0)
FLOW_STEP(2, 0)
FLOW_STEP(2, 1)
FLOW_STEP(3, 0)
FLOW_STEP(3, 1)

void mesh_points_flow(const struct mesh *mesh, const struct particles *p, const struct elastic *m, real dt, bool finite)
{
    static void (*const all[DIM_MAX + 1][2])(const struct flow_step *) = {
        {NULL, NULL}, {all_step_1_0, all_step_1_0}, {all_step_2_0, all_step_2_1}, {all_step_3_0, all_step_3_1}};
    all[mesh->grid.dim][finite](&(struct flow_step){mesh, p, m, dt});
}
