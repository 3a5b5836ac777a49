/* Saves the state of a run to checkpoints and restores it; what is not stored is rebuilt from the restored particles
 * and bonds. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "engine_internal.h"
#include "run/part.h"
#include "base/memory.h"
#include "simd/simd.h"
#include "coupling/coupling_part.h"
#include "grid/grid_part.h"
#include "mesh/mesh_part.h"
#include "output/output.h"

#define FAR_AWAY 1e7 /* largest coordinate of a particle [spacings]; as too_far in fill.c */

/* Checks the particles p, which were restored from a checkpoint before their indices are used in arrays. A checkpoint
 * with a correct checksum may still contain a state that no run of scene s produces. Returns FAILED, with a message,
 * for such a state. */
static status particles_check(const struct scene *s, const struct particles *p)
{
    for (int64_t i = 0; i < p->n_all; i++) {
        real sum = 0;
        bool good = p->kind[i] < KINDS && p->material[i] < s->materials && p->body[i] < s->bodies && p->mass[i] > 0 &&
                    isfinite(p->mass[i]);
        good = good && (i >= p->n || (p->id[i] >= 0 && p->id[i] < p->n_body));
        for (int d = 0; d < p->dim; d++) {
            good = good && (i >= p->n || fabs(p->X[d][i]) <= FAR_AWAY * s->spacing || !(s->spacing > 0));
            sum += 0 * (p->X[d][i] + p->x[d][i] + p->v[d][i]);
        }
        if (!good || !(sum == 0))
            return status_set(FAILED,
                              "cannot resume: particle %lld of the checkpoint has a state that is impossible in a run "
                              "of this scene; it is damaged, start again with --overwrite",
                              (long long)i);
    }
    return OK;
}

/* Saves the name of the set of kernels in use (machine instructions for which the loops are compiled) to the archive a,
 * or compares it with the name in a checkpoint. Warns if they differ, since results then differ by round-off. to: list
 * of warnings. Returns FAILED if the archive cannot be written or lacks the name. */
static status kernels_archive(struct warnings *to, struct archive *a)
{
    char text[256];
    const struct simd_set *now = simd_current_kernels();
    char then[16] = {0};
    snprintf(then, sizeof then, "%s", now->name);
    ARCHIVE_VALUE(a, "engine/kernels", then);
    then[sizeof then - 1] = 0;
    if (strcmp(then, now->name) == 0) return OK;
    snprintf(text, sizeof text,
             "the checkpoint was written with %s kernels, but the run continues with %s: results agree to round-off, "
             "not to the last bit; CLEAVE_SIMD=%s keeps the kernels if the processor has them",
             then, now->name, then);
    warnings_add_and_print(to, text);
    return OK;
}

/* Saves which mesh cells are hollow to the archive a. Hollow cells are inside a body and have no particles, because
 * coarse cells replace them. hollow: marks of these cells; hollow->absent is NULL if there are none. They are restored
 * before the rest of the checkpoint (restore.c). Returns FAILED if the archive cannot be written. */
static status hollow_save(const struct cells_without_particles *hollow, struct archive *a)
{
    int64_t n = hollow->absent ? hollow->box.n : 0;
    ARCHIVE_VALUE(a, "hollow/cells", n);
    return n > 0 ? a->exchange(a, "hollow/absent", hollow->absent, (size_t)n) : OK;
}

/* Saves time, step number, number of steps and time step of the clock c of a run to the archive a if a->saving, else
 * restores them. Returns FAILED if the archive cannot be read or written or lacks one of them. */
static status clock_archive(struct run_clock *c, struct archive *a)
{
    ARCHIVE_VALUE(a, "engine/t", c->t);
    ARCHIVE_VALUE(a, "engine/step", c->step);
    ARCHIVE_VALUE(a, "engine/steps", c->steps);
    ARCHIVE_VALUE(a, "engine/dt", c->dt);
    return OK;
}

/* Saves hollow cells (cells inside a body without particles), particles p and bonds b of a run to the archive a.
 * optional: optional arrays of p, a sum of WITH_*. Returns FAILED if the archive cannot be written. */
static status body_save(struct cells_without_particles *hollow, struct particles *p, int optional, struct bonds *b,
                        struct archive *a)
{
    TRY(hollow_save(hollow, a));
    TRY(particles_save_or_load(p, optional, a));
    return bonds_save_or_load(b, p, a);
}

/* Restores the particles and bonds of the run from the archive a, and rebuilds from them what is not stored: lists of
 * particles, coupling, mesh and coarse cells. Returns FAILED, with a message, if an entry is missing or a particle has
 * an impossible state; the run then is incomplete and can only be freed. */
static status body_restore(struct run *run, struct archive *a)
{
    TRY(particles_save_or_load(&run->part, run->optional, a));
    TRY(particles_check(run->scene, &run->part));
    particles_rebuild_lists_by_kind(&run->part);
    bonds_free(&run->bonds);
    bonds_make(&run->bonds, NULL, &run->part, &run->source);
    partial_stress_free(&run->coupling->partial);
    run->grid->sort_needed = SORT_ALL;
    TRY(bonds_save_or_load(&run->bonds, &run->part, a));
    state_based_update_weighted_volumes(&run->bonds, &run->part, &run->source);
    coupling_set_up_pd_mpm_method_and_interface(run);
    mesh_levels_free(&run->frame->levels);
    mesh_free(&run->frame->mesh);
    memory_free(run->frame->elastic);
    TRY(coupling_build_total_lagrangian_mesh(run, true));
    return mesh_levels_make_coarse_cells(run, true);
}

status run_components_save_or_load_state(struct run *run, struct archive *a)
{
    TRY(loads_save_or_load(&run->loads, a));
    for (const struct part *const *p = run->parts; *p; p++)
        if ((*p)->state) TRY((*p)->state(run, a));
    return OK;
}

status run_save_or_load_state(void *engine, struct archive *a)
{
    struct run *run = engine;
    TRY(kernels_archive(&run->warnings, a));
    TRY(a->saving ? body_save(&run->frame->hollow, &run->part, run->optional, &run->bonds, a) : body_restore(run, a));
    TRY(clock_archive(&run->clock, a));
    ARCHIVE_VALUE(a, "engine/damped", run->damped);
    TRY(active_set_save_or_load(&run->bonds.active, "bonds", a));
    TRY(run_components_save_or_load_state(run, a));
    const int known = run->warnings.n;
    TRY(warnings_save_or_load(&run->warnings, a));
    warnings_print(&run->warnings, known, stderr);
    return OK;
}
