/* `method: auto`: reads the scene once to classify it (auto_match.c), picks a point of the cost-accuracy table
 * (auto_pick.c), and writes spacing, method, horizon and step into the tree as if the user had given them. Keys of the
 * user stay and restrict the choice. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "auto/scene_read.h"
#include "auto.h"
#include "base/memory.h"
#include "src/scene/scene_internal.h"

/* A request for a choice: the scene as read and as written, and the accuracy. */
struct ask {
    const struct scene *scene;
    const struct node *root;
    struct auto_match match;
    bool slow_loads;                     /* all loads are constant tractions, which may grow slowly           */
    real accuracy;
};

/* ---- first reading of the scene ---------------------------------------------------------------------------------- */

/* Reads the scene with stand-ins for the keys that are to be chosen, which contradict no other key. */
static status read_with(struct reader *r, const char *text, size_t length, struct scene *s, const char *method)
{
    static const char *const dropped[] = {"accuracy", "accuracy_table", "pd.surface", "particles.spacing"};
    struct reader first = *r;
    struct node *root;
    first.scene = s;
    status read = scene_tree(&first, text, length, &root);
    for (size_t k = 0; k < COUNT_OF(dropped) && read == OK; k++)
        if (tree_at(root, dropped[k])) read = tree_set(&first, root, dropped[k], "");
    const struct node *space = read == OK ? tree_at(root, "space") : NULL;
    const bool line = space && strcmp(space->text, "line") == 0,
               yields = read == OK && tree_at(root, "material.yield_stress");
    if (read == OK) read = tree_set(&first, root, "particles.spacing", "1");
    if (read == OK) read = tree_set(&first, root, "method", method);
    if (read == OK) read = tree_set(&first, root, "solver", "explicit");
    if (read == OK && !line && !yields) read = tree_set(&first, root, "model", "mospd");
    if (read == OK) read = scene_from_tree(&first, root);
    r->arena = first.arena;
    return read;
}

/* Joined bodies and rigid ones are not for every method. */
static status read_first(struct reader *r, const char *text, size_t length, struct scene *s)
{
    status read = read_with(r, text, length, s, "adaptive");
    if (read != REFUSED) return read;
    scene_free(s);
    *s = (struct scene){0};
    return read_with(r, text, length, s, "pd");
}

/* ---- capabilities of methods ------------------------------------------------------------------------------------- */

static bool has_states(const struct cost_point *p)
{
    return cost_point_has(p, "model", "ospd") || cost_point_has(p, "model", "mospd");
}

static bool auto_has_bonds(const struct cost_point *p) { return !cost_point_has(p, "method", "mpm"); }

/* Levels of coarse cells of p; 0: none. */
static int levels_of_point(const struct cost_point *p)
{
    char levels[TABLE_WORD];
    return cost_accuracy_key(p, "mpm.levels", levels, sizeof levels) ? atoi(levels) : 0;
}

/* True if the method of p can represent the scene. Bonds impose Poisson's ratio, material points with one velocity
 * field do not crack, and bodies in the reference frame meet no other body. */
static bool can_do(const struct cost_point *p, const struct ask *a)
{
    const struct scene *s = a->scene;
    const real bond = material_bond_poisson(s->space);
    const bool coupled = strncmp(p->method, "coupled", 7) == 0, slow = cost_point_has(p, "solver", "explicit");
    if (auto_has_bonds(p) &&
        (a->match.points_only || (s->dim > 1 && !has_states(p) && fabs(s->material[0].poisson - bond) > 1e-6)))
        return false;
    if (!auto_has_bonds(p) && a->match.needs_bonds && !(a->match.gap && cost_point_has(p, "mpm.frame", "reference")))
        return false;
    if (s->bodies > 1 && (cost_point_has(p, "method", "pd") || cost_point_has(p, "mpm.frame", "reference")))
        return false;
    if (coupled != s->has_pd_region && !(s->has_pd_region && strncmp(p->method, "adaptive", 8) == 0)) return false;
    if (cost_point_has(p, "mpm.strain", "small") && 100 * a->match.strain > a->accuracy) return false;
    return !a->match.at_rest || !slow || a->slow_loads;
}

/* ---- keys of the user -------------------------------------------------------------------------------------------- */

static bool same_value(const char *a, const char *b)
{
    char *end_a, *end_b;
    const double x = strtod(a, &end_a), y = strtod(b, &end_b);
    if (end_a != a && end_b != b && !*end_a && !*end_b) return fabs(x - y) <= 1e-9 * fabs(y);
    return strcmp(a, b) == 0;
}

/* Default of a key with the method of p: as in resolve_defaults where it depends on the method, else the first word of
 * its explanation, as in `(gimp; ..`. */
