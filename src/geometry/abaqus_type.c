/* Which element types of Abaqus are read, left out or refused. */
#include "abaqus_type.h"

#include <stdlib.h>
#include <string.h>

/* Beginnings of the names of element types, compared in this order. plane: true for 2D and surface elements. */
static const struct family {
    const char *name;
    bool plane;
} families[] = {{"C3D", false}, {"CPS", true}, {"CPEG", true}, {"CPE", true}, {"CGAX", true},
                {"CAX", true},  {"C2D", true}, {"M3D", true},  {"R3D", true}, {"SFM3D", true},
                {"STRI", true}, {"SC", false}, {"DS", true},   {"S", true}};

/* Beginnings of the names of types that have no shape of their own: points, bars, beams, springs, joints and the like.
 */
static const char *const left_out[] = {
    "MASS", "ROTARYI", "HEATCAP", "SPRING", "DASHPOT", "JOINT", "CONN",  "GAP",   "ITS",  "DCOUP", "DRAG", "PSI",
    "ASI",  "T2D",     "T3D",     "B2",     "B3",      "PIPE",  "ELBOW", "FRAME", "SAX",  "MAX",   "RAX",  "R2D",
    "RB",   "SFMAX",   "COH",     "CIN",    "F2D",     "F3D",   "FAX",   "DC1D",  "AC1D", "ACIN",  "LS"};

/* Shapes with number of nodes that are read; plane or not, number of nodes, kind of element. */
static const struct abaqus_shape shapes[] = {
    {true, 3, ELEMENT_TRIANGLE},      {true, 6, ELEMENT_TRIANGLE},    {true, 4, ELEMENT_QUAD},
    {true, 8, ELEMENT_QUAD},          {true, 9, ELEMENT_QUAD},        {false, 4, ELEMENT_TETRAHEDRON},
    {false, 10, ELEMENT_TETRAHEDRON}, {false, 5, ELEMENT_PYRAMID},    {false, 13, ELEMENT_PYRAMID},
    {false, 6, ELEMENT_PRISM},        {false, 15, ELEMENT_PRISM},     {false, 8, ELEMENT_HEXAHEDRON},
    {false, 20, ELEMENT_HEXAHEDRON},  {false, 27, ELEMENT_HEXAHEDRON}};

/* Letters that may follow the number of nodes: reduced integration, hybrid, temperature and so on; 5: of shells. */
#define VARIANTS "DEHIMPRSTVW5"

status abaqus_shape_of_type(const struct abaqus_shape **shape, const struct source *file, const char *type)
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
            if (shapes[k].plane == families[f].plane && shapes[k].nodes == nodes) {
                *shape = &shapes[k];
                return OK;
            }
    }
    return source_report_fault(file, "element type %.40s is unknown; use one such as C3D8R, C3D10M, CPS4R or S4",
                               *type ? type : "without a name");
}
