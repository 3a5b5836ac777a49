/* Files of pictures: checked, marked as Cleave's, synced and renamed when they are whole. */
#ifndef CLEAVE_PICTURE_FILE
#define CLEAVE_PICTURE_FILE

#include "base/base.h"

enum picture_format { PICTURE_PNG, PICTURE_SVG, PICTURE_PDF, PICTURE_MP4, PICTURE_GIF, PICTURE_FORMATS };

/* Ends the picture PATH.tmp of this format: checks that it is whole, writes the mark of Cleave into it, syncs it and
 * renames it to `path`. FAILED if it is missing or cut short, as on a full disk; PATH.tmp is removed then, and a file
 * that was at `path` stays. */
status picture_publish(const char *path, enum picture_format format);

/* Returns true if the file has the mark that picture_publish writes. */
bool picture_is_ours(const char *path);

/* REFUSED if there is a file of this name without that mark. */
status picture_guard(const char *path);

#endif
