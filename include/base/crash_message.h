/* Messages for crashes inside libraries: out of memory, or a damaged file. Other crashes end the process as usual. */
#ifndef CLEAVE_CRASH_MESSAGE
#define CLEAVE_CRASH_MESSAGE

/* Installs handlers by which such a crash prints one line on standard error and exits with status 1. */
void crash_message_install(void);

/* Announces that HDF5 is about to read the file `path`; NULL: it has finished. A crash in between is reported as a
 * damaged file. */
void crash_message_set_file(const char *path);

#endif
