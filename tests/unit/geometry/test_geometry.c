/* Tests reading of geometry files written here: STL, Gmsh 2.2 and 4.1, Abaqus, as text and binary. Also checks the
 * one-line messages for invalid files and some thousand damaged files. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "tests/support/near.h"

#include "base/memory.h"
#include "geometry/geometry.h"

static void write_file(const char *name, const void *bytes, size_t n)
{
    FILE *file = fopen(name, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, n, file), n);
    assert_int_equal(fclose(file), 0);
}

static void write_words(const char *name, const char *text) { write_file(name, text, strlen(text)); }

/* Returns the contents of the file `name`, to be freed with memory_free. *length: receives their length in bytes. */
static char *file_text(const char *name, size_t *length)
{
    FILE *file = fopen(name, "rb");
    assert_non_null(file);
    char *text = memory_new("test", 1 << 20, 1);
    *length = fread(text, 1, (1 << 20) - 1, file);
    fclose(file);
    return text;
}

static void refused(const char *name, int dim, const char *message)
{
    struct geometry g;
    assert_refused(geometry_read(&g, name, dim, 1, NAN), message);
}

/* ---- STL --------------------------------------------------------------------------------------------------------- */

/* Twelve triangles of a cube, by corner indices; bits 0, 1 and 2 of an index are the coordinates x, y and z. */
static const signed char cube_face[12][3] = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                                             {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};

static void write_stl_words(const char *name, int triangles, const char *last)
{
    FILE *file = fopen(name, "w");
    fputs("solid a cube of two\n", file);
    for (int k = 0; k < triangles; k++) {
        fputs("facet normal 0 0 0\n outer loop\n", file);
        for (int c = 0; c < 3; c++) {
            const int at = cube_face[k][c];
            fprintf(file, "  vertex %d %d %de0\n", 2 * (at & 1), at & 2, at >> 1 & 2);
        }
        fputs(" endloop\nendfacet\n", file);
    }
    fputs(last, file);
    fclose(file);
}

static size_t stl_bytes(unsigned char *bytes, uint32_t claimed)
{
    memset(bytes, 0, 84 + 12 * 50);
    memcpy(bytes, "solid of bytes", 14);
    memcpy(bytes + 80, &claimed, 4);
    for (int k = 0; k < 12; k++)
        for (int c = 0; c < 3; c++)
            for (int d = 0; d < 3; d++) {
                const float x = 2 * (cube_face[k][c] >> d & 1);
                memcpy(bytes + 84 + 50 * k + 12 + 4 * (3 * c + d), &x, 4);
            }
    return 84 + 12 * 50;
}

static void stl_of_both_forms(void **state)
{
    (void)state;
    unsigned char bytes[84 + 12 * 50];
    struct geometry g;
    write_stl_words("a.stl", 12, "endsolid a cube\n");
    assert_ok(geometry_read(&g, "a.stl", 3, 1e-3, NAN));
    assert_close(g.whole.volume, 8e-9, 1e-12);
    assert_int_equal(g.whole.open_edges, 0);
    assert_int_equal(g.whole.corners, 8);
    geometry_free(&g);
    write_file("b.stl", bytes, stl_bytes(bytes, 12));
    assert_ok(geometry_read(&g, "b.stl", 3, 1, NAN));
    assert_close(g.whole.volume, 8, 1e-12);
    assert_close(hull_signed_distance(&g.whole, (real[]){1, 1, 1.5}, NULL), -0.5, 1e-12);
    geometry_free(&g);
}

