/* Composes the names of the runs of a study and of their folders. A run has the same name in every study, independent
 * of preceding runs and of the order of its keys. */
#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "study/study.h"
#include "study_internal.h"

/* ---- hashes ------------------------------------------------------------------------------------------------------ */

/* Returns the hash of a sequence of texts that ends with `next_text`, by FNV-1a (Fowler, Noll and Vo) with a final
 * mixing step. hash: hash of the texts before it. */
uint64_t study_hash_add_text(uint64_t hash, const char *next_text)
{
    for (; *next_text; next_text++)
        hash = (hash ^ (unsigned char)*next_text) * 0x100000001b3u; /* Fowler, Noll and Vo (FNV-1a) */
    hash = (hash ^ hash >> 32) * 0x9e3779b97f4a7c15u;
    return hash ^ hash >> 29;
}

/* Returns a hash of the overrides o[n] that does not depend on their order. */
static uint64_t overrides_hash(const struct scene_override *o, int n)
{
    uint64_t sum = 0;
    for (int k = 0; k < n; k++) sum += study_hash_add_text(study_hash_add_text(STUDY_HASH_START, o[k].key), o[k].value);
    return sum;
}

/* Returns the slot of s->slot, the hash table of the run names, that contains `name`, or the empty slot in which it has
 * to be entered. */
static int name_slot(const struct study *s, const char *name)
{
    int at = (int)(study_hash_add_text(STUDY_HASH_START, name) % (uint64_t)s->slots);
    while (s->slot[at] > 0 && strcmp(s->at[s->slot[at] - 1].name, name) != 0) at = (at + 1) % s->slots;
    return at;
}

static bool name_taken(const struct study *s, const char *name) { return s->slot[name_slot(s, name)] > 0; }

void study_register_case_name(struct study *s, int case_number)
{
    s->slot[name_slot(s, s->at[case_number].name)] = case_number + 1;
}

void study_enlarge_run_name_table_if_full(struct study *s)
{
    if (2 * (s->n + 1) <= s->slots) return;
    memory_free(s->slot);
    s->slots = s->slots > 0 ? 2 * s->slots : 64;
    s->slot = NEW("study.names", s->slots, int);
    for (int k = 0; k < s->n; k++) study_register_case_name(s, k);
}

/* ---- names ------------------------------------------------------------------------------------------------------- */

/* Appends `text` to name[CASE_NAME_ROOM] as part of the name of a folder. Leaves out blanks, brackets and quotes, and
 * replaces characters that file systems or shells treat specially by _. A text too long is truncated. */
static void name_append(char *name, const char *text)
{
    size_t n = strlen(name);
    for (; *text && n + 1 < CASE_NAME_ROOM; text++) {
        if (*text == ' ' || strchr("[]{}\"'", *text)) continue;
        name[n++] = isalnum((unsigned char)*text) || strchr(".-+=_,", *text) ? *text : '_';
    }
    name[n] = '\0';
}

void study_choose_case_name(const struct study *s, char *name, const char *wanted_name,
                            const struct scene_override *override, int override_count)
{
    *name = '\0';
    name_append(name, wanted_name);
    const bool reserved = !*name || *name == '.' || *name == '-' || !strcmp(name, "pictures") || !strcmp(name, "logs");
    if (strlen(wanted_name) + 1 < CASE_NAME_ROOM && !reserved && !name_taken(s, name)) return;
    uint64_t hash = study_hash_add_text(overrides_hash(override, override_count), wanted_name);
    do snprintf(name, CASE_NAME_ROOM, "case-%012llx", (unsigned long long)(hash++ & 0xffffffffffffu));
    while (name_taken(s, name));
}

/* ---- names of combinations --------------------------------------------------------------------------------------- */

/* Returns a pointer to the part of the scene key `key` after its last dot, such as young of material.young; the whole
 * key if it has no dot. */
static const char *key_last(const char *key)
{
    const char *dot = strrchr(key, '.');
    return dot ? dot + 1 : key;
}

/* Returns the text (part of key[k].key) by which names of runs mention the varied key key[k] (a key of the input file
 * that a study varies): its last part, or the whole key if another of key[keys] has the same last part. */
static const char *key_label(const struct varied_key *key, int keys, int k)
{
    const char *own = key_last(key[k].key);
    for (int other = 0; other < keys; other++)
        if (other != k && key[other].values > 1 && !strcmp(key_last(key[other].key), own)) return key[k].key;
    return own;
}

/* A varied key with its label, and its index `at`, for sorting. */
struct labelled {
    const char *label, *key;
    int at;
};

static int label_order(const void *a, const void *b)
{
    const struct labelled *x = a, *y = b;
    const int order = strcmp(x->label, y->label);
    return order != 0 ? order : strcmp(x->key, y->key);
}

int study_list_multivalued_keys_in_name_order(int *key_order, const struct varied_key *key, int key_count)
{
    struct labelled *l = NEW("study.labels", key_count, struct labelled);
    int n = 0;
    for (int k = 0; k < key_count; k++)
        if (key[k].values > 1) l[n++] = (struct labelled){key_label(key, key_count, k), key[k].key, k};
    array_sort(l, n, sizeof *l, label_order);
    for (int k = 0; k < n; k++) key_order[k] = l[k].at;
    memory_free(l);
    return n;
}

void study_compose_case_name(char *name, const struct varied_key *key, int key_count, const int *key_order,
                             int named_key_count, const int *value_index)
{
    *name = '\0';
    for (int k = 0; k < named_key_count; k++) {
        const int own = key_order[k];
        if (k > 0) name_append(name, ",");
        name_append(name, key_label(key, key_count, own));
        name_append(name, "=");
        name_append(name, key[own].value[value_index[own]]);
    }
    if (named_key_count == 0) name_append(name, "run");
}
