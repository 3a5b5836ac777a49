/* Temporary files and helping programs that must not outlive a process that a signal ends. */
#ifndef CLEAVE_LEAVINGS
#define CLEAVE_LEAVINGS

#include <stdbool.h>

enum leaving { LEAVING_PICTURE, LEAVING_FRAME, LEAVING_FILM, LEAVINGS };

/* Sets a file that is removed, and a child process that is killed before with all that it started, if SIGINT, SIGTERM
 * or SIGHUP ends this process. path is copied; NULL: no file. process: 0: no child. Signals that are ignored or have a
 * handler keep it. */
void leaving_set(enum leaving which, const char *path, int process);

/* Keeps those signals waiting (true) while a file or a child is made that leaving_set does not know yet, and lets them
 * come (false). A child starts with what its parent had. */
void leavings_hold(bool hold);

/* For a child between fork and exec: a process group of its own, so that what it starts is killed with it, and no
 * signal kept waiting. */
void leavings_child(void);

#endif
