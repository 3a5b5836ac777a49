/* Checks the settings of load steps (solver static). */
#include <math.h>
#include <stdlib.h>

#include "scene_parts.h"

/* Returns REFUSED, with a message, for keys that require inertia or time, which the load steps of solver static do not
 * have. root: YAML tree of the input file (scene), for the location in the message. */
static status check_steps_motion(struct reader *r, const struct yaml_node *root)
{
    const struct scene *s = r->scene;
    const struct yaml_node *solver = yaml_node_find(root, "solver"), *cracks = yaml_node_find(root, "growth");
    for (int k = 0; k < s->rigids; k++)
        if (s->body[s->bodies + k].mass > 0)
            return status_message_prepend_location(
                s->body[s->bodies + k].place,
                status_set(REFUSED,
                           "rigid body %s has a mass and moves freely, but load steps have no inertia; give it a "
                           "velocity instead of the mass, or set solver: explicit",
                           s->body[s->bodies + k].name));
    if (s->growths > 0)
        return fault_report_at_node(
            r, cracks ? cracks : solver,
            "cracks with a prescribed speed need time steps; set solver: explicit, or remove growth");
    if (s->contact_friction > 0)
        return fault_report_at_node(r, tree_find_node_by_path(root, "contact.friction"),
                                    "load steps have no friction; set contact.friction: 0, or solver: explicit");
    for (int k = 0; k < s->initials; k++)
        if (s->initial[k].sets_velocity || s->initial[k].sets_pulse)
            return fault_report_at_node(
                r, yaml_node_find(root, "initial"),
                "load steps have no initial velocities; remove velocity and pulse from initial, or set "
                "solver: explicit");
    for (int k = 0; k < s->probes; k++)
        if (s->probe[k].kind == PROBE_PULSE)
            return fault_report_at_node(
                r, solver,
                "the solver static computes no waves, which probe %s measures; remove the probe, or set "
                "solver: explicit",
                s->probe[k].name);
    return OK;
}

/* Returns REFUSED, with a message, for boundaries that load steps do not support: loads that follow the surface, and
 * velocities by formula, whose displacement is unknown. root: YAML tree of the input file (scene). */
static status check_steps_loads(struct reader *r, const struct yaml_node *root)
{
    const struct scene *s = r->scene;
    const struct yaml_node *list = yaml_node_find(root, "boundary"), *n = list ? list->first : NULL;
    for (int b = 0; b < s->boundaries && n; b++, n = n->next) {
        if (s->boundary[b].follow)
            return fault_report_at_node(
                r, yaml_node_find(n, "follow"),
                "load steps apply loads to the undeformed body only; set follow: false, or solver: explicit");
        TRY(status_message_prepend_location(s->boundary[b].place,
                                            boundary_check_velocity_has_closed_form_integral(&s->boundary[b])));
    }
    return OK;
}

bool scene_has_load_steps_with_softening_bonds(const struct scene *s)
{
    return scene_has_load_steps(s) && scene_find_first_material_that_satisfies(s, material_has_softening_bonds);
}

/* Returns REFUSED, with a message, if bonds soften in load steps together with a method other than pd, rigid bodies, a
 * key of `steps` that determines the crack path, or a material whose bonds break without softening; else OK. root: YAML
 * tree of the input file (scene), for the location in the message. */
static status check_steps_softening(struct reader *r, const struct yaml_node *root)
{
    const struct scene *s = r->scene;
    const struct yaml_node *solver = yaml_node_find(root, "solver");
    if (!scene_has_load_steps_with_softening_bonds(s)) return OK;
    if (s->method != METHOD_PD)
        return fault_report_at_node(
            r, solver, "load steps with bonds that soften need method: pd; set it, or remove tensile_strength");
    if (s->rigids > 0)
        return fault_report_at_node(
            r, solver, "load steps with bonds that soften cannot have rigid bodies; use boundaries in their place");
    if (s->steps.control == CONTROL_OPENING || s->steps.then == THEN_EXPLICIT || s->steps.path == PATH_HOOP)
        return fault_report_at_node(
            r, yaml_node_find(root, "steps"),
            "bonds that soften determine the crack path themselves; set steps.control: energy or load, "
            "steps.then: equilibrium, and steps.path: bonds or auto");
    for (int m = 0; m < s->materials; m++)
        if (isfinite(s->material[m].critical_stretch) && !material_has_softening_bonds(&s->material[m]))
            return fault_report_at_node(
                r, solver,
                "material %s breaks without softening while another softens; with load steps all materials "
                "that break must be of one kind: give each a tensile_strength, or none",
                s->material[m].name);
    return OK;
}

