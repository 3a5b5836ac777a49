/* `cleave bench`: table of the benches, and their selection. */
#include <stdio.h>
#include <string.h>

#include "bench.h"

struct bench {
    const char *name;
    status (*call)(bool quick);
    bool apart; /* runs only if its full name is given */
};

/* Benches in the order in which they run: kernels first, while the process is small. NAME=PART: also run with NAME. */
/* clang-format off */
static const struct bench benches[] = {
    {"kernels", bench_kernels, false},         {"efficiency", bench_efficiency, false},
    {"coupling", bench_coupling, false},       {"sif", bench_sif, false},
    {"threads", bench_threads, false},         {"scale", bench_scale, false},
    {"scale=growth", bench_growth, false},     {"scale=finest", bench_growth_finest, true},
    {"scale=field", bench_far_field, false},   {"peers", bench_peers, false},
    {"accuracy", bench_accuracy, false},       {"stability", bench_stability, false},
    {"sensitivity", bench_sensitivity, false}, {"steps", bench_steps, false},
    {"contact", bench_contact, false},         {"absorbing", bench_absorbing, false},
    {"uncertainty", bench_uncertainty, false}, {"pilot", bench_pilot, false},
    {"slow", bench_slow, false},
    {"experiments", bench_experiments, true}};
/* clang-format on */
enum { BENCHES = COUNT_OF(benches) };

/* Names used in earlier versions. */
static const struct {
    const char *old, *name;
} renamed[] = {{"factors", "sif"}, {"scatter", "sensitivity"}};

/* Prefixes of partial benches. `accuracy=NAME`: a single problem, or another argument of bench_accuracy_of;
 * `stability=lasting`, or a part of the name of a case: only its long map. */
static const char accuracy_of[] = "accuracy=", stability_of[] = "stability=";

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
    return status_set(REFUSED,
                      "unknown bench %s; usage: cleave bench [kernels] [efficiency] [coupling] [sif] [threads] "
                      "[scale[=growth|=finest|=field]] [peers] [accuracy[=PROBLEM|=chart|=auto]] "
                      "[stability[=lasting|=CASE]] [sensitivity] [steps] [contact] [absorbing] [uncertainty] [pilot] "
                      "[slow] [experiments] "
                      "[--quick] [--readme]",
                      word);
}

/* Runs one bench. With `readme` its output and tables are also written to bench/results. FAILED or REFUSED if the
 * bench is. */
static status bench_call(const struct bench *b, bool quick, bool readme)
{
    struct bench_results r;
    char files[64]; /* name of its files: of a part of a bench that of the whole */
    snprintf(files, sizeof files, "%.*s", (int)strcspn(b->name, "="), b->name);
    TRY(bench_guard(files)); /* before minutes of measurement */
    if (!readme) return b->call(quick);
    TRY(bench_results_begin(&r, b->name, quick));
    return bench_results_end(&r, b->name, b->call(quick));
}

status command_bench(int argc, char **argv)
{
    bool asked[BENCHES] = {false}, quick = false, readme = false, any = false;
    const char *only = NULL, *lasting = NULL;
    for (int k = 1; k < argc; k++) {
        const bool faster = !strcmp(argv[k], "--quick"), written = !strcmp(argv[k], "--readme");
        quick |= faster, readme |= written;
        if (faster || written) continue;
        if (!strncmp(argv[k], accuracy_of, strlen(accuracy_of)))
            only = argv[k] + strlen(accuracy_of);
        else if (!strncmp(argv[k], stability_of, strlen(stability_of)))
            lasting = argv[k] + strlen(stability_of);
        else
            TRY(bench_mark(argv[k], asked));
        any = true;
    }
    for (int k = 0; k < BENCHES; k++)
        if (asked[k] || (!any && !benches[k].apart)) TRY(bench_call(&benches[k], quick, readme));
    if (lasting) TRY(bench_stability_of(lasting, quick));
    return only ? bench_accuracy_of(only, quick) : OK;
}
