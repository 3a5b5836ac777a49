/* Paths, and files that are written under a temporary name, synced and renamed. */
#ifndef CLEAVE_OUTPUT_FILES
#define CLEAVE_OUTPUT_FILES

#include "base/base.h"

/* Capacity of a path, and of the longest name that is appended to a folder [byte]; output_open refuses longer
 * folders. */
enum { PATH_ROOM = 4096, PATH_NAME_ROOM = 300 };

struct path {
    char text[PATH_ROOM];
};

/* Returns folder/name. The result is empty if it is too long, so that every system call refuses it. */
struct path path_join(const char *folder, const char *name);

/* Creates a folder and its parent folders unless they exist. REFUSED if a file has such a name; FAILED if a folder
 * cannot be created. */
status folder_make(const char *path);

/* Ending of the names of temporary files. It contains the name of the program, so that files of other programs do not
 * have it. */
#define ASIDE_ENDING ".cleave.tmp"
/* Returns PATH.cleave.tmp, the temporary name under which a file is written before it is renamed to `path`. */
struct path path_aside(const char *path);

/* Returns path_aside(path) and adds `path` to the list of unfinished files; file_publish or file_discard of the same
 * `path` removes it from the list. */
struct path file_begin(const char *path);

/* Removes the temporary files of the list of unfinished files. Call before the program ends because of an internal
 * fault. */
void files_unfinished_remove(void);

/* Returns true if anything has this name; a link counts even if its target is missing. */
bool path_exists(const char *path);

/* Returns true if a symbolic link has this name. */
bool path_is_link(const char *path);

/* Returns true if a regular file, or a link to one, has this name. */
bool path_is_file(const char *path);

/* Returns true if a folder has this name; a link to a folder counts. */
bool path_is_folder(const char *path);

/* Sets the message `cannot write PATH: cause; remedy` and returns FAILED. cause: an errno; 0 if unknown. */
status file_fault(const char *path, int cause);

/* Checks that a file may be replaced or removed. REFUSED if it is an input of this command, or a pipe, socket or
 * device. OK if there is no such file. */
status file_guard(const char *path);

/* Checks that a file begins as files of Cleave do. begin[n]: the possible beginnings; a shorter file must agree with
 * one of them to its end. OK if there is no such file; REFUSED otherwise. */
status file_begin_guard(const char *path, const char *const *begin, size_t n);

/* Action on one file. */
typedef status each_file(const char *path);

/* Calls `each` for the files in `folder` for whose name chosen(name, end) returns true. Links are skipped. Stops at the
 * first fault and returns it. */
status files_each(const char *folder, bool (*chosen)(const char *name, const char *end), const char *end,
                  each_file *each);

/* Returns true if the file has exactly these `length` bytes. */
bool file_holds(const char *path, const void *bytes, size_t length);

/* Writes `length` bytes as the complete file `path`: temporary name, sync, rename, sync of the folder. An input of this
 * command is never replaced: OK if it already has these bytes, else REFUSED. */
status file_put(const char *path, const void *bytes, size_t length);

/* Writes a file as file_put does, but without the sync of the folder. For many files in one folder: call file_settle
 * once for one of them at the end. */
status file_put_unsettled(const char *path, const void *bytes, size_t length);

/* Syncs the folder that holds `path`, so that a new name survives a crash. A folder that may not be read is skipped. */
status file_settle(const char *path);

/* Appends `length` bytes (may be 0) to PATH.cleave.tmp and syncs the file. On a fault PATH.cleave.tmp is removed. */
status file_seal(const char *path, const void *tail, size_t length);

/* Renames the synced PATH.cleave.tmp to `path` and syncs the folder. On a fault PATH.cleave.tmp is removed. */
status file_publish(const char *path);

/* Removes PATH.cleave.tmp and frees its disk space even if the file is still open. */
void file_discard(const char *path);

/* Reads a complete regular file. Stores an allocated text in *text, which the caller releases with memory_free, and its
 * length in *length; a 0 byte follows the last byte. FAILED if the file cannot be read. */
status file_get(const char *path, char **text, size_t *length);

#endif
