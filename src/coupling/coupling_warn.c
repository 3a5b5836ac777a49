/* Warns of several bodies that pass through each other because they have no contact, and of bodies that touch at the
 * start without being joined. */
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "coupling/coupling_part.h"
#include "grid/grid_part.h"
#include "mesh/mesh_part.h"

/* Names as text: `a`, `a and b`, `a, b and c`. Only the first few names are written, the others are counted. n: names
 * written; all: total number of names. */
struct name_list {
    int n, all;
    char text[320];
};

static void name_add(struct name_list *l, const char *name)
{
    enum { NAMED = 4 };
    const size_t used = strlen(l->text);
    const bool last = ++l->n == l->all;
    if (l->n > NAMED && !last) return;
    if (l->n > NAMED && l->all > NAMED + 1)
        snprintf(l->text + used, sizeof l->text - used, " and %d more", l->all - NAMED);
    else
        snprintf(l->text + used, sizeof l->text - used, "%s%.64s", l->n == 1 ? "" : last ? " and " : ", ", name);
}

/* Adds a warning to `to` that the material points of bodies of s in the reference frame (on a mesh of the undeformed
 * body) have no contact with other bodies. It names these bodies; without such bodies, no warning is added. reference:
 * states for each body whether it is in the reference frame. */
static void warn_of_reference(const struct scene *s, const struct lagrangian_mesh *reference, struct warnings *to)
{
    struct name_list names = {0};
    for (int b = 0; b < s->bodies; b++) names.all += reference->choice[b].reference;
    if (names.all == 0) return;
    for (int b = 0; b < s->bodies; b++)
        if (reference->choice[b].reference) name_add(&names, s->body[b].name);
    warnings_add_if_new(
        to,
        "%s %s in the reference frame (mpm.frame), in which material points have no contact and pass through other "
        "bodies; set mpm.frame: current for contact; if this is intended, add accept: [contact]",
        names.text, names.all > 1 ? "are" : "is");
}

/* Adds warnings to `to` if several bodies of scene s have no contact, so that they pass through each other; the text
 * depends on the method (pd, mpm, adaptive). reference: states for each body whether it is in the reference frame (on a
 * mesh of the undeformed body); approaches: true if particles convert when bodies approach each other, so that they
 * have contact. Adds none if that is so, if the bodies cannot meet, or if the input file has accept: [contact]. */
static void warn_of_contact(const struct scene *s, const struct lagrangian_mesh *reference, bool approaches,
                            struct warnings *to)
{
    bool current = false;
    for (int b = 0; b < s->bodies; b++) current |= !reference->choice[b].reference;
    if (!scene_bodies_can_come_into_contact(s) || approaches || scene_silences_warning(s, ACCEPT_CONTACT)) return;
    if (s->method == METHOD_PD && (s->contact_between != CONTACT_NONE || scene_is_single_equilibrium(s))) return;
    if (s->method == METHOD_PD)
        warnings_add_if_new(to,
                            "contact.between is none, so peridynamic bodies pass through each other%s; set "
                            "contact.between: bodies or all; if this is intended, add accept: [contact]",
                            s->rigids > 0 ? " (they have contact with rigid bodies)" : "");
    else
        warn_of_reference(s, reference, to);
    if (s->method == METHOD_ADAPTIVE && current)
        warnings_add_if_new(to,
                            "particles that become peridynamic pass through the material points of other bodies, "
                            "because %s; for contact set contact.between: bodies or all, contact.convert: true and "
                            "coupling: partial stress or handshake; if this is intended, add accept: [contact]",
                            s->contact_between == CONTACT_NONE ? "contact.between is none"
                            : !s->contact_convert              ? "contact.convert is false"
                                                               : "the key coupling has another value");
}

/* Returns true if particles i and j of p start with the same velocity: their difference is at most 0.1 % of the root of
 * the sum of both squares. Parts of bodies that are meant to be joined do; colliding bodies do not. */
static bool start_as_one(const struct particles *p, int64_t i, int64_t j)
{
    real apart2 = 0, most2 = 0;
    for (int d = 0; d < p->dim; d++) {
        apart2 += square(p->v[d][i] - p->v[d][j]);
        most2 += square(p->v[d][i]) + square(p->v[d][j]);
    }
    return apart2 <= 1e-6 * most2;
}

/* Finds the pairs of bodies that touch at the start: with particles of p closer than `reach` [m] that have the same
 * velocity. For each such pair a < b, sets touch[a * bodies + b] to true; touch[bodies * bodies] must be false before.
 * cells: cells of the neighbour search. Returns the number of pairs. */
static int touching(const struct particles *p, const struct cells *cells, int bodies, real reach, bool *touch)
{
    struct neighbour_list near = {0};
    int pairs = 0;
    for (int64_t i = 0; i < p->n; i++) {
        particles_list_neighbours_within_radius(&near, cells, p, i, reach, false);
        for (int k = 0; k < near.n; k++) {
            const int32_t j = near.at[k];
            if (j >= p->n || p->body[j] <= p->body[i] || !start_as_one(p, i, j)) continue;
            bool *pair = &touch[p->body[i] * bodies + p->body[j]];
            pairs += !*pair;
            *pair = true;
        }
    }
    memory_free(near.at);
    return pairs;
}

/* Adds a warning to `to` if bodies of the run touch at the start without being joined, and names them. Bodies touch if
 * particles of both are within 1.5 spacings or the cutoff (largest bond length), whichever is smaller, and have the
 * same velocity. */
static void warn_of_touch(const struct run *run, struct warnings *to)
{
    const struct scene *s = run->scene;
    char name[2 * NAME_MAX_LENGTH + 8];
    if (s->bodies < 2) return;
    bool *touch = NEW("warn.touch", s->bodies * s->bodies, bool);
    const real reach = real_min(1.5 * s->spacing, run->source.family.cutoff);
    struct name_list names = {.all = touching(&run->part, &run->cells, s->bodies, reach, touch)};
    for (int k = 0; k < s->bodies * s->bodies; k++) {
        if (!touch[k]) continue;
        snprintf(name, sizeof name, "%s with %s", s->body[k / s->bodies].name, s->body[k % s->bodies].name);
        name_add(&names, name);
    }
    memory_free(touch);
    if (names.all > 0)
        warnings_add_if_new(
            to, "bodies touch at the start (%s), but no bond joins them, so %s; to join them, use the key interfaces",
            names.text,
            s->method == METHOD_PD || run->grid->fields > 1
                ? "they separate freely"
                : "on the grid of mpm.frame: current they stick together only until a gap of two cells opens");
}

void warn_of_bodies_that_penetrate_or_stick_together(const struct run *run, struct warnings *warning_list)
{
    const struct scene *s = run->scene;
    const bool reference_possible = run->source.voids && s->method != METHOD_PD && s->bodies == 1 &&
                                    !scene_reason_total_lagrangian_mpm_unsupported(s, 0) &&
                                    lagrangian_mesh_can_be_made_for_scene(run->frame, &run->part, s, run->grid);
    warn_of_contact(s, run->frame, run->coupling->approaches, warning_list);
    warn_of_touch(run, warning_list);
    warn_of_voids_treated_as_closed(run, reference_possible, warning_list);
}
