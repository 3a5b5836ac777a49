/* Computes contact of particles with rigid bodies. A particle whose centre is closer than half a spacing to the surface
 * is pushed along its normal by the force 2 k times the overlap, with the energy k overlap^2. k is the stiffness of a
 * contact between two particles of its material, in which two cells of material are compressed; here it is one cell,
 * hence the factor 2. */
#include <math.h>
#include <stdio.h>

#include "base/memory.h"
#include "base/team.h"
#include "contact_internal.h"

void contact_rigid_free_particle_lists(struct contact *c)
{
    for (int b = 0; b < c->rigids && c->near; b++) {
        memory_free(c->near[b].row);
        memory_free(c->near[b].zero);
        memory_free(c->near[b].spring);
        memory_free(c->near[b].balance);
        memory_free(c->near[b].touch);
    }
    memory_free(c->near);
    c->near = NULL;
}

/* ---- the search -------------------------------------------------------------------------------------------------- */

/* Returns the gap between rigid body r and the surface of the deformable body at the particle of row `row` of the
 * contact list c (particles that may come into contact) [m]; negative if both overlap. p: particles; normal[DIM_MAX]:
 * receives the outward unit normal of r. */
static real gap_of(const struct contact *c, const struct particles *p, const struct rigid_body *r, int64_t row,
                   real *normal)
{
    const int32_t i = c->particle[row];
    real x[DIM_MAX] = {0};
    for (int d = 0; d < p->dim; d++) x[d] = p->x[d][i];
    return rigid_signed_distance(r, x, normal) - (0.5 + c->rise[row]) * c->size[row];
}

/* Returns true if the particle of p in row `row` of the contact list c may come into contact with rigid body r before
 * the next search, i.e. if the gap between both is less than `skin` [m]. Distant particles are rejected early by a
 * bounding test. */
static bool is_near(const struct contact *c, const struct particles *p, const struct rigid_body *r, int64_t row,
                    real skin)
{
    real x[DIM_MAX] = {0}, normal[DIM_MAX];
    for (int d = 0; d < p->dim; d++) x[d] = p->x[d][c->particle[row]];
    return rigid_may_be_within_distance_of_position(r, x, c->size[row] + skin) && gap_of(c, p, r, row, normal) < skin;
}

/* Returns the index of particle `particle` in the list of particles near rigid body number `body`, as it was before the
 * present search; -1 if the particle was not in that list. before: contact before the search. */
static int64_t near_before(const struct contact *before, int body, int32_t particle)
{
    const int64_t row = before->made ? contact_list_index_of_particle(before, particle) : -1;
    int64_t low = 0, high = row >= 0 ? before->near[body].n : 0;
    while (low < high) {
        const int64_t middle = (low + high) / 2;
        if (before->near[body].row[middle] < row)
            low = middle + 1;
        else
            high = middle;
    }
    return row >= 0 && low < before->near[body].n && before->near[body].row[low] == row ? low : -1;
}

/* Lists in c->near[body] the particles of the contact list c that may come into contact with rigid body number `body`
 * before the next search: those with a gap below `skin` [m]. Friction springs and the gaps at which contact begins are
 * copied from `before`, the contact before this search. For a new particle that already overlaps the body, contact
 * begins at its present gap, without a force, and at larger gaps as the gap opens; in equilibria (c->marked) it begins
 * at gap 0. p: particles at their present positions. */
static void near_find_body(struct contact *c, const struct contact *before, const struct particles *p, int body,
                           real skin)
{
    const struct rigid_body *r = &c->rigid[body];
    struct contact_near *near = &c->near[body];
    uint8_t *found = BARE("contact.found", c->rows, uint8_t);
    real normal[DIM_MAX];
#pragma omp parallel for schedule(static)
    for (int64_t row = 0; row < c->rows; row++) found[row] = is_near(c, p, r, row, skin);
    near->n = 0;
    for (int64_t row = 0; row < c->rows; row++) near->n += found[row];
    near->row = BARE("contact.near", near->n, int32_t);
    near->zero = BARE("contact.zero", near->n, real);
    near->balance = BARE("contact.balance", near->n, struct contact_leapfrog_error_account);
    near->spring = c->law.friction > 0 ? NEW("contact.springs", near->n, struct contact_spring) : NULL;
    near->n = 0;
    for (int64_t row = 0; row < c->rows; row++) {
        if (!found[row]) continue;
        const int64_t was = near_before(before, body, c->particle[row]);
        const real gap = gap_of(c, p, r, row, normal), zero = was >= 0 ? before->near[body].zero[was] : -INFINITY;
        if (near->spring)
            contact_friction_spring_copy_previous(&near->spring[near->n], was >= 0 ? before->near[body].spring : NULL,
                                                  was);
        near->row[near->n] = (int32_t)row;
        /* an iterate of an equilibrium has moved into the body: contact acts from gap 0 */
        const bool deep = c->marked && before->made && was < 0;
        near->zero[near->n] = deep ? 0 : real_min(0, real_max(zero, gap));
        near->balance[near->n] = contact_leapfrog_error_carry_over_to_new_list(
            was >= 0 ? &before->near[body].balance[was] : NULL, gap - near->zero[near->n]);
        near->n++;
    }
    memory_free(found);
}

