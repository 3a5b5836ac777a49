/* floor 0: last words of a process that a library ends: for want of memory, or over a damaged file. Every other crash stays what it is. */
#ifndef CLEAVE_LAST_WORDS_H
#define CLEAVE_LAST_WORDS_H

/* From now on such an end leaves a line on standard error, and exit status 1. */
void last_words_start(void);
/* HDF5 reads this file from now on; NULL: it has read it. A crash until then is that of a damaged file. */
void last_words_reading(const char *path);

#endif
