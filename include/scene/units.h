/* Numbers with units. */
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
    UNITS
};
struct unit_row {
    const char *name, *symbol, *example;
    signed char twice[3];
}; /* twice the powers of m, kg, s */
extern const struct unit_row unit_rows[UNITS];

/* Reads `number [/ number] [unit]`, exactly rounded: units are powers of ten (but for min and h). On failure writes to
 * `what` the rest of a sentence that begins with the text: the fault and what is expected. */
bool number_read(real *value, const char *text, enum unit unit, bool infinite, char *what, size_t room);

#endif
