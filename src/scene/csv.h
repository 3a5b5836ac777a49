/* Lines and fields of CSV files: what lists of particles and functions of time have in common. */
#ifndef CLEAVE_CSV
#define CLEAVE_CSV

#include <stdio.h>

#include "base/base.h"

enum { CSV_LINE_LENGTH = 4096 };

struct csv_file {
    const char *path, *holds; /* what the file is and has in a line, for messages */
    FILE *file;
    int64_t line;   /* number of the current line, from 1 */
    char separator; /* comma unless csv_separate finds another in the header; or a blank */
    char text[CSV_LINE_LENGTH];
};

status csv_open(struct csv_file *c, const char *path, const char *holds);
void csv_close(struct csv_file *c);
/* Reads the next line that is not blank; `*more` is false at the end of the file, `*comment` true of one with #. */
status csv_text(struct csv_file *c, bool *more, bool *comment);
/* The same for the next line that is neither blank nor a comment. */
status csv_line(struct csv_file *c, bool *more);
/* Takes the separator of the file from the current line: a semicolon or a tab where it has one, else a comma. */
void csv_separate(struct csv_file *c);
/* Cuts the next field off `rest`, without surrounding blanks and double quotes, which may hold separators; NULL at the
 * end of the line. */
char *csv_field(const struct csv_file *c, char **rest);
/* Cuts the unit off the name of a column: `time [us]`, `time (us)`; "" without one. */
char *csv_unit(char *name);
/* REFUSED with `file:line:column: ` of a field of the current line. */
status csv_fault(const struct csv_file *c, const char *field, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#endif
