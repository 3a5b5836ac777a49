/* Particles of a body from its list: what entries say goes before what the body says. */
#include <string.h>

#include "data/particles.h"
#include "fill_draft.h"
#include "scene/particle_list.h"

/* REFUSED with a message that begins with `file:line` of entry i (CSV) or `file: entry i` (HDF5). */
static status refuse_entry(const struct particle_list *l, const char *path, int64_t i, const char *what, int number)
{
    bool csv = l->line != NULL;
    return status_set(REFUSED, "%s:%s%lld: %s %d (numbered from 0 in the order of the scene)", path,
                      csv ? "" : " entry ", (long long)(csv ? l->line[i] : i), what, number);
}

/* True if body number k takes its particles from this file. */
static bool shares_file(const struct scene *s, int k, const char *file)
{
    return k < s->bodies && s->body[k].file != NULL && strcmp(s->body[k].file, file) == 0;
}

/* Material of entry i, or of the body where the list has none. REFUSED for one that the scene does not have. */
static status entry_material(const struct scene *s, const struct particle_list *l, const struct scene_body *b,
                             int64_t i, int *material)
{
    const real given = l->material ? l->material[i] : b->material;
    *material = (int)given;
    if (given < 0) {
        const char *name = l->name[-1 - *material];
        for (*material = 0; *material < s->materials; ++*material)
            if (strcmp(s->material[*material].name, name) == 0) return OK;
        return status_set(REFUSED, "%s:%lld: the scene has no material %s", b->file, (long long)l->line[i], name);
    }
    return *material < s->materials ? OK : refuse_entry(l, b->file, i, "the scene has no material", *material);
}

/* Adds entry i, which is of this body; `volume` where the list has none [m^3]. */
static status take_entry(struct draft *d, int body, const struct particle_list *l, int64_t i, real volume)
{
    const struct scene *s = d->scene;
    const struct scene_body *b = &s->body[body];
    int material;
    real X[DIM_MAX];
    TRY(entry_material(s, l, b, i, &material));
    for (int a = 0; a < s->dim; a++) X[a] = l->X[a][i];
    TRY(draft_add(d, X, l->volume ? l->volume[i] : volume, scene_material_at(s, b, X, material), body));
    const int64_t last = d->n - 1;
    for (int a = 0; a < s->dim; a++)
        if (l->v[a]) d->v[a][last] = l->v[a][i];
    if (l->mass) d->mass[last] = l->mass[i];
    if (l->density) d->mass[last] = l->density[i] * d->volume[last];
    return OK;
}

/* Adds the entries of a body to the draft: entries with its number, or all entries of a list without a body column.
 * REFUSED for entries of a body with another file, and without volumes or a spacing that says them. */
static status take_list(struct draft *d, int body, const struct particle_list *l)
{
    const struct scene *s = d->scene;
    const char *path = s->body[body].file;
    const real volume = lattice_volume(scene_section(s), s->spacing, s->dim);
    if (!l->volume && !(volume > 0))
        return draft_refuse(d, body, "its list has no column volume, and there is no particles.spacing that says it");
    for (int64_t i = 0; i < l->n; i++) {
        const int owner = l->body != NULL ? (int)l->body[i] : body;
        if (!shares_file(s, owner, path)) return refuse_entry(l, path, i, "this file is not that of body", owner);
        if (owner == body) TRY(take_entry(d, body, l, i, volume));
    }
    return OK;
}

status fill_list(struct draft *d, int body)
{
    struct particle_list list;
    TRY(particle_list_read(&list, d->scene->body[body].file, d->scene->dim));
    status s = take_list(d, body, &list);
    particle_list_free(&list);
    return s;
}
