/* State that must survive a restart, described once for both directions. A module lists its state in one
 * function `x_archive(x, a)`; the same function saves and restores. checkpoint.c gives the archive its file. */
#ifndef CLEAVE_ARCHIVE
#define CLEAVE_ARCHIVE

#include "base.h"

/* Which state an archive holds. A function of state whose part is not concerned exchanges nothing. */
enum archive_scope {
    ARCHIVE_ALL,      /* all that a resumed run needs */
    ARCHIVE_REBUILD,  /* what a run passes on to one with other particles of the same body, but for particles, bonds,
                       * nodes and files, which change hands without a copy */
    ARCHIVE_TRIAL,    /* what a trial equilibrium of load steps changes, but for the bonds that it breaks */
    ARCHIVE_ACCOUNTS, /* sums since the start: forces may be computed that no step follows */
};

struct archive {
    bool saving;
    /* Saves or restores `size` bytes under a name that is unique in the archive ('/' and letters). Restoring
     * FAILS if the stored size differs. */
    status (*exchange)(struct archive *a, const char *name, void *data, size_t size);
    /* Size of a stored entry [byte], -1 if there is none; for arrays that must be allocated before. */
    int64_t (*stored_size)(struct archive *a, const char *name);
    void *file; /* belongs to checkpoint.c */
    enum archive_scope scope;
    /* Restoring into a run with other particles: [stored particles and images] their indices there, -1 if they are
     * absent. NULL: the particles are the same. */
    const int32_t *now;
};

#define ARCHIVE_VALUE(a, name, variable) TRY((a)->exchange((a), (name), &(variable), sizeof(variable)))

/* Saves or restores an array of n elements, one a particle (and image), of `size` bytes each. Where archive->now is
 * set, elements are restored to the new indices of their particles; those of particles that were absent keep their
 * value. */
status archive_by_particle(struct archive *a, const char *name, void *array, int64_t n, size_t size);

/* Replaces n restored indices of particles by their new ones. Does nothing while saving, or if archive->now is NULL. */
void archive_renumber(const struct archive *a, int32_t *index, int64_t n);

#endif
