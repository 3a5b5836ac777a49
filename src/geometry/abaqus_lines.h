/* Lines, fields and keywords of Abaqus .inp files. */
#ifndef CLEAVE_ABAQUS_LINES
#define CLEAVE_ABAQUS_LINES

#include "source.h"

/* Capacity of a field of a line [byte]; largest number of parameters of a keyword. */
enum { FIELD = 96, PARAMETERS_MAX = 16 };

/* A keyword line: its name and parameters, such as *ELSET, ELSET=grip, GENERATE. */
struct abaqus_keyword {
    char name[FIELD]; /* in capitals, without blanks and star */
    int n;            /* length of `of` */
    struct parameter {
        char name[FIELD], value[FIELD];
    } of[PARAMETERS_MAX];
};

/* Reads the next field of the current line into field[FIELD]: the text up to a comma, without surrounding blanks.
 * Fields of FIELD or more characters are cut. Returns false if the line has no further field; a comma at its end adds
 * none. */
bool abaqus_read_field(struct source *s, char field[FIELD]);

/* Advances to the next line that is neither empty nor a comment. Returns true if it is a line of data. Returns false if
 * it is a keyword, or at the end of the file. */
bool abaqus_find_data_line(struct source *s);

/* Parses a field as a number *value, also with Fortran's exponent letter d. An empty field is 0, as Abaqus
 * prescribes. Returns REFUSED unless it is a finite number. */
status abaqus_parse_real(const struct source *s, const char *field, real *value);

/* Returns true if `field`, a field of a line, is a label (number of a node or element) and not the name of a set: if it
 * begins with a digit. */
bool abaqus_is_label(const char *field);

/* Parses a field as the label of a node or element. Returns REFUSED unless it is a whole number from 0 to LABEL_MAX. */
status abaqus_parse_label(const struct source *s, const char *field, int32_t *label);

/* Copies the word `from` to to[FIELD] in capitals and without blanks. */
void abaqus_plain_word(char *to, const char *from);

/* Reads a keyword line into *keyword, and stops at its end so that messages name this line. A keyword continues on the
 * next line after a trailing comma. */
void abaqus_read_keyword(struct source *s, struct abaqus_keyword *keyword);

/* Returns the value of the parameter `name` of a keyword, "" if it has no value; NULL if it is missing. */
const char *abaqus_parameter(const struct abaqus_keyword *keyword, const char *name);

#endif
