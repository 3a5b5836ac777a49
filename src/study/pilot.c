/* Pilot runs: each method that can do the scene is studied at coarse spacings; the cheapest that reaches the accuracy
 * is chosen, at the coarsest spacing that does. */
#include "study/pilot.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "auto/scene_read.h"
#include "base/memory.h"
#include "base/team.h"
#include "output/output_files.h"
#include "pilot_parts.h"
#include "study/uncertainty.h"

#define FIRST_SHARE 0.6 /* of the budget for the first runs of all methods */
#define LONGEST 20.0    /* expected time of the run over the budget, beyond which the choice is refused */
#define FARTHEST 8.0    /* coarsest spacing run over the one chosen: beyond, an order is no forecast */
#define FINER_LEAST 1.4 /* a study goes on so much finer than the one before ... */
#define FINER_MOST 2.9  /* ... to so much: three levels beyond it */
enum { RUNS_FIRST = 3, LEVELS_FIRST = 3, REFUSED_MOST = 4 };

/* ---- methods ----------------------------------------------------------------------------------------------------- */

/* Bonds impose Poisson's ratio; a line has no other law. */
static bool bonds_fit(const struct scene *s)
{
    bool fit = true;
    for (int m = 0; m < s->materials; m++)
        fit &= s->dim == 1 || fabs(s->material[m].poisson - material_bond_poisson(s->space)) < 1e-6;
    return fit;
}

static bool needs_bonds(const struct scene *s)
{
    return scene_cracks(s) || s->has_pd_region || scene_watches_bonds(s);
}

static void candidate_add(struct pilot_search *p, const char *name, const char *method, const char *model)
{
    const bool points = !strcmp(method, "mpm");
    if (!points && p->wish.model[0] && strcmp(p->wish.model, model) != 0) return;
    p->at[p->n++] = (struct pilot_candidate){.name = name, .method = method, .model = points ? NULL : model};
}

static void candidates_find(struct pilot_search *p)
{
    const struct scene *s = &p->wish.first;
    const bool asked_bond = !strcmp(p->wish.model, "bond"), bond = asked_bond || bonds_fit(s);
    const bool breaks = scene_bonds_break(s) || s->growths > 0, zones = s->has_pd_region;
    /* at rest, points take their time: bonds have conjugate gradients */
    if (!needs_bonds(s) && !p->wish.at_rest) candidate_add(p, "points", "mpm", NULL);
    if (!zones) candidate_add(p, bond ? "bonds" : "states", "pd", bond ? "bond" : "ospd");
    if (!zones && !strcmp(p->wish.model, "mospd")) candidate_add(p, "rotations", "pd", "mospd");
    if ((breaks || zones) && !p->wish.at_rest)
        candidate_add(p, bond ? "adaptive bonds" : "adaptive states", "adaptive", bond ? "bond" : "mospd");
}

/* ---- one study --------------------------------------------------------------------------------------------------- */

static void chosen_put(struct pilot *to, int *n, const char *key, const char *value)
{
    INVARIANT(*n < CHOSEN_MOST);
    snprintf(to->key[*n], CHOSEN_ROOM, "%s", key);
    snprintf(to->value[*n], CHOSEN_ROOM, "%s", value);
    ++*n;
}

/* Writes the keys of a candidate at a spacing behind the user's. */
static void candidate_write(struct pilot *to, const struct pilot_search *p, const struct pilot_candidate *c,
                            double spacing)
{
    char number[CHOSEN_ROOM];
    int n = 0;
    if (p->wish.has_accuracy) chosen_put(to, &n, "accuracy", "");
    if (p->wish.has_table) chosen_put(to, &n, "accuracy_table", "");
    chosen_put(to, &n, "method", c->method);
    if (c->model) chosen_put(to, &n, "model", c->model);
    if (p->wish.at_rest) chosen_put(to, &n, "solver", "cg");
    snprintf(number, sizeof number, "%.15g", spacing);
    chosen_put(to, &n, "particles.spacing", number);
    pilot_fill(to, p->override, p->overrides, n);
}

