/* floor 1: rest where nothing happens: which blocks of a body are awake.
 *
 * Forces follow from places. Once they have been computed for places that nobody has left, have come out as 0, and nothing
 * else moves a block, computing them again gives the same: the block sleeps, and no bit of a run knows. It wakes when somebody
 * within its reach leaves his place, and stays awake then.
 *
 *     level 0        asleep: neither forces nor motion
 *           1        awake: its forces are computed, it moves
 *           most     it has moved, or something moves it; who is next to it has one level less */
#ifndef CLEAVE_REST_H
#define CLEAVE_REST_H

#include "base.h"

struct particles;
struct bonds;
struct loads;

enum { REST_ROWS = 64 };                 /* rows of bonds in a block; a multiple of LANES                 */

struct rest {
    bool settled;                        /* who sleeps has been found; before all are awake               */
    int64_t blocks, awake;
    uint8_t *level, *moved;              /* [blocks]; scratch                                             */
    int32_t *list;                       /* [awake] ascending: what the hot loops visit                   */
};

/* All awake. */
void rest_make(struct rest *r, int64_t blocks);
void rest_free(struct rest *r);
/* The list of who is awake, for the levels of now. */
void rest_list(struct rest *r);

/* Rows of bonds, after a step in which forces of all awake have been computed: finds who sleeps in rows just made, else
 * wakes who is next to what has moved. */
void rest_rows(struct bonds *b, const struct particles *p, const struct loads *l);

/* Does the block of a row sleep? */
static inline bool rest_asleep(const struct rest *r, int64_t row) { return r->level[row / REST_ROWS] == 0; }

/* First row of the k-th block that is awake, and the one behind its last. */
static inline int64_t rest_first(const struct rest *r, int64_t k) { return (int64_t)r->list[k] * REST_ROWS; }
static inline int64_t rest_end(const struct rest *r, int64_t k, int64_t rows)
{
    const int64_t end = rest_first(r, k) + REST_ROWS;
    return end < rows ? end : rows;
}

#endif
