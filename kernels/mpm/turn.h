/* Computes the velocity gradient by which points of rotating groups (data/turning.h) extrapolate their velocity to
 * nodes. */
#ifndef CLEAVE_KERNELS_TURN
#define CLEAVE_KERNELS_TURN

#include "kernels/kernels.h"
#include "row.h"

/* Returns the derivative [1/s] of velocity component `component` along axis `axis` by which a few points extrapolate
 * their velocity to nodes. spin: angular velocity w of the rotating group of each point [1/s], in the plane spin[2]
 * alone. The leap-frog velocity v = (x' - x)/dt is along a chord of the circle of rotation: v = w x r - time_part w x
 * (w x r). time_part: dt/2 for r at the end of the step, -dt/2 at its start [s]. Without the second-order term rotating
 * bodies shrink: a square by 0.2 % per turn at 4000 1/s. */
static ALWAYS_INLINE row_of_points rotating_group_velocity_gradient_component(const row_of_points *spin,
                                                                              const real time_part, int component,
                                                                              int axis, const int dim)
{
    if (dim == 2) return component == axis ? time_part * (spin[2] * spin[2]) : component < axis ? -spin[2] : spin[2];
    const row_of_points mixed = -time_part * spin[component] * spin[axis];
    if (component != axis)
        return mixed + (axis == (component + 1) % 3 ? -spin[3 - component - axis] : spin[3 - component - axis]);
    return mixed + time_part * (spin[0] * spin[0] + spin[1] * spin[1] + spin[2] * spin[2]);
}

/* Computes the velocity gradients slope[d dim + e] = dv_d/dx_e [1/s] of AT_ONCE(dim) points (processed together) that
 * rotate with their groups. point: numbers of the points; t: inputs of the transfer, with the spins t->turn; time_part:
 * the part of a time step over which they turn (rotating_group_velocity_gradient_component) [s]. */
static ALWAYS_INLINE void rotating_group_velocity_gradients_of_points(const struct transfer_data *t,
                                                                      const int32_t *point, const real time_part,
                                                                      row_of_points *slope, const int dim)
{
    row_of_points w[3];
    for (int c = dim == 2 ? 2 : 0; c < 3; c++) w[c] = points_gather_values(t->turn[c], point, dim);
#pragma GCC unroll 9
    for (int k = 0; k < dim * dim; k++)
        slope[k] = rotating_group_velocity_gradient_component(w, time_part, k / dim, k % dim, dim);
}

#endif
