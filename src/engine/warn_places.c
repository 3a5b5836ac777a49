/* Warns of bodies that overlap, and of planes of symmetry and initial states that are beside the bodies. */
#include <math.h>

#include "data/extent.h"
#include "base/memory.h"
#include "engine_internal.h"

enum { COMPARED_MOST = 64 }; /* largest number of bodies that are compared in pairs */
#define DEEP 0.25            /* depth inside another body from which on a particle counts [spacings] */
/* Distance of a plane of symmetry from the nearest particle from which on there is a gap between plane and body
 * [spacings]. The first row of particles is half a spacing from a plane at the face. */
#define BESIDE 0.95

/* Particles of a body that are inside another body. n: their number; deepest: index of the deepest one; depth: its
 * distance from the surface [m]. */
struct overlap {
    int64_t n, deepest;
    real depth;
};

/* Returns true if particle i belongs to body number a of scene s and not to body number b. Bodies joined by interfaces
 * have the same number in p->body, that of the first of them. They are distinguished by their materials; if these are
 * equal, false is returned. */
static bool belongs_to_first_only(const struct scene *s, const struct particles *p, int64_t i, int a, int b)
{
    const struct scene_body *one = &s->body[a], *other = &s->body[b];
    return p->body[i] == one->joined && scene_body_can_have_material(one, p->material[i]) &&
           (one->joined != other->joined || !scene_body_can_have_material(other, p->material[i]));
}

/* Returns which particles p of body number a of scene s are inside the shape of body number b by more than `least` [m]:
 * their number, the deepest one and its depth. Returns none if b is made from a list of particles, whose surface is not
 * known, or if its bounding box has an infinite side. */
static struct overlap body_overlap(const struct scene *s, const struct particles *p, int a, int b, real least)
{
    const struct region *shape = &s->body[b].shape;
    struct overlap found = {0};
    real low[DIM_MAX], high[DIM_MAX], normal[DIM_MAX];
    if (s->body[b].file || shape->n == 0 || region_has_box_with_infinite_side(shape, s->dim)) return found;
    if (!region_compute_bounding_box_if_finite(shape, s->dim, low, high)) return found;
    for (int64_t i = 0; i < p->n; i++) {
        bool near = belongs_to_first_only(s, p, i, a, b);
        for (int d = 0; d < s->dim && near; d++) near = p->X[d][i] > low[d] && p->X[d][i] < high[d];
        if (!near) continue;
        real X[DIM_MAX];
        particle_reference_position(p, i, X);
        if (!region_contains(shape, X, s->dim, 0)) continue;
        const real depth = -region_signed_distance(shape, X, s->dim, normal);
        if (!(depth > least)) continue;
        if (depth > found.depth) found.depth = depth, found.deepest = i;
        found.n++;
    }
    return found;
}

/* Adds a warning to *to about the overlap of two bodies of scene s. inner: number of the body with particles inside the
 * other one; outer: number of the other body; found: those particles (indices in p). */
static void warn_of_overlap(const struct scene *s, const struct particles *p, int inner, int outer,
                            const struct overlap *found, struct warnings *to)
{
    const char *name = s->body[inner].name, *other = s->body[outer].name;
    warnings_add_if_new(
        to,
        "bodies %s and %s overlap: %lld particles of %s are inside %s, the deepest by %.3g m at (%s) m; move one body, "
        "or subtract its shape from the other; if this is intended, add accept: [contact]",
        name, other, (long long)found->n, name, other, found->depth, particle_position_text(p, found->deepest, 4).text);
}

void run_warn_of_overlapping_bodies(const struct scene *s, const struct particles *p, struct warnings *warnings)
{
    const real least = (DEEP + 0.5 * s->irregularity) * s->spacing;
    if (s->bodies > COMPARED_MOST || scene_silences_warning(s, ACCEPT_CONTACT)) return;
    for (int a = 0; a < s->bodies; a++)
        for (int b = 0; b < a; b++) {
            const struct overlap first = body_overlap(s, p, b, a, least), second = body_overlap(s, p, a, b, least);
            if (first.n > 0 && first.n >= second.n)
                warn_of_overlap(s, p, b, a, &first, warnings);
            else if (second.n > 0)
                warn_of_overlap(s, p, a, b, &second, warnings);
        }
}

/* Returns true if at least one of the particles p that belong to the joined bodies number `body` of scene s (-1: to any
 * body) is in `region`. Also returns true if the run has cells whose particles are not created, since these may be in
 * the region. */
static bool region_holds_particle(const struct scene *s, const struct particles *p, const struct region *region,
                                  int body)
{
    bool met = p->n < p->n_body;
    for (int64_t i = 0; i < p->n && !met; i++) {
        real X[DIM_MAX];
        if (body >= 0 && p->body[i] != body) continue;
        particle_reference_position(p, i, X);
        met = region->n == 0 || region_contains(region, X, s->dim, 0);
    }
    return met;
}

/* Returns true if `region` is beyond a plane of symmetry of scene s, so that it belongs to the half of a body that is
 * not modelled. */
