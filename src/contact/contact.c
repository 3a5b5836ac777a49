/* Computes contact forces, contact energies and the critical time step with contact, and saves and restores the state
 * of contact. */
#include "contact_internal.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "base/team.h"

#define REFERENCE_HORIZON 3.015 /* horizon in the stiffness k [spacings] */

/* ---- the law ----------------------------------------------------------------------------------------------------- */

/* Initialises the contact c of a run; pairs in contact are searched later. between: which particles may come into
 * contact; law: form, contact distance and friction; its other members are ignored. The stiffness of a contact follows
 * from the materials in `source` (data from which bonds are made) times stiffness_factor [1]. body_shapes[bodies]:
 * shape of each body, from which the height of its surface above its particles follows; rigid[rigid_body_count]: rigid
 * bodies. `body_shapes` and `rigid` are kept by reference and must outlive c. Release c with contact_free. */
void contact_make(struct contact *c, enum contact_between between, struct contact_law law, real stiffness_factor,
                  const struct bond_source *source, const struct region *const *body_shapes, struct rigid_body *rigid,
                  int rigid_body_count)
{
    struct family family = source->family;
    const int n = source->materials;
    memset(c, 0, sizeof *c);
    c->deepest = -1;
    c->began = c->ended = NAN;
    c->law = (struct contact_law){.between = between,
                                  .form = law.form,
                                  .distance = law.distance,
                                  .friction = law.friction,
                                  .materials = n,
                                  .spacing = family.spacing,
                                  .section = family.section,
                                  .image = source->image,
                                  .crack = source->crack,
                                  .cracks = source->cracks,
                                  .shape = body_shapes};
    c->rigid = rigid, c->rigids = rigid_body_count;
    if (!contact_is_enabled(c)) return;
    contact_profile_tabulate_height_above_flat_face(&c->law.profile, space_dim(family.space));
    if (law.distance == DISTANCE_SPACING)
        family_make_on_lattice(&family, family.space, family.spacing, REFERENCE_HORIZON, family.section);
    c->law.stiffness = NEW("contact.stiffness", n * n, real);
    for (int a = 0; a < n; a++)
        for (int b = 0; b < n; b++) {
            const real one = family_micro_modulus(&family, &source->material[a]);
            const real other = family_micro_modulus(&family, &source->material[b]);
            c->law.stiffness[a * n + b] = stiffness_factor * 15 / family.horizon * 2 * one * other / (one + other);
        }
}

void contact_free(struct contact *c)
{
    memory_free(c->law.stiffness);
    memory_free(c->particle);
    memory_free(c->first);
    memory_free(c->other);
    memory_free(c->distance);
    memory_free(c->root);
    memory_free(c->size);
    memory_free(c->rise);
    memory_free(c->face);
    memory_free(c->spring);
    memory_free(c->reaction);
    memory_free(c->followed);
    memory_free(c->touch);
    memory_free(c->balance);
    contact_rigid_free_particle_lists(c);
    for (int d = 0; d < DIM_MAX; d++) memory_free(c->at[d]), memory_free(c->push[d]);
    memset(c, 0, sizeof *c);
}

/* Returns the largest squared frequency [1/s^2] of a freely moving rigid body of contact c between particles of the
 * deformable bodies p on two opposite sides; 0 if no rigid body moves freely. Each of the two faces in contact is
 * assumed to have one particle per spacing, with a contact stiffness of 2 k each. m: material of the particles;
 * stiffness: k divided by the squared volume of a particle [N/m^7]; volume: volume of a particle [m^3]. */
static real rigid_swing(const struct contact *c, const struct particles *p, const struct material *m, real stiffness,
                        real volume)
{
    const real spring = 2 * stiffness * square(volume);
    real most = 0;
    for (int k = 0; k < c->rigids; k++) {
        const struct rigid_body *r = &c->rigid[k];
        const real touching = 2 * real_max(1, r->face / pow(c->law.spacing, p->dim - 1));
        if (r->motion == RIGID_FREE) most = real_max(most, spring * (1 / (m->density * volume) + touching / r->mass));
    }
    return most;
}

