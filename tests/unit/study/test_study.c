/* Tests studies: values of varied keys, names of runs, contents of tables. */
#include "tests/support/near.h"

#include <math.h>
#include <unistd.h>
#include <string.h>
#include <stdlib.h>
#include <time.h>

#include "src/study/study_internal.h"
#include "output/output_files.h"
#include "study/convergence_study.h"

/* ---- values ------------------------------------------------------------------------------------------------------ */

/* Asserts that the text `text` of a varied key yields the values value[n]. */
static void check_values(const char *text, int n, const char *const *value)
{
    struct varied_key k;
    assert_int_equal(varied_key_parse_name_and_values(&k, text), OK);
    assert_int_equal(k.values, n);
    for (int v = 0; v < n; v++) assert_string_equal(k.value[v], value[v]);
    varied_key_free(&k);
}

static void lists_and_rows_are_read(void **state)
{
    (void)state;
    check_values("a.b=1mm,0.5mm", 2, (const char *[]){"1mm", "0.5mm"});
    check_values("a= x , y ", 2, (const char *[]){"x", "y"});
    check_values("a=[1, 2],[3, 4]", 2, (const char *[]){"[1, 2]", "[3, 4]"});
    check_values("a={step: {until: 1us, from: 0}}", 1, (const char *[]){"{step: {until: 1us, from: 0}}"});
    check_values("a=max(b, 2 mm),3 mm", 2, (const char *[]){"max(b, 2 mm)", "3 mm"});
    check_values("a=\"x,y\",z", 2, (const char *[]){"\"x,y\"", "z"});
    check_values("a=10:30:10", 3, (const char *[]){"10", "20", "30"});
    check_values("a=10:30:10 m/s", 3, (const char *[]){"10 m/s", "20 m/s", "30 m/s"});
    check_values("a=1mm:0.5mm:-0.25mm", 3, (const char *[]){"1 mm", "0.75 mm", "0.5 mm"});
    check_values("a=0:1:0.1", 11,
                 (const char *[]){"0", "0.1", "0.2", "0.3", "0.4", "0.5", "0.6", "0.7", "0.8", "0.9",
                                  "1"}); /* `to` is reached in spite of rounding */
    check_values("a=0:1:0.3,7", 5, (const char *[]){"0", "0.3", "0.6", "0.9", "7"});
    check_values("a=x:y:z", 1, (const char *[]){"x:y:z"}); /* not numbers: one value */
}

static void wrong_values_are_refused(void **state)
{
    (void)state;
    static const struct {
        const char *text, *message;
    } bad[] = {
        {"a", "-s a: give a key and its values, such as"},
        {"=1", "a key and its values, such as"},
        {"a=", "-s a: a value is missing"},
        {"a=1,,2", "a value is missing"},
        {"a=1,1", "a value is given twice"},
        {"a=1:2:0", "1:2:0: give a range as from:to:step"},
        {"a=1:2:-1", "from:to:step"},
        {"a=1:2:x3", "1:2:x3: give a range as from:to:step with a number as step"},
        {"a=1mm:2cm:1mm", "one unit, such as"},
        {"a=0:1:1e-9", "in fewer than 10000 steps"},
    };
    struct varied_key k;
    for (size_t b = 0; b < COUNT_OF(bad); b++)
        assert_refused(varied_key_parse_name_and_values(&k, bad[b].text), bad[b].message);
}

/* ---- names ------------------------------------------------------------------------------------------------------- */