static void bad_stl(void **state)
{
    (void)state;
    unsigned char bytes[84 + 12 * 50];
    const float none = NAN;
    refused("none.stl", 3, "none.stl: No such file or directory");
    write_words("c.stl", "");
    refused("c.stl", 3, "c.stl: empty");
    write_words("c.stl", "PK\3\4");
    refused("c.stl", 3, "neither begins with `solid`");
    write_stl_words("c.stl", 12, "");
    refused("c.stl", 3, "it is cut off");
    write_stl_words("c.stl", 0, "endsolid");
    refused("c.stl", 3, "contains no triangle");
    write_stl_words("c.stl", 2, "vertex 1 2 nan\n");
    refused("c.stl", 3, "c.stl:16: nan is not a coordinate");
    write_stl_words("c.stl", 2, "vertex 1 2 3\nendfacet\nendsolid\n");
    refused("c.stl", 3, "a facet has 1 corners");
    write_stl_words("c.stl", 6, "endsolid");
    refused("c.stl", 3, "open or turned inside out at 8 edges");
    write_file("c.stl", bytes, stl_bytes(bytes, 13));
    refused("c.stl", 3, "need 734; it is cut off"); /* begins with the word solid, but is binary */
    bytes[0] = 'x';
    write_file("c.stl", bytes, sizeof bytes);
    refused("c.stl", 3, "it has 684 bytes, but the 13 triangles that its header gives need 734");
    stl_bytes(bytes, 12);
    memcpy(bytes + 84 + 50 * 3 + 16, &none, 4);
    write_file("c.stl", bytes, sizeof bytes);
    refused("c.stl", 3, "c.stl: triangle 3: a coordinate is infinite or not a number");
    write_stl_words("c.stl", 12, "endsolid");
    refused("c.stl", 2, "not in one plane z = const");
}

/* ---- Gmsh -------------------------------------------------------------------------------------------------------- */

static const char msh2[] = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n3 1 \"left\"\n3 2 \"right\"\n"
                           "2 7 \"grip\"\n$EndPhysicalNames\n$Nodes\n12\n1 0 0 0\n2 1 0 0\n3 2 0 0\n4 0 1 0\n5 1 1 0\n"
                           "6 2 1 0\n101 0 0 1\n102 1 0 1\n103 2 0 1\n104 0 1 1\n105 1 1 1\n106 2 1 1\n$EndNodes\n"
                           "$Elements\n4\n1 3 2 7 1 1 4 104 101\n2 5 2 1 1 1 2 5 4 101 102 105 104\n"
                           "3 6 2 2 2 2 3 6 102 103 106\n4 6 2 2 2 2 6 5 102 106 105\n$EndElements\n";
static const char msh4[] = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n2 1 \"plate\"\n1 5 \"edge\"\n"
                           "$EndPhysicalNames\n$Comments\nwhatever\n$EndComments\n$Entities\n1 1 1 0\n1 0 0 0 0\n"
                           "3 0 0 0 1 0 0 1 5 2 1 -2\n9 0 0 0 1 1 0 1 1 1 3\n$EndEntities\n$Nodes\n2 5 1 5\n"
                           "0 1 0 1\n1\n0 0 0\n2 9 1 4\n2\n3\n4\n5\n1 0 0 .1 .1\n1 1 0 .1 .1\n0 1 0 .1 .1\n"
                           "2 .5 0 .1 .1\n$EndNodes\n$Elements\n3 3 1 3\n1 3 1 1\n1 1 2\n2 9 3 1\n2 1 2 3 4\n"
                           "2 9 2 1\n3 2 5 3\n$EndElements\n";

static void check_msh2(const char *name)
{
    struct geometry g;
    assert_ok(geometry_read(&g, name, 3, 1, NAN));
    assert_close(g.whole.volume, 2, 1e-12);
    assert_int_equal(g.whole.open_edges, 0);
    assert_int_equal(g.whole.shells, 1);
    assert_int_equal(g.sets, 3);
    assert_close(geometry_find_set_by_name(&g, "Left")->hull.volume, 1, 1e-12);
    assert_close(geometry_find_set_by_name(&g, "right")->hull.volume, 1, 1e-12);
    assert_true(geometry_find_set_by_name(&g, "grip")->hull.open);
    assert_close(hull_signed_distance(&geometry_find_set_by_name(&g, "grip")->hull, (real[]){0.25, 0.5, 0.7}, NULL),
                 0.25, 1e-12);
    assert_null(geometry_find_set_by_name(&g, "leg"));
    geometry_free(&g);
}