/* Returns the critical time step of particles p that are joined by bonds and pushed by contact c [s]; INFINITY if
 * contact is not possible. bonds_time_step: critical time step of the bonds alone [s]; materials: array of the
 * materials. The step is 2/omega_max for a particle on a flat face, whose squared frequencies by bonds and by contact
 * are added. Bonds: a particle at a face has half of the bonds of an inner one, so that the square of 2/bonds_time_step
 * counts half. Contact: two particles in contact with stiffness k have the squared frequency 2 k/mass. The normal
 * stiffness of all contacts of one particle is 1 k in 1D, 1.5 k in 2D and 2 k in 3D (1, 2 or 3 opposite particles, at
 * angles of at least 60 degrees to the face). With the contact distance of LAMMPS, full neighbourhoods and contact with
 * all 2, 8 or 26 neighbours are assumed instead. Loose particles (rubble) have up to eight contacts and need 0.61 of
 * the bonds' critical step in 2D; the safety factor 0.5 for breaking bonds is below that. */
real contact_critical_time_step(const struct contact *c, const struct particles *p, const struct material *materials,
                                real bonds_time_step)
{
    static const real opposite[DIM_MAX + 1] = {0, 1, 1.5, 2}, squeezed[DIM_MAX + 1] = {0, 2, 4, 26.0 / 3};
    const int n = c->law.materials;
    real volume = 0, most = 0;
    if (!contact_is_enabled(c)) return INFINITY;
    for (int64_t i = 0; i < p->n; i++) volume = real_max(volume, p->volume0[i]);
    for (int a = 0; a < n; a++)
        for (int b = 0; b < n; b++)
            most = real_max(most, c->law.stiffness[a * n + b] * volume *
                                      (1 / materials[a].density + 1 / materials[b].density));
    real across = opposite[p->dim] * most;
    if (c->law.distance == DISTANCE_LAMMPS) return 2 / sqrt(square(2 / bonds_time_step) + squeezed[p->dim] * most);
    for (int a = 0; a < n; a++)
        across = real_max(across, rigid_swing(c, p, &materials[a], c->law.stiffness[a * n + a], volume));
    return 2 / sqrt(0.5 * square(2 / bonds_time_step) + across);
}

/* ---- forces and energy ------------------------------------------------------------------------------------------- */

/* Adds the contacts that one thread has found, *own, to the contacts of all threads, *all: their number, and the
 * largest overlap with its particle if that of *own is larger. */
static void found_join(struct contact_summary *all, const struct contact_summary *own)
{
    const int64_t touching = all->touching + own->touching;
    if (own->touching > 0) contact_summary_add_overlap(all, own->overlap, own->deepest);
    all->touching = touching;
}

/* Evaluates contact in parallel for all rows of the contact list of c (a row: a particle near a free surface, with the
 * particles that it may touch). With a law of the form `pair` (between pairs of particles), adds the contact forces to
 * p->f. With the form `surface` (between smooth faces), only computes the gaps, from which faces_force computes forces
 * afterwards. dt: time step, used by the form `surface` [s]. all: the number of contacts found is added, and the
 * largest overlap [m] and its particle are updated; unchanged if no particles are in contact. */
static void rows_sweep(struct contact *c, struct particles *p, real dt, struct contact_summary *all)
{
    const bool faces = c->law.form == CONTACT_SURFACE;
    const real reach = CONTACT_FLATNESS * c->moved / c->law.spacing;
#pragma omp parallel
    {
        struct contact_summary own = {0, 0, INT32_MAX};
#pragma omp for schedule(static)
        for (int64_t row = 0; row < c->rows; row++) {
            if (!contact_list_particle_may_receive_force(c, row) || (faces && !c->touch && c->face[row].far > reach))
                continue;
            if (faces)
                contact_face_store_gap_and_energy_derivatives(c, p, row, dt, &own);
            else
                contact_pair_add_forces_on_particle(c, p, row, &own);
        }
#pragma omp critical
        found_join(all, &own);
    }
}

/* Adds the contact forces of a law of the form `surface`, friction included, to p->f, for all rows of the contact list
 * c (particles that may come into contact). Call it after rows_sweep, which computes the gaps. Friction is added in a
 * second pass, since it requires the friction springs of all rows, which the first pass advances by the time step dt
 * [s]. */
