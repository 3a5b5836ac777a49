/* Failing scenes in the order of the picture, shared by the files that define them. */
#ifndef CLEAVE_BENCH_LIMITS_SCENES
#define CLEAVE_BENCH_LIMITS_SCENES

#include "limits.h"

#define ROWS(array) (array), COUNT_OF(array)

/* Scenes in which material points fail: a uniform stretch by which points cross cells, a homologous stretch, a velocity
 * mode that the grid does not see, points on faces of cells. Defined in limits_points.c. */
extern const struct limits_scene limits_crossing, limits_homologous, limits_null_mode, limits_faces;

/* Scenes of long motions: a spinning square, a spinning disc of bonds and points, ten periods of a bar, a million steps
 * of a plate, shear at constant volume. Defined in limits_motion.c. */
extern const struct limits_scene limits_spin, limits_disc, limits_vibration, limits_million, limits_shear;

/* Scenes about bonds: a particle that comes off, compression past inversion, crack faces that close. Defined in
 * limits_bonds.c. */
extern const struct limits_scene limits_single, limits_inversion, limits_closing;

/* Scenes about eigenmodes: motions without energy that are not rigid, and the lowest frequency of a small free body.
 * Defined in limits_modes.c. */
extern const struct limits_scene limits_modes_figure, limits_softest;

/* Scene in which a wave that converts material points to bonds passes a corner of the interface between both. Defined
 * in limits_corner.c. */
extern const struct limits_scene limits_corner_figure;

/* Scenes whose results must not change: a plate that is scaled, mirrored or rotated, and one whose particles are listed
 * in another order. Defined in limits_invariance.c. */
extern const struct limits_scene limits_twins, limits_renumbered;

/* Scene with a time step above the critical one, which a run must notice and stop. Defined in limits_time_step.c. */
extern const struct limits_scene limits_beyond;

#endif
