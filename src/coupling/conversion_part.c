/* Converts flagged material points of a run to peridynamic particles during a step, and updates mesh, interface zone,
 * partial stress and contact search accordingly. */
#include "coupling/coupling_part.h"

#include "base/memory.h"
#include "contact/contact.h"
#include "grid/grid_part.h"
#include "mesh/mesh_part.h"
#include "rigid/rigid_part.h"

void bonded_mpm_points_update_cell_strain(const struct partial_stress *partial, const struct lagrangian_mesh *reference,
                                          struct particles *p, const struct material *material)
{
    if (!p->end_strain) return;
    bonded_mpm_points_compute_strain_from_stress(partial, p, material);
    if (reference->mesh.points > 0) mesh_ends_update(&reference->mesh, p, reference->finite);
}

/* Returns true if the conversion flags of all material points of p must be tested in this step. This is so if there are
 * points on the background grid, which keeps no record of flagged points, or if another process may have flagged points
 * or broken bonds: growth laws of cracks or load steps of scene s, reversion, or coarse mesh cells, which postpone
 * conversions. Returns false if all points belong to the mesh of the reference frame (a mesh of the undeformed body)
 * and no cell of it has recorded a stress above that of conversion. */
static bool may_convert(const struct scene *s, const struct particles *p, const struct lagrangian_mesh *reference)
{
    return p->n_free > 0 || p->n_grid_coupled > 0 || s->growths > 0 || scene_has_load_steps(s) || p->low_since ||
           reference->levels.returned || mesh_stress_may_exceed_conversion_limit(&reference->mesh);
}

/* Updates positions and velocities of n listed particles, as far as they are points of the mesh of the reference frame
 * (a mesh of the undeformed body). context: the run (struct run); list[n]: indices of the particles. Callback of struct
 * conversion_sync. */
static void sync_listed(void *context, const int32_t *list, int64_t n)
{
    struct run *run = context;
    lagrangian_mesh_update_motion_of_listed_points(run->frame, &run->part, &run->loads, list, n);
}

/* Requests a contact search if one of n particles that have become peridynamic is at a surface of its body. context:
 * the run (struct run); list[n]: indices of the particles. Callback of struct conversion_sync. */
static void meet_others(void *context, const int32_t *list, int64_t n)
{
    struct run *run = context;
    contact_request_search_if_particles_at_surface(run->contact, &run->bonds, &run->source.family, list, n);
}

bool conversion_flag_points_near_contact(struct run *run)
{
    if (run->scene->active_set) active_bond_row_blocks_update_after_step(&run->bonds, &run->part, &run->loads);
    if (run->clock.step % APPROACH_STEPS != 0 && !scene_has_load_steps(run->scene)) return false;
    if (run->coupling->approaches) {
        lagrangian_mesh_update_point_motion(run->frame, &run->part, &run->loads);
        flag_points_near_other_bodies_for_conversion(&run->part, run->scene->bodies, run->rigid->body, run->rigid->n,
                                                     APPROACH_REACH * run->scene->spacing);
    }
    return run->scene->contact_between == CONTACT_ALL &&
           mark_points_at_closing_slits_to_become_peridynamic(&run->coupling->notches, run->frame, &run->part,
                                                              &run->loads, run->scene->spacing,
                                                              APPROACH_STEPS * run->clock.dt);
}

void conversion_update_mesh_after_conversion(struct run *run, int64_t converted_count)
{
    struct partial_stress *partial = &run->coupling->partial;
    const bool due = converted_count > 0 || partial->touches > 0;
    const bool anew = due && lagrangian_mesh_update_after_point_conversion(run->frame, &run->part, converted_count,
                                                                           partial, &run->damped);
    if (anew) lagrangian_mesh_list_bonded_or_loaded_points(run->frame, &run->part, &run->bonds, &run->loads);
    if (converted_count > 0 || (due && !anew))
        bonded_mpm_points_update_cell_strain(partial, run->frame, &run->part, run->scene->material);
    partial->touches = 0;
}