static status candidate_study(struct pilot_search *p, struct pilot_candidate *c, double spacing, double budget,
                              bool finer)
{
    struct pilot own = {0};
    struct convergence_study s;
    const struct path folder = path_join(p->folder, c->name);
    if (!(budget > 0)) {
        snprintf(c->failed, sizeof c->failed, "no time is left for it");
        return REFUSED;
    }
    candidate_write(&own, p, c, spacing);
    const struct convergence_wish w = {.scene = p->scene,
                                       .folder = folder.text,
                                       .override = own.override,
                                       .overrides = own.overrides,
                                       .levels = LEVELS_FIRST,
                                       .runs = RUNS_FIRST,
                                       .budget = budget,
                                       .finer = finer,
                                       .way = {.threads = 1, .quiet = true, .overwrite = true, .stop = p->way.stop}};
    status done = convergence_study_run(&s, &w);
    if (done == OK) {
        done = pilot_judge(p, c, &s);
        c->unknown = done == REFUSED;
        convergence_study_free(&s);
    }
    c->failed[0] = '\0';
    if (done != OK) snprintf(c->failed, sizeof c->failed, "%.*s", (int)sizeof c->failed - 1, status_message());
    pilot_free(&own);
    return done;
}

/* ---- the search -------------------------------------------------------------------------------------------------- */

static double time_left(const struct pilot_search *p) { return fmax(p->wish.budget - (team_clock() - p->begun), 0); }

/* The candidate whose run is the cheapest; NULL: none has a forecast. */
static struct pilot_candidate *cheapest(struct pilot_search *p)
{
    struct pilot_candidate *best = NULL;
    for (int k = 0; k < p->n; k++)
        if (p->at[k].spacing > 0 && (!best || p->at[k].seconds < best->seconds)) best = &p->at[k];
    return best;
}

static status search_first(struct pilot_search *p)
{
    const double fixed = p->wish.spacing, first = fixed > 0 ? fixed : pilot_spacing(&p->wish.first);
    if (!(first > 0)) return status_set(REFUSED, "%s: no length tells where pilot runs should begin", p->scene);
    for (int k = 0; k < p->n; k++) {
        double spacing = first;
        status done = FAILED;
        /* rings and notches refuse spacings that are too coarse for them */
        for (int finer = 0; finer <= REFUSED_MOST && done == FAILED; finer++) {
            const double share = FIRST_SHARE * time_left(p) / (p->n - k);
            if (finer > 0) spacing = auto_spacing_fit(&p->wish.first, spacing / FINER_LEAST, true);
            done = candidate_study(p, &p->at[k], spacing, share, !(fixed > 0));
            if (fixed > 0) break;
        }
        if (done == INTERRUPTED || p->at[k].unknown) return done;
        if (!p->way.quiet) pilot_print(p, &p->at[k]);
    }
    return OK;
}

/* One study of a method at finer spacings. False: there is no time for it, or nothing more came out. */
static bool candidate_finer(struct pilot_search *p, struct pilot_candidate *c, status *done)
{
    const double left = time_left(p), wanted = c->finest / c->spacing;
    const double bearable = pow(left / (RUNS_FIRST * c->finest_seconds), 1.0 / (p->wish.first.dim + 1));
    const double finer = fmin(fmax(wanted, FINER_LEAST), fmin(bearable, FINER_MOST));
    const double next = auto_spacing_fit(&p->wish.first, c->finest / finer, true);
    struct pilot_candidate again = *c;
    if (finer < FINER_LEAST) return false;
    *done = candidate_study(p, &again, next, left, false);
    if (*done == INTERRUPTED) return false;
    if (*done != OK || (!again.seen && again.finest >= c->finest)) {
        *done = OK;
        return false;
    }
    *c = again;
    if (!p->way.quiet) pilot_print(p, c);
    return true;
}

/* The method with the cheapest forecast goes on, until one is seen to be accurate enough. */
static status search_finer(struct pilot_search *p)
{
    status done = OK;
    for (struct pilot_candidate *best = cheapest(p); best && !best->seen; best = cheapest(p))
        if (p->wish.spacing > 0 || !candidate_finer(p, best, &done)) break;
    return done;
}

