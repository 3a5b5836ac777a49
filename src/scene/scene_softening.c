/* Reads the tensile strength of a material: its bonds soften. */
#include <math.h>

#include "bonds/softening_work.h"
#include "scene/scene_softening.h"
#include "scene_parts.h"
#include "scene_remedies.h"

enum { ITERATIONS = 30 }; /* number of iterations for the stretches; each leaves about a tenth of the error */

struct softening_model scene_softening_model_of_bonds(const struct scene *s, const struct material *m)
{
    const bool rotates = s->model == MODEL_MOSPD;
    const real unit = material_uniaxial_tension_modulus(m, s->space);
    if (s->model == MODEL_BOND) return (struct softening_model){0, 0, false};
    const struct state_modulus modulus = state_based_moduli_of_material(m, s->space, rotates);
    return (struct softening_model){modulus.A / unit, modulus.B / unit, rotates};
}

/* Sets m->onset_stretch, at which bonds begin to soften, such that they have the tensile strength of material m. In
 * state-based models, where bonds dissipate energy together, also sets the critical stretch at which the separation of
 * a lattice dissipates G_c. Both follow from a fixed-point iteration. s: scene, for horizon and model. */
static void set_stretches(const struct scene *s, struct material *m)
{
    const struct softening_model model = scene_softening_model_of_bonds(s, m);
    m->onset_stretch = softening_model_onset_stretch_from_strength(m, s->space, &model);
    if (s->model == MODEL_BOND || isnan(m->energy_release_rate)) return;
    const struct family f = scene_make_complete_lattice_family(s);
    const struct state_modulus modulus = state_based_moduli_of_material(m, s->space, model.rotates);
    const struct softening_curve curve = softening_curve_of_law(m->softening);
    for (int k = 0; k < ITERATIONS && m->onset_stretch < m->critical_stretch; k++) {
        const struct softening_range range = softening_range_from_onset(&curve, m->onset_stretch, m->critical_stretch);
        const real work = family_fracture_energy_of_softening_bonds(&f, &modulus, model.rotates, &curve, range);
        m->critical_stretch *= sqrt(m->energy_release_rate / work);
        m->onset_stretch = softening_model_onset_stretch_from_strength(m, s->space, &model);
        if (fabs(work / m->energy_release_rate - 1) < 1e-7) break;
    }
}

real scene_horizon_for_failure_to_onset_stretch_ratio(const struct scene *s, const struct material *m,
                                                      real squared_stretch_ratio)
{
    const struct softening_curve curve = softening_curve_of_law(m->softening);
    const struct softening_model model = scene_softening_model_of_bonds(s, m);
    const real phi =
        squared_stretch_ratio > 1
            ? softening_model_normalised_peak_stresses(&curve, s->space, squared_stretch_ratio, &model).tension
            : 1;
    const real onset = m->tensile_strength / (material_uniaxial_tension_modulus(m, s->space) * phi);
    return s->horizon * s->spacing * square(m->critical_stretch / onset) / squared_stretch_ratio;
}

/* Returns REFUSED, with a message, if bonds of material m would break before its tensile strength is reached, or would
 * need a finer spacing. Call after m->onset_stretch is set. n: YAML node of the tensile strength. */
static status check_reachable(struct reader *r, const struct yaml_node *n, const struct material *m)
{
    const struct scene *s = r->scene;
    const real most = scene_horizon_for_failure_to_onset_stretch_ratio(s, m, 1);
    const bool spacing_counts = !isnan(m->energy_release_rate);
    if (spacing_counts && spacing_search_reduce_upper_bound_if_active(
                              r, scene_horizon_for_failure_to_onset_stretch_ratio(s, m, FREE_OF_TRAPPING) / s->horizon))
        return OK;
    if (m->onset_stretch < m->critical_stretch) return OK;
    if (isnan(m->energy_release_rate))
        return fault_report_at_node(
            r, n,
            "bonds break at a stretch of %.4g, a stress of %.4g Pa, before this strength is reached; give a "
            "lower tensile_strength, or a larger critical_stretch",
            m->critical_stretch, m->critical_stretch * material_uniaxial_tension_modulus(m, s->space));
    return fault_report_at_node(
        r, n,
        "with a horizon of %.4g m bonds break at %.4g Pa by the energy release rate, before this strength is "
        "reached; use a horizon below %.4g m, which needs particles.spacing below %.4g m%s",
        s->horizon * s->spacing, m->critical_stretch * material_uniaxial_tension_modulus(m, s->space), most,
        most / s->horizon, strength_unit_hint_if_required_horizon_is_tiny(s, most));
}

