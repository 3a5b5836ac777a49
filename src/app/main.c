/* The program: one command, one exit status. */
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "bench/common/bench.h"
#include "plot/plot.h"
#include "commands.h"
#include "base/last_words.h"
#include "output/output.h"
#include "scene/scene.h"
#include "simd/simd.h"

/* Exit without handlers; builds that report as they exit (leaks, coverage) define LEAVE as exit. */
#ifndef LEAVE
#define LEAVE _exit
#endif

struct command { const char *name, *words, *meaning; status (*call)(int argc, char **argv); };

static const struct command commands[] = {
    {"run", "SCENE [-o DIR] [-s KEY=VALUE]... [-t THREADS] [--resume|--overwrite] [-q]", "runs a scene", command_run},
    {"check", "SCENE [-s KEY=VALUE]... [-t THREADS]", "what a scene would cost and whether it is sound", command_check},
    {"sweep", "SCENE -s KEY=VALUE,...|FROM:TO:STEP... [-o DIR] [-j RUNS] [--list] [--collect]",
     "a study: runs, or lists, every combination", command_sweep},
    {"converge", "SCENE [--of FIGURE]... [--budget TIME] [-s KEY=VALUE]... [-o DIR] [-j RUNS]",
     "every figure of a scene with its error bar", command_converge},
    {"plot", "DIR [--frames all|last|N]", "pictures of a finished or running run", command_plot},
    {"compare", "DIR DIR", "how far two runs are apart", command_compare},
    {"bench", "[NAME...] [--quick] [--readme]", "kernels, efficiency, coupling", command_bench},
    {"help", "[KEY|theory|trust]", "every scene key; the equations; what a run promises", command_help},
    {"info", "", "version, build, sets of kernels, threads, cores and caches", command_info},
};

/* `cleave COMMAND --help`. */
static status usage_of(const struct command *c)
{
    printf("cleave %s%s%s\n  %s\n", c->name, *c->words ? " " : "", c->words, c->meaning);
    return OK;
}

static bool wants_help(const char *word) { return !strcmp(word, "--help") || !strcmp(word, "-h"); }

static status usage(status result)
{
    FILE *to = result == OK ? stdout : stderr;
    fprintf(to, "cleave: dynamic fracture by peridynamics and the material point method\n");
    for (const struct command *c = commands; c < commands + COUNT_OF(commands); c++)
        fprintf(to, "  cleave %-8s %-78s %s\n", c->name, c->words, c->meaning);
    return result;
}

status command_help(int argc, char **argv)
{
    if (argc > 2) return status_set(REFUSED, "usage: cleave help [KEY|theory|trust]");
    if (argc == 2 && !strcmp(argv[1], "--manual")) return scene_manual(stdout);
    if (argc == 2 && !strcmp(argv[1], "trust")) return trust_print(stdout);
    if (argc == 2 && !strcmp(argv[1], "theory")) return theory_print(stdout);
    return scene_help(stdout, argc == 2 ? argv[1] : NULL);
}

static status call(int argc, char **argv)
{
    if (argc < 2) return usage(REFUSED);
    output_start();
    TRY(simd_start());
    if (wants_help(argv[1])) return usage(OK);
    if (!strcmp(argv[1], "--version")) argv[1] = "info";
    for (const struct command *c = commands; c < commands + COUNT_OF(commands); c++)
        if (!strcmp(argv[1], c->name))
            return argc == 3 && wants_help(argv[2]) ? usage_of(c) : c->call(argc - 1, argv + 1);
    return status_set(REFUSED, "unknown command %s; cleave --help lists them", argv[1]);
}

/* OpenMP threads wait for each other by spinning, for milliseconds: on a busy machine that slows a run many times
 * over. A short spin is set before the library starts, unless the environment sets it. Two threads on two cores
 * beside two other processes take 0.1 to 0.9 s for plate_hole with it; without it once in ten runs 2 to 23 s. */
static void limit_spin(char **argv)
{
    if (getenv("OMP_WAIT_POLICY") || getenv("GOMP_SPINCOUNT")) return;
    if (setenv("GOMP_SPINCOUNT", "2000", 0) == 0) execv("/proc/self/exe", argv);   /* without /proc the default stays */
}

/* Opens standard descriptors that are closed, as daemons leave them; the next file opened would receive one of them,
 * and all that is printed. */
static void keep_descriptors(void)
{
    int fd;
    do fd = open("/dev/null", O_RDWR);
    while (fd >= 0 && fd <= STDERR_FILENO);
    if (fd > STDERR_FILENO) close(fd);
}

int main(int argc, char **argv)
{
    keep_descriptors();
    limit_spin(argv);
    last_words_start();
    status result = call(argc, argv);
    const bool lost = fflush(stdout) != 0 || ferror(stdout);
    if (lost && result == OK) result = status_set(FAILED, "cannot write to standard output");
    if (result != OK && status_message()[0]) fprintf(stderr, "%s\n", status_message());
    fflush(stderr);
    LEAVE(result);                           /* after failed writes the exit handlers of libraries may crash */
}