/* Writes the file `name` in Gmsh's format 2.2 with binary numbers; counts of nodes and elements are text. */
static void write_msh2_bytes(const char *name)
{
    static const real at[12][3] = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0},
                                   {0, 0, 1}, {1, 0, 1}, {2, 0, 1}, {0, 1, 1}, {1, 1, 1}, {2, 1, 1}};
    static const int32_t quad[] = {3, 1, 2, 1, 7, 1, 1, 4, 10, 7}, hex[] = {5, 1, 2, 2, 1, 1, 1, 2, 5, 4, 7, 8, 11, 10},
                         prism[] = {6, 2, 2, 3, 2, 2, 2, 3, 6, 8, 9, 12, 4, 2, 2, 2, 6, 5, 8, 12, 11};
    const int32_t one = 1;
    FILE *file = fopen(name, "wb");
    fputs("$MeshFormat\n2.2 1 8\n", file);
    fwrite(&one, 4, 1, file);
    fputs("\n$EndMeshFormat\n$PhysicalNames\n3\n3 1 \"left\"\n3 2 \"right\"\n2 7 "
          "\"grip\"\n$EndPhysicalNames\n$Nodes\n12\n",
          file);
    for (int32_t k = 1; k <= 12; k++) fwrite(&k, 4, 1, file), fwrite(at[k - 1], 8, 3, file);
    fputs("\n$EndNodes\n$Elements\n4\n", file);
    fwrite(quad, sizeof quad, 1, file), fwrite(hex, sizeof hex, 1, file), fwrite(prism, sizeof prism, 1, file);
    fputs("\n$EndElements\n", file);
    fclose(file);
}

static void check_msh4(const char *name)
{
    struct geometry g;
    assert_ok(geometry_read(&g, name, 2, 1e-3, NAN));
    assert_close(g.whole.volume, 1.5e-6, 1e-12);
    assert_int_equal(g.whole.faces, 5);
    assert_int_equal(g.sets, 2);
    assert_true(geometry_find_set_by_name(&g, "plate") && geometry_find_set_by_name(&g, "edge"));
    assert_close(geometry_find_set_by_name(&g, "plate")->hull.volume, 1.5e-6, 1e-12);
    assert_close(hull_signed_distance(&geometry_find_set_by_name(&g, "edge")->hull, (real[]){0.5e-3, 2e-3}, NULL), 2e-3,
                 1e-12);
    geometry_free(&g);
}

/* Writes value[n] to `file` as 8-byte integers. */
static void write_sizes(FILE *file, int n, const int64_t *value) { fwrite(value, 8, (size_t)n, file); }
static void write_ints(FILE *file, int n, const int32_t *value) { fwrite(value, 4, (size_t)n, file); }
static void write_reals(FILE *file, int n, const real *value) { fwrite(value, 8, (size_t)n, file); }
#define SIZES(...) write_sizes(file, COUNT_OF(((int64_t[]){__VA_ARGS__})), (int64_t[]){__VA_ARGS__})
#define INTS(...) write_ints(file, COUNT_OF(((int32_t[]){__VA_ARGS__})), (int32_t[]){__VA_ARGS__})
#define REALS(...) write_reals(file, COUNT_OF(((real[]){__VA_ARGS__})), (real[]){__VA_ARGS__})

