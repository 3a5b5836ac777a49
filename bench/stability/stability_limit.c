/* Observed critical time step: from the growth of the largest mode under the engine's own step, and from full runs.
 *
 * The step is applied to a body at rest with random velocities of 1e-8 c, which is the linearised step applied to a
 * vector with a component in every mode. Below the limit the velocities stay at their size, except for modes that grow
 * with the number of steps; slightly above it they grow by a constant factor per step. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "stability.h"
#include "mesh/mesh_part.h"
#include "step/stability.h"
#include "grid/grid_part.h"
#include "probes/diagnostics.h"

#define QUIET 1e-8 /* velocity over c: linear, and round-off is 1e-8 of it */
#define LOUD 1e-4  /* velocity over c in a full run, in which nothing breaks or converts */
#define DRIFT 3e-4 /* translation over c, which moves points through cells in a full run */
/* Growth factor of velocities from which on a time step counts as unstable [1]. Modes that grow with the number of
 * steps remain below it. */
#define GROWN 1e3
#define WITHIN 0.004 /* relative accuracy of the limit */

/* ---- initial motion ---------------------------------------------------------------------------------------------- */

/* Sets random velocities of particles and grid nodes of the run, with components up to `speed` [m/s], those of
 * particles with zero mean plus the velocity `drift` along each axis [m/s]. */
static void stability_limit_shake(struct run *run, double speed, double drift)
{
    struct particles *p = &run->part;
    struct grid *g = &run->frame->mesh.grid;
    uint64_t seed = 1;
    for (int d = 0; d < p->dim; d++) {
        double mean = 0;
        for (int64_t i = 0; i < p->n; i++) p->v[d][i] = speed * bench_random(&seed);
        for (int64_t i = 0; i < p->n; i++) mean += p->mass[i] * p->v[d][i] / run->mass;
        for (int64_t i = 0; i < p->n; i++) p->v[d][i] += drift - mean;
        for (int64_t I = 0; run->frame->mesh.points > 0 && I < g->n; I++)
            if (run->frame->mesh.inverse_mass[I] > 0) g->velocity[d][I] = speed * bench_random(&seed);
    }
}

/* Returns the kinetic energy of the run minus that of a uniform translation with the velocity `drift` [m/s] along
 * each axis [J]. */
static double motion(const struct run *run, double drift)
{
    return particles_kinetic_energy(&run->part) + mesh_kinetic(&run->frame->mesh) -
           0.5 * run->mass * run->part.dim * drift * drift;
}

/* Creates the run of the case c with the time step dt [s], or with the automatic one if dt is 0, and its scene in *s.
 * With dt > 0 the run is so long that only its first step is a sample. Returns FAILED or REFUSED if the scene cannot be
 * read. Release with bench_engine_free. */
static status limit_block_make(struct run *run, struct scene *s, const struct stability_case *c, double dt)
{
    struct bench_overrides o = {0};
    char text[4096];
    stability_write_scene_text(c, text, sizeof text);
    if (dt > 0) {
        bench_overrides_append(&o, "time.step", "%.17g", dt);
        bench_overrides_append(&o, "duration", "%.17g", dt * 1e9);
    }
    return bench_engine_make(run, s, "block", text, bench_overrides_as_array(&o), o.n);
}

status stability_run_and_test_boundedness(const struct stability_case *c, double time_step,
                                          struct stability_shake initial_motion, bool *is_bounded)
{
    struct run e;
    struct scene s;
    TRY(limit_block_make(&e, &s, c, time_step));
    const double drift = initial_motion.drift * e.tables.wave_speed;
    stability_limit_shake(&e, initial_motion.speed * e.tables.wave_speed, drift);
    const double first = motion(&e, drift);
    *is_bounded = bench_engine_run(&e, 1, NULL) == OK; /* creates the record of the first sample */
    while (*is_bounded && e.clock.step < initial_motion.steps) {
        if (run_adapt_mesh_and_advance_one_step(&e) != OK)
            *is_bounded = false;
        else if (e.clock.step % 8 == 0 && !(motion(&e, drift) < GROWN * GROWN * first))
            *is_bounded = false;
    }
    bench_engine_free(&e, &s);
    return OK;
}

/* ---- limits ------------------------------------------------------------------------------------------------------ */