/* The method whose interval is apart from that of c by more than is asked: one of them is not what it seems; NULL: all
 * agree. */
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

/* REFUSED with how far each method came. */
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
    if (!any) return status_set(REFUSED, "%s: no method can do the scene (%s)", p->scene, text);
    char limit[64] = "at its spacing";
    if (!(p->wish.spacing > 0)) snprintf(limit, sizeof limit, "in %g times that time", LONGEST);
    return status_set(REFUSED,
                      "%s: pilot runs of %.3g s found no method that is accurate to %.2g %% %s (%s); "
                      "a larger accuracy.within or accuracy.budget, or method and particles.spacing, would do",
                      p->scene, p->wish.budget, 100 * p->wish.within, limit, text);
}

static status search_end(struct pilot *to, const struct pilot_search *p, const struct pilot_candidate *best)
{
    if (!best || best->seconds > LONGEST * p->wish.budget || best->finest > FARTHEST * best->spacing)
        return search_failed(p);
    const struct pilot_candidate *other = contradiction(p, best);
    if (other)
        return status_set(REFUSED,
                          "%s: two methods converge to different values of %s: %s to %.4g +- %.2g, %s to %.4g +- %.2g; "
                          "write the method that represents it, and particles.spacing",
                          p->scene, p->figure, best->name, best->value, best->width, other->name, other->value,
                          other->width);
    candidate_write(to, p, best, best->spacing);
    if (!p->way.quiet)
        fprintf(stderr, "pilot          %s, spacing %.4g mm: %s within %.2g %% %s, in about %.2g s on one thread\n",
                best->name, 1e3 * best->spacing, p->figure, 100 * best->expected,
                best->seen ? "as seen" : "as expected from coarser ones", best->seconds);
    return OK;
}

static status pilot_search_all(struct pilot *to, struct pilot_search *p)
{
    candidates_find(p);
    TRY(folder_make(p->folder));
    TRY(study_folder_claim(p->folder));
    TRY(figures_guard(p->folder));
    if (!p->way.quiet)
        fprintf(
            stderr,
            "pilot          %s: runs at coarse spacings choose, in at most %.3g s (accuracy.budget); they are in %s\n",
            p->wish.why, p->wish.budget, shown_name(p->folder).text);
    TRY(search_first(p));
    TRY(search_finer(p));
    const struct pilot_candidate *best = cheapest(p);
    TRY(search_end(to, p, best));
    return pilot_keep(to, p, best);
}

/* The overrides of a scene that wants pilot runs. */
static status pilot_choose(struct pilot *to, struct pilot_search *p, const char *folder)
{
    char run[NAME_MAX_LENGTH + sizeof "results/"];
    snprintf(run, sizeof run, "results/%s", p->wish.first.name);
    snprintf(p->folder, sizeof p->folder, "%s", pilot_folder(folder ? folder : run).text);
    if (strlen(p->folder) + CASE_NAME_ROOM + 2 * PATH_NAME_ROOM >= PATH_ROOM)
        return status_set(REFUSED, "-o: the folder's name is too long");
    if (p->wish.figure[0]) TRY(figure_name_check(&p->wish.first, p->wish.figure));
    return pilot_kept(to, p) ? OK : pilot_search_all(to, p);
}

status pilot_scene_read(struct scene *s, struct pilot *to, const char *scene, const struct scene_override *override,
                        int overrides, const char *folder, struct study_way way)
{
    struct pilot_search p = {
        .scene = scene, .override = override, .overrides = overrides, .way = way, .begun = team_clock()};
    *to = (struct pilot){0};
    TRY(scene_read_or_wish(s, &p.wish, scene, override, overrides));
    if (!p.wish.wanted) return OK;
    status done = pilot_choose(to, &p, folder);
    scene_free(&p.wish.first);
    if (done == OK) done = scene_read(s, scene, to->override, to->overrides);
    if (done != OK) pilot_free(to);
    return done;
}
