/* Writes the bounding box of the bodies of a run as text for messages. */
#include "data/extent.h"

#include <stdio.h>

struct extent_text particles_extent_text(const struct particles *p)
{
    struct extent_text t;
    real low[DIM_MAX] = {0}, high[DIM_MAX] = {0};
    for (int d = 0; d < p->dim; d++) particles_coordinate_range(p, p->n, d, &low[d], &high[d]);
    snprintf(t.text, sizeof t.text, "the particles are between (%.80s) and (%.80s) m",
             position_text(low, p->dim, 4).text, position_text(high, p->dim, 4).text);
    return t;
}
