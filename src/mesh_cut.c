/* floor 3: cut cells of the mesh and their stiffness by modes (kernels/mesh_cut.h), from the points they have left.
 *
 * The strain at a point x is that of the mean and each bending mode times a product of coordinates +-1/4. So the stiffness
 * is made of sums over the points of their D, stress by strain, times products of signs: one for each set of axes, as the
 * square of a sign is 1. */
#include <math.h>
#include <string.h>

#include "memory.h"
#include "mesh_parts.h"
#include "mesh_point.h"

enum { ROWS_MAX = SYM_MAX + DIM_MAX, TERMS_MAX = 3 };
#define ODD_LEAST 1e-12                  /* of the largest number: below it is round-off */

/* One way in which a mode shows in a component of strain, or a component of stress acts on a mode: times the coordinates of
 * the axes in `set`, and a sign. Rows are symmetric components, then skew ones. */
struct mode_term { uint8_t row, set; real factor; };
struct mode_terms { int n; struct mode_term at[TERMS_MAX]; };

/* ---- modes -------------------------------------------------------------------------------------------------- */

static int component(int dim, int i, int j)
{
    for (int k = 0; k < symmetric_count(dim); k++) {
        int a, b;
        symmetric_axes(dim, k, &a, &b);
        if ((a == i && b == j) || (a == j && b == i)) return k;
    }
    return -1;
}

/* A mode M of component i is, in the slope of u_i along each axis of M, the product of the other coordinates of M. */
static void bends_terms(struct mode_terms *t, int dim, bool skew)
{
    const int symmetric = symmetric_count(dim);
    for (int M = 3; M < 1 << dim; M++)
        for (int i = 0; i < dim && M & (M - 1); i++, t++)
            for (int j = 0; j < dim; j++) {
                int a, b;
                if (!(M >> j & 1) || (skew && i == j)) continue;
                const int k = component(dim, i, j), set = M & ~(1 << j);
                symmetric_axes(dim, k, &a, &b);
                t->at[t->n++] = (struct mode_term){(uint8_t)(skew ? symmetric + k - dim : k), (uint8_t)set,
                                                   (skew && i != a ? -1 : 1) * pow(0.25, __builtin_popcount((unsigned)set))};
            }
}

/* In the order of kernels/mesh_cut.h. */
static void modes_terms(struct mode_terms *t, int dim, bool skew)
{
    const int symmetric = symmetric_count(dim), first = skew ? symmetric - dim : symmetric;
    memset(t, 0, sizeof *t * MODES_MAX);
    for (int k = 0; k < first; k++) t[k] = (struct mode_terms){1, {{(uint8_t)(skew ? symmetric + k : k), 0, 1}}};
    bends_terms(t + first, dim, skew);
}

/* ---- one cell --------------------------------------------------------------------------------------------------- */

/* What cells are made of. */
struct cell_maker {
    const struct mesh *mesh;
    const struct particles *p;
    const struct mesh_source *source;
    int dim, modes, rows, columns;       /* rows of D: symmetric components, and skew ones where there are any */
    real (*whole)[SYM_MAX * SYM_MAX], (*isotropic)[SYM_MAX * SYM_MAX];   /* [materials] stress by strain     */
    struct mode_terms in[MODES_MAX], skew[MODES_MAX];
};

/* Stress by strain, shears by their angle. */
static void constants(const struct elastic *m, real *C, int dim)
{
    const int n = symmetric_count(dim);
    for (int t = 0; t < n; t++) {
        real g[DIM_MAX * DIM_MAX] = {0}, s[SYM_MAX];
        int a, b;
        symmetric_axes(dim, t, &a, &b);
        g[a * dim + b] = 1;
        mesh_point_stress(m, g, s, dim);
        for (int k = 0; k < n; k++) C[k * n + t] = s[k];
    }
}

/* D of a point: the whole stress less what bonds carry, and the skew part that goes with it. */
static void point_constants(const struct cell_maker *c, int32_t i, real *D)
{
    const int n = c->columns;
    const struct partial_stress *partial = c->source->partial;
    const int64_t entry = partial && partial->index ? partial->index[i] : -1;
    const real *isotropic = c->isotropic[c->p->material[i]];
    memset(D, 0, sizeof *D * (size_t)(c->rows * n));
    memcpy(D, c->whole[c->p->material[i]], sizeof *D * (size_t)(n * n));
    if (entry < 0) return;
    for (int row = 0; row < c->rows; row++) {
        const real *M = row < n ? partial->matrix + (entry * n + row) * n : partial->skew + (entry * (c->rows - n) + row - n) * n;
        for (int k = 0; k < n; k++)
            for (int t = 0; t < n; t++) D[row * n + t] -= M[k] * isotropic[k * n + t];
    }
}

