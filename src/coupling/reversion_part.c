/* Checks at regular times of a run which peridynamic particles may become material points again (reversion), and
 * converts them. */
#include <math.h>

#include "base/memory.h"
#include "coupling/reversion.h"
#include "coupling/coupling_part.h"
#include "mesh/mesh_part.h"
#include "grid/grid_part.h"
#include "contact/contact.h"
#include "run/energies.h"

/* Returns the number of time steps, at least 1, from one search for particles that may become material points again to
 * the next. In this time a wave travels one horizon, half the diameter of a neighbourhood, so that no wave crosses a
 * neighbourhood unnoticed. clock: time step; tables: wave speed; source: horizon. */
static int64_t period(const struct run_clock *clock, const struct material_tables *tables,
                      const struct bond_source *source)
{
    const int64_t steps = (int64_t)floor(source->family.horizon / (tables->wave_speed * clock->dt));
    return steps > 1 ? steps : 1;
}

status reversion_check_scene_allows_return_to_mpm(const struct scene *s)
{
    const char *why = NULL;
    if (!s->conversion.reverts || s->method != METHOD_ADAPTIVE) return OK;
    if (!(s->conversion.criteria & CONVERT_ON_STRESS))
        why = "low_stress is a share of the stress at which points convert, so conversion.criteria must contain "
              "stress; add it, or set reversion: false";
    if (s->coupling != COUPLING_PARTIAL_STRESS && s->coupling != COUPLING_HANDSHAKE)
        why = "this coupling cannot turn particles back into material points; set coupling: partial stress or "
              "handshake, or reversion: false";
    if (s->growths > 0)
        why = "the key growth weakens bonds, whose particles cannot revert; remove growth, or set reversion: false";
    if (scene_is_single_equilibrium(s))
        why = "a single equilibrium has no later steps in which particles revert; set solver: explicit, or reversion: "
              "false";
    for (int m = 0; m < s->materials; m++)
        if (material_yields(&s->material[m]))
            why = "a material of the scene yields; remove its yield_stress, or set reversion: false";
    return why ? status_set(REFUSED, "conversion.reversion: true is impossible: %s", why) : OK;
}

/* Returns the sum of the elastic and kinetic energies of the bodies of run e at the present positions [J], those of
 * bonds, material points and mesh included. */
static real energy_now(struct run *e)
{
    if (e->source.modulus) bonds_compute_particle_stress(&e->bonds, &e->part, &e->source, &e->kernels);
    return e->kernels.bond_energy(&e->bonds, &e->part, NULL) +
           points_strain_energy(&e->part, e->scene->material, &e->coupling->partial) +
           mesh_strain(&e->frame->mesh, &e->part, e->frame->elastic, !e->scene->small_strain) +
           particles_kinetic_energy(&e->part) + mesh_kinetic(&e->frame->mesh);
}

/* Turns n peridynamic particles into material points, with bonds, mesh and interface zone updated. list[n]: indices of
 * the particles. The change of elastic and kinetic energy that this causes is added to the quantity
 * conversion.reversion_energy of run e [J]. */
static void revert_listed(struct run *e, const int32_t *list, int64_t n)
{
    const real before = energy_now(e);
    reversion_convert_listed_particles_to_mpm(&e->coupling->conversion, &e->part, &e->bonds, &e->source,
                                              e->coupling->uses_partial ? &e->coupling->partial : NULL, list, n);
    lagrangian_mesh_insert_points(e->frame, &e->part, list, n, &e->damped);
    conversion_update_mesh_after_conversion(e, n);
    lagrangian_mesh_update_point_motion(e->frame, &e->part, &e->loads);
    interface_zone_rebuild_after_bond_change(e->coupling, &e->part, &e->bonds, &e->source);
    e->grid->sort_needed = SORT_ALL, e->contact->due = true;
    e->coupling->conversion.reversion_energy += energy_now(e) - before;
}

void reversion_convert_relaxed_particles_to_mpm(struct run *e)
{
    const struct scene *s = e->scene;
    int32_t *list;
    if (!e->part.low_since || e->clock.step == 0 || e->clock.step % period(&e->clock, &e->tables, &e->source) != 0 ||
        e->part.n_of[KIND_PD] == 0)
        return;
    bonds_compute_particle_stress(&e->bonds, &e->part, &e->source, &e->kernels);
    const int64_t n = reversion_select_particles_to_become_mpm(
        &(struct reversion_rule){.source = &e->source,
                                 .elastic = e->tables.elastic,
                                 .kept = e->coupling->start_region.n > 0 ? &e->coupling->start_region : NULL,
                                 .low_stress = s->conversion.low_stress,
                                 .hold_time =
                                     s->conversion.hold_time * e->source.family.horizon / e->tables.wave_speed},
        &e->part, &e->bonds, e->clock.t, &list);
    if (n > 0) revert_listed(e, list, n);
    memory_free(list);
}
