/* Manages the results folder of a run: checks and locks it, removes the files of an older run, and restores the state
 * of the output at a restart. */
#include "output/output.h"

#include <dirent.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/memory.h"
#include "output/checksum.h"
#include "output/folder_guard.h"
#include "output/output_files.h"
#include "output/page_file.h"
#include "output/picture_file.h"
#include "output/pictures.h"
#include "output/scene_text.h"
#include "output/summary_read.h"

void output_install_signal_handling_for_file_writes(void)
{
    signal(SIGXFSZ, SIG_IGN);
    signal(SIGPIPE, SIG_IGN);
    invariant_set_cleanup_callback(files_remove_unfinished_temporaries);
}

/* ---- folders ----------------------------------------------------------------------------------------------------- */

/* Files in a results folder in the order of their removal: checkpoints first, because no checkpoint may exist without
 * the frames to which it refers. begin: first characters by which a table of Cleave is recognised; NULL: not
 * checked. */
static const struct {
    const char *name, *begin;
} made[] = {
    {"checkpoint.h5", NULL},         {"checkpoint.previous.h5", NULL},
    {"checkpoint.damaged.h5", NULL}, {"summary.json", NULL},
    {"history.csv", "time [s],"},    {"fragments.csv", "body,particles,"},
    {"frames.hdf.series", NULL},     {"frames.xdmf", NULL},
    {"frames.vtkhdf", NULL},         {"rigid.vtp.series", NULL},
};

/* Returns true if `name` consists of at least six digits, then the text `type` and the text `end`. */
static bool is_numbered(const char *name, const char *type, const char *end)
{
    const size_t digits = strspn(name, "0123456789"), length = strlen(type);
    return digits >= 6 && strncmp(name + digits, type, length) == 0 && strcmp(name + digits + length, end) == 0;
}

/* Returns true if `name` is that of a frame, 123456.hdf, or of a particles file, particles_123456.h5, followed by `end`
 * ("" or the ending of temporary files). */
static bool is_frame(const char *name, const char *end)
{
    static const char particles[] = "particles_";
    if (strncmp(name, particles, sizeof particles - 1) == 0)
        return is_numbered(name + sizeof particles - 1, ".h5", end);
    return is_numbered(name, ".hdf", end);
}

/* Returns true if `name` is that of a file of rigid bodies, rigid_123456.vtp, followed by `end` ("" or the ending of
 * temporary files). */
static bool is_rigid_file(const char *name, const char *end)
{
    static const char rigid[] = "rigid_";
    return strncmp(name, rigid, sizeof rigid - 1) == 0 && is_numbered(name + sizeof rigid - 1, ".vtp", end);
}

static status file_remove(const char *path) { return (void)unlink(path), OK; }

/* Removes the picture at `path` if Cleave drew it, by its mark; other pictures remain. Returns FAILED if it cannot be
 * removed. */
static status picture_remove(const char *path) { return picture_file_is_from_cleave(path) ? file_remove(path) : OK; }

static bool has_frames(const char *folder)
{
    bool any = false;
    DIR *d = opendir(folder);
    if (!d) return false;
    for (struct dirent *e; !any && (e = readdir(d));) any = is_frame(e->d_name, "");
    closedir(d);
    return any;
}

/* ---- check of the folder ----------------------------------------------------------------------------------------- */

/* Returns true if the file `path` is the scene.yaml of a run: its text is scene_text, or Cleave wrote it and it is
 * beside a folder `frames`, which a run creates first. */
static bool is_scene_of_run(const char *path, const char *scene_text)
{
    struct path frames;
    char *text;
    size_t length;
    snprintf(frames.text, sizeof frames.text, "%.*s/frames", (int)(strrchr(path, '/') - path), path);
    if (scene_file_describes_same_scene(path, scene_text)) return true;
    if (!path_is_folder(frames.text) || file_read_whole(path, &text, &length) != OK) return false;
    const bool is = scene_text_is_from_cleave(text);
    memory_free(text);
    return is;
}

/* Returns true if `name` in the folder is a folder `frames` that is empty but for hidden and temporary files. A run
 * that was killed before it wrote scene.yaml leaves only this folder. */
