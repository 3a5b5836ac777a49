/* Reads text dumps of LAMMPS line by line, because they may be larger than memory. */
#include "output/lammps_dump.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>

#include "base/memory.h"

enum {
    LINE_ROOM = 1024,
    FRAME_COLUMNS_MOST = 32,
    LEAST_LINE = 8
}; /* LEAST_LINE: bytes of `1 0 0 0\n`, the shortest
    * possible line */

/* Quantities that are read from a dump, by the names of their columns; WANTED: their number. */
enum { WANTED = 8 };
static const char *const wanted_name[WANTED] = {"id", "x", "y", "z", "vx", "vy", "vz", "c_damage"};

/* A dump file of LAMMPS while it is read line by line. bytes: size of the file; text: the current line; line: number of
 * this line, from 1. */
struct dump {
    FILE *file;
    const char *path;
    int64_t bytes, line;
    char text[LINE_ROOM];
};

/* Header of one time step in a dump of LAMMPS: number of the step, number n of particles, and for each quantity of
 * wanted_name the number of its column, -1 if the dump does not have it. */
struct dump_head {
    int64_t step, n;
    int column[WANTED];
};

static status dump_fault(const struct dump *d, const char *what)
{
    return status_set(FAILED, "%s:%lld: %s", printable_name(d->path).text, (long long)d->line, what);
}

static status dump_open(struct dump *d, const char *path)
{
    struct stat s;
    *d = (struct dump){.path = path};
    if (stat(path, &s) != 0 || !S_ISREG(s.st_mode) || !(d->file = fopen(path, "r")))
        return status_set(FAILED, "cannot read %s, because there is no such file; run LAMMPS in this folder first",
                          printable_name(path).text);
    d->bytes = s.st_size;
    return OK;
}

/* Reads the next line of the dump into d->text. Returns false at the end of the file and if the line is incomplete. */
static bool dump_line(struct dump *d)
{
    d->line++;
    return fgets(d->text, sizeof d->text, d->file) && strchr(d->text, '\n');
}

static bool dump_whole_number(const char *text, int64_t *value)
{
    char *end;
    errno = 0;
    *value = strtoll(text, &end, 10);
    return end != text && errno == 0 && end[strspn(end, " \r\n")] == '\0';
}

static bool dump_begins(const char *text, const char *with) { return strncmp(text, with, strlen(with)) == 0; }

static status head_columns(struct dump *d, struct dump_head *h)
{
    char *rest = d->text + strlen("ITEM: ATOMS");
    for (int w = 0; w < WANTED; w++) h->column[w] = -1;
    int k = 0;
    for (char *name = strtok_r(rest, " \r\n", &rest); name; name = strtok_r(NULL, " \r\n", &rest), k++) {
        if (k == FRAME_COLUMNS_MOST) return dump_fault(d, "too many columns");
        for (int w = 0; w < WANTED; w++)
            if (strcmp(name, wanted_name[w]) == 0) h->column[w] = k;
    }
    for (int w = 0; w < 4; w++)
        if (h->column[w] < 0)
            return dump_fault(d, "the columns id, x, y and z are missing; add them to the dump command");
    return OK;
}

/* Reads the header of the next time step of the dump d into *h. Sets *more to false if the file ends before the header
 * is complete, else to true. Returns FAILED, with a message, for text that is no dump of LAMMPS. */
static status head_next(struct dump *d, struct dump_head *h, bool *more)
{
    *more = dump_line(d);
    if (!*more) return OK;
    if (!dump_begins(d->text, "ITEM: TIMESTEP"))
        return dump_fault(d, "ITEM: TIMESTEP is missing; give a text dump of LAMMPS");
    h->n = -1;
    if ((*more = dump_line(d)) && !dump_whole_number(d->text, &h->step))
        return dump_fault(d, "the number of a step is missing; repeat the LAMMPS run");
    while (*more && (*more = dump_line(d)) && !dump_begins(d->text, "ITEM: ATOMS")) {
        if (!dump_begins(d->text, "ITEM: NUMBER OF ATOMS")) continue;
        if (!(*more = dump_line(d))) break;
        if (!dump_whole_number(d->text, &h->n) || h->n < 0 || h->n > d->bytes / LEAST_LINE || h->n > INT32_MAX)
            return dump_fault(d, "is not a possible number of particles: the file is too short for it, or damaged; "
                                 "repeat the LAMMPS run");
    }
    if (!*more) return OK;
    return h->n < 0 ? dump_fault(d, "ITEM: NUMBER OF ATOMS is missing; repeat the LAMMPS run") : head_columns(d, h);
}

/* Skips n lines of the dump d. Returns false if the file ends before the last of them. */
static bool skip_rows(struct dump *d, int64_t n)
{
    bool more = true;
    for (int64_t k = 0; k < n && more; k++) more = dump_line(d);
    return more;
}

/* Appends the numbers of all complete time steps of the dump d to the array *step of *n entries, which grows; the
 * caller releases it. Returns FAILED, with a message, if they do not ascend or a header is malformed. */
