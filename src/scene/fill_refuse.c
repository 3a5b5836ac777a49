/* Refusals of bodies. */
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "fill_draft.h"

status new_particles_report_body_fault(const struct new_particles *created, int body_number, const char *reason)
{
    const struct scene_body *b = &created->scene->body[body_number];
    return status_message_prepend_location(b->place, status_set(REFUSED, "body %s: %s", b->name, reason));
}

status new_particles_report_empty_body(const struct new_particles *created, int body, bool from_particle_list)
{
    real from[DIM_MAX], to[DIM_MAX];
    char why[200] = "contains no particle: its shape is at most ";
    size_t used = strlen(why);
    if (from_particle_list)
        return new_particles_report_body_fault(created, body,
                                               "has no particle in its list: check that the list has particles and, if "
                                               "several bodies share it, its column body");
    region_compute_bounding_box_if_finite(&created->scene->body[body].shape, created->scene->dim, from, to);
    for (int a = 0; a < created->scene->dim; a++)
        used += (size_t)snprintf(why + used, sizeof why - used, "%s%.4g", a ? " x " : "", to[a] - from[a]);
    snprintf(
        why + used, sizeof why - used,
        " m, the spacing %.4g m: use a spacing below its thickness, or check the units of both (m if none is written)",
        created->scene->spacing);
    return new_particles_report_body_fault(created, body, why);
}
