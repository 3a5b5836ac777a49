/* `method: auto`: writes the choice into the tree of the scene as if the user had given it. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "auto.h"
#include "src/scene/scene_internal.h"

/* ---- keys -------------------------------------------------------------------------------------------------------- */

/* Sets a key that the user has not given, or given as auto or static. */
static status lay(struct reader *r, struct node *root, const char *key, const char *value)
{
    const struct node *n = tree_at(root, key);
    if (n && strcmp(n->text, "auto") != 0 && strcmp(n->text, "static") != 0) return OK;
    return tree_set(r, root, key, value);
}

static status lay_number(struct reader *r, struct node *root, const char *key, real value)
{
    char text[32];
    return lay(r, root, key, number_text(text, value));
}

/* Sets the keys key=value;.. of a point of the table, and the frame it was measured in. */
static status lay_keys(struct reader *r, struct node *root, const struct cost_point *p)
{
    for (const char *at = p->keys; *at; at += strcspn(at, ";"), at += *at == ';') {
        char key[TABLE_KEYS], *value;
        snprintf(key, sizeof key, "%.*s", (int)strcspn(at, ";"), at);
        value = strchr(key, '=');
        if (!value) return status_set(REFUSED, "accuracy_table: %s is no key=value", key);
        *value++ = '\0';
        TRY(lay(r, root, key, value));
    }
    if (cost_point_has(p, "method", "pd") || strstr(p->keys, "mpm.frame=")) return OK;
    return lay(r, root, "mpm.frame", "current");         /* tables without a frame were measured in it */
}

/* Loads for the reference frame, which has no static solver: they grow as sin^2, to their full size at the end. */
static status lay_slow_loads(struct reader *r, struct node *root, const struct auto_match *m, const struct scene *s)
{
    char key[64], value[96], number[32];
    real longest = 0;
    for (int d = 0; d < s->dim; d++) longest = real_max(longest, auto_extent(s, 0, d));
    const real duration = m->kind->slow * longest / s->material[0].wave_speed;
    TRY(tree_set(r, root, "duration", number_text(number, duration)));
    for (int k = 0; k < s->boundaries; k++) {
        if (s->boundary[k].kind != BOUNDARY_TRACTION) continue;
        snprintf(key, sizeof key, "boundary[%d].time", k);
        snprintf(value, sizeof value, "{pulse: {until: %s}}", number_text(number, 2 * duration));
        TRY(tree_set(r, root, key, value));
    }
    return OK;
}

/* ---- cracks ------------------------------------------------------------------------------------------------------ */

/* The end of an edge crack inside the body, and the direction that the crack has there. */
static int tip_of(const struct crack *c, const struct solid *box, real direction[2])
{
    bool inside[2] = {true, true};
    for (int end = 0; end < 2; end++)
        for (int d = 0; d < 2; d++) inside[end] &= c->corner[end][d] > box->from[d] && c->corner[end][d] < box->to[d];
    const int tip = inside[1];
    for (int d = 0; d < 2; d++) {
        const real way = c->corner[tip][d] - c->corner[!tip][d];
        direction[d] = way > 0 ? 1 : way < 0 ? -1 : 0;
    }
    return tip;
}

static void auto_lay_put_point(FILE *to, const char *name, const real *X)
{
    char number[2][32];
    fprintf(to, "%s: [%s, %s]", name, number_text(number[0], X[0]), number_text(number[1], X[1]));
}

/* Replaces the crack by a gap of the body, since material points have one velocity field: one cell wide, a spacing to
 * either side, its faces on nodes, as in the runs of the table. h: spacing [m]. */
