/* Tests slits of the mesh, i.e. free surfaces between points. Forces must be the gradient of the energy of the points,
 * momentum must be conserved, and nodal masses must add up to those of the points. A slit along the load must have no
 * effect, one across it must transmit nothing. Points can be removed and inserted again. */
#include "tests/support/mesh_block.h"

/* Slits of the block, whose cells are two spacings wide: along a face of cells, through the middle of cells,
 * oblique. */
enum slit_kind { BETWEEN_CELLS, INSIDE_CELLS, OBLIQUE, SLITS };

static real slit_corner[4][DIM_MAX];
static struct crack slit_made;

/* Returns a slit of kind `kind` from x = -1 to x = `to` [spacings from the corner of the block b]. An oblique slit
 * rises by 3.1 spacings. In 3D it extends through the whole thickness. The result is valid until the next call. */
static const struct crack *slit_of(const struct block *b, enum slit_kind kind, real to)
{
    const struct grid *g = &b->mesh.grid;
    const real y = kind == BETWEEN_CELLS ? 6 : kind == INSIDE_CELLS ? 5 : 4.2, rise = kind == OBLIQUE ? 3.1 : 0;
    const int dim = g->dim;
    for (int k = 0; k < (dim == 3 ? 4 : 2); k++) {
        const bool far = k == 1 || k == 2, behind = k > 1;
        const real place[DIM_MAX] = {far ? to : -1, y + (far ? rise : 0) - (dim == 3 ? 2 : 0), behind ? 9 : -3};
        for (int d = 0; d < dim; d++) slit_corner[k][d] = g->anchor[d] + CLOUD_SPACING * place[d];
    }
    slit_made = (struct crack){.n = dim == 3 ? 4 : 2, .corner = slit_corner};
    return &slit_made;
}

/* Creates in `space` the block b with a slit of kind `kind` to x = `to` (slit_of). hole: as in block_make. */
static void slit_block(struct block *b, enum space space, enum slit_kind kind, real to, bool hole)
{
    block_make(b, space, hole, false);
    const struct grid like = {.dim = b->mesh.grid.dim,
                              .h = b->mesh.grid.h,
                              .anchor = {b->mesh.grid.anchor[0], b->mesh.grid.anchor[1], b->mesh.grid.anchor[2]}};
    b->source.slit = slit_of(b, kind, to), b->source.slits = 1;
    mesh_free(&b->mesh);
    assert_ok(mesh_make(&b->mesh, &b->c.p, &like, &b->source));
    assert_true(b->mesh.slits.nodes > 0);
}

static bool parted(const struct block *b, int64_t i, int64_t j)
{
    real X[DIM_MAX], Y[DIM_MAX];
    particle_reference_position(&b->c.p, i, X);
    particle_reference_position(&b->c.p, j, Y);
    return crack_cuts_bond(&slit_made, X, Y, b->c.p.dim);
}

static real total_mass(const struct block *b)
{
    real sum = 0;
    for (int64_t I = 0; I < b->mesh.grid.n; I++) sum += b->mesh.grid.mass[I];
    return sum;
}

static real point_mass(const struct block *b)
{
    real sum = 0;
    for (int64_t i = 0; i < b->c.p.n; i++) sum += b->mesh.place[i] >= 0 ? b->c.p.mass[i] : 0;
    return sum;
}

/* Checks that two points separated by a slit through the block share no cell and no node, and that the masses of nodes
 * add up to those of points. */
static void test_parts(void **state)
{
    (void)state;
    for (int s = 1; s < 3; s++)
        for (int kind = 0; kind < SLITS; kind++) {
            struct block b;
            slit_block(&b, spaces[s], kind, 30, false); /* through the block */
            const int dim = b.c.p.dim, corners = 1 << dim;
            const struct mesh *mesh = &b.mesh;
            int64_t pairs = 0;
            for (int64_t i = 0; i < b.c.p.n; i++)
                for (int64_t j = 0; j < i; j++) {
                    bool near = true; /* distant points share no node anyway */
                    for (int d = 0; d < dim; d++)
                        near = near && fabs(b.c.p.X[d][i] - b.c.p.X[d][j]) < 4 * CLOUD_SPACING;
                    if (!near || !parted(&b, i, j)) continue;
                    const int64_t I = mesh->place[i] >> dim, J = mesh->place[j] >> dim;
                    assert_int_not_equal(I, J);
                    for (int c = 0; c < corners * corners; c++)
                        assert_int_not_equal(mesh_cell_corner_node(mesh, I, c / corners),
                                             mesh_cell_corner_node(mesh, J, c % corners));
                    pairs++;
                }
            assert_true(pairs > 0);
            assert_close(total_mass(&b), point_mass(&b), 1e-13);
            block_free(&b);
        }
}

