/* Reads words of command lines by the grammar of scenes. */
#include "scene/words.h"

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

const char *word_nearest(const char *word, const char *const *name, int n)
{
    int nearest = 0;
    for (int k = 1; k < n; k++)
        if (edit_distance(name[k], word) < edit_distance(name[nearest], word)) nearest = k;
    return name[nearest];
}
