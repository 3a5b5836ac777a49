/* Converts varied keys to the form in which pictures of studies show them: `boundary.0.traction` with the values [0, 10
 * MPa] and [0, 20 MPa] becomes `traction on y+` with the unit MPa and the values 10 and 20. */
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "scene/scene_read.h"
#include "scene/words.h"
#include "study_picture.h"

/* ---- values ------------------------------------------------------------------------------------------------------ */

/* Returns a copy of the characters from `from` to before `to`, without blanks at both ends. The sign of micro replaces
 * a `u` that follows a digit or a blank and precedes a unit. The caller releases the copy with memory_free. */
static char *value_shown(const char *from, const char *to)
{
    while (from < to && isspace((unsigned char)*from)) from++;
    while (to > from && isspace((unsigned char)to[-1])) to--;
    char *text = NEW("study.shown", 2 * (to - from) + 1, char), *end = text;
    for (const char *c = from; c < to; c++)
        if (*c == 'u' && c > from && (isdigit((unsigned char)c[-1]) || c[-1] == ' ') && c + 1 < to &&
            strchr("msNJ", c[1]) && (c + 2 == to || !isalpha((unsigned char)c[2])))
            end += sprintf(end, "µ");
        else
            *end++ = *c;
    return text;
}

/* Finds component number d (from 0) of a vector in the text `value`, such as [0, 10 MPa]. dim: number of components.
 * Stores in part[0] and part[1] pointers to its beginning and to the character after its end. Returns false if the text
 * is no such vector. */
static bool vector_component(const char *part[2], const char *value, int dim, int d)
{
    const char *c = value + strspn(value, " ");
    if (*c++ != '[') return false;
    for (int k = 0; k < dim; k++) {
        const char *end = c + strcspn(c, ",[]");
        if (*end != (k + 1 < dim ? ',' : ']')) return false;
        if (k == d) part[0] = c, part[1] = end;
        c = end + 1;
    }
    return !c[strspn(c, " ")];
}

/* Returns the index of the only component in which the values of a varied key (key of the input file that the study
 * varies) differ; they are texts of vectors such as [0, 10 MPa]. dim: number of components. Returns -1 if more than
 * one or none differs, or if a value is no such vector. */
static int component_that_varies(const struct varied_key *key, int dim)
{
    int varies = -1;
    for (int d = 0; d < dim; d++)
        for (int v = 0; v < key->values; v++) {
            const char *first[2], *own[2];
            if (!vector_component(first, key->value[0], dim, d) || !vector_component(own, key->value[v], dim, d))
                return -1;
            char *a = value_shown(first[0], first[1]), *b = value_shown(own[0], own[1]);
            const bool differ = strcmp(a, b) != 0;
            memory_free(a);
            memory_free(b);
            if (differ && varies >= 0 && varies != d) return -1;
            if (differ) varies = d;
        }
    return varies;
}

/* Removes the unit from all shown values of the varied key k, and stores it in k->unit, if they are numbers with one
 * common unit; stores the SI unit of the key if they are numbers without unit. Otherwise leaves the values unchanged.
 */
static void unit_part(struct plotted_key *k)
{
    const char *unit;
    k->numbers = varied_key_values_are_numbers_of_one_unit(&k->shown, &unit);
    if (!k->numbers) return;
    const struct unit shown = unit_with_si_prefix_if_unit_allows_it(*unit ? unit : scene_key_unit(k->given.key), 1);
    snprintf(k->unit, sizeof k->unit, "%.*s", UNIT_ROOM - 1, shown.name);
    for (int v = 0; v < k->shown.values; v++) {
        char *text = k->shown.value[v];
        value_text_split_number_and_unit(text, &unit);
        size_t length = (size_t)(unit - text);
        while (length > 0 && text[length - 1] == ' ') length--;
        text[length] = '\0';
    }
}

static void text_swap(char **a, char **b)
{
    char *text = *a;
    *a = *b, *b = text;
}

