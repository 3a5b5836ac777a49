/* Computes the forces of state-based peridynamics (state_laws.h). A first loop over the rows (a row: all bonds of one
 * particle) computes the state of each neighbourhood: pressure, spring stiffness and rotation. A second loop computes
 * the forces of bonds from these states. In both loops each row is written by one thread, so that results have equal
 * bits on any number of threads. */
#include <math.h>
#include <string.h>

#define ROWS_IN_PARTS /* vectors of WIDE rows */
#include "bond_core.h"
#include "kernels/kernels.h"
#include "base/polar.h"
#include "polar_lanes.h"
#include "state_last.h"
#include "state_laws.h"
#include "sweep.h"
#include "rotation.h"
#include "kernels/simd/variants.h"

/* ---- first sweep: states of neighbourhoods ----------------------------------------------------------------------- */

/* Sums over the neighbourhoods of the eight particles of a block of eight rows: extension, sum w r e; moment, sum w Y
 * (x) xi; largest (stretch) and smallest (press) stretch of the bonds [1]; moved: nonzero in a lane where a bond vector
 * differs from its reference, so that an undeformed neighbourhood has exactly no rotation. */
struct family_sums {
    lanes extension, stretch, press, moment[DIM_MAX * DIM_MAX];
    lanes_mask moved;
};

/* Adds eight bonds to *sum, the sums over the neighbourhoods (all bonds) of eight particles: w r e with weight w,
 * reference length r and extension e = |Y| - r of the bond vector Y, and in models with rotations w Y (x) xi with the
 * reference vector xi. Also updates the smallest and largest stretch in *sum. column: the bonds, one of each particle;
 * x[dim], X[dim]: present and reference positions of the eight particles [m]; model: state-based model, a compile-time
 * constant. p: all particles. */
static ALWAYS_INLINE void precompute_column(struct family_sums *sum, const struct particles *p,
                                            const struct bond_column_view column, const lanes *x, const lanes *X,
                                            const int dim, const enum pd_model model)
{
    struct state_bond_vectors s;
    state_bonds_compute_vectors_and_lengths(&s, p, column, x, X, dim, model);
    const lanes w = bond_column_weights(column), stretch = STRETCH_OF(lanes_square_root(s.distance2), s.inverse_length);
    sum->stretch = bond_column_max_where_intact(column, sum->stretch, stretch);
    sum->press = bond_column_min_where_intact(column, sum->press, stretch);
    sum->extension += state_bonds_weight_times_reference_length(column, w, s.inverse_length, true) * stretch;
    if (!state_model_has_rotations(model)) return;
    for (int c = 0; c < dim; c++) {
        const lanes weighted = bond_column_weighted_vector_component(column, c, w, s.xi[c]);
        const lanes_mask moved = (lanes_mask)s.y[c] ^ (lanes_mask)s.xi[c];
        sum->moved |= column.kind >= COLUMN_WHOLE ? moved : moved & (w > 0.0); /* padding may point to any particle */
        for (int d = 0; d < dim; d++) sum->moment[d * dim + c] += weighted * s.y[d];
    }
}

/* Computes the rotations that fit the deformation of the neighbourhoods (all bonds) of eight particles best, from
 * their moments sum w Y (x) xi (moment[dim dim]), in the form in which rotations are stored (rotation.h). moved: 0 in
 * lanes of neighbourhoods in which no particle has moved; these get exactly the identity. spring: spring stiffness of
 * the neighbourhoods [N/m]. */
static ALWAYS_INLINE void family_rotation(lanes *rotation, const lanes *moment, lanes_mask moved, lanes spring,
                                          const int dim)
{
    lanes R[DIM_MAX * DIM_MAX];
    polar_decomposition_rotations(moment, R, dim);
    for (int c = 0; c < dim * dim; c++) R[c] = lanes_choose(moved != 0, R[c], lanes_broadcast(c % (dim + 1) == 0));
    rotation_encode_with_spring_stiffness(rotation, R, spring, dim);
}

/* Moduli and weighted volumes Q = sum w |xi|^2 of the neighbourhoods (all bonds) of eight particles. Members inverse
 * and share are 0 for neighbourhoods without bonds. */
