/* Tests reading of results: summary.json, history.csv, the commands `cleave compare` and `cleave plot`, results of
 * LAMMPS. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <cmocka.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "../src/app/commands.h"
#include "../src/app/compare_lammps.h"
#include "plot/plot.h"
#include "output/history.h"
#include "base/memory.h"
#include "output/summary_read.h"

enum { SIDE = 12, TEXT = 16384 };
static const double SPACING = 1e-3; /* [m] */

static void put(const char *path, const char *text)
{
    FILE *to = fopen(path, "w");
    assert_non_null(to);
    fputs(text, to);
    assert_int_equal(fclose(to), 0);
}

static bool is_there(const char *path)
{
    struct stat found;
    return stat(path, &found) == 0;
}

/* ---- summary.json ------------------------------------------------------------------------------------------------ */

/* A summary with nested objects, lists, null, and text with quotes. */
static const char sound[] =
    "{ \"name\" : \"a \\\"b\\\"\", \"steps\": 12, \"x\": -1.5e-3,\n \"crack\": {\"start\": null, \"tips\": "
    "[ {\"x\": 1, \"deep\": {\"x\": 7}}, {\"x\": 2.5} ], \"x\": 9},\n \"list\": [[1, 2], [], {}], \"ok\": true }\n";

static void figures_are_found(void **state)
{
    (void)state;
    const struct {
        const char *key;
        double value;
    } wanted[] = {
        {"steps", 12},  {"x", -1.5e-3}, {"crack.tips.0.x", 1}, {"crack.tips.1.x", 2.5}, {"crack.tips.0.deep.x", 7},
        {"crack.x", 9}, {"list.0.1", 2}};
    mkdir("sound", 0777);
    put("sound/summary.json", sound);
    for (size_t k = 0; k < COUNT_OF(wanted); k++) {
        double value;
        assert_int_equal(summary_read_number("sound", wanted[k].key, &value), OK);
        assert_true(value == wanted[k].value); /* equal texts are converted to equal numbers */
    }
    char name[32], cut[4];
    assert_int_equal(summary_read_string("sound", "name", name, sizeof name), OK);
    assert_string_equal(name, "a \"b\"");
    assert_int_equal(summary_read_string("sound", "name", cut, sizeof cut), OK);
    assert_string_equal(cut, "a \"");
}

static void absent_figures_are_refused(void **state)
{
    (void)state;
    const char *absent[] = {"start", "tips.0.x", "crack.tips.2.x", "crack.tips.x", "crack.start", "crack.tips",
                            "name",  "ok",       "step",           "steps.0",      "list.1.0",    "crack.",
                            ".x",    "list.00.1"};
    mkdir("sound", 0777);
    put("sound/summary.json", sound);
    for (size_t k = 0; k < COUNT_OF(absent); k++) {
        double value = 1;
        assert_int_equal(summary_read_number("sound", absent[k], &value), FAILED);
        assert_true(isnan(value));
    }
}

static void unsound_files_are_refused(void **state)
{
    (void)state;
    const char *unsound[] = {"",
                             "{",
                             "{\"steps\": 12",
                             "{\"steps\": 12}}",
                             "{\"steps\": 12,}",
                             "{\"steps\" 12}",
                             "{steps: 12}",
                             "{\"steps\": 012}",
                             "{\"steps\": 12.}",
                             "{\"steps\": .5}",
                             "{\"steps\": nan}",
                             "{\"steps\": 12} x",
                             "{\"steps\": 12, \"a\": \"\n\"}",
                             "{\"steps\": 12, \"a\": \"\\q\"}",
                             "{\"steps\": 12, \"a\": \"\\u12g4\"}",
                             "[12",
                             "{\"steps\": 12, \"a\": tru}"};
    mkdir("unsound", 0777);
    for (size_t k = 0; k < COUNT_OF(unsound); k++) {
        double value = 1;
        put("unsound/summary.json", unsound[k]);
        assert_int_equal(summary_read_number("unsound", "steps", &value), FAILED);
        assert_true(isnan(value));
        assert_non_null(strstr(status_message(), "not JSON"));
    }
    char deep[4096] = ""; /* deeper than any summary: refused, not a crash */
    memset(deep, '[', sizeof deep - 1);
    put("unsound/summary.json", deep);
    double value;
    assert_int_equal(summary_read_number("unsound", "steps", &value), FAILED);
    assert_int_equal(summary_read_number("nowhere", "steps", &value), FAILED);
    put("unsound/summary.json", "{\"conversion\": {\"returned\": 3}, \"load_steps\": {\"stretch_ratio\": 0.5}}");
    assert_int_equal(summary_read_number("unsound", "conversion.reverted", &value), OK); /* by both names */
    assert_true(value == 3);
    assert_int_equal(summary_read_number("unsound", "load_steps.overload", &value), OK);
    assert_true(value == 0.5);
}

