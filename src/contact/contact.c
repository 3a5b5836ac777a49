/* Forces and energies of pairs in contact. */
#include "contact/contact.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "base/team.h"

#define REFERENCE_HORIZON 3.015          /* of the stiffness [spacings] */

/* ---- the law ----------------------------------------------------------------------------------------------------- */

void contact_make(struct contact *c, enum contact_between between, real stiffness, const struct bond_source *source)
{
    struct family family = source->family;
    const int n = source->materials;
    memset(c, 0, sizeof *c);
    c->deepest = -1;
    c->law = (struct contact_law){.between = between,
                                  .materials = n,
                                  .spacing = family.spacing,
                                  .section = family.section,
                                  .image = source->image};
    if (between == CONTACT_NONE) return;
    family_make(&family, family.space, family.spacing, REFERENCE_HORIZON, family.section);
    c->law.stiffness = NEW("contact.stiffness", n * n, real);
    for (int a = 0; a < n; a++)
        for (int b = 0; b < n; b++) {
            const real one = family_micro_modulus(&family, &source->material[a]);
            const real other = family_micro_modulus(&family, &source->material[b]);
            c->law.stiffness[a * n + b] = stiffness * 15 / family.horizon * 2 * one * other / (one + other);
        }
}

void contact_free(struct contact *c)
{
    memory_free(c->law.stiffness);
    memory_free(c->particle);
    memory_free(c->first);
    memory_free(c->other);
    memory_free(c->distance);
    for (int d = 0; d < DIM_MAX; d++) memory_free(c->at[d]);
    memset(c, 0, sizeof *c);
}

/* Two particles under contact k swing with 2 k/m. On a flat face a particle has half its bonds, and of the particles of
 * the other face one stands opposite, or in the plane two and in space three beside it, at 60 degrees or more to the
 * face: in all 1, 1.5 and 2 of k across it. Rubble, which may have eight contacts, needs 0.61 of the step of the bonds
 * in the plane, and has 0.5 of it where bonds may break. */
real contact_critical_step(const struct contact *c, const struct particles *p, const struct material *m, real bonds)
{
    static const real opposite[DIM_MAX + 1] = {0, 1, 1.5, 2};
    const int n = c->law.materials;
    real volume = 0, most = 0;
    if (c->law.between == CONTACT_NONE) return INFINITY;
    for (int64_t i = 0; i < p->n; i++) volume = real_max(volume, p->volume0[i]);
    for (int a = 0; a < n; a++)
        for (int b = 0; b < n; b++)
            most = real_max(most, c->law.stiffness[a * n + b] * volume * (1 / m[a].density + 1 / m[b].density));
    return 2 / sqrt(0.5 * square(2 / bonds) + opposite[p->dim] * most);
}

/* A pair: overlap d - r [m], negative: none; distance r [m]; k [N/m]. The same bits from both its ends. */
struct contact_pair { real overlap, r, k, apart[DIM_MAX]; };

static struct contact_pair contact_pair(const struct contact *c, const struct particles *p, int32_t i, int64_t q)
{
    const int32_t j = c->other[q];
    struct contact_pair pair = {0};
    real r2 = 0;
    for (int d = 0; d < p->dim; d++) {
        pair.apart[d] = p->x[d][i] - p->x[d][j];
        r2 += square(pair.apart[d]);
    }
    if (r2 >= square(c->distance[q])) return pair;
    pair.r = sqrt(r2);
    pair.overlap = c->distance[q] - pair.r;
    pair.k = c->law.stiffness[p->material[i] * c->law.materials + p->material[j]] * (p->volume0[i] * p->volume0[j]);
    return pair;
}

/* ---- forces ------------------------------------------------------------------------------------------------------ */

/* What the rows of a block have found. */
struct contact_found { real overlap; int64_t touching; int32_t deepest; };

static void contact_row(const struct contact *c, struct particles *p, int64_t row, struct contact_found *found)
{
    const int32_t i = c->particle[row];
    real f[DIM_MAX] = {0};
    for (int64_t q = c->first[row]; q < c->first[row + 1]; q++) {
        const struct contact_pair pair = contact_pair(c, p, i, q);
        if (!(pair.overlap > 0 && pair.r > 0)) continue;
        for (int d = 0; d < p->dim; d++) f[d] += pair.k * pair.overlap / pair.r * pair.apart[d];
        found->touching++;
        if (pair.overlap > found->overlap) found->overlap = pair.overlap, found->deepest = i;
    }
    for (int d = 0; d < p->dim; d++) p->f[d][i] += f[d];
}

