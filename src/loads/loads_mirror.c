/* Creates the mirror images of particles at planes of symmetry and updates their motion. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "loads/mirrors.h"
#include "base/memory.h"

/* Returns the step [m] to multiples of which the coordinates along `axis` are rounded, for particles of p with mirror
 * images, so that reflection at a plane of symmetry causes no round-off. Then the force of particle i on the image of j
 * cancels that of j on the image of i to the last bit; otherwise round-off would move slow bodies. Returns 0 (no
 * rounding) if all such planes are at 0. boundary[n]: boundaries of the scene; reach: length of the longest bonds [m].
 */
static real place_step(const struct boundary *boundary, int n, const struct particles *p, real reach, int axis)
{
    real farthest = 0;
    for (int b = 0; b < n; b++)
        if (boundary[b].kind == BOUNDARY_MIRROR && boundary[b].axis == axis)
            farthest = real_max(farthest, 2 * fabs(boundary[b].at));
    if (farthest == 0) return 0;
    for (int64_t i = 0; i < p->n; i++) farthest = real_max(farthest, fabs(p->X[axis][i]));
    return scalbn(1, ilogb(farthest + reach) + 2 - DBL_MANT_DIG);
}

/* Returns the multiple of l->place_step[axis] nearest to coordinate `place` [m], or `place` itself if the step is 0. */
static real stepped(const struct loads *l, int axis, real place)
{
    const real step = l->place_step[axis];
    return step > 0 ? step * nearbyint(place / step) : place;
}

/* Appends to p and l->image the mirror images at the plane of symmetry of load number `which` of l: those of all
 * particles of its body within `reach` of the plane [m], and those of images that other planes have made, for corners.
 * Particles on the plane have no image. The positions of the particles with images are rounded to multiples of
 * l->place_step. optional: set of the optional arrays of p, as sum of WITH_*. */
static void mirror_make(struct loads *l, int which, struct particles *p, real reach, int optional)
{
    const struct boundary *b = l->load[which].boundary;
    int64_t before = p->n_all, images = 0, have = l->images;
    for (int pass = 0; pass < 2; pass++) {
        images = 0;
        for (int64_t i = 0; i < before; i++) {
            real distance = fabs(p->X[b->axis][i] - b->at);
            if (distance > reach || distance <= LOADS_TOLERANCE * l->spacing) continue;
            if (b->body >= 0 && p->body[i] != b->body) continue;
            if (pass == 1) {
                l->image[have + images] = (struct image){(int32_t)i, (uint8_t)which};
                p->X[b->axis][i] = stepped(l, b->axis, p->X[b->axis][i]);
            }
            images++;
        }
        if (pass == 0) GROW("loads.image", l->image, have + images);
    }
    particles_extend_arrays_for_mirror_images(p, images, optional);
    l->images += images;
    for (int64_t k = have; k < l->images; k++) {
        int64_t g = p->n + k, i = l->image[k].source;
        for (int d = 0; d < p->dim; d++) p->X[d][g] = d == b->axis ? stepped(l, d, 2 * b->at) - p->X[d][i] : p->X[d][i];
        p->volume0[g] = p->volume0[i], p->volume[g] = p->volume[i], p->mass[g] = p->mass[i];
        p->material[g] = p->material[i], p->body[g] = p->body[i], p->id[g] = p->id[i];
        if (p->strength) p->strength[g] = p->strength[i];
    }
}

void loads_update_mirror_images_of_particles(const struct loads *l, struct particles *p)
{
    for (int64_t k = 0; k < l->images; k++) { /* all sources first: corners have mirror images of images */
        const int axis = l->load[l->image[k].load].boundary->axis;
        const int64_t i = l->image[k].source;
        if (i < p->n) p->x[axis][i] = stepped(l, axis, p->x[axis][i]);
    }
    for (int64_t k = 0; k < l->images; k++) {
        int64_t g = p->n + k, i = l->image[k].source;
        const struct boundary *b = l->load[l->image[k].load].boundary;
        for (int d = 0; d < p->dim; d++) {
            const bool odd = d == b->axis || b->hold_tangential;
            p->x[d][g] = odd ? p->X[d][g] - (p->x[d][i] - p->X[d][i]) : p->x[d][i];
            p->v[d][g] = odd ? -p->v[d][i] : p->v[d][i];
        }
        p->kind[g] = p->kind[i];
        p->flag[g] = p->flag[i] & FLAG_DRIVEN;
    }
}

/* Returns REFUSED, with a message, if particles of p in the body of mirror b are on both sides of its plane, because
 * images would coincide with particles; else OK. spacing: lattice spacing [m]. */
