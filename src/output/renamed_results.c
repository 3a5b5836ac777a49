/* Maps names that other versions of Cleave use for columns of history.csv and results in summary.json to the names of
 * this version. src/python/cleave/_tables.py has a copy of the table. */
#include "output/renamed_results.h"

#include <string.h>

#include "base/base.h"

static const struct {
    const char *old, *now;
} renamed[] = {
    {"rest_share", "inactive_share"},
    {"overload", "stretch_ratio"},
    {"directions", "search_directions"},
    {"load_steps.overload", "load_steps.stretch_ratio"},
    {"load_steps.directions", "load_steps.search_directions"},
    {"conversion.returned", "conversion.reverted"},
    {"conversion.returns_most", "conversion.reversions_most"},
    {"conversion.return_energy", "conversion.reversion_energy"},
};

const char *renamed_result_find_current_name(const char *former_name)
{
    for (size_t k = 0; k < COUNT_OF(renamed); k++)
        if (strcmp(former_name, renamed[k].old) == 0) return renamed[k].now;
    return NULL;
}

const char *renamed_result_swap_former_and_current_name(const char *name)
{
    for (size_t k = 0; k < COUNT_OF(renamed); k++)
        if (strcmp(name, renamed[k].now) == 0) return renamed[k].old;
    return renamed_result_find_current_name(name);
}
