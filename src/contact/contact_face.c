/* Computes contact between faces. The height of a particle above a face follows from the density of the
 * particles of the face, which is smooth along the face although its particles are on a lattice.
 *
 *     density_i = sum_j m_j W(r_ij/(2 D_ij)),   W(q) = (1 - q)^4 (1 + 4 q), 0 for q >= 1  (Wendland 1995)
 *     gap_i     = depth(density_i) - mean_i - zero_i,   mean_i = sum_j m_j W rise_j/density_i,
 *                 at least depth(density_i) - 1.9
 *     energy    = sum_i 1/4 k_i gap_i^2  where gap < 0
 *
 * i: particle; j: particles of the face; r_ij: distance; D_ij: mean of the two spacings; m_j =
 * (D_j/D_ij)^(dim-1). depth: function that returns the height s of a particle above the first layer of a
 * square lattice [spacings]. rise_j: height of the surface of the body above particle j minus 1/2 [spacings]
 * (a curved face has steps on a lattice, the surface has none). zero = 1 + rise_i, or less for particles that
 * are closer in the reference configuration. If both surfaces are high above their particles, contact would
 * begin beyond the range of W, with a finite overlap as soon as a particle is in this range; the lower bound
 * of the gap prevents it. Each of two faces in contact contributes: together 1/2 k g^2, as the form `pair`.
 * Energies depend on distances alone: forces are central, momentum and angular momentum are conserved. Along
 * a flat face of a square lattice the tangential force is at most 0.7 % of the pressure (54 % with the form
 * `pair`). */
#include <math.h>

#include "contact_internal.h"

static real kernel(real q) { return square(square(1 - q)) * (1 + 4 * q); }
static real kernel_slope(real q) { return -20 * q * (1 - q) * square(1 - q); }

/* ---- depth of a face by the density above it --------------------------------------------------------------------- */

/* Computes the density of a flat face at the height s above one of its particles [spacings], and the derivative of the
 * density by s. The density at a point is the number of particles of the face nearby, weighted by a kernel that
 * decreases with their distance. The face is one layer of a square or cubic lattice, in 1D (dim is 1) a single
 * particle. *density, *slope: receive the density [1] and the derivative [1/spacing]. */
static void layer_density(int dim, real s, real *density, real *slope)
{
    *density = *slope = 0;
    for (int a = dim > 1 ? -3 : 0; a <= (dim > 1 ? 3 : 0); a++)
        for (int b = dim > 2 ? -3 : 0; b <= (dim > 2 ? 3 : 0); b++) {
            const real r = sqrt(a * a + b * b + s * s), q = r / CONTACT_REACH;
            if (q >= 1) continue;
            *density += kernel(q);
            *slope += kernel_slope(q) / CONTACT_REACH * s / r;
        }
}

#define DEPTH_LEAST 0.2 /* smallest depth below a face in the table of densities [spacings] */
#define DEPTH_MOST 1.9  /* largest depth in this table [spacings] */

void contact_profile_tabulate_height_above_flat_face(struct contact_profile *table, int dim)
{
    for (int k = 0; k < PROFILE_NODES; k++) {
        table->depth[k] = DEPTH_LEAST + (DEPTH_MOST - DEPTH_LEAST) * k / (PROFILE_NODES - 1);
        layer_density(dim, table->depth[k], &table->density[k], &table->slope[k]);
        table->slope[k] = 1 / table->slope[k];
    }
}

/* Returns the height of a point above the layer of particles of a face [spacings], from the density of the face at this
 * point (number of particles nearby, weighted by a kernel). profile: table of heights by densities, interpolated by
 * cubics; linear for densities above its range and constant below. *slope: receives the derivative of the height by the
 * density. */
static real table_depth(const struct contact_profile *profile, real density, real *slope)
{
    int low = 0, high = PROFILE_NODES - 1;
    *slope = 0;
    if (density <= profile->density[high]) return profile->depth[high];
    *slope = profile->slope[0];
    if (density >= profile->density[0]) return profile->depth[0] + *slope * (density - profile->density[0]);
    while (high - low > 1) {
        const int middle = (low + high) / 2;
        if (profile->density[middle] > density)
            low = middle;
        else
            high = middle;
    }
    const real width = profile->density[high] - profile->density[low], t = (density - profile->density[low]) / width;
    const real from = profile->depth[low], to = profile->depth[high];
    const real a = profile->slope[low] * width - (to - from), b = (to - from) - profile->slope[high] * width;
    *slope = ((to - from) + (1 - 2 * t) * (a * (1 - t) + b * t) + t * (1 - t) * (b - a)) / width;
    return from * (1 - t) + to * t + t * (1 - t) * (a * (1 - t) + b * t);
}

