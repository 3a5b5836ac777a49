/* Checks that no data are lost: each call of the program fails once, runs are stopped and killed at many points, and
 * checkpoints are damaged. A run resumed with --resume must always have results bitwise equal to those of an
 * undisturbed run. `test_faults whole` disturbs the calls of the whole process, libraries included
 * (tests/robustness/long_faults.sh). Runs alone: it uses two processes, and a run longer than PATIENCE counts as
 * hanging. Takes 30 s: about 2000 runs. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <cmocka.h>

#include "base/memory_stream.h"
#include "faults.h"
#include "output/output_hdf5.h"
#include "scene/scene_read.h"

#ifndef __linux__
int main(void)
{
    puts("no linker that wraps calls: not tested");
    return 77;
}
#else

#include "fault_runs.h"

int __wrap_main(int argc, char **argv);

/* ---- every call fails once --------------------------------------------------------------------------------------- */

/* A series of runs in which calls of one kind fail, one call per run: every `step`-th call with the errno `cause`. For
 * each `look`-th of these runs the failed run is resumed, and the call also fails in a resumed run (stopped at sample 2
 * before). lossy: libraries may crash after such a fault, so that the exit status is not checked. */
struct sweep {
    enum fault_call call;
    int cause, step, look;
    bool lossy;
};

static const struct sweep own_sweeps[] = {
    {OWN_MALLOC, ENOMEM, 3, 8, false}, {OWN_OPEN, EMFILE, 1, 2, false}, {OWN_READ, EIO, 1, 2, false},
    {OWN_WRITE, ENOSPC, 1, 1, false},  {OWN_FSYNC, EIO, 1, 2, false},   {OWN_CLOSE, EIO, 1, 2, false},
    {OWN_RENAME, EACCES, 1, 1, false}, {OWN_MKDIR, EROFS, 1, 1, false}, {OWN_UNLINK, EACCES, 1, 2, false},
    {ALL_WRITE, ENOSPC, 20, 1, false},
};
static const struct sweep whole_sweeps[] = {
    {ALL_OPEN, EMFILE, 1, 1, false},   {ALL_WRITE, ENOSPC, 1, 1, false},   {ALL_FSYNC, EIO, 1, 1, false},
    {ALL_RENAME, EIO, 1, 1, false},    {ALL_CLOSE, EIO, 1, 1, false},      {ALL_READ, EIO, 1, 1, false},
    {ALL_MKDIR, ENOSPC, 1, 1, false},  {ALL_UNLINK, EIO, 1, 1, false},     {ALL_MMAP, ENOMEM, 1, 1, true},
    {ALL_MALLOC, ENOMEM, 47, 1, true}, {OWN_MALLOC, ENOMEM, 1, 16, false},
};
static const struct sweep *sweeps = own_sweeps;
static int sweep_count = COUNT_OF(own_sweeps);
static struct place small_reference;

/* Checks how the run p ended after a fault: exit status 0 and the results of small_reference, or status 1 or 2 and one
 * line that names the cause. what: description for messages; end: exit status; cause: errno of the fault. */
static void outcome(const char *what, const struct place *p, int end, int cause)
{
    int lines;
    const char *line = said(p, &lines);
    if (end == 0) {
        if (!same(&small_reference, p)) complain("%s: status 0 and other results", what);
        return;
    }
    if (end != 1 && end != 2)
        complain("%s: status %d: %s", what, end, line);
    else if (lines != 1)
        complain("%s: %d lines: %s", what, lines, line);
    else if (!strstr(line, strerror(cause)) && !(cause == ENOMEM && strstr(line, "memory")))
        complain("%s: no cause in: %s", what, line);
}

/* Makes call number `number` of the kind of s fail in a run p, or in its resumed part if `resumed` is true, and checks
 * its end (outcome). look: true to resume the run afterwards and compare its results. */
