/* Selects the fields that the film of a report (its animation of output frames) shows, chooses their ranges, and
 * converts their values to 8 bits. */
#include <math.h>
#include <string.h>

#include "base/arrays.h"
#include "base/memory.h"
#include "film.h"

/* SAMPLES_OF_FRAME: approximate number of values per output frame from which the stored range of a field is estimated.
 * VALUE_MOST, VALUE_NONE: largest stored value of a field in 8 bits, and the code for no value. FRAGMENT_NONE: code for
 * no fragment, in 16 bits. */
enum { SAMPLES_OF_FRAME = 4000, VALUE_MOST = 254, VALUE_NONE = 255, FRAGMENT_NONE = 65535 };

/* Fraction of the sampled values of a field that is cut off at each end of its stored range [1], so that a few extreme
 * values do not reduce the resolution of all others. */
static const double BEYOND = 5e-4;

/* Names of the fields of a film in the order of the page. extra: left out first if the page becomes too large; fixed:
 * equal in all frames. */
static const struct {
    const char *name;
    bool extra, fixed;
} wanted[] = {
    {"damage", false, false},    {"von_mises", false, false}, {"principal_stress", false, false},
    {"pressure", false, false},  {"speed", false, false},     {"plastic_strain", false, false},
    {"kind", false, false},      {"fragment", false, false},  {"temperature", false, false},
    {"material", false, true},   {"body", false, true},       {"stress_xx", true, false},
    {"stress_yy", true, false},  {"stress_xy", true, false},  {"velocity_x", true, false},
    {"velocity_y", true, false}, {"velocity_z", true, false},
};

void animation_list_possible_fields(struct run_animation *animation)
{
    animation->fields = 0;
    for (size_t k = 0; k < COUNT_OF(wanted); k++) {
        struct animation_field *field = &animation->field[animation->fields];
        *field = (struct animation_field){
            .extra = wanted[k].extra, .fixed = wanted[k].fixed, .least = INFINITY, .most = -INFINITY};
        if (plot_field_find_by_name(&field->of, wanted[k].name, animation->dim) == OK) animation->fields++;
    }
}

static void field_scan(struct animation_field *field, const float *value, int64_t n)
{
    const int64_t stride = n / SAMPLES_OF_FRAME + 1;
    for (int64_t i = 0; i < n; i++)
        if (isfinite(value[i])) field->least = fmin(field->least, value[i]), field->most = fmax(field->most, value[i]);
    for (int64_t i = 0; i < n; i += stride) {
        if (!isfinite(value[i])) continue;
        GROW("report.sample", field->sample, field->samples + 1);
        field->sample[field->samples++] = value[i];
    }
}

void animation_update_field_ranges_from_frame(struct run_animation *animation, const struct output_frame *frame,
                                              const char *path)
{
    for (int k = 0; k < animation->fields; k++) {
        float *value;
        if (plot_field_read(&value, animation->field[k].of, frame, path) != OK) continue;
        field_scan(&animation->field[k], value, frame->n);
        memory_free(value);
    }
}

static int float_compare(const void *a, const void *b)
{
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

/* Chooses the range of values with which a field is stored in 8 bits. The range omits the share BEYOND of the sampled
 * values at each end, and is extended to zero, or made symmetric about zero, as the colour scale of the field requires.
 * Damage has the range 0..1. Sets field->used to false, and chooses no range, if all values are equal or none is known.
 */
static void field_settle(struct animation_field *field)
{
    const bool damage = strcmp(field->of->name, "damage") == 0;
    const int64_t last = field->samples - 1, beyond = (int64_t)(BEYOND * (double)field->samples);
    field->used = field->samples > 0 && (field->most > field->least);
    if (!field->used) return;
    array_sort(field->sample, field->samples, sizeof *field->sample, float_compare);
    field->low = field->sample[beyond], field->high = field->sample[last - beyond];
    if (!(field->high > field->low)) field->low = field->least, field->high = field->most;
    if (field->of->scale == FROM_ZERO) field->low = fmin(field->low, 0);
    if (field->of->scale == BOTH_SIGNS) {
        field->high = fmax(fabs(field->low), fabs(field->high));
        field->low = -field->high;
    }
    if (damage) field->low = 0, field->high = 1;
}

void animation_choose_stored_field_ranges(struct run_animation *animation)
{
    for (int k = 0; k < animation->fields; k++) field_settle(&animation->field[k]);
}

bool animation_field_is_shown(const struct run_animation *animation, const struct animation_field *field)
{
    return field->used && !(field->extra && animation->lacks_extra);
}

static bool is_fragment(const struct animation_field *field) { return strcmp(field->of->name, "fragment") == 0; }

int animation_bytes_per_group_and_frame(const struct run_animation *animation)
{
    int bytes = 0;
    for (int k = 0; k < animation->fields; k++)
        if (animation_field_is_shown(animation, &animation->field[k]) && !animation->field[k].fixed)
            bytes += is_fragment(&animation->field[k]) ? 2 : 1;
    return bytes;
}

/* Returns the number that the page stores for a field and group g (particles shown as one) of the particle set s: the
 * mean of value[s->n] over the group, as 0..254 over the stored range of the field, or 255 for no value. Categories
 * such as materials are stored unchanged, fragments in 16 bits; both are those of one particle of the group. */
static unsigned value_stored(const struct animation_field *field, const struct animation_particle_set *s,
                             const float *value, int64_t g)
{
    double sum = 0;
    const double one = value[s->member[s->first[g]]];
    if (is_fragment(field)) return one < 0 || one >= FRAGMENT_NONE ? FRAGMENT_NONE : (unsigned)one;
    if (field->of->scale == CATEGORY) return (unsigned)fmin(fmax(one, 0), VALUE_MOST);
    for (int32_t k = s->first[g]; k < s->first[g + 1]; k++) sum += value[s->member[k]];
    const double mean = sum / (s->first[g + 1] - s->first[g]);
    if (!isfinite(mean)) return VALUE_NONE;
    return (unsigned)lround(VALUE_MOST * fmin(fmax((mean - field->low) / (field->high - field->low), 0), 1));
}

void animation_write_field_values_of_frame(struct html_page *p, const struct animation_field *field,
                                           const struct animation_particle_set *particle_set,
                                           const struct output_frame *frame, const char *path)
{
    float *value = NULL;
    if (plot_field_read(&value, field->of, frame, path) != OK) value = NEW("report.field", frame->n, float);
    const int64_t n = particle_set->groups;
    uint16_t *wide = BARE("report.wide", n, uint16_t);
    uint8_t *narrow = BARE("report.narrow", n, uint8_t);
    for (int64_t g = 0; g < n; g++) {
        const unsigned stored = value_stored(field, particle_set, value, g);
        wide[g] = (uint16_t)stored;
        narrow[g] = (uint8_t)stored;
    }
    if (is_fragment(field))
        html_page_add_array(p, field->of->name, PAGE_U16, wide, n);
    else
        html_page_add_array(p, field->of->name, PAGE_U8, narrow, n);
    memory_free(narrow), memory_free(wide), memory_free(value);
}
