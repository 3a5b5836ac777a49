/* Finds narrow parts that have one particle row too many or too few because their width is no multiple of the spacing,
 * even if the volume of the whole body is right. The area of each section of the shape is compared with that of the
 * particles in it. A section is a connected set of cells in a slice normal to an axis. Along a part, errors from the
 * steps of slanting and curved faces average out. */
#include <math.h>
#include <stdio.h>

#include "base/memory.h"
#include "check_parts.h"
#include "check_uneven.h"

#define OFF_SLANTING 0.05 /* least relative error of sections that is reported if faces are slanting or curved */
#define ALIKE 0.2         /* largest relative difference in area of the sections of one part, */
#define EVEN 0.04         /* ... and of sections with faces along the axis */
#define COVERED 0.02      /* least share of a covered cell */
enum { SLICES = 8, SLICES_LEAST = 3, SLICES_SLANTING = 32 }; /* numbers of sections of a part that are summed */

/* One section of a body: a connected set of covered cells in one slice, which is a layer of cells normal to an axis. */
struct section {
    int64_t slice, cell, n; /* index of the slice, of one of its cells; number of cells */
    real area, filled;      /* area of the shape, of the particles [cells] */
    int32_t before, after;  /* largest section that it touches in the previous and in the next slice; -1: none */
};

/* All sections of one piece of a body (connected sets of covered cells) in slices normal to one axis. */
struct sections {
    const struct cell_coverage *cover; /* share of each cell that the shape covers */
    int axis, across[2];               /* axis of the slices; the other axes */
    int64_t stride, side[2];           /* index offset from a cell to the next slice; to neighbours in the slice */
    int32_t n;
    struct section *section; /* [n] */
    int32_t *of;             /* [cells] section of a cell, -1: none */
    uint8_t *named; /* [cells] bit d: the cell belongs to a part that was reported for its width along axis d */
};

static bool is_covered(const struct cell_coverage *c, int64_t cell)
{
    return c->filled[cell] || c->share[cell] > COVERED;
}

static int32_t section_new(struct sections *s, int64_t slice, int64_t cell)
{
    GROW("check.sections", s->section, s->n + 1);
    s->section[s->n] = (struct section){.slice = slice, .cell = cell, .before = -1, .after = -1};
    return s->n++;
}

/* Creates a section in s: the set of covered cells in slice number `slice` that are connected to the cell `first`.
 * Slices are layers of cells normal to one axis. A cell is covered if it contains a particle or at least a small part
 * of the shape (COVERED). Sums the area of the shape and that of the particles in the section. stack: work array with
 * an element for each cell of a slice. */
static void section_flood(struct sections *s, int64_t slice, int64_t first, int64_t *stack)
{
    const struct cell_coverage *c = s->cover;
    const int32_t number = section_new(s, slice, first);
    struct section *section = &s->section[number];
    int64_t top = 0;
    stack[top++] = first, s->of[first] = number;
    while (top > 0) {
        const int64_t cell = stack[--top];
        int64_t at[DIM_MAX];
        section->n++, section->area += c->share[cell], section->filled += c->filled[cell];
        cell_coverage_compute_lattice_indices_of_cell(c, cell, at);
        for (int k = 0; k < 4; k++) {
            const int d = s->across[k / 2], way = k % 2 ? 1 : -1;
            const int64_t next = cell + way * s->side[k / 2];
            if (at[d] + way < 0 || at[d] + way >= c->n[d]) continue;
            if (s->of[next] >= 0 || !is_covered(c, next)) continue;
            s->of[next] = number, stack[top++] = next;
        }
    }
}

/* Returns the number of that one of the sections a and b of s (connected cells in a slice) which has the larger area. A
 * number -1 denotes no section; -1 is returned if both are -1. */
static int32_t larger(const struct sections *s, int32_t a, int32_t b)
{
    return a < 0 ? b : b < 0 || s->section[a].area >= s->section[b].area ? a : b;
}

/* Divides a piece into slices one lattice cell thick, normal to `axis`, and each slice into sections. A section is a
 * connected set of cells that the body covers. Finds for each section the largest section that it touches in the next
 * and in the previous slice. c: lattice cells of the piece; named[cells]: marks of parts that have been reported; c and
 * named are stored by reference in s. Release s with sections_free. */
