/* Factors of bonds near faces: a bounded linear least-squares problem, solved by conjugate gradients.
 *
 * With the moments M4 = sum f w r nnnn and M3 = sum f w nnn of a class of particles, the factors f minimise
 *
 *     sum_classes members [ |M4 - (1 + tau) M|^2 + |M3 + M A/2|^2 ] + PRIOR sum_bonds (f - 1)^2,
 *     SURFACE_LEAST <= f <= SURFACE_MOST
 *
 * where |T|^2 = sum_k (T:B_k) P (T:B_k) over a basis B of strains, and P = (1 + STIFF Q)^-1 weighs strains by the
 * traction that they leave on faces nearby, Q(e, e') = (M:e) : N (x) N : (M:e'). */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/quadratic.h"
#include "bonds_parts.h"
#include "surface_parts.h"

#define STIFF 1000.0                     /* strains that load a face count 1/STIFF */
#define ROTATIONS -0.2                   /* alpha of models with rotations: fitted to bending */
/* Over the mean square of a bond in its moments: with a twentieth of it frequencies of beams of 10 layers are nearer by
 * 0.1 %, and steps shorter by a fifth. So with wider bounds. */
#define PRIOR 2e-2
#define CLOSE 1e-12                      /* share of the gradient that is left */
#define PRODUCTS 5000                    /* at most; solids take 2000, bodies of the plane 250 */
#define WORK 5e10                        /* multiplications at most: some 20 s of one core */
/* Moments of a bond side by side: third, then fourth, each with nothing up to an even number. */
enum { STRAINS = 6, THIRDS_2D = 4, FOURTHS_2D = 6, THIRDS = 10, FOURTHS = 16, MOMENTS = THIRDS + FOURTHS };

/* Components of symmetric tensors of rank `rank`: axes in ascending order. */
struct components { int n, rank, axis[FOURTHS][4]; };

static void components_make(struct components *c, int rank, int dim)
{
    int axis[4] = {0};
    c->n = 0, c->rank = rank;
    for (;;) {
        memcpy(c->axis[c->n++], axis, sizeof axis);
        int k = rank - 1;
        while (k >= 0 && axis[k] == dim - 1) k--;
        if (k < 0) return;
        for (int next = axis[k] + 1; k < rank; k++) axis[k] = next;
    }
}

/* Number of the component with these axes in any order. */
static int component_of(const struct components *c, const int *any)
{
    int axis[4];
    memcpy(axis, any, (size_t)c->rank * sizeof *axis);
    for (int a = 1; a < c->rank; a++)
        for (int b = a; b > 0 && axis[b - 1] > axis[b]; b--) {
            const int swap = axis[b];
            axis[b] = axis[b - 1], axis[b - 1] = swap;
        }
    for (int k = 0; k < c->n; k++)
        if (memcmp(c->axis[k], axis, (size_t)c->rank * sizeof *axis) == 0) return k;
    return -1;
}

static real component_value(const struct components *c, int k, const real *n)
{
    real value = 1;
    for (int a = 0; a < c->rank; a++) value *= n[c->axis[k][a]];
    return value;
}

/* What all classes share. */
struct moments {
    int dim, strains;
    struct components third, fourth;
    int width, fourth_at;                                        /* of what a bond adds; where its fourth begin */
    real *of;                                                    /* [offsets width] that, over M_1111 */
    real full[FOURTHS];                                          /* M over M_1111 */
    real strain[STRAINS][DIM_MAX][DIM_MAX], stress[STRAINS][DIM_MAX][DIM_MAX];   /* B_k, M:B_k */
    real fourth_by[STRAINS][STRAINS][FOURTHS];                   /* B_k:T:B_l of T by component */
    real third_by[DIM_MAX][STRAINS][THIRDS];                     /* n_p.T:B_l */
};

static real full_of(const struct moments *m, int a, int b, int c, int d)
{
    return m->full[component_of(&m->fourth, (const int[]){a, b, c, d})];
}

