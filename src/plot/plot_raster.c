/* Particles of a frame as a flat cloud, and the cloud as pixels.
 *
 * A picture made of point symbols has gaps or overlaps at every size but one. Here each pixel takes the colour of the
 * nearest particle, so that a body is a closed surface and a crack an open line. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "plot/plot.h"

/* Number of sampled particles, and of comparisons of distances, for the estimate of the spacing. */
enum { SAMPLES = 200, SAMPLES_MIN = 9 };
static const double COMPARISONS = 2e7;

/* A square a little larger than the spacing closes the seams of a strained lattice; a disc that reaches the
 * diagonal and more closes those of a turned or irregular one. */
static const double SQUARE = 0.55, DISC = 0.9;       /* half width, radius over spacing */

static int64_t sample_count(int64_t n)
{
    int64_t samples = (int64_t)(COMPARISONS / (double)(n + 1));
    samples = samples > SAMPLES ? SAMPLES : samples < SAMPLES_MIN ? SAMPLES_MIN : samples;
    return samples < n ? samples : n;
}

/* Mean distance of the `dim` nearest particles of i: a corner of a lattice has that many at one spacing. */
static double near_distance(const struct frame *f, int64_t i)
{
    double nearest[DIM_MAX];
    for (int k = 0; k < f->dim; k++) nearest[k] = INFINITY;
    for (int64_t j = 0; j < f->n; j++) {
        double r2 = j == i ? INFINITY : 0;
        for (int d = 0; d < f->dim; d++) r2 += square((double)f->X[d][j] - f->X[d][i]);
        for (int k = 0; k < f->dim; k++) {           /* insert, keeping ascending order */
            if (r2 >= nearest[k]) continue;
            double passed = nearest[k];
            nearest[k] = r2;
            r2 = passed;
        }
    }
    double sum = 0;
    for (int k = 0; k < f->dim; k++) sum += sqrt(nearest[k]);
    return sum / f->dim;
}

static double least_spacing(const struct frame *f)
{
    double least = INFINITY;
    for (int64_t i = 0; i < f->n; i++) least = fmin(least, f->spacing[i]);
    return least;
}

double frame_spacing(const struct frame *f)
{
    double distance[SAMPLES];
    int64_t samples = sample_count(f->n), known = 0;
    if (f->spacing && f->n > 0) return least_spacing(f);
    for (int64_t k = 0; k < samples; k++) {
        double r = near_distance(f, k * f->n / samples);
        if (isfinite(r)) distance[known++] = r;
    }
    if (known == 0) return 0;
    return median_of(distance, known);
}

/* True if the nearest neighbour in the map lies within 8 degrees of an axis. */
static bool lies_along(const struct cloud *c, int64_t i)
{
    double best = INFINITY, along = 0, across = 1;
    for (int64_t j = 0; j < c->n; j++) {
        double a = fabs((double)c->place[0][j] - c->place[0][i]), b = fabs((double)c->place[1][j] - c->place[1][i]);
        if (j == i || a * a + b * b >= best) continue;
        best = a * a + b * b;
        along = fmax(a, b);
        across = fmin(a, b);
    }
    return across < 0.14 * along;                    /* tan 8 degrees */
}

static bool is_aligned(const struct cloud *c)
{
    int64_t samples = sample_count(c->n), along = 0;
    for (int64_t k = 0; k < samples; k++) along += lies_along(c, k * c->n / samples);
    return 10 * along >= 9 * samples;
}

