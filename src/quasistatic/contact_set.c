/* Contact and rigid bodies in load steps (successive static equilibria). The position of a rigid body is a function of
 * the pseudo-time.
 *
 * The set of active contacts (pairs that carry forces) and the equilibrium are determined alternately
 * (contact/contact_touch.c). A solution first changes active contacts, pairs and positions of rigid bodies, which
 * alters the contact energy while the body does not move. The energy that a solution with contact loses is therefore
 * computed as the work of the loads minus the change of all energies, not from the work of the forces along the
 * path. */
#include <math.h>
#include <stdio.h>

#include "contact_set.h"
#include "unconstrained.h"
#include "springs.h"
#include "unknowns.h"

#include "contact/contact.h"
#include "mesh/mesh_part.h"
#include "rigid/rigid_part.h"
#include "step/sample.h"
#include "loads/mirrors.h"

#define CARRIED 1e-6     /* largest gap at which contact is searched: another body may support this one [spacings] */
#define SUBSTEP_MOST 0.2 /* largest displacement of a rigid body in a substep [spacings] */
enum { SUBSTEPS_MOST = 10000 }; /* largest number of substeps of an increment */

bool crack_faces_are_in_contact(const struct contact *c) { return c->law.between == CONTACT_ALL && c->touching > 0; }

/* Returns the total number of free motions (rigid motions that neither supports nor contact resist) of the
 * unconstrained fragments of s. */
static int free_motions(const struct statics *s)
{
    int n = 0;
    for (int64_t q = 0; q < s->fragments; q++) n += s->fragment[q].motions;
    return n;
}

/* Finds the unconstrained fragments of the run (pieces of the body that can move rigidly without resistance) again
 * after contact has changed. Discards the preconditioner if the total number of their free motions has changed. */
static void unconstrained_update(struct run *run)
{
    const int before = free_motions(run->statics);
    unconstrained_fragments_find(run);
    if (free_motions(run->statics) != before) statics_preconditioner_free(run->statics);
}

/* Searches run for contact pairs and selects the active contacts (pairs that carry forces). close: largest gap at which
 * a pair becomes active [spacings]. Returns the number of changes of the set of active contacts. */
static int64_t statics_contact_search(struct run *run, real close)
{
    return contact_search_and_select_linear_springs(run->contact, &run->part, &run->bonds, &run->loads,
                                                    &run->source.family, close);
}

void statics_contact_search_before_first_solution(struct run *run)
{
    if (!run->statics->has_contact) return;
    run->contact->marked = true;
    loads_update_mirror_images_of_particles(&run->loads, &run->part);
    if (!run->contact->made || !run->contact->touch) statics_contact_search(run, CARRIED);
}

int statics_rigid_motion_substep_count(const struct scene *s, const struct rigid_set *rigid, real pseudo_time)
{
    real most = 0;
    for (int k = 0; k < s->rigids; k++) {
        const struct rigid_body *r = &rigid->body[k];
        real shift[DIM_MAX];
        rigid_compute_prescribed_displacement(r, pseudo_time, shift);
        for (int d = 0; d < r->dim; d++) most = real_max(most, fabs(r->centre[d] + shift[d] - r->x[d]));
    }
    return (int)real_min(SUBSTEPS_MOST, real_max(1, ceil(most / (SUBSTEP_MOST * s->spacing))));
}

/* Returns the sum of strain energy, contact energy and plastic work of bonds of the run at the positions at which
 * forces were last computed [J]. */
static real energy_present(struct run *run)
{
    return run_compute_elastic_energy(run) + contact_elastic_energy(run->contact, &run->part) +
           bond_plastic_work(&run->bonds);
}

bool statics_contact_existed_before_or_exists_now(const struct statics *s, const struct contact *c)
{
    return s->in_contact || c->touching > 0;
}

/* Prepares contact of the run for the solution at `pseudo_time` [s]: stores the energy before the solution, moves rigid
 * bodies and searches for contacts. The stored energy includes contact energy only if anything was in contact before.
 * If anything is in contact now, finds the unconstrained fragments (pieces of the body that can move rigidly without
 * resistance) again, since contact may constrain them. */