static void sections_make(struct sections *s, const struct cell_coverage *c, int axis, uint8_t *named)
{
    const int64_t stride[DIM_MAX] = {1, c->n[0], c->n[0] * c->n[1]};
    *s = (struct sections){.cover = c, .axis = axis, .stride = stride[axis], .named = named};
    s->across[0] = (axis + 1) % DIM_MAX, s->across[1] = (axis + 2) % DIM_MAX;
    for (int k = 0; k < 2; k++) s->side[k] = stride[s->across[k]];
    s->of = NEW("check.sections", c->cells, int32_t);
    for (int64_t k = 0; k < c->cells; k++) s->of[k] = -1;
    int64_t *stack = NEW("check.stack", c->cells / c->n[axis], int64_t);
    for (int64_t k = 0; k < c->cells; k++) {
        int64_t at[DIM_MAX];
        if (s->of[k] >= 0 || !is_covered(c, k)) continue;
        cell_coverage_compute_lattice_indices_of_cell(c, k, at);
        section_flood(s, at[axis], k, stack);
    }
    memory_free(stack);
    for (int64_t k = 0; k + s->stride < c->cells; k++) {
        const int64_t next = k + s->stride;
        int64_t at[DIM_MAX];
        cell_coverage_compute_lattice_indices_of_cell(c, k, at);
        if (at[axis] + 1 == c->n[axis] || s->of[k] < 0 || s->of[next] < 0) continue;
        struct section *here = &s->section[s->of[k]], *there = &s->section[s->of[next]];
        here->after = larger(s, here->after, s->of[next]);
        there->before = larger(s, there->before, s->of[k]);
    }
}

static void sections_free(struct sections *s)
{
    memory_free(s->section);
    memory_free(s->of);
}

/* Returns true if a part of constant width continues at section number k of s (connected cells in a slice): the section
 * exists (k >= 0), touches sections in the previous and next slice, and has the area `area` [cells] to within the
 * relative tolerance ALIKE. */
static bool goes_on_alike(const struct sections *s, int32_t k, real area)
{
    return k >= 0 && s->section[k].before >= 0 && s->section[k].after >= 0 &&
           fabs(s->section[k].area - area) <= ALIKE * area;
}

/* Returns the mean width of the section with the index `number` along the axis s->across[k] [cells]: its area divided
 * by the number of lines of cells along this axis that it occupies. filled: true for the area of the particles, false
 * for the area of the shape. */
static real width_along(const struct sections *s, int32_t number, int k, bool filled)
{
    const struct cell_coverage *c = s->cover;
    const struct section *section = &s->section[number];
    const int64_t lines = c->n[s->across[1 - k]], base = section->slice * s->stride;
    real sum = 0;
    for (int64_t line = 0; line < lines; line++) {
        real most = 0;
        for (int64_t m = 0; m < c->n[s->across[k]]; m++) {
            const int64_t cell = base + line * s->side[1 - k] + m * s->side[k];
            if (s->of[cell] == number) most = real_max(most, filled ? c->filled[cell] : c->share[cell]);
        }
        sum += most;
    }
    return sum > 0 ? (filled ? section->filled : section->area) / sum : 0;
}

/* Returns the description of section number `number` of s (connected cells in a slice), which has a wrong number of
 * particle rows: its centre, and the widths of shape and particles along the axis along which they differ most. off:
 * relative error of its area [1]. */
static struct narrow_part uneven_of(const struct sections *s, int32_t number, real off)
{
    const struct cell_coverage *c = s->cover;
    struct narrow_part u = {.off = off, .across = s->axis};
    real worst = -1, sum = 0;
    for (int k = 0; k < 2; k++) {
        if (c->n[s->across[k]] == 1) continue;
        const real width = width_along(s, number, k, false), filled = width_along(s, number, k, true);
        if (!(width > 0) || fabs(filled / width - 1) <= worst) continue;
        worst = fabs(filled / width - 1);
        u.width = width * c->spacing, u.filled = filled * c->spacing, u.axis = s->across[k];
    }
    const int64_t base = s->section[number].slice * s->stride;
    for (int64_t a = 0; a < c->n[s->across[0]]; a++)
        for (int64_t b = 0; b < c->n[s->across[1]]; b++) {
            const int64_t cell = base + a * s->side[0] + b * s->side[1];
            int64_t at[DIM_MAX];
            if (s->of[cell] != number) continue;
            cell_coverage_compute_lattice_indices_of_cell(c, cell, at);
            sum += c->share[cell];
            for (int d = 0; d < c->dim; d++) u.at[d] += c->share[cell] * (c->first[d] + (real)at[d] * c->spacing);
        }
    for (int d = 0; d < c->dim; d++) u.at[d] /= sum;
    return u;
}

/* Sums over consecutive sections (connected sets of cells in slices) of nearly equal area. slices: number of sections;
 * middle: index of the section in the middle; area, filled: summed areas of the shape and of the particles [cells]. */
struct stretch {
    int slices;
    int32_t middle;
    real area, filled;
    bool even; /* all sections have equal numbers of particles: their faces are along the axis */
};

/* Adds up, over at most `most` consecutive sections of s (connected cells in a slice) whose areas equal that of the
 * first one to within the relative difference ALIKE, the areas of shape and particles. The first one is section number
 * `first`; the others follow in ascending order of slices. Returns the sums, the number of sections, the one in the
 * middle, and whether all have equal numbers of particles and equal areas (to within EVEN). */
