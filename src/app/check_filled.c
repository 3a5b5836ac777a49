/* Compares the volume of the particles of a body with the volume of its shape. They differ where a lattice follows
 * slanting and curved faces in steps. */
#include <math.h>
#include <stdio.h>

#include "base/memory.h"
#include "check_parts.h"

/* Returns true if all solids of `shape` are boxes along the axes. The volume of the particles of such a shape follows
 * from the spacing and need not be compared with the volume of the shape. */
static bool all_boxes(const struct region *shape)
{
    bool boxes = true;
    for (int k = 0; k < shape->n; k++)
        boxes &= solid_is_untransformed_and_of_kind(&shape->solid[k], SOLID_BOX) && !shape->solid[k].intersect;
    return boxes;
}

/* Returns the number of particles of body number `body` in `part`. Joined bodies count as one body, with the number of
 * the first. If the input file has only one body, particles that are not created (in coarse cells) are included. */
static int64_t particles_of(const struct scene *scene, const struct particles *part, int body)
{
    int64_t n = 0;
    if (scene->bodies == 1) return part->n_body;
    for (int64_t i = 0; i < part->n; i++) n += part->body[i] == body;
    return n;
}

void print_volume_filled_by_particles(const struct run *run)
{
    const struct scene *s = run->scene;
    for (int b = 0; b < s->bodies; b++) {
        const struct region *shape = &s->body[b].shape;
        bool joined = s->body[b].joined != b;
        real from[DIM_MAX], to[DIM_MAX];
        for (int k = b + 1; k < s->bodies; k++) joined |= s->body[k].joined == b;
        if (s->body[b].file || joined || all_boxes(shape) ||
            !region_compute_bounding_box_if_finite(shape, s->dim, from, to))
            continue;
        const real exact = region_volume_within_box(shape, s->dim, from, to),
                   section = scene_cross_section_or_thickness(s);
        const real filled = (real)particles_of(run->scene, &run->part, b) * pow(s->spacing, s->dim);
        if (fabs(filled / exact - 1) < OFF_LEAST) continue;
        printf("filled         body %s: its particles fill %.4g m^3, %.2f %% %s than its shape; a smaller "
               "particles.spacing reduces the difference\n",
               s->body[b].name, filled * section, 100 * fabs(filled / exact - 1), filled > exact ? "more" : "less");
    }
}
