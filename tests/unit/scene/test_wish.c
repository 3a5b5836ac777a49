/* Tests what a scene with `method: auto` requires of its pilot runs: accuracy, result, time limit, and the provisional
 * scene. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "scene/scene_read.h"

#define PLATE                                                                                                          \
    "method: auto\nspace: plane stress\nthickness: 1 mm\nduration: 1 us\n"                                             \
    "material: {young: 2e11, poisson: 1/3, density: 8000}\nbody: {box: {from: [0, 0], to: [40 mm, 20 mm]}}\n"

/* Reads the scene `text` from a temporary file. w: receives its requirements for pilot runs. Returns the status. */
static status wish_of(struct pilot_requirements *w, const char *text)
{
    char path[] = "/tmp/cleave-wish-XXXXXX";
    const int file = mkstemp(path);
    struct scene s;
    assert_true(file >= 0);
    assert_int_equal(write(file, text, strlen(text)), strlen(text));
    close(file);
    const status read = scene_read_unless_pilot_runs_are_needed(&s, w, path, NULL, 0);
    assert_int_equal(unlink(path), 0);
    if (read == OK && w->wanted) assert_null(s.path);
    if (read == OK && !w->wanted) scene_free(&s);
    return read;
}

static void a_share_alone(void **state)
{
    (void)state;
    struct pilot_requirements w;
    assert_int_equal(wish_of(&w, PLATE "accuracy: 2 %\n"), OK);
    assert_true(w.wanted && w.has_accuracy && !w.at_rest && w.spacing == 0);
    assert_true(fabs(w.within - 0.02) < 1e-15 && w.budget == 300);
    assert_string_equal(w.figure, "");
    assert_string_equal(w.model, "");
    /* The plate is resolved with at most 3000 particles. */
    assert_int_equal(w.provisional.method, METHOD_ADAPTIVE);
    assert_true(w.provisional.spacing > 0.4e-3 && w.provisional.spacing < 0.52e-3);
    scene_free(&w.provisional);
}

static void all_that_can_be_given(void **state)
{
    (void)state;
    struct pilot_requirements w;
    assert_int_equal(wish_of(&w, PLATE "accuracy: {of: energy.strain, within: 3 %, budget: 2 min}\nmodel: ospd\n"
                                       "solver: static\nparticles: {spacing: 1 mm}\npd: {surface: volume}\n"),
                     OK);
    assert_true(w.wanted && w.at_rest && fabs(w.spacing - 1e-3) < 1e-15 && w.budget == 120);
    assert_string_equal(w.figure, "energy.strain");
    assert_string_equal(w.model, "ospd");
    assert_true(w.provisional.spacing == w.spacing);
    scene_free(&w.provisional);
}

/* Checks that the provisional method of joined bodies is pd, because adaptive runs refuse interfaces. */
static void joined_bodies_are_for_bonds(void **state)
{
    (void)state;
    struct pilot_requirements w;
    assert_int_equal(wish_of(&w, "method: auto\nspace: line\nduration: 3 us\nmaterials:\n"
                                 "  - {name: steel, young: 200 GPa, density: 8000}\n"
                                 "  - {name: light, young: 70 GPa, density: 2700}\nbodies:\n"
                                 "  - {name: left, material: steel, shape: {box: {from: [0], to: [10 mm]}}}\n"
                                 "  - {name: right, material: light, shape: {box: {from: [10 mm], to: [20 mm]}}}\n"
                                 "interfaces: [{bodies: [left, right]}]\n"),
                     OK);
    assert_int_equal(w.provisional.method, METHOD_PD);
    assert_false(w.has_accuracy);
    scene_free(&w.provisional);
}

/* Checks that scenes with another method need no pilot runs and are read as by scene_read(), and that invalid scenes
 * are refused without requirements. */
static void other_scenes_have_no_wish(void **state)
{
    (void)state;
    static const struct {
        const char *text, *why;
    } wrong[] = {
        {PLATE "accuracy: 0\n", "out of range"},
        {PLATE "accuracy: {of: [1]}\n", "not a figure of summary.json"},
        {PLATE "accuracy: {budget: 0}\n", "out of range"},
        {PLATE "accuracy: {bydget: 3 s}\n", "did you mean budget?"},
        {PLATE "solver: static\nsteps: {number: 3}\n", "cannot be combined with load steps"},
        {PLATE "nonsense: 1\n", "unknown key"},
        {PLATE "accuracy_table: mine.csv\n", "is no longer a key"},
        {PLATE "accuracy_chart: mine.csv\n", "is no longer a key"},
    };
    struct pilot_requirements w;
    for (size_t k = 0; k < COUNT_OF(wrong); k++) {
        assert_int_equal(wish_of(&w, wrong[k].text), REFUSED);
        if (!strstr(status_message(), wrong[k].why)) fail_msg("%s", status_message());
        assert_false(w.wanted);
        assert_null(w.provisional.path);
    }
    const char *plain = strchr(PLATE, '\n') + 1;
    assert_int_equal(wish_of(&w, plain), REFUSED); /* particles.spacing is missing */
    char whole[1024];
    snprintf(whole, sizeof whole, "%sparticles: {spacing: 1 mm}\n", plain);
    assert_int_equal(wish_of(&w, whole), OK);
    assert_false(w.wanted);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_share_alone),
        cmocka_unit_test(all_that_can_be_given),
        cmocka_unit_test(joined_bodies_are_for_bonds),
        cmocka_unit_test(other_scenes_have_no_wish),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
