/* Selects the particles on which a boundary condition acts, and computes their shares: the area, volume or mass of each
 * particle by which the value of the boundary condition is multiplied. */
#include <math.h>

#include "loads/loads.h"
#include "base/memory.h"
#include "data/extent.h"

/* Returns true if the reference position of particle i of p is in the region of boundary b, up to LOADS_TOLERANCE
 * spacings outside it, and the particle belongs to the body of b, if b is restricted to a body (b->body >= 0). spacing:
 * lattice spacing [m]. */
static bool selects(const struct boundary *b, const struct particles *p, int64_t i, real spacing)
{
    real X[DIM_MAX];
    particle_reference_position(p, i, X);
    if (b->body >= 0 && p->body[i] != b->body) return false;
    return region_contains(&b->region, X, p->dim, LOADS_TOLERANCE * spacing);
}

/* Returns true if the value of boundary b has a non-zero component tangential to its face, among dim components. */
static bool has_tangential(const struct boundary *b, int dim)
{
    bool found = false;
    for (int d = 0; d < dim; d++) found = found || (d != b->face && b->value[d] != 0);
    return found;
}

/* ---- shares ------------------------------------------------------------------------------------------------------ */

/* Returns the dimensionless factor of profile f at the reference position of particle i of p: 1 if the profile is
 * uniform, else a sine along a direction. */
static real profile_at(const struct profile *f, const struct particles *p, int64_t i)
{
    real X[DIM_MAX], along = 0;
    if (f->kind == PROFILE_UNIFORM) return 1;
    particle_reference_position(p, i, X);
    for (int d = 0; d < p->dim; d++) along += (X[d] - f->origin[d]) * f->direction[d];
    return sin(2 * M_PI * along / (sqrt(dot(f->direction, f->direction, p->dim)) * f->wavelength));
}

/* Computes the shares of a body force l, the factors of its value: volume [m^3] of each of its particles (indices in
 * p), or for gravity the mass [kg], times the spatial profile of the boundary at the particle. */
static void body_shares(struct load *l, const struct particles *p)
{
#pragma omp parallel for schedule(static)
    for (int64_t k = 0; k < l->n; k++)
        l->share[0][k] = (l->boundary->by_mass ? p->mass : p->volume0)[l->particle[k]] *
                         profile_at(&l->boundary->profile, p, l->particle[k]);
}

/* Allocates the shares of load l, a number per particle and component by which its value is multiplied: [l->n] for each
 * of dim components. A body force has one array for all components. */
static void shares_allocate(struct load *l, int dim)
{
    const bool alike = l->boundary->kind == BOUNDARY_BODY_FORCE;
    for (int d = 0; d < dim; d++) l->share[d] = d > 0 && alike ? l->share[0] : NEW("loads.share", l->n, real);
}

/* Returns true if boundary b acts on the exposed face of a body: a traction, an absorbing boundary, or a prescribed
 * velocity with a face. */
static bool needs_face(const struct boundary *b)
{
    return b->kind == BOUNDARY_TRACTION || b->kind == BOUNDARY_ABSORBING ||
           (b->kind == BOUNDARY_VELOCITY && b->side != 0);
}

void load_set_particle_list_from_selected_flags(struct load *l, const uint8_t *selected, struct particles *p)
{
    for (int64_t i = 0; i < p->n; i++) l->n += selected[i] > 0;
    l->particle = NEW("loads.particle", l->n, int32_t);
    for (int64_t i = 0, k = 0; i < p->n; i++) {
        if (!selected[i]) continue;
        l->particle[k++] = (int32_t)i;
        if (l->boundary->kind == BOUNDARY_VELOCITY) p->flag[i] |= FLAG_DRIVEN;
    }
    if (boundary_applies_force(l->boundary)) shares_allocate(l, p->dim);
}

/* Sets the particles on which the traction l acts to those of p on the exposed face of the body, and the factors
 * l->share of its components to their areas [m^2]. The area for tangential components differs from that for the normal
 * one, so that the traction has the right moment. selected[p->n]: 1 for particles in the region of l; spacing: lattice
 * spacing [m]. */
static void select_face(struct load *l, const uint8_t *selected, struct particles *p, real spacing)
{
    struct exposed_face face;
    uint8_t *chosen = NEW("loads.chosen", p->n, uint8_t);
    exposed_face_compute_particle_areas(&face, l->boundary, p, selected, spacing, has_tangential(l->boundary, p->dim));
    for (int64_t i = 0; i < p->n; i++) chosen[i] = face.normal[i] != 0 || face.along[i] != 0;
    load_set_particle_list_from_selected_flags(l, chosen, p);
    for (int64_t k = 0; k < l->n; k++)
        for (int d = 0; d < p->dim; d++)
            l->share[d][k] = (d == l->boundary->face ? face.normal : face.along)[l->particle[k]];
    memory_free(chosen);
    exposed_face_free(&face);
}

