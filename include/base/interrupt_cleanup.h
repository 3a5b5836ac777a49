/* Temporary files and child processes that must not outlive a process ended by a signal. */
#ifndef CLEAVE_INTERRUPT_CLEANUP
#define CLEAVE_INTERRUPT_CLEANUP

#include <stdbool.h>

/* Kinds of temporary files that are removed if a signal ends the process. LEAVING_PICTURE: picture that gnuplot draws;
 * LEAVING_FRAME: picture of one frame of an animation, or of a report page; LEAVING_FILM: animation. LEAVINGS: number
 * of kinds. */
enum cleanup_kind { LEAVING_PICTURE, LEAVING_FRAME, LEAVING_FILM, LEAVINGS };

/* Sets what is cleaned up if SIGINT, SIGTERM or SIGHUP ends this process: first the child with the id
 * `child_process_id` (0: none) is killed with all processes that it started, then the file `file_to_remove` (copied;
 * NULL: none) is removed. kind: kind of file; a second call with this kind replaces the first. A signal that is ignored
 * or already has a handler is not handled. */
void interrupt_cleanup_register(enum cleanup_kind kind, const char *file_to_remove, int child_process_id);

/* Blocks SIGINT, SIGTERM and SIGHUP in the calling thread if `block` is true, else unblocks them. The signals are to be
 * blocked while a temporary file or child process exists that has not yet been passed to interrupt_cleanup_register. A
 * child process inherits the block. */
void interrupt_signals_block(bool block);

/* Prepares a child process, between fork and exec: puts it into a process group of its own, so that processes that it
 * starts are killed with it, and unblocks SIGINT, SIGTERM and SIGHUP. */
void child_process_set_group_and_unblock_signals(void);

#endif
