/* Balance of energy and momentum, the first break, and the stability check. */
#include "probes/diagnostics.h"

#include <math.h>
#include <stdio.h>

#include "kernels/kernels.h"
#include "base/memory.h"
#include "fracture/places.h"
#include "kernels/mpm/stress.h"
#include "base/team.h"

void diagnostics_make(struct diagnostics *w)
{
    *w = (struct diagnostics){.break_time = NAN, .break_place = {NAN, NAN, NAN}, .driven_time = NAN,
                               .now.spin_error = NAN};
}

/* ---- sums over particles ----------------------------------------------------------------------------------------- */

/* Particles or nodes: masses [kg] and velocities [m/s]; entries with FLAG_MESHED do not count, `flag` NULL: all
 * count. */
struct movers { int dim; const real *mass; real *const *v; const uint8_t *flag; };

/* Sums skip particles moved by the nodes of a mesh this many at a time: few that do not count are visited. */
enum { MOTION_PIECE = 64 };

/* Are particles first .. end - 1 all moved by the nodes of a mesh? */
static bool all_meshed(const uint8_t *flag, int64_t first, int64_t end)
{
    uint8_t all = FLAG_MESHED;
    for (int64_t i = first; i < end; i++) all &= flag[i];
    return all != 0;
}

/* Kinetic energy [J], momentum by component and the sum of |m v| [kg m/s]; the sums of a piece stay in registers. */
struct motion { real kinetic, momentum[DIM_MAX], size; };

/* Adds the motion of entries first .. end - 1; `meshed`: flags are tested, `all`: momentum and |m v|, too. */
static ALWAYS_INLINE void add_motion(const struct movers *m, int64_t first, int64_t end, struct motion *to,
                                     const int dim, const bool meshed, const bool all)
{
    const real *mass = m->mass, *v0 = m->v[0], *v1 = m->v[dim > 1], *v2 = m->v[dim > 2 ? 2 : 0];
    const uint8_t *flag = m->flag;
    real kinetic = 0, p0 = 0, p1 = 0, p2 = 0, size = 0;
#pragma omp simd reduction(+ : kinetic, p0, p1, p2, size)
    for (int64_t i = first; i < end; i++) {
        const real own = meshed && flag[i] & FLAG_MESHED ? 0 : mass[i];
        const real speed2 = square(v0[i]) + (dim > 1 ? square(v1[i]) : 0) + (dim > 2 ? square(v2[i]) : 0);
        kinetic += own * speed2;
        if (!all) continue;
        p0 += own * v0[i];
        if (dim > 1) p1 += own * v1[i];
        if (dim > 2) p2 += own * v2[i];
        size += own * sqrt(speed2);
    }
    to->kinetic += 0.5 * kinetic, to->size += size;
    to->momentum[0] += p0, to->momentum[1] += p1, to->momentum[2] += p2;
}

static ALWAYS_INLINE void motion_piece(const struct movers *m, int64_t first, int64_t end, struct motion *to,
                                       const bool all)
{
    const bool meshed = m->flag != NULL;
    if (meshed && all_meshed(m->flag, first, end)) return;
    switch (m->dim) {
    case 1: meshed ? add_motion(m, first, end, to, 1, true, all) : add_motion(m, first, end, to, 1, false, all); break;
    case 2: meshed ? add_motion(m, first, end, to, 2, true, all) : add_motion(m, first, end, to, 2, false, all); break;
    default: meshed ? add_motion(m, first, end, to, 3, true, all) : add_motion(m, first, end, to, 3, false, all); break;
    }
}

/* Have nodes first .. end - 1 no mass? Coarse cells leave most of those of level 0 so. */
static bool none_has_mass(const real *mass, int64_t first, int64_t end)
{
    real most = 0;
#pragma omp simd reduction(max : most)
    for (int64_t I = first; I < end; I++) most = mass[I] > most ? mass[I] : most;
    return most == 0;
}

