/* Reads STL files, text or binary, into an element mesh. STL has separate triangles without units, names or
 * connectivity; coincident corners are merged to nodes. */
#include <math.h>
#include <stdlib.h>
#include <strings.h>

#include "base/memory.h"
#include "elements.h"

enum { HEADER = 80, COUNT = 4, FACET = 50, NORMAL = 12 }; /* sizes in a binary file [byte] */

/* Appends a corner of a triangle at X as a new node of the mesh m. Every third corner completes a triangle, which is
 * appended too. file: the file, for messages. Returns REFUSED if the mesh has no space for more. */
static status corner_add(struct element_mesh *m, const struct geometry_file *file, const real *X)
{
    const int32_t node[] = {(int32_t)m->nodes - 2, (int32_t)m->nodes - 1, (int32_t)m->nodes};
    TRY(element_mesh_add_node(m, file, X, m->nodes));
    return m->nodes % 3 == 0 ? element_mesh_add_element(m, file, ELEMENT_TRIANGLE, node, m->elements) : OK;
}

/* ---- binary --------------------------------------------------------------------------------------------------- */

/* Returns the little-endian integer of four bytes at position `at` of the file s. */
static uint32_t word_at(const struct geometry_file *file, int64_t at)
{
    const unsigned char *c = (const unsigned char *)file->text + at;
    return (uint32_t)c[0] | (uint32_t)c[1] << 8 | (uint32_t)c[2] << 16 | (uint32_t)c[3] << 24;
}

/* Returns true if the file is binary: its length is that which its number of triangles implies. Binary files may also
 * begin with "solid", the first word of text files. */
static bool is_binary(const struct geometry_file *file)
{
    return file->length >= HEADER + COUNT && file->length == HEADER + COUNT + FACET * (int64_t)word_at(file, HEADER);
}

/* Returns true if the file can be text: it begins with "solid" and has no zero byte, which all binary files have. */
static bool may_be_text(const struct geometry_file *file)
{
    return file->length >= 5 && strncasecmp(file->text, "solid", 5) == 0 &&
           !memchr(file->text, '\0', (size_t)file->length);
}

/* Reads all triangles of the binary file into the mesh m. Returns REFUSED, with a message, if a coordinate is not
 * finite. */
static status binary_read(struct element_mesh *m, struct geometry_file *file)
{
    const int64_t n = word_at(file, HEADER);
    file->binary = true;
    for (int64_t k = 0; k < n; k++)
        for (int c = 0; c < 3; c++) {
            real X[DIM_MAX];
            for (int d = 0; d < 3; d++) {
                const uint32_t bits = word_at(file, HEADER + COUNT + k * FACET + NORMAL + 4 * (3 * c + d));
                float value;
                memcpy(&value, &bits, sizeof value);
                X[d] = value;
                /* infinite or NaN: all exponent bits are set */
                if ((bits & 0x7F800000u) == 0x7F800000u)
                    return geometry_file_report_fault(
                        file, "triangle %lld: a coordinate is infinite or not a number; correct it", (long long)k);
            }
            TRY(corner_add(m, file, X));
        }
    return OK;
}

/* ---- text ----------------------------------------------------------------------------------------------------- */

/* Reads all triangles of the text file into the mesh m. Returns REFUSED, with a message, if a facet does not have three
 * corners, or endsolid is missing. */
static status words_read(struct element_mesh *m, struct geometry_file *file)
{
    char word[32];
    bool ended = false;
    geometry_file_skip_to_next_line(file); /* solid NAME, possibly several words */
    while (geometry_file_skip_blanks(file)) {
        geometry_file_read_word(file, word, sizeof word);
        if (strcasecmp(word, "vertex") == 0) {
            real X[DIM_MAX];
            for (int d = 0; d < 3; d++) TRY(geometry_file_read_real(file, "coordinate", &X[d]));
            TRY(corner_add(m, file, X));
        } else if (strcasecmp(word, "endfacet") == 0 && m->nodes % 3 != 0) {
            return geometry_file_report_fault(file, "a facet has %d corners; give three", (int)(m->nodes % 3));
        } else if (strcasecmp(word, "endsolid") == 0 || strcasecmp(word, "solid") == 0) {
            ended = strcasecmp(word, "endsolid") == 0;
            geometry_file_skip_to_next_line(file);
        }
    }
    if (m->nodes % 3 != 0 || !ended)
        return geometry_file_report_fault(file, "the file ends within a solid, so it is cut off; write it again");
    return OK;
}

