/* Tests plastic flow of points of a mesh (mesh_flow.h). Forces must be the gradient of one incremental energy from any
 * plastic state, the sum of strain energy and plastic work in the energy balance. Without yielding, results must be
 * elastic. Load steps are also checked with flow laws; explicit steps must close the energy balance to round-off. */
#include "tests/support/mesh_block.h"

#include "data/material.h"

enum { FLOWED = WITH_PLASTIC | WITH_OUT_OF_PLANE | WITH_PLASTIC_CORRECTION };
enum { STATES = 3 + 2 * SYM_MAX };
static const enum space flow_spaces[] = {SPACE_LINE, SPACE_PLANE_STRESS, SPACE_PLANE_STRAIN, SPACE_SOLID};

/* Returns true if the points of a cell share one mean dilatation in the space `space`. */
static bool averages(enum space space) { return space == SPACE_PLANE_STRAIN || space == SPACE_SOLID; }

/* Creates in `space` the block b. Its points yield at `yield` times the shear modulus; material 1 hardens linearly.
 * optional: optional arrays of particles (WITH_*). */
static void flow_block_make(struct block *b, enum space space, real yield, int optional)
{
    block_make_with(b, space, true, false, FLOWED | optional);
    if (averages(space)) block_average(b, yield < 1);
    if (space != SPACE_PLANE_STRAIN) memory_free(b->c.p.out_of_plane), b->c.p.out_of_plane = NULL;
    for (int m = 0; m < CLOUD_MATERIALS; m++) {
        struct elastic *k = &b->elastic[m];
        const struct material *own = &b->c.material[m];
        const real shear = space == SPACE_LINE ? 0.4 * k->c11 : k->shear;
        b->law[m] = (struct law){.given = true, .flow = FLOW_LINEAR, .hardening = m > 0 ? 0.1 * shear : 0};
        flow_law_compute_derived_constants(&b->law[m], yield * shear, own->young, own->poisson, k->shear, own->density);
        k->law = &b->law[m], k->mode = LAW_LOAD_STEP, k->poisson = own->poisson;
    }
}

/* Creates in `space` the block b. Material 0 has Voce's law and a back stress, with recall if `recall` > 0; so does
 * material 1 in explicit steps, else it has linear hardening. mode: time integration of the law. */
static void law_block_make(struct block *b, enum space space, real recall, enum law_mode mode)
{
    flow_block_make(b, space, 0.05, WITH_BACK_STRESS | (mode == LAW_EXPLICIT ? WITH_MESH_STRESS : 0));
    for (int m = 0; m < (mode == LAW_EXPLICIT ? CLOUD_MATERIALS : 1); m++) {
        struct law *law = &b->law[m];
        law->flow = FLOW_VOCE, law->voce.saturation = 0.6 * law->yield, law->voce.rate = 20;
        law->kinematic.modulus = 3 * law->yield, law->kinematic.recall = recall;
        b->elastic[m].mode = mode;
    }
}

/* Lists the arrays of the plastic state of the block b in array[]. Returns their number. */
static int states_of(const struct block *b, real *array[STATES])
{
    int n = 0;
    array[n++] = b->c.p.plastic_strain;
    if (b->c.p.out_of_plane) array[n++] = b->c.p.out_of_plane;
    if (b->c.p.plastic_work) array[n++] = b->c.p.plastic_work;
    for (int k = 0; k < symmetric_tensor_component_count(b->c.p.dim); k++) {
        array[n++] = b->c.p.plastic_correction[k];
        if (b->c.p.back_stress[0]) array[n++] = b->c.p.back_stress[k];
    }
    return n;
}

static void states_copy(const struct block *b, real *kept, bool back)
{
    real *array[STATES];
    const int64_t n = b->c.p.n;
    for (int k = 0, all = states_of(b, array); k < all; k++)
        memcpy(back ? array[k] : kept + k * n, back ? kept + k * n : array[k], (size_t)n * sizeof(real));
}

