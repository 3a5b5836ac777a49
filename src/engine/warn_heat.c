/* Warns of temperatures that look like mistakes, and of temperatures that do not change though the material flows. */
#include "engine_internal.h"
#include "scene/fill.h"

/* Least temperature at which a test of metal starts without a warning [K]: below it are cryogenic tests, and
 * temperatures that are meant in degrees Celsius. */
#define ROOM_LEAST 150

/* Adds a warning to *to about each material of scene s whose room temperature is below ROOM_LEAST (150 K), so that it
 * seems to be in degrees Celsius. Adds none if the input file has accept: [heat]. */
static void warn_of_celsius(const struct scene *s, struct warnings *to)
{
    for (int m = 0; m < s->materials && !scene_silences_warning(s, ACCEPT_HEAT); m++) {
        const struct law *law = &s->material[m].law;
        if (!flow_law_has_room_temperature(law) || law->johnson_cook.T_room >= ROOM_LEAST) continue;
        warnings_add_if_new(to,
                            "material %s: its T_room is %.4g K, below %d K: temperatures are in kelvin, 20 degrees "
                            "Celsius are 293 K; check T_room and T_melt (%.4g K); if this is intended, add accept: "
                            "[heat]",
                            s->material[m].name, law->johnson_cook.T_room, ROOM_LEAST, law->johnson_cook.T_melt);
    }
}

/* Adds a warning to *to if two materials of scene s start at different temperatures. */
static void warn_of_different_starts(const struct scene *s, struct warnings *to)
{
    const struct material *a = &s->material[0];
    for (int m = 1; m < s->materials; m++) {
        const struct material *b = &s->material[m];
        const real first = scene_initial_temperature(s, a), other = scene_initial_temperature(s, b);
        if (first == other) continue;
        warnings_add_if_new(to,
                            "materials %s and %s start at %.5g K and %.5g K, their T_room, and without conduction the "
                            "difference remains: give both the same johnson_cook.T_room if they start at one "
                            "temperature",
                            a->name, b->name, first, other);
        return;
    }
}

/* Adds a warning to *to about each material of scene s that yields but is not heated, so that its temperature stays
 * that of the start. */
static void warn_of_flow_without_heat(const struct scene *s, struct warnings *to)
{
    for (int m = 0; m < s->materials; m++) {
        const struct material *a = &s->material[m];
        if (!a->law.given || flow_law_plastic_work_heats_material(&a->law)) continue;
        warnings_add_if_new(to,
                            "material %s yields but is not heated, so its temperature stays at %.5g K: if heating by "
                            "plastic work matters, give it johnson_cook with specific_heat",
                            a->name, scene_initial_temperature(s, a));
    }
}

void run_warn_of_suspicious_temperatures(const struct scene *s, const struct particles *p, struct warnings *warnings)
{
    warn_of_celsius(s, warnings);
    if (!p->temperature) return;
    warn_of_different_starts(s, warnings);
    warn_of_flow_without_heat(s, warnings);
}
