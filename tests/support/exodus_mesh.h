/* Writes small Exodus II files by the names of arrays in its manual, for tests of their readers. */
#ifndef CLEAVE_TESTS_EXODUS_MESH
#define CLEAVE_TESTS_EXODUS_MESH

#include <netcdf.h>
#include <stdio.h>
#include <string.h>

#include "tests/support/near.h"

/* Evaluates `call`, a call of a function of netCDF; the test fails unless it returns NC_NOERR. */
#define NC(call) assert_int_equal(call, NC_NOERR)

/* Defines a dimension of the open netCDF file `file` with the name `name` followed by `number` (0: `name` alone) and
 * the length `length`. Returns its id. */
static inline int exodus_dim(int file, const char *name, int number, size_t length)
{
    char called[64];
    int id;
    snprintf(called, sizeof called, number ? "%s%d" : "%s", name, number);
    nc_redef(file); /* a new file is in this mode, which is no fault */
    NC(nc_def_dim(file, called, length, &id));
    return id;
}

/* Writes an array of whole numbers to the netCDF file `file`, with the name `name` followed by `number` (0: `name`
 * alone). ranks: number of its dimensions, 1 or 2; dim: their ids; value: its elements, NULL: the array is defined but
 * not filled. Returns its id. */
static inline int exodus_put_integers(int file, const char *name, int number, int ranks, const int *dim,
                                      const int *value)
{
    char called[64];
    int id;
    snprintf(called, sizeof called, number ? "%s%d" : "%s", name, number);
    nc_redef(file);
    NC(nc_def_var(file, called, NC_INT, ranks, dim, &id));
    nc_enddef(file);
    if (value) NC(nc_put_var_int(file, id, value));
    return id;
}

/* Writes an array of real numbers to the netCDF file `file`, with the name `name` followed by `number` (0: `name`
 * alone). ranks: number of its dimensions; dim: their ids; value: its elements, not NULL. */
static inline void exodus_put_reals(int file, const char *name, int number, int ranks, const int *dim,
                                    const real *value)
{
    char called[64];
    int id;
    snprintf(called, sizeof called, number ? "%s%d" : "%s", name, number);
    nc_redef(file);
    NC(nc_def_var(file, called, NC_DOUBLE, ranks, dim, &id));
    nc_enddef(file);
    NC(nc_put_var_double(file, id, value));
}

/* Creates the Exodus II file `path`, replacing an existing one, with n <= 64 nodes at the positions X[n][dim]. mode:
 * format of the file, flags of nc_create; blocks, side_sets, node_sets: numbers of element blocks, side sets and node
 * sets, which are written later by exodus_put_block, exodus_put_sides and exodus_put_nodes. Returns the id of the file,
 * to be closed with nc_close. */
static inline int exodus_begin(const char *path, int mode, int dim, int n, const real *X, int blocks, int side_sets,
                               int node_sets)
{
    static const char *const names[] = {"coordx", "coordy", "coordz"};
    int file;
    real one[64];
    NC(nc_create(path, mode | NC_CLOBBER, &file));
    exodus_dim(file, "num_dim", 0, (size_t)dim);
    const int nodes = exodus_dim(file, "num_nodes", 0, (size_t)n);
    exodus_dim(file, "num_el_blk", 0, (size_t)blocks);
    if (side_sets > 0) exodus_dim(file, "num_side_sets", 0, (size_t)side_sets);
    if (node_sets > 0) exodus_dim(file, "num_node_sets", 0, (size_t)node_sets);
    exodus_dim(file, "len_name", 0, 33);
    for (int d = 0; d < dim; d++) {
        for (int k = 0; k < n; k++) one[k] = X[k * dim + d];
        exodus_put_reals(file, names[d], 0, 1, &nodes, one);
    }
    return file;
}

/* Writes a block of elements to the Exodus II file `file`. number: number of the block, from 1; type: element type,
 * such as HEX8; elements: number of elements; nodes: number of nodes of an element; connect[elements][nodes]: numbers
 * of the nodes of each element, from 1. */
static inline void exodus_put_block(int file, int number, const char *type, int elements, int nodes, const int *connect)
{
    const int dim[2] = {exodus_dim(file, "num_el_in_blk", number, (size_t)elements),
                        exodus_dim(file, "num_nod_per_el", number, (size_t)nodes)};
    const int id = exodus_put_integers(file, "connect", number, 2, dim, connect);
    nc_redef(file);
    NC(nc_put_att_text(file, id, "elem_type", strlen(type), type));
    nc_enddef(file);
}

/* Writes the names of all n blocks or sets of one kind to the Exodus II file `file`. name: name of the array of names,
 * such as eb_names; over: dimension that counts the blocks or sets, such as num_el_blk; names[n]: the names, "" for
 * none, at most 32 characters each. */
static inline void exodus_put_names(int file, const char *name, const char *over, int n, const char *const *names)
{
    int dim[2], id;
    NC(nc_inq_dimid(file, over, &dim[0]));
    NC(nc_inq_dimid(file, "len_name", &dim[1]));
    nc_redef(file);
    NC(nc_def_var(file, name, NC_CHAR, 2, dim, &id));
    nc_enddef(file);
    for (int k = 0; k < n; k++)
        NC(nc_put_vara_text(file, id, (size_t[]){(size_t)k, 0}, (size_t[]){1, strlen(names[k]) + 1}, names[k]));
}

/* Writes a side set of n element sides to the Exodus II file `file`: side number side[k] of element number element[k].
 * number: number of the set, from 1. Elements, and the sides of an element, are numbered from 1. */
static inline void exodus_put_sides(int file, int number, int n, const int *element, const int *side)
{
    const int dim = exodus_dim(file, "num_side_ss", number, (size_t)n);
    exodus_put_integers(file, "elem_ss", number, 1, &dim, element);
    exodus_put_integers(file, "side_ss", number, 1, &dim, side);
}

/* Writes a node set to the Exodus II file `file`. number: number of the set, from 1; node[n]: numbers of its nodes,
 * from 1. */
static inline void exodus_put_nodes(int file, int number, int n, const int *node)
{
    const int dim = exodus_dim(file, "num_nod_ns", number, (size_t)n);
    exodus_put_integers(file, "node_ns", number, 1, &dim, node);
}

#endif
