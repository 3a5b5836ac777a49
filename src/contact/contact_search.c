/* Searches for pairs of particles that may come into contact: lists the exposed particles (those near faces), then
 * finds the neighbours of each at the present positions. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "contact_internal.h"

#define RISE_MOST 0.6      /* range of the search for the surface above a particle [spacings] */
#define ROUND_OFF 1e-6     /* heights of a surface below this are 0 [spacings] */
enum { BREAKS_WAIT = 32 }; /* steps between a broken bond and a search: faces open before they can close */

/* ---- exposed particles ------------------------------------------------------------------------------------------- */

/* Returns the fraction of a full neighbourhood f below which the volume of the bonded neighbours of a particle shows
 * that the particle is in the first layer at a face [1]. In bodies with horizons of 2 to 3 spacings the volume is 0.50
 * (1D) to 0.67 (2D) of the full one in the first layer and 0.79 or more in the second. With bonds to nearest neighbours
 * alone it is up to 5/6 in the first layer and 1 in the second. */
static real first_layer_share(const struct family *f)
{
    return f->horizon < 1.5 * f->spacing ? 0.95 : space_dim(f->space) == 1 ? 0.6 : 0.78;
}

/* Returns true if the volume of the bonded neighbours of a particle minus `lost` [m^3] is less than `least` [m^3]. row:
 * row of the particle in the bonds b (its list of bonds), or -1 for a particle without bonds, for which the result is
 * true. */
static bool lacks_family(const struct bonds *b, int64_t row, real lost, real least)
{
    return row < 0 || b->family_volume[row] - lost < least;
}

/* Returns true if particle i of p is peridynamic and near a face: if it has damage, or its bonded neighbours in b have
 * less volume than least_volume [m^3]. everywhere: true to accept every peridynamic particle. */
static bool is_exposed(const struct particles *p, const struct bonds *b, real least_volume, bool everywhere, int64_t i)
{
    const int64_t row = b->row_of[i];
    if (p->kind[i] != KIND_PD) return false;
    return everywhere || p->damage[i] > 0 || lacks_family(b, row, 0, least_volume);
}

int64_t contact_list_index_of_particle(const struct contact *c, int64_t particle)
{
    int64_t low = 0, high = c->rows;
    while (low < high) {
        const int64_t middle = (low + high) / 2;
        if (c->particle[middle] < particle)
            low = middle + 1;
        else
            high = middle;
    }
    return low < c->rows && c->particle[low] == particle ? low : -1;
}

real contact_width_of_widest_notch_between_particles(const struct contact *c, const struct particles *p, int64_t k,
                                                     int64_t l)
{
    const int32_t i = c->particle[k], j = c->particle[l];
    real widest = 0, a[DIM_MAX], b[DIM_MAX];
    if (p->body[i] != p->body[j]) return 0;
    particle_reference_position(p, i, a);
    particle_reference_position(p, j, b);
    for (int n = 0; n < c->law.cracks; n++) {
        const struct crack *notch = &c->law.crack[n];
        if (notch->width > widest && crack_cuts_bond(notch, a, b, p->dim)) widest = notch->width;
    }
    return widest;
}

/* Returns the spacing of particle i of p, the edge of a square or cube with the volume of the particle [m]. It is
 * law->spacing exactly if the volume is that of a lattice particle up to round-off. */
static real contact_spacing(const struct contact_law *law, const struct particles *p, int64_t i)
{
    const real full = lattice_particle_volume(law->section, law->spacing, p->dim), share = p->volume0[i] / full;
    if (fabs(share - 1) < 1e-6) return law->spacing;
    return law->spacing * pow(share, 1.0 / p->dim);
}

/* Returns the rise at particle i of p: the height of the surface of the body's shape (law->shape) above the particle,
 * minus 1/2 [spacings], at least -RISE_MOST. It is 0 on a lattice that fits the shape. It is set to 0 for bodies
 * without a shape, and if it exceeds RISE_MOST, since such particles are deep inside the shape, at faces of cracks.
 * size: spacing of the particle [m]. */
static real contact_rise(const struct contact_law *law, const struct particles *p, int64_t i, real size)
{
    const struct region *shape = law->shape[p->body[i]];
    real X[DIM_MAX] = {0}, normal[DIM_MAX];
    if (!shape || shape->n == 0) return 0;
    for (int d = 0; d < p->dim; d++) X[d] = p->X[d][i];
    const real rise = -region_signed_distance(shape, X, p->dim, normal) / size - 0.5;
    return fabs(rise) < ROUND_OFF || rise > RISE_MOST ? 0 : real_max(rise, -RISE_MOST);
}

