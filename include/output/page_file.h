/* Pages of `cleave report`: their name in the folder of a run or study, and how they are recognised. */
#ifndef CLEAVE_PAGE_FILE
#define CLEAVE_PAGE_FILE

#include "base/base.h"

/* Name of the page in the folder of a run or a study; first characters of every page. */
#define PAGE_NAME "report.html"
#define PAGE_BEGINNING "<!doctype html>\n<!-- page of cleave report -->\n"

/* Returns true if the regular file `path` begins as a page does. */
bool page_file_is_from_cleave(const char *path);

/* Removes the page in the folder of a run that is overwritten; a file of this name that is no page stays. */
void page_file_remove(const char *folder);

#endif
