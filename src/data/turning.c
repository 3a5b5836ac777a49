/* Groups of material points that rotate together. The sums of a group are added by one thread in the order of its
 * members, and those of groups in their order, so that bits do not depend on the number of threads. */
#include "data/turning.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"

/* Smallest radius of inertia of a group of points that rotate together [spacings], for single points and, in 3D, lines;
 * empirical. */
#define LEAST_ARM 0.05

/* ---- making ------------------------------------------------------------------------------------------------------ */

/* A particle, and the integer position of the group of points, rotating together, to which it belongs. */
struct member {
    real X[DIM_MAX];
    int64_t place[DIM_MAX];
    int32_t body, particle, off;
};

/* Compares the integer positions a and b of two groups of points, first their bodies body_a and body_b. Returns -1, 0
 * or 1. */
static int order_of_places(const int64_t *a, int body_a, const int64_t *b, int body_b)
{
    if (body_a != body_b) return body_a < body_b ? -1 : 1;
    for (int d = DIM_MAX; d-- > 0;)
        if (a[d] != b[d]) return a[d] < b[d] ? -1 : 1;
    return 0;
}

/* Compares two particles by the group of points to which they belong, then by position, then by number, for
 * array_sort. */
static int by_member(const void *a, const void *b)
{
    const struct member *p = a, *q = b;
    const int order = order_of_places(p->place, p->body, q->place, q->body);
    for (int d = DIM_MAX; d-- > 0 && !order;)
        if (p->X[d] != q->X[d]) return p->X[d] < q->X[d] ? -1 : 1;
    return order ? order : (p->particle > q->particle) - (p->particle < q->particle);
}

/* Compares two groups of points that rotate together by body, then by position, for array_sort and bsearch. Returns -1,
 * 0 or 1. */
static int by_group(const void *a, const void *b)
{
    const struct turning_group *p = a, *q = b;
    return order_of_places(p->place, p->body, q->place, q->body);
}

/* Returns the integer position along an axis of the group of points that contains the coordinate u, measured from the
 * middle of the body [spacings]. odd: true if the middle of the body is the middle of a group, false if it is a border
 * between two. */
static int64_t group_place(real u, bool odd)
{
    const real far = floor((fabs(u) + (odd ? (TURNING_EDGE - 1) / 2.0 : TURNING_EDGE)) / TURNING_EDGE);
    return (int64_t)(u < 0 ? -far : far - !odd);
}

/* Returns the particles sorted by group and position; their order does not depend on their numbers. middle[3]: middle
 * of the body [m]; one: index of the joined body for each body. Release it with memory_free. */
static struct member *members_sorted(const struct particles *p, real spacing, const real *middle, const int *one)
{
    struct member *all = NEW("turning.sorted", p->n, struct member);
    bool odd[DIM_MAX] = {false}; /* a row of particles is on the middle */
    for (int d = 0; d < p->dim; d++) {
        real low, high;
        particles_coordinate_range(p, p->n, d, &low, &high);
        const real rows = (low - middle[d]) / spacing;
        odd[d] = fabs(rows - nearbyint(rows)) < 0.25;
    }
    for (int64_t i = 0; i < p->n; i++) {
        all[i].body = one[p->body[i]], all[i].particle = (int32_t)i;
        for (int d = 0; d < p->dim; d++) all[i].X[d] = p->X[d][i];
        for (int d = 0; d < p->dim; d++) {
            all[i].place[d] = group_place((p->X[d][i] - middle[d]) / spacing, odd[d]);
            all[i].off += (int32_t)llabs(2 * all[i].place[d] + !odd[d]);
        }
    }
    array_sort(all, p->n, sizeof *all, by_member);
    return all;
}

/* Stores in own->near the indices of the 26 groups of points around group g of the same body: first those displaced
 * along one axis, then along two, then along three; -1 where there is none. */
