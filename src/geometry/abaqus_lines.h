/* Lines, fields and keywords of Abaqus .inp files. */
#ifndef CLEAVE_ABAQUS_LINES
#define CLEAVE_ABAQUS_LINES

#include "source.h"

/* FIELD: capacity of a field of a line [byte]; PARAMETERS_MAX: largest number of parameters of a keyword. */
enum { FIELD = 96, PARAMETERS_MAX = 16 };

/* A keyword line of an Abaqus file: its name and its parameters of[n], such as *ELSET, ELSET=grip, GENERATE. */
struct abaqus_keyword {
    char name[FIELD]; /* in capitals, without blanks and star */
    int n;            /* length of `of` */
    struct parameter {
        char name[FIELD], value[FIELD];
    } of[PARAMETERS_MAX];
};

/* Reads the next field of the current line of `file` into field[FIELD]: the text up to a comma, without surrounding
 * blanks. Fields of FIELD or more characters are cut. Returns true, or false if the line has no further field; a comma
 * at the end of the line adds no field. */
bool abaqus_read_field(struct geometry_file *file, char field[FIELD]);

/* Advances the file to the next line that is neither empty nor a comment. Returns true if it is a line of data, false
 * if it is a keyword line or if the file has ended. */
bool abaqus_skip_blank_lines_and_test_for_data_line(struct geometry_file *file);

/* Parses the text `field` as a number into *value, also with Fortran's exponent letter d. An empty field is 0, as
 * Abaqus prescribes. file: file, for the message. Returns REFUSED, with a message, unless the field is a finite number.
 */
status abaqus_parse_real(const struct geometry_file *file, const char *field, real *value);

/* Returns true if `field`, a field of a line, is a label (number of a node or element) and not the name of a set: if it
 * begins with a digit. */
bool abaqus_field_is_label(const char *field);

/* Parses the text `field` as the label (number in the file) of a node or element into *label. file: file, for the
 * message. Returns REFUSED, with a message, unless the field is a whole number from 0 to LABEL_MAX. */
status abaqus_parse_label(const struct geometry_file *file, const char *field, int32_t *label);

/* Copies the word `from` to to[FIELD] in capitals and without blanks; a longer word is cut. */
void abaqus_copy_word_in_capitals(char *to, const char *from);

/* Reads the keyword line at which the file is into *keyword, and stops at its end so that messages name this line.
 * After a trailing comma the keyword continues on the next line. */
void abaqus_read_keyword(struct geometry_file *file, struct abaqus_keyword *keyword);

/* Returns the value of the parameter `name` of the keyword line `keyword`: "" if the parameter has no value, NULL if it
 * is missing. */
const char *abaqus_keyword_parameter_value(const struct abaqus_keyword *keyword, const char *name);

#endif
