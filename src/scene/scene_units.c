/* Reads numbers with units by a grammar of its own: no octal numbers, no dependence on the locale, and only units that
 * are exact powers of ten (except min and h). */
#include "scene_internal.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <strings.h>

enum { NUMBER_LONGEST = 60, UNIT_LONGEST = 40 };

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

/* A unit: twice the exponents of m, kg and s, and twice the power of ten of its factor to SI. */
struct measure {
    int twice[3], ten;
};

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

/* Reads the symbol `name` of `length` characters, such as mm or %, into *m. Returns false if it is unknown. */
static bool symbol_read(struct measure *m, const char *name, size_t length)
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

static size_t symbol_length(const char *c)
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
    size_t length = symbol_length(*at);
    if (length == 0 || !symbol_read(m, *at, length)) return false;
    *at += length;
    int twice = **at == '\0' ? 2 : power_read(at);
    if (root && *(*at)++ != ')') return false;
    if (root) twice = twice == 2 ? 1 : 0;
    for (int k = 0; k < 3; k++) m->twice[k] = m->twice[k] * twice / 2;
    if (twice == 0 || m->ten * twice % 2 != 0) return false;
    m->ten = m->ten * twice / 2;
    return true;
}

/* Reads a product of factors separated by blanks, `*` or `/` from `text` into *sum. Returns false if it is no unit. */
static bool unit_read(struct measure *sum, const char *text)
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

static const struct unit_row *unit_of(const int twice[3])
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
    c += symbol_length(c);
    if (*c == '2' || *c == '3') c++;
    return !isalnum((unsigned char)*c) && *c != '_';
}

/* Returns the length of the unit at the beginning of a text, and stores the unit in *sum. The unit is the longest
 * product of factors separated by spaces, `*` or `/`. Returns 0 if there is none. */
