/* One linear cell of the mesh with its 2^dim material points: forces on its corners from their displacements.
 *
 * The displacements u_c of the corners c are decomposed into the modes of a linear cell with edge h: with
 * s_c,d = -1 or 1 at the lower or upper end of the cell along axis d,
 *
 *     mode_M = 2^-(dim - |M|)/h  sum_c (prod_{d in M} s_c,d) u_c        M: a set of |M| axes
 *
 * |M| = 1 is the mean gradient g; larger sets are bending modes. Bending mode M adds to the gradient at a
 * point mode_M times the coordinates (+-1/4) of the point along all axes of M except the axis of
 * differentiation. Sums over the points are then closed forms with the means <x^2> = 1/16 and <x^2 y^2> =
 * 1/256, equal to sums point by point up to round-off.
 *
 * At finite strain the axes rotate with the cell: R is the rotation of its mean deformation gradient F = 1 +
 * g = R U. The stress is linear in Biot's strain, P = R C : (sym R^T F_p - 1), with the gradient F_p = R U_p
 * at a point, as the force of a bond is linear in its stretch. Since R depends on F, the exact gradient of
 * that energy has one more term, an antisymmetric part that balances the moment M = sum V s U_p^T of the
 * rotated stresses s: P += R w x, where w x is the matrix of the cross product with w, and (tr U - U) w =
 * axial(M - M^T)/V. It vanishes for isotropic constants in 2D; with it energy and angular momentum are exact
 * (tests/unit/mesh/test_mesh.c).
 *
 * Materials that yield or are nearly incompressible (elastic.mean_dilatation) have one dilatation in a cell,
 * the mean over its points of the material, as on the background grid (mpm/dilatation.h; B-bar, Hughes 1980).
 * With the stiffness k of the mean normal stress by the trace of the strain, k = (C11 + (dim - 1) C12)/dim,
 * the energy of a point is that of C - k 1 (x) 1 at its own strain, and k/2 times the square of the mean
 * trace. Bending modes, whose trace has the mean 0 over the points of a whole cell, have the constants C11 -
 * k and C12 - k. */
#ifndef CLEAVE_KERNELS_MESH_LAW
#define CLEAVE_KERNELS_MESH_LAW

#include "kernels/kernels.h"
#include "kernels/simd/lanes.h"

/* Deformation modes, rotation, strain and stress of eight mesh cells, one cell per vector lane; at finite strain in
 * axes that rotate with the cells. A mode is numbered by a set of axes, as bits. */
struct mesh_cell {
    /* mode: by set of axes and component [1]; force: derivative of the energy per volume by a bending mode [Pa] */
    lanes mode[CORNERS_MAX][3], force[CORNERS_MAX][3];
    lanes R[3][3], e[3][3], P[3][3]; /* rotation; strain and stress of the mean gradient */
};

/* Unrolls the following loop over sets of axes, so that the values of all modes stay in registers. */
#define SETS _Pragma("GCC unroll 8")

/* ---- modes ------------------------------------------------------------------------------------------------------- */

/* Replaces the values v[c] of a nodal variable at the 2^dim corners of eight cells by the amplitudes of the modes of
 * the cell, without their scale factor, in place: v[M] = sum_c sign(M, c) v[c] for every set of axes M (bit set), where
 * the sign is the product over the axes in M of -1 at the lower and 1 at the upper end. */
static ALWAYS_INLINE void cells_transform_corner_values_to_mode_amplitudes(lanes *v, const int dim)
{
    for (int d = 0; d < dim; d++)
        for (int c = 0; c < 1 << dim; c++)
            if (!(c >> d & 1)) {
                const lanes low = v[c], high = v[c | 1 << d];
                v[c] = low + high, v[c | 1 << d] = high - low;
            }
}

/* Replaces values v[M] for all sets of axes M (bit sets) by values at the 2^dim corners of eight cells, in place: v[c]
 * = sum_M sign(M, c) v[M], the transpose of cells_transform_corner_values_to_mode_amplitudes. */