static bool is_frames_folder(const char *folder, const char *name)
{
    const struct path frames = path_join(folder, name);
    bool bare = strcmp(name, "frames") == 0 && path_is_folder(frames.text);
    DIR *d = bare ? opendir(frames.text) : NULL;
    if (!d) return bare;
    for (struct dirent *e; bare && (e = readdir(d));) bare = file_name_is_hidden_or_temporary(e->d_name);
    closedir(d);
    return bare;
}

static const struct folder_kind run_kind = {
    .what = "run", .sign = "scene.yaml", .is_sign = is_scene_of_run, .is_early = is_frames_folder, .inner = {"frames"}};

/* Checks the folder in which a run of the scene with the text scene_text would write. mode: whether an older run may be
 * overwritten. Returns REFUSED, with a message, if the folder cannot be written or contains other files. Also returns
 * REFUSED, and sets *other, if it contains the run of another scene, unless mode is OUTPUT_OVERWRITE. */
static status folder_check(const char *folder, const char *scene_text, enum output_mode mode, bool *other)
{
    char *text = NULL;
    size_t length = 0;
    bool there;
    TRY(folder_check_writable(&run_kind, folder, scene_text, &there));
    if (!there) return OK;
    TRY(file_read_whole(path_join(folder, "scene.yaml").text, &text, &length));
    const bool same = length == strlen(text) && scene_texts_describe_same_scene(text, scene_text);
    *other = !same && mode != OUTPUT_OVERWRITE;
    const status checked = *other ? scene_texts_report_first_different_line(folder, text, scene_text) : OK;
    memory_free(text);
    return checked;
}

/* Returns true if the folder contains any file of a run other than scene.yaml. */
static bool has_run(const char *folder)
{
    bool any = has_frames(path_join(folder, "frames").text);
    for (size_t k = 0; k < COUNT_OF(made); k++) any |= path_exists(path_join(folder, made[k].name).text);
    return any;
}

/* Returns true if the run in the folder has written output after its first step: a second frame, or a line of
 * history.csv. (The first checkpoint is written before the first step.) */
static bool has_advanced(const char *folder)
{
    char *text = NULL;
    size_t length = 0, lines = 0;
    const struct path history = path_join(folder, "history.csv"), frames = path_join(folder, "frames");
    if (path_exists(path_join(frames.text, "000001.hdf").text)) return true;
    if (!path_is_file(history.text) || file_read_whole(history.text, &text, &length) != OK) return false;
    for (size_t k = 0; k < length; k++) lines += text[k] == '\n';
    memory_free(text);
    return lines > 1;
}

/* Checks that `mode` (first run, resume or overwrite) is possible with an older run in the folder. Returns REFUSED,
 * with a message, if there is an older run and mode is OUTPUT_FIRST, or if mode is OUTPUT_RESUME and the older run has
 * advanced but has no checkpoints. Warns if there is nothing to resume. */
static status mode_check(const char *folder, enum output_mode mode)
{
    char ended[NAME_MAX_LENGTH] = "interrupted";
    const bool there = has_run(folder), resumes = checkpoint_exists(folder) || !has_advanced(folder);
    if (path_is_file(path_join(folder, "summary.json").text))
        (void)summary_read_string(folder, "status", ended, sizeof ended);
    if (mode == OUTPUT_FIRST && there)
        return status_set(
            REFUSED, "%s contains %s run of this scene; %sreplace it with --overwrite, or choose another -o", folder,
            !strcmp(ended, "done")     ? "a finished"
            : !strcmp(ended, "failed") ? "a failed"
                                       : "an interrupted",
            resumes ? "continue with --resume, " : "its checkpoints are gone; ");
    if (mode != OUTPUT_RESUME || checkpoint_exists(folder)) return OK;
    if (!resumes)
        return status_set(
            REFUSED,
            "cannot resume: the run in %s has no checkpoint left; start again with --overwrite, or choose another -o",
            folder);
    fprintf(stderr, "warning: %s has no checkpoint, so the run starts at t = 0\n", printable_name(folder).text);
    return OK;
}

/* Calls each(path) for the file `name` in the folder, if there is one, and returns its status; else OK. */
static status file_each(const char *folder, const char *name, file_visit_fn *each)
{
    const struct path path = path_join(folder, name);
    return path_exists(path.text) ? each(path.text) : OK;
}

