/* Makes pilot runs for `method: auto`: studies each applicable method at coarse spacings, and chooses the method that
 * reaches the requested accuracy at the lowest cost, at the coarsest sufficient spacing. */
#include "study/pilot.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "base/team.h"
#include "output/output_files.h"
#include "pilot_parts.h"
#include "scene/spacings.h"
#include "study/uncertainty.h"

/* Largest ratio of the finest spacing that was run to the spacing that is chosen by extrapolation of the errors [1].
 * For larger ratios the extrapolation with the order of convergence is unreliable. */
#define FARTHEST 8.0
#define FINER_LEAST 1.4    /* least refinement from one study of a method to the next */
#define FINER_MOST 2.9     /* largest refinement: three levels */
enum { REFUSED_MOST = 4 }; /* largest number of refinements after spacings at which the scene is invalid */

/* ---- one study --------------------------------------------------------------------------------------------------- */

/* Appends a key and its value that pilot runs (short runs that choose method and spacing for `method: auto`) have
 * chosen to the lists to->key and to->value, which have *n entries (at most CHOSEN_MOST), and increments *n. Texts too
 * long are truncated. */
static void chosen_put(struct pilot_choice *to, int *n, const char *key, const char *value)
{
    INVARIANT(*n < CHOSEN_MOST);
    snprintf(to->key[*n], CHOSEN_ROOM, "%s", key);
    snprintf(to->value[*n], CHOSEN_ROOM, "%s", value);
    ++*n;
}

/* Sets to->override to the overrides of the user, followed by those that select the method c, a candidate of `method:
 * auto`: method, model, solver, and the particle spacing `spacing` [m]. p: input file (scene) and overrides of the
 * user. Free with pilot_choice_free. */
static void candidate_write(struct pilot_choice *to, const struct pilot_search *p, const struct pilot_candidate *c,
                            double spacing)
{
    char number[CHOSEN_ROOM];
    int n = 0;
    if (p->wish.has_accuracy) chosen_put(to, &n, "accuracy", "");
    chosen_put(to, &n, "method", c->method);
    if (c->model) chosen_put(to, &n, "model", c->model);
    if (p->wish.at_rest) chosen_put(to, &n, "solver", "cg");
    snprintf(number, sizeof number, "%.15g", spacing);
    chosen_put(to, &n, "particles.spacing", number);
    pilot_runs_combine_user_and_chosen_overrides(to, p->override, p->overrides, n);
}

static status candidate_study(struct pilot_search *p, struct pilot_candidate *c, double spacing, double budget,
                              bool finer)
{
    struct pilot_choice own = {0};
    struct convergence_study s;
    const struct path folder = path_join(p->folder, c->name);
    if (!(budget > 0)) {
        snprintf(c->failed, sizeof c->failed, "no time is left for it");
        return REFUSED;
    }
    candidate_write(&own, p, c, spacing);
    const struct convergence_request w = {
        .scene = p->scene,
        .folder = folder.text,
        .override = own.override,
        .overrides = own.overrides,
        .levels = PILOT_LEVELS_FIRST,
        .runs = PILOT_RUNS_FIRST,
        .budget = budget,
        .finer = finer,
        .options = {.threads = 1, .quiet = true, .overwrite = true, .stop = p->options.stop}};
    status done = convergence_study_run(&s, &w);
    if (done == OK) {
        done = pilot_runs_determine_required_spacing(p, c, &s);
        c->unknown = done == REFUSED;
        convergence_study_free(&s);
    }
    c->failed[0] = '\0';
    if (done != OK) snprintf(c->failed, sizeof c->failed, "%.*s", (int)sizeof c->failed - 1, status_message());
    pilot_choice_free(&own);
    return done;
}

/* ---- the search -------------------------------------------------------------------------------------------------- */

/* Returns the time that remains of the budget of the pilot runs of p (short runs that choose method and spacing) [s],
 * at least 0. */
static double time_left(const struct pilot_search *p)
{
    return fmax(p->wish.budget - (wall_clock_seconds() - p->begun), 0);
}

/* Returns the candidate method of the search p (for the method of `method: auto`) whose run at the spacing that it
 * needs for the requested accuracy has the shortest predicted duration. Returns NULL if no method has a prediction. */
static struct pilot_candidate *cheapest(struct pilot_search *p)
{
    struct pilot_candidate *best = NULL;
    for (int k = 0; k < p->n; k++)
        if (p->at[k].spacing > 0 && (!best || p->at[k].seconds < best->seconds)) best = &p->at[k];
    return best;
}

/* Makes one convergence study of every candidate method of the search p (for the method of `method: auto`). The
 * studies together take the share PILOT_FIRST_SHARE of the time that is left, in equal parts. If the input file
 * (scene) is invalid at the spacing of a study, the study is repeated at finer spacings. Returns OK even if a method
 * fails (its reason is stored), INTERRUPTED after a stop signal, or REFUSED, with a message, if the runs lack the
 * requested result. */
