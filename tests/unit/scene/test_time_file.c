/* Tests functions of time from CSV files: reading, refusals, interpolation. */
#include "tests/support/near.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "scene/scene_read.h"

static const char scene_text[] = "space: line\nduration: 20 us\nmethod: mpm\n"
                                 "material: {young: 72 GPa, density: 2440}\nbody: {box: {from: [0], to: [5 mm]}}\n"
                                 "particles: {spacing: 1 mm}\nboundary:\n  - {traction: [1], face: x-, time: ";

static void file_write(const char *name, const char *text, size_t length)
{
    FILE *file = fopen(name, "wb");
    assert_non_null(file);
    fwrite(text, 1, length, file);
    fclose(file);
}

/* Reads into s a scene with the function of time `time` and a file blast.csv with the text csv[length]. Returns the
 * status. */
static status read_with(struct scene *s, const char *time, const char *csv, size_t length)
{
    char text[1000];
    snprintf(text, sizeof text, "%s%s}\n", scene_text, time);
    file_write("timed.yaml", text, strlen(text));
    file_write("blast.csv", csv, length);
    const status read = scene_read(s, "timed.yaml", NULL, 0);
    remove("timed.yaml"), remove("blast.csv");
    return read;
}

static void columns_are_read_with_their_units(void **state)
{
    (void)state;
    static const struct {
        const char *time, *csv;
        real t, value;
        bool unit;
    } c[] = {
        {"{file: blast.csv}", "time [us], value\n1, 2\n3, -4.5\n", 3e-6, -4.5, false},
        {"{file: blast.csv}", "\xEF\xBB\xBF# blast\r\n\r\nvalue;\"Time\"\r\n2 ; 1e-6\r\n #\n-4.5;\t3e-6", 3e-6, -4.5,
         false},
        {"{file: blast.csv}", "t [ms]\tp [MPa]\n0.001\t2\n0.003\t-4.5\n", 3e-6, -4.5e6, true},
        {"{file: blast.csv, column: outer wall}", "time [us], inner, outer wall [bar?], n\n1,2,3,4\n", 0, 0, false},
        {"{file: blast.csv, column: outer wall}", "time [us], inner, outer wall [kPa]\n1,2,7\n3,4,1/3\n", 3e-6,
         1000.0 / 3, true},
    };
    for (size_t k = 0; k < COUNT_OF(c); k++) {
        struct scene s = {0};
        const status read = read_with(&s, c[k].time, c[k].csv, strlen(c[k].csv));
        if (c[k].t == 0) {
            assert_refused(read, "blast.csv:1:31: column outer wall: [bar?] has an unknown unit");
            continue;
        }
        assert_ok(read);
        const struct boundary *b = &s.boundary[0];
        assert_int_equal(b->time.n, 2);
        assert_close(b->time.t[1], c[k].t, 1e-15);
        assert_close(b->time.value[1], c[k].value, 1e-15);
        assert_int_equal(b->time_unit, c[k].unit);
        assert_true(b->time_contents != 0 && strstr(s.text, "blast.csv\"  # contents ") != NULL);
        scene_free(&s);
    }
}

