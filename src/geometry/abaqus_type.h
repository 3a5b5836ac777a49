/* Element types of Abaqus. */
#ifndef CLEAVE_ABAQUS_TYPE
#define CLEAVE_ABAQUS_TYPE

#include "elements.h"

/* Shape of an element type: plane (2D and surface elements) or solid, number of nodes in the file, kind. */
struct abaqus_shape {
    bool plane;
    int nodes;
    enum element_kind kind;
};

/* Finds the shape of an element type such as C3D10M or CPS4R, in capitals. Stores NULL in *shape for types that are
 * left out: points, lines, and connectors between elements. Returns REFUSED, with file and line, for any other type. */
status abaqus_shape_of_type(const struct abaqus_shape **shape, const struct source *file, const char *type);

#endif