/* sum D/corners times the signs of the axes of each set: butterflies along one axis after the other. */
static void cell_sums(const struct cell_maker *c, int64_t I, real sum[CORNERS_MAX][ROWS_MAX * SYM_MAX])
{
    const int corners = 1 << c->dim, size = c->rows * c->columns;
    for (int q = 0; q < corners; q++) {
        const int32_t i = c->mesh->point[(I << c->dim) + q];
        if (i >= 0) point_constants(c, i, sum[q]);
        else memset(sum[q], 0, sizeof(real) * (size_t)size);
    }
    for (int d = 0; d < c->dim; d++)
        for (int q = 0; q < corners; q++)
            for (int k = 0; k < size && !(q >> d & 1); k++) {
                const real low = sum[q][k], high = sum[q | 1 << d][k];
                sum[q][k] = 0.5 * (low + high), sum[q | 1 << d][k] = 0.5 * (high - low);
            }
}

/* Force on one mode by another. */
static real entry_of(const struct cell_maker *c, real sum[CORNERS_MAX][ROWS_MAX * SYM_MAX], const struct mode_terms *to,
                     const struct mode_terms *by)
{
    real value = 0;
    for (int s = 0; s < to->n; s++)
        for (int t = 0; t < by->n; t++)
            value += to->at[s].factor * by->at[t].factor *
                     sum[to->at[s].set ^ by->at[t].set][to->at[s].row * c->columns + by->at[t].row];
    return value;
}

/* Is D symmetric, but for round-off? Then so is the stiffness. */
static bool sums_symmetric(const struct cell_maker *c, real sum[CORNERS_MAX][ROWS_MAX * SYM_MAX])
{
    const int n = c->columns;
    real most = 0, odd = 0;
    for (int q = 0; q < 1 << c->dim; q++)
        for (int a = 0; a < n; a++)
            for (int b = 0; b <= a; b++) {
                most = real_max(most, fabs(sum[q][a * n + b]));
                odd = real_max(odd, fabs(sum[q][a * n + b] - sum[q][b * n + a]));
            }
    return odd <= ODD_LEAST * most;
}

/* One lane of a group; K, odd (NULL: not wanted) and skew where that begins. Returns whether there is an odd part. */
static bool cell_make(const struct cell_maker *c, int64_t I, real *K, real *odd, real *skew)
{
    const int n = c->modes;
    real sum[CORNERS_MAX][ROWS_MAX * SYM_MAX];
    cell_sums(c, I, sum);
    const bool symmetric = sums_symmetric(c, sum);
    for (int a = 0; a < n; a++)
        for (int b = a; b < n; b++, K += LANES) {
            const real upper = entry_of(c, sum, &c->in[a], &c->in[b]);
            const real lower = symmetric ? upper : entry_of(c, sum, &c->in[b], &c->in[a]);
            *K = 0.5 * (upper + lower);
            if (odd && a < b) *odd = 0.5 * (upper - lower), odd += LANES;
        }
    for (int a = 0; a < mesh_skews(c->dim) && skew; a++)
        for (int b = 0; b < n; b++, skew += LANES) *skew = entry_of(c, sum, &c->skew[a], &c->in[b]);
    return !symmetric;
}

/* ---- all cut cells -------------------------------------------------------------------------------------------- */

void mesh_cuts_add(struct mesh *mesh, int64_t I)
{
    if (mesh->cuts == mesh->cuts_room) {
        const int64_t room = mesh->cuts_room ? 2 * mesh->cuts_room : 256;
        mesh->cut = memory_resize("mesh.cut", mesh->cut, mesh->cuts_room, room, sizeof *mesh->cut);
        mesh->cuts_room = room;
    }
    mesh->cut[mesh->cuts++] = (int32_t)I;
}

struct mesh_cuts mesh_cuts_keep(struct mesh *mesh)
{
    const struct mesh_cuts old = {mesh->cuts, mesh->cut, mesh->stiffness, mesh->odd, mesh->skew};
    mesh->cut = NULL, mesh->stiffness = mesh->odd = mesh->skew = NULL;
    mesh->cuts = mesh->cuts_room = 0;
    mesh_cuts_free(mesh);
    return old;
}

void mesh_cuts_free(struct mesh *mesh)
{
    memory_free(mesh->cut);
    memory_free(mesh->stiffness);
    memory_free(mesh->odd);
    memory_free(mesh->skew);
    memory_free(mesh->alike);
    memory_free(mesh->cut_force);
    memory_free(mesh->cut_stressed);
    memory_free(mesh->cut_material);
    mesh->cut = NULL, mesh->cut_force = NULL, mesh->cut_stressed = NULL, mesh->cut_material = NULL, mesh->alike = NULL;
    mesh->stiffness = mesh->odd = mesh->skew = NULL;
}

