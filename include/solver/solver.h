/* Room `solver`: static equilibrium of peridynamic bodies instead of steps in time, by adaptive dynamic relaxation or
 * conjugate gradients. It knows particles, bonds and loads, but neither scenes nor the engine, whose file
 * solve.c drives it.
 *
 * Bonds do not break while solving. Forces have their value at the end of the scene's duration, and driven particles
 * are where they have moved to until then. */
#ifndef CLEAVE_SOLVER
#define CLEAVE_SOLVER

#include "base/archive.h"
#include "bonds/bonds.h"
#include "loads/loads.h"
#include "solver/field.h"

struct solver {
    int dim;
    int64_t n;                  /* particles */
    real residual;              /* force left over, over `scale` [1] */
    real scale;                 /* larger one of the norms of applied forces and reactions [N] */
    real noise;                 /* of forces, from the round-off of positions [N] */
    real first;                 /* largest force left over, of a body without loads [N] */
    real applied;               /* norm of the applied forces on free components [N] */
    int64_t past_limit;         /* bonds beyond their critical stretch at the end */
    int64_t ramp;               /* steps in which supports move (relaxation) */
    real ramp_time;             /* the same on the grid [s] */
    real farthest;              /* relaxation: largest norm of the displacements so far [m] */
    real damping;               /* c dt of a step on the grid [1] */
    uint8_t *held;              /* [n] bit d: component d is driven */
    real *weight;               /* [n] 1/2 for every plane of symmetry that a particle lies on */
    real *diagonal;             /* [n] Lambda: fictitious mass, preconditioner [N/m] */
    struct field driven;        /* [n] displacement of driven components [m] */
    struct field before;        /* relaxation: forces of the step before [N] */
    struct field u, r, d, q;    /* cg: displacement, residual, direction, K d */
    real rz;                    /* r . r/Lambda */
    real strain_ratio, u_ratio; /* strain of the last direction, and of u, over the largest entry [1/m] */
    real best;                  /* smallest residual of all restarts */
    int stalls;                 /* restarts without gain */
};

/* The body to solve for; all of it borrowed. */
struct static_body {
    struct particles *part;
    struct bonds *bonds;
    struct loads *loads;
    bond_force_fn *force;
    const struct material *material;
    real spacing;   /* [m] */
    real tolerance; /* of the residual, over the loads [1] */
    int bodies;
};

/* Driven components and applied forces after `ramp_time` of the loads [s]; velocities become 0. REFUSED for loads
 * without equilibrium. Enough for a relaxation on the grid (relaxation.c). */
status solver_make(struct solver *s, const struct static_body *body, real ramp_time);
/* What relaxation_step and cg_step (conjugate_gradients) need besides. */
void solver_iteration_make(struct solver *s, const struct static_body *body, bool conjugate_gradients);
void solver_free(struct solver *s);

/* Step number `step` of an iteration; *done if the residual is small enough. FAILED where no equilibrium is in
 * reach. */
typedef status solver_step_fn(struct solver *s, const struct static_body *body, int64_t step, bool *done);
solver_step_fn relaxation_step, cg_step;

/* Largest |entry|. */
real solver_largest(const struct field *v, int dim, int64_t n);
/* Residual and scale from the norms of reactions and of residual forces `left` [N]. */
void solver_scale(struct solver *s, real reaction, real left);

/* Saves or restores what changes in steps. */
status solver_archive(struct solver *s, struct archive *a);

#endif
