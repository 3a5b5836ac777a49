/* Linearised operator of small bodies: the stiffness matrix K of their internal forces, by finite differences of the
 * engine's forces. Unknowns are the displacements of peridynamic particles and of unconstrained nodes of the mesh in
 * the reference frame. */
#ifndef CLEAVE_TESTS_OPERATOR
#define CLEAVE_TESTS_OPERATOR

#include <string.h>

#include "../bench/stability/stability.h"
#include "eigen.h"
#include "base/memory.h"
#include "mesh/mesh_part.h"
#include "step/step.h"

/* One unknown displacement: component d of the peridynamic particle or, if `node`, of the node of the mesh with index
 * `at`. */
struct unknown {
    bool node;
    int32_t at;
    int d;
};

/* The stiffness matrix K of a body, its n unknowns and their masses, and the run whose forces it is computed from.
 * Release it with operator_free. */
struct operator
{
    struct run e;
    struct scene s;
    int64_t n;
    struct unknown *unknown; /* [n] */
    real *mass;              /* [n] mass of each unknown, including that of a node beyond a symmetry plane that
                              * follows it [kg] */
    real *K;                 /* [n][n] minus the force on a row's unknown over the displacement of a column's unknown
                              * [N/m] */
};

/* Properties of the operator: eigenvalues of the symmetric part of M^-1/2 K M^-1/2, except for `imaginary`. */
struct spectrum {
    real asymmetry;       /* max |K - K^T| over max |K| */
    real lowest, highest; /* [1/s^2] */
    int64_t zeros;        /* number of eigenvalues below OPERATOR_ZERO times the highest */
    real energy;          /* |E/(1/2 u K u) - 1| for random displacements, with E of the energy balance */
    real imaginary;       /* largest imaginary part of the eigenvalues of M^-1 K over the highest; NAN: not computed */
};
#define OPERATOR_ZERO 1e-9
/* Displacement for tests of the energy [spacings]: terms of third order cause a relative error of the energy of this
 * size. */
#define OPERATOR_SHAKE 1e-6
/* Displacement for derivatives [spacings]: four-point differences have an error of 1e-14, round-off causes 1e-11. */
#define OPERATOR_STEP 2e-4

/* ---- unknowns ---------------------------------------------------------------------------------------------------- */

/* Finds the components of displacement that are no unknowns. Returns an array with an entry for each node of the mesh
 * if `node` is true, else for each particle of the run. Bit d of an entry is set if component d is no unknown, since
 * the velocity of the particle is prescribed, the node is fixed by a wall, or the node follows its mirror image.
 * Release the array with memory_free. */
static inline uint8_t *operator_held(struct run *run, bool node)
{
    const int64_t n = node ? run->frame->mesh.grid.n : run->part.n;
    uint8_t *held = NEW("test.held", n + 1, uint8_t);
    if (node) {
        const struct grid *g = &run->frame->mesh.grid;
        loads_prescribe_mesh_velocities(&run->loads, &run->frame->mesh, 0, run->clock.dt);
        for (int64_t k = 0; k < g->walls; k++) held[g->wall[k].node] |= (uint8_t)(1 << g->wall[k].component);
        for (int64_t k = 0; k < g->mirror_nodes; k++) held[g->mirror_node[k].node] = 7;
        return held;
    }
    for (int b = 0; b < run->loads.n; b++)
        for (int64_t k = 0; k < run->loads.load[b].n && run->loads.load[b].boundary->kind == BOUNDARY_VELOCITY; k++)
            held[run->loads.load[b].particle[k]] |= run->loads.load[b].boundary->components;
    return held;
}

/* Adds the free components of the displacement of the mesh node (if `node` is true) or particle with the index `at` to
 * the unknowns of the operator o, with the mass `mass` [kg]. Only counts them in o->n while o->unknown is NULL. held:
 * array of operator_held. */
static inline void operator_add(struct operator* o, bool node, const uint8_t *held, int64_t at, real mass)
{
    for (int d = 0; d < o->e.part.dim; d++) {
        if (held[at] >> d & 1) continue;
        if (o->unknown) o->unknown[o->n] = (struct unknown){node, (int32_t)at, d}, o->mass[o->n] = mass;
        o->n++;
    }
}

/* Determines the unknowns of the operator and their masses: all free components of the peridynamic particles, then
 * those of the nodes of the mesh with mass. Nodes beyond a symmetry plane add their mass to their images. */