/* Checks forces on some of the nodes duplicated by slits, by central differences of the energy of all points. Tolerance
 * 1e-5 of the largest force: third derivatives times the squared step, and round-off of the sum over the step. */
static void test_gradient(void **state)
{
    (void)state;
    for (int s = 1; s < 3; s++)
        for (int kind = 0; kind < SLITS; kind++)
            for (int finite = 0; finite < 2; finite++) {
                struct block b;
                slit_block(&b, spaces[s], kind, 11, true);
                shake(&b, 0.15, 5);
                forces(&b, finite);
                const real scale = largest_force(&b), step = 1e-3 * CLOUD_SPACING;
                assert_close(mesh_strain(&b.mesh, &b.c.p, b.elastic, finite), plain_energy(&b, finite), 1e-12);
                int tried = 0;
                for (int64_t I = 0; I < b.mesh.grid.n; I++)
                    for (int d = 0; d < b.c.p.dim && b.mesh.slits.split[I] && b.mesh.grid.mass[I] > 0; d++) {
                        real *u = &b.mesh.displacement[d][I], W[2];
                        if (tried++ % (s == 2 ? 97 : 7)) continue; /* a sample of many */
                        *u += step, W[1] = plain_energy(&b, finite);
                        *u -= 2 * step, W[0] = plain_energy(&b, finite);
                        *u += step;
                        assert_near(b.mesh.grid.force[d][I], -(W[1] - W[0]) / (2 * step), 1e-5 * scale);
                    }
                real sum[DIM_MAX] = {0};
                for (int64_t I = 0; I < b.mesh.grid.n; I++)
                    for (int d = 0; d < b.c.p.dim; d++) sum[d] += b.mesh.grid.force[d][I];
                for (int d = 0; d < b.c.p.dim; d++) assert_near(sum[d], 0, 1e-12 * scale);
                block_free(&b);
            }
}

/* Returns the largest force on nodes away from the loaded ends of the block b, divided by `stress` times the face of a
 * point [1]. */
static real residual(const struct block *b, real stress)
{
    real most = 0, low = INFINITY, high = -INFINITY;
    const struct mesh *mesh = &b->mesh;
    for (int64_t I = 0; I < mesh->grid.n; I++)
        if (mesh->grid.mass[I] > 0)
            low = real_min(low, node_place(mesh, I, 0)), high = real_max(high, node_place(mesh, I, 0));
    for (int64_t I = 0; I < mesh->grid.n; I++) {
        const real x = node_place(mesh, I, 0);
        if (mesh->grid.mass[I] == 0 || x < low + 1.5 * mesh->grid.h || x > high - 1.5 * mesh->grid.h) continue;
        for (int d = 0; d < b->c.p.dim; d++) most = real_max(most, fabs(mesh->grid.force[d][I]));
    }
    return most / (stress * mesh->volume / CLOUD_SPACING);
}

/* Checks uniaxial tension along the slit, u = e x, -nu e y (and z): no force on its free faces. In plane stress and 3D
 * the only stress is E e along x. */
static void test_patch(void **state)
{
    (void)state;
    for (int s = 1; s < 3; s++)
        for (int kind = 0; kind < OBLIQUE; kind++) {
            struct block b;
            slit_block(&b, spaces[s], kind, 13, false);
            const struct material *m = &b.c.material[0];
            for (int64_t I = 0; I < b.mesh.grid.n; I++)
                for (int d = 0; d < b.c.p.dim && b.mesh.grid.mass[I] > 0; d++)
                    b.mesh.displacement[d][I] = (d == 0 ? 1 : -m->poisson) * 1e-3 * node_place(&b.mesh, I, d);
            forces(&b, false);
            assert_true(residual(&b, 1e-3 * m->young) < 1e-12);
            block_free(&b);
        }
}

