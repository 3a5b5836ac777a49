/* Sorts material points for transfers between points and grid: by block of cells, blocks in the order of their colours,
 * then by cell. */
#include "data/transfer_order.h"

#include <omp.h>
#include <string.h>

#include "base/memory.h"

/* ---- blocks ------------------------------------------------------------------------------------------------------ */

/* Returns the index of the block (a box of cells) that contains cell number k along an axis; both may be negative.
 * edge: length of a block along the axis [cells]. */
static ALWAYS_INLINE int64_t block_of(int64_t k, const int64_t edge) { return (k >= 0 ? k : k - edge + 1) / edge; }

/* The blocks that overlap the box of a grid. */
struct block_shape {
    int64_t first[DIM_MAX], blocks[DIM_MAX]; /* first block, counted from node 0; number of blocks */
    int dim;
    int64_t cells_in_block, n; /* number of cells of a block; number of blocks */
};

/* Returns the blocks (boxes of cells) that overlap the box of the grid g: their range along each axis, and their
 * number. */
static struct block_shape block_shape_of(const struct grid *g)
{
    struct block_shape s = {.dim = g->dim, .cells_in_block = 1, .n = 1};
    for (int d = 0; d < g->dim; d++) {
        s.first[d] = block_of(g->first[d], transfer_block_edge_length_in_cells(d));
        s.blocks[d] = block_of(g->first[d] + g->count[d] - 1, transfer_block_edge_length_in_cells(d)) - s.first[d] + 1;
        s.cells_in_block *= transfer_block_edge_length_in_cells(d);
        s.n *= s.blocks[d];
    }
    return s;
}

/* Returns the colour of block number `block` (a box of cells) of s, one bit per axis: whether its index along the axis
 * is odd. Blocks of one colour are not adjacent, so that threads can process them at the same time. */
static int block_colour(const struct block_shape *s, int64_t block)
{
    int colour = 0;
    for (int d = 0; d < s->dim; d++) {
        colour |= (int)((block % s->blocks[d] + s->first[d]) & 1) << d;
        block /= s->blocks[d];
    }
    return colour;
}

/* Computes rank[s->n], the position of each block (a box of cells) in a list of all blocks that is sorted by colour,
 * then by number. Blocks of one colour are not adjacent, so that threads can process them at the same time. Stores in
 * o->blocks_of the first position of each colour. */
static void rank_blocks(struct transfer_order *o, const struct block_shape *s, int32_t *rank)
{
    int32_t next = 0;
    for (int c = 0; c <= COLOURS_MAX; c++) {
        o->blocks_of[c] = next;
        for (int64_t b = 0; b < s->n && c < 1 << s->dim; b++)
            if (block_colour(s, b) == c) rank[b] = next++;
    }
    o->blocks = next;
}

/* ---- room -------------------------------------------------------------------------------------------------------- */

/* Reserves memory in o->cell_start, the index of the first point of each cell in the list of points sorted by cell, for
 * at least `cells` cells. If the array is too short, a longer one replaces it and its contents are lost. */
static void cells_room(struct transfer_order *o, int32_t cells)
{
    if (o->cells_room >= cells + 1) return;
    memory_free(o->cell_start);
    o->cells_room = cells + cells / 8 + 1;
    o->cell_start = NEW("transfer.cell_start", o->cells_room, int32_t);
}

void transfer_order_reserve_arrays(struct transfer_order *o, int64_t point_count, int64_t block_count,
                                   int32_t cell_count)
{
    if (o->blocks_room < block_count + 1 || o->room < point_count) {
        memory_free(o->particle);
        memory_free(o->block_start);
        memory_free(o->block_cell);
        memory_free(o->inside), memory_free(o->left);
        memory_free(o->next_particle), memory_free(o->next_inside);
        o->particle = NEW("transfer.particle", point_count + ORDER_AHEAD, int32_t);
        o->next_particle = NEW("transfer.next_particle", point_count + ORDER_AHEAD, int32_t);
        o->inside = NEW("transfer.inside", point_count, uint16_t);
        o->next_inside = NEW("transfer.next_inside", point_count, uint16_t);
        o->left = NEW("transfer.left", point_count, uint8_t);
        o->block_start = NEW("transfer.block_start", block_count + 1, int32_t);
        o->block_cell = NEW("transfer.block_cell", block_count + 1, int32_t);
        o->blocks_room = (int)block_count + 1, o->room = point_count;
    }
    cells_room(o, cell_count);
}

