/* Tests the mesh of the reference frame against plain sums over its points. Forces must be the gradient of the energy;
 * uniform strain and rotation must cause no force; momenta must be conserved. Also checks conversion of points, the
 * critical time step, and velocity updates with the matched inertia of cells. */
#include "tests/support/mesh_block.h"

#include "coupling/conversion.h"

/* Checks in `space` the nodal forces of a block, f = -dW/du, by central differences of the plain energy of the cells
 * around each node. finite: true for finite strain; cubic: true for a cubic material; averaged: 1: the points of a cell
 * share one mean dilatation, 2: also with several materials in a cell. Tolerance 1e-7 of the largest force: third
 * derivatives times the squared step, and round-off of the energy over the step. */
static void gradient_stencil_apply(enum space space, bool finite, bool cubic, int averaged)
{
    struct block b;
    block_make(&b, space, true, cubic);
    if (averaged) block_average(&b, averaged > 1);
    shake(&b, 0.15, 5);
    forces(&b, finite);
    const real scale = largest_force(&b), step = 1e-4 * CLOUD_SPACING;
    const real energy = plain_energy(&b, finite);
    assert_close(mesh_strain(&b.mesh, &b.c.p, b.elastic, finite), energy, 1e-12);
    for (int64_t I = 0; I < b.mesh.grid.n; I++)
        for (int d = 0; d < b.c.p.dim; d++) {
            real *u = &b.mesh.displacement[d][I], W[2] = {0};
            if (b.mesh.grid.mass[I] == 0) {
                assert_exact(b.mesh.grid.force[d][I], 0);
                continue;
            }
            for (int side = 0; side < 2; side++) {
                *u += side ? -2 * step : step;
                for (int64_t particle = 0; particle < b.c.p.n; particle++) {
                    bool near = b.mesh.place[particle] >= 0;
                    for (int c = 0, touches = 0; c < 1 << b.c.p.dim && near; c++) {
                        touches += (b.mesh.place[particle] >> b.c.p.dim) + b.mesh.corner[c] == I;
                        if (c + 1 == 1 << b.c.p.dim) near = touches > 0;
                    }
                    if (near) W[side] += point_energy(&b, particle, finite);
                }
            }
            *u += step;
            assert_near(b.mesh.grid.force[d][I], -(W[0] - W[1]) / (2 * step), 1e-7 * scale);
        }
    block_free(&b);
}

static void test_gradient(void **state)
{
    (void)state;
    for (unsigned s = 0; s < COUNT_OF(spaces); s++)
        for (int finite = 0; finite < 2; finite++) gradient_stencil_apply(spaces[s], finite, false, 0);
    gradient_stencil_apply(SPACE_PLANE_STRESS, true, true, 0); /* constants of a lattice, anisotropic */
    gradient_stencil_apply(SPACE_SOLID, true, true, 0);
    for (unsigned s = 1; s < COUNT_OF(spaces); s++)
        for (int averaged = 1; averaged < 3; averaged++) {
            gradient_stencil_apply(spaces[s], false, true, averaged);
            gradient_stencil_apply(spaces[s], true, false, averaged);
        }
}

/* Checks that the closed form of complete cells and the stiffness of incomplete ones equal the sums over their points,
 * to round-off. */
