/* Sets the strength of particles of materials whose strength scatters in space, and initial temperatures. */
#include "scene/fill.h"

void fill_set_particle_strength_factors(struct particles *p, const struct scene *s)
{
    if (!p->strength) return;
#pragma omp parallel for schedule(static)
    for (int64_t i = 0; i < p->n; i++) {
        real X[DIM_MAX];
        particle_reference_position(p, i, X);
        p->strength[i] = scatter_strength_factor(&s->material[p->material[i]].scatter, X, p->dim, p->id[i]);
    }
}

void fill_set_initial_temperatures(struct particles *p, const struct scene *s)
{
    if (!p->temperature) return;
#pragma omp parallel for schedule(static)
    for (int64_t i = 0; i < p->n; i++) {
        const struct law *law = &s->material[p->material[i]].law;
        const bool own = law->given && law->flow == FLOW_JOHNSON_COOK;
        p->temperature[i] = own ? law->johnson_cook.T_room : ROOM_TEMPERATURE;
    }
}
