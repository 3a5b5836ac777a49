/* Reads the materials of a scene. */
#include "scene_parts.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "scene_remedies.h"

/* Reads the fracture strength of material m from one of the keys energy_release_rate, critical_stretch and toughness.
 * Toughness K gives the energy release rate K^2/E, or K^2 (1 - nu^2)/E in plane strain and 3D. n: YAML node of the
 * material. Returns REFUSED, with a message, if more than one of the keys is given. */
static status read_strength(struct reader *r, const struct yaml_node *n, struct material *m)
{
    const char *const ways[] = {"energy_release_rate", "critical_stretch", "toughness"};
    const struct yaml_node *given = NULL, *toughness = yaml_node_find(n, "toughness");
    for (size_t k = 0; k < COUNT_OF(ways); k++) {
        const struct yaml_node *way = yaml_node_find(n, ways[k]);
        if (way && given)
            return fault_report_at_node(
                r, way, "is given together with %s, but each determines the other; remove one of the two", given->key);
        if (way) given = way;
    }
    if (toughness) {
        real K;
        bool plane_strain = r->scene->space == SPACE_PLANE_STRAIN || r->scene->space == SPACE_SOLID;
        TRY(read_number(r, key_find("material", "toughness"), toughness, &K));
        m->energy_release_rate = K * K / m->young * (plane_strain ? 1 - square(m->poisson) : 1);
    }
    if (!given) m->critical_stretch = INFINITY;
    return OK;
}

/* Returns REFUSED, with a message, if the material m is given a Poisson's ratio that bonds cannot have: bond-based
 * peridynamics has one elastic constant, an isotropic solid two. Returns OK for method mpm, space line and state-based
 * models, which have no such limit. n: YAML node of the material. */
static status check_poisson(struct reader *r, const struct yaml_node *n, const struct material *m)
{
    const struct scene *s = r->scene;
    const real bond = bond_based_poisson_ratio(s->space);
    const struct yaml_node *poisson = yaml_node_find(n, "poisson");
    if (!poisson || s->method == METHOD_MPM || s->model != MODEL_BOND || s->space == SPACE_LINE) return OK;
    if (fabs(m->poisson - bond) <= 1e-6) return OK;
    return refuse_bond_based_poisson_ratio(r, poisson);
}

/* Sets m->yield_tangent, the slope E_t of the stress-strain curve after yield [Pa], from the key yield_tangent or the
 * hardening modulus H of the key yield_hardening: E_t = E H/(E + H). n: YAML node of the material. Returns REFUSED,
 * with a message, if both are given, if the material has no yield stress, or unless E_t < E. */
static status read_hardening(struct reader *r, const struct yaml_node *n, struct material *m)
{
    const struct yaml_node *tangent = yaml_node_find(n, "yield_tangent"),
                           *hardening = yaml_node_find(n, "yield_hardening");
    real H;
    if (tangent && hardening)
        return fault_report_at_node(
            r, hardening, "is given together with yield_tangent, but each determines the other; remove one of the two");
    if (hardening) {
        TRY(read_number(r, key_find("material", "yield_hardening"), hardening, &H));
        m->yield_tangent = m->young * H / (m->young + H);
    }
    if ((tangent || hardening) && !yaml_node_find(n, "yield_stress"))
        return fault_report_at_node(r, tangent ? tangent : hardening,
                                    "has no effect without yield_stress: add yield_stress");
    if (m->yield_tangent < m->young) return OK;
    return fault_report_at_node(
        r, tangent ? tangent : hardening,
        "%s is not below Young's modulus; give the slope of the stress-strain curve after yield, at least 0 "
        "and below young",
        node_value_to_text_for_message(r, tangent ? tangent : hardening));
}

/* Reads the random scatter of the strength of material m. n: YAML node of `scatter`, or NULL if there is none. Returns
 * REFUSED, with a message, for a material whose bonds do not break, for material points that yield, and if the
 * parameter of the distribution is missing. */
static status read_scatter(struct reader *r, const struct yaml_node *n, struct material *m)
{
    struct strength_scatter *s = &m->scatter;
    if (!n) return OK;
    s->modulus = s->variation = NAN;
    TRY(read_keys_of_group(r, n, n, "material.scatter", s));
    s->given = true;
    const char *const own[] = {[SCATTER_WEIBULL] = "modulus", [SCATTER_LOGNORMAL] = "variation"};
    const struct yaml_node *other = yaml_node_find(n, own[!s->form]);
    if (!yaml_node_find(n, own[s->form]))
        return fault_report_missing_key(r, n, key_find("material.scatter", own[s->form]));
    if (other)
        return fault_report_at_node(
            r, other,
            "belongs to another distribution of strength; give %s in its place, the parameter of the chosen "
            "distribution",
            own[s->form]);
    if (!isfinite(m->critical_stretch) && isnan(m->energy_release_rate))
        return fault_report_at_node(
            r, n,
            "has no effect, because bonds of this material never break; give energy_release_rate, "
            "critical_stretch or toughness");
    if (material_yields(m) && r->scene->method == METHOD_MPM)
        return fault_report_at_node(
            r, n,
            "scatter varies the strength of bonds, but method: mpm has no bonds, and yield stresses do not "
            "scatter; set method: pd, or remove scatter");
    if (material_yields(m) && r->scene->method == METHOD_ADAPTIVE)
        return fault_report_at_node(
            r, n,
            "scatter and yield_stress cannot be combined with material points, whose stress after yield does "
            "not show how near bonds are to breaking; set method: pd, or remove yield_stress");
    return OK;
}

