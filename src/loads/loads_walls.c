/* Finds the nodes whose motion boundary conditions constrain: nodes of the background grid, in every step, and nodes of
 * the mesh of the undeformed body, once. A wall is the prescribed velocity of one component of a node. */
#include <math.h>
#include <string.h>

#include "loads/loads.h"
#include "loads/mirrors.h"
#include "base/memory.h"

/* ---- walls of the grid ------------------------------------------------------------------------------------------- */

/* Appends an entry to the list s of constrained node components: load number `load` prescribes the velocity of the
 * component `component` of node `node`. */
static void constrained_add(struct constrained_set *s, int64_t node, int component, int load)
{
    GROW("loads.held", s->held, s->n + 1);
    s->held[s->n++] = (struct held){(int32_t)node, (uint8_t)component, (uint8_t)load, false};
}

/* Returns true if `load` constrains component `component` of every node of grid g at position x[dim] [m]: in the region
 * of a prescribed motion that is not restricted to a body, on a mirror plane or beyond it. Returns false for loads on
 * layers behind a face, whose particles determine the driven nodes. tolerance: of region and plane [m]. */
static bool node_constrained(const struct load *load, const struct grid *g, const real *x, real tolerance,
                             int component)
{
    const struct boundary *b = load->boundary;
    const int dim = g->dim;
    if (b->kind == BOUNDARY_VELOCITY)
        return b->body < 0 && b->side == 0 && (b->components >> component & 1) &&
               region_contains(&b->region, x, dim, tolerance);
    return b->kind == BOUNDARY_MIRROR && (component == b->axis || b->hold_tangential) &&
           load->outside * (x[b->axis] - b->at) >= -tolerance;
}

bool mirror_plane_is_at_or_midway_between_nodes(const struct boundary *b, const struct grid *g, real spacing)
{
    const real steps = 2 * (b->at - g->anchor[b->axis]) / g->h;
    return fabs(steps - nearbyint(steps)) * g->h <= 2 * LOADS_TOLERANCE * spacing;
}

/* Reflects a node of g at the mirror plane of `load` if the node is beyond the plane: replaces k[dim], its indices, by
 * those of its mirror image, and reverses the signs in *f of components that the mirror reverses. Returns false if the
 * image is more than 4 nodes away or not in the box of nodes, or at no node because the plane is neither on a node nor
 * midway between two; else true, also if `load` is no mirror. spacing: lattice spacing, to which tolerances refer
 * [m]. */
static bool node_reflect(const struct load *load, const struct grid *g, real spacing, int64_t *k, struct mirror_node *f)
{
    const struct boundary *b = load->boundary;
    if (b->kind != BOUNDARY_MIRROR) return true;
    const real away = b->at - grid_node_position(g, b->axis, k[b->axis]);
    if (-load->outside * away <= LOADS_TOLERANCE * spacing) return true;
    const int64_t whole = llround(2 * away / g->h);
    if (!mirror_plane_is_at_or_midway_between_nodes(b, g, spacing) || whole < -4 || whole > 4) return false;
    k[b->axis] += whole;
    for (int d = 0; d < DIM_MAX; d++)
        if (d == b->axis || b->hold_tangential) f->sign[d] = (int8_t)-f->sign[d];
    return k[b->axis] >= 0 && k[b->axis] < g->count[b->axis];
}

/* Returns true if node I of g is beyond planes of symmetry in l and moves as the mirror image of another node. Stores
 * in *f this other node, the signs of the components and the number of the load with the plane. */
static bool node_mirrored(const struct loads *l, const struct grid *g, int64_t I, struct mirror_node *f)
{
    int64_t k[DIM_MAX] = {0}, image = 0;
    *f = (struct mirror_node){.node = (int32_t)I, .sign = {1, 1, 1}};
    for (int d = 0; d < g->dim; d++) k[d] = I / g->stride[d] % g->count[d];
    for (int b = 0; b < l->n; b++) {
        const int64_t before = k[l->load[b].boundary->axis];
        if (!node_reflect(&l->load[b], g, l->spacing, k, f)) return false;
        if (k[l->load[b].boundary->axis] != before) f->load = (uint8_t)b;
    }
    for (int b = 0; b < l->n; b++) { /* between two mirrors an image may be beyond one of them */
        struct mirror_node none = *f;
        int64_t again[DIM_MAX];
        memcpy(again, k, sizeof k);
        if (!node_reflect(&l->load[b], g, l->spacing, again, &none) || memcmp(again, k, sizeof k) != 0) return false;
    }
    for (int d = 0; d < g->dim; d++) image += k[d] * g->stride[d];
    f->image = (int32_t)image;
    return image != I;
}