void contact_force(struct contact *c, struct particles *p)
{
    struct contact_found all = {0, 0, -1};
    if (c->pairs == 0) return;
#pragma omp parallel
    {
        struct contact_found own = {0, 0, -1};
#pragma omp for schedule(static)
        for (int64_t row = 0; row < c->rows; row++)
            if (c->first[row + 1] > c->first[row]) contact_row(c, p, row, &own);
#pragma omp critical
        {
            const bool first = own.overlap == all.overlap && own.deepest >= 0 && own.deepest < all.deepest;
            if (own.overlap > all.overlap || first) all.overlap = own.overlap, all.deepest = own.deepest;
            all.touching += own.touching;
        }
    }
    c->overlap = all.overlap, c->touching = all.touching, c->deepest = all.deepest;
    c->overlap_most = real_max(c->overlap_most, all.overlap);
    if (all.touching / 2 > c->pairs_most) c->pairs_most = all.touching / 2;
}

/* ---- energy ------------------------------------------------------------------------------------------------------ */

struct contact_sum { const struct contact *c; const struct particles *p; };

static real contact_energy_term(const void *context, int64_t row)
{
    const struct contact_sum *s = context;
    real energy = 0;
    for (int64_t q = s->c->first[row]; q < s->c->first[row + 1]; q++) {
        const struct contact_pair pair = contact_pair(s->c, s->p, s->c->particle[row], q);
        energy += 0.25 * pair.k * square(pair.overlap);
    }
    return energy;
}

real contact_energy(const struct contact *c, const struct particles *p)
{
    return c->pairs > 0 ? team_sum(c->rows, contact_energy_term, &(struct contact_sum){c, p}) : 0;
}

/* ---- state ------------------------------------------------------------------------------------------------------- */

/* Makes room for `bytes` of a stored array. */
static status stored_array(struct archive *a, const char *name, void **array, int64_t count, size_t size)
{
    if (!a->saving) {
        memory_free(*array);
        *array = memory_new(name, count, size);
    }
    return count > 0 ? a->exchange(a, name, *array, (size_t)count * size) : OK;
}

/* Indices of a restored list must point into the arrays that there are. */
static status contact_check(const struct contact *c, const struct particles *p)
{
    bool good = c->rows <= c->n && c->first[0] == 0 && c->first[c->rows] == c->pairs;
    for (int64_t k = 0; k < c->n; k++) good = good && c->particle[k] >= 0 && c->particle[k] < p->n_all;
    for (int64_t k = 0; k < c->rows; k++) good = good && c->first[k] <= c->first[k + 1] && c->particle[k] < p->n;
    for (int64_t q = 0; q < c->pairs; q++) good = good && c->other[q] >= 0 && c->other[q] < p->n_all;
    return good ? OK : status_set(FAILED, "cannot resume: pairs in contact of the checkpoint are none of this body");
}

/* The list decides which pairs push, and their distances; it is restored as it was. */
status contact_archive(struct contact *c, const struct particles *p, struct archive *a)
{
    int64_t numbers[] = {c->made, c->n, c->rows, c->pairs, c->searched, c->broken, c->peridynamic, c->pairs_most,
                         c->overlap_said};
    if (c->law.between == CONTACT_NONE) return OK;
    ARCHIVE_VALUE(a, "contact/numbers", numbers);
    ARCHIVE_VALUE(a, "contact/overlap_most", c->overlap_most);
    c->made = numbers[0] != 0, c->n = numbers[1], c->rows = numbers[2], c->pairs = numbers[3];
    c->searched = numbers[4], c->broken = numbers[5], c->peridynamic = numbers[6], c->pairs_most = numbers[7];
    c->overlap_said = numbers[8] != 0;
    if (!c->made) return OK;
    if (c->n < 0 || c->rows < 0 || c->pairs < 0 || c->n > p->n_all || c->rows > c->n || c->pairs > INT32_MAX)
        return status_set(FAILED, "cannot resume: the checkpoint has an impossible number of pairs in contact");
    TRY(stored_array(a, "contact/particle", (void **)&c->particle, c->n, sizeof *c->particle));
    for (int d = 0; d < p->dim; d++) {
        char name[] = "contact/at_x";
        name[sizeof name - 2] = (char)('x' + d);
        TRY(stored_array(a, name, (void **)&c->at[d], c->n, sizeof *c->at[d]));
    }
    TRY(stored_array(a, "contact/first", (void **)&c->first, c->rows + 1, sizeof *c->first));
    TRY(stored_array(a, "contact/other", (void **)&c->other, c->pairs, sizeof *c->other));
    TRY(stored_array(a, "contact/distance", (void **)&c->distance, c->pairs, sizeof *c->distance));
    return a->saving ? OK : contact_check(c, p);
}
