/* Writes the page of a study (a series of runs with varied keys): its table, its pictures, and warnings and failures of
 * its runs. */
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/arrays.h"
#include "base/memory.h"
#include "output/history.h"
#include "output/output_files.h"
#include "output/picture_file.h"
#include "output/pictures.h"
#include "output/summary_read.h"
#include "report_parts.h"
#include "scene/words.h"
#include "study/study.h"

/* PICTURES_MOST, WARNINGS_MOST, REASONS_MOST: largest numbers of pictures, warnings and reasons of failures on the
 * page. MESSAGE_ROOM: capacity of the text of a warning or reason [byte]. */
enum { PICTURES_MOST = 12, WARNINGS_MOST = 20, MESSAGE_ROOM = 600, REASONS_MOST = 100 };

static int name_compare(const void *a, const void *b) { return strcmp(*(char *const *)a, *(char *const *)b); }

/* Lists the names of the entries of a folder, except hidden ones, in alphabetical order. Stores an allocated array of
 * them in *name and returns their number. Release names and array with folder_names_free. */
static int folder_names_read(char ***name, const char *folder)
{
    int n = 0;
    DIR *d = opendir(folder);
    *name = NULL;
    for (struct dirent *e; d && (e = readdir(d));) {
        if (e->d_name[0] == '.') continue;
        GROW("report.names", *name, n + 1);
        (*name)[n] = NEW("report.name", (int64_t)strlen(e->d_name) + 1, char);
        strcpy((*name)[n++], e->d_name);
    }
    if (d) closedir(d);
    array_sort(*name, n, sizeof **name, name_compare);
    return n;
}

static void folder_names_free(char **name, int n)
{
    for (int k = 0; k < n; k++) memory_free(name[k]);
    memory_free(name);
}

/* Returns the format in which a page can show the picture file called `name`: PAGE_PNG or PAGE_SVG; PAGE_TYPES for
 * other files. */
static enum page_type picture_format_of(const char *name)
{
    const char *ending = strrchr(name, '.');
    if (ending && strcmp(ending, ".png") == 0) return PAGE_PNG;
    return ending && strcmp(ending, ".svg") == 0 ? PAGE_SVG : PAGE_TYPES;
}

/* Adds the picture of a study in the file `path` to the page p as an element of a list. name: its name. */
static void write_study_picture(struct html_page *p, const char *name, const char *path)
{
    json_begin_object_or_list(&p->json, NULL, '{');
    json_write_text(&p->json, "name", name);
    (void)html_page_add_picture(p, "of", picture_format_of(name), path);
    json_end_object_or_list(&p->json, '}');
}

/* Adds the pictures that Cleave has drawn for the study in `folder` to the page p, at most PICTURES_MOST, and the names
 * of those that the page does not show. */
static void write_pictures(struct html_page *p, const char *folder)
{
    char **name;
    int added = 0;
    const struct path pictures = pictures_folder(folder);
    const int n = folder_names_read(&name, pictures.text);
    bool *left = NEW("report.left", n, bool);
    json_begin_object_or_list(&p->json, "pictures", '[');
    for (int k = 0; k < n; k++) {
        const struct path path = path_join(pictures.text, name[k]);
        if (!path_is_file(path.text) || !picture_file_is_from_cleave(path.text)) continue;
        left[k] = picture_format_of(name[k]) == PAGE_TYPES || added == PICTURES_MOST;
        if (left[k]) continue;
        write_study_picture(p, name[k], path.text);
        added++;
    }
    json_end_object_or_list(&p->json, ']');
    json_begin_object_or_list(&p->json, "pictures_left_out", '[');
    for (int k = 0; k < n; k++)
        if (left[k]) json_write_text(&p->json, NULL, name[k]);
    json_end_object_or_list(&p->json, ']');
    memory_free(left);
    folder_names_free(name, n);
}