static ALWAYS_INLINE void cells_transform_mode_amplitudes_to_corner_values(lanes *v, const int dim)
{
    for (int d = 0; d < dim; d++)
        for (int c = 0; c < 1 << dim; c++)
            if (!(c >> d & 1)) {
                const lanes mean = v[c], slope = v[c | 1 << d];
                v[c] = mean - slope, v[c | 1 << d] = mean + slope;
            }
}

/* ---- rotation ---------------------------------------------------------------------------------------------------- */

/* Computes the rotation R and the strain e = R^T F - 1 of eight cells in 2D from their mean displacement gradient g
 * [1], with F = 1 + g = R U. In e, cos - 1 is computed from the sine, which resolves strains far below the round-off of
 * the rotation. */
static ALWAYS_INLINE void cell_compute_rotation_and_strain_2d(const lanes g[3][3], lanes R[3][3], lanes e[3][3])
{
    lanes c = 2.0 + g[0][0] + g[1][1], s = g[1][0] - g[0][1];
    const lanes inverse = lanes_inverse_square_root(c * c + s * s);
    c *= inverse, s *= inverse;
    const lanes less = lanes_choose(c > 0, -s * s / (1.0 + lanes_max(c, lanes_broadcast(0))), c - 1.0);
    R[0][0] = R[1][1] = c, R[1][0] = s, R[0][1] = -s;
    e[0][0] = c * g[0][0] + s * g[1][0] + less;
    e[1][1] = c * g[1][1] - s * g[0][1] + less;
    e[0][1] = e[1][0] = c * g[0][1] + s * g[1][1] + s;
}

/* Computes the matrix C of the cofactors of the 3 x 3 matrix A, for eight matrices at a time, one per vector lane. */
static ALWAYS_INLINE void matrix_cofactors_3x3(const lanes A[3][3], lanes C[3][3])
{
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) {
            const int i = (a + 1) % 3, j = (a + 2) % 3, k = (b + 1) % 3, l = (b + 2) % 3;
            C[a][b] = A[i][k] * A[j][l] - A[i][l] * A[j][k];
        }
}

/* Computes the rotation R and the symmetric part e of R^T F - 1 of eight cells in 3D from their mean displacement
 * gradient g [1], with F = 1 + g = R U, by Newton's iteration R <- (R + R^-T)/2 (Higham 1986). Cells are far from
 * singular, so that few iterations are enough; after 12 the last value is used. */
static ALWAYS_INLINE void cell_compute_rotation_and_strain_3d(const lanes g[3][3], lanes R[3][3], lanes e[3][3])
{
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) R[a][b] = g[a][b] + (a == b ? 1.0 : 0.0);
    for (int step = 0; step < 12; step++) {
        lanes C[3][3], change = lanes_broadcast(0);
        matrix_cofactors_3x3(R, C);
        const lanes inverse = 0.5 / (R[0][0] * C[0][0] + R[0][1] * C[0][1] + R[0][2] * C[0][2]);
        for (int a = 0; a < 3; a++)
            for (int b = 0; b < 3; b++) {
                const lanes next = 0.5 * R[a][b] + inverse * C[a][b], by = next - R[a][b];
                change = lanes_max(change, by * by);
                R[a][b] = next;
            }
        if (!lanes_mask_any(change > 1e-17)) break; /* the next step changes R by (3e-9)^2/2: below round-off */
    }
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) {
            e[a][b] = R[b][a] - (a == b ? 1.0 : 0.0);
            for (int k = 0; k < 3; k++) e[a][b] += R[k][a] * g[k][b];
        }
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < a; b++) e[a][b] = e[b][a] = 0.5 * (e[a][b] + e[b][a]);
}

/* Rotates the vectors v (dim components) of eight cells by the rotations R of the cells: replaces v by R v if
 * `to_fixed_axes` is true (from the rotated axes of the cell to fixed axes), else by R^T v. */