/* Sets the particles of the absorbing boundary l to those of p in the exposed layer of the body and in the layer behind
 * it. Stores two areas of each particle [m^2]: l->outer, which is 0 in the second layer, and l->edge, with which a sum
 * over both layers extrapolates linearly to the face. selected[p->n]: 1 for particles in the region of l; spacing:
 * lattice spacing [m]. */
static void select_absorbing(struct load *l, const uint8_t *selected, struct particles *p, real spacing)
{
    struct exposed_face face;
    uint8_t *chosen = NEW("loads.chosen", p->n, uint8_t);
    exposed_face_compute_particle_areas(&face, l->boundary, p, selected, spacing, true);
    for (int64_t i = 0; i < p->n; i++) chosen[i] = face.along[i] != 0;
    load_set_particle_list_from_selected_flags(l, chosen, p);
    l->outer = NEW("loads.outer", l->n, real), l->edge = NEW("loads.edge", l->n, real);
    for (int64_t k = 0; k < l->n; k++)
        l->outer[k] = face.normal[l->particle[k]], l->edge[k] = face.along[l->particle[k]];
    memory_free(chosen);
    exposed_face_free(&face);
}

/* Sets the particles of load l, which prescribes motion, to those of p in a layer of depth boundary->depth behind its
 * face. selected[p->n]: 1 for particles in the region of the load; spacing: lattice spacing [m]. */
static void select_layer(struct load *l, const uint8_t *selected, struct particles *p, real spacing)
{
    uint8_t *taken = NEW("loads.layer", p->n, uint8_t);
    boundary_face_flag_particles_within_depth(l->boundary, p, selected, spacing, taken);
    load_set_particle_list_from_selected_flags(l, taken, p);
    memory_free(taken);
}

bool boundary_select_particles_in_region(const struct boundary *b, const struct particles *p, real spacing,
                                         uint8_t *selected)
{
    bool any = false;
    for (int64_t i = 0; i < p->n; i++) {
        selected[i] = selects(b, p, i, spacing);
        any = any || selected[i];
    }
    return any;
}

/* Returns true if particle i of p is in the plane of the clamped mirror b, to within LOADS_TOLERANCE spacings, and in
 * the body of b (any body if b->body < 0). Such a particle is its own image and stays at rest. spacing: lattice spacing
 * [m]. */
static bool is_in_plane(const struct boundary *b, const struct particles *p, int64_t i, real spacing)
{
    return (b->body < 0 || p->body[i] == b->body) && fabs(p->X[b->axis][i] - b->at) <= LOADS_TOLERANCE * spacing;
}

status load_find_particles_of_boundary(struct load *l, const struct boundary *b, struct particles *p, real spacing)
{
    const bool clamp = boundary_is_mirror_without_tangential_motion(b, p->dim);
    bool any = false;
    l->boundary = b;
    if ((b->kind == BOUNDARY_MIRROR && !clamp) || b->kind == BOUNDARY_PRESSURE) return OK;
    uint8_t *selected = NEW("loads.selected", p->n, uint8_t);
    for (int64_t i = 0; i < p->n; i++) {
        selected[i] = clamp ? is_in_plane(b, p, i, spacing) : selects(b, p, i, spacing);
        any = any || selected[i];
    }
    if (b->kind == BOUNDARY_TRACTION)
        select_face(l, selected, p, spacing);
    else if (b->kind == BOUNDARY_ABSORBING)
        select_absorbing(l, selected, p, spacing);
    else if (needs_face(b))
        select_layer(l, selected, p, spacing);
    else
        load_set_particle_list_from_selected_flags(l, selected, p);
    if (b->kind == BOUNDARY_BODY_FORCE) body_shares(l, p);
    memory_free(selected);
    if (!any && (boundary_applies_force(b) || needs_face(b)))
        return status_set(
            REFUSED,
            "boundary %s: no particle is in its region (%s); check the region and its unit (m if none is written)",
            b->name, particles_describe_bounding_box(p).text);
    if (l->n > 0 || !needs_face(b)) return OK;
    return status_set(REFUSED,
                      "boundary %s: seen from %c%c, other particles of the body are in front of every particle in its "
                      "region; choose a region that contains the outer face there, or the wall of a hole",
                      b->name, 'x' + b->face, b->side > 0 ? '+' : '-');
}