static void write_msh4_bytes(const char *name)
{
    FILE *file = fopen(name, "wb");
    fputs("$MeshFormat\n4.1 1 8\n", file);
    INTS(1);
    fputs("\n$EndMeshFormat\n$PhysicalNames\n2\n2 1 \"plate\"\n1 5 \"edge\"\n$EndPhysicalNames\n$Entities\n", file);
    SIZES(1, 1, 1, 0);
    INTS(1), REALS(0, 0, 0), SIZES(0);
    INTS(3), REALS(0, 0, 0, 1, 0, 0), SIZES(1), INTS(5), SIZES(2), INTS(1, -2);
    INTS(9), REALS(0, 0, 0, 1, 1, 0), SIZES(1), INTS(1), SIZES(1), INTS(3);
    fputs("\n$EndEntities\n$Nodes\n", file);
    SIZES(2, 5, 1, 5);
    INTS(0, 1, 0), SIZES(1, 1), REALS(0, 0, 0);
    INTS(2, 9, 1), SIZES(4, 2, 3, 4, 5);
    REALS(1, 0, 0, .1, .1, 1, 1, 0, .1, .1, 0, 1, 0, .1, .1, 2, .5, 0, .1, .1);
    fputs("\n$EndNodes\n$Elements\n", file);
    SIZES(3, 3, 1, 3);
    INTS(1, 3, 1), SIZES(1, 1, 1, 2);
    INTS(2, 9, 3), SIZES(1, 2, 1, 2, 3, 4);
    INTS(2, 9, 2), SIZES(1, 3, 2, 5, 3);
    fputs("\n$EndElements\n", file);
    fclose(file);
}

static void gmsh_of_both_versions(void **state)
{
    (void)state;
    write_words("a.msh", msh2);
    check_msh2("a.msh");
    write_msh2_bytes("b.msh");
    check_msh2("b.msh");
    write_words("c.msh", msh4);
    check_msh4("c.msh");
    write_msh4_bytes("d.msh");
    check_msh4("d.msh");
}

/* Writes to the file `name` the mesh `text`, with the part `from` replaced by `what`. */
static void write_changed(const char *name, const char *text, const char *from, const char *what)
{
    char changed[4096];
    const char *at = strstr(text, from);
    assert_non_null(at);
    snprintf(changed, sizeof changed, "%.*s%s%s", (int)(at - text), text, what, at + strlen(from));
    write_words(name, changed);
}

/* Checks that in Gmsh 4.1 a curve and a surface with one tag belong to the physical groups of their own dimension. */
static void gmsh_tags_by_dimension(void **state)
{
    size_t length;
    (void)state;
    write_changed("e.msh", msh4, "3 0 0 0 1 0 0 1 5 2 1 -2", "9 0 0 0 1 0 0 1 5 2 1 -2");
    char *text = file_text("e.msh", &length);
    write_changed("e.msh", text, "1 3 1 1\n1 1 2", "1 9 1 1\n1 1 2");
    memory_free(text);
    check_msh4("e.msh");
    remove("e.msh");
}

/* Checks Gmsh 4.1: a negative physical tag is an orientation, and groups of different dimension may share a tag. */
static void gmsh_groups_of_entities(void **state)
{
    size_t length;
    (void)state;
    write_changed("f.msh", msh4, "1 5 2 1 -2", "1 -5 2 1 -2");
    check_msh4("f.msh");
    write_changed("f.msh", msh4, "1 5 2 1 -2", "1 1 2 1 -2");
    char *text = file_text("f.msh", &length);
    write_changed("f.msh", text, "1 5 \"edge\"", "1 1 \"edge\"");
    memory_free(text);
    check_msh4("f.msh");
    remove("f.msh");
}