/* Of the points of a cell, that with the lowest trigger. */
static uint8_t cut_material(const struct mesh *mesh, const struct particles *p, const struct mesh_source *s, int64_t I)
{
    int least = -1;
    for (int q = 0; q < 1 << p->dim; q++) {
        const int32_t i = mesh->point[(I << p->dim) + q];
        if (i < 0) continue;
        if (least < 0 || s->elastic[p->material[i]].trigger < s->elastic[least].trigger) least = p->material[i];
    }
    return (uint8_t)least;
}

static struct cell_maker maker_of(const struct mesh *mesh, const struct particles *p, const struct mesh_source *s)
{
    const int dim = p->dim, n = symmetric_count(dim);
    struct cell_maker c = {.mesh = mesh, .p = p, .source = s, .dim = dim, .modes = mesh_modes(dim), .columns = n,
                           .rows = s->partial && s->partial->skew ? 2 * n - dim : n};
    c.whole = memory_new("mesh.constants", 2 * s->materials, sizeof *c.whole);
    c.isotropic = c.whole + s->materials;
    for (int m = 0; m < s->materials; m++) {
        constants(&s->elastic[m], c.whole[m], dim);
        constants(&s->isotropic[m], c.isotropic[m], dim);
    }
    modes_terms(c.in, dim, false);
    modes_terms(c.skew, dim, true);
    return c;
}

static real *lane_of(real *from, int64_t cell, int each)
{
    return from ? from + (cell / LANES * each) * LANES + cell % LANES : NULL;
}

static void lane_copy(real *to, real *from, int each)
{
    for (int k = 0; k < each && to; k++) to[k * LANES] = from ? from[k * LANES] : 0;
}

/* The rest of the last group is its first cell again, without stiffness. */
static void groups_fill(struct mesh *mesh)
{
    const int64_t whole = mesh_groups(mesh) * LANES, cuts = mesh->cuts;
    while (mesh->cuts < whole) mesh_cuts_add(mesh, mesh->cut[whole - LANES]);
    mesh->cuts = cuts;
}

/* Which old cell each is, -1: to be made. */
static int64_t *origins(const struct mesh *mesh, const struct mesh_cuts *old, const uint8_t *dirty)
{
    int64_t *from = NEW("mesh.from", mesh->cuts, int64_t);
    for (int64_t k = 0, q = 0; k < mesh->cuts; k++) {
        while (q < old->cuts && old->cut[q] < mesh->cut[k]) q++;
        from[k] = dirty && q < old->cuts && old->cut[q] == mesh->cut[k] && !dirty[mesh->cut[k]] ? q : -1;
    }
    return from;
}

/* `each` numbers of every cut cell; only the rest of the last group is 0 already. */
static real *numbers_make(const char *label, const struct mesh *mesh, int64_t each)
{
    const int64_t groups = mesh_groups(mesh), size = each * LANES;
    real *numbers = memory_bare(label, groups * size, sizeof *numbers);
    if (groups > 0) memset(numbers + (groups - 1) * size, 0, (size_t)size * sizeof *numbers);
    return numbers;
}

/* The odd part of all cells, where there is one. */
static void odds_make(struct mesh *mesh, const struct cell_maker *c, struct mesh_cuts *old, const int64_t *from, bool any)
{
    const int half = c->modes * (c->modes + 1) / 2, odd = half - c->modes, skews = mesh_skews(c->dim) * c->modes;
    if (!any && !old->odd) return;
    mesh->odd = numbers_make("mesh.odd", mesh, odd);
#pragma omp parallel for schedule(dynamic, 16)
    for (int64_t k = 0; k < mesh->cuts; k++)
        if (from[k] >= 0) lane_copy(lane_of(mesh->odd, k, odd), lane_of(old->odd, from[k], odd), odd);
        else cell_make(c, mesh->cut[k], lane_of(mesh->stiffness, k, half), lane_of(mesh->odd, k, odd), lane_of(mesh->skew, k, skews));
}

static bool numbers_alike(const real *of, int64_t g, int64_t h, int each)
{
    const size_t size = (size_t)each * LANES;
    return !of || memcmp(of + g * (int64_t)size, of + h * (int64_t)size, size * sizeof *of) == 0;
}

