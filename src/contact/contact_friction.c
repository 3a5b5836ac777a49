/* Computes Coulomb friction. A spring along the face resists the slip of a particle in contact, and slides where its
 * force would exceed the coefficient of friction times the normal force. Its energy counts as contact energy; the
 * energy lost by sliding or separation is the work of friction. */
#include <math.h>

#include "base/memory.h"
#include "base/team.h"
#include "data/derived_fields.h"
#include "contact_internal.h"

/* Rotates a friction spring into the plane perpendicular to a unit vector, without changing its length, because the
 * face may have turned since the last step. spring[dim]: elongation of the spring [m], overwritten; normal[dim]: unit
 * vector. A spring along the normal stays unchanged. */
static void lay_down(real *spring, const real *normal, int dim)
{
    const real out = dot(spring, normal, dim), before = dot(spring, spring, dim), after = before - square(out);
    if (!(after > 0)) return;
    for (int d = 0; d < dim; d++) spring[d] = (spring[d] - out * normal[d]) * sqrt(before / after);
}

void contact_friction_spring_advance(struct contact_spring *s, int dim, const real *normal, const real *slip, real k,
                                     real slip_force)
{
    real along[DIM_MAX], before[DIM_MAX], length2 = 0, stored = 0, work = 0;
    lay_down(s->length, normal, dim);
    for (int d = 0; d < dim; d++) {
        along[d] = slip[d] - dot(slip, normal, dim) * normal[d];
        before[d] = s->length[d];
        s->length[d] += along[d];
        length2 += square(s->length[d]);
    }
    const real share = k * sqrt(length2) > slip_force ? slip_force / (k * sqrt(length2)) : 1;
    for (int d = 0; d < dim; d++) {
        s->length[d] *= share;
        s->drag[d] = -k * s->length[d];
        /* over the mean elongation, as leap-frog computes work */
        work += 0.5 * k * (before[d] + s->length[d]) * along[d];
        stored += 0.5 * k * square(s->length[d]);
    }
    s->lost += work + s->stored - stored;
    s->stored = stored;
}

/* ---- faces ------------------------------------------------------------------------------------------------------- */

/* The slip of particle i is measured relative to the rigid motion of the particles of the face, extrapolated to x_i.
 * With their weights w_j, which sum to 1,
 *
 *     slip = v_i - v - omega x a,   v = sum_j w_j v_j,   a = x_i - sum_j w_j x_j,
 *     I omega = sum_j w_j r_j x v_j,   I = sum_j w_j (r_j^2 1 - r_j r_j),   r_j = x_j - sum_k w_k x_k
 *
 * and the forces conjugate to this slip are the drag f on i and -w_j (f + (I^-1 (a x f)) x r_j) on j: their sum and the
 * sum of their moments are 0. Rotation about an axis along which all particles lie is omitted (a single particle, in
 * space a row of particles): the moment of the drag about this axis then remains. */
/* Largest sum of squares of the forces of the couple, divided by the square of the friction force [1]; empirical. */
#define COUPLE_MOST 10
#define INERTIA_LEAST 1e-6 /* relative to the largest principal value of I and to a^2; smaller values are round-off */

/* The particles of the face near the particle of a row, as one rigid body, for one evaluation of friction. Symbols: a
 * is the position of the row's particle relative to the mean position of the face, v the mean velocity, I the inertia
 * tensor of the face divided by the sum of weights. */
struct contact_partner {
    real force[DIM_MAX];                  /* normal force on the particle of the row [N] */
    real density;                         /* sum of the weights before normalisation */
    real arm[DIM_MAX], velocity[DIM_MAX]; /* a [m]; v [m/s] */
    real inverse[DIM_MAX][DIM_MAX];       /* pseudo-inverse of I [1/m^2] */
    real slip[DIM_MAX];                   /* slip [m/s] */
};

