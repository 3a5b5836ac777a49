/* Tests of lists of particles: CSV and HDF5 files that fill bodies, and refusals. */
#include "tests/support/near.h"

#include <hdf5.h>
#include <omp.h>
#include <stdlib.h>
#include <unistd.h>

#include "base/memory.h"
#include "tests/support/setting.h"
#include "scene/fill.h"

/* Writes `text` to the file `name` in the test's folder and makes it the list of body 0 of s. */
static void list_of(struct setting *s, char *name, const char *text)
{
    FILE *file = fopen(name, "wb");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
    s->body[0].file = name;
}

static void csv_lists_are_read(void **state)
{
    (void)state;
    struct setting s;
    struct particles p;
    char name[] = "list.csv";
    setting_make(&s, SPACE_PLANE_STRESS, (real[]){1, 1});
    list_of(&s, name,
            "\xEF\xBB\xBF# two particles\r\n\r\n body , volume,y,material, x\r\n"
            "0,2e-3,1,1,-1.5\r\n#\n0, 1e-3 ,\t0.5,0,2.5e-1");
    s.body[0].velocity[0] = 4;
    s.scene.irregularity = 0.5; /* applies to lattices, not to lists */
    assert_ok(bodies_fill_with_particles(&p, &s.scene, NULL, 0));
    assert_int_equal(p.n, 2);
    const real want[2][5] = {{0.25, 0.5, 1e-3, 1, 1}, {-1.5, 1, 2e-3, 4, 0}}; /* x, y, volume, mass, id; by row */
    for (int i = 0; i < 2; i++) {
        assert_exact(p.X[0][i], want[i][0]);
        assert_exact(p.X[1][i], want[i][1]);
        assert_exact(p.volume0[i], want[i][2]);
        assert_close(p.mass[i], want[i][3], 1e-15);
        assert_int_equal(p.id[i], want[i][4]);
        assert_int_equal(p.material[i], 1 - i == 0);
        assert_exact(p.v[0][i], 4);
    }
    particles_free(&p);
    remove(name);
}

/* Checks two bodies from one file, each with its own rows. Without a spacing in the scene, particles are sorted with
 * the spacing of the mean particle. */
static void bodies_share_a_list(void **state)
{
    (void)state;
    struct setting s;
    struct particles p;
    char name[] = "shared.csv";
    setting_make(&s, SPACE_LINE, (real[]){1});
    list_of(&s, name, "x,volume,body\n3,1,1\n1,1,0\n2,1,1\n");
    s.scene.bodies = 2;
    s.body[1].file = name, s.body[1].material = 1;
    s.scene.spacing = 0;
    assert_ok(bodies_fill_with_particles(&p, &s.scene, NULL, 0));
    for (int i = 0; i < 3; i++) {
        assert_exact(p.X[0][i], i + 1);
        assert_int_equal(p.body[i], i > 0);
        assert_int_equal(p.material[i], i > 0);
    }
    particles_free(&p);
    s.body[1].file = NULL;
    assert_refused(bodies_fill_with_particles(&p, &s.scene, NULL, 0),
                   "shared.csv:2: the body with the number 1 (counted from 0 in the order of the scene) does not use "
                   "this file; correct the column body");
    remove(name);
}

