/* The work of supports and applied forces between two equilibria. */
#ifndef CLEAVE_ACCOUNT
#define CLEAVE_ACCOUNT

#include "loads/loads.h"
#include "quasistatic/statics.h"

/* Displacements and forces of an equilibrium, from which the work up to the next one is computed. */
struct account {
    struct field u, f;      /* [nodes] displacement [m], force [N] */
    real *applied[DIM_MAX]; /* [particles of the body] applied forces [N] */
    real *x[DIM_MAX];       /* [particles of the body] positions [m] */
};

/* Stores a copy of the present applied forces in applied[dim], arrays with a value for each particle of the body [N]; 0
 * before the first solution. The caller frees the arrays. */
void applied_forces_copy(real **applied, const struct statics *s, const struct particles *part);

/* Copies the present positions, displacements and forces into *a, for work_account_end. The storage is freed by
 * work_account_end or work_account_free. */
void work_account_start(struct account *a, const struct statics *s, const struct particles *part);

/* Adds the work of supports and of applied forces since work_account_start to that of the loads: the mean of the
 * initial and final force times the displacement (trapezoidal rule), and `curved_path_work`, the work of loads beyond
 * that mean along the curved path of the solver [J]. Frees the storage of *a. Returns an estimate of the error of the
 * work [J], its difference from the work with the initial or the final force alone. */
real work_account_end(struct account *a, const struct statics *s, const struct particles *p, struct loads *loads,
                      real curved_path_work);

/* Frees the storage of *a. */
void work_account_free(struct account *a);

#endif
