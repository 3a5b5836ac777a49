/* Tests meshes in Exodus II files, which are written here in all three formats of netCDF: elements of every type,
 * blocks, side sets and node sets. Also checks the one-line messages for invalid files and about a thousand damaged
 * ones. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "tests/support/exodus_mesh.h"

#include "geometry/geometry.h"
#include "scene/particle_list.h"
#include "tests/support/folder.h"

enum { EDGES = 12, SIDES = 6 };

/* Element types of the manual of Exodus II: corners in a box of 2 x 3 x 5; edge: the corners of each edge, in the order
 * of the mid-edge nodes; side: the corners of each side. All indices count from 1. */
static const struct {
    const char *type;
    int corners, edges, sides;
    real volume, X[8][DIM_MAX];
    int edge[EDGES][2], side[SIDES][4];
} elements[] = {
    {"HEX",
     8,
     12,
     6,
     30,
     {{0, 0, 0}, {2, 0, 0}, {2, 3, 0}, {0, 3, 0}, {0, 0, 5}, {2, 0, 5}, {2, 3, 5}, {0, 3, 5}},
     {{1, 2}, {2, 3}, {3, 4}, {4, 1}, {1, 5}, {2, 6}, {3, 7}, {4, 8}, {5, 6}, {6, 7}, {7, 8}, {8, 5}},
     {{1, 2, 6, 5}, {2, 3, 7, 6}, {3, 4, 8, 7}, {1, 5, 8, 4}, {1, 4, 3, 2}, {5, 6, 7, 8}}},
    {"TETRA",
     4,
     6,
     4,
     5,
     {{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 5}},
     {{1, 2}, {2, 3}, {3, 1}, {1, 4}, {2, 4}, {3, 4}},
     {{1, 2, 4}, {2, 3, 4}, {1, 4, 3}, {1, 3, 2}}},
    {"WEDGE",
     6,
     9,
     5,
     15,
     {{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 5}, {2, 0, 5}, {0, 3, 5}},
     {{1, 2}, {2, 3}, {3, 1}, {1, 4}, {2, 5}, {3, 6}, {4, 5}, {5, 6}, {6, 4}},
     {{1, 2, 5, 4}, {2, 3, 6, 5}, {1, 4, 6, 3}, {1, 3, 2}, {4, 5, 6}}},
    {"PYRAMID",
     5,
     8,
     5,
     10,
     {{0, 0, 0}, {2, 0, 0}, {2, 3, 0}, {0, 3, 0}, {1, 1.5, 5}},
     {{1, 2}, {2, 3}, {3, 4}, {4, 1}, {1, 5}, {2, 5}, {3, 5}, {4, 5}},
     {{1, 2, 5}, {2, 3, 5}, {3, 4, 5}, {1, 5, 4}, {1, 4, 3, 2}}},
};

/* Nodes 21 to 27 of the 27-node hexahedron: 0: its centre, else the centre of the side with this number. */
static const int hex27[] = {0, 5, 6, 4, 2, 1, 3};

/* Writes a file with one element of type k and each of its sides as a side set. order: 1: corner nodes only, 2: also
 * mid-edge nodes, 3: also nodes at the centres of sides and of the element. */
static void write_element(int k, int order)
{
    real X[27][DIM_MAX] = {{0}};
    char type[16];
    int n = elements[k].corners, connect[27];
    memcpy(X, elements[k].X, sizeof elements[k].X);
    for (int e = 0; e < elements[k].edges && order > 1; e++, n++)
        for (int d = 0; d < DIM_MAX; d++)
            X[n][d] = 0.5 * (X[elements[k].edge[e][0] - 1][d] + X[elements[k].edge[e][1] - 1][d]);
    for (int c = 0; c < 7 && order > 2; c++, n++) {
        const int *corner = hex27[c] ? elements[k].side[hex27[c] - 1] : (const int[]){1, 2, 7, 8};
        for (int j = 0; j < 4; j++)
            for (int d = 0; d < DIM_MAX; d++) X[n][d] += 0.25 * X[corner[j] - 1][d];
    }
    for (int c = 0; c < n; c++) connect[c] = c + 1;
    snprintf(type, sizeof type, "%s%d", elements[k].type, n);
    const int file = exodus_begin("a.exo", NC_64BIT_OFFSET, 3, n, X[0], 1, elements[k].sides, 0);
    exodus_put_block(file, 1, type, 1, n, connect);
    for (int side = 1; side <= elements[k].sides; side++) exodus_put_sides(file, side, 1, (int[]){1}, &side);
    NC(nc_close(file));
}

