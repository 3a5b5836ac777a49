/* Declares the functions that read the parts of an input file: solids, materials, bodies, loads, probes, and their
 * checks. */
#ifndef CLEAVE_SCENE_PARTS
#define CLEAVE_SCENE_PARTS

#include "scene_internal.h"

/* Reads a region, a list of solids, from the node `region_node` of the input file into *region. An entry of the list
 * may be the name of another region, whose solids are inserted. r: reader of the input file. Returns REFUSED, with a
 * message, if the region is invalid. */
status read_region(struct reader *r, const struct yaml_node *region_node, struct region *region);

/* Reads the named regions of the input file with the tree `root` and the reader r into r->scene. Returns REFUSED, with
 * a message, if one is invalid. */
status read_regions(struct reader *r, const struct yaml_node *root);

/* Reads a solid whose surface is in an STL file from the node `solid_node` into *solid. r: reader of the input file.
 * Returns REFUSED, with a message, for an invalid key or file. */
status read_stl_solid(struct reader *r, const struct yaml_node *solid_node, struct solid *solid);

/* Reads a solid from the node `solid_node` into *solid: a mesh from a file, or a set of its elements or nodes. r:
 * reader of the input file. Returns REFUSED, with a message, for an invalid key or file. */
status read_mesh_solid(struct reader *r, const struct yaml_node *solid_node, struct solid *solid);

/* Reads a solid from the node `solid_node` into *solid: the voxels of an image that have certain grey values. r: reader
 * of the input file. Returns REFUSED, with a message, for an invalid key or file. */
status read_image_solid(struct reader *r, const struct yaml_node *solid_node, struct solid *solid);

/* Adds a part (a region with its own material) to `body` for each material that the images in its shape assign to grey
 * values. shape_node: node of the shape. r: reader of the input file. Returns REFUSED, with a message, for an unknown
 * material or invalid grey values. */
status read_body_parts_by_grey_value(struct reader *r, const struct yaml_node *shape_node, struct scene_body *body);

/* Returns true if the node n of the input file is a key that moves, rotates or repeats a solid, such as `rotate`; false
 * if the node is a solid. */
bool node_is_motion_key_of_solid(const struct yaml_node *n);

/* Reads the keys of the node `solid_node` that move, turn and repeat a solid, and stores these motions in *solid. r:
 * reader of the input file. Returns REFUSED, with a message, for invalid keys. */
status read_solid_motions(struct reader *r, const struct yaml_node *solid_node, struct solid *solid);

/* Reads the materials of the input file with the tree `root` and the reader r into r->scene. Returns REFUSED, with a
 * message, if one is invalid. */
status read_materials(struct reader *r, const struct yaml_node *root);

/* Returns the node of the key by which a material yields: yield_stress, johnson_cook or hardening. Returns
 * material_node itself, the node of the material, if none of these keys is given. */
const struct yaml_node *material_node_find_yield_key(const struct yaml_node *material_node);

/* Reads the flow law (yield stress as a function of plastic strain, rate and temperature), kinematic hardening and
 * heating of `material`. material_node: node of the material. The keys of linear hardening must have been read before.
 * r: reader of the input file. Returns REFUSED, with a message, for invalid constants, contradictions, and if the
 * method or solver does not support flow laws. */
status read_flow_law(struct reader *r, const struct yaml_node *material_node, struct material *material);

/* Reads the bodies of the input file with the tree `root` and the reader r, deformable and rigid ones, into r->scene.
 * Returns REFUSED, with a message, if one is invalid. */
status read_bodies(struct reader *r, const struct yaml_node *root);

/* Moves the materials of which no body consists behind the others and counts them in s->unused_materials, no longer in
 * s->materials, so that they have no effect on a run. Must be called after read_bodies. */
void scene_exclude_unused_materials(struct scene *s);

/* Reads the parts of `body`, the regions of it that have materials of their own, from `parts_node`, the value of key k.
 * parts_node: NULL if the key is not given. r: reader of the input file. Returns REFUSED, with a message, for an
 * invalid part. */
status read_body_parts(struct reader *r, const struct yaml_node *parts_node, const struct key *k,
                       struct scene_body *body);

/* Reads the pre-cracks of the input file with the tree `root` and the reader r into r->scene. Returns REFUSED, with a
 * message, if one is invalid. */
status read_cracks(struct reader *r, const struct yaml_node *root);

/* Reads the settings of cracks with prescribed or controlled growth from the tree `root` of the input file into
 * r->scene (r: reader of the file). Returns REFUSED, with a message, if one is invalid. */
status read_crack_growths(struct reader *r, const struct yaml_node *root);

