/* Runs `cleave report`: determines whether the folder contains a run or a study (a series of runs), and where the page
 * is written. */
#include "report/report.h"

#include <stdio.h>
#include <string.h>
#include <time.h>

#include "base/program_commit.h"
#include "base/team.h"
#include "output/output_files.h"
#include "output/page_file.h"
#include "plot/plot.h"
#include "report_parts.h"

/* Returns OK if `folder` contains a run (frames or history.csv) or a study, a series of runs (sweep.csv or
 * converge.csv), else REFUSED, with a message. */
static status folder_check_kind(const char *folder)
{
    const struct printable_name shown = printable_name(folder);
    if (path_exists(folder) && !path_is_folder(folder))
        return status_set(REFUSED, "%s is a file; give the folder of a run or a study", shown.text);
    if (strlen(folder) + PATH_NAME_ROOM >= PATH_ROOM)
        return status_set(REFUSED, "%s: the name is too long; choose a shorter one", shown.text);
    if (folder_contains_study_table(folder) || run_folder_has_file(folder, "frames.hdf.series") ||
        run_folder_has_file(folder, "history.csv"))
        return OK;
    if (run_folder_has_file(folder, "study.yaml"))
        return status_set(
            REFUSED, "%s contains a study without a table; run its command again with --collect once a run is done",
            shown.text);
    return status_set(REFUSED,
                      "%s contains neither a run (frames or history.csv) nor a study (sweep.csv, converge.csv); give "
                      "the folder of one",
                      shown.text);
}

/* Determines *path, the path of the page of request r: the option -o, or report.html in the folder. Creates the folder
 * of -o if its name ends in /. Returns REFUSED, with a message, if the name is empty or too long. Without --overwrite,
 * also returns REFUSED if the page would replace a file that is no page of Cleave. */
static status page_destination(struct path *path, const struct report_request *r)
{
    const char *out = r->out ? r->out : r->folder;
    const size_t length = strlen(out);
    if (length == 0 || length + PATH_NAME_ROOM >= PATH_ROOM)
        return status_set(REFUSED, "report: -o '%s': give the name of a file or folder", printable_name(out).text);
    snprintf(path->text, sizeof path->text, "%s", out);
    for (size_t end = length; end > 1 && path->text[end - 1] == '/'; end--) path->text[end - 1] = '\0';
    TRY(folder_create_parents_of_file(out));
    if (path_is_folder(path->text)) *path = path_join(path->text, PAGE_NAME);
    TRY(file_check_replaceable(path->text));
    if (r->overwrite || !path_exists(path->text) || report_page_is_from_cleave(path->text)) return OK;
    return status_set(REFUSED,
                      "%s exists and is not a page of cleave; choose another -o, or replace it with --overwrite",
                      printable_name(path->text).text);
}

/* Adds the SI prefixes of units to the JSON text of the page p, as a list of factors and names. */
static void write_prefixes(struct html_page *p)
{
    json_begin_object_or_list(&p->json, "prefixes", '[');
    for (int k = 0; k < UNIT_PREFIXES; k++) {
        json_begin_object_or_list(&p->json, NULL, '[');
        json_write_real(&p->json, NULL, unit_prefix[k].factor);
        json_write_text(&p->json, NULL, unit_prefix[k].name);
        json_end_object_or_list(&p->json, ']');
    }
    json_end_object_or_list(&p->json, ']');
}

/* Writes the entries that all pages have to the page p: the folder of the request r, the version, commit, processor
 * and time with which the page is made, and the prefixes of units. */
static void write_origin(struct html_page *p, const struct report_request *r)
{
    json_write_text(&p->json, "folder", r->folder);
    json_write_text(&p->json, "version", CLEAVE_VERSION);
    json_write_text(&p->json, "commit", program_commit());
    json_write_text(&p->json, "machine", machine_processor_name());
    html_page_add_time(p, "made", time(NULL));
    write_prefixes(p);
}

static status report_page(const struct report_request *r, const struct path *path)
{
    struct html_page p;
    char name[NAME_MAX_LENGTH];
    int64_t bytes = 0;
    TRY(html_page_begin_in_memory(&p));
    write_origin(&p, r);
    status s = OK;
    if (folder_contains_study_table(r->folder))
        report_add_study_entries_to_page(&p, r->folder);
    else
        s = report_add_run_entries_to_page(&p, r, path->text);
    if (s == OK)
        s = html_page_complete_and_write_file(&p, path->text, path_copy_base_name(name, sizeof name, r->folder),
                                              &bytes);
    html_page_release(&p);
    TRY(s);
    if (r->quiet) return OK;
    const int said =
        printf("%s: %.1f MB, opens in any browser\n", printable_name(path->text).text, 1e-6 * (double)bytes);
    return said < 0 || fflush(stdout) != 0 ? status_set(FAILED, "cannot write to standard output") : OK;
}

status report_write_html_page(const struct report_request *r)
{
    struct path path;
    TRY(folder_check_kind(r->folder));
    TRY(page_destination(&path, r));
    return report_page(r, &path);
}