static void fail_at(const struct sweep *s, long number, const struct place *p, bool resumed, bool look)
{
    const struct fault_plan plan = {s->call, DO_FAIL, number, s->cause, 0}, stop = {AT_SAMPLE, DO_STOP, 2, 0, 0};
    char what[NAME];
    snprintf(what, sizeof what, "%s %ld %s", fault_name[s->call], number, resumed ? "of a resumed run" : "of a run");
    remove_tree(p->folder);
    if (resumed && run(&stop, p, 1, false) != 130) complain("%s: not stopped", what);
    const int end = run(&plan, p, 1, resumed);
    if (!s->lossy) outcome(what, p, end, s->cause);
    if (look && (end != 0 || s->lossy)) resumes(what, &small_reference, p, 1);
}

/* Makes every step-th call of each series fail in a run and in a resumed run (struct sweep). worker: 0 or 1, which half
 * of the calls. */
static void sweep_share(int worker)
{
    static const struct fault_plan stop = {AT_SAMPLE, DO_STOP, 2, 0, 0};
    const struct place p = place_of(worker ? "b" : "a", &small_scene);
    long most[2][FAULT_CALLS];
    for (int resumed = 0; resumed < 2; resumed++) {
        remove_tree(p.folder);
        if (resumed) (void)run(&stop, &p, 1, false);
        (void)run(&undisturbed, &p, 1, resumed);
        memcpy(most[resumed], count, sizeof most[resumed]);
    }
    for (const struct sweep *s = sweeps; s < sweeps + sweep_count; s++) {
        if (worker == 0)
            printf("%s: %ld and %ld calls, one in %d\n", fault_name[s->call], most[0][s->call], most[1][s->call],
                   s->step);
        if (most[0][s->call] + most[1][s->call] == 0) complain("%s: never called", fault_name[s->call]);
        for (int resumed = 0; resumed < 2; resumed++)
            for (long k = worker; 1 + k * s->step <= most[resumed][s->call]; k += 2) {
                const bool look = k / 2 % s->look == 0;
                if (look || !resumed) fail_at(s, 1 + k * s->step, &p, resumed, look);
            }
    }
}

static void failing_calls_lose_nothing(void **state)
{
    (void)state;
    small_reference = reference_of(&small_scene);
    assert_int_equal(in_two(sweep_share), 0);
}

/* Checks that a text written to a stream in memory is complete, or that closing the stream reports the loss, whichever
 * of its first 40 allocations fails. */
static void texts_in_memory_are_whole_or_refused(void **state)
{
    enum { NUMBERS = 3000, EACH = 7 };
    static char wanted[NUMBERS * EACH + 1];
    int refused = 0;
    (void)state;
    for (int k = 0; k < NUMBERS; k++) snprintf(wanted + k * EACH, EACH + 1, "%06d,", k);
    for (long number = 1; number <= 40; number++) {
        const struct fault_plan plan = {ALL_MALLOC, DO_FAIL, number, ENOMEM, 0};
        char *text = NULL;
        size_t length = 0;
        memset(count, 0, FAULT_CALLS * sizeof *count);
        faults_arm(&plan, count);
        FILE *to = memory_stream_open(&text, &length);
        for (int k = 0; to && k < NUMBERS; k++) fprintf(to, "%06d,", k);
        const bool whole = to && fclose(to) == 0;
        faults_arm(&undisturbed, count);
        refused += !whole;
        if (whole && (length != sizeof wanted - 1 || strcmp(text, wanted) != 0))
            complain("allocation %ld fails: %zu bytes of %zu without a word", number, length, sizeof wanted - 1);
        free(text);
    }
    assert_in_range(refused, 3, 39); /* stream, context, growth; the last allocations of 40 are never reached */
    assert_int_equal(wrong, 0);
}

/* Violates an invariant at each rename of a file in turn, in the thread that computes or the one that writes. The run
 * must end with status 1 and one line, leave no temporary file, and be resumable. worker: 0 or 1, which half of the
 * renames. */
static void break_share(int worker)
{
    const struct place p = place_of(worker ? "b" : "a", &small_scene);
    char what[NAME];
    remove_tree(p.folder);
    (void)run(&undisturbed, &p, 1, false);
    for (long k = 1 + worker, renames = count[OWN_RENAME]; k <= renames; k += 2) {
        const struct fault_plan plan = {OWN_RENAME, DO_BREAK, k, 0, 0};
        int lines;
        snprintf(what, sizeof what, "an invariant that is broken at rename %ld", k);
        remove_tree(p.folder);
        const int end = run(&plan, &p, 1, false);
        const char *line = said(&p, &lines);
        if (end != 1 || lines != 1 || !strstr(line, ": broken invariant at ") || half_written(p.folder))
            complain("%s: status %d, %d lines, or half-written files: %s", what, end, lines, line);
        resumes(what, &small_reference, &p, 1);
    }
}

