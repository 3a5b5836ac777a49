/* Tests output.h: frames, their index files, history, summary, folders of runs, and the effects of a full disk and of
 * damaged bytes. */
#include <errno.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "engine/engine.h"
#include "src/engine/engine_internal.h"
#include "base/memory.h"
#include "output/checksum.h"
#include "output/output_files.h"
#include "output/output_hdf5.h"
#include "step/report.h"
#include "probes/diagnostics.h"
#include "coupling/coupling_part.h"
#include "coupling/conversion.h"
#include "fracture/fracture_part.h"
#include "fracture/tips.h"
#include "tests/robustness/trees.h"

static const char scene_text[] = "name: \"toy\"\nspace: plane stress\n";
enum { PARTICLES = 1000 };

/* ---- helpers ----------------------------------------------------------------------------------------------------- */

/* Opens in o the output in `folder`, whose previous contents are removed. compress: true for compressed frames. */
static void open_fresh(struct output *o, const char *folder, bool compress)
{
    remove_tree(folder);
    assert_int_equal(output_open(o, folder, scene_text, OUTPUT_OVERWRITE, compress), OK);
}

/* Returns a number in [0, 1) that depends only on i and k. */
static real noise(int64_t i, int k)
{
    uint64_t a = (uint64_t)(i * 8 + k + 1) * UINT64_C(0x9E3779B97F4A7C15);
    return (real)((a ^ a >> 31) * UINT64_C(0xBF58476D1CE4E5B9) >> 11) * 0x1p-53;
}

/* Creates n particles p in `dim` dimensions with values in every field; ids are in reverse order with gaps. */
static void make_particles(struct particles *p, int dim, int64_t n)
{
    particles_make(p, dim, n, 0);
    for (int64_t i = 0; i < n; i++) {
        for (int d = 0; d < dim; d++) {
            p->X[d][i] = noise(i, d);
            p->x[d][i] = p->X[d][i] + 1e-3 * noise(i, 3 + d);
            p->v[d][i] = noise(i, 6 + d) - 0.5;
        }
        for (int k = 0; k < symmetric_tensor_component_count(dim); k++) p->stress[k][i] = 1e6 * noise(i, 9 + k);
        p->damage[i] = noise(i, 15);
        p->kind[i] = i % 3 ? KIND_MPM : KIND_PD;
        p->material[i] = (uint8_t)(i % 5);
        p->body[i] = (uint8_t)(i % 7);
        p->id[i] = (int32_t)(2 * (n - 1 - i));
    }
}

static void assert_same_files(const char *a, const char *b)
{
    char *text_a, *text_b;
    size_t length_a, length_b;
    assert_int_equal(file_read_whole(a, &text_a, &length_a), OK);
    assert_int_equal(file_read_whole(b, &text_b, &length_b), OK);
    assert_int_equal(length_a, length_b);
    assert_memory_equal(text_a, text_b, length_a);
    memory_free(text_a);
    memory_free(text_b);
}

static void assert_message(const char *part)
{
    if (!strstr(status_message(), part)) fail_msg("message \"%s\" lacks \"%s\"", status_message(), part);
}

/* ---- frames ------------------------------------------------------------------------------------------------------ */

/* Asserts that the frame f contains the particles p in the order of ids, in single precision. */
static void check_frame(const struct output_frame *f, const struct particles *p)
{
    assert_int_equal(f->n, p->n);
    assert_int_equal(f->dim, p->dim);
    for (int64_t k = 0; k < f->n; k++) {
        int64_t i = p->n - 1 - k; /* ids are in reverse order */
        assert_int_equal(f->id[k], p->id[i]);
        for (int d = 0; d < p->dim; d++) {
            assert_true(f->X[d][k] == p->X[d][i]);
            assert_true(f->u[d][k] == (float)(p->x[d][i] - p->X[d][i]));
            assert_true(f->v[d][k] == (float)p->v[d][i]);
        }
        for (int c = 0; c < symmetric_tensor_component_count(p->dim); c++)
            assert_true(f->stress[c][k] == (float)p->stress[c][i]);
        assert_true(f->damage[k] == (float)p->damage[i]);
        assert_int_equal(f->kind[k], p->kind[i]);
        assert_int_equal(f->material[k], p->material[i]);
        assert_int_equal(f->body[k], p->body[i]);
    }
}