/* Sorts the values of the key k, which must be numbers, in ascending order: both the given and the shown values. */
static void values_sort(struct plotted_key *k)
{
    const char *unit;
    for (int v = 1; v < k->shown.values; v++)
        for (int w = v; w > 0 && value_text_split_number_and_unit(k->shown.value[w], &unit) <
                                     value_text_split_number_and_unit(k->shown.value[w - 1], &unit);
             w--) {
            text_swap(&k->shown.value[w], &k->shown.value[w - 1]);
            text_swap(&k->given.value[w], &k->given.value[w - 1]);
        }
}

/* ---- words ------------------------------------------------------------------------------------------------------- */

/* Returns the index of the entry of a list of the scene s to which a key refers; -1 if there is none. part: the part of
 * the key that identifies the entry, an index or a name; n: number of entries; name_of(s, k): function that returns the
 * name of entry k. */
static int list_entry_index(const struct scene *s, const char *part, int n,
                            const char *(*name_of)(const struct scene *, int))
{
    char *end;
    const long k = strtol(part, &end, 10);
    if (end > part && !*end) return k >= 0 && k < n ? (int)k : -1;
    for (int e = 0; e < n; e++)
        if (strcmp(name_of(s, e), part) == 0) return e;
    return -1;
}

static const char *boundary_name(const struct scene *s, int k) { return s->boundary[k].name; }
static const char *material_name(const struct scene *s, int k) { return s->material[k].name; }
static const char *body_name(const struct scene *s, int k) { return s->body[k].name; }

/* Writes the end of the words of a key, such as ` on y+` or ` of glass`, to text[capacity]: the face or the name of the
 * boundary condition, material or body to which the key belongs. group, part: first and second part of the key; normal:
 * receives the axis of the face, -1 if there is none. Returns false if the key belongs to no entry of a list of the
 * scene s. */
static bool owner_write(char *text, size_t capacity, const struct scene *s, const char *group, const char *part,
                        int *normal)
{
    int k = -1;
    *normal = -1;
    if (!strcmp(group, "boundary") && (k = list_entry_index(s, part, s->boundaries, boundary_name)) >= 0) {
        const struct boundary *b = &s->boundary[k];
        if (b->side != 0) {
            *normal = b->face;
            snprintf(text, capacity, " on %c%c", "xyz"[b->face], b -> side > 0 ? '+' : '-');
        } else
            snprintf(text, capacity, " of %s", b->name);
    } else if (!strcmp(group, "materials") && (k = list_entry_index(s, part, s->materials, material_name)) >= 0)
        snprintf(text, capacity, " of %s", s->material[k].name);
    else if (!strcmp(group, "bodies") && (k = list_entry_index(s, part, s->bodies + s->rigids, body_name)) >= 0)
        snprintf(text, capacity, " of %s", s->body[k].name);
    return k >= 0;
}

/* Appends words for `parts`, the rest of a key after its group or after the entry of its list, to text[capacity]:
 * `energy_release_rate` becomes `energy release rate`. */
static void parts_append(char *text, size_t capacity, const char *parts)
{
    const size_t used = strlen(text);
    snprintf(text + used, capacity - used, "%s",
             !strcmp(parts, "young")     ? "Young's modulus"
             : !strcmp(parts, "poisson") ? "Poisson's ratio"
                                         : parts);
    for (char *c = text + used; *c; c++)
        if (*c == '_' || *c == '.') *c = ' ';
}

/* Writes the words by which pictures name the key `key`, such as `traction on y+`, to text[capacity]. component: index
 * of the component that varies if the values are vectors, -1 if they are not; s: scene of the study, NULL if it cannot
 * be read. */
