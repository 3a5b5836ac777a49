/* Divides cells and nodes of the mesh at slits, free surfaces between material points such as pre-cracks (struct
 * mesh_slits in data/mesh.h).
 *
 * Two points are connected if no slit passes between them. The points of a cell form connected pieces, each of which
 * becomes a cell. Around a node, two pieces are connected if a point of one is connected with a point of the other,
 * directly or through other pieces. Regions without points connect nothing: a slit that ends at a face of the body
 * opens there, a slit that ends inside the body does not. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "mesh_parts.h"

/* Largest number of pieces around a node (a piece is a set of points of a cell that no slit separates): 2^dim cells
 * with at most 2^dim pieces each. */
enum { PIECES_MOST = CORNERS_MAX * CORNERS_MAX };

/* Extra node or cell during the construction of slits, at the position of node or cell `base` of the grid. A piece is a
 * set of points of a cell that no slit separates. For an extra node, `pieces` is the set of pieces that move with it:
 * bit 8 c + g for piece g of the cell of which the node is corner c. For an extra cell, `piece` is the number of its
 * piece. open: axes of planes of symmetry that do not constrain the node, as bits. */
struct extra {
    int64_t base;
    uint64_t pieces;
    int piece;
    uint8_t open;
};
/* List at[n] of extra nodes or cells that slits make, owned by the struct slit_maker. */
struct extras {
    struct extra *at;
    int64_t n;
};

/* Working data for the construction of slits, freed when mesh->slits has been filled. `nodes` is the number of nodes of
 * the box of nodes; each node is also the lowest node, hence the index, of a cell. */
struct slit_maker {
    const struct mesh *mesh;
    const struct particles *p;
    const struct mesh_source *source;
    int32_t *point;           /* [nodes << dim] particle at each quarter position of a cell, -1: none */
    uint8_t *piece;           /* [nodes << dim] number of the piece of the cell to which this particle belongs */
    uint8_t *pieces;          /* [nodes] number of pieces of a cell with points near a slit, else 0 */
    uint8_t *split, *open;    /* [nodes] as in struct mesh_slits */
    uint8_t *voids;           /* [nodes] 1: within two cells of a particle near a void */
    struct extras node, cell; /* extra nodes, extra cells */
};

static void extra_add(struct extras *to, struct extra one)
{
    GROW("slits.extra", to->at, to->n + 1);
    to->at[to->n++] = one;
}

/* ---- pieces of cells --------------------------------------------------------------------------------------------- */

/* Returns true if a slit, or a void near particle i, lies between the positions a[dim] and b[dim] [m] in the body of
 * particle i. */
static bool positions_parted(const struct slit_maker *m, int32_t i, const real *a, const real *b)
{
    const struct voids *v = m->source->voids;
    if (particle_is_beside_void(v, i) && void_separates_points(v, m->p->body[i], a, b, NULL)) return true;
    for (int k = 0; k < m->source->slits; k++)
        if (crack_cuts_bond(&m->source->slit[k], a, b, m->p->dim)) return true;
    return false;
}

/* Returns true if a slit (a pre-crack as a gap of the mesh) or a void of m separates the reference positions of
 * particles i and j. */
static bool points_parted(const struct slit_maker *m, int32_t i, int32_t j)
{
    real a[DIM_MAX], b[DIM_MAX];
    particle_reference_position(m->p, i, a);
    particle_reference_position(m->p, j, b);
    return positions_parted(m, i, a, b);
}

/* Sets mark[J] = 1 for cell I of grid g and all cells J that are at most two cells away from it along each axis.
 * mark[g->n]. */
static void void_mark(const struct grid *g, int64_t I, uint8_t *mark)
{
    enum { FAR = 2 };
    const int high = g->dim > 2 ? FAR : 0;
    for (int c = -high; c <= high; c++)
        for (int b = -FAR; b <= FAR; b++)
            for (int a = -FAR; a <= FAR; a++) {
                const int64_t at = I + a * g->stride[0] + b * g->stride[1] + (high ? c * g->stride[2] : 0);
                if (at >= 0 && at < g->n) mark[at] = 1;
            }
}

/* Returns true if node I of the mesh of m is near a slit (a pre-crack as a gap of the mesh) or a void: within two cell
 * diagonals of a slit, or within two cells of a particle near a void. */
