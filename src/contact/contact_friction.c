/* Friction of Coulomb: a spring along the face holds what touches, and gives way where it would pull harder than
 * friction times the pressure. Its energy counts as one of contact; what it loses by giving way or by parting is
 * friction's work. */
#include <math.h>

#include "base/memory.h"
#include "base/team.h"
#include "contact_internal.h"

/* The spring lies in the face, which may have turned since: its length stays. */
static void lay_down(real *spring, const real *normal, int dim)
{
    const real out = dot(spring, normal, dim), before = dot(spring, spring, dim), after = before - square(out);
    if (!(after > 0)) return;
    for (int d = 0; d < dim; d++) spring[d] = (spring[d] - out * normal[d]) * sqrt(before / after);
}

void contact_slide(struct contact_spring *s, int dim, const real *normal, const real *way, real k, real most)
{
    real along[DIM_MAX], before[DIM_MAX], length2 = 0, stored = 0, work = 0;
    lay_down(s->length, normal, dim);
    for (int d = 0; d < dim; d++) {
        along[d] = way[d] - dot(way, normal, dim) * normal[d];
        before[d] = s->length[d];
        s->length[d] += along[d];
        length2 += square(s->length[d]);
    }
    const real share = k * sqrt(length2) > most ? most / (k * sqrt(length2)) : 1;
    for (int d = 0; d < dim; d++) {
        s->length[d] *= share;
        s->drag[d] = -k * s->length[d];
        work += 0.5 * k * (before[d] + s->length[d]) * along[d];     /* as leap-frog takes it from the motion */
        stored += 0.5 * k * square(s->length[d]);
    }
    s->lost += work + s->stored - stored;
    s->stored = stored;
}

/* ---- faces ------------------------------------------------------------------------------------------------------- */

/* Normal force on the particle of a row as one that feels, and the mean velocity of what it feels. */
struct contact_pressure { real force[DIM_MAX], velocity[DIM_MAX], density; };

static struct contact_pressure pressure_on(const struct contact *c, const struct particles *p, int64_t row)
{
    struct contact_pressure sum = {{0}, {0}, 0};
    for (int64_t q = c->first[row]; q < c->first[row + 1]; q++) {
        const struct contact_weight w = contact_weight(c, p, row, c->other[q]);
        const int32_t j = c->particle[c->other[q]];
        if (w.weight == 0) continue;
        sum.density += w.weight;
        for (int d = 0; d < p->dim; d++) {
            sum.force[d] -= w.pull * w.apart[d];
            sum.velocity[d] += w.weight * p->v[d][j];
        }
    }
    for (int d = 0; d < p->dim && sum.density > 0; d++) sum.velocity[d] /= sum.density;
    return sum;
}

void contact_face_slide(struct contact *c, const struct particles *p, int64_t row, real dt)
{
    struct contact_spring *s = &c->spring[row];
    const real k = 0.5 * c->face[row].stiffness / square(c->size[row]);
    if (c->face[row].push == 0 && s->stored == 0) return;
    const struct contact_pressure pressure = pressure_on(c, p, row);
    const real force = sqrt(dot(pressure.force, pressure.force, p->dim));
    real normal[DIM_MAX], way[DIM_MAX];
    for (int d = 0; d < p->dim; d++) {
        normal[d] = force > 0 ? pressure.force[d] / force : 0;
        way[d] = (p->v[d][c->particle[row]] - pressure.velocity[d]) * dt;
    }
    s->density = pressure.density;
    contact_slide(s, p->dim, normal, way, k, c->law.friction * force);
}

void contact_face_drag(const struct contact *c, struct particles *p, int64_t row)
{
    const int32_t i = c->particle[row];
    real f[DIM_MAX];
    for (int d = 0; d < p->dim; d++) f[d] = c->spring[row].drag[d];
    for (int64_t q = c->first[row]; q < c->first[row + 1]; q++) {
        const int64_t l = c->other[q];
        const struct contact_spring *other = &c->spring[c->root[l]];
        if (c->face[c->root[l]].push == 0) continue;
        const real share = contact_weight(c, p, l, row).weight / other->density;
        for (int d = 0; d < p->dim; d++) f[d] -= share * other->drag[d];
    }
    for (int d = 0; d < p->dim; d++) p->f[d][i] += f[d];
}

/* ---- energies ---------------------------------------------------------------------------------------------------- */

static real stored_in(const void *context, int64_t k) { return ((const struct contact_spring *)context)[k].stored; }
static real lost_by(const void *context, int64_t k) { return ((const struct contact_spring *)context)[k].lost; }

static real springs_sum(const struct contact *c, real (*term)(const void *context, int64_t k))
{
    real sum = c->spring ? team_sum(c->rows, term, c->spring) : 0;
    for (int b = 0; b < c->rigids && c->near; b++)
        if (c->near[b].spring) sum += team_sum(c->near[b].n, term, c->near[b].spring);
    return sum;
}

real contact_friction_stored(const struct contact *c) { return springs_sum(c, stored_in); }
real contact_friction_work(const struct contact *c) { return c->friction_work + springs_sum(c, lost_by); }

/* Springs of those that touch go on with their particles; what the others hold is lost. */
void contact_springs_begin(struct contact *c, const struct contact *before)
{
    if (!(c->law.friction > 0)) return;
    c->spring = NEW("contact.spring", c->rows, struct contact_spring);
    for (int64_t row = 0; row < c->rows; row++)
        contact_spring_take(&c->spring[row], before->spring,
                            before->made ? contact_row_of(before, c->particle[row]) : -1);
}

void contact_spring_take(struct contact_spring *to, const struct contact_spring *before, int64_t at)
{
    if (!before || at < 0) return;
    *to = before[at];
    to->lost = 0;
}

void contact_friction_settle(struct contact *c, const struct contact *before)
{
    c->friction_work = contact_friction_work(before) + contact_friction_stored(before) - contact_friction_stored(c);
}
