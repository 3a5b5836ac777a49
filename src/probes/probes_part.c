/* Registers probes with the engine: defines part_probing, their entry in the table of modules (struct part). Also
 * advances growing cracks, and computes reference values of the initial state for probes. */
#include "probes/probes_part.h"
#include "base/memory.h"
#include "fracture/fracture_part.h"
#include "run/part.h"

static void probing_free_all(struct run *run)
{
    struct probing *probing = run->probing;
    probes_free(&probing->probes);
    for (int d = 0; d < DIM_MAX; d++) memory_free(probing->baseline.v[d]);
    memory_free(probing->pulse);
}

int64_t cracks_grow_one_step_and_count_cut_bonds(struct run *run)
{
    int64_t released = 0;
    for (int k = 0; k < run->scene->growths; k++) {
        struct growth_control r;
        const bool known = probes_copy_sif_to_growth_control(&run->probing->probes, run->scene->growth[k].probe, &r);
        released +=
            growing_crack_advance_and_count_cut_bonds(&run->fracture->growth[k], &run->bonds, &run->part, &run->source,
                                                      known ? &r : NULL, run->clock.t, run->clock.dt);
    }
    return released;
}

real particles_largest_stress_component(const struct particles *p)
{
    real most = 0;
    for (int c = 0; c < symmetric_tensor_component_count(p->dim); c++)
        for (int64_t i = 0; i < p->n; i++) most = real_max(most, fabs(p->stress[c][i]));
    return most;
}

void scene_list_initial_wave_pulses(const struct scene *s, struct probing *probing)
{
    probing->pulse = NEW("engine.pulse", s->initials, struct wave_pulse);
    for (int k = 0; k < s->initials; k++)
        if (s->initial[k].sets_pulse) probing->pulse[probing->pulses++] = s->initial[k].pulse;
}

static status probing_state(struct run *run, struct archive *a)
{
    ARCHIVE_VALUE(a, "engine/residual_step0", run->probing->residual_step0);
    return probes_save_or_load(&run->probing->probes, a);
}

const struct part part_probing = {PART(probing, probing), .free = probing_free_all, .state = probing_state};
