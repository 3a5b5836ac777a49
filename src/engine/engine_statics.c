/* Load steps: the unknowns of a body, the forces on them, and what supports and loads do from one pseudo-time to the
 * next. */
#include "engine_statics.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "base/team.h"
#include "kernels/kernels.h"

/* ---- unknowns ---------------------------------------------------------------------------------------------------- */

static bool node_moves(const struct mesh *mesh, int64_t I) { return mesh->points > 0 && mesh->grid.mass[I] > 0; }

/* Nodes beyond planes of symmetry follow their images: they are no unknowns. */
static uint8_t *nodes_that_follow(const struct mesh *mesh)
{
    uint8_t *follows = NEW("statics.follows", mesh->grid.n, uint8_t);
    for (int64_t k = 0; k < mesh->grid.mirror_nodes; k++) follows[mesh->grid.mirror_node[k].node] = 1;
    return follows;
}

/* Counts the unknowns, or lists them where there is room. */
static int64_t nodes_list(const struct engine *e, int32_t *node, int64_t *particles)
{
    const struct particles *p = &e->part;
    const struct mesh *mesh = &e->reference.mesh;
    int64_t n = 0;
    for (int64_t k = 0; k < p->n_of[KIND_PD]; k++, n++)
        if (node) node[n] = p->list[KIND_PD][k];
    *particles = n;
    if (mesh->points == 0) return n;
    uint8_t *follows = nodes_that_follow(mesh);
    for (int64_t I = 0; I < mesh->grid.n; I++)
        if (node_moves(mesh, I) && !follows[I]) {
            if (node) node[n] = (int32_t)I;
            n++;
        }
    memory_free(follows);
    return n;
}

static void statics_hold(struct statics *s, int64_t k, int d, int load)
{
    s->balance.held[k] |= (uint8_t)(1 << d);
    s->load[k * DIM_MAX + d] = (int16_t)load;
}

/* Particles on planes of symmetry: no force takes them off the plane, and half of each belongs to the body. */
static void particles_on_mirrors(struct engine *e)
{
    struct statics *s = &e->statics;
    const struct particles *p = &e->part;
    for (int b = 0; b < e->loads.n; b++) {
        const struct boundary *m = e->loads.load[b].boundary;
        for (int64_t k = 0; m->kind == BOUNDARY_MIRROR && k < s->particles; k++) {
            const int32_t i = s->node[k];
            if (fabs(p->X[m->axis][i] - m->at) > ON_SURFACE * e->scene->spacing) continue;
            if (m->body >= 0 && p->body[i] != m->body) continue;
            s->weight[k] *= 0.5;
            for (int d = 0; d < p->dim; d++)
                if (d == m->axis || m->hold_tangential) statics_hold(s, k, d, -1);
        }
    }
}

/* Components that supports hold, of particles and of nodes; of two that overlap the later one holds. */
static void supports_hold(struct engine *e, const int32_t *particle_at, const int32_t *node_of_mesh)
{
    const struct constrained_set *walls = &e->loads.constrained_mesh;
    for (int b = 0; b < e->loads.n; b++) {
        const struct load *load = &e->loads.load[b];
        for (int64_t q = 0; load->boundary->kind == BOUNDARY_VELOCITY && q < load->n; q++)
            for (int d = 0; d < e->part.dim; d++)
                if (particle_at[load->particle[q]] >= 0 && load->boundary->components >> d & 1)
                    statics_hold(&e->statics, particle_at[load->particle[q]], d, b);
    }
    for (int64_t q = 0; e->reference.mesh.points > 0 && q < walls->n; q++) {
        const struct held *h = &walls->held[q];
        const bool drives = e->loads.load[h->load].boundary->kind == BOUNDARY_VELOCITY;
        if (node_of_mesh[h->node] >= 0)
            statics_hold(&e->statics, node_of_mesh[h->node], h->component, drives ? h->load : -1);
    }
}

/* Displacements where particles and nodes are now. */
static void displacements_take(struct engine *e)
{
    const struct statics *s = &e->statics;
    for (int d = 0; d < e->part.dim; d++)
        for (int64_t k = 0; k < s->balance.n; k++)
            s->balance.u.of[d][k] = k < s->particles ? e->part.x[d][s->node[k]] - e->part.X[d][s->node[k]]
                                                     : e->reference.mesh.displacement[d][s->node[k]];
}

/* Stiffness of the body at unit strain: sum E V [J]. */
static real energy_at_unit_strain(const struct engine *e)
{
    real sum = 0;
    for (int64_t i = 0; i < e->part.n; i++) sum += e->scene->material[e->part.material[i]].young * e->part.volume0[i];
    return sum;
}