static void strains_make(struct moments *m)
{
    const int dim = m->dim;
    for (int a = 0; a < dim; a++) m->strain[m->strains++][a][a] = 1;
    for (int a = 0; a < dim; a++)
        for (int c = a + 1; c < dim; c++, m->strains++)
            m->strain[m->strains][a][c] = m->strain[m->strains][c][a] = sqrt(0.5);
    for (int k = 0; k < m->strains; k++)
        for (int a = 0; a < dim; a++)
            for (int b = 0; b < dim; b++)
                for (int c = 0; c < dim; c++)
                    for (int d = 0; d < dim; d++) {
                        const real e = m->strain[k][c][d];
                        m->stress[k][a][b] += e != 0 ? full_of(m, a, b, c, d) * e : 0;
                        for (int l = 0; l < m->strains && e != 0; l++)
                            m->fourth_by[l][k][component_of(&m->fourth, (const int[]){a, b, c, d})] +=
                                m->strain[l][a][b] * e;
                        if (b == 0 && e != 0) m->third_by[a][k][component_of(&m->third, (const int[]){a, c, d})] += e;
                    }
}

static void moments_make(struct moments *m, const struct offsets *o)
{
    real sum[FOURTHS] = {0};
    *m = (struct moments){.dim = o->dim};
    components_make(&m->third, 3, o->dim);
    components_make(&m->fourth, 4, o->dim);
    for (int k = 0; k < o->n; k++)
        for (int c = 0; c < m->fourth.n; c++)
            sum[c] += o->weight[k] * o->length[k] * component_value(&m->fourth, c, o->direction[k]);
    for (int c = 0; c < m->fourth.n; c++) m->full[c] = sum[c] / sum[0];
    m->fourth_at = o->dim < 3 ? THIRDS_2D : THIRDS;
    m->width = m->fourth_at + (o->dim < 3 ? FOURTHS_2D : FOURTHS);
    m->of = NEW("surface.moments", (int64_t)o->n * m->width, real);
    for (int k = 0; k < o->n; k++) {
        real *third = m->of + (int64_t)k * m->width, *fourth = third + m->fourth_at;
        for (int c = 0; c < m->third.n; c++)
            third[c] = o->weight[k] * component_value(&m->third, c, o->direction[k]) / sum[0];
        for (int c = 0; c < m->fourth.n; c++)
            fourth[c] = o->weight[k] * o->length[k] * component_value(&m->fourth, c, o->direction[k]) / sum[0];
    }
    strains_make(m);
}

/* alpha of bonds: that of a plane face along which the body is pulled; in an isotropic family that of shear along it is
 * the same. */
static real face_moment(const struct moments *m, const struct offsets *o)
{
    const real c11 = m->full[0], c12 = full_of(m, 0, 0, 1, 1), across = c12 / (c11 + (m->dim - 2) * c12);
    real sum = 0, weight = 0;
    for (int k = 0; k < o->n; k++) {
        real strain = square(o->direction[k][0]);
        for (int d = 1; d < m->dim; d++) strain -= across * square(o->direction[k][d]);
        const real w = o->weight[k] * o->length[k] * square(strain);
        sum += w * square((real)o->at[k][1]), weight += w;
    }
    return 1.0 / 24 + sum / weight / 8;
}

/* ---- a class ----------------------------------------------------------------------------------------------------- */

/* Factors of groups that are not fitted. */
struct given { const real *factor; const uint8_t *fixed; };

/* Weights of the squares of its moments, times its members, and what the bonds that may change ought to add to them. */
struct class_fit { real third[THIRDS][THIRDS], fourth[FOURTHS][FOURTHS], goal[MOMENTS]; };

/* Inverse of a symmetric positive matrix, in place, by Gauss and Jordan. */
static void invert(real (*a)[STRAINS], int n)
{
    for (int k = 0; k < n; k++) {
        const real pivot = 1 / a[k][k];
        a[k][k] = 1;
        for (int c = 0; c < n; c++) a[k][c] *= pivot;
        for (int r = 0; r < n; r++) {
            if (r == k) continue;
            const real factor = a[r][k];
            a[r][k] = 0;
            for (int c = 0; c < n; c++) a[r][c] -= factor * a[k][c];
        }
    }
}

