/* Contact of bodies with grids of their own (Bardenhagen, Brackbill & Sulsky 2000). At nodes that points of
 * two bodies a and b reach, prevents the approach of both bodies and limits their sliding by friction. The
 * normal n at a node, from a to b, is the direction of the difference of the gradients of both nodal masses
 * (tangential parts cancel for bodies in contact). The gap g is computed from the coordinates x of the points
 * whose shape functions reach the node, since nodal masses overlap as soon as bodies share a cell (D:
 * spacing):
 *     g = min over b of x . n - max over a of x . n - D
 * If g <= 0 and (v_a - v_b) . n > 0, with nodal masses m and velocities v, the impulse
 *     J_n = m_a m_b/(m_a + m_b) (v_a - v_b) . n,   |J_t| <= friction J_n
 * acts on b, and its negative on a: momentum is conserved to round-off and energy is only dissipated. In
 * FLIP, the velocities of the second map of momentum to nodes, from which strains follow, do not include
 * contact: with it, colliding discs gained 9 % of energy. Few nodes are in contact, so that the loops are
 * serial. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "grid/contact_grid.h"

#define AROUND 2 /* range over which normals are smoothed [cells] */

/* Tolerance of contact [1], above the round-off of positions. Two bodies touch if their gap is at most TOUCHING
 * particle spacings; a point reaches a node if its shape function overlaps the node by more than TOUCHING cells. With a
 * tolerance of 0, the last digit would decide whether bodies that touch exactly at the start are in contact (3.8 % of
 * the momentum of a rebound). */
#define TOUCHING 1e-6

/* ---- nodes shared by two bodies ---------------------------------------------------------------------------------- */

/* Box of grid nodes that points of two bodies, each with a grid of its own, may reach. Along axis d it has count[d]
 * nodes from index first[d] on, counted from the common anchor node of both grids; n: number of all nodes. A local
 * variable while contact nodes are searched. */
struct shared {
    int64_t first[DIM_MAX], count[DIM_MAX], n;
};

/* Computes the box *s of nodes that points of both bodies a and b may reach. Returns false if it is empty: the bodies
 * are then apart. */
static bool shared_find(struct shared *s, const struct grid_contact_side *a, const struct grid_contact_side *b)
{
    s->n = 1;
    for (int d = 0; d < DIM_MAX; d++) {
        const bool used = d < a->grid->dim;
        const int64_t first = used ? (a->from[d] > b->from[d] ? a->from[d] : b->from[d]) : 0;
        const int64_t end = used ? (a->to[d] < b->to[d] ? a->to[d] : b->to[d]) : 0;
        s->first[d] = first, s->count[d] = end - first + 1;
        if (s->count[d] < 1) return false;
        s->n *= s->count[d];
    }
    return true;
}

/* Returns the index in grid g of node number k of the box s, which contains the nodes that points of both bodies may
 * reach. */
static int64_t shared_node(const struct shared *s, const struct grid *g, int64_t k)
{
    int64_t I = 0;
    for (int d = 0; d < g->dim; d++) {
        I += (s->first[d] + k % s->count[d] - g->first[d]) * g->stride[d];
        k /= s->count[d];
    }
    return I;
}

/* Returns the difference of the masses of the two neighbours of node I of grid g along axis d, upper minus lower
 * [kg]. */
static real slope_of(const struct grid *g, int64_t I, int d)
{
    return g->mass[I + g->stride[d]] - g->mass[I - g->stride[d]];
}

/* Computes node->mass_slope at a node in contact: the gradient of the nodal mass of body b (grid b) less that of body
 * a, times two node distances [kg]. */
static void mass_slope_find(struct grid_contact_node *node, const struct grid *a, const struct grid *b)
{
    for (int d = 0; d < a->dim; d++) node->mass_slope[d] = slope_of(b, node->at[1], d) - slope_of(a, node->at[0], d);
}

/* Appends a node without contact data to the list of contact nodes of c. Returns a pointer to the new node, which is
 * valid until the next call. */
