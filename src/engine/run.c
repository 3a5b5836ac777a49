/* Advances a run to its end. Before each step the coarse mesh cells are adapted to cracks and stress; after each step
 * the results are checked and reported. */
#include "base/memory.h"
#include "engine_internal.h"
#include "mesh/mesh_part.h"
#include "probes/probes_part.h"
#include "quasistatic/load_steps.h"
#include "step/report.h"
#include "step/step.h"
#include "step/checks.h"

/* Stores position and radius of the integration contours of all SIF probes (stress-intensity factors) of p in f->ring.
 * Cells of the reference frame f (mesh of the undeformed body) inside these contours are not made coarser. seen: view
 * of the run for probes. */
static void rings_find(struct lagrangian_mesh *f, struct probes *p, const struct observed_run *seen)
{
    if (!f->ring) f->ring = NEW("frame.rings", p->n, struct finest_cells_disc);
    f->rings = 0;
    for (int k = 0; k < p->n; k++)
        f->rings += probes_locate_sif_contour(p, k, seen, f->ring[f->rings].place, &f->ring[f->rings].radius);
}

/* Adapts the coarsening levels of the mesh cells of the run (0: finest; the edge doubles with each level) to cracks and
 * stress. If cells that become finer lack particles, the run is first replaced by a run that has these particles.
 * Returns FAILED or REFUSED, with a message, if that is not possible; OK otherwise, also if nothing has changed. */
static status refine(struct run *run)
{
    if (!mesh_levels_may_change_before_step(&run->frame->levels, run->clock.step)) return OK;
    const struct observed_run seen = observed_run_make_read_only_view(run);
    rings_find(run->frame, &run->probing->probes, &seen);
    uint8_t *level =
        mesh_levels_choose_level_of_each_cell(run->frame, &run->part, &run->loads, run->clock.step, run->mass);
    if (!level) return OK;
    const status s = mesh_any_new_finest_cell_lacks_particles(&run->frame->mesh, level)
                         ? run_replace_particles_for_coarsening_levels(run, level)
                         : OK;
    if (s == OK) mesh_levels_change_cell_levels(run, level);
    memory_free(level);
    return s;
}

status run_adapt_mesh_and_advance_one_step(struct run *run)
{
    TRY(refine(run));
    return run_advance_by_one_time_step(run);
}

/* Runs the scene of the run to its end: as one equilibrium, in load steps or in time, as its solver requires. Returns
 * OK; FAILED, with a message, if a step fails; INTERRUPTED if a signal ends the run early. */
static status run_to_end(struct run *run)
{
    if (scene_is_single_equilibrium(run->scene)) return run_solve_single_equilibrium(run);
    if (scene_has_load_steps(run->scene)) return run_solve_load_steps(run);
    TRY(report_open_history_and_write_first_frame(run));
    timers_start(&run->timers);
    while (run->clock.step < run->clock.steps) {
        TRY(run_adapt_mesh_and_advance_one_step(run));
        TRY(run_check_stability_after_step(run));
        TRY(report_write_outputs_due_after_step(run));
    }
    return report_write_last_checkpoint_and_finish(run);
}

status run_advance_to_end_time(struct run *run)
{
    memory_set_reuse_of_freed_arrays(true);
    const status ended = run_to_end(run);
    memory_set_reuse_of_freed_arrays(false);
    return ended;
}
