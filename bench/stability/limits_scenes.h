/* What the files of failing scenes share: their names, in the order of the map. */
#ifndef CLEAVE_BENCH_LIMITS_SCENES
#define CLEAVE_BENCH_LIMITS_SCENES

#include "limits.h"

#define ROWS(array) (array), COUNT_OF(array)

/* limits_points.c */
extern const struct failing_scene failing_crossing, failing_homologous, failing_null_mode, failing_faces;
/* limits_motion.c */
extern const struct failing_scene failing_spin, failing_disc, failing_vibration, failing_million, failing_shear;
/* limits_bonds.c */
extern const struct failing_scene failing_single, failing_inversion, failing_closing;
/* limits_modes.c */
extern const struct failing_scene failing_modes, failing_softest;
/* limits_corner.c */
extern const struct failing_scene failing_corner;
/* limits_invariance.c */
extern const struct failing_scene failing_twins, failing_renumbered;
/* limits_time_step.c */
extern const struct failing_scene failing_beyond;

#endif