static void frames_come_back(void **state)
{
    (void)state;
    for (int dim = 1; dim <= DIM_MAX; dim++)
        for (int compress = 0; compress < 2; compress++) {
            struct output o;
            struct particles p;
            struct output_frame f;
            open_fresh(&o, "frames", compress);
            make_particles(&p, dim, PARTICLES);
            assert_int_equal(output_write_frame(&o, &p, 0.125, 17, scene_text), OK);
            assert_int_equal(frame_read(&f, "frames/frames/000000.hdf"), OK);
            assert_true(f.t == 0.125 && f.step == 17);
            check_frame(&f, &p);
            frame_free(&f);
            particles_free(&p);
            output_close(&o);
        }
}

/* Checks that frames have the layout required by the reader of VTK 9.1. */
static void frames_have_vtk_layout(void **state)
{
    (void)state;
    struct output o;
    struct particles p;
    struct hdf f;
    int64_t n = 0;
    int32_t offset[PARTICLES + 1];
    uint8_t type[PARTICLES];
    open_fresh(&o, "layout", false);
    make_particles(&p, 2, PARTICLES);
    assert_int_equal(output_write_frame(&o, &p, 0, 0, scene_text), OK);
    hdf_open_for_reading(&f, "layout/frames/000000.hdf");
    hdf_read_rows(&f, "/VTKHDF/NumberOfPoints", HDF_I64, 1, &n);
    hdf_read_rows(&f, "/VTKHDF/Offsets", HDF_I32, PARTICLES + 1, offset);
    hdf_read_rows(&f, "/VTKHDF/Types", HDF_U8, PARTICLES, type);
    assert_false(f.failed);
    assert_int_equal(n, PARTICLES);
    assert_int_equal(offset[PARTICLES], PARTICLES);
    assert_int_equal(type[PARTICLES - 1], 1);
    assert_int_equal(hdf_dataset_element_count(&f, "/VTKHDF/Points"), 3 * PARTICLES);
    assert_int_equal(hdf_dataset_element_count(&f, "/VTKHDF/PointData/stress"), 6 * PARTICLES);
    hdf_close(&f);
    particles_free(&p);
    output_close(&o);
}

/* Checks that frames and their index have the plastic strain if and only if the particles have it. */
static void plastic_strain_where_it_is(void **state)
{
    (void)state;
    for (int yields = 0; yields < 2; yields++) {
        struct output o;
        struct particles p;
        struct hdf f;
        char *text;
        size_t length;
        float strain[2];
        open_fresh(&o, "plastic", false);
        particles_make(&p, 2, 2, yields ? WITH_PLASTIC : 0);
        p.id[0] = 1;
        if (yields) p.plastic_strain[0] = 0.25, p.plastic_strain[1] = 0.5;
        assert_int_equal(output_write_frame(&o, &p, 0, 0, scene_text), OK);
        hdf_open_for_reading(&f, "plastic/frames/000000.hdf");
        hdf_read_rows(&f, "/VTKHDF/PointData/plastic_strain", HDF_F32, 2, strain);
        assert_int_equal(f.failed, !yields);
        if (yields) assert_true(strain[0] == 0.5f && strain[1] == 0.25f); /* by id */
        hdf_close(&f);
        assert_int_equal(file_read_whole("plastic/frames.xdmf", &text, &length), OK);
        assert_int_equal(strstr(text, "PointData/plastic_strain") != NULL, yields);
        memory_free(text);
        particles_free(&p);
        output_close(&o);
    }
}

