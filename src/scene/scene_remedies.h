/* Declares functions that refuse an input file because its method or model does not support a setting. Each message
 * names a change with which the input file is accepted. */
#ifndef CLEAVE_SCENE_REMEDIES
#define CLEAVE_SCENE_REMEDIES

#include "scene_internal.h"

/* Returns true if at least one material of the input file has the key `key`. root: tree of the input file. */
bool scene_has_material_with_key(const struct yaml_node *root, const char *key);

/* Returns REFUSED with the message that bond-based peridynamics cannot have the Poisson's ratio given by the node
 * `poisson_node`, and how the input file can be changed to have it. The material must have been read before. r: reader
 * of the input file. */
status refuse_bond_based_poisson_ratio(struct reader *r, const struct yaml_node *poisson_node);

/* Returns REFUSED with the message that materials cannot yield with a state-based model, and how the input file can be
 * changed. yield_node: node that makes the material yield. r: reader of the input file. */
status refuse_yield_with_state_model(struct reader *r, const struct yaml_node *yield_node);

/* Returns REFUSED with the message that the plastic law at the node `law_node` requires the method mpm, and how the
 * input file can be changed. r: reader of the input file. */
status refuse_flow_law_without_mpm(struct reader *r, const struct yaml_node *law_node);

/* Returns REFUSED with the message that bonds cannot soften with the method or model of the input file, and how the
 * input file can be changed. strength_node: node of the tensile strength. r: reader of the input file. */
status refuse_unsupported_softening(struct reader *r, const struct yaml_node *strength_node);

/* Returns REFUSED with the message that the method mpm, or the solver of a single static equilibrium, allows no rigid
 * bodies, and how the input file can be changed. bodies_node: node of the list of bodies. r: reader of the input file.
 */
status refuse_unsupported_rigid_bodies(struct reader *r, const struct yaml_node *bodies_node);

/* Returns REFUSED with the message that the method adaptive allows no interfaces, and how the input file can be
 * changed. interfaces_node: node of the list of interfaces. r: reader of the input file. */
status refuse_interfaces_with_adaptive_method(struct reader *r, const struct yaml_node *interfaces_node);

/* Returns a static text for the end of a message, which advises to check the units of a strength, if that strength
 * requires a horizon `required_horizon` [m] of less than a thousandth of the horizon of scene s (the input file).
 * Otherwise returns "". */
const char *strength_unit_hint_if_required_horizon_is_tiny(const struct scene *s, real required_horizon);

#endif