/* Checks the volume of each element type, straight also where it has more nodes than corners. Checks that each side set
 * contains the corners of its side and is away from the other corners. Second-order elements with wrongly ordered nodes
 * would be curved, with another volume. */
static void each_type(void **state)
{
    (void)state;
    for (int k = 0; k < (int)COUNT_OF(elements); k++)
        for (int order = 1; order <= (k == 0 ? 3 : 2); order++) {
            struct geometry g;
            write_element(k, order);
            assert_ok(geometry_read(&g, "a.exo", 3, 1e-3, NAN));
            assert_close(g.whole.volume, 1e-9 * elements[k].volume, 1e-12);
            assert_int_equal(g.sets, 1 + elements[k].sides);
            for (int side = 0; side < elements[k].sides; side++) {
                const int *corner = elements[k].side[side];
                char name[32];
                snprintf(name, sizeof name, "surface_%d", side + 1);
                const struct geometry_set *set = geometry_find_set_by_name(&g, name);
                assert_true(set && set->hull.open);
                for (int c = 1; c <= elements[k].corners; c++) {
                    real X[DIM_MAX];
                    for (int d = 0; d < DIM_MAX; d++) X[d] = 1e-3 * elements[k].X[c - 1][d];
                    const bool on = c == corner[0] || c == corner[1] || c == corner[2] || c == corner[3];
                    const real distance = hull_signed_distance(&set->hull, X, NULL);
                    assert_true(on ? distance < 1e-15 : distance > 1e-3);
                }
            }
            geometry_free(&g);
        }
    unlink("a.exo");
}

/* Checks the surface of a hexahedron and a wedge that each share a non-planar side with three tetrahedra; tetrahedra
 * divide such a side by its diagonal farther from the origin. Only the outer surface remains, a box of 20 x 10 x 8. The
 * middle of the shared side of the hexahedron is at a depth of half the height, 4. */
static void twisted_sides(void **state)
{
    (void)state;
    const real X[12][DIM_MAX] = {{0, 0, 0}, {10, 0, 0}, {20, 0, 0}, {0, 10, 0}, {10, 10, 0}, {20, 10, 0},
                                 {0, 0, 8}, {12, 0, 8}, {20, 0, 8}, {0, 10, 8}, {10, 10, 8}, {20, 10, 8}};
    struct geometry g;
    const int file = exodus_begin("a.exo", 0, 3, 12, X[0], 3, 0, 0);
    exodus_put_block(file, 1, "HEX8", 1, 8, (int[]){1, 2, 5, 4, 7, 8, 11, 10});
    exodus_put_block(file, 2, "WEDGE", 1, 6, (int[]){2, 3, 6, 8, 9, 12});
    exodus_put_block(file, 3, "TETRA", 3, 4, (int[]){2, 6, 5, 8, 6, 5, 8, 12, 5, 8, 12, 11});
    NC(nc_close(file));
    assert_ok(geometry_read(&g, "a.exo", 3, 1e-3, NAN));
    assert_int_equal(g.whole.faces, 20);
    assert_close(g.whole.volume, 1e-9 * 20 * 10 * 8, 1e-12);
    for (int k = 0; k < 3; k++) /* along the diagonals of the shared side of the hexahedron, and between them */
        assert_close(hull_signed_distance(&g.whole, (real[]){1e-3 * (10 + 0.5 * k), 5e-3, 4e-3}, NULL), -4e-3, 1e-12);
    geometry_free(&g);
    unlink("a.exo");
}