static status lay_gap(struct reader *r, struct node *root, const struct scene *s, real h)
{
    const struct solid *box = &s->body[0].shape.solid[0];
    const struct crack *c = &s->crack[0];
    char text[512] = "";
    real direction[2], from[2], to[2], origin[2] = {box->from[0], box->from[1]};
    tip_of(c, box, direction);
    const int across = direction[0] != 0;
    for (int d = 0; d < 2; d++) {
        from[d] = real_min(c->corner[0][d], c->corner[1][d]);
        to[d] = real_max(c->corner[0][d], c->corner[1][d]);
    }
    from[across] -= h, to[across] += h, origin[across] = from[across];
    FILE *out = fmemopen(text, sizeof text, "w");
    if (!out) return status_set(FAILED, "method auto: out of memory");
    auto_lay_put_point(out, "[{box: {from", box->from);
    auto_lay_put_point(out, ", to", box->to);
    auto_lay_put_point(out, "}}, {subtract: {box: {from", from);
    auto_lay_put_point(out, ", to", to);
    fputs("}}}]", out);
    fclose(out);
    TRY(tree_set(r, root, tree_at(root, "body") ? "body" : "bodies[0].shape", text));
    TRY(tree_set(r, root, "cracks", ""));
    snprintf(text, sizeof text, "[%.17g, %.17g]", origin[0], origin[1]);
    return lay(r, root, "mpm.origin", text);
}

/* Sets tip and direction of sif probe number `probe` to the end of the gap. */
static status lay_tip(struct reader *r, struct node *root, int probe, const struct crack *c, const struct solid *box)
{
    char key[64], text[96];
    real direction[2];
    const int tip = tip_of(c, box, direction);
    snprintf(key, sizeof key, "probes[%d].sif.at", probe);
    snprintf(text, sizeof text, "[%.17g, %.17g]", c->corner[tip][0], c->corner[tip][1]);
    TRY(tree_set(r, root, key, text));
    snprintf(key, sizeof key, "probes[%d].sif.direction", probe);
    snprintf(text, sizeof text, "[%g, %g]", direction[0], direction[1]);
    return tree_set(r, root, key, text);
}

/* Gives sif probes without radii the rings of the runs of the table, for which its accuracy holds. `gap`: the crack
 * that became a gap, whose tip probes do not find by themselves; NULL: none. */
static status lay_rings(struct reader *r, struct node *root, const struct auto_match *m, const struct crack *gap,
                        const struct solid *box)
{
    const struct node *list = tree_at(root, "probes"), *n = list && list->kind == NODE_LIST ? list->first : NULL;
    char key[64], ring[64], number[32];
    snprintf(ring, sizeof ring, "[%s]", number_text(number, m->kind->ring * m->feature));
    for (int k = 0; n && m->kind->ring > 0; n = n->next, k++) {
        const struct node *sif = n->kind == NODE_MAP ? node_find(n, "sif") : NULL;
        const bool bare = n->kind == NODE_SCALAR && strcmp(n->text, "sif") == 0;
        if (!bare && !sif) continue;
        snprintf(key, sizeof key, "probes[%d]", k);
        if (bare) TRY(tree_set(r, root, key, "{sif: {}}"));
        snprintf(key, sizeof key, "probes[%d].sif.contours", k);
        if (bare || (!node_find(sif, "outer") && !node_find(sif, "contours"))) TRY(tree_set(r, root, key, ring));
        if (gap) TRY(lay_tip(r, root, k, gap, box));
    }
    return OK;
}

/* ---- all --------------------------------------------------------------------------------------------------------- */

status auto_lay(struct reader *r, struct node *root, const struct auto_match *m, const struct scene *s,
                const struct cost_point *p, real spacing)
{
    static const char *const done[] = {"accuracy", "accuracy_table"};
    for (size_t k = 0; k < COUNT_OF(done); k++)
        if (tree_at(root, done[k])) TRY(tree_set(r, root, done[k], ""));
    TRY(lay_keys(r, root, p));
    TRY(lay_number(r, root, "particles.spacing", spacing));
    if (p->horizon > 0) TRY(lay_number(r, root, "particles.horizon", p->horizon));
    TRY(lay_number(r, root, "time.safety", p->step));
    const bool gap = m->needs_bonds && cost_point_has(p, "method", "mpm");
    if (gap) TRY(lay_gap(r, root, s, spacing));
    TRY(lay_rings(r, root, m, gap ? &s->crack[0] : NULL, &s->body[0].shape.solid[0]));
    return m->at_rest && cost_point_has(p, "solver", "explicit") ? lay_slow_loads(r, root, m, s) : OK;
}