/* ---- field of the faces ----------------------------------------------------------------------------------------- */

/* Returns the weight m_l [1] of a particle l in the density of its face at a nearby particle k. This density is the sum
 * of m_l W(r/reach) over particles l, with the kernel W and the distance r. The weight is the spacing of l divided by
 * the mean of both spacings, to the power dim - 1. k, l: entries of both particles in the contact list c (particles
 * near faces). *reach: receives the distance at which W becomes 0 [m]. */
static real field_share(const struct contact *c, int dim, int64_t k, int64_t l, real *reach)
{
    const real mean = 0.5 * (c->size[k] + c->size[l]), ratio = c->size[l] / mean;
    *reach = CONTACT_REACH * mean;
    return dim == 3 ? square(ratio) : dim == 2 ? ratio : 1;
}

/* Density of the faces at a particle (weighted number of particles nearby) and mean rise: height of the surface
 * above the particles of the faces, minus 1/2 [spacings]. */
struct face_field {
    real density, mean;
};

/* Computes two sums over the particles that form a pair with the particle of row `row` of the contact list c (particles
 * that may come into contact), weighted by a kernel of the distance: the density of the faces around the particle of
 * the row, and the mean of the rises. (The rise of a particle is the height of the body's surface above the particle
 * minus 1/2 spacing.) place[dim][particles]: present or reference positions of the particles p [m]. */
static struct face_field face_field_at(const struct contact *c, const struct particles *p, real *const *place,
                                       int64_t row)
{
    struct face_field field = {0, 0};
    const int32_t i = c->particle[row];
    for (int64_t q = c->first[row]; q < c->first[row + 1]; q++) {
        const int32_t l = c->other[q], j = c->particle[l];
        real reach, r2 = 0;
        const real share = field_share(c, p->dim, row, l, &reach);
        for (int d = 0; d < p->dim; d++) r2 += square(place[d][i] - place[d][j]);
        if (r2 >= square(reach)) continue;
        const real weight = share * kernel(sqrt(r2) / reach);
        field.density += weight, field.mean += weight * c->rise[l];
    }
    if (field.density > 0) field.mean /= field.density;
    return field;
}

/* Height of a particle above a face and gap between both surfaces [spacings], and slope, the derivative of both by
 * the density of the face. leans: true if the gap depends on the mean rise, the height of the surface above the
 * particles of the face; false if the gap is at its lower bound. */
struct face_gap {
    real height, gap, slope;
    bool leans;
};

/* Returns the height of a particle above a face, the gap between both surfaces [spacings], and the derivative of both
 * by the density of the face (number of its particles nearby, weighted by distance). The gap is at least the tabulated
 * height minus DEPTH_MOST. c: contact, for the table of heights by density; field: density of the face at the particle,
 * and mean rise of the face (height of its surface above its particles, minus 1/2); zero: height at which contact
 * begins [spacings]. */
static struct face_gap face_gap(const struct contact *c, const struct face_field *field, real zero)
{
    struct face_gap at;
    const real depth = table_depth(&c->law.profile, field->density, &at.slope), least = depth - DEPTH_MOST;
    at.height = depth - field->mean;
    at.leans = at.height - zero >= least;
    at.gap = at.leans ? at.height - zero : least;
    return at;
}

void contact_face_store_gap_and_energy_derivatives(struct contact *c, const struct particles *p, int64_t list_index,
                                                   real dt, struct contact_summary *found)
{
    struct contact_face *face = &c->face[list_index];
    face->push = face->lift = 0;
    if (!contact_is_in_active_set(contact_active_set_flags(c), list_index, true)) return;
    const struct face_field field = face_field_at(c, p, p->x, list_index);
    const struct face_gap at = face_gap(c, &field, face->zero);
    const bool touches = contact_is_in_active_set(contact_active_set_flags(c), list_index, at.gap < 0);
    const real force =
        0.5 * face->stiffness * (touches ? at.gap : 0) +
        contact_leapfrog_error_correction_force(&c->balance[list_index], face->stiffness, at.gap, dt > 0);
    face->mean = field.mean;
    if (!touches) return;
    face->push = force * at.slope;
    face->lift = at.leans ? force / field.density : 0;
    contact_summary_add_overlap(found, -at.gap * c->size[list_index], c->particle[list_index]);
}

real contact_face_gap_of_particle(const struct contact *c, const struct particles *p, int64_t list_index)
{
    const struct face_field field = face_field_at(c, p, p->x, list_index);
    return face_gap(c, &field, c->face[list_index].zero).gap;
}

