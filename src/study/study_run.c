/* Starts the runs of a study as parallel processes, each on its share of the cores. */
#define _GNU_SOURCE /* program_invocation_name */
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

#include "base/memory.h"
#include "base/team.h"
#include "output/output.h"
#include "output/output_files.h"
#include "study/study.h"

/* Number of words of the command of a run, with the NULL at its end, for which memory is allocated besides its
 * overrides (-s KEY=VALUE). */
enum { WORDS_FIXED = 12 };

#define PATIENCE 0.5 /* time after the budget at which runs that have not stopped are killed [s] */

/* State of the processes that make the runs of a study. It exists during the call of study_execute_waiting_runs. */
struct runner {
    struct study *study;
    struct study_options how;
    struct cpu_core_partition *shares; /* shares of the processor cores, one for each process */
    int running, ended;                /* number of processes that the run; that have ended */
    bool stopped;                      /* the running processes have received a signal to stop */
    double since;                      /* time of this signal on wall_clock_seconds [s] */
};

/* ---- the command ------------------------------------------------------------------------------------------------- */

/* Returns the words of the `cleave run` command for the run c of a study, as an array ended by NULL. Stores in *pairs
 * the texts KEY=VALUE to which the words refer. The caller releases both with memory_free. scene: path of the scene
 * file; threads: number of threads as text, or NULL; folder: folder for the results; mode: --resume, --overwrite or
 * NULL. */
static char **command_words(const char *scene, const struct study_case *c, char *threads, char *folder, char *mode,
                            char **pairs)
{
    char **word = NEW("study.words", WORDS_FIXED + 2 * c->overrides, char *);
    size_t length = 1;
    int n = 0;
    for (int k = 0; k < c->overrides; k++) length += strlen(c->override[k].key) + strlen(c->override[k].value) + 2;
    char *pair = *pairs = NEW("study.pairs", (int64_t)length, char);
    word[n++] = "cleave", word[n++] = "run", word[n++] = (char *)scene;
    word[n++] = "-q", word[n++] = "-o", word[n++] = folder;
    if (mode) word[n++] = mode;
    if (threads) word[n++] = "-t", word[n++] = threads;
    for (int k = 0; k < c->overrides; k++) {
        word[n++] = "-s", word[n++] = pair;
        pair += sprintf(pair, "%s=%s", c->override[k].key, c->override[k].value) + 1;
    }
    return word;
}

/* Prints the character c, which is within a word in single quotes of a shell command, to `out`. harmful: true if a
 * terminal would act on the character; it is then printed as a number, from which the shell makes the character with
 * printf. */
static void print_quoted(FILE *out, char c, bool harmful)
{
    if (harmful)
        fprintf(out, "'\"$(printf '\\%03o')\"'", (unsigned)(unsigned char)c);
    else if (c == '\'')
        fputs("'\\''", out);
    else
        putc(c, out);
}

void study_print_word_quoted_for_shell(FILE *out, const char *word)
{
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./,:%@";
    const size_t length = strlen(word);
    if (*word && strspn(word, plain) == length) {
        fputs(word, out);
        return;
    }
    char *shown = NEW("study.shown", (int64_t)length + 1, char);
    strcpy(shown, word);
    text_replace_control_characters(shown);
    putc('\'', out);
    for (size_t k = 0; k < length; k++)
        print_quoted(out, word[k], shown[k] != word[k] && word[k] != '\n' && word[k] != '\t');
    putc('\'', out);
    memory_free(shown);
}

/* Returns the absolute path of `path`; `path` itself if the current folder is unknown. Symbolic links in it are kept,
 * since a scene is named after the link by which it is given. */
static struct path path_whole(const char *path)
{
    char here[PATH_ROOM];
    struct path whole;
    while (path[0] == '.' && path[1] == '/') path += 2;
    if (*path != '/' && getcwd(here, sizeof here)) return path_join(here, path);
    snprintf(whole.text, sizeof whole.text, "%s", path);
    return whole;
}

