/* Room `solver`: static equilibrium of peridynamic bodies, by adaptive dynamic relaxation or conjugate gradients, and
 * solvers for load steps (equilibrium.h, multigrid.h). It uses particles, bonds and loads, but neither scenes nor runs;
 * room `quasistatic` calls it.
 *
 * Bonds do not break during a solution. Loads and driven particles have their values at the end of the scene's
 * duration. */
#ifndef CLEAVE_SOLVER
#define CLEAVE_SOLVER

#include "base/archive.h"
#include "bonds/bonds.h"
#include "loads/loads.h"
#include "solver/field.h"

struct solver {
    int dim;
    int64_t n;           /* number of particles */
    real residual;       /* norm of the residual over `scale` [1] */
    real scale;          /* larger of the norms of applied forces and reactions [N] */
    real noise;          /* norm of forces caused by round-off of positions [N] */
    real first;          /* largest residual of a body without loads [N] */
    real applied;        /* norm of the applied forces on free components [N] */
    int64_t past_limit;  /* bonds beyond their critical stretch at the end */
    int64_t ramp;        /* relaxation: steps in which supports move to their final positions */
    real ramp_time;      /* relaxation on the grid: time in which supports move [s] */
    real farthest;       /* relaxation: largest norm of the displacements so far [m] */
    real damping;        /* relaxation on the grid: c dt of a step [1] */
    uint8_t *held;       /* [n] bit d is set if component d is driven */
    real *weight;        /* [n] 1/2 for every plane of symmetry that contains the particle */
    real *diagonal;      /* [n] Lambda: fictitious mass of relaxation, preconditioner of conjugate gradients [N/m] */
    struct field driven; /* [n] displacement of driven components [m] */
    struct field before; /* relaxation: forces of the previous step [N] */
    struct field u, r, d, q;    /* conjugate gradients: displacement, residual, direction d, K d */
    real rz;                    /* r . r/Lambda */
    real strain_ratio, u_ratio; /* strain of the last direction, and of u, over the largest component [1/m] */
    real best;                  /* smallest residual of all restarts [1] */
    int stalls;                 /* successive restarts that did not halve the residual */
};

/* The body to solve for; all pointers are borrowed. */
struct static_body {
    struct particles *part;
    struct bonds *bonds;
    struct loads *loads;
    bond_force_fn *force;
    const struct material *material;
    real spacing;   /* particle spacing [m] */
    real tolerance; /* of the residual, relative to the loads [1] */
    int bodies;
};

/* Sets driven components and applied forces to their values after `ramp_time` of the loads [s], and velocities to 0.
 * Sufficient for relaxation on the grid (relaxation.c). Returns REFUSED for loads that have no equilibrium. */
status solver_make(struct solver *s, const struct static_body *body, real ramp_time);

/* Makes the weights, the diagonal and the vectors that relaxation_step or, if conjugate_gradients is true, cg_step
 * needs. */
void solver_iteration_make(struct solver *s, const struct static_body *body, bool conjugate_gradients);

/* Frees what the solver owns. */
void solver_free(struct solver *s);

/* Makes step number `step` of an iteration; sets *done if the residual is below the tolerance. Returns FAILED if
 * there is no equilibrium. */
typedef status solver_step_fn(struct solver *s, const struct static_body *body, int64_t step, bool *done);
solver_step_fn relaxation_step, cg_step;

/* Returns the largest |component| of v. */
real solver_largest(const struct field *v, int dim, int64_t n);

/* Computes residual and scale from the norms of reactions and of residual forces, `left` [N]. */
void solver_scale(struct solver *s, real reaction, real left);

/* Saves or restores the state of an iteration. */
status solver_archive(struct solver *s, struct archive *a);

#endif
