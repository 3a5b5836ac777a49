/* Tests of arrays (base/memory.h): zeros, alignment, growth. Exhausted memory is tested in test_ground.c. */
#include "tests/support/near.h"

#include "base/memory.h"

static void check_zero(void)
{
    const int64_t count[] = {0, 1, 63, 8192, 300001, 250000, 100000, 20000};
    for (size_t c = 0; c < COUNT_OF(count); c++) {
        real *array = NEW("test", count[c], real);
        assert_non_null(array);
        assert_int_equal((uintptr_t)array % 64, 0);
        for (int64_t i = 0; i < count[c]; i++) assert_exact(array[i], 0);
        memset(array, 0xff, (size_t)count[c] * sizeof *array); /* the next array must not contain it */
        memory_free(array);
    }
    memory_free(NULL);
}

/* Checks that new arrays are aligned to a cache line and zero, also when they reuse a larger block that was freed. */
static void memory_is_aligned_and_zero(void **state)
{
    (void)state;
    check_zero();
    memory_set_reuse_of_freed_arrays(true);
    for (int k = 0; k < 3; k++) check_zero();
    memory_set_reuse_of_freed_arrays(false);
}

static void memory_resize_keeps_what_fits(void **state)
{
    (void)state;
    int *array = memory_resize("test", NULL, 0, 3, sizeof *array);
    for (int i = 0; i < 3; i++) array[i] = i + 1;
    array = memory_resize("test", array, 3, 100000, sizeof *array);
    for (int i = 0; i < 100000; i++) assert_int_equal(array[i], i < 3 ? i + 1 : 0);
    array = memory_resize("test", array, 100000, 2, sizeof *array);
    assert_int_equal(array[0], 1);
    assert_int_equal(array[1], 2);
    memory_free(array);
}

/* Checks that the new elements are zero when an array grows within a block that another array has written before. */
static void memory_resize_clears_reused_blocks(void **state)
{
    (void)state;
    memory_set_reuse_of_freed_arrays(true);
    for (int64_t large = 1; large < 5; large++) {
        const int64_t most = large << 20, some = most / 2, more = most - 1000;
        char *array = NEW("test", most, char);
        memset(array, 0xff, (size_t)most);
        memory_free(array);
        array = NEW("test", some, char);
        memset(array, 1, (size_t)some);
        array = memory_resize("test", array, some, more, 1);
        for (int64_t i = 0; i < more; i++) assert_int_equal(array[i], i < some ? 1 : 0);
        memory_free(array);
    }
    memory_set_reuse_of_freed_arrays(false);
}

static void memory_grows(void **state)
{
    (void)state;
    int64_t *array = NULL;
    GROW("test", array, 0);
    assert_null(array);
    for (int64_t k = 0; k < 300000; k++) {
        GROW("test", array, k + 1);
        assert_int_equal(array[k], 0);
        array[k] = 3 * k;
    }
    for (int64_t k = 0; k < 300000; k++) assert_int_equal(array[k], 3 * k);
    const int64_t *before = array;
    GROW("test", array, 1000);
    assert_ptr_equal(array, before);
    memory_free(array);
    for (int way = 0; way < 3; way++) { /* arrays allocated by other functions */
        char *text = way == 0 ? memory_new("test", 5, 1) : memory_new_uninitialised("test", way == 1 ? 5 : 3, 1);
        if (way == 2) text = memory_resize_uninitialised("test", text, 3, 5, 1);
        memcpy(text, "abcde", 5);
        GROW("test", text, 6);
        assert_memory_equal(text, "abcde\0\0\0\0", 10); /* twice as long, with new elements zero */
        memory_free(text);
    }
    char *pages = memory_resize_uninitialised("test", memory_new_lazy_uninitialised("test", 2 << 20, 1), 2 << 20,
                                              3 << 20, 1),
         *same = pages;
    GROW("test", pages, 3 << 20);
    assert_ptr_equal(pages, same);
    memory_free(pages);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(memory_is_aligned_and_zero),
        cmocka_unit_test(memory_resize_keeps_what_fits),
        cmocka_unit_test(memory_resize_clears_reused_blocks),
        cmocka_unit_test(memory_grows),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