static void statics_forces(void *context, const struct field *u, struct field *f);
static void applied_make(struct engine *e, real t);

void statics_unknowns_make(struct engine *e)
{
    struct statics *s = &e->statics;
    const struct mesh *mesh = &e->reference.mesh;
    const int64_t n = nodes_list(e, NULL, &s->particles), places = mesh->points > 0 ? mesh->grid.n : 0;
    int32_t *particle_at = BARE("statics.particle_at", e->part.n, int32_t);
    int32_t *node_at = BARE("statics.node_at", places, int32_t);
    struct equilibrium kept = s->balance; /* its accounts go on */
    s->node = NEW("statics.node", n, int32_t);
    s->weight = NEW("statics.weight", n, real);
    s->load = NEW("statics.load", n * DIM_MAX, int16_t);
    nodes_list(e, s->node, &s->particles);
    s->balance = (struct equilibrium){.force = statics_forces,
                                      .precondition = statics_precondition,
                                      .context = e,
                                      .tolerance = e->scene->solver_tolerance,
                                      .unit_energy = energy_at_unit_strain(e),
                                      .forces = kept.forces,
                                      .directions = kept.directions,
                                      .lost = kept.lost};
    equilibrium_make(&s->balance, e->part.dim, n);
    for (int d = 0; d < e->part.dim; d++) {
        s->way.of[d] = NEW("statics.way", n, real);
    }
    memset(particle_at, -1, (size_t)e->part.n * sizeof *particle_at);
    memset(node_at, -1, (size_t)places * sizeof *node_at);
    for (int64_t k = 0; k < n; k++) {
        (k < s->particles ? particle_at : node_at)[s->node[k]] = (int32_t)k;
        s->weight[k] = 1;
        for (int d = 0; d < DIM_MAX; d++) s->load[k * DIM_MAX + d] = -1;
    }
    particles_on_mirrors(e);
    supports_hold(e, particle_at, node_at);
    displacements_take(e);
    memory_free(particle_at);
    memory_free(node_at);
}

void statics_unknowns_free(struct engine *e)
{
    struct statics *s = &e->statics;
    const struct equilibrium kept = s->balance;
    equilibrium_free(&s->balance);
    s->balance.forces = kept.forces, s->balance.directions = kept.directions, s->balance.lost = kept.lost;
    memory_free(s->node);
    memory_free(s->weight);
    memory_free(s->load);
    for (int d = 0; d < DIM_MAX; d++) memory_free(s->way.of[d]);
    s->node = NULL, s->weight = NULL, s->load = NULL;
    s->way = (struct field){{0}};
}

void statics_free(struct engine *e)
{
    struct statics *s = &e->statics;
    statics_precondition_free(e);
    statics_unknowns_free(e);
    for (int d = 0; d < DIM_MAX; d++) memory_free(s->applied[d]), s->applied[d] = NULL;
    for (int k = 0; k < 2; k++) memory_free(s->plastic[k]), s->plastic[k] = NULL;
    memory_free(s->next.bond);
    s->next = (struct break_list){0};
}

status statics_archive(struct engine *e, struct archive *a)
{
    struct statics *s = &e->statics;
    struct equilibrium *q = &s->balance;
    if (!scene_in_steps(e->scene)) return OK;
    if (!a->saving || !s->node) statics_unknowns_free(e), statics_unknowns_make(e);
    for (int d = 0; d < e->part.dim; d++) {
        char name[48];
        snprintf(name, sizeof name, "statics/u%d", d);
        TRY(a->exchange(a, name, q->u.of[d], (size_t)q->n * sizeof(real)));
        snprintf(name, sizeof name, "statics/f%d", d);
        TRY(a->exchange(a, name, q->f.of[d], (size_t)q->n * sizeof(real)));
    }
    ARCHIVE_VALUE(a, "statics/t", s->t);
    ARCHIVE_VALUE(a, "statics/overload", s->overload);
    ARCHIVE_VALUE(a, "statics/due", s->due);
    ARCHIVE_VALUE(a, "statics/advances", s->advances);
    ARCHIVE_VALUE(a, "statics/ahead", s->ahead);
    ARCHIVE_VALUE(a, "statics/behind", s->behind);
    TRY(statics_list_archive(e, a));
    ARCHIVE_VALUE(a, "statics/lost", q->lost);
    ARCHIVE_VALUE(a, "statics/strain_ratio", q->strain_ratio);
    ARCHIVE_VALUE(a, "statics/forces", q->forces);
    ARCHIVE_VALUE(a, "statics/directions", q->directions);
    if (!a->saving) applied_make(e, e->statics.t), statics_plastic_keep(e);
    return OK;
}

