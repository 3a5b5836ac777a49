/* floor 2: forces of state-based peridynamics: a sweep over the rows for what particles know of their families, one over
 * their bonds for the forces (state_laws.h). Owner computes in both; the same bits on any number of threads. */
#include <math.h>
#include <string.h>

#include "kernels.h"
#include "polar.h"
#include "polar_lanes.h"
#include "state_laws.h"
#include "sweep.h"
#include "turn.h"
#include "variants.h"

/* ---- first sweep: what a particle knows of its family ---------------------------------------------------- */

/* Sums over the families of a group; `stretch` is the largest [1], `moved` has bits where somebody is not where it was: the
 * rotation of nothing is none, to the last bit. */
struct family_sums { lanes extension, stretch, moment[DIM_MAX * DIM_MAX]; lanes_mask moved; };

/* Adds a slot: sum w r e, with e = r (|Y|/r - 1), and sum w Y (x) xi. */
static ALWAYS_INLINE void know_slot(struct family_sums *sum, const struct particles *p, const struct slot slot, const lanes *x,
                                    const lanes *X, const bool knows, const int dim, const enum pd_model model)
{
    struct state_bond s;
    state_bond_make(&s, p, slot, x, X, dim, model);
    const lanes w = slot_weight(slot), stretch = STRETCH_OF(lanes_root(s.distance2), s.inverse_length);
    sum->stretch = slot_largest(slot, sum->stretch, stretch);
    if (!knows) return;
    sum->extension += state_weight(slot, w, s.inverse_length, true) * stretch;
    if (!state_turns(model)) return;
    for (int c = 0; c < dim; c++) {
        const lanes weighted = slot_weighted_reference(slot, c, w, s.xi[c]);
        const lanes_mask moved = (lanes_mask)s.y[c] ^ (lanes_mask)s.xi[c];
        sum->moved |= slot.kind >= SLOT_WHOLE ? moved : moved & (w > 0.0);        /* padding may look at anybody */
        for (int d = 0; d < dim; d++) sum->moment[d * dim + c] += weighted * s.y[d];
    }
}

/* The rotation nearest to the moment; where nobody has moved it is none, to the last bit. */
static ALWAYS_INLINE void family_turn(lanes *turn, const lanes *moment, lanes_mask moved, lanes spring, const int dim)
{
    lanes R[DIM_MAX * DIM_MAX];
    polar_rotation_lanes(moment, R, dim);
    for (int c = 0; c < dim * dim; c++) R[c] = lanes_choose(moved != 0, R[c], lanes_of(c % (dim + 1) == 0));
    turn_make(turn, R, spring, dim);
}

/* Moduli of eight rows and V/Q [m]; nothing where a family has nothing left. */
struct own_family { lanes A, B, bulk, inverse, share; };

static ALWAYS_INLINE struct own_family own_family_of(const struct bonds *b, const struct particles *p, int64_t g)
{
    const int32_t *row = b->particle + g * LANES;
    const int32_t own = b->aligned[g] ? row[0] : -1;
    const struct state_modulus *m = &b->state.modulus[p->material[row[0]]];
    const lanes Q = lanes_load(b->state.weighted + g * LANES), inverse = lanes_choose(Q > 0.0, 1.0 / Q, lanes_of(0));
    struct own_family f = {lanes_of(m->A), lanes_of(m->B), lanes_of(m->bulk), inverse, lanes_at(p->volume0, own, row) * inverse};
    if (own >= 0 && eight_same(p->material + own)) return f;
    for (int l = 0; l < LANES; l++) m = &b->state.modulus[p->material[row[l]]], f.A[l] = m->A, f.B[l] = m->B, f.bulk[l] = m->bulk;
    return f;
}

struct knowledge { lanes pressure, spring, turn[TURN]; };

