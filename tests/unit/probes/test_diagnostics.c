/* Tests the balances of energy and momentum, the record of the first break, and the alarm for diverging particles. */
#include "tests/support/bodies.h"
#include "kernels/kernels.h"
#include "probes/diagnostics.h"

/* Checks energy and momentum against closed forms for v = (2, -1) plus a shear without momentum, and the recorded
 * errors of both balances: the largest error stays recorded. */
static void ledger_of_a_known_field(void **state)
{
    (void)state;
    struct body b;
    struct diagnostics w;
    body_make(&b, 2, (const int[]){40, 40}); /* more than one block of the sums */
    real kinetic = 0, moving = 0;
    for (int64_t i = 0; i < b.p.n; i++) {
        b.p.mass[i] = 3;
        b.p.v[0][i] = 2 + 0.1 * (b.p.X[1][i] - 20);
        b.p.v[1][i] = -1;
        kinetic += 1.5 * (square(b.p.v[0][i]) + 1);
        moving += 3 * hypot(b.p.v[0][i], 1);
    }
    diagnostics_initialise(&w);
    assert_near(particles_kinetic_energy(&b.p), kinetic, kinetic * ROUND_OFF);
    real none[DIM_MAX] = {0};
    diagnostics_update_momentum(&w, &b.p, NULL, 0, none);
    diagnostics_update_energy_balance(&w, 0, &(struct energy){.kinetic = kinetic}, 0);
    assert_near(w.now.momentum[0], 1600 * 3 * 2, 1e-9);
    assert_near(w.now.momentum[1], -1600 * 3, 1e-9);
    assert_near(w.now.balance_error, 0, 0);
    assert_near(w.now.momentum_error, 0, 0);

    /* An impulse and the work of a spring, both recorded by the loads. */
    for (int64_t i = 0; i < b.p.n; i++) b.p.v[1][i] = 1;
    real impulse[DIM_MAX] = {0, 1600 * 3 * 2, 0};
    diagnostics_update_momentum(&w, &b.p, NULL, 0, impulse);
    diagnostics_update_energy_balance(&w, 1, &(struct energy){.kinetic = kinetic, .strain = 2, .plastic = 3}, 5);
    assert_true(w.now.momentum_error < 1e-13);
    assert_true(fabs(w.now.balance_error) < ROUND_OFF);

    /* An error of momentum is detected and remains recorded; so does an error of energy. */
    impulse[1] -= 0.01 * moving;
    diagnostics_update_momentum(&w, &b.p, NULL, 0, impulse);
    diagnostics_update_energy_balance(&w, 2,
                                      &(struct energy){.kinetic = kinetic,
                                                       .strain = 0.03 * kinetic,
                                                       .plastic = 0.03 * kinetic,
                                                       .fracture = 0.03 * kinetic,
                                                       .contact = 0.01 * kinetic},
                                      0);
    assert_near(w.now.momentum_error, 0.01, 1e-12);
    assert_near(w.now.balance_error, 0.1 / 1.1, 1e-12);
    impulse[1] += 0.01 * moving;
    diagnostics_update_momentum(&w, &b.p, NULL, 0, impulse);
    diagnostics_update_energy_balance(&w, 3, &(struct energy){.kinetic = kinetic}, 0.2 * kinetic);
    assert_near(w.now.momentum_error, 0.01, 1e-12);
    assert_near(w.now.balance_error, -0.2 / 1.1, 1e-12);
    assert_near(w.now.time, 3, 0);
    body_free(&b);
}

/* An archive of at most 4 KiB in memory, read in the order of writing. */
struct tape {
    unsigned char byte[4096];
    size_t used;
};

static status tape_exchange(struct archive *a, const char *name, void *data, size_t size)
{
    (void)name;
    struct tape *t = a->file;
    assert_true(t->used + size <= sizeof t->byte);
    if (a->saving)
        memcpy(t->byte + t->used, data, size);
    else
        memcpy(data, t->byte + t->used, size);
    t->used += size;
    return OK;
}

/* Checks the errors of both balances of a body that was fast, is slow and then gains momentum. They are relative to the
 * largest sum of m |v| and to the largest energy so far, before and after a restart. */
