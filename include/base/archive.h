/* State that must survive a restart, described once for saving and restoring. A module lists its state in one function
 * `x_archive(x, a)`; the same function saves and restores. checkpoint.c connects the archive to a file. */
#ifndef CLEAVE_ARCHIVE
#define CLEAVE_ARCHIVE

#include "base.h"

/* State in an archive. A state function without state of a scope exchanges nothing in it. */
enum archive_scope {
    ARCHIVE_ALL,      /* everything that a resumed run needs */
    ARCHIVE_REBUILD,  /* state passed on when a body is rebuilt with other particles, except particles, bonds, nodes and
                         files, which are handed over without a copy */
    ARCHIVE_TRIAL,    /* state changed by a trial equilibrium of load steps, except the bonds that it breaks */
    ARCHIVE_ACCOUNTS, /* sums since the start, saved before forces are computed that no step follows */
};

/* A store of named entries (a checkpoint, or memory), open either for saving or for restoring. */
struct archive {
    bool saving;
    /* Saves or restores `size` bytes under a name that is unique in the archive ('/' and letters). Restoring fails if
     * the stored size differs. */
    status (*exchange)(struct archive *a, const char *name, void *data, size_t size);
    /* Returns the size of a stored entry [byte], -1 if there is none; for arrays that must be allocated first. */
    int64_t (*stored_size)(struct archive *a, const char *name);
    void *file; /* belongs to checkpoint.c */
    enum archive_scope scope;
    /* Restoring into a run with other particles: [stored particles and images] new index of each, -1: absent. NULL:
     * equal particles. */
    const int32_t *now;
};

/* Saves or restores a variable; returns from the calling function on failure. */
#define ARCHIVE_VALUE(a, name, variable) TRY((a)->exchange((a), (name), &(variable), sizeof(variable)))

/* Saves or restores an array of n elements of `size` bytes, one per particle (and image). If archive->now is set,
 * elements are restored to the new indices of their particles; elements of particles that were absent keep their
 * value. */
status archive_particle_array(struct archive *a, const char *name, void *array, int64_t n, size_t size);

/* Replaces n restored indices of particles by their new ones. Does nothing while saving, or if archive->now is NULL. */
void archive_renumber(const struct archive *a, int32_t *index, int64_t n);

#endif
