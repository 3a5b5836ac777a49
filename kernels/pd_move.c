/* floor 2: leap-frog step of the peridynamic particles: v += dt f/m, x += dt v (Zeng et al. 2022, eq. 21). Moves 56
 * bytes a particle in 2D: x, v read and written, f and m read. */
#include "kernels.h"
#include "variants.h"

static ALWAYS_INLINE void pd_move_particle(struct particles *p, int64_t i, real dt, real dt_velocity, const int dim)
{
    const real inverse_mass = dt_velocity / p->mass[i];
    for (int d = 0; d < dim; d++) {
        p->v[d][i] += p->f[d][i] * inverse_mass;
        p->x[d][i] += p->v[d][i] * dt;
    }
}

#define INSTANCE(D)                                                                                          \
    static void pd_move_##D##d(struct particles *p, const struct bonds *b, real dt, real dt_velocity)        \
    {                                                                                                        \
        const bool all = p->n_of[KIND_PD] == p->n && p->n_carried == 0;      /* no list, whole vectors */    \
        _Pragma("omp parallel for schedule(static)")                                                         \
        for (int64_t k = 0; k < b->rest.awake; k++) {                                                        \
            const int64_t first = rest_first(&b->rest, k), end = rest_end(&b->rest, k, b->rows);             \
            if (all) {                                                                                       \
                _Pragma("omp simd")                                                                          \
                for (int64_t i = first; i < end; i++) pd_move_particle(p, i, dt, dt_velocity, D);            \
            } else                                                                                           \
                for (int64_t row = first; row < end; row++)                                                  \
                    if (!particle_on_grid(p, b->particle[row]))                                              \
                        pd_move_particle(p, b->particle[row], dt, dt_velocity, D);                           \
        }                                                                                                    \
    }
DIM_VARIANTS(INSTANCE)

#define ENTRY(D) [D] = pd_move_##D##d,
pd_move_fn *const pd_move_table[DIM_MAX + 1] = {DIM_VARIANTS(ENTRY)};
