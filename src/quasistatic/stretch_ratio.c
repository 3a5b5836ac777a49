/* Finds the bonds whose stretch exceeds the critical stretch in load steps, and breaks them in the order of the ratio
 * of both, the largest first. */
#include <math.h>

#include "stretch_ratio.h"
#include "toughness.h"

#include "base/memory.h"
#include "bonds/bond_stretch.h"
#include "kernels/kernels.h"

/* Relative difference of stretch ratios below which bonds break together, so that round-off decides no order. */
#define ALIKE 1e-7

/* Returns the dimensionless ratio of stretch to critical stretch of a bond in the row of particle i of p. limit:
 * critical stretches. If the critical stretch is 0 or less, ratios do not give the order in which bonds break. */
static real stretch_ratio_of(const struct particles *p, const struct bond_limit *limit, const struct bond *bond,
                             int32_t i)
{
    const real stretch = bond_stretch_at_earlier_time(p, bond->inverse_length, i, bond->nbr, 0);
    return stretch / bond_breaking_stretch(p, limit, i, bond->nbr);
}

/* Returns a lower bound of the critical stretches of all bonds: the smallest critical stretch of a pair of materials in
 * `limit` times the smallest strength factor of a particle of `part`. */
static real critical_stretch_least(const struct bond_limit *limit, const struct particles *part)
{
    real least = INFINITY, weakest = 1;
    for (int k = 0; k < limit->materials * limit->materials; k++) least = real_min(least, limit->critical_stretch[k]);
    for (int64_t i = 0; part->strength && i < part->n; i++) weakest = real_min(weakest, part->strength[i]);
    return least * weakest;
}

/* Returns the largest ratio of stretch to critical stretch of the intact bonds of b in row block g (the bonds of eight
 * particles, stored together), or `most` if that is larger. p: particles; limit: critical stretches; weakest: lower
 * bound of all critical stretches, by which most blocks are skipped. */
static real row_block_stretch_ratio(const struct bonds *b, const struct particles *p, const struct bond_limit *limit,
                                    int64_t g, real weakest, real most)
{
    if (bond_row_block_stretch(b, p, g) <= most * weakest) return most;
    for (int64_t r = g * LANES; r < (g + 1) * LANES && r < b->rows; r++)
        for (struct bond_iterator it = bond_iterator_of_row(b, r); bond_iterator_advance(&it);)
            if (it.bond.w != 0) most = real_max(most, stretch_ratio_of(p, limit, &it.bond, b->particle[r]));
    return most;
}

real bonds_largest_stretch_ratio(const struct bonds *b, const struct particles *p, const struct bond_limit *limit)
{
    const real weakest = critical_stretch_least(limit, p);
    real most = 0;
#pragma omp parallel for schedule(static) reduction(max : most)
    for (int64_t g = 0; g < b->row_blocks; g++) most = row_block_stretch_ratio(b, p, limit, g, weakest, most);
    return most + 0; /* of the zeros of two threads either may be taken: never the negative one */
}

/* Compares two numbers *a and *b for array_sort in descending order. */
static int descending(const void *a, const void *b)
{
    const real x = *(const real *)a, y = *(const real *)b;
    return (x < y) - (x > y);
}

/* Returns half of the energy [J] that is needed to stretch `bond` of particle i from zero force to its critical
 * stretch, of which the bond already stores a part. Energy that yielding has dissipated is not included. b, p: all
 * bonds and particles; limit: critical stretches. */
static real half_energy_to_limit(const struct bonds *b, const struct particles *p, const struct bond_limit *limit,
                                 const struct bond *bond, int32_t i)
{
    const real most = bond_breaking_stretch(p, limit, i, bond->nbr);
    real elastic = most, yield = INFINITY, hardening = 0;
    if (b->plastic_stretch) {
        elastic = most - b->plastic_stretch[bond->entry];
        hardening = b->yield.hardening[b->pair[bond->entry]];
        yield = b->yield.stretch[b->pair[bond->entry]] + hardening * b->plastic_path[bond->entry];
    }
    const real work = bond_normalised_work_to_elastic_stretch(real_max(0, elastic), yield, hardening);
    return 0.5 * b->stiffness * bond->w * work / bond->inverse_length;
}

