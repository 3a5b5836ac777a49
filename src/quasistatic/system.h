/* Declares the system of equations of load steps: its unknown displacements and the forces on them. */
#ifndef CLEAVE_SYSTEM
#define CLEAVE_SYSTEM

#include "base/memory_archive.h"
#include "run/run.h"

/* Makes the system of equations, one unknown displacement per present peridynamic particle and moving mesh node,
 * starting from the present displacements. Counters, energy losses and the largest force norm of an earlier system in
 * run->statics are kept. Release with statics_equation_system_free. */
void statics_equation_system_make(struct run *run);

/* Frees the system of equations of the load steps (static equilibria) in *s. Counters, energy losses and the largest
 * force norm remain in *s, for the next system. */
void statics_equation_system_free(struct statics *s);

/* Moves particles and mesh nodes of the run to the displacements of the last solution. If the body can yield, also
 * computes the forces at these positions, which updates the plastic state of bonds and material points. */
void run_move_to_solution_and_update_plastic_state(struct run *run);

/* Saves the plastic state of bonds b and particles p to the archive a if a->saving is set, else restores it from the
 * archive. optional_arrays: which optional arrays the particles have, a set of bits WITH_... Returns FAILED if an entry
 * is missing or has another size. */
status plastic_state_save_or_load(struct bonds *b, struct particles *p, int optional_arrays, struct archive *a);

/* Copies the plastic state of bonds b and particles p to *m, and frees the former contents of *m. Later solutions start
 * from this state (plastic_state_restore). optional_arrays: which optional arrays the particles have, a set of bits
 * WITH_... */
void plastic_state_save(struct memory_archive *m, struct bonds *b, struct particles *p, int optional_arrays);

/* Restores the plastic state of bonds b and particles p that plastic_state_save has copied to *m. Does nothing if there
 * is no copy. optional_arrays: which optional arrays the particles have, a set of bits WITH_... */
void plastic_state_restore(struct memory_archive *m, struct bonds *b, struct particles *p, int optional_arrays);

#endif
