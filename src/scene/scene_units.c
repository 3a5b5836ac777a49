/* Reads units of numbers in input files: symbols with prefixes, and products of their powers. Defines the kinds of
 * units that keys expect. Only units that are exact powers of ten are read here (min, h, rad and deg:
 * scene_numbers.c). */
#include "scene_units_internal.h"

#include <ctype.h>
#include <stdio.h>
#include <strings.h>

const struct unit_row unit_rows[UNITS] = {
    [UNIT_NONE] = {"a plain number", "", "0.25", {0, 0, 0}},
    [UNIT_LENGTH] = {"a length", "m", "0.5 mm", {2, 0, 0}},
    [UNIT_AREA] = {"an area", "m^2", "2 mm^2", {4, 0, 0}},
    [UNIT_TIME] = {"a time", "s", "20 us", {0, 0, 2}},
    [UNIT_SPEED] = {"a velocity", "m/s", "22 m/s", {2, 0, -2}},
    [UNIT_DENSITY] = {"a density", "kg/m^3", "7800 kg/m^3", {-6, 2, 0}},
    [UNIT_PRESSURE] = {"a stress", "Pa", "190 GPa", {-2, 2, -4}},
    [UNIT_SURFACE_ENERGY] = {"an energy per area", "J/m^2", "69 kJ/m^2", {0, 2, -4}},
    [UNIT_TOUGHNESS] = {"a stress intensity", "Pa m^0.5", "60 MPa m^0.5", {-1, 2, -4}},
    [UNIT_BODY_FORCE] = {"a force per volume", "N/m^3", "1e5 N/m^3", {-4, 2, -4}},
    [UNIT_RATE] = {"a rate", "1/s", "100 1/s", {0, 0, -2}},
    [UNIT_MASS] = {"a mass", "kg", "1.6 kg", {0, 2, 0}},
    [UNIT_VOLUME] = {"a volume", "m^3", "2 mm^3", {6, 0, 0}},
    [UNIT_FORCE] = {"a force", "N", "20 N", {2, 2, -4}},
    [UNIT_ACCELERATION] = {"an acceleration", "m/s^2", "-9.81 m/s^2", {2, 0, -4}},
    [UNIT_ENERGY] = {"an energy", "J", "2 mJ", {4, 2, -4}},
    [UNIT_ANGLE] = {"an angle", "rad", "30 deg", {0, 0, 0}},
    [UNIT_TEMPERATURE] = {"a temperature in kelvin", "K", "294 K", {0, 0, 0}},
    [UNIT_SPECIFIC_HEAT] = {"a specific heat", "J/(kg K)", "383 J/(kg K)", {4, 0, -4}},
};

/* ---- units ------------------------------------------------------------------------------------------------------- */

static const struct symbol {
    const char *name;
    struct measure measure;
} symbols[] = {
    {"m", {{2, 0, 0}, 0}},    {"g", {{0, 2, 0}, -6}}, {"s", {{0, 0, 2}, 0}},
    {"Pa", {{-2, 2, -4}, 0}}, {"N", {{2, 2, -4}, 0}}, {"J", {{4, 2, -4}, 0}},
    {"Hz", {{0, 0, -2}, 0}},  {"%", {{0, 0, 0}, -4}}, {"1", {{0, 0, 0}, 0}},
};
static const struct prefix {
    const char *name;
    int ten;
} prefixes[] = {
    {"p", -24}, {"n", -18}, {"u", -12}, {"\u00b5", -12}, {"\u03bc", -12}, {"m", -6},
    {"c", -4},  {"k", 6},   {"M", 12},  {"G", 18},       {"T", 24},
};

static const struct symbol *symbol_named(const char *name, size_t length)
{
    for (size_t k = 0; k < COUNT_OF(symbols); k++)
        if (strlen(symbols[k].name) == length && memcmp(symbols[k].name, name, length) == 0) return &symbols[k];
    return NULL;
}

bool unit_symbol_read(struct measure *m, const char *name, size_t length)
{
    const struct symbol *symbol = symbol_named(name, length);
    int ten = 0;
    for (size_t k = 0; k < COUNT_OF(prefixes) && !symbol; k++) {
        size_t prefix = strlen(prefixes[k].name);
        if (prefix >= length || memcmp(prefixes[k].name, name, prefix) != 0) continue;
        symbol = symbol_named(name + prefix, length - prefix);
        if (symbol && !isalpha((unsigned char)symbol->name[0])) symbol = NULL;
        ten = prefixes[k].ten;
    }
    if (!symbol) return false;
    *m = symbol->measure;
    m->ten += ten;
    return true;
}

