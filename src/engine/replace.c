/* A run is made again in its middle with other particles of the same body (hollow_part.c), and takes over all that
 * its steps have changed. */
#include <string.h>

#include "base/memory.h"
#include "mesh/mesh_part.h"
#include "coupling/coupling_part.h"
#include "probes/probes_part.h"
#include "step/stability.h"
#include "step/report.h"
#include "contact/contact.h"
#include "fracture/fracture_part.h"
#include "engine_internal.h"
#include "probes/diagnostics.h"

/* Numbers of the particles and images of `old` in e, -1: not there. Both are in the order of their ids. The caller
 * frees them. */
static int32_t *numbers_now(const struct particles *p, const struct loads *loads, const struct run *old)
{
    const struct particles *q = &old->part;
    int32_t *now = NEW("replace.now", q->n_all, int32_t);
    int64_t i = 0, k = 0;
    for (int64_t j = 0; j < q->n; j++) {
        while (i < p->n && p->id[i] < q->id[j]) i++;
        now[j] = i < p->n && p->id[i] == q->id[j] ? (int32_t)i : -1;
    }
    for (int64_t j = 0; j < old->loads.images; j++) {
        const struct image *was = &old->loads.image[j];
        const int32_t source = now[was->source];
        int64_t next = k;
        while (source >= 0 && next < loads->images &&
               (loads->image[next].source != source || loads->image[next].load != was->load))
            next++;
        const bool found = source >= 0 && next < loads->images;
        now[q->n + j] = found ? (int32_t)(p->n + next) : -1;
        if (found) k = next + 1;
    }
    return now;
}

void engine_take_particles(struct run *e, struct predecessor *before)
{
    before->now = numbers_now(&e->part, &e->loads, before->run);
    particles_take(&e->part, &before->run->part, before->now, e->optional);
    particles_list(&e->part);
    bonds_images_follow(&e->part, &e->source);
}

void engine_take_bonds(struct run *e, const struct predecessor *before)
{
    struct run *old = before->run;
    bonds_take(&e->bonds, &e->part, &old->bonds, &old->part, before->now);
    state_weigh(&e->bonds, &e->part, &e->source);
    bonds_free(&old->bonds);
    particles_free(&old->part);
}

/* Frees what is made anew from particles and scene: large bodies have no room for two of it. Of the mesh the motion of
 * its nodes is left. */
static void leave_derived(struct run *e)
{
    struct mesh *mesh = &e->frame->mesh, moved = {.grid = {.n = mesh->grid.n, .dim = mesh->grid.dim}};
    for (int d = 0; d < e->part.dim; d++) {
        moved.displacement[d] = mesh->displacement[d], moved.grid.velocity[d] = mesh->grid.velocity[d];
        mesh->displacement[d] = mesh->grid.velocity[d] = NULL;
    }
    mesh_free(mesh);
    *mesh = moved;
    partial_stress_free(&e->coupling->partial);
    interface_zone_free(&e->coupling->zone);
    cells_free(&e->cells);
}

static void swap_arrays(real **a, real **b, int dim)
{
    for (int d = 0; d < dim; d++) {
        real *kept = a[d];
        a[d] = b[d], b[d] = kept;
    }
}

/* The motion of all nodes, and the coarse cells. */
static void nodes_take(struct run *e, struct run *old)
{
    struct reference_frame *r = e->frame, *was = old->frame;
    INVARIANT(r->mesh.grid.n == was->mesh.grid.n);
    swap_arrays(r->mesh.displacement, was->mesh.displacement, e->part.dim);
    swap_arrays(r->mesh.grid.velocity, was->mesh.grid.velocity, e->part.dim);
    r->speed = was->speed;
    r->levels = was->levels;
    r->levels.fine = &r->mesh;
    was->levels = (struct mesh_levels){0};
    r->coarse = was->coarse, was->coarse = NULL;
    levels_follow_fine(&r->levels, &e->part, &r->source);
    frame_levels_found(e);
    frame_sync_points(e, NULL, 0);
    ends_update(e);
}

/* Accounts and figures that do not depend on which particles are made. */
static void accounts_take(struct run *e, struct run *old)
{
    loads_take(&e->loads, &old->loads);
    probes_take(&e->probing->probes, &old->probing->probes);
    e->damped = old->damped;
    e->coupling->conversion = old->coupling->conversion;
    *e->diagnostics = *old->diagnostics;
    *e->stability = *old->stability;
    e->probing->residual_step0 = old->probing->residual_step0;
    e->warnings = old->warnings, e->laps = old->laps;
    old->warnings = (struct warnings){0};
    *e->report = *old->report;
    *old->report = (struct run_report){.out = NULL};
}

static status run_replace(struct run *e)
{
    struct run *old = NEW("replace.old", 1, struct run);
    struct predecessor before = {.run = old};
    const struct hollow hollow = e->frame->hollow;
    *old = *e;
    old->frame->hollow = (struct hollow){0};
    memory_reuse(false);
    leave_derived(old);
    status s = engine_make_again(e, old->scene, NULL, hollow, &before);
    if (s == OK) {
        nodes_take(e, old);
        contact_take(e->contact, old->contact, before.now, e->part.n);
        if (e->contact->made) contact_follow(e->contact, &e->part, &e->bonds, &e->loads);
        tips_take(&e->fracture->tips, &old->fracture->tips, before.now);
        accounts_take(e, old);
    }
    memory_free(before.now);
    engine_free(old);
    memory_free(old);
    memory_reuse(true);
    return s;
}

status engine_refill(struct run *e, const uint8_t *level)
{
    if (e->report->out) {
        TRY(output_wait(e->report->out));
        output_particles_changed(e->report->out);
    }
    frame_hollow_change(e, level);
    return run_replace(e);
}
