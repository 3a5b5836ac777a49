/* Reads parts of a body that consist of another material. Bonds between parts act as springs in series (bonds/bonds.c:
 * material_pair_table_compute_micro_moduli); in state-based models each end uses the modulus of its own material. */
#include "base/memory.h"
#include "scene_parts.h"

status read_body_parts(struct reader *r, const struct yaml_node *parts_node, const struct key *k,
                       struct scene_body *body)
{
    if (!parts_node) return OK;
    TRY(check_node_is_list_of_valid_length(r, k, parts_node));
    int part = body->parts; /* index after the parts from images */
    GROW("parts", body->part, body->parts + parts_node->n);
    body->parts += parts_node->n;
    for (const struct yaml_node *n = parts_node->first; n; part++, n = n->next)
        TRY(read_keys_of_group(r, n, n, "bodies.parts", &body->part[part]));
    return OK;
}

int scene_body_part_index_at_position(const struct scene *s, const struct scene_body *b, const real *X)
{
    int part = b->parts - 1;
    while (part >= 0 && !region_contains(&b->part[part].region, X, s->dim, ON_SURFACE * s->spacing)) part--;
    return part;
}

int scene_material_index_at_position(const struct scene *s, const struct scene_body *b, const real *X,
                                     int default_material)
{
    const int part = scene_body_part_index_at_position(s, b, X);
    return part < 0 ? default_material : b->part[part].material;
}

bool scene_body_can_have_material(const struct scene_body *b, int material)
{
    bool has = b->material == material || b->list.material;
    for (int k = 0; k < b->parts; k++) has |= b->part[k].material == material;
    return has;
}

const struct material *scene_find_material_by_number(const struct scene *s, int number)
{
    for (int m = 0; m < s->materials + s->unused_materials; m++)
        if (s->material_number[m] == number) return &s->material[m];
    return NULL;
}

/* Returns true if a body of the scene s can consist of material number `material`. */
static bool material_is_used(const struct scene *s, int material)
{
    bool used = false;
    for (int b = 0; b < s->bodies; b++) used |= scene_body_can_have_material(&s->body[b], material);
    return used;
}

/* Moves material number `unused` of s->material to the end of the used materials and reduces s->materials by 1, so that
 * it does not count. Renumbers the materials between in all bodies of the scene s. */
static void material_set_aside(struct scene *s, int unused)
{
    const struct material own = s->material[unused];
    const int number = s->material_number[unused];
    s->materials--, s->unused_materials++;
    for (int m = unused; m < s->materials; m++) {
        s->material[m] = s->material[m + 1], s->material_number[m] = s->material_number[m + 1];
    }
    s->material[s->materials] = own, s->material_number[s->materials] = number;
    for (int b = 0; b < s->bodies; b++) {
        struct scene_body *body = &s->body[b];
        body->material -= body->material > unused;
        for (int k = 0; k < body->parts; k++) body->part[k].material -= body->part[k].material > unused;
    }
}

void scene_exclude_unused_materials(struct scene *s)
{
    for (int m = s->materials - 1; m >= 0; m--)
        if (!material_is_used(s, m)) material_set_aside(s, m);
}
