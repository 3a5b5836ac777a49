/* Sums quantities over the points of rotating groups (neighbouring points that rotate together, data/turning.h), and
 * computes the angular velocities of the groups. One thread sums over a group, in a fixed order, and groups are
 * combined in their order, so that all bits are independent of the number of threads. */
#include <string.h>

#include "base/memory.h"
#include "kernels/kernels.h"
#include "kernels/simd/lanes.h"

/* Smallest radius of inertia of a rotating group of points [spacings]. Keeps the inertia of single points and, in 3D,
 * of points on a line above 0; empirical. */
#define LEAST_ARM 0.05
/* Loops over the components c of an angular velocity: z alone in 2D (dim = 2), else x, y and z. */
#define FOR_SPINS(c, dim) for (int c = (dim) == 2 ? 2 : 0; c < 3; c++)
/* Loops over the runs of group g of t. A group consists of points that rotate together; a run is a set of up to eight
 * particles of the group with consecutive indices. run: name of the loop variable. */
#define FOR_RUNS(t, g, run)                                                                                            \
    for (const struct turning_run *run = (t)->run + (g)->first; run < (t)->run + (g)->end; run++)

/* ---- points of a group ------------------------------------------------------------------------------------------- */

/* Returns a mask with bit l set if point l of `run` is on the grid: neither peridynamic nor a point of the mesh. run:
 * up to eight consecutive particles of one group of points that rotate together; all: true if all particles are on the
 * grid. p: all particles. */
static ALWAYS_INLINE uint8_t run_on_grid(const struct particles *p, const struct turning_run *run, bool all)
{
    uint8_t bits = (uint8_t)((1u << run->n) - 1);
    for (int l = 0; l < LANES && !all; l++)
        if (p->kind[run->first + l] != KIND_MPM || p->flag[run->first + l] & FLAG_MESHED) bits &= (uint8_t) ~(1u << l);
    return bits;
}

/* Returns the sum of the eight entries of the vector a, in a fixed order. */
static ALWAYS_INLINE real run_total(lanes a)
{
    return ((a[0] + a[4]) + (a[2] + a[6])) + ((a[1] + a[5]) + (a[3] + a[7]));
}

/* Adds the angular momenta m r x v of eight points to sum[component]. moment: m r [kg m]; v: velocities [m/s]. */
static ALWAYS_INLINE void spin_add(const lanes *moment, const lanes *v, lanes *sum, const int dim)
{
    FOR_SPINS(c, dim)
    sum[c] += moment[(c + 1) % 3] * v[(c + 2) % 3] - moment[(c + 2) % 3] * v[(c + 1) % 3];
}

/* Stores in *g the sums over the points of p in group g: mass, first and second moments, momentum and angular
 * momentum. A group consists of neighbouring material points that rotate together; groups: all groups. Moments are
 * about g->about, the position of one of the points of g. */
static ALWAYS_INLINE void sum_moments(const struct corotating_groups *groups, struct turning_group *g,
                                      const struct particles *p, const int dim)
{
    const lanes none = lanes_broadcast(0);
    const int64_t start = groups->run[g->first].first;
    const bool all = p->n_free == p->n;
    lanes mass = none, first[DIM_MAX] = {none, none, none}, spin[3] = {none, none, none};
    lanes second[DIM_MAX][DIM_MAX], momentum[DIM_MAX] = {none, none, none};
    for (int a = 0; a < dim; a++)
        for (int b = 0; b <= a; b++) second[a][b] = none;
    g->points = 0;
    FOR_RUNS(groups, g, run)
    {
        const uint8_t bits = run_on_grid(p, run, all);
        const lanes m = lanes_zero_unless_selected(bits, lanes_load(p->mass + run->first));
        lanes r[DIM_MAX], v[DIM_MAX], moment[DIM_MAX];
        g->points += __builtin_popcount(bits);
        mass += m;
        for (int d = 0; d < dim; d++) {
            r[d] = lanes_load(p->x[d] + run->first) - p->x[d][start], v[d] = lanes_load(p->v[d] + run->first);
            moment[d] = m * r[d], first[d] += moment[d], momentum[d] += m * v[d];
        }
        for (int a = 0; a < dim; a++)
            for (int b = 0; b <= a; b++) second[a][b] += moment[a] * r[b];
        spin_add(moment, v, spin, dim);
    }
    g->mass = run_total(mass);
    for (int d = 0; d < dim; d++) {
        g->about[d] = p->x[d][start], g->first_moment[d] = run_total(first[d]), g->momentum[d] = run_total(momentum[d]);
        for (int b = 0; b <= d; b++) g->second_moment[d][b] = run_total(second[d][b]);
    }
    FOR_SPINS(c, dim) g->sum[c] = run_total(spin[c]);
}

