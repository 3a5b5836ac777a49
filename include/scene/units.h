/* Reads numbers with units from the texts of scenes and tables. */
#ifndef CLEAVE_UNITS
#define CLEAVE_UNITS

#include "base/base.h"

enum unit {
    UNIT_NONE,
    UNIT_LENGTH,
    UNIT_AREA,
    UNIT_TIME,
    UNIT_SPEED,
    UNIT_DENSITY,
    UNIT_PRESSURE,
    UNIT_SURFACE_ENERGY,
    UNIT_TOUGHNESS,
    UNIT_BODY_FORCE,
    UNIT_RATE,
    UNIT_MASS,
    UNIT_FORCE,
    UNIT_VOLUME,
    UNIT_ACCELERATION,
    UNIT_ENERGY,
    UNIT_ANGLE,
    UNIT_TEMPERATURE,
    UNIT_SPECIFIC_HEAT,
    UNITS
};

/* A kind of unit: its name in messages, its SI symbol, an example, and twice its exponents of m, kg and s. Twice, since
 * the exponents of toughness, Pa m^(1/2), are not whole numbers. */
struct unit_row {
    const char *name, *symbol, *example;
    signed char twice[3];
};
extern const struct unit_row unit_rows[UNITS];

/* Reads `text` of the form `number [/ number] [unit]` and stores it in *value in SI units, correctly rounded. unit:
 * kind of unit that is expected; allow_infinity: true if inf is allowed. Returns false if the text has another form or
 * unit. Then message[capacity] receives what is wrong and what is expected, as the rest of a sentence that begins with
 * the text. */
bool number_parse_with_unit(real *value, const char *text, enum unit unit, bool allow_infinity, char *message,
                            size_t capacity);

#endif