static bool slit_near(const struct slit_maker *m, int64_t I)
{
    const struct grid *g = &m->mesh->grid;
    real X[DIM_MAX];
    if (m->voids[I]) return true;
    for (int d = 0; d < g->dim; d++) X[d] = grid_node_position(g, d, I / g->stride[d] % g->count[d]);
    for (int k = 0; k < m->source->slits; k++)
        if (crack_may_cut_bonds_near(&m->source->slit[k], X, 2 * sqrt(g->dim) * g->h, g->dim)) return true;
    return false;
}

/* Divides the points of cell I of the mesh of m into pieces, sets of points that no slit separates. Stores the piece of
 * each point in m->piece and the number of pieces in m->pieces. Appends an extra cell to m->cell for each piece but the
 * first. */
static void cell_divide(struct slit_maker *m, int64_t I)
{
    const int corners = 1 << m->p->dim;
    const int32_t *point = m->point + I * corners;
    uint8_t *piece = m->piece + I * corners;
    unsigned open = 0;
    for (int q = 0; q < corners; q++) open |= (unsigned)(point[q] >= 0) << q;
    for (int n = 0; open; n++) {
        m->pieces[I]++;
        if (n > 0) extra_add(&m->cell, (struct extra){I, 0, n, 0});
        for (unsigned fresh = open & -open; fresh;) {
            const int from = __builtin_ctz(fresh);
            fresh &= fresh - 1, open &= ~(1u << from);
            piece[from] = (uint8_t)n;
            for (int q = 0; q < corners; q++)
                if ((open & ~fresh) >> q & 1 && !points_parted(m, point[from], point[q])) fresh |= 1u << q;
        }
    }
}

/* ---- groups of pieces around a node ------------------------------------------------------------------------------ */

/* Returns the cell that contains piece number `bit` around node I of the mesh of m. A piece is a set of points of a
 * cell that no slit separates. Its number around a node is 8 c + g for piece g of the cell of which the node is corner
 * c. */
static int64_t cell_of_bit(const struct slit_maker *m, int64_t I, int bit)
{
    return I - m->mesh->corner[bit / CORNERS_MAX];
}

/* Returns true if two points of adjacent cells are opposite each other across the face or edge that the cells share. q,
 * r: numbers 0 .. 2^dim - 1 of the points in the first and in the second cell; c, k: number of the corner that a common
 * node of both cells has in the first and in the second cell. */
static bool quarter_points_face(int q, int r, int c, int k)
{
    const int apart = c ^ k; /* directions in which the cells follow each other */
    return ((q ^ r) & ~apart) == 0 && (q & apart) == (c & apart) && (r & apart) == (k & apart);
}

/* Returns the particle (in m) at point q (0 .. 2^dim - 1) of the cell that contains piece number `bit` around node I,
 * or -1 if the point does not belong to this piece. A piece is a set of points of a cell that no slit separates; its
 * number is 8 c + g for piece g of the cell of which the node is corner c. */
static int32_t piece_point(const struct slit_maker *m, int64_t I, int bit, int q)
{
    const int64_t place = (cell_of_bit(m, I, bit) << m->p->dim) + q;
    return m->piece[place] == bit % CORNERS_MAX ? m->point[place] : -1;
}

/* Returns true if the pieces `one` and `other` of the body around node I of the mesh of m are connected: if there is no
 * slit between a point of one and a point of the other. Points that are opposite each other across the boundary of two
 * cells are tested, or all pairs of points if there are none; pieces of one cell are not connected. A piece is a set of
 * points of a cell that no slit divides; 8 c + g is the number of piece g of the cell of which the node is corner c. */
static bool pieces_joined(const struct slit_maker *m, int64_t I, int one, int other)
{
    const int corners = 1 << m->p->dim, c = one / CORNERS_MAX, k = other / CORNERS_MAX;
    bool faced = false;
    for (int pass = 0; pass < 2 && !faced && c != k; pass++)
        for (int q = 0; q < corners; q++)
            for (int r = 0; r < corners; r++) {
                if (pass == 0 && !quarter_points_face(q, r, c, k)) continue;
                const int32_t i = piece_point(m, I, one, q), j = piece_point(m, I, other, r);
                if (i < 0 || j < 0) continue;
                if (!points_parted(m, i, j)) return true;
                faced = faced || pass == 0;
            }
    return false;
}

