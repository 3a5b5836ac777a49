/* Tests mesh files with wrong counts or duplicate elements, which are refused; Gmsh 2.2 may list an element once for
 * each of its groups. Also tests node sets of elements, groups with equal names, and sets of instances in Abaqus
 * files. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "tests/support/near.h"

#include "geometry/geometry.h"

/* Gmsh 2.2 file of a square of two triangles, each in a group of its own. */
static const char msh2[] = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n2 1 \"low\"\n2 2 \"high\"\n"
                           "$EndPhysicalNames\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n"
                           "$Elements\n2\n1 2 2 1 1 1 2 3\n2 2 2 2 1 1 3 4\n$EndElements\n";
static const char msh4[] = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 0 1 0\n9 0 0 0 1 1 0 0 0\n$EndEntities\n"
                           "$Nodes\n1 4 1 4\n2 9 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n$EndNodes\n"
                           "$Elements\n2 2 1 2\n2 9 2 1\n1 1 2 3\n2 9 2 1\n2 1 3 4\n$EndElements\n";
static const char inp[] = "*Node\n1, 0, 0\n2, 1, 0\n3, 1, 1\n4, 0, 1\n*Element, type=CPS3\n1, 1, 2, 3\n2, 1, 3, 4\n";

/* Writes `text`, with the part `from` replaced by `to`, to the file `name`, reads this file in 2D into *g and returns
 * the status. */
static status read_changed(struct geometry *g, const char *name, const char *text, const char *from, const char *to)
{
    const char *at = strstr(text, from);
    FILE *file = fopen(name, "w");
    assert_non_null(at);
    assert_non_null(file);
    fprintf(file, "%.*s%s%s", (int)(at - text), text, to, at + strlen(from));
    fclose(file);
    const status result = geometry_read(g, name, 2, 1, NAN);
    unlink(name);
    return result;
}

static void wrong_ones(void **state)
{
    (void)state;
    static const struct {
        const char *name, *text, *from, *to, *message;
    } bad[] = {
        {"a.msh", msh2, "Elements\n2", "Elements\n1",
         "a.msh:19: $Elements gives 1 elements, but more follow in place of"},
        {"a.msh", msh2, "$Nodes\n4", "$Nodes\n3",
         "a.msh:14: $Nodes gives 3 nodes, but more follow in place of $EndNodes"},
        {"a.msh", msh2, "Names\n2", "Names\n1", "a.msh:7: $PhysicalNames gives 1 names, but more follow"},
        {"a.msh", msh2, "2 1 1 3 4", "1 1 3 1 2", "1 element has the corners of another one (element 2 has those of"},
        {"a.msh", msh4, "0 0 1 0", "0 0 0 0", "$Entities gives 0 entities, but more follow"},
        {"a.msh", msh4, "1 4 1 4", "1 3 1 4", "the section gives 3 nodes, but its blocks contain 4"},
        {"a.msh", msh4, "2 2 1 2", "2 3 1 2", "the section gives 3 elements, but its blocks contain 2"},
        {"a.msh", msh4, "2 2 1 2", "1 1 1 2", "$Elements gives 1 blocks, but more follow"},
        {"a.msh", msh2, "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n", "$NOD\n",
         "file format 1 is not supported; save the mesh"},
        {"a.inp", inp, "2, 1, 3, 4", "2, 1, 3, 4\n*Nset, nset=a\nb",
         ":10: set a lists b, which is not the name of an earlier set"},
        {"a.inp", inp, "2, 1, 3, 4", "1, 1, 3, 4", "element 1 is given twice"},
        {"a.inp", inp, "2, 1, 3, 4", "7, 2, 3, 1", "1 element has the corners of another one (element 7 has those of"},
    };
    for (size_t k = 0; k < COUNT_OF(bad); k++) {
        struct geometry g;
        assert_refused(read_changed(&g, bad[k].name, bad[k].text, bad[k].from, bad[k].to), bad[k].message);
    }
}

static void right_ones(void **state)
{
    (void)state;
    static const struct {
        const char *name, *text, *from, *to;
    } good[] = {{"a.msh", msh2, "", ""},
                {"a.msh", msh4, "", ""},
                {"a.inp", inp, "", ""},
                {"a.msh", msh2, "2\n1 2 2 1 1 1 2 3\n", "3\n1 2 2 1 1 1 2 3\n3 2 2 2 1 1 2 3\n"}};
    for (size_t k = 0; k < COUNT_OF(good); k++) {
        struct geometry g;
        assert_ok(read_changed(&g, good[k].name, good[k].text, good[k].from, good[k].to));
        assert_close(g.whole.volume, 1, 1e-12);
        assert_int_equal(g.whole.open_edges, 0);
        if (good[k].text == msh2) {
            assert_close(geometry_find_set_by_name(&g, "low")->hull.volume, 0.5, 1e-12);
            assert_close(geometry_find_set_by_name(&g, "high")->hull.volume, good[k].from[0] ? 1 : 0.5, 1e-12);
        }
        geometry_free(&g);
    }
}

