/* Repeats a run that has a PULSE probe (reflected and transmitted part of a wave packet) with material points alone.
 * This reference run separates the effect of the interface from that of the discretisation. */
#include <string.h>

#include "engine/engine.h"
#include "base/memory.h"
#include "probes/probes_part.h"
#include "step/report.h"
#include "step/step.h"

/* Returns true if scene s requires a reference run, in which all particles are material points: it has a probe of kind
 * PULSE (reflected and transmitted part of a wave packet at an interface) and a method other than mpm. */
static bool wanted(const struct scene *s)
{
    for (int k = 0; k < s->probes; k++)
        if (s->probe[k].kind == PROBE_PULSE) return s->method != METHOD_MPM;
    return false;
}

/* Stores the velocities of the particles p at the end of the reference run, and its relative energy change
 * `energy_change` [1], in probing->baseline. The particles have the same order as in the main run, because they are
 * created and sorted before any becomes peridynamic. */
static void baseline_keep(struct probing *probing, const struct particles *p, real energy_change)
{
    for (int d = 0; d < p->dim; d++) {
        probing->baseline.v[d] = NEW("baseline.v", p->n, real);
        array_copy(probing->baseline.v[d], p->v[d], p->n, sizeof *p->v[d]);
    }
    probing->baseline.energy_change = energy_change;
    probing->has_baseline = true;
}

status run_repeat_with_mpm_only_for_pulse_probe(struct run *run)
{
    if (!wanted(run->scene)) return OK;
    struct scene scene = *run->scene;
    struct run twin = {0};
    scene.method = METHOD_MPM;
    scene.probes = 0;
    scene.time_step = run->clock.dt;
    status s = run_set_up_from_scene(&twin, &scene, NULL);
    twin.report->quiet = true;
    if (s == OK) s = run_advance_to_end_time(&twin);
    if (s == OK) baseline_keep(run->probing, &twin.part, observed_run_make_read_only_view(&twin).energy_change);
    run_free_memory(&twin);
    return s;
}