/* Returns true if `load` may constrain nodes of grid g. Where each body has a grid of its own, a load with prescribed
 * motion constrains only the grids of bodies to which its particles (indices in p) belong. */
static bool load_holds(const struct load *load, const struct grid *g, const struct particles *p)
{
    bool holds = g->body == 0 || load->boundary->kind != BOUNDARY_VELOCITY;
    for (int64_t q = 0; q < load->n && !holds; q++) holds = p->body[load->particle[q]] + 1 == g->body;
    return holds;
}

/* Computes the position x[dim] of node I of g [m]. mesh: the mesh whose grid g is, or NULL. Nodes doubled by slits
 * (gaps between cells) are at the position of their regular node. */
static void node_at(const struct grid *g, const struct mesh *mesh, int64_t I, real *x)
{
    const int64_t at = mesh ? mesh_original_node_of_doubled_node(mesh, I) : I;
    for (int d = 0; d < g->dim; d++) x[d] = grid_node_position(g, d, at / g->stride[d] % g->count[d]);
}

/* Returns true if the position of mesh node I is not sufficient to decide whether `load` constrains it. This is so at
 * slits, gaps between cells at which each side has its own node at one position: whether such a node is driven depends
 * on the material of its cells. A plane of symmetry, too, does not constrain the node along axes along which the slit
 * separates its material from the mirror image. Returns false without mesh or slits. */
static bool place_misleads(const struct mesh *mesh, const struct load *load, int64_t I)
{
    if (!mesh || !mesh->slits.split) return false;
    if (load->boundary->kind == BOUNDARY_MIRROR) return mesh->slits.open[I] >> load->boundary->axis & 1;
    return mesh->slits.split[I] && load->boundary->kind == BOUNDARY_VELOCITY;
}

/* Lists in *s the components of nodes of g that the loads l constrain because of the position of the node: in the
 * region of a prescribed motion, or on a plane of symmetry. Adds nodes beyond such planes to g as mirror nodes, which
 * copy the motion of another node. Nodes doubled by slits have no mirror nodes. Must be called once for each box of
 * nodes. mesh: the mesh to which g belongs, or NULL; p: particles; reference: true if nodes move with the material;
 * only then regions of rotating loads constrain nodes, because the region rotates with the material. */
static void constrained_find(const struct loads *l, struct constrained_set *s, struct grid *g, const struct mesh *mesh,
                             const struct particles *p, bool reference)
{
    struct mirror_node mirror_node;
    s->n = 0;
    g->mirror_nodes = 0;
    for (int d = 0; d < g->dim; d++) s->first[d] = g->first[d], s->count[d] = g->count[d];
    for (int64_t I = 0; I < g->n; I++) {
        real x[DIM_MAX];
        const bool behind = mesh && I >= mesh->slits.first;
        if (behind && mesh_original_node_of_doubled_node(mesh, I) == I) continue; /* unused index */
        if (!behind && node_mirrored(l, g, I, &mirror_node)) {
            grid_add_mirror_node(g, &mirror_node);
            continue;
        }
        node_at(g, mesh, I, x);
        for (int b = 0; b < l->n; b++)
            for (int d = 0; d < g->dim; d++)
                if (load_holds(&l->load[b], g, p) && !place_misleads(mesh, &l->load[b], I) &&
                    node_constrained(&l->load[b], g, x, LOADS_TOLERANCE * l->spacing, d) &&
                    (reference || !l->load[b].boundary->rotates)) /* the region rotates, nodes do not */
                    constrained_add(s, I, d, b);
    }
    s->lasting = s->n;
}

