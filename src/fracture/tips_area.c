/* Area of the faces that cracks have made. The front of a pre-crack is looked at in strips a spacing wide: in each the
 * crack reaches as far as the cell of its farthest particle goes, which is one that has lost nearly all bonds across
 * the crack. Of cracks that began elsewhere, half of the particles count, as each has one on the other side. */
#include <math.h>

#include "base/memory.h"
#include "tips_parts.h"

#define EQUAL 1e-6 /* lengths that differ by less are equal [spacings] */

/* A strip of a front: its farthest particles, and the sum of their offsets from the front's edge. */
struct strip {
    real farthest, offset[DIM_MAX];
    int64_t equals;
};

static real front_width(const struct tip *tip, int dim) { return 2 * sqrt(dot(tip->edge, tip->edge, dim)); }

static int64_t strips_of(const struct tips *t, const struct tip *tip)
{
    return (int64_t)real_max(1, floor(front_width(tip, t->dim) / t->spacing + 0.5));
}

/* Strip in which X lies, the nearest one where it lies beside the front. */
static int64_t strip_at(const struct tips *t, const struct tip *tip, const real *X)
{
    const real edge2 = dot(tip->edge, tip->edge, t->dim);
    const int64_t n = strips_of(t, tip);
    real along = 0;
    for (int d = 0; d < t->dim && edge2 > 0; d++) along += (X[d] - tip->origin[d]) * tip->edge[d] / edge2;
    const real at = 0.5 * (1 + along) * (real)n;
    return at > 0 ? (int64_t)real_min(at, (real)(n - 1)) : 0;
}

/* Looks at the particles of cracks that began at a front; the second pass adds up those that are equally far. */
static void strips_measure(const struct tips *t, const struct particles *p, const int64_t *first, struct strip *strip,
                           bool second)
{
    for (int64_t i = 0; i < t->count; i++) {
        real X[DIM_MAX], offset[DIM_MAX];
        if (t->label[i] == 0 || t->label[i] == TIP_BEFORE) continue;
        const struct tip *tip = &t->tip[t->label[i] - 1];
        if (!tip->from_crack) continue;
        particle_place(p, i, X);
        struct strip *s = &strip[first[t->label[i] - 1] + strip_at(t, tip, X)];
        const real reach = tip_offset(tip->origin, tip->edge, X, t->dim, offset);
        const bool ahead = dot(offset, tip->along, t->dim) > -EQUAL * t->spacing;
        if (!second && ahead) s->farthest = real_max(s->farthest, reach);
        if (!second || !ahead || reach < s->farthest - EQUAL * t->spacing) continue;
        for (int d = 0; d < t->dim; d++) s->offset[d] += offset[d];
        s->equals++;
    }
}

/* Length of the strips of a front, summed up [m]. */
static real strips_length(const struct tips *t, const struct strip *strip, int64_t n)
{
    real sum = 0;
    for (int64_t k = 0; k < n; k++)
        if (strip[k].equals > 0)
            sum += sqrt(dot(strip[k].offset, strip[k].offset, t->dim)) / (real)strip[k].equals + 0.5 * t->spacing;
    return sum;
}

/* Does a crack run along a plane of symmetry, so that the body has one of its faces? */
static bool tip_on_mirror(const struct tips *t, const struct tip *tip, const struct mirror_plane *mirror, int mirrors)
{
    bool on = false;
    for (int m = 0; m < mirrors; m++) {
        const int axis = mirror[m].axis;
        on |= fabs(tip->origin[axis] - mirror[m].at) < 0.5 * t->spacing * (1 + EQUAL) && fabs(tip->along[axis]) < 0.1 &&
              fabs(tip->edge[axis]) < 0.1 * front_width(tip, t->dim) + EQUAL * t->spacing;
    }
    return on;
}

real tips_area(const struct tips *t, const struct particles *p, const struct mirror_plane *mirror, int mirrors,
               real section)
{
    int64_t first[TIPS_MAX + 1] = {0};
    real area = 0;
    for (int k = 0; k < t->n; k++) first[k + 1] = first[k] + strips_of(t, &t->tip[k]);
    struct strip *strip = NEW("tips.strip", first[t->n], struct strip);
    strips_measure(t, p, first, strip, false);
    strips_measure(t, p, first, strip, true);
    for (int k = 0; k < t->n; k++) {
        const struct tip *tip = &t->tip[k];
        const int64_t n = first[k + 1] - first[k];
        const real wide = t->dim == 3 ? front_width(tip, 3) / (real)n : section;
        if (tip->from_crack)
            area += strips_length(t, strip + first[k], n) * wide * (tip_on_mirror(t, tip, mirror, mirrors) ? 0.5 : 1);
        else
            area += 0.5 * (real)tip->particles * pow(t->spacing, t->dim - 1) * section;
    }
    memory_free(strip);
    return area;
}
