/* floor 1: cells for the two searches of the program: fixed cells over reference positions (families of
 * bonds), and grid cells in coloured blocks over current positions (transfers). */
#ifndef CLEAVE_CELLS_H
#define CLEAVE_CELLS_H

#include "particles.h"

/* ---- search over reference positions: body and images --------------------------------------------- */

struct cells {
    int dim;
    int64_t count[DIM_MAX], n;           /* cells per direction, in all                              */
    real origin[DIM_MAX];                /* lower corner                                   [m]       */
    real edge, width;                    /* largest radius that is meant; of a cell        [m]       */
    int32_t *start;                      /* particles of cell c: order[start[c] .. start[c+1]-1]     */
    int32_t *order;                      /* ascending inside a cell                                  */
};

void cells_make(struct cells *c, const struct particles *p, real edge);
void cells_free(struct cells *c);

/* Particles (body and images) within `radius` <= edge of the point X, ascending; `skip` is left out (-1: none).
 * Writes at most `room` indices; returns how many there are. */
int cells_near(const struct cells *c, const struct particles *p, const real *X, real radius, int32_t skip,
               int32_t *found, int room);

/* At least as many as cells_near finds round any of the particles, themselves included; at most those of the square that
 * holds the circle. Cheap: it counts cells. */
int cells_most(const struct cells *c, real radius);

/* The same round particle i, itself included if wanted, into a list that grows as needed; at NULL to begin with, whoever holds
 * it frees it. */
struct near { int32_t *at; int n, room; };
void near_find(struct near *near, const struct cells *c, const struct particles *p, int64_t i, real radius, bool itself);
/* The same in the order of cells: a little faster where there are images, and as good where order does not matter. */
void near_find_any(struct near *near, const struct cells *c, const struct particles *p, int64_t i, real radius, bool itself);

/* ---- the order of transfers ------------------------------------------------------------------------ */

/* Grid cells are grouped in blocks, BLOCK_LENGTH cells long in x, along which particles lie in memory, and BLOCK_EDGE wide
 * in the other directions; a block has one of 2^dim colours, and blocks of one colour share no node for any shape function
 * here (support reaches one cell below and two above), so each may be scattered by its own thread. Colours are taken in
 * order and a block by one thread: the same bits on any number of threads. Blocks are counted from the grid's absolute
 * node 0, so that growing the grid keeps them. */
enum { BLOCK_LENGTH = 64, BLOCK_EDGE = 4, COLOURS_MAX = 8 };
/* Entries of the order may be read this far beyond its end: what they hold stands first in line to be fetched. */
enum { ORDER_AHEAD = 64 };

static inline int64_t block_edge(int d) { return d == 0 ? BLOCK_LENGTH : BLOCK_EDGE; }

/* Block of cell k in direction d. */
static inline int64_t block_of(int64_t k, int d)
{
    const int64_t edge = block_edge(d);
    return k >= 0 ? k / edge : -((-k + edge - 1) / edge);
}

struct transfer_order {
    int64_t n, room;                     /* particles on the grid; at most without new arrays        */
    int32_t *particle;                   /* by colour, then block, then cell, then index             */
    int blocks_of[COLOURS_MAX + 1];      /* blocks of colour c: blocks_of[c] .. blocks_of[c+1]-1     */
    int blocks, blocks_room;
    int32_t *block_start;                /* particles of block b: block_start[b] .. block_start[b+1]-1 */
    int32_t cells, cells_room;           /* that hold particles                                      */
    int32_t *cell_start;                 /* particles of cell c: cell_start[c] .. cell_start[c+1]-1  */
    int32_t *block_cell;                 /* cells of block b: block_cell[b] .. block_cell[b+1]-1     */
};

struct grid;
/* Sorts the `n` listed particles by the grid cell they are in; a function of positions alone. */
void transfer_order_sort(struct transfer_order *o, const struct particles *p, const int32_t *list, int64_t n,
                         const struct grid *g);
/* Room for so many; more than there was: what was there is gone. Leaves n, blocks and cells as they were. */
void transfer_order_room(struct transfer_order *o, int64_t n, int64_t blocks, int32_t cells);
void transfer_order_free(struct transfer_order *o);

#endif
