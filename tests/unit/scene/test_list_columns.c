/* Tests columns of particle lists from other programs: units, separators, names, missing and unknown columns, and
 * invalid bytes. */
#include "tests/support/near.h"

#include <stdlib.h>
#include <unistd.h>

#include "tests/support/setting.h"
#include "scene/fill.h"

/* Writes `text` to the file `name` in the test's folder and makes it the list of body 0 of s. */
static void list_written(struct setting *s, char *name, const char *text)
{
    FILE *file = fopen(name, "wb");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
    s->body[0].file = name;
}

/* Checks units, separators, column names of other programs, and defaults for missing columns. */
static void lists_of_others_are_read(void **state)
{
    (void)state;
    static const char *const text[] = {
        "id; X [mm]; y [cm]; z; volume [mm^3]; vx [m/s]; weight [g]; Material\n7; 500; 100; 3; 2e6; 8; 4; hard\n",
        "id\tx [mm]\ty\tvolume\tvx [km/s]\tdensity [kg/m^3]\tmaterial\n7\t500\t1\t2e-3\t8e-3\t2\t1\n",
        "x y volume vx mass material\n5.0D-01 1.0d0 2D-3 8.0D+00 4.D-03 1\n",
        "  x y [mm] vx [mm / us]  weight [m^3]   mass [kg] material z\n 0.5 1000  8e-3  2e-3 4e-3 hard 9\n"};
    for (size_t k = 0; k < COUNT_OF(text); k++) {
        struct setting s;
        struct particles p;
        struct particle_list_head head;
        char name[] = "others.txt";
        setting_make(&s, SPACE_PLANE_STRESS, (real[]){1, 1});
        strcpy(s.material[1].name, "hard");
        list_written(&s, name, text[k]);
        s.body[0].velocity[0] = 1, s.body[0].velocity[1] = 5;
        assert_ok(particle_list_read_column_names(&head, name, NULL, 2));
        assert_true(head.material && head.mass);
        assert_string_equal(head.note, k == 0 ? "id, z not read" : k == 1 ? "id not read" : k == 2 ? "" : "z not read");
        assert_ok(bodies_fill_with_particles(&p, &s.scene, NULL, 0));
        assert_int_equal(p.n, 1);
        assert_close(p.X[0][0], 0.5, 1e-15);
        assert_close(p.X[1][0], 1, 1e-15);
        assert_close(p.volume0[0], 2e-3, 1e-15);
        assert_close(p.mass[0], 4e-3, 1e-15);
        assert_close(p.v[0][0], 8, 1e-15);
        assert_exact(p.v[1][0], 5);
        assert_int_equal(p.material[0], 1);
        particles_free(&p);
        remove(name);
    }
}

/* Checks that the scene can set the unit of coordinates and volumes without units, and the columns of a file without a
 * header. */
static void scene_says_unit_and_columns(void **state)
{
    (void)state;
    static const struct {
        const char *text, *columns;
    } c[] = {{"x,y,volume,block_id,vx\n500,2,3,2,4\n", NULL},
             {"500 2 3 2 4\n", "x,y,volume,block,vx"},
             {"# nameless\n500;2;3e-9 ;2;4\n", "x,y,volume [m^3],block,vx"},
             {"500\t2\t77\t3\t2\t4\n", "x,y,skip,volume,block,vx"}};
    for (size_t k = 0; k < COUNT_OF(c); k++) {
        struct setting s;
        struct particles p;
        char name[] = "said.txt";
        setting_make(&s, SPACE_PLANE_STRESS, (real[]){1, 1});
        list_written(&s, name, c[k].text);
        s.body[0].form = (struct particle_list_form){1e-3, c[k].columns};
        assert_ok(particle_list_read_column_names(&s.body[0].list, name, &s.body[0].form, 2));
        assert_true(s.body[0].list.material && s.body[0].list.volumes);
        assert_ok(bodies_fill_with_particles(&p, &s.scene, NULL, 0));
        assert_int_equal(p.n, 1);
        assert_close(p.X[0][0], 0.5, 1e-15);
        assert_close(p.X[1][0], 2e-3, 1e-15);
        assert_close(p.volume0[0], 3e-9, 1e-15);
        assert_close(p.v[0][0], 4, 1e-15); /* unit is one of lengths */
        assert_int_equal(p.material[0], 1);
        particles_free(&p);
        remove(name);
    }
    struct setting s;
    struct particle_list_head head;
    char name[] = "said.txt", h5[] = "said.h5";
    setting_make(&s, SPACE_PLANE_STRESS, (real[]){1, 1});
    list_written(&s, name, "500 2 3\n");
    assert_refused(particle_list_read_column_names(&head, name, &(struct particle_list_form){0, "x,volume"}, 2),
                   "said.txt: columns: [x,volume] does not name y");
    struct particle_list l;
    assert_refused(particle_list_read(&l, name, &(struct particle_list_form){0, "x,y"}, 2),
                   "said.txt:1:7: this line has more values than the 2 columns of the scene");
    assert_refused(particle_list_read(&l, name, &(struct particle_list_form){0, "x,y,volume,block"}, 2),
                   "said.txt:1:1: this line has 3 values, but the scene names 4 columns");
    remove(name);
    list_written(&s, h5, "x");
    assert_refused(particle_list_read(&l, h5, &(struct particle_list_form){0, "x,y"}, 2),
                   "said.h5: this kind of file names its columns itself");
    remove(h5);
}

