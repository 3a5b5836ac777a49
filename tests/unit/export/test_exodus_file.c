/* Exports of scenes and runs as Exodus II files, read back by the library netCDF and by Cleave itself. */
#include <math.h>
#include <netcdf.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "tests/support/exodus_mesh.h"

#include "base/team.h"
#include "export/export.h"
#include "scene/particle_list.h"
#include "src/app/commands.h"
#include "tests/support/folder.h"

/* A plate of 3 x 2 particles of 4 mm and two materials, 5 mm thick, fixed at its left end and driven at its right
 * end. */
static const char plate[] =
    "space: plane stress\nthickness: 5 mm\nduration: 1 us\nmethod: pd\n"
    "materials: [{name: soft, young: 3 GPa, density: 1200}, {name: hard, young: 72 GPa, density: 2440}]\n"
    "bodies: [{name: plate, material: soft, shape: {box: {from: [0, 0], to: [12 mm, 8 mm]}}, parts: [{material: hard, "
    "region: {box: {from: [0, 0], to: [4 mm, 8 mm]}}}]}]\nparticles: {spacing: 4 mm}\ntime: {step: 0.25 us}\naccept: "
    "[steps, particles]\n"
    "boundary: [{name: grip, fixed: all, region: {box: {from: [0, 0], to: [4 mm, 8 mm]}}}, {velocity: [2 m/s, 0], "
    "region: {box: {from: [8 mm, 4 mm], to: [12 mm, 8 mm]}}}]\n";

static status export_to(const char *path, bool overwrite)
{
    const struct export_request r = {.scene = "scene.yaml", .folder = path, .overwrite = overwrite};
    FILE *to = fopen("scene.yaml", "w");
    assert_non_null(to);
    fputs(plate, to);
    fclose(to);
    return export_exodus(&r);
}

/* Returns the length of the dimension `name` of the open file `file`, as libnetcdf reads it. */
static size_t length_of(int file, const char *name)
{
    int id;
    size_t length;
    NC(nc_inq_dimid(file, name, &id));
    NC(nc_inq_dimlen(file, id, &length));
    return length;
}

static void get_reals(int file, const char *name, real *value)
{
    int id;
    NC(nc_inq_varid(file, name, &id));
    NC(nc_get_var_double(file, id, value));
}

static void get_integers(int file, const char *name, int *value)
{
    int id;
    NC(nc_inq_varid(file, name, &id));
    NC(nc_get_var_int(file, id, value));
}

/* Asserts that row k of the variable `name`, a list of names of 33 characters, is `wanted`. */
static void assert_name(int file, const char *name, size_t k, const char *wanted)
{
    char text[34] = "";
    int id;
    NC(nc_inq_varid(file, name, &id));
    NC(nc_get_vara_text(file, id, (size_t[]){k, 0}, (size_t[]){1, 33}, text));
    assert_string_equal(text, wanted);
}

/* Checks the file of an exported scene as libnetcdf reads it: blocks by material, positions, volumes and node sets. */
static void scene_by_netcdf(void **state)
{
    (void)state;
    int file, id, node[4], sets[2];
    real X[6], attribute[8];
    char type[8] = "";
    assert_ok(export_to("a.exo", false));
    NC(nc_open("a.exo", NC_NOWRITE, &file));
    assert_int_equal(length_of(file, "num_dim"), 3);
    assert_int_equal(length_of(file, "num_nodes"), 6);
    assert_int_equal(length_of(file, "num_elem"), 6);
    assert_int_equal(length_of(file, "num_el_in_blk1"), 4); /* soft */
    assert_int_equal(length_of(file, "num_el_in_blk2"), 2); /* hard */
    assert_int_equal(length_of(file, "time_step"), 0);
    get_reals(file, "coordx", X);
    for (int k = 0; k < 6; k++) assert_true(k < 4 ? X[k] > 5e-3 : fabs(X[k] - 2e-3) < 1e-15);
    get_reals(file, "coordz", X);
    for (int k = 0; k < 6; k++) assert_exact(X[k], 0);
    get_integers(file, "connect2", node);
    assert_true(node[0] == 5 && node[1] == 6);
    NC(nc_inq_varid(file, "connect2", &id));
    NC(nc_get_att_text(file, id, "elem_type", type));
    assert_string_equal(type, "SPHERE");
    get_reals(file, "attrib1", attribute);
    for (int k = 0; k < 4; k++) {
        assert_close(attribute[2 * k + 1], 16e-6 * 5e-3, 1e-14);
        assert_close(pow(attribute[2 * k], 3) * 4 / 3 * M_PI, 16e-6 * 5e-3, 1e-14);
    }
    assert_name(file, "attrib_name1", 1, "volume");
    assert_name(file, "eb_names", 1, "block_2");
    get_integers(file, "eb_prop1", sets);
    assert_true(sets[0] == 1 && sets[1] == 2);
    assert_name(file, "ns_names", 0, "grip");
    get_integers(file, "node_ns1", node);
    assert_true(length_of(file, "num_nod_ns1") == 2 && node[0] == 5 && node[1] == 6);
    assert_int_equal(length_of(file, "num_nod_ns2"), 1);
    get_integers(file, "node_ns2", node);
    get_reals(file, "coordy", X);
    assert_close(X[node[0] - 1], 6e-3, 1e-14);
    NC(nc_close(file));
    unlink("a.exo");
}

