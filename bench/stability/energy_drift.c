/* Long map of `cleave bench stability`: energy of unbreakable bodies over many steps. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "energy_drift.h"

static const char header[] =
    "group,case,promise,particles,steps,stopped_at,energy_end,energy_largest,energy_least,energy_loudest,rate_per_step,"
    "angular_momentum_change,converted,verdict,why";

struct mapping_of {
    struct bench_table *t;
    const char *only;
    int64_t steps;
    int group, cases, held, refused;
};

static const char *promise_of(const struct lasting *r) { return r->keeps ? "kept" : "not exceeded"; }

static const char *verdict_of(const struct drift_case *l, const struct lasting *r)
{
    return r->refused ? "refused" : drift_holds(l, r) ? "holds" : r->stopped > 0 ? "stopped" : "fails";
}

static void energy_drift_put(struct bench_table *t, const struct drift_case *l, const struct lasting *r,
                             const char *label)
{
    const bool there = !r->refused;
    bench_table_append_text(t, drift_group_name[l->group]);
    bench_table_append_text(t, label);
    bench_table_append_text(t, promise_of(r));
    bench_table_append_number(t, there ? (double)r->particles : NAN);
    bench_table_append_number(t, (double)r->steps);
    bench_table_append_number(t, r->stopped > 0 ? (double)r->stopped : NAN);
    bench_table_append_number(t, there ? r->end : NAN);
    bench_table_append_number(t, there ? r->largest : NAN);
    bench_table_append_number(t, there ? r->least : NAN);
    bench_table_append_number(t, there ? r->loudest : NAN);
    bench_table_append_number(t, there ? r->rate : NAN);
    bench_table_append_number(t, there ? r->turn : NAN);
    bench_table_append_number(t, there && l->converts ? r->converted : NAN);
    bench_table_append_text(t, verdict_of(l, r));
    bench_table_append_text(t, r->why[0] ? r->why : "-");
}

/* Prints the result r of a long run, case l, and its label `label`. A case whose energy drifts too much is printed to
 * standard output. Other cases, and those that were refused, are printed to standard error, where they show
 * progress. */
static void print(const struct drift_case *l, const struct lasting *r, const char *label)
{
    FILE *to = r->refused || drift_holds(l, r) ? stderr : stdout;
    if (r->refused) {
        fprintf(to, "  %-66s refused: %s\n", label, r->why);
        return;
    }
    fprintf(to, "  %-66s %9.1e %9.1e %9.1e %9.1e %s", label, r->end, r->largest, r->least, r->rate,
            drift_holds(l, r) ? " " : "!");
    if (isfinite(r->turn)) fprintf(to, "  turn %.0e", r->turn);
    if (l->converts) fprintf(to, "  converted %.3g", r->converted);
    if (r->stopped > 0) fprintf(to, "  stopped at %lld", (long long)r->stopped);
    putc('\n', to);
    fflush(to);
}

static status energy_drift_measure(void *context, const struct drift_case *l)
{
    struct mapping_of *m = context;
    struct lasting r;
    char label[128];
    drift_label(l, label, sizeof label);
    if (m->only && !strstr(label, m->only) && !strstr(drift_group_name[l->group], m->only)) return OK;
    if (m->group != (int)l->group)
        printf("\n  %-66s energy at the end, most, least  rate a step\n", drift_group_name[l->group]);
    m->group = (int)l->group;
    TRY(drift_run(l, m->steps, &r));
    print(l, &r, label);
    energy_drift_put(m->t, l, &r, label);
    if (l->group == LASTING_PUBLISHED) return OK;
    m->cases += !r.refused, m->held += drift_holds(l, &r), m->refused += r.refused;
    return OK;
}

status drift_run_all_cases(struct bench_table *table, const char *case_name_part, bool quick)
{
    struct mapping_of m = {
        .t = table, .only = case_name_part, .steps = quick ? LASTING_STEPS_QUICK : LASTING_STEPS, .group = -1};
    bench_table_make(table, "lasting", header);
    printf("\n  %lld steps at the automatic step: energy less the work of loads, over what it was at the start (asked: "
           "within %g %%, "
           "points of the current frame never above it), and its rate\n",
           (long long)m.steps, 100 * LASTING_ENERGY);
    TRY(drift_call_for_all_cases(quick && !case_name_part, energy_drift_measure, &m));
    if (table->cells == 0)
        return status_set(REFUSED, "bench stability: no case of the long map has %s in its name", case_name_part);
    printf("\n  %d of %d cases hold, %d are refused; couplings published by others are not counted\n", m.held, m.cases,
           m.refused);
    return OK;
}
