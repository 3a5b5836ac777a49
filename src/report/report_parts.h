/* Parts of a page, each written from files of the folder. */
#ifndef CLEAVE_REPORT_PARTS
#define CLEAVE_REPORT_PARTS

#include "page.h"
#include "report/report.h"

/* Writes the entries of a page about a run: summary with units, scene, picture of the scene, history, frames. r:
 * request with the folder of the run; path: file of the page, beside which the picture is written temporarily. Returns
 * FAILED if frames or history cannot be read. */
status report_write_run(struct page *p, const struct report_request *r, const char *path);

/* Writes the entries of a page about a sweep or a convergence study in `folder`: table, scene, pictures, and the
 * warnings of its runs. */
void report_write_study(struct page *p, const char *folder);

#endif
