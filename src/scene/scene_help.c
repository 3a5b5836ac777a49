/* Writes the reference of the scene keys for `cleave help` and the manual page, from the table of keys. */
#include "scene_internal.h"

#include <ctype.h>
#include <math.h>
#include <string.h>

/* ---- facts of a key ---------------------------------------------------------------------------------------------- */

/* Returns the type of the values of key k (of input files) in words for the reference, such as `whole number`. The
 * text is static. */
static const char *type_text(const struct key *k)
{
    switch (k->type) {
    case KEY_REAL:
        return k->words ? "number or auto" : "number";
    case KEY_INT:
    case KEY_SEED:
        return "whole number";
    case KEY_FLAG:
        return "true or false";
    case KEY_CHOICE:
        return "word";
    case KEY_SET:
        return "list of words";
    case KEY_SERIES:
        return "list of numbers";
    case KEY_NAME:
        return "name";
    case KEY_POINT:
        return "list of numbers";
    case KEY_MATRIX:
        return "matrix";
    case KEY_REGION:
        return "solids";
    case KEY_BODY:
        return "name of a body";
    case KEY_MATERIAL:
        return "name of a material";
    case KEY_MAP:
    case KEY_PART:
        return "keys";
    case KEY_LIST:
        return "list";
    case KEY_GROUP:
        return "keys of solids";
    default:
        return k->words;
    }
}

/* Writes the range of key k (of input files), such as `> 0, <= 1`, or the words that are its values, separated by
 * commas, to text[capacity]; "" if it has neither. */
static void range_text(const struct key *k, char *text, size_t capacity)
{
    char least[32], most[32];
    *text = '\0';
    if ((k->type == KEY_CHOICE || k->type == KEY_SET) && k->words) {
        size_t used = 0;
        for (const char *c = k->words; *c && used + 3 < capacity; c++) {
            text[used++] = *c == '|' ? ',' : *c;
            if (*c == '|') text[used++] = ' ';
        }
        text[used] = '\0';
        return;
    }
    if (!k->range.given) return;
    number_write_shortest_exact_decimal(least, k->range.least);
    number_write_shortest_exact_decimal(most, k->range.most);
    if (isinf(k->range.most))
        snprintf(text, capacity, "%s %s", k->range.open ? ">" : ">=", least);
    else if (k->range.open)
        snprintf(text, capacity, "> %s, <= %s", least, most);
    else
        snprintf(text, capacity, "%s .. %s", least, most);
    if (k->type == KEY_LIST || k->type == KEY_HAND) {
        size_t used = strlen(text);
        if (k->type == KEY_LIST || k->range.least > 1) snprintf(text + used, capacity - used, " items");
    }
}

/* Writes the default of key k (of input files) to text[capacity]; "" if the key has none. A default that depends on
 * other keys is in brackets in the table of keys; the brackets are omitted. */
static void default_text(const struct key *k, char *text, size_t capacity)
{
    bool explained = *k->fallback == '(';
    size_t length = strlen(k->fallback) - (explained ? 2 : 0);
    snprintf(text, capacity, "%.*s", (int)length, k->fallback + explained);
    if (strcmp(text, "-") == 0) *text = '\0';
}

void key_describe_type(const struct key *k, char *text, size_t capacity)
{
    char range[400], fallback[96]; /* the names of all fields of frames have 270 characters */
    range_text(k, range, sizeof range);
    default_text(k, fallback, sizeof fallback);
    const char *symbol = unit_rows[k->unit].symbol;
    bool required = strncmp(fallback, "required", 8) == 0;
    snprintf(text, capacity, "%s%s%s%s%s%s%s%s%s", type_text(k), *symbol ? " [" : "", symbol, *symbol ? "]" : "",
             *range ? "; " : "", range, *fallback ? "; " : "", *fallback && !required ? "default " : "", fallback);
}

void key_describe_meaning_and_type(const struct key *k, char *text, size_t capacity)
{
    char facts[640];
    key_describe_type(k, facts, sizeof facts);
    snprintf(text, capacity, "%s (%s)", k->help, facts);
}

/* ---- cleave help ------------------------------------------------------------------------------------------------- */

/* Converts the path of a key as typed by a user to its path in the table of keys, path[capacity]: drops indices in
 * brackets and replaces `materials` by `material`. */