/* Cells that an edge of the body cuts the same way follow each other. */
static void alike_find(struct mesh *mesh, int modes, int skews)
{
    const int64_t groups = mesh_groups(mesh);
    const int half = modes * (modes + 1) / 2;
    mesh->alike = NEW("mesh.alike", groups, int32_t);
    for (int64_t g = 0; g < groups; g++) {
        const int32_t before = g > 0 ? mesh->alike[g - 1] : 0;
        const bool same = numbers_alike(mesh->stiffness, before, g, half) && numbers_alike(mesh->odd, before, g, half - modes) &&
                          numbers_alike(mesh->skew, before, g, skews);
        mesh->alike[g] = same ? before : (int32_t)g;
    }
}

void mesh_cuts_make(struct mesh *mesh, const struct particles *p, const struct mesh_source *s, const uint8_t *dirty,
                    struct mesh_cuts *old)
{
    struct cell_maker c = maker_of(mesh, p, s);
    const int half = c.modes * (c.modes + 1) / 2, skews = mesh_skews(c.dim) * c.modes, unknowns = (1 << c.dim) * c.dim;
    const int64_t groups = mesh_groups(mesh);
    bool any = false;
    groups_fill(mesh);
    mesh->stiffness = numbers_make("mesh.stiffness", mesh, half);
    mesh->skew = c.rows > c.columns ? numbers_make("mesh.skew", mesh, skews) : NULL;
    mesh->cut_force = NEW("mesh.cut_force", groups * unknowns * LANES, real);
    mesh->cut_stressed = NEW("mesh.cut_stressed", groups * LANES, bool);
    mesh->cut_material = NEW("mesh.cut_material", groups * LANES, uint8_t);
    for (int64_t k = 0; k < groups * LANES; k++) mesh->cut_material[k] = cut_material(mesh, p, s, mesh->cut[k]);
    int64_t *from = origins(mesh, old, dirty);
#pragma omp parallel for schedule(dynamic, 16) reduction(|| : any)
    for (int64_t k = 0; k < mesh->cuts; k++) {
        real *K = lane_of(mesh->stiffness, k, half), *skew = lane_of(mesh->skew, k, skews);
        if (from[k] < 0) {
            any = cell_make(&c, mesh->cut[k], K, NULL, skew) || any;
            continue;
        }
        lane_copy(K, lane_of(old->stiffness, from[k], half), half);
        lane_copy(skew, lane_of(old->skew, from[k], skews), skews);      /* none before: 0 */
    }
    odds_make(mesh, &c, old, from, any);
    alike_find(mesh, c.modes, skews);
    memory_free(from);
    memory_free(c.whole);
    memory_free(old->cut);
    memory_free(old->stiffness);
    memory_free(old->odd);
    memory_free(old->skew);
}

/* Place of a cell among the cut ones, -1: it is none. */
static int64_t cut_find(const struct mesh *mesh, int64_t I)
{
    int64_t low = 0, high = mesh->cuts;
    while (low < high) {
        const int64_t middle = (low + high) / 2;
        if (mesh->cut[middle] < I) low = middle + 1;
        else high = middle;
    }
    return low < mesh->cuts && mesh->cut[low] == I ? low : -1;
}

/* What the numbers of a marked group were is no longer known. */
static void alike_part(struct mesh *mesh, const uint8_t *changed)
{
    for (int64_t g = mesh_groups(mesh) - 1; g >= 0; g--)
        if (changed[g] || changed[mesh->alike[g]]) mesh->alike[g] = (int32_t)g;
}

bool mesh_cuts_again(struct mesh *mesh, const struct particles *p, const struct mesh_source *s, const uint8_t *dirty)
{
    struct cell_maker c = maker_of(mesh, p, s);
    const int half = c.modes * (c.modes + 1) / 2, skews = mesh_skews(c.dim) * c.modes;
    bool fit = (c.rows > c.columns) == (mesh->skew != NULL);
    uint8_t *changed = NEW("mesh.changed", mesh_groups(mesh), uint8_t);
    for (int64_t k = 0; k < mesh->cuts; k++) changed[k / LANES] |= dirty[mesh->cut[k]];
    alike_part(mesh, changed);
    memory_free(changed);
#pragma omp parallel for schedule(dynamic, 16) reduction(&& : fit)
    for (int64_t I = 0; I < mesh->grid.n; I++) {
        const int64_t k = dirty[I] && fit ? cut_find(mesh, I) : -1;
        if (k < 0) continue;
        const bool odd = cell_make(&c, I, lane_of(mesh->stiffness, k, half), lane_of(mesh->odd, k, half - c.modes),
                                   lane_of(mesh->skew, k, skews));
        fit = fit && (mesh->odd || !odd);
    }
    memory_free(c.whole);
    return fit;
}
