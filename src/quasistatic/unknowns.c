/* Lists the unknowns of load steps, applies prescribed displacements to them, and computes the applied forces. */
#include <math.h>
#include <string.h>

#include "unknowns.h"

#include "base/memory.h"
#include "contact/contact.h"

/* ---- unknowns ---------------------------------------------------------------------------------------------------- */

/* Returns true if there is a mesh and its node I has mass, so that its displacement is unknown. */
static bool node_has_mass(const struct mesh *mesh, int64_t I) { return mesh->points > 0 && mesh->grid.mass[I] > 0; }

/* Returns an array [mesh->grid.n] that is 1 for mirror nodes, else 0. Mirror nodes are beyond a plane of symmetry and
 * move as the images of other nodes, so that they are no unknowns. The caller frees the array. */
static uint8_t *mirror_node_flags(const struct mesh *mesh)
{
    uint8_t *follows = NEW("statics.follows", mesh->grid.n, uint8_t);
    for (int64_t k = 0; k < mesh->grid.mirror_nodes; k++) follows[mesh->grid.mirror_node[k].node] = 1;
    return follows;
}

/* Lists the unknowns in node[]: the indices of the peridynamic particles of p, then those of the nodes of `mesh` with
 * mass that are no mirror nodes. *particles: receives the number of particles among them. node = NULL: the unknowns are
 * only counted. Returns their number. */
static int64_t nodes_list(const struct particles *p, const struct mesh *mesh, int32_t *node, int64_t *particles)
{
    int64_t n = 0;
    for (int64_t k = 0; k < p->n_of[KIND_PD]; k++, n++)
        if (node) node[n] = p->list[KIND_PD][k];
    *particles = n;
    if (mesh->points == 0) return n;
    uint8_t *follows = mirror_node_flags(mesh);
    for (int64_t I = 0; I < mesh->grid.n; I++)
        if (node_has_mass(mesh, I) && !follows[I]) {
            if (node) node[n] = (int32_t)I;
            n++;
        }
    memory_free(follows);
    return n;
}

/* Marks component d (0 .. dim - 1) of unknown k of s as prescribed. load: number of the boundary that prescribes it, -1
 * for a plane of symmetry. */
static void component_hold(struct statics *s, int64_t k, int d, int load)
{
    s->balance.held[k] |= (uint8_t)(1 << d);
    s->load[k * DIM_MAX + d] = (int16_t)load;
}

/* Marks in s the particles of p on planes of symmetry in `loads` (of the body of the plane only, if it names one):
 * their normal displacement is prescribed as 0, on clamped planes every component, and their weight is halved, since
 * half of such a particle belongs to the body. */
static void mirror_particles_mark(struct statics *s, const struct particles *p, const struct loads *loads)
{
    for (int b = 0; b < loads->n; b++) {
        const struct boundary *m = loads->load[b].boundary;
        for (int64_t k = 0; m->kind == BOUNDARY_MIRROR && k < s->particles; k++) {
            const int32_t i = s->node[k];
            if (fabs(p->X[m->axis][i] - m->at) > ON_SURFACE * s->balance.length) continue;
            if (m->body >= 0 && p->body[i] != m->body) continue;
            s->weight[k] *= 0.5;
            for (int d = 0; d < p->dim; d++)
                if (d == m->axis || m->hold_tangential) component_hold(s, k, d, -1);
        }
    }
}

/* Marks in s the components of particles and nodes of `mesh` that supports in `loads` prescribe, each with the single
 * support that prescribes it. particle_at, node_of_mesh: unknown of each particle and of each mesh node, -1: none. */
static void supports_mark(struct statics *s, const struct loads *loads, const struct mesh *mesh,
                          const int32_t *particle_at, const int32_t *node_of_mesh)
{
    const struct constrained_set *walls = &loads->constrained_mesh;
    for (int b = 0; b < loads->n; b++) {
        const struct load *load = &loads->load[b];
        for (int64_t q = 0; load->boundary->kind == BOUNDARY_VELOCITY && q < load->n; q++)
            for (int d = 0; d < s->balance.dim; d++)
                if (particle_at[load->particle[q]] >= 0 && load->prescribes[q] >> d & 1)
                    component_hold(s, particle_at[load->particle[q]], d, b);
    }
    for (int64_t q = 0; mesh->points > 0 && q < walls->n; q++) {
        const struct held *h = &walls->held[q];
        const bool drives = loads->load[h->load].boundary->kind == BOUNDARY_VELOCITY;
        const int32_t k = node_of_mesh[h->node];
        if (k >= 0 && !h->overruled) component_hold(s, k, h->component, drives ? h->load : -1);
    }
}

