/* Implements operations on finite-element meshes that the readers of all file formats share. */
#include "elements.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <strings.h>

#include "base/memory.h"

const int element_corners[ELEMENT_KINDS] = {1, 2, 3, 4, 4, 5, 6, 8};
const int element_dim[ELEMENT_KINDS] = {0, 1, 2, 2, 3, 3, 3, 3};
const int element_middles[ELEMENT_KINDS] = {0, 1, 4, 5, 10, 13, 14, 18};

const struct element_sides element_sides[ELEMENT_KINDS] = {
    [ELEMENT_TRIANGLE] = {3, {{0, 1}, {1, 2}, {2, 0}}},
    [ELEMENT_QUAD] = {4, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}},
    [ELEMENT_TETRAHEDRON] = {4, {{0, 2, 1, -1}, {0, 1, 3, -1}, {1, 2, 3, -1}, {0, 3, 2, -1}}},
    [ELEMENT_PYRAMID] = {5, {{0, 3, 2, 1}, {0, 1, 4, -1}, {1, 2, 4, -1}, {2, 3, 4, -1}, {3, 0, 4, -1}}},
    [ELEMENT_PRISM] = {5, {{0, 2, 1, -1}, {3, 4, 5, -1}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}},
    [ELEMENT_HEXAHEDRON] = {6, {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}},
};
const struct element_edges element_edges[ELEMENT_KINDS] = {
    [ELEMENT_LINE] = {1, {{0, 1}}},
    [ELEMENT_TRIANGLE] = {3, {{0, 1}, {1, 2}, {2, 0}}},
    [ELEMENT_QUAD] = {4, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}},
    [ELEMENT_TETRAHEDRON] = {6, {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}},
    [ELEMENT_PYRAMID] = {8, {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}}},
    [ELEMENT_PRISM] = {9, {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}}},
    [ELEMENT_HEXAHEDRON] =
        {12, {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}},
};

int element_edge_index_between_corners(enum element_kind kind, int corner, int other_corner)
{
    const struct element_edges *edges = &element_edges[kind];
    for (int k = 0; k < edges->n; k++)
        if ((edges->corner[k][0] == corner && edges->corner[k][1] == other_corner) ||
            (edges->corner[k][0] == other_corner && edges->corner[k][1] == corner))
            return k;
    return -1;
}

int32_t element_mesh_add_node_unchecked(struct element_mesh *m, const real *coordinates, int64_t label)
{
    GROW("mesh.node", m->node, m->nodes + 1);
    GROW("mesh.label", m->node_label, m->nodes + 1);
    memcpy(m->node[m->nodes], coordinates, sizeof *m->node);
    m->node_label[m->nodes] = label;
    return (int32_t)m->nodes++;
}

status element_mesh_add_node(struct element_mesh *m, const struct geometry_file *file, const real *coordinates,
                             int64_t label)
{
    if (m->nodes >= HULL_CORNERS_MAX)
        return geometry_file_report_fault(file, "the mesh has more than %d nodes; use a coarser one", HULL_CORNERS_MAX);
    element_mesh_add_node_unchecked(m, coordinates, label);
    return OK;
}

status element_mesh_add_element(struct element_mesh *m, const struct geometry_file *file, enum element_kind kind,
                                const int32_t *corner_node, int64_t label)
{
    if (m->elements >= HULL_CORNERS_MAX)
        return geometry_file_report_fault(file, "the mesh has more than %d elements; use a coarser one",
                                          HULL_CORNERS_MAX);
    GROW("mesh.element", m->element, m->elements + 1);
    GROW("mesh.label", m->element_label, m->elements + 1);
    struct element *e = &m->element[m->elements];
    e->kind = kind, e->middle = -1;
    for (int k = 0; k < element_corners[kind]; k++) e->node[k] = corner_node[k];
    m->element_label[m->elements++] = label;
    return OK;
}

