/* Particles only where they are needed: cells of two spacings that are part of coarse cells have none. What needs them
 * is decided once for the start, and anew with the levels of cells: the particles are then made again from the lattice,
 * with the motion of the nodes around them. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "engine/engine.h"

enum { PAYS = 400000 };                  /* particles that need not be made, from which on that saves time */
enum { AHEAD = 4 };                      /* cells beyond those of level 0 that have particles: cracks run on */

/* ---- the start --------------------------------------------------------------------------------------------------- */

/* Why all particles of a scene are made; NULL: some need not be. */
static const char *hollow_obstacle(const struct scene *s)
{
    if (s->fill == FILL_ALL) return "the scene says so";
    if (s->method == METHOD_PD || s->solver != SOLVER_EXPLICIT || s->levels == 0) return "there are no coarse cells";
    if (s->bodies != 1 || s->rigids > 0) return "bodies may meet";
    if (s->body[0].file) return "they come from a list";
    if (s->body[0].frame == FRAME_CURRENT || scene_frame_not_default(s, 0)) return "the body is in the current frame";
    if (s->initials > 0 || dot(s->body[0].velocity, s->body[0].velocity, s->dim) > 0) return "the body moves at first";
    if (s->growths > 0) return "cracks grow by growth";
    if (s->method == METHOD_ADAPTIVE && s->conversion.reverts) return "peridynamic particles may become points again";
    if (s->method == METHOD_ADAPTIVE && s->surface == SURFACE_MOMENTS) return "pd.surface moments looks at all faces";
    if (s->contact_friction > 0) return "faces rub";
    for (int k = 0; k < s->probes; k++) {
        const enum probe_kind kind = s->probe[k].kind;
        if (kind != PROBE_TIP && kind != PROBE_BREAK && kind != PROBE_REACTION && kind != PROBE_POINT)
            return "a probe looks at many of them";
    }
    return NULL;
}

/* Places of the particles of cell I [m]. */
static void cell_place(const struct hollow *h, int64_t I, int corner, real *X)
{
    for (int d = 0; d < h->dim; d++)
        X[d] = h->anchor[d] +
               ((real)(h->first[d] + I / h->stride[d] % h->count[d]) + (corner >> d & 1 ? 0.75 : 0.25)) * h->h;
}

/* Box of cells round the body, aligned with the nodes of its mesh. */
static status box_find(struct hollow *h, const struct scene *s)
{
    real from[DIM_MAX], to[DIM_MAX], site[DIM_MAX], n = 1;
    TRY(fill_place(s, 0, site));
    region_bounds(&s->body[0].shape, s->dim, from, to);
    h->dim = s->dim, h->h = s->cell * s->spacing, h->n = 1;
    engine_grid_anchor(s, from, site, true, h->anchor);
    for (int d = 0; d < s->dim; d++) {
        h->first[d] = (int64_t)floor((from[d] - h->anchor[d]) / h->h) - 1;
        h->count[d] = (int64_t)floor((to[d] - h->anchor[d]) / h->h) - h->first[d] + 2;
        h->stride[d] = h->n;
        n *= (real)h->count[d];
        if (n > INT32_MAX) return status_set(REFUSED, "too large for the spacing");
        h->n *= h->count[d];
    }
    return OK;
}

/* Must a particle at X be made as the body has pre-cracks? */
static bool near_cracks(const struct scene *s, const struct bond_source *source, const real *X, real h)
{
    const real flank = source->family.cutoff + 2 * h;
    const real end = flank + source->family.cutoff +
                     real_max(s->conversion.tips * source->family.horizon, NOTCH_ZONE * s->spacing);
    for (int k = 0; k < s->cracks; k++) {
        const struct crack *c = &s->crack[k];
        if (crack_near(c, X, flank, s->dim)) return true;
        for (int a = 0; a < c->n; a++) {
            const real *from = c->corner[a], *to = s->dim == 3 ? c->corner[(a + 1) % c->n] : from;
            if (segment_distance(from, to, X, s->dim) <= end) return true;
        }
    }
    return false;
}