static bool region_beyond_mirror(const struct scene *s, const struct region *region)
{
    real low[DIM_MAX], high[DIM_MAX];
    bool beyond = false;
    if (!region_compute_bounding_box_if_finite(region, s->dim, low, high)) return false;
    for (int b = 0; b < s->boundaries; b++) {
        const struct boundary *mirror = &s->boundary[b];
        const real near = ON_SURFACE * s->spacing;
        if (mirror->kind == BOUNDARY_MIRROR)
            beyond |= high[mirror->axis] < mirror->at + near || low[mirror->axis] > mirror->at - near;
    }
    return beyond;
}

/* Adds a warning to *to for each part of a body of scene s that holds no particle of p, since the part is outside the
 * body, too small or covered by a later part. (A part is a region of the body with a material of its own.) Parts beyond
 * planes of symmetry are meant to be empty and cause no warning. Does nothing if some particles are not created (p->n <
 * p->n_body), as in coarse cells. */
static void warn_of_empty_parts(const struct scene *s, const struct particles *p, struct warnings *to)
{
    for (int b = 0; b < s->bodies && p->n == p->n_body; b++) {
        const struct scene_body *body = &s->body[b];
        bool *held = NEW("engine.parts", body->parts, bool);
        for (int64_t i = 0; i < p->n && body->parts > 0; i++) {
            real X[DIM_MAX];
            if (p->body[i] != body->joined) continue;
            particle_reference_position(p, i, X);
            const int part = scene_body_part_index_at_position(s, body, X);
            if (part >= 0) held[part] = true;
        }
        for (int k = 0; k < body->parts; k++)
            if (!held[k] && !region_beyond_mirror(s, &body->part[k].region))
                warnings_add_if_new(
                    to,
                    "body %s: its part %d, of material %s, holds no particle, because it is outside the body, thinner "
                    "than the spacing, or covered by a later part: check its region and the unit (m if none is "
                    "written), or remove the part, because its material may shorten the time step",
                    body->name, k + 1, s->material[body->part[k].material].name);
        memory_free(held);
    }
}

/* Returns true if initial state number k of scene s applies to at least one particle of p, or is a pulse. */
static bool initial_is_met(const struct scene *s, const struct particles *p, int k)
{
    const struct scene_initial *initial = &s->initial[k];
    return initial->sets_pulse ||
           region_holds_particle(s, p, &initial->region, initial->body < 0 ? -1 : s->body[initial->body].joined);
}

/* Returns the distance of the plane of symmetry of boundary b from the nearest particle of p [m]; negative if the plane
 * cuts the body. */
static real mirror_distance(const struct particles *p, const struct boundary *b)
{
    real low, high;
    particles_coordinate_range(p, p->n, b->axis, &low, &high);
    return real_max(low - b->at, b->at - high);
}

/* Adds a warning to *to about the plane of symmetry `mirror` of scene s, with a gap of `distance` [m] to the nearest
 * particle of p, and says what acts across the gap: bonds to the mirror image, up to their length of `horizon` [m];
 * grid nodes on the plane, up to the size of a cell; contact with the image; or nothing. */
static void warn_of_mirror_beside(const struct scene *s, const struct particles *p, const struct boundary *mirror,
                                  real distance, real horizon, struct warnings *to)
{
    const bool bonds = s->method != METHOD_MPM && 2 * distance <= (1 + ON_SURFACE) * horizon;
    const real reach = p->n_free > 0 ? 1.5 * s->cell : s->cell + 0.5; /* of nodes of the grid, of the mesh */
    const bool nodes = s->method != METHOD_PD && distance < (reach - ON_SURFACE) * s->spacing;
    const bool meets = s->contact_between == CONTACT_ALL && scene_is_dynamic(s);
    const char *effect = bonds || nodes ? "holds the body too softly"
                         : meets        ? "acts on the body only by contact with the mirror image"
                                        : "has no effect";
    warnings_add_if_new(
        to,
        "boundary %s: its plane of symmetry %c = %.4g m is %.3g m from the nearest particle, but should be half a "
        "spacing (%.3g m) away, so it %s (%s); check its position and unit (m if none is written)",
        mirror->name, "xyz"[mirror->axis], mirror -> at, distance, 0.5 * s -> spacing, effect,
        particles_describe_bounding_box(p).text);
}

void run_warn_of_gaps_at_mirrors_and_empty_regions(const struct scene *s, const struct particles *p, real horizon,
                                                   struct warnings *warnings)
{
    for (int b = 0; b < s->boundaries && p->n > 0; b++) {
        const struct boundary *mirror = &s->boundary[b];
        const real distance = mirror->kind == BOUNDARY_MIRROR ? mirror_distance(p, mirror) : 0;
        if (distance > (BESIDE + 0.5 * s->irregularity) * s->spacing)
            warn_of_mirror_beside(s, p, mirror, distance, horizon, warnings);
    }
    for (int k = 0; k < s->initials; k++)
        if (!initial_is_met(s, p, k))
            warnings_add_if_new(warnings,
                                "initial[%d]: no particle is in its region, so it has no effect (%s); check the region "
                                "and its unit (m if none is written)",
                                k, particles_describe_bounding_box(p).text);
    warn_of_empty_parts(s, p, warnings);
    if (s->has_pd_region && !region_holds_particle(s, p, &s->pd_region, -1))
        warnings_add_if_new(warnings,
                            "pd.region contains no particle, so it has no effect (%s); check the region and its unit "
                            "(m if none is written)",
                            particles_describe_bounding_box(p).text);
}