static struct grid_contact_node *node_add(struct grid_contact *c)
{
    GROW("contact.nodes", c->node, c->nodes + 1);
    struct grid_contact_node *node = &c->node[c->nodes++];
    *node = (struct grid_contact_node){.reach = {-INFINITY, INFINITY}};
    return node;
}

/* Appends to the list of contact nodes of c those nodes at which both bodies have more mass than c->smallest_mass and
 * grid.light_mass. (Below light_mass, APIC extrapolates the acceleration of a node from heavier neighbours.) s: box of
 * the nodes that points of both bodies may reach; a, b: indices of the bodies in side[]; slot[s->n]: receives the
 * position in the list of each node of the box, -1: not listed. */
static void shared_nodes_find(struct grid_contact *c, const struct shared *s, const struct grid_contact_side *side,
                              int a, int b, int32_t *slot)
{
    const struct grid *g = side[a].grid, *h = side[b].grid;
    const real least = real_max(c->smallest_mass, g->light_mass);
    for (int64_t k = 0; k < s->n; k++) {
        const int64_t I = shared_node(s, g, k), J = shared_node(s, h, k);
        slot[k] = -1;
        if (!(g->mass[I] > least && h->mass[J] > least)) continue;
        struct grid_contact_node *node = node_add(c);
        node->side[0] = a, node->side[1] = b, node->at[0] = I, node->at[1] = J;
        mass_slope_find(node, g, h);
        slot[k] = (int32_t)(c->nodes - 1);
    }
}

/* Computes the unit normal of each contact node of c from the mass gradients of both bodies, summed over nodes up to
 * AROUND cells away. Gradients at a single node follow the lattices of both bodies and are up to 10 degrees off on
 * curved faces. s: box of the nodes that points of both bodies may reach; dim: number of components; slot[s->n]:
 * position in the list of each node of the box, -1: not listed. */
static void normals_find(struct grid_contact *c, const struct shared *s, int dim, const int32_t *slot)
{
    for (int64_t k = 0; k < s->n; k++) {
        const int64_t x = k % s->count[0], y = k / s->count[0] % s->count[1], z = k / s->count[0] / s->count[1];
        real sum[DIM_MAX] = {0}, size2 = 0;
        if (slot[k] < 0) continue;
        for (int64_t w = z - AROUND; w <= z + AROUND; w++)
            for (int64_t v = y - AROUND; v <= y + AROUND; v++)
                for (int64_t u = x - AROUND; u <= x + AROUND; u++) {
                    if (u < 0 || v < 0 || w < 0 || u >= s->count[0] || v >= s->count[1] || w >= s->count[2]) continue;
                    const int32_t at = slot[(w * s->count[1] + v) * s->count[0] + u];
                    for (int d = 0; d < dim && at >= 0; d++) sum[d] += c->node[at].mass_slope[d];
                }
        struct grid_contact_node *node = &c->node[slot[k]];
        for (int d = 0; d < dim; d++) size2 += square(sum[d]);
        for (int d = 0; d < dim; d++) node->normal[d] = size2 > 0 ? sum[d] / sqrt(size2) : 0;
    }
}

/* ---- gaps -------------------------------------------------------------------------------------------------------- */

/* Updates the gap at contact nodes of c by material point i of p, at each listed node that the shape function of the
 * point reaches. If the point belongs to the first body (side 0), raises node->reach[0] to the coordinate of the point
 * along the normal of the node; if to the second (side 1), lowers node->reach[1] to it. g: grid of the body; s: box of
 * the nodes that points of both bodies may reach; slot[s->n]: position in the list of each node of the box, -1: not
 * listed. */