/* Checks that frames have contact forces and fragments, in the order of ids, if and only if these are passed. */
static void frames_hold_what_they_are_given(void **state)
{
    (void)state;
    real pushed[2] = {1.5, -2.5}, across[2] = {0, 4};
    real *const push[DIM_MAX] = {pushed, across, NULL};
    const int32_t fragment[2] = {-1, 3};
    const struct frame_extra extra = {.push = push, .fragment = fragment};
    for (int given = 0; given < 2; given++) {
        struct output o;
        struct particles p;
        struct output_frame f;
        struct hdf file;
        float force[6];
        open_fresh(&o, "given", false);
        particles_make(&p, 2, 2, 0);
        p.id[0] = 1;
        assert_int_equal(output_begin_writing_frame_in_thread(&o, 0, &p, given ? &extra : NULL, 0, 0, scene_text), OK);
        assert_int_equal(output_wait_until_frame_is_written(&o), OK);
        hdf_open_for_reading(&file, "given/frames/000000.hdf");
        hdf_read_rows(&file, "/VTKHDF/PointData/contact_force", HDF_F32, 6, force);
        assert_int_equal(file.failed, !given);
        if (given) assert_true(force[0] == -2.5f && force[1] == 4 && force[2] == 0 && force[3] == 1.5f);
        hdf_close(&file);
        assert_int_equal(frame_read(&f, "given/frames/000000.hdf"), OK);
        assert_int_equal(f.fragment != NULL, given);
        if (given) assert_true(f.fragment[0] == 3 && f.fragment[1] == -1);
        frame_free(&f);
        particles_free(&p);
        output_close(&o);
    }
}

static void indices_list_all_frames(void **state)
{
    (void)state;
    struct output o;
    struct particles p;
    int n;
    struct listed_frame *list;
    char *text;
    size_t length;
    open_fresh(&o, "indices", false);
    make_particles(&p, 2, 10);
    for (int k = 0; k < 40; k++) assert_int_equal(output_write_frame(&o, &p, k / 7.0, k, scene_text), OK);
    assert_int_equal(run_list_frames("indices", &n, &list), OK);
    assert_int_equal(n, 40);
    /* 17 digits restore a double exactly. */
    for (int k = 0; k < n; k++) assert_true(list[k].number == k && list[k].time == k / 7.0);
    memory_free(list);
    assert_int_equal(file_read_whole("indices/frames.xdmf", &text, &length), OK);
    assert_non_null(strstr(text, "frames/000039.hdf:/VTKHDF/PointData/velocity"));
    memory_free(text);
    particles_free(&p);
    output_close(&o);
    assert_int_equal(run_list_frames("nowhere", &n, &list), FAILED);
}

static void same_state_gives_same_bytes(void **state)
{
    (void)state;
    for (int compress = 0; compress < 2; compress++) {
        struct output a, b;
        struct particles p;
        open_fresh(&a, "bytes_a", compress);
        open_fresh(&b, "bytes_b", compress);
        make_particles(&p, 3, PARTICLES);
        assert_int_equal(output_write_frame(&a, &p, 1, 1, scene_text), OK);
        usleep(1100000); /* a stored time of day has a resolution of 1 s */
        assert_int_equal(output_write_frame(&b, &p, 1, 1, scene_text), OK);
        assert_same_files("bytes_a/frames/000000.hdf", "bytes_b/frames/000000.hdf");
        particles_free(&p);
        output_close(&a);
        output_close(&b);
    }
}

static void damaged_frames_are_refused(void **state)
{
    (void)state;
    struct output o;
    struct particles p;
    struct output_frame f;
    open_fresh(&o, "cut", false);
    make_particles(&p, 2, PARTICLES);
    assert_int_equal(output_write_frame(&o, &p, 0, 0, scene_text), OK);
    assert_int_equal(truncate("cut/frames/000000.hdf", 5000), 0);
    assert_int_equal(frame_read(&f, "cut/frames/000000.hdf"), FAILED);
    assert_int_equal(frame_read(&f, "cut/scene.yaml"), FAILED);
    assert_int_equal(frame_read(&f, "cut/frames"), FAILED);
    particles_free(&p);
    output_close(&o);
}

/* ---- folder ------------------------------------------------------------------------------------------------------ */

/* Checks which folders are refused: those of another scene, those that contain a run, files, and names longer than
 * paths or file names may be. An empty folder is accepted. */
