/* floor 2: forces of state-based peridynamics: a sweep over the rows for what particles know of their families, one over
 * their bonds for the forces (state_laws.h). Owner computes in both; the same bits on any number of threads. */
#include <math.h>
#include <string.h>

#include "kernels/kernels.h"
#include "polar.h"
#include "polar_lanes.h"
#include "state_laws.h"
#include "sweep.h"
#include "turn.h"
#include "kernels/simd/variants.h"

/* ---- first sweep: what a particle knows of its family ---------------------------------------------------- */

/* Sums over the families of a group; `stretch` is the largest [1], `moved` has bits where somebody is not where it was: the
 * rotation of nothing is none, to the last bit. */
struct family_sums { lanes extension, stretch, moment[DIM_MAX * DIM_MAX]; lanes_mask moved; };

/* Adds a slot: sum w r e, with e = r (|Y|/r - 1), and sum w Y (x) xi. */
static ALWAYS_INLINE void know_slot(struct family_sums *sum, const struct particles *p, const struct slot slot, const lanes *x,
                                    const lanes *X, const int dim, const enum pd_model model)
{
    struct state_bond s;
    state_bond_make(&s, p, slot, x, X, dim, model);
    const lanes w = slot_weight(slot), stretch = STRETCH_OF(lanes_root(s.distance2), s.inverse_length);
    sum->stretch = slot_largest(slot, sum->stretch, stretch);
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

/* Moduli of eight rows, 1/Q and V/Q; nothing where a family has nothing left. */
struct own_family { lanes A, B, inverse, share; };     /* [Pa], [Pa], [1/m^2], [m] */

static ALWAYS_INLINE struct own_family own_family_of(const struct bonds *b, const struct particles *p, int64_t g)
{
    const int32_t *row = b->particle + g * LANES;
    const int32_t own = b->aligned[g] ? row[0] : -1;
    const struct state_modulus *m = &b->state.modulus[p->material[row[0]]];
    const lanes Q = lanes_load(b->state.weighted + g * LANES), inverse = lanes_choose(Q > 0.0, 1.0 / Q, lanes_of(0));
    struct own_family f = {lanes_of(m->A), lanes_of(m->B), inverse, lanes_at(p->volume0, own, row) * inverse};
    if (own >= 0 && eight_same(p->material + own)) return f;
    for (int l = 0; l < LANES; l++) m = &b->state.modulus[p->material[row[l]]], f.A[l] = m->A, f.B[l] = m->B;
    return f;
}

struct knowledge { lanes pressure, spring, turn[TURN]; };

/* What the rows of a group know. */
static ALWAYS_INLINE void know_store(struct bonds *b, int64_t g, const struct knowledge *k, const enum pd_model model)
{
    const int32_t *row = b->particle + g * LANES;
    const int rows = eight_at(g * LANES, b->rows);
    struct state *t = &b->state;
    rows_store(t->pressure, row, rows, b->aligned[g], k->pressure, 1);
    rows_store(t->spring, row, rows, b->aligned[g], k->spring, 1);
    for (int c = 0; state_turns(model) && c < TURN; c++) rows_store(t->turn[c], row, rows, b->aligned[g], k->turn[c], 1);
}

/* ---- material points at the end of bonds ----------------------------------------------------------------- */

/* Rows of a group that are material points. */
static ALWAYS_INLINE lanes_mask ends_of(const struct bonds *b, const struct particles *p, int64_t g)
{
    lanes_mask end;
    for (int l = 0; l < LANES; l++) end[l] = -(int64_t)(p->kind[b->particle[g * LANES + l]] == KIND_MPM);
    return end;
}

/* Rotations of their cells with the spring g, as turn.h keeps them; `back`: the inverse ones. */
static ALWAYS_INLINE void ends_turn(const struct particles *p, const int32_t *row, int32_t own, lanes spring, const bool back,
                                    lanes *turn, const int dim)
{
    const lanes scale = dim == 2 ? spring : lanes_root(2.0 * spring), axis = back ? -scale : scale;
    if (dim == 2) {
        turn[0] = turn[3] = scale * lanes_at(p->end_turn[0], own, row);
        turn[2] = axis * lanes_at(p->end_turn[1], own, row);
        turn[1] = -turn[2];
        return;
    }
    for (int c = 0; c < TURN; c++) turn[c] = (c < 3 ? axis : scale) * lanes_at(p->end_turn[c], own, row);
}

/* Moment about them, axial: of component ji less ij of g R^T M, M = sum w Y (x) xi. */
static ALWAYS_INLINE void ends_moment(struct particles *p, const int32_t *row, int rows, int32_t own, lanes_mask end,
                                      const struct family_sums *sum, lanes spring, const int dim)
{
    lanes N[DIM_MAX][DIM_MAX], turn[TURN], turned = lanes_of(0);
    ends_turn(p, row, own, spring, true, turn, dim);
    for (int c = 0; c < TURN; c++) turned += dim == 2 || c < 3 ? turn[c] * turn[c] : lanes_of(0);
    for (int c = 0; c < dim; c++) {              /* less g (R^T - 1) of a column of M, and g times that column */
        lanes less[DIM_MAX], column[DIM_MAX];
        for (int d = 0; d < dim; d++) column[d] = sum->moment[d * dim + c], less[d] = lanes_of(0);
        turn_off(less, turn, column, dim);
        for (int d = 0; d < dim; d++) N[d][c] = spring * column[d] - less[d];
    }
    const lanes_mask any = end & ((sum->moved != 0) | (turned != 0.0));     /* of nothing there is none, to the last bit */
    for (int k = dim == 2 ? 2 : 0, c = 0; k < 3; k++, c++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        rows_store(p->end_moment[c], row, rows, own >= 0, lanes_choose(any, N[j][i] - N[i][j], lanes_of(0)), 1);
    }
}

/* A material point has a family like all others, of which bonds know a part and its cells the rest: S is the sum of both. */
static __attribute__((noinline)) void ends_know(struct bonds *b, struct particles *p, int64_t g, const struct own_family *f,
                                                const struct family_sums *sum, struct knowledge *k, const int dim,
                                                const enum pd_model model)
{
    const lanes_mask end = ends_of(b, p, g);
    const int32_t *row = b->particle + g * LANES, own = b->aligned[g] ? row[0] : -1;
    const int rows = eight_at(g * LANES, b->rows);
    k->pressure += f->A * f->share * lanes_choose(end, lanes_at(p->end_strain, own, row), lanes_of(0));
    const lanes pull = lanes_choose(end, k->pressure * lanes_load(b->state.weighted + g * LANES), lanes_of(0));
    rows_store(p->end_pull, row, rows, own >= 0, pull, 1);
    if (!state_turns(model)) return;
    lanes turn[TURN];
    ends_turn(p, row, own, k->spring, false, turn, dim);
    for (int c = 0; c < TURN; c++) k->turn[c] = lanes_choose(end, turn[c], k->turn[c]);
    ends_moment(p, row, rows, own, end, sum, k->spring, dim);
}

/* ---- all rows -------------------------------------------------------------------------------------------- */

/* What a group's sums tell its particles. */
static ALWAYS_INLINE void know_by_family(struct bonds *b, struct particles *p, int64_t g, const struct family_sums *sum,
                                         const int dim, const enum pd_model model)
{
    const struct own_family f = own_family_of(b, p, g);
    struct knowledge k;
    k.pressure = f.A * sum->extension * f.inverse * f.share, k.spring = f.B * f.share;
    if (state_turns(model)) family_turn(k.turn, sum->moment, sum->moved, k.spring, dim);
    if (__builtin_expect(p->end_strain && !group_whole(b, g), 0)) {
        const struct family_sums seen = *sum;    /* what is called elsewhere takes copies: all others stay in registers */
        const struct own_family own = f;
        struct knowledge both = k;
        ends_know(b, p, g, &own, &seen, &both, dim, model);
        k = both;
    }
    know_store(b, g, &k, model);
}

/* Rows of one group. */
static ALWAYS_INLINE void know_group(struct bonds *b, struct particles *p, int64_t g, const int dim, const enum pd_model model)
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
#define VISIT(SLOT) know_slot(&sum, p, SLOT, x, X, dim, model)
    FOR_SLOTS(b, g, VISIT);
#undef VISIT
    b->state.past[g] = lanes_any(sum.stretch > lanes_load(b->trigger + g * LANES));
    know_by_family(b, p, g, &sum, dim, model);
}

/* Mirror images know what their source knows; a plane of symmetry turns rotations round. What clamped ones would answer is brought
 * back to their source by clamp_force.c, so they know nothing. */
static void state_of_images(struct bonds *b, const struct particles *p, int dim, bool turns)
{
    for (int64_t g = p->n; g < p->n_all; g++) {
        const int32_t i = b->state.image[g - p->n].source;
        const int axis = b->state.image[g - p->n].axis;
        const bool knows = axis >= 0;
        b->state.pressure[g] = knows ? b->state.pressure[i] : 0;
        b->state.spring[g] = knows ? b->state.spring[i] : 0;
        for (int c = 0; turns && c < TURN; c++)
            b->state.turn[c][g] = !knows ? 0 : turn_odd(c, axis, dim) ? -b->state.turn[c][i] : b->state.turn[c][i];
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
    static void state_know_##D##d_##M(struct bonds *b, struct particles *p)                                           \
    {                                                                                                                 \
        _Pragma("omp parallel for schedule(static)")                                                                  \
        for (int64_t k = 0; k < b->rest.awake; k++)                                                                   \
            know_group(b, p, b->rest.list[k], D, PD_##M);                                                             \
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
