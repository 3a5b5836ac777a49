/* Room `solver` (folders include/solver and src/solver): static equilibrium of peridynamic bodies by adaptive dynamic
 * relaxation or conjugate gradients, and solvers for load steps (equilibrium.h, multigrid.h). It uses particles, bonds
 * and loads, but neither scenes nor runs; src/quasistatic calls it.
 *
 * No bond breaks during a solution. Loads and prescribed motion have their values at the end of the scene's
 * duration. */
#ifndef CLEAVE_SOLVER
#define CLEAVE_SOLVER

#include "base/archive.h"
#include "bonds/bonds.h"
#include "loads/loads.h"
#include "solver/field.h"

/* State of the solver of one static equilibrium of particles, by dynamic relaxation or conjugate gradients. Arrays are
 * owned and indexed by particle; struct field: one array [n] for each axis. */
struct static_solver {
    int dim;             /* number of components of a displacement */
    int64_t n;           /* number of particles */
    real residual;       /* norm of the residual divided by `scale` [1] */
    real scale;          /* larger of the norms of applied forces and reactions [N] */
    real noise;          /* norm of forces caused by round-off of positions [N] */
    real first;          /* largest norm of the residual so far of a body without loads [N] */
    real applied;        /* norm of the applied forces on free components [N] */
    int64_t past_limit;  /* bonds beyond their critical stretch at the end */
    int64_t ramp;        /* relaxation: steps in which supports move to their final positions */
    real ramp_time;      /* relaxation on the grid: time in which supports move [s] */
    real farthest;       /* relaxation: largest norm of the displacements so far [m] */
    real damping;        /* relaxation on the grid: c dt of a step [1] */
    uint8_t *held;       /* [n] bit d is set if component d of the displacement is prescribed */
    real *weight;        /* [n] factor 1/2 for every plane of symmetry that contains the particle [1] */
    real *diagonal;      /* [n] Lambda: fictitious mass of relaxation, preconditioner of conjugate gradients [N/m] */
    struct field driven; /* [n] prescribed components of the displacement [m] */
    struct field before; /* relaxation: forces of the previous step [N] */
    struct field u, r, d, q;    /* [n] conjugate gradients: displacement u, residual r, direction d, K d */
    real rz;                    /* conjugate gradients: r . r/Lambda */
    real strain_ratio, u_ratio; /* strain of the last direction, and of u, divided by the largest component [1/m] */
    real best;                  /* smallest residual of all restarts [1] */
    int stalls;                 /* number of successive restarts that did not halve the residual */
};

/* The particles, bonds and loads whose static equilibrium is computed. All pointers are borrowed. force: kernel of the
 * bond forces; material: array of the materials; bodies: number of bodies of the scene. */
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

/* Initialises the static solver *s: sets the displacements of driven particles (those with prescribed motion) and the
 * applied forces to the values of the loads at the end of the scene, and the velocities of all particles to 0. body:
 * particles, bonds and loads. ramp_time: for relaxation on the background grid, time in which the supports move [s].
 * Other iterations also need static_solver_make_iteration_vectors. Returns REFUSED, with a message, if applied forces
 * or moments are neither balanced nor carried by supports. Release with static_solver_free. */
status static_solver_make(struct static_solver *s, const struct static_body *body, real ramp_time);

/* Allocates and computes the vectors in *s that cg_step and relaxation_step need for `body`: weights of particles on
 * mirror planes, diagonal stiffness, round-off of the forces. static_solver_make must have been called.
 * conjugate_gradients: true to prepare for cg_step, false for relaxation_step. Release with static_solver_free. */
void static_solver_make_iteration_vectors(struct static_solver *s, const struct static_body *body,
                                          bool conjugate_gradients);

/* Frees the vectors of the static solver *s, which static_solver_make and static_solver_make_iteration_vectors have
 * allocated, and sets all its members to 0. */
void static_solver_free(struct static_solver *s);

/* Type of a function that does step number `step`, from 0, of an iteration for static equilibrium: relaxation_step by
 * dynamic relaxation, cg_step by conjugate gradients. s: state of the iteration; body: particles, bonds and loads;
 * *done: false on entry, receives true if the equilibrium is reached, with a residual of at most body->tolerance.
 * Returns FAILED, with a message, if the iteration stalls or a part of the body moves without resistance. */
typedef status static_solver_step_fn(struct static_solver *s, const struct static_body *body, int64_t step, bool *done);
static_solver_step_fn relaxation_step, cg_step;

/* Returns the largest absolute value of all components of the vectors `vectors`, in the unit of the vectors; 0 if there
 * are none. dim: number of components of a vector; vector_count: number of vectors (particles or nodes). */
real field_largest_absolute_component(const struct field *vectors, int dim, int64_t vector_count);

/* Sets the scale of forces s->scale = max(s->applied, reaction_norm) [N] and the residual s->residual =
 * unbalanced_norm/s->scale [1]. reaction_norm: norm of the forces on constrained components [N]; unbalanced_norm: norm
 * of the forces on free components, which vanish in equilibrium [N]. Without loads, the scale is the largest
 * `unbalanced_norm` so far. The residual is 0 if the unbalanced forces are 0 or, without loads, round-off. */
void static_solver_compute_relative_residual(struct static_solver *s, real reaction_norm, real unbalanced_norm);

/* Saves the state of the static iteration *s to the archive `a` (checkpoint file or memory) if a->saving is set, else
 * restores *s from `a`. Returns FAILED if the archive cannot be read or written or a stored size differs. */
status static_solver_save_or_load(struct static_solver *s, struct archive *a);

#endif
