/* Compares a computed bar with a closed-form solution (exact.h), for probes of kind EXACT.
 *
 * Two stresses are compared, which differ in a peridynamic bar that is not calibrated: the bond flux, i.e. the force of
 * the bonds across a plane divided by its area, which balances momentum, and Young's modulus E times the strain.
 * Results without a suffix are those of the flux; those with the suffix `_strain` compare E times the computed strain
 * with E times the exact strain. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "kernels/pd/bond_laws.h"
#include "base/memory.h"
#include "probes_parts.h"

/* ---- stress and strain ------------------------------------------------------------------------------------------- */

/* Returns the rank of particle i of p: its position in the order of the particles of bar b from left to right, from 0;
 * -1 (left) or b->n (right) if i is the mirror image of a particle beyond an end of the bar. */
static int64_t probes_bar_rank(const struct bar *b, const struct particles *p, int32_t i)
{
    if (i < p->n) return b->rank[i];
    return p->X[0][i] < b->exact.left ? -1 : b->n;
}

/* Adds the forces of all intact bonds of bar b in the run o, each bond once, to the arrays from which the stress
 * follows. between[n + 1]: the force of a bond is added after its left particle and subtracted at its right one, so
 * that prefix sums are the forces of the bonds that cross each particle [N]. end[n]: half the force of the bonds that
 * end at each particle [N]. */
static void add_bonds(const struct bar *b, const struct observed_run *o, real *between, real *end)
{
    const struct bonds *bonds = o->bonds;
    for (int64_t row = 0; row < bonds->rows; row++) {
        int32_t i = bonds->particle[row];
        for (struct bond_iterator it = bond_iterator_of_row(bonds, row); bond_iterator_advance(&it);) {
            const int32_t j = it.bond.nbr;
            if (it.bond.w == 0 || j < i) continue;
            real force = bond_based_signed_force(bonds, o->part, &it.bond, i);
            int64_t from = b->rank[i], to = probes_bar_rank(b, o->part, j);
            if (to < from) to = b->rank[i], from = probes_bar_rank(b, o->part, j);
            between[from + 1] += force;
            if (to <= b->n) between[to] -= force;
            if (from >= 0) end[from] += 0.5 * force;
            if (to < b->n) end[to] += 0.5 * force;
        }
    }
}

void bar_probe_compute_bond_flux_stress(const struct bar *bar, const struct observed_run *o, real *stress)
{
    real *between = NEW("probes.between", bar->n + 1, real), *end = NEW("probes.end", bar->n + 1, real), crossing = 0;
    if (o->bonds && o->bonds->rows > 0) add_bonds(bar, o, between, end);
    for (int64_t k = 0; k < bar->n; k++) {
        crossing += between[k];
        stress[k] = o->part->kind[bar->order[k]] == KIND_PD ? (crossing + end[k]) / o->thickness
                                                            : o->part->stress[0][bar->order[k]];
    }
    memory_free(between);
    memory_free(end);
}

/* Computes b->strain of each particle of the bar b: central differences of displacement over its neighbours in the bar,
 * one-sided at the ends. p: all particles. */
static void measure_strain(struct bar *b, const struct particles *p)
{
    for (int64_t k = 0; k < b->n; k++) {
        int64_t left = k > 0 ? k - 1 : 0, right = k + 1 < b->n ? k + 1 : k;
        b->strain[k] =
            (b->displacement[right] - b->displacement[left]) / (p->X[0][b->order[right]] - p->X[0][b->order[left]]);
    }
}

void bar_probe_measure_fields(struct bar *bar, const struct observed_run *o)
{
    for (int64_t k = 0; k < bar->n; k++) {
        int32_t i = bar->order[k];
        bar->displacement[k] = o->part->x[0][i] - o->part->X[0][i];
        bar->velocity[k] = o->part->v[0][i];
    }
    measure_strain(bar, o->part);
    bar_probe_compute_bond_flux_stress(bar, o, bar->flux);
}

/* ---- profile ----------------------------------------------------------------------------------------------------- */

const struct column bar_reading[BAR_READINGS] = {{"x", "m"},
                                                 {"displacement", "m"},
                                                 {"velocity", "m/s"},
                                                 {"stress", "Pa"},
                                                 {"stress_strain", "Pa"},
                                                 {"strain", "1"},
                                                 {"damage", "1"},
                                                 {"kind", "1"},
                                                 {"exact_displacement", "m"},
                                                 {"exact_velocity", "m/s"},
                                                 {"exact_stress", "Pa"},
                                                 {"exact_strain", "1"}};