struct own_family {
    lanes A, B;    /* moduli [Pa] */
    lanes inverse; /* 1/Q [1/m^2] */
    lanes share;   /* V/Q, with the weighted volume of a full neighbourhood if the moduli refer to it [m] */
};

/* Returns the moduli and weighted volumes of the neighbourhoods (all bonds) of the particles of WIDE rows (one per
 * vector lane), from row `first` on. b, p: all bonds and particles. */
static ALWAYS_INLINE struct own_family own_family_of(const struct bonds *b, const struct particles *p, int64_t first)
{
    const int32_t *row = b->particle + first;
    const int32_t own = b->aligned[first / LANES] ? row[0] : -1;
    const struct state_modulus *m = &b->state.modulus[p->material[row[0]]];
    const lanes Q = lanes_load(b->state.weighted + first), inverse = lanes_choose(Q > 0.0, 1.0 / Q, lanes_broadcast(0));
    const lanes share = b->state.share > 0 ? lanes_choose(Q > 0.0, lanes_broadcast(b->state.share), lanes_broadcast(0))
                                           : lanes_load_or_gather(p->volume0, own, row) * inverse;
    struct own_family f = {lanes_broadcast(m->A), lanes_broadcast(m->B), inverse, share};
    if (own >= 0 && eight_bytes_are_equal(p->material + b->particle[first / LANES * LANES])) return f;
    for (int l = 0; l < WIDE; l++) m = &b->state.modulus[p->material[row[l]]], f.A[l] = m->A, f.B[l] = m->B;
    return f;
}

/* States of the neighbourhoods (all bonds of one particle) of eight particles: pressure P, spring stiffness g and
 * stored rotation (rotation.h) of each. */
struct family_state {
    lanes pressure, spring, rotation[ROTATION];
};

/* Stores the states *k (pressure, spring stiffness and rotation) of the neighbourhoods of the particles of WIDE rows
 * (one per vector lane), from row `first` on, in b->state. model: state-based model, a compile-time constant. */
static ALWAYS_INLINE void precompute_store(struct bonds *b, int64_t first, const struct family_state *k,
                                           const enum pd_model model)
{
    const int32_t *row = b->particle + first;
    const int rows = count_of_next_eight_indices_below_limit(first, b->rows);
    const bool aligned = b->aligned[first / LANES];
    struct state *t = &b->state;
    bond_rows_store_values_of_their_particles(t->pressure, row, rows, aligned, k->pressure);
    bond_rows_store_values_of_their_particles(t->spring, row, rows, aligned, k->spring);
    for (int c = 0; state_model_has_rotations(model) && c < ROTATION; c++)
        bond_rows_store_values_of_their_particles(t->rotation[c], row, rows, aligned, k->rotation[c]);
}

/* ---- bonded material points -------------------------------------------------------------------------------------- */

/* Returns a mask with lane l set if the particle of row `first` + l is a material point with bonds, not a peridynamic
 * particle. b, p: all bonds and particles. */
static ALWAYS_INLINE lanes_mask ends_of(const struct bonds *b, const struct particles *p, int64_t first)
{
    lanes_mask end;
    for (int l = 0; l < WIDE; l++) end[l] = -(int64_t)(p->kind[b->particle[first + l]] == KIND_MPM);
    return end;
}

/* Computes the rotations of the mesh cells of eight material points with bonds, from p->end_rotation, into
 * rotation[ROTATION], multiplied by the spring stiffness in 2D or the square root of twice the stiffness in 3D, as
 * rotation.h describes. row: indices of the points; own: the first of them if they are consecutive, else -1; spring:
 * spring stiffness of their neighbourhoods [N/m]; back: true for the inverse rotations. */
static ALWAYS_INLINE void ends_rotate(const struct particles *p, const int32_t *row, int32_t own, lanes spring,
                                      const bool back, lanes *rotation, const int dim)
{
    const lanes scale = dim == 2 ? spring : lanes_square_root(2.0 * spring), axis = back ? -scale : scale;
    if (dim == 2) {
        rotation[0] = rotation[3] = scale * lanes_load_or_gather(p->end_rotation[0], own, row);
        rotation[2] = axis * lanes_load_or_gather(p->end_rotation[1], own, row);
        rotation[1] = -rotation[2];
        return;
    }
    for (int c = 0; c < ROTATION; c++)
        rotation[c] = (c < 3 ? axis : scale) * lanes_load_or_gather(p->end_rotation[c], own, row);
}

