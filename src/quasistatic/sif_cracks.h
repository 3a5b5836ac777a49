/* SIF-driven cracks: the direction of growth of their tips follows from the stress-intensity factors (struct
 * sif_cracks). Positions are reference positions in the plane of the tips (struct crack_tip_plane). */
#ifndef CLEAVE_SIF_CRACKS
#define CLEAVE_SIF_CRACKS

#include <math.h>

#include "fracture/tips.h"
#include "quasistatic/sif_tips.h"
#include "run/run.h"

/* ---- the plane of the tips (sif_plane.c) ------------------------------------------------------------------------- */

/* Finds the plane in which the tips of the pre-cracks move, and stores its axes, the direction and middle of the crack
 * fronts and its planes of symmetry in *plane. The caller has set the members dim, spacing, section, body_mirrors and
 * body_mirror of *plane. tips: tips of the pre-cracks; precracks: the pre-cracks; p: particles. Returns NULL, or the
 * reason why there is no such plane (a static text). */
const char *crack_tip_plane_find_or_return_reason(struct crack_tip_plane *plane, const struct crack_tips *tips,
                                                  const struct crack_list *precracks, const struct particles *p);

/* Projects the point `point`, dim components [m], onto `plane`, the plane in which crack tips move, and stores the two
 * coordinates in this plane in projection[2] [m]. */
void crack_tip_plane_project_point(const struct crack_tip_plane *plane, const real *point, real projection[2]);

/* Projects the reference position of particle number `particle` of p onto `plane`, the plane in which crack tips move,
 * and stores the two coordinates in this plane in projection[2] [m]. */
void crack_tip_plane_project_particle(const struct crack_tip_plane *plane, const struct particles *p, int64_t particle,
                                      real projection[2]);

/* Computes the straight segment in which the pre-crack `precrack` intersects `plane`, the plane in which crack tips
 * move, and stores the ends of the segment in segment_end[0] and segment_end[1], as coordinates in the plane [m].
 * Returns true, or false if the pre-crack is not parallel to the crack fronts, i.e. not perpendicular to the plane. */
bool crack_tip_plane_intersect_crack(const struct crack_tip_plane *plane, const struct crack *precrack,
                                     real segment_end[2][DIM_MAX]);

/* Returns the width [m] of the body p along the crack front, averaged over the segment between the points
 * `segment_start` and `segment_end` of `plane`, the plane in which crack tips move, two coordinates each [m]. For a
 * plane body the width is its thickness. */
real crack_tip_plane_body_width_along_front(const struct crack_tip_plane *plane, const struct particles *p,
                                            const real *segment_start, const real *segment_end);

/* Returns the area of the crack face that intersects `plane`, the plane in which crack tips move, in the segment
 * between the points `segment_start` and `segment_end`, two coordinates each [m]: length times width of the body p
 * along the front [m^2]. The area is halved if the segment lies on a plane of symmetry. */
real crack_tip_plane_crack_area(const struct crack_tip_plane *plane, const struct particles *p,
                                const real *segment_start, const real *segment_end);

/* Returns true if the segment between the points `segment_start` and `segment_end` of `plane` (the plane in which crack
 * tips move), two coordinates each [m], lies on a plane of symmetry: if both points are within 1e-3 particle spacings
 * of one of the planes plane->mirror. */
bool crack_tip_plane_segment_is_on_symmetry_plane(const struct crack_tip_plane *plane, const real *segment_start,
                                                  const real *segment_end);

/* Computes the point ahead = start + distance * direction. start: point of the plane in which crack tips move [m];
 * direction: unit vector in the plane; distance and result in [m]. */
static inline void crack_tip_plane_compute_point_ahead(const real *start, real distance, const real *direction,
                                                       real ahead[2])
{
    for (int d = 0; d < 2; d++) ahead[d] = start[d] + distance * direction[d];
}

/* Returns the distance [m] between the points `point` and `other_point` of the plane in which crack tips move, two
 * coordinates each [m]. */
static inline real crack_tip_plane_point_distance(const real *point, const real *other_point)
{
    return hypot(point[0] - other_point[0], point[1] - other_point[1]);
}

/* ---- tips (sif_cracks.c) ----------------------------------------------------------------------------------------- */

/* Returns true if the straight segment of the crack path that ends at the tip `tip` lies on a plane of symmetry, so
 * that only half of its crack area belongs to the modelled body. This is tested for the tip and the point one particle
 * spacing ahead of it on the line of the segment: both must be within 1e-3 spacings of one plane in plane->mirror.
 * plane: the plane in which crack tips move, with its particle spacing and the planes of symmetry. */
bool sif_tip_path_end_is_on_symmetry_plane(const struct crack_tip_plane *plane, const struct sif_crack_tip *tip);

