/* Adds the dashpots of absorbing faces: to particles that bond forces move, to grid nodes through the material points
 * of the face, and to the nodes of the mesh on the face. */
#include <stdlib.h>
#include <string.h>

#include "kernels/dashpot.h"
#include "loads/loads.h"
#include "base/memory.h"

/* ---- set-up ------------------------------------------------------------------------------------------------------ */

/* Returns true if load l is an absorbing boundary. */
static bool is_absorbing(const struct load *l) { return l->boundary->kind == BOUNDARY_ABSORBING; }

/* Returns true if the absorbing loads a and b act on the same face of at least one particle: the faces have equal axis
 * and side, and the loads have a common particle with an area. */
static bool absorb_same(const struct load *a, const struct load *b)
{
    if (a->boundary->face != b->boundary->face || a->boundary->side != b->boundary->side) return false;
    for (int64_t k = 0, m = 0; k < a->n && m < b->n;) { /* both ascend */
        if (a->particle[k] == b->particle[m] && a->outer[k] > 0 && b->outer[m] > 0) return true;
        if (a->particle[k] < b->particle[m])
            k++;
        else
            m++;
    }
    return false;
}

/* Returns true if the absorbing face of load a is in the plane of the load `mirror`: one of its particles (indices in
 * p) with area is within 0.51 spacings of the plane. Returns false if `mirror` is no mirror or its axis is not that of
 * the face. spacing: lattice spacing [m]. */
static bool absorbs_in_mirror(const struct load *a, const struct load *mirror, const struct particles *p, real spacing)
{
    const int axis = a->boundary->face;
    if (mirror->boundary->kind != BOUNDARY_MIRROR || mirror->boundary->axis != axis) return false;
    for (int64_t k = 0; k < a->n; k++)
        if (a->outer[k] > 0 && fabs(p->X[axis][a->particle[k]] - mirror->boundary->at) < 0.51 * spacing) return true;
    return false;
}

/* Returns REFUSED, with a message that names both boundaries, if an absorbing face of l is in the plane of a mirror:
 * the body of the particles p continues there, so that it has no face. Returns OK otherwise. */
static status absorbing_mirrors_check(const struct loads *l, const struct particles *p)
{
    for (int b = 0; b < l->n; b++)
        for (int m = 0; m < l->n; m++) {
            const struct boundary *one = l->load[b].boundary, *mirror = l->load[m].boundary;
            if (!is_absorbing(&l->load[b]) || !absorbs_in_mirror(&l->load[b], &l->load[m], p, l->spacing)) continue;
            return status_message_prepend_location(
                one->place, status_set(REFUSED,
                                       "boundary %s: mirror %s is a plane of symmetry at this face, so the whole body "
                                       "has no surface here; choose a face that no mirror touches",
                                       one->name, mirror->name));
        }
    return OK;
}

status absorbing_boundaries_check_for_overlap(const struct loads *l, const struct particles *p)
{
    TRY(absorbing_mirrors_check(l, p));
    for (int b = 0; b < l->n; b++)
        for (int a = 0; a < b; a++) {
            const struct boundary *one = l->load[a].boundary, *other = l->load[b].boundary;
            const bool both = is_absorbing(&l->load[a]) && is_absorbing(&l->load[b]);
            if (!both || !absorb_same(&l->load[a], &l->load[b])) continue;
            return status_message_prepend_location(
                other->place, status_set(REFUSED,
                                         "boundary %s: boundary %s already absorbs at this face; give "
                                         "each part of a face in one boundary only",
                                         other->name, one->name));
        }
    return OK;
}

/* Makes the list l->absorbing.particle of all particles of p on absorbing faces, in ascending order and without
 * duplicates. Release it with absorbing_dashpots_free. */
static void particles_join(struct loads *l, const struct particles *p)
{
    struct absorbing *a = &l->absorbing;
    uint8_t *chosen = NEW("loads.chosen", p->n, uint8_t);
    for (int b = 0; b < l->n; b++)
        for (int64_t k = 0; k < l->load[b].n && is_absorbing(&l->load[b]); k++) chosen[l->load[b].particle[k]] = 1;
    for (int64_t i = 0; i < p->n; i++) a->n += chosen[i];
    a->particle = NEW("loads.absorbing", a->n, int32_t);
    for (int64_t i = 0, k = 0; i < p->n; i++)
        if (chosen[i]) a->particle[k++] = (int32_t)i;
    memory_free(chosen);
}

