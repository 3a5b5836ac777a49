/* How the files of a run are made: paths, and whole files written aside, synced and renamed. */
#ifndef CLEAVE_OUTPUT_FILES
#define CLEAVE_OUTPUT_FILES

#include "base/base.h"

/* Room of a path, and of the longest name that is put behind a folder; output_open refuses longer folders. */
enum { PATH_ROOM = 4096, PATH_NAME_ROOM = 300 };

struct path {
    char text[PATH_ROOM];
};

struct path path_join(const char *folder, const char *name);
/* Makes a folder and those above it, unless they exist. REFUSED where a file has such a name; FAILED if it cannot be
 * made. */
status folder_make(const char *path);
/* Ending of a file that is being written. It names the program, so that no file of others has it. */
#define ASIDE_ENDING ".cleave.tmp"
/* PATH.cleave.tmp, where a file is written before it is renamed. */
struct path path_aside(const char *path);
/* Returns path_aside(path) for a file that is about to be written there, and keeps it in a list of unfinished files
 * until file_publish or file_discard of the same `path`. */
struct path file_begin(const char *path);
/* Removes what the list of unfinished files names: before the program ends by a fault of its own. */
void files_unfinished_remove(void);
bool path_exists(const char *path);
bool path_is_link(const char *path);
bool path_is_file(const char *path);
bool path_is_folder(const char *path);

/* FAILED with `cannot write PATH: cause; remedy`; `cause` is an errno, 0 if it is not known. */
status file_fault(const char *path, int cause);

/* REFUSED if a file of this name must be neither replaced nor removed: it is an input of this command, or a pipe,
 * socket or device. OK if there is no such file. */
status file_guard(const char *path);
/* REFUSED if there is a file of this name that begins with none of the n texts, as those of Cleave do; one that is cut
 * short begins with as much of them as it has. */
status file_begin_guard(const char *path, const char *const *begin, size_t n);
/* Calls `each` for the files of a folder that `chosen` names, with `end` after their names; stops at the first fault. A
 * link is left alone. */
typedef status each_file(const char *path);
status files_each(const char *folder, bool (*chosen)(const char *name, const char *end), const char *end,
                  each_file *each);
/* Returns true if the file has exactly these bytes. */
bool file_holds(const char *path, const void *bytes, size_t length);

/* Writes `length` bytes as the whole file `path`: aside, sync, rename, sync of the folder. An input of this command is
 * left as it is: OK if it has these bytes, else REFUSED. */
status file_put(const char *path, const void *bytes, size_t length);
/* The same for one of many: the folder is synced once, by file_settle for any of them. */
status file_put_unsettled(const char *path, const void *bytes, size_t length);
/* Makes the name of a new file or folder last: syncs the folder it is in, where that may be read. */
status file_settle(const char *path);

/* Appends `length` bytes (0: none) to PATH.cleave.tmp and syncs it. On a fault PATH.cleave.tmp is removed. */
status file_seal(const char *path, const void *tail, size_t length);

/* Renames the sealed PATH.cleave.tmp to `path` and syncs the folder. On a fault PATH.cleave.tmp is removed. */
status file_publish(const char *path);

/* Removes PATH.cleave.tmp and gives its space back even if the file is still open. */
void file_discard(const char *path);

/* Reads a whole regular file; a 0 stands behind its last byte. Free with memory_free. */
status file_get(const char *path, char **text, size_t *length);

#endif