/* Calls each(path) for all output frames and index files of one region for which frames are written separately. inner:
 * name frames_NAME of the folder of these frames, which is in `folder`; end: additional ending of the file names, ""
 * or that of temporary files. If `each` removes files, the folder is removed too, unless other files are in it.
 * Returns the first status other than OK. */
static status region_each(const char *folder, const char *inner, const char *end, file_visit_fn *each)
{
    static const char *const index[] = {".hdf.series", ".xdmf", ".vtkhdf"};
    char name[PATH_NAME_ROOM];
    const struct path path = path_join(folder, inner);
    if (path_is_link(path.text) || !path_is_folder(path.text)) return OK;
    TRY(folder_visit_selected_files(path.text, is_frame, end, each));
    for (size_t k = 0; k < COUNT_OF(index); k++) {
        snprintf(name, sizeof name, "%.250s%s%s", inner + 7, index[k], end);
        TRY(file_each(folder, name, each));
    }
    if (!end[0] && each == file_remove) rmdir(path.text); /* fails, as intended, if other files are left */
    return OK;
}

/* Returns true if `inner` is the name frames_NAME of the folder of a region of the scene with the text scene_text. */
static bool is_frames_of_region(const char *inner, const char *scene_text)
{
    char line[PATH_NAME_ROOM + 16];
    if (strncmp(inner, "frames_", 7) != 0) return false;
    snprintf(line, sizeof line, "- name: \"%.250s\"", inner + 7);
    return strstr(scene_text, line) != NULL;
}

/* Calls each(path) for the output frames and index files of every region that scene.yaml in the folder defines. Other
 * folders named frames_* are not touched. end: additional ending of the file names, "" or that of temporary files.
 * Returns the first status other than OK. */
static status regions_each(const char *folder, const char *end, file_visit_fn *each)
{
    char *text;
    size_t length;
    status s = OK;
    const struct path scene = path_join(folder, "scene.yaml");
    if (!path_is_file(scene.text) || file_read_whole(scene.text, &text, &length) != OK) return OK;
    DIR *d = opendir(folder);
    for (struct dirent *e; d && s == OK && (e = readdir(d));)
        if (is_frames_of_region(e->d_name, text)) s = region_each(folder, e->d_name, end, each);
    if (d) closedir(d);
    memory_free(text);
    return s;
}

/* Calls each(path) for every file in the folder that a new run replaces. Returns the first status other than OK, after
 * which no further files are visited. */
static status run_each(const char *folder, file_visit_fn *each)
{
    for (size_t k = 0; k < COUNT_OF(made); k++) TRY(file_each(folder, made[k].name, each));
    TRY(folder_visit_selected_files(path_join(folder, "frames").text, is_frame, "", each));
    TRY(folder_visit_selected_files(path_join(folder, "frames").text, is_rigid_file, "", each));
    TRY(regions_each(folder, "", each));
    TRY(folder_visit_selected_files(pictures_folder(folder).text, file_name_is_of_picture, "",
                                    each == file_remove ? picture_remove : each));
    return folder_visit_selected_files(pictures_folder(folder).text, file_name_is_of_picture, ASIDE_ENDING, each);
}

/* Removes the temporary files of a run from its folder. Temporary files of pictures remain: they may belong to a
 * `cleave plot` that is drawing a run to be resumed. */
static void temporary_remove(const char *folder)
{
    for (size_t k = 0; k < COUNT_OF(made); k++)
        unlink(path_of_temporary_file(path_join(folder, made[k].name).text).text);
    unlink(path_of_temporary_file(path_join(folder, "scene.yaml").text).text);
    folder_visit_selected_files(path_join(folder, "frames").text, is_frame, ASIDE_ENDING, file_remove);
    folder_visit_selected_files(path_join(folder, "frames").text, is_rigid_file, ASIDE_ENDING, file_remove);
    regions_each(folder, ASIDE_ENDING, file_remove);
}

/* Returns true if an index of output frames lists the frame `path`: FOLDER/frames.xdmf for FOLDER/frames/FILE, or
 * FOLDER/NAME.xdmf of a region for FOLDER/frames_NAME/FILE. */
