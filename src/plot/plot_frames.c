/* Selects the output frames of a run that pictures show, and composes the paths and titles of pictures. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/memory.h"
#include "output/output_files.h"
#include "output/picture_file.h"
#include "output/pictures.h"
#include "output/summary_read.h"
#include "plot/plot.h"
#include "maps_parts.h"

enum { PATH_LENGTH = 4096 };

/* ---- frames ------------------------------------------------------------------------------------------------------ */

/* Returns true if the folder of a run contains a file or folder called `name`. */
bool run_folder_has_file(const char *folder, const char *name)
{
    char path[PATH_LENGTH];
    struct stat found;
    return snprintf(path, sizeof path, "%s/%s", folder, name) < (int)sizeof path && stat(path, &found) == 0;
}

bool folder_contains_study_table(const char *folder)
{
    return run_folder_has_file(folder, "sweep.csv") || run_folder_has_file(folder, "converge.csv");
}

status run_read_frame(struct output_frame *f, const char *folder, int frame_number)
{
    const struct path path = run_frame_path(folder, frame_number);
    return path.text[0] ? frame_read(f, path.text)
                        : status_set(FAILED, "%s: the name is too long; choose a shorter one", folder);
}

/* Selects at most `panels` of the output frames r->list to be shown, evenly spread from the first to the last. If
 * panels is 1, selects the last frame. Allocates r->show. Release it with run_frames_free. */
static void spread_frames(struct run_frames *r, int panels)
{
    r->shown = r->listed < panels ? r->listed : panels;
    r->show = NEW("plot.show", r->shown, struct listed_frame);
    for (int k = 0; k < r->shown; k++)
        r->show[k] = r->list[r->shown == 1 ? r->listed - 1 : (int)lround((double)k * (r->listed - 1) / (r->shown - 1))];
}

/* Selects in r for each of time[times] [s] the output frame that is nearest to it. An infinite time selects the last
 * frame. Allocates r->show, which run_frames_free releases. A frame that is nearest to several consecutive times is
 * selected once. */
static void nearest_frames(struct run_frames *r, const double *time, int times)
{
    r->show = NEW("plot.show", times, struct listed_frame);
    for (int k = 0; k < times; k++) {
        int best = 0;
        if (isinf(time[k])) best = r->listed - 1;
        for (int j = 1; j < r->listed && !isinf(time[k]); j++)
            if (fabs(r->list[j].time - time[k]) < fabs(r->list[best].time - time[k])) best = j;
        if (r->shown == 0 || r->show[r->shown - 1].number != r->list[best].number) r->show[r->shown++] = r->list[best];
    }
}

/* Checks that the requested times time[times] [s], unless infinite (the last frame), are within the range of the output
 * frames f, extended by the mean time between frames at both ends. Returns REFUSED, with a message, if one is not, else
 * OK. */
static status times_within(const struct run_frames *f, const double *time, int times)
{
    if (f->listed == 0) return OK;
    const double first = f->list[0].time, last = f->list[f->listed - 1].time;
    const double beside = f->listed > 1 ? (last - first) / (f->listed - 1) : INFINITY;
    const struct unit second = unit_with_si_prefix_for_largest_value(last, "s");
    for (int k = 0; k < times; k++)
        if (!isinf(time[k]) && (time[k] < fmin(first - beside, 0) || time[k] > last + beside))
            return status_set(REFUSED, "plot: --times: %.4g %s is not in the run; give times from %.4g to %.4g %s",
                              time[k] / second.factor, second.name, first / second.factor, last / second.factor,
                              second.name);
    return OK;
}

/* Replaces numbers of load steps among time[r->times] by their times [s], which history.csv of the run of request r
 * states. Does nothing unless the run has load steps and a number without unit is given (r->bare). Returns REFUSED if
 * the run has no such step, FAILED if the file cannot be read, both with a message. */
static status steps_to_times(double *time, const struct plot_request *r)
{
    struct history h;
    bool any = false;
    for (int k = 0; k < r->times; k++) any |= r->bare[k];
    if (!any || !r->projection.in_steps) return OK;
    TRY(history_read(&h, r->folder));
    const int step = history_find_column(&h, "step"), at = history_find_column(&h, "time");
    status s = OK;
    for (int k = 0; k < r->times && s == OK; k++) {
        int64_t row = 0;
        while (r->bare[k] && row < h.rows && history_value_at(&h, row, step) != r->time[k]) row++;
        if (row < h.rows && r->bare[k]) time[k] = history_value_at(&h, row, at);
        if (row == h.rows)
            s = status_set(REFUSED, "plot: --times: load step %.0f is not in the run; give steps from %.0f to %.0f",
                           r->time[k], history_value_at(&h, 0, step), history_value_at(&h, h.rows - 1, step));
    }
    history_free(&h);
    return s;
}

status run_frames_list_and_select(struct run_frames *f, const struct plot_request *r)
{
    *f = (struct run_frames){0};
    double time[PANELS_MAX];
    memcpy(time, r->time, sizeof time);
    TRY(steps_to_times(time, r));
    TRY(run_list_frames(r->folder, &f->listed, &f->list));
    const status within = times_within(f, time, r->times);
    if (within != OK) run_frames_free(f);
    TRY(within);
    if (r->times > 0)
        nearest_frames(f, time, r->times);
    else
        spread_frames(f, r->panels);
    return OK;
}

void run_frames_free(struct run_frames *f)
{
    memory_free(f->show);
    memory_free(f->list);
    *f = (struct run_frames){0};
}

