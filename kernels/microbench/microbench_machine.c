/* Measures limits of the machine: the speed of the arithmetic of one bond, and the memory bandwidth. */
#include <math.h>
#include <string.h>

#define ROWS_IN_PARTS /* vectors of WIDE particles */
#include "kernels/simd/lanes.h"
#include "base/memory.h"
#include "microbench.h"
#include "base/team.h"
#include "kernels/simd/variants.h"

/* ---- lattice stencil ---------------------------------------------------------------------------------------------
 *
 * The bond law of bond_force.c on a whole lattice, where all data of a bond follow from its direction: neighbours at
 * fixed index distances, fixed lengths, one stiffness. What remains is the arithmetic: one reciprocal root and some
 * twenty operations. No bond breaks. */

/* Largest number of bonds of a particle; width of the margin around the lattice [spacings]. */
enum { STENCIL_MOST = 128, MARGIN = 3 };

/* A lattice of particles and its bonds. A particle's index is the sum over the axes of its position (in spacings) times
 * stride[axis]; a margin of particles surrounds the lattice. neighbours: number of bonds of each particle; offset[k],
 * inverse_length[k]: index distance and inverse reference length [1/spacing] of neighbour k; x[axis], f[axis]:
 * positions and forces of all particles. */
struct microbench_lattice {
    int dim;
    /* particles along each axis; strides; index of the first particle; number of particles; number with margins */
    int64_t count[DIM_MAX], stride[DIM_MAX], first, n, all;
    int neighbours;
    int64_t offset[STENCIL_MOST];
    real inverse_length[STENCIL_MOST];
    real *x[DIM_MAX], *f[DIM_MAX];
};

/* Computes the forces of all bonds on the WIDE particles (one per vector lane) from number i on of the lattice s and
 * stores them in s->f. */
static ALWAYS_INLINE void stencil_rows(const struct microbench_lattice *s, int64_t i, const int dim)
{
    const lanes x0 = lanes_load(s->x[0] + i), x1 = dim > 1 ? lanes_load(s->x[1] + i) : x0;
    const lanes x2 = dim > 2 ? lanes_load(s->x[2] + i) : x0;
    lanes f0 = lanes_broadcast(0), f1 = f0, f2 = f0;
    for (int k = 0; k < s->neighbours; k++) {
        const int64_t j = i + s->offset[k];
        const lanes d0 = lanes_load(s->x[0] + j) - x0;
        const lanes d1 = dim > 1 ? lanes_load(s->x[1] + j) - x1 : d0;
        const lanes d2 = dim > 2 ? lanes_load(s->x[2] + j) - x2 : d0;
        lanes distance2 = d0 * d0;
        if (dim > 1) distance2 += d1 * d1;
        if (dim > 2) distance2 += d2 * d2;
        const lanes inverse = lanes_inverse_square_root(distance2);
        const lanes force = (distance2 * inverse * s->inverse_length[k] - 1.0) * inverse;
        f0 += force * d0;
        if (dim > 1) f1 += force * d1;
        if (dim > 2) f2 += force * d2;
    }
    lanes_store(s->f[0] + i, f0);
    if (dim > 1) lanes_store(s->f[1] + i, f1);
    if (dim > 2) lanes_store(s->f[2] + i, f2);
}

#define SWEEP(D)                                                                                                       \
    static void stencil_sweep_##D##d(struct microbench_lattice *s)                                                     \
    {                                                                                                                  \
        const int64_t rows = s->count[1] * s->count[2];                                                                \
        _Pragma("omp parallel for schedule(static)") for (int64_t row = 0; row < rows; row++)                          \
        {                                                                                                              \
            const int64_t i = s->first + row % s->count[1] * s->stride[1] + row / s->count[1] * s->stride[2];          \
            for (int64_t k = 0; k < s->count[0]; k += WIDE) stencil_rows(s, i + k, D);                                 \
        }                                                                                                              \
    }
DIM_VARIANTS(SWEEP)

#define SWEEP_ENTRY(D) [D] = stencil_sweep_##D##d,
static void (*const stencil_sweep[DIM_MAX + 1])(struct microbench_lattice *) = {DIM_VARIANTS(SWEEP_ENTRY)};

