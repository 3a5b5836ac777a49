/* Narrow parts whose width is no multiple of the spacing have a row of particles too many or too few, also where the
 * volume of the whole body is right. Sections of the shape across each axis are compared with the particles in them,
 * part by part; steps of slanting and curved faces even out along a part. */
#include <math.h>
#include <stdio.h>

#include "base/memory.h"
#include "check_cover.h"
#include "check_parts.h"

#define OFF_LEAST 0.02    /* of the area of sections, */
#define OFF_SLANTING 0.05 /* where their faces slant or are curved, which steps follow no better */
#define ALIKE 0.2         /* sections of a part differ by less in area, */
#define EVEN 0.04         /* and by less than this where faces lie along the axis */
#define COVERED 0.02      /* share of a cell that counts */
enum {
    SLICES = 8,
    SLICES_LEAST = 3,
    SLICES_SLANTING = 32,
    SAID = 3
}; /* of a part that are taken together; parts of a body that are named */

/* What hangs together in a slice of cells across an axis. */
struct section {
    int64_t slice, cell, n; /* one of its cells, how many */
    real area, filled;      /* of the shape, of particles [cells] */
    int32_t before, after;  /* the largest section that it touches in the slices beside it; -1: none */
};

struct sections {
    const struct cover *cover;
    int axis, across[2];
    int64_t stride, side[2]; /* from a cell to the next slice; to neighbours in the slice */
    int32_t n, room;
    struct section *section;
    int32_t *of; /* [cells] section of a cell, -1: none */
};

/* A part that is off. */
struct uneven {
    real off, width, filled; /* share of its sections; along `axis`: width, and that of its particles [m] */
    real at[DIM_MAX];
    int axis, across; /* of the width; of the section */
    bool measured;    /* the width is that through the place */
};

static bool is_covered(const struct cover *c, int64_t cell) { return c->filled[cell] || c->share[cell] > COVERED; }

static int32_t section_new(struct sections *s, int64_t slice, int64_t cell)
{
    if (s->n == s->room) {
        const int32_t room = s->room > 0 ? 2 * s->room : 256;
        s->section = memory_resize("check.sections", s->section, s->room, room, sizeof *s->section);
        s->room = room;
    }
    s->section[s->n] = (struct section){.slice = slice, .cell = cell, .before = -1, .after = -1};
    return s->n++;
}

/* Marks all cells of a slice that hang together with one of them. stack: room for a slice. */
static void section_flood(struct sections *s, int64_t slice, int64_t first, int64_t *stack)
{
    const struct cover *c = s->cover;
    const int32_t number = section_new(s, slice, first);
    struct section *section = &s->section[number];
    int64_t top = 0;
    stack[top++] = first, s->of[first] = number;
    while (top > 0) {
        const int64_t cell = stack[--top];
        int64_t at[DIM_MAX];
        section->n++, section->area += c->share[cell], section->filled += c->filled[cell];
        cover_place(c, cell, at);
        for (int k = 0; k < 4; k++) {
            const int d = s->across[k / 2], way = k % 2 ? 1 : -1;
            const int64_t next = cell + way * s->side[k / 2];
            if (at[d] + way < 0 || at[d] + way >= c->n[d]) continue;
            if (s->of[next] >= 0 || !is_covered(c, next)) continue;
            s->of[next] = number, stack[top++] = next;
        }
    }
}

/* The larger of two sections; -1: none. */
static int32_t larger(const struct sections *s, int32_t a, int32_t b)
{
    return a < 0 ? b : b < 0 || s->section[a].area >= s->section[b].area ? a : b;
}