void contact_list_set_spacings_and_surface_heights(struct contact *c, const struct particles *p)
{
    memory_free(c->root);
    memory_free(c->size);
    memory_free(c->rise);
    c->rise = BARE("contact.rise", c->n, real);
    c->root = BARE("contact.root", c->n, int32_t);
    c->size = BARE("contact.size", c->n, real);
#pragma omp parallel for schedule(static)
    for (int64_t k = 0; k < c->n; k++) {
        c->size[k] = contact_spacing(&c->law, p, c->particle[k]);
        c->rise[k] =
            contact_rise(&c->law, p, mirror_image_source_particle(p, c->law.image, c->particle[k]), c->size[k]);
        c->root[k] = (int32_t)(k < c->rows ? k
                                           : contact_list_index_of_particle(
                                                 c, mirror_image_source_particle(p, c->law.image, c->particle[k])));
    }
}

/* Lists in c->particle the peridynamic particles of p near a face, in ascending order, and then their mirror images.
 * Stores the present positions of all of them in c->at. A particle is near a face if it has damage, or if the volume of
 * its bonded neighbours in b is less than a share (first_layer_share) of that of the complete neighbourhood f. With the
 * contact distance of LAMMPS, all peridynamic particles are listed. */
static void list_exposed(struct contact *c, const struct particles *p, const struct bonds *b, const struct family *f)
{
    const real least_volume = first_layer_share(f) * f->full;
    const bool everywhere = c->law.distance == DISTANCE_LAMMPS;
    int64_t most = p->n_of[KIND_PD];
    for (int64_t i = p->n; i < p->n_all; i++) most += p->kind[i] == KIND_PD;
    memory_free(c->particle);
    c->particle = BARE("contact.particle", most, int32_t);
    c->n = 0;
    for (int64_t k = 0; k < p->n_of[KIND_PD]; k++)
        if (is_exposed(p, b, least_volume, everywhere, p->list[KIND_PD][k])) c->particle[c->n++] = p->list[KIND_PD][k];
    c->rows = c->n;
    for (int64_t i = p->n; i < p->n_all; i++)
        if (p->kind[i] == KIND_PD &&
            is_exposed(p, b, least_volume, everywhere, mirror_image_source_particle(p, c->law.image, i)))
            c->particle[c->n++] = (int32_t)i;
    for (int d = 0; d < p->dim; d++) {
        memory_free(c->at[d]);
        c->at[d] = BARE("contact.at", c->n, real);
        for (int64_t k = 0; k < c->n; k++) c->at[d][k] = p->x[d][c->particle[k]];
    }
    contact_list_set_spacings_and_surface_heights(c, p);
}

/* ---- pairs ------------------------------------------------------------------------------------------------------- */

/* Inputs of the search for pairs of particles that may come into contact; exists during one search. */
struct contact_search {
    const struct contact_law *law;
    const struct particles *p;
    const struct bonds *b;
    struct particles places; /* the listed particles, with their present positions as X */
    struct cells cells;      /* neighbour search over these positions */
    const int32_t *particle; /* indices of the listed particles in p */
    real reach;              /* range of the search [m] */
};

/* Pairs that one thread has found for consecutive rows of the contact list (a row: one particle and those that it may
 * touch). other[n]: list entry of the second particle of each pair. */
struct pair_list {
    int64_t n;
    int32_t *other;
};

static void pair_add(struct pair_list *to, int32_t other)
{
    GROW("contact.found", to->other, to->n + 1);
    to->other[to->n++] = other;
}

/* Finds the particles that may come into contact with the particle of entry k of the contact list, and appends the
 * numbers of their entries to *to. They are within the search radius s->reach. If contact is between bodies only,
 * particles of the same body do not count; with the contact distance of one spacing, bonded particles do not count.
 * near: working memory; marks: one bit per particle, all 0 before and after. */
static void row_pairs(const struct contact_search *s, struct neighbour_list *near, uint64_t *marks, int64_t k,
                      struct pair_list *to)
{
    const struct particles *p = s->p;
    const int32_t i = s->particle[k];
    if (s->law->between == CONTACT_NONE) return;
    particles_list_neighbours_within_radius(near, &s->cells, &s->places, k, s->reach, false);
    if (near->n == 0) return;
    for (int q = 0; q < near->n; q++) bit_set(marks, s->particle[near->at[q]]);
    if (s->law->distance == DISTANCE_SPACING) bonds_row_clear_bitmap_at_intact_neighbours(s->b, s->b->row_of[i], marks);
    for (int q = 0; q < near->n; q++) {
        const int32_t j = s->particle[near->at[q]];
        if (!bit_is_set(marks, j)) continue;
        bit_clear(marks, j);
        if (s->law->between != CONTACT_BODIES || p->body[i] != p->body[j]) pair_add(to, near->at[q]);
    }
}

