/* Manages the runs of a study: their folders and overrides, and which of them are done or equal. */
#include "study/study.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/memory_stream.h"
#include "output/folder_guard.h"
#include "output/output.h"
#include "output/output_files.h"
#include "output/scene_text.h"
#include "output/summary_read.h"
#include "scene/scene_read.h"
#include "study_internal.h"

/* ---- the study --------------------------------------------------------------------------------------------------- */

/* Writes the path of the default folder of a study, results/NAME_KIND with the name of the scene and KIND = study_kind,
 * into folder[capacity]. A path too long is truncated. */
void study_compose_default_folder(char *folder, size_t capacity, const struct scene *scene, const char *study_kind)
{
    snprintf(folder, capacity, "results/%s_%s", scene->name, study_kind);
}

/* Reads the scene file `path` and writes the path of the default folder of a study of this scene into to[capacity]:
 * results/NAME_KIND with the name of the scene and KIND = kind. Returns REFUSED or FAILED, with a message, if the scene
 * cannot be read. */
static status place_read(char *to, size_t capacity, const char *path, const char *kind)
{
    struct scene scene;
    TRY(scene_read(&scene, path, NULL, 0));
    study_compose_default_folder(to, capacity, &scene, kind);
    scene_free(&scene);
    return OK;
}

status study_initialise(struct study *s, const char *scene, const char *folder, const char *study_kind)
{
    *s = (struct study){.scene = scene, .lock.fd = -1};
    if (folder && !*folder) return status_set(REFUSED, "-o is empty: give the name of a folder");
    if (folder && strlen(folder) + CASE_NAME_ROOM + PATH_NAME_ROOM >= PATH_ROOM)
        return status_set(REFUSED, "-o: the folder's name is too long; choose a shorter one");
    if (folder)
        snprintf(s->folder, sizeof s->folder, "%s", folder);
    else
        TRY(place_read(s->folder, sizeof s->folder, scene, study_kind));
    for (size_t k = strlen(s->folder) - 1; k > 0 && s->folder[k] == '/'; k--) s->folder[k] = '\0';
    return OK;
}

/* ---- scene of the study ------------------------------------------------------------------------------------------ */

/* Composes the text that identifies a study if its scene cannot be read because it is incomplete without the varied
 * keys (keys of the input file that a study varies). The text is the contents of the scene file `path`, followed by
 * override[overrides] as comments. The caller releases *text with memory_free. Returns FAILED, with a message, if the
 * file cannot be read. */
static status scene_unread(char **text, const char *path, const struct scene_override *override, int overrides)
{
    size_t length, room;
    char *file;
    TRY(file_read_whole(path, &file, &length));
    room = length + 1;
    for (int k = 0; k < overrides; k++) room += strlen(override[k].key) + strlen(override[k].value) + 8;
    *text = NEW("study.text", (int64_t)room, char);
    char *at = *text + sprintf(*text, "%s", file);
    for (int k = 0; k < overrides; k++) at += sprintf(at, "# -s %s=%s\n", override[k].key, override[k].value);
    memory_free(file);
    return OK;
}

status study_initialise_with_varied_keys(struct study *s, const char *scene, const char *folder, const char *study_kind,
                                         const struct varied_key *key, int keys)
{
    struct scene_override *first = NEW("study.first", keys, struct scene_override);
    struct scene_override *fixed = NEW("study.fixed", keys, struct scene_override);
    int n = 0;
    for (int k = 0; k < keys; k++) {
        first[k] = (struct scene_override){key[k].key, key[k].value[0]};
        if (key[k].values == 1) fixed[n++] = first[k];
    }
    struct scene is;
    char *text = NULL, place[sizeof is.name + CASE_NAME_ROOM];
    bool read = scene_read(&is, scene, fixed, n) == OK;
    status done = OK;
    if (read) {
        text = NEW("study.text", (int64_t)strlen(is.text) + 1, char);
        strcpy(text, is.text);
    } else if ((done = scene_read(&is, scene, first, keys)) == OK) {
        read = true;
        done = scene_unread(&text, scene, fixed, n);
    }
    if (read) {
        study_compose_default_folder(place, sizeof place, &is, study_kind);
        scene_free(&is);
    }
    if (done == OK) done = study_initialise(s, scene, folder ? folder : place, study_kind);
    s->text = text;
    memory_free(fixed);
    memory_free(first);
    return done;
}

