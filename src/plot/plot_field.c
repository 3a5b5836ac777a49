/* The fields that `cleave plot --field` draws: stored in frames, or derived from what is. */
#include <math.h>
#include <string.h>

#include "data/derived_fields.h"
#include "plot/plot.h"
#include "scene/words.h"

/* Components of the stress tensor [Pa] as xx yy zz xy yz zx; 0 where frames of this dimension have none. */
static void stress_of(const struct frame *f, int64_t i, double *s)
{
    static const int line[] = {0}, plane[] = {0, 1, 3, 2}, solid[] = {0, 1, 2, 3, 4, 5};
    const int *place = f->dim == 1 ? line : f->dim == 2 ? plane : solid;
    for (int k = 0; k < SYM_MAX; k++) s[k] = 0;
    for (int k = 0; k < frame_stresses(f->dim); k++) s[place[k]] = f->stress[k][i];
}

static double stress_at(const struct frame *f, int64_t i, int component)
{
    double s[SYM_MAX];
    stress_of(f, i, s);
    return s[component];
}

static double mises_at(const struct frame *f, int64_t i, int component)
{
    double s[SYM_MAX];
    (void)component;
    stress_of(f, i, s);
    return tensor_mises(s);
}

static double pressure_at(const struct frame *f, int64_t i, int component)
{
    double s[SYM_MAX];
    (void)component;
    stress_of(f, i, s);
    return -(s[0] + s[1] + s[2]) / 3;
}

/* Principal stresses of the tensor in space, in the plane with the stress across it; 0: the largest, 2: the least. */
static double principal_at(const struct frame *f, int64_t i, int component)
{
    double s[SYM_MAX], value[3];
    stress_of(f, i, s);
    tensor_principal(s, value, NULL);
    return value[component];
}

static double vector_at(float *const *vector, const struct frame *f, int64_t i, int component)
{
    double sum = 0;
    if (component < 3) return component < f->dim ? vector[component][i] : 0;
    for (int d = 0; d < f->dim; d++) sum += square((double)vector[d][i]);
    return sqrt(sum);
}

static double velocity_at(const struct frame *f, int64_t i, int component) { return vector_at(f->v, f, i, component); }
static double motion_at(const struct frame *f, int64_t i, int component) { return vector_at(f->u, f, i, component); }

static double mark_at(const struct frame *f, int64_t i, int component)
{
    return component == 0 ? f->damage[i] : component == 1 ? f->kind[i] : component == 2 ? f->material[i] : f->body[i];
}

static const struct plot_field fields[] = {
    {"damage", "", false, mark_at, 0},
    {"kind", "", false, mark_at, 1},
    {"material", "", false, mark_at, 2},
    {"body", "", false, mark_at, 3},
    {"displacement", "m", false, motion_at, 3},
    {"displacement_x", "m", true, motion_at, 0},
    {"displacement_y", "m", true, motion_at, 1},
    {"displacement_z", "m", true, motion_at, 2},
    {"velocity", "m/s", false, velocity_at, 3},
    {"speed", "m/s", false, velocity_at, 3},
    {"velocity_x", "m/s", true, velocity_at, 0},
    {"velocity_y", "m/s", true, velocity_at, 1},
    {"velocity_z", "m/s", true, velocity_at, 2},
    {"stress_xx", "Pa", true, stress_at, 0},
    {"stress_yy", "Pa", true, stress_at, 1},
    {"stress_zz", "Pa", true, stress_at, 2},
    {"stress_xy", "Pa", true, stress_at, 3},
    {"stress_yz", "Pa", true, stress_at, 4},
    {"stress_zx", "Pa", true, stress_at, 5},
    {"von_mises", "Pa", false, mises_at, 0},
    {"pressure", "Pa", true, pressure_at, 0},
    {"principal_stress", "Pa", true, principal_at, 0},
    {"principal_stress_1", "Pa", true, principal_at, 0},
    {"principal_stress_2", "Pa", true, principal_at, 1},
    {"principal_stress_3", "Pa", true, principal_at, 2},
};

double plot_field_at(const struct plot_field *field, const struct frame *f, int64_t i)
{
    return field->at(f, i, field->component);
}

/* Is it a component along an axis that the run lacks? */
static bool lacks_component(const struct plot_field *field, int dim)
{
    static const char axis[] = "xyz";
    const char *end = strrchr(field->name, '_');
    if (!end || end[1] < 'x' || dim == 3) return false;
    if (dim == 2 && strcmp(end, "_zz") == 0) return false;       /* the stress across the plane */
    for (const char *c = end + 1; *c; c++)
        if (strchr(axis, *c) - axis >= dim) return true;
    return false;
}

status plot_field_find(const struct plot_field **field, const char *name, int dim)
{
    const char *names[COUNT_OF(fields)];
    for (size_t k = 0; k < COUNT_OF(fields); k++) {
        names[k] = fields[k].name;
        if (strcmp(name, names[k]) != 0) continue;
        *field = &fields[k];
        if (!lacks_component(*field, dim)) return OK;
        return status_set(REFUSED, "plot: --field %s: a run in %d dimension%s has no such component", name, dim,
                          dim > 1 ? "s" : "");
    }
    return status_set(REFUSED, "plot: --field %s: there is no such field; do you mean %s? Others are damage, speed, "
                      "velocity_x, displacement, stress_xx, von_mises, pressure, principal_stress",
                      shown_name(name).text, word_nearest(name, names, COUNT_OF(names)));
}
