/* Load steps: the body is led through states of equilibrium, and its crack advances between them (advance.c). */
#include <math.h>
#include <stdio.h>

#include "advance.h"
#include "balance.h"
#include "led.h"
#include "load_size.h"
#include "pieces.h"
#include "springs.h"
#include "steps_record.h"
#include "system.h"
#include "touch.h"
#include "trial.h"

#include "contact/contact.h"
#include "fracture/sif_fields.h"
#include "mesh/mesh_part.h"
#include "probes/diagnostics.h"
#include "quasistatic/load_steps.h"
#include "rigid/rigid_part.h"
#include "run/say.h"
#include "step/report.h"
#include "step/sample.h"

#define OPENING_ERROR 1e-4 /* of an opening that is prescribed */
#define FAR_BEYOND 1.2     /* overload from which on loads are too large to begin with */
#define NEAR_LIMIT 0.95    /* overload at which an advance is looked for instead */
#define NEAR_LEAST 0.85    /* overload from which on loads cannot come much nearer */
#define ROUND_OFF 1e-6     /* of loads that are the same */
#define THROUGH 1e-2       /* share of the largest loads below which nothing is left of what a crack had to cut */
#define FAR_OFF 2.0        /* from the place of an opening to the body [spacings] */
enum { SECANTS_MOST = 12, APPROACHES_MOST = 12 };

/* ---- control ----------------------------------------------------------------------------------------------------- */

/* Size of the loads at which the advance ahead comes while they grow: of the first one that at which a pre-crack is in
 * balance; of later ones that at which they pay for themselves, so that loads swing about those of a crack that grows
 * evenly. */
static real size_to_come(const struct statics *s, const struct diagnostics *diagnostics)
{
    return diagnostics->bonds_broken > 0 ? real_max(s->due, size_of_advance(&s->ahead)) : s->due;
}

/* A state that loads have led to: it counts for the largest forces. */
static void state_note(struct run *e)
{
    sample_probes(e);
    for (int k = 0; k < e->scene->rigids; k++) rigid_note(&e->rigid->body[k]);
}

/* Goes to loads of this size, between two pseudo-times. */
static status go_to_size(struct run *e, real size, real least, real most)
{
    return statics_go(e, real_min(real_max(statics_time_of_size(e, size), least), most));
}

/* Goes to t, or where bonds come near their limits before it, there: far beyond them energies are those of a body that
 * would long have broken, what an advance releases drowns in their round-off, and bonds have yielded that never would.
 * Looks for what advances. */
static status approach_loads(struct run *e, real t)
{
    struct statics *s = e->statics;
    const real from = s->t, low = statics_load_size(e, from), at_low = s->overload;
    bool far = true;
    for (int k = 0; k < APPROACHES_MOST && far; k++) {
        struct memory_archive saved;
        trial_begin(e, &saved);
        const status gone = statics_go(e, t);
        far = gone == OK && s->overload > FAR_BEYOND && at_low < NEAR_LEAST;
        if (far) {
            const real share = (NEAR_LIMIT - at_low) / (s->overload - at_low);
            t = real_max(from, statics_time_of_size(e, low + share * (statics_load_size(e, t) - low)));
            trial_undo(e, &saved, NULL);
        } else
            memory_archive_free(&saved);
        TRY(gone);
    }
    if (far) TRY(statics_go(e, t));
    TRY(statics_convert(e, 0));
    return statics_look_ahead(e);
}

/* The advance ahead, at the loads at which it comes or, where it would have come under less, under those of the one
 * before it, *size; what supports bear there counts for their largest force. Before the pseudo-time t, if loads get
 * there. */
static status advance_under_loads(struct run *e, real *size, real from, real t)
{
    struct statics *s = e->statics;
    const bool follows = size_to_come(e->statics, e->diagnostics) <= *size;
    *size = real_max(*size, size_to_come(e->statics, e->diagnostics));
    const real loads = statics_load_size(e, t);
    const bool pays = size_of_advance(&s->ahead) <= *size, within = *size < loads;
    if (within)
        TRY(go_to_size(e, *size, from, t));
    else if (s->t < t && loads >= *size * (1 - ROUND_OFF))
        TRY(statics_go(e, t));
    state_note(e);
    if (follows && e->scene->steps.then == THEN_EXPLICIT)
        TRY(statics_release(e));
    else
        TRY(pays ? statics_advance(e) : statics_advance_balanced(e));
    if (!pays) TRY(within ? go_to_size(e, *size, from, t) : statics_go(e, t));
    return statics_look_ahead(e);
}

