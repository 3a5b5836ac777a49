/* Tests in every time step whether a particle has diverged, i.e. is too fast or has a position or velocity that is not
 * finite. If one has, the run stops, and diagnostics.c finds the particle. The test reads 32 bytes per particle in
 * 2D. */
#include "divergence.h"
#include "kernels.h"
#include "kernels/simd/variants.h"

/* Returns a mask with one lane for each of the eight particles p[list[0 .. 7]]. A lane is set if its particle has
 * diverged: its speed is above the limit, or a component of its position or velocity is not finite. limit2: square of
 * the speed limit [m^2/s^2]; dim: dimensions of space. */
static ALWAYS_INLINE lanes_mask eight_diverged(const struct particles *p, const int32_t *list, real limit2,
                                               const int dim)
{
    const int32_t first = list_is_consecutive(list) ? list[0] : -1;
    lanes speed2 = lanes_broadcast(0), place = lanes_broadcast(0);
    for (int d = 0; d < dim; d++) {
        const lanes v = lanes_load_or_gather(p->v[d], first, list);
        speed2 += v * v;
        place += lanes_absolute(lanes_load_or_gather(p->x[d], first, list));
    }
    return lanes_mask_of_diverged_particles(speed2, place, limit2);
}

/* Returns true if any of the n particles of p whose indices are in `list` has diverged: its speed is above the limit,
 * or a component of its position or velocity is not finite. limit2: square of the speed limit [m^2/s^2]; dim:
 * dimensions of space. */
static ALWAYS_INLINE bool any_diverged(const struct particles *p, const int32_t *list, int64_t n, real limit2,
                                       const int dim)
{
    int64_t found = 0;
#pragma omp parallel for schedule(static) reduction(+ : found)
    for (int64_t k = 0; k < n; k += LANES) {
        _Alignas(sizeof(lanes)) int32_t room[LANES];
        found += lanes_mask_any(eight_diverged(p, list_get_eight_padded_entries(list, k, n, room), limit2, dim));
    }
    return found > 0;
}

bool particles_diverged(const struct particles *p, const int32_t *list, int64_t n, real limit)
{
#define CASE(D)                                                                                                        \
    case D:                                                                                                            \
        return any_diverged(p, list, n, limit * limit, D);
    switch (p->dim) {
        DIM_VARIANTS(CASE)
    }
    return false;
}