/* ---- history.csv ------------------------------------------------------------------------------------------------- */

/* Checks that columns of a history are found by their names, also by previous names, and that an incomplete last line
 * is ignored. */
static void history_is_read_by_name(void **state)
{
    (void)state;
    struct history h;
    mkdir("history", 0777);
    put("history/history.csv", "time [s],step,kinetic [J],tip_x [m]\n0,0,1.5,nan\n1e-6,10,2.5,0.25\n2e-6,20,3.");
    assert_int_equal(history_read(&h, "history"), OK);
    assert_int_equal(h.columns, 4);
    assert_int_equal(h.rows, 2); /* the third is still being written */
    assert_int_equal(history_find_column(&h, "kinetic"), 2);
    assert_int_equal(history_find_column(&h, "kin"), -1);
    assert_true(history_value_at(&h, 1, history_find_column(&h, "time")) == 1e-6);
    assert_true(isnan(history_value_at(&h, 0, 3)));
    assert_true(isnan(history_value_at(&h, 0, -1)));
    history_free(&h);
    put("history/history.csv", "time [s],overload,inactive_share\n0,0.5,1\n");
    assert_int_equal(history_read(&h, "history"), OK); /* renamed columns have both of their names */
    assert_int_equal(history_find_column(&h, "stretch_ratio"), 1);
    assert_int_equal(history_find_column(&h, "overload"), 1);
    assert_int_equal(history_find_column(&h, "rest_share"), 2);
    history_free(&h);
    put("history/history.csv", "time [s],step\n0,0\n1,2,3\n");
    assert_int_equal(history_read(&h, "history"), FAILED);
    assert_non_null(strstr(status_message(), "history.csv:3:"));
    put("history/history.csv", "time [s]");
    assert_int_equal(history_read(&h, "history"), FAILED);
}

/* ---- comparison of runs ------------------------------------------------------------------------------------------ */

/* Sets p to a square plate whose right half is displaced by `gap` [m]; `shift` is added to every displacement [m]. */
static void fill_plate(struct particles *p, double gap, double shift)
{
    particles_make(p, 2, SIDE * SIDE, 0);
    for (int i = 0; i < SIDE * SIDE; i++) {
        p->X[0][i] = (i % SIDE + 0.5) * SPACING;
        p->X[1][i] = (i / SIDE + 0.5) * SPACING;
        p->x[0][i] = p->X[0][i] + shift + (i % SIDE < SIDE / 2 ? 0 : gap);
        p->x[1][i] = p->X[1][i];
        p->damage[i] = i % SIDE == SIDE / 2 ? 0.4 : 0;
        p->kind[i] = i % SIDE == SIDE / 2 ? KIND_PD : KIND_MPM;
        p->mass[i] = 1;
        p->id[i] = i;
    }
}

