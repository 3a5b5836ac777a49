/* Runs for timing: from a file or a text, without output, in pieces; and runs as separate processes. */
#include <errno.h>
#include <fcntl.h>
#include <ftw.h>
#include <math.h>
#include <spawn.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bench.h"
#include "base/memory.h"
#include "output/output_files.h"
#include "output/summary_read.h"
#include "step/report.h"
#include "mesh/levels.h"
#include "mesh/mesh_part.h"
#include "probes/probes.h"
#include "probes/probes_part.h"
#include "step/step.h"
#include "scene/scene_read.h"

extern char **environ;

bool bench_scene_exists(const char *path)
{
    if (path_is_file(path)) return true;
    printf("  %s is not here: left out (scenes are looked for from the folder in which cleave was started)\n", path);
    return false;
}

status bench_check_scenes_exist(const char *bench_name, const char *const *path, size_t path_count)
{
    for (size_t k = 0; k < path_count; k++)
        if (!bench_scene_exists(path[k]))
            return status_set(REFUSED, "bench %s: its scenes are not here; start it where the folder inputs is",
                              bench_name);
    return OK;
}

status bench_engine_make(struct run *run, struct scene *s, const char *path, const char *text,
                         const struct scene_override *override, int override_count)
{
    *run = (struct run){0};
    *s = (struct scene){0};
    if (text)
        TRY(scene_read_text(s, text, strlen(text), path, override, override_count));
    else
        TRY(scene_read(s, path, override, override_count));
    status made = run_set_up_from_scene(run, s, NULL);
    run->report->quiet = true;
    if (made != OK) bench_engine_free(run, s);
    return made;
}

void bench_engine_free(struct run *run, struct scene *s)
{
    run_free_memory(run);
    scene_free(s);
}

status bench_engine_run(struct run *run, int64_t last_step, struct timers *section_times)
{
    const int64_t steps = run->clock.steps, stride = mesh_levels_time_steps_per_cycle(&run->frame->levels);
    last_step = (last_step + stride - 1) / stride * stride;
    memory_free(run->report->record); /* each call of run_advance_to_end_time allocates its own */
    run->report->record = NULL;
    run->clock.steps = last_step < steps ? last_step : steps;
    status ran = run_advance_to_end_time(run);
    run->clock.steps = steps;
    for (int k = 0; section_times && k < TIMERS; k++) section_times->spent[k] += run->timers.spent[k];
    return ran;
}

void bench_engine_set_velocities(struct run *run, bench_field *velocity_field, const void *context)
{
    struct grid *g = &run->frame->mesh.grid;
    real X[DIM_MAX], v[DIM_MAX];
    for (int64_t i = 0; i < run->part.n; i++) {
        for (int d = 0; d < run->part.dim; d++) X[d] = run->part.X[d][i];
        velocity_field(context, X, v);
        for (int d = 0; d < run->part.dim; d++) run->part.v[d][i] = v[d];
    }
    for (int64_t I = 0; run->frame->mesh.points > 0 && I < g->n; I++) {
        if (!(run->frame->mesh.inverse_mass[I] > 0)) continue;
        const int64_t at = mesh_original_node_of_doubled_node(&run->frame->mesh, I);
        for (int d = 0; d < g->dim; d++) X[d] = grid_node_position(g, d, at / g->stride[d] % g->count[d]);
        velocity_field(context, X, v);
        for (int d = 0; d < g->dim; d++) g->velocity[d][I] = v[d];
    }
}

/* ---- results of a run -------------------------------------------------------------------------------------------- */

/* Appends an override to *list. key: kept by reference; value_format: format of printf for the value. */
void bench_overrides_append(struct bench_overrides *list, const char *key, const char *value_format, ...)
{
    va_list more;
    INVARIANT(list->n < OVERRIDES_MAX);
    va_start(more, value_format);
    vsnprintf(list->value[list->n], OVERRIDE_LENGTH, value_format, more);
    va_end(more);
    list->at[list->n++].key = key;
}

const struct scene_override *bench_overrides_as_array(struct bench_overrides *list)
{
    for (int k = 0; k < list->n; k++) list->at[k].value = list->value[k];
    return list->at;
}

struct wanted_figures {
    struct bench_figure *figure;
    int n;
};

static void take_figure(void *context, const char *probe, const char *quantity, real value)
{
    const struct wanted_figures *w = context;
    for (int k = 0; k < w->n; k++)
        if (!strcmp(w->figure[k].probe, probe) && !strcmp(w->figure[k].quantity, quantity)) w->figure[k].value = value;
}