/* Returns true if two loads of l prescribe the same component of motion (of dim), not necessarily of the same nodes. */
static bool component_is_prescribed_twice(const struct loads *l, int dim)
{
    uint8_t once = 0, twice = 0;
    for (int b = 0; b < l->n; b++) {
        const uint8_t components = boundary_prescribed_component_mask(l->load[b].boundary, dim);
        twice |= once & components, once |= components;
    }
    return twice != 0;
}

/* Marks those entries of s as overruled whose component of a node a later load of l constrains as well. Thus one load
 * alone moves each component of a node, and has its reaction, impulse and work. g: the grid of s. */
static void constrained_mark_overruled(const struct loads *l, struct constrained_set *s, const struct grid *g)
{
    if (!component_is_prescribed_twice(l, g->dim)) return;
    uint8_t *last = NEW("loads.last", g->n * g->dim, uint8_t); /* number of the last load + 1, by node and component */
    for (int64_t q = 0; q < s->n; q++) {
        uint8_t *of = &last[s->held[q].node * g->dim + s->held[q].component];
        if (*of <= s->held[q].load) *of = (uint8_t)(s->held[q].load + 1);
    }
    for (int64_t q = 0; q < s->n; q++)
        s->held[q].overruled = s->held[q].load + 1 < last[s->held[q].node * g->dim + s->held[q].component];
    memory_free(last);
}

/* Returns true if `load` (of l) constrains the component `component` of mesh node I because of the position of the
 * node: in the region of a prescribed motion, or on a plane of symmetry. */
static bool constrained_by_region(const struct loads *l, const struct load *load, const struct mesh *mesh, int64_t I,
                                  int component)
{
    real x[DIM_MAX];
    node_at(&mesh->grid, mesh, I, x);
    return !place_misleads(mesh, load, I) &&
           node_constrained(load, &mesh->grid, x, LOADS_TOLERANCE * l->spacing, component);
}

/* Returns true if set s was found for the present box of nodes of g (first index and count along each axis). */
static bool constrained_is_current(const struct constrained_set *s, const struct grid *g)
{
    for (int d = 0; d < g->dim; d++)
        if (s->first[d] != g->first[d] || s->count[d] != g->count[d]) return false;
    return true;
}

/* Returns true if particle i of p is a material point whose motion is that of grid g, not of a mesh. */
static bool point_is_on(const struct grid *g, const struct particles *p, int32_t i)
{
    return particle_is_moved_by_grid_or_mesh_nodes(p, i) && !(p->flag[i] & FLAG_MESHED) &&
           (g->body == 0 || g->body == p->body[i] + 1);
}

/* Computes l->share[g->n] [kg]: the mass that each node of grid g receives from the material points of `load`. p: all
 * particles; k: interpolation kernels; half_width: transfer_data.half_width [m]. Returns the number of
 * points of `load` on g. If it is 0, l->share is not set. */
static int64_t driven_share(struct loads *l, const struct load *load, const struct grid *g, const struct particles *p,
                            const struct kernels *k, real half_width)
{
    int32_t *list = NEW("loads.driven", load->n, int32_t);
    real *mass = NEW("loads.driven_mass", load->n, real);
    int64_t n = 0;
    for (int64_t q = 0; q < load->n; q++)
        if (point_is_on(g, p, load->particle[q])) {
            list[n] = load->particle[q];
            mass[n++] = p->mass[load->particle[q]];
        }
    if (n > 0) {
        GROW("loads.share", l->share, g->n);
        array_fill_bytes(l->share, 0, g->n, sizeof *l->share);
        k->spread(g, p, half_width, list, n, mass, l->share);
    }
    memory_free(list);
    memory_free(mass);
    return n;
}

/* Motion that one load prescribes in this step and in the previous one, prepared for evaluation at many nodes. If it is
 * equal at all nodes (`uniform`), `wall` contains the prescribed velocity of each component (without the node
 * number). */
struct driven_by {
    struct prescribed_motion now, before;
    bool uniform;              /* the motion is that of `wall` at every node */
    struct wall wall[DIM_MAX]; /* only if `uniform`: by component, without node */
};

