/* Reads numbers with units by a grammar of its own: no octal numbers, no dependence on the locale, and units that are
 * exact powers of ten (scene_units.c), besides min, h, rad and deg. */
#include "scene_units_internal.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { NUMBER_LONGEST = 60 };

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
        if (!meant &&
            (strlen(unit_text) > UNIT_LONGEST || !unit_correct_letter_case_of_symbols(unit_text, other, sizeof other)))
            return complain(c, "has an unknown unit", unit);
        snprintf(wrong, sizeof wrong, "has an unknown unit (%s%s)", meant ? meant : other, meant ? "" : "?");
        return complain(c, wrong, unit);
    }
    const signed char *twice = unit_rows[unit].twice;
    *ten = m.ten;
    if (m.twice[0] == twice[0] && m.twice[1] == twice[1] && m.twice[2] == twice[2]) return true;
    const struct unit_row *row = unit_table_find_row_by_exponents(m.twice);
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
    const size_t letters = unit_symbol_length(text);
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
    const size_t length = isdigit((unsigned char)*text) ? 0 : unit_symbol_length(text);
    if (length == 0 || !unit_symbol_read(&m, text, length)) return 0;
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
    if (read_unit && !letters) letters = unit_read_at_start_of_text(&m, unit);
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
