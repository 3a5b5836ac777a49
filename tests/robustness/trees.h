/* Removes folders with all files, for tests that create some. */
#ifndef CLEAVE_TESTS_TREES
#define CLEAVE_TESTS_TREES

#include <ftw.h>
#include <stdio.h>
#include <sys/stat.h>

static inline int remove_one(const char *path, const struct stat *s, int type, struct FTW *walk)
{
    (void)s, (void)type, (void)walk;
    return remove(path);
}

static inline void remove_tree(const char *path) { nftw(path, remove_one, 8, FTW_DEPTH | FTW_PHYS); }

#endif