/* Does a load act on a particle at X, but for faces? */
static bool loads_reach(const struct scene *s, const real *X, real tolerance)
{
    for (int b = 0; b < s->boundaries; b++) {
        const struct boundary *load = &s->boundary[b];
        if (load->kind != BOUNDARY_MIRROR && load->kind != BOUNDARY_TRACTION && load->kind != BOUNDARY_ABSORBING &&
            region_contains(&load->region, X, s->dim, tolerance))
            return true;
    }
    return false;
}

/* Does a load act on the face of cell I, which it has where the cell beside it is not whole? */
static bool face_loaded(const struct scene *s, const struct hollow *h, int64_t I, const real *X)
{
    for (int b = 0; b < s->boundaries; b++) {
        const struct boundary *load = &s->boundary[b];
        if (load->kind != BOUNDARY_TRACTION && load->kind != BOUNDARY_ABSORBING) continue;
        const int64_t beside = I + (load->side > 0 ? 1 : -1) * h->stride[load->face];
        if ((beside < 0 || beside >= h->n || !h->whole[beside]) && region_contains(&load->region, X, s->dim, h->h))
            return true;
    }
    return false;
}

static bool probed(const struct scene *s, const real *X, real h)
{
    for (int k = 0; k < s->probes; k++) {
        real r2 = 0;
        for (int d = 0; d < s->dim; d++) r2 += square(s->probe[k].at[d] - X[d]);
        if (s->probe[k].kind == PROBE_POINT && r2 < square(3 * h)) return true;
    }
    return false;
}

/* Must any particle of cell I be made? */
static bool cell_needed(const struct engine *e, const struct hollow *h, int64_t I)
{
    const struct scene *s = e->scene;
    for (int c = 0; c < 1 << h->dim; c++) {
        real X[DIM_MAX] = {0};
        cell_place(h, I, c, X);
        if (loads_reach(s, X, s->spacing) || (c == 0 && (near_cracks(s, &e->source, X, h->h) || probed(s, X, h->h))) ||
            face_loaded(s, h, I, X))
            return true;
        if (s->has_pd_region && region_contains(&s->pd_region, X, h->dim, 2 * e->source.family.cutoff)) return true;
    }
    return false;
}

status engine_hollow_plan(struct engine *e)
{
    struct hollow *h = &e->reference.hollow;
    int64_t absent = 0;
    if (h->whole || h->restored || hollow_obstacle(e->scene)) return OK;
    TRY(box_find(h, e->scene));
    const int64_t least = e->scene->fill == FILL_NEEDED ? 0 : PAYS >> h->dim;
    if (h->n <= least) return OK;
    fill_whole(h, e->scene, 0);
    h->absent = NEW("hollow.absent", h->n, uint8_t);
#pragma omp parallel for schedule(dynamic, 4096) reduction(+ : absent)
    for (int64_t I = 0; I < h->n; I++) {
        h->absent[I] = h->whole[I] && !cell_needed(e, h, I);
        absent += h->absent[I];
    }
    if (absent > least) return OK;
    memory_free(h->absent);
    h->absent = NULL;
    return OK;
}

/* ---- levels ------------------------------------------------------------------------------------------------------ */

/* Number in the box of hollow cells of cell I of the mesh, -1: outside. */
static int64_t hollow_of(const struct hollow *h, const struct grid *g, int64_t I)
{
    int64_t J = 0;
    for (int d = 0; d < h->dim; d++) {
        const int64_t k = I / g->stride[d] % g->count[d] + g->first[d] - h->first[d];
        if (k < 0 || k >= h->count[d]) return -1;
        J += k * h->stride[d];
    }
    return J;
}

/* Has a cell of level 0 no particles? */
static bool any_lacks(const struct mesh *mesh, const uint8_t *level)
{
    for (int64_t I = 0; I < mesh->grid.n && mesh->absent; I++)
        if (mesh->absent[I] && level[I] == 0) return true;
    return false;
}

