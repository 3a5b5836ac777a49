/* `cleave bench stability`: compares the observed critical time step with the predicted one for every method; then runs
 * the scenes in which methods fail (stability_scenes.c), and measures energy over 1e5 steps (energy_drift.c). */
#include <math.h>
#include <string.h>

#include "energy_drift.h"
#include "base/memory.h"

/* ---- measuring --------------------------------------------------------------------------------------------------- */

enum { STEPS_OF_LINEAR = 1500 }; /* growth of points on nodes starts from round-off and is slow */

/* Argument of stability_measure. map: the map to be filled; steps, long_steps: time steps of a run that measures
 * growth and of a full run. */
struct measuring {
    struct stability_map *map;
    int steps, long_steps;
};

/* Returns true if the automatic time step of the case r, over its observed limit, is outside the required range. */
static bool outside(const struct stability_row *r)
{
    const double share = r->l.automatic / r->l.observed;
    return !(share >= STABILITY_LEAST && share <= STABILITY_MOST);
}

/* Prints the limits of the case r. The line goes to standard output if the automatic time step is outside its required
 * range; else to standard error, where it shows progress. */
static void stability_print_row(const struct stability_row *r)
{
    static const char *const run[] = {"", "stays", "grows"};
    const struct stability_limits *l = &r->l;
    FILE *to = r->refusal[0] || !outside(r) ? stderr : stdout;
    if (r->refusal[0]) {
        fprintf(to, "  %-66s refused: %s\n", r->label, r->refusal);
        return;
    }
    fprintf(to, "  %-66s %7.3f %7.3f %7.2f%s", r->label, l->observed / l->unit, l->critical / l->unit,
            l->automatic / l->observed, outside(r) ? " !" : "  ");
    if (l->largest > 1.02 * l->observed) fprintf(to, "  to %.3f by place", l->largest / l->unit);
    if (r->c.quoted_low > 0) fprintf(to, "  sheet %.3g", r->c.quoted_low);
    if (r->c.quoted_high > 0) fprintf(to, " - %.3g", r->c.quoted_high);
    if (isfinite(l->silling))
        fprintf(to, "  bounds %.2f %.2f of it", l->silling / l->observed, l->gershgorin / l->observed);
    if (l->below != RUN_NONE)
        fprintf(to, "  runs: automatic %s, below %s, above %s", run[l->automatic_run], run[l->below], run[l->above]);
    putc('\n', to);
    fflush(to);
}

static status stability_measure(void *context, const struct stability_case *c)
{
    struct measuring *m = context;
    INVARIANT(m->map->n < STABILITY_ROWS_MAX);
    struct stability_row *r = &m->map->row[m->map->n];
    if (m->map->n == 0 || r[-1].c.group != c->group)
        printf("\n  %-66s observed predicted  automatic/observed; in %s\n", stability_group_name[c->group],
               c->group == GROUP_POINTS ? "h/c" : "D/c");
    *r = (struct stability_row){.c = *c};
    m->map->n++;
    stability_label(c, r->label, sizeof r->label);
    const bool slow = c->shape && !strcmp(c->shape, "linear");
    const status s = stability_determine_limits(c, slow ? STEPS_OF_LINEAR : m->steps, m->long_steps, &r->l);
    if (s != OK && s != REFUSED) return s;
    if (s == REFUSED) {
        const char *why = strstr(status_message(), "was measured unstable")
                              ? "strains are not mapped again: the limit tends to 0"
                              : status_message();
        snprintf(r->refusal, sizeof r->refusal, "%s", why);
    }
    stability_print_row(r);
    return OK;
}

/* ---- files ------------------------------------------------------------------------------------------------------- */

