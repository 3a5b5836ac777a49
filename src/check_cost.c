/* floor 5: what a run costs, from steps that are thrown away: no table of figures knows the machine, its load and the scene as
 * well as they do. */
#include <math.h>

#include "check_parts.h"
#include "engine_report.h"
#include "memory.h"
#include "solver_parts.h"

enum { PERIODS_MOST = 200 };
#define SECONDS_ENOUGH 0.15
#define SECONDS_MOST 1.0
#define FRAME_BYTES 72                   /* of a particle: copied for the writer, its room and its order */
#define OUTPUT_BYTES 2.7e6               /* of the library that writes */
#define SECONDS_PER_BOND 0.8e-9          /* peridynamic bond on one core, about */

/* Of the steps after the first, which meets cold memory; from sample to sample, so that these have their share. */
static status time_steps(struct engine *e, double *step)
{
    const int64_t samples = e->scene->samples > 0 ? e->scene->samples : 1;
    const int64_t period = e->steps / samples > 0 ? e->steps / samples : 1;
    double spent[PERIODS_MOST], all = 0;
    int n = 0;
    TRY(engine_step(e));
    while (n < PERIODS_MOST && all < SECONDS_MOST && (n < 3 || all < SECONDS_ENOUGH)) {
        const double start = team_clock();
        int64_t taken = 0;
        for (; taken < period && e->step < e->steps - 1 && team_clock() - start < SECONDS_MOST; taken++) TRY(engine_step(e));
        if (taken == 0) break;
        all += team_clock() - start;
        spent[n++] = (team_clock() - start) / (double)taken;
    }
    *step = n > 0 ? median_of(spent, n) : NAN;
    return OK;
}

/* A static solver asks for the bonds' forces once in an iteration. */
static double time_iteration(struct engine *e)
{
    double spent[PERIODS_MOST], all = 0;
    int n = 0;
    while (n < PERIODS_MOST && (all < SECONDS_ENOUGH || n < 3)) {
        const double start = team_clock();
        solver_bond_force(e);
        all += spent[n++] = team_clock() - start;
    }
    return median_of(spent, n);
}

/* Neighbours of a particle inside the body, by the volume that they fill. */
static double family_size(const struct family *f) { return f->full / f->cell_volume; }

status cost_measure(struct cost *c, struct engine *e, int threads)
{
    const struct scene *s = e->scene;
    const double n = (double)e->part.n;
    const bool explicit = s->solver == SOLVER_EXPLICIT;
    c->all_peridynamic = s->method == METHOD_ADAPTIVE ? n * family_size(&e->source.family) * SECONDS_PER_BOND / threads : NAN;
    e->quiet = true;
    TRY(engine_report_start(e));
    if (explicit) TRY(time_steps(e, &c->step));
    else c->step = time_iteration(e);
    c->bytes = (double)memory_peak() + OUTPUT_BYTES + n * FRAME_BYTES;
    return OK;
}