static void test_whole_and_cut(void **state)
{
    (void)state;
    for (unsigned s = 0; s < COUNT_OF(spaces); s++)
        for (int finite = 0; finite < 4; finite++) { /* 2, 3: with one dilatation in a cell */
            struct block b;
            block_make(&b, spaces[s], false, true);
            if (finite > 1) block_average(&b, false);
            shake(&b, 0.2, 11);
            forces(&b, finite % 2);
            real *whole[DIM_MAX];
            for (int d = 0; d < b.c.p.dim; d++) {
                whole[d] = NEW("test.whole", b.mesh.grid.n, real);
                memcpy(whole[d], b.mesh.grid.force[d], sizeof(real) * (size_t)b.mesh.grid.n);
            }
            struct partial_stress nothing; /* zero partial stresses, with which no cell counts as complete */
            partial_of(&nothing, &b.c.p, b.c.material, 0);
            b.source.partial = &nothing;
            mesh_remove_points_and_return_lost_energy(&b.mesh, &b.c.p, &b.source, NULL, 0);
            assert_int_equal(b.mesh.runs, 0);
            forces(&b, finite % 2);
            for (int64_t I = 0; I < b.mesh.grid.n; I++)
                for (int d = 0; d < b.c.p.dim; d++)
                    assert_near(b.mesh.grid.force[d][I], whole[d][I],
                                1e-13 * b.elastic[0].c11 * b.mesh.volume / CLOUD_SPACING);
            partial_stress_free(&nothing);
            for (int d = 0; d < b.c.p.dim; d++) memory_free(whole[d]);
            block_free(&b);
        }
}

/* Computes P, the stress that point i of b contributes at small strain by its own motion: C : e minus the part carried
 * by bonds (`partial`), without its antisymmetric part. e is the strain with the trace of point_trace. */
static void given_own(const struct block *b, const struct partial_stress *partial, int64_t i, real *P)
{
    const struct mesh *mesh = &b->mesh;
    const int dim = b->c.p.dim, n = symmetric_tensor_component_count(dim), place = mesh->place[i] & ((1 << dim) - 1);
    const struct elastic *m = &b->elastic[b->c.p.material[i]];
    const bool leaves = partial->index[i] >= 0;
    real g[9] = {0}, s[SYM_MAX], trace = 0;
    for (int a = 0; a < dim; a++)
        for (int k = 0; k < dim; k++)
            for (int c = 0; c < 1 << dim; c++)
                g[a * dim + k] += mesh_shape_function_derivative(dim, c, place, k) / mesh->grid.h *
                                  mesh->displacement[a][(mesh->place[i] >> dim) + mesh->corner[c]];
    for (int a = 0; a < dim; a++) trace += g[a * dim + a];
    for (int a = 0; a < dim; a++) g[a * dim + a] += (point_trace(b, i, false) - trace) / dim;
    trace = point_trace(b, i, false);
    for (int k = 0; k < n; k++) {
        int a, d;
        symmetric_tensor_component_axes(dim, k, &a, &d);
        s[k] =
            a == d ? (m->c11 - m->c12) * g[a * dim + a] + m->c12 * trace : m->shear * (g[a * dim + d] + g[d * dim + a]);
    }
    for (int k = 0; k < n; k++) {
        int a, d;
        symmetric_tensor_component_axes(dim, k, &a, &d);
        P[a * dim + d] = P[d * dim + a] = s[k] - (leaves ? dot(partial->matrix + (i * n + k) * n, s, n) : 0);
    }
}

/* Computes P, the stress that point i of b contributes at small strain. As given_own, but the mean stress is the mean
 * over the points of the cell and material where these share one dilatation. partial: partial stresses. */
static void given(const struct block *b, const struct partial_stress *partial, int64_t i, real *P)
{
    const struct particles *p = &b->c.p;
    real pressure = 0, own = 0;
    int n = 0;
    for (int q = 0; q < 1 << p->dim && b->elastic[p->material[i]].mean_dilatation; q++) {
        const int64_t j = b->mesh.point[(b->mesh.place[i] >> p->dim << p->dim) + q];
        if (j < 0 || p->material[j] != p->material[i]) continue;
        given_own(b, partial, j, P);
        n++;
        for (int d = 0; d < p->dim; d++) pressure += P[d * (p->dim + 1)] / p->dim;
    }
    given_own(b, partial, i, P);
    for (int d = 0; d < p->dim; d++) own += P[d * (p->dim + 1)] / p->dim;
    for (int d = 0; d < p->dim && n > 0; d++) P[d * (p->dim + 1)] += pressure / n - own;
}