/* Motion of entries first .. end - 1: all sums, or the kinetic energy alone, which needs no roots. */
static ALWAYS_INLINE struct motion diagnostics_motion_of(const struct movers *m, int64_t first, int64_t end,
                                                         const bool all)
{
    struct motion sum = {0};
    if (m->flag ? all_meshed(m->flag, first, end) : none_has_mass(m->mass, first, end)) return sum;
    for (int64_t to; first < end; first = to) {
        to = first + MOTION_PIECE < end ? first + MOTION_PIECE : end;
        motion_piece(m, first, to, &sum, all);
    }
    return sum;
}

static void diagnostics_kinetic_block(const void *context, int64_t first, int64_t end, real *sum)
{
    sum[0] += diagnostics_motion_of(context, first, end, false).kinetic;
}

static struct movers diagnostics_movers_of(const struct particles *p)
{
    return (struct movers){p->dim, p->mass, p->v, p->flag};
}

real diagnostics_kinetic(const struct particles *p)
{
    const struct movers m = diagnostics_movers_of(p);
    real kinetic;
    team_sums(p->n, 1, diagnostics_kinetic_block, &m, &kinetic);
    return kinetic;
}

struct kick { const struct particles *p; real *const *before; real dt; };

/* Adds a quarter of m (change of velocity)^2 of particles first .. end - 1 to the sum [J]. Driven particles are left
 * out: they move as prescribed, and their work is booked as they move. */
static real kick_piece(const struct kick *k, int64_t first, int64_t end, real sum)
{
    const struct particles *p = k->p;
    for (int64_t i = first; i < end; i++) {
        if (p->flag[i] & FLAG_DRIVEN || (k->before ? p->flag[i] & FLAG_MESHED : particle_on_grid(p, i))) continue;
        real change2 = 0;
        for (int d = 0; d < p->dim; d++)
            change2 += square(k->before ? p->v[d][i] - k->before[d][i] : k->dt * p->f[d][i] / p->mass[i]);
        sum += 0.25 * p->mass[i] * change2;
    }
    return sum;
}

/* That of a block. What is moved by nodes does not count. */
static void diagnostics_kick_block(const void *context, int64_t first, int64_t end, real *sum)
{
    const struct kick *k = context;
    if (all_meshed(k->p->flag, first, end)) return;
    for (int64_t to; first < end; first = to) {
        to = first + MOTION_PIECE < end ? first + MOTION_PIECE : end;
        if (!all_meshed(k->p->flag, first, to)) sum[0] = kick_piece(k, first, to, sum[0]);
    }
}

real diagnostics_kick(const struct particles *p, real *const *before, real dt)
{
    real sum;
    team_sums(p->n, 1, diagnostics_kick_block, &(struct kick){p, before, dt}, &sum);
    return sum;
}

/* Momentum by component, and behind them the sum of |m v|. */
static void momentum_block(const void *context, int64_t first, int64_t end, real *sum)
{
    const struct movers *m = context;
    const struct motion motion = diagnostics_motion_of(m, first, end, true);
    for (int d = 0; d < m->dim; d++) sum[d] += motion.momentum[d];
    sum[m->dim] += motion.size;
}

/* ---- strain energy and plastic work of material points ----------------------------------------------------------- */

struct strain_sum {
    const struct particles *p;
    const struct material *m;
    const struct partial_stress *partial;
    const int32_t *list;
    real (*compliance)[SYM_MAX * SYM_MAX];   /* by material */
};

/* Share of its energies that point i keeps where it leaves part of its stress to bonds, 1 - tr M/n [1]: exact where
 * that part is equal for all stresses, as in one dimension. */
static real own_share(const struct strain_sum *s, int64_t i)
{
    const struct partial_stress *partial = s->partial;
    if (!partial || !partial->index || partial->index[i] < 0) return 1;
    const int n = symmetric_count(s->p->dim);
    const real *M = partial->matrix + (int64_t)partial->index[i] * n * n;
    real trace = 0;
    for (int a = 0; a < n; a++) trace += M[a * n + a];
    return 1 - trace / n;
}