/* Returns the wall, which is the prescribed velocity of component d of node I at x[dim] [m], and its change since the
 * previous step. by: motion that the load prescribes; which: number of the load; reference: true if nodes move with the
 * material, as on a mesh. If so, and if the load prescribes a displacement, the wall also contains the displacement of
 * the node at the end of the step. */
static struct wall wall_at(const struct driven_by *by, int64_t I, const real *x, int d, int which, bool reference)
{
    const struct boundary *b = by->now.boundary;
    const bool drives = b->kind == BOUNDARY_VELOCITY, first = by->now.t <= by->now.dt;
    const real velocity = drives ? prescribed_velocity_component_at_position(&by->now, x, d, !reference) : 0;
    const real place =
        b->displaces && reference ? prescribed_displacement_component_at_position(&by->now.to, x, d) : NAN;
    real change = 0;
    if (drives && !first && (b->rotates || b->displaces || b->formula[d].n > 0))
        change = velocity - prescribed_velocity_component_at_position(&by->before, x, d, !reference);
    else if (drives && !first)
        change = (by->now.factor - by->before.factor) * b->value[d];
    return (struct wall){(int32_t)I, (int16_t)d, (int16_t)which, velocity,
                         change,     place,      .reaction = 0,  .symmetric = !drives && !b->hold_tangential};
}

/* Returns true if the nodes of g that load number `which` of l drives must be found from its material points: most of
 * its particles (of p) are material points, and none of the nodes in its region (those in s) has mass. s: nodes that
 * regions constrain. */
static bool points_choose_driven_nodes(const struct loads *l, int which, const struct constrained_set *s,
                                       const struct grid *g, const struct particles *p)
{
    const struct load *load = &l->load[which];
    int64_t points = 0;
    for (int64_t q = 0; q < load->n; q++) points += particle_is_moved_by_grid_or_mesh_nodes(p, load->particle[q]);
    bool choose = 2 * points > load->n;
    for (int64_t q = 0; q < s->n && choose; q++) choose = s->held[q].load != which || !(g->mass[s->held[q].node] > 0);
    return choose;
}

#define MOSTLY (0.5 * (1 - 1e-9)) /* share of its mass from points of a load with which a node is driven [1] */
/* Applies if no node has the fraction MOSTLY of its mass from points of a load. The load then drives the nodes with at
 * least this multiple of the largest fraction [1]. */
#define NEARLY_LARGEST 0.9
#define HEAVY 0.01 /* mass from points of a load, divided by the largest one, below which a node is ignored [1] */

/* Returns the share (0 to 1) of its mass that a node must have from the points of a load to be driven by this load: one
 * half, or, where no node has that much, NEARLY_LARGEST times the largest share, so that a support between nodes drives
 * those nearest to it. share[nodes]: mass from points of the load [kg]; mask[nodes]: 0 for nodes without such mass, or
 * NULL (nodes with less than HEAVY times the largest such mass are ignored); mass[nodes]: mass of the nodes [kg]. */
static real least_driven_share(const real *share, const uint8_t *mask, const real *mass, int64_t nodes)
{
    real heaviest = 0, largest = 0;
    for (int64_t I = 0; I < nodes; I++)
        if (!mask || mask[I]) heaviest = real_max(heaviest, share[I]);
    for (int64_t I = 0; I < nodes; I++)
        if ((!mask || mask[I]) && share[I] > HEAVY * heaviest && mass[I] > 0)
            largest = real_max(largest, share[I] / mass[I]);
    return largest >= MOSTLY ? MOSTLY : NEARLY_LARGEST * largest;
}

/* Lists in *s the nodes of g that have at least the share `least` of their mass from points of load number `which`, for
 * each component that this load prescribes. l->share[g->n]: this mass [kg]; p: particles. Skips node components that
 * the load constrains already because the node is in its region; a second entry would count the inertia of the node as
 * a reaction. */
static void driven_nodes_add(const struct loads *l, int which, struct constrained_set *s, const struct grid *g,
                             const struct particles *p, real least)
{
    const struct load *load = &l->load[which];
    const bool region = !load->boundary->rotates && load_holds(load, g, p);
    for (int64_t I = 0; I < g->n; I++) {
        real x[DIM_MAX];
        if (l->share[I] <= 0 || l->share[I] < least * g->mass[I]) continue;
        node_at(g, NULL, I, x);
        for (int d = 0; d < g->dim; d++) {
            if (!(load->boundary->components >> d & 1) ||
                (region && node_constrained(load, g, x, LOADS_TOLERANCE * l->spacing, d)))
                continue;
            constrained_add(s, I, d, which);
        }
    }
}