/* Reads the exponent at *at, which follows the symbol of a unit: `^2`, `2`, `^-1`, `^0.5` or a superscript digit.
 * Advances *at beyond it. Returns twice the exponent; 2 if there is none, 0 if it is malformed. */
static int power_read(const char **at)
{
    const char *c = *at;
    bool caret = *c == '^', minus = false;
    if (strncmp(c, "\u00b2", 2) == 0 || strncmp(c, "\u00b3", 2) == 0) {
        *at = c + 2;
        return (unsigned char)c[1] == 0xB2 ? 4 : 6;
    }
    if (caret) c++;
    if (caret && *c == '-') minus = true, c++;
    if (caret && strncmp(c, "0.5", 3) == 0) {
        *at = c + 3;
        return minus ? -1 : 1;
    }
    if (*c < '1' || *c > '9') return caret ? 0 : 2;
    *at = c + 1;
    return (minus ? -2 : 2) * (*c - '0');
}

size_t unit_symbol_length(const char *c)
{
    size_t n = 0;
    if ((*c == '%' && c[1] == '\0') || (*c == '1' && c[1] == '/')) return 1;
    while (isalpha((unsigned char)c[n]) || (unsigned char)c[n] >= 0xC3 || ((unsigned char)c[n] & 0xC0) == 0x80 ||
           ((unsigned char)c[n] == 0xC2 && (unsigned char)c[n + 1] == 0xB5))
        n++;
    return n;
}

/* Reads one factor of a unit at *at, such as `kg`, `m^3` or `sqrt(m)`, into *m and advances *at beyond it. Returns
 * false if it is malformed, or has a power of ten that is no multiple of 1/2. */
static bool factor_read(struct measure *m, const char **at)
{
    bool root = strncmp(*at, "sqrt(", 5) == 0;
    if (root) *at += 5;
    size_t length = unit_symbol_length(*at);
    if (length == 0 || !unit_symbol_read(m, *at, length)) return false;
    *at += length;
    int twice = **at == '\0' ? 2 : power_read(at);
    if (root && *(*at)++ != ')') return false;
    if (root) twice = twice == 2 ? 1 : 0;
    for (int k = 0; k < 3; k++) m->twice[k] = m->twice[k] * twice / 2;
    if (twice == 0 || m->ten * twice % 2 != 0) return false;
    m->ten = m->ten * twice / 2;
    return true;
}

bool unit_read(struct measure *sum, const char *text)
{
    *sum = (struct measure){{0, 0, 0}, 0};
    if (strlen(text) > UNIT_LONGEST) return false;
    for (const char *c = text; *c;) {
        struct measure m;
        int sign = 1;
        while (*c == ' ') c++;
        if (*c == '/' || (*c == '*' && c != text)) sign = *c == '/' ? -1 : 1, c++;
        while (*c == ' ') c++;
        if (!factor_read(&m, &c)) return false;
        for (int k = 0; k < 3; k++) sum->twice[k] += sign * m.twice[k];
        sum->ten += sign * m.ten;
        if (*c && !strchr(" */", *c)) return false;
    }
    return true;
}

const struct unit_row *unit_table_find_row_by_exponents(const int twice[3])
{
    for (int u = 0; u < UNITS; u++) {
        const signed char *t = unit_rows[u].twice;
        if (t[0] == twice[0] && t[1] == twice[1] && t[2] == twice[2]) return &unit_rows[u];
    }
    return NULL;
}

/* Returns true if the word at c is a unit: a symbol, alone or with 2 or 3 as its exponent. A longer word is no unit,
 * since names of variables can begin with a symbol. */
static bool is_unit_word(const char *c)
{
    if (strncmp(c, "sqrt(", 5) == 0) c += 5;
    c += unit_symbol_length(c);
    if (*c == '2' || *c == '3') c++;
    return !isalnum((unsigned char)*c) && *c != '_';
}