static void point_reach(struct grid_contact *c, const struct shared *s, const struct grid *g, const struct particles *p,
                        int32_t i, int side, const int32_t *slot)
{
    int64_t low[DIM_MAX] = {0}, high[DIM_MAX] = {0}, k[DIM_MAX];
    for (int d = 0; d < g->dim; d++) {
        const real at = grid_coordinate_in_cell_lengths(g, d, p->x[d][i]), reach = 1 + c->half_width / g->h - TOUCHING;
        low[d] = (int64_t)ceil(at - reach) - s->first[d], high[d] = (int64_t)floor(at + reach) - s->first[d];
        if (low[d] < 0) low[d] = 0;
        if (high[d] >= s->count[d]) high[d] = s->count[d] - 1;
    }
    for (k[2] = low[2]; k[2] <= high[2]; k[2]++)
        for (k[1] = low[1]; k[1] <= high[1]; k[1]++)
            for (k[0] = low[0]; k[0] <= high[0]; k[0]++) {
                const int32_t at = slot[(k[2] * s->count[1] + k[1]) * s->count[0] + k[0]];
                if (at < 0) continue;
                struct grid_contact_node *node = &c->node[at];
                real along = 0;
                for (int d = 0; d < g->dim; d++) along += p->x[d][i] * node->normal[d];
                node->reach[side] = side == 0 ? real_max(node->reach[0], along) : real_min(node->reach[1], along);
            }
}

/* Updates the gaps at contact nodes of c by all points (of p) of body a, one of the two bodies of a pair.
 * node->reach[side] becomes the coordinate along the normal of the node up to which the points of the body extend: the
 * largest one for the first body (side 0), the smallest one for the second (side 1). s: box of the nodes that points of
 * both bodies may reach; slot[s->n]: position in the list of each node of the box, -1: not listed. */
static void points_reach(struct grid_contact *c, const struct shared *s, const struct grid_contact_side *a,
                         const struct particles *p, int side, const int32_t *slot)
{
    const struct transfer_order *o = a->order;
    for (int32_t cell = 0; cell < o->cells; cell++) {
        const int32_t first = o->particle[o->cell_start[cell]];
        bool near = true;
        for (int d = 0; d < a->grid->dim && near; d++) {
            const int64_t at = grid_cell_index_at(a->grid, d, p->x[d][first]) - s->first[d];
            near = at >= -2 && at <= s->count[d] + 1;
        }
        for (int32_t k = o->cell_start[cell]; near && k < o->cell_start[cell + 1]; k++)
            point_reach(c, s, a->grid, p, o->particle[k], side, slot);
    }
}

/* ---- the list of a step ------------------------------------------------------------------------------------------ */

/* Allocates in c the sums of the energy dissipated by contact [J], one for each pair of the `body_count` bodies, all 0.
 * Release with grid_contact_free. */
void grid_contact_make(struct grid_contact *c, int body_count)
{
    memory_free(c->dissipated);
    c->sides = body_count;
    c->dissipated = NEW("contact.taken", body_count * body_count, real);
}

void grid_contact_side_make_for_body(struct grid_contact_side *side, struct grid *g, const struct transfer_order *order,
                                     const struct particles *p)
{
    *side = (struct grid_contact_side){.grid = g, .order = order};
    for (int d = 0; d < DIM_MAX; d++) side->from[d] = INT32_MAX, side->to[d] = INT32_MIN; /* empty range */
    for (int32_t cell = 0; cell < order->cells; cell++)
        for (int d = 0; d < g->dim; d++) {
            const int64_t k = grid_cell_index_at(g, d, p->x[d][order->particle[order->cell_start[cell]]]);
            if (k - 1 < side->from[d]) side->from[d] = k - 1;
            if (k + 2 > side->to[d]) side->to[d] = k + 2;
        }
}

void grid_contact_find_shared_nodes(struct grid_contact *c, const struct grid_contact_side *side,
                                    const struct particles *p)
{
    c->nodes = 0;
    for (int a = 0; a < c->sides; a++)
        for (int b = a + 1; b < c->sides; b++) {
            struct shared s;
            const int64_t before = c->nodes;
            if (!shared_find(&s, &side[a], &side[b])) continue;
            int32_t *slot = BARE("contact.slot", s.n, int32_t);
            shared_nodes_find(c, &s, side, a, b, slot);
            if (c->nodes > before) {
                normals_find(c, &s, side[a].grid->dim, slot);
                points_reach(c, &s, &side[a], p, 0, slot);
                points_reach(c, &s, &side[b], p, 1, slot);
            }
            memory_free(slot);
        }
}

