/* Compares the particles of a `face` of a load or support with the surfaces normal to its axis. A face consists of
 * all particles that are visible along the axis, so that it includes slopes and curves. Normals of the shape are
 * used if the body has one, else the end heights of neighbouring columns of particles. */
#include <math.h>
#include <stdio.h>

#include "base/arrays.h"
#include "base/memory.h"
#include "check_parts.h"

#define ELSEWHERE 10.0    /* [degrees] largest angle between the normal of a surface and the axis of an aligned face */
#define SHARE_LEAST 0.05  /* least share of the area that is reported; a row at the edge of a slope is less */
#define PLACE_GAP 1.5     /* least distance between two places of a face [spacings] */
enum { AWAY = 4 };        /* [columns] over which heights are compared: finds steps of slopes of 14 degrees and more */
#define COLUMNS_MOST 16.0 /* largest number of columns in the bounding box over the particles of the face */

/* Heights of a face of a load or support, by columns: lines of particles along the axis of the face. The height of a
 * column is the coordinate of its outermost particle. The columns form a grid over the other axes. axes: number of
 * these other axes, axis[axes]; n[axes]: numbers of columns along them; low[axes]: lower corner of the grid
 * [spacings]. */
struct ends {
    int axes, axis[DIM_MAX - 1], n[DIM_MAX - 1];
    real low[DIM_MAX - 1];
    real *height; /* [n] height along the axis, outwards [spacings]; NAN: none */
};

/* Areas of one face of a load or support: of the whole face, and of the part whose normal is inclined to the axis of
 * the face. */
struct elsewhere {
    real area, other, angle; /* of the face; of this part [m^2]; angle times area [degree m^2] */
    real aligned, last;      /* coordinates of the aligned part along the axis: deepest and outermost end [m] */
};

static int64_t place_of(const struct ends *c, const real *X, real spacing)
{
    int64_t place = 0;
    for (int k = c->axes - 1; k >= 0; k--)
        place = place * c->n[k] + (int64_t)((X[c->axis[k]] - c->low[k]) / spacing + 0.5);
    return place;
}

/* Creates in c a table of the heights of a face: the particles p are sorted into columns (lines of particles) along the
 * axis b->face, and the height of a column is the coordinate of its particle that is exposed on the face [spacings,
 * positive outwards]. f->normal[i] > 0 for exposed particles; scene: spacing. Returns false, with nothing to release,
 * if the box around the exposed particles has more than about COLUMNS_MOST columns for each of them. Release c->height
 * otherwise. */
static bool ends_make(struct ends *c, const struct particles *p, const struct scene *scene, const struct boundary *b,
                      const struct exposed_face *f)
{
    const real spacing = scene->spacing;
    real all = 1, high[DIM_MAX - 1], faces = 0;
    *c = (struct ends){0};
    for (int d = 0; d < p->dim; d++)
        if (d != b->face) c->axis[c->axes++] = d;
    for (int k = 0; k < c->axes; k++) c->low[k] = INFINITY, high[k] = -INFINITY;
    for (int64_t i = 0; i < p->n; i++) {
        for (int k = 0; k < c->axes && f->normal[i] > 0; k++)
            c->low[k] = real_min(c->low[k], p->X[c->axis[k]][i]), high[k] = real_max(high[k], p->X[c->axis[k]][i]);
        faces += f->normal[i] > 0;
    }
    for (int k = 0; k < c->axes; k++) all *= (high[k] - c->low[k]) / spacing + 2;
    if (!(all <= COLUMNS_MOST * faces + 1000)) return false;
    int64_t places = 1;
    for (int k = 0; k < c->axes; k++) c->n[k] = (int)((high[k] - c->low[k]) / spacing + 0.5) + 1, places *= c->n[k];
    c->height = NEW("check.ends", places, real);
    for (int64_t k = 0; k < places; k++) c->height[k] = NAN;
    for (int64_t i = 0; i < p->n; i++) {
        real X[DIM_MAX];
        if (!(f->normal[i] > 0)) continue;
        particle_reference_position(p, i, X);
        c->height[place_of(c, X, spacing)] = b->side * X[b->face] / spacing;
    }
    return true;
}

