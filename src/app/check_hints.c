/* Writes hints on what would make the run of an input file faster, before it is run. Limits and their basis:
 *
 *   stress       sigma = rho c v ahead of a part that moves with v. Waves of both ends superpose and reflect:
 *                four times sigma, unless they cross the body more than PASSAGES times, as long waves add up
 *   strain       cells that keep their points suit bodies strained by less than LITTLE
 *   bonds        time of a bond and step by model and dimension (`cleave bench kernels`, AVX-512, one core)
 */
#include <math.h>
#include <string.h>

#include "check_parts.h"
#include "mesh/mesh_part.h"
#include "probes/probes_part.h"

#define REACHED 4  /* stress that a driven part may reach, divided by rho c v (see `stress`) [1] */
#define PASSAGES 4 /* passages of waves through a body up to which its stress is estimated */
#define LITTLE 0.1 /* strain below which the reference frame is suggested */
/* Processor time per bond and step by peridynamic model [ns]: in 2D, in 3D. */
static const real bond_ns[][3] = {
    [MODEL_BOND] = {0.44, 0.55}, [MODEL_OSPD] = {0.75, 0.86}, [MODEL_MOSPD] = {1.05, 2.2}};

/* Adds a hint to *to if scene s uses a state-based model with a Poisson's ratio that the cheaper bond-based model also
 * has (1/3 in plane stress, 1/4 in plane strain and 3D), to within 1e-3 in all materials. Adds none in 1D and for
 * method mpm. */
static void hint_model(const struct scene *s, struct warnings *to)
{
    const real wanted = bond_based_poisson_ratio(s->space);
    if (s->model == MODEL_BOND || s->dim == 1 || s->method == METHOD_MPM) return;
    for (int m = 0; m < s->materials; m++)
        if (fabs(s->material[m].poisson - wanted) > 1e-3) return;
    warnings_add_if_new(to,
                        "model: bond also has the Poisson's ratio of this scene, %.4g, and takes only %.0f %% of the "
                        "time of %s; set it",
                        wanted, 100 * bond_ns[MODEL_BOND][s->dim - 2] / bond_ns[s->model][s->dim - 2],
                        s->model == MODEL_OSPD ? "ospd" : "mospd");
}

/* Returns an upper estimate of the stress in the run [Pa]: REACHED (rho c v + traction) plus the stress of initial
 * strains, with density rho, wave speed c and the range v of initial and prescribed velocities. Returns INFINITY if no
 * estimate is possible: for body forces, tables in time, formulas, rotating supports, and runs in which waves cross the
 * body more than PASSAGES times. */
static real stress_reached(const struct run *run)
{
    const struct scene *s = run->scene;
    real low[DIM_MAX] = {0}, high[DIM_MAX] = {0}, speed2 = 0, density = 0, traction = 0;
    if (run->tables.wave_speed * s->duration > PASSAGES * particles_bounding_box_longest_edge(&run->part))
        return INFINITY;
    for (int64_t i = 0; i < run->part.n; i++)
        for (int d = 0; d < s->dim; d++)
            low[d] = real_min(low[d], run->part.v[d][i]), high[d] = real_max(high[d], run->part.v[d][i]);
    for (int b = 0; b < s->boundaries; b++) {
        const struct boundary *a = &s->boundary[b];
        const bool formula = a->formula[0].n + a->formula[1].n + a->formula[2].n > 0;
        if (a->kind == BOUNDARY_BODY_FORCE || a->time.kind == TIME_TABLE || formula || a->rotates) return INFINITY;
        for (int d = 0; d < s->dim && a->kind == BOUNDARY_VELOCITY; d++)
            if (a->components & 1 << d) {
                const real steep = a->displaces ? time_function_largest_slope_until(&a->time, s->duration) : 1;
                const real speed = a->value[d] == 0 ? 0 : steep * a->value[d];
                low[d] = real_min(low[d], speed), high[d] = real_max(high[d], speed);
            }
        for (int d = 0; d < s->dim && a->kind == BOUNDARY_TRACTION; d++) traction += fabs(a->value[d]);
        if (a->kind == BOUNDARY_PRESSURE) traction += fabs(a->value[0]);
    }
    for (int d = 0; d < s->dim; d++) speed2 += square(high[d] - low[d]);
    for (int m = 0; m < s->materials; m++) density = real_max(density, s->material[m].density);
    return REACHED * (density * run->tables.wave_speed * sqrt(speed2) + traction) + run->probing->strain_stress;
}

