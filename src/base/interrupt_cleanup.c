/* Removes temporary files and ends child processes when a signal ends the process. */
#include "base/interrupt_cleanup.h"

#include <pthread.h>
#include <signal.h>
#include <string.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

enum { PATH_LONGEST = 4200 }; /* room for the path of a file to be removed [byte] */

/* The temporary files and child processes that a signal handler removes and ends. While an element of `path` is being
 * written, its first character is 0, so that the handler never reads an incomplete path. */
static struct {
    volatile sig_atomic_t process;
    char path[PATH_LONGEST];
} leavings[LEAVINGS];

static pthread_t maker; /* the thread that makes files and children */

/* Handles the signal `number`, which ends the process. First ends the child processes and waits for them, since they
 * could otherwise create their files again. Then removes the temporary files, and ends the process by the same signal.
 * Only the thread `maker` creates files and children. If the signal reaches another thread, it is forwarded to `maker`,
 * which would otherwise go on creating them. Calls only functions that are safe in a signal handler. */
static void on_end(int number)
{
    if (!pthread_equal(pthread_self(), maker)) {
        pthread_kill(maker, number);
        return;
    }
    for (int k = 0; k < LEAVINGS; k++) {
        if (leavings[k].process > 0 && kill(-(pid_t)leavings[k].process, SIGKILL) == 0)
            waitpid((pid_t)leavings[k].process, NULL, 0);
        if (leavings[k].path[0]) unlink(leavings[k].path);
    }
    signal(number, SIG_DFL);
    raise(number);
}

static const int ends[] = {SIGINT, SIGTERM, SIGHUP}; /* signals that end the process */

/* Prepares the cleaning up after signals at the first call; later calls do nothing. Records the calling thread as
 * `maker`, the one that creates files and child processes, and installs the handler on_end for every signal that would
 * end the process by default. */
static void leavings_watch(void)
{
    static bool watched;
    if (!watched) maker = pthread_self();
    for (size_t k = 0; k < sizeof ends / sizeof *ends && !watched; k++) {
        struct sigaction action;
        if (sigaction(ends[k], NULL, &action) == 0 && action.sa_handler == SIG_DFL) signal(ends[k], on_end);
    }
    watched = true;
}

void interrupt_cleanup_register(enum cleanup_kind kind, const char *file_to_remove, int child_process_id)
{
    leavings_watch();
    leavings[kind].process = 0;
    leavings[kind].path[0] = '\0';
    if (file_to_remove && strlen(file_to_remove) < PATH_LONGEST) strcpy(leavings[kind].path, file_to_remove);
    if (child_process_id > 0)
        setpgid(child_process_id,
                child_process_id); /* as child_process_set_group_and_unblock_signals, whichever is first */
    leavings[kind].process = child_process_id;
}

void interrupt_signals_block(bool block)
{
    sigset_t these;
    sigemptyset(&these);
    for (size_t k = 0; k < sizeof ends / sizeof *ends; k++) sigaddset(&these, ends[k]);
    pthread_sigmask(block ? SIG_BLOCK : SIG_UNBLOCK, &these, NULL);
}

void child_process_set_group_and_unblock_signals(void)
{
    setpgid(0, 0);
    interrupt_signals_block(false);
}