/* Compares nodal forces of cells that store their own stiffness with sums of V P grad N over points, for a random
 * partial stress that derives from an energy. Tolerance: round-off of a few hundred terms. The stiffness is also
 * updated for single points whose partial stress changes. */
static void test_partial(void **state)
{
    (void)state;
    for (unsigned round = 0; round < 3 * COUNT_OF(spaces); round++) {
        struct block b;
        struct partial_stress partial;
        block_make(&b, spaces[round / 3], true, false);
        if (round % 3) block_average(&b, round % 3 > 1); /* with one dilatation in a cell; and with several materials */
        const struct particles *p = &b.c.p;
        const int dim = p->dim, n = symmetric_tensor_component_count(dim);
        partial_of(&partial, p, b.c.material, 0.2);
        int32_t changed[2] = {-1, -1};
        for (int64_t i = 0; i < p->n; i++) {
            if (i % 3)
                partial.index[i] = -1;
            else if (b.mesh.place[i] >= 0)
                changed[i % 2] = (int32_t)i;
        }
        b.source.partial = &partial;
        mesh_remove_points_and_return_lost_energy(&b.mesh, &b.c.p, &b.source, NULL, 0);
        for (int k = 0; k < n * n; k++) partial.matrix[changed[0] * n * n + k] *= -0.5;
        partial.index[changed[1]] = -1;
        assert_true(dim > 1 || !mesh_try_update_stiffness_for_partial_stress(&b.mesh, &b.c.p, &b.source, changed,
                                                                             2)); /* one cut cell less */
        mesh_remove_points_and_return_lost_energy(&b.mesh, &b.c.p, &b.source, changed, 2);
        for (int k = 0; k < n * n; k++) partial.matrix[changed[0] * n * n + k] *= 0.7;
        assert_true(mesh_try_update_stiffness_for_partial_stress(&b.mesh, &b.c.p, &b.source, changed, 1));
        shake(&b, 0.2, 23);
        forces(&b, false);
        for (int64_t i = 0; i < p->n; i++) {
            real P[9];
            if (b.mesh.place[i] < 0) continue;
            given(&b, &partial, i, P);
            for (int c = 0; c < 1 << dim; c++)
                for (int a = 0; a < dim; a++)
                    for (int k = 0; k < dim; k++)
                        b.mesh.grid.force[a][(b.mesh.place[i] >> dim) + b.mesh.corner[c]] +=
                            b.mesh.volume * P[a * dim + k] *
                            mesh_shape_function_derivative(dim, c, b.mesh.place[i] & ((1 << dim) - 1), k) /
                            b.mesh.grid.h;
        }
        assert_near(largest_force(&b), 0, 1e-13 * b.elastic[0].c11 * b.mesh.volume / CLOUD_SPACING);
        partial_stress_free(&partial);
        block_free(&b);
    }
}

/* Checks that uniform strain causes no force at inner nodes, for complete and incomplete cells, up to round-off of sums
 * of stresses times faces. Inner nodes are those whose neighbours all have their full mass. */
static void test_patch(void **state)
{
    (void)state;
    for (unsigned s = 0; s < COUNT_OF(spaces); s++)
        for (int finite = 0; finite < 2; finite++) {
            struct block b;
            block_make(&b, spaces[s], false, false);
            rotation(&b, finite ? 0.7 : 0, 0.01);
            forces(&b, finite);
            real full = 0;
            int inside = 0;
            for (int64_t I = 0; I < b.mesh.grid.n; I++) full = real_max(full, b.mesh.grid.mass[I]);
            const real scale = b.elastic[0].c11 * 0.01 * b.mesh.volume / CLOUD_SPACING;
            assert_true(largest_force(&b) > 0.1 * scale); /* check: the edges have forces */
            for (int64_t I = 0; I < b.mesh.grid.n; I++) {
                if (b.mesh.grid.mass[I] < full * (1 - 1e-12)) continue;
                inside++;
                for (int d = 0; d < b.c.p.dim; d++) assert_near(b.mesh.grid.force[d][I], 0, 1e-11 * scale);
            }
            assert_true(inside > 8);
            block_free(&b);
        }
}

