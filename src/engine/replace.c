/* Replaces a run, between two steps, by one with additional particles of the same bodies (hollow_part.c), which
 * continues with its state. */
#include <string.h>

#include "base/memory.h"
#include "base/memory_archive.h"
#include "contact/contact.h"
#include "mesh/mesh_part.h"
#include "coupling/coupling_part.h"
#include "step/report.h"
#include "engine_internal.h"

/* Releases mesh, partial stress, interface zone and neighbour search of the run, which is about to be replaced. The new
 * run computes them from particles and scene, and for large bodies there is no memory for both. Displacements and
 * velocities of the mesh nodes are kept. */
static void leave_derived(struct run *run)
{
    struct mesh *mesh = &run->frame->mesh, moved = {.grid = {.n = mesh->grid.n, .dim = mesh->grid.dim}};
    for (int d = 0; d < run->part.dim; d++) {
        moved.displacement[d] = mesh->displacement[d], moved.grid.velocity[d] = mesh->grid.velocity[d];
        mesh->displacement[d] = mesh->grid.velocity[d] = NULL;
    }
    mesh_free(mesh);
    *mesh = moved;
    partial_stress_free(&run->coupling->partial);
    interface_zone_free(&run->coupling->zone);
    cells_free(&run->cells);
}

/* Exchanges the arrays a[0] .. a[dim - 1] with b[0] .. b[dim - 1]. */
static void swap_arrays(real **a, real **b, int dim)
{
    for (int d = 0; d < dim; d++) {
        real *kept = a[d];
        a[d] = b[d], b[d] = kept;
    }
}

/* Moves displacements and velocities of all mesh nodes, and the coarse cells, from the run `old` to run, which replaces
 * it. Both runs have the same nodes. */
static void nodes_take(struct run *run, struct run *old)
{
    struct lagrangian_mesh *reference = run->frame, *was = old->frame;
    INVARIANT(reference->mesh.grid.n == was->mesh.grid.n);
    swap_arrays(reference->mesh.displacement, was->mesh.displacement, run->part.dim);
    swap_arrays(reference->mesh.grid.velocity, was->mesh.grid.velocity, run->part.dim);
    reference->speed = was->speed;
    reference->levels = was->levels;
    reference->levels.fine = &reference->mesh;
    was->levels = (struct mesh_levels){0};
    reference->coarse = was->coarse, was->coarse = NULL;
    mesh_levels_reconnect_coarse_to_finest_mesh(&reference->levels, &run->part, &reference->source);
    mesh_levels_update_lists_of_loaded_nodes(reference, &run->part, &run->bonds, &run->loads);
    lagrangian_mesh_update_point_motion(reference, &run->part, &run->loads);
    bonded_mpm_points_update_cell_strain(&run->coupling->partial, reference, &run->part, run->scene->material);
}

/* Moves from the run `old` to run, which replaces it, the state that the state functions of struct part do not
 * transfer: motion of nodes, output files, timers and warnings. `old` keeps none of it. */
static void rest_take(struct run *run, struct run *old)
{
    nodes_take(run, old);
    run->damped = old->damped;
    run->warnings = old->warnings, run->timers = old->timers;
    old->warnings = (struct warnings){0};
    *run->report = *old->report;
    *old->report = (struct run_report){.out = NULL};
}

/* Replaces the content of the run by a new run with the hollow cells of its frame (cells inside a body without
 * particles) and the state of the previous run. The state of parts is transferred through an archive in memory. Returns
 * FAILED or REFUSED, with a message, if the new run cannot be made. */
static status run_replace(struct run *run)
{
    struct run *old = NEW("replace.old", 1, struct run);
    struct predecessor before = {.run = old};
    struct memory_archive parts;
    const struct cells_without_particles hollow = run->frame->hollow;
    memory_archive_open_for_saving(&parts, ARCHIVE_REBUILD);
    status s = run_components_save_or_load_state(run, &parts.archive);
    *old = *run;
    old->frame->hollow = (struct cells_without_particles){0};
    leave_derived(old);
    if (s == OK) s = run_create_and_transfer_from_predecessor(run, old->scene, NULL, hollow, &before);
    if (s == OK) {
        rest_take(run, old);
        memory_archive_rewind_for_loading(&parts);
        parts.archive.now = before.now;
        s = run_components_save_or_load_state(run, &parts.archive);
    }
    memory_archive_free(&parts);
    memory_free(before.now);
    run_free_memory(old);
    memory_free(old);
    return s;
}

status run_replace_particles_for_coarsening_levels(struct run *run, const uint8_t *cell_level)
{
    if (run->report->out) {
        TRY(output_wait_until_frame_is_written(run->report->out));
        output_discard_cached_frame_particle_order(run->report->out);
    }
    cells_without_particles_update_from_levels(run->frame, cell_level);
    TRY(run_replace(run));
    if (run->report->out) contact_allocate_particle_forces(run->contact, &run->part);
    return OK;
}