/* Returns the incremental energy of the block b from the plastic state `kept`: strain energy plus plastic work [J].
 * Leaves the plastic state of the end in b. finite: true for finite strain. */
static real incremental_energy(struct block *b, real *kept, bool finite)
{
    real sum = 0;
    states_copy(b, kept, true);
    forces(b, finite);
    for (int64_t i = 0; i < b->c.p.n; i++) {
        if (b->mesh.place[i] >= 0) sum += b->mesh.volume * b->c.p.plastic_work[i];
    }
    return sum + mesh_strain(&b->mesh, &b->c.p, b->elastic, finite);
}

static int64_t flowed(const struct block *b)
{
    int64_t n = 0;
    for (int64_t i = 0; i < b->c.p.n; i++) n += b->c.p.plastic_strain[i] > 0;
    return n;
}

/* Checks in `space` the nodal force f = -dW/du by central differences at some nodes, from a plastic state that another
 * path has left. finite: true for finite strain; law: true for the laws of law_block_make. Tolerance 1e-5 of the
 * largest force: where a point starts to yield within the step, the jump of its second derivative adds 1e-6. */
static void flow_gradient_of(enum space space, bool finite, bool law)
{
    struct block b;
    if (law)
        law_block_make(&b, space, 0, LAW_LOAD_STEP);
    else
        flow_block_make(&b, space, 0.05, 0);
    const int64_t n = b.c.p.n;
    real *kept = NEW("test.kept", STATES * n, real), *force[DIM_MAX];
    shake(&b, 0.15, 5);
    incremental_energy(&b, kept, finite);
    assert_true(flowed(&b) > n / 4);
    states_copy(&b, kept, false);
    shake(&b, 0.17, 9);
    incremental_energy(&b, kept, finite);
    const real scale = largest_force(&b), step = 1e-5 * CLOUD_SPACING;
    for (int d = 0; d < b.c.p.dim; d++) {
        force[d] = NEW("test.force", b.mesh.grid.n, real);
        memcpy(force[d], b.mesh.grid.force[d], (size_t)b.mesh.grid.n * sizeof(real));
    }
    for (int64_t I = 0, checked = 0; I < b.mesh.grid.n && checked < 12; I += b.mesh.grid.n / 20 + 1)
        for (int d = 0; d < b.c.p.dim && b.mesh.grid.mass[I] > 0; d++, checked++) {
            real *u = &b.mesh.displacement[d][I];
            *u += step;
            const real more = incremental_energy(&b, kept, finite);
            *u -= 2 * step;
            const real less = incremental_energy(&b, kept, finite);
            *u += step;
            assert_near(force[d][I], -(more - less) / (2 * step), 1e-5 * scale);
        }
    for (int d = 0; d < b.c.p.dim; d++) memory_free(force[d]);
    memory_free(kept);
    block_free(&b);
}

static void test_flow_gradient(void **state)
{
    (void)state;
    for (unsigned s = 0; s < COUNT_OF(flow_spaces); s++)
        for (int finite = 0; finite < 2; finite++)
            for (int law = 0; law < 2; law++) flow_gradient_of(flow_spaces[s], finite, law);
}

/* Checks that points that never reach their yield stress have the forces and energies of elastic cells, which are
 * computed by other closed forms. */
static void test_flow_elastic(void **state)
{
    (void)state;
    for (unsigned s = 0; s < COUNT_OF(flow_spaces); s++)
        for (int finite = 0; finite < 2; finite++) {
            struct block by_points, closed;
            flow_block_make(&by_points, flow_spaces[s], 1e6, 0);
            block_make(&closed, flow_spaces[s], true, false);
            if (averages(flow_spaces[s])) block_average(&closed, false);
            shake(&by_points, 0.15, 5), shake(&closed, 0.15, 5);
            forces(&by_points, finite), forces(&closed, finite);
            assert_int_equal(flowed(&by_points), 0);
            const real scale = largest_force(&closed);
            for (int64_t I = 0; I < closed.mesh.grid.n; I++)
                for (int d = 0; d < closed.c.p.dim; d++)
                    assert_near(by_points.mesh.grid.force[d][I], closed.mesh.grid.force[d][I], 1e-12 * scale);
            assert_close(mesh_strain(&by_points.mesh, &by_points.c.p, by_points.elastic, finite),
                         mesh_strain(&closed.mesh, &closed.c.p, closed.elastic, finite), 1e-12);
            block_free(&by_points), block_free(&closed);
        }
}

