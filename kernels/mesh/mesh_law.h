/* floor 2: one linear cell of the mesh with its 2^dim material points: forces on its corners from their displacements.
 *
 * Displacements are taken apart into the modes of a linear cell: with s_c = -1 or 1 along each axis for corner c,
 *
 *     mode_M = 2^-(dim - |M|)/h  sum_c (prod_{d in M} s_c,d) u_c        M: a set of axes
 *
 * |M| = 1 is the mean gradient g, larger sets bend the cell. The gradient at a point adds mode_M times its coordinates
 * (+-1/4) along the axes of M but the one derived by. Sums over the points then are closed forms, the same as point by point
 * to round-off: <x^2> = 1/16, <x^2 y^2> = 1/256.
 *
 * Finite strain turns with the cell: R is the rotation of its mean gradient F = 1 + g = R U, and the law is linear in the
 * strain of Biot, P = R C : (sym R^T F_p - 1), what bonds do, whose force is linear in their stretch. As R hangs on F, the
 * exact gradient of that energy has one more term: the skew part that balances the moment M = sum V s U_p^T of the
 * turned stresses,  P += R w x,  (tr U - U) w = axial(M - M^T)/V. It vanishes for isotropic constants in the plane; with
 * it energy and angular momentum are exact (tests/unit/mesh/test_mesh.c). */
#ifndef CLEAVE_MESH_LAW_H
#define CLEAVE_MESH_LAW_H

#include "kernels/kernels.h"
#include "kernels/simd/lanes.h"

/* Eight cells: modes and what belongs to them, in axes that turn with the cell where it turns. */
struct mesh_cell {
    lanes mode[CORNERS_MAX][3], force[CORNERS_MAX][3];   /* of sets of two axes and more; energy per volume by mode */
    lanes R[3][3], e[3][3], P[3][3];                     /* rotation; strain and stress of the mean gradient        */
};

/* Loops over sets of axes are written out: what they hold stays in registers. */
#define SETS _Pragma("GCC unroll 8")

/* ---- modes -------------------------------------------------------------------------------------------- */

/* v[M] = sum_c sign v[c], in place. */
static ALWAYS_INLINE void modes_of_corners(lanes *v, const int dim)
{
    for (int d = 0; d < dim; d++)
        for (int c = 0; c < 1 << dim; c++)
            if (!(c >> d & 1)) {
                const lanes low = v[c], high = v[c | 1 << d];
                v[c] = low + high, v[c | 1 << d] = high - low;
            }
}

/* v[c] = sum_M sign v[M], in place: the transpose. */
static ALWAYS_INLINE void corners_of_modes(lanes *v, const int dim)
{
    for (int d = 0; d < dim; d++)
        for (int c = 0; c < 1 << dim; c++)
            if (!(c >> d & 1)) {
                const lanes mean = v[c], slope = v[c | 1 << d];
                v[c] = mean - slope, v[c | 1 << d] = mean + slope;
            }
}

/* ---- rotation ------------------------------------------------------------------------------------------- */

/* R and R^T F - 1 of F = 1 + g in the plane; cos - 1 by the sine, for strains far below the rotation's round-off. */
static ALWAYS_INLINE void cell_turn_2d(const lanes g[3][3], lanes R[3][3], lanes e[3][3])
{
    lanes c = 2.0 + g[0][0] + g[1][1], s = g[1][0] - g[0][1];
    const lanes inverse = lanes_inverse_root(c * c + s * s);
    c *= inverse, s *= inverse;
    const lanes less = lanes_choose(c > 0, -s * s / (1.0 + lanes_max(c, lanes_of(0))), c - 1.0);
    R[0][0] = R[1][1] = c, R[1][0] = s, R[0][1] = -s;
    e[0][0] = c * g[0][0] + s * g[1][0] + less;
    e[1][1] = c * g[1][1] - s * g[0][1] + less;
    e[0][1] = e[1][0] = c * g[0][1] + s * g[1][1] + s;
}

static ALWAYS_INLINE void cofactors_3d(const lanes A[3][3], lanes C[3][3])
{
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) {
            const int i = (a + 1) % 3, j = (a + 2) % 3, k = (b + 1) % 3, l = (b + 2) % 3;
            C[a][b] = A[i][k] * A[j][l] - A[i][l] * A[j][k];
        }
}

