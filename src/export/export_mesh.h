/* Sorts the particles of a scene or a run into the order in which meshes of other programs list them. */
#ifndef CLEAVE_EXPORT_MESH
#define CLEAVE_EXPORT_MESH

#include "engine/engine.h"
#include "export/export.h"

/* The n particles of a scene or run e, sorted by the number of their material in the scene file, then by id, for meshes
 * of other programs. In such a mesh they are nodes, and each load is a set of nodes. */
struct export_mesh {
    struct scene scene;
    struct run *e;
    int64_t n;
    int32_t *particle;  /* [n] index in e->part */
    int32_t *place;     /* [n] position of each particle of e->part in this list */
    int materials;      /* of the scene file, with those of which no body consists */
    int64_t first[258]; /* first position of material number m; [materials]: n */
};

/* Reads the input file of the request with its overrides, creates all particles of its bodies and sorts the particles
 * by material and id into *m. Returns REFUSED, with a message, if the input file is faulty. Release *m with
 * export_mesh_free, also after a failure. */
status export_mesh_create_from_input_file(struct export_mesh *m, const struct export_request *request);

/* Name of a set of nodes in the exported mesh; a structure, so that functions can return a name by value. */
struct set_name {
    char text[NAME_MAX_LENGTH];
};

/* Returns the name of the node set of load number `load_number` (from 0) in the mesh m: the name of its boundary
 * condition, or nodelist_N with N = load_number + 1 if the boundary condition has no name or an earlier load has the
 * same name. */
struct set_name export_node_set_name_of_load(const struct export_mesh *m, int load_number);

/* Returns a new array with the numbers of the particles on which load number load_number acts: positions in the list m,
 * counted from 1, in ascending order. The length of the array is the number of particles of the load. The caller
 * releases the array with memory_free. */
int32_t *export_node_set_particles_of_load(const struct export_mesh *m, int load_number);

/* Releases the arrays of the mesh *m, which export_mesh_create_from_input_file has allocated. */
void export_mesh_free(struct export_mesh *m);

/* Checks that the file `path` may be written: it must not exist or, if `overwrite` is true, be an export of Cleave.
 * format_signature: text in the first bytes of exports of this kind, by which they are recognised. Returns OK if the
 * file may be written, else REFUSED, with a message. */
status export_check_file_may_be_written(const char *path, const char *format_signature, bool overwrite);

/* Writes the file `path`: calls write_contents(to, context) with an open file `to` under a temporary name, synchronises
 * this file with the disk and renames it to `path`. Returns the status of write_contents if that is not OK; FAILED,
 * with a message, if the file cannot be written. No new file is left in both cases. */
status export_write_file_and_rename(const char *path, status (*write_contents)(FILE *to, void *context), void *context);

#endif