/* Additional strain energy in plane strain after plastic flow [J]: with sigma_zz = nu (sigma_xx + sigma_yy) + delta the
 * energy per volume has the additional term delta^2/(2E). */
static real out_of_plane_energy(const struct strain_sum *s, int64_t i)
{
    if (!s->p->out_of_plane) return 0;
    return own_share(s, i) * square(s->p->out_of_plane[i]) / (2 * s->m[s->p->material[i]].young) * s->p->volume[i];
}

/* Strain energy of the k-th listed particle on the grid [J]; 0 of peridynamic particles. */
static real strain_term(const void *context, int64_t k)
{
    const struct strain_sum *s = context;
    const struct particles *p = s->p;
    int64_t i = s->list[k];
    int n = symmetric_count(p->dim);
    if (p->kind[i] != KIND_MPM) return 0;
    real stress[SYM_MAX], given[SYM_MAX], sum = 0;
    for (int a = 0; a < n; a++) stress[a] = p->stress[a][i];
    stress_given(p, s->partial, i, given, p->dim);
    for (int a = 0; a < n; a++) {
        real strain = 0, times = a < p->dim ? 1 : 2;         /* a shear component stands for two */
        for (int b = 0; b < n; b++) strain += s->compliance[p->material[i]][a * n + b] * stress[b];
        sum += times * given[a] * strain;
    }
    return 0.5 * sum * p->volume[i] + out_of_plane_energy(s, i);
}

real diagnostics_strain_of(const struct particles *p, const struct material *m, const struct partial_stress *partial,
                     const int32_t *list, int64_t n)
{
    int materials = 0;
    for (int64_t k = 0; k < n; k++)
        if (p->material[list[k]] >= materials) materials = p->material[list[k]] + 1;
    struct strain_sum s = {.p = p, .m = m, .partial = partial, .list = list};
    s.compliance = memory_new("diagnostics.compliance", materials, sizeof *s.compliance);
    for (int k = 0; k < materials; k++) material_compliance(&m[k], p->dim, s.compliance[k]);
    real sum = team_sum(n, strain_term, &s);
    memory_free(s.compliance);
    return sum;
}

real diagnostics_strain(const struct particles *p, const struct material *m, const struct partial_stress *partial)
{
    return diagnostics_strain_of(p, m, partial, p->list_free, p->n_free);
}

/* Plastic work of a point, V times the integral of (sigma_y + H a) da [J]. */
static real diagnostics_plastic_term(const void *context, int64_t k)
{
    const struct strain_sum *s = context;
    const struct particles *p = s->p;
    int64_t i = s->list[k];
    const struct material *m = &s->m[p->material[i]];
    const real a = p->plastic_strain[i];
    if (a == 0) return 0;
    const real volume = p->flag[i] & FLAG_MESHED ? p->volume0[i] : p->volume[i];
    return own_share(s, i) * volume * (m->yield_stress + 0.5 * m->yield_hardening * a) * a;
}

real diagnostics_plastic(const struct particles *p, const struct material *m, const struct partial_stress *partial)
{
    if (!p->plastic_strain) return 0;
    return team_sum(p->n_of[KIND_MPM], diagnostics_plastic_term,
                    &(struct strain_sum){.p = p, .m = m, .partial = partial, .list = p->list[KIND_MPM]});
}

/* ---- the energy balance ------------------------------------------------------------------------------------------ */

real diagnostics_momentum_of(const struct particles *p, const struct grid *const *nodes, int grids, real *momentum)
{
    const struct movers m = diagnostics_movers_of(p);
    real sum[DIM_MAX + 1], more[DIM_MAX + 1];
    team_sums(p->n, p->dim + 1, momentum_block, &m, sum);
    for (int g = 0; g < grids && nodes[g]->n > 0; g++) {
        const struct movers n = {nodes[g]->dim, nodes[g]->mass, nodes[g]->velocity, NULL};
        team_sums(nodes[g]->n, p->dim + 1, momentum_block, &n, more);
        for (int k = 0; k <= p->dim; k++) sum[k] += more[k];
    }
    for (int d = 0; d < p->dim; d++) momentum[d] = sum[d];
    return sum[p->dim];
}

