/* Checks conditions between several keys of a scene, and sets defaults that depend on other keys. */
#include "data/particles.h"
#include "list_lattice.h"
#include "scene/fill.h"
#include "scene_parts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define PRESSURE_SHAKEN 0.7 /* irregularity above which gaps and faces cannot be told apart (loads_columns.c) */

static const struct yaml_node *scene_check_below(const struct yaml_node *root, const char *group, const char *leaf)
{
    return yaml_node_find(yaml_node_find(root, group), leaf);
}

/* Returns REFUSED, with a message, if `thickness` is missing in a plane space or given in another one, or if `section`
 * is given outside space line. In spaces without a thickness, sets it to 1. root: YAML tree of the scene. */
static status check_measure(struct reader *r, const struct yaml_node *root)
{
    struct scene *s = r->scene;
    const struct yaml_node *thickness = yaml_node_find(root, "thickness"), *section = yaml_node_find(root, "section");
    const char *space = space_names[s->space];
    if (s->dim == 2 && !thickness) return fault_report_missing_key(r, root, key_find("", "thickness"));
    if (s->dim != 2 && thickness)
        return fault_report_at_node(r, thickness, "space %s has no thickness; remove this key", space);
    if (s->dim != 1 && section)
        return fault_report_at_node(r, section, "space %s has no section; remove this key", space);
    if (s->dim != 2) s->thickness = 1;
    return OK;
}

static real longest_side(const real *from, const real *to, int dim)
{
    real longest = 0;
    for (int d = 0; d < dim; d++) longest = real_max(longest, to[d] - from[d]);
    return longest;
}

/* Largest number of lattice positions in the bounding box of a surface that is read from a file. Testing whether one
 * position is inside takes 5 us. */
#define PLACES_OF_FILES 1e8

/* Returns REFUSED, with a message, if the bodies of the scene would have more than 2e9 particles, the limit of 32-bit
 * indices and of memory, or if the box around a surface from a file has more than PLACES_OF_FILES lattice positions.
 * Numbers of particles are estimated from bounding boxes. root: YAML tree of the scene, to locate errors. */
status check_particle_count_fits_indices(struct reader *r, const struct yaml_node *root)
{
    const struct scene *s = r->scene;
    real total = 0, longest = 0, from[DIM_MAX], to[DIM_MAX];
    for (int b = 0; b < s->bodies; b++) {
        real count = 1;
        if (s->body[b].file || !region_compute_bounding_box_if_finite(&s->body[b].shape, s->dim, from, to)) continue;
        for (int d = 0; d < s->dim; d++) count *= real_max(1, (to[d] - from[d]) / s->spacing);
        if (count > PLACES_OF_FILES && s->body[b].shape.n > 0 && s->body[b].shape.solid[0].hull)
            return status_message_prepend_location(
                s->body[b].place,
                status_set(
                    REFUSED,
                    "body %s: the box around the shape in its file is %.4g m long and has %.1e lattice positions, more "
                    "than the limit of 1e8; check the unit of the file, and look for faces far from the others",
                    s->body[b].name, longest_side(from, to, s->dim), count));
        total += count, longest = real_max(longest, longest_side(from, to, s->dim));
    }
    if (total <= 2e9) return OK;
    const struct yaml_node *spacing = scene_check_below(root, "particles", "spacing");
    return fault_report_at_node(
        r, spacing,
        "a spacing of %s makes about %.1e particles in bodies up to %.4g m long, more than the limit of 2e9; "
        "use a larger spacing",
        node_value_to_text_for_message(r, spacing), total, longest);
}

/* Returns REFUSED, with a message, if the input file (scene) has friction where it is not supported: with the contact
 * law between pairs of particles, or together with planes of symmetry. root: YAML tree of the scene, to locate errors.
 */
