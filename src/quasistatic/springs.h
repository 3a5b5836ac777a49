/* The preconditioner of load steps: multigrid on the springs of bonds, cells and contact. */
#ifndef CLEAVE_SPRINGS
#define CLEAVE_SPRINGS

#include "quasistatic/statics.h"
#include "run/run.h"

/* Computes z = M^-1 r (solver/equilibrium.h); makes the preconditioner if there is none. `engine`: struct run. */
void statics_precondition(void *engine, const struct field *r, struct field *z);

/* Makes the preconditioner from the present bonds. */
void statics_precondition_make(struct run *e);

/* Frees the preconditioner if the last solution took many more search directions than the first one with it did.
 * directions: of the last solution. */
void statics_precondition_watch(struct statics *s, int64_t directions);

/* Frees the preconditioner, if there is one. */
void statics_precondition_free(struct statics *s);

#endif