static void groups_near(struct rotation_groups *t, int32_t g)
{
    struct turning_group *own = &t->group[g];
    for (int k = 0, n = 0; k < 81; k++) {
        const int step[DIM_MAX] = {k % 3 - 1, k / 3 % 3 - 1, k / 9 % 3 - 1};
        if (abs(step[0]) + abs(step[1]) + abs(step[2]) != 1 + k / 27) continue;
        struct turning_group like = {.body = own->body};
        for (int d = 0; d < DIM_MAX; d++) like.place[d] = own->place[d] + step[d];
        const struct turning_group *at = bsearch(&like, t->group, (size_t)t->groups, sizeof like, by_group);
        own->near[n++] = at ? (int32_t)(at - t->group) : -1;
    }
}

void rotation_groups_make(struct rotation_groups *t, const struct particles *p, real spacing, const real *origin,
                          const int *joined_to, const bool *supported)
{
    struct member *all = members_sorted(p, spacing, origin, joined_to);
    rotation_groups_free(t);
    for (int64_t k = 0; k < p->n; k++)
        t->groups += k == 0 || order_of_places(all[k].place, all[k].body, all[k - 1].place, all[k - 1].body) != 0;
    t->group = NEW("turning.group", t->groups, struct turning_group);
    t->member = NEW("turning.member", p->n, int32_t);
    for (int c = p->dim == 2 ? 2 : 0; c < 3; c++) t->turn[c] = NEW("turning.turn", p->n, real);
    struct turning_group *g = t->group - 1;
    for (int64_t k = 0; k < p->n; k++) {
        if (k == 0 || order_of_places(all[k].place, all[k].body, all[k - 1].place, all[k - 1].body) != 0) {
            g++;
            *g = (struct turning_group){
                .body = all[k].body, .first = k, .off = all[k].off, .held = supported[all[k].body]};
            memcpy(g->place, all[k].place, sizeof g->place);
        }
        t->member[k] = all[k].particle, g->end = k + 1;
    }
#pragma omp parallel for schedule(static)
    for (int32_t k = 0; k < t->groups; k++) groups_near(t, k);
    memory_free(all);
}

void rotation_groups_free(struct rotation_groups *t)
{
    memory_free(t->group), memory_free(t->member);
    for (int c = 0; c < 3; c++) memory_free(t->turn[c]);
    *t = (struct rotation_groups){0};
}

/* ---- sums of a group --------------------------------------------------------------------------------------------- */

/* Returns true if particle i is a material point of the grid, not a peridynamic particle or a point of the mesh. */
static bool on_grid(const struct particles *p, int32_t i)
{
    return p->kind[i] == KIND_MPM && !(p->flag[i] & FLAG_MESHED);
}

/* Loop over the members i of group g of points that are material points of the grid. all: true if all members are known
 * to be, which saves the test. */
#define FOR_POINTS(t, g, p, i, all)                                                                                    \
    for (int64_t m = (g)->first, last = (g)->end; m < last; m++)                                                       \
        for (int32_t i = (t)->member[m], once = (all) || on_grid(p, i); once; once = 0)

/* Returns true if all members of group g are material points of the grid, by the number g->points that sum_mass has
 * counted. */
static ALWAYS_INLINE bool all_on_grid(const struct turning_group *g) { return g->points == g->end - g->first; }

/* Loop over the components c of an angular velocity or momentum: in 2D z alone. */
#define FOR_SPINS(c, dim) for (int c = (dim) == 2 ? 2 : 0; c < 3; c++)

/* Sums the number, mass and first moment (mass times position) of the points of group g into g. dim: dimensions, a
 * constant. */
static ALWAYS_INLINE void sum_mass(const struct rotation_groups *t, struct turning_group *g, const struct particles *p,
                                   const int dim)
{
    real mass = 0, moment[DIM_MAX] = {0};
    int32_t points = 0;
    FOR_POINTS(t, g, p, i, false)
    {
        points++, mass += p->mass[i];
        for (int d = 0; d < dim; d++) moment[d] += p->mass[i] * p->x[d][i];
    }
    g->points = points, g->mass = mass;
    memcpy(g->moment, moment, sizeof moment);
}

