/* Defines the kernels of the leap-frog step of peridynamic particles, one for each dimension. A step transfers 72 bytes
 * per particle in 2D: positions and velocities are read and written, forces and masses read. */
#include "pd_move.h"
#include "kernels/simd/variants.h"

#define INSTANCE(D)                                                                                                    \
    static bool pd_move_##D##d(struct particles *p, const int32_t *list, int64_t n, const struct pd_motion *m)         \
    {                                                                                                                  \
        int64_t diverged = 0;                                                                                          \
        if (n == 0) return false;                                                                                      \
        _Pragma("omp parallel for schedule(static) reduction(+ : diverged)") for (int64_t k = 0; k < n; k += LANES)    \
        {                                                                                                              \
            _Alignas(sizeof(lanes)) int32_t room[LANES];                                                               \
            diverged += pd_advance_up_to_eight_particles(p, list_get_eight_padded_entries(list, k, n, room),           \
                                                         count_of_next_eight_indices_below_limit(k, n), NULL, m, D);   \
        }                                                                                                              \
        return diverged > 0;                                                                                           \
    }
DIM_VARIANTS(INSTANCE)

#define ENTRY(D) [D] = pd_move_##D##d,
pd_move_fn *const pd_move_table[DIM_MAX + 1] = {DIM_VARIANTS(ENTRY)};
