/* Sets up the bar of an EXACT probe: the order of its particles, the kinds of its ends, and its loads. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "probes_parts.h"

static const char *const form_names[EXACT_FORMS] = {"step bar", "plastic bar", "pulse", "manufactured"};

/* Returns REFUSED, with a message that consists of the name of the probe (a requested measurement), its closed form,
 * and the reason `what`. */
static status refuse(const struct probe *probe, const char *what)
{
    return status_set(REFUSED, "probe \"%s\": %s: %s", probe->request.name, form_names[probe->request.form], what);
}

/* ---- particles --------------------------------------------------------------------------------------------------- */

/* A particle i and its reference coordinate X [m], for sorting. */
struct located {
    real X;
    int32_t i;
};

/* Compares a and b (struct located) by position X, then by particle number, for sorting. */
static int probes_bar_make_by_position(const void *a, const void *b)
{
    const struct located *p = a, *q = b;
    if (p->X != q->X) return p->X < q->X ? -1 : 1;
    return p->i < q->i ? -1 : 1;
}

/* Computes b->order, the particles of p from left to right, and b->rank, the position of each particle in that order,
 * from 0. */
static void find_order(struct bar *b, const struct particles *p)
{
    struct located *sorted = NEW("probes.place", p->n, struct located);
    for (int64_t i = 0; i < p->n; i++) sorted[i] = (struct located){p->X[0][i], (int32_t)i};
    array_sort(sorted, p->n, sizeof *sorted, probes_bar_make_by_position);
    for (int64_t k = 0; k < p->n; k++) b->order[k] = sorted[k].i, b->rank[sorted[k].i] = (int32_t)k;
    memory_free(sorted);
}

/* Finds the particles of the run o that form the bar of the probe (kind EXACT: comparison with a closed-form solution),
 * allocates its arrays, and stores its ends and material constants. Returns REFUSED, with a message, unless the scene
 * is one row of at least three particles in 1D, of one material, and without a gap above 2.5 spacings. */
static status find_bar(struct probe *probe, const struct observed_run *o)
{
    const struct particles *p = o->part;
    struct bar *b = probe->bar;
    if (p->dim != 1)
        return refuse(probe,
                      "compares with the solution of a bar in one dimension; set space: line, or remove this probe");
    if (p->n < 3) return refuse(probe, "the bar has fewer than three particles; use a smaller particles.spacing");
    for (int64_t i = 1; i < p->n; i++)
        if (p->material[i] != p->material[0])
            return refuse(probe,
                          "the bar has several materials, but the analytical solution is for one; use one material");
    b->n = p->n;
    b->order = NEW("probes.order", b->n, int32_t), b->rank = NEW("probes.rank", b->n, int32_t);
    b->displacement = NEW("probes.displacement", b->n, real), b->velocity = NEW("probes.velocity", b->n, real);
    b->flux = NEW("probes.flux", b->n, real), b->strain = NEW("probes.strain", b->n, real);
    find_order(b, p);
    for (int64_t k = 1; k < b->n; k++) {
        real step = p->X[0][b->order[k]] - p->X[0][b->order[k - 1]];
        if (step <= 0 || step > 2.5 * o->spacing)
            return refuse(
                probe,
                step <= 0
                    ? "two particles are at the same position, so bodies overlap; use a single bar, or move them apart"
                    : "the bodies do not touch; use a single bar");
    }
    const struct material *m = &o->material[p->material[0]];
    b->exact.left = p->X[0][b->order[0]] - 0.5 * o->spacing;
    b->exact.right = p->X[0][b->order[b->n - 1]] + 0.5 * o->spacing;
    b->exact.young = m->young, b->exact.density = m->density;
    b->exact.yield = m->yield_stress, b->exact.tangent = m->yield_tangent;
    return OK;
}

/* ---- ends and loads ---------------------------------------------------------------------------------------------- */

