/* Ends the program when an invariant is broken: prints one line for its developers. */
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "base/base.h"

#ifdef __has_feature
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define SANITIZED
#endif
#endif
#if defined __SANITIZE_ADDRESS__ || defined __SANITIZE_THREAD__ || defined SANITIZED
/* Ends the process after a violated invariant. Sanitizers need abort() to print the stack. */
#define LEAVE_BROKEN() abort()
#else
#define LEAVE_BROKEN() _exit(FAILED) /* no exit handlers: other threads are running */
#endif

static void (*remove_half_written)(void);

void invariant_set_cleanup_callback(void (*cleanup)(void)) { remove_half_written = cleanup; }

_Noreturn void invariant_report_violation_and_abort(const char *condition, const char *file, int line,
                                                    const char *function)
{
    static bool reported;
    if (__atomic_exchange_n(&reported, true, __ATOMIC_ACQ_REL))
        for (;;) pause(); /* another thread has reported, and ends the program */
    fprintf(stderr,
            "cleave " CLEAVE_VERSION
            ": broken invariant at %s:%d, %s: %s; this is a fault of the program: please report this line, with "
            "scene.yaml of the results folder; results up to the last checkpoint are complete\n",
            file, line, function, condition);
    fflush(stderr);
    if (remove_half_written) remove_half_written();
    LEAVE_BROKEN();
}
