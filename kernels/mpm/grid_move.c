/* Updates the nodes of the background grid between the transfers from and to the material points: velocities,
 * prescribed velocities ("walls"), mirror nodes, and light nodes (with little mass). This takes one division per node
 * and little memory traffic compared with the transfers. */
#include <stdlib.h>

#include "kernels/dashpot.h"
#include "kernels/kernels.h"

/* EACH_NODE(CALL) calls CALL(I, dimensions) for all nodes I of the grid g, a variable of the caller. The number of
 * dimensions is a compile-time constant, so that nodes fill the lanes of vectors. */
#define NODES_OF(D, CALL)                                                                                              \
    case D:                                                                                                            \
        _Pragma("omp parallel for simd schedule(static)") for (int64_t I = 0; I < g->n; I++) CALL(I, D);               \
        break;
#define EACH_NODE(CALL)                                                                                                \
    switch (g->dim) {                                                                                                  \
        NODES_OF(1, CALL)                                                                                              \
        NODES_OF(2, CALL)                                                                                              \
        NODES_OF(3, CALL)                                                                                              \
    }

static ALWAYS_INLINE void node_clear(struct grid *g, int64_t I, const int dim)
{
    g->mass[I] = 0;
    for (int d = 0; d < dim; d++) g->momentum[d][I] = g->force[d][I] = 0;
}

void grid_clear(struct grid *g)
{
#define CLEAR(I, D) node_clear(g, I, D)
    EACH_NODE(CLEAR)
}

/* Sets one velocity component of a node of the grid, and its change in the step (g->force), to the values that the wall
 * w prescribes (wall: a nodal component with prescribed velocity). The impulse of the wall replaces that of the forces
 * on the node, and with APIC also the momentum that points have given to the node. Adds this impulse to impulse[axis]
 * [N s] and the work of the wall to *work [J]; stores the reaction in w [N s]. transfer: scheme of the grid (FLIP or
 * APIC). Does nothing for nodes lighter than smallest_mass [kg]. */
static void wall_move(struct grid *g, struct wall *w, enum transfer transfer, real smallest_mass, real impulse[DIM_MAX],
                      real *work)
{
    const int d = w->component;
    const int64_t I = w->node;
    w->reaction = 0;
    if (g->mass[I] < smallest_mass) return;
    /* FLIP: points receive only the change of velocity. APIC: points receive the nodal velocity itself, so the wall
     * also replaces P/m = velocity - dv. */
    const real before = transfer == TRANSFER_APIC ? g->velocity[d][I] - g->force[d][I] : w->velocity - w->change;
    const real given = g->mass[I] * (w->velocity - before - g->force[d][I]);
    w->reaction = given - g->mass[I] * w->change;
    impulse[d] += given;
    /* work over the motion of the wall itself: what APIC loses in the map to the nodes is no work of walls */
    *work += given * (w->velocity - 0.5 * w->change) * (1 + g->damped.increments);
    g->force[d][I] = w->change;
    g->velocity[d][I] = w->velocity;
}

/* ---- planes of symmetry ------------------------------------------------------------------------------------------
 *
 * A node g beyond a plane of symmetry moves as the mirror image of node I on the side of the body, v_g = s v_I with the
 * sign s of each component. With this constraint the lumped equations of both nodes are (m_I + m_g) dv_I = dt (f_I + s
 * f_g), as if the mirrored body were present, for every shape. Mirror nodes are few and several may share an image;
 * they are processed in order by one thread. */

/* Adds mass, reflected force and reflected momentum of each mirror node of g (a node beyond a plane of symmetry) to its
 * image node, and sets them to 0 at the mirror node. Stores in the member `taken` of the mirror node the impulse that
 * the points gave to it [N s]. transfer: scheme of the grid; dt_velocity: time over which forces change the velocities
 * [s]. */
static void grid_mirror_nodes_gather(struct grid *g, enum transfer transfer, real dt_velocity)
{
    for (int64_t k = 0; k < g->mirror_nodes; k++) {
        struct mirror_node *f = &g->mirror_node[k];
        const int64_t from = f->node, to = f->image;
        f->mass = g->mass[from];
        if (f->mass <= 0) continue;
        g->mass[to] += f->mass, g->mass[from] = 0;
        for (int d = 0; d < g->dim; d++) {
            f->taken[d] = dt_velocity * g->force[d][from] + (transfer == TRANSFER_APIC ? g->momentum[d][from] : 0);
            g->force[d][to] += f->sign[d] * g->force[d][from];
            g->momentum[d][to] += f->sign[d] * g->momentum[d][from];
            g->force[d][from] = g->momentum[d][from] = 0;
        }
    }
}

