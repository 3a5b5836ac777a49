/* Draws pre-cracks of plane bodies over a map, since a pre-crack that is a slit of the mesh causes no damage. Each of
 * the two faces of a pre-crack is drawn as a line that moves with the particles beside it. A gap between the faces that
 * is too narrow to be visible is filled, so that both lines appear as one. */
#include <math.h>

#include "base/memory.h"
#include "plot/plot.h"

/* Colours of the faces. FACE: in maps of damage; GAP: in maps of fields, the white of a gap. */
static const struct colour FACE = {122, 16, 32, 255}, GAP = {255, 255, 255, 255};
/* LINE_HALF: half width of a line, at least LINE_LEAST pixels; GAP_SEEN: distance of the faces from which the gap
 * between them is not filled. Both are fractions of the width of the image, so that pictures of any resolution look
 * alike; for images more than FLAT times as wide as high, of FLAT times the height. */
static const double LINE_HALF = 1.0 / 600, LINE_LEAST = 0.7, GAP_SEEN = 1.0 / 400, FLAT = 12;

/* BESIDE: largest distance from a face of the particles with which the face moves [spacings]. RUBBLE: damage above
 * which a particle does not contribute to the motion of a face [1]. */
static const double BESIDE = 1.05, RUBBLE = 0.65;

/* Constants of faces_trim. OBLIQUE: least product of the direction cosines of a pre-crack that is not along the lattice
 * [1]. TRIMMED: largest distance from a face up to which pixels are changed to make the face straight [spacings].
 * BEYOND: distance by which pixels are made blank also on the body's side of a face [pixel]. */
static const double OBLIQUE = 0.02, TRIMMED = 0.9, BEYOND = 1.5;

/* Displacements of both faces (sides 0 and 1) of one straight pre-crack, each divided into sections along the
 * pre-crack. Sums over the particles beside a section, weighted by nearness: u[side][2 section + axis], displacements
 * [m]; weight[side][section], weights; place[side][section], coordinates along the pre-crack [m]. Made by faces_make;
 * the caller frees the arrays. */
struct faces {
    double from[2], along[2], length, section;
    double begin, end; /* part of the length along which there are particles [m] */
    bool in_mirror;    /* in a plane of symmetry: the body has one of the faces */
    int sections;
    double *u[2], *weight[2], *place[2];
};

/* Returns the coordinate of the point X[2] [m] along the straight pre-crack f, from its first end [m]. Stores the
 * distance of X from the line of the pre-crack in *off [m], positive on the left. */
static double place_along(const struct faces *f, const double *X, double *off)
{
    const double x = X[0] - f->from[0], y = X[1] - f->from[1];
    *off = f->along[0] * y - f->along[1] * x;
    return f->along[0] * x + f->along[1] * y;
}

/* Returns true if particle i of `plotted`, with the coordinate s along the pre-crack and the distance `off` from it
 * [m], is beside the pre-crack f: at most BESIDE spacings from it, and not more than half a section beyond its ends. */
static bool is_beside(const struct faces *f, const struct plotted_particles *plotted, int64_t i, double s, double off)
{
    const double reach = BESIDE * (plotted->size ? plotted->size[i] : plotted->spacing);
    return fabs(off) <= reach && s >= -0.5 * f->section && s <= f->length + 0.5 * f->section;
}

/* Moves the drawn line of the pre-crack f sideways to the middle of the gap between the particles of `plotted` on its
 * two sides, which is where the crack opens. A pre-crack along the lattice may be anywhere between two rows of
 * particles; one across the lattice hardly moves. */
static void faces_move_between_particles(struct faces *f, const struct plotted_particles *plotted)
{
    double edge[2] = {INFINITY, INFINITY}; /* distance of the nearest edge on each side [m] */
    for (int64_t i = 0; i < plotted->n; i++) {
        double off;
        const double s = place_along(f, (double[]){plotted->reference[0][i], plotted->reference[1][i]}, &off);
        const double half = 0.5 * (plotted->size ? plotted->size[i] : plotted->spacing);
        if (is_beside(f, plotted, i, s, off)) edge[off < 0] = fmin(edge[off < 0], fabs(off) - half);
    }
    if (!isfinite(edge[0] + edge[1])) return;
    f->from[0] -= 0.5 * (edge[0] - edge[1]) * f->along[1];
    f->from[1] += 0.5 * (edge[0] - edge[1]) * f->along[0];
}

/* Adds the displacement of particle i of `plotted` to that of the adjacent face of the pre-crack f. Does nothing if the
 * particle is farther from the pre-crack than BESIDE spacings or its damage exceeds RUBBLE. Each face is divided into
 * sections along the pre-crack. The displacement is extrapolated from the particle to the nearest point of the face by
 * the deformation gradient, and is added, weighted by nearness, to the sum of the section there. */
