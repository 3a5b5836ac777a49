/* Bodies, parts and materials without particles, which are refused. A part without particles is a mistake of place or
 * unit, and a material without particles would count in the time step and in the choice of methods. */
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "fill_draft.h"

status particle_draft_refuse_body(const struct particle_draft *d, int body_number, const char *reason)
{
    const struct scene_body *b = &d->scene->body[body_number];
    return status_prepend_location(b->place, status_set(REFUSED, "body %s: %s", b->name, reason));
}

status particle_draft_refuse_empty_body(const struct particle_draft *d, int body, bool listed)
{
    real from[DIM_MAX], to[DIM_MAX];
    char why[200] = "holds no particle: its shape is at most ";
    size_t used = strlen(why);
    if (listed) return particle_draft_refuse_body(d, body, "its list has no entry for it: check its column body");
    region_compute_bounding_box_if_finite(&d->scene->body[body].shape, d->scene->dim, from, to);
    for (int a = 0; a < d->scene->dim; a++)
        used += (size_t)snprintf(why + used, sizeof why - used, "%s%.4g", a ? " x " : "", to[a] - from[a]);
    snprintf(why + used, sizeof why - used,
             " m, the spacing %.4g m: use a spacing below its thickness, or check the units of both (mm?)",
             d->scene->spacing);
    return particle_draft_refuse_body(d, body, why);
}

int particle_draft_record_material(struct particle_draft *d, int body_number, const real *position,
                                   int default_material)
{
    const struct scene_body *b = &d->scene->body[body_number];
    const int part = scene_part_at_position(d->scene, b, position);
    const int material = part < 0 ? default_material : b->part[part].material;
    if (part >= 0) d->part_holds[part] = true;
    d->consists[material] = true;
    return material;
}

void particle_draft_begin_body(struct particle_draft *d, int body_number)
{
    memory_free(d->part_holds);
    d->part_holds = NEW("fill.part_holds", d->scene->body[body_number].parts, bool);
}

status particle_draft_check_parts_hold_particles(struct particle_draft *d, int body_number)
{
    const struct scene *s = d->scene;
    const struct scene_body *b = &s->body[body_number];
    char why[200 + NAME_MAX_LENGTH];
    int part = 0;
    while (part < b->parts && d->part_holds[part]) part++;
    if (part == b->parts) return OK;
    snprintf(why, sizeof why,
             "its part %d, of material %s, holds no particle, as it is outside the body, thinner than the spacing, or "
             "covered by a later part: check its region and the unit (mm?), or remove the part",
             part + 1, s->material[b->part[part].material].name);
    return particle_draft_refuse_body(d, body_number, why);
}

status particle_draft_check_materials_have_particles(const struct particle_draft *d)
{
    const struct scene *s = d->scene;
    for (int m = 0; m < s->materials; m++) {
        bool wanted = false;
        for (int b = 0; b < s->bodies; b++) wanted |= scene_body_can_have_material(&s->body[b], m);
        if (d->consists[m] || !wanted) continue;
        return status_set(REFUSED,
                          "%s: no particle consists of material %s, although a body or its list of particles can: "
                          "remove the material, or check the parts of the bodies and the lists",
                          s->name, s->material[m].name);
    }
    return OK;
}