status frames_read_selected(struct output_frame **f, const char *folder, const struct run_frames *frames)
{
    *f = NEW("plot.frames", frames->shown, struct output_frame);
    for (int k = 0; k < frames->shown; k++) {
        const status s = run_read_frame(&(*f)[k], folder, frames->show[k].number);
        if (s == OK) continue;
        frames_free(*f, k);
        return s;
    }
    return OK;
}

void frames_free(struct output_frame *frames, int frame_count)
{
    for (int k = 0; k < frame_count; k++) frame_free(&frames[k]);
    memory_free(frames);
}

status pictures_folder_create(const char *path, bool overwrite)
{
    if (path_is_link(path))
        return status_set(REFUSED, "%s is a symbolic link, so pictures would be written to another folder; remove it",
                          path);
    TRY(folder_create_with_parents(path));
    return overwrite ? OK : folder_visit_selected_files(path, file_name_is_of_picture, "", picture_check_replaceable);
}

status picture_choose_path_by_output_option(struct path *path, const char *option_argument, const char *name,
                                            bool overwrite)
{
    const char *end = strrchr(option_argument, '/');
    if (!*option_argument || strlen(option_argument) >= sizeof path->text)
        return status_set(REFUSED, "plot: -o '%s': give the name of a file or folder",
                          printable_name(option_argument).text);
    TRY(folder_create_parents_of_file(option_argument));
    if (end > option_argument && !end[1]) {
        struct path above;
        snprintf(above.text, sizeof above.text, "%.*s", (int)(end - option_argument), option_argument);
        *path = path_join(above.text, name);
    } else if (path_is_folder(option_argument))
        *path = path_join(option_argument, name);
    else
        snprintf(path->text, sizeof path->text, "%s", option_argument);
    if (!path->text[0])
        return status_set(REFUSED, "%s: the name is too long; choose a shorter one",
                          printable_name(option_argument).text);
    TRY(file_check_replaceable(path->text));
    if (overwrite || !path_exists(path->text) || picture_file_is_from_cleave(path->text)) return OK;
    return status_set(REFUSED,
                      "plot: %s exists and was not drawn by cleave; choose another -o, or replace it with --overwrite",
                      path->text);
}

bool projection_shows_single_equilibrium_run(const struct projection *projection)
{
    const struct scene *s = projection->scene;
    return s && (s->solver == SOLVER_RELAXATION || s->solver == SOLVER_CG);
}

bool frame_compose_label_if_static(char text[NAME_MAX_LENGTH], bool has_load_steps, bool equilibrium, double t,
                                   int64_t step)
{
    text[0] = '\0';
    if (equilibrium)
        snprintf(text, NAME_MAX_LENGTH, "%s", t > 0 ? "equilibrium" : "without loads");
    else if (has_load_steps)
        snprintf(text, NAME_MAX_LENGTH, "load step %lld", (long long)step);
    return text[0] != '\0';
}

/* ---- words ------------------------------------------------------------------------------------------------------- */

/* Prints that the picture `path` is not drawn, with the reason `reason`, and removes an older picture of this name if
 * Cleave drew it. Returns FAILED if standard output cannot be written. */
status picture_report_not_drawn_and_remove_old(const char *path, const char *reason)
{
    const char *slash = strrchr(path, '/');
    if (picture_file_is_from_cleave(path)) remove(path);
    return printf("%s is not drawn: %s\n", slash ? slash + 1 : path, reason) < 0
               ? status_set(FAILED, "cannot write to standard output")
               : OK;
}

/* Writes a factor to text[capacity]: from 10,000 on a whole number with a blank after every three digits, as `30 000`,
 * else four significant digits. */
static void write_factor(char *text, size_t capacity, double factor)
{
    char digits[32];
    size_t used = 0;
    const int length = snprintf(digits, sizeof digits, factor < 9999.5 ? "%.4g" : "%.0f", factor);
    *text = '\0';
    for (int k = 0; k < length && used + 3 < capacity; k++) {
        if (k > 0 && factor >= 9999.5 && (length - k) % 3 == 0) text[used++] = ' ';
        text[used++] = digits[k];
        text[used] = '\0';
    }
}

void picture_compose_title(char *title, const struct plot_request *r, const char *quantity,
                           const struct plotted_particles *plotted, const struct view *view)
{
    const char *folder = r->folder;
    char name[NAME_MAX_LENGTH], method[NAME_MAX_LENGTH], layer[NAME_MAX_LENGTH] = "";
    if (summary_read_string(folder, "name", name, sizeof name) != OK) path_copy_base_name(name, sizeof name, folder);
    bool known = summary_read_string(folder, "method", method, sizeof method) == OK;
    if (plotted != NULL && plotted->normal >= 0) {
        const struct unit metre = panel_choose_length_unit_of_axes(view);
        snprintf(layer, sizeof layer, ", %c = %.4g %s", 'x' + plotted->normal, plotted->layer / metre.factor,
                 metre.name);
    }
    if (r->title)
        snprintf(title, TITLE_LENGTH, "%s", r->title);
    else
        snprintf(title, TITLE_LENGTH, "%s%s%s: %s%s", name, known ? ", " : "", known ? method : "", quantity, layer);
    const size_t length = strlen(title);
    if (plotted == NULL || plotted->magnify == 1) return;
    char factor[32];
    write_factor(factor, sizeof factor, plotted->magnify);
    snprintf(title + length, TITLE_LENGTH - length, "%sdisplacements x %s", length > 0 ? ", " : "", factor);
}