size_t unit_read_at_start_of_text(struct measure *sum, const char *text)
{
    const char *end = text;
    *sum = (struct measure){{0, 0, 0}, 0};
    if (*text == '%') return unit_symbol_read(sum, text, 1) ? 1 : 0;
    for (const char *c = text; c - text <= UNIT_LONGEST;) {
        struct measure m;
        const char *sign = c;
        while (*c == ' ') c++;
        if (end != text && (*c == '/' || *c == '*')) sign = c++;
        while (*c == ' ') c++;
        if (!is_unit_word(c) || !factor_read(&m, &c)) break;
        for (int k = 0; k < 3; k++) sum->twice[k] += *sign == '/' ? -m.twice[k] : m.twice[k];
        sum->ten += *sign == '/' ? -m.ten : m.ten;
        end = c;
    }
    return (size_t)(end - text);
}

bool unit_correct_letter_case_of_symbols(const char *text, char *out, size_t capacity)
{
    struct measure m;
    snprintf(out, capacity, "%s", text);
    for (char *c = out; *c; c += *c != '\0') {
        char word[16];
        const size_t length = unit_symbol_length(c);
        bool found = length == 0;
        for (size_t s = 0; s < COUNT_OF(symbols) && !found; s++)
            for (size_t p = 0; p <= COUNT_OF(prefixes) && !found; p++) {
                /* MPa for mpa, but mm for MM: large prefixes first where the symbol is a capital letter */
                const size_t q = isupper((unsigned char)*symbols[s].name) ? COUNT_OF(prefixes) - p : p;
                snprintf(word, sizeof word, "%s%s", q ? prefixes[q - 1].name : "", symbols[s].name);
                found = strlen(word) == length && strncasecmp(word, c, length) == 0;
            }
        if (found && length > 0) memcpy(c, word, length);
        c += length;
    }
    return strcmp(out, text) != 0 && unit_read(&m, out);
}

void unit_exponents_describe_kind_of_unit(const int doubled_exponents[3], char *text, size_t capacity)
{
    static const char *const symbol[] = {"m", "kg", "s"};
    const struct unit_row *row = unit_table_find_row_by_exponents(doubled_exponents);
    size_t used = (size_t)snprintf(text, capacity, "%s", row ? row->name : "in");
    for (int k = 0; k < 3 && !row; k++)
        if (doubled_exponents[k] && used < capacity)
            used += (size_t)snprintf(text + used, capacity - used, " %s^%g", symbol[k], doubled_exponents[k] / 2.0);
}

void unit_exponents_write_as_text(const int doubled_exponents[3], char *text, size_t capacity)
{
    static const char *const symbol[] = {"m", "kg", "s"};
    size_t used = 0;
    *text = '\0';
    for (int k = 0; k < 3; k++) {
        const int whole = doubled_exponents[k] / 2, sign = whole < 0 ? -1 : 1;
        for (int left = whole * sign; left > 0 && used < capacity; left -= 9)
            used += (size_t)snprintf(text + used, capacity - used, " %s^%d", symbol[k], sign * (left < 9 ? left : 9));
        if (doubled_exponents[k] % 2 && used < capacity)
            used += (size_t)snprintf(text + used, capacity - used, " %s^%s0.5", symbol[k],
                                     doubled_exponents[k] < 0 ? "-" : "");
    }
}

/* ---- cleave help units ------------------------------------------------------------------------------------------- */

/* Prints the page `cleave help units`, the units that numbers in scenes may have, to `out`. */
void scene_print_allowed_units(FILE *out)
{
    fputs(
        "A number without a unit is SI. A unit follows it, with or without a blank: 0.5 mm, 190GPa, 1/3.\n\nsymbols   ",
        out);
    for (size_t k = 0; k < COUNT_OF(symbols); k++)
        if (strcmp(symbols[k].name, "1") != 0) fprintf(out, " %s", symbols[k].name);
    fputs("; times also min, h; angles deg, rad\nprefixes  ", out);
    for (size_t k = 0; k < COUNT_OF(prefixes); k++)
        fprintf(out, " %s 1e%d%s", prefixes[k].name, prefixes[k].ten / 2, k + 1 < COUNT_OF(prefixes) ? "," : "\n");
    fputs("powers     m^2, m2, m\u00b2, m^0.5, sqrt(m), s^-1; between factors a blank, * or /: N/m^2, MPa m^0.5\n\n"
          "quantity              SI unit     as\n",
          out);
    for (int u = 0; u < UNITS; u++)
        fprintf(out, "%-21s %-11s %s\n", unit_rows[u].name, *unit_rows[u].symbol ? unit_rows[u].symbol : "1",
                unit_rows[u].example);
}
