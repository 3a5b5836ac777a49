/* Computes the factors by which the weights of bonds near faces are multiplied, and stores them for all particles
 * (surface.h). */
#include "bonds/surface.h"

#include <string.h>

#include "base/memory.h"
#include "surface_parts.h"

/* Computes two tables of `to` for particles near faces, by classes: the particles of a class have equal surroundings.
 * to->factor[classes, offsets]: surface correction of the bond to the neighbour at each lattice offset, a factor on its
 * weight. to->weighted[classes]: weighted volume sum w r^2 with these factors [m^2]. near_faces: particles near faces;
 * a: their classes; f: neighbourhood; factor[sets]: fitted factor of each set of bonds that share one; bonds in no set
 * have the factor 1. */
static void tables_make(struct surface_correction *to, const struct particles_near_faces *near_faces,
                        const struct bond_classes *a, const struct family *f, const real *factor)
{
    const int n = near_faces->offset.n;
    to->factor = NEW("surface.factor", (int64_t)a->classes * n, real);
    to->weighted = NEW("surface.weighted", a->classes, real);
    to->weighted[0] = f->weighted;
    for (int32_t class = 1; class < a->classes; class ++)
        for (int k = 0; k < n; k++) {
            const int64_t entry = (int64_t) class * n + k, group = a->group_of[entry];
            const real r = near_faces->offset.length[k] * f->spacing;
            to->factor[entry] = group >= 0 ? factor[group] : 1;
            if (bond_class_neighbour_of_first_particle_at_offset(a, near_faces, class, k) >= 0)
                to->weighted[class] += to->factor[entry] * near_faces->offset.share[k] * square(r);
        }
}

status surface_correction_fit_bond_weight_factors(struct surface_correction *weights, const struct particles *p,
                                                  const struct bond_source *s, bool with_rotations)
{
    struct particles_near_faces b;
    struct surface_fit_targets f;
    struct bond_classes a;
    TRY(particles_near_faces_list_with_neighbours(&b, p, s, weights->apart));
    surface_fit_targets_compute_areas_and_moments(&f, &b, with_rotations);
    bond_classes_group_bonds_near_faces(&a, &b);
    real *factor = NEW("surface.factors", a.groups, real);
    const real left = surface_fit_compute_bond_weight_factors(factor, &b, &f, &a, with_rotations, SURFACE_PRODUCTS);
    *weights = (struct surface_correction){.spacing = s->family.spacing,
                                           .residual = left,
                                           .reach = b.offset.reach,
                                           .dim = p->dim,
                                           .offsets = b.offset.n,
                                           .classes = a.classes};
    weights->offset_at = b.offset.number, b.offset.number = NULL;
    weights->class_of = NEW("surface.class_of", p->n, int32_t);
    weights->mirrors = NEW("surface.mirrors", p->n, uint8_t);
    for (int64_t t = 0; t < b.n; t++)
        weights->class_of[b.particle[t]] = a.class_of[t], weights->mirrors[b.particle[t]] = a.mirrors[t];
    tables_make(weights, &b, &a, &s->family, factor);
    memory_free(factor);
    bond_classes_free(&a);
    surface_fit_targets_free(&f);
    particles_near_faces_free(&b);
    return OK;
}

void surface_correction_free(struct surface_correction *correction)
{
    memory_free(correction->offset_at);
    memory_free(correction->class_of);
    memory_free(correction->mirrors);
    memory_free(correction->factor);
    memory_free(correction->weighted);
    *correction = (struct surface_correction){0};
}