void contact_rigid_list_nearby_particles(struct contact *c, const struct contact *previous, const struct particles *p,
                                         real max_distance)
{
    c->near = c->rigids > 0 ? NEW("contact.bodies", c->rigids, struct contact_near) : NULL;
    for (int b = 0; b < c->rigids; b++) {
        near_find_body(c, previous, p, b, max_distance);
        for (int d = 0; d < DIM_MAX; d++) c->near[b].x[d] = c->rigid[b].x[d];
        for (int k = 0; k < DIM_MAX * DIM_MAX; k++) c->near[b].turn[k] = c->rigid[b].turn[k / DIM_MAX][k % DIM_MAX];
    }
}

bool rigid_bodies_moved_since_last_contact_search(const struct contact *c, real min_distance)
{
    for (int b = 0; b < c->rigids && c->near; b++) {
        const struct rigid_body *r = &c->rigid[b];
        real moved2 = 0, turned2 = 0;
        for (int d = 0; d < DIM_MAX; d++) moved2 += square(r->x[d] - c->near[b].x[d]);
        for (int k = 0; k < DIM_MAX * DIM_MAX; k++)
            turned2 += square(r->turn[k / DIM_MAX][k % DIM_MAX] - c->near[b].turn[k]);
        if (!(sqrt(moved2) + sqrt(turned2) * r->radius < min_distance)) return true;
    }
    return false;
}

/* ---- forces and energy ------------------------------------------------------------------------------------------- */

/* Returns the gap between rigid body number body_number and particle q of the list of particles near it (c->near),
 * minus the gap at which contact begins [m]; negative if both overlap. p: particles; normal[DIM_MAX]: receives the
 * outward unit normal of the body. */
real contact_rigid_gap_of_particle(const struct contact *c, const struct particles *p, int body_number, int64_t q,
                                   real *normal)
{
    const struct contact_near *near = &c->near[body_number];
    return gap_of(c, p, &c->rigid[body_number], near->row[q], normal) - near->zero[q];
}

/* Returns the overlap of rigid body number `body` with particle q of c->near[body], the list of particles near it [m];
 * 0 if both are not in contact. While an equilibrium is computed, marks determine which contacts act, and the overlap
 * of such a contact can be negative. p: particles; normal[DIM_MAX]: receives the outward unit normal of the body,
 * unless a mark excludes the contact. */
static real overlap_of(const struct contact *c, const struct particles *p, int body, int64_t q, real *normal)
{
    const uint8_t *marks = contact_rigid_body_active_set_flags(c, body);
    if (marks && !marks[q]) return 0;
    const real overlap = -contact_rigid_gap_of_particle(c, p, body, q, normal);
    return marks ? overlap : real_max(0, overlap);
}

real contact_patch_bounding_box_diagonal(const struct contact *c, const struct particles *p, int rigid_body)
{
    real low[DIM_MAX], high[DIM_MAX], normal[DIM_MAX], width2 = 0;
    for (int d = 0; d < DIM_MAX; d++) low[d] = INFINITY, high[d] = -INFINITY;
    for (int64_t q = 0; c->near && q < c->near[rigid_body].n; q++) {
        const int32_t i = c->particle[c->near[rigid_body].row[q]];
        if (!(overlap_of(c, p, rigid_body, q, normal) > 0)) continue;
        for (int d = 0; d < p->dim; d++) low[d] = real_min(low[d], p->x[d][i]), high[d] = real_max(high[d], p->x[d][i]);
    }
    for (int d = 0; d < p->dim && high[d] >= low[d]; d++) width2 += square(high[d] - low[d]);
    return sqrt(width2);
}

