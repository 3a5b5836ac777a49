/* Texts composed in memory before they are written to a file. */
#ifndef CLEAVE_MEMORY_STREAM
#define CLEAVE_MEMORY_STREAM

#include <stdio.h>

/* Opens a stream that collects its output in memory. fclose stores the text with a terminating NUL in *text, which the
 * caller releases with free, and its length in *length; fclose returns EOF with errno ENOMEM if any part of the text
 * could not be stored, which open_memstream of the GNU C library does not report. Returns NULL if there is no memory
 * for the stream. */
FILE *memory_stream_open(char **text, size_t *length);

#endif