/* P of a mean N (x) N. */
static void strain_weights(const struct moments *m, real (*normal2)[DIM_MAX], real (*P)[STRAINS])
{
    const int dim = m->dim;
    for (int k = 0; k < m->strains; k++)
        for (int l = 0; l < m->strains; l++) {
            real traction = 0;
            for (int a = 0; a < dim; a++)
                for (int b = 0; b < dim; b++)
                    for (int c = 0; c < dim; c++) traction += m->stress[k][a][b] * normal2[b][c] * m->stress[l][a][c];
            P[k][l] = (k == l) + STIFF * traction;
        }
    invert(P, m->strains);
}

/* to = sum_k by_k^T P by_k. */
static void quadratic(const real *by, int rows, int strains, int n, int room, real (*P)[STRAINS], real *to)
{
    for (int k = 0; k < rows; k++)
        for (int l = 0; l < strains; l++) {
            real half[FOURTHS] = {0};
            for (int q = 0; q < strains; q++)
                for (int y = 0; y < n; y++) half[y] += P[l][q] * by[(k * STRAINS + q) * room + y];
            for (int x = 0; x < n; x++)
                for (int y = 0; y < n; y++) to[x * room + y] += by[(k * STRAINS + l) * room + x] * half[y];
        }
}

/* Means over the members of a class of what faces ask for, in all mirrors in which it looks alike: beyond the
 * surroundings that make a class, members may differ, and sides of a member. */
struct class_goal { real area[DIM_MAX], dipole, normal2[DIM_MAX][DIM_MAX]; };

static void class_goal_add(struct class_goal *to, int dim, const struct faces *f, int64_t t, int mirrors, real share)
{
    to->dipole += share * f->dipole[t];
    for (int d = 0; d < dim; d++) {
        const real sign = share * mirror_sign(mirrors, d);
        to->area[d] += sign * f->area[t][d];
        for (int e = 0; e < dim; e++) to->normal2[d][e] += sign * mirror_sign(mirrors, e) * f->normal2[t][d][e];
    }
}

static void class_goals(struct class_goal *goal, int dim, const struct near_faces *b, const struct faces *f,
                        const struct alike *a)
{
    for (int64_t t = 0; t < b->n; t++) {
        const int32_t class = a->class_of[t];
        const int symmetry = a->symmetry[class];
        const real share = 1 / (a->members[class] * __builtin_popcount((unsigned)symmetry));
        for (int m = 0; m < 1 << dim; m++)
            if (symmetry >> m & 1) class_goal_add(&goal[class], dim, f, t, a->mirrors[t] ^ m, share);
    }
}

/* Its goal for the bonds that may change: less what those add that stay, or whose factors are given. */
static void class_goal_rest(struct class_fit *c, const struct moments *m, const struct near_faces *b,
                            const struct alike *a, int32_t class, const struct given *given)
{
    for (int k = 0; k < b->offset.n; k++) {
        const int64_t group = a->group_of[(int64_t)class * b->offset.n + k];
        if (alike_neighbour(a, b, class, k) < 0 || (group >= 0 && !given->fixed[group])) continue;
        const real factor = group < 0 ? 1 : given->factor[group];
        for (int x = 0; x < m->width; x++) c->goal[x] -= factor * m->of[(int64_t)k * m->width + x];
    }
}

static void class_make(struct class_fit *c, const struct moments *m, struct class_goal *goal, real members, real alpha)
{
    real P[STRAINS][STRAINS];
    strain_weights(m, goal->normal2, P);
    *c = (struct class_fit){{{0}}, {{0}}, {0}};
    quadratic(&m->fourth_by[0][0][0], m->strains, m->strains, m->fourth.n, FOURTHS, P, &c->fourth[0][0]);
    quadratic(&m->third_by[0][0][0], m->dim, m->strains, m->third.n, THIRDS, P, &c->third[0][0]);
    for (int x = 0; x < THIRDS; x++)
        for (int y = 0; y < THIRDS; y++) c->third[x][y] *= members;
    for (int x = 0; x < FOURTHS; x++)
        for (int y = 0; y < FOURTHS; y++) c->fourth[x][y] *= members;
    for (int x = 0; x < m->third.n; x++)
        for (int d = 0; d < m->dim; d++) {
            const int *axis = m->third.axis[x];
            c->goal[x] -= 0.5 * full_of(m, axis[0], axis[1], axis[2], d) * goal->area[d];
        }
    for (int x = 0; x < m->fourth.n; x++) c->goal[m->fourth_at + x] = (1 + alpha * goal->dipole) * m->full[x];
}

