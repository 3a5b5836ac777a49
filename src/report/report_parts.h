/* Parts of a page, each written from files of the folder. */
#ifndef CLEAVE_REPORT_PARTS
#define CLEAVE_REPORT_PARTS

#include "page.h"
#include "report/report.h"

/* Writes the entries of the folder of a run: summary with units, scene, picture of the scene, history, frames.
 * path: the page, beside which the picture is drawn for a moment. Returns FAILED if frames or history cannot be
 * read. */
status report_write_run(struct page *p, const struct report_request *r, const char *path);

/* Writes the entries of the folder of a sweep or a convergence study: table, scene, pictures, warnings of its runs. */
void report_write_study(struct page *p, const char *folder);

#endif
