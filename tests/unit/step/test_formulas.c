/* Tests formulas of loads that have no value at some time: the run stops with a one-line message that names the
 * load. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>

#include "tests/support/scene_with.h"
#include "engine/engine.h"
#include "step/report.h"

#define TILE                                                                                                           \
    "space: plane stress\nthickness: 0.37 mm\nduration: 5 us\n"                                                        \
    "material: {young: 72 GPa, density: 2440}\nbody: {box: {from: [0, 0], to: [8 mm, 6 mm]}}\n"                        \
    "particles: {spacing: 1 mm}\n"

struct scene_run {
    struct scene s;
    struct run e;
};

/* Runs the scene `text` with the overrides `key=value`, terminated by NULL. a: receives the run. Returns the status. */
static status run_of(struct scene_run *a, const char *text, ...)
{
    va_list list;
    memset(a, 0, sizeof *a);
    va_start(list, text);
    const status s = scene_with(&a->s, text, list);
    va_end(list);
    TRY(s);
    TRY(run_set_up_from_scene(&a->e, &a->s, NULL));
    a->e.report->quiet = true;
    return run_advance_to_end_time(&a->e);
}

static void run_end(struct scene_run *a)
{
    run_free_memory(&a->e);
    scene_free(&a->s);
}

/* Checks formulas that have no value from some time on, early or only in the last step, for every kind of load and
 * every solver with steps: the message has the name of the load and the time. With values up to the end the run
 * completes. */
static void formulas_without_value_stop_the_run(void **state)
{
    (void)state;
    static const char *const load[][2] = {{"displacement: [free, '1e-9 m*(t/1us)*", "face: y+, depth: 1 mm"},
                                          {"traction: [0, '1e3 Pa*", "face: y+"},
                                          {"body_force: [0, '1e3 N/m^3*", "region: {all: true}"},
                                          {"pressure: '1e3 Pa*", "region: {all: true}"},
                                          {"velocity: [free, '1e-3 m/s*", "face: y+, depth: 1 mm"},
                                          {"pressure: '1e3 Pa*", "region: {all: true}, follow: true"}};
    static const char *const ends[] = {"1us", "4.99us", "5us"};
    static const char *const solver[][2] = {{"method=pd", "mpm.frame=auto"},
                                            {"method=mpm", "mpm.frame=reference"},
                                            {"method=mpm", "mpm.frame=current"},
                                            {"method=pd", "solver=static"},
                                            {"method=mpm", "solver=static"}};
    for (size_t l = 0; l < sizeof load / sizeof *load; l++)
        for (size_t m = 0; m < sizeof solver / sizeof *solver; m++)
            for (size_t k = 0; k < 3; k++) {
                char text[512];
                struct scene_run a;
                if (m > 2 && l > 3) continue; /* refused in load steps */
                snprintf(text, sizeof text,
                         "boundary=[{name: pull, %ssqrt(1-t/%s)'%s, %s}, {fixed: [x, y], face: y-, depth: 1 mm}]",
                         load[l][0], ends[k], strchr(load[l][0], '[') ? "]" : "", load[l][1]);
                const status s = run_of(&a, TILE, solver[m][0], solver[m][1], text, NULL);
                const char *said = strstr(status_message(), "boundary pull: its formula has no finite value at (");
                const char *time = said ? strstr(said, " m and t = ") : NULL;
                const real t = time ? atof(time + strlen(" m and t = ")) : 0;
                const bool told = said && t > (k ? 4.98e-6 : 0.999e-6) && t < 5.001e-6;
                if (k < 2 ? s != FAILED || !told : s != OK)
                    fail_msg("%s %s %s: status %d: %s", text, solver[m][0], solver[m][1], (int)s, status_message());
                run_end(&a);
            }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(formulas_without_value_stop_the_run)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
