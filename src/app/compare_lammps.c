/* Reads the results of LAMMPS runs for `cleave compare`, and compares their first steps with the particle states that
 * Cleave computed at the export (check.csv). */
#include "compare_lammps.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/memory.h"
#include "output/history.h"
#include "output/lammps_dump.h"
#include "output/output_files.h"
#include "plot/plot.h"

bool lammps_run_exists(const char *folder)
{
    return run_folder_has_file(folder, "plate.dump") && run_folder_has_file(folder, "in.lammps");
}

/* Reads the time step from the LAMMPS script in.lammps in `folder` to *dt [s]. Returns FAILED, with a message, if there
 * is no script or it has no such line. */
static status lammps_time_step(const char *folder, double *dt)
{
    struct path path = path_join(folder, "in.lammps");
    char line[256];
    FILE *from = path_is_file(path.text) ? fopen(path.text, "r") : NULL;
    *dt = 0;
    while (from && *dt == 0 && fgets(line, sizeof line, from))
        if (sscanf(line, "timestep %lf", dt) != 1) *dt = 0;
    if (from) fclose(from);
    return *dt > 0 && isfinite(*dt)
               ? OK
               : status_set(FAILED, "%s has no line `timestep`, from which the times of frames follow; add it",
                            printable_name(path.text).text);
}

status lammps_run_list_frames(const char *folder, int *frame_count, struct listed_frame **frames)
{
    double dt;
    int64_t *step;
    *frame_count = 0, *frames = NULL;
    TRY(lammps_time_step(folder, &dt));
    TRY(lammps_list_step_numbers(path_join(folder, "plate.dump").text, frame_count, &step));
    *frames = NEW("compare.frames", *frame_count, struct listed_frame);
    for (int k = 0; k < *frame_count; k++) (*frames)[k] = (struct listed_frame){(int)step[k], (real)step[k] * dt};
    memory_free(step);
    return OK;
}

/* ---- check.csv --------------------------------------------------------------------------------------------------- */

/* The table check.csv, which holds particle states computed by Cleave, and the columns of reference position X,
 * position x [m], damage, and damage at the start. */
struct check {
    struct history h;
    int X[DIM_MAX], x[DIM_MAX], damage, start;
};

static double check_at(const struct check *c, int64_t i, int column) { return c->h.value[i * c->h.columns + column]; }

/* Sorts the n rows of check.csv in c by particle id, in a new array that replaces the old one. path: file name for
 * messages. Returns FAILED unless all columns are present and the ids are 1..n. */
static status check_sort(struct check *c, int64_t n, const char *path)
{
    const int id = history_find_column(&c->h, "id"), columns = c->h.columns;
    bool whole = id >= 0 && c->h.rows == n && c->damage >= 0 && c->start >= 0;
    for (int d = 0; d < DIM_MAX; d++) whole = whole && c->X[d] >= 0 && c->x[d] >= 0;
    double *sorted = NEW("compare.check", n * columns, double);
    for (int64_t k = 0; k < n && whole; k++) {
        const double of = c->h.value[k * columns + id];
        whole = of >= 1 && of <= (double)n;
        if (whole) array_copy(sorted + ((int64_t)of - 1) * columns, c->h.value + k * columns, columns, sizeof(double));
    }
    for (int64_t k = 0; k < n && whole; k++) whole = (int64_t)sorted[k * columns + id] == k + 1;
    memory_free(whole ? c->h.value : sorted);
    if (whole) c->h.value = sorted;
    if (whole) return OK;
    return status_set(
        FAILED,
        "%s does not list each of the scene's %lld particles exactly once; repeat the LAMMPS run in this folder",
        printable_name(path).text, (long long)n);
}

static status check_read(struct check *c, const char *folder, int64_t n)
{
    const char *upper[] = {"X", "Y", "Z"}, *lower[] = {"x", "y", "z"};
    const struct path path = path_join(folder, "check.csv");
    TRY(history_read_file(&c->h, path.text));
    for (int d = 0; d < DIM_MAX; d++)
        c->X[d] = history_find_column(&c->h, upper[d]), c->x[d] = history_find_column(&c->h, lower[d]);
    c->damage = history_find_column(&c->h, "damage"), c->start = history_find_column(&c->h, "damage_start");
    const status s = check_sort(c, n, path.text);
    if (s != OK) history_free(&c->h);
    return s;
}

/* ---- frames ------------------------------------------------------------------------------------------------------ */

