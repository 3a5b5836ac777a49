/* Applies boundary conditions: sets up the loads, adds their forces, prescribes velocities and positions, and computes
 * impulse and work. */
#include "loads/loads.h"
#include "loads/mirrors.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "base/team.h"

/* ---- set-up ------------------------------------------------------------------------------------------------------ */

/* Lists in l->list, in ascending order, the particles on which loads act, or later may act through bonds across a
 * clamped plane of symmetry. Marks them with LOADED or MOVES_LATER in l->loaded[p->n + LANES]. Allocates both arrays
 * unless there are no such particles. */
static void loads_list(struct loads *l, const struct particles *p)
{
    int64_t most = 0;
    for (int b = 0; b < l->n; b++)
        most += l->load[b].n + (boundary_is_mirror_without_tangential_motion(l->load[b].boundary, p->dim) ? p->n : 0);
    if (most == 0) return;
    l->loaded = NEW("loads.loaded", p->n + LANES, uint8_t);
    for (int b = 0; b < l->n; b++)
        for (int64_t k = 0; k < l->load[b].n; k++) l->loaded[l->load[b].particle[k]] = LOADED;
    loads_flag_clamped_mirror_particles_to_move_late(l, p);
    l->list = NEW("loads.list", most < p->n ? most : p->n, int32_t);
    for (int64_t i = 0; i < p->n; i++)
        if (l->loaded[i]) l->list[l->listed++] = (int32_t)i;
}

uint8_t boundary_prescribed_component_mask(const struct boundary *b, int dim)
{
    if (b->kind == BOUNDARY_VELOCITY) return b->components;
    if (boundary_is_mirror_without_tangential_motion(b, dim)) return (uint8_t)((1 << dim) - 1);
    return b->kind == BOUNDARY_MIRROR ? (uint8_t)(1 << b->axis) : 0;
}

/* Sets load->prescribes, the components that a load prescribes, for all loads of l that prescribe motion of particles.
 * Each component of a particle belongs to the last load in the scene that prescribes it: this load alone moves it, and
 * has its reaction, impulse and work. particles: number of particles; dim: number of components. */
static void loads_divide_components(struct loads *l, int64_t particles, int dim)
{
    uint8_t *taken = NEW("loads.taken", particles, uint8_t);
    for (int b = l->n; b-- > 0;) {
        struct load *load = &l->load[b];
        const uint8_t components = boundary_prescribed_component_mask(load->boundary, dim);
        if (components == 0 || load->n == 0) continue;
        load->prescribes = NEW("loads.prescribes", load->n, uint8_t);
        for (int64_t k = 0; k < load->n; k++) {
            uint8_t *others = &taken[load->particle[k]];
            load->prescribes[k] = (uint8_t)(components & ~*others);
            *others |= components;
        }
    }
    memory_free(taken);
}

status loads_make_from_boundaries(struct loads *l, const struct boundary *boundary, int boundaries, struct particles *p,
                                  real spacing, real mirror_reach, int optional_arrays)
{
    INVARIANT(boundaries <= BOUNDARIES_MAX);
    memset(l, 0, sizeof *l);
    l->n = boundaries;
    l->spacing = spacing;
    l->load = NEW("loads.load", boundaries, struct load);
    for (int b = 0; b < boundaries; b++)
        TRY(status_message_prepend_location(boundary[b].place,
                                            load_find_particles_of_boundary(&l->load[b], &boundary[b], p, spacing)));
    loads_divide_components(l, p->n, p->dim);
    for (int b = 0; b < boundaries; b++)
        TRY(status_message_prepend_location(
            boundary[b].place, load_find_free_faces_under_pressure(&l->load[b], boundary, boundaries, b, p, spacing)));
    for (int b = 0; b < boundaries; b++)
        TRY(status_message_prepend_location(boundary[b].place, load_prepare_particle_load_factors(&l->load[b], p)));
    TRY(absorbing_boundaries_check_for_overlap(l, p));
    loads_merge_equal_particle_lists(l, p->dim);
    TRY(loads_append_mirror_images_of_particles(l, p, mirror_reach, optional_arrays));
    loads_list(l, p);
    return OK;
}

/* Replaces the particles of p on which contact acts (mark TOUCHES in l->loaded) by the indices particle_list[n], in
 * ascending order, copied. Rebuilds l->list, all marked particles in ascending order; particles that have no
 * mark left are removed from it. */