/* to = the squares' weights of a class times its moments. */
static ALWAYS_INLINE void class_weigh(const struct class_fit *c, const real *moment, real *to, const int thirds,
                                      const int fourths)
{
    for (int x = 0; x < thirds + fourths; x++) to[x] = 0;
    for (int y = 0; y < thirds; y++)                     /* symmetric: by rows */
        for (int x = 0; x < thirds; x++) to[x] += c->third[y][x] * moment[y];
    for (int y = 0; y < fourths; y++)
        for (int x = 0; x < fourths; x++) to[thirds + x] += c->fourth[y][x] * moment[thirds + y];
}

/* ---- the problem ------------------------------------------------------------------------------------------------- */

/* Two bonds of a class in opposite directions, of which one may change: the difference of their factors makes third
 * moments, the sum fourth ones. Number of the first one's offset; their unknowns, -1: none. */
struct opposites { int offset; int64_t unknown[2]; };

/* Unknowns are the factors of the groups that may change. */
struct problem {
    const struct alike *alike;
    int offsets;
    struct moments moments;
    struct class_fit *class;
    int64_t unknowns, *unknown_of;       /* [groups] -1: its factor is given */
    int64_t *pairs;                      /* [classes + 1] first pair of a class */
    struct opposites *pair;
    int64_t *first, *entry;              /* [unknowns + 1], its places in `value` */
    real *value;                         /* [2 pairs] of bonds, room */
    real *bonds;                         /* [unknowns] its bonds: half of what its entries count */
    real *diagonal, *goal, prior;        /* [unknowns] of the matrix; the right side; times bonds */
};

static int64_t unknown_at(const struct problem *q, int32_t class, int k)
{
    const int64_t group = q->alike->group_of[(int64_t)class * q->offsets + k];
    return group < 0 ? -1 : q->unknown_of[group];
}

static void opposites_make(struct problem *q, const struct given *given)
{
    const struct alike *a = q->alike;
    int64_t n = 0;
    q->unknown_of = NEW("surface.unknown", a->groups, int64_t);
    for (int64_t g = 0; g < a->groups; g++) q->unknown_of[g] = given->fixed[g] ? -1 : q->unknowns++;
    q->pairs = NEW("surface.pairs", a->classes + 1, int64_t);
    for (int fill = 0; fill < 2; fill++) {
        n = 0;
        for (int32_t class = 1; class < a->classes; class++) {
            for (int k = 0; k < q->offsets / 2; k++) {
                const struct opposites pair = {k, {unknown_at(q, class, k), unknown_at(q, class, q->offsets - 1 - k)}};
                if (pair.unknown[0] < 0 && pair.unknown[1] < 0) continue;
                if (fill) q->pair[n] = pair;
                n++;
            }
            q->pairs[class + 1] = n;
        }
        if (!fill) q->pair = NEW("surface.pair", n, struct opposites);
    }
    q->value = NEW("surface.value", 2 * n, real);
}

/* The places of each unknown. */
static void places_make(struct problem *q)
{
    const struct alike *a = q->alike;
    const int64_t n = q->unknowns, places = 2 * q->pairs[a->classes];
    q->first = NEW("surface.first", n + 1, int64_t);
    q->bonds = NEW("surface.bonds", n, real);
    for (int64_t k = 0; k < places; k++) {
        const int64_t u = q->pair[k / 2].unknown[k % 2];
        if (u >= 0) q->first[u + 1]++;
    }
    for (int64_t u = 0; u < n; u++) q->first[u + 1] += q->first[u];
    q->entry = NEW("surface.entry", q->first[n], int64_t);
    int64_t *next = NEW("surface.next", n, int64_t);
    memcpy(next, q->first, (size_t)n * sizeof *next);
    for (int32_t class = 1; class < a->classes; class++)
        for (int64_t k = 2 * q->pairs[class]; k < 2 * q->pairs[class + 1]; k++) {
            const int64_t u = q->pair[k / 2].unknown[k % 2];
            if (u >= 0) q->entry[next[u]++] = k, q->bonds[u] += 0.5 * a->members[class];
        }
    memory_free(next);
}