/* Computes the motion of the face near the particle of p in row `row` of the contact list c, without its rotation: the
 * normal force on the particle, the density of the face (sum of weights), the position of the particle relative to the
 * weighted mean position of the face, and the mean velocity of the face. Positions are those a time `lag` before the
 * present [s], x - lag v. Other members of the result are 0. */
static struct contact_partner partner_mean(const struct contact *c, const struct particles *p, int64_t row, real lag)
{
    struct contact_partner sum = {.density = 0};
    for (int64_t q = c->first[row]; q < c->first[row + 1]; q++) {
        const struct contact_density_contribution w =
            contact_face_kernel_density_contribution_of_pair(c, p, row, c->other[q], lag);
        const int32_t j = c->particle[c->other[q]];
        if (w.weight == 0) continue;
        sum.density += w.weight;
        for (int d = 0; d < p->dim; d++) {
            sum.force[d] -= w.pull * w.apart[d];
            sum.arm[d] += w.weight * w.apart[d];
            sum.velocity[d] += w.weight * p->v[d][j];
        }
    }
    for (int d = 0; d < p->dim && sum.density > 0; d++) sum.arm[d] /= sum.density, sum.velocity[d] /= sum.density;
    return sum;
}

/* Adds share (r^2 1 - r r^T), the inertia of a mass `share` at the position r[3] [m], to the symmetric tensor[6] with
 * components in the order xx, yy, zz, xy, yz, zx. */
static void inertia_add(real *tensor, const real *r, real share)
{
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3;
        tensor[a] += share * (square(r[b]) + square(r[(a + 2) % 3]));
        tensor[3 + a] -= share * r[a] * r[b];
    }
}

/* Returns e . T e for the symmetric tensor T[6] (xx, yy, zz, xy, yz, zx) and the vector e[3]. */
static real quadratic_form(const real *tensor, const real *e)
{
    real sum = 0;
    for (int a = 0; a < 3; a++) sum += tensor[a] * square(e[a]) + 2 * tensor[3 + a] * e[a] * e[(a + 1) % 3];
    return sum;
}

/* Computes to->inverse, the pseudo-inverse of the inertia tensor I of the face near a particle [1/m^2]. Principal axes
 * are left out if their inertia is at most INERTIA_LEAST times the largest one, or if a moment about them would cause
 * forces on the particles of the face beyond a limit (COUPLE_MOST). to->arm must be set. inertia[6]: I, in the order
 * xx, yy, zz, xy, yz, zx [m^2]; squares[6]: the same sum with squared weights, from which these forces are
 * estimated. */
static void partner_invert(struct contact_partner *to, const real *inertia, const real *squares)
{
    real value[3], axis[9];
    tensor_compute_principal_values(inertia, value, axis);
    const real widest = real_max(value[0], dot(to->arm, to->arm, DIM_MAX));
    for (int k = 0; k < 3; k++) {
        const real *e = axis + 3 * k, forces = dot(to->arm, to->arm, 3) * quadratic_form(squares, e);
        if (!(value[k] > INERTIA_LEAST * widest && COUPLE_MOST * square(value[k]) > forces)) continue;
        for (int a = 0; a < DIM_MAX; a++)
            for (int b = 0; b < DIM_MAX; b++) to->inverse[a][b] += e[a] * e[b] / value[k];
    }
}

/* Computes the rotation of the face near the particle of p in row `row` of the contact list c about the mean position
 * of the face. Stores the pseudo-inverse of the inertia tensor of the face in to->inverse and its angular velocity in
 * omega[3] [1/s]. Positions are those a time `lag` before now [s], x - lag v. The members density, arm and velocity of
 * *to must be set (partner_mean). */