/* ---- merging of corners --------------------------------------------------------------------------------------- */

/* Sort key of node number `at` of the mesh, a corner of a triangle: its coordinates X, rounded to whole multiples of a
 * small length so that coincident corners have equal keys. */
struct corner_key {
    real X[DIM_MAX];
    int32_t at;
};

/* Compares two corners a and b (struct corner_key) for array_sort: by their rounded coordinates, then by node. */
static int corner_order(const void *a, const void *b)
{
    const struct corner_key *p = a, *q = b;
    for (int d = 0; d < DIM_MAX; d++)
        if (p->X[d] != q->X[d]) return p->X[d] < q->X[d] ? -1 : 1;
    return (p->at > q->at) - (p->at < q->at);
}

/* Distance below which corners of triangles are merged to one node, divided by the extent of the mesh [1]. It is not 0,
 * since programs that write STL round equal coordinates differently. */
#define SAME_PLACE 1e-6

/* Returns the largest extent of the nodes of the mesh m along x, y and z [unit of the file]. */
static real extent_of(const struct element_mesh *m)
{
    real extent = 0;
    for (int d = 0; d < DIM_MAX; d++) {
        real low = m->node[0][d], high = low;
        for (int64_t k = 1; k < m->nodes; k++) low = real_min(low, m->node[k][d]), high = real_max(high, m->node[k][d]);
        extent = real_max(extent, high - low);
    }
    return extent;
}

/* Replaces corners of the mesh m that coincide, to within SAME_PLACE times the extent of the mesh, by one node, so that
 * neighbouring triangles share nodes. */
static void corners_weld(struct element_mesh *m)
{
    struct corner_key *key = NEW("stl.corners", m->nodes, struct corner_key);
    const real step = real_max(SAME_PLACE * extent_of(m), 1e-300);
    int32_t first = 0;
    for (int64_t k = 0; k < m->nodes; k++) {
        for (int d = 0; d < DIM_MAX; d++) key[k].X[d] = nearbyint(m->node[k][d] / step);
        key[k].at = (int32_t)k;
    }
    array_sort(key, m->nodes, sizeof *key, corner_order);
    for (int64_t k = 0; k < m->nodes; k++) {
        const real *X = key[k].X, *before = key[k > 0 ? k - 1 : 0].X;
        if (k == 0 || X[0] != before[0] || X[1] != before[1] || X[2] != before[2]) first = key[k].at;
        m->element[key[k].at / 3].node[key[k].at % 3] = first;
    }
    memory_free(key);
}

status stl_read(struct element_mesh *m, struct geometry_file *file)
{
    if (is_binary(file))
        TRY(binary_read(m, file));
    else if (may_be_text(file))
        TRY(words_read(m, file));
    else if (file->length >= HEADER + COUNT) {
        const long long needed = HEADER + COUNT + FACET * (long long)word_at(file, HEADER);
        file->binary = true;
        return geometry_file_report_fault(
            file,
            "the STL file is incomplete: it has %lld bytes, but the %lld triangles that its "
            "header gives need %lld; %s or it is not in the STL format",
            (long long)file->length, (long long)word_at(file, HEADER), needed,
            file->length < needed ? "it is cut off" : "this number is wrong");
    } else {
        return geometry_file_report_fault(
            file,
            "this is not an STL file, because it neither begins with `solid` nor has a header "
            "of %d bytes; give a file in the STL format",
            HEADER + COUNT);
    }
    if (m->elements == 0) return geometry_file_report_fault(file, "contains no triangle");
    corners_weld(m);
    return OK;
}
