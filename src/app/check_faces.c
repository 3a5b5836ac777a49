/* What `face` of a load or support holds beside what its author may mean: all that the body shows along an axis, so
 * slopes and curves, too. Where the body has a shape its normal tells; else how columns of particles beside each other
 * end. */
#include <math.h>
#include <stdio.h>

#include "base/memory.h"
#include "check_parts.h"

#define ELSEWHERE                                                                                                      \
    10.0 /* [degrees] between the normal of a surface and the axis of the face: more is another direction */
#define SHARE_LEAST 0.05  /* of the area, that is worth words: a row at the edge of a slope is less in a face of 20 */
enum { AWAY = 4 };        /* [columns] over which heights are compared: steps of slopes of 14 degrees and more */
#define COLUMNS_MOST 16.0 /* places of columns in the box across the axis, over particles of the face */

/* Ends of columns across the axis of a face, by their places in a box [spacings]. */
struct ends {
    int axes, axis[DIM_MAX - 1], n[DIM_MAX - 1];
    real low[DIM_MAX - 1];
    real *height; /* [n] along the axis, outwards [spacings]; NAN: none */
};

/* What looks elsewhere. */
struct elsewhere {
    real area, other, angle; /* of the face; of what looks elsewhere [m^2]; its angle times area [degree m^2] */
    real aligned, last;      /* what looks along the axis: its ends that lie deepest and farthest out [m] */
};

static int64_t place_of(const struct ends *c, const real *X, real spacing)
{
    int64_t place = 0;
    for (int k = c->axes - 1; k >= 0; k--)
        place = place * c->n[k] + (int64_t)((X[c->axis[k]] - c->low[k]) / spacing + 0.5);
    return place;
}

/* The ends of columns with an area; false where they are too scattered for a table. */
static bool ends_make(struct ends *c, const struct particles *p, const struct scene *scene, const struct boundary *b,
                      const struct face *f)
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
        particle_place(p, i, X);
        c->height[place_of(c, X, spacing)] = b->side * X[b->face] / spacing;
    }
    return true;
}

/* Slope of the ends of columns at a place, along one axis: the lesser of those to both sides, so that a step is none.
 */
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

/* Cosine of the angle between the axis of a face and the surface at particle i, whose cube shows there. */
static real cosine_at(const struct scene *scene, const struct particles *part, const struct boundary *b,
                      const struct ends *c, int64_t i)
{
    const struct region *shape = &scene->body[part->body[i]].shape;
    real X[DIM_MAX], normal[DIM_MAX] = {0}, slope2 = 0;
    particle_place(part, i, X);
    if (!c->height) {
        X[b->face] += 0.5 * b->side * scene->spacing;
        region_distance(shape, X, part->dim, normal);
        return b->side * normal[b->face];
    }
    for (int k = 0; k < c->axes; k++) slope2 += square(slope_along(c, place_of(c, X, scene->spacing), k));
    return 1 / sqrt(1 + slope2);
}

/* Adds up the cubes of a face that show from a place along its axis on (-INFINITY: all). */
static struct elsewhere elsewhere_from(const struct particles *part, const struct scene *scene,
                                       const struct boundary *b, const struct face *f, const struct ends *c, real from)
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

/* Where a region would begin that leaves out nearly all that looks elsewhere; INFINITY: no plane does. */
static real elsewhere_cut(const struct run *e, const struct boundary *b, const struct face *f, const struct ends *c,
                          const struct elsewhere *all)
{
    for (int k = 0; k < 2 && isfinite(all->aligned); k++) {
        const real from = k == 0 ? all->aligned : all->last;
        const struct elsewhere w = elsewhere_from(&e->part, e->scene, b, f, c, from);
        if (!(w.other > SHARE_LEAST * w.area)) return from;
    }
    return INFINITY;
}

/* Do all bodies of a face have a shape whose normals are known? */
static bool has_normals(const struct scene *s, const struct boundary *b)
{
    bool all = true;
    for (int k = 0; k < s->bodies; k++) {
        const struct region *shape = &s->body[k].shape;
        if (b->body >= 0 && s->body[k].joined != b->body) continue;
        all &= !s->body[k].file && s->body[k].joined == k && shape->n > 0 && !region_has_endless_box(shape, s->dim);
        for (int j = 0; j < shape->n; j++)
            all &= shape->solid[j].kind != SOLID_VOXELS && shape->solid[j].kind != SOLID_ALL;
        for (int j = 0; j < s->bodies; j++) all &= j == k || s->body[j].joined != k;
    }
    return all;
}

void say_elsewhere(const struct run *e, const struct boundary *b)
{
    const struct scene *s = e->scene;
    struct elsewhere w = {0};
    struct ends c = {0};
    real cut = INFINITY;
    struct face f;
    if (s->dim == 1 || !(s->spacing > 0)) return;
    uint8_t *selected = NEW("check.selected", e->part.n, uint8_t);
    load_region(b, &e->part, s->spacing, selected);
    face_make(&f, b, &e->part, selected, s->spacing, false);
    if (has_normals(s, b) || ends_make(&c, &e->part, e->scene, b, &f))
        w = elsewhere_from(&e->part, e->scene, b, &f, &c, -INFINITY), cut = elsewhere_cut(e, b, &f, &c, &w);
    memory_free(c.height);
    face_free(&f);
    memory_free(selected);
    if (!(w.other > SHARE_LEAST * w.area)) return;
    printf("; %.0f %% of the area seen from %c%c has other normals, by %.0f degrees on average", 100 * w.other / w.area,
           "xyz"[b->face], b -> side > 0 ? '+' : '-', w.angle / w.other);
    if (b->region.n > 0) return;
    if (isfinite(cut))
        printf(": a region with %c %s %.6g m leaves it out", "xyz"[b->face],
               b -> side > 0 ? ">=" : "<=", b->side * cut);
    else
        printf(": give a region to choose the face");
}
