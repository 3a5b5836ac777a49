/* `cleave bench accuracy=auto`: `method: auto` on every case of the table, beside the cheapest run of the
 * chart that is as accurate, both timed here in turn; and on problems that are not in it.
 * results/bench/accuracy_auto.csv. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "accuracy.h"

static const double asked[] = {0.05, 0.01, 0.003};

#define RATIO_ASKED 1.5                  /* time over that of the table's best */
enum { TURNS_LEAST = 3, TURNS_MOST = 30 };
#define TURNS_SECONDS 1.5                /* all in all: short runs are repeated for their time */

/* ---- scenes ------------------------------------------------------------------------------------------------------ */

static void take_away(struct accuracy_scene *s, const char *key)
{
    char begin[32];
    snprintf(begin, sizeof begin, "\n%s:", key);
    if (strstr(s->text, begin)) bench_override(&s->set, key, "%s", "");
}

static bool any_known(const struct accuracy_plan *plan)
{
    bool any = false;
    for (int k = 0; k < plan->n; k++) any |= plan->entry[k].result.known;
    return any;
}

/* The problem without a method: what its scene says of one is left out; whatever finds rest may do so. By what was
 * measured here, or where nothing was by the table of the program. */
static void make_auto(const struct accuracy_plan *plan, const struct accuracy_point *p, double accuracy,
                      struct accuracy_scene *s)
{
    struct accuracy_scene made;
    memset(&made, 0, sizeof made);
    memset(s, 0, sizeof *s);
    p->problem->scene(p, &made);
    memcpy(s->text, made.text, sizeof s->text);
    for (int k = 0; k < made.set.n; k++) {
        const char *key = made.set.at[k].key;
        if (strcmp(key, "solver") == 0) bench_override(&s->set, key, "static");
        if (strncmp(key, "material.", 9) == 0) bench_override(&s->set, key, "%s", made.set.value[k]);
    }
    take_away(s, "pd");
    take_away(s, "conversion");
    bench_override(&s->set, "particles.spacing", "%s", "");
    bench_override(&s->set, "method", "auto");
    bench_override(&s->set, "accuracy", "%.9g", accuracy);
    if (any_known(plan)) bench_override(&s->set, "accuracy_table", "%s", BENCH_FOLDER "/cost_accuracy.csv");
    bench_override(&s->set, "output.frames", "0");
    bench_override(&s->set, "output.samples", "%d", p->problem->samples ? p->problem->samples : 1);
}

/* The cheapest run of the table in this case that is accurate enough. */
static const struct accuracy_entry *best_of(const struct accuracy_plan *plan, const struct accuracy_point *p,
                                            double accuracy)
{
    const struct accuracy_entry *best = NULL;
    for (int k = 0; k < plan->n; k++) {
        const struct accuracy_entry *e = &plan->entry[k];
        if (e->point.problem != p->problem || e->point.at != p->at || !e->result.known || !e->result.stable) continue;
        if (e->result.error <= accuracy && (!best || e->result.seconds[0] < best->result.seconds[0])) best = e;
    }
    return best;
}

/* ---- one line ---------------------------------------------------------------------------------------------------- */

struct trial {
    const struct accuracy_point *point;
    double accuracy;
    struct scene_choice choice;
    struct accuracy_result automatic, best;
    char best_label[96];
    bool refused;
};

static status run_one(const struct accuracy_entry *entry, struct accuracy_result *r)
{
    struct accuracy_scene s;
    if (!entry) return OK;
    accuracy_scene_make(&entry->point, &s);
    return accuracy_run_scene(&entry->point, &s, 0, r, NULL);
}

/* In turn, so that what else the machine does meets all of them. */
static status run_trial(struct trial *t, const struct accuracy_plan *plan)
{
    const struct accuracy_entry *best = best_of(plan, t->point, t->accuracy);
    struct accuracy_scene s;
    const double start = team_clock();
    accuracy_result_clear(&t->automatic), accuracy_result_clear(&t->best);
    make_auto(plan, t->point, t->accuracy, &s);
    if (best) accuracy_label(&best->point, t->best_label, sizeof t->best_label);
    for (char *c = t->best_label; *c; c++) *c = *c == ',' ? ';' : *c;     /* a cell of the table */
    for (int turn = 0; turn < TURNS_MOST && (turn < TURNS_LEAST || team_clock() - start < TURNS_SECONDS); turn++) {
        const status ran = accuracy_run_scene(t->point, &s, 0, &t->automatic, &t->choice);
        t->refused = ran == REFUSED;
        if (t->refused) return OK;
        TRY(ran);
        TRY(run_one(best, &t->best));
    }
    return OK;
}

