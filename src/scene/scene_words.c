/* Reads words of command lines by the grammar of scenes. */
#include "scene/words.h"

#include "base/edit_distance.h"
#include "scene_internal.h"

bool length_read(real *value, const char *text, char *what, size_t room)
{
    return number_read(value, text, UNIT_LENGTH, false, what, room);
}

bool time_read(real *value, const char *text, char *what, size_t room)
{
    return number_read(value, text, UNIT_TIME, false, what, room);
}

const char *word_nearest(const char *word, const char *const *name, int n)
{
    int nearest = 0;
    for (int k = 1; k < n; k++)
        if (edit_distance(name[k], word) < edit_distance(name[nearest], word)) nearest = k;
    return name[nearest];
}