static void usual_value(const struct key *k, const struct cost_point *p, char *text, size_t room)
{
    const char *from = k->fallback + (*k->fallback == '(');
    if (strcmp(k->path, "mpm.frame") == 0) from = "current";      /* tables without a frame were measured in it */
    if (strcmp(k->path, "mpm.levels") == 0) from = "0";           /* and those without levels, without coarse cells */
    if (strcmp(k->path, "pd.surface") == 0) from = cost_point_has(p, "method", "pd") ? "moments" : "none";
    if (strcmp(k->path, "pd.influence") == 0) from = has_states(p) ? "inverse" : "one";
    if (strcmp(k->path, "pd.normalisation") == 0) from = cost_point_has(p, "method", "pd") ? "bulk" : "local";
    snprintf(text, room, "%.*s", (int)strcspn(from, *k->fallback == '(' ? "; )" : ""), from);
}

/* True if a key has a meaning with the method of p. */
static bool concerns(const char *path, const struct cost_point *p)
{
    if (strncmp(path, "pd.", 3) == 0 || strcmp(path, "model") == 0) return auto_has_bonds(p);
    if (strcmp(path, "mpm.shape") == 0 || strcmp(path, "mpm.transfer") == 0)
        return !cost_point_has(p, "method", "pd") && !cost_point_has(p, "mpm.frame", "reference");
    if (strncmp(path, "mpm.", 4) == 0) return !cost_point_has(p, "method", "pd") && strcmp(path, "mpm.origin") != 0;
    if (strcmp(path, "coupling") == 0 || strncmp(path, "conversion.", 11) == 0)
        return cost_point_has(p, "method", "adaptive");
    return false;
}

/* True if no key of the user contradicts the method of p. */
static bool agrees(const struct cost_point *p, const struct node *root)
{
    char value[TABLE_WORD];
    for (int i = 0; i < keys_count; i++) {
        const struct node *n = keys[i].type <= KEY_CHOICE ? tree_at(root, keys[i].path) : NULL;
        if (!n || n->kind != NODE_SCALAR || !concerns(keys[i].path, p)) continue;
        const bool free = strcmp(keys[i].path, "mpm.frame") == 0 || strcmp(keys[i].path, "mpm.levels") == 0;
        if (free && strcmp(n->text, "auto") == 0) continue;
        if (!cost_accuracy_key(p, keys[i].path, value, sizeof value)) usual_value(&keys[i], p, value, sizeof value);
        if (!same_value(n->text, value)) return false;
    }
    const struct node *solver = tree_at(root, "solver");
    return !solver || !cost_accuracy_key(p, "solver", value, sizeof value) || strcmp(solver->text, "static") == 0 ||
           strcmp(solver->text, value) == 0;
}

/* True if p suits the scene and the keys of the user, horizon and safety included; `context`: struct ask. */
static bool allows(const struct cost_point *p, const void *context)
{
    const struct ask *a = context;
    const struct scene *s = a->scene;
    if (tree_at(a->root, "particles.horizon") && p->horizon > 0 && fabs(p->horizon - s->horizon) > 1e-9) return false;
    if (tree_at(a->root, "time.safety") && fabs(p->step - s->safety) > 1e-9) return false;
    return can_do(p, a) && agrees(p, a->root);
}

static bool allows_even(const struct cost_point *p, const void *context)
{
    return levels_of_point(p) == 0 && allows(p, context);
}

/* ---- report of the choice ---------------------------------------------------------------------------------------- */

/* Expected time [s]: the time of the table in proportion to the numbers of particles and of steps; the number of steps
 * is in proportion to the distance that waves travel. */
static real seconds_of(const struct ask *a, const struct auto_point *p, real spacing)
{
    real particles = 0;
    for (int b = 0; b < a->scene->bodies; b++) {
        real count = 1;
        for (int d = 0; d < a->scene->dim; d++) count *= auto_extent(a->scene, b, d) / spacing;
        particles += count;
    }
    const real steps = a->match.kind->travel > 0 ? a->match.travel / a->match.kind->travel : 1;
    return p->seconds * particles / p->particles * steps;
}

/* The method in words; `even`: time over that of the best without coarse cells, NAN without one. */
static void name_choice(struct scene_choice *c, const struct ask *a, const struct cost_point *p, real even)
{
    const int levels = levels_of_point(p);
    char coarse[64] = "", share[32] = "";
    if (isfinite(even)) snprintf(share, sizeof share, " in %.2f of the time", even);
    if (levels > 0) snprintf(coarse, sizeof coarse, ", far cells of %d spacings%s", 2 << levels, share);
    const bool gap = a->match.needs_bonds && !auto_has_bonds(p);
    const char *crack = gap ? ", a gap for the crack" : "";
    if (snprintf(c->picked, sizeof c->picked, "%.25s%s%s", p->method, crack, coarse) < 0) c->picked[0] = '\0';
}

