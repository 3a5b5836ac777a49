/* Collects the results of all runs of a study in a table. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "base/memory_stream.h"
#include "output/output_files.h"
#include "output/picture_file.h"
#include "output/renamed_results.h"
#include "output/summary_read.h"
#include "study_internal.h"

/* ---- reading ----------------------------------------------------------------------------------------------------- */

/* Position in the table of a study while the table is filled. row: index of the current run; next: index of the scalar
 * result that is expected next, because most runs have their results in the same order. */
struct filled {
    struct study_table *table;
    int row, next;
};

static int figure_add(struct study_table *t, const char *name)
{
    GROW("study.figure", t->figure, t->figures + 1);
    GROW("study.value", t->value, t->figures + 1);
    char *copy = NEW("study.name", (int64_t)strlen(name) + 1, char);
    strcpy(copy, name);
    double *value = NEW("study.values", t->cases, double);
    for (int k = 0; k < t->cases; k++) value[k] = NAN;
    t->figure[t->figures] = copy;
    t->value[t->figures] = value;
    return t->figures++;
}

/* Stores one number of a summary in the table, in the row of the current run. A scalar result that is not in the table
 * yet gets a new column. context: pointer to a struct filled; key: name of the result; value: the number. Called by
 * summary_visit_numbers for each number of a summary. */
static void number_take(void *context, const char *key, double value)
{
    struct filled *f = context;
    int at = f->next < f->table->figures && !strcmp(f->table->figure[f->next], key)
                 ? f->next
                 : study_table_index_of_result(f->table, key);
    if (at < 0) at = figure_add(f->table, key);
    f->table->value[at][f->row] = value;
    f->next = at + 1;
}

status study_table_read(struct study_table *t, const struct study *s)
{
    *t = (struct study_table){.cases = s->n};
    for (int k = 0; k < s->n; k++) {
        const struct path folder = study_case_folder(s, &s->at[k]);
        struct filled f = {.table = t, .row = k};
        /* A stopped run also has a summary, but with results of a part of the scene. */
        if (s->at[k].state != CASE_DONE && s->at[k].state != CASE_DONE_BEFORE) continue;
        if (!path_is_file(path_join(folder.text, "summary.json").text)) continue;
        const status read = summary_visit_numbers(folder.text, number_take, &f);
        if (read == OK) continue;
        study_table_free(t);
        return read;
    }
    return OK;
}

void study_table_free(struct study_table *t)
{
    for (int f = 0; f < t->figures; f++) {
        memory_free(t->figure[f]);
        memory_free(t->value[f]);
    }
    memory_free(t->figure);
    memory_free(t->value);
    *t = (struct study_table){0};
}

int study_table_index_of_result(const struct study_table *t, const char *name)
{
    for (int f = 0; f < t->figures; f++)
        if (strcmp(t->figure[f], name) == 0) return f;
    const char *now = renamed_result_find_current_name(name);
    return now ? study_table_index_of_result(t, now) : -1;
}

bool result_describes_computation_instead_of_body(const char *name)
{
    static const char *const begin[] = {"steps",          "time_step",      "time_end",
                                        "particles",      "bonds_",         "levels.",
                                        "laps.",          "threads",        "wall_",
                                        "loop_",          "memory_",        "ns_per_",
                                        "inactive_share", "momentum_error", "energy.balance_error",
                                        "solver.",        "auto.",          "conversion.",
                                        "contact.pairs",  "contact.nodes",  "fragments.particles",
                                        "uncertainty."};
    for (size_t k = 0; k < COUNT_OF(begin); k++)
        if (strncmp(name, begin[k], strlen(begin[k])) == 0) return true;
    return false;
}

/* ---- sweep.csv --------------------------------------------------------------------------------------------------- */

/* Prints a text as a cell of a CSV table to `to`, in quotes if it contains a comma, a quote or a line break. */
static void cell_print(FILE *to, const char *text)
{
    if (!strpbrk(text, ",\"\n")) {
        fputs(text, to);
        return;
    }
    putc('"', to);
    for (; *text; text++) {
        if (*text == '"') putc('"', to);
        putc(*text, to);
    }
    putc('"', to);
}

static const char *state_of(const struct study *s, const struct study_case *c, char *text, size_t capacity)
{
    const struct path folder = study_case_folder(s, c);
    if (!path_is_file(path_join(folder.text, "summary.json").text))
        return study_case_whose_results_are_used(s, c)->state == CASE_FAILED ? "failed" : "missing";
    return summary_read_string(folder.text, "status", text, capacity) == OK ? text : "unknown";
}

static void table_print(FILE *to, const struct study_table *t, const struct study *s, const struct varied_key *key,
                        int keys)
{
    fputs("run,state", to);
    for (int k = 0; k < keys; k++)
        if (key[k].values > 1) putc(',', to), cell_print(to, key[k].key);
    for (int f = 0; f < t->figures; f++) putc(',', to), cell_print(to, t->figure[f]);
    putc('\n', to);
    for (int c = 0; c < s->n; c++) {
        char state[NAME_MAX_LENGTH];
        cell_print(to, study_case_whose_results_are_used(s, &s->at[c])->name);
        putc(',', to);
        cell_print(to, state_of(s, &s->at[c], state, sizeof state));
        for (int k = 0; k < keys; k++)
            if (key[k].values > 1) putc(',', to), cell_print(to, study_case_value_of_key(&s->at[c], key[k].key));
        for (int f = 0; f < t->figures; f++)
            if (isnan(t->value[f][c]))
                putc(',', to);
            else
                fprintf(to, ",%.15g", t->value[f][c]);
        putc('\n', to);
    }
}

status study_write_table(const struct study_table *t, const struct study *s, const struct varied_key *key, int keys)
{
    char *text = NULL;
    size_t length = 0;
    FILE *to = memory_stream_open(&text, &length);
    if (to) table_print(to, t, s, key, keys);
    return study_write_memory_stream_to_file(s, "sweep.csv", to, &text, &length);
}

/* ---- guard ------------------------------------------------------------------------------------------------------- */

/* Checks that the table sweep.csv and the pictures of the study replace no file that Cleave did not write. key[keys]:
 * varied keys (keys of the input file that a study varies) of the study. Returns REFUSED, with a message, if one
 * would; OK for folders of no study, which study_lock_folder refuses. s: the study. */
status study_check_output_files_replaceable(const struct study *s, const struct varied_key *key, int keys)
{
    static const char *const begin[] = {"run,state"};
    const struct path pictures = path_join(s->folder, "pictures");
    if (study_folder_check_is_usable(s->folder) != OK) return OK; /* study_lock_folder reports the fault */
    TRY(file_check_has_known_beginning(path_join(s->folder, "sweep.csv").text, begin, COUNT_OF(begin)));
    char name[PICTURE_NAME_ROOM];
    study_picture_compose_file_name(name, "map");
    TRY(picture_check_replaceable(path_join(pictures.text, name).text));
    for (int k = 0; k < keys; k++) {
        study_picture_compose_file_name(name, key[k].key);
        if (key[k].values > 1) TRY(picture_check_replaceable(path_join(pictures.text, name).text));
    }
    return OK;
}
