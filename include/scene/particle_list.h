/* Reads lists of particles from files. Only output*.c, checkpoint.c, particle_list*.c and exodus_hdf5.c use HDF5.
 *
 * CSV: a header line names the columns, in any order, with units in brackets (SI if there are none). Each further line
 * is one particle. Fields are separated by commas, semicolons, tabs or blanks. Empty lines and lines that begin with #
 * are skipped. Columns:
 *
 *     x, y, z               position, one column per dimension
 *     volume                default: volume of a lattice cell
 *     mass, or density      default: density of the material
 *     weight                mass or volume, depending on the unit of the column
 *     vx, vy, vz            default: velocity of the body
 *     material              index from 0 in the order of the scene, or name; default: material of the body
 *     block_id, block       material, counted from 1 as in Peridigm and PeriLab
 *     body                  index from 0
 *
 * Other columns are not read, and a note names them. Points:0 .. Points:2 of ParaView are x, y, z. Column names may be
 * quoted, preceded by `header:` (PeriLab), or written in a comment (Peridigm; its five columns need no names).
 *
 * Exodus II (particle_list_exodus.c): elements of one node, as Peridigm reads and writes them: the node is the
 * position, the attribute `volume` the volume, the block the material.
 *
 * HDF5: datasets positions (n x dim; in 1D also n), volumes, mass, density (n), velocities (n x dim), material, body
 * (n), each with an attribute `unit`. Only positions is required. */
#ifndef CLEAVE_PARTICLE_LIST
#define CLEAVE_PARTICLE_LIST

#include "base/base.h"

/* Properties of a particle list that follow from its columns. */
struct particle_list_head {
    bool material, mass, volumes; /* the list has a column of materials, of masses or densities, of volumes */
    bool lattice;                 /* positions and volumes form a lattice (list_lattice.h) */
    bool block;                   /* the material column is a block of Peridigm, counted from 1 */
    bool unnamed;                 /* the columns have no names: five columns of a Peridigm text mesh */
    char note[256];               /* columns that are not read, and defaults of missing ones; "": none */
};

/* Unit of length and column names of a particle list, given by the scene for a file that does not state them. */
struct particle_list_form {
    real scale; /* length that the number 1 is in coordinates without a unit of their own [m], in volumes its cube;
                 * 0: 1 m */
    const char *columns; /* names of the columns of a file without them, separated by commas; borrowed; NULL: the file
                          * names them */
};

/* Particles read from a file, in SI units. Arrays have one entry for each of the n particles; an array is NULL if the
 * file has no such column. */
struct particle_list {
    struct particle_list_head head; /* columns that were found in the file */
    struct particle_list_form form; /* unit and columns as the scene gives them */
    int64_t n;
    int dim;
    real *X[DIM_MAX];              /* [m] */
    real *v[DIM_MAX];              /* [m/s] */
    real *volume, *mass, *density; /* > 0 [m^3], [kg], [kg/m^3] */
    real *material, *body;         /* indices 0..255; a material given by name is -1 - (its index in `name`) */
    int names;
    char (*name)[NAME_MAX_LENGTH]; /* [names] material names in the file */
    int64_t *line;                 /* line number of each entry in a CSV file; NULL for HDF5 */
    int16_t *material_at;          /* column number of the material in this line; NULL for HDF5 */
};

/* Reads a particle list from the file `path`. The format follows from the file name extension: .csv, .tsv, .txt, .dat,
 * or .h5, .hdf5, .hdf, or that of an Exodus II file. form: unit and column names that the scene gives, or NULL; dim:
 * coordinates per position. Returns REFUSED for an invalid value, with file and line or file and entry in the message;
 * nothing has to be released then. An empty list is no error here. Release l with particle_list_free. */
status particle_list_read(struct particle_list *l, const char *path, const struct particle_list_form *form, int dim);

/* Reads only the names of the columns from the particle list file `path`, and stores in *head what the list contains.
 * form: unit and column names that the scene gives, or NULL; dim: coordinates per position. Returns REFUSED, with a
 * message, for a missing or invalid file. */
status particle_list_read_column_names(struct particle_list_head *head, const char *path,
                                       const struct particle_list_form *form, int dim);

/* Returns true if the extension of the file name `path` is one of particle lists: .csv, .tsv, .txt, .dat, .h5, .hdf5,
 * .hdf, or one of Exodus II. */
bool path_has_particle_list_extension(const char *path);

/* Releases the arrays of the particle list l, which particle_list_read has allocated. */
void particle_list_free(struct particle_list *l);

#endif