/* Stores the present displacements of all unknowns (particles of p, nodes of `mesh`) in s->balance.u [m]. */
static void displacements_read(struct statics *s, const struct particles *p, const struct mesh *mesh)
{
    for (int d = 0; d < p->dim; d++)
        for (int64_t k = 0; k < s->balance.n; k++)
            s->balance.u.of[d][k] =
                k < s->particles ? p->x[d][s->node[k]] - p->X[d][s->node[k]] : mesh->displacement[d][s->node[k]];
}

void unknowns_list_particles_and_nodes(struct statics *s, const struct particles *p, const struct mesh *mesh,
                                       const struct loads *loads)
{
    const int64_t n = nodes_list(p, mesh, NULL, &s->particles), places = mesh->points > 0 ? mesh->grid.n : 0;
    int32_t *particle_at = BARE("statics.particle_at", p->n, int32_t);
    int32_t *node_at = BARE("statics.node_at", places, int32_t);
    s->node = NEW("statics.node", n, int32_t);
    s->weight = NEW("statics.weight", n, real);
    s->load = NEW("statics.load", n * DIM_MAX, int16_t);
    nodes_list(p, mesh, s->node, &s->particles);
    newton_solver_make(&s->balance, p->dim, n);
    for (int d = 0; d < p->dim; d++) s->increment.of[d] = NEW("statics.increment", n, real);
    array_fill_bytes(particle_at, -1, p->n, sizeof *particle_at);
    array_fill_bytes(node_at, -1, places, sizeof *node_at);
    for (int64_t k = 0; k < n; k++) {
        (k < s->particles ? particle_at : node_at)[s->node[k]] = (int32_t)k;
        s->weight[k] = 1;
        for (int d = 0; d < DIM_MAX; d++) s->load[k * DIM_MAX + d] = -1;
    }
    mirror_particles_mark(s, p, loads);
    supports_mark(s, loads, mesh, particle_at, node_at);
    displacements_read(s, p, mesh);
    memory_free(particle_at);
    memory_free(node_at);
}

void unknowns_free(struct statics *s)
{
    newton_solver_free(&s->balance);
    memory_free(s->node);
    memory_free(s->weight);
    memory_free(s->load);
    for (int d = 0; d < DIM_MAX; d++) memory_free(s->increment.of[d]);
    s->node = NULL, s->weight = NULL, s->load = NULL;
    s->increment = (struct field){{0}};
}

/* ---- positions --------------------------------------------------------------------------------------------------- */

/* Stores the reference position of unknown number `unknown_number` of s, a particle of p or a node of `mesh`, in
 * position[dim] [m]. */
void unknown_compute_reference_position(const struct statics *s, const struct particles *p, const struct mesh *mesh,
                                        int64_t unknown_number, real *position)
{
    const int32_t i = s->node[unknown_number];
    if (unknown_number < s->particles) {
        particle_reference_position(p, i, position);
        return;
    }
    const int64_t at = mesh_original_node_of_doubled_node(mesh, i);
    for (int d = 0; d < p->dim; d++)
        position[d] = grid_node_position(&mesh->grid, d, at / mesh->grid.stride[d] % mesh->grid.count[d]);
}

void unknowns_apply_displacements(const struct statics *s, struct particles *p, struct mesh *mesh,
                                  const struct field *displacement)
{
    for (int d = 0; d < p->dim; d++) {
#pragma omp parallel for schedule(static)
        for (int64_t k = 0; k < s->balance.n; k++)
            if (k < s->particles)
                p->x[d][s->node[k]] = p->X[d][s->node[k]] + displacement->of[d][k];
            else
                mesh->displacement[d][s->node[k]] = displacement->of[d][k];
        for (int64_t k = mesh->grid.mirror_nodes - 1; mesh->points > 0 && k >= 0; k--) {
            const struct mirror_node *m = &mesh->grid.mirror_node[k];
            mesh->displacement[d][m->node] = m->sign[d] * mesh->displacement[d][m->image];
        }
    }
}