/* Sets velocity and change of velocity of each mirror node of g (a node beyond a plane of symmetry) to the reflected
 * ones of its image node, and adds the reaction of the plane to impulse[axis] [N s]. A component that changes sign
 * needs the impulse m_g dv_g - dt f_g at the node and an equal impulse at its image: together they do no work, since
 * node and image move in opposite directions. transfer: scheme of the grid, which decides whether the momentum from the
 * points counts, too. */
static void grid_mirror_nodes_spread(struct grid *g, enum transfer transfer, real impulse[DIM_MAX])
{
    for (int64_t k = 0; k < g->mirror_nodes; k++) {
        struct mirror_node *f = &g->mirror_node[k];
        for (int d = 0; d < g->dim; d++) {
            f->reaction[d] = 0;
            if (f->mass <= 0) continue;
            g->velocity[d][f->node] = f->sign[d] * g->velocity[d][f->image];
            g->force[d][f->node] = f->sign[d] * g->force[d][f->image];
            if (f->sign[d] > 0) continue;
            const real gained = transfer == TRANSFER_APIC ? g->velocity[d][f->node] : g->force[d][f->node];
            f->reaction[d] = 2 * (f->mass * gained - f->taken[d]);
            impulse[d] += f->reaction[d];
        }
    }
}

/* ---- light nodes -------------------------------------------------------------------------------------------------
 *
 * Where the edge of a body is close to a node, its points reach into the next cell by a share u of it and give the node
 * there a mass ~ u^2 and a force ~ u. The acceleration of that node, ~ 1/u, strains the points equally however small u
 * is, and not at all for u <= 0: a stiffness that switches on and off with the motion, from which a beam with APIC
 * gains 8 % of energy in a millisecond. The acceleration of such a light node I is therefore extrapolated from a
 * heavier neighbour J and the node K behind it,
 *     a_I = 2 a_J - a_K,   f_J += 2 f_I,   f_K -= f_I,   and for the accelerations m_J += 2 m_I,   m_K -= m_I,
 * so that the map from forces to accelerations stays symmetric and bodies can rotate. The velocity of a light node has
 * no weight in the balance and equals that of its points. Wall nodes neither lead nor follow, but nodes on planes of
 * symmetry do, which have the mass of half of their points: half of a body moves as the whole. FLIP gains no energy
 * from light nodes. Followers are few and processed in order. */

enum { HELD = 128 }; /* in g->held: a node that prescribed motion holds */

/* Returns the mass [kg] that node I has in the whole body. A grid with planes of symmetry has only the part of the body
 * on one side: the mass doubles for each plane on which the node lies, a set bit d of g->held for normal d. */
static real whole_mass(const struct grid *g, int64_t I)
{
    return g->mass[I] * (real)(1 << __builtin_popcount(g->held[I] & (HELD - 1)));
}

/* Returns the node from which the motion of the light node I of g (a node with little mass at the edge of a body) is
 * extrapolated: the heaviest adjacent node with more mass than g->light_mass, along the axes if there is one, else
 * along diagonals. Returns -1 if there is none. */
static int64_t leader_of(const struct grid *g, int64_t I)
{
    int64_t leader = -1;
    real most = g->light_mass;
    for (int apart = 1; apart <= g->dim && leader < 0; apart++)
        for (int k = 0; k < 27; k++) {
            const int step[DIM_MAX] = {k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1};
            int64_t J = I;
            int axes = 0;
            for (int d = 0; d < DIM_MAX; d++) {
                axes += step[d] != 0;
                if (d < g->dim)
                    J += step[d] * g->stride[d];
                else if (step[d] != 0)
                    axes = DIM_MAX + 1;
            }
            if (axes == apart && J >= 0 && J < g->n && whole_mass(g, J) > most) most = whole_mass(g, J), leader = J;
        }
    return leader;
}

/* Compares two light nodes a and b (struct follower) by their node index, for sorting. Returns -1, 0 or 1. */
static int by_node(const void *a, const void *b)
{
    const struct follower *p = a, *q = b;
    return (p->node > q->node) - (p->node < q->node);
}