void loads_store_list_of_possible_contact_particles(struct loads *l, const struct particles *p,
                                                    const int32_t *particle_list, int64_t n)
{
    if (!l->loaded && n == 0) return;
    if (!l->loaded) l->loaded = NEW("loads.loaded", p->n + LANES, uint8_t);
    const int32_t *old = l->list;
    const int64_t had = l->listed;
    int32_t *all = BARE("loads.list", had + n, int32_t);
    l->listed = 0;
    for (int64_t k = 0; k < had; k++) l->loaded[old[k]] &= (uint8_t)~TOUCHES;
    for (int64_t k = 0; k < n; k++) l->loaded[particle_list[k]] |= TOUCHES;
    for (int64_t k = 0, m = 0; k < had || m < n;) {
        const int32_t i = m == n || (k < had && old[k] < particle_list[m]) ? old[k] : particle_list[m];
        k += k < had && old[k] == i, m += m < n && particle_list[m] == i;
        if (l->loaded[i]) all[l->listed++] = i;
    }
    memory_free(l->list);
    l->list = all;
}

void loads_free(struct loads *l)
{
    loads_particle_load_factors_free(l);
    absorbing_dashpots_free(l);
    for (int b = 0; b < l->n; b++) {
        load_time_varying_load_factors_free(&l->load[b]);
        memory_free(l->load[b].particle);
        memory_free(l->load[b].prescribes);
    }
    memory_free(l->load);
    memory_free(l->loaded);
    memory_free(l->list);
    memory_free(l->image);
    memory_free(l->share);
    memory_free(l->constrained_mesh.held);
    memory_free(l->mesh_share);
    memory_free(l->mesh_mark);
    memset(l, 0, sizeof *l);
}

/* ---- forces on particles ----------------------------------------------------------------------------------------- */

/* Replaces the force on the peridynamic particles of `load`, which prescribes their velocity, by the force that results
 * in this velocity: m (v_prescribed - v)/dt_velocity. The support exerts the difference from the previous force: adds
 * its impulse to l->impulse and its work to l->constraint_work. Subtracts the previous forces from load->reaction, as a
 * load cell would measure, without the inertia of the particles. p: all particles; by: motion prescribed in this step;
 * dt_velocity: duration of the velocity update [s]. */
static void drive(struct loads *l, struct load *load, struct particles *p, const struct prescribed_motion *by,
                  real dt_velocity)
{
    const struct boundary *b = load->boundary;
    real given[DIM_MAX] = {0}, work = 0;
    for (int64_t k = 0; k < load->n; k++) {
        int32_t i = load->particle[k];
        real X[DIM_MAX];
        if (particle_is_moved_by_grid_or_mesh_nodes(p, i)) continue;
        particle_reference_position(p, i, X);
        for (int d = 0; d < p->dim; d++) {
            if (!(load->prescribes[k] >> d & 1)) continue;
            const real target = prescribed_velocity_component_at_position(by, X, d, false), before = p->v[d][i];
            real needed = p->mass[i] * (target - before) / dt_velocity, reaction = needed - p->f[d][i];
            load->reaction[d] -= p->f[d][i]; /* without the driven particles' inertia: a load cell's reading */
            if (b->frozen && boundary_motion_varies_in_space(b))
                load->held_work -= p->f[d][i] * (p->x[d][i] - p->X[d][i]);
            p->f[d][i] = needed;
            given[d] += reaction * dt_velocity;
            work += reaction * dt_velocity * 0.5 * ((1 + l->damped.velocities) * before + target);
        }
    }
    for (int d = 0; d < p->dim; d++) l->impulse[d] += given[d];
    l->constraint_work += work * (1 + l->damped.increments);
}

/* Arguments of loads_force_block: the particles p and the component (0 .. dim - 1) of the force that is summed. */
struct force_sum {
    const struct particles *p;
    int component;
};

/* Adds the sum of one force component over the particles first .. end - 1 to *sum [N]. context: a struct force_sum,
 * with the particles and the component. reproducible_sums calls it for each block of particles. Adds in LANES partial
 * sums, because additions to a single one would wait for each other. */
