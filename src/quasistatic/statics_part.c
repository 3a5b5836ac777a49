/* Registers load steps with the engine: defines their callbacks for output, warnings, checkpoints and release (struct
 * part in run/part.h). */
#include <math.h>

#include "crack_increment.h"
#include "sif_cracks.h"
#include "softening_step.h"
#include "steps_record.h"
#include "toughness.h"

#include "quasistatic/load_steps.h"
#include "run/part.h"
#include "probes/diagnostics.h"
#include "solver/solver.h"

/* Frees the state of load steps of the run. It is the callback `free` of struct part. */
static void statics_free_all(struct run *run) { statics_free(run->statics), sif_cracks_free(&run->statics->sif); }

#define STEP_SPACINGS_MOST 0.5 /* growth of a crack in a load step without a warning [spacings] */
#define ALIKE 1.05     /* ratio up to which two such growths count as equal: lattices spend 1 to 4 % less than G_c */
#define ROUNDING 0.005 /* relative difference below which two energies are equal to the three digits printed */

/* Adds a warning to *to for each material of scene s whose bonds yield before they break, so that a crack dissipates
 * less than elastic bonds would. family: neighbours of a particle, from which the critical stretch follows. */
static void warn_of_yielding_bonds(const struct scene *s, const struct family *family, struct warnings *to)
{
    for (int m = 0; m < s->materials && s->model == MODEL_BOND && s->method != METHOD_MPM; m++) {
        const struct material *own = &s->material[m];
        if (!material_yields(own) || !isfinite(own->critical_stretch)) continue;
        const real dissipated = toughness_of_material(family, s->model, own),
                   elastic = family_energy_release_rate_at_critical_stretch(family, own);
        if (dissipated < (1 - ROUNDING) * elastic)
            warnings_add_if_new(to,
                                "bonds of material %s yield before they break, so a crack dissipates %.3g J/m^2, less "
                                "than the %.3g J/m^2 of elastic bonds of the same critical stretch; to dissipate more, "
                                "raise energy_release_rate or critical_stretch",
                                own->name, dissipated, elastic);
    }
}

/* Adds to `to` a warning if the softening bonds of scene s, under energy control, dissipate more energy in a load step
 * than STEP_SPACINGS_MOST spacings of new crack need. of_spacing: energy of one spacing of crack [J]. Reason: with edge
 * notches of 0.5 to 1.5 mm in glass, at spacings of 0.05 and 0.1 mm, the largest load differs from that in steps of a
 * twentieth of a spacing by +-4 % for steps of half a spacing, 8 % for one, 15 % for two, 23 % for four. */
static void warn_of_large_steps(const struct scene *s, real of_spacing, struct warnings *to)
{
    const real given = s->steps.energy, spacings = given / of_spacing;
    if (s->steps.control != CONTROL_ENERGY || !(given > 0)) return;
    if (spacings <= ALIKE * STEP_SPACINGS_MOST) return;
    warnings_add_if_new(
        to,
        "steps.energy: one load step dissipates as much energy as a crack that grows by %.3g spacings, so the largest "
        "load may be off by %s; set steps.energy to at most %.3g J (the default is less) for an error within 4 %%",
        spacings,
        spacings <= ALIKE       ? "8 %"
        : spacings <= 2 * ALIKE ? "15 %"
                                : "20 % and more",
        STEP_SPACINGS_MOST * given / spacings);
}

/* Adds warnings to *to. In load steps it warns of bonds that yield, and of steps that dissipate too much energy; for a
 * single equilibrium, of keys of the input file (scene) of the run that the solution ignores or treats differently. It
 * is the callback `warn` of struct part. */
static void warn_of_solver(const struct run *run, struct warnings *to)
{
    const struct scene *s = run->scene;
    if (scene_has_load_steps(s)) warn_of_yielding_bonds(s, &run->source.family, to);
    if (scene_has_load_steps(s) && run->bonds.soft.curve)
        warn_of_large_steps(
            s, softening_materials_least_toughness(s, &run->source) * crack_area_of_growth_by_one_spacing(run), to);
    if (!scene_is_single_equilibrium(s)) return;
    for (int k = 0; k < s->initials; k++)
        if (s->initial[k].sets_velocity || s->initial[k].sets_pulse)
            warnings_add_if_new(to, "a static equilibrium has no velocities: those of `initial` are ignored; remove "
                                    "them, or set solver: explicit");
    for (int b = 0; b < s->bodies; b++)
        if (dot(s->body[b].velocity, s->body[b].velocity, s->dim) > 0)
            warnings_add_if_new(to,
                                "a static equilibrium has no velocities: that of body %s is ignored; remove it, or set "
                                "solver: explicit",
                                s->body[b].name);
    if (s->bodies > 1 && !scene_silences_warning(s, ACCEPT_CONTACT))
        warnings_add_if_new(
            to, "bodies have no contact in a static equilibrium: they pass through each other where gaps close; for "
                "contact use load steps (solver: static); if no gap closes, add accept: [contact]");
    if (run->solver->applied == 0 && field_largest_absolute_component(&run->solver->driven, s->dim, run->part.n) == 0)
        warnings_add_if_new(
            to,
            "nothing loads the body at t = %.4g s, the end of the duration, and this solver applies the loads of that "
            "time; check the key time of the loads (one with time: {step: ...} that ends earlier is zero then)",
            s->duration);
}

/* Writes the results of load steps of the run to the summary j: control, steps, equilibria, energy released. Does
 * nothing for other runs. It is the callback `summary` of struct part. */
static void put_load_steps(const struct run *run, struct json *j)
{
    static const char *const control[] = {
        [CONTROL_LOAD] = "load", [CONTROL_ENERGY] = "energy", [CONTROL_OPENING] = "opening"};
    const struct statics *s = run->statics;
    if (!scene_has_load_steps(run->scene)) return;
    json_begin_object_or_list(j, "load_steps", '{');
    json_write_text(j, "control", control[run->scene->steps.control]);
    json_write_integer(j, "steps", run->clock.step);
    json_write_real(j, "load_time", s->t);
    json_write_integer(j, "equilibria", s->solutions);
    json_write_integer(j, "search_directions", s->balance.directions);
    json_write_real(j, "stretch_ratio", s->stretch_ratio);
    if (run->part.plastic_correction[0]) json_write_real(j, "flow_turn", s->turn.angle);
    json_write_integer(j, "bonds_broken", run->diagnostics->bonds_broken / 2);
    json_write_real(j, "released", s->record.released);
    json_write_real(j, "crack_area", s->record.face);
    json_write_real(j, "release_rate", s->record.area > 0 ? s->record.released / s->record.area : NAN);
    json_end_object_or_list(j, '}');
}

const struct part part_statics = {PART(statics, statics),
                                  .free = statics_free_all,
                                  .columns = statics_list_history_columns,
                                  .record = statics_compute_history_values,
                                  .summary = put_load_steps,
                                  .state = load_steps_save_or_load_state,
                                  .warn = warn_of_solver};