static void sections_make(struct sections *s, const struct cover *c, int axis)
{
    const int64_t stride[DIM_MAX] = {1, c->n[0], c->n[0] * c->n[1]};
    *s = (struct sections){.cover = c, .axis = axis, .stride = stride[axis]};
    s->across[0] = (axis + 1) % DIM_MAX, s->across[1] = (axis + 2) % DIM_MAX;
    for (int k = 0; k < 2; k++) s->side[k] = stride[s->across[k]];
    s->of = NEW("check.sections", c->cells, int32_t);
    for (int64_t k = 0; k < c->cells; k++) s->of[k] = -1;
    int64_t *stack = NEW("check.stack", c->cells / c->n[axis], int64_t);
    for (int64_t k = 0; k < c->cells; k++) {
        int64_t at[DIM_MAX];
        if (s->of[k] >= 0 || !is_covered(c, k)) continue;
        cover_place(c, k, at);
        section_flood(s, at[axis], k, stack);
    }
    memory_free(stack);
    for (int64_t k = 0; k + s->stride < c->cells; k++) {
        const int64_t next = k + s->stride;
        int64_t at[DIM_MAX];
        cover_place(c, k, at);
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

/* Is a section one of a part that goes on on both sides, of nearly the same area as another? */
static bool goes_on_alike(const struct sections *s, int32_t k, real area)
{
    return k >= 0 && s->section[k].before >= 0 && s->section[k].after >= 0 &&
           fabs(s->section[k].area - area) <= ALIKE * area;
}

/* Width of a section along one of the axes across: its cells, by area or filled, over the lines along the axis that
 * they lie in [cells]. */
static real width_along(const struct sections *s, int32_t number, int k, bool filled)
{
    const struct cover *c = s->cover;
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

/* Widths and place of a section, of the axis along which they differ most. */
static struct uneven uneven_of(const struct sections *s, int32_t number, real off)
{
    const struct cover *c = s->cover;
    struct uneven u = {.off = off, .across = s->axis};
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
            cover_place(c, cell, at);
            sum += c->share[cell];
            for (int d = 0; d < c->dim; d++) u.at[d] += c->share[cell] * (c->first[d] + (real)at[d] * c->spacing);
        }
    for (int d = 0; d < c->dim; d++) u.at[d] /= sum;
    return u;
}

/* Keeps the worst parts; of those that are as wide the worst. */
static int uneven_keep(struct uneven *kept, int n, const struct uneven *u)
{
    int place = n;
    for (int k = 0; k < n; k++)
        if (fabs(kept[k].width - u->width) < 0.05 * u->width) {
            if (fabs(kept[k].off) >= fabs(u->off)) return n;
            place = k;
        }
    if (place == n && n < SAID) n++;
    if (place == SAID) place = SAID - 1;
    if (place < n - 1 || fabs(kept[place].off) < fabs(u->off)) kept[place] = *u;
    for (int k = place; k > 0 && fabs(kept[k].off) > fabs(kept[k - 1].off); k--) {
        const struct uneven other = kept[k];
        kept[k] = kept[k - 1], kept[k - 1] = other;
    }
    return n;
}

/* Adds up sections of a part from one on, at most `most`. */
struct stretch {
    int slices;
    int32_t middle;
    real area, filled;
    bool even; /* all hold as many particles: their faces lie along the axis */
};

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

/* Looks along a part from one of its sections on: SLICES of them, or all if there are fewer. Where they are uneven, as
 * faces slant, four times as many, over which steps even out. */
static int part_judge(const struct sections *s, int32_t first, struct uneven *kept, int n)
{
    const struct section *begin = &s->section[first];
    struct stretch t = stretch_from(s, first, SLICES);
    if (!t.even) t = stretch_from(s, first, SLICES_SLANTING);
    const bool short_one =
        t.slices < SLICES && (t.slices < SLICES_LEAST || goes_on_alike(s, begin->before, begin->area));
    if (t.slices == 0 || (t.even ? short_one : t.slices < SLICES_SLANTING)) return n;
    const real off = t.filled / t.area - 1;
    if (!(fabs(off) > (t.even ? OFF_LEAST : OFF_SLANTING)) || (n == SAID && fabs(off) <= fabs(kept[SAID - 1].off)))
        return n;
    const struct uneven u = uneven_of(s, t.middle, off);
    return u.width > 0 ? uneven_keep(kept, n, &u) : n;
}

/* Distance from X to where the shape ends along an axis, by halving [m]. */
static real end_along(const struct region *shape, int dim, const real *X, int axis, real step)
{
    enum { STEPS_MOST = 4000, HALVINGS = 30 };
    real Y[DIM_MAX], inside = 0;
    for (int d = 0; d < DIM_MAX; d++) Y[d] = X[d];
    for (int k = 1; k < STEPS_MOST; k++, inside += step) {
        Y[axis] = X[axis] + k * step;
        if (!region_contains(shape, Y, dim, 0)) break;
    }
    real outside = inside + step;
    for (int k = 0; k < HALVINGS; k++) {
        const real middle = 0.5 * (inside + outside);
        Y[axis] = X[axis] + middle;
        if (region_contains(shape, Y, dim, 0))
            inside = middle;
        else
            outside = middle;
    }
    return fabs(inside);
}

/* Replaces the width of a part, which is known to a few percent, by the one through its place, if that is much alike
 * and is what makes the sections uneven.
 */
static void width_measure(struct uneven *u, const struct region *shape, int dim, real spacing)
{
    if (!region_contains(shape, u->at, dim, 0)) return;
    const real width =
        end_along(shape, dim, u->at, u->axis, 0.05 * spacing) + end_along(shape, dim, u->at, u->axis, -0.05 * spacing);
    u->measured = fabs(width - u->width) < 0.1 * u->width && fabs(u->filled - width) > 0.5 * fabs(u->off) * width;
    if (u->measured) u->width = width;
}

/* The next larger and smaller spacing that divide a width, cut to six digits. */
static void say_spacings(real width, real spacing, FILE *out)
{
    const real more = ceil(width / spacing * (1 - 1e-3)), fewer = more - 1;
    fprintf(out, "%.6g m", width / more * (1 - 5e-7));
    if (fewer >= 1) fprintf(out, " or %.6g m", width / fewer * (1 - 5e-7));
}

static void say_place(const real *at, int dim, FILE *out)
{
    for (int d = 0; d < dim; d++) fprintf(out, "%s%.4g", d ? ", " : "(", at[d]);
    fprintf(out, ") m");
}

/* Parts whose width is known; where there is none of these, the worst section. */
static void say_uneven(const struct scene *s, int body, struct uneven *kept, int n, FILE *out)
{
    int measured = 0;
    for (int k = 0; k < n; k++) {
        struct uneven *u = &kept[k];
        width_measure(u, &s->body[body].shape, s->dim, s->spacing);
        if (!u->measured) continue;
        fprintf(out, "unresolved: body %s: a part %.4g m wide along %c, at ", s->body[body].name, u->width,
                "xyz"[u->axis]);
        say_place(u->at, s->dim, out);
        fprintf(out, ", is %.4g m of particles: its sections are %.1f %% too %s; particles.spacing ", u->filled,
                100 * fabs(u->off), u->off > 0 ? "large" : "small");
        say_spacings(u->width, s->spacing, out);
        fprintf(out, " divides it\n");
        measured++;
    }
    if (measured > 0 || n == 0) return;
    fprintf(out, "unresolved: body %s: its section across %c at ", s->body[body].name, "xyz"[kept[0].across]);
    say_place(kept[0].at, s->dim, out);
    fprintf(out, " is %.1f %% too %s, as steps of particles fill it; a smaller particles.spacing is closer\n",
            100 * fabs(kept[0].off), kept[0].off > 0 ? "large" : "small");
}

void advise_sections(const struct engine *e, FILE *out)
{
    const struct scene *s = e->scene;
    for (int b = 0; b < s->bodies; b++) {
        struct uneven kept[SAID] = {{0}};
        struct cover c;
        int n = 0;
        if (!cover_make(&c, s, b)) continue;
        for (int axis = 0; axis < c.dim; axis++) {
            struct sections sections;
            sections_make(&sections, &c, axis);
            for (int32_t k = 0; k < sections.n; k++) n = part_judge(&sections, k, kept, n);
            sections_free(&sections);
        }
        cover_free(&c);
        say_uneven(s, b, kept, n, out);
    }
}