static void folders_of_others_are_refused(void **state)
{
    (void)state;
    struct output o;
    char name[PATH_ROOM + 10];
    open_fresh(&o, "folder/deep/run", false);
    output_close(&o);
    assert_int_equal(output_open(&o, "folder/deep/run", "name: \"other\"\n", OUTPUT_FIRST, false), REFUSED);
    assert_message("name: folder/deep/run contains the run of another scene, with `");
    assert_int_equal(output_open(&o, "folder/deep/run/scene.yaml", scene_text, OUTPUT_FIRST, false), REFUSED);
    assert_int_equal(output_open(&o, "folder/deep/run/scene.yaml/x", scene_text, OUTPUT_FIRST, false), REFUSED);
    assert_int_equal(output_open(&o, "folder/deep", scene_text, OUTPUT_FIRST, false), REFUSED);
    assert_message("for instance run");
    assert_int_equal(output_open(&o, "", scene_text, OUTPUT_FIRST, false), REFUSED);
    memset(name, 'x', sizeof name - 1);
    name[sizeof name - 1] = '\0';
    assert_int_equal(output_open(&o, name, scene_text, OUTPUT_FIRST, false), REFUSED);
    name[300] = '\0'; /* longer than names of any file system */
    assert_int_equal(output_open(&o, name, scene_text, OUTPUT_FIRST, false), FAILED);
    assert_message("choose another -o");
    mkdir("folder/empty", 0777);
    assert_int_equal(output_open(&o, "folder/empty/", scene_text, OUTPUT_OVERWRITE, false), OK);
    output_close(&o);
    assert_true(path_is_file("folder/empty/scene.yaml"));
}

static void older_run_is_replaced_unless_resumed(void **state)
{
    (void)state;
    struct output o;
    open_fresh(&o, "again", false);
    static const char *const made[] = {"frames/000000.hdf", "history.csv", "checkpoint.h5", "checkpoint.previous.h5"};
    for (size_t k = 0; k < COUNT_OF(made); k++) assert_int_equal(output_write_text(&o, made[k], "x", 1), OK);
    assert_int_equal(output_write_text(&o, "frames/000000.hdf.cleave.tmp", "x", 1), OK);
    assert_int_equal(file_append_checksum_footer("again/frames/000000.hdf"),
                     OK); /* the footer that marks a frame as Cleave's */
    assert_int_equal(file_replace_by_temporary("again/frames/000000.hdf"), OK);
    static const char *const others[] = {"frames/000001.hdf.tmp", "checkpoint.h5.tmp", "history.csv.tmp"};
    for (size_t k = 0; k < COUNT_OF(others); k++) assert_int_equal(output_write_text(&o, others[k], "mine", 4), OK);
    assert_int_equal(output_write_text(&o, "frames/000001.hdf.cleave.tmp", "x", 1), OK);
    assert_int_equal(output_write_text(&o, "checkpoint.h5.cleave.tmp", "x", 1), OK);
    output_close(&o);
    assert_int_equal(output_open(&o, "again", scene_text, OUTPUT_RESUME, false), OK);
    output_close(&o);
    for (size_t k = 0; k < COUNT_OF(made); k++) assert_true(path_exists(path_join("again", made[k]).text));
    assert_false(path_exists("again/frames/000001.hdf.cleave.tmp"));
    assert_false(path_exists("again/checkpoint.h5.cleave.tmp"));
    assert_int_equal(output_open(&o, "again", scene_text, OUTPUT_FIRST, false), REFUSED);
    assert_message(
        "again contains an interrupted run of this scene; continue with --resume, replace it with --overwrite");
    assert_int_equal(unlink("again/checkpoint.h5") | unlink("again/checkpoint.previous.h5"), 0);
    assert_int_equal(output_open(&o, "again", scene_text, OUTPUT_RESUME, false), OK); /* the run has only begun */
    assert_int_equal(output_write_text(&o, "history.csv", "time [s],step\n0,0\n", 18), OK);
    output_close(&o);
    assert_int_equal(output_open(&o, "again", scene_text, OUTPUT_RESUME, false), REFUSED);
    assert_message("has no checkpoint left");
    assert_int_equal(output_open(&o, "again", scene_text, OUTPUT_OVERWRITE, false), OK);
    output_close(&o);
    for (size_t k = 0; k < COUNT_OF(made); k++) assert_false(path_exists(path_join("again", made[k]).text));
    for (size_t k = 0; k < COUNT_OF(others); k++)
        assert_true(file_contents_equal_bytes(path_join("again", others[k]).text, "mine", 4));
}