/* Newton's iteration R <- (R + R^-T)/2 (Higham 1986); cells are far from flat, so that few steps are enough. */
static ALWAYS_INLINE void cell_turn_3d(const lanes g[3][3], lanes R[3][3], lanes e[3][3])
{
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) R[a][b] = g[a][b] + (a == b ? 1.0 : 0.0);
    for (int step = 0; step < 12; step++) {
        lanes C[3][3], change = lanes_of(0);
        cofactors_3d(R, C);
        const lanes inverse = 0.5 / (R[0][0] * C[0][0] + R[0][1] * C[0][1] + R[0][2] * C[0][2]);
        for (int a = 0; a < 3; a++)
            for (int b = 0; b < 3; b++) {
                const lanes next = 0.5 * R[a][b] + inverse * C[a][b], by = next - R[a][b];
                change = lanes_max(change, by * by);
                R[a][b] = next;
            }
        if (!lanes_any(change > 1e-17)) break;   /* the next step would change (3e-9)^2/2: nothing */
    }
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) {
            e[a][b] = R[b][a] - (a == b ? 1.0 : 0.0);
            for (int k = 0; k < 3; k++) e[a][b] += R[k][a] * g[k][b];
        }
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < a; b++) e[a][b] = e[b][a] = 0.5 * (e[a][b] + e[b][a]);
}

/* v <- R^T v or R v, components of a vector. */
static ALWAYS_INLINE void turn_vector(const lanes R[3][3], lanes *v, const bool back, const int dim)
{
    lanes old[3];
    for (int a = 0; a < dim; a++) old[a] = v[a];
    for (int a = 0; a < dim; a++) {
        v[a] = lanes_of(0);
        for (int b = 0; b < dim; b++) v[a] += (back ? R[a][b] : R[b][a]) * old[b];
    }
}

/* Adds the skew part to P that balances the moment m[k] (axial, per volume). */
static ALWAYS_INLINE void add_skew(lanes P[3][3], const lanes e[3][3], const lanes *m, const int dim)
{
    if (dim == 2) {
        const lanes w = m[2] / (2.0 + e[0][0] + e[1][1]);
        P[1][0] -= w, P[0][1] += w;
        return;
    }
    lanes A[3][3], C[3][3], w[3];
    const lanes trace = 3.0 + e[0][0] + e[1][1] + e[2][2];
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) A[a][b] = (a == b ? trace - 1.0 : lanes_of(0)) - e[a][b];
    cofactors_3d(A, C);
    const lanes inverse = 1.0 / (A[0][0] * C[0][0] + A[0][1] * C[0][1] + A[0][2] * C[0][2]);
    for (int a = 0; a < 3; a++) w[a] = inverse * (C[a][0] * m[0] + C[a][1] * m[1] + C[a][2] * m[2]);
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;      /* axial k: component ji - ij */
        P[j][i] -= w[k], P[i][j] += w[k];
    }
}

/* ---- the law ---------------------------------------------------------------------------------------------- */

/* Stress of the strain e (symmetric). */
static ALWAYS_INLINE void stress_of(const struct elastic *m, const lanes e[3][3], lanes P[3][3], const int dim)
{
    for (int a = 0; a < dim; a++) {
        P[a][a] = m->c11 * e[a][a];
        for (int b = 0; b < dim; b++)
            if (b != a) P[a][a] += m->c12 * e[b][b], P[a][b] = m->shear * (e[a][b] + e[b][a]);
    }
}

/* What bends the cell: derivative of the energy per volume by mode M of component i, in the cell's own axes. The gradient
 * d_j u_i holds mode {j, l} of i times the coordinate along l, and mode {1, 2, 3} of i times both others. */
static ALWAYS_INLINE lanes bend(const struct elastic *m, lanes mode[CORNERS_MAX][3], const int M, const int i, const int dim)
{
    if (dim == 3 && M == 7) return mode[M][i] * ((m->c11 + 2 * m->shear) / 256);
    if (dim == 2) return mode[M][i] * ((m->c11 + m->shear) / 16);
    const int k = M == 6 ? 0 : M == 5 ? 1 : 2;   /* the axis that is not in M */
    if (k == i) {                                /* only shears, each with the like mode of another component */
        const lanes trace = mode[6][0] + mode[5][1] + mode[3][2];
        return (mode[M][i] + trace) * (m->shear / 16);
    }
    return (mode[M][i] * (m->c11 + m->shear) + mode[7 & ~(1 << i)][k] * m->c12) * (1.0 / 16);
}

/* Strain and modes of displacements u[c][i] of the corners. */
static ALWAYS_INLINE void cell_strain(struct mesh_cell *s, real h, lanes u[CORNERS_MAX][3], const int dim, const bool turns)
{
    const int corners = 1 << dim;
    lanes g[3][3];
    for (int i = 0; i < dim; i++) {
        lanes v[CORNERS_MAX];
        for (int c = 0; c < corners; c++) v[c] = u[c][i];
        modes_of_corners(v, dim);
        SETS for (int M = 1; M < corners; M++) s->mode[M][i] = v[M] * (1.0 / (h * (1 << (dim - __builtin_popcount(M)))));
        for (int b = 0; b < dim; b++) g[i][b] = s->mode[1 << b][i];
    }
    lanes R[3][3], e[3][3];                      /* of their own: Newton's loop keeps them in registers */
    if (turns && dim == 2) cell_turn_2d(g, R, e);
    if (turns && dim == 3) cell_turn_3d(g, R, e);
    for (int a = 0; a < dim; a++)
        for (int b = 0; b < dim; b++) {
            s->e[a][b] = turns ? e[a][b] : 0.5 * (g[a][b] + g[b][a]);
            if (turns) s->R[a][b] = R[a][b];
        }
    SETS for (int M = 1; M < corners && turns; M++)
        if (M & (M - 1)) turn_vector(s->R, s->mode[M], false, dim);
}

