/* floor 5: what the files of failing scenes share: their names, in the order of the map. */
#ifndef CLEAVE_FAILING_SCENES_H
#define CLEAVE_FAILING_SCENES_H

#include "failing.h"

#define ROWS(array) (array), COUNT_OF(array)

/* failing_points.c */
extern const struct failing_scene failing_crossing, failing_homologous, failing_null_mode, failing_faces;
/* failing_motion.c */
extern const struct failing_scene failing_spin, failing_disc, failing_vibration, failing_million, failing_shear;
/* failing_bonds.c */
extern const struct failing_scene failing_single, failing_inversion, failing_closing;
/* failing_modes.c */
extern const struct failing_scene failing_modes, failing_softest;
/* failing_corner.c */
extern const struct failing_scene failing_corner;
/* failing_twins.c */
extern const struct failing_scene failing_twins, failing_renumbered;
/* failing_beyond.c */
extern const struct failing_scene failing_beyond;

#endif