/* Stores in s the index distances and inverse lengths of all neighbours of a lattice particle within 3.015 spacings. */
static void find_neighbours(struct microbench_lattice *s)
{
    const int reach[DIM_MAX] = {MARGIN, s->dim > 1 ? MARGIN : 0, s->dim > 2 ? MARGIN : 0};
    for (int c = -reach[2]; c <= reach[2]; c++)
        for (int b = -reach[1]; b <= reach[1]; b++)
            for (int a = -reach[0]; a <= reach[0]; a++) {
                const real r = sqrt((real)(a * a + b * b + c * c));
                if (r == 0 || r > 3.015) continue;
                s->offset[s->neighbours] = a + b * s->stride[1] + c * s->stride[2];
                s->inverse_length[s->neighbours++] = 1 / r;
            }
}

/* Sets the positions s->x of all particles to the sites of a lattice with spacing 1 and a small non-uniform strain, so
 * that no operand of the timed loop has a special value. */
static void place_lattice(struct microbench_lattice *s)
{
    for (int64_t i = 0; i < s->all; i++) {
        const int64_t place[DIM_MAX] = {i % s->stride[1], i / s->stride[1] % (s->stride[2] / s->stride[1]),
                                        i / s->stride[2]};
        for (int d = 0; d < s->dim; d++) s->x[d][i] = (real)place[d] * (1 + 1e-4 * (d + 1)) + 1e-4 * sin((real)i);
    }
}

struct microbench_lattice *microbench_lattice_make(int dim)
{
    static const int64_t counts[DIM_MAX + 1][DIM_MAX] = {{0}, {80000, 1, 1}, {200, 400, 1}, {40, 40, 50}};
    struct microbench_lattice *s = NEW("bench.stencil", 1, struct microbench_lattice);
    s->dim = dim;
    s->n = s->all = 1;
    for (int d = 0; d < DIM_MAX; d++) {
        const int margin = d < dim ? d == 0 ? LANES : MARGIN : 0;
        s->count[d] = counts[dim][d];
        s->stride[d] = s->all;
        s->first += margin * s->stride[d];
        s->n *= s->count[d];
        s->all *= s->count[d] + 2 * margin;
    }
    for (int d = 0; d < dim; d++) {
        s->x[d] = NEW("bench.stencil.x", s->all + LANES, real);
        s->f[d] = NEW("bench.stencil.f", s->all + LANES, real);
    }
    find_neighbours(s);
    place_lattice(s);
    return s;
}

double microbench_lattice_run(struct microbench_lattice *s)
{
    double start = wall_clock_seconds();
    stencil_sweep[s->dim](s);
    return (wall_clock_seconds() - start) / (double)(s->n * s->neighbours);
}

void microbench_lattice_free(struct microbench_lattice *s)
{
    for (int d = 0; d < s->dim; d++) {
        memory_free(s->x[d]);
        memory_free(s->f[d]);
    }
    memory_free(s);
}

/* ---- triad ------------------------------------------------------------------------------------------------------- */

/* The three arrays of the triad a = b + factor c, each [n]. */
struct microbench_triad {
    int64_t n;
    real *a, *b, *c;
};

#define TRIAD_LEAST 64000000 /* least size of an array of the triad, above that of caches [byte] */

struct microbench_triad *microbench_triad_make(bool quick)
{
    struct microbench_triad *t = NEW("bench.triad", 1, struct microbench_triad);
    const int64_t bytes = quick ? 0 : 2 * machine_properties().cache[3];
    t->n = (bytes > TRIAD_LEAST ? bytes : TRIAD_LEAST) / (int64_t)sizeof(real);
    t->a = NEW("bench.triad.a", t->n, real);
    t->b = NEW("bench.triad.b", t->n, real);
    t->c = NEW("bench.triad.c", t->n, real);
    return t;
}

double microbench_triad_run(struct microbench_triad *t)
{
    real *restrict a = t->a;
    const real *restrict b = t->b, *restrict c = t->c;
    const real q = 3;
    double start = wall_clock_seconds();
#pragma omp parallel for simd schedule(static)
    for (int64_t i = 0; i < t->n; i++) a[i] = b[i] + q * c[i];
    return 3.0 * sizeof(real) * (double)t->n / (wall_clock_seconds() - start);
}

void microbench_triad_free(struct microbench_triad *t)
{
    memory_free(t->a);
    memory_free(t->b);
    memory_free(t->c);
    memory_free(t);
}