static inline void operator_unknowns(struct operator* o)
{
    struct run *run = &o->e;
    const struct grid *g = &run->frame->mesh.grid;
    const int64_t nodes = run->frame->mesh.points > 0 ? g->n : 0;
    uint8_t *held = operator_held(run, false), *held_node = nodes > 0 ? operator_held(run, true) : NULL;
    real *mass = NEW("test.node_mass", nodes + 1, real);
    for (int64_t I = 0; I < nodes; I++) mass[I] = g->mass[I];
    for (int64_t k = 0; nodes > 0 && k < g->mirror_nodes; k++)
        mass[g->mirror_node[k].image] += g->mass[g->mirror_node[k].node];
    for (int pass = 0; pass < 2; pass++) {
        if (pass > 0) o->unknown = NEW("test.unknown", o->n, struct unknown), o->mass = NEW("test.mass", o->n, real);
        o->n = 0;
        for (int64_t i = 0; i < run->part.n; i++)
            if (run->part.kind[i] == KIND_PD) operator_add(o, false, held, i, run->part.mass[i]);
        for (int64_t I = 0; I < nodes; I++)
            if (mass[I] > 0) operator_add(o, true, held_node, I, mass[I]);
    }
    memory_free(held);
    memory_free(held_node);
    memory_free(mass);
}

/* ---- forces ------------------------------------------------------------------------------------------------------ */

/* Moves the particle or node of the unknown q in the run of the operator o, such that its displacement component q.d is
 * u [m]. */
static inline void operator_place(struct operator* o, struct unknown q, real u)
{
    struct run *run = &o->e;
    if (q.node)
        run->frame->mesh.displacement[q.d][q.at] = u;
    else
        run->part.x[q.d][q.at] = run->part.X[q.d][q.at] + u;
}

/* Computes the internal forces f[o->n] on all unknowns [N] for the present displacements. Nodes beyond symmetry planes
 * are first moved as mirror images of the nodes that they follow; their forces are then added to those of these nodes,
 * as in mesh_move. */
static inline void operator_forces(struct operator* o, real *f)
{
    struct run *run = &o->e;
    struct grid *g = &run->frame->mesh.grid;
    const int64_t mirror_nodes = run->frame->mesh.points > 0 ? g->mirror_nodes : 0;
    for (int64_t k = 0; k < mirror_nodes; k++)
        for (int d = 0; d < g->dim; d++)
            run->frame->mesh.displacement[d][g->mirror_node[k].node] =
                g->mirror_node[k].sign[d] * run->frame->mesh.displacement[d][g->mirror_node[k].image];
    if (getenv("OPERATOR_SHOW")) lagrangian_mesh_update_point_motion_and_stress(run->frame, &run->part, &run->loads);
    run_compute_internal_forces(run);
    for (int64_t k = 0; k < mirror_nodes; k++)
        for (int d = 0; d < g->dim; d++)
            g->force[d][g->mirror_node[k].image] += g->mirror_node[k].sign[d] * g->force[d][g->mirror_node[k].node];
    for (int64_t k = 0; k < o->n; k++) {
        const struct unknown q = o->unknown[k];
        f[k] = q.node ? g->force[q.d][q.at] : run->part.f[q.d][q.at];
    }
}

/* Computes the matrix K [N/m], column by column, as minus the derivative of the forces by the displacement of an
 * unknown: -df/du = (8 (f(-h) - f(h)) - (f(-2h) - f(2h)))/12 h with h of OPERATOR_STEP spacings. */
static inline void operator_fill(struct operator* o)
{
    const real h = OPERATOR_STEP * o->s.spacing;
    real *f = NEW("test.f", o->n, real);
    o->K = NEW("test.K", o->n * o->n, real);
    for (int64_t c = 0; c < o->n; c++) {
        for (int k = -2; k <= 2; k++) {
            const real weight = (const real[]){-1, 8, 0, -8, 1}[k + 2] / (12 * h);
            if (k == 0) continue;
            operator_place(o, o->unknown[c], k * h);
            operator_forces(o, f);
            for (int64_t r = 0; r < o->n; r++) o->K[r * o->n + c] += weight * f[r];
        }
        operator_place(o, o->unknown[c], 0);
    }
    memory_free(f);
}

/* ---- whole operator ---------------------------------------------------------------------------------------------- */

/* Creates the run of the stability case c and computes the stiffness matrix of its bodies, both stored in *o. Returns
 * REFUSED or FAILED if the scene is refused, with nothing to release. Otherwise release o with operator_free. */
static inline status operator_make(struct operator* o, const struct stability_case *c)
{
    char text[4096];
    *o = (struct operator){.n = 0};
    stability_write_scene_text(c, text, sizeof text);
    TRY(bench_engine_make(&o->e, &o->s, "block", text, NULL, 0));
    operator_unknowns(o);
    operator_fill(o);
    return OK;
}

