/* floor 4: the folder of a run: what may be put where, and what is removed before. */
#include "output.h"

#include <dirent.h>
#include <errno.h>
#include <hdf5.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "memory.h"
#include "output_files.h"

void output_start(void)
{
    /* HDF5 1.10 flushes its open files again at exit, and crashes on those that could not be written. */
    H5dont_atexit();
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    signal(SIGXFSZ, SIG_IGN);
    signal(SIGPIPE, SIG_IGN);
}

/* ---- folders --------------------------------------------------------------------------------------- */

static bool ends_with(const char *name, const char *end)
{
    size_t a = strlen(name), b = strlen(end);
    return a >= b && strcmp(name + a - b, end) == 0;
}

/* Makes one folder unless it is there. */
static status folder_make_one(const char *path)
{
    if (mkdir(path, 0777) == 0 || (errno == EEXIST && path_is_folder(path))) return OK;
    if (errno == EEXIST || errno == ENOTDIR)
        return status_set(REFUSED, "%s: is a file, not a folder; choose another -o", path);
    return status_set(FAILED, "cannot make the folder %s: %s; choose another -o", path, strerror(errno));
}

/* Makes a folder and those above it. */
static status folder_make(const char *path)
{
    struct path part = {{0}};
    for (size_t k = 0; path[k]; k++) {
        if (path[k] == '/' && k > 0 && !path_is_folder(part.text)) TRY(folder_make_one(part.text));
        part.text[k] = path[k];
    }
    return folder_make_one(part.text);
}

/* Removes the regular files of a folder whose names end so. */
static void folder_remove(const char *folder, const char *end)
{
    DIR *d = opendir(folder);
    if (!d) return;
    for (struct dirent *e; (e = readdir(d));) {
        struct path file = path_join(folder, e->d_name);
        if (ends_with(e->d_name, end) && path_is_file(file.text)) unlink(file.text);
    }
    closedir(d);
}

/* Does the folder hold nothing but hidden files, temporary files and folders named `allowed`? Puts the name of
 * the first other thing into `found`. */
static bool folder_is_bare(const char *folder, const char *allowed, char *found, size_t room)
{
    bool bare = true;
    DIR *d = opendir(folder);
    if (!d) return true;
    for (struct dirent *e; bare && (e = readdir(d));) {
        struct path entry = path_join(folder, e->d_name);
        bool is_allowed = allowed && strcmp(e->d_name, allowed) == 0 && path_is_folder(entry.text);
        if (e->d_name[0] == '.' || ends_with(e->d_name, ".tmp") || is_allowed) continue;
        snprintf(found, room, "%s", e->d_name);
        bare = false;
    }
    closedir(d);
    return bare;
}

/* ---- whose folder is it ---------------------------------------------------------------------------- */

/* Refuses a folder that belongs to something else than a run of this scene. */
static status folder_check(const char *folder, const char *scene_text)
{
    struct path scene = path_join(folder, "scene.yaml"), frames = path_join(folder, "frames");
    char found[PATH_NAME_ROOM], *text = NULL;
    size_t length = 0;
    if (path_exists(scene.text)) {
        TRY(file_get(scene.text, &text, &length));
        bool same = length == strlen(scene_text) && memcmp(text, scene_text, length) == 0;
        memory_free(text);
        if (same) return OK;
        return status_set(REFUSED, "%s holds the run of another scene (see its scene.yaml); choose another -o or "
                                   "remove it", folder);
    }
    if (folder_is_bare(folder, "frames", found, sizeof found) &&
        folder_is_bare(frames.text, NULL, found, sizeof found)) return OK;
    return status_set(REFUSED, "%s holds files, for instance %s, but no run; choose another -o", folder, found);
}

/* Removes what an older run left. Checkpoints first: none may outlive the frames it counts on. */
static void run_remove(const char *folder)
{
    static const char *const made[] = {"checkpoint.h5", "checkpoint.previous.h5", "checkpoint.damaged.h5",
                                       "summary.json", "history.csv", "frames.hdf.series", "frames.xdmf"};
    for (size_t k = 0; k < COUNT_OF(made); k++) unlink(path_join(folder, made[k]).text);
    folder_remove(path_join(folder, "frames").text, ".hdf");
}

static status folder_prepare(const char *folder, const char *scene_text, bool resume)
{
    struct path frames = path_join(folder, "frames");
    TRY(folder_make(folder));
    TRY(folder_check(folder, scene_text));
    TRY(folder_make_one(frames.text));
    folder_remove(folder, ".tmp");
    folder_remove(frames.text, ".tmp");
    if (!resume) run_remove(folder);
    return file_put(path_join(folder, "scene.yaml").text, scene_text, strlen(scene_text));
}

status output_open(struct output *o, const char *folder, const char *scene_text, bool resume, bool compress)
{
    assert(folder && scene_text);
    struct path clean = {{0}};
    size_t length = strlen(folder);
    *o = (struct output){.compress = compress};
    if (length == 0) return status_set(REFUSED, "-o: needs the name of a folder");
    if (length + PATH_NAME_ROOM >= PATH_ROOM) return status_set(REFUSED, "-o: the folder's name is too long");
    while (length > 1 && folder[length - 1] == '/') length--;
    memcpy(clean.text, folder, length);
    TRY(folder_prepare(clean.text, scene_text, resume));
    o->folder = NEW("output.folder", (int64_t)length + 1, char);
    memcpy(o->folder, clean.text, length);
    return OK;
}

void output_close(struct output *o)
{
    (void)output_wait(o);                /* who wants to know how it ended has asked before */
    if (o->history) fclose(o->history);
    memory_free(o->folder);
    memory_free(o->frame_time);
    memory_free(o->frame_copy);
    free(o->frame_kept.order);
    free(o->frame_kept.room);
    *o = (struct output){0};
}

status output_text(const struct output *o, const char *name, const char *text, size_t length)
{
    return file_put(path_join(o->folder, name).text, text, length);
}

/* ---- restart --------------------------------------------------------------------------------------- */

status output_archive(struct output *o, struct archive *a)
{
    int32_t frames = o->frames;
    ARCHIVE_VALUE(a, "output/frames", frames);
    if (!a->saving) {
        if (frames < 0 || a->stored_size(a, "output/frame_time") != (int64_t)frames * (int64_t)sizeof(real))
            return status_set(FAILED, "the checkpoint's list of frames does not fit their number");
        memory_free(o->frame_time);
        o->frame_time = NEW("output.frame_time", frames, real);
        o->frames = o->frames_room = frames;
    }
    TRY(a->exchange(a, "output/frame_time", o->frame_time, (size_t)frames * sizeof(real)));
    ARCHIVE_VALUE(a, "output/frame_particles", o->frame_particles);
    ARCHIVE_VALUE(a, "output/history_bytes", o->history_bytes);
    return OK;
}
