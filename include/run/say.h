/* Warns of materials that yield. */
#ifndef CLEAVE_SAY
#define CLEAVE_SAY

#include "base/warnings.h"
#include "scene/scene.h"

/* Warns how bonds of materials that yield differ from von Mises' law. */
void warn_of_yielding(const struct scene *s, struct warnings *to);

#endif
