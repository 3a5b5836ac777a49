/* Computes the faces of a body of lattice particles: outward areas, and normals averaged over a neighbourhood, because
 * a slope on a lattice is a staircase.
 *
 * A particle without its nearest neighbour up or down an axis, or cut from it by a crack, has a face of area 1 there.
 * Faces within a neighbourhood that bonds connect and whose normals are less than 90 degrees apart form one face with
 * their mean normal N, as far as they are in one plane: completely if their variance along N is below `FLAT` spacings
 * squared, not at all above `ROUGH`. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "surface_parts.h"

#define FLAT 0.2 /* variance [spacings^2]; a staircase of any slope has at most 1/12 + 1/12 */
#define ROUGH 0.4
/* Exponent by which the mean product of face normals decreases where fewer faces are nearby than at a plane face
 * (normals_gather); strains that load such faces then have more weight in the fit of bond factors (surface_fit.c). With
 * 0, particles ahead of a crack are too soft as well, and stress-intensity factors are 1 % larger at 100 particles.
 * Empirical. Models with rotations use 0: it hardly changes their stress-intensity factors, and makes frequencies of
 * beams of 20 layers 1 % lower. */
#define NEAR 3

enum { CHAIN = 3 }; /* layers over which area and dipole of a face are distributed */

/* Face of a particle, as seen from another one through mirrors: area vector [spacings^(dim-1)], position of its centre
 * [spacings] and length of the area vector. */
struct exposed_face {
    real area[DIM_MAX], centre[DIM_MAX], size;
};

/* Area vectors [near n] of the faces of the particles near faces, on the lattice: sums of unit vectors along the
 * axes on which a particle has no neighbour [spacings^(dim-1)]. */
struct raw_faces {
    const struct particles_near_faces *body;
    real (*area)[DIM_MAX];
};

/* Returns true if a particle has a face at one end of an axis, because it has no neighbour there. t: index of the
 * particle among `near_faces`, those near faces; axis: 0 to dim - 1; up: 1 for the end in positive direction, 0 for
 * that in negative direction. */
static bool lacks(const struct particles_near_faces *near_faces, int64_t t, int axis, int up)
{
    return particles_near_faces_neighbour_at_offset(near_faces, t, near_faces->offset.axis[axis][up]) < 0;
}

/* Returns the face in `raw` of particle or mirror image j: its position and its area vector. For an image it is the
 * face of the particle that is mirrored, reflected. The size of the face is 0 if the particle is near no face. */
static struct exposed_face face_seen(const struct raw_faces *raw, int64_t j)
{
    const struct particles_near_faces *near_faces = raw->body;
    struct exposed_face f = {{0}, {0}, 0};
    const struct mirrored_particle seen = particle_or_image_find_source_and_reversed_axes(near_faces, j);
    const int64_t t = near_faces->place[seen.particle];
    if (t < 0) return f;
    for (int d = 0; d < near_faces->p->dim; d++) {
        f.area[d] = mirror_sign_of_vector_component(seen.mirrors, d) * raw->area[t][d];
        f.centre[d] = near_faces->p->X[d][j] / near_faces->source->family.spacing + 0.5 * f.area[d];
        f.size += square(f.area[d]);
    }
    f.size = sqrt(f.size);
    return f;
}

/* Returns the weight of a neighbour at lattice offset number k in means over faces [1]: 1 - r/(reach + 1), but at least
 * 0, with the distance r of the neighbour and the largest component `reach` of an offset in o [spacings]. */
static real nearness(const struct offsets *o, int k) { return fmax(1 - o->length[k] / (o->reach + 1), 0); }

/* Mean over the faces whose normals are less than 90 degrees from that of a particle: normal, and variance of their
 * positions along it [spacings^2]. */
struct mean_face {
    real normal[DIM_MAX], variance;
};

/* Adds a face f, times `weight`, to sums over faces: its area vector to area[dim], and to sums[13] its size (1 number)
 * and the first (3) and second (9) moments of its position relative to from[dim] [spacings]. */
