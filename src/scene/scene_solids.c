/* Reads the geometry of a scene: solids, regions and cracks, and checks that they are well formed. */
#include "scene_internal.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"

/* ---- solids ------------------------------------------------------------------------------------------------------ */

static const struct solid_word { const char *name; enum solid_kind kind; int dim; } solid_words[] = {
    {"box", SOLID_BOX, 0},           {"disc", SOLID_BALL, 2},
    {"ball", SOLID_BALL, 0},         {"cylinder", SOLID_CYLINDER, 3},
    {"half-space", SOLID_HALF_SPACE, 0}, {"all", SOLID_ALL, 0},
};

static status check_box(struct reader *r, const struct node *n, const struct solid *s)
{
    for (int d = 0; d < r->dim; d++)
        if (!(s->from[d] < s->to[d]))
            return fault(r, n, "from is not below to in %c; from is the lower corner", 'x' + d);
    return OK;
}

static status check_solid(struct reader *r, const struct node *n, const struct solid *s)
{
    if (s->kind == SOLID_BOX) return check_box(r, n, s);
    if (s->kind == SOLID_HALF_SPACE && !(dot(s->normal, s->normal, r->dim) > 0))
        return fault(r, n, "the normal has no length; it points out of the half-space");
    if (s->kind != SOLID_CYLINDER || memcmp(s->from, s->to, sizeof s->from) != 0) return OK;
    return fault(r, n, "its axis has no length; from and to are its two ends");
}

/* Reads the keys of a solid of this kind. REFUSED if the space does not have it, or for an infinite solid of a body. */
static status read_shape(struct reader *r, const struct node *n, const struct solid_word *word, struct solid *s)
{
    char group[32];
    snprintf(group, sizeof group, "solid.%s", word->name);
    s->kind = word->kind;
    if (word->dim && word->dim != r->dim)
        return fault(r, n, "not in space %s; %s is expected", space_names[r->scene->space],
                     r->dim == 1 ? "box" : r->dim == 2 ? "disc or box" : "ball, cylinder or box");
    if (r->bounded && !s->subtract && (s->kind == SOLID_ALL || s->kind == SOLID_HALF_SPACE))
        return fault(r, n, "a body cannot be infinite; box, ball and cylinder are finite");
    if (s->kind != SOLID_ALL) {
        TRY(read_group(r, n, n, group, s));
        return check_solid(r, n, s);
    }
    if (n->kind == NODE_SCALAR && strcmp(n->text, "true") == 0) return OK;
    return fault(r, n, "%s is not true; write all: true", shown(r, n));
}

/* Reads one solid, possibly inside add or subtract. `signed_before`: it is inside one already. */
static status read_solid(struct reader *r, const struct node *n, struct solid *s, bool signed_before)
{
    TRY(expect(r, n, NODE_MAP, "a solid such as box: {from: [..], to: [..]}"));
    TRY(check_keys(r, n, "solid"));
    if (n->n != 1)
        return fault(r, n, "has %d keys; a solid is one of box, disc, ball, cylinder, half-space, all", n->n);
    const struct node *child = n->first;
    for (size_t k = 0; k < COUNT_OF(solid_words); k++)
        if (strcmp(solid_words[k].name, child->key) == 0) return read_shape(r, child, &solid_words[k], s);
    if (signed_before) return fault(r, child, "stands inside add or subtract; a solid such as box is expected there");
    s->subtract = strcmp(child->key, "subtract") == 0;
    return read_solid(r, child, s, true);
}

status read_region(struct reader *r, const struct node *n, struct region *region)
{
    if (n->kind == NODE_LIST && n->n == 0) return fault(r, n, "an empty list; at least one solid is expected");
    const struct node *item = n->kind == NODE_LIST ? n->first : n;
    int count = n->kind == NODE_LIST ? n->n : 1;
    region->solid = NEW("solids", count, struct solid);
    region->n = count;
    for (int k = 0; k < count; k++, item = item->next) TRY(read_solid(r, item, &region->solid[k], false));
    if (!region->solid[0].subtract) return OK;
    return fault(r, n, "subtracts from nothing; the first solid must be added, for a region perhaps all: true");
}

/* ---- cracks ------------------------------------------------------------------------------------------------------ */

static void crack_make(struct crack *c, int n)
{
    c->corner = memory_new("cracks", n, sizeof *c->corner);
    c->n = n, c->width = 0;
}

