/* The key `accuracy` of method auto: a share, or a figure with its share and the time to find out. */
#include <stdio.h>
#include <string.h>

#include "auto.h"
#include "auto/scene_read.h"
#include "src/scene/scene_internal.h"

#define WITHIN_USUAL 0.01
#define BUDGET_USUAL 300.0 /* [s] */

/* Names joined by points, as summary.json has them. */
static status figure_read(struct reader *r, const struct node *of, char *figure, size_t room)
{
    if (of->kind != NODE_SCALAR || !*of->text || strlen(of->text) >= room || strpbrk(of->text, " ,/"))
        return fault(r, of, "%s is no figure of summary.json; its names are joined by points, as in crack.start_time",
                     shown(r, of));
    snprintf(figure, room, "%s", of->text);
    return OK;
}

status auto_accuracy_read(struct reader *r, const struct node *root, struct pilot_wish *w)
{
    const struct node *n = tree_at(root, "accuracy");
    w->within = WITHIN_USUAL, w->budget = BUDGET_USUAL, w->figure[0] = '\0';
    if (!n) return OK;
    if (n->kind != NODE_MAP) return read_number(r, key_find("accuracy", "within"), n, &w->within);
    TRY(check_keys(r, n, "accuracy"));
    const struct node *of = node_find(n, "of"), *within = node_find(n, "within"), *budget = node_find(n, "budget");
    if (of) TRY(figure_read(r, of, w->figure, sizeof w->figure));
    if (within) TRY(read_number(r, key_find("accuracy", "within"), within, &w->within));
    return budget ? read_number(r, key_find("accuracy", "budget"), budget, &w->budget) : OK;
}