/* Checks the names of runs: folder of the study, and varied keys with their values, unique and valid as file names. */
static void runs_have_names_of_their_own(void **state)
{
    (void)state;
    struct study s;
    struct varied_key k[3];
    assert_int_equal(study_initialise(&s, "inputs/plate_crack.yaml", NULL, "sweep"), OK);
    assert_string_equal(s.folder, "results/plate_crack_sweep"); /* from the name of the scene */
    assert_int_equal(varied_key_parse_name_and_values(&k[0], "particles.spacing=1 mm,0.5 mm"), OK);
    assert_int_equal(varied_key_parse_name_and_values(&k[1], "method=pd"), OK);
    assert_int_equal(varied_key_parse_name_and_values(&k[2], "boundary.0.velocity=[10 m/s, free],[20 m/s, free],a/b"),
                     OK);
    assert_int_equal(study_add_cases_of_all_value_combinations(&s, k, 3), OK);
    assert_int_equal(s.n, 6);
    assert_string_equal(s.at[0].name, "spacing=1mm,velocity=10m_s,free");
    assert_string_equal(s.at[5].name, "spacing=0.5mm,velocity=a_b");
    assert_int_equal(s.at[5].overrides, 3);
    assert_string_equal(s.at[5].override[1].value, "pd");
    static const char *const other[] = {"spacing=1mm,velocity=10m_s,free", "../up", "logs"}; /* taken, reserved */
    for (size_t o = 0; o < COUNT_OF(other); o++) {
        const char *name = study_add_case(&s, other[o], NULL, 0)->name;
        assert_int_equal(strncmp(name, "case-", 5), 0);
        for (int c = 0; c + 1 < s.n; c++) assert_string_not_equal(s.at[c].name, name);
    }
    for (int v = 0; v < 3; v++) varied_key_free(&k[v]);
    study_free(&s);
    assert_refused(study_initialise(&s, "a.yaml", "", "sweep"), "give the name of a folder");
}

/* Checks that names of runs do not depend on the order of varied keys; long names are hashes. */
static void names_do_not_depend_on_the_order_of_keys(void **state)
{
    (void)state;
    struct varied_key k[2], swapped[2];
    struct study a, b;
    char longer[2][400];
    for (int long_ones = 0; long_ones < 2; long_ones++) {
        for (int j = 0; j < 2; j++)
            snprintf(longer[j], sizeof longer[j], "%s=1,2%0*d", j ? "particles.seed" : "time.safety",
                     long_ones ? 120 : 1, 3);
        for (int j = 0; j < 2; j++) assert_int_equal(varied_key_parse_name_and_values(&k[j], longer[j]), OK);
        swapped[0] = k[1], swapped[1] = k[0];
        assert_int_equal(study_initialise(&a, "a.yaml", "a", "sweep"), OK);
        assert_int_equal(study_initialise(&b, "a.yaml", "a", "sweep"), OK);
        assert_int_equal(study_add_cases_of_all_value_combinations(&a, k, 2), OK);
        assert_int_equal(study_add_cases_of_all_value_combinations(&b, swapped, 2), OK);
        for (int x = 0; x < 2; x++)
            for (int y = 0; y < 2; y++) assert_string_equal(a.at[2 * x + y].name, b.at[2 * y + x].name);
        assert_int_equal(!strncmp(a.at[3].name, "case-", 5), long_ones);
        study_free(&a);
        study_free(&b);
        for (int j = 0; j < 2; j++) varied_key_free(&k[j]);
    }
}

static void values_are_short_in_pictures(void **state)
{
    (void)state;
    static const struct {
        const char *text, *shown;
    } wanted[] = {
        {"a=1mm,2mm", "2mm"},
        {"boundary=[{traction: [1 MPa, 0], face: x+}],[{traction: [2 MPa, 0], face: x+}]",
         "[{traction: [2 MPa, 0], face.."},
        {"a=[1.00000000000001, 2.00000000000002, 3.0],[7.77777777777777, 8.88888888888888, 4.0]",
         "2: [7.77777777777777, 8.."},
    };
    for (size_t w = 0; w < COUNT_OF(wanted); w++) {
        struct varied_key k;
        char text[LABEL_ROOM];
        assert_int_equal(varied_key_parse_name_and_values(&k, wanted[w].text), OK);
        varied_key_compose_label_of_value(text, &k, 1);
        assert_string_equal(text, wanted[w].shown);
        varied_key_free(&k);
    }
    assert_near(axis_tick_distance(1000, 4), 500, 1e-9);
    assert_near(axis_tick_distance(1.5e-3, 4), 5e-4, 1e-12);
    assert_near(axis_tick_distance(8, 4), 2, 1e-12);
}