/* Checks that a rotation causes no force at finite strain, and that any displacement causes neither a resultant force
 * nor a moment on the whole body, to 1e-13 of the terms. At small strain only the resultant force vanishes. */
static void test_momentum(void **state)
{
    (void)state;
    for (unsigned s = 1; s < COUNT_OF(spaces); s++)
        for (int finite = 0; finite < 2; finite++) {
            struct block b;
            block_make(&b, spaces[s], true, true);
            if (finite) {
                rotation(&b, 2.5, 0);
                forces(&b, true);
                assert_near(largest_force(&b), 0, 1e-13 * b.elastic[0].c11 * b.mesh.volume / CLOUD_SPACING);
            }
            shake(&b, 0.25, 3);
            forces(&b, finite);
            real sum[DIM_MAX] = {0}, moment = 0, scale = 0, arms = 0;
            for (int64_t I = 0; I < b.mesh.grid.n; I++) {
                real x[2];
                for (int d = 0; d < b.c.p.dim; d++)
                    sum[d] += b.mesh.grid.force[d][I], scale += fabs(b.mesh.grid.force[d][I]);
                for (int d = 0; d < 2; d++) x[d] = node_place(&b.mesh, I, d) + b.mesh.displacement[d][I];
                moment += x[0] * b.mesh.grid.force[1][I] - x[1] * b.mesh.grid.force[0][I];
                arms += fabs(x[0] * b.mesh.grid.force[1][I]) + fabs(x[1] * b.mesh.grid.force[0][I]);
            }
            for (int d = 0; d < b.c.p.dim; d++) assert_near(sum[d], 0, 1e-13 * scale);
            if (finite)
                assert_near(moment, 0, 1e-13 * arms);
            else
                assert_true(fabs(moment) > 1e-6 * arms);
            block_free(&b);
        }
}

/* Checks that the least-squares projection from points to nodes reproduces a linear velocity field at the nodes.
 * Tolerance: residual of the solver times the condition number of the mass matrix. */
static void test_start(void **state)
{
    (void)state;
    for (unsigned s = 0; s < COUNT_OF(spaces); s++) {
        struct block b;
        block_make(&b, spaces[s], true, false);
        struct particles *p = &b.c.p;
        for (int64_t i = 0; i < p->n; i++)
            for (int d = 0; d < p->dim; d++) p->v[d][i] = 3 + 1000 * p->X[0][i] - (p->dim > 1 ? 400 * p->X[1][i] : 0);
        mesh_fit_nodal_values_to_point_values(&b.mesh, p, p->v, b.mesh.grid.velocity);
        for (int64_t I = 0; I < b.mesh.grid.n; I++) {
            if (b.mesh.grid.mass[I] == 0) continue;
            const real exact =
                3 + 1000 * node_place(&b.mesh, I, 0) - (p->dim > 1 ? 400 * node_place(&b.mesh, I, 1) : 0);
            assert_near(b.mesh.grid.velocity[0][I], exact, 1e-9 * 20);
        }
        block_free(&b);
    }
}

/* Checks points that become peridynamic: mass, momentum and energy of points and nodes add up to those before, and the
 * nodes that remain equal those of a mesh made of the other points. */