static status search_first(struct pilot_search *p)
{
    const double fixed = p->wish.spacing, first = p->wish.provisional.spacing;
    for (int k = 0; k < p->n; k++) {
        double spacing = first;
        status done = FAILED;
        /* Rings of probes and notches refuse spacings that are too coarse for them. */
        for (int finer = 0; finer <= REFUSED_MOST && done == FAILED; finer++) {
            const double share = PILOT_FIRST_SHARE * time_left(p) / (p->n - k);
            if (finer > 0) spacing = spacing_that_fits_box_edges(&p->wish.provisional, spacing / FINER_LEAST, true);
            done = candidate_study(p, &p->at[k], spacing, share, !(fixed > 0));
            if (fixed > 0) break;
        }
        if (done == INTERRUPTED || p->at[k].unknown) return done;
        if (!p->options.quiet) pilot_runs_print_results_of_method(p, &p->at[k]);
    }
    return OK;
}

/* Repeats the convergence study of the method *c of the search p (for the method of `method: auto`) at finer spacings,
 * as fine as its prediction requires and the remaining time allows. Replaces *c by the outcome and returns true if it
 * is better. Returns false if no time is left, if the outcome is no better, or after an interruption. *done: receives
 * INTERRUPTED in the last case, else OK. */
static bool candidate_finer(struct pilot_search *p, struct pilot_candidate *c, status *done)
{
    const double left = time_left(p), wanted = c->finest / c->spacing;
    const double bearable = pow(left / (PILOT_RUNS_FIRST * c->finest_seconds), 1.0 / (p->wish.provisional.dim + 1));
    const double finer = fmin(fmax(wanted, FINER_LEAST), fmin(bearable, FINER_MOST));
    const double next = spacing_that_fits_box_edges(&p->wish.provisional, c->finest / finer, true);
    struct pilot_candidate again = *c;
    if (finer < FINER_LEAST) return false;
    *done = candidate_study(p, &again, next, left, false);
    if (*done == INTERRUPTED) return false;
    if (*done != OK || (!again.seen && again.finest >= c->finest)) {
        *done = OK;
        return false;
    }
    *c = again;
    if (!p->options.quiet) pilot_runs_print_results_of_method(p, c);
    return true;
}

/* Repeats the study of that method of the search p (for the method of `method: auto`) which has the shortest predicted
 * duration, at finer spacings. Ends when this method has a run that is accurate enough, or no refinement is possible.
 * The method may change from one study to the next. Returns INTERRUPTED after a stop signal, else OK. */
static status search_finer(struct pilot_search *p)
{
    status done = OK;
    for (struct pilot_candidate *best = cheapest(p); best && !best->seen; best = cheapest(p))
        if (p->wish.spacing > 0 || !candidate_finer(p, best, &done)) break;
    return done;
}

/* Returns a candidate method of the search p (for the method of `method: auto`) that contradicts the method c: the
 * values of the scalar result differ by more than the sum of both uncertainties and of the requested relative accuracy
 * times the value of c, so that one of the two must be wrong. Candidates that failed, or have no result yet, are
 * skipped. Returns NULL if no candidate contradicts c. */
static const struct pilot_candidate *contradiction(const struct pilot_search *p, const struct pilot_candidate *c)
{
    for (int k = 0; k < p->n; k++) {
        const struct pilot_candidate *other = &p->at[k];
        if (other == c || other->failed[0] || !(other->finest > 0)) continue;
        const double apart = fabs(c->value - other->value) - c->width - other->width;
        if (apart > p->wish.within * fabs(c->value)) return other;
    }
    return NULL;
}

/* Returns REFUSED, because no method of the search p (for the method of `method: auto`) is accurate enough, with a
 * message that lists the accuracy that each method has reached, or why it failed. */
static status search_failed(const struct pilot_search *p)
{
    char text[900] = "";
    size_t n = 0;
    for (int k = 0; k < p->n && n < sizeof text - 1; k++) {
        const struct pilot_candidate *c = &p->at[k];
        if (c->failed[0])
            n += (size_t)snprintf(text + n, sizeof text - n, "%s%s: %s", k > 0 ? "; " : "", c->name, c->failed);
        else
            n += (size_t)snprintf(text + n, sizeof text - n, "%s%s: %s +- %.2g %% at %.3g mm", k > 0 ? "; " : "",
                                  c->name, p->figure, 100 * c->reached, 1e3 * c->finest);
    }
    bool any = false;
    for (int k = 0; k < p->n; k++) any |= !p->at[k].failed[0];
    if (!any)
        return status_set(
            REFUSED, "%s: no method can run the scene (%s); change the scene, or give method and particles.spacing",
            p->scene, text);
    char limit[64] = "at its spacing";
    if (!(p->wish.spacing > 0)) snprintf(limit, sizeof limit, "in %g times that time", PILOT_LONGEST);
    return status_set(REFUSED,
                      "%s: pilot runs in %.3g s of computing (accuracy.budget) found no method that is accurate to "
                      "%.2g %% %s (%s); use a larger "
                      "accuracy.within or accuracy.budget, or give method and particles.spacing",
                      p->scene, p->wish.budget, 100 * p->wish.within, limit, text);
}

