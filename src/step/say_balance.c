/* Warnings at the end of a run: energy or angular momentum that is not conserved, cracks faster than waves. */
#include <math.h>
#include <stdio.h>

#include "probes/diagnostics.h"
#include "coupling/coupling_part.h"
#include "fracture/tips.h"
#include "step/report.h"
#include "step/shock.h"
#include "run/say.h"
#include "step/checks.h"

/* Relative error of the energy balance above which a warning is given [1]: 10 times the largest error of the input
 * files in inputs/. */
#define ENERGY_DOUBTFUL 0.05
/* Relative error of the energy balance above which a warning is given for yielding material points on the grid [1].
 * Bars of several diameters that hit a wall have smaller errors, shorter bars errors up to three times as large. */
#define FLOW_DOUBTFUL 0.003
/* Energy that broken bonds have released beyond what they had stored, relative to the largest energy, above which a run
 * warns [1]. It is far above round-off, and a fifth of the error of the energy balance that tests/scenes allow for
 * peridynamics. */
#define RELEASED_NOTICED 1e-3
#define FAST_TIP 5 /* least growth of a tip whose speed is judged [spacings]: the speed of a shorter one varies */
/* Fraction of the largest energy that interface damping dissipates, above which a warning is given [1]: 3 times the
 * largest fraction in inputs/. */
#define DAMPED_DOUBTFUL 0.1

/* Warns that breaking bonds released more energy than they had stored, if the excess is above ENERGY_DOUBTFUL of the
 * largest energy. Does nothing for a single equilibrium. s: scene, for the advice; diagnostics: energies of the run;
 * to: list of warnings. */
static void say_released(const struct scene *s, const struct diagnostics *diagnostics, struct warnings *to)
{
    char text[320];
    const real released = diagnostics_bond_energy_release_beyond_stored(diagnostics);
    if (scene_is_single_equilibrium(s) || released <= ENERGY_DOUBTFUL * diagnostics->energy_scale) return;
    snprintf(
        text, sizeof text,
        "broken bonds released %.3g J more than they had stored (energy.fracture %.3g): with model %s, particles under "
        "pressure gain energy when they lose bonds; compare with model: bond, and do not trust later results",
        released, -released, s->model == MODEL_OSPD ? "ospd" : "mospd");
    warnings_add_and_print(to, text);
}

bool fracture_energy_warn_if_negative(const struct scene *s, const struct diagnostics *diagnostics,
                                      struct warnings *warning_list)
{
    char text[480];
    const real released = diagnostics_bond_energy_release_beyond_stored(diagnostics);
    const bool states = s->model == MODEL_OSPD || s->model == MODEL_MOSPD;
    if (!(released > RELEASED_NOTICED * diagnostics->energy_scale)) return false;
    snprintf(
        text, sizeof text,
        "the fracture energy has fallen below 0, to %.3g J at t = %.4g s, %.2g %% of the largest energy: broken bonds "
        "have released more energy than they had stored, so bodies move too fast%s; see energy.fracture at the end",
        -released, diagnostics->now.time, 100 * released / diagnostics->energy_scale,
        states ? " (particles under pressure gain energy when they lose bonds); compare with model: bond" : "");
    warnings_add_and_print(warning_list, text);
    return true;
}

/* Smallest error of the energy balance, relative to the largest energy [1], of which say_flight warns: smaller errors
 * are those of the work of loads. Chosen by judgement. */
#define FLIGHT_LEAST 1e-3

/* Warns, in runs with points on the grid, of an error of the energy balance that is small relative to the largest
 * energy (FLIGHT_LEAST to ENERGY_DOUBTFUL) but not without the kinetic energy of the common motion of all particles p.
 * While bodies fly through cells of the grid, stress gains energy unless points are mapped ahead of their positions
 * (field_set_flight): with linear shapes a block of 40 x 20 points at 200 m/s gains a fifth in eleven cells.
 * diagnostics: energies of the run; to: list of warnings. Returns true if it warns. */
static bool say_flight(const struct particles *p, const struct diagnostics *diagnostics, struct warnings *to)
{
    const real error = diagnostics->now.balance_error, amount = fabs(error) * diagnostics->energy_scale;
    char text[420];
    if (p->n_free == 0 || fabs(error) > ENERGY_DOUBTFUL || fabs(error) < FLIGHT_LEAST) return false;
    if (!(amount > ENERGY_DOUBTFUL * diagnostics->internal_scale)) return false;
    snprintf(text, sizeof text,
             "energy of %.2g J, which is %.2g %% of all energy except that of free flight, %s (energy.balance_error "
             "%.2g), because the stress of material points is wrong while they fly through cells of the grid; let "
             "bodies start close to each other, halve the time step (time.safety), or use mpm.frame: reference",
             amount, 100 * amount / diagnostics->internal_scale,
             error < 0 ? "is lost" : "has been gained without work of loads", error);
    warnings_add_and_print(to, text);
    return true;
}

