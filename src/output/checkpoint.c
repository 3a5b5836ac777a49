/* Writes and reads checkpoints, from which an interrupted simulation is resumed. The newest and the previous checkpoint
 * are kept as complete files, so that one remains if the process is killed, the disk is full or a file is damaged.
 *
 * Format: an HDF5 file with /Cleave (attribute `version`, dataset `scene`) and /state (one array of bytes for each
 * archive entry), then a footer with a hash (checksum.h). A file is passed to HDF5 only if its hash is right. */
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/crash_message.h"
#include "base/memory.h"
#include "output/output.h"
#include "output/output_files.h"
#include "output/scene_text.h"
#include "output/checksum.h"
#include "output/output_hdf5.h"

enum { SCENE_LONGEST = 256 << 20 }; /* largest text of a scene in a checkpoint [byte]: far more than any scene has */
enum { CHECKPOINT_VERSION = 20 };   /* version of the format; other versions are refused */
static const char newest_name[] = "checkpoint.h5", previous_name[] = "checkpoint.previous.h5",
                  damaged_name[] = "checkpoint.damaged.h5";

/* ---- archive entries --------------------------------------------------------------------------------------------- */

/* Composes path[capacity], the path of the archive entry called `name` in the HDF5 file. All entries are in the group
 * /state. Each '/' in a name becomes '.', because HDF5 would read it as a group, which fails if the part before it is
 * the name of an entry, too. */
static void entry_path(char *path, size_t capacity, const char *name)
{
    int length = snprintf(path, capacity, "/state/%s", name);
    INVARIANT(length > 0 && (size_t)length < capacity);
    for (char *c = path + strlen("/state/"); *c; c++) *c = *c == '/' ? '.' : *c;
}

/* Writes one entry of the archive a: `size` bytes of `data` under `name`. Returns FAILED after a fault of the file. The
 * fault is recorded in the struct hdf of the file, so that the function that opened the file reports it. */
static status entry_save(struct archive *a, const char *name, void *data, size_t size)
{
    struct hdf *hdf = a->file;
    char path[PATH_NAME_ROOM];
    entry_path(path, sizeof path, name);
    hdf_write_rows(hdf, path, HDF_U8, (int64_t)size, 1, data);
    return hdf->failed ? FAILED : OK;
}

/* Reads one entry of the archive a, `size` bytes under `name`, into `data`. Returns FAILED if the entry is missing, of
 * another size or unreadable, with a message. */
static status entry_restore(struct archive *a, const char *name, void *data, size_t size)
{
    struct hdf *hdf = a->file;
    char path[PATH_NAME_ROOM];
    entry_path(path, sizeof path, name);
    int64_t stored = hdf_dataset_element_count(hdf, path);
    if (stored != (int64_t)size)
        return status_set(FAILED,
                          "cannot resume: entry %s of the checkpoint has %lld bytes, but this program needs %zu; "
                          "restore the file from a copy, or start again with --overwrite",
                          name, (long long)stored, size);
    hdf_read_rows(hdf, path, HDF_U8, stored, data);
    return hdf->failed ? status_set(FAILED,
                                    "cannot resume: entry %s of the checkpoint cannot be read; restore the file from a "
                                    "copy, or start again with --overwrite",
                                    name)
                       : OK;
}

static int64_t checkpoint_entry_size(struct archive *a, const char *name)
{
    char path[PATH_NAME_ROOM];
    entry_path(path, sizeof path, name);
    return hdf_dataset_element_count(a->file, path);
}

static struct archive archive_of(struct hdf *hdf, bool saving)
{
    return (struct archive){.saving = saving,
                            .exchange = saving ? entry_save : entry_restore,
                            .stored_size = checkpoint_entry_size,
                            .file = hdf};
}

/* ---- writing ----------------------------------------------------------------------------------------------------- */

/* Writes the state of a run to an HDF5 file under the temporary name of `path`, without the footer (length and hash).
 * o: output of the run; scene_text: text of the input file (scene), which is stored in the file; archive_all(context,
 * a): must pass all entries of the state to the archive a. Returns FAILED, with a message, on a fault, with the file
 * removed. */
static status state_write(struct output *o, const char *path, const char *scene_text,
                          run_state_save_or_load_fn *archive_all, void *context)
{
    static const int32_t version = CHECKPOINT_VERSION;
    struct hdf f;
    hdf_create(&f, file_register_temporary_and_return_path(path).text, false);
    hdf_create_group(&f, "/Cleave");
    hdf_write_scalar_attribute(&f, "/Cleave", "version", HDF_I32, &version);
    hdf_write_rows(&f, "/Cleave/scene", HDF_U8, (int64_t)strlen(scene_text), 1, scene_text);
    hdf_create_group(&f, "/state");
    struct archive a = archive_of(&f, true);
    status s = f.failed ? FAILED : archive_all(context, &a);
    if (!f.failed) hdf_close(&f);
    if (!f.failed && s == OK) return OK;
    o->broken = f.failed;
    file_discard_temporary(path);
    return f.failed ? file_report_write_failure(path, f.cause) : s;
}

