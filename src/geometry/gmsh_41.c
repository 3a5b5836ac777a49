/* Reads nodes and elements of Gmsh .msh files of format 4.1, text or binary (Gmsh reference manual, "File formats"). */
#include "gmsh_parts.h"

/* Reads the first line of a section of the file g in format 4.1: the number of blocks into *blocks, the number of nodes
 * or elements in all blocks into *total, and the smallest and largest label, which are not stored. what: nodes or
 * elements, for messages. Returns REFUSED if the line is malformed. */
static status read_head_of_section(struct gmsh *g, const char *what, int64_t *blocks, int64_t *total)
{
    int64_t skipped;
    TRY(geometry_file_read_int64(g->s, "number of blocks", blocks));
    TRY(geometry_file_read_int64(g->s, what, total));
    for (int k = 0; k < 2; k++) TRY(geometry_file_read_int64(g->s, what, &skipped));
    g->announced = *blocks, g->items = "blocks";
    return geometry_file_check_count_fits_size(g->s, "blocks", *blocks, 8);
}

/* Checks a section of the file g in format 4.1: returns REFUSED, with a message, unless `found`, the number of rows in
 * all of its blocks, equals `announced`, the number in its first line. what: nodes or elements, for the message. */
static status check_total(const struct gmsh *g, const char *what, int64_t announced, int64_t found)
{
    if (found == announced) return OK;
    return geometry_file_report_fault(
        g->s, "the section gives %lld %s, but its blocks contain %lld, so the file is damaged; save it again",
        (long long)announced, what, (long long)found);
}

/* Reads a block of nodes of the file g in format 4.1: their labels, then their coordinates. Each node may have
 * parameters on its entity after its coordinates, which are ignored. Returns REFUSED if the block is malformed. */
static status read_node_block(struct gmsh *g)
{
    int64_t dim, tag, parametric, n, label;
    TRY(geometry_file_read_int32(g->s, "dimension", &dim));
    TRY(geometry_file_read_int32(g->s, "tag of an entity", &tag));
    TRY(geometry_file_read_int32(g->s, "parametric", &parametric));
    TRY(geometry_file_read_int64(g->s, "number of nodes", &n));
    TRY(geometry_file_check_count_fits_size(g->s, "nodes", n, 8));
    if (dim < 0 || dim > 3)
        return geometry_file_report_fault(g->s, "a block of $Nodes has the dimension %lld; give 0 to 3",
                                          (long long)dim);
    const int64_t first = g->m->nodes;
    for (int64_t k = 0; k < n; k++) {
        TRY(geometry_file_read_int64(g->s, "number of a node", &label));
        TRY(element_mesh_add_node(g->m, g->s, (const real[DIM_MAX]){0}, label));
    }
    for (int64_t k = first; k < first + n; k++) {
        real own;
        for (int d = 0; d < DIM_MAX; d++) TRY(geometry_file_read_real(g->s, "coordinate", &g->m->node[k][d]));
        for (int d = 0; d < dim && parametric != 0; d++) TRY(geometry_file_read_real(g->s, "coordinate", &own));
    }
    return OK;
}

status gmsh41_read_nodes(struct gmsh *g)
{
    const int64_t first = g->m->nodes;
    int64_t blocks, total;
    TRY(read_head_of_section(g, "number of nodes", &blocks, &total));
    for (int64_t k = 0; k < blocks; k++) TRY(read_node_block(g));
    TRY(check_total(g, "nodes", total, g->m->nodes - first));
    return gmsh_create_map_from_node_labels_to_indices(g);
}

/* Reads a block of elements of the file g in format 4.1, which have one type and belong to one entity, and adds them to
 * the physical groups of the entity. Returns REFUSED if it is malformed. */
static status read_element_block(struct gmsh *g)
{
    int64_t dim, tag, number, n, label;
    const struct gmsh_type *type = NULL;
    TRY(geometry_file_read_int32(g->s, "dimension", &dim));
    TRY(geometry_file_read_int32(g->s, "tag of an entity", &tag));
    TRY(geometry_file_read_int32(g->s, "type of an element", &number));
    TRY(geometry_file_read_int64(g->s, "number of elements", &n));
    TRY(gmsh_find_element_type(g->s, number, &type));
    TRY(geometry_file_check_count_fits_size(g->s, "elements", n, 4));
    const int64_t key = gmsh_entity_key_from_dimension_and_tag(dim, tag), link = label_map_find(&g->of_entity, key),
                  first = g->m->elements;
    for (int64_t k = 0; k < n; k++) {
        TRY(geometry_file_read_int64(g->s, "number of an element", &label));
        TRY(gmsh_read_element(g, type, label));
    }
    for (int64_t l = link; l >= 0 && l < g->links && l < link + GROUPS_MAX && g->entity[l] == key; l++)
        for (int64_t k = first; k < first + n; k++)
            TRY(gmsh_add_element_to_physical_group(g, element_dim[type->kind], g->group[l], k));
    return OK;
}

status gmsh41_read_elements(struct gmsh *g)
{
    const int64_t first = g->m->elements;
    int64_t blocks, total;
    TRY(read_head_of_section(g, "number of elements", &blocks, &total));
    for (int64_t k = 0; k < blocks; k++) TRY(read_element_block(g));
    return check_total(g, "elements", total, g->m->elements - first);
}