static void face_add_motion(struct faces *f, const struct plotted_particles *plotted, int64_t i)
{
    const double X[2] = {plotted->reference[0][i], plotted->reference[1][i]},
                 *axis[2] = {plotted->camera.right, plotted->camera.up};
    double off, u[2];
    const double s = place_along(f, X, &off);
    const double reach = BESIDE * (plotted->size ? plotted->size[i] : plotted->spacing);
    if (!is_beside(f, plotted, i, s, off) || plotted->damage[i] > RUBBLE) return;
    const double xi[2] = {off * f->along[1], -off * f->along[0]}; /* from the particle to the face */
    for (int a = 0; a < 2; a++) {
        u[a] = plotted->position[a][i] - X[a];
        for (int b = 0; b < 2 && plotted->gradient; b++) {
            double F = 0;
            for (int m = 0; m < 9; m++) F += axis[a][m / 3] * (double)plotted->gradient[9 * i + m] * axis[b][m % 3];
            u[a] += (F - (a == b)) * xi[b];
        }
    }
    const int side = off < 0, at = (int)fmin(fmax(s / f->section, 0), f->sections - 1);
    const double near = 1 / (0.1 + fabs(off) / reach);
    for (int a = 0; a < 2; a++) f->u[side][2 * at + a] += near * u[a];
    f->weight[side][at] += near;
    f->place[side][at] += near * s;
    f->begin = fmin(f->begin, fmax(s - 0.5 * reach / BESIDE, 0)),
    f->end = fmax(f->end, fmin(s + 0.5 * reach / BESIDE, f->length));
}

/* Returns the second section for the linear interpolation of the displacement of a face of pre-crack f at the
 * coordinate s [m] along it; the first one is section `own`, which contains s. It is the adjacent section on the side
 * of s, or, if no particle is beside that, on the other side; `own` if there is neither. side: face, 0 or 1. */
static int other_section(const struct faces *f, int side, int own, double s)
{
    const int step = s < f->place[side][own] / f->weight[side][own] ? -1 : 1;
    for (int k = -1; k <= 1; k += 2) {
        const int next = own - k * step;
        if (next >= 0 && next < f->sections && f->weight[side][next] > 0) return next;
    }
    return own;
}

/* Computes the drawn position x[2] [m] of the point with coordinate s [m] along pre-crack f on one of its faces: its
 * initial position plus the displacement of the face. The displacement is interpolated linearly between the mean
 * displacements of two sections of the face, and extrapolated beyond the last one. side: face, 0 or 1. Returns false if
 * no particle is beside the section at s. */
static bool face_at(const struct faces *f, int side, double s, double *x)
{
    const int own = (int)fmin(fmax(s / f->section, 0), f->sections - 1);
    const double *weight = f->weight[side];
    if (!(weight[own] > 0)) return false;
    const int other = other_section(f, side, own, s);
    const double from = f->place[side][own] / weight[own], to = f->place[side][other] / weight[other];
    const double part = other == own ? 0 : (s - from) / (to - from);
    for (int a = 0; a < 2; a++)
        x[a] = f->from[a] + s * f->along[a] + (1 - part) * f->u[side][2 * own + a] / weight[own] +
               part * f->u[side][2 * other + a] / weight[other];
    return true;
}

/* Completes the points x[2][2] [m] of both faces of pre-crack f if only one face has a point. If the pre-crack is in a
 * plane of symmetry, both points become that of the existing face, moved into the body by `inside` [m]; else neither
 * face has a point. is[side]: whether the face has a point, updated. */
static void faces_complete(const struct faces *f, double x[2][2], bool is[2], double inside)
{
    const int own = is[0] ? 0 : 1;
    if (is[0] == is[1]) return;
    is[0] = is[1] = f->in_mirror;
    for (int a = 0; a < 2; a++) {
        x[own][a] += inside * (own ? -1 : 1) * (a ? f->along[0] : -f->along[1]);
        x[!own][a] = x[own][a];
    }
}

/* Returns the length [pixel] of which LINE_HALF and GAP_SEEN are fractions, in an image of width x height [pixel]. */
static double line_scale(int width, int height) { return fmin(width, FLAT * height); }

/* Returns half the width [pixel] of a line in an image of width x height [pixel], at least LINE_LEAST. */
static double line_half(int width, int height) { return fmax(LINE_HALF * line_scale(width, height), LINE_LEAST); }

/* Paints the pixels of pixel[height][width] within half a line width of the line between the points a[2] and b[2]
 * [pixel] in the colour c. on_body: true to leave out the pixels without a particle. */
