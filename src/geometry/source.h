/* An external file read into memory, with functions that parse words and numbers and report errors with the line. */
#ifndef CLEAVE_SOURCE
#define CLEAVE_SOURCE

#include "base/base.h"

/* Content of a file and the reading position. */
struct source {
    const char *path;
    char *text; /* content, followed by a zero byte */
    /* bytes; position of the next byte */
    int64_t length, at;
    bool binary; /* numbers are binary, in this machine's byte order */
};

/* Reads a whole file. REFUSED: unreadable, empty, or too large for memory; then there is nothing to free. */
status source_open(struct source *s, const char *path);

/* Returns REFUSED with the message `path:line: text`, or `path: text` for binary files. */
status source_fault(const struct source *s, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Skips white space. Returns false at the end of the file. */
bool source_more(struct source *s);

/* Copies the next word, truncated to `room` bytes with the zero byte; "" at the end of the file. */
void source_word(struct source *s, char *word, size_t room);

/* Reads a number: text, or 8 bytes of a binary file. REFUSED: missing or not finite; `what` names it in the message. */
status source_real(struct source *s, const char *what, real *value);

/* Reads an integer given as text. REFUSED: missing or no integer; `what` names it in the message. */
status source_whole(struct source *s, const char *what, int64_t *value);

/* Reads an integer: text, or 4 bytes of a binary file. REFUSED: missing or no integer. */
status source_int(struct source *s, const char *what, int64_t *value);

/* Reads an integer: text, or 8 bytes of a binary file. REFUSED: missing or no integer. */
status source_size(struct source *s, const char *what, int64_t *value);

/* Checks a count of items of at least `bytes` bytes each. REFUSED if the rest of the file is too short for it. */
status source_counted(const struct source *s, const char *what, int64_t count, int64_t bytes);

/* Moves to the beginning of the next line. */
void source_next_line(struct source *s);

/* Frees the content. */
void source_close(struct source *s);

#endif