/* Thinnest direction of a solid, the last of equals; and the coordinate there that is nearest to the middle. */
static void choose_layer(struct cloud *c, const struct frame *f)
{
    double thinnest = INFINITY, middle = 0;
    for (int d = 0; d < 3; d++) {
        double from = INFINITY, to = -INFINITY;
        for (int64_t i = 0; i < f->n; i++) {
            from = fmin(from, f->X[d][i]);
            to = fmax(to, f->X[d][i]);
        }
        if (to - from > thinnest * (1 + 1e-5)) continue;         /* single precision: equal is not exact */
        thinnest = to - from;
        middle = 0.5 * (from + to);
        c->normal = d;
    }
    double best = INFINITY;
    for (int64_t i = 0; i < f->n; i++) {
        double off = fabs(f->X[c->normal][i] - middle);
        if (off >= best) continue;
        best = off;
        c->layer = f->X[c->normal][i];
    }
    c->axis[0] = c->normal == 0 ? 1 : 0;
    c->axis[1] = c->normal == 2 ? 1 : 2;
}

void cloud_make(struct cloud *c, const struct frame *f)
{
    *c = (struct cloud){.axis = {0, 1}, .normal = -1, .t = f->t, .spacing = frame_spacing(f)};
    if (f->dim == 3) choose_layer(c, f);
    for (int k = 0; k < 2; k++) c->place[k] = NEW("plot.place", f->n, float);
    c->damage = NEW("plot.damage", f->n, float);
    c->kind = NEW("plot.kind", f->n, uint8_t);
    if (f->fragment) c->fragment = NEW("plot.fragment", f->n, int32_t);
    if (f->spacing) c->size = NEW("plot.size", f->n, float);
    for (int64_t i = 0; i < f->n; i++) {
        const double size = f->spacing ? f->spacing[i] : c->spacing;
        if (c->normal >= 0 && fabs(f->X[c->normal][i] - c->layer) > 0.5 * size - 0.01 * c->spacing) continue;
        if (f->spacing) c->size[c->n] = (float)size;
        for (int k = 0; k < 2; k++) c->place[k][c->n] = f->X[c->axis[k]][i] + f->u[c->axis[k]][i];
        c->damage[c->n] = f->damage[i];
        if (f->fragment) c->fragment[c->n] = f->fragment[i];
        if (f->fragment && f->fragment[i] >= c->fragments) c->fragments = f->fragment[i] + 1;
        c->kind[c->n++] = f->kind[i];
    }
    c->aligned = is_aligned(c);
}

void cloud_free(struct cloud *c)
{
    for (int k = 0; k < 2; k++) memory_free(c->place[k]);
    memory_free(c->damage);
    memory_free(c->kind);
    memory_free(c->fragment);
    memory_free(c->size);
    *c = (struct cloud){0};
}

/* ---- colours ----------------------------------------------------------------------------------------------------- */

struct stop { double at, red, green, blue; };

/* Light grey through ochre to dark red, and light to dark blue: both darken evenly, so that they remain readable in
 * grey print and for any colour vision. */
static const struct stop damage_stops[] = {
    {0.00, 226, 228, 231}, {0.12, 246, 220, 190}, {0.35, 240, 160, 110},
    {0.60, 214, 80, 62},   {0.80, 158, 24, 42},   {1.00, 84, 2, 24},
};
static const struct stop kind_stops[] = {
    {0.00, 158, 202, 233}, {0.40, 74, 144, 204}, {0.75, 22, 84, 158}, {1.00, 6, 34, 86},
};

static struct colour along_stops(const struct stop *stop, int stops, double at)
{
    int k = 0;
    at = isfinite(at) ? fmin(fmax(at, 0), 1) : 1;
    while (k + 2 < stops && at > stop[k + 1].at) k++;
    const struct stop *a = &stop[k], *b = &stop[k + 1];
    double share = (at - a->at) / (b->at - a->at);
    return (struct colour){(uint8_t)lround(a->red + share * (b->red - a->red)),
                           (uint8_t)lround(a->green + share * (b->green - a->green)),
                           (uint8_t)lround(a->blue + share * (b->blue - a->blue)), 255};
}

struct colour map_colour(enum map map, enum kind kind, double damage, double top)
{
    if (map == MAP_DAMAGE) return along_stops(damage_stops, COUNT_OF(damage_stops), damage / top);
    if (kind == KIND_MPM) return (struct colour){236, 233, 226, 255};
    return along_stops(kind_stops, COUNT_OF(kind_stops), damage / top);
}