static bool index_lists(const char *path)
{
    const char *const file = strrchr(path, '/'), *inner = file;
    char entry[2 * PATH_NAME_ROOM], name[PATH_NAME_ROOM], *text;
    size_t length;
    while (inner > path && inner[-1] != '/') inner--;
    const int series = (int)(file - inner) - 7; /* length of NAME */
    snprintf(entry, sizeof entry, "%.500s:", inner);
    snprintf(name, sizeof name, "%.*s.xdmf", series > 0 ? series : 6, series > 0 ? inner + 7 : inner);
    char folder[PATH_ROOM];
    snprintf(folder, sizeof folder, "%.*s", inner > path ? (int)(inner - path) - 1 : 1, inner > path ? path : ".");
    const struct path index = path_join(folder, name);
    if (!path_is_file(index.text) || file_read_whole(index.text, &text, &length) != OK) return false;
    const bool listed = strstr(text, entry) != NULL;
    memory_free(text);
    return listed;
}

/* Checks the file `path`, which a run would remove. Returns REFUSED, with a message, if it has the name of an output
 * frame or particles file, but is not from Cleave: it has no footer of Cleave's files, and the index of the older run
 * does not list it. */
static status frame_guard(const char *path)
{
    if (!is_frame(strrchr(path, '/') + 1, "") || file_has_checksum_footer(path) || index_lists(path)) return OK;
    return status_set(REFUSED, "%s was not written by cleave, or is cut off; move or remove it", path);
}

/* Checks the file `path`, a VTK file of the surfaces of rigid bodies that a run would remove. Returns REFUSED, with a
 * message, if it does not begin as Cleave's files of this kind do. */
static status rigid_guard(const char *path)
{
    static const char *const begin[] = {RIGID_FILE_BEGIN};
    return file_check_has_known_beginning(path, begin, 1);
}

/* Checks the tables, frames and particles files in a folder that a run would write or remove. Returns REFUSED, with a
 * message, if one of them is an existing file that Cleave did not write. */
static status files_guard(const char *folder)
{
    for (size_t k = 0; k < COUNT_OF(made); k++)
        if (made[k].begin) TRY(file_check_has_known_beginning(path_join(folder, made[k].name).text, &made[k].begin, 1));
    TRY(folder_visit_selected_files(path_join(folder, "frames").text, is_frame, "", frame_guard));
    TRY(folder_visit_selected_files(path_join(folder, "frames").text, is_rigid_file, "", rigid_guard));
    return regions_each(folder, "", frame_guard);
}

static status folder_prepare(const char *folder, const char *scene_text, enum output_mode mode, bool *other)
{
    const struct path frames = path_join(folder, "frames"), scene = path_join(folder, "scene.yaml");
    TRY(folder_check(folder, scene_text, mode, other));
    TRY(mode_check(folder, mode));
    TRY(run_each(folder, file_check_replaceable));
    if (mode != OUTPUT_RESUME) TRY(files_guard(folder));
    if (!file_contents_equal_bytes(scene.text, scene_text, strlen(scene_text))) TRY(file_check_replaceable(scene.text));
    TRY(folder_create_with_parents(frames.text));
    temporary_remove(folder);
    if (mode != OUTPUT_RESUME) report_page_remove_from_folder(folder), run_each(folder, file_remove);
    return file_write_whole(scene.text, scene_text, strlen(scene_text));
}

status output_open(struct output *o, const char *folder, const char *scene_text, enum output_mode mode, bool compress)
{
    INVARIANT(folder && scene_text);
    struct path clean = {{0}};
    size_t length = strlen(folder);
    *o = (struct output){.compress = compress, .lock.fd = -1, .series[0].particles.number = -1};
    if (length == 0) return status_set(REFUSED, "-o is empty: give the name of a folder");
    if (length + PATH_NAME_ROOM >= PATH_ROOM)
        return status_set(REFUSED, "-o: the folder's name is too long; choose a shorter one");
    while (length > 1 && folder[length - 1] == '/') length--;
    memcpy(clean.text, folder, length);
    TRY(folder_create_with_parents(clean.text));
    TRY(folder_lock(&o->lock, clean.text));
    const status s = folder_prepare(clean.text, scene_text, mode, &o->has_other_scene);
    if (s != OK) {
        folder_unlock(&o->lock, clean.text);
        return s;
    }
    o->folder = NEW("output.folder", (int64_t)length + 1, char);
    memcpy(o->folder, clean.text, length);
    return OK;
}

