/* Tests of the table of particle arrays, and of sorting, lists and images of particles. */
#include "tests/support/near.h"

#include <omp.h>

#include "data/particles.h"

enum { EVERYTHING = WITH_EVERYTHING };

/* Checks that every array of struct particles is in the table of fields exactly once, with its size. */
static void table_covers_the_struct(void **state)
{
    (void)state;
    size_t offset = offsetof(struct particles, X);
    for (int k = 0; k < particle_fields_count; k++) {
        assert_int_equal(particle_fields[k].offset, offset);
        offset += (size_t)particle_fields[k].count(DIM_MAX, EVERYTHING) * sizeof(void *);
        assert_true(strlen(particle_fields[k].unit) > 0 && strlen(particle_fields[k].meaning) > 0);
    }
    assert_int_equal(offset, sizeof(struct particles));
    for (int dim = 1; dim <= 3; dim++)
        for (int optional = 0; optional <= EVERYTHING; optional++) {
            struct particles p;
            particles_make(&p, dim, 5, optional);
            for (int k = 0; k < particle_fields_count; k++)
                for (int c = 0; c < particle_fields[k].count(3, EVERYTHING); c++) {
                    bool exists = c < particle_fields[k].count(dim, optional);
                    assert_int_equal(particle_field_array(&p, &particle_fields[k], c) != NULL, exists);
                }
            assert_ptr_equal(particle_field_array(&p, &particle_fields[0], dim - 1), p.X[dim - 1]);
            particles_free(&p);
            assert_null(p.X[0]);
        }
}

/* Checks that a lattice of 5 x 4 x 3 particles with round-off, in permuted order, is sorted row by row, and that the
 * entries of a particle stay together. */
static void sort_follows_rows(void **state)
{
    (void)state;
    enum { N = 60 };
    struct particles p;
    particles_make(&p, 3, N, EVERYTHING);
    for (int i = 0; i < N; i++) {
        int place = i * 37 % N, at[3] = {place % 5, place / 5 % 4, place / 20}; /* 37 and 60 have no common divisor */
        for (int d = 0; d < 3; d++) p.X[d][i] = 0.1 * at[d] + 1e-13 * ((i * 7 + d) % 11 - 5);
        p.id[i] = i;
        p.mass[i] = p.stress[5][i] = p.gradient[8][i] = p.stretch[2][i] = place;
        p.body[i] = (uint8_t)place;
        p.kind[i] = place % 3 == 0 ? KIND_PD : KIND_MPM;
    }
    particles_sort_by_lattice_rows(&p, 0.1, EVERYTHING);
    for (int i = 0; i < N; i++) {
        assert_exact(p.mass[i], i);
        assert_exact(p.stress[5][i], i);
        assert_exact(p.gradient[8][i], i);
        assert_exact(p.stretch[2][i], i);
        assert_int_equal(p.body[i], i);
        assert_int_equal(p.id[i] * 37 % N, i);
    }
    assert_int_equal(p.n_of[KIND_PD], 20);
    assert_int_equal(p.n_of[KIND_MPM], 40);
    for (int i = 0; i < 20; i++) assert_int_equal(p.list[KIND_PD][i], 3 * i);
    for (int i = 1; i < 40; i++) assert_true(p.list[KIND_MPM][i] > p.list[KIND_MPM][i - 1]);
    particles_free(&p);
}

static void equal_places_sort_by_id(void **state)
{
    (void)state;
    struct particles p;
    particles_make(&p, 1, 100, 0);
    for (int i = 0; i < 100; i++) p.id[i] = 99 - i;
    particles_sort_by_lattice_rows(&p, 1, 0);
    for (int i = 0; i < 100; i++) assert_int_equal(p.id[i], i);
    particles_free(&p);
}

static void images_are_added_behind(void **state)
{
    (void)state;
    struct particles p;
    particles_make(&p, 2, 10, WITH_STRETCH);
    for (int i = 0; i < 10; i++) p.X[1][i] = p.stretch[1][i] = i, p.flag[i] = (uint8_t)i;
    particles_extend_arrays_for_mirror_images(&p, 1000, WITH_STRETCH);
    assert_int_equal(p.n, 10);
    assert_int_equal(p.n_all, 1010);
    for (int i = 0; i < 1010 + LANES; i++) {
        assert_exact(p.X[1][i], i < 10 ? i : 0);
        assert_exact(p.stretch[1][i], i < 10 ? i : 0);
        assert_int_equal(p.flag[i], i < 10 ? i : 0);
    }
    assert_null(p.gradient[0]);
    particles_free(&p);
}

/* Checks that the coordinate range of particles includes mirror images only if they are counted in, and that
 * lattice_contains_coordinate accepts lattice positions with round-off and rejects a deviation of 1e-7 spacings. */
static void extent_and_sites(void **state)
{
    (void)state;
    enum { N = 3000 };
    struct particles p;
    real low, high, site;
    particles_make(&p, 2, N, 0);
    for (int i = 0; i < N; i++) p.X[0][i] = (i * 7919 % N) - 100, p.X[1][i] = 0.001 * i;
    particles_extend_arrays_for_mirror_images(&p, 1, 0);
    p.X[0][N] = -1e6;
    particles_coordinate_range(&p, p.n, 0, &low, &high);
    assert_exact(low, -100);
    assert_exact(high, N - 101);
    particles_coordinate_range(&p, p.n_all, 0, &low, &high);
    assert_exact(low, -1e6);
    assert_exact(particles_bounding_box_longest_edge(&p), N - 1);
    particles_coordinate_range(&p, 0, 1, &low, &high);
    assert_true(isinf(low) && isinf(high) && high < low);
    particles_free(&p);
    for (int k = -1000; k <= 1000; k++) { /* positions as a scene computes them: round-off is ignored */
        assert_true(lattice_contains_coordinate(0.3 + k * 1e-3, 0.3, 1e-3, &site));
        assert_exact(site, k);
        assert_false(lattice_contains_coordinate(0.3 + (k + 1e-7) * 1e-3, 0.3, 1e-3, &site));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(table_covers_the_struct), cmocka_unit_test(sort_follows_rows),
        cmocka_unit_test(equal_places_sort_by_id), cmocka_unit_test(images_are_added_behind),
        cmocka_unit_test(extent_and_sites),
    };
    omp_set_num_threads(2);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