/* Checks a spacing that is missing in the scene: it follows from the mean volume, in a plate with its thickness. Two
 * particles closer than a thousandth of it are refused. */
static void spacing_of_volumes(void **state)
{
    (void)state;
    static const char text[] = "x,y,volume\n0,0,1e-3\n1,0,1e-3\n%s,0,1e-3\n0,1,1e-3\n";
    for (int k = 0; k < 2; k++) {
        struct setting s;
        struct particles p;
        char name[] = "volumes.csv", whole[100];
        setting_make(&s, SPACE_PLANE_STRESS, (real[]){1, 1});
        s.scene.spacing = 0, s.scene.thickness = 1e-3;
        snprintf(whole, sizeof whole, text, k ? "1.0005" : "1.0015");
        list_written(&s, name, whole);
        if (k)
            assert_refused(bodies_fill_with_particles(&p, &s.scene, NULL, 0), "");
        else
            assert_ok(bodies_fill_with_particles(&p, &s.scene, NULL, 0));
        if (!k) particles_free(&p);
        remove(name);
    }
}

/* Checks that files of ParaView, R, pandas, Peridigm and PeriLab are read as these programs write them. */
static void lists_of_programs_are_read(void **state)
{
    (void)state;
    static const char *const text[] = {
        "\"Points:0\",\"Points:1\",\"Points:2\",\"volume\",\"block_id\"\n0.5,1,0,\"2e-3\",2\n",
        "\"volume (mm^3)\";\"Points_0 (mm)\";\"Points_1\";\"a; b\";\"material\"\n\" 2e6 \";500;1;\"c; d\";\"hard\"\n",
        "\"x [mm]\" \"y (m)\" \"volume\" \"a name\" \"material\"\n500 1 2e-3 \"of it\" \"1\"\n",
        "# of mesh 7\n# x y z block_id volume\n# 1 particle\n0.5 1 0 2 2e-3\n", "\t5e-1 1.0 0 2 2e-3 \r\n",
        "# nodes\nheader: x y block_id volume\n0.5 1 2 2e-3\n",
        /* Tabs separate like blanks, if the lines have both; if names or fields require it, each tab ends a field. */
        "header: \t x [mm] \t y \t block_id \t volume\n 500 1 2 2e-3\n",
        "x\ty [mm]  volume\tblock_id\n0.5\t1000 2e-3\t2\n", "x y\tblock_id volume\t\n\t0.5 1 2 2e-3\n",
        "#\tx \ty\tblock_id \tvolume\n0.5 1\t2 2e-3\n", "the node\tx\ty\tvolume\tblock_id\n\t0.5\t1\t2e-3\t2\n",
        "x,\ty,volume,\tblock_id\n0.5,\t1,2e-3,2\n"}; /* a tab after a comma counts as a blank */
    for (size_t k = 0; k < COUNT_OF(text); k++) {
        struct setting s;
        struct particles p;
        struct particle_list_head head;
        char name[] = "program.txt";
        setting_make(&s, SPACE_PLANE_STRESS, (real[]){1, 1});
        strcpy(s.material[1].name, "hard");
        list_written(&s, name, text[k]);
        assert_ok(particle_list_read_column_names(&head, name, NULL, 2));
        assert_true(head.material && head.block == (k != 1 && k != 2) && head.unnamed == (k == 4));
        assert_ok(bodies_fill_with_particles(&p, &s.scene, NULL, 0));
        assert_int_equal(p.n, 1);
        assert_close(p.X[0][0], 0.5, 1e-15);
        assert_close(p.X[1][0], 1, 1e-15);
        assert_close(p.volume0[0], 2e-3, 1e-15);
        assert_int_equal(p.material[0], 1);
        particles_free(&p);
        remove(name);
    }
}

