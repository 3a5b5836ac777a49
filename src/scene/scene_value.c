/* Reads values from nodes by the table of keys, and writes the messages about faults. */
#include "scene_parts.h"

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

enum { SHOWN_LONGEST = 40 };

/* ---- messages ---------------------------------------------------------------------------------------------------- */

const char *text_for_message(struct reader *r, const char *text)
{
    size_t length = strlen(text), cut = length;
    if (cut > SHOWN_LONGEST) cut = SHOWN_LONGEST;
    while (cut < length && cut > 0 && ((unsigned char)text[cut] & 0xC0) == 0x80)
        cut--; /* keep whole UTF-8 characters */
    char *copy = arena_new(r, cut + 4);
    memcpy(copy, text, cut);
    text_replace_control_characters(copy);
    if (cut < length) memcpy(copy + cut, "...", 3);
    return copy;
}

const char *node_text(struct reader *r, const struct yaml_node *n)
{
    if (n->kind == NODE_LIST) return "a list";
    if (n->kind == NODE_MAP) return "a mapping";
    return *n->text ? text_for_message(r, n->text) : "no value";
}

/* Writes the name of node n for messages to name[capacity]: its key, or that of its list as in `velocity[1]`. */
static void node_name(const struct yaml_node *n, char *name, size_t capacity)
{
    if (n->key) {
        snprintf(name, capacity, "%.48s", n->key);
    } else if (n->parent) {
        int place = 0;
        for (const struct yaml_node *c = n->parent->first; c != n; c = c->next) place++;
        node_name(n->parent, name, capacity);
        size_t used = strlen(name);
        snprintf(name + used, capacity - used, "[%d]", place);
    } else {
        *name = '\0';
    }
}

void location_write_text(const struct reader *r, int origin_index, int line, int column, char *text, size_t capacity)
{
    if (origin_index < 0) {
        snprintf(text, capacity, "%.300s:%d:%d", origin_file_name(r, origin_index), line, column);
        return;
    }
    snprintf(text, capacity, "-s %.100s=%.100s", r->override[origin_index].key, r->override[origin_index].value);
}

status fault_at_location(const struct reader *r, int origin_index, int line, int column, const char *format, ...)
{
    char what[512], place[400];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    location_write_text(r, origin_index, line, column, place, sizeof place);
    return status_set(REFUSED, "%s: %s", place, what);
}

void fault_write_location_of_node(const struct reader *r, const struct yaml_node *node, char *text, size_t capacity)
{
    char name[100];
    node_name(node, name, sizeof name);
    location_write_text(r, node->origin, node->line, node->column, text, capacity);
    snprintf(text + strlen(text), capacity - strlen(text), ": %s%s", name, *name ? ": " : "");
}

status fault(const struct reader *r, const struct yaml_node *at, const char *format, ...)
{
    char what[512], place[PLACE_LENGTH];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    fault_write_location_of_node(r, at, place, sizeof place);
    return status_set(REFUSED, "%s%s", place, what);
}

status fault_report_exclusive_keys(const struct reader *r, const struct yaml_node *one, const struct yaml_node *other)
{
    const struct yaml_node *late = one->origin > other->origin ? one : other;
    return fault(r, late, "given beside %s; keep one of the two", late == one ? other->key : one->key);
}

/* Returns, for a message, what values key k expects. The text is static or in the reader's arena. */
static const char *form_text(struct reader *r, const struct key *k)
{
    switch (k->type) {
    case KEY_REAL:
        return unit_rows[k->unit].name;
    case KEY_POINT:
        return "a list of numbers";
    case KEY_REGION:
        return "a solid or a list of solids";
    case KEY_NAME:
        return "a name";
    case KEY_MATERIAL:
        return "the name of a material";
    default:
        return k->words ? words_for_message(r, k->words) : "a mapping of keys";
    }
}

status fault_report_missing_key(struct reader *r, const struct yaml_node *map, const struct key *k)
{
    const char *leaf = key_last_part(k), *example = k->type == KEY_REAL ? unit_rows[k->unit].example : "";
    const int group = leaf > k->path ? (int)(leaf - k->path) - 1 : 0; /* length of the path before the last dot */
    return fault_at_location(r, map->origin, map->line, map->column, "%s: missing%s%.*s; %s is expected%s%s", leaf,
                             group > 0 ? " in " : "", group, k->path, form_text(r, k), *example ? ", as " : "",
                             example);
}