/* ---- forces ------------------------------------------------------------------------------------------------------ */

void statics_place(struct engine *e, const struct field *u)
{
    const struct statics *s = &e->statics;
    struct mesh *mesh = &e->reference.mesh;
    struct particles *p = &e->part;
    for (int d = 0; d < p->dim; d++) {
#pragma omp parallel for schedule(static)
        for (int64_t k = 0; k < s->balance.n; k++)
            if (k < s->particles)
                p->x[d][s->node[k]] = p->X[d][s->node[k]] + u->of[d][k];
            else
                mesh->displacement[d][s->node[k]] = u->of[d][k];
        for (int64_t k = mesh->grid.mirror_nodes - 1; mesh->points > 0 && k >= 0; k--) {
            const struct mirror_node *m = &mesh->grid.mirror_node[k];
            mesh->displacement[d][m->node] = m->sign[d] * mesh->displacement[d][m->image];
        }
    }
}

/* Forces of nodes beyond planes of symmetry belong to their images. */
static void mirror_nodes_give(struct mesh *mesh)
{
    for (int64_t k = 0; k < mesh->grid.mirror_nodes; k++) {
        const struct mirror_node *m = &mesh->grid.mirror_node[k];
        for (int d = 0; d < mesh->grid.dim && mesh->grid.mass[m->node] > 0; d++)
            mesh->grid.force[d][m->image] += m->sign[d] * mesh->grid.force[d][m->node];
    }
}

/* Yielding of bonds begins anew from the last equilibrium, whatever has been tried since. */
static void plastic_restore(struct engine *e)
{
    const size_t size = (size_t)(e->bonds.columns * LANES) * sizeof(real);
    if (!e->statics.plastic[0]) return;
    memcpy(e->bonds.plastic_stretch, e->statics.plastic[0], size);
    memcpy(e->bonds.plastic_path, e->statics.plastic[1], size);
}

void statics_plastic_keep(struct engine *e)
{
    struct statics *s = &e->statics;
    const int64_t n = e->bonds.columns * LANES;
    if (!e->bonds.plastic_stretch) return;
    for (int k = 0; k < 2; k++) {
        memory_free(s->plastic[k]);
        s->plastic[k] = BARE("statics.plastic", n, real);
        memcpy(s->plastic[k], k == 0 ? e->bonds.plastic_stretch : e->bonds.plastic_path, (size_t)n * sizeof(real));
    }
}

static void applied_add(struct engine *e)
{
    struct particles *p = &e->part;
    for (int b = 0; b < e->loads.n; b++) {
        const struct load *l = &e->loads.load[b];
        if (!boundary_is_force(l->boundary) || l->leader != b) continue;
        for (int d = 0; d < p->dim; d++)
            for (int64_t k = 0; k < l->n; k++) p->f[d][l->particle[k]] += e->statics.applied[d][l->particle[k]];
    }
}

/* The forces of a step (engine.c) without motion: of bonds, contact, loads and cells. */
static void forces_here(struct engine *e)
{
    const bool has_mesh = e->reference.mesh.points > 0;
    if (has_mesh) {
        mesh_exposed_move(&e->reference.mesh, &e->part);
        mesh_ends_update(&e->reference.mesh, &e->part, !e->scene->small_strain);
    }
    loads_mirror(&e->loads, &e->part);
    loads_clear(&e->loads, &e->part);
    plastic_restore(e);
    bond_forces(e->kernels.bond_force, &e->bonds, &e->part, &bond_limit_never, NULL);
    contact_force(&e->contact, &e->part, 0);
    applied_add(e);
    if (has_mesh) engine_nodes_force(e), mirror_nodes_give(&e->reference.mesh);
}

static void statics_forces(void *context, const struct field *u, struct field *f)
{
    struct engine *e = context;
    const struct statics *s = &e->statics;
    statics_place(e, u);
    forces_here(e);
    for (int d = 0; d < e->part.dim; d++) {
        const real *part = e->part.f[d], *node = e->reference.mesh.grid.force[d];
#pragma omp parallel for schedule(static)
        for (int64_t k = 0; k < s->balance.n; k++)
            f->of[d][k] = k < s->particles ? s->weight[k] * part[s->node[k]] : node[s->node[k]];
    }
}

/* ---- loads and supports ------------------------------------------------------------------------------------------ */

