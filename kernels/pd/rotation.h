/* How state-based kernels store the rotation R of a particle: as g (R - 1), with the spring stiffness g of its
 * neighbourhood (all neighbours of a particle). In 2D these are the four entries of that matrix.
 *
 * In 3D four numbers replace nine: with the unit quaternion (q, q0) of R, and (a, s) = sqrt(2 g) (q, q0),
 *
 *     g (R - 1) v = 2 g [q0 q x v + q x (q x v)] = a x (s v + a x v)
 *
 * This saves time because neighbours are read at unaligned addresses, and seven of eight such loads touch two cache
 * lines. Where R is exactly 1, a is exactly 0, and so is the product. */
#ifndef CLEAVE_KERNELS_ROTATION
#define CLEAVE_KERNELS_ROTATION

#include "bonds/bonds.h"
#include "kernels/simd/lanes.h"

#define TURN_TINY 1e-300 /* keeps the root of zero finite */

/* Computes the row with the largest diagonal entry of the matrix 4 (q, q0) (q, q0)^T for eight rotations R (row major,
 * one per lane) with the unit quaternions (q, q0). From it the quaternion follows without division by a small number
 * (Shepperd 1978). largest_row: receives the four entries of this row. Returns its diagonal entry. */
static ALWAYS_INLINE lanes rotation_quaternion_outer_product_largest_row(const lanes *R, lanes *largest_row)
{
    const lanes odd[3] = {R[7] - R[5], R[2] - R[6], R[3] - R[1]}, even[3] = {R[1] + R[3], R[5] + R[7], R[6] + R[2]};
    const lanes size[ROTATION] = {1.0 + R[0] - R[4] - R[8], 1.0 - R[0] + R[4] - R[8], 1.0 - R[0] - R[4] + R[8],
                                  1.0 + R[0] + R[4] + R[8]};
    const lanes rows[3][ROTATION] = {
        {size[0], even[0], even[2], odd[0]}, {even[0], size[1], even[1], odd[1]}, {even[2], even[1], size[2], odd[2]}};
    lanes largest = size[3];
    for (int c = 0; c < ROTATION; c++) largest_row[c] = c < 3 ? odd[c] : size[3];
    for (int k = 0; k < 3; k++) {
        const lanes_mask larger = size[k] > largest;
        for (int c = 0; c < ROTATION; c++) largest_row[c] = lanes_choose(larger, rows[k][c], largest_row[c]);
        largest = lanes_choose(larger, size[k], largest);
    }
    return largest;
}

/* Computes the four numbers rotation[ROTATION] by which the rotations R (row major) of eight particles are stored, with
 * g = `spring_stiffness`, the spring stiffnesses (force by extension) of the neighbourhoods of these particles [N/m]:
 * in 2D the entries of g (R - 1), row by row; in 3D sqrt(2 g) times the unit quaternion of R, its scalar last. */
static ALWAYS_INLINE void rotation_encode_with_spring_stiffness(lanes *rotation, const lanes *R, lanes spring_stiffness,
                                                                const int dim)
{
    if (dim == 2) {
        for (int c = 0; c < ROTATION; c++) rotation[c] = spring_stiffness * (R[c] - (c % 3 == 0 ? 1.0 : 0.0));
        return;
    }
    const lanes size = rotation_quaternion_outer_product_largest_row(R, rotation),
                scale = spring_stiffness * lanes_inverse_square_root(2.0 * spring_stiffness * size + TURN_TINY);
    for (int c = 0; c < ROTATION; c++) rotation[c] *= scale;
}

/* Subtracts the product of the matrix g (R - 1) with the vector `arm` from the vector f, for eight particles with
 * rotations R and spring stiffnesses g (force by extension). f, arm: dim components; rotation: numbers stored by
 * rotation_encode_with_spring_stiffness. In 2D the matrix is (a, -c; c, a) with a = rotation[0] and c = rotation[2]. */
static ALWAYS_INLINE void encoded_rotation_subtract_product_with_vector(lanes *f, const lanes *rotation,
                                                                        const lanes *arm, const int dim)
{
    if (dim == 2) {
        f[0] += rotation[2] * arm[1] - rotation[0] * arm[0];
        f[1] -= rotation[2] * arm[0] + rotation[0] * arm[1];
        return;
    }
    lanes u[DIM_MAX];
    for (int d = 0; d < 3; d++) {
        const int e = (d + 1) % 3, h = (d + 2) % 3;
        u[d] = rotation[3] * arm[d] + rotation[e] * arm[h] - rotation[h] * arm[e];
    }
    for (int d = 0; d < 3; d++) {
        const int e = (d + 1) % 3, h = (d + 2) % 3;
        f[d] += rotation[h] * u[e] - rotation[e] * u[h];
    }
}

/* Returns true if encoded_rotation_subtract_product_with_vector reads number `component` (0 to 3) of a stored rotation,
 * so that it must be loaded: in 3D all numbers, in 2D numbers 0 and 2. */
static ALWAYS_INLINE bool encoded_rotation_component_is_needed(int component, const int dim)
{
    return dim > 2 || component % 2 == 0;
}

/* Returns true if number `component` (0 to 3) of a stored rotation (rotation_encode_with_spring_stiffness) changes sign
 * when the particle is reflected in a plane normal to axis `axis` (-1: no plane). dim: dimension of the body. All
 * components of a rotation vector change sign except the one along the normal. */
static inline bool encoded_rotation_component_flips_on_reflection(int component, int axis, int dim)
{
    return axis >= 0 && (dim == 2 ? component == 1 || component == 2 : component < 3 && component != axis);
}

#endif