status check_friction_is_supported(struct reader *r, const struct yaml_node *root)
{
    const struct scene *s = r->scene;
    const struct yaml_node *friction = scene_check_below(root, "contact", "friction");
    if (!(s->contact_friction > 0)) return OK;
    if (s->contact_form == CONTACT_PAIR)
        return fault_report_at_node(
            r, friction,
            "friction has no effect with contact.law: pair, whose particles interlock like gears; set "
            "contact.law: surface");
    for (int b = 0; b < s->boundaries; b++)
        if (s->boundary[b].kind == BOUNDARY_MIRROR)
            return fault_report_at_node(
                r, friction,
                "friction cannot be combined with planes of symmetry; set contact.friction: 0, or remove the "
                "boundaries `mirror`");
    return OK;
}

/* Returns REFUSED, with a message, if a static problem has absorbing faces. root: YAML tree of the input file (scene),
 * for the location in the message. */
status check_no_absorbing_boundary_if_static(struct reader *r, const struct yaml_node *root)
{
    const struct scene *s = r->scene;
    const struct yaml_node *list = yaml_node_find(root, "boundary"), *n = list ? list->first : NULL;
    for (int b = 0; b < s->boundaries && n; b++, n = n->next)
        if (s->boundary[b].kind == BOUNDARY_ABSORBING && !scene_is_dynamic(s))
            return fault_report_at_node(
                r, yaml_node_find(n, "absorbing"),
                "an absorbing face has no effect in a static equilibrium, which has no waves; remove it, or "
                "set solver: explicit");
    return OK;
}

/* Returns REFUSED, with a message, if a static problem has damping, or if damping is combined with coarse grid cells
 * that have time steps of their own (mpm.levels). root: YAML tree of the scene, to locate errors. */
static status check_damping(struct reader *r, const struct yaml_node *root)
{
    const struct scene *s = r->scene;
    const struct yaml_node *damping = yaml_node_find(root, "damping"),
                           *levels = scene_check_below(root, "mpm", "levels");
    if (!(s->damping > 0)) return OK;
    if (!scene_is_dynamic(s))
        return fault_report_at_node(
            r, damping, "a static equilibrium has no velocities to damp; remove damping, or set solver: explicit");
    if (levels && s->levels != LEVELS_AUTO && s->levels > 0)
        return fault_report_at_node(
            r, levels,
            "%s levels of coarse cells have longer time steps, but damping needs one time step for the whole "
            "body; set mpm.levels: 0",
            node_value_to_text_for_message(r, levels));
    return OK;
}

/* Returns REFUSED, with a message, for loads that other keys of the scene exclude: pressures on particles at irregular
 * (randomly shifted) positions; with static solvers, pressures that follow the surface, rotations, and velocities by a
 * formula whose displacement is unknown. root: YAML tree of the input file (scene), for the location in the message. */
status check_loads_are_supported(struct reader *r, const struct yaml_node *root)
{
    const struct scene *s = r->scene;
    const struct yaml_node *list = yaml_node_find(root, "boundary"), *n = list ? list->first : NULL;
    for (int b = 0; b < s->boundaries && n; b++, n = n->next) {
        const struct boundary *load = &s->boundary[b];
        const bool formula = load->formula[0].n + load->formula[1].n + load->formula[2].n > 0;
        if (load->kind == BOUNDARY_PRESSURE && s->irregularity > PRESSURE_SHAKEN)
            return fault_report_at_node(
                r, yaml_node_find(n, "pressure"),
                "a pressure needs the positions of faces, which are unknown with particles.irregularity above "
                "%g; use a traction, or a smaller particles.irregularity",
                PRESSURE_SHAKEN);
        if (!scene_is_single_equilibrium(s)) continue;
        if (load->follow)
            return fault_report_at_node(
                r, yaml_node_find(n, "follow"),
                "a static equilibrium applies loads to the undeformed body; set follow: false, or solver: "
                "explicit with damping");
        if (load->rotates)
            return fault_report_at_node(
                r, yaml_node_find(n, "rotation"),
                "a static solver moves supports along straight lines only; use displacement in place of "
                "rotation, or set solver: explicit");
        if (formula && boundary_check_velocity_has_closed_form_integral(load) != OK)
            return fault_report_at_node(
                r, yaml_node_find(n, "velocity"),
                "static solvers need the displacement, which a velocity as a formula of t does not give; give "
                "a displacement");
    }
    return OK;
}

