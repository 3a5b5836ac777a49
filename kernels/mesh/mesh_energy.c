/* Computes the kinetic and the elastic energy of the mesh, for the energy balance. */
#include "mesh_flow.h"
#include "mesh_inertia.h"
#include "mesh_own_stiffness.h"
#include "mesh_run.h"
#include "base/team.h"

/* Returns true if none of the nodes first .. end - 1 has mass. It saves time on the finest mesh, most of whose nodes
 * have none where coarse cells replace its cells. mass: mass of each node, or its inverse (0 for a node without
 * mass). */
static bool none_moves(const real *mass, int64_t first, int64_t end)
{
    enum { PIECE = 64 };
    for (; first < end; first += PIECE) {
        const int64_t to = first + PIECE < end ? first + PIECE : end;
        real most = 0;
#pragma omp simd reduction(max : most)
        for (int64_t I = first; I < to; I++) most = mass[I] > most ? mass[I] : most;
        if (most > 0) return false;
    }
    return true;
}

/* Adds the kinetic energy of the nodes first .. end - 1 of a mesh [J] to sum[0]: m v^2/2, or for coarse cells, whose
 * mass matrix is not diagonal, half the product of momentum and velocity. context: the mesh (struct mesh). Called by
 * reproducible_sums for each block of nodes. */
static void mesh_energy_kinetic_block(const void *context, int64_t first, int64_t end, real *sum)
{
    const struct mesh *mesh = context;
    const struct grid *g = &mesh->grid;
    if (none_moves(g->mass, first, end)) return;
    for (int d = 0; d < g->dim; d++) {
        const real *mass = g->mass, *v = g->velocity[d], *momentum = mesh->matched ? g->momentum[d] : v;
        real total = 0;
#pragma omp simd reduction(+ : total)
        for (int64_t I = first; I < end; I++) total += mass[I] * momentum[I] * v[I];
        sum[0] += 0.5 * total;
    }
}

real mesh_kinetic(const struct mesh *mesh)
{
    real sum = 0;
    if (mesh->points > 0) reproducible_sums(mesh->grid.n, 1, mesh_energy_kinetic_block, mesh, &sum);
    return sum;
}

/* Adds the sum of f^2/(4 m) over the nodes first .. end - 1 of a mesh to sum[0] [J/s^2], with nodal forces f and
 * masses m. The caller multiplies it by dt^2, which gives the difference between two energies: the mean of the kinetic
 * energies before and after a step, and m v_before . v_after/2, the kinetic part of the energy that leap-frog
 * conserves. Coarse cells with a blended (lumped and consistent) mass matrix contribute by this matrix instead of m
 * (mesh_inertia.h). context: the mesh (struct mesh). Called by reproducible_sums for each block of nodes. */
static void mesh_energy_kick_block(const void *context, int64_t first, int64_t end, real *sum)
{
    const struct mesh *mesh = context;
    if (!mesh->matched && none_moves(mesh->inverse_mass, first, end)) return;
    for (int d = 0; d < mesh->grid.dim; d++) {
        const real *inverse_mass = mesh->inverse_mass, *force = mesh->grid.force[d];
        real total = 0;
#pragma omp simd reduction(+ : total)
        for (int64_t I = first; I < end; I++) total += square(force[I]) * inverse_mass[I];
        sum[0] += 0.25 * total;
    }
    for (int64_t I = first; I < end && mesh->matched; I++)
        if (mesh->matched[I] & 1) sum[0] += 0.25 * mesh_cell_leapfrog_energy_correction(mesh, I);
}

real mesh_kick(const struct mesh *mesh, real dt)
{
    real sum = 0;
    if (mesh->points == 0) return 0;
    reproducible_sums(mesh->grid.n, 1, mesh_energy_kick_block, mesh, &sum);
    /* the motion of constrained components is prescribed: no correction; their work is added when they move */
    for (int64_t k = 0; k < mesh->grid.walls; k++) {
        const struct wall *w = &mesh->grid.wall[k];
        sum -= 0.25 * square(mesh->grid.force[w->component][w->node]) * mesh->inverse_mass[w->node];
    }
    return dt * dt * sum;
}

/* Arguments of mesh_strain, packed for the functions that compute the elastic energy of one row of cells or one group
 * of eight cells with own stiffness: the mesh, its material points, the elastic constants of each material, and whether
 * the strain is finite. */
struct strain_sum {
    const struct mesh *mesh;
    const struct particles *p;
    const struct elastic *elastic;
    bool finite;
};

