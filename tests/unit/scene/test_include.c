/* Tests scenes that include other files: precedence of keys, names and positions in messages, and refusals. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <cmocka.h>

#include "scene/scene.h"
#include "scene/scene_read.h"

static void write_file(const char *name, const char *text)
{
    FILE *out = fopen(name, "w");
    assert_non_null(out);
    fputs(text, out);
    assert_int_equal(fclose(out), 0);
}

static int enter_folder(void **state)
{
    static char folder[] = "/tmp/include_XXXXXX";
    *state = folder;
    return !mkdtemp(folder) || chdir(folder) || mkdir("sub", 0700);
}

static int leave_folder(void **state)
{
    char command[64];
    snprintf(command, sizeof command, "rm -r %s", (const char *)*state);
    return chdir("/") || system(command);
}

static const char base[] = "name: base\n"
                           "variables: {a: 2 mm, n: 4}\n"
                           "space: plane stress\n"
                           "thickness: a\n"
                           "duration: 20 us\n"
                           "method: pd\n"
                           "material: {young: 190 GPa, density: 7800, energy_release_rate: 69 kJ/m^2}\n"
                           "body: {box: {from: [0, 0], to: [10*a, 10*a]}}\n"
                           "particles: {spacing: a/n, horizon: 3.015, seed: 5}\n"
                           "cracks: [{from: [0, 5*a], to: [4*a, 5*a]}]\n"
                           "boundary:\n"
                           "  - {traction: [1 MPa, 0], face: x+}\n"
                           "output: {frames: 3, samples: 20}\n"
                           "probes: [tip, energy]\n";

/* Asserts that the scene at `path`, written out, equals the scene text `flat` except for its name. */
static void assert_like(const char *path, const char *flat)
{
    struct scene s, want;
    if (scene_read(&s, path, NULL, 0) != OK) fail_msg("%s", status_message());
    if (scene_read_text(&want, flat, strlen(flat), path, NULL, 0) != OK) fail_msg("%s", status_message());
    assert_string_equal(s.text, want.text);
    scene_free(&s);
    scene_free(&want);
}

static void later_goes_before(void **state)
{
    (void)state;
    write_file("base.yaml", base);
    write_file("more.yaml", "material: {young: 70 GPa, energy_release_rate: , critical_stretch: 1 %}\n"
                            "output: {frames: 7}\n");
    write_file("outer.yaml", "include: [base.yaml, more.yaml]\n"
                             "variables: {a: 4 mm}\n"
                             "material: {density: 2700}\n"
                             "body: {disc: {centre: [0, 0], radius: 5*a}}\n"
                             "particles: {horizon: 4.015}\n"
                             "cracks:\n"
                             "boundary: [{fixed: all, region: {half-space: {point: [-4*a, 0], normal: [1, 0]}}}]\n");
    assert_like("outer.yaml", "space: plane stress\n"
                              "thickness: 4 mm\n"
                              "duration: 20 us\n"
                              "method: pd\n"
                              "material: {young: 70 GPa, density: 2700, critical_stretch: 1 %}\n"
                              "body: {disc: {centre: [0, 0], radius: 20 mm}}\n"
                              "particles: {spacing: 1 mm, horizon: 4.015, seed: 5}\n"
                              "boundary: [{fixed: all, region: {half-space: {point: [-16 mm, 0], normal: [1, 0]}}}]\n"
                              "output: {frames: 7, samples: 20}\n"
                              "probes: [tip, energy]\n");
}

static void names_and_overrides_are_of_the_scene(void **state)
{
    (void)state;
    struct scene s;
    write_file("base.yaml", base);
    write_file("outer.yaml", "include: base.yaml\n");
    const struct scene_override o[] = {
        {"variables.n", "2"}, {"boundary.0.traction", "[3 MPa, 0]"}, {"material.young", "1 GPa"}};
    if (scene_read(&s, "outer.yaml", o, 3) != OK) fail_msg("%s", status_message());
    assert_string_equal(s.name, "outer");
    assert_true(s.spacing == 1e-3 && s.boundary->value[0] == 3e6 && s.material->young == 1e9);
    scene_free(&s);
}

