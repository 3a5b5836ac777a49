/* Runs of the program in a child process whose calls are counted and disturbed, for test_faults.c. */
#ifndef CLEAVE_TEST_FAULT_RUNS
#define CLEAVE_TEST_FAULT_RUNS

#include <errno.h>
#include <fcntl.h>
#include <ftw.h>
#include <libgen.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "fault_scenes.h"
#include "same_files.h"
#include "scene/scene.h"
#include "trees.h"

enum {
    NAME = 256,
    SIGNAL = 1000,
    PATIENCE = 20
}; /* SIGNAL + 9: ended by signal 9; PATIENCE: seconds after which a
    * run counts as hanging */

static const struct fault_plan undisturbed = {.deed = DO_NOTHING};

static long *count; /* counters of the last run, in shared memory */
static int wrong;   /* number of failures of this process */

static void complain(const char *format, ...)
{
    va_list words;
    va_start(words, format);
    fputs("test_faults: ", stdout);
    vprintf(format, words);
    putchar('\n');
    va_end(words);
    wrong++;
}

/* ---- files ------------------------------------------------------------------------------------------------------- */

/* Paths of a run of Cleave: its output folder, its scene file, and the file that receives its standard error. */
struct place {
    char folder[NAME], scene[NAME], said[NAME];
};

static struct place place_of(const char *name, const struct fault_scene *s)
{
    struct place p;
    snprintf(p.folder, sizeof p.folder, "%s.%s", s->name, name);
    snprintf(p.scene, sizeof p.scene, "%s.yaml", s->name);
    snprintf(p.said, sizeof p.said, "%s.%s.err", s->name, name);
    return p;
}

static void scene_put(const struct fault_scene *s)
{
    FILE *f = fopen(place_of("", s).scene, "w");
    if (!f || fputs(s->text, f) < 0 || fclose(f) != 0) complain("cannot write %s", place_of("", s).scene);
}

/* Reads the messages that the run p has printed on standard error and stores in *lines the number of lines that are not
 * warnings. Returns the last of these lines in static memory; "" if there is none. */
static const char *said(const struct place *p, int *lines)
{
    static char line[1024];
    char next[1024];
    FILE *f = fopen(p->said, "r");
    *lines = 0, line[0] = '\0';
    while (f && fgets(next, sizeof next, f))
        if (strncmp(next, "warning: ", 9) != 0) memcpy(line, next, sizeof line), ++*lines;
    if (f) fclose(f);
    line[strcspn(line, "\n")] = '\0';
    return line;
}

static bool same(const struct place *reference, const struct place *p)
{
    return same_files(reference->folder, p->folder);
}

/* ---- runs -------------------------------------------------------------------------------------------------------- */

static _Noreturn void run_here(const struct fault_plan *plan, const struct place *p, int threads, bool resume)
{
    char number[16];
    snprintf(number, sizeof number, "%d", threads);
    char *words[] = {
        "cleave", "run", "-q", "-t", number, "-o", (char *)p->folder, (char *)p->scene, resume ? "--resume" : NULL,
        NULL};
    const int out = open("/dev/null", O_WRONLY), err = open(p->said, O_WRONLY | O_CREAT | O_TRUNC, 0666);
    if (out < 0 || err < 0 || dup2(out, 1) < 0 || dup2(err, 2) < 0) _exit(99);
    close(out), close(err);
    signal(SIGINT, SIG_DFL);
    alarm(PATIENCE);
    faults_arm(plan, count);
    _exit(program_main(resume ? 9 : 8, words));
}

/* Runs `cleave run` in a child process and waits for its end. plan: call of a function to be disturbed; p: scene and
 * folder; threads: number of threads; resume: true for the option --resume. Returns the exit status of the process, or
 * SIGNAL plus the number of the signal that ended it; -1 if no process could be started. */
static int run(const struct fault_plan *plan, const struct place *p, int threads, bool resume)
{
    int ended = 0;
    fflush(NULL);
    memset(count, 0, FAULT_CALLS * sizeof *count);
    const pid_t child = fork();
    if (child == 0) run_here(plan, p, threads, resume);
    if (child < 0 || waitpid(child, &ended, 0) != child) return -1;
    return WIFEXITED(ended) ? WEXITSTATUS(ended) : SIGNAL + WTERMSIG(ended);
}

static struct place reference_of(const struct fault_scene *s)
{
    const struct place p = place_of("reference", s);
    scene_put(s);
    remove_tree(p.folder);
    const int end = run(&undisturbed, &p, 1, false);
    int lines;
    if (end != 0) complain("%s: status %d: %s", s->name, end, said(&p, &lines));
    return p;
}

/* Resumes the run p with --resume on `threads` threads and compares its output folder with that of `reference`. Prints
 * and counts a failure (complain) if the run fails or the files differ. what: description of the previous disturbance.
 */
static void resumes(const char *what, const struct place *reference, const struct place *p, int threads)
{
    int lines;
    const int end = run(&undisturbed, p, threads, true);
    if (end != 0)
        complain("%s, then --resume: status %d: %s", what, end, said(p, &lines));
    else if (!same(reference, p))
        complain("%s, then --resume: other results", what);
}

/* Runs share(0) and share(1) in two child processes at the same time; share(worker) performs one half of the tests.
 * Returns the sum of the numbers of failures of both processes, each limited to 100. */
static int in_two(void (*share)(int worker))
{
    int all = 0;
    pid_t worker[2];
    fflush(NULL);
    for (int k = 0; k < 2; k++) {
        worker[k] = fork();
        if (worker[k] != 0) continue;
        wrong = 0;
        count = mmap(NULL, FAULT_CALLS * sizeof *count, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
        share(k);
        fflush(NULL);
        _exit(wrong < 100 ? wrong : 100);
    }
    for (int k = 0; k < 2; k++) {
        int ended = 0;
        waitpid(worker[k], &ended, 0);
        all += WIFEXITED(ended) ? WEXITSTATUS(ended) : 1;
    }
    return all;
}

#endif