const char *words_for_message(struct reader *r, const char *words)
{
    int left = 1;
    for (const char *c = words; *c; c++) left += *c == '|';
    char *text = arena_new(r, strlen(words) + 4 * (size_t)left + 1), *to = text;
    for (const char *c = words; *c; c++) {
        if (*c != '|') {
            *to++ = *c;
            continue;
        }
        left--;
        to = stpcpy(to, left == 1 ? " or " : ", ");
    }
    return text;
}

/* ---- keys -------------------------------------------------------------------------------------------------------- */

static status fault_unknown(const struct reader *r, const struct yaml_node *n, const char *group)
{
    char instead[400];
    if (foreign_word_advice(n->key, group, instead, sizeof instead)) return fault(r, n, "unknown key; %s", instead);
    const struct key *nearest = key_find_most_similar(group, n->key);
    const char *leaf = nearest ? key_last_part(nearest) : "";
    if (nearest && words_are_similar(leaf, n->key)) return fault(r, n, "unknown key; the nearest is %s", leaf);
    int others;
    const struct key *other = key_find_in_any_group(n->key, &others);
    if (other && !strchr(other->path, '.'))
        return fault(r, n, "does not belong here; %s is a key of its own, at the left margin", n->key);
    if (others == 1) return fault(r, n, "does not belong here; it is the key %s", other->path);
    if (others > 1)
        return fault(r, n, "does not belong here; `cleave help %s` lists the %d keys of that name", n->key, others);
    return fault(r, n, "unknown key; `cleave help%s%s` lists what is known", *group ? " " : "", group);
}

/* Returns REFUSED if a key of the mapping `mapping` is unknown in the group with this path, or is given twice. */
status check_keys_known(struct reader *r, const struct yaml_node *mapping, const char *group_path)
{
    for (const struct yaml_node *n = mapping->first; n; n = n->next) {
        const struct key *k = key_find(group_path, n->key);
        if (!k) return fault_unknown(r, n, group_path);
        for (const struct yaml_node *twin = mapping->first; twin != n; twin = twin->next)
            if (strcmp(twin->key, n->key) == 0)
                return fault(r, n, "given twice, first in line %d; keep one", twin->line);
    }
    return OK;
}

status expect_node_kind(struct reader *r, const struct yaml_node *n, enum node_kind kind, const char *expected)
{
    const bool top = n->key && n->parent && !n->parent->key;
    const char *advice = top ? foreign_value_advice(n->key, n->text) : NULL;
    if (n->kind == kind) return OK;
    return fault(r, n, "%s is not %s%s%s", node_text(r, n), expected, advice ? "; " : "", advice ? advice : "");
}

status expect_list_of_valid_length(struct reader *r, const struct key *k, const struct yaml_node *n)
{
    int least = (int)k->range.least, most = (int)k->range.most;
    TRY(expect_node_kind(r, n, NODE_LIST, "a list"));
    if (n->n >= least && n->n <= most) return OK;
    return fault(r, n, "has %d items; %d to %d are expected", n->n, least, most);
}

/* ---- scalars ----------------------------------------------------------------------------------------------------- */

/* Returns REFUSED, with the expected range, if `value` [SI], read from node n, is outside the range of key k. */
static status check_range(struct reader *r, const struct key *k, const struct yaml_node *n, real value)
{
    const struct range *range = &k->range;
    char least[32], most[32];
    if (!range->given) return OK;
    bool low = range->open ? !(value > range->least) : !(value >= range->least);
    if (!low && value <= range->most) return OK;
    if (low && k->low) return fault(r, n, "%s %s", node_text(r, n), k->low);
    const struct unit_row *unit = &unit_rows[k->unit];
    const char *name = k->type == KEY_INT ? "a whole number" : unit->name;
    bool bounded = isfinite(range->most);
    const char *advice = foreign_value_advice(k->path, n->text);
    return fault(r, n, "%s is out of range; %s %s %s%s%s is expected%s%s%s%s", node_text(r, n), name,
                 range->open ? "above" : "from", number_write_shortest(least, range->least),
                 bounded       ? (range->open ? " up to " : " to ")
                 : range->open ? ""
                               : " on",
                 bounded ? number_write_shortest(most, range->most) : "", k->unit ? ", as " : "",
                 k->unit ? unit->example : "", advice ? "; " : "", advice ? advice : "");
}