struct broken_bond broken_bond_make_record(const struct bonds *b, const struct particles *p,
                                           const struct bond_limit *limit, const struct bond *bond, int64_t row)
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
                                .held = half_energy_to_limit(b, p, limit, bond, i),
                                .flag = p->flag[i]};
}

/* List of directed bonds (each bond has one entry for each of its two particles) whose ratio of stretch to critical
 * stretch exceeds a threshold. Arrays are owned. */
struct overstretched {
    int64_t n;
    real *ratio;                /* [n] ratio of stretch to critical stretch [1] */
    struct broken_bond *record; /* [n] the bonds */
};

/* Appends a bond to the list o of the bonds with the largest ratios of stretch to critical stretch. over: ratio of its
 * stretch to its critical stretch [1]; record: row and index of the bond, its particles and its energy, which are
 * copied. */
static void overstretched_add(struct overstretched *o, real over, const struct broken_bond *record)
{
    GROW("statics.overloads", o->ratio, o->n + 1);
    GROW("statics.records", o->record, o->n + 1);
    o->ratio[o->n] = over;
    o->record[o->n++] = *record;
}

/* Appends to o, in the order of rows, the bonds of row block g of b (the bonds of eight particles, stored together)
 * with a ratio of stretch to critical stretch above `least`. p: particles; limit: critical stretches. */
static void row_block_overstretched(struct overstretched *o, const struct bonds *b, const struct particles *p,
                                    const struct bond_limit *limit, int64_t g, real least)
{
    for (int64_t r = g * LANES; r < (g + 1) * LANES && r < b->rows; r++)
        for (struct bond_iterator it = bond_iterator_of_row(b, r); bond_iterator_advance(&it);) {
            const real over = it.bond.w == 0 ? 0 : stretch_ratio_of(p, limit, &it.bond, b->particle[r]);
            if (!(over > least)) continue;
            const struct broken_bond record = broken_bond_make_record(b, p, limit, &it.bond, r);
            overstretched_add(o, over, &record);
        }
}

/* Returns the ratio of stretch to critical stretch above which bonds break, such that about `most` bonds do: slightly
 * below the `most`-th largest ratio, but at least `least`. ratio[n]: ratios of directed bonds, two entries for each
 * bond. */
