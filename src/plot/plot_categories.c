/* Assigns colours to the values of fields with named values (kind, body, material, fragment, level), and lists the
 * values that occur for the key (legend). */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "output/output_files.h"
#include "plot/plot.h"
#include "scene/scene_read.h"

struct colour category_colour(const struct plot_field *field, float category_value)
{
    if (strcmp(field->name, "kind") == 0)
        return category_value == KIND_MPM ? colour_of_material_points() : colour_on_peridynamic_particle_scale(0.25);
    return strcmp(field->name, "fragment") == 0 ? fragment_colour((int32_t)category_value)
                                                : colour_of_material_or_body((int)category_value);
}

/* Writes the name of the value `value` of the field called `field` into name[capacity]. s: scene of the run, for the
 * names of bodies and materials; NULL: unknown, bodies and materials are numbered. */
static void category_name(char *name, size_t capacity, const char *field, int value, const struct scene *s)
{
    const char *known = NULL;
    if (strcmp(field, "kind") == 0) known = value == KIND_MPM ? "material points" : "peridynamics";
    if (strcmp(field, "fragment") == 0) known = value < 0 ? "no bond left" : value == 0 ? "the heaviest" : NULL;
    if (strcmp(field, "level") == 0 && value == 0) known = "none";
    if (strcmp(field, "body") == 0 && s && value < s->bodies) known = s->body[value].name;
    const struct material *m = strcmp(field, "material") == 0 && s ? scene_find_material_by_number(s, value) : NULL;
    if (m) known = m->name;
    if (known && *known)
        snprintf(name, capacity, "%s", known);
    else
        snprintf(name, capacity, "%s %d", field, value);
}

/* Returns the value of particle i of `plotted` as a whole number. Values outside -1..2^24 and values that are no
 * number, as in a damaged file, are replaced by a number in this range. */
static int category_value(const struct plotted_particles *plotted, int64_t i)
{
    static const float MOST = 1 << 24;
    return (int)fminf(fmaxf(plotted->value[i], -1), MOST);
}

/* Finds the values that occur in the drawn particles of the output frames cloud[clouds]. Returns an allocated array in
 * which seen[1 + value] is true for each of them, and stores the largest value in *last. The caller releases the array
 * with memory_free. */
static bool *values_seen(int *last, const struct plotted_particles *cloud, int clouds)
{
    *last = -1;
    for (int c = 0; c < clouds; c++)
        for (int64_t i = 0; i < cloud[c].n; i++)
            if (category_value(&cloud[c], i) > *last) *last = category_value(&cloud[c], i);
    bool *seen = NEW("plot.values", *last + 2, bool);
    for (int c = 0; c < clouds; c++)
        for (int64_t i = 0; i < cloud[c].n; i++) seen[1 + category_value(&cloud[c], i)] = true;
    return seen;
}

void categories_list_values_present_in_frames(struct categories *categories, const struct plot_field *field,
                                              const char *folder, const struct plotted_particles *frame_particles,
                                              int frame_count)
{
    struct scene scene;
    const bool known = scene_read(&scene, path_join(folder, "scene.yaml").text, NULL, 0) == OK;
    int last = -1;
    bool *seen = values_seen(&last, frame_particles, frame_count);
    *categories = (struct categories){0};
    for (int value = -1; value <= last; value++) {
        if (!seen[value + 1]) continue;
        if (categories->n == CATEGORIES_MOST) {
            categories->more++;
            continue;
        }
        struct category *of = &categories->of[categories->n++];
        of->colour = category_colour(field, (float)value);
        category_name(of->name, sizeof of->name, field->name, value, known ? &scene : NULL);
    }
    memory_free(seen);
    if (known) scene_free(&scene);
}
