/* Lists the names of all results that summary.json of a run may have, so that a wrong name is refused before anything
 * runs. */
#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/edit_distance.h"
#include "output/renamed_results.h"
#include "scene/scene_read.h"
#include "study/study.h"

/* LEAF_ROOM: capacity of the last part of the name of a result (a number in summary.json). NAME_ROOM: capacity of its
 * whole name [byte]. */
enum { LEAF_ROOM = 40, NAME_ROOM = 160 };

/* Returns true if summary.json of runs of the scene s contains numbers on contact. */
static bool of_contact(const struct scene *s)
{
    return s->contact_between != CONTACT_NONE || scene_bodies_can_come_into_contact(s);
}

/* Returns true if summary.json of runs of the scene s contains numbers on fragments. */
static bool of_fragments(const struct scene *s) { return scene_is_dynamic(s) && scene_can_have_cracks(s); }

/* Names of the numbers in summary.json, grouped by the part of the name before the last point. group: this part, with
 * # in place of whole numbers; "" for names without a point; leaves: possible parts after the last point, separated by
 * blanks; had: returns true if runs of scene s have these numbers, NULL: all runs have them; needs: what the input
 * file (scene) requires to have them, for messages. */
static const struct figure_group {
    const char *group, *leaves;
    bool (*had)(const struct scene *s);
    const char *needs;
} groups[] = {
    {"",
     "steps time_step time_step_critical time_end particles particles_made particles_pd_start particles_pd_end "
     "bonds_peak momentum_error angular_momentum_error threads wall_seconds setup_seconds loop_seconds "
     "output_seconds memory_peak_bytes ns_per_particle_step ns_per_bond_step inactive_share",
     NULL, NULL},
    {"levels", "changes", NULL, NULL},
    {"solver", "steps residual bonds_past_limit", scene_is_single_equilibrium, "`solver: relaxation` or `cg`"},
    {"load_steps",
     "steps load_time equilibria search_directions stretch_ratio bonds_broken released crack_area release_rate",
     scene_has_load_steps, "`solver: static`"},
    {"energy", "kinetic strain plastic fracture contact damped absorbed external_work balance_error", NULL, NULL},
    {"contact", "began ended nodes_max pairs_max friction_work overlap_max", of_contact, "bodies in contact"},
    {"rigid.#", "x y z velocity_x velocity_y velocity_z force_max patch", NULL, NULL},
    {"fragments", "count mass_max particles_alone mass_alone", of_fragments, "bonds that break in time, or cracks"},
    {"crack",
     "start_time start_step driven_start_time driven_start_step driven_bonds tip_start_time tip_start_step "
     "arrest_time arrest_step length_end angle_deg tied tip_speed_max tip_speed_mean",
     scene_can_have_cracks, "cracks or bonds that break"},
    {"crack.tips.#",
     "body origin_x origin_y origin_z x y z growth angle_deg start_time start_step arrest_time "
     "arrest_step speed_max speed_mean",
     scene_can_have_cracks, "cracks or bonds that break"},
    {"conversion",
     "first_time x y z pd_share_start pd_share_end pd_share_max converted reverted reversions_most "
     "reversion_energy",
     NULL, NULL},
};

#define READINGS(end)                                                                                                  \
    "displacement_x" end " displacement_y" end " displacement_z" end " velocity_x" end " velocity_y" end               \
    " velocity_z" end " stress_xx" end " stress_yy" end " stress_zz" end " stress_xy" end " stress_yz" end             \
    " stress_zx" end " damage" end

/* Names of the numbers that each kind of probe writes to summary.json, without the name of the probe, separated by
 * blanks. READINGS(e): quantities of a point, each name with the ending e; tied: number of equally long tips or
 * simultaneous breaks, among which the position is arbitrary; speed_rest: mean speed of the other part. */
static const char *const probe_leaves[PROBES] = {
    [PROBE_TIP] = "x y z tied start_time arrest_time length_end angle_deg speed_max speed_mean",
    [PROBE_BREAK] = "x y z tied first_step first_time bonds",
    [PROBE_REACTION] = "force_max force_max_displacement force_max_step force_rms displacement",
    [PROBE_PATCH] = "residual_max",
    [PROBE_SPALL] = "position time speed speed_rest",
    [PROBE_POINT] = READINGS(""),
    [PROBE_LINE] = READINGS("_min") " " READINGS("_max"),
    [PROBE_ENERGY] = "kinetic strain fracture",
    [PROBE_MOMENTUM] = "x y z",
    [PROBE_PULSE] = "reflected transmitted energy_change",
    [PROBE_EXACT] = "L1 L2 front plateau end_displacement front_plastic strain_elastic strain_plastic L1_strain "
                    "L2_strain front_strain plateau_strain L1_velocity L2_velocity L2_displacement",
    [PROBE_SIF] = "K_I K_II J contour_spread",
    [PROBE_GROWTH] = "x y z start_time length_end angle_deg direction_deg experiment_deg",
    [PROBE_RIGID] = "angle stress_max shear_max angular_momentum_error kinetic_energy_error",
};