int64_t run_convert_flagged_points_to_peridynamic(struct run *run, int64_t broken_bond_count, bool crack_faces_examined,
                                                  bool bonds_weaken_gradually)
{
    const struct conversion_sync sync = {sync_listed, run, meet_others};
    struct coupling_state *c = run->coupling;
    if (!crack_faces_examined && broken_bond_count == 0 && !c->approaches && !run->bonds.soft.at_points &&
        !may_convert(run->scene, &run->part, run->frame))
        return 0;
    run->bonds.soft.at_points = false;
    coarse_cells_delay_conversion_of_nearby_points(&run->frame->levels, &run->part);
    const int64_t converted =
        convert_flagged_points_to_peridynamic(&c->conversion, &run->scene->conversion, &run->part, &run->bonds,
                                              &run->source, c->uses_partial ? &c->partial : NULL, &sync, run->clock.t);
    if (converted > 0)
        interface_zone_rebuild_after_bond_change(c, &run->part, &run->bonds, &run->source),
            run->grid->sort_needed = SORT_ALL;
    /* where bonds fade; for broken bonds convert_flagged_points_to_peridynamic() has updated the partial stresses */
    if (c->uses_partial && run->scene->growths > 0 &&
        (broken_bond_count > 0 || converted > 0 || bonds_weaken_gradually))
        partial_stress_compute_from_bonds(&c->partial, &run->part, &run->bonds, &run->source, NULL, 0);
    conversion_update_mesh_after_conversion(run, converted);
    return converted;
}

/* Stores in c->bonded[p->n] which particles of p are material points with intact bonds to peridynamic particles: 1 for
 * these, 0 for others. Frees c->bonded and sets it to NULL if b has no rows of bonds. Else does nothing if the transfer
 * of velocities between grid and points is not FLIP, which alone needs these marks, or if no points are on the grid. */
static void bonded_make(struct coupling_state *c, const struct particles *p, const struct bonds *b)
{
    if (b->rows == 0) { /* all particles have reverted: no material point has bonds */
        memory_free(c->bonded);
        c->bonded = NULL;
        return;
    }
    if (!c->flip || p->n_free == 0) return;
    if (!c->bonded) c->bonded = NEW("engine.bonded", p->n, uint8_t);
#pragma omp parallel for schedule(static)
    for (int64_t i = 0; i < p->n; i++) c->bonded[i] = p->kind[i] == KIND_MPM && particle_has_intact_bond(b, i);
}

void interface_zone_rebuild_after_bond_change(struct coupling_state *c, const struct particles *p,
                                              const struct bonds *b, const struct bond_source *source)
{
    bonded_make(c, p, b);
    if (p->n_free == 0) interface_zone_free(&c->zone);
    if (!c->partial.gives_all && c->flip && p->n_free > 0)
        interface_zone_list_damped_material_points(&c->zone, p, source);
}

void coupling_set_up_pd_mpm_method_and_interface(struct run *run)
{
    struct coupling_state *c = run->coupling;
    run->coupling_kind = run->scene->method == METHOD_ADAPTIVE ? run->scene->coupling : COUPLING_HANDSHAKE;
    c->flip = run->scene->transfer == TRANSFER_FLIP;
    c->partial.gives_all = run->coupling_kind != COUPLING_PARTIAL_STRESS;
    c->uses_partial = !c->partial.gives_all || run->part.end_strain;
    if (c->uses_partial) partial_stress_compute_from_bonds(&c->partial, &run->part, &run->bonds, &run->source, NULL, 0);
    interface_zone_rebuild_after_bond_change(c, &run->part, &run->bonds, &run->source);
}

status coupling_build_total_lagrangian_mesh(struct run *run, bool caller_sets_nodal_motion)
{
    struct coupling_state *c = run->coupling;
    const struct mesh_source cuts = {
        .partial = c->uses_partial ? &c->partial : NULL, .slit = c->notches.slit, .slits = c->notches.slits};
    TRY(lagrangian_mesh_make_for_run(run, &cuts, caller_sets_nodal_motion));
    c->partial.touches = 0; /* the mesh includes the present partial stresses */
    return OK;
}
