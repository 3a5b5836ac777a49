/* Implements status messages, the removal of control characters from texts, and the median (base/base.h). */
#include "base/base.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

enum { MESSAGE_LENGTH = 4096 }; /* room for the message of an error [byte]; longer messages are cut */

/* Message of the last error, set with a status. Each thread has its own, so that messages of two threads are never
 * mixed. */
static _Thread_local char message[MESSAGE_LENGTH];
static _Thread_local bool placed; /* set by status_message_prepend_location */

status status_set(status s, const char *format, ...)
{
    char text[MESSAGE_LENGTH]; /* the old message may be among the arguments */
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    text_replace_control_characters(text);
    snprintf(message, sizeof message, "%s", text);
    placed = false;
    return s;
}

void status_message_append_line(const char *format, ...)
{
    char text[MESSAGE_LENGTH];
    const size_t used = strlen(message);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    text_replace_control_characters(text);
    snprintf(message + used, sizeof message - used, "\n%s", text);
}

status status_message_prepend_location(const char *location, status s)
{
    if (s != REFUSED || placed || !*location) return s;
    status_set(s, "%s%s", location, message);
    placed = true;
    return s;
}

const char *status_message(void) { return message; }

/* Returns the number of bytes, 1 to 3, of the character at c if a terminal would act on this character instead of
 * showing it; 0 for a character that is shown. left: number of bytes from c on, at least 1. A terminal acts on three
 * groups of characters. Control characters are bytes below a blank, 127, and U+0080 to U+009F (in UTF-8 C2 80 to C2
 * 9F). Characters that change the direction of writing or end lines are U+200E, U+200F, U+2028 to U+202E and U+2066 to
 * U+2069 (in UTF-8 E2 80 8E, and so on). */
static int harmful_bytes(const unsigned char *c, size_t left)
{
    if (*c < ' ' || *c == 127) return 1;
    if (left >= 2 && c[0] == 0xC2 && c[1] >= 0x80 && c[1] < 0xA0) return 2;
    if (left < 3 || c[0] != 0xE2) return 0;
    if (c[1] == 0x80 && (c[2] == 0x8E || c[2] == 0x8F || (c[2] >= 0xA8 && c[2] <= 0xAE))) return 3;
    return c[1] == 0x81 && c[2] >= 0xA6 && c[2] <= 0xA9 ? 3 : 0;
}

void bytes_replace_control_characters(char *text, size_t length)
{
    unsigned char *c = (unsigned char *)text;
    for (size_t k = 0; k < length; k++)
        for (int n = harmful_bytes(c + k, length - k); n > 0; n--) c[k + (size_t)n - 1] = '?';
}

void text_replace_control_characters(char *text) { bytes_replace_control_characters(text, strlen(text)); }

struct printable_name printable_name(const char *name)
{
    struct printable_name s;
    snprintf(s.text, sizeof s.text, "%s", name);
    text_replace_control_characters(s.text);
    return s;
}

int compare_doubles(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

double median_by_sorting(double *value, int64_t count)
{
    qsort(value, (size_t)count, sizeof *value, compare_doubles);
    return value[count / 2];
}

const char *compiler_name(void)
{
#if defined __clang__
    return __VERSION__; /* the text includes the name of the compiler */
#else
    return "gcc " __VERSION__;
#endif
}
