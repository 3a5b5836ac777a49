/* Reads values from nodes by the table of keys. */
#include "scene_parts.h"

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

/* ---- scalars ----------------------------------------------------------------------------------------------------- */

/* Returns REFUSED, with the expected range in the message, if `value` [SI], read from YAML node n, is outside the
 * range of key k (of input files). */
static status check_range(struct reader *r, const struct key *k, const struct yaml_node *n, real value)
{
    const struct range *range = &k->range;
    char least[32], most[32];
    if (!range->given) return OK;
    bool low = range->open ? !(value > range->least) : !(value >= range->least);
    if (!low && value <= range->most) return OK;
    if (low && k->low) return fault_report_at_node(r, n, "%s %s", node_value_to_text_for_message(r, n), k->low);
    const struct unit_row *unit = &unit_rows[k->unit];
    const char *name = k->type == KEY_INT ? "a whole number" : unit->name;
    bool bounded = isfinite(range->most);
    const char *advice = other_program_value_get_advice(k->path, n->text);
    return fault_report_at_node(
        r, n, "%s is out of range; give %s %s %s%s%s%s%s%s%s", node_value_to_text_for_message(r, n), name,
        range->open ? "above" : "from", number_write_shortest_exact_decimal(least, range->least),
        bounded       ? (range->open ? " up to " : " to ")
        : range->open ? ""
                      : " on",
        bounded ? number_write_shortest_exact_decimal(most, range->most) : "", k->unit ? ", such as " : "",
        k->unit ? unit->example : "", advice ? "; " : "", advice ? advice : "");
}

status read_number(struct reader *r, const struct key *k, const struct yaml_node *n, real *value)
{
    char what[256];
    if (n->kind != NODE_SCALAR)
        return fault_report_at_node(r, n, "%s is not a number; give %s, such as %s",
                                    node_value_to_text_for_message(r, n), unit_rows[k->unit].name,
                                    unit_rows[k->unit].example);
    if (k->type == KEY_REAL && k->words && strcmp(n->text, k->words) == 0) {
        *value = k->word_value;
        return OK;
    }
    bool infinite = k->infinite && !(k->type == KEY_POINT && r->bounded);
    if (!number_evaluate_text(r, value, n->text, k->unit, infinite, what, sizeof what)) {
        const char *advice = other_program_value_get_advice(k->path, n->text);
        message_suggest_length_as_number_of_spacings(r, k, n->text, what, sizeof what);
        return fault_report_at_node(r, n, "%s %s%s%s", node_value_to_text_for_message(r, n), what, advice ? "; " : "",
                                    advice ? advice : "");
    }
    return check_range(r, k, n, *value);
}

/* Reads an expression from YAML node n into *value. Returns REFUSED, with a message, unless its value is a whole
 * number to a relative 1e-9. */
static status read_whole(struct reader *r, const struct yaml_node *n, real *value)
{
    char what[256];
    real number;
    if (!number_evaluate_text(r, &number, n->text, UNIT_NONE, false, what, sizeof what))
        return fault_report_at_node(r, n, "%s %s", node_value_to_text_for_message(r, n), what);
    *value = round(number);
    if (fabs(number - *value) <= 1e-9 * (1 + fabs(number))) return OK;
    return fault_report_at_node(r, n, "%s is %g; give a whole number", node_value_to_text_for_message(r, n), number);
}

/* Reads a whole number from YAML node n into *value: digits, or an expression or fraction whose value is whole. Returns
 * REFUSED, with a message, for other texts and outside the range of key k (of input files). */
static status read_int(struct reader *r, const struct key *k, const struct yaml_node *n, int *value)
{
    const char *c = n->text + (*n->text == '-');
    if (n->kind == NODE_SCALAR && (strchr(n->text, '/') || text_looks_like_expression(r, n->text))) {
        real whole;
        TRY(read_whole(r, n, &whole));
        *value = (int)real_max(INT32_MIN, real_min(INT32_MAX, whole));
        return check_range(r, k, n, whole);
    }
    size_t digits = strspn(c, "0123456789");
    if (n->kind != NODE_SCALAR || digits == 0 || c[digits] != '\0' || (*c == '0' && digits > 1))
        return fault_report_at_node(r, n, "%s is not a whole number; write digits only, such as 20",
                                    node_value_to_text_for_message(r, n));
    errno = 0;
    long long number = strtoll(n->text, NULL, 10);
    if (errno || number > INT32_MAX || number < INT32_MIN) number = *n->text == '-' ? INT32_MIN : INT32_MAX;
    *value = (int)number;
    return check_range(r, k, n, (real)number);
}