/* Checks a chain of included files in folders: each name, also that of a list of particles, is relative to the folder
 * of the file that contains it. */
static void files_are_sought_beside_who_names_them(void **state)
{
    (void)state;
    struct scene s;
    write_file("outer.yaml", "include: sub/middle.yaml\nduration: 1 us\n");
    write_file("sub/middle.yaml", "include: inner.yaml\n");
    write_file("sub/inner.yaml", "space: line\nduration: 5 us\nmethod: pd\nmaterial: {young: 1 GPa, density: 1000}\n"
                                 "particles: {spacing: 1 mm}\nbodies: [{particles: list.csv}]\n");
    write_file("sub/list.csv", "x,volume\n0,1e-3\n0.001,1e-3\n");
    if (scene_read(&s, "outer.yaml", NULL, 0) != OK) fail_msg("%s", status_message());
    assert_string_equal(s.body->file, "sub/list.csv");
    assert_true(s.duration == 1e-6);
    scene_free(&s);
}

static void faults_name_the_file(void **state)
{
    (void)state;
    static const struct {
        const char *outer, *inner, *message;
    } wrong[] = {
        {"include: inner.yaml\n", "space: line\nduration: 5 kg\n",
         "sub/inner.yaml:2:1: duration: 5 kg is a mass; give a time, such as 20 us"},
        {"include: inner.yaml\n", "space: line\nmaterial:\n  young: 1\n",
         "sub/outer.yaml:1:1: duration: missing; give a time, such as 20 us"},
        {"include: inner.yaml\nduration: 1\nparticles: {spacing: 1}\n", "space: line\nmaterial:\n  yuong: 1\n",
         "sub/inner.yaml:3:3: yuong: unknown key; did you mean young?"},
        {"include: inner.yaml\nmaterial: {yuong: 3}\nduration: 1\nparticles: {spacing: 1}\n",
         "space: line\nmaterial: {young: 1}", "sub/outer.yaml:2:12: yuong: unknown key; did you mean young?"},
        {"include: inner.yaml\nbodies: []\nduration: 1\nparticles: {spacing: 1}\n",
         "space: line\nmaterial: {young: 1, density: 1}\nbody: {box: {from: 0, to: 1}}\n",
         "sub/outer.yaml:2:1: bodies: is given together with body; remove one of the two"},
        {"include: inner.yaml\n", "space: [",
         "sub/inner.yaml:2:1: not YAML: did not find expected node content; indent by spaces (not tabs), write `: ` "
         "after each key, and close all brackets"},
        {"include: inner.yaml\n", "a: 1\na: 2\n",
         "sub/inner.yaml:2:1: a: is given twice, first in line 1; remove one of the two"},
        {"include: inner.yaml\n", "a: &b 1\n",
         "sub/inner.yaml:1:4: an anchor (&) is not allowed in a scene; write the value "
         "out where it is used"},
        {"include: inner.yaml\n", "- 1\n",
         "sub/inner.yaml:1:1: a list is not allowed here; give a scene, which is a mapping of keys to values"},
        {"include: inner.yaml\n", "",
         "sub/inner.yaml:1:1: the scene is empty; begin with keys such as space and duration"},
        {"include: inner.yaml\n", "include: outer.yaml\n",
         "sub/inner.yaml:1:1: include: outer.yaml includes itself, or the scene that includes it; remove one of these "
         "includes"},
        {"include: inner.yaml\n", "include: inner.yaml\n",
         "sub/inner.yaml:1:1: include: inner.yaml includes itself, or the scene that includes it; remove one of these "
         "includes"},
        {"a: 1\ninclude: outer.yaml\n", "",
         "sub/outer.yaml:2:1: include: outer.yaml includes itself, or the scene that includes it; remove one of these "
         "includes"},
        {"include: no.yaml\n", "",
         "sub/outer.yaml:1:1: include: no.yaml cannot be read; give a scene file in the folder of this one"},
        {"include: .\n", "",
         "sub/outer.yaml:1:1: include: . cannot be read; give a scene file in the folder of this one"},
        {"include: []\n", "", "sub/outer.yaml:1:1: include: has 0 items; give 1 to 64"},
        {"include:\n", "", "sub/outer.yaml:1:1: include: no value is not a file name; give a scene file"},
        {"include: [{a: 1}]\n", "", "sub/outer.yaml:1:11: include[0]: a mapping is not a file name; give a scene file"},
        {"include: inner.yaml\ninclude: inner.yaml\n", "space: line\n",
         "sub/outer.yaml:2:1: include: is given twice, first in line 1; remove one of the two"},
        {"include: inner.yaml\nduration: 1\n", "space: line\nduration:\n  include: b.yaml\nparticles: {include: a}\n",
         "sub/inner.yaml:4:13: include: this key does not belong here; put include at the left margin"},
    };
    for (size_t k = 0; k < COUNT_OF(wrong); k++) {
        struct scene s;
        write_file("sub/outer.yaml", wrong[k].outer);
        write_file("sub/inner.yaml", wrong[k].inner);
        if (scene_read(&s, "sub/outer.yaml", NULL, 0) != REFUSED) fail_msg("not refused: %s", wrong[k].message);
        assert_string_equal(status_message(), wrong[k].message);
    }
    static const struct scene_override o = {"include", "inner.yaml"};
    struct scene s;
    assert_int_equal(scene_read(&s, "base.yaml", &o, 1), REFUSED);
    assert_string_equal(
        status_message(),
        "-s include=inner.yaml: include cannot be given by -s; write a scene file that includes this one");
    assert_int_equal(scene_read_text(&s, "include: a.yaml\n", 16, "text", NULL, 0), REFUSED);
    assert_string_equal(
        status_message(),
        "text:1:1: include: a.yaml: scenes with the key include cannot be read here; give a scene without this key");
}