real contact_face_energy_of_particle(const struct contact *c, const struct particles *p, int64_t list_index)
{
    const real gap = contact_face_gap_of_particle(c, p, list_index);
    return contact_is_in_active_set(contact_active_set_flags(c), list_index, gap < 0)
               ? 0.25 * c->face[list_index].stiffness * square(gap)
               : 0;
}

/* Returns the derivative of the contact energy of particle k by the weight of particle l in the density of the face at
 * particle k [J]. (The density is the weighted number of particles of the face nearby.) k, l: entries of both particles
 * in the contact list c. */
static real face_pull(const struct contact *c, int64_t k, int64_t l)
{
    const struct contact_face *face = &c->face[c->root[k]];
    return face->push - face->lift * (c->rise[l] - face->mean);
}

struct contact_density_contribution contact_face_kernel_density_contribution_of_pair(const struct contact *c,
                                                                                     const struct particles *p,
                                                                                     int64_t k, int64_t l,
                                                                                     real time_before_present)
{
    struct contact_density_contribution w = {0};
    const int32_t i = c->particle[k], j = c->particle[l];
    real reach, r2 = 0;
    const real share = field_share(c, p->dim, k, l, &reach);
    for (int d = 0; d < p->dim; d++) {
        w.apart[d] = p->x[d][i] - p->x[d][j] - time_before_present * (p->v[d][i] - p->v[d][j]);
        r2 += square(w.apart[d]);
    }
    const real r = sqrt(r2);
    if (r >= reach || !(r > 0)) return w;
    w.weight = share * kernel(r / reach);
    w.pull = face_pull(c, k, l) * share * kernel_slope(r / reach) / (reach * r);
    return w;
}

/* Adds the contact force on the particle of row `list_index` of the contact list c to p->f. The contact energy of a
 * particle near a face depends on the density of that face at the particle: the number of particles of the face nearby,
 * weighted by their distance. So the force has two parts: the derivative of the particle's own energy, and the
 * derivatives of the energies of those particles in whose densities it counts. Pairs in which no particle is pushed are
 * skipped. */
void contact_face_add_force_on_particle(const struct contact *c, struct particles *p, int64_t list_index)
{
    const int32_t i = c->particle[list_index];
    real f[DIM_MAX] = {0}, apart[DIM_MAX], reach;
    for (int64_t q = c->first[list_index]; q < c->first[list_index + 1]; q++) {
        const int64_t l = c->other[q];
        if (c->face[list_index].push == 0 && c->face[c->root[l]].push == 0) continue;
        const real own = field_share(c, p->dim, list_index, l, &reach),
                   back = field_share(c, p->dim, l, list_index, &reach);
        const real r2 = contact_pair_vector_and_squared_distance(c, p, list_index, l, apart);
        if (r2 >= square(reach) || r2 == 0) continue;
        const real r = sqrt(r2), slope = kernel_slope(r / reach) / (reach * r);
        const real pull = (face_pull(c, list_index, l) * own + face_pull(c, l, list_index) * back) * slope;
        for (int d = 0; d < p->dim; d++) f[d] -= pull * apart[d];
    }
    for (int d = 0; d < p->dim; d++) p->f[d][i] += f[d];
}

void contact_face_linearise_as_spring(const struct contact *c, const struct particles *p, int64_t list_index,
                                      struct contact_term *term)
{
    const struct face_field field = face_field_at(c, p, p->x, list_index);
    const struct face_gap at = face_gap(c, &field, c->face[list_index].zero);
    term->n = 1, term->stiffness = 0.5 * c->face[list_index].stiffness;
    term->particle[0] = c->particle[list_index];
    for (int d = 0; d < DIM_MAX; d++) term->along[0][d] = 0;
    for (int64_t q = c->first[list_index]; q < c->first[list_index + 1]; q++) {
        const int64_t l = c->other[q];
        real apart[DIM_MAX], reach;
        const real share = field_share(c, p->dim, list_index, l, &reach),
                   r = sqrt(contact_pair_vector_and_squared_distance(c, p, list_index, l, apart));
        if (r >= reach || !(r > 0)) continue;
        const real by_weight = at.slope - (at.leans ? (c->rise[l] - field.mean) / field.density : 0);
        const real pull = by_weight * share * kernel_slope(r / reach) / (reach * r);
        term->particle[term->n] = c->particle[l];
        for (int d = 0; d < p->dim; d++) {
            term->along[0][d] += pull * apart[d];
            term->along[term->n][d] = -pull * apart[d];
        }
        term->n++;
    }
}

/* ---- begin of contact -------------------------------------------------------------------------------------------- */

/* Returns the contact stiffness of the particle of p in row `row` of the contact list c [J], for gaps in spacings: the
 * smallest stiffness of a pair that it forms with another particle of the list (particles that may come into contact),
 * or, without pairs, that of a pair of two particles like this one. */