static void ledger_survives_a_restart(void **state)
{
    (void)state;
    struct body b;
    struct diagnostics w, restored;
    struct tape tape = {.used = 0};
    struct archive out = {.saving = true, .exchange = tape_exchange, .file = &tape}, in = out;
    const real none[DIM_MAX] = {0};
    body_make(&b, 1, (const int[]){2});
    diagnostics_initialise(&w);
    diagnostics_initialise(&restored);
    for (int i = 0; i < 2; i++) b.p.mass[i] = 1, b.p.v[0][i] = i == 0 ? 10 : -10;
    diagnostics_update_momentum(&w, &b.p, NULL, 0, none);
    diagnostics_update_energy_balance(&w, 0, &(struct energy){.kinetic = 100}, 0);
    for (int i = 0; i < 2; i++) b.p.v[0][i] *= 0.1;
    diagnostics_update_momentum(&w, &b.p, NULL, 0, none);
    diagnostics_update_energy_balance(&w, 1, &(struct energy){.kinetic = 1, .strain = 99}, 0);
    assert_int_equal(diagnostics_save_or_load(&w, &out), OK);
    in.saving = false, tape.used = 0;
    assert_int_equal(diagnostics_save_or_load(&restored, &in), OK);
    b.p.v[0][0] += 2;
    for (int k = 0; k < 2; k++) {
        struct diagnostics *either = k == 0 ? &w : &restored;
        diagnostics_update_momentum(either, &b.p, NULL, 0, none);
        diagnostics_update_energy_balance(either, 2, &(struct energy){.kinetic = 1, .strain = 49}, 0);
        assert_near(either->now.momentum_error, 2.0 / 20, 1e-15);
        assert_near(either->now.balance_error, -0.5, 1e-15);
    }
    body_free(&b);
}

/* Checks the strain energy of material points, 1/2 e : C e V with shear counted twice, and half of it if bonds carry
 * half of the stress. */
static void strain_energy_of_material_points(void **state)
{
    (void)state;
    static const enum space space[DIM_MAX + 1] = {0, SPACE_LINE, SPACE_PLANE_STRAIN, SPACE_SOLID};
    const real strain[SYM_MAX] = {1e-3, -5e-4, 2e-4, 7e-4, -3e-4, 4e-4};
    for (int dim = 1; dim <= 3; dim++) {
        struct body b;
        struct material m = steel(space[dim]);
        int n = symmetric_tensor_component_count(dim);
        real C[SYM_MAX * SYM_MAX], stress[SYM_MAX] = {0}, density = 0, half[SYM_MAX * SYM_MAX] = {0};
        material_stiffness_matrix(&m, dim, C);
        for (int i = 0; i < n; i++) {
            for (int j = 0; j < n; j++) stress[i] += C[i * n + j] * strain[j];
            density += 0.5 * stress[i] * strain[i] * (i < dim ? 1 : 2);
            half[i * n + i] = 0.5;
        }
        body_make(&b, dim, (const int[]){10, 4, 3});
        for (int64_t k = 0; k < b.p.n; k++) {
            b.p.volume[k] = 2;
            for (int i = 0; i < n; i++) b.p.stress[i][k] = stress[i];
        }
        real whole = 2 * (real)b.p.n * density;
        assert_near(points_strain_energy(&b.p, &m, NULL), whole, 1e-12 * whole);
        int32_t *index = NEW("test.index", b.p.n, int32_t);
        for (int64_t k = 0; k < b.p.n; k++) index[k] = k < 5 ? 0 : -1;
        struct partial_stress partial = {.index = index, .matrix = half, .entries = 1};
        real expected = whole * (1 - 2.5 / (real)b.p.n);
        assert_near(points_strain_energy(&b.p, &m, &partial), expected, 1e-12 * whole);
        b.p.kind[0] = KIND_PD; /* its energy is in bonds */
        particles_rebuild_lists_by_kind(&b.p);
        assert_near(points_strain_energy(&b.p, &m, NULL), whole * (1 - 1 / (real)b.p.n), 1e-12 * whole);
        memory_free(index);
        body_free(&b);
    }
}