/* What those rows of a group know that are of one kind. */
static ALWAYS_INLINE void know_store(struct bonds *b, const struct particles *p, int64_t g, const struct knowledge *k,
                                     const enum kind kind, const enum pd_model model)
{
    const int32_t *row = b->particle + g * LANES;
    const uint8_t *whole = b->whole + g * LANES;
    struct state *t = &b->state;
    if (b->aligned[g] && eight_same(whole) && (kind == KIND_PD) == whole[0]) {
        lanes_store(t->pressure + row[0], k->pressure);
        lanes_store(t->spring + row[0], k->spring);
        for (int c = 0; state_turns(model) && c < TURN; c++) lanes_store(t->turn[c] + row[0], k->turn[c]);
        return;
    }
    for (int l = 0; l < LANES && g * LANES + l < b->rows; l++) {
        const int32_t i = row[l];
        if (p->kind[i] != kind) continue;
        t->pressure[i] = k->pressure[l];
        t->spring[i] = k->spring[l];
        for (int c = 0; state_turns(model) && c < TURN; c++) t->turn[c][i] = k->turn[c][l];
    }
}

/* What a group's sums tell its peridynamic particles. */
static ALWAYS_INLINE void know_by_family(struct bonds *b, const struct particles *p, int64_t g, const struct family_sums *sum,
                                         const int dim, const enum pd_model model)
{
    const struct own_family f = own_family_of(b, p, g);
    struct knowledge k;
    k.pressure = f.A * sum->extension * f.inverse * f.share, k.spring = f.B * f.share;
    if (state_turns(model)) family_turn(k.turn, sum->moment, sum->moved, k.spring, dim);
    know_store(b, p, g, &k, KIND_PD, model);
}

/* Rows of one group; `knows`: there are peridynamic particles among them. Else only who is past its limit is looked for. */
static ALWAYS_INLINE void know_group(struct bonds *b, const struct particles *p, int64_t g, const bool knows, const int dim,
                                     const enum pd_model model)
{
    const int32_t *row = b->particle + g * LANES;
    const int32_t own = b->aligned[g] ? row[0] : -1;
    lanes x[DIM_MAX], X[DIM_MAX];
    struct family_sums sum;
    sum.extension = lanes_of(0), sum.stretch = lanes_of(-1), sum.moved = (lanes_mask)lanes_of(0);
    for (int c = 0; c < dim * dim; c++) sum.moment[c] = lanes_of(0);
    for (int d = 0; d < dim; d++) {
        x[d] = lanes_at(p->x[d], own, row);
        if (state_turns(model)) X[d] = lanes_at(p->X[d], own, row);
    }
#define VISIT(SLOT) know_slot(&sum, p, SLOT, x, X, knows, dim, model)
    FOR_SLOTS(b, g, VISIT);
#undef VISIT
    b->state.past[g] = lanes_any(sum.stretch > lanes_load(b->trigger + g * LANES));
    if (knows) know_by_family(b, p, g, &sum, dim, model);
}

static ALWAYS_INLINE void state_group(struct bonds *b, const struct particles *p, int64_t g, const int dim,
                                      const enum pd_model model)
{
    const uint8_t *whole = b->whole + g * LANES;         /* 0 of padding rows */
    if (whole[0] || !eight_same(whole)) know_group(b, p, g, true, dim, model);
    else know_group(b, p, g, false, dim, model);
}

/* Adds a slot to the mean rotation that neighbours have. */
static ALWAYS_INLINE void turned_slot(struct turn_sums *sum, const struct slot slot, const int dim)
{
    const struct state *t = &slot.b->state;
    lanes turn[TURN];
    for (int c = 0; c < TURN; c++)
        if (turn_reads(c, dim)) turn[c] = slot_at(slot, t->turn[c]);
    turn_add(sum, turn, slot_at(slot, t->spring), slot_weight(slot), dim);
}