static status read_seed(struct reader *r, const struct yaml_node *n, uint64_t *value)
{
    size_t digits = strspn(n->text, "0123456789");
    real whole = -1;
    if (n->kind == NODE_SCALAR && text_looks_like_expression(r, n->text)) TRY(read_whole(r, n, &whole));
    errno = 0;
    if (whole >= 0 && whole < 9e15)
        *value = (uint64_t)whole;
    else if (n->kind == NODE_SCALAR && digits > 0 && n->text[digits] == '\0')
        *value = strtoull(n->text, NULL, 10);
    else
        errno = EINVAL;
    if (errno == 0) return OK;
    return fault_report_at_node(r, n, "%s is not a seed; give a whole number from 0 to 18446744073709551615",
                                node_value_to_text_for_message(r, n));
}

static status read_flag(struct reader *r, const struct yaml_node *n, bool *value)
{
    int word = n->kind == NODE_SCALAR ? word_index_in_list("false|true", n->text) : -1;
    if (word < 0)
        return fault_report_at_node(r, n, "%s is neither true nor false; write true or false",
                                    node_value_to_text_for_message(r, n));
    *value = word == 1;
    return OK;
}

static status read_choice(struct reader *r, const struct key *k, const struct yaml_node *n, void *place)
{
    const char *words = allowed_words_join_for_message(r, k->words);
    int word = n->kind == NODE_SCALAR ? word_index_in_list(k->words, n->text) : -1;
    const char *advice = other_program_value_get_advice(k->path, n->text);
    if (word < 0)
        return fault_report_at_node(r, n, "%s is unknown; give %s%s%s", node_value_to_text_for_message(r, n), words,
                                    advice ? "; " : "", advice ? advice : "");
    if (k->size == sizeof(int)) memcpy(place, &word, sizeof word);
    if (k->size == 1) *(bool *)place = word == 1;
    return OK;
}

/* Returns the word of `words`, a text a|b|c, most similar to `text`, in the arena of the reader r; NULL if none is
 * similar (word_is_probable_misspelling_of). */
static const char *word_near(struct reader *r, const char *words, const char *text)
{
    const char *nearest = NULL;
    for (const char *c = words; c; c = strchr(c, '|') ? strchr(c, '|') + 1 : NULL) {
        const char *word = arena_copy_text(r, c, strcspn(c, "|"));
        if (word_is_probable_misspelling_of(word, text) &&
            (!nearest || edit_distance(word, text) < edit_distance(nearest, text)))
            nearest = word;
    }
    return nearest;
}

/* Reads words of key k (of input files), `none` or `all` from YAML node n into *bits, one bit per word. Returns
 * REFUSED, with a message, for other texts. */
static status read_set(struct reader *r, const struct key *k, const struct yaml_node *n, unsigned *bits)
{
    const char *words = allowed_words_join_for_message(r, k->words);
    *bits = 0;
    if (n->kind == NODE_SCALAR && strcmp(n->text, "none") == 0) return OK;
    for (const char *c = k->words; c && n->kind == NODE_SCALAR && strcmp(n->text, "all") == 0; c = strchr(c + 1, '|'))
        *bits = *bits << 1 | 1;
    if (*bits) return OK;
    if (n->kind != NODE_LIST || n->n == 0)
        return fault_report_at_node(r, n, "%s is unknown; give none, all or a list of %s",
                                    node_value_to_text_for_message(r, n), words);
    for (const struct yaml_node *c = n->first; c; c = c->next) {
        int word = c->kind == NODE_SCALAR ? word_index_in_list(k->words, c->text) : -1;
        if (word < 0) {
            const char *near = word_near(r, k->words, c->text);
            return fault_report_at_node(r, c, "%s is unknown%s%s; give %s", node_value_to_text_for_message(r, c),
                                        near ? "; the most similar is " : "", near ? near : "", words);
        }
        *bits |= 1u << word;
    }
    return OK;
}

/* Reads any text from YAML node n into text[capacity]. Returns REFUSED, with a message, if it is empty or too long. */
static status read_any_text(struct reader *r, const struct yaml_node *n, char *text, size_t capacity)
{
    const size_t length = strlen(n->text);
    if (n->kind != NODE_SCALAR || length == 0)
        return fault_report_at_node(r, n, "%s is not a text; give one line of text",
                                    node_value_to_text_for_message(r, n));
    if (length >= capacity)
        return fault_report_at_node(r, n, "%s is too long; give at most %d characters",
                                    node_value_to_text_for_message(r, n), (int)capacity - 1);
    memset(text, 0, capacity);
    memcpy(text, n->text, length);
    return OK;
}

/* Reads a name of letters, digits, _ and - from YAML node n into name[NAME_MAX_LENGTH]. Returns REFUSED, with a
 * message, for another text. */
