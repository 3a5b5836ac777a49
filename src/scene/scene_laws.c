/* Reads laws by which metals yield: hardening curves, kinematic hardening, Johnson-Cook, heating (data/law.h). */
#include "scene_parts.h"
#include "scene_remedies.h"

#include <math.h>

/* Relative excess up to which a segment of a hardening curve counts as no steeper than the previous one [1]: the
 * numbers of a scene are rounded decimals. */
#define SLOPE_ROUNDING 1e-9

/* Returns REFUSED, with a message, unless the hardening curve c allows the return mapping to solve its equation segment
 * by segment: plastic strains ascend from 0, stresses do not fall, slopes do not grow. n: list of the points, for
 * messages. */
static status check_curve(struct reader *r, const struct yaml_node *n, const struct flow_curve *c)
{
    const struct yaml_node *point = n->first;
    real before = INFINITY;
    for (int k = 0; k < c->points; k++, point = point->next) {
        if (k == 0 && c->strain[0] != 0)
            return fault_report_at_node(
                r, point, "begins at a plastic strain of %g; give the yield stress at strain 0 as the first point",
                c->strain[0]);
        if (k == 0) continue;
        if (!(c->strain[k] > c->strain[k - 1]))
            return fault_report_at_node(
                r, point,
                "the plastic strain %g is not larger than the previous one, %g; give strains in ascending order",
                c->strain[k], c->strain[k - 1]);
        const real slope = (c->stress[k] - c->stress[k - 1]) / (c->strain[k] - c->strain[k - 1]);
        if (slope < 0)
            return fault_report_at_node(r, point, "the yield stress falls to %g Pa; give stresses that do not fall",
                                        c->stress[k]);
        if (slope > before * (1 + SLOPE_ROUNDING))
            return fault_report_at_node(
                r, point,
                "the slope of the curve increases at this point, to %g Pa from %g Pa; give a curve whose "
                "slope does not increase",
                slope, before);
        before = slope;
    }
    return OK;
}

/* Reads the list n of pairs of plastic strain [1] and stress [Pa] into the hardening curve c. Returns REFUSED, with a
 * message, for invalid points, or if the return mapping cannot solve its equation with this curve (check_curve). */
static status read_curve(struct reader *r, const struct yaml_node *n, struct flow_curve *c)
{
    const struct key strain = {
        .path = "material.hardening.table", .type = KEY_REAL, .unit = UNIT_NONE, .range = {0, 1000, false, true}};
    const struct key stress = {.path = "material.hardening.table",
                               .type = KEY_REAL,
                               .unit = UNIT_PRESSURE,
                               .range = {0, INFINITY, true, true}};
    TRY(check_node_kind(r, n, NODE_LIST, "give a list of points [plastic strain, stress]"));
    if (n->n < 2 || n->n > FLOW_POINTS)
        return fault_report_at_node(r, n, "has %d points; give 2 to %d", n->n, FLOW_POINTS);
    for (const struct yaml_node *point = n->first; point; point = point->next, c->points++) {
        if (point->kind != NODE_LIST || point->n != 2)
            return fault_report_at_node(r, point, "%s is not a point of a curve; give [plastic strain, stress]",
                                        node_value_to_text_for_message(r, point));
        TRY(read_number(r, &strain, point->first, &c->strain[c->points]));
        TRY(read_number(r, &stress, point->first->next, &c->stress[c->points]));
    }
    return check_curve(r, n, c);
}

/* Returns REFUSED with a message that names the words of all flow laws in `hardening`. n: YAML node of `hardening`. */
static status fault_no_law(struct reader *r, const struct yaml_node *n)
{
    char words[200] = "";
    for (int flow = 0, length = 0; flow < FLOW_LAWS; flow++) {
        const char *word = flow_properties[flow].word;
        if (word) length += snprintf(words + length, sizeof words - (size_t)length, "%s%s", length ? "|" : "", word);
    }
    return fault_report_at_node(r, n, "has no law; give %s", allowed_words_join_for_message(r, words));
}

/* Reads the flow law in the mapping `hardening` into `law`. material: YAML node of the material; n: node of
 * `hardening`. Returns REFUSED, with a message, if there are no or several laws, or if yield_hardening is given too. */
static status read_hardening_law(struct reader *r, const struct yaml_node *material, const struct yaml_node *n,
                                 struct law *law)
{
    char group[64];
    const struct yaml_node *given = NULL, *modulus = yaml_node_find(material, "yield_hardening");
    TRY(read_keys_of_group(r, n, n, "material.hardening", law));
    for (int flow = 0; flow < FLOW_LAWS; flow++) {
        const char *word = flow_properties[flow].word;
        const struct yaml_node *one = word ? yaml_node_find(n, word) : NULL;
        if (one && given) return fault_report_exclusive_keys(r, given, one);
        if (one) given = one, law->flow = flow;
    }
    if (!given) return fault_no_law(r, n);
    if (modulus) return fault_report_exclusive_keys(r, modulus, n);
    law->given = true;
    if (law->flow == FLOW_TABLE) return read_curve(r, given, &law->table);
    snprintf(group, sizeof group, "material.hardening.%s", flow_properties[law->flow].word);
    return read_keys_of_group(r, given, given, group, law);
}

