/* Removes folders with their contents, for tests that create folders. */
#ifndef CLEAVE_TESTS_TREES
#define CLEAVE_TESTS_TREES

#include <errno.h>
#include <ftw.h>
#include <libgen.h>
#include <stdbool.h>
#include <stdio.h>
#include <sys/stat.h>
#include <unistd.h>

static inline int remove_one(const char *path, const struct stat *s, int type, struct FTW *walk)
{
    (void)s, (void)type, (void)walk;
    return remove(path);
}

/* Removes the folder `path` with all that is in it. Failures are ignored. */
static inline void remove_tree(const char *path) { nftw(path, remove_one, 8, FTW_DEPTH | FTW_PHYS); }

/* Creates the folder `name` beside the test program, if it is missing, and makes it the working folder. program: path
 * of the test program, argv[0]. Returns false if that fails. */
static inline bool enter_folder_beside(const char *program, const char *name)
{
    char path[4096];
    snprintf(path, sizeof path, "%s", program);
    return chdir(dirname(path)) == 0 && (mkdir(name, 0777) == 0 || errno == EEXIST) && chdir(name) == 0;
}

#endif
