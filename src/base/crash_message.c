/* Prints a message if the process ends inside a library. If memory is exhausted, or with some damaged files, HDF5 calls
 * exit(-1) or reads through a NULL pointer, without a message. */
#include "base/crash_message.h"

#include "base/base.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

/* Messages for a process that a library has ended: memory or the stack was exhausted. */
static const char out_of_memory[] =
    "out of memory: a library could not continue; results up to the last checkpoint are complete: continue with "
    "--resume where there is more memory, or with fewer threads (-t), or choose a larger particles.spacing\n";

static const char out_of_stack[] =
    "out of stack memory: its limit is below 1 MB; set the usual limit by `ulimit -s 8192` and run again\n";

/* Path of the file that HDF5 reads at present, without control characters; "": none. */
static char reading[512];

void crash_message_set_file_in_use(const char *path)
{
    const struct printable_name shown = printable_name(path ? path : "");
    memcpy(reading, shown.text, sizeof reading);
}

/* Writes the text `text` to standard error without buffering, until it is complete or a write fails. Safe in a signal
 * handler. */
static void say(const char *text)
{
    for (size_t done = 0, length = strlen(text); done < length;) {
        const ssize_t more = write(STDERR_FILENO, text + done, length - done);
        if (more <= 0) break;
        done += (size_t)more;
    }
}

/* Writes the text `text` to standard error and ends the process at once with the exit status FAILED. Safe in a signal
 * handler. */
static _Noreturn void say_and_leave(const char *text)
{
    say(text);
    _exit(FAILED);
}

/* Reports on standard error that the file being read by HDF5 (`reading`) is damaged, and ends the process with the exit
 * status FAILED. */
static _Noreturn void say_damaged_and_leave(void)
{
    say("cannot read ");
    say(reading);
    say_and_leave(": the HDF5 library crashed while reading this file, which is damaged or of another kind; replace it "
                  "by an undamaged one\n");
}

/* Returns true if 256 MiB of memory cannot be reserved any more, so that an allocation of a library has probably
 * failed. */
static bool memory_is_tight(void)
{
    enum { PLENTY = 256 << 20 };
    void *room = mmap(NULL, PLENTY, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (room == MAP_FAILED) return true;
    munmap(room, PLENTY);
    return false;
}

/* Returns true if the stack limit of the process is below 1 MiB, so that the crash probably is a stack overflow. */
static bool stack_is_tight(void)
{
    enum { ENOUGH = 1 << 20 };
    struct rlimit l;
    return getrlimit(RLIMIT_STACK, &l) == 0 && l.rlim_cur < ENOUGH;
}

/* Handles the signal of a crash with the number `number` (SIGSEGV or SIGBUS): reports the likely cause (stack too
 * small, memory exhausted, damaged file) and ends the process. If there is no likely cause, returns with the default
 * handler installed, so that the fault recurs and ends the process by the signal. */
static void on_crash(int number)
{
    if (stack_is_tight()) say_and_leave(out_of_stack);
    if (memory_is_tight()) say_and_leave(out_of_memory);
    if (reading[0]) say_damaged_and_leave();
    signal(number, SIG_DFL); /* the fault recurs, and ends the process as usual */
}

/* Exit handler, registered with on_exit: reports that memory is exhausted if a library has called exit(-1), as HDF5
 * does then. The program itself ends by _exit, which calls no handlers. result: exit status of the process. */
#ifdef __GLIBC__
static void on_library_exit(int result, void *unused)
{
    (void)unused;
    if ((result & 0xFF) == 0xFF) say_and_leave(out_of_memory);
}
#endif

void crash_message_install_signal_handlers(void)
{
    static char room[1 << 16]; /* the handler needs a separate stack if the stack cannot grow */
    const stack_t apart = {.ss_sp = room, .ss_size = sizeof room};
    const struct sigaction action = {.sa_handler = on_crash, .sa_flags = SA_ONSTACK};
    sigaltstack(&apart, NULL);
    sigaction(SIGSEGV, &action, NULL);
    sigaction(SIGBUS, &action, NULL);
#ifdef __GLIBC__
    on_exit(on_library_exit, NULL);
#endif
}
