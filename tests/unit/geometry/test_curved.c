/* Tests curved second-order elements from Gmsh and Abaqus files. Elements of every type are written in the node order
 * of both manuals, with nodes mapped by a quadratic function of determinant 1. The volume and the position of their
 * sides are therefore known exactly. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "tests/support/near.h"

#include "geometry/geometry.h"

enum { NODES_MOST = 27 };

/* Maps the reference position at[3] to X[3] by a quadratic shear with determinant 1, which preserves the volume of the
 * reference element. */
static void curve_map(const real *at, real *X)
{
    X[0] = at[0] + 0.3 * at[1] * at[1], X[1] = at[1] + 0.2 * at[2] * at[2], X[2] = at[2];
}

/* Corner positions of the reference elements, indexed by TET, PYRAMID, PRISM, HEX. */
static const real corner_of[][8][3] = {
    {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
    {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}},
    {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}},
    {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};
enum { TET, PYRAMID, PRISM, HEX };

/* Element types. `between` names the corners (counted from 1) whose mean position each mid-side node has, in the order
 * of the manuals of Gmsh ("Node ordering") and of Abaqus ("Element node ordering"). */
static const struct kind {
    int shape, corners, gmsh; /* element type of Gmsh; 0: Abaqus */
    const char *abaqus, *between;
    real volume;
} kinds[] = {
    {TET, 4, 11, NULL, "12 23 13 14 34 24", 1.0 / 6},
    {TET, 4, 0, "C3D10M", "12 23 13 14 24 34", 1.0 / 6},
    {PYRAMID, 5, 19, NULL, "12 14 15 23 25 34 35 45", 1.0 / 3},
    {PYRAMID, 5, 14, NULL, "12 14 15 23 25 34 35 45 1234", 1.0 / 3},
    {PRISM, 6, 18, NULL, "12 13 14 23 25 36 45 46 56", 0.5},
    {PRISM, 6, 13, NULL, "12 13 14 23 25 36 45 46 56 1254 1364 2365", 0.5},
    {PRISM, 6, 0, "C3D15", "12 23 13 45 56 46 14 25 36", 0.5},
    {HEX, 8, 17, NULL, "12 14 15 23 26 34 37 48 56 58 67 78", 1},
    {HEX, 8, 12, NULL, "12 14 15 23 26 34 37 48 56 58 67 78 1234 1256 1458 2367 3478 5678 12345678", 1},
    {HEX, 8, 0, "C3D20R", "12 23 34 14 56 67 78 58 15 26 37 48", 1},
    {HEX, 8, 0, "C3D27", "12 23 34 14 56 67 78 58 15 26 37 48 12345678 1234 5678 1256 2367 3478 1458", 1},
};

/* Computes at[], the reference positions of all nodes of an element of type k. Returns the number of nodes. */
static int reference_nodes(const struct kind *k, real (*at)[3])
{
    int n = k->corners;
    memcpy(at, corner_of[k->shape], (size_t)n * sizeof *at);
    for (const char *c = k->between; *c; n++) {
        int corners = 0;
        for (int d = 0; d < 3; d++) at[n][d] = 0;
        for (; *c >= '1'; c++, corners++)
            for (int d = 0; d < 3; d++) at[n][d] += corner_of[k->shape][*c - '1'][d];
        for (int d = 0; d < 3; d++) at[n][d] /= corners;
        while (*c == ' ') c++;
    }
    return n;
}

static void write_kind(const char *name, const struct kind *k)
{
    FILE *file = fopen(name, "w");
    real at[NODES_MOST][3];
    const int n = reference_nodes(k, at);
    fprintf(file, k->gmsh ? "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n%d\n" : "*NODE\n", n);
    for (int i = 0; i < n; i++) {
        real X[3];
        curve_map(at[i], X);
        fprintf(file, k->gmsh ? "%d %.17g %.17g %.17g\n" : "%d, %.17g, %.17g, %.17g\n", i + 1, X[0], X[1], X[2]);
    }
    if (k->gmsh)
        fprintf(file, "$EndNodes\n$Elements\n1\n1 %d 0", k->gmsh);
    else
        fprintf(file, "*ELEMENT, TYPE=%s\n1", k->abaqus);
    for (int i = 0; i < n; i++) fprintf(file, k->gmsh ? " %d" : i % 10 == 9 ? ",\n%d" : ", %d", i + 1);
    fprintf(file, k->gmsh ? "\n$EndElements\n" : "\n");
    fclose(file);
}