static void write_run(const char *folder, double shift, double loop_seconds, double tip_x)
{
    struct output o;
    struct particles p;
    char text[TEXT];
    assert_int_equal(output_open(&o, folder, "name: test\n", OUTPUT_OVERWRITE, false), OK);
    for (int k = 0; k < 3; k++) {
        fill_plate(&p, 1e-4 * k, shift * k);
        assert_int_equal(output_write_frame(&o, &p, 1e-6 * k, 10 * k, "name: test\n"), OK);
        particles_free(&p);
    }
    snprintf(text, sizeof text,
             "{\"name\": \"test\", \"method\": \"pd\", \"status\": \"done\", \"loop_seconds\": %g, "
             "\"crack\": {\"angle_deg\": 67, \"tips\": [{\"x\": %g, \"y\": %g}]}}\n",
             loop_seconds, tip_x, 4 * (tip_x - 0.010) / 3);
    assert_int_equal(output_write_text(&o, "summary.json", text, strlen(text)), OK);
    output_close(&o);
    snprintf(text, sizeof text, "%s/history.csv", folder);
    put(text, "time [s],step,kinetic [J],balance_error,pd_share,crack_length [m]\n"
              "0,0,0,0,0.1,0\n2e-6,20,2,1e-6,0.2,1e-3\n");
}

/* Runs command(argc, argv) and stores its standard output in printed[]. Returns the status of the command. */
static status run(status (*command)(int, char **), int argc, char **argv, char *printed)
{
    fflush(stdout);
    int kept = dup(STDOUT_FILENO);
    FILE *to = fopen("printed", "w+");
    assert_non_null(to);
    dup2(fileno(to), STDOUT_FILENO);
    status s = command(argc, argv);
    fflush(stdout);
    dup2(kept, STDOUT_FILENO);
    close(kept);
    rewind(to);
    printed[fread(printed, 1, TEXT - 1, to)] = '\0';
    fclose(to);
    return s;
}

/* Returns the first number after the first `label` in `text`. */
static double number_after(const char *text, const char *label)
{
    const char *at = strstr(text, label);
    assert_non_null(at);
    return strtod(at + strlen(label), NULL);
}

static void runs_are_compared(void **state)
{
    (void)state;
    char printed[TEXT];
    write_run("a", 0, 2, 0.010);
    write_run("b", 1e-6, 8, 0.013);
    char *words[] = {"compare", "a", "b"};
    assert_int_equal(run(command_compare_main, 3, words, printed), OK);
    /* The last frame of b is shifted by 2e-6 m; frames are in single precision, 1e-4 of this shift at X of about 1e-2
     * m. */
    double apart = number_after(printed, "displacement [m]");
    assert_true(fabs(apart - 2e-6) < 1e-9);
    double largest = 0, mean = 0; /* equal at all particles */
    assert_int_equal(sscanf(strstr(printed, "displacement [m]"), "displacement [m] %lf %lf", &largest, &mean), 2);
    assert_true(fabs(mean - largest) < 1e-9);
    assert_true(number_after(printed, "damage") == 0);
    assert_true(number_after(printed, "kind differs (bond or point)") == 0);
    assert_true(fabs(number_after(printed, "t_r = 1 - A/B = ") - 0.75) < 1e-4); /* printed with four digits */
    assert_true(fabs(number_after(printed, "nearest tip of run B is") - 5e-3) < 1e-6);
    assert_non_null(strstr(printed, "5 spacings"));
    assert_non_null(strstr(printed, "comparable particle by particle: yes"));
    char *swapped[] = {"compare", "b", "a"};
    assert_int_equal(run(command_compare_main, 3, swapped, printed), OK);
    assert_non_null(strstr(printed, "A/B = 4, A takes 300 % longer than B\n"));
    write_run("b", 1e-6, 2.1, 0.013);
    assert_int_equal(run(command_compare_main, 3, swapped, printed), OK);
    assert_non_null(strstr(printed, "A takes 5 % longer than B; times of equal runs differ as much\n"));
}