/* Returns the path of the folder frames_NAME, in the folder of a run, in which the output frames of the region NAME =
 * name are. */
static struct path series_folder(const char *folder, const char *name)
{
    char inner[PATH_NAME_ROOM];
    snprintf(inner, sizeof inner, "frames_%s", name);
    return path_join(folder, inner);
}

status output_check_series_folder_can_be_created(const char *folder, const char *series_name)
{
    const struct path path = series_folder(folder, series_name);
    if (path_is_link(path.text))
        return status_set(REFUSED, "%s is a symbolic link, so frames would be written to another folder; remove it",
                          path.text);
    if (path_exists(path.text) && !path_is_folder(path.text))
        return status_set(REFUSED, "%s is a file, not a folder; choose another -o", path.text);
    return OK;
}

status output_add_frame_series(struct output *o, const char *series_name, const struct region *region)
{
    INVARIANT(o->n_series < SERIES_MOST);
    TRY(output_check_series_folder_can_be_created(o->folder, series_name));
    TRY(folder_create_with_parents(series_folder(o->folder, series_name).text));
    struct frame_series *s = &o->series[++o->n_series];
    *s = (struct frame_series){.region = region, .particles.number = -1};
    snprintf(s->name, sizeof s->name, "%s", series_name);
    return OK;
}

void output_close(struct output *o)
{
    (void)output_wait_until_frame_is_written(
        o); /* its status was returned by an earlier output_wait_until_frame_is_written */
    if (o->history) fclose(o->history);
    if (o->folder) folder_unlock(&o->lock, o->folder);
    memory_free(o->folder);
    output_discard_cached_frame_particle_order(o);
    for (int k = 0; k <= o->n_series; k++) memory_free(o->series[k].entry);
    memory_free(o->frame_copy);
    *o = (struct output){0};
}

status output_write_text(const struct output *o, const char *file_name, const char *text, size_t length)
{
    TRY(folder_check_lock_still_holds(&o->lock, o->folder));
    return file_write_whole(path_join(o->folder, file_name).text, text, length);
}

/* ---- restart ----------------------------------------------------------------------------------------------------- */

/* Saves the list of output frames of series s (number, times, sizes) and the number and hash of its last particles file
 * to the archive a if a->saving is true, else restores them. A series is the frames of the whole run or of one region.
 * Returns FAILED, with a message, if the restored lists do not match. */
static status series_archive(struct frame_series *s, struct archive *a)
{
    char frames_name[100], entry_name[100], number_name[100], content_name[100];
    const char *between = s->name[0] ? "_" : "";
    int32_t frames = s->frames;
    snprintf(frames_name, sizeof frames_name, "output/frames%s%s", between, s->name);
    snprintf(entry_name, sizeof entry_name, "output/frame_list%s%s", between, s->name);
    snprintf(number_name, sizeof number_name, "output/particles_number%s%s", between, s->name);
    snprintf(content_name, sizeof content_name, "output/particles_content%s%s", between, s->name);
    ARCHIVE_VALUE(a, frames_name, frames);
    if (!a->saving) {
        if (frames < 0 || a->stored_size(a, entry_name) != (int64_t)frames * (int64_t)sizeof *s->entry)
            return status_set(FAILED,
                              "cannot resume: the checkpoint counts %d frames, but lists another number of them; it is "
                              "damaged, start again with --overwrite",
                              frames);
        memory_free(s->entry);
        s->entry = NEW("output.frames", frames, struct frame_entry);
        s->frames = frames;
    }
    TRY(a->exchange(a, entry_name, s->entry, (size_t)frames * sizeof *s->entry));
    ARCHIVE_VALUE(a, number_name, s->particles.number);
    ARCHIVE_VALUE(a, content_name, s->particles.content);
    return OK;
}

status output_save_or_load(struct output *o, struct archive *a)
{
    for (int k = 0; k <= o->n_series; k++) TRY(series_archive(&o->series[k], a));
    ARCHIVE_VALUE(a, "output/history_bytes", o->history_bytes);
    ARCHIVE_VALUE(a, "output/history_hash", o->history_hash);
    return OK;
}