/* Returns REFUSED, with a message, if the input file (scene) gives a time step with which the run would take more than
 * 1e12 steps. root: YAML tree of the scene, for the location in the message. */
static status check_steps(struct reader *r, const struct yaml_node *root)
{
    const struct scene *s = r->scene;
    const struct yaml_node *step = scene_check_below(root, "time", "step");
    if (!step || s->time_step == 0 || s->duration / s->time_step <= 1e12) return OK;
    return fault_report_at_node(r, step, "%s makes %.1e time steps, more than the limit of 1e12; use a larger step",
                                node_value_to_text_for_message(r, step), s->duration / s->time_step);
}

/* Returns REFUSED, with a message, if mpm.origin, the position of a grid node, is more than FILL_FARTHEST spacings from
 * the origin of the coordinates, the limit for particles, too. root: tree of the scene, for the location in the
 * message. */
static status check_origin(struct reader *r, const struct yaml_node *root)
{
    const struct scene *s = r->scene;
    for (int a = 0; a < s->dim && s->has_grid_origin && s->spacing > 0; a++)
        if (!(fabs(s->grid_origin[a]) <= FILL_FARTHEST * s->spacing))
            return fault_report_at_node(
                r, scene_check_below(root, "mpm", "origin"),
                "%.3g m is more than 1e7 spacings from the origin, where double precision no longer resolves "
                "strains; use a position near the origin",
                s->grid_origin[a]);
    return OK;
}

/* Returns REFUSED, with a message, if mpm.transfer is given as apic and the shape functions are linear, which is
 * unstable. root: YAML tree of the input file (scene), for the location in the message. */
static status check_transfer(struct reader *r, const struct yaml_node *root)
{
    const struct yaml_node *transfer = scene_check_below(root, "mpm", "transfer");
    if (!transfer || r->scene->shape != SHAPE_LINEAR || r->scene->transfer != TRANSFER_APIC) return OK;
    return fault_report_at_node(r, transfer,
                                "apic is unstable with mpm.shape: linear; set mpm.transfer: flip, or mpm.shape: gimp");
}

/* Sets the default of time.safety, the ratio of the time step to the critical one: 0.5 if bonds can break, else 0.8.
 * Crack lengths and most crack angles are equal at both values. In a scene in which two crack paths are nearly
 * equivalent, the path can change above 0.3 to 0.5. Metals keep 0.8: at 0.5 they need 1.6 times the steps, and
 * taylor_bar loses 0.09 % of its energy instead of 0.04 %. Only bars shorter than two diameters are more accurate at
 * 0.5, for which say_flow_error prints a remark. root: YAML tree of the scene, with or without the key. */
void resolve_default_time_step_safety_factor(struct reader *r, const struct yaml_node *root)
{
    struct scene *s = r->scene;
    if (!scene_check_below(root, "time", "safety"))
        s->safety = scene_bonds_can_break(s) && s->method != METHOD_MPM ? 0.5 : 0.8;
}

/* Sets the default of contact.between: contact exists if the input file (scene) has several bodies, rigid bodies or
 * cracks, but not with static solvers or if bonds soften in load steps. root: YAML tree of the scene. Returns REFUSED,
 * with a message, for contact settings that contradict the solver or the model. */