/* Checks that an edge curved outwards adds 2/3 of its height times its length to the area, as a parabola does. */
static void curved_edges(void **state)
{
    (void)state;
    const real X[6][2] = {{0, 0}, {4, 0}, {0, 3}, {2, -0.3}, {2, 1.5}, {0, 1.5}};
    struct geometry g;
    const int file = exodus_begin("a.exo", 0, 2, 6, X[0], 1, 1, 0);
    exodus_put_block(file, 1, "tri6", 1, 6, (int[]){1, 2, 3, 4, 5, 6});
    exodus_put_sides(file, 1, 1, (int[]){1}, (int[]){1});
    NC(nc_close(file));
    assert_ok(geometry_read(&g, "a.exo", 2, 1e-3, 1e-7));
    assert_close(g.whole.volume, 1e-6 * (6 + 2. / 3 * 0.3 * 4), 1e-4); /* chords are 1e-4 mm off at most */
    assert_near(hull_signed_distance(&geometry_find_set_by_name(&g, "surface_1")->hull, (real[]){2e-3, -0.3e-3}, NULL),
                0, 1e-7);
    geometry_free(&g);
    unlink("a.exo");
}

/* Writes the file `path` in the format `mode` (flags of nc_create) with `dim` coordinates. It has two blocks,
 * rectangles of 2 x 3 and 4 x 3, the second without a name; side sets and node sets, of which one pair has the same
 * name; and a bar element, which the reader skips but counts. */
static void write_plate(const char *path, int mode, int dim)
{
    static const real flat[6][2] = {{0, 0}, {2, 0}, {6, 0}, {0, 3}, {2, 3}, {6, 3}};
    real X[18];
    for (int k = 0; k < 6; k++)
        for (int d = 0; d < dim; d++) X[k * dim + d] = d < 2 ? flat[k][d] : 7;
    const int file = exodus_begin(path, mode, dim, 6, X, 3, 2, 3);
    exodus_put_block(file, 1, "BAR2", 1, 2, (int[]){1, 2});
    exodus_put_block(file, 2, dim == 2 ? "QUAD4" : "SHELL4", 1, 4, (int[]){1, 2, 5, 4});
    exodus_put_block(file, 3, dim == 2 ? "QUAD" : "shell", 1, 4, (int[]){2, 3, 6, 5});
    exodus_put_names(file, "eb_names", "num_el_blk", 3, (const char *[]){"rod", "Glass", ""});
    int over;
    NC(nc_inq_dimid(file, "num_el_blk", &over));
    exodus_put_integers(file, "eb_prop1", 0, 1, &over, (int[]){1, 5, 20});
    exodus_put_sides(file, 1, 1, (int[]){3}, (int[]){dim == 2 ? 2 : 4}); /* x = 6 */
    exodus_put_sides(file, 2, 2, (int[]){2, 3}, (int[]){dim == 2 ? 3 : 5, dim == 2 ? 3 : 5});
    exodus_put_names(file, "ss_names", "num_side_sets", 2, (const char *[]){"grip", ""});
    exodus_put_nodes(file, 1, 2, (int[]){1, 4});
    exodus_put_nodes(file, 2, 1, (int[]){6});
    exodus_put_names(file, "ns_names", "num_node_sets", 3, (const char *[]){"grip", "corner", "nobody"});
    NC(nc_close(file));
}

/* Returns the distance of the point (x, y) from the set `name` of g, in the unit of the file. */
static real off(const struct geometry *g, const char *name, real x, real y)
{
    const struct geometry_set *set = geometry_find_set_by_name(g, name);
    assert_non_null(set);
    return hull_signed_distance(&set->hull, (real[]){1e-2 * x, 1e-2 * y, 0.07}, NULL) / 1e-2;
}

