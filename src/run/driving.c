/* Checks of prescribed velocities and displacements. */
#include <math.h>

#include "run/make.h"

/* Returns REFUSED, with a message, if the motion that boundary condition b prescribes depends on the reference
 * positions of particles but acts on material points on the grid of the current frame (background grid), which do not
 * store these positions. l: the load of b. p: all particles. */
static status position_dependent_on_grid(const struct boundary *b, const struct particles *p, const struct load *l)
{
    for (int64_t k = 0; k < l->n && !b->rotates && boundary_motion_varies_in_space(b); k++)
        if (particle_is_moved_by_grid_or_mesh_nodes(p, l->particle[k]) && !(p->flag[l->particle[k]] & FLAG_MESHED))
            return status_set(REFUSED,
                              "boundary %s: a %s that depends on x, y, z needs reference positions, which the grid of "
                              "mpm.frame: current does not have; set mpm.frame: reference, or method: pd",
                              b->name, b->displaces ? "displacement" : "velocity");
    return OK;
}

#define DISPLACEMENT_TOLERANCE 1e-9 /* tolerance of displacements at the start [spacings] */

/* Returns REFUSED, with a message, if a particle with prescribed displacement does not start at its reference position,
 * up to DISPLACEMENT_TOLERANCE spacings. l: the load of the boundary condition b; spacing: lattice spacing [m]. p: all
 * particles. */
static status starts_at_reference(const struct boundary *b, const struct particles *p, const struct load *l,
                                  real spacing)
{
    for (int64_t k = 0; k < l->n; k++)
        for (int d = 0; d < p->dim; d++) {
            const real off = p->x[d][l->particle[k]] - p->X[d][l->particle[k]];
            if (b->components >> d & 1 && !(fabs(off) <= DISPLACEMENT_TOLERANCE * spacing))
                return status_set(
                    REFUSED,
                    "boundary %s: displacements are relative to the reference position, but `initial` moves particles "
                    "there by %.4g m along %c; give a velocity, or no initial state there",
                    b->name, off, "xyz"[d]);
        }
    return OK;
}

/* Returns REFUSED, with a message, if the displacement that boundary condition b prescribes at t = 0 exceeds
 * DISPLACEMENT_TOLERANCE spacings, because this would be a jump within the first step. p: particles; l: the load of b;
 * spacing: lattice spacing [m]. */
static status starts_at_rest(const struct boundary *b, const struct particles *p, const struct load *l, real spacing)
{
    for (int64_t k = 0; k < l->n; k++) {
        real u[DIM_MAX];
        load_prescribed_displacement_of_particle(l, p, k, 0, u);
        for (int d = 0; d < p->dim; d++)
            if (!(fabs(u[d]) <= DISPLACEMENT_TOLERANCE * spacing))
                return status_set(REFUSED,
                                  "boundary %s: its displacement is %.4g m at t = 0 already, a jump within the first "
                                  "step; let it grow from 0, for example by time: {ramp: {until: 100 us}}",
                                  b->name, u[d]);
    }
    return OK;
}

status prescribed_motion_check_is_admissible(const struct loads *loads, const struct particles *p,
                                             const struct scene *s, bool run_begins)
{
    real wave_speed = 0;
    for (int m = 0; m < s->materials; m++) wave_speed = real_max(wave_speed, s->material[m].wave_speed);
    for (int k = 0; k < loads->n; k++) {
        const struct load *l = &loads->load[k];
        const struct boundary *b = l->boundary;
        if (b->kind != BOUNDARY_VELOCITY) continue;
        TRY(status_message_prepend_location(b->place, position_dependent_on_grid(b, p, l)));
        if (!b->displaces) continue;
        if (run_begins) TRY(status_message_prepend_location(b->place, starts_at_reference(b, p, l, s->spacing)));
        if (s->solver != SOLVER_EXPLICIT) continue;
        TRY(status_message_prepend_location(b->place, starts_at_rest(b, p, l, s->spacing)));
        const real speed = load_largest_speed_of_prescribed_displacement(l, p, s->duration);
        if (!(speed >= wave_speed)) continue;
        if (isinf(speed))
            return status_message_prepend_location(
                b->place, status_set(REFUSED,
                                     "boundary %s: its displacement jumps (time: step), which no body "
                                     "can follow; set time: ramp, pulse or table",
                                     b->name));
        return status_message_prepend_location(
            b->place, status_set(REFUSED,
                                 "boundary %s: its displacement grows by %.3g m/s, faster than waves in the body (%.4g "
                                 "m/s); use a longer time, or a smaller displacement",
                                 b->name, speed, wave_speed));
    }
    return OK;
}