/* The mean rotation that the neighbours of eight rows have, by their springs. */
static ALWAYS_INLINE void turned_group(const struct bonds *b, int64_t g, lanes *turn, lanes spring, const int dim)
{
    struct turn_sums sum;
    lanes moment[DIM_MAX * DIM_MAX];
    turn_sums_make(&sum);
#define VISIT(SLOT) turned_slot(&sum, SLOT, dim)
    FOR_SLOTS(b, g, VISIT);
#undef VISIT
    const lanes_mask turned = turn_moment(moment, &sum, dim);
    family_turn(turn, moment, turned, spring, dim);
}

/* A material point has the mean strain that its stress tells, and the mean rotation of the particles it is bonded to. */
static ALWAYS_INLINE void state_of_points(struct bonds *b, const struct particles *p, int64_t g, const int dim,
                                          const enum pd_model model)
{
    const int32_t *row = b->particle + g * LANES;
    const int32_t own = b->aligned[g] ? row[0] : -1;
    if (group_whole(b, g)) return;
    const struct own_family f = own_family_of(b, p, g);
    struct knowledge k;
    lanes trace = lanes_of(0);
    for (int d = 0; d < dim; d++) trace += lanes_at(p->stress[d], own, row);
    k.pressure = f.A * trace / (dim * dim * f.bulk) * f.share, k.spring = f.B * f.share;
    if (state_turns(model)) turned_group(b, g, k.turn, k.spring, dim);
    know_store(b, p, g, &k, KIND_MPM, model);
}

/* Mirror images know what their source knows; a plane of symmetry turns rotations round. */
static void state_of_images(struct bonds *b, const struct particles *p, int dim, bool turns)
{
    for (int64_t g = p->n; g < p->n_all; g++) {
        const int32_t i = b->state.image[g - p->n].source;
        const int axis = b->state.image[g - p->n].axis;
        b->state.pressure[g] = b->state.pressure[i];
        b->state.spring[g] = b->state.spring[i];
        for (int c = 0; turns && c < TURN; c++)
            b->state.turn[c][g] = turn_odd(c, axis, dim) ? -b->state.turn[c][i] : b->state.turn[c][i];
    }
}

/* ---- second sweep: forces -------------------------------------------------------------------------------- */

/* A group while its slots are visited; `arm` is sum w xi, which turns with the rotation of the row's own particle. */
struct state_sums { lanes x[DIM_MAX], X[DIM_MAX], f[DIM_MAX], arm[DIM_MAX], pressure, spring; };

/* Adds the forces of a slot. With the share q = e/|Y| that e has in |Y|, r/|Y| is 1 - q, and w (r P + e g)/|Y| is
 * w [P + (g - P) q]: two products less than with the stretch. The effective displacement Y - R xi is (Y - xi) - (R - 1) xi: exactly
 * 0 where nothing has moved. What the rows' own rotations add follows from the sum of arms (force_group). */
static ALWAYS_INLINE void force_slot(struct state_sums *sum, const struct particles *p, const struct slot slot, const int dim,
                                     const enum pd_model model)
{
    const struct state *t = &slot.b->state;
    struct state_bond s;
    state_bond_make(&s, p, slot, sum->x, sum->X, dim, model);
    const lanes inverse = lanes_inverse_root(s.distance2);
    const lanes w = slot_weight(slot);
    const lanes pressure = sum->pressure + slot_at(slot, t->pressure);
    const lanes spring = sum->spring + slot_at(slot, t->spring);
    if (!state_turns(model)) {
        const lanes share = SHARE_OF(state_length(slot, s.inverse_length), inverse);
        const lanes along = w * (pressure + (spring - pressure) * share);
        for (int d = 0; d < dim; d++) sum->f[d] += along * s.y[d];
        return;
    }
    const lanes along = state_weight(slot, w, s.inverse_length, false) * pressure * inverse, weighted = w * spring;
    lanes turn[TURN], arm[DIM_MAX], f[DIM_MAX];
    for (int c = 0; c < TURN; c++)
        if (turn_reads(c, dim)) turn[c] = slot_at(slot, t->turn[c]);
    for (int d = 0; d < dim; d++) {
        arm[d] = slot_weighted_reference(slot, d, w, s.xi[d]);
        sum->arm[d] += arm[d];
        f[d] = along * s.y[d] + weighted * (s.y[d] - s.xi[d]);
    }
    turn_off(f, turn, arm, dim);
    for (int d = 0; d < dim; d++) sum->f[d] += f[d];     /* one addition a slot: the chain is as short as can be */
}