/* Lists in g->follower the light nodes of this step, at least smallest_mass and below g->light_mass [kg], each with the
 * two heavier nodes from which its acceleration is extrapolated (struct follower). Ascending by node. Nodes held by
 * walls other than planes of symmetry, and nodes without such heavier nodes, are left out. */
static void followers_find(struct grid *g, real smallest_mass)
{
    int64_t n = 0;
#pragma omp parallel for schedule(static)
    for (int64_t I = 0; I < g->n; I++) {
        if (!(g->mass[I] >= smallest_mass && whole_mass(g, I) < g->light_mass)) continue;
        const int64_t leader = leader_of(g, I), next = 2 * leader - I;
        if (leader < 0) continue;
        const bool heavy = next >= 0 && next < g->n && whole_mass(g, next) > g->light_mass;
        const int64_t behind = heavy ? next : leader;
        int64_t at;
        if ((g->held[I] | g->held[leader] | g->held[behind]) & HELD) continue;
#pragma omp atomic capture
        at = n++;
        g->follower[at] = (struct follower){(int32_t)I, (int32_t)leader, (int32_t)behind};
    }
    g->followers = n;
    array_sort(g->follower, n, sizeof *g->follower, by_node);
}

/* Adds the force and the mass of the light node I of g, multiplied by `times`, to the heavier node J, one of two from
 * which the acceleration of I is extrapolated linearly. times: weight of J in this extrapolation, 2 for the nearer
 * node, -1 for the farther one. The momentum of J is scaled with its mass, so that its velocity does not change;
 * components normal to a plane of symmetry through J are left as they are. */
static void lend(struct grid *g, int64_t I, int64_t J, real times)
{
    const real more = times * g->mass[I] / g->mass[J];
    for (int d = 0; d < g->dim; d++) {
        g->force[d][J] += times * g->force[d][I];
        if (!(g->held[J] >> d & 1)) g->momentum[d][J] += more * g->momentum[d][J];
    }
    g->mass[J] += times * g->mass[I];
}

/* Lists the light nodes of the grid in g->follower (nodes with little mass at the edge of a body), whose acceleration
 * is extrapolated from heavier nodes, and transfers their force and mass to these. transfer: scheme of the grid; with
 * FLIP there are none. smallest_mass: nodes lighter than this are left out [kg]. Call before velocities are computed.
 */
static void followers_in(struct grid *g, enum transfer transfer, real smallest_mass)
{
    g->followers = 0;
    if (transfer != TRANSFER_APIC || g->light_mass <= 0) return;
    for (int64_t k = 0; k < g->walls; k++) {
        uint8_t *held = &g->held[g->wall[k].node];
        *held = (uint8_t)(*held | (g->wall[k].symmetric ? 1 << g->wall[k].component : HELD));
    }
    followers_find(g, smallest_mass);
    for (int64_t k = 0; k < g->followers; k++) {
        const struct follower *f = &g->follower[k];
        lend(g, f->node, f->leader, 2);
        lend(g, f->node, f->behind, -1);
        for (int d = 0; d < g->dim; d++) g->force[d][f->node] = 0;
    }
    for (int64_t k = 0; k < g->walls; k++) g->held[g->wall[k].node] = 0;
}

/* Extrapolates the change of velocity (stored in g->force at this time) of the light nodes in g->follower from two
 * heavier nodes each and adds it to the velocity of the light node. Call after velocities are computed. */
static void followers_out(struct grid *g)
{
    for (int64_t k = 0; k < g->followers; k++)
        for (int d = 0; d < g->dim; d++) {
            const struct follower *f = &g->follower[k];
            g->force[d][f->node] = 2 * g->force[d][f->leader] - g->force[d][f->behind];
            g->velocity[d][f->node] += g->force[d][f->node];
        }
}

/* Applies dashpots to the nodal velocities of the grid, after the forces have changed them, and sets g->absorbed to the
 * energy and impulse that they absorb in this step. dt_velocity: time over which forces change the velocities [s].
 * Nodes lighter than g->light_mass or smallest_mass [kg] are left out. Dashpots are few; a serial loop keeps sums
 * independent of the number of threads. */