void statics_move_rigid_bodies_and_search_contacts(struct run *run, real pseudo_time)
{
    struct statics *s = run->statics;
    struct newton_solver *newton = &s->balance;
    const bool touched = s->in_contact;
    s->in_contact = false, newton->reach = 0;
    if (!run->statics->has_contact) return;
    statics_contact_search_before_first_solution(run);
    newton->force(run, &newton->u, &newton->f);
    s->energy = energy_present(run) - (touched ? 0 : contact_elastic_energy(run->contact, &run->part));
    rigids_move_to_prescribed_positions(run->rigid, pseudo_time);
    s->in_contact = statics_contact_search(run, CARRIED) > 0 || touched;
    s->largest = newton->largest;
    if (!s->in_contact) return;
    unconstrained_update(run);
    newton->force(run, &newton->u, &newton->f);
    newton->reach = contact_pair_list_safe_displacement(run->contact);
}

/* Updates the set of active contacts at the end of a solution, by a new search for pairs if one is needed
 * (contact_search_is_needed), else by the overlap of the known pairs. Returns true if the set has not changed, so that
 * the equilibrium is valid. Also recomputes the norm of the loads, by which residuals are measured, with the present
 * contact forces. run: the run (struct run). */
bool statics_update_contacts_and_test_unchanged(void *run)
{
    struct run *e = run;
    struct statics *s = e->statics;
    struct contact *c = e->contact;
    if (!e->statics->has_contact) return true;
    unknowns_apply_displacements(s, &e->part, &e->frame->mesh, &s->balance.u);
    loads_update_mirror_images_of_particles(&e->loads, &e->part);
    const int64_t changed = contact_search_is_needed(c, &e->part)
                                ? 1 + statics_contact_search(e, 0)
                                : contact_select_linear_springs_and_count_changes(c, &e->part, 0);
    s->balance.applied = applied_forces_norm(s, &e->part, &e->loads, c);
    s->balance.largest = s->largest;
    if (changed > 0) unconstrained_update(e);
    return changed == 0;
}

void statics_contact_use_fixed_set_or_all_overlaps(void *run, bool use_fixed_set)
{
    struct run *e = run;
    if (e->statics->has_contact) contact_restrict_forces_to_linear_springs(e->contact, use_fixed_set);
}

real rigid_body_work_add_and_estimate_error(struct run *run, real load_work, real solver_loss)
{
    struct statics *s = run->statics;
    struct newton_solver *newton = &s->balance;
    real range = 0;
    if (!run->statics->has_contact) return 0;
    if (s->in_contact || run->contact->touching > 0) newton->force(run, &newton->u, &newton->f);
    for (int k = 0; k < run->scene->rigids; k++) {
        const real before = run->rigid->body[k].work;
        for (int d = 0; d < run->part.dim; d++)
            range += 0.5 * fabs((run->rigid->body[k].force[d] - run->rigid->body[k].force_previous[d]) *
                                run->rigid->body[k].increment[d]);
        rigid_add_work_of_prescribed_motion(&run->rigid->body[k]);
        load_work += run->rigid->body[k].work - before;
    }
    if (statics_contact_existed_before_or_exists_now(s, run->contact))
        newton->lost = solver_loss + load_work - (energy_present(run) - s->energy);
    s->in_contact = run->contact->touching > 0;
    return range;
}

void rigid_bodies_update_largest_contact_forces(struct rigid_set *rigid, int rigid_body_count)
{
    for (int k = 0; k < rigid_body_count; k++) rigid_update_largest_contact_force(&rigid->body[k]);
}

void rigid_bodies_warn_of_no_contact(struct warnings *warnings, const struct rigid_set *rigid, int rigid_body_count,
                                     real least_force)
{
    for (int k = 0; k < rigid_body_count; k++) {
        const struct rigid_body *r = &rigid->body[k];
        char text[200];
        snprintf(text, sizeof text,
                 "no force acted on rigid body %.60s while it moved in a load step: check that it touches a body, and "
                 "that this body is held",
                 r->name);
        if (r->motion == RIGID_DRIVEN && r->force_most <= least_force) warnings_add_and_print(warnings, text);
    }
}