/* Stores in p->end_moment the moments [N m] that bonds exert on eight material points, for the points in the mask
 * `end`; 0 for the other lanes. The moment is the axial vector of N = g R^T M, with M = sum w Y (x) xi over the bonds
 * of the point, the rotation R of its mesh cell and the spring stiffness g: N_ji - N_ij for component k, with i, j, k
 * cyclic. row: indices of the points, of which the first `rows` exist; own: index of the first point if they are
 * consecutive, else -1; sum: sums over the bonds, with M; spring: g [N/m]. */
static ALWAYS_INLINE void ends_moment(struct particles *p, const int32_t *row, int rows, int32_t own, lanes_mask end,
                                      const struct family_sums *sum, lanes spring, const int dim)
{
    lanes N[DIM_MAX][DIM_MAX], rotation[ROTATION], turned = lanes_broadcast(0);
    ends_rotate(p, row, own, spring, true, rotation, dim);
    for (int c = 0; c < ROTATION; c++) turned += dim == 2 || c < 3 ? rotation[c] * rotation[c] : lanes_broadcast(0);
    for (int c = 0; c < dim;
         c++) { /* N = g R^T M column by column: g times the column plus g (R^T - 1) times the column */
        lanes less[DIM_MAX], column[DIM_MAX];
        for (int d = 0; d < dim; d++) column[d] = sum->moment[d * dim + c], less[d] = lanes_broadcast(0);
        encoded_rotation_subtract_product_with_vector(less, rotation, column, dim);
        for (int d = 0; d < dim; d++) N[d][c] = spring * column[d] - less[d];
    }
    const lanes_mask any = end & ((sum->moved != 0) | (turned != 0.0)); /* exactly zero where nothing has moved */
    for (int k = dim == 2 ? 2 : 0, c = 0; k < 3; k++, c++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        bond_rows_store_values_of_their_particles(p->end_moment[c], row, rows, own >= 0,
                                                  lanes_choose(any, N[j][i] - N[i][j], lanes_broadcast(0)));
    }
}

/* For the bonds b, corrects the states *k (pressure, spring stiffness, rotation) of those particles of WIDE rows (one
 * per vector lane), from row `first` on, that are material points: adds the mean strain of the point's mesh cell to the
 * pressure, and replaces the rotation by that of the cell. Stores the reactions of the bonds on the cells in
 * p->end_pull and p->end_moment. f: moduli and weighted volumes of the neighbourhoods; sum: sums over their bonds;
 * model: state-based model, a compile-time constant. */
static __attribute__((noinline)) void ends_update(struct bonds *b, struct particles *p, int64_t first,
                                                  const struct own_family *f, const struct family_sums *sum,
                                                  struct family_state *k, const int dim, const enum pd_model model)
{
    const lanes_mask end = ends_of(b, p, first);
    const int32_t *row = b->particle + first, own = b->aligned[first / LANES] ? row[0] : -1;
    const int rows = count_of_next_eight_indices_below_limit(first, b->rows);
    k->pressure +=
        f->A * f->share * lanes_choose(end, lanes_load_or_gather(p->end_strain, own, row), lanes_broadcast(0));
    const lanes pull = lanes_choose(end, k->pressure * lanes_load(b->state.weighted + first), lanes_broadcast(0));
    bond_rows_store_values_of_their_particles(p->end_pull, row, rows, own >= 0, pull);
    if (!state_model_has_rotations(model)) return;
    lanes rotation[ROTATION];
    ends_rotate(p, row, own, k->spring, false, rotation, dim);
    for (int c = 0; c < ROTATION; c++) k->rotation[c] = lanes_choose(end, rotation[c], k->rotation[c]);
    ends_moment(p, row, rows, own, end, sum, k->spring, dim);
}

/* ---- all rows ---------------------------------------------------------------------------------------------------- */

/* Computes pressure, spring stiffness and rotation of the neighbourhoods (all bonds) of the particles of WIDE rows,
 * from row `first` on, and stores them in b->state. The states of material points with bonds include the contribution
 * of their mesh cell. sum: sums over the bonds of each particle; model: state-based model, a compile-time constant. p:
 * all particles. */
