/* Lists for which combinations of dimension and model, shape function or transfer scheme kernels are compiled: each
 * macro calls X for every combination. A line here adds a kernel, its table entry, its test and its benchmark. */
#ifndef CLEAVE_KERNELS_VARIANTS
#define CLEAVE_KERNELS_VARIANTS

/* clang-format off */
#define DIM_VARIANTS(X) X(1) X(2) X(3)

#define PD_VARIANTS(X)                                                          \
    X(1, BOND) X(2, BOND) X(3, BOND)                                            \
    X(1, BOND_PLASTIC) X(2, BOND_PLASTIC) X(3, BOND_PLASTIC)                    \
    X(1, BOND_SOFT) X(2, BOND_SOFT) X(3, BOND_SOFT)

#define STATE_VARIANTS(X) X(2, OSPD) X(3, OSPD) X(2, MOSPD) X(3, MOSPD)

/* Calls X for the combinations of dimension D, shape function S and the shape function that the kernel is compiled for.
 * They differ for quadratic B-splines alone: these are GIMP shape functions of particles as wide as a cell
 * (transfer_data.half_width; Bardenhagen & Kober 2004), and use their kernels. */
#define SHAPE_VARIANTS(X)                                                                                   \
    X(1, LINEAR, LINEAR) X(1, GIMP, GIMP) X(1, CPGIMP, CPGIMP) X(1, QUADRATIC, GIMP) X(1, CUBIC, CUBIC)     \
    X(2, LINEAR, LINEAR) X(2, GIMP, GIMP) X(2, CPGIMP, CPGIMP) X(2, QUADRATIC, GIMP) X(2, CUBIC, CUBIC)     \
    X(3, LINEAR, LINEAR) X(3, GIMP, GIMP) X(3, CPGIMP, CPGIMP) X(3, QUADRATIC, GIMP) X(3, CUBIC, CUBIC)

/* Calls X for the combinations of dimension and shape function whose points can rotate in groups (data/turning.h): 2D
 * and 3D. */
#define SHAPE_VARIANTS_TURNING(X)                                                                           \
    X(2, LINEAR, LINEAR) X(2, GIMP, GIMP) X(2, CPGIMP, CPGIMP) X(2, QUADRATIC, GIMP) X(2, CUBIC, CUBIC)     \
    X(3, LINEAR, LINEAR) X(3, GIMP, GIMP) X(3, CPGIMP, CPGIMP) X(3, QUADRATIC, GIMP) X(3, CUBIC, CUBIC)

#define TRANSFER_VARIANTS(X, D, S) X(D, S, FLIP) X(D, S, APIC)
/* clang-format on */

#endif
