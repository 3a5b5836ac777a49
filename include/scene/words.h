/* Reads words of command lines with the functions that read scenes. */
#ifndef CLEAVE_WORDS
#define CLEAVE_WORDS

#include "base/base.h"

/* Reads a length with its unit, such as `4mm`, from `text` into *value [m]. Returns false if the text is no length.
 * Then message[capacity] receives the fault, as the rest of a sentence that begins with the text. */
bool length_parse_with_unit(real *value, const char *text, char *message, size_t capacity);

/* Reads a time with its unit, such as `4us`, from `text` into *value [s]. Returns false if the text is no time. Then
 * message[capacity] receives the fault, as the rest of a sentence that begins with the text. */
bool time_parse_with_unit(real *value, const char *text, char *message, size_t capacity);

/* Reads a number with a unit from `text` into *value [SI]. symbol: SI symbol of the expected kind of unit, such as Pa.
 * If no kind of unit has this symbol, the number must have no unit. Returns false if the text is no such number. Then
 * message[capacity] receives the fault, as the rest of a sentence that begins with the text. */
bool value_parse_with_unit_symbol(real *value, const char *text, const char *symbol, char *message, size_t capacity);

/* Writes the number `text` into joined[capacity], with the unit of the number `number_with_unit` if it has none itself:
 * `-5` beside `5 mm` becomes `-5mm`. A longer text is cut. Returns `joined`. */
const char *number_text_append_unit_if_missing(char *joined, size_t capacity, const char *text,
                                               const char *number_with_unit);

/* Returns the symbol of the SI unit of numbers that a scene states without a unit for the key `path`, e.g. "Pa" for
 * materials.glass.young; "" if the key has no unit or is unknown. */
const char *scene_key_unit(const char *path);

/* Returns the index of `text`, from 0, in the list `words`, whose entries are separated by `|`; -1 if it is not in the
 * list. */
int word_index_in_list(const char *words, const char *text);

/* Text that a message appends to an unknown word: a proposal of a similar word, or only a semicolon. A structure, so
 * that functions can return it by value. */
struct word_proposal {
    char text[100];
};

/* Returns the text `; did you mean NAME?` with that one of the n > 0 names name[n] that has the smallest edit distance
 * to `word`, the first one if there are several; the text `;` if that name is not similar to `word`
 * (word_is_probable_misspelling_of). */
struct word_proposal word_propose_similar(const char *word, const char *const *name, int n);

#endif
