/* Declares what the files warn_units*.c share: judgement of values by the table of plausible ranges. */
#ifndef CLEAVE_WARN_UNITS
#define CLEAVE_WARN_UNITS

#include "engine_internal.h"

/* Adds a warning to *to if `value` is outside the plausible range of the quantity k in the table of ranges, unless the
 * key `accept` of scene s contains k. subject: name of the object that has this value, such as a material or body;
 * note: text with the numbers from which the value is computed, or "". */
void units_judge(const struct scene *s, enum accept k, const char *subject, real value, const char *note,
                 struct warnings *to);

/* As units_judge, with the plausible range least .. most in place of that of the table. */
void units_judge_between(const struct scene *s, enum accept k, real least, real most, const char *subject, real value,
                         const char *note, struct warnings *to);

/* Returns the smallest plausible value of the quantity k, in the unit of the table of ranges. */
real units_least_plausible_value(enum accept k);

/* Returns the largest plausible value of the quantity k, in the unit of the table of ranges. */
real units_largest_plausible_value(enum accept k);

/* Adds warnings to *to about loads of scene s that are probably mistakes of units: those that act too late or too
 * early, and stresses that are too small or too large for the materials (warn_units_loads.c). p: particles; loads: the
 * loads on them; dt: time step [s]. */
void units_of_loads(const struct scene *s, const struct particles *p, const struct loads *loads, real dt,
                    struct warnings *to);

#endif
