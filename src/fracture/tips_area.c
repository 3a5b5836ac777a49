/* Computes the area of the faces that cracks have made. The front of a pre-crack is divided into strips one spacing
 * wide. In each strip the crack extends as far as particles follow one another without a gap whose damage exceeds half
 * of that beside a plane cut, the value in the middle of a diffuse crack front. Of cracks without a pre-crack, half of
 * the damaged particles count, since each has one on the other side. */
#include <math.h>

#include "base/memory.h"
#include "tips_parts.h"

#define EQUAL 1e-6 /* tolerance of equal lengths [spacings] */
enum { GAP = 2 };  /* empty cells that end a strip */

static real front_width(const struct crack_tip *tip, int dim) { return 2 * sqrt(dot(tip->edge, tip->edge, dim)); }

static int64_t strips_of(const struct crack_tips *t, const struct crack_tip *tip)
{
    return (int64_t)real_max(1, floor(front_width(tip, t->dim) / t->spacing + 0.5));
}

/* Returns the number, from 0, of the strip of a crack that contains the position X[dim] [m]. The front of the pre-crack
 * at `tip` is divided into strips about one spacing wide. Positions beyond the ends of the front count to the nearest
 * strip. t: all cracks, for the spacing. */
static int64_t strip_at(const struct crack_tips *t, const struct crack_tip *tip, const real *X)
{
    const real edge2 = dot(tip->edge, tip->edge, t->dim);
    const int64_t n = strips_of(t, tip);
    real along = 0;
    for (int d = 0; d < t->dim && edge2 > 0; d++) along += (X[d] - tip->origin[d]) * tip->edge[d] / edge2;
    const real at = 0.5 * (1 + along) * (real)n;
    return at > 0 ? (int64_t)real_min(at, (real)(n - 1)) : 0;
}

/* Position of a damaged particle relative to the nearest front of a pre-crack: number of the tip with this front, or -1
 * if the particle is not ahead of it, and distance from the front [cells of one spacing]. */
struct ahead {
    int tip;
    int64_t cell;
};

/* Finds the front of a pre-crack of t in body number `body` that is nearest to the position X[dim] [m]. Returns the
 * number of its tip, or -1 if X is not ahead of this front or there is no front, and the distance of X from the front
 * [cells of one spacing]. */
static struct ahead ahead_of(const struct crack_tips *t, int body, const real *X)
{
    struct ahead found = {-1, 0};
    real least = INFINITY;
    for (int k = 0; k < t->n; k++) {
        const struct crack_tip *tip = &t->tip[k];
        real offset[DIM_MAX];
        if (!tip->from_crack || tip->body != body) continue;
        const real reach = segment_distance_and_offset_to_point(tip->origin, tip->edge, X, t->dim, offset);
        if (reach >= least * (1 - EQUAL)) continue;
        const bool ahead = dot(offset, tip->along, t->dim) > EQUAL * t->spacing;
        least = reach;
        found = (struct ahead){ahead ? k : -1, (int64_t)(reach / t->spacing)};
    }
    return found;
}

/* Marks the part of the area ahead of all pre-cracks of t that is damaged. The fronts of pre-cracks are divided into
 * strips about one spacing wide, and the strip ahead of a front into `deepest` cells of one spacing. cell: the entries
 * of cells that contain a particle of p with more damage than `least` are set to 1; NULL: no cell is marked. first[k]:
 * number of the first strip of tip k; strip s has the cells from cell[s * deepest] on. Returns the largest distance of
 * such a particle from its front [cells]. */
static int64_t strips_mark(const struct crack_tips *t, const struct particles *p, real least, const int64_t *first,
                           int64_t deepest, uint8_t *cell)
{
    int64_t deep = 0;
    for (int64_t k = 0; k < p->n_of[KIND_PD]; k++) {
        const int32_t i = p->list[KIND_PD][k];
        real X[DIM_MAX];
        if (!(p->damage[i] > least) || t->label[i] == TIP_BEFORE || p->flag[i] & FLAG_DRIVEN) continue;
        particle_reference_position(p, i, X);
        const struct ahead a = ahead_of(t, p->body[i], X);
        if (a.tip < 0) continue;
        if (cell) cell[(first[a.tip] + strip_at(t, &t->tip[a.tip], X)) * deepest + a.cell] = 1;
        if (a.cell > deep) deep = a.cell;
    }
    return deep;
}

/* Returns the length of a strip of a crack, from its start at the pre-crack up to its last marked cell before a gap of
 * GAP unmarked cells [cells]. cell[deepest]: 1 for marked (damaged) cells of the strip, from the front of the pre-crack
 * on. */
static int64_t strip_length(const uint8_t *cell, int64_t deepest)
{
    int64_t end = 0;
    for (int64_t m = 0; m < deepest && m < end + GAP; m++)
        if (cell[m]) end = m + 1;
    return end;
}

