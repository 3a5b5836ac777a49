/* Estimates the collisions of bodies that a scene leads to expect, and whether the stress behind their fronts would
 * oscillate. */
#ifndef CLEAVE_SHOCK
#define CLEAVE_SHOCK

#include "scene/scene.h"

/* The collision that a scene leads to expect whose front is nearest to breaking or yielding a body. */
struct shock {
    real speed; /* closing speed from the initial velocities of the bodies [m/s] */
    real share; /* `speed` divided by the closing speed at which the front breaks or yields one of the two bodies [1]; 0
                   if this is below a tenth, or if all materials are viscous */
    const char *remedy; /* what the scene can do against oscillations behind the front; NULL if share is 0 */
};

/* Returns the most severe collision that scene s leads to expect within its duration, between two bodies or a body and
 * a rigid body: the one whose stress front is closest to breaking or yielding a body (largest `share`). The velocity of
 * a body is that of `bodies.velocity` and of `initial` at the centre of its bounding box; bodies from particle lists
 * are left out. Returns zeros if there is no collision, or if its share would be 0. */
struct shock scene_find_collision_closest_to_damage(const struct scene *s);

#endif
