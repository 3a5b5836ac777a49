/* Compares the folders of two runs file by file, for test_faults.c. */
#ifndef CLEAVE_TESTS_SAME_FILES
#define CLEAVE_TESTS_SAME_FILES

#include <ftw.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

#include "faults.h"

/* Returns true if the summaries of runs in the files a and b agree in all lines before "threads"; the lines from there
 * on are about the machine. */
static bool same_figures(const char *a, const char *b)
{
    char x[1024], y[1024];
    FILE *f = fopen(a, "r"), *g = fopen(b, "r");
    bool same = f && g;
    while (same && fgets(x, sizeof x, f) && !strstr(x, "\"threads\""))
        same = fgets(y, sizeof y, g) && strcmp(x, y) == 0;
    if (f) fclose(f);
    if (g) fclose(g);
    return same;
}

/* State of a walk over the files of a reference folder, each of which must be in the folder `other` with equal
 * contents. */
static const char *other;
static size_t reference_length;
static int files, differing;

/* Returns true if the file called `name` may differ between equal runs: checkpoints contain times, and hidden files,
 * such as a lock that could not be removed, have no effect. */
static bool is_beside(const char *name) { return name[0] == '.' || strncmp(name, "checkpoint", 10) == 0; }

static int compare_one(const char *path, const struct stat *s, int type, struct FTW *walk)
{
    char there[512];
    (void)s;
    if (type != FTW_F || is_beside(path + walk->base)) return 0;
    snprintf(there, sizeof there, "%s%s", other, path + reference_length);
    const bool same = strcmp(path + walk->base, "summary.json") == 0 ? same_figures(path, there)
                                                                     : fault_hash(path) == fault_hash(there);
    files++;
    if (!same) differing++, printf("    %s differs\n", there);
    return 0;
}

static int count_one(const char *path, const struct stat *s, int type, struct FTW *walk)
{
    (void)s;
    const size_t length = strlen(path);
    if (type == FTW_F && !is_beside(path + walk->base)) files--;
    if (length > 4 && strcmp(path + length - 4, ".tmp") == 0) files += 1000;
    return 0;
}

/* Returns true if `folder` contains a file with a temporary name (*.tmp), as a run leaves it that is killed while it
 * writes. */
static bool half_written(const char *folder)
{
    files = 0;
    nftw(folder, count_one, 8, FTW_PHYS);
    return files > 0;
}

/* Compares the output folders of two runs and prints the files that differ. Returns true if both have the same files,
 * more than four, with equal contents, and none with a temporary name. Summaries are compared up to the lines about the
 * machine; checkpoints and hidden files are left out. */
static bool same_files(const char *reference, const char *folder)
{
    other = folder, reference_length = strlen(reference), files = differing = 0;
    nftw(reference, compare_one, 8, FTW_PHYS);
    const bool some = files > 4;
    nftw(folder, count_one, 8, FTW_PHYS);
    if (files != 0) printf("    %s: other files than those of %s\n", folder, reference);
    return some && files == 0 && differing == 0;
}

#endif