/* Search for the known name most similar to the misspelt name `to`: the most similar one found so far and its edit
 * distance. */
struct nearest {
    const char *to;
    char name[NAME_ROOM];
    int distance;
};

/* Compares the known name GROUP.LEAF, with GROUP = group and LEAF = leaf, with the misspelt name n->to. Stores the
 * known name in n->name, and its edit distance in n->distance, if it is more similar than the name stored there so
 * far. */
static void nearest_offer(struct nearest *n, const char *group, const char *leaf)
{
    char name[NAME_ROOM];
    snprintf(name, sizeof name, "%s%s%s", group, *group ? "." : "", leaf);
    const int distance = edit_distance(n->to, name);
    if (distance < n->distance) n->distance = distance, snprintf(n->name, sizeof n->name, "%s", name);
}

/* Returns true if `leaf` is one of the blank-separated words of `leaves`, the names that the numbers of a group in
 * summary.json have after the last point. Also compares the name GROUP.WORD for each of the words with the misspelt
 * name in *n, to find the most similar one. */
static bool leaf_is_known(const char *leaves, const char *group, const char *leaf, struct nearest *n)
{
    bool known = false;
    char one[LEAF_ROOM];
    for (; *leaves; leaves += strcspn(leaves, " "), leaves += strspn(leaves, " ")) {
        snprintf(one, sizeof one, "%.*s", (int)strcspn(leaves, " "), leaves);
        known |= strcmp(one, leaf) == 0;
        nearest_offer(n, group, one);
    }
    return known;
}

/* Copies a name to to[capacity] with # in place of each whole number between points, for example rigid.#.x for
 * rigid.0.x. A text too long is truncated. */
static void numbers_hidden(char *to, size_t capacity, const char *name)
{
    size_t n = 0;
    for (const char *c = name; *c && n + 1 < capacity; c++) {
        const bool number = isdigit((unsigned char)*c) && (c == name || c[-1] == '.');
        const size_t digits = number ? strspn(c, "0123456789") : 0;
        to[n++] = digits > 0 && c[digits] == '.' ? '#' : *c;
        if (to[n - 1] == '#') c += digits - 1;
    }
    to[n] = '\0';
}

/* Returns true if `group` is probes.NAME for a probe NAME of the scene s that writes a number called `leaf` to
 * summary.json. Also compares the names of the numbers of all probes with the misspelt name in *n, to find the most
 * similar one. */
static bool probe_has(const struct scene *s, const char *group, const char *leaf, struct nearest *n)
{
    char own[NAME_ROOM];
    bool known = false;
    for (int k = 0; k < s->probes; k++) {
        snprintf(own, sizeof own, "probes.%s", s->probe[k].name);
        const bool there = leaf_is_known(probe_leaves[s->probe[k].kind], own, leaf, n);
        known |= there && strcmp(own, group) == 0;
    }
    return known;
}

/* Returns what the scene s must be so that it has the axes to which a number of summary.json refers, as a phrase for a
 * message ("a solid", "a plane or a solid"); NULL if it has them. leaf: last part of the name of the number, such as
 * velocity_y or stress_zx_max, whose letters x, y and z name the axes. */
static const char *axes_lack(const struct scene *s, const char *leaf)
{
    char axes[LEAF_ROOM];
    snprintf(axes, sizeof axes, "%s", leaf);
    const size_t length = strlen(axes);
    if (length > 4 && (!strcmp(axes + length - 4, "_min") || !strcmp(axes + length - 4, "_max")))
        axes[length - 4] = '\0';
    const char *line = strrchr(axes, '_'), *own = line ? line + 1 : axes;
    const size_t letters = strspn(own, "xyz");
    if (letters == 0 || own[letters]) return NULL;
    const bool across = !strcmp(own, "zz") && s->space == SPACE_PLANE_STRAIN;
    if (strchr(own, 'y') && s->dim < 2) return "a plane or a solid";
    return strchr(own, 'z') && s->dim < 3 && !across ? "a solid" : NULL;
}

