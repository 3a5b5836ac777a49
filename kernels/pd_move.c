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

#define INSTANCE(D)                                                                          \
    static void pd_move_##D##d(struct particles *p, real dt, real dt_velocity)               \
    {                                                                                        \
        if (p->n_of[KIND_PD] == p->n && p->n_carried == 0) {        /* all of them: no list, whole vectors */     \
            _Pragma("omp parallel for simd schedule(static)")                                \
            for (int64_t i = 0; i < p->n; i++) pd_move_particle(p, i, dt, dt_velocity, D);   \
            return;                                                                          \
        }                                                                                    \
        _Pragma("omp parallel for schedule(static)")                                         \
        for (int64_t k = 0; k < p->n_of[KIND_PD]; k++)                                       \
            if (!(p->flag[p->list[KIND_PD][k]] & FLAG_CARRIED))                              \
                pd_move_particle(p, p->list[KIND_PD][k], dt, dt_velocity, D);                \
    }
DIM_VARIANTS(INSTANCE)

#define ENTRY(D) [D] = pd_move_##D##d,
pd_move_fn *const pd_move_table[DIM_MAX + 1] = {DIM_VARIANTS(ENTRY)};
