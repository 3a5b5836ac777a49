/* Reads lines and fields of CSV files, for particle lists and functions of time. */
#ifndef CLEAVE_CSV
#define CLEAVE_CSV

#include <stdio.h>

#include "base/base.h"

enum { CSV_LINE_LENGTH = 4096 }; /* room for a line of a CSV file [byte] */

/* An open CSV file and its current line. */
struct csv_file {
    const char *path, *holds; /* path and contents of a line, for messages; kept by reference */
    FILE *file;
    int64_t line;   /* number of the current line, from 1 */
    char separator; /* comma unless csv_detect_separator finds another in the header; or a blank */
    char text[CSV_LINE_LENGTH];
};

/* Opens the CSV file `path` for reading. line_description: what a line of it contains, in words for messages. Both
 * texts are kept by reference. Returns REFUSED, with a message, if the file cannot be read. Close c with csv_close. */
status csv_open(struct csv_file *c, const char *path, const char *line_description);

/* Closes the CSV file that csv_open has opened in *c. */
void csv_close(struct csv_file *c);

/* Reads the next line that is not blank into c->text, with e for the D of Fortran exponents, as in 5.0D-01. Sets
 * *line_was_read to false at the end of the file, and *line_is_comment to true if the line begins with #. Returns
 * REFUSED, with a message, if the line is too long or cannot be read. */
status csv_read_line(struct csv_file *c, bool *line_was_read, bool *line_is_comment);

/* Reads the next line that is neither blank nor a comment into c->text. Sets *line_was_read to false at the end of the
 * file. Returns REFUSED, with a message, if the line is too long or cannot be read. */
status csv_read_data_line(struct csv_file *c, bool *line_was_read);

/* Sets the separator of the CSV file c from its current line, c->text: a semicolon if the line contains one, else a tab
 * if it has more tabs than commas, else a comma. */
void csv_detect_separator(struct csv_file *c);

/* Cuts the next field off the line *rest_of_line of the CSV file c and returns the field, terminated in place, without
 * surrounding blanks and double quotes. Quoted text may contain separators. *rest_of_line receives the rest of the
 * line, or NULL after the last field. Returns NULL if *rest_of_line is NULL. */
char *csv_split_off_next_field(const struct csv_file *c, char **rest_of_line);

/* Cuts the unit off column_name, such as `time [us]` or `time (us)`, in place, and returns a pointer to the unit; "" if
 * there is none. */
char *csv_cut_unit_off_column_name(char *column_name);

/* Returns REFUSED with the message `file:line:column: TEXT`. field: a field of the current line of c, whose location
 * the message gives; format: TEXT as in printf. */
status csv_report_fault(const struct csv_file *c, const char *field, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#endif
