/* Declares the shapes of the element types of Abaqus, and the search for a type by its name. */
#ifndef CLEAVE_ABAQUS_TYPE
#define CLEAVE_ABAQUS_TYPE

#include "elements.h"

/* Shape of an element type of Abaqus. dim: 1 for bars, 2 for 2D and surface elements, else 3; nodes: number of nodes of
 * an element in the file; kind: shape without middle nodes. */
struct abaqus_shape {
    int dim;
    int nodes;
    enum element_kind kind;
};

/* Finds the shape of the element type `type`, such as C3D10M or CPS4R, in capitals; *shape receives a pointer to a
 * constant. Stores NULL in *shape for types that are left out: points, beams, and connectors between elements. Returns
 * REFUSED, with a message that gives file and line, for any other type. */
status abaqus_find_shape_of_element_type(const struct abaqus_shape **shape, const struct geometry_file *file,
                                         const char *type);

#endif