/* The error is the momentum, of particles and nodes, that was neither present at the start nor supplied since. */
void diagnostics_momentum(struct diagnostics *w, const struct particles *p, const struct grid *const *nodes, int grids,
                          const real *impulse)
{
    const real size = diagnostics_momentum_of(p, nodes, grids, w->now.momentum);
    real missing2 = 0;
    for (int d = 0; d < p->dim; d++) {
        if (!w->started) w->momentum_start[d] = w->now.momentum[d] - impulse[d];
        missing2 += square(w->now.momentum[d] - w->momentum_start[d] - impulse[d]);
    }
    w->momentum_scale = real_max(w->momentum_scale, size);
    if (w->momentum_scale > 0)
        w->now.momentum_error = real_max(w->now.momentum_error, sqrt(missing2) / w->momentum_scale);
}

real diagnostics_energy_change(const struct diagnostics *w)
{
    if (!(w->energy_start > 0)) return NAN;
    return (energy_sum(&w->now.energy) - w->now.energy.damped - w->now.external_work) / w->energy_start - 1;
}

/* Error of the energy balance, relative to the largest energy or work so far. */
static void balance_of(struct diagnostics *w)
{
    struct energy_balance *l = &w->now;
    real energy = energy_sum(&l->energy);
    if (!w->started) w->energy_start = energy - l->external_work;
    const real size = energy_size(&l->energy);
    w->energy_scale = real_max(w->energy_scale, real_max(size, fabs(l->external_work)));
    l->balance_error = w->energy_scale > 0 ? (energy - w->energy_start - l->external_work) / w->energy_scale : 0;
}

void diagnostics_balance(struct diagnostics *w, real t, const struct energy *energy, real work)
{
    w->now.time = t;
    w->now.energy = *energy;
    w->now.external_work = work;
    balance_of(w);
    w->started = true;
}

/* ---- the first break --------------------------------------------------------------------------------------------- */

int64_t diagnostics_break_place(const struct particles *p, const int32_t *list, int64_t n, real horizon, real *middle)
{
    const real along[DIM_MAX] = {0};
    int64_t cut = 0;
    for (int64_t k = 0; k < n; k++) cut += (p->flag[list ? list[k] : k] & FLAG_CRACKED) != 0;
    if (cut == 0) return 0;
    struct place *place = NEW("diagnostics.cut", cut, struct place);
    cut = 0;
    for (int64_t k = 0; k < n; k++) {
        const int64_t i = list ? list[k] : k;
        if (p->flag[i] & FLAG_CRACKED) particle_place(p, i, place[cut++].X);
    }
    const int64_t ends = places_middle(place, cut, p->dim, horizon * (1 + 1e-6), along, middle);
    memory_free(place);
    return ends;
}

static bool driven_breaks(const struct particles *p)
{
    const uint8_t both = FLAG_DRIVEN | FLAG_LOST_BOND;
    for (int64_t i = 0; i < p->n; i++)
        if ((p->flag[i] & both) == both) return true;
    return false;
}

bool diagnostics_breaks(struct diagnostics *w, const struct particles *p, real horizon, int64_t broken, real t)
{
    w->bonds_broken += broken;
    if (broken == 0) return false;
    if (isnan(w->break_time)) {
        w->break_ends = diagnostics_break_place(p, NULL, p->n, horizon, w->break_place);
        if (w->break_ends > 0) w->break_time = t;
    }
    const bool tears = isnan(w->driven_time) && driven_breaks(p);
    if (tears) w->driven_time = t;
    return tears;
}

/* ---- stability check --------------------------------------------------------------------------------------------- */

