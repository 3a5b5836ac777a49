/* Adds hints at keys of an input file that have no effect, and at materials of which no body consists. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "check_parts.h"

static bool without_bonds(const struct scene *s) { return s->method == METHOD_MPM && !s->lattice_constants; }
static bool without_points(const struct scene *s) { return s->method == METHOD_PD; }
static bool without_conversion(const struct scene *s) { return s->method != METHOD_ADAPTIVE; }
static bool without_solver(const struct scene *s) { return scene_is_dynamic(s); }
static bool without_iterations(const struct scene *s) { return scene_has_load_steps(s); }
static bool with_given_step(const struct scene *s) { return s->time_step > 0; }
static bool with_regular_lattice(const struct scene *s) { return !(s->irregularity > 0); }
static bool without_opening(const struct scene *s) { return s->steps.control != CONTROL_OPENING; }
static bool without_tips(const struct scene *s) { return !scene_can_have_cracks(s) || !scene_is_dynamic(s); }

/* Returns true if scene s (the input file) makes no time steps, neither from the start nor after an unstable crack
 * increment. */
static bool without_time_steps(const struct scene *s)
{
    return scene_is_single_equilibrium(s) || (scene_has_load_steps(s) && s->steps.then != THEN_EXPLICIT);
}

/* Returns true if no peridynamic particles of the scene s (the input file) can be in contact, so that keys of contact
 * have no effect. */
static bool without_contact(const struct scene *s)
{
    return s->method == METHOD_MPM || (s->contact_between == CONTACT_NONE && s->rigids == 0);
}

/* Keys of the input file that have no effect if `idle` is true for it, and the reason `why`. keys: names of keys, or of
 * groups of keys, which end with a point, separated by bars. Keys with a warning of their own are left out: mpm.levels,
 * mpm.fill, conversion.notch. */
static const struct {
    const char *keys;
    bool (*idle)(const struct scene *s);
    const char *why;
} idle_keys[] = {
    {"pd.|particles.horizon|model", without_bonds, "method mpm has no bonds"},
    {"mpm.cell|mpm.shape|mpm.transfer|mpm.frame|mpm.strain|mpm.constants|mpm.origin", without_points,
     "method pd has no material points"},
    {"coupling|interface_damping|conversion.stress|conversion.alpha|conversion.block|conversion.criteria|"
     "conversion.tips|conversion.reversion|conversion.hold_time|conversion.low_stress|pd.region|contact.convert",
     without_conversion, "only points of method adaptive become peridynamic"},
    {"contact.law|contact.distance|contact.stiffness", without_contact, "no particles with bonds have contact"},
    {"solver_tolerance|solver_steps", without_solver, "solver: explicit does not iterate"},
    {"solver_steps", without_iterations, "load steps have their own limit"},
    {"time.step|time.safety", without_time_steps, "the solver makes no time steps"},
    {"time.safety", with_given_step, "time.step is given"},
    {"particles.seed", with_regular_lattice, "particles.irregularity is 0"},
    {"steps.from|steps.to|steps.opening", without_opening, "steps.control is not opening"},
    {"crack.speed_window", without_tips, "no crack grows in time"},
};

/* Returns true if the key `name` is in `keys`, a list of keys and groups of keys (which end with a point) separated by
 * bars. */
static bool key_listed(const char *keys, const char *name)
{
    for (const char *key = keys; *key; key += strspn(key, "|")) {
        const size_t length = strcspn(key, "|");
        const bool group = key[length - 1] == '.';
        if (strncmp(key, name, length) == 0 && (group || name[length] == '\0')) return true;
        key += length;
    }
    return false;
}

static bool scene_gives(const struct scene *s, const char *key)
{
    for (int64_t k = 0; k < s->key_places; k++)
        if (strcmp(s->key_place[k].key, key) == 0) return true;
    return false;
}

/* Returns true if scene s gives a key of every group, as the scene.yaml of a run does: such a file has all keys,
 * whether they have an effect or not. */
static bool scene_gives_all(const struct scene *s)
{
    static const char *const keys[] = {"solver_tolerance", "steps.number",     "pd.volume",  "mpm.cell",
                                       "conversion.alpha", "contact.distance", "time.safety"};
    bool all = true;
    for (size_t k = 0; k < COUNT_OF(keys); k++) all = all && scene_gives(s, keys[k]);
    return all;
}

/* Returns true if a row of the table idle_keys before row number `row` has reported the key: if it names the key, and
 * its condition is true for scene s (the input file). */
static bool key_is_named_before(const struct scene *s, size_t row, const char *key)
{
    bool named = false;
    for (size_t k = 0; k < row; k++) named = named || (idle_keys[k].idle(s) && key_listed(idle_keys[k].keys, key));
    return named;
}

/* Appends to text[capacity] the keys in row number `row` of idle_keys (table of keys without effect in some input
 * files) that scene s (the input file) gives, without those that an earlier row has reported, and why they have no
 * effect. Appends nothing if no key remains. Keys are left out once only 300 characters of the text are free. used:
 * present length of the text. Returns the new length. */
static size_t idle_row_append(const struct scene *s, size_t row, char *text, size_t capacity, size_t used)
{
    const size_t before = used;
    for (int64_t k = 0; k < s->key_places && used + 300 < capacity; k++) {
        const char *key = s->key_place[k].key;
        if (!key_listed(idle_keys[row].keys, key) || key_is_named_before(s, row, key)) continue;
        used += (size_t)snprintf(text + used, capacity - used, "%s%s",
                                 used > before ? ", "
                                 : before > 0  ? "; "
                                               : "",
                                 key);
    }
    if (used > before) used += (size_t)snprintf(text + used, capacity - used, " (%s)", idle_keys[row].why);
    return used;
}

/* Adds a hint to *to for each material of scene s (the input file) that has a fracture criterion although the method is
 * mpm, which has no bonds that could break. */
static void hint_unbreakable(const struct scene *s, struct warnings *to)
{
    for (int m = 0; m < s->materials && s->method == METHOD_MPM; m++)
        if (isfinite(s->material[m].critical_stretch))
            warnings_add_if_new(to,
                                "material %s: energy_release_rate, toughness or critical_stretch has no effect: method "
                                "mpm has no bonds that break; set method: adaptive or pd",
                                s->material[m].name);
}

/* Adds a hint to *to for each material of scene s (the input file) of which no body consists. */
static void hint_unused_materials(const struct scene *s, struct warnings *to)
{
    for (int m = 0; m < s->unused_materials; m++)
        warnings_add_if_new(to, "material %s: no body consists of this material; remove it, or name it in a body",
                            s->material[s->materials + m].name);
}

void hint_keys_without_effect(const struct scene *s, struct warnings *warning_list)
{
    char text[2000] = "";
    size_t used = 0;
    hint_unused_materials(s, warning_list);
    hint_unbreakable(s, warning_list);
    if (scene_gives_all(s)) return;
    for (size_t row = 0; row < COUNT_OF(idle_keys); row++)
        if (idle_keys[row].idle(s)) used = idle_row_append(s, row, text, sizeof text, used);
    if (used > 0) warnings_add_if_new(warning_list, "keys without effect in this scene (remove them): %s", text);
}
