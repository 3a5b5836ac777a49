/* Declares the functions that compute the work of supports and of applied forces between two equilibria. */
#ifndef CLEAVE_ACCOUNT
#define CLEAVE_ACCOUNT

#include "loads/loads.h"
#include "quasistatic/statics.h"

/* Copy of one equilibrium: displacements and forces of all unknowns, applied forces and positions. The work of the
 * loads up to the next equilibrium is computed from it. Made by work_account_store_initial_equilibrium, freed when the
 * work is added. */
struct work_account {
    struct field u, f;      /* [nodes] displacement [m], force [N] */
    real *applied[DIM_MAX]; /* [particles of the body] applied forces [N] */
    real *x[DIM_MAX];       /* [particles of the body] positions [m] */
};

/* Allocates the dim arrays applied[0 .. dim - 1] and copies the present applied forces of s, the state of the load
 * steps (successive static equilibria), to them, a value for each of `particles` [N]; 0 before the first solution. The
 * caller releases each array with memory_free. */
void applied_forces_allocate_and_copy(real **applied, const struct statics *s, const struct particles *particles);

/* Copies the present positions of `particles` and the displacements and forces of s, the state of the load steps
 * (successive static equilibria), into *account, for work_account_add_work_and_estimate_error. The storage is freed by
 * work_account_add_work_and_estimate_error or work_account_free. */
void work_account_store_initial_equilibrium(struct work_account *account, const struct statics *s,
                                            const struct particles *particles);

/* Adds the work of supports and of applied forces since work_account_store_initial_equilibrium to the work that `loads`
 * stores: the mean of the initial and final force times the displacement (trapezoidal rule), and `curved_path_work`,
 * the work of loads beyond that mean along the curved path of the solver [J]. s, p: state of the load steps (static
 * equilibria), and particles. Frees the storage of *account. Returns an estimate of the error of the work [J]: its
 * difference from the work with the initial or the final force alone, plus the largest work of the round-off of forces,
 * which is the only work on an unloaded body that moves along with a rigid body. */
real work_account_add_work_and_estimate_error(struct work_account *account, const struct statics *s,
                                              const struct particles *p, struct loads *loads, real curved_path_work);

/* Frees the arrays in *account that work_account_store_initial_equilibrium has allocated, if the work is not to be
 * computed. */
void work_account_free(struct work_account *account);

#endif