void study_print_command_of_case(const struct study *s, const struct study_case *c, struct study_options options,
                                 FILE *out)
{
    char team[16], *pairs;
    const char *name = program_invocation_name;
    const struct path program = strchr(name, '/') ? path_whole(name) : (struct path){{0}};
    const struct path scene = path_whole(s->scene), study = path_whole(s->folder);
    struct path folder = path_join(study.text, c->name);
    snprintf(team, sizeof team, "%d", options.threads);
    char **word = command_words(scene.text, c, options.threads > 0 ? team : NULL, folder.text,
                                options.overwrite ? "--overwrite" : "--resume", &pairs);
    study_print_word_quoted_for_shell(out, *program.text ? program.text : name);
    for (int k = 1; word[k]; k++) {
        putc(' ', out);
        study_print_word_quoted_for_shell(out, word[k]);
    }
    putc('\n', out);
    memory_free(pairs);
    memory_free(word);
}

/* ---- processes --------------------------------------------------------------------------------------------------- */

/* Returns the path logs/RUN.txt in `folder`, the folder of the study: the log of the run called `run`. */
static struct path log_path_in(const char *folder, const char *run)
{
    char name[CASE_NAME_ROOM + 8];
    snprintf(name, sizeof name, "%.*s.txt", CASE_NAME_ROOM, run);
    return path_join(path_join(folder, "logs").text, name);
}

static struct path log_path(const struct study *s, const struct study_case *c)
{
    return log_path_in(s->folder, c->name);
}

/* First line of the log of a run, by which Cleave recognises it. */
static const char log_mark[] = "# log by cleave of a run of a study\n";

/* Checks that the files of the run c of a study may be written. Returns REFUSED, with a message, if the folder of the
 * run is a symbolic link, which may lead out of the folder of the study, or if the log of the run would replace a file
 * that Cleave did not write. s: the study. */
static status case_guard(const struct study *s, const struct study_case *c)
{
    static const char *const begin[] = {log_mark, "warning: "};
    const struct path folder = study_case_folder(s, c), log = log_path(s, c);
    if (path_is_link(folder.text))
        return status_set(REFUSED, "%s is a symbolic link, so results would be written elsewhere; choose another -o",
                          folder.text);
    TRY(file_check_replaceable(log.text));
    return file_check_has_known_beginning(log.text, begin, COUNT_OF(begin));
}

/* Replaces the child process by the command word[], with its output to the descriptor `log`. The process has its own
 * process group, so that an interrupt from the terminal reaches only the study, which passes it on once. The process is
 * ended if the study is killed. Does not return. */
static _Noreturn void become_run(char **word, int log)
{
    setpgid(0, 0);
#ifdef __linux__
    prctl(PR_SET_PDEATHSIG, SIGTERM);
#endif
    const int nothing = open("/dev/null", O_RDONLY);
    dup2(nothing, STDIN_FILENO);
    dup2(log, STDOUT_FILENO);
    dup2(log, STDERR_FILENO);
    execv("/proc/self/exe", word);
    execvp(program_invocation_name, word); /* for systems without /proc */
    dprintf(STDERR_FILENO, "cannot start %s: %s\n", program_invocation_name, strerror(errno));
    _exit(FAILED);
}

/* Starts the process of the run c of the study in r, with its output in a log. slot: number of the share of the
 * processor cores on which it runs. A run with results in its folder is resumed, or replaced with --overwrite. Returns
 * REFUSED or FAILED, with a message, if it cannot be started. */
static status case_start(struct runner *r, struct study_case *c, int slot)
{
    char threads[16], *pairs;
    struct path folder = study_case_folder(r->study, c), log = log_path(r->study, c);
    const bool there = path_exists(path_join(folder.text, "scene.yaml").text);
    snprintf(threads, sizeof threads, "%d", r->how.threads);
    TRY(case_guard(r->study, c));
    unlink(log.text); /* a link of this name is not followed */
    const int fd = open(log.text, O_WRONLY | O_CREAT | O_EXCL | O_APPEND | O_CLOEXEC | O_NOFOLLOW, 0666);
    if (fd < 0) return file_report_write_failure(log.text, errno);
    if (write(fd, log_mark, sizeof log_mark - 1) < 0) errno = 0; /* the study continues without its logs */
    char **word = command_words(r->study->scene, c, threads, folder.text,
                                r->how.overwrite ? "--overwrite"
                                : there          ? "--resume"
                                                 : NULL,
                                &pairs);
    c->seconds = -wall_clock_seconds();
    cpu_core_partition_bind_calling_thread(r->shares, slot); /* inherited by the child */
    fflush(NULL);
    c->process = (int)fork();
    if (c->process == 0) become_run(word, fd);
    const int fault = errno;
    cpu_core_partition_bind_calling_thread(r->shares, -1);
    close(fd);
    memory_free(pairs);
    memory_free(word);
    if (c->process < 0)
        return status_set(FAILED, "cannot start a process for a run (%s); use fewer runs at a time (-j)",
                          strerror(fault));
    c->state = CASE_RUNNING;
    c->slot = slot;
    r->running++;
    return OK;
}

