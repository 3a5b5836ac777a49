/* Declares the functions that read the parts of a scene: solids, materials, bodies, loads, probes, and their checks. */
#ifndef CLEAVE_SCENE_PARTS
#define CLEAVE_SCENE_PARTS

#include "scene_internal.h"

/* Reads a region: a list of solids, with the regions to which they refer by name. */
status read_region(struct reader *r, const struct yaml_node *n, struct region *region);

/* Reads the named regions of the scene. */
status read_regions(struct reader *r, const struct yaml_node *root);

/* Reads a solid from an STL file (scene_shapes.c). */
status read_stl(struct reader *r, const struct yaml_node *n, struct solid *s);

/* Reads a solid from a mesh file (scene_shapes.c). */
status read_mesh(struct reader *r, const struct yaml_node *n, struct solid *s);

/* Reads a solid from the grey values of an image (scene_shapes.c). */
status read_image(struct reader *r, const struct yaml_node *n, struct solid *s);

/* Adds a part to a body for each material in `materials` of the images in its shape (scene_shapes.c). */
status read_grey_parts(struct reader *r, const struct yaml_node *shape, struct scene_body *b);

/* Returns true for a key that moves, turns or repeats a solid (scene_motions.c). */
bool node_is_solid_motion(const struct yaml_node *n);

/* Moves, turns and repeats a solid by the keys of `n` (scene_motions.c). */
status read_motions(struct reader *r, const struct yaml_node *n, struct solid *s);

status read_materials(struct reader *r, const struct yaml_node *root);

/* Reads the flow law, kinematic hardening and heating of a material; n: its node. Call it after the keys of linear
 * hardening are read (scene_laws.c). REFUSED for invalid constants, contradictions, and where the method or solver has
 * no laws. */
status read_flow_law(struct reader *r, const struct yaml_node *n, struct material *m);

status read_bodies(struct reader *r, const struct yaml_node *root);

/* Reads the parts of a body from the list of key k; list NULL: not given (scene_body_parts.c). */
status read_body_parts(struct reader *r, const struct yaml_node *list, const struct key *k, struct scene_body *b);

status read_cracks(struct reader *r, const struct yaml_node *root);
status read_crack_growths(struct reader *r, const struct yaml_node *root);
status read_initial_states(struct reader *r, const struct yaml_node *root);

/* Reads the function of time of a boundary; n NULL or `constant`: the function is 1 (scene_time.c). */
status read_time_function(struct reader *r, const struct yaml_node *n, struct boundary *b);

/* Reads the axis of a rotation from the mapping `n`: a unit vector in space, z in the plane (scene_loads.c). */
status read_rotation_axis(struct reader *r, const struct yaml_node *n, const char *group, real *axis);

/* Reads the components of a vector: numbers to value[dim], or formulas of x, y, z and the arguments in `of` to
 * formula[dim]. The value of a component with a formula is 1 (scene_loads.c). */
status read_formulas(struct reader *r, const struct key *k, const struct yaml_node *n, unsigned of, real *value,
                     struct expression *formula);

status read_boundaries(struct reader *r, const struct yaml_node *root);
status read_probes(struct reader *r, const struct yaml_node *root);
status read_frame_regions(struct reader *r, const struct yaml_node *root);
/* Sets defaults that depend on several keys, and checks conditions between keys outside of lists (scene_check.c).
 * REFUSED for keys that contradict each other. */
status check_scene(struct reader *r, const struct yaml_node *root);

/* Sets the default of the safety factor on the critical time step, which depends on whether bonds can break. Call it
 * after the materials are read. */
void resolve_safety_factor(struct reader *r, const struct yaml_node *root);

/* Sets the default of contact.between. REFUSED for contact with a static solver, and for friction without contact. */
status resolve_contact(struct reader *r, const struct yaml_node *root);

/* Returns REFUSED if bodies have more particles than 32-bit indices can count. Call it after bodies are read. */
status check_particle_count(struct reader *r, const struct yaml_node *root);

/* Reads the interfaces and joins their bodies (scene_interfaces.c). */
status read_interfaces(struct reader *r, const struct yaml_node *root);

/* Returns REFUSED, with a message, for a boundary on one of several joined bodies (scene_interfaces.c). */
status check_joined_bodies(struct reader *r, const struct yaml_node *root);

/* Returns the critical stretch that follows from the energy release rate of a material, for the model, horizon and
 * space of the scene [1]. */
real scene_critical_stretch(const struct scene *s, const struct material *m);

/* Reduces *r->spacing_most, unless r->spacing_most is NULL, to `most`, the largest spacing that suits a strength [m].
 * Returns true if it is not NULL: then no strength is refused for the present spacing. */
static inline bool note_largest_spacing(struct reader *r, real most)
{
    if (r->spacing_most) *r->spacing_most = real_min(*r->spacing_most, most);
    return r->spacing_most != NULL;
}

/* Sets m->onset_stretch, at which the bonds of material m begin to soften; m->critical_stretch must be set. n: the
 * material in the scene. REFUSED where bonds cannot soften, or where they break before the tensile strength is
 * reached (scene_softening.c). */
status read_softening(struct reader *r, const struct yaml_node *n, struct material *m);

/* Sets the strength surface of material m, if its strengths give one, and its m->onset_stretch; m->critical_stretch
 * must be set. n: the material in the scene. REFUSED where the strengths contradict each other, or where bonds begin to
 * soften by themselves before the surface is reached in tension (scene_surface.c). */
status read_surface(struct reader *r, const struct yaml_node *n, struct material *m);

/* Returns REFUSED for a strength of material m above a tenth of Young's modulus. n: the strength in the scene. */
status check_strength_size(struct reader *r, const struct yaml_node *n, const struct material *m, real strength);

/* Returns REFUSED if material k, read from n, softens by another law than an earlier one: bonds between two materials
 * have one curve. */
status check_one_softening(struct reader *r, const struct yaml_node *n, int k);

/* Returns REFUSED for friction with a contact law or beside boundaries that do not support it. */
status check_friction(struct reader *r, const struct yaml_node *root);

/* Returns REFUSED, with a message, for absorbing boundaries in a static problem. */
status check_absorbing(struct reader *r, const struct yaml_node *root);

/* Returns REFUSED for loads that static solvers or irregular lattices do not support. */
status check_supported_loads(struct reader *r, const struct yaml_node *root);

/* Decides the frame of bodies for which the scene leaves it at `auto`: the current frame if the body cannot use the
 * reference frame, with the reason in body.frame_reason; else `auto` remains, and the choice is made when the particles
 * exist. Call it after the bodies are read. */
void resolve_reference_frames(struct scene *s);

/* Finds out which particle lists form a lattice, and determines the default correction of bonds near faces again, which
 * depends on that. Call it after the bodies are read. */
void resolve_particle_lists(struct reader *r, const struct yaml_node *root);

/* Returns REFUSED for keys that static solvers do not support. Call it after materials and probes are read. */
status check_solver(struct reader *r, const struct yaml_node *root);

/* Returns REFUSED, with a message, for keys that load steps do not support (scene_steps.c). */
status check_load_steps(struct reader *r, const struct yaml_node *root);

/* Returns true if the scene has load steps and a material whose bonds soften (scene_steps.c). */
bool steps_soften(const struct scene *s);

/* REFUSED for keys of load steps with another solver, unless they all have their defaults (scene_steps.c). */
status check_load_step_keys_unused(struct reader *r, const struct yaml_node *root);

/* Returns the scene as run, in YAML (scene_echo.c); the caller releases it with memory_free. NULL: out of memory. */
char *scene_to_yaml(const struct scene *s);

#endif
