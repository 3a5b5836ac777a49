/* Table of failing scenes, and the creation of their runs. */
#include "limits_scenes.h"

#include <math.h>
#include <omp.h>
#include <stdarg.h>
#include <stdio.h>

const struct limits_scene *const limits_scene[FAILING_SCENES] = {
    &limits_crossing,     &limits_homologous,    &limits_null_mode,  &limits_faces,     &limits_spin,
    &limits_disc,         &limits_corner_figure, &limits_shear,      &limits_vibration, &limits_million,
    &limits_modes_figure, &limits_softest,       &limits_single,     &limits_inversion, &limits_closing,
    &limits_beyond,       &limits_twins,         &limits_renumbered,
};

status limits_measure(const struct limits_scene *s, const struct limits_row *r, double measured[FAILING_FIGURES])
{
    const int team = omp_get_max_threads();
    for (int k = 0; k < FAILING_FIGURES; k++) measured[k] = NAN;
    omp_set_num_threads(1);
    const status done = s->measure(r, measured);
    omp_set_num_threads(team);
    return done;
}

void limits_label(const struct limits_scene *s, const struct limits_row *r, char *text, size_t capacity)
{
    char given[64];
    snprintf(given, sizeof given, s->given ? s->given : "", r->given);
    snprintf(text, capacity, "%s%s%s", r->method, s->given ? ", " : "", given);
}

int limits_quantity_count(const struct limits_scene *s)
{
    int n = 0;
    while (n < FAILING_FIGURES && s->figure[n].quantity) n++;
    return n;
}

bool limits_quantities_are_below_thresholds(const struct limits_scene *s, const double *measured)
{
    for (int k = 0; k < limits_quantity_count(s); k++)
        if (!(measured[k] <= s->figure[k].threshold)) return false;
    return true;
}

status limits_make_run_of_scene(struct run *run, struct scene *s, const struct limits_row *r, const char *text, ...)
{
    struct bench_overrides o = {0};
    char whole[4096];
    va_list more;
    va_start(more, text);
    vsnprintf(whole, sizeof whole, text, more);
    va_end(more);
    if (!strstr(whole, "frame:"))
        bench_overrides_append(&o, "mpm.frame", "current"); /* rows for the reference frame set the
                                                             * key */
    for (const char *const *k = r->set; *k; k += 2) bench_overrides_append(&o, k[0], "%s", k[1]);
    return bench_engine_make(run, s, "failing", whole, bench_overrides_as_array(&o), o.n);
}