/* Prints the chosen method *best of the search p (for the method of `method: auto`) and its spacing, and stores the
 * overrides for them in *to. best: NULL if no method has a prediction. Returns REFUSED, with a message, if `best` is
 * NULL, if its run would take longer than PILOT_LONGEST times the budget or need a spacing less than 1/FARTHEST of the
 * finest one tried, or if two methods converge to different values. */
static status search_end(struct pilot_choice *to, const struct pilot_search *p, const struct pilot_candidate *best)
{
    if (!best || best->seconds > PILOT_LONGEST * p->wish.budget || best->finest > FARTHEST * best->spacing)
        return search_failed(p);
    const struct pilot_candidate *other = contradiction(p, best);
    if (other)
        return status_set(REFUSED,
                          "%s: two methods converge to different values of %s: %s to %.4g +- %.2g, %s to %.4g +- %.2g; "
                          "give the method that represents this scene, and particles.spacing",
                          p->scene, p->figure, best->name, best->value, best->width, other->name, other->value,
                          other->width);
    candidate_write(to, p, best, best->spacing);
    if (!p->options.quiet)
        fprintf(stderr,
                "pilot          chosen: method %s, spacing %.4g mm; the error of %s is within %.2g %% %s, and the run "
                "takes about %.2g s on one thread\n",
                best->name, 1e3 * best->spacing, p->figure, 100 * best->expected,
                best->seen ? "in a pilot run" : "by extrapolation from coarser pilot runs", best->seconds);
    return OK;
}

static status pilot_search_all(struct pilot_choice *to, struct pilot_search *p)
{
    TRY(folder_create_with_parents(p->folder));
    TRY(study_folder_mark_as_study(p->folder));
    TRY(convergence_study_check_output_files_replaceable(p->folder));
    if (!p->options.quiet)
        fprintf(stderr,
                "pilot          pilot runs at coarse spacings choose the method and the spacing for an error of %s "
                "within %.3g %%; they take at most %.3g s (accuracy.budget), and their results are in %s\n",
                pilot_runs_get_requested_result_name(p), 100 * p->wish.within, p->wish.budget,
                printable_name(p->folder).text);
    if (!p->options.quiet && p->wish.at_rest)
        fprintf(stderr, "pilot          the solver of this scene finds one equilibrium, in which no bond breaks; for a "
                        "crack that grows under rising loads use method: pd or adaptive with solver: static\n");
    TRY(search_first(p));
    TRY(search_finer(p));
    const struct pilot_candidate *best = cheapest(p);
    TRY(search_end(to, p, best));
    return pilot_runs_store_chosen_method_and_spacing(to, p, best);
}

/* Chooses the overrides *to of a scene with `method: auto`. Reads a stored choice for the same scene if there is one,
 * else makes pilot runs in a folder beside `folder`, the folder of the run (NULL for the default). p: scene, request
 * and state of the choice. Returns REFUSED, with a message, if no method is suitable, or the error of a pilot run. */
static status pilot_choose(struct pilot_choice *to, struct pilot_search *p, const char *folder)
{
    char run[NAME_MAX_LENGTH + sizeof "results/"];
    snprintf(run, sizeof run, "results/%s", p->wish.provisional.name);
    snprintf(p->folder, sizeof p->folder, "%s", pilot_folder_of_run(folder ? folder : run).text);
    if (strlen(p->folder) + CASE_NAME_ROOM + 2 * PATH_NAME_ROOM >= PATH_ROOM)
        return status_set(REFUSED, "-o: the folder's name is too long; choose a shorter one");
    TRY(pilot_runs_list_applicable_methods(p));
    return pilot_runs_read_stored_method_and_spacing(to, p) ? OK : pilot_search_all(to, p);
}

status scene_read_and_choose_method_by_pilot_runs(struct scene *s, struct pilot_choice *to, const char *scene,
                                                  const struct scene_override *override, int overrides,
                                                  const char *folder, struct study_options options)
{
    struct pilot_search p = {.scene = scene,
                             .override = override,
                             .overrides = overrides,
                             .options = options,
                             .begun = wall_clock_seconds()};
    *to = (struct pilot_choice){0};
    TRY(scene_read_unless_pilot_runs_are_needed(s, &p.wish, scene, override, overrides));
    if (!p.wish.wanted) return OK;
    status done = pilot_choose(to, &p, folder);
    scene_free(&p.wish.provisional);
    if (done == OK) done = scene_read(s, scene, to->override, to->overrides);
    if (done != OK) pilot_choice_free(to);
    return done;
}