static void partner_turn(struct contact_partner *to, const struct contact *c, const struct particles *p, int64_t row,
                         real lag, real *omega)
{
    real inertia[6] = {0}, squares[6] = {0}, momentum[DIM_MAX] = {0};
    for (int64_t q = c->first[row]; q < c->first[row + 1]; q++) {
        const struct contact_density_contribution w =
            contact_face_kernel_density_contribution_of_pair(c, p, row, c->other[q], lag);
        const int32_t j = c->particle[c->other[q]];
        const real share = w.weight / to->density;
        real r[DIM_MAX] = {0}, v[DIM_MAX] = {0}, turning[DIM_MAX];
        if (w.weight == 0) continue;
        for (int d = 0; d < p->dim; d++) r[d] = to->arm[d] - w.apart[d], v[d] = p->v[d][j] - to->velocity[d];
        vector_product(r, v, turning);
        for (int d = 0; d < DIM_MAX; d++) momentum[d] += share * turning[d];
        inertia_add(inertia, r, share);
        inertia_add(squares, r, square(share));
    }
    partner_invert(to, inertia, squares);
    for (int d = 0; d < DIM_MAX; d++) omega[d] = dot(to->inverse[d], momentum, DIM_MAX);
}

/* Returns the motion of the face near the particle of p in row `row` of the contact list c, seen as a rigid body, and
 * the slip: the velocity of the particle relative to this motion at the position of the particle [m/s]. Positions are
 * those a time `lag` before now [s], x - lag v. In 1D, and for a particle without a face nearby, the motion has no
 * rotation. */
static struct contact_partner partner_at(const struct contact *c, const struct particles *p, int64_t row, real lag)
{
    struct contact_partner partner = partner_mean(c, p, row, lag);
    real omega[DIM_MAX] = {0}, turning[DIM_MAX];
    if (p->dim > 1 && partner.density > 0) partner_turn(&partner, c, p, row, lag, omega);
    vector_product(omega, partner.arm, turning);
    for (int d = 0; d < p->dim; d++) partner.slip[d] = p->v[d][c->particle[row]] - partner.velocity[d] - turning[d];
    return partner;
}

/* Advances the friction spring of row `list_index` of the contact list c (particles that may come into contact) by a
 * step dt [s], and stores its reaction on the face in c->reaction[row]. p: particles at their present positions. The
 * slip velocity in the step is the mean of those at its start and end, because leap-frog applies the forces of both
 * times to the slip. Does nothing if the particle is not in contact and the spring is not elongated. */
void contact_face_advance_friction_spring(struct contact *c, const struct particles *p, int64_t list_index, real dt)
{
    struct contact_spring *s = &c->spring[list_index];
    struct contact_reaction *reaction = &c->reaction[list_index];
    const real k = 0.5 * c->face[list_index].stiffness / square(c->size[list_index]);
    if (c->face[list_index].push == 0 && s->stored == 0) return;
    const struct contact_partner now = partner_at(c, p, list_index, 0), before = partner_at(c, p, list_index, dt);
    const real force = sqrt(dot(now.force, now.force, p->dim));
    const real *first = before.density > 0 ? before.slip : now.slip;
    real normal[DIM_MAX], slid[DIM_MAX], moment[DIM_MAX];
    for (int d = 0; d < p->dim; d++) {
        normal[d] = force > 0 ? now.force[d] / force : 0;
        slid[d] = 0.5 * (first[d] + now.slip[d]) * dt;
    }
    s->density = now.density;
    contact_friction_spring_advance(s, p->dim, normal, slid, k, c->law.friction * force);
    vector_product(now.arm, s->drag, moment);
    for (int d = 0; d < DIM_MAX; d++) {
        reaction->arm[d] = now.arm[d];
        reaction->turn[d] = dot(now.inverse[d], moment, DIM_MAX);
    }
}

/* Adds to f[dim] [N] the reaction to the friction force on the particle of row l of the contact list c. The reaction
 * acts on the particle of row `row`, which is part of the face that the particle of row l touches. p: particles. */