status read_number(struct reader *r, const struct key *k, const struct yaml_node *n, real *value)
{
    char what[256];
    if (n->kind != NODE_SCALAR)
        return fault(r, n, "%s is not a number; %s is expected, as %s", node_text(r, n), unit_rows[k->unit].name,
                     unit_rows[k->unit].example);
    if (k->type == KEY_REAL && k->words && strcmp(n->text, k->words) == 0) {
        *value = k->word_value;
        return OK;
    }
    bool infinite = k->infinite && !(k->type == KEY_POINT && r->bounded);
    if (!number_evaluate_text(r, value, n->text, k->unit, infinite, what, sizeof what)) {
        advise_length_in_spacings(r, k, n->text, what, sizeof what);
        return fault(r, n, "%s %s", node_text(r, n), what);
    }
    return check_range(r, k, n, *value);
}

/* Reads an expression from node n into *value. Returns REFUSED unless it is a whole number to a relative 1e-9. */
static status read_whole(struct reader *r, const struct yaml_node *n, real *value)
{
    char what[256];
    real number;
    if (!number_evaluate_text(r, &number, n->text, UNIT_NONE, false, what, sizeof what))
        return fault(r, n, "%s %s", node_text(r, n), what);
    *value = round(number);
    if (fabs(number - *value) <= 1e-9 * (1 + fabs(number))) return OK;
    return fault(r, n, "%s is %g; a whole number is expected", node_text(r, n), number);
}

/* Reads a whole number from node n into *value. Returns REFUSED for other texts and outside the range of key k. */
static status read_int(struct reader *r, const struct key *k, const struct yaml_node *n, int *value)
{
    const char *c = n->text + (*n->text == '-');
    if (n->kind == NODE_SCALAR && (strchr(n->text, '/') || looks_like_expression(r, n->text))) {
        real whole;
        TRY(read_whole(r, n, &whole));
        *value = (int)real_max(INT32_MIN, real_min(INT32_MAX, whole));
        return check_range(r, k, n, whole);
    }
    size_t digits = strspn(c, "0123456789");
    if (n->kind != NODE_SCALAR || digits == 0 || c[digits] != '\0' || (*c == '0' && digits > 1))
        return fault(r, n, "%s is not a whole number; digits alone are expected, as 20", node_text(r, n));
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
    if (n->kind == NODE_SCALAR && looks_like_expression(r, n->text)) TRY(read_whole(r, n, &whole));
    errno = 0;
    if (whole >= 0 && whole < 9e15)
        *value = (uint64_t)whole;
    else if (n->kind == NODE_SCALAR && digits > 0 && n->text[digits] == '\0')
        *value = strtoull(n->text, NULL, 10);
    else
        errno = EINVAL;
    if (errno == 0) return OK;
    return fault(r, n, "%s is no seed; a whole number from 0 to 18446744073709551615 is expected", node_text(r, n));
}

static status read_flag(struct reader *r, const struct yaml_node *n, bool *value)
{
    int word = n->kind == NODE_SCALAR ? word_index_in_list("false|true", n->text) : -1;
    if (word < 0) return fault(r, n, "%s is neither true nor false; write true or false", node_text(r, n));
    *value = word == 1;
    return OK;
}

static status read_choice(struct reader *r, const struct key *k, const struct yaml_node *n, void *place)
{
    const char *words = words_for_message(r, k->words);
    int word = n->kind == NODE_SCALAR ? word_index_in_list(k->words, n->text) : -1;
    const char *advice = foreign_value_advice(k->path, n->text);
    if (word < 0)
        return fault(r, n, "%s is unknown; %s is expected%s%s", node_text(r, n), words, advice ? "; " : "",
                     advice ? advice : "");
    if (k->size == sizeof(int)) memcpy(place, &word, sizeof word);
    if (k->size == 1) *(bool *)place = word == 1;
    return OK;
}