static ALWAYS_INLINE void rotate_vector(const lanes R[3][3], lanes *v, const bool to_fixed_axes, const int dim)
{
    lanes old[3];
    for (int a = 0; a < dim; a++) old[a] = v[a];
    for (int a = 0; a < dim; a++) {
        v[a] = lanes_broadcast(0);
        for (int b = 0; b < dim; b++) v[a] += (to_fixed_axes ? R[a][b] : R[b][a]) * old[b];
    }
}

/* Adds to the stresses `stress` [Pa] of eight cells an antisymmetric part that balances the moments `moment`. stress,
 * strain: in the rotated axes of the cells, strain [1]; moment: moment per volume about each axis [Pa], in 2D moment[2]
 * only. The part is the matrix of the cross product with the vector w that solves (tr U - U) w = moment, with U = 1 +
 * strain. */
static ALWAYS_INLINE void stress_add_skew_part_balancing_moment(lanes stress[3][3], const lanes strain[3][3],
                                                                const lanes *moment, const int dim)
{
    if (dim == 2) {
        const lanes w = moment[2] / (2.0 + strain[0][0] + strain[1][1]);
        stress[1][0] -= w, stress[0][1] += w;
        return;
    }
    lanes A[3][3], C[3][3], w[3];
    const lanes trace = 3.0 + strain[0][0] + strain[1][1] + strain[2][2];
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) A[a][b] = (a == b ? trace - 1.0 : lanes_broadcast(0)) - strain[a][b];
    matrix_cofactors_3x3(A, C);
    const lanes inverse = 1.0 / (A[0][0] * C[0][0] + A[0][1] * C[0][1] + A[0][2] * C[0][2]);
    for (int a = 0; a < 3; a++) w[a] = inverse * (C[a][0] * moment[0] + C[a][1] * moment[1] + C[a][2] * moment[2]);
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3; /* component k of an axial vector: entry ji less entry ij */
        stress[j][i] -= w[k], stress[i][j] += w[k];
    }
}

/* ---- constitutive law -------------------------------------------------------------------------------------------- */

/* Computes the stress `stress` [Pa] of the symmetric strain `strain` [1] by Hooke's law, for eight cells at a time;
 * both are dim x dim matrices. m: elastic constants of the material. */
static ALWAYS_INLINE void hooke_stress(const struct elastic *m, const lanes strain[3][3], lanes stress[3][3],
                                       const int dim)
{
    for (int a = 0; a < dim; a++) {
        stress[a][a] = m->c11 * strain[a][a];
        for (int b = 0; b < dim; b++)
            if (b != a) stress[a][a] += m->c12 * strain[b][b], stress[a][b] = m->shear * (strain[a][b] + strain[b][a]);
    }
}

/* Returns the derivative [Pa] of the mean normal stress by the trace of the strain for the elastic constants m, if the
 * points of a cell have one dilatation (m->mean_dilatation); 0 if each point has its own. */
static ALWAYS_INLINE real elastic_bulk_modulus_if_mean_dilatation(const struct elastic *m, const int dim)
{
    return m->mean_dilatation ? (m->c11 + (dim - 1) * m->c12) / dim : 0;
}

/* Returns the derivative [Pa] of the elastic energy per volume by component i of the bending (hourglass) mode M of
 * eight cells, in the rotated axes of the cells. m: elastic constants; mode[M][i]: amplitudes of the modes [1]; M: set
 * of two or three axes, as bits. In the displacement gradient d_j u_i, mode {j, l} of component i appears times the
 * coordinate along l, and mode {1, 2, 3} of component i times the two other coordinates. */
static ALWAYS_INLINE lanes cells_compute_force_on_hourglass_mode(const struct elastic *m, lanes mode[CORNERS_MAX][3],
                                                                 const int M, const int i, const int dim)
{
    const real averaged = elastic_bulk_modulus_if_mean_dilatation(m, dim), c11 = m->c11 - averaged,
               c12 = m->c12 - averaged;
    if (dim == 3 && M == 7) return mode[M][i] * ((c11 + 2 * m->shear) / 256);
    if (dim == 2) return mode[M][i] * ((c11 + m->shear) / 16);
    const int k = M == 6 ? 0 : M == 5 ? 1 : 2; /* the axis that is not in M */
    if (k == i) {                              /* shears only, coupled to two modes of other components */
        const lanes trace = mode[6][0] + mode[5][1] + mode[3][2];
        return (mode[M][i] + trace) * (m->shear / 16);
    }
    return (mode[M][i] * (c11 + m->shear) + mode[7 & ~(1 << i)][k] * c12) * (1.0 / 16);
}

