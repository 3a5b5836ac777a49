/* Reads particle lists from Exodus II files, as Peridigm reads and writes them: each element has one node, its
 * position; blocks are materials, counted from 1. */
#include <strings.h>

#include "base/memory.h"
#include "geometry/exodus_file.h"
#include "particle_list_parts.h"

/* An Exodus file while its particles are read into the list l. */
struct exodus_list {
    struct exodus_file file;
    struct particle_list *l;
    real *axis[DIM_MAX]; /* [nodes] coordinates */
    bool volumes;        /* all blocks have volumes */
};

/* Returns the index of the attribute `volume` among the n attributes of block `number` (counted from 1) of the file f;
 * -1 if there is none. Of two attributes without names, the first is the radius and the second the volume. */
static int64_t volume_column(const struct exodus_file *f, int64_t number, int64_t n)
{
    char name[LONG_NAME_LENGTH];
    bool named = false;
    for (int64_t k = 0; k < n; k++) {
        exodus_read_text_row(f, "attrib_name", number, k, n, name);
        if (strcasecmp(name, "volume") == 0) return k;
        named = named || name[0];
    }
    return !named && n == 2 ? 1 : -1;
}

/* Stores `value` as entry number `entry` of column `column` (COLUMN_*) of the list x->l. Returns REFUSED, with a
 * message, for a value that is invalid in this column. */
static status value_take(struct exodus_list *x, int column, int64_t entry, real value)
{
    const char *fault = particle_list_reason_value_is_invalid(column, value);
    if (fault)
        return exodus_set_message_and_return_refused(&x->file, "element %lld: %s: %g %s", (long long)entry + 1,
                                                     list_quantity[column].name, value, fault);
    (*particle_list_address_of_column_array(x->l, column))[entry] = value;
    return OK;
}

/* Appends the elements of block `number` (counted from 1) to the list x->l, one particle at the node of each. Returns
 * REFUSED, with a message, for elements with several nodes, invalid node numbers or values, and if only some blocks
 * have volumes. */
static status block_read(struct exodus_list *x, int64_t number)
{
    char type[NAME_MAX_LENGTH];
    struct particle_list *l = x->l;
    int64_t elements, nodes, *node = NULL;
    real *attribute = NULL;
    TRY(exodus_read_block_header(&x->file, number, type, &elements, &nodes));
    if (nodes != 1)
        return exodus_set_message_and_return_refused(
            &x->file,
            "block %lld has elements of type %s with %lld nodes; a list of particles has the "
            "type SPHERE with one node. For a mesh use shape: {mesh: {file: ..}}",
            (long long)number, type, (long long)nodes);
    const int64_t attributes = exodus_read_dimension_length(&x->file, "num_att_in_blk", number);
    const int64_t volume = volume_column(&x->file, number, attributes), first = l->n;
    if (first > 0 && (volume >= 0) != x->volumes)
        return exodus_set_message_and_return_refused(
            &x->file, "block %lld has %svolumes, unlike the blocks before it; give volumes to all blocks or to none",
            (long long)number, volume >= 0 ? "" : "no ");
    x->volumes = volume >= 0;
    TRY(exodus_read_integers(&x->file, "connect", number, elements, &node));
    status s = volume >= 0 ? exodus_read_reals(&x->file, "attrib", number, elements * attributes, &attribute) : OK;
    for (int d = 0; d < l->dim; d++) GROW("list.column", l->X[d], first + elements);
    GROW("list.column", l->material, first + elements);
    if (volume >= 0) GROW("list.column", l->volume, first + elements);
    for (int64_t k = 0; k < elements && s == OK; k++, l->n++) {
        if (node[k] < 1 || node[k] > x->file.nodes)
            s = exodus_set_message_and_return_refused(
                &x->file, "element %lld has node %lld; give its nodes numbers from 1 to %lld", (long long)l->n + 1,
                (long long)node[k], (long long)x->file.nodes);
        for (int d = 0; d < l->dim && s == OK; d++)
            s = value_take(x, COLUMN_X + d, l->n,
                           x->axis[d][node[k] - 1] * particle_list_default_factor_to_si(l, COLUMN_X));
        if (s == OK) s = value_take(x, COLUMN_MATERIAL, l->n, (real)(number - 1));
        if (s == OK && volume >= 0)
            s = value_take(x, COLUMN_VOLUME, l->n,
                           attribute[k * attributes + volume] * particle_list_default_factor_to_si(l, COLUMN_VOLUME));
    }
    memory_free(node);
    memory_free(attribute);
    return s;
}

/* Reads the nodes and all blocks of the file into the list x->l. Returns REFUSED, with a message, if the file has fewer
 * coordinates than the space, or for an invalid block. */
static status blocks_read(struct exodus_list *x)
{
    bool has[COLUMNS] = {false};
    if (x->file.dim < x->l->dim)
        return exodus_set_message_and_return_refused(
            &x->file, "has %d coordinates, but the space of the scene has %d; change the key space, or the file",
            x->file.dim, x->l->dim);
    TRY(exodus_read_coordinates(&x->file, x->axis));
    for (int64_t k = 1; k <= x->file.blocks; k++)
        if (exodus_has_array(&x->file, "connect", k)) TRY(block_read(x, k));
    has[COLUMN_VOLUME] = x->volumes, has[COLUMN_MATERIAL] = true;
    x->l->head.block = true;
    particle_list_head_store_missing_columns(&x->l->head, has);
    return OK;
}

status particle_list_read_exodus(struct particle_list *l, const char *path)
{
    struct exodus_list x = {.l = l};
    TRY(exodus_open_from_path(&x.file, path));
    const status s = blocks_read(&x);
    for (int d = 0; d < DIM_MAX; d++) memory_free(x.axis[d]);
    exodus_close(&x.file);
    return s;
}
