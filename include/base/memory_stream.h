/* Texts that are composed in memory before they are written to a file. */
#ifndef CLEAVE_MEMORY_STREAM
#define CLEAVE_MEMORY_STREAM

#include <stdio.h>

/* Opens a stream that collects in memory what is written to it. fclose leaves the text with a NUL behind it in *text,
 * for free, and its bytes in *length; it returns EOF with ENOMEM if any part of the text found no memory, of which
 * open_memstream of the GNU C library says nothing. Returns NULL if there is no memory for the stream. */
FILE *memory_stream_open(char **text, size_t *length);

#endif