/* Computes rotation, mean strain and bending (hourglass) modes of eight mesh cells into `cell`, from the displacements
 * u[c][i] of corner c along axis i [m]. h: edge of a cell [m]; rotates: true for finite strain (axes that rotate with
 * the cell), false for small strain. */
static ALWAYS_INLINE void cell_compute_rotation_strain_and_modes(struct mesh_cell *cell, real h,
                                                                 lanes u[CORNERS_MAX][3], const int dim,
                                                                 const bool rotates)
{
    const int corners = 1 << dim;
    lanes g[3][3];
    for (int i = 0; i < dim; i++) {
        lanes v[CORNERS_MAX];
        for (int c = 0; c < corners; c++) v[c] = u[c][i];
        cells_transform_corner_values_to_mode_amplitudes(v, dim);
        SETS for (int M = 1; M < corners; M++) cell->mode[M][i] =
            v[M] * (1.0 / (h * (1 << (dim - __builtin_popcount(M)))));
        for (int b = 0; b < dim; b++) g[i][b] = cell->mode[1 << b][i];
    }
    lanes R[3][3], e[3][3]; /* local, so that Newton's loop keeps them in registers */
    if (rotates && dim == 2) cell_compute_rotation_and_strain_2d(g, R, e);
    if (rotates && dim == 3) cell_compute_rotation_and_strain_3d(g, R, e);
    for (int a = 0; a < dim; a++)
        for (int b = 0; b < dim; b++) {
            cell->e[a][b] = rotates ? e[a][b] : 0.5 * (g[a][b] + g[b][a]);
            if (rotates) cell->R[a][b] = R[a][b];
        }
    SETS for (int M = 1; M < corners && rotates; M++) if (M & (M - 1))
        rotate_vector(cell->R, cell->mode[M], false, dim);
}

/* Returns the product of the coordinates (1/4 or -1/4 edges from the middle) of material point number `point` of a cell
 * along the axes in the bit set `axis_set`, in units of the edge of the cell; 1 for an empty set. */
static ALWAYS_INLINE real cell_point_coordinate_product_along_axes(const int axis_set, const int point)
{
    const int axes = __builtin_popcount(axis_set), below = __builtin_popcount(axis_set & ~point);
    return (below & 1 ? -1.0 : 1.0) / (1 << 2 * axes);
}

/* Computes the strain `strain` [1] of eight cells at their material points number `point` (0 .. 2^dim - 1): the mean
 * strain in `cell` plus the bending (hourglass) modes in `cell` times the coordinates of the point in the cell (+-1/4).
 * `strain` may be unsymmetric; its symmetric part is the strain. */
static ALWAYS_INLINE void cells_compute_strain_at_point(const struct mesh_cell *cell, const int point,
                                                        lanes strain[3][3], const int dim)
{
    for (int i = 0; i < dim; i++)
        for (int j = 0; j < dim; j++) {
            strain[i][j] = cell->e[i][j];
            SETS for (int M = 3; M < 1 << dim; M++) if (M & (M - 1) && M >> j & 1)
            {
                strain[i][j] += cell_point_coordinate_product_along_axes(M & ~(1 << j), point) * cell->mode[M][i];
            }
        }
}

/* Replaces the trace of the strain `strain` (dim x dim) of eight whole cells at a material point by the trace of the
 * mean strain cell->e of the cells, if the points of a cell have one dilatation (m->mean_dilatation); otherwise does
 * nothing. Whole: with all points, of one material. */