/* Checks that a node set defined by an element set of Abaqus (*Nset, elset=) contains the nodes of the elements. */
static void nodes_of_elements(void **state)
{
    (void)state;
    struct geometry g;
    assert_ok(read_changed(&g, "a.inp", inp, "2, 1, 3, 4\n",
                           "2, 1, 3, 4\n*Elset, elset=low\n1\n*Nset, nset=right, elset=low\n"));
    assert_near(hull_signed_distance(&geometry_find_set_by_name(&g, "right")->hull, (real[]){1.5, 0}, NULL), 0.5,
                1e-12);
    assert_near(hull_signed_distance(&geometry_find_set_by_name(&g, "right")->hull, (real[]){-3, 1}, NULL), sqrt(10),
                1e-12);
    geometry_free(&g);
}

/* Checks two physical groups with one name: accepted for a name longer than 63 characters and for an unused group, but
 * marked as faulty if they contain elements of different dimension, a triangle and its edge. */
static void twin_groups(void **state)
{
    (void)state;
    struct geometry g;
    char name[100] = "", named[sizeof name + 8];
    memset(name, 'x', 80);
    snprintf(named, sizeof named, "2 2 \"%s\"", name);
    assert_ok(read_changed(&g, "a.msh", msh2, "2 2 \"high\"", named));
    assert_null(geometry_find_set_by_name(&g, name)->fault);
    geometry_free(&g);
    assert_ok(read_changed(&g, "a.msh", msh2, "2 2 \"high\"\n", "1 2 \"low\"\n"));
    assert_null(geometry_find_set_by_name(&g, "low")->fault);
    geometry_free(&g);
    const char *twice = "$Elements\n3\n3 1 2 3 1 1 2\n";
    char text[sizeof msh2 + 64];
    const char *at = strstr(msh2, "$Elements\n2\n");
    snprintf(text, sizeof text, "%.*s%s%s", (int)(at - msh2), msh2, twice, at + strlen("$Elements\n2\n"));
    assert_ok(read_changed(&g, "a.msh", text, "2 2 \"high\"", "1 3 \"low\""));
    assert_non_null(strstr(geometry_find_set_by_name(&g, "low")->fault, "two physical groups of different dimension"));
    geometry_free(&g);
}

/* Returns the signed distance of the point (x, 0) from the set `name` of g. */
static real from_set(const struct geometry *g, const char *name, real x)
{
    const struct geometry_set *set = geometry_find_set_by_name(g, name);
    assert_non_null(set);
    return hull_signed_distance(&set->hull, (real[]){x, 0}, NULL);
}

/* Checks sets of an Abaqus assembly of two instances, each of whose parts has a node set `pin`, at x = 0 and x = 7.
 * Sets of the assembly consist of nodes or sets of instances. Node 1 of the assembly does not conflict with node 1 of
 * the parts. */
static void sets_of_instances(void **state)
{
    (void)state;
    struct geometry g;
    static const char nodes[] = "*Node\n1, 0, 0\n2, 1, 0\n3, 1, 1\n4, 0, 1\n*Element, type=CPS4\n1, 1, 2, 3, 4\n";
    static const char sets[] = "*Node\n1, 9, 0\n*Nset, nset=ref\n1\n*Nset, nset=ends, instance=Left-1\n2\n"
                               "*Nset, nset=ends, instance=Right-1\n2\n*Nset, nset=pins\nLeft-1.pin, Right-1.pin\n"
                               "*Nset, nset=own, instance=Right-1\npin\n*Nset, nset=single\nRight-1.2\n"
                               "*Nset, nset=two, elset=Right-1.all\n";
    char deck[2048];
    snprintf(deck, sizeof deck,
             "*Part, name=Left\n%s*Nset, nset=pin\n1\n*Nset, nset=top\n3\n*End Part\n*Part, name=Right\n%s"
             "*Nset, nset=pin\n1\n*Elset, elset=all\n1\n*End Part\n*Assembly, name=A\n"
             "*Instance, name=Left-1, part=Left\n*End Instance\n"
             "*Instance, name=Right-1, part=Right\n7, 0\n*End Instance\n%s*End Assembly\n",
             nodes, nodes, sets);
    assert_ok(read_changed(&g, "a.inp", deck, "", ""));
    assert_null(geometry_find_set_by_name(&g, "pin"));
    assert_close(from_set(&g, "left-1.pin", -1), 1, 1e-12);
    assert_close(from_set(&g, "Right-1.pin", 6), 1, 1e-12);
    assert_close(from_set(&g, "Right-1.all", 6), 1, 1e-12);
    assert_close(from_set(&g, "top", 1), 1, 1e-12);
    assert_close(from_set(&g, "ref", 8.5), 0.5, 1e-12);
    static const struct {
        const char *set;
        real x[2];
    } joined[] = {{"ends", {1, 8}}, {"pins", {0, 7}}, {"own", {7, 7}}, {"single", {8, 8}}, {"two", {7, 8}}};
    for (size_t k = 0; k < COUNT_OF(joined); k++) {
        assert_near(from_set(&g, joined[k].set, joined[k].x[0]), 0, 1e-12);
        assert_near(from_set(&g, joined[k].set, joined[k].x[1]), 0, 1e-12);
        assert_close(from_set(&g, joined[k].set, joined[k].x[0] - 0.25), 0.25, 1e-12);
    }
    geometry_free(&g);
}

/* Folder for the files of the tests. */
static char folder[] = "/tmp/cleave_counts_XXXXXX";
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
    const struct CMUnitTest tests[] = {cmocka_unit_test(wrong_ones), cmocka_unit_test(right_ones),
                                       cmocka_unit_test(nodes_of_elements), cmocka_unit_test(twin_groups),
                                       cmocka_unit_test(sets_of_instances)};
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
