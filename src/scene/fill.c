/* Creates the particles of an input file (scene) from lattices and lists, with volumes, masses and initial state.
 *
 * The lattice of a body is placed by the bounding box of the first solid of its shape: with m = round(edge / spacing)
 * particles along an edge, lattice positions are centre + (k + 1/2 - m/2) spacing for every whole number k. A symmetric
 * solid is filled symmetrically about its centre to the last bit, and solids added later (a driven layer, for example)
 * continue the lattice of the first solid. A body whose first solid is unbounded has the lattice of the first body.
 *
 * Centre and spacing are rounded so that every coordinate is an exact floating-point number. Distances between
 * neighbours are then exactly equal throughout the body (struct stencil), and quantities computed from distances do not
 * depend on the position in the body. */
#include <math.h>
#include <string.h>

#include "data/cells.h"
#include "scene/fill.h"
#include "base/memory.h"
#include "base/team.h"
#include "fill_draft.h"

/* Least distance of two particles [spacings]. If two particles are closer, the scene is refused, because one particle
 * was probably given twice. */
static const real too_close = 1e-3;

enum { PARTICLES_MAX = INT32_MAX - 64 }; /* largest number of particles, since indices are 32-bit numbers */

static void draft_free(struct new_particles *created)
{
    for (int a = 0; a < DIM_MAX; a++) memory_free(created->X[a]);
    for (int a = 0; a < DIM_MAX; a++) memory_free(created->v[a]);
    memory_free(created->volume);
    memory_free(created->mass);
    memory_free(created->material);
    memory_free(created->body);
    memory_free(created->id);
}

static void draft_grow(struct new_particles *created)
{
    created->room = created->room > 0 ? 2 * created->room : 4096;
    for (int a = 0; a < created->scene->dim; a++) GROW("fill.X", created->X[a], created->room);
    for (int a = 0; a < created->scene->dim; a++) GROW("fill.v", created->v[a], created->room);
    GROW("fill.volume", created->volume, created->room);
    GROW("fill.mass", created->mass, created->room);
    GROW("fill.material", created->material, created->room);
    GROW("fill.body", created->body, created->room);
    GROW("fill.id", created->id, created->room);
}

status new_particles_append_particle(struct new_particles *created, const real *position, real volume,
                                     int material_number, int body_number)
{
    if (created->n + created->skipped >= PARTICLES_MAX)
        return new_particles_report_body_fault(
            created, body_number, "has more particles than the limit of 2147483583; use a larger particles.spacing");
    if (created->n == created->room) draft_grow(created);
    for (int a = 0; a < created->scene->dim; a++) created->X[a][created->n] = position[a];
    for (int a = 0; a < created->scene->dim; a++) created->v[a][created->n] = NAN;
    created->volume[created->n] = volume, created->mass[created->n] = NAN;
    created->material[created->n] = (uint8_t)material_number;
    created->body[created->n] = (uint8_t)body_number;
    created->id[created->n] = (int32_t)(created->n + created->skipped);
    created->n++;
    return OK;
}

/* ---- lattices ---------------------------------------------------------------------------------------------------- */

/* Positions of a lattice along one axis: centre + (k + 1/2 - m/2) spacing for k = first .. last, where half_count is
 * m/2. */
struct axis {
    real centre, half_count, spacing; /* centre [m]; m/2; spacing [m] */
    int64_t first, last;
};

static real axis_place(const struct axis *a, int64_t k)
{
    return a->centre + ((real)k + 0.5 - a->half_count) * a->spacing;
}

/* Rounds the centre and half the spacing of an axis of a lattice to multiples of a power of two, such that every
 * lattice position is an exact double within half of LATTICE_NEAR spacings of its nominal value. Leaves the axis
 * unchanged where no such power of two exists, as for a body of 10,000 spacings; its positions are then rounded
 * individually. */