/* Stores in g->sum the angular momentum that the points of group g (neighbouring points that rotate together) have
 * lost in the transfer to nodes and back [kg m^2/s], the sum of groups->turn. Stores in g->angular their angular
 * momentum about the centre of mass of the root of g. The root of a group is the group that it has joined, or the group
 * itself. p: all particles. */
static ALWAYS_INLINE void sum_lack(const struct corotating_groups *groups, struct turning_group *g,
                                   const struct particles *p, const int dim)
{
    const lanes none = lanes_broadcast(0);
    const real *centre = groups->group[g->root].moment;
    const bool all = p->n_free == p->n;
    lanes lack[3] = {none, none, none}, spin[3] = {none, none, none};
    FOR_RUNS(groups, g, run)
    {
        const uint8_t bits = run_on_grid(p, run, all);
        const lanes m = lanes_zero_unless_selected(bits, lanes_load(p->mass + run->first));
        lanes v[DIM_MAX], moment[DIM_MAX];
        for (int d = 0; d < dim; d++) {
            moment[d] = m * (lanes_load(p->x[d] + run->first) - centre[d]);
            v[d] = lanes_load(p->v[d] + run->first);
        }
        spin_add(moment, v, spin, dim);
        FOR_SPINS(c, dim) lack[c] += lanes_zero_unless_selected(bits, lanes_load(groups->turn[c] + run->first));
    }
    FOR_SPINS(c, dim) g->sum[c] = run_total(lack[c]), g->angular[c] = run_total(spin[c]);
}

/* Stores in groups->turn, for all points of group g (neighbouring points that rotate together), the angular velocity
 * with which the points rotate [1/s]: that of the group that g has joined, or of g itself if it has joined none. p: all
 * particles. */
static ALWAYS_INLINE void spins_store(struct corotating_groups *groups, const struct turning_group *g,
                                      const struct particles *p, const int dim)
{
    const real *spin = groups->group[g->root].spin;
    const bool all = p->n_free == p->n;
    FOR_RUNS(groups, g, run)
    {
        const uint8_t bits = run_on_grid(p, run, all);
        FOR_SPINS(c, dim) lanes_store_selected(bits, groups->turn[c] + run->first, lanes_broadcast(spin[c]));
    }
}

/* Adds a rotation to the velocities in p of the points of group g (neighbouring points that rotate together): that by
 * the gain of angular velocity of the root of g, which restores lost angular momentum. Stores the angular velocity of
 * the root in groups->turn for these points [1/s]. The root is the group that g has joined, or g itself; groups: all
 * groups. */
static ALWAYS_INLINE void spin_apply(const struct corotating_groups *groups, struct turning_group *g,
                                     struct particles *p, const int dim)
{
    const struct turning_group *root = &groups->group[g->root];
    const bool all = p->n_free == p->n;
    FOR_RUNS(groups, g, run)
    {
        const uint8_t bits = run_on_grid(p, run, all);
        lanes r[DIM_MAX] = {lanes_broadcast(0), lanes_broadcast(0), lanes_broadcast(0)};
        for (int d = 0; d < dim; d++) r[d] = lanes_load(p->x[d] + run->first) - root->moment[d];
        for (int d = 0; d < dim; d++) {
            const int a = (d + 1) % 3, b = (d + 2) % 3;
            real *v = p->v[d] + run->first;
            lanes_store_selected(bits, v, lanes_load(v) + (root->gain[a] * r[b] - root->gain[b] * r[a]));
        }
        FOR_SPINS(c, dim) lanes_store_selected(bits, groups->turn[c] + run->first, lanes_broadcast(root->spin[c]));
    }
}

/* ---- groups ------------------------------------------------------------------------------------------------------ */

/* Returns the root of group g of groups: the last group in the chain of groups that it has joined, or g itself if it
 * has joined none. A group consists of points that rotate together. */
static int32_t group_root(const struct corotating_groups *groups, int32_t g)
{
    while (groups->group[g].root != g) g = groups->group[g].root;
    return g;
}

/* Returns the number of axes, 1 to 3, along which neighbour k (0 to TURNING_NEAR - 1) of a group of points is offset
 * from the group. The list of neighbours has first those across a face, then those across an edge, then those across a
 * corner. */
static int axes_of_near(int k) { return k < 6 ? 1 : k < 18 ? 2 : 3; }

/* Joins each group of `groups` (points that rotate together) of fewer than TURNING_FEW points to the neighbouring group
 * with the most points, so that both rotate together. Among neighbours with equally many points, those across a face
 * precede those across an edge or a corner; among these, the one nearest to the middle of the body is chosen. */
