/* Reads the strength surface of a material, on which the mean strain of a particle makes its bonds begin to soften. */
#include <math.h>

#include "data/softening.h"
#include "scene/scene_softening.h"
#include "scene_parts.h"
#include "scene_remedies.h"

/* Ratio kappa = (critical stretch/onset stretch)^2 [1] of bonds that begin to soften alone, although the strength
 * surface of the material is not yet reached. With a smaller ratio, lattices stop cracks. */
#define OWN_RATIO 2
/* Default radius within which strains are averaged for the strength surface, divided by E G_c/sigma_t^2 [1] (Young's
 * modulus, energy release rate, tensile strength). With this radius, the stress at a crack tip loaded to the toughness
 * K_c is 0.8 of the strength; measured. */
#define RADIUS_PLANE_STRESS 0.65
#define RADIUS_ELSE 0.9

/* Squared averaging radius of the strain of a single particle, itself a mean over its neighbourhood, divided by the
 * squared horizon [1]. Each further averaging over neighbourhoods adds 1. */
#define MEANS_OF_FAMILY 0.3
/* Largest radius within which strains are averaged [horizons]. It requires 10^4 successive averagings over
 * neighbourhoods. */
enum { FARTHEST = 100 };

status check_strength_below_tenth_of_modulus(struct reader *r, const struct yaml_node *strength_node,
                                             const struct material *material, real strength)
{
    if (!(strength > 0.1 * material->young)) return OK;
    return fault_report_at_node(r, strength_node,
                                "%s is above a tenth of Young's modulus, %.4g Pa; give a smaller strength",
                                node_value_to_text_for_message(r, strength_node), 0.1 * material->young);
}

/* Returns OK if low sigma_t < value <= high sigma_t, else REFUSED with a message, with the tensile strength sigma_t of
 * material m. value: a strength [Pa]; n: node from which it was read, for the message. */
static status check_fraction(struct reader *r, const struct yaml_node *n, const struct material *m, real value,
                             real low, real high)
{
    if (value > low * m->tensile_strength && value <= high * m->tensile_strength) return OK;
    if (isinf(high))
        return fault_report_at_node(r, n, "is too small; give more than %.4g Pa, %s of tensile_strength",
                                    low * m->tensile_strength, low < 0.4 ? "a third" : "a half");
    return fault_report_at_node(
        r, n,
        "is out of range; give more than %.4g Pa (half of tensile_strength) and at most %.4g Pa (tensile_strength)",
        low * m->tensile_strength, high * m->tensile_strength);
}

/* Sets m->surface, the strength surface of material m, from the strength that the key `key` gives. n: YAML node of the
 * key. Returns REFUSED, with a message, for a compressive strength below the tensile strength, a hydrostatic strength
 * of at most a third of it, a biaxial strength not between half of it and all of it, or a strength above a tenth of
 * Young's modulus. */
static status surface_from(struct reader *r, const struct yaml_node *n, const char *key, struct material *m)
{
    const real tension = m->tensile_strength;
    const enum space space = r->scene->space;
    if (key[0] == 'c') {
        TRY(check_strength_below_tenth_of_modulus(r, n, m, m->compressive_strength));
        if (m->compressive_strength < tension)
            return fault_report_at_node(r, n, "is below tensile_strength; give at least %.4g Pa", tension);
        material_set_strength_surface(m, space,
                                      strength_surface_from_compressive_strength(tension, m->compressive_strength));
    } else if (key[0] == 'h') {
        TRY(check_strength_below_tenth_of_modulus(r, n, m, m->hydrostatic_strength));
        TRY(check_fraction(r, n, m, m->hydrostatic_strength, 1.0 / 3, INFINITY));
        material_set_strength_surface(m, space,
                                      strength_surface_from_hydrostatic_strength(tension, m->hydrostatic_strength));
    } else {
        TRY(check_fraction(r, n, m, m->biaxial_strength, 0.5, 1));
        material_set_strength_surface(m, space, strength_surface_from_biaxial_strength(tension, m->biaxial_strength));
    }
    return OK;
}

/* Returns the characteristic length E G_c/strength^2 of material m [m]. If G_c is not given, it follows from the
 * critical stretch of bonds in the scene s. */
