/* Selects what a picture of a study shows: results, and the roles of the varied keys. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "scene/words.h"
#include "study_picture.h"

/* Returns true if result f (a number in summary.json) of the table t differs between the runs of a study by more than
 * round-off. */
static bool figure_varies(const struct study_table *t, int f)
{
    double least = INFINITY, most = -INFINITY;
    int known = 0;
    for (int c = 0; c < t->cases; c++) {
        if (isnan(t->value[f][c])) continue;
        least = fmin(least, t->value[f][c]), most = fmax(most, t->value[f][c]);
        known++;
    }
    return known > 1 && most - least > 1e-9 * fmax(fabs(most), fabs(least));
}

static void panel_add(struct study_picture *p, int f)
{
    if (f < 0 || p->panels == PANELS_MOST || !figure_varies(p->table, f)) return;
    for (int k = 0; k < p->panels; k++)
        if (p->figure[k] == f) return;
    p->figure[p->panels++] = f;
}

void study_picture_choose_results_of_panels(struct study_picture *picture)
{
    static const char *const first[] = {"crack.start_time", "crack.length_end", "crack.angle_deg",
                                        "crack.tip_speed_mean"};
    const struct study_table *t = picture->table;
    for (size_t k = 0; k < COUNT_OF(first); k++) panel_add(picture, study_table_index_of_result(t, first[k]));
    if (picture->panels == PANELS_MOST) return;
    for (int f = 0; f < t->figures && picture->panels < PANELS_MOST - 1; f++)
        if (strncmp(t->figure[f], "probes.", 7) == 0) panel_add(picture, f);
    for (int f = 0; f < t->figures && picture->panels < PANELS_MOST - 1; f++)
        if (strncmp(t->figure[f], "energy.", 7) == 0 && !result_describes_computation_instead_of_body(t->figure[f]))
            panel_add(picture, f);
    panel_add(picture, study_table_index_of_result(t, "loop_seconds"));
}

status study_picture_set_results_of_panels_by_name(struct study_picture *picture, const char *const *figure_name,
                                                   int figure_count)
{
    const struct study_table *t = picture->table;
    for (int k = 0; k < figure_count && k < PANELS_MOST; k++) {
        const int f = study_table_index_of_result(t, figure_name[k]);
        if (f < 0)
            return status_set(REFUSED,
                              "sweep: --of %s: sweep.csv has no such figure%s its first line names all figures",
                              printable_name(figure_name[k]).text,
                              word_propose_similar(figure_name[k], (const char *const *)t->figure, t->figures).text);
        picture->figure[picture->panels++] = f;
    }
    return OK;
}

bool key_is_random_seed(const char *key)
{
    const char *dot = strrchr(key, '.');
    return dot && strcmp(dot, ".seed") == 0;
}

bool key_is_random_seed_or_time_step(const char *key)
{
    return key_is_random_seed(key) || !strcmp(key, "time.step") || !strcmp(key, "time.safety");
}

bool study_varies_only_random_seed(const struct varied_key *key, int key_count)
{
    int varied = 0, at = 0;
    for (int k = 0; k < key_count; k++)
        if (key[k].values > 1) varied++, at = k;
    return varied == 1 && key_is_random_seed(key[at].key);
}

void study_find_value_index_of_each_key_in_each_run(int **value_at, const struct study *study,
                                                    const struct plotted_key *key, int key_count)
{
    for (int k = 0; k < key_count; k++) {
        value_at[k] = NEW("study.value_at", study->n, int);
        int last = 0;
        for (int c = 0; c < study->n; c++) {
            const struct varied_key *given = &key[k].given;
            const char *own = study_case_value_of_key(&study->at[c], given->key);
            int tried = 0;
            while (tried < given->values && strcmp(given->value[last], own) != 0) {
                last = (last + 1) % given->values;
                tried++;
            }
            value_at[k][c] = tried < given->values ? last : -1;
        }
    }
}

void study_picture_assign_roles_to_varied_keys(struct study_picture *picture, int max_lines)
{
    picture->lines = 1;
    picture->chance = false;
    for (int k = 0; k < picture->keys; k++) {
        const int values = picture->key[k].shown.values;
        picture->role[k] = k == picture->across                                         ? ROLE_ACROSS
                           : values < 2                                                 ? ROLE_NONE
                           : key_is_random_seed_or_time_step(picture->key[k].given.key) ? ROLE_CHANCE
                           : picture->lines * values > max_lines                        ? ROLE_HELD
                                                                                        : ROLE_LINES;
        if (picture->role[k] == ROLE_LINES) picture->lines *= values;
        picture->chance |= picture->role[k] == ROLE_CHANCE;
    }
}
