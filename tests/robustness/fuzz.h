/* Targets of the fuzzer (fuzz.c): each takes any bytes and comes back; what may not be ends the process. */
#ifndef CLEAVE_TESTS_FUZZ
#define CLEAVE_TESTS_FUZZ

#include <stddef.h>
#include <stdint.h>

void fuzz_scene(const uint8_t *bytes, size_t n);      /* the text of a scene */
void fuzz_override(const uint8_t *bytes, size_t n);   /* lines KEY=VALUE over a good scene */
void fuzz_list(const uint8_t *bytes, size_t n);       /* a particle list in CSV; the first byte gives the dimension */
void fuzz_checkpoint(const uint8_t *bytes, size_t n); /* a checkpoint; its footer is made right */
void fuzz_valid(const uint8_t *bytes, size_t n);      /* choices that make a scene which may be run */

/* A first input for the checkpoint; NULL: none could be made. Free with free. */
uint8_t *fuzz_checkpoint_seed(size_t *n);

/* Ends the process with a line. */
_Noreturn void fuzz_fail(const char *why, const char *words);

#endif
