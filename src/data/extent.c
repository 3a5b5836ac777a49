/* Writes the bounding box of the bodies of a run, and their distance from the origin, as text for messages. */
#include "data/extent.h"

#include <math.h>
#include <stdio.h>

/* Distance from the origin, divided by the longest edge of the bodies, from which on it is reported [1]. */
#define FAR 100

struct extent_text particles_describe_bounding_box(const struct particles *p)
{
    struct extent_text t;
    real low[DIM_MAX] = {0}, high[DIM_MAX] = {0};
    for (int d = 0; d < p->dim; d++) particles_coordinate_range(p, p->n, d, &low[d], &high[d]);
    snprintf(t.text, sizeof t.text, "the particles are between (%.80s) and (%.80s) m",
             position_text(low, p->dim, 4).text, position_text(high, p->dim, 4).text);
    return t;
}

struct extent_text particles_warning_text_if_far_from_origin(const struct particles *p)
{
    struct extent_text t = {""};
    real middle2 = 0, low, high;
    const real size = particles_bounding_box_longest_edge(p);
    for (int d = 0; d < p->dim; d++) {
        particles_coordinate_range(p, p->n, d, &low, &high);
        middle2 += square(0.5 * (low + high));
    }
    if (sqrt(middle2) > FAR * size)
        snprintf(t.text, sizeof t.text,
                 "; the body is %.3g m from the origin, %.2g times its size, and round-off of positions grows with "
                 "this distance: move the body to the origin",
                 sqrt(middle2), sqrt(middle2) / size);
    return t;
}
