/* `cleave bench contact`: compares collisions with closed forms, for contact of faces and of pairs. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "contact_bench.h"

status contact_make_run_of_scene(struct run *run, struct scene *s, const char *text, ...)
{
    char whole[4096];
    va_list more;
    va_start(more, text);
    vsnprintf(whole, sizeof whole, text, more);
    va_end(more);
    return bench_engine_make(run, s, "contact", whole, NULL, 0);
}

struct contact_motion contact_motion_of_body(const struct run *run, int body_number)
{
    const struct particles *p = &run->part;
    struct contact_motion m = {0};
    double inertia = 0;
    for (int64_t i = 0; i < p->n; i++) {
        if (p->body[i] != body_number) continue;
        m.mass += p->mass[i];
        for (int d = 0; d < p->dim; d++) m.x[d] += p->mass[i] * p->x[d][i], m.v[d] += p->mass[i] * p->v[d][i];
    }
    for (int d = 0; d < p->dim; d++) m.x[d] /= m.mass, m.v[d] /= m.mass;
    for (int64_t i = 0; i < p->n && p->dim > 1; i++) {
        if (p->body[i] != body_number) continue;
        const double a = p->x[0][i] - m.x[0], b = p->x[1][i] - m.x[1];
        m.spin += p->mass[i] * (a * (p->v[1][i] - m.v[1]) - b * (p->v[0][i] - m.v[0]));
        inertia += p->mass[i] * (a * a + b * b);
    }
    if (inertia > 0) m.spin /= inertia;
    return m;
}

bool contact_case_holds(const struct contact_case *c, const double *measured)
{
    for (int k = 0; k < CONTACT_FIGURES && c->asked[k].what; k++)
        if (!(measured[k] >= c->asked[k].low && measured[k] <= c->asked[k].high)) return false;
    return true;
}

/* ---- results ----------------------------------------------------------------------------------------------------- */

/* Prints the measured values figure[CONTACT_FIGURES] of case c, and a remark if one is outside its required range. */
static void contact_print(const struct contact_case *c, const double *figure)
{
    const bool holds = contact_case_holds(c, figure);
    printf("  %-44s %-8s", c->name, c->law);
    for (int k = 0; k < CONTACT_FIGURES && c->asked[k].what; k++)
        printf("%s %s %.3g", k > 0 ? "," : "", c->asked[k].what, figure[k]);
    printf("%s\n", holds ? "" : c->falls_short ? "  (falls short, as known)" : "  MISSED");
    fflush(stdout);
}

static void contact_rows(const struct contact_case *c, const double *figure, struct bench_table *rows)
{
    for (int k = 0; k < CONTACT_FIGURES && c->asked[k].what; k++) {
        bench_table_append_text(rows, c->name), bench_table_append_text(rows, c->law),
            bench_table_append_text(rows, c->asked[k].what);
        bench_table_append_number(rows, figure[k]), bench_table_append_number(rows, c->asked[k].low),
            bench_table_append_number(rows, c->asked[k].high);
    }
}

status bench_contact(bool quick)
{
    struct bench_table rows;
    printf("contact: collisions beside closed forms\n");
    bench_table_make(&rows, "", "case,law,figure,measured,low,high");
    for (int k = 0; k < contact_cases_count; k++) {
        const struct contact_case *c = &contact_cases[k];
        double figure[CONTACT_FIGURES] = {NAN, NAN, NAN, NAN};
        if (quick && c->long_run) continue;
        if (c->measure(c, figure) != OK) printf("  %s\n", status_message());
        contact_print(c, figure);
        contact_rows(c, figure, &rows);
    }
    const status s = bench_write_result_tables("contact", &rows, 1);
    bench_table_free(&rows);
    return s;
}