static void grid_absorb(struct grid *g, real dt_velocity, real smallest_mass)
{
    const real least = smallest_mass > g->light_mass ? smallest_mass : g->light_mass;
    g->absorbed = (struct dashpot_effect){0};
    for (int64_t k = 0; k < g->dashpots; k++) {
        const int64_t I = g->dashpot[k].node;
        for (int d = 0; d < g->dim && g->mass[I] >= least; d++) {
            const real change = g->force[d][I], before = g->velocity[d][I] - change;
            const real given = dashpot_compute_and_add_impulse(&g->absorbed, d, dt_velocity * g->dashpot[k].rate[d],
                                                               g->mass[I], before, change);
            g->dashpot[k].impulse[d] = given;
            g->force[d][I] += given / g->mass[I];
            g->velocity[d][I] += given / g->mass[I];
        }
    }
}

/* Corrects g->absorbed, the energy absorbed by dashpots, after the velocities of the points have been mapped to the
 * nodes a second time (MUSL). With FLIP the points receive the velocities of this second map (g->momentum), not those
 * on which the dashpots acted (g->velocity). */
static void grid_absorb_again(struct grid *g)
{
    for (int64_t k = 0; k < g->dashpots; k++)
        for (int d = 0; d < g->dim; d++) {
            const struct dashpot *c = &g->dashpot[k];
            dashpot_correct_energy_for_velocity_change(&g->absorbed, c->impulse[d],
                                                       g->momentum[d][c->node] - g->velocity[d][c->node]);
        }
}

/* Computes the new velocity of node I of g from its momentum and force. The change of velocity replaces the force, and
 * the momentum becomes 0. dt_velocity: time over which forces change the velocities [s]. A node lighter than
 * smallest_mass [kg] gets velocity and change 0. */
static ALWAYS_INLINE void node_advance(struct grid *g, int64_t I, real dt_velocity, real smallest_mass, const int dim)
{
    const real inverse = g->mass[I] >= smallest_mass ? 1 / g->mass[I] : 0;
    for (int d = 0; d < dim; d++) {
        const real change = g->force[d][I] * (dt_velocity * inverse);
        g->force[d][I] = change;
        g->velocity[d][I] = g->momentum[d][I] * inverse + change;
        g->momentum[d][I] = 0;
    }
}

void grid_advance(struct grid *g, enum transfer transfer, real dt_velocity, real smallest_mass)
{
    grid_mirror_nodes_gather(g, transfer, dt_velocity);
    followers_in(g, transfer, smallest_mass);
#define ADVANCE(I, D) node_advance(g, I, dt_velocity, smallest_mass, D)
    EACH_NODE(ADVANCE)
    grid_absorb(g, dt_velocity, smallest_mass);
}

void grid_constrain(struct grid *g, enum transfer transfer, real smallest_mass, real impulse[DIM_MAX], real *work)
{
    for (int64_t k = 0; k < g->walls; k++) /* few; a serial loop keeps sums independent of the threads */
        wall_move(g, &g->wall[k], transfer, smallest_mass, impulse, work);
    followers_out(g);
    grid_mirror_nodes_spread(g, transfer, impulse);
}

/* Divides the momentum of node I by its mass, so that g->momentum becomes a velocity; it becomes 0 if the node is
 * lighter than smallest_mass [kg]. */
static ALWAYS_INLINE void node_remapped(struct grid *g, int64_t I, real smallest_mass, const int dim)
{
    const real inverse = g->mass[I] >= smallest_mass ? 1 / g->mass[I] : 0;
    for (int d = 0; d < dim; d++) g->momentum[d][I] *= inverse;
}

void grid_remapped(struct grid *g, real smallest_mass)
{
    for (int64_t k = 0; k < g->mirror_nodes; k++)
        for (int d = 0; d < g->dim; d++)
            g->momentum[d][g->mirror_node[k].image] +=
                g->mirror_node[k].sign[d] * g->momentum[d][g->mirror_node[k].node];
#define REMAPPED(I, D) node_remapped(g, I, smallest_mass, D)
    EACH_NODE(REMAPPED)
    grid_absorb_again(g);
    for (int64_t k = 0; k < g->walls; k++) g->momentum[g->wall[k].component][g->wall[k].node] = g->wall[k].velocity;
    for (int64_t k = 0; k < g->mirror_nodes; k++)
        for (int d = 0; d < g->dim; d++)
            g->momentum[d][g->mirror_node[k].node] =
                g->mirror_node[k].sign[d] * g->momentum[d][g->mirror_node[k].image];
}
