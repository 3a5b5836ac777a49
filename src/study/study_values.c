/* Parses the values that a key takes in a study from the text after `-s`. */
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "study/study.h"

/* VALUES_MOST: largest number of values of a key in a study. VALUE_LONGEST: length of the longest value
 * [characters]. */
enum { VALUES_MOST = 10000, VALUE_LONGEST = 1000 };

double value_text_split_number_and_unit(const char *value, const char **unit)
{
    char *end;
    const double number = strtod(value, &end);
    if (end == value || !isfinite(number)) {
        *unit = value;
        return NAN;
    }
    while (*end == ' ') end++;
    *unit = end;
    return number;
}

/* ---- pieces of a list -------------------------------------------------------------------------------------------- */

/* Returns a pointer to the first character `mark` in the text that begins at `at`, outside brackets and quotes, or to
 * the end of the text if there is none. */
static const char *value_end(const char *at, char mark)
{
    int depth = 0;
    char quote = '\0';
    for (; *at; at++) {
        if (quote) {
            if (*at == quote) quote = '\0';
        } else if (*at == mark && depth == 0)
            return at;
        else if (*at == '"' || *at == '\'')
            quote = *at;
        else if (strchr("[{(", *at))
            depth++;
        else if (strchr("]})", *at) && depth > 0)
            depth--;
    }
    return at;
}

/* Returns a copy of the characters from `from` to before `to`, without blanks at both ends. The caller releases it with
 * memory_free. */
static char *trimmed(const char *from, const char *to)
{
    while (from < to && isspace((unsigned char)*from)) from++;
    while (to > from && isspace((unsigned char)to[-1])) to--;
    char *copy = NEW("study.value", to - from + 1, char);
    array_copy(copy, from, to - from, 1);
    return copy;
}

static status value_add(struct varied_key *k, char *value)
{
    const char *fault = !*value                         ? "a value is missing; write key=value,value,..."
                        : k->values == VALUES_MOST      ? "the list has more than 10000 values; give fewer"
                        : strlen(value) > VALUE_LONGEST ? "a value has more than 1000 characters; shorten it"
                                                        : NULL;
    for (int v = 0; v < k->values && !fault; v++)
        if (strcmp(k->value[v], value) == 0) fault = "a value is given twice; remove one";
    if (fault) {
        const status s = status_set(REFUSED, "-s %s: %s", k->key, fault);
        memory_free(value);
        return s;
    }
    GROW("study.values", k->value, k->values + 1);
    k->value[k->values++] = value;
    return OK;
}

/* ---- ranges of numbers ------------------------------------------------------------------------------------------- */

/* A range from:to:step of numbers, and their common unit ("" if they have none). */
struct row {
    double number[3];
    char unit[32];
};

/* Reads a range FROM:TO:STEP, such as 10:30:5 mm, from `text` into *r. Returns false if the text has another form. *s:
 * receives REFUSED, with a message, if the text is a range but its units differ, if the step is no number, or if no
 * whole number of steps leads from the first number to the last; else OK. k: key of the range, for messages. */
static bool row_read(struct row *r, const struct varied_key *k, const char *text, status *s)
{
    *r = (struct row){.unit = ""};
    *s = OK;
    const char *at = text;
    for (int part = 0; part < 3; part++) {
        const char *end = value_end(at, ':'), *unit;
        if ((*end == '\0') != (part == 2)) return false;
        char *piece = trimmed(at, end);
        r->number[part] = value_text_split_number_and_unit(piece, &unit);
        const bool fits = !isnan(r->number[part]) && strlen(unit) < sizeof r->unit;
        const bool other = fits && *unit && *r->unit && strcmp(unit, r->unit) != 0;
        if (fits && *unit && !other) strcpy(r->unit, unit);
        memory_free(piece);
        if (!fits && part < 2) return false;
        if (!fits)
            *s = status_set(REFUSED,
                            "-s %s: %s: give a range as from:to:step with a number as step, or other values as a list",
                            k->key, text);
        if (other) *s = status_set(REFUSED, "-s %s: %s: use one unit, such as 10:30:5 mm", k->key, text);
        at = end + 1;
    }
    const double steps = (r->number[1] - r->number[0]) / r->number[2];
    if (*s == OK && !(steps >= 0 && steps < VALUES_MOST))
        *s = status_set(REFUSED,
                        "-s %s: %s: give a range as from:to:step, whose step leads from the first value to the second "
                        "one in fewer than %d steps",
                        k->key, text, VALUES_MOST);
    return true;
}

static status values_add_row(struct varied_key *k, const struct row *r)
{
    const double whole = 1e-9; /* tolerance in steps with which `to` is reached in spite of rounding */
    const int steps = (int)floor((r->number[1] - r->number[0]) / r->number[2] + whole);
    for (int v = 0; v <= steps; v++) {
        char *value = NEW("study.value", 64, char);
        snprintf(value, 64, "%.10g%s%s", r->number[0] + v * r->number[2], *r->unit ? " " : "", r->unit);
        TRY(value_add(k, value));
    }
    return OK;
}

/* ---- all --------------------------------------------------------------------------------------------------------- */

/* Reads a list of values and ranges of the key k, separated by commas, from `text`, and appends the values to k->value.
 * Returns REFUSED, with a message, if a value is missing or occurs twice, or a range is faulty. */
static status values_read(struct varied_key *k, const char *text)
{
    for (const char *at = text;;) {
        const char *end = value_end(at, ',');
        char *piece = trimmed(at, end);
        struct row row;
        status s;
        if (row_read(&row, k, piece, &s)) {
            memory_free(piece);
            if (s == OK) s = values_add_row(k, &row);
        } else
            s = value_add(k, piece);
        TRY(s);
        if (!*end) return OK;
        at = end + 1;
    }
}

/* Rewrites a key in place such that list indices follow a point: `a[1].b` becomes `a.1.b`. */
static void key_unify(char *key)
{
    char *to = key;
    for (const char *from = key; *from; from++)
        if (*from != ']') *to++ = *from == '[' ? '.' : *from;
    *to = '\0';
}

status varied_key_parse_name_and_values(struct varied_key *k, const char *text)
{
    const char *equals = strchr(text, '=');
    *k = (struct varied_key){0};
    if (!equals || equals == text)
        return status_set(REFUSED, "-s %s: give a key and its values, such as -s particles.spacing=1mm,0.5mm", text);
    k->key = trimmed(text, equals);
    key_unify(k->key);
    const status s = values_read(k, equals + 1);
    if (s != OK) varied_key_free(k);
    return s;
}

void varied_key_free(struct varied_key *k)
{
    for (int v = 0; v < k->values; v++) memory_free(k->value[v]);
    memory_free(k->value);
    memory_free(k->key);
    *k = (struct varied_key){0};
}
