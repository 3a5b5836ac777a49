/* Computes the critical stretch of the bonds of an input file (scene) from the energy per area of a crack. */
#include <math.h>

#include "bonds/softening_work.h"
#include "scene/scene_softening.h"
#include "scene_parts.h"

struct family scene_make_complete_lattice_family(const struct scene *s)
{
    struct family f = {.volume = s->volume,
                       .calibration = s->calibration,
                       .surface = s->surface,
                       .shells = s->shells,
                       .influence = s->influence,
                       .energy = s->model == MODEL_BOND   ? ENERGY_OF_STRETCH
                                 : s->model == MODEL_OSPD ? ENERGY_OF_ELONGATION
                                                          : ENERGY_OF_DISPLACEMENT};
    family_make_on_lattice(&f, s->space, s->spacing, s->horizon, scene_cross_section_or_thickness(s));
    return f;
}

/* Returns the critical stretch [1] of bonds that follows from the energy release rate of material m: in closed form for
 * the influence function for which there is one (bonds in 2D and 3D: 1, ospd: horizon/r), else from the energy of the
 * bonds of a lattice across a plane or, with state-based models, from the energy that separates its two halves. s:
 * scene, with model and horizon. */
real scene_critical_stretch(const struct scene *s, const struct material *m)
{
    const bool bond = s->model == MODEL_BOND;
    const bool closed = bond ? s->influence == INFLUENCE_ONE && s->dim > 1
                             : s->influence == INFLUENCE_INVERSE && s->model == MODEL_OSPD;
    if (closed)
        return material_critical_stretch(m, s->space, s->horizon * s->spacing, bond ? STRETCH_BOND : STRETCH_OSPD);
    const struct family f = scene_make_complete_lattice_family(s);
    struct material unit = *m;
    unit.critical_stretch = 1;
    if (bond) return sqrt(m->energy_release_rate / family_energy_release_rate_at_critical_stretch(&f, &unit));
    const bool rotates = s->model == MODEL_MOSPD;
    const struct state_modulus modulus = state_based_moduli_of_material(m, s->space, rotates);
    const real unit_energy = family_fracture_energy_over_stretch_squared(&f, &modulus, rotates, !s->bulk);
    return sqrt(m->energy_release_rate / unit_energy);
}

/* Returns the elastic energy of the bonds of material m that cross a plane of the lattice, per area of the plane and
 * divided by the square of the stretch of the bonds [J/m^2]. s: scene, with model and horizon. */
static real energy_over_stretch_squared(const struct scene *s, const struct material *m)
{
    struct material unit = *m;
    if (!isnan(m->energy_release_rate)) return m->energy_release_rate / square(m->critical_stretch);
    unit.energy_release_rate = 1;
    return 1 / square(scene_critical_stretch(s, &unit));
}

real scene_critical_stretch_between_materials(const struct scene *s, const struct material *a, const struct material *b)
{
    const real least = real_min(a->critical_stretch, b->critical_stretch);
    if (materials_have_equal_stiffness(a, b) || !isfinite(least)) return least;
    if (material_yields(a) || material_yields(b)) return least;
    const real k = energy_over_stretch_squared(s, a), l = energy_over_stretch_squared(s, b);
    const real energy = real_min(k * square(a->critical_stretch), l * square(b->critical_stretch));
    return sqrt(energy / (s->model == MODEL_BOND ? 2 * k * l / (k + l) : 0.5 * (k + l)));
}