static void print_trial(const struct trial *t)
{
    const struct accuracy_point *p = t->point;
    printf("  %-8s %-14s %4.1f %% ", p->problem->name, p->problem->cases[p->at], 100 * t->accuracy);
    if (t->refused) {
        const char *why = strstr(status_message(), ": ");
        printf("refused%.150s\n", why ? why : "");
    } else {
        printf("%-26s h %-6.4g expected %5.2g %% measured %6.3g %% %s %9.3g s", t->choice.picked, t->choice.horizon,
               100 * t->choice.error, 100 * t->automatic.error, t->automatic.error <= t->accuracy ? "ok  " : "MISS",
               t->automatic.seconds[0]);
        if (t->best.known)
            printf(" best %9.3g s (%s) ratio %.2f", t->best.seconds[0], t->best_label,
                   t->automatic.seconds[0] / t->best.seconds[0]);
        printf("\n");
    }
    fflush(stdout);
}

static void put_trial(struct bench_table *table, const struct trial *t)
{
    const struct accuracy_point *p = t->point;
    bench_text(table, p->problem->name), bench_text(table, p->problem->cases[p->at]);
    bench_text(table, t->refused ? "refused" : t->choice.picked);
    const double time = t->automatic.seconds[0];
    const double figures[] = {t->choice.horizon,  t->choice.resolution,     t->accuracy,
                              t->choice.error,    t->automatic.error,       time,
                              t->best.seconds[0], time / t->best.seconds[0]};
    for (size_t k = 0; k < COUNT_OF(figures); k++) bench_number(table, t->refused && k != 2 ? NAN : figures[k]);
    bench_text(table, t->refused ? "-" : t->best_label[0] ? t->best_label : "-");
}

/* ---- all --------------------------------------------------------------------------------------------------------- */

struct tally { int asked, refused, missed, slow, timed; };

static status try_problem(const struct accuracy_plan *plan, const struct accuracy_problem *q, struct bench_table *table,
                          struct tally *sum)
{
    const int usual = q->resolution[q->resolution[2] ? 2 : 0];
    for (int at = 0; at < accuracy_cases(q); at++)
        for (size_t k = 0; k < COUNT_OF(asked); k++) {
            const struct accuracy_point p = {.problem = q, .method = accuracy_method, .at = at, .resolution = usual,
                                             .horizon = ACCURACY_HORIZON, .step = ACCURACY_STEP};
            struct trial t = {.point = &p, .accuracy = asked[k]};
            TRY(run_trial(&t, plan));
            print_trial(&t);
            put_trial(table, &t);
            sum->asked++, sum->refused += t.refused;
            if (t.refused) continue;
            sum->missed += !(t.automatic.error <= t.accuracy);
            sum->timed += t.best.known,
                sum->slow += t.best.known && t.automatic.seconds[0] > RATIO_ASKED * t.best.seconds[0];
        }
    return OK;
}

static status try_all(const struct accuracy_plan *plan, bool quick, struct bench_table *table, struct tally *sum)
{
    for (int k = 0; k < accuracy_others; k++) TRY(try_problem(plan, accuracy_other[k], table, sum));
    for (int k = 0; k < accuracy_problems; k++)
        if (!quick || accuracy_problem[k]->dim == 1) TRY(try_problem(plan, accuracy_problem[k], table, sum));
    return OK;
}

status accuracy_auto(struct accuracy_plan *plan, bool quick)
{
    struct bench_table table;
    struct tally sum = {0};
    TRY(accuracy_plan_make(plan));
    TRY(accuracy_store_read(plan));
    if (any_known(plan)) TRY(accuracy_table_write(plan));
    bench_table_make(&table, "",
                     "problem,case,picked,horizon,resolution,asked,expected,measured,seconds,best_seconds,ratio,"
                     "best");
    status s = try_all(plan, quick, &table, &sum);
    team_make(0);
    if (s == OK) s = bench_write("accuracy_auto", &table, 1);
    bench_table_free(&table);
    if (s == OK) s = accuracy_page(plan);
    printf("  %d asked, %d refused; of the others %d missed; of %d beside the table's best %d took more than %.2g "
           "times its "
           "time\n",
           sum.asked, sum.refused, sum.missed, sum.timed, sum.slow, RATIO_ASKED);
    return s;
}