/* Adds the warnings of the runs of the study in `folder` to the page p, each text once and at most WARNINGS_MOST. */
static void write_warnings(struct html_page *p, const char *folder)
{
    char **name, key[32], text[MESSAGE_ROOM];
    static char seen[WARNINGS_MOST][MESSAGE_ROOM];
    int found = 0;
    const int n = folder_names_read(&name, folder);
    json_begin_object_or_list(&p->json, "warnings", '[');
    for (int k = 0; k < n; k++) {
        const struct path run = path_join(folder, name[k]);
        if (!path_is_file(path_join(run.text, "summary.json").text)) continue;
        for (int w = 0; found < WARNINGS_MOST; w++) {
            bool known = false;
            snprintf(key, sizeof key, "warnings.%d", w);
            if (summary_read_string(run.text, key, text, sizeof text) != OK) break;
            for (int j = 0; j < found; j++) known |= strcmp(seen[j], text) == 0;
            if (known) continue;
            strcpy(seen[found++], text);
            json_write_text(&p->json, NULL, text);
        }
    }
    json_end_object_or_list(&p->json, ']');
    folder_names_free(name, n);
}

/* Returns true if the run in `folder` has a summary.json whose state is "done". */
static bool run_is_done(const char *folder)
{
    char state[32] = "";
    if (summary_read_string(folder, "status", state, sizeof state) != OK) return false;
    return strcmp(state, "done") == 0;
}

/* Adds the reasons for which runs of the study in `folder` have failed to the page p, with the names of the runs, at
 * most REASONS_MOST. */
static void write_reasons(struct html_page *p, const char *folder)
{
    char **log, text[MESSAGE_ROOM];
    int written = 0;
    const int n = folder_names_read(&log, path_join(folder, "logs").text);
    json_begin_object_or_list(&p->json, "reasons", '{');
    for (int k = 0; k < n && written < REASONS_MOST; k++) {
        char *ending = strrchr(log[k], '.');
        if (!ending || strcmp(ending, ".txt") != 0) continue;
        *ending = '\0';
        if (run_is_done(path_join(folder, log[k]).text)) continue;
        study_read_reason_of_failure(text, sizeof text, folder, log[k]);
        json_write_text(&p->json, log[k], text);
        written++;
    }
    json_end_object_or_list(&p->json, '}');
    folder_names_free(log, n);
}

/* Adds the units of the columns of sweep.csv to the page p: for varied keys the units of numbers without a unit, for
 * results the units in the header of history.csv of the first run that has such a file. folder: folder of the study. */
static void write_study_units(struct html_page *p, const char *folder)
{
    char **name, header[HEADER_ROOM] = "", unit[UNIT_ROOM], *table = NULL;
    size_t length = 0;
    const int n = folder_names_read(&name, folder);
    for (int k = 0; k < n && !header[0]; k++)
        history_read_header(header, sizeof header, path_join(folder, name[k]).text);
    folder_names_free(name, n);
    if (file_read_whole(path_join(folder, "sweep.csv").text, &table, &length) != OK) return;
    table[strcspn(table, "\r\n")] = '\0';
    json_begin_object_or_list(&p->json, "units", '{');
    bool keys = true; /* the varied keys are before the results, of which `steps` is the first */
    for (char *rest = table, *column; (column = strsep(&rest, ","));) {
        keys = keys && strcmp(column, "steps") != 0;
        if (keys)
            snprintf(unit, sizeof unit, "%s", scene_key_unit(column));
        else
            study_determine_unit_of_result(unit, sizeof unit, header, column);
        if (unit[0]) json_write_text(&p->json, column, unit);
    }
    json_end_object_or_list(&p->json, '}');
    memory_free(table);
}

void report_add_study_entries_to_page(struct html_page *p, const char *study_folder)
{
    const bool sweep = path_is_file(path_join(study_folder, "sweep.csv").text);
    json_write_text(&p->json, "kind", sweep ? "sweep" : "converge");
    html_page_add_text_file(p, "table", study_folder, sweep ? "sweep.csv" : "converge.csv");
    html_page_add_text_file(p, "scene", study_folder, STUDY_SCENE);
    char *options = study_options_read(study_folder);
    if (options) json_write_text(&p->json, "options", options);
    memory_free(options);
    if (sweep) write_study_units(p, study_folder);
    write_warnings(p, study_folder);
    write_reasons(p, study_folder);
    write_pictures(p, study_folder);
}