static void test_release(void **state)
{
    (void)state;
    for (unsigned s = 0; s < COUNT_OF(spaces); s++) {
        struct block b, fresh;
        block_make(&b, spaces[s], false, false);
        block_make(&fresh, spaces[s], true, false);
        struct particles *p = &b.c.p;
        uint64_t seed = 9;
        for (int64_t I = 0; I < b.mesh.grid.n; I++)
            b.mesh.grid.velocity[0][I] = b.mesh.grid.mass[I] > 0 ? cloud_random(&seed) : 0;
        real before = 0, after = 0, kinetic = mesh_kinetic(&b.mesh);
        for (int64_t I = 0; I < b.mesh.grid.n; I++) before += b.mesh.grid.mass[I] * b.mesh.grid.velocity[0][I];
        mesh_points_move(&b.mesh, p);
        for (int64_t i = 0; i < p->n; i++) p->kind[i] = fresh.c.p.kind[i];
        kinetic -= mesh_remove_points_and_return_lost_energy(&b.mesh, p, &b.source, NULL, 0);
        for (int64_t I = 0; I < b.mesh.grid.n; I++) {
            after += b.mesh.grid.mass[I] * b.mesh.grid.velocity[0][I];
            assert_exact(b.mesh.grid.mass[I], fresh.mesh.grid.mass[I]);
        }
        for (int64_t i = 0; i < p->n; i++)
            if (p->kind[i] == KIND_PD)
                after += p->mass[i] * p->v[0][i], kinetic -= 0.5 * p->mass[i] * square(p->v[0][i]);
        assert_close(after, before, 1e-14);
        assert_close(kinetic, mesh_kinetic(&b.mesh), 1e-13);
        assert_int_equal(b.mesh.points, fresh.mesh.points);
        assert_int_equal(b.mesh.runs, fresh.mesh.runs);
        assert_int_equal(b.mesh.own_stiffness_cells, fresh.mesh.own_stiffness_cells);
        block_free(&b);
        block_free(&fresh);
    }
}

/* Checks critical time steps against closed forms for cells of h = 2 spacings D. The highest mode is that of a cell
 * with a single point: omega^2 = 16/3 (1 + nu) c^2/h^2 in plane stress, nu = 1/3, i.e. a step of 1.5 D/c (complete
 * cells: 2 D/c). In a bar omega^2 = 16/3 c^2/h^2, a step of sqrt(3) D/c. */
static void test_step(void **state)
{
    (void)state;
    struct block b;
    real density[CLOUD_MATERIALS];
    block_make(&b, SPACE_PLANE_STRESS, false, false);
    for (int m = 0; m < CLOUD_MATERIALS; m++) density[m] = b.c.material[m].density;
    b.source.materials = 1;
    const real c = b.c.material[0].wave_speed;
    assert_close(mesh_critical_time_step(&b.mesh, &b.source, density, true),
                 sqrt(0.75 / (4.0 / 3)) * 2 * CLOUD_SPACING / c, 0.002);
    block_free(&b);
    block_make(&b, SPACE_LINE, false, false);
    b.source.materials = 1;
    assert_close(mesh_critical_time_step(&b.mesh, &b.source, density, false),
                 2 * CLOUD_SPACING / b.c.material[0].wave_speed * sqrt(0.75), 0.002);
    block_free(&b);
}

/* Checks that points that do not form a lattice of two points per cell and axis are refused with a message that has a
 * position. */
static void test_refused(void **state)
{
    (void)state;
    struct block b;
    block_make(&b, SPACE_PLANE_STRESS, false, false);
    struct mesh other;
    struct grid like = {.dim = 2, .h = 2 * CLOUD_SPACING, .anchor = {0.3 * CLOUD_SPACING, 0}};
    assert_refused(mesh_make(&other, &b.c.p, &like, &b.source), "is not at its place in a grid cell of two particles");
    mesh_free(&other);
    like = b.mesh.grid, like.n = 0;
    b.c.p.volume0[7] *= 1.01;
    assert_refused(mesh_make(&other, &b.c.p, &like, &b.source), "a volume that differs");
    mesh_free(&other);
    b.c.p.volume0[7] /= 1.01;
    b.c.p.body[b.c.p.n - 1] = 1;
    assert_refused(mesh_make(&other, &b.c.p, &like, &b.source), "shares a node with another body");
    mesh_free(&other);
    block_free(&b);
}

