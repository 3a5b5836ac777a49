/* What the files of failing scenes share: their names, in the order of the map. */
#ifndef CLEAVE_BENCH_LIMITS_SCENES
#define CLEAVE_BENCH_LIMITS_SCENES

#include "limits.h"

#define ROWS(array) (array), COUNT_OF(array)

/* limits_points.c */
extern const struct limits_scene limits_crossing, limits_homologous, limits_null_mode, limits_faces;
/* limits_motion.c */
extern const struct limits_scene limits_spin, limits_disc, limits_vibration, limits_million, limits_shear;
/* limits_bonds.c */
extern const struct limits_scene limits_single, limits_inversion, limits_closing;
/* limits_modes.c */
extern const struct limits_scene limits_modes_figure, limits_softest;
/* limits_corner.c */
extern const struct limits_scene limits_corner_figure;
/* limits_invariance.c */
extern const struct limits_scene limits_twins, limits_renumbered;
/* limits_time_step.c */
extern const struct limits_scene limits_beyond;

#endif
