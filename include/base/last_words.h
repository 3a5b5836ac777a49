/* The message of a process that a library ends: out of memory, or a damaged file. Other crashes end as usual. */
#ifndef CLEAVE_LAST_WORDS
#define CLEAVE_LAST_WORDS

/* From now on such an end leaves a line on standard error, and exit status 1. */
void last_words_start(void);
/* Before HDF5 reads this file; NULL: after it. A crash in between is reported as that of a damaged file. */
void last_words_reading(const char *path);

#endif
