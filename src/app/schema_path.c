/* Finds the JSON schema of scenes next to the installed program, or in its build folder. */
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "commands.h"

bool schema_find_file_path(char *path, size_t capacity)
{
    static const char *const beside[] = {"/../share/cleave/cleave.schema.json", "/cleave.schema.json"};
    char program[PATH_MAX], place[PATH_MAX + 64];
    const ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
    if (length <= 0) return false;
    program[length] = '\0';
    *strrchr(program, '/') = '\0';
    for (size_t k = 0; k < COUNT_OF(beside); k++) {
        snprintf(place, sizeof place, "%s%s", program, beside[k]);
        char *whole = realpath(place, NULL);
        const bool there = whole && strlen(whole) < capacity;
        if (there) strcpy(path, whole);
        free(whole);
        if (there) return true;
    }
    return false;
}