/* Returns the pieces around node I (of m) that are connected with the lowest piece in the set `open`, directly or
 * through other pieces in it, as one bit each. A piece is a set of points of a cell that no slit separates; bit 8 c + g
 * stands for piece g of the cell of which the node is corner c. */
static uint64_t group_grow(const struct slit_maker *m, int64_t I, uint64_t open)
{
    uint64_t group = open & -open;
    for (uint64_t fresh = group; fresh;) {
        const int from = __builtin_ctzll(fresh);
        fresh &= fresh - 1;
        for (uint64_t left = open & ~group; left; left &= left - 1) {
            const int bit = __builtin_ctzll(left);
            if (pieces_joined(m, I, from, bit)) group |= UINT64_C(1) << bit, fresh |= UINT64_C(1) << bit;
        }
    }
    return group;
}

/* Returns true if a slit or void of m separates point i from its mirror image at the plane of symmetry `plane`. */
static bool image_parted(const struct slit_maker *m, int32_t i, const struct mirror_plane *plane)
{
    real a[DIM_MAX], b[DIM_MAX];
    particle_reference_position(m->p, i, a);
    memcpy(b, a, sizeof b);
    b[plane->axis] = 2 * plane->at - b[plane->axis];
    return positions_parted(m, i, a, b);
}

/* Returns true if a connected set of pieces around node I of the mesh of m is connected with its mirror image at the
 * plane of symmetry `plane`, which contains the node: if there is no slit between a point of the set and the mirror
 * image of this point. Points next to the plane are tested, or all points if there are none. A piece is a set of points
 * of a cell that no slit divides. group: the set, where bit 8 c + g is piece g of the cell of which the node is corner
 * c. */
static bool image_joined(const struct slit_maker *m, int64_t I, uint64_t group, const struct mirror_plane *plane)
{
    bool faced = false;
    for (int pass = 0; pass < 2 && !faced; pass++)
        for (uint64_t left = group; left; left &= left - 1) {
            const int bit = __builtin_ctzll(left);
            for (int q = 0; q < 1 << m->p->dim; q++) {
                const int32_t i = piece_point(m, I, bit, q);
                if (i < 0 || (pass == 0 && (q ^ bit / CORNERS_MAX) >> plane->axis & 1)) continue;
                if (!image_parted(m, i, plane)) return true;
                faced = true;
            }
        }
    return false;
}

/* Finds the planes of symmetry through node I of the mesh of m at which the node is free, because slits separate the
 * body there from its mirror image. Returns their axes as bits. group: the pieces of the body that move with the node,
 * where bit 8 c + g is piece g of the cell of which the node is corner c. A piece is a set of points of a cell that no
 * slit divides. */
static uint8_t group_open(const struct slit_maker *m, int64_t I, uint64_t group)
{
    const struct grid *g = &m->mesh->grid;
    uint8_t open = 0;
    for (int k = 0; k < m->source->mirrors; k++) {
        const struct mirror_plane *plane = &m->source->mirror[k];
        const real x = grid_node_position(g, plane->axis, I / g->stride[plane->axis] % g->count[plane->axis]);
        if (fabs(x - plane->at) < 1e-6 * g->h && !image_joined(m, I, group, plane)) open |= (uint8_t)(1 << plane->axis);
    }
    return open;
}

/* Divides the pieces around node I (a piece is a set of points of a cell that no slit separates) into connected sets.
 * The first set keeps node I; for each other set an extra node is appended to m->node. Sets m->split[I] and
 * m->open[I]. */
static void node_divide(struct slit_maker *m, int64_t I)
{
    uint64_t open = 0;
    for (int c = 0; c < 1 << m->p->dim; c++) {
        const int64_t cell = I - m->mesh->corner[c];
        for (int g = 0; cell >= 0 && g < m->pieces[cell]; g++) open |= UINT64_C(1) << (CORNERS_MAX * c + g);
    }
    const int64_t before = m->node.n;
    for (bool first = true; open; first = false) {
        const uint64_t group = group_grow(m, I, open);
        if (first)
            m->open[I] = group_open(m, I, group);
        else
            extra_add(&m->node, (struct extra){I, group, 0, group_open(m, I, group)});
        open &= ~group;
    }
    m->split[I] = m->node.n > before;
}

