/* What the parts of `cleave bench kernels` share. */
#ifndef CLEAVE_BENCH_KERNEL_BENCH
#define CLEAVE_BENCH_KERNEL_BENCH

#include <math.h>

#include "bench/common/bench.h"
#include "contact/contact.h"

enum job_kind {
    BOND_FORCE,
    BOND_ENERGY,
    BOND_STRESS,
    PD_MOVE,
    P2G,
    REMAP,
    G2P,
    SPREAD,
    GRID_CLEAR,
    GRID_MOVE,
    GRID_REMAPPED,
    MESH_CLEAR,
    MESH_FORCE,
    MESH_MOVE,
    CONTACT_SEARCH,
    CONTACT_FORCE,
    JOB_KINDS
};

/* One instance to be timed. */
struct job {
    enum job_kind kind;
    int dim;
    enum pd_model model;
    enum shape shape;
    enum transfer transfer;
    bool finite; /* strain of a mesh */
    const char *variant;
    double seconds;      /* of the fastest call */
    double bytes, limit; /* moved a particle; least time it would take a particle [s] */
};

/* What is timed on, for each dimension; state-based particles not in 1D. */
enum { BONDS, POINTS, STATES, MESH, YIELDING, CUT, GROUNDS };
struct ground {
    struct scene scene[GROUNDS];
    struct run engine[GROUNDS];
    int32_t *list;
    real *value, *field; /* of spread */
};

struct limits {
    double cell_stencil[DIM_MAX + 1], triad, points;
}; /* [s/bond], [B/s], [s/point] */

struct kernel_bench {
    struct ground ground[DIM_MAX + 1];
    struct job *job;
    int jobs;
    struct limits limits;
    struct targets targets;
};

static inline bool on_bonds(const struct job *j) { return j->kind <= BOND_STRESS; }

/* Of contact: those near a face. */
static inline int64_t job_particles(const struct job *j, const struct ground *g)
{
    if (j->kind >= CONTACT_SEARCH) return g->engine[CUT].contact->rows;
    return g->engine[j->kind >= MESH_CLEAR ? MESH : j->kind > PD_MOVE ? POINTS : BONDS].part.n;
}

/* Bonds of a particle; NAN where a kernel visits none. */
static inline double job_bonds(const struct job *j, const struct ground *g)
{
    return on_bonds(j) ? (double)g->engine[BONDS].bonds.n / (double)g->engine[BONDS].part.n : NAN;
}

/* What was measured, printed; its tables and its picture (kernels_draw.c). */
void kernels_print(const struct kernel_bench *b);
status kernels_write(const struct kernel_bench *b);

#endif
