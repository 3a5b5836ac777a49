/* An archive (base/archive.h) that keeps state in memory. */
#ifndef CLEAVE_MEMORY_ARCHIVE
#define CLEAVE_MEMORY_ARCHIVE

#include "base/archive.h"

struct memory_entry {
    void *data;
    size_t size;
};

struct memory_archive {
    struct archive archive;     /* first: `exchange` finds its entries by it */
    int64_t n, next;            /* entries; the next one to be given back */
    struct memory_entry *entry; /* [n] in the order in which they came */
};

/* Initialises an empty archive to save into. Functions of state receive &m->archive. */
void memory_archive_make(struct memory_archive *m, enum archive_scope scope);

/* Turns a saved archive to restoring, from its first entry; it can be restored any number of times. */
void memory_archive_rewind(struct memory_archive *m);

/* Frees the entries. Does nothing if there are none. */
void memory_archive_free(struct memory_archive *m);

#endif