/* Sums into g->sum the angular momentum that the points of group g have lost in the transfer to nodes and back
 * (t->turn). dim: dimensions, a constant. */
static ALWAYS_INLINE void sum_lack(const struct rotation_groups *t, struct turning_group *g, const struct particles *p,
                                   const int dim)
{
    real sum[3] = {0};
    const bool all = all_on_grid(g);
    FOR_POINTS(t, g, p, i, all)
    FOR_SPINS(c, dim) sum[c] += t->turn[c][i];
    memcpy(g->sum, sum, sizeof sum);
}

/* Computes the arm r[3] of point i, its position relative to the centre of mass `centre` [m]. dim: dimensions, a
 * constant. */
static ALWAYS_INLINE void arm_of(const struct particles *p, int32_t i, const real *centre, real *r, const int dim)
{
    for (int d = 0; d < DIM_MAX; d++) r[d] = d < dim ? p->x[d][i] - centre[d] : 0;
}

/* Adds the angular momentum m r x v of a point with mass m, arm r and velocity v to sum[3]. dim: dimensions, a
 * constant. */
static ALWAYS_INLINE void spin_add(real m, const real *r, const real *v, real *sum, const int dim)
{
    FOR_SPINS(c, dim)
    {
        const int a = (c + 1) % 3, b = (c + 2) % 3;
        sum[c] += m * (r[a] * v[b] - r[b] * v[a]);
    }
}

/* Sums tensor of inertia (lower half) and angular momentum of the points of group g into g, about the centre of mass of
 * its root, the group that it has joined. dim: dimensions, a constant. */
static ALWAYS_INLINE void sum_inertia(const struct rotation_groups *t, struct turning_group *g,
                                      const struct particles *p, const int dim)
{
    const struct turning_group *root = &t->group[g->root];
    const real centre[DIM_MAX] = {root->moment[0], root->moment[1], root->moment[2]};
    real inertia[3][3] = {{0}}, sum[3] = {0}, r[DIM_MAX], v[DIM_MAX] = {0};
    const bool all = all_on_grid(g);
    FOR_POINTS(t, g, p, i, all)
    {
        const real mass = p->mass[i];
        arm_of(p, i, centre, r, dim);
        for (int d = 0; d < dim; d++) v[d] = p->v[d][i];
        spin_add(mass, r, v, sum, dim);
        for (int a = 0; a < 3; a++)
            for (int b = 0; b <= a; b++) inertia[a][b] += mass * ((a == b ? dot(r, r, 3) : 0) - r[a] * r[b]);
    }
    memcpy(g->sum, sum, sizeof sum);
    memcpy(g->inertia, inertia, sizeof inertia);
}

/* Adds the rotation root->spin of the root of group g of points, the group that it has joined, to the velocities of the
 * points of group g. Sums their angular momentum about the root's centre of mass into g->sum. dim: dimensions, a
 * constant. */
static ALWAYS_INLINE void spin_apply(const struct rotation_groups *t, struct turning_group *g, struct particles *p,
                                     const int dim)
{
    const struct turning_group *root = &t->group[g->root];
    const real centre[DIM_MAX] = {root->moment[0], root->moment[1], root->moment[2]};
    const real spin[3] = {root->spin[0], root->spin[1], root->spin[2]};
    real sum[3] = {0}, r[DIM_MAX], v[DIM_MAX] = {0};
    const bool all = all_on_grid(g);
    FOR_POINTS(t, g, p, i, all)
    {
        arm_of(p, i, centre, r, dim);
        for (int d = 0; d < dim; d++)
            p->v[d][i] = v[d] = p->v[d][i] + (spin[(d + 1) % 3] * r[(d + 2) % 3] - spin[(d + 2) % 3] * r[(d + 1) % 3]);
        spin_add(p->mass[i], r, v, sum, dim);
    }
    memcpy(g->sum, sum, sizeof sum);
}

