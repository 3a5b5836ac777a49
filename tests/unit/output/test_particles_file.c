/* Tests the particles file, which contains the data that all frames share: its links, refusals, and the size of
 * frames. */
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tests/support/near.h"

#include "base/memory.h"
#include "output/checksum.h"
#include "output/output.h"
#include "output/output_files.h"
#include "output/output_hdf5.h"
#include "tests/robustness/trees.h"

static const char scene_text[] = "name: \"toy\"\nspace: plane stress\n";
enum { PARTICLES = 20000 };

static void open_fresh(struct output *o, const char *folder)
{
    remove_tree(folder);
    assert_int_equal(output_open(o, folder, scene_text, OUTPUT_OVERWRITE, false), OK);
}

/* Creates n particles p in `dim` dimensions that differ in every field, material points and peridynamic particles. */
static void make_particles(struct particles *p, int dim, int64_t n)
{
    particles_make(p, dim, n, 0);
    for (int64_t i = 0; i < n; i++) {
        const double a = (double)(i + 1);
        for (int d = 0; d < dim; d++)
            p->X[d][i] = sin(3 * a + d), p->x[d][i] = p->X[d][i] + 0.01 * cos(a + d), p->v[d][i] = sin(a - d);
        for (int k = 0; k < symmetric_tensor_component_count(dim); k++) p->stress[k][i] = 1e6 * cos(7 * a + k);
        p->damage[i] = fabs(sin(a)), p->kind[i] = (uint8_t)(i % 2), p->id[i] = (int32_t)i;
    }
}

static int64_t size_of(const char *path)
{
    struct stat s;
    assert_int_equal(stat(path, &s), 0);
    return (int64_t)s.st_size;
}

/* Checks the size of frames. A frame stores 4 bytes per particle for each component of position, displacement,
 * velocity, stress, damage and, if present, contact forces and fragments, and 1 for the kind: 21, 45 and 65 bytes in
 * 1D, 2D and 3D, with contact and fragments 29, 57 and 81. HDF5 adds about 0.02 bytes per particle and dataset and less
 * than 16 kB. */
static void frames_take_little(void **state)
{
    (void)state;
    static const int components[] = {0, 3 + 1 + 1, 6 + 4 + 1, 9 + 6 + 1};
    for (int dim = 1; dim <= DIM_MAX; dim++)
        for (int contact = 0; contact < 2; contact++) {
            struct output o;
            struct particles p;
            open_fresh(&o, "small");
            make_particles(&p, dim, PARTICLES);
            int32_t *fragment = NEW("fragment", PARTICLES, int32_t);
            for (int i = 0; i < PARTICLES; i++) fragment[i] = i % 7;
            const struct frame_extra extra = {.push = p.v, .fragment = fragment};
            assert_int_equal(output_begin_writing_frame_in_thread(&o, 0, &p, contact ? &extra : NULL, 0, 0, scene_text),
                             OK);
            assert_int_equal(output_wait_until_frame_is_written(&o), OK);
            const int64_t least = (4 * (components[dim] + (contact ? dim + 1 : 0)) + 1) * (int64_t)PARTICLES;
            const int64_t size = size_of("small/frames/000000.hdf");
            if (size < least || size > least + PARTICLES / 5 + 16384)
                fail_msg("%lld, %lld", (long long)size, (long long)least);
            if (dim == 2 && !contact) assert_true(size <= 58 * PARTICLES);
            if (dim == 3 && !contact) assert_true(size <= 80 * PARTICLES);
            memory_free(fragment);
            particles_free(&p);
            output_close(&o);
        }
}

/* Checks that an array with one value in thousands of rows, as of a body at rest, takes little space in a file and is
 * restored bit for bit. Negative zero is another value than zero. */
