/* Reads the tensile strength of a material: its bonds soften. */
#include <math.h>

#include "data/softening.h"
#include "scene_internal.h"
#include "scene_remedies.h"

/* Returns REFUSED if bonds of material m would break before its tensile strength is reached, or if the strength is
 * above a tenth of Young's modulus. m->onset_stretch must be set. n: node of the tensile strength. */
static status check_reachable(struct reader *r, const struct yaml_node *n, const struct material *m)
{
    const struct scene *s = r->scene;
    const real strain = m->tensile_strength / material_uniaxial_tension_modulus(m, s->space);
    const real most = s->horizon * s->spacing * square(m->critical_stretch / strain);
    if (m->onset_stretch < m->critical_stretch) return OK;
    if (isnan(m->energy_release_rate))
        return fault(r, n,
                     "bonds break at a stretch of %.4g, which is a stress of %.4g Pa; less, or a larger "
                     "critical_stretch, is expected",
                     m->critical_stretch, m->critical_stretch * material_uniaxial_tension_modulus(m, s->space));
    return fault(r, n,
                 "bonds of this horizon, %.4g m, break at %.4g Pa by the energy release rate, before this strength is "
                 "reached; a horizon below %.4g m, particles.spacing below %.4g m, is expected%s",
                 s->horizon * s->spacing, m->critical_stretch * material_uniaxial_tension_modulus(m, s->space), most,
                 most / s->horizon, strength_unit_hint(s, most));
}

/* Returns REFUSED for a key of a strength surface in a material without tensile strength. */
static status check_no_surface(struct reader *r, const struct yaml_node *n)
{
    static const char *const names[] = {"compressive_strength", "hydrostatic_strength", "biaxial_strength",
                                        "strength_radius"};
    for (size_t k = 0; k < COUNT_OF(names); k++) {
        const struct yaml_node *key = yaml_node_find(n, names[k]);
        if (key) return fault(r, key, "is of a strength surface; tensile_strength is expected with it");
    }
    return OK;
}

/* Returns true if load steps could do the softening of a material: with bonds alone and without a strength surface. n:
 * node of the material. */
static bool steps_can_soften(const struct scene *s, const struct yaml_node *n)
{
    return s->method == METHOD_PD && !yaml_node_find(n, "compressive_strength") &&
           !yaml_node_find(n, "hydrostatic_strength") && !yaml_node_find(n, "biaxial_strength");
}

status read_softening(struct reader *r, const struct yaml_node *n, struct material *m)
{
    const struct scene *s = r->scene;
    const struct yaml_node *strength = yaml_node_find(n, "tensile_strength"), *law = yaml_node_find(n, "softening"),
                           *scatter = yaml_node_find(n, "scatter");
    m->onset_stretch = m->critical_stretch;
    if (law && !strength) return fault(r, law, "says how bonds lose their tensile_strength, which is expected with it");
    if (!strength) return check_no_surface(r, n);
    if (!material_yields(m) && (s->method == METHOD_MPM || s->model != MODEL_BOND))
        return refuse_softening(r, strength);
    const char *why = material_yields(m) ? "is of bonds that do not yield; one of yield_stress and tensile_strength is "
                                           "expected"
                      : scene_is_single_equilibrium(s)
                          ? steps_can_soften(s, n)
                                ? "is of bonds that break, and none does in a single equilibrium; solver: explicit or "
                                  "static is expected"
                                : "is of bonds that break, and none does in a single equilibrium; solver: explicit is "
                                  "expected"
                      : !isfinite(m->critical_stretch)
                          ? "tells the stress but not the energy at which bonds end; energy_release_rate, toughness or "
                            "critical_stretch is expected, too"
                          : NULL;
    if (why) return fault(r, strength, "%s", why);
    if (scatter && m->scatter.of != SCATTER_STRENGTH && m->scatter.of != SCATTER_STRETCH)
        return fault(r, yaml_node_find(scatter, "of"),
                     "with tensile_strength, `of: strength` (at one energy) or critical_stretch (with it) is expected");
    TRY(check_strength_size(r, strength, m, m->tensile_strength));
    m->onset_stretch = softening_onset_from_strength(m, s->space);
    TRY(read_surface(r, n, m));
    return material_has_surface(m) ? OK : check_reachable(r, strength, m);
}

status check_one_softening(struct reader *r, const struct yaml_node *n, int k)
{
    const struct material *m = r->scene->material;
    for (int j = 0; j < k; j++)
        if (material_softens(&m[j]) && material_softens(&m[k]) && m[j].softening != m[k].softening)
            return fault(r, n, "softens by another law than material %s; one law for all is expected", m[j].name);
    return OK;
}
