/* Paths, and files that are written under a temporary name, synced and renamed. */
#ifndef CLEAVE_OUTPUT_FILES
#define CLEAVE_OUTPUT_FILES

#include "base/base.h"

/* Capacity of a path, and of the longest name that is appended to a folder [byte]; output_open refuses longer
 * folders. */
enum { PATH_ROOM = 4096, PATH_NAME_ROOM = 300 };

/* A path as a text that ends with a 0 byte; "" for a path that was too long. */
struct path {
    char text[PATH_ROOM];
};

/* Returns the path `folder`/`name`. Returns an empty path if it would exceed the capacity of struct path; every system
 * call refuses an empty path. */
struct path path_join(const char *folder, const char *name);

/* Writes the last part of `path` (the name of the file or folder, without trailing slashes) to name[capacity], cut to
 * capacity - 1 bytes. Returns name. */
char *path_copy_base_name(char *name, size_t capacity, const char *path);

/* Returns the path frames/NNNNNN.hdf, in the folder of a run, of the frame with the number NNNNNN = frame_number; an
 * empty path if it would be too long. */
struct path run_frame_path(const char *folder, int frame_number);

/* Creates the folder `path` and its parent folders unless they exist. Returns REFUSED if the path is too long or a
 * file has the name of such a folder; FAILED if a folder cannot be created. */
status folder_create_with_parents(const char *path);

/* Creates the folder that shall contain the file `path`, and its parent folders, unless they exist. Returns REFUSED if
 * the path is too long or a file has the name of such a folder; FAILED if a folder cannot be created. */
status folder_create_parents_of_file(const char *path);

/* Ending of the names of temporary files. It contains the name of the program, so that files of other programs do not
 * have it. */
#define ASIDE_ENDING ".cleave.tmp"
/* Returns PATH.cleave.tmp, the temporary name under which a file is written before it is renamed to `path`. */
struct path path_of_temporary_file(const char *path);

/* Returns the temporary name PATH.cleave.tmp of `path` and adds `path` to the list of unfinished files, whose temporary
 * files are removed if the program fails. file_replace_by_temporary or file_discard_temporary with the same path
 * removes it from the list. */
struct path file_register_temporary_and_return_path(const char *path);

/* Removes the temporary files of all files whose writing has begun with file_register_temporary_and_return_path and is
 * not finished. To be called before the program ends because of an internal fault. */
void files_remove_unfinished_temporaries(void);

/* Returns true if a file, folder, link or other entry called `path` exists; a link counts even if its target is
 * missing. */
bool path_exists(const char *path);

/* Returns true if a symbolic link called `path` exists. */
bool path_is_link(const char *path);

/* Returns true if `path` is a regular file or a link to one. */
bool path_is_file(const char *path);

/* Returns true if `path` is a folder or a link to one. */
bool path_is_folder(const char *path);

/* Sets the message `cannot write PATH: cause; remedy` for the file `path` and returns FAILED. cause: value of errno
 * after the failed call; 0 if unknown. */
status file_report_write_failure(const char *path, int cause);

/* Checks that the file `path` may be replaced or removed. Returns REFUSED, with a message, if it is an input of the
 * command that is running, or a pipe, socket or device; OK otherwise, also if there is no such file. */
status file_check_replaceable(const char *path);

/* Checks that the file `path` begins as a file of Cleave does, so that it may be replaced. beginning[beginning_count]:
 * the possible beginnings; a file shorter than a beginning must agree with it to the end of the file. Returns OK also
 * if there is no such file; REFUSED if no beginning agrees. */
status file_check_has_known_beginning(const char *path, const char *const *beginning, size_t beginning_count);

/* Type of a function that folder_visit_selected_files calls for a file. path: path of the file. Returns OK to continue;
 * any other status ends the visit, and folder_visit_selected_files returns it. */
typedef status file_visit_fn(const char *path);

/* Calls visit(path) for every file in `folder` for whose name name_is_chosen(name, ending) returns true. ending: passed
 * on to name_is_chosen. Links are skipped. Stops at the first call of `visit` that does not return OK, and returns its
 * status; otherwise returns OK. */
status folder_visit_selected_files(const char *folder, bool (*name_is_chosen)(const char *name, const char *ending),
                                   const char *ending, file_visit_fn *visit);

/* Returns true if the file `path` has exactly the given contents, `length` bytes from `bytes` on; false also if it
 * cannot be read. */
bool file_contents_equal_bytes(const char *path, const void *bytes, size_t length);

/* Writes `length` bytes from `bytes` on as the complete file `path`: under a temporary name, which is synchronised with
 * the disk and renamed. Then the folder is synchronised. A file that is an input of the command that is running is
 * never replaced: returns OK if it already has these contents, else REFUSED. Returns FAILED if the file cannot be
 * written. */
status file_write_whole(const char *path, const void *bytes, size_t length);

/* Writes `length` bytes from `bytes` on as the complete file `path`, under a temporary name that is synchronised with
 * the disk and renamed. The folder is not synchronised: after many files in one folder, call file_sync_parent_folder
 * once for one of them. A file that is an input of the command that is running is never replaced: returns OK if it
 * already has these contents, else REFUSED. Returns FAILED if the file cannot be written. */
status file_write_whole_unsynced(const char *path, const void *bytes, size_t length);

/* Syncs the folder that holds the file `path`, so that a new name survives a crash of the machine. A folder that may
 * not be read is skipped. Returns FAILED if the sync fails. */
status file_sync_parent_folder(const char *path);

/* Appends `length` bytes (may be 0) from `tail` on to PATH.cleave.tmp, the temporary file of `path`, and synchronises
 * it with the disk. Returns FAILED, with PATH.cleave.tmp removed, if it cannot be written. */
status file_append_and_sync(const char *path, const void *tail, size_t length);

/* Renames PATH.cleave.tmp, the temporary file of `path`, to `path` and synchronises the folder with the disk. Returns
 * REFUSED if the existing file `path` must not be replaced (file_check_replaceable), FAILED if the renaming or the
 * synchronisation fails. If the file is not renamed, PATH.cleave.tmp is removed. */
status file_replace_by_temporary(const char *path);

/* Removes PATH.cleave.tmp, the temporary file of `path`, and frees its disk space even if the file is still open. */
void file_discard_temporary(const char *path);

/* Reads the complete regular file `path`. Stores an allocated text in *text, which the caller releases with
 * memory_free, and its length [byte] in *length; a 0 byte follows the last byte. Returns FAILED, with no memory to
 * release, if the file cannot be read. */
status file_read_whole(const char *path, char **text, size_t *length);

#endif
