/* Tests reading of frames: fields by name, all frames as one file, frames of regions. */
#include <errno.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tests/support/near.h"

#include "base/memory.h"
#include "output/output.h"
#include "output/output_files.h"
#include "output/output_hdf5.h"
#include "tests/robustness/trees.h"

static const char scene_text[] = "name: \"toy\"\nspace: plane stress\noutput:\n  regions:\n    - name: \"half\"\n";
enum { PARTICLES = 1000 };

static void open_fresh(struct output *o, const char *folder)
{
    remove_tree(folder);
    assert_int_equal(output_open(o, folder, scene_text, OUTPUT_OVERWRITE, false), OK);
}

/* Creates n particles p in `dim` dimensions with values in the fields; ids are in reverse order. */
static void make_particles(struct particles *p, int dim, int64_t n)
{
    particles_make(p, dim, n, 0);
    for (int64_t i = 0; i < n; i++) {
        for (int d = 0; d < dim; d++) p->X[d][i] = sin((double)(3 * i + d)), p->x[d][i] = p->X[d][i] + 0.01 * (real)d;
        for (int k = 0; k < symmetric_tensor_component_count(dim); k++)
            p->stress[k][i] = 1e6 * cos((double)(7 * i + k));
        p->id[i] = (int32_t)(2 * (n - 1 - i));
    }
}

/* Checks that fields of frames are read by name, stored and derived ones, and that other names yield a message. */
static void fields_are_read_by_name(void **state)
{
    (void)state;
    for (int dim = 1; dim <= DIM_MAX; dim++) {
        struct output o;
        struct particles p;
        struct output_frame f;
        static const char path[] = "named/frames/000000.hdf";
        float *value;
        int columns;
        open_fresh(&o, "named");
        make_particles(&p, dim, PARTICLES);
        assert_int_equal(output_write_frame(&o, &p, 0, 0, scene_text), OK);
        assert_int_equal(frame_read(&f, path), OK);
        assert_int_equal(frame_field_read(&f, path, "pressure", &columns, &value), OK);
        assert_int_equal(columns, 1);
        for (int64_t k = 0; k < f.n; k++) {
            double mean = 0;
            for (int d = 0; d < dim; d++) mean -= f.stress[d][k] / 3;
            assert_near(value[k], mean, 1e-7 * 1e6); /* single precision of the terms */
        }
        memory_free(value);
        assert_int_equal(frame_field_read(&f, path, "stress", &columns, &value), OK);
        assert_int_equal(columns, SYM_MAX);
        assert_true(value[SYM_MAX * 7] == f.stress[0][7]);
        memory_free(value);
        assert_int_equal(frame_field_read(&f, path, "strain", &columns, &value), FAILED);
        assert_non_null(strstr(status_message(), "has no field strain"));
        assert_int_equal(frame_field_read(&f, path, "../Points", &columns, &value), FAILED);
        frame_free(&f);
        particles_free(&p);
        output_close(&o);
    }
}

/* Reads step `step` of `steps` in `hdf` as VTK's reader of temporal unstructured grids does, and compares it with p.
 * The step has one part, of index PartOffsets[step]; its points start at PointOffsets, its cell offsets after one more
 * entry per preceding part, and a field at its own offset. */
static void check_step(struct hdf *hdf, int step, int steps, const struct particles *p)
{
    static const char *const start[] = {
        "PartOffsets",  "PointOffsets", "CellOffsets", "ConnectivityIdOffsets", "PointDataOffsets/stress",
        "NumberOfParts"};
    int64_t at[6], *all = calloc((size_t)steps, sizeof *all), counts[3], n = 0;
    char path[80];
    for (int k = 0; k < 6; k++) {
        snprintf(path, sizeof path, "/VTKHDF/Steps/%s", start[k]);
        hdf_read_rows(hdf, path, HDF_I64, steps, all);
        at[k] = all[step];
    }
    for (int k = 0; k < 3; k++) {
        static const char *const count[] = {"NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds"};
        snprintf(path, sizeof path, "/VTKHDF/%s", count[k]);
        hdf_read_rows(hdf, path, HDF_I64, steps, all);
        counts[k] = all[at[0]];
    }
    assert_true(at[5] == 1 && counts[0] == p->n && counts[1] == p->n && counts[2] == p->n);
    n = hdf_dataset_element_count(hdf, "/VTKHDF/Types");
    float *points = calloc((size_t)n * 3, sizeof *points), *stress = calloc((size_t)n * 6, sizeof *stress);
    int64_t *offset = calloc((size_t)(n + steps), sizeof *offset), *corner = calloc((size_t)n, sizeof *corner);
    hdf_read_rows(hdf, "/VTKHDF/Points", HDF_F32, 3 * n, points);
    hdf_read_rows(hdf, "/VTKHDF/PointData/stress", HDF_F32, 6 * n, stress);
    hdf_read_rows(hdf, "/VTKHDF/Offsets", HDF_I64, n + steps, offset);
    hdf_read_rows(hdf, "/VTKHDF/Connectivity", HDF_I64, n, corner);
    assert_false(hdf->failed);
    for (int64_t k = 0; k < p->n; k++) {
        const int64_t i = p->n - 1 - k; /* ids are in reverse order */
        assert_true(points[3 * (at[1] + k)] == (float)p->x[0][i]);
        assert_true(stress[6 * (at[4] + k)] == (float)p->stress[0][i]);
        assert_int_equal(offset[at[2] + at[0] + k], k);
        assert_int_equal(offset[at[2] + at[0] + k + 1], k + 1);
        assert_int_equal(corner[at[3] + k], k);
    }
    free(all), free(points), free(stress), free(offset), free(corner);
}

