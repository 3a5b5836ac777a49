/* Which rows something may push before the next search: their particles count as loaded, so that they move after
 * contact has pushed them, and their row blocks as active. Rows whose faces rest are found once something there moves:
 * contact wakes nothing that no wave has reached. */
#include "base/memory.h"
#include "contact_internal.h"

/* Faces farther than this do not meet before the next search: both sides come nearer by half a skin at most, and
 * fields are not quite flat [spacings]. */
static bool may_meet(const struct contact *c, int64_t row)
{
    return c->law.form == CONTACT_PAIR || c->face[row].far <= CONTACT_FLATNESS * 0.5 * CONTACT_SKIN;
}

/* Can it feel something, or something feel it? */
static bool row_is_near(const struct contact *c, int64_t row)
{
    if (c->first[row + 1] == c->first[row]) return false;
    bool near = may_meet(c, row);
    for (int64_t q = c->first[row]; q < c->first[row + 1] && !near; q++) near = may_meet(c, c->root[c->other[q]]);
    return near;
}

static bool entry_has_moved(const struct contact *c, const struct particles *p, int64_t k)
{
    const int32_t i = c->particle[k];
    for (int d = 0; d < p->dim; d++)
        if (!bits_equal(p->x[d][i], p->X[d][i])) return true;
    return false;
}

/* What has never moved, beside what has never moved, pushes nothing. */
static bool row_has_moved(const struct contact *c, const struct particles *p, int64_t row)
{
    bool moved = entry_has_moved(c, p, row);
    for (int64_t q = c->first[row]; q < c->first[row + 1] && !moved; q++) moved = entry_has_moved(c, p, c->other[q]);
    return moved;
}

/* Returns true if a row near this one is marked ROW_FEELS. Other threads may turn ROW_NEAR of that row into ROW_FELT
 * meanwhile, which changes no answer; so both sides are atomic. */
static bool is_felt(const struct contact *c, int64_t row)
{
    bool felt = false;
    for (int64_t q = c->first[row]; q < c->first[row + 1] && !felt; q++) {
        uint8_t state;
#pragma omp atomic read
        state = c->followed[c->root[c->other[q]]];
        felt = state == ROW_FEELS;
    }
    return felt;
}

/* Finds rows that feel what has moved, then those that they feel; are there any new ones? */
static bool rows_follow(struct contact *c, const struct particles *p)
{
    int64_t found = 0;
#pragma omp parallel
    {
#pragma omp for schedule(static) reduction(+ : found)
        for (int64_t row = 0; row < c->rows; row++)
            if ((c->followed[row] == ROW_NEAR || c->followed[row] == ROW_FELT) && row_has_moved(c, p, row))
                c->followed[row] = ROW_FEELS, found++;
#pragma omp for schedule(static)
        for (int64_t row = 0; row < c->rows; row++)
            if (c->followed[row] == ROW_NEAR && is_felt(c, row)) {
#pragma omp atomic write
                c->followed[row] = ROW_FELT;
            }
    }
    c->waiting -= found;
    return found > 0;
}

static void rows_touch(const struct contact *c, const struct particles *p, struct bonds *b, struct loads *l)
{
    int32_t *list = BARE("contact.list", c->rows, int32_t);
    int64_t n = 0;
    for (int64_t row = 0; row < c->rows; row++)
        if (contact_follows(c, row)) list[n++] = c->particle[row];
    loads_touch(l, p, list, n);
    active_rows_touch(b, p, l, list, n);
    memory_free(list);
}

void contact_follow_more(struct contact *c, const struct particles *p, struct bonds *b, struct loads *l)
{
    if (c->waiting > 0 && rows_follow(c, p)) rows_touch(c, p, b, l);
}

void contact_follow(struct contact *c, const struct particles *p, struct bonds *b, struct loads *l)
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
            if (*followed == ROW_NEAR || *followed == ROW_FELT) c->waiting--;
            *followed = ROW_FEELS;
        }
    rows_touch(c, p, b, l);
}