static void blocks_and_sets(void **state)
{
    (void)state;
    static const int modes[] = {0, NC_64BIT_OFFSET, NC_64BIT_DATA, NC_NETCDF4, NC_NETCDF4 | NC_CLASSIC_MODEL};
    for (size_t k = 0; k < 2 * COUNT_OF(modes); k++) {
        struct geometry g;
        write_plate("a.exo", modes[k / 2], k % 2 ? 3 : 2);
        assert_ok(geometry_read(&g, "a.exo", 2, 1e-2, NAN));
        assert_close(g.whole.volume, 18e-4, 1e-12);
        assert_int_equal(g.sets, 8);
        assert_close(geometry_find_set_by_name(&g, "glass")->hull.volume, 6e-4, 1e-12);
        assert_close(geometry_find_set_by_name(&g, "block_20")->hull.volume, 12e-4, 1e-12);
        assert_near(off(&g, "grip", 6, 1), 0, 1e-12); /* the sides: nodes of this name come after them */
        assert_close(off(&g, "grip", 1, 1), 5, 1e-12);
        assert_near(off(&g, "surface_2", 1, 3), 0, 1e-12);
        assert_near(off(&g, "surface_2", 5, 3), 0, 1e-12);
        assert_near(off(&g, "nodelist_1", 0, 2), 0, 1e-12);
        assert_close(off(&g, "nodelist_1", 1, 2), 1, 1e-12);
        assert_close(off(&g, "corner", 6, 1), 2, 1e-12);
        assert_non_null(strstr(geometry_find_set_by_name(&g, "rod")->fault, "is empty, or has only elements that are"));
        assert_non_null(geometry_find_set_by_name(&g, "nobody")->fault);
        geometry_free(&g);
    }
    unlink("a.exo");
}

/* Writes to `file` block number `number` of n spheres at the nodes node[n], with `attributes` values each from
 * attribute[n][attributes]. */
static void put_spheres(int file, int number, int n, const int *node, int attributes, const real *attribute)
{
    exodus_put_block(file, number, "SPHERE", n, 1, node);
    if (attributes == 0) return;
    int dim[2] = {0, exodus_dim(file, "num_att_in_blk", number, (size_t)attributes)};
    char over[32];
    snprintf(over, sizeof over, "num_el_in_blk%d", number);
    NC(nc_inq_dimid(file, over, &dim[0]));
    exodus_put_reals(file, "attrib", number, 2, dim, attribute);
}

/* Checks that blocks of spheres are read as a list of particles. The second of two unnamed attributes is the volume,
 * and each block is one material. */
static void spheres(void **state)
{
    (void)state;
    static const real X[3][2] = {{0, 0}, {2, 0}, {2, 3}};
    const struct particle_list_form mm = {.scale = 1e-3};
    struct particle_list l;
    for (int attributes = 0; attributes < 3; attributes += 2) {
        const int file = exodus_begin("a.e", 0, 2, 3, X[0], 2, 0, 0);
        put_spheres(file, 1, 1, (int[]){3}, attributes, (real[]){0.7, 5});
        put_spheres(file, 2, 2, (int[]){1, 2}, attributes, (real[]){0.7, 6, 0.7, 8});
        NC(nc_close(file));
        assert_ok(particle_list_read(&l, "a.e", &mm, 2));
        assert_int_equal(l.n, 3);
        assert_int_equal(l.head.volumes, attributes == 2);
        assert_exact(l.X[1][0], 3e-3);
        assert_exact(l.X[0][2], 2e-3);
        assert_true(l.material[0] == 0 && l.material[1] == 1 && l.material[2] == 1);
        for (int k = 0; k < 3 && l.volume; k++) assert_close(l.volume[k], (k ? 4 + 2 * k : 5) * 1e-9, 1e-15);
        particle_list_free(&l);
    }
    assert_refused(particle_list_read(&l, "a.e", &mm, 3), "a.e: has 2 coordinates, but the space of the scene has 3");
    write_plate("a.e", 0, 2);
    assert_refused(particle_list_read(&l, "a.e", &mm, 2), "block 1 has elements of type BAR2 with 2 nodes; a list of");
    int file = exodus_begin("a.e", 0, 2, 3, X[0], 2, 0, 0);
    put_spheres(file, 1, 1, (int[]){3}, 2, (real[]){0.7, 5});
    put_spheres(file, 2, 1, (int[]){1}, 0, NULL);
    NC(nc_close(file));
    assert_refused(particle_list_read(&l, "a.e", &mm, 2), "block 2 has no volumes, unlike the blocks before");
    file = exodus_begin("a.e", 0, 2, 3, X[0], 1, 0, 0);
    put_spheres(file, 1, 1, (int[]){3}, 2, (real[]){0.7, -5});
    NC(nc_close(file));
    assert_refused(particle_list_read(&l, "a.e", &mm, 2), "element 1: volume: -5e-09 must be larger than 0");
    file = exodus_begin("a.e", 0, 2, 3, X[0], 2, 0, 0); /* no element in block 1 */
    put_spheres(file, 2, 1, (int[]){2}, 2, (real[]){0.7, 6});
    NC(nc_close(file));
    assert_ok(particle_list_read(&l, "a.e", &mm, 2));
    assert_true(l.n == 1 && l.material[0] == 1 && l.head.volumes);
    particle_list_free(&l);
    unlink("a.e");
}

