/* Table and values of the fields that `cleave plot --field` can draw: fields of output frames, and fields derived from
 * these (data/derived_fields.h). */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "output/output_files.h"
#include "plot/plot.h"
#include "scene/words.h"

/* Value of the component of a field that denotes the magnitude of the vector. */
enum { MAGNITUDE = -1 };

static const struct plot_field fields[] = {
    {"damage", "damage", 0, "", FROM_ZERO},
    {"kind", "kind", 0, "", CATEGORY},
    {"material", "material", 0, "", CATEGORY},
    {"body", "body", 0, "", CATEGORY},
    {"fragment", "fragment", 0, "", CATEGORY},
    {"displacement", "displacement", MAGNITUDE, "m", FROM_ZERO},
    {"displacement_x", "displacement", 0, "m", BOTH_SIGNS},
    {"displacement_y", "displacement", 1, "m", BOTH_SIGNS},
    {"displacement_z", "displacement", 2, "m", BOTH_SIGNS},
    {"velocity", "speed", 0, "m/s", FROM_ZERO},
    {"speed", "speed", 0, "m/s", FROM_ZERO},
    {"velocity_x", "velocity", 0, "m/s", BOTH_SIGNS},
    {"velocity_y", "velocity", 1, "m/s", BOTH_SIGNS},
    {"velocity_z", "velocity", 2, "m/s", BOTH_SIGNS},
    {"stress_xx", "stress", 0, "Pa", BOTH_SIGNS},
    {"stress_yy", "stress", 1, "Pa", BOTH_SIGNS},
    {"stress_zz", "stress", 2, "Pa", BOTH_SIGNS},
    {"stress_xy", "stress", 3, "Pa", BOTH_SIGNS},
    {"stress_yz", "stress", 4, "Pa", BOTH_SIGNS},
    {"stress_zx", "stress", 5, "Pa", BOTH_SIGNS},
    {"von_mises", "von_mises", 0, "Pa", FROM_ZERO},
    {"pressure", "pressure", 0, "Pa", BOTH_SIGNS},
    {"principal_stress", "principal_stress", 0, "Pa", BOTH_SIGNS},
    {"principal_stress_2", "principal_stress", 1, "Pa", BOTH_SIGNS},
    {"principal_stress_3", "principal_stress", 2, "Pa", BOTH_SIGNS},
    {"principal_directions_1_x", "principal_directions", 0, "", BOTH_SIGNS},
    {"principal_directions_1_y", "principal_directions", 1, "", BOTH_SIGNS},
    {"principal_directions_1_z", "principal_directions", 2, "", BOTH_SIGNS},
    {"principal_directions_2_x", "principal_directions", 3, "", BOTH_SIGNS},
    {"principal_directions_2_y", "principal_directions", 4, "", BOTH_SIGNS},
    {"principal_directions_2_z", "principal_directions", 5, "", BOTH_SIGNS},
    {"principal_directions_3_x", "principal_directions", 6, "", BOTH_SIGNS},
    {"principal_directions_3_y", "principal_directions", 7, "", BOTH_SIGNS},
    {"principal_directions_3_z", "principal_directions", 8, "", BOTH_SIGNS},
    {"strain_xx", "strain", 0, "", BOTH_SIGNS},
    {"strain_yy", "strain", 1, "", BOTH_SIGNS},
    {"strain_zz", "strain", 2, "", BOTH_SIGNS},
    {"strain_xy", "strain", 3, "", BOTH_SIGNS},
    {"strain_yz", "strain", 4, "", BOTH_SIGNS},
    {"strain_zx", "strain", 5, "", BOTH_SIGNS},
    {"plastic_strain", "plastic_strain", 0, "", FROM_ZERO},
    {"plastic_work", "plastic_work", 0, "J/m³", FROM_ZERO},
    {"temperature", "temperature", 0, "K", FROM_LEAST},
    {"strength_share", "strength_share", 0, "", BOTH_SIGNS},
    {"density", "density", 0, "kg/m³", FROM_LEAST},
    {"contact_force", "contact_force", MAGNITUDE, "N", FROM_ZERO},
    {"level", "level", 0, "", CATEGORY},
    {"spacing", "spacing", 0, "m", FROM_ZERO},
};

/* Returns true if `field` is a component along an axis that a run with `dim` dimensions does not have. The stress
 * normal to the plane exists in two-dimensional runs, too. */
static bool lacks_component(const struct plot_field *field, int dim)
{
    const char *end = strrchr(field->name, '_');
    if (!end || !strchr("xyz", end[1]) || dim == 3) return false;
    if (dim == 2 && (strcmp(end, "_zz") == 0 || strncmp(field->name, "principal", 9) == 0)) return false;
    for (const char *c = end + 1; *c; c++)
        if (*c - 'x' >= dim) return true;
    return false;
}

/* Returns REFUSED with the message that there is no field called `name`. If `name` is a field with components, the
 * message lists these; otherwise it contains the most similar name and the names of all fields.
 * names[COUNT_OF(fields)]: names of all fields. */
