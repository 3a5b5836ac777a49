/* The commands of the program. Arguments: the words after `cleave`, the name of the command first. The return value is
 * the exit status; for any but OK status_message gives the reason. */
#ifndef CLEAVE_COMMANDS
#define CLEAVE_COMMANDS

#include <signal.h>
#include <stdio.h>

#include "base/base.h"

status command_run(int argc, char **argv);
status command_sweep(int argc, char **argv);
status command_converge(int argc, char **argv);
status command_check(int argc, char **argv);
status command_compare(int argc, char **argv);
status command_help(int argc, char **argv);
status command_info(int argc, char **argv);

/* From the first call on signals that ask the program to end set what this returns; the second interrupt ends it at
 * once. */
const volatile sig_atomic_t *stop_signals(void);

/* Pages of `cleave help`: the guarantees of a run and the tests that check them; the equations. */
status trust_print(FILE *out);
status theory_print(FILE *out);

#endif