static void axis_round(struct axis *a)
{
    const real ends =
        fabs(a->centre) + (fabs((real)a->first - a->half_count) + fabs((real)a->last - a->half_count) + 2) * a->spacing;
    const real unit = exp2(ceil(log2(ends)) - 53), half = nearbyint(0.5 * a->spacing / unit) * unit;
    const real farthest = 2 * real_max(fabs((real)a->first - a->half_count), fabs((real)a->last - a->half_count)) + 1;
    if (fabs(2 * half - a->spacing) * 0.5 * farthest > 0.5 * LATTICE_NEAR * a->spacing) return;
    a->centre = nearbyint(a->centre / unit) * unit;
    a->spacing = 2 * half;
}

/* Computes the corners low[dim], high[dim] of the bounding box of the first added solid of a shape [m]; if the shape
 * begins with an intersection of solids, of the whole shape. Returns false if the box is unbounded. */
static bool first_solid_box(const struct region *shape, int dim, real low[DIM_MAX], real high[DIM_MAX])
{
    if (shape->n > 0 && shape->solid[0].intersect) return region_compute_bounding_box_if_finite(shape, dim, low, high);
    for (int k = 0; k < shape->n; k++)
        if (!shape->solid[k].subtract)
            return region_compute_bounding_box_if_finite(&(struct region){.n = 1, .solid = &shape->solid[k]}, dim, low,
                                                         high);
    return false;
}

/* Returns a uniform random number in [-1/2, 1/2) that depends on its arguments alone: a hash of `seed` and the counter
 * id * DIM_MAX + component. id: index of the particle; component: axis of its position, 0 to DIM_MAX - 1. */
static real scatter(uint64_t seed, int64_t id, int component)
{
    return (real)(hash_add_word(seed, (uint64_t)id * DIM_MAX + (uint64_t)component) >> 11) * 0x1p-53 - 0.5;
}

static real cell_volume(const struct scene *s)
{
    return lattice_particle_volume(scene_cross_section_or_thickness(s), s->spacing, s->dim);
}

/* Computes the axes axis[dim] of the lattice that covers the whole shape of one body of created->scene. body: index of
 * the body. Returns REFUSED, with a message, if the shape or its first solid is unbounded, or if the lattice would have
 * more than 64 PARTICLES_MAX positions or one farther than FILL_FARTHEST spacings from its centre. */
static status lattice_axes(const struct new_particles *created, int body, struct axis axis[DIM_MAX])
{
    const struct scene *s = created->scene;
    real low[DIM_MAX], high[DIM_MAX], from[DIM_MAX], to[DIM_MAX], places = 1;
    if (!region_compute_bounding_box_if_finite(&s->body[body].shape, s->dim, from, to))
        return new_particles_report_body_fault(
            created, body, "has an infinite shape; build it from finite solids such as boxes, balls or cylinders");
    if (!first_solid_box(&s->body[body].shape, s->dim, low, high) &&
        !first_solid_box(&s->body[0].shape, s->dim, low, high))
        return new_particles_report_body_fault(created, body, "has an infinite first solid; begin with a finite one");
    for (int a = 0; a < s->dim; a++) {
        struct axis *x = &axis[a];
        x->centre = 0.5 * (low[a] + high[a]);
        x->half_count = 0.5 * round((high[a] - low[a]) / s->spacing);
        x->spacing = s->spacing;
        real first = floor((from[a] - x->centre) / s->spacing + x->half_count - 0.5);
        real last = ceil((to[a] - x->centre) / s->spacing + x->half_count - 0.5);
        places *= real_max(0, last - first + 1);
        if (!(places < 64.0 * PARTICLES_MAX && -first < FILL_FARTHEST && last < FILL_FARTHEST))
            return new_particles_report_body_fault(
                created, body,
                "is too large for particles.spacing; use a larger spacing, or check the "
                "units of both (m if none is written)");
        x->first = (int64_t)first, x->last = (int64_t)last;
        axis_round(x);
    }
    return OK;
}

/* Counts a particle that is inside a body but not created, because coarse cells replace it, in created->skipped.
 * place[dim]: its position [m], by which the bounding box created->low, created->high of these particles is extended.
 * Returns OK. */
