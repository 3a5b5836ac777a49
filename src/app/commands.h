/* The commands of the program. Arguments: the words after `cleave`, the name of the command first. The return value is
 * the exit status; for any but OK status_message gives the reason. */
#ifndef CLEAVE_COMMANDS
#define CLEAVE_COMMANDS

#include <signal.h>
#include <stdio.h>

#include "base/base.h"

/* `words`: the form of the arguments, from which usage, manual and completion are made: names in capitals stand for
 * values, an option is followed by the one that it takes. */
struct command {
    const char *name, *words, *meaning;
    status (*call)(int argc, char **argv);
};
extern const struct command commands[];
extern const int commands_count;

/* Forms of commands that say them when a word is wrong, too. */
#define CHECK_WORDS "SCENE [-s KEY=VALUE]... [-t THREADS] [--no-trial]"
#define SWEEP_WORDS                                                                                                    \
    "SCENE -s KEY=VALUE,...|FROM:TO:STEP... [-o DIR] [-j RUNS] [-t THREADS] [--list] [--collect] [--overwrite] [-q]"
#define CONVERGE_WORDS                                                                                                 \
    "SCENE [--of FIGURE]... [--budget TIME] [--levels COUNT] [--runs COUNT] [--horizon] [-s KEY=VALUE]... [-o DIR] "   \
    "[-j RUNS] [-t THREADS] [--overwrite] [-q]"
#define PLOT_WORDS                                                                                                     \
    "DIR [--field NAME] [--times T,...|all|last] [--frames all|last|N] [--slice z=4mm] [--view iso|x+|x-|...|z-] "     \
    "[--format png|svg|pdf|mp4|gif] [-o FILE] [--overwrite], or --scene SCENE [-s KEY=VALUE]... [--view V] "           \
    "[-o FILE] [--overwrite]"
#define EXPORT_WORDS                                                                                                   \
    "lammps SCENE -o DIR [-s KEY=VALUE]... [-t THREADS] [--style peri|bpm] [--allow-different] "                       \
    "[--overwrite]"

status command_run(int argc, char **argv);
status command_sweep(int argc, char **argv);
status command_converge(int argc, char **argv);
status command_check(int argc, char **argv);
status command_plot(int argc, char **argv);
status command_compare(int argc, char **argv);
status command_new(int argc, char **argv);
status command_export(int argc, char **argv);
status command_help(int argc, char **argv);
status command_info(int argc, char **argv);

/* The command of this name. REFUSED with the nearest name. */
status command_find(const char *name, const struct command **found);

/* From the first call on signals that ask the program to end set what this returns; the second interrupt ends it at
 * once. */
const volatile sig_atomic_t *stop_signals(void);

/* Sets the commit of the source tree that `cleave --version` and `cleave info` print; "" (the initial value): none is
 * printed. `name` is kept by reference. Only the program's main file knows the commit, so that no test is linked anew
 * when it changes. */
void version_commit(const char *name);

/* Prints one line: version and commit. */
void version_print(FILE *out);

/* `cleave --help` and `cleave COMMAND --help`. */
void usage_print(FILE *out);
void usage_print_of(FILE *out, const struct command *c);
static inline bool wants_help(const char *word)
{
    return (word[0] == '-' && word[1] == 'h' && !word[2]) || __builtin_strcmp(word, "--help") == 0;
}

/* Prints the page `cleave help trust`: guarantees of a run, and the tests that check them. Returns FAILED if it cannot
 * be written, as do the pages below. */
status trust_print(FILE *out);

/* Prints the page `cleave help theory`: the equations with their sources. */
status theory_print(FILE *out);

/* Prints the page `cleave help run`: options, files and exit statuses of a run. */
status manual_run_print(FILE *out);

/* Prints the manual page cleave.1 (troff). */
status manual_print(FILE *out);

/* The schema of scenes beside the program, installed or built; false: it is not there (schema_path.c). */
bool schema_path(char *path, size_t room);

/* The kinds of `cleave new`, with blanks between them. */
void new_kinds_print(FILE *out);

/* Completion of commands, options, keys and words for `bash` or `zsh`, as a script. REFUSED for another shell. */
status completion_print(FILE *out, const char *shell);

#endif