/* n = (b - a) x (c - a) */
static void cross_at(const real *a, const real *b, const real *c, real n[DIM_MAX])
{
    for (int d = 0; d < DIM_MAX; d++) {
        int e = (d + 1) % DIM_MAX, f = (d + 2) % DIM_MAX;
        n[d] = (b[e] - a[e]) * (c[f] - a[f]) - (b[f] - a[f]) * (c[e] - a[e]);
    }
}

/* REFUSED unless every corner lies in the plane and on the inner side of every edge, to a millionth of the size. */
static status check_polygon(struct reader *r, const struct node *n, const struct crack *c)
{
    real normal[DIM_MAX] = {0}, part[DIM_MAX];
    for (int k = 1; k + 1 < c->n; k++) {
        cross_at(c->corner[0], c->corner[k], c->corner[k + 1], part);
        for (int d = 0; d < DIM_MAX; d++) normal[d] += part[d];
    }
    real twice_area = sqrt(dot(normal, normal, DIM_MAX)), size = sqrt(twice_area);
    if (!(twice_area > 0)) return fault(r, n, "has no area; a plane convex polygon is expected");
    for (int k = 0; k < c->n; k++) {
        for (int j = 0; j < c->n; j++) {
            real away[DIM_MAX];
            for (int d = 0; d < DIM_MAX; d++) away[d] = c->corner[j][d] - c->corner[0][d];
            cross_at(c->corner[k], c->corner[(k + 1) % c->n], c->corner[j], part);
            if (fabs(dot(away, normal, DIM_MAX)) > 1e-6 * size * twice_area)
                return fault(r, n, "corner %d is not in the plane of the others; a plane polygon is expected", j);
            if (dot(part, normal, DIM_MAX) < -1e-6 * square(twice_area))
                return fault(r, n, "is not convex at corner %d; give several convex polygons", k);
        }
    }
    return OK;
}

static status read_polygon(struct reader *r, const struct node *n, struct crack *c)
{
    const struct key *k = key_find("cracks", "polygon");
    struct key corner = *k;
    int at = 0;
    corner.range.given = false;
    TRY(expect_list(r, k, n));
    crack_make(c, n->n);
    for (const struct node *p = n->first; p; p = p->next) TRY(read_point(r, &corner, p, c->corner[at++]));
    return check_polygon(r, n, c);
}

/* Reads the place of a crack: a point on a line, a segment in the plane, a polygon in space. */
static status read_crack_place(struct reader *r, const struct node *n, struct crack *c)
{
    static const char *const first[] = {"at", "from", "polygon"}, *const form[] = {"at", "from and to", "polygon"};
    const char *word = first[r->dim - 1];
    TRY(expect(r, n, NODE_MAP, "a crack such as {from: [..], to: [..]}"));
    TRY(check_keys(r, n, "cracks"));
    for (const struct node *k = n->first; k; k = k->next)
        if (strcmp(k->key, word) != 0 && strcmp(k->key, "width") != 0 && (r->dim != 2 || strcmp(k->key, "to") != 0))
            return fault(r, k, "not in space %s; a crack there has %s", space_names[r->scene->space], form[r->dim - 1]);
    const struct node *a = node_find(n, word), *b = node_find(n, "to");
    if (!a) return fault_missing(r, n, key_find("cracks", word));
    if (r->dim == 2 && !b) return fault_missing(r, n, key_find("cracks", "to"));
    if (r->dim == 3) return read_polygon(r, a, c);
    crack_make(c, r->dim);
    TRY(read_point(r, key_find("cracks", word), a, c->corner[0]));
    if (r->dim == 1) return OK;
    TRY(read_point(r, key_find("cracks", "to"), b, c->corner[1]));
    if (c->corner[0][0] != c->corner[1][0] || c->corner[0][1] != c->corner[1][1]) return OK;
    return fault(r, n, "has no length; from and to are its two ends");
}

static status read_crack(struct reader *r, const struct node *n, struct crack *c)
{
    TRY(read_crack_place(r, n, c));
    const struct node *width = node_find(n, "width");
    return width ? read_key(r, key_find("cracks", "width"), width, c) : OK;
}

status read_cracks(struct reader *r, const struct node *root)
{
    struct scene *s = r->scene;
    const struct node *list = node_find(root, "cracks");
    if (!list) return OK;
    TRY(expect_list(r, key_find("", "cracks"), list));
    s->crack = NEW("cracks", list->n, struct crack);
    s->cracks = list->n;
    const struct node *n = list->first;
    for (int k = 0; k < s->cracks; k++, n = n->next) TRY(read_crack(r, n, &s->crack[k]));
    return OK;
}