static status read_name(struct reader *r, const struct yaml_node *n, char *name)
{
    size_t length = strlen(n->text), fine = 0;
    while (isalnum((unsigned char)n->text[fine]) || n->text[fine] == '_' || n->text[fine] == '-') fine++;
    if (n->kind == NODE_SCALAR && length > 0 && fine == length && n->text[0] != '-')
        return read_any_text(r, n, name, NAME_MAX_LENGTH);
    return fault_report_at_node(r, n, "%s is not a name; use letters, digits, _ and -, and do not begin with -",
                                node_value_to_text_for_message(r, n));
}

/* ---- lists of numbers -------------------------------------------------------------------------------------------- */

/* Names of spaces, by enum space. */
const char *const space_names[] = {"line", "plane stress", "plane strain", "solid"};

const char *reader_get_expected_point_space_as_text(const struct reader *r)
{
    static const char *const shown_as[] = {"space line", "space plane stress", "space plane strain", "space solid"};
    return r->dim == r->scene->dim ? shown_as[r->scene->space] : "the plane of extrude";
}

status read_point_or_vector(struct reader *r, const struct key *k, const struct yaml_node *n, real *point)
{
    int d = 0;
    if (r->dim == 1 && n->kind == NODE_SCALAR) return read_number(r, k, n, point);
    const char *space = reader_get_expected_point_space_as_text(r);
    if (n->kind != NODE_LIST) {
        char example[200], what[256];
        real number;
        const bool plain = n->kind == NODE_SCALAR && strlen(n->text) < 40 && strchr(n->text, ' ') &&
                           number_evaluate_text(r, &number, n->text, k->unit, false, what, sizeof what);
        const char *advice = other_program_value_get_advice(k->path, n->text);
        key_write_example_vector(k, r->dim, plain ? n->text : NULL, example, sizeof example);
        return fault_report_at_node(r, n, "%s is not a list; give %d components in %s, such as %s%s%s",
                                    node_value_to_text_for_message(r, n), r->dim, space, example, advice ? "; " : "",
                                    advice ? advice : "");
    }
    if (n->n != r->dim) return fault_report_at_node(r, n, "has %d components; give %d in %s", n->n, r->dim, space);
    for (const struct yaml_node *c = n->first; c; c = c->next) TRY(read_number(r, k, c, &point[d++]));
    return OK;
}

/* Reads dim x dim numbers, as a list of rows or as one list, from YAML node n into matrix[dim * dim], row by row, in
 * the SI unit of key k (of input files). Returns REFUSED, with a message, for another form. */
static status read_matrix(struct reader *r, const struct key *k, const struct yaml_node *n, real *matrix)
{
    int dim = r->dim, entry = 0;
    if (dim == 1 && n->kind == NODE_SCALAR) return read_number(r, k, n, matrix);
    bool rows = n->kind == NODE_LIST && n->n == dim && n->first->kind == NODE_LIST;
    if (!rows && (n->kind != NODE_LIST || n->n != dim * dim))
        return fault_report_at_node(r, n, "%s is not a matrix; give %d rows of %d numbers",
                                    node_value_to_text_for_message(r, n), dim, dim);
    for (const struct yaml_node *c = n->first; c; c = c->next) {
        TRY(rows ? read_point_or_vector(r, k, c, &matrix[entry]) : read_number(r, k, c, &matrix[entry]));
        entry += rows ? dim : 1;
    }
    return OK;
}

enum { SERIES_MOST = 100000 }; /* largest number of values of a series */

/* Reads a list of ascending numbers from YAML node n, in the SI unit and range of key k (of input files), into
 * *series, which the scene frees. Returns REFUSED, with a message, for another form. */
static status read_series(struct reader *r, const struct key *k, const struct yaml_node *n, struct number_list *series)
{
    TRY(check_node_is_list(r, k, n));
    if (n->n < 1 || n->n > SERIES_MOST)
        return fault_report_at_node(r, n, "has %d items; give 1 to %d", n->n, SERIES_MOST);
    series->value = NEW("scene series", n->n, real);
    for (const struct yaml_node *c = n->first; c; c = c->next) {
        TRY(read_number(r, k, c, &series->value[series->n]));
        if (series->n > 0 && !(series->value[series->n] > series->value[series->n - 1]))
            return fault_report_at_node(r, c,
                                        "%s is not larger than the previous value; give values in ascending order",
                                        node_value_to_text_for_message(r, c));
        series->n++;
    }
    return OK;
}

/* ---- references by name ------------------------------------------------------------------------------------------ */

/* Returns REFUSED with the message that YAML node n names no existing `what`, such as a material, and the most similar
 * name, `nearest`. */
static status fault_reference(struct reader *r, const struct yaml_node *n, const char *what, const char *nearest)
{
    return fault_report_at_node(r, n, "there is no %s %s; did you mean %s?", what, node_value_to_text_for_message(r, n),
                                nearest);
}