/* Checks that two runs in plane strain that differ only in the out-of-plane stress are reported as different. */
static void stress_across_is_compared(void **state)
{
    (void)state;
    static const struct material m[2] = {{.poisson = 0.25}, {.poisson = 0.35}};
    char printed[TEXT], *words[] = {"compare", "quarter", "more"};
    for (int k = 0; k < 2; k++) {
        struct output o;
        struct particles p;
        fill_plate(&p, 0, 0);
        p.plane_strain = &m[k];
        for (int64_t i = 0; i < p.n; i++) p.stress[0][i] = 1e6, p.stress[1][i] = 2e6;
        assert_int_equal(output_open(&o, words[1 + k], "name: test\n", OUTPUT_OVERWRITE, false), OK);
        assert_int_equal(output_write_frame(&o, &p, 0, 0, "name: test\n"), OK);
        output_close(&o);
        particles_free(&p);
    }
    assert_int_equal(run(command_compare_main, 3, words, printed), OK);
    assert_true(fabs(number_after(printed, "stress [Pa]") - 0.1 * 3e6) < 1);
}

static void unequal_runs_are_told_apart(void **state)
{
    (void)state;
    char printed[TEXT];
    char *words[] = {"compare", "a", "sound"};
    write_run("a", 0, 2, 0.010);
    mkdir("sound", 0777);
    put("sound/summary.json", sound);
    assert_int_equal(run(command_compare_main, 3, words, printed), OK);
    assert_non_null(strstr(printed, "sound has no frames"));
    assert_non_null(strstr(printed, "comparable particle by particle: no"));
}

/* Checks reading of LAMMPS results, two particles displaced by -1.3 mm and 2.2 mm. The damage combines that at the
 * start, 0.4 and 0, with the fractions of bonds that LAMMPS has broken since, 0.25 and 0.5: 0.55 and 0.5. */
static void runs_of_lammps_are_read(void **state)
{
    (void)state;
    struct output_frame f;
    assert_int_equal(mkdir("lammps", 0700), 0);
    put("lammps/in.lammps", "units si\ntimestep 2.5e-8\n");
    put("lammps/check.csv", "id,X [m],Y [m],Z [m],x [m],y [m],z [m],damage,damage_start\n"
                            "2,3e-3,7e-3,0,3e-3,7e-3,0,0.5,0\n1,1.5e-3,0,0,1.5e-3,0,0,0.55,0.4\n");
    put("lammps/plate.dump",
        "ITEM: TIMESTEP\n40\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS mm mm mm\n-1 1\n-1 1\n-2 2\n"
        "ITEM: ATOMS id x y z vx vy vz c_damage \n1 2e-4 0 0 3 -5 0 0.25\n2 3e-3 9.2e-3 0 0 7 0 0.5\n");
    assert_int_equal(lammps_run_read_frame(&f, "lammps", 40), OK);
    assert_true(f.n == 2 && f.dim == 2 && f.step == 40 && fabs(f.t / 1e-6 - 1) < 1e-12);
    assert_true(fabs(f.u[0][0] + 1.3e-3) < 1e-9 && fabs(f.u[1][1] - 2.2e-3) < 1e-9 && fabs(f.X[1][1] - 7e-3) < 1e-15);
    assert_true(f.v[1][0] == -5 && f.v[1][1] == 7);
    assert_true(fabs(f.damage[0] - 0.55) < 1e-6 && fabs(f.damage[1] - 0.5) < 1e-6);
    frame_free(&f);
}

static void damaged_files_are_refused(void **state)
{
    (void)state;
    char printed[TEXT], *compare[] = {"compare", "a", "c"}, *plot[] = {"plot", "c"};
    write_run("a", 0, 2, 0.010);
    write_run("c", 0, 2, 0.010);
    put("c/frames/000002.hdf", "not a frame");
    assert_int_equal(run(command_compare_main, 3, compare, printed), FAILED);
    assert_non_null(strstr(status_message(), "000002.hdf"));
    assert_int_equal(run(command_plot_main, 2, plot, printed), FAILED);
    assert_non_null(strstr(status_message(), "000002.hdf"));
    write_run("c", 0, 2, 0.010);
    put("c/summary.json", "{\"name\": ");
    assert_int_equal(run(command_compare_main, 3, compare, printed), FAILED);
    assert_non_null(strstr(status_message(), "summary.json"));
}

