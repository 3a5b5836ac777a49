/* Runs a case of the long map: a small body with the automatic time step; measures energy, growth rate and angular
 * momentum. */
#include <math.h>
#include <omp.h>
#include <stdio.h>
#include <string.h>

#include "energy_drift.h"
#include "base/memory.h"
#include "mesh/mesh_part.h"
#include "probes/diagnostics.h"
#include "step/report.h"
#include "coupling/coupling_part.h"
#include "step/stability.h"
#include "step/checks.h"

#define LOUD 1e-4 /* velocities over the wave speed: strains of 1e-4, no bond breaks */
enum { SAMPLES = 400 };

/* ---- motion ------------------------------------------------------------------------------------------------------ */

/* A mass that moves independently: a particle that is not part of a mesh, or a node of the mesh. m: mass [kg]; x:
 * position [m]; v[d]: pointer to component d of its velocity [m/s]. */
struct mover {
    real m, x[DIM_MAX], *v[DIM_MAX];
};

static int64_t energy_drift_run_movers_of(const struct run *run)
{
    return run->part.n + (run->frame->mesh.points > 0 ? run->frame->mesh.grid.n : 0);
}

static struct mover mover_at(const struct run *run, int64_t k)
{
    const struct particles *p = &run->part;
    const struct grid *g = &run->frame->mesh.grid;
    struct mover a = {0};
    const int64_t I = k - p->n, at = I < 0 ? I : mesh_original_node_of_doubled_node(&run->frame->mesh, I);
    if (I < 0)
        a.m = p->flag[k] & FLAG_MESHED ? 0 : p->mass[k];
    else
        a.m = g->mass[I];
    for (int d = 0; d < p->dim; d++) {
        a.v[d] = I < 0 ? &p->v[d][k] : &g->velocity[d][I];
        a.x[d] = I < 0
                     ? p->x[d][k]
                     : grid_node_position(g, d, at / g->stride[d] % g->count[d]) + run->frame->mesh.displacement[d][I];
    }
    return a;
}

static int turns_of(int dim) { return dim * (dim - 1) / 2; }

/* Stores in *a and *b the axes that span the plane of rotation number t: xy for t = 0, yz for 1, zx for 2. */
static void turn_axes(int t, int *a, int *b) { *a = t, *b = (t + 1) % DIM_MAX; }

/* Computes the angular momentum L[DIM_MAX] of all masses of the run about centre[DIM_MAX] [m], one entry per plane of
 * rotation xy, yz, zx [kg m^2/s]. *size: its scale, the sum of m |x - centre| |v| [kg m^2/s]. */
static void angular_momentum(const struct run *run, const real *centre, real *L, real *size)
{
    for (int t = 0; t < DIM_MAX; t++) L[t] = 0;
    *size = 0;
    for (int64_t k = 0; k < energy_drift_run_movers_of(run); k++) {
        const struct mover m = mover_at(run, k);
        real r2 = 0, v2 = 0;
        if (m.m == 0) continue;
        for (int d = 0; d < run->part.dim; d++) r2 += square(m.x[d] - centre[d]), v2 += square(*m.v[d]);
        *size += m.m * sqrt(r2 * v2);
        for (int t = 0; t < turns_of(run->part.dim); t++) {
            int a, b;
            turn_axes(t, &a, &b);
            L[t] += m.m * ((m.x[a] - centre[a]) * *m.v[b] - (m.x[b] - centre[b]) * *m.v[a]);
        }
    }
}

static void centre_of(const struct run *run, real *centre)
{
    real mass = 0;
    for (int d = 0; d < DIM_MAX; d++) centre[d] = 0;
    for (int64_t k = 0; k < energy_drift_run_movers_of(run); k++) {
        const struct mover m = mover_at(run, k);
        mass += m.m;
        for (int d = 0; d < run->part.dim && m.m > 0; d++) centre[d] += m.m * m.x[d];
    }
    for (int d = 0; d < run->part.dim; d++) centre[d] /= mass;
}

/* Removes the mean rotation of the body of the run about centre[DIM_MAX] [m] from its velocities, because small-strain
 * laws change the energy of rotating bodies. Exact only for bodies with the symmetry of those in this bench. */
static void stop_turning(struct run *run, const real *centre)
{
    real L[DIM_MAX], size, inertia[DIM_MAX] = {0};
    angular_momentum(run, centre, L, &size);
    for (int pass = 0; pass < 2; pass++)
        for (int64_t k = 0; k < energy_drift_run_movers_of(run); k++) {
            struct mover m = mover_at(run, k);
            for (int t = 0; t < turns_of(run->part.dim) && m.m > 0; t++) {
                int a, b;
                turn_axes(t, &a, &b);
                const real ra = m.x[a] - centre[a], rb = m.x[b] - centre[b];
                if (pass == 0)
                    inertia[t] += m.m * (ra * ra + rb * rb);
                else
                    *m.v[b] -= L[t] / inertia[t] * ra, *m.v[a] += L[t] / inertia[t] * rb;
            }
        }
}