/* Returns the coefficient of the dashpot on particle number q of the absorbing load `load`, for motion along axis d
 * [kg/s]: the area of the particle times the wave impedance of its material, for P waves normal to the face and for S
 * waves along it. by: what moves the particle of p (bonds, grid or mesh), on which the impedance depends; for a grid
 * the areas are those extrapolated to the face. a: impedances of the materials. */
static real dashpot_rate(const struct absorbing *a, const struct load *load, const struct particles *p, int64_t q,
                         enum moved_by by, int d)
{
    const struct impedance *z = &a->impedance[by][p->material[load->particle[q]]];
    const real area = (by == MOVED_BY_GRID ? load->edge : load->outer)[q];
    return area * (d == load->boundary->face ? z->normal : z->tangential);
}

static int by_index(const void *a, const void *b)
{
    const int32_t i = *(const int32_t *)a, j = *(const int32_t *)b;
    return (i > j) - (i < j);
}

/* Returns the position of particle i in the ascending list a->particle of particles with dashpots, or -1 if it has
 * none. */
static int64_t dashpot_of(const struct absorbing *a, int32_t i)
{
    const int32_t *found = a->n ? bsearch(&i, a->particle, (size_t)a->n, sizeof i, by_index) : NULL;
    return found ? found - a->particle : -1;
}

/* Sets the dashpot coefficients of particles of p that bonds move to 0, in the components that a support or a clamped
 * mirror of l prescribes. The reaction of the support then contains no dashpot force. On grids, dashpots_hold does this
 * for nodes of prescribed velocity. */
static void rates_hold(struct loads *l, const struct particles *p)
{
    for (int b = 0; b < l->n; b++) {
        const struct load *load = &l->load[b];
        for (int64_t q = 0; q < load->n && load->prescribes; q++) {
            const int64_t k = dashpot_of(&l->absorbing, load->particle[q]);
            for (int d = 0; d < p->dim && k >= 0; d++)
                if (load->prescribes[q] >> d & 1) l->absorbing.rate[MOVED_BY_BONDS][d][k] = 0;
        }
    }
}

void absorbing_dashpots_make(struct loads *l, const struct particles *p, const struct impedance *const *impedance)
{
    struct absorbing *a = &l->absorbing;
    bool any = false;
    for (int b = 0; b < l->n; b++) any = any || is_absorbing(&l->load[b]);
    if (!any) return;
    particles_join(l, p);
    for (int by = 0; by < MOVERS; by++) {
        a->impedance[by] = impedance[by];
        for (int d = 0; d < p->dim; d++) a->rate[by][d] = NEW("loads.rate", a->n, real);
    }
    for (int b = 0; b < l->n; b++)
        for (int64_t q = 0; q < l->load[b].n && is_absorbing(&l->load[b]); q++) {
            const int64_t k = dashpot_of(a, l->load[b].particle[q]);
            for (int by = 0; by < MOVERS; by++)
                for (int d = 0; d < p->dim; d++)
                    a->rate[by][d][k] += dashpot_rate(a, &l->load[b], p, q, (enum moved_by)by, d);
        }
    rates_hold(l, p);
}

void absorbing_dashpots_free(struct loads *l)
{
    struct absorbing *a = &l->absorbing;
    for (int b = 0; b < l->n; b++) memory_free(l->load[b].outer), memory_free(l->load[b].edge);
    for (int by = 0; by < MOVERS; by++)
        for (int d = 0; d < DIM_MAX; d++) memory_free(a->rate[by][d]);
    memory_free(a->particle);
    memory_free(a->field);
}

/* ---- particles that bonds move ----------------------------------------------------------------------------------- */