/* Stores the index of the material that YAML node n names in *index. Returns REFUSED, with the most similar name in
 * the message, if no material has this name. */
static status scene_value_read_material(struct reader *r, const struct yaml_node *n, int *index)
{
    const struct scene *s = r->scene;
    const struct material *m = s->material;
    int nearest = 0;
    for (int k = 0; k < s->materials; k++) {
        *index = k;
        if (strcmp(m[k].name, n->text) == 0) return OK;
        if (edit_distance(m[k].name, n->text) < edit_distance(m[nearest].name, n->text)) nearest = k;
    }
    return fault_reference(r, n, "material", m[nearest].name);
}

/* Stores the index of the body that YAML node n names in *index. Returns REFUSED if it is rigid or, with the most
 * similar name in the message, if there is no such body. */
static status scene_value_read_body(struct reader *r, const struct yaml_node *n, int *index)
{
    const struct scene *s = r->scene;
    const struct scene_body *b = s->body;
    int nearest = 0;
    for (int k = 0; k < s->bodies; k++) {
        *index = k;
        if (strcmp(b[k].name, n->text) == 0) return OK;
        if (edit_distance(b[k].name, n->text) < edit_distance(b[nearest].name, n->text)) nearest = k;
    }
    for (int k = s->bodies; k < s->bodies + s->rigids; k++)
        if (strcmp(b[k].name, n->text) == 0)
            return fault_report_at_node(
                r, n, "%s is rigid; name a body with particles (rigid bodies have their own velocity, mass and force)",
                node_value_to_text_for_message(r, n));
    return fault_reference(r, n, "body", b[nearest].name);
}

/* ---- groups ------------------------------------------------------------------------------------------------------ */

/* Reads the value of key k (of input files) from YAML node n into group_values, the structure of the group of k, by
 * the type of k. Returns REFUSED, with a message, for an invalid value. */
status read_value_of_key(struct reader *r, const struct key *k, const struct yaml_node *n, void *group_values)
{
    char none[16];
    void *place = k->place ? (char *)group_values + (k->place - 1) : (void *)none;
    switch (k->type) {
    case KEY_REAL:
        return read_number(r, k, n, place);
    case KEY_INT:
        return read_int(r, k, n, place);
    case KEY_SEED:
        return read_seed(r, n, place);
    case KEY_FLAG:
        return read_flag(r, n, place);
    case KEY_CHOICE:
        return read_choice(r, k, n, place);
    case KEY_SET:
        return read_set(r, k, n, place);
    case KEY_SERIES:
        return read_series(r, k, n, place);
    case KEY_NAME:
        return k->words ? read_any_text(r, n, place, LONG_NAME_LENGTH) : read_name(r, n, place);
    case KEY_POINT:
        return k->place ? read_point_or_vector(r, k, n, place) : OK;
    case KEY_MATRIX:
        return read_matrix(r, k, n, place);
    case KEY_REGION:
        return read_region(r, n, place);
    case KEY_BODY:
        return scene_value_read_body(r, n, place);
    case KEY_MATERIAL:
        return scene_value_read_material(r, n, place);
    default:
        return OK;
    }
}

/* Reads the default of key k (of input files) into `base`, the structure of its group. Returns REFUSED, with a message,
 * if k is required and missing; where: YAML node whose location the message names. */
static status read_fallback(struct reader *r, const struct yaml_node *where, const struct key *k, void *base)
{
    struct yaml_node n = {.kind = NODE_SCALAR, .origin = -1, .line = where->line, .column = where->column};
    if (k->type >= KEY_MAP || *k->fallback == '-' || *k->fallback == '(') return OK;
    if (strcmp(k->fallback, "required") == 0) return fault_report_missing_key(r, where, k);
    n.key = (char *)key_get_last_name_of_path(k);
    n.text = (char *)k->fallback;
    return read_value_of_key(r, k, &n, base);
}

status read_keys_of_group(struct reader *r, const struct yaml_node *location_node, const struct yaml_node *mapping,
                          const char *group_path, void *group_values)
{
    if (mapping) TRY(check_node_is_mapping(r, mapping, group_path));
    if (mapping) TRY(check_mapping_keys_known_and_unique(r, mapping, group_path));
    for (int i = 0; i < keys_count; i++) {
        const struct key *k = &keys[i];
        if (!key_is_directly_below(k, group_path)) continue;
        const struct yaml_node *n = yaml_node_find(mapping, key_get_last_name_of_path(k));
        if (k->type == KEY_MAP)
            TRY(read_keys_of_group(r, n ? n : location_node, n, k->path, group_values));
        else if (n)
            TRY(read_value_of_key(r, k, n, group_values));
        else
            TRY(read_fallback(r, location_node, k, group_values));
        if (n && k->has) *((char *)group_values + (k->has - 1)) = true;
    }
    return OK;
}
