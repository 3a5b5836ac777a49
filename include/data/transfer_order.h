/* The order of transfers between points and the grid: grid cells in coloured blocks over current positions. */
#ifndef CLEAVE_TRANSFER_ORDER
#define CLEAVE_TRANSFER_ORDER

#include "grid.h"
#include "particles.h"

/* Defines the blocks in which grid cells are grouped for transfers. A block is BLOCK_LENGTH cells long in x, the
 * direction in which particles are consecutive in memory, and BLOCK_EDGE cells wide in the other directions. It has one
 * of 2^dim colours. Blocks of one colour share no node for any of the shape functions, which extend from one cell below
 * to two above, so that threads may add to nodes in parallel. Colours are processed in order, and a block by one
 * thread: the result has equal bits with any number of threads. Blocks are counted from the grid's absolute node 0, so
 * that they do not change when the grid grows. */
enum { BLOCK_LENGTH = 64, BLOCK_EDGE = 4, COLOURS_MAX = 8 };

/* Number of entries allocated beyond the end of transfer_order.particle, so that prefetching may read there. */
enum { ORDER_AHEAD = 64 };

/* Returns the number of grid cells of a block along axis `axis` (0 .. 2). Blocks are boxes of grid cells by which
 * particles are sorted. */
static ALWAYS_INLINE int64_t transfer_block_edge_length_in_cells(int axis)
{
    return axis == 0 ? BLOCK_LENGTH : BLOCK_EDGE;
}

/* The order in which material points on the grid are processed: by colour, block (a box of grid cells) and cell, where
 * blocks of one colour share no node and may be processed in parallel. All arrays are owned. */
struct transfer_order {
    int64_t n, room;                /* number of particles on the grid; capacity of `particle` */
    int32_t *particle;              /* [n] indices, sorted by colour, then block, then cell, then index */
    uint16_t *inside;               /* [n] number of the cell of particle[k] in its block */
    uint8_t *left;                  /* [n] 1: particle[k] has left its cell since the sort, set by g2p; else 0 */
    int32_t *next_particle;         /* [n] working memory for the next order of the particles */
    uint16_t *next_inside;          /* [n] working memory for the numbers of their cells */
    int blocks_of[COLOURS_MAX + 1]; /* blocks of colour c: blocks_of[c] .. blocks_of[c+1]-1 */
    int blocks, blocks_room;        /* number of blocks with particles; capacity of their arrays */
    int32_t *block_start;           /* entries of `particle` in block b: block_start[b] .. block_start[b+1]-1 */
    int32_t cells, cells_room;      /* number of cells with particles; capacity of cell_start */
    int32_t *cell_start;            /* entries of `particle` in cell c: cell_start[c] .. cell_start[c+1]-1 */
    int32_t *block_cell;            /* cells of block b: block_cell[b] .. block_cell[b+1]-1 */
};

/* Sorts the particles of p listed in point_list[point_count] by the cell of grid g that contains their position, and
 * these cells by block (a box of cells). Blocks are sorted by colour; blocks of one colour are not adjacent. Stores
 * this order in o, whose arrays grow as needed. The order depends on positions alone, not on the number of threads. */
void transfer_order_sort_points_by_cell(struct transfer_order *o, const struct particles *p, const int32_t *point_list,
                                        int64_t point_count, const struct grid *g);

/* Lists the indices of the particles of o that have left their cells (o->left) in `list`, which has room for o->n
 * entries. Returns the number of these particles. */
int64_t transfer_order_list_points_that_left_cells(const struct transfer_order *o, int32_t *list);

/* Sorts the particles (of p) in o, to the same order as transfer_order_sort_points_by_cell, where only the particles
 * list[count] have left their cells (transfer_order_list_points_that_left_cells), and clears their entries of o->left.
 * The box of the grid g must be that of the previous sort. */
void transfer_order_move_points_that_left_cells(struct transfer_order *o, const struct particles *p,
                                                const int32_t *list, int64_t count, const struct grid *g);

/* Enlarges the arrays of o, if necessary, for `point_count` particles, `block_count` blocks (boxes of grid cells) and
 * `cell_count` cells; the contents of an array that grows are lost. Does not change o->n, o->blocks and o->cells. */
void transfer_order_reserve_arrays(struct transfer_order *o, int64_t point_count, int64_t block_count,
                                   int32_t cell_count);

/* Releases all arrays of the order o of material points. */
void transfer_order_free(struct transfer_order *o);

#endif