#define SPIN_DOUBTFUL 0.01 /* relative error of angular momentum from which on it is reported [1] */
/* Ratio of angular momentum to momentum times spacing up to which angular momentum is round-off [1]. */
#define SPIN_OF_ROUND_OFF 1e-9

/* Warns that the bodies gained or lost angular momentum although no load acts on them, if the relative error exceeds
 * SPIN_DOUBTFUL and the angular momentum is no round-off. diagnostics: sums of the run; apic: true if points on the
 * grid use APIC; spacing: distance of particles [m]; to: list of warnings. */
static void say_spin(const struct diagnostics *diagnostics, bool apic, real spacing, struct warnings *to)
{
    const real error = diagnostics->now.spin_error;
    char text[360];
    if (!diagnostics->turns || !(error > SPIN_DOUBTFUL)) return;
    if (diagnostics->spin_scale < SPIN_OF_ROUND_OFF * diagnostics->momentum_scale * spacing) return;
    snprintf(text, sizeof text,
             "the angular momentum of the bodies has changed by %.*f %%, although loads have no moment "
             "(angular_momentum_error); %s",
             error < 0.095, 100 * error,
             apic ? "use mpm.transfer: flip, which conserves it to 0.1 to 1 % (apic: to a few percent)"
                  : "do not trust results that depend on rotation");
    warnings_add_and_print(to, text);
}

/* Returns true if interface damping is the only damping of the dynamic scene s, and the zone of `coupling` in which it
 * acts, at the interface of bonds and points, contains material points. */
static bool zone_damps(const struct scene *s, const struct coupling_state *coupling)
{
    return coupling->damping_share > 0 && coupling->zone.points > 0 && !(s->damping > 0) && scene_is_dynamic(s);
}

/* Warns that interface damping dissipated much energy, if share > DAMPED_DOUBTFUL. share: ratio of the dissipated
 * energy to the largest energy of the run [1]; to: list of warnings. */
static void say_damped(real share, struct warnings *to)
{
    char text[320];
    if (!(share > DAMPED_DOUBTFUL)) return;
    snprintf(text, sizeof text,
             "%.0f %% of the energy was damped at interfaces between bonds and material points (energy.damped): "
             "interface_damping removes vibrations with wavelengths of a few spacings, in small bodies all vibrations; "
             "use interface_damping: 0 or method: pd to keep them",
             100 * share);
    warnings_add_and_print(to, text);
}

/* Writes a warning to text[capacity] that the first bonds broke in a collision so fast that stress oscillates behind
 * the front. Returns false, without text, if no such collision was expected, no bond broke, or the scene s silences the
 * warning. diagnostics: time of the first break. */
static bool shock_text(const struct scene *s, const struct diagnostics *diagnostics, char *text, size_t capacity)
{
    const struct shock shock = scene_find_collision_closest_to_damage(s);
    if (!(shock.share > 0) || isnan(diagnostics->break_time) || s->method == METHOD_MPM ||
        scene_silences_warning(s, ACCEPT_SHOCK))
        return false;
    snprintf(text, capacity,
             "the first bond broke at %.4g s, in a collision at %.3g m/s, %.3g times the speed at which the stress of "
             "the wave front reaches the strength or yield stress of a body. Behind the front stress oscillates by 10 "
             "to 30 %%, so bonds may break too early: %s; if this is intended, add accept: [shock]",
             diagnostics->break_time, shock.speed, shock.share, shock.remedy);
    return true;
}

void warn_of_tips_above_rayleigh_speed(const struct crack_tips *t, const struct scene *s, struct warnings *warning_list)
{
    const struct crack_tip *fastest = NULL;
    char text[500];
    real limit = 0;
    for (int m = 0; m < s->materials; m++) limit = real_max(limit, s->material[m].rayleigh_speed);
    if (limit == 0 || !scene_is_dynamic(s) || scene_silences_warning(s, ACCEPT_RAYLEIGH)) return;
    for (int k = 0; k < t->n; k++) {
        const struct crack_tip *tip = &t->tip[k];
        if (tip->growth < FAST_TIP * t->spacing || !(tip->speed_max > limit + t->spacing / t->window)) continue;
        if (!fastest || tip->speed_max > fastest->speed_max) fastest = tip;
    }
    if (!fastest) return;
    snprintf(text, sizeof text,
             "the tip of a crack, from (%s) to (%s) m, moves at up to %.4g m/s within %.3g s "
             "(crack.speed_window), faster than Rayleigh waves, %.4g m/s, the limit for a crack that opens: it may be "
             "the edge of a zone that breaks at once, for example beside a face under load; look at damage in the "
             "frames; if this is intended, add accept: [rayleigh]",
             position_text(fastest->origin, t->dim, 6).text, position_text(fastest->place, t->dim, 6).text,
             fastest->speed_max, t->window, limit);
    warnings_add_and_print(warning_list, text);
}