/* Coarse cells are hollow as a whole, or not at all. */
static void blocks_complete(const struct reference_frame *r, const uint8_t *level, uint8_t *absent)
{
    const struct hollow *h = &r->hollow;
    const struct grid *g = &r->mesh.grid;
    for (int64_t I = 0; I < g->n; I++) {
        int64_t count = 1;
        bool made = false;
        if (level[I] == 0 || !levels_lowest(&r->levels, level[I], I)) continue;
        for (int d = 0; d < g->dim; d++) count <<= level[I];
        for (int pass = 0; pass < 2 && (pass == 0 || made); pass++)
            for (int64_t part = 0; part < count; part++) {
                int64_t at = I, rest = part;
                for (int d = 0; d < g->dim; d++, rest >>= level[I])
                    at += (rest & ((1 << level[I]) - 1)) * g->stride[d];
                const int64_t J = hollow_of(h, g, at);
                if (pass == 0) made |= J >= 0 && !absent[J];
                else if (J >= 0) absent[J] = 0;
            }
    }
}

/* The cells that need no particles with these levels [h->n]; those within `ahead` cells of level 0 do. */
static uint8_t *absent_with(const struct reference_frame *r, const uint8_t *level, int ahead)
{
    const struct hollow *h = &r->hollow;
    const struct grid *g = &r->mesh.grid;
    uint8_t *absent = NEW("hollow.absent", h->n, uint8_t), *keep = NEW("hollow.keep", g->n, uint8_t);
    for (int64_t I = 0; I < g->n; I++) keep[I] = level[I] == 0 && mesh_cell_holds(&r->mesh, I);
    levels_dilate(&r->levels, keep, ahead);
    for (int64_t I = 0; I < g->n; I++) {
        const int64_t J = hollow_of(h, g, I);
        if (J >= 0) absent[J] = h->whole[J] && level[I] > 0 && !keep[I];
    }
    blocks_complete(r, level, absent);
    memory_free(keep);
    return absent;
}

bool engine_hollow_start(struct engine *e, const uint8_t *level)
{
    struct reference_frame *r = &e->reference;
    if (!r->hollow.absent) return true;
    if (r->hollow.restored) return false;        /* the checkpoint has the levels, too */
    if (!level) {                                /* no coarse cells */
        memory_free(r->hollow.absent);
        r->hollow.absent = NULL, r->lacks = true;
        return false;
    }
    r->lacks = any_lacks(&r->mesh, level);
    if (!r->lacks) return true;
    uint8_t *absent = absent_with(r, level, 0);
    for (int64_t J = 0; J < r->hollow.n; J++) r->hollow.absent[J] &= absent[J];
    memory_free(absent);
    return false;
}

/* ---- in a run ---------------------------------------------------------------------------------------------------- */

/* Numbers of the particles and images of `old` in e, -1: not there. Both are in the order of their ids. The caller
 * frees them. */
static int32_t *numbers_now(const struct engine *e, const struct engine *old)
{
    const struct particles *p = &e->part, *q = &old->part;
    int32_t *now = NEW("hollow.now", q->n_all, int32_t);
    int64_t i = 0, k = 0;
    for (int64_t j = 0; j < q->n; j++) {
        while (i < p->n && p->id[i] < q->id[j]) i++;
        now[j] = i < p->n && p->id[i] == q->id[j] ? (int32_t)i : -1;
    }
    for (int64_t j = 0; j < old->loads.images; j++) {
        const struct image *was = &old->loads.image[j];
        const int32_t source = now[was->source];
        int64_t next = k;
        while (source >= 0 && next < e->loads.images &&
               (e->loads.image[next].source != source || e->loads.image[next].load != was->load))
            next++;
        const bool found = source >= 0 && next < e->loads.images;
        now[q->n + j] = found ? (int32_t)(p->n + next) : -1;
        if (found) k = next + 1;
    }
    return now;
}