/* Checks that units of results are taken from the header of a history if it has the result. */
static void figures_have_units(void **state)
{
    (void)state;
    static const char header[] =
        "time [s],step,kinetic [J],pd_share,tip_x [m],sif.K_I [Pa m^(1/2)],sif.x [1],kin [W]\n";
    static const char *const wanted[][2] = {
        {"energy.kinetic", "J"},
        {"probes.sif.K_I", "Pa m^(1/2)"},
        {"probes.sif.x", ""},
        {"energy.kin", "W"},
        {"probes.tip.x", "m"},
        {"crack.angle_deg", "degree"},
        {"crack.start_time", "s"},
        {"crack.tip_speed_max", "m/s"},
        {"probes.tip.speed_mean", "m/s"},
        {"crack.length_end", "m"},
        {"rigid.0.force_max", "N"},
        {"probes.line.velocity_x_max", "m/s"},
        {"probes.line.stress_xy_min", "Pa"},
        {"fragments.mass_max", "kg"},
        {"contact.friction_work", "J"},
        {"load_steps.load_time", "s"},
        {"crack.tips.0.origin_y", "m"},
        {"energy.balance_error", ""},
        {"probes.pulse.reflected", ""},
        {"pd_share", ""},
    };
    for (size_t w = 0; w < COUNT_OF(wanted); w++) {
        char unit[UNIT_ROOM];
        study_determine_unit_of_result(unit, sizeof unit, header, wanted[w][0]);
        assert_string_equal(unit, wanted[w][1]);
    }
}

/* Checks that results that no run of a scene can have are refused with a message that contains the expected text; NULL:
 * the scene can have the result. plate: a body without cracks whose bonds have no limit; steps: one that breaks in load
 * steps. */
static void figures_fit_their_scene(void **state)
{
    (void)state;
    struct probe_request probe[] = {{.name = "edge", .kind = PROBE_POINT},
                                    {.name = "along", .kind = PROBE_LINE},
                                    {.name = "pull", .kind = PROBE_REACTION},
                                    {.name = "tip", .kind = PROBE_TIP}};
    struct material whole = {.critical_stretch = INFINITY}, brittle = {.critical_stretch = 0.004};
    const struct scene plate = {.space = SPACE_PLANE_STRESS,
                                .dim = 2,
                                .materials = 1,
                                .material = &whole,
                                .probes = 3,
                                .probe = probe,
                                .contact_between = CONTACT_NONE};
    const struct scene steps = {.space = SPACE_PLANE_STRAIN,
                                .dim = 2,
                                .materials = 1,
                                .material = &brittle,
                                .probes = 4,
                                .probe = probe,
                                .solver = SOLVER_STATIC,
                                .rigids = 2,
                                .contact_between = CONTACT_NONE};
    static const struct {
        const char *name, *plate, *steps;
    } figure[] = {
        {"energy.kinetic", NULL, NULL},
        {"crack.angle_deg", "needs cracks or bonds that break", NULL},
        {"crack.start_time", "needs cracks", "load steps have a pseudo-time only"},
        {"crack.start_step", "needs cracks", NULL},
        {"crack.tips.0.x", "needs cracks", NULL},
        {"crack.tips.1.origin_z", "needs cracks", "needs a solid"},
        {"crack.tip_speed_max", "needs cracks", "load steps have a pseudo-time only"},
        {"load_steps.release_rate", "needs `solver: static`", NULL},
        {"solver.residual", "needs `solver: relaxation`", "needs `solver: relaxation`"},
        {"contact.overlap_max", "needs bodies in contact", NULL},
        {"fragments.count", "needs bonds that break", "needs bonds that break"},
        {"rigid.1.velocity_y", "needs as many rigid bodies", NULL},
        {"rigid.2.x", "needs as many rigid bodies", "needs as many rigid bodies"},
        {"rigid.0.z", "needs as many rigid bodies", "needs a solid"},
        {"conversion.y", NULL, NULL},
        {"conversion.z", "needs a solid", "needs a solid"},
        {"probes.edge.stress_zz", "needs a solid", NULL},
        {"probes.edge.velocity_y", NULL, NULL},
        {"probes.edge.velocity_y_max", "no such figure", "no such figure"},
        {"probes.along.velocity_y_max", NULL, NULL},
        {"probes.along.velocity_y", "no such figure", "no such figure"},
        {"probes.along.stress_zx_min", "needs a solid", "needs a solid"},
        {"probes.pull.force_max_step", "needs `solver: static`", NULL},
        {"probes.pull.K_I", "no such figure", "no such figure"},
        {"probes.tip.speed_max", "no such figure", "load steps have a pseudo-time only"},
        {"probes.none.x", "no such figure", "no such figure"},
    };
    for (size_t k = 0; k < COUNT_OF(figure); k++)
        for (int which = 0; which < 2; which++) {
            const char *lacks = which ? figure[k].steps : figure[k].plate;
            const status s = result_name_check_is_known(which ? &steps : &plate, figure[k].name);
            if (s != (lacks ? REFUSED : OK) || (lacks && !strstr(status_message(), lacks)))
                fail_msg("%s, scene %d: %s", figure[k].name, which, s == OK ? "not refused" : status_message());
        }
}

