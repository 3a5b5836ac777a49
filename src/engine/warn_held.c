/* Warns of supports that leave nothing to move, of two supports that prescribe different motions of the same particles,
 * and of loads on particles whose motion a support prescribes. */
#include <math.h>
#include <stdio.h>

#include "base/memory.h"
#include "engine_internal.h"

#define IDLE_SHARE 0.5 /* share of a force on held particles from which on it is reported [1] */

enum { MOMENTS_OF_SUPPORTS = 8 }; /* times at which motions of supports and forces of loads are evaluated */

/* Adds a warning to *to if load l of scene s prescribes zero displacement in all components for all particles p, so
 * that nothing can move. Adds none if some particles are not created (p->n < p->n_body). */
static void warn_of_held(const struct scene *s, const struct load *l, const struct particles *p, struct warnings *to)
{
    const struct boundary *b = l->boundary;
    const unsigned all = (1u << s->dim) - 1;
    if (!boundary_is_support_at_rest(b, s->dim) || l->n < p->n || p->n < p->n_body || (b->components & all) != all)
        return;
    warnings_add_if_new(to,
                        "boundary %s fixes all %lld particles, so nothing can move; check the units of its region (m "
                        "if none is written)",
                        b->name, (long long)l->n);
}

/* Returns true if load l prescribes a motion whose displacement is known at all times. */
static bool motion_known(const struct load *l)
{
    return l->boundary->kind == BOUNDARY_VELOCITY &&
           boundary_check_velocity_has_closed_form_integral(l->boundary) == OK;
}

/* Returns the components in which loads a and b prescribe different displacements of one particle of p, as bits (bit d
 * for component d). The displacements are compared at MOMENTS_OF_SUPPORTS times in the duration of scene s. The
 * particle is number j in the list of load a and number k in that of load b. */
static unsigned components_apart(const struct scene *s, const struct particles *p, const struct load *a, int64_t j,
                                 const struct load *b, int64_t k)
{
    unsigned apart = 0;
    for (int m = 1; m <= MOMENTS_OF_SUPPORTS; m++) {
        real u[DIM_MAX], w[DIM_MAX];
        const real t = scene_is_single_equilibrium(s) ? INFINITY : s->duration * m / MOMENTS_OF_SUPPORTS;
        load_prescribed_displacement_of_particle(a, p, j, t, u);
        load_prescribed_displacement_of_particle(b, p, k, t, w);
        for (int d = 0; d < s->dim; d++)
            if (fabs(u[d] - w[d]) > 1e-6 * (fabs(u[d]) + fabs(w[d]))) apart |= 1u << d;
    }
    return apart & a->boundary->components & b->boundary->components;
}

/* Adds a warning to *to if loads a and b of scene s prescribe different motions of particles of p in the same
 * components; the later load, b, then moves these particles. Does nothing if a motion is not known at all times. */
static void warn_of_contrary(const struct scene *s, const struct particles *p, const struct load *a,
                             const struct load *b, struct warnings *to)
{
    int64_t common = 0;
    unsigned apart = 0;
    char axes[2 * DIM_MAX + 1] = "";
    int used = 0;
    if (!motion_known(a) || !motion_known(b) || !(a->boundary->components & b->boundary->components)) return;
    for (int64_t j = 0, k = 0; j < a->n && k < b->n;) {
        const int32_t i = a->particle[j], other = b->particle[k];
        const unsigned here = i == other ? components_apart(s, p, a, j, b, k) : 0;
        apart |= here, common += here != 0;
        j += i <= other, k += other <= i;
    }
    if (common == 0) return;
    for (int d = 0; d < s->dim; d++)
        if (apart >> d & 1)
            used += snprintf(axes + used, sizeof axes - (size_t)used, "%s%c", used ? "," : "", "xyz"[d]);
    warnings_add_if_new(
        to,
        "boundaries %s and %s prescribe different motions along %s of the same %lld particle%s: the later one, %s, "
        "moves %s; change their order, or give each boundary a face or region of its own",
        a->boundary->name, b->boundary->name, axes, (long long)common, common == 1 ? "" : "s", b->boundary->name,
        common == 1 ? "it" : "them");
}

uint8_t *loads_find_prescribed_motion_components(const struct loads *loads, const struct particles *p)
{
    uint8_t *prescribed = NEW("warn.prescribed", p->n, uint8_t);
    for (int b = 0; b < loads->n; b++) {
        const struct load *l = &loads->load[b];
        for (int64_t k = 0; k < l->n && l->boundary->kind == BOUNDARY_VELOCITY; k++)
            prescribed[l->particle[k]] |= l->prescribes[k];
    }
    return prescribed;
}

/* Returns the sum of the magnitudes of the forces of load l along axis d, over its particles and MOMENTS_OF_SUPPORTS
 * times in the duration of scene s [N]. *idle: receives the part of the sum on particles whose component d is
 * prescribed [N]. prescribed[p->n]: bit d is set if component d of a particle is prescribed. */
static real force_and_idle_part(const struct scene *s, const struct particles *p, const struct load *l, int d,
                                const uint8_t *prescribed, real *idle)
{
    real all = 0;
    *idle = 0;
    for (int m = 1; m <= MOMENTS_OF_SUPPORTS; m++)
        for (int64_t k = 0; k < l->n; k++) {
            real force[DIM_MAX] = {0};
            load_force_on_particle(l, p, k, s->duration * m / MOMENTS_OF_SUPPORTS, force);
            all += fabs(force[d]);
            if (prescribed[l->particle[k]] >> d & 1) *idle += fabs(force[d]);
        }
    return all;
}

/* Adds a warning to *to for each traction, pressure and body force in `loads` of which the larger part along some axis
 * has no effect, because it acts on particles of p whose motion along this axis a support prescribes. s: scene. */
static void warn_of_idle_forces(const struct scene *s, const struct loads *loads, const struct particles *p,
                                struct warnings *to)
{
    uint8_t *prescribed = loads_find_prescribed_motion_components(loads, p);
    for (int b = 0; b < loads->n; b++)
        for (int d = 0; d < s->dim; d++) {
            const struct load *l = &loads->load[b];
            real idle;
            if (!boundary_applies_force(l->boundary) || l->boundary->by_mass) continue;
            const real all = force_and_idle_part(s, p, l, d, prescribed, &idle);
            if (!(idle > IDLE_SHARE * all)) continue;
            warnings_add_if_new(to,
                                "boundary %s: %.3g %% of its force along %c acts on particles whose motion along %c a "
                                "support prescribes, and has no effect there; remove the load or the support, or give "
                                "each a face or region of its own",
                                l->boundary->name, 100 * idle / all, "xyz"[d], "xyz"[d]);
        }
    memory_free(prescribed);
}

void run_warn_of_conflicting_supports(const struct scene *s, const struct loads *loads, const struct particles *p,
                                      struct warnings *warnings)
{
    for (int a = 0; a < loads->n; a++) {
        warn_of_held(s, &loads->load[a], p, warnings);
        for (int b = 0; b < a; b++) warn_of_contrary(s, p, &loads->load[b], &loads->load[a], warnings);
    }
    warn_of_idle_forces(s, loads, p, warnings);
}