/* Returns the absolute slope of a face at the column of particles with the index `place`, along the axis c->axis[k]:
 * the difference between the height of this column and that of the column AWAY columns further, divided by AWAY. It is
 * computed on both sides, and the smaller slope is returned, so that a single step of the face does not count as a
 * slope. */
static real slope_along(const struct ends *c, int64_t place, int k)
{
    int64_t stride = 1;
    for (int m = 0; m < k; m++) stride *= c->n[m];
    const int at = (int)(place / stride % c->n[k]);
    const real here = c->height[place];
    const real after = at + AWAY < c->n[k] ? fabs(c->height[place + AWAY * stride] - here) / AWAY : NAN;
    const real before = at >= AWAY ? fabs(c->height[place - AWAY * stride] - here) / AWAY : NAN;
    return isnan(after) ? isnan(before) ? 0 : before : isnan(before) || after < before ? after : before;
}

/* Returns the cosine of the angle between the outward axis of the face of boundary b and the surface normal at particle
 * i of part [1]. c: heights of the face by columns of particles; the normal follows from their slopes, or from the
 * shape of the body in `scene` if c->height is NULL. */
static real cosine_at(const struct scene *scene, const struct particles *part, const struct boundary *b,
                      const struct ends *c, int64_t i)
{
    const struct region *shape = &scene->body[part->body[i]].shape;
    real X[DIM_MAX], normal[DIM_MAX] = {0}, slope2 = 0;
    particle_reference_position(part, i, X);
    if (!c->height) {
        X[b->face] += 0.5 * b->side * scene->spacing;
        region_signed_distance(shape, X, part->dim, normal);
        return b->side * normal[b->face];
    }
    for (int k = 0; k < c->axes; k++) slope2 += square(slope_along(c, place_of(c, X, scene->spacing), k));
    return 1 / sqrt(1 + slope2);
}

/* Returns the area of the face f, and the area of that part of it which is inclined: there the surface normal deviates
 * from the axis of the face by more than ELSEWHERE degrees. Only particles whose inner side has a coordinate of at
 * least `from` along this axis count [m, positive outwards]; with -INFINITY all particles count. b: boundary of the
 * face; c: heights of its columns of particles, from which the normals are computed, or from the shapes in `scene` if
 * c->height is NULL. */
static struct elsewhere elsewhere_from(const struct particles *part, const struct scene *scene,
                                       const struct boundary *b, const struct exposed_face *f, const struct ends *c,
                                       real from)
{
    struct elsewhere w = {.aligned = INFINITY, .last = -INFINITY};
    for (int64_t i = 0; i < part->n; i++) {
        const real area = f->normal[i], end = b->side * part->X[b->face][i] - 0.5 * scene->spacing;
        if (!(area > 0) || end < from - 1e-3 * scene->spacing) continue;
        const real angle = acos(real_max(-1, real_min(1, cosine_at(scene, part, b, c, i)))) * 180 / M_PI;
        w.area += area;
        if (angle > ELSEWHERE)
            w.other += area, w.angle += angle * area;
        else
            w.aligned = real_min(w.aligned, end), w.last = real_max(w.last, end);
    }
    return w;
}

/* Returns a coordinate along the axis of the face f of boundary b [m, positive outwards] for a message that advises the
 * user to restrict the load: a region that begins at this coordinate contains an inclined part of at most the share
 * SHARE_LEAST of its area. Returns INFINITY if no such coordinate is found. c: heights of the columns of particles of
 * the face; all: area of the whole face and of its inclined part; part, scene: particles and scene. */
static real elsewhere_cut(const struct particles *part, const struct scene *scene, const struct boundary *b,
                          const struct exposed_face *f, const struct ends *c, const struct elsewhere *all)
{
    for (int k = 0; k < 2 && isfinite(all->aligned); k++) {
        const real from = k == 0 ? all->aligned : all->last;
        const struct elsewhere w = elsewhere_from(part, scene, b, f, c, from);
        if (!(w.other > SHARE_LEAST * w.area)) return from;
    }
    return INFINITY;
}

/* Returns true if all bodies of scene s (the input file) to which boundary b applies have a shape with known normals:
 * one that is not infinite, not from a particle list or a voxel image, and not shared with joined bodies. */