/* Stores the angular velocity of the root of group g of points, the group that it has joined, in t->turn for all points
 * of group g. dim: dimensions, a constant. */
static ALWAYS_INLINE void spins_store(struct rotation_groups *t, const struct turning_group *g,
                                      const struct particles *p, const int dim)
{
    const struct turning_group *root = &t->group[g->root];
    const real spin[3] = {root->spin[0], root->spin[1], root->spin[2]};
    const bool all = all_on_grid(g);
    FOR_POINTS(t, g, p, i, all)
    FOR_SPINS(c, dim) t->turn[c][i] = spin[c];
}

/* ---- groups ------------------------------------------------------------------------------------------------------ */

/* Returns the root of group g of points: the last one in the chain of groups that it has joined; g itself if it has
 * joined none. */
static int32_t group_root(const struct rotation_groups *t, int32_t g)
{
    while (t->group[g].root != g) g = t->group[g].root;
    return g;
}

/* Returns the number of axes along which neighbour k of a group, in the order of groups_near, is displaced. */
static int axes_of_near(int k) { return k < 6 ? 1 : k < 18 ? 2 : 3; }

/* Joins each group of fewer than TURNING_FEW points to the neighbouring group with the most points, so that both rotate
 * together; sets `root` of all groups. Among neighbours with equally many points, those displaced along fewer axes come
 * first, then those nearer to the middle of the body. */
static void few_join(struct rotation_groups *t)
{
    for (int32_t g = 0; g < t->groups; g++) t->group[g].root = g;
    for (int32_t g = 0; g < t->groups; g++) {
        const struct turning_group *own = &t->group[g];
        int32_t most = -1, best = 0, off = 0, axes = 0;
        if (own->points == 0 || own->points >= TURNING_FEW) continue;
        for (int k = 0; k < TURNING_NEAR; k++) {
            const struct turning_group *near = own->near[k] < 0 ? NULL : &t->group[own->near[k]];
            if (!near || near->points == 0 || group_root(t, own->near[k]) == g) continue;
            const bool nearer = near->points == best && axes_of_near(k) == axes && near->off < off;
            if (near->points > best || nearer)
                most = own->near[k], best = near->points, off = near->off, axes = axes_of_near(k);
        }
        if (most >= 0) t->group[group_root(t, g)].root = group_root(t, most);
    }
    for (int32_t g = 0; g < t->groups; g++) t->group[g].root = group_root(t, g);
}

/* Returns the determinant of a symmetric tensor J given by its lower half. */
static real inertia_determinant(const real J[3][3])
{
    const real d = J[1][0], e = J[2][0], f = J[2][1];
    return J[0][0] * (J[1][1] * J[2][2] - f * f) + d * (e * f - d * J[2][2]) + e * (d * f - J[1][1] * e);
}

/* Solves J w = sum for the vector w[3]. J: symmetric tensor, given by its lower half; in 2D only the components zz of J
 * and z of the vectors are used. */
static void spin_solve(const real J[3][3], const real *sum, int dim, real *w)
{
    if (dim == 2) {
        w[0] = w[1] = 0, w[2] = sum[2] / J[2][2];
        return;
    }
    const real a = J[0][0], b = J[1][1], c = J[2][2], d = J[1][0], e = J[2][0], f = J[2][1];
    const real all = inertia_determinant(J), A = b * c - f * f, B = e * f - d * c, C = d * f - b * e, D = d * e - a * f;
    w[0] = (A * sum[0] + B * sum[1] + C * sum[2]) / all;
    w[1] = (B * sum[0] + (a * c - e * e) * sum[1] + D * sum[2]) / all;
    w[2] = (C * sum[0] + D * sum[1] + (a * b - d * d) * sum[2]) / all;
}

/* Adds the angular momenta of all groups to those of their roots, the groups that they have joined, and computes the
 * angular velocity of each root from them. It is 0 for groups without mass, and in bodies that a support constrains. */