/* Sets random velocities of all masses of the run, without mean translation, and without mean rotation about
 * centre[DIM_MAX] [m]. Their components are up to LOUD wave speeds before the means are removed. */
static void energy_drift_run_shake(struct run *run, const real *centre)
{
    uint64_t seed = 1;
    for (int d = 0; d < run->part.dim; d++) {
        real momentum = 0, mass = 0;
        for (int64_t k = 0; k < energy_drift_run_movers_of(run); k++) {
            struct mover m = mover_at(run, k);
            if (m.m == 0) continue;
            *m.v[d] = LOUD * run->tables.wave_speed * bench_random(&seed);
            momentum += m.m * *m.v[d], mass += m.m;
        }
        for (int64_t k = 0; k < energy_drift_run_movers_of(run); k++) {
            struct mover m = mover_at(run, k);
            if (m.m > 0) *m.v[d] -= momentum / mass;
        }
    }
    stop_turning(run, centre);
}

/* Velocities of particles and nodes before a step. */
struct earlier {
    real *v[2][DIM_MAX];
};

static void earlier_make(struct earlier *b, const struct run *run)
{
    for (int d = 0; d < run->part.dim; d++) {
        b->v[0][d] = NEW("lasting.before", run->part.n, real);
        b->v[1][d] = NEW("lasting.before", run->frame->mesh.grid.n + 1, real);
    }
}

static void earlier_free(struct earlier *b)
{
    for (int k = 0; k < 2; k++)
        for (int d = 0; d < DIM_MAX; d++) memory_free(b->v[k][d]);
}

static void earlier_take(struct earlier *b, const struct run *run)
{
    for (int d = 0; d < run->part.dim; d++) {
        array_copy(b->v[0][d], run->part.v[d], run->part.n, sizeof(real));
        if (run->frame->mesh.points > 0)
            array_copy(b->v[1][d], run->frame->mesh.grid.velocity[d], run->frame->mesh.grid.n, sizeof(real));
    }
}

/* Returns the sum of 1/2 m v_before . v_after over all masses [J], where b holds the velocities before the last step
 * and the run those after it, and stores the sum of 1/2 m v_after^2 in *after. Leap-frog integration conserves the
 * first sum plus the potential energy. */
static real kinetic_between(const struct earlier *b, const struct run *run, real *after)
{
    real sum = 0;
    *after = 0;
    for (int64_t k = 0; k < energy_drift_run_movers_of(run); k++) {
        const struct mover m = mover_at(run, k);
        const bool node = k >= run->part.n;
        for (int d = 0; d < run->part.dim && m.m > 0; d++) {
            sum += 0.5 * m.m * *m.v[d] * b->v[node][d][k - (node ? run->part.n : 0)];
            *after += 0.5 * m.m * square(*m.v[d]);
        }
    }
    return sum;
}

/* ---- the run ----------------------------------------------------------------------------------------------------- */

/* Creates the run of the case l with `steps` automatic time steps and SAMPLES evenly spaced samples, with its scene
 * in *s. Returns REFUSED or FAILED if the scene is invalid. Release with bench_engine_free. */
static status energy_drift_body_make(struct run *run, struct scene *s, const struct drift_case *l, int64_t steps)
{
    struct bench_overrides o = {0};
    char text[4096];
    stability_write_scene_text(&l->c, text, sizeof text);
    TRY(bench_engine_make(run, s, "body", text, NULL, 0));
    const real dt = run->clock.dt;
    bench_engine_free(run, s);
    bench_overrides_append(&o, "time.step", "%.17g", dt);
    bench_overrides_append(&o, "duration", "%.17g", dt * (real)steps);
    bench_overrides_append(&o, "output.samples", "%d", SAMPLES);
    bench_overrides_append(&o, "output.frames", "0");
    return bench_engine_make(run, s, "body", text, bench_overrides_as_array(&o), o.n);
}

/* Energies at the samples of a run over the step number [J]. energy: the sum that stable steps conserve; plain: with
 * the velocities after the step; work: work of loads. */
struct course {
    int n;
    double step[SAMPLES + 8], energy[SAMPLES + 8], plain[SAMPLES + 8], work[SAMPLES + 8];
};

static void course_add(struct course *c, const struct run *run, const struct earlier *before)
{
    const struct energy_balance *now = &run->diagnostics->now;
    const struct energy *u = &now->energy;
    if (c->n >= (int)COUNT_OF(c->step)) return;
    c->step[c->n] = (double)run->clock.step;
    real after;
    const real between = kinetic_between(before, run, &after),
               stored = u->strain + u->plastic + u->fracture + u->contact;
    c->energy[c->n] = between + stored, c->plain[c->n] = after + stored;
    c->work[c->n++] = now->external_work;
}

/* Returns the growth rate of energy[c->n] per step [1]: the slope of its logarithm over the second half of the samples
 * c of a run, by least squares. Returns NAN for too few samples. */
