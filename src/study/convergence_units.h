/* Declares the units in which a convergence study prints and draws its particle spacings and results. */
#ifndef CLEAVE_CONVERGENCE_UNITS
#define CLEAVE_CONVERGENCE_UNITS

#include "plot/plot.h"
#include "study/convergence_study.h"

/* Returns the unit in which particle spacings up to `coarsest_spacing` [m] are printed and drawn, the one that suits a
 * length of 10 `coarsest_spacing`. */
struct unit unit_choose_for_particle_spacings(double coarsest_spacing);

/* Returns the unit in which the spacings of the study s are printed and drawn (unit_choose_for_particle_spacings). */
struct unit convergence_study_choose_spacing_unit(const struct convergence_study *s);

/* Returns the unit in which the means and errors of the scalar result f are printed and drawn. */
struct unit scalar_result_study_choose_unit(const struct scalar_result_study *f);

#endif
