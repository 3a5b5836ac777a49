/* Fields that follow from another field of the same particle: one table, for what a run writes and for what is drawn or
 * read later. A symmetric tensor has VTK's order xx yy zz xy yz xz. */
#ifndef CLEAVE_DERIVED_FIELDS
#define CLEAVE_DERIVED_FIELDS

#include "base/base.h"

enum derived_from { FROM_STRESS, FROM_VELOCITY, DERIVED_SOURCES }; /* symmetric tensor [6], vector [3] */
enum { DERIVED_MOST = 9 };                                         /* numbers of a field at a particle */

struct derived_field {
    const char *name, *unit, *meaning;
    enum derived_from from;
    int columns;
    void (*compute)(const real *from, real *to); /* to [columns] */
};
enum { DERIVED_FIELDS = 5 };
extern const struct derived_field derived_fields[DERIVED_FIELDS];

/* The field of this name; NULL: it does not follow from another. */
const struct derived_field *derived_field_find(const char *name);

/* Eigenvalues of a symmetric tensor, descending, and unit vectors along its axes in this order, row by row; the largest
 * component of the first two is positive, the third completes a right-handed system. direction NULL: only the
 * values. */
void tensor_principal(const real tensor[6], real value[3], real direction[9]);
/* sqrt(3/2 s : s) of the deviator s. */
real tensor_mises(const real tensor[6]);
real tensor_determinant(const real tensor[6]);

#endif
