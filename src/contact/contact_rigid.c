/* Contact of particles with rigid bodies: a particle whose centre is nearer than half a spacing to the surface is
 * pushed off along its normal by 2 k times what is missing, k that of two particles of its material: the face has one
 * cell of material, not two. Energy: k missing^2. */
#include <math.h>
#include <stdio.h>

#include "base/memory.h"
#include "base/team.h"
#include "contact_internal.h"

void contact_rigid_free(struct contact *c)
{
    for (int b = 0; b < c->rigids && c->near; b++) memory_free(c->near[b].row), memory_free(c->near[b].zero);
    memory_free(c->near);
    c->near = NULL;
}

/* ---- the search -------------------------------------------------------------------------------------------------- */

/* Distance of the surface above the particle of a row from a body, negative: overlap [m]; normal of the surface. */
static real gap_of(const struct contact *c, const struct particles *p, const struct rigid_body *r, int64_t row,
                   real *normal)
{
    const int32_t i = c->particle[row];
    real x[DIM_MAX] = {0};
    for (int d = 0; d < p->dim; d++) x[d] = p->x[d][i];
    return rigid_distance(r, x, normal) - (0.5 + c->rise[row]) * c->size[row];
}

/* Can the particle come near the body before the next search? A quick answer for the many that are far. */
static bool is_near(const struct contact *c, const struct particles *p, const struct rigid_body *r, int64_t row,
                    real skin)
{
    real far2 = 0, normal[DIM_MAX];
    for (int d = 0; d < p->dim; d++) far2 += square(p->x[d][c->particle[row]] - r->x[d]);
    if (r->motion != RIGID_FIXED && far2 > square(r->radius + c->size[row] + skin)) return false;
    return gap_of(c, p, r, row, normal) < skin;
}

static real zero_before(const struct contact *before, int body, int64_t row)
{
    int64_t low = 0, high = before->near ? before->near[body].n : 0;
    while (row >= 0 && low < high) {
        const int64_t middle = (low + high) / 2;
        if (before->near[body].row[middle] < row) low = middle + 1;
        else high = middle;
    }
    const bool found = row >= 0 && before->near && low < before->near[body].n && before->near[body].row[low] == row;
    return found ? before->near[body].zero[low] : INFINITY;
}

/* Where contact begins follows a particle that is met closer, until it opens: as of pairs. */
static void near_find_body(struct contact *c, const struct contact *before, const struct particles *p, int body,
                           real skin)
{
    const struct rigid_body *r = &c->rigid[body];
    struct contact_near *near = &c->near[body];
    uint8_t *found = BARE("contact.found", c->rows, uint8_t);
    real normal[DIM_MAX];
#pragma omp parallel for schedule(static)
    for (int64_t row = 0; row < c->rows; row++) found[row] = is_near(c, p, r, row, skin);
    near->n = 0;
    for (int64_t row = 0; row < c->rows; row++) near->n += found[row];
    near->row = BARE("contact.near", near->n, int32_t);
    near->zero = BARE("contact.zero", near->n, real);
    near->n = 0;
    for (int64_t row = 0; row < c->rows; row++) {
        if (!found[row]) continue;
        const int64_t was = before->made ? contact_row_of(before, c->particle[row]) : -1;
        const real gap = gap_of(c, p, r, row, normal), zero = zero_before(before, body, was);
        near->row[near->n] = (int32_t)row;
        near->zero[near->n++] = real_min(0, isfinite(zero) ? real_max(zero, gap) : gap);
    }
    memory_free(found);
}

void contact_rigid_find(struct contact *c, const struct contact *before, const struct particles *p, real skin)
{
    c->near = c->rigids > 0 ? NEW("contact.bodies", c->rigids, struct contact_near) : NULL;
    for (int b = 0; b < c->rigids; b++) {
        near_find_body(c, before, p, b, skin);
        for (int d = 0; d < DIM_MAX; d++) c->near[b].x[d] = c->rigid[b].x[d];
        for (int k = 0; k < DIM_MAX * DIM_MAX; k++) c->near[b].turn[k] = c->rigid[b].turn[k / DIM_MAX][k % DIM_MAX];
    }
}

bool contact_rigid_has_come(const struct contact *c, real far)
{
    for (int b = 0; b < c->rigids && c->near; b++) {
        const struct rigid_body *r = &c->rigid[b];
        real way2 = 0, turned2 = 0;
        for (int d = 0; d < DIM_MAX; d++) way2 += square(r->x[d] - c->near[b].x[d]);
        for (int k = 0; k < DIM_MAX * DIM_MAX; k++)
            turned2 += square(r->turn[k / DIM_MAX][k % DIM_MAX] - c->near[b].turn[k]);
        if (!(sqrt(way2) + sqrt(turned2) * r->radius < far)) return true;
    }
    return false;
}

/* ---- forces and energy ------------------------------------------------------------------------------------------- */

