/* Replaces control characters in standard output and error, by streams of the C library with a write function of their
 * own. Where the library has no such streams (neither glibc nor BSD), only messages of status_set are protected. */
#define _GNU_SOURCE /* fopencookie */
#include "base/output_filter.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/base.h"

enum { CHUNK = 4096 }; /* largest length of a piece of text that is filtered at a time [byte] */

static const char erase_line[] = "\033[K";

/* Copies `length` bytes of output from `from` to `to` and replaces control characters in the copy by `?`, except those
 * that the program itself sends to a terminal: line end, tab, the sequence that erases a line, and, if `first`, a
 * carriage return as the first byte. */
static void chunk_harmless(char *to, const char *from, size_t length, bool first)
{
    memcpy(to, from, length);
    bytes_replace_control_characters(to, length);
    for (size_t k = 0; k < length; k++)
        if (from[k] == '\n' || from[k] == '\t' || (from[k] == '\r' && first && k == 0))
            to[k] = from[k];
        else if (length - k >= sizeof erase_line - 1 && !memcmp(from + k, erase_line, sizeof erase_line - 1))
            memcpy(to + k, erase_line, sizeof erase_line - 1);
}

/* Writes `length` bytes to the file descriptor fd, with control characters replaced by `?`. Returns the number of bytes
 * written, which is less than `length` if a write fails. */
static size_t harmless_write(int fd, const char *bytes, size_t length)
{
    char text[CHUNK];
    size_t done = 0;
    while (done < length) {
        const size_t n = length - done < CHUNK ? length - done : CHUNK;
        chunk_harmless(text, bytes + done, n, done == 0 && fd == STDERR_FILENO);
        for (size_t sent = 0; sent < n;) {
            const ssize_t more = write(fd, text + sent, n - sent);
            if (more < 0 && errno == EINTR) continue;
            if (more <= 0) return done + sent;
            sent += (size_t)more;
        }
        done += n;
    }
    return done;
}

static const int output_fd = STDOUT_FILENO, error_fd = STDERR_FILENO;

#if defined __GLIBC__
static ssize_t stream_write(void *fd, const char *bytes, size_t length)
{
    return (ssize_t)harmless_write(*(const int *)fd, bytes, length);
}

static FILE *stream_open(const int *fd)
{
    return fopencookie((void *)(uintptr_t)fd, "w", (cookie_io_functions_t){.write = stream_write});
}
#elif defined __APPLE__
static int stream_write(void *fd, const char *bytes, int length)
{
    const size_t done = harmless_write(*(const int *)fd, bytes, (size_t)length);
    return done > 0 || length == 0 ? (int)done : -1;
}

static FILE *stream_open(const int *fd) { return fwopen((const void *)fd, stream_write); }
#else
static FILE *stream_open(const int *fd) { return (void)fd, NULL; }
#endif

void standard_streams_replace_control_characters(void)
{
    FILE *output = stream_open(&output_fd), *error = stream_open(&error_fd);
    if (output) {
        setvbuf(output, NULL, isatty(STDOUT_FILENO) ? _IOLBF : _IOFBF, BUFSIZ);
        stdout = output;
    }
    if (error) {
        setvbuf(error, NULL, _IONBF, 0);
        stderr = error;
    }
}