/* Warns in a run of scene s with yielding material points of p on the grid that the energy balance has an error, and
 * advises how to reduce it. Does nothing unless |error| is between FLOW_DOUBTFUL and ENERGY_DOUBTFUL, above which
 * another warning is given. APIC loses more energy with more time steps; other errors decrease with the time step.
 * (Measured: bars that hit a wall at 190 m/s gain 0.27 to 0.85 % at 0.8 of the critical time step, -0.01 to 0.14 % at
 * 0.5.) error: relative error [1], positive if energy is gained; dt: time step [s]; to: list of warnings. */
static void say_flow_error(const struct particles *p, const struct scene *s, real dt, real error, struct warnings *to)
{
    char text[360];
    if (!p->plastic_strain || p->n_free == 0 || !scene_is_dynamic(s)) return;
    if (!(fabs(error) > FLOW_DOUBTFUL) || fabs(error) > ENERGY_DOUBTFUL) return;
    if (error < 0 && s->transfer == TRANSFER_APIC)
        snprintf(text, sizeof text,
                 "%.2g %% of the energy is lost (energy.balance_error %.2g): APIC damps motion that its grid does not "
                 "resolve, more with smaller steps; use mpm.transfer: flip to keep it",
                 100 * fabs(error), error);
    else
        snprintf(text, sizeof text,
                 "%.2g %% of the energy is %s (energy.balance_error %.2g): transfers between the grid and points that "
                 "yield have errors that grow with the time step; half the time step (time.step: %.2g s, or a smaller "
                 "time.safety) reduces the error to about 0.6 times or less",
                 100 * fabs(error), error < 0 ? "lost" : "gained without work of loads", error, 0.5 * dt);
    warnings_add_and_print(to, text);
}

/* Warns of the error of the energy balance in a run with load steps. The external work of a load step is integrated
 * along the path of the solver, which is inexact where material yields unevenly within the step. (Measured: an error of
 * 0.02 % with 4 load steps for bars with Voce's law at a strain of 0.03; 5 % in one step for metals that soften by
 * heat.) error: relative error [1]; to: list of warnings. */
static void say_work_error(real error, struct warnings *to)
{
    char text[320];
    snprintf(text, sizeof text,
             "%.2g %% of the energy %s (energy.balance_error %.2g): the work of loads is wrong if a large part of the "
             "body yields in a single load step; use more load steps (steps.number)",
             100 * fabs(error), error < 0 ? "is lost" : "has been gained without work of loads", error);
    warnings_add_and_print(to, text);
}

void run_warn_of_unconserved_energy_and_momentum(struct run *run)
{
    const struct diagnostics *diagnostics = run->diagnostics;
    const bool apic = run->scene->transfer == TRANSFER_APIC && run->part.n_free > 0;
    const bool round_off = diagnostics_energies_are_only_round_off(diagnostics, run->mass, run->tables.wave_speed);
    const real error = diagnostics->now.balance_error;
    char text[640];
    if (run->report->excerpt) return;
    say_spin(diagnostics, apic, run->scene->spacing, &run->warnings);
    say_released(run->scene, diagnostics, &run->warnings);
    if (zone_damps(run->scene, run->coupling) && !round_off)
        say_damped(run->damped / diagnostics->energy_scale, &run->warnings);
    if (shock_text(run->scene, diagnostics, text, sizeof text)) warnings_add_and_print(&run->warnings, text);
    if (!round_off && !say_flight(&run->part, diagnostics, &run->warnings))
        say_flow_error(&run->part, run->scene, run->clock.dt, error, &run->warnings);
    if (scene_is_single_equilibrium(run->scene) || fabs(error) <= ENERGY_DOUBTFUL || round_off) return;
    if (scene_has_load_steps(run->scene) && run->part.plastic_strain) {
        say_work_error(error, &run->warnings);
        return;
    }
    snprintf(
        text, sizeof text,
        "%.0f %% of the energy %s (energy.balance_error %.2g)%s; history.csv shows the time at which it began: do not "
        "trust later results",
        100 * fabs(error), error < 0 ? "is lost" : "has been gained without work of loads", error,
        error < 0 && apic
            ? scene_reason_not_to_advise_total_lagrangian_mpm(run->scene)
                  ? ": APIC damps motion that its grid does not resolve; use mpm.transfer: flip to keep it"
                  : ": APIC damps motion that its grid does not resolve; use mpm.transfer: flip or mpm.frame: "
                    "reference to keep it"
            : "");
    warnings_add_and_print(&run->warnings, text);
}

void warn_when_bonds_first_yield(struct run_report *r, const struct bonds *b, const struct scene *s,
                                 struct warnings *warning_list)
{
    bool yields = false;
    if (r->yield_said || !b->plastic_path) return;
    for (int64_t row = 0; row < b->rows && !yields; row++) yields = bond_row_plastic_path(b, row) > 0;
    if (!yields) return;
    const int known = warning_list->n;
    r->yield_said = true;
    warn_that_bond_plasticity_is_not_von_mises(s, warning_list);
    warnings_print_to_stderr(warning_list, known);
}