/* ---- refusals ---------------------------------------------------------------------------------------------------- */

/* Asserts that the file bad.e is refused with a message that contains the text `message`. */
static void refused(const char *message)
{
    struct geometry g;
    assert_refused(geometry_read(&g, "bad.e", 2, 1, NAN), message);
}

/* Creates the file bad.e with one square whose block is not written yet, and returns its netCDF id. side_sets,
 * node_sets: numbers of sets that the file declares. */
static int begin_bad(int side_sets, int node_sets)
{
    static const real X[4][2] = {{0, 0}, {2, 0}, {2, 3}, {0, 3}};
    return exodus_begin("bad.e", 0, 2, 4, X[0], 1, side_sets, node_sets);
}

static void write_bytes(const char *name, const void *bytes, size_t n)
{
    FILE *file = fopen(name, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, n, file), n);
    assert_int_equal(fclose(file), 0);
}

static void bad_files(void **state)
{
    (void)state;
    static const int square[] = {1, 2, 3, 4};
    write_bytes("bad.e", "solid cube\n", 11);
    refused("bad.e: does not begin like a netCDF file; give a file in the format Exodus II");
    write_bytes("bad.e", "CDF\1\0\0\0\0\0\0\0\12", 12);
    refused("bad.e: the header of this netCDF file is cut off or damaged near byte 12; write the file again");
    int file;
    NC(nc_create("bad.e", NC_CLOBBER, &file));
    exodus_dim(file, "x", 0, 3);
    NC(nc_close(file));
    refused("bad.e: this netCDF file has num_dim = 0 and num_nodes = 0, so it is not a mesh; give one in the format "
            "Exodus II");

    file = begin_bad(0, 0);
    exodus_put_block(file, 1, "QUAD4", 1, 4, (int[]){1, 2, 3, 5});
    NC(nc_close(file));
    refused("element 1 has node 5; give its nodes numbers from 1 to 4");
    file = begin_bad(0, 0);
    exodus_put_block(file, 1, "NSIDED", 1, 4, square);
    NC(nc_close(file));
    refused("elements of type NSIDED (polygons and polyhedra) are not read; write the mesh with triangles");
    file = begin_bad(0, 0);
    exodus_put_block(file, 1, "SPHERE", 4, 1, square);
    NC(nc_close(file));
    struct geometry g;
    assert_ok(geometry_read(&g, "bad.e", 2, 1, NAN)); /* particles: sets without a body */
    assert_int_equal(g.whole.dim, 0);
    assert_near(hull_signed_distance(&geometry_find_set_by_name(&g, "block_1")->hull, (real[]){2, 3.5}, NULL), 0.5,
                1e-12);
    geometry_free(&g);
    file = begin_bad(1, 0);
    exodus_put_block(file, 1, "QUAD4", 1, 4, square);
    exodus_put_sides(file, 1, 1, (int[]){1}, (int[]){5});
    NC(nc_close(file));
    refused("set surface_1 has side 5 of an element that has only 4 sides; correct the set");
    file = begin_bad(1, 0);
    exodus_put_block(file, 1, "QUAD4", 1, 4, square);
    exodus_put_sides(file, 1, 1, (int[]){2}, (int[]){1});
    NC(nc_close(file));
    refused("set surface_1 has element 2; give a number from 1 to 1");
    file = begin_bad(0, 1);
    exodus_put_block(file, 1, "QUAD4", 1, 4, square);
    exodus_put_nodes(file, 1, 1, (int[]){0});
    NC(nc_close(file));
    refused("set nodelist_1 has node 0; give a number from 1 to 4");
    unlink("bad.e");
}