/* Returns the word of a|b|c nearest to `text` by edit distance, in the reader's arena; NULL: none is similar. */
static const char *word_near(struct reader *r, const char *words, const char *text)
{
    const char *nearest = NULL;
    int least = (int)strlen(text) / 3 + 2;
    for (const char *c = words; c; c = strchr(c, '|') ? strchr(c, '|') + 1 : NULL) {
        const char *word = arena_copy_text(r, c, strcspn(c, "|"));
        const int distance = edit_distance(word, text);
        if (distance < least) nearest = word, least = distance;
    }
    return nearest;
}

/* Reads words of key k, `none` or `all` from node n into *bits, one bit per word. Returns REFUSED for other texts. */
static status read_set(struct reader *r, const struct key *k, const struct yaml_node *n, unsigned *bits)
{
    const char *words = words_for_message(r, k->words);
    *bits = 0;
    if (n->kind == NODE_SCALAR && strcmp(n->text, "none") == 0) return OK;
    for (const char *c = k->words; c && n->kind == NODE_SCALAR && strcmp(n->text, "all") == 0; c = strchr(c + 1, '|'))
        *bits = *bits << 1 | 1;
    if (*bits) return OK;
    if (n->kind != NODE_LIST || n->n == 0)
        return fault(r, n, "%s is unknown; none, all or a list of %s is expected", node_text(r, n), words);
    for (const struct yaml_node *c = n->first; c; c = c->next) {
        int word = c->kind == NODE_SCALAR ? word_index_in_list(k->words, c->text) : -1;
        if (word < 0) {
            const char *near = word_near(r, k->words, c->text);
            return fault(r, c, "%s is unknown%s%s; %s is expected", node_text(r, c), near ? "; the nearest is " : "",
                         near ? near : "", words);
        }
        *bits |= 1u << word;
    }
    return OK;
}

/* Reads any text from node n into name[NAME_MAX_LENGTH]. Returns REFUSED if it is empty or too long. */
static status read_any_text(struct reader *r, const struct yaml_node *n, char *name)
{
    const size_t length = strlen(n->text);
    if (n->kind != NODE_SCALAR || length == 0) return fault(r, n, "%s is no text", node_text(r, n));
    if (length >= NAME_MAX_LENGTH)
        return fault(r, n, "%s is too long; at most %d characters are expected", node_text(r, n), NAME_MAX_LENGTH - 1);
    memset(name, 0, NAME_MAX_LENGTH);
    memcpy(name, n->text, length);
    return OK;
}

/* Reads letters, digits, _ and - from node n into name[NAME_MAX_LENGTH]. Returns REFUSED for another text. */
static status read_name(struct reader *r, const struct yaml_node *n, char *name)
{
    size_t length = strlen(n->text), fine = 0;
    while (isalnum((unsigned char)n->text[fine]) || n->text[fine] == '_' || n->text[fine] == '-') fine++;
    if (n->kind == NODE_SCALAR && length > 0 && fine == length && n->text[0] != '-') return read_any_text(r, n, name);
    return fault(r, n, "%s is no name; letters, digits, _ and - are expected, and no - first", node_text(r, n));
}

/* ---- lists of numbers -------------------------------------------------------------------------------------------- */

const char *const space_names[] = {"line", "plane stress", "plane strain", "solid"};

const char *space_name_for_message(const struct reader *r)
{
    static const char *const shown_as[] = {"space line", "space plane stress", "space plane strain", "space solid"};
    return r->dim == r->scene->dim ? shown_as[r->scene->space] : "the plane of extrude";
}

status read_point(struct reader *r, const struct key *k, const struct yaml_node *n, real *point)
{
    int d = 0;
    if (r->dim == 1 && n->kind == NODE_SCALAR) return read_number(r, k, n, point);
    const char *space = space_name_for_message(r);
    if (n->kind != NODE_LIST)
        return fault(r, n, "%s is not a list; %d components are expected in %s", node_text(r, n), r->dim, space);
    if (n->n != r->dim) return fault(r, n, "has %d components; %d are expected in %s", n->n, r->dim, space);
    for (const struct yaml_node *c = n->first; c; c = c->next) TRY(read_number(r, k, c, &point[d++]));
    return OK;
}

