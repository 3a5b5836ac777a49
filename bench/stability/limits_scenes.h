/* Failing scenes in the order of the picture, shared by the files that define them. */
#ifndef CLEAVE_BENCH_LIMITS_SCENES
#define CLEAVE_BENCH_LIMITS_SCENES

#include "limits.h"

#define ROWS(array) (array), COUNT_OF(array)

/* Defined in limits_points.c. */
extern const struct limits_scene limits_crossing, limits_homologous, limits_null_mode, limits_faces;

/* Defined in limits_motion.c. */
extern const struct limits_scene limits_spin, limits_disc, limits_vibration, limits_million, limits_shear;

/* Defined in limits_bonds.c. */
extern const struct limits_scene limits_single, limits_inversion, limits_closing;

/* Defined in limits_modes.c. */
extern const struct limits_scene limits_modes_figure, limits_softest;

/* Defined in limits_corner.c. */
extern const struct limits_scene limits_corner_figure;

/* Defined in limits_invariance.c. */
extern const struct limits_scene limits_twins, limits_renumbered;

/* Defined in limits_time_step.c. */
extern const struct limits_scene limits_beyond;

#endif