/* Converts c->first[row + 1], for all rows of the contact list c, from the number of pairs of row `row` to the index in
 * c->other behind the last of these pairs, and allocates c->other. */
static void pairs_room(struct contact *c)
{
    for (int64_t k = 0; k < c->rows; k++) c->first[k + 1] += c->first[k];
    c->pairs = c->first[c->rows];
    c->other = BARE("contact.other", c->pairs, int32_t);
}

/* Finds the pairs of all rows of the contact list c (particles that may come into contact) and stores them in c->other,
 * row by row. Each thread first collects the pairs of its own rows, because their final positions in c->other depend on
 * the numbers of pairs of earlier rows. s: input of the search. */
static void pairs_find(struct contact *c, const struct contact_search *s)
{
    c->first = NEW("contact.first", c->rows + 1, int64_t);
#pragma omp parallel
    {
        struct neighbour_list near = {0};
        struct pair_list own = {0};
        uint64_t *marks = NEW("contact.marks", s->p->n_all / 64 + 1, uint64_t);
        int64_t put = 0;
#pragma omp for schedule(static)
        for (int64_t k = 0; k < c->rows; k++) {
            const int64_t before = own.n;
            row_pairs(s, &near, marks, k, &own);
            c->first[k + 1] = own.n - before;
        }
#pragma omp single
        pairs_room(c);
#pragma omp for schedule(static)
        for (int64_t k = 0; k < c->rows; k++) {
            const int64_t n = c->first[k + 1] - c->first[k];
            array_copy(c->other + c->first[k], own.other + put, n, sizeof *own.other);
            put += n;
        }
        memory_free(near.at);
        memory_free(own.other);
        memory_free(marks);
    }
}

/* Returns the distance at which contact of a pair of particles began, according to the contact list before the present
 * search, `before` [m]. row: row of the first particle in that list, -1 if it has none; j: index of the second
 * particle. Returns NAN if that list does not contain the pair. */
static real distance_before(const struct contact *before, int64_t row, int32_t j)
{
    if (row < 0) return NAN;
    for (int64_t q = before->first[row]; q < before->first[row + 1]; q++)
        if (before->particle[before->other[q]] == j) return before->distance[q];
    return NAN;
}

/* After the pairs have been found, determines where contact begins: for each row of the contact list c a height above
 * the face (form `surface`), or for each pair a distance (form `pair`). before: contact before the present search,
 * whose contacts continue; p: particles at their present positions. */
static void pairs_begin(struct contact *c, const struct contact *before, const struct particles *p)
{
    if (c->law.form == CONTACT_SURFACE) {
        c->face = BARE("contact.face", c->rows, struct contact_face);
        c->balance = BARE("contact.balance", c->rows, struct contact_leapfrog_error_account);
    } else
        c->distance = BARE("contact.distance", c->pairs, real);
#pragma omp parallel for schedule(static)
    for (int64_t row = 0; row < c->rows; row++) {
        const int64_t was = before->made ? contact_list_index_of_particle(before, c->particle[row]) : -1;
        if (c->law.form == CONTACT_SURFACE)
            contact_face_set_height_where_contact_begins(c, before, was, p, row);
        else
            for (int64_t q = c->first[row]; q < c->first[row + 1]; q++)
                c->distance[q] = contact_pair_onset_distance(c, p, row, c->other[q],
                                                             distance_before(before, was, c->particle[c->other[q]]));
    }
}

/* Returns the distance within which a search must find pairs [m]: the largest distance of two particles of the contact
 * list c that can come into contact before the next search. */
static real search_reach(const struct contact *c)
{
    real most = 0;
    for (int64_t k = 0; k < c->n; k++) most = real_max(most, c->size[k]);
    const real pairs = c->law.distance == DISTANCE_LAMMPS ? FAR_LAMMPS : 1;
    return most * (c->law.form == CONTACT_SURFACE ? CONTACT_REACH : pairs) + contact_pair_list_margin(c);
}

/* Finds the exposed particles (those near faces) and the pairs that may come into contact at the present positions of
 * p. Copies the state of pairs, friction springs and contacts with rigid bodies from the previous list in c, and frees
 * that list. b, f: bonds and their complete neighbourhood, by which exposed particles are recognised. */