void element_mesh_set_middle_nodes_of_last_element(struct element_mesh *m, const int32_t *middle_node)
{
    struct element *e = &m->element[m->elements - 1];
    const int n = element_middles[e->kind];
    GROW("mesh.middle", m->middle, m->middles + n);
    e->middle = m->middles;
    for (int k = 0; k < n; k++) m->middle[m->middles++] = middle_node[k];
}

int element_mesh_find_or_create_set(struct element_mesh *m, const char *name, bool of_nodes)
{
    for (int k = 0; k < m->sets; k++)
        if (strcasecmp(m->set[k].name, name) == 0 && m->set[k].of_nodes == of_nodes) return k;
    if (m->sets >= ELEMENT_SETS_MAX) return -1;
    GROW("mesh.set", m->set, m->sets + 1);
    struct element_set *set = &m->set[m->sets];
    snprintf(set->name, sizeof set->name, "%s", name);
    text_replace_control_characters(set->name);
    set->of_nodes = of_nodes;
    return m->sets++;
}

void element_mesh_add_to_set(struct element_mesh *m, int number, int64_t member)
{
    struct element_set *set = &m->set[number];
    GROW("mesh.set", set->member, set->n + 1);
    set->member[set->n++] = (int32_t)member;
}

void element_mesh_rotate_node(struct element_mesh *m, int64_t node, const real *axis_start, const real *axis_end,
                              real angle)
{
    real *X = m->node[node];
    real axis[DIM_MAX], arm[DIM_MAX], length = 0;
    for (int d = 0; d < DIM_MAX; d++)
        axis[d] = axis_end[d] - axis_start[d], arm[d] = X[d] - axis_start[d], length += square(axis[d]);
    length = sqrt(length);
    for (int d = 0; d < DIM_MAX; d++) axis[d] /= length;
    const real along = dot(axis, arm, DIM_MAX), c = cos(angle), s = sin(angle);
    for (int d = 0; d < DIM_MAX; d++) {
        const int e = (d + 1) % 3, f = (d + 2) % 3;
        X[d] = axis_start[d] + c * arm[d] + s * (axis[e] * arm[f] - axis[f] * arm[e]) + (1 - c) * along * axis[d];
    }
}

void element_mesh_free(struct element_mesh *m)
{
    for (int k = 0; k < m->sets; k++) memory_free(m->set[k].member);
    memory_free(m->set);
    memory_free(m->node);
    memory_free(m->node_label);
    memory_free(m->element);
    memory_free(m->middle);
    memory_free(m->element_label);
    *m = (struct element_mesh){0};
}

/* ---- labels --------------------------------------------------------------------------------------------------- */

/* Compares two entries a and b of a label map for array_sort: by label, then by index. */
static int label_entry_order(const void *a, const void *b)
{
    const struct label_entry *p = a, *q = b;
    return p->label != q->label ? (p->label > q->label) - (p->label < q->label)
                                : (p->index > q->index) - (p->index < q->index);
}

void label_map_make(struct label_map *map, const int64_t *label, int64_t first_index, int64_t label_count)
{
    map->n = label_count;
    map->entry = NEW("mesh.labels", label_count, struct label_entry);
    for (int64_t k = 0; k < label_count; k++) map->entry[k] = (struct label_entry){label[k], first_index + k};
    array_sort(map->entry, label_count, sizeof *map->entry, label_entry_order);
}

int64_t label_map_find(const struct label_map *map, int64_t label)
{
    int64_t low = 0, high = map->n;
    while (low < high) {
        const int64_t middle = low + (high - low) / 2;
        if (map->entry[middle].label < label)
            low = middle + 1;
        else
            high = middle;
    }
    return low < map->n && map->entry[low].label == label ? map->entry[low].index : -1;
}

bool label_map_find_duplicate(const struct label_map *map, int64_t *label)
{
    for (int64_t k = 1; k < map->n; k++)
        if (map->entry[k].label == map->entry[k - 1].label) {
            *label = map->entry[k].label;
            return true;
        }
    return false;
}

void label_map_free(struct label_map *map)
{
    memory_free(map->entry);
    *map = (struct label_map){0};
}
