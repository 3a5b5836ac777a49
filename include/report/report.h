/* Room `report` (folder of include/ and src/): writes an HTML page about a run or a study (many variants of an input
 * file), from the files of its folder alone. It uses the pictures of the room `plot` and the units of the room `study`;
 * only commands call it. */
#ifndef CLEAVE_REPORT_PAGE
#define CLEAVE_REPORT_PAGE

#include "base/base.h"

/* Options of `cleave report`, which writes a page of HTML about a run or a study. */
struct report_request {
    const char *folder; /* folder of a run, a sweep or a convergence study */
    const char *out;    /* file, or folder for report.html; NULL: FOLDER/report.html */
    bool overwrite;     /* replace a file that is no page of Cleave */
    bool quiet;         /* do not print the name of the page */
};

/* Writes a page about the run or study in the folder r->folder: one HTML file that needs no other file and no network.
 * The run may be finished, interrupted or still running. Prints the name of the page and its size. Returns REFUSED if
 * the folder contains neither a run nor a study, or if the page would replace a file that is no page of Cleave; FAILED
 * if a file cannot be read or written. */
status report_write_html_page(const struct report_request *r);

#endif