/* Updates the correction of energy in the contact of rigid body number `body` with particle q of c->near[body], the
 * list of particles near it: the energy error that time integration has made so far, and the small force that
 * compensates it. Must be called once per time step. p: particles at their present positions. */
static void balance_step(struct contact *c, const struct particles *p, int body, int64_t q)
{
    const struct contact_near *near = &c->near[body];
    real normal[DIM_MAX];
    const real k = 4 * contact_pair_stiffness(c, p, near->row[q], near->row[q]);
    contact_leapfrog_error_correction_force(&near->balance[q], k, contact_rigid_gap_of_particle(c, p, body, q, normal),
                                            true);
}

/* Computes the force of rigid body number `body` on particle q of c->near[body], the list of particles near it: normal
 * force, energy correction and friction. Stores it in force[DIM_MAX] [N]. Returns the overlap [m], 0 if both are not in
 * contact. p: particles. */
static real push_of(const struct contact *c, const struct particles *p, int body, int64_t q, real *force)
{
    const struct contact_near *near = &c->near[body];
    real normal[DIM_MAX] = {0};
    const real overlap = overlap_of(c, p, body, q, normal);
    const real k = 2 * contact_pair_stiffness(c, p, near->row[q], near->row[q]);
    for (int d = 0; d < DIM_MAX; d++)
        force[d] = (k * overlap - near->balance[q].drag) * normal[d] + (near->spring ? near->spring[q].drag[d] : 0);
    return overlap;
}

/* Advances the friction spring between rigid body number `body` and particle q of the list of particles near it
 * (c->near) by a time step dt [s]. p: particles at their present positions and velocities. Does nothing if both are not
 * in contact and the spring is not elongated. */
static void spring_step(struct contact *c, const struct particles *p, int body, int64_t q, real dt)
{
    const struct contact_near *near = &c->near[body];
    const int32_t i = c->particle[near->row[q]];
    real normal[DIM_MAX] = {0}, x[DIM_MAX] = {0}, v[DIM_MAX], slid[DIM_MAX];
    const real overlap = overlap_of(c, p, body, q, normal);
    const real k = 2 * contact_pair_stiffness(c, p, near->row[q], near->row[q]);
    if (overlap == 0 && near->spring[q].stored == 0) return;
    for (int d = 0; d < p->dim; d++) x[d] = p->x[d][i];
    rigid_compute_velocity_at_point(&c->rigid[body], x, v);
    for (int d = 0; d < p->dim; d++) slid[d] = (p->v[d][i] - v[d]) * dt;
    contact_friction_spring_advance(&near->spring[q], p->dim, normal, slid, k, c->law.friction * k * overlap);
}

/* Argument of the sum of contact forces on rigid body number `body`. */
struct rigid_sum {
    const struct contact *c;
    const struct particles *p;
    int body;
};

/* Adds the force that particles exert on a rigid body [N] to sum[0 .. 2], and the moment of this force about the body's
 * position [N m] to sum[3 .. 5]. The particles are numbers first .. end - 1 of the list of particles near the body.
 * context: the body and contact (struct rigid_sum). reproducible_sums calls it for each block of particles. */
static void rigid_block(const void *context, int64_t first, int64_t end, real *sum)
{
    const struct rigid_sum *s = context;
    for (int64_t q = first; q < end; q++) {
        real f[DIM_MAX], arm[DIM_MAX] = {0};
        if (push_of(s->c, s->p, s->body, q, f) == 0) continue;
        const int32_t i = s->c->particle[s->c->near[s->body].row[q]];
        for (int d = 0; d < s->p->dim; d++) arm[d] = s->p->x[d][i] - s->c->rigid[s->body].x[d], sum[d] -= f[d];
        for (int d = 0; d < DIM_MAX; d++) {
            const int a = (d + 1) % DIM_MAX, b = (d + 2) % DIM_MAX;
            sum[DIM_MAX + d] -= arm[a] * f[b] - arm[b] * f[a];
        }
    }
}

enum { RIGID_TERMS = 2 * DIM_MAX }; /* number of components of force and moment */

/* Adds the contact forces of rigid body number `body` of c to p->f, and stores the opposite force and moment in the
 * body. Bodies are treated one after the other, since a particle may touch several. dt: time step [s]; with 0, friction
 * springs and energy corrections are not advanced. all: receives the largest overlap, its particle and the number of
 * contacts. */