/* Force of one group, mixed into what f holds by `share`. */
static ALWAYS_INLINE void force_group(const struct bonds *b, struct particles *p, int64_t g, const real share,
                                      const int dim, const enum pd_model model)
{
    const int32_t *row = b->particle + g * LANES;
    const int32_t own = b->aligned[g] ? row[0] : -1;
    const int rows = eight_at(g * LANES, b->rows);
    const struct state *t = &b->state;
    struct state_sums sum;
    sum.pressure = lanes_at(t->pressure, own, row), sum.spring = lanes_at(t->spring, own, row);
    for (int d = 0; d < dim; d++) {
        sum.x[d] = lanes_at(p->x[d], own, row), sum.f[d] = sum.arm[d] = lanes_of(0);
        if (state_turns(model)) sum.X[d] = lanes_at(p->X[d], own, row);
    }
#define VISIT(SLOT) force_slot(&sum, p, SLOT, dim, model)
    FOR_SLOTS(b, g, VISIT);
#undef VISIT
    if (state_turns(model)) {
        lanes turn[TURN];
        for (int c = 0; c < TURN; c++) turn[c] = lanes_at(t->turn[c], own, row);
        turn_off(sum.f, turn, sum.arm, dim);
    }
    for (int d = 0; d < dim; d++) rows_store(p->f[d], row, rows, own >= 0, sum.f[d], share);
}

/* Force of one group and the breaking of its bonds; returns how many broke. */
static ALWAYS_INLINE int64_t force_and_break(struct bonds *b, struct particles *p, const struct bond_limit *limit, int64_t g,
                                             const int dim, const enum pd_model model)
{
    force_group(b, p, g, 1, dim, model);
    if (!b->state.past[g]) return 0;
    const int64_t broken = bond_break_group(b, p, limit, g);
    if (broken > 0 && !limit->whole_force) force_group(b, p, g, 0.5, dim, model);
    return broken;
}

#define INSTANCE(D, M)                                                                                                \
    static void state_know_##D##d_##M(struct bonds *b, const struct particles *p)                                     \
    {                                                                                                                 \
        _Pragma("omp parallel for schedule(static)")                                                                  \
        for (int64_t k = 0; k < b->rest.awake; k++)                                                                   \
            state_group(b, p, b->rest.list[k], D, PD_##M);                                                            \
        if (state_turns(PD_##M) && p->n_of[KIND_PD] < p->n) state_of_images(b, p, D, true);   /* points look at them */ \
        _Pragma("omp parallel for schedule(static)")                                                                  \
        for (int64_t g = 0; g < b->groups; g++) state_of_points(b, p, g, D, PD_##M);                                  \
        state_of_images(b, p, D, state_turns(PD_##M));                                                                \
    }                                                                                                                 \
    static int64_t state_force_##D##d_##M(struct bonds *b, struct particles *p, const struct bond_limit *limit,       \
                                          struct pd_motion *m)                                                        \
    {                                                                                                                 \
        state_know_##D##d_##M(b, p);                                                                                  \
        SWEEP(b, p, m, D, force_and_break(b, p, limit, group, D, PD_##M));                                            \
    }
STATE_VARIANTS(INSTANCE)

#define ENTRY(D, M) [D][PD_##M] = state_force_##D##d_##M,
bond_force_fn *const state_force_table[DIM_MAX + 1][PD_MODELS] = {STATE_VARIANTS(ENTRY)};

#define KNOW(D, M) [D][PD_##M] = state_know_##D##d_##M,
state_know_fn *const state_know_table[DIM_MAX + 1][PD_MODELS] = {STATE_VARIANTS(KNOW)};
