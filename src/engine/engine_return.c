/* floor 5: particles that return to material points: when the engine looks, and what follows it. */
#include <math.h>

#include "engine/engine.h"
#include "engine_report.h"
#include "base/memory.h"
#include "coupling/return.h"

/* Twice in the time that a family takes to tell its edge what its middle does no wave passes unseen. */
static int64_t period(const struct engine *e)
{
    const int64_t steps = (int64_t)floor(e->source.family.horizon / (e->wave_speed * e->dt));
    return steps > 1 ? steps : 1;
}

status engine_return_check(const struct engine *e)
{
    const struct scene *s = e->scene;
    const char *why = NULL;
    if (!s->conversion.back || s->method != METHOD_ADAPTIVE) return OK;
    if (!(s->conversion.criteria & CONVERT_ON_STRESS)) why = "criteria with stress, which says what a low one is";
    if (s->coupling != COUPLING_PARTIAL_STRESS && s->coupling != COUPLING_HANDSHAKE) why = "coupling partial stress or handshake";
    if (s->growths > 0) why = "no growth, whose bonds fade";
    if (s->solver != SOLVER_EXPLICIT) why = "solver explicit";
    for (int m = 0; m < s->materials; m++)
        if (material_yields(&s->material[m])) why = "materials that do not yield";
    return why ? status_set(REFUSED, "conversion.return: true goes with %s", why) : OK;
}

static void bonded_make(struct engine *e)
{
    const struct bonds *b = &e->bonds;
    if (b->rows == 0) {                  /* all have returned: what was beside bonds no longer is */
        memory_free(e->bonded);
        e->bonded = NULL;
        return;
    }
    if (e->scene->transfer != TRANSFER_FLIP || e->part.n_free == 0) return;
    if (!e->bonded) e->bonded = NEW("engine.bonded", e->part.n, uint8_t);
#pragma omp parallel for schedule(static)
    for (int64_t i = 0; i < e->part.n; i++)
        e->bonded[i] = e->part.kind[i] == KIND_MPM && bonds_has(b, i);
}

void engine_rim_make(struct engine *e)
{
    bonded_make(e);
    if (e->coupling == COUPLING_PARTIAL_STRESS && e->scene->transfer == TRANSFER_FLIP && e->part.n_free > 0)
        rim_make(&e->rim, &e->part, &e->source);
}

/* Of now; families of state-based models as they are now. */
static real energy_now(struct engine *e)
{
    if (e->source.modulus) engine_stress(e);
    return e->kernels.bond_energy(&e->bonds, &e->part) + watch_strain(&e->part, e->scene->material, &e->partial) +
           mesh_strain(&e->mesh, &e->part, e->cell_elastic, !e->scene->small_strain) + watch_kinetic(&e->part) + mesh_kinetic(&e->mesh);
}

static void give_back(struct engine *e, const int32_t *list, int64_t n)
{
    const real before = energy_now(e);
    return_points(&e->conversion, &e->part, &e->bonds, &e->source, e->uses_partial ? &e->partial : NULL, list, n);
    engine_mesh_adopt(e, list, n);
    engine_rim_make(e);
    e->sort_needed = true;
    e->conversion.return_energy += energy_now(e) - before;
}

void engine_return(struct engine *e)
{
    const struct scene *s = e->scene;
    int32_t *list;
    if (!e->part.quiet || e->step == 0 || e->step % period(e) != 0 || e->part.n_of[KIND_PD] == 0) return;
    engine_stress(e);
    const int64_t n = return_choose(
        &(struct return_rule){.source = &e->source, .elastic = e->elastic, .kept = e->start_region.n > 0 ? &e->start_region : NULL,
                              .calm = s->conversion.calm,
                              .dwell = s->conversion.dwell * e->source.family.horizon / e->wave_speed},
        &e->part, &e->bonds, e->t, &list);
    if (n > 0) give_back(e, list, n);
    memory_free(list);
}
