/* Finds the units of the results in summary.json, which are all in SI. The unit of a result that is also a column of
 * history.csv is read from the header of that file; a table here has the others. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "output/history.h"
#include "output/output_files.h"
#include "convergence_units.h"

/* Units of results (numbers in summary.json). begin, end: beginning and end of the last part of a result's name (after
 * its last point); unit: unit of the result. The first entry that matches a name applies. */
static const struct {
    const char *begin, *end, *unit;
} unit_of_name[] = {
    {"", "_deg", "degree"},    {"", "_time", "s"},
    {"", "_seconds", "s"},     {"time", "", "s"},
    {"began", "", "s"},        {"ended", "", "s"},
    {"speed", "", "m/s"},      {"tip_speed", "", "m/s"},
    {"velocity_", "", "m/s"},  {"stress_", "", "Pa"},
    {"force_", "", "N"},       {"mass_", "", "kg"},
    {"", "_work", "J"},        {"", "_energy", "J"},
    {"", "_error", ""},        {"length", "", "m"},
    {"growth", "", "m"},       {"displacement", "", "m"},
    {"position", "", "m"},     {"patch", "", "m"},
    {"origin_", "", "m"},      {"release_rate", "", "J/m^2"},
    {"crack_area", "", "m^2"}, {"released", "", "J"},
};

static bool name_fits(const char *name, const char *begin, const char *end)
{
    const size_t n = strlen(name), e = strlen(end);
    return strncmp(name, begin, strlen(begin)) == 0 && n >= e && strcmp(name + n - e, end) == 0;
}

/* Reads the unit of the column called `column` from `header`, the header line of history.csv, into unit[capacity]. The
 * text is "" for dimensionless columns. Returns false, and stores nothing, if there is no such column. */
static bool unit_in_header(char *unit, size_t capacity, const char *header, const char *column)
{
    const size_t length = strlen(column);
    for (const char *cell = header; cell; cell = strchr(cell, ',')) {
        if (*cell == ',') cell++;
        const size_t own = strcspn(cell, ",\n");
        if (own < length || strncmp(cell, column, length) != 0) continue;
        if (own == length || (own == length + 4 && !strncmp(cell + length, " [1]", 4))) {
            *unit = '\0';
            return true;
        }
        if (strncmp(cell + length, " [", 2) != 0) continue;
        snprintf(unit, capacity, "%.*s", (int)(own - length - 3), cell + length + 2);
        return true;
    }
    return false;
}

void study_read_history_header(char *header, size_t capacity, const struct study *s)
{
    *header = '\0';
    for (int k = 0; k < s->n && !*header; k++)
        history_read_header(header, capacity, study_case_folder(s, &s->at[k]).text);
}

void study_determine_unit_of_result(char *unit, size_t capacity, const char *header, const char *result_name)
{
    const char *dot = strrchr(result_name, '.'), *own = dot ? dot + 1 : result_name;
    const bool probe = !strncmp(result_name, "probes.", 7), energy = !strncmp(result_name, "energy.", 7);
    *unit = '\0';
    if ((probe || energy) && unit_in_header(unit, capacity, header, result_name + 7)) return;
    if (!probe && unit_in_header(unit, capacity, header, result_name)) return;
    const bool place = (*own == 'x' || *own == 'y' || *own == 'z') && !own[1];
    if (place) snprintf(unit, capacity, "m");
    for (size_t k = 0; k < COUNT_OF(unit_of_name) && !place; k++)
        if (name_fits(own, unit_of_name[k].begin, unit_of_name[k].end)) {
            snprintf(unit, capacity, "%s", unit_of_name[k].unit);
            return;
        }
}

struct unit unit_choose_for_particle_spacings(double coarsest_spacing)
{
    static const double SPACINGS = 10; /* of a small body */
    return unit_for_length(SPACINGS * coarsest_spacing);
}

struct unit convergence_study_choose_spacing_unit(const struct convergence_study *s)
{
    return unit_choose_for_particle_spacings(s->spacings.at[s->spacings.levels - 1][0]);
}

struct unit scalar_result_study_choose_unit(const struct scalar_result_study *f)
{
    return unit_with_si_prefix_if_unit_allows_it(
        f->unit, fmax(fabs(f->c.level[0].mean), fabs(f->c.level[f->c.levels - 1].mean)));
}