/* Computes at[3], the position with the coordinates u, v on side `side` of the reference element of `shape`; the side
 * is a coordinate plane or its opposite. Returns false if the position is outside the element. */
static bool on_side(int shape, int side, real u, real v, real *at)
{
    const real in[3] = {u, v, 0};
    const int axis = side % 3;
    for (int d = 0; d < 3; d++) at[(axis + 1 + d) % 3] = in[d];
    if (side >= 3 && shape != HEX) return false;
    if (side >= 3) at[axis] = 1;
    switch (shape) {
    case TET:
        return at[0] + at[1] + at[2] <= 1;
    case PYRAMID:
        return at[0] <= 1 - at[2] && at[1] <= 1 - at[2];
    case PRISM:
        return at[0] + at[1] <= 1;
    default:
        return true;
    }
}

/* Checks volume and surface of curved elements of every type against the exact map. The file is read with an accuracy
 * of 1 mm for chords of curved sides, which is the tolerance of distances; the elements have edges of about 1 m. */
static void every_kind_is_curved(void **state)
{
    (void)state;
    const real fine = 1e-3;
    for (size_t k = 0; k < COUNT_OF(kinds); k++) {
        const char *name = kinds[k].gmsh ? "a.msh" : "a.inp";
        struct geometry g;
        write_kind(name, &kinds[k]);
        assert_ok(geometry_read(&g, name, 3, 1, fine));
        assert_int_equal(g.whole.open_edges, 0);
        assert_int_equal(g.whole.shells, 1);
        assert_near(g.whole.volume, kinds[k].volume, 5 * fine); /* about five unit faces, each within `fine` */
        for (int side = 0; side < 6; side++)
            for (int i = 0; i < 49; i++) {
                real at[3], X[3];
                if (!on_side(kinds[k].shape, side, (i % 7 + 0.3) / 7, (i / 7 + 0.4) / 7, at)) continue;
                curve_map(at, X);
                assert_near(hull_signed_distance(&g.whole, X, NULL), 0, fine);
            }
        geometry_free(&g);
        remove(name);
    }
}

/* Writes to the file `name` a quarter ring from r = 1 m to 2 m of four elements CPS8R or eight CPS6 (`type`) with all
 * nodes on circles. The area between a parabola and a circular arc of 45 degrees is 3.2e-4 r^2. Node set `outer`: three
 * nodes on the outer arc; element set `inner`: the inner half of the ring. */
static void write_ring(const char *name, const char *type)
{
    const bool triangles = strcmp(type, "CPS6") == 0;
    FILE *file = fopen(name, "w");
    fprintf(file, "*NODE\n");
    for (int i = 0; i <= 4; i++)
        for (int j = 0; j <= 4; j++) {
            const real r = 1 + 0.25 * i, angle = j * acos(-1) / 8;
            fprintf(file, "%d, %.17g, %.17g\n", 1 + i * 5 + j, r * cos(angle), r * sin(angle));
        }
    fprintf(file, "*NSET, NSET=outer\n21, 23, 25\n");
    for (int i = 0; i < 2; i++) {
        fprintf(file, "*ELEMENT, TYPE=%s, ELSET=%s\n", type, i == 0 ? "inner" : "rest");
        for (int j = 0; j < 2; j++) {
            const int a = 1 + 10 * i + 2 * j;
            if (triangles)
                fprintf(file, "%d, %d, %d, %d, %d, %d, %d\n%d, %d, %d, %d, %d, %d, %d\n", 10 * i + j + 1, a, a + 10,
                        a + 12, a + 5, a + 11, a + 6, 10 * i + j + 5, a, a + 12, a + 2, a + 6, a + 7, a + 1);
            else
                fprintf(file, "%d, %d, %d, %d, %d, %d, %d, %d, %d\n", 10 * i + j + 1, a, a + 10, a + 12, a + 2, a + 5,
                        a + 11, a + 7, a + 1);
        }
    }
    fclose(file);
}