/* Returns a phrase for a message that names the solver which a number of summary.json requires, or NULL if the scene s
 * has this solver. leaf: last part of the name of the number. Names that end in _step require load steps; names of
 * times and speeds require a solver in time. */
static const char *clock_lacks(const struct scene *s, const char *leaf)
{
    const char *end = strrchr(leaf, '_');
    const bool step = end && !strcmp(end, "_step"), time = end && !strcmp(end, "_time"), speed = strstr(leaf, "speed_");
    if (step && !scene_has_load_steps(s)) return "`solver: static`";
    return (time || speed) && scene_has_load_steps(s) ? "`solver: explicit`: load steps have a pseudo-time only" : NULL;
}

/* Returns a phrase for a message that says what the scene s must have so that its runs write the number called `name`
 * to summary.json, or NULL if they write it. The name must be known. group: its part before the last point, with # in
 * place of whole numbers; leaf: its part after the last point. */
static const char *figure_lacks(const struct scene *s, const char *group, const char *name, const char *leaf)
{
    const bool crack = strncmp(group, "crack", 5) == 0, probe = strncmp(group, "probes.", 7) == 0;
    const bool body = crack || probe || strncmp(group, "rigid.", 6) == 0 || strcmp(group, "conversion") == 0;
    const char *lacks = NULL;
    for (size_t k = 0; k < COUNT_OF(groups) && !lacks; k++)
        if (strcmp(groups[k].group, group) == 0 && groups[k].had && !groups[k].had(s)) lacks = groups[k].needs;
    if (!lacks && strcmp(group, "rigid.#") == 0 && atoi(name + 6) >= s->rigids) lacks = "as many rigid bodies";
    if (!lacks && (crack || probe)) lacks = clock_lacks(s, leaf);
    return lacks || !body ? lacks : axes_lack(s, leaf);
}

status result_name_check_is_known(const struct scene *s, const char *name)
{
    const char *now = renamed_result_find_current_name(name);
    if (now) fprintf(stderr, "warning: the figure %s has been renamed; use %s\n", name, now), name = now;
    char hidden[NAME_ROOM], group[NAME_ROOM];
    struct nearest n = {.to = name, .distance = 1000};
    numbers_hidden(hidden, sizeof hidden, name);
    const char *dot = strrchr(hidden, '.'), *leaf = dot ? dot + 1 : hidden;
    snprintf(group, sizeof group, "%.*s", dot ? (int)(dot - hidden) : 0, hidden);
    bool known = strncmp(hidden, "levels.cells.", 13) == 0 || strncmp(hidden, "laps.", 5) == 0;
    for (size_t k = 0; k < COUNT_OF(groups); k++) {
        const bool there = leaf_is_known(groups[k].leaves, groups[k].group, leaf, &n);
        known |= there && strcmp(groups[k].group, group) == 0;
    }
    const char *lacks = known ? figure_lacks(s, group, name, leaf) : NULL;
    dot = strrchr(name, '.');
    snprintf(group, sizeof group, "%.*s", dot ? (int)(dot - name) : 0, name);
    if (probe_has(s, group, dot ? dot + 1 : name, &n)) {
        known = true;
        lacks = figure_lacks(s, group, name, dot + 1);
    }
    if (known && !lacks) return OK;
    if (known)
        return status_set(REFUSED, "%.80s: runs of this scene do not have this figure, which needs %s", name, lacks);
    const bool similar = n.distance <= (int)strlen(n.name) / 2;
    for (char *number = n.name; (number = strchr(number, '#'));) *number = '0';
    return status_set(
        REFUSED, "%.80s: summary.json has no such figure; %s%s%s (join names by points, such as crack.angle_deg)", name,
        similar ? "did you mean " : "see inputs/results.md", similar ? n.name : "", similar ? "?" : "");
}

status study_check_result_names(const struct study *s, const char *const *name, int names)
{
    for (int k = 0; k < names; k++) {
        status known = REFUSED;
        for (int c = 0; c < s->n && known == REFUSED; c++) {
            struct scene scene;
            TRY(scene_read(&scene, s->scene, s->at[c].override, s->at[c].overrides));
            known = result_name_check_is_known(&scene, name[k]);
            scene_free(&scene);
        }
        TRY(known);
    }
    return OK;
}
