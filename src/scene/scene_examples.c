/* Composes examples of the values of keys, for messages that refuse an input file, from the table of keys. */
#include "scene_internal.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

/* Returns true if the value of key k (of input files) is a point or a vector, whose components may be formulas. */
static bool is_vector(const struct key *k)
{
    return k->type == KEY_POINT || (k->type == KEY_HAND && k->words && strncmp(k->words, "list of number", 14) == 0);
}

/* Returns true if the table of keys suffices to write an example of a value of key k (of input files) that is a scalar
 * or a vector, not a mapping. */
static bool has_plain_example(const struct key *k)
{
    return k->type == KEY_REAL || k->type == KEY_INT || k->type == KEY_FLAG || k->type == KEY_CHOICE || is_vector(k);
}

/* Writes an example of a number of key k (of input files) to text[capacity]: the default of the key, the example of
 * its unit, or its smallest value. */
static void write_example_number(const struct key *k, char *text, size_t capacity)
{
    char least[32];
    if (isdigit((unsigned char)*k->fallback))
        snprintf(text, capacity, "%s", k->fallback);
    else if (k->range.given && k->range.least >= 1)
        snprintf(text, capacity, "%s", number_write_shortest_exact_decimal(least, k->range.least));
    else
        snprintf(text, capacity, "%s", k->type == KEY_INT ? "20" : unit_rows[k->unit].example);
}

void key_write_example_vector(const struct key *k, int dim, const char *first_number, char *text, size_t capacity)
{
    char number[48];
    if (first_number)
        snprintf(number, sizeof number, "%s", first_number);
    else
        write_example_number(k, number, sizeof number);
    size_t used = (size_t)snprintf(text, capacity, "[%s", number);
    for (int d = 1; d < dim && used < capacity; d++)
        used += (size_t)snprintf(text + used, capacity - used, ", %s", k->range.given ? number : "0");
    if (used < capacity) snprintf(text + used, capacity - used, "]");
}

/* Returns the key of the group `group_path` that an example of the group shows: `wanted` if it is such a key, else the
 * first required one, else the first with a plain value. Returns NULL for a group without keys. */
static const struct key *key_for_example(const char *group_path, const char *wanted)
{
    const struct key *plain = NULL, *first = NULL;
    const struct key *own = wanted ? key_find(group_path, wanted) : NULL;
    if (own) return own;
    for (int k = 0; k < keys_count; k++) {
        if (!key_is_directly_below(&keys[k], group_path)) continue;
        const char *fallback = keys[k].fallback + (*keys[k].fallback == '(');
        const bool required = strncmp(fallback, "required", 8) == 0 && strncmp(fallback + 8, " with ", 6) != 0;
        if (required && keys[k].type != KEY_MATERIAL) return &keys[k];
        if (!plain && has_plain_example(&keys[k])) plain = &keys[k];
        if (!first) first = &keys[k];
    }
    return plain ? plain : first;
}

/* Writes an example of a value of key k (of input files), a key that is neither number, vector, word nor mapping, to
 * text[capacity]: solids, or the form that the table of keys describes in words. */
static void write_form(const struct key *k, char *text, size_t capacity)
{
    const char *words = k->words ? k->words : "", *pair = strchr(words, '[');
    if (k->type == KEY_REGION || strncmp(words, "solid", 5) == 0)
        snprintf(text, capacity, "{box: {from: [..], to: [..]}}");
    else if (pair)
        snprintf(text, capacity, "[%s, ..]", pair);
    else if (strstr(words, "list of points"))
        snprintf(text, capacity, "[[..], [..], ..]");
    else if (strstr(words, "list of"))
        snprintf(text, capacity, "[a, b]");
    else
        snprintf(text, capacity, "..");
}

void key_write_example(const struct key *k, int dim, const char *subkey_to_show, char *text, size_t capacity)
{
    char value[200] = "..";
    const bool is_list = k->type == KEY_LIST;
    if (is_list || k->type == KEY_MAP || k->type == KEY_PART) {
        const struct key *child = key_for_example(key_get_group_path_of_list_items(k), subkey_to_show);
        if (child) key_write_example(child, dim, NULL, value, sizeof value);
        snprintf(text, capacity, "%s{%s: %.150s}%s", is_list ? "[" : "",
                 child ? key_get_last_name_of_path(child) : "..", value, is_list ? "]" : "");
    } else if (is_vector(k))
        key_write_example_vector(k, dim, NULL, text, capacity);
    else if (k->type == KEY_SERIES)
        key_write_example_vector(k, 1, NULL, text, capacity);
    else if (k->type == KEY_REAL || k->type == KEY_INT)
        write_example_number(k, text, capacity);
    else if (k->type == KEY_FLAG || k->type == KEY_CHOICE)
        snprintf(text, capacity, "%.*s", k->type == KEY_FLAG ? 4 : (int)strcspn(k->words, "|"),
                 k->type == KEY_FLAG ? "true" : k->words);
    else
        write_form(k, text, capacity);
}