static real face_stiffness(const struct contact *c, const struct particles *p, int64_t row)
{
    real least = INFINITY;
    for (int64_t q = c->first[row]; q < c->first[row + 1]; q++) {
        const int64_t l = c->other[q];
        least = real_min(least, contact_pair_stiffness(c, p, row, l) * square(0.5 * (c->size[row] + c->size[l])));
    }
    return isfinite(least) ? least : contact_pair_stiffness(c, p, row, row) * square(c->size[row]);
}

/* Returns the width of the widest notch (a pre-crack with a width) between the particle of row `row` of the contact
 * list c and the particles of p near it in the reference configuration [spacings of the particle]; 0 if there is no
 * notch. */
static real face_notch(const struct contact *c, const struct particles *p, int64_t row)
{
    real widest = 0;
    for (int64_t q = c->first[row]; q < c->first[row + 1]; q++) {
        const int32_t i = c->particle[row], j = c->particle[c->other[q]];
        real reach, r2 = 0;
        field_share(c, p->dim, row, c->other[q], &reach);
        for (int d = 0; d < p->dim; d++) r2 += square(p->X[d][i] - p->X[d][j]);
        if (r2 < square(reach))
            widest = real_max(widest, contact_width_of_widest_notch_between_particles(c, p, row, c->other[q]));
    }
    return widest / c->size[row];
}

/* Returns a lower bound of the gap between the particle of row `row` of the contact list c and a face [spacings]. The
 * gap itself depends on the mean rise of the face (height of its surface above its particles), which jumps when another
 * particle comes into range. The bound uses the largest rise of the particle's pairs instead. field: density of the
 * face at the particle. */
static real least_gap(const struct contact *c, const struct face_field *field, int64_t row)
{
    struct face_field highest = *field;
    for (int64_t q = c->first[row]; q < c->first[row + 1]; q++)
        highest.mean = real_max(highest.mean, c->rise[c->other[q]]);
    return face_gap(c, &highest, c->face[row].zero).gap;
}

/* Returns true if row `row` of the contact list c and row `was` of the list of the previous search, `before`, have
 * pairs with the same particles in the same order. (A row has the pairs of one particle.) The densities of the face,
 * from which gaps follow, are then equal. */
static bool same_pairs(const struct contact *c, const struct contact *before, int64_t was, int64_t row)
{
    const int64_t n = c->first[row + 1] - c->first[row];
    const int32_t *now = c->other + c->first[row], *then = before->other + before->first[was];
    bool same = before->first[was + 1] - before->first[was] == n;
    for (int64_t q = 0; q < n && same; q++) same = c->particle[now[q]] == before->particle[then[q]];
    return same;
}

/* Computes, after a search, c->face[row].zero: the height above the opposite face at which contact of the particle of
 * row `list_index` begins [spacings]. For a particle already in contact it is such that the contact energy does not
 * change. For others it is the height at which the surfaces of the bodies touch, less the width of a notch between
 * them, or less if the particle is closer in the reference or present configuration: contact then begins without a
 * force. previous: contact list before the search; previous_list_index: row of the particle in it, -1 if none; p:
 * particles at their present positions. */
void contact_face_set_height_where_contact_begins(struct contact *c, const struct contact *previous,
                                                  int64_t previous_list_index, const struct particles *p,
                                                  int64_t list_index)
{
    struct contact_face *face = &c->face[list_index];
    const bool pairs = c->first[list_index + 1] > c->first[list_index];
    const struct face_field now = face_field_at(c, p, p->x, list_index),
                            reference = pairs ? face_field_at(c, p, p->X, list_index) : now;
    real overlap = 0;
    face->stiffness = face_stiffness(c, p, list_index);
    face->push = face->lift = 0, face->mean = now.mean;
    if (previous_list_index >= 0) {
        const struct face_field then = same_pairs(c, previous, previous_list_index, list_index)
                                           ? now
                                           : face_field_at(previous, p, p->x, previous_list_index);
        overlap = real_max(0, -face_gap(previous, &then, previous->face[previous_list_index].zero).gap);
        overlap *= sqrt(previous->face[previous_list_index].stiffness / face->stiffness);
    }
    const real height = face_gap(c, &now, 0).height, least = face_gap(c, &reference, 0).height;
    const real zero = real_min(1 + c->rise[list_index], least) - face_notch(c, p, list_index);
    face->zero = overlap > 0 ? height + overlap : real_min(zero, height);
    face->far = real_max(0, least_gap(c, &now, list_index));
    c->balance[list_index] = contact_leapfrog_error_carry_over_to_new_list(
        previous_list_index < 0 ? NULL : &previous->balance[previous_list_index], face_gap(c, &now, face->zero).gap);
}
