/* How a kernel is declared. The files of kernels/ are compiled once for each set of vector instructions
 * (Makefile), all into one program; src/simd/simd.c takes a set at start.
 *
 * Inside a set (SIMD_SET is its name) this declares a function whose symbol ends in that name, so that no set calls
 * another's and the linker refuses one that was forgotten. Everywhere else the same line declares a pointer to what
 * the set in use has (set.h), which is called alike. Functions in headers are static: sets compiled differently
 * share none. */
#ifndef CLEAVE_KERNELS_KERNEL
#define CLEAVE_KERNELS_KERNEL

#ifdef SIMD_SET
#define KERNEL(type, name, parameters) type name parameters __asm__(#name "_" SIMD_SET)
#define KERNEL_TABLE(type, name, further) extern type *const name[DIM_MAX + 1] further __asm__(#name "_" SIMD_SET)
#else
#define KERNEL(type, name, parameters) extern type(*name) parameters
#define KERNEL_TABLE(type, name, further) extern type *const(*name) further
#endif

#endif
