/* Forces and energy of cells whose points yield, by return mapping at each point (mesh_laws.h). In explicit
 * steps forces are those of the plastic state at the end of the last step. In load steps they follow from one
 * incremental energy:
 *
 * With the plastic strain a and the plastic stress correction r of the last equilibrium, the strain e of a
 * point has the energy per volume (Ortiz & Stainier 1999, rate independent)
 *
 *     w(e) = min over dp, da >= |dp|_eq of  1/2 s : C^-1 : s + int sigma_y da,   s = C : (e - dp) - r
 *
 * over the increments dp of the plastic strain tensor, |dp|_eq its equivalent strain, and da of a, with the
 * elastic tensor C and the integral of the yield stress sigma_y from a to a + da. The derivative of w by e is
 * the stress s after return mapping. r is the elastic stress C : e less the stress, in the axes of the cell,
 * where Biot's strain splits additively. Sums over points replace the closed forms of mesh_law.h; the moment
 * of the stresses is balanced as there. */
#ifndef CLEAVE_KERNELS_MESH_FLOW
#define CLEAVE_KERNELS_MESH_FLOW

#include "mesh_law.h"
#include "mesh_laws.h"
#include "mesh_point.h"

/* Returns true if material points of the mesh can yield, i.e. if p has arrays of the plastic stress correction. If p is
 * NULL, returns false. */
static ALWAYS_INLINE bool mesh_points_can_yield(const struct particles *p) { return p && p->plastic_correction[0]; }

/* Computes the trial stress of material point i of p at the strain `strain` and the present plastic state of the point:
 * Hooke's stress less the plastic stress correction (elastic stress of the plastic strain). strain: dim x dim, row by
 * row, of which only the symmetric part counts; stress: receives symmetric components [Pa]; m: elastic constants of its
 * material. */
static ALWAYS_INLINE void point_compute_trial_stress(const struct particles *p, const struct elastic *m, int64_t i,
                                                     const real *strain, real *stress, const int dim)
{
    point_hooke_stress(m, strain, stress, dim);
    for (int k = 0; k < symmetric_tensor_component_count(dim); k++) stress[k] -= p->plastic_correction[k][i];
}

/* Returns the thickness divided by the reference thickness [1] at point i of p in plane stress of a material that
 * yields: elastic strain by Hooke's law, and plastic strain without change of volume. Returns 1 in other spaces and for
 * points that cannot yield. stress: symmetric components [Pa]; m: elastic constants of its material. */
static ALWAYS_INLINE real mesh_point_plane_stress_thickness_stretch(const struct particles *p, const struct elastic *m,
                                                                    int64_t i, const real *stress)
{
    if (m->space != SPACE_PLANE_STRESS || !m->law || !mesh_points_can_yield(p)) return 1;
    const real plastic = (p->plastic_correction[0][i] + p->plastic_correction[1][i]) / (m->c11 + m->c12);
    return 1 - m->law->poisson / m->law->young * (stress[0] + stress[1]) - plastic;
}

/* Returns the elastic energy per volume [J/m^3] of material point i of p under the stress `stress`. In plane strain of
 * a material that yields, the energy of the out-of-plane stress sigma_zz - nu (sigma_xx + sigma_yy) is included.
 * stress: symmetric components [Pa]; m: constants of its material. */
static ALWAYS_INLINE real point_elastic_energy_density(const struct particles *p, const struct elastic *m, int64_t i,
                                                       const real *stress, const int dim)
{
    real sum = 0, squares = 0, shears = 0;
    for (int k = 0; k < dim; k++) sum += stress[k], squares += stress[k] * stress[k];
    for (int k = dim; k < symmetric_tensor_component_count(dim); k++) shears += stress[k] * stress[k];
    const real mean = m->c12 / (m->c11 + (dim - 1) * m->c12);
    const real across = p->out_of_plane && m->law ? p->out_of_plane[i] : 0;
    return 0.5 * (squares - mean * sum * sum) / (m->c11 - m->c12) + (dim > 1 ? 0.5 * shears / m->shear : 0) +
           (across != 0 ? across * across / (4 * m->shear * (1 + m->poisson)) : 0);
}

/* Replaces value[q] of point number q (0 .. 2^dim - 1) of eight mesh cells, one cell per lane, by mean - value[q], with
 * the mean over the points (of p) of the same cell and material. Values of materials without mean dilatation, and of
 * lanes without a cell, become 0. cell: eight cell indices, -1 for a lane without cell; m: elastic constants of all
 * materials. */