/* Lists of particles in the CSV file bad.csv that are refused, with a part of the message. */
static const struct {
    const char *text, *message;
} bad_list[] = {
    {"", "bad.csv: the file is empty"},
    {"# nothing\n\n", "bad.csv: the file is empty"},
    {"x,y,volume\n", "body plate: has no particle in its list"},
    {"x,y,weight,volume\n",
     "bad.csv:1:5: the column weight may be a mass or a volume; give its unit, such as weight [kg]"},
    {"x,y,weight [m],volume\n", "bad.csv:1:5: the column weight may be a mass or a volume"},
    {"x,y,mass,density\n", "bad.csv:1:1: mass and density are both given"},
    {"x [s],y,volume\n", "bad.csv:1:4: x: [s] is a time; give a length, such as 0.5 mm"},
    {"x [furlong],y,volume\n", "bad.csv:1:4: x: [furlong] has an unknown unit"},
    {"x,y,volume,material\n0,0,1,glass\n", "bad.csv:2:7: the scene has no material glass; give one that it has"},
    {"x,y,mass\n0,0,0\n", "bad.csv:2:5: mass: 0 must be larger than 0"},
    {"x,volume\n", "bad.csv:1:1: column y is missing"},
    {"x,y,x,volume\n", "bad.csv:1:5: two columns are named x; rename or remove one"},
    {"x,y,volume\n0,0,1\n1,1\n", "bad.csv:3:1: this line has 2 values, but the header names 3"},
    {"x,y,volume\n0,0,1,5\n", "bad.csv:2:7: this line has more values than the 3"},
    {"x,y,volume\n0,0,1,\n", "bad.csv:2:7: this line has more values than the 3"},
    {"x,y,volume\n\n0,zero,1\n", "bad.csv:3:3: y: 'zero' is not a number; correct it"},
    {"x,y,volume\n0,1 mm,1\n", "bad.csv:2:3: y: '1 mm' is not a number; correct it"},
    {"x,y,volume\n0,,1\n", "bad.csv:2:3: y: '' is not a number; correct it"},
    {"x,y,volume\n0,nan,1\n", "bad.csv:2:3: y: nan is not a finite number"},
    {"x,y,volume\n1e999,0,1\n", "bad.csv:2:1: x: 1e999 is not a finite number"},
    {"x,y,volume\n0,0,0\n", "bad.csv:2:5: volume: 0 must be larger than 0"},
    {"x,y,volume\n0,0,-1\n", "bad.csv:2:5: volume: -1 must be larger than 0"},
    {"x,y,volume,material\n0,0,1,0.5\n", "bad.csv:2:7: material: 0.5 must be a whole number"},
    {"x,y,volume,material\n0,0,1,256\n", "bad.csv:2:7: material: 256 must be a whole number"},
    {"x,y,volume,material\n0,0,1,2\n",
     "bad.csv:2:7: the scene has no material 2 (numbered from 0 in the order of the scene)"},
    {"x,y,volume,body\n0,0,1,1\n", "bad.csv:2: the body with the number 1 (counted from 0 in the order of the scene) "
                                   "does not use this file; correct the column body"},
    {"x,y,volume\n0x1p-9,0,1\n", "bad.csv:2:1: x: '0x1p-9' is not a number; correct it"},
    {"'x','y','volume'\n", "names without quotes or in double quotes"},
    {"\"x,y,volume\n", "names without quotes or in double quotes"},
    {"x;y;volume\n0,5;0;1\n", "bad.csv:2:1: x: '0,5' is not a number; correct it (the decimal sign "
                              "is a point, not a comma)"},
    {"# x and places\n0 0 0 1\n", "bad.csv:2:1: this line has numbers, but no line before it names the columns"},
    {"0,0,0,1,1\n", "bad.csv:1:1: this line has numbers, but no line before it names the columns"},
    {"0 0 0 3 1.0\n",
     "bad.csv:1:7: the scene has no material of block_id 3 (numbered from 1 in the order of the scene); give one"},
    {"0 0 0 0 1\n", "bad.csv:1:7: block_id: 0 must be a whole number from 1 to 256; correct it"},
    {"0 0 0 3.0 2\n", "bad.csv:1:7: 3.0: without names the fourth column is block_id, a whole number; "
                      "if it is the volume, give the list as {file: .., columns: [x, y, z, volume, block]}, else"},
    {"0 0 0 1 1\n1 0 0 1 2\n", "bad.csv:1:1: columns 4 and 5 are both whole numbers, so either may be the "
                               "block or the volume; say which: {file: .., columns: [x, y, z, block, volume]} or"},
    {"0 0 0 1 2\n0.5 0 0 0.25 2\n", "bad.csv:2:9: 0.25: without names the fourth column is block_id"},
    {"x,y,volume\r0,0,1\r", "lines end in carriage returns only; convert the line ends to line feeds"},
    {"x,y,volume\n0,0,1\n3,3,1\n0,0,1\n", "two particles at (0, 0, 0) m"},
    {"x,y,volume\n0,0,1\n0.0004,0.0002,1\n", "two particles at ("},
    {"x,y,volume\n1e10,0,1\n", "beyond 1e7 spacings"},
    {"x,y,volume\n0,0,1e308\n", "no finite mass"},
};

