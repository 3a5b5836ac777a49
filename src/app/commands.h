/* floor 5: the commands of the program. Each gets the words after `cleave`, its own name first; what it returns is
 * the exit status, and on anything but OK the message says why. */
#ifndef CLEAVE_COMMANDS_H
#define CLEAVE_COMMANDS_H

#include "base/base.h"

status command_run(int argc, char **argv);
status command_check(int argc, char **argv);
status command_plot(int argc, char **argv);
status command_compare(int argc, char **argv);
status command_bench(int argc, char **argv);
status command_help(int argc, char **argv);
status command_info(int argc, char **argv);

#endif
