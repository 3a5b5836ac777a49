/* Determines which bodies can use the reference frame (mpm.frame: shape functions on a mesh of the undeformed body),
 * which frame the value `auto` selects, and the levels of coarse cells of bodies that yield. */
#include "scene_parts.h"

/* Returns true if a material of the body with the index `body` in s yields (has a yield stress). */
static bool body_yields(const struct scene *s, int body)
{
    for (int m = 0; m < s->materials; m++)
        if (scene_body_can_have_material(&s->body[body], m) && material_yields(&s->material[m])) return true;
    return false;
}

/* Returns the reason why a body cannot use the reference frame (a mesh of the undeformed body), as part of a message;
 * NULL if it can. body: index in the scene s. */
const char *scene_reason_total_lagrangian_mpm_unsupported(const struct scene *s, int body)
{
    if (s->method == METHOD_PD) return "method pd has no material points";
    if (scene_is_single_equilibrium(s)) return "static solvers need the current frame";
    if (s->coupling != COUPLING_PARTIAL_STRESS && s->coupling != COUPLING_HANDSHAKE)
        return "the couplings pm, pg, pmg and pgg exist only for material points in the current configuration "
               "(mpm.frame: current)";
    if (s->cell != 2) return "the reference frame needs mpm.cell: 2";
    if (s->irregularity > 0) return "it needs particles on a regular lattice";
    if (s->body[body].list.mass) return "particles with a mass from a list need the current frame";
    if (!body_yields(s, body)) return NULL;
    if (s->method != METHOD_MPM)
        return scene_has_load_steps(s)
                   ? "its material has a yield_stress, which load steps allow with method: mpm or pd only"
                   : "materials that yield need method: mpm in the reference frame";
    if (s->lattice_constants) return "materials that yield need mpm.constants: isotropic in the reference frame";
    if (scene_is_dynamic(s) && s->levels != LEVELS_AUTO && s->levels > 0)
        return "materials that yield need mpm.levels: 0 (one time step) in the reference frame";
    return NULL;
}

const char *scene_reason_auto_rejects_total_lagrangian_mpm(const struct scene *s, int body)
{
    const char *why = scene_reason_total_lagrangian_mpm_unsupported(s, body);
    if (why) return why;
    if (s->bodies > 1) return "bodies have contact only on the grid of the current frame";
    if (s->body[body].file) return "it needs particles on a regular lattice, which particles from a list may not have";
    if (!scene_has_load_steps(s) && body_yields(s, body))
        return "materials that yield may exceed the small strains for which the reference frame is valid";
    return NULL;
}

const char *scene_reason_not_to_advise_total_lagrangian_mpm(const struct scene *s)
{
    const char *why = NULL;
    for (int b = 0; b < s->bodies && !why; b++) why = scene_reason_auto_rejects_total_lagrangian_mpm(s, b);
    return why;
}

/* Returns the reason why the scene s requires the frame `current`, in which shape functions are evaluated at the
 * present positions of material points: a key that only this frame supports, as part of a message. Returns NULL if the
 * input file (scene) gives no such key. */
static const char *current_frame_key(const struct scene *s)
{
    if (s->has_shape) return "the scene gives mpm.shape, a key for the current frame only";
    if (s->has_transfer) return "the scene gives mpm.transfer, a key for the current frame only";
    if (s->has_interface_damping) return "the scene gives interface_damping, a key for the current frame only";
    return NULL;
}

bool scene_has_yielding_total_lagrangian_mpm_body(const struct scene *s)
{
    bool any = false;
    for (int b = 0; b < s->bodies; b++) any |= s->body[b].frame == FRAME_REFERENCE && body_yields(s, b);
    return any && scene_is_dynamic(s) && s->method == METHOD_MPM;
}

/* Chooses the frame of bodies of s with `frame: auto` that cannot use the reference frame (mesh of the undeformed
 * body) or whose scene gives keys of the current frame: they get `current`, with the reason. If no body then has the
 * frame `auto`, marks the keys mpm.shape, mpm.transfer and interface_damping as given, so that scene_echo.c writes
 * them. While a body has the frame `auto` they must not be written: these keys have a meaning in the current frame
 * only, and a scene that gives them requires it. */
void scene_resolve_auto_shape_function_configuration(struct scene *s)
{
    bool open = false;
    s->current_frame_key = current_frame_key(s);
    for (int b = 0; b < s->bodies; b++) {
        struct scene_body *body = &s->body[b];
        if (body->frame == FRAME_AUTO && s->method != METHOD_PD) {
            body->frame_reason = scene_reason_auto_rejects_total_lagrangian_mpm(s, b);
            if (!body->frame_reason) body->frame_reason = s->current_frame_key;
            if (body->frame_reason) body->frame = FRAME_CURRENT;
        }
        open |= body->frame == FRAME_AUTO;
    }
    if (s->levels == LEVELS_AUTO && scene_has_yielding_total_lagrangian_mpm_body(s))
        s->levels = 0; /* cells have one time step */
    if (open) return;
    s->has_shape = s->has_transfer = s->has_interface_damping = true;
    if (s->frame == FRAME_AUTO) s->frame = s->body[0].frame;
}
