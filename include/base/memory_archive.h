/* An archive (base/archive.h) in memory. */
#ifndef CLEAVE_MEMORY_ARCHIVE
#define CLEAVE_MEMORY_ARCHIVE

#include "base/archive.h"

/* A stored entry of an archive: a copy of `size` bytes at `data`, owned by the archive. */
struct memory_entry {
    void *data;
    size_t size;
};

/* An archive (base/archive.h) whose entries are copies in memory, owned by the archive. */
struct memory_archive {
    struct archive archive;     /* must be first: `exchange` converts its pointer */
    int64_t n, next;            /* entries; next one to be restored */
    struct memory_entry *entry; /* [n] in the order of saving */
};

/* Initialises the empty archive in memory m, open for saving. scope: part of the state of a run that the archive is to
 * hold (all of it, what a trial solution changes, ...). State is saved by calling the state functions of the modules
 * with &m->archive. Release with memory_archive_free. */
void memory_archive_open_for_saving(struct memory_archive *m, enum archive_scope scope);

/* Switches the archive in memory m from saving to restoring and returns to its first entry. The state functions, called
 * in the same order with &m->archive, then restore what they saved. The function may be called repeatedly. */
void memory_archive_rewind_for_loading(struct memory_archive *m);

/* Frees all entries of the archive in memory m. Does nothing if m has no entries. */
void memory_archive_free(struct memory_archive *m);

#endif