/* ---- sorting ----------------------------------------------------------------------------------------------------- */

/* Number of bits that hold the number of a cell in its block. */
enum { INSIDE_BITS = 16 };

/* Working memory of a sort of points: by the ranks of their blocks (boxes of cells), for which each thread counts one
 * chunk of the list, then by cell inside each block. Points of a cell keep the order of the list, so the result does
 * not depend on the number of chunks. */
struct sorting {
    const struct particles *p;
    const struct grid *g;
    struct block_shape shape;
    const int32_t *list; /* [n] indices of the points */
    int64_t n;
    int chunks;
    int64_t *place[DIM_MAX];   /* [g->count] of a cell along each axis: its part of the number of the block, shifted by
                                  INSIDE_BITS, and of the number of the cell in the block */
    int32_t *rank;             /* [blocks] position of a block in the order by colour */
    int32_t *fill;             /* [chunks][blocks] number of points; then index of the next point */
    int32_t *key, *bucket;     /* [n] rank of a point's block; points sorted by rank */
    uint16_t *inside, *sorted; /* [n] cell in the block; sorted by rank */
};

/* Returns the index of the first entry of chunk number `chunk`, 0 to s->chunks, of the list of points; the list is
 * divided into s->chunks equal chunks, one per thread. */
static int64_t chunk_start(const struct sorting *s, int chunk) { return s->n * chunk / s->chunks; }

/* Fills the tables s->place[d], with one entry for each cell index along the axis d. The sum of one entry for each axis
 * encodes a cell of the grid: the upper bits are the number of its block (a box of cells), the lower INSIDE_BITS bits
 * the number of the cell in its block. */
static void cell_shares_find(struct sorting *s)
{
    int64_t blocks = 1, cells = 1;
    for (int d = 0; d < s->shape.dim; d++) {
        const int64_t edge = transfer_block_edge_length_in_cells(d), first = s->g->first[d];
        s->place[d] = BARE("transfer.place", s->g->count[d], int64_t);
        for (int64_t k = 0; k < s->g->count[d]; k++) {
            const int64_t b = block_of(first + k, edge);
            s->place[d][k] = (b - s->shape.first[d]) * blocks << INSIDE_BITS | (first + k - b * edge) * cells;
        }
        blocks *= s->shape.blocks[d], cells *= edge;
    }
}

/* Returns the rank of the block (a box of cells) that contains point i. Blocks are ranked by colour, then by number.
 * inside: receives the number of the point's cell in the block. g: copy of the grid s->g, which the compiler can keep
 * in registers; dim: number of dimensions, known at compile time. */
static ALWAYS_INLINE int32_t find_block(const struct sorting *s, const struct grid *g, int32_t i, uint16_t *inside,
                                        const int dim)
{
    int64_t place = 0;
#pragma GCC unroll 3
    for (int d = 0; d < dim; d++) place += s->place[d][grid_cell_index_at(g, d, s->p->x[d][i]) - g->first[d]];
    *inside = (uint16_t)place;
    return s->rank[place >> INSIDE_BITS];
}

/* Finds the block (a box of cells) and the cell of each point in one chunk, which is the part of the list of points
 * that one thread sorts. Stores the rank of the block in s->key and the cell in s->inside. Counts the points of the
 * chunk in each block in s->fill. dim: number of dimensions, known at compile time. */
static ALWAYS_INLINE void find_blocks(const struct sorting *s, int chunk, const int dim)
{
    int32_t *count = s->fill + chunk * s->shape.n, key = 0;
    array_fill_bytes(count, 0, s->shape.n, sizeof *count);
    int64_t from = chunk_start(s, chunk);
    const struct grid grid = *s->g;
    for (int64_t k = from; k < chunk_start(s, chunk + 1); k++) {
        const int32_t own = s->key[k] = find_block(s, &grid, s->list[k], &s->inside[k], dim);
        if (own == key) continue;
        count[key] += (int32_t)(k - from);
        key = own, from = k;
    }
    count[key] += (int32_t)(chunk_start(s, chunk + 1) - from);
}

