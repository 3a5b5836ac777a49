/* Provides probes with a read-only view of a run, updates them in every step and at breaks of bonds, and warns of
 * supports whose bonds break. */
#include <stdio.h>

#include "fracture/fracture_part.h"
#include "grid/grid_part.h"
#include "coupling/coupling_part.h"
#include "probes/probes_part.h"
#include "probes/diagnostics.h"
#include "run/say.h"
#include "step/sample.h"

struct observed_run observed_run_make_read_only_view(const struct run *run)
{
    const struct scene *s = run->scene;
    return (struct observed_run){
        .part = &run->part,
        .cells = &run->cells,
        .bonds = &run->bonds,
        .kernels = &run->kernels,
        .loads = &run->loads,
        .grid = &run->grid->field[0].grid,
        .tips = &run->fracture->tips,
        .material = s->material,
        .partial = &run->coupling->partial,
        .spacing = s->spacing,
        .thickness = run->source.family.section,
        .strain_stress = run->probing->strain_stress,
        .residual_step0 = run->probing->residual_step0,
        .t = run->clock.t,
        .in_steps = scene_has_load_steps(s),
        .load_step = run->clock.load_step,
        .t_velocity = run->clock.step > 0 && scene_is_dynamic(s) ? run->clock.t - 0.5 * run->clock.dt : run->clock.t,
        .pulse = run->probing->pulse,
        .pulses = run->probing->pulses,
        .space = s->space,
        .horizon = run->source.family.horizon,
        .crack = s->crack,
        .cracks = s->cracks,
        .energy_change = diagnostics_relative_energy_balance_error(run->diagnostics),
        .growth = run->fracture->growth,
        .growths = s->growths,
        .baseline = run->probing->has_baseline ? &run->probing->baseline : NULL};
}

void run_update_break_and_reaction_probes(struct run *run)
{
    struct observed_run o = observed_run_make_read_only_view(run);
    probes_update_break_spall_and_reaction_probes(&run->probing->probes, &o);
}

/* Adds the warning to `to` that the first bonds of particles with prescribed motion break, with the first of `loads`
 * that drives such particles, and prints it. when: the time, as "at 1 s" or "in load step 1". p: all particles. */
static void say_torn(struct warnings *to, const struct loads *loads, const struct particles *p, const char *when)
{
    const uint8_t both = FLAG_DRIVEN | FLAG_LOST_BOND;
    const char *name = "";
    char text[768];
    int others = -1;
    for (int b = loads->n; b-- > 0;) {
        const struct load *l = &loads->load[b];
        bool tears = false;
        for (int64_t k = 0; k < l->n && l->boundary->kind == BOUNDARY_VELOCITY; k++)
            tears |= (p->flag[l->particle[k]] & both) == both;
        if (tears) name = l->boundary->name, others++;
    }
    snprintf(
        text, sizeof text,
        "boundary %s%s: bonds of the particles that it drives break, the first %s, so the grip may tear off and "
        "no longer load the body. If the motion stretches the body behind beyond the stretch at which bonds break, use "
        "a lower speed or a motion that ends; if the grip alone tears, drive a deeper layer (a larger depth or "
        "region). Look at the damage there. "
        "These bonds count in crack.driven_bonds, not in crack.start_time and probes",
        name, others > 0 ? " and others" : "", when);
    warnings_add_and_print(to, text);
}

void run_record_first_break_and_update_break_probes(struct run *run, int64_t broken_bond_count)
{
    /* a load step breaks bonds before its end, but is recorded at its end */
    const bool in_steps = scene_has_load_steps(run->scene);
    const real t =
        in_steps ? run->scene->duration / (real)run->scene->steps.number * (real)run->clock.load_step : run->clock.t;
    struct observed_run o = observed_run_make_read_only_view(run);
    char when[48];
    if (in_steps)
        snprintf(when, sizeof when, "in load step %lld", (long long)run->clock.load_step);
    else
        snprintf(when, sizeof when, "at %.4g s", t);
    if (diagnostics_count_broken_bonds_and_record_first(run->diagnostics, &run->part, run->source.family.horizon,
                                                        broken_bond_count, t))
        say_torn(&run->warnings, &run->loads, &run->part, when);
    if (scene_is_dynamic(run->scene)) run_update_break_and_reaction_probes(run);
    o.t = t;
    if (in_steps && broken_bond_count > 0) probes_update_break_and_spall_probes(&run->probing->probes, &o);
}
