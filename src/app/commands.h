/* Declares the commands of the program. The arguments of a command are the words after `cleave`, with its name first.
 * The return value is the exit status; unless it is OK, status_message returns the reason. */
#ifndef CLEAVE_COMMANDS
#define CLEAVE_COMMANDS

#include <signal.h>
#include <stdio.h>

#include "base/base.h"

/* A command of the program: name, form of its arguments (`words`), meaning in words, and function `call`, whose
 * arguments are the words after `cleave` (argv[0]: the name of the command). Usage line, manual and completion are made
 * from `words`, in which names in capitals stand for values. */
struct command {
    const char *name, *words, *meaning;
    status (*call)(int argc, char **argv);
};
extern const struct command commands[];
extern const int commands_count;

/* Usage texts of commands: the words that may follow the name of the command. Commands also print them if a word is
 * wrong. */
#define RUN_WORDS "SCENE [-o DIR] [-s KEY=VALUE]... [-t THREADS] [--resume|--overwrite] [--report] [-q]"
#define CHECK_WORDS "SCENE [-s KEY=VALUE]... [-t THREADS] [--no-trial]"
#define SWEEP_WORDS                                                                                                    \
    "SCENE -s KEY=VALUE,...|FROM:TO:STEP... [--of FIGURE]... [--size WxH|WmmxHmm] [--dpi N] [--format png|svg|pdf] "   \
    "[-o DIR] [-j RUNS] "                                                                                              \
    "[-t THREADS] [--list] [--collect] [--overwrite] [-q]"
#define CONVERGE_WORDS                                                                                                 \
    "SCENE [--of FIGURE]... [--budget TIME] [--levels COUNT] [--runs COUNT] [--horizon] [-s KEY=VALUE]... [-o DIR] "   \
    "[-j RUNS] [-t THREADS] [--size WxH|WmmxHmm] [--dpi N] [--format png|svg|pdf] [--overwrite] [-q]"
#define PLOT_WORDS                                                                                                     \
    "DIR [--field NAME] [--times T,...|all|last] [--frames all|last|N] [--slice z=4mm] [--view iso|x+|x-|...|z-] "     \
    "[--range LOW:HIGH] [--colours NAME] [--magnify N] [--crop X:X,Y:Y] [--title TEXT] [--size WxH|WmmxHmm] "          \
    "[--dpi N] [--fps N] [--format png|svg|pdf|mp4|gif] [-o FILE|FOLDER] [--overwrite], or --scene SCENE [-s "         \
    "KEY=VALUE]... "                                                                                                   \
    "[--view V] "                                                                                                      \
    "[-o FILE] [--overwrite]"
#define REPORT_WORDS "DIR [-o PAGE.html] [--overwrite] [-q]"
#define EXPORT_WORDS                                                                                                   \
    "lammps SCENE -o DIR [-s KEY=VALUE]... [-t THREADS] [--style peri|bpm] [--allow-different] "                       \
    "[--overwrite], or exodus SCENE|DIR -o FILE [-s KEY=VALUE]... [--overwrite]"

status command_run_main(int argc, char **argv);
status command_sweep_main(int argc, char **argv);
status command_converge_main(int argc, char **argv);
status command_check_main(int argc, char **argv);
status command_plot_main(int argc, char **argv);
status command_report_main(int argc, char **argv);
status command_compare_main(int argc, char **argv);
status command_new_main(int argc, char **argv);
status command_export_main(int argc, char **argv);
status command_help_main(int argc, char **argv);
status command_info_main(int argc, char **argv);

/* Finds the command called `name` and stores a pointer to its entry of `commands` in *found. Returns REFUSED, with the
 * most similar name in the message, if there is none. */
status command_find_by_name(const char *name, const struct command **found);

/* Installs handlers for SIGINT, SIGTERM, SIGHUP, SIGXCPU, SIGUSR1 and SIGUSR2, except those that the parent process
 * ignores. Returns a pointer to the flag that the handlers set to 1, which requests an orderly end of the command. A
 * second signal ends the program at once if it is one of the first three. */
const volatile sig_atomic_t *stop_signals_install_handlers(void);

/* Prints one line with the version of the program and the commit of its source to `out`. */
void version_print(FILE *out);

/* Prints the text of `cleave --help` to `out`. */
void usage_print(FILE *out);

/* Prints the text of `cleave COMMAND --help` for the command c to `out`. */
void usage_print_of_command(FILE *out, const struct command *c);

/* Returns true if `word`, a word of the command line, is -h or --help. */
static inline bool word_is_help_option(const char *word)
{
    return (word[0] == '-' && word[1] == 'h' && !word[2]) || __builtin_strcmp(word, "--help") == 0;
}

/* Prints the page `cleave help trust` to `out`: guarantees of a run, and the tests that check them. Returns FAILED if
 * it cannot be written. */
status help_print_guarantees_and_their_tests(FILE *out);

/* Prints the page `cleave help theory` to `out`: the equations with their sources. Returns FAILED if it cannot be
 * written. */
status help_print_theory(FILE *out);

/* Prints the page `cleave help run` to `out`: options, files and exit statuses of a run. Returns FAILED if it cannot be
 * written. */
status help_print_run_options_files_and_exit_codes(FILE *out);

/* Prints the manual page cleave.1 to `out`, in troff. Returns FAILED if it cannot be written. */
status manual_print(FILE *out);

/* Finds the JSON schema of input files, in the installation or else in the build folder of the program, and writes its
 * path to path[capacity]. Returns false if neither has one or the path is too long. */
bool json_schema_find_file_path(char *path, size_t capacity);

/* Finds the folder `inputs` of manual and input files, in the installation or else in the source tree of the program,
 * and writes its path to path[capacity]. Returns false if neither has one or the path is too long. */
bool inputs_folder_find_path(char *path, size_t capacity);

/* Prints to `out` the names of the kinds of input files that the command `cleave new` can create, separated by blanks.
 */
void command_new_print_names_of_scene_kinds(FILE *out);

/* Prints to `out` a script by which a shell completes the commands, options and keys of the program. shell: name of the
 * shell, bash or zsh. Returns REFUSED, with a message, for another shell. */
status completion_print_shell_script(FILE *out, const char *shell);

#endif