/* Checks that the file that an export has written is read back as a particle list with its positions, volumes and
 * materials. */
static void scene_by_cleave(void **state)
{
    (void)state;
    struct particle_list l;
    assert_ok(export_to("a.exo", false));
    assert_ok(particle_list_read(&l, "a.exo", &(struct particle_list_form){.scale = 1e3}, 2));
    assert_int_equal(l.n, 6);
    real sum = 0;
    for (int64_t i = 0; i < l.n; i++) {
        assert_exact(l.material[i], i < 4 ? 0 : 1);
        assert_close(l.volume[i], 1e9 * 16e-6 * 5e-3, 1e-14);
        sum += l.X[0][i] + l.X[1][i];
    }
    assert_close(sum, 2 * (2 + 6 + 10) + 3 * (2 + 6), 1e-14); /* [mm] */
    particle_list_free(&l);
    assert_refused(particle_list_read(&l, "a.exo", &(struct particle_list_form){.columns = "x"}, 2),
                   "names its columns");
    unlink("a.exo");
}

/* Removes the folder `out` of a run of 4 frames. */
static void remove_run(void) { assert_int_equal(system("rm -r out"), 0); }

/* Checks the frames of an exported run, as libnetcdf reads them as time steps: the driven particle has moved by its
 * speed times the time, the held ones have not, and the last frame equals the end of the run. */
static void run_by_netcdf(void **state)
{
    (void)state;
    char *run[] = {"run", "scene.yaml", "-q", "-o", "out", "-s", "output.frames=4", NULL};
    int file, id, node[2], driven;
    real t[5], u[6], damage[4];
    assert_ok(export_to("a.exo", false));
    assert_ok(command_run_main(7, run));
    assert_ok(export_exodus(&(struct export_request){.scene = "out", .folder = "a.exo", .overwrite = true}));
    NC(nc_open("a.exo", NC_NOWRITE, &file));
    assert_int_equal(length_of(file, "time_step"), 5);
    get_reals(file, "time_whole", t);
    assert_close(t[4], 1e-6, 1e-9);
    get_integers(file, "node_ns1", node);
    get_integers(file, "node_ns2", &driven);
    assert_name(file, "name_nod_var", 0, "displacement_x");
    assert_name(file, "name_nod_var", 3, "velocity_x");
    assert_name(file, "name_elem_var", 0, "damage");
    for (size_t k = 0; k < 5; k++) {
        NC(nc_inq_varid(file, "vals_nod_var1", &id));
        NC(nc_get_vara_double(file, id, (size_t[]){k, 0}, (size_t[]){1, 6}, u));
        assert_near(u[driven - 1], 2 * t[k], 2e-6 * 1e-6); /* frames have single precision */
        assert_true(u[node[0] - 1] == 0 && u[node[1] - 1] == 0);
        NC(nc_inq_varid(file, "vals_elem_var1eb1", &id));
        NC(nc_get_vara_double(file, id, (size_t[]){k, 0}, (size_t[]){1, 4}, damage));
        for (int i = 0; i < 4; i++) assert_exact(damage[i], 0);
    }
    NC(nc_close(file));
    unlink("a.exo");
    assert_refused(export_exodus(&(struct export_request){.scene = "out", .folder = "a.exo", .overrides = 1}),
                   "out is a run, whose scene -s cannot change");
    remove_run();
}

/* Checks that an export refuses to replace a file that is no export, and replaces an export only with --overwrite. */
static void files_are_kept(void **state)
{
    (void)state;
    FILE *to = fopen("a.e", "w");
    fputs("mine\n", to);
    fclose(to);
    assert_refused(export_to("a.e", true), "a.e exists and is not an export of Cleave");
    unlink("a.e");
    assert_ok(export_to("a.e", false));
    assert_refused(export_to("a.e", false), "a.e exists; choose another -o, or replace it with --overwrite");
    assert_ok(export_to("a.e", true));
    unlink("a.e");
    assert_refused(export_to("a.vtk", false), "a.vtk: give a name that ends in .exo, .e or .g");
}

int main(void)
{
    threads_set_count_and_bind_to_cores(2);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scene_by_netcdf),
        cmocka_unit_test(scene_by_cleave),
        cmocka_unit_test(run_by_netcdf),
        cmocka_unit_test(files_are_kept),
    };
    return cmocka_run_group_tests(tests, folder_enter, folder_leave);
}
