/* Tests the coarsest admissible level of cells, which follows from the thickness of the body, for plates, strips,
 * tubes, wedges, slits and halves of bodies beside a mirror. At least six cells must fit across the thickness. */
#include "tests/support/near.h"

#include "base/memory.h"
#include "mesh/levels.h"
#include "src/mesh/mesh_parts.h"

#define EDGE 0.4e-3 /* of a cell [m] */
enum { MARGIN = 2 };

/* A rectangular body of cells, and room[], the coarsest admissible level of each cell. */
struct body {
    struct mesh mesh;
    uint8_t *room;
};

static void body_make(struct body *b, int dim, int x, int y, int z)
{
    struct grid *g = &b->mesh.grid;
    const int cells[DIM_MAX] = {x, y, z};
    *b = (struct body){.mesh.grid = {.dim = dim, .h = EDGE, .anchor = {0.3 * EDGE, -1.7 * EDGE, 0.2 * EDGE}, .n = 1}};
    for (int d = 0; d < dim; d++) {
        g->count[d] = cells[d] + 2 * MARGIN, g->stride[d] = g->n, g->first[d] = -MARGIN;
        g->n *= g->count[d];
    }
    b->mesh.kind = NEW("test.kind", g->n, uint8_t);
    b->room = NEW("test.room", g->n, uint8_t);
    for (int c = 0; c < 1 << dim; c++)
        for (int d = 0; d < dim; d++) b->mesh.corner[c] += (int32_t)((c >> d & 1) * g->stride[d]);
    for (int64_t I = 0; I < g->n; I++) {
        bool in = true;
        for (int d = 0; d < dim; d++) {
            const int64_t k = I / g->stride[d] % g->count[d] - MARGIN;
            in = in && k >= 0 && k < cells[d];
        }
        b->mesh.kind[I] = in ? CELL_WHOLE : CELL_EMPTY;
    }
}

static void body_free(struct body *b)
{
    memory_free(b->mesh.kind);
    memory_free(b->mesh.slits.split);
    memory_free(b->room);
}

static int64_t cell_at(const struct body *b, int x, int y, int z)
{
    const int64_t k[DIM_MAX] = {x, y, z};
    int64_t I = 0;
    for (int d = 0; d < b->mesh.grid.dim; d++) I += (k[d] + MARGIN) * b->mesh.grid.stride[d];
    return I;
}

/* Returns the highest level for which six cells fit across `thick` cells of level 0, where one cell of level 0 may be
 * missing. */
static int level_for(int thick)
{
    int level = 0;
    while (level < LEVELS_MAX && 6 * (2 << level) - 1 <= thick) level++;
    return level;
}

/* Checks plates in 3D and strips in 2D of any thickness: the level is equal in all cells and follows from the smallest
 * dimension. */
static void plates_and_strips(void **state)
{
    (void)state;
    for (int thick = 3; thick <= 60; thick += thick < 30 ? 1 : 10)
        for (int dim = 2; dim <= 3; dim++) {
            struct body b;
            body_make(&b, dim, dim == 3 ? 56 : 130, thick, dim == 3 ? 50 : 0);
            const int most = mesh_compute_coarsest_cell_levels_for_thickness(&b.mesh, NULL, 0, b.room),
                      wide = level_for(dim == 3 ? 50 : 130);
            const int wanted = level_for(thick) < wide ? level_for(thick) : wide;
            assert_int_equal(most, wanted);
            for (int64_t I = 0; I < b.mesh.grid.n; I++)
                if (b.mesh.kind[I] == CELL_WHOLE) assert_int_equal(b.room[I], wanted);
            body_free(&b);
        }
}

/* Checks a square tube, whose level must follow from the thickness of its wall and not from its width. */
static void tubes(void **state)
{
    (void)state;
    for (int wall = 4; wall <= 26; wall += 11) {
        struct body b;
        body_make(&b, 2, 80, 70, 0);
        for (int x = wall; x < 80 - wall; x++)
            for (int y = wall; y < 70 - wall; y++) b.mesh.kind[cell_at(&b, x, y, 0)] = CELL_EMPTY;
        assert_int_equal(mesh_compute_coarsest_cell_levels_for_thickness(&b.mesh, NULL, 0, b.room), level_for(wall));
        assert_int_equal(b.room[cell_at(&b, wall / 2, 35, 0)], level_for(wall));
        body_free(&b);
    }
}

/* Checks a wedge whose height increases by one cell every four cells. A level is admissible in the columns that a
 * square of its size which fits into the wedge can cover. */
static void wedges(void **state)
{
    (void)state;
    struct body b;
    body_make(&b, 2, 200, 50, 0);
    for (int x = 0; x < 200; x++)
        for (int y = x / 4 + 1; y < 50; y++) b.mesh.kind[cell_at(&b, x, y, 0)] = CELL_EMPTY;
    assert_int_equal(mesh_compute_coarsest_cell_levels_for_thickness(&b.mesh, NULL, 0, b.room),
                     level_for(40)); /* 4 (40 - 1) + 40 cells */
    for (int x = 0; x < 200; x++)
        for (int level = 1; level <= LEVELS_MAX; level++) {
            const int side = 6 * (1 << level) - 1, from = 4 * (side - 1); /* this height from there on */
            const bool fits = side <= 50 && from + side <= 200 && x >= from;
            assert_int_equal(b.room[cell_at(&b, x, 0, 0)] >= level, fits);
        }
    body_free(&b);
}

/* Checks half of a strip beside a plane of symmetry, which must have the level of the whole strip, and a strip with a
 * slit in its middle, which must have the level of half its height. */
static void mirrors_and_slits(void **state)
{
    (void)state;
    struct body b;
    for (int half = 4; half <= 14; half += 5) {
        body_make(&b, 2, 90, half, 0);
        const struct mirror_plane plane = {.axis = 1, .outside = -1, .at = grid_node_position(&b.mesh.grid, 1, MARGIN)};
        assert_int_equal(mesh_compute_coarsest_cell_levels_for_thickness(&b.mesh, NULL, 0, b.room), level_for(half));
        assert_int_equal(mesh_compute_coarsest_cell_levels_for_thickness(&b.mesh, &plane, 1, b.room),
                         level_for(2 * half));
        body_free(&b);
    }
    body_make(&b, 2, 90, 24, 0);
    assert_int_equal(mesh_compute_coarsest_cell_levels_for_thickness(&b.mesh, NULL, 0, b.room), 2);
    b.mesh.slits.first = b.mesh.grid.n, b.mesh.slits.split = NEW("test.split", b.mesh.grid.n, uint8_t);
    for (int x = 0; x < 90; x++) b.mesh.slits.split[cell_at(&b, x, 12, 0)] = 1;
    assert_int_equal(mesh_compute_coarsest_cell_levels_for_thickness(&b.mesh, NULL, 0, b.room), 1);
    body_free(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(plates_and_strips), cmocka_unit_test(tubes),
                                       cmocka_unit_test(wedges), cmocka_unit_test(mirrors_and_slits)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