/* Synchronises history.csv of the output o with the disk. It is done before a checkpoint is written, since the run may
 * be resumed only from a checkpoint whose earlier samples are in the file. Returns OK without such a file; FAILED, with
 * a message, if it is not possible. */
static status history_sync(const struct output *o)
{
    if (!o->history || (fflush(o->history) == 0 && fsync(fileno(o->history)) == 0)) return OK;
    return file_report_write_failure(path_join(o->folder, "history.csv").text, errno);
}

status checkpoint_write(struct output *o, const char *scene_text, run_state_save_or_load_fn *save_or_load_all,
                        void *context)
{
    struct path newest = path_join(o->folder, newest_name), previous = path_join(o->folder, previous_name);
    TRY(output_wait_until_frame_is_written(
        o)); /* frames before a checkpoint must be on the disk; HDF5 serves one thread */
    if (o->broken) return FAILED;
    TRY(folder_check_lock_still_holds(&o->lock, o->folder));
    TRY(history_sync(o));
    TRY(state_write(o, newest.text, scene_text, save_or_load_all, context));
    /* The new file is whole and on the disk before the older one is renamed; a kill between the two renames leaves the
     * older one as checkpoint.previous.h5. */
    TRY(file_append_checksum_footer(newest.text));
    if (path_exists(newest.text) && rename(newest.text, previous.text) != 0) {
        int cause = errno;
        file_discard_temporary(newest.text);
        return file_report_write_failure(previous.text, cause);
    }
    return file_replace_by_temporary(newest.text);
}

/* ---- reading ----------------------------------------------------------------------------------------------------- */

/* Returns true if the open checkpoint `hdf` belongs to the scene with the text scene_text. */
static bool same_scene(struct hdf *hdf, const char *scene_text)
{
    int64_t length = hdf_dataset_element_count(hdf, "/Cleave/scene");
    if (length < 0 || length > SCENE_LONGEST) return false;
    char *stored = NEW("checkpoint.scene", length + 1, char);
    hdf_read_rows(hdf, "/Cleave/scene", HDF_U8, length, stored);
    const bool same =
        !hdf->failed && strlen(stored) == (size_t)length && scene_texts_describe_same_scene(stored, scene_text);
    memory_free(stored);
    return same;
}

/* Restores the state of a run from the checkpoint `path`, whose hash must have been checked. archive_all(context, a):
 * must read all entries of the state from the archive a. Returns FAILED, with a message, if the file has another
 * format, belongs to another scene than scene_text, or cannot be read. */
static status state_read(const char *path, const char *scene_text, run_state_save_or_load_fn *archive_all,
                         void *context)
{
    struct hdf f;
    int32_t version = 0;
    crash_message_set_file_in_use(path);
    hdf_open_for_reading(&f, path);
    if (!f.failed) hdf_read_attribute(&f, "/Cleave", "version", HDF_I32, &version);
    struct archive a = archive_of(&f, false);
    status s;
    if (f.failed)
        s = status_set(FAILED,
                       "cannot resume: %s is not a checkpoint of this program; restore it from a copy, or start again "
                       "with --overwrite",
                       path);
    else if (version != CHECKPOINT_VERSION)
        s = status_set(FAILED,
                       "cannot resume: checkpoint %s has format %d, but this program reads only format %d; start again "
                       "with --overwrite, or use the version that wrote it",
                       path, (int)version, CHECKPOINT_VERSION);
    else if (!same_scene(&f, scene_text))
        s = status_set(FAILED, "cannot resume: %s belongs to another scene; restore that scene, or choose another -o",
                       path);
    else
        s = archive_all(context, &a);
    hdf_close(&f);
    crash_message_set_file_in_use(NULL);
    if (f.failed && f.cause)
        return status_set(
            FAILED, "cannot resume: %s cannot be read (%s); restore it from a copy, or start again with --overwrite",
            path, strerror(f.cause));
    return s;
}

status checkpoint_read(const struct output *o, const char *scene_text, run_state_save_or_load_fn *save_or_load_all,
                       void *context)
{
    struct path newest = path_join(o->folder, newest_name), previous = path_join(o->folder, previous_name);
    const char *fault = file_describe_damage(newest.text);
    if (!fault) return state_read(newest.text, scene_text, save_or_load_all, context);
    const char *older_fault = file_describe_damage(previous.text);
    if (older_fault)
        return status_set(FAILED,
                          "cannot resume from the folder %s: the file %s %s, and the previous one, %s, %s; restore one "
                          "of the two from a copy, or start again with --overwrite",
                          o->folder, newest_name, fault, previous_name, older_fault);
    fprintf(stderr, "%s %s: resuming from %s\n", printable_name(newest.text).text, fault, previous_name);
    TRY(state_read(previous.text, scene_text, save_or_load_all, context));
    /* Rename the damaged file: the next checkpoint would otherwise replace the whole one by it. */
    if (path_exists(newest.text) && rename(newest.text, path_join(o->folder, damaged_name).text) != 0)
        return file_report_write_failure(newest.text, errno);
    return OK;
}

bool checkpoint_exists(const char *folder)
{
    return path_exists(path_join(folder, newest_name).text) || path_exists(path_join(folder, previous_name).text);
}
