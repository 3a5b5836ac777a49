/* Load steps: the unknowns of a body, and the forces on them. */
#include "statics_internal.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "base/team.h"
#include "kernels/kernels.h"
#include "mesh/mesh_part.h"
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
static int64_t nodes_list(const struct run *e, int32_t *node, int64_t *particles)
{
    const struct particles *p = &e->part;
    const struct mesh *mesh = &e->frame->mesh;
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
static void particles_on_mirrors(struct run *e)
{
    struct statics *s = e->statics;
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
static void supports_hold(struct run *e, const int32_t *particle_at, const int32_t *node_of_mesh)
{
    const struct constrained_set *walls = &e->loads.constrained_mesh;
    for (int b = 0; b < e->loads.n; b++) {
        const struct load *load = &e->loads.load[b];
        for (int64_t q = 0; load->boundary->kind == BOUNDARY_VELOCITY && q < load->n; q++)
            for (int d = 0; d < e->part.dim; d++)
                if (particle_at[load->particle[q]] >= 0 && load->boundary->components >> d & 1)
                    statics_hold(e->statics, particle_at[load->particle[q]], d, b);
    }
    for (int64_t q = 0; e->frame->mesh.points > 0 && q < walls->n; q++) {
        const struct held *h = &walls->held[q];
        const bool drives = e->loads.load[h->load].boundary->kind == BOUNDARY_VELOCITY;
        if (node_of_mesh[h->node] >= 0)
            statics_hold(e->statics, node_of_mesh[h->node], h->component, drives ? h->load : -1);
    }
}

/* Displacements where particles and nodes are now. */
static void displacements_take(struct run *e)
{
    const struct statics *s = e->statics;
    for (int d = 0; d < e->part.dim; d++)
        for (int64_t k = 0; k < s->balance.n; k++)
            s->balance.u.of[d][k] = k < s->particles ? e->part.x[d][s->node[k]] - e->part.X[d][s->node[k]]
                                                     : e->frame->mesh.displacement[d][s->node[k]];
}

/* Stiffness of the body at unit strain: sum E V [J]. */
static real energy_at_unit_strain(const struct run *e)
{
    real sum = 0;
    for (int64_t i = 0; i < e->part.n; i++) sum += e->scene->material[e->part.material[i]].young * e->part.volume0[i];
    return sum;
}

static void statics_forces(void *context, const struct field *u, struct field *f);

void statics_unknowns_make(struct run *e)
{
    struct statics *s = e->statics;
    const struct mesh *mesh = &e->frame->mesh;
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
                                      .settle = statics_touch_settle,
                                      .laws = statics_touch_laws,
                                      .context = e,
                                      .tolerance = e->scene->solver_tolerance,
                                      .length = e->scene->spacing,
                                      .unit_energy = energy_at_unit_strain(e),
                                      .kinked = e->part.relief[0] != NULL,
                                      .forces = kept.forces,
                                      .directions = kept.directions,
                                      .lost = kept.lost,
                                      .largest = kept.largest};
    equilibrium_make(&s->balance, e->part.dim, n);
    for (int d = 0; d < e->part.dim; d++) {
        s->way.of[d] = NEW("statics.way", n, real);
    }
    array_fill_bytes(particle_at, -1, e->part.n, sizeof *particle_at);
    array_fill_bytes(node_at, -1, places, sizeof *node_at);
    for (int64_t k = 0; k < n; k++) {
        (k < s->particles ? particle_at : node_at)[s->node[k]] = (int32_t)k;
        s->weight[k] = 1;
        for (int d = 0; d < DIM_MAX; d++) s->load[k * DIM_MAX + d] = -1;
    }
    particles_on_mirrors(e);
    supports_hold(e, particle_at, node_at);
    displacements_take(e);
    statics_pieces_make(e);
    statics_plastic_keep(e);
    memory_free(particle_at);
    memory_free(node_at);
}

void statics_unknowns_free(struct run *e)
{
    struct statics *s = e->statics;
    const struct equilibrium kept = s->balance;
    statics_pieces_free(e);
    equilibrium_free(&s->balance);
    s->balance.forces = kept.forces, s->balance.directions = kept.directions, s->balance.lost = kept.lost;
    s->balance.largest = kept.largest;
    memory_free(s->node);
    memory_free(s->weight);
    memory_free(s->load);
    for (int d = 0; d < DIM_MAX; d++) memory_free(s->way.of[d]);
    s->node = NULL, s->weight = NULL, s->load = NULL;
    s->way = (struct field){{0}};
}

void statics_free(struct run *e)
{
    struct statics *s = e->statics;
    statics_precondition_free(e);
    statics_unknowns_free(e);
    for (int d = 0; d < DIM_MAX; d++) memory_free(s->applied[d]), s->applied[d] = NULL;
    for (int k = 0; k < PLASTIC_MOST; k++) memory_free(s->plastic[k]), s->plastic[k] = NULL;
    memory_free(s->next.bond);
    s->next = (struct break_list){0};
}

status statics_archive(struct run *e, struct archive *a)
{
    struct statics *s = e->statics;
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
    ARCHIVE_VALUE(a, "statics/touches", s->touches);
    ARCHIVE_VALUE(a, "statics/overload", s->overload);
    ARCHIVE_VALUE(a, "statics/released_time", s->released_time);
    ARCHIVE_VALUE(a, "statics/due", s->due);
    ARCHIVE_VALUE(a, "statics/advances", s->advances);
    ARCHIVE_VALUE(a, "statics/ahead", s->ahead);
    ARCHIVE_VALUE(a, "statics/behind", s->behind);
    TRY(statics_list_archive(e, a));
    TRY(led_archive(e, a));
    ARCHIVE_VALUE(a, "statics/lost", q->lost);
    ARCHIVE_VALUE(a, "statics/largest", q->largest);
    ARCHIVE_VALUE(a, "statics/strain_ratio", q->strain_ratio);
    ARCHIVE_VALUE(a, "statics/noise", q->noise);
    s->kept = s->precondition && !s->stale;
    ARCHIVE_VALUE(a, "statics/kept", s->kept);
    ARCHIVE_VALUE(a, "statics/forces", q->forces);
    ARCHIVE_VALUE(a, "statics/directions", q->directions);
    ARCHIVE_VALUE(a, "statics/solutions", s->solutions);
    ARCHIVE_VALUE(a, "statics/record", s->record);
    e->clock.load_step = s->record.step;
    if (!a->saving) statics_applied_make(e, e->statics->t), statics_plastic_keep(e);
    return OK;
}

/* ---- forces ------------------------------------------------------------------------------------------------------ */

void statics_place(struct run *e, const struct field *u)
{
    const struct statics *s = e->statics;
    struct mesh *mesh = &e->frame->mesh;
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

/* The arrays of what yields, and how many bytes they are; returns their number. */
static int plastic_state(const struct run *e, real *array[PLASTIC_MOST], size_t size[PLASTIC_MOST])
{
    const struct particles *p = &e->part;
    real *const of_bonds[] = {e->bonds.plastic_stretch, e->bonds.plastic_path};
    real *const of_points[] = {p->plastic_strain, p->out_of_plane};
    int n = 0;
    for (int k = 0; k < 2; k++)
        if (of_bonds[k]) size[n] = (size_t)(e->bonds.columns * LANES) * sizeof(real), array[n++] = of_bonds[k];
    for (int k = 0; k < 2 && p->relief[0]; k++)
        if (of_points[k]) size[n] = (size_t)p->n * sizeof(real), array[n++] = of_points[k];
    for (int k = 0; k < symmetric_count(p->dim) && p->relief[0]; k++)
        size[n] = (size_t)p->n * sizeof(real), array[n++] = p->relief[k];
    return n;
}

void statics_plastic_restore(struct run *e)
{
    real *array[PLASTIC_MOST];
    size_t size[PLASTIC_MOST];
    const int n = plastic_state(e, array, size);
    for (int k = 0; k < n && e->statics->plastic[k]; k++) array_copy(array[k], e->statics->plastic[k], 1, size[k]);
}

void statics_plastic_keep(struct run *e)
{
    struct statics *s = e->statics;
    real *array[PLASTIC_MOST];
    size_t size[PLASTIC_MOST];
    const int n = plastic_state(e, array, size);
    for (int k = 0; k < n; k++) {
        memory_free(s->plastic[k]);
        s->plastic[k] = BARE("statics.plastic", (int64_t)(size[k] / sizeof(real)), real);
        array_copy(s->plastic[k], array[k], 1, size[k]);
    }
}

static void applied_add(struct run *e)
{
    struct particles *p = &e->part;
    for (int b = 0; b < e->loads.n && e->statics->applied[0]; b++) {
        const struct load *l = &e->loads.load[b];
        if (!boundary_is_force(l->boundary) || l->leader != b) continue;
        for (int d = 0; d < p->dim; d++)
            for (int64_t k = 0; k < l->n; k++) p->f[d][l->particle[k]] += e->statics->applied[d][l->particle[k]];
    }
}

/* The forces of a step (step.c) without motion: of bonds, contact, loads and cells. */
static void forces_here(struct run *e)
{
    const bool has_mesh = e->frame->mesh.points > 0;
    if (has_mesh) {
        mesh_exposed_move(&e->frame->mesh, &e->part);
        mesh_ends_update(&e->frame->mesh, &e->part, !e->scene->small_strain);
    }
    loads_mirror(&e->loads, &e->part);
    loads_clear(&e->loads, &e->part);
    statics_plastic_restore(e); /* whatever has been tried since the last equilibrium */
    bond_forces(e->kernels.bond_force, &e->bonds, &e->part, &bond_limit_never, NULL);
    contact_force(e->contact, &e->part, 0);
    applied_add(e);
    if (has_mesh) frame_force(e), mirror_nodes_give(&e->frame->mesh);
}

static void statics_forces(void *context, const struct field *u, struct field *f)
{
    struct run *e = context;
    const struct statics *s = e->statics;
    statics_place(e, u);
    forces_here(e);
    for (int d = 0; d < e->part.dim; d++) {
        const real *part = e->part.f[d], *node = e->frame->mesh.grid.force[d];
#pragma omp parallel for schedule(static)
        for (int64_t k = 0; k < s->balance.n; k++)
            f->of[d][k] = k < s->particles ? s->weight[k] * part[s->node[k]] : node[s->node[k]];
    }
    statics_pieces_hold(e, f);
}

void statics_flow(struct run *e)
{
    statics_place(e, &e->statics->balance.u);
    if (e->statics->plastic[0]) forces_here(e);
}