static ALWAYS_INLINE void precompute_by_family(struct bonds *b, struct particles *p, int64_t first,
                                               const struct family_sums *sum, const int dim, const enum pd_model model)
{
    const struct own_family f = own_family_of(b, p, first);
    struct family_state k;
    k.pressure = f.A * sum->extension * f.inverse * f.share, k.spring = f.B * f.share;
    if (state_model_has_rotations(model)) family_rotation(k.rotation, sum->moment, sum->moved, k.spring, dim);
    if (__builtin_expect(p->end_strain && !bond_row_block_has_eight_pd_particles(b, first / LANES), 0)) {
        const struct family_sums seen =
            *sum; /* copies for a function that is not inlined: the originals stay in registers */
        const struct own_family own = f;
        struct family_state both = k;
        ends_update(b, p, first, &own, &seen, &both, dim, model);
        k = both;
    }
    precompute_store(b, first, &k, model);
}

/* Computes the states (pressure, spring stiffness, rotation) of the particles of WIDE rows (one per vector lane), from
 * row `first` on, from sums over their bonds. Sets *past to true if a bond may exceed its breaking limit, and *pressed
 * if a bond is compressed into its repulsive core. model: state-based model, a compile-time constant. b, p: all bonds
 * and particles. */
static ALWAYS_INLINE void precompute_rows(struct bonds *b, struct particles *p, int64_t first, bool *past,
                                          bool *pressed, const int dim, const enum pd_model model)
{
    const int32_t *row = b->particle + first;
    const int32_t own = b->aligned[first / LANES] ? row[0] : -1;
    lanes x[DIM_MAX], X[DIM_MAX];
    struct family_sums sum;
    sum.extension = lanes_broadcast(0), sum.stretch = lanes_broadcast(-1), sum.press = lanes_broadcast(0);
    sum.moved = (lanes_mask)lanes_broadcast(0);
    for (int c = 0; c < dim * dim; c++) sum.moment[c] = lanes_broadcast(0);
    for (int d = 0; d < dim; d++) {
        x[d] = lanes_load_or_gather(p->x[d], own, row);
        if (state_model_has_rotations(model)) X[d] = lanes_load_or_gather(p->X[d], own, row);
    }
#define VISIT(COLUMN) precompute_column(&sum, p, COLUMN, x, X, dim, model)
    FOR_COLUMNS(b, first, VISIT);
#undef VISIT
    *past |= lanes_mask_any(sum.stretch > lanes_load(b->trigger + first));
    *pressed |= lanes_mask_any(sum.press < CORE_FROM - 1);
    precompute_by_family(b, p, first, &sum, dim, model);
}

/* Computes the states (pressure, spring stiffness, rotation) of the eight particles of row block g from sums over
 * their bonds: the first of the two loops of the force. Sets b->state.past[g] if a bond may exceed its breaking limit,
 * and b->state.pressed[g] if a bond is compressed into its repulsive core, else clears them. If bonds break, the
 * states stored are means of those with and without the breaking bonds (state_last.h). limit: breaking limits; model:
 * state-based model, a compile-time constant. p: all particles. */
static ALWAYS_INLINE void precompute_row_block(struct bonds *b, struct particles *p, const struct bond_limit *limit,
                                               int64_t g, const int dim, const enum pd_model model)
{
    bool past = false, pressed = false;
    for (int part = 0; part < LANES; part += WIDE) precompute_rows(b, p, g * LANES + part, &past, &pressed, dim, model);
    b->state.past[g] = past, b->state.pressed[g] = pressed;
    if (past && !limit->softening) bond_row_block_states_blend_out_breaking_bonds(b, p, limit, g);
}

/* Sets the states (pressure, spring stiffness, rotation) of mirror images in b->state to the states of the particles of
 * p that they mirror, with rotations reflected at planes of symmetry. Images in clamped planes have no state:
 * clamp_force.c adds their reaction to the force on the mirrored particle. rotates: true in models with rotations. */
static void state_of_images(struct bonds *b, const struct particles *p, int dim, bool rotates)
{
    for (int64_t g = p->n; g < p->n_all; g++) {
        const int32_t i = b->state.image[g - p->n].source;
        const int axis = b->state.image[g - p->n].axis;
        const bool has_state = axis >= 0;
        b->state.pressure[g] = has_state ? b->state.pressure[i] : 0;
        b->state.spring[g] = has_state ? b->state.spring[i] : 0;
        for (int c = 0; rotates && c < ROTATION; c++)
            b->state.rotation[c][g] = !has_state ? 0
                                      : encoded_rotation_component_flips_on_reflection(c, axis, dim)
                                          ? -b->state.rotation[c][i]
                                          : b->state.rotation[c][i];
    }
}

