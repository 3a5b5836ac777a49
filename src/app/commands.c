/* Defines the table of commands, from which the program, its usage, manual and completion are made. */
#include <stdio.h>
#include <string.h>

#include "base/edit_distance.h"
#include "bench/common/bench.h"
#include "commands.h"
#include "parts.h"

#ifndef WITH_BENCHES
static status no_benches(int argc, char **argv)
{
    (void)argc, (void)argv;
    return status_set(REFUSED, "this program was built by `make run` and has no benches; run `make` to build them");
}
#define command_bench no_benches
#endif

const struct command commands[] = {
    {"run", RUN_WORDS, "runs a scene", command_run_main},
    {"check", CHECK_WORDS, "what a scene would cost, and likely mistakes", command_check_main},
    {"new", "NAME [KIND]", "writes a commented scene to begin with, of a kind; alone it lists the kinds",
     command_new_main},
    {"sweep", SWEEP_WORDS, "a study: runs, or lists, every combination", command_sweep_main},
    {"converge", CONVERGE_WORDS, "every figure of a scene with its error bar", command_converge_main},
    {"plot", PLOT_WORDS, "pictures of a finished or running run; of a scene before it runs", command_plot_main},
    {"report", REPORT_WORDS, "a run or a study as one page for a browser", command_report_main},
    {"compare", "DIR DIR", "how much two runs differ", command_compare_main},
    {"export", EXPORT_WORDS, "a scene as input of LAMMPS, or a scene or a run as an Exodus II file",
     command_export_main},
    {"bench", "[NAME...] [--quick] [--readme]", "measures; without a name it lists what there is", command_bench},
    {"help", "[KEY|scene|units|expression|run|theory|trust]",
     "every scene key; units; formulas; a run; the equations; what a run promises", command_help_main},
    {"info", "", "version, build, sets of kernels, threads, cores and caches", command_info_main},
};
const int commands_count = COUNT_OF(commands);

status command_find_by_name(const char *name, const struct command **found)
{
    const struct command *nearest = commands;
    for (int k = 0; k < commands_count; k++) {
        *found = &commands[k];
        if (!strcmp(name, commands[k].name)) return OK;
        if (edit_distance(name, commands[k].name) < edit_distance(name, nearest->name)) nearest = &commands[k];
    }
    if (word_is_probable_misspelling_of(name, nearest->name))
        return status_set(REFUSED, "unknown command %.40s; did you mean %s?", name, nearest->name);
    return status_set(REFUSED, "unknown command %.40s; `cleave --help` lists the commands", name);
}