static void loads_force_block(const void *context, int64_t first, int64_t end, real *sum)
{
    const struct force_sum *s = context;
    const real *f = s->p->f[s->component];
    real part[LANES] = {0};
    int64_t i = first;
    for (; i + LANES <= end; i += LANES)
        for (int l = 0; l < LANES; l++) part[l] += f[i + l];
    for (; i < end; i++) part[0] += f[i];
    for (int l = 0; l < LANES; l++) *sum += part[l];
}

/* Adds the impulse of the supports at planes of symmetry in a velocity update of duration dt_velocity [s] to l->impulse
 * [N s]. It is the sum of all forces on the particles p normal to each plane, and along planes that also prevent
 * tangential motion. In this sum, forces between two particles cancel, and forces from mirror images remain, which are
 * the reaction of the support. Along other planes the forces from images cancel in pairs. */
static void mirror_impulse(struct loads *l, const struct particles *p, real dt_velocity)
{
    bool held[DIM_MAX] = {false};
    for (int b = 0; b < l->n; b++)
        for (int d = 0; d < p->dim; d++)
            if (l->load[b].boundary->kind == BOUNDARY_MIRROR)
                held[d] = held[d] || d == l->load[b].boundary->axis || l->load[b].boundary->hold_tangential;
    for (int d = 0; d < p->dim; d++) {
        real sum;
        if (!held[d]) continue;
        reproducible_sums(p->n, 1, loads_force_block, &(struct force_sum){p, d}, &sum);
        l->impulse[d] += dt_velocity * sum;
    }
}

/* Updates load->displacement [m], the displacement of a support, by one step: stores a prescribed displacement, or
 * integrates a prescribed velocity over the step. If the values differ between the particles of the load (indices in
 * p), uses their mean. by: motion that the load prescribes in this step. */
static void displacement_update(struct load *load, const struct particles *p, const struct prescribed_motion *by)
{
    const bool displaces = load->boundary->displaces;
    const int64_t n = boundary_motion_varies_in_space(load->boundary) ? load->n : 1;
    for (int d = 0; d < p->dim; d++) {
        real sum = 0;
        if (!(load->boundary->components >> d & 1)) continue;
        for (int64_t k = 0; k < n; k++) {
            real X[DIM_MAX] = {0};
            if (load->n > 0) particle_reference_position(p, load->particle[k], X);
            sum += displaces ? prescribed_displacement_component_at_position(&by->to, X, d)
                             : prescribed_velocity_component_at_position(by, X, d, false);
        }
        if (n > 0) load->displacement[d] = displaces ? sum / (real)n : load->displacement[d] + sum / (real)n * by->dt;
    }
}

void loads_apply_forces_and_motion_constraints(struct loads *l, struct particles *p, real t, real dt, real dt_velocity)
{
    if (l->images > 0) mirror_impulse(l, p, dt_velocity);
    for (int c = 0; c < l->n; c++) {
        struct load *load = &l->load[c];
        memset(load->reaction, 0, sizeof load->reaction);
        load->held_work = 0;
    }
    loads_add_applied_forces(l, p, t, dt_velocity);
    loads_add_dashpot_forces(l, p, dt_velocity);
    for (int c = 0; c < l->n; c++) { /* after all forces, which reactions include */
        struct load *load = &l->load[c];
        if (load->boundary->kind != BOUNDARY_VELOCITY && load->boundary->kind != BOUNDARY_MIRROR) continue;
        const struct prescribed_motion by = loads_prescribed_motion_of_boundary_in_step(l, c, p->dim, t, dt);
        displacement_update(load, p, &by);
        drive(l, load, p, &by, dt_velocity);
    }
}

/* ---- after the gather -------------------------------------------------------------------------------------------- */

/* Sets the velocities of those particles of a load that are material points on a grid to the prescribed values. Points
 * of a mesh are skipped. Adds the change of momentum to l->impulse and its work to l->constraint_work. p: all
 * particles; by: motion that the load prescribes in this step. */
static void velocities_set(struct loads *l, const struct load *load, struct particles *p,
                           const struct prescribed_motion *by)
{
    for (int64_t k = 0; k < load->n; k++) {
        int32_t i = load->particle[k];
        real X[DIM_MAX];
        if (!particle_is_moved_by_grid_or_mesh_nodes(p, i) || p->flag[i] & FLAG_MESHED)
            continue; /* the mesh constrains nodes */
        particle_reference_position(p, i, X);
        for (int d = 0; d < p->dim; d++) {
            if (!(load->prescribes[k] >> d & 1)) continue;
            const real target = prescribed_velocity_component_at_position(by, X, d, false),
                       given = p->mass[i] * (target - p->v[d][i]);
            l->impulse[d] += given;
            l->constraint_work +=
                given * 0.5 * (target + (1 + l->damped.velocities) * p->v[d][i]) * (1 + l->damped.increments);
            p->v[d][i] = target;
        }
    }
}

