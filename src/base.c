/* floor 0: the one message that goes with a status. */
#include "base.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

enum { MESSAGE_LENGTH = 1024 };

/* As errno: each thread has its own, so that a worker's fault never mixes with another's. */
static _Thread_local char message[MESSAGE_LENGTH];

status status_set(status s, const char *format, ...)
{
    char text[MESSAGE_LENGTH];           /* the old message may be among the arguments */
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    text_harmless(text);
    snprintf(message, sizeof message, "%s", text);
    return s;
}

const char *status_message(void) { return message; }

/* Control characters are bytes below a blank, 127, and U+0080 to U+009F, in UTF-8 C2 80 to C2 9F. */
void text_harmless(char *text)
{
    for (unsigned char *c = (unsigned char *)text; *c; c++) {
        if (*c < ' ' || *c == 127) *c = '?';
        if (*c == 0xC2 && c[1] >= 0x80 && c[1] < 0xA0) c[0] = c[1] = '?';
    }
}

struct shown_name shown_name(const char *name)
{
    struct shown_name s;
    snprintf(s.text, sizeof s.text, "%s", name);
    text_harmless(s.text);
    return s;
}

static int by_size(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

double median_of(double *value, int64_t n)
{
    qsort(value, (size_t)n, sizeof *value, by_size);
    return value[n / 2];
}