static void spins_find(struct rotation_groups *t, int dim)
{
    for (int32_t g = 0; g < t->groups; g++) {
        const struct turning_group *own = &t->group[g];
        for (int c = 0; c < 3 && own->root != g; c++) t->group[own->root].sum[c] += own->sum[c];
    }
    for (int32_t g = 0; g < t->groups; g++) {
        struct turning_group *own = &t->group[g];
        memset(own->spin, 0, sizeof own->spin);
        if (own->root == g && own->mass > 0 && !own->held) spin_solve(own->inertia, own->sum, dim, own->spin);
    }
}

/* Adds mass and first moment of all groups to those of their roots, the groups that they have joined, and divides the
 * first moments by the masses: `moment` is then the centre of mass [m]. */
static void centres_find(struct rotation_groups *t)
{
    for (int32_t g = 0; g < t->groups; g++) {
        const struct turning_group *own = &t->group[g];
        struct turning_group *root = &t->group[own->root];
        if (own == root) continue;
        root->mass += own->mass;
        for (int d = 0; d < DIM_MAX; d++) root->moment[d] += own->moment[d];
    }
    for (int32_t g = 0; g < t->groups; g++)
        for (int d = 0; d < DIM_MAX && t->group[g].mass > 0; d++) t->group[g].moment[d] /= t->group[g].mass;
}

/* Adds the inertia of all groups to that of their roots, the groups that they have joined. If an inertia nearly
 * vanishes about some axis, it is increased by that of the group's mass at a radius of LEAST_ARM spacings. spacing
 * [m]. */
static void inertias_find(struct rotation_groups *t, real spacing, int dim)
{
    for (int32_t g = 0; g < t->groups; g++) {
        const struct turning_group *own = &t->group[g];
        for (int a = 0; a < 3 && own->root != g; a++)
            for (int b = 0; b <= a; b++) t->group[own->root].inertia[a][b] += own->inertia[a][b];
    }
    for (int32_t g = 0; g < t->groups; g++) {
        real(*J)[3] = t->group[g].inertia;
        const real least = t->group[g].mass * square(LEAST_ARM * spacing), half = (J[0][0] + J[1][1] + J[2][2]) / 2;
        const bool thin = dim == 2 ? J[2][2] < least : inertia_determinant(J) < least * square(half);
        for (int a = 0; a < 3 && thin; a++) J[a][a] += least;
    }
}

/* Calls SUM(t, group, p, dim) for each group of points in t, in parallel, with the number of dimensions as a
 * constant. */
#define EACH_GROUP_OF(SUM, t, p, dim)                                                                                  \
    TEAM_LOOP((t)->groups > 16, for (int32_t g = 0; g < (t)->groups; g++) SUM(t, &(t)->group[g], p, dim);)
#define EACH_GROUP(SUM, t, p)                                                                                          \
    do {                                                                                                               \
        if ((p)->dim == 2)                                                                                             \
            EACH_GROUP_OF(SUM, t, p, 2);                                                                               \
        else                                                                                                           \
            EACH_GROUP_OF(SUM, t, p, 3);                                                                               \
    } while (0)

void rotation_groups_compute_spins(struct rotation_groups *t, struct particles *p, real spacing)
{
    EACH_GROUP(sum_mass, t, p);
    few_join(t);
    centres_find(t);
    EACH_GROUP(sum_inertia, t, p);
    inertias_find(t, spacing, p->dim);
    spins_find(t, p->dim);
    EACH_GROUP(spins_store, t, p);
}

void rotation_groups_restore_spins(struct rotation_groups *t, struct particles *p)
{
    EACH_GROUP(sum_lack, t, p);
    spins_find(t, p->dim); /* gain of spin */
    EACH_GROUP(spin_apply, t, p);
    spins_find(t, p->dim); /* spin */
    EACH_GROUP(spins_store, t, p);
}
