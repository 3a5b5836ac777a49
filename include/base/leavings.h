/* Temporary files and helping programs that must not outlive a process that a signal ends. */
#ifndef CLEAVE_LEAVINGS
#define CLEAVE_LEAVINGS

enum leaving { LEAVING_PICTURE, LEAVING_FRAME, LEAVING_FILM, LEAVINGS };

/* Sets a file that is removed, and a child process that is killed before, if SIGINT, SIGTERM or SIGHUP ends this
 * process. path is copied; NULL: no file. process: 0: no child. Signals that are ignored or have a handler keep it. */
void leaving_set(enum leaving which, const char *path, int process);

#endif