static ALWAYS_INLINE void cells_replace_dilatation_by_cell_mean(const struct elastic *m, const struct mesh_cell *cell,
                                                                lanes strain[3][3], const int dim)
{
    lanes change = lanes_broadcast(0);
    if (!m->mean_dilatation) return;
    for (int d = 0; d < dim; d++) change += cell->e[d][d] - strain[d][d];
    for (int d = 0; d < dim; d++) strain[d][d] += change / dim;
}

/* Computes the stress of the mean strain, cell->P, and the forces on the bending (hourglass) modes, cell->force, of
 * eight whole cells (with all points, of one material, without partial stresses) [Pa], from the strain in s. m: elastic
 * constants. */
static ALWAYS_INLINE void cell_compute_stress_and_hourglass_forces(const struct elastic *m, struct mesh_cell *cell,
                                                                   const int dim)
{
    hooke_stress(m, cell->e, cell->P, dim);
    SETS for (int M = 1; M < 1 << dim; M++) if (M & (M - 1)) for (int i = 0; i < dim; i++) cell->force[M][i] =
        cells_compute_force_on_hourglass_mode(m, cell->mode, M, i, dim);
}

/* Returns for eight cells a bound [Pa] that exceeds m->trigger if a point may reach the strength surface at which it
 * becomes peridynamic: an upper bound of sqrt(J2) + g1 I1 (data/strength_surface.h), scaled by
 * m->trigger_mean/m->failure. P: stress [Pa]; further_stress: bound of each component of further stresses that are
 * added to P [Pa]; their sqrt(J2) is at most 2.2 `further_stress`, their I1 at most 3 `further_stress`. */
static ALWAYS_INLINE lanes cell_drucker_prager_stress_upper_bound(const struct elastic *m, const lanes P[3][3],
                                                                  lanes further_stress, const int dim)
{
    const lanes zz = dim == 3 ? P[2][2] : (m->space == SPACE_PLANE_STRAIN ? m->poisson : 0) * (P[0][0] + P[1][1]);
    const lanes a = P[0][0] - P[1][1], b = P[1][1] - zz, c = zz - P[0][0];
    lanes J2 = (a * a + b * b + c * c) * (1.0 / 6);
    for (int i = 0; i < dim; i++)
        for (int j = 0; j < i; j++) J2 += lanes_max(P[i][j] * P[i][j], P[j][i] * P[j][i]);
    const lanes failure = lanes_square_root(J2 + 1e-300) + m->surface.g1 * (P[0][0] + P[1][1] + zz);
    return (failure + (2.2 + 3 * m->surface.g1) * further_stress) * (m->trigger_mean / m->failure);
}

/* Returns for each of eight cells an upper bound [Pa] of the largest principal stress at its material points, by which
 * cells whose points cannot become peridynamic are skipped: the largest normal stress of P, plus the magnitudes of all
 * its shear stresses (Gershgorin), plus a bound on the stress of the bending modes in `cell`. With a strength surface
 * the larger of this and of cell_drucker_prager_stress_upper_bound is returned. P: stress of the mean strain [Pa]; m:
 * elastic constants. */
static ALWAYS_INLINE lanes cell_largest_principal_stress_upper_bound(const struct elastic *m,
                                                                     const struct mesh_cell *cell, const lanes P[3][3],
                                                                     const int dim)
{
    lanes largest = lanes_broadcast(0), bound = P[0][0];
    SETS for (int M = 1; M < 1 << dim; M++) if (M & (M - 1)) for (int i = 0; i < dim; i++) largest +=
        lanes_max(cell->mode[M][i], -cell->mode[M][i]);
    for (int a = 1; a < dim; a++) bound = lanes_max(bound, P[a][a]);
    for (int a = 0; a < dim; a++)
        for (int b = 0; b < a; b++) bound += lanes_max(P[a][b], -P[a][b]);
    const lanes bending = largest * ((m->c11 + m->shear) * 0.25);
    if (dim == 1 || !(m->surface.g0 > 0)) return bound + bending;
    return lanes_max(bound + bending, cell_drucker_prager_stress_upper_bound(m, P, bending, dim));
}