/* Checks that frames.vtkhdf has the layout published by VTK, stores no rows of its own, and can be moved with its
 * folder. */
static void frames_in_one_file(void **state)
{
    (void)state;
    enum { STEPS = 3 };
    struct output o;
    struct particles p[STEPS];
    struct hdf f;
    struct stat file;
    double time[STEPS];
    int32_t steps = 0;
    open_fresh(&o, "temporal");
    for (int k = 0; k < STEPS; k++) {
        make_particles(&p[k], 2, PARTICLES + 100 * k);
        output_discard_cached_frame_particle_order(&o);
        assert_int_equal(output_write_frame(&o, &p[k], 0.5 * k, k, scene_text), OK);
    }
    assert_int_equal(output_write_single_vtkhdf_with_all_frames(&o, scene_text), OK);
    output_close(&o);
    assert_int_equal(stat("temporal/frames.vtkhdf", &file), 0);
    assert_true(file.st_size < 64 << 10);
    nftw("moved", remove_one, 8, FTW_DEPTH | FTW_PHYS);
    assert_int_equal(rename("temporal", "moved"), 0);
    hdf_open_for_reading(&f, "moved/frames.vtkhdf");
    hdf_read_attribute(&f, "/VTKHDF/Steps", "NSteps", HDF_I32, &steps);
    assert_int_equal(steps, STEPS);
    hdf_read_rows(&f, "/VTKHDF/Steps/Values", HDF_F64, STEPS, time);
    for (int k = 0; k < STEPS; k++) {
        assert_true(time[k] == 0.5 * k);
        check_step(&f, k, STEPS, &p[k]);
        particles_free(&p[k]);
    }
    assert_int_equal(hdf_dataset_element_count(&f, "/VTKHDF/FieldData/scene"), 1);
    assert_int_equal(hdf_dataset_element_count(&f, "/VTKHDF/Steps/FieldDataSizes/units"), 2 * STEPS);
    assert_int_equal(hdf_dataset_element_count(&f, "/VTKHDF/Steps/PointDataOffsets/fragment"), -1);
    hdf_close(&f);
}

/* ---- regions ----------------------------------------------------------------------------------------------------- */

/* Checks that the series of frames of a region has its particles in the order of ids, its own folder and index files,
 * and is removed when the run is overwritten. */
static void frames_of_a_region(void **state)
{
    (void)state;
    struct solid half = {.kind = SOLID_BOX, .from = {0, -2}, .to = {2, 2}};
    const struct region region = {.n = 1, .solid = &half};
    struct output o;
    struct particles p;
    struct output_frame f;
    int64_t inside = 0;
    open_fresh(&o, "regions");
    assert_int_equal(output_add_frame_series(&o, "half", &region), OK);
    make_particles(&p, 2, PARTICLES);
    for (int64_t i = 0; i < p.n; i++) inside += region_contains(&region, (real[]){p.X[0][i], p.X[1][i]}, 2, 0);
    assert_int_equal(output_write_frame(&o, &p, 0, 0, scene_text), OK);
    for (int k = 0; k < 3; k++)
        assert_int_equal(output_begin_writing_frame_in_thread(&o, 1, &p, NULL, 0.5 * k, k, scene_text), OK);
    assert_int_equal(output_write_single_vtkhdf_with_all_frames(&o, scene_text), OK);
    assert_true(o.series[0].frames == 1 && o.series[1].frames == 3 && o.series[1].entry[2].rows == inside);
    assert_int_equal(frame_read(&f, "regions/frames_half/000002.hdf"), OK);
    assert_true(f.n == inside && inside > 100 && inside < PARTICLES - 100 && f.t == 1);
    for (int64_t k = 0; k < f.n; k++) {
        assert_true(f.X[0][k] >= 0 && (k == 0 || f.id[k] > f.id[k - 1]));
        assert_true(f.stress[0][k] == (float)p.stress[0][p.n - 1 - f.id[k] / 2]);
    }
    frame_free(&f);
    assert_true(path_is_file("regions/half.hdf.series") && path_is_file("regions/half.xdmf"));
    assert_true(path_is_file("regions/half.vtkhdf"));
    output_close(&o);
    assert_int_equal(output_open(&o, "regions", scene_text, OUTPUT_OVERWRITE, false), OK);
    assert_false(path_exists("regions/half.hdf.series") || path_exists("regions/frames_half"));
    assert_false(path_exists("regions/half.vtkhdf"));
    output_close(&o);
    particles_free(&p);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fields_are_read_by_name),
        cmocka_unit_test(frames_in_one_file),
        cmocka_unit_test(frames_of_a_region),
    };
    (void)argc;
    if (!enter_folder_beside(argv[0], "test_frame_files.files")) return 1;
    output_install_signal_handling_for_file_writes();
    return cmocka_run_group_tests(tests, NULL, NULL);
}