static void search_pairs(struct contact *c, const struct particles *p, const struct bonds *b, const struct family *f)
{
    struct contact before = *c;
    c->particle = NULL, c->root = NULL, c->size = NULL, c->rise = NULL;
    c->first = NULL, c->other = NULL, c->distance = NULL;
    c->face = NULL, c->spring = NULL, c->reaction = NULL, c->near = NULL, c->followed = NULL, c->balance = NULL;
    c->touch = NULL;
    for (int d = 0; d < DIM_MAX; d++) c->at[d] = NULL;
    list_exposed(c, p, b, f);
    struct contact_search s = {&c->law, p, b, {.n = c->n, .n_all = c->n, .dim = p->dim}, {0}, c->particle, 0};
    for (int d = 0; d < p->dim; d++) s.places.X[d] = c->at[d];
    s.reach = search_reach(c);
    if (c->n > 0) cells_make_for_neighbour_search(&s.cells, &s.places, s.reach);
    pairs_find(c, &s);
    if (c->n > 0) cells_free(&s.cells);
    pairs_begin(c, &before, p);
    contact_friction_springs_copy_from_previous(c, &before);
    contact_rigid_list_nearby_particles(c, &before, p, contact_pair_list_margin(c));
    contact_friction_work_carry_over_to_new_list(c, &before);
    before.law.stiffness = NULL; /* the new list keeps the law and the recorded forces */
    memset(before.push, 0, sizeof before.push);
    contact_free(&before);
}

/* ---- times of checks --------------------------------------------------------------------------------------------- */

/* Returns the largest displacement of a particle of p in the contact list c since the last search [m]; INFINITY if a
 * position is not finite. */
static real largest_displacement(const struct contact *c, const struct particles *p)
{
    real far2 = 0;
#pragma omp parallel for schedule(static) reduction(max : far2)
    for (int64_t k = 0; k < c->rows; k++) {
        real way2 = 0;
        for (int d = 0; d < p->dim; d++) way2 += square(p->x[d][c->particle[k]] - c->at[d][k]);
        far2 = way2 >= 0 ? real_max(far2, way2) : INFINITY;
    }
    return sqrt(far2);
}

/* Returns true if the contact list c may lack pairs that come into contact, because a particle of the list or a rigid
 * body has moved by half the margin of the list or more since the last search. Uses c->moved, the largest displacement
 * of a particle. */
static bool has_come_far(const struct contact *c)
{
    const real far = 0.5 * contact_pair_list_margin(c);
    return !(c->moved < far) || rigid_bodies_moved_since_last_contact_search(c, far);
}

/* Requests a contact search before the next step (c->due) if one of particle_count particles, which have just become
 * peridynamic, is in the first layer at a face. particle_list: their indices; b, family: bonds and their complete
 * neighbourhood, by which such particles are recognised. A particle elsewhere with a few broken bonds does not require
 * a search at once; the next search lists it. With the contact distance of LAMMPS, any particle requests a search. */
void contact_request_search_if_particles_at_surface(struct contact *c, const struct bonds *b,
                                                    const struct family *family, const int32_t *particle_list,
                                                    int64_t particle_count)
{
    const real least_volume = first_layer_share(family) * family->full;
    if (!contact_is_enabled(c)) return;
    for (int64_t k = 0; k < particle_count && !c->due; k++) {
        const int64_t row = b->row_of[particle_list[k]];
        c->due = c->law.distance == DISTANCE_LAMMPS ||
                 lacks_family(b, row, row < 0 ? 0 : b->broken_volume[row], least_volume);
    }
}

bool contact_search_is_needed(struct contact *c, const struct particles *p)
{
    if (c->made) c->moved = largest_displacement(c, p);
    return !c->made || has_come_far(c);
}

void contact_update_pair_list_if_outdated(struct contact *c, const struct particles *p, struct bonds *b,
                                          struct loads *l, const struct family *family, int64_t step_number,
                                          int64_t broken_bond_count, int64_t conversion_count)
{
    if (!contact_is_enabled(c)) return;
    const bool new_faces = broken_bond_count != c->broken && step_number - c->searched >= BREAKS_WAIT;
    const bool come = contact_search_is_needed(c, p);
    if (c->due || new_faces || come) {
        search_pairs(c, p, b, family);
        c->made = true, c->due = false, c->moved = 0;
        c->searched = step_number, c->broken = broken_bond_count;
    } else if (conversion_count == c->changed) {
        contact_activate_newly_moving_particles(c, p, b, l);
        return;
    }
    c->changed = conversion_count;
    contact_restore_active_particles_after_restart(c, p, b,
                                                   l); /* also after conversions, which rebuild rows of bonds */
}
