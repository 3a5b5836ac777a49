/* Polar rotation: the rotation R nearest to a matrix M. R maximises R : M, i.e. M = R U with U symmetric and positive
 * definite. Matrices are row major, dim x dim. */
#ifndef CLEAVE_BASE_POLAR
#define CLEAVE_BASE_POLAR

#include <math.h>

#include "base/base.h"

/* Computes the rotation matrix R nearest to the 2 x 2 matrix M (row major): its angle is that of the vector (M11 + M22,
 * M21 - M12). R is the identity if this vector is 0. */
static inline void polar_rotation_2d(const real *M, real *R)
{
    const real c = M[0] + M[3], s = M[2] - M[1], size = sqrt(c * c + s * s);
    R[0] = R[3] = size > 0 ? c / size : 1;
    R[2] = size > 0 ? s / size : 0;
    R[1] = -R[2];
}

/* Computes the rotation R nearest to the 3 x 3 matrix M (row major), by Newton's iteration R <- (R + R^-T)/2 (Higham
 * 1986) from M scaled to unit size. R is the identity if M is singular or inverted (determinant <= 0), as possible for
 * neighbourhoods that have lost bonds. */
static inline void polar_rotation_3d(const real *M, real *R)
{
    real size = 0;
    for (int c = 0; c < 9; c++) size += M[c] * M[c];
    size = sqrt(size / 3);
    for (int c = 0; c < 9; c++) R[c] = size > 0 ? M[c] / size : c % 4 == 0;
    for (int step = 0; step < 30; step++) {
        const real cofactor[9] = {R[4] * R[8] - R[5] * R[7], R[5] * R[6] - R[3] * R[8], R[3] * R[7] - R[4] * R[6],
                                  R[2] * R[7] - R[1] * R[8], R[0] * R[8] - R[2] * R[6], R[1] * R[6] - R[0] * R[7],
                                  R[1] * R[5] - R[2] * R[4], R[2] * R[3] - R[0] * R[5], R[0] * R[4] - R[1] * R[3]};
        const real determinant = R[0] * cofactor[0] + R[1] * cofactor[1] + R[2] * cofactor[2];
        real change = 0;
        if (!(determinant > 1e-12)) {
            for (int c = 0; c < 9; c++) R[c] = c % 4 == 0;
            return;
        }
        for (int c = 0; c < 9; c++) {
            const real next = 0.5 * (R[c] + cofactor[c] / determinant);
            change = real_max(change, fabs(next - R[c]));
            R[c] = next;
        }
        if (change < 1e-15) return;
    }
}

/* Computes the rotation R nearest to the matrix M (row major, dim x dim), in dimension 2 or 3. */
static inline void polar_rotation(const real *M, real *R, const int dim)
{
    if (dim == 2)
        polar_rotation_2d(M, R);
    else
        polar_rotation_3d(M, R);
}

#endif
