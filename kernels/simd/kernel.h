/* Declares kernels, the functions of the hot loops. The files of kernels/ are compiled once for each set of vector
 * instructions (Makefile), all into one program; src/simd/simd.c selects a set at start-up.
 *
 * Where SIMD_SET is defined (the name of the set being compiled), KERNEL declares a function whose symbol ends in that
 * name, so no set calls a function of another, and a missing function fails at link time. Everywhere else KERNEL
 * declares a pointer to the function of the selected set (set.h), with the call syntax of a function. Functions in
 * headers are static, so that sets compiled differently share none. */
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