static void broken_invariants_lose_nothing(void **state)
{
    (void)state;
    small_reference = reference_of(&small_scene);
    assert_int_equal(in_two(break_share), 0);
}

/* ---- stopped and killed ------------------------------------------------------------------------------------------ */

/* Checks that every kind of probe is in one of the fault scenes, whose runs are stopped and resumed. */
static void every_probe_is_watched(void **state)
{
    bool watched[64] = {false};
    (void)state;
    for (size_t k = 0; k < COUNT_OF(fault_scenes); k++) {
        struct scene s;
        if (scene_read_text(&s, fault_scenes[k].text, strlen(fault_scenes[k].text), fault_scenes[k].name, NULL, 0) !=
            OK)
            fail_msg("%s", status_message());
        for (int q = 0; q < s.probes; q++) watched[s.probe[q].kind] = true;
        scene_free(&s);
    }
    for (int kind = 0; kind < PROBES; kind++)
        if (!watched[kind]) fail_msg("no scene has probe %d", kind);
}

/* Runs the scene s and ends it `times` times by `deed` (DO_STOP or DO_KILL) at the `number`-th call of the kind
 * `place`, each time resuming it on another number of threads, and compares the final results with those of an
 * undisturbed run. number 0: calls of the undisturbed run divided by times + 1, so that the run is ended at equal
 * distances. */
static void disturb(const struct fault_scene *s, enum fault_call place, long number, enum fault_deed deed, int times)
{
    const struct place reference = reference_of(s), p = place_of("disturbed", s);
    const struct fault_plan plan = {place, deed, number > 0 ? number : count[place] / (times + 1), 0, 0};
    const int expected = deed == DO_STOP ? 130 : SIGNAL + SIGKILL;
    char what[NAME];
    printf("%s: %d times in %ld calls of %s\n", s->name, times, count[place], fault_name[place]);
    remove_tree(p.folder);
    for (int k = 0; k < times; k++) {
        const int end = run(&plan, &p, 1 + k % 3, k > 0);
        int lines;
        if (end != expected)
            complain("%s, ended at %s, time %d: status %d: %s", s->name, fault_name[place], k, end, said(&p, &lines));
    }
    snprintf(what, sizeof what, "%s, ended at %s", s->name, fault_name[place]);
    resumes(what, &reference, &p, 2);
}

static void stop_share(int worker)
{
    for (size_t k = (size_t)worker; k < COUNT_OF(fault_scenes); k += 2)
        disturb(&fault_scenes[k], AT_SAMPLE, 0, DO_STOP, 4);
    if (worker == 0) disturb(&steps_scene, AT_EQUILIBRIUM, 0, DO_STOP, 4); /* within load steps */
}

static void stopped_runs_resume(void **state)
{
    (void)state;
    assert_int_equal(in_two(stop_share), 0);
}

/* Kills runs at conversions, couplings and equilibria. A resumed run couples at its start and again where it was
 * killed; the third coupling is the first new one. worker: 0 or 1, which half of the tests. */
static void kill_share(int worker)
{
    if (worker == 0)
        disturb(&converting_scene, AT_CONVERSION, 0, DO_KILL, 10);
    else
        disturb(&passing_scene, AT_COUPLING, 3, DO_KILL, 10);
    if (worker == 1) disturb(&steps_scene, AT_EQUILIBRIUM, 0, DO_KILL, 4);
}

static void killed_runs_resume(void **state)
{
    (void)state;
    assert_int_equal(in_two(kill_share), 0);
}

/* ---- order ------------------------------------------------------------------------------------------------------- */

/* Copies the path `file` without its last component, i.e. the folder, to folder[NAME]; "." if there is no slash. */
static void folder_of(const char *path, char *folder)
{
    snprintf(folder, NAME, "%s", path);
    char *slash = strrchr(folder, '/');
    if (slash)
        *slash = '\0';
    else
        strcpy(folder, ".");
}