static void bad_gmsh(void **state)
{
    (void)state;
    static const struct {
        const char *from, *to, *message;
    } bad[] = {{"2.2 0", "4.0 0", ":2: Gmsh's file format 4.0 is not supported; save the mesh as 4.1"},
               {"$MeshFormat", "Meshformat", "does not begin with $MeshFormat"},
               {"$Nodes\n12", "$Nodes\n12000000000", "12000000000 nodes, more than the rest of the file"},
               {"$Nodes\n12", "$Nodes\n-1", "the header gives -1 nodes, more"},
               {"2 1 0 0\n", "2 1 nan 0\n", ":13: nan is not a coordinate"},
               {"2 1 0 0\n", "1 1 0 0\n", "node 1 is given twice"},
               {"2 3 6 102", "2 3 66 102", ":29: an element has node 66, but $Nodes does not define it"},
               {"4 6 2 2 2", "4 77 2 2 2", "type 77"},
               {"$Nodes", "$Knots", "ends without $Nodes"},
               {"\"grip\"", "grip", "is not in quotes; write it in quotes"},
               {"3 6 2 2 2 2 3 6 102 103 106\n4 6 2 2 2 2 6 5 102 106 105", "", "$EndElements is no"}};
    for (size_t k = 0; k < COUNT_OF(bad); k++) {
        write_changed("bad.msh", msh2, bad[k].from, bad[k].to);
        refused("bad.msh", 3, bad[k].message);
    }
    write_words("bad.msh", msh2);
    refused("bad.msh", 2, "the mesh has volume elements");
    write_changed("bad.msh", msh4, "1 1 0 .1", "1 1 3 .1");
    refused("bad.msh", 2, "not in one plane z = const");
    write_changed("bad.msh", msh4, "$Entities", "$PartitionedEntities");
    refused("bad.msh", 2, "the mesh has partitions");
}

/* ---- Abaqus ------------------------------------------------------------------------------------------------------ */

static const char flat[] =
    "*HEADING\nanything, 1, 2\n** a comment\n*node, nset=all\n1, 0., 0.\n2, 1., 0.\n 3, 2., 0\n"
    "4, 0., 1.\n5, 1., 1.\n6, 2., 1.D0\n*Element, type=CPS4R, elset = Two\n10, 1, 2, 5, 4\n11, 2,\n"
    " 3, 6, 5\n*NSET, NSET=left\n1, 4\n*NSET, NSET=Both\n1\n*Elset, elset=RIGHT, generate\n11, 11, 1\n"
    "*elset, elset=both\nTwo,\n*Material, name=steel\n*Elastic\n210e9, .3\n"
    "*Element, type=T3D2, elset=rod\n90, 1, 4\n*Step\n*Static\n0.1, 1.\n*Include, input=loads.inc\n*End Step\n";
static const char parts[] =
    "*Part, name=A\n*Node\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n*Element, type=C3D4\n"
    "1, 1, 2, 3, 4\n*Nset, nset=tip\n4\n*End Part\n*Part, name=B\n*Node\n1, 0, 0, 0\n2, 0, 1, 0\n"
    "3, 1, 0, 0\n4, 0, 0, -1\n*Element, type=C3D4H, elset=low\n1, 1, 2, 3, 4\n*End Part\n"
    "*Assembly, name=C\n*Instance, name=A-1, part=A\n*End Instance\n"
    "*Instance, name=B-1, part=B\n5, 0, 0\n5, 0, 0, 5, 0, 1, 90\n*End Instance\n"
    "*Node\n1, 9, 9, 9\n*Nset, nset=foot, instance=B-1\n4\n*End Assembly\n";