static void mean_add(const struct exposed_face *f, const real *from, real weight, int dim, real *area, real *sums)
{
    real x[DIM_MAX];
    for (int d = 0; d < dim; d++) area[d] += weight * f->area[d], x[d] = f->centre[d] - from[d];
    sums[0] += weight * f->size;
    for (int a = 0; a < dim; a++) {
        sums[1 + a] += weight * f->size * x[a];
        for (int c = 0; c < dim; c++) sums[4 + 3 * a + c] += weight * f->size * x[a] * x[c];
    }
}

/* Returns the mean over the faces near a particle whose normals are less than 90 degrees from that of its own face:
 * their normal, and the variance of their positions along this normal [spacings^2], 0 for a plane face. raw: faces on
 * the lattice; t: index of the particle among those near faces. */
static struct mean_face mean_face_of(const struct raw_faces *raw, int64_t t)
{
    const struct particles_near_faces *near_faces = raw->body;
    const int dim = near_faces->p->dim;
    const struct exposed_face own = face_seen(raw, near_faces->particle[t]);
    real area[DIM_MAX] = {0}, sums[4 + 9] = {0}, size = 0;
    struct mean_face mean = {{0}, 0};
    mean_add(&own, own.centre, 1, dim, area, sums);
    for (int k = 0; k < near_faces->offset.n; k++) {
        if (particles_near_faces_neighbour_at_offset(near_faces, t, k) < 0) continue;
        const struct exposed_face other = face_seen(raw, particles_near_faces_neighbour_at_offset(near_faces, t, k));
        if (other.size > 0 && dot(own.area, other.area, dim) > -1e-9)
            mean_add(&other, own.centre, nearness(&near_faces->offset, k), dim, area, sums);
    }
    for (int d = 0; d < dim; d++) size += square(area[d]);
    for (int d = 0; d < dim; d++) mean.normal[d] = area[d] / fmax(sqrt(size), 1e-12);
    for (int a = 0; a < dim; a++)
        for (int c = 0; c < dim; c++)
            mean.variance += mean.normal[a] * mean.normal[c] *
                             (sums[4 + 3 * a + c] / sums[0] - sums[1 + a] * sums[1 + c] / square(sums[0]));
    return mean;
}

/* Smoothed face of a particle. project: matrix that projects face areas along the axes onto the mean normal N of the
 * faces nearby; square: contribution of the face to the mean of N (x) N. Where the faces nearby are not in one plane,
 * both are interpolated to those of the particle's own face. */
struct smooth {
    real project[DIM_MAX][DIM_MAX], square[DIM_MAX][DIM_MAX];
};

/* Computes in *to how the lattice face of a particle is smoothed, because an inclined face is a staircase on the
 * lattice: the matrix that projects the face area onto the mean normal N of the faces nearby, and the contribution of
 * the face to the mean of N (x) N. Smoothing is complete if the variance of the positions of these faces about a plane
 * is at most FLAT, none from ROUGH on, and in proportion between. Without a face the matrix is the identity and the
 * contribution 0. raw: faces on the lattice; t: index of the particle among those near faces. */
static void smooth_make(struct smooth *to, const struct raw_faces *raw, int64_t t)
{
    const int dim = raw->body->p->dim;
    const real *area = raw->area[t], size2 = dot(area, area, dim);
    *to = (struct smooth){{{0}}, {{0}}};
    if (size2 == 0) {
        for (int d = 0; d < dim; d++) to->project[d][d] = 1;
        return;
    }
    const struct mean_face mean = mean_face_of(raw, t);
    const real share = fmin(fmax((ROUGH - mean.variance) / (ROUGH - FLAT), 0), 1);
    for (int a = 0; a < dim; a++)
        for (int c = 0; c < dim; c++) {
            const real both = mean.normal[a] * mean.normal[c];
            to->project[a][c] = (1 - share) * (a == c) + share * both;
            to->square[a][c] = (1 - share) * area[a] * area[c] + share * size2 * both;
        }
}

/* Returns the sum of the weights of all faces on an infinite plane, as seen from a particle of its first layer [1]. The
 * weight of a face falls linearly to 0 with its distance. o: lattice offsets within the cutoff. */
static real plane_of_faces(const struct offsets *o)
{
    real sum = 1;
    for (int k = 0; k < o->n; k++) sum += o->at[k][0] == 0 ? nearness(o, k) : 0;
    return sum;
}