/* Finds the critical time step of the case c by bisection between a step for which the motion remains bounded and one
 * for which it grows, and stores it in *limit [s]. critical: the step that Cleave predicts [s]; steps: number of steps
 * of each trial run. Returns REFUSED if there is no limit near the prediction, FAILED if a trial cannot be run. */
static status limit_of(const struct stability_case *c, double critical, int steps, double *limit)
{
    const struct stability_shake quietly = {QUIET, 0, steps};
    double low = 0, high = 0;
    bool stays;
    for (double f = 1.05; low == 0 || high == 0; f *= stays ? 1.2 : 0.85) {
        if (f > 20 || f < 0.02) return status_set(REFUSED, "no limit between 0.02 and 20 of the predicted step");
        TRY(stability_run_and_test_boundedness(c, f * critical, quietly, &stays));
        *(stays ? &low : &high) = f * critical;
    }
    while (high - low > WITHIN * low) {
        const double middle = 0.5 * (low + high);
        TRY(stability_run_and_test_boundedness(c, middle, quietly, &stays));
        *(stays ? &low : &high) = middle;
    }
    *limit = 0.5 * (low + high);
    return OK;
}

/* Returns the critical time step of the particle with the stiffest bonds in the run [s], sqrt(2 rho/sum(c V/|xi|))
 * with the sum over its bonds (Silling & Askari 2005). */
static double silling_step(const struct run *run)
{
    const struct bonds *b = &run->bonds;
    double most = 0;
    for (int64_t r = 0; r < b->rows; r++) {
        double sum = 0;
        for (struct bond_iterator it = bond_iterator_of_row(b, r); bond_iterator_advance(&it);)
            sum += b->stiffness * it.bond.w * it.bond.inverse_length;
        most = fmax(most, sum / run->part.mass[b->particle[r]]);
    }
    return sqrt(2 / most);
}

static status predict(const struct stability_case *c, struct stability_limits *to)
{
    struct run e;
    struct scene s;
    TRY(limit_block_make(&e, &s, c, 0));
    to->critical = e.clock.dt_critical, to->automatic = s.safety * e.clock.dt_critical;
    to->unit = (c->group == GROUP_POINTS ? e.grid->field[0].grid.h : s.spacing) / e.tables.wave_speed;
    to->gershgorin = to->silling = NAN;
    if (s.method == METHOD_PD && s.model == MODEL_BOND)
        to->gershgorin = bonds_critical_time_step_of_existing_bonds(&e.bonds, &e.part), to->silling = silling_step(&e);
    bench_engine_free(&e, &s);
    return OK;
}

static status real_run(const struct stability_case *c, double dt, double drift, int steps, int *run)
{
    bool stays;
    TRY(stability_run_and_test_boundedness(c, dt, (struct stability_shake){LOUD, drift, steps}, &stays));
    *run = stays ? RUN_STAYS : RUN_GROWS;
    return OK;
}

/* Distance of the end of the body from a node. With APIC the limit is smallest if the body ends slightly beyond or
 * before a node; still closer to the node, the node beyond the edge follows its neighbours (grid_move.c). */
#define BEYOND 0.01 /* [cells] */

status stability_determine_limits(const struct stability_case *given, int trial_steps, int long_steps,
                                  struct stability_limits *limits)
{
    struct stability_case c = *given;
    *limits = (struct stability_limits){.observed = INFINITY};
    TRY(predict(&c, limits));
    for (int k = 0; k < (c.offsets > 0 ? c.offsets : 1); k++) {
        double limit = 0;
        const double beyond = c.transfer && !strcmp(c.transfer, "apic") ? k % 2 ? -BEYOND : BEYOND : 0;
        if (c.offsets > 0) c.offset = (double)k / c.offsets + beyond;
        TRY(limit_of(&c, limits->critical, trial_steps, &limit));
        limits->largest = fmax(limits->largest, limit);
        if (limit < limits->observed) limits->observed = limit, limits->offset = c.offset;
    }
    if (long_steps <= 0) return OK;
    const bool drifts = c.group == GROUP_POINTS;
    int run[3];
    c.offset = limits->offset;
    TRY(real_run(&c, limits->automatic, drifts ? DRIFT : 0, long_steps, &run[0]));
    TRY(real_run(&c, 0.97 * limits->observed, 0, long_steps, &run[1]));
    TRY(real_run(&c, 1.03 * limits->observed, 0, long_steps, &run[2]));
    limits->automatic_run = run[0], limits->below = run[1], limits->above = run[2];
    return OK;
}