/* Computes the stress-intensity factors K_I and K_II of a crack tip and stores them in K[] [Pa m^(1/2)]. They follow
 * from a fit of crack-tip fields to the displacements around the tip (fracture/tip_fit.h), in coordinates whose x axis
 * is tip->along. faces_in_contact: crack faces are in contact (crack_faces_are_in_contact), which makes K_I at least 0;
 * cracks: data common to all tips; p: particles. Returns false if too few particles are near the tip. */
bool sif_tip_compute_intensity_factors(const struct sif_cracks *cracks, const struct particles *p,
                                       const struct sif_crack_tip *tip, bool faces_in_contact, real K[2]);

/* Computes the end of the next increment of a crack tip and stores its two coordinates in the plane of the tips in
 * position[2] [m]. The increment has the direction tip->heading. Its length is 2 particle spacings or, if the key
 * steps.energy is set, that for which this energy suffices; the increment ends where it intersects another crack. l:
 * all tips; p: particles. */
void sif_tip_compute_end_of_next_increment(const struct sif_cracks *l, const struct particles *p,
                                           const struct sif_crack_tip *tip, real position[2]);

/* Returns the crack energy per area [J/m^2] of the material at the tip `tip` (toughness_of_material). cracks: data
 * common to all tips; p: particles. */
real sif_tip_toughness(const struct sif_cracks *cracks, const struct particles *p, const struct sif_crack_tip *tip);

/* Computes the stress-intensity factors of a tip from the displacements of the particles p and sets tip->heading, the
 * direction of its next increment, by the criterion of maximum hoop stress (Erdogan & Sih 1963). The direction remains
 * unchanged while tip->straight (length [m] that the tip still grows straight after a kink) is positive, or if too few
 * particles are near the tip. faces_in_contact: crack faces are in contact; cracks: data common to all tips. */
void sif_tip_compute_growth_direction(const struct sif_cracks *cracks, const struct particles *p, bool faces_in_contact,
                                      struct sif_crack_tip *tip);

/* Moves tip number `tip` of `cracks` to the end of its next increment, appends the segment to the path of the cracks,
 * and sets `ended` of the tip if it has reached a surface of the body p or another crack. */
void sif_tip_move_to_end_of_increment(struct sif_cracks *cracks, const struct particles *p, int tip);

/* Computes the stress-intensity factors of the tip of `cracks` that has grown most among those that can still grow,
 * from the particles p, and stores them in K[] [Pa m^(1/2)]; NAN if no tip can grow. faces_in_contact: crack faces are
 * in contact. Call sif_cracks_find_tips_and_test_if_any_can_grow before. */
void sif_leading_tip_compute_intensity_factors(const struct sif_cracks *cracks, const struct particles *p,
                                               bool faces_in_contact, real K[2]);

/* Stores the reference position of the tip of `cracks` that has grown most in position[], dim components [m]; in three
 * dimensions the position of the middle of the crack front. Stores NAN if there is no tip. */
void sif_leading_tip_compute_position(const struct sif_cracks *cracks, real position[DIM_MAX]);

/* Sets `ended` of all tips of `cracks`, so that none grows any more. Call this function if bonds have broken away from
 * the tips, since the tips then no longer describe the cracks. */
void sif_tips_stop_all(struct sif_cracks *cracks);

/* Frees the stored path of the cracks and sets *cracks to zero. */
void sif_cracks_free(struct sif_cracks *cracks);

/* ---- increments (sif_cut.c) -------------------------------------------------------------------------------------- */

/* Breaks the intact bonds of the run that cross the last part of the pre-crack behind the tip `tip`; they add no
 * fracture energy. Needed after the tip has been moved off a row of particles, where round-off would decide which bonds
 * it cuts (sif_start.c). */
void sif_tip_break_bonds_across_precrack_behind(struct run *run, const struct sif_crack_tip *tip);

/* Determines the next crack increment of the SIF-driven cracks (growth direction from stress-intensity factors) of the
 * run under the present loads. For each tip that can grow, a trial equilibrium (discarded afterwards) with the bonds of
 * its increment broken gives the energy that is released. Stores in run->statics the bonds to break (`next`), the
 * energies (`ahead`), and the load size (`due`, a measure proportional to the loads) at which the increment releases as
 * much energy as it costs. Returns FAILED if an equilibrium is not found. */
status sif_cracks_find_increment_by_trial_equilibria(struct run *run);

/* Moves all tips of `cracks` that take part in the present crack increment (member `selected` of struct sif_crack_tip)
 * to the ends of their increments, and clears `selected`. p: particles, by which ends at surfaces are recognised. */
void sif_tips_move_those_in_crack_increment(struct sif_cracks *cracks, const struct particles *p);

/* ---- start (sif_start.c) ----------------------------------------------------------------------------------------- */

/* Finds, on the first call only, the tips of the pre-cracks of the run and the plane in which they move. Returns true
 * if at least one tip can grow. Returns false if no tip can grow, or if the cracks of the input file are not SIF-driven
 * (growth direction from stress-intensity factors); in the latter case run->statics->sif.fault is the reason. */
bool sif_cracks_find_tips_and_test_if_any_can_grow(struct run *run);

#endif
