/* Refusals of what the method or model of a scene cannot do. Each names a change with which the scene passes. */
#ifndef CLEAVE_SCENE_REMEDIES
#define CLEAVE_SCENE_REMEDIES

#include "scene_internal.h"

/* Returns true if a material of the scene gives this key. root: tree of the scene. */
bool scene_material_gives(const struct yaml_node *root, const char *key);

/* Returns REFUSED for a Poisson's ratio that bonds do not have. n: the ratio; its material has been read. */
status refuse_poisson(struct reader *r, const struct yaml_node *n);

/* Returns REFUSED for a material that yields with a state-based model. n: what says that it yields. */
status refuse_state_yield(struct reader *r, const struct yaml_node *n);

/* Returns REFUSED for a law of plasticity with a method other than mpm. n: node of the law. */
status refuse_flow_law(struct reader *r, const struct yaml_node *n);

/* Returns REFUSED for bonds that soften with a method or model that has none. n: the tensile strength. */
status refuse_softening(struct reader *r, const struct yaml_node *n);

/* Returns REFUSED for rigid bodies with method mpm or one static equilibrium. n: list of bodies. */
status refuse_rigid(struct reader *r, const struct yaml_node *n);

/* Returns REFUSED for interfaces with method adaptive. n: list of interfaces. */
status refuse_interfaces(struct reader *r, const struct yaml_node *n);

/* Returns the end of a refusal that advises to check units, if a strength needs a horizon [m] that is less than a
 * thousandth of that of the scene; else "". */
const char *strength_unit_hint(const struct scene *s, real horizon);

#endif
