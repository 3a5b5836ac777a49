/* Messages for crashes inside libraries: out of memory, or a damaged file. Other crashes end the process as usual. */
#ifndef CLEAVE_CRASH_MESSAGE
#define CLEAVE_CRASH_MESSAGE

/* Installs handlers for crashes inside libraries that are caused by lack of memory or by a damaged file: the program
 * then prints one line on standard error and exits with status 1. */
void crash_message_install_signal_handlers(void);

/* Announces that HDF5 is about to read the file `path` or, if `path` is NULL, that HDF5 has finished reading. A crash
 * between these two calls is reported as a damaged file. */
void crash_message_set_file_in_use(const char *path);

#endif