/* Finds the cell and the point in it (m->point) of each particle of the mesh, then divides the cells and nodes near
 * slits (gaps for pre-cracks) and voids. */
static void slits_divide(struct slit_maker *m)
{
    const int64_t n = m->mesh->grid.n;
    const int dim = m->p->dim;
    for (int64_t k = 0; k < n << dim; k++) m->point[k] = -1;
    for (int64_t i = 0; i < m->p->n; i++) {
        const int64_t place = mesh_find_quadrature_point_index_of_particle(m->mesh, m->p, i);
        if (place < 0) continue;
        m->point[place] = (int32_t)i;
        if (particle_is_beside_void(m->source->voids, i)) void_mark(&m->mesh->grid, place >> dim, m->voids);
    }
    for (int64_t I = 0; I < n; I++)
        if (slit_near(m, I)) cell_divide(m, I);
    for (int64_t I = 0; I < n; I++)
        if (m->pieces[I] > 0 || slit_near(m, I)) node_divide(m, I);
}

/* ---- tables ------------------------------------------------------------------------------------------------------ */

/* Returns how many extra nodes or cells, made where slits (gaps for pre-cracks) divide nodes and cells, are stored in a
 * row of nodes of grid g: LANES fewer than the row has, since whole vectors are read and written beyond its ends. */
static int64_t row_room(const struct grid *g) { return g->count[0] - LANES; }

/* Returns the index in the arrays of nodes and of cells of the mesh at which extra node or cell number k (from 0) is
 * stored. Extra nodes and cells are made where slits (gaps for pre-cracks) divide nodes and cells. */
static int64_t extra_index(const struct mesh *mesh, int64_t k)
{
    const struct grid *g = &mesh->grid;
    return mesh->slits.first + k / row_room(g) * g->count[0] + k % row_room(g);
}

/* Returns the array [2^dim] of the corner nodes of cell I, which a slit (pre-crack) divides, in mesh->slits. If the
 * cell has none yet, it gets one with the corners of cell `at` of the grid. */
static int32_t *corners_of(struct mesh *mesh, int64_t I, int64_t at)
{
    struct mesh_slits *s = &mesh->slits;
    const int corners = 1 << mesh->grid.dim;
    if (s->cell[I] < 0) {
        s->cell[I] = (int32_t)s->cells;
        for (int c = 0; c < corners; c++) s->corner[s->cells * corners + c] = (int32_t)(at + mesh->corner[c]);
        s->cells++;
    }
    return s->corner + (int64_t)s->cell[I] * corners;
}

/* Returns the cell of the mesh that contains piece g of cell I of the grid: I itself for g = 0, else an extra cell. A
 * piece is a set of points of a cell that no slit separates. */
static int64_t piece_cell(const struct mesh *mesh, int64_t I, int g)
{
    while (g-- > 0) I = mesh->slits.next[I];
    return I;
}

/* Enters the extra cells of m, into which slits (gaps for pre-cracks) divide cells of the grid, in the tables of the
 * mesh. Links each extra cell to the cell from which it was divided, copies the corner nodes of that cell, and stores
 * for each point of a divided cell the cell that contains it. */
static void tables_cells(struct mesh *mesh, const struct slit_maker *m)
{
    struct mesh_slits *s = &mesh->slits;
    const int corners = 1 << mesh->grid.dim;
    int32_t cuts = 0;
    for (int64_t k = 0; k < m->cell.n; k++) {
        const int64_t base = m->cell.at[k].base, cell = extra_index(mesh, k);
        s->next[piece_cell(mesh, base, m->cell.at[k].piece - 1)] = (int32_t)cell;
        corners_of(mesh, cell, base);
        if (s->cut[base] < 0) s->cut[base] = cuts++;
    }
    s->home = BARE("slits.home", (int64_t)cuts * corners, int32_t);
    for (int64_t k = 0; k < m->cell.n; k++) {
        const int64_t base = m->cell.at[k].base;
        for (int q = 0; q < corners; q++)
            s->home[(int64_t)s->cut[base] * corners + q] =
                (int32_t)piece_cell(mesh, base, m->piece[base * corners + q]);
    }
}