/* Returns true if load l acts on particle number `particle`: if the particle is in the list of the load. */
static bool acts_on(const struct load *l, int32_t particle)
{
    for (int64_t k = 0; k < l->n; k++)
        if (l->particle[k] == particle) return true;
    return false;
}

/* Stores the reflection factor of both ends of the bar of the probe (a requested measurement): 1 (fixed) at a plane of
 * symmetry or where a support of the run o holds the outermost particle, else -1 (free). Returns REFUSED, with a
 * message, if a boundary drives the bar with a velocity. */
static status find_ends(struct probe *probe, const struct observed_run *o)
{
    struct bar *b = probe->bar;
    const real position[2] = {b->exact.left, b->exact.right};
    for (int end = 0; end < 2; end++) {
        int32_t outermost = b->order[end == 0 ? 0 : b->n - 1];
        b->exact.reflection[end] = -1;
        for (int k = 0; o->loads && k < o->loads->n; k++) {
            const struct load *l = &o->loads->load[k];
            const struct boundary *c = l->boundary;
            bool mirror = c->kind == BOUNDARY_MIRROR && fabs(c->at - position[end]) < o->spacing;
            bool held = c->kind == BOUNDARY_VELOCITY && acts_on(l, outermost);
            if (c->kind == BOUNDARY_VELOCITY && c->value[0] != 0)
                return refuse(probe,
                              "a boundary drives the bar with a velocity; use fixed, mirror or no boundary instead");
            if (mirror || held) b->exact.reflection[end] = 1;
        }
    }
    return OK;
}

/* Returns true if all particles of p are at their reference positions with zero velocity. */
static bool probes_bar_make_at_rest(const struct particles *p)
{
    for (int64_t i = 0; i < p->n; i++)
        if (p->v[0][i] != 0 || p->x[0][i] != p->X[0][i]) return false;
    return true;
}

/* Returns true if the initial velocities of all particles of p equal the sum of the pulses of e, within 1e-6 of the sum
 * of their amplitudes. They do not if a pulse is cut off by its region or by an end, or if there is other motion. */
static bool starts_with_pulses(const struct exact *e, const struct particles *p)
{
    real scale = 0;
    for (int k = 0; k < e->pulses; k++) scale += fabs(e->pulse[k].velocity);
    for (int64_t i = 0; i < p->n; i++)
        if (!(fabs(p->v[0][i] - bar_exact_solution_at_position(e, p->X[0][i], 0).velocity) <= 1e-6 * scale))
            return false;
    return true;
}

/* Returns the number of loads in the run o that have a boundary condition of kind `kind`. *found: receives the last of
 * them; unchanged if there is none. */
static int probes_bar_make_count_of(const struct observed_run *o, enum boundary_kind kind, const struct load **found)
{
    int n = 0;
    for (int k = 0; o->loads && k < o->loads->n; k++)
        if (o->loads->load[k].boundary->kind == kind) n++, *found = &o->loads->load[k];
    return n;
}

/* Finds the traction of the run o on one end of the bar of the probe (a requested measurement) and stores the end in
 * exact.loaded and the stress in exact.load, positive in tension [Pa]. Returns REFUSED, with a message, unless there
 * is exactly one traction, on a free end, constant in time and not 0. */
static status find_traction(struct probe *probe, const struct observed_run *o)
{
    struct bar *b = probe->bar;
    const struct load *l = NULL;
    int n = probes_bar_make_count_of(o, BOUNDARY_TRACTION, &l);
    if (n == 0) return refuse(probe, "no boundary is a traction; add one on an end of the bar");
    if (n > 1) return refuse(probe, "more than one boundary is a traction; keep one, on an end of the bar");
    const struct boundary *c = l->boundary;
    int end = c->side > 0 ? 1 : 0;
    if (!acts_on(l, b->order[end == 1 ? b->n - 1 : 0]))
        return refuse(probe,
                      "the traction does not act on the end of the bar; remove its region, or extend it to the end");
    if (c->time.kind != TIME_CONSTANT || c->formula[0].n > 0)
        return refuse(probe, "the traction changes with time; set time: constant");
    if (b->exact.reflection[end] > 0) return refuse(probe, "the loaded end is held; hold the other one");
    b->exact.loaded = c->side, b->exact.load = c->side * c->value[0];
    if (b->exact.load == 0) return refuse(probe, "the traction is 0; give it a value");
    return OK;
}