/* Returns true if all reference positions in the table c have z = 0, so that the run is two-dimensional. */
static bool lies_in_plane(const struct check *c)
{
    for (int64_t i = 0; i < c->h.rows; i++)
        if (check_at(c, i, c->X[2]) != 0) return false;
    return true;
}

static void frame_fill(struct output_frame *f, const struct lammps_frame *from, const struct check *c)
{
    f->n = from->n, f->step = from->step, f->dim = lies_in_plane(c) ? 2 : 3;
    for (int d = 0; d < f->dim; d++) {
        f->X[d] = NEW("frame.X", f->n, real), f->u[d] = NEW("frame.u", f->n, float);
        f->v[d] = NEW("frame.v", f->n, float);
        for (int64_t i = 0; i < f->n; i++) {
            f->X[d][i] = check_at(c, i, c->X[d]), f->v[d][i] = (float)from->v[d][i];
            f->u[d][i] = (float)(from->x[d][i] - check_at(c, i, c->X[d]));
        }
    }
    f->damage = NEW("frame.damage", f->n, float), f->id = NEW("frame.id", f->n, int32_t);
    f->kind = NEW("frame.kind", f->n, uint8_t);
    f->material = NEW("frame.material", f->n, uint8_t), f->body = NEW("frame.body", f->n, uint8_t);
    for (int64_t i = 0; i < f->n; i++) {
        const double start = check_at(c, i, c->start);
        f->damage[i] =
            /* damage in LAMMPS counts the bonds that exist at the start */
            (float)(start + (1 - start) * from->damage[i]);
        f->id[i] = (int32_t)i, f->kind[i] = KIND_PD;
    }
}

status lammps_run_read_frame(struct output_frame *f, const char *folder, int frame_number)
{
    struct lammps_frame from;
    struct check c = {0};
    double dt;
    *f = (struct output_frame){0};
    TRY(lammps_time_step(folder, &dt));
    TRY(lammps_frame_read(&from, path_join(folder, "plate.dump").text, frame_number));
    const status s = check_read(&c, folder, from.n);
    if (s == OK) {
        frame_fill(f, &from, &c);
        f->t = (real)from.step * dt;
        history_free(&c.h);
    }
    lammps_frame_free(&from);
    return s;
}

/* ---- the check --------------------------------------------------------------------------------------------------- */

/* Prints the largest differences in displacement and damage between the frame f (output at one time) of LAMMPS and the
 * states of Cleave in check.csv, c. */
static void check_print(const struct check *c, const struct lammps_frame *f)
{
    double apart = 0, size = 0, damage = 0;
    int64_t other = 0;
    for (int64_t i = 0; i < f->n; i++) {
        double a = 0, u = 0;
        for (int d = 0; d < DIM_MAX; d++) {
            a += square(f->x[d][i] - check_at(c, i, c->x[d]));
            u += square(check_at(c, i, c->x[d]) - check_at(c, i, c->X[d]));
        }
        const double differs = fabs(f->damage[i] - check_at(c, i, c->damage));
        apart = fmax(apart, a), size = fmax(size, u), damage = fmax(damage, differs);
        other += differs > 1e-9;
    }
    printf("\nLAMMPS beside Cleave, from the same start, after %lld steps\n", (long long)f->step);
    printf("  max |u - u_LAMMPS| / max |u|   %.3g%s\n", size > 0 ? sqrt(apart / size) : 0,
           apart <= 1e-18 * size ? " (round-off)" : "");
    printf("  particles whose broken bonds differ %lld of %lld, their damage by at most %.3g\n", (long long)other,
           (long long)f->n, damage);
}

status lammps_print_differences_from_export(const char *folder)
{
    struct lammps_frame f;
    struct check c = {0};
    int n;
    int64_t *step;
    const struct path dump = path_join(folder, "check.dump");
    if (!run_folder_has_file(folder, "check.dump") || !run_folder_has_file(folder, "check.csv")) return OK;
    TRY(lammps_list_step_numbers(dump.text, &n, &step));
    const int64_t last = step[n - 1];
    memory_free(step);
    if (last == 0) return OK; /* LAMMPS has not reached this step */
    TRY(lammps_frame_read(&f, dump.text, last));
    const status s = check_read(&c, folder, f.n);
    if (s == OK) check_print(&c, &f);
    if (s == OK) history_free(&c.h);
    lammps_frame_free(&f);
    return s;
}
