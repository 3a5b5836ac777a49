/* floor 2: nodes to points at the end of the step: position, velocity gradient, stress, volume, and the mark of a point
 * whose largest principal stress passed the trigger (Zeng et al. 2022, eqs. 32, 40, 43-49, corrected:
 * L from the second map, rotation W sigma - sigma W).
 *     FLIP (MUSL)  x += dt sum N v_I,  L = sum v2_I (x) grad N  with the velocity v2 of the second map
 *     APIC         v = sum N v_I, x += dt v,  L = sum v_I (x) grad N
 * Every point is written by one thread. */
#include "kernels.h"
#include "plastic.h"
#include "scatter.h"
#include "shape.h"
#include "stress.h"
#include "variants.h"

/* Volume follows tr eps of the space; in plane stress the strain through the thickness is left out (below 1 % strain
 * it changes the volume by less than 0.5 %). */
static ALWAYS_INLINE void point_strain(struct particles *p, const struct transfer_data *t, int64_t i, const real *L,
                                       const int dim, const enum shape shape)
{
    const int n = dim * (dim + 1) / 2;
    const struct elastic *m = &t->elastic[p->material[i]];
    real stress[SYM_MAX];
    for (int c = 0; c < n; c++) stress[c] = p->stress[c][i];
    p->volume[i] *= 1 + stress_update(stress, L, m, t->dt, dim);
    for (int c = 0; c < n; c++) p->stress[c][i] = stress[c];
    if (shape == SHAPE_CPGIMP)
        for (int d = 0; d < dim; d++) p->stretch[d][i] *= 1 + t->dt * L[d * dim + d];
    if (stress_bound(stress, dim) > m->trigger && stress_principal(stress, dim) > m->trigger)
        p->flag[i] |= FLAG_STRESSED;
}

/* What the trial stress has beyond the yield surface becomes plastic strain; the mark is that of the stress that stays.
 * Last of all and on what is stored, so that points that cannot yield keep their registers. */
static ALWAYS_INLINE void point_yield(struct particles *p, const struct elastic *m, int64_t i, const int dim)
{
    const int n = dim * (dim + 1) / 2;
    const bool keeps_zz = dim == 2 && m->space == SPACE_PLANE_STRAIN;
    real stress[SYM_MAX], zz = keeps_zz ? p->out_of_plane[i] : 0;
    for (int c = 0; c < n; c++) stress[c] = p->stress[c][i];
    const real more = plastic_return(m, stress, p->plastic_strain[i], &zz);
    if (more == 0) return;
    p->plastic_strain[i] += more;
    if (keeps_zz) p->out_of_plane[i] = zz;
    for (int c = 0; c < n; c++) p->stress[c][i] = stress[c];
    if (!(stress_principal(stress, dim) > m->trigger)) p->flag[i] &= (uint8_t)~FLAG_STRESSED;
}

/* Returns whether the point left its cell. */
static ALWAYS_INLINE bool point_move(const struct grid *g, const struct cell *c, struct particles *p, int64_t i,
                                     const real *step, const int dim)
{
    bool moved = false;
    for (int d = 0; d < dim; d++) {
        p->x[d][i] += step[d];
        const real place = grid_place(g, d, p->x[d][i]);
        moved |= !(place >= c->place[d] && place < c->place[d] + 1);
    }
    return moved;
}

/* By rows of a cell's nodes: the velocity, and the one that strains. */
typedef row_of_nodes cell_rows[DIM_MAX][ROWS_MAX];

/* Velocity and its gradient at a point. Rows are added up first: all share the weights along them. */
static ALWAYS_INLINE void point_gather(const cell_rows moving, const cell_rows straining, const struct stencil *s,
                                       real *velocity, real *L, const int dim, const enum shape shape)
{
    const int along = ROW_DIMS(dim, shape);
    row_of_nodes moves[DIM_MAX], strains[DIM_MAX], across[DIM_MAX][DIM_MAX];
    for (int d = 0; d < dim; d++) {
        moves[d] = strains[d] = row_of(0);
        for (int e = along; e < dim; e++) across[d][e] = row_of(0);
    }
    FOR_TOUCHED(s, dim, shape) {
        const real weight = stencil_row(s, k1, k2, dim, shape);
        const int k = PATCH(dim, shape);
        for (int d = 0; d < dim; d++) {
            moves[d] += weight * moving[d][k];
            strains[d] += weight * straining[d][k];
            for (int e = along; e < dim; e++)
                across[d][e] += stencil_slope(s, k1, k2, e, dim, shape) * straining[d][k];
        }
    }
    row_of_nodes term[DIM_MAX * (1 + DIM_MAX)] = {{0}};      /* gradients first: four in 2D */
    for (int d = 0; d < dim; d++) {
        for (int e = 0; e < dim; e++) term[d * dim + e] = e < along ? s->D[e] * strains[d] : s->N * across[d][e];
        term[dim * dim + d] = s->N * moves[d];
    }
    real sum[DIM_MAX * (1 + DIM_MAX)];
    for (int k = 0; k < dim * (1 + dim); k += ROW) {
        const row_of_nodes four = row_sums(term[k], term[k + 1], term[k + 2], term[k + 3]);
        for (int m = 0; m < ROW; m++) sum[k + m] = four[m];
    }
    for (int k = 0; k < dim * dim; k++) L[k] = sum[k];
    for (int d = 0; d < dim; d++) velocity[d] = sum[dim * dim + d];
}

