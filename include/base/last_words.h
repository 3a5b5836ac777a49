/* The message of a process that a library ends, for want of memory or over a damaged file. Other crashes end as
 * usual. */
#ifndef CLEAVE_LAST_WORDS
#define CLEAVE_LAST_WORDS

/* From now on such an end leaves a line on standard error, and exit status 1. */
void last_words_start(void);
/* HDF5 reads this file from now on; NULL: it has read it. A crash until then is that of a damaged file. */
void last_words_reading(const char *path);

#endif