void bench_figures_read_from_probes(const struct run *run, struct bench_figure *figure, int figure_count)
{
    const struct observed_run seen = observed_run_make_read_only_view(run);
    probes_visit_results(&run->probing->probes, &seen, take_figure, &(struct wanted_figures){figure, figure_count});
}

status bench_run_scene_and_read_figures(const char *path, const char *text, struct bench_overrides *overrides,
                                        struct bench_figure *figure, int figure_count)
{
    struct run e;
    struct scene s;
    for (int k = 0; k < figure_count; k++) figure[k].value = NAN;
    TRY(bench_engine_make(&e, &s, path, text, bench_overrides_as_array(overrides), overrides->n));
    status ran = run_advance_to_end_time(&e);
    if (ran == OK) ran = run_repeat_with_mpm_only_for_pulse_probe(&e);
    if (ran == OK) bench_figures_read_from_probes(&e, figure, figure_count);
    bench_engine_free(&e, &s);
    return ran;
}

/* ---- separate processes ------------------------------------------------------------------------------------------ */

/* Starts this program with the arguments argv as a child process, without standard output. *child: receives its process
 * id, or 0 on a failure. posix_spawn is used because after fork() only one thread of the team would exist in the child.
 * Returns FAILED if it cannot be started. */
static status spawn(char **argv, pid_t *child)
{
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    int fault = posix_spawn(child, "/proc/self/exe", &actions, NULL, argv, environ);
    posix_spawn_file_actions_destroy(&actions);
    if (!fault) return OK;
    *child = 0;
    return status_set(FAILED, "bench: cannot start a process for a run: %s", strerror(fault));
}

/* Room for the words of a command; capacity of an override key=value [byte]. */
enum { WORDS = 64, WORD_LENGTH = OVERRIDE_LENGTH + 64 };

static status spawn_run(struct bench_child *c, const char *path, const struct scene_override *override, int overrides,
                        int threads)
{
    char pair[WORDS / 2][WORD_LENGTH], team[16];
    char *argv[WORDS] = {"cleave", "run", (char *)path, "-q", "-t", team, "-o", c->folder};
    int words = 8;
    snprintf(team, sizeof team, "%d", threads);
    for (int k = 0; k < overrides && words + 3 < WORDS; k++) {
        snprintf(pair[k], WORD_LENGTH, "%s=%s", override[k].key, override[k].value);
        argv[words++] = "-s";
        argv[words++] = pair[k];
    }
    return spawn(argv, &c->process);
}

status bench_child_start(struct bench_child *child, const char *path, const struct scene_override *override,
                         int override_count, int thread_count)
{
    *child = (struct bench_child){0};
    TRY(bench_create_results_folder());
    strcpy(child->folder, BENCH_FOLDER "/run-XXXXXX");
    if (!mkdtemp(child->folder)) {
        status s = file_report_write_failure(child->folder, errno);
        child->folder[0] = 0;
        return s;
    }
    return spawn_run(child, path, override, override_count, thread_count);
}

status bench_child_wait(struct bench_child *child)
{
    struct rusage used;
    int ended;
    while (wait4(child->process, &ended, 0, &used) < 0)
        if (errno != EINTR) return status_set(FAILED, "bench: %s", strerror(errno));
    child->process = 0;
    child->processor = (double)(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
                       1e-6 * (double)(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
    if (!WIFEXITED(ended) || WEXITSTATUS(ended) != 0) return status_set(FAILED, "bench: a run has failed");
    return OK;
}

static int remove_entry(const char *path, const struct stat *info, int kind, struct FTW *walk)
{
    (void)info, (void)kind, (void)walk;
    return remove(path);
}

void bench_folder_remove(const char *folder) { nftw(folder, remove_entry, 16, FTW_DEPTH | FTW_PHYS); }

void bench_child_wait_and_remove_output(struct bench_child *child)
{
    int ended;
    if (child->process) waitpid(child->process, &ended, 0);
    if (child->folder[0]) bench_folder_remove(child->folder);
    *child = (struct bench_child){0};
}

status bench_child_run_and_read_summary(const char *path, const struct scene_override *override, int override_count,
                                        const char *const *key, double *value, int value_count)
{
    struct bench_child c;
    status s = bench_child_start(&c, path, override, override_count, 1);
    if (s == OK) s = bench_child_wait(&c);
    for (int k = 0; k < value_count && s == OK; k++) s = summary_read_number(c.folder, key[k], &value[k]);
    bench_child_wait_and_remove_output(&c);
    return s;
}
