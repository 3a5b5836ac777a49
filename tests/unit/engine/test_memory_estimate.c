/* Checks that the predicted memory of a scene, by which scenes are refused, is close to the memory that its run
 * uses. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <cmocka.h>

#include "engine/engine.h"
#include "base/memory.h"
#include "step/report.h"
#include "scene/scene_read.h"

/* Runs a block with the keys `space`, `box` and `particles` of a scene. Checks that the peak memory of the process is
 * more than half of the estimate and at most 1.1 times the estimate plus 30 MB for program and libraries. *taken:
 * receives this peak [byte]. Calls must be in the order of increasing memory, since the process remembers only its
 * maximum. */
static void takes_what_it_says(const char *space, const char *box, const char *particles, double *taken)
{
    char text[1024];
    struct scene s = {0};
    struct run e = {0};
    snprintf(
        text, sizeof text,
        "name: block\nspace: %s\nmethod: pd\nduration: 1 us\ntime: {step: 50 ns}\nparticles: {%s}\nbody: {box: {%s}}\n"
        "material: {young: 72e9, density: 2440, critical_stretch: 0.1}\noutput: {frames: 0, samples: 1}\n",
        space, particles, box);
    if (scene_read_text(&s, text, strlen(text), "block", NULL, 0) != OK) fail_msg("%s", status_message());
    if (run_set_up_from_scene(&e, &s, NULL) != OK) fail_msg("%s", status_message());
    e.report->quiet = true;
    if (run_advance_to_end_time(&e) != OK) fail_msg("%s", status_message());
    *taken = (double)memory_peak_resident_size();
    const double said = run_estimate_peak_memory(&s, &e.part, &e.source);
    print_message("%.5s, %s: said %.0f MB, with what was there before at most %.0f MB\n", space, particles, 1e-6 * said,
                  1e-6 * *taken);
    assert_true(*taken < 1.1 * said + 30e6); /* the program and its libraries */
    assert_true(*taken > 0.5 * said);
    run_free_memory(&e);
    scene_free(&s);
}

static void test_lattice_then_scattered(void **state)
{
    (void)state;
    double lattice, scattered, solid;
    takes_what_it_says("plane stress\nthickness: 1 mm", "from: [0, 0], to: [0.5, 0.5]", "spacing: 1 mm", &lattice);
    takes_what_it_says("plane stress\nthickness: 1 mm", "from: [0, 0], to: [0.5, 0.5]",
                       "spacing: 1 mm, irregularity: 0.1", &scattered);
    takes_what_it_says("solid", "from: [0, 0, 0], to: [0.05, 0.05, 0.05]", "spacing: 1 mm, irregularity: 0.1", &solid);
    assert_true(lattice < 0.5 * scattered);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_lattice_then_scattered)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