static ALWAYS_INLINE bool g2p_particle(const cell_rows moving, const cell_rows straining, const struct grid *g,
                                       const struct cell *c, struct particles *p, const struct transfer_data *t,
                                       int64_t i, const int dim, const enum shape shape, const enum transfer transfer)
{
    struct stencil s;
    real velocity[DIM_MAX], L[DIM_MAX * DIM_MAX];
    stencil_make(&s, g, c, p, i, t->half_width, dim, shape);
    point_gather(moving, straining, &s, velocity, L, dim, shape);
    if (transfer == TRANSFER_APIC) {
        for (int d = 0; d < dim; d++) p->v[d][i] = velocity[d];
        for (int k = 0; k < dim * dim; k++) p->gradient[k][i] = L[k];
    }
    if (!t->bare) point_strain(p, t, i, L, dim, shape);
    for (int d = 0; d < dim; d++) velocity[d] *= t->dt;
    const bool moved = point_move(g, c, p, i, velocity, dim);
    const struct elastic *m = &t->elastic[p->material[i]];
    if (__builtin_expect(m->yield > 0, 0)) point_yield(p, m, i, dim);
    return moved;
}

static ALWAYS_INLINE void g2p_fetch(const struct particles *p, const int32_t *list, int k, const int dim)
{
    int64_t i;
    if (!fetch_now(list, k, &i)) return;
    fetch(p->volume + i);
    for (int d = 0; d < dim; d++) fetch(p->x[d] + i);
    for (int c = 0; c < dim * (dim + 1) / 2; c++) fetch(p->stress[c] + i);
}

/* Returns how many points left the cell. */
static ALWAYS_INLINE int64_t g2p_cell(const struct grid *g, struct particles *p, const struct transfer_data *t,
                                      const int32_t *list, int n, const int dim, const enum shape shape,
                                      const enum transfer transfer)
{
    const struct cell c = cell_make(g, p, list[0], dim, shape);
    cell_rows moving, straining;
    int64_t moved = 0;
    FOR_ROWS(dim, shape) {
        const int64_t I = cell_row(&c, g, k1, k2, dim);
        const int k = PATCH(dim, shape);
        for (int d = 0; d < dim; d++) {
            moving[d][k] = nodes_load(g, g->velocity[d] + I, dim, shape);
            straining[d][k] = transfer == TRANSFER_APIC ? moving[d][k] : nodes_load(g, g->momentum[d] + I, dim, shape);
        }
    }
    for (int k = 0; k < n; k++) {
        g2p_fetch(p, list, k, dim);
        moved += g2p_particle(moving, straining, g, &c, p, t, list[k], dim, shape, transfer);
    }
    return moved;
}

#define INSTANCE(D, S, T)                                                                                           \
    static int64_t g2p_##D##d_##S##_##T(const struct grid *g, struct particles *p, const struct transfer_data *t)   \
    {                                                                                                               \
        const struct transfer_order *o = t->order;                                                                  \
        int64_t moved = 0;                                                                                          \
        _Pragma("omp parallel reduction(+ : moved)")                                                                \
        {                                                                                                           \
            struct grid nodes = *g;            /* as in scatter.h */                                                \
            struct particles points = *p;                                                                           \
            struct transfer_data data = *t;                                                                         \
            _Pragma("omp for schedule(static)")                                                                     \
            for (int32_t k = 0; k < o->cells; k++)                                                                  \
                moved += g2p_cell(&nodes, &points, &data, o->particle + o->cell_start[k],                           \
                                  o->cell_start[k + 1] - o->cell_start[k], D, SHAPE_##S, TRANSFER_##T);             \
        }                                                                                                           \
        return moved;                                                                                               \
    }
#define BOTH(D, S) TRANSFER_VARIANTS(INSTANCE, D, S)
SHAPE_VARIANTS(BOTH)

#define ENTRY(D, S, T) [D][SHAPE_##S][TRANSFER_##T] = g2p_##D##d_##S##_##T,
#define ENTRIES(D, S) TRANSFER_VARIANTS(ENTRY, D, S)
g2p_fn *const g2p_table[DIM_MAX + 1][SHAPES][TRANSFERS] = {SHAPE_VARIANTS(ENTRIES)};
