/* Messages for crashes inside libraries: out of memory, or a damaged file. Other crashes end the process as usual. */
#ifndef CLEAVE_LAST_WORDS
#define CLEAVE_LAST_WORDS

/* Installs handlers by which such a crash prints one line on standard error and exits with status 1. */
void last_words_start(void);

/* Announces that HDF5 is about to read the file `path`; NULL: it has finished. A crash in between is reported as a
 * damaged file. */
void last_words_reading(const char *path);

#endif
