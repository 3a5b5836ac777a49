/* Reads the error bars of the results of a run from an existing convergence study of its scene. */
#include "study/uncertainty.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "output/output.h"
#include "output/output_files.h"
#include "study/study.h"
#include "step/report.h"

/* Largest relative difference between the spacing of a run and the spacing of a level of the study at which the run has
 * the error bars of the level [1]. */
#define SAME_LEVEL 0.05

/* Returns the path of the folder NAME_converge with NAME = name, in the parent folder of `folder`, the folder of a run.
 * The convergence study of the run has this folder by default. */
static struct path study_beside(const char *folder, const char *name)
{
    char place[PATH_NAME_ROOM];
    struct path parent = {{0}};
    const char *slash = strrchr(folder, '/');
    snprintf(place, sizeof place, "%s_converge", name);
    snprintf(parent.text, sizeof parent.text, "%.*s", slash ? (int)(slash - folder) : 1, slash ? folder : ".");
    return path_join(parent.text, place);
}

struct path pilot_folder_of_run(const char *folder)
{
    struct path to;
    size_t length = strnlen(folder, PATH_ROOM - sizeof "_pilot");
    while (length > 1 && folder[length - 1] == '/') length--;
    snprintf(to.text, sizeof to.text, "%.*s_pilot", (int)length, folder);
    return to;
}

/* Returns the next cell of a line of a CSV table, terminated in place by a zero, and sets *line to the text after the
 * cell, or to NULL after the last cell. Returns NULL if *line is NULL. */
static char *cell_next(char **line)
{
    char *cell = *line;
    if (!cell) return NULL;
    char *comma = strchr(cell, ',');
    if (comma) *comma = '\0';
    *line = comma ? comma + 1 : NULL;
    return cell;
}

/* Indices of the columns `spacing_K [m]` and `uncertainty_K` in converge.csv, for each spacing level K = 0 .. levels -
 * 1. */
struct bar_columns {
    int spacing[16], half_width[16], levels;
};

/* Finds the columns of spacing and uncertainty of each spacing level in `header`, the first line of converge.csv, into
 * *c. Modifies `header`. */
static void columns_find(struct bar_columns *c, char *header)
{
    int column = 0, level;
    *c = (struct bar_columns){0};
    for (char *cell; (cell = cell_next(&header)); column++) {
        if (sscanf(cell, "spacing_%d [m]", &level) == 1 && level >= 0 && level < 16) {
            c->spacing[level] = column;
            c->levels = level + 1 > c->levels ? level + 1 : c->levels;
        } else if (sscanf(cell, "uncertainty_%d", &level) == 1 && level >= 0 && level < 16)
            c->half_width[level] = column;
    }
}

/* Reads a line of converge.csv into *bar: the name of a result, and the half-width of its error bar at the level whose
 * spacing is nearest to `spacing` [m]. c: columns of the table. Returns false if the spacing of no level agrees with
 * `spacing` to within the relative tolerance SAME_LEVEL. Modifies `line`. */
static bool bar_read(struct error_bar *bar, const struct bar_columns *c, char *line, double spacing)
{
    enum { CELLS_MOST = 256 };
    char *cell[CELLS_MOST];
    int cells = 0;
    double least = SAME_LEVEL;
    for (char *next; cells < CELLS_MOST && (next = cell_next(&line));) cell[cells++] = next;
    bar->half_width = NAN;
    for (int l = 0; l < c->levels; l++) {
        if (c->spacing[l] >= cells || c->half_width[l] >= cells) continue;
        const double off = fabs(atof(cell[c->spacing[l]]) / spacing - 1);
        if (!(off < least) || !*cell[c->half_width[l]]) continue;
        least = off;
        bar->half_width = atof(cell[c->half_width[l]]);
    }
    if (cells == 0 || !isfinite(bar->half_width) || strlen(cell[0]) >= sizeof bar->figure) return false;
    strcpy(bar->figure, cell[0]);
    return true;
}

int error_bars_read_from_convergence_study(struct error_bar *error_bars, int capacity, const struct scene *s,
                                           const char *folder)
{
    struct path study = study_beside(folder, s->name);
    struct bar_columns columns;
    char *text, *rest;
    size_t length;
    int n = 0;
    if (!study_folder_contains_study_of_scene(study.text, s->text)) {
        study = pilot_folder_of_run(folder);
        if (!study_folder_contains_study_of_scene(study.text, s->text)) return 0;
    }
    if (file_read_whole(path_join(study.text, "converge.csv").text, &text, &length) != OK) return 0;
    char *line = strtok_r(text, "\n", &rest);
    if (line) columns_find(&columns, line);
    while (line && n < capacity && (line = strtok_r(NULL, "\n", &rest)))
        n += bar_read(&error_bars[n], &columns, line, s->spacing);
    memory_free(text);
    return n;
}
