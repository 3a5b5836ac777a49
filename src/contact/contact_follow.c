/* Marks the particles on which contact may act before the next search: as loaded, so that they move after contact
 * forces are known, and their blocks of eight bond rows as active. Particles at faces at rest are added once particles
 * there move, so that contact activates no region at rest. */
#include "base/memory.h"
#include "contact_internal.h"

/* Returns true if the particle of row `row` of the contact list c may come into contact before the next search; always
 * with a law of the form `pair`. With the form `surface`, false if the gap to the faces near it, face[row].far, exceeds
 * CONTACT_FLATNESS times half of CONTACT_SKIN [spacings], since the particle and the faces move by at most half of
 * CONTACT_SKIN spacings until the next search. */
static bool may_meet(const struct contact *c, int64_t row)
{
    return c->law.form == CONTACT_PAIR || c->face[row].far <= CONTACT_FLATNESS * 0.5 * CONTACT_SKIN;
}

/* Returns true if contact is possible before the next search for the particle of row `row` of the contact list c, or
 * for one of the particles with which it forms a pair. Returns false if the particle has no pairs. */
static bool row_is_near(const struct contact *c, int64_t row)
{
    if (c->first[row + 1] == c->first[row]) return false;
    bool near = may_meet(c, row);
    for (int64_t q = c->first[row]; q < c->first[row + 1] && !near; q++) near = may_meet(c, c->root[c->other[q]]);
    return near;
}

/* Returns true if the particle of p in entry k of the contact list c (particles that may come into contact) has left
 * its reference position. */
static bool entry_has_moved(const struct contact *c, const struct particles *p, int64_t k)
{
    const int32_t i = c->particle[k];
    for (int d = 0; d < p->dim; d++)
        if (!reals_are_bitwise_equal(p->x[d][i], p->X[d][i])) return true;
    return false;
}

/* Returns true if the particle of p in row `row` of the contact list c, or the other particle of one of its pairs, is
 * not at its reference position any more. If false, contact exerts no force on the particle. */
static bool row_has_moved(const struct contact *c, const struct particles *p, int64_t row)
{
    bool moved = entry_has_moved(c, p, row);
    for (int64_t q = c->first[row]; q < c->first[row + 1] && !moved; q++) moved = entry_has_moved(c, p, c->other[q]);
    return moved;
}

/* Returns true if one of the particles that form a pair with the particle of row `row` of the contact list c has a row
 * marked ROW_ACTIVE, i.e. its contact is evaluated. Marks are read atomically, since other threads may change marks
 * from ROW_NEAR to ROW_SOURCE meanwhile, which does not change the result. */
static bool beside_active(const struct contact *c, int64_t row)
{
    bool beside = false;
    for (int64_t q = c->first[row]; q < c->first[row + 1] && !beside; q++) {
        uint8_t state;
#pragma omp atomic read
        state = c->followed[c->root[c->other[q]]];
        beside = state == ROW_ACTIVE;
    }
    return beside;
}

/* Updates the states of the rows of the contact list c (a row: one particle and the particles that it may touch). A row
 * becomes ROW_ACTIVE, so that its contact is evaluated from this step on, if contact is possible and its particle (of
 * p) or one that it may touch has begun to move. Rows of the latter particles, which then also experience contact
 * forces, become ROW_SOURCE. Returns true if a row has become ROW_ACTIVE. */
static bool rows_follow(struct contact *c, const struct particles *p)
{
    int64_t found = 0;
#pragma omp parallel
    {
#pragma omp for schedule(static) reduction(+ : found)
        for (int64_t row = 0; row < c->rows; row++)
            if ((c->followed[row] == ROW_NEAR || c->followed[row] == ROW_SOURCE) && row_has_moved(c, p, row))
                c->followed[row] = ROW_ACTIVE, found++;
#pragma omp for schedule(static)
        for (int64_t row = 0; row < c->rows; row++)
            if (c->followed[row] == ROW_NEAR && beside_active(c, row)) {
#pragma omp atomic write
                c->followed[row] = ROW_SOURCE;
            }
    }
    c->waiting -= found;
    return found > 0;
}

/* Marks the particles of p on which contact forces may act as loaded in the loads l, so that they are moved after these
 * forces are known. Marks the blocks of eight bond rows of b that contain their bonds as active. c: contact, whose rows
 * have been marked (rows_follow). */
static void rows_touch(const struct contact *c, const struct particles *p, struct bonds *b, struct loads *l)
{
    int32_t *list = BARE("contact.list", c->rows, int32_t);
    int64_t n = 0;
    for (int64_t row = 0; row < c->rows; row++)
        if (contact_list_particle_may_receive_force(c, row)) list[n++] = c->particle[row];
    loads_store_list_of_possible_contact_particles(l, p, list, n);
    active_bond_row_blocks_activate_for_particles(b, p, l, list, n);
    memory_free(list);
}

void contact_activate_newly_moving_particles(struct contact *c, const struct particles *p, struct bonds *b,
                                             struct loads *l)
{
    if (c->waiting > 0 && rows_follow(c, p)) rows_touch(c, p, b, l);
}

void contact_restore_active_particles_after_restart(struct contact *c, const struct particles *p, struct bonds *b,
                                                    struct loads *l)
{
    memory_free(c->followed);
    c->followed = BARE("contact.followed", c->rows, uint8_t);
    c->waiting = 0;
    for (int64_t row = 0; row < c->rows; row++) {
        c->followed[row] = row_is_near(c, row) ? ROW_NEAR : ROW_FAR;
        c->waiting += c->followed[row] == ROW_NEAR;
    }
    rows_follow(c, p);
    for (int a = 0; a < c->rigids; a++)
        for (int64_t q = 0; q < c->near[a].n; q++) {
            uint8_t *followed = &c->followed[c->near[a].row[q]];
            if (*followed == ROW_NEAR || *followed == ROW_SOURCE) c->waiting--;
            *followed = ROW_ACTIVE;
        }
    rows_touch(c, p, b, l);
}
