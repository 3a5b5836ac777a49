/* Writes the balances of energy and momentum and the results of cracks to summary.json, and saves them in
 * checkpoints. */
#include <math.h>
#include <stdio.h>

#include "fracture/fracture_part.h"
#include "probes/diagnostics.h"
#include "run/part.h"

/* Writes the energies, the external work and the errors of the balances of energy, momentum and angular momentum in l
 * to the JSON object j. */
static void put_energy_balance(struct json *j, const struct energy_balance *l)
{
    json_begin_object_or_list(j, "energy", '{');
    for (int k = 0; k < ENERGIES; k++) json_write_real(j, ledger[k].name, l->energy.of[k]);
    json_write_real(j, ledger[LEDGER_WORK].name, l->external_work);
    json_write_real(j, "balance_error", l->balance_error);
    json_end_object_or_list(j, '}');
    json_write_real(j, "momentum_error", l->momentum_error);
    json_write_real(j, "angular_momentum_error", l->spin_error);
}

/* Writes the time t of an event [s] to j under the key `what`_time. In runs in load steps, which the input file
 * (scene) selects, writes the number of the step of `clock` under `what`_step instead, or nothing if t is NAN. */
static void put_when(struct json *j, const struct scene *scene, const struct run_clock *clock, const char *what, real t)
{
    char key[NAME_MAX_LENGTH];
    const bool in_steps = scene_has_load_steps(scene);
    snprintf(key, sizeof key, "%s_%s", what, in_steps ? "step" : "time");
    if (!in_steps)
        json_write_real(j, key, t);
    else if (!isnan(t))
        json_write_integer(j, key, (int64_t)floor(t / clock->dt + 0.5));
}

/* Writes body, origin, position, growth, angle, times and speeds of the crack tip `tip` to j as an element of a JSON
 * array. Runs in load steps (scene s, clock) have step numbers instead of times, and no speeds. */
static void put_tip(struct json *j, const struct scene *s, const struct run_clock *clock, const struct crack_tip *tip)
{
    const int dim = s->dim;
    json_begin_object_or_list(j, NULL, '{');
    json_write_integer(j, "body", tip->body);
    json_write_point(j, "origin_", tip->origin, dim);
    json_write_point(j, "", tip->place, dim);
    json_write_real(j, "growth", tip->growth);
    json_write_real(j, "angle_deg", dim > 1 ? tip_deflection_angle(tip, dim) : NAN);
    put_when(j, s, clock, "start", tip->start_time);
    put_when(j, s, clock, "arrest", tip->arrest_time);
    if (!scene_has_load_steps(s)) json_write_real(j, "speed_max", tip->speed_max);
    if (!scene_has_load_steps(s)) json_write_real(j, "speed_mean", tip->speed_mean);
    json_end_object_or_list(j, '}');
}

/* Returns the number of broken bonds in b of particles of p with prescribed motion; a bond between two of them counts
 * twice. */
static int64_t driven_bonds(const struct bonds *b, const struct particles *p)
{
    int64_t broken = 0;
    for (int64_t row = 0; row < b->rows; row++)
        if (p->flag[b->particle[row]] & FLAG_DRIVEN) broken += b->broken[row];
    return broken;
}

/* Writes the JSON object "crack" of the run to j: time and position of the first breaks, growth, angle and speeds of
 * the longest crack, and the list of all crack tips. */
static void put_crack(struct json *j, const struct run *run)
{
    const struct crack_tip *longest = tips_find_tip_with_largest_growth(&run->fracture->tips);
    int dim = run->part.dim;
    json_begin_object_or_list(j, "crack", '{');
    put_when(j, run->scene, &run->clock, "start", run->diagnostics->break_time);
    put_when(j, run->scene, &run->clock, "driven_start", run->diagnostics->driven_time);
    if (!isnan(run->diagnostics->driven_time))
        json_write_integer(j, "driven_bonds", driven_bonds(&run->bonds, &run->part));
    if (longest) {
        put_when(j, run->scene, &run->clock, "tip_start", longest->start_time);
        put_when(j, run->scene, &run->clock, "arrest", longest->arrest_time);
        json_write_real(j, "length_end", longest->growth);
        json_write_real(j, "angle_deg", dim > 1 ? tip_deflection_angle(longest, dim) : NAN);
        json_write_integer(j, "tied", tips_count_crack_ends_with_largest_growth(&run->fracture->tips));
    }
    if (longest && !scene_has_load_steps(run->scene)) {
        json_write_real(j, "tip_speed_max", longest->speed_max);
        json_write_real(j, "tip_speed_mean", longest->speed_mean);
    }
    json_begin_object_or_list(j, "tips", '[');
    for (int k = 0; k < run->fracture->tips.n; k++) put_tip(j, run->scene, &run->clock, &run->fracture->tips.tip[k]);
    json_end_object_or_list(j, ']');
    json_end_object_or_list(j, '}');
}

static void put_balance_and_crack(const struct run *run, struct json *j)
{
    put_energy_balance(j, &run->diagnostics->now);
    put_crack(j, run);
}

static status diagnostics_state(struct run *run, struct archive *a)
{
    return diagnostics_save_or_load(run->diagnostics, a);
}

const struct part part_diagnostics = {PART(diagnostics, diagnostics), .state = diagnostics_state,
                                      .summary = put_balance_and_crack};
