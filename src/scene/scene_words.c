/* Reads words of command lines by the grammar of scenes. */
#include "scene/words.h"

#include <stdio.h>
#include <string.h>

#include "base/edit_distance.h"
#include "scene_internal.h"

bool length_parse_with_unit(real *value, const char *text, char *message, size_t capacity)
{
    return number_parse_with_unit(value, text, UNIT_LENGTH, false, message, capacity);
}

bool time_parse_with_unit(real *value, const char *text, char *message, size_t capacity)
{
    return number_parse_with_unit(value, text, UNIT_TIME, false, message, capacity);
}

bool value_parse_with_unit_symbol(real *value, const char *text, const char *symbol, char *message, size_t capacity)
{
    enum unit unit = UNIT_NONE;
    for (int k = 0; k < UNITS; k++)
        if (*symbol && strcmp(unit_rows[k].symbol, symbol) == 0) unit = (enum unit)k;
    return number_parse_with_unit(value, text, unit, false, message, capacity);
}

const char *number_text_append_unit_if_missing(char *joined, size_t capacity, const char *text,
                                               const char *number_with_unit)
{
    const char *number = "+-.0123456789eE/ ", *unit = number_with_unit + strspn(number_with_unit, number);
    snprintf(joined, capacity, "%s%s", text, text[strspn(text, number)] ? "" : unit);
    return joined;
}

struct word_proposal word_propose_similar(const char *word, const char *const *name, int n)
{
    struct word_proposal proposal = {";"};
    int nearest = 0;
    for (int k = 1; k < n; k++)
        if (edit_distance(name[k], word) < edit_distance(name[nearest], word)) nearest = k;
    if (word_is_probable_misspelling_of(name[nearest], word))
        snprintf(proposal.text, sizeof proposal.text, "; did you mean %.80s?", name[nearest]);
    return proposal;
}