static status steps_read(struct dump *d, int *n, int64_t **step)
{
    struct dump_head h;
    bool more;
    for (;;) {
        TRY(head_next(d, &h, &more));
        if (!more || !skip_rows(d, h.n)) return OK;
        if (*n > 0 && h.step <= (*step)[*n - 1])
            return dump_fault(d, "steps are not in ascending order; repeat the LAMMPS run");
        GROW("dump.steps", *step, *n + 1);
        (*step)[(*n)++] = h.step;
    }
}

status lammps_list_step_numbers(const char *path, int *step_count, int64_t **step_numbers)
{
    struct dump d;
    *step_count = 0, *step_numbers = NULL;
    TRY(dump_open(&d, path));
    const status s = steps_read(&d, step_count, step_numbers);
    fclose(d.file);
    if (s == OK && *step_count > 0) return OK;
    memory_free(*step_numbers);
    *step_numbers = NULL, *step_count = 0;
    return s != OK ? s
                   : status_set(FAILED,
                                "%s does not yet contain a complete time step of a LAMMPS dump; wait for the LAMMPS "
                                "run, or repeat it",
                                printable_name(path).text);
}

/* ---- particles --------------------------------------------------------------------------------------------------- */

/* Allocates the arrays of the output frame f for the number of particles in the header h. Release them with
 * lammps_frame_free. */
static void lammps_frame_make(struct lammps_frame *f, const struct dump_head *h)
{
    f->n = h->n, f->step = h->step;
    for (int d = 0; d < DIM_MAX; d++) {
        f->x[d] = NEW("dump.x", f->n, double);
        f->v[d] = NEW("dump.v", f->n, double);
    }
    f->damage = NEW("dump.damage", f->n, double);
}

void lammps_frame_free(struct lammps_frame *f)
{
    for (int d = 0; d < DIM_MAX; d++) memory_free(f->x[d]), memory_free(f->v[d]);
    memory_free(f->damage);
    *f = (struct lammps_frame){0};
}

/* Reads the quantities of one particle from the current line of d into value[WANTED], in the order of wanted_name (id,
 * position, velocity, damage); 0 for quantities that the dump does not have. h: header with their columns. Returns
 * false if a column is missing or not a finite number. */
static bool dump_row_read(const struct dump *d, const struct dump_head *h, double value[WANTED])
{
    double number[FRAME_COLUMNS_MOST];
    const char *at = d->text;
    int n = 0;
    for (char *end; n < FRAME_COLUMNS_MOST; n++, at = end) {
        number[n] = strtod(at, &end);
        if (end == at) break;
    }
    for (int w = 0; w < WANTED; w++) {
        if (h->column[w] >= n) return false;
        value[w] = h->column[w] < 0 ? 0 : number[h->column[w]];
        if (!isfinite(value[w])) return false;
    }
    return true;
}

/* Reads the lines of all particles of the time step with header h from the dump d into f, in the order of their ids.
 * seen[h->n]: working memory, all 0 before, that marks the ids read. Returns FAILED, with a message, if an id is
 * repeated or out of range, or a line is malformed. */
static status rows_take(struct dump *d, const struct dump_head *h, struct lammps_frame *f, uint8_t *seen)
{
    double value[WANTED];
    for (int64_t k = 0; k < h->n; k++) {
        if (!dump_line(d) || !dump_row_read(d, h, value))
            return dump_fault(d, "the numbers of a particle are missing; repeat the LAMMPS run");
        if (!(value[0] >= 1 && value[0] <= (double)h->n))
            return dump_fault(d, "ids must be from 1 to the number of particles; repeat the LAMMPS run");
        const int64_t i = (int64_t)value[0] - 1;
        if (seen[i]++) return dump_fault(d, "an id occurs twice");
        for (int a = 0; a < DIM_MAX; a++) f->x[a][i] = value[1 + a], f->v[a][i] = value[4 + a];
        f->damage[i] = value[7];
    }
    return OK;
}

static status frame_find(struct dump *d, struct lammps_frame *f, int64_t step)
{
    struct dump_head h;
    bool more;
    for (;;) {
        TRY(head_next(d, &h, &more));
        if (!more)
            return status_set(FAILED, "%s has no step %lld; repeat the LAMMPS run up to this step",
                              printable_name(d->path).text, (long long)step);
        if (h.step == step) break;
        if (!skip_rows(d, h.n)) h.n = 0;
    }
    lammps_frame_make(f, &h);
    uint8_t *seen = NEW("dump.seen", h.n, uint8_t);
    const status s = rows_take(d, &h, f, seen);
    memory_free(seen);
    if (s != OK) lammps_frame_free(f);
    return s;
}

status lammps_frame_read(struct lammps_frame *f, const char *path, int64_t step)
{
    struct dump d;
    *f = (struct lammps_frame){0};
    TRY(dump_open(&d, path));
    const status s = frame_find(&d, f, step);
    fclose(d.file);
    return s;
}
