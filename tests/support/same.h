/* Compares two sets of particles bit by bit, for tests. */
#ifndef CLEAVE_TESTS_SAME
#define CLEAVE_TESTS_SAME

#include "near.h"
#include "data/particles.h"

/* Asserts that the particles a and b are equal in number and bitwise in all their arrays. optional: sum of the WITH_*
 * whose optional arrays both have. */
static inline void assert_same_particles(const struct particles *a, const struct particles *b, int optional)
{
    assert_int_equal(a->n, b->n);
    for (int f = 0; f < particle_fields_count; f++)
        for (int k = 0; k < particle_fields[f].count(a->dim, optional); k++)
            assert_memory_equal(particle_field_array(a, &particle_fields[f], k),
                                particle_field_array(b, &particle_fields[f], k),
                                (size_t)a->n * particle_fields[f].size);
}

#endif
