/* Finds files of the program: beside the installed program, or in its build folder and its source tree. */
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "commands.h"

/* Finds the first of the two places beside[2], relative to the folder of the program, that exists. Writes its path to
 * path[capacity]. Returns false if neither exists or its path is too long. */
static bool find_beside_program(const char *const *beside, char *path, size_t capacity)
{
    char program[PATH_MAX], place[PATH_MAX + 64];
    const ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
    if (length <= 0) return false;
    program[length] = '\0';
    *strrchr(program, '/') = '\0';
    for (int k = 0; k < 2; k++) {
        snprintf(place, sizeof place, "%s%s", program, beside[k]);
        char *whole = realpath(place, NULL);
        const bool there = whole && strlen(whole) < capacity;
        if (there) strcpy(path, whole);
        free(whole);
        if (there) return true;
    }
    return false;
}

bool json_schema_find_file_path(char *path, size_t capacity)
{
    static const char *const beside[] = {"/../share/cleave/cleave.schema.json", "/cleave.schema.json"};
    return find_beside_program(beside, path, capacity);
}

bool inputs_folder_find_path(char *path, size_t capacity)
{
    static const char *const beside[] = {"/../share/doc/cleave/inputs", "/../inputs"};
    return find_beside_program(beside, path, capacity);
}