void bar_probe_compute_profile_line(const struct bar *bar, const struct observed_run *o, int64_t rank_from_left,
                                    real *value)
{
    int32_t i = bar->order[rank_from_left];
    struct exact_values e = bar_exact_solution_at_position(&bar->exact, o->part->X[0][i], o->t);
    real velocity = bar_exact_solution_at_position(&bar->exact, o->part->X[0][i], o->t_velocity).velocity;
    const real all[BAR_READINGS] = {o->part->X[0][i],
                                    bar->displacement[rank_from_left],
                                    bar->velocity[rank_from_left],
                                    bar->flux[rank_from_left],
                                    bar->exact.young * bar->strain[rank_from_left],
                                    bar->strain[rank_from_left],
                                    probe_damage_of_particle(o, i),
                                    o->part->kind[i],
                                    e.displacement,
                                    velocity,
                                    e.stress,
                                    e.strain};
    memcpy(value, all, sizeof all);
}

/* ---- results ----------------------------------------------------------------------------------------------------- */

/* Results of an EXACT probe, in the order of its table: errors, positions of fronts, values of plateaus. */
enum figure {
    L1,
    L2,
    FRONT,
    PLATEAU,
    END_DISPLACEMENT,
    FRONT_PLASTIC,
    STRAIN_ELASTIC,
    STRAIN_PLASTIC,
    L1_STRAIN,
    L2_STRAIN,
    FRONT_STRAIN,
    PLATEAU_STRAIN,
    L1_VELOCITY,
    L2_VELOCITY,
    L2_DISPLACEMENT,
    FIGURES
};

/* Sets of closed-form solutions for which a result of the EXACT probe exists, as bits 1 << EXACT_*. */
#define STEP (1 << EXACT_STEP_BAR)
#define PLASTIC (1 << EXACT_PLASTIC_BAR)
#define EVERY ((1 << EXACT_FORMS) - 1)

/* Values that an EXACT probe reports: name, unit, and the closed forms for which each exists. */
static const struct {
    const char *name, *unit;
    int forms;
} figures[FIGURES] = {
    [L1] = {"L1", "Pa", EVERY},                    /* mean |sigma - exact| over the particles */
    [L2] = {"L2", "Pa", EVERY},                    /* root mean square of sigma - exact */
    [FRONT] = {"front", "m", STEP | PLASTIC},      /* where sigma passes the middle of the first front's jump */
    [PLATEAU] = {"plateau", "Pa", STEP | PLASTIC}, /* mean sigma behind the last front */
    [END_DISPLACEMENT] = {"end_displacement", "m", STEP | PLASTIC}, /* of the outermost particle at the loaded end */
    [FRONT_PLASTIC] = {"front_plastic", "m", PLASTIC},
    [STRAIN_ELASTIC] = {"strain_elastic", "1", PLASTIC}, /* mean strain between precursor and plastic front */
    [STRAIN_PLASTIC] = {"strain_plastic", "1", PLASTIC}, /* mean strain behind the plastic front */
    [L1_STRAIN] = {"L1_strain", "Pa", EVERY},
    [L2_STRAIN] = {"L2_strain", "Pa", EVERY},
    [FRONT_STRAIN] = {"front_strain", "m", STEP | PLASTIC},
    [PLATEAU_STRAIN] = {"plateau_strain", "Pa", STEP},
    [L1_VELOCITY] = {"L1_velocity", "m/s", EVERY},
    [L2_VELOCITY] = {"L2_velocity", "m/s", EVERY},
    [L2_DISPLACEMENT] = {"L2_displacement", "m", EVERY},
};
_Static_assert((int)FIGURES <= (int)BAR_FIGURES_MAX, "room for the figures of a bar");

int bar_probe_value_count(enum exact_form closed_form)
{
    int n = 0;
    for (int k = 0; k < FIGURES; k++) n += figures[k].forms >> closed_form & 1;
    return n;
}

struct column bar_probe_value_column(enum exact_form closed_form, int value_number)
{
    struct column c = {0};
    int f = -1;
    do f++, value_number -= figures[f].forms >> closed_form & 1;
    while (value_number >= 0);
    snprintf(c.name, sizeof c.name, "%s", figures[f].name);
    snprintf(c.unit, sizeof c.unit, "%s", figures[f].unit);
    return c;
}

/* Computes the errors of the bar b in the run o against the closed form and stores them at their indices (enum figure)
 * in value[FIGURES]: L1 (mean |error|) and L2 (root mean square) of stress, of Young's modulus times strain, and of
 * velocity, and L2 of displacement. */