/* Checks a loading path and its repetition, in which all points are on the yield surface and energy and force stay the
 * same. A rotation does not change the energy; unloading is elastic, without further plastic strain. */
static void test_flow_state(void **state)
{
    (void)state;
    struct block b;
    flow_block_make(&b, SPACE_PLANE_STRAIN, 0.05, 0);
    real *kept = NEW("test.kept", STATES * b.c.p.n, real);
    rotation(&b, 0.3, 0.2);
    const real first = incremental_energy(&b, kept, true);
    const real most = largest_force(&b), strain = b.c.p.plastic_strain[b.c.p.n - 1];
    assert_true(strain > 0.05);
    states_copy(&b, kept, false);
    assert_close(incremental_energy(&b, kept, true), first, 1e-12);
    assert_close(largest_force(&b), most, 1e-12);
    rotation(&b, 0.9, 0.2);
    assert_close(incremental_energy(&b, kept, true), first, 1e-12); /* unchanged by rotation */
    rotation(&b, 0.3, 0.19);
    incremental_energy(&b, kept, true);
    assert_close(b.c.p.plastic_strain[b.c.p.n - 1], strain, 1e-12);
    memory_free(kept);
    block_free(&b);
}

/* Checks explicit steps of random motion at small strain. The work of the mean forces of each step on its displacements
 * must equal strain energy plus plastic work, to round-off, 1e-14 of the sum of magnitudes. */
static void test_flow_energy(void **state)
{
    (void)state;
    for (unsigned s = 0; s < COUNT_OF(flow_spaces); s++) {
        struct block b;
        law_block_make(&b, flow_spaces[s], 2, LAW_EXPLICIT);
        const int64_t nodes = b.mesh.grid.n;
        const int dim = b.c.p.dim;
        real work = 0, moved = 0, plastic = 0, *u = NEW("test.u", nodes * dim, real),
             *f = NEW("test.f", nodes * dim, real);
        for (int step = 1; step <= 40; step++) {
            for (int d = 0; d < dim; d++) memcpy(u + d * nodes, b.mesh.displacement[d], (size_t)nodes * sizeof(real));
            for (int d = 0; d < dim; d++) memcpy(f + d * nodes, b.mesh.grid.force[d], (size_t)nodes * sizeof(real));
            shake(&b, 0.1, (uint64_t)step);
            mesh_points_flow(&b.mesh, &b.c.p, b.elastic, 1e-6, false);
            forces(&b, false);
            for (int d = 0; d < dim; d++)
                for (int64_t I = 0; I < nodes; I++) {
                    const real by = b.mesh.displacement[d][I] - u[d * nodes + I];
                    const real one = -0.5 * (f[d * nodes + I] + b.mesh.grid.force[d][I]) * by;
                    work += one, moved += fabs(one);
                }
        }
        for (int64_t i = 0; i < b.c.p.n; i++)
            if (b.mesh.place[i] >= 0) plastic += b.mesh.volume * b.c.p.plastic_work[i];
        assert_true(flowed(&b) > b.c.p.n / 2);
        assert_near(work, plastic + mesh_strain(&b.mesh, &b.c.p, b.elastic, false), 1e-14 * moved);
        memory_free(u), memory_free(f);
        block_free(&b);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_flow_gradient),
        cmocka_unit_test(test_flow_elastic),
        cmocka_unit_test(test_flow_state),
        cmocka_unit_test(test_flow_energy),
    };
    int failures = 0;
    FOR_EVERY_SET failures += cmocka_run_group_tests(tests, NULL, NULL);
    return failures;
}
