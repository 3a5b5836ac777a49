/* The runs of a study: their names, folders and overrides; which of them are done. */
#include "study/study.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "auto/scene_read.h"
#include "base/memory.h"
#include "output/output.h"
#include "output/output_files.h"
#include "output/summary_read.h"

/* ---- the study --------------------------------------------------------------------------------------------------- */

status study_make(struct study *s, const char *scene, const char *folder, const char *kind)
{
    const char *slash = strrchr(scene, '/'), *base = slash ? slash + 1 : scene, *dot = strrchr(base, '.');
    const int length = dot && dot > base ? (int)(dot - base) : (int)strlen(base);
    *s = (struct study){.scene = scene, .lock.fd = -1};
    const int whole = folder ? snprintf(s->folder, sizeof s->folder, "%s", folder)
                             : snprintf(s->folder, sizeof s->folder, "results/%.*s_%s", length, base, kind);
    if (folder && !*folder) return status_set(REFUSED, "-o: needs the name of a folder");
    if (whole + CASE_NAME_ROOM + PATH_NAME_ROOM >= PATH_ROOM)
        return status_set(REFUSED, "-o: the folder's name is too long");
    for (int k = whole - 1; k > 0 && s->folder[k] == '/'; k--) s->folder[k] = '\0';
    return OK;
}

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
    *s = (struct study){.lock.fd = -1};
}

struct path study_folder(const struct study *s, const struct study_case *c) { return path_join(s->folder, c->name); }

/* ---- names ------------------------------------------------------------------------------------------------------- */

/* What every file system and shell takes as it is; blanks and brackets go. */
static void name_append(char *name, const char *text)
{
    size_t n = strlen(name);
    for (; *text && n + 1 < CASE_NAME_ROOM; text++) {
        if (*text == ' ' || strchr("[]{}\"'", *text)) continue;
        name[n++] = isalnum((unsigned char)*text) || strchr(".-+=_,", *text) ? *text : '_';
    }
    name[n] = '\0';
}

static bool name_taken(const struct study *s, const char *name)
{
    for (int k = 0; k < s->n; k++)
        if (strcmp(s->at[k].name, name) == 0) return true;
    return false;
}

/* Names that are too long to be whole, reserved or taken are replaced by numbers. */
static void name_settle(const struct study *s, char *name, size_t wanted)
{
    const bool reserved = !*name || *name == '.' || *name == '-' || !strcmp(name, "pictures") || !strcmp(name, "logs");
    if (wanted + 1 < CASE_NAME_ROOM && !reserved && !name_taken(s, name)) return;
    snprintf(name, CASE_NAME_ROOM, "case%05d", s->n + 1);
}

/* The last part of a key, or all of it where another key that varies ends alike. */
static const char *key_label(const struct varied_key *key, int keys, int k)
{
    const char *dot = strrchr(key[k].key, '.'), *own = dot ? dot + 1 : key[k].key;
    for (int other = 0; other < keys; other++) {
        const char *last = strrchr(key[other].key, '.');
        if (other != k && key[other].values > 1 && !strcmp(last ? last + 1 : key[other].key, own)) return key[k].key;
    }
    return own;
}

/* `spacing=0.5mm,speed=20` of the values number at[k] of the keys that vary. */
static void name_compose(char *name, const struct varied_key *key, int keys, const int *at)
{
    *name = '\0';
    for (int k = 0; k < keys; k++) {
        if (key[k].values < 2) continue;
        if (*name) name_append(name, ",");
        name_append(name, key_label(key, keys, k));
        name_append(name, "=");
        name_append(name, key[k].value[at[k]]);
    }
    if (!*name) name_append(name, "run");
}

/* ---- cases ------------------------------------------------------------------------------------------------------- */

static struct scene_override override_copy(struct scene_override o)
{
    const size_t key = strlen(o.key) + 1, value = strlen(o.value) + 1;
    char *both = NEW("study.override", (int64_t)(key + value), char);
    memcpy(both, o.key, key);
    memcpy(both + key, o.value, value);
    return (struct scene_override){both, both + key};
}

struct study_case *study_add(struct study *s, const char *name, const struct scene_override *override, int overrides)
{
    if (s->n == s->room) {
        const int room = s->room > 0 ? 2 * s->room : 16;
        s->at = memory_resize("study.cases", s->at, s->room, room, sizeof *s->at);
        s->room = room;
    }
    struct study_case *c = &s->at[s->n];
    name_append(c->name, name);
    name_settle(s, c->name, strlen(name));
    c->override = NEW("study.overrides", overrides, struct scene_override);
    for (int k = 0; k < overrides; k++) c->override[k] = override_copy(override[k]);
    c->overrides = overrides;
    s->n++;
    return c;
}

status study_cross(struct study *s, const struct varied_key *key, int keys)
{
    double all = 1;
    for (int k = 0; k < keys; k++) all *= key[k].values;
    if (all > CASES_MOST)
        return status_set(REFUSED, "%.0f runs: more than %d; fewer values of a key are expected", all, CASES_MOST);
    int *at = NEW("study.at", keys, int);
    struct scene_override *override = NEW("study.override", keys, struct scene_override);
    for (int left = (int)all; left > 0; left--) {
        char name[CASE_NAME_ROOM];
        for (int k = 0; k < keys; k++) override[k] = (struct scene_override){key[k].key, key[k].value[at[k]]};
        name_compose(name, key, keys, at);
        study_add(s, name, override, keys);
        for (int k = keys - 1; k >= 0 && ++at[k] == key[k].values; k--) at[k] = 0;
    }
    memory_free(override);
    memory_free(at);
    return OK;
}

/* ---- what is done ------------------------------------------------------------------------------------------------ */

/* How the run in a folder has ended, if it is one of a scene that says the same; else "". */
static void ended_as(char *ended, size_t room, const char *folder, const char *scene_text)
{
    if (!path_is_file(path_join(folder, "summary.json").text) || summary_string(folder, "status", ended, room) != OK ||
        !scene_file_same(path_join(folder, "scene.yaml").text, scene_text))
        ended[0] = '\0';
}

status study_check(struct study *s, bool collect)
{
    for (int k = 0; k < s->n; k++) {
        struct study_case *c = &s->at[k];
        struct scene scene;
        char ended[NAME_MAX_LENGTH];
        TRY(scene_read(&scene, s->scene, c->override, c->overrides));
        ended_as(ended, sizeof ended, study_folder(s, c).text, scene.text);
        if (strcmp(ended, "done") == 0)
            c->state = CASE_DONE_BEFORE;
        else if (collect && strcmp(ended, "failed") == 0)
            c->state = CASE_FAILED;
        scene_free(&scene);
    }
    return OK;
}

const char *study_value(const struct study_case *c, const char *key)
{
    for (int k = 0; k < c->overrides; k++)
        if (strcmp(c->override[k].key, key) == 0) return c->override[k].value;
    return "";
}

status study_put(const struct study *s, const char *name, FILE *to, char **text, const size_t *length)
{
    const bool whole = to && !ferror(to);
    const bool closed = to && fclose(to) == 0;
    const status written = whole && closed ? file_put(path_join(s->folder, name).text, *text, *length)
                                           : status_set(FAILED, "cannot write %s: out of memory", name);
    free(*text);
    return written;
}