/* Has particle i diverged? */
static bool diagnostics_particle_diverged(const struct particles *p, int64_t i, real limit)
{
    const int32_t alone[1] = {(int32_t)i};
    return particles_diverged(p, alone, 1, limit);
}

/* FAILED, with the place of particle i, the step and the cause. */
static status divergence_report(const struct particles *p, int64_t i, real limit, int64_t step, real t)
{
    char place[128];
    real speed2 = 0;
    int used = 0;
    for (int d = 0; d < p->dim; d++) {
        speed2 += square(p->v[d][i]);
        used += snprintf(place + used, sizeof place - (size_t)used, "%s%.6g", d > 0 ? ", " : "", p->X[d][i]);
    }
    char what[128];
    if (isfinite(speed2) && speed2 > limit * limit)
        snprintf(what, sizeof what, "moves at %.3g m/s, faster than the wave speed %.4g m/s", sqrt(speed2), limit);
    else snprintf(what, sizeof what, "has a position or velocity that is no finite number");
    return status_set(FAILED, "unstable at step %lld, t = %.3g s: particle %d at (%s) m %s", (long long)step, t,
                      (int)p->id[i], place, what);
}

real diagnostics_fastest(const struct particles *p, const int32_t *list, int64_t n)
{
    real most = 0;
#pragma omp parallel for schedule(static) reduction(max : most)
    for (int64_t k = 0; k < n; k++) {
        real speed2 = 0;
        for (int d = 0; d < p->dim; d++) speed2 += square(p->v[d][list[k]]);
        most = real_max(most, speed2);
    }
    return sqrt(most);
}

/* First of the listed particles that has diverged, n_all if none has. */
static int64_t first_diverged(const struct particles *p, const int32_t *list, int64_t n, real limit)
{
    if (!particles_diverged(p, list, n, limit)) return p->n_all;
    int64_t k = 0;
    while (!diagnostics_particle_diverged(p, list[k], limit)) k++;
    return list[k];
}

status diagnostics_divergence(const struct particles *p, bool peridynamic, bool meshed, real limit, int64_t step,
                              real t)
{
    INVARIANT(limit > 0);
    int64_t first = peridynamic ? first_diverged(p, p->list[KIND_PD], p->n_of[KIND_PD], limit) : p->n_all;
    const int64_t free = meshed ? first_diverged(p, p->list[KIND_MPM], p->n_of[KIND_MPM], limit)
                                    : first_diverged(p, p->list_free, p->n_free, limit);
    if (free < first) first = free;
    return first < p->n ? divergence_report(p, first, limit, step, t) : OK;
}

status diagnostics_archive(struct diagnostics *w, struct archive *a)
{
    ARCHIVE_VALUE(a, "diagnostics/now", w->now);
    ARCHIVE_VALUE(a, "diagnostics/energy_start", w->energy_start);
    ARCHIVE_VALUE(a, "diagnostics/energy_scale", w->energy_scale);
    ARCHIVE_VALUE(a, "diagnostics/momentum_start", w->momentum_start);
    ARCHIVE_VALUE(a, "diagnostics/momentum_scale", w->momentum_scale);
    ARCHIVE_VALUE(a, "diagnostics/spin_start", w->spin_start);
    ARCHIVE_VALUE(a, "diagnostics/spin_scale", w->spin_scale);
    ARCHIVE_VALUE(a, "diagnostics/turns", w->turns);
    ARCHIVE_VALUE(a, "diagnostics/started", w->started);
    ARCHIVE_VALUE(a, "diagnostics/break_time", w->break_time);
    ARCHIVE_VALUE(a, "diagnostics/break_place", w->break_place);
    ARCHIVE_VALUE(a, "diagnostics/break_ends", w->break_ends);
    ARCHIVE_VALUE(a, "diagnostics/driven_time", w->driven_time);
    ARCHIVE_VALUE(a, "diagnostics/bonds_broken", w->bonds_broken);
    return OK;
}
