/* Runs one command and returns its exit status. */
#include <fcntl.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "commands.h"
#include "commit.h"
#include "base/output_filter.h"
#include "base/crash_message.h"
#include "base/program_commit.h"
#include "output/output.h"
#include "simd/simd.h"

/* Defines LEAVE, the function that ends the process: _exit, which calls no exit handlers. Builds that report at exit
 * (leaks, coverage) define LEAVE as exit. */
#ifndef LEAVE
#define LEAVE _exit
#endif

/* Returns true if -h or --help is among the words argv[2 .. argc - 1] after a command, unless it is the value of an
 * option of one letter. */
static bool asks_help(int argc, char **argv)
{
    bool asks = false;
    for (int k = 2; k < argc; k++)
        asks |= word_is_help_option(argv[k]) && (k == 2 || argv[k - 1][0] != '-' || strlen(argv[k - 1]) != 2);
    return asks;
}

/* Checks that no word argv[2 .. argc - 1] after the command has the form --option=value, unless it is the value of an
 * option. Returns OK, or REFUSED with a message. */
static status check_no_value_is_joined(int argc, char **argv)
{
    for (int k = 2; k < argc; k++) {
        const char *word = argv[k], *equals = strchr(word, '=');
        if (strncmp(word, "--", 2) != 0 || !equals || (k > 2 && argv[k - 1][0] == '-')) continue;
        return status_set(REFUSED, "%s: put a space between the option and its value: %.*s %s",
                          printable_name(word).text, (int)(equals - word), word, printable_name(equals + 1).text);
    }
    return OK;
}

static status call(int argc, char **argv)
{
    const struct command *c;
    if (argc < 2) return usage_print(stderr), REFUSED;
    output_install_signal_handling_for_file_writes();
    TRY(simd_select_kernels_for_processor());
    if (word_is_help_option(argv[1])) return usage_print(stdout), OK;
    if (!strcmp(argv[1], "--version")) return version_print(stdout), OK;
    TRY(command_find_by_name(argv[1], &c));
    if (asks_help(argc, argv)) return usage_print_of_command(stdout, c), OK;
    TRY(check_no_value_is_joined(argc, argv));
    return c->call(argc - 1, argv + 1);
}

/* Sets a short spin of waiting OpenMP threads by the environment variable GOMP_SPINCOUNT and restarts the program with
 * its arguments argv. Does nothing if the environment sets GOMP_SPINCOUNT or OMP_WAIT_POLICY. By default threads wait
 * for each other by spinning for milliseconds, which slows a run many times over on a busy machine. Measured for
 * plate_hole with two threads on two cores next to two other processes: 0.1 to 0.9 s with a short spin; without it 2 to
 * 23 s in one of ten runs. */
static void limit_spin(char **argv)
{
    if (getenv("OMP_WAIT_POLICY") || getenv("GOMP_SPINCOUNT")) return;
    if (setenv("GOMP_SPINCOUNT", "2000", 0) == 0) execv("/proc/self/exe", argv); /* without /proc the default remains */
}

/* Opens the descriptors of standard input, output and error on /dev/null if they are closed, as they are under daemons.
 * Otherwise the next file to be opened would get such a descriptor, and printed text would be written to it. */
static void keep_descriptors(void)
{
    int fd;
    do fd = open("/dev/null", O_RDWR);
    while (fd >= 0 && fd <= STDERR_FILENO);
    if (fd > STDERR_FILENO) close(fd);
}

/* Returns true if standard output is a pipe whose reader has ended, so that nothing can be printed any more. */
static bool reader_gone(void)
{
    struct pollfd output = {STDOUT_FILENO, POLLOUT, 0};
    return poll(&output, 1, 0) > 0 && (output.revents & POLLERR);
}

int main(int argc, char **argv)
{
    keep_descriptors();
    limit_spin(argv);
    crash_message_install_signal_handlers();
    standard_streams_replace_control_characters();
    program_commit_set(CLEAVE_COMMIT);
    status result = call(argc, argv);
    const bool lost = fflush(stdout) != 0 || ferror(stdout);
    if (lost && reader_gone()) LEAVE(FAILED); /* as in `cleave help | head` */
    if (lost && result == OK) result = status_set(FAILED, "cannot write to standard output");
    if (result != OK && status_message()[0]) fprintf(stderr, "%s\n", status_message());
    fflush(stderr);
    LEAVE(result); /* after failed writes, exit handlers of libraries can crash */
}
