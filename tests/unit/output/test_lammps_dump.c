/* Tests text dumps of LAMMPS. The values are read for any order of ids and columns, an incomplete dump up to its last
 * complete step. Thousands of damaged dumps are read or refused without a crash. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <cmocka.h>

#include "base/memory.h"
#include "output/lammps_dump.h"
#include "tests/support/folder.h"

static const char name[] = "plate.dump";

static const char whole[] =
    "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n3\nITEM: BOX BOUNDS mm mm mm\n-1 1\n-1 1\n-2 2\n"
    "ITEM: ATOMS id x y z vx vy vz c_damage \n1 0.5 1 0 10 20 0 0 \n2 1.5 2 0 0 0 0 0 \n3 2.5e-3 3 0 0 0 0 0 \n"
    "ITEM: TIMESTEP\n200\nITEM: NUMBER OF ATOMS\n3\nITEM: BOX BOUNDS mm mm mm\n-1 1\n-1 1\n-2 2\n"
    "ITEM: ATOMS vy id y x z c_damage \n7 3 33 3.25 0 0.25 \n8 1 11 1.25 -1 0 \n9 2 22 2.25 0 1 \n";

static void write_file(const char *text, size_t length)
{
    FILE *to = fopen(name, "w");
    assert_non_null(to);
    fwrite(text, 1, length, to);
    fclose(to);
}

static void what_is_there(void **state)
{
    int n;
    int64_t *step;
    struct lammps_frame f;
    (void)state;
    write_file(whole, sizeof whole - 1);
    assert_int_equal(lammps_list_step_numbers(name, &n, &step), OK);
    assert_int_equal(n, 2);
    assert_int_equal(step[1], 200);
    memory_free(step);
    assert_int_equal(lammps_frame_read(&f, name, 0), OK);
    assert_true(f.n == 3 && f.x[0][2] == 2.5e-3 && f.v[1][0] == 20 && f.damage[0] == 0);
    lammps_frame_free(&f);
    assert_int_equal(lammps_frame_read(&f, name, 200), OK);
    assert_true(f.x[0][0] == 1.25 && f.x[1][2] == 33 && f.x[2][0] == -1 && f.v[1][1] == 9 && f.damage[1] == 1);
    lammps_frame_free(&f);
    assert_int_equal(lammps_frame_read(&f, name, 100), FAILED);
    assert_string_equal(status_message(), "plate.dump has no step 100; repeat the LAMMPS run up to this step");
}

static void being_written(void **state)
{
    int n;
    int64_t *step;
    (void)state;
    for (size_t length = 0; length < sizeof whole - 1; length++) {
        write_file(whole, length);
        const status s = lammps_list_step_numbers(name, &n, &step);
        assert_int_equal(s, n > 0 ? OK : FAILED);
        assert_true(n == (strstr(whole, "0 \nITEM") + 3 - whole <= (ptrdiff_t)length));
        memory_free(step);
    }
}

static void refused(const char *from, const char *to, const char *message)
{
    char text[sizeof whole + 100];
    struct lammps_frame f;
    const char *at = strstr(whole, from);
    assert_non_null(at);
    const int length = snprintf(text, sizeof text, "%.*s%s%s", (int)(at - whole), whole, to, at + strlen(from));
    write_file(text, (size_t)length);
    assert_int_equal(lammps_frame_read(&f, name, 0), FAILED);
    assert_non_null(strstr(status_message(), message));
}

static void what_is_wrong(void **state)
{
    (void)state;
    refused("ATOMS\n3", "ATOMS\n300000000",
            "plate.dump:4: is not a possible number of particles: the file is too short for it, or damaged; repeat the "
            "LAMMPS run");
    refused("ATOMS\n3", "ATOMS\nmany", "plate.dump:4: is not a possible number of particles");
    refused("id x y", "id y", "plate.dump:9: the columns id, x, y and z are missing; add them to the dump command");
    refused("\n2 1.5", "\n1 1.5", "plate.dump:11: an id occurs twice");
    refused("\n2 1.5", "\n4 1.5",
            "plate.dump:11: ids must be from 1 to the number of particles; repeat the LAMMPS run");
    refused("1.5 2 0", "nan 2 0", "plate.dump:11: the numbers of a particle are missing; repeat the LAMMPS run");
    refused("ITEM: TIMESTEP", "<html>", "plate.dump:1: ITEM: TIMESTEP is missing; give a text dump of LAMMPS");
}

static void damaged(void **state)
{
    char text[sizeof whole];
    unsigned seed = 25;
    (void)state;
    for (int k = 0; k < 4000; k++) {
        int n;
        int64_t *step;
        struct lammps_frame f;
        memcpy(text, whole, sizeof text);
        for (int m = rand_r(&seed) % 4; m >= 0; m--)
            text[rand_r(&seed) % (sizeof text - 1)] =
                (char)(rand_r(&seed) % 3 ? ' ' + rand_r(&seed) % 95 : rand_r(&seed));
        write_file(text, 1 + (size_t)rand_r(&seed) % (sizeof text - 1));
        if (lammps_list_step_numbers(name, &n, &step) == OK && lammps_frame_read(&f, name, step[n - 1]) == OK)
            lammps_frame_free(&f);
        memory_free(step);
    }
}

static int dump_leave(void **state)
{
    unlink(name);
    return folder_leave(state);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(what_is_there), cmocka_unit_test(being_written),
                                       cmocka_unit_test(what_is_wrong), cmocka_unit_test(damaged)};
    return cmocka_run_group_tests(tests, folder_enter, dump_leave);
}