static void abaqus_decks(void **state)
{
    (void)state;
    struct geometry g;
    write_words("a.inp", flat);
    assert_ok(geometry_read(&g, "a.inp", 2, 1, NAN));
    assert_close(g.whole.volume, 2, 1e-12);
    assert_int_equal(g.whole.faces, 6);
    assert_close(geometry_find_set_by_name(&g, "right")->hull.volume, 1, 1e-12);
    assert_close(geometry_find_set_by_name(&g, "both")->hull.volume, 2, 1e-12);
    const struct geometry_set *e[] = {geometry_find_set_by_name(&g, "left"), geometry_find_set_by_name(&g, "rod")};
    for (int k = 0; k < 2; k++) assert_close(hull_signed_distance(&e[k]->hull, (real[]){0.3, 0.5}, NULL), 0.3, 1e-12);
    geometry_free(&g);
    write_words("nodes.dat", "** a comment\n1, 0., 0.\n2, 1., 0.\n3, 2., 0\n4, 0., 1.\n5, 1., 1.\n6, 2., 1.D0\n");
    write_words("whole.inc", "*Node, input=nodes.dat\n*Element, type=B31, input=nodes.dat\n"
                             "*Element, type=CPS4R\n10, 1, 2, 5, 4\n11, 2, 3, 6, 5\n");
    write_words("d.inp", "*Heading\n*Include, input=whole.inc\n");
    assert_ok(geometry_read(&g, "d.inp", 2, 1, NAN));
    geometry_free(&g);
    write_words("b.inp", parts);
    assert_ok(geometry_read(&g, "b.inp", 3, 1, NAN));
    assert_close(g.whole.volume, 1. / 3, 1e-12);
    assert_int_equal(g.whole.shells, 2);
    /* B is rotated by a right angle about a line through (5, 0): its corner 3 at (1, 0) moves to (5, 1). */
    assert_close(g.whole.node[0].high[0], 5, 1e-12);
    assert_close(g.whole.node[0].high[1], 1, 1e-12);
    assert_close(geometry_find_set_by_name(&g, "low")->hull.volume, 1. / 6, 1e-12);
    assert_near(hull_signed_distance(&geometry_find_set_by_name(&g, "low")->hull, (real[]){5, 1, 0}, NULL), 0, 1e-12);
    assert_close(hull_signed_distance(&geometry_find_set_by_name(&g, "low")->hull, (real[]){5, 1.5, 0}, NULL), 0.5,
                 1e-12);
    assert_close(hull_signed_distance(&geometry_find_set_by_name(&g, "foot")->hull, (real[]){5, 0, 1}, NULL), 2, 1e-12);
    assert_close(hull_signed_distance(&geometry_find_set_by_name(&g, "tip")->hull, (real[]){0, 0, 0}, NULL), 1, 1e-12);
    geometry_free(&g);
}

/* Checks sets of squares in a row given by first, last and increment (GENERATE), where last need not be hit. */
static void abaqus_generates(void **state)
{
    (void)state;
    enum { SQUARES = 7 };
    struct geometry g;
    FILE *file = fopen("c.inp", "w");
    assert_non_null(file);
    fputs("*Node\n", file);
    for (int k = 0; k <= SQUARES; k++) fprintf(file, "%d, %d, 0\n%d, %d, 1\n", 2 * k + 1, k, 2 * k + 2, k);
    fputs("*Element, type=CPE4\n", file);
    for (int k = 0; k < SQUARES; k++)
        fprintf(file, "%d, %d, %d, %d, %d\n", 10 * (k + 1), 2 * k + 1, 2 * k + 3, 2 * k + 4, 2 * k + 2);
    fputs("*Elset, elset=third, generate\n10, 65, 30\n*Elset, elset=all, generate\n10, 30, 10\n40, 70, 10\n"
          "*Nset, nset=lower, generate\n5, 11, 2\n*Nset, nset=plain, generate\n3, 4\n",
          file);
    assert_int_equal(fclose(file), 0);
    assert_ok(geometry_read(&g, "c.inp", 2, 1, NAN));
    assert_close(geometry_find_set_by_name(&g, "third")->hull.volume, 2, 1e-12); /* 10 and 40 */
    assert_close(geometry_find_set_by_name(&g, "all")->hull.volume, 7, 1e-12);
    assert_close(hull_signed_distance(&geometry_find_set_by_name(&g, "third")->hull, (real[]){2.2, 0.5}, NULL), 0.8,
                 1e-12);
    /* Nodes 5, 7, 9, 11 at y = 0, x = 2 to 5; none of these is closer to (3, 1) than 1. */
    assert_close(hull_signed_distance(&geometry_find_set_by_name(&g, "lower")->hull, (real[]){3, 1}, NULL), 1, 1e-12);
    assert_close(hull_signed_distance(&geometry_find_set_by_name(&g, "lower")->hull, (real[]){6.5, 0}, NULL), 1.5,
                 1e-12);
    assert_close(hull_signed_distance(&geometry_find_set_by_name(&g, "plain")->hull, (real[]){1, 0.9}, NULL), 0.1,
                 1e-12);
    geometry_free(&g);
}