/* Computes by[l->n], the motion that each load prescribes in the step of size dt [s] about time t [s], and in the step
 * before; for the first step both are equal. dim: number of dimensions; reference: true if nodes move with the
 * material, as on a mesh. */
static void driven_by_all(const struct loads *l, int dim, real t, real dt, bool reference, struct driven_by *by)
{
    const real anywhere[DIM_MAX] = {0};
    for (int b = 0; b < l->n; b++) {
        by[b].now = loads_prescribed_motion_of_boundary_in_step(l, b, dim, t, dt);
        by[b].before = t > dt ? boundary_prescribed_motion_in_step(l->load[b].boundary, dim, t - dt, dt) : by[b].now;
        by[b].uniform = !boundary_motion_varies_in_space(l->load[b].boundary);
        for (int d = 0; d < dim && by[b].uniform; d++) by[b].wall[d] = wall_at(&by[b], 0, anywhere, d, b, reference);
    }
}

/* Prescribes the velocities of all node components in the list s on grid g, except of nodes without mass and of entries
 * that a later load overrules. by[loads]: prescribed motion of each load; mesh: the mesh to which g belongs, or NULL;
 * reference: true if nodes move with the material, as on a mesh. */
static void constrained_walls(const struct constrained_set *s, struct grid *g, const struct mesh *mesh,
                              const struct driven_by *by, bool reference)
{
    for (int64_t q = 0; q < s->n; q++) {
        const struct held *h = &s->held[q];
        const struct driven_by *motion = &by[h->load];
        struct wall wall;
        real x[DIM_MAX];
        if (h->overruled || g->mass[h->node] <= 0) continue;
        if (motion->uniform)
            wall = motion->wall[h->component], wall.node = h->node;
        else {
            node_at(g, mesh, h->node, x);
            wall = wall_at(motion, h->node, x, h->component, h->load, reference);
        }
        grid_add_prescribed_velocity(g, &wall);
    }
}

void loads_prescribe_grid_velocities(struct loads *l, struct constrained_set *driven_nodes, struct grid *g,
                                     const struct particles *p, const struct kernels *k, real half_width, real t,
                                     real dt)
{
    struct driven_by by[BOUNDARIES_MAX];
    g->walls = 0, g->damped = l->damped;
    if (l->n == 0) return;
    if (!constrained_is_current(driven_nodes, g)) constrained_find(l, driven_nodes, g, NULL, p, false);
    driven_nodes->n = driven_nodes->lasting;
    for (int b = 0; b < l->n; b++)
        if (l->load[b].boundary->kind == BOUNDARY_VELOCITY && driven_share(l, &l->load[b], g, p, k, half_width) > 0)
            driven_nodes_add(l, b, driven_nodes, g, p,
                             points_choose_driven_nodes(l, b, driven_nodes, g, p)
                                 ? least_driven_share(l->share, NULL, g->mass, g->n)
                                 : MOSTLY);
    constrained_mark_overruled(l, driven_nodes, g);
    driven_by_all(l, g->dim, t, dt, false, by);
    constrained_walls(driven_nodes, g, NULL, by, false);
    loads_append_dashpots_to_grid(l, g, p, k, half_width);
}

/* ---- walls of the mesh ------------------------------------------------------------------------------------------- */

/* Computes the mass that mesh nodes receive from the points of `load`: adds up share[I] [kg] and sets mark[I] = 1 for
 * each node I with such mass. All marks must be 0 before. share[] need not be initialised, since the first mass of a
 * node is stored and not added. p: all particles. */
