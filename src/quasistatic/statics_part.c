/* Load steps as a part of a run: the row of the table of parts. */
#include <math.h>

#include "sif_cracks.h"
#include "steps_record.h"
#include "toughness.h"

#include "quasistatic/load_steps.h"
#include "run/part.h"
#include "probes/diagnostics.h"
#include "solver/solver.h"

/* Frees the state of load steps (`free` of struct part). */
static void statics_free_all(struct run *e) { statics_free(e->statics), sif_cracks_free(&e->statics->sif); }

#define ROUNDING 0.005 /* relative difference below which two energies are equal to the three digits printed */

/* Warns of materials whose bonds yield before they break, so that a crack dissipates less than elastic bonds would. */
static void warn_of_yielding_bonds(const struct scene *s, const struct family *family, struct warnings *to)
{
    for (int m = 0; m < s->materials && s->model == MODEL_BOND && s->method != METHOD_MPM; m++) {
        const struct material *own = &s->material[m];
        if (!material_yields(own) || !isfinite(own->critical_stretch)) continue;
        const real dissipated = toughness_of_material(family, s->model, own),
                   elastic = family_crack_energy_per_area(family, own);
        if (dissipated < (1 - ROUNDING) * elastic)
            warnings_add(to,
                         "bonds of material %s yield before they break, so that a crack dissipates %.3g J/m^2; elastic "
                         "bonds of the same critical stretch would dissipate %.3g J/m^2",
                         own->name, dissipated, elastic);
    }
}

/* Adds warnings about parts of the scene that a static solution ignores or treats in another way (`warn` of struct
 * part). */
static void warn_of_solver(const struct run *e, struct warnings *to)
{
    const struct scene *s = e->scene;
    if (scene_has_load_steps(s)) warn_of_yielding_bonds(s, &e->source.family, to);
    if (!scene_is_single_equilibrium(s)) return;
    for (int k = 0; k < s->initials; k++)
        if (s->initial[k].sets_velocity || s->initial[k].sets_pulse)
            warnings_add(to, "a static equilibrium has no velocities: the velocities of `initial` are ignored");
    for (int b = 0; b < s->bodies; b++)
        if (dot(s->body[b].velocity, s->body[b].velocity, s->dim) > 0)
            warnings_add(to, "a static equilibrium has no velocities: the velocity of body %s is ignored",
                         s->body[b].name);
    if ((s->bodies > 1 || (s->cracks > 0 && s->method != METHOD_MPM)) && !scene_silences_warning(s, ACCEPT_CONTACT))
        warnings_add(to, "bodies and faces of cracks do not meet in a static equilibrium: they pass through each other "
                         "where they close; if they do not close: accept: [contact]");
    if (e->solver->applied == 0 && field_largest_component(&e->solver->driven, s->dim, e->part.n) == 0)
        warnings_add(to,
                     "nothing loads the body at t = %.4g s, the end of the duration, whose loads this solver applies "
                     "(a load with time: {step: ...} that ends earlier is zero then)",
                     s->duration);
}

/* Writes the summary of load steps: steps, equilibria, energy released (`summary` of struct part). */
static void put_load_steps(const struct run *e, struct json *j)
{
    static const char *const control[] = {
        [CONTROL_LOAD] = "load", [CONTROL_ENERGY] = "energy", [CONTROL_OPENING] = "opening"};
    const struct statics *s = e->statics;
    if (!scene_has_load_steps(e->scene)) return;
    json_open(j, "load_steps", '{');
    json_write_text(j, "control", control[e->scene->steps.control]);
    json_write_integer(j, "steps", e->clock.step);
    json_write_real(j, "load_time", s->t);
    json_write_integer(j, "equilibria", s->solutions);
    json_write_integer(j, "search_directions", s->balance.directions);
    json_write_real(j, "stretch_ratio", s->stretch_ratio);
    json_write_integer(j, "bonds_broken", e->diagnostics->bonds_broken / 2);
    json_write_real(j, "released", s->record.released);
    json_write_real(j, "crack_area", s->record.area);
    json_write_real(j, "release_rate", s->record.area > 0 ? s->record.released / s->record.area : NAN);
    json_close(j, '}');
}

const struct part part_statics = {PART(statics, statics),          .free = statics_free_all,
                                  .columns = statics_list_columns, .record = statics_write_record,
                                  .summary = put_load_steps,       .state = statics_save_or_load,
                                  .warn = warn_of_solver};