static void bad_lists_are_refused(void **state)
{
    (void)state;
    struct setting s;
    struct particles p;
    char name[] = "bad.csv";
    setting_make(&s, SPACE_PLANE_STRESS, (real[]){1, 1});
    for (size_t k = 0; k < COUNT_OF(bad_list); k++) {
        list_of(&s, name, bad_list[k].text);
        assert_refused(bodies_fill_with_particles(&p, &s.scene, NULL, 0), bad_list[k].message);
        assert_null(p.X[0]);
    }
    char *text = memory_new("text", 10001, 1);
    memset(text, '1', 10000);
    list_of(&s, name, text);
    assert_refused(bodies_fill_with_particles(&p, &s.scene, NULL, 0), "bad.csv:1: this is not a line of text");
    memory_free(text);
    remove(name);
    assert_refused(bodies_fill_with_particles(&p, &s.scene, NULL, 0),
                   "bad.csv: there is no such file; check the name and the folder");
    s.body[0].file = "points.xyz";
    assert_refused(bodies_fill_with_particles(&p, &s.scene, NULL, 0),
                   "points.xyz: is not a particle list; give a file that ends in .csv, .h5 or .exo");
}

static void write_table(hid_t file, const char *name, int rank, const hsize_t *extent, hid_t type, const void *value)
{
    hid_t space = H5Screate_simple(rank, extent, NULL);
    hid_t set = H5Dcreate2(file, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    assert_true(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, value) >= 0);
    H5Dclose(set);
    H5Sclose(space);
}

