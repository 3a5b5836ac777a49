/* Bodies that meet on grids of their own: at nodes that points of two bodies reach, what approaches is held back, and
 * rubs (Bardenhagen, Brackbill & Sulsky 2000). The normal n at a node, from a to b, is that of the difference of the
 * gradients of both masses (of bodies in touch what leans aside cancels); the gap is that of their points,
 *     g = min over b of x . n - max over a of x . n - D,   of points whose shapes reach the node,
 * since masses reach one another as soon as bodies share a cell. Where g <= 0 and (v_a - v_b) . n > 0
 *     J_n = m_a m_b/(m_a + m_b) (v_a - v_b) . n,   |J_t| <= friction J_n
 * is taken from a and given to b: momentum is kept to round-off, and energy is taken only. The velocities of the second
 * map (FLIP), which strain points, are left alone: changed too, discs that meet gained 9 % of energy. Nodes in contact
 * are few: serial. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "grid/contact_grid.h"

#define AROUND 2 /* cells, over which normals are smoothed */

/* ---- where two bodies meet --------------------------------------------------------------------------------------- */

/* Nodes that two grids share, counted from the anchor. */
struct shared {
    int64_t first[DIM_MAX], count[DIM_MAX], n;
};

/* Nodes that points of both may have reached; none: false. */
static bool shared_find(struct shared *s, const struct grid_side *a, const struct grid_side *b)
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

/* Index of shared node k in a grid. */
static int64_t shared_node(const struct shared *s, const struct grid *g, int64_t k)
{
    int64_t I = 0;
    for (int d = 0; d < g->dim; d++) {
        I += (s->first[d] + k % s->count[d] - g->first[d]) * g->stride[d];
        k /= s->count[d];
    }
    return I;
}

static real slope_of(const struct grid *g, int64_t I, int d)
{
    return g->mass[I + g->stride[d]] - g->mass[I - g->stride[d]];
}

/* Difference of the gradients of both masses, from a to b [kg]. */
static void leaning_find(struct grid_contact_node *node, const struct grid *a, const struct grid *b)
{
    for (int d = 0; d < a->dim; d++) node->leaning[d] = slope_of(b, node->at[1], d) - slope_of(a, node->at[0], d);
}

static struct grid_contact_node *node_add(struct grid_contact *c)
{
    GROW("contact.nodes", c->node, c->nodes + 1);
    struct grid_contact_node *node = &c->node[c->nodes++];
    *node = (struct grid_contact_node){.reach = {-INFINITY, INFINITY}};
    return node;
}

/* Lists nodes with mass of both from `first` on, and where each stands: place[shared node], -1: not listed. */
static void shared_nodes_find(struct grid_contact *c, const struct shared *s, const struct grid_side *side, int a,
                              int b, int32_t *place)
{
    const struct grid *g = side[a].grid, *h = side[b].grid;
    const real least = real_max(c->smallest_mass, g->light_mass);
    for (int64_t k = 0; k < s->n; k++) {
        const int64_t I = shared_node(s, g, k), J = shared_node(s, h, k);
        place[k] = -1;
        if (!(g->mass[I] > least && h->mass[J] > least)) continue;
        struct grid_contact_node *node = node_add(c);
        node->side[0] = a, node->side[1] = b, node->at[0] = I, node->at[1] = J;
        leaning_find(node, g, h);
        place[k] = (int32_t)(c->nodes - 1);
    }
}

/* Unit normals: leanings of the nodes up to two cells away are added, as single ones follow the lattices of both bodies
 * and are 10 degrees off on curved faces. */