static void faces_force(struct contact *c, struct particles *p, real dt)
{
#pragma omp parallel
    {
#pragma omp for schedule(static)
        for (int64_t row = 0; row < c->rows; row++) {
            if (!contact_list_particle_may_receive_force(c, row)) continue;
            contact_face_add_force_on_particle(c, p, row);
            if (c->spring) contact_face_advance_friction_spring(c, p, row, dt);
        }
#pragma omp for schedule(static)
        for (int64_t row = 0; row < (c->spring ? c->rows : 0); row++)
            if (contact_list_particle_may_receive_force(c, row)) contact_face_add_friction_on_particle(c, p, row);
    }
}

void contact_allocate_particle_forces(struct contact *c, const struct particles *p)
{
    for (int d = 0; d < p->dim && contact_is_enabled(c); d++)
        if (!c->push[d]) c->push[d] = NEW("contact.push", p->n, real);
}

/* Records the contact forces on all particles of p in c->push[dim][n] [N], for output. Call it twice: with `after`
 * false before contact forces are added to p->f, which copies p->f, and with `after` true afterwards, which stores the
 * difference. */
static void record(struct contact *c, const struct particles *p, bool after)
{
    for (int d = 0; d < p->dim; d++)
        for (int64_t i = 0; i < p->n; i++) c->push[d][i] = after ? p->f[d][i] - c->push[d][i] : p->f[d][i];
}

void contact_compute_forces(struct contact *c, struct particles *p, real dt)
{
    struct contact_summary all = {0, 0, INT32_MAX};
    if (c->recorded) record(c, p, false);
    if (c->pairs > 0) rows_sweep(c, p, dt, &all);
    if (c->pairs > 0 && c->law.form == CONTACT_SURFACE && (all.touching > 0 || c->spring)) faces_force(c, p, dt);
    contact_rigid_compute_forces(c, p, dt, &all);
    if (c->recorded) record(c, p, true);
    c->overlap = all.overlap, c->touching = all.touching, c->deepest = all.touching > 0 ? all.deepest : -1;
    c->overlap_most = real_max(c->overlap_most, all.overlap);
    if (all.touching / 2 > c->pairs_most) c->pairs_most = all.touching / 2;
}

void contact_record_first_and_last_contact_time(struct contact *c, real t)
{
    if (c->touching == 0) return;
    c->ended = t;
    if (isnan(c->began)) c->began = t;
}

/* Argument of the sum of contact energies over rows: the contact and the particles. */
struct contact_sum {
    const struct contact *c;
    const struct particles *p;
};

/* Returns the contact energy of row `row` of the contact list (particles that may come into contact) [J], as a term of
 * reproducible_sum over rows. context: contact and particles (struct contact_sum). */
static real contact_energy_term(const void *context, int64_t row)
{
    const struct contact_sum *s = context;
    return s->c->law.form == CONTACT_SURFACE ? contact_face_energy_of_particle(s->c, s->p, row)
                                             : contact_pair_half_energy_of_particle(s->c, s->p, row);
}

real contact_elastic_energy(const struct contact *c, const struct particles *p)
{
    const real pairs = c->pairs > 0 ? reproducible_sum(c->rows, contact_energy_term, &(struct contact_sum){c, p}) : 0;
    return pairs + contact_rigid_elastic_energy(c, p) + contact_friction_stored_energy(c);
}

/* ---- other particles --------------------------------------------------------------------------------------------- */

/* ---- state ------------------------------------------------------------------------------------------------------- */

/* Saves the array *array to the archive a if a->saving; else frees it, allocates it anew and restores it from a. The
 * caller owns the array. name: name of the entry in the archive; count: number of elements; element_size: size of an
 * element [byte]. Returns FAILED if the archive cannot be read or written or the stored size differs. */
status contact_array_save_or_load(struct archive *a, const char *name, void **array, int64_t count, size_t element_size)
{
    if (!a->saving) {
        memory_free(*array);
        *array = memory_new(name, count, element_size);
    }
    return count > 0 ? a->exchange(a, name, *array, (size_t)count * element_size) : OK;
}

/* Checks that all indices of the restored contact list c are in range: numbers of particles (p), of list entries and of
 * pairs. Returns OK, or FAILED with a message. */
