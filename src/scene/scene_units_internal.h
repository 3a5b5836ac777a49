/* Declares units as exponents of m, kg and s, and the functions that read them from text (scene_units.c). */
#ifndef CLEAVE_SCENE_UNITS_INTERNAL
#define CLEAVE_SCENE_UNITS_INTERNAL

#include "scene_internal.h"

/* Largest number of characters of a unit. */
enum { UNIT_LONGEST = 40 };

/* A unit: twice the exponents of m, kg and s, and twice the power of ten of its factor to SI. */
struct measure {
    int twice[3], ten;
};

/* Returns the length of the symbol of a unit, with its prefix, at the beginning of the text c; 0 if there is none.
 * Whether the symbol is known is not checked. */
size_t unit_symbol_length(const char *c);

/* Reads the symbol `name` of `length` characters, such as mm or %, into *m. Returns false, and leaves *m unchanged, if
 * the symbol is unknown. */
bool unit_symbol_read(struct measure *m, const char *name, size_t length);

/* Reads a product of factors separated by blanks, `*` or `/` from `text` into *sum. Returns false if the text is no
 * unit, or has more than UNIT_LONGEST characters. */
bool unit_read(struct measure *sum, const char *text);

/* Reads the unit at the beginning of `text` into *sum: the longest product of factors separated by spaces, `*` or `/`.
 * Returns the length of the unit; 0 if there is none. */
size_t unit_read_at_start_of_text(struct measure *sum, const char *text);

/* Returns the first row of unit_rows, the table of known units, whose unit has the exponents twice[k]/2 of m, kg and s
 * (k = 0, 1, 2); NULL if there is none. */
const struct unit_row *unit_table_find_row_by_exponents(const int twice[3]);

/* Writes the misspelt unit `text` to out[capacity] with each symbol in the case in which it is known: GPa for Gpa.
 * Returns false if the result is no unit either, or equals the text. */
bool unit_correct_letter_case_of_symbols(const char *text, char *out, size_t capacity);

#endif
