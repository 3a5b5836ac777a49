/* Bonds over their limit in an equilibrium, and those that break: the most overloaded ones first. */
#include <math.h>

#include "overload.h"
#include "toughness.h"

#include "base/memory.h"
#include "kernels/kernels.h"
#include "kernels/pd/bond_last.h"

#define ALIKE 1e-7 /* bonds whose loads differ by less break together: round-off decides no order */

/* Stretch of a bond over its limit. A limit of 0 or less is passed by any stretch above it. */
static real overload_of(const struct particles *p, const struct bond_limit *limit, const struct bond *bond, int32_t i)
{
    const real stretch = bond_stretch_earlier(p, bond->inverse_length, i, bond->nbr, 0);
    return stretch / stretch_limit(p, limit, i, bond->nbr);
}

/* No bond stands below this stretch at its limit. */
static real limit_least(const struct bond_limit *limit, const struct particles *part)
{
    real least = INFINITY, weakest = 1;
    for (int k = 0; k < limit->materials * limit->materials; k++) least = real_min(least, limit->critical_stretch[k]);
    for (int64_t i = 0; part->strength && i < part->n; i++) weakest = real_min(weakest, part->strength[i]);
    return least * weakest;
}

/* The larger of `most` and the largest of a row block. */
static real row_block_overload(const struct bonds *b, const struct particles *p, const struct bond_limit *limit,
                               int64_t g, real weakest, real most)
{
    if (bond_row_block_stretch(b, p, g) <= most * weakest) return most;
    for (int64_t r = g * LANES; r < (g + 1) * LANES && r < b->rows; r++)
        for (struct bond_iterator it = bonds_of_row(b, r); bond_next(&it);)
            if (it.bond.w != 0) most = real_max(most, overload_of(p, limit, &it.bond, b->particle[r]));
    return most;
}

real statics_overload(const struct bonds *b, const struct particles *p, const struct bond_limit *limit)
{
    const real weakest = limit_least(limit, p);
    real most = 0;
#pragma omp parallel for schedule(static) reduction(max : most)
    for (int64_t g = 0; g < b->row_blocks; g++) most = row_block_overload(b, p, limit, g, weakest, most);
    return most;
}

static int descending(const void *a, const void *b)
{
    const real x = *(const real *)a, y = *(const real *)b;
    return (x < y) - (x > y);
}

/* Half of what a bond of particle i takes to its limit from where it bears nothing: what it holds, and the work that is
 * left to be done on it [J]. Of one that yields, what it has dissipated before is gone and costs no more. */
static real half_to_limit(const struct bonds *b, const struct particles *p, const struct bond_limit *limit,
                          const struct bond *bond, int32_t i)
{
    const real most = stretch_limit(p, limit, i, bond->nbr);
    real elastic = most, yield = INFINITY, hardening = 0;
    if (b->plastic_stretch) {
        elastic = most - b->plastic_stretch[bond->entry];
        hardening = b->yield.hardening[b->pair[bond->entry]];
        yield = b->yield.stretch[b->pair[bond->entry]] + hardening * b->plastic_path[bond->entry];
    }
    const real work = stretch_work(real_max(0, elastic), yield, hardening);
    return 0.5 * b->stiffness * bond->w * work / bond->inverse_length;
}

struct broken_bond statics_bond_record(const struct bonds *b, const struct particles *p, const struct bond_limit *limit,
                                       const struct bond *bond, int64_t row)
{
    const int32_t i = b->particle[row];
    return (struct broken_bond){.i = i,
                                .j = bond->nbr,
                                .row = row,
                                .entry = bond->entry,
                                .w = bond->w,
                                .fracture = b->fracture_energy[row],
                                .damage = p->damage[i],
                                .plastic = b->plastic_stretch ? b->plastic_work[row] : 0,
                                .volume = b->broken_volume[row],
                                .held = half_to_limit(b, p, limit, bond, i),
                                .flag = p->flag[i]};
}

/* Overloaded directed bonds: their overloads, and records of them. */
struct overloads {
    int64_t n;
    real *load;
    struct broken_bond *record;
};

static void overloads_add(struct overloads *o, real over, const struct broken_bond *record)
{
    GROW("statics.overloads", o->load, o->n + 1);
    GROW("statics.records", o->record, o->n + 1);
    o->load[o->n] = over;
    o->record[o->n++] = *record;
}

/* Adds those of a row block whose overload is above `least`, in the order of rows. */
static void row_block_overloads(struct overloads *o, const struct bonds *b, const struct particles *p,
                                const struct bond_limit *limit, int64_t g, real least)
{
    for (int64_t r = g * LANES; r < (g + 1) * LANES && r < b->rows; r++)
        for (struct bond_iterator it = bonds_of_row(b, r); bond_next(&it);) {
            const real over = it.bond.w == 0 ? 0 : overload_of(p, limit, &it.bond, b->particle[r]);
            if (!(over > least)) continue;
            const struct broken_bond record = statics_bond_record(b, p, limit, &it.bond, r);
            overloads_add(o, over, &record);
        }
}

