/* Pages of `cleave report`: their name in the folder of a run or study, and how they are recognised. */
#ifndef CLEAVE_PAGE_FILE
#define CLEAVE_PAGE_FILE

#include "base/base.h"

/* PAGE_NAME: name of the page in the folder of a run or a study; PAGE_BEGINNING: first characters of every page, by
 * which it is recognised. */
#define PAGE_NAME "report.html"
#define PAGE_BEGINNING "<!doctype html>\n<!-- page of cleave report -->\n"

/* Returns true if the regular file `path` begins with PAGE_BEGINNING, i.e. is a page that Cleave wrote. */
bool report_page_is_from_cleave(const char *path);

/* Removes the page report.html from `folder`, the folder of a run that is to be overwritten. A file of this name that
 * Cleave did not write stays. */
void report_page_remove_from_folder(const char *folder);

#endif
