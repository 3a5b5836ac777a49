/* Lists of particles from files. Only output*.c, checkpoint.c and particle_list.c know HDF5.
 *
 * CSV: a header line that names the columns x, y, z (as many as the space has), volume and, if wanted, material
 * and body, in any order; then one line per particle. Empty lines and lines that begin with # are skipped.
 * HDF5: datasets positions (n x dim; in 1D also n), volumes (n) and, if wanted, material (n) and body (n).
 * Metres and cubic metres; materials and bodies are numbered from 0 in the order of the scene. */
#ifndef CLEAVE_PARTICLE_LIST
#define CLEAVE_PARTICLE_LIST

#include "base/base.h"

struct particle_list {
    int64_t n;
    int dim;
    real *X[DIM_MAX];                    /* [m] */
    real *volume;                        /* [m^3], > 0 */
    real *material, *body;               /* whole numbers 0..255; NULL where the file names none */
    int64_t *line;                       /* where an entry stands in a CSV; NULL for HDF5 */
};

/* Reads a file by its ending: .csv, or .h5, .hdf5, .hdf. REFUSED names file and line, or file and entry; nothing is
 * left to free then. An empty list is no error here. */
status particle_list_read(struct particle_list *l, const char *path, int dim);
void particle_list_free(struct particle_list *l);

#endif
