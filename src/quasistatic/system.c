/* Assembles the system of equations of load steps: lists its unknowns, computes the forces on them, and sets up contact
 * and the preconditioner for the solver. */
#include "system.h"
#include "unconstrained.h"
#include "springs.h"
#include "contact_set.h"
#include "unknowns.h"

#include "base/memory.h"
#include "contact/contact.h"
#include "kernels/kernels.h"
#include "mesh/mesh_part.h"
#include "loads/mirrors.h"

/* ---- plastic state ----------------------------------------------------------------------------------------------- */

/* Saves the plastic state of bonds b and particles p to the archive a if a->saving is true, else restores it.
 * optional_arrays: which optional arrays the particles have, a set of bits WITH_... Returns FAILED, with a message, if
 * an entry is missing or has another size. */
status plastic_state_save_or_load(struct bonds *b, struct particles *p, int optional_arrays, struct archive *a)
{
    TRY(bonds_save_or_load(b, p, a));
    return particles_save_or_load(p, optional_arrays, a);
}

void plastic_state_save(struct memory_archive *m, struct bonds *b, struct particles *p, int optional_arrays)
{
    memory_archive_free(m);
    memory_archive_open_for_saving(m, ARCHIVE_TRIAL);
    const status kept = plastic_state_save_or_load(b, p, optional_arrays, &m->archive);
    INVARIANT(kept == OK);
}

void plastic_state_restore(struct memory_archive *m, struct bonds *b, struct particles *p, int optional_arrays)
{
    if (m->n == 0) return;
    memory_archive_rewind_for_loading(m);
    const status restored = plastic_state_save_or_load(b, p, optional_arrays, &m->archive);
    INVARIANT(restored == OK);
}

/* ---- forces ------------------------------------------------------------------------------------------------------ */

/* Adds the forces on mirror nodes of the mesh (nodes beyond a plane of symmetry), with the signs of the reflection, to
 * the forces on the nodes of which they are images. */
static void mirror_forces_add(struct mesh *mesh)
{
    for (int64_t k = 0; k < mesh->grid.mirror_nodes; k++) {
        const struct mirror_node *m = &mesh->grid.mirror_node[k];
        for (int d = 0; d < mesh->grid.dim && mesh->grid.mass[m->node] > 0; d++)
            mesh->grid.force[d][m->image] += m->sign[d] * mesh->grid.force[d][m->node];
    }
}

/* Adds s->applied[dim][particles], the sums of the applied forces of all loads [N], to the forces p->f of the loaded
 * particles. loads: lists these particles. */
static void applied_add(const struct statics *s, const struct loads *loads, struct particles *p)
{
    for (int d = 0; d < p->dim && s->applied[d]; d++)
        for (int64_t k = 0; k < loads->listed; k++) p->f[d][loads->list[k]] += s->applied[d][loads->list[k]];
}

/* Computes the forces on particles and mesh nodes of the run at their present positions: of bonds, contact, loads and
 * cells, as in a time step (step.c) without motion. */
static void forces_present(struct run *run)
{
    const bool has_mesh = run->frame->mesh.points > 0;
    if (has_mesh) lagrangian_mesh_move_bonded_or_loaded_points(run->frame, &run->part);
    loads_update_mirror_images_of_particles(&run->loads, &run->part);
    loads_clear_forces_of_loaded_particles(&run->loads, &run->part);
    plastic_state_restore(
        &run->statics->plastic, &run->bonds, &run->part,
        run->optional); /* that of the last equilibrium, whatever positions have been evaluated since */
    bond_forces(run->kernels.bond_force, &run->bonds, &run->part, &bond_limit_never, NULL);
    contact_compute_forces(run->contact, &run->part, 0);
    applied_add(run->statics, &run->loads, &run->part);
    if (has_mesh)
        lagrangian_mesh_compute_nodal_forces(run->frame, &run->part, run->clock.step),
            mirror_forces_add(&run->frame->mesh);
}

/* Computes the forces f [N] on all unknowns at the displacements u [m], without the components along free rigid
 * motions of unconstrained fragments (pieces that can move without resistance). It is the callback `force` of
 * solver/equilibrium.h; context: the run (struct run). */
static void statics_forces(void *context, const struct field *u, struct field *f)
{
    struct run *run = context;
    const struct statics *s = run->statics;
    unknowns_apply_displacements(s, &run->part, &run->frame->mesh, u);
    forces_present(run);
    for (int d = 0; d < run->part.dim; d++) {
        const real *part = run->part.f[d], *node = run->frame->mesh.grid.force[d];
#pragma omp parallel for schedule(static)
        for (int64_t k = 0; k < s->balance.n; k++)
            f->of[d][k] = k < s->particles ? s->weight[k] * part[s->node[k]] : node[s->node[k]];
    }
    field_remove_free_rigid_motion(s, f);
}

void run_move_to_solution_and_update_plastic_state(struct run *run)
{
    unknowns_apply_displacements(run->statics, &run->part, &run->frame->mesh, &run->statics->balance.u);
    if (run->statics->plastic.n > 0) forces_present(run);
}

/* ---- unknowns ---------------------------------------------------------------------------------------------------- */

/* Returns the energy scale of the body at unit strain [J]: the sum over particles p of Young's modulus times volume.
 * material: materials of the scene. */
static real energy_at_unit_strain(const struct particles *p, const struct material *material)
{
    real sum = 0;
    for (int64_t i = 0; i < p->n; i++) sum += material[p->material[i]].young * p->volume0[i];
    return sum;
}

void statics_equation_system_make(struct run *run)
{
    struct statics *s = run->statics;
    const struct newton_solver kept = s->balance; /* its counters and losses are kept */
    s->balance = (struct newton_solver){.force = statics_forces,
                                        .precondition = statics_preconditioner_apply,
                                        .settle = statics_update_contacts_and_test_unchanged,
                                        .laws = statics_contact_use_fixed_set_or_all_overlaps,
                                        .context = run,
                                        .tolerance = run->scene->solver_tolerance,
                                        .length = run->scene->spacing,
                                        .unit_energy = energy_at_unit_strain(&run->part, run->scene->material),
                                        .kinked = run->part.plastic_correction[0] != NULL,
                                        .forces = kept.forces,
                                        .directions = kept.directions,
                                        .lost = kept.lost,
                                        .largest = kept.largest};
    s->has_contact = run->contact->law.between != CONTACT_NONE || run->scene->rigids > 0;
    unknowns_list_particles_and_nodes(s, &run->part, &run->frame->mesh, &run->loads);
    unconstrained_fragments_find(run);
    plastic_state_save(&run->statics->plastic, &run->bonds, &run->part, run->optional);
}

void statics_equation_system_free(struct statics *s)
{
    const struct newton_solver kept = s->balance;
    unconstrained_fragments_free(s);
    unknowns_free(s);
    s->balance.forces = kept.forces, s->balance.directions = kept.directions, s->balance.lost = kept.lost;
    s->balance.largest = kept.largest;
}

void statics_free(struct statics *s)
{
    statics_preconditioner_free(s);
    statics_equation_system_free(s);
    for (int d = 0; d < DIM_MAX; d++) memory_free(s->applied[d]), s->applied[d] = NULL;
    memory_archive_free(&s->plastic);
    memory_free(s->next.bond), memory_free(s->flow_start);
    s->flow_start = NULL;
    s->next = (struct break_list){0};
}