static void few_join(struct corotating_groups *groups)
{
    for (int32_t g = 0; g < groups->groups; g++) groups->group[g].root = g;
    for (int32_t g = 0; g < groups->groups; g++) {
        const struct turning_group *own = &groups->group[g];
        int32_t most = -1, best = 0, off = 0, axes = 0;
        if (own->points == 0 || own->points >= TURNING_FEW) continue;
        for (int k = 0; k < TURNING_NEAR; k++) {
            const struct turning_group *near = own->near[k] < 0 ? NULL : &groups->group[own->near[k]];
            if (!near || near->points == 0 || group_root(groups, own->near[k]) == g) continue;
            const bool nearer = near->points == best && axes_of_near(k) == axes && near->off < off;
            if (near->points > best || nearer)
                most = own->near[k], best = near->points, off = near->off, axes = axes_of_near(k);
        }
        if (most >= 0) groups->group[group_root(groups, g)].root = group_root(groups, most);
    }
    for (int32_t g = 0; g < groups->groups; g++) groups->group[g].root = group_root(groups, g);
}

/* Returns the determinant of the symmetric tensor J. Only the lower half of J is read. */
static real inertia_determinant(const real J[3][3])
{
    const real d = J[1][0], e = J[2][0], f = J[2][1];
    return J[0][0] * (J[1][1] * J[2][2] - f * f) + d * (e * f - d * J[2][2]) + e * (d * f - J[1][1] * e);
}

/* Solves J w = sum for the angular velocity w[3] [1/s]. J: symmetric inertia tensor, of which only the lower half is
 * read; sum: angular momentum [kg m^2/s]. In 2D (dim = 2) only the component z is solved for; the others become 0. */
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

/* Adds the angular momentum g->sum of each group of `groups` to that of its root, the group that it has joined (points
 * of a group rotate together). */
static void sums_join(struct corotating_groups *groups)
{
    for (int32_t g = 0; g < groups->groups; g++) {
        const struct turning_group *own = &groups->group[g];
        for (int c = 0; c < 3 && own->root != g; c++) groups->group[own->root].sum[c] += own->sum[c];
    }
}

/* Returns true if the points of group g of `groups` rotate with an angular velocity of this group: g has mass, has not
 * joined another group, and no support constrains its body. */
static bool group_turns(const struct corotating_groups *groups, int32_t g)
{
    return groups->group[g].root == g && groups->group[g].joined > 0 && !groups->group[g].held;
}

/* Computes the angular velocity of each root of `groups` (a group of points that has joined no other group) from the
 * angular momentum g->sum of all groups that have joined it. It is 0 for a root without mass and in bodies that a
 * support constrains. */
static void spins_find(struct corotating_groups *groups, int dim)
{
    sums_join(groups);
    for (int32_t g = 0; g < groups->groups; g++) {
        struct turning_group *own = &groups->group[g];
        memset(own->spin, 0, sizeof own->spin);
        if (group_turns(groups, g)) spin_solve(own->inertia, own->sum, dim, own->spin);
    }
}

/* Computes for each root of `groups` (a group of points that has joined no other group) the gain of angular velocity
 * that restores the lost angular momentum g->sum of its points: J gain = g->sum, with the inertia J = g->inertia. Then
 * computes the angular velocity with this gain, g->spin: J spin = g->angular + (J - g->added) gain. g->added is the
 * part of J that was added to a thin group to keep J regular. */
static void gains_find(struct corotating_groups *groups, int dim)
{
    spins_find(groups, dim);
    for (int32_t g = 0; g < groups->groups; g++) {
        struct turning_group *own = &groups->group[g];
        memcpy(own->gain, own->spin, sizeof own->gain);
        for (int c = 0; c < 3; c++) own->sum[c] = own->angular[c];
    }
    sums_join(groups);
    for (int32_t g = 0; g < groups->groups; g++) {
        struct turning_group *own = &groups->group[g];
        if (!group_turns(groups, g)) continue;
        for (int c = 0; c < 3; c++) own->sum[c] -= own->added * own->gain[c];
        spin_solve(own->inertia, own->sum, dim, own->spin);
        for (int c = 0; c < 3; c++) own->spin[c] += own->gain[c];
    }
}

/* Computes mass (`joined`) and centre of mass (`moment`) of each root of `groups`, a group of points that has joined no
 * other group, from masses and first moments of all groups that have joined it. */