/* ---- exchange ---------------------------------------------------------------------------------------------------- */

/* Speed with which two bodies may still approach after a contact impulse, divided by their speed of separation before
 * the step [1]. Applies to bodies that separated before the step and approach after its forces. An impulse that stops
 * their approach would add energy in FLIP, where points receive less of it than nodes. The value is empirical:
 * colliding discs and blocks lose energy with it. Once contact of two bodies has added energy nevertheless, impulses
 * act only on nodes that approach before the step, too. */
#define PARTING_SHARE 1.6

/* Returns how much of the relative velocity of two bodies along the unit vector along[dim] a contact impulse removes
 * [m/s]: their speed of approach after the forces of the step, now . along. If they separated before the step, this is
 * reduced by PARTING_SHARE times the speed of separation, to at least 0. before, now: relative velocity before and
 * after the forces of the step [m/s]. strict: true to return 0 for bodies that separated before the step. */
static real speed_taken(const real *before, const real *now, const real *along, bool strict, int dim)
{
    const real parting = dot(before, along, dim);
    if (strict && parting < 0) return 0;
    return real_max(0, dot(now, along, dim) + PARTING_SHARE * real_min(0, parting));
}

/* Computes taken[dim] [m/s], the contact impulse at node `node` of c divided by the reduced mass m_a m_b/(m_a + m_b) of
 * both bodies. The impulse stops the approach of the bodies and, up to the friction coefficient c->friction, their
 * sliding. before, now: relative velocity v_a - v_b before and after the forces of the step [m/s]; dim: number of
 * components. Returns false, with `taken` unset, if the bodies separate or do not touch. */
static bool exchange_of(const struct grid_contact *c, const struct grid_contact_node *node, const real *before,
                        const real *now, int dim, real *taken)
{
    real slide[DIM_MAX] = {0}, speed = 0;
    if (node->reach[1] - node->reach[0] > (1 + TOUCHING) * c->spacing) return false;
    const bool strict = c->dissipated[node->side[0] * c->sides + node->side[1]] < 0;
    const real approach = speed_taken(before, now, node->normal, strict, dim), along = dot(now, node->normal, dim);
    if (!(approach > 0)) return false;
    for (int d = 0; d < dim; d++) {
        slide[d] = now[d] - along * node->normal[d];
        speed += square(slide[d]);
    }
    speed = sqrt(speed);
    for (int d = 0; d < dim && speed > 0; d++) slide[d] /= speed;
    const real rubbed = speed > 0 ? real_min(c->friction * approach, speed_taken(before, now, slide, strict, dim)) : 0;
    for (int d = 0; d < dim; d++) taken[d] = approach * node->normal[d] + rubbed * slide[d];
    return true;
}

/* Sets grid.held[I] of the grid of each body to `mark` for all nodes I with a prescribed velocity (a wall).
 * side[sides]: the bodies, each with its grid; mark: 1 to mark the nodes, 0 to remove the marks. */
static void walls_mark(const struct grid_contact_side *side, int sides, uint8_t mark)
{
    for (int k = 0; k < sides; k++)
        for (int64_t q = 0; q < side[k].grid->walls; q++) side[k].grid->held[side[k].grid->wall[q].node] = mark;
}

/* Returns the mass with which node I of grid g takes part in a contact with the unit normal `normal` [kg]; INFINITY if
 * walls prescribe its velocity mainly along the normal. before[dim], now[dim]: velocities of the node before and after
 * the forces of the step [m/s]; in both, prescribed components are replaced by the velocities of the walls. */