/* Enters the extra nodes of m, which slits (gaps for pre-cracks) make at the positions of nodes of the grid, in the
 * tables of the mesh: their positions, and the cells of which they are corners. */
static void tables_nodes(struct mesh *mesh, const struct slit_maker *m)
{
    struct mesh_slits *s = &mesh->slits;
    for (int64_t k = 0; k < m->node.n; k++) {
        const struct extra *e = &m->node.at[k];
        const int64_t I = extra_index(mesh, k);
        s->base[I - s->first] = (int32_t)e->base;
        s->split[I] = 1, s->open[I] = e->open;
        for (uint64_t left = e->pieces; left; left &= left - 1) {
            const int bit = __builtin_ctzll(left);
            const int64_t at = cell_of_bit(m, e->base, bit);
            corners_of(mesh, piece_cell(mesh, at, bit % CORNERS_MAX), at)[bit / CORNERS_MAX] = (int32_t)I;
        }
    }
}

static int32_t *none_make(const char *label, int64_t n)
{
    int32_t *all = BARE(label, n, int32_t);
    for (int64_t k = 0; k < n; k++) all[k] = -1;
    return all;
}

/* Allocates and fills the tables mesh->slits of the extra nodes and cells that slits make. These have indices from
 * mesh->slits.first on, behind the nodes and cells of the grid. m: divided cells and nodes. */
static void slits_tables_make(struct mesh *mesh, const struct slit_maker *m)
{
    struct mesh_slits *s = &mesh->slits;
    const int64_t n = mesh->grid.n;
    int64_t most = m->cell.n;
    for (int64_t k = 0; k < m->node.n; k++) most += __builtin_popcountll(m->node.at[k].pieces);
    s->nodes = m->node.n;
    s->base = none_make("slits.base", n - s->first);
    s->cell = none_make("slits.cell", n);
    s->next = none_make("slits.next", n);
    s->cut = none_make("slits.cut", n);
    s->split = NEW("slits.split", n, uint8_t);
    s->corner = BARE("slits.corner", most << mesh->grid.dim, int32_t);
    s->open = NEW("slits.open", n, uint8_t);
    array_copy(s->split, m->split, s->first, 1);
    array_copy(s->open, m->open, s->first, 1);
    tables_cells(mesh, m);
    tables_nodes(mesh, m);
}

/* Extends the grid g, which covers the box from[dim] .. to[dim] [m], along its last axis until n extra nodes or cells
 * (made where slits divide nodes and cells) fit behind the nodes of the box. Returns FAILED, with a message, if the
 * grid becomes too large. */
static status box_extend(struct grid *g, const real *from, const real *to, int64_t n)
{
    const int last = g->dim - 1;
    const int64_t rows = n / row_room(g) + 1, layers = last == 1 ? rows : rows / g->count[1] + 1;
    real far[DIM_MAX];
    bool changed;
    for (int d = 0; d < g->dim; d++) far[d] = to[d];
    far[last] += g->h * (real)(layers + 4); /* a box grows in steps of four nodes (grid_extend_box) */
    return grid_extend_box(g, from, far, INT32_MAX >> g->dim, &changed);
}

status mesh_slits_duplicate_nodes(struct mesh *mesh, const struct particles *p, const struct mesh_source *source,
                                  const real *lower_corner, const real *upper_corner)
{
    const int64_t n = mesh->grid.n;
    status result = OK;
    mesh->slits = (struct mesh_slits){.first = n};
    if ((source->slits == 0 && !source->voids) || p->dim == 1) return OK;
    struct slit_maker m = {.mesh = mesh, .p = p, .source = source};
    m.point = BARE("slits.point", n << p->dim, int32_t);
    m.piece = NEW("slits.piece", n << p->dim, uint8_t);
    m.pieces = NEW("slits.pieces", n, uint8_t);
    m.split = NEW("slits.split", n, uint8_t);
    m.open = NEW("slits.open", n, uint8_t);
    m.voids = NEW("slits.voids", n, uint8_t);
    slits_divide(&m);
    const bool any = m.node.n > 0 || memchr(m.open, 1 << 0, (size_t)n) || memchr(m.open, 1 << 1, (size_t)n) ||
                     memchr(m.open, 1 << 2, (size_t)n); /* of several mirrors: a node is on one only */
    if (any) result = box_extend(&mesh->grid, lower_corner, upper_corner, m.node.n > m.cell.n ? m.node.n : m.cell.n);
    if (any && result == OK) slits_tables_make(mesh, &m);
    memory_free(m.point);
    memory_free(m.piece);
    memory_free(m.pieces);
    memory_free(m.split);
    memory_free(m.open);
    memory_free(m.voids);
    memory_free(m.node.at);
    memory_free(m.cell.at);
    return result;
}

