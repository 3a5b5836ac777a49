/* Reads words of command lines by the grammar of scenes. */
#include "scene/words.h"

#include <stdio.h>
#include <string.h>

#include "base/edit_distance.h"
#include "scene_internal.h"

bool length_read(real *value, const char *text, char *message, size_t capacity)
{
    return number_read(value, text, UNIT_LENGTH, false, message, capacity);
}

bool time_read(real *value, const char *text, char *message, size_t capacity)
{
    return number_read(value, text, UNIT_TIME, false, message, capacity);
}

bool value_read_in_unit(real *value, const char *text, const char *symbol, char *message, size_t capacity)
{
    enum unit unit = UNIT_NONE;
    for (int k = 0; k < UNITS; k++)
        if (*symbol && strcmp(unit_rows[k].symbol, symbol) == 0) unit = (enum unit)k;
    return number_read(value, text, unit, false, message, capacity);
}

const char *number_text_with_unit_of(char *joined, size_t capacity, const char *text, const char *other)
{
    const char *number = "+-.0123456789eE/ ", *unit = other + strspn(other, number);
    snprintf(joined, capacity, "%s%s", text, text[strspn(text, number)] ? "" : unit);
    return joined;
}

struct word_proposal word_propose_similar(const char *word, const char *const *name, int n)
{
    struct word_proposal proposal = {";"};
    int nearest = 0;
    for (int k = 1; k < n; k++)
        if (edit_distance(name[k], word) < edit_distance(name[nearest], word)) nearest = k;
    if (words_are_similar(name[nearest], word))
        snprintf(proposal.text, sizeof proposal.text, "; did you mean %.80s?", name[nearest]);
    return proposal;
}
