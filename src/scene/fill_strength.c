/* Sets the strength of particles of materials whose strength scatters in space, and initial temperatures. */
#include "scene/fill.h"

void particles_set_strength_factors(struct particles *p, const struct scene *s)
{
    if (!p->strength) return;
#pragma omp parallel for schedule(static)
    for (int64_t i = 0; i < p->n; i++) {
        real X[DIM_MAX];
        particle_reference_position(p, i, X);
        p->strength[i] = scatter_strength_factor(&s->material[p->material[i]].scatter, X, p->dim, p->id[i]);
    }
}

real scene_initial_temperature(const struct scene *s, const struct material *material)
{
    if (flow_law_has_room_temperature(&material->law)) return material->law.johnson_cook.T_room;
    for (int m = 0; m < s->materials; m++)
        if (flow_law_has_room_temperature(&s->material[m].law)) return s->material[m].law.johnson_cook.T_room;
    return ROOM_TEMPERATURE;
}

void particles_set_initial_temperatures(struct particles *p, const struct scene *s)
{
    if (!p->temperature) return;
#pragma omp parallel for schedule(static)
    for (int64_t i = 0; i < p->n; i++) p->temperature[i] = scene_initial_temperature(s, &s->material[p->material[i]]);
}
