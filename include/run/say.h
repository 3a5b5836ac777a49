/* Warnings of materials that yield. */
#ifndef CLEAVE_SAY
#define CLEAVE_SAY

#include "base/warnings.h"
#include "scene/scene.h"

/* Adds warnings to `warning_list` for the materials of scene s whose bonds yield: how their plasticity differs from von
 * Mises plasticity. */
void warn_that_bond_plasticity_is_not_von_mises(const struct scene *s, struct warnings *warning_list);

#endif