/* Records the choice, for reports, in r->scene->choice. spacing: [m]; even: as above. */
static void keep_choice(struct scene_choice *c, const struct ask *a, const struct auto_found *f, real spacing,
                        real even)
{
    const struct auto_match *m = &a->match;
    c->made = true;
    snprintf(c->like, sizeof c->like, "%s (%s of the cost-accuracy table)", m->kind->title, m->kind->problem);
    snprintf(c->feature, sizeof c->feature, "%s", m->kind->feature);
    name_choice(c, a, f->best.of, even);
    c->size = m->feature, c->points = m->feature / spacing, c->resolution = c->points / m->kind->per_resolution;
    c->accuracy = a->accuracy, c->error = m->growth * f->best.error;
    c->horizon = f->best.of->horizon, c->step = f->best.of->step;
    c->seconds = seconds_of(a, &f->best, spacing);
    c->second[0] = '\0';
    if (!f->second.of) return;
    snprintf(c->second, sizeof c->second, "%.60s", f->second.of->method);
    c->second_error = m->growth * f->second.error, c->second_share = f->second.seconds / f->best.seconds;
}

void scene_choice_print(const struct scene *s, FILE *out)
{
    const struct scene_choice *c = &s->choice;
    if (!c->made) return;
    fprintf(out, "auto           like %s: %s is %.4g m, %.4g spacings\n", c->like, c->feature, c->size, c->points);
    fprintf(out, "auto           %s", c->picked);
    if (c->horizon > 0) fprintf(out, ", horizon %.4g", c->horizon);
    fprintf(out, ", spacing %.4g m, %.3g of the critical step:\n", s->spacing, c->step);
    fprintf(
        out,
        "auto           the cheapest for an error of %.2g %% where %.2g %% is asked, in about %.2g s on one thread of "
        "the table's machine\n",
        100 * c->error, 100 * c->accuracy, c->seconds);
    if (!c->second[0]) return;
    fprintf(out, "auto           next best: %s, %.2g %% in %.2f times that time\n", c->second, 100 * c->second_error,
            c->second_share);
}

/* ---- all --------------------------------------------------------------------------------------------------------- */

/* True if the scene has loads and all of them are constant tractions. */
static bool loads_may_wait(const struct scene *s)
{
    bool any = false;
    for (int k = 0; k < s->boundaries; k++) {
        const struct boundary *b = &s->boundary[k];
        if (b->kind == BOUNDARY_MIRROR) continue;
        if (b->kind != BOUNDARY_TRACTION || b->time.kind != TIME_CONSTANT) return false;
        any = true;
    }
    return any;
}

/* REFUSED: the table does not answer, for the reason that status_message has. */
static status fault_unanswered(struct reader *r, const struct node *at)
{
    char why[480];
    snprintf(why, sizeof why, "%s", status_message());
    return fault(r, at, "%s; cleave run chooses by pilot runs, or write method and particles.spacing", why);
}

/* Matches the scene with a problem of the table. REFUSED without a match, or if strains exceed the accuracy. */
static status make_ask(struct ask *a)
{
    const struct node *solver = tree_at(a->root, "solver");
    const bool at_rest = solver && strcmp(solver->text, "explicit") != 0;
    a->slow_loads = loads_may_wait(a->scene);
    TRY(auto_match_find(&a->match, a->scene, at_rest));
    if (a->match.strain > a->accuracy)
        return status_set(REFUSED,
                          "strains of about %.2g are more than the accuracy of %.2g, and the table's problems are "
                          "linear",
                          a->match.strain, a->accuracy);
    return OK;
}

/* REFUSED: no point of the table is allowed and accurate enough; the message gives the smallest error that is
 * reached. */
static status fault_unreached(const struct ask *a, const struct auto_found *f)
{
    const struct auto_match *m = &a->match;
    if (!f->finest.of)
        return status_set(REFUSED,
                          "no method of the cost-accuracy table for %s does what this scene asks and fits the keys "
                          "of pd, mpm, model and spacing that it fixes",
                          m->kind->title);
    return status_set(REFUSED,
                      "an error of %.2g %% is not reached by the table of %s; %.2g %% is, by %s with %.4g spacings "
                      "in %s",
                      100 * a->accuracy, m->kind->title, 100 * m->growth * f->finest.error, f->finest.of->method,
                      f->finest.resolution * m->kind->per_resolution, m->kind->feature);
}

