/* Static equilibrium under forces that derive from an energy, by Newton's method. Each correction is solved by
 * preconditioned conjugate gradients (Hestenes & Stiefel 1952) to a tolerance that follows the residual (Dembo,
 * Eisenstat & Steihaug 1982). No matrix is stored: the product of the stiffness with a direction is a difference of
 * forces (Knoll & Keyes 2004).
 *
 * Unknowns are displacements of nodes, which are particles or nodes of a mesh; only the caller distinguishes them. */
#ifndef CLEAVE_EQUILIBRIUM
#define CLEAVE_EQUILIBRIUM

#include "base/base.h"
#include "solver/field.h"

/* State of the solver: vectors over the nodes, which it owns (struct field: one array [n] for each axis), functions
 * that the caller sets, tolerances and counters. */
struct newton_solver {
    int dim;           /* number of components of a displacement */
    int64_t n;         /* number of nodes */
    struct field u, f; /* [n] displacement [m]; force [N], of held components on the support */
    uint8_t *held;     /* [n] bit d is set if component d of the displacement is prescribed */
    /* [n] vectors of conjugate gradients: direction d, K d, residual, preconditioned residual, correction; `at`:
     * displacement at which forces are evaluated [m] */
    struct field d, q, r, z, x, at;
    struct field before, grown; /* [n] forces at u under the previous loads; change of the loads since [N] */

    /* Computes all forces at displacement u, except those of supports, into f. Must be deterministic. */
    void (*force)(void *context, const struct field *u, struct field *f);
    /* Computes z = M^-1 r with M symmetric and positive definite; held components of z become 0. */
    void (*precondition)(void *context, const struct field *r, struct field *z);
    /* Let forces be smooth within a correction, as conjugate gradients require, although laws change with the state
     * (yield, contact). settle: fixes the laws for the present state; returns true if they have not changed; may set
     * `applied`. laws: with `settled` false, the laws follow every state at which forces are evaluated, for the line
     * search; with true, those fixed by settle hold again. NULL if laws do not change. */
    bool (*settle)(void *context);
    void (*laws)(void *context, bool settled);
    void *context; /* first argument of the four functions above, kept by reference */

    real tolerance; /* largest norm of the residual divided by that of loads or reactions, at which it converges [1] */
    real reach;     /* largest displacement of a node by one Newton correction [m]; 0: no limit */
    real noise;     /* norm of forces up to which forces are round-off [N] */
    real length;    /* distance between neighbouring nodes [m] */
    real unit_energy; /* energy of the body at unit strain [J], which scales the steps of force differences */
    bool kinked;      /* the forces are not differentiable everywhere, for example where points yield */

    /* Counters, set to 0 by newton_solver_make or by the caller: */
    int64_t forces, directions; /* number of force evaluations; of directions of conjugate gradients */
    /* Work of unbalanced forces between equilibria [J]: the energy lost in dynamic motion that is not resolved. Work of
     * supports is taken as the mean of their forces in both equilibria times their increment. */
    real lost;

    real bent; /* work of the loads along the last increment minus their mean in both equilibria times the increment [J]
                */
    real residual;     /* norm of the residual divided by `scale` [1] */
    real scale;        /* larger of the norms of applied forces and reactions [N] */
    real largest;      /* largest scale so far [N] */
    real applied;      /* norm of the applied forces, set by the caller [N] */
    real strain_ratio; /* strain of the last direction divided by its largest component [1/m] */
    int64_t worst;     /* index of the node with the largest residual */
};

/* Initialises the Newton solver *newton for `node_count` nodes (particles or nodes of a mesh) in `dim` space
 * dimensions: allocates all vectors and sets them to 0. Functions and tolerances are set by the caller. Release with
 * newton_solver_free. */
void newton_solver_make(struct newton_solver *newton, int dim, int64_t node_count);

/* Frees the vectors of the Newton solver *newton, which newton_solver_make has allocated. */
void newton_solver_free(struct newton_solver *newton);

/* Finds the static equilibrium under the present loads by Newton's method. On entry newton->u and newton->f are
 * displacement and forces of the previous equilibrium, on return those of the new one. loads_changed: true if loads or
 * supports have changed since the previous equilibrium, false if only the body has, for example by broken bonds.
 * increment: first change of newton->u, n vectors [m]: its prescribed components are the motion of supports, the others
 * a guess; used only if loads_changed is true. Returns FAILED, with a message, if after all corrections the norm of
 * unbalanced forces exceeds both newton->tolerance times that of loads and reactions and newton->noise, the norm of
 * round-off [N]; newton->u is then the displacement after the last correction. */
status newton_solver_find_equilibrium(struct newton_solver *newton, const struct field *increment, bool loads_changed);

#endif