static status place_skip(struct new_particles *created, const real *place)
{
    for (int a = 0; a < created->scene->dim; a++) {
        created->low[a] = created->skipped > 0 ? real_min(created->low[a], place[a]) : place[a];
        created->high[a] = created->skipped > 0 ? real_max(created->high[a], place[a]) : place[a];
    }
    created->skipped++;
    return OK;
}

/* Adds a particle to `created`, the list of particles to be created, if the lattice position place[dim] [m] is in the
 * shape of a body. A position in a coarse cell, whose particles are not created, is only counted. The position is
 * shifted at random by up to half of `particles.irregularity` spacings along each axis (Imachi et al. 2019, eq. 49).
 * body: index of the body; volume: volume of the particle [m^3]. Returns REFUSED, with a message, if there would be too
 * many particles. */
static status lattice_point(struct new_particles *created, int body, const real *place, real volume)
{
    const struct scene *s = created->scene;
    real X[DIM_MAX] = {0};
    if (cells_without_particles_contain(created->hollow, place)) return place_skip(created, place);
    if (!region_contains(&s->body[body].shape, place, s->dim, ON_SURFACE * s->spacing)) return OK;
    for (int a = 0; a < s->dim; a++)
        X[a] =
            place[a] + s->spacing * s->irregularity * scatter(s->seed, created->n, a); /* Imachi et al. 2019, eq. 49 */
    return new_particles_append_particle(
        created, X, volume, scene_material_index_at_position(s, &s->body[body], place, s->body[body].material), body);
}

/* Returns REFUSED, with a message, if the scene of `created` has no spacing at which to fill the body number `body`. */
static status check_spacing_given(const struct new_particles *created, int body)
{
    if (created->scene->spacing > 0) return OK;
    return new_particles_report_body_fault(
        created, body, "particles.spacing is missing: a shape is filled with particles at this distance; add it");
}

/* Adds the particles of the lattice in the shape of a body to `created`, the list of particles to be created, with x
 * varying fastest. body: index of the body. Returns REFUSED, with a message, if the input file (scene) has no spacing
 * or the shape does not fit it. */
static status fill_lattice(struct new_particles *created, int body)
{
    real volume = cell_volume(created->scene), place[DIM_MAX];
    struct axis axis[DIM_MAX] = {{0}}; /* unused directions have the one position 0 */
    TRY(check_spacing_given(created, body));
    TRY(lattice_axes(created, body, axis));
    for (int64_t k = axis[2].first; k <= axis[2].last; k++)
        for (int64_t j = axis[1].first; j <= axis[1].last; j++)
            for (int64_t i = axis[0].first; i <= axis[0].last; i++) {
                const int64_t at[DIM_MAX] = {i, j, k};
                for (int a = 0; a < DIM_MAX; a++) place[a] = axis_place(&axis[a], at[a]);
                TRY(lattice_point(created, body, place, volume));
            }
    return OK;
}

status body_lattice_compute_first_site_position(const struct scene *s, int body, real *X)
{
    const struct new_particles d = {.scene = s};
    struct axis axis[DIM_MAX] = {{0}};
    TRY(check_spacing_given(&d, body));
    TRY(lattice_axes(&d, body, axis));
    for (int a = 0; a < s->dim; a++) X[a] = axis_place(&axis[a], axis[a].first);
    return OK;
}

/* ---- all ------------------------------------------------------------------------------------------------------- */

/* Collects the particles of all bodies of created->scene in `created`, the list of particles to be created: from
 * particle lists, or from lattices in the shapes. Returns REFUSED, with a message, for a body without particles or with
 * an invalid list or shape. */
static status draft_make(struct new_particles *created)
{
    for (int body = 0; body < created->scene->bodies; body++) {
        const bool listed = created->scene->body[body].file != NULL;
        int64_t before = created->n;
        TRY(listed ? new_particles_append_body_from_file(created, body) : fill_lattice(created, body));
        if (created->n == before && created->skipped == 0)
            return new_particles_report_empty_body(created, body, listed);
    }
    return OK;
}

/* ---- particles --------------------------------------------------------------------------------------------------- */

/* Returns volume[i], the volume of particle i [m^3], as a term of reproducible_sum. volume: array of reals. */
static real volume_term(const void *volume, int64_t i) { return ((const real *)volume)[i]; }