/* ---- blocks and groups ------------------------------------------------------------------------------------------- */

/* Links the block of nodes (eight along x) of `mesh` that contains the extra node or cell `extra` to the block that
 * contains `base`, the node or cell at its position. Motion then spreads from one block to the other. Extra nodes and
 * cells are made where slits (pre-cracks of the mesh) divide nodes and cells. A link equal to the last one is not
 * stored again. */
static void link_add(struct mesh *mesh, int64_t extra, int64_t base)
{
    struct mesh_slits *s = &mesh->slits;
    const struct mesh_link link = {(int32_t)mesh_block_of_node(mesh, extra), (int32_t)mesh_block_of_node(mesh, base)};
    s->linked[link.extra] = s->linked[link.base] = 1;
    if (s->links > 0 && memcmp(&s->link[s->links - 1], &link, sizeof link) == 0) return;
    s->link[s->links++] = link;
}

void mesh_slits_link_node_blocks_to_duplicates(struct mesh *mesh)
{
    struct mesh_slits *s = &mesh->slits;
    int64_t extras = s->nodes;
    if (!s->cell) return;
    for (int64_t I = 0; I < mesh->grid.n; I++) extras += s->next[I] >= 0;
    s->links = 0;
    s->link = BARE("slits.link", extras, struct mesh_link);
    s->linked = NEW("slits.linked", mesh->active.blocks, uint8_t);
    for (int64_t I = s->first; I < mesh->grid.n; I++)
        if (s->base[I - s->first] >= 0) link_add(mesh, I, mesh_original_node_of_doubled_node(mesh, I));
    for (int64_t I = 0; I < s->first; I++)
        for (int64_t cell = s->next[I]; cell >= 0; cell = s->next[cell]) link_add(mesh, cell, I);
}

void mesh_slits_store_corner_nodes_of_adjacent_cells(struct mesh *mesh)
{
    struct mesh_slits *s = &mesh->slits;
    const int corners = 1 << mesh->grid.dim;
    const int64_t groups = mesh_count_groups_of_eight_cells_with_own_stiffness(mesh);
    int32_t n = 0;
    if (!s->cell) return;
    memory_free(s->group);
    memory_free(s->lane);
    s->group = BARE("slits.group", groups, int32_t);
    for (int64_t g = 0; g < groups; g++) {
        bool own = false;
        for (int l = 0; l < LANES; l++) own |= s->cell[mesh->own_stiffness_cell[g * LANES + l]] >= 0;
        s->group[g] = own ? n++ : -1;
    }
    s->lane = BARE("slits.lane", (int64_t)n * corners * LANES, int32_t);
    for (int64_t g = 0; g < groups; g++)
        for (int c = 0; c < corners && s->group[g] >= 0; c++)
            for (int l = 0; l < LANES; l++)
                s->lane[((int64_t)s->group[g] * corners + c) * LANES + l] =
                    (int32_t)mesh_cell_corner_node(mesh, mesh->own_stiffness_cell[g * LANES + l], c);
}

void mesh_slits_free(struct mesh_slits *s)
{
    memory_free(s->base);
    memory_free(s->cell);
    memory_free(s->corner);
    memory_free(s->split);
    memory_free(s->open);
    memory_free(s->next);
    memory_free(s->cut);
    memory_free(s->home);
    memory_free(s->group);
    memory_free(s->lane);
    memory_free(s->link);
    memory_free(s->linked);
    memset(s, 0, sizeof *s);
}