/* Applied forces at t, into `applied` [dim][particles of the body]. */
static void applied_make(struct engine *e, real t)
{
    const struct particles *p = &e->part;
    for (int d = 0; d < p->dim; d++) {
        if (!e->statics.applied[d]) e->statics.applied[d] = NEW("statics.applied", p->n, real);
        memset(e->statics.applied[d], 0, (size_t)p->n * sizeof(real));
    }
    for (int b = 0; b < e->loads.n; b++) {
        const struct load *l = &e->loads.load[b];
        for (int64_t k = 0; boundary_is_force(l->boundary) && k < l->n; k++) {
            real force[DIM_MAX];
            load_force_at(l, p, k, t, force);
            for (int d = 0; d < p->dim; d++) e->statics.applied[d][l->particle[k]] += force[d];
        }
    }
}

/* Place of a node of the unknowns [m]. */
void statics_node_place(const struct engine *e, int64_t k, real *X)
{
    const struct mesh *mesh = &e->reference.mesh;
    const int32_t i = e->statics.node[k];
    if (k < e->statics.particles) {
        particle_place(&e->part, i, X);
        return;
    }
    const int64_t at = mesh_base(mesh, i);
    for (int d = 0; d < e->part.dim; d++)
        X[d] = grid_position(&mesh->grid, d, at / mesh->grid.stride[d] % mesh->grid.count[d]);
}

/* How much more of the same t makes of supports and loads, of which `before` were there; 0 where it makes others. */
static real growth_to(const struct engine *e, real t, real *const *before)
{
    const struct statics *s = &e->statics;
    real now = 0, was = 0;
    for (int64_t k = 0; k < s->balance.n; k++)
        for (int d = 0; d < e->part.dim; d++) {
            const real u = s->balance.u.of[d][k];
            if (s->load[k * DIM_MAX + d] >= 0) now += u * (u + s->way.of[d][k]), was += u * u;
        }
    for (int d = 0; d < e->part.dim && was == 0; d++)
        for (int64_t i = 0; i < e->part.n; i++) now += s->applied[d][i] * before[d][i], was += square(before[d][i]);
    return was > 0 && t != e->statics.t ? now / was - 1 : 0;
}

/* The way to pseudo-time t: of supports what is prescribed, of the rest what a linear body does under proportional
 * loads. `before`: the applied forces until now. */
static void way_make(struct engine *e, real t, real *const *before)
{
    struct statics *s = &e->statics;
    struct displacing by[BOUNDARIES_MAX];
    for (int b = 0; b < e->loads.n; b++) by[b] = displacing_make(e->loads.load[b].boundary, e->part.dim, t);
    for (int64_t k = 0; k < s->balance.n; k++) {
        real X[DIM_MAX] = {0};
        if (s->balance.held[k]) statics_node_place(e, k, X);
        for (int d = 0; d < e->part.dim; d++) {
            const int load = s->load[k * DIM_MAX + d];
            const real u = s->balance.u.of[d][k];
            if (s->balance.held[k] >> d & 1) s->way.of[d][k] = (load < 0 ? 0 : displacing_at(&by[load], X, d)) - u;
        }
    }
    const real growth = growth_to(e, t, before);
    for (int d = 0; d < e->part.dim; d++)
        for (int64_t k = 0; k < s->balance.n; k++)
            if (!(s->balance.held[k] >> d & 1)) s->way.of[d][k] = growth * s->balance.u.of[d][k];
}

/* Norm of applied forces on free components [N]. */
static real applied_norm(const struct engine *e)
{
    const struct statics *s = &e->statics;
    real sum = 0;
    for (int d = 0; d < e->part.dim; d++)
        for (int64_t k = 0; k < s->particles; k++)
            if (!(s->balance.held[k] >> d & 1)) sum += square(s->weight[k] * s->applied[d][s->node[k]]);
    return sqrt(sum);
}

/* Norm of the forces that the round-off of positions makes, with a margin of ten [N]. */
static real round_off_of(const struct engine *e)
{
    real sum = 0;
    for (int64_t r = 0; r < e->bonds.rows; r++) {
        const int32_t i = e->bonds.particle[r];
        const real spring = 0.25 * bonds_row_bound(&e->bonds, &e->part, r);
        for (int d = 0; d < e->part.dim; d++) sum += square(spring * e->part.X[d][i] * DBL_EPSILON);
    }
    return 10 * sqrt(sum);
}

