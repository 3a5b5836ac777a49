/* Slits of the mesh: nodes that free surfaces between cells double (struct mesh_slits in data/mesh.h).
 *
 * Around a node the cells that hold particles fall into groups: two cells are together if no slit passes between their
 * centres, or if others join them. Cells without particles join nothing, so that a slit that ends at a face of the body
 * opens there, and one that ends inside does not. */
#include <string.h>

#include "base/memory.h"
#include "mesh_parts.h"

/* An extra node in the making, and the cells around it, by the corner that it is to them. */
struct extra { int64_t base; unsigned corners; };

struct slit_maker {
    const struct mesh *mesh;
    const struct mesh_source *source;
    const uint8_t *filled;               /* [nodes] of cells: they hold particles */
    uint8_t *lean;                       /* [nodes] as in struct mesh_slits, of nodes that keep their place */
    struct extra *extra;
    int64_t n, room;
};

/* ---- groups of cells around a node ------------------------------------------------------------------------------- */

/* Centre of a cell [m]. */
static void cell_centre(const struct grid *g, int64_t cell, real *X)
{
    for (int d = 0; d < g->dim; d++)
        X[d] = g->anchor[d] + g->h * ((real)(g->first[d] + cell / g->stride[d] % g->count[d]) + 0.5);
}

static bool cells_parted(const struct slit_maker *m, int64_t one, int64_t other)
{
    real a[DIM_MAX], b[DIM_MAX];
    cell_centre(&m->mesh->grid, one, a);
    cell_centre(&m->mesh->grid, other, b);
    for (int k = 0; k < m->source->slits; k++)
        if (crack_cuts(&m->source->slit[k], a, b, m->mesh->grid.dim)) return true;
    return false;
}

/* Cells around node I that are together with one of `group`, all as bits by corner; `open`: those not in a group. */
static unsigned group_grow(const struct slit_maker *m, int64_t I, unsigned group, unsigned open)
{
    const int corners = 1 << m->mesh->grid.dim;
    for (unsigned fresh = group; fresh;) {
        const int from = __builtin_ctz(fresh);
        fresh &= fresh - 1;
        for (int c = 0; c < corners; c++) {
            if (!((open & ~group) >> c & 1)) continue;
            if (cells_parted(m, I - m->mesh->corner[from], I - m->mesh->corner[c])) continue;
            group |= 1u << c, fresh |= 1u << c;
        }
    }
    return group;
}

/* Bits of struct mesh_slits.lean of a group, of all cells around its node. A cell of which the node is an upper corner
 * lies below it. */
static uint8_t group_lean(unsigned group, unsigned all, int dim)
{
    unsigned lean = 0;
    for (int d = 0; d < dim; d++) {
        unsigned below = 0;
        for (int c = 0; c < 1 << dim; c++) below |= (unsigned)(c >> d & 1) << c;
        if (all & below && !(group & below)) lean |= 1u << 2 * d;
        if (all & ~below && !(group & ~below)) lean |= 2u << 2 * d;
    }
    return (uint8_t)lean;
}

static void extra_add(struct slit_maker *m, int64_t base, unsigned corners)
{
    if (m->n == m->room) {
        const int64_t room = m->room ? 2 * m->room : 64;
        m->extra = memory_resize("slits.extra", m->extra, m->room, room, sizeof *m->extra);
        m->room = room;
    }
    m->extra[m->n++] = (struct extra){base, corners};
}

/* Divides the cells around node I into groups; all but the first want an extra node. */
static void node_divide(struct slit_maker *m, int64_t I)
{
    const int dim = m->mesh->grid.dim;
    unsigned all = 0;
    for (int c = 0; c < 1 << dim; c++) {
        const int64_t cell = I - m->mesh->corner[c];
        all |= (unsigned)(cell >= 0 && m->filled[cell]) << c;
    }
    const int64_t before = m->n;
    unsigned first = 0;
    for (unsigned open = all; open;) {
        const unsigned group = group_grow(m, I, open & -open, open);
        if (first) extra_add(m, I, group);
        else first = group;
        open &= ~group;
    }
    if (m->n > before) m->lean[I] = group_lean(first, all, dim);
}

static bool slit_near(const struct slit_maker *m, int64_t I)
{
    const struct grid *g = &m->mesh->grid;
    real X[DIM_MAX];
    for (int d = 0; d < g->dim; d++) X[d] = grid_position(g, d, I / g->stride[d] % g->count[d]);
    for (int k = 0; k < m->source->slits; k++)
        if (crack_near(&m->source->slit[k], X, 2 * g->h, g->dim)) return true;
    return false;
}

/* ---- tables ------------------------------------------------------------------------------------------------------ */

/* Extra nodes fill rows but for their ends, beyond which whole vectors are read and written. */
static int64_t row_room(const struct grid *g) { return g->count[0] - LANES; }

/* Corners of its own for cell I. */
static int32_t *corners_of(struct mesh *mesh, int64_t I)
{
    struct mesh_slits *s = &mesh->slits;
    const int corners = 1 << mesh->grid.dim;
    if (s->cell[I] < 0) {
        s->cell[I] = (int32_t)s->cells;
        for (int c = 0; c < corners; c++) s->corner[s->cells * corners + c] = (int32_t)(I + mesh->corner[c]);
        s->cells++;
    }
    return s->corner + (int64_t)s->cell[I] * corners;
}