static void first_break_is_booked_once(void **state)
{
    (void)state;
    struct body b;
    struct diagnostics w;
    body_make(&b, 2, (const int[]){10, 10});
    diagnostics_initialise(&w);
    diagnostics_count_broken_bonds_and_record_first(&w, &b.p, 3.015, 0, 1);
    assert_true(isnan(w.break_time));
    b.p.flag[0] = FLAG_LOST_BOND; /* of a bond with a driven particle */
    diagnostics_count_broken_bonds_and_record_first(&w, &b.p, 3.015, 2, 2);
    assert_true(isnan(w.break_time));
    b.p.flag[particle_at(&b, 2.5, 3.5, 0)] |= FLAG_CRACKED;
    b.p.flag[particle_at(&b, 4.5, 4.5, 0)] |= FLAG_CRACKED;
    diagnostics_count_broken_bonds_and_record_first(&w, &b.p, 3.015, 4, 3);
    assert_near(w.break_time, 3, 0);
    assert_near(w.break_position[0], 3.5, ROUND_OFF);
    assert_near(w.break_position[1], 4, ROUND_OFF);
    b.p.flag[particle_at(&b, 8.5, 8.5, 0)] |= FLAG_CRACKED;
    diagnostics_count_broken_bonds_and_record_first(&w, &b.p, 3.015, 2, 4);
    assert_near(w.break_time, 3, 0);
    assert_near(w.break_position[0], 3.5, ROUND_OFF);
    assert_int_equal(w.bonds_broken, 8);

    assert_int_equal(w.break_ends, 1);
    assert_true(isnan(w.driven_time));
    b.p.flag[0] |= FLAG_DRIVEN;
    assert_true(diagnostics_count_broken_bonds_and_record_first(&w, &b.p, 3.015, 2, 5));
    assert_false(diagnostics_count_broken_bonds_and_record_first(&w, &b.p, 3.015, 2, 6));
    assert_near(w.driven_time, 5, 0);

    struct diagnostics other;
    diagnostics_initialise(&other);
    assert_false(diagnostics_count_broken_bonds_and_record_first(&other, &b.p, 2.2, 2, 1) && isnan(other.break_time));
    assert_int_equal(other.break_ends, 3); /* none of the three within 2.2 of another */
    assert_near(other.break_position[0], 8.5, ROUND_OFF);

    struct diagnostics again;
    struct store s = {0};
    struct archive a = {.saving = true, .exchange = store_exchange, .file = &s};
    diagnostics_initialise(&again);
    assert_ok(diagnostics_save_or_load(&w, &a));
    a.saving = false;
    assert_ok(diagnostics_save_or_load(&again, &a));
    assert_near(again.break_time, 3, 0);
    assert_int_equal(again.bonds_broken, 12);
    assert_near(again.driven_time, 5, 0);
    assert_int_equal(again.break_ends, 1);
    store_free(&s);
    body_free(&b);
}

static void alarm_names_the_first_runaway(void **state)
{
    (void)state;
    struct body b;
    body_make(&b, 2, (const int[]){60, 50});
    b.p.v[0][17] = 5000, b.p.v[1][17] = 1500; /* |v| = 5220.2 */
    assert_ok(diagnostics_check_particles_for_divergence(&b.p, true, true, 5232, 123, 4.1e-6));
    b.p.v[0][17] = 6.1e5, b.p.v[1][17] = 0;
    b.p.v[0][2500] = NAN;
    assert_int_equal(diagnostics_check_particles_for_divergence(&b.p, true, true, 5232, 123, 4.1e-6), FAILED);
    assert_string_equal(status_message(),
                        "unstable at step 123, t = 4.1e-06 s: particle 17 at (17.5, 0.5) m moves at 6.1e+05 m/s, "
                        "faster than the wave speed 5232 m/s");
    b.p.v[0][17] = 0;
    assert_failed(diagnostics_check_particles_for_divergence(&b.p, true, true, 5232, 123, 4.1e-6),
                  "particle 2500 at (40.5, 41.5) m has a position or velocity that is not a finite number");
    b.p.v[0][2500] = 0;
    b.p.x[1][2999] = INFINITY;
    assert_failed(diagnostics_check_particles_for_divergence(&b.p, true, true, 5232, 123, 4.1e-6), "particle 2999");
    body_free(&b);
}

/* Checks that the alarm considers exactly the listed particles, for contiguous lists, lists with gaps, and any length
 * modulo eight. */
