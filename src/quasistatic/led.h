/* Crack tips that follow their stress-intensity factors (struct led). */
#ifndef CLEAVE_LED
#define CLEAVE_LED

#include <math.h>

#include "fracture/tips.h"
#include "quasistatic/statics.h"
#include "run/run.h"

/* ---- the plane of the tips (led_plane.c) ------------------------------------------------------------------------- */

/* Finds the plane in which the tips move: its axes, front and planes of symmetry; the other members are given. t: tips
 * of pre-cracks. cracks: pre-cracks. Returns NULL, or why there is no such plane. */
const char *led_plane_find(struct led_plane *plane, const struct tips *t, const struct crack_list *cracks,
                           const struct particles *p);

/* Projects the point X onto the plane [m]. */
void led_project(const struct led_plane *plane, const real *X, real to[2]);

/* Projects the reference position of particle i onto the plane [m]. */
void led_project_particle(const struct led_plane *plane, const struct particles *p, int64_t i, real to[2]);

/* Stores the trace of the pre-crack c in the plane as a segment [m]. Returns false if the crack is not perpendicular to
 * the plane. */
bool led_segment(const struct led_plane *plane, const struct crack *c, real at[2][DIM_MAX]);

/* Returns the mean width of the body along the front over a segment of the plane [m]. */
real led_width(const struct led_plane *plane, const struct particles *p, const real *from, const real *to);

/* Returns the area of a crack along a segment of the plane [m^2]. */
real led_face_area(const struct led_plane *plane, const struct particles *p, const real *from, const real *to);

/* Returns true if a segment of the plane lies on a plane of symmetry. */
bool led_on_mirror(const struct led_plane *plane, const real *from, const real *to);

/* Stores the position at the distance `way` from `place` along a unit vector [m]. */
static inline void led_ahead(const real *place, real way, const real *along, real ahead[2])
{
    for (int d = 0; d < 2; d++) ahead[d] = place[d] + way * along[d];
}

/* Returns the distance of two positions in the plane [m]. */
static inline real led_distance(const real *a, const real *b) { return hypot(a[0] - b[0], a[1] - b[1]); }

/* ---- tips (led.c) ------------------------------------------------------------------------------------------------ */

/* Returns true if the crack at a tip lies on a plane of symmetry and runs along it. */
bool led_along_mirror(const struct led_plane *plane, const struct led_tip *tip);

/* Measures the stress-intensity factors of a tip, in its frame [Pa m^(1/2)]. Returns false if too few particles are
 * near it. closed: faces of cracks press on each other, so K_I is not negative. */
bool led_measure(const struct led *l, const struct particles *p, const struct led_tip *tip, bool closed, real K[2]);

/* Stores the position at which the next increment of a tip ends [m]. */
void led_next_place(const struct led *l, const struct particles *p, const struct led_tip *tip, real place[2]);

/* Returns the energy that the next increment of a tip takes per area [J/m^2]. */
real led_toughness(const struct led *l, const struct particles *p, const struct led_tip *tip);

/* Measures the factors of a tip and sets the direction of its next increment. closed: as in led_measure. */
void led_turn(const struct led *l, const struct particles *p, bool closed, struct led_tip *tip);

/* Moves tip number `tip` by its next increment. */
void led_move(struct led *l, const struct particles *p, int tip);

/* Stores the factors of the tip that has grown most and still grows [Pa m^(1/2)]; NAN if there is none. Requires that
 * led_leads has been called. closed: as in led_measure. */
void led_factors(const struct led *l, const struct particles *p, bool closed, real K[2]);

/* Stores the reference position of the tip that has grown most, in space the middle of its front [m]; NAN if there is
 * none. */
void led_place(const struct led *l, real place[DIM_MAX]);

/* Ends all tips: bonds have broken elsewhere. */
void led_lose(struct led *l);

/* Frees the paths of the tips. */
void led_free(struct led *l);

/* ---- increments (led_cut.c) -------------------------------------------------------------------------------------- */

/* Cuts the bonds that are left across the pre-crack behind a tip. */
void led_free_behind(struct run *e, const struct led_tip *tip);

/* Finds the next increment of the tips under the present loads by trials: stores the bonds to cut and the size of loads
 * at which they are due. Returns FAILED if an equilibrium is not found. */
status led_look_ahead(struct run *e);

/* Moves the tips that take part in the increment at hand. */
void led_advance(struct led *l, const struct particles *p);

/* ---- start (led_start.c) ----------------------------------------------------------------------------------------- */

/* Finds plane and tips in the first call. Returns true if there is a tip that can grow. */
bool led_leads(struct run *e);

#endif