static status contact_check(const struct contact *c, const struct particles *p)
{
    bool good = c->rows <= c->n && c->first[0] == 0 && c->first[c->rows] == c->pairs;
    for (int64_t k = 0; k < c->n; k++) good = good && c->particle[k] >= 0 && c->particle[k] < p->n_all;
    for (int64_t k = 0; k < c->rows; k++) good = good && c->first[k] <= c->first[k + 1] && c->particle[k] < p->n;
    for (int64_t q = 0; q < c->pairs; q++) good = good && c->other[q] >= 0 && c->other[q] < c->n;
    return good ? OK
                : status_set(FAILED, "cannot resume: the checkpoint lists contact pairs of particles that do not exist "
                                     "in this run; it is damaged, start again with --overwrite");
}

/* Saves the state of contact c to the archive a if a->saving, else restores it. The list of pairs, which determines
 * which pairs act and at which distance their contact begins, is restored without a search. p: particles, at their
 * restored positions. Returns FAILED, with a message, if the archive contains no valid list. */
status contact_save_or_load(struct contact *c, const struct particles *p, struct archive *a)
{
    int64_t numbers[] = {c->made,   c->n,       c->rows,       c->pairs,        c->searched,
                         c->broken, c->changed, c->pairs_most, c->overlap_said, c->due};
    if (!contact_is_enabled(c)) return OK;
    ARCHIVE_VALUE(a, "contact/numbers", numbers);
    ARCHIVE_VALUE(a, "contact/overlap_most", c->overlap_most);
    ARCHIVE_VALUE(a, "contact/began", c->began);
    ARCHIVE_VALUE(a, "contact/ended", c->ended);
    c->made = numbers[0] != 0, c->n = numbers[1], c->rows = numbers[2], c->pairs = numbers[3];
    c->searched = numbers[4], c->broken = numbers[5], c->changed = numbers[6], c->pairs_most = numbers[7];
    c->overlap_said = numbers[8] != 0, c->due = numbers[9] != 0;
    if (!c->made) return OK;
    if (c->n < 0 || c->rows < 0 || c->pairs < 0 || c->n > p->n_all || c->rows > c->n || c->pairs > INT32_MAX)
        return status_set(FAILED, "cannot resume: the checkpoint has an impossible number of pairs in contact; it is "
                                  "damaged, start again with --overwrite");
    TRY(contact_array_save_or_load(a, "contact/particle", (void **)&c->particle, c->n, sizeof *c->particle));
    archive_renumber_restored_particle_indices(a, c->particle, c->n);
    for (int d = 0; d < p->dim; d++) {
        char name[] = "contact/at_x";
        name[sizeof name - 2] = (char)('x' + d);
        TRY(contact_array_save_or_load(a, name, (void **)&c->at[d], c->n, sizeof *c->at[d]));
    }
    TRY(contact_array_save_or_load(a, "contact/first", (void **)&c->first, c->rows + 1, sizeof *c->first));
    TRY(contact_array_save_or_load(a, "contact/other", (void **)&c->other, c->pairs, sizeof *c->other));
    if (c->law.form == CONTACT_PAIR)
        TRY(contact_array_save_or_load(a, "contact/distance", (void **)&c->distance, c->pairs, sizeof *c->distance));
    else {
        TRY(contact_array_save_or_load(a, "contact/face", (void **)&c->face, c->rows, sizeof *c->face));
        TRY(contact_array_save_or_load(a, "contact/balance", (void **)&c->balance, c->rows, sizeof *c->balance));
    }
    if (c->law.friction > 0) {
        ARCHIVE_VALUE(a, "contact/friction_work", c->friction_work);
        TRY(contact_array_save_or_load(a, "contact/spring", (void **)&c->spring, c->rows, sizeof *c->spring));
        if (!a->saving) contact_friction_reactions_allocate(c);
    }
    TRY(contact_rigid_save_or_load_particle_lists(c, a));
    TRY(contact_active_set_save_or_load(c, a));
    if (a->saving) return OK;
    TRY(contact_check(c, p));
    contact_list_set_spacings_and_surface_heights(c, p);
    if (c->touch) contact_enable_forces_on_all_listed_particles(c);
    return OK;
}