/* Pseudo-time grows to t; on the way the crack advances as long as that pays. Loads that fall have no way back. */
static status step_by_load(struct run *e, real t)
{
    struct statics *s = e->statics;
    const real from = s->t, loads = statics_load_size(e, t);
    real size = statics_load_size(e, from);
    for (;;) {
        const bool due = s->next.n > 0 &&
                         size_to_come(e->statics, e->diagnostics) <= real_max(loads, s->t >= t ? 0 : size) * (1 + 1e-9);
        if (due)
            TRY(advance_under_loads(e, &size, from, t));
        else if (s->t < t)
            TRY(approach_loads(e, t));
        else
            return OK;
    }
}

/* One advance of the crack, then the pseudo-time at which the next one is due; as long as none is, as much pseudo-time
 * as the duration has for a step. */
static status step_by_energy(struct run *e, real most)
{
    struct statics *s = e->statics;
    const real t = real_min(s->t + most, e->scene->duration);
    if (s->advances) TRY(statics_advance_balanced(e));
    TRY(statics_look_ahead(e));
    if (s->severs) return OK;
    if (s->next.n == 0) TRY(approach_loads(e, t));
    if (s->severs) return OK;
    s->advances = s->next.n > 0 && statics_load_size(e, t) >= s->due;
    if (s->next.n > 0) TRY(statics_go(e, s->advances ? statics_time_of_size(e, s->due) : t));
    s->record.load_most = real_max(s->record.load_most, statics_load_size(e, s->t));
    s->severs = s->advances && s->due < THROUGH * s->record.load_most;
    return OK;
}

/* How far the places of control opening have moved apart [m]. */
static real opening_now(const struct particles *part, const struct statics *statics)
{
    real now = 0, was = 0;
    for (int d = 0; d < part->dim; d++) {
        const int64_t a = statics->opens[0], b = statics->opens[1];
        now += square(part->x[d][b] - part->x[d][a]);
        was += square(part->X[d][b] - part->X[d][a]);
    }
    return sqrt(now) - sqrt(was);
}

/* Goes to the pseudo-time at which the opening has this width [m], by secants from `t` [s] on. */
static status open_to(struct run *e, real wanted, real t)
{
    real from = e->statics->t, at_from = opening_now(&e->part, e->statics);
    for (int k = 0; k < SECANTS_MOST; k++) {
        TRY(statics_go(e, real_max(t, 0)));
        const real at = opening_now(&e->part, e->statics), slope = (at - at_from) / (e->statics->t - from);
        if (fabs(at - wanted) <= OPENING_ERROR * fabs(wanted) || e->statics->t == from || !(slope != 0)) return OK;
        from = e->statics->t, at_from = at;
        t = from + (wanted - at) / slope;
    }
    return OK;
}

/* Does the advance ahead come before the opening is as wide as wanted? Both grow with the loads. */
static bool comes_before(const struct run *e, real wanted)
{
    const struct statics *s = e->statics;
    const real now = opening_now(&e->part, e->statics), size = statics_load_size(e, s->t);
    return s->next.n > 0 && now > 0 && now / size * size_to_come(e->statics, e->diagnostics) < wanted;
}

/* The opening grows by a step; pseudo-time follows, and on the way the crack advances as long as that pays. */
static status step_by_opening(struct run *e)
{
    const struct scene_steps *s = &e->scene->steps;
    const real wanted = s->opening * (real)(e->clock.step + 1) / (real)s->number,
               now = opening_now(&e->part, e->statics);
    const real first = e->statics->t + e->scene->duration / (real)s->number;
    bool open = false;
    if (e->statics->next.n == 0) TRY(approach_loads(e, now > 0 ? e->statics->t * wanted / now : first));
    while (!open || comes_before(e, wanted)) {
        open = !comes_before(e, wanted);
        if (open) {
            TRY(open_to(e, wanted,
                        opening_now(&e->part, e->statics) > 0
                            ? e->statics->t * wanted / opening_now(&e->part, e->statics)
                            : first));
            TRY(statics_convert(e, 0));
        } else {
            TRY(go_to_size(e, size_to_come(e->statics, e->diagnostics), 0, INFINITY));
            state_note(e);
            TRY(statics_advance_balanced(e));
        }
        TRY(statics_look_ahead(e));
    }
    return OK;
}

