/* State that must survive a restart, described once for both directions. A module lists its state in one
 * function `x_archive(x, a)`; the same function saves and restores. checkpoint.c gives the archive its file. */
#ifndef CLEAVE_ARCHIVE
#define CLEAVE_ARCHIVE

#include "base.h"

/* Which state an archive holds: all that a resumed run needs, or what a trial equilibrium of load steps changes (but
 * bonds that it breaks, which a list mends). A function of state that a trial does not change exchanges nothing. */
enum archive_scope { ARCHIVE_ALL, ARCHIVE_TRIAL };

struct archive {
    bool saving;
    /* Saves or restores `size` bytes under a name that is unique in the archive ('/' and letters). Restoring
     * FAILS if the stored size differs. */
    status (*exchange)(struct archive *a, const char *name, void *data, size_t size);
    /* Size of a stored entry [byte], -1 if there is none; for arrays that must be allocated before. */
    int64_t (*stored_size)(struct archive *a, const char *name);
    void *file; /* belongs to checkpoint.c */
    enum archive_scope scope;
};

#define ARCHIVE_VALUE(a, name, variable) TRY((a)->exchange((a), (name), &(variable), sizeof(variable)))

#endif