static void alarm_sees_everybody_listed(void **state)
{
    (void)state;
    for (int dim = 1; dim <= DIM_MAX; dim++) {
        struct body b;
        body_make(&b, dim, (const int[]){dim == 1 ? 64 : 16, 4, 1});
        const real limit = 5000, diverged[3] = {1.0000001 * limit, -INFINITY, NAN};
        for (int64_t n = 0; n <= 40; n++)
            for (int64_t k = 0; k < 64; k++) {
                const bool gaps = n % 2; /* every other particle up to the 16th is left out */
                bool listed = false;
                b.p.n_of[KIND_PD] = 0;
                for (int64_t i = 0; b.p.n_of[KIND_PD] < n; i++) {
                    if (gaps && i < 16 && i % 2) continue;
                    b.p.list[KIND_PD][b.p.n_of[KIND_PD]++] = (int32_t)i;
                    listed = listed || i == k;
                }
                real *of = k % 3 == 1 ? &b.p.x[dim - 1][k] : &b.p.v[dim - 1][k], low_stress = *of;
                assert_false(particles_diverged(&b.p, b.p.list[KIND_PD], n, limit));
                *of = diverged[k % 3];
                assert_int_equal(particles_diverged(&b.p, b.p.list[KIND_PD], n, limit), listed);
                *of = k % 3 == 1 ? 1e300 : 0.9999999 * limit;
                assert_false(particles_diverged(&b.p, b.p.list[KIND_PD], n, limit));
                *of = low_stress;
            }
        body_free(&b);
    }
}

/* Checks short lists whose first and last particle are as far apart as in eight consecutive particles: an unlisted
 * particle between them must be ignored. */
static void alarm_passes_gaps_at_the_end(void **state)
{
    (void)state;
    struct body b;
    body_make(&b, 2, (const int[]){16, 4, 1});
    b.p.v[0][3] = NAN;
    for (int n = 2; n <= 7; n++) {
        for (int k = 0; k < n - 1; k++) b.p.list[KIND_PD][k] = k < 3 ? k : k + 1;
        b.p.list[KIND_PD][n - 1] = 7;
        assert_false(particles_diverged(&b.p, b.p.list[KIND_PD], n, 5000));
    }
    body_free(&b);
}

/* Checks yielded points in plane strain of two materials: elastic energy by Hooke's law in 3D with the out-of-plane
 * stress, and plastic work times the initial volume. */
static void energies_of_yielded_points(void **state)
{
    (void)state;
    struct material m[2] = {{.young = 200, .poisson = 0.3, .density = 1}, {.young = 70, .poisson = 0.2, .density = 1}};
    struct particles p;
    real elastic = 0, plastic = 0;
    for (int k = 0; k < 2; k++) material_compute_derived_constants(&m[k], SPACE_PLANE_STRAIN);
    particles_make(&p, 2, 7, WITH_PLASTIC | WITH_OUT_OF_PLANE);
    for (int64_t i = 0; i < p.n; i++) {
        const struct material *own = &m[i % 2];
        const real E = own->young, nu = own->poisson, work = 0.002 * (real)i, volume = 0.37 + 0.1 * (real)i;
        const real xx = 0.3 - 0.1 * (real)i, yy = 0.05 * (real)i, xy = 0.2, delta = 0.03 * (real)(i - 2);
        const real zz = nu * (xx + yy) + delta;
        p.kind[i] = KIND_MPM, p.material[i] = (uint8_t)(i % 2), p.id[i] = (int32_t)i;
        p.volume[i] = volume, p.volume0[i] = 1.2 * volume, p.flag[i] = i == 3 ? FLAG_MESHED : 0;
        p.stress[0][i] = xx, p.stress[1][i] = yy, p.stress[2][i] = xy;
        p.out_of_plane[i] = delta, p.plastic_work[i] = work;
        const real squares = xx * xx + yy * yy + zz * zz - 2 * nu * (xx * yy + yy * zz + zz * xx);
        if (i != 3) elastic += volume * (0.5 / E * squares + (1 + nu) / E * xy * xy);
        plastic += 1.2 * volume * work;
    }
    particles_rebuild_lists_by_kind(&p);
    assert_close(points_strain_energy(&p, m, NULL), elastic, 1e-12);
    assert_close(points_plastic_work(&p, m, NULL), plastic, 1e-12);
    particles_free(&p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ledger_of_a_known_field),          cmocka_unit_test(ledger_survives_a_restart),
        cmocka_unit_test(strain_energy_of_material_points), cmocka_unit_test(energies_of_yielded_points),
        cmocka_unit_test(first_break_is_booked_once),       cmocka_unit_test(alarm_names_the_first_runaway),
        cmocka_unit_test(alarm_sees_everybody_listed),      cmocka_unit_test(alarm_passes_gaps_at_the_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
