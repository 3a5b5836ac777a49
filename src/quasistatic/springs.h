/* Declares the preconditioner of load steps: a multigrid method for the linear stiffness of bonds, mesh cells and
 * contact. */
#ifndef CLEAVE_SPRINGS
#define CLEAVE_SPRINGS

#include "quasistatic/statics.h"
#include "run/run.h"

/* Computes result = M^-1 residual with the preconditioner M (callback `precondition` of solver/equilibrium.h), and
 * removes from the result the free rigid motions of unconstrained fragments (parts of the body that no support
 * constrains). Makes the preconditioner if there is none. run: a struct run; residual: residual forces [N]; result:
 * displacements [m]. */
void statics_preconditioner_apply(void *run, const struct field *residual, struct field *result);

/* Makes the multigrid preconditioner from the stiffness of the present bonds, cells and contacts, and stores it in
 * run->statics. */
void statics_preconditioner_make(struct run *run);

/* Frees the preconditioner of s, so that the next use makes a new one, if bonds that have broken since it was made have
 * made it inefficient. search_directions: number of search directions of the last solution; the limit is 1.5 times the
 * number in the first solution with the preconditioner, plus 8 (empirical). */
void statics_preconditioner_free_if_inefficient(struct statics *s, int64_t search_directions);

/* Frees the multigrid preconditioner in *s, so that its next use makes a new one. Does nothing if there is none. */
void statics_preconditioner_free(struct statics *s);

#endif
