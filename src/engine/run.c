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

/* Adapts the coarsening levels of the mesh cells of run e (0: finest; the edge doubles with each level) to cracks and
 * stress. If cells that become finer lack particles, the run is first replaced by a run that has these particles.
 * Returns FAILED or REFUSED, with a message, if that is not possible; OK otherwise, also if nothing has changed. */
static status refine(struct run *e)
{
    if (!mesh_levels_may_change_before_step(&e->frame->levels, e->clock.step)) return OK;
    const struct observed_run seen = observed_run_make_read_only_view(e);
    rings_find(e->frame, &e->probing->probes, &seen);
    uint8_t *level = mesh_levels_choose_level_of_each_cell(e->frame, &e->part, &e->loads, e->clock.step, e->mass);
    if (!level) return OK;
    const status s = mesh_cells_to_become_finest_lack_particles(&e->frame->mesh, level)
                         ? run_replace_particles_for_coarsening_levels(e, level)
                         : OK;
    if (s == OK) mesh_levels_change_cell_levels(e, level);
    memory_free(level);
    return s;
}

status run_adapt_mesh_and_advance_one_step(struct run *e)
{
    TRY(refine(e));
    return step(e);
}

/* Runs the scene of e to its end: as one equilibrium, in load steps or in time, as its solver requires. Returns OK;
 * FAILED, with a message, if a step fails; INTERRUPTED if a signal ends the run early. */
static status run_to_end(struct run *e)
{
    if (scene_is_single_equilibrium(e->scene)) return run_solve_single_equilibrium(e);
    if (scene_has_load_steps(e->scene)) return run_solve_load_steps(e);
    TRY(report_open_history_and_write_first_frame(e));
    timers_start(&e->timers);
    while (e->clock.step < e->clock.steps) {
        TRY(run_adapt_mesh_and_advance_one_step(e));
        TRY(run_check_stability_after_step(e));
        TRY(report_write_outputs_due_after_step(e));
    }
    return report_write_last_checkpoint_and_finish(e);
}

status run_advance_to_end_time(struct run *e)
{
    memory_set_reuse_of_freed_arrays(true);
    const status ended = run_to_end(e);
    memory_set_reuse_of_freed_arrays(false);
    return ended;
}