/* Finds blocks and cells of the points in chunk number `chunk` of the list in s (the part of one thread). Calls the
 * copy of find_blocks that is compiled for the dimensions of the grid. */
static void find_blocks_of(const struct sorting *s, int chunk)
{
    switch (s->shape.dim) {
    case 1:
        find_blocks(s, chunk, 1);
        break;
    case 2:
        find_blocks(s, chunk, 2);
        break;
    default:
        find_blocks(s, chunk, 3);
    }
}

/* Computes where each thread stores its points when they are sorted by block (a box of cells). On entry,
 * s->fill[chunk][block] is the number of points of a block in a chunk, the part of the list that one thread sorts. It
 * is replaced by the index of the first of these points in the sorted list, in which a block's points are in the order
 * of the chunks. block_start[blocks + 1]: receives the index of the first point of each block. */
static void add_up(const struct sorting *s, int32_t *block_start)
{
    int32_t next = 0;
    for (int64_t b = 0; b < s->shape.n; b++) {
        block_start[b] = next;
        for (int chunk = 0; chunk < s->chunks; chunk++) {
            int32_t *at = &s->fill[chunk * s->shape.n + b], count = *at;
            *at = next, next += count;
        }
    }
    block_start[s->shape.n] = next;
}

/* Copies the points of one chunk (the part of the list that one thread sorts) to s->bucket, and the numbers of their
 * cells to s->sorted, both sorted by block (a box of cells). On entry, s->fill[chunk][block] is the index of the first
 * free entry for the points of this chunk in the block. */
static void put_in_blocks(const struct sorting *s, int chunk)
{
    int32_t *fill = s->fill + chunk * s->shape.n, key = 0, at = fill[0];
    for (int64_t k = chunk_start(s, chunk); k < chunk_start(s, chunk + 1); k++, at++) {
        if (s->key[k] != key) {
            fill[key] = at;
            key = s->key[k], at = fill[key];
        }
        s->bucket[at] = s->list[k], s->sorted[at] = s->inside[k];
    }
}

/* Largest number of cells of a block. */
enum { CELLS_IN_BLOCK_MOST = BLOCK_LENGTH * BLOCK_EDGE * BLOCK_EDGE };

/* Sorts the n particles of a block by cell (counting sort, stable). particle[n], inside[n]: the particles and their
 * cells in the block, below cells_in_block; particle_to[n], inside_to[n]: receive them sorted. Returns the number of
 * cells with particles. */
static int32_t sort_in_block(int32_t *particle, uint16_t *inside, int32_t n, int32_t *particle_to, uint16_t *inside_to,
                             int64_t cells_in_block)
{
    int32_t at[CELLS_IN_BLOCK_MOST], cells = 0, next = 0;
    if (n == 0) return 0;
    array_fill_bytes(at, 0, cells_in_block, sizeof *at);
    for (int32_t k = 0; k < n; k++) at[inside[k]]++;
    for (int64_t c = 0; c < cells_in_block; c++) {
        const int32_t count = at[c];
        at[c] = next;
        next += count, cells += count > 0;
    }
    for (int32_t k = 0; k < n; k++) {
        const int32_t to = at[inside[k]]++;
        particle_to[to] = particle[k], inside_to[to] = inside[k];
    }
    return cells;
}

/* Computes o->cell_start, the index of the first point of each cell in the sorted list of points. Only cells with
 * points are counted. Before the call, o->block_cell[b + 1] must be the number of cells with points in block b (a box
 * of cells); after it, o->block_cell[b] is the first cell of block b. */