static void wrong_words_are_refused(void **state)
{
    (void)state;
    char printed[TEXT];
    char *compare[] = {"compare", "a", "--deep", "b"}, *plot[] = {"plot", "a", "--frames", "0"};
    char *info[] = {"info", "x"}, *nowhere[] = {"compare", "nowhere", "nowhere"}, *none[] = {"plot", "nowhere"};
    write_run("a", 0, 2, 0.010);
    assert_int_equal(run(command_compare_main, 4, compare, printed), REFUSED);
    assert_int_equal(run(command_compare_main, 2, compare, printed), REFUSED);
    assert_int_equal(run(command_compare_main, 3, nowhere, printed), REFUSED);
    assert_int_equal(run(command_plot_main, 4, plot, printed), REFUSED);
    assert_int_equal(run(command_plot_main, 3, plot, printed), REFUSED);
    assert_int_equal(run(command_plot_main, 1, plot, printed), REFUSED);
    assert_int_equal(run(command_plot_main, 2, none, printed), REFUSED);
    assert_int_equal(run(command_info_main, 2, info, printed), REFUSED);
    assert_int_equal(run(command_info_main, 1, info, printed), OK);
    assert_non_null(strstr(printed, CLEAVE_VERSION));
}

/* ---- pictures ---------------------------------------------------------------------------------------------------- */

/* Returns the width of the PNG picture `path` [pixel]. Also checks its signature and first chunk. */
static int picture_width(const char *path)
{
    unsigned char head[24];
    FILE *from = fopen(path, "rb");
    assert_non_null(from);
    assert_int_equal(fread(head, 1, sizeof head, from), sizeof head);
    fclose(from);
    assert_memory_equal(head, "\x89PNG\r\n\x1a\n", 8);
    assert_memory_equal(head + 12, "IHDR", 4);
    return head[18] << 8 | head[19];
}

static void pictures_are_drawn(void **state)
{
    (void)state;
    char printed[TEXT], *words[] = {"plot", "it's `here`", "--frames", "all"};
    const char *picture[] = {"damage", "kind", "last", "crack", "energy", "damage_000002", "kind_000000"};
    write_run(words[1], 0, 2, 0.010);
    assert_int_equal(run(command_plot_main, 4, words, printed), OK);
    for (size_t k = 0; k < COUNT_OF(picture); k++) {
        char path[256];
        snprintf(path, sizeof path, "%s/pictures/%s.png", words[1], picture[k]);
        assert_true(picture_width(path) > 500);
        snprintf(path, sizeof path, "%s/pictures/%s.png.cleave.tmp", words[1], picture[k]);
        assert_false(is_there(path));
    }
}

static void missing_gnuplot_is_named(void **state)
{
    (void)state;
    char printed[TEXT], *words[] = {"plot", "a"};
    char *path = strdup(getenv("PATH"));
    write_run("a", 0, 2, 0.010);
    setenv("PATH", "/nowhere", 1);
    status s = run(command_plot_main, 2, words, printed);
    setenv("PATH", path, 1);
    free(path);
    assert_int_equal(s, FAILED);
    assert_non_null(strstr(status_message(), "gnuplot-nox"));
    assert_false(is_there("a/pictures/damage.png"));
}

/* Returns the fraction of the pixels of a rectangle from from_x to to_x [spacings] in which a particle of `plotted` is
 * drawn. */