bool tip_grows_on_mirror_plane(const struct crack_tips *t, const struct crack_tip *tip,
                               const struct mirror_plane *mirror, int mirror_count)
{
    bool on = false;
    for (int m = 0; m < mirror_count; m++) {
        const int axis = mirror[m].axis;
        on |= fabs(tip->origin[axis] - mirror[m].at) < 0.5 * t->spacing * (1 + EQUAL) && fabs(tip->along[axis]) < 0.1 &&
              fabs(tip->edge[axis]) < 0.1 * front_width(tip, t->dim) + EQUAL * t->spacing;
    }
    return on;
}

void tips_snap_onto_mirror_planes_they_grow_along(struct crack_tips *t, const struct mirror_plane *mirror,
                                                  int mirror_count)
{
    for (int k = 0; k < t->n; k++)
        for (int m = 0; m < mirror_count; m++) {
            real *at = &t->tip[k].place[mirror[m].axis];
            if (fabs(*at - mirror[m].at) < 0.5 * TIP_TOUCH * t->spacing &&
                tip_grows_on_mirror_plane(t, &t->tip[k], &mirror[m], 1))
                *at = mirror[m].at;
        }
}

struct crack_area tips_total_crack_area(const struct crack_tips *t, const struct particles *p,
                                        const struct tip_surroundings *s)
{
    int64_t first[TIPS_MAX + 1] = {0};
    struct crack_area area = {0};
    for (int k = 0; k < t->n; k++) first[k + 1] = first[k] + strips_of(t, &t->tip[k]);
    const int64_t deepest = strips_mark(t, p, s->half, first, 0, NULL) + 1;
    uint8_t *cell = NEW("tips.cell", first[t->n] * deepest, uint8_t);
    strips_mark(t, p, s->half, first, deepest, cell);
    for (int k = 0; k < t->n; k++) {
        const struct crack_tip *tip = &t->tip[k];
        const int64_t n = first[k + 1] - first[k];
        const real wide = t->dim == 3 ? front_width(tip, 3) / (real)n : s->section;
        const bool halved = tip_grows_on_mirror_plane(t, tip, s->mirror, s->mirrors);
        real sides = tip->from_crack ? 0 : (real)tip->particles * pow(t->spacing, t->dim - 1) * s->section;
        for (int64_t b = first[k]; b < first[k + 1] && tip->from_crack; b++)
            sides += (halved ? 1 : 2) * wide * t->spacing * (real)strip_length(cell + b * deepest, deepest);
        area.own += 0.5 * sides, area.face += halved ? sides : 0.5 * sides;
    }
    memory_free(cell);
    return area;
}

/* A particle of a bar with its reference position [m]. */
struct bar_place {
    real X;
    int32_t particle;
};

/* Compares two particles a and b of a bar (struct bar_place) for qsort, in ascending order of their reference
 * positions. */
static int bar_place_order(const void *a, const void *b)
{
    const struct bar_place *p = a, *q = b;
    return (p->X > q->X) - (p->X < q->X);
}

/* Increases *kept to the farthest position that an intact bond (in b) of particle i of p reaches in a bar on one side,
 * and *lost to the farthest position that a bond broken by load reaches, if they are farther. side: 1 towards larger
 * positions, -1 towards smaller ones. *kept, *lost: positions times `side` [m]. */
static void bar_bonds_reach(const struct bonds *b, const struct particles *p, int32_t i, int side, real *kept,
                            real *lost)
{
    for (struct bond_iterator it = bond_iterator_of_row(b, b->row_of[i]); bond_iterator_advance(&it);) {
        const real to = side * p->X[0][it.bond.nbr];
        if (it.bond.w != 0)
            *kept = real_max(*kept, to);
        else if (it.bond.inverse_length < 0)
            *lost = real_max(*lost, to);
    }
}

struct crack_area bar_total_crack_area(const struct bonds *b, const struct particles *p, real cross_section)
{
    const int64_t n = p->n_of[KIND_PD];
    struct bar_place *at = NEW("tips.bar", n, struct bar_place);
    int64_t cuts = 0, beside_mirror = 0;
    real kept = -INFINITY, lost = -INFINITY;
    for (int64_t k = 0; k < n; k++) {
        const int32_t i = p->list[KIND_PD][k];
        at[k] = (struct bar_place){p->X[0][i], i};
    }
    array_sort(at, n, sizeof *at, bar_place_order);
    if (n > 0) bar_bonds_reach(b, p, at[0].particle, -1, &kept, &lost);
    if (n > 0 && lost > -at[0].X && kept <= -at[0].X) beside_mirror++;
    kept = lost = -INFINITY;
    for (int64_t k = 0; k < n; k++) {
        bar_bonds_reach(b, p, at[k].particle, 1, &kept, &lost);
        const bool cut = lost > at[k].X && kept <= at[k].X;
        cuts += cut && k + 1 < n, beside_mirror += cut && k + 1 == n;
    }
    memory_free(at);
    return (struct crack_area){.face = cross_section * (real)(cuts + beside_mirror),
                               .own = cross_section * ((real)cuts + 0.5 * (real)beside_mirror)};
}
