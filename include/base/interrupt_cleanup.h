/* Temporary files and child processes that must not outlive a process ended by a signal. */
#ifndef CLEAVE_INTERRUPT_CLEANUP
#define CLEAVE_INTERRUPT_CLEANUP

#include <stdbool.h>

enum leaving { LEAVING_PICTURE, LEAVING_FRAME, LEAVING_FILM, LEAVINGS };

/* Sets a file to be removed, and a child process to be killed before with all processes it started, when SIGINT,
 * SIGTERM or SIGHUP ends this process. path is copied; NULL: no file. process: 0: no child. Signals that are ignored or
 * have a handler are left alone. */
void interrupt_cleanup_set(enum leaving which, const char *path, int process);

/* Blocks these signals (hold true) while a file or child exists that interrupt_cleanup_set does not know yet, and
 * unblocks them (false). A child inherits the state of its parent. */
void interrupt_cleanup_block(bool hold);

/* For a child between fork and exec: creates a process group, so that the processes it starts are killed with it, and
 * unblocks the signals. */
void interrupt_cleanup_in_child(void);

#endif
