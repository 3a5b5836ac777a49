/* Prints `cleave help trust`: the guarantees of a run, and the tests that check them. */
#include <stdio.h>

#include "commands.h"

/* A promise about runs, and the names of the tests that check it, separated by blanks. */
struct promise {
    const char *what, *tests;
};

static const struct promise promises[] = {
    {"The same scene gives the same frames and history to the last bit on any number of threads, of one build and one "
     "set of kernels.",
     "test_trust.sh test_sets.sh long_trust.sh long_settings.sh"},
    {"A run that is stopped (SIGINT, SIGTERM, SIGHUP, SIGXCPU, SIGUSR1, SIGUSR2, time.wall) writes a checkpoint and "
     "exits with 130; --resume "
     "gets to the same bits, whatever probes it has.",
     "test_trust.sh test_faults.c"},
    {"So does a run in load steps, stopped between two of them or within one.",
     "test_steps.sh test_steps_contact.sh test_steps_yield.sh test_faults.c long_steps.sh"},
    {"A run that is killed at any moment after its first checkpoint, of step 0, loses what came after its last one and "
     "no more; --resume gets to "
     "the same bits.",
     "test_trust.sh test_faults.c long_trust.sh"},
    {"A call of this program that fails (memory, open, read, write, fsync, close, rename, mkdir) ends a run with one "
     "line and status 1; files "
     "that are there are whole, and --resume gets to the same bits.",
     "test_faults.c long_faults.sh"},
    {"So does a disk that is full, or a file or memory limit. Where a library alone finds no memory while there is "
     "some left, 3 of 100 such runs end without a line of this program: they crash, or have the library's own words; "
     "--resume gets to the same bits then, too.",
     "test_trust.sh test_little_memory.sh long_faults.sh"},
    {"A broken invariant, which is a fault of the program itself, ends a run with one line that says what to report "
     "and status 1; no file stays half-written, and --resume gets to the same bits.",
     "test_ground.c test_faults.c"},
    {"Files and the folders they are named in are synced before anything counts on them.", "test_faults.c"},
    {"Every changed, lost or added byte of a checkpoint, a frame or the file that frames share is found; the older "
     "checkpoint takes over, a lost frame is named.",
     "test_checkpoint.c test_particles_file.c test_faults.c test_guards.sh"},
    {"One run at a time has a folder; older runs, other people's files and what links within the folder lead to "
     "stay as they are; -o itself may be a symbolic link to a folder.",
     "test_guards.sh"},
    {"A run that becomes unstable, folds cells or gains energy stops, reports where and why, and exits with 1. A loss "
     "or gain of more than 5 % of energy, or of the angular momentum of bodies without supports, is reported. No "
     "complete frame or history contains NaN or infinity.",
     "test_stability_checks.c test_diagnostics.c test_bounds.sh test_history.sh test_numbers.c"},
    {"A scene, override or particle list that is wrong is refused in one line with its place and what would be right, "
     "status 2, and leaves "
     "nothing; no bytes whatever make the program crash or hang.",
     "test_refusals.sh test_scene_bad.c test_lists.c long_fuzz.sh"},
    {"Forces are the gradient of one energy, whatever is coupled to whatever, but for the couplings that warn.",
     "test_operator.c test_energy_drift.c"},
    {"No data race, no undefined behaviour, no leak in small scenes; every key and word of scenes stands in one of "
     "them.",
     "long_races.sh long_sanitizers.sh long_valgrind.sh test_features.c"},
};

static const char not_promised[] =
    "Not promised: the same bits from another build, compiler or set of kernels (they agree to round-off); what a file "
    "system forgets that was synced; anything but the last checkpoint where the system kills the program because "
    "memory is short; that HDF5 survives a damaged particle list (it may crash; one line then says so).";

/* Prints `text` to `out`, broken at blanks into lines of at most 100 characters that begin with `indent` blanks. */
static void paragraph(FILE *out, const char *text, int indent)
{
    int column = 0;
    for (const char *word = text; *word;) {
        const int length = (int)strcspn(word, " ");
        if (column > 0 && column + 1 + length > 100) fputc('\n', out), column = 0;
        if (column == 0)
            fprintf(out, "%*s", indent, ""), column = indent;
        else
            fputc(' ', out), column++;
        fprintf(out, "%.*s", length, word);
        column += length;
        word += length + strspn(word + length, " ");
    }
    fputc('\n', out);
}

status help_print_guarantees_and_their_tests(FILE *out)
{
    fputs("What a run promises, and the tests in tests/ that check each promise (those named long_* run by `make "
          "test-long`):\n\n",
          out);
    for (const struct promise *p = promises; p < promises + COUNT_OF(promises); p++) {
        paragraph(out, p->what, 2);
        paragraph(out, p->tests, 6);
    }
    fputc('\n', out);
    paragraph(out, not_promised, 0);
    return ferror(out) ? status_set(FAILED, "help cannot be written") : OK;
}
