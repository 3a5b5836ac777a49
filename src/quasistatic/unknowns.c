/* Load steps: the unknowns of a body, and what loads and supports do to them. */
#include <math.h>
#include <string.h>

#include "unknowns.h"

#include "base/memory.h"
#include "contact/contact.h"

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
static int64_t nodes_list(const struct particles *p, const struct mesh *mesh, int32_t *node, int64_t *particles)
{
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
static void particles_on_mirrors(struct statics *s, const struct particles *p, const struct loads *loads)
{
    for (int b = 0; b < loads->n; b++) {
        const struct boundary *m = loads->load[b].boundary;
        for (int64_t k = 0; m->kind == BOUNDARY_MIRROR && k < s->particles; k++) {
            const int32_t i = s->node[k];
            if (fabs(p->X[m->axis][i] - m->at) > ON_SURFACE * s->balance.length) continue;
            if (m->body >= 0 && p->body[i] != m->body) continue;
            s->weight[k] *= 0.5;
            for (int d = 0; d < p->dim; d++)
                if (d == m->axis || m->hold_tangential) statics_hold(s, k, d, -1);
        }
    }
}

/* Components that supports hold, of particles and of nodes; of two that overlap the later one holds. */
static void supports_hold(struct statics *s, const struct loads *loads, const struct mesh *mesh,
                          const int32_t *particle_at, const int32_t *node_of_mesh)
{
    const struct constrained_set *walls = &loads->constrained_mesh;
    for (int b = 0; b < loads->n; b++) {
        const struct load *load = &loads->load[b];
        for (int64_t q = 0; load->boundary->kind == BOUNDARY_VELOCITY && q < load->n; q++)
            for (int d = 0; d < s->balance.dim; d++)
                if (particle_at[load->particle[q]] >= 0 && load->boundary->components >> d & 1)
                    statics_hold(s, particle_at[load->particle[q]], d, b);
    }
    for (int64_t q = 0; mesh->points > 0 && q < walls->n; q++) {
        const struct held *h = &walls->held[q];
        const bool drives = loads->load[h->load].boundary->kind == BOUNDARY_VELOCITY;
        if (node_of_mesh[h->node] >= 0) statics_hold(s, node_of_mesh[h->node], h->component, drives ? h->load : -1);
    }
}

/* Displacements where particles and nodes are now. */
static void displacements_take(struct statics *s, const struct particles *p, const struct mesh *mesh)
{
    for (int d = 0; d < p->dim; d++)
        for (int64_t k = 0; k < s->balance.n; k++)
            s->balance.u.of[d][k] =
                k < s->particles ? p->x[d][s->node[k]] - p->X[d][s->node[k]] : mesh->displacement[d][s->node[k]];
}

void unknowns_list(struct statics *s, const struct particles *p, const struct mesh *mesh, const struct loads *loads)
{
    const int64_t n = nodes_list(p, mesh, NULL, &s->particles), places = mesh->points > 0 ? mesh->grid.n : 0;
    int32_t *particle_at = BARE("statics.particle_at", p->n, int32_t);
    int32_t *node_at = BARE("statics.node_at", places, int32_t);
    s->node = NEW("statics.node", n, int32_t);
    s->weight = NEW("statics.weight", n, real);
    s->load = NEW("statics.load", n * DIM_MAX, int16_t);
    nodes_list(p, mesh, s->node, &s->particles);
    equilibrium_make(&s->balance, p->dim, n);
    for (int d = 0; d < p->dim; d++) s->way.of[d] = NEW("statics.way", n, real);
    array_fill_bytes(particle_at, -1, p->n, sizeof *particle_at);
    array_fill_bytes(node_at, -1, places, sizeof *node_at);
    for (int64_t k = 0; k < n; k++) {
        (k < s->particles ? particle_at : node_at)[s->node[k]] = (int32_t)k;
        s->weight[k] = 1;
        for (int d = 0; d < DIM_MAX; d++) s->load[k * DIM_MAX + d] = -1;
    }
    particles_on_mirrors(s, p, loads);
    supports_hold(s, loads, mesh, particle_at, node_at);
    displacements_take(s, p, mesh);
    memory_free(particle_at);
    memory_free(node_at);
}

void unknowns_unlist(struct statics *s)
{
    equilibrium_free(&s->balance);
    memory_free(s->node);
    memory_free(s->weight);
    memory_free(s->load);
    for (int d = 0; d < DIM_MAX; d++) memory_free(s->way.of[d]);
    s->node = NULL, s->weight = NULL, s->load = NULL;
    s->way = (struct field){{0}};
}

/* ---- where nodes are --------------------------------------------------------------------------------------------- */

void unknown_position(const struct statics *s, const struct particles *p, const struct mesh *mesh, int64_t k, real *X)
{
    const int32_t i = s->node[k];
    if (k < s->particles) {
        particle_place(p, i, X);
        return;
    }
    const int64_t at = mesh_base(mesh, i);
    for (int d = 0; d < p->dim; d++)
        X[d] = grid_position(&mesh->grid, d, at / mesh->grid.stride[d] % mesh->grid.count[d]);
}

void unknowns_move(const struct statics *s, struct particles *p, struct mesh *mesh, const struct field *u)
{
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

void image_signs(const struct particles *p, const struct loads *loads, int64_t i, real sign[DIM_MAX])
{
    for (int d = 0; d < DIM_MAX; d++) sign[d] = 1;
    for (; i >= p->n; i = loads->image[i - p->n].source) {
        const struct boundary *b = loads->load[loads->image[i - p->n].load].boundary;
        for (int d = 0; d < p->dim; d++)
            if (d == b->axis || b->hold_tangential) sign[d] = -sign[d];
    }
}

/* ---- loads and supports ------------------------------------------------------------------------------------------ */

void applied_forces_make(struct statics *s, const struct particles *p, const struct loads *loads, real t)
{
    for (int d = 0; d < p->dim; d++) {
        if (!s->applied[d]) s->applied[d] = NEW("statics.applied", p->n, real);
        array_fill_bytes(s->applied[d], 0, p->n, sizeof(real));
    }
    for (int b = 0; b < loads->n; b++) {
        const struct load *l = &loads->load[b];
        for (int64_t k = 0; boundary_is_force(l->boundary) && k < l->n; k++) {
            real force[DIM_MAX];
            load_force_at(l, p, k, t, force);
            for (int d = 0; d < p->dim; d++) s->applied[d][l->particle[k]] += force[d];
        }
    }
}

real applied_forces_norm(const struct statics *s, const struct particles *p, const struct contact *c)
{
    real sum = 0;
    for (int d = 0; d < p->dim; d++) {
        for (int64_t k = 0; k < s->particles; k++)
            if (!(s->balance.held[k] >> d & 1)) sum += square(s->weight[k] * s->applied[d][s->node[k]]);
        for (int64_t i = 0; i < p->n; i++)
            if (p->kind[i] != KIND_PD && !(p->flag[i] & FLAG_DRIVEN)) sum += square(s->applied[d][i]);
    }
    return hypot(sqrt(sum), contact_rigid_norm(c, p));
}

void reactions_store(const struct statics *s, const struct particles *p, struct loads *loads)
{
    for (int b = 0; b < loads->n; b++) {
        struct load *l = &loads->load[b];
        if (boundary_is_force(l->boundary)) load_applied_sum(l, p, s->t);
        if (l->boundary->kind != BOUNDARY_VELOCITY) continue;
        const struct displacing by = displacing_make(l->boundary, p->dim, s->t);
        memset(l->reaction, 0, sizeof l->reaction);
        for (int d = 0; d < p->dim; d++) {
            real sum = 0, X[DIM_MAX] = {0};
            if (!(l->boundary->components >> d & 1)) continue;
            for (int64_t q = 0; q < l->n; q++) particle_place(p, l->particle[q], X), sum += displacing_at(&by, X, d);
            l->displacement[d] = l->n > 0 ? sum / (real)l->n : 0;
        }
    }
    for (int64_t k = 0; k < s->balance.n; k++)
        for (int d = 0; d < p->dim; d++) {
            const int load = s->load[k * DIM_MAX + d];
            if (load >= 0) loads->load[load].reaction[d] -= s->balance.f.of[d][k] / s->weight[k];
        }
}
