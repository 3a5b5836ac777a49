/* The preconditioner of load steps: multigrid on the linear stiffness of bonds, cells and contact. */
#ifndef CLEAVE_SPRINGS
#define CLEAVE_SPRINGS

#include "quasistatic/statics.h"
#include "run/run.h"

/* Computes z = M^-1 r (`precondition` of solver/equilibrium.h). Makes the preconditioner if there is none. engine: a
 * struct run. */
void statics_precondition(void *engine, const struct field *r, struct field *z);

/* Makes the preconditioner from the present bonds, cells and contacts. */
void statics_precondition_make(struct run *e);

/* Frees the preconditioner if it has become inefficient because bonds have broken. directions: number of search
 * directions of the last solution; the limit is 1.5 times that of the first solution with the preconditioner, plus 8
 * (empirical). */
void statics_precondition_watch(struct statics *s, int64_t directions);

/* Frees the preconditioner, if there is one. */
void statics_precondition_free(struct statics *s);

#endif