void study_read_reason_of_failure(char *line, size_t capacity, const char *folder, const char *run)
{
    char *text;
    size_t length;
    snprintf(line, capacity, "it gave no reason");
    if (file_read_whole(log_path_in(folder, run).text, &text, &length) != OK) return;
    while (length > 0 && text[length - 1] == '\n') text[--length] = '\0';
    const char *last = strrchr(text, '\n');
    if (last) snprintf(line, capacity, "%s", last + 1);
    text_replace_control_characters(line);
    memory_free(text);
}

/* Records the end of the run c in r: its state and duration. Prints a line about the run, which after a failure
 * contains the last line of its log. Removes a log without text. ended: status of the process from waitpid. */
static void case_end(struct runner *r, struct study_case *c, int ended)
{
    const struct path log = log_path(r->study, c);
    struct stat info;
    char line[1024];
    c->ended = WIFEXITED(ended) ? WEXITSTATUS(ended) : 128 + WTERMSIG(ended);
    c->state = c->ended == OK ? CASE_DONE : c->ended == INTERRUPTED || r->stopped ? CASE_STOPPED : CASE_FAILED;
    c->seconds += wall_clock_seconds();
    c->process = 0;
    r->running--;
    r->ended++;
    if (c->state == CASE_FAILED) {
        if (WIFSIGNALED(ended))
            snprintf(line, sizeof line, "killed by signal %d", WTERMSIG(ended));
        else
            study_read_reason_of_failure(line, sizeof line, r->study->folder, c->name);
        fprintf(stderr, "[%d/%d] %s: exit status %d: %s\n", r->ended, r->study->n, c->name, c->ended, line);
    } else if (!r->how.quiet)
        fprintf(stderr, "[%d/%d] %s: %s in %.3g s\n", r->ended, r->study->n, c->name,
                c->state == CASE_DONE ? "done" : "stopped", c->seconds);
    if (stat(log.text, &info) == 0 && info.st_size < (off_t)sizeof log_mark) unlink(log.text);
}

/* Finds the child processes of the study of r that have ended since the last call, and records state and duration of
 * their runs (case_end). Does not wait. */
static void cases_take(struct runner *r)
{
    for (int k = 0; k < r->study->n; k++) {
        struct study_case *c = &r->study->at[k];
        int ended;
        if (c->state == CASE_RUNNING && waitpid(c->process, &ended, WNOHANG) == c->process) case_end(r, c, ended);
    }
}

/* Returns the smallest slot number, from 0, that no running process of the study uses. Each slot is an equal part of
 * the processor cores. r: processes of the study. */
static int slot_free(const struct runner *r)
{
    for (int slot = 0;; slot++) {
        bool taken = false;
        for (int k = 0; k < r->study->n; k++)
            taken |= r->study->at[k].state == CASE_RUNNING && r->study->at[k].slot == slot;
        if (!taken) return slot;
    }
}

/* Sends SIGTERM to all running processes of a study, so that they write a checkpoint and stop. Does so only once,
 * since a second signal would end them without a checkpoint. r: processes of the study. */
static void cases_stop(struct runner *r)
{
    for (int k = 0; k < r->study->n && !r->stopped; k++)
        if (r->study->at[k].state == CASE_RUNNING) kill(r->study->at[k].process, SIGTERM);
    if (!r->stopped) r->since = wall_clock_seconds();
    r->stopped = true;
}

/* Kills the processes of a study that still run PATIENCE seconds after they were asked to stop by a signal, for
 * example because of a long set-up. r: processes of the study. */
static void cases_kill(struct runner *r)
{
    if (!r->stopped || wall_clock_seconds() < r->since + PATIENCE) return;
    for (int k = 0; k < r->study->n; k++)
        if (r->study->at[k].state == CASE_RUNNING) kill(r->study->at[k].process, SIGKILL);
}