/* ---- inertia of coarse cells ------------------------------------------------------------------------------------- */

enum { EDGE = 4, NODES = EDGE * EDGE * EDGE };

/* Returns a . (L - C) a for a cell of unit mass with corner values a[2^dim], lumped mass matrix L and consistent mass
 * matrix C. L divides each value by 2^dim; C also weights a pair of corners by 1/3 (equal) or 1/6 (different) for each
 * axis. */
static real plain_form(int dim, const real *a)
{
    real sum = 0;
    for (int c = 0; c < 1 << dim; c++)
        for (int k = 0; k < 1 << dim; k++) {
            real share = c == k ? 1 / (real)(1 << dim) : 0, both = 1;
            for (int d = 0; d < dim; d++) both /= (c >> d & 1) == (k >> d & 1) ? 3 : 6;
            sum += (share - both) * a[c] * a[k];
        }
    return sum;
}

/* Checks the kinetic energy of a velocity update with matched inertia for random forces and masses: dt^2/4 (f^2/m +
 * match M a . (L - C) a) with a = f/m, to round-off. Some cells have a second material, and some are not matched. */
static void test_matched_kick(void **state)
{
    (void)state;
    for (int dim = 1; dim <= DIM_MAX; dim++) {
        static real force[DIM_MAX][NODES], inverse_mass[NODES];
        static uint8_t matched[NODES], material[NODES];
        real cell_mass[] = {0.31, 0.83}, want = 0;
        const real match = 0.43, dt = 0.7;
        uint64_t seed = 23;
        struct mesh mesh = {.grid = {.dim = dim, .n = 1, .force = {force[0], force[1], force[2]}},
                            .points = 5,
                            .inverse_mass = inverse_mass,
                            .matched = matched,
                            .material = material,
                            .cell_mass = cell_mass,
                            .match = match};
        for (int d = 0; d < dim; d++) mesh.grid.stride[d] = mesh.grid.n, mesh.grid.count[d] = EDGE, mesh.grid.n *= EDGE;
        for (int c = 0; c < 1 << dim; c++)
            for (int d = 0; d < dim; d++) mesh.corner[c] += (int32_t)((c >> d & 1) * mesh.grid.stride[d]);
        for (int64_t I = 0; I < mesh.grid.n; I++) {
            bool cell = true;
            inverse_mass[I] = cloud_between(&seed, 1.3, 4.2);
            for (int d = 0; d < dim; d++) {
                force[d][I] = cloud_between(&seed, -3, 3);
                want += square(force[d][I]) * inverse_mass[I];
                cell = cell && I / mesh.grid.stride[d] % EDGE < EDGE - 1;
            }
            matched[I] = cell && I != 1, material[I] = I % 3 == 0;
        }
        for (int64_t I = 0; I < mesh.grid.n; I++)
            for (int d = 0; d < dim && matched[I]; d++) {
                real a[CORNERS_MAX];
                for (int c = 0; c < 1 << dim; c++)
                    a[c] = force[d][I + mesh.corner[c]] * inverse_mass[I + mesh.corner[c]];
                want += match * cell_mass[material[I]] * plain_form(dim, a);
            }
        assert_close(mesh_kick(&mesh, dt), 0.25 * dt * dt * want, 1e-13);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_gradient),     cmocka_unit_test(test_whole_and_cut), cmocka_unit_test(test_partial),
        cmocka_unit_test(test_patch),        cmocka_unit_test(test_momentum),      cmocka_unit_test(test_start),
        cmocka_unit_test(test_release),      cmocka_unit_test(test_step),          cmocka_unit_test(test_refused),
        cmocka_unit_test(test_matched_kick),
    };
    int failures = 0;
    FOR_EVERY_SET failures += cmocka_run_group_tests(tests, NULL, NULL);
    return failures;
}
