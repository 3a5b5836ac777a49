/* A block of particles as an output frame, for tests of pictures. */
#ifndef CLEAVE_TEST_FRAME_BLOCK
#define CLEAVE_TEST_FRAME_BLOCK

#include "base/memory.h"
#include "output/output.h"

static const double SPACING = 1e-3; /* [m] */

/* Returns an output frame of nx x ny x nz particles at rest on a lattice centred at the origin, without damage, in dim
 * dimensions. Its arrays are allocated. */
static struct output_frame block_make(int nx, int ny, int nz, int dim)
{
    const int count[3] = {nx, ny, nz};
    struct output_frame f = {.n = (int64_t)nx * ny * nz, .dim = dim};
    for (int d = 0; d < dim; d++) {
        f.X[d] = NEW("test.X", f.n, real), f.u[d] = NEW("test.u", f.n, float), f.v[d] = NEW("test.v", f.n, float);
        for (int64_t i = 0; i < f.n; i++) {
            const int64_t k = d == 0 ? i % nx : d == 1 ? i / nx % ny : i / nx / ny;
            f.X[d][i] = ((double)k + 0.5 - 0.5 * count[d]) * SPACING;
        }
    }
    for (int k = 0; k < frame_stress_component_count(dim); k++) f.stress[k] = NEW("test.stress", f.n, float);
    f.damage = NEW("test.damage", f.n, float);
    f.kind = NEW("test.kind", f.n, uint8_t), f.material = NEW("test.material", f.n, uint8_t);
    f.body = NEW("test.body", f.n, uint8_t), f.id = NEW("test.id", f.n, int32_t);
    return f;
}

#endif