/* Adds the forces of the absorbing dashpots to p->f, for particles that are moved by bond forces (not by grid or mesh),
 * and adds their impulse and the energy that they absorb to the sums in l->absorbing. Does nothing while
 * l->absorbing.idle. dt_velocity: duration of the velocity update [s]. */
void loads_add_dashpot_forces(struct loads *l, struct particles *p, real dt_velocity)
{
    struct absorbing *a = &l->absorbing;
    struct dashpot_effect sum = {0};
    a->kick = 0;
    if (a->idle) return;
    for (int64_t k = 0; k < a->n; k++) {
        const int32_t i = a->particle[k];
        if (particle_is_moved_by_grid_or_mesh_nodes(p, i)) continue;
        for (int d = 0; d < p->dim; d++) {
            const real rate = a->rate[MOVED_BY_BONDS][d][k], change = dt_velocity * p->f[d][i] / p->mass[i];
            if (rate == 0) continue;
            p->f[d][i] += dashpot_compute_and_add_impulse(&sum, d, dt_velocity * rate, p->mass[i], p->v[d][i], change) /
                          dt_velocity;
        }
    }
    loads_add_absorbed_energy_and_impulse(l, &sum);
}

void loads_add_absorbed_energy_and_impulse(struct loads *l, const struct dashpot_effect *absorbed)
{
    l->absorbing.energy += absorbed->energy;
    l->absorbing.kick += absorbed->kick;
    for (int d = 0; d < DIM_MAX; d++) l->impulse[d] += absorbed->impulse[d];
}

/* ---- nodes ------------------------------------------------------------------------------------------------------- */

/* Compares a and b (struct dashpot) by their node index, for sorting and for binary search. */
static int by_dashpot(const void *a, const void *b)
{
    const struct dashpot *p = a, *q = b;
    return (p->node > q->node) - (p->node < q->node);
}

/* Replaces negative dashpot coefficients among rate[n] [kg/s] by 0 and scales the positive ones so that the sum does
 * not change; if the sum is negative, all become 0. Negative coefficients arise at nodes behind a face that is not
 * on nodes, where they are extrapolated. */
static void rates_clip(real *rate, int64_t n)
{
    real all = 0, left = 0;
    for (int64_t I = 0; I < n; I++) all += rate[I], left += real_max(rate[I], 0);
    for (int64_t I = 0; I < n && all < left; I++) rate[I] = all > 0 ? real_max(rate[I], 0) * (all / left) : 0;
}

/* Adds a dashpot to grid g for each node with a positive coefficient in any direction. rate[dim][g->n]: coefficients
 * [kg/s], overwritten. The coefficient of a node beyond a mirror plane is first added to that of its mirror image. Then
 * negative coefficients, which arise from extrapolation, are replaced by 0 and the others scaled to the same sum
 * (rates_clip). */
static void dashpots_list(struct grid *g, real *rate)
{
    for (int64_t k = 0; k < g->mirror_nodes; k++)
        for (int d = 0; d < g->dim; d++) {
            const int64_t from = g->mirror_node[k].node + d * g->n;
            rate[g->mirror_node[k].image + d * g->n] += rate[from], rate[from] = 0;
        }
    for (int d = 0; d < g->dim; d++) rates_clip(rate + d * g->n, g->n);
    for (int64_t I = 0; I < g->n; I++) {
        struct dashpot one = {.node = (int32_t)I};
        bool any = false;
        for (int d = 0; d < g->dim; d++) one.rate[d] = rate[I + d * g->n], any = any || one.rate[d] > 0;
        if (any) grid_add_dashpot(g, &one);
    }
}

/* Sets the dashpot coefficient of node `node` of grid g in direction `component` (0 .. dim - 1) to 0, because its
 * velocity is prescribed. Does nothing if the node has no dashpot. g->dashpot must be sorted by node. */
static void dashpots_hold(struct grid *g, int64_t node, int component)
{
    const struct dashpot one = {.node = (int32_t)node};
    struct dashpot *held = g->dashpots ? bsearch(&one, g->dashpot, (size_t)g->dashpots, sizeof one, by_dashpot) : NULL;
    if (held) held->rate[component] = 0;
}