static void driven_masses(const struct load *load, const struct mesh *mesh, const struct particles *p, real *share,
                          uint8_t *mark)
{
    for (int64_t k = 0; k < load->n; k++) {
        const int32_t i = load->particle[k];
        for (int c = 0; c < 1 << p->dim && mesh->place[i] >= 0; c++) {
            const int64_t I = mesh_cell_corner_node(mesh, mesh->place[i] >> p->dim, c);
            if (!mark[I]) share[I] = 0, mark[I] = 1;
            share[I] += p->mass[i] * mesh_shape_function_value(p->dim, c, mesh->place[i] & ((1 << p->dim) - 1));
        }
    }
}

/* Lists in l->constrained_mesh the mesh nodes that load number `which` drives, for each component of the velocity that
 * it prescribes: those with at least half of their mass from its points (indices in p), or, if no node in its region
 * has mass and none reaches a half, those with at least NEARLY_LARGEST times the largest share. Skips components that
 * the load constrains already because of the position of the node. */
static void mesh_driven(struct loads *l, int which, const struct mesh *mesh, const struct particles *p)
{
    const struct load *load = &l->load[which];
    const int64_t n = mesh->grid.n;
    if (!l->mesh_share) l->mesh_share = BLANK("loads.mesh_share", n, real);
    if (!l->mesh_mark) l->mesh_mark = BLANK("loads.mesh_mark", n + LANES, uint8_t);
    driven_masses(load, mesh, p, l->mesh_share, l->mesh_mark);
    const real least = points_choose_driven_nodes(l, which, &l->constrained_mesh, &mesh->grid, p)
                           ? least_driven_share(l->mesh_share, l->mesh_mark, mesh->grid.mass, n)
                           : MOSTLY;
    for (int64_t I = next_marked_index(l->mesh_mark, 0, n); I < n; I = next_marked_index(l->mesh_mark, I + 1, n)) {
        const real share = l->mesh_share[I];
        l->mesh_mark[I] = 0;
        for (int d = 0; d < p->dim; d++)
            if (share > 0 && share >= least * mesh->grid.mass[I] && load->boundary->components >> d & 1 &&
                !constrained_by_region(l, load, mesh, I, d))
                constrained_add(&l->constrained_mesh, I, d, which);
    }
}

void loads_find_driven_mesh_nodes(struct loads *l, struct mesh *mesh, const struct particles *p)
{
    if (mesh->points == 0) return;
    /* regions and mirrors are constant; driven nodes depend on masses */
    if (!constrained_is_current(&l->constrained_mesh, &mesh->grid))
        constrained_find(l, &l->constrained_mesh, &mesh->grid, mesh, p, true);
    l->constrained_mesh.n = l->constrained_mesh.lasting;
    for (int b = 0; b < l->n; b++)
        if (l->load[b].boundary->kind == BOUNDARY_VELOCITY) mesh_driven(l, b, mesh, p);
    constrained_mark_overruled(l, &l->constrained_mesh, &mesh->grid);
    loads_append_dashpots_to_mesh(l, mesh, p);
}

void loads_find_driven_nodes_of_coarse_cells(const struct loads *l, struct constrained_set *driven_nodes,
                                             struct grid *g, const struct particles *p)
{
    if (constrained_is_current(driven_nodes, g)) return;
    constrained_find(l, driven_nodes, g, NULL, p, true);
    constrained_mark_overruled(l, driven_nodes, g);
}

/* Replaces the prescribed nodal velocities g->wall by those that loads l prescribe for the node components in `held`,
 * for the step of size dt [s] about time t [s]. g: a grid whose nodes move with the material; mesh: the mesh to which g
 * belongs, or NULL. */
static void reference_walls(const struct loads *l, const struct constrained_set *held, struct grid *g,
                            const struct mesh *mesh, real t, real dt)
{
    struct driven_by by[BOUNDARIES_MAX];
    g->walls = 0, g->damped = l->damped;
    driven_by_all(l, g->dim, t, dt, true, by);
    constrained_walls(held, g, mesh, by, true);
}

void loads_prescribe_coarse_node_velocities(const struct loads *l, const struct constrained_set *driven_nodes,
                                            struct grid *g, real t, real dt)
{
    reference_walls(l, driven_nodes, g, NULL, t, dt);
}

void loads_prescribe_mesh_velocities(const struct loads *l, struct mesh *mesh, real t, real dt)
{
    reference_walls(l, &l->constrained_mesh, &mesh->grid, mesh, t, dt);
}