static void normals_find(struct grid_contact *c, const struct shared *s, int dim, const int32_t *place)
{
    for (int64_t k = 0; k < s->n; k++) {
        const int64_t x = k % s->count[0], y = k / s->count[0] % s->count[1], z = k / s->count[0] / s->count[1];
        real sum[DIM_MAX] = {0}, size2 = 0;
        if (place[k] < 0) continue;
        for (int64_t w = z - AROUND; w <= z + AROUND; w++)
            for (int64_t v = y - AROUND; v <= y + AROUND; v++)
                for (int64_t u = x - AROUND; u <= x + AROUND; u++) {
                    if (u < 0 || v < 0 || w < 0 || u >= s->count[0] || v >= s->count[1] || w >= s->count[2]) continue;
                    const int32_t at = place[(w * s->count[1] + v) * s->count[0] + u];
                    for (int d = 0; d < dim && at >= 0; d++) sum[d] += c->node[at].leaning[d];
                }
        struct grid_contact_node *node = &c->node[place[k]];
        for (int d = 0; d < dim; d++) size2 += square(sum[d]);
        for (int d = 0; d < dim; d++) node->normal[d] = size2 > 0 ? sum[d] / sqrt(size2) : 0;
    }
}

/* ---- gaps -------------------------------------------------------------------------------------------------------- */

/* Point i of side 0 or 1 at shared nodes that its shape reaches. */
static void point_reach(struct grid_contact *c, const struct shared *s, const struct grid *g, const struct particles *p,
                        int32_t i, int side, const int32_t *place)
{
    int64_t low[DIM_MAX] = {0}, high[DIM_MAX] = {0}, k[DIM_MAX];
    for (int d = 0; d < g->dim; d++) {
        const real at = grid_place(g, d, p->x[d][i]), reach = 1 + c->half_width / g->h;
        low[d] = (int64_t)ceil(at - reach) - s->first[d], high[d] = (int64_t)floor(at + reach) - s->first[d];
        if (low[d] < 0) low[d] = 0;
        if (high[d] >= s->count[d]) high[d] = s->count[d] - 1;
    }
    for (k[2] = low[2]; k[2] <= high[2]; k[2]++)
        for (k[1] = low[1]; k[1] <= high[1]; k[1]++)
            for (k[0] = low[0]; k[0] <= high[0]; k[0]++) {
                const int32_t at = place[(k[2] * s->count[1] + k[1]) * s->count[0] + k[0]];
                if (at < 0) continue;
                struct grid_contact_node *node = &c->node[at];
                real along = 0;
                for (int d = 0; d < g->dim; d++) along += p->x[d][i] * node->normal[d];
                node->reach[side] = side == 0 ? real_max(node->reach[0], along) : real_min(node->reach[1], along);
            }
}

static void points_reach(struct grid_contact *c, const struct shared *s, const struct grid_side *a,
                         const struct particles *p, int side, const int32_t *place)
{
    const struct transfer_order *o = a->order;
    for (int32_t cell = 0; cell < o->cells; cell++) {
        const int32_t first = o->particle[o->cell_start[cell]];
        bool near = true;
        for (int d = 0; d < a->grid->dim && near; d++) {
            const int64_t at = grid_cell(a->grid, d, p->x[d][first]) - s->first[d];
            near = at >= -2 && at <= s->count[d] + 1;
        }
        for (int32_t k = o->cell_start[cell]; near && k < o->cell_start[cell + 1]; k++)
            point_reach(c, s, a->grid, p, o->particle[k], side, place);
    }
}

/* ---- the list of a step ------------------------------------------------------------------------------------------ */

void grid_contact_make(struct grid_contact *c, int sides)
{
    memory_free(c->taken);
    c->sides = sides;
    c->taken = NEW("contact.taken", sides * sides, real);
}

void grid_side_make(struct grid_side *a, struct grid *g, const struct transfer_order *order, const struct particles *p)
{
    *a = (struct grid_side){.grid = g, .order = order};
    for (int d = 0; d < DIM_MAX; d++) a->from[d] = INT32_MAX, a->to[d] = INT32_MIN; /* nothing yet */
    for (int32_t cell = 0; cell < order->cells; cell++)
        for (int d = 0; d < g->dim; d++) {
            const int64_t k = grid_cell(g, d, p->x[d][order->particle[order->cell_start[cell]]]);
            if (k - 1 < a->from[d]) a->from[d] = k - 1;
            if (k + 2 > a->to[d]) a->to[d] = k + 2;
        }
}