/* Returns the sum of the eight entries of the vector a. */
static ALWAYS_INLINE real lanes_sum(lanes a)
{
    real all = 0;
    for (int l = 0; l < LANES; l++) all += a[l];
    return all;
}

/* Returns the elastic energy of a group of eight cells with own stiffness [J]: cells that the regular loop does not
 * treat, because of missing points, partial stresses, several materials or doubled nodes. s: mesh, particles, elastic
 * constants; group: number of the group, from 0; finite: true for finite strain. Vector lanes beyond the last cell have
 * no stiffness and contribute 0. */
static ALWAYS_INLINE real partial_energy(const struct strain_sum *s, int64_t group, const int dim, const bool finite)
{
    const struct mesh *mesh = s->mesh;
    struct mesh_cell cell;
    lanes u[CORNERS_MAX][3];
    mesh_cells_with_own_stiffness_gather_displacements(mesh, group, u, dim);
    cell_compute_rotation_strain_and_modes(&cell, mesh->grid.h, u, dim, finite && dim > 1);
    if (mesh_points_can_yield(s->p)) {
        int32_t eight[LANES];
        mesh_cells_with_own_stiffness_get_indices(mesh, group, eight);
        return cells_elastic_energy(mesh, s->p, s->elastic, eight, &cell, dim);
    }
    mesh_cells_with_own_stiffness_compute_stress(mesh, s->p, group, &cell, dim);
    return lanes_sum(cell_elastic_energy(&cell, mesh->volume * (1 << dim), dim));
}

/* Returns the elastic energy of a row of consecutive cells along x with all points of one material [J], computed for
 * eight cells at a time. s: mesh, particles and elastic constants; run: the row; finite: true for finite strain. Vector
 * lanes beyond the end of the row contribute 0. */
static ALWAYS_INLINE real run_energy(const struct strain_sum *s, const struct mesh_cell_run *run, const int dim,
                                     const bool finite)
{
    const struct mesh *mesh = s->mesh;
    const bool flows = mesh_points_can_yield(s->p) && s->elastic[run->material].law;
    lanes sum = lanes_broadcast(0);
    real flowed = 0;
    for (int64_t k = 0; k < run->cells; k += LANES) {
        struct mesh_cell cell;
        lanes u[CORNERS_MAX][3];
        mesh_cell_run_load_corner_displacements(mesh, run, k, u, dim);
        cell_compute_rotation_strain_and_modes(&cell, mesh->grid.h, u, dim, finite && dim > 1);
        if (flows) {
            int32_t eight[LANES];
            mesh_cell_run_get_indices_of_eight_cells(run, k, eight);
            flowed += cells_elastic_energy(mesh, s->p, s->elastic, eight, &cell, dim);
            continue;
        }
        cell_compute_stress_and_hourglass_forces(&s->elastic[run->material], &cell, dim);
        sum += cell_elastic_energy(&cell, mesh->volume * (1 << dim), dim);
    }
    return lanes_sum(sum) + flowed;
}

#define TERM(D, FINITE)                                                                                                \
    static real run_term_##D##_##FINITE(const void *context, int64_t r)                                                \
    {                                                                                                                  \
        const struct strain_sum *s = context;                                                                          \
        return run_energy(s, &s->mesh->run[r], D, FINITE);                                                             \
    }                                                                                                                  \
    static real cut_term_##D##_##FINITE(const void *context, int64_t group)                                            \
    {                                                                                                                  \
        return partial_energy(context, group, D, FINITE);                                                              \
    }
TERM(1, 0)
TERM(2, 0)
TERM(2, 1)
TERM(3, 0)
TERM(3, 1)

real mesh_strain(const struct mesh *mesh, const struct particles *p, const struct elastic *m, bool finite)
{
    static real (*const run[DIM_MAX + 1][2])(const void *, int64_t) = {
        {NULL, NULL}, {run_term_1_0, run_term_1_0}, {run_term_2_0, run_term_2_1}, {run_term_3_0, run_term_3_1}};
    static real (*const partial[DIM_MAX + 1][2])(const void *, int64_t) = {
        {NULL, NULL}, {cut_term_1_0, cut_term_1_0}, {cut_term_2_0, cut_term_2_1}, {cut_term_3_0, cut_term_3_1}};
    struct strain_sum s = {mesh, p, m, finite};
    const int dim = mesh->grid.dim;
    if (mesh->points == 0) return 0;
    return reproducible_sum(mesh_count_groups_of_eight_cells_with_own_stiffness(mesh), partial[dim][finite], &s) +
           reproducible_sum(mesh->runs, run[dim][finite], &s);
}