/* ---- the loop ---------------------------------------------------------------------------------------------------- */

/* Makes the search for equilibria of a load step depend on what a checkpoint keeps alone, so that a resumed run gets to
 * the same bits. The motions of unconstrained pieces are those of where the pieces are now. The preconditioner stays
 * where a resumed run can rebuild it: not if bonds have broken since it was made, nor with springs of contact, which
 * depend on where particles were at that time. */
static void load_step_begin(struct run *e)
{
    struct statics *s = e->statics;
    statics_pieces_make(e);
    if (s->stale || s->meets)
        statics_precondition_free(s);
    else if (s->kept && !s->precondition)
        statics_precondition_make(e);
    s->kept = false;
    s->directions = 0;
}

static status load_step(struct run *e)
{
    const struct scene *s = e->scene;
    const real most = s->duration / (real)s->steps.number;
    load_step_begin(e);
    switch (s->steps.control) {
    case CONTROL_LOAD:
        return step_by_load(e, most * (real)(e->clock.step + 1));
    case CONTROL_ENERGY:
        return step_by_energy(e, most);
    case CONTROL_OPENING:
        return step_by_opening(e);
    }
    return OK;
}

/* REFUSED where the opening is that of one place, or of none in the body. */
static status check_opening(const struct scene *scene, const struct particles *part)
{
    const struct scene_steps *s = &scene->steps;
    const real *const at[] = {s->from, s->to};
    const int64_t nearest[] = {particles_nearest(part, s->from), particles_nearest(part, s->to)};
    for (int k = 0; k < 2; k++) {
        real X[DIM_MAX], away = 0;
        particle_place(part, nearest[k], X);
        for (int d = 0; d < part->dim; d++) away += square(X[d] - at[k][d]);
        if (sqrt(away) > FAR_OFF * scene->spacing)
            return status_set(REFUSED,
                              "steps.%s: the body is %.3g m away from this position; a position on the body, where the "
                              "gauge is mounted, is expected",
                              k ? "to" : "from", sqrt(away));
    }
    if (nearest[0] != nearest[1]) return OK;
    return status_set(
        REFUSED,
        "steps.from and steps.to are at the same particle; two positions, on both sides of the crack, are expected");
}

/* REFUSED where loads and supports do not follow the pseudo-time: the crack would wait for others in vain. */
static status check_growth(const struct run *e)
{
    const real whole = e->scene->duration, size = statics_load_size(e, whole);
    const real half = statics_load_size(e, 0.5 * whole), quarter = statics_load_size(e, 0.25 * whole);
    if (e->scene->steps.control == CONTROL_LOAD || half != size || quarter != size) return OK;
    return status_set(REFUSED,
                      "steps.control: loads and supports are the same at all times, and the crack decides how "
                      "large they are; time: {ramp: {until: %.3g s}} of what loads the body is expected",
                      whole);
}

status statics_check(const struct run *e)
{
    const struct scene *s = e->scene;
    if (!scene_in_steps(s)) return OK;
    if (s->steps.control == CONTROL_OPENING) TRY(check_opening(e->scene, &e->part));
    TRY(check_growth(e));
    for (int b = 0; b < s->bodies && s->method != METHOD_PD; b++)
        if (!e->frame->choice[b].reference)
            return status_set(REFUSED,
                              "solver: load steps need material points in the reference frame, and body %s is not in "
                              "it%s%s; method: pd, or solver: explicit, is expected",
                              s->body[b].name, e->frame->choice[b].reason ? ": " : "",
                              e->frame->choice[b].reason ? e->frame->choice[b].reason : "");
    return OK;
}