static real mass_against(const struct grid *g, int64_t I, const real *normal, real *before, real *now)
{
    real held2 = 0;
    for (int64_t q = 0; q < g->walls && g->held[I]; q++) {
        const struct wall *w = &g->wall[q];
        if (w->node != I) continue;
        now[w->component] = w->velocity, before[w->component] = w->velocity - w->change;
        held2 += square(normal[w->component]);
    }
    return held2 > 0.5 ? INFINITY : g->mass[I];
}

real grid_contact_apply_impulses_return_dissipation(struct grid_contact *c, const struct grid_contact_side *side)
{
    real lost = 0;
    c->touching = 0, c->begun = 0;
    walls_mark(side, c->sides, 1);
    for (int64_t k = 0; k < c->nodes; k++) {
        struct grid_contact_node *node = &c->node[k];
        struct grid *g[2] = {side[node->side[0]].grid, side[node->side[1]].grid};
        const int dim = g[0]->dim;
        real was[2][DIM_MAX], now[2][DIM_MAX], mass[2], before[DIM_MAX], relative[DIM_MAX], taken[DIM_MAX];
        for (int s = 0; s < 2; s++) {
            const int64_t I = node->at[s];
            for (int d = 0; d < dim; d++) now[s][d] = g[s]->velocity[d][I], was[s][d] = now[s][d] - g[s]->force[d][I];
            mass[s] = mass_against(g[s], I, node->normal, was[s], now[s]);
        }
        const real reduced = 1 / (1 / mass[0] + 1 / mass[1]);
        for (int d = 0; d < dim; d++) before[d] = was[0][d] - was[1][d], relative[d] = now[0][d] - now[1][d];
        if (!isfinite(reduced)) continue;
        if (!exchange_of(c, node, before, relative, dim, taken)) continue;
        c->touching++;
        for (int d = 0; d < dim; d++) {
            node->impulse[d] = reduced * taken[d];
            const real own = 0.5 * node->impulse[d] * (before[d] + relative[d] - taken[d]);
            lost += own, c->dissipated[node->side[0] * c->sides + node->side[1]] += own;
            c->begun += 0.5 * node->impulse[d] * before[d];
            node->after[d] = relative[d] - taken[d];
            for (int s = 0; s < 2; s++) {
                const real change = (s == 0 ? -1 : 1) * node->impulse[d] / g[s]->mass[node->at[s]];
                g[s]->velocity[d][node->at[s]] += change, g[s]->force[d][node->at[s]] += change;
            }
        }
    }
    walls_mark(side, c->sides, 0);
    c->nodes_most = c->touching > c->nodes_most ? c->touching : c->nodes_most;
    return lost;
}

real grid_contact_add_second_mapping_dissipation(struct grid_contact *c, const struct grid_contact_side *side)
{
    real lost = 0;
    for (int64_t k = 0; k < c->nodes; k++) {
        const struct grid_contact_node *node = &c->node[k];
        const struct grid *g[2] = {side[node->side[0]].grid, side[node->side[1]].grid};
        for (int d = 0; d < g[0]->dim; d++) {
            const real mapped = g[0]->momentum[d][node->at[0]] - g[1]->momentum[d][node->at[1]];
            const real own = 0.5 * node->impulse[d] * (mapped - node->after[d]);
            lost += own, c->dissipated[node->side[0] * c->sides + node->side[1]] += own;
        }
    }
    return lost;
}

void grid_contact_record_first_and_last_contact_time(struct grid_contact *c, real t)
{
    if (c->touching == 0) return;
    c->ended = t;
    if (isnan(c->began)) c->began = t;
}

status grid_contact_save_or_load(struct grid_contact *c, struct archive *a)
{
    ARCHIVE_VALUE(a, "contact/grid_began", c->began);
    ARCHIVE_VALUE(a, "contact/grid_ended", c->ended);
    ARCHIVE_VALUE(a, "contact/grid_most", c->nodes_most);
    return a->exchange(a, "contact/grid_taken", c->dissipated, (size_t)(c->sides * c->sides) * sizeof *c->dissipated);
}

void grid_contact_free(struct grid_contact *c)
{
    memory_free(c->node);
    memory_free(c->dissipated);
}