/* Checks that a file that declares more nodes than it can contain is refused before memory is allocated for them. */
static void claims(void **state)
{
    (void)state;
    int file, id, nodes;
    for (int k = 0; k < 2; k++) {
        NC(nc_create("bad.e", NC_CLOBBER | (k ? NC_NETCDF4 : 0), &file));
        exodus_dim(file, "num_dim", 0, 1);
        nodes = exodus_dim(file, "num_nodes", 0, 2000000000);
        nc_redef(file);
        NC(nc_set_fill(file, NC_NOFILL, &id));
        NC(nc_def_var(file, "coordx", NC_FLOAT, 1, &nodes, &id));
        nc_enddef(file);
        nc_close(file);
        assert_int_equal(truncate("bad.e", k ? 8000 : 200), 0);
        struct geometry g;
        assert_int_equal(geometry_read(&g, "bad.e", 2, 1, NAN), REFUSED);
    }
    unlink("bad.e");
}

/* Advances *seed, a linear congruential sequence (Knuth's MMIX), and returns its upper bits. */
static uint64_t random_next(uint64_t *seed)
{
    *seed = *seed * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return *seed >> 33;
}

/* Checks that each damaged file is read as some mesh or refused in one line. HDF5 reads files in netCDF-4; a crash of
 * HDF5 over a damaged file ends the program with a one-line message (crash_message.c). */
static void damaged(void **state)
{
    (void)state;
    static char text[1 << 16], copy[1 << 16];
    uint64_t seed = 25;
    write_plate("a.exo", NC_64BIT_OFFSET, 2);
    FILE *from = fopen("a.exo", "rb");
    const size_t length = fread(text, 1, sizeof text, from);
    fclose(from);
    assert_in_range(length, 500, sizeof text - 1);
    for (int round = 0; round < 6000; round++) {
        size_t size = length;
        memcpy(copy, text, size);
        for (uint64_t k = random_next(&seed) % 4; k < 4; k++) {
            const size_t at = random_next(&seed) % size, other = random_next(&seed) % size;
            if (round % 2)
                copy[at] = (char)random_next(&seed);
            else
                memmove(copy + at, copy + other, (size - (at > other ? at : other)) % 64);
        }
        if (round % 5 == 0) size = 1 + random_next(&seed) % size;
        write_bytes("bad.e", copy, size);
        struct geometry g;
        if (geometry_read(&g, "bad.e", 2, 1, NAN) != OK) {
            assert_true(status_message()[0] && !strchr(status_message(), '\n'));
            continue;
        }
        assert_true(g.whole.dim == 0 || g.whole.volume > 0);
        assert_true(g.whole.dim == 0 || hull_signed_distance(&g.whole, (real[]){0, 0, 0}, NULL) < 1e31);
        geometry_free(&g);
    }
    unlink("a.exo"), unlink("bad.e");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_type),       cmocka_unit_test(twisted_sides), cmocka_unit_test(curved_edges),
        cmocka_unit_test(blocks_and_sets), cmocka_unit_test(spheres),       cmocka_unit_test(bad_files),
        cmocka_unit_test(claims),          cmocka_unit_test(damaged),
    };
    return cmocka_run_group_tests(tests, folder_enter, folder_leave);
}