static status field_unknown(const char *name, const char *const *names)
{
    char all[1024] = "", components[256] = "";
    size_t used = 0, listed = 0;
    for (size_t k = 0; k < COUNT_OF(fields); k++) {
        const char *own = fields[k].name;
        if (strcmp(fields[k].stored, name) == 0 && listed < sizeof components)
            listed +=
                (size_t)snprintf(components + listed, sizeof components - listed, "%s%s", listed ? ", " : "", own);
        if (strncmp(own, "principal_directions", 20) != 0 && used < sizeof all)
            used += (size_t)snprintf(all + used, sizeof all - used, "%s%s", used ? ", " : "", own);
    }
    if (listed > 0)
        return status_set(REFUSED, "plot: --field %s: this field has several components; draw one of %s",
                          printable_name(name).text, components);
    return status_set(REFUSED, "plot: --field %s: there is no such field%s there are %s", printable_name(name).text,
                      word_propose_similar(name, names, COUNT_OF(fields)).text, all);
}

/* Returns true if `name` denotes the field called `own`: it is equal, or equal with the axes of a tensor component in
 * the other order, as in stress_xz and stress_zx. */
static bool names_field(const char *name, const char *own)
{
    const size_t n = strlen(own);
    if (strcmp(name, own) == 0) return true;
    if (n < 3 || strlen(name) != n || own[n - 3] != '_' || strncmp(name, own, n - 2) != 0) return false;
    return name[n - 2] == own[n - 1] && name[n - 1] == own[n - 2];
}

status plot_field_find_by_name(const struct plot_field **field, const char *name, int dim)
{
    const char *names[COUNT_OF(fields)];
    char component[NAME_MAX_LENGTH];
    const bool vector = !strcmp(name, "velocity") || !strcmp(name, "displacement");
    snprintf(component, sizeof component, "%s%s", name, dim == 1 && vector ? "_x" : "");
    for (size_t k = 0; k < COUNT_OF(fields); k++) {
        names[k] = fields[k].name;
        if (!names_field(component, names[k])) continue;
        *field = &fields[k];
        if (!lacks_component(*field, dim)) return OK;
        return status_set(
            REFUSED, "plot: --field %s: a run in %d dimension%s has no such component; remove it, or give another one",
            name, dim, dim > 1 ? "s" : "");
    }
    return field_unknown(name, names);
}

status plot_field_read(float **value, const struct plot_field *field, const struct output_frame *f, const char *path)
{
    float *row = NULL;
    int columns = 0;
    TRY(frame_field_read(f, path, field->stored, &columns, &row));
    *value = NEW("plot.field", f->n, float);
    for (int64_t i = 0; i < f->n; i++) {
        double sum = 0;
        for (int c = 0; c < columns; c++) sum += square((double)row[i * columns + c]);
        if (field->component == MAGNITUDE)
            (*value)[i] = (float)sqrt(sum);
        else
            (*value)[i] = field->component < columns ? row[i * columns + field->component] : 0;
    }
    memory_free(row);
    return OK;
}

void plot_field_write_label(char *text, size_t capacity, const struct plot_field *field)
{
    const bool mises = strcmp(field->name, "von_mises") == 0, speed = strcmp(field->stored, "speed") == 0;
    snprintf(text, capacity, "%s%s",
             mises   ? "von Mises stress"
             : speed ? "speed"
                     : field->name,
             field->component == MAGNITUDE ? " magnitude" : "");
    for (char *c = text; *c; c++)
        if (*c == '_') *c = ' ';
}

/* Returns true if particles have lost bonds between the output frames `first` and `last`. If the particles of the
 * frames differ, returns true if a particle of `last` is damaged. */
static bool bonds_broke(const struct output_frame *first, const struct output_frame *last)
{
    bool more = false;
    for (int64_t i = 0; i < last->n; i++)
        more |= last->damage[i] > (first->n == last->n && first->id[i] == last->id[i] ? first->damage[i] : 0);
    return more;
}

/* Returns true if `field` can be read in the output frame f and is not 0 everywhere. path: file of the frame. */
static bool field_occurs(const struct plot_field *field, const struct output_frame *f, const char *path)
{
    float *value = NULL;
    bool occurs = false;
    if (plot_field_read(&value, field, f, path) != OK) return false;
    for (int64_t i = 0; i < f->n; i++) occurs |= value[i] != 0;
    memory_free(value);
    return occurs;
}

status plot_field_choose_default(const struct plot_field **field, const char *folder, const struct run_frames *frames)
{
    static const char *const next[] = {"plastic_strain", "von_mises", "speed"};
    const int end = frames->show[frames->shown - 1].number;
    struct output_frame first, last;
    TRY(run_read_frame(&first, folder, frames->list[0].number));
    const status s = run_read_frame(&last, folder, end);
    if (s == OK) {
        TRY(plot_field_find_by_name(field, "damage", last.dim));
        bool found = bonds_broke(&first, &last);
        for (size_t k = 0; k < COUNT_OF(next) && !found; k++) {
            const struct plot_field *one;
            TRY(plot_field_find_by_name(&one, next[k], last.dim));
            found = field_occurs(one, &last, run_frame_path(folder, end).text);
            if (found) *field = one;
        }
        frame_free(&last);
    }
    frame_free(&first);
    return s;
}

enum map colour_map_kind_for_field(const struct plot_field *field)
{
    if (strcmp(field->name, "damage") == 0) return MAP_DAMAGE;
    return field->scale == CATEGORY ? MAP_CATEGORY : MAP_FIELD;
}