static void hdf5_lists_are_read(void **state)
{
    (void)state;
    struct setting s;
    struct particles p;
    char name[] = "list.h5";
    const double X[3][2] = {{0, 0}, {1, 0}, {0, 1}}, volume[3] = {1, 2, 3};
    const float short_volume[2] = {1, 2};
    const int material[3] = {1, 0, 1};
    setting_make(&s, SPACE_PLANE_STRESS, (real[]){1, 1});
    list_of(&s, name, "no HDF5");
    assert_refused(bodies_fill_with_particles(&p, &s.scene, NULL, 0),
                   "list.h5: this is not an HDF5 file; give one, or a .csv file");
    for (int part = 0; part < 4; part++) {
        hid_t file = H5Fcreate(name, H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
        write_table(file, "positions", 2, (hsize_t[]){3, 2}, H5T_NATIVE_DOUBLE, X);
        if (part == 1) write_table(file, "volumes", 1, (hsize_t[]){2}, H5T_NATIVE_FLOAT, short_volume);
        if (part >= 2) write_table(file, "volumes", 1, (hsize_t[]){3}, H5T_NATIVE_DOUBLE, volume);
        if (part == 3) write_table(file, "material", 1, (hsize_t[]){3}, H5T_NATIVE_INT, material);
        H5Fclose(file);
        if (part == 1)
            assert_refused(bodies_fill_with_particles(&p, &s.scene, NULL, 0),
                           "volumes has 2 x 1 numbers, but must have 3 x 1");
        if (part == 1) continue;
        assert_ok(bodies_fill_with_particles(&p, &s.scene, NULL, 0));
        for (int i = 0; i < 3; i++) {
            assert_exact(p.X[0][i], X[i][0]);
            assert_exact(p.X[1][i], X[i][1]);
            assert_exact(p.volume[i], part == 0 ? 0.25 : volume[i]);
            assert_int_equal(p.material[i], part == 3 ? material[i] : 0);
        }
        particles_free(&p);
    }
    s.scene.dim = 1, s.scene.space = SPACE_LINE;
    assert_refused(bodies_fill_with_particles(&p, &s.scene, NULL, 0), "two particles at (0, 0, 0) m");
    remove(name);
}

/* Writes the attribute `unit` of the dataset `name` in `file`, of fixed or variable length. */
static void unit_write(hid_t file, const char *name, const char *unit, bool variable)
{
    hid_t type = H5Tcopy(H5T_C_S1), space = H5Screate(H5S_SCALAR);
    H5Tset_size(type, variable ? H5T_VARIABLE : strlen(unit));
    hid_t at = H5Acreate_by_name(file, name, "unit", type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    assert_true(H5Awrite(at, type, variable ? (const void *)&unit : unit) >= 0);
    H5Aclose(at);
    H5Sclose(space);
    H5Tclose(type);
}

/* Checks positions in 3D, velocities, masses, and their units. */
static void hdf5_lists_have_units(void **state)
{
    (void)state;
    struct setting s;
    struct particles p;
    struct particle_list_head head;
    char name[] = "units.h5";
    const double X[2][3] = {{0, 0, 7}, {500, 0, 7}}, v[2][2] = {{1, 2}, {3, 4}}, mass[2] = {5, 6};
    for (int part = 0; part < 4; part++) {
        hid_t file = H5Fcreate(name, H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
        setting_make(&s, SPACE_PLANE_STRESS, (real[]){1, 1});
        s.body[0].file = name;
        write_table(file, "positions", 2, (hsize_t[]){2, 3}, H5T_NATIVE_DOUBLE, X);
        write_table(file, "velocities", 2, (hsize_t[]){2, 2}, H5T_NATIVE_DOUBLE, v);
        write_table(file, "mass", 1, (hsize_t[]){2}, H5T_NATIVE_DOUBLE, mass);
        unit_write(file, "positions", part == 2 ? "kg" : "mm", part % 2);
        unit_write(file, "velocities", "km/s", !(part % 2));
        if (part == 3) write_table(file, "density", 1, (hsize_t[]){2}, H5T_NATIVE_DOUBLE, mass);
        H5Fclose(file);
        if (part == 2)
            assert_refused(particle_list_read_column_names(&head, name, NULL, 2),
                           "positions: its unit kg is a mass; give a length");
        if (part == 3)
            assert_refused(particle_list_read_column_names(&head, name, NULL, 2), "mass and density are both given");
        if (part >= 2) continue;
        assert_ok(particle_list_read_column_names(&head, name, NULL, 2));
        assert_string_equal(head.note, "further positions not read; no volumes: taken from the spacing");
        assert_ok(bodies_fill_with_particles(&p, &s.scene, NULL, 0));
        assert_close(p.X[0][1], 0.5, 1e-15);
        assert_close(p.v[1][1], 4000, 1e-15);
        assert_exact(p.mass[1], 6);
        particles_free(&p);
    }
    remove(name);
}

/* Checks what is refused: positions that are a link in the file or to another one, numbers stored in another file or
 * dataset, or far more numbers than the file has bytes. */
static void hdf5_lists_are_whole(void **state)
{
    (void)state;
    enum { OUTSIDE, INSIDE, BESIDE, VIRTUAL, CLAIMED, WAYS };
    static const char *const said[WAYS] = {"positions is a link", "positions is a link",
                                           "positions is stored in another file", "positions is stored in another file",
                                           "claims 100000000 entries"};
    const double X[3][2] = {{0, 0}, {1, 0}, {0, 1}}, volume[3] = {1, 2, 3};
    const hsize_t rows[] = {3, 2}, many[] = {100000000, 2}, chunk[] = {1000000, 2};
    struct setting s;
    struct particles p;
    char name[] = "whole.h5";
    setting_make(&s, SPACE_PLANE_STRESS, (real[]){1, 1});
    s.body[0].file = name;
    hid_t file = H5Fcreate("other.h5", H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    write_table(file, "positions", 2, rows, H5T_NATIVE_DOUBLE, X);
    H5Fclose(file);
    for (int kind = 0; kind < WAYS; kind++) {
        hid_t how = H5Pcreate(H5P_DATASET_CREATE), space = H5Screate_simple(2, kind == CLAIMED ? many : rows, NULL),
              set = -1;
        file = H5Fcreate(name, H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
        write_table(file, "volumes", 1, rows, H5T_NATIVE_DOUBLE, volume);
        if (kind == OUTSIDE)
            assert_true(H5Lcreate_external("other.h5", "/positions", file, "positions", H5P_DEFAULT, H5P_DEFAULT) >= 0);
        if (kind == INSIDE) assert_true(H5Lcreate_soft("/volumes", file, "positions", H5P_DEFAULT, H5P_DEFAULT) >= 0);
        if (kind == BESIDE) assert_true(H5Pset_external(how, "numbers.bin", 0, H5F_UNLIMITED) >= 0);
        if (kind == VIRTUAL) assert_true(H5Pset_virtual(how, space, "other.h5", "/positions", space) >= 0);
        if (kind == CLAIMED) assert_true(H5Pset_chunk(how, 2, chunk) >= 0);
        if (kind >= BESIDE)
            set = H5Dcreate2(file, "positions", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, how, H5P_DEFAULT);
        if (set >= 0) H5Dclose(set);
        H5Sclose(space);
        H5Pclose(how);
        H5Fclose(file);
        assert_refused(bodies_fill_with_particles(&p, &s.scene, NULL, 0), said[kind]);
    }
    remove(name);
    remove("other.h5");
}

/* ---- lists whose unit is not that of the scene ------------------------------------------------------------------- */

/* Clusters of `together` particles at distances `near` along x, on a square or cubic grid of `side` positions per axis
 * at distances `apart`. The first `single` positions have one particle only. The volume of a particle is `times` that
 * of a cube of the distance to its nearest neighbour; times = 0 means 1. */
struct grains {
    int side, together, single;
    real near, apart, times;
};

static void write_grains(const char *name, int dim, const struct grains *g)
{
    static const char *const head[DIM_MAX + 1] = {"", "x,volume", "x,y,volume", "x,y,z,volume"};
    FILE *file = fopen(name, "w");
    assert_non_null(file);
    fprintf(file, "%s\n", head[dim]);
    int64_t places = 1;
    real volume = g->times > 0 ? g->times : 1;
    for (int d = 0; d < dim; d++) places *= g->side, volume *= g->together > 1 ? g->near : g->apart;
    for (int64_t k = 0; k < places; k++)
        for (int m = 0; m < (k < g->single ? 1 : g->together); m++) {
            int64_t rest = k;
            for (int d = 0; d < dim; d++, rest /= g->side)
                fprintf(file, "%.12g,", (real)(rest % g->side) * g->apart + (d == 0 ? m * g->near : 0));
            fprintf(file, "%.12g\n", volume);
        }
    fclose(file);
}

enum { PD = METHOD_PD, MPM = METHOD_MPM, BOTH = METHOD_ADAPTIVE };

/* A list in a scene, and a part of the expected message; NULL: the list is accepted. */
static const struct {
    enum space space;
    int method;
    real spacing;
    struct grains g;
    const char *says;
} told[] = {
    /* Lists in millimetres read as metres, and in metres read as millimetres. */
    {SPACE_PLANE_STRESS,
     PD,
     1e-3,
     {10, 1, 0, 0, 1, 0},
     "100 % of its particles have no neighbour within 3.015 "
     "spacings of 0.001 m: particles of the list are 1 m apart; give the list in m "
     "(is it in mm?), or name its unit as in particles: {file: .., unit: mm}, or set particles.spacing to about 1 m"},
    {SPACE_PLANE_STRESS, MPM, 1e-3, {10, 1, 0, 0, 1, 0}, "no neighbour within 2 spacings of 0.001 m"},
    {SPACE_PLANE_STRESS,
     BOTH,
     1e-3,
     {20, 1, 0, 0, 1, 0},
     "about 100 % of its particles have no neighbour within 3.015 spacings"},
    {SPACE_SOLID, PD, 0.025, {4, 1, 0, 0, 2.5, 0}, "(perhaps the list is in mm or cm)"},
    /* Particles 1 mm apart with a spacing of 5 mm, or 1 cm apart: volumes in m^3 decide. */
    {SPACE_PLANE_STRESS, PD, 5e-3, {10, 1, 0, 0, 1, 1e-6}, "(is it in mm?)"},
    {SPACE_PLANE_STRESS, PD, 5e-3, {10, 1, 0, 0, 1, 1e-4}, "(is it in cm?)"},
    {SPACE_SOLID, PD, 2e-2, {4, 1, 0, 0, 1, 1e-9}, "(is it in mm?)"},
    {SPACE_LINE, PD, 1e-3, {50, 1, 0, 0, 1, 0}, "100 % of its particles"},
    {SPACE_PLANE_STRESS,
     PD,
     1,
     {10, 1, 0, 0, 1e-3, 0},
     "neighbours of the list are 0.001 m apart, but the spacing is 1 m; set "
     "particles.spacing to about 0.001 m (is it in mm?), or give the list in m"},
    {SPACE_PLANE_STRESS, MPM, 1, {10, 1, 0, 0, 1e-3, 0}, "neighbours of the list are 0.001 m apart"},
    {SPACE_SOLID, BOTH, 1, {5, 1, 0, 0, 0.1, 0}, "neighbours of the list are 0.1 m apart"},
    {SPACE_SOLID,
     PD,
     1,
     {5, 1, 0, 0, 1, 1e9},
     "volumes of its particles are 1e+09 times those expected from the distance of neighbours, 1 m; "
     "give volumes in m^3 (are they in mm^3?)"},
    {SPACE_PLANE_STRESS,
     MPM,
     1,
     {10, 1, 0, 0, 1, 1e-3},
     "volumes of its particles are 0.001 times those expected from the distance of neighbours, "
     "1 m, times the thickness; give volumes in m^3"},
    /* Valid lists. */
    {SPACE_SOLID, PD, 1, {5, 1, 0, 0, 1, 50}, NULL}, /* heavy knots of a net */
    {SPACE_PLANE_STRESS, PD, 1, {10, 1, 0, 0, 1, 0}, NULL},
    {SPACE_PLANE_STRESS, PD, 1, {10, 1, 0, 0, 3, 0}, NULL}, /* neighbours near the horizon */
    {SPACE_PLANE_STRESS, MPM, 1, {10, 1, 0, 0, 3, 0}, "no neighbour within 2 spacings"},
    {SPACE_SOLID, PD, 1, {5, 1, 0, 0, 0.2, 0}, NULL},        /* fine part of a graded body */
    {SPACE_PLANE_STRESS, PD, 1, {10, 2, 0, 1, 50, 0}, NULL}, /* pairs, far apart */
    {SPACE_PLANE_STRESS, MPM, 1, {10, 2, 0, 1, 50, 0}, NULL},
    {SPACE_PLANE_STRESS, MPM, 1, {10, 2, 60, 1, 50, 0}, NULL}, /* 60 single particles beside 40 such pairs: 43 % */
    {SPACE_PLANE_STRESS, MPM, 1, {10, 2, 72, 1, 50, 0}, "56 % of its particles"},
    {SPACE_LINE, PD, 1, {7, 1, 0, 0, 50, 0}, NULL}, /* seven mass points */
    {SPACE_LINE, PD, 1, {8, 1, 0, 0, 50, 0}, "100 % of its particles"},
};

static void units_of_lists_are_told(void **state)
{
    (void)state;
    char name[] = "grains.csv";
    for (size_t k = 0; k < COUNT_OF(told); k++) {
        struct setting s;
        struct particles p;
        setting_make(&s, told[k].space, (real[]){1, 1, 1});
        s.scene.method = (enum method)told[k].method, s.scene.spacing = told[k].spacing, s.scene.horizon = 3.015,
        s.scene.cell = 2;
        s.body[0].file = name;
        snprintf(s.body[0].place, sizeof s.body[0].place, "a.yaml:7:3: particles: ");
        write_grains(name, s.scene.dim, &told[k].g);
        assert_ok(particle_list_read_column_names(&s.body[0].list, name, NULL, s.scene.dim));
        if (told[k].says) {
            assert_refused(bodies_fill_with_particles(&p, &s.scene, NULL, 0), told[k].says);
            assert_null(p.X[0]);
            assert_refused(REFUSED, "a.yaml:7:3: particles: body plate: ");
        } else {
            assert_ok(bodies_fill_with_particles(&p, &s.scene, NULL, 0));
            particles_free(&p);
        }
    }
    remove(name);
}

/* Checks lists whose particles have neighbours only in another body: accepted for material points, which interact on
 * the grid, and refused for bonds, which stay within a body. */
static void other_bodies_are_neighbours_of_points(void **state)
{
    (void)state;
    struct setting s;
    struct particles p;
    char name[] = "strewn.csv";
    setting_make(&s, SPACE_PLANE_STRESS, (real[]){20, 20});
    s.scene.horizon = 3.015, s.scene.cell = 2, s.scene.bodies = 2;
    s.body[1].file = name;
    write_grains(name, 2, &(struct grains){5, 1, 0, 0, 4, 0});
    assert_ok(bodies_fill_with_particles(&p, &s.scene, NULL, 0));
    particles_free(&p);
    s.scene.method = METHOD_PD;
    assert_refused(bodies_fill_with_particles(&p, &s.scene, NULL, 0),
                   "strewn.csv: body layer: 100 % of its particles have no neighbour");
    remove(name);
}

/* Checks that 2e5 particles of which each is a neighbour of all others, which need 960 GB, are refused. */
static void bonds_beyond_memory_are_refused(void **state)
{
    (void)state;
    struct setting s;
    struct particles p;
    char name[] = "dense.csv";
    if ((real)machine_memory_size() > 9e11) skip();
    setting_make(&s, SPACE_SOLID, (real[]){1, 1, 1});
    s.scene.method = METHOD_PD, s.scene.spacing = 1, s.scene.horizon = 30;
    s.body[0].file = name;
    write_grains(name, 3, &(struct grains){59, 1, 0, 0, 0.2, 0});
    assert_refused(bodies_fill_with_particles(&p, &s.scene, NULL, 0), "their bonds need about 1e+03 GB");
    remove(name);
}

/* Creates and enters a folder for the files of the tests. */
static int enter_folder(void **state)
{
    static char folder[] = "/tmp/cleave_fill_XXXXXX";
    *state = folder;
    return mkdtemp(folder) == NULL || chdir(folder) != 0;
}

static int leave_folder(void **state) { return chdir("/") != 0 || rmdir(*state) != 0; }

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(csv_lists_are_read),
        cmocka_unit_test(bodies_share_a_list),
        cmocka_unit_test(bad_lists_are_refused),
        cmocka_unit_test(hdf5_lists_are_read),
        cmocka_unit_test(hdf5_lists_have_units),
        cmocka_unit_test(hdf5_lists_are_whole),
        cmocka_unit_test(units_of_lists_are_told),
        cmocka_unit_test(other_bodies_are_neighbours_of_points),
        cmocka_unit_test(bonds_beyond_memory_are_refused),
    };
    omp_set_num_threads(2);
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
