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

/* Returns the sum of the elastic and kinetic energies of the bodies of the run at the present positions [J], those of
 * bonds, material points and mesh included. */
static real energy_now(struct run *run)
{
    if (run->source.modulus) bonds_compute_particle_stress(&run->bonds, &run->part, &run->source, &run->kernels);
    return run->kernels.bond_energy(&run->bonds, &run->part, NULL) +
           points_strain_energy(&run->part, run->scene->material, &run->coupling->partial) +
           mesh_strain(&run->frame->mesh, &run->part, run->frame->elastic, !run->scene->small_strain) +
           particles_kinetic_energy(&run->part) + mesh_kinetic(&run->frame->mesh);
}

/* Turns n peridynamic particles into material points, with bonds, mesh and interface zone updated. list[n]: indices of
 * the particles. The change of elastic and kinetic energy that this causes is added to the quantity
 * conversion.reversion_energy of the run [J]. */
static void revert_listed(struct run *run, const int32_t *list, int64_t n)
{
    const real before = energy_now(run);
    reversion_convert_listed_particles_to_mpm(&run->coupling->conversion, &run->part, &run->bonds, &run->source,
                                              run->coupling->uses_partial ? &run->coupling->partial : NULL, list, n);
    lagrangian_mesh_insert_points(run->frame, &run->part, list, n, &run->damped);
    conversion_update_mesh_after_conversion(run, n);
    lagrangian_mesh_update_point_motion(run->frame, &run->part, &run->loads);
    interface_zone_rebuild_after_bond_change(run->coupling, &run->part, &run->bonds, &run->source);
    run->grid->sort_needed = SORT_ALL, run->contact->due = true;
    run->coupling->conversion.reversion_energy += energy_now(run) - before;
}

void reversion_convert_relaxed_particles_to_mpm(struct run *run)
{
    const struct scene *s = run->scene;
    int32_t *list;
    if (!run->part.low_since || run->clock.step == 0 ||
        run->clock.step % period(&run->clock, &run->tables, &run->source) != 0 || run->part.n_of[KIND_PD] == 0)
        return;
    bonds_compute_particle_stress(&run->bonds, &run->part, &run->source, &run->kernels);
    const int64_t n = reversion_select_particles_to_become_mpm(
        &(struct reversion_rule){.source = &run->source,
                                 .elastic = run->tables.elastic,
                                 .kept = run->coupling->start_region.n > 0 ? &run->coupling->start_region : NULL,
                                 .low_stress = s->conversion.low_stress,
                                 .hold_time =
                                     s->conversion.hold_time * run->source.family.horizon / run->tables.wave_speed},
        &run->part, &run->bonds, run->clock.t, &list);
    if (n > 0) revert_listed(run, list, n);
    memory_free(list);
}