/* Returns an array of n numbers, all 0: working memory that belongs to a, is not to be freed, and is reused by the next
 * call. */
static real *field_of(struct absorbing *a, int64_t n)
{
    GROW("loads.field", a->field, n);
    array_fill_bytes(a->field, 0, n, sizeof *a->field);
    return a->field;
}

void loads_append_dashpots_to_grid(struct loads *l, struct grid *g, const struct particles *p, const struct kernels *k,
                                   real half_width)
{
    struct absorbing *a = &l->absorbing;
    int64_t n = 0;
    g->dashpots = 0;
    if (a->n == 0 || a->idle) return;
    int32_t *list = NEW("loads.list", a->n, int32_t);
    real *value = NEW("loads.value", a->n * p->dim, real);
    for (int64_t q = 0; q < a->n; q++) {
        const int32_t i = a->particle[q];
        if (!particle_is_moved_by_grid_or_mesh_nodes(p, i) || p->flag[i] & FLAG_MESHED ||
            (g->body > 0 && g->body != p->body[i] + 1))
            continue;
        for (int d = 0; d < p->dim; d++) value[d * a->n + n] = a->rate[MOVED_BY_GRID][d][q];
        list[n++] = i;
    }
    if (n > 0) {
        real *rate = field_of(a, g->n * g->dim);
        for (int d = 0; d < p->dim; d++) k->spread(g, p, half_width, list, n, value + d * a->n, rate + d * g->n);
        dashpots_list(g, rate);
    }
    for (int64_t q = 0; q < g->walls; q++) dashpots_hold(g, g->wall[q].node, g->wall[q].component);
    memory_free(list);
    memory_free(value);
}

/* Returns the fraction (0 to 1) of the face area of a particle that is assigned to node `corner` of its mesh cell. A
 * cell has 2^dim particles, one in each of its equal parts. place: number of the part of the cell in which the particle
 * is; bit d of `place` and `corner` is 1 for the upper half along axis d. The face is half a spacing in front of the
 * particle, along `axis` in the direction `side` (-1 or 1). */
static real face_weight(int dim, int corner, int place, int axis, int side)
{
    const bool before = (corner >> axis & 1) == (side > 0), first = (place >> axis & 1) == (side > 0);
    real weight = first ? (before ? 1 : 0) : 0.5;
    for (int d = 0; d < dim; d++)
        if (d != axis) weight *= (corner ^ place) >> d & 1 ? 0.25 : 0.75;
    return weight;
}

/* Adds the dashpot coefficients of the absorbing load `load` to rate[dim][mesh->grid.n] [kg/s], at the nodes of the
 * mesh cells behind its face. Particles of p that are in no cell are skipped. a: impedances of the materials. */
static void mesh_face(const struct absorbing *a, const struct load *load, const struct mesh *mesh,
                      const struct particles *p, real *rate)
{
    const int dim = p->dim, places = 1 << dim;
    for (int64_t q = 0; q < load->n; q++) {
        const int32_t at = mesh->place[load->particle[q]];
        for (int c = 0; c < places && at >= 0; c++) {
            const real weight = face_weight(dim, c, at & (places - 1), load->boundary->face, load->boundary->side);
            const int64_t I = (at >> dim) + mesh->corner[c];
            for (int d = 0; d < dim; d++)
                rate[I + d * mesh->grid.n] += weight * dashpot_rate(a, load, p, q, MOVED_BY_MESH, d);
        }
    }
}

void loads_append_dashpots_to_mesh(struct loads *l, struct mesh *mesh, const struct particles *p)
{
    struct grid *g = &mesh->grid;
    g->dashpots = 0;
    if (l->absorbing.n == 0) return;
    real *rate = field_of(&l->absorbing, g->n * g->dim);
    for (int b = 0; b < l->n; b++)
        if (is_absorbing(&l->load[b])) mesh_face(&l->absorbing, &l->load[b], mesh, p, rate);
    dashpots_list(g, rate);
    for (int64_t q = 0; q < l->constrained_mesh.n; q++)
        dashpots_hold(g, l->constrained_mesh.held[q].node, l->constrained_mesh.held[q].component);
}