/* The overload down to which bonds break: of the first `most` pairs in order of their loads. */
static real least_to_break(const real *load, int64_t n, real least, int64_t most)
{
    if (n <= 2 * most) return least;
    real *sorted = BARE("statics.sorted", n, real);
    array_copy(sorted, load, n, sizeof *load);
    array_sort(sorted, n, sizeof *sorted, descending);
    const real down_to = sorted[2 * most - 1] * (1 - ALIKE);
    memory_free(sorted);
    return real_max(least, down_to);
}

void break_list_add(struct break_list *l, const struct broken_bond *record)
{
    GROW("statics.broken", l->bond, l->n + 1);
    l->bond[l->n++] = *record;
}

/* Adds those above `down_to` to the list of the advance; returns the mean square of their overloads. */
static real broken_add(struct break_list *l, const real *load, const struct broken_bond *record, int64_t n,
                       real down_to)
{
    real sum = 0;
    int64_t added = 0;
    for (int64_t k = 0; k < n; k++)
        if (load[k] > down_to) break_list_add(l, &record[k]), sum += square(load[k]), added++;
    return added > 0 ? sum / (real)added : 1;
}

/* Breaks the bond of a record, half of whose energy its row books. */
static void record_break(struct bonds *b, struct particles *p, struct bond_limit limit,
                         const struct broken_bond *record)
{
    limit.last_force = LAST_FORCE_NONE;
    bond_break_entry(b, p, &limit, record->row, record->entry);
}

/* State-based bonds have no energy of their own: in a linear body, what a break takes is what it takes at the limit
 * times the square of the overload. */
int64_t statics_break(struct run *e, real share, int64_t most, real *cost, real *area)
{
    struct break_list *l = &e->statics->next;
    const real least = e->statics->overload * (1 - real_max(share, ALIKE)), before = bonds_fracture_energy(&e->bonds);
    const real weakest = limit_least(&e->source.limit, &e->part);
    struct overloads o = {0};
    for (int64_t g = 0; g < e->bonds.row_blocks; g++)
        if (bond_row_block_stretch(&e->bonds, &e->part, g) > least * weakest)
            row_block_overloads(&o, &e->bonds, &e->part, &e->source.limit, g, least);
    const real down_to = least_to_break(o.load, o.n, least, most);
    const int64_t had = l->n;
    const real square_mean = broken_add(l, o.load, o.record, o.n, down_to);
    for (int64_t k = had; k < l->n; k++) record_break(&e->bonds, &e->part, e->source.limit, &l->bond[k]);
    e->statics->stale = e->statics->parted = true;
    const real held = (bonds_fracture_energy(&e->bonds) - before) / square_mean;
    for (int64_t k = had; k < l->n && e->scene->model != MODEL_BOND; k++) l->bond[k].held = held / (real)(l->n - had);
    for (int64_t k = had; k < l->n; k++) {
        *cost += l->bond[k].held;
        *area += l->bond[k].held / toughness_between(e->scene, &e->source, &e->part, l->bond[k].i, l->bond[k].j);
    }
    memory_free(o.load);
    memory_free(o.record);
    return l->n - had;
}

/* All at once: what the later ones of the list hold at their limits shows only as the first are gone. */
void statics_break_listed(struct run *e, const struct break_list *l)
{
    real more = 0;
    for (int64_t k = 0; k < l->n; k++) {
        const struct broken_bond *record = &l->bond[k];
        real *booked = &e->bonds.fracture_energy[record->row];
        const real before = *booked;
        record_break(&e->bonds, &e->part, e->source.limit, record);
        more += *booked - before - record->held;
        e->statics->record.broken +=
            record->held / toughness_between(e->scene, &e->source, &e->part, record->i, record->j);
        *booked = before + record->held;
    }
    e->statics->balance.lost += more, e->damped += more;
    e->statics->stale = e->statics->parted = true;
}

void statics_mend(struct statics *s, struct bonds *b, struct particles *p, const struct break_list *l)
{
    for (int64_t k = l->n; k-- > 0;) {
        const struct broken_bond *record = &l->bond[k];
        bond_restore_entry(b, p, record->row, record->entry, record->w);
        b->fracture_energy[record->row] = record->fracture;
        b->broken_volume[record->row] = record->volume;
        if (b->plastic_stretch) b->plastic_work[record->row] = record->plastic;
        p->damage[record->i] = record->damage, p->flag[record->i] = record->flag;
    }
    if (l->n > 0) s->stale = s->parted = true;
}