static void tables_come_back(void **state)
{
    (void)state;
    static const int64_t rows[] = {0, 1, 4095, 4096, 4097, 30000};
    for (size_t k = 0; k < COUNT_OF(rows); k++) {
        const int64_t n = rows[k];
        float *wide = NEW("wide", 2 * n, float), *narrow = NEW("narrow", n, float), *back = NEW("back", 3 * n, float);
        struct hdf f;
        for (int64_t i = 0; i < n; i++) narrow[i] = 5;
        if (n > 4097) wide[2 * 4500 + 1] = -0.0f, wide[2 * n - 1] = 3, narrow[20000] = 0;
        hdf_create(&f, "table.h5", false);
        hdf_write_rows_zero_padded(&f, "/wide", HDF_F32, n, 3, 2, wide);
        hdf_write_rows_zero_padded(&f, "/narrow", HDF_F32, n, 1, 1, narrow);
        hdf_close(&f);
        assert_false(f.failed);
        /* of each table at most two chunks of 4096 rows of 8 and 4 bytes hold more than one value */
        assert_true(size_of("table.h5") < 2 * 4096 * 12 + 8192);
        hdf_open_for_reading(&f, "table.h5");
        hdf_read_rows(&f, "/wide", HDF_F32, 3 * n, back);
        assert_false(f.failed);
        for (int64_t i = 0; i < 3 * n; i++) {
            const float is = i % 3 < 2 ? wide[i / 3 * 2 + i % 3] : 0;
            assert_true(arrays_equal(&back[i], &is, 1, sizeof is));
        }
        hdf_read_rows(&f, "/narrow", HDF_F32, n, back);
        assert_true(!f.failed && arrays_equal(back, narrow, n, sizeof *back));
        hdf_close(&f);
        memory_free(wide), memory_free(narrow), memory_free(back);
    }
}

/* Checks that the particles file is written with the first frame and stays unchanged while the particles are the same.
 * Other particles are written to a new file. */
static void one_file_while_particles_are_the_same(void **state)
{
    (void)state;
    struct output o;
    struct particles p, more;
    struct stat first, later;
    open_fresh(&o, "shared");
    make_particles(&p, 2, 500);
    make_particles(&more, 2, 600);
    assert_int_equal(output_write_frame(&o, &p, 0, 0, scene_text), OK);
    assert_int_equal(stat("shared/frames/particles_000000.h5", &first), 0);
    for (int k = 1; k < 3; k++) {
        output_discard_cached_frame_particle_order(&o);
        p.v[0][7] += 1;
        assert_int_equal(output_write_frame(&o, &p, k, k, scene_text), OK);
    }
    output_discard_cached_frame_particle_order(&o);
    assert_int_equal(output_write_frame(&o, &more, 3, 3, scene_text), OK);
    assert_int_equal(stat("shared/frames/particles_000000.h5", &later), 0);
    assert_true(first.st_ino == later.st_ino && first.st_mtime == later.st_mtime && first.st_size == later.st_size);
    assert_false(path_exists("shared/frames/particles_000001.h5") || path_exists("shared/frames/particles_000002.h5"));
    assert_true(path_is_file("shared/frames/particles_000003.h5"));
    assert_true(o.series[0].entry[2].particles == 0 && o.series[0].entry[3].particles == 3);
    output_close(&o);
    assert_int_equal(output_open(&o, "shared", scene_text, OUTPUT_OVERWRITE, false), OK);
    assert_false(path_exists("shared/frames/particles_000003.h5"));
    output_close(&o);
    particles_free(&p), particles_free(&more);
}

/* Changes one bit of the byte at offset `at` of the file `path`. */
static void flip(const char *path, long at)
{
    FILE *f = fopen(path, "r+");
    assert_true(f && fseek(f, at, SEEK_SET) == 0);
    const int byte = fgetc(f);
    assert_true(byte != EOF && fseek(f, at, SEEK_SET) == 0 && fputc(byte ^ 1, f) != EOF && fclose(f) == 0);
}

/* Checks that a frame is refused in one line if its particles file is missing, damaged, or that of another run. */
static void frames_alone_are_refused(void **state)
{
    (void)state;
    struct output o;
    struct particles p;
    struct output_frame f;
    static const char frame[] = "alone/frames/000000.hdf", file[] = "alone/frames/particles_000000.h5";
    for (int k = 0; k < 2; k++) {
        open_fresh(&o, k ? "alone" : "another");
        make_particles(&p, 2, 500);
        if (k) p.X[0][3] += 1;
        assert_int_equal(output_write_frame(&o, &p, 0, 0, scene_text), OK);
        output_close(&o);
        particles_free(&p);
    }
    assert_int_equal(frame_read(&f, frame), OK);
    frame_free(&f);
    flip(file, 3000);
    assert_failed(frame_read(&f, frame), "particles_000000.h5 in the same folder, to which it links, is damaged");
    flip(file, 3000);
    assert_int_equal(rename("another/frames/particles_000000.h5", file), 0);
    assert_failed(frame_read(&f, frame), "belongs to another run");
    assert_int_equal(unlink(file), 0);
    assert_failed(frame_read(&f, frame), "is missing");
    assert_int_equal(link(frame, file), 0);
    assert_failed(frame_read(&f, frame),
                  "particles_000000.h5 in the same folder, to which it links, belongs to another run");
}

