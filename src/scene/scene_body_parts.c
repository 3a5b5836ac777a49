/* Reads parts of a body that consist of another material. Bonds between parts act as springs in series (bonds/bonds.c:
 * material_pair_table_make); in state-based models each end uses the modulus of its own material. */
#include "base/memory.h"
#include "scene_parts.h"

status read_body_parts(struct reader *r, const struct yaml_node *list, const struct key *k, struct scene_body *b)
{
    if (!list) return OK;
    TRY(expect_list(r, k, list));
    int part = b->parts; /* index after the parts from images */
    GROW("parts", b->part, b->parts + list->n);
    b->parts += list->n;
    for (const struct yaml_node *n = list->first; n; part++, n = n->next)
        TRY(read_keys_of_group(r, n, n, "bodies.parts", &b->part[part]));
    return OK;
}

int scene_material_at(const struct scene *s, const struct scene_body *b, const real *X, int default_material)
{
    for (int k = b->parts - 1; k >= 0; k--)
        if (region_contains(&b->part[k].region, X, s->dim, ON_SURFACE * s->spacing)) return b->part[k].material;
    return default_material;
}

bool scene_body_has_material(const struct scene_body *b, int material)
{
    bool has = b->material == material || b->list.material;
    for (int k = 0; k < b->parts; k++) has |= b->part[k].material == material;
    return has;
}