static void bad_files_are_refused(void **state)
{
    (void)state;
    static const struct {
        const char *csv, *message;
    } c[] = {
        {"", "blast.csv: the file is empty"},
        {"time, value\n", "blast.csv: no line below the header has a time and a value; add some"},
        {"0, 1\n1, 2\n", "blast.csv:1:1: no column is named time; begin with a header such as time [us], value"},
        {"value, time\n1\n", "blast.csv:2:1: this line has 1 values, but column 2 is needed"},
        {"time, a, b\n1,2,3\n",
         "blast.csv:1:10: column b is a second column of values; add column: NAME to choose one"},
        {"time, time, b\n", "blast.csv:1:7: column time is given twice; rename or remove one"},
        {"when, b\n", "blast.csv:1:1: no column is named time"},
        {"time\n", "blast.csv:1:1: there is only one column"},
        {"time [m], b\n", "blast.csv:1:7: column time: [m] is a length; give a time"},
        {"time, v [m/s]\n", "blast.csv:1:10: column v: [m/s] is a velocity; give a stress"},
        {"time, v\n0, 1\n2, 1\n2, 3\n",
         "blast.csv:4:1: time 2 is not later than the previous one; give times in ascending order"},
        {"time [us],p\n0,0,0,0\n", "blast.csv:2:5: this line has more values than the 2 columns of the header; write "
                                   "numbers with a decimal point"},
        {"time,v\r0,1\r", "blast.csv:1: lines end in carriage returns only; convert the line ends to line feeds"},
        {"time, v\n0, x\n", "blast.csv:2:4: 'x' is no"},
        {"time; v\n0; 1,5\n", "blast.csv:2:4: '1,5' is not a number here: the decimal sign is a point; write 1.5"},
        {"time, v\n0, nan\n", "blast.csv:2:4: 'nan' is no"},
    };
    for (size_t k = 0; k < COUNT_OF(c); k++) {
        struct scene s = {0};
        const status read = read_with(&s, "{file: blast.csv}", c[k].csv, strlen(c[k].csv));
        if (read == OK || !strstr(status_message(), c[k].message)) print_message("%zu: %s\n", k, status_message());
        assert_refused(read, c[k].message);
    }
    struct scene s = {0};
    assert_refused(read_with(&s, "{column: a}", "", 0), "timed.yaml:8:38: column: has no effect without the key file");
    assert_refused(read_with(&s, "{file: none.csv}", "", 0), "timed.yaml:8:38: file: none.csv cannot be read");
    assert_refused(read_with(&s, "{file: blast.csv, table: [[0, 1]]}", "", 0), "table: is given together with file");
}

/* Checks that arbitrary bytes are read or refused without a crash. */
static void garbage_is_refused(void **state)
{
    (void)state;
    static const char good[] = "# p\ntime [us]; p [MPa]; q\n0; 1.5e3; 2\n1.5; 2; 3\n20; 0; 4\n";
    uint64_t seed = 25;
    for (int round = 0; round < 2000; round++) {
        char text[sizeof good];
        struct scene s = {0};
        memcpy(text, good, sizeof good);
        for (int k = 0; k < 1 + round % 5; k++) {
            seed = seed * 6364136223846793005u + 1442695040888963407u;
            text[(seed >> 33) % (sizeof good - 1)] = (char)(seed >> 56);
        }
        if (read_with(&s, "{file: blast.csv, column: q}", text, sizeof good - 1) == OK) scene_free(&s);
    }
}

/* Checks that values found by bisection in a long table are bitwise equal to those of a linear search. */
static void long_tables_are_bisected(void **state)
{
    (void)state;
    enum { TIMES = 1000 };
    struct time_function f = {.kind = TIME_TABLE, .n = TIMES};
    f.t = NEW("t", TIMES, real), f.value = NEW("v", TIMES, real);
    for (int k = 0; k < TIMES; k++) f.t[k] = k + 0.3 * sin(k), f.value[k] = cos(3 * k);
    for (int q = -10; q < 4 * TIMES + 10; q++) {
        const real t = q % 4 == 0 && q >= 0 && q < 4 * TIMES ? f.t[q / 4] : 0.25 * q + 0.01;
        real want = f.value[TIMES - 1];
        for (int k = TIMES - 1; k > 0; k--)
            if (t < f.t[k])
                want = f.value[k - 1] + (t - f.t[k - 1]) / (f.t[k] - f.t[k - 1]) * (f.value[k] - f.value[k - 1]);
        if (t <= f.t[0]) want = f.value[0];
        assert_exact(time_function_value(&f, t), want);
    }
    memory_free(f.t), memory_free(f.value);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(columns_are_read_with_their_units),
        cmocka_unit_test(bad_files_are_refused),
        cmocka_unit_test(garbage_is_refused),
        cmocka_unit_test(long_tables_are_bisected),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
