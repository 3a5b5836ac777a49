/* The active set: what no wave has reached is not computed, and no bit of a run changes.
 *
 * Forces follow from places. A block whose particles stand where forces were last computed, came out as 0, and which no
 * load moves would get the same forces again: it is inactive. It becomes active when a particle within its reach
 * moves, and stays active from then on.
 *
 * A block is what the hot loops visit at once: a row block of eight rows of bonds, or eight nodes of a mesh along x.
 *
 *     level 0        inactive: neither forces nor motion
 *           1        active: its forces are computed, it moves
 *           most     it has moved, or a load moves it; its neighbours have one level less, and so on */
#ifndef CLEAVE_ACTIVE_SET
#define CLEAVE_ACTIVE_SET

#include "base/archive.h"

struct active_set {
    bool is_current;               /* levels have been found; before, all blocks are active */
    int64_t blocks, active, empty; /* in all; active; without particles */
    uint8_t *level, *moved;        /* [blocks]; scratch */
    int32_t *list;                 /* [active] ascending: the blocks that the hot loops visit */
    bool resumed;                  /* all blocks are visited, in the first step after a restart */
    bool over;                     /* of rows: all active blocks have moved, so no other will become active */
};

/* All blocks active. */
void active_set_make(struct active_set *r, int64_t blocks);
void active_set_free(struct active_set *r);
/* Makes the list of active blocks from the levels. */
void active_set_list(struct active_set *r);

/* Levels under this name. Once restored all blocks are visited in the next step, for the forces of inactive blocks
 * are not in the checkpoint. */
status active_set_archive(struct active_set *r, const char *name, struct archive *a);

/* Share of the blocks that is inactive [1]. */
static inline real inactive_share(const struct active_set *r)
{
    const int64_t blocks = r->blocks - r->empty;
    return blocks > 0 && r->active < blocks ? 1 - (real)r->active / (real)blocks : 0;
}

#endif