/* Fields of the particles that both have. */
static void particles_take(struct particles *p, const struct particles *old, const int32_t *now, int optional)
{
    for (int f = 0; f < particle_fields_count; f++) {
        const struct particle_field *field = &particle_fields[f];
        for (int k = 0; k < field->count(p->dim, optional); k++) {
            char *to = particle_array(p, field, k);
            const char *from = particle_array(old, field, k);
            for (int64_t j = 0; j < old->n; j++)
                if (now[j] >= 0) memcpy(to + (size_t)now[j] * field->size, from + (size_t)j * field->size, field->size);
        }
    }
}

/* n: of the particles there are now. */
static void contact_take(struct contact *c, struct contact *old, const int32_t *now, int64_t n)
{
    const struct contact fresh = *c;
    const struct contact_law theirs = old->law;
    *c = *old, *old = fresh, old->law = theirs;
    c->law = fresh.law, c->rigid = fresh.rigid;
    for (int64_t k = 0; k < c->n && c->made; k++) c->particle[k] = now[c->particle[k]];
    for (int d = 0; d < DIM_MAX && c->push[d]; d++) {
        memory_free(c->push[d]);
        c->push[d] = NEW("contact.push", n, real);       /* the step of a frame records it anew */
    }
}

static void tips_take(struct tips *t, struct tips *old, const int32_t *now)
{
    const struct tips fresh = *t;
    *t = *old;
    t->label = fresh.label, t->count = fresh.count;
    for (int64_t j = 0; j < old->count; j++)
        if (now[j] >= 0) t->label[now[j]] = old->label[j];
    old->time = fresh.time, old->growth = fresh.growth;
}

static void swap_arrays(real **a, real **b, int dim)
{
    for (int d = 0; d < dim; d++) {
        real *kept = a[d];
        a[d] = b[d], b[d] = kept;
    }
}

/* The mesh of level 0 for the new particles, with the motion of all nodes. */
static status mesh_take(struct engine *e, struct engine *old)
{
    struct reference_frame *r = &e->reference, *was = &old->reference;
    mesh_free(&r->mesh);
    memory_free(r->elastic);
    TRY(engine_mesh_make(e, true));
    assert(r->mesh.grid.n == was->mesh.grid.n);
    swap_arrays(r->mesh.displacement, was->mesh.displacement, e->part.dim);
    swap_arrays(r->mesh.grid.velocity, was->mesh.grid.velocity, e->part.dim);
    r->speed = was->speed;
    r->levels = was->levels;
    was->levels = (struct mesh_levels){0};
    memory_free(r->coarse);
    r->coarse = was->coarse, was->coarse = NULL;
    levels_follow_fine(&r->levels, &e->part, &r->source);
    for (int k = 1; k <= r->levels.n; k++)
        loads_level_find(&e->loads, &r->levels.at[k].held, &r->levels.at[k].mesh.grid, &e->part);
    mesh_find_exposed(&r->mesh, &e->part, &e->bonds, &e->loads);
    loads_mesh_find(&e->loads, &r->mesh, &e->part);
    e->coupling.partial.touches = 0;
    engine_mesh_sync_points(e, NULL, 0);
    return OK;
}

/* Accounts and figures that do not depend on which particles are made. */
static void accounts_take(struct engine *e, struct engine *old)
{
    struct loads *l = &e->loads, *was = &old->loads;
    memcpy(l->impulse, was->impulse, sizeof l->impulse);
    l->work = was->work, l->constraint_work = was->constraint_work;
    l->absorbing.energy = was->absorbing.energy;
    for (int b = 0; b < l->n; b++) {
        memcpy(l->load[b].displacement, was->load[b].displacement, sizeof l->load[b].displacement);
        memcpy(l->load[b].reaction, was->load[b].reaction, sizeof l->load[b].reaction);
    }
    e->coupling.damped = old->coupling.damped;
    e->coupling.conversion = old->coupling.conversion;
    e->diagnostics = old->diagnostics;
    const real mass = e->stability.mass;
    e->stability = old->stability;
    e->stability.mass = mass;
    e->probing.residual_step0 = old->probing.residual_step0;
    probes_take(&e->probing.probes, &old->probing.probes);
    memory_free(e->report.record);
    const struct run_report empty = {.out = NULL};
    e->report = old->report;
    old->report = empty;
}

