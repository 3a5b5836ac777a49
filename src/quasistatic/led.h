/* SIF-driven cracks: the direction of growth of their tips follows from the stress-intensity factors (struct
 * sif_cracks). Positions are reference positions in the plane of the tips (struct sif_plane). */
#ifndef CLEAVE_LED
#define CLEAVE_LED

#include <math.h>

#include "fracture/tips.h"
#include "quasistatic/statics.h"
#include "run/run.h"

/* ---- the plane of the tips (led_plane.c) ------------------------------------------------------------------------- */

/* Finds the plane in which the tips of pre-cracks move. The caller has set the members dim, spacing, section and
 * body_mirrors of *plane; the function sets its axes, front, middle and mirrors. t: tips of the pre-cracks. cracks: the
 * pre-cracks. Returns NULL, or the reason why there is no such plane (a static text). */
const char *sif_plane_find(struct sif_plane *plane, const struct tips *t, const struct crack_list *cracks,
                           const struct particles *p);

/* Projects the point X[dim] onto the plane [m]. */
void sif_plane_project(const struct sif_plane *plane, const real *X, real to[2]);

/* Projects the reference position of particle i onto the plane [m]. */
void sif_plane_project_particle(const struct sif_plane *plane, const struct particles *p, int64_t i, real to[2]);

/* Stores the intersection of the pre-crack c and the plane, a segment from at[0] to at[1] [m]. Returns false if the
 * pre-crack is not perpendicular to the plane. */
bool sif_plane_segment(const struct sif_plane *plane, const struct crack *c, real at[2][DIM_MAX]);

/* Returns the mean width of the body along the front, over the segment from..to of the plane [m]. For a plane body that
 * is its thickness. */
real sif_plane_width(const struct sif_plane *plane, const struct particles *p, const real *from, const real *to);

/* Returns the area of a crack face whose intersection with the plane is the segment from..to [m^2], halved if it lies
 * on a plane of symmetry. */
real sif_plane_crack_area(const struct sif_plane *plane, const struct particles *p, const real *from, const real *to);

/* Returns true if the segment from..to of the plane lies on a plane of symmetry. */
bool sif_plane_on_mirror(const struct sif_plane *plane, const real *from, const real *to);

/* Computes the point ahead = from + distance * along. from: point of the plane of the tips [m]; along: unit vector in
 * the plane; distance and result in [m]. */
static inline void sif_point_ahead(const real *from, real distance, const real *along, real ahead[2])
{
    for (int d = 0; d < 2; d++) ahead[d] = from[d] + distance * along[d];
}

/* Returns the distance of two points of the plane [m]. */
static inline real sif_distance(const real *a, const real *b) { return hypot(a[0] - b[0], a[1] - b[1]); }

/* ---- tips (led.c) ------------------------------------------------------------------------------------------------ */

/* Returns true if the last segment of the crack before the tip lies on a plane of symmetry. */
bool sif_tip_along_mirror(const struct sif_plane *plane, const struct sif_crack_tip *tip);

/* Computes the stress-intensity factors K_I and K_II of a tip in its frame `along` by a fit of crack-tip fields to the
 * displacements around it (tip_fit) [Pa m^(1/2)]. closed: crack faces are in contact (statics_faces_closed); K_I is
 * then at least 0. Returns false if too few particles are near the tip. */
bool sif_tip_measure(const struct sif_cracks *l, const struct particles *p, const struct sif_crack_tip *tip,
                     bool closed, real K[2]);

/* Stores the position at which the next increment of a tip ends: 2 spacings ahead or as far as steps.energy suffices,
 * at most up to another crack [m]. */
void sif_tip_next_position(const struct sif_cracks *l, const struct particles *p, const struct sif_crack_tip *tip,
                           real position[2]);

/* Returns the crack energy per area of the material at a tip [J/m^2] (toughness_of). */
real sif_tip_toughness(const struct sif_cracks *l, const struct particles *p, const struct sif_crack_tip *tip);

/* Computes the stress-intensity factors of a tip and sets `heading`, the direction of its next increment, by the
 * criterion of maximum hoop stress (Erdogan & Sih 1963). The direction stays constant while `straight` is positive or
 * too few particles are near the tip. closed: crack faces are in contact. */
void sif_tip_turn(const struct sif_cracks *l, const struct particles *p, bool closed, struct sif_crack_tip *tip);

/* Moves tip number `tip` by its next increment, appends the segment to the path, and ends the tip if it has reached a
 * surface or another crack. */
void sif_tip_move(struct sif_cracks *l, const struct particles *p, int tip);

/* Stores the stress-intensity factors of the tip with the largest growth among the tips that have not ended [Pa
 * m^(1/2)]; NAN if all have. closed: crack faces are in contact. Call sif_cracks_start before. */
void sif_leading_factors(const struct sif_cracks *l, const struct particles *p, bool closed, real K[2]);

/* Stores the reference position of the tip with the largest growth, for a front in space the position of its middle
 * [m]; NAN if there is no tip. */
void sif_leading_position(const struct sif_cracks *l, real position[DIM_MAX]);

/* Marks all tips as ended: bonds have broken away from the tips, and their paths no longer describe the cracks. */
void sif_tips_end(struct sif_cracks *l);

/* Frees the path and clears *l. */
void sif_cracks_free(struct sif_cracks *l);

/* ---- increments (led_cut.c) -------------------------------------------------------------------------------------- */

/* Breaks the intact bonds that cross the pre-crack behind a tip, without cost of energy. Needed after a tip has been
 * moved off a row of particles (led_start.c). */
void sif_tip_cut_behind(struct run *e, const struct sif_crack_tip *tip);

/* Determines the next crack increment under the present loads from trial equilibria with the bonds of each tip broken:
 * stores the bonds to break (statics.next), the energies, and the load size at which the increment is due. Returns
 * FAILED if an equilibrium is not found. */
status sif_increment_find(struct run *e);

/* Moves the tips that take part in the present crack increment (`selected`). */
void sif_tips_advance(struct sif_cracks *l, const struct particles *p);

/* ---- start (led_start.c) ----------------------------------------------------------------------------------------- */

/* Finds the plane and the tips of the pre-cracks if that has not been done. Returns true if a tip can grow. */
bool sif_cracks_start(struct run *e);

#endif
