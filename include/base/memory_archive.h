/* An archive (base/archive.h) in memory. */
#ifndef CLEAVE_MEMORY_ARCHIVE
#define CLEAVE_MEMORY_ARCHIVE

#include "base/archive.h"

/* A stored entry; owned. */
struct memory_entry {
    void *data;
    size_t size;
};

/* The archive. */
struct memory_archive {
    struct archive archive;     /* must be first: `exchange` converts its pointer */
    int64_t n, next;            /* entries; next one to be restored */
    struct memory_entry *entry; /* [n] in the order of saving */
};

/* Initialises an empty archive for saving. State functions are given &m->archive. Release with memory_archive_free. */
void memory_archive_make(struct memory_archive *m, enum archive_scope scope);

/* Switches a saved archive to restoring, from its first entry; may be called any number of times. */
void memory_archive_rewind(struct memory_archive *m);

/* Releases the entries. Does nothing if there are none. */
void memory_archive_free(struct memory_archive *m);

#endif