static real stretch_ratio_to_break(const real *ratio, int64_t n, real least, int64_t most)
{
    if (n <= 2 * most) return least;
    real *sorted = BARE("statics.sorted", n, real);
    array_copy(sorted, ratio, n, sizeof *ratio);
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

/* Appends the bonds with a ratio of stretch to critical stretch above `down_to` to list l. ratio[n], record[n]: ratios
 * and records of directed bonds. Returns the mean square of the ratios of the appended bonds, 1 if there are none. */
static real break_list_add_above(struct break_list *l, const real *ratio, const struct broken_bond *record, int64_t n,
                                 real down_to)
{
    real sum = 0;
    int64_t added = 0;
    for (int64_t k = 0; k < n; k++)
        if (ratio[k] > down_to) break_list_add(l, &record[k]), sum += square(ratio[k]), added++;
    return added > 0 ? sum / (real)added : 1;
}

/* Breaks the directed bond of *record in b, i.e. in the row of one of its two particles of p only, and adds half of
 * its energy to the fracture energy of this row. limit: critical stretches; in load steps the bond has no force in the
 * step in which it breaks, whatever limit->last_force says. */
static void bond_record_break(struct bonds *b, struct particles *p, struct bond_limit limit,
                              const struct broken_bond *record)
{
    limit.last_force = LAST_FORCE_NONE;
    bond_break_entry(b, p, &limit, record->row, record->entry);
}

/* Breaks the bonds of the run with the largest ratios of stretch to critical stretch, and appends them to the list of
 * the next crack increment: at most about max_pairs bonds, with ratios within the fraction `ratio_tolerance` of the
 * largest one. Adds their energy at the critical stretch to *added_energy [J] and their crack area to *added_crack_area
 * [m^2]. The energy that state-based models lose is divided equally among the broken bonds, after division by the mean
 * square of their ratios, as in a linear body. Returns the number of directed bonds broken, two for each bond. */
int64_t bonds_break_overstretched(struct run *run, real ratio_tolerance, int64_t max_pairs, real *added_energy,
                                  real *added_crack_area)
{
    struct break_list *l = &run->statics->next;
    const real least = run->statics->stretch_ratio * (1 - real_max(ratio_tolerance, ALIKE)),
               before = bonds_fracture_energy(&run->bonds);
    const real weakest = critical_stretch_least(&run->source.limit, &run->part);
    struct overstretched o = {0};
    for (int64_t g = 0; g < run->bonds.row_blocks; g++)
        if (bond_row_block_stretch(&run->bonds, &run->part, g) > least * weakest)
            row_block_overstretched(&o, &run->bonds, &run->part, &run->source.limit, g, least);
    const real down_to = stretch_ratio_to_break(o.ratio, o.n, least, max_pairs);
    const int64_t had = l->n;
    const real square_mean = break_list_add_above(l, o.ratio, o.record, o.n, down_to);
    for (int64_t k = had; k < l->n; k++) bond_record_break(&run->bonds, &run->part, run->source.limit, &l->bond[k]);
    run->statics->precondition_stale = run->statics->fragments_stale = true;
    const real held = (bonds_fracture_energy(&run->bonds) - before) / square_mean;
    for (int64_t k = had; k < l->n && run->scene->model != MODEL_BOND; k++) l->bond[k].held = held / (real)(l->n - had);
    for (int64_t k = had; k < l->n; k++) {
        *added_energy += l->bond[k].held;
        *added_crack_area += l->bond[k].held / toughness_between_particles(run->scene, &run->source, &run->part,
                                                                           l->bond[k].i, l->bond[k].j);
    }
    memory_free(o.ratio);
    memory_free(o.record);
    return l->n - had;
}

/* Breaks all bonds of list l at once. The stretches of the last of these bonds may still be below their critical
 * stretch; each bond therefore adds its energy at the critical stretch, the member `held` of its record, to the
 * fracture energy. The difference from its present energy is counted as lost by the solver (s->balance.lost) and the
 * run (run->damped). */
void bonds_break_listed(struct run *run, const struct break_list *l)
{
    real more = 0;
    for (int64_t k = 0; k < l->n; k++) {
        const struct broken_bond *record = &l->bond[k];
        real *booked = &run->bonds.fracture_energy[record->row];
        const real before = *booked;
        bond_record_break(&run->bonds, &run->part, run->source.limit, record);
        more += *booked - before - record->held;
        run->statics->record.broken +=
            record->held / toughness_between_particles(run->scene, &run->source, &run->part, record->i, record->j);
        *booked = before + record->held;
    }
    run->statics->balance.lost += more, run->damped += more;
    run->statics->precondition_stale = run->statics->fragments_stale = true;
}

void bonds_restore_broken(struct statics *s, struct bonds *b, struct particles *p, const struct break_list *l)
{
    for (int64_t k = l->n; k-- > 0;) {
        const struct broken_bond *record = &l->bond[k];
        bond_restore_entry(b, p, record->row, record->entry, record->w);
        b->fracture_energy[record->row] = record->fracture;
        b->broken_volume[record->row] = record->volume;
        if (b->plastic_stretch) b->plastic_work[record->row] = record->plastic;
        p->damage[record->i] = record->damage, p->flag[record->i] = record->flag;
    }
    if (l->n > 0) s->precondition_stale = s->fragments_stale = true;
}
