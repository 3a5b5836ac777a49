/* An archive (base/archive.h) that keeps state in memory: what a trial has to give back. */
#ifndef CLEAVE_MEMORY_ARCHIVE
#define CLEAVE_MEMORY_ARCHIVE

#include "base/archive.h"

struct memory_entry { void *data; size_t size; };

struct memory_archive {
    struct archive archive;              /* first: `exchange` finds its entries by it */
    int64_t n, next;                     /* entries; the next one to be given back */
    struct memory_entry *entry;          /* [n] in the order in which they came */
};

/* An empty archive, to save into. Address: that of `archive` alone. */
void memory_archive_make(struct memory_archive *m);
/* From here on it gives back what it has, in the order in which it came. */
void memory_archive_rewind(struct memory_archive *m);
void memory_archive_free(struct memory_archive *m);

#endif