/* Returns the elastic energy [J] of each of eight cells from the strains, stresses, bending (hourglass) modes and
 * forces on these modes in s. volume: volume of a cell [m^3]. */
static ALWAYS_INLINE lanes cell_elastic_energy(const struct mesh_cell *cell, real volume, const int dim)
{
    lanes energy = lanes_broadcast(0);
    for (int i = 0; i < dim; i++) {
        for (int b = 0; b < dim; b++) energy += cell->P[i][b] * cell->e[i][b];
        SETS for (int M = 1; M < 1 << dim; M++) if (M & (M - 1)) energy += cell->force[M][i] * cell->mode[M][i];
    }
    return energy * (0.5 * volume);
}

/* Adds to the stress cell->P of eight cells, at finite strain, the antisymmetric part that balances the moments of the
 * stresses and of bonds. moment: on entry the moment of bonds at the points of the cell, per volume about each axis
 * [Pa]; on return the total moment, including that of the stresses: the antisymmetric part of P U^T, summed over all
 * modes (U = 1 + e, e: mean strain). */
static ALWAYS_INLINE void cell_add_skew_stress_balancing_moment_finite_strain(struct mesh_cell *cell, lanes *moment,
                                                                              const int dim)
{
    for (int k = dim == 2 ? 2 : 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        for (int b = 0; b < dim; b++) moment[k] += cell->P[j][b] * cell->e[i][b] - cell->P[i][b] * cell->e[j][b];
        SETS for (int M = 1; M < 1 << dim; M++) if (M & (M - 1)) moment[k] +=
            cell->force[M][j] * cell->mode[M][i] - cell->force[M][i] * cell->mode[M][j];
    }
    stress_add_skew_part_balancing_moment(cell->P, cell->e, moment, dim);
}

/* Adds to the stress cell->P of eight cells, at small strain, an antisymmetric part. It makes the corner forces balance
 * the moments that state-based bonds exert on the material points of the cells. moment: these moments, per volume about
 * each axis [Pa]; in 2D moment[2] only. */
static ALWAYS_INLINE void cell_add_skew_stress_balancing_moment_small_strain(struct mesh_cell *cell,
                                                                             const lanes *moment, const int dim)
{
    lanes none[3][3];
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) none[a][b] = lanes_broadcast(0);
    stress_add_skew_part_balancing_moment(cell->P, none, moment, dim);
}

/* Computes the forces f[c][i] [N] on corner c along axis i of eight cells from the stresses and the forces on bending
 * (hourglass) modes in s. h, volume: edge [m] and volume [m^3] of a cell; rotates: true to rotate cell->P and
 * cell->force from the axes of the cell to fixed axes first, in place. */
static ALWAYS_INLINE void cell_compute_corner_forces(struct mesh_cell *cell, real h, real volume,
                                                     lanes f[CORNERS_MAX][3], const int dim, const bool rotates)
{
    const int corners = 1 << dim;
    for (int b = 0; b < dim && rotates; b++) {
        lanes column[3];
        for (int a = 0; a < dim; a++) column[a] = cell->P[a][b];
        rotate_vector(cell->R, column, true, dim);
        for (int a = 0; a < dim; a++) cell->P[a][b] = column[a];
    }
    SETS for (int M = 1; M < corners && rotates; M++) if (M & (M - 1))
        rotate_vector(cell->R, cell->force[M], true, dim);
    for (int i = 0; i < dim; i++) {
        lanes v[CORNERS_MAX];
        v[0] = lanes_broadcast(0);
        SETS for (int M = 1; M < corners; M++)
        {
            const lanes by = M & (M - 1) ? cell->force[M][i] : cell->P[i][M == 1 ? 0 : M == 2 ? 1 : 2];
            v[M] = by * (-volume / (h * (1 << (dim - __builtin_popcount(M)))));
        }
        cells_transform_mode_amplitudes_to_corner_values(v, dim);
        for (int c = 0; c < corners; c++) f[c][i] = v[c];
    }
}

#endif