status resolve_default_contact_bodies(struct reader *r, const struct yaml_node *root)
{
    struct scene *s = r->scene;
    const struct yaml_node *between = scene_check_below(root, "contact", "between");
    const struct yaml_node *friction = scene_check_below(root, "contact", "friction");
    const bool faces = s->bodies + s->rigids > 1 || (scene_can_have_cracks(s) && s->method != METHOD_MPM);
    const bool meet = !scene_is_single_equilibrium(s) && !scene_has_load_steps_with_softening_bonds(s) && faces;
    if (!between) s->contact_between = !meet ? CONTACT_NONE : s->method == METHOD_MPM ? CONTACT_BODIES : CONTACT_ALL;
    if (s->contact_distance == DISTANCE_LAMMPS && (s->contact_form != CONTACT_PAIR || s->model != MODEL_BOND))
        return fault_report_at_node(
            r, scene_check_below(root, "contact", "distance"),
            "the distance lammps is the rule of LAMMPS' peri/pmb; set contact.law: pair and model: bond, or "
            "another contact.distance");
    if (s->contact_between != CONTACT_NONE && scene_is_single_equilibrium(s))
        return fault_report_at_node(
            r, between, "this static solver has no contact; set contact.between: none, or solver: explicit");
    if (s->contact_between != CONTACT_NONE && scene_has_load_steps_with_softening_bonds(s))
        return fault_report_at_node(
            r, between, "load steps have no contact if bonds soften; set contact.between: none, or solver: explicit");
    if (s->contact_friction > 0 && s->contact_between == CONTACT_NONE && s->rigids == 0)
        return fault_report_at_node(
            r, friction,
            "nothing has contact (contact.between: none), so friction has no effect; remove it, or set "
            "contact.between: all");
    return OK;
}

/* Returns the default of pd.surface, the rule by which bonds near surfaces are corrected, for the scene s. The
 * correction is needed only with `method: pd`, since only then bonds fill whole bodies up to their surfaces;
 * state-based neighbourhoods with a given normalisation are corrected already. Scenes in load steps with growing
 * cracks use the rule that ignores pre-cracks, because surfaces of a growing crack get no weights and the loads of
 * pre-crack and grown crack are compared (`cleave bench slow`: double cantilevers of 10 layers deviate by 1 %, with
 * moments by 5 %). root: YAML tree of the input file (scene). */
static enum surface_rule surface_by_default(const struct scene *s, const struct yaml_node *root)
{
    bool lattice = s->dim > 1 && s->irregularity == 0 && !scene_check_below(root, "pd", "normalisation");
    for (int b = 0; b < s->bodies; b++) /* set by detect_lattices_and_resolve_surface_correction */
        lattice = lattice && (!s->body[b].file || s->body[b].list.lattice);
    if (s->method != METHOD_PD) return SURFACE_NONE;
    if (scene_has_load_steps(s) && scene_bonds_can_break(s) && s->model == MODEL_BOND) return SURFACE_VOLUME;
    if (lattice) return SURFACE_MOMENTS;
    return s->model == MODEL_BOND ? SURFACE_VOLUME : SURFACE_NONE;
}

/* Sets in s the defaults of pd.surface (correction of bonds near surfaces) and pd.normalisation (whether bonds are
 * normalised by a full neighbourhood or by the neighbourhood of each particle). root: YAML tree of the input file
 * (scene), to see which keys are given. */
static void resolve_surface(struct scene *s, const struct yaml_node *root)
{
    if (!scene_check_below(root, "pd", "surface")) s->surface = surface_by_default(s, root);
    if (!scene_check_below(root, "pd", "normalisation")) /* an irregular lattice has no full neighbourhoods */
        s->bulk = (s->model == MODEL_MOSPD && s->irregularity == 0) || s->surface == SURFACE_MOMENTS;
}

/* Returns true if the forms a and b of two particle lists agree: the same unit and the same column names. */
static bool list_forms_agree(const struct particle_list_form *a, const struct particle_list_form *b)
{
    if (!reals_are_bitwise_equal(a->scale, b->scale) || !a->columns != !b->columns) return false;
    return !a->columns || strcmp(a->columns, b->columns) == 0;
}

/* Returns true if the particle list of the body with the index `body` in s forms a lattice with the spacing that the
 * input file (scene) gives; a list that an earlier body has read in the same form is not read again. Returns false for
 * a list that cannot be read, which is reported later. */
static bool list_lattice(const struct scene *s, int body)
{
    struct particle_list list;
    for (int b = 0; b < body; b++)
        if (s->body[b].file && strcmp(s->body[b].file, s->body[body].file) == 0 &&
            list_forms_agree(&s->body[b].form, &s->body[body].form))
            return s->body[b].list.lattice;
    if (particle_list_read(&list, s->body[body].file, &s->body[body].form, s->dim) != OK) return false;
    const bool lattice = particle_list_is_lattice(
        &list, s->spacing, lattice_particle_volume(scene_cross_section_or_thickness(s), s->spacing, s->dim));
    particle_list_free(&list);
    return lattice;
}

