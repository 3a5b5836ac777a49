/* Warnings at the end of a run: energy or angular momentum that is not conserved. */
#include <math.h>
#include <stdio.h>

#include "probes/diagnostics.h"
#include "coupling/coupling_part.h"
#include "step/report.h"
#include "step/shock.h"
#include "run/say.h"
#include "step/checks.h"

#define ENERGY_DOUBTFUL                                                                                                \
    0.05 /* relative error of the energy balance that is reported: 10 times the largest in inputs/ */
#define DAMPED_DOUBTFUL                                                                                                \
    0.1 /* share of energy taken by interface damping that is reported: 3 times the largest in inputs/ */

/* Warns that breaking bonds released more energy than they had stored. */
static void say_released(const struct scene *s, const struct diagnostics *w, struct warnings *to)
{
    char text[320];
    const real released = energy_released(w);
    if (scene_at_rest(s) || released <= ENERGY_DOUBTFUL * w->energy_scale) return;
    snprintf(text, sizeof text,
             "bonds released %.3g J more than they had stored when they broke (energy.fracture %.3g): with model %s, "
             "particles under pressure gain energy as they lose bonds; compare with model: bond, and do not trust "
             "later results",
             released, -released, s->model == MODEL_OSPD ? "ospd" : "mospd");
    warnings_add_and_print(to, text);
}

#define SPIN_DOUBTFUL 0.01 /* relative error of angular momentum that is reported */

/* Warns that the bodies gained or lost angular momentum although no load acts on them. apic: points on the grid use
 * APIC. */
static void say_spin(const struct diagnostics *w, bool apic, struct warnings *to)
{
    const real error = w->now.spin_error;
    char text[360];
    if (!w->turns || !(error > SPIN_DOUBTFUL)) return;
    snprintf(text, sizeof text,
             "%.*f %% of the angular momentum of the bodies is lost or from nowhere (angular_momentum_error)%s",
             error < 0.095, 100 * error,
             apic ? ": mpm.transfer apic leaves some percent to velocity gradients, flip keeps it to 0.1 to 1 %" : "");
    warnings_add_and_print(to, text);
}

/* Returns true if interface damping acts and nothing else in a moving scene damps. */
static bool zone_damps(const struct scene *s, const struct coupling_state *coupling)
{
    return coupling->damping_share > 0 && coupling->zone.points > 0 && !(s->damping > 0) && scene_moves(s);
}

/* Warns that interface damping dissipated more than high-frequency noise. share: of the largest energy [1]. */
static void say_damped(real share, struct warnings *to)
{
    char text[320];
    if (!(share > DAMPED_DOUBTFUL)) return;
    snprintf(text, sizeof text,
             "%.0f %% of the energy was damped at interfaces of bonds and points (energy.damped): interface_damping "
             "takes vibrations with wavelengths of some spacings, which in small bodies are all; interface_damping: 0 "
             "keeps them, as method pd does",
             100 * share);
    warnings_add_and_print(to, text);
}

/* Writes to text a warning that the first bonds broke in a collision at a speed at which the numerical fronts
 * oscillate. Returns false, without text, if no such collision was expected or no bond broke. */
static bool shock_text(const struct scene *s, const struct diagnostics *w, char *text, size_t room)
{
    const struct shock shock = fastest_collision_expected(s);
    if (!(shock.share > 0) || isnan(w->break_time) || s->method == METHOD_MPM) return false;
    snprintf(text, room,
             "the first bond broke at %.4g s, in a collision at %.3g m/s, %.2g times the speed at which the front of "
             "the wave breaks or yields the bodies; stress oscillates by 10 to 30 %% behind the front, so that bonds "
             "can break too early: %s",
             w->break_time, shock.speed, shock.share, shock.remedy);
    return true;
}

void warn_of_imbalance(struct run *e)
{
    const struct diagnostics *w = e->diagnostics;
    const bool apic = e->scene->transfer == TRANSFER_APIC && e->part.n_free > 0;
    const bool round_off = energy_is_round_off(w, e->mass, e->tables.wave_speed);
    const real error = w->now.balance_error;
    char text[640];
    if (e->report->excerpt) return;
    say_spin(w, apic, &e->warnings);
    say_released(e->scene, w, &e->warnings);
    if (zone_damps(e->scene, e->coupling) && !round_off) say_damped(e->damped / w->energy_scale, &e->warnings);
    if (shock_text(e->scene, w, text, sizeof text)) warnings_add_and_print(&e->warnings, text);
    if (scene_at_rest(e->scene) || fabs(error) <= ENERGY_DOUBTFUL || round_off) return;
    snprintf(
        text, sizeof text,
        "%.0f %% of the energy %s (energy.balance_error %.2g)%s; history.csv shows when: do not trust later results",
        100 * fabs(error), error < 0 ? "is lost" : "comes from nowhere", error,
        error < 0 && apic
            ? ": APIC damps what its grid does not resolve, mpm.transfer flip and mpm.frame reference keep it"
            : "");
    warnings_add_and_print(&e->warnings, text);
}

void warn_of_bond_yielding(struct run_report *r, const struct bonds *b, const struct scene *s, struct warnings *to)
{
    bool yields = false;
    if (r->yield_said || !b->plastic_path) return;
    for (int64_t row = 0; row < b->rows && !yields; row++) yields = bond_row_plastic_path(b, row) > 0;
    if (!yields) return;
    const int known = to->n;
    r->yield_said = true;
    warn_of_yielding(s, to);
    warnings_print_new(to, known);
}