/* Largest deviation of a particle from its prescribed position that counts as round-off and is corrected [spacings].
 * Larger deviations remain: such particles were material points between grid nodes of which only some had a prescribed
 * velocity. */
#define OFF_PLACE 1e-6

/* Sets the positions of the particles of a load with prescribed displacement to those at the end of the step, so that
 * round-off does not accumulate. Skips points of a mesh, and particles moved by bond forces that are more than
 * OFF_PLACE spacings away from these positions. p: all particles; by: motion prescribed in this step; spacing: lattice
 * spacing [m]. Returns true if a material point of a grid was moved. */
static bool positions_set(const struct load *load, struct particles *p, const struct prescribed_motion *by,
                          real spacing)
{
    bool moved = false;
    for (int64_t k = 0; k < load->n; k++) {
        const int32_t i = load->particle[k];
        const bool on_grid = particle_is_moved_by_grid_or_mesh_nodes(p, i);
        real X[DIM_MAX];
        if (on_grid && p->flag[i] & FLAG_MESHED) continue;
        particle_reference_position(p, i, X);
        for (int d = 0; d < p->dim; d++) {
            if (!(load->prescribes[k] >> d & 1)) continue;
            const real at = X[d] + prescribed_displacement_component_at_position(&by->to, X, d), off = p->x[d][i] - at;
            if (!on_grid && !(fabs(off) <= OFF_PLACE * spacing)) continue;
            moved = moved || (on_grid && off != 0);
            p->x[d][i] = at;
        }
    }
    return moved;
}

void loads_add_reactions_at_grid_nodes(struct loads *l, const struct grid *g, real dt_velocity)
{
    const real inverse = 1 / dt_velocity;
    loads_add_absorbed_energy_and_impulse(l, &g->absorbed);
    for (int64_t q = 0; q < g->walls;) { /* walls of one load and component are consecutive */
        const struct wall first = g->wall[q];
        real sum = 0;
        for (; q < g->walls && g->wall[q].load == first.load && g->wall[q].component == first.component; q++)
            sum += g->wall[q].reaction;
        l->load[first.load].reaction[first.component] += sum * inverse;
    }
    for (int64_t q = 0; q < g->mirror_nodes; q++)
        for (int d = 0; d < g->dim; d++)
            l->load[g->mirror_node[q].load].reaction[d] += g->mirror_node[q].reaction[d] / dt_velocity;
}

bool loads_impose_prescribed_motion_on_particles(struct loads *l, struct particles *p, real t, real dt)
{
    bool moved = false;
    for (int c = 0; c < l->n; c++) {
        struct load *load = &l->load[c];
        const struct prescribed_motion by = boundary_prescribed_motion_in_step(load->boundary, p->dim, t, dt);
        if (load->boundary->kind != BOUNDARY_VELOCITY) continue;
        velocities_set(l, load, p, &by);
        if (load->boundary->displaces) moved = positions_set(load, p, &by, l->spacing) || moved;
    }
    loads_add_work_of_applied_forces(l, p, t, dt);
    return moved;
}

status loads_save_or_load(struct loads *l, struct archive *a)
{
    ARCHIVE_VALUE(a, "loads/impulse", l->impulse);
    ARCHIVE_VALUE(a, "loads/work", l->work);
    ARCHIVE_VALUE(a, "loads/held_work", l->constraint_work);
    ARCHIVE_VALUE(a, "loads/absorbed", l->absorbing.energy);
    for (int b = 0; b < l->n; b++) {
        char name[48];
        snprintf(name, sizeof name, "loads/displacement%d", b);
        ARCHIVE_VALUE(a, name, l->load[b].displacement);
        if (a->scope == ARCHIVE_ACCOUNTS) continue;
        snprintf(name, sizeof name, "loads/reaction%d", b);
        ARCHIVE_VALUE(a, name, l->load[b].reaction); /* reaction of the last step, for samples before the next step */
    }
    return OK;
}