static void line_paint(struct colour *pixel, int width, int height, const double *a, const double *b, struct colour c,
                       bool on_body)
{
    const double half = line_half(width, height);
    int low[2], high[2];
    const int size[2] = {width, height};
    for (int k = 0; k < 2; k++) {
        const double from = fmin(a[k], b[k]) - half, to = fmax(a[k], b[k]) + half;
        if (!(to >= 0 && from <= size[k])) return; /* outside the picture, or NaN */
        low[k] = (int)fmax(floor(from), 0), high[k] = (int)fmin(floor(to), size[k] - 1);
    }
    for (int row = low[1]; row <= high[1]; row++)
        for (int column = low[0]; column <= high[0]; column++)
            if ((!on_body || pixel[(int64_t)row * width + column].alpha) &&
                segment_distance_from_point(a, b, (double[]){column + 0.5, row + 0.5}, 2) <= half)
                pixel[(int64_t)row * width + column] = c;
}

/* Computes the points x[2][2] of both faces of pre-crack f at the coordinate s along it [m], in pixels of an image of
 * width x height pixels that shows the rectangle of the view v. is[side]: receives whether the face has a point there.
 * inside: distance by which the points of a pre-crack in a plane of symmetry are moved into the body [m]. */
static void faces_find_pixels(const struct faces *f, const struct view *v, int width, int height, double s,
                              double inside, double x[2][2], bool is[2])
{
    for (int side = 0; side < 2; side++) is[side] = face_at(f, side, s, x[side]);
    faces_complete(f, x, is, inside);
    for (int side = 0; side < 2; side++)
        for (int a = 0; a < 2 && is[side]; a++)
            x[side][a] = (x[side][a] - v->from[a]) * (a ? height : width) / (v->to[a] - v->from[a]);
}

/* Returns the pixel of pixel[height][width] that contains the point x[2] [pixel], NULL if it is outside the image. */
static struct colour *pixel_at(struct colour *pixel, int width, int height, const double *x)
{
    if (!(x[0] >= 0 && x[1] >= 0 && x[0] < width && x[1] < height)) return NULL;
    return &pixel[(int64_t)x[1] * width + (int64_t)x[0]];
}

/* Fills the pixels without a particle from the point x[2] on in the direction n[2] (unit vector), up to the body, in
 * the colour of the pixel behind the last of them. Fills nothing if the body is not within `reach` [pixel]. */
static void fill_up_to_body(struct colour *pixel, int width, int height, const double *x, const double *n, double reach)
{
    double last = -1;
    for (double at = 0; at <= reach; at += 0.5) {
        const struct colour *p = pixel_at(pixel, width, height, (double[]){x[0] + at * n[0], x[1] + at * n[1]});
        if (p && !p->alpha) last = at;
    }
    const double behind = last + 1.5;
    const struct colour *body = pixel_at(pixel, width, height, (double[]){x[0] + behind * n[0], x[1] + behind * n[1]});
    if (last < 0 || !body || !body->alpha) return;
    const struct colour colour = *body;
    for (double at = 0; at <= last; at += 0.5) {
        struct colour *p = pixel_at(pixel, width, height, (double[]){x[0] + at * n[0], x[1] + at * n[1]});
        if (p && !p->alpha) *p = colour;
    }
}

/* Makes the drawn faces of the open pre-crack f straight if it is oblique to the lattice, where the squares of
 * particles would form steps. Makes pixels between the faces blank, and fills the pixels between each face and the
 * particles beside it. pixel[height][width]: image of the view v; per_metre: pixels per metre; spacing: spacing of the
 * particles [m]. */
static void faces_trim(struct colour *pixel, int width, int height, const struct view *v, const struct faces *f,
                       double per_metre, double spacing)
{
    const double reach = TRIMMED * spacing * per_metre, step = 0.25 / per_metre;
    const int steps = (int)fmin((f->end - f->begin) / step, 8.0 * (width + height));
    if (fabs(f->along[0] * f->along[1]) < OBLIQUE) return;
    for (int fill = 0; fill < 2; fill++)
        for (int k = 0; k <= steps; k++) {
            const double s = f->begin + (f->end - f->begin) * k / fmax(steps, 1);
            const double other = s + (s < 0.5 * f->length ? 1 : -1) * f->section; /* for the direction of a face */
            double x[2][2], y[2][2];
            bool is[2], was[2];
            faces_find_pixels(f, v, width, height, s, 0, x, is);
            faces_find_pixels(f, v, width, height, other, 0, y, was);
            for (int side = 0; side < 2 && is[0] && is[1] && was[0] && was[1]; side++) {
                const double sign = (other > s) == (side == 0) ? 1 : -1,
                             t[2] = {y[side][0] - x[side][0], y[side][1] - x[side][1]};
                const double n[2] = {-sign * t[1] / hypot(t[0], t[1]),
                                     sign * t[0] / hypot(t[0], t[1])}; /* into the body */
                const double open = (x[side][0] - x[!side][0]) * n[0] + (x[side][1] - x[!side][1]) * n[1];
                for (double at = -BEYOND; at < fmin(open, reach) && open > 1 && !fill; at += 0.5) {
                    struct colour *p =
                        pixel_at(pixel, width, height, (double[]){x[side][0] - at * n[0], x[side][1] - at * n[1]});
                    if (p) *p = (struct colour){255, 255, 255, 0};
                }
                if (fill && open > 1) fill_up_to_body(pixel, width, height, x[side], n, reach);
            }
        }
}

