/* floor 5: what a person would want to hear before a run, with the numbers it rests on. */
#include <math.h>
#include <stdio.h>

#include "solver_parts.h"

static int64_t bonds_cut(const struct engine *e)
{
    const struct bonds *b = &e->bonds;
    int64_t cut = 0;
    for (int64_t g = 0; g < b->groups; g++)
        for (int64_t q = b->slot[g] * LANES; q < (b->slot[g] + b->slot_count[g]) * LANES && !b->pattern[g]; q++)
            cut += b->inverse_length[q] < 0;
    return cut;
}

static void warn_of_method(const struct engine *e, FILE *out)
{
    const struct scene *s = e->scene;
    if (s->solver == SOLVER_EXPLICIT && e->dt > e->dt_critical)
        fprintf(out, "warning: the time step is above the critical one: expect a run that blows up\n");
    if (s->method == METHOD_MPM && s->cracks > 0)
        fprintf(out, "warning: method mpm has one velocity field and ignores the pre-cracks; pd or adaptive represent "
                     "them\n");
    if (s->method == METHOD_PD && s->bodies > 1)
        fprintf(out, "warning: peridynamic bodies do not meet in this version: they pass through each other; with mpm "
                     "and adaptive material points meet through the grid\n");
    if ((e->coupling == COUPLING_PM || e->coupling == COUPLING_PMG) && s->shape != SHAPE_LINEAR)
        fprintf(out, "warning: coupling pm and pmg are defined with mpm.shape linear; with other shapes they are pg and "
                     "pgg\n");
    if (s->method != METHOD_PD && s->cell < 1.5)
        fprintf(out, "warning: one point a cell (mpm.cell %.3g) leaves a zig-zag of 0.8 %% behind coupling interfaces; "
                     "2 is usual\n", s->cell);
}

static void warn_of_materials(const struct engine *e, FILE *out)
{
    for (int m = 0; m < e->scene->materials; m++) {
        const struct material *a = &e->scene->material[m];
        if (isfinite(e->elastic[m].trigger) && e->elastic[m].trigger > a->young * a->critical_stretch)
            fprintf(out, "warning: material %s converts at %.4g Pa, above E s_c = %.4g Pa: material points may pass the "
                         "strain at which bonds break\n", a->name, e->elastic[m].trigger, a->young * a->critical_stretch);
    }
}

static void warn_of_solver(const struct engine *e, FILE *out)
{
    const struct scene *s = e->scene;
    if (s->solver == SOLVER_EXPLICIT) return;
    for (int k = 0; k < s->initials; k++)
        if (s->initial[k].sets_velocity || s->initial[k].sets_pulse)
            fprintf(out, "warning: a static equilibrium has no velocities: those of `initial` are left out\n");
    if (e->solver.applied == 0 && solver_largest(&e->solver.driven, s->dim, e->part.n) == 0)
        fprintf(out, "warning: nothing loads the body at t = %.4g s: forces have their value at the end of the duration "
                     "there (a step that ends before has none)\n", s->duration);
}

static void warn_of_empty(const struct engine *e, FILE *out)
{
    for (int b = 0; b < e->loads.n; b++)
        if (e->loads.load[b].n == 0 && e->scene->boundary[b].kind == BOUNDARY_VELOCITY)
            fprintf(out, "warning: boundary %s holds no particle%s\n", e->scene->boundary[b].name,
                    e->scene->method == METHOD_PD ? "" : "; it acts on grid nodes in its region only");
    if (e->source.cracks > 0 && bonds_cut(e) == 0)
        fprintf(out, "warning: the pre-cracks cut no bond: do they lie in the body?\n");
}

/* Measured in inputs/bar_converge.yaml: mirrors 0.15 and 0.25 of a cell from a node give way so much that displacements
 * are 11 to 24 % off with 50 to 200 points a metre; halving the spacing takes away a third of that at the most. */
static void warn_of_mirrors(const struct engine *e, FILE *out)
{
    const struct scene *s = e->scene;
    for (int b = 0; b < s->boundaries; b++)
        if (s->method != METHOD_PD && s->boundary[b].kind == BOUNDARY_MIRROR &&
            !mirror_on_nodes(&s->boundary[b], &e->grid, s->spacing))
            fprintf(out, "warning: the mirror of boundary %s stands neither on a node of the grid nor half-way between "
                         "two: errors of 15 to 20 %%, and refinement helps little; mpm.origin or mpm.cell can move the "
                         "nodes\n",
                    s->boundary[b].name);
}

void engine_warn(const struct engine *e, FILE *out)
{
    warn_of_method(e, out);
    warn_of_materials(e, out);
    warn_of_solver(e, out);
    warn_of_empty(e, out);
    warn_of_mirrors(e, out);
}