/* Returns the spacing of the scene of `created` [m]. If the scene has none because all particles come from lists,
 * returns the edge of a square or cube of the mean particle volume. */
static real spacing_of(const struct new_particles *created)
{
    const struct scene *s = created->scene;
    if (s->spacing > 0) return s->spacing;
    return pow(reproducible_sum(created->n, volume_term, created->volume) /
                   ((real)created->n * scene_cross_section_or_thickness(s)),
               1.0 / s->dim);
}

/* Creates the particles p from `created`, the list of particles to be created. A velocity that is NAN in `created`
 * becomes that of the body, a mass that is NAN follows from the density of the material. The method of the scene
 * determines the kind of the particles (peridynamic or material points). optional: optional arrays to create
 * (WITH_*). */
static void take_draft(struct particles *p, const struct new_particles *created, int optional)
{
    const struct scene *s = created->scene;
    particles_make(p, s->dim, created->n, optional);
    p->plane_strain = s->space == SPACE_PLANE_STRAIN ? s->material : NULL;
#pragma omp parallel for schedule(static)
    for (int64_t i = 0; i < created->n; i++) {
        for (int a = 0; a < s->dim; a++) {
            p->X[a][i] = p->x[a][i] = created->X[a][i];
            p->v[a][i] = isnan(created->v[a][i]) ? s->body[created->body[i]].velocity[a] : created->v[a][i];
            if (optional & WITH_STRETCH) p->stretch[a][i] = 1;
            if (optional & WITH_ROTATIONS && s->dim == 3) p->end_rotation[ROTATION - 1][i] = 1;
        }
        p->volume0[i] = p->volume[i] = created->volume[i];
        p->material[i] = created->material[i];
        p->body[i] = created->body[i];
        p->mass[i] = isnan(created->mass[i]) ? s->material[p->material[i]].density * p->volume0[i] : created->mass[i];
        p->kind[i] = s->method == METHOD_PD ? KIND_PD : KIND_MPM;
        p->id[i] = created->id[i];
    }
}

/* Sets p->n_body to the number of particles of `created` including those left out because coarse cells replace them
 * (created->skipped). If there are any, sets p->low, p->high to the bounding box of all of them [m]. */
static void take_skipped(struct particles *p, const struct new_particles *created)
{
    for (int a = 0; a < p->dim && created->skipped > 0; a++) {
        particles_coordinate_range(p, p->n, a, &p->low[a], &p->high[a]);
        p->low[a] = real_min(p->low[a], created->low[a]), p->high[a] = real_max(p->high[a], created->high[a]);
    }
    p->n_body = p->n + created->skipped;
}

/* Returns REFUSED, with a message, if a particle of p is farther than FILL_FARTHEST spacings from the origin or its
 * mass is not a positive finite number. created: list from which p was created, for the name of the body in the
 * message; spacing: distance of particles [m]. */
static status check_values(const struct particles *p, const struct new_particles *created, real spacing)
{
    for (int64_t i = 0; i < p->n; i++) {
        bool good = isfinite(p->mass[i]) && p->mass[i] > 0 && isfinite(spacing);
        for (int a = 0; a < p->dim; a++) good = good && fabs(p->X[a][i]) <= FILL_FARTHEST * spacing;
        if (!good)
            return new_particles_report_body_fault(
                created, p->body[i],
                "a particle is beyond 1e7 spacings from the origin, where double precision no longer resolves strains, "
                "or has no finite mass; give positions and spacing in the same unit, and move the body to the origin");
    }
    return OK;
}

/* Returns REFUSED if the initial state (`initial` of the scene) moves a particle farther than FILL_FARTHEST spacings
 * from the origin, makes its volume 0 or negative, or gives it a velocity or stress that is not finite. created: list
 * from which p was created, for the name of the body in the message; spacing: distance of particles [m]. */