static void find_cells(struct transfer_order *o)
{
    const uint16_t *inside = o->inside;
    o->block_cell[0] = 0;
    for (int b = 0; b < o->blocks; b++) o->block_cell[b + 1] += o->block_cell[b];
    o->cells = o->block_cell[o->blocks];
    cells_room(o, o->cells);
#pragma omp parallel for schedule(static)
    for (int b = 0; b < o->blocks; b++) {
        int32_t cell = o->block_cell[b];
        for (int32_t k = o->block_start[b]; k < o->block_start[b + 1]; k++)
            if (k == o->block_start[b] || inside[k] != inside[k - 1]) o->cell_start[cell++] = k;
    }
    o->cell_start[o->cells] = (int32_t)o->n;
}

/* Allocates the working memory of s, a sort of points by block (a box of cells) and cell; s->shape, s->g and s->n must
 * be set. The arrays are not cleared, since all entries are written before they are read. A grid without nodes has no
 * blocks, and then there are no chunks. */
static void sorting_make(struct sorting *s)
{
    s->chunks = s->shape.n > 0 ? omp_get_max_threads() : 0;
    s->rank = BARE("transfer.rank", s->shape.n, int32_t),
    s->fill = BARE("transfer.fill", s->chunks * s->shape.n, int32_t);
    s->key = BARE("transfer.key", s->n, int32_t), s->bucket = BARE("transfer.bucket", s->n, int32_t);
    s->inside = BARE("transfer.inside", s->n, uint16_t), s->sorted = BARE("transfer.sorted", s->n, uint16_t);
    cell_shares_find(s);
}

static void sorting_free(struct sorting *s)
{
    memory_free(s->rank), memory_free(s->fill);
    memory_free(s->key), memory_free(s->bucket);
    memory_free(s->inside), memory_free(s->sorted);
    for (int d = 0; d < DIM_MAX; d++) memory_free(s->place[d]);
}

/* Sorts the points s->list by block (a box of cells) into s->bucket, with the numbers of their cells in s->sorted.
 * block_start[blocks + 1]: receives the index of the first point of each block. */
static void sort_by_block(const struct sorting *s, int32_t *block_start)
{
#pragma omp parallel for schedule(static)
    for (int chunk = 0; chunk < s->chunks; chunk++) find_blocks_of(s, chunk);
    add_up(s, block_start);
#pragma omp parallel for schedule(static)
    for (int chunk = 0; chunk < s->chunks; chunk++) put_in_blocks(s, chunk);
}

void transfer_order_sort_points_by_cell(struct transfer_order *o, const struct particles *p, const int32_t *point_list,
                                        int64_t point_count, const struct grid *g)
{
    struct sorting s = {.p = p, .g = g, .shape = block_shape_of(g), .list = point_list, .n = point_count};
    transfer_order_reserve_arrays(o, point_count, s.shape.n, 0);
    sorting_make(&s);
    rank_blocks(o, &s.shape, s.rank);
    o->n = point_count;
    sort_by_block(&s, o->block_start);
#pragma omp parallel for schedule(dynamic, 16)
    for (int64_t b = 0; b < s.shape.n; b++) {
        const int32_t from = o->block_start[b];
        o->block_cell[b + 1] = sort_in_block(s.bucket + from, s.sorted + from, o->block_start[b + 1] - from,
                                             o->particle + from, o->inside + from, s.shape.cells_in_block);
    }
    find_cells(o);
    sorting_free(&s);
    array_fill_bytes(o->left, 0, o->n, sizeof *o->left);
}

/* ---- points that have left their cells --------------------------------------------------------------------------- */

int64_t transfer_order_list_points_that_left_cells(const struct transfer_order *o, int32_t *list)
{
    int64_t n = 0;
    const uint8_t *at = o->left, *const end = o->left + o->n;
    while (at < end && (at = memchr(at, 1, (size_t)(end - at)))) list[n++] = o->particle[at++ - o->left];
    return n;
}

/* Returns the number of points of block b (a box of cells) of o that have not left their cells. */
static int32_t count_staying(const struct transfer_order *o, int b)
{
    int32_t n = 0;
    for (int32_t k = o->block_start[b]; k < o->block_start[b + 1]; k++) n += !o->left[k];
    return n;
}

/* Returns true if a point with index i in cell number `cell` of a block precedes point j in cell number `other` of the
 * same block. */