/* First line of the file STUDY_SCENE, by which Cleave recognises it. */
static const char study_mark[] = "# study by cleave: the scene without what varies\n";

/* Reads the text of the input file (scene) of a study from the file `path`, without the first lines, which mark the
 * file as that of a study and store options. Files of an earlier format begin with the scene itself, in the form in
 * which Cleave writes scenes. Returns NULL if there is no file or it begins with neither. The caller releases the text
 * with memory_free. */
static char *study_scene_read(const char *path)
{
    char *text;
    size_t length;
    if (!path_is_file(path) || file_read_whole(path, &text, &length) != OK) return NULL;
    if (length == strlen(text) && strncmp(text, study_mark, sizeof study_mark - 1) == 0) {
        size_t begin = sizeof study_mark - 1;
        const char *end = strchr(text + begin, '\n');
        if (end && strncmp(text + begin, STUDY_OPTIONS_MARK, strlen(STUDY_OPTIONS_MARK)) == 0)
            begin = (size_t)(end + 1 - text);
        memmove(text, text + begin, length - begin + 1);
        return text;
    }
    if (scene_text_is_from_cleave(text)) return text;
    memory_free(text);
    return NULL;
}

static bool is_scene_of_study(const char *path, const char *scene_text)
{
    (void)scene_text;
    char *text = study_scene_read(path);
    memory_free(text);
    return text != NULL;
}

bool study_folder_contains_study_of_scene(const char *folder, const char *scene_text)
{
    char *own = study_scene_read(path_join(folder, STUDY_SCENE).text);
    const bool same = own && scene_texts_describe_same_scene(own, scene_text);
    memory_free(own);
    return same;
}

status study_write_scene_and_options(const char *folder, const char *scene_text, const char *options)
{
    char *all = NULL;
    size_t length = 0;
    const struct path path = path_join(folder, STUDY_SCENE);
    FILE *to = memory_stream_open(&all, &length);
    if (!to) return status_set(FAILED, "%s: out of memory", path.text);
    fputs(study_mark, to);
    if (options) fprintf(to, "%s%s\n", STUDY_OPTIONS_MARK, options);
    fputs(scene_text, to);
    status put = fclose(to) == 0 ? OK : status_set(FAILED, "%s: out of memory", path.text);
    if (put == OK) put = file_write_whole(path.text, all, length);
    free(all);
    return put;
}

/* Returns true if the subfolder `name` of `folder`, the folder of a study, contains a run or another study. Runs may
 * have been started individually, with the commands of `--list`. */
static bool is_run_or_study(const char *folder, const char *name)
{
    const struct path inner = path_join(folder, name);
    return path_is_file(path_join(inner.text, "scene.yaml").text) ||
           is_scene_of_study(path_join(inner.text, STUDY_SCENE).text, NULL);
}

static const struct folder_kind study_kind = {.what = "study",
                                              .sign = STUDY_SCENE,
                                              .is_sign = is_scene_of_study,
                                              .is_early = is_run_or_study,
                                              .inner = {"logs", "pictures"}};

status study_folder_check_is_usable(const char *folder)
{
    bool there;
    return folder_check_writable(&study_kind, folder, NULL, &there);
}

status study_folder_mark_as_study(const char *folder)
{
    bool there;
    TRY(folder_check_writable(&study_kind, folder, NULL, &there));
    return there ? OK : study_write_scene_and_options(folder, "", NULL);
}

status study_folder_check_is_usable_for_scene(const char *folder, const char *scene_text)
{
    char *own = study_scene_read(path_join(folder, STUDY_SCENE).text);
    const bool fits = !own || !*own || scene_texts_describe_same_scene(own, scene_text);
    memory_free(own);
    if (fits) return study_folder_check_is_usable(folder);
    return status_set(
        REFUSED, "%s contains a study of another scene (%s there); choose another -o or replace it with --overwrite",
        printable_name(folder).text, STUDY_SCENE);
}

