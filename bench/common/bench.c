/* `cleave bench`: table of the benches, and their selection. */
#include <stdio.h>
#include <string.h>

#include "bench.h"

struct bench {
    const char *name;
    status (*call)(bool quick);
    bool apart; /* runs only if its full name is given */
    const char *what;
};

/* Benches in the order in which `all` runs them: kernels first, while the process is small. An entry NAME=PART is a
 * part of the bench NAME and also runs with it. */
/* clang-format off */
static const struct bench benches[] = {
    {"kernels", bench_kernels, false, "time of every kernel beside the limits of the machine"},
    {"efficiency", bench_efficiency, false, "adaptive runs beside peridynamic ones: time, crack path"},
    {"coupling", bench_coupling, false, "interfaces of points and bonds: waves, uniform strain"},
    {"sif", bench_sif, false, "stress-intensity factors beside closed forms and tables"},
    {"threads", bench_threads, false, "speed-up by threads, with the memory bandwidth"},
    {"scale", bench_scale, false, "time and memory per particle, from 1e4 to 1e7 particles"},
    {"scale=growth", bench_growth_of_cost_with_resolution, false, "cost by resolution in Kalthoff's plate"},
    {"scale=finest", bench_growth_of_cost_to_finest_spacing, true, "the same at the finest spacing"},
    {"scale=field", bench_cost_of_coarse_far_field, false, "coarse cells and absorbing faces far from a crack"},
    {"peers", bench_peers, false, "the same plate and block in LAMMPS"},
    {"peers=bar", bench_taylor_bar, false, "a copper Taylor bar beside the recorded time of MPM3D-F90"},
    {"accuracy", bench_accuracy, false, "error against computing time; accuracy=PROBLEM, =chart, =auto: a part"},
    {"stability", bench_stability, false, "largest stable time steps; stability=lasting, =CASE: a part"},
    {"sensitivity", bench_sensitivity, false, "scatter of crack paths with the time step"},
    {"steps", bench_steps, false, "start, length and angle of cracks by time step"},
    {"contact", bench_contact, false, "collisions beside closed forms"},
    {"absorbing", bench_absorbing, false, "reflection of waves by absorbing faces"},
    {"uncertainty", bench_uncertainty, false, "error bars of cleave converge beside exact values"},
    {"pilot", bench_pilot, false, "errors of method: auto beside the requested ones"},
    {"laws", bench_laws, false, "metals that flow beside closed forms and published values"},
    {"circles", bench_circles, false, "strength: the nine circles of brittle fracture; circles=NAME: a part"},
    {"slow", bench_slow, false, "load steps beside linear elastic fracture mechanics"},
    {"experiments", bench_experiments, true, "published experiments and other codes; hours"}};
/* clang-format on */
enum { BENCHES = COUNT_OF(benches) };

/* Names that benches had in earlier versions. */
static const struct {
    const char *old, *name;
} renamed[] = {{"factors", "sif"}, {"scatter", "sensitivity"}};

/* Arguments of the form NAME=WORD, which run a part of the bench NAME. accuracy=WORD: name of a problem, or another
 * word that bench_accuracy_of_problem accepts. stability=WORD: `lasting`, or a part of the names of cases, of which
 * only the map of long runs is then made. circles=WORD: a part of the names of circles. */
struct bench_part {
    const char *start;
    status (*call)(const char *word, bool quick);
    const char *word; /* the word that is given, or NULL */
};
static const struct bench_part bench_parts[] = {{"circles=", bench_circles_of_name, NULL},
                                                {"stability=", bench_stability_of_energy, NULL},
                                                {"accuracy=", bench_accuracy_of_problem, NULL}};
enum { PARTS = COUNT_OF(bench_parts) };

/* Tests whether an argument has the form NAME=WORD with the NAME of an entry of part[PARTS], and stores WORD in this
 * entry. Returns false if it does not. */
static bool bench_part_mark(const char *argument, struct bench_part *part)
{
    for (int k = 0; k < PARTS; k++) {
        const size_t length = strlen(part[k].start);
        if (strncmp(argument, part[k].start, length) != 0) continue;
        part[k].word = argument + length;
        return true;
    }
    return false;
}

static status bench_mark(const char *word, bool *asked)
{
    for (size_t k = 0; k < COUNT_OF(renamed); k++)
        if (!strcmp(word, renamed[k].old)) {
            printf("cleave bench %s is now cleave bench %s\n", word, renamed[k].name);
            word = renamed[k].name;
        }
    bool known = false;
    const size_t length = strlen(word);
    for (int k = 0; k < BENCHES; k++) {
        const bool whole = !strcmp(word, benches[k].name);
        const bool part = !strncmp(word, benches[k].name, length) && benches[k].name[length] == '=';
        if (whole || (part && !benches[k].apart)) asked[k] = known = true;
    }
    if (known) return OK;
    return status_set(REFUSED, "unknown bench %s; `cleave bench` lists the names, --quick and --readme are options",
                      word);
}

/* Runs bench b. quick: true for smaller cases; readme: true to write its output and tables also to bench/results.
 * Returns FAILED or REFUSED if the bench does, or if files cannot be written. */
static status bench_call(const struct bench *b, bool quick, bool readme)
{
    struct bench_results r;
    char files[64]; /* name of its files: of a part of a bench that of the whole */
    snprintf(files, sizeof files, "%.*s", (int)strcspn(b->name, "="), b->name);
    TRY(bench_check_files_may_be_replaced(files)); /* before minutes of measurement */
    if (!readme) return b->call(quick);
    TRY(bench_results_begin(&r, b->name, quick));
    return bench_results_end(&r, b->name, b->call(quick));
}

/* Prints the names of all benches, each with what it measures. */
static void benches_print(void)
{
    printf("cleave bench NAME... [--quick] [--readme] measures; names:\n");
    for (int k = 0; k < BENCHES; k++) printf("  %-14s %s\n", benches[k].name, benches[k].what);
    printf("  %-14s %s\n", "all", "these but scale=finest and experiments, one after the other: hours");
}

status command_bench(int argc, char **argv)
{
    bool asked[BENCHES] = {false}, quick = false, readme = false, any = false, all = false;
    struct bench_part part[PARTS];
    memcpy(part, bench_parts, sizeof part);
    for (int k = 1; k < argc; k++) {
        const bool faster = !strcmp(argv[k], "--quick"), written = !strcmp(argv[k], "--readme");
        quick |= faster, readme |= written;
        if (faster || written) continue;
        if (!strcmp(argv[k], "all"))
            all = true;
        else if (!bench_part_mark(argv[k], part))
            TRY(bench_mark(argv[k], asked));
        any = true;
    }
    if (!any) return benches_print(), OK;
    for (int k = 0; k < BENCHES; k++)
        if (asked[k] || (all && !benches[k].apart)) TRY(bench_call(&benches[k], quick, readme));
    for (int k = 0; k < PARTS; k++)
        if (part[k].word) TRY(part[k].call(part[k].word, quick));
    return OK;
}