/* Paints both faces of the deformed pre-crack f as lines in `colour` into the image pixel[height][width], which shows
 * the rectangle of the view v. Fills the gap between the faces only where it is too narrow to be seen. The round ends
 * of the lines end where the faces do. */
static void faces_paint(struct colour *pixel, int width, int height, const struct view *v, const struct faces *f,
                        struct colour colour)
{
    const double per_metre = width / (v->to[0] - v->from[0]);
    const int steps = (int)fmin(ceil(f->length * per_metre), 2.0 * (width + height)) + 1;
    const double round = fmin(line_half(width, height) / per_metre, 0.5 * (f->end - f->begin));
    double last[2][2];
    bool was[2] = {false, false};
    for (int k = 0; k <= steps; k++) {
        const double s = f->begin + round + (f->end - f->begin - 2 * round) * k / steps;
        double x[2][2];
        bool is[2];
        faces_find_pixels(f, v, width, height, s, round, x, is);
        const bool shut =
            is[0] && is[1] && hypot(x[1][0] - x[0][0], x[1][1] - x[0][1]) < GAP_SEEN * line_scale(width, height);
        for (int side = 0; side < 2; side++) {
            if (is[side] && was[side]) line_paint(pixel, width, height, last[side], x[side], colour, !shut);
            last[side][0] = x[side][0], last[side][1] = x[side][1], was[side] = is[side];
        }
        if (shut) line_paint(pixel, width, height, x[0], x[1], colour, false);
    }
}

/* Initialises *f as the two faces of the straight pre-crack `crack`, without displacements. Each face is divided into
 * equal sections, at most `section` long [m]. Allocates the arrays of sums, which the caller frees. */
static void faces_make(struct faces *f, const struct crack *crack, double section)
{
    *f = (struct faces){.from = {crack->corner[0][0], crack->corner[0][1]}};
    for (int a = 0; a < 2; a++) f->along[a] = crack->corner[1][a] - crack->corner[0][a];
    f->length = hypot(f->along[0], f->along[1]);
    for (int a = 0; a < 2; a++) f->along[a] /= f->length;
    f->sections = (int)fmin(fmax(ceil(f->length / section - 1e-6), 1), 1e6);
    f->section = f->length / f->sections;
    f->begin = f->length, f->end = 0;
    for (int side = 0; side < 2; side++) {
        f->u[side] = NEW("plot.faces", 2 * (int64_t)f->sections, double);
        f->weight[side] = NEW("plot.faces", f->sections, double);
        f->place[side] = NEW("plot.faces", f->sections, double);
    }
}

/* Returns true if both ends of `crack` are within half a spacing of a plane of symmetry of c. */
static bool crack_is_in_mirror(const struct crack *crack, const struct plotted_particles *plotted)
{
    bool in = false;
    for (int m = 0; m < plotted->mirrors; m++) {
        const int axis = plotted->mirror[m].axis;
        in |= fabs(crack->corner[0][axis] - plotted->mirror[m].at) < 0.5 * plotted->spacing &&
              fabs(crack->corner[1][axis] - plotted->mirror[m].at) < 0.5 * plotted->spacing;
    }
    return in;
}

void image_paint_precrack_faces(struct colour *pixel, int width, int height, const struct view *v,
                                const struct plotted_particles *plotted, enum map map)
{
    if ((map != MAP_DAMAGE && map != MAP_FIELD) || !plotted->reference[0] || !(plotted->spacing > 0)) return;
    for (int k = 0; k < v->notches; k++) {
        struct faces f;
        if (v->notch[k].n != 2 || !(hypot(v->notch[k].corner[1][0] - v->notch[k].corner[0][0],
                                          v->notch[k].corner[1][1] - v->notch[k].corner[0][1]) > 0))
            continue;
        faces_make(&f, &v->notch[k], 2 * plotted->spacing);
        f.in_mirror = crack_is_in_mirror(&v->notch[k], plotted);
        faces_move_between_particles(&f, plotted);
        for (int64_t i = 0; i < plotted->n; i++) face_add_motion(&f, plotted, i);
        faces_trim(pixel, width, height, v, &f, width / (v->to[0] - v->from[0]), plotted->spacing);
        faces_paint(pixel, width, height, v, &f, map == MAP_DAMAGE ? FACE : GAP);
        for (int side = 0; side < 2; side++)
            memory_free(f.u[side]), memory_free(f.weight[side]), memory_free(f.place[side]);
    }
}
