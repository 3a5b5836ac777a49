/* Completes picture files: checks that they are whole, marks them as written by Cleave, syncs and renames them. */
#ifndef CLEAVE_PICTURE_FILE
#define CLEAVE_PICTURE_FILE

#include "base/base.h"

/* Formats of pictures and films; PICTURE_FORMATS: number of formats. */
enum picture_format { PICTURE_PNG, PICTURE_SVG, PICTURE_PDF, PICTURE_MP4, PICTURE_GIF, PICTURE_FORMATS };

/* Completes the picture of `format` in PATH.cleave.tmp, the temporary file of `path`: checks that the file is complete,
 * writes a mark into it by which Cleave recognises its own pictures, synchronises it with the disk and renames it to
 * `path`. Returns FAILED if the file is missing or incomplete, for example on a full disk. The temporary file is
 * removed then, and an existing file at `path` remains. */
status picture_complete_and_rename_temporary(const char *path, enum picture_format format);

/* Returns true if the file `path` has the mark by which Cleave recognises its own pictures. */
bool picture_file_is_from_cleave(const char *path);

/* Checks that a picture may be written to the file `path`. Returns REFUSED if there is such a file and it lacks the
 * mark of Cleave; OK if there is no such file. */
status picture_check_replaceable(const char *path);

#endif