/* ---- cases of a study -------------------------------------------------------------------------------------------- */

/* Releases the overrides of the run *c of a study, with their texts. */
static void case_free(struct study_case *c)
{
    for (int k = 0; k < c->overrides; k++) memory_free((char *)c->override[k].key);
    memory_free(c->override);
}

void study_free(struct study *s)
{
    folder_unlock(&s->lock, s->folder);
    for (int k = 0; k < s->n; k++) case_free(&s->at[k]);
    memory_free(s->at);
    memory_free(s->slot);
    memory_free(s->text);
    *s = (struct study){.lock.fd = -1};
}

const struct study_case *study_case_whose_results_are_used(const struct study *s, const struct study_case *c)
{
    return c->state == CASE_SAME ? &s->at[c->same] : c;
}

struct path study_case_folder(const struct study *s, const struct study_case *c)
{
    return path_join(s->folder, study_case_whose_results_are_used(s, c)->name);
}

/* ---- cases ------------------------------------------------------------------------------------------------------- */

/* Returns a copy of the override o. Key and value share one allocation, which is released through the key. */
static struct scene_override override_copy(struct scene_override o)
{
    const size_t key = strlen(o.key) + 1, value = strlen(o.value) + 1;
    char *both = NEW("study.override", (int64_t)(key + value), char);
    memcpy(both, o.key, key);
    memcpy(both + key, o.value, value);
    return (struct scene_override){both, both + key};
}

struct study_case *study_add_case(struct study *s, const char *name, const struct scene_override *override,
                                  int overrides)
{
    GROW("study.cases", s->at, s->n + 1);
    study_enlarge_run_name_table_if_full(s);
    struct study_case *c = &s->at[s->n];
    study_choose_case_name(s, c->name, name, override, overrides);
    c->override = NEW("study.overrides", overrides, struct scene_override);
    for (int k = 0; k < overrides; k++) c->override[k] = override_copy(override[k]);
    c->overrides = overrides;
    study_register_case_name(s, s->n++);
    return c;
}

status study_add_cases_of_all_value_combinations(struct study *s, const struct varied_key *key, int keys)
{
    double all = 1;
    for (int k = 0; k < keys; k++) all *= key[k].values;
    if (all > CASES_MOST)
        return status_set(REFUSED,
                          "the study would have %.0f runs, more than the limit of %d; give fewer values of a key", all,
                          CASES_MOST);
    int *at = NEW("study.at", keys, int), *order = NEW("study.order", keys, int);
    const int varied = study_list_multivalued_keys_in_name_order(order, key, keys);
    struct scene_override *override = NEW("study.override", keys, struct scene_override);
    for (int left = (int)all; left > 0; left--) {
        char name[CASE_NAME_ROOM];
        for (int k = 0; k < keys; k++) override[k] = (struct scene_override){key[k].key, key[k].value[at[k]]};
        study_compose_case_name(name, key, keys, order, varied, at);
        study_add_case(s, name, override, keys);
        for (int k = keys - 1; k >= 0 && ++at[k] == key[k].values; k--) at[k] = 0;
    }
    memory_free(override);
    memory_free(order);
    memory_free(at);
    return OK;
}

/* ---- finished runs ----------------------------------------------------------------------------------------------- */

/* Stores how the run in `folder` ended according to its summary, such as "done" or "failed", in ended[capacity]. Stores
 * "" if the folder contains no finished run, or a run of a scene other than that with the text scene_text. */
static void ended_as(char *ended, size_t capacity, const char *folder, const char *scene_text)
{
    if (!path_is_file(path_join(folder, "summary.json").text) ||
        summary_read_string(folder, "status", ended, capacity) != OK ||
        !scene_file_describes_same_scene(path_join(folder, "scene.yaml").text, scene_text))
        ended[0] = '\0';
}

/* Hash table of the scenes of runs with `room` slots. number[room]: index of a run + 1, 0 for an empty slot;
 * hash[room]: hash of its scene. */
struct scenes_seen {
    int *number, room;
    uint64_t *hash;
};

/* Sets *same to true if the run `other` of the study s has the scene `text`, else to false. The texts of the scenes are
 * compared, since different scenes can have equal hashes. Returns REFUSED or FAILED, with a message, if the scene of
 * the run cannot be read. */