/* Checks a restart with the particles file of another run in the folder: frames that link to it are omitted from the
 * index, a message names the file, and the next frame is written with a new particles file and can be read. */
static void foreign_file_is_left(void **state)
{
    (void)state;
    struct output o;
    struct particles p;
    struct output_frame f;
    char text[1000];
    int lost;
    open_fresh(&o, "foreign");
    make_particles(&p, 2, 500);
    p.X[0][3] += 1;
    assert_int_equal(output_write_frame(&o, &p, 0, 0, scene_text), OK);
    output_close(&o);
    open_fresh(&o, "left");
    p.X[0][3] -= 1;
    for (int k = 0; k < 2; k++) assert_int_equal(output_write_frame(&o, &p, k, k, scene_text), OK);
    assert_int_equal(output_remove_missing_frames_from_index(&o, &lost, text, sizeof text), OK);
    assert_int_equal(lost, 0);
    assert_int_equal(rename("foreign/frames/particles_000000.h5", "left/frames/particles_000000.h5"), 0);
    output_discard_cached_frame_particle_order(&o);
    assert_int_equal(output_remove_missing_frames_from_index(&o, &lost, text, sizeof text), OK);
    assert_int_equal(lost, 2);
    assert_non_null(
        strstr(text, "frames/000000.hdf links to frames/particles_000000.h5, which belongs to another run, and 1"));
    assert_int_equal(unlink("left/frames/particles_000000.h5"), 0);
    assert_int_equal(link("left/frames/000000.hdf", "left/frames/particles_000000.h5"), 0);
    o.series[0].particles.number = 0;
    assert_int_equal(output_remove_missing_frames_from_index(&o, &lost, text, sizeof text), OK);
    assert_int_equal(lost, 2);
    assert_int_equal(output_write_frame(&o, &p, 2, 2, scene_text), OK);
    assert_true(path_is_file("left/frames/particles_000002.h5"));
    assert_int_equal(frame_read(&f, "left/frames/000002.hdf"), OK);
    frame_free(&f);
    particles_free(&p);
    output_close(&o);
}

/* Asserts that a restart reports `lost` frames of the output o as lost, and that frames.xdmf in the folder `back` then
 * lists n frames. */
static void assert_listed(struct output *o, int n, int lost)
{
    char message[1000], *text;
    size_t length;
    int found = -1, listed = 0;
    assert_int_equal(output_remove_missing_frames_from_index(o, &found, message, sizeof message), OK);
    assert_int_equal(found, lost);
    assert_int_equal(file_read_whole("back/frames.xdmf", &text, &length), OK);
    for (const char *at = text; (at = strstr(at, "<Time ")); at++) listed++;
    assert_int_equal(listed, n);
    memory_free(text);
}

/* Checks that frames whose particles file is missing at one restart and present at the next are listed again, also if
 * the index file has been emptied in between. */
static void file_comes_back(void **state)
{
    (void)state;
    struct output o;
    struct particles p;
    static const char file[] = "back/frames/particles_000000.h5";
    open_fresh(&o, "back");
    make_particles(&p, 2, 500);
    for (int k = 0; k < 2; k++) assert_int_equal(output_write_frame(&o, &p, k, k, scene_text), OK);
    assert_listed(&o, 2, 0);
    assert_int_equal(rename(file, "away.h5"), 0);
    output_discard_cached_frame_particle_order(&o);
    assert_listed(&o, 0, 2);
    assert_int_equal(output_write_frame(&o, &p, 2, 2, scene_text), OK);
    assert_listed(&o, 1, 2);
    assert_int_equal(rename("away.h5", file), 0);
    assert_listed(&o, 3, 0);
    assert_int_equal(file_write_whole("back/frames.xdmf", "", 0), OK);
    assert_listed(&o, 3, 0);
    particles_free(&p);
    output_close(&o);
}