static ALWAYS_INLINE void cells_replace_point_values_by_mean_minus_value(const struct mesh *mesh,
                                                                         const struct particles *p,
                                                                         const struct elastic *m, const int32_t *cell,
                                                                         lanes value[CORNERS_MAX], const int dim)
{
    static const int32_t none[CORNERS_MAX] = {-1, -1, -1, -1, -1, -1, -1, -1};
    for (int l = 0; l < LANES; l++) {
        real own[CORNERS_MAX];
        for (int q = 0; q < 1 << dim; q++) own[q] = value[q][l];
        cell_replace_point_values_by_mean_minus_value(
            m, p->material, cell[l] < 0 ? none : &mesh->point[(int64_t)cell[l] << dim], own, dim);
        for (int q = 0; q < 1 << dim; q++) value[q][l] = own[q];
    }
}

/* Computes the correction change[q] [1] of each normal strain of point number q (0 .. 2^dim - 1; particles of p) of
 * eight mesh cells, by which all points of one material in a cell get the mean of their dilatations (against volumetric
 * locking). Returns true; false, without values, if no point of the cells has a material with mean dilatation. cell:
 * eight cell indices, -1 for a lane without cell; s: strain of the cells; m: elastic constants of all materials. */
static ALWAYS_INLINE bool cells_compute_mean_dilatation_correction(const struct mesh *mesh, const struct particles *p,
                                                                   const struct elastic *m, const int32_t *cell,
                                                                   const struct mesh_cell *s, lanes change[CORNERS_MAX],
                                                                   const int dim)
{
    bool any = false;
    for (int l = 0; l < LANES && dim > 1; l++)
        any |= cell[l] >= 0 && cell_uses_mean_dilatation(m, p->material, &mesh->point[(int64_t)cell[l] << dim], dim);
    if (!any) return false;
    for (int q = 0; q < 1 << dim; q++) {
        lanes e[3][3];
        cells_compute_strain_at_point(s, q, e, dim);
        change[q] = lanes_broadcast(0);
        for (int d = 0; d < dim; d++) change[q] += e[d][d] * (1.0 / dim);
    }
    cells_replace_point_values_by_mean_minus_value(mesh, p, m, cell, change, dim);
    return true;
}

/* Computes the stresses of the points number `point` (0 .. 2^dim - 1; particles of p) of eight mesh cells, one cell in
 * each vector lane. cell: eight cell indices, -1 for a lane without cell; s: strain of the cells; added_normal_strain:
 * added to the normal strains of the points [1], NULL: nothing; m: elastic constants of all materials; stress: receives
 * symmetric components [Pa], 0 in lanes without a point. apply_return_mapping: if true, applies the return mapping of
 * load steps (static equilibria), updates the plastic state of the points and returns 0; if false, returns the sum of
 * the elastic energies per volume of the points [J/m^3]. */
static ALWAYS_INLINE real cells_compute_point_stress(const struct mesh *mesh, const struct particles *p,
                                                     const struct elastic *m, const int32_t *cell,
                                                     const struct mesh_cell *s, const lanes *added_normal_strain,
                                                     const int point, lanes *stress, const int dim,
                                                     const bool apply_return_mapping)
{
    lanes e[3][3];
    real sum = 0;
    unsigned with_law = 0;
    cells_compute_strain_at_point(s, point, e, dim);
    for (int d = 0; d < dim && added_normal_strain; d++) e[d][d] += *added_normal_strain;
    for (int k = 0; k < symmetric_tensor_component_count(dim); k++) stress[k] = lanes_broadcast(0);
    for (int l = 0; l < LANES; l++) {
        const int64_t i = mesh_cell_get_particle_index_of_point(mesh, cell[l], point, dim);
        real own[SYM_MAX], strain[DIM_MAX * DIM_MAX];
        if (i < 0) continue;
        for (int a = 0; a < dim; a++)
            for (int b = 0; b < dim; b++) strain[a * dim + b] = e[a][b][l];
        point_compute_trial_stress(p, &m[p->material[i]], i, strain, own, dim);
        for (int k = 0; k < symmetric_tensor_component_count(dim); k++) stress[k][l] = own[k];
        if (m[p->material[i]].law && m[p->material[i]].mode == LAW_LOAD_STEP) with_law |= 1u << l;
        if (!apply_return_mapping) sum += point_elastic_energy_density(p, &m[p->material[i]], i, own, dim);
    }
    if (apply_return_mapping && with_law) cells_apply_flow_laws(mesh, p, m, cell, point, with_law, 0, stress, dim);
    return sum;
}

/* Adds the stresses of the points number `point` (0 .. 2^dim - 1) of eight mesh cells to the sums over the points of
 * each cell: to cell->P, the stress of the mean strain, and to cell->force, the forces on the bending (hourglass)
 * modes. stress: symmetric components [Pa], already divided by the number of points of a cell. */