/* Puts the extra nodes behind the box, whose nodes were `first` in number. */
static void tables_make(struct mesh *mesh, const struct slit_maker *m, int64_t first)
{
    const struct grid *g = &mesh->grid;
    struct mesh_slits *s = &mesh->slits;
    const int corners = 1 << g->dim;
    s->nodes = m->n, s->first = first;
    s->base = BARE("slits.base", g->n - first, int32_t);
    s->cell = BARE("slits.cell", g->n, int32_t);
    s->lean = NEW("slits.lean", g->n, uint8_t);
    s->corner = BARE("slits.corner", m->n * corners * corners, int32_t);
    for (int64_t I = first; I < g->n; I++) s->base[I - first] = -1;
    for (int64_t I = 0; I < g->n; I++) s->cell[I] = -1;
    memcpy(s->lean, m->lean, (size_t)first);
    for (int64_t k = 0; k < m->n; k++) {
        const struct extra *e = &m->extra[k];
        const int64_t I = first + k / row_room(g) * g->count[0] + k % row_room(g);
        unsigned all = 0;
        for (int c = 0; c < corners; c++) {
            const int64_t cell = e->base - mesh->corner[c];
            all |= (unsigned)(cell >= 0 && m->filled[cell]) << c;
            if (e->corners >> c & 1) corners_of(mesh, cell)[c] = (int32_t)I;
        }
        s->base[I - first] = (int32_t)e->base;
        s->lean[I] = group_lean(e->corners, all, g->dim);
    }
}

status mesh_slits_make(struct mesh *mesh, const struct particles *p, const struct mesh_source *source, const real *from,
                       const real *to)
{
    struct grid *g = &mesh->grid;
    const int64_t first = g->n;
    status result = OK;
    mesh->slits = (struct mesh_slits){.first = first};
    if (source->slits == 0 || g->dim == 1) return OK;
    uint8_t *filled = NEW("slits.filled", first, uint8_t);
    for (int64_t i = 0; i < p->n; i++) {
        const int64_t place = mesh_place_of(mesh, p, i);
        if (place >= 0) filled[place >> g->dim] = 1;
    }
    struct slit_maker m = {mesh, source, filled, NEW("slits.lean", first, uint8_t), NULL, 0, 0};
    for (int64_t I = 0; I < first; I++)
        if (slit_near(&m, I)) node_divide(&m, I);
    if (m.n > 0) {
        const int last = g->dim - 1;
        const int64_t rows = m.n / row_room(g) + 1, layers = last == 1 ? rows : rows / g->count[1] + 1;
        real far[DIM_MAX];
        bool changed;
        for (int d = 0; d < g->dim; d++) far[d] = to[d];
        far[last] += g->h * (real)(layers + 4);          /* a box grows by steps of four nodes (grid_cover) */
        result = grid_cover(g, from, far, INT32_MAX >> g->dim, &changed);
        if (result == OK) tables_make(mesh, &m, first);
    }
    memory_free(m.lean);
    memory_free(m.extra);
    memory_free(filled);
    return result;
}

/* ---- blocks and groups ------------------------------------------------------------------------------------------- */

void mesh_slits_link(struct mesh *mesh)
{
    struct mesh_slits *s = &mesh->slits;
    if (!s->cell) return;
    s->links = 0;
    s->link = BARE("slits.link", s->nodes, struct mesh_link);
    s->linked = NEW("slits.linked", mesh->active.blocks, uint8_t);
    for (int64_t I = s->first; I < mesh->grid.n; I++) {
        if (s->base[I - s->first] < 0) continue;
        const struct mesh_link link = {(int32_t)mesh_block(mesh, I), (int32_t)mesh_block(mesh, mesh_base(mesh, I))};
        s->linked[link.extra] = s->linked[link.base] = 1;
        if (s->links > 0 && memcmp(&s->link[s->links - 1], &link, sizeof link) == 0) continue;
        s->link[s->links++] = link;
    }
}

void mesh_slits_groups(struct mesh *mesh)
{
    struct mesh_slits *s = &mesh->slits;
    const int corners = 1 << mesh->grid.dim;
    const int64_t groups = mesh_groups(mesh);
    int32_t n = 0;
    if (!s->cell) return;
    memory_free(s->group);
    memory_free(s->lane);
    s->group = BARE("slits.group", groups, int32_t);
    for (int64_t g = 0; g < groups; g++) {
        bool own = false;
        for (int l = 0; l < LANES; l++) own |= s->cell[mesh->partial_cell[g * LANES + l]] >= 0;
        s->group[g] = own ? n++ : -1;
    }
    s->lane = BARE("slits.lane", (int64_t)n * corners * LANES, int32_t);
    for (int64_t g = 0; g < groups; g++)
        for (int c = 0; c < corners && s->group[g] >= 0; c++)
            for (int l = 0; l < LANES; l++)
                s->lane[((int64_t)s->group[g] * corners + c) * LANES + l] =
                    (int32_t)mesh_node(mesh, mesh->partial_cell[g * LANES + l], c);
}

void mesh_slits_free(struct mesh_slits *s)
{
    memory_free(s->base);
    memory_free(s->cell);
    memory_free(s->corner);
    memory_free(s->lean);
    memory_free(s->group);
    memory_free(s->lane);
    memory_free(s->link);
    memory_free(s->linked);
    memset(s, 0, sizeof *s);
}