/* to = sum over the entries of each unknown of `value`, plus prior times bonds times x. */
static void unknown_sums(const struct problem *q, const real *x, real *to)
{
#pragma omp parallel for schedule(static)
    for (int64_t u = 0; u < q->unknowns; u++) {
        real sum = 0;
        for (int64_t k = q->first[u]; k < q->first[u + 1]; k++) sum += q->value[q->entry[k]];
        to[u] = sum + q->prior * q->bonds[u] * (x ? x[u] : 1);
    }
}

/* Values of the bonds of a class from its moments. */
static ALWAYS_INLINE void class_back(const struct problem *q, int32_t class, const real *moment, const int thirds,
                                     const int fourths)
{
    real by[MOMENTS];
    class_weigh(&q->class[class], moment, by, thirds, fourths);
    for (int64_t k = q->pairs[class]; k < q->pairs[class + 1]; k++) {
        const real *of = q->moments.of + (int64_t)q->pair[k].offset * (thirds + fourths);
        real odd[2] = {0}, even[2] = {0};
        for (int x = 0; x < thirds; x += 2)
            for (int l = 0; l < 2; l++) odd[l] += of[x + l] * by[x + l];
        for (int x = thirds; x < thirds + fourths; x += 2)
            for (int l = 0; l < 2; l++) even[l] += of[x + l] * by[x + l];
        q->value[2 * k] = (even[0] + even[1]) + (odd[0] + odd[1]);
        q->value[2 * k + 1] = (even[0] + even[1]) - (odd[0] + odd[1]);
    }
}

static ALWAYS_INLINE void class_product(const struct problem *q, int32_t class, const real *x, const int thirds,
                                        const int fourths)
{
    real moment[MOMENTS] = {0};
    for (int64_t k = q->pairs[class]; k < q->pairs[class + 1]; k++) {
        const int64_t *u = q->pair[k].unknown;
        const real one = u[0] < 0 ? 0 : x[u[0]], other = u[1] < 0 ? 0 : x[u[1]];
        const real *of = q->moments.of + (int64_t)q->pair[k].offset * (thirds + fourths);
        if (one == 0 && other == 0) continue;            /* at bounds: most directions leave them there */
        for (int c = 0; c < thirds; c++) moment[c] += (one - other) * of[c];
        for (int c = thirds; c < thirds + fourths; c++) moment[c] += (one + other) * of[c];
    }
    class_back(q, class, moment, thirds, fourths);
}

/* y = H x. */
static void fit_product(void *context, const real *x, real *y)
{
    const struct problem *q = context;
    const bool plane = q->moments.fourth_at == THIRDS_2D;
#pragma omp parallel for schedule(static, 8)
    for (int32_t class = 1; class < q->alike->classes; class++) {
        if (q->pairs[class] == q->pairs[class + 1]) continue;
        if (plane) class_product(q, class, x, THIRDS_2D, FOURTHS_2D);
        else class_product(q, class, x, THIRDS, FOURTHS);
    }
    unknown_sums(q, x, y);
}

/* What a bond alone adds to the diagonal. */
static real bond_square(const struct problem *q, int32_t class, int k)
{
    const real *of = q->moments.of + (int64_t)k * q->moments.width;
    real by[MOMENTS], sum = 0;
    if (q->moments.fourth_at == THIRDS_2D) class_weigh(&q->class[class], of, by, THIRDS_2D, FOURTHS_2D);
    else class_weigh(&q->class[class], of, by, THIRDS, FOURTHS);
    for (int x = 0; x < q->moments.width; x++) sum += of[x] * by[x];
    return sum;
}