void grid_contact_find(struct grid_contact *c, const struct grid_side *side, const struct particles *p)
{
    c->nodes = 0;
    for (int a = 0; a < c->sides; a++)
        for (int b = a + 1; b < c->sides; b++) {
            struct shared s;
            const int64_t before = c->nodes;
            if (!shared_find(&s, &side[a], &side[b])) continue;
            int32_t *place = BARE("contact.place", s.n, int32_t);
            shared_nodes_find(c, &s, side, a, b, place);
            if (c->nodes > before) {
                normals_find(c, &s, side[a].grid->dim, place);
                points_reach(c, &s, &side[a], p, 0, place);
                points_reach(c, &s, &side[b], p, 1, place);
            }
            memory_free(place);
        }
}

/* ---- exchange ---------------------------------------------------------------------------------------------------- */

/* Points of FLIP do not take all of what nodes get: the work of an impulse is over the mean of the velocities before
 * and after the step, of which the second is only smoothed. Where nodes part before the step, an impulse that just
 * stopped their approach would give energy; it leaves them this share of their parting speed as approach. That is no
 * proof: while contact of two bodies has given more energy than taken, impulses act on what approaches before the step,
 * too, which only takes. */
#define RETURNED 1.6

/* Speed along the direction `along` that an impulse may take, by the relative velocities before and now [m/s]. */
static real speed_taken(const real *before, const real *now, const real *along, bool strict, int dim)
{
    const real parting = dot(before, along, dim);
    if (strict && parting < 0) return 0;
    return real_max(0, dot(now, along, dim) + RETURNED * real_min(0, parting));
}

/* Impulse per reduced mass that takes the approach and rubs [m/s]; false: they part, or do not touch. */
static bool exchange_of(const struct grid_contact *c, const struct grid_contact_node *node, const real *before,
                        const real *now, int dim, real *taken)
{
    real slide[DIM_MAX] = {0}, speed = 0;
    if (node->reach[1] - node->reach[0] - c->spacing > 0) return false;
    const bool strict = c->taken[node->side[0] * c->sides + node->side[1]] < 0;
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

/* Marks the nodes that walls hold, or takes the marks away. */
static void walls_mark(const struct grid_side *side, int sides, uint8_t mark)
{
    for (int k = 0; k < sides; k++)
        for (int64_t q = 0; q < side[k].grid->walls; q++) side[k].grid->held[side[k].grid->wall[q].node] = mark;
}

/* Mass that node I sets against an impulse along the normal [kg]: infinite where walls hold it. Its velocities before
 * and now are then those of the walls. */
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

real grid_contact_exchange(struct grid_contact *c, const struct grid_side *side)
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
            lost += own, c->taken[node->side[0] * c->sides + node->side[1]] += own;
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

real grid_contact_remapped(struct grid_contact *c, const struct grid_side *side)
{
    real lost = 0;
    for (int64_t k = 0; k < c->nodes; k++) {
        const struct grid_contact_node *node = &c->node[k];
        const struct grid *g[2] = {side[node->side[0]].grid, side[node->side[1]].grid};
        for (int d = 0; d < g[0]->dim; d++) {
            const real mapped = g[0]->momentum[d][node->at[0]] - g[1]->momentum[d][node->at[1]];
            const real own = 0.5 * node->impulse[d] * (mapped - node->after[d]);
            lost += own, c->taken[node->side[0] * c->sides + node->side[1]] += own;
        }
    }
    return lost;
}

void grid_contact_clock(struct grid_contact *c, real t)
{
    if (c->touching == 0) return;
    c->ended = t;
    if (isnan(c->began)) c->began = t;
}

status grid_contact_archive(struct grid_contact *c, struct archive *a)
{
    ARCHIVE_VALUE(a, "contact/grid_began", c->began);
    ARCHIVE_VALUE(a, "contact/grid_ended", c->ended);
    ARCHIVE_VALUE(a, "contact/grid_most", c->nodes_most);
    return a->exchange(a, "contact/grid_taken", c->taken, (size_t)(c->sides * c->sides) * sizeof *c->taken);
}

void grid_contact_free(struct grid_contact *c)
{
    memory_free(c->node);
    memory_free(c->taken);
}
