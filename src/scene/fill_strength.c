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

/* Returns true if the flow law `law` has a room temperature. */
static bool has_room_temperature(const struct law *law) { return law->given && law->flow == FLOW_JOHNSON_COOK; }

/* Returns the temperature at which materials without a room temperature start [K]: that of the first material of scene
 * s that has one, or else ROOM_TEMPERATURE. */
static real room_temperature(const struct scene *s)
{
    for (int m = 0; m < s->materials; m++)
        if (has_room_temperature(&s->material[m].law)) return s->material[m].law.johnson_cook.T_room;
    return ROOM_TEMPERATURE;
}

void fill_set_initial_temperatures(struct particles *p, const struct scene *s)
{
    if (!p->temperature) return;
    const real room = room_temperature(s);
#pragma omp parallel for schedule(static)
    for (int64_t i = 0; i < p->n; i++) {
        const struct law *law = &s->material[p->material[i]].law;
        p->temperature[i] = has_room_temperature(law) ? law->johnson_cook.T_room : room;
    }
}