void detect_lattices_and_resolve_surface_correction(struct reader *r, const struct yaml_node *root)
{
    struct scene *s = r->scene;
    for (int b = 0; b < s->bodies; b++)
        if (r->files && s->body[b].file && s->method == METHOD_PD && s->dim > 1)
            s->body[b].list.lattice = list_lattice(s, b);
    resolve_surface(s, root);
}

/* Sets the defaults of keys of pd, mpm and crack that depend on method, model, coupling and solver. root: YAML tree of
 * the input file (scene), to see which keys are given. */
static void resolve_defaults(struct reader *r, const struct yaml_node *root)
{
    struct scene *s = r->scene;
    resolve_surface(s, root);
    if (!scene_check_below(root, "pd", "weights"))
        s->shells = s->calibration == CALIBRATION_LATTICE ? SHELLS_ISOTROPIC : SHELLS_UNIFORM;
    if (!scene_check_below(root, "pd", "influence"))
        s->influence = s->model == MODEL_BOND ? INFLUENCE_ONE : INFLUENCE_INVERSE;
    if (!scene_check_below(root, "mpm", "shape"))
        s->shape = s->coupling == COUPLING_PM || s->coupling == COUPLING_PMG ? SHAPE_LINEAR : SHAPE_GIMP;
    if (!scene_check_below(root, "mpm", "transfer") && scene_is_single_equilibrium(s) && s->shape != SHAPE_LINEAR)
        s->transfer = TRANSFER_APIC;
    if (!scene_check_below(root, "crack", "speed_window")) s->speed_window = s->duration / 10;
}

/* Sets s->frames, the number of output frames, from output.every or output.times; times beyond the duration are
 * omitted. root: YAML tree of the input file (scene). Returns REFUSED, with a message, if two of output.every,
 * output.times and output.frames are given, or if there are more than FRAMES_MOST frames. */
static status check_times(struct reader *r, const struct yaml_node *root)
{
    struct scene *s = r->scene;
    const struct yaml_node *frames = scene_check_below(root, "output", "frames"),
                           *every = s->every > 0 ? scene_check_below(root, "output", "every") : NULL,
                           *times = scene_check_below(root, "output", "times");
    if (every && (frames || times)) return fault_report_exclusive_keys(r, frames ? frames : times, every);
    if (every && s->duration / s->every > FRAMES_MOST)
        return fault_report_at_node(r, every, "%s makes more than %d frames; use an interval of at least %.3g s",
                                    node_value_to_text_for_message(r, every), FRAMES_MOST, s->duration / FRAMES_MOST);
    if (every) s->frames = (int)ceil(s->duration / s->every * (1 - 1e-12)); /* the last frame is at the end */
    if (s->times.n == 0) return OK;
    if (frames) return fault_report_exclusive_keys(r, frames, times);
    for (s->frames = 0; s->frames < s->times.n && s->times.value[s->frames] <= s->duration * (1 + 1e-12);) s->frames++;
    return OK;
}

/* Returns REFUSED, with a message, if the input file (scene) gives the key accuracy, which only `method: auto` uses
 * (scene_wish.c). root: YAML tree of the scene. */
static status check_accuracy(struct reader *r, const struct yaml_node *root)
{
    const struct yaml_node *n = yaml_node_find(root, "accuracy");
    return n ? fault_report_at_node(r, n, "has no effect without method: auto; remove it") : OK;
}

/* Returns REFUSED, with a message, for combinations of material model and surface correction that have no meaning:
 * state-based models in space line; pd.surface: volume with these models; pd.surface: moments on irregular lattices, in
 * space line, or with state-based models that normalise each neighbourhood by itself. root: YAML tree of the input file
 * (scene), for the location in the message. */