static ALWAYS_INLINE void cells_add_point_stress_to_cell_sums(struct mesh_cell *cell, const lanes *stress,
                                                              const int point, const int dim)
{
    for (int k = 0; k < symmetric_tensor_component_count(dim); k++) {
        int a, b;
        symmetric_tensor_component_axes(dim, k, &a, &b);
        cell->P[a][b] += stress[k];
        if (a != b) cell->P[b][a] += stress[k];
        for (int M = 3; M < 1 << dim; M++) {
            if (!(M & (M - 1))) continue;
            if (M >> b & 1)
                cell->force[M][a] += cell_point_coordinate_product_along_axes(M & ~(1 << b), point) * stress[k];
            if (a != b && M >> a & 1)
                cell->force[M][b] += cell_point_coordinate_product_along_axes(M & ~(1 << a), point) * stress[k];
        }
    }
}

/* Computes the stress of the mean strain and the forces on the bending (hourglass) modes of eight mesh cells whose
 * points yield, by return mapping at each point, into s->P and s->force [Pa]. Updates the plastic state of the points
 * in p. s: strain of the cells on entry; m: array of the elastic constants of all materials; cell: eight cell indices,
 * -1 for a lane without cell. */
static ALWAYS_INLINE void cells_compute_stress_by_return_mapping(const struct mesh *mesh, const struct particles *p,
                                                                 const struct elastic *m, const int32_t *cell,
                                                                 struct mesh_cell *s, const int dim)
{
    const real share = 1.0 / (1 << dim);
    lanes change[CORNERS_MAX], stress[CORNERS_MAX][SYM_MAX];
    const bool averaged = cells_compute_mean_dilatation_correction(mesh, p, m, cell, s, change, dim);
    for (int a = 0; a < dim; a++)
        for (int b = 0; b < dim; b++) s->P[a][b] = lanes_broadcast(0);
    for (int M = 0; M < 1 << dim; M++)
        for (int a = 0; a < dim; a++) s->force[M][a] = lanes_broadcast(0);
    for (int q = 0; q < 1 << dim; q++)
        cells_compute_point_stress(mesh, p, m, cell, s, averaged ? &change[q] : NULL, q, stress[q], dim, true);
    for (int q = 0; q < 1 << dim && averaged; q++) {
        change[q] = lanes_broadcast(0);
        for (int d = 0; d < dim; d++) change[q] += stress[q][d] * (1.0 / dim);
    }
    if (averaged) cells_replace_point_values_by_mean_minus_value(mesh, p, m, cell, change, dim);
    for (int q = 0; q < 1 << dim; q++) {
        for (int d = 0; d < dim && averaged; d++) stress[q][d] += change[q];
        for (int k = 0; k < symmetric_tensor_component_count(dim); k++) stress[q][k] *= share;
        cells_add_point_stress_to_cell_sums(s, stress[q], q, dim);
    }
}

/* Returns the elastic energy [J] of eight mesh cells together at the present plastic state of their points in p, which
 * is not changed. m: array of the elastic constants of all materials; cell: eight cell indices, -1 for a lane without
 * cell; s: strain of the cells. */
static ALWAYS_INLINE real cells_elastic_energy(const struct mesh *mesh, const struct particles *p,
                                               const struct elastic *m, const int32_t *cell, const struct mesh_cell *s,
                                               const int dim)
{
    lanes stress[SYM_MAX], change[CORNERS_MAX];
    real sum = 0;
    const bool averaged = cells_compute_mean_dilatation_correction(mesh, p, m, cell, s, change, dim);
    for (int q = 0; q < 1 << dim; q++)
        sum += cells_compute_point_stress(mesh, p, m, cell, s, averaged ? &change[q] : NULL, q, stress, dim, false);
    return sum * mesh->volume;
}

/* Writes to cell[8] the indices of eight mesh cells: those number k .. k + 7, counted from 0, of `run`, a row of
 * consecutive cells; -1 for entries beyond its last cell. */
static ALWAYS_INLINE void mesh_cell_run_get_indices_of_eight_cells(const struct mesh_cell_run *run, int64_t k,
                                                                   int32_t *cell)
{
    for (int l = 0; l < LANES; l++) cell[l] = k + l < run->cells ? (int32_t)(run->cell + k + l) : -1;
}

/* Writes to cell[8] the indices of the eight cells of group number `group` of cells with own stiffness of the mesh
 * (cells with missing points, partial stresses, several materials or doubled nodes); -1 for entries beyond the last
 * partial cell. */
static ALWAYS_INLINE void mesh_cells_with_own_stiffness_get_indices(const struct mesh *mesh, int64_t group,
                                                                    int32_t *cell)
{
    for (int64_t l = 0; l < LANES; l++)
        cell[l] = group * LANES + l < mesh->own_stiffness_cells ? mesh->own_stiffness_cell[group * LANES + l] : -1;
}

#endif