/* ---- second sweep: forces ---------------------------------------------------------------------------------------- */

/* Positions, states and sums of the eight particles of a block of eight rows in the second loop. x, X: present and
 * reference positions [m]; f: forces; arm = sum w xi, to which the rotations of the particles themselves are applied at
 * the end; pressure, spring: states of their families. */
struct state_sums {
    lanes x[DIM_MAX], X[DIM_MAX], f[DIM_MAX], arm[DIM_MAX], pressure, spring;
};

/* Adds the forces of eight bonds to *sum, the sums of their eight particles. column: the bonds, one of each particle;
 * model: state-based model, a compile-time constant. Without rotations the force of a bond is w [P + (g - P) q] Y,
 * with bond vector Y, weight w, pressure P, spring stiffness g and q = (|Y| - r)/|Y|, which takes two products fewer
 * than the stretch. With rotations the effective displacement Y - R xi is computed as (Y - xi) - (R - 1) xi, which is
 * exactly 0 where nothing has moved; the part of the rotations of the eight particles themselves is added in
 * force_rows. p: all particles. */
static ALWAYS_INLINE void force_column(struct state_sums *sum, const struct particles *p,
                                       const struct bond_column_view column, const int dim, const enum pd_model model)
{
    const struct state *t = &column.b->state;
    struct state_bond_vectors s;
    state_bonds_compute_vectors_and_lengths(&s, p, column, sum->x, sum->X, dim, model);
    const lanes inverse = lanes_inverse_square_root(s.distance2);
    const lanes w = bond_column_weights(column);
    const lanes pressure = sum->pressure + bond_column_gather_neighbour_values(column, t->pressure);
    const lanes spring = sum->spring + bond_column_gather_neighbour_values(column, t->spring);
    if (!state_model_has_rotations(model)) {
        const lanes share = SHARE_OF(state_bonds_reference_length(column, s.inverse_length), inverse);
        const lanes along = w * (pressure + (spring - pressure) * share);
        for (int d = 0; d < dim; d++) sum->f[d] += along * s.y[d];
        return;
    }
    const lanes along =
                    state_bonds_weight_times_reference_length(column, w, s.inverse_length, false) * pressure * inverse,
                weighted = w * spring;
    lanes rotation[ROTATION], arm[DIM_MAX], f[DIM_MAX];
    for (int c = 0; c < ROTATION; c++)
        if (encoded_rotation_component_is_needed(c, dim))
            rotation[c] = bond_column_gather_neighbour_values(column, t->rotation[c]);
    for (int d = 0; d < dim; d++) {
        arm[d] = bond_column_weighted_vector_component(column, d, w, s.xi[d]);
        sum->arm[d] += arm[d];
        f[d] = along * s.y[d] + weighted * (s.y[d] - s.xi[d]);
    }
    encoded_rotation_subtract_product_with_vector(f, rotation, arm, dim);
    for (int d = 0; d < dim; d++)
        sum->f[d] += f[d]; /* one addition per column: shortest chain of dependent additions */
}

/* Computes the forces of all bonds on the particles of WIDE rows (one per vector lane), from row `first` on, into p->f,
 * without repulsive cores, from the states of the neighbourhoods in b->state (pressure, spring stiffness and rotation).
 * model: state-based model, a compile-time constant. */