/* Force of a body on the particle of its list entry q [N]; returns the overlap [m], 0: none. */
static real push_of(const struct contact *c, const struct particles *p, int body, int64_t q, real *force)
{
    const struct contact_near *near = &c->near[body];
    real normal[DIM_MAX] = {0};
    const real overlap = near->zero[q] - gap_of(c, p, &c->rigid[body], near->row[q], normal);
    const real k = 2 * contact_stiffness(c, p, near->row[q], near->row[q]);
    for (int d = 0; d < DIM_MAX; d++) force[d] = overlap > 0 ? k * overlap * normal[d] : 0;
    return real_max(overlap, 0);
}

struct rigid_sum { const struct contact *c; const struct particles *p; int body; };

/* Force and moment on the body, and the energy: seven sums. */
static void rigid_block(const void *context, int64_t first, int64_t end, real *sum)
{
    const struct rigid_sum *s = context;
    const struct contact_near *near = &s->c->near[s->body];
    for (int64_t q = first; q < end; q++) {
        real f[DIM_MAX], arm[DIM_MAX] = {0};
        const real overlap = push_of(s->c, s->p, s->body, q, f);
        const int32_t i = s->c->particle[near->row[q]];
        if (overlap == 0) continue;
        for (int d = 0; d < s->p->dim; d++) arm[d] = s->p->x[d][i] - s->c->rigid[s->body].x[d], sum[d] -= f[d];
        for (int d = 0; d < DIM_MAX; d++) {
            const int a = (d + 1) % DIM_MAX, b = (d + 2) % DIM_MAX;
            sum[DIM_MAX + d] -= arm[a] * f[b] - arm[b] * f[a];
        }
        sum[2 * DIM_MAX] += contact_stiffness(s->c, s->p, near->row[q], near->row[q]) * square(overlap);
    }
}

enum { RIGID_TERMS = 2 * DIM_MAX + 1 };

static void rigid_sums(const struct contact *c, const struct particles *p, int body, real sum[RIGID_TERMS])
{
    const struct rigid_sum s = {c, p, body};
    for (int k = 0; k < RIGID_TERMS; k++) sum[k] = 0;
    team_sums(c->near[body].n, RIGID_TERMS, rigid_block, &s, sum);
}

/* A particle may feel several bodies; they come one after the other. */
void contact_rigid_force(struct contact *c, struct particles *p, struct contact_found *all)
{
    for (int b = 0; b < c->rigids && c->near; b++) {
        const struct contact_near *near = &c->near[b];
        real sum[RIGID_TERMS];
        for (int64_t q = 0; q < near->n; q++) {
            real f[DIM_MAX];
            const real overlap = push_of(c, p, b, q, f);
            const int32_t i = c->particle[near->row[q]];
            if (overlap == 0) continue;
            for (int d = 0; d < p->dim; d++) p->f[d][i] += f[d];
            contact_found_add(all, overlap, i);
            all->touching++;                 /* a pair of which only one row is here */
        }
        rigid_sums(c, p, b, sum);
        for (int d = 0; d < DIM_MAX; d++) c->rigid[b].force[d] = sum[d], c->rigid[b].moment[d] = sum[DIM_MAX + d];
    }
}

real contact_rigid_energy(const struct contact *c, const struct particles *p)
{
    real energy = 0, sum[RIGID_TERMS];
    for (int b = 0; b < c->rigids && c->near; b++) {
        rigid_sums(c, p, b, sum);
        energy += sum[2 * DIM_MAX];
    }
    return energy;
}

status contact_rigid_archive(struct contact *c, struct archive *a)
{
    if (c->rigids > 0 && !a->saving) {
        contact_rigid_free(c);
        c->near = NEW("contact.bodies", c->rigids, struct contact_near);
    }
    for (int b = 0; b < c->rigids; b++) {
        struct contact_near *near = &c->near[b];
        char name[64];
        snprintf(name, sizeof name, "contact/near_%d", b);
        TRY(a->exchange(a, name, &near->n, sizeof near->n));
        snprintf(name, sizeof name, "contact/near_place_%d", b);
        TRY(a->exchange(a, name, near->x, sizeof near->x + sizeof near->turn));
        if (near->n < 0 || near->n > c->rows)
            return status_set(FAILED, "cannot resume: the checkpoint has an impossible number of particles in contact");
        snprintf(name, sizeof name, "contact/near_row_%d", b);
        TRY(contact_stored(a, name, (void **)&near->row, near->n, sizeof *near->row));
        snprintf(name, sizeof name, "contact/near_zero_%d", b);
        TRY(contact_stored(a, name, (void **)&near->zero, near->n, sizeof *near->zero));
        for (int64_t q = 0; q < near->n; q++)
            if (near->row[q] < 0 || near->row[q] >= c->rows)
                return status_set(FAILED, "cannot resume: particles near a rigid body are none of the checkpoint");
    }
    return OK;
}
