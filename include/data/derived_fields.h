/* Fields that are computed from another field of the same particle. One table describes them, both for the frames
 * (states at one time) that a run writes and for pictures and exports made later. Symmetric tensors are in VTK's order
 * xx yy zz xy yz xz. */
#ifndef CLEAVE_DERIVED_FIELDS
#define CLEAVE_DERIVED_FIELDS

#include "base/base.h"

enum derived_from { FROM_STRESS, FROM_VELOCITY, DERIVED_SOURCES }; /* source field: stress tensor [6] or velocity [3] */
enum { DERIVED_MOST = 9 };                                         /* largest number of components of a field */

/* Description of a field that is computed from one field of the same particle: name, unit, meaning in words, source
 * field `from`, number of components `columns`. */
struct derived_field {
    const char *name, *unit, *meaning;
    enum derived_from from;
    int columns;
    void (*compute)(const real *from, real *to); /* from: the source field of a particle; to: [columns] */
};
enum { DERIVED_FIELDS = 5 };
extern const struct derived_field derived_fields[DERIVED_FIELDS];

/* Returns the entry of the table derived_fields with the name `name`, or NULL if there is none. */
const struct derived_field *derived_field_find_by_name(const char *name);

/* Computes the eigenvalues value[3] of the symmetric tensor tensor[6] (xx, yy, zz, xy, yz, xz) in descending order, and
 * the unit eigenvectors: direction[3 k .. 3 k + 2] belongs to value[k]. The largest component of the first two vectors
 * is positive, the third completes a right-handed system. If `direction` is NULL, only eigenvalues are computed. */
void tensor_compute_principal_values(const real tensor[6], real value[3], real direction[9]);

/* Returns the equivalent stress of von Mises, sqrt(3/2 s : s) with the deviator s, of the stress tensor tensor[6] (xx,
 * yy, zz, xy, yz, xz), in the unit of `tensor`. */
real tensor_mises_stress(const real tensor[6]);

/* Returns the determinant of the symmetric tensor with the components tensor[6]: xx, yy, zz, xy, yz, xz. */
real tensor_determinant(const real tensor[6]);

#endif
