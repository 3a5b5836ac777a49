/* An external file read into memory, with functions that parse words and numbers and report errors with the line. */
#ifndef CLEAVE_SOURCE
#define CLEAVE_SOURCE

#include "base/base.h"

/* Content of the file `path` in memory, and the reading position in it. */
struct geometry_file {
    const char *path;
    char *text; /* content, followed by a zero byte */
    /* bytes; position of the next byte */
    int64_t length, at;
    bool binary; /* numbers are binary, in this machine's byte order */
};

/* Reads the whole file `path` into `source` and sets the reading position to its start. Release `source` with
 * geometry_file_close. Returns REFUSED, with a message and nothing to release, if the file is unreadable, empty, or too
 * large for the memory. */
status geometry_file_read_whole(struct geometry_file *source, const char *path);

/* Sets the message of a failure (status_set) to `path:line: text`, with the line of the reading position of `file`
 * (`path: text` for binary files) and a text composed from `format` as by printf. Returns REFUSED. */
status geometry_file_report_fault(const struct geometry_file *file, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* Moves the reading position of `file` over white space to the beginning of the next word. Returns true, or false at
 * the end of the file. */
bool geometry_file_skip_blanks(struct geometry_file *file);

/* Copies the next word of the file to `word`, which has `capacity` bytes, cut if necessary and ended by a zero byte; ""
 * at the end of the file. */
void geometry_file_read_word(struct geometry_file *file, char *word, size_t capacity);

/* Reads the next number of the file into *value: a word of text, or 8 bytes of a binary file. quantity: name of the
 * number, for the message. Returns REFUSED, with a message, if it is missing or not finite. */
status geometry_file_read_real(struct geometry_file *file, const char *quantity, real *value);

/* Reads the next word of the text file as an integer into *value. quantity: name of the number, for the message.
 * Returns REFUSED, with a message, if it is missing or not an integer. */
status geometry_file_read_integer(struct geometry_file *file, const char *quantity, int64_t *value);

/* Reads the next integer of the file into *value: a word of text, or 4 bytes of a binary file. quantity: name of the
 * number, for the message. Returns REFUSED, with a message, if it is missing or not an integer. */
status geometry_file_read_int32(struct geometry_file *file, const char *quantity, int64_t *value);

/* Reads the next integer of the file into *value: a word of text, or 8 bytes of a binary file. quantity: name of the
 * number, for the message. Returns REFUSED, with a message, if it is missing or not an integer. */
status geometry_file_read_int64(struct geometry_file *file, const char *quantity, int64_t *value);

/* Checks that `count` items of at least `bytes_per_item` bytes each can follow in the file, before memory is allocated
 * for them. item_name: name of the items, for the message. Returns REFUSED, with a message, if the rest of the file is
 * shorter. */
status geometry_file_check_count_fits_size(const struct geometry_file *file, const char *item_name, int64_t count,
                                           int64_t bytes_per_item);

/* Moves the reading position of the file to the beginning of the next line, or to the end of the file. */
void geometry_file_skip_to_next_line(struct geometry_file *file);

/* Releases the content of the file, which geometry_file_read_whole has read. */
void geometry_file_close(struct geometry_file *file);

#endif