/* The smoothed faces of the n particles with faces. at: index in `smooth` of each particle near faces, -1 if it has
 * no face. */
struct smooth_faces {
    int64_t n;
    int32_t *at;           /* [near n] */
    struct smooth *smooth; /* [n] */
};

/* Computes the smoothed face (struct smooth) of each particle that lacks a nearest neighbour along an axis, because
 * slopes and curves of a body on a lattice are staircases. s->at[particles near faces]: receives the index of the
 * smoothed face of each particle, -1 if the particle has none. raw: faces on the lattice, not smoothed. */
static void smooth_faces_make(struct smooth_faces *s, const struct raw_faces *raw)
{
    const struct particles_near_faces *near_faces = raw->body;
    *s = (struct smooth_faces){.at = BARE("surface.smooth", near_faces->n, int32_t)};
    for (int64_t t = 0; t < near_faces->n; t++) {
        bool any = false;
        for (int d = 0; d < near_faces->p->dim; d++)
            any = any || lacks(near_faces, t, d, 0) || lacks(near_faces, t, d, 1);
        s->at[t] = any ? (int32_t)s->n++ : -1;
    }
    s->smooth = BARE("surface.smooth", s->n, struct smooth);
#pragma omp parallel for schedule(static)
    for (int64_t t = 0; t < near_faces->n; t++)
        if (s->at[t] >= 0) smooth_make(&s->smooth[s->at[t]], raw, t);
}

/* Computes f->normal2[t], the mean of N (x) N over the faces near a particle with unit normals N, weighted by nearness.
 * If the faces nearby have less weight than those at a plane face, the mean is multiplied by the ratio of both to the
 * power NEAR, except in models with rotations (`rotates`). It is 0 without faces. s: smoothed faces; plane: sum of the
 * weights at a plane face; t: index of the particle among `near_faces`, those near faces. */
static void normals_gather(struct surface_fit_targets *f, const struct particles_near_faces *near_faces,
                           const struct smooth_faces *s, real plane, bool rotates, int64_t t)
{
    const int dim = near_faces->p->dim;
    real sum[DIM_MAX][DIM_MAX] = {{0}}, trace = 0;
    if (s->at[t] >= 0) array_copy(sum, s->smooth[s->at[t]].square, 1, sizeof sum);
    for (int k = 0; k < near_faces->offset.n; k++) {
        const int32_t j = particles_near_faces_neighbour_at_offset(near_faces, t, k);
        if (j < 0) continue;
        const struct mirrored_particle seen = particle_or_image_find_source_and_reversed_axes(near_faces, j);
        const int64_t near = near_faces->place[seen.particle], other = near < 0 ? -1 : s->at[near];
        for (int a = 0; a < dim && other >= 0; a++)
            for (int c = 0; c < dim; c++)
                sum[a][c] += nearness(&near_faces->offset, k) * mirror_sign_of_vector_component(seen.mirrors, a) *
                             mirror_sign_of_vector_component(seen.mirrors, c) * s->smooth[other].square[a][c];
    }
    for (int d = 0; d < dim; d++) trace += sum[d][d];
    const real near = rotates ? 1 : pow(fmin(trace / plane, 1), NEAR);
    for (int a = 0; a < dim; a++)
        for (int c = 0; c < dim; c++) f->normal2[t][a][c] = trace > 1e-12 ? near * sum[a][c] / trace : 0;
}

/* Distributes the face of a particle at one end of `axis` over the layers of particles behind it, as targets for the
 * moments of their bonds. f->area receives the area, extrapolated from the middles of the layers to the face. f->dipole
 * receives coefficients of the change from layer to layer: 1, -1 on the first two layers; with rotations (`rotates`)
 * and three layers 2, -3, 1, a one-sided first derivative of second order at the face; none with a single layer.
 * smooth: smoothing of the face; t: index of the particle among `near_faces`, those near faces; up: 1 for the end in
 * positive direction, else 0. */