static void a_ring_is_round(void **state)
{
    (void)state;
    static const char *const types[] = {"CPS8R", "CPS6"};
    const real pi = acos(-1), fine = 1e-4;
    for (size_t k = 0; k < COUNT_OF(types); k++) {
        struct geometry g;
        write_ring("r.inp", types[k]);
        assert_ok(geometry_read(&g, "r.inp", 2, 1, fine));
        const struct geometry_set *outer = geometry_find_set_by_name(&g, "outer"),
                                  *inner = geometry_find_set_by_name(&g, "inner");
        assert_near(g.whole.volume, 0.75 * pi, 2 * 3.3e-4 * 3 + 5 * fine);
        assert_near(inner->hull.volume, (2.25 - 1) * pi / 4, 2 * 3.3e-4 * 1.25 + 4 * fine);
        assert_int_equal(g.whole.shells, 1);
        assert_int_equal(g.whole.open_edges, 0);
        for (int i = 0; i < 40; i++) {
            const real angle = (i + 0.5) / 40 * pi / 2, X[] = {2 * cos(angle), 2 * sin(angle)};
            /* Parabolas deviate by up to 3e-3 of the radius from circles of 45 degrees. */
            assert_near(hull_signed_distance(&outer->hull, X, NULL), 0, 2 * 3e-3 + fine);
            assert_near(hull_signed_distance(&inner->hull, (real[]){0.75 * X[0], 0.75 * X[1]}, NULL), 0,
                        1.5 * 3e-3 + fine);
        }
        geometry_free(&g);
    }
    remove("r.inp");
}

/* Checks that the faces of a curved 20-node cube and of a straight cube beside it coincide without a gap, and so do the
 * edges of the plane faces between both. */
static void curved_beside_straight(void **state)
{
    (void)state;
    struct geometry g;
    FILE *file = fopen("b.inp", "w");
    fprintf(file, "*NODE\n");
    for (int k = 0; k <= 2; k++)
        for (int j = 0; j <= 2; j++)
            for (int i = 0; i <= 4; i++)
                fprintf(file, "%d, %g, %g, %g\n", 1 + i + 5 * j + 15 * k, 0.5 * i,
                        0.5 * j + (i == 1 && j == 2 ? 0.1 : 0), 0.5 * k);
    fprintf(file, "*ELEMENT, TYPE=C3D20\n");
    for (int e = 0; e < 2; e++) {
        static const int at[20][3] = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 2}, {2, 0, 2}, {2, 2, 2},
                                      {0, 2, 2}, {1, 0, 0}, {2, 1, 0}, {1, 2, 0}, {0, 1, 0}, {1, 0, 2}, {2, 1, 2},
                                      {1, 2, 2}, {0, 1, 2}, {0, 0, 1}, {2, 0, 1}, {2, 2, 1}, {0, 2, 1}};
        fprintf(file, "%d", e + 1);
        for (int k = 0; k < 20; k++)
            fprintf(file, k == 10 ? ",\n%d" : ", %d", 1 + at[k][0] + 2 * e + 5 * at[k][1] + 15 * at[k][2]);
        fputc('\n', file);
    }
    fclose(file);
    assert_ok(geometry_read(&g, "b.inp", 3, 1, 1e-4));
    assert_int_equal(g.whole.open_edges, 0);
    assert_close(g.whole.volume, 2 + 2.0 / 3 * 0.1, 1e-4); /* below a parabola of height 0.1 */
    assert_near(hull_signed_distance(&g.whole, (real[]){0.5, 1.1, 0.3}, NULL), 0, 1e-4);
    geometry_free(&g);
    remove("b.inp");
}

/* Checks that straight third-order elements are read by their corners, and that curved third-order elements are
 * refused. */
static void third_order(void **state)
{
    (void)state;
    for (int curved = 0; curved < 2; curved++) {
        struct geometry g;
        FILE *file = fopen("c.msh", "w");
        fprintf(
            file,
            "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n9\n1 0 0 0\n2 3 0 0\n3 0 3 0\n4 1 %g 0\n5 2 0 0\n6 2 1 0\n"
            "7 1 2 0\n8 0 2 0\n9 0 1 0\n$EndNodes\n$Elements\n1\n1 20 0 1 2 3 4 5 6 7 8 9\n$EndElements\n",
            curved ? -0.2 : 0.0);
        fclose(file);
        if (curved) {
            assert_refused(geometry_read(&g, "c.msh", 2, 1, NAN),
                           "c.msh:18: curved elements of order 3 are not supported; save them with order 2 "
                           "(gmsh -order 2");
        } else {
            assert_ok(geometry_read(&g, "c.msh", 2, 1, NAN));
            assert_close(g.whole.volume, 4.5, 1e-12);
            geometry_free(&g);
        }
    }
    remove("c.msh");
}

