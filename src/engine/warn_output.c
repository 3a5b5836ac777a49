/* Warns of frames that a run never writes: their times or their interval lie beyond the duration. */

#include "engine_internal.h"

void run_warn_of_frames_after_end_of_run(const struct scene *s, struct warnings *warnings)
{
    const real end = s->duration * (1 + 1e-9);
    if (s->every > end)
        warnings_add_if_new(warnings,
                            "output.every: %.3g s is longer than the duration of %.3g s, so only the first and the "
                            "last frame are written; check its unit (s if none is written)",
                            s->every, s->duration);
    for (int k = 0; k < s->n_series; k++)
        if (s->series[k].every > end)
            warnings_add_if_new(warnings,
                                "output.regions: %s: every %.3g s is longer than the duration of %.3g s; check its "
                                "unit (s if none is written)",
                                s->series[k].name, s->series[k].every, s->duration);
    if (s->times.n > 0 && s->times.value[s->times.n - 1] > end)
        warnings_add_if_new(warnings,
                            "output.times: %d of %d are after the duration of %.3g s (the last at %.3g s) and have no "
                            "frame; check their unit (s if none is written)",
                            s->times.n - s->frames, s->times.n, s->duration, s->times.value[s->times.n - 1]);
}