static void errors(const struct bar *b, const struct observed_run *o, real *value)
{
    real sum[7] = {0};
    for (int64_t k = 0; k < b->n; k++) {
        real X = o->part->X[0][b->order[k]];
        struct exact_values e = bar_exact_solution_at_position(&b->exact, X, o->t);
        real stress = b->flux[k] - e.stress, strain = b->exact.young * (b->strain[k] - e.strain);
        real velocity = b->velocity[k] - bar_exact_solution_at_position(&b->exact, X, o->t_velocity).velocity;
        sum[0] += fabs(stress), sum[1] += square(stress);
        sum[2] += fabs(strain), sum[3] += square(strain);
        sum[4] += fabs(velocity), sum[5] += square(velocity);
        sum[6] += square(b->displacement[k] - e.displacement);
    }
    const real n = (real)b->n;
    value[L1] = sum[0] / n, value[L2] = sqrt(sum[1] / n);
    value[L1_STRAIN] = sum[2] / n, value[L2_STRAIN] = sqrt(sum[3] / n);
    value[L1_VELOCITY] = sum[4] / n, value[L2_VELOCITY] = sqrt(sum[5] / n);
    value[L2_DISPLACEMENT] = sqrt(sum[6] / n);
}

/* Returns the measured position of the front f in a bar b [m]: the coordinate at which factor * field passes the mean
 * of the exact stresses before and behind the front, interpolated between particles of p. If there are several, returns
 * the one nearest to the exact front; NAN if there is none. field[b->n]: stress or strain of the particles from left to
 * right; factor: 1 for a stress, the elastic modulus [Pa] for a strain. The outermost particles are left out: the load
 * acts on them, and their bonds transmit only half of it. */
static real front_of(const struct bar *b, const struct particles *p, const struct exact_front *f, const real *field,
                     real factor)
{
    real half = 0.5 * (f->before + f->behind), sign = f->ahead * (f->behind > f->before ? -1 : 1), found = NAN;
    for (int64_t k = 2; k + 1 < b->n; k++) {
        real low = sign * (factor * field[k - 1] - half), high = sign * (factor * field[k] - half);
        if (!(low < 0 && high >= 0)) continue;
        real X = p->X[0][b->order[k - 1]], step = p->X[0][b->order[k]] - X, passage = X + step * low / (low - high);
        if (!(fabs(found - f->position) <= fabs(passage - f->position))) found = passage;
    }
    return found;
}

/* Returns the mean of field[b->n], values of the particles of bar b from left to right, over coordinates in p from
 * `from` to `to` [m]; NAN if no particle is there. */
static real mean_between(const struct bar *b, const struct particles *p, const real *field, real from, real to)
{
    real sum = 0, tolerance = 1e-9 * (b->exact.right - b->exact.left);
    int64_t n = 0;
    for (int64_t k = 0; k < b->n; k++) {
        real X = p->X[0][b->order[k]];
        if (X >= from - tolerance && X <= to + tolerance) sum += field[k], n++;
    }
    return n > 0 ? sum / (real)n : NAN;
}

/* Computes positions of stress fronts of bar b in the run o, and stresses and strains of the plateaus behind them, and
 * stores them at their indices (enum figure) in value[FIGURES]. Entries of fronts that do not exist at this time are
 * not changed. */
static void fronts(const struct bar *b, const struct observed_run *o, real *value)
{
    struct exact_front front[EXACT_FRONTS];
    const struct exact *e = &b->exact;
    int n = bar_exact_solution_compute_stress_fronts(e, o->t, front);
    real from, to;
    if (n > 0) value[FRONT] = front_of(b, o->part, &front[0], b->flux, 1);
    if (n > 0) value[FRONT_STRAIN] = front_of(b, o->part, &front[0], b->strain, e->young);
    if (n > 1) value[FRONT_PLASTIC] = front_of(b, o->part, &front[1], b->flux, 1);
    if (bar_exact_solution_find_constant_stress_range(e, o->t, EXACT_PLATEAU, &from, &to)) {
        value[PLATEAU] = mean_between(b, o->part, b->flux, from, to);
        value[STRAIN_PLASTIC] = mean_between(b, o->part, b->strain, from, to);
        value[PLATEAU_STRAIN] = e->young * value[STRAIN_PLASTIC];
    }
    if (bar_exact_solution_find_constant_stress_range(e, o->t, EXACT_PRECURSOR, &from, &to))
        value[STRAIN_ELASTIC] = mean_between(b, o->part, b->strain, from, to);
}

void bar_probe_compute_values(struct bar *bar, const struct observed_run *o, real *value)
{
    real all[FIGURES];
    int n = 0;
    for (int k = 0; k < FIGURES; k++) all[k] = NAN;
    bar_probe_measure_fields(bar, o);
    errors(bar, o, all);
    fronts(bar, o, all);
    if (bar->exact.loaded) all[END_DISPLACEMENT] = bar->displacement[bar->exact.loaded > 0 ? bar->n - 1 : 0];
    for (int k = 0; k < FIGURES; k++)
        if (figures[k].forms >> bar->exact.form & 1) value[n++] = all[k];
}
