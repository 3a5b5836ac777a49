/* Estimates the memory and the time that the set-up of a run needs, before the run is set up. */
#include <stdio.h>

#include "base/memory.h"
#include "engine_internal.h"
#include "scene/fill.h"

/* Memory as measured on blocks of 10^6 particles: */
#define BYTES_PER_PARTICLE 320.0 /* [byte] fields, cells, lists, share of the grid, copy for the writer of frames */
/* [byte] implicit bonds: stencils at surfaces, and the stored bonds at cracks and ends of lines */
#define BYTES_PER_BOND_LATTICE 3.0
#define EXACT_MOST 6000.0 /* [spacings] in longer bodies positions may be rounded (fill.c), and bonds are stored */

/* Returns the fraction of the box with the corners from[dim] and to[dim] [m] that is inside the region `shape`,
 * estimated from evenly spaced sample points [1]; never 0, even if no point is inside. */
static real share_filled(const struct region *shape, const real *from, const real *to, int dim)
{
    enum { ACROSS = 24 };
    int inside = 0, all = 1;
    for (int d = 0; d < dim; d++) all *= ACROSS;
    for (int k = 0; k < all; k++) {
        real X[DIM_MAX] = {0};
        for (int d = 0, rest = k; d < dim; d++, rest /= ACROSS)
            X[d] = from[d] + (rest % ACROSS + 0.5) / ACROSS * (to[d] - from[d]);
        inside += region_contains(shape, X, dim, 0);
    }
    return real_max(inside, 1) / all;
}

/* Returns an estimate of the number of particles of the bodies of scene s that are filled with lattices; bodies from
 * files and unbounded shapes are left out. boxes: true to fill the bounding boxes of the bodies, false to fill their
 * shapes. *longest: receives the longest edge of these boxes [spacings]. */
static real particles_expected(const struct scene *s, bool boxes, real *longest)
{
    real n = 0, from[DIM_MAX], to[DIM_MAX];
    *longest = 0;
    for (int b = 0; b < s->bodies; b++) {
        if (s->body[b].file || !region_compute_bounding_box_if_finite(&s->body[b].shape, s->dim, from, to)) continue;
        real count = boxes ? 1 : share_filled(&s->body[b].shape, from, to, s->dim);
        for (int d = 0; d < s->dim; d++) {
            count *= (to[d] - from[d]) / s->spacing;
            *longest = real_max(*longest, (to[d] - from[d]) / s->spacing);
        }
        n += count;
    }
    return n;
}

/* Returns the number of particles of a run of scene s: that of p, or an estimate if they are not created yet (p->n is
 * 0). *longest: receives the longest edge of a box around a body [spacings]. */
static real particles_now(const struct scene *s, const struct particles *p, real *longest)
{
    const real expected = particles_expected(s, false, longest);
    return p->n > 0 ? (real)p->n : expected;
}

/* Returns an estimate of the memory of n particles and their bonds in scene s [byte]. source: data of bonds; longest:
 * longest edge of a box around a body [spacings]; families: true if each particle has bonds to all neighbours within
 * the horizon, false for about one bond each. */
static real memory_of(const struct scene *s, const struct bond_source *source, real n, real longest, bool families)
{
    const real bonds = families ? source->family.full / source->family.cell_volume : 1;
    bool follow = s->irregularity == 0 && !source->yield.stretch && longest < EXACT_MOST;
    for (int b = 0; b < s->bodies; b++) follow = follow && !s->body[b].file;
    return n * (BYTES_PER_PARTICLE + bonds * (follow ? BYTES_PER_BOND_LATTICE : BYTES_PER_BOND));
}

real run_estimate_peak_memory(const struct scene *s, const struct particles *p, const struct bond_source *source)
{
    real longest;
    const real n = particles_now(s, p, &longest);
    return memory_of(s, source, n, longest, s->method == METHOD_PD);
}

real run_estimate_peak_memory_if_all_peridynamic(const struct scene *s, const struct particles *p,
                                                 const struct bond_source *source)
{
    real longest;
    particles_expected(s, true, &longest);
    return memory_of(s, source, (real)p->n_body, longest, true);
}

#define BYTES_OF_BONDS 500.0      /* [byte] least memory of a particle with bonds */
#define POSITIONS_QUICK 3e7       /* number of lattice positions that are filled in some seconds */
#define SECONDS_PER_POSITION 1e-6 /* of the set-up, on one thread; measured 0.4 to 1.7 us [s] */

void run_print_notice_if_set_up_takes_long(const struct scene *s)
{
    real longest;
    if (particles_expected(s, true, &longest) < POSITIONS_QUICK) return;
    const real n = particles_expected(s, false, &longest);
    const bool refused =
        s->method == METHOD_PD && n * BYTES_OF_BONDS > (real)machine_memory_size(); /* at once, in a line */
    if (n < POSITIONS_QUICK || refused) return;
    fprintf(stderr,
            "particles.spacing %.3g m: the bodies have about %.2g lattice positions, %.2g along the longest edge, so "
            "the set-up takes about %.1g min; a larger spacing shortens it\n",
            s->spacing, n, longest, n * SECONDS_PER_POSITION / 60);
}

status run_check_memory_suffices(const struct scene *s, const struct particles *p,
                                 const struct bond_source *bond_source)
{
    const real memory = (real)machine_memory_size(), bytes = run_estimate_peak_memory(s, p, bond_source);
    real longest;
    if (memory <= 0 || bytes <= memory) return OK;
    return status_set(REFUSED,
                      "particles.spacing: about %.2g particles would need %.2g GB of memory, but %.2g GB are available "
                      "(%s); use a larger spacing",
                      particles_now(s, p, &longest), bytes * 1e-9, memory * 1e-9,
                      machine_memory_limit_describe_source());
}