/* Returns REFUSED, with a message, if no boundary condition, gravity or rigid body of the scene loads or displaces the
 * body. root: YAML tree of the input file (scene), for the location in the message. */
static status check_steps_loaded(struct reader *r, const struct yaml_node *root)
{
    const struct scene *s = r->scene;
    bool loaded = dot(s->gravity, s->gravity, DIM_MAX) > 0;
    for (int b = 0; b < s->boundaries; b++) {
        const struct boundary *load = &s->boundary[b];
        const bool varies = load->formula[0].n + load->formula[1].n + load->formula[2].n > 0 || load->rotates;
        loaded |= load->kind != BOUNDARY_MIRROR && (varies || dot(load->value, load->value, DIM_MAX) > 0);
    }
    if (loaded || scene_has_moving_rigid_body(s)) return OK;
    return fault_report_at_node(
        r, yaml_node_find(root, "solver"),
        "nothing loads the body; add a boundary with a displacement, velocity, traction, pressure or body "
        "force, or a rigid body with a velocity");
}

status check_keys_supported_by_load_step_solver(struct reader *r, const struct yaml_node *root)
{
    const struct scene *s = r->scene;
    const struct yaml_node *steps = yaml_node_find(root, "steps");
    const bool opening = s->steps.control == CONTROL_OPENING;
    TRY(check_steps_motion(r, root));
    TRY(check_steps_loads(r, root));
    TRY(check_steps_softening(r, root));
    r->scene->active_set = false; /* an equilibrium involves the whole body at once */
    if (s->steps.then == THEN_EXPLICIT && s->steps.control != CONTROL_LOAD)
        return fault_report_at_node(
            r, tree_find_node_by_path(root, "steps.then"),
            "the choice explicit is possible only with steps.control: load, because control: %s follows an "
            "unstable crack by load steps; set steps.then: equilibrium",
            opening ? "opening" : "energy");
    if (s->steps.path == PATH_HOOP && s->dim == 1)
        return fault_report_at_node(
            r, tree_find_node_by_path(root, "steps.path"),
            "the path hoop needs crack tips, which space line does not have; set steps.path: bonds or auto");
    if (!opening || (s->steps.has_from && s->steps.has_to && s->steps.opening > 0)) return check_steps_loaded(r, root);
    return fault_report_at_node(
        r, steps,
        "the control opening needs two positions, steps.from and steps.to, and the increase of their "
        "distance, steps.opening; give all three");
}

/* Returns REFUSED, with a message, if the input file (scene) has settings of load steps but another solver. Default
 * values are accepted, because scene.yaml, the scene as run, has all keys. root: YAML tree of the scene, for the
 * location in the message. */
status check_no_load_step_keys_with_other_solver(struct reader *r, const struct yaml_node *root)
{
    const struct scene_steps *s = &r->scene->steps;
    const struct yaml_node *steps = yaml_node_find(root, "steps");
    const struct key *number = key_find("steps", "number"), *breaks = key_find("steps", "breaks");
    const bool usual = s->number == atoi(number->fallback) && s->control == CONTROL_LOAD && s->energy == 0 &&
                       s->opening == 0 && s->path == PATH_AUTO && s->breaks == atoi(breaks->fallback);
    if (!steps || scene_has_load_steps(r->scene) || usual) return OK;
    return fault_report_at_node(r, steps, "the keys of steps need solver: static; set it, or remove them");
}
