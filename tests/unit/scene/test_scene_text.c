/* Tests scenes that are written out and read back bitwise, arbitrary bytes as scenes, and the help on keys. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <stdio.h>
#include <math.h>
#include <cmocka.h>

#include "base/memory.h"
#include "scene/scene_read.h"
#include "tests/support/scene_texts.h"

/* ---- round trip -------------------------------------------------------------------------------------------------- */

/* Checks that the scene a, written out and read back, has equal text and numbers, except for name and path. */
static void check_round_trip(const struct scene *a)
{
    struct scene b;
    if (scene_read_text(&b, a->text, strlen(a->text), "again.yaml", NULL, 0) != OK)
        fail_msg("%s in\n%s", status_message(), a->text);
    assert_string_equal(a->text, b.text);
    assert_true(a->materials == b.materials && a->bodies == b.bodies && a->cracks == b.cracks);
    assert_true(a->initials == b.initials && a->boundaries == b.boundaries && a->probes == b.probes);
    for (int k = 0; k < a->materials; k++) assert_memory_equal(&a->material[k], &b.material[k], sizeof *a->material);
    for (int k = 0; k < a->bodies; k++) {
        const struct region *p = &a->body[k].shape, *q = &b.body[k].shape;
        assert_int_equal(p->n, q->n);
        if (p->n) assert_memory_equal(p->solid, q->solid, (size_t)p->n * sizeof *p->solid);
    }
    for (int k = 0; k < a->cracks; k++)
        assert_memory_equal(a->crack[k].corner, b.crack[k].corner, (size_t)a->crack[k].n * sizeof *a->crack->corner);
    for (int k = 0; k < a->boundaries; k++) {
        assert_memory_equal(a->boundary[k].value, b.boundary[k].value, sizeof a->boundary->value);
        assert_int_equal(a->boundary[k].components, b.boundary[k].components);
        assert_memory_equal(&a->boundary[k].profile, &b.boundary[k].profile, sizeof a->boundary->profile);
    }
    assert_true(a->duration == b.duration && a->spacing == b.spacing && a->speed_window == b.speed_window);
    assert_true(a->surface == b.surface && a->thickness == b.thickness && a->section == b.section);
    scene_free(&b);
}

static void test_round_trip(void **state)
{
    (void)state;
    static const char *const texts[] = {plate, bar, rod, block, grown};
    for (size_t k = 0; k < COUNT_OF(texts); k++) {
        struct scene s = read_ok(texts[k], NULL, 0);
        check_round_trip(&s);
        scene_free(&s);
    }
    static const struct scene_override awkward[] = {{"bodies[2].particles", "\"gr\\u00e4 \\\"1\\\\ \\x01.csv\""},
                                                    {"particles.spacing", "1/3 mm"},
                                                    {"name", "\"__-\""}};
    struct scene s = read_ok(plate, awkward, 3);
    check_round_trip(&s);
    scene_free(&s);
}

/* ---- arbitrary bytes --------------------------------------------------------------------------------------------- */

/* Returns a pseudo-random number of 31 bits and advances *seed. */
static unsigned draw(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (unsigned)(*seed >> 33);
}

/* Changes some bytes of text[length] at random, or duplicates or removes a piece. *seed: state of the random numbers.
 * Returns the new length. */
static size_t mutate(char *text, size_t length, uint64_t *seed)
{
    static const char letters[] = "[]{}:,-&*!|>'\"#%@ \n\t\\0123456789.eE/inf_x\xc3\x00";
    for (unsigned k = draw(seed) % 4 + 1; k > 0; k--) {
        size_t at = draw(seed) % length, piece = draw(seed) % 40 + 1;
        if (at + piece > length) piece = length - at;
        switch (draw(seed) % 4) {
        case 0:
            text[at] = letters[draw(seed) % (sizeof letters - 1)];
            break;
        case 1:
            text[at] = (char)draw(seed);
            break;
        case 2:
            memmove(text + at + piece, text + at, length - at), length += piece;
            break;
        default:
            if (piece < length) memmove(text + at, text + at + piece, length - at - piece), length -= piece;
        }
    }
    return length;
}

static void test_mutations(void **state)
{
    (void)state;
    static const char *const texts[] = {plate, bar, block};
    uint64_t seed = 1;
    int accepted = 0, line, column;
    for (int k = 0; k < 20000; k++) {
        struct scene s;
        const char *text = texts[k % 3];
        size_t length = strlen(text);
        char *copy = test_malloc(length + 1000);
        memcpy(copy, text, length);
        length = mutate(copy, length, &seed);
        char *exact = test_malloc(length); /* exact size, so that reads beyond the end are detected */
        memcpy(exact, copy, length);
        status result = scene_read_text(&s, exact, length, "m.yaml", NULL, 0);
        if (result == OK) {
            if (accepted++ % 10 == 0) check_round_trip(&s);
            scene_free(&s);
        } else {
            assert_int_equal(result, REFUSED);
            assert_null(s.text);
            if (sscanf(status_message(), "m.yaml:%d:%d: ", &line, &column) != 2 || line < 1 || column < 1)
                fail_msg("no place in: %s", status_message());
            for (const char *next = status_message(); (next = strchr(next, '\n')) != NULL;)
                assert_int_equal(strncmp(++next, "m.yaml:", 7), 0); /* a line for each unknown key */
        }
        test_free(exact);
        test_free(copy);
    }
    assert_true(accepted > 100 && accepted < 19000);
}

/* ---- help -------------------------------------------------------------------------------------------------------- */

/* Returns the help on `key`, allocated, and asserts that its status is `expected`. */
static char *help_of(const char *key, status expected)
{
    char *text = NULL;
    size_t length;
    FILE *out = open_memstream(&text, &length);
    assert_int_equal(scene_print_help_on_keys(out, key), expected);
    fclose(out);
    return text;
}

static void test_help(void **state)
{
    (void)state;
    char *all = help_of(NULL, OK), *one = help_of("materials[0].young", OK), *some = help_of("mpm", OK);
    assert_non_null(strstr(all, "particles.horizon"));
    assert_non_null(strstr(one, "number [Pa]; > 0; required"));
    assert_null(strstr(one, "density"));
    assert_non_null(strstr(some, "mpm.cell"));
    assert_non_null(strstr(some, "number; 1 .. 8; default 2"));
    assert_null(strstr(some, "output"));
    free(all), free(one), free(some);
    free(help_of("yuong", REFUSED));
    assert_string_equal(status_message(), "yuong: unknown key; did you mean material.young?");
    char *text = NULL;
    size_t length;
    FILE *out = open_memstream(&text, &length);
    scene_print_keys_for_manual_page(out);
    fclose(out);
    assert_non_null(strstr(text, ".B particles.horizon\n"));
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_round_trip),
        cmocka_unit_test(test_mutations),
        cmocka_unit_test(test_help),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