/* The weight of the prior: over the mean of the diagonal of all bonds, also of those whose factors are given. */
static void prior_make(struct problem *q)
{
    const struct alike *a = q->alike;
    real *square_of = NEW("surface.square", a->classes, real), sum = 0, bonds = 0;
#pragma omp parallel for schedule(static)
    for (int32_t class = 1; class < a->classes; class++)
        for (int k = 0; k < q->offsets; k++)
            if (a->group_of[(int64_t)class * q->offsets + k] >= 0) square_of[class] += bond_square(q, class, k);
    for (int32_t class = 1; class < a->classes; class++) {
        sum += square_of[class];
        for (int k = 0; k < q->offsets; k++)
            bonds += a->group_of[(int64_t)class * q->offsets + k] >= 0 ? 0.5 * a->members[class] : 0;
    }
    q->prior = bonds > 0 ? PRIOR * sum / bonds : 0;
    memory_free(square_of);
}

/* Diagonal of the matrix, and right side. */
static void diagonal_make(struct problem *q)
{
    const struct alike *a = q->alike;
#pragma omp parallel for schedule(static)
    for (int32_t class = 1; class < a->classes; class++)
        for (int64_t k = q->pairs[class]; k < q->pairs[class + 1]; k++)
            q->value[2 * k] = q->value[2 * k + 1] = bond_square(q, class, q->pair[k].offset);
    q->diagonal = NEW("surface.diagonal", q->unknowns, real);
    unknown_sums(q, NULL, q->diagonal);
    q->goal = NEW("surface.goal", q->unknowns, real);
#pragma omp parallel for schedule(static)
    for (int32_t class = 1; class < a->classes; class++) {
        if (q->moments.fourth_at == THIRDS_2D) class_back(q, class, q->class[class].goal, THIRDS_2D, FOURTHS_2D);
        else class_back(q, class, q->class[class].goal, THIRDS, FOURTHS);
    }
    unknown_sums(q, NULL, q->goal);
}

/* Factors of the groups that may change. */
static void solve(struct problem *q, real *factor)
{
    const int64_t n = q->unknowns;
    const real work = 2.0 * (real)q->pairs[q->alike->classes] * q->moments.width;
    real *low = NEW("surface.low", n, real), *high = NEW("surface.high", n, real), *x = NEW("surface.x", n, real);
    for (int64_t u = 0; u < n; u++) low[u] = SURFACE_LEAST, high[u] = SURFACE_MOST, x[u] = 1;
    const struct quadratic f = {fit_product, q, n, q->goal, q->diagonal, low, high};
    quadratic_descend(&f, x, CLOSE, (int)fmin(PRODUCTS, WORK / fmax(work, 1)));
    for (int64_t g = 0; g < q->alike->groups; g++)
        if (q->unknown_of[g] >= 0) factor[g] = x[q->unknown_of[g]];
    memory_free(low);
    memory_free(high);
    memory_free(x);
}

static void problem_free(struct problem *q)
{
    memory_free(q->moments.of);
    memory_free(q->class);
    memory_free(q->unknown_of);
    memory_free(q->pairs);
    memory_free(q->pair);
    memory_free(q->first);
    memory_free(q->entry);
    memory_free(q->value);
    memory_free(q->bonds);
    memory_free(q->diagonal);
    memory_free(q->goal);
}

void surface_fit(real *factor, const struct near_faces *b, const struct faces *f, const struct alike *a,
                 bool rotates)
{
    struct problem q = {.alike = a, .offsets = b->offset.n};
    uint8_t *fixed = NEW("surface.fixed", a->groups, uint8_t);
    const struct given given = {factor, fixed};
    for (int64_t g = 0; g < a->groups; g++) factor[g] = 1;
    surface_plain(factor, fixed, b, f, a, rotates);
    moments_make(&q.moments, &b->offset);
    const real alpha = rotates ? ROTATIONS : face_moment(&q.moments, &b->offset);
    q.class = BARE("surface.class", a->classes, struct class_fit);
    struct class_goal *goal = NEW("surface.goal", a->classes, struct class_goal);
    class_goals(goal, b->offset.dim, b, f, a);
#pragma omp parallel for schedule(static)
    for (int32_t class = 1; class < a->classes; class++) {
        class_make(&q.class[class], &q.moments, &goal[class], a->members[class], alpha);
        class_goal_rest(&q.class[class], &q.moments, b, a, class, &given);
    }
    memory_free(goal);
    opposites_make(&q, &given);
    places_make(&q);
    prior_make(&q);
    diagonal_make(&q);
    solve(&q, factor);
    memory_free(fixed);
    problem_free(&q);
}