static double rate_of(const struct course *c, const double *energy)
{
    double n = 0, x = 0, y = 0, xx = 0, xy = 0;
    const double origin = c->n > 0 ? c->step[c->n / 2] : 0;
    for (int k = c->n / 2; k < c->n; k++) {
        const double size = fabs(energy[k]), at = c->step[k] - origin, log_energy = log(size);
        if (!(size > 0 && isfinite(size))) continue;
        n++, x += at, y += log_energy, xx += at * at, xy += at * log_energy;
    }
    return n > 2 ? (n * xy - x * y) / (n * xx - x * x) : NAN;
}

static void judge(const struct course *c, struct lasting *to)
{
    double scale = c->n > 0 ? c->energy[0] : 0;
    for (int k = 0; k < c->n; k++)
        if (c->work[k] != 0) scale = fmax(scale, c->energy[k]);
    to->largest = to->end = to->least = to->loudest = 0;
    for (int k = 0; k < c->n; k++) {
        to->end = (c->energy[k] - c->work[k] - c->energy[0]) / scale;
        if (!isfinite(to->end)) to->end = INFINITY;
        to->largest = fmax(to->largest, to->end), to->least = fmin(to->least, to->end);
        to->inverted |= c->energy[k] < -LASTING_ENERGY * scale;
        to->loudest = fmax(to->loudest, c->plain[k] / scale);
    }
    to->rate = rate_of(c, to->loudest > LASTING_LOUDEST ? c->plain : c->energy);
}

/* Returns true if the run must conserve angular momentum: the body has no boundary conditions, is not
 * one-dimensional, and has no grid cells with a small-strain law, whose forces depend on rotations. */
static bool energy_drift_run_is_free(const struct run *run)
{
    return run->scene->boundaries == 0 && run->part.dim > 1 &&
           !(run->frame->mesh.points > 0 && run->scene->small_strain);
}

static double turned(const struct run *run, const real *centre, const real *L, real size)
{
    real now[DIM_MAX], scale, most = 0;
    angular_momentum(run, centre, now, &scale);
    for (int t = 0; t < turns_of(run->part.dim); t++) most = real_max(most, fabs(now[t] - L[t]));
    return most / size;
}

static status energy_drift_run_body(struct run *run, const struct drift_case *l, struct lasting *to)
{
    struct course *c = NEW("lasting.course", 1, struct course);
    struct earlier before = {{{0}}};
    real centre[DIM_MAX], L[DIM_MAX], size;
    earlier_make(&before, run);
    centre_of(run, centre);
    if (!l->moves) energy_drift_run_shake(run, centre);
    status s = bench_engine_run(run, 1, NULL); /* creates the record of the first sample, at step 0 */
    c->energy[c->n] = c->plain[c->n] = run->diagnostics->energy_start, c->n++;
    angular_momentum(run, centre, L, &size);
    to->free = energy_drift_run_is_free(run), to->turn = to->free ? 0 : NAN;
    while (s == OK && run->clock.step < run->clock.steps) {
        earlier_take(&before, run);
        s = run_adapt_mesh_and_advance_one_step(run);
        if (s == OK) s = run_check_stability_after_step(run);
        if (s != OK || !run->report->sampling.due) continue;
        course_add(c, run, &before);
        if (to->free) to->turn = fmax(to->turn, turned(run, centre, L, size));
    }
    judge(c, to);
    to->stopped = s == OK ? 0 : run->clock.step > 0 ? run->clock.step : 1;
    to->converted = (double)(run->part.n_of[KIND_PD] - run->coupling->conversion.start) / (double)run->part.n;
    if (s != OK) snprintf(to->why, sizeof to->why, "%s", status_message());
    memory_free(c);
    earlier_free(&before);
    return s == OK || s == FAILED ? OK : s;
}

status drift_run(const struct drift_case *drift_case, int64_t steps, struct lasting *result)
{
    struct run e;
    struct scene s;
    const int team = omp_get_max_threads();
    *result = (struct lasting){.steps = steps};
    omp_set_num_threads(1);
    status made = energy_drift_body_make(&e, &s, drift_case, steps);
    if (made == OK) {
        result->particles = e.part.n;
        result->keeps = e.part.n_free == 0 && e.part.n_grid_coupled == 0;
        made = energy_drift_run_body(&e, drift_case, result);
        bench_engine_free(&e, &s);
    } else if (made == REFUSED) {
        result->refused = true;
        snprintf(result->why, sizeof result->why, "%s", status_message());
        made = OK;
    }
    omp_set_num_threads(team);
    return made;
}

bool drift_holds(const struct drift_case *drift_case, const struct lasting *result)
{
    const bool within = result->largest <= LASTING_ENERGY && result->loudest <= LASTING_LOUDEST;
    if (result->refused || result->stopped > 0 || result->inverted || !within) return false;
    if (drift_case->converts && result->converted > 0) return false;
    if (!result->keeps) return !(result->rate > LASTING_RATE);
    return result->least >= -LASTING_ENERGY && !(result->free && !drift_case->moves && !(result->turn <= LASTING_TURN));
}