/* Checks the volume of each type of solid element, and of one with reversed corners, against closed forms. Also checks
 * the signed distances of one position outside and one inside. */
static void abaqus_solids(void **state)
{
    (void)state;
    static const struct {
        const char *type, *corners;
        real volume, outside;
    } solid[] = {{"C3D5", "1, 2, 3, 4, 9", 2. * 3 * 1.7 / 3, 0.6}, /* a pyramid with its base below */
                 {"C3D5", "1, 4, 3, 2, 9", 2. * 3 * 1.7 / 3, 0.6},
                 {"C3D6", "1, 2, 3, 5, 6, 7", 3 * 2.3, 0.6}, /* half of the brick */
                 {"C3D6", "5, 6, 7, 1, 2, 3", 3 * 2.3, 0.6},
                 {"C3D8R", "1, 2, 3, 4, 5, 6, 7, 8", 6 * 2.3, 0.6},
                 {"C3D8", "5, 6, 7, 8, 1, 2, 3, 4", 6 * 2.3, 0.6}};
    for (size_t k = 0; k < COUNT_OF(solid); k++) {
        struct geometry g;
        char text[512];
        snprintf(text, sizeof text,
                 "*Node\n1, 0, 0, 0\n2, 2, 0, 0\n3, 2, 3, 0\n4, 0, 3, 0\n5, 0, 0, 2.3\n6, 2, 0, 2.3\n7, 2, 3, 2.3\n"
                 "8, 0, 3, 2.3\n9, 0.7, 1.1, 1.7\n*Element, type=%s\n7, %s\n",
                 solid[k].type, solid[k].corners);
        write_words("solid.inp", text);
        assert_ok(geometry_read(&g, "solid.inp", 3, 1, 1e-3));
        assert_close(g.whole.volume, solid[k].volume, 1e-12);
        assert_close(hull_signed_distance(&g.whole, (real[]){1.5, 0.9, -0.6}, NULL), solid[k].outside, 1e-12);
        assert_close(hull_signed_distance(&g.whole, (real[]){1.5, 0.9, 0.1}, NULL), -0.1, 1e-12);
        geometry_free(&g);
    }
}

static void bad_abaqus(void **state)
{
    (void)state;
    static const struct {
        const char *from, *to, *message;
    } bad[] = {{"2, 1., 0.", "2, 1.x, 0.", ":6: 1.x is not a number; correct this entry"},
               {"2, 1., 0.", "-2, 1., 0.", ":6: -2 is not the number of a node"},
               {"2, 1., 0.", "1, 1., 0.", "node 1 is given twice"},
               {"10, 1, 2, 5, 4", "10, 1, 2, 5, 44", "element 10 has node 44"},
               {" 3, 6, 5\n", "", "an element should have the 4 nodes of its type, but lists only 1"},
               {"CPS4R", "B31", "no elements that can fill a body, but others such as B31"},
               {"*NSET, NSET=left", "*NGEN", "*NGEN is not supported; write a deck that lists all nodes"},
               {"*NSET, NSET=left", "*NSET, NSET=left, INPUT=x", ":15: *NSET: x: "},
               {"*node, nset=all", "*node, input=d.inp", "d.inp:1: a keyword is among the data lines of *NODE"},
               {"*node, nset=all", "*Include, input=nodes.inc", ":4: *INCLUDE: nodes.inc: "},
               {"*node, nset=all", "*Include, input=bad.inp", "files are nested by *INCLUDE"},
               {"CPS4R", "CPS4Q", "element type CPS4Q is unknown"},
               {"*NSET, NSET=left", "*NSET", "a set has no name"},
               {"*node, nset=all", "*node, system=C", ":4: coordinates of the system C"},
               {"11, 11, 1\n", "1, 999999999, 1\n", "sets list more nodes or elements than the file has"}};
    for (size_t k = 0; k < COUNT_OF(bad); k++) {
        write_changed("bad.inp", flat, bad[k].from, bad[k].to);
        refused("bad.inp", 2, bad[k].message);
    }
    write_changed("bad.inp", parts, "part=B", "part=A");
    refused("bad.inp", 3, "part A is in the assembly twice");
    write_words("bad.inp", "PK\3\4\n, , ,\n");
    refused("bad.inp", 3, "no *NODE");
    refused("bad.obj", 3, "is not a shape file; give one that ends in .stl, .msh, .inp or .exo");
}

