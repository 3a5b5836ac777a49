/* Adds the particles of a body from its list. Values of an entry take precedence over values of the body. */
#include <stdio.h>
#include <string.h>

#include "data/particles.h"
#include "fill_draft.h"
#include "list_lattice.h"
#include "scene/particle_list.h"

/* Writes the location of entry i of the particle list l in its file `path` to text[PLACE_LENGTH], and returns text.
 * The form is `path:line`, or `path: entry i` for HDF5 files. material: true to append the column of the entry's
 * material, if the list has materials. */
static const char *entry_place(char *text, const struct particle_list *l, const char *path, int64_t i, bool material)
{
    int used = snprintf(text, PLACE_LENGTH, "%.460s:%s%lld", path, l->line ? "" : " entry ",
                        (long long)(l->line ? l->line[i] : i));
    if (material && l->material_at) snprintf(text + used, (size_t)(PLACE_LENGTH - used), ":%d", l->material_at[i]);
    return text;
}

/* Writes the names of the materials of the scene s to text[capacity], such as `glass, steel and foam`, and returns
 * text. Only the first four are named if there are more. */
static const char *materials_in_words(char *text, size_t capacity, const struct scene *s)
{
    enum { NAMED = 4 };
    size_t used = 0;
    for (int m = 0; m < s->materials && m < NAMED; m++)
        used += (size_t)snprintf(text + used, capacity - used, "%s%.40s",
                                 m == 0                  ? ""
                                 : m + 1 == s->materials ? " and "
                                                         : ", ",
                                 s->material[m].name);
    if (s->materials > NAMED) snprintf(text + used, capacity - used, " and %d more", s->materials - NAMED);
    return text;
}

/* Returns REFUSED with the message that the scene s does not have the material of entry i of the list l. given: that
 * material, a number, or -1 - k for the name l->name[k]; path: file of the list. */
static status refuse_material(const struct scene *s, const struct particle_list *l, const char *path, int64_t i,
                              real given)
{
    char place[PLACE_LENGTH], names[256];
    entry_place(place, l, path, i, true);
    materials_in_words(names, sizeof names, s);
    if (given < 0)
        return status_set(REFUSED, "%s: the scene has no material %s; give one that it has (%s)", place,
                          l->name[-1 - (int)given], names);
    return status_set(
        REFUSED,
        "%s: the scene has no material %s%d (numbered from %d in the order of the scene); give one that it has (%s)",
        place, l->head.block ? "of block_id " : "", (int)given + l->head.block, l->head.block, names);
}

/* Returns true if body number k of the scene s exists and takes its particles from the list in `file`. */
static bool shares_file(const struct scene *s, int k, const char *file)
{
    return k < s->bodies && s->body[k].file != NULL && strcmp(s->body[k].file, file) == 0;
}

/* Finds the material of entry i of the particle list l: that of the list, or that of the body b if the list has no
 * materials. Stores its index in the scene s in *material. Returns REFUSED, with a message, if the input file (scene)
 * has no such material. */
static status entry_material(const struct scene *s, const struct particle_list *l, const struct scene_body *b,
                             int64_t i, int *material)
{
    const real given = l->material ? l->material[i] : b->material;
    *material = given < 0 ? 0 : (int)given;
    while (given < 0 && *material < s->materials && strcmp(s->material[*material].name, l->name[-1 - (int)given]) != 0)
        ++*material;
    return *material < s->materials ? OK : refuse_material(s, l, b->file, i, given);
}

/* Adds entry i of the particle list l to `created`, the list of particles to be created. body: index of its body in the
 * scene; volume: volume of the particle if l has no volumes [m^3]. Returns REFUSED, with a message, for an unknown
 * material. */
static status take_entry(struct new_particles *created, int body, const struct particle_list *l, int64_t i, real volume)
{
    const struct scene *s = created->scene;
    const struct scene_body *b = &s->body[body];
    int material;
    real X[DIM_MAX];
    TRY(entry_material(s, l, b, i, &material));
    for (int a = 0; a < s->dim; a++) X[a] = l->X[a][i];
    TRY(new_particles_append_particle(created, X, l->volume ? l->volume[i] : volume,
                                      scene_material_index_at_position(s, b, X, material), body));
    const int64_t last = created->n - 1;
    for (int a = 0; a < s->dim; a++)
        if (l->v[a]) created->v[a][last] = l->v[a][i];
    if (l->mass) created->mass[last] = l->mass[i];
    if (l->density) created->mass[last] = l->density[i] * created->volume[last];
    return OK;
}

/* Adds the entries of the particle list l that belong to the body with the index `body` to `created`, the list of
 * particles to be created. These are the entries that name the body, or all if l has no column of bodies. Returns
 * REFUSED, with a message, if an entry names a body with another file, or if neither l gives volumes nor the scene a
 * spacing. */
static status take_list(struct new_particles *created, int body, const struct particle_list *l)
{
    const struct scene *s = created->scene;
    const char *path = s->body[body].file;
    char place[PLACE_LENGTH];
    const real volume = lattice_particle_volume(scene_cross_section_or_thickness(s), s->spacing, s->dim);
    if (!l->volume && !(volume > 0))
        return new_particles_report_body_fault(
            created, body, "has a list without volumes; add a column volume, or set particles.spacing");
    for (int64_t i = 0; i < l->n; i++) {
        const int owner = l->body != NULL ? (int)l->body[i] : body;
        if (!shares_file(s, owner, path))
            return status_set(REFUSED,
                              "%s: the body with the number %d (counted from 0 in the order of the scene) does not use "
                              "this file; correct the column body",
                              entry_place(place, l, path, i, false), owner);
        if (owner == body) TRY(take_entry(created, body, l, i, volume));
    }
    return OK;
}

/* Rounds the positions of the particles `first` .. created->n - 1 in `created` (the list of particles to be created) to
 * exact lattice sites, if they form a lattice within the rounding of the decimals in their file, such that planes of
 * symmetry of the scene are on sites or midway between two sites. Changes nothing otherwise. */
static void take_lattice(struct new_particles *created, int64_t first)
{
    const struct scene *s = created->scene;
    for (int a = 0; a < s->dim; a++) {
        real anchor = 0;
        for (int b = 0; b < s->boundaries; b++)
            if (s->boundary[b].kind == BOUNDARY_MIRROR && s->boundary[b].axis == a) anchor = s->boundary[b].at;
        coordinates_round_to_lattice(created->X[a] + first, created->n - first, s->spacing, anchor);
    }
}

status new_particles_append_body_from_file(struct new_particles *created, int body_number)
{
    const int64_t first = created->n;
    struct particle_list list;
    TRY(particle_list_read(&list, created->scene->body[body_number].file, &created->scene->body[body_number].form,
                           created->scene->dim));
    status s = take_list(created, body_number, &list);
    particle_list_free(&list);
    if (s == OK && created->scene->body[body_number].list.lattice) take_lattice(created, first);
    return s;
}