/* Checks that a table that Cleave has not written is never overwritten in the folder of a run, whereas an empty or
 * truncated header of its own is. */
static void tables_of_others_stay(void **state)
{
    (void)state;
    static const struct {
        const char *name, *text;
        status ended;
    } table[] = {{"history.csv", "mine", REFUSED},
                 {"history.csv", "", OK},
                 {"history.csv", "time [s", OK},
                 {"fragments.csv", "body,mass\n", REFUSED},
                 {"fragments.csv", "body,particles,mass [kg]\n", OK}};
    struct output o;
    open_fresh(&o, "tables", false);
    output_close(&o);
    for (size_t k = 0; k < COUNT_OF(table); k++) {
        const struct path path = path_join("tables", table[k].name);
        const size_t length = strlen(table[k].text);
        assert_int_equal(file_write_whole(path.text, table[k].text, length), OK);
        assert_int_equal(output_open(&o, "tables", scene_text, OUTPUT_OVERWRITE, false), table[k].ended);
        if (table[k].ended == OK) output_close(&o);
        assert_true(path_exists(path.text) == (table[k].ended != OK));
        if (table[k].ended == OK) continue;
        assert_true(file_contents_equal_bytes(path.text, table[k].text, length));
        assert_message("exists and was not written by cleave; move or remove it");
        assert_int_equal(unlink(path.text), 0);
    }
}

static void history_is_cut_back(void **state)
{
    (void)state;
    static const struct column column[] = {{"time", "s"}, {"step", ""}, {"a,b", "J"}};
    struct output o;
    char *text;
    size_t length;
    open_fresh(&o, "history", false);
    assert_int_equal(output_history_open(&o, column, 3, false), OK);
    assert_int_equal(output_write_history(&o, (real[]){0, 0, -NAN}), OK);
    const int64_t kept = o.history_bytes;
    const uint64_t hash = o.history_hash;
    assert_int_equal(output_write_history(&o, (real[]){1.5, 1, 2}), OK);
    assert_int_equal(output_write_text(&o, "checkpoint.h5", "x", 1), OK);
    output_close(&o);
    assert_int_equal(output_open(&o, "history", scene_text, OUTPUT_RESUME, false), OK);
    o.history_bytes = kept, o.history_hash = hash ^ 1;
    assert_int_equal(output_history_open(&o, column, 3, true), FAILED);
    assert_message("is not the file that it was at the checkpoint");
    o.history_hash = hash;
    assert_int_equal(output_history_open(&o, column, 3, true), OK);
    assert_int_equal(output_write_history(&o, (real[]){2.5, 1, 2}), OK);
    assert_int_equal(file_read_whole("history/history.csv", &text, &length), OK);
    assert_string_equal(text, "time [s],step,a_b [J]\n0,0,nan\n2.5,1,2\n");
    assert_int_equal(o.history_bytes, length);
    memory_free(text);
    output_close(&o);
    assert_int_equal(output_open(&o, "history", scene_text, OUTPUT_RESUME, false), OK);
    o.history_bytes = 1000;
    assert_int_equal(output_history_open(&o, column, 3, true), FAILED);
    assert_message("shorter than at the checkpoint");
    output_close(&o);
}

/* Checks that writing the history fails with a message on a full disk, which is simulated by a limit on the file
 * size. */
static void history_on_a_full_disk_fails(void **state)
{
    (void)state;
    static const struct column column = {"time", "s"};
    struct output o;
    struct rlimit limit, none;
    open_fresh(&o, "history_full", false);
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &limit), 0);
    none = limit, none.rlim_cur = 0;
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &none), 0);
    const status opened = output_history_open(&o, &column, 1, false);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &limit), 0);
    assert_int_equal(opened, FAILED);
    assert_message("cannot write history_full/history.csv: File too large; free space");
    output_close(&o);
}

/* ---- the summary ------------------------------------------------------------------------------------------------- */