/* The heaviest fragment is light grey; nine colours in turn for the others, apart in lightness and hue for any colour
 * vision; what has no bond is nearly black. */
struct colour fragment_colour(int32_t fragment)
{
    static const struct colour turn[] = {{68, 119, 170, 255},  {238, 153, 51, 255},  {34, 136, 51, 255},
                                         {170, 51, 119, 255},  {102, 204, 238, 255}, {204, 68, 51, 255},
                                         {187, 187, 68, 255},  {119, 85, 170, 255},  {17, 119, 119, 255}};
    if (fragment < 0) return (struct colour){40, 40, 44, 255};
    if (fragment == 0) return (struct colour){212, 214, 217, 255};
    return turn[(size_t)(fragment - 1) % COUNT_OF(turn)];
}

/* ---- pixels ------------------------------------------------------------------------------------------------------ */

struct canvas {
    struct colour *pixel;
    float *rank;                         /* of the particle painted there; the smaller rank wins */
    int width, height;
    double per_metre[2];                 /* pixels */
};

/* Paints particle i on the pixels that it covers and where its rank is the smallest. */
static void paint_particle(struct canvas *v, const struct view *view, const struct cloud *c, int64_t i, enum map map)
{
    double at[2], reach[2];
    int from[2], to[2], size[2] = {v->width, v->height};
    const double wide = c->size ? c->size[i] - c->spacing : 0;       /* of a coarse cell's point beyond a particle */
    const double half = c->aligned ? SQUARE * c->spacing + 0.5 * wide : DISC * (c->spacing + wide);
    bool fine = c->spacing * v->per_metre[0] < 1.5;  /* several particles a pixel: show the most damaged */
    for (int k = 0; k < 2; k++) {
        at[k] = (c->place[k][i] - view->from[k]) * v->per_metre[k];
        reach[k] = fmax(half * v->per_metre[k], 0.5);
        if (!(at[k] > -reach[k] && at[k] < size[k] + reach[k])) return;      /* outside, or not a number */
        from[k] = (int)fmax(ceil(at[k] - reach[k] - 0.5), 0);
        to[k] = (int)fmin(floor(at[k] + reach[k] - 0.5), size[k] - 1);
    }
    const struct colour colour = map == MAP_FRAGMENT
                                     ? fragment_colour(c->fragment[i])
                                     : map_colour(map, (enum kind)c->kind[i], c->damage[i], view->top);
    for (int row = from[1]; row <= to[1]; row++) {
        for (int column = from[0]; column <= to[0]; column++) {
            double r2 = square(column + 0.5 - at[0]) + square(row + 0.5 - at[1]);
            if (!c->aligned && r2 > square(reach[0]) && !fine) continue;
            float rank = fine ? (float)-(c->damage[i] + c->kind[i]) : (float)r2;
            int64_t q = (int64_t)row * v->width + column;
            if (rank >= v->rank[q]) continue;
            v->rank[q] = rank;
            v->pixel[q] = colour;
        }
    }
}

void raster_paint(struct colour *pixel, int width, int height, const struct view *view, const struct cloud *c,
                  enum map map)
{
    int64_t pixels = (int64_t)width * height;
    struct canvas v = {.pixel = pixel, .rank = NEW("plot.rank", pixels, float), .width = width, .height = height};
    v.per_metre[0] = width / (view->to[0] - view->from[0]);
    v.per_metre[1] = height / (view->to[1] - view->from[1]);
    for (int64_t q = 0; q < pixels; q++) {
        v.rank[q] = INFINITY;
        pixel[q] = (struct colour){255, 255, 255, 0};
    }
    for (int64_t i = 0; i < c->n; i++) paint_particle(&v, view, c, i, map);
    memory_free(v.rank);
}