/* Checks that without volumes each particle has the volume of a lattice cell, and that a message reports it. */
static void volumes_have_a_default(void **state)
{
    (void)state;
    struct setting s;
    struct particles p;
    struct particle_list_head head;
    char name[] = "places.csv";
    setting_make(&s, SPACE_PLANE_STRESS, (real[]){1, 1});
    list_written(&s, name, "x,y,colour\n0,0,red\n0.5,0,blue\n");
    s.scene.thickness = 0.1;
    assert_ok(particle_list_read_column_names(&head, name, NULL, 2));
    assert_string_equal(head.note, "colour not read; no volumes: taken from the spacing");
    assert_true(!head.material && !head.mass);
    assert_ok(bodies_fill_with_particles(&p, &s.scene, NULL, 0));
    assert_close(p.volume0[1], 0.5 * 0.5 * 0.1, 1e-15);
    particles_free(&p);
    s.scene.spacing = 0;
    assert_refused(bodies_fill_with_particles(&p, &s.scene, NULL, 0),
                   "has a list without volumes; add a column volume, or set particles.spacing");
    remove(name);
}

/* Checks that lists with random changes are read, or refused with a message of one line. */
static void mutated_lists_are_bounded(void **state)
{
    (void)state;
    static const char good[] = "# x y z\n\"id\"; x [mm]; y [cm]; z; volume [mm^3]; vx [m/s]; weight [g]; material\n"
                               "7; 500; 100; 3; 2e6; 8; 4; hard\n8; 600; 1e2; 3; 2; 8; 4; soft\n";
    static const char bytes[] = ";,\t []^#-+.eExz0123456789\n\r\"\0\xFF";
    char name[] = "mutated.csv";
    uint64_t random = 88172645463325252u;
    for (int trial = 0; trial < 3000; trial++) {
        char text[sizeof good];
        struct particle_list l;
        memcpy(text, good, sizeof good);
        for (int k = 0; k < 1 + trial % 5; k++) {
            random ^= random << 13, random ^= random >> 7, random ^= random << 17;
            text[random % (sizeof good - 1)] = bytes[(random >> 32) % sizeof bytes];
        }
        FILE *file = fopen(name, "wb");
        assert_int_equal(fwrite(text, 1, sizeof good - 1, file), sizeof good - 1);
        fclose(file);
        if (particle_list_read(&l, name, NULL, 1 + trial % 3) != OK) {
            assert_null(strchr(status_message(), '\n'));
            continue;
        }
        for (int64_t i = 0; i < l.n; i++) assert_true(isfinite(l.X[0][i]) && (!l.volume || l.volume[i] > 0));
        for (int64_t i = 0; i < l.n && l.material; i++) assert_true(l.material[i] >= -l.names);
        particle_list_free(&l);
    }
    remove(name);
}

static int enter_columns(void **state)
{
    static char folder[] = "/tmp/cleave_columns_XXXXXX";
    *state = folder;
    return mkdtemp(folder) == NULL || chdir(folder) != 0;
}

static int leave_columns(void **state) { return chdir("/") != 0 || rmdir(*state) != 0; }

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lists_of_others_are_read), cmocka_unit_test(scene_says_unit_and_columns),
        cmocka_unit_test(spacing_of_volumes),       cmocka_unit_test(lists_of_programs_are_read),
        cmocka_unit_test(volumes_have_a_default),   cmocka_unit_test(mutated_lists_are_bounded)};
    return cmocka_run_group_tests(tests, enter_columns, leave_columns);
}