static void path_of_table(const char *key, char *path, size_t capacity)
{
    size_t used = 0, skip = 0;
    if (strncmp(key, "materials.", 10) == 0 || strncmp(key, "materials[", 10) == 0) {
        used = (size_t)snprintf(path, capacity, "material");
        skip = 9;
    }
    for (const char *c = key + skip; *c && used + 1 < capacity; c++) {
        if (*c == '[')
            c += strcspn(c, "]");
        else
            path[used++] = *c;
        if (*c == '\0') break;
    }
    path[used] = '\0';
    text_replace_control_characters(path);
}

bool key_is_at_or_below_path(const struct key *k, const char *path)
{
    size_t length = strlen(path);
    if (strncmp(k->path, path, length) != 0) return false;
    return length == 0 || k->path[length] == '\0' || k->path[length] == '.';
}

/* Returns the edit distance between `path` and key k (of input files): the smaller of the distances to the path of k
 * and to the last part of its path. */
static int key_distance(const struct key *k, const char *path)
{
    const int whole = edit_distance(k->path, path), leaf = edit_distance(key_get_last_name_of_path(k), path);
    return whole < leaf ? whole : leaf;
}

/* Returns REFUSED with the message that `path` is no key. The message names the key nearest by edit distance if the two
 * are similar (word_is_probable_misspelling_of), else the pages of `cleave help`. */
static status help_unknown(const char *path)
{
    const struct key *nearest = &keys[0];
    for (int k = 1; k < keys_count; k++)
        if (key_distance(&keys[k], path) < key_distance(nearest, path)) nearest = &keys[k];
    if (word_is_probable_misspelling_of(nearest->path, path) ||
        word_is_probable_misspelling_of(key_get_last_name_of_path(nearest), path))
        return status_set(REFUSED, "%.64s: unknown key; did you mean %s?", path, nearest->path);
    return status_set(REFUSED,
                      "%.64s: neither a key nor a page; `cleave help scene` lists the keys; pages are units, "
                      "expression, run, theory and trust; the manual is inputs/README.md",
                      path);
}

/* Returns true if `leaf` is the last part of the path of key k (of input files). */
static bool has_leaf(const struct key *k, const char *leaf)
{
    return k->type != KEY_GROUP && !strcmp(key_get_last_name_of_path(k), leaf);
}

/* Returns true if `word`, with _ for blanks, is one of the words that key k (of input files) has as values. Returns
 * false for the key `accept`, whose words are names of warnings. */
static bool is_value_of(const struct key *k, const char *word)
{
    const size_t length = strlen(word);
    if (!strcmp(k->path, "accept")) return false;
    for (const char *c = k->type == KEY_CHOICE || k->type == KEY_SET ? k->words : NULL; c && *c;) {
        const size_t here = strcspn(c, "|");
        bool equal = here == length && length > 0;
        for (size_t j = 0; j < here && equal; j++) equal = word[j] == (c[j] == ' ' ? '_' : c[j]);
        if (equal) return true;
        c += here + (c[here] == '|');
    }
    return false;
}

bool scene_help_can_explain_word(const char *key)
{
    char path[128];
    path_of_table(key, path, sizeof path);
    bool has = former_key_get_current_name(path) || other_program_keyword_get_equivalent_keys(path);
    for (int k = 0; k < keys_count && !has; k++)
        has = key_is_at_or_below_path(&keys[k], path) || has_leaf(&keys[k], path) || is_value_of(&keys[k], path);
    return has;
}

static void print_key(FILE *out, const struct key *k)
{
    char facts[640];
    key_describe_type(k, facts, sizeof facts);
    fprintf(out, "%-30s %s\n%-30s   %s\n", k->path, facts, "", k->help);
}

/* Prints the advice for `word`, a word of other programs, and the keys that are equivalent or related to it, to `out`.
 * The table of such words must contain it. */
static void help_foreign(FILE *out, const char *word)
{
    char text[400], path[64];
    if (other_program_keyword_write_advice(word, "", text, sizeof text)) fprintf(out, "%s: %s\n", word, text);
    for (const char *c = other_program_keyword_get_equivalent_keys(word); *c; c += strspn(c, " ")) {
        const size_t length = strcspn(c, " ");
        snprintf(path, sizeof path, "%.*s", (int)length, c);
        int found = 0;
        fputc('\n', out);
        for (int k = 0; k < keys_count; k++)
            if (key_is_at_or_below_path(&keys[k], path)) print_key(out, &keys[k]), found++;
        INVARIANT(found > 0);
        c += length;
    }
}

/* Prints the keys whose path ends with `word`, the keys that have the word as a value, and the keys that are equivalent
 * to it if it is a word of other programs, to `out`. Returns the number of keys printed, where the equivalent ones
 * count as one. */