static void key_words(char *text, size_t capacity, const char *key, int component, const struct scene *s)
{
    char group[NAME_MAX_LENGTH], part[NAME_MAX_LENGTH], owner[NOTE_ROOM] = "";
    int normal = -1;
    *text = '\0';
    const char *rest = strchr(key, '.');
    snprintf(group, sizeof group, "%.*s", (int)(rest ? rest - key : (int)strlen(key)), key);
    const char *after = rest ? strchr(rest + 1, '.') : NULL;
    if (after) {
        snprintf(part, sizeof part, "%.*s", (int)(after - rest - 1), rest + 1);
        if (s && owner_write(owner, sizeof owner, s, group, part, &normal)) rest = after;
    }
    if (rest && !*owner && strcmp(group, "variables") != 0) snprintf(owner, sizeof owner, " of %s", group);
    parts_append(text, capacity, rest ? rest + 1 : key);
    if (component >= 0 && component != normal && s && s->dim > 1)
        snprintf(text + strlen(text), capacity - strlen(text), " %c", "xyz"[component]);
    snprintf(text + strlen(text), capacity - strlen(text), "%s", owner);
}

/* ---- all --------------------------------------------------------------------------------------------------------- */

/* Initialises *k, the varied key `key` (a key of the input file that a study varies) as pictures show it: its words and
 * its values without common parts. plotted_keys_free releases it. s: scene of the study, NULL if it cannot be read. */
static void shown_key_make(struct plotted_key *k, const struct varied_key *key, const struct scene *s)
{
    const int n = key->values;
    *k = (struct plotted_key){.given = *key, .shown.values = n};
    k->given.value = NEW("study.given", n, char *);
    k->shown.value = NEW("study.values", n, char *);
    k->shown.key = NEW("study.words", NOTE_ROOM, char);
    const int d = s && strcmp(key->key, "output.times") != 0 ? component_that_varies(key, s->dim) : -1;
    for (int v = 0; v < n; v++) {
        const char *part[2] = {key->value[v], key->value[v] + strlen(key->value[v])};
        if (d >= 0) vector_component(part, key->value[v], s->dim, d);
        k->given.value[v] = key->value[v];
        k->shown.value[v] = value_shown(part[0], part[1]);
    }
    key_words(k->shown.key, NOTE_ROOM, key->key, d, s);
    unit_part(k);
    if (k->numbers) values_sort(k);
}

/* Replaces the words of those of the shown keys k[keys] that have the same words as another key by their full names, as
 * in the option -s, so that all are distinct. */
static void words_part(struct plotted_key *k, int keys)
{
    for (int a = 0; a < keys; a++)
        for (int b = a + 1; b < keys; b++) {
            if (strcmp(k[a].shown.key, k[b].shown.key) != 0) continue;
            snprintf(k[a].shown.key, NOTE_ROOM, "%s", k[a].given.key);
            snprintf(k[b].shown.key, NOTE_ROOM, "%s", k[b].given.key);
        }
}

struct plotted_key *plotted_keys_create_from_varied_keys(const struct study *study, const struct varied_key *key,
                                                         int key_count)
{
    struct plotted_key *shown = NEW("study.shown", key_count, struct plotted_key);
    struct scene_override *first = NEW("study.first", key_count, struct scene_override);
    struct scene scene;
    for (int k = 0; k < key_count; k++) first[k] = (struct scene_override){key[k].key, key[k].value[0]};
    const bool read = scene_read(&scene, study->scene, first, key_count) == OK;
    for (int k = 0; k < key_count; k++) shown_key_make(&shown[k], &key[k], read ? &scene : NULL);
    words_part(shown, key_count);
    if (read) scene_free(&scene);
    memory_free(first);
    return shown;
}

void plotted_keys_free(struct plotted_key *shown, int key_count)
{
    for (int k = 0; k < key_count; k++) {
        for (int v = 0; v < shown[k].shown.values; v++) memory_free(shown[k].shown.value[v]);
        memory_free(shown[k].shown.value);
        memory_free(shown[k].shown.key);
        memory_free(shown[k].given.value);
    }
    memory_free(shown);
}