static void centres_find(struct corotating_groups *groups)
{
    for (int32_t g = 0; g < groups->groups; g++) {
        struct turning_group *own = &groups->group[g];
        own->joined = own->mass;
        for (int d = 0; d < DIM_MAX; d++) own->moment[d] = own->mass * own->about[d] + own->first_moment[d];
    }
    for (int32_t g = 0; g < groups->groups; g++) {
        const struct turning_group *own = &groups->group[g];
        struct turning_group *root = &groups->group[own->root];
        if (own == root) continue;
        root->joined += own->mass;
        for (int d = 0; d < DIM_MAX; d++) root->moment[d] += own->mass * own->about[d] + own->first_moment[d];
    }
    for (int32_t g = 0; g < groups->groups; g++)
        for (int d = 0; d < DIM_MAX && groups->group[g].joined > 0; d++)
            groups->group[g].moment[d] /= groups->group[g].joined;
}

/* Converts the angular momentum g->sum and the second moments of each group of `groups` (points that rotate together)
 * from the position g->about to the centre of mass of its root, the group that it has joined. Also computes the inertia
 * g->inertia about this centre. */
static void moments_shift(struct corotating_groups *groups)
{
    for (int32_t k = 0; k < groups->groups; k++) {
        struct turning_group *g = &groups->group[k];
        real arm[DIM_MAX], S[DIM_MAX][DIM_MAX];
        for (int d = 0; d < DIM_MAX; d++) arm[d] = g->about[d] - groups->group[g->root].moment[d];
        for (int c = 0; c < 3; c++) {
            const int a = (c + 1) % 3, b = (c + 2) % 3;
            g->sum[c] += arm[a] * g->momentum[b] - arm[b] * g->momentum[a];
        }
        for (int a = 0; a < 3; a++)
            for (int b = 0; b <= a; b++)
                S[a][b] = g->second_moment[a][b] + arm[a] * g->first_moment[b] + g->first_moment[a] * arm[b] +
                          g->mass * arm[a] * arm[b];
        for (int a = 0; a < 3; a++)
            for (int b = 0; b <= a; b++) g->inertia[a][b] = (a == b ? S[0][0] + S[1][1] + S[2][2] : 0) - S[a][b];
    }
}

/* Adds the inertia of each group of `groups` (points that rotate together) to that of its root, the group that it has
 * joined. If the inertia of a root about some axis is less than about that of its mass at a radius of LEAST_ARM
 * spacings, adds this inertia about all axes (g->added). spacing: distance of the particles [m]. */
static void inertias_find(struct corotating_groups *groups, real spacing, int dim)
{
    for (int32_t g = 0; g < groups->groups; g++) {
        const struct turning_group *own = &groups->group[g];
        for (int a = 0; a < 3 && own->root != g; a++)
            for (int b = 0; b <= a; b++) groups->group[own->root].inertia[a][b] += own->inertia[a][b];
    }
    for (int32_t g = 0; g < groups->groups; g++) {
        real(*J)[3] = groups->group[g].inertia;
        const real least = groups->group[g].joined * square(LEAST_ARM * spacing),
                   half = (J[0][0] + J[1][1] + J[2][2]) / 2;
        const bool thin = dim == 2 ? J[2][2] < least : inertia_determinant(J) < least * square(half);
        groups->group[g].added = thin ? least : 0;
        for (int a = 0; a < 3; a++) J[a][a] += groups->group[g].added;
    }
}

/* EACH_GROUP(SUM, t, p) calls the function SUM(t, group, p, dim) for each group of t (points that rotate together), in
 * parallel, with the number of dimensions as a constant. */
#define EACH_GROUP_OF(SUM, t, p, dim)                                                                                  \
    TEAM_LOOP((t)->groups > 16, for (int32_t g = 0; g < (t)->groups; g++) SUM(t, &(t)->group[g], p, dim);)
#define EACH_GROUP(SUM, t, p)                                                                                          \
    do {                                                                                                               \
        if ((p)->dim == 2)                                                                                             \
            EACH_GROUP_OF(SUM, t, p, 2);                                                                               \
        else                                                                                                           \
            EACH_GROUP_OF(SUM, t, p, 3);                                                                               \
    } while (0)

void corotating_groups_compute_spins(struct corotating_groups *groups, struct particles *p, real spacing)
{
    EACH_GROUP(sum_moments, groups, p);
    few_join(groups);
    centres_find(groups);
    moments_shift(groups);
    inertias_find(groups, spacing, p->dim);
    spins_find(groups, p->dim);
    EACH_GROUP(spins_store, groups, p);
}

void corotating_groups_restore_angular_momentum(struct corotating_groups *groups, struct particles *p)
{
    EACH_GROUP(sum_lack, groups, p);
    gains_find(groups, p->dim);
    EACH_GROUP(spin_apply, groups, p);
}
