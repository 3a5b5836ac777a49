/* `test_numbers FILE...` prints the datasets of these HDF5 files that contain numbers which are not finite;
 * tests/support/summary.sh calls it for the frames of all scripts. Without a file it tests its own detection. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <cmocka.h>
#include <hdf5.h>

/* Returns the number of values in value[n] that are not finite. */
static hsize_t count_bad(const double *value, hsize_t n)
{
    hsize_t bad = 0;
    for (hsize_t k = 0; k < n; k++) bad += !isfinite(value[k]);
    return bad;
}

/* Reads all *n values of the dataset `list`. Returns them in memory to be freed; NULL if they are not real numbers. */
static double *numbers_of(hid_t list, hsize_t *n)
{
    const hid_t type = H5Dget_type(list), space = H5Dget_space(list);
    const hssize_t count = H5Sget_simple_extent_npoints(space);
    double *value = NULL;
    if (H5Tget_class(type) == H5T_FLOAT && count >= 0) {
        value = malloc(((size_t)count + 1) * sizeof *value);
        if (value && H5Dread(list, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, value) < 0)
            *value = NAN, *n = 1;
        else
            *n = (hsize_t)count;
    }
    H5Sclose(space);
    H5Tclose(type);
    return value;
}

struct search {
    const char *file;
    hsize_t bad, lists;
};

static herr_t sync_near(hid_t file, const char *name, const H5O_info_t *info, void *context)
{
    struct search *s = context;
    if (info->type != H5O_TYPE_DATASET) return 0;
    const hid_t list = H5Dopen2(file, name, H5P_DEFAULT);
    hsize_t n = 0;
    double *value = list < 0 ? NULL : numbers_of(list, &n);
    const hsize_t bad = value ? count_bad(value, n) : 0;
    if (bad > 0) printf("%s: %s holds %llu numbers that are none\n", s->file, name, (unsigned long long)bad);
    s->bad += bad, s->lists += value != NULL;
    free(value);
    if (list >= 0) H5Dclose(list);
    return 0;
}

/* Counts the values that are not finite in all datasets of the file `path`. A file that is not HDF5 has none. */
static struct search look_through(const char *path)
{
    struct search s = {.file = path};
    const hid_t file = H5Fopen(path, H5F_ACC_RDONLY, H5P_DEFAULT);
    if (file < 0) return s;
    H5Ovisit(file, H5_INDEX_NAME, H5_ITER_INC, sync_near, &s);
    H5Fclose(file);
    return s;
}

static void yaml_write_number_list(const char *path, double middle)
{
    const double value[3] = {1, middle, -1e300};
    const hsize_t count = 3;
    const hid_t file = H5Fcreate(path, H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT),
                space = H5Screate_simple(1, &count, NULL);
    const hid_t group = H5Gcreate2(file, "/inner", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    const hid_t list = H5Dcreate2(group, "list", H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    assert_true(H5Dwrite(list, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, value) >= 0);
    H5Dclose(list), H5Gclose(group), H5Sclose(space), H5Fclose(file);
}

static void what_is_none_is_found(void **state)
{
    char path[] = "/tmp/test_numbers.XXXXXX";
    const int fd = mkstemp(path);
    (void)state;
    assert_true(fd >= 0);
    close(fd);
    yaml_write_number_list(path, 0);
    assert_int_equal(look_through(path).bad, 0);
    assert_int_equal(look_through(path).lists, 1);
    yaml_write_number_list(path, NAN);
    assert_int_equal(look_through(path).bad, 1);
    yaml_write_number_list(path, INFINITY);
    assert_int_equal(look_through(path).bad, 1);
    unlink(path);
}

int main(int argc, char **argv)
{
    static const struct CMUnitTest tests[] = {cmocka_unit_test(what_is_none_is_found)};
    hsize_t bad = 0;
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    if (argc < 2) return cmocka_run_group_tests(tests, NULL, NULL);
    for (int k = 1; k < argc; k++) bad += look_through(argv[k]).bad;
    return bad > 0;
}
