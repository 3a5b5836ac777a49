/* Stores the choice of pilot runs (short runs that choose method and spacing) together with the request, so that an
 * equal request is later answered without runs. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/memory_stream.h"
#include "output/output_files.h"
#include "pilot_parts.h"
#include "study/uncertainty.h"

#define ASKED "asked.yaml"  /* text of the scene's file, with the overrides as comments */
#define CHOSEN "chosen.txt" /* one KEY=VALUE per line */

void pilot_runs_combine_user_and_chosen_overrides(struct pilot_choice *choice,
                                                  const struct scene_override *user_override, int user_override_count,
                                                  int chosen_key_count)
{
    memory_free(choice->override);
    choice->override = NEW("pilot.override", user_override_count + chosen_key_count + 1, struct scene_override);
    choice->overrides = user_override_count + chosen_key_count;
    for (int k = 0; k < user_override_count; k++) choice->override[k] = user_override[k];
    for (int k = 0; k < chosen_key_count; k++)
        choice->override[user_override_count + k] = (struct scene_override){choice->key[k], choice->value[k]};
}

void pilot_choice_free(struct pilot_choice *to)
{
    memory_free(to->override);
    *to = (struct pilot_choice){0};
}

/* ---- the question ------------------------------------------------------------------------------------------------ */

/* Returns the text by which a stored choice of the search p (for the method of `method: auto`) is recognised: the
 * contents of the scene file, followed by the overrides of the user as comments. Returns NULL if the scene file cannot
 * be read or memory is short. The caller releases the text with free. */
static char *question_text(const struct pilot_search *p)
{
    char *scene, *text = NULL;
    size_t length, size = 0;
    if (file_read_whole(p->scene, &scene, &length) != OK) return NULL;
    FILE *to = memory_stream_open(&text, &size);
    if (to) {
        fputs(scene, to);
        for (int k = 0; k < p->overrides; k++) fprintf(to, "\n# -s %s=%s", p->override[k].key, p->override[k].value);
        if (fclose(to) != 0) free(text), text = NULL;
    }
    memory_free(scene);
    return text;
}

/* ---- the answer -------------------------------------------------------------------------------------------------- */

/* Copies the file `from` in `folder` to the file `name` in the same folder. Returns FAILED, with a message, if it
 * cannot be read or written. */
static status file_copy(const char *folder, const char *from, const char *name)
{
    char *text;
    size_t length;
    TRY(file_read_whole(path_join(folder, from).text, &text, &length));
    const status put = file_write_whole(path_join(folder, name).text, text, length);
    memory_free(text);
    return put;
}

/* Stores two files in the folder of the pilot runs (p->folder): the scene with the chosen overrides *to, and the table
 * converge.csv with the error bars of the chosen method *best. Returns FAILED, with a message, if a file cannot be read
 * or written. */
static status bars_keep(const struct pilot_choice *to, const struct pilot_search *p, const struct pilot_candidate *best)
{
    struct scene s;
    char table[CASE_NAME_ROOM];
    TRY(scene_read(&s, p->scene, to->override, to->overrides));
    const status put = study_write_scene_and_options(p->folder, s.text, NULL);
    scene_free(&s);
    TRY(put);
    snprintf(table, sizeof table, "%s/converge.csv", best->name);
    return file_copy(p->folder, table, "converge.csv");
}

status pilot_runs_store_chosen_method_and_spacing(const struct pilot_choice *choice, const struct pilot_search *p,
                                                  const struct pilot_candidate *chosen_method)
{
    char *asked = question_text(p), *text = NULL;
    size_t length = 0;
    if (!asked)
        return status_set(FAILED,
                          "%s can no longer be read, or memory is exhausted; restore the scene and repeat the command",
                          p->scene);
    status put = bars_keep(choice, p, chosen_method);
    FILE *out = put == OK ? memory_stream_open(&text, &length) : NULL;
    if (out) {
        for (int k = p->overrides; k < choice->overrides; k++)
            fprintf(out, "%s=%s\n", choice->override[k].key, choice->override[k].value);
        put = fclose(out) == 0 ? file_write_whole(path_join(p->folder, CHOSEN).text, text, length)
                               : status_set(FAILED, "%s: out of memory", p->folder);
        if (put == OK) put = file_write_whole(path_join(p->folder, ASKED).text, asked, strlen(asked));
    }
    free(text);
    free(asked);
    return put;
}

/* Reads the lines KEY=VALUE of a stored choice from `text`, which is modified, and copies the keys to to->key and the
 * values to to->value, at most CHOSEN_MOST of each. Lines without = are skipped. Returns the number of keys. */
static int answer_read(struct pilot_choice *to, char *text)
{
    int n = 0;
    char *rest;
    for (char *line = strtok_r(text, "\n", &rest); line && n < CHOSEN_MOST; line = strtok_r(NULL, "\n", &rest)) {
        char *equals = strchr(line, '=');
        if (!equals) continue;
        *equals = '\0';
        snprintf(to->key[n], CHOSEN_ROOM, "%s", line);
        snprintf(to->value[n++], CHOSEN_ROOM, "%s", equals + 1);
    }
    return n;
}

bool pilot_runs_read_stored_method_and_spacing(struct pilot_choice *choice, const struct pilot_search *p)
{
    char *asked = question_text(p), *before = NULL, *text = NULL;
    size_t length;
    const bool same = asked && file_read_whole(path_join(p->folder, ASKED).text, &before, &length) == OK &&
                      strcmp(asked, before) == 0 &&
                      file_read_whole(path_join(p->folder, CHOSEN).text, &text, &length) == OK;
    if (same) {
        pilot_runs_combine_user_and_chosen_overrides(choice, p->override, p->overrides, answer_read(choice, text));
        if (!p->options.quiet)
            fprintf(stderr, "pilot          as chosen before: %s\n",
                    printable_name(path_join(p->folder, CHOSEN).text).text);
    }
    memory_free(text);
    memory_free(before);
    free(asked);
    return same;
}