/* Books the force on supports, and their displacement. */
void statics_react(struct engine *e)
{
    const struct statics *s = &e->statics;
    for (int b = 0; b < e->loads.n; b++) {
        struct load *l = &e->loads.load[b];
        if (l->boundary->kind != BOUNDARY_VELOCITY) continue;
        const struct displacing by = displacing_make(l->boundary, e->part.dim, e->statics.t);
        memset(l->reaction, 0, sizeof l->reaction);
        for (int d = 0; d < e->part.dim; d++) {
            real sum = 0, X[DIM_MAX] = {0};
            if (!(l->boundary->components >> d & 1)) continue;
            for (int64_t q = 0; q < l->n; q++)
                particle_place(&e->part, l->particle[q], X), sum += displacing_at(&by, X, d);
            l->displacement[d] = l->n > 0 ? sum / (real)l->n : 0;
        }
    }
    for (int64_t k = 0; k < s->balance.n; k++)
        for (int d = 0; d < e->part.dim; d++) {
            const int load = s->load[k * DIM_MAX + d];
            if (load >= 0) e->loads.load[load].reaction[d] -= s->balance.f.of[d][k] / s->weight[k];
        }
}

/* What the work of a step adds up from: forces before it, and displacements. */
struct account {
    struct field u, f;
    real *applied[DIM_MAX];
};

static void account_begin(struct account *a, const struct engine *e)
{
    const struct statics *s = &e->statics;
    for (int d = 0; d < e->part.dim; d++) {
        a->u.of[d] = BARE("statics.account", s->balance.n, real);
        a->f.of[d] = BARE("statics.account", s->balance.n, real);
        a->applied[d] = BARE("statics.account", e->part.n, real);
        memcpy(a->u.of[d], s->balance.u.of[d], (size_t)s->balance.n * sizeof(real));
        memcpy(a->f.of[d], s->balance.f.of[d], (size_t)s->balance.n * sizeof(real));
        if (s->applied[d])
            memcpy(a->applied[d], s->applied[d], (size_t)e->part.n * sizeof(real));
        else
            memset(a->applied[d], 0, (size_t)e->part.n * sizeof(real));
    }
}

/* Work of supports and of applied forces over the step, each by the mean of its forces at both ends; *before holds
 * where loaded particles were. */
static void account_end(struct account *a, struct engine *e, real *const *before)
{
    struct statics *s = &e->statics;
    for (int d = 0; d < e->part.dim; d++) {
        for (int64_t k = 0; k < s->balance.n; k++)
            if (s->balance.held[k] >> d & 1)
                e->loads.constraint_work -=
                    0.5 * (a->f.of[d][k] + s->balance.f.of[d][k]) * (s->balance.u.of[d][k] - a->u.of[d][k]);
        for (int64_t i = 0; i < e->part.n; i++)
            e->loads.work += 0.5 * (a->applied[d][i] + s->applied[d][i]) * (e->part.x[d][i] - before[d][i]);
        memory_free(a->u.of[d]);
        memory_free(a->f.of[d]);
        memory_free(a->applied[d]);
    }
}

static status unbalanced(const struct engine *e);

status statics_solve(struct engine *e, real t)
{
    struct statics *s = &e->statics;
    struct account account;
    real *before[DIM_MAX] = {0};
    account_begin(&account, e);
    for (int d = 0; d < e->part.dim; d++) {
        before[d] = BARE("statics.before", e->part.n, real);
        memcpy(before[d], e->part.x[d], (size_t)e->part.n * sizeof(real));
    }
    applied_make(e, t);
    way_make(e, t, account.applied);
    s->balance.applied = applied_norm(e);
    if (!s->precondition) s->balance.noise = round_off_of(e);
    const int64_t asked = s->balance.directions;
    const real lost = s->balance.lost;
    const status found = equilibrium_find(&s->balance, &s->way, t != s->t);
    statics_place(e, &s->balance.u);
    engine_mesh_sync(e);
    e->statics.t = t;
    account_end(&account, e, before);
    e->coupling.damped += s->balance.lost - lost;
    for (int d = 0; d < e->part.dim; d++) memory_free(before[d]);
    statics_react(e);
    s->solutions++;
    statics_precondition_watch(e, s->balance.directions - asked);
    return found == OK ? OK : unbalanced(e);
}

/* FAILED, with the place of the largest residual and what helps. */
static status unbalanced(const struct engine *e)
{
    const struct statics *s = &e->statics;
    real X[DIM_MAX] = {0};
    if (s->balance.n > 0) statics_node_place(e, s->balance.worst, X);
    return status_set(FAILED,
                      "load step %lld, t = %.6g s: no equilibrium, the residual stays at %.3g of the load (%.3g is "
                      "wanted), most of it near x = %.6g, y = %.6g, z = %.6g m; see whether every part is held and "
                      "loads are what the body bears, or choose steps.control energy, more steps, or a larger "
                      "solver_tolerance",
                      (long long)e->clock.step + 1, e->statics.t, s->balance.residual, e->scene->solver_tolerance, X[0],
                      X[1], X[2]);
}
