/* Bytes of a foreign file, read once and whole: words, numbers and faults that name the line. */
#ifndef CLEAVE_SOURCE
#define CLEAVE_SOURCE

#include "base/base.h"

struct source {
    const char *path;
    char *text; /* a zero byte follows the last */
    int64_t length, at;
    bool binary; /* numbers are bytes of this machine */
};

/* Reads a file. REFUSED if it cannot be read, is empty or larger than memory allows; nothing is left to free then. */
status source_open(struct source *s, const char *path);
/* REFUSED with `path:line: what`, or `path: what` of bytes. */
status source_fault(const struct source *s, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Skips blanks and ends of lines; false: nothing follows. */
bool source_more(struct source *s);
/* The next word, cut to the room; "" at the end. */
void source_word(struct source *s, char *word, size_t room);
/* The next number. REFUSED if none follows, or it is not finite or whole; `what` names it. */
status source_real(struct source *s, const char *what, real *value);
status source_whole(struct source *s, const char *what, int64_t *value);
/* The same where it is 4 or 8 bytes of a binary file. */
status source_int(struct source *s, const char *what, int64_t *value);
status source_size(struct source *s, const char *what, int64_t *value);
/* A count of things that take at least `bytes` each; REFUSED if the rest of the file does not hold so many. */
status source_counted(const struct source *s, const char *what, int64_t count, int64_t bytes);
/* Goes to the beginning of the next line. */
void source_next_line(struct source *s);
void source_close(struct source *s);

#endif
