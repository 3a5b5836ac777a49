/* Names of all figures that summary.json of a run may have, by which a wrong one is refused before anything runs. */
#include <ctype.h>
#include <stdio.h>
#include <string.h>

#include "base/edit_distance.h"
#include "study/study.h"

enum { LEAF_ROOM = 40, NAME_ROOM = 160 };

/* Figures of a group, with blanks between them; group "": of the run. `#` in a group stands for a number. */
static const struct figure_group { const char *group, *leaves; } groups[] = {
    {"", "steps time_step time_step_critical time_end particles particles_made particles_pd_start particles_pd_end "
         "bonds_peak momentum_error threads wall_seconds loop_seconds memory_peak_bytes ns_per_particle_step "
         "ns_per_bond_step rest_share"},
    {"levels", "changes"},
    {"solver", "steps residual bonds_past_limit"},
    {"load_steps", "steps load_time equilibria directions overload bonds_broken released crack_area release_rate"},
    {"energy", "kinetic strain plastic fracture contact damped absorbed external_work balance_error"},
    {"contact", "began ended nodes_max pairs_max friction_work overlap_max"},
    {"rigid.#", "x y z velocity_x velocity_y velocity_z force_max patch"},
    {"fragments", "count mass_max particles_alone mass_alone"},
    {"crack", "start_time start_step driven_start_time driven_start_step driven_bonds tip_start_time tip_start_step "
              "arrest_time arrest_step length_end angle_deg tied tip_speed_max tip_speed_mean"},
    {"crack.tips.#", "body origin_x origin_y origin_z x y z growth angle_deg start_time start_step arrest_time "
                     "arrest_step speed_max speed_mean"},
    {"conversion", "first_time x y z pd_share_start pd_share_end pd_share_max converted returned returns_most "
                   "return_energy"},
};

/* Quantities of all kinds of probes; those of points also with _min and _max, as of lines. */
static const char probe_leaves[] =
    "x y z tied start_time arrest_time length_end angle_deg speed_max speed_mean first_step first_time bonds force_max "
    "force_max_displacement force_max_step force_rms displacement residual_max position time speed speed_rest kinetic "
    "strain fracture reflected transmitted energy_change L1 L2 front plateau end_displacement front_plastic "
    "strain_elastic strain_plastic L1_strain L2_strain front_strain plateau_strain L1_velocity L2_velocity "
    "L2_displacement K_I K_II J contour_spread direction_deg experiment_deg angle stress_max shear_max "
    "angular_momentum_error kinetic_energy_error displacement_x displacement_y displacement_z velocity_x velocity_y "
    "velocity_z stress_xx stress_yy stress_zz stress_xy stress_yz stress_xz stress_zx damage";

/* The nearest name so far. */
struct nearest { const char *to; char name[NAME_ROOM]; int distance; };

static void nearest_offer(struct nearest *n, const char *group, const char *leaf)
{
    char name[NAME_ROOM];
    snprintf(name, sizeof name, "%s%s%s", group, *group ? "." : "", leaf);
    const int distance = edit_distance(n->to, name);
    if (distance < n->distance) n->distance = distance, snprintf(n->name, sizeof n->name, "%s", name);
}

/* Returns true if `leaf` is one of the leaves; offers each of them as the nearest name. */
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

/* The name with `#` in place of whole numbers between points. */
static void numbers_hidden(char *to, size_t room, const char *name)
{
    size_t n = 0;
    for (const char *c = name; *c && n + 1 < room; c++) {
        const bool number = isdigit((unsigned char)*c) && (c == name || c[-1] == '.');
        const size_t digits = number ? strspn(c, "0123456789") : 0;
        to[n++] = digits > 0 && c[digits] == '.' ? '#' : *c;
        if (to[n - 1] == '#') c += digits - 1;
    }
    to[n] = '\0';
}

/* Is it a figure of a probe of the scene? `group`: the name before its last point. */
static bool probe_has(const struct scene *s, const char *group, const char *leaf, struct nearest *n)
{
    char own[NAME_ROOM], bare[LEAF_ROOM];
    bool known = false;
    const size_t length = strlen(leaf);
    const bool range = length > 4 && (!strcmp(leaf + length - 4, "_min") || !strcmp(leaf + length - 4, "_max"));
    snprintf(bare, sizeof bare, "%.*s", (int)(length - (range ? 4 : 0)), leaf);
    for (int k = 0; k < s->probes; k++) {
        snprintf(own, sizeof own, "probes.%s", s->probe[k].name);
        const bool there = leaf_is_known(probe_leaves, own, leaf, n);
        if (strcmp(own, group) == 0) known |= there || (range && leaf_is_known(probe_leaves, own, bare, n));
    }
    return known;
}

status figure_name_check(const struct scene *s, const char *name)
{
    char hidden[NAME_ROOM], group[NAME_ROOM];
    struct nearest n = {.to = name, .distance = 1000};
    numbers_hidden(hidden, sizeof hidden, name);
    const char *dot = strrchr(hidden, '.'), *leaf = dot ? dot + 1 : hidden;
    snprintf(group, sizeof group, "%.*s", dot ? (int)(dot - hidden) : 0, hidden);
    bool known = strncmp(hidden, "levels.cells.", 13) == 0;
    for (size_t k = 0; k < COUNT_OF(groups); k++) {
        const bool there = leaf_is_known(groups[k].leaves, groups[k].group, leaf, &n);
        known |= there && strcmp(groups[k].group, group) == 0;
    }
    dot = strrchr(name, '.');
    snprintf(group, sizeof group, "%.*s", dot ? (int)(dot - name) : 0, name);
    known |= probe_has(s, group, dot ? dot + 1 : name, &n);
    if (known) return OK;
    return status_set(REFUSED,
                      "%.80s: summary.json has no such figure; the nearest is %s, and names in it are joined by "
                      "points, as in crack.angle_deg",
                      name, n.name);
}