/* Checks that a frame that contains all data itself, without links to a particles file, is read. */
static void complete_frames_are_read(void **state)
{
    (void)state;
    struct output o;
    struct particles p;
    struct output_frame f;
    struct hdf from, to;
    open_fresh(&o, "complete");
    make_particles(&p, 3, 500);
    assert_int_equal(output_write_frame(&o, &p, 0.5, 7, scene_text), OK);
    output_close(&o);
    hdf_open_for_reading(&from, "complete/frames/000000.hdf");
    hdf_create(&to, file_register_temporary_and_return_path("complete.hdf").text, false);
    const hid_t list = H5Pcreate(H5P_OBJECT_COPY);
    assert_true(H5Pset_copy_object(list, H5O_COPY_EXPAND_EXT_LINK_FLAG) >= 0);
    assert_true(H5Ocopy(from.file, "/VTKHDF", to.file, "/VTKHDF", list, H5P_DEFAULT) >= 0);
    assert_true(H5Ocopy(from.file, "/Cleave", to.file, "/Cleave", list, H5P_DEFAULT) >= 0);
    H5Pclose(list);
    hdf_close(&from), hdf_close(&to);
    assert_int_equal(file_append_checksum_footer("complete.hdf"), OK);
    assert_int_equal(file_replace_by_temporary("complete.hdf"), OK);
    assert_int_equal(frame_read(&f, "complete.hdf"), OK);
    assert_true(f.n == 500 && f.t == 0.5 && f.step == 7 && f.X[2][9] == p.X[2][9]);
    frame_free(&f);
    particles_free(&p);
}

/* Checks that frames contain contact forces only if there are any. Otherwise readers find 0, also in the file of all
 * frames. */
static void contact_where_it_is(void **state)
{
    (void)state;
    struct output o;
    struct particles p;
    struct output_frame f;
    struct hdf h;
    float *force, all[2 * 500 * 3];
    int columns;
    char *text;
    size_t length;
    static const char *const path[] = {"touch/frames/000000.hdf", "touch/frames/000001.hdf"};
    open_fresh(&o, "touch");
    make_particles(&p, 2, 500);
    real *push[DIM_MAX] = {NEW("push", 500, real), NEW("push", 500, real), NULL};
    const struct frame_extra extra = {.push = push};
    for (int k = 0; k < 2; k++) {
        push[1][9] = k ? 2.5 : 0;
        assert_int_equal(output_begin_writing_frame_in_thread(&o, 0, &p, &extra, k, k, scene_text), OK);
        assert_int_equal(output_wait_until_frame_is_written(&o), OK);
        hdf_open_for_reading(&h, path[k]);
        assert_int_equal(hdf_dataset_element_count(&h, "/VTKHDF/PointData/contact_force"), k ? 1500 : -1);
        hdf_close(&h);
        assert_int_equal(frame_read(&f, path[k]), OK);
        assert_int_equal(frame_field_read(&f, path[k], "contact_force", &columns, &force), OK);
        for (int i = 0; i < 1500; i++) assert_true(force[i] == (i == 28 && k ? 2.5f : 0));
        assert_int_equal(columns, 3);
        memory_free(force);
        frame_free(&f);
    }
    assert_int_equal(file_read_whole("touch/frames.xdmf", &text, &length), OK);
    const char *once = strstr(text, "contact_force");
    assert_non_null(once);
    assert_non_null(strstr(text, "frames/particles_000000.h5:/VTKHDF/PointData/id"));
    assert_null(strstr(text, "000000.hdf:/VTKHDF/PointData/contact_force"));
    assert_non_null(strstr(text, "000001.hdf:/VTKHDF/PointData/contact_force"));
    memory_free(text);
    assert_int_equal(output_write_single_vtkhdf_with_all_frames(&o, scene_text), OK);
    hdf_open_for_reading(&h, "touch/frames.vtkhdf");
    hdf_read_rows(&h, "/VTKHDF/PointData/contact_force", HDF_F32, 3000, all);
    assert_false(h.failed);
    for (int i = 0; i < 3000; i++) assert_true(all[i] == (i == 1528 ? 2.5f : 0));
    hdf_close(&h);
    for (int d = 0; d < 2; d++) memory_free(push[d]);
    particles_free(&p);
    output_close(&o);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(frames_take_little),
        cmocka_unit_test(tables_come_back),
        cmocka_unit_test(one_file_while_particles_are_the_same),
        cmocka_unit_test(frames_alone_are_refused),
        cmocka_unit_test(foreign_file_is_left),
        cmocka_unit_test(file_comes_back),
        cmocka_unit_test(complete_frames_are_read),
        cmocka_unit_test(contact_where_it_is),
    };
    (void)argc;
    if (!enter_folder_beside(argv[0], "test_particles_file.files")) return 1;
    output_install_signal_handling_for_file_writes();
    return cmocka_run_group_tests(tests, NULL, NULL);
}