/* Says that a crack has been pressed shut. */
static void say_closed(struct warnings *to, real K_I, const struct contact *c)
{
    if (K_I < 0 && c->law.between == CONTACT_NONE)
        warnings_say(to,
                     "K_I of a crack is negative: its faces are pressed together, and pass through each other without "
                     "contact.between: all");
}

#define FLOW_LARGE 0.1 /* plastic strain beyond which strains are no small ones */

/* Says that points have flowed farther than strains that add up describe: without hardening, beyond a limit load. */
static void say_flowed(struct warnings *to, const struct particles *p)
{
    real most = 0;
    char text[200];
    for (int64_t i = 0; i < p->n && p->plastic_correction[0]; i++) most = real_max(most, p->plastic_strain[i]);
    snprintf(text, sizeof text,
             "the plastic strain has reached %.2g, and load steps are for a few per cent: check that the body can "
             "carry its loads, or use smaller loads or solver: explicit",
             most);
    if (most > FLOW_LARGE) warnings_say(to, text);
}

/* Says that a rigid body has gone its way and pushed nothing: past the body, or a body that nothing holds before it. */
static void say_missed(struct warnings *to, const struct rigid_body *body, int n, real largest)
{
    for (int k = 0; k < n; k++) {
        const struct rigid_body *r = &body[k];
        char text[200];
        snprintf(text, sizeof text,
                 "rigid body %.60s has moved without pushing anything: check that it meets a body, and that this body "
                 "is held",
                 r->name);
        if (r->motion == RIGID_DRIVEN && r->force_most <= ROUND_OFF * largest) warnings_say(to, text);
    }
}

static void say_at_end(struct run *e)
{
    real K[MODES];
    led_factors(&e->statics->led, &e->part, statics_faces_closed(e->contact), K);
    say_closed(&e->warnings, K[MODE_I], e->contact);
    say_flowed(&e->warnings, &e->part);
    say_missed(&e->warnings, e->rigid->body, e->scene->rigids, e->statics->balance.largest);
}

/* FAILED if loads carry a piece away. Where a crack goes through under control energy, they have gone back as far as
 * they can, and the curve is whole: *apart. */
static status check_held(struct run *e, bool *apart)
{
    const bool parts = e->scene->steps.control == CONTROL_ENERGY && e->diagnostics->bonds_broken > 0;
    const status held = statics_unheld(e->statics, &e->part, e->clock.step + 1);
    *apart = parts && (held != OK || e->statics->severs);
    if (*apart)
        warnings_say(&e->warnings, "the crack goes through: after its next increment a fragment of the body would be "
                                   "almost unsupported under its loads, and the run ends before it");
    return parts ? OK : held;
}

status engine_steps(struct run *e)
{
    TRY(report_start(e));
    timers_start(&e->timers);
    if (!e->statics->node) statics_unknowns_make(e); /* a run that goes on has them */
    statics_touch_start(e);
    e->statics->opens[0] = particles_nearest(&e->part, e->scene->steps.from);
    e->statics->opens[1] = particles_nearest(&e->part, e->scene->steps.to);
    led_leads(e); /* of a run that goes on, too: finds the plane of its tips */
    if (e->clock.step == 0) sample_rest(e);
    while (e->clock.step < e->clock.steps) {
        e->clock.load_step = e->statics->record.step = e->clock.step + 1;
        bool apart;
        TRY(load_step(e));
        TRY(check_held(e, &apart));
        statics_plastic_keep(e);
        e->clock.step++;
        if (apart) e->clock.steps = e->clock.step;
        e->clock.t = e->clock.dt * (real)e->clock.step;
        state_note(e);
        sample_rest(e);
        statics_record_keep(e->statics);
        if (e->statics->t >= e->scene->duration * (1 - 1e-12)) e->clock.steps = e->clock.step;
        timer_book(&e->timers, TIMER_BONDS);
        if (e->clock.step == e->clock.steps) say_at_end(e);
        snprintf(e->report->note, sizeof e->report->note, "load time %.4g s  %lld equilibria", e->statics->t,
                 (long long)e->statics->solutions);
        TRY(report_step(e));
    }
    statics_free(e->statics);
    return report_end(e);
}
