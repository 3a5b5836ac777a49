/* What the parts of `cleave bench contact` share. */
#ifndef CLEAVE_CONTACT_BENCH
#define CLEAVE_CONTACT_BENCH

#include "bench/common/bench.h"

struct contact_motion { double mass, x[DIM_MAX], v[DIM_MAX], spin; };
struct contact_motion contact_motion_of(const struct engine *e, int body);

/* Two discs of `radius` spacings that fly at each other with `speed` wave speeds each, their paths `offset` radii
 * apart, on a lattice turned by `turn` [rad] against the line of centres; then: relative velocity after over before. */
struct contact_discs {
    const char *law, *model;
    double radius, speed, offset, turn, safety;
    double restitution, tangential, spin, energy, overlap;
};
status contact_discs_run(struct contact_discs *c);

#endif