static ALWAYS_INLINE bool precedes(uint16_t cell, int32_t i, uint16_t other, int32_t j)
{
    return cell < other || (cell == other && i < j);
}

/* Sorts the n points particle[n] of a block, with the numbers inside[n] of their cells, by cell, then by index, by
 * insertion: fast, because n is small, or the points are nearly in order in a body that flies through the grid. */
static void sort_few(int32_t *particle, uint16_t *inside, int32_t n)
{
    for (int32_t k = 1; k < n; k++) {
        const int32_t own = particle[k];
        const uint16_t cell = inside[k];
        int32_t to = k;
        for (; to > 0 && precedes(cell, own, inside[to - 1], particle[to - 1]); to--)
            particle[to] = particle[to - 1], inside[to] = inside[to - 1];
        particle[to] = own, inside[to] = cell;
    }
}

/* Writes the points of block b (a box of cells) of o, by ascending cell and then by ascending index, to
 * o->next_particle from entry `to` on, and their cells to o->next_inside. Merges two lists of that order: the points
 * that have stayed in their cells (o->particle), and those that have come from other cells, which are
 * s->bucket[arrived[b]] to s->bucket[arrived[b + 1] - 1] with their cells in s->sorted. Returns the number of cells
 * with points. */
static int32_t merge_block(struct transfer_order *o, const struct sorting *s, const int32_t *arrived, int b, int32_t to)
{
    const int32_t from = o->block_start[b], end = o->block_start[b + 1], last = arrived[b + 1];
    int32_t next = arrived[b], cells = 0, at = to;
    sort_few(s->bucket + next, s->sorted + next, last - next);
    for (int32_t k = from; k <= end; k++) {
        for (; next < last && (k == end || precedes(s->sorted[next], s->bucket[next], o->inside[k], o->particle[k]));
             next++, at++)
            o->next_particle[at] = s->bucket[next], o->next_inside[at] = s->sorted[next];
        if (k == end || o->left[k]) continue;
        o->next_particle[at] = o->particle[k], o->next_inside[at] = o->inside[k];
        at++;
    }
    for (int32_t k = to; k < at; k++) cells += k == to || o->next_inside[k] != o->next_inside[k - 1];
    return cells;
}

/* Replaces the list of the points of o by o->next_particle, in which block b (a box of cells) begins at start[b], and
 * clears the marks of points that have left their cells. */
static void take_next(struct transfer_order *o, const int32_t *start)
{
    int32_t *const particle = o->particle;
    uint16_t *const inside = o->inside;
    o->particle = o->next_particle, o->next_particle = particle;
    o->inside = o->next_inside, o->next_inside = inside;
    array_copy(o->block_start, start, o->blocks + 1, sizeof *start);
    array_fill_bytes(o->left, 0, o->n, sizeof *o->left);
    find_cells(o);
}

void transfer_order_move_points_that_left_cells(struct transfer_order *o, const struct particles *p,
                                                const int32_t *list, int64_t count, const struct grid *g)
{
    struct sorting s = {.p = p, .g = g, .shape = block_shape_of(g), .list = list, .n = count};
    int32_t *arrived = BARE("transfer.arrived", o->blocks + 1, int32_t);
    int32_t *start = BARE("transfer.start", o->blocks + 1, int32_t);
    sorting_make(&s);
    rank_blocks(o, &s.shape, s.rank);
    sort_by_block(&s, arrived);
    start[0] = 0;
    for (int b = 0; b < o->blocks; b++) start[b + 1] = start[b] + count_staying(o, b) + arrived[b + 1] - arrived[b];
#pragma omp parallel for schedule(static)
    for (int b = 0; b < o->blocks; b++) o->block_cell[b + 1] = merge_block(o, &s, arrived, b, start[b]);
    take_next(o, start);
    sorting_free(&s);
    memory_free(arrived), memory_free(start);
}

void transfer_order_free(struct transfer_order *o)
{
    memory_free(o->particle);
    memory_free(o->block_start);
    memory_free(o->block_cell);
    memory_free(o->cell_start);
    memory_free(o->inside), memory_free(o->left);
    memory_free(o->next_particle), memory_free(o->next_inside);
    memset(o, 0, sizeof *o);
}
