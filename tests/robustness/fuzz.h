/* Targets of the fuzzer (fuzz.c): each accepts any bytes and returns; a violation ends the process. */
#ifndef CLEAVE_TESTS_FUZZ
#define CLEAVE_TESTS_FUZZ

#include <stddef.h>
#include <stdint.h>

/* Reads bytes[n] as a scene, which is accepted or refused in one line; an accepted scene is written, read back and
 * written identically. */
void fuzz_scene(const uint8_t *bytes, size_t n);

/* Reads a valid scene with bytes[n] as overrides, lines KEY=VALUE. */
void fuzz_override(const uint8_t *bytes, size_t n);

/* Reads bytes[n] as a particle list in CSV; the first byte determines the dimension. */
void fuzz_list(const uint8_t *bytes, size_t n);

/* Reads bytes[n] as an Exodus II file, both as a mesh and as a list of particles. */
void fuzz_exodus(const uint8_t *bytes, size_t n);

/* Reads bytes[n] as a checkpoint, with a footer that contains the hash of these bytes. */
void fuzz_checkpoint(const uint8_t *bytes, size_t n);

/* Composes the text of a scene by choices according to bytes[n], and runs it if it is valid. */
void fuzz_valid(const uint8_t *bytes, size_t n);

/* Creates a valid checkpoint as the first input of fuzz_checkpoint. Returns its bytes, to be released with free, and
 * stores their number in *n; NULL if none could be created. */
uint8_t *fuzz_checkpoint_seed(size_t *n);

/* Creates valid Exodus II file number `number`, from 0, as an initial input of fuzz_exodus. Returns its bytes, to be
 * released with free, and stores their number in *n; NULL if there are no more. */
uint8_t *fuzz_exodus_seed(int number, size_t *n);

/* Prints a line with the reason `why` and the text `words`, and aborts the process: a target has violated a rule. */
_Noreturn void fuzz_fail(const char *why, const char *words);

#endif