static void body_force(struct contact *c, struct particles *p, int body, real dt, struct contact_summary *all)
{
    const struct contact_near *near = &c->near[body];
    const struct rigid_sum s = {c, p, body};
    real sum[RIGID_TERMS] = {0};
    for (int64_t q = 0; q < near->n; q++) {
        real f[DIM_MAX];
        const int32_t i = c->particle[near->row[q]];
        if (dt > 0) balance_step(c, p, body, q);
        if (near->spring) spring_step(c, p, body, q, dt);
        const real overlap = push_of(c, p, body, q, f);
        if (overlap == 0) continue;
        for (int d = 0; d < p->dim; d++) p->f[d][i] += f[d];
        contact_summary_add_overlap(all, overlap, i);
        all->touching++; /* a pair with only one of its two rows */
    }
    reproducible_sums(near->n, RIGID_TERMS, rigid_block, &s, sum);
    for (int d = 0; d < DIM_MAX; d++) c->rigid[body].force[d] = sum[d], c->rigid[body].moment[d] = sum[DIM_MAX + d];
}

void contact_rigid_compute_forces(struct contact *c, struct particles *p, real dt, struct contact_summary *found)
{
    for (int b = 0; b < c->rigids && c->near; b++) body_force(c, p, b, dt, found);
}

real contact_rigid_body_force_norm(const struct contact *c, const struct particles *p)
{
    real sum = 0, f[DIM_MAX];
    for (int b = 0; b < c->rigids && c->near; b++)
        for (int64_t q = 0; q < c->near[b].n; q++)
            if (push_of(c, p, b, q, f) != 0) sum += dot(f, f, p->dim);
    return sqrt(sum);
}

/* Returns the contact energy of a rigid body with particle q of the list of particles near it [J]: k overlap^2, with
 * the stiffness k of a contact between two particles like this one. It is a term of reproducible_sum. context: the body
 * and contact (struct rigid_sum). */
static real near_energy(const void *context, int64_t q)
{
    const struct rigid_sum *s = context;
    const int64_t row = s->c->near[s->body].row[q];
    real normal[DIM_MAX];
    return contact_pair_stiffness(s->c, s->p, row, row) * square(overlap_of(s->c, s->p, s->body, q, normal));
}

real contact_rigid_elastic_energy(const struct contact *c, const struct particles *p)
{
    real energy = 0;
    for (int b = 0; b < c->rigids && c->near; b++)
        energy += reproducible_sum(c->near[b].n, near_energy, &(struct rigid_sum){c, p, b});
    return energy;
}

status contact_rigid_save_or_load_particle_lists(struct contact *c, struct archive *a)
{
    if (c->rigids > 0 && !a->saving) {
        contact_rigid_free_particle_lists(c);
        c->near = NEW("contact.bodies", c->rigids, struct contact_near);
    }
    for (int b = 0; b < c->rigids; b++) {
        struct contact_near *near = &c->near[b];
        char name[64];
        snprintf(name, sizeof name, "contact/near_%d", b);
        TRY(a->exchange(a, name, &near->n, sizeof near->n));
        snprintf(name, sizeof name, "contact/near_place_%d", b);
        TRY(a->exchange(a, name, near->x, sizeof near->x + sizeof near->turn));
        if (near->n < 0 || near->n > c->rows)
            return status_set(FAILED,
                              "cannot resume: the checkpoint lists %lld particles near a rigid body, but this run can "
                              "have %lld at most; it is damaged, start again with --overwrite",
                              (long long)near->n, (long long)c->rows);
        snprintf(name, sizeof name, "contact/near_row_%d", b);
        TRY(contact_array_save_or_load(a, name, (void **)&near->row, near->n, sizeof *near->row));
        snprintf(name, sizeof name, "contact/near_zero_%d", b);
        TRY(contact_array_save_or_load(a, name, (void **)&near->zero, near->n, sizeof *near->zero));
        snprintf(name, sizeof name, "contact/near_spring_%d", b);
        if (c->law.friction > 0)
            TRY(contact_array_save_or_load(a, name, (void **)&near->spring, near->n, sizeof *near->spring));
        snprintf(name, sizeof name, "contact/near_balance_%d", b);
        TRY(contact_array_save_or_load(a, name, (void **)&near->balance, near->n, sizeof *near->balance));
        for (int64_t q = 0; q < near->n; q++)
            if (near->row[q] < 0 || near->row[q] >= c->rows)
                return status_set(FAILED, "cannot resume: the checkpoint lists, near a rigid body, particles that do "
                                          "not exist in this run; it is damaged, start again with --overwrite");
    }
    return OK;
}
