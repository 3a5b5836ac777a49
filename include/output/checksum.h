/* Hashes of files, and a footer behind the last byte of HDF5 files: 24 bytes, a mark, the number of bytes
 * before and a hash of them. The library, and all that reads by it, opens such a file as if nothing were there;
 * every changed, lost or added byte shows. */
#ifndef CLEAVE_CHECKSUM
#define CLEAVE_CHECKSUM

#include "base/base.h"

enum { FOOTER_BYTES = 24 };

/* Puts the footer behind PATH.cleave.tmp and syncs it. On a fault PATH.cleave.tmp is removed. */
status file_seal_whole(const char *path);

/* What is wrong with a file that ought to have a footer, to be put behind its name; NULL: it is whole. */
const char *whole_fault(const char *path);
/* The same; NULL as well where it cannot be read, and may be whole. */
const char *whole_fault_certain(const char *path);

/* Hash of a regular file's contents; REFUSED where it cannot be read. */
status file_contents(const char *path, uint64_t *hash);

#endif
