/* Declares the search for unconstrained fragments: parts of the body that can move as rigid bodies, since no support,
 * bond or contact prevents it. */
#ifndef CLEAVE_UNCONSTRAINED
#define CLEAVE_UNCONSTRAINED

#include "quasistatic/statics.h"
#include "run/run.h"

/* Largest number of rigid motions of a fragment; also the number of columns of unconstrained_fragment.motion. */
enum { MODES_MOST = 6 };

/* Finds the unconstrained fragments for the present bonds, supports and contacts, and stores them with their free rigid
 * motions in run->statics. A fragment is a connected part of the body; it is unconstrained if nothing resists some of
 * its rigid motions. The list found before is freed. */
void unconstrained_fragments_find(struct run *run);

/* Frees the list of unconstrained fragments in *s (parts of the body that can move freely as rigid bodies). */
void unconstrained_fragments_free(struct statics *s);

/* Checks that the applied forces on each unconstrained fragment (part of the body that can move freely as a rigid body)
 * in s are balanced along its free rigid motions. p: particles; nodes_are_in_equilibrium: true if the nodal forces are
 * those of an equilibrium; if false, only loads on peridynamic particles are checked. step: number of the load step,
 * for the message. Returns OK if they are balanced, else FAILED, with position and size of the fragment
 * in the message. */
status unconstrained_fragments_check_force_balance(const struct statics *s, const struct particles *p,
                                                   bool nodes_are_in_equilibrium, int64_t step);

/* Removes from the field v (nodal forces or displacements) its components along the free rigid motions of the
 * unconstrained fragments in s (parts of the body that can move freely as rigid bodies), by orthogonal projection. */
void field_remove_free_rigid_motion(const struct statics *s, struct field *v);

#endif