/* Checks that a slit through the block separates it: a displacement of one side causes no force and no energy. */
static void test_loose(void **state)
{
    (void)state;
    for (int s = 1; s < 3; s++)
        for (int kind = 0; kind < SLITS; kind++) {
            struct block b;
            slit_block(&b, spaces[s], kind, 30, false);
            const int dim = b.c.p.dim;
            for (int64_t i = 0; i < b.c.p.n; i++)
                if (!parted(&b, i, b.c.p.n - 1) && b.mesh.place[i] >= 0)
                    for (int c = 0; c < 1 << dim; c++)
                        b.mesh.displacement[1][mesh_cell_corner_node(&b.mesh, b.mesh.place[i] >> dim, c)] =
                            0.1 * CLOUD_SPACING;
            forces(&b, true);
            assert_true(largest_force(&b) < 1e-12 * b.elastic[0].c11 * b.mesh.volume / CLOUD_SPACING);
            assert_near(mesh_strain(&b.mesh, &b.c.p, b.elastic, true), 0, 1e-20 * b.elastic[0].c11 * b.mesh.volume);
            block_free(&b);
        }
}

/* Checks that a linear field with a jump across a slit is projected to the nodes of both sides to 1e-12. Points that
 * are removed reduce the mass of nodes; points that are inserted again restore mass and displacements. */
static void test_points(void **state)
{
    (void)state;
    for (int kind = 0; kind < SLITS; kind++) {
        struct block b;
        slit_block(&b, SPACE_PLANE_STRESS, kind, 30, false);
        struct particles *p = &b.c.p;
        for (int64_t i = 0; i < p->n; i++) {
            const real jump = parted(&b, i, p->n - 1) ? 0.3 * CLOUD_SPACING : 0;
            p->x[0][i] = p->X[0][i] + 1e-2 * p->X[1][i] + jump, p->x[1][i] = p->X[1][i] - 2e-2 * p->X[0][i];
        }
        const real *anchor = b.mesh.grid.anchor;
        const struct grid like = {.dim = 2, .h = b.mesh.grid.h, .anchor = {anchor[0], anchor[1]}};
        mesh_free(&b.mesh);
        assert_ok(mesh_make(&b.mesh, p, &like, &b.source));
        real *x[2];
        for (int d = 0; d < 2; d++) {
            x[d] = NEW("test.x", p->n, real);
            memcpy(x[d], p->x[d], sizeof(real) * (size_t)p->n);
        }
        const real mass = point_mass(&b);
        int32_t list[64], n = 0;
        for (int64_t i = 0; i < p->n && n < 64; i++)
            if (p->X[0][i] - like.anchor[0] < 6 * CLOUD_SPACING && p->X[0][i] - like.anchor[0] > 3 * CLOUD_SPACING)
                list[n++] = (int32_t)i, p->kind[i] = KIND_PD;
        mesh_remove_points_and_return_lost_energy(&b.mesh, p, &b.source, NULL, 0);
        assert_close(total_mass(&b), point_mass(&b), 1e-13);
        for (int k = 0; k < n; k++) p->kind[list[k]] = KIND_MPM;
        (void)mesh_insert_points_and_return_lost_energy(&b.mesh, p, list, n);
        mesh_remove_points_and_return_lost_energy(&b.mesh, p, &b.source, list, n);
        assert_close(total_mass(&b), mass, 1e-13);
        mesh_points_move(&b.mesh, p);
        for (int64_t i = 0; i < p->n; i++)
            for (int d = 0; d < 2; d++) assert_near(p->x[d][i], x[d][i], 1e-12 * CLOUD_SPACING);
        for (int d = 0; d < 2; d++) memory_free(x[d]);
        block_free(&b);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_parts), cmocka_unit_test(test_gradient),
                                       cmocka_unit_test(test_patch), cmocka_unit_test(test_loose),
                                       cmocka_unit_test(test_points)};
    int failures = 0;
    FOR_EVERY_SET failures += cmocka_run_group_tests(tests, NULL, NULL);
    return failures;
}