static status check_start(const struct particles *p, const struct new_particles *created, real spacing)
{
    for (int64_t i = 0; i < p->n; i++) {
        real sum = p->volume[i];
        bool good = p->volume[i] > 0;
        for (int a = 0; a < p->dim; a++) good = good && fabs(p->x[a][i]) <= FILL_FARTHEST * spacing;
        for (int a = 0; a < p->dim; a++) sum += p->v[a][i];
        for (int k = 0; k < symmetric_tensor_component_count(p->dim); k++) sum += p->stress[k][i];
        if (!good || !isfinite(sum))
            return new_particles_report_body_fault(
                created, p->body[i],
                "`initial` moves a particle beyond 1e7 spacings from the origin, turns it inside out, or gives it a "
                "speed or stress that is not a number; check its values (strains near 1e-3 are usual)");
    }
    return OK;
}

/* Returns REFUSED if two particles are closer than too_close spacings. The message names the pair with the smallest
 * index of its first particle, so that it does not depend on the number of threads. created: list from which p was
 * created, for the name of the body in the message; spacing: distance of particles [m]. */
static status check_distances(const struct particles *p, const struct new_particles *created, real spacing)
{
    struct cells cells;
    int64_t first = p->n;
    int32_t other = -1;
    real X[DIM_MAX] = {0};
    cells_make_for_neighbour_search(&cells, p, 3 * spacing); /* cells have a third of this edge: one particle each */
#pragma omp parallel for schedule(static) reduction(min : first)
    for (int64_t i = 0; i < p->n; i++) {
        real here[DIM_MAX];
        int32_t found;
        particle_reference_position(p, i, here);
        if (cells_list_particles_near_point(&cells, p, here, too_close * spacing, (int32_t)i, &found, 1) > 0 &&
            i < first)
            first = i;
    }
    if (first < p->n) {
        particle_reference_position(p, first, X);
        cells_list_particles_near_point(&cells, p, X, too_close * spacing, (int32_t)first, &other, 1);
    }
    cells_free(&cells);
    if (first == p->n) return OK;
    const struct scene_body *one = &created->scene->body[p->body[first]], *two = &created->scene->body[p->body[other]];
    if (one == two)
        status_set(REFUSED, "body %s has two particles at (%.6g, %.6g, %.6g) m: remove one of the two from its list",
                   one->name, X[0], X[1], X[2]);
    else
        status_set(REFUSED, "bodies %s and %s both have a particle at (%.6g, %.6g, %.6g) m: move one body, or cut it",
                   one->name, two->name, X[0], X[1], X[2]);
    return status_message_prepend_location((one > two ? one : two)->place, REFUSED);
}

/* Creates the particles p from `created`, the list of particles to be created, applies the initial states, checks
 * values and distances, and sorts the particles. Joined bodies become one. optional: optional arrays to create
 * (WITH_*). Returns REFUSED, with a message, for invalid values, lists or positions. */
static status fill_made(struct particles *p, const struct new_particles *created, int optional)
{
    const struct scene *s = created->scene;
    real spacing = spacing_of(created);
    TRY(initial_states_check_no_body_inverts(s));
    take_draft(p, created, optional);
    particles_set_strength_factors(p, s);
    particles_set_initial_temperatures(p, s);
    take_skipped(p, created);
    TRY(check_values(p, created, spacing));
    TRY(particle_lists_check_distances_fit_spacing(p, s));
    initial_states_apply_to_particles(p, s, spacing);
    TRY(check_start(p, created, spacing));
    particles_sort_by_lattice_rows(p, spacing, optional);
    TRY(check_distances(p, created, spacing));
    for (int64_t i = 0; i < p->n; i++) p->body[i] = (uint8_t)s->body[p->body[i]].joined; /* joined bodies become one */
    return OK;
}

status bodies_fill_with_particles(struct particles *p, const struct scene *s,
                                  const struct cells_without_particles *empty_cells, int optional_arrays)
{
    struct new_particles draft = {.scene = s, .hollow = empty_cells};
    *p = (struct particles){0};
    status result = s->bodies > 0
                        ? draft_make(&draft)
                        : status_set(REFUSED, "the scene has no body; add the key body or bodies: %s", s->name);
    if (result == OK) result = fill_made(p, &draft, optional_arrays);
    if (result != OK) particles_free(p);
    draft_free(&draft);
    return result;
}