static int help_word_of_keys(FILE *out, const char *word)
{
    int printed = 0;
    for (int k = 0; k < keys_count; k++)
        if (has_leaf(&keys[k], word)) print_key(out, &keys[k]), printed++;
    for (int k = 0; k < keys_count; k++) {
        if (!is_value_of(&keys[k], word)) continue;
        fprintf(out, "%s%s is a value of %s\n", printed ? "\n" : "", word, keys[k].path);
        print_key(out, &keys[k]), printed++;
    }
    if (other_program_keyword_get_equivalent_keys(word) && printed > 0) fputc('\n', out);
    if (other_program_keyword_get_equivalent_keys(word)) help_foreign(out, word), printed++;
    return printed;
}

/* Prints to `out` that `word` is a unit of scenes, or, if it is the name of another known unit, its value in units of
 * scenes. Prints nothing and returns false for other words. */
static bool help_unit(FILE *out, const char *word)
{
    struct quantity q;
    const char *meant = unknown_unit_name_suggest_known_unit(word);
    const bool known = *word && quantity_read_unit_symbol(&q, word) == strlen(word);
    if (known)
        fprintf(out, "%s: a unit, written behind a number; `cleave help units` lists all units\n", word);
    else if (meant)
        fprintf(out, "%s: not a unit of scenes (%s); `cleave help units` lists the units\n", word, meant);
    return known || meant;
}

status scene_print_help_on_keys(FILE *out, const char *key)
{
    char path[128] = "";
    int found = 0;
    if (key) path_of_table(key, path, sizeof path);
    const char *now = former_key_get_current_name(path);
    if (now) fprintf(out, "%s has been renamed to %s\n\n", path, now), snprintf(path, sizeof path, "%s", now);
    for (int k = 0; k < keys_count; k++) found += key_is_at_or_below_path(&keys[k], path);
    if (found == 0) return help_word_of_keys(out, path) > 0 || help_unit(out, path) ? OK : help_unknown(path);
    if (!key)
        fprintf(out, "Keys of a scene: type [SI unit]; range or words; default. A number without a unit is SI.\n"
                     "Units are written behind it: 0.5 mm, 190 GPa, 7800 kg/m^3.\n\n");
    for (int k = 0; k < keys_count; k++) {
        if (!key_is_at_or_below_path(&keys[k], path)) continue;
        bool top = !strchr(keys[k].path, '.'), has_keys = keys[k].type >= KEY_MAP;
        if (top && has_keys && !key) fputc('\n', out);
        print_key(out, &keys[k]);
    }
    return OK;
}

/* ---- cleave.1 ---------------------------------------------------------------------------------------------------- */

/* Writes `text` to `out` with escapes for the characters \ - ^, which have a meaning in troff. */
static void troff(FILE *out, const char *text)
{
    for (const char *c = text; *c; c++) {
        if (*c == '\\')
            fputs("\\e", out);
        else if (*c == '-')
            fputs("\\-", out);
        else if (*c == '^')
            fputs("\\(ha", out);
        else
            fputc(*c, out);
    }
}

void scene_print_keys_for_manual_page(FILE *out)
{
    char facts[640];
    for (int k = 0; k < keys_count; k++) {
        key_describe_type(&keys[k], facts, sizeof facts);
        fputs(".TP\n.B ", out);
        troff(out, keys[k].path);
        fputs("\n", out);
        troff(out, facts);
        fputs("\n.br\n", out);
        troff(out, keys[k].help);
        fputs("\n", out);
    }
}

/* ---- completion -------------------------------------------------------------------------------------------------- */

/* Returns true if the first `length` characters of `path` are the key of a list, whose items are addressed by index. */
static bool is_item_list(const char *path, size_t length)
{
    for (int k = 0; k < keys_count; k++)
        if (strncmp(keys[k].path, path, length) == 0 && keys[k].path[length] == '\0') return keys[k].type == KEY_LIST;
    return false;
}

/* Writes the path of a key to `out` in the form of an override on the command line, with index 0 for each list:
 * `boundary.time` as `boundary.0.time`. */
static void override_path(FILE *out, const char *path)
{
    for (const char *c = path; *c; c++) {
        if (*c == '.' && is_item_list(path, (size_t)(c - path))) fputs(".0", out);
        fputc(*c, out);
    }
}

void scene_print_override_keys(FILE *out)
{
    for (int k = 0; k < keys_count; k++) {
        if (keys[k].type >= KEY_MAP && keys[k].type != KEY_HAND) continue;
        if (strncmp(keys[k].path, "solid", 5) == 0) continue;
        override_path(out, keys[k].path);
        fputc('\n', out);
    }
}
