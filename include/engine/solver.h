/* Static equilibrium instead of steps in time: what the solvers keep between two steps
 * (src/engine/solver.c).
 *
 * Bonds do not break while solving. Forces have their value at the end of the scene's duration, and driven particles
 * are where they have moved to until then. */
#ifndef CLEAVE_SOLVER
#define CLEAVE_SOLVER

#include "base/archive.h"

/* A vector of every particle. */
struct field { real *of[DIM_MAX]; };

struct solver {
    int dim;
    int64_t n;                           /* particles                                                 */
    real residual;                       /* force left over, over `scale` [1]                         */
    real scale;                          /* larger one of the norms of applied forces and reactions [N] */
    real noise;                          /* of forces, from the round-off of positions         [N]    */
    real first;                          /* largest force left over, of a body without loads   [N]    */
    real applied;                        /* norm of the applied forces on free components      [N]    */
    int64_t past_limit;                  /* bonds beyond their critical stretch at the end            */
    int64_t ramp;                        /* steps in which supports move (relaxation)                 */
    real ramp_time;                      /* the same on the grid                               [s]    */
    real way;                            /* relaxation: largest norm of the displacements so far [m]  */
    real damping;                        /* c dt of a step on the grid                         [1]    */
    uint8_t *held;                       /* [n] bit d: component d is driven                          */
    real *weight;                        /* [n] 1/2 for every plane of symmetry that a particle lies on */
    real *diagonal;                      /* [n] Lambda: fictitious mass, preconditioner        [N/m]  */
    struct field driven;                 /* [n] displacement of driven components              [m]    */
    struct field before;                 /* relaxation: forces of the step before              [N]    */
    struct field u, r, d, q;             /* cg: displacement, residual, direction, K d                */
    real rz;                             /* r . r/Lambda                                              */
    real strain_ratio, u_ratio;          /* strain of the last direction, and of u, over the largest entry [1/m] */
    real least;                          /* residual of all restarts                                  */
    int stalls;                          /* restarts without gain                                     */
};

void solver_free(struct solver *s);
status solver_archive(struct solver *s, struct archive *a);

#endif