static ALWAYS_INLINE void force_rows(const struct bonds *b, struct particles *p, int64_t first, const int dim,
                                     const enum pd_model model)
{
    const int32_t *row = b->particle + first;
    const int32_t own = b->aligned[first / LANES] ? row[0] : -1;
    const int rows = count_of_next_eight_indices_below_limit(first, b->rows);
    const struct state *t = &b->state;
    struct state_sums sum;
    sum.pressure = lanes_load_or_gather(t->pressure, own, row), sum.spring = lanes_load_or_gather(t->spring, own, row);
    for (int d = 0; d < dim; d++) {
        sum.x[d] = lanes_load_or_gather(p->x[d], own, row), sum.f[d] = sum.arm[d] = lanes_broadcast(0);
        if (state_model_has_rotations(model)) sum.X[d] = lanes_load_or_gather(p->X[d], own, row);
    }
#define VISIT(COLUMN) force_column(&sum, p, COLUMN, dim, model)
    FOR_COLUMNS(b, first, VISIT);
#undef VISIT
    if (state_model_has_rotations(model)) {
        lanes rotation[ROTATION];
        for (int c = 0; c < ROTATION; c++) rotation[c] = lanes_load_or_gather(t->rotation[c], own, row);
        encoded_rotation_subtract_product_with_vector(sum.f, rotation, sum.arm, dim);
    }
    for (int d = 0; d < dim; d++) bond_rows_store_values_of_their_particles(p->f[d], row, rows, own >= 0, sum.f[d]);
}

/* Computes the forces of the bonds on the eight particles of row block g (their bonds are stored together) into p->f,
 * repulsive cores included, and breaks bonds stretched beyond their limit. Returns the number of broken bonds, each
 * counted once for each of its two rows. limit: breaking limits; model: state-based model, a compile-time constant. b:
 * all bonds. */
static ALWAYS_INLINE int64_t force_and_break(struct bonds *b, struct particles *p, const struct bond_limit *limit,
                                             int64_t g, const int dim, const enum pd_model model)
{
    for (int part = 0; part < LANES; part += WIDE) force_rows(b, p, g * LANES + part, dim, model);
    if (__builtin_expect(b->state.pressed[g], 0)) bond_row_block_add_repulsive_core_forces(b, p, g);
    if (!b->state.past[g]) return 0;
    return bond_break_row_block(b, p, limit, g);
}

#define INSTANCE(D, M)                                                                                                 \
    static void states_##D##d_##M(struct bonds *b, struct particles *p, const struct bond_limit *limit, bool softened) \
    {                                                                                                                  \
        _Pragma("omp parallel for schedule(static)") for (int64_t k = 0; k < b->active.active;                         \
                                                          k++) if (!softened || b->soft.begun[b->active.list[k]])      \
            precompute_row_block(b, p, limit, b->active.list[k], D, PD_##M);                                           \
        state_of_images(b, p, D, state_model_has_rotations(PD_##M));                                                   \
    }                                                                                                                  \
    static int64_t families_##D##d_##M(struct bonds *b, struct particles *p, const struct bond_limit *limit)           \
    {                                                                                                                  \
        bool changed = false;                                                                                          \
        states_##D##d_##M(b, p, limit, false);                                                                         \
        const int64_t ended = limit->softening ? state_soften(b, p, limit, &changed) : 0;                              \
        if (changed) states_##D##d_##M(b, p, limit, true);                                                             \
        return ended;                                                                                                  \
    }                                                                                                                  \
    static void state_precompute_##D##d_##M(struct bonds *b, struct particles *p)                                      \
    {                                                                                                                  \
        families_##D##d_##M(b, p, &bond_limit_never);                                                                  \
    }                                                                                                                  \
    static int64_t state_sweep_##D##d_##M(struct bonds *b, struct particles *p, const struct bond_limit *limit,        \
                                          struct pd_motion *m)                                                         \
    {                                                                                                                  \
        SWEEP(b, p, m, D, force_and_break(b, p, limit, row_block, D, PD_##M));                                         \
    }                                                                                                                  \
    static int64_t state_force_##D##d_##M(struct bonds *b, struct particles *p, const struct bond_limit *limit,        \
                                          struct pd_motion *m)                                                         \
    {                                                                                                                  \
        const int64_t ended = families_##D##d_##M(b, p, limit);                                                        \
        return ended + state_sweep_##D##d_##M(b, p, limit, m);                                                         \
    }
STATE_VARIANTS(INSTANCE)

#define ENTRY(D, M) [D][PD_##M] = state_force_##D##d_##M,
bond_force_fn *const state_force_table[DIM_MAX + 1][PD_MODELS] = {STATE_VARIANTS(ENTRY)};

#define PRECOMPUTE(D, M) [D][PD_##M] = state_precompute_##D##d_##M,
family_states_precompute_fn *const state_precompute_table[DIM_MAX + 1][PD_MODELS] = {STATE_VARIANTS(PRECOMPUTE)};