/* Reads dim x dim numbers, by rows or in one list, from node n into matrix[dim * dim] in the unit of key k. */
static status read_matrix(struct reader *r, const struct key *k, const struct yaml_node *n, real *matrix)
{
    int dim = r->dim, entry = 0;
    if (dim == 1 && n->kind == NODE_SCALAR) return read_number(r, k, n, matrix);
    bool rows = n->kind == NODE_LIST && n->n == dim && n->first->kind == NODE_LIST;
    if (!rows && (n->kind != NODE_LIST || n->n != dim * dim))
        return fault(r, n, "%s is not a matrix; %d rows of %d numbers are expected", node_text(r, n), dim, dim);
    for (const struct yaml_node *c = n->first; c; c = c->next) {
        TRY(rows ? read_point(r, k, c, &matrix[entry]) : read_number(r, k, c, &matrix[entry]));
        entry += rows ? dim : 1;
    }
    return OK;
}

enum { SERIES_MOST = 100000 };

/* Reads a list of ascending numbers from node n in the unit and range of key k. Returns REFUSED for another form. */
static status read_series(struct reader *r, const struct key *k, const struct yaml_node *n, struct number_list *series)
{
    TRY(expect_node_kind(r, n, NODE_LIST, "a list"));
    if (n->n < 1 || n->n > SERIES_MOST) return fault(r, n, "has %d items; 1 to %d are expected", n->n, SERIES_MOST);
    series->value = NEW("scene series", n->n, real);
    for (const struct yaml_node *c = n->first; c; c = c->next) {
        TRY(read_number(r, k, c, &series->value[series->n]));
        if (series->n > 0 && !(series->value[series->n] > series->value[series->n - 1]))
            return fault(r, c, "%s is not larger than the previous value; values in ascending order are expected",
                         node_text(r, c));
        series->n++;
    }
    return OK;
}

/* ---- references by name ------------------------------------------------------------------------------------------ */

static status fault_reference(struct reader *r, const struct yaml_node *n, const char *what, const char *nearest)
{
    return fault(r, n, "there is no %s %s; the nearest is %s", what, node_text(r, n), nearest);
}

/* Sets *index to the material that node n names. Returns REFUSED, with the nearest name, if there is none. */
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

/* Sets *index to the body that node n names. Returns REFUSED for a rigid body and, with the nearest name, for none. */
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
            return fault(r, n,
                         "%s is rigid; a body with particles is expected (rigid ones have a velocity, a mass "
                         "and a force of their own)",
                         node_text(r, n));
    return fault_reference(r, n, "body", b[nearest].name);
}

/* ---- groups ------------------------------------------------------------------------------------------------------ */

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
        return k->words ? read_any_text(r, n, place) : read_name(r, n, place);
    case KEY_POINT:
        return k->place ? read_point(r, k, n, place) : OK;
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

/* Reads the default of key k into `base`, the structure of its group. Returns REFUSED at `where` if k is required. */
static status read_fallback(struct reader *r, const struct yaml_node *where, const struct key *k, void *base)
{
    struct yaml_node n = {.kind = NODE_SCALAR, .origin = -1, .line = where->line, .column = where->column};
    if (k->type >= KEY_MAP || *k->fallback == '-' || *k->fallback == '(') return OK;
    if (strcmp(k->fallback, "required") == 0) return fault_report_missing_key(r, where, k);
    n.key = (char *)key_last_part(k);
    n.text = (char *)k->fallback;
    return read_value_of_key(r, k, &n, base);
}

status read_keys_of_group(struct reader *r, const struct yaml_node *location_node, const struct yaml_node *mapping,
                          const char *group_path, void *group_values)
{
    if (mapping) TRY(expect_node_kind(r, mapping, NODE_MAP, "a mapping of keys to values"));
    if (mapping) TRY(check_keys_known(r, mapping, group_path));
    for (int i = 0; i < keys_count; i++) {
        const struct key *k = &keys[i];
        if (!key_is_directly_below(k, group_path)) continue;
        const struct yaml_node *n = yaml_node_find(mapping, key_last_part(k));
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
