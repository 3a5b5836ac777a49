/* Completes picture files: checks that they are whole, marks them as written by Cleave, syncs and renames them. */
#ifndef CLEAVE_PICTURE_FILE
#define CLEAVE_PICTURE_FILE

#include "base/base.h"

enum picture_format { PICTURE_PNG, PICTURE_SVG, PICTURE_PDF, PICTURE_MP4, PICTURE_GIF, PICTURE_FORMATS };

/* Completes the picture PATH.tmp: checks that it is whole, writes the mark of Cleave into it, syncs it and renames it
 * to `path`. FAILED if the file is missing or incomplete, for example on a full disk; then PATH.tmp is removed and an
 * existing file at `path` stays. */
status picture_publish(const char *path, enum picture_format format);

/* Returns true if the file has the mark that picture_publish writes. */
bool picture_is_ours(const char *path);

/* Checks that a picture may replace the file `path`. REFUSED if there is such a file and it lacks the mark of
 * Cleave. */
status picture_guard(const char *path);

#endif