/* Checks that 100000 names are created within 5 s (0.1 s measured); a comparison of each with all others would take 24
 * s. */
static void many_names_are_found_in_time(void **state)
{
    (void)state;
    struct varied_key k[2];
    struct study s;
    const clock_t begin = clock();
    assert_int_equal(varied_key_parse_name_and_values(&k[0], "a=1:1000:1"), OK);
    assert_int_equal(varied_key_parse_name_and_values(&k[1], "b=1:100:1"), OK);
    assert_int_equal(study_initialise(&s, "a.yaml", "a", "sweep"), OK);
    assert_int_equal(study_add_cases_of_all_value_combinations(&s, k, 2), OK);
    assert_int_equal(s.n, 100000);
    assert_string_equal(s.at[99999].name, "a=1000,b=100");
    for (int v = 0; v < 2; v++) varied_key_free(&k[v]);
    study_free(&s);
    assert_true((double)(clock() - begin) / CLOCKS_PER_SEC < 5);
}

/* ---- tables ------------------------------------------------------------------------------------------------------ */

/* Checks that the summary of a run that was stopped or has failed is not used for the table. */
static void stopped_runs_have_no_figures(void **state)
{
    (void)state;
    struct study s;
    struct study_table t;
    char folder[] = "/tmp/study-XXXXXX";
    assert_non_null(mkdtemp(folder));
    assert_int_equal(study_initialise(&s, "scene.yaml", folder, "sweep"), OK);
    for (int k = 0; k < 3; k++) {
        const char *const name[] = {"a", "b", "c"}, *const text = "{\"energy\": {\"kinetic\": 1.5}}";
        const struct scene_override own = {"duration", name[k]};
        struct study_case *c = study_add_case(&s, name[k], &own, 1);
        c->state = (enum case_state[]){CASE_DONE, CASE_STOPPED, CASE_FAILED}[k];
        const struct path run = study_case_folder(&s, c);
        assert_int_equal(folder_create_with_parents(run.text), OK);
        assert_int_equal(file_write_whole(path_join(run.text, "summary.json").text, text, strlen(text)), OK);
    }
    assert_int_equal(study_table_read(&t, &s), OK);
    assert_int_equal(t.figures, 1);
    assert_near(t.value[0][0], 1.5, 0);
    assert_true(isnan(t.value[0][1]) && isnan(t.value[0][2]));
    study_table_free(&t);
    for (int k = 0; k < 3; k++) {
        unlink(path_join(study_case_folder(&s, &s.at[k]).text, "summary.json").text);
        rmdir(study_case_folder(&s, &s.at[k]).text);
    }
    study_free(&s);
    rmdir(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lists_and_rows_are_read),
        cmocka_unit_test(wrong_values_are_refused),
        cmocka_unit_test(runs_have_names_of_their_own),
        cmocka_unit_test(stopped_runs_have_no_figures),
        cmocka_unit_test(names_do_not_depend_on_the_order_of_keys),
        cmocka_unit_test(values_are_short_in_pictures),
        cmocka_unit_test(figures_have_units),
        cmocka_unit_test(figures_fit_their_scene),
        cmocka_unit_test(many_names_are_found_in_time),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