static void reaction_add(const struct contact *c, const struct particles *p, int64_t l, int64_t row, real *f)
{
    const struct contact_reaction *reaction = &c->reaction[l];
    const struct contact_density_contribution w = contact_face_kernel_density_contribution_of_pair(c, p, l, row, 0);
    const real share = w.weight / c->spring[l].density;
    real r[DIM_MAX] = {0}, turning[DIM_MAX];
    for (int d = 0; d < p->dim; d++) r[d] = reaction->arm[d] - w.apart[d];
    vector_product(reaction->turn, r, turning);
    for (int d = 0; d < p->dim; d++) f[d] -= share * (c->spring[l].drag[d] + turning[d]);
}

/* Adds the friction forces on the particle of row `list_index` of the contact list c to p->f: the force of the row's
 * own spring, and the reactions to the springs of other rows. Mirror images receive no reactions: input files with
 * planes of symmetry have no friction. */
void contact_face_add_friction_on_particle(const struct contact *c, struct particles *p, int64_t list_index)
{
    const int32_t i = c->particle[list_index];
    real f[DIM_MAX];
    for (int d = 0; d < p->dim; d++) f[d] = c->spring[list_index].drag[d];
    for (int64_t q = c->first[list_index]; q < c->first[list_index + 1]; q++)
        if (c->face[c->other[q]].push != 0) reaction_add(c, p, c->other[q], list_index, f);
    for (int d = 0; d < p->dim; d++) p->f[d][i] += f[d];
}

/* ---- energies ---------------------------------------------------------------------------------------------------- */

/* Returns the elastic energy of friction spring k, from 0 [J], as a term of reproducible_sum. context: array of springs
 * (struct contact_spring). */
static real stored_in(const void *context, int64_t k) { return ((const struct contact_spring *)context)[k].stored; }
/* Returns the energy that friction spring k, from 0, has dissipated by sliding [J], as a term of reproducible_sum.
 * context: array of springs (struct contact_spring). */
static real lost_by(const void *context, int64_t k) { return ((const struct contact_spring *)context)[k].lost; }

/* Returns the sum of an energy over the friction springs of all rows and of all contacts with rigid bodies of c [J].
 * term: function that returns the energy of a spring (stored_in or lost_by). */
static real springs_sum(const struct contact *c, real (*term)(const void *context, int64_t k))
{
    real sum = c->spring ? reproducible_sum(c->rows, term, c->spring) : 0;
    for (int b = 0; b < c->rigids && c->near; b++)
        if (c->near[b].spring) sum += reproducible_sum(c->near[b].n, term, c->near[b].spring);
    return sum;
}

real contact_friction_stored_energy(const struct contact *c) { return springs_sum(c, stored_in); }
real contact_friction_dissipated_energy(const struct contact *c) { return c->friction_work + springs_sum(c, lost_by); }

void contact_friction_reactions_allocate(struct contact *c)
{
    memory_free(c->reaction);
    c->reaction = NEW("contact.reaction", c->rows, struct contact_reaction);
}

/* Allocates the friction springs of a new contact list c, and copies the springs of particles that were in the list
 * `previous` of the search before. The elastic energy of springs that are not copied is lost. Does nothing without
 * friction. */
void contact_friction_springs_copy_from_previous(struct contact *c, const struct contact *previous)
{
    if (!(c->law.friction > 0)) return;
    c->spring = NEW("contact.spring", c->rows, struct contact_spring);
    contact_friction_reactions_allocate(c);
    for (int64_t row = 0; row < c->rows; row++)
        contact_friction_spring_copy_previous(
            &c->spring[row], previous->spring,
            previous->made ? contact_list_index_of_particle(previous, c->particle[row]) : -1);
}

void contact_friction_spring_copy_previous(struct contact_spring *spring, const struct contact_spring *previous,
                                           int64_t previous_list_index)
{
    if (!previous || previous_list_index < 0) return;
    *spring = previous[previous_list_index];
    spring->lost = 0;
}

void contact_friction_work_carry_over_to_new_list(struct contact *c, const struct contact *previous)
{
    c->friction_work = contact_friction_dissipated_energy(previous) + contact_friction_stored_energy(previous) -
                       contact_friction_stored_energy(c);
}
