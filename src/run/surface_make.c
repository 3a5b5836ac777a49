/* Weights of bonds near faces, with messages where the lattice that they require is interrupted. */
#include <math.h>
#include <stdio.h>

#include "run/make.h"

/* Returns the number in `loads` of a boundary condition `mirror` (plane of symmetry) whose plane is between the
 * positions X and Y [m] along `axis`, or -1 if there is none. */
static int mirror_between(const struct loads *loads, const real *X, const real *Y, int axis)
{
    for (int b = 0; b < loads->n; b++) {
        const struct boundary *m = loads->load[b].boundary;
        const bool across = (X[axis] - m->at) * (Y[axis] - m->at) <= 0;
        if (m->kind == BOUNDARY_MIRROR && m->axis == axis && across) return b;
    }
    return -1;
}

/* Returns the number of the body of scene s whose shape contains the position X [m], among the bodies joined to body
 * `body`; joined bodies are bonded to each other and counted as one. Returns `body` if no shape contains X. */
static int body_made_for(const struct scene *s, const real *X, int body)
{
    for (int b = 0; b < s->bodies; b++)
        if (s->body[b].joined == body && !s->body[b].file &&
            region_contains(&s->body[b].shape, X, s->dim, ON_SURFACE * s->spacing))
            return b;
    return body;
}

/* Returns REFUSED, with the message that the mirror m of the body of particle i is neither on a row of the body's
 * lattice nor half a spacing from one, so that the lattice does not continue beyond it. p: all particles. */
static status refuse_rows(const struct scene *s, const struct particles *p, int64_t i, const struct boundary *m)
{
    real X[DIM_MAX];
    particle_reference_position(p, i, X);
    const real rows = fabs(X[m->axis] - m->at) / s->spacing, beside = rows - floor(rows);
    return status_set(REFUSED,
                      "body %s: the mirror of boundary %s at %c = %.6g m does not continue the lattice of particles, "
                      "whose first row is %.3g spacings from the plane, not 0.5; make the size of the body along %c a "
                      "multiple of particles.spacing, or set pd.surface: volume",
                      s->body[body_made_for(s, X, p->body[i])].name, m->name, "xyz"[m->axis], m -> at, beside,
                      "xyz"[m->axis]);
}

/* Returns REFUSED, with the message that the distance of particles i and j along an axis is not a whole number of
 * spacings. i must be below p->n; j may be the mirror image of a particle in a mirror of `loads`. s: scene, with
 * spacing and names. */
static status refuse_apart(const struct scene *s, const struct particles *p, const struct loads *loads, int64_t i,
                           int64_t j)
{
    real X[DIM_MAX], Y[DIM_MAX], steps[DIM_MAX] = {0}, worst = 0;
    int axis = 0;
    particle_reference_position(p, i, X), particle_reference_position(p, j, Y);
    for (int d = 0; d < p->dim; d++) {
        steps[d] = (Y[d] - X[d]) / s->spacing;
        const real off = fabs(steps[d] - nearbyint(steps[d]));
        if (off > worst) worst = off, axis = d;
    }
    const int mirror = j < p->n ? -1 : mirror_between(loads, X, Y, axis);
    if (mirror >= 0) return refuse_rows(s, p, i, loads->load[mirror].boundary);
    const struct position_text here = position_text(X, p->dim, 4), there = position_text(Y, p->dim, 4),
                               apart = position_text(steps, p->dim, 4);
    const int body = body_made_for(s, X, p->body[i]), beside = body_made_for(s, Y, p->body[j]);
    const char *own = s->body[body].name, *other = s->body[beside].name;
    if (body != beside)
        return status_set(
            REFUSED,
            "bodies %s and %s are joined, but not on one lattice: their particles at (%s) m and (%s) m are (%s) "
            "spacings apart; give sizes and positions of both in whole spacings, or set pd.surface: volume",
            own, other, here.text, there.text, apart.text);
    return status_set(REFUSED,
                      "body %s: its particles at (%s) m and (%s) m are (%s) spacings apart, so they are not on one "
                      "lattice; use distances of whole spacings, or set pd.surface: volume",
                      own, here.text, there.text, apart.text);
}

status surface_correction_compute_bond_weight_factors(struct surface_correction *correction, struct bond_source *source,
                                                      const struct particles *p, const struct loads *loads,
                                                      const struct scene *s)
{
    const status made = surface_correction_fit_bond_weight_factors(correction, p, source, source->rotates);
    if (made == OK) source->surface = correction;
    return made == REFUSED && correction->apart[0] >= 0
               ? refuse_apart(s, p, loads, correction->apart[0], correction->apart[1])
               : made;
}
