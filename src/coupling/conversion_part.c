/* Conversion, and what follows from it, as a part of a step. */
#include "coupling/coupling_part.h"

#include "base/memory.h"
#include "contact/contact.h"
#include "grid/grid_part.h"
#include "mesh/mesh_part.h"
#include "rigid/rigid_part.h"

void ends_update(struct run *e)
{
    if (!e->part.end_strain) return;
    partial_ends_update(&e->coupling->partial, &e->part, e->scene->material);
    if (e->frame->mesh.points > 0) mesh_ends_update(&e->frame->mesh, &e->part, !e->scene->small_strain);
}

/* Updates the stress share of material points where bonds fade; convert() has updated it for broken bonds. */
static void renew_partial(struct run *e, bool changed)
{
    if (changed && e->coupling->uses_partial && e->scene->growths > 0)
        partial_stress_make(&e->coupling->partial, &e->part, &e->bonds, &e->source, NULL, 0);
}

/* Marks material points that other bodies have come near. */
static void approach(struct run *e)
{
    frame_sync_points(e, NULL, 0);
    approach_mark(&e->part, e->scene->bodies, e->rigid->body, e->scene->rigids, APPROACH_REACH * e->scene->spacing);
}

/* May a point have been marked for conversion in this step, or a bond have changed? Points on the grid say nothing of
 * it; of the mesh its cells say that their points may be. */
static bool may_convert(const struct run *e, int64_t broken)
{
    return broken > 0 || e->coupling->approaches || e->part.n_free > 0 || e->part.n_grid_coupled > 0 ||
           e->scene->growths > 0 || scene_in_steps(e->scene) || e->part.low_since || e->frame->levels.returned ||
           mesh_stressed(&e->frame->mesh);
}

static void meet_others(void *context, const int32_t *list, int64_t n)
{
    struct run *e = context;
    contact_add(e->contact, &e->bonds, &e->source.family, list, n);
}

bool conversion_mark(struct run *e)
{
    if (e->scene->active_set) active_rows_update(&e->bonds, &e->part, &e->loads);
    if (e->coupling->approaches && e->clock.step % APPROACH_STEPS == 0) approach(e);
    return notch_approach(e);
}

void conversion_follow(struct run *e, int64_t converted)
{
    struct partial_stress *partial = &e->coupling->partial;
    const bool due = converted > 0 || partial->touches > 0;
    const bool anew = due && frame_follow(e, converted, partial->touched, partial->touches);
    if (converted > 0 || (due && !anew)) ends_update(e);
    partial->touches = 0;
}

int64_t conversion_pass(struct run *e, int64_t broken, bool marked, bool fades)
{
    const struct conversion_sync sync = {frame_sync_points, e, meet_others};
    if (!marked && !may_convert(e, broken)) return 0;
    frame_levels_guard(e);
    const int64_t converted = convert(&e->coupling->conversion, &e->scene->conversion, &e->part, &e->bonds, &e->source,
                                      e->coupling->uses_partial ? &e->coupling->partial : NULL, &sync, e->clock.t);
    if (converted > 0) interface_make(e), e->grid->sort_needed = true;
    renew_partial(e, broken > 0 || converted > 0 || fades);
    conversion_follow(e, converted);
    return converted;
}

/* Marks material points with bonds, e->bonded [n], for FLIP. */
static void bonded_make(struct run *e)
{
    const struct bonds *b = &e->bonds;
    if (b->rows == 0) { /* all have reverted: no point is beside bonds */
        memory_free(e->coupling->bonded);
        e->coupling->bonded = NULL;
        return;
    }
    if (e->scene->transfer != TRANSFER_FLIP || e->part.n_free == 0) return;
    if (!e->coupling->bonded) e->coupling->bonded = NEW("engine.bonded", e->part.n, uint8_t);
#pragma omp parallel for schedule(static)
    for (int64_t i = 0; i < e->part.n; i++) e->coupling->bonded[i] = e->part.kind[i] == KIND_MPM && bonds_has(b, i);
}

void interface_make(struct run *e)
{
    bonded_make(e);
    if (e->part.n_free == 0) interface_zone_free(&e->coupling->zone);
    if (e->coupling_kind == COUPLING_PARTIAL_STRESS && e->scene->transfer == TRANSFER_FLIP && e->part.n_free > 0)
        interface_zone_make(&e->coupling->zone, &e->part, &e->source);
}

void coupling_partial_make(struct run *e)
{
    e->coupling_kind = e->scene->method == METHOD_ADAPTIVE ? e->scene->coupling : COUPLING_HANDSHAKE;
    e->coupling->partial.gives_all = e->coupling_kind != COUPLING_PARTIAL_STRESS;
    e->coupling->uses_partial = !e->coupling->partial.gives_all || e->part.end_strain;
    if (e->coupling->uses_partial) partial_stress_make(&e->coupling->partial, &e->part, &e->bonds, &e->source, NULL, 0);
    interface_make(e);
}

status coupling_frame_make(struct run *e, bool still)
{
    struct coupling_state *c = e->coupling;
    const struct mesh_source cuts = {
        .partial = c->uses_partial ? &c->partial : NULL, .slit = c->notches.slit, .slits = c->notches.slits};
    TRY(frame_make(e, &cuts, still));
    c->partial.touches = 0; /* the mesh is of the partial stresses of now */
    return OK;
}