/* Picks the point and a spacing that fits the geometry, and writes them into the tree. */
static status choose(struct reader *r, struct node *root, struct ask *a, const struct cost_accuracy *table, real fixed)
{
    const real unit = a->match.feature / a->match.kind->per_resolution;      /* resolution x spacing */
    struct auto_wish w = {.match = &a->match,
                          .accuracy = a->accuracy / a->match.growth,
                          .resolution = fixed > 0 ? unit / fixed : 0,
                          .allows = allows,
                          .context = a};
    struct auto_found f, g = {0};
    real h = fixed;
    auto_pick(&f, table, &w);
    if (!f.best.of) return fault_unreached(a, &f);
    if (!(fixed > 0))
        h = auto_spacing_fit(a->scene, real_min(unit / f.best.resolution, auto_spacing_rings(a->scene)),
                             !cost_point_has(f.best.of, "method", "pd"));
    w.allows = allows_even;
    if (levels_of_point(f.best.of) > 0) auto_pick(&g, table, &w);
    keep_choice(&r->scene->choice, a, &f, h, g.best.of ? f.best.seconds / g.best.seconds : NAN);
    return auto_lay(r, root, &a->match, a->scene, f.best.of, h);
}

/* Reads the table given by accuracy_table, sought in the folder of the scene that names it, then in the current folder;
 * without this key the table of the program. */
static status read_cost_accuracy(struct reader *r, const struct node *root, struct cost_accuracy *table)
{
    const struct node *n = tree_at(root, "accuracy_table");
    char path[4096];
    if (!n) return cost_accuracy_read(table, NULL);
    if (n->kind != NODE_SCALAR || !*n->text)
        return fault(r, n, "%s is no file name; results/bench/cost_accuracy.csv is one", shown(r, n));
    const char *from = file_of(r, n->origin);
    snprintf(path, sizeof path, "%.*s%s", n->text[0] != '/' ? folder_length(from) : 0, from, n->text);
    return cost_accuracy_read(table, access(path, R_OK) == 0 ? path : n->text);
}

/* What the scene fixes, and what it wants of runs at coarse spacings. */
static status wish_read(struct reader *r, const struct node *root, struct pilot_wish *w)
{
    const struct node *spacing = tree_at(root, "particles.spacing"), *model = tree_at(root, "model");
    const struct node *solver = tree_at(root, "solver");
    TRY(auto_accuracy_read(r, root, w));
    if (spacing) TRY(read_number(r, key_find("particles", "spacing"), spacing, &w->spacing));
    if (model) snprintf(w->model, sizeof w->model, "%s", model->text);
    w->at_rest = solver && strcmp(solver->text, "explicit") != 0;
    w->has_accuracy = tree_at(root, "accuracy") != NULL;
    w->has_table = tree_at(root, "accuracy_table") != NULL;
    return OK;
}

/* From the table alone. */
static status resolve_by_table(struct reader *r, struct node *root, struct ask *a, const struct pilot_wish *w,
                               const struct cost_accuracy *table)
{
    if (w->figure[0])
        return status_set(REFUSED, "accuracy names a figure, %s, and the cost-accuracy table has others", w->figure);
    TRY(make_ask(a));
    return choose(r, root, a, table, w->spacing);
}

status auto_resolve(struct reader *r, struct node *root, const char *text, size_t length, struct pilot_wish *pilot)
{
    const struct node *method = root->kind == NODE_MAP ? tree_at(root, "method") : NULL;
    struct cost_accuracy table = {0};
    struct scene first = {0};
    struct pilot_wish wish = {0};
    if (!method || strcmp(method->text, "auto") != 0) return OK;
    if (tree_at(root, "steps"))
        return fault(r, method, "auto knows no load steps (steps); pd, or adaptive, is expected beside them");
    struct ask a = {.scene = &first, .root = root};
    status s = read_first(r, text, length, &first);
    if (s == OK) s = wish_read(r, root, &wish);
    if (s == OK) s = read_cost_accuracy(r, root, &table);
    if (s == OK) {
        a.accuracy = wish.within;
        s = resolve_by_table(r, root, &a, &wish, &table);
        wish.wanted = s == REFUSED;
    }
    if (wish.wanted) {
        snprintf(wish.why, sizeof wish.why, "%s", status_message());
        s = fault_unanswered(r, method);
    }
    cost_accuracy_free(&table);
    if (wish.wanted && pilot) {
        *pilot = wish;
        pilot->first = first;
        if (!*first.name) snprintf(pilot->first.name, sizeof first.name, "%s", r->scene->name);
    } else
        scene_free(&first);
    return s;
}
