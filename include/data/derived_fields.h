/* Fields computed from another field of the same particle: one table for the frames of a run and for pictures and
 * exports made later. Symmetric tensors are in VTK's order xx yy zz xy yz xz. */
#ifndef CLEAVE_DERIVED_FIELDS
#define CLEAVE_DERIVED_FIELDS

#include "base/base.h"

enum derived_from { FROM_STRESS, FROM_VELOCITY, DERIVED_SOURCES }; /* symmetric tensor [6], vector [3] */
enum { DERIVED_MOST = 9 };                                         /* largest number of components of a field */

/* Description of a derived field. */
struct derived_field {
    const char *name, *unit, *meaning;
    enum derived_from from;
    int columns;
    void (*compute)(const real *from, real *to); /* from: the source field of a particle; to: [columns] */
};
enum { DERIVED_FIELDS = 5 };
extern const struct derived_field derived_fields[DERIVED_FIELDS];

/* Returns the entry of derived_fields with the given name, or NULL if there is none. */
const struct derived_field *derived_field_find(const char *name);

/* Computes the eigenvalues of a symmetric tensor, descending, and unit vectors along its axes in this order, row by
 * row; the largest component of the first two is positive, the third completes a right-handed system. direction NULL:
 * only the values. */
void tensor_principal_values(const real tensor[6], real value[3], real direction[9]);

/* Returns the equivalent stress of von Mises, sqrt(3/2 s : s) with the deviator s. */
real tensor_mises_stress(const real tensor[6]);

/* Returns the determinant of a symmetric tensor. */
real tensor_determinant(const real tensor[6]);

#endif