/* Adds a hint to *to for each body of the run whose shape functions are evaluated at the present positions of its
 * material points although the faster evaluation at reference positions is possible, and would not be refused by
 * mpm.frame: auto. */
static void hint_frame(const struct run *run, struct warnings *to)
{
    const real reached = stress_reached(run);
    for (int b = 0; b < run->scene->bodies; b++) {
        char text[80] = "";
        real strain = 0;
        for (int m = 0; m < run->scene->materials; m++)
            if (scene_body_can_have_material(&run->scene->body[b], m))
                strain = real_max(strain, reached / run->scene->material[m].young);
        if (run->frame->choice[b].reference || scene_reason_auto_rejects_total_lagrangian_mpm(run->scene, b)) continue;
        if (!lagrangian_mesh_can_be_made_for_scene(run->frame, &run->part, run->scene, run->grid)) continue;
        if (strain < LITTLE) snprintf(text, sizeof text, ", and waves strain it by at most %.2g", strain);
        warnings_add_if_new(to,
                            "body %s touches no other body%s%s: set mpm.frame: %s in place of current, which reduces "
                            "the computing time of its material points to a tenth to a thirtieth",
                            run->scene->body[b].name, run->scene->rigids > 0 ? " except rigid ones" : "", text,
                            run->scene->current_frame_key ? "reference" : "auto");
    }
}

static bool has_notch(const struct scene *s)
{
    bool notch = s->cracks > 0;
    for (int b = 0; b < s->bodies; b++)
        for (int k = 0; k < s->body[b].shape.n; k++) notch |= s->body[b].shape.solid[k].subtract;
    return notch;
}

/* Adds a hint to *to if the input file of the run uses a peridynamic method although no bond can break, so that the
 * method mpm suffices. Input files with rigid bodies are excepted, since material points do not support contact with
 * them. */
static void hint_method(const struct run *run, struct warnings *to)
{
    const struct scene *s = run->scene;
    const char *method = s->method == METHOD_PD ? "pd" : "adaptive";
    real weakest = INFINITY;
    if (s->method == METHOD_MPM || !scene_is_dynamic(s) || has_notch(s)) return;
    if (s->bodies > 1 || s->rigids > 0) return;
    for (int m = 0; m < s->materials; m++)
        weakest = real_min(weakest, s->material[m].young * s->material[m].onset_stretch);
    const real reached = stress_reached(run);
    if (isinf(weakest))
        warnings_add_if_new(to,
                            "no bond can break: there is no crack and no energy_release_rate, toughness or "
                            "critical_stretch; method: mpm is enough and faster; set it in place of %s",
                            method);
    else if (reached < weakest)
        warnings_add_if_new(to,
                            "stress in waves is at most %.3g Pa, but bonds break at %.3g Pa: method: mpm is enough and "
                            "faster; set it in place of %s",
                            reached, weakest, method);
}

/* Adds a hint to *to that names the planes about which the input file of the run is symmetric, so that a part of the
 * body can be computed instead. Adds none without such planes. */
static void hint_symmetry(const struct run *run, struct warnings *to)
{
    static const char *const share[] = {"", "half", "a quarter", "an eighth"};
    char planes[160] = "";
    int n = 0;
    for (int axis = 0; axis < run->part.dim && run->part.dim > 1; axis++) {
        const size_t used = strlen(planes);
        real at;
        if (!run_is_symmetric_about_mid_plane(run, axis, &at)) continue;
        snprintf(planes + used, sizeof planes - used, "%s%c = %.6g m", n++ ? " and " : "", 'x' + axis, at);
    }
    if (n > 0)
        warnings_add_if_new(
            to,
            "the scene is symmetric about %s (all %lld particles, cracks and loads): %s of the body with a "
            "boundary `mirror` %s would take %s of the time",
            planes, (long long)run->part.n, share[n], n > 1 ? "at each plane" : "there", share[n]);
}

void hint_needless_cost_and_unused_settings(const struct run *run, struct warnings *warning_list)
{
    hint_precrack_ends_exactly_on_bonds(run, warning_list);
    hint_model(run->scene, warning_list);
    hint_frame(run, warning_list);
    hint_method(run, warning_list);
    hint_symmetry(run, warning_list);
    hint_implausible_load_signs_and_magnitudes(run, warning_list);
    hint_keys_without_effect(run->scene, warning_list);
}