/* Fills the table t with all cases of the map, their limits and whether their full runs stay bounded. */
static void stability_put_table(struct bench_table *t, const struct stability_map *map)
{
    static const char *const run[] = {"", "stays", "grows"};
    for (int k = 0; k < map->n; k++) {
        const struct stability_row *r = &map->row[k];
        const struct stability_case *c = &r->c;
        const struct stability_limits *l = &r->l;
        const bool there = !r->refusal[0];
        bench_table_append_text(t, stability_group_name[c->group]);
        bench_table_append_text(t, r->label);
        bench_table_append_number(t, c->dim);
        bench_table_append_text(t, c->method);
        bench_table_append_text(t, c->model ? c->model : "bond");
        bench_table_append_text(t, c->coupling ? c->coupling : "-");
        bench_table_append_text(t, c->shape ? c->shape : "-");
        bench_table_append_text(t, c->transfer ? c->transfer : "-");
        bench_table_append_number(t, c->cell > 0 ? c->cell : 2);
        bench_table_append_number(t, c->horizon > 0 ? c->horizon : 3.015);
        bench_table_append_text(t, c->group == GROUP_POINTS ? "h/c" : "D/c");
        bench_table_append_number(t, there ? l->observed / l->unit : NAN);
        bench_table_append_number(t, there ? l->offset : NAN);
        bench_table_append_number(t, there ? l->largest / l->unit : NAN);
        bench_table_append_number(t, there ? l->critical / l->unit : NAN);
        bench_table_append_number(t, there ? l->automatic / l->unit : NAN);
        bench_table_append_number(t, there ? l->automatic / l->observed : NAN);
        bench_table_append_number(t, c->quoted_low > 0 ? c->quoted_low : NAN);
        bench_table_append_number(t, c->quoted_high > 0 ? c->quoted_high : NAN);
        bench_table_append_number(t, there ? l->silling / l->observed : NAN);
        bench_table_append_number(t, there ? l->gershgorin / l->observed : NAN);
        bench_table_append_text(t, run[l->automatic_run]);
        bench_table_append_text(t, run[l->below]);
        bench_table_append_text(t, run[l->above]);
        bench_table_append_text(t, there ? outside(r) ? "outside" : "inside" : r->refusal);
    }
}

static void print_verdict(const struct stability_map *map)
{
    int refused = 0, out = 0;
    double least = INFINITY, most = 0;
    for (int k = 0; k < map->n; k++) {
        const struct stability_row *r = &map->row[k];
        if (r->refusal[0]) {
            refused++;
            continue;
        }
        out += outside(r);
        least = fmin(least, r->l.automatic / r->l.observed), most = fmax(most, r->l.automatic / r->l.observed);
    }
    printf("\n  the automatic step is %.2f to %.2f of the observed limit in %d cases (asked: %.2f to %.2f; %d "
           "outside), %d are "
           "refused\n",
           least, most, map->n - refused, STABILITY_LEAST, STABILITY_MOST, out, refused);
}

status bench_stability(bool quick)
{
    struct stability_map *map = NEW("bench.stability", 1, struct stability_map);
    struct measuring m = {map, quick ? 300 : 1500, quick ? 0 : 10000};
    struct bench_table t[3] = {0};
    map->n = 0;
    printf("stability: growth of the largest mode in %d steps%s; of each group, the cases that do not hold\n", m.steps,
           quick ? "" : ", runs of 1e4 steps beside the limit");
    bench_print_machine(1);
    bench_table_make(
        &t[0], "",
        "group,case,dimension,method,model,coupling,shape,transfer,points_per_cell,horizon,unit,observed,"
        "observed_at_offset,observed_largest,predicted,automatic,automatic_over_observed,sheet_low,sheet_high,"
        "silling_askari_over_observed,gershgorin_over_observed,run_automatic,run_below,run_above,verdict");
    status s = stability_call_for_all_cases(quick, stability_measure, &m);
    if (s == OK) {
        print_verdict(map);
        stability_put_table(&t[0], map);
        s = stability_measure_failing_scenes(&t[1]);
    }
    if (s == OK) s = drift_run_all_cases(&t[2], NULL, quick);
    if (s == OK) {
        s = bench_write_result_tables("stability", t, 3);
        if (!quick)
            puts("  a run of APIC that stays above the limit: growth moves points at an edge to where the limit is "
                 "another");
    }
    if (s == OK) s = bench_draw("stability", 1800, 1150, stability_write_picture_commands, map);
    if (s == OK) s = stability_draw_failing_scenes(&t[1]);
    if (s == OK) s = drift_draw(&t[2]);
    for (int k = 0; k < 3; k++) bench_table_free(&t[k]);
    memory_free(map);
    return s;
}

status bench_stability_of_energy(const char *case_name_part, bool quick)
{
    struct bench_table t = {0};
    const bool all = !strcmp(case_name_part, "lasting");
    bench_print_machine(1);
    status s = drift_run_all_cases(&t, all ? NULL : case_name_part, quick);
    if (s == OK && all) s = bench_write_result_tables("stability", &t, 1);
    if (s == OK && all) s = drift_draw(&t);
    bench_table_free(&t);
    return s;
}