/* Reads the initial states (velocities, strains, wave pulses) from the tree `root` of the input file into r->scene (r:
 * reader of the file). Returns REFUSED, with a message, if one is invalid. */
status read_initial_states(struct reader *r, const struct yaml_node *root);

/* Reads the function of time of the boundary `boundary` from the node `function_node`. If the node is NULL or
 * `constant`, the function is 1. r: reader of the input file. Returns REFUSED, with a message, for an invalid function.
 */
status read_time_function(struct reader *r, const struct yaml_node *function_node, struct boundary *boundary);

/* Reads the axis of a rotation from the mapping `rotation_node` into unit_vector[DIM_MAX], a unit vector; in 2D it is
 * z. group_path: path of the keys of the rotation. r: reader of the input file. Returns REFUSED, with a message, for an
 * invalid axis. */
status read_rotation_axis(struct reader *r, const struct yaml_node *rotation_node, const char *group_path,
                          real *unit_vector);

/* Reads the components of a vector from the node `vector_node`. Component d is stored in value[d] if it is a number; if
 * it is a formula, it is stored in formula[d], and value[d] is 1. k: key of the vector, for unit and range;
 * further_variables: variables other than x, y and z that formulas may contain (EXPRESS_*). r: reader of the input
 * file. Returns REFUSED, with a message, for an invalid component. */
status read_vector_of_formulas(struct reader *r, const struct key *k, const struct yaml_node *vector_node,
                               unsigned further_variables, real *value, struct expression *formula);

/* Reads the boundary conditions of the input file with the tree `root` and the reader r into r->scene. Returns REFUSED,
 * with a message, if one is invalid. */
status read_boundaries(struct reader *r, const struct yaml_node *root);

/* Reads the settings of the probes (measurements during the run) from the tree `root` of the input file into r->scene
 * (r: reader of the file). Returns REFUSED, with a message, if one is invalid. */
status read_probes(struct reader *r, const struct yaml_node *root);

/* Reads the regions for which the input file requests output frames of their own from its tree `root` into r->scene (r:
 * reader of the file). Returns REFUSED, with a message, if one is invalid. */
status read_regions_of_output_frames(struct reader *r, const struct yaml_node *root);

/* Sets defaults of keys that depend on several other keys, and checks conditions between keys outside of lists. r,
 * root: reader and tree of the input file. Returns REFUSED, with a message, for keys that contradict each other. */
status check_key_combinations_and_set_defaults(struct reader *r, const struct yaml_node *root);

/* Sets the default of the safety factor on the critical time step, which depends on whether bonds can break. Materials
 * must have been read before. r, root: reader and tree of the input file, to see whether the key is given. */
void resolve_default_time_step_safety_factor(struct reader *r, const struct yaml_node *root);

/* Sets the default of contact.between, the bodies between which contact acts. r, root: reader and tree of the input
 * file. Returns REFUSED, with a message, for contact with a static solver, and for friction without contact. */
status resolve_default_contact_bodies(struct reader *r, const struct yaml_node *root);

/* Returns REFUSED if the bodies of the input file would have more particles than 32-bit indices can count. Bodies must
 * have been read before. r, root: reader and tree of the input file, for the location in the message. */
status check_particle_count_fits_indices(struct reader *r, const struct yaml_node *root);

/* Reads the interfaces between bodies into r->scene and joins these bodies. r, root: reader and tree of the input file.
 * Returns REFUSED, with a message, for an invalid interface. */
status read_interfaces(struct reader *r, const struct yaml_node *root);

/* Checks that each boundary condition that applies to one of several bodies joined by interfaces applies to all of
 * them. r: reader of the input file; root: tree of the input file. Returns REFUSED, with a message, if one does not. */
status check_boundaries_apply_to_all_joined_bodies(struct reader *r, const struct yaml_node *root);

/* Returns the critical stretch of bonds [1] that follows from the energy release rate of material m, with the model,
 * horizon and space of scene s (the input file). */
real scene_critical_stretch(const struct scene *s, const struct material *m);

/* Limits the spacing that `method: auto` searches for, when the reader r reads the input file: reduces its upper bound
 * *r->spacing_most to `largest_spacing` if that is smaller, the largest spacing with which a material can have its
 * tensile strength [m]. Returns true then. Returns false, and does nothing, if the spacing is not searched for
 * (r->spacing_most is NULL); the caller then refuses a strength that does not suit the present spacing. */
static inline bool spacing_search_reduce_upper_bound_if_active(struct reader *r, real largest_spacing)
{
    if (r->spacing_most) *r->spacing_most = real_min(*r->spacing_most, largest_spacing);
    return r->spacing_most != NULL;
}

