/* Declares the functions that write the contents of an HTML report from the files in the folder of a run or study. */
#ifndef CLEAVE_REPORT_PARTS
#define CLEAVE_REPORT_PARTS

#include "page.h"
#include "report/report.h"

/* Writes the entries of a page p (HTML report) about a run: summary with units, input file, picture of the set-up,
 * history, output frames. request: request with the folder of the run; page_path: file of the page, beside which the
 * picture is written temporarily. Returns FAILED if frames or history cannot be read. */
status report_add_run_entries_to_page(struct html_page *p, const struct report_request *request, const char *page_path);

/* Writes the entries of a page p (HTML report) about a sweep or a convergence study in `study_folder`: table, input
 * file, pictures, and the warnings of its runs. */
void report_add_study_entries_to_page(struct html_page *p, const char *study_folder);

#endif
