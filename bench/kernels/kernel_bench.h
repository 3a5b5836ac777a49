/* `cleave bench kernels`: times every kernel and compares it with the limits of the machine. Declarations shared by its
 * files. */
#ifndef CLEAVE_BENCH_KERNEL_BENCH
#define CLEAVE_BENCH_KERNEL_BENCH

#include <math.h>

#include "bench/common/bench.h"
#include "contact/contact.h"

/* Kernels (inner loops of a time step) that are timed. */
enum job_kind {
    BOND_FORCE,
    BOND_ENERGY,
    BOND_STRESS,
    PD_MOVE,
    P2G,
    REMAP,
    G2P,
    G2P_YIELDS, /* all points are stressed beyond their yield stress */
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

/* A kernel to be timed, with the dimension, model, shape function or transfer for which it is compiled, and its time.
 */
struct job {
    enum job_kind kind;
    int dim;
    enum pd_model model;
    enum shape shape;
    enum transfer transfer;
    bool finite; /* finite strain in a mesh */
    const char *variant;
    double seconds;      /* time of the fastest call [s] */
    double bytes, limit; /* bytes moved per particle; lower limit of the time per particle [s] */
};

/* Bodies on which kernels are timed, for each dimension: BONDS elastic bonds, POINTS material points of the current
 * frame, STATES state-based bonds (not in 1D), MESH cells of the reference frame, YIELDING yielding bonds, CUT a body
 * with pressed crack faces. */
enum { BONDS, POINTS, STATES, MESH, YIELDING, CUT, GROUNDS };
struct ground {
    struct scene scene[GROUNDS];
    struct run engine[GROUNDS];
    int32_t *list;
    real *value, *field; /* arguments of the spread kernel */
};

/* Measured limits of the machine, from which lower limits of the times of kernels are computed. */
struct limits {
    double cell_stencil[DIM_MAX + 1], triad, points;
}; /* [s/bond], [B/s], [s/point] */

/* State of `cleave bench kernels`: the bodies on which kernels are timed, the kernels, and the results. */
struct kernel_bench {
    struct ground ground[DIM_MAX + 1];
    struct job *job;
    int jobs;
    struct limits limits;
    struct targets targets;
};

/* Returns true if the kernel that `job` times visits bonds. */
static inline bool job_visits_bonds(const struct job *job) { return job->kind <= BOND_STRESS; }

/* Returns the number of particles that the kernel of `job` visits in the body of g on which it is timed; contact
 * kernels visit only particles near a face. */
static inline int64_t job_particle_count(const struct job *job, const struct ground *g)
{
    if (job->kind >= CONTACT_SEARCH) return g->engine[CUT].contact->rows;
    return g->engine[job->kind >= MESH_CLEAR ? MESH : job->kind > PD_MOVE ? POINTS : BONDS].part.n;
}

/* Returns the number of bonds per particle in the body of `job`; NAN if its kernel visits no bonds. g: bodies on which
 * kernels are timed. */
static inline double job_bonds_per_particle(const struct job *job, const struct ground *g)
{
    return job_visits_bonds(job) ? (double)g->engine[BONDS].bonds.n / (double)g->engine[BONDS].part.n : NAN;
}

/* Prints the limits of the machine, the times of all kernels and the targets in b (kernels_draw.c). */
void kernels_print(const struct kernel_bench *b);

/* Writes the tables and draws the picture of the bench b (kernels_draw.c). Returns FAILED if a file cannot be
 * written. */
status kernels_write(const struct kernel_bench *b);

#endif
