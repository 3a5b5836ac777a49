/* Defines the columns of particle lists of all formats: their names, units, defaults and limits. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "base/team.h"
#include "particle_list_parts.h"

/* Names and units of the columns of a particle list, by enum list_column. */
const struct list_quantity list_quantity[COLUMNS] = {
    {"x", UNIT_LENGTH},        {"y", UNIT_LENGTH},      {"z", UNIT_LENGTH},      {"vx", UNIT_SPEED},
    {"vy", UNIT_SPEED},        {"vz", UNIT_SPEED},      {"volume", UNIT_VOLUME}, {"mass", UNIT_MASS},
    {"density", UNIT_DENSITY}, {"material", UNIT_NONE}, {"body", UNIT_NONE},
};

real **particle_list_address_of_column_array(struct particle_list *l, int column)
{
    switch (column) {
    case COLUMN_VX:
    case COLUMN_VY:
    case COLUMN_VZ:
        return &l->v[column - COLUMN_VX];
    case COLUMN_VOLUME:
        return &l->volume;
    case COLUMN_MASS:
        return &l->mass;
    case COLUMN_DENSITY:
        return &l->density;
    case COLUMN_MATERIAL:
        return &l->material;
    case COLUMN_BODY:
        return &l->body;
    default:
        return &l->X[column];
    }
}

bool particle_list_column_exceeds_dimension(int column, int dim)
{
    return column <= COLUMN_VZ && column % DIM_MAX >= dim; /* x, y, z, vx, vy, vz */
}

void particle_list_head_append_to_message(struct particle_list_head *head, const char *separator, const char *addition)
{
    const size_t used = strlen(head->note);
    snprintf(head->note + used, sizeof head->note - used, "%s%.40s", used ? separator : "", addition);
}

void particle_list_head_store_missing_columns(struct particle_list_head *head, const bool *file_has_column)
{
    head->material = file_has_column[COLUMN_MATERIAL],
    head->mass = file_has_column[COLUMN_MASS] || file_has_column[COLUMN_DENSITY];
    head->volumes = file_has_column[COLUMN_VOLUME];
    if (head->note[0]) particle_list_head_append_to_message(head, " ", "not read");
    if (head->unnamed) particle_list_head_append_to_message(head, "; ", "read as x y z block_id volume");
    if (head->block) particle_list_head_append_to_message(head, "; ", "block_id is the material, counted from 1");
    if (!file_has_column[COLUMN_VOLUME])
        particle_list_head_append_to_message(head, "; ", "no volumes: taken from the spacing");
}

void particle_list_free(struct particle_list *l)
{
    for (int c = 0; c < COLUMNS; c++) memory_free(*particle_list_address_of_column_array(l, c));
    memory_free(l->line);
    memory_free(l->material_at);
    memory_free(l->name);
    *l = (struct particle_list){0};
}

const char *particle_list_reason_value_is_invalid(int column, real value)
{
    if (!isfinite(value)) return "is not a finite number";
    if (column >= COLUMN_VOLUME && column <= COLUMN_DENSITY && value <= 0) return "must be larger than 0";
    if (column >= COLUMN_MATERIAL && (value < 0 || value > UINT8_MAX || value != floor(value)))
        return "must be a whole number from 0 to 255";
    return NULL;
}

bool unit_find_factor_to_si(real *factor, const char *unit, enum unit expected_kind, char *message, size_t capacity)
{
    char number[UNIT_TEXT + 2];
    *factor = 1;
    if (*unit == '\0') return true;
    snprintf(number, sizeof number, "1 %.*s", UNIT_TEXT - 1, unit);
    return number_parse_with_unit(factor, number, expected_kind, false, message, capacity);
}

real particle_list_default_factor_to_si(const struct particle_list *l, int column)
{
    const real scale = l->form.scale > 0 ? l->form.scale : 1;
    return column <= COLUMN_Z ? scale : column == COLUMN_VOLUME ? scale * scale * scale : 1;
}

enum { PARTICLE_NUMBERS = 40 }; /* memory of a particle of a run without bonds [numbers] */

status particle_list_check_memory(const char *path, int64_t particle_count)
{
    const real bytes = (real)particle_count * PARTICLE_NUMBERS * sizeof(real);
    if (machine_memory_size() <= 0 || bytes <= (real)machine_memory_size()) return OK;
    return status_set(REFUSED,
                      "%s: %.3g particles need more than %.2g GB of memory, but %.2g GB are available (%s); use a "
                      "shorter list, or a machine with more memory",
                      path, (real)particle_count, 1e-9 * bytes, 1e-9 * (real)machine_memory_size(),
                      machine_memory_limit_describe_source());
}
