/* Computes the crack energy per area: that of the bonds that cross a crack at their critical stretch, or the given
 * energy release rate G_c. */
#include <math.h>

#include "toughness.h"

real bond_normalised_work_to_elastic_stretch(real elastic_stretch, real yield_stretch, real hardening_ratio)
{
    const real beyond = real_max(0, elastic_stretch - yield_stretch), slope = hardening_ratio / (1 + hardening_ratio);
    return 0.5 * square(elastic_stretch - beyond) + (beyond > 0 ? beyond * (yield_stretch + 0.5 * slope * beyond) : 0);
}

real toughness_of_material(const struct family *family, enum model model, const struct material *m)
{
    const bool given = model != MODEL_BOND && !isnan(m->energy_release_rate);
    if (given) return m->energy_release_rate;
    const real elastic = family_energy_release_rate_at_critical_stretch(family, m), limit = m->critical_stretch;
    if (!material_yields(m) || !isfinite(limit)) return elastic;
    const real taken =
        bond_normalised_work_to_elastic_stretch(limit, m->yield_stress / m->young, m->yield_hardening / m->young);
    return elastic * taken / (0.5 * square(limit));
}

/* Returns the crack energy per area between materials number a and b of scene s [J/m^2]. For state-based models it is
 * that of their interface if the input file (scene) gives one, else the smaller of the values of both materials. For
 * two different elastic materials with bond-based models it is the energy of the bonds at the critical stretch of the
 * pair. source: bonds of the lattice and their critical stretches. */
static real toughness_of_pair(const struct scene *s, const struct bond_source *source, int a, int b)
{
    const struct family *family = &source->family;
    const struct material *one = &s->material[a], *other = &s->material[b];
    const real least =
        real_min(toughness_of_material(family, s->model, one), toughness_of_material(family, s->model, other));
    for (int k = 0; k < s->interfaces && s->model != MODEL_BOND; k++) {
        const struct scene_interface *face = &s->interface[k];
        const int m = s->body[face->body[0]].material, n = s->body[face->body[1]].material;
        if (face->energy_release_rate > 0 && ((m == a && n == b) || (m == b && n == a)))
            return face->energy_release_rate;
    }
    const real limit = source->limit.critical_stretch[a * s->materials + b];
    if (a == b || s->model != MODEL_BOND || material_yields(one) || material_yields(other) || !isfinite(limit))
        return least;
    if (!isfinite(one->critical_stretch))
        return isfinite(other->critical_stretch) ? toughness_of_pair(s, source, b, a) : least;
    const real c = family_micro_modulus(family, one), d = family_micro_modulus(family, other);
    return family_energy_release_rate_at_critical_stretch(family, one) * 2 * d / (c + d) *
           square(limit / one->critical_stretch);
}

real toughness_between_particles(const struct scene *s, const struct bond_source *bond_source,
                                 const struct particles *p, int64_t particle, int64_t other_particle)
{
    return toughness_of_pair(s, bond_source, p->material[particle], p->material[other_particle]) *
           square(bond_strength_factor(p, particle, other_particle));
}