static status mirror_checked(const struct boundary *b, const struct particles *p, real spacing)
{
    bool below = false, above = false;
    for (int64_t i = 0; i < p->n; i++) {
        if (b->body >= 0 && p->body[i] != b->body) continue;
        below = below || p->X[b->axis][i] < b->at - LOADS_TOLERANCE * spacing;
        above = above || p->X[b->axis][i] > b->at + LOADS_TOLERANCE * spacing;
    }
    if (!(below && above)) return OK;
    return status_set(REFUSED,
                      "boundary %s: the mirror plane %c = %.6g m cuts the body; move the plane to a face of the "
                      "body, or cut the body there (`intersect` or `subtract` a box)",
                      b->name, "xyz"[b->axis], b -> at);
}

/* Returns the side of mirror b on which there is no body: -1 below the plane, 1 above it. The body is on the side of
 * the mean coordinate of its particles in p. */
static int mirror_outside(const struct boundary *b, const struct particles *p)
{
    real sum = 0;
    for (int64_t i = 0; i < p->n; i++)
        if (b->body < 0 || p->body[i] == b->body) sum += p->X[b->axis][i] - b->at;
    return sum > 0 ? -1 : 1;
}

/* Finds two parallel mirrors of one body that are at most `most` apart [m]. b[n]: boundaries of the scene. Returns the
 * number of the later one and stores that of the earlier one in *other, or returns -1. */
static int close_mirrors(const struct boundary *b, int n, real most, int *other)
{
    for (int k = 0; k < n; k++)
        for (int m = 0; m < k; m++) {
            if (b[k].kind != BOUNDARY_MIRROR || b[m].kind != BOUNDARY_MIRROR || b[k].axis != b[m].axis) continue;
            if (b[k].body >= 0 && b[m].body >= 0 && b[k].body != b[m].body) continue;
            if (fabs(b[k].at - b[m].at) > most) continue;
            *other = m;
            return k;
        }
    return -1;
}

/* Returns REFUSED, with a message, if two parallel mirrors of a body coincide, else OK. b[n]: boundaries of the scene;
 * spacing: lattice spacing [m]. */
static status mirrors_differ(const struct boundary *b, int n, real spacing)
{
    int m;
    const int k = close_mirrors(b, n, 1e-6 * spacing, &m);
    if (k < 0) return OK;
    return status_message_prepend_location(
        b[k].place,
        status_set(REFUSED, "boundary %s: its mirror plane is also that of boundary %s; remove one of the two",
                   b[k].name, b[m].name));
}

status loads_check_distance_between_mirrors(const struct loads *l, real bond_length)
{
    const struct boundary *b = l->n ? l->load[0].boundary : NULL;
    int m;
    const int k = close_mirrors(b, l->n, bond_length - l->spacing, &m);
    if (k < 0) return OK;
    return status_message_prepend_location(
        b[k].place,
        status_set(REFUSED,
                   "boundary %s: its mirror plane is %.6g m from that of boundary %s, but bonds of %.6g m need more "
                   "than %.6g m between the planes; move one of them, or use a smaller particles.horizon",
                   b[k].name, fabs(b[k].at - b[m].at), b[m].name, bond_length, bond_length - l->spacing));
}

status loads_append_mirror_images_of_particles(struct loads *l, struct particles *p, real mirror_reach,
                                               int optional_arrays)
{
    const struct boundary *boundary = l->n ? l->load[0].boundary : NULL;
    TRY(mirrors_differ(boundary, l->n, l->spacing));
    for (int d = 0; d < p->dim; d++) l->place_step[d] = place_step(boundary, l->n, p, mirror_reach, d);
    for (int b = 0; b < l->n; b++) {
        if (boundary[b].kind != BOUNDARY_MIRROR) continue;
        TRY(status_message_prepend_location(boundary[b].place, mirror_checked(&boundary[b], p, l->spacing)));
        l->load[b].outside = mirror_outside(&boundary[b], p);
        mirror_make(l, b, p, mirror_reach, optional_arrays);
    }
    l->reach = mirror_reach;
    loads_update_mirror_images_of_particles(l, p);
    return OK;
}

void loads_flag_clamped_mirror_particles_to_move_late(struct loads *l, const struct particles *p)
{
    for (int b = 0; b < l->n; b++) {
        const struct boundary *clamp = l->load[b].boundary;
        for (int64_t i = 0; i < p->n && boundary_is_mirror_without_tangential_motion(clamp, p->dim); i++)
            if ((clamp->body < 0 || p->body[i] == clamp->body) && fabs(p->X[clamp->axis][i] - clamp->at) <= l->reach)
                l->loaded[i] |= MOVES_LATER;
    }
}