/* Frees the matrix, the unknowns and the run of the operator o. */
static inline void operator_free(struct operator* o)
{
    memory_free(o->unknown);
    memory_free(o->mass);
    memory_free(o->K);
    bench_engine_free(&o->e, &o->s);
}

/* Tests that the energy of the engine and the stiffness matrix K agree: returns |W/(1/2 u K u) - 1| for small random
 * displacements u, with the energy W of bonds and cells by which the engine balances the energy. Displacements are 0
 * afterwards. */
static inline real operator_energy(struct operator* o)
{
    struct run *run = &o->e;
    uint64_t seed = 3;
    real *u = NEW("test.u", o->n, real), *f = NEW("test.f", o->n, real), half = 0;
    for (int64_t k = 0; k < o->n; k++) {
        u[k] = OPERATOR_SHAKE * o->s.spacing * bench_random(&seed);
        operator_place(o, o->unknown[k], u[k]);
    }
    operator_forces(o, f);
    const real W = run->kernels.bond_energy(&run->bonds, &run->part, NULL) +
                   mesh_strain(&run->frame->mesh, &run->part, run->frame->elastic, !o->s.small_strain);
    for (int64_t k = 0; k < o->n * o->n; k++) half += 0.5 * u[k / o->n] * o->K[k] * u[k % o->n];
    for (int64_t k = 0; k < o->n; k++) operator_place(o, o->unknown[k], 0);
    memory_free(u);
    memory_free(f);
    return fabs(W / half - 1);
}

/* Returns asymmetry, eigenvalues and error of the energy of the operator o. imaginary: true to compute the imaginary
 * parts of the eigenvalues, too, which is slower; if false, the member `imaginary` of the result is NAN. */
static inline struct spectrum operator_spectrum(struct operator* o, bool imaginary)
{
    const int64_t n = o->n;
    struct spectrum s = {.imaginary = NAN, .energy = operator_energy(o)};
    real *A = NEW("test.A", n * n, real), *d = NEW("test.d", n, real), *scratch = NEW("test.e", n, real), largest = 0,
         least;
    for (int64_t k = 0; k < n * n; k++) {
        const int64_t i = k / n, j = k % n;
        largest = real_max(largest, fabs(o->K[k]));
        s.asymmetry = real_max(s.asymmetry, fabs(o->K[k] - o->K[j * n + i]));
        A[k] = 0.5 * (o->K[k] + o->K[j * n + i]) / sqrt(o->mass[i] * o->mass[j]);
    }
    s.asymmetry /= largest;
    eigen_symmetric(A, n, d, scratch);
    s.lowest = d[0], s.highest = d[n - 1];
    for (int64_t k = 0; k < n; k++) s.zeros += fabs(d[k]) < OPERATOR_ZERO * s.highest;
    for (int64_t k = 0; k < n * n && imaginary; k++) A[k] = o->K[k] / sqrt(o->mass[k / n] * o->mass[k % n]);
    if (imaginary) s.imaginary = eigen_imaginary(A, n, &least) / s.highest;
    memory_free(A);
    memory_free(d);
    memory_free(scratch);
    return s;
}

/* Writes the operator o to the file `path`: a line for each unknown (1 for a node or 0 for a particle, index,
 * component, reference position [m], mass [kg]), then the stiffness matrix K row by row [N/m]. Writes nothing if the
 * file cannot be opened. */
static inline void operator_dump(const struct operator* o, const char *path)
{
    FILE *to = fopen(path, "w");
    if (!to) return;
    fprintf(to, "# %lld unknowns: node at component X Y Z mass; then K\n", (long long)o->n);
    for (int64_t k = 0; k < o->n; k++) {
        const struct unknown q = o->unknown[k];
        const struct grid *g = &o->e.frame->mesh.grid;
        fprintf(to, "%d %d %d", q.node, q.at, q.d);
        for (int d = 0; d < DIM_MAX; d++)
            fprintf(to, " %.9g",
                    d >= o->e.part.dim ? 0
                    : q.node           ? grid_node_position(g, d, q.at / g->stride[d] % g->count[d])
                                       : o->e.part.X[d][q.at]);
        fprintf(to, " %.17g\n", o->mass[k]);
    }
    for (int64_t k = 0; k < o->n * o->n; k++) fprintf(to, "%.17g%c", o->K[k], k % o->n == o->n - 1 ? '\n' : ' ');
    fclose(to);
}

#endif
