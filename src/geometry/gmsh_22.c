/* Reads nodes and elements of Gmsh .msh files of format 2.2, text or binary (Gmsh reference manual, "File formats"). */
#include "gmsh_parts.h"

/* Reads a count from the file g into *n and advances to the next line. In format 2.2 counts are text even in binary
 * files. what: what is counted, for messages; bytes: least size of one counted item. Returns REFUSED if the file is too
 * short for so many items. */
static status read_count(struct gmsh *g, const char *what, int64_t bytes, int64_t *n)
{
    g->s->binary = false;
    TRY(geometry_file_read_integer(g->s, what, n));
    geometry_file_skip_to_next_line(g->s);
    g->s->binary = g->bytes;
    g->announced = *n, g->items = what;
    return geometry_file_check_count_fits_size(g->s, what, *n, bytes);
}

status gmsh22_read_nodes(struct gmsh *g)
{
    int64_t n, label;
    TRY(read_count(g, "nodes", 8, &n));
    for (int64_t k = 0; k < n; k++) {
        real X[DIM_MAX];
        TRY(geometry_file_read_int32(g->s, "number of a node", &label));
        for (int d = 0; d < DIM_MAX; d++) TRY(geometry_file_read_real(g->s, "coordinate", &X[d]));
        TRY(element_mesh_add_node(g->m, g->s, X, label));
    }
    return gmsh_create_map_from_node_labels_to_indices(g);
}

/* Removes the last element of the mesh of g if its kind and corners equal those of the element before it, which has
 * another group: format 2.2 lists an element of several physical groups once for each of them. group: physical group of
 * the last element; the caller then adds the remaining element to it. */
static void merge_repeated_element(struct gmsh *g, int64_t group)
{
    const struct element *last = &g->m->element[g->m->elements - 1];
    if (g->m->elements < 2 || group == g->last_tag || last->kind != last[-1].kind ||
        !arrays_equal(last->node, last[-1].node, element_corners[last->kind], sizeof *last->node))
        return;
    if (last->middle >= 0) g->m->middles = last->middle;
    g->m->elements--;
}

/* Reads an element of the file g in format 2.2: its tags, of which the first is its physical group (0 for none), and
 * then its nodes. type: type of the element; label: its number in the file; tags: number of tags. Returns REFUSED if it
 * is malformed. */
static status read_element(struct gmsh *g, const struct gmsh_type *type, int64_t label, int64_t tags)
{
    int64_t tag, group = 0;
    TRY(geometry_file_check_count_fits_size(g->s, "tags", tags, 2));
    for (int64_t k = 0; k < tags; k++) TRY(geometry_file_read_int32(g->s, "tag", k == 0 ? &group : &tag));
    TRY(gmsh_read_element(g, type, label));
    merge_repeated_element(g, group);
    return group == 0 ? OK : gmsh_add_element_to_physical_group(g, element_dim[type->kind], group, g->m->elements - 1);
}

status gmsh22_read_elements(struct gmsh *g)
{
    int64_t n, label = 0, number, tags, block = 1;
    const struct gmsh_type *type = NULL;
    TRY(read_count(g, "elements", 8, &n));
    for (int64_t k = 0; k < n; k += block) {
        if (!g->bytes) TRY(geometry_file_read_int32(g->s, "number of an element", &label));
        TRY(geometry_file_read_int32(g->s, "type of an element", &number));
        if (g->bytes) TRY(geometry_file_read_int32(g->s, "number of elements", &block));
        TRY(geometry_file_read_int32(g->s, "number of tags", &tags));
        TRY(gmsh_find_element_type(g->s, number, &type));
        if (block < 1) return geometry_file_report_fault(g->s, "a block of %lld elements", (long long)block);
        TRY(geometry_file_check_count_fits_size(g->s, "elements", block, g->bytes ? 8 : 2));
        for (int64_t e = 0; e < block; e++) {
            if (g->bytes) TRY(geometry_file_read_int32(g->s, "number of an element", &label));
            TRY(read_element(g, type, label, tags));
        }
    }
    return OK;
}
