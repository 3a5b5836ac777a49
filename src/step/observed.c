/* The read-only view of a run that probes measure. */
#include "fracture/fracture_part.h"
#include "grid/grid_part.h"
#include "coupling/coupling_part.h"
#include "probes/probes_part.h"
#include "probes/diagnostics.h"

struct observed_run observed_run_view_of(const struct run *e)
{
    const struct scene *s = e->scene;
    return (struct observed_run){.part = &e->part,
                                 .cells = &e->cells,
                                 .bonds = &e->bonds,
                                 .kernels = &e->kernels,
                                 .loads = &e->loads,
                                 .grid = &e->grid->field[0].grid,
                                 .tips = &e->fracture->tips,
                                 .material = s->material,
                                 .partial = &e->coupling->partial,
                                 .spacing = s->spacing,
                                 .thickness = e->source.family.section,
                                 .strain_stress = e->probing->strain_stress,
                                 .residual_step0 = e->probing->residual_step0,
                                 .t = e->clock.t,
                                 .in_steps = scene_has_load_steps(s),
                                 .load_step = e->clock.load_step,
                                 .t_velocity = e->clock.step > 0 && scene_is_dynamic(s) ? e->clock.t - 0.5 * e->clock.dt
                                                                                        : e->clock.t,
                                 .pulse = e->probing->pulse,
                                 .pulses = e->probing->pulses,
                                 .space = s->space,
                                 .horizon = e->source.family.horizon,
                                 .crack = s->crack,
                                 .cracks = s->cracks,
                                 .energy_change = diagnostics_relative_energy_change(e->diagnostics),
                                 .growth = e->fracture->growth,
                                 .growths = s->growths,
                                 .baseline = e->probing->has_baseline ? &e->probing->baseline : NULL};
}