static double covered(const struct plotted_particles *plotted, double from_x, double to_x)
{
    enum { PIXELS = 20 * SIDE }; /* 20 pixels per spacing: a gap of a tenth of a spacing is visible */
    struct colour *pixel = NEW("test.pixel", PIXELS * PIXELS, struct colour);
    struct view v = {.from = {from_x * SPACING, 0}, .to = {to_x * SPACING, SIDE * SPACING}, .top = 0.5};
    image_paint_particles_in_plane(pixel, PIXELS, PIXELS, &v, plotted, MAP_DAMAGE);
    int shown = 0;
    for (int q = 0; q < PIXELS * PIXELS; q++) shown += pixel[q].alpha > 0;
    memory_free(pixel);
    return (double)shown / (PIXELS * PIXELS);
}

static void bodies_are_closed_and_gaps_open(void **state)
{
    (void)state;
    struct output_frame f;
    struct plotted_particles c;
    write_run("a", 0, 2, 0.010);
    assert_int_equal(frame_read(&f, "a/frames/000000.hdf"), OK);
    assert_true(fabs(frame_particle_spacing(&f) - SPACING) < 1e-6 * SPACING); /* single precision */
    plotted_particles_select_from_frame(&c, &f, NULL);
    assert_true(c.aligned);
    assert_int_equal(c.n, SIDE * SIDE);
    assert_true(covered(&c, 0, SIDE) == 1); /* no gap between neighbours */
    assert_true(covered(&c, SIDE + 1, SIDE + 3) == 0);
    plotted_particles_free(&c);
    for (int64_t i = 0; i < f.n; i++) f.u[0][i] = f.X[0][i] > 0.5F * SIDE * 1e-3F ? 2e-3F : 0;
    plotted_particles_select_from_frame(&c, &f, NULL);
    assert_true(covered(&c, 0.5 * SIDE + 0.2, 0.5 * SIDE + 1.8) == 0); /* two spacings apart */
    plotted_particles_free(&c);
    const double rotation = 0.5; /* radian: a rotated lattice has no gaps either */
    for (int64_t i = 0; i < f.n; i++) {
        double x = f.X[0][i] - 6e-3, y = f.X[1][i] - 6e-3;
        f.u[0][i] = (float)(x * cos(rotation) - y * sin(rotation) - x);
        f.u[1][i] = (float)(x * sin(rotation) + y * cos(rotation) - y);
    }
    plotted_particles_select_from_frame(&c, &f, NULL);
    assert_true(c.aligned); /* at reference positions: its squares turn with it */
    struct colour middle[64];
    struct view v = {.from = {4e-3, 4e-3}, .to = {8e-3, 8e-3}, .top = 0.5};
    image_paint_particles_in_plane(middle, 8, 8, &v, &c, MAP_DAMAGE);
    for (int q = 0; q < 64; q++) assert_int_equal(middle[q].alpha, 255);
    plotted_particles_free(&c);
    frame_free(&f);
}

/* ---- common folder ----------------------------------------------------------------------------------------------- */

/* Folder for the files of these tests. */
static char folder[] = "/tmp/cleave_compare_XXXXXX";

static int enter(void **state)
{
    (void)state;
    output_install_signal_handling_for_file_writes();
    return mkdtemp(folder) == NULL || chdir(folder) != 0;
}

static int leave(void **state)
{
    (void)state;
    char command[64];
    snprintf(command, sizeof command, "rm -rf %s", folder);
    return chdir("/") != 0 || system(command) != 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(figures_are_found),
        cmocka_unit_test(absent_figures_are_refused),
        cmocka_unit_test(unsound_files_are_refused),
        cmocka_unit_test(history_is_read_by_name),
        cmocka_unit_test(runs_are_compared),
        cmocka_unit_test(unequal_runs_are_told_apart),
        cmocka_unit_test(stress_across_is_compared),
        cmocka_unit_test(runs_of_lammps_are_read),
        cmocka_unit_test(damaged_files_are_refused),
        cmocka_unit_test(wrong_words_are_refused),
        cmocka_unit_test(missing_gnuplot_is_named),
        cmocka_unit_test(pictures_are_drawn),
        cmocka_unit_test(bodies_are_closed_and_gaps_open),
    };
    return cmocka_run_group_tests(tests, enter, leave);
}