/* Reads the flow law of Johnson and Cook into `law`. material: YAML node of the material; n: node of `johnson_cook`.
 * Returns REFUSED, with a message, if another hardening is given too, or if the melting temperature is not above room
 * temperature. */
static status read_johnson_cook(struct reader *r, const struct yaml_node *material, const struct yaml_node *n,
                                struct law *law)
{
    const struct yaml_node *hardening = yaml_node_find(material, "hardening"),
                           *modulus = yaml_node_find(material, "yield_hardening");
    if (hardening || modulus) return fault_report_exclusive_keys(r, hardening ? hardening : modulus, n);
    TRY(read_keys_of_group(r, n, n, "material.johnson_cook", law));
    law->given = true, law->flow = FLOW_JOHNSON_COOK;
    if (law->johnson_cook.T_melt > law->johnson_cook.T_room) return OK;
    return fault_report_at_node(r, yaml_node_find(n, "T_melt"),
                                "%g K is not above T_room, %g K; give the melting temperature of the material",
                                law->johnson_cook.T_melt, law->johnson_cook.T_room);
}

/* Completes the heating of a material by plastic work in `law`: sets the fraction of the work that becomes heat to 0.9
 * unless it is given. material: YAML node of the material. Returns REFUSED, with a message, if this fraction is given
 * without specific heat, or specific heat without a flow law that depends on temperature. */
static status read_heat(struct reader *r, const struct yaml_node *material, struct law *law)
{
    const struct yaml_node *heat = yaml_node_find(material, "specific_heat"),
                           *share = yaml_node_find(material, "taylor_quinney");
    if (!heat && share)
        return fault_report_at_node(r, share, "has no effect without specific_heat; add specific_heat, or remove it");
    if (!heat) return OK;
    if (!law->given || law->flow != FLOW_JOHNSON_COOK)
        return fault_report_at_node(
            r, heat, "has no effect without johnson_cook, whose yield stress depends on temperature; remove it");
    if (!share) law->taylor_quinney = 0.9;
    return OK;
}

/* Returns REFUSED, with a message, if the material m has a yield stress or yield tangent although its flow law
 * replaces them, or if its law needs a yield stress and none is given. material: YAML node of the material; law_node:
 * node of the law. */
static status check_first_yield(struct reader *r, const struct yaml_node *material, const struct yaml_node *law_node,
                                const struct material *m)
{
    const struct yaml_node *yield = yaml_node_find(material, "yield_stress"),
                           *tangent = yaml_node_find(material, "yield_tangent");
    const bool own = flow_properties[m->law.flow].own_yield;
    const bool linear = m->law.flow == FLOW_LINEAR && !yaml_node_find(material, "hardening");
    if (own && isfinite(m->yield_stress)) return fault_report_exclusive_keys(r, yield, law_node);
    if (!own && !isfinite(m->yield_stress))
        return fault_report_at_node(r, law_node, "needs the yield stress at zero plastic strain; add yield_stress");
    if (!linear && m->yield_tangent > 0) return fault_report_exclusive_keys(r, tangent, law_node);
    return OK;
}

/* Returns REFUSED, with a message, unless the method of the scene is mpm: other methods do not have these flow laws.
 * law_node: YAML node of the law, for the message. */
static status check_law_place(struct reader *r, const struct yaml_node *law_node)
{
    return r->scene->method == METHOD_MPM ? OK : refuse_flow_law_without_mpm(r, law_node);
}

const struct yaml_node *material_node_find_yield_key(const struct yaml_node *material_node)
{
    static const char *const names[] = {"yield_stress", "johnson_cook", "hardening"};
    for (size_t k = 0; k < COUNT_OF(names); k++)
        if (yaml_node_find(material_node, names[k])) return yaml_node_find(material_node, names[k]);
    return material_node;
}

status read_flow_law(struct reader *r, const struct yaml_node *material_node, struct material *material)
{
    struct law *law = &material->law;
    const struct yaml_node *hardening = yaml_node_find(material_node, "hardening"),
                           *kinematic = yaml_node_find(material_node, "kinematic"),
                           *johnson_cook = yaml_node_find(material_node, "johnson_cook"),
                           *first = hardening ? hardening : johnson_cook;
    if (hardening) TRY(read_hardening_law(r, material_node, hardening, law));
    if (johnson_cook) TRY(read_johnson_cook(r, material_node, johnson_cook, law));
    if (!first) first = kinematic;
    if (kinematic) TRY(read_keys_of_group(r, kinematic, kinematic, "material.kinematic", law));
    if (!law->given && (kinematic || (material_yields(material) && r->scene->method != METHOD_PD))) {
        law->given = true, law->flow = FLOW_LINEAR;
        law->hardening = material->young * material->yield_tangent / (material->young - material->yield_tangent);
    }
    TRY(read_heat(r, material_node, law));
    if (!first) return OK;
    TRY(check_first_yield(r, material_node, first, material));
    return check_law_place(r, first);
}