static void chains_and_numbers_are_bounded(void **state)
{
    (void)state;
    struct scene s;
    char name[32], text[4000] = "include: [";
    for (int k = 0; k < 12; k++) {
        snprintf(name, sizeof name, "chain%d.yaml", k);
        snprintf(text, sizeof text, "include: chain%d.yaml\n", k + 1);
        write_file(name, text);
    }
    assert_int_equal(scene_read(&s, "chain0.yaml", NULL, 0), REFUSED);
    assert_string_equal(status_message(), "chain7.yaml:1:1: include: chain8.yaml ends a chain of more than 8 scenes, "
                                          "each included by the previous one; merge some of them");
    write_file("leaf.yaml", "space: line\n");
    strcpy(text, "include: [leaf.yaml");
    for (int k = 1; k < 64; k++) strcat(text, ", leaf.yaml");
    strcat(text, "]\n");
    write_file("many.yaml", text);
    assert_int_equal(scene_read(&s, "many.yaml", NULL, 0), REFUSED);
    assert_string_equal(status_message(), "many.yaml:1:1: duration: missing; give a time, such as 20 us");
    write_file("twice.yaml", "include: [many.yaml, many.yaml]\n");
    assert_int_equal(scene_read(&s, "twice.yaml", NULL, 0), REFUSED);
    assert_non_null(strstr(status_message(), "more than 64 scenes are included; merge some of them"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(later_goes_before),
        cmocka_unit_test(names_and_overrides_are_of_the_scene),
        cmocka_unit_test(files_are_sought_beside_who_names_them),
        cmocka_unit_test(faults_name_the_file),
        cmocka_unit_test(chains_and_numbers_are_bounded),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