static status case_same(bool *same, const struct study *s, const struct study_case *other, const char *text)
{
    struct scene scene;
    TRY(scene_read(&scene, s->scene, other->override, other->overrides));
    *same = scene_texts_describe_same_scene(scene.text, text);
    scene_free(&scene);
    return OK;
}

/* Looks up `text`, the scene of run number `number` of the study, in the hash table `seen` of the scenes of earlier
 * runs. If an earlier run has the same scene, sets the state of the run to CASE_SAME; otherwise enters the scene in
 * the table. Returns REFUSED or FAILED, with a message, if the scene of an earlier run cannot be read. s: the study. */
static status scene_seen(struct scenes_seen *seen, struct study *s, int number, const char *text)
{
    struct study_case *c = &s->at[number];
    const uint64_t hash = study_hash_add_text(STUDY_HASH_START, text);
    int at = (int)(hash % (uint64_t)seen->room);
    for (; seen->number[at] > 0; at = (at + 1) % seen->room) {
        const struct study_case *other = &s->at[seen->number[at] - 1];
        bool same = false;
        if (seen->hash[at] == hash) TRY(case_same(&same, s, other, text));
        if (!same) continue;
        c->state = CASE_SAME;
        c->same = seen->number[at] - 1;
        return OK;
    }
    seen->number[at] = number + 1;
    seen->hash[at] = hash;
    return OK;
}

/* Determines the state of run number `number` of the study before any run starts: CASE_SAME if its scene equals that
 * of an earlier run, CASE_DONE_BEFORE if its folder contains its results already. collect: true to mark runs that
 * failed before as failed, false to run them again; seen: scenes of the runs checked before. Returns REFUSED, with a
 * message, if the input file (scene) is invalid. s: the study. */
static status case_check(struct study *s, int number, bool collect, struct scenes_seen *seen)
{
    struct study_case *c = &s->at[number];
    struct scene scene;
    char ended[NAME_MAX_LENGTH];
    TRY(scene_read(&scene, s->scene, c->override, c->overrides));
    const status looked = scene_seen(seen, s, number, scene.text);
    if (looked == OK && c->state != CASE_SAME && c->state != CASE_DONE) {
        ended_as(ended, sizeof ended, study_case_folder(s, c).text, scene.text);
        if (strcmp(ended, "done") == 0)
            c->state = CASE_DONE_BEFORE;
        else if (collect && strcmp(ended, "failed") == 0)
            c->state = CASE_FAILED;
    }
    scene_free(&scene);
    return looked;
}

status study_find_completed_failed_and_equal_cases(struct study *s, bool keep_failed)
{
    const int room = 2 * s->n + 1;
    struct scenes_seen seen = {NEW("study.seen", room, int), room, NEW("study.hashes", room, uint64_t)};
    status checked = OK;
    for (int k = 0; k < s->n && checked == OK; k++) checked = case_check(s, k, keep_failed, &seen);
    memory_free(seen.hash);
    memory_free(seen.number);
    return checked;
}

void study_print_count_of_duplicate_scenes(const struct study *s, FILE *out)
{
    int same = 0;
    const struct study_case *one = NULL;
    for (int k = 0; k < s->n; k++)
        if (s->at[k].state == CASE_SAME) one = &s->at[k], same++;
    if (same > 0)
        fprintf(out,
                "warning: %d of %d combinations are the same scene as another one (for instance %s and %s), so each "
                "scene is run once\n",
                same, s->n, one->name, s->at[one->same].name);
}

const char *study_case_value_of_key(const struct study_case *c, const char *key)
{
    for (int k = 0; k < c->overrides; k++)
        if (strcmp(c->override[k].key, key) == 0) return c->override[k].value;
    return "";
}

status study_write_memory_stream_to_file(const struct study *s, const char *name, FILE *stream, char **text,
                                         const size_t *length)
{
    const bool whole = stream && fclose(stream) == 0;
    const status written = whole ? file_write_whole(path_join(s->folder, name).text, *text, *length)
                                 : status_set(FAILED, "cannot write %s: out of memory", name);
    free(*text);
    return written;
}