static bool has_normals(const struct scene *s, const struct boundary *b)
{
    bool all = true;
    for (int k = 0; k < s->bodies; k++) {
        const struct region *shape = &s->body[k].shape;
        if (b->body >= 0 && s->body[k].joined != b->body) continue;
        all &= !s->body[k].file && s->body[k].joined == k && shape->n > 0 &&
               !region_has_box_with_infinite_side(shape, s->dim);
        for (int j = 0; j < shape->n; j++)
            all &= shape->solid[j].kind != SOLID_VOXELS && shape->solid[j].kind != SOLID_ALL;
        for (int j = 0; j < s->bodies; j++) all &= j == k || s->body[j].joined != k;
    }
    return all;
}

/* One exposed particle of a face, or a set of such particles: coordinate along the axis of the face [m, positive
 * outwards] and area [m^2]. `at` must be the first member, for sorting by compare_doubles. */
struct part_of_face {
    double at, area;
};

/* Prints the coordinates of the planes of the face f of boundary b, if its particles are in several planes normal to
 * the axis of the face that are more than PLACE_GAP spacings apart, as on both steps of an L. Also prints a region that
 * selects only the outermost plane. Planes with less than SHARE_LEAST of the area are left out. p: particles; spacing:
 * their spacing [m]. */
static void print_places_of_face(const struct particles *p, real spacing, const struct boundary *b,
                                 const struct exposed_face *f)
{
    struct part_of_face *one = NEW("check.places", p->n, struct part_of_face);
    double area = 0;
    int64_t n = 0;
    int places = 0;
    for (int64_t i = 0; i < p->n; i++)
        if (f->normal[i] > 0) one[n++] = (struct part_of_face){b->side * p->X[b->face][i], f->normal[i]};
    array_sort(one, n, sizeof *one, compare_doubles);
    for (int64_t k = 0; k < n; k++) area += one[k].area;
    for (int64_t k = 0, from = 0; k < n; k++) {
        one[from].area += k > from ? one[k].area : 0;
        if (k + 1 < n && one[k + 1].at - one[k].at <= PLACE_GAP * spacing) continue;
        if (one[from].area > SHARE_LEAST * area) one[places++] = (struct part_of_face){one[from].at, one[from].area};
        from = k + 1;
    }
    if (places > 1) {
        printf("; this face has parts at %d positions, near", places);
        for (int k = 0; k < places && k < 4; k++)
            printf("%s %c = %.4g m", k ? "," : "", "xyz"[b->face], b -> side *(one[k].at + 0.5 * spacing));
        printf(": a region with %c %s %.6g m selects only the outermost", "xyz"[b->face],
               b -> side > 0 ? ">=" : "<=", b->side * (one[places - 1].at - 0.5 * spacing));
    }
    memory_free(one);
}

void print_fraction_of_loaded_face_not_normal_to_axis(const struct run *run, const struct boundary *b)
{
    const struct scene *s = run->scene;
    struct elsewhere w = {0};
    struct ends c = {0};
    real cut = INFINITY;
    struct exposed_face f;
    if (s->dim == 1 || !(s->spacing > 0)) return;
    uint8_t *selected = NEW("check.selected", run->part.n, uint8_t);
    boundary_select_particles_in_region(b, &run->part, s->spacing, selected);
    exposed_face_compute_particle_areas(&f, b, &run->part, selected, s->spacing, false);
    if (has_normals(s, b) || ends_make(&c, &run->part, run->scene, b, &f))
        w = elsewhere_from(&run->part, run->scene, b, &f, &c, -INFINITY),
        cut = elsewhere_cut(&run->part, s, b, &f, &c, &w);
    memory_free(c.height);
    const bool inclined = w.other > SHARE_LEAST * w.area;
    if (!inclined && b->region.n == 0) print_places_of_face(&run->part, s->spacing, b, &f);
    exposed_face_free(&f);
    memory_free(selected);
    if (!inclined) return;
    printf(
        "; on %.0f %% of the area seen from %c%c the surface is inclined to this direction, by %.0f degrees on average",
        100 * w.other / w.area, "xyz"[b->face], b -> side > 0 ? '+' : '-', w.angle / w.other);
    if (b->region.n > 0) return;
    if (isfinite(cut))
        printf(": a region with %c %s %.6g m excludes it", "xyz"[b->face], b -> side > 0 ? ">=" : "<=", b->side * cut);
    else
        printf(": give a region to choose the face");
}