/* Stores the ends of the bar of the probe (a requested measurement), and the traction or the initial pulses that its
 * closed form requires. Returns REFUSED, with a message, for loads, initial motion or materials of the run o that the
 * closed form does not describe. */
static status find_load(struct probe *probe, const struct observed_run *o)
{
    const struct load *other = NULL;
    const struct material *m = &o->material[o->part->material[0]];
    if (probes_bar_make_count_of(o, BOUNDARY_BODY_FORCE, &other) > 0)
        return refuse(probe, "a body_force acts on the bar; remove it");
    if (probes_bar_make_count_of(o, BOUNDARY_PRESSURE, &other) > 0)
        return refuse(probe, "a pressure acts on the bar; use a traction on one end instead");
    if (probes_bar_make_count_of(o, BOUNDARY_ABSORBING, &other) > 0)
        return refuse(probe,
                      "an end of the bar is absorbing, for which there is no analytical solution; use fixed, mirror "
                      "or no boundary there");
    TRY(find_ends(probe, o));
    if (probe->request.form == EXACT_PULSE) {
        if (o->pulses == 0)
            return refuse(probe, "needs a pulse, but the scene starts none; add a pulse under the key initial");
        if (probes_bar_make_count_of(o, BOUNDARY_TRACTION, &other) > 0)
            return refuse(probe, "a traction acts on the bar; remove it");
        probe->bar->exact.pulse = o->pulse, probe->bar->exact.pulses = o->pulses;
        return starts_with_pulses(&probe->bar->exact, o->part)
                   ? OK
                   : refuse(probe, "the initial state must be pulses alone, away from the ends; remove other initial "
                                   "states, or move the pulses");
    }
    if (!probes_bar_make_at_rest(o->part))
        return refuse(probe, "the bar moves or is strained at the start; let it start at rest");
    TRY(find_traction(probe, o));
    if (probe->request.form == EXACT_STEP_BAR) return OK;
    if (!material_yields(m)) return refuse(probe, "the material does not yield; add material.yield_stress");
    if (m->law.given && (m->law.flow != FLOW_LINEAR || m->law.kinematic.modulus > 0))
        return refuse(probe,
                      "the analytical solution is for a material with yield_stress and yield_tangent; give these "
                      "keys in place of another law");
    if (fabs(probe->bar->exact.load) > m->yield_stress && !(m->yield_tangent > 0))
        return refuse(probe, "without hardening there is no plastic front; add material.yield_tangent");
    return OK;
}

status bar_probe_find_bar_and_load(struct probe *probe, const struct observed_run *o)
{
    const struct probe_request *r = &probe->request;
    probe->bar = NEW("probes.bar", 1, struct bar);
    probe->bar->exact.form = r->form;
    TRY(find_bar(probe, o));
    if (r->form != EXACT_MANUFACTURED) return find_load(probe, o);
    probe->bar->exact.amplitude = r->amplitude, probe->bar->exact.period = r->period;
    probe->bar->exact.wavelength = r->wavelength, probe->bar->exact.origin = r->origin;
    return OK;
}

void bar_probe_free_bar(struct bar *bar)
{
    if (!bar) return;
    memory_free(bar->order);
    memory_free(bar->rank);
    memory_free(bar->displacement);
    memory_free(bar->velocity);
    memory_free(bar->flux);
    memory_free(bar->strain);
    memory_free(bar);
}