/* What steps have changed, from the run of which `old` has other particles. */
static status state_take(struct engine *e, struct engine *old)
{
    int32_t *now = numbers_now(e, old);
    particles_take(&e->part, &old->part, now, e->optional);
    particles_list(&e->part);
    bonds_images_follow(&e->part, &e->source);
    bonds_free(&e->bonds);
    bonds_make(&e->bonds, NULL, &e->part, &e->source);
    bonds_take(&e->bonds, &old->bonds, now);
    for (int64_t j = 0; j < old->part.n; j++)
        if (now[j] >= 0) e->part.damage[now[j]] = old->part.damage[j];
    state_weigh(&e->bonds, &e->part, &e->source);
    partial_stress_free(&e->coupling.partial);
    engine_partial_make(e);
    status s = mesh_take(e, old);
    engine_ends_update(e);
    contact_take(&e->contact, &old->contact, now, e->part.n);
    if (e->contact.made) contact_follow(&e->contact, &e->part, &e->bonds, &e->loads);
    tips_take(&e->fracture.tips, &old->fracture.tips, now);
    accounts_take(e, old);
    e->mpm.sort_needed = true;
    memory_free(now);
    return s;
}

status engine_hollow_follow(struct engine *e, const uint8_t *level)
{
    if (!any_lacks(&e->reference.mesh, level)) return OK;
    struct hollow hollow = e->reference.hollow;
    uint8_t *absent = absent_with(&e->reference, level, AHEAD);
    struct engine *old = NEW("hollow.old", 1, struct engine);
    if (e->report.out) {
        TRY(output_wait(e->report.out));
        output_particles_changed(e->report.out);
    }
    memory_free(hollow.absent);
    hollow.absent = absent;
    e->reference.hollow = (struct hollow){0};
    *old = *e;
    old->reference.levels.fine = NULL;           /* it stands in e, as will the mesh made anew */
    status s = engine_make_again(e, old->scene, NULL, hollow, old);
    old->reference.levels.fine = &e->reference.mesh;
    if (s == OK) s = state_take(e, old);
    engine_free(old);
    memory_free(old);
    memory_reuse(true);
    return s;
}

/* ---- checkpoints ------------------------------------------------------------------------------------------------- */

/* Makes the run again with the cells hollow that a checkpoint has so. */
static status remake(struct engine *e, uint8_t *absent)
{
    const struct run_report report = e->report, empty = {.out = NULL};
    const struct scene *s = e->scene;
    struct hollow hollow = e->reference.hollow;
    memory_free(hollow.absent);
    hollow.absent = absent, hollow.restored = true;
    e->reference.hollow = (struct hollow){0};
    e->report = empty;
    engine_free(e);
    const status made = engine_make_again(e, s, NULL, hollow, NULL);
    memory_free(e->report.record);
    e->report = report;
    return made;
}

status engine_hollow_archive(struct engine *e, struct archive *a)
{
    struct hollow *h = &e->reference.hollow;
    int64_t n = h->absent ? h->n : 0;
    ARCHIVE_VALUE(a, "hollow/cells", n);
    if (n == 0 && (a->saving || !h->absent)) return OK;
    if (a->saving) return a->exchange(a, "hollow/absent", h->absent, (size_t)n);
    if (n > 0 && n != h->n) return status_set(FAILED, "cannot resume: the checkpoint is of another body");
    uint8_t *absent = n > 0 ? NEW("hollow.absent", n, uint8_t) : NULL;
    if (n > 0) TRY(a->exchange(a, "hollow/absent", absent, (size_t)n));
    for (int64_t J = 0; J < n; J++)
        if (absent[J] > h->whole[J]) return status_set(FAILED, "cannot resume: the checkpoint lacks particles");
    return remake(e, absent);
}