/* ---- damaged files ----------------------------------------------------------------------------------------------- */

static uint64_t random_next(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return *seed >> 33;
}

/* Checks that files with bytes changed, removed or duplicated are read as a mesh of positive volume or refused. */
static void damaged(void **state)
{
    (void)state;
    static const char *const names[] = {"a.stl", "b.stl", "a.msh", "b.msh", "c.msh", "d.msh", "a.inp", "b.inp"};
    uint64_t seed = 25;
    for (size_t n = 0; n < COUNT_OF(names); n++) {
        size_t length;
        char *text = file_text(names[n], &length), *copy = memory_new("test", 1 << 20, 1), name[16];
        snprintf(name, sizeof name, "x%s", strchr(names[n], '.'));
        for (int round = 0; round < 400; round++) {
            size_t size = length;
            memcpy(copy, text, length);
            for (uint64_t k = random_next(&seed) % 4; k < 4; k++) {
                const size_t at = random_next(&seed) % size, from = random_next(&seed) % size;
                if (round % 3 == 0)
                    copy[at] = "0123456789-,\n* e"[random_next(&seed) % 16];
                else if (round % 3 == 1)
                    copy[at] = (char)random_next(&seed);
                else
                    memmove(copy + at, copy + from, size - (at > from ? at : from));
            }
            if (round % 5 == 0) size = 1 + random_next(&seed) % size;
            write_file(name, copy, size);
            for (int dim = 2; dim <= 3; dim++) {
                struct geometry g;
                if (geometry_read(&g, name, dim, 1, NAN) != OK) continue;
                assert_true(g.whole.volume > 0 && hull_signed_distance(&g.whole, (real[]){0, 0, 0}, NULL) < 1e31);
                geometry_free(&g);
            }
        }
        unlink(name);
        memory_free(text), memory_free(copy);
    }
}

/* Folder for the files of these tests. */
static char folder[] = "/tmp/cleave_geometry_XXXXXX";
static int enter_folder(void **state)
{
    (void)state;
    return mkdtemp(folder) == NULL || chdir(folder) != 0;
}

static int leave_folder(void **state)
{
    static const char *const names[] = {"a.stl",     "b.stl",     "c.stl",   "a.msh",    "b.msh", "c.msh",
                                        "d.msh",     "bad.msh",   "a.inp",   "b.inp",    "c.inp", "d.inp",
                                        "whole.inc", "solid.inp", "bad.inp", "nodes.dat"};
    (void)state;
    for (size_t k = 0; k < COUNT_OF(names); k++) unlink(names[k]);
    return chdir("/") != 0 || rmdir(folder) != 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(stl_of_both_forms),
        cmocka_unit_test(bad_stl),
        cmocka_unit_test(gmsh_of_both_versions),
        cmocka_unit_test(gmsh_tags_by_dimension),
        cmocka_unit_test(gmsh_groups_of_entities),
        cmocka_unit_test(bad_gmsh),
        cmocka_unit_test(abaqus_decks),
        cmocka_unit_test(abaqus_generates),
        cmocka_unit_test(abaqus_solids),
        cmocka_unit_test(bad_abaqus),
        cmocka_unit_test(damaged),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