static real characteristic_length(const struct scene *s, const struct material *m)
{
    struct material unit = *m;
    unit.energy_release_rate = 1;
    const real release_rate = isnan(m->energy_release_rate)
                                  ? square(m->critical_stretch / scene_critical_stretch(s, &unit))
                                  : m->energy_release_rate;
    return m->young * release_rate / square(m->tensile_strength);
}

real scene_strength_surface_averaging_radius(const struct scene *s, const struct material *m)
{
    return s->horizon * s->spacing * sqrt(m->surface_means + MEANS_OF_FAMILY);
}

real scene_largest_horizon_for_strength_surface(const struct scene *s, const struct material *m)
{
    const struct surface_strengths surface = material_strengths_from_strength_surface(m, s->space);
    const real strain = real_max(surface.tension / material_uniaxial_tension_modulus(m, s->space),
                                 surface.shear * (1 + m->poisson) / m->young);
    return s->horizon * s->spacing * square(m->onset_stretch / strain);
}

/* Returns REFUSED, with a message, if bonds of material m begin to soften alone, by their own stretch, before its
 * strength surface is reached in tension. n: YAML node of the tensile strength. */
static status check_first(struct reader *r, const struct yaml_node *n, const struct material *m)
{
    const struct scene *s = r->scene;
    const struct softening_curve curve = softening_curve_of_law(m->softening);
    const real own = material_uniaxial_tension_modulus(m, s->space) * m->onset_stretch *
                     softening_curve_normalised_peak_stresses(&curve, s->space, OWN_RATIO).tension;
    const real most =
        s->horizon * s->spacing * square(own / material_strengths_from_strength_surface(m, s->space).tension);
    const bool spacing_counts = !isnan(m->energy_release_rate);
    if (spacing_counts &&
        spacing_search_reduce_upper_bound_if_active(r, scene_largest_horizon_for_strength_surface(s, m) / s->horizon))
        return OK;
    if (most >= s->horizon * s->spacing) return OK;
    return fault_report_at_node(
        r, n,
        "with a horizon of %.4g m bonds soften at %.4g Pa, before the strength surface is reached; use a "
        "horizon below %.4g m, which needs particles.spacing below %.4g m%s",
        s->horizon * s->spacing, own, most, most / s->horizon, strength_unit_hint_if_required_horizon_is_tiny(s, most));
}

status read_strength_surface(struct reader *r, const struct yaml_node *material_node, struct material *material)
{
    static const char *const names[] = {"compressive_strength", "hydrostatic_strength", "biaxial_strength"};
    const struct scene *s = r->scene;
    const struct yaml_node *given = NULL, *radius = yaml_node_find(material_node, "strength_radius");
    const char *key = NULL;
    for (size_t k = 0; k < COUNT_OF(names); k++) {
        const struct yaml_node *next = yaml_node_find(material_node, names[k]);
        if (next && given) return fault_report_exclusive_keys(r, given, next);
        if (next) given = next, key = names[k];
    }
    if (!given && radius)
        return fault_report_at_node(
            r, radius,
            "belongs to a strength surface; add compressive_strength, hydrostatic_strength or biaxial_strength");
    if (!given) return OK;
    if (s->model != MODEL_BOND)
        return fault_report_at_node(
            r, given,
            "a strength surface (a strength that depends on the stress state) needs model: bond; set it, or "
            "remove this key");
    if (s->space == SPACE_LINE)
        return fault_report_at_node(
            r, given,
            "belongs to a strength surface, which space line does not have; remove it, and keep tensile_strength");
    TRY(surface_from(r, given, key, material));
    const real share = s->space == SPACE_PLANE_STRESS ? RADIUS_PLANE_STRESS : RADIUS_ELSE;
    const real reach = radius ? material->strength_radius : share * characteristic_length(s, material);
    if (radius && reach > FARTHEST * s->horizon * s->spacing)
        return fault_report_at_node(r, radius, "%.4g m is more than %d horizons; give at most %.4g m", reach, FARTHEST,
                                    FARTHEST * s->horizon * s->spacing);
    material->surface_means =
        (int)real_min(1e4, real_max(0, ceil(square(reach / (s->horizon * s->spacing)) - MEANS_OF_FAMILY)));
    material->onset_stretch = material->critical_stretch / sqrt(OWN_RATIO);
    return check_first(r, yaml_node_find(material_node, "tensile_strength"), material);
}