/* Checks the values in summary.json of a run of known state. */
static void summary_has_the_figures(void **state)
{
    (void)state;
    struct output o;
    struct scene s = {.name = "a \"b\"\n", .method = METHOD_ADAPTIVE, .dim = 2, .spacing = 1e-3, .thickness = 1};
    struct run *run = NEW("test.engine", 1, struct run);
    char *text;
    size_t length;
    open_fresh(&o, "summary", false);
    run_components_allocate(run);
    run->scene = &s, run->report->out = &o, run->clock.step = 7, run->clock.t = 0.1,
    run->timers.spent[TIMER_BONDS] = 7e-4;
    run->report->began = wall_clock_seconds(), run->report->before = (struct run_seconds){3, 0.25, 3e-4};
    run->report->setup_seconds = 0.25, run->timers.spent[TIMER_OUTPUT] = 2;
    run->part.n = run->part.n_body = 4, run->part.dim = 2, run->part.n_of[KIND_PD] = 3;
    run->report->particle_steps[KIND_PD] = 1000;
    run->diagnostics->break_time = NAN;
    run->coupling->conversion = (struct conversion){.first_time = 0.05, .events = 1, .start = 1, .first_place = {1, 2}};
    run->fracture->tips = (struct crack_tips){.dim = 2, .n = 1, .spacing = 1e-3};
    run->fracture->tips.tip[0] = (struct crack_tip){.along = {1},
                                                    .place = {0, 2e-3},
                                                    .growth = 2e-3,
                                                    .start_time = 0.06,
                                                    .arrest_time = 0.08,
                                                    .first_time = 0.05,
                                                    .particles = 2};
    assert_int_equal(run_write_summary_files(run, OK, 2), OK);
    assert_int_equal(file_read_whole("summary/summary.json", &text, &length), OK);
    static const char *const part[] = {"\"name\": \"a \\\"b\\\"\\u000a\"",
                                       "\"status\": \"done\"",
                                       "\"steps\": 7",
                                       "\"time_end\": 0.10000000000000001",
                                       "\"length_end\": 0.002",
                                       "\"pd_share_start\": 0.25",
                                       "\"pd_share_end\": 0.75",
                                       "\"y\": 2",
                                       "\"ns_per_particle_step\": 1000",
                                       "\"threads\": 2",
                                       "\"setup_seconds\": 0.5",
                                       "\"loop_seconds\": 0.001,",
                                       "\"wall_seconds\": 3.0",
                                       "\"output_seconds\": 2.",
                                       "\"angle_deg\": 90"};
    for (size_t k = 0; k < COUNT_OF(part); k++)
        if (!strstr(text, part[k])) fail_msg("%s lacks %s", text, part[k]);
    assert_null(strstr(text, "nan"));
    assert_null(strstr(text, "inf"));
    assert_null(strstr(text, "message"));
    memory_free(text);
    remove_tree("summary"); /* if it cannot be written, the fault of the run is kept */
    assert_int_equal(run_write_summary_files(run, status_set(FAILED, "the run's own fault"), 2), FAILED);
    assert_string_equal(status_message(), "the run's own fault");
    assert_int_equal(run_write_summary_files(run, OK, 2), FAILED);
    assert_message("summary was moved, removed or replaced");
    run_components_free(run);
    memory_free(run);
    output_close(&o);
}

static int start(void **state)
{
    (void)state;
    output_install_signal_handling_for_file_writes();
    return 0;
}

int main(int argc, char **argv)
{
    static const struct CMUnitTest tests[] = {
        cmocka_unit_test(frames_come_back),
        cmocka_unit_test(frames_have_vtk_layout),
        cmocka_unit_test(plastic_strain_where_it_is),
        cmocka_unit_test(frames_hold_what_they_are_given),
        cmocka_unit_test(indices_list_all_frames),
        cmocka_unit_test(same_state_gives_same_bytes),
        cmocka_unit_test(damaged_frames_are_refused),
        cmocka_unit_test(folders_of_others_are_refused),
        cmocka_unit_test(older_run_is_replaced_unless_resumed),
        cmocka_unit_test(tables_of_others_stay),
        cmocka_unit_test(history_is_cut_back),
        cmocka_unit_test(history_on_a_full_disk_fails),
        cmocka_unit_test(summary_has_the_figures),
    };
    (void)argc;
    if (!enter_folder_beside(argv[0], "test_output.files")) return 1;
    int failed = cmocka_run_group_tests(tests, start, NULL);
    if (failed == 0 && chdir("..") == 0) remove_tree("test_output.files");
    return failed;
}
