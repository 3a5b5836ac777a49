/* Streams into memory. */
#define _GNU_SOURCE /* fopencookie */
#include "base/memory_stream.h"

#include <errno.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/types.h>

#ifdef __linux__

/* The collected output of a stream: text[length], with memory for `room` bytes. lost: true if a part of the output
 * could not be stored. */
struct collected {
    char **text;
    size_t *length, room;
    bool lost;
};

/* Extends the memory of the collected output c, if necessary, so that `more` further bytes and a NUL fit. Returns
 * false, and changes nothing, if memory is exhausted. */
static bool collected_room(struct collected *c, size_t more)
{
    const size_t least = *c->length + more + 1, room = least < 2 * c->room ? 2 * c->room : least;
    if (least <= c->room) return true;
    char *grown = realloc(*c->text, room);
    if (!grown) return false;
    *c->text = grown, c->room = room;
    return true;
}

/* Appends n bytes to the collected output of a stream. It is the write function of the stream for fopencookie. context:
 * the output (struct collected). Returns n; or 0 if memory is exhausted, now or at an earlier call. */
static ssize_t collected_write(void *context, const char *bytes, size_t n)
{
    struct collected *c = context;
    if (c->lost || !collected_room(c, n)) {
        c->lost = true;
        return 0;
    }
    memcpy(*c->text + *c->length, bytes, n);
    *c->length += n;
    (*c->text)[*c->length] = '\0';
    return (ssize_t)n;
}

static int collected_close(void *context)
{
    struct collected *c = context;
    const bool lost = c->lost;
    free(c);
    if (lost) errno = ENOMEM;
    return lost ? EOF : 0;
}

FILE *memory_stream_open(char **text, size_t *length)
{
    struct collected *c = malloc(sizeof *c);
    *text = NULL, *length = 0;
    if (!c) return NULL;
    *c = (struct collected){.text = text, .length = length};
    FILE *stream = NULL;
    if (collected_room(c, 255)) {
        **text = '\0';
        stream = fopencookie(c, "w", (cookie_io_functions_t){.write = collected_write, .close = collected_close});
    }
    if (!stream) {
        free(*text);
        *text = NULL;
        free(c);
    }
    return stream;
}

#else

FILE *memory_stream_open(char **text, size_t *length)
{
    *text = NULL, *length = 0;
    return open_memstream(text, length);
}

#endif
