/* The smallest pre-crack against the horizon, in plane bodies whose bonds soften, as `cleave check` prints it. */
#include <math.h>
#include <stdio.h>

#include "check_parts.h"

#define HORIZONS_LEAST                                                                                                 \
    3 /* length of a pre-crack below which its load depends on the horizon; by the separate program */

void print_precracks(const struct run *e)
{
    const struct scene *s = e->scene;
    real least = INFINITY;
    for (int k = 0; k < s->cracks && e->bonds.soft.curve && s->dim == 2; k++) {
        real length = 0;
        for (int c = 0; c + 1 < s->crack[k].n; c++) {
            const real *from = s->crack[k].corner[c], *to = s->crack[k].corner[c + 1];
            length += crack_share_within(s, from, to) * hypot(to[0] - from[0], to[1] - from[1]);
        }
        least = real_min(least, length);
    }
    if (!isfinite(least)) return;
    printf("pre-cracks     the smallest is %.3g m long, %.2g horizons%s\n", least, least / e->source.family.horizon,
           least < HORIZONS_LEAST * e->source.family.horizon ? "; below 3 its load depends on the horizon" : "");
}