/* Checks that curved elements that are too coarse for the spacing are refused, and so are elements with more nodes than
 * their type has. */
static void refused_curves(void **state)
{
    (void)state;
    struct geometry g;
    write_ring("r.inp", "CPS8");
    assert_refused(geometry_read(&g, "r.inp", 3, 1, NAN), "r.inp: its elements are plane, all at z = 0 m");
    assert_refused(geometry_read(&g, "r.inp", 2, 1, 1e-12), "r.inp: second-order elements have edges curved by");
    write_ring("r.inp", "CPS6");
    assert_ok(geometry_read(&g, "r.inp", 2, 1, NAN)); /* without a spacing: 16 pieces */
    assert_near(g.whole.volume, 0.75 * acos(-1), 5e-3);
    geometry_free(&g);
    FILE *file = fopen("r.inp", "w");
    fputs("*NODE\n1, 0, 0\n2, 1, 1e-9\n3, 0, 1\n4, .5, 0\n5, .5, .5\n6, 0, .5\n*ELEMENT, TYPE=CPS6\n1, 1, 2, 3, 4, 5, "
          "6\n",
          file);
    fclose(file);
    assert_ok(geometry_read(&g, "r.inp", 2, 1, NAN)); /* straight up to round-off: three edges */
    assert_int_equal(g.whole.faces, 3);
    geometry_free(&g);
    file = fopen("r.inp", "w");
    fputs("*NODE\n1, 0, 0\n2, 1, 0\n3, 0, 1\n4, 1, 1\n*ELEMENT, TYPE=CPS3\n1, 1, 2, 3, 4\n", file);
    fclose(file);
    assert_refused(geometry_read(&g, "r.inp", 2, 1, NAN),
                   "r.inp:7: an element has more nodes than the 3 of its type, such as 4");
    remove("r.inp");
}

/* Checks that damaged files are read or refused without a crash. */
static void damaged_curves(void **state)
{
    (void)state;
    enum { MOST = 8192 };
    char whole[MOST], bad[MOST];
    uint64_t random = 88172645463325252u;
    for (int k = 0; k < 4; k++) {
        const struct kind *kind = &kinds[(const int[]){1, 5, 8, 10}[k]];
        const char *name = kind->gmsh ? "d.msh" : "d.inp";
        write_kind(name, kind);
        FILE *file = fopen(name, "r");
        const size_t n = fread(whole, 1, MOST, file);
        fclose(file);
        assert_true(n > 100 && n < MOST);
        for (int trial = 0; trial < 250; trial++) {
            struct geometry g;
            memcpy(bad, whole, n);
            for (int change = 0; change < 1 + trial % 4; change++) {
                static const char bytes[] = "0123456789.-e, \n*$";
                random ^= random << 13, random ^= random >> 7, random ^= random << 17;
                bad[random % n] = bytes[(random >> 32) % (sizeof bytes - 1)];
            }
            file = fopen(name, "w");
            assert_int_equal(fwrite(bad, 1, n, file), n);
            fclose(file);
            if (geometry_read(&g, name, 3, 1, trial % 2 ? NAN : 0.05) != OK) {
                assert_null(strchr(status_message(), '\n'));
                continue;
            }
            assert_true(g.whole.volume > 0);
            geometry_free(&g);
        }
        remove(name);
    }
}

static char folder[] = "/tmp/cleave_curved_XXXXXX";
static int enter_folder(void **state)
{
    (void)state;
    return mkdtemp(folder) == NULL || chdir(folder) != 0;
}

static int leave_folder(void **state)
{
    (void)state;
    return chdir("/") != 0 || rmdir(folder) != 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_kind_is_curved),   cmocka_unit_test(a_ring_is_round),
                                       cmocka_unit_test(curved_beside_straight), cmocka_unit_test(third_order),
                                       cmocka_unit_test(refused_curves),         cmocka_unit_test(damaged_curves)};
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
