/* Determines by its name whether an Abaqus element type is read, left out or refused. */
#include "abaqus_type.h"

#include <stdlib.h>
#include <string.h>

/* Beginnings of the names of element types, compared in this order. dim: 1 for bars, as which Gmsh writes the elements
 * of curves, 2 for 2D and surface elements, else 3. */
static const struct family {
    const char *name;
    int dim;
} families[] = {{"C3D", 3}, {"CPS", 2},   {"CPEG", 2}, {"CPE", 2}, {"CGAX", 2}, {"CAX", 2}, {"C2D", 2}, {"M3D", 2},
                {"R3D", 2}, {"SFM3D", 2}, {"STRI", 2}, {"SC", 3},  {"DS", 2},   {"S", 2},   {"T2D", 1}, {"T3D", 1}};

/* Beginnings of the names of types that have no shape of their own: points, bars, beams, springs, joints and the like.
 */
static const char *const left_out[] = {
    "MASS", "ROTARYI", "HEATCAP", "SPRING", "DASHPOT", "JOINT", "CONN",  "GAP",  "ITS",  "DCOUP", "DRAG",
    "PSI",  "ASI",     "B2",      "B3",     "PIPE",    "ELBOW", "FRAME", "SAX",  "MAX",  "RAX",   "R2D",
    "RB",   "SFMAX",   "COH",     "CIN",    "F2D",     "F3D",   "FAX",   "DC1D", "AC1D", "ACIN",  "LS"};

/* Element shapes that are read: dimension, number of nodes, kind of element. */
static const struct abaqus_shape shapes[] = {
    {1, 2, ELEMENT_LINE},         {1, 3, ELEMENT_LINE},       {2, 3, ELEMENT_TRIANGLE},    {2, 6, ELEMENT_TRIANGLE},
    {2, 4, ELEMENT_QUAD},         {2, 8, ELEMENT_QUAD},       {2, 9, ELEMENT_QUAD},        {3, 4, ELEMENT_TETRAHEDRON},
    {3, 10, ELEMENT_TETRAHEDRON}, {3, 5, ELEMENT_PYRAMID},    {3, 13, ELEMENT_PYRAMID},    {3, 6, ELEMENT_PRISM},
    {3, 15, ELEMENT_PRISM},       {3, 8, ELEMENT_HEXAHEDRON}, {3, 20, ELEMENT_HEXAHEDRON}, {3, 27, ELEMENT_HEXAHEDRON}};

/* Letters that may follow the number of nodes in the name of an element type without changing its shape: reduced
 * integration, hybrid, temperature and so on; 5: shells. */
#define VARIANTS "DEHIMPRSTVW5"

status abaqus_find_shape_of_element_type(const struct abaqus_shape **shape, const struct geometry_file *file,
                                         const char *type)
{
    *shape = NULL;
    for (size_t k = 0; k < COUNT_OF(left_out); k++)
        if (strncmp(type, left_out[k], strlen(left_out[k])) == 0) return OK;
    for (size_t f = 0; f < COUNT_OF(families); f++) {
        const size_t length = strlen(families[f].name);
        const char *number = type + ((type[0] == 'D' || type[0] == 'A') && type[1] == 'C');
        if (strncmp(number, families[f].name, length) != 0) continue;
        char *end;
        const long nodes = strtol(number + length, &end, 10);
        for (size_t k = 0; k < COUNT_OF(shapes) && end[strspn(end, VARIANTS)] == '\0'; k++)
            if (shapes[k].dim == families[f].dim && shapes[k].nodes == nodes) {
                *shape = &shapes[k];
                return OK;
            }
    }
    return geometry_file_report_fault(file, "element type %.40s is unknown; use one such as C3D8R, C3D10M, CPS4R or S4",
                                      *type ? type : "without a name");
}
