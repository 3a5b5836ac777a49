/* The order of transfers between points and the grid: grid cells in coloured blocks over current positions. */
#ifndef CLEAVE_TRANSFER_ORDER
#define CLEAVE_TRANSFER_ORDER

#include "grid.h"
#include "particles.h"

/* Grid cells are grouped in blocks, BLOCK_LENGTH cells long in x, along which particles lie in memory, and
 * BLOCK_EDGE wide in the other directions; a block has one of 2^dim colours, and blocks of one colour share no node
 * for any shape function here (support reaches one cell below and two above), so each may be scattered by its own
 * thread. Colours are taken in order and a block by one thread: the same bits on any number of threads. Blocks are
 * counted from the grid's absolute node 0, so that growing the grid keeps them. */
enum { BLOCK_LENGTH = 64, BLOCK_EDGE = 4, COLOURS_MAX = 8 };
/* The order is padded by this many entries, so that prefetching may read beyond its end. */
enum { ORDER_AHEAD = 64 };

static ALWAYS_INLINE int64_t block_edge(int d) { return d == 0 ? BLOCK_LENGTH : BLOCK_EDGE; }

struct transfer_order {
    int64_t n, room;                /* particles on the grid; at most without new arrays */
    int32_t *particle;              /* by colour, then block, then cell, then index */
    int blocks_of[COLOURS_MAX + 1]; /* blocks of colour c: blocks_of[c] .. blocks_of[c+1]-1 */
    int blocks, blocks_room;
    int32_t *block_start;      /* particles of block b: block_start[b] .. block_start[b+1]-1 */
    int32_t cells, cells_room; /* that hold particles */
    int32_t *cell_start;       /* particles of cell c: cell_start[c] .. cell_start[c+1]-1 */
    int32_t *block_cell;       /* cells of block b: block_cell[b] .. block_cell[b+1]-1 */
};

/* Sorts the `n` listed particles by the grid cell they are in; a function of positions alone. */
void transfer_order_sort(struct transfer_order *o, const struct particles *p, const int32_t *list, int64_t n,
                         const struct grid *g);
/* Room for so many; more than there was: what was there is gone. Leaves n, blocks and cells as they were. */
void transfer_order_room(struct transfer_order *o, int64_t n, int64_t blocks, int32_t cells);
void transfer_order_free(struct transfer_order *o);

#endif
