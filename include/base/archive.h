/* Archives of the state that must survive a restart. Each module lists its state in one function X_save_or_load(x, a),
 * which both saves and restores it. checkpoint.c connects the archive to a file. */
#ifndef CLEAVE_ARCHIVE
#define CLEAVE_ARCHIVE

#include "base.h"

/* Parts of the state of a run that an archive can contain. A state function X_save_or_load(x, a) saves and restores
 * nothing if none of the state of its module belongs to the part a->scope. */
enum archive_scope {
    ARCHIVE_ALL,      /* everything that a resumed run needs */
    ARCHIVE_REBUILD,  /* state passed on when a body is rebuilt with other particles, except particles, bonds, nodes and
                         files, which are handed over without a copy */
    ARCHIVE_TRIAL,    /* state changed by a trial equilibrium of load steps, except the bonds that it breaks */
    ARCHIVE_ACCOUNTS, /* sums since the start, saved before forces are computed that no step follows */
};

/* A store of named entries, in a checkpoint file or in memory. scope: part of the state of a run that it holds (all of
 * it, what a trial solution changes, ...). `saving` determines whether a call of `exchange` saves an entry (true) or
 * restores it (false), so that one function describes both. */
struct archive {
    bool saving;
    /* Saves or restores `size` bytes under a name that is unique in the archive ('/' and letters). Restoring fails if
     * the stored size differs. */
    status (*exchange)(struct archive *a, const char *name, void *data, size_t size);
    /* Returns the size of a stored entry [byte], -1 if there is none; for arrays that must be allocated first. */
    int64_t (*stored_size)(struct archive *a, const char *name);
    void *file; /* belongs to checkpoint.c */
    enum archive_scope scope;
    /* For restoring into a run with other particles: new index of each stored particle or mirror image, -1: it no
     * longer exists. NULL: the particles are those that were stored. */
    const int32_t *now;
};

/* Saves the variable `variable` to the archive a under the name `name` if a->saving, else restores it. On failure,
 * makes the calling function return the status. */
#define ARCHIVE_VALUE(a, name, variable) TRY((a)->exchange((a), (name), &(variable), sizeof(variable)))

/* Saves `element_count` elements of `element_size` bytes of `array`, one per particle (mirror images, i.e. copies
 * beyond planes of symmetry, included), under the name `name` if a->saving, else restores them. If a->now is not NULL
 * while restoring, the run has other particles than the stored one: each element is stored at the new index of its
 * particle, and elements of particles that were not stored keep their value. Returns the status of a->exchange. */
status archive_save_or_load_particle_array(struct archive *a, const char *name, void *array, int64_t element_count,
                                           size_t element_size);

/* Replaces each restored particle index particle_index[k], k = 0 .. index_count - 1, by the new index of that particle,
 * a->now[particle_index[k]]; -1 if the particle no longer exists. Does nothing while saving, or if a->now is NULL
 * (equal particles). */
void archive_renumber_restored_particle_indices(const struct archive *a, int32_t *particle_index, int64_t index_count);

#endif