/* Reads the viscosity of material m. n: YAML node of `viscosity`, or NULL if there is none. With viscosity all cells
 * have one time step, and regions at rest are computed as well, because viscous forces act between moving regions and
 * regions at rest. Returns REFUSED, with a message, where viscosity has no effect. */
static status read_viscosity(struct reader *r, const struct yaml_node *n, struct material *m)
{
    struct scene *s = r->scene;
    if (!n) return OK;
    TRY(read_keys_of_group(r, n, n, "material.viscosity", m));
    if (s->levels == LEVELS_AUTO) s->levels = 0;
    s->active_set = false;
    const char *why = s->space == SPACE_PLANE_STRESS ? "cannot be used in space plane stress, where the change of "
                                                       "volume is unknown; set space: plane strain, solid or line"
                      : s->model != MODEL_BOND && s->method != METHOD_MPM ? "needs model: bond"
                      : !scene_is_dynamic(s)                              ? "needs solver: explicit"
                      : s->levels > 0 ? "needs one time step for the whole body; set mpm.levels: 0"
                                      : NULL;
    return why ? fault_report_at_node(r, n, "%s", why) : OK;
}

/* Reads the material of YAML node n into m, with defaults that depend on the space, and derives its wave speeds and
 * critical stretch. Returns REFUSED, with a message, for invalid or contradicting keys. */
static status scene_parts_read_material(struct reader *r, const struct yaml_node *n, struct material *m)
{
    const struct scene *s = r->scene;
    bool line = s->space == SPACE_LINE;
    m->energy_release_rate = m->law.specific_heat = m->law.taylor_quinney = m->tensile_strength = NAN;
    m->compressive_strength = m->hydrostatic_strength = m->biaxial_strength = m->strength_radius = NAN;
    m->poisson = line ? 0 : bond_based_poisson_ratio(s->space);
    strcpy(m->name, "material");
    TRY(read_keys_of_group(r, n, n, "material", m));
    TRY(check_poisson(r, n, m));
    TRY(read_strength(r, n, m));
    TRY(read_hardening(r, n, m));
    TRY(read_flow_law(r, n, m));
    TRY(read_scatter(r, yaml_node_find(n, "scatter"), m));
    TRY(read_viscosity(r, yaml_node_find(n, "viscosity"), m));
    if (s->model != MODEL_BOND && material_yields(m))
        return refuse_yield_with_state_model(r, material_node_find_yield_key(n));
    material_compute_derived_constants(m, s->space);
    if (!isnan(m->energy_release_rate)) m->critical_stretch = scene_critical_stretch(s, m);
    if (m->critical_stretch > 0) return read_softening_onset(r, n, m);
    return fault_report_at_node(r, n,
                                "its critical stretch is too small to be represented (it rounds to 0); give a larger "
                                "energy_release_rate and check its unit");
}

status read_materials(struct reader *r, const struct yaml_node *root)
{
    struct scene *s = r->scene;
    const struct yaml_node *one = yaml_node_find(root, "material"), *many = yaml_node_find(root, "materials");
    if (!one && !many) return fault_report_missing_key(r, root, key_find("", "material"));
    if (one && many) return fault_report_exclusive_keys(r, one, many);
    if (many) TRY(check_node_is_list_of_valid_length(r, key_find("", "materials"), many));
    s->materials = many ? many->n : 1;
    s->material = NEW("materials", s->materials, struct material);
    s->material_number = NEW("materials.numbers", s->materials, int);
    const struct yaml_node *n = many ? many->first : one;
    for (int k = 0; k < s->materials; k++, n = n->next) {
        TRY(scene_parts_read_material(r, n, &s->material[k]));
        s->material_number[k] = k;
        if (many && !yaml_node_find(n, "name")) return fault_report_missing_key(r, n, key_find("material", "name"));
        for (int j = 0; j < k; j++)
            if (strcmp(s->material[j].name, s->material[k].name) == 0)
                return fault_report_at_node(
                    r, yaml_node_find(n, "name"),
                    "%s is already the name of another material; give each material its own name", s->material[k].name);
        TRY(check_single_softening_law(r, n, k));
    }
    return OK;
}
