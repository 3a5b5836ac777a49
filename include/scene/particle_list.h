/* Lists of particles from files. Only output*.c, checkpoint.c and particle_list*.c know HDF5.
 *
 * CSV: a header line that names the columns, in any order, with units in brackets or in SI; then one line per particle.
 * Commas, semicolons, tabs or blanks stand between them; empty lines and lines that begin with # are skipped.
 *
 *     x, y, z               as many as the space has
 *     volume                default: that of a particle of the lattice
 *     mass, or density      default: the density of the material
 *     weight                a mass or a volume, as its unit says
 *     vx, vy, vz            default: the velocity of the body
 *     material              number from 0 in the order of the scene, or name; default: that of the body
 *     block_id, block       the material, as Peridigm and PeriLab count it: from 1
 *     body                  number from 0
 *
 * What else there is is not read, and said. Points:0 .. Points:2 of ParaView are x, y, z. Names may stand in quotes,
 * behind `header:` (PeriLab), or in a comment (Peridigm, whose five columns need none).
 *
 * HDF5: datasets positions (n x dim; in 1D also n), volumes, mass, density (n), velocities (n x dim), material, body
 * (n), of which positions must be there, with attributes `unit`. */
#ifndef CLEAVE_PARTICLE_LIST
#define CLEAVE_PARTICLE_LIST

#include "base/base.h"

/* What is known of a list from its columns. */
struct particle_list_head {
    bool material, mass, volumes; /* it says the material, the mass or density, the volume of particles */
    bool lattice;                 /* its places and volumes are those of a lattice (list_lattice.h) */
    bool block;                   /* its material is the block of Peridigm, counted from 1 */
    bool unnamed;                 /* its columns have no names: they are those of Peridigm's text mesh */
    char note[256];               /* what is not read, or missing and has a default; "": nothing */
};

struct particle_list {
    struct particle_list_head head;
    int64_t n;
    int dim;
    real *X[DIM_MAX];              /* [m] */
    real *v[DIM_MAX];              /* [m/s]; NULL where the file has none, as what follows */
    real *volume, *mass, *density; /* > 0 [m^3], [kg], [kg/m^3] */
    real *material, *body;         /* whole numbers 0..255; of a material by name -1 - its number in `name` */
    int names;
    char (*name)[NAME_MAX_LENGTH];
    int64_t *line;        /* where an entry stands in a CSV; NULL for HDF5 */
    int16_t *material_at; /* where its material stands in the line; NULL as before */
};

/* Reads a file by its ending: .csv, .tsv, .txt, .dat, or .h5, .hdf5, .hdf. REFUSED names file and line, or file and
 * entry; nothing is left to free then. An empty list is no error here. */
status particle_list_read(struct particle_list *l, const char *path, int dim);
/* The same for the names of columns alone. */
status particle_list_look(struct particle_list_head *head, const char *path, int dim);
/* Is it the name of a list, by its ending? */
bool particle_list_named(const char *path);
void particle_list_free(struct particle_list *l);

#endif