/* Sets material->onset_stretch, the stretch at which bonds of `material` begin to soften, from its tensile strength;
 * material->critical_stretch must be set. material_node: node of the material. r: reader of the input file. Returns
 * REFUSED, with a message, if bonds cannot soften with the method or model of the input file, or if they would break
 * before the tensile strength is reached. */
status read_softening_onset(struct reader *r, const struct yaml_node *material_node, struct material *material);

/* Sets the strength surface of `material`, if the input file gives strengths other than the tensile one, and
 * material->onset_stretch; material->critical_stretch must be set. material_node: node of the material. r: reader of
 * the input file. Returns REFUSED, with a message, if the strengths contradict each other, or if bonds would begin to
 * soften before the stress reaches the surface in tension. */
status read_strength_surface(struct reader *r, const struct yaml_node *material_node, struct material *material);

/* Checks that `strength` [Pa] is at most a tenth of Young's modulus of `material`. strength_node: node of the strength,
 * for the location in the message. r: reader of the input file. Returns REFUSED, with a message, if the strength is
 * larger. */
status check_strength_below_tenth_of_modulus(struct reader *r, const struct yaml_node *strength_node,
                                             const struct material *material, real strength);

/* Returns REFUSED, with a message, if the material with the index `material_index`, read from the node `material_node`,
 * has another softening law than an earlier material. All bonds of a run must have one law, since bonds between two
 * materials have one curve. r: reader of the input file. */
status check_single_softening_law(struct reader *r, const struct yaml_node *material_node, int material_index);

/* Returns the first material of scene s (the input file) for which condition(material) is true; NULL if there is
 * none. */
const struct material *scene_find_first_material_that_satisfies(const struct scene *s,
                                                                bool (*condition)(const struct material *));

/* Returns REFUSED, with a message, if bonds of one material soften while another material yields, and for keys that
 * state-based models do not support with bonds that soften. r, root: reader and tree of the input file. */
status check_softening_is_supported(struct reader *r, const struct yaml_node *root);

/* Checks the friction of contact in the input file. Returns REFUSED, with a message, where friction is not supported:
 * with the contact law between pairs of particles, or together with planes of symmetry. r, root: reader and tree of the
 * input file. */
status check_friction_is_supported(struct reader *r, const struct yaml_node *root);

/* Returns REFUSED, with a message, if a static problem has absorbing boundaries. r, root: reader and tree of the input
 * file, for the location in the message. */
status check_no_absorbing_boundary_if_static(struct reader *r, const struct yaml_node *root);

/* Checks the loads of the input file with the reader r and the tree `root`. Returns REFUSED, with a message, for loads
 * that static solvers, or particles at randomly shifted positions, do not support. */
status check_loads_are_supported(struct reader *r, const struct yaml_node *root);

/* Replaces the setting `auto` of body.frame by `current` in each body of scene s (the input file) that does not support
 * `reference`, and stores the reason in body.frame_reason. With `current` shape functions are evaluated at the present
 * positions of material points, with `reference` at their reference positions. Other bodies keep `auto` until the
 * particles exist. Bodies must have been read before. */
void scene_resolve_auto_shape_function_configuration(struct scene *s);

/* Finds out which particle lists form a lattice, and then sets the default of the correction of bonds near faces (key
 * pd.surface), which depends on it. Bodies must have been read before. r, root: reader and tree of the input file, to
 * see which keys are given. */
void detect_lattices_and_resolve_surface_correction(struct reader *r, const struct yaml_node *root);

/* Checks the keys of an input file that requests a static solver. Returns REFUSED, with a message, for keys that static
 * solvers do not support. Materials and probes must have been read before. r, root: reader and tree of the input file.
 */
status check_keys_supported_by_static_solver(struct reader *r, const struct yaml_node *root);

/* Checks the keys of an input file that requests load steps (successive static equilibria). Returns REFUSED, with a
 * message, for keys that this solver does not support. r, root: reader and tree of the input file. */
status check_keys_supported_by_load_step_solver(struct reader *r, const struct yaml_node *root);

/* Returns true if scene s (the input file) is solved in load steps (successive static equilibria) and has a material
 * whose bonds soften. */
bool scene_has_load_steps_with_softening_bonds(const struct scene *s);

/* Returns REFUSED, with a message, if the input file gives settings of load steps (successive static equilibria) but
 * has another solver, unless all of them have their default values. r, root: reader and tree of the input file. */
status check_no_load_step_keys_with_other_solver(struct reader *r, const struct yaml_node *root);

/* Returns the contents s of an input file as they are run, every key with its value or default, as YAML text. Returns
 * NULL if there is no memory. The caller releases the text with memory_free. */
char *scene_to_yaml(const struct scene *s);

#endif