static struct stretch stretch_from(const struct sections *s, int32_t first, int most)
{
    const struct section *begin = &s->section[first];
    struct stretch t = {.middle = first, .even = true};
    for (int32_t k = first; t.slices < most && goes_on_alike(s, k, begin->area); k = s->section[k].after) {
        const struct section *here = &s->section[k];
        t.area += here->area, t.filled += here->filled, t.slices++;
        t.even = t.even && here->filled == begin->filled && fabs(here->area - begin->area) <= EVEN * begin->area;
        if (t.slices <= most / 2) t.middle = k;
    }
    return t;
}

/* Marks the cells of a narrow part in s->named, so that it is reported only once. The part consists of section `from`
 * and of the sections before and after it that have the same area to within the relative difference ALIKE. axis: axis
 * along which the width of the part is wrong. */
static void part_mark(const struct sections *s, int32_t from, int axis)
{
    const real area = s->section[from].area;
    int32_t first = from;
    while (goes_on_alike(s, s->section[first].before, area)) first = s->section[first].before;
    for (int32_t k = first; goes_on_alike(s, k, area); k = s->section[k].after) {
        const int64_t base = s->section[k].slice * s->stride;
        for (int64_t a = 0; a < s->cover->n[s->across[0]]; a++)
            for (int64_t b = 0; b < s->cover->n[s->across[1]]; b++) {
                const int64_t cell = base + a * s->side[0] + b * s->side[1];
                if (s->of[cell] == k) s->named[cell] |= (uint8_t)(1 << axis);
            }
    }
}

/* Compares the area of the shape with the area of the particles in the narrow part that begins with section `first` of
 * s (connected cells in a slice). Adds the part to `list` if they differ by more than a relative tolerance, which is
 * larger for slanting faces. Both areas are summed over SLICES consecutive sections. If the areas of these sections are
 * unequal, as between slanting faces, they are summed over SLICES_SLANTING sections, so that errors from the steps of
 * such faces average out. */
static void part_judge(const struct sections *s, int32_t first, struct width_misfit_list *list)
{
    const struct section *begin = &s->section[first];
    struct stretch t = stretch_from(s, first, SLICES);
    if (!t.even) t = stretch_from(s, first, SLICES_SLANTING);
    const bool short_one =
        t.slices < SLICES && (t.slices < SLICES_LEAST || goes_on_alike(s, begin->before, begin->area));
    if (t.slices == 0 || (t.even ? short_one : t.slices < SLICES_SLANTING)) return;
    const real off = t.filled / t.area - 1;
    if (!(fabs(off) > (t.even ? OFF_LEAST : OFF_SLANTING)) ||
        !width_misfit_list_error_is_large_enough_to_add(list, off))
        return;
    const struct narrow_part u = uneven_of(s, t.middle, off);
    if (!(u.width > 0)) return;
    const bool known = s->named[s->section[t.middle].cell] & 1 << u.axis;
    if (!known) part_mark(s, t.middle, u.axis);
    width_misfit_list_add_narrow_part(list, &u, known);
}

/* Examines the sections of the piece list->piece across each axis and adds to the list the narrow parts whose particles
 * have a wrong area. c: lattice cells of the piece; named[cells]: bit d is set for cells of a listed part whose width
 * along axis d is wrong. */
static void piece_sections(struct width_misfit_list *list, const struct cell_coverage *c, uint8_t *named)
{
    for (int axis = 0; axis < c->dim; axis++) {
        struct sections s;
        sections_make(&s, c, axis, named);
        for (int32_t k = 0; k < s.n; k++) part_judge(&s, k, list);
        sections_free(&s);
    }
}

/* Appends to `list` the narrow parts of list->piece that have a wrong number of particle rows. The piece is a body of
 * the run, or all its parts of one material. Appends nothing if the bounding box of the body has too many cells
 * (cell_coverage_compute_for_body_piece). */
static void piece_judge(struct width_misfit_list *list, const struct run *run)
{
    struct cell_coverage c;
    if (run->scene->dim == 1) width_misfit_list_add_parts_of_1d_body(list);
    if (run->scene->dim == 1 || !cell_coverage_compute_for_body_piece(&c, &list->piece)) return;
    uint8_t *named = NEW("check.named", c.cells, uint8_t);
    piece_sections(list, &c, named);
    width_misfit_list_add_necks_of_piece(list, run, &c, named);
    memory_free(named);
    cell_coverage_free(&c);
}

void print_advice_on_widths_of_narrow_parts(const struct run *run, FILE *out)
{
    const struct scene *s = run->scene;
    for (int b = 0; b < s->bodies; b++) {
        struct width_misfit_list list = {.piece = {.scene = s, .body = b, .material = ANY_MATERIAL}};
        if (s->body[b].file) continue;
        piece_judge(&list, run);
        for (int m = 0; m < s->materials && s->body[b].parts > 0; m++) {
            list.piece.material = m;
            if (scene_body_can_have_material(&s->body[b], m)) piece_judge(&list, run);
        }
        print_parts_whose_width_misfits_spacing(&list, out);
    }
}
