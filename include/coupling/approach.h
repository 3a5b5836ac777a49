/* Conversion of material points that come near another body, so that they are in contact as peridynamic particles. */
#ifndef CLEAVE_APPROACH
#define CLEAVE_APPROACH

#include "data/particles.h"
#include "rigid/rigid.h"

/* Number of time steps between two searches for material points near other bodies (within APPROACH_REACH spacings).
 * Contact begins at one spacing. Faces that approach at a tenth of the wave speed come closer by a quarter of a spacing
 * in five steps, so that no contact is missed. */
enum { APPROACH_STEPS = 5 };
/* Distance from another body within which material points convert [spacings]. */
#define APPROACH_REACH 3.0

/* Finds the particles of p within `max_distance` [m] of a particle of another body or of a rigid body. Material points
 * among them get FLAG_NEAR, by which they are later converted to peridynamic particles. For peridynamic particles among
 * them the time with low stress is counted from 0 again, so that they do not become material points soon. body_count:
 * number of bodies that consist of particles; rigid: array of `rigid_body_count` rigid bodies. */
void flag_points_near_other_bodies_for_conversion(struct particles *p, int body_count, const struct rigid_body *rigid,
                                                  int rigid_body_count, real max_distance);

#endif