/* Reads the list n of pairs of strain rate [1/s] and factor of strength [1] into *rate. Returns REFUSED, with a
 * message, for points out of order. */
static status read_rate_table(struct reader *r, const struct yaml_node *n, struct strength_rate *rate)
{
    const struct key rates = {
        .path = "material.rate.table", .type = KEY_REAL, .unit = UNIT_RATE, .range = {0, INFINITY, true, true}};
    const struct key factors = {
        .path = "material.rate.table", .type = KEY_REAL, .unit = UNIT_NONE, .range = {1, 100, false, true}};
    TRY(check_node_kind(r, n, NODE_LIST, "give a list of points [strain rate, factor]"));
    if (n->n < 1 || n->n > RATE_POINTS)
        return fault_report_at_node(r, n, "has %d points; give 1 to %d", n->n, RATE_POINTS);
    for (const struct yaml_node *point = n->first; point; point = point->next) {
        const int k = rate->points++;
        if (point->kind != NODE_LIST || point->n != 2)
            return fault_report_at_node(r, point, "%s is not a point of the table; give [strain rate, factor]",
                                        node_value_to_text_for_message(r, point));
        TRY(read_number(r, &rates, point->first, &rate->rate[k]));
        TRY(read_number(r, &factors, point->first->next, &rate->factor[k]));
        if (k > 0 && !(rate->rate[k] > rate->rate[k - 1]))
            return fault_report_at_node(
                r, point, "the strain rate %g 1/s is not above the previous one, %g 1/s; give rates in ascending order",
                rate->rate[k], rate->rate[k - 1]);
        if (k > 0 && rate->factor[k] < rate->factor[k - 1])
            return fault_report_at_node(r, point, "the factor falls from %g to %g; give factors that do not fall",
                                        rate->factor[k - 1], rate->factor[k]);
    }
    return OK;
}

/* Reads how the tensile strength of material m grows with the strain rate. Call after m->onset_stretch is set. Does
 * nothing without the key `rate`. n: YAML node of the material. Returns REFUSED, with a message, where rates have no
 * meaning, and for a strength that bonds of this horizon do not reach. */
static status read_rate(struct reader *r, const struct yaml_node *n, struct material *m)
{
    const struct scene *s = r->scene;
    const struct yaml_node *rate = yaml_node_find(n, "rate"), *table = rate ? yaml_node_find(rate, "table") : NULL;
    if (!rate) return OK;
    TRY(read_keys_of_group(r, rate, rate, "material.rate", m));
    if (!table) return fault_report_missing_key(r, rate, key_find("material.rate", "table"));
    if (s->solver != SOLVER_EXPLICIT)
        return fault_report_at_node(
            r, rate,
            "load steps have no strain rate, so a strength that depends on it cannot be used; remove rate, or "
            "set solver: explicit");
    if (material_has_strength_surface(m))
        return fault_report_at_node(
            r, rate, "a strength surface cannot depend on the strain rate; remove rate, or the second strength");
    TRY(read_rate_table(r, table, &m->rate));
    const real strongest = m->tensile_strength * m->rate.factor[m->rate.points - 1];
    TRY(check_strength_below_tenth_of_modulus(r, table, m, strongest));
    const struct softening_model model = scene_softening_model_of_bonds(s, m);
    const real least = strength_rate_compute_softening_onset_factors(m, s->space, &model);
    const real most = s->horizon * s->spacing * least / RATE_LEAST_RATIO;
    if (least >= RATE_LEAST_RATIO || spacing_search_reduce_upper_bound_if_active(r, most / s->horizon)) return OK;
    return fault_report_at_node(
        r, table,
        "with a horizon of %.4g m bonds break by the energy release rate before they reach %.4g Pa, the "
        "strength at the last rate; use a horizon below %.4g m, which needs particles.spacing below %.4g m",
        s->horizon * s->spacing, strongest, most, most / s->horizon);
}

/* Returns REFUSED, with a message, if a material without tensile strength has a key of a strength surface or of a
 * strain rate. n: YAML node of the material. */
static status check_no_surface(struct reader *r, const struct yaml_node *n)
{
    static const char *const names[] = {"compressive_strength", "hydrostatic_strength", "biaxial_strength",
                                        "strength_radius"};
    const struct yaml_node *rate = yaml_node_find(n, "rate");
    if (rate)
        return fault_report_at_node(
            r, rate,
            "has no effect without tensile_strength, which it raises with the strain rate; give tensile_strength too");
    for (size_t k = 0; k < COUNT_OF(names); k++) {
        const struct yaml_node *key = yaml_node_find(n, names[k]);
        if (key)
            return fault_report_at_node(
                r, key, "belongs to a strength surface, which needs tensile_strength too; add tensile_strength");
    }
    return OK;
}

