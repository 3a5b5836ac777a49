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

/* The rows of a group that the grid does not move; where all are peridynamic, row i is particle i: no list, whole vectors. */
static ALWAYS_INLINE void pd_move_group(struct particles *p, const struct bonds *b, int64_t g, bool all, real dt, real dt_velocity, const int dim)
{
    if (all && (g + 1) * LANES <= b->rows) {
        _Pragma("omp simd") for (int l = 0; l < LANES; l++) pd_move_particle(p, g * LANES + l, dt, dt_velocity, dim);
        return;
    }
    for (int64_t row = g * LANES; row < b->rows && row < (g + 1) * LANES; row++)
        if (!particle_on_grid(p, b->particle[row])) pd_move_particle(p, b->particle[row], dt, dt_velocity, dim);
}

#define INSTANCE(D)                                                                                          \
    static void pd_move_##D##d(struct particles *p, const struct bonds *b, real dt, real dt_velocity)        \
    {                                                                                                        \
        const bool all = p->n_of[KIND_PD] == p->n && p->n_carried == 0;                                      \
        _Pragma("omp parallel for schedule(static)")                                                         \
        for (int64_t k = 0; k < b->rest.awake; k++)                                                          \
            pd_move_group(p, b, b->rest.list[k], all, dt, dt_velocity, D);                                   \
    }
DIM_VARIANTS(INSTANCE)

#define ENTRY(D) [D] = pd_move_##D##d,
pd_move_fn *const pd_move_table[DIM_MAX + 1] = {DIM_VARIANTS(ENTRY)};
