/* Handles signals that request the orderly end of a command. */
#include <signal.h>
#include <unistd.h>

#include "commands.h"

/* True once a signal has requested a checkpoint and the end of the run or study. Set by signal handlers. */
static volatile sig_atomic_t stop_asked;

static void on_signal(int number)
{
    if (stop_asked) _exit(128 + number); /* the second signal ends the program at once */
    stop_asked = 1;
}

/* Handles the signals that batch systems send before the end of a job: requests the end of the run. Further such
 * signals have no effect, since some systems send them every second. number: number of the signal. */
static void on_notice(int number)
{
    (void)number;
    stop_asked = 1;
}

/* Installs the handlers of all signals that request the end of a command. A signal that the parent process ignores
 * stays ignored, as nohup and `&` in a script require. */
static void listen_to_signals(void)
{
    static const struct {
        int number;
        void (*handler)(int);
    } heard[] = {{SIGINT, on_signal},  {SIGTERM, on_signal}, {SIGHUP, on_signal},
                 {SIGXCPU, on_notice}, {SIGUSR1, on_notice}, {SIGUSR2, on_notice}};
    for (size_t k = 0; k < COUNT_OF(heard); k++) {
        const struct sigaction action = {.sa_handler = heard[k].handler};
        struct sigaction before;
        if (sigaction(heard[k].number, NULL, &before) == 0 && before.sa_handler != SIG_IGN)
            sigaction(heard[k].number, &action, NULL);
    }
}

const volatile sig_atomic_t *stop_signals_install_handlers(void)
{
    static bool listens;
    if (!listens) listen_to_signals();
    listens = true;
    return &stop_asked;
}