status read_softening_onset(struct reader *r, const struct yaml_node *material_node, struct material *material)
{
    const struct scene *s = r->scene;
    const struct yaml_node *strength = yaml_node_find(material_node, "tensile_strength"),
                           *law = yaml_node_find(material_node, "softening"),
                           *scatter = yaml_node_find(material_node, "scatter");
    material->onset_stretch = material->critical_stretch;
    if (law && !strength)
        return fault_report_at_node(
            r, law,
            "has no effect without tensile_strength, because it describes how bonds soften from this strength "
            "on; add tensile_strength, or remove it");
    if (!strength) return check_no_surface(r, material_node);
    if (!material_yields(material) && s->method == METHOD_MPM) return refuse_unsupported_softening(r, strength);
    if (material_yields(material))
        return fault_report_at_node(r, strength,
                                    "cannot be combined with %s: bonds either soften or yield; remove one of the two",
                                    material_node_find_yield_key(material_node)->key);
    const char *why =
        scene_is_single_equilibrium(s)
            ? s->method == METHOD_PD
                  ? "has no effect with this solver, whose single equilibrium breaks no bonds; set solver: explicit or "
                    "static"
                  : "has no effect with this solver, whose single equilibrium breaks no bonds; set solver: explicit"
        : !isfinite(material->critical_stretch)
            ? "needs the energy that a bond dissipates; add energy_release_rate, toughness or critical_stretch"
            : NULL;
    if (why) return fault_report_at_node(r, strength, "%s", why);
    if (scatter && material->scatter.of != SCATTER_STRENGTH && material->scatter.of != SCATTER_STRETCH)
        return fault_report_at_node(
            r, yaml_node_find(scatter, "of"),
            "this choice cannot be combined with tensile_strength; set scatter.of: strength (the energy does "
            "not vary) or critical_stretch (it does)");
    TRY(check_strength_below_tenth_of_modulus(r, strength, material, material->tensile_strength));
    set_stretches(s, material);
    TRY(read_strength_surface(r, material_node, material));
    if (!material_has_strength_surface(material)) TRY(check_reachable(r, strength, material));
    return read_rate(r, material_node, material);
}

status check_single_softening_law(struct reader *r, const struct yaml_node *material_node, int material_index)
{
    const struct material *m = r->scene->material;
    for (int j = 0; j < material_index; j++)
        if (material_has_softening_bonds(&m[j]) && material_has_softening_bonds(&m[material_index]) &&
            m[j].softening != m[material_index].softening)
            return fault_report_at_node(
                r, material_node, "has another value of softening than material %s; give all materials the same one",
                m[j].name);
    return OK;
}

const struct material *scene_find_first_material_that_satisfies(const struct scene *s,
                                                                bool (*condition)(const struct material *))
{
    for (int m = 0; m < s->materials; m++)
        if (condition(&s->material[m])) return &s->material[m];
    return NULL;
}

status check_softening_is_supported(struct reader *r, const struct yaml_node *root)
{
    const struct scene *s = r->scene;
    const struct yaml_node *model = yaml_node_find(root, "model"), *growth = yaml_node_find(root, "growth");
    const struct material *soft = scene_find_first_material_that_satisfies(s, material_has_softening_bonds),
                          *yields = scene_find_first_material_that_satisfies(s, material_yields);
    if (soft && yields)
        return fault_report_at_node(
            r, yaml_node_find(root, "materials"),
            "bonds of material %s soften and those of %s yield, and a scene cannot combine both; give "
            "materials a tensile_strength or a yield_stress, not both",
            soft->name, yields->name);
    if (!soft || s->model == MODEL_BOND) return OK;
    if (growth)
        return fault_report_at_node(
            r, growth,
            "prescribed crack growth cannot cut bonds that soften with this model; set model: bond, or remove "
            "tensile_strength");
    for (int m = 0; m < s->materials; m++)
        if (isfinite(s->material[m].critical_stretch) && !material_has_softening_bonds(&s->material[m]))
            return fault_report_at_node(
                r, model,
                "material %s breaks without softening while another softens; with model %s all materials that "
                "break must be of one kind: give each a tensile_strength, or none",
                s->material[m].name, node_value_to_text_for_message(r, model));
    return OK;
}
