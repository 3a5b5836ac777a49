/* floor 1: rest where nothing happens: which blocks of a body are awake.
 *
 * Forces follow from places. Once they have been computed for places that nobody has left, have come out as 0, and nothing
 * else moves a block, computing them again gives the same: the block sleeps, and no bit of a run knows. It wakes when somebody
 * within its reach leaves his place, and stays awake then.
 *
 * A block is what the hot loops take at once: a group of eight rows of bonds; eight nodes of a mesh along x.
 *
 *     level 0        asleep: neither forces nor motion
 *           1        awake: its forces are computed, it moves
 *           most     it has moved, or something moves it; who is next to it has one level less */
#ifndef CLEAVE_REST_H
#define CLEAVE_REST_H

#include "base/archive.h"

struct particles;
struct bonds;
struct loads;
struct mesh;

struct rest {
    bool settled;                        /* who sleeps has been found; before all are awake               */
    int64_t blocks, awake, empty;        /* in all; visited; of no body                                   */
    uint8_t *level, *moved;              /* [blocks]; scratch                                             */
    int32_t *list;                       /* [awake] ascending: what the hot loops visit                   */
    bool resumed;                        /* all are visited, in the first step after a restart            */
    bool over;                           /* of rows: who is awake has moved, so nobody will wake any more */
};

/* All awake. */
void rest_make(struct rest *r, int64_t blocks);
void rest_free(struct rest *r);
/* The list of who is awake, for the levels of now. */
void rest_list(struct rest *r);

/* Who sleeps, under this name. Once restored all are visited in the next step whoever sleeps, as what a sleeper would
 * have computed is not in the checkpoint. */
status rest_archive(struct rest *r, const char *name, struct archive *a);

/* Groups of rows of bonds, after a step in which forces of all awake have been computed: finds who sleeps in rows just made, else
 * wakes who is next to what has moved. */
void rest_rows(struct bonds *b, const struct particles *p, const struct loads *l);

/* The same of the nodes of a mesh, a cell being where its lowest node is; whoever sees other points than before, or has changed
 * what nodes do, says so by rest_mesh_see or rest_mesh_all. */
void rest_mesh(struct mesh *mesh, const struct loads *l);
void rest_mesh_see(struct mesh *mesh);
void rest_mesh_all(struct mesh *mesh);

/* Share of the blocks that sleep. */
static inline real rest_share(const struct rest *r)
{
    const int64_t blocks = r->blocks - r->empty;
    return blocks > 0 && r->awake < blocks ? 1 - (real)r->awake / (real)blocks : 0;
}

#endif
