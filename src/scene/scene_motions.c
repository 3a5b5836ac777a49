/* Reads the motions of a solid: move, rotate, mirror and pattern, in the order of the scene. */
#include "scene_parts.h"

#include <math.h>
#include <string.h>

/* Keys by which a solid is moved or copied. */
static const char *const motion_words[] = {"move", "rotate", "mirror", "pattern"};

bool node_is_motion_key_of_solid(const struct yaml_node *n)
{
    bool is = false;
    for (size_t k = 0; k < COUNT_OF(motion_words); k++) is |= strcmp(n->key, motion_words[k]) == 0;
    return is;
}

/* Reads the axis of a rotation into m, by default z. n: YAML node of the rotation. Returns REFUSED, with a message,
 * for an axis without length, for any axis in 2D, and in 1D. */
static status read_turning_axis(struct reader *r, const struct yaml_node *n, struct solid_motion *m)
{
    const struct yaml_node *axis = yaml_node_find(n, "axis");
    if (r->dim == 1)
        return fault_report_at_node(r, n, "a solid on a line cannot turn; use move, mirror or pattern.grid");
    if (r->dim == 2 && axis)
        return fault_report_at_node(r, axis, "solids in the plane always turn about z; remove axis");
    if (!m->has_axis) m->axis[2] = 1;
    m->has_axis = r->dim == 3;
    if (dot(m->axis, m->axis, DIM_MAX) > 0) return OK;
    return fault_report_at_node(r, axis, "has the length 0; give an axis such as [0, 0, 1]");
}

/* Reads the centre of a rotation into m->about [m], by default the centre of the bounding box of the solid s. n: YAML
 * node of the rotation. Returns REFUSED, with a message, if the centre is not given and the box is infinite. */
static status read_about(struct reader *r, const struct yaml_node *n, const struct solid *s, struct solid_motion *m)
{
    for (int d = 0; d < r->dim && !m->has_about; d++) {
        real along[DIM_MAX] = {0};
        along[d] = -1;
        const real low = -solid_support_function(s, along, r->dim);
        along[d] = 1;
        const real high = solid_support_function(s, along, r->dim);
        m->about[d] = 0.5 * (low + high);
        if (!isfinite(m->about[d]))
            return fault_report_at_node(
                r, n, "an infinite solid has no middle about which to turn; give a point by the key about");
    }
    m->has_about = true;
    return OK;
}

static status read_rotate(struct reader *r, const struct yaml_node *n, const struct solid *s, struct solid_motion *m)
{
    m->kind = MOTION_ROTATE;
    TRY(read_keys_of_group(r, n, n, "solid.rotate", m));
    TRY(read_turning_axis(r, n, m));
    return read_about(r, n, s, m);
}

static status read_mirror_image(struct reader *r, const struct yaml_node *n, struct solid_motion *m)
{
    m->kind = MOTION_MIRROR;
    TRY(read_keys_of_group(r, n, n, "solid.mirror", m));
    if (dot(m->axis, m->axis, r->dim) > 0) return OK;
    return fault_report_at_node(r, yaml_node_find(n, "normal"),
                                "has the length 0; give the normal of the plane, such as [1, 0]");
}

static status read_pattern(struct reader *r, const struct yaml_node *n, struct solid_motion *m)
{
    TRY(check_node_kind(r, n, NODE_MAP, "give a pattern such as grid: {count: [..], step: [..]}"));
    TRY(check_mapping_keys_known_and_unique(r, n, "solid.pattern"));
    if (n->n != 1) return fault_report_at_node(r, n, "has %d keys; give one, grid or ring", n->n);
    const struct yaml_node *form = n->first;
    const bool ring = strcmp(form->key, "ring") == 0;
    m->kind = ring ? MOTION_RING : MOTION_GRID;
    TRY(read_keys_of_group(r, form, form, ring ? "solid.pattern.ring" : "solid.pattern.grid", m));
    for (int d = 0; d < (ring ? 1 : r->dim); d++)
        if (m->count[d] != round(m->count[d]))
            return fault_report_at_node(r, yaml_node_find(form, "count"),
                                        "%s is not a whole number; give the number of copies",
                                        node_value_to_text_for_message(r, yaml_node_find(form, "count")));
    if (!ring) return OK;
    if (!m->has_angle) m->angle = 2 * 3.14159265358979323846 / m->count[0];
    return read_turning_axis(r, form, m);
}

static status read_motion(struct reader *r, const struct yaml_node *n, const struct solid *s, struct solid_motion *m)
{
    const int word = word_index_in_list("move|rotate|mirror|pattern", n->key);
    switch (word) {
    case 0:
        m->kind = MOTION_MOVE;
        return read_value_of_key(r, key_find("solid", "move"), n, m);
    case 1:
        return read_rotate(r, n, s, m);
    case 2:
        return read_mirror_image(r, n, m);
    default:
        return read_pattern(r, n, m);
    }
}

status read_solid_motions(struct reader *r, const struct yaml_node *solid_node, struct solid *solid)
{
    for (const struct yaml_node *c = solid_node->first; c; c = c->next) {
        struct solid_motion m = {0};
        if (!node_is_motion_key_of_solid(c)) continue;
        TRY(read_motion(r, c, solid, &m));
        if (!solid_apply_motion_unless_too_many_copies(solid, &m, r->dim))
            return fault_report_at_node(r, c, "makes more than %d copies of the solid; use fewer", IMAGES_MOST);
    }
    return OK;
}
