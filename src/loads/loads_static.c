/* Converts the boundary conditions of a scene to those of a static problem, in which loads and prescribed displacements
 * have their values at the end of the simulated time. Computes their prescribed displacements, forces, reactions and
 * work in this state. */
#include "loads/loads.h"

#include <math.h>
#include <string.h>

#define ROUND_OFF 1e-12 /* share of the largest possible moment below which a moment counts as 0 */

void static_boundaries_make_from_dynamic(struct boundary *static_boundary, const struct boundary *boundary,
                                         int boundaries, real duration, real ramp_time)
{
    for (int b = 0; b < boundaries; b++) {
        real factor = 1;
        static_boundary[b] = boundary[b];
        static_boundary[b].frozen = true, static_boundary[b].frozen_at = duration;
        if (boundary_applies_force(&boundary[b]) || boundary[b].displaces) {
            factor = time_function_value(&boundary[b].time, duration);
            static_boundary[b].time = (struct time_function){.kind = TIME_RAMP, .until = ramp_time};
        } else if (boundary[b].kind == BOUNDARY_VELOCITY) {
            factor = time_function_integral(&boundary[b].time, duration) / ramp_time;
            static_boundary[b].time = (struct time_function){.kind = TIME_STEP, .until = ramp_time};
        }
        for (int d = 0; d < DIM_MAX; d++) static_boundary[b].value[d] = factor * boundary[b].value[d];
    }
}

/* Returns true if boundary b of a static problem prescribes displacements that differ between particles. The work of
 * the support is then a sum over particles, not the total force times one displacement. */
static bool works_by_place(const struct boundary *b) { return b->frozen && boundary_motion_varies_in_space(b); }

/* Returns component d of the displacement [m] that load l prescribes for its particle number k (of p) at the end of a
 * static problem. by: prescribed displacement at this time. For k < 0 returns the displacement at X = 0, for loads that
 * have no particles or move all equally. */
static real static_displacement(const struct prescribed_displacement *by, const struct load *l,
                                const struct particles *p, int64_t k, int d)
{
    real X[DIM_MAX] = {0};
    if (k >= 0) particle_reference_position(p, l->particle[k], X);
    return prescribed_displacement_component_at_position(by, X, d);
}

void loads_compute_prescribed_static_displacements(struct loads *l, const struct particles *p, real ramp_time,
                                                   real *const *displacement, uint8_t *driven_components)
{
    for (int c = 0; c < l->n; c++) {
        struct load *load = &l->load[c];
        const struct boundary *b = load->boundary;
        if (b->kind != BOUNDARY_VELOCITY) continue;
        const struct prescribed_displacement by = boundary_prescribed_displacement_at_time(b, p->dim, ramp_time);
        for (int d = 0; d < p->dim; d++) {
            real sum = 0;
            if (!(b->components >> d & 1)) continue;
            for (int64_t k = 0; k < load->n; k++) {
                const int32_t i = load->particle[k];
                sum += displacement[d][i] = static_displacement(&by, load, p, k, d);
                driven_components[i] |= (uint8_t)(1 << d);
            }
            load->displacement[d] = boundary_motion_varies_in_space(b) && load->n > 0
                                        ? sum / (real)load->n
                                        : static_displacement(&by, load, p, -1, d);
        }
    }
}

/* Computes in *turning the moment of the applied forces of l about the centre of mass of a plane body p [N m]. Stores
 * in *most its largest possible magnitude, the sum of |arm| |force| [N m], to which *turning can be compared. */
static void moment(const struct loads *l, const struct particles *p, real *turning, real *most)
{
    *turning = *most = 0;
    for (int c = 0; c < l->n; c++) {
        const struct load *load = &l->load[c];
        if (!boundary_applies_force(load->boundary)) continue;
        for (int64_t k = 0; k < load->n; k++) {
            const real *value = load->boundary->value;
            const real x = p->X[0][load->particle[k]] - l->centre[0], y = p->X[1][load->particle[k]] - l->centre[1];
            const real fx = value[0] * load->share[0][k], fy = value[1] * load->share[1][k];
            *turning += x * fy - y * fx;
            *most += hypot(x, y) * hypot(fx, fy);
        }
    }
}

real loads_add_inertia_relief_and_return_moment_ratio(struct loads *l, const struct particles *p)
{
    real mass = 0, inertia = 0, turning, most;
    memset(l->centre, 0, sizeof l->centre);
    for (int64_t i = 0; i < p->n; i++) {
        mass += p->mass[i];
        for (int d = 0; d < 2; d++) l->centre[d] += p->mass[i] * p->X[d][i];
    }
    for (int d = 0; d < 2; d++) l->centre[d] /= mass;
    for (int64_t i = 0; i < p->n; i++)
        inertia += p->mass[i] * (square(p->X[0][i] - l->centre[0]) + square(p->X[1][i] - l->centre[1]));
    moment(l, p, &turning, &most);
    l->turn = fabs(turning) > ROUND_OFF * most ? turning / inertia : 0;
    return most > 0 ? fabs(turning) / most : 0;
}

void loads_add_static_forces(const struct loads *l, struct particles *p)
{
    for (int64_t i = 0; i < p->n && l->turn != 0; i++) {
        p->f[0][i] += l->turn * p->mass[i] * (p->X[1][i] - l->centre[1]);
        p->f[1][i] -= l->turn * p->mass[i] * (p->X[0][i] - l->centre[0]);
    }
    for (int c = 0; c < l->n; c++) {
        const struct load *load = &l->load[c];
        if (!boundary_applies_force(load->boundary)) continue;
        for (int64_t k = 0; k < load->n; k++)
            for (int d = 0; d < p->dim; d++) p->f[d][load->particle[k]] += load->boundary->value[d] * load->share[d][k];
    }
}

void loads_extract_static_reactions_from_forces(struct loads *l, struct particles *p)
{
    for (int c = 0; c < l->n; c++) {
        struct load *load = &l->load[c];
        memset(load->reaction, 0, sizeof load->reaction);
        load->held_work = 0;
        if (load->boundary->kind != BOUNDARY_VELOCITY) continue;
        const struct prescribed_displacement by =
            boundary_prescribed_displacement_at_time(load->boundary, p->dim, INFINITY);
        const bool by_place = works_by_place(load->boundary);
        for (int64_t k = 0; k < load->n; k++)
            for (int d = 0; d < p->dim; d++) {
                if (!(load->prescribes[k] >> d & 1)) continue;
                real *f = &p->f[d][load->particle[k]];
                load->reaction[d] -= *f;
                if (by_place) load->held_work -= *f * static_displacement(&by, load, p, k, d);
                *f = 0;
            }
    }
}

void loads_compute_work_in_static_equilibrium(struct loads *l, const struct particles *p)
{
    l->work = l->constraint_work = 0;
    for (int c = 0; c < l->n; c++) {
        const struct load *load = &l->load[c];
        const struct boundary *b = load->boundary;
        for (int d = 0; d < p->dim; d++)
            if (b->kind == BOUNDARY_VELOCITY && !works_by_place(b))
                l->constraint_work += 0.5 * load->reaction[d] * load->displacement[d];
        l->constraint_work += 0.5 * load->held_work;
        if (!boundary_applies_force(b)) continue;
        for (int64_t k = 0; k < load->n; k++)
            for (int d = 0; d < p->dim; d++) {
                const int32_t i = load->particle[k];
                l->work += 0.5 * b->value[d] * load->share[d][k] * (p->x[d][i] - p->X[d][i]);
            }
    }
}