static status check_model(struct reader *r, const struct yaml_node *root)
{
    const struct scene *s = r->scene;
    const struct yaml_node *model = yaml_node_find(root, "model"), *surface = scene_check_below(root, "pd", "surface");
    const bool moments = surface && s->surface == SURFACE_MOMENTS;
    if (moments && (s->dim == 1 || s->irregularity > 0))
        return fault_report_at_node(r, surface,
                                    "the correction `moments` needs a regular lattice in 2D or 3D; set pd.surface: %s",
                                    s->model == MODEL_BOND ? "volume or none" : "none");
    if (moments && s->model != MODEL_BOND && (s->method != METHOD_PD || !s->bulk))
        return fault_report_at_node(
            r, surface,
            "with model: %s the correction `moments` needs method: pd and pd.normalisation: bulk; set these, or "
            "pd.surface: none",
            node_value_to_text_for_message(r, model));
    if (s->dim == 1 && s->calibration != CALIBRATION_LATTICE && s->influence == INFLUENCE_INVERSE_SQUARE)
        return fault_report_at_node(
            r, scene_check_below(root, "pd", "influence"),
            "the influence inverse square has no continuum integral in one dimension; set pd.calibration: lattice");
    if (s->model == MODEL_BOND) return OK;
    if (s->dim == 1)
        return fault_report_at_node(r, model, "the model %s is not defined in space: line; set model: bond",
                                    node_value_to_text_for_message(r, model));
    if (surface && s->surface == SURFACE_VOLUME)
        return fault_report_at_node(
            r, surface,
            "the correction %s is for model: bond; with model: %s set pd.surface: none and correct bonds near "
            "surfaces by pd.normalisation",
            node_value_to_text_for_message(r, surface), node_value_to_text_for_message(r, model));
    return OK;
}

/* Returns REFUSED, with a message, for keys of the input file (scene) that do not suit its solver: for every solver,
 * keys of load steps that are not used and softening that is not supported; for static solvers, also keys that they do
 * not support. Must be called after materials and probes are read. root: YAML tree of the input file, for the location
 * in the message. */
status check_keys_supported_by_static_solver(struct reader *r, const struct yaml_node *root)
{
    const struct scene *s = r->scene;
    const struct yaml_node *solver = yaml_node_find(root, "solver");
    TRY(check_no_load_step_keys_with_other_solver(r, root));
    TRY(check_softening_is_supported(r, root));
    if (!solver || scene_is_dynamic(s)) return OK;
    if (scene_has_load_steps(s)) return check_keys_supported_by_load_step_solver(r, root);
    for (int m = 0; m < s->materials; m++)
        if (material_yields(&s->material[m]))
            return fault_report_at_node(
                r, solver, "the solver %s is for elastic materials, but material %s yields; set solver: %s",
                node_value_to_text_for_message(r, solver), s->material[m].name,
                s->method == METHOD_ADAPTIVE ? "explicit" : "static (load steps), or explicit");
    if (s->solver == SOLVER_CG && s->method != METHOD_PD)
        return fault_report_at_node(
            r, solver, "the solver cg works with method: pd only; with material points set solver: relaxation");
    if (s->method != METHOD_PD && s->transfer == TRANSFER_FLIP)
        return fault_report_at_node(
            r, solver,
            "with mpm.transfer: flip a relaxation does not converge, because light nodes at the border keep "
            "moving; set mpm.transfer: apic and an mpm.shape other than linear");
    for (int k = 0; k < s->probes; k++)
        if (s->probe[k].kind == PROBE_PULSE || s->probe[k].kind == PROBE_PATCH)
            return fault_report_at_node(r, solver,
                                        "the solver %s has no time steps, which probe %s needs; set solver: explicit",
                                        node_value_to_text_for_message(r, solver), s->probe[k].name);
    return OK;
}

status check_key_combinations_and_set_defaults(struct reader *r, const struct yaml_node *root)
{
    resolve_defaults(r, root);
    TRY(check_measure(r, root));
    TRY(check_origin(r, root));
    TRY(check_transfer(r, root));
    TRY(check_model(r, root));
    TRY(check_accuracy(r, root));
    TRY(check_times(r, root));
    TRY(check_damping(r, root));
    return check_steps(r, root);
}
