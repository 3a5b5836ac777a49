/* List of all points of the cost-accuracy table, and their scenes. */
#include <stdio.h>
#include <string.h>

#include "accuracy.h"
#include "base/memory.h"
#include "scene/scene_read.h"

const struct accuracy_problem *const accuracy_problem[] = {
    &accuracy_bar,    &accuracy_wave,  &accuracy_square,   &accuracy_cube, &accuracy_hole, &accuracy_cracks,
    &accuracy_sudden, &accuracy_spall, &accuracy_fracture, &accuracy_beam, &accuracy_rod};
const int accuracy_problems = COUNT_OF(accuracy_problem);

int accuracy_case_count(const struct accuracy_problem *problem)
{
    int n = 0;
    while (n < ACCURACY_CASES && problem->cases[n]) n++;
    return n;
}

/* ---- scenes ------------------------------------------------------------------------------------------------------ */

/* Composes the scene of a point (a run of the cost-accuracy table): the scene of its problem, with the keys of its
 * method, its horizon and its time step. */
void accuracy_compose_scene_of_point(const struct accuracy_point *point, struct accuracy_scene *scene)
{
    memset(scene, 0, sizeof *scene);
    point->problem->scene(point, scene);
    for (int k = 0; k < ACCURACY_SETTINGS && point->method->set[k].key; k++)
        bench_overrides_append(&scene->set, point->method->set[k].key, "%s", point->method->set[k].value);
    if (point->horizon > 0) bench_overrides_append(&scene->set, "particles.horizon", "%.9g", point->horizon);
    bench_overrides_append(&scene->set, "time.step", "auto");
    bench_overrides_append(&scene->set, "time.safety", "%.9g", point->step);
    bench_overrides_append(&scene->set, "contact.between", "none"); /* no bodies come into contact in these problems */
    bench_overrides_append(&scene->set, "output.frames", "0");
    bench_overrides_append(&scene->set, "output.samples", "%d", point->problem->samples ? point->problem->samples : 1);
}

/* Adds a text to an FNV-1a hash. The hash of a point is made of the text of its scene with all defaults and of the name
 * of the processor, and thus covers everything that changes its result. */
static void add_to_hash(uint64_t *hash, const char *text)
{
    for (; *text; text++) *hash = (*hash ^ (unsigned char)*text) * 1099511628211u;
}

static status read_settings(struct accuracy_entry *entry, const char *machine)
{
    struct accuracy_scene from;
    struct scene s;
    uint64_t hash = 14695981039346656037u;
    accuracy_compose_scene_of_point(&entry->point, &from);
    const struct scene_override *set = bench_overrides_as_array(&from.set);
    TRY(from.path[0] ? scene_read(&s, from.path, set, from.set.n)
                     : scene_read_text(&s, from.text, strlen(from.text), entry->point.problem->name, set, from.set.n));
    add_to_hash(&hash, s.text);
    add_to_hash(&hash, machine);
    scene_free(&s);
    snprintf(entry->result.settings, sizeof entry->result.settings, "%016llx", (unsigned long long)hash);
    return OK;
}

/* ---- points ------------------------------------------------------------------------------------------------------ */

/* Adds point p, a run of the cost-accuracy table, to the plan, unless its problem excludes it. quick: true if it
 * also runs with --quick. Returns REFUSED or FAILED if its scene cannot be read. */
static status add_point(struct accuracy_plan *plan, struct accuracy_point p, bool quick)
{
    if (p.problem->applies && !p.problem->applies(&p)) return OK;
    GROW("bench.plan", plan->entry, plan->n + 1);
    plan->entry[plan->n] = (struct accuracy_entry){.point = p, .quick = quick};
    return read_settings(&plan->entry[plan->n++], plan->machine.model);
}

/* Adds copies of point p to the plan that differ from it in the horizon or in the time step. all: true to add every
 * horizon and time step listed by the problem; false to add only its first horizon and, if its member `steps` is true,
 * its first time step. quick: true if p runs with --quick; if `steps` is true, its copy with the first time step then
 * does, too. Returns REFUSED or FAILED if a scene cannot be read. */
static status add_variations(struct accuracy_plan *plan, struct accuracy_point p, bool all, bool quick)
{
    const struct accuracy_problem *q = p.problem;
    struct accuracy_point varied = p;
    for (int k = 0; k < (all ? ACCURACY_VARIATIONS : 1) && q->horizon[k] > 0 && p.method->family & ACCURACY_PD; k++) {
        varied.horizon = q->horizon[k];
        TRY(add_point(plan, varied, false));
    }
    varied = p;
    for (int k = 0; k < (all ? ACCURACY_VARIATIONS : q->steps) && q->step[k] > 0; k++) {
        varied.step = q->step[k];
        TRY(add_point(plan, varied, quick && q->steps && k == 0));
    }
    return OK;
}

static status add_case(struct accuracy_plan *plan, const struct accuracy_problem *q, int at, int r)
{
    const int varied = q->varied ? q->varied - 1 : 1;
    for (int m = 0; m < accuracy_methods; m++) {
        const struct accuracy_method *method = &accuracy_method[m];
        if (!(method->family & q->families) || (accuracy_method_has_coarse_cells(method) && !q->levels)) continue;
        struct accuracy_point p = {.problem = q,
                                   .method = method,
                                   .at = at,
                                   .resolution = q->resolution[r],
                                   .step = ACCURACY_STEP,
                                   .horizon = method->family & ACCURACY_MPM ? 0 : ACCURACY_HORIZON};
        const bool quick = method->quick && r < q->quick_resolutions;
        TRY(add_point(plan, p, quick));
        TRY(add_variations(plan, p, r == varied, quick));
    }
    return OK;
}

/* Returns false if the scene file of problem q is missing. The problem is then left out. */
static bool is_here(const struct accuracy_problem *q)
{
    const struct accuracy_point any = {
        .problem = q, .method = accuracy_method, .resolution = q->resolution[0], .step = ACCURACY_STEP};
    struct accuracy_scene s;
    accuracy_compose_scene_of_point(&any, &s);
    return !s.path[0] || bench_scene_exists(s.path);
}

/* Creates the list of all points (runs) of the cost-accuracy table in *plan, from coarse to fine resolution, so that an
 * interrupted table has every case and method. Returns REFUSED or FAILED if a scene cannot be read. Release with
 * accuracy_plan_free. */
status accuracy_plan_make(struct accuracy_plan *plan)
{
    *plan = (struct accuracy_plan){.machine = machine_properties()};
    for (int k = 0; k < accuracy_problems; k++) {
        const struct accuracy_problem *q = accuracy_problem[k];
        if (!is_here(q)) continue;
        for (int r = 0; r < ACCURACY_RESOLUTIONS && q->resolution[r]; r++)
            for (int at = 0; at < accuracy_case_count(q); at++) TRY(add_case(plan, q, at, r));
    }
    return OK;
}

void accuracy_plan_free(struct accuracy_plan *plan)
{
    memory_free(plan->entry);
    *plan = (struct accuracy_plan){0};
}