/* Runs all waiting runs of a study, as many at a time as requested, and waits for their ends. After an error, a stop
 * signal or the end of the budget it starts no more runs and stops the running ones. Returns FAILED or REFUSED, with a
 * message, if a process cannot be started, INTERRUPTED after a stop signal, OK otherwise, even if runs have failed. r:
 * processes of the study. */
static status cases_run(struct runner *r)
{
    const struct timespec pause = {.tv_nsec = 5 * 1000 * 1000};
    status s = OK;
    for (int next = 0; next < r->study->n || r->running > 0;) {
        const bool late = r->how.until > 0 && wall_clock_seconds() > r->how.until;
        if (s != OK || late || (r->how.stop && *r->how.stop)) {
            next = r->study->n;
            cases_stop(r);
            if (late) cases_kill(r);
        }
        while (next < r->study->n && r->study->at[next].state != CASE_WAITING) next++;
        if (next < r->study->n && r->running < r->how.jobs) {
            s = case_start(r, &r->study->at[next++], slot_free(r));
            continue;
        }
        cases_take(r);
        if (r->running > 0) nanosleep(&pause, NULL);
    }
    if (s == OK && r->how.stop && *r->how.stop)
        return status_set(INTERRUPTED, "interrupted; the same command continues the study");
    return s;
}

/* ---- whole study ------------------------------------------------------------------------------------------------- */

/* Returns a copy of the options `how` of a study in which numbers of runs and threads that are 0 have been chosen. The
 * number of parallel runs becomes the number of cores divided by the threads of a run if these are given, else the
 * number of cores or of waiting runs, whichever is smaller. The number of threads becomes an equal share of the cores
 * for each run. s: the study. */
static struct study_options options_filled(struct study_options how, const struct study *s)
{
    const int cores = machine_physical_core_count();
    int waiting = 0;
    for (int k = 0; k < s->n; k++) waiting += s->at[k].state == CASE_WAITING;
    if (how.jobs <= 0) how.jobs = how.threads > 0 ? cores / how.threads : cores < waiting ? cores : waiting;
    if (how.jobs < 1) how.jobs = 1;
    if (how.threads <= 0) how.threads = cores / how.jobs;
    if (how.threads < 1) how.threads = 1;
    return how;
}

/* Writes the scene of the study s into its folder as the file STUDY_SCENE, by which the folder is recognised. Returns
 * REFUSED, with a message, if the folder contains other files or, unless `overwrite` is true, the study of another
 * scene. Returns FAILED if the file cannot be written. */
static status scene_put(const struct study *s, bool overwrite)
{
    TRY(study_folder_mark_as_study(s->folder));
    if (!s->text) return OK;
    if (!overwrite) TRY(study_folder_check_is_usable_for_scene(s->folder, s->text));
    return study_write_scene_and_options(s->folder, s->text, s->options);
}

status study_lock_folder(struct study *s, bool overwrite)
{
    if (path_exists(path_join(s->folder, "scene.yaml").text))
        return status_set(REFUSED, "%s contains a run, not a study; choose another -o", s->folder);
    if (!path_is_folder(s->folder))
        return status_set(REFUSED, "%s contains no study; give the folder of one", s->folder);
    if (s->lock.fd >= 0) return OK;
    TRY(study_folder_check_is_usable(s->folder));
    TRY(folder_lock(&s->lock, s->folder));
    return scene_put(s, overwrite);
}

status study_execute_waiting_runs(struct study *s, struct study_options options)
{
    struct runner r = {.study = s};
    TRY(folder_create_with_parents(s->folder));
    TRY(study_lock_folder(s, options.overwrite));
    for (int k = 0; k < s->n; k++) {
        struct study_case *c = &s->at[k];
        if (options.overwrite && c->state == CASE_DONE_BEFORE) c->state = CASE_WAITING;
        r.ended += c->state != CASE_WAITING;
    }
    for (int k = 0; k < s->n; k++)
        if (s->at[k].state == CASE_WAITING) TRY(case_guard(s, &s->at[k]));
    TRY(folder_create_with_parents(path_join(s->folder, "logs").text));
    r.how = options_filled(options, s);
    r.shares = cpu_core_partition_make(r.how.jobs);
    const status ran = cases_run(&r);
    cpu_core_partition_free(r.shares);
    rmdir(path_join(s->folder, "logs").text); /* succeeds only if the folder is empty */
    return ran;
}