struct log_line {
    char what[8], path[NAME], to[NAME];
    unsigned long hash;
};

/* Searches the log line[lines] of calls for an fsync of `path`, backwards (step -1) or forwards (step 1) from line
 * `from` on. Returns its line number; -1 if there is none before a rename to the path `end` (NULL: no limit). */
static int find_sync(const struct log_line *line, int lines, int from, int step, const char *path, const char *end)
{
    for (int k = from; k >= 0 && k < lines; k += step) {
        if (strcmp(line[k].what, "fsync") == 0 && strcmp(line[k].path, path) == 0) return k;
        if (k != from && end && strcmp(line[k].what, "rename") == 0 && strcmp(line[k].to, end) == 0) return -1;
    }
    return -1;
}

/* Checks the rename in line[k] of the log line[lines]: the file was synced with its final contents before, and its
 * folder is synced afterwards, before another file gets this name. Before a checkpoint, history.csv must be synced. */
static void check_rename(const struct log_line *line, int lines, int k)
{
    char folder[NAME], history[2 * NAME];
    const char *name = strrchr(line[k].to, '/') + 1;
    const int synced = find_sync(line, lines, k, -1, line[k].path, NULL);
    folder_of(line[k].to, folder);
    snprintf(history, sizeof history, "%s/history.csv", folder);
    if (strcmp(name, "checkpoint.previous.h5") == 0) return; /* synced under its first name */
    if (synced < 0 || line[synced].hash != line[k].hash) complain("%s is not on the disk when it gets its name", name);
    if (find_sync(line, lines, k, 1, folder, line[k].to) < 0) complain("the name of %s is not on the disk", name);
    if (strcmp(name, "checkpoint.h5") == 0 && line[k].hash && find_sync(line, lines, k, -1, history, line[k].to) < 0)
        complain("a checkpoint counts on samples that are not on the disk");
}

static int read_log(struct log_line *line, int room)
{
    int lines = 0;
    FILE *f = fopen("log", "r");
    while (f && lines < room &&
           fscanf(f, "%7s %255s %255s %lu\n", line[lines].what, line[lines].path, line[lines].to, &line[lines].hash) ==
               4)
        lines++;
    if (f) fclose(f);
    return lines;
}

static void files_are_synced_in_order(void **state)
{
    enum { ROOM = 1000 };
    static struct log_line line[ROOM];
    char here[NAME - 32], folder[NAME], newest[NAME + 32];
    struct place p = place_of("order", &small_scene);
    (void)state;
    wrong = 0;
    remove_tree("new");
    scene_put(&small_scene);
    assert_non_null(getcwd(here, sizeof here));
    snprintf(p.folder, sizeof p.folder, "%s/new/below", here); /* two new folders, and frames inside */
    const struct fault_plan plan = {.log = open("log", O_CREAT | O_TRUNC | O_WRONLY | O_APPEND, 0666)};
    assert_int_equal(run(&plan, &p, 1, false), 0);
    close(plan.log);
    const int lines = read_log(line, ROOM);
    int renames = 0, folders = 0, checkpoint = -1;
    snprintf(newest, sizeof newest, "%s/checkpoint.h5", p.folder);
    for (int k = 0; k < lines; k++) {
        if (strcmp(line[k].what, "rename") == 0) check_rename(line, lines, k), renames++;
        if (checkpoint < 0 && strcmp(line[k].to, newest) == 0) checkpoint = k;
    }
    for (int k = 0; k < lines; k++) {
        if (strcmp(line[k].what, "mkdir") != 0) continue;
        folder_of(line[k].path, folder), folders++;
        const int synced = find_sync(line, lines, k, 1, folder, NULL);
        if (synced < 0 || synced > checkpoint)
            complain("the name of the new folder %s is not on the disk", line[k].path);
    }
    assert_true(renames > 10 && folders == 3);
    assert_int_equal(wrong, 0);
}

/* ---- damage ------------------------------------------------------------------------------------------------------ */

