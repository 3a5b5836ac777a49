/* Hashes of files, and the footer that detects damaged HDF5 files.
 * The footer is 24 bytes appended to the file: a magic number, the number of preceding bytes and their hash. HDF5
 * and all programs that read through it ignore the footer. A changed, missing or additional byte makes the footer
 * invalid. */
#ifndef CLEAVE_CHECKSUM
#define CLEAVE_CHECKSUM

#include "base/base.h"

/* Length of the footer that is appended to HDF5 files [byte]. */
enum { FOOTER_BYTES = 24 };

/* Appends the footer (magic number, number of the bytes before it, their hash) to PATH.cleave.tmp, the temporary file
 * of `path`, and synchronises the file with the disk. Returns FAILED, with PATH.cleave.tmp removed, if the file cannot
 * be written. */
status file_append_checksum_footer(const char *path);

/* Returns true if the regular file `path` ends with a footer, so that Cleave wrote it. The hash in the footer is not
 * checked. Returns false also if the file cannot be read. */
bool file_has_checksum_footer(const char *path);

/* Checks the length and the hash of the file `path` by its footer. Returns NULL if the file is complete and unchanged,
 * else a static text that completes "PATH ..." in a message, for example "is cut short". A file that cannot be read
 * counts as faulty. */
const char *file_describe_damage(const char *path);

/* Checks the length and the hash of the file `path` by its footer. Returns NULL if the file is complete and unchanged,
 * or if it cannot be read; otherwise a static text that completes "PATH ..." in a message. Only damage that is certain
 * is thus reported. */
const char *file_describe_damage_ignoring_read_errors(const char *path);

/* Returns a hash of `length` bytes from `bytes` on. previous_hash: a number on which the hash depends, too, for example
 * the hash of the bytes before these. */
uint64_t bytes_hash(uint64_t previous_hash, const void *bytes, size_t length);

/* Computes a hash of the contents of the regular file `path` and stores it in *hash. Returns REFUSED if the file
 * cannot be read. */
status file_contents_hash(const char *path, uint64_t *hash);

#endif