static void face_spread(struct surface_fit_targets *f, const struct particles_near_faces *near_faces,
                        const struct smooth *smooth, int64_t t, int axis, int up, bool rotates)
{
    static const real area[2][2] = {{1}, {1.5, -0.5}}, first[2] = {1, -1}, second[CHAIN] = {2, -3, 1};
    struct mirrored_particle chain[CHAIN] = {{near_faces->particle[t], 0}};
    int length = 1;
    while (length < CHAIN) { /* through mirrors too */
        const struct mirrored_particle next =
            mirrored_particle_neighbour_at_offset(near_faces, &chain[length - 1], near_faces->offset.axis[axis][!up]);
        if (next.particle < 0 || near_faces->place[next.particle] < 0) break;
        chain[length++] = next;
    }
    const int two = length > 1;
    for (int k = 0; k <= two; k++)
        for (int d = 0; d < near_faces->p->dim; d++)
            f->area[near_faces->place[chain[k].particle]][d] += mirror_sign_of_vector_component(chain[k].mirrors, d) *
                                                                area[two][k] * (up ? 1 : -1) * smooth->project[d][axis];
    if (rotates && length == CHAIN)
        for (int k = 0; k < CHAIN; k++) f->dipole[near_faces->place[chain[k].particle]] += second[k];
    else if (two)
        for (int k = 0; k < 2; k++) f->dipole[near_faces->place[chain[k].particle]] += first[k];
}

/* Returns the number of layers of particles along an axis through a particle, from face to face of the body, at most
 * `most`; `most` also if the line contains particles that are near no face. t: index of the particle among
 * `near_faces`, those near faces. */
static int layers(const struct particles_near_faces *near_faces, int64_t t, int axis, int most)
{
    int n = 1;
    for (int up = 0; up < 2; up++) {
        struct mirrored_particle at = {near_faces->particle[t], 0};
        while (n < most) {
            at = mirrored_particle_neighbour_at_offset(near_faces, &at, near_faces->offset.axis[axis][up]);
            if (at.particle < 0) break;
            n++;
            if (near_faces->place[at.particle] < 0) return most; /* not near any face */
        }
    }
    return n;
}

void surface_fit_targets_compute_areas_and_moments(struct surface_fit_targets *f,
                                                   const struct particles_near_faces *near_faces, bool with_rotations)
{
    const int dim = near_faces->p->dim, most = with_rotations ? THIN_ROTATING : THIN;
    struct raw_faces raw = {near_faces, (real(*)[DIM_MAX])memory_new("surface.area", near_faces->n, sizeof *raw.area)};
    struct smooth_faces smooth;
    f->area = (real(*)[DIM_MAX])memory_new("surface.area", near_faces->n, sizeof *f->area);
    f->dipole = NEW("surface.dipole", near_faces->n, real);
    f->normal2 = (real(*)[DIM_MAX][DIM_MAX])memory_new("surface.normal", near_faces->n, sizeof *f->normal2);
    f->thin = NEW("surface.thin", near_faces->n, uint8_t);
    for (int64_t t = 0; t < near_faces->n; t++)
        for (int d = 0; d < dim; d++)
            raw.area[t][d] = (real)lacks(near_faces, t, d, 1) - (real)lacks(near_faces, t, d, 0);
    smooth_faces_make(&smooth, &raw);
#pragma omp parallel for schedule(static)
    for (int64_t t = 0; t < near_faces->n; t++)
        for (int d = 0; d < dim; d++) f->thin[t] = f->thin[t] || layers(near_faces, t, d, most) < most;
    const real plane = plane_of_faces(&near_faces->offset);
#pragma omp parallel for schedule(static)
    for (int64_t t = 0; t < near_faces->n; t++) normals_gather(f, near_faces, &smooth, plane, with_rotations, t);
    for (int64_t t = 0; t < near_faces->n; t++)
        for (int d = 0; d < dim; d++)
            for (int up = 0; up < 2; up++)
                if (lacks(near_faces, t, d, up))
                    face_spread(f, near_faces, &smooth.smooth[smooth.at[t]], t, d, up, with_rotations);
    memory_free(raw.area);
    memory_free(smooth.at);
    memory_free(smooth.smooth);
}

void surface_fit_targets_free(struct surface_fit_targets *f)
{
    memory_free(f->area);
    memory_free(f->dipole);
    memory_free(f->normal2);
    memory_free(f->thin);
}
