/* Warnings of materials that yield. */
#ifndef CLEAVE_SAY
#define CLEAVE_SAY

#include "base/warnings.h"
#include "scene/scene.h"

/* Warns how yielding bonds of the materials of s differ from von Mises plasticity. */
void warn_of_yielding(const struct scene *s, struct warnings *to);

#endif
