/* Selects what a picture of a study shows: figures, and the roles of the varied keys. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "scene/words.h"
#include "study_picture.h"

/* Returns true if figure f (a number in summary.json) of the table differs between the runs of a study. */
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

void panels_choose(struct study_picture *p)
{
    static const char *const first[] = {"crack.start_time", "crack.length_end", "crack.angle_deg",
                                        "crack.tip_speed_mean"};
    const struct study_table *t = p->table;
    for (size_t k = 0; k < COUNT_OF(first); k++) panel_add(p, study_find_result(t, first[k]));
    if (p->panels == PANELS_MOST) return;
    for (int f = 0; f < t->figures && p->panels < PANELS_MOST - 1; f++)
        if (strncmp(t->figure[f], "probes.", 7) == 0) panel_add(p, f);
    for (int f = 0; f < t->figures && p->panels < PANELS_MOST - 1; f++)
        if (strncmp(t->figure[f], "energy.", 7) == 0 && !study_result_is_technical(t->figure[f])) panel_add(p, f);
    panel_add(p, study_find_result(t, "loop_seconds"));
}

status panels_of(struct study_picture *p, const char *const *of, int asked)
{
    const struct study_table *t = p->table;
    for (int k = 0; k < asked && k < PANELS_MOST; k++) {
        const int f = study_find_result(t, of[k]);
        if (f < 0)
            return status_set(REFUSED, "sweep: --of %s: there is no such figure in sweep.csv; do you mean %s?",
                              printable_name(of[k]).text,
                              word_find_most_similar(of[k], (const char *const *)t->figure, t->figures));
        p->figure[p->panels++] = f;
    }
    return OK;
}

bool key_is_chance(const char *key)
{
    return !strcmp(key, "particles.seed") || !strcmp(key, "time.step") || !strcmp(key, "time.safety");
}

void values_find(int **value_at, const struct study *s, const struct varied_key *key, int keys)
{
    for (int k = 0; k < keys; k++) {
        value_at[k] = NEW("study.value_at", s->n, int);
        int last = 0;
        for (int c = 0; c < s->n; c++) {
            const char *own = study_case_value(&s->at[c], key[k].key);
            int tried = 0;
            while (tried < key[k].values && strcmp(key[k].value[last], own) != 0) {
                last = (last + 1) % key[k].values;
                tried++;
            }
            value_at[k][c] = tried < key[k].values ? last : -1;
        }
    }
}

void roles_choose(struct study_picture *p, int lines_most)
{
    p->lines = 1;
    p->chance = false;
    for (int k = 0; k < p->keys; k++) {
        const int values = p->key[k].values;
        p->role[k] = k == p->across                   ? ROLE_ACROSS
                     : values < 2                     ? ROLE_NONE
                     : key_is_chance(p->key[k].key)   ? ROLE_CHANCE
                     : p->lines * values > lines_most ? ROLE_HELD
                                                      : ROLE_LINES;
        if (p->role[k] == ROLE_LINES) p->lines *= values;
        p->chance |= p->role[k] == ROLE_CHANCE;
    }
}
