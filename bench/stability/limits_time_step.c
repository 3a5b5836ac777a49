/* Time steps beyond the stability limit must stop the run, with position, step and remedy. */
#include <math.h>
#include <string.h>

#include "limits_scenes.h"
#include "stability.h"

static bool says_all(const char *message)
{
    static const char *const part[] = {"unstable at step ", ": particle ",
                                       "choose a smaller time.step (now dt = ", " of the critical "};
    for (size_t k = 0; k < COUNT_OF(part); k++)
        if (!strstr(message, part[k])) return false;
    return true;
}

status stability_find_step_of_automatic_stop(const struct stability_case *c, double time_step_ratio, double *stop_step)
{
    static const char *const at[] = {"", "[3e-3], direction: [1]", "[3e-3, 3e-3], direction: [1, 0.2]",
                                     "[3e-3, 3e-3, 3e-3], direction: [1, 0.2, 0.1]"};
    struct stability_limits l;
    struct bench_overrides o = {0};
    struct run e;
    struct scene s;
    char text[4096];
    TRY(stability_determine_limits(c, 250, 0, &l));
    stability_write_scene_text(c, text, sizeof text);
    bench_overrides_append(&o, "time.step", "%.17g", time_step_ratio * l.observed);
    bench_overrides_append(&o, "duration", "%.17g", 1000 * time_step_ratio * l.observed);
    bench_overrides_append(&o, "initial", "[{pulse: {at: %s, width: 5e-3, velocity: 1}}]", at[c->dim]);
    bench_overrides_append(&o, "output.samples", "100");
    TRY(bench_engine_make(&e, &s, "block", text, bench_overrides_as_array(&o), o.n));
    *stop_step = run_advance_to_end_time(&e) == FAILED && says_all(status_message()) ? (double)e.clock.step : INFINITY;
    bench_engine_free(&e, &s);
    return OK;
}

/* ---- row of the table -------------------------------------------------------------------------------------------- */

/* Cases that are run beyond their stability limit: one for each kind of method. */
static const struct stability_case beyond[] = {
    {.dim = 2, .method = "pd"},
    {.dim = 2, .method = "pd", .model = "mospd"},
    {.group = GROUP_POINTS, .dim = 2, .method = "mpm", .shape = "gimp", .transfer = "flip"},
    {.group = GROUP_POINTS, .dim = 2, .method = "mpm", .shape = "gimp", .transfer = "apic"},
    {.dim = 2, .method = "adaptive"},
    {.dim = 2, .method = "mpm", .frame = "reference"},
};

/* Runs a case with 1.2 times its observed stability limit and stores in *to the number of steps until the run stops
 * with a complete message; INFINITY if it does not. r->given: index of the case in beyond[]. Returns REFUSED or FAILED
 * if the limit cannot be determined. */
static status caught(const struct limits_row *r, double *to)
{
    return stability_find_step_of_automatic_stop(&beyond[(int)r->given], 1.2, to);
}

#define BEYOND(name, k)                                                                                                \
    {                                                                                                                  \
        .method = name, .given = k, .known = { {1, 1000} }                                                             \
    }
static const struct limits_row steps[] = {
    BEYOND("bonds", 0),
    BEYOND("mospd", 1),
    BEYOND("gimp flip", 2),
    BEYOND("gimp apic", 3),
    BEYOND("partial stress, gimp flip", 4),
    BEYOND("reference frame", 5),
};
const struct limits_scene limits_beyond = {
    "1.2 times the critical step", NULL, {{"steps until it is stopped", 1000}}, ROWS(steps), caught};