/* What whole cells answer. */
static ALWAYS_INLINE void cell_law(const struct elastic *m, struct mesh_cell *s, const int dim)
{
    stress_of(m, s->e, s->P, dim);
    SETS for (int M = 1; M < 1 << dim; M++)
        if (M & (M - 1)) for (int i = 0; i < dim; i++) s->force[M][i] = bend(m, s->mode, M, i, dim);
}

/* A bound of the largest principal stress at the points of cells with all their stress P: of the mean the largest normal
 * stress and all shears (Gershgorin), and all that bends. */
static ALWAYS_INLINE lanes cell_tension(const struct elastic *m, const struct mesh_cell *s, const lanes P[3][3], const int dim)
{
    lanes largest = lanes_of(0), bound = P[0][0];
    SETS for (int M = 1; M < 1 << dim; M++)
        if (M & (M - 1)) for (int i = 0; i < dim; i++) largest += lanes_max(s->mode[M][i], -s->mode[M][i]);
    for (int a = 1; a < dim; a++) bound = lanes_max(bound, P[a][a]);
    for (int a = 0; a < dim; a++)
        for (int b = 0; b < a; b++) bound += lanes_max(P[a][b], -P[a][b]);
    return bound + largest * ((m->c11 + m->shear) * 0.25);
}

/* Energy that the cells store [J]. */
static ALWAYS_INLINE lanes cell_energy(const struct mesh_cell *s, real volume, const int dim)
{
    lanes energy = lanes_of(0);
    for (int i = 0; i < dim; i++) {
        for (int b = 0; b < dim; b++) energy += s->P[i][b] * s->e[i][b];
        SETS for (int M = 1; M < 1 << dim; M++)
            if (M & (M - 1)) energy += s->force[M][i] * s->mode[M][i];
    }
    return energy * (0.5 * volume);
}

/* Balances the moment of stresses, axial parts of sum P U^T over all modes, U = 1 + e of the mean, and what is in `moment` already
 * [Pa]: of bonds whose ends turn with the cell. */
static ALWAYS_INLINE void cell_balance(struct mesh_cell *s, lanes *moment, const int dim)
{
    for (int k = dim == 2 ? 2 : 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        for (int b = 0; b < dim; b++) moment[k] += s->P[j][b] * s->e[i][b] - s->P[i][b] * s->e[j][b];
        SETS for (int M = 1; M < 1 << dim; M++)
            if (M & (M - 1)) moment[k] += s->force[M][j] * s->mode[M][i] - s->force[M][i] * s->mode[M][j];
    }
    add_skew(s->P, s->e, moment, dim);
}

/* Moments alone where strain is small: the rotation is the skew part of the gradient. */
static ALWAYS_INLINE void cell_skew(struct mesh_cell *s, const lanes *moment, const int dim)
{
    lanes none[3][3];
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) none[a][b] = lanes_of(0);
    add_skew(s->P, none, moment, dim);
}

/* Forces f [N] on the corners, turned back. */
static ALWAYS_INLINE void cell_corners(struct mesh_cell *s, real h, real volume, lanes f[CORNERS_MAX][3], const int dim,
                                       const bool turns)
{
    const int corners = 1 << dim;
    for (int b = 0; b < dim && turns; b++) {
        lanes column[3];
        for (int a = 0; a < dim; a++) column[a] = s->P[a][b];
        turn_vector(s->R, column, true, dim);
        for (int a = 0; a < dim; a++) s->P[a][b] = column[a];
    }
    SETS for (int M = 1; M < corners && turns; M++)
        if (M & (M - 1)) turn_vector(s->R, s->force[M], true, dim);
    for (int i = 0; i < dim; i++) {
        lanes v[CORNERS_MAX];
        v[0] = lanes_of(0);
        SETS for (int M = 1; M < corners; M++) {
            const lanes by = M & (M - 1) ? s->force[M][i] : s->P[i][M == 1 ? 0 : M == 2 ? 1 : 2];
            v[M] = by * (-volume / (h * (1 << (dim - __builtin_popcount(M)))));
        }
        corners_of_modes(v, dim);
        for (int c = 0; c < corners; c++) f[c][i] = v[c];
    }
}

#endif
