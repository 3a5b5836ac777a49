/* Checks cracks in the plate of inputs/plate_crack.yaml (Zeng et al. 2022) at four spacings. The band of damage along a
 * crack must be a constant number of spacings wide; crack length and fracture energy must not depend on the spacing. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "engine/engine.h"
#include "fracture/fracture_part.h"
#include "fracture/tips.h"
#include "probes/diagnostics.h"
#include "scene/scene_read.h"

#define SCENE "inputs/plate_crack.yaml"

/* Smallest damage that counts as damaged [1]; a particle that loses one of its 28 bonds has 0.036. */
#define DAMAGED 0.02

struct band {
    real width, growth, fracture;
}; /* [m], [m], [J] */

/* Returns the mean width of the damage ahead of both ends of the pre-crack [m]: the area of the particles with more
 * than DAMAGED, divided by the length of both crack increments. growth: length of one crack increment [m]. */
static real band_width(const struct run *run, real growth)
{
    const struct particles *p = &run->part;
    real area = 0;
    for (int64_t i = 0; i < p->n; i++) {
        real ahead = fabs(p->X[0][i]) - 5e-3; /* beyond the end of the pre-crack [m] */
        if (p->damage[i] > DAMAGED && ahead > 0 && ahead < growth) area += square(run->scene->spacing);
    }
    return area / (2 * growth);
}

/* Runs the scene to its end with this spacing and method. Returns width of the band, growth of the longest tip, and
 * fracture energy. */
static struct band band_of(const char *spacing, const char *method)
{
    const struct scene_override override[] = {{"particles.spacing", spacing}, {"method", method}};
    struct scene s;
    struct run e = {0};
    if (scene_read(&s, SCENE, override, COUNT_OF(override)) != OK) fail_msg("%s", status_message());
    if (run_set_up_from_scene(&e, &s, NULL) != OK || run_advance_to_end_time(&e) != OK)
        fail_msg("%s", status_message());
    const struct crack_tip *tip = tips_find_tip_with_largest_growth(&e.fracture->tips);
    assert_non_null(tip);
    struct band b = {band_width(&e, tip->growth), tip->growth, e.diagnostics->now.energy.fracture};
    run_free_memory(&e);
    scene_free(&s);
    return b;
}

/* Checks cracks by `method` at four spacings. Width: 6 to 7.3 spacings (measured 6 to 7.1), as a crack cuts the bonds
 * across it, two horizons of 3.015 spacings. Fracture energy: within 10 % of that at the finest spacing, as G_c is
 * equal. Crack increment: within 0.8 mm of that at the finest spacing, less than the coarsest spacing (measured, coarse
 * to fine: 4.53, 4.08, 3.76, 4.22 mm with pd, 3.54, 3.45, 3.76, 4.22 mm with adaptive). */
static void check_bands(const char *method)
{
    static const struct {
        const char *text;
        real value;
    } spacing[] = {{"1 mm", 1e-3}, {"0.625 mm", 0.625e-3}, {"0.5 mm", 0.5e-3}, {"0.3125 mm", 0.3125e-3}};
    struct band b[COUNT_OF(spacing)];
    for (size_t k = 0; k < COUNT_OF(spacing); k++) b[k] = band_of(spacing[k].text, method);
    const struct band *finest = &b[COUNT_OF(spacing) - 1];
    for (size_t k = 0; k < COUNT_OF(spacing); k++) {
        real spacings = b[k].width / spacing[k].value;
        if (!(spacings > 6 && spacings < 7.3))
            fail_msg("%s at %s: band of %g spacings", method, spacing[k].text, spacings);
        if (k > 0 && !(b[k].width < b[k - 1].width)) fail_msg("%s: no thinner at %s", method, spacing[k].text);
        if (!(fabs(b[k].growth - finest->growth) < 0.8e-3))
            fail_msg("%s at %s: grew by %g m", method, spacing[k].text, b[k].growth);
        if (!(fabs(b[k].fracture / finest->fracture - 1) < 0.1))
            fail_msg("%s at %s: fracture energy %g J, at the finest %g J", method, spacing[k].text, b[k].fracture,
                     finest->fracture);
    }
}

static void test_pd(void **state)
{
    (void)state;
    check_bands("pd");
}
static void test_adaptive(void **state)
{
    (void)state;
    check_bands("adaptive");
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_pd), cmocka_unit_test(test_adaptive)};
    threads_set_count_and_bind_to_cores(0);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