void mirror_image_compute_displacement_signs(const struct particles *p, const struct loads *loads, int64_t image,
                                             real sign[DIM_MAX])
{
    for (int d = 0; d < DIM_MAX; d++) sign[d] = 1;
    for (; image >= p->n; image = loads->image[image - p->n].source) {
        const struct boundary *b = loads->load[loads->image[image - p->n].load].boundary;
        for (int d = 0; d < p->dim; d++)
            if (d == b->axis || b->hold_tangential) sign[d] = -sign[d];
    }
}

/* ---- loads and supports ------------------------------------------------------------------------------------------ */

/* Computes the forces that `loads` apply at pseudo_time [s] and stores them in s->applied[dim][particles] [N].
 * Allocates these arrays on the first call; statics_free releases them. p: all particles. */
void applied_forces_compute(struct statics *s, const struct particles *p, const struct loads *loads, real pseudo_time)
{
    for (int d = 0; d < p->dim; d++) {
        if (!s->applied[d]) s->applied[d] = NEW("statics.applied", p->n, real);
        array_fill_bytes(s->applied[d], 0, p->n, sizeof(real));
    }
    for (int b = 0; b < loads->n; b++) {
        const struct load *l = &loads->load[b];
        for (int64_t k = 0; boundary_applies_force(l->boundary) && k < l->n; k++) {
            real force[DIM_MAX];
            load_force_on_particle(l, p, k, pseudo_time, force);
            for (int d = 0; d < p->dim; d++) s->applied[d][l->particle[k]] += force[d];
        }
    }
}

/* Returns an array [p->n] with a bit set for each particle: bit d is 1 if a support in `loads` prescribes component d
 * of the displacement of the particle. The caller frees it with memory_free. */
static uint8_t *particles_prescribed_components(const struct particles *p, const struct loads *loads)
{
    uint8_t *prescribed = NEW("statics.prescribed", p->n, uint8_t);
    for (int b = 0; b < loads->n; b++) {
        const struct load *l = &loads->load[b];
        for (int64_t k = 0; l->boundary->kind == BOUNDARY_VELOCITY && k < l->n; k++)
            prescribed[l->particle[k]] |= (uint8_t)l->boundary->components;
    }
    return prescribed;
}

real applied_forces_norm(const struct statics *s, const struct particles *p, const struct loads *loads,
                         const struct contact *c)
{
    uint8_t *prescribed = particles_prescribed_components(p, loads);
    real sum = 0;
    for (int d = 0; d < p->dim; d++) {
        for (int64_t k = 0; k < s->particles; k++)
            if (!(s->balance.held[k] >> d & 1)) sum += square(s->weight[k] * s->applied[d][s->node[k]]);
        for (int64_t i = 0; i < p->n; i++)
            if (p->kind[i] != KIND_PD && !(prescribed[i] >> d & 1)) sum += square(s->applied[d][i]);
    }
    memory_free(prescribed);
    return hypot(sqrt(sum), contact_rigid_body_force_norm(c, p));
}

void reactions_compute_and_store(const struct statics *s, const struct particles *p, struct loads *loads)
{
    for (int b = 0; b < loads->n; b++) {
        struct load *l = &loads->load[b];
        if (boundary_applies_force(l->boundary)) load_compute_total_force_and_mean_displacement(l, p, s->t);
        if (l->boundary->kind != BOUNDARY_VELOCITY) continue;
        const struct prescribed_displacement by = boundary_prescribed_displacement_at_time(l->boundary, p->dim, s->t);
        memset(l->reaction, 0, sizeof l->reaction);
        for (int d = 0; d < p->dim; d++) {
            real sum = 0, X[DIM_MAX] = {0};
            if (!(l->boundary->components >> d & 1)) continue;
            for (int64_t q = 0; q < l->n; q++)
                particle_reference_position(p, l->particle[q], X),
                    sum += prescribed_displacement_component_at_position(&by, X, d);
            l->displacement[d] = l->n > 0 ? sum / (real)l->n : 0;
        }
    }
    for (int64_t k = 0; k < s->balance.n; k++)
        for (int d = 0; d < p->dim; d++) {
            const int load = s->load[k * DIM_MAX + d];
            if (load >= 0) loads->load[load].reaction[d] -= s->balance.f.of[d][k] / s->weight[k];
        }
}