/* Inverts one bit of the file `path`, at a position that follows from `at`. Returns false if that fails. */
static bool flip(const char *path, uint64_t at)
{
    unsigned char byte = 0;
    struct stat s;
    const int fd = open(path, O_RDWR);
    bool done = fd >= 0 && fstat(fd, &s) == 0 && s.st_size > 0;
    const off_t place = done ? (off_t)(at % (uint64_t)s.st_size) : 0;
    done = done && pread(fd, &byte, 1, place) == 1;
    byte ^= (unsigned char)(1u << at % 8);
    done = done && pwrite(fd, &byte, 1, place) == 1;
    if (fd >= 0) close(fd);
    return done;
}

/* Inverts one bit in the newest checkpoint of a stopped run, for half of 60 positions spread over the file. --resume
 * must detect the damage, use the previous checkpoint and have the results of an undisturbed run. worker: 0 or 1, which
 * half of the positions. */
static void flip_share(int worker)
{
    static const struct fault_plan stop = {AT_SAMPLE, DO_STOP, 2, 0, 0};
    const struct place p = place_of(worker ? "b" : "a", &small_scene);
    char newest[2 * NAME], what[NAME];
    snprintf(newest, sizeof newest, "%s/checkpoint.h5", p.folder);
    for (uint64_t k = (uint64_t)worker; k < 60; k += 2) {
        int lines;
        remove_tree(p.folder);
        snprintf(what, sizeof what, "flip %d", (int)k);
        if (run(&stop, &p, 1, false) != 130 || !flip(newest, k * UINT64_C(0x9E3779B97F4A7C15) >> 16))
            complain("%s: no checkpoint", what);
        resumes(what, &small_reference, &p, 1);
        if (!strstr(said(&p, &lines), "resuming from checkpoint.previous.h5"))
            complain("%s is not found: %s", what, said(&p, &lines));
    }
}

static void damaged_checkpoints_are_found(void **state)
{
    (void)state;
    small_reference = reference_of(&small_scene);
    assert_int_equal(in_two(flip_share), 0);
}

/* Creates a folder for all files of the tests in TMPDIR, or beside `program` (argv[0]), and makes it the working
 * folder. folder[NAME]: receives its name. Returns 0 on success. */
static int enter(char *program, char *folder)
{
    const char *place = getenv("TMPDIR");
    snprintf(folder, NAME, "test_faults.%ld", (long)getpid());
    return chdir(place ? place : dirname(program)) != 0 || mkdir(folder, 0777) != 0 || chdir(folder) != 0;
}

int __wrap_main(int argc, char **argv)
{
    static const struct CMUnitTest whole[] = {cmocka_unit_test(failing_calls_lose_nothing)};
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_probe_is_watched),
        cmocka_unit_test(failing_calls_lose_nothing),
        cmocka_unit_test(texts_in_memory_are_whole_or_refused),
        cmocka_unit_test(stopped_runs_resume),
        cmocka_unit_test(killed_runs_resume),
        cmocka_unit_test(files_are_synced_in_order),
        cmocka_unit_test(damaged_checkpoints_are_found),
        cmocka_unit_test(broken_invariants_lose_nothing),
    };
    const bool of_all = argc > 1 && strcmp(argv[1], "whole") == 0;
    if (argc > 1 && !of_all) cmocka_set_test_filter(argv[1]); /* name of a single test */
    char folder[NAME];
    if (enter(argv[0], folder) != 0) return 1;
    setenv("GOMP_SPINCOUNT", "2000", 1);         /* the program would restart itself to set it */
    setenv("HWLOC_SYNTHETIC", "core:2 pu:1", 1); /* probing the machine would take longer than these runs */
    count = mmap(NULL, FAULT_CALLS * sizeof *count, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (of_all)
        sweeps = whole_sweeps, sweep_count = COUNT_OF(whole_sweeps);
    else
        hdf_disable_exit_handler_and_messages(); /* once, not in each of these runs: calls of libraries do not fail in
                                                    them */
    const int failed = of_all ? cmocka_run_group_tests(whole, NULL, NULL) : cmocka_run_group_tests(tests, NULL, NULL);
    if (failed == 0 && chdir("..") == 0) remove_tree(folder);
    return failed;
}

#endif