static size_t unit_length(struct measure *sum, const char *text)
{
    const char *end = text;
    *sum = (struct measure){{0, 0, 0}, 0};
    if (*text == '%') return symbol_read(sum, text, 1) ? 1 : 0;
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

void unit_exponents_describe_kind_of_unit(const int doubled_exponents[3], char *text, size_t capacity)
{
    static const char *const symbol[] = {"m", "kg", "s"};
    const struct unit_row *row = unit_of(doubled_exponents);
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

/* ---- numbers ----------------------------------------------------------------------------------------------------- */

/* Returns the length of `[+-] digits [. digits] [e [+-] digits]` at the beginning of c; 0 without a number. */
static size_t number_length(const char *c)
{
    const char *start = c;
    size_t digits = 0;
    if (*c == '+' || *c == '-') c++;
    while (isdigit((unsigned char)*c)) c++, digits++;
    if (*c == '.') c++;
    while (isdigit((unsigned char)*c)) c++, digits++;
    if (digits == 0) return 0;
    const char *e = c;
    if (*e == 'e' || *e == 'E') {
        e++;
        if (*e == '+' || *e == '-') e++;
        if (isdigit((unsigned char)*e)) {
            while (isdigit((unsigned char)*e)) e++;
            c = e;
        }
    }
    return (size_t)(c - start);
}

/* Returns the number in c[length] times 10^(twice_ten/2), its unit's factor to SI, rounded once for even twice_ten. */
static real number_value(const char *c, size_t length, int twice_ten)
{
    const int half = twice_ten % 2 != 0, ten = (twice_ten - half) / 2; /* an odd one is half a power more */
    char text[NUMBER_LONGEST + 32];
    size_t mantissa = strcspn(c, "eE");
    long exponent = 0;
    if (mantissa > length) mantissa = length;
    if (mantissa < length) exponent = strtol(c + mantissa + 1, NULL, 10);
    if (exponent > 100000) exponent = 100000;
    if (exponent < -100000) exponent = -100000;
    snprintf(text, sizeof text, "%.*se%ld", (int)mantissa, c, exponent + ten);
    return half ? sqrt(10) * strtod(text, NULL) : strtod(text, NULL);
}

/* Returns a message (static text) if the number at c has a notation that input files do not have (grouped digits,
 * decimal comma, base 60, hexadecimal, octal), else NULL. length: characters at c that were read as a number. */
static const char *trap(const char *c, size_t length)
{
    const char *digits = c + (*c == '+' || *c == '-');
    const char *rest = c + length;
    if (*rest == '_') return "digits cannot be grouped by _; write 1000 or 1e3";
    if (*rest == ',') return "the decimal sign is a point; write "; /* then the number */
    if (*rest == ':') return "numbers with colons (base 60) are not read; write a decimal number";
    if ((*rest == 'x' || *rest == 'X' || *rest == 'o' || *rest == 'b') && length <= 2 && *digits == '0')
        return "hexadecimal, octal and binary numbers are not read; write a decimal number";
    if (digits[0] == '0' && isdigit((unsigned char)digits[1]))
        return "a leading 0 means octal elsewhere; write the decimal number without it";
    return NULL;
}

struct complaint {
    char *what; /* [room] receives a message */
    size_t room;
};

/* Writes the message `wrong`, the name of the expected unit and an example to c.what[c.room]. Returns false. */
static bool complain(struct complaint c, const char *wrong, enum unit unit)
{
    snprintf(c.what, c.room, "%s; give %s, such as %s", wrong, unit_rows[unit].name, unit_rows[unit].example);
    return false;
}

/* Writes a misspelt unit `text` to out[capacity] with each symbol in the case in which it is known: GPa for Gpa.
 * Returns false if the result is no unit either, or equals the text. */
static bool unit_in_other_case(const char *text, char *out, size_t capacity)
{
    struct measure m;
    snprintf(out, capacity, "%s", text);
    for (char *c = out; *c; c += *c != '\0') {
        char word[16];
        const size_t length = symbol_length(c);
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

/* Finds the power of ten that converts a unit to SI, and stores twice its exponent in *ten. unit_text: the unit; unit:
 * expected kind. Returns false, with a message in c, for an unknown unit or a unit of another kind. */
static bool unit_fits(struct complaint c, const char *unit_text, enum unit unit, int *ten)
{
    struct measure m;
    char wrong[64], other[UNIT_LONGEST + 1];
    unit_text = unit_text_remove_kelvin(unit_text, unit, wrong, sizeof wrong), *ten = 0;
    if (*unit_text == '\0') return true;
    if (!unit_read(&m, unit_text)) {
        const char *meant = unknown_unit_name_suggest_known_unit(unit_text);
        if (!meant && (strlen(unit_text) > UNIT_LONGEST || !unit_in_other_case(unit_text, other, sizeof other)))
            return complain(c, "has an unknown unit", unit);
        snprintf(wrong, sizeof wrong, "has an unknown unit (%s%s)", meant ? meant : other, meant ? "" : "?");
        return complain(c, wrong, unit);
    }
    const signed char *twice = unit_rows[unit].twice;
    *ten = m.ten;
    if (m.twice[0] == twice[0] && m.twice[1] == twice[1] && m.twice[2] == twice[2]) return true;
    const struct unit_row *row = unit_of(m.twice);
    snprintf(wrong, sizeof wrong, "is %s%s", row ? "" : "not ", row ? row->name : unit_rows[unit].name);
    return complain(c, wrong, unit);
}

/* Returns the number of seconds in the unit `text` if it is min or h, which are no powers of ten and cannot be combined
 * with other units; 0 if `text` is neither or the kind of unit `unit` is not time. */
static int clock_seconds(const char *text, enum unit unit)
{
    static const struct {
        const char *name;
        int seconds;
    } clocks[] = {{"min", 60}, {"h", 3600}};
    for (size_t k = 0; k < COUNT_OF(clocks) && unit == UNIT_TIME; k++)
        if (strcmp(text, clocks[k].name) == 0) return clocks[k].seconds;
    return 0;
}

/* Returns the number of radians in the unit `text`, rad or deg; 0 for another text. Every angle must have a unit. */
static real angle_radians(const char *text)
{
    if (strcmp(text, "rad") == 0) return 1;
    return strcmp(text, "deg") == 0 || strcmp(text, "\u00b0") == 0 ? 3.14159265358979323846 / 180 : 0;
}

static bool infinite_read(real *value, const char *text)
{
    const char *c = text + (*text == '-' || *text == '+');
    if (strcmp(c, "inf") != 0) return false;
    *value = *text == '-' ? -INFINITY : INFINITY;
    return true;
}

/* Reads `/ number` at the beginning of c into *divisor and returns its length. Without a divisor returns 0, *divisor 1.
 */
static size_t divisor_read(const char *c, real *divisor)
{
    const char *start = c;
    *divisor = 1;
    while (*c == ' ') c++;
    if (*c++ != '/') return 0;
    while (*c == ' ') c++;
    if (!isdigit((unsigned char)*c)) return 0;
    size_t length = number_length(c);
    if (length > NUMBER_LONGEST) return 0;
    *divisor = number_value(c, length, 0);
    return (size_t)(c - start) + length;
}

/* Bounds of the magnitude of numbers [SI]: products of a few larger or smaller numbers overflow or underflow. */
#define NUMBER_LEAST 1e-30
#define NUMBER_MOST 1e30

static bool in_bounds(struct complaint c, real value, enum unit unit)
{
    if (!isfinite(value)) return complain(c, "is not finite", unit);
    if (fabs(value) > NUMBER_MOST) return complain(c, "is above 1e30 in SI units", unit);
    if (fabs(value) < NUMBER_LEAST && fabs(value) > 0)
        return complain(c, "is not 0 but below 1e-30 in SI units, too small to be meant", unit);
    return true;
}

static real number_scaled(const char *text, size_t length, int ten, int clock, real divisor)
{
    return clock ? clock * number_value(text, length, 0) / divisor : number_value(text, length, ten) / divisor;
}

bool number_parse_with_unit(real *value, const char *text, enum unit unit, bool allow_infinity, char *message,
                            size_t capacity)
{
    struct complaint c = {message, capacity};
    real divisor;
    int ten;
    if (infinite_read(value, text)) return allow_infinity || complain(c, "is not finite", unit);
    size_t length = number_length(text);
    if (length == 0) return complain(c, "is not a number", unit);
    if (length > NUMBER_LONGEST) return complain(c, "has too many digits", unit);
    const char *other = trap(text, length), *decimals = text[length] == ',' ? text + length + 1 : NULL;
    if (other) {
        snprintf(message, capacity, "is not a number here: %s%.*s%s%.30s", other, decimals ? (int)length : 0, text,
                 decimals ? "." : "", decimals ? decimals : "");
        return false;
    }
    const char *rest = text + length + divisor_read(text + length, &divisor);
    while (*rest == ' ') rest++;
    const int clock = clock_seconds(rest, unit);
    const real radians = unit == UNIT_ANGLE ? angle_radians(rest) : 1;
    if (radians == 0) return complain(c, *rest ? "has another unit" : "has no unit", unit);
    if (unit == UNIT_ANGLE) rest = "";
    if (!clock && !unit_fits(c, rest, unit, &ten)) return false;
    if (divisor == 0) return complain(c, "divides by 0", unit);
    *value = number_scaled(text, length, ten, clock, divisor) * radians;
    return in_bounds(c, *value, unit);
}

/* Returns the length of a unit min, h, rad or deg at the beginning of a text, and stores its factor to s or rad in
 * *factor; 0 and the factor 1 if there is none. *is_time: receives whether the unit is min or h. */
static size_t factor_length(const char *text, real *factor, bool *is_time)
{
    const size_t letters = symbol_length(text);
    char word[8] = "";
    if (letters < sizeof word) memcpy(word, text, letters);
    const int seconds = clock_seconds(word, UNIT_TIME);
    *is_time = seconds > 0;
    *factor = *is_time ? seconds : angle_radians(word);
    if (*factor > 0) return letters;
    *factor = 1;
    return 0;
}

size_t quantity_read_unit_symbol(struct quantity *q, const char *text)
{
    struct measure m;
    const size_t length = isdigit((unsigned char)*text) ? 0 : symbol_length(text);
    if (length == 0 || !symbol_read(&m, text, length)) return 0;
    *q = (struct quantity){.value = number_value("1", 1, m.ten)};
    memcpy(q->twice, m.twice, sizeof q->twice);
    return length;
}

bool quantity_parse(struct quantity *q, const char *text)
{
    struct measure m = {{0, 0, 0}, 0};
    real divisor;
    const size_t length = number_length(text);
    if (length == 0 || length > NUMBER_LONGEST || trap(text, length)) return false;
    const char *rest = text + length + divisor_read(text + length, &divisor);
    rest += strspn(rest, " ");
    const int clock = clock_seconds(rest, UNIT_TIME);
    const real radians = angle_radians(rest);
    if (divisor == 0 || (!clock && radians == 0 && !unit_read(&m, rest))) return false;
    if (clock) m.twice[2] = 2;
    *q = (struct quantity){number_scaled(text, length, m.ten, clock, divisor), {0}, *rest == '\0'};
    if (radians > 0) q->value *= radians;
    memcpy(q->twice, m.twice, sizeof q->twice);
    return true;
}

size_t quantity_read_at_start_of_text(struct quantity *q, const char *text, bool read_unit, const char **fault_text)
{
    const size_t length = number_length(text);
    struct measure m = {{0, 0, 0}, 0};
    real factor = 1;
    bool is_time = false;
    *fault_text = length == 0 ? "not a number" : length > NUMBER_LONGEST ? "has too many digits" : trap(text, length);
    if (length > 0 && text[length] == ',') *fault_text = NULL; /* the comma can separate operands of a function */
    if (*fault_text) return 0;
    const char *unit = text + length + strspn(text + length, " ");
    size_t letters = read_unit ? factor_length(unit, &factor, &is_time) : 0;
    *q = (struct quantity){.bare = true};
    if (is_time) m.twice[2] = 2;
    if (read_unit && !letters) letters = unit_length(&m, unit);
    q->value = factor * number_value(text, length, m.ten);
    q->bare = letters == 0;
    memcpy(q->twice, m.twice, sizeof q->twice);
    return letters ? (size_t)(unit - text) + letters : length;
}

bool quantity_unit_is_of_kind_or_absent(const struct quantity *q, enum unit kind_of_unit, char *message,
                                        size_t capacity)
{
    const struct complaint c = {message, capacity};
    const signed char *twice = unit_rows[kind_of_unit].twice;
    const bool same = q->twice[0] == twice[0] && q->twice[1] == twice[1] && q->twice[2] == twice[2];
    char name[64], wrong[80];
    if (same || q->bare) return true;
    unit_exponents_describe_kind_of_unit(q->twice, name, sizeof name);
    snprintf(wrong, sizeof wrong, "is %s", name);
    return complain(c, wrong, kind_of_unit);
}

bool value_is_in_unit_bounds(real value, enum unit kind_of_unit, char *message, size_t capacity)
{
    return in_bounds((struct complaint){message, capacity}, value, kind_of_unit);
}

const char *number_write_shortest_exact_decimal(char text[32], real value)
{
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(text, 32, "%.*g", digits, value);
        if (strtod(text, NULL) == value) break;
    }
    return text;
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
