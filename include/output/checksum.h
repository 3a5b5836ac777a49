/* Hashes of files, and the footer that detects damaged HDF5 files.
 * The footer is 24 bytes appended to the file: a magic number, the number of preceding bytes and their hash. HDF5
 * and all programs that read through it ignore the footer. A changed, missing or additional byte makes the footer
 * invalid. */
#ifndef CLEAVE_CHECKSUM
#define CLEAVE_CHECKSUM

#include "base/base.h"

enum { FOOTER_BYTES = 24 };

/* Appends the footer (magic number, number of preceding bytes, hash) to the temporary file PATH.cleave.tmp and syncs
 * the file to disk. Returns FAILED if the file cannot be written; PATH.cleave.tmp is removed then. */
status file_append_footer(const char *path);

/* Returns true if the regular file `path` ends with a footer, whether or not its bytes are those that were written:
 * Cleave wrote the file. Returns false also if the file cannot be read. */
bool file_has_footer(const char *path);

/* Checks the footer of the file `path`. Returns NULL if the file is whole, else a phrase that completes "PATH ..." in
 * a message, for example "is cut short" (a static text). A file that cannot be read counts as faulty. */
const char *file_describe_damage(const char *path);

/* Checks the footer of the file `path` as file_describe_damage does, but returns NULL also if the file cannot be read,
 * so that only damage that is certain is reported. */
const char *file_describe_certain_damage(const char *path);

/* Returns a hash of `length` bytes from `bytes` on. start: a number that the hash also depends on, as the hash of what
 * precedes these bytes. */
uint64_t bytes_hash(uint64_t start, const void *bytes, size_t length);

/* Computes a hash of the contents of the regular file `path` and stores it in *hash. Returns REFUSED if the file
 * cannot be read. */
status file_contents_hash(const char *path, uint64_t *hash);

#endif
